// Six moments in a summed-area table (soft/summed_area.h): moments4_summed.h for search regions that hold more surfaces,
// in 24 bytes a texel.
//
//   a texel:        c = moments6_summed_encode(z)               channels of theta6; a resolve averages them
//                   codes = moments6_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned integers
//   a rectangle:    c = moments6_summed_channels(sums, area, scale)
//                   z_b = moments6_summed_blocker(c, most_texels, z_f)
//                   shadow = moments6_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by half a code, most_texels 2^-33, and by what float arithmetic rounds. Intensities exceed Z(z < z_f) by
// moments6_summed_weight at most.
#ifndef GNOMON_STORAGE_MOMENTS6_SUMMED_H
#define GNOMON_STORAGE_MOMENTS6_SUMMED_H
#include "../soft/blocker6.h"
#include "../soft/summed_area.h"
#include "moments6.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(moments6_summed_code_weight, 8e-10); // 2^-33 / r
GNOMON_CONSTANT(moments6_summed_float_weight, 6e-6);

/// The weight of the constant bias of a table for most_texels, by which intensities may exceed the truth.
/// Domain: most_texels as of the table's scale.
/// NaN: the weight of a small table.
GNOMON_KERNEL Real moments6_summed_weight(Real most_texels)
{
    Real weight =
        GNOMON_LITERAL(moments6_summed_code_weight) * most_texels + GNOMON_LITERAL(moments6_summed_float_weight);
    return gnomon_min(gnomon_max(weight, GNOMON_LITERAL(moments6_summed_float_weight)), Real(0.5));
}

/// The six channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(channels6) moments6_summed_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
GNOMON_KERNEL GNOMON_T(channels6) moments6_summed_codes(GNOMON_T(channels6) c, GNOMON_SETTING scale)
{
    Real any = (clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1))) +
               (clamp_or_nan(c.c3, Real(0), Real(1)) + clamp_or_nan(c.c4, Real(0), Real(1))) +
               (clamp_or_nan(c.c5, Real(0), Real(1)) + clamp_or_nan(c.c6, Real(0), Real(1)));
    GNOMON_MASK known = any == any;
    channels6 border = moments6_summed_encode(Real(1));
    GNOMON_T(channels6) r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    r.c5 = summed_area_code(gnomon_select(known, c.c5, border.c5), scale);
    r.c6 = summed_area_code(gnomon_select(known, c.c6, border.c6), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
GNOMON_KERNEL GNOMON_T(channels6) moments6_summed_channels(GNOMON_T(channels6) sums, Real area, GNOMON_SETTING scale)
{
    GNOMON_MASK some = Real(0) < area;
    channels6 border = moments6_summed_encode(Real(1)); // off by roundings, also beyond 1
    GNOMON_T(channels6) r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), saturate_or_zero(border.c1));
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), saturate_or_zero(border.c2));
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), saturate_or_zero(border.c3));
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), saturate_or_zero(border.c4));
    r.c5 = gnomon_select(some, summed_area_mean(sums.c5, area, scale), saturate_or_zero(border.c5));
    r.c6 = gnomon_select(some, summed_area_mean(sums.c6, area, scale), saturate_or_zero(border.c6));
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel6) hankel6_from_summed_theta(GNOMON_T(channels6) c, GNOMON_SETTING alpha)
{
    return hankel6_constant_bias(theta6_inverse(c), GNOMON_LITERAL(bias6_theta_b2), GNOMON_LITERAL(bias6_theta_b4),
                                 GNOMON_LITERAL(bias6_theta_b6), alpha);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_summed(GNOMON_T(channels6) c, GNOMON_SETTING most_texels)
{
    return hankel6_from_summed_theta(c, moments6_summed_weight(most_texels));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_summed_intensity(GNOMON_T(channels6) c, GNOMON_SETTING most_texels, Real z_f)
{
    return hamburger6_lower(hankel6_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
GNOMON_KERNEL Real moments6_summed_blocker(GNOMON_T(channels6) c, GNOMON_SETTING most_texels, Real z_f)
{
    return blocker6_depth(hankel6_from_summed(c, most_texels), z_f);
}

GNOMON_NAMESPACE_END
#endif
