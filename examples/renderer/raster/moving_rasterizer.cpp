#include "moving_rasterizer.hpp"

#include "moving_lists.hpp"
#include "tile_bins.hpp"

#include <gnomon/passes/range/join.hpp>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace gnomon::renderer {

namespace {

using map = range_map<float>;

constexpr std::size_t texels_per_tile = map::texels_per_tile, packs_per_tile = moving_samples::packs_per_tile;
// Ranges of a pack of texels from which on lists are long: resolving compares all ranges of a texel with one another.
constexpr std::size_t long_lists = 256 * texel_pack::size;

// The work of one tile.
struct tile_lists {
    tile_bins bins;
    texel_lists texels; // the lists of the pack of texels at hand
    range_counts counts;
    append_buffer<depth_time_range<float>> lists; // the finished lists, in the order of texels
    std::array<std::uint32_t, texels_per_tile> sizes;
};

// A triangle, the texels that it is tested against, and the lists that get its ranges.
//
// Most texels see a triangle once, in a line of depth: that case is inlined below. Functions for the other cases are
// kept out of line, and take packs by value: so the common case needs no memory for its registers' contents.
struct tile_query {
    const tile_triangle& triangle;
    const moving_samples& samples;
    float tolerance;
    texel_lists& to;
};

// Adds ranges whose depth departs from a line by more than the tolerance, in pieces (Palmer 2011, chapter 5).
[[gnu::noinline]] void add_pieces(const tile_query& at, xsimd::batch_bool<float> bent, depth_curve<texel_pack> curve,
                                  texel_pack opening, texel_pack closing)
{
    texel_pack passed = gnomon_select(bent, texel_pack(0.f), texel_pack(1.f));
    while (gnomon_any(passed < texel_pack(1.f))) {
        const depth_piece<texel_pack> piece =
            depth_curve_piece(curve, opening, closing, passed, texel_pack(at.tolerance));
        at.to.add(passed < texel_pack(1.f) && piece.t0 < piece.t1, {piece.t0, piece.t1, piece.z0, piece.z1},
                  float(at.triangle.setup().number));
        passed = piece.passed;
    }
}

// Adds a range in the lanes that have it, in pieces where its depth bends.
template <class Coverage>
GNOMON_INLINE void add_range(const tile_query& at, const Coverage& coverage, const xsimd::batch_bool<float>& exists,
                             const texel_pack& opening, const texel_pack& closing)
{
    const auto id = float(at.triangle.setup().number);
    if (!(at.tolerance > 0)) {
        at.to.add(exists, {opening, closing, coverage.depth(opening), coverage.depth(closing)}, id);
        return;
    }
    const depth_line<texel_pack> line = coverage.line(opening, closing);
    const auto bent = exists && texel_pack(at.tolerance) < line.deviation;
    if (gnomon_any(bent)) add_pieces(at, bent, coverage.curve, opening, closing);
    at.to.add(exists && !bent, {opening, closing, line.z0, line.z1}, id);
}

// Adds the parts of an interval in which the triangle is between the near and the far plane. Returns a bit for each
// lane that got a range.
template <class Coverage>
[[gnu::noinline]] std::uint64_t add_between_planes(const tile_query& at, Coverage coverage,
                                                   xsimd::batch_bool<float> exists, texel_pack opening,
                                                   texel_pack closing, float facing)
{
    // The end of a line that reaches a plane or passes it is clamped to that plane.
    const texel_pack one(1.f);
    const depth_line<texel_pack> line = coverage.line(opening, closing);
    const auto inside = gnomon_max(line.z0, line.z1) + line.deviation < one &&
                        texel_pack(-1.f) < gnomon_min(line.z0, line.z1) - line.deviation;
    if (!gnomon_any(exists && !inside)) {
        add_range(at, coverage, exists, opening, closing);
        return bits_of(exists);
    }
    const edge_intervals<texel_pack> beyond =
                                         depth_intervals_beyond(coverage.curve, texel_pack(-1.f), texel_pack(facing)),
                                     before = depth_intervals_before(coverage.curve, one, texel_pack(facing));
    std::uint64_t seen = 0;
    for (const float i : {0.f, 1.f})
        for (const float k : {0.f, 1.f}) {
            linear_interval<texel_pack> part = edge_intervals_part(beyond, texel_pack(i), opening, closing);
            part = edge_intervals_part(before, texel_pack(k), part.begin, part.end);
            const auto there = exists && part.begin < part.end;
            if (!gnomon_any(there)) continue;
            add_range(at, coverage, there, part.begin, part.end);
            seen |= bits_of(there);
        }
    return seen;
}

// Adds an interval in the lanes that have it. Returns a bit for each lane that got a range: those in the picture.
template <class Coverage>
GNOMON_INLINE std::uint64_t add_interval(const tile_query& at, const Coverage& coverage,
                                         xsimd::batch_bool<float> exists, const texel_pack& opening,
                                         const texel_pack& closing, float facing)
{
    if (!at.triangle.whole()) exists = exists && at.triangle.contains(at.samples);
    if (!at.triangle.setup().between_planes) return add_between_planes(at, coverage, exists, opening, closing, facing);
    add_range(at, coverage, exists, opening, closing);
    return bits_of(exists);
}

// Adds the second to the fourth interval.
[[gnu::noinline]] std::uint64_t add_further_intervals(const tile_query& at, quadratic_coverage coverage,
                                                      coverage_intervals<texel_pack> times, float facing)
{
    return add_interval(at, coverage, times.count > texel_pack(1.f), times.begin1, times.end1, facing) |
           add_interval(at, coverage, times.count > texel_pack(2.f), times.begin2, times.end2, facing) |
           add_interval(at, coverage, times.count > texel_pack(3.f), times.begin3, times.end3, facing);
}

// Adds what texels see of one facing. Returns how many texels see it.
GNOMON_INLINE std::size_t add_facing(const tile_query& at, const quadratic_coverage& coverage, float facing)
{
    const coverage_intervals<texel_pack> times = coverage.covered(facing);
    const auto covered = times.count > texel_pack(0.f);
    if (!gnomon_any(covered)) return 0;
    std::uint64_t seen = add_interval(at, coverage, covered, times.begin0, times.end0, facing);
    if (gnomon_any(times.count > texel_pack(1.f))) seen |= add_further_intervals(at, coverage, times, facing);
    return std::size_t(std::popcount(seen));
}

GNOMON_INLINE std::size_t add_facing(const tile_query& at, const linear_tile_coverage& coverage, float facing)
{
    const linear_interval<texel_pack> times = coverage.covered(facing);
    const auto covered = times.begin < times.end;
    if (!gnomon_any(covered)) return 0;
    return std::size_t(std::popcount(add_interval(at, coverage, covered, times.begin, times.end, facing)));
}

[[gnu::noinline]] std::size_t add_back_facing(const tile_query& at)
{
    if (at.triangle.setup().linear) return add_facing(at, at.triangle.linear(at.samples, -1), -1);
    return add_facing(at, at.triangle.quadratic(at.samples, -1), -1);
}

[[gnu::noinline]] std::size_t add_quadratic(const tile_query& at)
{
    return add_facing(at, at.triangle.quadratic(at.samples, 1), 1);
}

// Joins neighbouring ranges of one mesh in a list.
class mesh_joiner {
  public:
    mesh_joiner(const scene& world, float tolerance) : numbers_(world), tolerance_(tolerance) {}

