// Ranges within resolve_tie of one another, for climbers: the stated error of a resolved list is n - 1 ties.
#pragma once

#include "support/climber.hpp"

#include <gnomon/passes/range/resolve.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace gnomon::test {

template <class T> using near_ranges = std::vector<depth_time_range<T>>;

/// Dimensions of a climber's place for so many ranges and a time.
constexpr std::size_t near_dimensions(std::size_t ranges) { return 4 * ranges + 1; }

template <class T> near_ranges<T> near_ranges_at(const std::vector<double>& place)
{
    constexpr double depths = 8 * 0x1p-18; // within 8 ties
    const auto time = [](double x) { return T(std::clamp(1.4 * x - 0.2, 0.0, 1.0)); };
    near_ranges<T> all;
    for (std::size_t k = 0; k + 4 < place.size(); k += 4)
        all.push_back(range_between(time(place[k]), T(depths * place[k + 2]), time(place[k + 1]),
                                    T(depths * place[k + 3]), T(all.size() % 3)));
    return all;
}

/// Distance of the resolved front from that of all ranges at the place's time, in ties; infinite if only one of them is
/// empty, -1 beside an end of a range.
template <class T>
double ties_behind(std::span<const depth_time_range<T>> all, std::span<const depth_time_range<T>> resolved, double time)
{
    const T t = T(time);
    bool beside_an_end = false;
    const auto front = [&](std::span<const depth_time_range<T>> ranges) {
        double depth = HUGE_VAL;
        for (const auto& r : ranges) {
            beside_an_end |= std::abs(r.t0 - t) < T(1e-5) || std::abs(r.t1 - t) < T(1e-5);
            if (r.t0 <= t && t <= r.t1) depth = std::min(depth, double(range_depth(r, t)));
        }
        return depth;
    };
    const double expected = front(all), found = front(resolved);
    if (beside_an_end || (std::isinf(expected) && std::isinf(found))) return -1;
    return std::abs(found - expected) / resolve_tie<double>;
}

/// Climb for the largest distance of resolve(ranges) from the front of so many ranges, in ties.
template <class T, class Resolve> summit climb_ties(std::size_t ranges, std::uint64_t seed, const Resolve& resolve)
{
    return climb(near_dimensions(ranges), 300'000, seed, [&](const std::vector<double>& place) {
        const near_ranges<T> all = near_ranges_at<T>(place);
        return ties_behind<T>(all, resolve(all), place.back());
    });
}

} // namespace gnomon::test
