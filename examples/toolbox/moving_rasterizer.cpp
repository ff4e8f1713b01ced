#include "moving_rasterizer.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <gnomon/passes/resolve.hpp>
#include <stdexcept>

#include "moving_tiles.hpp"

namespace gnomon::toolbox {

namespace {

// Ranges as they come, each with its texel in the picture.
struct loose_ranges {
    std::vector<std::uint32_t> texels;
    std::vector<depth_time_range<float>> ranges;

    std::size_t size() const { return texels.size(); }
    void add(std::uint32_t texel, const depth_time_range<float>& r)
    {
        texels.push_back(texel);
        ranges.push_back(r);
    }
    void cut_to(std::size_t size) { texels.resize(size), ranges.resize(size); }
};

// A tile's part of the loose ranges of a thread.
struct tile_part {
    const loose_ranges* of = nullptr;
    std::size_t begin = 0, end = 0;
};

// What one thread needs, tile after tile.
struct thread_state {
    loose_ranges loose;
    range_counts counts;
    std::vector<std::uint32_t> inside, first;
    std::vector<depth_time_range<float>> lists;
    std::vector<visible_span<float>> spans;
};

// The loose ranges from begin on, all of one tile, become what of them is in front.
void resolve(thread_state& t, const moving_tile& where, std::size_t begin)
{
    constexpr std::uint32_t texels = moving_tile_size * moving_tile_size;
    const auto inside = [&](std::uint32_t texel) {
        const auto width = std::uint32_t(where.picture_width);
        return (texel / width - std::uint32_t(where.corner.y)) * moving_tile_size + texel % width -
               std::uint32_t(where.corner.x);
    };
    t.inside.assign(t.loose.texels.begin() + std::ptrdiff_t(begin), t.loose.texels.end());
    std::ranges::transform(t.inside, t.inside.begin(), inside);
    t.first.resize(texels + 1);
    t.lists.resize(t.inside.size());
    sort_into_lists<float>(t.inside, std::span(t.loose.ranges).subspan(begin), t.first, t.lists);
    t.loose.cut_to(begin);
    for (std::uint32_t i = 0; i < texels; ++i) {
        const auto list =
            std::span<const depth_time_range<float>>(t.lists).subspan(t.first[i], t.first[i + 1] - t.first[i]);
        if (list.empty()) continue;
        t.spans.resize(std::max(t.spans.size(), resolve_capacity(list.size())));
        const std::uint32_t texel = where.texel({int(i) % moving_tile_size, int(i) / moving_tile_size});
        for (const visible_span<float>& s : resolve_ranges<float>(list, t.spans)) t.loose.add(texel, range_of(list, s));
    }
}

// A range whose depth is further from its line than the tolerance, in pieces (Palmer 2011, chapter 5).
void add_pieces(const depth_time_range<float>& whole, const moving_triangle<float>& depths,
                const moving_edges<float>& edges, float tolerance, std::uint32_t texel, loose_ranges& to)
{
    for (float passed = 0; passed < 1;) {
        const depth_piece<float> piece = moving_depth_piece(depths, edges, whole.t0, whole.t1, passed, 0.f, tolerance);
        passed = piece.passed;
        if (piece.t0 < piece.t1) to.add(texel, {piece.t0, piece.t1, piece.z0, piece.z1, whole.id});
    }
}

// What depth is computed from: linear depths, and weights that say whether a corner is in front of the eye.
template <class Real> moving_triangle<Real> depths_of(const moving_triangle<double>& m)
{
    const auto vertex = [](const moving_vertex<double>& v) {
        const auto real = [](double x) { return Real(static_cast<float>(x)); };
        return moving_vertex<Real>{Real(0), Real(0), real(v.z0), real(v.w0), Real(0), Real(0), real(v.z1), real(v.w1)};
    };
    return {vertex(m.a), vertex(m.b), vertex(m.c)};
}

// Whether a range is between the planes at all; depths are limited to theirs.
bool between_planes(float z0, float z1) { return !(z0 <= -1 && z1 <= -1) && !(z0 >= 1 && z1 >= 1); }

moving_edges<float> edges_in_lane(const moving_edges<texel_pack>& e, std::size_t lane)
{
    const auto packs = std::bit_cast<std::array<texel_pack, 9>>(e);
    std::array<float, 9> result;
    std::ranges::transform(packs, result.begin(), [&](const texel_pack& x) { return x.get(lane); });
    return std::bit_cast<moving_edges<float>>(result);
}

// The texels of one triangle in one tile.
void add_ranges(const moving_setup& s, const moving_tile& where, float tolerance, thread_state& out)
{
    const tile_triangle triangle(s, where);
    const moving_triangle<texel_pack> depths = depths_of<texel_pack>(s.corners);
    triangle.for_each_pack([&](const glm::ivec2& block, int begin, const moving_edges<texel_pack>& edges) {
        out.counts.tested += texel_pack::size;
        for (const float facing : {1.f, -1.f}) {
            if (!(facing > 0 ? s.positive : s.negative)) continue;
            const coverage_times<texel_pack> times = moving_coverage(edges, texel_pack(facing));
            if (!gnomon_any(times.count > texel_pack(0.f))) continue;
            texel_lanes count, t0, t1, z0, z1;
            times.count.store_unaligned(count.data());
            const std::array<std::array<texel_pack, 2>, 4> intervals{{{times.begin0, times.end0},
                                                                      {times.begin1, times.end1},
                                                                      {times.begin2, times.end2},
                                                                      {times.begin3, times.end3}}};
            for (int k = 0; k < 4 && gnomon_any(times.count > texel_pack(float(k))); ++k) {
                const auto& [opening, closing] = intervals[std::size_t(k)];
                opening.store_unaligned(t0.data());
                closing.store_unaligned(t1.data());
                moving_triangle_linear_depth(depths, edges, opening).store_unaligned(z0.data());
                moving_triangle_linear_depth(depths, edges, closing).store_unaligned(z1.data());
                for (std::size_t i = 0; i < texel_pack::size; ++i) {
                    const glm::ivec2 at = tile_triangle::texel(block, begin + int(i));
                    if (!(count[i] > float(k)) || !triangle.contains(at) || !between_planes(z0[i], z1[i])) continue;
                    out.counts.pairs += k == 0;
                    const depth_time_range<float> whole{t0[i], t1[i], z0[i], z1[i], float(s.number)};
                    if (tolerance > 0)
                        add_pieces(whole, depths_of<float>(s.corners), edges_in_lane(edges, i), tolerance,
                                   where.texel(at), out.loose);
                    else out.loose.add(where.texel(at), whole);
                }
            }
        }
    });
}

// Of each sample the nearest triangle at its time; z0 is 1 where there is none.
void sample_instants(const moving_setup& s, const moving_tile& where, int samples,
                     std::vector<depth_time_range<float>>& nearest)
{
    const tile_triangle triangle(s, where);
    const moving_triangle<texel_pack> depths = depths_of<texel_pack>(s.corners);
    triangle.for_each_pack([&](const glm::ivec2& block, int begin, const moving_edges<texel_pack>& edges) {
        const auto instant = [&](std::size_t lane, int k) -> depth_time_range<float>* {
            const glm::ivec2 at = tile_triangle::texel(block, begin + int(lane));
            if (!triangle.contains(at)) return nullptr;
            return &nearest[std::size_t(where.texel(at)) * std::size_t(samples) + std::size_t(k)];
        };
        for (int k = 0; k < samples; ++k) {
            texel_lanes time{}, least, most, z;
            for (std::size_t i = 0; i < texel_pack::size; ++i)
                if (const auto* there = instant(i, k)) time[i] = there->t0;
            const texel_pack t = texel_pack::load_unaligned(time.data());
            const texel_pack a = moving_edge_at(edges.a, t), b = moving_edge_at(edges.b, t),
                             c = moving_edge_at(edges.c, t);
            gnomon_min(gnomon_min(a, b), c).store_unaligned(least.data());
            gnomon_max(gnomon_max(a, b), c).store_unaligned(most.data());
            moving_triangle_linear_depth(depths, edges, t).store_unaligned(z.data());
            for (std::size_t i = 0; i < texel_pack::size; ++i) {
                const bool covered =
                    (s.positive && least[i] >= 0 && most[i] > 0) || (s.negative && most[i] <= 0 && least[i] < 0);
                auto* there = covered ? instant(i, k) : nullptr;
                if (there && z[i] > -1 && z[i] < there->z0) {
                    there->z0 = there->z1 = z[i];
                    there->id = float(s.number);
                }
            }
        }
    });
}

// Evenly spread bits, for times that no two samples share.
float jitter(std::uint32_t sample)
{
    std::uint32_t x = sample * 0x9e3779b9u;
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) * 0x735a2d97u;
    return float((x ^ (x >> 15)) >> 8) * 0x1p-24f;
}

} // namespace

