// One list of situations of a receiver before a shadow map: the empty map, the full one, a caster alone or over a part of
// the filter, with receivers in front, on it and behind, in the light's range of depth, at and beyond either plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::test {

/// A depth as a map holds it: on the plane that it is beyond. NaN is on the far plane.
inline double depth_in_range(double z) { return std::isnan(z) ? 1 : std::clamp(z, -1.0, 1.0); }

/// Depths that nobody should store or ask for, and some ordinary ones.
inline constexpr std::array hostile_depths{-HUGE_VALF, -1e30f,      -2.0f,     -1.0000001f,
                                           -1.0f,      -0.9999999f, -0.99f,    -0.5f,
                                           -1e-40f,    0.0f,        1e-40f,    0.3f,
                                           0.99f,      0.9999999f,  1.0f,      1.0000001f,
                                           2.0f,       1e30f,       HUGE_VALF, std::numeric_limits<float>::quiet_NaN()};

/// A depth with its weight in the filter. Weights are multiples of 1/8 and sum to 1.
struct weighted_depth {
    float z, weight;
};

/// A filter region, a receiver, and the shadow intensity, which is 0 for a receiver of NaN.
struct depth_situation {
    std::vector<weighted_depth> casters;
    float receiver;

    [[nodiscard]] double truth() const
    {
        double sum = 0;
        for (const weighted_depth& c : casters)
            if (!std::isnan(receiver) && depth_in_range(double(c.z)) < depth_in_range(double(receiver)))
                sum += double(c.weight);
        return sum;
    }
    /// True if all depths are the same in the map.
    [[nodiscard]] bool is_single() const
    {
        return std::all_of(casters.begin(), casters.end(), [&](const weighted_depth& c) {
            return depth_in_range(double(c.z)) == depth_in_range(double(casters[0].z));
        });
    }
    /// How far the receiver is behind the farthest caster.
    [[nodiscard]] double distance_behind() const
    {
        double farthest = -1;
        for (const weighted_depth& c : casters) farthest = std::max(farthest, depth_in_range(double(c.z)));
        return std::isnan(receiver) ? -2 : depth_in_range(double(receiver)) - farthest;
    }
};

/// Call visit(situation) for each situation.
template <class Visit> void for_each_depth_situation(Visit visit)
{
    constexpr float cleared = 1;
    std::vector<std::vector<weighted_depth>> maps;
    for (const float z : hostile_depths) {
        maps.push_back({{z, 1}}); // among them the empty map and the full one
        for (const float weight : {0.125f, 0.5f, 0.875f}) {
            maps.push_back({{z, weight}, {cleared, 1 - weight}});                         // over a part of the filter
            maps.push_back({{-1, weight}, {z, 1 - weight}});                              // behind a near one
            maps.push_back({{-0.25f, weight / 2}, {z, weight / 2}, {0.25f, 1 - weight}}); // among others
        }
    }
    for (const std::vector<weighted_depth>& map : maps) {
        for (const float receiver : hostile_depths) visit(depth_situation{map, receiver});
        for (const float step : {-0.1f, -1e-6f, 1e-6f, 0.1f, 0.25f}) visit(depth_situation{map, map[0].z + step});
    }
}

} // namespace gnomon::test
