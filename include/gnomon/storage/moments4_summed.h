// Four moments in a summed-area table (soft/summed_area.h): from a depth to the codes of a texel, and from the mean
// channels of a rectangle to a shadow and to the depth of blockers.
//
//   a texel:        c = moments4_summed_encode(z)               channels of theta4; a resolve averages them
//                   codes = moments4_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned integers
//   a rectangle:    c = moments4_summed_channels(sums, area, scale)
//                   z_b = moments4_summed_blocker(c, most_texels, z_f)
//                   shadow = moments4_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by moments4_summed_noise at most: by half a code, most_texels 2^-33, and by what float arithmetic rounds
// from the depth to the moments.
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_H
#define GNOMON_STORAGE_MOMENTS4_SUMMED_H
#include "../soft/blocker.h"
#include "../soft/summed_area.h"
#include "moments4.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(moments4_summed_code_noise, 1.1641532182693481e-10); // 2^-33
GNOMON_CONSTANT(moments4_summed_float_noise, 1.8e-7);
GNOMON_CONSTANT(moments4_summed_bias_ratio, 4.0);

/// The largest error of the channels of a rectangle, for a table by summed_area_scale(most_texels).
/// Domain: most_texels at least 0.
GNOMON_KERNEL Real moments4_summed_noise(Real most_texels)
{
    return GNOMON_LITERAL(moments4_summed_code_noise) * most_texels + GNOMON_LITERAL(moments4_summed_float_noise);
}

/// The four channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_encode(Real z)
{
    return theta4(moments4_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_codes(GNOMON_T(channels4) c, GNOMON_SETTING scale)
{
    Real any = (clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1))) +
               (clamp_or_nan(c.c3, Real(0), Real(1)) + clamp_or_nan(c.c4, Real(0), Real(1)));
    GNOMON_MASK known = any == any;
    channels4 border = moments4_summed_encode(Real(1));
    GNOMON_T(channels4) r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_channels(GNOMON_T(channels4) sums, Real area, GNOMON_SETTING scale)
{
    GNOMON_MASK some = Real(0) < area;
    channels4 border = moments4_summed_encode(Real(1));
    GNOMON_T(channels4) r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), border.c1);
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), border.c2);
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), border.c3);
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), border.c4);
    return r;
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_summed(GNOMON_T(channels4) c, GNOMON_SETTING most_texels)
{
    Real weight = GNOMON_LITERAL(moments4_summed_bias_ratio) * moments4_summed_noise(most_texels);
    return hankel4_constant_bias(theta4_inverse(c), GNOMON_LITERAL(bias4_theta_b2), GNOMON_LITERAL(bias4_theta_b4),
                                 gnomon_min(weight, Real(0.5)));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_summed_intensity(GNOMON_T(channels4) c, GNOMON_SETTING most_texels, Real z_f)
{
    return hamburger4_lower(hankel4_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
GNOMON_KERNEL Real moments4_summed_blocker(GNOMON_T(channels4) c, GNOMON_SETTING most_texels, Real z_f)
{
    return blocker4_depth(hankel4_from_summed(c, most_texels), z_f);
}

GNOMON_NAMESPACE_END
#endif
