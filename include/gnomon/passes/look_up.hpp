// Bilinear and trilinear look-up in a shadow map in its storage format. Texels are decoded, then interpolated in float,
// so nothing is rounded to the format. Positions are in texels of the map itself, texel centres at +0.5. Beyond the
// map's edge the outermost texel repeats, or is lit (border_mode).
#ifndef GNOMON_PASSES_LOOK_UP_HPP
#define GNOMON_PASSES_LOOK_UP_HPP

#include "mips.hpp"

#include <cmath>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The whole numbers on either side of a coordinate, and the fraction from the lower to the upper one; a whole coordinate
/// is both. The coordinate is clamped to [0, extent - 1], and by border_mode::lit to a texel more on either side.
struct neighbours {
    std::size_t lower, upper; // -1 for the texel before the first
    float fraction;
};

template <border_mode mode> neighbours neighbours_of(float coordinate, std::size_t extent)
{
    constexpr std::size_t margin = mode == border_mode::lit ? 1 : 0;
    const float first = -float(margin), last = float(extent - 1 + margin);
    const float x = coordinate > first ? (coordinate < last ? coordinate : last) : first;
    if (margin > 0 && x < 0) return {std::size_t(-1), std::size_t(-1) + (x > -1), x + 1};
    const std::size_t lower = (std::min)(std::size_t(x), extent - 1 + margin);
    const float fraction = x - float(lower);
    return {lower, lower + (fraction > 0), fraction};
}

/// Linear interpolation from a to b. Exact if both are equal, so a constant map stays constant.
template <std::size_t n> std::array<float, n> mix(const std::array<float, n>& a, const std::array<float, n>& b, float t)
{
    std::array<float, n> r;
    for (std::size_t k = 0; k < n; ++k) r[k] = a[k] + t * (b[k] - a[k]);
    return r;
}

template <texel_format Format, border_mode mode>
channel_array<Format> bilinear_channels(map_view<const format_texel<Format>> map, float x, float y)
{
    const neighbours nx = neighbours_of<mode>(x - 0.5f, map.width);
    const neighbours ny = neighbours_of<mode>(y - 0.5f, map.height);
    const auto at = [&](std::size_t i, std::size_t j) {
        const bool beyond = mode == border_mode::lit && !(i < map.width && j < map.height);
        return beyond ? gnomon_bit_cast<channel_array<Format>>(stored_border<Format>())
                      : load_channels<Format>(map(i, j));
    };
    return mix(mix(at(nx.lower, ny.lower), at(nx.upper, ny.lower), nx.fraction),
               mix(at(nx.lower, ny.upper), at(nx.upper, ny.upper), nx.fraction), ny.fraction);
}

template <texel_format Format>
channel_array<Format> bilinear_channels(map_view<const format_texel<Format>> map, float x, float y, border_mode mode)
{
    return mode == border_mode::lit ? bilinear_channels<Format, border_mode::lit>(map, x, y)
                                    : bilinear_channels<Format, border_mode::clamp>(map, x, y);
}

/// Channels of a filter, look_up(map, x, y), interpolated between the two levels next to level.
template <texel_format Format>
format_channels<Format> between_levels(mip_view<const format_texel<Format>> mips, float x, float y, float level,
                                       const auto& look_up)
{
    if ((std::isunordered)(x, y) || (std::isnan)(level) || mips.width == 0 || mips.height == 0)
        return stored_border<Format>();
    const neighbours nl = neighbours_of<border_mode::clamp>(level, mips.levels());
    const auto at = [&](std::size_t k) {
        const map_view<const format_texel<Format>> map = mips.level(k);
        return look_up(map, x * (float(map.width) / float(mips.width)), y * (float(map.height) / float(mips.height)));
    };
    channel_array<Format> c = at(nl.lower);
    if (nl.fraction > 0) c = mix(c, at(nl.upper), nl.fraction);
    return gnomon_bit_cast<format_channels<Format>>(c);
}

} // namespace detail

/// Filtered channels at position (x, y), for the intensity or factor of a format.
/// Domain: any position. A map without texels gives the border, lit.
/// NaN: the border, for a coordinate of NaN.
template <texel_format Format>
format_channels<Format> bilinear(map_view<const format_texel<Format>> map, float x, float y,
                                 border_mode mode = border_mode::clamp)
{
    if ((std::isunordered)(x, y) || map.width == 0 || map.height == 0) return stored_border<Format>();
    return gnomon_bit_cast<format_channels<Format>>(detail::bilinear_channels<Format>(map, x, y, mode));
}

/// Filtered channels at position (x, y) of a mip chain, interpolated between two levels. Level 0 is the map itself; the
/// level is clamped to the chain.
/// Domain: any position and level. A map without texels gives the border, lit.
/// NaN: the border, for a coordinate or level of NaN.
template <texel_format Format>
format_channels<Format> trilinear(mip_view<const format_texel<Format>> mips, float x, float y, float level,
                                  border_mode mode = border_mode::clamp)
{
    return detail::between_levels<Format>(mips, x, y, level, [&](const auto& map, float at_x, float at_y) {
        return detail::bilinear_channels<Format>(map, at_x, at_y, mode);
    });
}

GNOMON_NAMESPACE_END
#endif
