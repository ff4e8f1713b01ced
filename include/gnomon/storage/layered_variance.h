// Layered variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels
// to a shadow. Four layers divide [-1, 1] evenly.
//
//   format          bytes   channels of a layer           write                             read
//   8 x 16 UNORM     16     (1 + mean) / 2, mean square   layered_variance_unorm16_encode   layered_variance_unorm16_intensity
//
// Where a surface passes from one layer to the next, mean and mean square are both near 1. Their roundings, three of half
// a code each, then hide a variance of up to 3 (1/2 + 2) / 65535: half a code of the square, twice one code of the mean.
#ifndef GNOMON_STORAGE_LAYERED_VARIANCE_H
#define GNOMON_STORAGE_LAYERED_VARIANCE_H
#include "../filters/layered_variance.h"
#include "../moments/channels.h"
GNOMON_NAMESPACE_BEGIN

/// Two textures of four channels.
GNOMON_STRUCT(channels8) { GNOMON_T(channels4) t1, t2; };

GNOMON_CONSTANT(layered_variance_unorm16_minimum_variance, 0.00011444266422522316);
GNOMON_CONSTANT(layered_variance_unorm16_darkening, 2e-5);

/// The settings of the layer around centre: -0.75, -0.25, 0.25 or 0.75.
GNOMON_DETAIL_KERNEL GNOMON_T(layered_variance_settings) layered_variance_unorm16_layer(Real centre)
{
    GNOMON_T(layered_variance_settings) settings;
    settings.centre = centre;
    settings.scale = Real(4);
    settings.minimum_variance = GNOMON_LITERAL(layered_variance_unorm16_minimum_variance);
    return settings;
}

/// The channels of the two layers around near_centre and far_centre for a depth z.
GNOMON_DETAIL_KERNEL GNOMON_T(channels4) layered_variance_unorm16_encode_two(Real z, Real near_centre, Real far_centre)
{
    variance_moments first = layered_variance_encode(z, layered_variance_unorm16_layer(near_centre));
    variance_moments second = layered_variance_encode(z, layered_variance_unorm16_layer(far_centre));
    GNOMON_T(channels4) c;
    c.c1 = Real(0.5) * first.mean + Real(0.5);
    c.c2 = first.square;
    c.c3 = Real(0.5) * second.mean + Real(0.5);
    c.c4 = second.square;
    return c;
}

/// The eight channels of an 8 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(channels8) layered_variance_unorm16_encode(Real z)
{
    GNOMON_T(channels8) c;
    c.t1 = layered_variance_unorm16_encode_two(z, Real(-0.75), Real(-0.25));
    c.t2 = layered_variance_unorm16_encode_two(z, Real(0.25), Real(0.75));
    return c;
}

/// The state after the layer around centre, whose channels are mean and square.
GNOMON_DETAIL_KERNEL GNOMON_T(layered_variance) layered_variance_unorm16_add(GNOMON_T(layered_variance) state,
                                                                             Real mean, Real square, Real centre)
{
    GNOMON_T(variance_moments) b;
    b.mean = Real(2) * mean - Real(1);
    b.square = square;
    return layered_variance_add(state, b, layered_variance_unorm16_layer(centre));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of an 8 x 16 UNORM texel.
/// Domain: any z_f; beyond a plane as on it.
/// NaN: 0, lit.
/// Error: as layered_variance_end, for the given channels.
GNOMON_KERNEL Real layered_variance_unorm16_intensity(GNOMON_T(channels8) c, Real z_f)
{
    layered_variance state = layered_variance_begin(z_f);
    state = layered_variance_unorm16_add(state, c.t1.c1, c.t1.c2, Real(-0.75));
    state = layered_variance_unorm16_add(state, c.t1.c3, c.t1.c4, Real(-0.25));
    state = layered_variance_unorm16_add(state, c.t2.c1, c.t2.c2, Real(0.25));
    state = layered_variance_unorm16_add(state, c.t2.c3, c.t2.c4, Real(0.75));
    return layered_variance_end(state);
}

GNOMON_NAMESPACE_END
#endif
