// Four moments from texels into which translucent fragments were blended (moments/translucency.h): what is allowed for grows
// with the number of roundings that are left.
//
//   format          matrix for both bounds         shadow
//   4 x 16 UNORM    hankel4_from_unorm16_blended   moments4_unorm16_blended_intensity
//   4 x half        hankel4_from_half_blended      moments4_half_blended_intensity
//   4 x float       hankel4_from_float_blended     moments4_float_blended_intensity
//
// roundings is the number of roundings after the first store of a texel: blend_roundings of the least alpha, and one for
// each filter pass that stores its results in the format. 0 is a texel that was stored once. Half floats may be truncated
// by each of them, which counts as two. A blend of floats rounds a product, a sum and 1 - alpha, which is 3.5 roundings.
//
// Intensities exceed Z(z < z_f) by at most
//   X_blended_intensity         stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X_blended      the weight of the constant bias, bias_weight_of_roundings, and that of arithmetic
// Layers that vanish, since they are fainter than half a code, are missing in the shadow, which makes it lighter.
#ifndef GNOMON_STORAGE_MOMENTS4_BLENDED_H
#define GNOMON_STORAGE_MOMENTS4_BLENDED_H
#include "../moments/translucency.h"
#include "moments4.h"
GNOMON_NAMESPACE_BEGIN

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16_blended(GNOMON_T(channels4) c, GNOMON_SETTING roundings)
{
    return hankel4_from_theta(
        c, bias_weight_of_roundings(GNOMON_LITERAL(stored4_unorm16_weight), blended_roundings(roundings, Real(1))));
}

/// The factored matrix of the channels of a 4 x half texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half_blended(GNOMON_T(channels4) c, GNOMON_SETTING roundings)
{
    Real n = blended_roundings(roundings, GNOMON_LITERAL(blended_half_roundings));
    return hankel4_from_theta(channels4_shifted(c, Real(0.5)),
                              bias_weight_of_roundings(GNOMON_LITERAL(stored4_half_weight), n));
}

/// The factored matrix of the channels of a 4 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float_blended(GNOMON_T(channels4) c, GNOMON_SETTING roundings)
{
    Real n = blended_roundings(roundings, GNOMON_LITERAL(blended_float_roundings));
    return hankel4_stored_as_float(c, bias_weight_of_roundings(GNOMON_LITERAL(stored4_float_weight), n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_unorm16_blended_intensity(GNOMON_T(channels4) c, GNOMON_SETTING roundings, Real z_f)
{
    Real n = blended_roundings(roundings, Real(1));
    return moments4_theta_intensity(c, n * GNOMON_LITERAL(certified4_unorm16_noise),
                                    bias_weight_of_roundings(GNOMON_LITERAL(certified4_unorm16_weight), n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_half_blended_intensity(GNOMON_T(channels4) c, GNOMON_SETTING roundings, Real z_f)
{
    Real n = blended_roundings(roundings, GNOMON_LITERAL(blended_half_roundings));
    return moments4_theta_intensity(channels4_shifted(c, Real(0.5)), n * GNOMON_LITERAL(certified4_half_noise),
                                    bias_weight_of_roundings(GNOMON_LITERAL(certified4_half_weight), n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_float_blended_intensity(GNOMON_T(channels4) c, GNOMON_SETTING roundings, Real z_f)
{
    Real n = blended_roundings(roundings, GNOMON_LITERAL(blended_float_roundings));
    // Roundings of earlier states of the texel, in which a moment was larger, are no fraction of that moment.
    GNOMON_T(moments4) noise;
    noise.b1 = n * GNOMON_LITERAL(certified4_float_noise);
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    return moments4_float_intensity_with_noise(
        c, noise, bias_weight_of_roundings(GNOMON_LITERAL(certified4_float_weight), n), z_f);
}

GNOMON_NAMESPACE_END
#endif
