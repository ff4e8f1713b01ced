#include "moving_rasterizer.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <gnomon/passes/resolve.hpp>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "moving_tiles.hpp"

namespace gnomon::toolbox {

namespace {

using map = range_map<float>;

// A pack of ranges, and which of them there are.
struct range_lanes {
    texel_lanes t0, t1, z0, z1, exists; // 1 or 0
};

// Ranges of one tile as they come, each with its texel in the tile.
class loose_ranges {
  public:
    std::size_t size() const { return size_; }
    std::span<const std::uint32_t> texels() const { return std::span(texels_).first(size_); }
    std::span<const depth_time_range<float>> ranges() const { return std::span(ranges_).first(size_); }
    void clear() { size_ = 0; }

    void add(std::uint32_t texel, const depth_time_range<float>& r)
    {
        make_room(1);
        texels_[size_] = texel, ranges_[size_] = r;
        ++size_;
    }

    // Those that there are, without a branch. Returns how many.
    std::size_t add(const std::uint32_t* texels, const range_lanes& lanes, float id)
    {
        make_room(texel_pack::size);
        std::uint32_t* texel = &texels_[size_];
        depth_time_range<float>* range = &ranges_[size_];
        std::size_t count = 0;
        for (std::size_t i = 0; i < texel_pack::size; ++i) {
            texel[count] = texels[i];
            range[count] = {lanes.t0[i], lanes.t1[i], lanes.z0[i], lanes.z1[i], id};
            count += lanes.exists[i] > 0;
        }
        size_ += count;
        return count;
    }

  private:
    void make_room(std::size_t count)
    {
        if (size_ + count <= texels_.size()) return;
        texels_.resize(2 * (size_ + count)), ranges_.resize(2 * (size_ + count));
    }

