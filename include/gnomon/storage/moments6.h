// Six moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow or to
// the factored Hankel matrix. Each format undoes its own transform and applies the constant bias that belongs to it, so
// that nobody pairs the wrong three.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   6 x 10 UNORM      8     theta6      moments6_unorm10_encode   moments6_unorm10_intensity   hankel6_from_unorm10
//   6 x 16 UNORM     12     theta6      moments6_unorm16_encode   moments6_unorm16_intensity   hankel6_from_unorm16
//   6 x float        24     none        moments6_float_encode     moments6_float_intensity     hankel6_from_float
//
// Texels of 6 x 10 UNORM are two 10-10-10-2 words: odd channels (c1, c2, c3) in the first, even ones (c4, c5, c6) in the
// second. Filters are linear: average channels as they are.
//
// Intensities exceed Z(z < z_f) by the weight at most, for every receiver: by the proof in bias.h n roundings need a
// weight of n delta / (n delta + r).
//
//                  delta      n = 1     weight    n = 3     weight, filtered
//   6 x 10 UNORM   1/2046     3.34e-3   4e-3      9.96e-3   1e-2
//   6 x 16 UNORM   1/131070   5.23e-5   8e-5      1.57e-4   1.6e-4
//   6 x float      2^-25      1.83e-6   5e-6                2e-5
//
// Filtered: rounded when rendered and by each of two passes of nine taps, their sums in float. Sums of floats round as
// storage does, and so do the powers of a depth: at their worst they are 22 roundings and 4e-5, which do not come
// together. The kernel's own arithmetic in float is within the weights. Tests search for the largest excess by hill
// climbing (tests/moments/honest_six.cpp), and find that 5e-6 is too little for filtered floats.
#ifndef GNOMON_STORAGE_MOMENTS6_H
#define GNOMON_STORAGE_MOMENTS6_H
#include "../moments/bias.h"
#include "../moments/hamburger6.h"
#include "../moments/hankel6.h"
#include "../moments/quantization.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(stored6_unorm10_weight, 4e-3);
GNOMON_CONSTANT(stored6_unorm10_filtered_weight, 1e-2);
GNOMON_CONSTANT(stored6_unorm16_weight, 8e-5);
GNOMON_CONSTANT(stored6_unorm16_filtered_weight, 1.6e-4);
GNOMON_CONSTANT(stored6_float_weight, 5e-6);
GNOMON_CONSTANT(stored6_float_filtered_weight, 2e-5);

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(channels6) moments6_unorm10_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(channels6) moments6_unorm16_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(channels6) moments6_float_encode(Real z)
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The factored matrix of the channels of theta6, with a constant bias of weight alpha.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel6) hankel6_from_theta(GNOMON_T(channels6) c, GNOMON_SETTING alpha)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), GNOMON_LITERAL(bias6_theta_b2),
                                                  GNOMON_LITERAL(bias6_theta_b4), GNOMON_LITERAL(bias6_theta_b6),
                                                  alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10(GNOMON_T(channels6) c)
{
    return hankel6_from_theta(c, GNOMON_LITERAL(stored6_unorm10_weight));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm10_filtered(GNOMON_T(channels6) c)
{
    return hankel6_from_theta(c, GNOMON_LITERAL(stored6_unorm10_filtered_weight));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16(GNOMON_T(channels6) c)
{
    return hankel6_from_theta(c, GNOMON_LITERAL(stored6_unorm16_weight));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_unorm16_filtered(GNOMON_T(channels6) c)
{
    return hankel6_from_theta(c, GNOMON_LITERAL(stored6_unorm16_filtered_weight));
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float(GNOMON_T(channels6) c)
{
    return hankel6_constant_bias(moments6_from_channels(c), GNOMON_LITERAL(bias6_raw_b2), GNOMON_LITERAL(bias6_raw_b4),
                                 GNOMON_LITERAL(bias6_raw_b6), GNOMON_LITERAL(stored6_float_weight));
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_float_filtered(GNOMON_T(channels6) c)
{
    return hankel6_constant_bias(moments6_from_channels(c), GNOMON_LITERAL(bias6_raw_b2), GNOMON_LITERAL(bias6_raw_b4),
                                 GNOMON_LITERAL(bias6_raw_b6), GNOMON_LITERAL(stored6_float_filtered_weight));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm10_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm10(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm10_filtered_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm16_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm16(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_unorm16_filtered_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_float_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_float(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments6_float_filtered_intensity(GNOMON_T(channels6) c, Real z_f)
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
}

GNOMON_NAMESPACE_END
#endif
