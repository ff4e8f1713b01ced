// Moving triangles prepared for a rasterizer that works on packs of texels. The steps, from the picture down to texels:
//   moving_setup      a triangle in texel space, the texels that it may cover, and the facings that it has
//   tiled_triangles   for each tile of the picture, the triangles that it sees at some time
//   tile_triangle     a triangle in the coordinates of one tile, widened against cracks, and the blocks that it touches
//   tile_bins         for each block of a tile, the triangles that touch it (tile_bins.hpp)
//   quadratic_coverage, linear_tile_coverage   the times at which a triangle covers each texel, and its depth
#pragma once

#include "rasterizer.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <gnomon/motion/receiver/line_sample.h>
#include <gnomon/motion/triangle/depth_planes.h>
#include <gnomon/motion/triangle/edge_widening.h>
#include <gnomon/passes/range/map.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer {

using texel_pack = gnomon::pack<xsimd::batch<float>>;
using texel_lanes = std::array<float, texel_pack::size>;

// A bit for each lane of a mask, as the function mask() of later versions of xsimd.
template <class Mask> std::uint64_t bits_of(const Mask& lanes)
{
    if constexpr (requires { std::uint64_t{lanes.data}; }) return lanes.data;
    else {
        std::array<bool, texel_pack::size> each;
        lanes.store_unaligned(each.data());
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < each.size(); ++i) bits |= std::uint64_t(each[i]) << i;
        return bits;
    }
}

template <class Visit> void for_each_bit(std::uint64_t bits, const Visit& visit)
{
    for (; bits != 0; bits &= bits - 1) visit(std::size_t(std::countr_zero(bits)));
}

// Tiles and blocks are those of range_map.
inline constexpr int moving_tile_size = int(range_map<float>::tile), moving_block_size = int(range_map<float>::block);
inline constexpr int moving_blocks = moving_tile_size / moving_block_size; // along a side of a tile
static_assert(moving_blocks * moving_blocks == 64, "a tile has a bit for each block");

// A moving triangle that may be seen.
struct moving_setup {
    moving_triangle<double> corners; // x and y in texels times w, and linear depth
    glm::ivec2 first, last;          // texels that the triangle may cover, both included
    bool positive, negative;         // true if its edge functions are all positive, or all negative, at some time
    bool before_eye;                 // true if all of it is before the eye all of the time
    bool between_planes;             // true if all of it is between the near and the far plane all of the time
    glm::bvec3 linear_edges;         // for the edge across from each corner: its function is linear in time
    bool linear;                     // true if all edges are, and the depths of the corners change alike
    float nearest;                   // depth, by which tiles sort their triangles
    std::uint32_t number;            // counted through all meshes
};

struct moving_tile {
    glm::ivec2 corner, size; // the size of the part inside the picture
    int picture_width;

    // Index of a pixel in the picture, row by row.
    std::size_t pixel(const glm::ivec2& inside) const
    {
        return std::size_t(corner.y + inside.y) * std::size_t(picture_width) + std::size_t(corner.x + inside.x);
    }
};

// The triangles of a scene, sorted into the tiles in which they are seen at some time by samples that are at most
// `reach` from the centres of their texels, along x and y.
class tiled_triangles {
  public:
    // By samples along a line at one instant where there is one. Throws std::invalid_argument for a picture that is empty or
    // too large.
    tiled_triangles(const moving_scene& world, const moving_camera& eye, int width, int height, faces visible,
                    float reach = 0, const line_sample<double>* line = nullptr);

    float reach() const { return reach_; }
    std::size_t tiles() const { return first_.size() - 1; }
    moving_tile tile(std::size_t i) const;

    // Calls visit(setup) for the triangles of a tile, in the order of their numbers.
    template <class Visit> void for_each(std::size_t tile, const Visit& visit) const
    {
        for (std::uint32_t i = first_[tile]; i < first_[tile + 1]; ++i) visit(setups_[members_[i]]);
    }

  private:
    void sort_into_tiles();

    glm::ivec2 size_, grid_; // in texels, in tiles
    float reach_;
    std::vector<moving_setup> setups_;
    std::vector<std::uint32_t> first_, members_;
};

// A struct of numbers, each rounded to float and converted to To: float, or a pack with that float in every lane.
template <class To, template <class, class> class Struct, class From>
Struct<To, To> rounded_to(const Struct<From, From>& x)
{
    const auto given = std::bit_cast<std::array<From, sizeof x / sizeof(From)>>(x);
    std::array<To, given.size()> result;
    std::ranges::transform(given, result.begin(), [](From r) { return To(static_cast<float>(r)); });
    return std::bit_cast<Struct<To, To>>(result);
}

