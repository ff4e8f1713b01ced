// Moving triangles, ready to be sampled by packs of texels: what the rasterizer of motion is made of. A setup knows
// where a triangle may be seen and which sides of it, a tile which triangles it has, and a triangle in a tile goes
// through the blocks of texels that it touches at some time.
#pragma once

#include "rasterizer.hpp"
#include "renderer/scene/moving_scene.hpp"

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

using texel_pack = xsimd::batch<float>;
using texel_lanes = std::array<float, texel_pack::size>;

// A bit for each lane; xsimd 8 has no such function.
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

// As maps of ranges count.
inline constexpr int moving_tile_size = int(range_map<float>::tile), moving_block_size = int(range_map<float>::block);
inline constexpr int moving_blocks = moving_tile_size / moving_block_size; // along a side of a tile
static_assert(moving_blocks * moving_blocks == 64, "a tile has a bit for each block");

// A triangle: x and y in texels times w, z the linear depth, by which lists are sorted.
struct moving_setup {
    moving_triangle<double> corners;
    glm::ivec2 first, last;  // texels that it may cover, both included
    bool positive, negative; // whether its edge functions are ever all positive, and all negative
    bool before_eye;         // all of it, all of the time
    bool between_planes;     // near and far
    glm::bvec3 linear_edges; // those across from the corners whose functions are linear in time
    bool linear;             // all of them, and the corners' depths change alike
    float nearest;           // depth
    std::uint32_t number;    // counted through all meshes
};

struct moving_tile {
    glm::ivec2 corner, size; // size: of what lies in the picture
    int picture_width;

    // Row by row in the picture.
    std::size_t pixel(const glm::ivec2& inside) const
    {
        return std::size_t(corner.y + inside.y) * std::size_t(picture_width) + std::size_t(corner.x + inside.x);
    }
};

// All triangles, by the tiles in which they are seen at some time.
class tiled_triangles {
  public:
    // Throws std::invalid_argument for a picture that is empty or too large.
    tiled_triangles(const moving_scene& world, const moving_camera& eye, int width, int height, faces visible);

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
    std::vector<moving_setup> setups_;
    std::vector<std::uint32_t> first_, members_;
};

// A struct of numbers, rounded to float; To: float, or a pack that has it in every lane.
template <class To, template <class, class> class Struct, class From>
Struct<To, To> numbers_as(const Struct<From, From>& x)
{
    const auto given = std::bit_cast<std::array<From, sizeof x / sizeof(From)>>(x);
    std::array<To, given.size()> result;
    std::ranges::transform(given, result.begin(), [](From r) { return To(static_cast<float>(r)); });
    return std::bit_cast<Struct<To, To>>(result);
}

// The same in every lane; member by member, which compilers keep in registers.
GNOMON_INLINE sample_plane<texel_pack> in_lanes(const sample_plane<float>& p) { return {p.x, p.y, p.c}; }
GNOMON_INLINE edge_equation<texel_pack> in_lanes(const edge_equation<float>& f)
{
    return {in_lanes(f.e0), in_lanes(f.e1), in_lanes(f.e2)};
}
GNOMON_INLINE triangle_setup<texel_pack> in_lanes(const triangle_setup<float>& f)
{
    return {in_lanes(f.a), in_lanes(f.b), in_lanes(f.c)};
}
GNOMON_INLINE depth_setup<texel_pack> in_lanes(const depth_setup<float>& d)
{
    return {in_lanes(d.n0), in_lanes(d.n1), in_lanes(d.n2), in_lanes(d.n3), d.z0, d.z1, d.least, d.most};
}

// Of the same triangle from the other side.
GNOMON_INLINE moving_edges<texel_pack> turned(const moving_edges<texel_pack>& e)
{
    return {{-e.a.e0, -e.a.e1, -e.a.e2}, {-e.b.e0, -e.b.e1, -e.b.e2}, {-e.c.e0, -e.c.e1, -e.c.e2}};
}

// The margins by which edge functions are widened, lest rounding opens cracks around a vertex.
struct edge_errors {
    float a = 0, b = 0, c = 0;

    edge_errors() = default;

