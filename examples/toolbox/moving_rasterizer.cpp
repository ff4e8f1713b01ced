#include "moving_rasterizer.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <gnomon/passes/resolve.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "moving_tiles.hpp"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace gnomon::toolbox {

namespace {

using map = range_map<float>;

constexpr std::size_t texels_per_tile = map::texels_per_tile, packs_per_tile = moving_samples::packs_per_tile;

// What a triangle adds to a pack of texels.
struct loose_pack {
    texel_lanes t0, t1, z0, z1;
    std::uint64_t exists; // a bit for each lane
    float id;
};

// Things one after the other, and room behind them that keeps what it has.
template <class T> class stack {
  public:
    std::size_t size() const { return size_; }
    std::span<const T> used() const { return std::span(room_).first(size_); }
    std::span<T> used() { return std::span(room_).first(size_); }
    void clear() { size_ = 0; }
    T* room_for(std::size_t count)
    {
        if (room_.size() < size_ + count) room_.resize(2 * (size_ + count));
        return &room_[size_];
    }
    void grow(std::size_t count) { size_ += count; }

  private:
    std::vector<T> room_;
    std::size_t size_ = 0;
};

// Lists of a pack of texels: ranges as they come, by packs, until they are laid out or resolved.
class texel_lists {
  public:
    // How many ranges there is room for.
    std::size_t room() const { return held_.size() + texel_pack::size * packs_.size(); }

    void clear() { packs_.clear(), held_.clear(), held_counts_.fill(0); }

    // Those that exist, a bit for each lane.
    GNOMON_INLINE void add(std::uint64_t exists, const range_pack& r, float id)
    {
        loose_pack& p = *packs_.room_for(1);
        packs_.grow(1);
        r.t0.store_unaligned(p.t0.data()), r.t1.store_unaligned(p.t1.data());
        r.z0.store_unaligned(p.z0.data()), r.z1.store_unaligned(p.z1.data());
        p.exists = exists, p.id = id;
    }

    // At the end of others, texel by texel, how many of each in counts.
    void append_to(stack<depth_time_range<float>>& all, std::span<std::uint32_t, texel_pack::size> counts) const
    {
        depth_time_range<float>*const begin = all.room_for(room() + 1), *end = begin;
        const std::span<const loose_pack> packs = packs_.used();
        auto held = held_.begin();
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            std::uint32_t count = held_counts_[i];
            if (count > 0) {
                end = std::copy_n(held, count, end);
                held += count;
            }
            // Without branches: what does not exist is overwritten.
            for (const loose_pack& p : packs) {
                const std::uint32_t exists = p.exists >> i & 1;
                *end = {p.t0[i], p.t1[i], p.z0[i], p.z1[i], p.id};
                end += exists, count += exists;
            }
            counts[i] = count;
        }
        all.grow(std::size_t(end - begin));
    }

    // They become what of them is in front.
    void resolve(bool backdrops)
    {
        std::array<std::uint32_t, texel_pack::size> counts;
        lists_.clear();
        append_to(lists_, counts);
        clear();
        std::span<depth_time_range<float>> rest = lists_.used();
        for (std::size_t i = 0; i < texel_pack::size; rest = rest.subspan(counts[i++])) {
            const auto whole = rest.first(counts[i]);
            const std::span<const depth_time_range<float>> list = backdrops ? whole : without_backdrop(whole);
            spans_.resize(std::max(spans_.size(), resolve_capacity(list.size(), range_ids::surfaces)));
            const auto spans = resolve_ranges(list, std::span(spans_), range_ids::surfaces);
            for (const visible_span<float>& s : spans) held_.push_back(range_of(list, s));
            held_counts_[i] = static_cast<std::uint32_t>(spans.size());
        }
    }

  private:
    stack<loose_pack> packs_;
    std::vector<depth_time_range<float>> held_; // resolved, texel by texel, before those in packs
    std::array<std::uint32_t, texel_pack::size> held_counts_{};

    stack<depth_time_range<float>> lists_;
    std::vector<visible_span<float>> spans_;
};

// What a tile needs, and what becomes of it.
struct tile_lists {
    tile_members members;
    texel_lists texels; // that are worked at
    range_counts counts;
    stack<depth_time_range<float>> lists; // in the order of texels
    std::array<std::uint32_t, texels_per_tile> sizes;
};

