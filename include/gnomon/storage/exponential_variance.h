// Exponential variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered
// channels to a shadow, with the exponents and the minimum variance of the format.
//
//   format      bytes   exponents   write                              read
//   4 x half      8     5.54 5.54   exponential_variance_half_encode    exponential_variance_half_intensity
//   4 x float    16     40   5.54   exponential_variance_float_encode   exponential_variance_float_intensity
//
// The exponents are those of Peters et al. 2017, Figure 4. The channels are the four members of
// exponential_variance_moments, in their order. The minimum variance is 99 e^2, as in storage/variance.h, with e three
// roundings of a depth: a relative rounding of r in a warped value moves the depth by r / c. To 4 x float the rounding of
// the depth, a float too, is added.
#ifndef GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H
#define GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H
#include "../filters/exponential_variance.h"
#include "../moments/channels.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(exponential_variance_half_exponent, 5.54);                         // both; exp(2 c) fills a half
GNOMON_CONSTANT(exponential_variance_half_minimum_variance, 6.921468870293247e-6); // 99 (3 2^-11 / 5.54)^2
GNOMON_CONSTANT(exponential_variance_half_darkening, 0.01);
GNOMON_CONSTANT(exponential_variance_float_positive_exponent, 40.0);
GNOMON_CONSTANT(exponential_variance_float_negative_exponent, 5.54);
GNOMON_CONSTANT(exponential_variance_float_minimum_variance, 4.41137400169126e-12); // 99 (3 2^-24 (1 + 1 / 5.54))^2
GNOMON_CONSTANT(exponential_variance_float_darkening, 0.01);

/// The channels of the filter with the given settings for a depth z.
GNOMON_DETAIL_KERNEL GNOMON_T(channels4) exponential_variance_to_channels(
    Real z, GNOMON_T(exponential_variance_settings) settings)
{
    exponential_variance_moments b = exponential_variance_encode(z, settings);
    GNOMON_T(channels4) c;
    c.c1 = b.positive;
    c.c2 = b.positive_square;
    c.c3 = b.negative;
    c.c4 = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
GNOMON_DETAIL_KERNEL Real exponential_variance_of_channels(GNOMON_T(channels4) c, Real z_f,
                                                           GNOMON_T(exponential_variance_settings) settings)
{
    GNOMON_T(exponential_variance_moments) b;
    b.positive = c.c1;
    b.positive_square = c.c2;
    b.negative = c.c3;
    b.negative_square = c.c4;
    return exponential_variance_intensity(b, z_f, settings);
}

/// The four channels of a 4 x half texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
GNOMON_KERNEL GNOMON_T(channels4) exponential_variance_half_encode(Real z)
{
    GNOMON_T(exponential_variance_settings) settings;
    settings.positive_exponent = GNOMON_LITERAL(exponential_variance_half_exponent);
    settings.negative_exponent = GNOMON_LITERAL(exponential_variance_half_exponent);
    settings.minimum_variance = GNOMON_LITERAL(exponential_variance_half_minimum_variance);
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
GNOMON_KERNEL Real exponential_variance_half_intensity(GNOMON_T(channels4) c, Real z_f)
{
    GNOMON_T(exponential_variance_settings) settings;
    settings.positive_exponent = GNOMON_LITERAL(exponential_variance_half_exponent);
    settings.negative_exponent = GNOMON_LITERAL(exponential_variance_half_exponent);
    settings.minimum_variance = GNOMON_LITERAL(exponential_variance_half_minimum_variance);
    return exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
GNOMON_KERNEL GNOMON_T(channels4) exponential_variance_float_encode(Real z)
{
    GNOMON_T(exponential_variance_settings) settings;
    settings.positive_exponent = GNOMON_LITERAL(exponential_variance_float_positive_exponent);
    settings.negative_exponent = GNOMON_LITERAL(exponential_variance_float_negative_exponent);
    settings.minimum_variance = GNOMON_LITERAL(exponential_variance_float_minimum_variance);
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
GNOMON_KERNEL Real exponential_variance_float_intensity(GNOMON_T(channels4) c, Real z_f)
{
    GNOMON_T(exponential_variance_settings) settings;
    settings.positive_exponent = GNOMON_LITERAL(exponential_variance_float_positive_exponent);
    settings.negative_exponent = GNOMON_LITERAL(exponential_variance_float_negative_exponent);
    settings.minimum_variance = GNOMON_LITERAL(exponential_variance_float_minimum_variance);
    return exponential_variance_of_channels(c, z_f, settings);
}

GNOMON_NAMESPACE_END
#endif