// A struct of packs with the same number in every lane, written member by member: compilers keep that in registers.
GNOMON_INLINE sample_plane<texel_pack> broadcast(const sample_plane<float>& p) { return {p.x, p.y, p.c}; }
GNOMON_INLINE edge_equation<texel_pack> broadcast(const edge_equation<float>& f)
{
    return {broadcast(f.e0), broadcast(f.e1), broadcast(f.e2)};
}
GNOMON_INLINE triangle_setup<texel_pack> broadcast(const triangle_setup<float>& f)
{
    return {broadcast(f.a), broadcast(f.b), broadcast(f.c)};
}
GNOMON_INLINE depth_setup<texel_pack> broadcast(const depth_setup<float>& d)
{
    return {broadcast(d.n0), broadcast(d.n1), broadcast(d.n2), broadcast(d.n3), d.z0, d.z1, d.least, d.most};
}

// The edge functions of the same triangle, seen from the other side.
GNOMON_INLINE moving_edges<texel_pack> flipped(const moving_edges<texel_pack>& e)
{
    return {{-e.a.e0, -e.a.e1, -e.a.e2}, {-e.b.e0, -e.b.e1, -e.b.e2}, {-e.c.e0, -e.c.e1, -e.c.e2}};
}

// Margins by which edge functions are widened, so that rounding opens no cracks around a vertex.
struct edge_errors {
    float a = 0, b = 0, c = 0;

    edge_errors() = default;

    // The margins for samples within h of the origin of the equations.
    edge_errors(const triangle_setup<float>& equations, const glm::bvec3& linear, const glm::vec2& h)
    {
        const auto error = [&](const edge_equation<float>& f, bool is_linear) {
            return is_linear ? linear_edge_error(f, h.x, h.y) : edge_equation_error(f, h.x, h.y);
        };
        a = error(equations.a, linear.x), b = error(equations.b, linear.y), c = error(equations.c, linear.z);
    }

    float sum() const { return a + b + c; }
};

// The equations plus `times` their margins: 1 widens the triangle for the facing 1, -1 for the facing -1.
GNOMON_INLINE triangle_setup<float> widen(const triangle_setup<float>& f, const edge_errors& e, float times)
{
    return {edge_equation_widen(f.a, e.a, times), edge_equation_widen(f.b, e.b, times),
            edge_equation_widen(f.c, e.c, times)};
}

// A test of cells: when does a triangle cover any sample within reach of a cell's middle?
class cell_test {
  public:
    cell_test(const triangle_setup<float>& equations, const edge_errors& errors, const moving_setup& s, float reach)
        : setup_(s)
    {
        if (s.positive) positive_ = widen(triangle_setup_around(equations, reach, reach, 1.f), errors, 1);
        if (s.negative) negative_ = widen(triangle_setup_around(equations, reach, reach, -1.f), errors, -1);
    }

    // A bit for each lane whose cell is covered at some time.
    std::uint64_t operator()(const texel_pack& middle_x, const texel_pack& middle_y) const
    {
        const auto touched = [&](const triangle_setup<float>& around, float facing) {
            if (setup_.linear) {
                const auto times = linear_times(around, facing, middle_x, middle_y);
                return bits_of(times.begin < times.end);
            }
            return bits_of(quadratic_times(around, facing, middle_x, middle_y).count > texel_pack(0.f));
        };
        return (setup_.positive ? touched(positive_, 1) : 0) | (setup_.negative ? touched(negative_, -1) : 0);
    }

    // For each lane, the times from the first to the last at which its cell is covered; none unless begin < end.
    linear_interval<texel_pack> times(const texel_pack& middle_x, const texel_pack& middle_y) const
    {
        linear_interval<texel_pack> all{texel_pack(1.f), texel_pack(0.f)};
        const auto add = [&](const triangle_setup<float>& around, float facing) {
            linear_interval<texel_pack> seen;
            if (setup_.linear) seen = linear_times(around, facing, middle_x, middle_y);
            else {
                const auto x = quadratic_times(around, facing, middle_x, middle_y);
                const std::array ends{x.end0, x.end1, x.end2, x.end3};
                seen = {gnomon_min(x.begin0, texel_pack(1.f)), texel_pack(0.f)};
                for (std::size_t k = 0; k < ends.size(); ++k)
                    seen.end = gnomon_select(texel_pack(float(k)) < x.count, ends[k], seen.end);
            }
            all.begin = gnomon_min(all.begin, seen.begin), all.end = gnomon_max(all.end, seen.end);
        };
        if (setup_.positive) add(positive_, 1);
        if (setup_.negative) add(negative_, -1);
        return all;
    }

