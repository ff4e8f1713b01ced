// Errors and noise of an estimate of a picture's visibility over several seeds.
#pragma once

#include "evaluation/core/report.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::evaluation {

class seed_statistics {
  public:
    // The reference of each pixel, and the pixels in penumbrae, in which noise is measured. Both outlive the statistics.
    seed_statistics(std::span<const float> reference, std::span<const std::size_t> penumbrae);

    // The estimate of each pixel with one more seed, and the exact visibility at the same times of the camera.
    void add(std::span<const float> estimate, std::span<const float> exact);

    int seeds() const { return seeds_; }

    // Means over seeds.
    error_statistics errors() const;

    // Standard deviations over seeds, the root of the mean variance in penumbrae: of the estimate, and of its difference
    // from what is exact at the same times, which leaves out the camera's noise. None of less than two seeds or without
    // penumbrae.
    std::optional<double> noise() const { return deviation(estimate_); }
    std::optional<double> noise_beyond_camera() const { return deviation(beyond_); }

    // Root mean square over pixels of the mean error over seeds, without what noise adds to it. None of less than two
    // seeds.
    std::optional<double> bias() const;

  private:
    struct sums {
        std::vector<double> first, second;
    };
    std::optional<double> deviation(const sums& of) const;
    double variance(const sums& of, std::size_t pixel) const;

    std::span<const float> reference_;
    std::span<const std::size_t> penumbrae_;
    int seeds_ = 0;
    sums estimate_, beyond_;
    error_statistics errors_;
};

} // namespace gnomon::evaluation
