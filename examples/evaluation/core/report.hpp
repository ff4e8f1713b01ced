// Numbers that the demo leaves behind: error statistics, and rows of out/report.json.
#pragma once

#include "method.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// Statistics of visibility estimates E against references V over all receivers. leak is the mean of max(0, E - V), acne the mean
// of max(0, V - E) and max_dark the largest V - E; darkened is the share that is too dark by too_dark and more among
// what is lit, with V of half and more, 0 where nothing is.
struct error_statistics {
    double rmse = 0, mean_abs = 0, leak = 0, acne = 0, max_abs = 0, max_dark = 0, darkened = 0;
};
inline constexpr double too_dark = 0.05;

// Throws std::invalid_argument where the two differ in size or are empty.
error_statistics compare(std::span<const float> estimate, std::span<const float> reference);

// The identity of a row is what comes before label, the reference, and what the row ran on: real, lanes, threads and
// device. Ids are those of the registry; the label is for people.
struct report_row {
    std::string scene{}, part{}, method{}, family{}, map{}, receiver{}, format{};
    evaluation::parameters parameters{};
    std::string label{};
    std::string reference{}; // id: "filtered", "traced", "closed-form", or of a device "cpu", the same method there
    long long receivers = 0;
    double bytes_per_texel = 0;
    double map_bytes = 0;
    error_statistics errors{};
    std::optional<double> noise{}, bias{};      // standard deviation over seeds, and mean error over them
    std::optional<double> noise_beyond_exact{}; // of the difference from exact visibility over the same parts of time
    std::optional<double>
        noise_beyond_camera{};             // left with exact visibility at the camera's times as a control variate
    std::optional<double> noise_of_map{};  // with the samples of the camera held
    std::optional<double> acne_unbiased{}; // of the same receivers without depth bias
    std::optional<double> ns_kernel{};     // of values that have been fetched
    double ns_per_receiver = 0;            // with the look-up
    double build_ms = 0;
    std::string real = "float";
    int lanes = 1, threads = 1;
    std::string device = "cpu"; // or the name of a device that is no thread of the CPU
    int seeds = 1;
    std::vector<std::pair<std::string, double>> passes{}; // milliseconds of steps, each in a field NAME_ms
};

// A row with a method's ids, parameters and size of a texel.
report_row row_of(const method& m);

// Puts rows into the file, an array of flat objects but for the parameters. A row replaces the one of the same identity;
// other rows stay as they are. The file is written aside and renamed. Throws std::runtime_error "FILE: cause", and
// leaves the file alone, where the file holds something else or a number is not finite.
void merge_report(const std::filesystem::path& file, std::span<const report_row> rows);

} // namespace gnomon::evaluation
