// Gnomon 0.1.0, absorbance.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.

/// The two roots, in no particular order.
struct gnomon_quadratic_result { first: f32, second: f32 }

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
fn quadratic_roots(a: f32, b: f32, c: f32) -> gnomon_quadratic_result
{
    let r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0));
    let t = gnomon_select(b > 0.0, -(b + r), r - b);
    var x: gnomon_quadratic_result;
    x.first = t / a;
    x.second = c / t;
    return x;
}

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
struct hamburger_bounds { lower: f32, upper: f32, weight: f32 }

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
fn bounds_intensity(bounds: hamburger_bounds, overestimation: f32) -> f32
{
    return saturate_or_zero(bounds.lower + (1.0 - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
fn over_darken(intensity: f32, strength: f32) -> f32 { return saturate_or_zero(intensity / strength); }

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

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four moments: sharp bounds on Z(z < z_f) over all depth distributions Z with these moments
// (the Hamburger moment problem; Peters et al. 2017, Eq. 1 and Alg. 1), without solving for all nodes and weights.
//
// The Christoffel-Darboux kernel K(x, y) = sum_k P_k(x) P_k(y) / D_k of the factored Hankel matrix (hankel4.h)
// gives the canonical distribution with a node at z_f: the other two nodes are the roots of K(z_f, .), and a node
// at z has the weight w(z) = 1 / K(z, z). The number of nodes above z_f is the number of sign changes in
// P_0(z_f), P_1(z_f), P_2(z_f):
//     no node above:      lower = 1 - w_f
//     both nodes above:   lower = 0
//     one node above:     lower = w(smaller root)
// and upper = lower + w_f. Let x = z - mean, u = z_f - mean, V = D_1, N = D_1 D_2, W = V N and
// Q(x) = V P_2 = (V x - G) x - V^2. Then
//     w(z) = W / (W + x^2 N + Q(x)^2)
//     K(z_f, .) = 0:    a x^2 + 2 b x + c = 0,    a = Q V,    2 b = u N - Q G,    c = W - Q V^2,    Q = Q(u)
// If one root lies on each side, Q < 0, so r^2 = b^2 - a c is a sum of positive terms. The two nodes beside z_f have
// the weight E / (W + E) together, E = u^2 N + Q^2, and their mean balances z_f about the mean of all, which gives the
// weight of the smaller one without its root:
//     w(smaller root) = (E (r + b) - W u a) / (2 r (W + E))
// The whole takes one division and one square root.

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
struct gnomon_distribution3_ { depth0_: f32, depth1_: f32, depth2_: f32, weight0_: f32, weight1_: f32, weight2_: f32 }

// moments/hamburger4.h ------------------------------------------------------------------------------------------------

const gnomon_hamburger4_scale: f32 = 72057594037927936.0; // 2^56
const hamburger4_lower_scale: f32 = 281474976710656.0; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
fn gnomon_hamburger4_q(h: hankel4_, x: f32) -> f32 { return (h.variance * x - h.third) * x - h.variance * h.variance; }

/// The weight of the node at mean + x, where q = Q(x).
fn gnomon_hamburger4_weight(h: hankel4_, x: f32, q: f32) -> f32
{
    let w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
struct hamburger4_quadratic { a: f32, b: f32, c: f32 }

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
fn gnomon_hamburger4_other_nodes(h: hankel4_, u: f32, q: f32) -> hamburger4_quadratic
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    let n = h.determinant * gnomon_hamburger4_scale;
    let s = q * gnomon_hamburger4_scale;
    var r: hamburger4_quadratic;
    r.a = s * h.variance;
    r.b = 0.5 * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
struct hamburger4_fractions { share: f32, total: f32, receiver: f32, whole: f32 }

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
fn gnomon_hamburger4_fractions_at(h: hankel4_, z_f: f32) -> hamburger4_fractions
{
    let u = clamp_or_nan(z_f, -1.0, 1.0) - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    let s = hamburger4_lower_scale * q;
    let n = hamburger4_lower_scale * h.determinant;
    let un = u * n;
    let a = s * h.variance;
    let b = 0.5 * (un - s * h.third);
    let r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    let e = u * un + q * s;
    var f: hamburger4_fractions;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    let between = q < 0.0;
    // Elsewhere u is never 0 and the quotient is e / whole with the sign of u: a negative lower bound is clamped to 0.
    f.share = gnomon_select(between, e * (r + b) - f.receiver * (u * a), e * u);
    f.total = gnomon_select(between, r + r, gnomon_abs(u)) * f.whole;
    return f;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, three depths and more: p99 1e-13, p99.9 2e-12
///     error, float, hankel4_constant_bias at 3e-7: p99 3e-5, p99.9 1e-4, max 5e-4
/// and against the kernel in double, with maxima found by climbing (tests/moments/honest_four.cpp),
///     error, float, hankel4_from_float: p99 3e-5, p99.9 1e-4, max 5e-4
///     error, float, hankel4_from_float_filtered: p99 2e-5, p99.9 5e-5, max 1e-4
///     error, float, hankel4_from_half: p99 3e-5, p99.9 1e-4, max 2e-3
///     error, float, hankel4_from_half_filtered: p99 1e-5, p99.9 3e-5, max 3e-4
///     error, float, hankel4_from_unorm16_: p99 4e-4, p99.9 2e-3, max 5e-2
///     error, float, hankel4_from_unorm16_filtered: p99 2e-4, p99.9 6e-4, max 4e-3
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
fn hamburger4_lower(h: hankel4_, z_f: f32) -> f32
{
    let f = gnomon_hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
fn hamburger4_bounds(h: hankel4_, z_f: f32) -> hamburger_bounds
{
    let f = gnomon_hamburger4_fractions_at(h, z_f);
    var r: hamburger_bounds;
    r.lower = saturate_or_zero(f.share / f.total);
    r.weight = gnomon_min(saturate_or_zero(f.receiver / f.whole), 1.0 - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// The canonical distribution with a node at z_f. The other two depths are finite, at most 1024 from the mean, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1
fn hamburger4_distribution(h: hankel4_, z_f: f32) -> gnomon_distribution3_
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let u = z - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    let p = gnomon_hamburger4_other_nodes(h, u, q);
    let x = quadratic_roots(p.a, p.b, p.c);
    let x1 = clamp_or_nan(x.first, -1024.0, 1024.0);
    let x2 = clamp_or_nan(x.second, -1024.0, 1024.0);
    let w0 = gnomon_hamburger4_weight(h, u, q);
    let w1 = gnomon_hamburger4_weight(h, x1, gnomon_hamburger4_q(h, x1));
    let w2 = gnomon_hamburger4_weight(h, x2, gnomon_hamburger4_q(h, x2));
    let sum = w0 + (w1 + w2);
    let swapped = x2 < x1;
    let known = sum > 0.0; // false for NaN
    var d: gnomon_distribution3_;
    d.depth0_ = gnomon_select(known, z, 1.0);
    d.depth1_ = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), 1.0);
    d.depth2_ = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), 1.0);
    d.weight1_ = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, 0.0);
    d.weight2_ = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, 0.0);
    d.weight0_ = saturate_or_zero(1.0 - (d.weight1_ + d.weight2_));
    return d;
}

// moments/translucency.h ----------------------------------------------------------------------------------------------
// Translucent occluders (Peters et al. 2017, Sec. 3): moments of the depth distribution in which each fragment of a
// stack has as weight the light that it takes away,
//     Z = sum_k weight_k delta(z_k),    weight_k = alpha_k prod of (1 - alpha_j) over the fragments j in front of k,
// so that Z(z < z_f) = 1 - prod of (1 - alpha_k) over z_k < z_f, the intensity of the stack's shadow. What is behind
// all fragments, an opaque surface or the far plane, has the rest of the weight.
//
//     back to front    b = the moments of the surface behind;  b = moments4_over(b, z, alpha) for each fragment
//     front to back    state = front_to_back_begin(alpha), then front_to_back_add(state, alpha): moments4_add the
//                      fragment's moments with state.weight, in the end those of the surface behind with
// state.transmittance
//
// A GPU blends back to front: over() of each channel, with the alpha of the fragment. Weights sum to 1, so that affine
// transforms commute with blending: channels of any format are blended as stored (passes/blend.hpp). For coloured
// occluders use one map for each channel of light, with the opacity for that light. In any order, a fragment that
// survives in a sample with probability alpha has this distribution as the mean over samples (stochastic transparency;
// Enderton et al. 2010).
//
// Every blend rounds to the format. Later blends shrink an error by 1 - alpha, so of n roundings by delta
//     delta (1 - (1 - alpha)^n) / alpha <= delta / alpha
// is left: blend_roundings, for storage/moments4_blended.h and moments6_blended.h. A least alpha hence limits the
// error, and fragments below it are discarded (alpha test). Where alpha |above - below| is less than half a code, a
// blend changes
// nothing: many faint fragments vanish, for which no bias makes up. Absorbance (absorbance.h) loses less of them.

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below.
/// An alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
fn over(below: f32, above: f32, alpha: f32) -> f32
{
    let a = saturate_or_zero(alpha);
    let mixed = (1.0 - a) * below + a * above;
    return gnomon_select(0.0 < a, gnomon_select(a < 1.0, mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
struct gnomon_front_to_back { weight: f32, transmittance: f32 }

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
fn front_to_back_begin(alpha: f32) -> gnomon_front_to_back
{
    var state: gnomon_front_to_back;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = 1.0 - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
fn front_to_back_add(given_state: gnomon_front_to_back, alpha: f32) -> gnomon_front_to_back
{
    var state = given_state;
    let a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (1.0 - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
const gnomon_alpha_test_one_percent: f32 = 0x1.47ae14p-7; // 0.01

const gnomon_blend_least_alpha: f32 = 5.9604644775390625e-8; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
fn blend_roundings(least_alpha: f32) -> f32
{
    return 1.0 / gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
fn blend_roundings_of_layers(least_alpha: f32, layers: f32) -> f32
{
    let a = gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
    let further = gnomon_max(1.0, layers) - 1.0;
    let few = (further + 1.0) / (1.0 + 0.5 * (further * a));
    return gnomon_min(few, 1.0 / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
fn gnomon_blended_roundings(further: f32, each: f32) -> f32 { return 1.0 + each * gnomon_max(0.0, further); }

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
const gnomon_blended_half_roundings: f32 = 2.0;
const gnomon_blended_float_roundings: f32 = 3.5;

// moments/translucency.h, four moments --------------------------------------------------------------------------------

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
fn moments4_over(below: moments4_, z: f32, alpha: f32) -> moments4_
{
    var b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1_ = over(below.b1_, b.b1_, alpha);
    b.b2_ = over(below.b2_, b.b2_, alpha);
    b.b3_ = over(below.b3_, b.b3_, alpha);
    b.b4_ = over(below.b4_, b.b4_, alpha);
    return b;
}

// moments/absorbance.h ------------------------------------------------------------------------------------------------
// Absorbance moments: translucent occluders without an order (Munstermann 2018; Sharpe 2018), which Peters et al.
// (2017, Sec. 3.1) leave out. The logarithm turns the product of transmittances into a sum,
//     transmittance before z = prod of (1 - alpha_k) over z_k < z = exp(-sum of a_k over z_k < z),    a_k = -ln(1 -
// alpha_k) so fragments are added, in any order, as their absorbance times the powers of their depth: b_j = sum_k a_k
// z_k^j, with b_0 kept. b_j / b_0 are moments of a depth distribution Z, and exp(-b_0 Z(z < z_f)) is the transmittance.
//
//     map            b = absorbance4_add(b, absorbance4_of_fragment(z, alpha)) from zeros, by additive blending
//     receiver       absorbance4_transmittance(b, ...) and transmitted_intensity with the shadow of the opaque
// occluders
//
// Opaque occluders are in a map of their own: their absorbance is infinite, and filtered with that of others it would
// shadow all of the filter region. For the same reason a filter over absorbances is darker than the mean transmittance,
// exp(-mean a) <= mean exp(-a), and near it only where absorbance varies little in the filter region. Fragments behind
// an opaque occluder are added, too: then both maps are independent, and their transmittances multiply.

/// Sums of absorbance times powers of depth, b0 to b4.
struct absorbance4_ { b0_: f32, b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

const absorbance_most: f32 = 16.0;

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
fn absorbance_of_opacity(alpha: f32) -> f32
{
    let absorbed = -1.0 * polynomial_log(1.0 - saturate_or_zero(alpha));
    return gnomon_min(absorbed, absorbance_most);
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
fn absorbance4_of_fragment(z: f32, alpha: f32) -> absorbance4_
{
    let a = absorbance_of_opacity(alpha);
    let m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    var b: absorbance4_;
    b.b0_ = a;
    b.b1_ = a * m.b1_;
    b.b2_ = a * m.b2_;
    b.b3_ = a * m.b3_;
    b.b4_ = a * m.b4_;
    return b;
}

/// The absorbance moments of two sets of fragments together.
fn absorbance4_add(given_sum: absorbance4_, b: absorbance4_) -> absorbance4_
{
    var sum = given_sum;
    sum.b0_ = sum.b0_ + b.b0_;
    sum.b1_ = sum.b1_ + b.b1_;
    sum.b2_ = sum.b2_ + b.b2_;
    sum.b3_ = sum.b3_ + b.b3_;
    sum.b4_ = sum.b4_ + b.b4_;
    return sum;
}

const absorbance_least: f32 = 7.62939453125e-6; // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are
/// meant in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
fn absorbance4_factor(b: absorbance4_, alpha: f32) -> hankel4_
{
    let scale = 1.0 / gnomon_max(absorbance_least, b.b0_);
    var m: moments4_;
    m.b1_ = b.b1_ * scale;
    m.b2_ = b.b2_ * scale;
    m.b3_ = b.b3_ * scale;
    m.b4_ = b.b4_ * scale;
    return hankel4_constant_bias(m, bias4_raw_b2_, bias4_raw_b4_, alpha);
}

const absorbance_scale: f32 = 0x1.p-64; // 5.421010862427522170037e-20, 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
fn absorbance_transmittance(b0: f32, intensity: f32) -> f32
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    let absorbed = saturate_or_zero(b0 * absorbance_scale) * 18446744073709551616.0;
    let t = polynomial_exp(-1.0 * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, 1.0);
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
fn gnomon_absorbance4_intensity(h: hankel4_, alpha: f32, overestimation: f32, z_f: f32) -> f32
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (1.0 - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1],
/// clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_transmittance(b: absorbance4_, alpha: f32, overestimation: f32, z_f: f32) -> f32
{
    return absorbance_transmittance(b.b0_,
                                    gnomon_absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation,
                                                                 z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the
/// given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
fn transmitted_intensity(opaque: f32, transmittance: f32) -> f32
{
    let absorbed = saturate_or_zero(1.0 - transmittance);
    let o = saturate_or_zero(opaque);
    return o + (1.0 - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of
/// the three as absorbance.
struct gnomon_coloured_absorbance4_ { red: f32, green: f32, blue: f32, b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

/// Transmittances, each in [0, 1].
struct gnomon_coloured_transmittance { red: f32, green: f32, blue: f32 }

const absorbance_third: f32 = 0x1.555556p-2; // 0.33333333333333331

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
fn coloured_absorbance4_of_fragment(z: f32, red: f32, green: f32, blue: f32) -> gnomon_coloured_absorbance4_
{
    var b: gnomon_coloured_absorbance4_;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    let a = absorbance_third * (b.red + (b.green + b.blue));
    let m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1_ = a * m.b1_;
    b.b2_ = a * m.b2_;
    b.b3_ = a * m.b3_;
    b.b4_ = a * m.b4_;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
fn coloured_absorbance4_add(given_sum: gnomon_coloured_absorbance4_,
                            b: gnomon_coloured_absorbance4_) -> gnomon_coloured_absorbance4_
{
    var sum = given_sum;
    sum.red = sum.red + b.red;
    sum.green = sum.green + b.green;
    sum.blue = sum.blue + b.blue;
    sum.b1_ = sum.b1_ + b.b1_;
    sum.b2_ = sum.b2_ + b.b2_;
    sum.b3_ = sum.b3_ + b.b3_;
    sum.b4_ = sum.b4_ + b.b4_;
    return sum;
}

/// The transmittances at depth z_f, from one distribution of depth for all channels: right in front of all fragments,
/// behind all, and wherever their hues are alike. The arguments are those of absorbance4_transmittance.
/// Domain: as of absorbance4_transmittance.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn coloured_absorbance4_transmittance(b: gnomon_coloured_absorbance4_, alpha: f32, overestimation: f32,
                                      z_f: f32) -> gnomon_coloured_transmittance
{
    var shared_depths: absorbance4_;
    shared_depths.b0_ = absorbance_third * (b.red + (b.green + b.blue));
    shared_depths.b1_ = b.b1_;
    shared_depths.b2_ = b.b2_;
    shared_depths.b3_ = b.b3_;
    shared_depths.b4_ = b.b4_;
    let intensity = gnomon_absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation, z_f);
    var t: gnomon_coloured_transmittance;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
}

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.

struct channels1_ { c1_: f32 }

struct channels2_ { c1_: f32, c2_: f32 }

struct channels5_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32 }

// moments/channels.h, four moments ------------------------------------------------------------------------------------

struct channels4_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32 }

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

// storage/moments4.h --------------------------------------------------------------------------------------------------
// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4_      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16_
//   4 x half          8     theta4_ - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
//   4 x float        16     none        moments4_float_encode     moments4_float_intensity     hankel4_from_float
//
// Filters are linear: average channels as they are. X_intensity and hankel4_from_X allow for one rounding: of channels
// that are stored once and filtered without further rounding, as 16-bit texels by a texture unit that returns floats.
// Texels of floats round again there and need X_filtered. X_filtered_intensity and hankel4_from_X_filtered allow for a
// pass along rows and one along columns, of nine taps at most, that store their results in the format again, half
// floats truncated or rounded. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by at most
//   X_intensity         gnomon_stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X      the weight of the constant bias, roundings * delta / r (bias.h), and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/moments/honest_four.cpp). Certificates (certified4.h)
// leak less than a constant bias in every format. Float arithmetic moves the nodes of a certificate, which costs or
// gains a little leaking. Difference of an intensity in float from the intensity in double:
//     error, float, moments4_float_intensity: p99 3e-5, p99.9 1e-4, max 5e-4
//     error, float, moments4_float_filtered_intensity: p99 1e-5, p99.9 5e-5, max 2e-4
//     error, float, moments4_half_intensity: p99 5e-5, p99.9 4e-4, max 2e-2
//     error, float, moments4_half_filtered_intensity: p99 3e-5, p99.9 2e-4, max 2e-3
//     error, float, moments4_unorm16_intensity: p99 6e-4, p99.9 7e-3, max 3e-1
//     error, float, moments4_unorm16_filtered_intensity: p99 3e-4, p99.9 3e-3, max 3e-2

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
fn moments4_unorm16_encode(z: f32) -> channels4_ { return theta4_(moments4_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The channels c, each with shift added.
fn gnomon_channels4_shifted(given_c: channels4_, shift: f32) -> channels4_
{
    var c = given_c;
    c.c1_ = c.c1_ + shift;
    c.c2_ = c.c2_ + shift;
    c.c3_ = c.c3_ + shift;
    c.c4_ = c.c4_ + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
fn gnomon_half_nearest(x: f32) -> f32 { return 0.000244140625 * nearest_integer(4096.0 * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices
/// may truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
fn moments4_half_encode(z: f32) -> channels4_
{
    var c = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    c.c1_ = gnomon_half_nearest(c.c1_);
    c.c2_ = gnomon_half_nearest(c.c2_);
    c.c3_ = gnomon_half_nearest(c.c3_);
    c.c4_ = gnomon_half_nearest(c.c4_);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn moments4_float_encode(z: f32) -> channels4_
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

const gnomon_stored4_unorm16_weight: f32 = 0x1.2dfd6ap-15; // 3.6e-5
const gnomon_stored4_unorm16_filtered_weight: f32 = 0x1.cd5f9ap-14; // 1.1e-4
const gnomon_stored4_half_weight: f32 = 0x1.2ad81ap-11; // 5.7e-4
const gnomon_stored4_half_filtered_weight: f32 = 0x1.758e22p-9; // 2.85e-3
const gnomon_stored4_float_weight: f32 = 0x1.421f6p-22; // 3e-7
const gnomon_stored4_float_filtered_weight: f32 = 0x1.0c6f7ap-19; // 2e-6
const gnomon_stored4_arithmetic_weight: f32 = 0x1.0c6f7ap-20; // 1e-6

/// The factored matrix of the channels of theta4_, with a constant bias of weight alpha.
fn gnomon_hankel4_from_theta(c: channels4_, alpha: f32) -> hankel4_
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, bias4_theta_b2_, alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
fn gnomon_hankel4_stored_as_float(c: channels4_, alpha: f32) -> hankel4_
{
    return hankel4_constant_bias(moments4_from_channels(c), bias4_raw_b2_, bias4_raw_b4_, alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
fn hankel4_from_unorm16_(c: channels4_) -> hankel4_ { return gnomon_hankel4_from_theta(c,
                                                                                       gnomon_stored4_unorm16_weight); }

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
fn hankel4_from_unorm16_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
fn hankel4_from_half(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
fn hankel4_from_half_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_filtered_weight);
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
fn hankel4_from_float(c: channels4_) -> hankel4_ { return gnomon_hankel4_stored_as_float(c,
                                                                                         gnomon_stored4_float_weight); }

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
fn hankel4_from_float_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_filtered_weight);
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
const certified4_unorm16_noise: f32 = 0x1.0c6f7ap-17; // 8e-6, half a code, and the error of theta4_ in float
const certified4_unorm16_filtered_noise: f32 = 0x1.92a738p-16; // 2.4e-5
const certified4_unorm16_weight: f32 = 0x1.2dfd6ap-15; // 3.6e-5
const certified4_unorm16_filtered_weight: f32 = 0x1.797cc4p-14; // 9e-5
const certified4_half_noise: f32 = 0x1.00e6bp-13; // 1.225e-4, 2^-13, and the error of theta4_ in float
const certified4_half_filtered_noise: f32 = 0x1.40dd4p-11; // 6.12e-4, passes may truncate: 2^-12 each
const certified4_half_weight: f32 = 0x1.3a92a4p-11; // 6e-4
const certified4_half_filtered_weight: f32 = 0x1.2d7732p-9; // 2.3e-3
const certified4_float_noise: f32 = 0x1.1b77c4p-25; // 3.3e-8, 1.1 times 2^-25
const certified4_float_filtered_noise: f32 = 2.384185791015625e-7; // 8 times: sums of nine taps round, too
const certified4_float_weight: f32 = 0x1.421f6p-22; // 3e-7
const certified4_float_filtered_weight: f32 = 0x1.92a738p-20; // 1.5e-6

/// Shadow intensity at z_f from channels c of theta4_, each off by at most noise, by nodes with a bias of weight alpha.
fn gnomon_moments4_theta_intensity(c: channels4_, noise: f32, alpha: f32, z_f: f32) -> f32
{
    return certified4_theta_lower(gnomon_hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_unorm16_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_noise, certified4_unorm16_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_unorm16_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                           z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_half_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_noise,
                                           certified4_half_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_half_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_filtered_noise,
                                           certified4_half_filtered_weight, z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes
/// with a bias of weight alpha.
fn gnomon_moments4_float_intensity_with_noise(c: channels4_, noise: moments4_, alpha: f32, z_f: f32) -> f32
{
    return certified4_constant_bias_lower(gnomon_hankel4_stored_as_float(c, alpha), noise, bias4_raw_b2_, bias4_raw_b4_,
                                          alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_float_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), certified4_float_noise),
        certified4_float_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_float_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), certified4_float_filtered_noise),
        certified4_float_filtered_weight, z_f);
}

// storage/absorbance4.h -----------------------------------------------------------------------------------------------
// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in
// any order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4_ - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add
// up to additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A
// fragment's own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by
// 2^-24 of its value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
fn absorbance4_float_encode(z: f32, alpha: f32) -> channels5_
{
    let b = absorbance4_of_fragment(z, alpha);
    var c: channels5_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    c.c5_ = b.b0_;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
fn absorbance4_half_encode(z: f32, alpha: f32) -> channels5_
{
    let a = absorbance_of_opacity(alpha);
    let s = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    var c: channels5_;
    c.c1_ = a * s.c1_;
    c.c2_ = a * s.c2_;
    c.c3_ = a * s.c3_;
    c.c4_ = a * s.c4_;
    c.c5_ = a;
    return c;
}

const absorbance4_half_additions: f32 = 8.0;
const absorbance4_half_least: f32 = 1.220703125e-4; // 2^-13: below, half floats are denormal
const absorbance4_float_additions: f32 = 4.0;
const absorbance4_float_more: f32 = 3.0; // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_float_transmittance(c: channels5_, additions: f32, overestimation: f32, z_f: f32) -> f32
{
    var b: absorbance4_;
    b.b0_ = c.c5_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    let n = gnomon_blended_roundings(additions + absorbance4_float_more, absorbance4_float_additions);
    return absorbance4_transmittance(b, bias_weight_of_roundings(gnomon_stored4_float_weight, n), overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_half_transmittance(c: channels5_, additions: f32, overestimation: f32, z_f: f32) -> f32
{
    let scale = 1.0 / gnomon_max(absorbance4_half_least, c.c5_);
    var s: channels4_;
    s.c1_ = c.c1_ * scale;
    s.c2_ = c.c2_ * scale;
    s.c3_ = c.c3_ * scale;
    s.c4_ = c.c4_ * scale;
    let weight = bias_weight_of_roundings(gnomon_stored4_half_weight,
                                          gnomon_blended_roundings(additions, absorbance4_half_additions));
    let h = gnomon_hankel4_from_theta(gnomon_channels4_shifted(s, 0.5), weight);
    return absorbance_transmittance(c.c5_, gnomon_absorbance4_intensity(h, weight, overestimation, z_f));
}
