// Ranges of prisms in the order of triangles, each with its texel, as maps by prisms collect them.
#pragma once

#include "evaluation/motion/range_maps.hpp"
#include "prism_rasterizer.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::evaluation {

struct loose_ranges {
    std::vector<std::uint32_t> texels;
    std::vector<depth_time_range<float>> ranges;

    void into(range_shadow_map& m) const
    {
        m.first.resize(texels_of(m.resolution) + 1);
        m.ranges.resize(ranges.size());
        sort_into_lists<float>(texels, ranges, m.first, m.ranges);
    }
};

inline depth_time_range<float> range_in_lane(const depth_time_range<prism_pack>& r, std::size_t i)
{
    return {r.t0.get(i), r.t1.get(i), r.z0.get(i), r.z1.get(i), r.id.get(i)};
}

inline bool between_planes(const depth_time_range<float>& r)
{
    return !(r.z0 <= -1 && r.z1 <= -1) && !(r.z0 >= 1 && r.z1 >= 1);
}

// The ranges of all prisms in the texels that are kept. Returns how many fragments these have.
template <class Keep> std::size_t add_prism_ranges(const prism_rasterizer& prisms, const Keep& keep, loose_ranges& to)
{
    using pack = prism_pack;
    std::size_t count = 0;
    prisms.for_each_pack([&](std::uint32_t number, std::uint32_t place, const auto& fragments) {
        prism_pair<pack> pair = prism_pair_begin(pack(float(number)));
        for (const prism_fragment<pack>& f : fragments) pair = prism_pair_add(pair, f);
        const auto found = prism_pair_end(pair);
        std::array<float, pack::size> fragment_counts;
        pair.count.store_unaligned(fragment_counts.data());
        for (std::uint32_t i = 0; i < pack::size; ++i) {
            if (!(fragment_counts[i] > 0)) continue;
            const std::uint32_t texel = prisms.texel(place + i);
            if (!keep(texel)) continue;
            count += std::size_t(fragment_counts[i]);
            for (const auto& r : {range_in_lane(found.first, i), range_in_lane(found.second, i)})
                if (r.t0 <= r.t1 && between_planes(r)) to.texels.push_back(texel), to.ranges.push_back(r);
        }
    });
    return count;
}

} // namespace gnomon::evaluation
