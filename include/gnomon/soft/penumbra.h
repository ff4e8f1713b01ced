// Percentage-closer soft shadows (Fernando 2005): from the depth of blockers to the width of the filter that makes their
// penumbra, for lights that are rectangles aligned with the map, along one axis of the map at a time.
//
//     widest search:    width = penumbra_directional(z_f, -1, texels_per_depth, cap)           blockers at the near plane
//     blockers:         z_b = moments4_summed_blocker(...)                                     of the search rectangle
//     filter:           width = penumbra_directional(z_f, z_b, texels_per_depth, cap)          at least one texel
//     bias:             bias = depth_bias_receiver_plane(gradient, (width_x + 1) / 2, (width_y + 1) / 2, limit)
//     shadow:           over_darken(moments4_summed_intensity(..., z_f - bias), 1 - epsilon)
//
// and the same by penumbra_local. In the umbra, where the intensity of the search rectangle is above 1 - epsilon, the filter
// may be skipped: over_darken makes that 1 as well, so no step is seen. The paper's epsilon is 0.01. The bias is that of
// filters/depth_bias.h: the most that the receiver's plane rises within the half widths of the filter and half a texel, as
// far as the centres of texels lie that a rectangle touches; or, for look-ups of single texels, depth_bias_texel_plane.
#ifndef GNOMON_SOFT_PENUMBRA_H
#define GNOMON_SOFT_PENUMBRA_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// A width of any size clamped to [1, widest], or 1 if widest is below 1.
/// NaN: 1; a widest of NaN counts as none.
GNOMON_DETAIL_KERNEL Real penumbra_width(Real width, GNOMON_SETTING widest)
{
    return gnomon_max(gnomon_min(widest, gnomon_max(width, Real(1))), Real(1));
}

/// The width of the penumbra of a directional light per unit of signed depth between blocker and receiver, in texels.
/// tangent is that of half the light's angular size along this axis; depth_range is far - near, and texels_per_length the
/// number of texels per unit of length in the map.
/// Domain: at least 0.
/// NaN: NaN, for which filters are one texel wide.
/// Error: relative, 2 2^-p.
GNOMON_KERNEL Real penumbra_texels_per_depth(Real tangent, Real depth_range, Real texels_per_length)
{
    return tangent * depth_range * texels_per_length;
}

/// Width of the penumbra of a directional light, at least one texel and at most widest: (z_f - z_b) texels_per_depth for
/// a receiver at depth z_f and blockers at z_b.
/// Domain: any depths, clamped to [-1, 1]; texels_per_depth by penumbra_texels_per_depth. Blockers behind the receiver
/// give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 2 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
GNOMON_KERNEL Real penumbra_directional(Real z_f, Real z_b, GNOMON_SETTING texels_per_depth, GNOMON_SETTING widest)
{
    Real receiver = clamp_or_nan(z_f, Real(-1), Real(1));
    Real blocker = clamp_or_nan(z_b, Real(-1), Real(1));
    return penumbra_width((receiver - blocker) * texels_per_depth, widest);
}

/// Width of the penumbra of a local light, at least one texel and at most widest: light_texels (1 / d_b - 1 / d_f) for a
/// receiver and blockers at view distances d_f and d_b. light_texels is the size of the light times the number of texels per
/// unit of length at distance 1 from the light, in the map of that axis.
/// Domain: any depths, clamped to [-1, 1]; 0 < near_distance < far_distance. Blockers behind the receiver give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 10 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
GNOMON_KERNEL Real penumbra_local(Real z_f, Real z_b, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance,
                                  GNOMON_SETTING light_texels, GNOMON_SETTING widest)
{
    Real receiver = clamp_or_nan(z_f, Real(-1), Real(1));
    Real blocker = clamp_or_nan(z_b, Real(-1), Real(1));
    Real half_range = Real(0.5) * (far_distance - near_distance);
    Real d_f = near_distance + half_range * (receiver + Real(1));
    Real d_b = near_distance + half_range * (blocker + Real(1));
    return penumbra_width(light_texels * ((receiver - blocker) * half_range) / (d_b * d_f), widest);
}

GNOMON_NAMESPACE_END
#endif
