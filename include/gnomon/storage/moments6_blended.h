// Six moments from texels into which translucent fragments were blended (moments/translucency.h), by a constant bias whose
// weight grows with the number of roundings that are left, as in moments4_blended.h.
//
//   format          matrix for both bounds         shadow
//   6 x 10 UNORM    hankel6_from_unorm10_blended   moments6_unorm10_blended_intensity
//   6 x 16 UNORM    hankel6_from_unorm16_blended   moments6_unorm16_blended_intensity
//   6 x float       hankel6_from_float_blended     moments6_float_blended_intensity
//
// Intensities exceed Z(z < z_f) by bias_weight_of_roundings at most: for blends of an alpha from 1% on by 8e-3 for 6 x 16
// UNORM, but by 0.29 for 6 x 10 UNORM, which is no format to blend many layers into. A blend of floats takes 1.5 of the
// weights of 6 x float, each of which is good for 2.7 roundings.
#ifndef GNOMON_STORAGE_MOMENTS6_BLENDED_H
#define GNOMON_STORAGE_MOMENTS6_BLENDED_H
#include "../moments/translucency.h"
#include "moments6.h"
GNOMON_NAMESPACE_BEGIN

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10_blended(GNOMON_T(channels6) c, GNOMON_SETTING roundings)
{
    return hankel6_from_theta(
        c, bias_weight_of_roundings(GNOMON_LITERAL(stored6_unorm10_weight), blended_roundings(roundings, Real(1))));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16_blended(GNOMON_T(channels6) c, GNOMON_SETTING roundings)
{
    return hankel6_from_theta(
        c, bias_weight_of_roundings(GNOMON_LITERAL(stored6_unorm16_weight), blended_roundings(roundings, Real(1))));
}

GNOMON_CONSTANT(blended6_float_weights, 1.5);

/// The factored matrix of the channels of a 6 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float_blended(GNOMON_T(channels6) c, GNOMON_SETTING roundings)
{
    Real n = blended_roundings(roundings, GNOMON_LITERAL(blended6_float_weights));
    return hankel6_constant_bias(moments6_from_channels(c), GNOMON_LITERAL(bias6_raw_b2), GNOMON_LITERAL(bias6_raw_b4),
                                 GNOMON_LITERAL(bias6_raw_b6),
                                 bias_weight_of_roundings(GNOMON_LITERAL(stored6_float_weight), n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm10_blended_intensity(GNOMON_T(channels6) c, GNOMON_SETTING roundings, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm16_blended_intensity(GNOMON_T(channels6) c, GNOMON_SETTING roundings, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_float_blended_intensity(GNOMON_T(channels6) c, GNOMON_SETTING roundings, Real z_f)
{
    return hamburger6_lower(hankel6_from_float_blended(c, roundings), z_f);
}

GNOMON_NAMESPACE_END
#endif
