// A layered shadow map of moving geometry (Andersson et al. 2015), in the caller's memory. Tiles of the light's map have
// one to four layers each, and settings may divide these by motion. A layer is a grid of texels with its mips: the samples in
// its depths, moved along the layer's mean motion to the middle of the shutter interval. A tile in whose window nothing moves,
// and that has one layer, has no grid. Its texels are those of a plain map, of one texel per texel of the light's map, which is
// stored in blocks. Blocks and layers are stored only where samples need them.
//
//     layer_cluster(samples, settings, clusters, rows)             how many layers each tile has, and which depths
//     layer_allocate(settings, clusters, width, height, first, blocks)   where layers and blocks begin, and how many there are
//     layer_accumulate<Format>(samples, clusters, map, rows)       sums of samples, in grids and in blocks
//     layer_mips<Format>(map, rows)                                the smaller levels
//     layer_intensity<Format>(map, receiver)                       look-up
#ifndef GNOMON_PASSES_LAYER_MAP_HPP
#define GNOMON_PASSES_LAYER_MAP_HPP

#include "../../motion/layers/layer_clusters.h"
#include "../../motion/layers/layer_grid.h"
#include "../../motion/layers/layer_parts.h"
#include "../../storage/layer_formats.hpp"
#include "../mips.hpp"
#include "../sample_map.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

/// Sizes along an axis, as in Andersson 2015, Sec. 6, for a map of 512 x 512 texels.
struct layer_settings {
    std::size_t tile = 4;       // texels of the light's map in a tile
    std::size_t guard = 12;     // texels of the light's map in the window of samples around a tile
    std::size_t texels = 8;     // texels of a layer, a power of two
    std::size_t layers = 4;     // the most layers of a tile, 1 to 4
    bool even = true;           // weigh texels alike that are in the window for different parts of the shutter interval
    bool smooth_streaks = true; // blur layers of fast motion across that motion
    std::size_t division = 0;   // the fewest empty bins of 64 that divide a layer by motion; 0: layers are whole
    bool centres = false;       // samples are at texel centres (sample_ranges): a tilted plane has no gaps between them
};

/// The division of a layer into two parts that move unlike, of keys below `cut` (layer_direction_key) and others, and the
/// centres of their depths.
struct layer_division {
    layer_direction<float> direction{};
    float cut = float(layer_no_cut);
    std::array<float, 2> centres{};

    bool divides() const { return cut < float(layer_no_cut); }
};

/// The clusters of one tile, between the passes.
struct tile_clusters {
    layer_cuts<float> cuts;
    std::uint32_t layers; // with both parts of divided ones; 0 if the window has no sample of a surface
    bool is_static;       // nothing in the window moves
    std::array<layer_division, 4> divisions;
};

/// The numbers of layers, and of blocks of the plain map.
struct layer_counts {
    std::size_t layers = 0, blocks = 0;
};

inline constexpr std::size_t layer_most_texels = 32, layer_most_guard = 256;
inline constexpr std::size_t layer_block = 32;       // texels of the light's map along a block
inline constexpr std::uint32_t layer_no_block = ~0u; // a block that is not stored

/// The number of tiles or blocks along an extent.
constexpr std::size_t tiles_along(std::size_t extent, std::size_t tile) { return (extent + tile - 1) / tile; }

/// The number of texels before a level of the mips of a square. The side is a power of two.
constexpr std::size_t square_mip_begin(std::size_t side, std::size_t level)
{
    return (side * side - (side >> level) * (side >> level)) / 3 * 4;
}

/// The number of texels of a layer, with its mips.
constexpr std::size_t layer_texels(const layer_settings& settings)
{
    return mip_texels(settings.texels, settings.texels);
}

/// The number of levels of a block: a texel of the last level is no larger than the margin of the window around a tile.
constexpr std::size_t block_levels(const layer_settings& settings)
{
    const std::size_t margin = (std::max)((settings.guard - settings.tile) / 2, std::size_t(1));
    return (std::min)(mip_levels(margin, margin), mip_levels(layer_block, layer_block));
}

