// The mean and the mean square of depths in a summed-area table (soft/summed_area.h; Lauritzen 2007), in 8 bytes a texel: what
// variance soft shadow mapping reads (Yang et al. 2010).
//
//   a texel:        c = variance_summed_encode(z)               (1 + z) / 2 and z^2; a resolve averages them
//                   codes = variance_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned integers
//   a rectangle:    c = variance_summed_channels(sums, area, scale)
//                   z_b = variance_summed_blocker(c, most_texels, z_f)
//                   shadow = variance_summed_intensity(c, most_texels, z_f - bias)
//
// With channels that are off by noise, the mean is off by 2 noise and the variance by (1 + 4 |mean|) noise at most. Cantelli's
// bound from the largest variance and the least distance never darkens.
#ifndef GNOMON_STORAGE_VARIANCE_SUMMED_H
#define GNOMON_STORAGE_VARIANCE_SUMMED_H
#include "../moments/channels.h"
#include "../soft/blocker.h"
#include "../soft/summed_area.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(variance_summed_darkening, 1e-6);

/// The two channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(channels2) variance_summed_encode(Real z)
{
    Real x = clamp_or_high(z, Real(-1), Real(1));
    GNOMON_T(channels2) c;
    c.c1 = Real(0.5) * x + Real(0.5);
    c.c2 = x * x;
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
GNOMON_KERNEL GNOMON_T(channels2) variance_summed_codes(GNOMON_T(channels2) c, GNOMON_SETTING scale)
{
    Real any = clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1));
    GNOMON_MASK known = any == any;
    GNOMON_T(channels2) r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, Real(1)), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, Real(1)), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
GNOMON_KERNEL GNOMON_T(channels2) variance_summed_channels(GNOMON_T(channels2) sums, Real area, GNOMON_SETTING scale)
{
    GNOMON_MASK some = Real(0) < area;
    GNOMON_T(channels2) r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), Real(1));
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), Real(1));
    return r;
}

/// The mean and the largest variance that channels may have which are off by noise.
GNOMON_STRUCT(variance_summed_moments) { Real mean, variance; };

GNOMON_DETAIL_KERNEL GNOMON_T(variance_summed_moments) variance_summed_decode(GNOMON_T(channels2) c, Real noise)
{
    GNOMON_T(variance_summed_moments) r;
    r.mean = (c.c1 - Real(0.5)) * Real(2);
    Real doubt = (Real(1) + Real(4) * gnomon_abs(r.mean)) * noise;
    r.variance = gnomon_max(subtract_product_rounded(c.c2, r.mean, r.mean), Real(0)) + doubt;
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
/// Source: Donnelly & Lauritzen 2006
GNOMON_KERNEL Real variance_summed_intensity(GNOMON_T(channels2) c, GNOMON_SETTING most_texels, Real z_f)
{
    Real noise = summed_area_noise(most_texels);
    variance_summed_moments b = variance_summed_decode(c, noise);
    Real distance_ = (clamp_or_nan(z_f, Real(-1), Real(1)) - b.mean) - Real(2) * noise;
    Real d = gnomon_max(Real(0), distance_);
    // 1, or 0 for NaN, without a comparison, which Metal's fast mathematics would lose.
    Real known = saturate_or_zero(c.c2 + Real(1));
    return known * saturate_or_zero(d * d / (b.variance + d * d));
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
/// Error: against the kernel in double, for a table of 784 texels,
///     error, float, variance_summed_blocker: p99 1e-6, p99.9 2e-4, max 2e-3
/// Source: Yang 2010
GNOMON_KERNEL Real variance_summed_blocker(GNOMON_T(channels2) c, GNOMON_SETTING most_texels, Real z_f)
{
    variance_summed_moments b = variance_summed_decode(c, summed_area_noise(most_texels));
    Real depth = blocker2_depth(b.mean, b.variance, z_f);
    return gnomon_select(c.c2 == c.c2, depth, clamp_or_high(z_f, Real(-1), Real(1)));
}

GNOMON_NAMESPACE_END
#endif