    std::span<depth_time_range<float>> operator()(std::span<depth_time_range<float>> list) const
    {
        return join_ranges(list, tolerance_, [&](const auto& a, const auto& b) { return mesh(a) == mesh(b); });
    }

  private:
    std::uint32_t mesh(const depth_time_range<float>& r) const { return numbers_[std::uint32_t(r.id)].mesh; }

    triangle_numbers numbers_;
    float tolerance_;
};

// Fills the lists of a tile, a pack of texels at a time.
void rasterize_tile(const tiled_triangles& scenery, std::size_t tile, const range_options& how, const mesh_joiner& join,
                    tile_lists& to)
{
    to.bins.assign(scenery, tile, how.resolved);
    to.counts = {};
    to.lists.clear();
    for (std::size_t i = 0; i < packs_per_tile; ++i) {
        const moving_samples samples(i);
        // Long lists are resolved in between, since the work of resolving grows with the square of their length.
        std::size_t budget = how.resolved ? std::min(how.budget, long_lists) : how.budget;
        to.texels.clear(how.resolved, how.backdrops);
        to.bins.for_each(i / moving_samples::packs_per_block, [&](const tile_triangle& triangle) {
            const tile_query at{triangle, samples, how.depth_tolerance, to.texels};
            to.counts.tested += texel_pack::size;
            const moving_setup& s = triangle.setup();
            if (s.positive)
                to.counts.pairs += s.linear ? add_facing(at, triangle.linear(samples, 1), 1) : add_quadratic(at);
            if (s.negative) to.counts.pairs += add_back_facing(at);
            if (to.texels.room() <= budget) return;
            ++to.counts.early_resolves;
            to.texels.thin_out();
            budget = std::max(budget, 2 * to.texels.room());
        });
        const auto sizes = std::span(to.sizes).subspan(i * texel_pack::size).first<texel_pack::size>();
        if (how.resolved) to.texels.append_resolved_to(to.lists, sizes, join);
        else to.texels.append_to(to.lists, sizes);
    }
}

// Copies with stores that bypass the caches: a map is larger than these, and memory to be overwritten need not be read.
void copy_to_memory(std::span<const depth_time_range<float>> from, depth_time_range<float>* to)
{
#ifdef __SSE2__
    constexpr std::size_t line = sizeof(__m128i), group = std::lcm(line, sizeof *to) / sizeof *to;
    while (!from.empty() && std::bit_cast<std::uintptr_t>(to) % line != 0) *to++ = from[0], from = from.subspan(1);
    for (; from.size() >= group; from = from.subspan(group), to += group)
        for (std::size_t i = 0; i < group * sizeof *to / line; ++i)
            _mm_stream_si128(reinterpret_cast<__m128i*>(to) + i,
                             _mm_loadu_si128(reinterpret_cast<const __m128i*>(from.data()) + i));
    _mm_sfence();
#endif
    std::ranges::copy(from, to);
}

} // namespace

