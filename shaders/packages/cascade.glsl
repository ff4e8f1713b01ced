// Gnomon 0.1.0, cascade.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_CASCADE_GLSL
#define GNOMON_CASCADE_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: cascade.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: cascade.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: cascade.glsl is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

const float gnomon_exp_log2_e = 1.4426950408889634;
const float gnomon_exp_ln2_low = -2.1219444005469058e-4;
const float gnomon_exp_sqrt_2 = 1.4142135623730951;
const float gnomon_exp_sqrt_half = 0.70710678118654752;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
const float gnomon_exp_float_0 = 0.49999993561656014;
const float gnomon_exp_float_1 = 0.16666518908321371;
const float gnomon_exp_float_2 = 0.041668318723256166;
const float gnomon_exp_float_3 = 0.0083689258101569408;
const float gnomon_exp_float_4 = 0.00138210541669496;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
const float gnomon_log_float_0 = 0.66666776085218282;
const float gnomon_log_float_1 = 0.39977574040563962;
const float gnomon_log_float_2 = 0.29870936689734456;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
float gnomon_exp_remainder(float r)
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
float polynomial_exp(float x)
{
    float low = -87.0;
    float high = 88.0;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375) - n * gnomon_exp_ln2_low;
    return (1.0 + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
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
float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0), gnomon_power_of_two(127.0));
    s = gnomon_scaled_number_step(s, 64.0);
    s = gnomon_scaled_number_step(s, 32.0);
    s = gnomon_scaled_number_step(s, 16.0);
    s = gnomon_scaled_number_step(s, 8.0);
    s = gnomon_scaled_number_step(s, 4.0);
    s = gnomon_scaled_number_step(s, 2.0);
    s = gnomon_scaled_number_step(s, 1.0);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5, gnomon_select(tiny, s.significand * 2.0, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0, gnomon_select(tiny, s.exponent - 1.0, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0;
    float y = f / (2.0 + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5 * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375 - ((square - rest) - f);
}

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

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
float cascade_split(float near_distance, float far_distance, float fraction, float evenness)
{
    float f = saturate_or_zero(fraction);
    float e = saturate_or_zero(evenness);
    float logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    float even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
float gnomon_cascade_inside(float distance_inside, float band)
{
    float w = saturate_or_zero(distance_inside / gnomon_select(0.0 < band, band, 1.0));
    return gnomon_select(0.0 < band, w, gnomon_select(0.0 <= distance_inside, 1.0, 0.0));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end,
/// 0 from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
float cascade_weight_by_distance(float distance_, float end_distance, float band)
{
    return gnomon_cascade_inside(end_distance - distance_, band);
}

/// The weight in [0, 1] of a cascade at texture coordinates u, v in its map and signed depth z: 1 in the middle,
/// falling over a band to 0 at margin from the border of [0, 1] x [0, 1]. margin is the reach of filter and blur in
/// texture coordinates, so that no filter reads over the map's edge. z before the near plane or beyond the far plane
/// has weight 0: casters are moved to the near plane when the map is rendered, receivers are not.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p over band.
float cascade_weight_by_projection(float u, float v, float z, float margin, float band)
{
    float x = gnomon_abs(u - 0.5);
    float y = gnomon_abs(v - 0.5);
    float inside = (0.5 - margin) - gnomon_max(y, x);
    bool known = y <= 0.5 && gnomon_abs(z) <= 1.0; // a NaN in u is one in inside
    return gnomon_select(known, gnomon_cascade_inside(inside, band), 0.0);
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
struct cascade_blend { float intensity, rest; };

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
float cascade_share(cascade_blend state, float weight)
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
cascade_blend cascade_add(cascade_blend state, float weight, float intensity)
{
    float share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
cascade_blend cascade_begin(float weight, float intensity)
{
    cascade_blend r;
    r.intensity = 0.0;
    r.rest = 1.0;
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
float cascade_end(cascade_blend state) { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
struct cascade_index { float index, searching; };

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds
/// threshold, or as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
cascade_index cascade_index_add(cascade_index state, float weight, float threshold)
{
    state.searching = gnomon_select(threshold < weight, 0.0, state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
cascade_index cascade_index_begin(float weight, float threshold)
{
    cascade_index r;
    r.index = 0.0;
    r.searching = 1.0;
    return cascade_index_add(r, weight, threshold);
}

#endif

#endif