// Where a triangle is seen by samples, and what becomes of that. Large things go by value to functions that are called
// rarely: they need no memory elsewhere.
struct sighting {
    const tile_triangle& triangle;
    const moving_samples& samples;
    float tolerance;
    texel_lists& to;
};

// Ranges whose depth is further from its line than the tolerance, in pieces (Palmer 2011, chapter 5).
[[gnu::noinline]] void add_pieces(const sighting& at, xsimd::batch_bool<float> bent, range_pack whole)
{
    const moving_triangle<texel_pack> corners = numbers_as<texel_pack>(at.triangle.setup().corners);
    const moving_edges<texel_pack> edges = at.triangle.curved(at.samples).edges;
    texel_pack passed = gnomon_select(bent, texel_pack(0.f), texel_pack(1.f));
    while (gnomon_any(passed < texel_pack(1.f))) {
        const depth_piece<texel_pack> piece =
            moving_depth_piece(corners, edges, whole.t0, whole.t1, passed, texel_pack(0.f), texel_pack(at.tolerance));
        at.to.add(bits_of(passed < texel_pack(1.f) && piece.t0 < piece.t1), {piece.t0, piece.t1, piece.z0, piece.z1},
                  float(at.triangle.setup().number));
        passed = piece.passed;
    }
}

// One interval of those lanes that have it. Returns which are in the picture, a bit for each.
template <class Sight>
GNOMON_INLINE std::uint64_t add_interval(const sighting& at, const Sight& sight, xsimd::batch_bool<float> exists,
                                         const texel_pack& opening, const texel_pack& closing)
{
    const range_pack whole{opening, closing, sight.depth(opening), sight.depth(closing)};
    if (!at.triangle.whole()) exists = exists && at.triangle.contains(at.samples, whole.z0, whole.z1);
    const std::uint64_t seen = bits_of(exists);
    std::uint64_t straight = seen;
    if (at.tolerance > 0) {
        const auto bent = exists && sight.bends(whole, at.tolerance);
        if (gnomon_any(bent)) {
            add_pieces(at, bent, whole);
            straight &= ~bits_of(bent);
        }
    }
    if (straight != 0) at.to.add(straight, whole, float(at.triangle.setup().number));
    return seen;
}

[[gnu::noinline]] void add_further_intervals(const sighting& at, curved_sight sight, coverage_times<texel_pack> times)
{
    add_interval(at, sight, times.count > texel_pack(1.f), times.begin1, times.end1);
    add_interval(at, sight, times.count > texel_pack(2.f), times.begin2, times.end2);
    add_interval(at, sight, times.count > texel_pack(3.f), times.begin3, times.end3);
}

// Of one facing. Returns how many texels it covers.
GNOMON_INLINE std::size_t add_facing(const sighting& at, const curved_sight& sight, float facing)
{
    const coverage_times<texel_pack> times = sight.covered(facing);
    const auto covered = times.count > texel_pack(0.f);
    if (!gnomon_any(covered)) return 0;
    const std::uint64_t seen = add_interval(at, sight, covered, times.begin0, times.end0);
    if (gnomon_any(times.count > texel_pack(1.f))) add_further_intervals(at, sight, times);
    return std::size_t(std::popcount(seen));
}

GNOMON_INLINE std::size_t add_facing(const sighting& at, const linear_sight& sight, float facing)
{
    const linear_times<texel_pack> times = sight.covered(facing);
    const auto covered = times.begin < times.end;
    if (!gnomon_any(covered)) return 0;
    return std::size_t(std::popcount(add_interval(at, sight, covered, times.begin, times.end)));
}

[[gnu::noinline]] std::size_t add_turned(const sighting& at)
{
    if (at.triangle.setup().linear) return add_facing(at, at.triangle.linear(at.samples), -1);
    return add_facing(at, at.triangle.curved(at.samples), -1);
}

[[gnu::noinline]] std::size_t add_curved(const sighting& at)
{
    return add_facing(at, at.triangle.curved(at.samples), 1);
}

