// The depth bias that keeps a surface from shadowing itself: subtract it from the receiver's depth before the intensity.
// A filter region holds depths of the receiver's own plane that are nearer to the light than the receiver, by the most
// that the plane rises within the half widths of the filter. Half widths are those of blur and look-up together, from the
// receiver to the centre of the farthest texel; for mip level l they are 2^l times as large. 9 taps and bilinear
// filtering have 5.5 texels.
//
//     bias = depth_bias_slope_scaled(sine, cosine, 5.5 * footprint * depth_per_texel, 5.67);       from the normal
//
//     gradient = depth_gradient_from_derivatives(...);                                             from screen space
//     bias = depth_bias_receiver_plane(gradient, half_width_x, half_width_y, limit);
//
//     intensity = variance_unorm16_intensity(channels, z_f - bias);
#ifndef GNOMON_FILTERS_DEPTH_BIAS_H
#define GNOMON_FILTERS_DEPTH_BIAS_H
#include "../numerics/select.h"
#include "../numerics/two_product.h"
GNOMON_NAMESPACE_BEGIN

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
GNOMON_DETAIL_KERNEL Real depth_bias_limit(Real bias) { return gnomon_min(Real(2), gnomon_max(bias, Real(0))); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at 45
/// degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
GNOMON_KERNEL Real depth_bias_slope_scaled(Real across, Real along, Real rise, GNOMON_SETTING steepest)
{
    return depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
GNOMON_STRUCT(depth_gradient) { Real x, y; };

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
GNOMON_DETAIL_KERNEL Real depth_gradient_minor(Real a, Real b, Real c, Real d)
{
    double_word p = two_product(a, b);
    double_word q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in texels,
/// and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
GNOMON_KERNEL GNOMON_T(depth_gradient) depth_gradient_from_derivatives(Real x1, Real y1, Real depth1, Real x2, Real y2,
                                                                       Real depth2)
{
    Real determinant = depth_gradient_minor(x1, y2, x2, y1);
    GNOMON_T(depth_gradient) r;
    r.x = depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of the
/// filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
GNOMON_KERNEL Real depth_bias_receiver_plane(GNOMON_T(depth_gradient) gradient, Real half_width_x, Real half_width_y,
                                             GNOMON_SETTING limit)
{
    Real rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
    return depth_bias_limit(gnomon_min(limit, rise));
}

/// The adaptive depth bias in [0, 2] for a look-up of a single texel: by how much the receiver is behind its own plane where
/// the plane meets the ray through the texel's centre, at most limit, plus epsilon. offset_x and offset_y lead from that
/// centre to the receiver, in texels. For a rectangle of texels depth_bias_receiver_plane is the largest of these, less
/// epsilon, if its half widths reach to the farthest centre.
/// Domain: any; limit and epsilon at least 0.
/// NaN: epsilon; a limit of NaN counts as none, an epsilon of NaN gives 0.
/// Error: relative, 4 2^-p of |gradient.x offset_x| + |gradient.y offset_y| + epsilon.
/// Source: Dou 2014
GNOMON_KERNEL Real depth_bias_texel_plane(GNOMON_T(depth_gradient) gradient, Real offset_x, Real offset_y,
                                          GNOMON_SETTING limit, GNOMON_SETTING epsilon)
{
    Real behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, Real(0));
    return depth_bias_limit(depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}

GNOMON_NAMESPACE_END
#endif
