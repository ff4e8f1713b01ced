// Certified shadow intensity (certified4.h) where the depths of a filter region are known to lie in [least, greatest]:
// from a min-max map beside the moments, with its mip levels. [-1, 1] always holds.
//
// p then has to be at most 1 in [least, z_f) and at most 0 in [z_f, greatest] only. Where a node of the biased moments
// lies outside, the canonical distribution on the interval (the Markov moment problem; Krein & Nudelman 1977) has nodes
// least, greatest, z_f and
//     x = E[(z - least) (greatest - z) (z - z_f) z] / E[(z - least) (greatest - z) (z - z_f)],
// and p is 1 at least and at x < z_f, 0 at z_f, at x > z_f and at greatest; double at x:
//     x > z_f:  p = (z - z_f) (z - x)^2 (z - greatest) / ((least - z_f) (least - x)^2 (least - greatest))
//     x < z_f:  p = 1 - (z - least) (z - x)^2 (k0 + k1 z),  k0 and k1 by p(z_f) = p(greatest) = 0
// Every x gives an honest p, so float arithmetic suffices. The greater of the two certified means is the result: both
// are honest.
#ifndef GNOMON_STORAGE_MOMENTS4_WITHIN_H
#define GNOMON_STORAGE_MOMENTS4_WITHIN_H
#include "moments4.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(certified4_gap, 9.5367431640625e-7); // 2^-20, the least that the receiver is before greatest

/// The certificate on [least, greatest] for a receiver z_f inside, from moments b with a bias.
GNOMON_DETAIL_KERNEL GNOMON_T(certificate4) certificate4_within(GNOMON_T(moments4) b, Real least, Real greatest,
                                                                Real z_f)
{
    greatest = gnomon_max(greatest, z_f + GNOMON_LITERAL(certified4_gap));
    Real sum = least + greatest;
    Real product = least * greatest;
    Real e0 = (sum * b.b1 - b.b2) - product;
    Real e1 = (sum * b.b2 - b.b3) - product * b.b1;
    Real e2 = (sum * b.b3 - b.b4) - product * b.b2;
    Real x = (e2 - z_f * e1) / (e1 - z_f * e0);
    x = gnomon_select(x < greatest, x, greatest);
    x = gnomon_select(least < x, x, least);
    GNOMON_MASK behind = z_f < x;
    // The line k0 + k1 z: through z_f and greatest, or the multiple of z - z_f that is 1 at least.
    Real to_least = least - x;
    Real to_z_f = z_f - x;
    Real to_greatest = greatest - x;
    Real at_least = Real(1) / (to_least * to_least);
    Real at_z_f = Real(1) / ((z_f - least) * (to_z_f * to_z_f));
    Real at_greatest = Real(1) / ((greatest - least) * (to_greatest * to_greatest));
    Real slope = gnomon_select(behind, at_least / ((z_f - least) * (least - greatest)),
                               (at_greatest - at_z_f) / (greatest - z_f));
    Real offset = gnomon_select(behind, Real(0), at_z_f) - slope * z_f;
    // s = (z - other) (z - x)^2 (offset + slope z)
    Real minus_other = Real(-1) * gnomon_select(behind, greatest, least);
    Real m0 = minus_other * offset;
    Real m1 = offset + minus_other * slope;
    Real n0 = x * x;
    Real n1 = Real(-2) * x;
    GNOMON_T(certificate4) p;
    p.top = gnomon_select(behind, Real(0), Real(1));
    p.s0 = m0 * n0;
    p.s1 = m0 * n1 + m1 * n0;
    p.s2 = m0 + (m1 * n1 + slope * n0);
    p.s3 = m1 + slope * n1;
    p.s4 = slope;
    return p;
}

/// The greater of two certified means as an intensity in [0, 1]: 1 where every depth is before z_f, 0 where none is, and
/// where the ends are not in order.
/// NaN: 0, lit.
GNOMON_DETAIL_KERNEL Real certified4_from_means(Real mean, Real within, Real least, Real greatest, Real z_f)
{
    Real intensity = saturate_or_zero(gnomon_max(within, mean));
    intensity = gnomon_select(greatest < z_f, Real(1), intensity);
    return gnomon_select(least < z_f && least <= greatest, intensity, Real(0));
}

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise.
GNOMON_DETAIL_KERNEL Real certified4_theta_within(GNOMON_T(channels4) c, GNOMON_SETTING noise, GNOMON_SETTING alpha,
                                                  Real least, Real greatest, Real z_f)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    moments4 b = theta4_inverse_add_bias(c, GNOMON_LITERAL(bias4_theta_b2), alpha);
    Real mean = certificate4_theta_mean(certificate4_make(hankel4_from_moments(b), z), c, noise);
    Real within = certificate4_theta_mean(certificate4_within(b, least, greatest, z), c, noise);
    return certified4_from_means(mean, within, least, greatest, z);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel and the least and greatest depth of
/// the region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_unorm16_intensity_within(GNOMON_T(channels4) c, Real least, Real greatest, Real z_f)
{
    return certified4_theta_within(c, GNOMON_LITERAL(certified4_unorm16_noise),
                                   GNOMON_LITERAL(certified4_unorm16_weight), least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes;
/// least and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_unorm16_filtered_intensity_within(GNOMON_T(channels4) c, Real least, Real greatest,
                                                              Real z_f)
{
    return certified4_theta_within(c, GNOMON_LITERAL(certified4_unorm16_filtered_noise),
                                   GNOMON_LITERAL(certified4_unorm16_filtered_weight), least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel and the least and greatest depth of the
/// region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_half_intensity_within(GNOMON_T(channels4) c, Real least, Real greatest, Real z_f)
{
    return certified4_theta_within(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(certified4_half_noise),
                                   GNOMON_LITERAL(certified4_half_weight), least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes; least
/// and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_half_filtered_intensity_within(GNOMON_T(channels4) c, Real least, Real greatest, Real z_f)
{
    return certified4_theta_within(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(certified4_half_filtered_noise),
                                   GNOMON_LITERAL(certified4_half_filtered_weight), least, greatest, z_f);
}

GNOMON_NAMESPACE_END
#endif
