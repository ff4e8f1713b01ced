// Gnomon 0.1.0, mip_filter.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.

const gnomon_texel_limit: f32 = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
fn texel_below(x: f32) -> f32
{
    let limit = gnomon_texel_limit;
    let inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    let whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
fn texel_weight(u: f32, i: f32, look_ups: f32) -> f32
{
    var share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

// soft/mip_filter.h ---------------------------------------------------------------------------------------------------
// Filters of any width from a mip chain, round ones in place of the boxes of summed-area tables: a cubic B-spline over
// the texels of a level, by four bilinear look-ups (Sigg & Hadwiger 2005), mixed between two levels.
//
// The texels of level l are means over boxes of s = 2^l texels of the map, so that the spline at that level has the
// variance (1/3 + 1/12) s^2 along each axis. A box of a width w has w^2 / 12. Levels below and above mix so that both
// variances are equal:
//     w^2 / 12 = 5/12 4^l (1 + 3 f),    level = l + f,    f in [0, 1)
// Weights are not negative and sum to 1, so filtered moments are moments.

const mip_filter_fifth: f32 = 0x1.99999ap-3; // 0.2
const mip_filter_per_octave: f32 = 0x1.715476p-1; // 0.72134752044448170, 1 / ln 4
const mip_filter_third: f32 = 0x1.555556p-2; // 0.33333333333333333
const mip_filter_sixth: f32 = 0x1.555556p-3; // 0.16666666666666667

/// The level of a mip chain whose cubic B-spline has the variance of a box of this width in texels of the map; its
/// fraction is the share of the level above. At least 0, the level for widths up to sqrt 5.
/// Domain: any width, limited to [sqrt 5, 65536].
/// NaN: 0.
fn mip_filter_level(width: f32) -> f32
{
    let w = gnomon_max(gnomon_min(gnomon_texel_limit, width), 1.0);
    let squares = gnomon_max(mip_filter_fifth * (w * w), 1.0);
    let whole = texel_below(polynomial_log(squares) * mip_filter_per_octave);
    let power = gnomon_power_of_two(whole);
    let share = (squares / (power * power) - 1.0) * mip_filter_third;
    return whole + saturate_or_zero(share);
}

/// Two bilinear look-ups along one axis that make a cubic B-spline: at the distances first and second from the centre
/// of the texel, the second with a weight and the first with the rest. first is in [-1, 0], second in [1, 2].
struct mip_filter_taps { first: f32, second: f32, weight: f32 }

/// The look-ups for a place at a share of the way from the centre of its texel to the next.
/// Domain: share in [0, 1], clamped.
/// NaN: as 0.
/// Source: Sigg & Hadwiger 2005
fn mip_filter_taps_at(share: f32) -> mip_filter_taps
{
    let u = saturate_or_zero(share);
    let v = 1.0 - u;
    // Six times the weights of the four texels.
    let w0 = v * v * v;
    let w1 = (3.0 * u - 6.0) * (u * u) + 4.0;
    let w2 = (3.0 * v - 6.0) * (v * v) + 4.0;
    let w3 = u * u * u;
    var r: mip_filter_taps;
    r.first = w1 / (w0 + w1) - 1.0;
    r.second = w3 / (w2 + w3) + 1.0;
    r.weight = (w2 + w3) * mip_filter_sixth;
    return r;
}