    std::vector<std::uint32_t> texels_; // what lies beyond the size is room
    std::vector<depth_time_range<float>> ranges_;
    std::size_t size_ = 0;
};

constexpr std::size_t texels_per_tile = moving_tile_size * moving_tile_size;

// What one thread needs, tile after tile.
struct thread_state {
    loose_ranges loose;
    range_counts counts;
    std::array<std::uint32_t, texels_per_tile + 1> first{};
    std::vector<depth_time_range<float>> lists; // as first says; what lies beyond is room
    std::vector<visible_span<float>> spans;
    std::vector<depth_time_range<float>> finished; // of its tiles in the row, each in the order of its texels
};

// Where a thread has left the ranges of a tile.
struct tile_part {
    const std::vector<depth_time_range<float>>* of = nullptr;
    std::size_t begin = 0;
};

// The loose ranges of a tile become lists.
std::span<const depth_time_range<float>> sort_loose(thread_state& t)
{
    const std::size_t size = t.loose.size();
    t.lists.resize(std::max(t.lists.size(), size));
    sort_into_lists(t.loose.texels(), t.loose.ranges(), std::span(t.first), std::span(t.lists).first(size));
    t.loose.clear();
    return std::span(t.lists).first(size);
}

// They become what of them is in front.
void resolve_loose(thread_state& t)
{
    const auto sorted = sort_loose(t);
    for (std::size_t i = 0; i < texels_per_tile; ++i) {
        const auto list = sorted.subspan(t.first[i], t.first[i + 1] - t.first[i]);
        if (list.empty()) continue;
        t.spans.resize(std::max(t.spans.size(), resolve_capacity(list.size())));
        for (const visible_span<float>& s : resolve_ranges<float>(list, t.spans))
            t.loose.add(std::uint32_t(i), range_of(list, s));
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
auto between_planes(const texel_pack& z0, const texel_pack& z1)
{
    const texel_pack near_plane(-1.f), far_plane(1.f);
    return (near_plane < z0 || near_plane < z1) && (z0 < far_plane || z1 < far_plane);
}

moving_edges<float> edges_in_lane(const moving_edges<texel_pack>& e, std::size_t lane)
{
    const auto packs = std::bit_cast<std::array<texel_pack, 9>>(e);
    std::array<float, 9> result;
    std::ranges::transform(packs, result.begin(), [&](const texel_pack& x) { return x.get(lane); });
    return std::bit_cast<moving_edges<float>>(result);
}

// The texels of one triangle in one tile.
void add_ranges(const moving_setup& s, const moving_tile& where, float tolerance, loose_ranges& to,
                range_counts& counts)
{
    const tile_triangle triangle(s, where);
    const moving_triangle<texel_pack> depths = depths_of<texel_pack>(s.corners);
    triangle.for_each_pack([&](const glm::ivec2& block, int begin, const moving_edges<texel_pack>& edges) {
        counts.tested += texel_pack::size;
        for (const float facing : {1.f, -1.f}) {
            if (!(facing > 0 ? s.positive : s.negative)) continue;
            const coverage_times<texel_pack> times = moving_coverage(edges, texel_pack(facing));
            const std::array<std::array<texel_pack, 2>, 4> intervals{{{times.begin0, times.end0},
                                                                      {times.begin1, times.end1},
                                                                      {times.begin2, times.end2},
                                                                      {times.begin3, times.end3}}};
            for (int k = 0; k < 4 && gnomon_any(times.count > texel_pack(float(k))); ++k) {
                const auto& [opening, closing] = intervals[std::size_t(k)];
                const texel_pack depth0 = moving_triangle_linear_depth(depths, edges, opening),
                                 depth1 = moving_triangle_linear_depth(depths, edges, closing);
                const auto seen = times.count > texel_pack(float(k)) && between_planes(depth0, depth1) &&
                                  triangle.contains(block, begin);
                range_lanes lanes;
                opening.store_unaligned(lanes.t0.data()), closing.store_unaligned(lanes.t1.data());
                depth0.store_unaligned(lanes.z0.data()), depth1.store_unaligned(lanes.z1.data());
                const auto store = [&](const auto& mask) {
                    gnomon_select(mask, texel_pack(1.f), texel_pack(0.f)).store_unaligned(lanes.exists.data());
                };
                std::array<std::uint32_t, texel_pack::size> texels;
                for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = tile_triangle::texel(block, begin + int(i));
                const auto id = float(s.number);
                std::size_t added = 0;
                if (tolerance > 0) {
                    // Depth that bends departs from its line most somewhere in the middle.
                    const texel_pack half(0.5f), middle = half * (opening + closing);
                    const texel_pack bend =
                        moving_triangle_linear_depth(depths, edges, middle) - half * (depth0 + depth1);
                    const auto bent = seen && gnomon_abs(bend) > texel_pack(0.5f * tolerance);
                    if (gnomon_any(bent)) {
                        store(bent);
                        for (std::size_t i = 0; i < texels.size(); ++i) {
                            if (!(lanes.exists[i] > 0)) continue;
                            ++added;
                            add_pieces({lanes.t0[i], lanes.t1[i], lanes.z0[i], lanes.z1[i], id},
                                       depths_of<float>(s.corners), edges_in_lane(edges, i), tolerance, texels[i], to);
                        }
                    }
                    store(seen && !bent);
                } else store(seen);
                added += to.add(texels.data(), lanes, id);
                if (k == 0) counts.pairs += added;
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
            const glm::ivec2 at = tile_triangle::place(block, begin + int(lane));
            if (!triangle.contains(at)) return nullptr;
            return &nearest[where.pixel(at) * std::size_t(samples) + std::size_t(k)];
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

// Calls visit(first texel in the tile, in the map, number of texels) for the rows of blocks of a tile: the texels of
// each are one after the other in the tile as in the map.
template <class Visit> void for_each_row_of_blocks(const moving_tile& where, const Visit& visit)
{
    const std::size_t count = map::blocks(std::size_t(where.size.x)) * map::block * map::block;
    for (int y = 0; y < where.size.y; y += int(map::block))
        visit(map::texel(moving_tile_size, 0, std::size_t(y)), where.texel({0, y}), count);
}

} // namespace

struct range_rasterizer::scratch {
    tbb::enumerable_thread_specific<thread_state> threads;
    std::vector<tile_part> parts; // of the tiles of a row

    // A row of tiles, whose texels come one after the other in the map: its lists are laid out while caches have them.
    // Returns the new number of ranges.
    std::size_t add_row(const tiled_triangles& scenery, std::size_t row, const range_options& how, std::size_t begin,
                        range_lists& lists)
    {
        for (thread_state& t : threads) t.finished.clear();
        parts.resize(scenery.columns());
        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t column) {
            const std::size_t tile = row * parts.size() + column;
            parts[column] = add_tile(scenery, tile, how, lists.first);
        });

        std::size_t end = begin;
        for (const thread_state& t : threads) end += t.finished.size();
        if (end > std::numeric_limits<std::uint32_t>::max())
            throw std::length_error("moving rasterizer: more than 2^32 ranges");
        if (lists.ranges.size() < end) lists.ranges.resize(std::max(end, 2 * lists.ranges.size()));
        const moving_tile left = scenery.tile(row * parts.size());
        const auto first = lists.first.begin() + std::ptrdiff_t(left.texel({0, 0}));
        const std::size_t texels = map::texels(std::size_t(left.picture_width), std::size_t(left.size.y));
        std::exclusive_scan(first, first + std::ptrdiff_t(texels) + 1, first, std::uint32_t(begin));

        tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t column) {
            const moving_tile where = scenery.tile(row * parts.size() + column);
            auto from = parts[column].of->begin() + std::ptrdiff_t(parts[column].begin);
            for_each_row_of_blocks(where, [&](std::size_t, std::size_t in_map, std::size_t count) {
                const std::uint32_t to = lists.first[in_map];
                const auto size = std::ptrdiff_t(lists.first[in_map + count] - to);
                std::copy_n(from, size, lists.ranges.begin() + to);
                from += size;
            });
        });
        return end;
    }

    // Its lists are left with the thread, how long they are in counts.
    tile_part add_tile(const tiled_triangles& scenery, std::size_t tile, const range_options& how,
                       std::vector<std::uint32_t>& counts)
    {
        thread_state& t = threads.local();
        const moving_tile where = scenery.tile(tile);
        std::size_t budget = how.tile_budget;
        scenery.for_each(tile, [&](const moving_setup& s) {
            add_ranges(s, where, how.depth_tolerance, t.loose, t.counts);
            if (t.loose.size() <= budget) return;
            ++t.counts.early_resolves;
            resolve_loose(t);
            budget = std::max(budget, 2 * t.loose.size());
        });
        if (how.resolved) resolve_loose(t);
        const auto sorted = sort_loose(t);
        for_each_row_of_blocks(where, [&](std::size_t in_tile, std::size_t in_map, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i)
                counts[in_map + i] = t.first[in_tile + i + 1] - t.first[in_tile + i];
        });
        const tile_part part{&t.finished, t.finished.size()};
        t.finished.insert(t.finished.end(), sorted.begin(), sorted.end());
        return part;
    }
};

range_rasterizer::range_rasterizer() : scratch_(std::make_unique<scratch>()) {}
range_rasterizer::~range_rasterizer() = default;

const range_lists& range_rasterizer::operator()(const moving_scene& world, const moving_camera& eye, int width,
                                                int height, const range_options& how)
{
    const tiled_triangles scenery(world, eye, width, height, how.visible);
    lists_.width = width, lists_.height = height, lists_.counts = {};
    lists_.first.assign(map::texels(std::size_t(width), std::size_t(height)) + 1, 0);
    for (thread_state& t : scratch_->threads) t.counts = {};
    std::size_t size = 0;
    for (std::size_t row = 0; row < scenery.rows(); ++row) size = scratch_->add_row(scenery, row, how, size, lists_);
    lists_.ranges.resize(size);
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