    // Of the samples within h of the field's origin.
    edge_errors(const triangle_setup<float>& field, const glm::bvec3& linear, const glm::vec2& h)
    {
        const auto error = [&](const edge_equation<float>& f, bool is_linear) {
            return is_linear ? linear_edge_error(f, h.x, h.y) : edge_equation_error(f, h.x, h.y);
        };
        a = error(field.a, linear.x), b = error(field.b, linear.y), c = error(field.c, linear.z);
    }

    float sum() const { return a + b + c; }
};

// By its errors where times is 1, to the other side where it is -1.
GNOMON_INLINE triangle_setup<float> widened(const triangle_setup<float>& f, const edge_errors& e, float times)
{
    return {edge_equation_widen(f.a, e.a, times), edge_equation_widen(f.b, e.b, times),
            edge_equation_widen(f.c, e.c, times)};
}

// Which cells, the samples within reach of their middles, a triangle covers at some time.
class touched_cells {
  public:
    touched_cells(const triangle_setup<float>& field, const edge_errors& errors, const moving_setup& s, float reach)
        : setup_(s)
    {
        if (s.positive) positive_ = widened(triangle_setup_around(field, reach, reach, 1.f), errors, 1);
        if (s.negative) negative_ = widened(triangle_setup_around(field, reach, reach, -1.f), errors, -1);
    }

    // A bit for each lane.
    std::uint64_t operator()(const texel_pack& middle_x, const texel_pack& middle_y) const
    {
        const auto touched = [&](const triangle_setup<float>& around, float facing) {
            if (setup_.linear) {
                const auto edges = triangle_setup_edges_linear(in_lanes(around), middle_x, middle_y);
                const auto times = linear_coverage(facing < 0 ? turned(edges) : edges);
                return bits_of(times.begin < times.end);
            }
            const auto edges = triangle_setup_edges(in_lanes(around), middle_x, middle_y);
            return bits_of(moving_coverage(edges, texel_pack(facing)).count > texel_pack(0.f));
        };
        return (setup_.positive ? touched(positive_, 1) : 0) | (setup_.negative ? touched(negative_, -1) : 0);
    }

  private:
    const moving_setup& setup_;
    triangle_setup<float> positive_, negative_; // of the facings that it has
};

// Where things of some size, in rows of some length, are from the middle of a tile, along x or y.
template <int Count, int Row, int Size, bool Y> constexpr auto tile_offsets()
{
    std::array<float, std::size_t(Count)> result{};
    for (int i = 0; i < Count; ++i)
        result[std::size_t(i)] = float(Size) * (float(Y ? i / Row : i % Row) + 0.5f) - 0.5f * float(moving_tile_size);
    return result;
}

// A pack of the samples of a tile, as range_map counts them.
struct moving_samples {
    static constexpr int per_block = moving_block_size * moving_block_size;
    static constexpr std::size_t packs_per_block = std::size_t(per_block) / texel_pack::size,
                                 packs_per_tile = range_map<float>::texels_per_tile / texel_pack::size;
    static_assert(std::size_t(per_block) % texel_pack::size == 0, "packs are parts of a block");

    glm::ivec2 block;
    int begin; // of the block's samples
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

    // Where in the tile one of them is.
    glm::ivec2 place(std::size_t lane) const
    {
        const int sample = begin + int(lane);
        return moving_block_size * block + glm::ivec2(sample % moving_block_size, sample / moving_block_size);
    }
};

struct range_pack {
    texel_pack t0, t1, z0, z1;
};

// What of a triangle a pack of samples sees.
struct quadratic_coverage {
    const moving_setup& of;
    moving_edges<texel_pack> edges; // widened
    depth_curve<texel_pack> curve;

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

// Of one that is linear in time.
struct linear_tile_coverage {
    moving_edges<texel_pack> edges; // widened
    depth_curve<texel_pack> curve;

