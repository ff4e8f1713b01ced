// From a fetched texel of four moments to a shadow: one function per storage format, which undoes the format's
// transform and allows for what storage rounds, so that nobody pairs the wrong ones. What a shader calls after
// filtering.
//
//   format          bytes   intensity of a surface    matrix for both bounds and nodes (hamburger4.h)
//   4 x 16 UNORM      8     certified4_unorm16        hankel4_from_unorm16
//   4 x half          8     certified4_half           hankel4_from_half
//   4 x float        16     certified4_float          hankel4_from_float
//
// Each allows for one rounding: moments are stored once and filtered without further rounding, as by a texture unit.
// Those that end in _filtered allow for a pass along rows and one along columns, of nine taps at most, that store their
// results in the format again. Intensities exceed Z(z < z_f), whatever the distribution Z, by at most
//   certified4_*        stored4_arithmetic_weight: what float arithmetic makes of an exact bound
//   hankel4_from_*      the weight of the constant bias, roundings * delta / r (bias.h), and that of arithmetic
// which tests/moments/honest_four.cpp climbs for. Certificates leak less than a constant bias in every format. Float
// arithmetic moves where they have their nodes, which costs or gains a little leaking; against the same in double,
//     error, float, certified4_float: p99 3e-5, p99.9 1e-4, max 5e-4
//     error, float, certified4_float_filtered: p99 1e-5, p99.9 5e-5, max 2e-4
//     error, float, certified4_half: p99 2e-5, p99.9 1e-4, max 1e-2
//     error, float, certified4_half_filtered: p99 1e-5, p99.9 6e-5, max 5e-4
//     error, float, certified4_unorm16: p99 6e-4, p99.9 7e-3, max 3e-1
//     error, float, certified4_unorm16_filtered: p99 3e-4, p99.9 3e-3, max 3e-2
#ifndef GNOMON_STORAGE_MOMENTS4_H
#define GNOMON_STORAGE_MOMENTS4_H
#include "../moments/bias.h"
#include "../moments/certified4.h"
#include "../moments/hankel4.h"
#include "../moments/quantization.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(stored4_unorm16_weight, 3.6e-5);
GNOMON_CONSTANT(stored4_unorm16_filtered_weight, 1.1e-4);
GNOMON_CONSTANT(stored4_half_weight, 2.5e-3);
GNOMON_CONSTANT(stored4_half_filtered_weight, 7.3e-3);
GNOMON_CONSTANT(stored4_float_weight, 3e-7);
GNOMON_CONSTANT(stored4_float_filtered_weight, 2e-6);
GNOMON_CONSTANT(stored4_arithmetic_weight, 1e-6);

/// From the four channels of a 4 x 16 UNORM texel, each in [0, 1], with a constant bias of weight alpha.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_stored_as_unorm16(GNOMON_T(moments4) channels, GNOMON_SETTING alpha)
{
    return hankel4_from_moments(theta4_inverse_add_bias(channels, GNOMON_LITERAL(bias4_theta_b2), alpha));
}

/// From moments stored as half floats, with a constant bias of weight alpha.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_stored_as_half(GNOMON_T(moments4) b, GNOMON_SETTING alpha)
{
    return hankel4_from_moments(
        moments4_add_bias(b, GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4), alpha));
}

/// From moments stored as floats, with a constant bias of weight alpha, from 3e-7 on.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_stored_as_float(GNOMON_T(moments4) b, GNOMON_SETTING alpha)
{
    return hankel4_constant_bias(b, GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4), alpha);
}

/// The same with the weight for one rounding.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16(GNOMON_T(moments4) channels)
{
    return hankel4_stored_as_unorm16(channels, GNOMON_LITERAL(stored4_unorm16_weight));
}

/// The same with the weight for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_unorm16_filtered(GNOMON_T(moments4) channels)
{
    return hankel4_stored_as_unorm16(channels, GNOMON_LITERAL(stored4_unorm16_filtered_weight));
}

/// From moments stored as half floats.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half(GNOMON_T(moments4) b)
{
    return hankel4_stored_as_half(b, GNOMON_LITERAL(stored4_half_weight));
}

/// The same with the weight for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_half_filtered(GNOMON_T(moments4) b)
{
    return hankel4_stored_as_half(b, GNOMON_LITERAL(stored4_half_filtered_weight));
}

/// From moments stored as floats.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float(GNOMON_T(moments4) b)
{
    return hankel4_stored_as_float(b, GNOMON_LITERAL(stored4_float_weight));
}

/// The same with the weight for a filter of two passes.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_float_filtered(GNOMON_T(moments4) b)
{
    return hankel4_stored_as_float(b, GNOMON_LITERAL(stored4_float_filtered_weight));
}

