// Moving triangles, ready to be sampled by packs of texels: what the rasterizer of motion is made of. A setup knows
// where a triangle may be seen and which sides of it, a tile which triangles it has, and a triangle in a tile goes
// through the blocks of texels that it touches at some time.
#pragma once

#include <gnomon/motion/edge_field.h>
#include <gnomon/passes/range_map.hpp>
#include <gnomon/simd/xsimd.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "moving_scene.hpp"
#include "rasterizer.hpp"

namespace gnomon::toolbox {

using texel_pack = xsimd::batch<float>;
using texel_lanes = std::array<float, texel_pack::size>;

inline constexpr int moving_tile_size = 32, moving_block_size = 4;

// A triangle: x and y in texels times w, z the linear depth, by which lists are sorted.
struct moving_setup {
    moving_triangle<double> corners;
    glm::ivec2 first, last;  // texels that it may cover, both included
    bool positive, negative; // whether its edge functions are ever all positive, and all negative
    std::uint32_t number;    // counted through all meshes
};

struct moving_tile {
    glm::ivec2 corner, size; // size: of what lies in the picture
    int picture_width;

    // Numbers of a place in the tile: row by row in the picture, and as range_map counts.
    std::size_t pixel(const glm::ivec2& inside) const
    {
        return std::size_t(corner.y + inside.y) * std::size_t(picture_width) + std::size_t(corner.x + inside.x);
    }
    std::size_t texel(const glm::ivec2& inside) const
    {
        return range_map<float>::texel(std::size_t(picture_width), std::size_t(corner.x + inside.x),
                                       std::size_t(corner.y + inside.y));
    }
};

// All triangles, by the tiles in which they are seen at some time.
class tiled_triangles {
  public:
    // Throws std::invalid_argument for a picture that is empty or too large.
    tiled_triangles(const moving_scene& world, const moving_camera& eye, int width, int height, faces visible);

    std::size_t tiles() const { return first_.size() - 1; }
    std::size_t columns() const { return std::size_t(grid_.x); }
    std::size_t rows() const { return std::size_t(grid_.y); }
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

// The edge functions of a setup around a place of the picture.
moving_field<texel_pack> texel_field(const moving_setup& s, const glm::dvec2& origin);

// Calls visit(cell) for each cell from low to high of a grid whose samples, within reach of its middle, the triangle
// covers at some time; the middle of the cell (0, 0) is at start from the field's origin.
template <class Visit>
void for_each_touched(const moving_field<texel_pack>& field, const moving_setup& s, const glm::ivec2& low,
                      const glm::ivec2& high, const glm::vec2& start, float step, float reach, const Visit& visit)
{
    const auto next = [&](glm::ivec2& cell) {
        if (++cell.x > high.x) cell = {low.x, cell.y + 1};
    };
    texel_lanes x, y, duration;
    for (glm::ivec2 begin = low, end = low; begin.y <= high.y; begin = end) {
        for (std::size_t i = 0; i < texel_pack::size; ++i, next(end))
            x[i] = start.x + step * float(end.x), y[i] = start.y + step * float(end.y);
        const texel_pack s_x = texel_pack::load_unaligned(x.data()), s_y = texel_pack::load_unaligned(y.data());
        texel_pack covered(0.f);
        for (const float facing : {1.f, -1.f})
            if (facing > 0 ? s.positive : s.negative)
                covered += coverage_duration(moving_coverage(
                    moving_field_block(field, s_x, s_y, texel_pack(reach), texel_pack(reach), texel_pack(facing)),
                    texel_pack(facing)));
        covered.store_unaligned(duration.data());
        glm::ivec2 cell = begin;
        for (std::size_t i = 0; i < texel_pack::size && cell.y <= high.y; ++i, next(cell))
            if (duration[i] > 0) visit(cell);
    }
}

// Where the samples of a tile's first block are from the middle of the tile, along x or y; a pack may be longer than
// they are.
template <bool Row> constexpr auto moving_block_samples()
{
    constexpr int count = moving_block_size * moving_block_size;
    std::array<float, std::max<std::size_t>(count, texel_pack::size)> result{};
    for (int i = 0; i < int(result.size()); ++i)
        result[std::size_t(i)] =
            float(Row ? i / moving_block_size : i % moving_block_size) + 0.5f - 0.5f * float(moving_tile_size);
    return result;
}

// A triangle in one tile.
class tile_triangle {
  public:
    tile_triangle(const moving_setup& s, const moving_tile& where);

    // Calls visit(block, first sample, edge functions) for packs of samples in the blocks that it touches.
    template <class Visit> void for_each_pack(const Visit& visit) const
    {
        const auto visit_block = [&](const glm::ivec2& block) {
            const glm::vec2 corner(block * moving_block_size);
            for (std::size_t begin = 0; begin < samples_x.size(); begin += texel_pack::size)
                visit(block, int(begin),
                      moving_field_edges(field_, texel_pack::load_unaligned(&samples_x[begin]) + texel_pack(corner.x),
                                         texel_pack::load_unaligned(&samples_y[begin]) + texel_pack(corner.y)));
        };
        constexpr float size = float(moving_block_size);
        if (low_ == high_) visit_block(low_);
        else
            for_each_touched(field_, setup_, low_, high_, glm::vec2(0.5f * (size - float(moving_tile_size))), size,
                             0.5f * (size - 1) + margin, visit_block);
    }

    // Where in the tile a sample of a block is, its number there as range_map counts, and whether that is in the
    // picture.
    static glm::ivec2 place(const glm::ivec2& block, int sample)
    {
        return moving_block_size * block + glm::ivec2(sample % moving_block_size, sample / moving_block_size);
    }
    static std::uint32_t texel(const glm::ivec2& block, int sample)
    {
        const glm::ivec2 at = place(block, sample);
        return static_cast<std::uint32_t>(
            range_map<float>::texel(moving_tile_size, std::size_t(at.x), std::size_t(at.y)));
    }
    bool contains(const glm::ivec2& place) const { return place.x <= last_.x && place.y <= last_.y; }
    // The same for a pack of samples.
    auto contains(const glm::ivec2& block, int sample) const
    {
        const glm::vec2 beyond = glm::vec2(last_ - moving_block_size * block) + 1.f - 0.5f * float(moving_tile_size);
        return texel_pack::load_unaligned(&samples_x[std::size_t(sample)]) < texel_pack(beyond.x) &&
               texel_pack::load_unaligned(&samples_y[std::size_t(sample)]) < texel_pack(beyond.y);
    }

    // What blocks are tested for beyond their samples, in texels: more than rounding takes from them.
    static constexpr float margin = 0.05f;

  private:
    static constexpr auto samples_x = moving_block_samples<false>(), samples_y = moving_block_samples<true>();

    const moving_setup& setup_;
    glm::ivec2 last_, low_, high_; // texel, blocks
    moving_field<texel_pack> field_;
};

} // namespace gnomon::toolbox
