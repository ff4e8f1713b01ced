// A hill climber. The largest errors of a kernel occur in corners that uniform random samples miss by orders of
// magnitude (a receiver 2^-30 behind a depth, three depths in a line).
#pragma once

#include "effort.hpp"
#include "hostile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace gnomon::test {

/// The highest point found: its score and its place in the unit cube.
struct summit {
    double score = -HUGE_VAL;
    std::vector<double> place;
};

/// The highest point found by climbing towards large values of score(place), for places in the unit cube of the given
/// number of dimensions.
///
/// Every climb starts from the best of 16 random places. A step moves one to three coordinates by a distance drawn
/// log-uniformly from 2^-45 to 1, or sends one anywhere; it is kept if the score does not fall, so plateaus are
/// crossed. A climb ends after 60 steps per dimension without a gain. A NaN counts as infinitely high.
/// evaluations is the number of evaluations in a full run (effort.hpp).
template <class Score> summit climb(std::size_t dimensions, std::int64_t evaluations, std::uint64_t seed, Score score)
{
    bit_source bits(seed);
    summit best;
    std::int64_t left = std::max<std::int64_t>(effort(evaluations), 200);
    const auto rate = [&](const std::vector<double>& place) {
        --left;
        const double s = score(place);
        return std::isnan(s) ? HUGE_VAL : s;
    };
    while (left > 0 && best.score < HUGE_VAL) {
        summit now;
        for (int i = 0; i < 16; ++i) {
            std::vector<double> place(dimensions);
            for (double& x : place) x = bits.uniform(0, 1);
            const double s = rate(place);
            if (s >= now.score) now = {s, std::move(place)};
        }
        for (std::size_t idle = 0; idle < 60 * dimensions && left > 0; ++idle) {
            std::vector<double> place = now.place;
            for (std::size_t moves = 1 + bits.below(3); moves > 0; --moves) {
                double& x = place[bits.below(dimensions)];
                if (bits.chance(0.1)) x = bits.uniform(0, 1);
                else x += (bits.chance(0.5) ? 1 : -1) * std::exp2(bits.uniform(-45, 0));
                x = std::clamp(x, 0.0, 1.0);
            }
            const double s = rate(place);
            if (s > now.score) idle = 0;
            if (s >= now.score) now = {s, std::move(place)};
        }
        if (now.score > best.score) best = now;
    }
    return best;
}

} // namespace gnomon::test
