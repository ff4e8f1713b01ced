#include "evaluation/core/timing.hpp"
#include "prism_rasterizer.hpp"
#include "range_maps.hpp"

#include <gnomon/comparators/three_pass_cover.h>
#include <gnomon/motion/range/range_cover.h>

#include <algorithm>
#include <array>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using pack = prism_pack;
using lanes = std::array<float, pack::size>;

// Ranges in the order of triangles, each with its texel.
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

depth_time_range<float> range_in_lane(const depth_time_range<pack>& r, std::size_t i)
{
    return {r.t0.get(i), r.t1.get(i), r.z0.get(i), r.z1.get(i), r.id.get(i)};
}

bool between_planes(const depth_time_range<float>& r)
{
    return !(r.z0 <= -1 && r.z1 <= -1) && !(r.z0 >= 1 && r.z1 >= 1);
}

// The ranges of all prisms in the texels that are kept. Returns how many fragments these have.
template <class Keep> std::size_t add_prism_ranges(const prism_rasterizer& prisms, const Keep& keep, loose_ranges& to)
{
    std::size_t count = 0;
    prisms.for_each_pack([&](std::uint32_t number, std::uint32_t place, const auto& fragments) {
        prism_pair<pack> pair = prism_pair_begin(pack(float(number)));
        for (const prism_fragment<pack>& f : fragments) pair = prism_pair_add(pair, f);
        const auto found = prism_pair_end(pair);
        lanes fragment_counts;
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

// Calls visit(texel, fragment) for each.
template <class Visit> void for_each_fragment(const prism_rasterizer& prisms, const Visit& visit)
{
    prisms.for_each_pack([&](std::uint32_t number, std::uint32_t place, const auto& fragments) {
        for (const prism_fragment<pack>& f : fragments) {
            lanes covered, time, depth;
            f.covered.store_unaligned(covered.data());
            f.time.store_unaligned(time.data()), f.depth.store_unaligned(depth.data());
            for (std::uint32_t i = 0; i < pack::size; ++i)
                if (covered[i] > 0)
                    visit(prisms.texel(place + i), timed_fragment<float>{time[i], depth[i], float(number)});
        }
    });
}

} // namespace

range_shadow_map prism_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    range_shadow_map result{{"prism ranges", "20 B ranges", resolution}};
    loose_ranges found;
    std::size_t fragments = 0;
    result.build_ms = 1e3 * least_seconds([&] {
                          found.texels.clear(), found.ranges.clear();
                          fragments = add_prism_ranges(
                              {world, light, resolution}, [](std::uint32_t) { return true; }, found);
                          found.into(result);
                      });
    result.pairs = found.ranges.size();
    result.bytes = list_bytes(result);
    result.building_bytes =
        std::size_t(prism_map_bytes(double(fragments), double(found.ranges.size()), double(texels_of(resolution))));
    return result;
}

range_shadow_map covered_prism_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    range_shadow_map result{{"prism ranges with coverage", "20 B ranges", resolution}};
    const std::size_t texels = texels_of(resolution);
    loose_ranges found;
    std::vector<timed_fragment<float>> nearest;
    std::vector<fragment_cover<float>> states;
    std::size_t fragments = 0;
    result.build_ms =
        1e3 * least_seconds([&] {
            const prism_rasterizer prisms(world, light, resolution);
            nearest.assign(texels, nearest_fragment_begin(1.f));
            for_each_fragment(
                prisms, [&](std::uint32_t i, const auto& f) { nearest[i] = nearest_fragment_add(nearest[i], f); });
            states.resize(texels);
            std::ranges::transform(nearest, states.begin(), [](const auto& f) { return fragment_cover_begin(f); });
            for_each_fragment(prisms,
                              [&](std::uint32_t i, const auto& f) { states[i] = fragment_cover_add(states[i], f); });
            found.texels.clear(), found.ranges.clear(), result.covers = 0;
            std::vector<bool> covered(texels);
            for (std::uint32_t i = 0; i < texels; ++i) {
                const auto cover = fragment_cover_end(states[i]);
                covered[i] = cover.id >= 0;
                if (!covered[i]) continue;
                ++result.covers;
                found.texels.push_back(i), found.ranges.push_back(cover);
            }
            fragments = add_prism_ranges(
                prisms, [&](std::uint32_t i) { return !covered[i]; }, found);
            found.into(result);
        });
    result.pairs = found.ranges.size();
    // A cover is in the coverage map, by its id, and in the nearest map with the depths of its ends.
    constexpr std::size_t cover_bytes = 4 * sizeof(float);
    result.bytes = list_bytes(result);
    result.building_bytes =
        std::size_t(prism_map_bytes(double(fragments), double(found.ranges.size() - result.covers), double(texels))) +
        cover_bytes * texels;
    return result;
}

} // namespace gnomon::evaluation
