// The frame of a rectified map (scattering/rectified.h): the light's map as the eye sees it, the bounds of radius and azimuth,
// and for each row its direction, its range of depth and the transmittance of a texel. Passes over rectified maps share these.
//
//     const rectified_frustum<float> bounds = rectified_frustum_from_corners(far_plane);    // in light axes, from the eye
//     const rectified_frame frame = rectified_frame_of(bounds, rectified_depth::polar);
//     rectified_rows(frame, bounds, extinction, width, rows);                               // one range for all rows
//     rectify<format>(depths, light, frame, rows, map, {0, height});                        // rectify.hpp
//     transmittance_prefix<format>(map, rows, {0, height});                                 // transmittance_prefix.hpp
//     build_mips<format>(mips);                                                             // map is the first level
//     const auto c = rectified_channels<format>(mips, frame, rows, position, level);        // rectified_look_up.hpp
//
// Row v has the azimuths from start + v length / height on, texel u of width texels the radii from u radius / width on.
#ifndef GNOMON_PASSES_RECTIFIED_MAP_HPP
#define GNOMON_PASSES_RECTIFIED_MAP_HPP

#include "../scattering/height_fog.h"
#include "../scattering/rectified_frustum.h"
#include "../scattering/transmittance_weights.h"
#include "map_view.hpp"

GNOMON_NAMESPACE_BEGIN

/// The map of a directional light from the eye: the eye's place in texels of the map and its signed depth there, and texels and
/// depth per unit of length along the light's axes.
struct light_map {
    float x = 0, y = 0, z = 0;
    float texels_x = 1, texels_y = 1, depths = 1;
};

/// The measure of depth in a rectified map: the polar angle, as in the paper, or its cosine.
enum class rectified_depth { polar, cosine };

/// The bounds of a rectified map: radius, and azimuths from azimuth_start on over azimuth_length.
struct rectified_frame {
    float radius = 0, azimuth_start = 0, azimuth_length = 0;
    rectified_depth depth = rectified_depth::polar;

    /// True if the last row is next to the first.
    [[nodiscard]] bool wraps() const { return azimuth_length > 6.28318f; }
};

/// A row of a rectified map: the direction of its middle, its range of depth, and the transmittance and optical depth of a texel
/// in the medium at the eye, whose density changes by e^-decay from texel to texel.
struct rectified_row {
    float cosine = 1, sine = 0;
    rectified_range<float> range = {0, 1};
    float factor = 1, optical_depth = 0, decay = 0;
};

/// A medium whose density falls by e^-falloff for each unit of height (scattering/height_fog.h), up being a direction of unit length
/// in the light's axes; a homogeneous one without falloff.
struct rectified_fog {
    float falloff = 0, up_x = 0, up_y = 0, up_z = -1;
};

/// The frame of the bounds of view rays.
inline rectified_frame rectified_frame_of(const rectified_frustum<float>& bounds,
                                          rectified_depth depth = rectified_depth::polar)
{
    return {bounds.radius, bounds.azimuth_start, bounds.azimuth_length, depth};
}

/// The extent of a texel along its row.
inline float rectified_radius_step(const rectified_frame& frame, std::size_t columns)
{
    return frame.radius / float(columns);
}

/// The range of depth for polar angles of view rays within an interval.
inline rectified_range<float> rectified_range_of(rectified_depth depth, rectified_interval<float> polar)
{
    if (depth == rectified_depth::polar) return rectified_polar_range(polar.least, polar.most);
    return rectified_cosine_range(polynomial_cos(polar.most), polynomial_cos(polar.least));
}

/// The signed depth at which a view ray of that polar angle stands in a row of that range.
inline float rectified_depth_of(rectified_depth depth, float polar, rectified_range<float> range)
{
    return depth == rectified_depth::polar ? rectified_polar_depth(polar, range)
                                           : rectified_cosine_depth(polynomial_cos(polar), range);
}

