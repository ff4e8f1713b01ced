// Gnomon 0.1.0, layered_variance.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYERED_VARIANCE_GLSL
#define GNOMON_LAYERED_VARIANCE_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: layered_variance.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layered_variance.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layered_variance.glsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 300
#error "gnomon: #version 300 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 330
#error "gnomon: #version 330 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return intBitsToFloat(min(floatBitsToInt(x), 0x7FC00000)); }
float gnomon_apart(float x) { return uintBitsToFloat(min(floatBitsToUint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = floatBitsToInt(x);
    return gnomon_select(bits > 0x7F800000, 0.0, intBitsToFloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return uintBitsToFloat(floatBitsToUint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return uintBitsToFloat((floatBitsToUint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { float mean, square; };

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { float minimum_variance; };

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
variance_moments variance_encode(float z)
{
    variance_moments r;
    r.mean = clamp_or_high(z, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
float cantelli_lower(variance_moments moments, float receiver, float minimum_variance)
{
    float variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    float d = gnomon_max(0.0, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
float variance_intensity(variance_moments filtered, float z_f, variance_settings settings)
{
    return cantelli_lower(filtered, gnomon_min(1.0, z_f), settings.minimum_variance);
}

#endif

// filters/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps (Lauritzen & McCool 2008, "Layered variance shadow maps", section 3): depth is cut into
// layers, and each has a variance shadow map of the depth clamped to it and stretched to [-1, 1]. Clamping keeps the
// order of depths, so that every layer bounds the shadow intensity from below, and the largest bound holds. Depths in
// front of a layer are clamped to its front: only occluders and receivers that share a layer leak light.
//
//     state = layered_variance_begin(z_f);
//     state = layered_variance_add(state, filtered, settings);      for every layer, or just for the receiver's own
//     intensity = layered_variance_end(state);
#ifndef GNOMON_FILTERS_LAYERED_VARIANCE_H
#define GNOMON_FILTERS_LAYERED_VARIANCE_H

/// A layer holds depths within 1 / scale of its centre; the minimum variance is that of the stretched depth.
struct layered_variance_settings { float centre, scale, minimum_variance; };

/// The layer's own depth of a depth z, in [-1, 1].
/// Domain: any z; scale at least 0. For 0 the layer tells no depths apart; an infinite scale is a shadow test at the
/// centre. A negative scale turns the order of depths around.
/// NaN: NaN.
float layered_variance_depth(float z, layered_variance_settings settings)
{
    return clamp_or_nan((z - settings.centre) * settings.scale, -1.0, 1.0);
}

/// The layer's moments of one depth z.
/// Domain: any z.
/// NaN: the far end of the layer, which shadows nothing.
variance_moments layered_variance_encode(float z, layered_variance_settings settings)
{
    // Clamp once, not by layered_variance_depth and then by variance_encode: clang 14 drops the second clamp, and a
    // NaN would stay a NaN.
    variance_moments r;
    r.mean = clamp_or_high((z - settings.centre) * settings.scale, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// The receiver's depth, and the largest bound so far.
struct layered_variance { float receiver, intensity; };

/// The state before the first layer.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: lit.
layered_variance layered_variance_begin(float z_f)
{
    layered_variance r;
    r.receiver = gnomon_min(1.0, z_f);
    r.intensity = 0.0;
    return r;
}

/// The state after one more layer with its filtered moments.
/// NaN: a layer with a NaN moment, centre or scale bounds nothing.
layered_variance layered_variance_add(layered_variance state, variance_moments filtered,
                                      layered_variance_settings settings)
{
    float receiver = layered_variance_depth(state.receiver, settings);
    state.intensity = gnomon_max(state.intensity, cantelli_lower(filtered, receiver, settings.minimum_variance));
    return state;
}

/// Shadow intensity in [0, 1], never above percentage-closer filtering but for rounding.
/// NaN: 0, lit.
/// Error: that of cantelli_lower for the layers' own depths, with r = 8 2^-p, the largest of all.
/// Source: Lauritzen & McCool 2008, Sec. 3
float layered_variance_end(layered_variance state) { return saturate_or_zero(state.intensity); }

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

struct channels1 { float c1; };

struct channels2 { float c1, c2; };

struct channels5 { float c1, c2, c3, c4, c5; };

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

struct channels4 { float c1, c2, c3, c4; };

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

struct channels6 { float c1, c2, c3, c4, c5, c6; };

#endif

// storage/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels
// to a shadow. Four layers divide [-1, 1] evenly.
//
//   format          bytes   channels of a layer           write                             read
//   8 x 16 UNORM     16     (1 + mean) / 2, mean square   layered_variance_unorm16_encode  
// layered_variance_unorm16_intensity
//
// Where a surface passes from one layer to the next, mean and mean square are both near 1. Their roundings, three of
// half a code each, then hide a variance of up to 3 (1/2 + 2) / 65535: half a code of the square, twice one code of the
// mean.
#ifndef GNOMON_STORAGE_LAYERED_VARIANCE_H
#define GNOMON_STORAGE_LAYERED_VARIANCE_H

/// Two textures of four channels.
struct channels8 { channels4 t1, t2; };

const float gnomon_layered_variance_unorm16_minimum_variance = 0.00011444266422522316;
const float layered_variance_unorm16_darkening = 2e-5;

/// The settings of the layer around centre: -0.75, -0.25, 0.25 or 0.75.
layered_variance_settings gnomon_layered_variance_unorm16_layer(float centre)
{
    layered_variance_settings settings;
    settings.centre = centre;
    settings.scale = 4.0;
    settings.minimum_variance = gnomon_layered_variance_unorm16_minimum_variance;
    return settings;
}

/// The channels of the two layers around near_centre and far_centre for a depth z.
channels4 gnomon_layered_variance_unorm16_encode_two(float z, float near_centre, float far_centre)
{
    variance_moments first = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(near_centre));
    variance_moments second = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(far_centre));
    channels4 c;
    c.c1 = 0.5 * first.mean + 0.5;
    c.c2 = first.square;
    c.c3 = 0.5 * second.mean + 0.5;
    c.c4 = second.square;
    return c;
}

/// The eight channels of an 8 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels8 layered_variance_unorm16_encode(float z)
{
    channels8 c;
    c.t1 = gnomon_layered_variance_unorm16_encode_two(z, -0.75, -0.25);
    c.t2 = gnomon_layered_variance_unorm16_encode_two(z, 0.25, 0.75);
    return c;
}

/// The state after the layer around centre, whose channels are mean and square.
layered_variance gnomon_layered_variance_unorm16_add(layered_variance state, float mean, float square, float centre)
{
    variance_moments b;
    b.mean = 2.0 * mean - 1.0;
    b.square = square;
    return layered_variance_add(state, b, gnomon_layered_variance_unorm16_layer(centre));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of an 8 x 16 UNORM texel.
/// Domain: any z_f; beyond a plane as on it.
/// NaN: 0, lit.
/// Error: as layered_variance_end, for the given channels.
float layered_variance_unorm16_intensity(channels8 c, float z_f)
{
    layered_variance state = layered_variance_begin(z_f);
    state = gnomon_layered_variance_unorm16_add(state, c.t1.c1, c.t1.c2, -0.75);
    state = gnomon_layered_variance_unorm16_add(state, c.t1.c3, c.t1.c4, -0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2.c1, c.t2.c2, 0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2.c3, c.t2.c4, 0.75);
    return layered_variance_end(state);
}

#endif

#endif