struct range_rasterizer::scratch {
    tbb::enumerable_thread_specific<thread_state> threads;
    std::vector<tile_part> parts;
};

range_rasterizer::range_rasterizer() : scratch_(std::make_unique<scratch>()) {}
range_rasterizer::~range_rasterizer() = default;

const range_lists& range_rasterizer::operator()(const moving_scene& world, const moving_camera& eye, int width,
                                                int height, const range_options& how)
{
    const tiled_triangles scenery(world, eye, width, height, how.visible);
    const std::size_t tiles = scenery.tiles();

    lists_.width = width, lists_.height = height, lists_.counts = {};
    lists_.first.assign(std::size_t(width) * std::size_t(height) + 1, 0);
    for (thread_state& t : scratch_->threads) t.loose.cut_to(0), t.counts = {};
    scratch_->parts.resize(tiles);
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t i) {
        thread_state& t = scratch_->threads.local();
        const moving_tile where = scenery.tile(i);
        const std::size_t before = t.loose.size();
        std::size_t budget = how.tile_budget;
        scenery.for_each(i, [&](const moving_setup& s) {
            add_ranges(s, where, how.depth_tolerance, t);
            if (t.loose.size() - before <= budget) return;
            ++t.counts.early_resolves;
            resolve(t, where, before);
            budget = std::max(budget, 2 * (t.loose.size() - before));
        });
        if (how.resolved) resolve(t, where, before);
        scratch_->parts[i] = {&t.loose, before, t.loose.size()};
        for (std::size_t k = before; k < t.loose.size(); ++k) ++lists_.first[t.loose.texels[k]];
    });
    begins_from_counts(lists_.first);
    lists_.ranges.resize(lists_.first.back());
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t i) {
        const tile_part& part = scratch_->parts[i];
        for (std::size_t k = part.begin; k < part.end; ++k)
            lists_.ranges[lists_.first[part.of->texels[k]]++] = part.of->ranges[k];
    });
    std::shift_right(lists_.first.begin(), lists_.first.end(), 1); // each list's end is where the next begins
    lists_.first[0] = 0;
    for (const thread_state& t : scratch_->threads) {
        lists_.counts.pairs += t.counts.pairs;
        lists_.counts.tested += t.counts.tested;
        lists_.counts.early_resolves += t.counts.early_resolves;
    }
    return lists_;
}

