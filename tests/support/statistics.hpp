// Errors of a run, and the rows in which headers state them. A row stands in the comment of the kernel,
//     error, float, hankel4_constant_bias at 3e-7: p99 2e-5, p99.9 1e-4, max 5e-3
// and the test reads the row there, so that the stated errors are the tested ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test {

/// A sample of errors. A NaN counts as infinite, so that no comparison can miss it.
class error_sample {
  public:
    void add(double error) { errors_.push_back(std::isnan(error) ? HUGE_VAL : std::abs(error)); }

    [[nodiscard]] std::size_t size() const { return errors_.size(); }
    [[nodiscard]] double mean() const
    {
        double sum = 0;
        for (double e : errors_) sum += e;
        return sum / double(errors_.size());
    }
    /// The error that the given fraction of the sample does not exceed; 1 gives the largest.
    [[nodiscard]] double quantile(double fraction) const
    {
        std::vector<double> sorted = errors_;
        const auto last = double(sorted.size() - 1);
        const auto place = sorted.begin() + std::ptrdiff_t(std::ceil(fraction * last));
        std::nth_element(sorted.begin(), place, sorted.end());
        return *place;
    }

  private:
    std::vector<double> errors_;
};

struct error_row {
    double p99, p999, maximum;
};

/// Ends the program, also one without exceptions, with a line that says what is wrong with a header.
[[noreturn]] inline void refuse(const std::string& header, const char* what, const std::string& which)
{
    std::fprintf(stderr, "%s: %s %s\n", header.c_str(), what, which.c_str());
    std::exit(1);
}

/// The row "error, NAME: p99 X, p99.9 Y, max Z" of include/gnomon/HEADER. The maximum is infinite if none is stated.
inline error_row stated_error(const std::string& header, const std::string& name)
{
    const auto path = std::filesystem::path(__FILE__).parent_path() / "../../include/gnomon" / header;
    std::ifstream file(path);
    const std::string key = "error, " + name + ": ";
    for (std::string line; std::getline(file, line);) {
        const auto at = line.find(key);
        if (at == std::string::npos) continue;
        std::istringstream words(line.substr(at + key.size()));
        error_row row{};
        std::string p99, p999, maximum;
        char comma = 0;
        words >> p99 >> row.p99 >> comma >> p999 >> row.p999;
        const bool quantiles = words && p99 == "p99" && p999 == "p99.9";
        if (quantiles && !(words >> comma)) return row.maximum = HUGE_VAL, row;
        words >> maximum >> row.maximum;
        if (quantiles && words && maximum == "max") return row;
        refuse(header, "not a row", line);
    }
    refuse(header, "states no error for", name);
}

} // namespace gnomon::test
