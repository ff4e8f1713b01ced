// Convolution shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels to a
// shadow, with the settings of the format.
//
//   format         bytes   channels                            write                       read
//   32 x 8 UNORM    32     (1 + value) / 2: 16 cosines, sines  convolution_unorm8_encode   convolution_unorm8_intensity
//
// A texel is eight textures of four channels (Klehm, Seidel & Eisemann 2014): cosine and sine of term 1, then of term 2,
// and so on. The series is neither damped nor sharpened. Its span leaves a 16th of the half period free, and its offset
// is that of convolution_settings. A lit surface is darkened by the ripple of 16 terms and by rounding to 8 bits.
#ifndef GNOMON_STORAGE_CONVOLUTION_H
#define GNOMON_STORAGE_CONVOLUTION_H
#include "../filters/convolution.h"
#include "../moments/channels.h"
GNOMON_NAMESPACE_BEGIN

/// Eight textures of four channels.
GNOMON_STRUCT(channels32) { GNOMON_T(channels4) t1, t2, t3, t4, t5, t6, t7, t8; };

GNOMON_CONSTANT(convolution_unorm8_offset, 0.04088048903297681); // 1.92644766 / (pi terms span)
GNOMON_CONSTANT(convolution_unorm8_darkening, 0.055);
GNOMON_CONSTANT(convolution_unorm8_weight1, 0.6366197723675814);
GNOMON_CONSTANT(convolution_unorm8_weight2, 0.2122065907891938);
GNOMON_CONSTANT(convolution_unorm8_weight3, 0.12732395447351627);
GNOMON_CONSTANT(convolution_unorm8_weight4, 0.09094568176679733);
GNOMON_CONSTANT(convolution_unorm8_weight5, 0.0707355302630646);
GNOMON_CONSTANT(convolution_unorm8_weight6, 0.05787452476068922);
GNOMON_CONSTANT(convolution_unorm8_weight7, 0.04897075172058318);
GNOMON_CONSTANT(convolution_unorm8_weight8, 0.04244131815783876);
GNOMON_CONSTANT(convolution_unorm8_weight9, 0.03744822190397538);
GNOMON_CONSTANT(convolution_unorm8_weight10, 0.033506303808820075);
GNOMON_CONSTANT(convolution_unorm8_weight11, 0.030315227255599115);
GNOMON_CONSTANT(convolution_unorm8_weight12, 0.02767912053772093);
GNOMON_CONSTANT(convolution_unorm8_weight13, 0.025464790894703257);
GNOMON_CONSTANT(convolution_unorm8_weight14, 0.0235785100876882);
GNOMON_CONSTANT(convolution_unorm8_weight15, 0.021952405943709702);
GNOMON_CONSTANT(convolution_unorm8_weight16, 0.020536121689276817);

/// The channels of the term at phase and of the next term.
GNOMON_DETAIL_KERNEL GNOMON_T(channels4) convolution_unorm8_encode_two(GNOMON_T(convolution_phase) phase)
{
    convolution_phase next = convolution_next(phase);
    GNOMON_T(channels4) c;
    c.c1 = Real(0.5) * phase.cosine + Real(0.5);
    c.c2 = Real(0.5) * phase.sine + Real(0.5);
    c.c3 = Real(0.5) * next.cosine + Real(0.5);
    c.c4 = Real(0.5) * next.sine + Real(0.5);
    return c;
}

/// The phase two terms on.
GNOMON_DETAIL_KERNEL GNOMON_T(convolution_phase) convolution_unorm8_next_two(GNOMON_T(convolution_phase) phase)
{
    return convolution_next(convolution_next(phase));
}

