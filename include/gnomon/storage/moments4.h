// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16
//   4 x half          8     theta4 - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
//   4 x float        16     none        moments4_float_encode     moments4_float_intensity     hankel4_from_float
//
// Filters are linear: average channels as they are. X_intensity and hankel4_from_X allow for one rounding: of channels
// that are stored once and filtered without further rounding, as 16-bit texels by a texture unit that returns floats.
// Texels of floats round again there and need X_filtered. X_filtered_intensity and hankel4_from_X_filtered allow for a
// pass along rows and one along columns, of nine taps at most, that store their results in the format again, half
// floats truncated or rounded. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by at most
//   X_intensity         stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X      the weight of the constant bias, roundings * delta / r (bias.h), and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/moments/honest_four.cpp). Certificates (certified4.h) leak
// less than a constant bias in every format. Float arithmetic moves the nodes of a certificate, which costs or gains a
// little leaking. Difference of an intensity in float from the intensity in double:
//     error, float, moments4_float_intensity: p99 3e-5, p99.9 1e-4, max 5e-4
//     error, float, moments4_float_filtered_intensity: p99 1e-5, p99.9 5e-5, max 2e-4
//     error, float, moments4_half_intensity: p99 5e-5, p99.9 4e-4, max 2e-2
//     error, float, moments4_half_filtered_intensity: p99 3e-5, p99.9 2e-4, max 2e-3
//     error, float, moments4_unorm16_intensity: p99 6e-4, p99.9 7e-3, max 3e-1
//     error, float, moments4_unorm16_filtered_intensity: p99 3e-4, p99.9 3e-3, max 3e-2
#ifndef GNOMON_STORAGE_MOMENTS4_H
#define GNOMON_STORAGE_MOMENTS4_H
#include "../moments/bias.h"
#include "../moments/certified4.h"
#include "../moments/hankel4.h"
#include "../moments/quantization.h"
#include "../numerics/round.h"
GNOMON_NAMESPACE_BEGIN

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(channels4) moments4_unorm16_encode(Real z)
{
    return theta4(moments4_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The channels c, each with shift added.
GNOMON_DETAIL_KERNEL GNOMON_T(channels4) channels4_shifted(GNOMON_T(channels4) c, GNOMON_SETTING shift)
{
    c.c1 = c.c1 + shift;
    c.c2 = c.c2 + shift;
    c.c3 = c.c3 + shift;
    c.c4 = c.c4 + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
GNOMON_DETAIL_KERNEL Real half_nearest(Real x) { return Real(0.000244140625) * nearest_integer(Real(4096) * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices may
/// truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(channels4) moments4_half_encode(Real z)
{
    channels4 c = channels4_shifted(moments4_unorm16_encode(z), Real(-0.5));
    c.c1 = half_nearest(c.c1);
    c.c2 = half_nearest(c.c2);
    c.c3 = half_nearest(c.c3);
    c.c4 = half_nearest(c.c4);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(channels4) moments4_float_encode(Real z)
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

GNOMON_CONSTANT(stored4_unorm16_weight, 3.6e-5);
GNOMON_CONSTANT(stored4_unorm16_filtered_weight, 1.1e-4);
GNOMON_CONSTANT(stored4_half_weight, 5.7e-4);
GNOMON_CONSTANT(stored4_half_filtered_weight, 2.85e-3);
GNOMON_CONSTANT(stored4_float_weight, 3e-7);
GNOMON_CONSTANT(stored4_float_filtered_weight, 2e-6);
GNOMON_CONSTANT(stored4_arithmetic_weight, 1e-6);

/// The factored matrix of the channels of theta4, with a constant bias of weight alpha.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel4) hankel4_from_theta(GNOMON_T(channels4) c, GNOMON_SETTING alpha)
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, GNOMON_LITERAL(bias4_theta_b2), alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel4) hankel4_stored_as_float(GNOMON_T(channels4) c, GNOMON_SETTING alpha)
{
    return hankel4_constant_bias(moments4_from_channels(c), GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4),
                                 alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16(GNOMON_T(channels4) c)
{
    return hankel4_from_theta(c, GNOMON_LITERAL(stored4_unorm16_weight));
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16_filtered(GNOMON_T(channels4) c)
{
    return hankel4_from_theta(c, GNOMON_LITERAL(stored4_unorm16_filtered_weight));
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half(GNOMON_T(channels4) c)
{
    return hankel4_from_theta(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(stored4_half_weight));
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half_filtered(GNOMON_T(channels4) c)
{
    return hankel4_from_theta(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(stored4_half_filtered_weight));
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float(GNOMON_T(channels4) c)
{
    return hankel4_stored_as_float(c, GNOMON_LITERAL(stored4_float_weight));
}

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float_filtered(GNOMON_T(channels4) c)
{
    return hankel4_stored_as_float(c, GNOMON_LITERAL(stored4_float_filtered_weight));
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
GNOMON_CONSTANT(certified4_unorm16_noise, 8e-6); // half a code, and the error of theta4 in float
GNOMON_CONSTANT(certified4_unorm16_filtered_noise, 2.4e-5);
GNOMON_CONSTANT(certified4_unorm16_weight, 3.6e-5);
GNOMON_CONSTANT(certified4_unorm16_filtered_weight, 9e-5);
GNOMON_CONSTANT(certified4_half_noise, 1.225e-4);         // 2^-13, and the error of theta4 in float
GNOMON_CONSTANT(certified4_half_filtered_noise, 6.12e-4); // passes may truncate: 2^-12 each
GNOMON_CONSTANT(certified4_half_weight, 6e-4);
GNOMON_CONSTANT(certified4_half_filtered_weight, 2.3e-3);
GNOMON_CONSTANT(certified4_float_noise, 3.3e-8);                        // 1.1 times 2^-25
GNOMON_CONSTANT(certified4_float_filtered_noise, 2.384185791015625e-7); // 8 times: sums of nine taps round, too
GNOMON_CONSTANT(certified4_float_weight, 3e-7);
GNOMON_CONSTANT(certified4_float_filtered_weight, 1.5e-6);

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise, by nodes with a bias of weight alpha.
GNOMON_DETAIL_KERNEL Real moments4_theta_intensity(GNOMON_T(channels4) c, GNOMON_SETTING noise, GNOMON_SETTING alpha,
                                                   Real z_f)
{
    return certified4_theta_lower(hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_unorm16_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_theta_intensity(c, GNOMON_LITERAL(certified4_unorm16_noise),
                                    GNOMON_LITERAL(certified4_unorm16_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_unorm16_filtered_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_theta_intensity(c, GNOMON_LITERAL(certified4_unorm16_filtered_noise),
                                    GNOMON_LITERAL(certified4_unorm16_filtered_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_half_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_theta_intensity(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(certified4_half_noise),
                                    GNOMON_LITERAL(certified4_half_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_half_filtered_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_theta_intensity(channels4_shifted(c, Real(0.5)), GNOMON_LITERAL(certified4_half_filtered_noise),
                                    GNOMON_LITERAL(certified4_half_filtered_weight), z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes with
/// a bias of weight alpha.
GNOMON_DETAIL_KERNEL Real moments4_float_intensity_with_noise(GNOMON_T(channels4) c, GNOMON_T(moments4) noise,
                                                              GNOMON_SETTING alpha, Real z_f)
{
    return certified4_constant_bias_lower(hankel4_stored_as_float(c, alpha), noise, GNOMON_LITERAL(bias4_raw_b2),
                                          GNOMON_LITERAL(bias4_raw_b4), alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_float_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), GNOMON_LITERAL(certified4_float_noise)),
        GNOMON_LITERAL(certified4_float_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_float_filtered_intensity(GNOMON_T(channels4) c, Real z_f)
{
    return moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), GNOMON_LITERAL(certified4_float_filtered_noise)),
        GNOMON_LITERAL(certified4_float_filtered_weight), z_f);
}

GNOMON_NAMESPACE_END
#endif