// Errors of each channel that certificates allow for, and weights of the bias that their nodes have. Any weight is
// honest; these leak least without specks, which too small a weight lets noise put into contact shadows.
GNOMON_CONSTANT(certified4_unorm16_noise, 8e-6); // half a code, and what theta4 in float adds
GNOMON_CONSTANT(certified4_unorm16_filtered_noise, 2.4e-5);
GNOMON_CONSTANT(certified4_unorm16_weight, 3.6e-5);
GNOMON_CONSTANT(certified4_unorm16_filtered_weight, 9e-5);
GNOMON_CONSTANT(certified4_half_noise, 0.000244140625); // 2^-12
GNOMON_CONSTANT(certified4_half_filtered_noise, 0.000732421875);
GNOMON_CONSTANT(certified4_half_least_noise, 8.9406967163085938e-8); // 3 2^-25, of denormals
GNOMON_CONSTANT(certified4_half_weight, 2e-3);
GNOMON_CONSTANT(certified4_half_filtered_weight, 4.5e-3);
GNOMON_CONSTANT(certified4_float_noise, 3.3e-8);                        // 1.1 times 2^-25
GNOMON_CONSTANT(certified4_float_filtered_noise, 2.384185791015625e-7); // 8 times: sums of nine taps round, too
GNOMON_CONSTANT(certified4_float_weight, 3e-7);
GNOMON_CONSTANT(certified4_float_filtered_weight, 1.5e-6);

/// Intensity at z_f from the four channels of a 4 x 16 UNORM texel, each in [0, 1].
GNOMON_KERNEL Real certified4_unorm16(GNOMON_T(moments4) channels, Real z_f)
{
    return certified4_theta_lower(hankel4_stored_as_unorm16(channels, GNOMON_LITERAL(certified4_unorm16_weight)),
                                  channels, GNOMON_LITERAL(certified4_unorm16_noise), z_f);
}

/// The same after a filter of two passes.
GNOMON_KERNEL Real certified4_unorm16_filtered(GNOMON_T(moments4) channels, Real z_f)
{
    return certified4_theta_lower(
        hankel4_stored_as_unorm16(channels, GNOMON_LITERAL(certified4_unorm16_filtered_weight)), channels,
        GNOMON_LITERAL(certified4_unorm16_filtered_noise), z_f);
}

/// Intensity at z_f from moments stored as half floats.
GNOMON_KERNEL Real certified4_half(GNOMON_T(moments4) b, Real z_f)
{
    return certified4_lower(
        hankel4_stored_as_half(b, GNOMON_LITERAL(certified4_half_weight)), b,
        moments4_rounding(b, GNOMON_LITERAL(certified4_half_noise), GNOMON_LITERAL(certified4_half_least_noise)), z_f);
}

/// The same after a filter of two passes.
GNOMON_KERNEL Real certified4_half_filtered(GNOMON_T(moments4) b, Real z_f)
{
    return certified4_lower(hankel4_stored_as_half(b, GNOMON_LITERAL(certified4_half_filtered_weight)), b,
                            moments4_rounding_filtered(b, GNOMON_LITERAL(certified4_half_filtered_noise),
                                                       GNOMON_LITERAL(certified4_half_least_noise)),
                            z_f);
}

/// Intensity at z_f from moments stored as floats, off by at most noise, by nodes with a bias of weight alpha.
GNOMON_KERNEL Real certified4_float_with_noise(GNOMON_T(moments4) b, GNOMON_T(moments4) noise, GNOMON_SETTING alpha,
                                               Real z_f)
{
    return certified4_constant_bias_lower(hankel4_stored_as_float(b, alpha), noise, GNOMON_LITERAL(bias4_raw_b2),
                                          GNOMON_LITERAL(bias4_raw_b4), alpha, z_f);
}

/// Intensity at z_f from moments stored as floats.
GNOMON_KERNEL Real certified4_float(GNOMON_T(moments4) b, Real z_f)
{
    return certified4_float_with_noise(b, moments4_rounding(b, GNOMON_LITERAL(certified4_float_noise), Real(0)),
                                       GNOMON_LITERAL(certified4_float_weight), z_f);
}

/// The same after a filter of two passes.
GNOMON_KERNEL Real certified4_float_filtered(GNOMON_T(moments4) b, Real z_f)
{
    return certified4_float_with_noise(
        b, moments4_rounding_filtered(b, GNOMON_LITERAL(certified4_float_filtered_noise), Real(0)),
        GNOMON_LITERAL(certified4_float_filtered_weight), z_f);
}

GNOMON_NAMESPACE_END
#endif