  private:
    GNOMON_INLINE static linear_interval<texel_pack> linear_times(const triangle_setup<float>& around, float facing,
                                                                  const texel_pack& x, const texel_pack& y)
    {
        const auto edges = triangle_setup_edges_linear(broadcast(around), x, y);
        return linear_coverage(facing < 0 ? flipped(edges) : edges);
    }
    GNOMON_INLINE static coverage_intervals<texel_pack> quadratic_times(const triangle_setup<float>& around,
                                                                        float facing, const texel_pack& x,
                                                                        const texel_pack& y)
    {
        return moving_coverage(triangle_setup_edges(broadcast(around), x, y), texel_pack(facing));
    }

    const moving_setup& setup_;
    triangle_setup<float> positive_, negative_; // set for the facings that the triangle has
};

// Offsets along x or y, from the middle of a tile, of the middles of Count cells: Row cells to a row, Size texels each.
template <int Count, int Row, int Size, bool Y> constexpr auto tile_offsets()
{
    std::array<float, std::size_t(Count)> result{};
    for (int i = 0; i < Count; ++i)
        result[std::size_t(i)] = float(Size) * (float(Y ? i / Row : i % Row) + 0.5f) - 0.5f * float(moving_tile_size);
    return result;
}

// For each block of a tile, times that contain those at which a triangle covers samples of it.
struct block_times {
    std::array<float, std::size_t(moving_blocks*moving_blocks)> begin, end;
};

// A pack of texels of a tile, in the order of range_map: their middles, from the middle of the tile.
struct moving_samples {
    static constexpr int per_block = moving_block_size * moving_block_size;
    static constexpr std::size_t packs_per_block = std::size_t(per_block) / texel_pack::size,
                                 packs_per_tile = range_map<float>::texels_per_tile / texel_pack::size;
    static_assert(std::size_t(per_block) % texel_pack::size == 0, "packs are parts of a block");

    glm::ivec2 block;
    int begin; // the first texel of the pack, counted in the block
    texel_pack x, y;

    explicit moving_samples(std::size_t number)
        : block(int(number / packs_per_block) % moving_blocks, int(number / packs_per_block) / moving_blocks),
          begin(int(number % packs_per_block * texel_pack::size))
    {
        static constexpr auto first_x = tile_offsets<per_block, moving_block_size, 1, false>(),
                              first_y = tile_offsets<per_block, moving_block_size, 1, true>();
        const glm::vec2 corner(block * moving_block_size);
        x = texel_pack::load_unaligned(&first_x[std::size_t(begin)]) + texel_pack(corner.x);
        y = texel_pack::load_unaligned(&first_y[std::size_t(begin)]) + texel_pack(corner.y);
    }

    // Coordinates in the tile of the texel of a lane.
    glm::ivec2 place(std::size_t lane) const
    {
        const int sample = begin + int(lane);
        return moving_block_size * block + glm::ivec2(sample % moving_block_size, sample / moving_block_size);
    }
};

// The times at which a triangle covers each texel of a pack, and its depth.
struct quadratic_coverage {
    const moving_setup& of;
    moving_edges<texel_pack> edges; // widened
    depth_curve<texel_pack> curve;

    // Up to four intervals in which the texels are covered by the side of this facing, 1 or -1.
    GNOMON_INLINE coverage_intervals<texel_pack> covered(float facing) const
    {
        const auto inside = [&](const moving_edge<texel_pack>& e, bool linear) {
            if (!linear) return moving_edge_inside(e, texel_pack(facing));
            const texel_pack side(facing), none(static_cast<float>(coverage_none));
            const linear_interval<texel_pack> times = linear_edge_inside(side * e.e0, side * e.e2);
            return edge_intervals<texel_pack>{times.begin, times.end, none, none};
        };
        return intersect_edge_intervals(inside(edges.a, of.linear_edges.x), inside(edges.b, of.linear_edges.y),
                                        inside(edges.c, of.linear_edges.z));
    }
    GNOMON_INLINE texel_pack depth(const texel_pack& t) const { return depth_curve_at(curve, t); }
    GNOMON_INLINE depth_line<texel_pack> line(const texel_pack& begin, const texel_pack& end) const
    {
        return depth_curve_line(curve, begin, end);
    }
};

// The coverage by a triangle that is linear in time (moving_setup::linear): one interval.
struct linear_tile_coverage {
    moving_edges<texel_pack> edges; // widened
    depth_curve<texel_pack> curve;

    GNOMON_INLINE linear_interval<texel_pack> covered(float facing) const
    {
        return linear_coverage(facing < 0 ? flipped(edges) : edges);
    }
    GNOMON_INLINE texel_pack depth(const texel_pack& t) const { return linear_depth_at(curve, t); }
    GNOMON_INLINE depth_line<texel_pack> line(const texel_pack& begin, const texel_pack& end) const
    {
        return linear_depth_line(curve, begin, end);
    }
};

// A triangle in one tile.
class tile_triangle {
  public:
    tile_triangle(const moving_setup& s, const moving_tile& where);

