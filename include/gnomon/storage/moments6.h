// From a fetched texel of six moments to the factored Hankel matrix, one function per storage format: each undoes the
// format's transform and applies the constant bias that belongs to it, so that nobody pairs the wrong three. What a
// shader calls after filtering; then hamburger6_lower.
//
//   format          bytes   transform   bias
//   6 x 10 UNORM      8     theta6      interpolated; texels are two 10-10-10-2 words
//   6 x 16 UNORM     12     theta6      interpolated
//   6 x float        24     none        kept apart
//
// Intensities exceed Z(z < z_f) by the weight at most, wherever the receiver is: bias.h has the proof, by which n
// roundings ask for n delta / (n delta + r).
//
//                  delta      n = 1     weight    n = 3     weight, filtered
//   6 x 10 UNORM   1/2046     3.34e-3   4e-3      9.96e-3   1e-2
//   6 x 16 UNORM   1/131070   5.23e-5   8e-5      1.57e-4   1.6e-4
//   6 x float      2^-25      1.83e-6   5e-6                2e-5
//
// Filtered: rounded when rendered and by each of two passes of nine taps, their sums in float. Sums of floats round as
// storage does, and so do the powers of a depth: counted at their worst they are 22 roundings and 4e-5, which do not
// come together. The kernel's own arithmetic in float is within the weights. tests/moments/honest_six.cpp climbs for what
// exceeds a weight, and finds that 5e-6 does not do for filtered floats.
#ifndef GNOMON_STORAGE_MOMENTS6_H
#define GNOMON_STORAGE_MOMENTS6_H
#include "../moments/bias.h"
#include "../moments/hankel6.h"
#include "../moments/quantization.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(stored6_unorm10_weight, 4e-3);
GNOMON_CONSTANT(stored6_unorm10_filtered_weight, 1e-2);
GNOMON_CONSTANT(stored6_unorm16_weight, 8e-5);
GNOMON_CONSTANT(stored6_unorm16_filtered_weight, 1.6e-4);
GNOMON_CONSTANT(stored6_float_weight, 5e-6);
GNOMON_CONSTANT(stored6_float_filtered_weight, 2e-5);

/// From the six channels of two 10-10-10-2 UNORM words, each in [0, 1]: odd ones in the first, even ones in the second.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10(GNOMON_T(moments6) channels)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                                  GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                                  GNOMON_LITERAL(stored6_unorm10_weight)));
}

/// The same after two filter passes that stored their results as UNORM10.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10_filtered(GNOMON_T(moments6) channels)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                                  GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                                  GNOMON_LITERAL(stored6_unorm10_filtered_weight)));
}

/// From the six channels of a 6 x 16 UNORM texel, each in [0, 1].
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16(GNOMON_T(moments6) channels)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                                  GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                                  GNOMON_LITERAL(stored6_unorm16_weight)));
}

/// The same after two filter passes that stored their results as UNORM16.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16_filtered(GNOMON_T(moments6) channels)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(channels), GNOMON_LITERAL(bias6_theta_b2),
                                                  GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                                  GNOMON_LITERAL(stored6_unorm16_filtered_weight)));
}

/// From moments stored as floats.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float(GNOMON_T(moments6) b)
{
    return hankel6_constant_bias(b, GNOMON_LITERAL(bias6_raw_b2), GNOMON_LITERAL(bias6_raw_b4),
                                 GNOMON_LITERAL(bias6_raw_b6), GNOMON_LITERAL(stored6_float_weight));
}

/// The same after two filter passes in float.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float_filtered(GNOMON_T(moments6) b)
{
    return hankel6_constant_bias(b, GNOMON_LITERAL(bias6_raw_b2), GNOMON_LITERAL(bias6_raw_b4),
                                 GNOMON_LITERAL(bias6_raw_b6), GNOMON_LITERAL(stored6_float_filtered_weight));
}

GNOMON_NAMESPACE_END
#endif
