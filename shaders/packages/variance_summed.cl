// Gnomon 0.1.0, variance_summed.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_VARIANCE_SUMMED_CL
#define GNOMON_VARIANCE_SUMMED_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: variance_summed.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: variance_summed.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: variance_summed.cl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline float gnomon_abs(float a) { return fabs(a); }
static inline float gnomon_sqrt(float a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline float gnomon_kept(float x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline float gnomon_apart(float x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
static inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
static inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
static inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
static inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
static inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
static inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline float gnomon_saturate(float x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline float gnomon_high_part(float a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline float gnomon_power_of_two(float n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

typedef struct channels1 channels1;
struct channels1 { float c1; };

typedef struct channels2 channels2;
struct channels2 { float c1, c2; };

typedef struct channels5 channels5;
struct channels5 { float c1, c2, c3, c4, c5; };

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

typedef struct channels4 channels4;
struct channels4 { float c1, c2, c3, c4; };

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

typedef struct channels6 channels6;
struct channels6 { float c1, c2, c3, c4, c5, c6; };

#endif

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H

/// The two roots, in no particular order.
typedef struct gnomon_quadratic_result gnomon_quadratic_result;
struct gnomon_quadratic_result { float first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
static inline gnomon_quadratic_result quadratic_roots(float a, float b, float c)
{
    float r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0f));
    float t = gnomon_select(b > 0.0f, -(b + r), r - b);
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
static inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
static inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
static inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
typedef struct hamburger_bounds hamburger_bounds;
struct hamburger_bounds { float lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
static inline float bounds_intensity(hamburger_bounds bounds, float overestimation)
{
    return saturate_or_zero(bounds.lower + (1.0f - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
static inline float over_darken(float intensity, float strength) { return saturate_or_zero(intensity / strength); }

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
typedef struct gnomon_double_word gnomon_double_word;
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
static inline float gnomon_dekker_product_error(float a, float b, float p)
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
static inline gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_fma(a, b, -0.0f); // kept, as gnomon_product is: two fused products read it
    r.low = gnomon_fma(a, b, -r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
static inline gnomon_double_word two_difference(float a, float b)
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
static inline gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
static inline float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
static inline gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b,
                                                          gnomon_double_word c, gnomon_double_word d)
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
static inline float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
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
static inline gnomon_double_word gnomon_covariance_add_bias(gnomon_double_word c, float b_i, float b_j, float e_ij,
                                                            float e_i, float e_j)
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
static inline float depth_from_unit(float z) { return z * 2.0f - 1.0f; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
static inline float depth_from_reversed(float z) { return 1.0f - z * 2.0f; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
static inline float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
static inline float gnomon_depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
static inline float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0f - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
static inline float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return gnomon_depth_between(near_distance * (1.0f - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
static inline float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
{
    float x = gnomon_abs(clamp_or_nan(z, 0.0f, 1.0f)); // -0 is the far plane, too
    float depth = (near_distance * (1.0f - x) - (far_distance * x - near_distance)) /
                  (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0f, 1.0f);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
static inline float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0f - z, near_distance, far_distance);
}

#endif

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_4
#define GNOMON_MOMENTS_MOMENTS_4

typedef struct moments4 moments4;
struct moments4 { float b1, b2, b3, b4; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
static inline moments4 moments4_from_depth(float z)
{
    moments4 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// b times weight: the first term of a linear combination.
static inline moments4 moments4_scale(moments4 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
static inline moments4 moments4_add(moments4 sum, moments4 b, float weight)
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
static inline moments4 moments4_from_unit(moments4 c)
{
    moments4 b;
    b.b1 = 2.0f * c.b1 - 1.0f;
    b.b2 = 4.0f * (c.b2 - c.b1) + 1.0f;
    b.b3 = (8.0f * c.b3 - 12.0f * c.b2) + (6.0f * c.b1 - 1.0f);
    b.b4 = 16.0f * (c.b4 - 2.0f * c.b3) + (24.0f * c.b2 - 8.0f * c.b1 + 1.0f);
    return b;
}

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

typedef struct moments6 moments6;
struct moments6 { float b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
static inline moments6 moments6_from_depth(float z)
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
static inline moments6 moments6_scale(moments6 b, float weight)
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
static inline moments6 moments6_add(moments6 sum, moments6 b, float weight)
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
typedef struct hankel4 hankel4;
struct hankel4 { float mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
static inline hankel4 gnomon_hankel4_make(float mean, float variance, float covariance, float determinant)
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
static inline hankel4 hankel4_from_moments(moments4 b)
{
    float v = b.b2 - b.b1 * b.b1;
    float l = b.b3 - b.b1 * b.b2;
    float m = b.b4 - b.b2 * b.b2;
    return gnomon_hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
typedef struct gnomon_covariances4 gnomon_covariances4;
struct gnomon_covariances4 { gnomon_double_word v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
static inline gnomon_covariances4 gnomon_covariances4_from_moments(moments4 b)
{
    gnomon_covariances4 c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
static inline hankel4 gnomon_hankel4_with_change(moments4 b, moments4 e)
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
static inline hankel4 hankel4_constant_bias(moments4 b, float bias2, float bias4, float alpha)
{
    moments4 e;
    e.b1 = -1.0f * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = -1.0f * alpha * b.b3;
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
typedef struct gnomon_distribution3 gnomon_distribution3;
struct gnomon_distribution3 { float depth0, depth1, depth2, weight0, weight1, weight2; };

#endif

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_HAMBURGER4_4
#define GNOMON_MOMENTS_HAMBURGER4_4

__constant float gnomon_hamburger4_scale = 72057594037927936.0f;     // 2^56
__constant float hamburger4_lower_scale = 281474976710656.0f; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
static inline float gnomon_hamburger4_q(hankel4 h, float x)
{
    return (h.variance * x - h.third) * x - h.variance * h.variance;
}

/// The weight of the node at mean + x, where q = Q(x).
static inline float gnomon_hamburger4_weight(hankel4 h, float x, float q)
{
    float w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
typedef struct hamburger4_quadratic hamburger4_quadratic;
struct hamburger4_quadratic { float a, b, c; };

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
static inline hamburger4_quadratic gnomon_hamburger4_other_nodes(hankel4 h, float u, float q)
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    float n = h.determinant * gnomon_hamburger4_scale;
    float s = q * gnomon_hamburger4_scale;
    hamburger4_quadratic r;
    r.a = s * h.variance;
    r.b = 0.5f * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
typedef struct hamburger4_fractions hamburger4_fractions;
struct hamburger4_fractions { float share, total, receiver, whole; };

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
static inline hamburger4_fractions gnomon_hamburger4_fractions_at(hankel4 h, float z_f)
{
    float u = clamp_or_nan(z_f, -1.0f, 1.0f) - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5f * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    hamburger4_fractions f;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    bool between = q < 0.0f;
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
static inline float hamburger4_lower(hankel4 h, float z_f)
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
static inline hamburger_bounds hamburger4_bounds(hankel4 h, float z_f)
{
    hamburger4_fractions f = gnomon_hamburger4_fractions_at(h, z_f);
    hamburger_bounds r;
    r.lower = saturate_or_zero(f.share / f.total);
    r.weight = gnomon_min(saturate_or_zero(f.receiver / f.whole), 1.0f - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// The canonical distribution with a node at z_f. The other two depths are finite, at most 1024 from the mean, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1
static inline gnomon_distribution3 hamburger4_distribution(hankel4 h, float z_f)
{
    float z = clamp_or_nan(z_f, -1.0f, 1.0f);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    hamburger4_quadratic p = gnomon_hamburger4_other_nodes(h, u, q);
    gnomon_quadratic_result x = quadratic_roots(p.a, p.b, p.c);
    float x1 = clamp_or_nan(x.first, -1024.0f, 1024.0f);
    float x2 = clamp_or_nan(x.second, -1024.0f, 1024.0f);
    float w0 = gnomon_hamburger4_weight(h, u, q);
    float w1 = gnomon_hamburger4_weight(h, x1, gnomon_hamburger4_q(h, x1));
    float w2 = gnomon_hamburger4_weight(h, x2, gnomon_hamburger4_q(h, x2));
    float sum = w0 + (w1 + w2);
    bool swapped = x2 < x1;
    bool known = sum > 0.0f; // false for NaN
    gnomon_distribution3 d;
    d.depth0 = gnomon_select(known, z, 1.0f);
    d.depth1 = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), 1.0f);
    d.depth2 = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), 1.0f);
    d.weight1 = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, 0.0f);
    d.weight2 = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, 0.0f);
    d.weight0 = saturate_or_zero(1.0f - (d.weight1 + d.weight2));
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

__constant float blocker_epsilon = 1e-3f;

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
static inline float gnomon_blocker_depth_before(float z_f, float distance_)
{
    return gnomon_max(z_f - gnomon_max(distance_, 0.0f), -1.0f);
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
static inline float blocker2_depth(float mean, float variance, float z_f)
{
    float z = clamp_or_high(z_f, -1.0f, 1.0f);
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
static inline float blocker4_depth(hankel4 h, float z_f)
{
    float z = clamp_or_high(z_f, -1.0f, 1.0f);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5f * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    float w = h.variance * n;
    float whole = w + e;
    bool between = q < 0.0f;
    float rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    float share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    float total = blocker_epsilon * (whole * gnomon_select(between, r + r, 1.0f)) + share;
    return gnomon_blocker_depth_before(z, rest / total);
}

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
static inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
static inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

__constant float gnomon_texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
static inline float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
static inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
    return saturate_or_zero(share / look_ups);
}

#endif

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
#ifndef GNOMON_SOFT_SUMMED_AREA_H
#define GNOMON_SOFT_SUMMED_AREA_H

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
typedef struct summed_area_rectangle summed_area_rectangle;
struct summed_area_rectangle { float x0, y0, x1, y1; };

__constant float summed_area_range = 4294967296.0f;         // 2^32
__constant float summed_area_most_texels = 1048576.0f;      // 2^20
__constant float summed_area_step = 5.9604644775390625e-8f; // 2^-24
__constant float summed_area_slack = 0.0009765625f;         // 2^-10

__constant float summed_area_code_noise = 1.1641532182693481e-10f; // 2^-33
__constant float summed_area_float_noise = 5.9604644775390625e-8f; // 2 times 2^-25
__constant float summed_area_least_noise = 1.3411045074462891e-7f; // 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
static inline float summed_area_noise(float most_texels)
{
    float noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
static inline float summed_area_scale(float most_texels)
{
    float n = clamp_or_high(most_texels, 1.0f, summed_area_most_texels);
    float range = summed_area_range;
    float s = range / n;
    float whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0f, 0.0f);
    gnomon_double_word sum = two_product(whole, n);
    bool wraps = 0.0f <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0f, summed_area_step * whole), 0.0f);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
static inline float summed_area_code(float channel, float scale)
{
    gnomon_double_word p = two_product(saturate_or_zero(channel), scale);
    float code = nearest_natural(p.high);
    float rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5f < rest, 1.0f, 0.0f);
    return code - gnomon_select(rest < -0.5f, 1.0f, 0.0f);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
static inline summed_area_rectangle summed_area_around(float x, float y, float width_x, float width_y)
{
    summed_area_rectangle r;
    r.x0 = x - 0.5f * width_x;
    r.y0 = y - 0.5f * width_y;
    r.x1 = x + 0.5f * width_x;
    r.y1 = y + 0.5f * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
static inline float gnomon_summed_area_above(float x) { return -1.0f * texel_below(-1.0f * x); }

/// The begin and the end of a rectangle along one axis.
typedef struct summed_area_interval summed_area_interval;
struct summed_area_interval { float begin, end; };

/// The interval from begin to end.
static inline summed_area_interval gnomon_summed_area_interval_from(float begin, float end)
{
    summed_area_interval r;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
static inline summed_area_interval gnomon_summed_area_shrink(float begin, float end, float texels, float most)
{
    float width = most - 1.0f;
    float low = 0.5f * (begin + end) - 0.5f * width;
    bool large = most < texels;
    summed_area_interval r;
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
static inline summed_area_rectangle summed_area_clip(summed_area_rectangle rectangle, float width, float height,
                                                     float most_texels)
{
    float limit = gnomon_texel_limit;
    float right = clamp_or_high(width, 1.0f, limit);
    float bottom = clamp_or_high(height, 1.0f, limit);
    float x0 = clamp_or_nan(rectangle.x0, 0.0f, right);
    float y0 = clamp_or_nan(rectangle.y0, 0.0f, bottom);
    float x1 = clamp_or_nan(rectangle.x1, 0.0f, right);
    float y1 = clamp_or_nan(rectangle.y1, 0.0f, bottom);
    float columns = gnomon_summed_area_above(x1) - texel_below(x0);
    float rows = gnomon_summed_area_above(y1) - texel_below(y0);
    float most = clamp_or_high(most_texels, 4.0f, summed_area_most_texels);
    bool large = most < columns * rows;
    summed_area_interval x = gnomon_summed_area_interval_from(x0, x1);
    summed_area_interval y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        float share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0f));
        float least_columns = gnomon_min(columns, 2.0f);
        float least_rows = gnomon_min(rows, 2.0f);
        float most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                        texel_below(most / least_rows));
        float most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    bool some = x0 < x1 && y0 < y1; // false for NaN
    summed_area_rectangle r;
    r.x0 = gnomon_select(some, x.begin, 0.0f);
    r.y0 = gnomon_select(some, y.begin, 0.0f);
    r.x1 = gnomon_select(some, x.end, 0.0f);
    r.y1 = gnomon_select(some, y.end, 0.0f);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
static inline summed_area_rectangle summed_area_grow(summed_area_rectangle rectangle)
{
    summed_area_rectangle r;
    r.x0 = texel_below(rectangle.x0);
    r.y0 = texel_below(rectangle.y0);
    r.x1 = gnomon_summed_area_above(rectangle.x1);
    r.y1 = gnomon_summed_area_above(rectangle.y1);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
typedef struct summed_area_parts summed_area_parts;
struct summed_area_parts { float line0, line1, line2, line3, width0, width1, width2; };

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
static inline summed_area_parts summed_area_split(float begin, float end)
{
    float first = texel_below(begin);
    float last = gnomon_max(gnomon_summed_area_above(end) - 1.0f, first);
    bool single = last <= first;
    summed_area_parts r;
    r.line0 = first;
    r.line1 = first + 1.0f;
    r.line2 = gnomon_max(last, r.line1);
    r.line3 = last + 1.0f;
    r.width0 = saturate_or_zero(gnomon_select(single, end, r.line1) - begin);
    r.width1 = gnomon_select(single, 0.0f, 1.0f);
    r.width2 = gnomon_select(single, 0.0f, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
static inline float summed_area_width(summed_area_parts parts)
{
    return (parts.width0 + parts.width1 * (parts.line2 - parts.line1)) + parts.width2;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
static inline float summed_area_mean(float sum, float area, float scale)
{
    gnomon_double_word whole = two_product(area, scale);
    float mean = saturate_or_zero(sum / whole.high);
    gnomon_double_word p = two_product(mean, whole.high);
    float rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

#endif

// storage/variance_summed.h -------------------------------------------------------------------------------------------
// The mean and the mean square of depths in a summed-area table (soft/summed_area.h; Lauritzen 2007), in 8 bytes a
// texel: what variance soft shadow mapping reads (Yang et al. 2010).
//
//   a texel:        c = variance_summed_encode(z)               (1 + z) / 2 and z^2; a resolve averages them
//                   codes = variance_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = variance_summed_channels(sums, area, scale)
//                   z_b = variance_summed_blocker(c, most_texels, z_f)
//                   shadow = variance_summed_intensity(c, most_texels, z_f - bias)
//
// With channels that are off by noise, the mean is off by 2 noise and the variance by (1 + 4 |mean|) noise at most.
// Cantelli's bound from the largest variance and the least distance never darkens.
#ifndef GNOMON_STORAGE_VARIANCE_SUMMED_H
#define GNOMON_STORAGE_VARIANCE_SUMMED_H

__constant float variance_summed_darkening = 1e-6f;

/// The two channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
static inline channels2 variance_summed_encode(float z)
{
    float x = clamp_or_high(z, -1.0f, 1.0f);
    channels2 c;
    c.c1 = 0.5f * x + 0.5f;
    c.c2 = x * x;
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
static inline channels2 variance_summed_codes(channels2 c, float scale)
{
    float any = clamp_or_nan(c.c1, 0.0f, 1.0f) + clamp_or_nan(c.c2, 0.0f, 1.0f);
    bool known = any == any;
    channels2 r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, 1.0f), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, 1.0f), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
static inline channels2 variance_summed_channels(channels2 sums, float area, float scale)
{
    bool some = 0.0f < area;
    channels2 r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), 1.0f);
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), 1.0f);
    return r;
}

/// The mean and the largest variance that channels may have which are off by noise.
typedef struct variance_summed_moments variance_summed_moments;
struct variance_summed_moments { float mean, variance; };

static inline variance_summed_moments gnomon_variance_summed_decode(channels2 c, float noise)
{
    variance_summed_moments r;
    r.mean = (c.c1 - 0.5f) * 2.0f;
    float doubt = (1.0f + 4.0f * gnomon_abs(r.mean)) * noise;
    r.variance = gnomon_max(subtract_product_rounded(c.c2, r.mean, r.mean), 0.0f) + doubt;
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
/// Source: Donnelly & Lauritzen 2006
static inline float variance_summed_intensity(channels2 c, float most_texels, float z_f)
{
    float noise = summed_area_noise(most_texels);
    variance_summed_moments b = gnomon_variance_summed_decode(c, noise);
    float distance_ = (clamp_or_nan(z_f, -1.0f, 1.0f) - b.mean) - 2.0f * noise;
    float d = gnomon_max(0.0f, distance_);
    // 1, or 0 for NaN, without a comparison, which Metal's fast mathematics would lose.
    float known = saturate_or_zero(c.c2 + 1.0f);
    return known * saturate_or_zero(d * d / (b.variance + d * d));
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
/// Error: against the kernel in double, for a table of 784 texels,
///     error, float, variance_summed_blocker: p99 1e-6, p99.9 2e-4, max 2e-3
/// Source: Yang 2010
static inline float variance_summed_blocker(channels2 c, float most_texels, float z_f)
{
    variance_summed_moments b = gnomon_variance_summed_decode(c, summed_area_noise(most_texels));
    float depth = blocker2_depth(b.mean, b.variance, z_f);
    return gnomon_select(c.c2 == c.c2, depth, clamp_or_high(z_f, -1.0f, 1.0f));
}

#endif

#endif
