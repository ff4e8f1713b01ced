// Rectified coordinates of a shadow map of a directional light, in which all points of a view ray lie in one row and at one
// depth (Peters et al. 2017, Sec. 5.1.1 and App. A; Baran et al. 2010).
//
// Axes: x and y along the map, z along the propagation of light. Origin: the eye. Any unit of length.
//
//     radius  = |(x, y)|            distance between the eye and a light ray: column of the rectified map
//     azimuth = angle of (x, y)     slice that holds the light direction and the eye: row of the rectified map
//     polar   = atan2(radius, z)    angle between the view ray and the propagation of light, in [0, pi]
//
// Looking into the light is polar = pi. On a light ray z grows with depth, and polar falls with it. Hence a depth of the
// rectified map is a falling function of polar, signed as all depths of this library: -1 looking into the light, +1
// along it. There are two measures of depth: the angle itself, as in the paper, and its cosine, which needs no inverse
// trigonometry. Both are stretched to [-1, 1] over the range of the view rays and a guard band of 10%, so that an occluder
// outside of that range keeps a distance from all view rays.
//
//     omega_l    the direction to the light:  (0, 0, -1)
//     omega_p    the direction from a point of the view ray to the camera
//     dot product of the two = cosine of polar;  cosine of the scattering angle = -cosine of polar
//
// One texel of the rectified map is one light ray: position eye + radius (cos azimuth, sin azimuth) in the map, and its
// depth there as z leads to polar.
#ifndef GNOMON_SCATTERING_RECTIFIED_H
#define GNOMON_SCATTERING_RECTIFIED_H
#include "../numerics/exp.h"
#include "../numerics/trigonometry.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(rectified_guard, 0.55); // half of a range with a guard band of 10%
GNOMON_CONSTANT(rectified_pi, 3.1415926535897932);
GNOMON_CONSTANT(rectified_two_pi, 6.2831853071795865);

/// A distance from the eye across the light, and two angles.
GNOMON_STRUCT(rectified_position) { Real radius, azimuth, polar; };

/// A map of angles, or of cosines, to depths: the value of depth 0, and depth per unit.
GNOMON_STRUCT(rectified_range) { Real middle, scale; };

/// The rectified coordinates of a point: radius at least 0, azimuth in [-pi, pi], polar in [0, pi]. On the axis azimuth
/// is 0; polar of the eye is 0.
/// Domain: |x|, |y| and |z| are 0 or in [2^-60, 2^60] in float, [2^-500, 2^500] in double.
/// NaN: a NaN in each coordinate that depends on it.
/// Error: radius 2 2^-p relative; azimuth 2.6 ulp, polar 3.6 ulp.
/// Source: Peters 2017, Sec. 5.1.1; Baran 2010
GNOMON_KERNEL GNOMON_T(rectified_position) rectified_from_position(Real x, Real y, Real z)
{
    GNOMON_T(rectified_position) r;
    r.radius = gnomon_sqrt(x * x + y * y);
    r.azimuth = polynomial_atan2(y, x);
    r.polar = polynomial_atan2(r.radius, z);
    return r;
}

/// The cosine of polar at a point, in [-1, 1]; 1 at the eye.
/// Domain: as for rectified_from_position.
/// NaN: NaN.
/// Error: 3 2^-p.
GNOMON_KERNEL Real rectified_cosine(Real x, Real y, Real z)
{
    Real distance_ = gnomon_sqrt((x * x + y * y) + z * z);
    GNOMON_MASK at_eye = distance_ == Real(0);
    Real cosine = z / gnomon_select(at_eye, Real(1), distance_);
    return clamp_or_nan(gnomon_select(at_eye, Real(1), cosine), Real(-1), Real(1));
}

/// The range whose depths are in [-1 / 1.1, 1 / 1.1] from least to most, or in a part of that if most - least is below
/// narrowest.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_range) rectified_range_over(Real least, Real most, GNOMON_SETTING narrowest)
{
    GNOMON_T(rectified_range) r;
    r.middle = Real(0.5) * (least + most);
    r.scale = Real(1) / (GNOMON_LITERAL(rectified_guard) * gnomon_max(most - least, narrowest));
    return r;
}

/// The range of depth for polar angles of view rays in [least, most].
/// Domain: least <= most, in [0, pi]. A range narrower than 2^-10, or reversed, is widened to 2^-10 around its middle.
/// NaN: a middle of NaN.
/// Source: Peters 2017, Sec. 5.1.1
GNOMON_KERNEL GNOMON_T(rectified_range) rectified_polar_range(Real least, Real most)
{
    return rectified_range_over(least, most, Real(0.0009765625));
}

