// Gnomon 0.1.0, blocker6.wgsl: shadow filtering in WGSL, this file alone.
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
///     error, float, hankel6_from_unorm16: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10: p99 3e-5, p99.9 9e-5, max 8e-4
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
///     error, float, hankel4_from_unorm16: p99 4e-4, p99.9 2e-3, max 5e-2
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

// soft/blocker.h ------------------------------------------------------------------------------------------------------

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
fn blocker4_depth(h: hankel4_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let u = z - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    let s = hamburger4_lower_scale * q;
    let n = hamburger4_lower_scale * h.determinant;
    let un = u * n;
    let a = s * h.variance;
    let b = 0.5 * (un - s * h.third);
    let r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    let e = u * un + q * s;
    let w = h.variance * n;
    let whole = w + e;
    let between = q < 0.0;
    let rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    let share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    let total = blocker_epsilon * (whole * gnomon_select(between, r + r, 1.0)) + share;
    return gnomon_blocker_depth_before(z, rest / total);
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
