// Shadow intensity of a receiver in a layered map (Andersson et al. 2015, Sec. 4.2 and 5): the product of visibilities
// through all layers of its tile, each from sums over the receiver's footprint on the layer's grid, with up to 16 trilinear
// probes. Where the sums have no weight, the level grows until there is some; without any the layer is transparent. Outside
// of the map everything is lit.
#ifndef GNOMON_PASSES_LAYER_LOOK_UP_HPP
#define GNOMON_PASSES_LAYER_LOOK_UP_HPP

#include "../../motion/layers/layer_look_up.h"
#include "../look_up.hpp"
#include "layer_map.hpp"

GNOMON_NAMESPACE_BEGIN

/// A receiver at time t: its place (x, y) on the light's map and its depth, without a bias; the ends of its footprint, where
/// the light sees its world point, held in camera space, at times t0 and t1; the second axis of the footprint, the extent
/// of a pixel on the map; the change of depth per texel of the map; and two random numbers from 0 to 1 that choose a tile.
template <class T> struct layer_receiver {
    T x, y, z, t, x0, y0, t0, x1, y1, t1, cross_x, cross_y, slope, random_x, random_y;
};

/// The tiles that a look-up reads.
enum class layer_tiles {
    own,    // the receiver's
    random, // it or a neighbour, by the receiver's random numbers, as in Andersson 2015
    blended // it and its neighbours, by weights that leave no border
};

/// The bias and the filters of a look-up. `rounding` is a bias in depth for the roundings by which samples and receivers on
/// one surface differ; for a layer that moves in depth by more than 16 it grows in proportion.
struct layer_look_up {
    layer_tiles tiles = layer_tiles::random;
    bool widen = false;       // footprints, bias and least variance by the spread of motion in a layer
    float reach = 0.5f;       // texels of a layer over which the bias follows the slope
    float limit = 0.015625f;  // the largest bias of a slope
    float rounding = 8e-6f;   // in depth
    float least_variance = 0; // of depth
};

namespace detail {

/// Add to sums a texel's, times a weight.
template <layer_format Format>
GNOMON_INLINE void add_texel(channel_array<Format>& sums, const format_texel<Format>& texel, float weight)
{
    const auto c = load_channels<Format>(texel);
    for (std::size_t k = 0; k < c.size(); ++k) sums[k] += weight * c[k];
}

/// The mips of a layer.
template <class Texel> struct square_mips {
    const Texel* texels;
    std::size_t side;

    std::size_t levels() const { return mip_levels(side, side); }
    template <layer_format Format>
    GNOMON_INLINE void add(channel_array<Format>& sums, float weight, float u, float v, std::size_t level) const
    {
        const std::size_t extent = side >> level;
        const float scale = 1 / float(std::size_t(1) << level);
        const neighbours nu = neighbours_of<border_mode::clamp>(u * scale - 0.5f, extent);
        const neighbours nv = neighbours_of<border_mode::clamp>(v * scale - 0.5f, extent);
        const Texel* const begin = texels + square_mip_begin(side, level);
        const float upper = weight * nv.fraction, lower = weight - upper;
        add_texel<Format>(sums, begin[nv.lower * extent + nu.lower], lower * (1 - nu.fraction));
        add_texel<Format>(sums, begin[nv.lower * extent + nu.upper], lower * nu.fraction);
        add_texel<Format>(sums, begin[nv.upper * extent + nu.lower], upper * (1 - nu.fraction));
        add_texel<Format>(sums, begin[nv.upper * extent + nu.upper], upper * nu.fraction);
    }
};

/// The plain map, by places from a corner of a tile's window.
template <class Texel> struct plain_mips {
    const layer_map<const Texel>& map;
    float x, y;

    std::size_t levels() const { return block_levels(map.settings); }
    template <layer_format Format>
    GNOMON_INLINE void add(channel_array<Format>& sums, float weight, float u, float v, std::size_t level) const
    {
        const std::size_t side = layer_block >> level, unit = std::size_t(1) << level;
        const std::size_t columns = (map.width + unit - 1) >> level, rows = (map.height + unit - 1) >> level;
        const float scale = 1 / float(unit);
        const neighbours nx = neighbours_of<border_mode::lit>((x + u) * scale - 0.5f, columns);
        const neighbours ny = neighbours_of<border_mode::lit>((y + v) * scale - 0.5f, rows);
        const float upper = weight * ny.fraction, lower = weight - upper;
        const std::array<float, 4> weights{lower * (1 - nx.fraction), lower * nx.fraction, upper * (1 - nx.fraction),
                                           upper * nx.fraction};
        const std::size_t i = nx.lower & (side - 1), j = ny.lower & (side - 1);
        if (nx.lower < columns && ny.lower < rows && i + 1 < side && j + 1 < side) { // in one block
            const std::uint32_t block = block_of(nx.lower, ny.lower, level);
            if (block == layer_no_block) return;
            const Texel* const texel = texels_of(block, level) + (j * side + i);
            const std::size_t right = nx.upper - nx.lower, down = (ny.upper - ny.lower) * side;
            add_texel<Format>(sums, texel[0], weights[0]);
            add_texel<Format>(sums, texel[right], weights[1]);
            add_texel<Format>(sums, texel[down], weights[2]);
            add_texel<Format>(sums, texel[down + right], weights[3]);
            return;
        }
        const std::array<std::size_t, 2> across{nx.lower, nx.upper}, along{ny.lower, ny.upper};
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t column = across[k & 1], row = along[k >> 1];
            if (!(column < columns && row < rows)) continue; // beside the map
            const std::uint32_t block = block_of(column, row, level);
            if (block != layer_no_block)
                add_texel<Format>(sums, texels_of(block, level)[(row & (side - 1)) * side + (column & (side - 1))],
                                  weights[k]);
        }
    }

