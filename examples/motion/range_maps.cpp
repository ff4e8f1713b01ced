#include "range_maps.hpp"

#include <fmt/format.h>
#include <gnomon/motion/coverage_map.h>
#include <gnomon/motion/range_list.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <utility>

#include "packed_spans.hpp"
#include "prism_rasterizer.hpp"
#include "timing.hpp"
#include "toolbox/moving_rasterizer.hpp"

namespace gnomon::demo {

using namespace toolbox;

namespace {

using pack = prism_pack;
using lanes = std::array<float, pack::size>;

constexpr std::size_t range_bytes = sizeof(depth_time_range<float>), head_bytes = sizeof(std::uint32_t);

// The least of several times, two at least: the first run has to ask the system for memory, and what is short is the
// more disturbed by others.
double steady_ms(auto&& run)
{
    constexpr double enough = 0.2;
    double spent = seconds_on_one_core(run), least = spent;
    do {
        const double again = seconds_on_one_core(run);
        spent += again, least = std::min(least, again);
    } while (spent < enough);
    return 1e3 * least;
}

range_shadow_map empty_map(std::string method, std::string format, int resolution)
{
    range_shadow_map result;
    result.method = std::move(method), result.format = std::move(format), result.resolution = resolution;
    return result;
}

std::size_t texels_of(int resolution)
{
    return range_map<float>::texels(std::size_t(resolution), std::size_t(resolution));
}

std::size_t list_bytes(const range_shadow_map& m)
{
    return m.first.size() * head_bytes + m.ranges.size() * range_bytes;
}

std::span<const depth_time_range<float>> list_of(const range_shadow_map& m, std::size_t texel)
{
    return std::span(m.ranges).subspan(m.first[texel], m.first[texel + 1] - m.first[texel]);
}

range_shadow_map rasterized(std::string method, const moving_scene& world, const moving_camera& light, int resolution,
                            const range_options& how)
{
    range_shadow_map result = empty_map(std::move(method), "20 B ranges", resolution);
    range_rasterizer rasterize;
    const range_lists* lists = nullptr;
    result.build_ms = steady_ms([&] { lists = &rasterize(world, light, resolution, resolution, how); });
    result.first = lists->first, result.ranges = lists->ranges;
    result.pairs = lists->counts.pairs;
    result.resolved = how.resolved;
    result.bytes = list_bytes(result);
    return result;
}

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
                    visit(prisms.texel(place + i), moment_fragment<float>{time[i], depth[i], float(number)});
        }
    });
}

// The lists of some texels, a pack of them at a time.
template <int N> struct listed_texels {
    std::vector<depth_time_range<float>> ranges;
    std::vector<std::uint32_t> counts;
    double spent = 0, time_added = 0, depth_added = 0;
    float most_time_added = 0, most_depth_added = 0;

    void add(const range_map<float>& from, std::size_t texel)
    {
        std::array<std::span<const depth_time_range<float>>, pack::size> lists;
        std::size_t longest = 0;
        for (std::size_t i = 0; i < pack::size; ++i) {
            lists[i] = from[texel + i];
            longest = std::max(longest, lists[i].size());
        }
        if (longest == 0) {
            counts.insert(counts.end(), pack::size, 0);
            return;
        }
        range_list<pack, N> list = range_list_of<pack, N>(range_empty(pack(0.f)));
        for (std::size_t k = 0; k < longest; ++k) {
            std::array<lanes, 5> r;
            for (std::size_t i = 0; i < pack::size; ++i) {
                const auto one = k < lists[i].size() ? lists[i][k] : range_empty(0.f);
                r[0][i] = one.t0, r[1][i] = one.t1, r[2][i] = one.z0, r[3][i] = one.z1, r[4][i] = one.id;
            }
            const auto packed = [&](std::size_t member) { return pack::load_unaligned(r[member].data()); };
            list = range_list_insert(list, {packed(0), packed(1), packed(2), packed(3), packed(4)});
        }
        list = range_list_resolve(list);
        for (std::size_t i = 0; i < pack::size; ++i) {
            const std::size_t before = ranges.size();
            for (int k = 0; k < N; ++k) {
                const auto span = range_in_lane(list.ranges[k], i);
                if (span.t0 < span.t1) ranges.push_back(span);
            }
            counts.push_back(std::uint32_t(ranges.size() - before));
            const float time = list.time_added.get(i), depth = list.depth_added.get(i);
            time_added += double(time), depth_added += double(depth);
            most_time_added = std::max(most_time_added, time), most_depth_added = std::max(most_depth_added, depth);
        }
    }
};