    const moving_setup& setup() const { return *setup_; }

    // A bit for each block in which the triangle covers a sample at some time, and on request these times. Where they
    // are not known better than as the whole shutter interval, `times` keeps what is in it.
    std::uint64_t blocks(float reach, block_times* times = nullptr) const
    {
        constexpr int count = moving_blocks * moving_blocks;
        static constexpr auto middle_x = tile_offsets<count, moving_blocks, moving_block_size, false>(),
                              middle_y = tile_offsets<count, moving_blocks, moving_block_size, true>();
        const auto number = [](const glm::ivec2& block) { return std::size_t(block.y * moving_blocks + block.x); };
        const std::uint64_t ends = std::uint64_t(1) << number(low_) | std::uint64_t(1) << number(high_);
        if (high_.x - low_.x + high_.y - low_.y < 2) return ends; // one block, or two neighbours: it reaches into both
        const cell_test touched(exact(), errors_, *setup_, 0.5f * float(moving_block_size - 1) + reach + margin);
        const std::size_t lanes = texel_pack::size, end = std::size_t((high_.y + 1) * moving_blocks);
        std::uint64_t blocks = 0;
        for (std::size_t i = std::size_t(low_.y * moving_blocks) / lanes * lanes; i < end; i += lanes) {
            const auto x = texel_pack::load_unaligned(&middle_x[i]), y = texel_pack::load_unaligned(&middle_y[i]);
            if (!times) {
                blocks |= touched(x, y) << i;
                continue;
            }
            const linear_interval<texel_pack> seen = touched.times(x, y);
            blocks |= bits_of(seen.begin < seen.end) << i;
            seen.begin.store_unaligned(&times->begin[i]), seen.end.store_unaligned(&times->end[i]);
        }
        // Drop blocks to the left and right of the texels that the triangle may cover.
        const std::uint64_t columns = (std::uint64_t(2) << high_.x) - (std::uint64_t(1) << low_.x);
        return blocks & columns * 0x0101010101010101;
    }

    GNOMON_INLINE quadratic_coverage quadratic(const moving_samples& s, float facing) const
    {
        const moving_edges<texel_pack> edges = facing < 0 ? triangle_setup_edges(broadcast(negative()), s.x, s.y)
                                                          : triangle_setup_edges(broadcast(wide_), s.x, s.y);
        return {*setup_, edges, curve(s, edges, facing)};
    }
    GNOMON_INLINE linear_tile_coverage linear(const moving_samples& s, float facing) const
    {
        const moving_edges<texel_pack> edges = facing < 0 ? triangle_setup_edges_linear(broadcast(negative()), s.x, s.y)
                                                          : triangle_setup_edges_linear(broadcast(wide_), s.x, s.y);
        return {edges, curve(s, edges, facing)};
    }

    // The equations but for rounding, and widened for the facing 1, and for -1.
    triangle_setup<float> exact() const { return widen(wide_, errors_, -1); }
    const triangle_setup<float>& positive() const { return wide_; }
    triangle_setup<float> negative() const { return widen(wide_, errors_, -2); }

    // True if all of the tile lies in the picture.
    bool whole() const { return whole_; }

    // True for the texels that the triangle may cover inside the picture.
    auto contains(const moving_samples& s) const
    {
        const glm::vec2 beyond = glm::vec2(last_) + 1.f - 0.5f * float(moving_tile_size);
        return s.x < texel_pack(beyond.x) && s.y < texel_pack(beyond.y);
    }
    bool contains(const glm::ivec2& place) const { return place.x <= last_.x && place.y <= last_.y; }

    // Distance in texels by which tests of cells exceed their samples: more than their rounding.
    static constexpr float margin = 0.05f;

  private:
    tile_triangle(const moving_setup& s, const moving_tile& where, const triangle_setup<double>& equations);

    // Depth over time. The edges are widened, so their sum exceeds the true one by the sum of the margins.
    GNOMON_INLINE depth_curve<texel_pack> curve(const moving_samples& s, const moving_edges<texel_pack>& edges,
                                                float facing) const
    {
        depth_curve<texel_pack> r = moving_depth_curve(broadcast(depths_), edges, s.x, s.y);
        const texel_pack excess(facing * errors_.sum());
        r.d0 = r.d0 - excess, r.d1 = r.d1 - (excess + excess), r.d2 = r.d2 - excess;
        return r;
    }

    const moving_setup* setup_;
    glm::ivec2 last_;       // the last texel that the triangle may cover
    glm::ivec2 low_, high_; // the first and the last block
    bool whole_;
    depth_setup<float> depths_;
    edge_errors errors_;
    triangle_setup<float> wide_; // the equations widened for the facing 1
};

} // namespace gnomon::renderer
