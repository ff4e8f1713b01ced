// Gnomon 0.1.0, exponential.wgsl: shadow filtering in WGSL, this file alone.
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

// filters/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).

/// E[exp(c z)].
struct exponential_moment { warped: f32 }

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
struct exponential_settings { exponent: f32 }

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
fn exponential_encode(z: f32, settings: exponential_settings) -> exponential_moment
{
    var r: exponential_moment;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, -1.0, 1.0));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in
/// float shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
fn exponential_intensity(filtered: exponential_moment, z_f: f32, settings: exponential_settings) -> f32
{
    return saturate_or_zero(1.0 - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(1.0, z_f)));
}

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.

struct channels1_ { c1_: f32 }

struct channels2_ { c1_: f32, c2_: f32 }

struct channels5_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32 }

// moments/channels.h, four moments ------------------------------------------------------------------------------------

struct channels4_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32 }

// moments/channels.h, six moments -------------------------------------------------------------------------------------

struct channels6_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32, c6_: f32 }

// storage/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps in a storage format: from a depth to the channel of a texel, and from a filtered channel to a
// shadow, with the exponent of the format.
//
//   format      bytes   channel       write                      read
//   1 x float     4     exp(40 z)     exponential_float_encode   exponential_float_intensity
//
// A lit surface is darkened by rounding alone: 84 roundings of exp(40 z), two of the filter passes and their sums.

const exponential_float_exponent: f32 = 40.0; // exp(2 c) < 2^127
const exponential_float_darkening: f32 = 0x1.92a738p-18; // 6e-6

/// The channel of a 1 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_encode.
fn exponential_float_encode(z: f32) -> channels1_
{
    var settings: exponential_settings;
    settings.exponent = exponential_float_exponent;
    let b = exponential_encode(z, settings);
    var c: channels1_;
    c.c1_ = b.warped;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channel of a 1 x float texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as exponential_intensity.
fn exponential_float_intensity(c: channels1_, z_f: f32) -> f32
{
    var settings: exponential_settings;
    settings.exponent = exponential_float_exponent;
    var b: exponential_moment;
    b.warped = c.c1_;
    return exponential_intensity(b, z_f, settings);
}