std::vector<depth_time_range<float>> rasterize_instants(const moving_scene& world, const moving_camera& eye, int width,
                                                        int height, int samples)
{
    if (samples < 1) throw std::invalid_argument("moving rasterizer: at least one sample is needed");
    const tiled_triangles scenery(world, eye, width, height, faces::both);
    std::vector<depth_time_range<float>> result(std::size_t(width) * std::size_t(height) * std::size_t(samples));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const auto stratum = float(i % std::size_t(samples));
        const float t = std::min((stratum + jitter(std::uint32_t(i))) / float(samples), 1.f);
        result[i] = {t, t, 1, 1, 0};
    }
    tbb::parallel_for(std::size_t(0), scenery.tiles(), [&](std::size_t i) {
        scenery.for_each(i, [&](const moving_setup& s) { sample_instants(s, scenery.tile(i), samples, result); });
    });
    return result;
}

std::size_t range_lists::bytes() const
{
    return first.size() * sizeof first[0] + ranges.size() * sizeof(depth_time_range<float>);
}

triangle_numbers::triangle_numbers(const scene& world) : begins_{0}
{
    for (const mesh& part : world.meshes)
        begins_.push_back(begins_.back() + static_cast<std::uint32_t>(part.triangles.size()));
}

triangle_place triangle_numbers::operator[](std::uint32_t number) const
{
    const auto next = std::upper_bound(begins_.begin(), begins_.end() - 1, number);
    const auto mesh = static_cast<std::uint32_t>(next - begins_.begin() - 1);
    return {mesh, number - begins_[mesh]};
}

} // namespace gnomon::toolbox