/// The range of depth for cosines of polar angles of view rays in [least, most], which are those of the greatest and of the
/// least angle.
/// Domain: least <= most, in [-1, 1]. A range narrower than 2^-16, or reversed, is widened to 2^-16 around its middle.
/// NaN: a middle of NaN.
GNOMON_KERNEL GNOMON_T(rectified_range) rectified_cosine_range(Real least, Real most)
{
    return rectified_range_over(least, most, Real(0.0000152587890625));
}

/// Signed depth of a polar angle, in [-1, 1]: falls with the angle, -1 on the side of rays that look into the light.
/// Domain: polar in [0, pi], a range by rectified_polar_range.
/// NaN: NaN, which encoders store as the far plane.
/// Source: Peters 2017, Sec. 5.1.1
GNOMON_KERNEL Real rectified_polar_depth(Real polar, GNOMON_T(rectified_range) range)
{
    return clamp_or_nan((range.middle - polar) * range.scale, Real(-1), Real(1));
}

/// Signed depth of the cosine of a polar angle, in [-1, 1]: grows with the cosine, -1 on the side of rays that look into the
/// light.
/// Domain: cosine in [-1, 1], a range by rectified_cosine_range.
/// NaN: NaN, which encoders store as the far plane.
GNOMON_KERNEL Real rectified_cosine_depth(Real cosine, GNOMON_T(rectified_range) range)
{
    return clamp_or_nan((cosine - range.middle) * range.scale, Real(-1), Real(1));
}

/// An angle within three half turns of 0, moved by a full turn to at most half a turn from 0.
GNOMON_DETAIL_KERNEL Real rectified_wrapped(Real angle)
{
    Real turn = GNOMON_LITERAL(rectified_two_pi);
    Real half_turn = GNOMON_LITERAL(rectified_pi);
    Real up = gnomon_select(angle + half_turn < Real(0), angle + turn, angle);
    return gnomon_select(half_turn < up, up - turn, up);
}

/// The position across the rows of a map, in [0, rows], of an azimuth; the centre of the first row is at 0.5. The map begins
/// at the azimuth start and spans the angle span; an azimuth outside is moved to the nearer end.
/// Domain: azimuth and start in [-pi, pi], span in [2^-20, 2 pi]; elsewhere a number in [0, rows].
/// NaN: NaN for an azimuth of NaN.
GNOMON_KERNEL Real rectified_row_of(Real azimuth, GNOMON_SETTING start, GNOMON_SETTING span, GNOMON_SETTING rows)
{
    Real whole = gnomon_max(span, Real(0.00000095367431640625));
    Real from_middle = rectified_wrapped((azimuth - start) - Real(0.5) * whole);
    return clamp_or_nan((from_middle / whole + Real(0.5)) * rows, Real(0), rows);
}

/// The position along a row of prefix averages, at least 0, of a ray that ends at radius; the centre of the first texel is at
/// 0.5. The average up to the far side of texel u, radius (u + 1) radius_step, stands at its centre, u + 1/2: so the
/// position is half a texel before that of the light ray itself.
/// Domain: radius at least 0, radius_step above 0.
/// NaN: NaN.
GNOMON_KERNEL Real rectified_column_of(Real radius, GNOMON_SETTING radius_step)
{
    return gnomon_max(Real(0), radius / radius_step - Real(0.5));
}

/// The greater extent of a texel of the rectified map at radius, in texels of the shadow map: along the row radius_step, across
/// it radius times azimuth_step, the angle between rows.
/// Domain: at least 0 each.
/// NaN: NaN.
GNOMON_KERNEL Real rectified_footprint(Real radius, GNOMON_SETTING radius_step, GNOMON_SETTING azimuth_step,
                                       GNOMON_SETTING texels_per_length)
{
    return gnomon_max(radius_step, radius * azimuth_step) * texels_per_length;
}

/// The mip level, in [0, 16], whose texels are as wide as a footprint in texels of level 0.
/// Domain: any footprint.
/// NaN: 0.
/// Error: 2 2^-p of the largest level.
GNOMON_KERNEL Real rectified_level(Real footprint)
{
    Real wide = clamp_or_nan(footprint, Real(1), Real(65536));
    return clamp_or_high(polynomial_log(gnomon_max(wide, Real(1))) * GNOMON_LITERAL(exp_log2_e), Real(0), Real(16));
}

GNOMON_NAMESPACE_END
#endif