void rasterize_tile(const tiled_triangles& scenery, std::size_t tile, const range_options& how, tile_lists& to)
{
    to.members.assign(scenery, tile);
    to.counts = {};
    to.lists.clear();
    for (std::size_t i = 0; i < packs_per_tile; ++i) {
        const moving_samples samples(i);
        std::size_t budget = how.budget;
        to.texels.clear();
        to.members.for_each(i / moving_samples::packs_per_block, [&](const tile_triangle& triangle) {
            const sighting at{triangle, samples, how.depth_tolerance, to.texels};
            to.counts.tested += texel_pack::size;
            const moving_setup& s = triangle.setup();
            if (s.positive) to.counts.pairs += s.linear ? add_facing(at, triangle.linear(samples), 1) : add_curved(at);
            if (s.negative) to.counts.pairs += add_turned(at);
            if (to.texels.room() <= budget) return;
            ++to.counts.early_resolves;
            to.texels.resolve(true); // what comes may be behind a backdrop
            budget = std::max(budget, 2 * to.texels.room());
        });
        if (how.resolved) to.texels.resolve(how.backdrops);
        to.texels.append_to(to.lists, std::span(to.sizes).subspan(i * texel_pack::size).first<texel_pack::size>());
    }
}

// Of each sample the nearest triangle at its time; z0 is 1 where there is none.
void sample_instants(const tile_triangle& triangle, const moving_samples& at, const moving_tile& where, int samples,
                     std::vector<depth_time_range<float>>& nearest)
{
    const moving_setup& s = triangle.setup();
    const curved_sight sight = triangle.curved(at);
    const moving_edges<texel_pack>& edges = sight.edges;
    const auto instant = [&](std::size_t lane, int k) -> depth_time_range<float>* {
        const glm::ivec2 place = at.place(lane);
        if (!triangle.contains(place)) return nullptr;
        return &nearest[where.pixel(place) * std::size_t(samples) + std::size_t(k)];
    };
    for (int k = 0; k < samples; ++k) {
        texel_lanes time{}, least, most, z;
        for (std::size_t i = 0; i < texel_pack::size; ++i)
            if (const auto* there = instant(i, k)) time[i] = there->t0;
        const texel_pack t = texel_pack::load_unaligned(time.data());
        const texel_pack a = moving_edge_at(edges.a, t), b = moving_edge_at(edges.b, t), c = moving_edge_at(edges.c, t);
        gnomon_min(gnomon_min(a, b), c).store_unaligned(least.data());
        gnomon_max(gnomon_max(a, b), c).store_unaligned(most.data());
        sight.depth(t).store_unaligned(z.data());
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
}

// Past the caches, which a map does not fit in: that saves reading what is overwritten.
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
    std::vector<tile_lists> lists; // of some tiles, one after the other
};

range_rasterizer::range_rasterizer() : scratch_(std::make_unique<scratch>()) {}
range_rasterizer::~range_rasterizer() = default;

const range_lists& range_rasterizer::operator()(const moving_scene& world, const moving_camera& eye, int width,
                                                int height, const range_options& how)
{
    const tiled_triangles scenery(world, eye, width, height, how.visible);
    lists_.width = width, lists_.height = height, lists_.counts = {};
    lists_.first.resize(map::texels(std::size_t(width), std::size_t(height)) + 1);
    // As many tiles at a time as keep all threads busy and caches full: their lists are laid out while they are there.
    const std::size_t wave = 2 * std::size_t(tbb::this_task_arena::max_concurrency());
    scratch_->lists.resize(wave);
    std::vector<std::size_t> begins(wave);
    std::size_t end = 0;
    for (std::size_t tile = 0; tile < scenery.tiles(); tile += wave) {
        const std::span tiles = std::span(scratch_->lists).first(std::min(wave, scenery.tiles() - tile));
        tbb::parallel_for(std::size_t(0), tiles.size(),
                          [&](std::size_t i) { rasterize_tile(scenery, tile + i, how, tiles[i]); });
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
            copy_to_memory(made, &lists_.ranges[begins[i]]);
            const auto first = lists_.first.begin() + std::ptrdiff_t((tile + i) * texels_per_tile);
            std::exclusive_scan(tiles[i].sizes.begin(), tiles[i].sizes.end(), first, std::uint32_t(begins[i]));
        });
    }
    lists_.first.back() = static_cast<std::uint32_t>(end);
    lists_.ranges.resize(end);
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
    tbb::parallel_for(std::size_t(0), scenery.tiles(), [&](std::size_t tile) {
        tile_members members;
        members.assign(scenery, tile);
        for (std::size_t i = 0; i < packs_per_tile; ++i)
            members.for_each(i / moving_samples::packs_per_block, [&, at = moving_samples(i)](const tile_triangle& t) {
                sample_instants(t, at, scenery.tile(tile), samples, result);
            });
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
