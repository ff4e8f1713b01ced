// Gnomon 0.1.0, variance.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_VARIANCE_HLSL
#define GNOMON_VARIANCE_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: variance.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: variance.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: variance.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
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
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

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

// storage/variance.h --------------------------------------------------------------------------------------------------
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

static const float variance_unorm16_minimum_variance = 2.0745843457628005e-7; // 99 (3 / 65535)^2
static const float variance_unorm16_darkening = 0.01;

/// The two channels of a 2 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels2 variance_unorm16_encode(float z)
{
    variance_moments b = variance_encode(z);
    channels2 c;
    c.c1 = 0.5 * b.mean + 0.5;
    c.c2 = b.square;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 2 x 16 UNORM texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as variance_intensity, for the given channels.
float variance_unorm16_intensity(channels2 c, float z_f)
{
    variance_moments b;
    b.mean = 2.0 * c.c1 - 1.0;
    b.square = c.c2;
    variance_settings settings;
    settings.minimum_variance = variance_unorm16_minimum_variance;
    return variance_intensity(b, z_f, settings);
}

#endif

#endif
