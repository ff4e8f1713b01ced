// Gnomon 0.1.0, hamburger_cholesky.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.

const gnomon_trigonometry_two_over_pi: f32 = 0x1.45f306p-1; // 0.63661977236758134
const gnomon_trigonometry_half_pi_low: f32 = 0x1.4442d2p-24; // 7.5497899548918821e-8
const gnomon_trigonometry_half_pi: f32 = 0x1.921fb6p+0; // 1.5707963267948966
const gnomon_trigonometry_quarter_pi_low: f32 = 0x1.5110b4p-23; // 1.5695823932524066e-7
const gnomon_trigonometry_tan_pi_8_: f32 = 0x1.a8279ap-2; // 0.41421356237309505

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
const gnomon_sin_float_0_: f32 = -0x1.555546p-3; // -0.16666654609567105
const gnomon_sin_float_1_: f32 = 0x1.11073ap-7; // 0.0083321607625195058
const gnomon_sin_float_2_: f32 = -0x1.9943e2p-13; // -0.00019515283258365583

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
const gnomon_cos_float_0_: f32 = 0x1.55554ap-5; // 0.041666645683017541
const gnomon_cos_float_1_: f32 = -0x1.6c0c34p-10; // -0.0013887316256332952
const gnomon_cos_float_2_: f32 = 0x1.99eb9cp-16; // 2.4433157272163749e-05

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
const gnomon_atan_float_0_: f32 = -0x1.55554ap-2; // -0.33333315189495832
const gnomon_atan_float_1_: f32 = 0x1.999196p-3; // 0.19998471559801789
const gnomon_atan_float_2_: f32 = -0x1.23b524p-3; // -0.14243534037509495
const gnomon_atan_float_3_: f32 = 0x1.b1ec3cp-4; // 0.10593818186484773
const gnomon_atan_float_4_: f32 = -0x1.f1edc2p-5; // -0.060782316918251741

