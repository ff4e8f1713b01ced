#include "accumulation.hpp"

#include "renderer/raster/rasterizer.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/motion/receiver/moving_receiver.h>
#include <gnomon/passes/range/map.hpp>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using pack = accumulation_pack;
using whole_pack = xsimd::batch<std::int32_t>;
static_assert(sizeof(pack) == sizeof(whole_pack));

constexpr float cleared = 1; // depth of a texel without a surface: in front of nothing

void fetch([[maybe_unused]] const float* from)
{
#ifdef __GNUC__
    __builtin_prefetch(from);
#endif
}

std::size_t whole_packs(std::size_t count) { return (count + pack::size - 1) / pack::size * pack::size; }

// A row or column of texels that a look-up reads: its place in the map, and its weight, 0 outside of the map.
struct tap_line {
    pack place, weight;
};

tap_line line_of(const pack& place, const pack& weight, const pack& last)
{
    const pack within = gnomon_max(gnomon_min(place, last), pack(0.f)); // of NaN, 0
    return {within, gnomon_select(within == place, weight, pack(0.f))};
}

// The middle of K + 1 lines is at the place.
template <int K> std::array<tap_line, K + 1> lines_of(const pack& place, const pack& last)
{
    const pack first = place - pack(0.5f * K), line = texel_below(first), share = first - line;
    std::array<tap_line, K + 1> result;
    for (int i = 0; i <= K; ++i) {
        const auto k = float(i);
        result[std::size_t(i)] = line_of(line + pack(k), texel_weight(share, k, float(K)), last);
    }
    return result;
}

template <int K>
pack visibility_of(const float* depths, int resolution, const pack& x, const pack& y, const pack& depth)
{
    const pack last(float(resolution - 1));
    const auto columns = lines_of<K>(x, last), rows = lines_of<K>(y, last);
    auto state = percentage_closer_begin(depth);
    for (const tap_line& j : rows)
        for (const tap_line& i : columns) {
            const whole_pack texel = xsimd::to_int(j.place) * whole_pack(resolution) + xsimd::to_int(i.place);
            state = percentage_closer_add(state, pack::gather(depths, texel), i.weight * j.weight);
        }
    return pack(1.f) - percentage_closer_end(state);
}

template <int K>
void look_up(const accumulated_maps& maps, std::span<const accumulated_receivers> receivers, float* visibility)
{
    for (std::size_t m = 0; m < receivers.size(); ++m) {
        const accumulated_receivers& some = receivers[m];
        const float* depths = maps.depths[m].pixels.data()->data();
        for (std::size_t i = 0; i < some.x.size(); i += pack::size, visibility += pack::size)
            visibility_of<K>(depths, maps.resolution, pack::load_unaligned(&some.x[i]),
                             pack::load_unaligned(&some.y[i]), pack::load_unaligned(&some.depth[i]))
                .store_unaligned(visibility);
    }
}

} // namespace

std::vector<float> middle_times(int count)
{
    std::vector<float> result;
    for (int i = 0; i < count; ++i) result.push_back((float(i) + 0.5f) / float(count));
    return result;
}

accumulated_maps accumulate(const moving_scene& world, const moving_camera& light, int resolution,
                            std::vector<float> times)
{
    accumulated_maps maps{resolution, std::move(times), {}};
    for (const float t : maps.times)
        maps.depths.push_back(rasterize_depth<1>(scene_at(world, t), light.at(double(t)), resolution, resolution));
    return maps;
}

seen_motion seen_at_times(const seen_motion& seen, std::span<const float> times)
{
    seen_motion result{seen.width, seen.height, {0}, {}};
    for (std::size_t pixel = 0; pixel + 1 < seen.first.size(); ++pixel) {
        const auto segments = seen(pixel);
        for (const float t : times) {
            const auto c = std::ranges::find_if(segments, [&](const seen_segment& some) { return t < some.t1; });
            if (c == segments.end() || t < c->t0) continue;
            const float passed = (t - c->t0) / (c->t1 - c->t0);
            const glm::vec3 p = glm::mix(c->p0, c->p1, passed), n = glm::normalize(glm::mix(c->n0, c->n1, passed));
            result.segments.push_back({t, t, 1 / float(times.size()), c->triangle, p, p, n, n});
        }
        result.first.push_back(std::uint32_t(result.segments.size()));
    }
    return result;
}

