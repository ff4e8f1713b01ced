// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in any
// order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4 - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add up to
// additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A fragment's
// own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by 2^-24 of its
// value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.
#ifndef GNOMON_STORAGE_ABSORBANCE4_H
#define GNOMON_STORAGE_ABSORBANCE4_H
#include "../moments/absorbance.h"
#include "moments4.h"
GNOMON_NAMESPACE_BEGIN

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
GNOMON_KERNEL GNOMON_T(channels5) absorbance4_float_encode(Real z, Real alpha)
{
    absorbance4 b = absorbance4_of_fragment(z, alpha);
    GNOMON_T(channels5) c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b0;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
GNOMON_KERNEL GNOMON_T(channels5) absorbance4_half_encode(Real z, Real alpha)
{
    Real a = absorbance_of_opacity(alpha);
    channels4 s = channels4_shifted(moments4_unorm16_encode(z), Real(-0.5));
    GNOMON_T(channels5) c;
    c.c1 = a * s.c1;
    c.c2 = a * s.c2;
    c.c3 = a * s.c3;
    c.c4 = a * s.c4;
    c.c5 = a;
    return c;
}

GNOMON_CONSTANT(absorbance4_half_additions, 8.0);
GNOMON_CONSTANT(absorbance4_half_least, 1.220703125e-4); // 2^-13: below, half floats are denormal
GNOMON_CONSTANT(absorbance4_float_additions, 4.0);
GNOMON_CONSTANT(absorbance4_float_more, 3.0); // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
GNOMON_KERNEL Real absorbance4_float_transmittance(GNOMON_T(channels5) c, GNOMON_SETTING additions,
                                                   GNOMON_SETTING overestimation, Real z_f)
{
    GNOMON_T(absorbance4) b;
    b.b0 = c.c5;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    Real n = blended_roundings(additions + GNOMON_LITERAL(absorbance4_float_more),
                               GNOMON_LITERAL(absorbance4_float_additions));
    return absorbance4_transmittance(b, bias_weight_of_roundings(GNOMON_LITERAL(stored4_float_weight), n),
                                     overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
GNOMON_KERNEL Real absorbance4_half_transmittance(GNOMON_T(channels5) c, GNOMON_SETTING additions,
                                                  GNOMON_SETTING overestimation, Real z_f)
{
    Real scale = Real(1) / gnomon_max(GNOMON_LITERAL(absorbance4_half_least), c.c5);
    GNOMON_T(channels4) s;
    s.c1 = c.c1 * scale;
    s.c2 = c.c2 * scale;
    s.c3 = c.c3 * scale;
    s.c4 = c.c4 * scale;
    Real weight = bias_weight_of_roundings(GNOMON_LITERAL(stored4_half_weight),
                                           blended_roundings(additions, GNOMON_LITERAL(absorbance4_half_additions)));
    hankel4 h = hankel4_from_theta(channels4_shifted(s, Real(0.5)), weight);
    return absorbance_transmittance(c.c5, absorbance4_intensity(h, weight, overestimation, z_f));
}

GNOMON_NAMESPACE_END
#endif
