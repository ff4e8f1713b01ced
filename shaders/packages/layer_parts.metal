// Gnomon 0.1.0, layer_parts.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_PARTS_METAL
#define GNOMON_LAYER_PARTS_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: layer_parts.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_parts.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_parts.metal is not of the same version as a package before it"
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

// filters/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).
#ifndef GNOMON_FILTERS_EXPONENTIAL_H
#define GNOMON_FILTERS_EXPONENTIAL_H

namespace gnomon {

/// E[exp(c z)].
struct exponential_moment { float warped; };

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
struct exponential_settings { float exponent; };

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
inline exponential_moment exponential_encode(float z, exponential_settings settings)
{
    exponential_moment r;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, -1.0f, 1.0f));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in
/// float shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
inline float exponential_intensity(exponential_moment filtered, float z_f, exponential_settings settings)
{
    return saturate_or_zero(1.0f - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(1.0f, z_f)));
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

// moments/depth.h -----------------------------------------------------------------------------------------------------
// Signed depth from what depth buffers hold. Signed depth is -1 at the near plane, +1 at the far plane, and linear in
// the view distance: filters need the linearity, since they average depths. A perspective projection is not linear, so
// its buffer needs a conversion of its own.
//
//   buffer                                    near plane   far plane    conversion
//   view distance                             near         far          depth_from_distance
//   orthographic, or linear                   0            1            depth_from_unit
//   orthographic, or linear, reversed         1            0            depth_from_reversed
//   perspective                               0            1            depth_from_perspective
//   perspective, reversed                     1            0            depth_from_reversed_perspective
//   perspective, infinite far plane           0            (1)          depth_from_infinite
//   perspective, infinite, reversed           1            (0)          depth_from_reversed_infinite
//
// A buffer in [-1, 1], as in OpenGL, first becomes 0.5 z + 0.5.
#ifndef GNOMON_MOMENTS_DEPTH_H
#define GNOMON_MOMENTS_DEPTH_H

