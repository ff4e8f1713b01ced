// Look-up of the end of a view ray in a rectified map of prefix averages (transmittance_prefix.hpp), or in its mip chain: the
// channels that determine the ray's single scattering, for the intensity of the format at the depth of rectified_depth_at.
//
// Along a row the average up to the far side of a texel stands at its centre. Between two centres the average moves by the exact
// weight of a ray that ends there (scattering/transmittance_weights.h), as if the occluders of the texel reached to its end.
// Averages of one row are mixed with those of the next; the last row is next to the first where the frame is a full turn.
#ifndef GNOMON_PASSES_RECTIFIED_LOOK_UP_HPP
#define GNOMON_PASSES_RECTIFIED_LOOK_UP_HPP

#include "look_up.hpp"
#include "rectified_map.hpp"

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The rows on either side of a position, in rows of a level, of which the last is next to the first if the map wraps.
inline neighbours rectified_rows_of(float position, std::size_t rows, bool wraps)
{
    if (!wraps) return neighbours_of<border_mode::clamp>(position - 0.5f, rows);
    const neighbours n = neighbours_of<border_mode::clamp>(position + 0.5f, rows + 2);
    return {(n.lower + rows - 1) % rows, (n.upper + rows - 1) % rows, n.fraction};
}

/// The place in a map of prefix averages, texel centres at +0.5.
struct rectified_place {
    float x, y;
};

inline rectified_place rectified_place_of(const rectified_frame& frame, const rectified_position<float>& position,
                                          std::size_t width, std::size_t height)
{
    const float step = rectified_radius_step(frame, width);
    return {step > 0 ? rectified_column_of(position.radius, step) : position.radius,
            rectified_row_of(position.azimuth, frame.azimuth_start, frame.azimuth_length, float(height))};
}

/// The share of the way from one average to the next, of a ray that ends a fraction of the way from one to the other.
template <class Real> Real rectified_share(Real before, Real wide, Real fraction, Real optical_depth, Real decay)
{
    const Real share = transmittance_weight_between(before, wide, fraction, optical_depth);
    const auto is_even = decay == Real(0);
    if (!gnomon_any(!is_even)) return share;
    return gnomon_select(is_even, share, height_fog_weight_between(before, wide, fraction, decay, optical_depth));
}

/// Channels at (x, y) of a level of a map whose texels are wide columns of the map, and high rows.
template <texel_format Format>
channel_array<Format> rectified_channels_of(map_view<const format_texel<Format>> map, float x, float y, float wide,
                                            float high, std::span<const rectified_row> rows, bool wraps)
{
    const neighbours nx = neighbours_of<border_mode::clamp>(x - 0.5f, map.width);
    const neighbours ny = rectified_rows_of(y, map.height, wraps);
    const float before = (float(nx.lower) + 0.5f) * wide + 0.5f;
    const auto medium = [&](std::size_t v) -> const rectified_row& {
        return rows[(std::min)(std::size_t((float(v) + 0.5f) * high), rows.size() - 1)];
    };
    const auto share_in = [&](const rectified_row& r) {
        return rectified_share(before, wide, nx.fraction, r.optical_depth, r.decay);
    };
    const rectified_row &lower = medium(ny.lower), &upper = medium(ny.upper);
    const bool are_alike = lower.optical_depth == upper.optical_depth && lower.decay == upper.decay;
    const float share = share_in(lower);
    const auto row = [&](std::size_t v, float t) {
        return mix(load_channels<Format>(map(nx.lower, v)), load_channels<Format>(map(nx.upper, v)), t);
    };
    return mix(row(ny.lower, share), row(ny.upper, are_alike ? share : share_in(upper)), ny.fraction);
}

} // namespace detail

/// The signed depth of a view ray at position, interpolated between its depths in the two rows that its look-up mixes.
/// NaN: NaN for a polar angle of NaN.
inline float rectified_depth_at(const rectified_frame& frame, std::span<const rectified_row> rows,
                                const rectified_position<float>& position)
{
    if (rows.empty()) return -1;
    const float row = rectified_row_of(position.azimuth, frame.azimuth_start, frame.azimuth_length, float(rows.size()));
    const detail::neighbours n = detail::rectified_rows_of(row, rows.size(), frame.wraps());
    const float a = rectified_depth_of(frame.depth, position.polar, rows[n.lower].range);
    const float b = rectified_depth_of(frame.depth, position.polar, rows[n.upper].range);
    return a + n.fraction * (b - a);
}

/// Channels for the end of a view ray at position, in a mip chain of prefix averages, interpolated between two levels; the level
/// is clamped to the chain. Radii beyond the frame are moved to its last column, azimuths to the nearer end.
/// Domain: any position and level. A map or rows without entries give the border, lit.
/// NaN: the border, for a radius, azimuth or level of NaN.
template <texel_format Format>
format_channels<Format> rectified_channels(mip_view<const format_texel<Format>> mips, const rectified_frame& frame,
                                           std::span<const rectified_row> rows,
                                           const rectified_position<float>& position, float level)
{
    if (rows.empty()) return stored_border<Format>();
    const detail::rectified_place at = detail::rectified_place_of(frame, position, mips.width, mips.height);
    return detail::between_levels<Format>(mips, at.x, at.y, level, [&](const auto& map, float x, float y) {
        return detail::rectified_channels_of<Format>(map, x, y, float(mips.width) / float(map.width),
                                                     float(mips.height) / float(map.height), rows, frame.wraps());
    });
}

/// Channels for the end of a view ray at position, in a map of prefix averages.
/// Domain: any position. A map or rows without entries give the border, lit.
/// NaN: the border, for a radius or azimuth of NaN.
template <texel_format Format>
format_channels<Format> rectified_channels(map_view<const format_texel<Format>> map, const rectified_frame& frame,
                                           std::span<const rectified_row> rows,
                                           const rectified_position<float>& position)
{
    const detail::rectified_place at = detail::rectified_place_of(frame, position, map.width, map.height);
    if ((std::isunordered)(at.x, at.y) || map.width == 0 || map.height == 0 || rows.empty())
        return stored_border<Format>();
    return gnomon_bit_cast<format_channels<Format>>(
        detail::rectified_channels_of<Format>(map, at.x, at.y, 1, 1, rows, frame.wraps()));
}

GNOMON_NAMESPACE_END
#endif
