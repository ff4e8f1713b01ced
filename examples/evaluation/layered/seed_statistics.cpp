#include "seed_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

seed_statistics::seed_statistics(std::span<const float> reference, std::span<const std::size_t> penumbrae)
    : reference_(reference), penumbrae_(penumbrae), estimate_(reference.size())
{
    for (auto* some : {&seen_, &exact_, &both_, &beyond_, &held_}) some->resize(penumbrae.size());
}

void seed_statistics::add(std::span<const float> estimate, const in_penumbrae& known)
{
    const error_statistics found = compare(estimate, reference_);
    ++seeds_;
    errors_.rmse += found.rmse * found.rmse; // the square, until errors() draws the root
    errors_.mean_abs += found.mean_abs, errors_.leak += found.leak, errors_.acne += found.acne,
        errors_.darkened += found.darkened;
    errors_.max_abs = std::max(errors_.max_abs, found.max_abs),
    errors_.max_dark = std::max(errors_.max_dark, found.max_dark);
    for (std::size_t i = 0; i < reference_.size(); ++i) estimate_[i].add(double(estimate[i]), double(estimate[i]));
    for (std::size_t i = 0; i < penumbrae_.size(); ++i) {
        const double e = double(estimate[penumbrae_[i]]), x = double(known.at_times[i]),
                     beyond = e - double(known.over_parts[i]), h = double(known.held[i]);
        seen_[i].add(e, e), exact_[i].add(x, x), both_[i].add(e, x), beyond_[i].add(beyond, beyond), held_[i].add(h, h);
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

double seed_statistics::covariance(const sums& of) const
{
    const double n = seeds_;
    return (of.product - of.a * of.b / n) / (n - 1);
}

std::optional<double> seed_statistics::mean_covariance(const std::vector<sums>& of) const
{
    if (seeds_ < 2 || of.empty()) return {};
    double sum = 0;
    for (const sums& pixel : of) sum += covariance(pixel);
    return sum / double(of.size());
}

namespace {

std::optional<double> deviation(const std::optional<double>& variance)
{
    if (!variance) return {};
    return std::sqrt(std::max(0.0, *variance));
}

} // namespace

std::optional<double> seed_statistics::noise() const { return deviation(mean_covariance(seen_)); }
std::optional<double> seed_statistics::noise_beyond_exact() const { return deviation(mean_covariance(beyond_)); }
std::optional<double> seed_statistics::noise_of_map() const { return deviation(mean_covariance(held_)); }

std::optional<double> seed_statistics::noise_beyond_camera() const
{
    const std::optional<double> estimate = mean_covariance(seen_), exact = mean_covariance(exact_),
                                both = mean_covariance(both_);
    if (!estimate || !(*exact > 0)) return deviation(estimate);
    return deviation(*estimate - *both * *both / *exact);
}

std::optional<double> seed_statistics::bias() const
{
    if (seeds_ < 2) return {};
    double sum = 0;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
        const double error = estimate_[i].a / seeds_ - double(reference_[i]);
        sum += error * error - covariance(estimate_[i]) / seeds_;
    }
    return std::sqrt(std::max(0.0, sum / double(reference_.size())));
}

} // namespace gnomon::evaluation
