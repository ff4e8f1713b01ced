// Gnomon 0.1.0, cascade.wgsl: shadow filtering in WGSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.

// the language --------------------------------------------------------------------------------------------------------
// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no product is fused with a sum,
// neither of which WGSL can ask for (docs/shaders.md). Exact products stay whole in any case.

const gnomon_pivot_floor: f32 = 0x1p-30;

fn gnomon_select(mask: bool, a: f32, b: f32) -> f32 { return select(b, a, mask); }
fn gnomon_any(mask: bool) -> bool { return mask; }
fn gnomon_abs(a: f32) -> f32 { return abs(a); }
fn gnomon_sqrt(a: f32) -> f32 { return sqrt(a); }
// x, but nothing is fused, cancelled or reordered across a minimum of integers. Only bits of NaN are above this bound,
// which is one.
fn gnomon_kept(x: f32) -> f32 { return bitcast<f32>(min(bitcast<i32>(x), 0x7fc00000)); }
// x by another minimum, which hides one that is kept already.
fn gnomon_apart(x: f32) -> f32 { return bitcast<f32>(min(bitcast<u32>(x), 0xffc00000u)); }
fn gnomon_min(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a < b); }
fn gnomon_max(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a > b); }
fn gnomon_product(a: f32, b: f32) -> f32 { return gnomon_kept(a * b); }
fn gnomon_sum(a: f32, b: f32) -> f32 { return gnomon_kept(a + b); }
fn gnomon_difference(a: f32, b: f32) -> f32 { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
fn gnomon_saturate(x: f32) -> f32 {
    let bits = bitcast<i32>(x);
    return gnomon_select(bits > 0x7f800000, 0.0, bitcast<f32>(min(max(bits, 0), 0x3f800000)));
}
// a without the low half of its significand.
fn gnomon_high_part(a: f32) -> f32 { return bitcast<f32>(bitcast<u32>(a) & 0xfffff000u); }
// The sum has n in its low bits, and the shift moves n into the exponent.
fn gnomon_power_of_two(n: f32) -> f32 { return bitcast<f32>((bitcast<u32>(n + 12582912.0) << 23u) + 0x3f800000u); }

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
fn nearest_integer(x: f32) -> f32
{
    let rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
fn nearest_natural(x: f32) -> f32
{
    let rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
fn clamp_or_nan(x: f32, low: f32, high: f32) -> f32 { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
fn clamp_or_high(x: f32, low: f32, high: f32) -> f32 { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
fn saturate_or_zero(x: f32) -> f32 { return gnomon_saturate(x); }

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.

const gnomon_exp_log2_e: f32 = 0x1.715476p+0; // 1.4426950408889634
const gnomon_exp_ln2_low: f32 = -0x1.bd0106p-13; // -2.1219444005469058e-4
const gnomon_exp_sqrt_2_: f32 = 0x1.6a09e6p+0; // 1.4142135623730951
const gnomon_exp_sqrt_half: f32 = 0x1.6a09e6p-1; // 0.70710678118654752

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
const gnomon_exp_float_0_: f32 = 0x1.fffffcp-2; // 0.49999993561656014
const gnomon_exp_float_1_: f32 = 0x1.55549p-3; // 0.16666518908321371
const gnomon_exp_float_2_: f32 = 0x1.5558ccp-5; // 0.041668318723256166
const gnomon_exp_float_3_: f32 = 0x1.123ba4p-7; // 0.0083689258101569408
const gnomon_exp_float_4_: f32 = 0x1.6a4f86p-10; // 0.00138210541669496

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
const gnomon_log_float_0_: f32 = 0x1.55557ap-1; // 0.66666776085218282
const gnomon_log_float_1_: f32 = 0x1.995edp-2; // 0.39977574040563962
const gnomon_log_float_2_: f32 = 0x1.31e0dep-2; // 0.29870936689734456

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
fn gnomon_exp_remainder(r: f32) -> f32
{
    let p = gnomon_exp_float_0_ + r *
            (gnomon_exp_float_1_ + r * (gnomon_exp_float_2_ + r * (gnomon_exp_float_3_ + r * gnomon_exp_float_4_)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
fn polynomial_exp(given_x: f32) -> f32
{
    var x = given_x;
    let low = -87.0;
    let high = 88.0;
    x = clamp_or_nan(x, low, high);
    let n = nearest_integer(x * gnomon_exp_log2_e);
    let r = gnomon_difference(x, n * 0.693359375) - n * gnomon_exp_ln2_low;
    return (1.0 + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct gnomon_scaled_number { significand: f32, exponent: f32 }

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
fn gnomon_scaled_number_step(s: gnomon_scaled_number, k: f32) -> gnomon_scaled_number
{
    let up = gnomon_power_of_two(k);
    let down = gnomon_power_of_two(-k);
    let large = up <= s.significand;
    let tiny = s.significand <= down;
    var r: gnomon_scaled_number;
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
fn polynomial_log(x: f32) -> f32
{
    var s: gnomon_scaled_number;
    s.exponent = 0.0;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0), gnomon_power_of_two(127.0));
    s = gnomon_scaled_number_step(s, 64.0);
    s = gnomon_scaled_number_step(s, 32.0);
    s = gnomon_scaled_number_step(s, 16.0);
    s = gnomon_scaled_number_step(s, 8.0);
    s = gnomon_scaled_number_step(s, 4.0);
    s = gnomon_scaled_number_step(s, 2.0);
    s = gnomon_scaled_number_step(s, 1.0);
    let large = gnomon_exp_sqrt_2_ < s.significand;
    let tiny = s.significand < gnomon_exp_sqrt_half;
    let m = gnomon_select(large, s.significand * 0.5, gnomon_select(tiny, s.significand * 2.0, s.significand));
    let n = gnomon_select(large, s.exponent + 1.0, gnomon_select(tiny, s.exponent - 1.0, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    let f = m - 1.0;
    let y = f / (2.0 + f);
    let z = y * y;
    let p = gnomon_log_float_0_ + z * (gnomon_log_float_1_ + z * gnomon_log_float_2_);
    let square = 0.5 * f * f;
    let rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375 - ((square - rest) - f);
}

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

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
fn cascade_split(near_distance: f32, far_distance: f32, fraction: f32, evenness: f32) -> f32
{
    let f = saturate_or_zero(fraction);
    let e = saturate_or_zero(evenness);
    let logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    let even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
fn gnomon_cascade_inside(distance_inside: f32, band: f32) -> f32
{
    let w = saturate_or_zero(distance_inside / gnomon_select(0.0 < band, band, 1.0));
    return gnomon_select(0.0 < band, w, gnomon_select(0.0 <= distance_inside, 1.0, 0.0));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end,
/// 0 from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
fn cascade_weight_by_distance(distance_: f32, end_distance: f32, band: f32) -> f32
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
fn cascade_weight_by_projection(u: f32, v: f32, z: f32, margin: f32, band: f32) -> f32
{
    let x = gnomon_abs(u - 0.5);
    let y = gnomon_abs(v - 0.5);
    let inside = (0.5 - margin) - gnomon_max(y, x);
    let known = y <= 0.5 && gnomon_abs(z) <= 1.0; // a NaN in u is one in inside
    return gnomon_select(known, gnomon_cascade_inside(inside, band), 0.0);
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
struct cascade_blend { intensity: f32, rest: f32 }

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
fn cascade_share(state: cascade_blend, weight: f32) -> f32
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
fn cascade_add(given_state: cascade_blend, weight: f32, intensity: f32) -> cascade_blend
{
    var state = given_state;
    let share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
fn cascade_begin(weight: f32, intensity: f32) -> cascade_blend
{
    var r: cascade_blend;
    r.intensity = 0.0;
    r.rest = 1.0;
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
fn cascade_end(state: cascade_blend) -> f32 { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
struct cascade_index { index: f32, searching: f32 }

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds
/// threshold, or as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
fn cascade_index_add(given_state: cascade_index, weight: f32, threshold: f32) -> cascade_index
{
    var state = given_state;
    state.searching = gnomon_select(threshold < weight, 0.0, state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
fn cascade_index_begin(weight: f32, threshold: f32) -> cascade_index
{
    var r: cascade_index;
    r.index = 0.0;
    r.searching = 1.0;
    return cascade_index_add(r, weight, threshold);
}
