#include "seed_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

seed_statistics::seed_statistics(std::span<const float> reference, std::span<const std::size_t> penumbrae)
    : reference_(reference), penumbrae_(penumbrae)
{
    for (sums* some : {&estimate_, &beyond_})
        some->first.resize(reference.size()), some->second.resize(reference.size());
}

void seed_statistics::add(std::span<const float> estimate, std::span<const float> exact)
{
    const error_statistics e = compare(estimate, reference_);
    ++seeds_;
    errors_.rmse += e.rmse * e.rmse; // the square, until errors() draws the root
    errors_.mean_abs += e.mean_abs, errors_.leak += e.leak, errors_.acne += e.acne, errors_.darkened += e.darkened;
    errors_.max_abs = std::max(errors_.max_abs, e.max_abs), errors_.max_dark = std::max(errors_.max_dark, e.max_dark);
    for (std::size_t i = 0; i < reference_.size(); ++i) {
        const auto put = [&](sums& to, double value) { to.first[i] += value, to.second[i] += value * value; };
        put(estimate_, double(estimate[i]));
        put(beyond_, double(estimate[i]) - double(exact[i]));
    }
}

error_statistics seed_statistics::errors() const
{
    error_statistics result = errors_;
    const double n = std::max(seeds_, 1);
    result.rmse = std::sqrt(result.rmse / n);
    for (double* mean : {&result.mean_abs, &result.leak, &result.acne, &result.darkened}) *mean /= n;
    return result;
}

double seed_statistics::variance(const sums& of, std::size_t pixel) const
{
    const double n = seeds_, sum = of.first[pixel];
    return std::max(0.0, of.second[pixel] - sum * sum / n) / (n - 1);
}

std::optional<double> seed_statistics::deviation(const sums& of) const
{
    if (seeds_ < 2 || penumbrae_.empty()) return {};
    double sum = 0;
    for (const std::size_t pixel : penumbrae_) sum += variance(of, pixel);
    return std::sqrt(sum / double(penumbrae_.size()));
}

std::optional<double> seed_statistics::bias() const
{
    if (seeds_ < 2) return {};
    double sum = 0;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
        const double error = estimate_.first[i] / seeds_ - double(reference_[i]);
        sum += error * error - variance(estimate_, i) / seeds_;
    }
    return std::sqrt(std::max(0.0, sum / double(reference_.size())));
}

} // namespace gnomon::evaluation