/// The number of texels of a block, with its mips.
constexpr std::size_t block_texels(const layer_settings& settings)
{
    return square_mip_begin(layer_block, block_levels(settings));
}

/// A layered map for light maps of width x height texels. Tiles and blocks are counted row by row. Tile i has the layers
/// first[i] to first[i + 1] - 1. Layer n has the texels from n layer_texels(settings) on, the largest level first. Block
/// blocks[i] of the plain map has those from blocks[i] block_texels(settings) on.
template <class Texel> struct layer_map {
    template <class T> using part = std::span<std::conditional_t<std::is_const_v<Texel>, const T, T>>;

    std::size_t width = 0, height = 0;
    layer_settings settings;
    std::span<const std::uint32_t> first;
    std::span<const std::uint32_t> blocks;
    part<layer_grid<float>> grids;
    std::span<Texel> texels, plain;

    constexpr std::size_t columns() const { return tiles_along(width, settings.tile); }
    constexpr std::size_t rows() const { return tiles_along(height, settings.tile); }
    constexpr operator layer_map<const Texel>() const
    {
        return {width, height, settings, first, blocks, grids, texels, plain};
    }
};

/// The size of a map in bytes: texels, grids and tables.
template <class Texel> std::size_t layer_bytes(const layer_map<Texel>& map)
{
    return map.first.size_bytes() + map.blocks.size_bytes() + map.grids.size_bytes() + map.texels.size_bytes() +
           map.plain.size_bytes();
}

/// Check settings against what grids and windows can be.
inline void check_settings(const layer_settings& s, std::string_view pass)
{
    GNOMON_EXPECTS(s.tile > 0, mismatch(pass, "settings.tile", s.tile, "the least", 1));
    GNOMON_EXPECTS(s.guard >= s.tile,
                   mismatch(pass, "settings.guard", s.guard, "settings.tile, which it contains,", s.tile));
    GNOMON_EXPECTS(s.guard <= layer_most_guard,
                   mismatch(pass, "settings.guard", s.guard, "the most", layer_most_guard));
    GNOMON_EXPECTS((s.guard - s.tile) % 2 == 0, mismatch(pass, "settings.guard", s.guard,
                                                         "settings.tile, with the same margin on both sides,", s.tile));
    GNOMON_EXPECTS(std::has_single_bit(s.texels) && s.texels <= layer_most_texels,
                   mismatch(pass, "settings.texels", s.texels, "the largest power of two", layer_most_texels));
    GNOMON_EXPECTS(s.layers > 0, mismatch(pass, "settings.layers", s.layers, "the least", 1));
    GNOMON_EXPECTS(s.layers <= 4, mismatch(pass, "settings.layers", s.layers, "the most", 4));
}

/// Check the sizes of a map's arrays.
template <class Texel> void check_shape(const layer_map<Texel>& map, std::string_view pass)
{
    check_settings(map.settings, pass);
    const auto expect = [&](bool holds, std::string_view name, std::size_t size, std::string_view other,
                            std::size_t n) { GNOMON_EXPECTS(holds, mismatch(pass, name, size, other, n)); };
    expect(map.width > 0 && map.height > 0, "map.width", map.width, "map.height", map.height);
    const std::size_t tiles = map.columns() * map.rows() + 1;
    expect(map.first.size() == tiles, "map.first.size()", map.first.size(), "the number of tiles + 1", tiles);
    const std::size_t blocks = tiles_along(map.width, layer_block) * tiles_along(map.height, layer_block);
    expect(map.blocks.size() == blocks, "map.blocks.size()", map.blocks.size(), "the number of blocks", blocks);
    const std::size_t layers = map.first.back(), each = layer_texels(map.settings);
    expect(map.grids.size() == layers, "map.grids.size()", map.grids.size(), "map.first.back()", layers);
    expect(map.texels.size() == layers * each, "map.texels.size()", map.texels.size(), "texels of layers",
           layers * each);
    const std::size_t block = block_texels(map.settings);
    expect(map.plain.size() % block == 0, "map.plain.size()", map.plain.size(), "texels of a block", block);
}

GNOMON_NAMESPACE_END
#endif
