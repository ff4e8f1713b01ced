// Variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels to a
// shadow, each with the minimum variance that hides the roundings of its format.
//
//   format          bytes   channels                      write                     read
//   2 x 16 UNORM      4     (1 + mean) / 2, mean square   variance_unorm16_encode   variance_unorm16_intensity
//
// A minimum variance m lets an error e of the mean darken a lit surface by e^2 / (m + e^2) at most (Cantelli). It is
// chosen as 99 e^2, for 1%, where e is three roundings of a depth: when rendered, and by each of two filter passes.
#ifndef GNOMON_STORAGE_VARIANCE_H
#define GNOMON_STORAGE_VARIANCE_H
#include "../filters/variance.h"
#include "../moments/channels.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(variance_unorm16_minimum_variance, 2.0745843457628005e-7); // 99 (3 / 65535)^2
GNOMON_CONSTANT(variance_unorm16_darkening, 0.01);

/// The two channels of a 2 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(channels2) variance_unorm16_encode(Real z)
{
    variance_moments b = variance_encode(z);
    GNOMON_T(channels2) c;
    c.c1 = Real(0.5) * b.mean + Real(0.5);
    c.c2 = b.square;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 2 x 16 UNORM texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as variance_intensity, for the given channels.
GNOMON_KERNEL Real variance_unorm16_intensity(GNOMON_T(channels2) c, Real z_f)
{
    GNOMON_T(variance_moments) b;
    b.mean = Real(2) * c.c1 - Real(1);
    b.square = c.c2;
    GNOMON_T(variance_settings) settings;
    settings.minimum_variance = GNOMON_LITERAL(variance_unorm16_minimum_variance);
    return variance_intensity(b, z_f, settings);
}

GNOMON_NAMESPACE_END
#endif
