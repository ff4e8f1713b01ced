#include "range_maps.hpp"

#include "evaluation/core/timing.hpp"
#include "light_receivers.hpp"
#include "renderer/raster/moving_rasterizer.hpp"

#include <gnomon/motion/range/range_cover.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using range = depth_time_range<float>;

range_shadow_map rasterized(std::string method, const moving_scene& world, const moving_camera& light, int resolution,
                            const range_options& how)
{
    range_shadow_map result{{std::move(method), "20 B ranges", resolution}};
    range_rasterizer rasterize;
    const range_lists* lists = nullptr;
    result.build_ms = 1e3 * least_seconds([&] { lists = &rasterize(world, light, resolution, resolution, how); });
    result.first = lists->first, result.ranges = lists->ranges;
    result.pairs = lists->counts.pairs;
    result.resolved = how.resolved;
    result.bytes = list_bytes(result);
    return result;
}

// From one of a list on, as many as are pieces of one range of a triangle that was cut: each begins when the one before
// ends, bit for bit. As one range, from the nearest depth of all of them to the farthest.
struct uncut_range {
    std::size_t pieces;
    range whole;
};

uncut_range uncut(std::span<const range> list)
{
    uncut_range result{1, list[0]};
    range& whole = result.whole;
    for (; result.pieces < list.size(); ++result.pieces) {
        const range& next = list[result.pieces];
        if (next.id != whole.id || next.t0 != whole.t1) break;
        const float nearest = std::min({whole.z0, whole.z1, next.z0, next.z1}),
                    farthest = std::max({whole.z0, whole.z1, next.z0, next.z1});
        whole = {whole.t0, next.t1, nearest, farthest, whole.id};
    }
    return result;
}

uncut_range cover_of(std::span<const range> list)
{
    range_cover<float> state = range_cover_begin(1.f);
    uncut_range best{0, range_empty(-1.f)};
    for (std::size_t i = 0; i < list.size();) {
        const uncut_range some = uncut(list.subspan(i));
        state = range_cover_add(state, some.whole);
        if (state.best.id == some.whole.id && state.best.z0 == some.whole.z0 && state.best.z1 == some.whole.z1)
            best = some;
        i += some.pieces;
    }
    best.whole = range_cover_end(state);
    return best;
}

// Calls keep(cover, list) for each texel, in order, which adds to the ranges.
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
    result.bytes = list_bytes(result) + result.texel_covers.size() * sizeof(range);
}

void add_visible(const range& cover, std::span<const range> list, std::vector<range>& to)
{
    for (const range& r : list)
        if (range_cover_occludes(cover, r) == 0) to.push_back(r);
}

} // namespace

std::size_t texels_of(int resolution)
{
    return range_map<float>::texels(std::size_t(resolution), std::size_t(resolution));
}

std::size_t list_bytes(const range_shadow_map& m)
{
    return m.first.size() * sizeof m.first[0] + m.ranges.size() * sizeof(range);
}

std::span<const range> list_of(const range_shadow_map& m, std::size_t texel)
{
    return std::span(m.ranges).subspan(m.first[texel], m.first[texel + 1] - m.first[texel]);
}

range_shadow_map exact_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("exact ranges", world, light, resolution, {.depth_tolerance = depth_tolerance});
}

range_shadow_map resolved_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("resolved ranges", world, light, resolution,
                      {.resolved = true, .depth_tolerance = depth_tolerance});
}

range_shadow_map joined_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("resolved ranges, joined", world, light, resolution,
                      {.resolved = true, .depth_tolerance = depth_tolerance, .joining = depth_tolerance});
}

range_shadow_map caster_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("caster ranges", world, light, resolution,
                      {.resolved = true, .backdrops = false, .depth_tolerance = depth_tolerance});
}

range_shadow_map with_totals(range_shadow_map resolved)
{
    resolved.method += " with totals", resolved.format += ", 16 B totals";
    resolved.totals.resize(texels_of(resolved.resolution));
    resolved.build_ms +=
        1e3 * least_seconds([&] { set_summaries(resolved.map(), std::span(resolved.totals), range_ids::surfaces); });
    resolved.bytes += resolved.totals.size() * sizeof resolved.totals[0];
    return resolved;
}

range_shadow_map with_ids(range_shadow_map by_triangles, std::span<const std::uint32_t> id_of_triangle)
{
    std::vector<range> renamed;
    by_triangles.build_ms += 1e3 * least_seconds([&] {
                                 renamed = by_triangles.ranges;
                                 for (range& r : renamed)
                                     if (r.id >= 0) r.id = float(id_of_triangle[std::size_t(r.id)]);
                             });
    by_triangles.method += ", ids of surfaces";
    by_triangles.ranges = std::move(renamed);
    return by_triangles;
}

range_shadow_map covered_ranges(const range_shadow_map& exact)
{
    range_shadow_map result{{"exact ranges with coverage", "20 B ranges", exact.resolution}};
    cover(exact, result, [&](const uncut_range& found, std::span<const range> list) {
        add_visible(found.whole, list, result.ranges);
    });
    return result;
}

range_shadow_map cover_first_ranges(const range_shadow_map& exact)
{
    range_shadow_map result{{"exact ranges, cover first", "20 B ranges, 20 B covers", exact.resolution}};
    cover(exact, result, [&](const uncut_range& found, std::span<const range> list) {
        const bool stands_for_all = found.whole.id >= 0 && found.pieces == 1;
        result.texel_covers.push_back(stands_for_all ? found.whole : range_empty(-1.f));
        if (!stands_for_all) add_visible(found.whole, list, result.ranges);
    });
    return result;
}

compact_shadow_map compact_ranges(const range_shadow_map& resolved)
{
    compact_shadow_map result{{resolved.method + ", packed", "10 B spans", resolved.resolution}};
    const double spent = least_seconds([&] {
        const std::size_t room = compact_capacity(resolved.map()), texels = texels_of(resolved.resolution);
        result.begins.resize(room), result.bodies.resize(room);
        result.groups.resize((texels + compact_spans::group - 1) / compact_spans::group), result.lists.resize(texels);
        const compact_memory memory{result.begins, result.bodies, result.groups, result.lists};
        const std::size_t used = gnomon::compact_ranges(resolved.map(), memory).begins.size();
        result.begins.resize(used), result.bodies.resize(used);
    });
    result.totals = resolved.totals;
    if (!result.totals.empty()) result.format += ", 16 B totals";
    result.build_ms = resolved.build_ms + 1e3 * spent;
    result.pairs = resolved.pairs;
    result.bytes = result.map().spans.bytes() + result.totals.size() * sizeof(range_summary<float>);
    return result;
}

} // namespace gnomon::evaluation
