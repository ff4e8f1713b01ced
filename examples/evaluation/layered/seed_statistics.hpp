// Errors and noise of an estimate of a picture's visibility over several seeds.
#pragma once

#include "evaluation/core/report.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// Of each pixel in penumbrae, with one seed of the camera: the exact visibility at the times of its samples, and over the
// parts of the shutter interval that look-ups average; and the estimate with the map's seed and the camera's first one.
struct in_penumbrae {
    std::span<const float> at_times, over_parts, held;
};

class seed_statistics {
  public:
    // The reference of each pixel, and the pixels in penumbrae, in which noise is measured. Both outlive the statistics.
    seed_statistics(std::span<const float> reference, std::span<const std::size_t> penumbrae);

    // The estimate of each pixel with one more seed of map and camera, and what else is known of those in penumbrae.
    void add(std::span<const float> estimate, const in_penumbrae& known);

    int seeds() const { return seeds_; }

    // Means over seeds.
    error_statistics errors() const;

    // Standard deviations over seeds, the root of the mean variance in penumbrae. None of less than two seeds or without
    // penumbrae. Beyond exact visibility: of the difference from the exact visibility over the parts of the shutter interval
    // that look-ups average. Beyond the camera's: what is left with exact visibility at the camera's times as a control
    // variate, with the best factor for all penumbrae. Of the map: with the samples of the camera held.
    std::optional<double> noise() const;
    std::optional<double> noise_beyond_exact() const;
    std::optional<double> noise_beyond_camera() const;
    std::optional<double> noise_of_map() const;

    // Root mean square over pixels of the mean error over seeds, without what noise adds to it. None of less than two
    // seeds.
    std::optional<double> bias() const;

  private:
    // Of one pixel: sums of a and of b, and of their product.
    struct sums {
        double a = 0, b = 0, product = 0;
        void add(double x, double y) { a += x, b += y, product += x * y; }
    };
    double covariance(const sums& of) const;
    std::optional<double> mean_covariance(const std::vector<sums>& of) const; // in penumbrae

    std::span<const float> reference_;
    std::span<const std::size_t> penumbrae_;
    int seeds_ = 0;
    std::vector<sums> estimate_;                            // of each pixel
    std::vector<sums> seen_, exact_, both_, beyond_, held_; // of those in penumbrae
    error_statistics errors_;
};

} // namespace gnomon::evaluation
