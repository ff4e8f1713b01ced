// Gnomon 0.1.0, mip_filter.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_MIP_FILTER_CL
#define GNOMON_MIP_FILTER_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: mip_filter.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: mip_filter.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: mip_filter.cl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline float gnomon_abs(float a) { return fabs(a); }
static inline float gnomon_sqrt(float a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline float gnomon_kept(float x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline float gnomon_apart(float x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
static inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
static inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
static inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
static inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
static inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
static inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline float gnomon_saturate(float x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline float gnomon_high_part(float a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline float gnomon_power_of_two(float n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
static inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
static inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
static inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
static inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
static inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

__constant float gnomon_exp_log2_e = 1.4426950408889634f;
__constant float gnomon_exp_ln2_low = -2.1219444005469058e-4f;
__constant float gnomon_exp_sqrt_2 = 1.4142135623730951f;
__constant float gnomon_exp_sqrt_half = 0.70710678118654752f;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
__constant float gnomon_exp_float_0 = 0.49999993561656014f;
__constant float gnomon_exp_float_1 = 0.16666518908321371f;
__constant float gnomon_exp_float_2 = 0.041668318723256166f;
__constant float gnomon_exp_float_3 = 0.0083689258101569408f;
__constant float gnomon_exp_float_4 = 0.00138210541669496f;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
__constant float gnomon_log_float_0 = 0.66666776085218282f;
__constant float gnomon_log_float_1 = 0.39977574040563962f;
__constant float gnomon_log_float_2 = 0.29870936689734456f;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
static inline float gnomon_exp_remainder(float r)
{
    float p = gnomon_exp_float_0 + r *
              (gnomon_exp_float_1 + r * (gnomon_exp_float_2 + r * (gnomon_exp_float_3 + r * gnomon_exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
static inline float polynomial_exp(float x)
{
    float low = -87.0f;
    float high = 88.0f;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375f) - n * gnomon_exp_ln2_low;
    return (1.0f + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
typedef struct gnomon_scaled_number gnomon_scaled_number;
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
static inline gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    gnomon_scaled_number r;
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
static inline float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0f;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0f), gnomon_power_of_two(127.0f));
    s = gnomon_scaled_number_step(s, 64.0f);
    s = gnomon_scaled_number_step(s, 32.0f);
    s = gnomon_scaled_number_step(s, 16.0f);
    s = gnomon_scaled_number_step(s, 8.0f);
    s = gnomon_scaled_number_step(s, 4.0f);
    s = gnomon_scaled_number_step(s, 2.0f);
    s = gnomon_scaled_number_step(s, 1.0f);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5f, gnomon_select(tiny, s.significand * 2.0f, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0f, gnomon_select(tiny, s.exponent - 1.0f, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0f;
    float y = f / (2.0f + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5f * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375f - ((square - rest) - f);
}

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

__constant float gnomon_texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
static inline float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
static inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
    return saturate_or_zero(share / look_ups);
}

#endif

// soft/mip_filter.h ---------------------------------------------------------------------------------------------------
// Filters of any width from a mip chain, round ones in place of the boxes of summed-area tables: a cubic B-spline over
// the texels of a level, by four bilinear look-ups (Sigg & Hadwiger 2005), mixed between two levels.
//
// The texels of level l are means over boxes of s = 2^l texels of the map, so that the spline at that level has the
// variance (1/3 + 1/12) s^2 along each axis. A box of a width w has w^2 / 12. Levels below and above mix so that both
// variances are equal:
//     w^2 / 12 = 5/12 4^l (1 + 3 f),    level = l + f,    f in [0, 1)
// Weights are not negative and sum to 1, so filtered moments are moments.
#ifndef GNOMON_SOFT_MIP_FILTER_H
#define GNOMON_SOFT_MIP_FILTER_H

__constant float mip_filter_fifth = 0.2f;
__constant float mip_filter_per_octave = 0.72134752044448170f; // 1 / ln 4
__constant float mip_filter_third = 0.33333333333333333f;
__constant float mip_filter_sixth = 0.16666666666666667f;

/// The level of a mip chain whose cubic B-spline has the variance of a box of this width in texels of the map; its
/// fraction is the share of the level above. At least 0, the level for widths up to sqrt 5.
/// Domain: any width, limited to [sqrt 5, 65536].
/// NaN: 0.
static inline float mip_filter_level(float width)
{
    float w = gnomon_max(gnomon_min(gnomon_texel_limit, width), 1.0f);
    float squares = gnomon_max(mip_filter_fifth * (w * w), 1.0f);
    float whole = texel_below(polynomial_log(squares) * mip_filter_per_octave);
    float power = gnomon_power_of_two(whole);
    float share = (squares / (power * power) - 1.0f) * mip_filter_third;
    return whole + saturate_or_zero(share);
}

/// Two bilinear look-ups along one axis that make a cubic B-spline: at the distances first and second from the centre
/// of the texel, the second with a weight and the first with the rest. first is in [-1, 0], second in [1, 2].
typedef struct mip_filter_taps mip_filter_taps;
struct mip_filter_taps { float first, second, weight; };

/// The look-ups for a place at a share of the way from the centre of its texel to the next.
/// Domain: share in [0, 1], clamped.
/// NaN: as 0.
/// Source: Sigg & Hadwiger 2005
static inline mip_filter_taps mip_filter_taps_at(float share)
{
    float u = saturate_or_zero(share);
    float v = 1.0f - u;
    // Six times the weights of the four texels.
    float w0 = v * v * v;
    float w1 = (3.0f * u - 6.0f) * (u * u) + 4.0f;
    float w2 = (3.0f * v - 6.0f) * (v * v) + 4.0f;
    float w3 = u * u * u;
    mip_filter_taps r;
    r.first = w1 / (w0 + w1) - 1.0f;
    r.second = w3 / (w2 + w3) + 1.0f;
    r.weight = (w2 + w3) * mip_filter_sixth;
    return r;
}

#endif

#endif
