// Exponential shadow maps in a storage format: from a depth to the channel of a texel, and from a filtered channel to a
// shadow, with the exponent of the format.
//
//   format      bytes   channel       write                      read
//   1 x float     4     exp(40 z)     exponential_float_encode   exponential_float_intensity
//
// A lit surface is darkened by rounding alone: 84 roundings of exp(40 z), two of the filter passes and their sums.
#ifndef GNOMON_STORAGE_EXPONENTIAL_H
#define GNOMON_STORAGE_EXPONENTIAL_H
#include "../filters/exponential.h"
#include "../moments/channels.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(exponential_float_exponent, 40.0); // exp(2 c) < 2^127
GNOMON_CONSTANT(exponential_float_darkening, 6e-6);

/// The channel of a 1 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_encode.
GNOMON_KERNEL GNOMON_T(channels1) exponential_float_encode(Real z)
{
    GNOMON_T(exponential_settings) settings;
    settings.exponent = GNOMON_LITERAL(exponential_float_exponent);
    exponential_moment b = exponential_encode(z, settings);
    GNOMON_T(channels1) c;
    c.c1 = b.warped;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channel of a 1 x float texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as exponential_intensity.
GNOMON_KERNEL Real exponential_float_intensity(GNOMON_T(channels1) c, Real z_f)
{
    GNOMON_T(exponential_settings) settings;
    settings.exponent = GNOMON_LITERAL(exponential_float_exponent);
    GNOMON_T(exponential_moment) b;
    b.warped = c.c1;
    return exponential_intensity(b, z_f, settings);
}

GNOMON_NAMESPACE_END
#endif