  private:
    std::uint32_t block_of(std::size_t column, std::size_t row, std::size_t level) const
    {
        return map.blocks[(row << level) / layer_block * tiles_along(map.width, layer_block) +
                          (column << level) / layer_block];
    }
    const Texel* texels_of(std::uint32_t block, std::size_t level) const
    {
        return map.plain.data() + block * block_texels(map.settings) + square_mip_begin(layer_block, level);
    }
};

/// Sums over the probes of a footprint, at a level between two of the mips, or at the first one above at which there is
/// any weight.
template <layer_format Format>
channel_array<Format> sums_over(const layer_footprint<float>& footprint, const auto& mips)
{
    const std::size_t last = mips.levels() - 1;
    const neighbours nl = neighbours_of<border_mode::clamp>(footprint.level, mips.levels());
    channel_array<Format> sums{};
    const auto add = [&](float weight, std::size_t level) {
        for (float k = 0; k < footprint.probes; ++k) {
            const layer_place<float> place = layer_probe(footprint, k);
            mips.template add<Format>(sums, weight, place.u, place.v, level);
        }
    };
    const auto weight = [&] { return gnomon_bit_cast<format_channels<Format>>(sums).weight; };
    add(1 - nl.fraction, nl.lower);
    if (nl.fraction > 0) add(nl.fraction, nl.upper);
    for (std::size_t level = nl.upper; !(weight() > 0) && level < last;) add(1, ++level);
    return sums;
}

/// Visibility through one layer of a tile with centre (x, y).
template <layer_format Format>
float visibility_through(layer_grid<float> grid, const auto& mips, float x, float y, const layer_receiver<float>& r,
                         const layer_look_up& look_up)
{
    if (!look_up.widen) grid.spread = grid.spread_z = 0;
    // Depths that move by d_z are rounded by less than 2^-22 (1 + |d_z|), which 8e-6 hides up to 16.
    const float rounding = gnomon_max(look_up.rounding, 0.0625f * look_up.rounding * gnomon_abs(grid.d_z));
    const auto own_depth = [&](float reach) {
        const float bias = layer_bias(grid, r.slope, r.slope, r.t, reach, look_up.limit);
        return layer_grid_own_depth(grid, r.z - (bias + rounding), r.t);
    };
    if (!(own_depth(look_up.reach) > -1)) return 1; // before all of it
    const auto footprint = layer_footprint_make(grid, r.x0 - x, r.y0 - y, r.t0, r.x1 - x, r.y1 - y, r.t1, r.cross_x,
                                                r.cross_y, layer_widening(grid, r.t));
    // The centre of a footprint that ends at the shutter's times, or at the grid's border, is beside the receiver.
    const layer_place<float> place = layer_grid_place(grid, r.x - x, r.y - y, r.t);
    const float off_u = gnomon_abs(place.u - footprint.u), off_v = gnomon_abs(place.v - footprint.v);
    if (!(off_u + off_v >= 0)) return 1; // a place of NaN
    const float z = own_depth(look_up.reach + gnomon_max(off_u, off_v));
    if (!(z > -1)) return 1;
    const float least = layer_minimum_variance(grid, r.slope, look_up.least_variance);
    const auto sums = gnomon_bit_cast<format_channels<Format>>(sums_over<Format>(footprint, mips));
    return Format::visibility(sums, z, gnomon_max(least, float(Format::least_variance)));
}

