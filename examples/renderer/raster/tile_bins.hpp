// The triangles of one tile of a moving picture, by blocks of texels.
#pragma once

#include "moving_tiles.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::renderer {

// The triangles of a tile, sorted into the blocks that they touch.
class tile_bins {
  public:
    // With the times at which blocks are touched, or without.
    explicit tile_bins(bool timed = false) : timed_(timed) {}

    void assign(const tiled_triangles& scenery, std::size_t tile, bool front_to_back = false);

    const tile_triangle& operator[](std::size_t i) const { return triangles_[i]; }
    std::size_t index_of(const tile_triangle& triangle) const { return std::size_t(&triangle - triangles_.data()); }

    // Calls visit(triangle) for the triangles of a block, front to back or in the order of their numbers.
    template <class Visit> void for_each(std::size_t block, const Visit& visit) const
    {
        for (std::size_t k = 0; k < touching_.size(); ++k)
            for_each_bit(touching_[k][block], [&](std::size_t i) { visit(triangles_[64 * k + i]); });
    }

    // Times that contain those at which triangle i covers samples of a block.
    linear_interval<float> times(std::size_t i, std::size_t block) const
    {
        return {times_[i].begin[block], times_[i].end[block]};
    }

  private:
    bool timed_;
    std::vector<const moving_setup*> members_;
    std::vector<tile_triangle> triangles_;
    std::vector<block_times> times_;
    std::vector<std::array<std::uint64_t, 64>> touching_; // for 64 triangles each: for each block, a bit per triangle
};

} // namespace gnomon::renderer
