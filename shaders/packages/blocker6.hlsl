// Gnomon 0.1.0, blocker6.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_BLOCKER6_HLSL
#define GNOMON_BLOCKER6_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: blocker6.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: blocker6.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: blocker6.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/cubic.h ----------------------------------------------------------------------------------------------------
// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.
#ifndef GNOMON_NUMERICS_CUBIC_H
#define GNOMON_NUMERICS_CUBIC_H

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
static const float gnomon_cubic_cosine0 = 0.50000938;
static const float gnomon_cubic_cosine1 = 0.57684887;
static const float gnomon_cubic_cosine2 = -0.10666892;
static const float gnomon_cubic_cosine3 = 0.03862587;
static const float gnomon_cubic_cosine4 = -0.00882245;
static const float gnomon_cubic_minus_third = -0.33333333333333331;

/// The result of a Halley step as a fraction, whose denominator is positive.
struct gnomon_cubic_step { float numerator, denominator; };

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
gnomon_cubic_step gnomon_cubic_halley_step(float b, float c, float d, float t)
{
    float tb = t + b;
    float f = tb * (t * t) + (c * t + d);
    float s = (tb + (tb + t)) * t + c;
    float r = (t + t) + tb;
    float whole = s * s - f * r; // positive except at a multiple root
    bool simple = whole > 0.0;
    gnomon_cubic_step x;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, 1.0);
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
float gnomon_cubic_halley(float b, float c, float d, float t)
{
    gnomon_cubic_step x = gnomon_cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
float gnomon_cubic_start(float b, float c, float d)
{
    float mean = gnomon_cubic_minus_third * b;
    float mean2 = mean * mean;
    float spread2 = gnomon_max(mean2 + gnomon_cubic_minus_third * c, 0.0);
    float spread = gnomon_sqrt(spread2);
    float g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    float inverse = 1.0 / spread2;
    float cosine = (g * inverse) * (spread * inverse);
    float q2 = gnomon_min(gnomon_max(0.5 + 0.25 * cosine, 0.0), 1.0);
    float q = gnomon_sqrt(q2);
    float start = (gnomon_cubic_cosine0 + q * gnomon_cubic_cosine1) + q2 *
                  ((gnomon_cubic_cosine2 + q * gnomon_cubic_cosine3) + q2 * gnomon_cubic_cosine4);
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
gnomon_cubic_step gnomon_cubic_positive_root(float b, float c, float d)
{
    float t = gnomon_cubic_start(b, c, d);
    return gnomon_cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
float cubic_largest_root(float b, float c, float d)
{
    gnomon_cubic_step x = gnomon_cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
}

#endif

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H

/// The two roots, in no particular order.
struct gnomon_quadratic_result { float first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
gnomon_quadratic_result quadratic_roots(float a, float b, float c)
{
    float r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0));
    float t = gnomon_select(b > 0.0, -(b + r), r - b);
    gnomon_quadratic_result x;
    x.first = t / a;
    x.second = c / t;
    return x;
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
struct hamburger_bounds { float lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
float bounds_intensity(hamburger_bounds bounds, float overestimation)
{
    return saturate_or_zero(bounds.lower + (1.0 - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
float over_darken(float intensity, float strength) { return saturate_or_zero(intensity / strength); }

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
float gnomon_dekker_product_error(float a, float b, float p)
{
    float ah = gnomon_high_part(a);
    float bh = gnomon_high_part(b);
    float al = gnomon_difference(a, ah);
    float bl = gnomon_difference(b, bh);
    float e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
gnomon_double_word two_difference(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    float bv = gnomon_difference(r.high, a);
    float av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
                                            gnomon_double_word d)
{
    gnomon_double_word p = two_product(a.high, b.high);
    gnomon_double_word q = two_product(c.high, d.high);
    gnomon_double_word r = two_difference(p.high, q.high);
    float cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
{
    gnomon_double_word p = two_product(a.high, c.high);
    gnomon_double_word q = two_product(b.high, b.high);
    float cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

#endif

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
gnomon_double_word gnomon_covariance_add_bias(gnomon_double_word c, float b_i, float b_j, float e_ij, float e_i,
                                              float e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

#endif

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
#ifndef GNOMON_MOMENTS_DEPTH_H
#define GNOMON_MOMENTS_DEPTH_H

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
float depth_from_unit(float z) { return z * 2.0 - 1.0; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
float depth_from_reversed(float z) { return 1.0 - z * 2.0; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
float gnomon_depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0 - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * (1.0 - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
{
    float x = gnomon_abs(clamp_or_nan(z, 0.0, 1.0)); // -0 is the far plane, too
    float depth = (near_distance * (1.0 - x) - (far_distance * x - near_distance)) /
                  (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0, 1.0);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0 - z, near_distance, far_distance);
}

#endif

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_4
#define GNOMON_MOMENTS_MOMENTS_4

struct moments4 { float b1, b2, b3, b4; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
moments4 moments4_from_depth(float z)
{
    moments4 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// b times weight: the first term of a linear combination.
moments4 moments4_scale(moments4 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
moments4 moments4_add(moments4 sum, moments4 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
moments4 moments4_from_unit(moments4 c)
{
    moments4 b;
    b.b1 = 2.0 * c.b1 - 1.0;
    b.b2 = 4.0 * (c.b2 - c.b1) + 1.0;
    b.b3 = (8.0 * c.b3 - 12.0 * c.b2) + (6.0 * c.b1 - 1.0);
    b.b4 = 16.0 * (c.b4 - 2.0 * c.b3) + (24.0 * c.b2 - 8.0 * c.b1 + 1.0);
    return b;
}

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

struct moments6 { float b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
moments6 moments6_from_depth(float z)
{
    moments6 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    b.b5 = b.b4 * z;
    b.b6 = b.b3 * b.b3;
    return b;
}

/// b times weight: the first term of a linear combination.
moments6 moments6_scale(moments6 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    b.b5 = b.b5 * weight;
    b.b6 = b.b6 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
moments6 moments6_add(moments6 sum, moments6 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    sum.b5 = sum.b5 + b.b5 * weight;
    sum.b6 = sum.b6 + b.b6 * weight;
    return sum;
}

#endif

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
#ifndef GNOMON_MOMENTS_HANKEL6_H
#define GNOMON_MOMENTS_HANKEL6_H

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
struct hankel6 { float mean, variance, shift2, shift3, ratio, whole, first, second; };

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
hankel6 gnomon_hankel6_make(float mean, float c11, float c12, float s22, float s23, float t)
{
    hankel6 h;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, c11);
    float inverse1 = 1.0 / h.variance;
    float s = gnomon_max(gnomon_pivot_floor * h.variance, s22);
    float inverse_s = 1.0 / s;
    float l21 = c12 * inverse1;
    h.shift2 = l21 - (mean + mean);
    h.shift3 = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(gnomon_pivot_floor, (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
struct gnomon_covariances6 { gnomon_double_word c11, c12, c13, c22, c23, c33; };

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
gnomon_covariances6 gnomon_covariances6_from_moments(moments6 b)
{
    gnomon_covariances6 c;
    c.c11 = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.c12 = subtract_product(b.b3, b.b1, b.b2);
    c.c13 = subtract_product_ordered(b.b4, b.b1, b.b3);
    c.c22 = subtract_product_ordered(b.b4, b.b2, b.b2);
    c.c23 = subtract_product(b.b5, b.b2, b.b3);
    c.c33 = subtract_product_ordered(b.b6, b.b3, b.b3);
    return c;
}

/// a b - c d as a double word, for factors whose low words may be as large as the high ones.
/// Domain: a b >= |c d| for the high words.
/// Error: in float 2^-45 of both products of the high words, and 2^-21 of the contributions of the low words.
gnomon_double_word gnomon_hankel6_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
                                        gnomon_double_word d)
{
    gnomon_double_word p = two_product(a.high, b.high);
    gnomon_double_word q = two_product(c.high, d.high);
    gnomon_double_word r = two_difference_ordered(p.high, q.high);
    float up = a.high * b.low + a.low * (b.high + b.low);
    float down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
hankel6 gnomon_hankel6_factor(float mean, gnomon_covariances6 c)
{
    gnomon_double_word s22 = gnomon_hankel6_minor(c.c11, c.c22, c.c12, c.c12);
    gnomon_double_word s23 = gnomon_double_word_minor(c.c11, c.c23, c.c12, c.c13);
    gnomon_double_word s33 = gnomon_hankel6_minor(c.c11, c.c33, c.c13, c.c13);
    return gnomon_hankel6_make(mean, c.c11.high + c.c11.low, c.c12.high + c.c12.low, s22.high + s22.low, s23.high +
                               s23.low, gnomon_double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
hankel6 hankel6_constant_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0 - alpha;
    float odds = alpha / keep;
    float d2 = b.b2 - bias2;
    float e1 = alpha * b.b1;
    float e2 = alpha * d2;
    float e3 = alpha * b.b3;
    gnomon_covariances6 c = gnomon_covariances6_from_moments(b);
    c.c11.low = c.c11.low + (e1 * b.b1 + odds * bias2);
    c.c12.low = c.c12.low + e1 * d2;
    c.c13.low = c.c13.low + (e1 * b.b3 + odds * bias4);
    c.c22.low = c.c22.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23.low = c.c23.low + e2 * b.b3;
    c.c33.low = c.c33.low + (e3 * b.b3 + odds * bias6);
    hankel6 h = gnomon_hankel6_factor(b.b1 - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
hankel6 hankel6_from_moments(moments6 b)
{
    float c11 = b.b2 - b.b1 * b.b1;
    float c12 = b.b3 - b.b1 * b.b2;
    float c13 = b.b4 - b.b1 * b.b3;
    float s22 = c11 * (b.b4 - b.b2 * b.b2) - c12 * c12;
    float s23 = c11 * (b.b5 - b.b2 * b.b3) - c12 * c13;
    float s33 = c11 * (b.b6 - b.b3 * b.b3) - c13 * c13;
    return gnomon_hankel6_make(b.b1, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

#endif

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
#ifndef GNOMON_MOMENTS_HAMBURGER6_H
#define GNOMON_MOMENTS_HAMBURGER6_H

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
struct gnomon_distribution4 { float depth0, depth1, depth2, depth3, weight0, weight1, weight2, weight3; };

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
struct gnomon_polynomials6 { float p1, p2, p3; };

/// P_1, P_2 and P_3 at the depth mean + u.
gnomon_polynomials6 gnomon_hamburger6_polynomials(hankel6 h, float u)
{
    gnomon_polynomials6 p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
float gnomon_hamburger6_kernel(hankel6 h, gnomon_polynomials6 p)
{
    return (h.whole + h.first * (p.p1 * p.p1)) + (h.second * (p.p2 * p.p2) + p.p3 * p.p3);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
struct gnomon_derivatives6 { float slope2, slope3, bend3; };

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
gnomon_derivatives6 gnomon_hamburger6_derivatives(hankel6 h, gnomon_polynomials6 p)
{
    float v = p.p1 - h.shift3;
    gnomon_derivatives6 d;
    d.slope2 = (p.p1 + p.p1) - h.shift2;
    d.slope3 = (p.p2 + v * d.slope2) - h.ratio;
    d.bend3 = d.slope2 + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
gnomon_polynomials6 gnomon_hamburger6_polynomials_shift(gnomon_polynomials6 p, gnomon_derivatives6 d, float distance_)
{
    p.p1 = p.p1 + distance_;
    p.p2 = p.p2 + distance_ * (d.slope2 + distance_);
    p.p3 = p.p3 + distance_ * (d.slope3 + distance_ * (d.bend3 + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
struct hamburger6_cubic { float b, c, d; };

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
hamburger6_cubic gnomon_hamburger6_other_nodes(hankel6 h, gnomon_polynomials6 p, gnomon_derivatives6 d, float inverse,
                                               float side)
{
    float q2 = h.second * p.p2;
    hamburger6_cubic r;
    r.b = inverse * (side * (h.first * p.p1 + (d.slope2 * q2 + d.slope3 * p.p3)));
    r.c = inverse * (q2 + d.bend3 * p.p3);
    r.d = inverse * (side * p.p3);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
float gnomon_hamburger6_distance(float t)
{
    float least = 0.0009765625;
    float away = gnomon_select(t < 0.0, gnomon_min(t, -least), gnomon_max(t, least));
    return 1.0 / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
struct hamburger6_sums { float lower, distance, weight; };

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
hamburger6_sums gnomon_hamburger6_sums_at(hankel6 h, float u)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, u);
    float inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    bool positive1 = p.p1 > 0.0;
    bool positive2 = p.p2 > 0.0;
    bool positive3 = p.p3 > 0.0;
    bool all_below = positive1 && positive2 && positive3;
    bool all_above = (!positive1) && positive2 && (!positive3);
    bool outside = all_below || all_above;
    hamburger6_sums r;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, 1.0 - r.weight, 0.0);
    r.distance = gnomon_select(all_below, p.p1, 0.0);
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        float side = gnomon_select(positive3, -1.0, 1.0);
        gnomon_derivatives6 d = gnomon_hamburger6_derivatives(h, p);
        hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, d, inverse, side);
        gnomon_cubic_step t = gnomon_cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        float away = t.denominator / gnomon_max(t.numerator, 0.0009765625 * t.denominator);
        float w = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (1.0 - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1 + w * away));
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
hamburger_bounds hamburger6_bounds(hankel6 h, float z_f)
{
    hamburger6_sums s = gnomon_hamburger6_sums_at(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    hamburger_bounds r;
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
float hamburger6_lower(hankel6 h, float z_f) { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
gnomon_distribution4 hamburger6_distribution(hankel6 h, float z_f)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    float inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    float side = gnomon_select(p.p3 > 0.0, -1.0, 1.0);
    hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, gnomon_hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    float t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    bool large = (t1 * t1) * t1 > -n.d;
    float backward = -n.d / t1;
    float forward = n.b + t1;
    float b = 0.5 * gnomon_select(large, (backward - n.c) / t1, forward);
    float c = gnomon_select(large, backward, n.c + t1 * forward);
    gnomon_quadratic_result q = quadratic_roots(1.0, b, c);
    float t2 = gnomon_cubic_halley(n.b, n.c, n.d, q.first);
    float t3 = gnomon_cubic_halley(n.b, n.c, n.d, q.second);
    float x1 = p.p1 + side * gnomon_hamburger6_distance(t1);
    float x2 = p.p1 + side * gnomon_hamburger6_distance(t2);
    float x3 = p.p1 + side * gnomon_hamburger6_distance(t3);
    float low = gnomon_min(x2, x3);
    float high = gnomon_max(x2, x3);
    float y1 = gnomon_min(x1, low);
    float y2 = gnomon_max(gnomon_min(x1, high), low);
    float y3 = gnomon_max(x1, high);
    float w0 = h.whole * inverse;
    float w1 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y1));
    float w2 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y2));
    float w3 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y3));
    float sum = (w0 + w1) + (w2 + w3);
    bool known = sum > 0.0; // false for NaN
    gnomon_distribution4 d;
    d.depth0 = gnomon_select(known, h.mean + p.p1, 1.0);
    d.depth1 = gnomon_select(known, h.mean + y1, 1.0);
    d.depth2 = gnomon_select(known, h.mean + y2, 1.0);
    d.depth3 = gnomon_select(known, h.mean + y3, 1.0);
    d.weight1 = gnomon_select(known, w1 / sum, 0.0);
    d.weight2 = gnomon_select(known, w2 / sum, 0.0);
    d.weight3 = gnomon_select(known, w3 / sum, 0.0);
    d.weight0 = saturate_or_zero(1.0 - (d.weight1 + (d.weight2 + d.weight3)));
    return d;
}

#endif

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
#ifndef GNOMON_MOMENTS_HANKEL4_4
#define GNOMON_MOMENTS_HANKEL4_4

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
struct hankel4 { float mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
hankel4 gnomon_hankel4_make(float mean, float variance, float covariance, float determinant)
{
    hankel4 h;
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
hankel4 hankel4_from_moments(moments4 b)
{
    float v = b.b2 - b.b1 * b.b1;
    float l = b.b3 - b.b1 * b.b2;
    float m = b.b4 - b.b2 * b.b2;
    return gnomon_hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
struct gnomon_covariances4 { gnomon_double_word v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
gnomon_covariances4 gnomon_covariances4_from_moments(moments4 b)
{
    gnomon_covariances4 c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
hankel4 gnomon_hankel4_with_change(moments4 b, moments4 e)
{
    gnomon_covariances4 c = gnomon_covariances4_from_moments(b);
    gnomon_double_word v = gnomon_covariance_add_bias(c.v, b.b1, b.b1, e.b2, e.b1, e.b1);
    gnomon_double_word l = gnomon_covariance_add_bias(c.l, b.b1, b.b2, e.b3, e.b1, e.b2);
    gnomon_double_word m = gnomon_covariance_add_bias(c.m, b.b2, b.b2, e.b4, e.b2, e.b2);
    return gnomon_hankel4_make(b.b1 + e.b1, v.high + v.low, l.high + l.low, gnomon_double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
hankel4 hankel4_constant_bias(moments4 b, float bias2, float bias4, float alpha)
{
    moments4 e;
    e.b1 = -1.0 * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = -1.0 * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    return gnomon_hankel4_with_change(b, e);
}

#endif

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
#ifndef GNOMON_MOMENTS_HAMBURGER4_H
#define GNOMON_MOMENTS_HAMBURGER4_H

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
struct gnomon_distribution3 { float depth0, depth1, depth2, weight0, weight1, weight2; };

#endif

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_HAMBURGER4_4
#define GNOMON_MOMENTS_HAMBURGER4_4

static const float gnomon_hamburger4_scale = 72057594037927936.0;     // 2^56
static const float hamburger4_lower_scale = 281474976710656.0; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
float gnomon_hamburger4_q(hankel4 h, float x) { return (h.variance * x - h.third) * x - h.variance * h.variance; }

/// The weight of the node at mean + x, where q = Q(x).
float gnomon_hamburger4_weight(hankel4 h, float x, float q)
{
    float w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
struct hamburger4_quadratic { float a, b, c; };

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
hamburger4_quadratic gnomon_hamburger4_other_nodes(hankel4 h, float u, float q)
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    float n = h.determinant * gnomon_hamburger4_scale;
    float s = q * gnomon_hamburger4_scale;
    hamburger4_quadratic r;
    r.a = s * h.variance;
    r.b = 0.5 * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
struct hamburger4_fractions { float share, total, receiver, whole; };

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
hamburger4_fractions gnomon_hamburger4_fractions_at(hankel4 h, float z_f)
{
    float u = clamp_or_nan(z_f, -1.0, 1.0) - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5 * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    hamburger4_fractions f;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    bool between = q < 0.0;
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
float hamburger4_lower(hankel4 h, float z_f)
{
    hamburger4_fractions f = gnomon_hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
hamburger_bounds hamburger4_bounds(hankel4 h, float z_f)
{
    hamburger4_fractions f = gnomon_hamburger4_fractions_at(h, z_f);
    hamburger_bounds r;
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
gnomon_distribution3 hamburger4_distribution(hankel4 h, float z_f)
{
    float z = clamp_or_nan(z_f, -1.0, 1.0);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    hamburger4_quadratic p = gnomon_hamburger4_other_nodes(h, u, q);
    gnomon_quadratic_result x = quadratic_roots(p.a, p.b, p.c);
    float x1 = clamp_or_nan(x.first, -1024.0, 1024.0);
    float x2 = clamp_or_nan(x.second, -1024.0, 1024.0);
    float w0 = gnomon_hamburger4_weight(h, u, q);
    float w1 = gnomon_hamburger4_weight(h, x1, gnomon_hamburger4_q(h, x1));
    float w2 = gnomon_hamburger4_weight(h, x2, gnomon_hamburger4_q(h, x2));
    float sum = w0 + (w1 + w2);
    bool swapped = x2 < x1;
    bool known = sum > 0.0; // false for NaN
    gnomon_distribution3 d;
    d.depth0 = gnomon_select(known, z, 1.0);
    d.depth1 = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), 1.0);
    d.depth2 = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), 1.0);
    d.weight1 = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, 0.0);
    d.weight2 = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, 0.0);
    d.weight0 = saturate_or_zero(1.0 - (d.weight1 + d.weight2));
    return d;
}

#endif

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
#ifndef GNOMON_SOFT_BLOCKER_H
#define GNOMON_SOFT_BLOCKER_H

static const float blocker_epsilon = 1e-3;

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
float gnomon_blocker_depth_before(float z_f, float distance_)
{
    return gnomon_max(z_f - gnomon_max(distance_, 0.0), -1.0);
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
float blocker2_depth(float mean, float variance, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    float u = z - mean;
    float whole = variance + u * u;
    float below = u * whole;
    float total = blocker_epsilon * whole + u * u;
    return gnomon_blocker_depth_before(z, below / total);
}

#endif

// soft/blocker.h ------------------------------------------------------------------------------------------------------
#ifndef GNOMON_SOFT_BLOCKER_4
#define GNOMON_SOFT_BLOCKER_4

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
float blocker4_depth(hankel4 h, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5 * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    float w = h.variance * n;
    float whole = w + e;
    bool between = q < 0.0;
    float rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    float share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    float total = blocker_epsilon * (whole * gnomon_select(between, r + r, 1.0)) + share;
    return gnomon_blocker_depth_before(z, rest / total);
}

#endif

// soft/blocker6.h -----------------------------------------------------------------------------------------------------
// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0
#ifndef GNOMON_SOFT_BLOCKER6_H
#define GNOMON_SOFT_BLOCKER6_H

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
float blocker6_depth(hankel6 h, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    hamburger6_sums s = gnomon_hamburger6_sums_at(h, z - h.mean);
    return gnomon_blocker_depth_before(z, s.distance / (blocker_epsilon + gnomon_max(s.lower, 0.0)));
}

#endif

#endif
