// Bilinear and trilinear look-up in a shadow map in its storage format. Texels are decoded, then interpolated in float,
// so nothing is rounded to the format. Positions are in texels of the map itself, texel centres at +0.5. Beyond the
// map's edge the outermost texel repeats.
#ifndef GNOMON_PASSES_LOOK_UP_HPP
#define GNOMON_PASSES_LOOK_UP_HPP

#include "mips.hpp"

namespace gnomon {

namespace detail {

/// The two neighbouring whole numbers in [0, extent - 1] around a coordinate, and the fraction from the lower to the
/// upper one.
/// NaN: the coordinate counts as 0.
struct neighbours {
    std::size_t lower, upper;
    float fraction;
};

inline neighbours neighbours_of(float coordinate, std::size_t extent)
{
    const float last = float(extent - 1);
    const float x = coordinate > 0 ? (coordinate < last ? coordinate : last) : 0.0f;
    const std::size_t lower = std::min(std::size_t(x), extent - 1);
    return {lower, std::min(lower + 1, extent - 1), x - float(lower)};
}

/// Linear interpolation from a to b. Exact if both are equal, so a constant map stays constant.
template <std::size_t n> std::array<float, n> mix(const std::array<float, n>& a, const std::array<float, n>& b, float t)
{
    std::array<float, n> r;
    for (std::size_t k = 0; k < n; ++k) r[k] = a[k] + t * (b[k] - a[k]);
    return r;
}

template <storage_format Format>
channel_array<Format> bilinear_channels(map_view<const format_texel<Format>> map, float x, float y)
{
    const neighbours nx = neighbours_of(x - 0.5f, map.width);
    const neighbours ny = neighbours_of(y - 0.5f, map.height);
    const auto at = [&](std::size_t i, std::size_t j) { return load_channels<Format>(map(i, j)); };
    return mix(mix(at(nx.lower, ny.lower), at(nx.upper, ny.lower), nx.fraction),
               mix(at(nx.lower, ny.upper), at(nx.upper, ny.upper), nx.fraction), ny.fraction);
}

} // namespace detail

/// Filtered channels at position (x, y), for the intensity or factor of a format.
/// Domain: a map with texels, and any position.
/// NaN: a coordinate counts as 0.
template <storage_format Format>
format_channels<Format> bilinear(map_view<const format_texel<Format>> map, float x, float y)
{
    return gnomon_bit_cast<format_channels<Format>>(detail::bilinear_channels<Format>(map, x, y));
}

/// Filtered channels at position (x, y) of a mip chain, interpolated between two levels. Level 0 is the map itself; the
/// level is clamped to the chain.
/// NaN: a coordinate or level counts as 0.
template <storage_format Format>
format_channels<Format> trilinear(mip_view<const format_texel<Format>> mips, float x, float y, float level)
{
    const detail::neighbours nl = detail::neighbours_of(level, mips.levels());
    const auto at = [&](std::size_t k) {
        const map_view<const format_texel<Format>> map = mips.level(k);
        const float sx = float(map.width) / float(mips.width);
        const float sy = float(map.height) / float(mips.height);
        return detail::bilinear_channels<Format>(map, x * sx, y * sy);
    };
    channel_array<Format> c = at(nl.lower);
    if (nl.fraction > 0) c = detail::mix(c, at(nl.upper), nl.fraction);
    return gnomon_bit_cast<format_channels<Format>>(c);
}

} // namespace gnomon
#endif