template <int N> range_shadow_map listed(const range_shadow_map& exact)
{
    range_shadow_map result =
        empty_map(fmt::format("interval lists of {}", N), fmt::format("{} x 20 B + 8 B", N), exact.resolution);
    const range_map<float> from = exact.map();
    constexpr std::size_t chunk = range_map<float>::texels_per_tile;
    static_assert(chunk % pack::size == 0);
    const std::size_t texels = from.first.size() - 1;
    std::vector<listed_texels<N>> chunks((texels + chunk - 1) / chunk);
    tbb::parallel_for(std::size_t(0), chunks.size(), [&](std::size_t c) {
        chunks[c].spent = seconds([&] {
            for (std::size_t i = c * chunk; i < std::min((c + 1) * chunk, texels); i += pack::size)
                chunks[c].add(from, i);
        });
    });
    result.first = {0};
    double time_added = 0, depth_added = 0;
    result.build_ms = exact.build_ms;
    for (const listed_texels<N>& some : chunks) {
        for (const std::uint32_t count : some.counts) result.first.push_back(result.first.back() + count);
        result.ranges.insert(result.ranges.end(), some.ranges.begin(), some.ranges.end());
        result.build_ms += 1e3 * some.spent;
        time_added += some.time_added, depth_added += some.depth_added;
        result.most_time_added = std::max(result.most_time_added, some.most_time_added);
        result.most_depth_added = std::max(result.most_depth_added, some.most_depth_added);
    }
    result.mean_time_added = float(time_added / double(texels));
    result.mean_depth_added = float(depth_added / double(texels));
    result.bytes = texels * (std::size_t(N) * range_bytes + 2 * sizeof(float));
    result.pairs = exact.pairs;
    result.resolved = true;
    return result;
}

} // namespace

range_shadow_map exact_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("exact ranges", world, light, resolution, {.depth_tolerance = depth_tolerance});
}

range_shadow_map resolved_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    return rasterized("resolved ranges", world, light, resolution,
                      {.resolved = true, .depth_tolerance = depth_tolerance});
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
        steady_ms([&] { set_totals(resolved.map(), std::span(resolved.totals), range_ids::surfaces); });
    resolved.bytes += resolved.totals.size() * sizeof resolved.totals[0];
    return resolved;
}

range_shadow_map packed_ranges(const range_shadow_map& resolved)
{
    range_shadow_map result = empty_map(resolved.method + ", packed", "10 B spans", resolved.resolution);
    const std::size_t texels = texels_of(resolved.resolution);
    packed_spans spans;
    const double ms = steady_ms([&] {
        spans.clear();
        for (std::size_t i = 0; i < texels; ++i) pack_spans(list_of(resolved, i), spans);
    });
    for (std::size_t i = 0; i < texels; ++i) {
        result.first.push_back(std::uint32_t(result.ranges.size()));
        unpack_spans(spans, i, result.ranges);
    }
    result.first.push_back(std::uint32_t(result.ranges.size()));
    result.build_ms = resolved.build_ms + ms;
    result.pairs = resolved.pairs;
    result.resolved = true;
    result.bytes = spans.bytes();
    return result;
}

range_shadow_map covered_ranges(const range_shadow_map& exact)
{
    range_shadow_map result = empty_map("exact ranges with coverage", "20 B ranges", exact.resolution);
    const std::size_t texels = texels_of(exact.resolution);
    const double ms = steady_ms([&] {
        result.first.clear(), result.ranges.clear(), result.covers = 0;
        for (std::size_t i = 0; i < texels; ++i) {
            result.first.push_back(std::uint32_t(result.ranges.size()));
            const auto list = list_of(exact, i);
            range_cover<float> state = range_cover_begin(1.f);
            for (const auto& r : list) state = range_cover_add(state, r);
            const auto cover = range_cover_end(state);
            result.covers += cover.id >= 0;
            for (const auto& r : list)
                if (range_cover_hides(cover, r) == 0) result.ranges.push_back(r);
        }
        result.first.push_back(std::uint32_t(result.ranges.size()));
    });
    result.build_ms = exact.build_ms + ms;
    result.pairs = exact.pairs;
    result.bytes = list_bytes(result);
    return result;
}

range_shadow_map prism_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    range_shadow_map result = empty_map("prism ranges", "16 B fragments, 24 B ranges", resolution);
    loose_ranges found;
    std::size_t fragments = 0;
    result.build_ms = steady_ms([&] {
        found.texels.clear(), found.ranges.clear();
        fragments = add_prism_ranges(
            {world, light, resolution}, [](std::uint32_t) { return true; }, found);
        found.into(result);
    });
    result.pairs = found.ranges.size();
    result.bytes =
        std::size_t(prism_map_bytes(double(fragments), double(found.ranges.size()), double(texels_of(resolution))));
    return result;
}

range_shadow_map covered_prism_ranges(const moving_scene& world, const moving_camera& light, int resolution)
{
    range_shadow_map result = empty_map("prism ranges with coverage", "16 B fragments, 24 B ranges", resolution);
    const std::size_t texels = texels_of(resolution);
    loose_ranges found;
    std::vector<moment_fragment<float>> nearest;
    std::vector<fragment_cover<float>> states;
    std::size_t fragments = 0;
    result.build_ms = steady_ms([&] {
        const prism_rasterizer prisms(world, light, resolution);
        nearest.assign(texels, nearest_fragment_begin(1.f));
        for_each_fragment(prisms,
                          [&](std::uint32_t i, const auto& f) { nearest[i] = nearest_fragment_add(nearest[i], f); });
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
    result.bytes =
        std::size_t(prism_map_bytes(double(fragments), double(found.ranges.size() - result.covers), double(texels))) +
        cover_bytes * texels;
    return result;
}

range_shadow_map interval_lists(const range_shadow_map& exact, int capacity)
{
    switch (capacity) {
        case 4:
            return listed<4>(exact);
        case 8:
            return listed<8>(exact);
        case 16:
            return listed<16>(exact);
        default:
            throw std::invalid_argument(fmt::format("interval lists: capacity {}, 4, 8 and 16 are possible", capacity));
    }
}

} // namespace gnomon::demo