    GNOMON_INLINE linear_interval<texel_pack> covered(float facing) const
    {
        return linear_coverage(facing < 0 ? turned(edges) : edges);
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

    // A bit for each block whose samples it covers at some time.
    std::uint64_t blocks() const
    {
        constexpr int count = moving_blocks * moving_blocks;
        static constexpr auto middle_x = tile_offsets<count, moving_blocks, moving_block_size, false>(),
                              middle_y = tile_offsets<count, moving_blocks, moving_block_size, true>();
        const auto number = [](const glm::ivec2& block) { return std::size_t(block.y * moving_blocks + block.x); };
        const std::uint64_t ends = std::uint64_t(1) << number(low_) | std::uint64_t(1) << number(high_);
        if (high_.x - low_.x + high_.y - low_.y < 2) return ends; // it reaches into both
        const touched_cells touched(widened(wide_, errors_, -1), errors_, *setup_,
                                    0.5f * float(moving_block_size - 1) + margin);
        const std::size_t lanes = texel_pack::size, end = std::size_t((high_.y + 1) * moving_blocks);
        std::uint64_t blocks = 0;
        for (std::size_t i = std::size_t(low_.y * moving_blocks) / lanes * lanes; i < end; i += lanes)
            blocks |= touched(texel_pack::load_unaligned(&middle_x[i]), texel_pack::load_unaligned(&middle_y[i])) << i;
        // Not beyond where its corners are seen.
        const std::uint64_t columns = (std::uint64_t(2) << high_.x) - (std::uint64_t(1) << low_.x);
        return blocks & columns * 0x0101010101010101;
    }

    GNOMON_INLINE quadratic_coverage curved(const moving_samples& s, float facing) const
    {
        const moving_edges<texel_pack> edges = facing < 0 ? triangle_setup_edges(in_lanes(negative()), s.x, s.y)
                                                          : triangle_setup_edges(in_lanes(wide_), s.x, s.y);
        return {*setup_, edges, curve(s, edges, facing)};
    }
    GNOMON_INLINE linear_tile_coverage linear(const moving_samples& s, float facing) const
    {
        const moving_edges<texel_pack> edges = facing < 0 ? triangle_setup_edges_linear(in_lanes(negative()), s.x, s.y)
                                                          : triangle_setup_edges_linear(in_lanes(wide_), s.x, s.y);
        return {edges, curve(s, edges, facing)};
    }

    // True where all of the tile is in the picture.
    bool whole() const { return whole_; }

    // The samples that are in the picture.
    auto contains(const moving_samples& s) const
    {
        const glm::vec2 beyond = glm::vec2(last_) + 1.f - 0.5f * float(moving_tile_size);
        return s.x < texel_pack(beyond.x) && s.y < texel_pack(beyond.y);
    }
    bool contains(const glm::ivec2& place) const { return place.x <= last_.x && place.y <= last_.y; }

    // What blocks are tested for beyond their samples, in texels: more than rounding takes from them.
    static constexpr float margin = 0.05f;

  private:
    tile_triangle(const moving_setup& s, const moving_tile& where, const triangle_setup<double>& field);

    // The field widened for the facing -1.
    triangle_setup<float> negative() const { return widened(wide_, errors_, -2); }

    // From edges that are widened.
    GNOMON_INLINE depth_curve<texel_pack> curve(const moving_samples& s, const moving_edges<texel_pack>& edges,
                                                float facing) const
    {
        depth_curve<texel_pack> r = moving_depth_curve(in_lanes(depths_), edges, s.x, s.y);
        const texel_pack excess(facing * errors_.sum());
        r.d0 = r.d0 - excess, r.d1 = r.d1 - (excess + excess), r.d2 = r.d2 - excess;
        return r;
    }

    const moving_setup* setup_;
    glm::ivec2 last_, low_, high_; // texel, blocks
    bool whole_;
    depth_setup<float> depths_;
    edge_errors errors_;
    triangle_setup<float> wide_; // widened for the facing 1
};

// The triangles of a tile, by the blocks that they touch.
class tile_bins {
  public:
    void assign(const tiled_triangles& scenery, std::size_t tile, bool front_to_back = false);

    // Calls visit(triangle) for those of a block, by their nearest depth or in the order of their numbers.
    template <class Visit> void for_each(std::size_t block, const Visit& visit) const
    {
        for (std::size_t k = 0; k < touching_.size(); ++k)
            for_each_bit(touching_[k][block], [&](std::size_t i) { visit(triangles_[64 * k + i]); });
    }

  private:
    std::vector<const moving_setup*> members_;
    std::vector<tile_triangle> triangles_;
    std::vector<std::array<std::uint64_t, 64>> touching_; // of 64 triangles each, by blocks, a bit for each triangle
};

} // namespace gnomon::renderer