/// The 32 channels of a 32 x 8 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as convolution_next.
/// Source: Annen 2007, Sec. 3
GNOMON_KERNEL GNOMON_T(channels32) convolution_unorm8_encode(Real z)
{
    GNOMON_T(convolution_settings) settings;
    settings.terms = Real(16);
    settings.damping = Real(0);
    settings.offset = GNOMON_LITERAL(convolution_unorm8_offset);
    settings.span = Real(0.9375);
    convolution_phase phase = convolution_encode(z, settings);
    GNOMON_T(channels32) c;
    c.t1 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t2 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t3 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t4 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t5 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t6 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t7 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t8 = convolution_unorm8_encode_two(phase);
    return c;
}

/// The sum after two terms with their channels and weights.
GNOMON_DETAIL_KERNEL GNOMON_T(convolution_sum) convolution_unorm8_add_two(GNOMON_T(convolution_sum) state,
                                                                          GNOMON_T(channels4) c, GNOMON_SETTING weight,
                                                                          GNOMON_SETTING next_weight)
{
    state = convolution_add(state, Real(2) * c.c1 - Real(1), Real(2) * c.c2 - Real(1), weight);
    return convolution_add(state, Real(2) * c.c3 - Real(1), Real(2) * c.c4 - Real(1), next_weight);
}

/// The series at depth z_f, with an offset, from the channels of a 32 x 8 UNORM texel.
GNOMON_DETAIL_KERNEL Real convolution_unorm8_series(GNOMON_T(channels32) c, Real z_f, Real offset)
{
    GNOMON_T(convolution_settings) settings;
    settings.terms = Real(16);
    settings.damping = Real(0);
    settings.offset = offset;
    settings.span = Real(0.9375);
    convolution_sum state = convolution_begin(z_f, settings);
    state = convolution_unorm8_add_two(state, c.t1, GNOMON_LITERAL(convolution_unorm8_weight1),
                                       GNOMON_LITERAL(convolution_unorm8_weight2));
    state = convolution_unorm8_add_two(state, c.t2, GNOMON_LITERAL(convolution_unorm8_weight3),
                                       GNOMON_LITERAL(convolution_unorm8_weight4));
    state = convolution_unorm8_add_two(state, c.t3, GNOMON_LITERAL(convolution_unorm8_weight5),
                                       GNOMON_LITERAL(convolution_unorm8_weight6));
    state = convolution_unorm8_add_two(state, c.t4, GNOMON_LITERAL(convolution_unorm8_weight7),
                                       GNOMON_LITERAL(convolution_unorm8_weight8));
    state = convolution_unorm8_add_two(state, c.t5, GNOMON_LITERAL(convolution_unorm8_weight9),
                                       GNOMON_LITERAL(convolution_unorm8_weight10));
    state = convolution_unorm8_add_two(state, c.t6, GNOMON_LITERAL(convolution_unorm8_weight11),
                                       GNOMON_LITERAL(convolution_unorm8_weight12));
    state = convolution_unorm8_add_two(state, c.t7, GNOMON_LITERAL(convolution_unorm8_weight13),
                                       GNOMON_LITERAL(convolution_unorm8_weight14));
    state = convolution_unorm8_add_two(state, c.t8, GNOMON_LITERAL(convolution_unorm8_weight15),
                                       GNOMON_LITERAL(convolution_unorm8_weight16));
    return convolution_end(state);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 32 x 8 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
GNOMON_KERNEL Real convolution_unorm8_intensity(GNOMON_T(channels32) c, Real z_f)
{
    return convolution_unorm8_series(c, z_f, GNOMON_LITERAL(convolution_unorm8_offset));
}

/// Shadow intensity in [0, 1] as convolution_unorm8_intensity, but with the edge of the wave at z_f itself, where the
/// intensity is 1/2: for receivers in air, as of single scattering, which are in no map.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
/// Source: Peters 2017, Sec. 5.5.1
GNOMON_KERNEL Real convolution_unorm8_centred_intensity(GNOMON_T(channels32) c, Real z_f)
{
    return convolution_unorm8_series(c, z_f, Real(0));
}

GNOMON_NAMESPACE_END
#endif