/// The grid by which a receiver sees the plain map: that of a window without motion, of a texel per texel.
inline layer_grid<float> plain_grid(float guard)
{
    layer_motion<float> still{};
    still.least = -1;
    still.greatest = 1;
    return layer_grid_make(still, guard, guard);
}

/// Visibility in tile (column, row).
template <layer_format Format>
float visibility_in(const layer_map<const format_texel<Format>>& map, std::size_t column, std::size_t row,
                    const layer_receiver<float>& r, const layer_look_up& look_up)
{
    const layer_settings& s = map.settings;
    const float x = (float(column) + 0.5f) * float(s.tile), y = (float(row) + 0.5f) * float(s.tile);
    const std::size_t i = row * map.columns() + column;
    if (map.first[i] == map.first[i + 1]) {
        if (map.plain.empty()) return 1;
        const layer_grid<float> grid = plain_grid(float(s.guard));
        const plain_mips<format_texel<Format>> mips{map, x - grid.middle, y - grid.middle};
        return visibility_through<Format>(grid, mips, x, y, r, look_up);
    }
    float visibility = 1;
    for (std::size_t n = map.first[i]; n < map.first[i + 1] && visibility > 0; ++n) {
        const square_mips<format_texel<Format>> mips{&map.texels[n * layer_texels(s)], s.texels};
        visibility *= visibility_through<Format>(map.grids[n], mips, x, y, r, look_up);
    }
    return visibility;
}

} // namespace detail

/// Shadow intensity in [0, 1] of a receiver.
/// Domain: any receiver; outside of the map lit.
/// NaN: 0, lit.
/// Source: Andersson 2015, Sec. 4.2
template <layer_format Format>
float layer_intensity(const layer_map<const format_texel<Format>>& map, const layer_receiver<float>& r,
                      const layer_look_up& look_up = {})
{
    if (!(0 <= r.x && r.x < float(map.width) && 0 <= r.y && r.y < float(map.height))) return 0;
    const float tile = float(map.settings.tile);
    const std::size_t column = (std::min)(std::size_t(r.x / tile), map.columns() - 1);
    const std::size_t row = (std::min)(std::size_t(r.y / tile), map.rows() - 1);
    if (look_up.tiles == layer_tiles::own)
        return saturate_or_zero(1 - detail::visibility_in<Format>(map, column, row, r, look_up));
    const auto neighbour = [&](std::size_t at, float place, std::size_t count) {
        layer_neighbour<float> n = layer_neighbour_at(place - (float(at) + 0.5f) * tile, tile);
        const std::size_t other = n.towards < 0 ? at - 1 : at + 1;
        return std::pair(other < count ? other : at, other < count ? n.weight : 0.0f);
    };
    const auto [beside, x_weight] = neighbour(column, r.x, map.columns());
    const auto [beyond, y_weight] = neighbour(row, r.y, map.rows());
    if (look_up.tiles == layer_tiles::random)
        return saturate_or_zero(1 - detail::visibility_in<Format>(map, r.random_x < x_weight ? beside : column,
                                                                  r.random_y < y_weight ? beyond : row, r, look_up));
    const auto is_plain = [&](std::size_t at_column, std::size_t at_row) {
        const std::size_t i = at_row * map.columns() + at_column;
        return map.first[i] == map.first[i + 1];
    };
    if (is_plain(column, row) && is_plain(beside, row) && is_plain(column, beyond) && is_plain(beside, beyond))
        return saturate_or_zero(1 - detail::visibility_in<Format>(map, column, row, r, look_up)); // they have no border
    float shadow = 0;
    const auto add = [&](std::size_t at_column, std::size_t at_row, float weight) {
        if (weight > 0) shadow += weight * (1 - detail::visibility_in<Format>(map, at_column, at_row, r, look_up));
    };
    add(column, row, (1 - x_weight) * (1 - y_weight));
    add(beside, row, x_weight * (1 - y_weight));
    add(column, beyond, (1 - x_weight) * y_weight);
    add(beside, beyond, x_weight * y_weight);
    return saturate_or_zero(shadow);
}

GNOMON_NAMESPACE_END
#endif
