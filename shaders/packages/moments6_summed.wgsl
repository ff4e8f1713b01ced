// Gnomon 0.1.0, moments6_summed.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/cubic.h ----------------------------------------------------------------------------------------------------
// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
const gnomon_cubic_cosine0_: f32 = 0x1.00013ap-1; // 0.50000938
const gnomon_cubic_cosine1_: f32 = 0x1.2758bcp-1; // 0.57684887
const gnomon_cubic_cosine2_: f32 = -0x1.b4ea78p-4; // -0.10666892
const gnomon_cubic_cosine3_: f32 = 0x1.3c6c52p-5; // 0.03862587
const gnomon_cubic_cosine4_: f32 = -0x1.211814p-7; // -0.00882245
const gnomon_cubic_minus_third: f32 = -0x1.555556p-2; // -0.33333333333333331

/// The result of a Halley step as a fraction, whose denominator is positive.
struct gnomon_cubic_step { numerator: f32, denominator: f32 }

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
fn gnomon_cubic_halley_step(b: f32, c: f32, d: f32, t: f32) -> gnomon_cubic_step
{
    let tb = t + b;
    let f = tb * (t * t) + (c * t + d);
    let s = (tb + (tb + t)) * t + c;
    let r = (t + t) + tb;
    let whole = s * s - f * r; // positive except at a multiple root
    let simple = whole > 0.0;
    var x: gnomon_cubic_step;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, 1.0);
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
fn gnomon_cubic_halley(b: f32, c: f32, d: f32, t: f32) -> f32
{
    let x = gnomon_cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
fn gnomon_cubic_start(b: f32, c: f32, d: f32) -> f32
{
    let mean = gnomon_cubic_minus_third * b;
    let mean2 = mean * mean;
    let spread2 = gnomon_max(mean2 + gnomon_cubic_minus_third * c, 0.0);
    let spread = gnomon_sqrt(spread2);
    let g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    let inverse = 1.0 / spread2;
    let cosine = (g * inverse) * (spread * inverse);
    let q2 = gnomon_min(gnomon_max(0.5 + 0.25 * cosine, 0.0), 1.0);
    let q = gnomon_sqrt(q2);
    let start = (gnomon_cubic_cosine0_ + q * gnomon_cubic_cosine1_) + q2 *
                ((gnomon_cubic_cosine2_ + q * gnomon_cubic_cosine3_) + q2 * gnomon_cubic_cosine4_);
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
fn gnomon_cubic_positive_root(b: f32, c: f32, d: f32) -> gnomon_cubic_step
{
    let t = gnomon_cubic_start(b, c, d);
    return gnomon_cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
fn cubic_largest_root(b: f32, c: f32, d: f32) -> f32
{
    let x = gnomon_cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
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

// moments/moments.h, six moments --------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.

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

// moments/hankel6.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of six moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side, for m = 6; Sec. 5.4).
//
// A step of elimination leaves the covariances c_ij = b_(i+j) - b_i b_j of (z, z^2, z^3). The next, without divisions
// (Bareiss 1968), leaves s_22 = c_11 c_22 - c_12^2, s_23 and s_33, and the last t = s_22 s_33 - s_23^2. The
// factorization L D L^T has the pivots D_1 = c_11, D_2 = s_22 / c_11 and D_3 = t / (c_11 s_22), and l21 = c_12 / c_11
// and l32 = s_23 / s_22 below the diagonal. With u = z - b1, the monic orthogonal polynomials of the distribution, for
// which D_k = E[P_k^2], follow a three-term recurrence (Gautschi 2004, Sec. 1.3):
//     P_1 = u,    P_2 = (u - (l21 - 2 b1)) P_1 - D_1,    P_3 = (u - (l32 - l21 - b1)) P_2 - (D_2 / D_1) P_1
// Every difference of moments cancels, so all are computed from exact products. A bias (bias.h) is added to the
// covariances, as double words that are kept until a pivot is complete, because added to the moments it would
// be rounded away.
//
// hamburger6.h needs D_3 K(z, z) = D_3 + (D_3 / D_1) P_1^2 + (D_3 / D_2) P_2^2 + P_3^2, whose weights are stored. The
// only quotients are 1 / D_1 and 1 / s_22, and neither waits for t.

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
struct hankel6_ { mean: f32, variance: f32, shift2_: f32, shift3_: f32, ratio: f32, whole: f32, first: f32,
    second: f32 }

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
fn gnomon_hankel6_make(mean: f32, c11: f32, c12: f32, s22: f32, s23: f32, t: f32) -> hankel6_
{
    var h: hankel6_;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, c11);
    let inverse1 = 1.0 / h.variance;
    let s = gnomon_max(gnomon_pivot_floor * h.variance, s22);
    let inverse_s = 1.0 / s;
    let l21 = c12 * inverse1;
    h.shift2_ = l21 - (mean + mean);
    h.shift3_ = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(gnomon_pivot_floor, (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
struct gnomon_covariances6_ { c11_: gnomon_double_word, c12_: gnomon_double_word, c13_: gnomon_double_word,
    c22_: gnomon_double_word, c23_: gnomon_double_word, c33_: gnomon_double_word }

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
fn gnomon_covariances6_from_moments(b: moments6_) -> gnomon_covariances6_
{
    var c: gnomon_covariances6_;
    c.c11_ = subtract_product_ordered(b.b2_, b.b1_, b.b1_);
    c.c12_ = subtract_product(b.b3_, b.b1_, b.b2_);
    c.c13_ = subtract_product_ordered(b.b4_, b.b1_, b.b3_);
    c.c22_ = subtract_product_ordered(b.b4_, b.b2_, b.b2_);
    c.c23_ = subtract_product(b.b5_, b.b2_, b.b3_);
    c.c33_ = subtract_product_ordered(b.b6_, b.b3_, b.b3_);
    return c;
}

/// a b - c d as a double word, for factors whose low words may be as large as the high ones.
/// Domain: a b >= |c d| for the high words.
/// Error: in float 2^-45 of both products of the high words, and 2^-21 of the contributions of the low words.
fn gnomon_hankel6_minor(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word,
                        d: gnomon_double_word) -> gnomon_double_word
{
    let p = two_product(a.high, b.high);
    let q = two_product(c.high, d.high);
    var r = two_difference_ordered(p.high, q.high);
    let up = a.high * b.low + a.low * (b.high + b.low);
    let down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
fn gnomon_hankel6_factor(mean: f32, c: gnomon_covariances6_) -> hankel6_
{
    let s22 = gnomon_hankel6_minor(c.c11_, c.c22_, c.c12_, c.c12_);
    let s23 = gnomon_double_word_minor(c.c11_, c.c23_, c.c12_, c.c13_);
    let s33 = gnomon_hankel6_minor(c.c11_, c.c33_, c.c13_, c.c13_);
    return gnomon_hankel6_make(mean, c.c11_.high + c.c11_.low, c.c12_.high + c.c12_.low, s22.high + s22.low, s23.high +
                               s23.low, gnomon_double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
fn hankel6_constant_bias(b: moments6_, bias2: f32, bias4: f32, bias6: f32, alpha: f32) -> hankel6_
{
    let keep = 1.0 - alpha;
    let odds = alpha / keep;
    let d2 = b.b2_ - bias2;
    let e1 = alpha * b.b1_;
    let e2 = alpha * d2;
    let e3 = alpha * b.b3_;
    var c = gnomon_covariances6_from_moments(b);
    c.c11_.low = c.c11_.low + (e1 * b.b1_ + odds * bias2);
    c.c12_.low = c.c12_.low + e1 * d2;
    c.c13_.low = c.c13_.low + (e1 * b.b3_ + odds * bias4);
    c.c22_.low = c.c22_.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23_.low = c.c23_.low + e2 * b.b3_;
    c.c33_.low = c.c33_.low + (e3 * b.b3_ + odds * bias6);
    var h = gnomon_hankel6_factor(b.b1_ - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
fn hankel6_from_moments(b: moments6_) -> hankel6_
{
    let c11 = b.b2_ - b.b1_ * b.b1_;
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let c13 = b.b4_ - b.b1_ * b.b3_;
    let s22 = c11 * (b.b4_ - b.b2_ * b.b2_) - c12 * c12;
    let s23 = c11 * (b.b5_ - b.b2_ * b.b3_) - c12 * c13;
    let s33 = c11 * (b.b6_ - b.b3_ * b.b3_) - c13 * c13;
    return gnomon_hankel6_make(b.b1_, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

// moments/hamburger6.h ------------------------------------------------------------------------------------------------
// Shadow intensity from six moments, by the method of hamburger4.h (Peters et al. 2017, Sec. 5.4 and Alg. 1). Surface
// shadows need four moments only. Six serve where many surfaces lie behind one another, as in single scattering.
//
// With K(x, y) = sum_k P_k(x) P_k(y) / D_k and w(z) = 1 / K(z, z), the number a of nodes above z_f is the number of
// sign changes in P_0(z_f), ..., P_3(z_f):
//     a = 0:  lower = 1 - w_f                        a = 2:  lower = w(smallest root)
//     a = 1:  lower = 1 - w_f - w(largest root)      a = 3:  lower = 0
// At most one root is needed, and that root is alone on its side of z_f. In t = 1 / (z - z_f) it is the only one of its
// sign among the roots of
//     k0 t^3 + k1 t^2 + k2 t + k3,      k0 = K(z_f, z_f) >= 1,      k_j = (d/dz)^j K(z_f, z) / j! at z_f.
// After a change of sign it is the largest of three real roots, which cubic.h finds.

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
struct gnomon_distribution4_ { depth0_: f32, depth1_: f32, depth2_: f32, depth3_: f32, weight0_: f32, weight1_: f32,
    weight2_: f32, weight3_: f32 }

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
struct gnomon_polynomials6_ { p1_: f32, p2_: f32, p3_: f32 }

/// P_1, P_2 and P_3 at the depth mean + u.
fn gnomon_hamburger6_polynomials(h: hankel6_, u: f32) -> gnomon_polynomials6_
{
    var p: gnomon_polynomials6_;
    p.p1_ = u;
    p.p2_ = (u - h.shift2_) * u - h.variance;
    p.p3_ = (u - h.shift3_) * p.p2_ - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
fn gnomon_hamburger6_kernel(h: hankel6_, p: gnomon_polynomials6_) -> f32
{
    return (h.whole + h.first * (p.p1_ * p.p1_)) + (h.second * (p.p2_ * p.p2_) + p.p3_ * p.p3_);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
struct gnomon_derivatives6_ { slope2_: f32, slope3_: f32, bend3_: f32 }

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
fn gnomon_hamburger6_derivatives(h: hankel6_, p: gnomon_polynomials6_) -> gnomon_derivatives6_
{
    let v = p.p1_ - h.shift3_;
    var d: gnomon_derivatives6_;
    d.slope2_ = (p.p1_ + p.p1_) - h.shift2_;
    d.slope3_ = (p.p2_ + v * d.slope2_) - h.ratio;
    d.bend3_ = d.slope2_ + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
fn gnomon_hamburger6_polynomials_shift(given_p: gnomon_polynomials6_, d: gnomon_derivatives6_,
                                       distance_: f32) -> gnomon_polynomials6_
{
    var p = given_p;
    p.p1_ = p.p1_ + distance_;
    p.p2_ = p.p2_ + distance_ * (d.slope2_ + distance_);
    p.p3_ = p.p3_ + distance_ * (d.slope3_ + distance_ * (d.bend3_ + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
struct hamburger6_cubic { b: f32, c: f32, d: f32 }

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
fn gnomon_hamburger6_other_nodes(h: hankel6_, p: gnomon_polynomials6_, d: gnomon_derivatives6_, inverse: f32,
                                 side: f32) -> hamburger6_cubic
{
    let q2 = h.second * p.p2_;
    var r: hamburger6_cubic;
    r.b = inverse * (side * (h.first * p.p1_ + (d.slope2_ * q2 + d.slope3_ * p.p3_)));
    r.c = inverse * (q2 + d.bend3_ * p.p3_);
    r.d = inverse * (side * p.p3_);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
fn gnomon_hamburger6_distance(t: f32) -> f32
{
    let least = 0.0009765625;
    let away = gnomon_select(t < 0.0, gnomon_min(t, -least), gnomon_max(t, least));
    return 1.0 / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
struct hamburger6_sums { lower: f32, distance: f32, weight: f32 }

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
fn gnomon_hamburger6_sums_at(h: hankel6_, u: f32) -> hamburger6_sums
{
    let p = gnomon_hamburger6_polynomials(h, u);
    let inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    let positive1 = p.p1_ > 0.0;
    let positive2 = p.p2_ > 0.0;
    let positive3 = p.p3_ > 0.0;
    let all_below = positive1 && positive2 && positive3;
    let all_above = (!positive1) && positive2 && (!positive3);
    let outside = all_below || all_above;
    var r: hamburger6_sums;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, 1.0 - r.weight, 0.0);
    r.distance = gnomon_select(all_below, p.p1_, 0.0);
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        let side = gnomon_select(positive3, -1.0, 1.0);
        let d = gnomon_hamburger6_derivatives(h, p);
        let n = gnomon_hamburger6_other_nodes(h, p, d, inverse, side);
        let t = gnomon_cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        let away = t.denominator / gnomon_max(t.numerator, 0.0009765625 * t.denominator);
        let w = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (1.0 - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1_ + w * away));
    }
    return r;
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, four depths and more: p99 1e-14, p99.9 4e-14
///     error, float, hankel6_constant_bias at 5e-6: p99 2e-5, p99.9 5e-5, max 2e-4
/// and against the kernel in double,
///     error, float, hankel6_from_float: p99 2e-5, p99.9 5e-5, max 2e-4
///     error, float, hankel6_from_float_filtered: p99 1e-5, p99.9 3e-5, max 1e-4
///     error, float, hankel6_from_unorm16_: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10_: p99 3e-5, p99.9 9e-5, max 8e-4
///     error, float, hankel6_from_unorm10_filtered: p99 2e-5, p99.9 5e-5, max 3e-4
/// Maxima are found by climbing and stated with a margin. Without a bias there is no maximum: if D_3 is at the floor,
/// moments rounded in double cannot resolve distances below 2^-32.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_bounds(h: hankel6_, z_f: f32) -> hamburger_bounds
{
    let s = gnomon_hamburger6_sums_at(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    var r: hamburger_bounds;
    r.lower = saturate_or_zero(s.lower);
    r.weight = gnomon_min(saturate_or_zero(s.weight), 1.0 - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger6_bounds.
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
fn hamburger6_lower(h: hankel6_, z_f: f32) -> f32 { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_distribution(h: hankel6_, z_f: f32) -> gnomon_distribution4_
{
    let p = gnomon_hamburger6_polynomials(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    let inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    let side = gnomon_select(p.p3_ > 0.0, -1.0, 1.0);
    let n = gnomon_hamburger6_other_nodes(h, p, gnomon_hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    let t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    let large = (t1 * t1) * t1 > -n.d;
    let backward = -n.d / t1;
    let forward = n.b + t1;
    let b = 0.5 * gnomon_select(large, (backward - n.c) / t1, forward);
    let c = gnomon_select(large, backward, n.c + t1 * forward);
    let q = quadratic_roots(1.0, b, c);
    let t2 = gnomon_cubic_halley(n.b, n.c, n.d, q.first);
    let t3 = gnomon_cubic_halley(n.b, n.c, n.d, q.second);
    let x1 = p.p1_ + side * gnomon_hamburger6_distance(t1);
    let x2 = p.p1_ + side * gnomon_hamburger6_distance(t2);
    let x3 = p.p1_ + side * gnomon_hamburger6_distance(t3);
    let low = gnomon_min(x2, x3);
    let high = gnomon_max(x2, x3);
    let y1 = gnomon_min(x1, low);
    let y2 = gnomon_max(gnomon_min(x1, high), low);
    let y3 = gnomon_max(x1, high);
    let w0 = h.whole * inverse;
    let w1 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y1));
    let w2 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y2));
    let w3 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y3));
    let sum = (w0 + w1) + (w2 + w3);
    let known = sum > 0.0; // false for NaN
    var d: gnomon_distribution4_;
    d.depth0_ = gnomon_select(known, h.mean + p.p1_, 1.0);
    d.depth1_ = gnomon_select(known, h.mean + y1, 1.0);
    d.depth2_ = gnomon_select(known, h.mean + y2, 1.0);
    d.depth3_ = gnomon_select(known, h.mean + y3, 1.0);
    d.weight1_ = gnomon_select(known, w1 / sum, 0.0);
    d.weight2_ = gnomon_select(known, w2 / sum, 0.0);
    d.weight3_ = gnomon_select(known, w3 / sum, 0.0);
    d.weight0_ = saturate_or_zero(1.0 - (d.weight1_ + (d.weight2_ + d.weight3_)));
    return d;
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

// soft/blocker.h ------------------------------------------------------------------------------------------------------
// The mean depth of blockers, the surfaces of a search region that are before the receiver, from moments of the region:
// the blocker search of percentage-closer soft shadows in one look-up (Peters et al. 2017, Sec. 4.3; Yang et al. 2010).
//
// The moments name a canonical distribution with a node at the receiver's depth z_f (hamburger4.h). With A, the sum of
// w (z_f - x) over its nodes x before z_f, and their weight w, the lower bound on the shadow intensity, the result is
//     z_f - A / (epsilon + lower),
// Equation 4 of the paper, in which epsilon makes little of blockers of little weight, and returns z_f where none is.
// A needs no node: since the mean of (x - z_f) over all nodes is -u, with u = z_f - mean, and with the notation of
// hamburger4.h,
//     both nodes before z_f:    A = u
//     one:                      A = (u (b + r) - V a) / (2 r)
//     none:                     A = 0
// so the whole takes one division and one square root. Two moments have the one node mean - V / u beside z_f, and A is
// u where that is before z_f. The result is exact for a region of one or two surfaces, and of three with one at z_f.

const blocker_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
fn gnomon_blocker_depth_before(z_f: f32, distance_: f32) -> f32
{
    return gnomon_max(z_f - gnomon_max(distance_, 0.0), -1.0);
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
fn blocker2_depth(mean: f32, variance: f32, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let u = z - mean;
    let whole = variance + u * u;
    let below = u * whole;
    let total = blocker_epsilon * whole + u * u;
    return gnomon_blocker_depth_before(z, below / total);
}

// soft/blocker6.h -----------------------------------------------------------------------------------------------------
// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
fn blocker6_depth(h: hankel6_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let s = gnomon_hamburger6_sums_at(h, z - h.mean);
    return gnomon_blocker_depth_before(z, s.distance / (blocker_epsilon + gnomon_max(s.lower, 0.0)));
}

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

// soft/summed_area.h --------------------------------------------------------------------------------------------------
// Summed-area tables of the channels of a shadow map, and look-ups of any rectangle in them (Crow 1984; Peters et al.
// 2017, Sec. 4.2 to 4.4).
//
// Let P(x, y) be the sum of the channels over all texels (i, j) with i < x and j < y. The table holds P(x + 1, y + 1)
// at texel (x, y), in 32-bit unsigned integers that wrap around; P is 0 where x or y is 0. The sum over the texels from
// (x0, y0) to before (x1, y1) is a difference of four such integers, of which none that wraps does harm:
//
//     rectangle = summed_area_clip(summed_area_around(x, y, width_x, width_y), map_width, map_height, most_texels);
//
//     on the grid, 4 texels:       r = summed_area_grow(rectangle);
//                                  s = P(r.x1, r.y1) - P(r.x0, r.y1) - P(r.x1, r.y0) + P(r.x0, r.y0);    in integers
//                                  area = (r.x1 - r.x0) * (r.y1 - r.y0);
//
//     interpolated, 16 texels:     a = summed_area_split(rectangle.x0, rectangle.x1), b = the same of y0 and y1
//                                  s = the sum over both axes of width_i width_j times the sum of rectangle (i, j)
//                                  area = summed_area_width(a) * summed_area_width(b);
//
//     channel = s / (area * scale)                                        storage/moments4_summed.h and its siblings
//
// A code is the nearest whole number to scale times a channel in [0, 1]. most_texels is the most texels that a look-up
// on the grid may cover: (ceil(w_x) + 1) (ceil(w_y) + 1) for the largest rectangle. Positions are in texels, with
// centres at +0.5.

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
struct summed_area_rectangle { x0_: f32, y0_: f32, x1_: f32, y1_: f32 }

const summed_area_range: f32 = 4294967296.0; // 2^32
const summed_area_most_texels: f32 = 1048576.0; // 2^20
const summed_area_step: f32 = 5.9604644775390625e-8; // 2^-24
const summed_area_slack: f32 = 0.0009765625; // 2^-10

const summed_area_code_noise: f32 = 0x1.p-33; // 1.1641532182693481e-10, 2^-33
const summed_area_float_noise: f32 = 5.9604644775390625e-8; // 2 times 2^-25
const summed_area_least_noise: f32 = 0x1.2p-23; // 1.3411045074462891e-7, 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
fn summed_area_noise(most_texels: f32) -> f32
{
    let noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_scale(most_texels: f32) -> f32
{
    let n = clamp_or_high(most_texels, 1.0, summed_area_most_texels);
    let range = summed_area_range;
    let s = range / n;
    var whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0, 0.0);
    let sum = two_product(whole, n);
    let wraps = 0.0 <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0, summed_area_step * whole), 0.0);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_code(channel: f32, scale: f32) -> f32
{
    let p = two_product(saturate_or_zero(channel), scale);
    var code = nearest_natural(p.high);
    let rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5 < rest, 1.0, 0.0);
    return code - gnomon_select(rest < -0.5, 1.0, 0.0);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
fn summed_area_around(x: f32, y: f32, width_x: f32, width_y: f32) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = x - 0.5 * width_x;
    r.y0_ = y - 0.5 * width_y;
    r.x1_ = x + 0.5 * width_x;
    r.y1_ = y + 0.5 * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
fn gnomon_summed_area_above(x: f32) -> f32 { return -1.0 * texel_below(-1.0 * x); }

/// The begin and the end of a rectangle along one axis.
struct summed_area_interval { begin: f32, end: f32 }

/// The interval from begin to end.
fn gnomon_summed_area_interval_from(begin: f32, end: f32) -> summed_area_interval
{
    var r: summed_area_interval;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
fn gnomon_summed_area_shrink(begin: f32, end: f32, texels: f32, most: f32) -> summed_area_interval
{
    let width = most - 1.0;
    let low = 0.5 * (begin + end) - 0.5 * width;
    let large = most < texels;
    var r: summed_area_interval;
    r.begin = gnomon_select(large, low, begin);
    r.end = gnomon_select(large, low + width, end);
    return r;
}

/// The part of a rectangle that a look-up may read: clipped to the map, and if the texels that it touches are more than
/// most_texels, shrunk along both axes about its centre. A rectangle without a part in the map, or with its ends in the
/// wrong order, becomes the empty one, all 0, and look-ups in it are lit.
/// Domain: width and height whole numbers in [1, 65536]; most_texels in [4, 2^20], clamped.
/// NaN: empty.
/// Error: the ends are exact unless the rectangle shrinks.
fn summed_area_clip(rectangle: summed_area_rectangle, width: f32, height: f32,
                    most_texels: f32) -> summed_area_rectangle
{
    let limit = gnomon_texel_limit;
    let right = clamp_or_high(width, 1.0, limit);
    let bottom = clamp_or_high(height, 1.0, limit);
    let x0 = clamp_or_nan(rectangle.x0_, 0.0, right);
    let y0 = clamp_or_nan(rectangle.y0_, 0.0, bottom);
    let x1 = clamp_or_nan(rectangle.x1_, 0.0, right);
    let y1 = clamp_or_nan(rectangle.y1_, 0.0, bottom);
    let columns = gnomon_summed_area_above(x1) - texel_below(x0);
    let rows = gnomon_summed_area_above(y1) - texel_below(y0);
    let most = clamp_or_high(most_texels, 4.0, summed_area_most_texels);
    let large = most < columns * rows;
    var x = gnomon_summed_area_interval_from(x0, x1);
    var y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        let share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0));
        let least_columns = gnomon_min(columns, 2.0);
        let least_rows = gnomon_min(rows, 2.0);
        let most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                      texel_below(most / least_rows));
        let most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    let some = x0 < x1 && y0 < y1; // false for NaN
    var r: summed_area_rectangle;
    r.x0_ = gnomon_select(some, x.begin, 0.0);
    r.y0_ = gnomon_select(some, y.begin, 0.0);
    r.x1_ = gnomon_select(some, x.end, 0.0);
    r.y1_ = gnomon_select(some, y.end, 0.0);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
fn summed_area_grow(rectangle: summed_area_rectangle) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = texel_below(rectangle.x0_);
    r.y0_ = texel_below(rectangle.y0_);
    r.x1_ = gnomon_summed_area_above(rectangle.x1_);
    r.y1_ = gnomon_summed_area_above(rectangle.y1_);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
struct summed_area_parts { line0_: f32, line1_: f32, line2_: f32, line3_: f32, width0_: f32, width1_: f32,
    width2_: f32 }

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
fn summed_area_split(begin: f32, end: f32) -> summed_area_parts
{
    let first = texel_below(begin);
    let last = gnomon_max(gnomon_summed_area_above(end) - 1.0, first);
    let single = last <= first;
    var r: summed_area_parts;
    r.line0_ = first;
    r.line1_ = first + 1.0;
    r.line2_ = gnomon_max(last, r.line1_);
    r.line3_ = last + 1.0;
    r.width0_ = saturate_or_zero(gnomon_select(single, end, r.line1_) - begin);
    r.width1_ = gnomon_select(single, 0.0, 1.0);
    r.width2_ = gnomon_select(single, 0.0, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
fn summed_area_width(parts: summed_area_parts) -> f32
{
    return (parts.width0_ + parts.width1_ * (parts.line2_ - parts.line1_)) + parts.width2_;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
fn summed_area_mean(sum: f32, area: f32, scale: f32) -> f32
{
    let whole = two_product(area, scale);
    let mean = saturate_or_zero(sum / whole.high);
    let p = two_product(mean, whole.high);
    let rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
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

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.

struct channels1_ { c1_: f32 }

struct channels2_ { c1_: f32, c2_: f32 }

struct channels5_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32 }

// moments/channels.h, six moments -------------------------------------------------------------------------------------

struct channels6_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32, c6_: f32 }

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.

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

// storage/moments6.h --------------------------------------------------------------------------------------------------
// Six moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow or
// to the factored Hankel matrix. Each format undoes its own transform and applies the constant bias that belongs to it,
// so that nobody pairs the wrong three.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   6 x 10 UNORM      8     theta6_      moments6_unorm10_encode   moments6_unorm10_intensity   hankel6_from_unorm10_
//   6 x 16 UNORM     12     theta6_      moments6_unorm16_encode   moments6_unorm16_intensity   hankel6_from_unorm16_
//   6 x float        24     none        moments6_float_encode     moments6_float_intensity     hankel6_from_float
//
// Texels of 6 x 10 UNORM are two 10-10-10-2 words: odd channels (c1, c2, c3) in the first, even ones (c4, c5, c6) in
// the second. Filters are linear: average channels as they are.
//
// Intensities exceed Z(z < z_f) by the weight at most, for every receiver: by the proof in bias.h n roundings need a
// weight of n delta / (n delta + r).
//
//                  delta      n = 1     weight    n = 3     weight, filtered
//   6 x 10 UNORM   1/2046     3.34e-3   4e-3      9.96e-3   1e-2
//   6 x 16 UNORM   1/131070   5.23e-5   8e-5      1.57e-4   1.6e-4
//   6 x float      2^-25      1.83e-6   5e-6                2e-5
//
// Filtered: rounded when rendered and by each of two passes of nine taps, their sums in float. Sums of floats round as
// storage does, and so do the powers of a depth: at their worst they are 22 roundings and 4e-5, which do not come
// together. The kernel's own arithmetic in float is within the weights. Tests search for the largest excess by hill
// climbing (tests/moments/honest_six.cpp), and find that 5e-6 is too little for filtered floats.

const gnomon_stored6_unorm10_weight: f32 = 0x1.0624dep-8; // 4e-3
const gnomon_stored6_unorm10_filtered_weight: f32 = 0x1.47ae14p-7; // 1e-2
const gnomon_stored6_unorm16_weight: f32 = 0x1.4f8b58p-14; // 8e-5
const gnomon_stored6_unorm16_filtered_weight: f32 = 0x1.4f8b58p-13; // 1.6e-4
const gnomon_stored6_float_weight: f32 = 0x1.4f8b58p-18; // 5e-6
const gnomon_stored6_float_filtered_weight: f32 = 0x1.4f8b58p-16; // 2e-5

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_unorm10_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_unorm16_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn moments6_float_encode(z: f32) -> channels6_
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

/// The factored matrix of the channels of theta6_, with a constant bias of weight alpha.
fn gnomon_hankel6_from_theta(c: channels6_, alpha: f32) -> hankel6_
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), gnomon_bias6_theta_b2_, gnomon_bias6_theta_b4_,
                                                  gnomon_bias6_theta_b6_, alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
fn hankel6_from_unorm10_(c: channels6_) -> hankel6_ { return gnomon_hankel6_from_theta(c,
                                                                                       gnomon_stored6_unorm10_weight); }

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
fn hankel6_from_unorm10_filtered(c: channels6_) -> hankel6_
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_filtered_weight);
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
fn hankel6_from_unorm16_(c: channels6_) -> hankel6_ { return gnomon_hankel6_from_theta(c,
                                                                                       gnomon_stored6_unorm16_weight); }

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
fn hankel6_from_unorm16_filtered(c: channels6_) -> hankel6_
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
fn hankel6_from_float(c: channels6_) -> hankel6_
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2_, bias6_raw_b4_, bias6_raw_b6_,
                                 gnomon_stored6_float_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
fn hankel6_from_float_filtered(c: channels6_) -> hankel6_
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2_, bias6_raw_b4_, bias6_raw_b6_,
                                 gnomon_stored6_float_filtered_weight);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm10_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_unorm10_(c),
                                                                                        z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm10_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm16_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_unorm16_(c),
                                                                                        z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm16_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_float_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_float(c), z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_float_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
}

// storage/moments6_summed.h -------------------------------------------------------------------------------------------
// Six moments in a summed-area table (soft/summed_area.h): moments4_summed.h for search regions that hold more
// surfaces, in 24 bytes a texel.
//
//   a texel:        c = moments6_summed_encode(z)               channels of theta6_; a resolve averages them
//                   codes = moments6_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments6_summed_channels(sums, area, scale)
//                   z_b = moments6_summed_blocker(c, most_texels, z_f)
//                   shadow = moments6_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by half a code, most_texels 2^-33, and by what float arithmetic rounds. Intensities exceed Z(z <
// z_f) by moments6_summed_weight at most.

const moments6_summed_code_weight: f32 = 0x1.b7cdfep-31; // 8e-10, 2^-33 / r
const moments6_summed_float_weight: f32 = 0x1.92a738p-18; // 6e-6

/// The weight of the constant bias of a table for most_texels, by which intensities may exceed the truth.
/// Domain: most_texels as of the table's scale.
/// NaN: the weight of a small table.
fn moments6_summed_weight(most_texels: f32) -> f32
{
    let weight = moments6_summed_code_weight * most_texels + moments6_summed_float_weight;
    return gnomon_min(gnomon_max(weight, moments6_summed_float_weight), 0.5);
}

/// The six channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_summed_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
fn moments6_summed_codes(c: channels6_, scale: f32) -> channels6_
{
    let any = (clamp_or_nan(c.c1_, 0.0, 1.0) + clamp_or_nan(c.c2_, 0.0, 1.0)) +
              (clamp_or_nan(c.c3_, 0.0, 1.0) + clamp_or_nan(c.c4_, 0.0, 1.0)) +
              (clamp_or_nan(c.c5_, 0.0, 1.0) + clamp_or_nan(c.c6_, 0.0, 1.0));
    let known = any == any;
    let border = moments6_summed_encode(1.0);
    var r: channels6_;
    r.c1_ = summed_area_code(gnomon_select(known, c.c1_, border.c1_), scale);
    r.c2_ = summed_area_code(gnomon_select(known, c.c2_, border.c2_), scale);
    r.c3_ = summed_area_code(gnomon_select(known, c.c3_, border.c3_), scale);
    r.c4_ = summed_area_code(gnomon_select(known, c.c4_, border.c4_), scale);
    r.c5_ = summed_area_code(gnomon_select(known, c.c5_, border.c5_), scale);
    r.c6_ = summed_area_code(gnomon_select(known, c.c6_, border.c6_), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
fn moments6_summed_channels(sums: channels6_, area: f32, scale: f32) -> channels6_
{
    let some = 0.0 < area;
    let border = moments6_summed_encode(1.0); // off by roundings, also beyond 1
    var r: channels6_;
    r.c1_ = gnomon_select(some, summed_area_mean(sums.c1_, area, scale), saturate_or_zero(border.c1_));
    r.c2_ = gnomon_select(some, summed_area_mean(sums.c2_, area, scale), saturate_or_zero(border.c2_));
    r.c3_ = gnomon_select(some, summed_area_mean(sums.c3_, area, scale), saturate_or_zero(border.c3_));
    r.c4_ = gnomon_select(some, summed_area_mean(sums.c4_, area, scale), saturate_or_zero(border.c4_));
    r.c5_ = gnomon_select(some, summed_area_mean(sums.c5_, area, scale), saturate_or_zero(border.c5_));
    r.c6_ = gnomon_select(some, summed_area_mean(sums.c6_, area, scale), saturate_or_zero(border.c6_));
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha.
fn gnomon_hankel6_from_summed_theta(c: channels6_, alpha: f32) -> hankel6_
{
    return hankel6_constant_bias(theta6_inverse(c), gnomon_bias6_theta_b2_, gnomon_bias6_theta_b4_,
                                 gnomon_bias6_theta_b6_, alpha);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
fn hankel6_from_summed(c: channels6_, most_texels: f32) -> hankel6_
{
    return gnomon_hankel6_from_summed_theta(c, moments6_summed_weight(most_texels));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
fn moments6_summed_intensity(c: channels6_, most_texels: f32, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
fn moments6_summed_blocker(c: channels6_, most_texels: f32, z_f: f32) -> f32
{
    return blocker6_depth(hankel6_from_summed(c, most_texels), z_f);
}