std::vector<accumulated_receivers> accumulated_receivers_of(const seen_motion& at_times, const moving_camera& light,
                                                            const accumulated_maps& maps)
{
    const std::vector<light_receiver> all = light_receivers_of(at_times, light, maps.resolution);
    std::vector<accumulated_receivers> result(maps.depths.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const light_receiver& r = all[i];
        if (!(r.facing.begin < r.facing.end)) continue;
        const float t = r.path.depth.t0;
        accumulated_receivers& to = result[std::size_t(std::ranges::lower_bound(maps.times, t) - maps.times.begin())];
        const texel_position<float> at = receiver_path_at(r.path, t);
        to.x.push_back(at.x), to.y.push_back(at.y), to.depth.push_back(std::min(r.path.depth.z0, cleared));
        to.segment.push_back(std::uint32_t(i));
    }
    for (accumulated_receivers& some : result)
        for (std::vector<float>* member : {&some.x, &some.y, &some.depth}) member->resize(whole_packs(member->size()));
    return result;
}

void accumulated_visibility(const accumulated_maps& maps, std::span<const accumulated_receivers> receivers,
                            std::vector<float>& visibility, int look_ups)
{
    std::size_t room = 0;
    for (const accumulated_receivers& some : receivers) room += some.x.size();
    visibility.resize(room);
    if (look_ups == 1) look_up<1>(maps, receivers, visibility.data());
    else if (look_ups == 3) look_up<3>(maps, receivers, visibility.data());
    else throw std::invalid_argument(fmt::format("accumulation: {} look-ups, 1 and 3 are possible", look_ups));
}

std::vector<float> in_order_of_segments(std::span<const accumulated_receivers> receivers,
                                        std::span<const float> visibility, std::size_t segments)
{
    std::vector<float> result(segments);
    for (const accumulated_receivers& some : receivers) {
        for (std::size_t i = 0; i < some.segment.size(); ++i) result[some.segment[i]] = visibility[i];
        visibility = visibility.subspan(some.x.size());
    }
    return result;
}

std::size_t interleaved_maps::depths_per_texel() const { return whole_packs(std::size_t(count)); }

interleaved_maps interleave(const accumulated_maps& maps)
{
    interleaved_maps result{maps.resolution, int(maps.depths.size()), {}};
    const std::size_t size = std::size_t(maps.resolution), each = result.depths_per_texel();
    result.depths.resize(range_map<float>::texels(size, size) * each, cleared);
    tbb::parallel_for(std::size_t(0), size, [&](std::size_t row) {
        for (std::size_t column = 0; column < size; ++column) {
            float* to = &result.depths[range_map<float>::texel(size, column, row) * each];
            for (const auto& map : maps.depths) *to++ = map.pixels[row * size + column][0];
        }
    });
    return result;
}

void static_visibility(const interleaved_maps& maps, std::span<const static_place> receivers,
                       std::span<float> visibility)
{
    // Some are fetched before any of them is read, since maps do not fit into a cache.
    constexpr std::size_t at_once = 32, taps = 4;
    struct tap {
        const float* depths;
        float weight;
    };
    const std::size_t size = std::size_t(maps.resolution), each = maps.depths_per_texel();
    std::array<std::array<tap, taps>, at_once> fetched;
    std::array<std::size_t, at_once> counts;
    for (std::size_t first = 0; first < receivers.size(); first += at_once) {
        const auto some = receivers.subspan(first, std::min(at_once, receivers.size() - first));
        for (std::size_t i = 0; i < some.size(); ++i) {
            counts[i] = 0;
            for_each_tap({some[i].x, some[i].y}, [&](float column, float row, float weight) {
                if (!(column >= 0 && row >= 0 && column < float(size) && row < float(size))) return;
                const std::size_t texel = range_map<float>::texel(size, std::size_t(column), std::size_t(row));
                const float* depths = &maps.depths[texel * each];
                for (std::size_t m = 0; m < each; m += pack::size) fetch(depths + m);
                fetched[i][counts[i]++] = {depths, weight};
            });
        }
        for (std::size_t i = 0; i < some.size(); ++i) {
            pack shadowed(0.f);
            const pack depth(std::min(some[i].depth, cleared));
            for (const tap& t : std::span(fetched[i]).first(counts[i]))
                for (std::size_t m = 0; m < each; m += pack::size)
                    shadowed += gnomon_select(pack::load_unaligned(t.depths + m) < depth, pack(t.weight), pack(0.f));
            std::array<float, pack::size> sums;
            shadowed.store_unaligned(sums.data());
            float sum = 0;
            for (const float x : sums) sum += x;
            visibility[first + i] = 1 - saturate_or_zero(sum / float(maps.count));
        }
    }
}

} // namespace gnomon::evaluation
