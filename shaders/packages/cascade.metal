// Gnomon 0.1.0, cascade.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_CASCADE_METAL
#define GNOMON_CASCADE_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: cascade.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: cascade.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: cascade.metal is not of the same version as a package before it"
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

// filters/cascade.h ---------------------------------------------------------------------------------------------------
// Cascades of one light: shadow maps of growing regions around the camera, the finest first (Engel 2006; Zhang et al.
// 2006). Every cascade has a weight in [0, 1] at a receiver: 1 within its region, falling to 0 over a band at its
// border. By view distance the regions are slices of the camera's frustum, by projection they are the maps' own
// squares, which reach farther. Over the maps front to back, intensities blend as layers do:
//
//     state = cascade_begin(weight, intensity);            for the finest cascade
//     state = cascade_add(state, weight, intensity);       for every other, the finer ones first
//     intensity = cascade_end(state);                      lit beyond the last one
//
// cascade_share is the part that the next cascade has in the result; a cascade with a share of 0 need not be read. One
// look-up for each receiver is enough where noise is filtered later: cascade_index_add finds the first cascade whose
// weight exceeds a threshold. The mean over thresholds drawn evenly from [0, 1) is the blend, as long as at most one
// weight lies between 0 and 1.
#ifndef GNOMON_FILTERS_CASCADE_H
#define GNOMON_FILTERS_CASCADE_H

namespace gnomon {

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
inline float cascade_split(float near_distance, float far_distance, float fraction, float evenness)
{
    float f = saturate_or_zero(fraction);
    float e = saturate_or_zero(evenness);
    float logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    float even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
inline float cascade_inside(float distance_inside, float band)
{
    float w = saturate_or_zero(distance_inside / gnomon_select(0.0f < band, band, 1.0f));
    return gnomon_select(0.0f < band, w, gnomon_select(0.0f <= distance_inside, 1.0f, 0.0f));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end,
/// 0 from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
inline float cascade_weight_by_distance(float distance_, float end_distance, float band)
{
    return cascade_inside(end_distance - distance_, band);
}

/// The weight in [0, 1] of a cascade at texture coordinates u, v in its map and signed depth z: 1 in the middle,
/// falling over a band to 0 at margin from the border of [0, 1] x [0, 1]. margin is the reach of filter and blur in
/// texture coordinates, so that no filter reads over the map's edge. z before the near plane or beyond the far plane
/// has weight 0: casters are moved to the near plane when the map is rendered, receivers are not.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p over band.
inline float cascade_weight_by_projection(float u, float v, float z, float margin, float band)
{
    float x = gnomon_abs(u - 0.5f);
    float y = gnomon_abs(v - 0.5f);
    float inside = (0.5f - margin) - gnomon_max(y, x);
    bool known = y <= 0.5f && gnomon_abs(z) <= 1.0f; // a NaN in u is one in inside
    return gnomon_select(known, cascade_inside(inside, band), 0.0f);
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
struct cascade_blend { float intensity, rest; };

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
inline float cascade_share(cascade_blend state, float weight)
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
inline cascade_blend cascade_add(cascade_blend state, float weight, float intensity)
{
    float share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
inline cascade_blend cascade_begin(float weight, float intensity)
{
    cascade_blend r;
    r.intensity = 0.0f;
    r.rest = 1.0f;
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
inline float cascade_end(cascade_blend state) { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
struct cascade_index { float index, searching; };

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds
/// threshold, or as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
inline cascade_index cascade_index_add(cascade_index state, float weight, float threshold)
{
    state.searching = gnomon_select(threshold < weight, 0.0f, state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
inline cascade_index cascade_index_begin(float weight, float threshold)
{
    cascade_index r;
    r.index = 0.0f;
    r.searching = 1.0f;
    return cascade_index_add(r, weight, threshold);
}

} // namespace gnomon

#endif

#endif
