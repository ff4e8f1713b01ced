// Gnomon 0.1.0, exponential_variance.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_EXPONENTIAL_VARIANCE_METAL
#define GNOMON_EXPONENTIAL_VARIANCE_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: exponential_variance.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: exponential_variance.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: exponential_variance.metal is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

namespace gnomon {

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

namespace gnomon {

constant constexpr float exp_log2_e = 1.4426950408889634f;
constant constexpr float exp_ln2_low = -2.1219444005469058e-4f;
constant constexpr float exp_sqrt_2 = 1.4142135623730951f;
constant constexpr float exp_sqrt_half = 0.70710678118654752f;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
constant constexpr float exp_float_0 = 0.49999993561656014f;
constant constexpr float exp_float_1 = 0.16666518908321371f;
constant constexpr float exp_float_2 = 0.041668318723256166f;
constant constexpr float exp_float_3 = 0.0083689258101569408f;
constant constexpr float exp_float_4 = 0.00138210541669496f;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
constant constexpr float log_float_0 = 0.66666776085218282f;
constant constexpr float log_float_1 = 0.39977574040563962f;
constant constexpr float log_float_2 = 0.29870936689734456f;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
inline float exp_remainder(float r)
{
    float p = exp_float_0 + r * (exp_float_1 + r * (exp_float_2 + r * (exp_float_3 + r * exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
inline float polynomial_exp(float x)
{
    float low = -87.0f;
    float high = 88.0f;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375f) - n * exp_ln2_low;
    return (1.0f + (r + r * r * exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
inline scaled_number scaled_number_step(scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    scaled_number r;
    r.significand = gnomon_select(large, s.significand * down, gnomon_select(tiny, s.significand * up, s.significand));
    r.exponent = gnomon_select(large, s.exponent + k, gnomon_select(tiny, s.exponent - k, s.exponent));
    return r;
}

/// The natural logarithm of x.
/// Domain: [2^-126, 2^127] in float, [2^-1022, 2^1023] in double; x is clamped, so that 0 and negative numbers give the
/// value at the lower end.
/// NaN: stays NaN.
/// Error: 0.9 ulp in float and in double.
/// Source: Cody & Waite 1980
inline float polynomial_log(float x)
{
    scaled_number s;
    s.exponent = 0.0f;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0f), gnomon_power_of_two(127.0f));
    s = scaled_number_step(s, 64.0f);
    s = scaled_number_step(s, 32.0f);
    s = scaled_number_step(s, 16.0f);
    s = scaled_number_step(s, 8.0f);
    s = scaled_number_step(s, 4.0f);
    s = scaled_number_step(s, 2.0f);
    s = scaled_number_step(s, 1.0f);
    bool large = exp_sqrt_2 < s.significand;
    bool tiny = s.significand < exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5f, gnomon_select(tiny, s.significand * 2.0f, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0f, gnomon_select(tiny, s.exponent - 1.0f, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0f;
    float y = f / (2.0f + f);
    float z = y * y;
    float p = log_float_0 + z * (log_float_1 + z * log_float_2);
    float square = 0.5f * f * f;
    float rest = y * (square + z * p) + n * exp_ln2_low;
    return n * 0.693359375f - ((square - rest) - f);
}

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

// filters/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.
#ifndef GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H
#define GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H

namespace gnomon {

/// First and second moment of either warped depth.
struct exponential_variance_moments { float positive, positive_square, negative, negative_square; };

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
struct exponential_variance_settings { float positive_exponent, negative_exponent, minimum_variance; };

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
inline exponential_variance_moments exponential_variance_warp(float z, exponential_variance_settings settings)
{
    exponential_variance_moments r;
    r.positive = polynomial_exp(settings.positive_exponent * z);
    r.positive_square = r.positive * r.positive;
    r.negative = -polynomial_exp(-settings.negative_exponent * z);
    r.negative_square = r.negative * r.negative;
    return r;
}

/// The warped moments of one depth z of the map.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of each value, relative, (2 c + 4) 2^-p.
inline exponential_variance_moments exponential_variance_encode(float z, exponential_variance_settings settings)
{
    return exponential_variance_warp(clamp_or_high(z, -1.0f, 1.0f), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
inline float exponential_variance_side(variance_moments moments, float warped, float exponent, float minimum_variance)
{
    float scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < 1.0f, 1125899906842624.0f,
                                1.0f);
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    float slope = exponent * (warped * scale);
    return cantelli_lower(moments, warped * scale, minimum_variance * (slope * slope));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f, limited to [-1, 1]; exponents of at least 0, minimum_variance as of cantelli_lower. An exponent of
/// 0, or one so large that squares overflow, takes the bound of its own warp away. A negative one turns the order of
/// depths around.
/// NaN: a NaN receiver gives 0, lit; a NaN moment or exponent takes the bound of its own warp away, which leaves the
/// other's.
/// Error: that of cantelli_lower for the warped depths, with r = (2 c + 8) 2^-p, the larger of both.
/// Source: Lauritzen & McCool 2008; Peters 2017, Sec. 2.2
inline float exponential_variance_intensity(exponential_variance_moments filtered, float z_f,
                                            exponential_variance_settings settings)
{
    variance_moments positive;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    variance_moments negative;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    exponential_variance_moments receiver = exponential_variance_warp(clamp_or_nan(z_f, -1.0f, 1.0f), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
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

// storage/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered
// channels to a shadow, with the exponents and the minimum variance of the format.
//
//   format      bytes   exponents   write                              read
//   4 x half      8     5.54 5.54   exponential_variance_half_encode    exponential_variance_half_intensity
//   4 x float    16     40   5.54   exponential_variance_float_encode   exponential_variance_float_intensity
//
// The exponents are those of Peters et al. 2017, Figure 4. The channels are the four members of
// exponential_variance_moments, in their order. The minimum variance is 99 e^2, as in storage/variance.h, with e three
// roundings of a depth: a relative rounding of r in a warped value moves the depth by r / c. To 4 x float the rounding
// of the depth, a float too, is added.
#ifndef GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H
#define GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H

namespace gnomon {

// both; exp(2 c) fills a half
constant constexpr float exponential_variance_half_exponent = 5.54f;
constant constexpr float exponential_variance_half_minimum_variance = 6.921468870293247e-6f; // 99 (3 2^-11 / 5.54)^2
constant constexpr float exponential_variance_half_darkening = 0.01f;
constant constexpr float exponential_variance_float_positive_exponent = 40.0f;
constant constexpr float exponential_variance_float_negative_exponent = 5.54f;
// 99 (3 2^-24 (1 + 1 / 5.54))^2
constant constexpr float exponential_variance_float_minimum_variance = 4.41137400169126e-12f;
constant constexpr float exponential_variance_float_darkening = 0.01f;

/// The channels of the filter with the given settings for a depth z.
inline channels4 exponential_variance_to_channels(float z, exponential_variance_settings settings)
{
    exponential_variance_moments b = exponential_variance_encode(z, settings);
    channels4 c;
    c.c1 = b.positive;
    c.c2 = b.positive_square;
    c.c3 = b.negative;
    c.c4 = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
inline float exponential_variance_of_channels(channels4 c, float z_f, exponential_variance_settings settings)
{
    exponential_variance_moments b;
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
inline channels4 exponential_variance_half_encode(float z)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
inline float exponential_variance_half_intensity(channels4 c, float z_f)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
inline channels4 exponential_variance_float_encode(float z)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
inline float exponential_variance_float_intensity(channels4 c, float z_f)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return exponential_variance_of_channels(c, z_f, settings);
}

} // namespace gnomon

#endif

#endif
