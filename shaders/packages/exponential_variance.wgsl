// Gnomon 0.1.0, exponential_variance.wgsl: shadow filtering in WGSL, this file alone.
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

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { mean: f32, square: f32 }

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { minimum_variance: f32 }

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn variance_encode(z: f32) -> variance_moments
{
    var r: variance_moments;
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
fn cantelli_lower(moments: variance_moments, receiver: f32, minimum_variance: f32) -> f32
{
    let variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    let d = gnomon_max(0.0, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
fn variance_intensity(filtered: variance_moments, z_f: f32, settings: variance_settings) -> f32
{
    return cantelli_lower(filtered, gnomon_min(1.0, z_f), settings.minimum_variance);
}

// filters/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.

/// First and second moment of either warped depth.
struct exponential_variance_moments { positive: f32, positive_square: f32, negative: f32, negative_square: f32 }

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
struct exponential_variance_settings { positive_exponent: f32, negative_exponent: f32, minimum_variance: f32 }

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
fn gnomon_exponential_variance_warp(z: f32, settings: exponential_variance_settings) -> exponential_variance_moments
{
    var r: exponential_variance_moments;
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
fn exponential_variance_encode(z: f32, settings: exponential_variance_settings) -> exponential_variance_moments
{
    return gnomon_exponential_variance_warp(clamp_or_high(z, -1.0, 1.0), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
fn exponential_variance_side(given_moments: variance_moments, warped: f32, exponent: f32, minimum_variance: f32) -> f32
{
    var moments = given_moments;
    let scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < 1.0, 1125899906842624.0, 1.0);
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    let slope = exponent * (warped * scale);
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
fn exponential_variance_intensity(filtered: exponential_variance_moments, z_f: f32,
                                  settings: exponential_variance_settings) -> f32
{
    var positive: variance_moments;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    var negative: variance_moments;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    let receiver = gnomon_exponential_variance_warp(clamp_or_nan(z_f, -1.0, 1.0), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
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

const exponential_variance_half_exponent: f32 = 0x1.628f5cp+2; // 5.54, both; exp(2 c) fills a half
const exponential_variance_half_minimum_variance: f32 = 0x1.d07deep-18; // 6.921468870293247e-6, 99 (3 2^-11 / 5.54)^2
const exponential_variance_half_darkening: f32 = 0x1.47ae14p-7; // 0.01
const exponential_variance_float_positive_exponent: f32 = 40.0;
const exponential_variance_float_negative_exponent: f32 = 0x1.628f5cp+2; // 5.54
// 4.41137400169126e-12, 99 (3 2^-24 (1 + 1 / 5.54))^2
const exponential_variance_float_minimum_variance: f32 = 0x1.366c4p-38;
const exponential_variance_float_darkening: f32 = 0x1.47ae14p-7; // 0.01

/// The channels of the filter with the given settings for a depth z.
fn gnomon_exponential_variance_to_channels(z: f32, settings: exponential_variance_settings) -> channels4_
{
    let b = exponential_variance_encode(z, settings);
    var c: channels4_;
    c.c1_ = b.positive;
    c.c2_ = b.positive_square;
    c.c3_ = b.negative;
    c.c4_ = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
fn gnomon_exponential_variance_of_channels(c: channels4_, z_f: f32, settings: exponential_variance_settings) -> f32
{
    var b: exponential_variance_moments;
    b.positive = c.c1_;
    b.positive_square = c.c2_;
    b.negative = c.c3_;
    b.negative_square = c.c4_;
    return exponential_variance_intensity(b, z_f, settings);
}

/// The four channels of a 4 x half texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
fn exponential_variance_half_encode(z: f32) -> channels4_
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
fn exponential_variance_half_intensity(c: channels4_, z_f: f32) -> f32
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
fn exponential_variance_float_encode(z: f32) -> channels4_
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
fn exponential_variance_float_intensity(c: channels4_, z_f: f32) -> f32
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}
