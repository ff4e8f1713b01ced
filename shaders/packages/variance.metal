// Gnomon 0.1.0, variance.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_VARIANCE_METAL
#define GNOMON_VARIANCE_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: variance.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: variance.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: variance.metal is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#if defined(__FAST_MATH__)
#error "gnomon: fast mathematics voids the treatment of NaN: compile with -fno-fast-math, or mathMode = .safe"
#endif

#include <metal_stdlib>

#if __METAL_VERSION__ >= 320 // to the end of the file
#pragma METAL fp math_mode(safe)
#endif

namespace gnomon {

constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
inline float gnomon_abs(float a) { return metal::fabs(a); }
inline float gnomon_sqrt(float a) { return metal::precise::sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
inline float gnomon_kept(float x) { return as_type<float>(metal::min(as_type<int>(x), 0x7FC00000)); }
inline float gnomon_apart(float x) { return as_type<float>(metal::min(as_type<uint>(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(metal::fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
inline float gnomon_saturate(float x)
{
    int bits = as_type<int>(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_type<float>(metal::min(metal::max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
inline float gnomon_high_part(float a) { return as_type<float>(as_type<uint>(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
inline float gnomon_power_of_two(float n) { return as_type<float>((as_type<uint>(n + 12582912.0f) << 23) + 0x3F800000u); }

} // namespace gnomon

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

namespace gnomon {

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

} // namespace gnomon

#endif

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H

namespace gnomon {

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { float mean, square; };

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { float minimum_variance; };

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
inline variance_moments variance_encode(float z)
{
    variance_moments r;
    r.mean = clamp_or_high(z, -1.0f, 1.0f);
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
inline float cantelli_lower(variance_moments moments, float receiver, float minimum_variance)
{
    float variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    float d = gnomon_max(0.0f, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
inline float variance_intensity(variance_moments filtered, float z_f, variance_settings settings)
{
    return cantelli_lower(filtered, gnomon_min(1.0f, z_f), settings.minimum_variance);
}

} // namespace gnomon

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

namespace gnomon {

struct channels1 { float c1; };

struct channels2 { float c1, c2; };

struct channels5 { float c1, c2, c3, c4, c5; };

} // namespace gnomon

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

namespace gnomon {

struct channels4 { float c1, c2, c3, c4; };

} // namespace gnomon

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

namespace gnomon {

struct channels6 { float c1, c2, c3, c4, c5, c6; };

} // namespace gnomon

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

namespace gnomon {

constant constexpr float variance_unorm16_minimum_variance = 2.0745843457628005e-7f; // 99 (3 / 65535)^2
constant constexpr float variance_unorm16_darkening = 0.01f;

/// The two channels of a 2 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
inline channels2 variance_unorm16_encode(float z)
{
    variance_moments b = variance_encode(z);
    channels2 c;
    c.c1 = 0.5f * b.mean + 0.5f;
    c.c2 = b.square;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 2 x 16 UNORM texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as variance_intensity, for the given channels.
inline float variance_unorm16_intensity(channels2 c, float z_f)
{
    variance_moments b;
    b.mean = 2.0f * c.c1 - 1.0f;
    b.square = c.c2;
    variance_settings settings;
    settings.minimum_variance = variance_unorm16_minimum_variance;
    return variance_intensity(b, z_f, settings);
}

} // namespace gnomon

#endif

#endif
