#include "seed_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

seed_statistics::seed_statistics(std::span<const float> reference, std::span<const std::size_t> penumbrae)
    : reference_(reference), penumbrae_(penumbrae)
{
    for (sums* some : {&estimate_, &exact_, &both_, &held_})
        for (std::vector<double>* one : {&some->a, &some->b, &some->product}) one->resize(reference.size());
}

void seed_statistics::add(std::span<const float> estimate, std::span<const float> exact, std::span<const float> held)
{
    const error_statistics found = compare(estimate, reference_);
    ++seeds_;
    errors_.rmse += found.rmse * found.rmse; // the square, until errors() draws the root
    errors_.mean_abs += found.mean_abs, errors_.leak += found.leak, errors_.acne += found.acne,
        errors_.darkened += found.darkened;
    errors_.max_abs = std::max(errors_.max_abs, found.max_abs),
    errors_.max_dark = std::max(errors_.max_dark, found.max_dark);
    for (std::size_t i = 0; i < reference_.size(); ++i) {
        const auto put = [i](sums& to, double a, double b) { to.a[i] += a, to.b[i] += b, to.product[i] += a * b; };
        const double e = double(estimate[i]), x = double(exact[i]), h = double(held[i]);
        put(estimate_, e, e), put(exact_, x, x), put(both_, e, x), put(held_, h, h);
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

double seed_statistics::covariance(const sums& of, std::size_t pixel) const
{
    const double n = seeds_;
    return (of.product[pixel] - of.a[pixel] * of.b[pixel] / n) / (n - 1);
}

std::optional<double> seed_statistics::mean_covariance(const sums& of) const
{
    if (seeds_ < 2 || penumbrae_.empty()) return {};
    double sum = 0;
    for (const std::size_t pixel : penumbrae_) sum += covariance(of, pixel);
    return sum / double(penumbrae_.size());
}

namespace {

std::optional<double> deviation(const std::optional<double>& variance)
{
    if (!variance) return {};
    return std::sqrt(std::max(0.0, *variance));
}

} // namespace

std::optional<double> seed_statistics::noise() const { return deviation(mean_covariance(estimate_)); }
std::optional<double> seed_statistics::noise_of_map() const { return deviation(mean_covariance(held_)); }

std::optional<double> seed_statistics::noise_beyond_camera() const
{
    const std::optional<double> estimate = mean_covariance(estimate_), exact = mean_covariance(exact_),
                                both = mean_covariance(both_);
    if (!estimate || !(*exact > 0)) return deviation(estimate);
    return deviation(*estimate - *both * *both / *exact);
}

std::optional<double> seed_statistics::bias() const
{
    if (seeds_ < 2) return {};
    double sum = 0;
    for (std::size_t i = 0; i < reference_.size(); ++i) {
        const double error = estimate_.a[i] / seeds_ - double(reference_[i]);
        sum += error * error - covariance(estimate_, i) / seeds_;
    }
    return std::sqrt(std::max(0.0, sum / double(reference_.size())));
}

} // namespace gnomon::evaluation
