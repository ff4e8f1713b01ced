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

    // The estimate of each pixel with one more seed of map and camera, the exact visibility at the same times of the camera,
    // and the estimate with the map's new seed and the camera's first one.
    void add(std::span<const float> estimate, std::span<const float> exact, std::span<const float> held);

    int seeds() const { return seeds_; }

    // Means over seeds.
    error_statistics errors() const;

    // Standard deviations over seeds, the root of the mean variance in penumbrae. None of less than two seeds or without
    // penumbrae. Beyond the camera's: what is left of it with exact visibility at the same times as a control variate, with
    // the best factor for all penumbrae. Of the map: with the samples of the camera held.
    std::optional<double> noise() const;
    std::optional<double> noise_beyond_camera() const;
    std::optional<double> noise_of_map() const;

    // Root mean square over pixels of the mean error over seeds, without what noise adds to it. None of less than two
    // seeds.
    std::optional<double> bias() const;

  private:
    // Of each pixel: sums of a and of b, and of their product.
    struct sums {
        std::vector<double> a, b, product;
    };
    double covariance(const sums& of, std::size_t pixel) const;
    std::optional<double> mean_covariance(const sums& of) const; // in penumbrae

    std::span<const float> reference_;
    std::span<const std::size_t> penumbrae_;
    int seeds_ = 0;
    sums estimate_, exact_, both_, held_;
    error_statistics errors_;
};

} // namespace gnomon::evaluation
