// Situations of receivers from places in the unit cube, which a climber moves (climber.hpp): a distribution of few
// depths, or a small scene under a 9x9 filter. Surfaces are 2^-30 to 1 apart. A receiver is on a depth, 2^-40 to 1
// behind one, or anywhere.
#pragma once

#include "distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::test {

/// 0 for a place in the middle of the unit interval, else a number of either sign with magnitude from 2^-smallest to 1.
inline double any_size(double place, double smallest)
{
    const double x = 2 * place - 1;
    if (std::abs(x) < 0.05) return 0;
    return std::copysign(std::exp2(smallest * (std::abs(x) - 1) / 0.95), x);
}

/// The depth z in a depth buffer: clamped to [-1, 1] and rounded to float.
inline double clamped_depth(double z) { return double(float(std::clamp(z, -1.0, 1.0))); }

/// The depth of a receiver: at a depth, behind it, or anywhere.
inline double receiver_at(double depth, double kind, double place)
{
    if (kind < 0.3) return depth;
    if (kind < 0.9) return clamped_depth(depth + std::exp2(-40 * place));
    return clamped_depth(2 * place - 1);
}

/// A receiver and the distribution of depths in its filter region.
struct sight {
    distribution seen;
    double receiver;
};

inline constexpr std::size_t sight_dimensions = 14;

/// The sight of one to five depths, each anywhere, near another, or clamped to an end.
inline sight sight_at(const std::vector<double>& x)
{
    sight s;
    const std::size_t count = 1 + std::min<std::size_t>(std::size_t(5 * x[0]), 4);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double place = x[1 + i];
        const bool near = i > 0 && place > 0.5;
        s.seen.depths.push_back(clamped_depth(near ? s.seen.depths[i - 1] + any_size(2 * place - 1, 30)
                                                   : (i > 0 ? 2 : 1) * 2.2 * place - 1.1));
        const double weight = std::exp2(-20 * x[6 + i]) * (1.0 + x[6 + i]);
        s.seen.weights.push_back(weight);
        sum += weight;
    }
    for (double& w : s.seen.weights) w /= sum;
    const std::size_t chosen = std::min(std::size_t(double(count) * x[11]), count - 1);
    s.receiver = receiver_at(s.seen.depths[chosen], x[12], x[13]);
    return s;
}

/// A receiver in a scene of 9x9 depths under a separable filter.
struct contact {
    std::array<std::array<float, 9>, 9> depths;
    std::array<float, 9> taps;
    double receiver;

    [[nodiscard]] double below(double z_f) const
    {
        double sum = 0, whole = 0;
        for (std::size_t j = 0; j < 9; ++j)
            for (std::size_t i = 0; i < 9; ++i) {
                const double w = double(taps[i]) * double(taps[j]);
                whole += w;
                sum += double(depths[j][i]) < z_f ? w : 0;
            }
        return sum / whole;
    }
};

inline constexpr std::size_t contact_dimensions = 18;

/// The scene of up to three planes that meet, or nearly meet, along straight borders, under a box or a binomial filter.
inline contact contact_at(const std::vector<double>& x)
{
    contact s{};
    const std::array<float, 9> binomial = {1, 8, 28, 56, 70, 56, 28, 8, 1};
    for (std::size_t i = 0; i < 9; ++i) s.taps[i] = x[0] < 0.5 ? 1.0f / 9 : binomial[i] / 256;
    const double z = 2.2 * x[1] - 1.1;
    std::array<double, 3> away{}, slope_x{}, slope_y{};
    for (std::size_t k = 0; k < 3; ++k) {
        away[k] = k > 0 ? any_size(x[1 + k], 30) : 0;
        slope_x[k] = any_size(x[4 + k], 30) / 4;
        slope_y[k] = any_size(x[7 + k], 30) / 4;
    }
    const auto beyond = [&](double i, double j, double turn, double distance) {
        const double angle = 6.283185307179586 * turn;
        return i * std::cos(angle) + j * std::sin(angle) > 12 * distance - 6;
    };
    for (std::size_t b = 0; b < 9; ++b)
        for (std::size_t a = 0; a < 9; ++a) {
            const double i = double(a) - 4, j = double(b) - 4;
            const std::size_t k = beyond(i, j, x[10], x[11]) ? 1 : beyond(i, j, x[12], x[13]) ? 2 : 0;
            s.depths[b][a] = float(clamped_depth(z + away[k] + slope_x[k] * i + slope_y[k] * j));
        }
    const std::size_t b = std::min<std::size_t>(std::size_t(9 * x[14]), 8);
    const std::size_t a = std::min<std::size_t>(std::size_t(9 * x[15]), 8);
    s.receiver = receiver_at(double(s.depths[b][a]), x[16], x[17]);
    return s;
}

} // namespace gnomon::test
