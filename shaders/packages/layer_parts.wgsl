// Gnomon 0.1.0, layer_parts.wgsl: shadow filtering in WGSL, this file alone.
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

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_unit(z: f32) -> f32 { return z * 2.0 - 1.0; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_reversed(z: f32) -> f32 { return 1.0 - z * 2.0; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
fn depth_from_distance(distance_: f32, near_distance: f32, far_distance: f32) -> f32
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
fn gnomon_depth_between(n: f32, f: f32) -> f32 { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0 - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_reversed_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * (1.0 - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
fn depth_from_reversed_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = gnomon_abs(clamp_or_nan(z, 0.0, 1.0)); // -0 is the far plane, too
    let depth = (near_distance * (1.0 - x) - (far_distance * x - near_distance)) / (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0, 1.0);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
fn depth_from_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    return depth_from_reversed_infinite(1.0 - z, near_distance, far_distance);
}

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.

struct moments4_ { b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
fn moments4_from_depth(z: f32) -> moments4_
{
    var b: moments4_;
    b.b1_ = z;
    b.b2_ = z * z;
    b.b3_ = b.b2_ * z;
    b.b4_ = b.b2_ * b.b2_;
    return b;
}

/// b times weight: the first term of a linear combination.
fn moments4_scale(given_b: moments4_, weight: f32) -> moments4_
{
    var b = given_b;
    b.b1_ = b.b1_ * weight;
    b.b2_ = b.b2_ * weight;
    b.b3_ = b.b3_ * weight;
    b.b4_ = b.b4_ * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
fn moments4_add(given_sum: moments4_, b: moments4_, weight: f32) -> moments4_
{
    var sum = given_sum;
    sum.b1_ = sum.b1_ + b.b1_ * weight;
    sum.b2_ = sum.b2_ + b.b2_ * weight;
    sum.b3_ = sum.b3_ + b.b3_ * weight;
    sum.b4_ = sum.b4_ + b.b4_ * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
fn moments4_from_unit(c: moments4_) -> moments4_
{
    var b: moments4_;
    b.b1_ = 2.0 * c.b1_ - 1.0;
    b.b2_ = 4.0 * (c.b2_ - c.b1_) + 1.0;
    b.b3_ = (8.0 * c.b3_ - 12.0 * c.b2_) + (6.0 * c.b1_ - 1.0);
    b.b4_ = 16.0 * (c.b4_ - 2.0 * c.b3_) + (24.0 * c.b2_ - 8.0 * c.b1_ + 1.0);
    return b;
}

// moments/moments.h, six moments --------------------------------------------------------------------------------------

struct moments6_ { b1_: f32, b2_: f32, b3_: f32, b4_: f32, b5_: f32, b6_: f32 }

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
fn moments6_from_depth(z: f32) -> moments6_
{
    var b: moments6_;
    b.b1_ = z;
    b.b2_ = z * z;
    b.b3_ = b.b2_ * z;
    b.b4_ = b.b2_ * b.b2_;
    b.b5_ = b.b4_ * z;
    b.b6_ = b.b3_ * b.b3_;
    return b;
}

/// b times weight: the first term of a linear combination.
fn moments6_scale(given_b: moments6_, weight: f32) -> moments6_
{
    var b = given_b;
    b.b1_ = b.b1_ * weight;
    b.b2_ = b.b2_ * weight;
    b.b3_ = b.b3_ * weight;
    b.b4_ = b.b4_ * weight;
    b.b5_ = b.b5_ * weight;
    b.b6_ = b.b6_ * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
fn moments6_add(given_sum: moments6_, b: moments6_, weight: f32) -> moments6_
{
    var sum = given_sum;
    sum.b1_ = sum.b1_ + b.b1_ * weight;
    sum.b2_ = sum.b2_ + b.b2_ * weight;
    sum.b3_ = sum.b3_ + b.b3_ * weight;
    sum.b4_ = sum.b4_ + b.b4_ * weight;
    sum.b5_ = sum.b5_ + b.b5_ * weight;
    sum.b6_ = sum.b6_ + b.b6_ * weight;
    return sum;
}

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

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
fn bias_weight_of_roundings(w: f32, n: f32) -> f32
{
    let nw = gnomon_max(1.0, n) * w;
    return nw / ((1.0 - w) + nw);
}

// moments/bias.h, four moments ----------------------------------------------------------------------------------------

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
const bias4_raw_b2_: f32 = 0x1.a7e824p-2; // 0.41397147664677789
const bias4_raw_b4_: f32 = 0x1.a7e824p-2; // 0.41397147664677789
const bias4_raw_paper_b2_: f32 = 0.375;
const bias4_raw_paper_b4_: f32 = 0.375;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
const bias4_theta_b2_: f32 = 0x1.53ec94p-1; // 0.66391434671237689
const bias4_theta_b4_: f32 = 0x1.53ec94p-1; // 0.66391434671237689
const bias4_theta_paper_b2_: f32 = 0x1.418938p-1; // 0.628
const bias4_theta_paper_b4_: f32 = 0x1.418938p-1; // 0.628

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
fn moments4_add_bias(given_b: moments4_, bias2: f32, bias4: f32, alpha: f32) -> moments4_
{
    var b = given_b;
    let keep = 1.0 - alpha;
    b.b1_ = keep * b.b1_;
    b.b2_ = keep * b.b2_ + alpha * bias2;
    b.b3_ = keep * b.b3_;
    b.b4_ = keep * b.b4_ + alpha * bias4;
    return b;
}

// moments/bias.h, six moments -----------------------------------------------------------------------------------------

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
const bias6_raw_b2_: f32 = 0x1.ae3cc8p-2; // 0.42015374983242804
const bias6_raw_b4_: f32 = 0x1.268268p-2; // 0.2876068288776971
const bias6_raw_b6_: f32 = 0x1.077bbcp-2; // 0.25730795870391842

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
const gnomon_bias6_theta_b2_: f32 = 0x1.39c714p-1; // 0.61284694380550628
const gnomon_bias6_theta_b4_: f32 = 0x1.0ca57p-1; // 0.52469968779048582
const gnomon_bias6_theta_b6_: f32 = 0x1.025ee6p-1; // 0.50463026403505464
const bias6_paper_b2_: f32 = 0x1.1cfaacp-1; // 0.5566
const bias6_paper_b4_: f32 = 0x1.f4bc6ap-2; // 0.489
const bias6_paper_b6_: f32 = 0x1.ea2eb6p-2; // 0.47869382

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
fn moments6_add_bias(given_b: moments6_, bias2: f32, bias4: f32, bias6: f32, alpha: f32) -> moments6_
{
    var b = given_b;
    let keep = 1.0 - alpha;
    b.b1_ = keep * b.b1_;
    b.b2_ = keep * b.b2_ + alpha * bias2;
    b.b3_ = keep * b.b3_;
    b.b4_ = keep * b.b4_ + alpha * bias4;
    b.b5_ = keep * b.b5_;
    b.b6_ = keep * b.b6_ + alpha * bias6;
    return b;
}

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.

/// The unevaluated sum high + low.
struct gnomon_double_word { high: f32, low: f32 }

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
fn gnomon_dekker_product_error(a: f32, b: f32, p: f32) -> f32
{
    let ah = gnomon_high_part(a);
    let bh = gnomon_high_part(b);
    let al = gnomon_difference(a, ah);
    let bl = gnomon_difference(b, bh);
    let e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
fn two_product(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
fn two_difference(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    let bv = gnomon_difference(r.high, a);
    let av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
fn two_difference_ordered(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product_ordered(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
fn subtract_product_rounded(c: f32, a: f32, b: f32) -> f32
{
    let p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
fn gnomon_double_word_minor(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word,
                            d: gnomon_double_word) -> gnomon_double_word
{
    let p = two_product(a.high, b.high);
    let q = two_product(c.high, d.high);
    var r = two_difference(p.high, q.high);
    let cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
fn gnomon_double_word_determinant(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word) -> f32
{
    let p = two_product(a.high, c.high);
    let q = two_product(b.high, b.high);
    let cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
fn gnomon_covariance_add_bias(given_c: gnomon_double_word, b_i: f32, b_j: f32, e_ij: f32, e_i: f32,
                              e_j: f32) -> gnomon_double_word
{
    var c = given_c;
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

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

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
struct hankel4_ { mean: f32, variance: f32, third: f32, determinant: f32 }

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
fn gnomon_hankel4_make(mean: f32, variance: f32, covariance: f32, determinant: f32) -> hankel4_
{
    var h: hankel4_;
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
fn hankel4_from_moments(b: moments4_) -> hankel4_
{
    let v = b.b2_ - b.b1_ * b.b1_;
    let l = b.b3_ - b.b1_ * b.b2_;
    let m = b.b4_ - b.b2_ * b.b2_;
    return gnomon_hankel4_make(b.b1_, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
struct gnomon_covariances4_ { v: gnomon_double_word, l: gnomon_double_word, m: gnomon_double_word }

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
fn gnomon_covariances4_from_moments(b: moments4_) -> gnomon_covariances4_
{
    var c: gnomon_covariances4_;
    c.v = subtract_product_ordered(b.b2_, b.b1_, b.b1_);
    c.l = subtract_product(b.b3_, b.b1_, b.b2_);
    c.m = subtract_product_ordered(b.b4_, b.b2_, b.b2_);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
fn gnomon_hankel4_with_change(b: moments4_, e: moments4_) -> hankel4_
{
    let c = gnomon_covariances4_from_moments(b);
    let v = gnomon_covariance_add_bias(c.v, b.b1_, b.b1_, e.b2_, e.b1_, e.b1_);
    let l = gnomon_covariance_add_bias(c.l, b.b1_, b.b2_, e.b3_, e.b1_, e.b2_);
    let m = gnomon_covariance_add_bias(c.m, b.b2_, b.b2_, e.b4_, e.b2_, e.b2_);
    return gnomon_hankel4_make(b.b1_ + e.b1_, v.high + v.low, l.high + l.low, gnomon_double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
fn hankel4_constant_bias(b: moments4_, bias2: f32, bias4: f32, alpha: f32) -> hankel4_
{
    var e: moments4_;
    e.b1_ = -1.0 * alpha * b.b1_;
    e.b2_ = alpha * (bias2 - b.b2_);
    e.b3_ = -1.0 * alpha * b.b3_;
    e.b4_ = alpha * (bias4 - b.b4_);
    return gnomon_hankel4_with_change(b, e);
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

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.

/// The moments that a format without transform holds as they are.
fn moments4_from_channels(c: channels4_) -> moments4_
{
    var b: moments4_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    return b;
}

/// The moments b as the channels of a format without transform.
fn channels4_from_moments(b: moments4_) -> channels4_
{
    var c: channels4_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    return c;
}

const gnomon_theta4_31_: f32 = 0x1.bb67aep-1; // 0.8660254037844386, sqrt(3) / 2
const gnomon_theta4_33_: f32 = -0x1.8a2346p-2; // -0.38490017945975052, -2 sqrt(3) / 9
const gnomon_theta4_inverse11_: f32 = -0x1.555556p-2; // -0.33333333333333331
const gnomon_theta4_inverse13_: f32 = 0x1.bb67aep+0; // 1.7320508075688772
const gnomon_theta4_inverse33_: f32 = 0x1.4c8dc2p+0; // 1.299038105676658

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
fn theta4_(b: moments4_) -> channels4_
{
    var c: channels4_;
    c.c1_ = 1.5 * b.b1_ - 2.0 * b.b3_ + 0.5;
    c.c2_ = 4.0 * (b.b2_ - b.b4_);
    c.c3_ = gnomon_theta4_31_ * b.b1_ + gnomon_theta4_33_ * b.b3_ + 0.5;
    c.c4_ = 0.5 * (b.b2_ + b.b4_);
    return c;
}

/// The four moments of channels c: the inverse of theta4_.
/// Source: Peters 2017, Eq. 3
fn theta4_inverse(c: channels4_) -> moments4_
{
    let c1 = c.c1_ - 0.5;
    let c3 = c.c3_ - 0.5;
    var b: moments4_;
    b.b1_ = gnomon_theta4_inverse11_ * c1 + gnomon_theta4_inverse13_ * c3;
    b.b2_ = 0.125 * c.c2_ + c.c4_;
    b.b3_ = gnomon_theta4_inverse33_ * c3 - 0.75 * c1;
    b.b4_ = c.c4_ - 0.125 * c.c2_;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
fn theta4_inverse_add_bias(c: channels4_, bias: f32, alpha: f32) -> moments4_
{
    let keep = 1.0 - alpha;
    let c1 = c.c1_ - 0.5;
    let c3 = c.c3_ - 0.5;
    let c2 = (0.125 * keep) * c.c2_;
    let c4 = keep * c.c4_ + alpha * bias;
    var b: moments4_;
    b.b1_ = (keep * gnomon_theta4_inverse11_) * c1 + (keep * gnomon_theta4_inverse13_) * c3;
    b.b2_ = c4 + c2;
    b.b3_ = (keep * gnomon_theta4_inverse33_) * c3 - (0.75 * keep) * c1;
    b.b4_ = c4 - c2;
    return b;
}

// moments/quantization.h, six moments ---------------------------------------------------------------------------------

/// The moments that a format without transform holds as they are.
fn moments6_from_channels(c: channels6_) -> moments6_
{
    var b: moments6_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    b.b5_ = c.c5_;
    b.b6_ = c.c6_;
    return b;
}

/// The moments b as the channels of a format without transform.
fn channels6_from_moments(b: moments6_) -> channels6_
{
    var c: channels6_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    c.c5_ = b.b5_;
    c.c6_ = b.b6_;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
const gnomon_theta6_21_: f32 = -0x1.dfe44ap+0; // -1.8745771666290014
const gnomon_theta6_23_: f32 = 0x1.0d193ap+2; // 4.204664766466248
const gnomon_theta6_25_: f32 = -0x1.d4809ep+0; // -1.8300875998372463
const gnomon_theta6_31_: f32 = 0x1.43abfep+0; // 1.2643431422063351
const gnomon_theta6_33_: f32 = -0x1.78bbd6p+0; // -1.4716161665593888
const gnomon_theta6_35_: f32 = 0x1.6a1fbp-1; // 0.70727302435305361
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
const gnomon_theta6_62_: f32 = -0x1.279a74p-1; // -0.57735026918962573
const gnomon_theta6_64_: f32 = 0x1.279a74p+2; // 4.6188021535170058
const gnomon_theta6_66_: f32 = -0x1.8a2346p+1; // -3.0792014356780042
const gnomon_theta6_60_: f32 = 0x1.353e8cp-6; // 0.018874775675311862
const gnomon_theta6_inverse11_: f32 = -0x1.d1831cp-6; // -0.02841260648183782
const gnomon_theta6_inverse12_: f32 = 0x1.e73ec6p-2; // 0.47582541301272185
const gnomon_theta6_inverse13_: f32 = 0x1.8d765ap+0; // 1.552587193469116
const gnomon_theta6_inverse31_: f32 = 0x1.99b124p-4; // 0.10002244957859331
const gnomon_theta6_inverse32_: f32 = 0x1.b09f56p-1; // 0.84496560893955308
const gnomon_theta6_inverse33_: f32 = 0x1.0e1544p+0; // 1.0550119414818537
const gnomon_theta6_inverse51_: f32 = 0x1.091eeap-2; // 0.25890700149881596
const gnomon_theta6_inverse52_: f32 = 0x1.d0a55cp-1; // 0.90751156960796575
const gnomon_theta6_inverse53_: f32 = 0x1.aacb3p-1; // 0.83358142889321829
const gnomon_theta6_inverse_sixth: f32 = 0x1.555556p-3; // 0.16666666666666666
const gnomon_theta6_inverse23_: f32 = 0x1.bb67aep-1; // 0.8660254037844386
const gnomon_theta6_inverse63_: f32 = 0x1.9fb134p-1; // 0.81189881604791125

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
fn theta6_(b: moments6_) -> channels6_
{
    var c: channels6_;
    c.c1_ = 2.5 * b.b1_ - 10.0 * b.b3_ + 8.0 * b.b5_ + 0.5;
    c.c2_ = gnomon_theta6_21_ * b.b1_ + gnomon_theta6_23_ * b.b3_ + gnomon_theta6_25_ * b.b5_ + 0.5;
    c.c3_ = gnomon_theta6_31_ * b.b1_ + gnomon_theta6_33_ * b.b3_ + gnomon_theta6_35_ * b.b5_ + 0.5;
    c.c4_ = 4.0 * (b.b2_ - b.b4_);
    c.c5_ = 9.0 * b.b2_ - 24.0 * b.b4_ + 16.0 * b.b6_;
    c.c6_ = gnomon_theta6_62_ * b.b2_ + gnomon_theta6_64_ * b.b4_ + gnomon_theta6_66_ * b.b6_ + gnomon_theta6_60_;
    return c;
}

/// The six moments of channels c: the inverse of theta6_.
/// Source: Peters 2017, Sec. 5.4.3
fn theta6_inverse(c: channels6_) -> moments6_
{
    let c1 = c.c1_ - 0.5;
    let c2 = c.c2_ - 0.5;
    let c3 = c.c3_ - 0.5;
    let c5 = gnomon_theta6_inverse_sixth * c.c5_;
    let c6 = c.c6_ - gnomon_theta6_60_;
    var b: moments6_;
    b.b1_ = gnomon_theta6_inverse11_ * c1 + gnomon_theta6_inverse12_ * c2 + gnomon_theta6_inverse13_ * c3;
    b.b3_ = gnomon_theta6_inverse31_ * c1 + gnomon_theta6_inverse32_ * c2 + gnomon_theta6_inverse33_ * c3;
    b.b5_ = gnomon_theta6_inverse51_ * c1 + gnomon_theta6_inverse52_ * c2 + gnomon_theta6_inverse53_ * c3;
    b.b2_ = c5 + gnomon_theta6_inverse23_ * c6;
    b.b4_ = (c5 + gnomon_theta6_inverse23_ * c6) - 0.25 * c.c4_;
    b.b6_ = (0.21875 * c.c5_ + gnomon_theta6_inverse63_ * c6) - 0.375 * c.c4_;
    return b;
}

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

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
struct gnomon_certificate4_ { top: f32, s0_: f32, s1_: f32, s2_: f32, s3_: f32, s4_: f32 }

const gnomon_certificate4_nothing: f32 = -1267650600228229401496703205376.0; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
fn gnomon_certificate4_about(z_f: f32, n0: f32, t0: f32, t1: f32, n1: f32, n2: f32) -> gnomon_certificate4_
{
    let nz = n2 * z_f;
    let ns = (n1 + n1) - nz;
    let k0 = n0 - ns * z_f;
    let k1 = ns - nz;
    let m = t0 - t1 * z_f;
    let m0 = m * m;
    let m1 = m * (t1 + t1);
    let m2 = t1 * t1;
    var p: gnomon_certificate4_;
    p.top = n0;
    p.s0_ = m0 * k0;
    p.s1_ = m0 * k1 + m1 * k0;
    p.s2_ = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3_ = m1 * n2 + m2 * k1;
    p.s4_ = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
fn gnomon_certificate4_make(h: hankel4_, z_f: f32) -> gnomon_certificate4_
{
    let u = z_f - h.mean;
    let vu = h.variance * u;
    let slope = vu - h.third;
    let q = slope * u - h.variance * h.variance;
    let un = u * h.determinant;
    let w = h.variance * h.determinant + (u * un + q * q);
    let w2 = w + w;
    let a = q * h.variance;
    let b = un + q * (vu + slope);
    let square = b * b - (a + a) * w2;
    let inverse = 1.0 / w2;
    let ratio = b / (square + square);
    let r = gnomon_sqrt(gnomon_max(0.0, square));
    let c = (b + r) * inverse;
    let g = (b - r) * inverse;
    let d = ratio * r - 0.5;
    let k = c * d;
    let between = q < 0.0;
    let n0 = gnomon_select(between, 0.0, 1.0);
    let n1 = gnomon_select(between, c - k, g);
    let n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    let t0 = gnomon_select(between, 1.0 + d, 1.0);
    let t1 = gnomon_select(between, k, c);
    var p = gnomon_certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (0.0 < b), n0, gnomon_certificate4_nothing);
    return p;
}

/// The coefficients of p at the channels of theta4_, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
fn gnomon_certificate4_theta(p: gnomon_certificate4_) -> channels4_
{
    let third = 0.75 * p.s3_;
    var r: channels4_;
    r.c1_ = gnomon_theta4_inverse11_ * p.s1_ - third;
    r.c2_ = 0.125 * (p.s2_ - p.s4_);
    r.c3_ = gnomon_theta4_inverse13_ * (p.s1_ + third);
    r.c4_ = p.s2_ + p.s4_;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
fn gnomon_certificate4_theta_doubt(t: channels4_, noise: f32) -> f32
{
    return noise * ((gnomon_abs(t.c1_) + gnomon_abs(t.c2_)) + (gnomon_abs(t.c3_) + gnomon_abs(t.c4_)));
}

/// The least possible value of E[p], given channels c of theta4_ that are each off by at most noise.
fn gnomon_certificate4_theta_mean(p: gnomon_certificate4_, c: channels4_, noise: f32) -> f32
{
    let t = gnomon_certificate4_theta(p);
    let mean = (p.s0_ + (t.c2_ * c.c2_ + t.c4_ * c.c4_)) + (t.c1_ * (c.c1_ - 0.5) + t.c3_ * (c.c3_ - 0.5));
    return p.top - (mean + gnomon_certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4_ that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_theta_lower(h: hankel4_, c: channels4_, noise: f32, z_f: f32) -> f32
{
    let p = gnomon_certificate4_make(h, clamp_or_nan(z_f, -1.0, 1.0));
    return saturate_or_zero(gnomon_certificate4_theta_mean(p, c, noise));
}

const gnomon_certified4_scale: f32 = 137438953472.0; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
struct certified4_mean
{
    p: gnomon_certificate4_,
    mean: f32, added: f32, known: f32,
}

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
fn gnomon_certified4_constant_bias_mean(h: hankel4_, bias2: f32, bias4: f32, alpha: f32, z: f32) -> certified4_mean
{
    let u = z - h.mean;
    let vu = h.variance * u;
    let slope = vu - h.third;
    let q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    let s = gnomon_certified4_scale * q;
    let n = gnomon_certified4_scale * h.determinant;
    let un = u * n;
    let e = u * un + q * s;
    let w = h.variance * n + e;
    let w2 = w + w;
    let a = s * h.variance;
    let a2 = a + a;
    let b = un + s * (vu + slope);
    let r = gnomon_sqrt(gnomon_max(0.0, b * b - a2 * w2));
    let between = q < 0.0;
    let positive = 0.0 < b;
    // Each quotient in the form that does not cancel.
    let outer = r + gnomon_abs(b);
    let c = gnomon_select(positive, outer, -2.0 * a) / gnomon_select(positive, w2, outer);
    let inverse = 1.0 / gnomon_select(between, r + r, outer);
    let g = a2 * inverse; // k if one node is on either side
    let n0 = gnomon_select(between, 0.0, 1.0);
    let n1 = gnomon_select(between, c - g, g);
    let n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    let t0 = gnomon_select(between, 0.5 + b * inverse, 1.0);
    let t1 = gnomon_select(between, g, c);
    var m: certified4_mean;
    m.p = gnomon_certificate4_about(z, n0, t0, t1, n1, n2);
    let share = gnomon_select(between, 0.5 * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, 1.0));
    m.added = alpha * ((m.p.top - m.p.s0_) - (bias2 * m.p.s2_ + bias4 * m.p.s4_));
    m.known = gnomon_select((between || positive) && (gnomon_pivot_floor * h.variance < h.determinant), 1.0, 0.0);
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
fn gnomon_certified4_constant_bias_intensity(m: certified4_mean, doubt: f32) -> f32
{
    return gnomon_select(0.0 < m.known, saturate_or_zero(m.mean - (m.added + doubt)), 0.0);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_constant_bias_lower(h: hankel4_, noise: moments4_, bias2: f32, bias4: f32, alpha: f32, z_f: f32) -> f32
{
    let m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    let doubt = (noise.b1_ * gnomon_abs(m.p.s1_) + noise.b2_ * gnomon_abs(m.p.s2_)) +
                (noise.b3_ * gnomon_abs(m.p.s3_) + noise.b4_ * gnomon_abs(m.p.s4_));
    return gnomon_certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4_ with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_theta_constant_bias_lower(h: hankel4_, noise: f32, bias2: f32, bias4: f32, alpha: f32, z_f: f32) -> f32
{
    let m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    return gnomon_certified4_constant_bias_intensity(m,
                                                     gnomon_certificate4_theta_doubt(gnomon_certificate4_theta(m.p),
                                                                                     noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
fn moments4_rounding(b: moments4_, delta: f32) -> moments4_
{
    var e: moments4_;
    e.b1_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1_));
    e.b2_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2_));
    e.b3_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3_));
    e.b4_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4_));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
fn moments4_rounding_filtered(b: moments4_, delta: f32) -> moments4_
{
    var e: moments4_;
    e.b1_ = delta;
    e.b2_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2_));
    e.b3_ = gnomon_min(delta, delta * gnomon_abs(b.b2_ + b.b4_));
    e.b4_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4_));
    return e;
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

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { x: f32, y: f32, t: f32, z: f32, d_x: f32, d_y: f32, d_z: f32, id: f32 }

const gnomon_stochastic_nothing: f32 = -1.0; // the id of the background
const gnomon_stratum_begin: f32 = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const gnomon_stratum_end: f32 = 0.999999523162841796875; // 1 - 2^-21

/// A sample of the background.
fn stochastic_background(x: f32, y: f32, t: f32) -> stochastic_sample
{
    var s: stochastic_sample;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0;
    s.d_x = 0.0;
    s.d_y = 0.0;
    s.d_z = 0.0;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
fn stratified_time(stratum: f32, count: f32, jitter: f32) -> f32
{
    var place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
fn slice_of(t: f32, count: f32) -> f32
{
    let slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

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

const gnomon_layer_depth_limit: f32 = 2.0; // middle depths of surfaces lie in [-2, 2]
const gnomon_layer_no_cut: f32 = 3.0; // a cut behind all surfaces
const gnomon_layer_background_depth: f32 = 4.0; // the middle depth of the background
const gnomon_layer_unknown_depth: f32 = -4.0; // the middle depth of a sample of NaN
const gnomon_layer_last_bin: f32 = 63.0;
const gnomon_layer_least_extent: f32 = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
fn layer_middle_depth(s: stochastic_sample) -> f32
{
    let z = s.z + (0.5 - s.t) * s.d_z;
    let limit = gnomon_layer_depth_limit;
    let inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    let size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    let known = size <= gnomon_texel_limit;
    let middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
fn gnomon_layer_is_surface(middle: f32) -> bool { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { least: f32, greatest: f32 }

/// The window of one sample, by its middle depth.
fn layer_window_begin(middle: f32) -> gnomon_layer_window
{
    let surface = gnomon_layer_is_surface(middle);
    var w: gnomon_layer_window;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
fn layer_window_add(given_window: gnomon_layer_window, middle: f32) -> gnomon_layer_window
{
    var window = given_window;
    let other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
fn layer_bin_of(middle: f32, window: gnomon_layer_window) -> f32
{
    let share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    let bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    least: f32, greatest: f32, bins: f32, begun: f32, empty: f32,
    length0_: f32,
    length1_: f32, length2_: f32, centre0_: f32, centre1_: f32, centre2_: f32,
}

/// The state before bin 0.
fn layer_cuts_begin(window: gnomon_layer_window) -> gnomon_layer_runs
{
    var r: gnomon_layer_runs;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0_ = 0.0;
    r.length1_ = 0.0;
    r.length2_ = 0.0;
    r.centre0_ = 0.0;
    r.centre1_ = 0.0;
    r.centre2_ = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
fn layer_cuts_add(given_state: gnomon_layer_runs, occupied: f32) -> gnomon_layer_runs
{
    var state = given_state;
    let some = 0.0 < occupied;
    let centre = state.bins - 0.5 * state.empty;
    let third = some && state.length2_ < state.empty;
    let second = some && state.length1_ < state.empty;
    let first = some && state.length0_ < state.empty;
    state.length2_ = gnomon_select(second, state.length1_, gnomon_select(third, state.empty, state.length2_));
    state.centre2_ = gnomon_select(second, state.centre1_, gnomon_select(third, centre, state.centre2_));
    state.length1_ = gnomon_select(first, state.length0_, gnomon_select(second, state.empty, state.length1_));
    state.centre1_ = gnomon_select(first, state.centre0_, gnomon_select(second, centre, state.centre1_));
    state.length0_ = gnomon_select(first, state.empty, state.length0_);
    state.centre0_ = gnomon_select(first, centre, state.centre0_);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { c0_: f32, c1_: f32, c2_: f32 }

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
fn layer_cuts_end(state: gnomon_layer_runs, layers: f32) -> gnomon_layer_cuts
{
    let none = gnomon_layer_no_cut;
    let extent = state.greatest - state.least;
    let surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    let some = surfaces && gnomon_layer_least_extent <= extent;
    let per_bin = 0.015625 * extent;
    let first = some && 0.0 < state.length0_ && 1.0 < layers;
    let second = some && 0.0 < state.length1_ && 2.0 < layers;
    let third = some && 0.0 < state.length2_ && 3.0 < layers;
    let a = gnomon_select(first, state.least + per_bin * state.centre0_, none);
    let b = gnomon_select(second, state.least + per_bin * state.centre1_, none);
    let c = gnomon_select(third, state.least + per_bin * state.centre2_, none);
    let near_ab = gnomon_min(a, b);
    let far_ab = gnomon_max(a, b);
    let middle = gnomon_min(far_ab, c);
    var r: gnomon_layer_cuts;
    r.c0_ = gnomon_min(near_ab, middle);
    r.c1_ = gnomon_max(near_ab, middle);
    r.c2_ = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
fn layer_of(middle: f32, cuts: gnomon_layer_cuts) -> f32
{
    let known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    let first = gnomon_select(cuts.c0_ <= middle, 1.0, 0.0);
    let second = gnomon_select(cuts.c1_ <= middle, 1.0, 0.0);
    let third = gnomon_select(cuts.c2_ <= middle, 1.0, 0.0);
    let behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

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

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct gnomon_layer_motion_sums
{
    first_x: f32, first_y: f32, first_z: f32, x: f32, y: f32, z: f32, square: f32,
    square_z: f32, count: f32,
    least: f32, greatest: f32, least_d: f32, greatest_d: f32,
}

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct gnomon_layer_motion { d_x: f32, d_y: f32, d_z: f32, spread: f32, spread_z: f32, least: f32, greatest: f32 }

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
fn layer_motion_begin(first: stochastic_sample) -> gnomon_layer_motion_sums
{
    let limit = gnomon_texel_limit;
    var r: gnomon_layer_motion_sums;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0);
    r.x = 0.0;
    r.y = 0.0;
    r.z = 0.0;
    r.square = 0.0;
    r.square_z = 0.0;
    r.count = 0.0;
    r.least = limit;
    r.greatest = -1.0 * limit;
    r.least_d = limit;
    r.greatest_d = -1.0 * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
fn gnomon_layer_motion_is_known(s: stochastic_sample, middle: f32) -> bool
{
    let length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
fn layer_motion_add(given_state: gnomon_layer_motion_sums, s: stochastic_sample,
                    middle: f32) -> gnomon_layer_motion_sums
{
    var state = given_state;
    let known = gnomon_layer_motion_is_known(s, middle);
    let x = gnomon_select(known, s.d_x - state.first_x, 0.0);
    let y = gnomon_select(known, s.d_y - state.first_y, 0.0);
    let z = gnomon_select(known, s.d_z - state.first_z, 0.0);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    let moved = s.z + (0.5 - s.t) * s.d_z;
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
fn layer_motion_end(state: gnomon_layer_motion_sums) -> gnomon_layer_motion
{
    let share = 1.0 / gnomon_max(state.count, 1.0);
    let x = state.x * share;
    let y = state.y * share;
    let z = state.z * share;
    let some = 0.0 < state.count;
    var r: gnomon_layer_motion;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0);
    r.spread = gnomon_sqrt(gnomon_max(0.0, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    let off = 0.5 * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    axis_x: f32, axis_y: f32, scale_u: f32, scale_v: f32, motion: f32, d_z: f32, middle: f32,
    centre: f32, scale: f32, spread: f32, spread_z: f32,
}

const gnomon_layer_least_motion: f32 = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
const gnomon_layer_least_depths: f32 = 0.0009765625; // 2^-10: no layer is stretched as if it were thinner

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
fn layer_grid_make(mean: gnomon_layer_motion, guard: f32, texels: f32) -> layer_grid
{
    let chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    let moves = gnomon_layer_least_motion <= chord;
    var g: layer_grid;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0);
    g.motion = gnomon_select(moves, chord, 0.0);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5 * texels;
    g.centre = 0.5 * (mean.least + mean.greatest);
    g.scale = 2.0 / gnomon_max(gnomon_layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
struct gnomon_layer_place { u: f32, v: f32 }

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
fn gnomon_layer_grid_turned(grid: layer_grid, x: f32, y: f32) -> gnomon_layer_place
{
    var r: gnomon_layer_place;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
fn layer_grid_place(grid: layer_grid, x: f32, y: f32, t: f32) -> gnomon_layer_place
{
    let turned = gnomon_layer_grid_turned(grid, x, y);
    var r: gnomon_layer_place;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5 - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
fn layer_place_is_inside(grid: layer_grid, place: gnomon_layer_place) -> f32
{
    let texels = 2.0 * grid.middle;
    let begun = 0.0 <= place.u && 0.0 <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0, 0.0);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
fn layer_grid_depth(grid: layer_grid, z: f32, t: f32) -> f32 { return z + (0.5 - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
fn layer_grid_own_depth(grid: layer_grid, z: f32, t: f32) -> f32
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

// motion/layers/layer_sums.h ------------------------------------------------------------------------------------------
// Sums that a texel of a layer's grid holds, and the visibility of a receiver through the layer (Andersson et al. 2015,
// Sec. 4.1 and 4.2). A sample in the layer or behind it has weight w = 1, one in front of the layer has none. A sample
// in the layer has opacity a = 1: where one sees past the layer, it is transparent. Per texel
//
//     variance       sums of w a z, w a z^2, w a, w                                layer_sums, Eq. 7
//     four moments   sums of w a z, ..., w a z^4, w a, w                           gnomon_layer_moments4_sums
//     exponential    sums of w a exp(c z), w a, w                                  gnomon_layer_exponential_sums
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

/// Opacity and weight of a sample for a layer, each 0 or 1.
struct gnomon_layer_share { opacity: f32, weight: f32 }

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
fn layer_share_of(at: f32, layer: f32) -> gnomon_layer_share
{
    var r: gnomon_layer_share;
    r.opacity = gnomon_select(at == layer, 1.0, 0.0);
    r.weight = gnomon_select(layer <= at, 1.0, 0.0);
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
struct layer_sums { z: f32, zz: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
fn layer_sums_add(given_sums: layer_sums, z: f32, share: gnomon_layer_share) -> layer_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
    let x = clamp_or_high(z, -1.0, 1.0);
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
fn gnomon_layer_transmission(opacity: f32, weight: f32, intensity: f32, z: f32) -> f32
{
    let bound = gnomon_select(1.0 < z, 1.0, gnomon_select(-1.0 < z, intensity, 0.0));
    let known = gnomon_select(0.0 < weight, saturate_or_zero(opacity / weight), 0.0);
    return 1.0 - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight
/// of 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
fn layer_visibility(sums: layer_sums, z: f32, minimum_variance: f32) -> f32
{
    var b: variance_moments;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
struct gnomon_layer_moments4_sums { b1_: f32, b2_: f32, b3_: f32, b4_: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
fn layer_moments4_add(given_sums: gnomon_layer_moments4_sums, z: f32,
                      share: gnomon_layer_share) -> gnomon_layer_moments4_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
    let b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    sums.b1_ = sums.b1_ + a * b.b1_;
    sums.b2_ = sums.b2_ + a * b.b2_;
    sums.b3_ = sums.b3_ + a * b.b3_;
    sums.b4_ = sums.b4_ + a * b.b4_;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

const gnomon_layer_moments4_noise: f32 = 0x1.1b77c4p-25; // 3.3e-8, 1.1 times 2^-25, one rounding to float
const gnomon_layer_moments4_weight: f32 = 0x1.421f6p-22; // 3e-7, the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one
/// more, and those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and
/// so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
fn layer_moments4_visibility(sums: gnomon_layer_moments4_sums, z: f32, roundings: f32) -> f32
{
    let share = 1.0 / sums.opacity;
    var b: moments4_;
    b.b1_ = sums.b1_ * share;
    b.b2_ = sums.b2_ * share;
    b.b3_ = sums.b3_ * share;
    b.b4_ = sums.b4_ * share;
    let n = gnomon_max(1.0, roundings) * (sums.weight * share);
    let alpha = bias_weight_of_roundings(gnomon_layer_moments4_weight, n);
    var noise: moments4_;
    noise.b1_ = n * gnomon_layer_moments4_noise;
    noise.b2_ = noise.b1_;
    noise.b3_ = noise.b1_;
    noise.b4_ = noise.b1_;
    let h = hankel4_constant_bias(b, bias4_raw_b2_, bias4_raw_b4_, alpha);
    let intensity = certified4_constant_bias_lower(h, noise, bias4_raw_b2_, bias4_raw_b4_, alpha, z);
    return gnomon_layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
struct gnomon_layer_exponential_sums { warped: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
fn layer_exponential_add(given_sums: gnomon_layer_exponential_sums, z: f32, share: gnomon_layer_share,
                         settings: exponential_settings) -> gnomon_layer_exponential_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
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
fn layer_exponential_visibility(sums: gnomon_layer_exponential_sums, z: f32, settings: exponential_settings) -> f32
{
    var b: exponential_moment;
    b.warped = sums.warped / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
}

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

/// A fold over the samples of a layer: its mean motion, sums of squares and products of differences from that, and
/// their number.
struct gnomon_layer_direction_sums { d_x: f32, d_y: f32, xx: f32, xy: f32, yy: f32, count: f32 }

/// The mean motion of a layer, the direction in which its samples' motions differ most, and the inverse of four
/// standard deviations in that direction; 0 if they do not differ.
struct gnomon_layer_direction { d_x: f32, d_y: f32, axis_x: f32, axis_y: f32, scale: f32 }

// 2^-20 square texels: motions that differ less do not
const gnomon_layer_least_difference: f32 = 0.00000095367431640625;

/// The state before the first sample.
fn layer_direction_begin(motion: gnomon_layer_motion) -> gnomon_layer_direction_sums
{
    var r: gnomon_layer_direction_sums;
    r.d_x = motion.d_x;
    r.d_y = motion.d_y;
    r.xx = 0.0;
    r.xy = 0.0;
    r.yy = 0.0;
    r.count = 0.0;
    return r;
}

/// The state after one more sample and its middle depth.
/// Domain: as for layer_motion_add.
/// NaN: no information, the state as before.
fn layer_direction_add(given_state: gnomon_layer_direction_sums, s: stochastic_sample,
                       middle: f32) -> gnomon_layer_direction_sums
{
    var state = given_state;
    let known = gnomon_layer_motion_is_known(s, middle);
    let x = gnomon_select(known, s.d_x - state.d_x, 0.0);
    let y = gnomon_select(known, s.d_y - state.d_y, 0.0);
    state.xx = state.xx + x * x;
    state.xy = state.xy + x * y;
    state.yy = state.yy + y * y;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    return state;
}

/// The direction in which motions differ most: that of the larger eigenvalue of their covariance, along x if both are
/// equal.
/// Domain: differences from 2^-10 texels on; of smaller ones the direction is along x, and scale is 0.
/// Error: with n samples, of the axis (n + 16) 2^-p times the larger eigenvalue over the difference of both; of scale,
/// relative, (n + 16) 2^-p.
fn layer_direction_end(state: gnomon_layer_direction_sums) -> gnomon_layer_direction
{
    let half_difference = 0.5 * (state.xx - state.yy);
    let radius = gnomon_sqrt(half_difference * half_difference + state.xy * state.xy);
    let larger = 0.5 * (state.xx + state.yy) + radius;
    // (xy, larger - xx) and (larger - yy, xy) are both along the axis: the one without cancellation.
    let steep = half_difference < 0.0;
    let long_part = radius + gnomon_abs(half_difference);
    let x = gnomon_select(steep, state.xy, long_part);
    let y = gnomon_select(steep, long_part, state.xy);
    let norm = gnomon_sqrt(x * x + y * y);
    let apart = 0.0 < norm;
    let square = larger / gnomon_max(state.count, 1.0);
    let differ = gnomon_layer_least_difference <= square;
    var r: gnomon_layer_direction;
    r.d_x = state.d_x;
    r.d_y = state.d_y;
    r.axis_x = gnomon_select(apart && differ, x / norm, 1.0);
    r.axis_y = gnomon_select(apart && differ, y / norm, 0.0);
    r.scale = gnomon_select(differ, 0.25 / gnomon_sqrt(square), 0.0);
    return r;
}

/// The place of a sample's motion on the direction, from the layer's mean: 1 at four standard deviations, limited to
/// [-2, 2].
/// NaN: gnomon_layer_unknown_depth.
fn layer_direction_key(direction: gnomon_layer_direction, s: stochastic_sample) -> f32
{
    let x = (s.d_x - direction.d_x) * direction.axis_x;
    let y = (s.d_y - direction.d_y) * direction.axis_y;
    let key = (x + y) * direction.scale;
    let limit = gnomon_layer_depth_limit;
    let inside = gnomon_max(gnomon_min(key, limit), -1.0 * limit);
    return gnomon_select(gnomon_abs(key) <= gnomon_texel_limit, inside, gnomon_layer_unknown_depth);
}

/// The key that divides a layer into two parts: the centre of the longest run of empty bins (layer_cuts_add) if that is
/// at least `bins` bins long, else gnomon_layer_no_cut. A few samples leave short runs anywhere.
/// NaN: a `bins` of NaN divides nothing.
fn layer_part_cut(state: gnomon_layer_runs, bins: f32) -> f32
{
    return gnomon_select(bins <= state.length0_, layer_cuts_end(state, 2.0).c0_, gnomon_layer_no_cut);
}

/// Opacity and weight, for part number `wanted` of layer number `layer`, of a sample that is in part `part` of layer
/// `at` at the middle depth `middle`. A sample of the other part has no opacity. It has weight if it is behind
/// `centre`, the middle of the wanted part's depths: where it is seen, one sees past that part.
/// NaN: no weight for an `at` of NaN, nor in the layer for a `part`, `middle` or `centre` of NaN. A part below 0 is a
/// NaN.
fn layer_share_of_part(at: f32, layer: f32, part: f32, wanted: f32, middle: f32, centre: f32) -> gnomon_layer_share
{
    var r = layer_share_of(at, layer);
    let other = at == layer && !(part == wanted);
    let past = centre < middle && 0.0 <= part;
    r.opacity = gnomon_select(other, 0.0, r.opacity);
    r.weight = gnomon_select(other && !past, 0.0, r.weight);
    return r;
}