/// A cosine and the sine of the same angle.
struct gnomon_cosine_sine { cosine: f32, sine: f32 }

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
fn polynomial_cosine_sine(given_x: f32) -> gnomon_cosine_sine
{
    var x = given_x;
    x = clamp_or_nan(x, -8192.0, 8192.0);
    let n = nearest_integer(x * gnomon_trigonometry_two_over_pi);
    var y = gnomon_difference(x, n * 1.5703125);
    y = gnomon_difference(y, n * 0.0004837512969970703125) - n * gnomon_trigonometry_half_pi_low;
    let z = y * y;
    var s = gnomon_sin_float_0_ + z * (gnomon_sin_float_1_ + z * gnomon_sin_float_2_);
    var c = gnomon_cos_float_0_ + z * (gnomon_cos_float_1_ + z * gnomon_cos_float_2_);
    s = y + y * z * s;
    c = (1.0 - 0.5 * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    let m = n - 4.0 * nearest_integer(0.25 * n);
    let odd = gnomon_abs(m) == 1.0;
    let opposite = gnomon_abs(m) == 2.0;
    var r: gnomon_cosine_sine;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
fn polynomial_cos(x: f32) -> f32 { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
fn polynomial_sin(x: f32) -> f32 { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
fn polynomial_atan2_(y: f32, x: f32) -> f32
{
    let ax = gnomon_abs(x);
    let ay = gnomon_abs(y);
    let steep = ax < ay;
    let shorter = gnomon_select(steep, ax, ay);
    let longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    let wide = gnomon_trigonometry_tan_pi_8_ * longer < shorter;
    let denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == 0.0, 1.0, longer));
    let t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    let z = t * t;
    let p = gnomon_atan_float_0_ + z *
            (gnomon_atan_float_1_ + z * (gnomon_atan_float_2_ + z * (gnomon_atan_float_3_ + z * gnomon_atan_float_4_)));
    var angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    var eighths = gnomon_select(wide, 1.0, 0.0);
    angle = gnomon_select(steep, -1.0 * angle, angle);
    eighths = gnomon_select(steep, 2.0 - eighths, eighths);
    angle = gnomon_select(x < 0.0, -1.0 * angle, angle);
    eighths = gnomon_select(x < 0.0, 4.0 - eighths, eighths);
    angle = eighths * 0.785398006439208984375 + (angle + eighths * gnomon_trigonometry_quarter_pi_low);
    return gnomon_select(y < 0.0, -1.0 * angle, angle);
}

// comparators/hamburger_cholesky.h ------------------------------------------------------------------------------------
// Algorithm 1 of Peters et al. 2017 as the paper states it, for four and for six moments. This is the comparator that
// hamburger4.h and hamburger6.h are measured against, not a route to use. Both kernels need biased moments (bias.h:
// moments4_add_bias, moments6_add_bias) and keep the steps of the paper:
//
//   1, 2  Solve B q = (1, z_f, ..., z_f^(m/2)) by the square-root-free Cholesky decomposition B = L D L^T (Sec. 5.4.1).
//   3     Solve q_0 + q_1 z + ... = 0 for the other depths: a quadratic, or a cubic in closed form (Blinn 2007;
//         Sec. 5.4.1).
//   4, 5  The weights solve a Vandermonde system. The sum of those before z_f is E[u(z)], where the polynomial u is 1
//         at the depths before z_f and 0 at z_f and behind (Sec. 5.4.2).
//
// Only totality is added: singular moments, such as those of a single depth, give 0, lit, even in shadow.

const gnomon_hamburger_cholesky_third: f32 = 0x1.555556p-2; // 0.33333333333333333
const gnomon_hamburger_cholesky_sqrt3_: f32 = 0x1.bb67aep+0; // 1.7320508075688773
const hamburger_cholesky_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The two depths other than z_f, z1 <= z2.
struct gnomon_quadratic_nodes { z1_: f32, z2_: f32 }

/// The two depths of the distribution of three that has one at z_f and four biased moments.
fn gnomon_hamburger4_cholesky_nodes(b: moments4_, z_f: f32) -> gnomon_quadratic_nodes
{
    // Factor B = L D L^T.
    let inverse1 = 1.0 / (b.b2_ - b.b1_ * b.b1_);
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let l21 = c12 * inverse1;
    let d2 = (b.b4_ - b.b2_ * b.b2_) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    let y1 = z_f - b.b1_;
    let q2 = ((z_f * z_f - b.b2_) - l21 * y1) / d2;
    let q1 = y1 * inverse1 - l21 * q2;
    let q0 = 1.0 - (q1 * b.b1_ + q2 * b.b2_);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    let inverse_q2 = 1.0 / q2;
    let centre = -0.5 * (q1 * inverse_q2);
    let r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    var n: gnomon_quadratic_nodes;
    n.z1_ = centre - r;
    n.z2_ = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node -
/// last)), by Cramer's rule.
fn gnomon_hamburger4_cholesky_weight(b: moments4_, node: f32, other: f32, last: f32) -> f32
{
    return (b.b2_ - b.b1_ * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
fn hamburger4_cholesky_intensity(b: moments4_, z_f: f32) -> f32
{
    let n = gnomon_hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    let both = n.z2_ < z_f;
    let node = gnomon_select(both, z_f, n.z1_);
    let other = gnomon_select(both, n.z1_, z_f);
    let w = gnomon_hamburger4_cholesky_weight(b, node, other, n.z2_);
    return saturate_or_zero(gnomon_select(both, 1.0 - w, gnomon_select(n.z1_ < z_f, w, 0.0)));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3,
/// of z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
fn hamburger4_cholesky_blocker(b: moments4_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let n = gnomon_hamburger4_cholesky_nodes(b, z);
    let w1 = gnomon_select(n.z1_ < z, gnomon_hamburger4_cholesky_weight(b, n.z1_, z, n.z2_), 0.0);
    let w2 = gnomon_select(n.z2_ < z, gnomon_hamburger4_cholesky_weight(b, n.z2_, n.z1_, z), 0.0);
    let epsilon = hamburger_cholesky_epsilon;
    let depth = (epsilon * z + (w1 * n.z1_ + w2 * n.z2_)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(-1.0, depth)), z);
}

/// The three real roots of a cubic, in no particular order.
struct gnomon_cubic_roots { z1_: f32, z2_: f32, z3_: f32 }

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
fn gnomon_cubic_roots_blinn(c2: f32, c1: f32, c0: f32) -> gnomon_cubic_roots
{
    let b = c2 * gnomon_hamburger_cholesky_third;
    let c = c1 * gnomon_hamburger_cholesky_third;
    let hessian1 = c - b * b;
    let hessian2 = c0 - b * c;
    let hessian3 = b * c0 - c * c;
    let discriminant = 4.0 * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    let d = hessian2 - 2.0 * b * hessian1;
    let angle = polynomial_atan2_(gnomon_sqrt(discriminant), -1.0 * d);
    let t = polynomial_cosine_sine(angle * gnomon_hamburger_cholesky_third);
    let radius = gnomon_sqrt(-1.0 * hessian1);
    let half_cosine = radius * t.cosine;
    let half_sine = radius * t.sine * gnomon_hamburger_cholesky_sqrt3_;
    var roots: gnomon_cubic_roots;
    roots.z1_ = 2.0 * half_cosine - b;
    roots.z2_ = (half_sine - half_cosine) - b;
    roots.z3_ = -1.0 * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_cholesky_intensity(b: moments6_, z_f: f32) -> f32
{
    // Factor B = L D L^T.
    let inverse1 = 1.0 / (b.b2_ - b.b1_ * b.b1_);
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let c13 = b.b4_ - b.b1_ * b.b3_;
    let l21 = c12 * inverse1;
    let l31 = c13 * inverse1;
    let inverse2 = 1.0 / ((b.b4_ - b.b2_ * b.b2_) - l21 * c12);
    let c23 = (b.b5_ - b.b2_ * b.b3_) - l21 * c13;
    let l32 = c23 * inverse2;
    let d3 = ((b.b6_ - b.b3_ * b.b3_) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    let z_f2 = z_f * z_f;
    let y1 = z_f - b.b1_;
    let y2 = (z_f2 - b.b2_) - l21 * y1;
    let y3 = ((z_f2 * z_f - b.b3_) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    let q3 = y3 / d3;
    let q2 = y2 * inverse2 - l32 * q3;
    let q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    let q0 = 1.0 - (q1 * b.b1_ + q2 * b.b2_ + q3 * b.b3_);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    let inverse_q3 = 1.0 / q3;
    let z = gnomon_cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    let v1 = gnomon_select(z.z1_ < z_f, 1.0, 0.0);
    let v2 = gnomon_select(z.z2_ < z_f, 1.0, 0.0);
    let v3 = gnomon_select(z.z3_ < z_f, 1.0, 0.0);
    let v01 = v1 / (z.z1_ - z_f);
    let v12 = (v2 - v1) / (z.z2_ - z.z1_);
    let v23 = (v3 - v2) / (z.z3_ - z.z2_);
    let v012 = (v12 - v01) / (z.z2_ - z_f);
    let v123 = (v23 - v12) / (z.z3_ - z.z1_);
    let v0123 = (v123 - v012) / (z.z3_ - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    let s0 = v012 - v0123 * z.z2_;
    let t1 = s0 - v0123 * z.z1_;
    let t0 = v01 - s0 * z.z1_;
    let u2 = t1 - v0123 * z_f;
    let u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3_ + u2 * b.b2_) + u1 * b.b1_) - t0 * z_f);
}
