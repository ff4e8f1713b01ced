// Depth distributions that provoke moment methods, for tests and benches: 13 families, drawn from a seed. They
// cover the content of filter regions (one to five surfaces, a filtered plane, clamped depths) and cases that
// break arithmetic (coincident depths, vanishing weights). The families are not meant to be likely: figures over
// them compare methods.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string_view>
#include <vector>

namespace gnomon::test {

/// A discrete distribution of signed depth: weights sum to 1 up to rounding.
struct distribution {
    std::vector<double> depths, weights;

    [[nodiscard]] double below(double z_f) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < depths.size(); ++i) sum += depths[i] < z_f ? weights[i] : 0;
        return sum;
    }
};

enum class family {
    one_point,
    one_point_at_end,
    two_points,
    two_points_near,
    two_points_at_ends,
    three_points,
    three_points_with_end,
    three_points_two_near,
    four_points,
    five_points,
    five_points_tiny_weight,
    many_points,
    plane,
};
inline constexpr int family_count = 13;
inline constexpr std::array<std::string_view, family_count> family_names = {"one point",
                                                                            "one point at an end",
                                                                            "two points",
                                                                            "two near points",
                                                                            "both ends",
                                                                            "three points",
                                                                            "three points, one at an end",
                                                                            "three points, two near",
                                                                            "four points",
                                                                            "five points",
                                                                            "five points, one faint",
                                                                            "81 points",
                                                                            "9x9 plane"};

/// The least number of distinct depths of a family. With more than m / 2 the bounds are smooth in the moments.
inline constexpr std::array<int, family_count> family_points = {1, 1, 2, 2, 2, 3, 3, 3, 4, 5, 5, 81, 9};

class distribution_source {
  public:
    explicit distribution_source(std::uint64_t seed) : random_(seed) {}

    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
    double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
    double sign() { return uniform(0, 1) < 0.5 ? -1.0 : 1.0; }

    distribution draw(family f)
    {
        switch (f) {
            case family::one_point:
                return points(1);
            case family::one_point_at_end:
                return weighted({sign()});
            case family::two_points:
                return points(2);
            case family::two_points_near:
                return near_pair(2);
            case family::two_points_at_ends:
                return weighted({-1.0, 1.0});
            case family::three_points:
                return points(3);
            case family::three_points_with_end:
                return weighted({uniform(-1, 1), uniform(-1, 1), sign()});
            case family::three_points_two_near:
                return near_pair(3);
            case family::four_points:
                return points(4);
            case family::five_points:
                return points(5);
            case family::five_points_tiny_weight: {
                distribution d = points(5);
                d.weights[0] = log_uniform(1e-6, 1e-2);
                normalise(d);
                return d;
            }
            case family::many_points:
                return points(81);
            case family::plane:
                return plane();
        }
        return points(1);
    }

    /// A receiver at a critical depth: anywhere, on a depth of the distribution, or close to one.
    double receiver(const distribution& d)
    {
        const double u = uniform(0, 1);
        if (u < 0.5) return uniform(-1, 1);
        const double z = d.depths[std::size_t(uniform(0, double(d.depths.size()) * 0.9999999))];
        if (u < 0.65) return z;
        return std::clamp(z + sign() * log_uniform(1e-7, 1e-1), -1.0, 1.0);
    }

  private:
    distribution weighted(std::vector<double> depths)
    {
        distribution d{std::move(depths), {}};
        const bool even = uniform(0, 1) < 0.3;
        for (std::size_t i = 0; i < d.depths.size(); ++i) d.weights.push_back(even ? 1.0 : uniform(0.02, 1));
        normalise(d);
        return d;
    }
    distribution points(int count)
    {
        std::vector<double> depths;
        for (int i = 0; i < count; ++i) depths.push_back(uniform(-1, 1));
        return weighted(depths);
    }
    distribution near_pair(int count)
    {
        distribution d = points(count);
        d.depths[1] = std::clamp(d.depths[0] + sign() * log_uniform(1e-5, 1e-2), -1.0, 1.0);
        return d;
    }
    distribution plane()
    {
        const double z = uniform(-0.9, 0.9), x = sign() * log_uniform(1e-4, 2e-2), y = sign() * log_uniform(1e-4, 2e-2);
        distribution d;
        for (int j = -4; j <= 4; ++j)
            for (int i = -4; i <= 4; ++i) {
                d.depths.push_back(std::clamp(z + i * x + j * y, -1.0, 1.0));
                d.weights.push_back(1);
            }
        normalise(d);
        return d;
    }
    static void normalise(distribution& d)
    {
        double sum = 0;
        for (double w : d.weights) sum += w;
        for (double& w : d.weights) w /= sum;
    }

    std::mt19937_64 random_;
};

} // namespace gnomon::test
