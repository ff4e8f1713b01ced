// Gnomon 0.1.0, two_point.wgsl: shadow filtering in WGSL, this file alone.
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

// moments/two_point.h -------------------------------------------------------------------------------------------------
// A depth distribution of two depths from three moments (Peters et al. 2017, Alg. 2, Sec. 5.2 and App. B), which is the
// limit of Alg. 1 for a prescribed depth at infinity.
//
// Around the mean m = b1, with V = b2 - b1^2 and G = E[(z - m)^3] / V, the two depths are m + x1 and m + x2, where x1
// and x2 are the roots of x^2 - G x - V. The weights follow from w1 x1 + w2 x2 = 0. The roots have opposite signs, so
// that nothing cancels after V and G.

/// Two depths, depth1 <= depth2, and their weights, which are in [0, 1] and sum to 1.
struct gnomon_distribution2_ { depth1_: f32, depth2_: f32, weight1_: f32, weight2_: f32 }

const two_point_least_variance: f32 = 1.1920928955078125e-7; // 2^-23

/// The distribution of two depths with the moments b1, b2 and b3; a single depth b1 if the variance is at most
/// least_variance. That should be the largest variance by rounding of a single depth: two_point_least_variance for
/// moments stored as floats.
/// Domain: moments of depths in [-1, 1]. For moments of no such distribution depths may lie outside, but in [-8193,
/// 8193]: depths more than 2^13 apart are replaced by the single depth b1, clamped to [-1, 1].
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 2
fn two_point_distribution(b1: f32, b2: f32, b3: f32, least_variance: f32) -> gnomon_distribution2_
{
    let v = subtract_product_ordered(b2, b1, b1);
    let c = subtract_product(b3, b1, b2);
    let mean = clamp_or_nan(b1, -1.0, 1.0);
    let variance = v.high + v.low;
    let single = !(variance > gnomon_max(least_variance, gnomon_pivot_floor));
    let g = clamp_or_nan((c.high + c.low) / variance - 2.0 * mean, -4096.0, 4096.0);
    let root = 0.5 * (gnomon_abs(g) + gnomon_sqrt(g * g + 4.0 * variance));
    let far_side = gnomon_select(g < 0.0, -root, root);
    let near_side = -variance / far_side;
    let x1 = gnomon_min(far_side, near_side);
    let x2 = gnomon_max(far_side, near_side);
    let any_nan = variance + (c.high + c.low);
    let known = any_nan == any_nan;
    let two = known && (!single) && (x2 - x1 > 0.0) && (x2 - x1 < 8192.0);
    let centre = gnomon_select(known, mean, 1.0);
    var d: gnomon_distribution2_;
    d.depth1_ = gnomon_select(two, mean + x1, centre);
    d.depth2_ = gnomon_select(two, mean + x2, centre);
    d.weight2_ = gnomon_select(two, saturate_or_zero(-x1 / (x2 - x1)), 0.0);
    d.weight1_ = 1.0 - d.weight2_;
    return d;
}

const two_point_unorm16_least_variance: f32 = 0x1.4f8b58p-15; // 4.0e-5, 5.26 times half a code
const two_point_noise_0_: f32 = 0x1.bb645ap-1; // 0.866
const two_point_noise_2_: f32 = 0x1.b33334p+1; // 3.4

/// The moment b3 of two depths from three moments of theta4 (quantization.h), each of whose channels storage has
/// rounded by noise at
/// most: with the part of the third central moment that noise explains taken out, so that close depths keep their mean
/// and variance and get equal weights.
///
/// Rounding moves the third central moment k by e = noise (0.87 + 3.4 b1^2), a standard deviation of channels that are
/// uniformly off. A skew k / V^(3/2) of the order of 1 and noise make the best estimate V^3 / (V^3 + e^2) of k.
/// Domain: moments of depths in [-1, 1].
/// NaN: NaN.
fn two_point_third_moment(b1: f32, b2: f32, b3: f32, noise: f32) -> f32
{
    let variance = gnomon_max(0.0, b2 - b1 * b1);
    let third = (b3 - b1 * b2) - 2.0 * b1 * variance;
    let e = noise * (two_point_noise_0_ + two_point_noise_2_ * (b1 * b1));
    let cubed = variance * (variance * variance);
    return b3 - third * (e * e / (cubed + e * e + gnomon_pivot_floor));
}