struct range_rasterizer::scratch {
    std::vector<tile_lists> lists; // of a wave of tiles
};

range_rasterizer::range_rasterizer() : scratch_(std::make_unique<scratch>()) {}
range_rasterizer::~range_rasterizer() = default;

const range_lists& range_rasterizer::operator()(const moving_scene& world, const moving_camera& eye, int width,
                                                int height, const range_options& how)
{
    const tiled_triangles scenery(world, eye, width, height, how.visible, 0, how.line ? &*how.line : nullptr);
    const mesh_joiner join(world.open, how.joining);
    lists_.width = width, lists_.height = height, lists_.counts = {};
    lists_.first.resize(map::texels(std::size_t(width), std::size_t(height)) + 1);
    // Waves of tiles, large enough to keep all threads busy, small enough for their lists to be in a cache when they
    // are copied to their places in the map.
    const std::size_t wave = 2 * std::size_t(tbb::this_task_arena::max_concurrency());
    scratch_->lists.resize(wave);
    std::vector<std::size_t> begins(wave);
    std::size_t end = 0;
    for (std::size_t tile = 0; tile < scenery.tiles(); tile += wave) {
        const std::span tiles = std::span(scratch_->lists).first(std::min(wave, scenery.tiles() - tile));
        tbb::parallel_for(std::size_t(0), tiles.size(),
                          [&](std::size_t i) { rasterize_tile(scenery, tile + i, how, join, tiles[i]); });
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            begins[i] = end;
            end += tiles[i].lists.used().size();
            lists_.counts += tiles[i].counts;
        }
        if (end > std::numeric_limits<std::uint32_t>::max())
            throw std::length_error("moving rasterizer: more than 2^32 ranges");
        if (lists_.ranges.size() < end) lists_.ranges.resize(std::max(end, 2 * lists_.ranges.size()));
        tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) {
            const auto made = tiles[i].lists.used();
            copy_to_memory(made, lists_.ranges.data() + begins[i]);
            const auto first = lists_.first.begin() + std::ptrdiff_t((tile + i) * texels_per_tile);
            std::exclusive_scan(tiles[i].sizes.begin(), tiles[i].sizes.end(), first, std::uint32_t(begins[i]));
        });
    }
    lists_.first.back() = static_cast<std::uint32_t>(end);
    lists_.ranges.resize(end);
    return lists_;
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

} // namespace gnomon::renderer