namespace detail {

/// The mean sine of the polar angles of view rays that fill the solid angle of an interval, by Simpson's rule: where the light
/// direction is in view, most rays are far from it.
inline float rectified_mean_sine(rectified_interval<float> polar)
{
    const float a = polynomial_sin(polar.least), b = polynomial_sin(polar.most);
    const float middle = polynomial_sin(0.5f * (polar.least + polar.most));
    const float sum = a + 4 * middle + b;
    return sum > 0 ? (a * a + 4 * middle * middle + b * b) / sum : 0;
}

inline rectified_row rectified_row_over(const rectified_frame& frame, rectified_interval<float> polar, float sine,
                                        float extinction, float radius_step, float azimuth, const rectified_fog& fog)
{
    const cosine_sine<float> direction = polynomial_cosine_sine(azimuth);
    const float texel = radius_step / sine;
    const float rise = sine * (direction.cosine * fog.up_x + direction.sine * fog.up_y) +
                       polynomial_cos(0.5f * (polar.least + polar.most)) * fog.up_z;
    return {direction.cosine,
            direction.sine,
            rectified_range_of(frame.depth, polar),
            transmittance_step(extinction, radius_step, sine),
            extinction * radius_step / sine,
            fog.falloff > 0 ? fog.falloff * rise * texel : 0};
}

inline void expect_rectified_rows(std::size_t columns, std::span<const rectified_row> rows)
{
    GNOMON_EXPECTS(columns > 0, mismatch("rectified_rows", "columns", columns, "rows.size()", rows.size()));
}

} // namespace detail

/// Fill the rows of a map of that many columns, all with the same range of depth and the same transmittance of a texel: those of
/// the view rays' interval of polar angles and of its middle (Peters et al. 2017, Sec. 5.1.1). extinction is that at the eye.
inline void rectified_rows(const rectified_frame& frame, const rectified_frustum<float>& bounds, float extinction,
                           std::size_t columns, std::span<rectified_row> rows, const rectified_fog& fog = {})
{
    detail::expect_rectified_rows(columns, rows);
    const rectified_interval<float> polar{bounds.polar_least, bounds.polar_most};
    const float sine = polynomial_sin(0.5f * (polar.least + polar.most));
    const float step = frame.azimuth_length / float(rows.size());
    for (std::size_t v = 0; v < rows.size(); ++v)
        rows[v] = detail::rectified_row_over(frame, polar, sine, extinction, rectified_radius_step(frame, columns),
                                             frame.azimuth_start + (float(v) + 0.5f) * step, fog);
}

/// Fill the rows of a map of that many columns, each with the range of depth of the view rays that read it, and the
/// transmittance of a texel for their mean sine: rays of its azimuths and of half a row on either side, between which look-ups
/// interpolate.
inline void rectified_rows(const rectified_frame& frame, const rectified_corners<float>& far_plane, float extinction,
                           std::size_t columns, std::span<rectified_row> rows, const rectified_fog& fog = {})
{
    detail::expect_rectified_rows(columns, rows);
    const float step = frame.azimuth_length / float(rows.size());
    for (std::size_t v = 0; v < rows.size(); ++v) {
        const float middle = frame.azimuth_start + (float(v) + 0.5f) * step;
        const rectified_interval<float> polar = rectified_row_polar(far_plane, middle - step, middle + step);
        rows[v] = detail::rectified_row_over(frame, polar, detail::rectified_mean_sine(polar), extinction,
                                             rectified_radius_step(frame, columns), middle, fog);
    }
}

/// Check that a rectified map has as many rows as there are in the span.
template <class T>
void expect_rectified(std::string_view pass, std::string_view name, map_view<T> map,
                      std::span<const rectified_row> rows)
{
    expect_map(pass, name, map);
    GNOMON_EXPECTS(rows.size() == map.height,
                   mismatch(pass, "rows.size()", rows.size(), std::string(name) + ".height", map.height));
}

GNOMON_NAMESPACE_END
#endif