namespace gnomon {

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
inline float depth_from_unit(float z) { return z * 2.0f - 1.0f; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
inline float depth_from_reversed(float z) { return 1.0f - z * 2.0f; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
inline float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
inline float depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
inline float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return depth_between(near_distance * x, far_distance * (1.0f - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
inline float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return depth_between(near_distance * (1.0f - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
inline float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
{
    float x = gnomon_abs(clamp_or_nan(z, 0.0f, 1.0f)); // -0 is the far plane, too
    float depth = (near_distance * (1.0f - x) - (far_distance * x - near_distance)) /
                  (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0f, 1.0f);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
inline float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0f - z, near_distance, far_distance);
}

} // namespace gnomon

#endif

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_4
#define GNOMON_MOMENTS_MOMENTS_4

namespace gnomon {

struct moments4 { float b1, b2, b3, b4; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
inline moments4 moments4_from_depth(float z)
{
    moments4 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// b times weight: the first term of a linear combination.
inline moments4 moments4_scale(moments4 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
inline moments4 moments4_add(moments4 sum, moments4 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
inline moments4 moments4_from_unit(moments4 c)
{
    moments4 b;
    b.b1 = 2.0f * c.b1 - 1.0f;
    b.b2 = 4.0f * (c.b2 - c.b1) + 1.0f;
    b.b3 = (8.0f * c.b3 - 12.0f * c.b2) + (6.0f * c.b1 - 1.0f);
    b.b4 = 16.0f * (c.b4 - 2.0f * c.b3) + (24.0f * c.b2 - 8.0f * c.b1 + 1.0f);
    return b;
}

} // namespace gnomon

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

namespace gnomon {

struct moments6 { float b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
inline moments6 moments6_from_depth(float z)
{
    moments6 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    b.b5 = b.b4 * z;
    b.b6 = b.b3 * b.b3;
    return b;
}

/// b times weight: the first term of a linear combination.
inline moments6 moments6_scale(moments6 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    b.b5 = b.b5 * weight;
    b.b6 = b.b6 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
inline moments6 moments6_add(moments6 sum, moments6 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    sum.b5 = sum.b5 + b.b5 * weight;
    sum.b6 = sum.b6 + b.b6 * weight;
    return sum;
}

} // namespace gnomon

#endif

// moments/bias.h ------------------------------------------------------------------------------------------------------
// Biasing: rounding in storage can turn moments into numbers that belong to no distribution, so they are moved inwards
// (Peters et al. 2017, Sec. 2.5).
//
// Let storage move the stored vector b by e, at most delta in each channel, and let r be the distance in the maximum
// norm from b* to the boundary of the valid vectors. Interpolation by alpha gives
//     (1 - alpha) (b + e) + alpha b* = (1 - alpha) b + alpha (b* + e (1 - alpha) / alpha),
// whose last term is valid from alpha = delta / (delta + r) on. The result has the moments of the mixture (1 - alpha) Z
// + alpha Z', so intensities exceed Z(z < z_f) by at most alpha. n roundings need n delta. The weight alpha is
// therefore a property of the format and of the number of roundings, not a setting.
//
// The vectors b* below have the largest r and are computed by tests/derivations. Beside them stand the paper's vectors,
// which have the largest Euclidean distance. Odd entries are 0 by symmetry.
//
// A bias is applied in one of two ways:
//   interpolated    moments4_add_bias, then hankel4_from_moments, as in the paper: for UNORM and half floats
//   kept apart      hankel4_constant_bias, the same mixture with 100 times less rounding error: for floats
// Certificates (certified4.h) leak less than a constant bias and never darken a lit surface. A bias that depends on the
// moments leaks less still, but darkens lit surfaces by up to 0.79 (docs/decisions/2-bias.md).
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H

namespace gnomon {

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
inline float bias_weight_of_roundings(float w, float n)
{
    float nw = gnomon_max(1.0f, n) * w;
    return nw / ((1.0f - w) + nw);
}

} // namespace gnomon

#endif

// moments/bias.h, four moments ----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_4
#define GNOMON_MOMENTS_BIAS_4

namespace gnomon {

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
constant constexpr float bias4_raw_b2 = 0.41397147664677789f;
constant constexpr float bias4_raw_b4 = 0.41397147664677789f;
constant constexpr float bias4_raw_paper_b2 = 0.375f;
constant constexpr float bias4_raw_paper_b4 = 0.375f;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
constant constexpr float bias4_theta_b2 = 0.66391434671237689f;
constant constexpr float bias4_theta_b4 = 0.66391434671237689f;
constant constexpr float bias4_theta_paper_b2 = 0.628f;
constant constexpr float bias4_theta_paper_b4 = 0.628f;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
inline moments4 moments4_add_bias(moments4 b, float bias2, float bias4, float alpha)
{
    float keep = 1.0f - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    return b;
}

} // namespace gnomon

#endif

// moments/bias.h, six moments -----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_6
#define GNOMON_MOMENTS_BIAS_6

namespace gnomon {

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
constant constexpr float bias6_raw_b2 = 0.42015374983242804f;
constant constexpr float bias6_raw_b4 = 0.2876068288776971f;
constant constexpr float bias6_raw_b6 = 0.25730795870391842f;

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
constant constexpr float bias6_theta_b2 = 0.61284694380550628f;
constant constexpr float bias6_theta_b4 = 0.52469968779048582f;
constant constexpr float bias6_theta_b6 = 0.50463026403505464f;
constant constexpr float bias6_paper_b2 = 0.5566f;
constant constexpr float bias6_paper_b4 = 0.489f;
constant constexpr float bias6_paper_b6 = 0.47869382f;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
inline moments6 moments6_add_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0f - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
}

} // namespace gnomon

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

namespace gnomon {

/// The unevaluated sum high + low.
struct double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
inline float dekker_product_error(float a, float b, float p)
{
    float ah = gnomon_high_part(a);
    float bh = gnomon_high_part(b);
    float al = gnomon_difference(a, ah);
    float bl = gnomon_difference(b, bh);
    float e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
inline double_word two_product(float a, float b)
{
    double_word r;
    r.high = gnomon_fma(a, b, -0.0f); // kept, as gnomon_product is: two fused products read it
    r.low = gnomon_fma(a, b, -r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
inline double_word two_difference(float a, float b)
{
    double_word r;
    r.high = gnomon_difference(a, b);
    float bv = gnomon_difference(r.high, a);
    float av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
inline double_word two_difference_ordered(float a, float b)
{
    double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
inline double_word subtract_product(float c, float a, float b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
inline double_word subtract_product_ordered(float c, float a, float b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
inline float subtract_product_rounded(float c, float a, float b)
{
    double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
inline double_word double_word_minor(double_word a, double_word b, double_word c, double_word d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference(p.high, q.high);
    float cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for double_word_minor.
/// Error: 2 roundings of the result beside that of double_word_minor.
inline float double_word_determinant(double_word a, double_word b, double_word c)
{
    double_word p = two_product(a.high, c.high);
    double_word q = two_product(b.high, b.high);
    float cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

} // namespace gnomon

#endif

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H

namespace gnomon {

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
inline double_word covariance_add_bias(double_word c, float b_i, float b_j, float e_ij, float e_i, float e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

} // namespace gnomon

#endif

// moments/hankel4.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of four moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side).
//
//     B = | 1  b1 b2 |      The factorization L D L^T has the pivots 1, D_1 = E[P_1^2] and D_2 = E[P_2^2], where
//         | b1 b2 b3 |      P_1 = z - b1 and P_2 = P_1^2 - g P_1 - D_1 are the monic orthogonal polynomials of the
//         | b2 b3 b4 |      distribution.
//
// After the first step of elimination the covariances of (z, z^2) remain: V = var z = D_1, L = cov(z, z^2) and
// M = var z^2, and D_1 D_2 = V M - L^2. All three cancel, so they are computed from exact products. A bias (bias.h) is
// added to the covariances, as double words, because added to the moments it would be rounded away. hamburger4.h
// divides later, and uses G = g V = E[P_1^3] = L - 2 b1 V in place of L.
#ifndef GNOMON_MOMENTS_HANKEL4_4
#define GNOMON_MOMENTS_HANKEL4_4

namespace gnomon {

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
struct hankel4 { float mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
inline hankel4 hankel4_make(float mean, float variance, float covariance, float determinant)
{
    hankel4 h;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, variance);
    h.third = covariance - (mean + mean) * h.variance;
    h.determinant = gnomon_max(gnomon_pivot_floor * h.variance, determinant);
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 16-bit storage, whose
/// own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
inline hankel4 hankel4_from_moments(moments4 b)
{
    float v = b.b2 - b.b1 * b.b1;
    float l = b.b3 - b.b1 * b.b2;
    float m = b.b4 - b.b2 * b.b2;
    return hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
struct covariances4 { double_word v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
inline covariances4 covariances4_from_moments(moments4 b)
{
    covariances4 c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
inline hankel4 hankel4_with_change(moments4 b, moments4 e)
{
    covariances4 c = covariances4_from_moments(b);
    double_word v = covariance_add_bias(c.v, b.b1, b.b1, e.b2, e.b1, e.b1);
    double_word l = covariance_add_bias(c.l, b.b1, b.b2, e.b3, e.b1, e.b2);
    double_word m = covariance_add_bias(c.m, b.b2, b.b2, e.b4, e.b2, e.b2);
    return hankel4_make(b.b1 + e.b1, v.high + v.low, l.high + l.low, double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
inline hankel4 hankel4_constant_bias(moments4 b, float bias2, float bias4, float alpha)
{
    moments4 e;
    e.b1 = -1.0f * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = -1.0f * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    return hankel4_with_change(b, e);
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

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_4
#define GNOMON_MOMENTS_QUANTIZATION_4

namespace gnomon {

/// The moments that a format without transform holds as they are.
inline moments4 moments4_from_channels(channels4 c)
{
    moments4 b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    return b;
}

/// The moments b as the channels of a format without transform.
inline channels4 channels4_from_moments(moments4 b)
{
    channels4 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    return c;
}

constant constexpr float theta4_31 = 0.8660254037844386f;   // sqrt(3) / 2
constant constexpr float theta4_33 = -0.38490017945975052f; // -2 sqrt(3) / 9
constant constexpr float theta4_inverse11 = -0.33333333333333331f;
constant constexpr float theta4_inverse13 = 1.7320508075688772f;
constant constexpr float theta4_inverse33 = 1.299038105676658f;

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
inline channels4 theta4(moments4 b)
{
    channels4 c;
    c.c1 = 1.5f * b.b1 - 2.0f * b.b3 + 0.5f;
    c.c2 = 4.0f * (b.b2 - b.b4);
    c.c3 = theta4_31 * b.b1 + theta4_33 * b.b3 + 0.5f;
    c.c4 = 0.5f * (b.b2 + b.b4);
    return c;
}

/// The four moments of channels c: the inverse of theta4.
/// Source: Peters 2017, Eq. 3
inline moments4 theta4_inverse(channels4 c)
{
    float c1 = c.c1 - 0.5f;
    float c3 = c.c3 - 0.5f;
    moments4 b;
    b.b1 = theta4_inverse11 * c1 + theta4_inverse13 * c3;
    b.b2 = 0.125f * c.c2 + c.c4;
    b.b3 = theta4_inverse33 * c3 - 0.75f * c1;
    b.b4 = c.c4 - 0.125f * c.c2;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
inline moments4 theta4_inverse_add_bias(channels4 c, float bias, float alpha)
{
    float keep = 1.0f - alpha;
    float c1 = c.c1 - 0.5f;
    float c3 = c.c3 - 0.5f;
    float c2 = (0.125f * keep) * c.c2;
    float c4 = keep * c.c4 + alpha * bias;
    moments4 b;
    b.b1 = (keep * theta4_inverse11) * c1 + (keep * theta4_inverse13) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * theta4_inverse33) * c3 - (0.75f * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

} // namespace gnomon

#endif

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_QUANTIZATION_6
#define GNOMON_MOMENTS_QUANTIZATION_6

namespace gnomon {

/// The moments that a format without transform holds as they are.
inline moments6 moments6_from_channels(channels6 c)
{
    moments6 b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    b.b5 = c.c5;
    b.b6 = c.c6;
    return b;
}

/// The moments b as the channels of a format without transform.
inline channels6 channels6_from_moments(moments6 b)
{
    channels6 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b5;
    c.c6 = b.b6;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
constant constexpr float theta6_21 = -1.8745771666290014f;
constant constexpr float theta6_23 = 4.204664766466248f;
constant constexpr float theta6_25 = -1.8300875998372463f;
constant constexpr float theta6_31 = 1.2643431422063351f;
constant constexpr float theta6_33 = -1.4716161665593888f;
constant constexpr float theta6_35 = 0.70727302435305361f;
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
constant constexpr float theta6_62 = -0.57735026918962573f;
constant constexpr float theta6_64 = 4.6188021535170058f;
constant constexpr float theta6_66 = -3.0792014356780042f;
constant constexpr float theta6_60 = 0.018874775675311862f;
constant constexpr float theta6_inverse11 = -0.02841260648183782f;
constant constexpr float theta6_inverse12 = 0.47582541301272185f;
constant constexpr float theta6_inverse13 = 1.552587193469116f;
constant constexpr float theta6_inverse31 = 0.10002244957859331f;
constant constexpr float theta6_inverse32 = 0.84496560893955308f;
constant constexpr float theta6_inverse33 = 1.0550119414818537f;
constant constexpr float theta6_inverse51 = 0.25890700149881596f;
constant constexpr float theta6_inverse52 = 0.90751156960796575f;
constant constexpr float theta6_inverse53 = 0.83358142889321829f;
constant constexpr float theta6_inverse_sixth = 0.16666666666666666f;
constant constexpr float theta6_inverse23 = 0.8660254037844386f;
constant constexpr float theta6_inverse63 = 0.81189881604791125f;

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
inline channels6 theta6(moments6 b)
{
    channels6 c;
    c.c1 = 2.5f * b.b1 - 10.0f * b.b3 + 8.0f * b.b5 + 0.5f;
    c.c2 = theta6_21 * b.b1 + theta6_23 * b.b3 + theta6_25 * b.b5 + 0.5f;
    c.c3 = theta6_31 * b.b1 + theta6_33 * b.b3 + theta6_35 * b.b5 + 0.5f;
    c.c4 = 4.0f * (b.b2 - b.b4);
    c.c5 = 9.0f * b.b2 - 24.0f * b.b4 + 16.0f * b.b6;
    c.c6 = theta6_62 * b.b2 + theta6_64 * b.b4 + theta6_66 * b.b6 + theta6_60;
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
inline moments6 theta6_inverse(channels6 c)
{
    float c1 = c.c1 - 0.5f;
    float c2 = c.c2 - 0.5f;
    float c3 = c.c3 - 0.5f;
    float c5 = theta6_inverse_sixth * c.c5;
    float c6 = c.c6 - theta6_60;
    moments6 b;
    b.b1 = theta6_inverse11 * c1 + theta6_inverse12 * c2 + theta6_inverse13 * c3;
    b.b3 = theta6_inverse31 * c1 + theta6_inverse32 * c2 + theta6_inverse33 * c3;
    b.b5 = theta6_inverse51 * c1 + theta6_inverse52 * c2 + theta6_inverse53 * c3;
    b.b2 = c5 + theta6_inverse23 * c6;
    b.b4 = (c5 + theta6_inverse23 * c6) - 0.25f * c.c4;
    b.b6 = (0.21875f * c.c5 + theta6_inverse63 * c6) - 0.375f * c.c4;
    return b;
}

} // namespace gnomon

#endif

// moments/certified4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four stored moments, certified: never above Z(z < z_f), for any errors of storage within
// the stated noise.
//
// A quartic p with p <= 1 before z_f and p <= 0 from z_f on has E[p] <= Z(z < z_f) for every distribution Z. Storage
// moves channel k by at most noise_k, so E[p] is at least its value from the stored channels minus
// sum_k noise_k |p_k|, where p_k is the coefficient at channel k. That bound holds for every such p. A p with its nodes
// at those of the biased moments (hamburger4.h) is nearly the best (docs/decisions/2-bias.md).
//
// In y = z - z_f, and in the notation of hamburger4.h, the two nodes beside z_f are the roots of a y^2 + b y + w with
//     a = Q V,    b = u N + Q (2 V u - G),    w = V N + u^2 N + Q^2,    r^2 = b^2 - 4 a w.
// Of the nodes before z_f the nearer one is at y = -1 / c with c = (b + r) / (2 w). The certificate is
//     Q < 0, one node on either side:    p = -(1 + d + k y)^2 (2 (c - k) y + c (c - 2 k) y^2)
//     Q >= 0 and b > 0, both before:     p = 1 - (1 + c y)^2 (1 + g y)^2
//     otherwise, none before:            no p, and the bound is 0
// with d = b / (2 r) - 1/2, k = c d and g = (b - r) / (2 w). Both p are 1 at the nodes before z_f, and 0 at z_f and at
// the nodes behind. Any other c >= 0, d in [-1, 0] and g >= 0 give a valid p as well, so rounding in the nodes costs
// only some leaking.
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H

namespace gnomon {

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
struct certificate4 { float top, s0, s1, s2, s3, s4; };

constant constexpr float certificate4_nothing = -1267650600228229401496703205376.0f; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
inline certificate4 certificate4_about(float z_f, float n0, float t0, float t1, float n1, float n2)
{
    float nz = n2 * z_f;
    float ns = (n1 + n1) - nz;
    float k0 = n0 - ns * z_f;
    float k1 = ns - nz;
    float m = t0 - t1 * z_f;
    float m0 = m * m;
    float m1 = m * (t1 + t1);
    float m2 = t1 * t1;
    certificate4 p;
    p.top = n0;
    p.s0 = m0 * k0;
    p.s1 = m0 * k1 + m1 * k0;
    p.s2 = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3 = m1 * n2 + m2 * k1;
    p.s4 = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
inline certificate4 certificate4_make(hankel4 h, float z_f)
{
    float u = z_f - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    float un = u * h.determinant;
    float w = h.variance * h.determinant + (u * un + q * q);
    float w2 = w + w;
    float a = q * h.variance;
    float b = un + q * (vu + slope);
    float square = b * b - (a + a) * w2;
    float inverse = 1.0f / w2;
    float ratio = b / (square + square);
    float r = gnomon_sqrt(gnomon_max(0.0f, square));
    float c = (b + r) * inverse;
    float g = (b - r) * inverse;
    float d = ratio * r - 0.5f;
    float k = c * d;
    bool between = q < 0.0f;
    float n0 = gnomon_select(between, 0.0f, 1.0f);
    float n1 = gnomon_select(between, c - k, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    float t0 = gnomon_select(between, 1.0f + d, 1.0f);
    float t1 = gnomon_select(between, k, c);
    certificate4 p = certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (0.0f < b), n0, certificate4_nothing);
    return p;
}

/// The coefficients of p at the channels of theta4, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
inline channels4 certificate4_theta(certificate4 p)
{
    float third = 0.75f * p.s3;
    channels4 r;
    r.c1 = theta4_inverse11 * p.s1 - third;
    r.c2 = 0.125f * (p.s2 - p.s4);
    r.c3 = theta4_inverse13 * (p.s1 + third);
    r.c4 = p.s2 + p.s4;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
inline float certificate4_theta_doubt(channels4 t, float noise)
{
    return noise * ((gnomon_abs(t.c1) + gnomon_abs(t.c2)) + (gnomon_abs(t.c3) + gnomon_abs(t.c4)));
}

/// The least possible value of E[p], given channels c of theta4 that are each off by at most noise.
inline float certificate4_theta_mean(certificate4 p, channels4 c, float noise)
{
    channels4 t = certificate4_theta(p);
    float mean = (p.s0 + (t.c2 * c.c2 + t.c4 * c.c4)) + (t.c1 * (c.c1 - 0.5f) + t.c3 * (c.c3 - 0.5f));
    return p.top - (mean + certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4 that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
inline float certified4_theta_lower(hankel4 h, channels4 c, float noise, float z_f)
{
    certificate4 p = certificate4_make(h, clamp_or_nan(z_f, -1.0f, 1.0f));
    return saturate_or_zero(certificate4_theta_mean(p, c, noise));
}

constant constexpr float certified4_scale = 137438953472.0f; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
struct certified4_mean
{
    certificate4 p;
    float mean, added, known;
};

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
inline certified4_mean certified4_constant_bias_mean(hankel4 h, float bias2, float bias4, float alpha, float z)
{
    float u = z - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    float s = certified4_scale * q;
    float n = certified4_scale * h.determinant;
    float un = u * n;
    float e = u * un + q * s;
    float w = h.variance * n + e;
    float w2 = w + w;
    float a = s * h.variance;
    float a2 = a + a;
    float b = un + s * (vu + slope);
    float r = gnomon_sqrt(gnomon_max(0.0f, b * b - a2 * w2));
    bool between = q < 0.0f;
    bool positive = 0.0f < b;
    // Each quotient in the form that does not cancel.
    float outer = r + gnomon_abs(b);
    float c = gnomon_select(positive, outer, -2.0f * a) / gnomon_select(positive, w2, outer);
    float inverse = 1.0f / gnomon_select(between, r + r, outer);
    float g = a2 * inverse; // k if one node is on either side
    float n0 = gnomon_select(between, 0.0f, 1.0f);
    float n1 = gnomon_select(between, c - g, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    float t0 = gnomon_select(between, 0.5f + b * inverse, 1.0f);
    float t1 = gnomon_select(between, g, c);
    certified4_mean m;
    m.p = certificate4_about(z, n0, t0, t1, n1, n2);
    float share = gnomon_select(between, 0.5f * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, 1.0f));
    m.added = alpha * ((m.p.top - m.p.s0) - (bias2 * m.p.s2 + bias4 * m.p.s4));
    m.known = gnomon_select((between || positive) && (gnomon_pivot_floor * h.variance < h.determinant), 1.0f, 0.0f);
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
inline float certified4_constant_bias_intensity(certified4_mean m, float doubt)
{
    return gnomon_select(0.0f < m.known, saturate_or_zero(m.mean - (m.added + doubt)), 0.0f);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
inline float certified4_constant_bias_lower(hankel4 h, moments4 noise, float bias2, float bias4, float alpha, float z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0f, 1.0f));
    float doubt = (noise.b1 * gnomon_abs(m.p.s1) + noise.b2 * gnomon_abs(m.p.s2)) +
                  (noise.b3 * gnomon_abs(m.p.s3) + noise.b4 * gnomon_abs(m.p.s4));
    return certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4 with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
inline float certified4_theta_constant_bias_lower(hankel4 h, float noise, float bias2, float bias4, float alpha,
                                                  float z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0f, 1.0f));
    return certified4_constant_bias_intensity(m, certificate4_theta_doubt(certificate4_theta(m.p), noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
inline moments4 moments4_rounding(moments4 b, float delta)
{
    moments4 e;
    e.b1 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1));
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
inline moments4 moments4_rounding_filtered(moments4 b, float delta)
{
    moments4 e;
    e.b1 = delta;
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

} // namespace gnomon

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

namespace gnomon {

constant constexpr float texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
inline float texel_below(float x)
{
    float limit = texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
    return saturate_or_zero(share / look_ups);
}

} // namespace gnomon

#endif

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

namespace gnomon {

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

constant constexpr float stochastic_nothing = -1.0f;               // the id of the background
// 1 + 2^-21: a time is so far from the ends of its stratum
constant constexpr float stratum_begin = 1.000000476837158203125f;
constant constexpr float stratum_end = 0.999999523162841796875f;   // 1 - 2^-21

/// A sample of the background.
inline stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0f;
    s.d_x = 0.0f;
    s.d_y = 0.0f;
    s.d_z = 0.0f;
    s.id = stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
inline float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0f) * stratum_end);
    place = gnomon_max(place, stratum * stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
inline float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0f), 0.0f);
}

} // namespace gnomon

#endif

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

namespace gnomon {

constant constexpr float layer_depth_limit = 2.0f;      // middle depths of surfaces lie in [-2, 2]
constant constexpr float layer_no_cut = 3.0f;           // a cut behind all surfaces
constant constexpr float layer_background_depth = 4.0f; // the middle depth of the background
constant constexpr float layer_unknown_depth = -4.0f;   // the middle depth of a sample of NaN
constant constexpr float layer_last_bin = 63.0f;
constant constexpr float layer_least_extent = 0.00006103515625f; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
inline float layer_middle_depth(stochastic_sample s)
{
    float z = s.z + (0.5f - s.t) * s.d_z;
    float limit = layer_depth_limit;
    float inside = gnomon_max(gnomon_min(z, limit), -1.0f * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    float size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    bool known = size <= texel_limit;
    float middle = gnomon_select(known, inside, layer_unknown_depth);
    return gnomon_select(s.id < 0.0f, layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
inline bool layer_is_surface(float middle) { return gnomon_abs(middle) <= layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct layer_window { float least, greatest; };

/// The window of one sample, by its middle depth.
inline layer_window layer_window_begin(float middle)
{
    bool surface = layer_is_surface(middle);
    layer_window w;
    w.least = gnomon_select(surface, middle, layer_background_depth);
    w.greatest = gnomon_select(surface, middle, layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
inline layer_window layer_window_add(layer_window window, float middle)
{
    layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
inline float layer_bin_of(float middle, layer_window window)
{
    float share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    float bin = gnomon_min(texel_below(64.0f * share), layer_last_bin);
    return gnomon_select(layer_is_surface(middle), bin, -1.0f);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct layer_runs
{
    float least, greatest, bins, begun, empty;
    float length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
inline layer_runs layer_cuts_begin(layer_window window)
{
    layer_runs r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0f;
    r.begun = 0.0f;
    r.empty = 0.0f;
    r.length0 = 0.0f;
    r.length1 = 0.0f;
    r.length2 = 0.0f;
    r.centre0 = 0.0f;
    r.centre1 = 0.0f;
    r.centre2 = 0.0f;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
inline layer_runs layer_cuts_add(layer_runs state, float occupied)
{
    bool some = 0.0f < occupied;
    float centre = state.bins - 0.5f * state.empty;
    bool third = some && state.length2 < state.empty;
    bool second = some && state.length1 < state.empty;
    bool first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, 1.0f, state.begun);
    state.empty = gnomon_select(some, 0.0f, state.empty + state.begun);
    state.bins = state.bins + 1.0f;
    return state;
}

/// Depths that cut a window into layers, from near to far; layer_no_cut for those that are not needed.
struct layer_cuts { float c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
inline layer_cuts layer_cuts_end(layer_runs state, float layers)
{
    float none = layer_no_cut;
    float extent = state.greatest - state.least;
    bool surfaces = layer_is_surface(state.least) && layer_is_surface(state.greatest);
    bool some = surfaces && layer_least_extent <= extent;
    float per_bin = 0.015625f * extent;
    bool first = some && 0.0f < state.length0 && 1.0f < layers;
    bool second = some && 0.0f < state.length1 && 2.0f < layers;
    bool third = some && 0.0f < state.length2 && 3.0f < layers;
    float a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    float b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    float c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    float near_ab = gnomon_min(a, b);
    float far_ab = gnomon_max(a, b);
    float middle = gnomon_min(far_ab, c);
    layer_cuts r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
inline float layer_of(float middle, layer_cuts cuts)
{
    float known = gnomon_select(-1.0f * layer_depth_limit <= middle, 0.0f, -1.0f);
    float first = gnomon_select(cuts.c0 <= middle, 1.0f, 0.0f);
    float second = gnomon_select(cuts.c1 <= middle, 1.0f, 0.0f);
    float third = gnomon_select(cuts.c2 <= middle, 1.0f, 0.0f);
    float behind = gnomon_select(layer_background_depth <= middle, 1.0f, 0.0f);
    return (known + first) + ((second + third) + behind);
}

} // namespace gnomon

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

namespace gnomon {

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct layer_motion_sums
{
    float first_x, first_y, first_z, x, y, z, square, square_z, count;
    float least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct layer_motion { float d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
inline layer_motion_sums layer_motion_begin(stochastic_sample first)
{
    float limit = texel_limit;
    layer_motion_sums r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0f);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0f);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0f);
    r.x = 0.0f;
    r.y = 0.0f;
    r.z = 0.0f;
    r.square = 0.0f;
    r.square_z = 0.0f;
    r.count = 0.0f;
    r.least = limit;
    r.greatest = -1.0f * limit;
    r.least_d = limit;
    r.greatest_d = -1.0f * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
inline bool layer_motion_is_known(stochastic_sample s, float middle)
{
    float length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= texel_limit && layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
inline layer_motion_sums layer_motion_add(layer_motion_sums state, stochastic_sample s, float middle)
{
    bool known = layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.first_x, 0.0f);
    float y = gnomon_select(known, s.d_y - state.first_y, 0.0f);
    float z = gnomon_select(known, s.d_z - state.first_z, 0.0f);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0f, 0.0f);
    float moved = s.z + (0.5f - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
inline layer_motion layer_motion_end(layer_motion_sums state)
{
    float share = 1.0f / gnomon_max(state.count, 1.0f);
    float x = state.x * share;
    float y = state.y * share;
    float z = state.z * share;
    bool some = 0.0f < state.count;
    layer_motion r;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0f);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0f);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0f);
    r.spread = gnomon_sqrt(gnomon_max(0.0f, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0f, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    float off = 0.5f * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0f);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0f);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    float axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

// 2^-20 texels: shorter motions have no direction
constant constexpr float layer_least_motion = 0.00000095367431640625f;
// 2^-10: no layer is stretched as if it were thinner
constant constexpr float layer_least_depths = 0.0009765625f;

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
inline layer_grid layer_grid_make(layer_motion mean, float guard, float texels)
{
    float chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    bool moves = layer_least_motion <= chord;
    layer_grid g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0f);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0f);
    g.motion = gnomon_select(moves, chord, 0.0f);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5f * texels;
    g.centre = 0.5f * (mean.least + mean.greatest);
    g.scale = 2.0f / gnomon_max(layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
struct layer_place { float u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
inline layer_place layer_grid_turned(layer_grid grid, float x, float y)
{
    layer_place r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
inline layer_place layer_grid_place(layer_grid grid, float x, float y, float t)
{
    layer_place turned = layer_grid_turned(grid, x, y);
    layer_place r;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5f - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
inline float layer_place_is_inside(layer_grid grid, layer_place place)
{
    float texels = 2.0f * grid.middle;
    bool begun = 0.0f <= place.u && 0.0f <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0f, 0.0f);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
inline float layer_grid_depth(layer_grid grid, float z, float t) { return z + (0.5f - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
inline float layer_grid_own_depth(layer_grid grid, float z, float t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

} // namespace gnomon

#endif

// motion/layers/layer_sums.h ------------------------------------------------------------------------------------------
// Sums that a texel of a layer's grid holds, and the visibility of a receiver through the layer (Andersson et al. 2015,
// Sec. 4.1 and 4.2). A sample in the layer or behind it has weight w = 1, one in front of the layer has none. A sample
// in the layer has opacity a = 1: where one sees past the layer, it is transparent. Per texel
//
//     variance       sums of w a z, w a z^2, w a, w                                layer_sums, Eq. 7
//     four moments   sums of w a z, ..., w a z^4, w a, w                           layer_moments4_sums
//     exponential    sums of w a exp(c z), w a, w                                  layer_exponential_sums
//
// where z is the layer's own depth, in [-1, 1] (layer_grid_own_depth). Filters and mip levels are linear in the sums.
// With the mean depths of what is opaque, Eq. 8, and the opacity a = sum w a / sum w, a layer lets through
//
//     V = 1 - a intensity                                                          Eq. 10
//
// and a receiver sees the product over all layers. A layer whose samples are all before the receiver has intensity 1,
// one whose samples are all behind has 0, with every bound. A sum of weights of 0 is no information: filters grow until
// there is some, and without any the layer counts as transparent.
//
//     share = layer_share_of(layer_of(layer_middle_depth(s), cuts), layer);
//     sums = layer_sums_add(sums, layer_grid_own_depth(grid, s.z, s.t), share);    into the texel at
// layer_grid_place(...)
//
//     visibility = 1, then visibility * layer_visibility(sums, layer_grid_own_depth(grid, z_r - bias, t_r), minimum)
//                                                                                  for all layers with their filtered
// sums
#ifndef GNOMON_MOTION_LAYERS_LAYER_SUMS_H
#define GNOMON_MOTION_LAYERS_LAYER_SUMS_H

namespace gnomon {

/// Opacity and weight of a sample for a layer, each 0 or 1.
struct layer_share { float opacity, weight; };

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
inline layer_share layer_share_of(float at, float layer)
{
    layer_share r;
    r.opacity = gnomon_select(at == layer, 1.0f, 0.0f);
    r.weight = gnomon_select(layer <= at, 1.0f, 0.0f);
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
struct layer_sums { float z, zz, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
inline layer_sums layer_sums_add(layer_sums sums, float z, layer_share share)
{
    float a = share.weight * share.opacity;
    float x = clamp_or_high(z, -1.0f, 1.0f);
    sums.z = sums.z + a * x;
    sums.zz = sums.zz + a * (x * x);
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility 1 - a intensity through a layer, where a = opacity / weight is its opacity and intensity is a bound
/// on the share of its samples before a receiver at the layer's own depth z: 1 behind all of them, 0 in front of all of
/// them.
/// NaN: 1.
/// Source: Andersson 2015, Eq. 10
inline float layer_transmission(float opacity, float weight, float intensity, float z)
{
    float bound = gnomon_select(1.0f < z, 1.0f, gnomon_select(-1.0f < z, intensity, 0.0f));
    float known = gnomon_select(0.0f < weight, saturate_or_zero(opacity / weight), 0.0f);
    return 1.0f - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight
/// of 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
inline float layer_visibility(layer_sums sums, float z, float minimum_variance)
{
    variance_moments b;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
struct layer_moments4_sums { float b1, b2, b3, b4, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
inline layer_moments4_sums layer_moments4_add(layer_moments4_sums sums, float z, layer_share share)
{
    float a = share.weight * share.opacity;
    moments4 b = moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f));
    sums.b1 = sums.b1 + a * b.b1;
    sums.b2 = sums.b2 + a * b.b2;
    sums.b3 = sums.b3 + a * b.b3;
    sums.b4 = sums.b4 + a * b.b4;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

constant constexpr float layer_moments4_noise = 3.3e-8f; // 1.1 times 2^-25, one rounding to float
constant constexpr float layer_moments4_weight = 3e-7f;  // the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one
/// more, and those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and
/// so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
inline float layer_moments4_visibility(layer_moments4_sums sums, float z, float roundings)
{
    float share = 1.0f / sums.opacity;
    moments4 b;
    b.b1 = sums.b1 * share;
    b.b2 = sums.b2 * share;
    b.b3 = sums.b3 * share;
    b.b4 = sums.b4 * share;
    float n = gnomon_max(1.0f, roundings) * (sums.weight * share);
    float alpha = bias_weight_of_roundings(layer_moments4_weight, n);
    moments4 noise;
    noise.b1 = n * layer_moments4_noise;
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    hankel4 h = hankel4_constant_bias(b, bias4_raw_b2, bias4_raw_b4, alpha);
    float intensity = certified4_constant_bias_lower(h, noise, bias4_raw_b2, bias4_raw_b4, alpha, z);
    return layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
struct layer_exponential_sums { float warped, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
inline layer_exponential_sums layer_exponential_add(layer_exponential_sums sums, float z, layer_share share,
                                                    exponential_settings settings)
{
    float a = share.weight * share.opacity;
    sums.warped = sums.warped + a * exponential_encode(z, settings).warped;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Markov's bound. A weight of
/// 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; settings as for exponential_intensity.
/// NaN: 1.
/// Error: (c + n + 7) 2^-p, c the exponent, for sums over n samples.
/// Source: Andersson 2015, Eq. 10; Annen 2008
inline float layer_exponential_visibility(layer_exponential_sums sums, float z, exponential_settings settings)
{
    exponential_moment b;
    b.warped = sums.warped / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
}

} // namespace gnomon

#endif

// motion/layers/layer_parts.h -----------------------------------------------------------------------------------------
// Parts of one layer that move unlike: samples of one range of depths, divided by their motion (the future work of
// Andersson et al. 2015, Sec. 7). Leaves and the branch between them have like depths, but unlike motions.
//
// The motions of a layer's samples vary most along one direction. Their places on it, in standard deviations, are
// clustered as depths are (layer_clusters.h): equal bins, and a cut at the longest interior run of empty ones. Either
// part has sums on a grid of its own motion. Both overlap in depth, so that either may hide the other: a sample of one
// part tells of the other only if it is behind the middle of that one's depths. A receiver sees the product of the
// visibilities through both, as through two layers.
//
//     state = layer_direction_begin(motion);                                       the layer's motion
// (layer_motion_end)
//     state = layer_direction_add(state, s, layer_middle_depth(s));                for all samples of the layer
//     direction = layer_direction_end(state);
//     window, bins and cuts of keys = layer_direction_key(direction, s) in place of depths, for two layers
//     part = layer_of(key, cuts)                                                   0 or 1
//     share = layer_share_of_part(at, layer, part, wanted, layer_middle_depth(s), centre)
//     sums = layer_sums_add(sums, z, share)                                        for the part `wanted`
#ifndef GNOMON_MOTION_LAYERS_LAYER_PARTS_H
#define GNOMON_MOTION_LAYERS_LAYER_PARTS_H

namespace gnomon {

/// A fold over the samples of a layer: its mean motion, sums of squares and products of differences from that, and
/// their number.
struct layer_direction_sums { float d_x, d_y, xx, xy, yy, count; };

/// The mean motion of a layer, the direction in which its samples' motions differ most, and the inverse of four
/// standard deviations in that direction; 0 if they do not differ.
struct layer_direction { float d_x, d_y, axis_x, axis_y, scale; };

// 2^-20 square texels: motions that differ less do not
constant constexpr float layer_least_difference = 0.00000095367431640625f;

/// The state before the first sample.
inline layer_direction_sums layer_direction_begin(layer_motion motion)
{
    layer_direction_sums r;
    r.d_x = motion.d_x;
    r.d_y = motion.d_y;
    r.xx = 0.0f;
    r.xy = 0.0f;
    r.yy = 0.0f;
    r.count = 0.0f;
    return r;
}

/// The state after one more sample and its middle depth.
/// Domain: as for layer_motion_add.
/// NaN: no information, the state as before.
inline layer_direction_sums layer_direction_add(layer_direction_sums state, stochastic_sample s, float middle)
{
    bool known = layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.d_x, 0.0f);
    float y = gnomon_select(known, s.d_y - state.d_y, 0.0f);
    state.xx = state.xx + x * x;
    state.xy = state.xy + x * y;
    state.yy = state.yy + y * y;
    state.count = state.count + gnomon_select(known, 1.0f, 0.0f);
    return state;
}

/// The direction in which motions differ most: that of the larger eigenvalue of their covariance, along x if both are
/// equal.
/// Domain: differences from 2^-10 texels on; of smaller ones the direction is along x, and scale is 0.
/// Error: with n samples, of the axis (n + 16) 2^-p times the larger eigenvalue over the difference of both; of scale,
/// relative, (n + 16) 2^-p.
inline layer_direction layer_direction_end(layer_direction_sums state)
{
    float half_difference = 0.5f * (state.xx - state.yy);
    float radius = gnomon_sqrt(half_difference * half_difference + state.xy * state.xy);
    float larger = 0.5f * (state.xx + state.yy) + radius;
    // (xy, larger - xx) and (larger - yy, xy) are both along the axis: the one without cancellation.
    bool steep = half_difference < 0.0f;
    float long_part = radius + gnomon_abs(half_difference);
    float x = gnomon_select(steep, state.xy, long_part);
    float y = gnomon_select(steep, long_part, state.xy);
    float norm = gnomon_sqrt(x * x + y * y);
    bool apart = 0.0f < norm;
    float square = larger / gnomon_max(state.count, 1.0f);
    bool differ = layer_least_difference <= square;
    layer_direction r;
    r.d_x = state.d_x;
    r.d_y = state.d_y;
    r.axis_x = gnomon_select(apart && differ, x / norm, 1.0f);
    r.axis_y = gnomon_select(apart && differ, y / norm, 0.0f);
    r.scale = gnomon_select(differ, 0.25f / gnomon_sqrt(square), 0.0f);
    return r;
}

/// The place of a sample's motion on the direction, from the layer's mean: 1 at four standard deviations, limited to
/// [-2, 2].
/// NaN: layer_unknown_depth.
inline float layer_direction_key(layer_direction direction, stochastic_sample s)
{
    float x = (s.d_x - direction.d_x) * direction.axis_x;
    float y = (s.d_y - direction.d_y) * direction.axis_y;
    float key = (x + y) * direction.scale;
    float limit = layer_depth_limit;
    float inside = gnomon_max(gnomon_min(key, limit), -1.0f * limit);
    return gnomon_select(gnomon_abs(key) <= texel_limit, inside, layer_unknown_depth);
}

/// The key that divides a layer into two parts: the centre of the longest run of empty bins (layer_cuts_add) if that is
/// at least `bins` bins long, else layer_no_cut. A few samples leave short runs anywhere.
/// NaN: a `bins` of NaN divides nothing.
inline float layer_part_cut(layer_runs state, float bins)
{
    return gnomon_select(bins <= state.length0, layer_cuts_end(state, 2.0f).c0, layer_no_cut);
}

/// Opacity and weight, for part number `wanted` of layer number `layer`, of a sample that is in part `part` of layer
/// `at` at the middle depth `middle`. A sample of the other part has no opacity. It has weight if it is behind
/// `centre`, the middle of the wanted part's depths: where it is seen, one sees past that part.
/// NaN: no weight for an `at` of NaN, nor in the layer for a `part`, `middle` or `centre` of NaN. A part below 0 is a
/// NaN.
inline layer_share layer_share_of_part(float at, float layer, float part, float wanted, float middle, float centre)
{
    layer_share r = layer_share_of(at, layer);
    bool other = at == layer && !(part == wanted);
    bool past = centre < middle && 0.0f <= part;
    r.opacity = gnomon_select(other, 0.0f, r.opacity);
    r.weight = gnomon_select(other && !past, 0.0f, r.weight);
    return r;
}

} // namespace gnomon

#endif

#endif
