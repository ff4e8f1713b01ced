// Look-up in a shadow map or its mip chain by cubic B-splines (soft/mip_filter.h), in the storage format: smooth filters of any
// width without a summed-area table. Positions and texels beyond the edge are as of look_up.hpp.
#ifndef GNOMON_PASSES_BICUBIC_HPP
#define GNOMON_PASSES_BICUBIC_HPP

#include "../soft/mip_filter.h"
#include "look_up.hpp"

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The positions of the two bilinear look-ups along one axis, and the weight of the second.
struct spline_positions {
    float first, second, weight;
};

inline spline_positions spline_positions_of(float coordinate, std::size_t extent)
{
    // Beyond two texels from the edge all positions are alike.
    const float x = (std::max)(-2.0f, (std::min)(coordinate - 0.5f, float(extent) + 2));
    const float whole = std::floor(x);
    const mip_filter_taps<float> taps = mip_filter_taps_at(x - whole);
    return {whole + 0.5f + taps.first, whole + 0.5f + taps.second, taps.weight};
}

template <texel_format Format>
channel_array<Format> bicubic_channels(map_view<const format_texel<Format>> map, float x, float y, border_mode mode)
{
    const spline_positions px = spline_positions_of(x, map.width), py = spline_positions_of(y, map.height);
    const auto row = [&](float at) {
        return mix(bilinear_channels<Format>(map, px.first, at, mode),
                   bilinear_channels<Format>(map, px.second, at, mode), px.weight);
    };
    return mix(row(py.first), row(py.second), py.weight);
}

} // namespace detail

/// Channels at position (x, y), filtered by a cubic B-spline over 4 x 4 texels.
/// Domain: any position. A map without texels gives the border, lit.
/// NaN: the border, for a coordinate of NaN.
template <texel_format Format>
format_channels<Format> bicubic(map_view<const format_texel<Format>> map, float x, float y,
                                border_mode mode = border_mode::clamp)
{
    if ((std::isunordered)(x, y) || map.width == 0 || map.height == 0) return stored_border<Format>();
    return gnomon_bit_cast<format_channels<Format>>(detail::bicubic_channels<Format>(map, x, y, mode));
}

/// Channels at position (x, y) of a mip chain, filtered by a cubic B-spline and interpolated between two levels:
/// mip_filter_level gives the level of a width. The level is clamped to the chain.
/// Domain: any position and level. A map without texels gives the border, lit.
/// NaN: the border, for a coordinate or level of NaN.
template <texel_format Format>
format_channels<Format> bicubic(mip_view<const format_texel<Format>> mips, float x, float y, float level,
                                border_mode mode = border_mode::clamp)
{
    return detail::between_levels<Format>(mips, x, y, level, [&](const auto& map, float at_x, float at_y) {
        return detail::bicubic_channels<Format>(map, at_x, at_y, mode);
    });
}

GNOMON_NAMESPACE_END
#endif
