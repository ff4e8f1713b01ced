// The cover of a texel, a triangle that is in it while the shutter is open, and what remains of the list in front of it
// (Hong & Oh 2017).
#pragma once

#include "evaluation/core/timing.hpp"
#include "evaluation/motion/range_maps.hpp"

#include <gnomon/motion/range/range_cover.h>

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// From one of a list on, as many as are pieces of one range of a triangle that was cut: each begins when the one before
// ends, bit for bit. As one range, from the nearest depth of all of them to the farthest.
struct uncut_range {
    std::size_t pieces;
    depth_time_range<float> whole;
};

// The nearest cover of a list; its id is below 0 where there is none.
uncut_range cover_of(std::span<const depth_time_range<float>> list);

void add_visible(const depth_time_range<float>& cover, std::span<const depth_time_range<float>> list,
                 std::vector<depth_time_range<float>>& to);

// Calls keep(cover, list) for each texel, in order, which adds to the ranges of the result.
template <class Keep> void cover(const range_shadow_map& exact, range_shadow_map& result, const Keep& keep)
{
    const std::size_t texels = texels_of(exact.resolution);
    const double spent = least_seconds([&] {
        result.first.clear(), result.ranges.clear(), result.texel_covers.clear(), result.covers = 0;
        for (std::size_t i = 0; i < texels; ++i) {
            result.first.push_back(std::uint32_t(result.ranges.size()));
            const auto list = list_of(exact, i);
            const uncut_range found = cover_of(list);
            result.covers += found.whole.id >= 0;
            keep(found, list);
        }
        result.first.push_back(std::uint32_t(result.ranges.size()));
    });
    result.build_ms = exact.build_ms + 1e3 * spent;
    result.pairs = exact.pairs;
    result.bytes = list_bytes(result) + result.texel_covers.size() * sizeof(depth_time_range<float>);
}

} // namespace gnomon::evaluation
