// From a fetched texel to the factored Hankel matrix, one function per storage format: each undoes the format's
// transform and applies the bias that belongs to it, so that nobody pairs the wrong three. What a shader calls after
// filtering; then hamburger4_lower.
//
//   format          transform   bias                                       bytes
//   4 x 16 UNORM    theta4      adaptive, noise 9 2^-20                     8
//   4 x half        none        adaptive, noise 13 2^-15                    8
//   4 x float       none        adaptive, noise 3 2^-26                    16
//   6 x 10 UNORM    theta6      interpolated, 4e-3                          8, as two 10-10-10-2 words
//   6 x 16 UNORM    theta6      interpolated, 8e-5                         12
//   6 x float       none        adaptive, noise 3 2^-23                    24
//
// Noise levels are the largest that leave the result no more sensitive to storage than the constant bias does; for
// transformed six moments an adaptive bias gains nothing. Weights, used where the bias is constant, cover
// one rounding, delta / r (bias.h), and a part of the further ones of filter passes, which round again but average too.
#ifndef GNOMON_MOMENTS_STORED_H
#define GNOMON_MOMENTS_STORED_H
#include "bias.h"
#include "hankel4.h"
#include "hankel6.h"
#include "quantization.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(stored4_unorm16_weight, 6e-5);
GNOMON_CONSTANT(stored4_unorm16_noise, 8.58306884765625e-06); // 9 2^-20, half a code and an eighth
GNOMON_CONSTANT(stored4_half_weight, 3.6e-3);
GNOMON_CONSTANT(stored4_half_noise, 0.000396728515625); // 13 2^-15
GNOMON_CONSTANT(stored4_float_weight, 3e-7);
GNOMON_CONSTANT(stored4_float_noise, 4.470348358154297e-08); // 3 2^-26
GNOMON_CONSTANT(stored6_unorm10_weight, 4e-3);
GNOMON_CONSTANT(stored6_unorm16_weight, 8e-5);
GNOMON_CONSTANT(stored6_float_weight, 5e-6);
GNOMON_CONSTANT(stored6_float_noise, 3.5762786865234375e-07); // 3 2^-23

/// From the four channels of a 4 x 16 UNORM texel, each in [0, 1].
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16(GNOMON_T(moments4) channels)
{
    return hankel4_raised_fast(theta4_inverse(channels), GNOMON_LITERAL(stored4_unorm16_noise));
}

/// From moments stored as half floats.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half(GNOMON_T(moments4) b)
{
    return hankel4_raised_fast(b, GNOMON_LITERAL(stored4_half_noise));
}

/// From moments stored as floats.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float(GNOMON_T(moments4) b)
{
    return hankel4_raised(b, GNOMON_LITERAL(stored4_float_noise));
}

/// From the six channels of two 10-10-10-2 UNORM words, each in [0, 1]: odd ones in the first, even ones in the second.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10(GNOMON_T(moments6) channels)
{
    return hankel6_fast(moments6_biased(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                        GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                        GNOMON_LITERAL(stored6_unorm10_weight)));
}

/// From the six channels of a 6 x 16 UNORM texel, each in [0, 1].
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16(GNOMON_T(moments6) channels)
{
    return hankel6_fast(moments6_biased(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                        GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                        GNOMON_LITERAL(stored6_unorm16_weight)));
}

/// From moments stored as floats.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float(GNOMON_T(moments6) b)
{
    return hankel6_raised(b, GNOMON_LITERAL(stored6_float_noise));
}

GNOMON_NAMESPACE_END
#endif
