// Gnomon 0.1.0, absorbance.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_ABSORBANCE_CL
#define GNOMON_ABSORBANCE_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: absorbance.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: absorbance.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: absorbance.cl is not of the same version as a package before it"
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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

__constant float gnomon_exp_log2_e = 1.4426950408889634f;
__constant float gnomon_exp_ln2_low = -2.1219444005469058e-4f;
__constant float gnomon_exp_sqrt_2 = 1.4142135623730951f;
__constant float gnomon_exp_sqrt_half = 0.70710678118654752f;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
__constant float gnomon_exp_float_0 = 0.49999993561656014f;
__constant float gnomon_exp_float_1 = 0.16666518908321371f;
__constant float gnomon_exp_float_2 = 0.041668318723256166f;
__constant float gnomon_exp_float_3 = 0.0083689258101569408f;
__constant float gnomon_exp_float_4 = 0.00138210541669496f;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
__constant float gnomon_log_float_0 = 0.66666776085218282f;
__constant float gnomon_log_float_1 = 0.39977574040563962f;
__constant float gnomon_log_float_2 = 0.29870936689734456f;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
static inline float gnomon_exp_remainder(float r)
{
    float p = gnomon_exp_float_0 + r *
              (gnomon_exp_float_1 + r * (gnomon_exp_float_2 + r * (gnomon_exp_float_3 + r * gnomon_exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
static inline float polynomial_exp(float x)
{
    float low = -87.0f;
    float high = 88.0f;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375f) - n * gnomon_exp_ln2_low;
    return (1.0f + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
typedef struct gnomon_scaled_number gnomon_scaled_number;
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
static inline gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    gnomon_scaled_number r;
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
static inline float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0f;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0f), gnomon_power_of_two(127.0f));
    s = gnomon_scaled_number_step(s, 64.0f);
    s = gnomon_scaled_number_step(s, 32.0f);
    s = gnomon_scaled_number_step(s, 16.0f);
    s = gnomon_scaled_number_step(s, 8.0f);
    s = gnomon_scaled_number_step(s, 4.0f);
    s = gnomon_scaled_number_step(s, 2.0f);
    s = gnomon_scaled_number_step(s, 1.0f);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5f, gnomon_select(tiny, s.significand * 2.0f, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0f, gnomon_select(tiny, s.exponent - 1.0f, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0f;
    float y = f / (2.0f + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5f * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375f - ((square - rest) - f);
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
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
static inline float bias_weight_of_roundings(float w, float n)
{
    float nw = gnomon_max(1.0f, n) * w;
    return nw / ((1.0f - w) + nw);
}

#endif

// moments/bias.h, four moments ----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_4
#define GNOMON_MOMENTS_BIAS_4

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
__constant float bias4_raw_b2 = 0.41397147664677789f;
__constant float bias4_raw_b4 = 0.41397147664677789f;
__constant float bias4_raw_paper_b2 = 0.375f;
__constant float bias4_raw_paper_b4 = 0.375f;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
__constant float bias4_theta_b2 = 0.66391434671237689f;
__constant float bias4_theta_b4 = 0.66391434671237689f;
__constant float bias4_theta_paper_b2 = 0.628f;
__constant float bias4_theta_paper_b4 = 0.628f;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
static inline moments4 moments4_add_bias(moments4 b, float bias2, float bias4, float alpha)
{
    float keep = 1.0f - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    return b;
}

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
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_H
#define GNOMON_MOMENTS_TRANSLUCENCY_H

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below.
/// An alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
static inline float over(float below, float above, float alpha)
{
    float a = saturate_or_zero(alpha);
    float mixed = (1.0f - a) * below + a * above;
    return gnomon_select(0.0f < a, gnomon_select(a < 1.0f, mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
typedef struct gnomon_front_to_back gnomon_front_to_back;
struct gnomon_front_to_back { float weight, transmittance; };

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
static inline gnomon_front_to_back front_to_back_begin(float alpha)
{
    gnomon_front_to_back state;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = 1.0f - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
static inline gnomon_front_to_back front_to_back_add(gnomon_front_to_back state, float alpha)
{
    float a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (1.0f - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
__constant float gnomon_alpha_test_one_percent = 0.01f;

__constant float gnomon_blend_least_alpha = 5.9604644775390625e-8f; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
static inline float blend_roundings(float least_alpha)
{
    return 1.0f / gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
static inline float blend_roundings_of_layers(float least_alpha, float layers)
{
    float a = gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
    float further = gnomon_max(1.0f, layers) - 1.0f;
    float few = (further + 1.0f) / (1.0f + 0.5f * (further * a));
    return gnomon_min(few, 1.0f / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
static inline float gnomon_blended_roundings(float further, float each)
{
    return 1.0f + each * gnomon_max(0.0f, further);
}

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
__constant float gnomon_blended_half_roundings = 2.0f;
__constant float gnomon_blended_float_roundings = 3.5f;

#endif

// moments/translucency.h, four moments --------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_4
#define GNOMON_MOMENTS_TRANSLUCENCY_4

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
static inline moments4 moments4_over(moments4 below, float z, float alpha)
{
    moments4 b = moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    return b;
}

#endif

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
#ifndef GNOMON_MOMENTS_ABSORBANCE_H
#define GNOMON_MOMENTS_ABSORBANCE_H

/// Sums of absorbance times powers of depth, b0 to b4.
typedef struct absorbance4 absorbance4;
struct absorbance4 { float b0, b1, b2, b3, b4; };

__constant float absorbance_most = 16.0f;

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
static inline float absorbance_of_opacity(float alpha)
{
    float absorbed = -1.0f * polynomial_log(1.0f - saturate_or_zero(alpha));
    return gnomon_min(absorbed, absorbance_most);
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
static inline absorbance4 absorbance4_of_fragment(float z, float alpha)
{
    float a = absorbance_of_opacity(alpha);
    moments4 m = moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f));
    absorbance4 b;
    b.b0 = a;
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of fragments together.
static inline absorbance4 absorbance4_add(absorbance4 sum, absorbance4 b)
{
    sum.b0 = sum.b0 + b.b0;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

__constant float absorbance_least = 7.62939453125e-6f; // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are
/// meant in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
static inline hankel4 absorbance4_factor(absorbance4 b, float alpha)
{
    float scale = 1.0f / gnomon_max(absorbance_least, b.b0);
    moments4 m;
    m.b1 = b.b1 * scale;
    m.b2 = b.b2 * scale;
    m.b3 = b.b3 * scale;
    m.b4 = b.b4 * scale;
    return hankel4_constant_bias(m, bias4_raw_b2, bias4_raw_b4, alpha);
}

__constant float absorbance_scale = 5.421010862427522170037e-20f; // 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
static inline float absorbance_transmittance(float b0, float intensity)
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    float absorbed = saturate_or_zero(b0 * absorbance_scale) * 18446744073709551616.0f;
    float t = polynomial_exp(-1.0f * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, 1.0f);
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
static inline float gnomon_absorbance4_intensity(hankel4 h, float alpha, float overestimation, float z_f)
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (1.0f - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1],
/// clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
static inline float absorbance4_transmittance(absorbance4 b, float alpha, float overestimation, float z_f)
{
    return absorbance_transmittance(b.b0,
                                    gnomon_absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation,
                                                                 z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the
/// given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
static inline float transmitted_intensity(float opaque, float transmittance)
{
    float absorbed = saturate_or_zero(1.0f - transmittance);
    float o = saturate_or_zero(opaque);
    return o + (1.0f - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of
/// the three as absorbance.
typedef struct gnomon_coloured_absorbance4 gnomon_coloured_absorbance4;
struct gnomon_coloured_absorbance4 { float red, green, blue, b1, b2, b3, b4; };

/// Transmittances, each in [0, 1].
typedef struct gnomon_coloured_transmittance gnomon_coloured_transmittance;
struct gnomon_coloured_transmittance { float red, green, blue; };

__constant float absorbance_third = 0.33333333333333331f;

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
static inline gnomon_coloured_absorbance4 coloured_absorbance4_of_fragment(float z, float red, float green, float blue)
{
    gnomon_coloured_absorbance4 b;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    float a = absorbance_third * (b.red + (b.green + b.blue));
    moments4 m = moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f));
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
static inline gnomon_coloured_absorbance4 coloured_absorbance4_add(gnomon_coloured_absorbance4 sum,
                                                                   gnomon_coloured_absorbance4 b)
{
    sum.red = sum.red + b.red;
    sum.green = sum.green + b.green;
    sum.blue = sum.blue + b.blue;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

/// The transmittances at depth z_f, from one distribution of depth for all channels: right in front of all fragments,
/// behind all, and wherever their hues are alike. The arguments are those of absorbance4_transmittance.
/// Domain: as of absorbance4_transmittance.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
static inline gnomon_coloured_transmittance coloured_absorbance4_transmittance(gnomon_coloured_absorbance4 b,
                                                                               float alpha, float overestimation,
                                                                               float z_f)
{
    absorbance4 shared_depths;
    shared_depths.b0 = absorbance_third * (b.red + (b.green + b.blue));
    shared_depths.b1 = b.b1;
    shared_depths.b2 = b.b2;
    shared_depths.b3 = b.b3;
    shared_depths.b4 = b.b4;
    float intensity = gnomon_absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation,
                                                   z_f);
    gnomon_coloured_transmittance t;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
}

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

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_4
#define GNOMON_MOMENTS_QUANTIZATION_4

/// The moments that a format without transform holds as they are.
static inline moments4 moments4_from_channels(channels4 c)
{
    moments4 b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    return b;
}

/// The moments b as the channels of a format without transform.
static inline channels4 channels4_from_moments(moments4 b)
{
    channels4 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    return c;
}

__constant float gnomon_theta4_31 = 0.8660254037844386f;   // sqrt(3) / 2
__constant float gnomon_theta4_33 = -0.38490017945975052f; // -2 sqrt(3) / 9
__constant float gnomon_theta4_inverse11 = -0.33333333333333331f;
__constant float gnomon_theta4_inverse13 = 1.7320508075688772f;
__constant float gnomon_theta4_inverse33 = 1.299038105676658f;

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
static inline channels4 theta4(moments4 b)
{
    channels4 c;
    c.c1 = 1.5f * b.b1 - 2.0f * b.b3 + 0.5f;
    c.c2 = 4.0f * (b.b2 - b.b4);
    c.c3 = gnomon_theta4_31 * b.b1 + gnomon_theta4_33 * b.b3 + 0.5f;
    c.c4 = 0.5f * (b.b2 + b.b4);
    return c;
}

/// The four moments of channels c: the inverse of theta4.
/// Source: Peters 2017, Eq. 3
static inline moments4 theta4_inverse(channels4 c)
{
    float c1 = c.c1 - 0.5f;
    float c3 = c.c3 - 0.5f;
    moments4 b;
    b.b1 = gnomon_theta4_inverse11 * c1 + gnomon_theta4_inverse13 * c3;
    b.b2 = 0.125f * c.c2 + c.c4;
    b.b3 = gnomon_theta4_inverse33 * c3 - 0.75f * c1;
    b.b4 = c.c4 - 0.125f * c.c2;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
static inline moments4 theta4_inverse_add_bias(channels4 c, float bias, float alpha)
{
    float keep = 1.0f - alpha;
    float c1 = c.c1 - 0.5f;
    float c3 = c.c3 - 0.5f;
    float c2 = (0.125f * keep) * c.c2;
    float c4 = keep * c.c4 + alpha * bias;
    moments4 b;
    b.b1 = (keep * gnomon_theta4_inverse11) * c1 + (keep * gnomon_theta4_inverse13) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * gnomon_theta4_inverse33) * c3 - (0.75f * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

#endif

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
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
typedef struct gnomon_certificate4 gnomon_certificate4;
struct gnomon_certificate4 { float top, s0, s1, s2, s3, s4; };

__constant float gnomon_certificate4_nothing = -1267650600228229401496703205376.0f; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
static inline gnomon_certificate4 gnomon_certificate4_about(float z_f, float n0, float t0, float t1, float n1, float n2)
{
    float nz = n2 * z_f;
    float ns = (n1 + n1) - nz;
    float k0 = n0 - ns * z_f;
    float k1 = ns - nz;
    float m = t0 - t1 * z_f;
    float m0 = m * m;
    float m1 = m * (t1 + t1);
    float m2 = t1 * t1;
    gnomon_certificate4 p;
    p.top = n0;
    p.s0 = m0 * k0;
    p.s1 = m0 * k1 + m1 * k0;
    p.s2 = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3 = m1 * n2 + m2 * k1;
    p.s4 = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
static inline gnomon_certificate4 gnomon_certificate4_make(hankel4 h, float z_f)
{
    float u = z_f - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    float un = u * h.determinant;
    float w = h.variance * h.determinant + (u * un + q * q);
    float w2 = w + w;
    float a = q * h.variance;
    float b = un + q * (vu + slope);
    float square = b * b - (a + a) * w2;
    float inverse = 1.0f / w2;
    float ratio = b / (square + square);
    float r = gnomon_sqrt(gnomon_max(0.0f, square));
    float c = (b + r) * inverse;
    float g = (b - r) * inverse;
    float d = ratio * r - 0.5f;
    float k = c * d;
    bool between = q < 0.0f;
    float n0 = gnomon_select(between, 0.0f, 1.0f);
    float n1 = gnomon_select(between, c - k, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    float t0 = gnomon_select(between, 1.0f + d, 1.0f);
    float t1 = gnomon_select(between, k, c);
    gnomon_certificate4 p = gnomon_certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (0.0f < b), n0, gnomon_certificate4_nothing);
    return p;
}

/// The coefficients of p at the channels of theta4, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
static inline channels4 gnomon_certificate4_theta(gnomon_certificate4 p)
{
    float third = 0.75f * p.s3;
    channels4 r;
    r.c1 = gnomon_theta4_inverse11 * p.s1 - third;
    r.c2 = 0.125f * (p.s2 - p.s4);
    r.c3 = gnomon_theta4_inverse13 * (p.s1 + third);
    r.c4 = p.s2 + p.s4;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
static inline float gnomon_certificate4_theta_doubt(channels4 t, float noise)
{
    return noise * ((gnomon_abs(t.c1) + gnomon_abs(t.c2)) + (gnomon_abs(t.c3) + gnomon_abs(t.c4)));
}

/// The least possible value of E[p], given channels c of theta4 that are each off by at most noise.
static inline float gnomon_certificate4_theta_mean(gnomon_certificate4 p, channels4 c, float noise)
{
    channels4 t = gnomon_certificate4_theta(p);
    float mean = (p.s0 + (t.c2 * c.c2 + t.c4 * c.c4)) + (t.c1 * (c.c1 - 0.5f) + t.c3 * (c.c3 - 0.5f));
    return p.top - (mean + gnomon_certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4 that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
static inline float certified4_theta_lower(hankel4 h, channels4 c, float noise, float z_f)
{
    gnomon_certificate4 p = gnomon_certificate4_make(h, clamp_or_nan(z_f, -1.0f, 1.0f));
    return saturate_or_zero(gnomon_certificate4_theta_mean(p, c, noise));
}

__constant float gnomon_certified4_scale = 137438953472.0f; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
typedef struct certified4_mean certified4_mean;
struct certified4_mean
{
    gnomon_certificate4 p;
    float mean, added, known;
};

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
static inline certified4_mean gnomon_certified4_constant_bias_mean(hankel4 h, float bias2, float bias4, float alpha,
                                                                   float z)
{
    float u = z - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    float s = gnomon_certified4_scale * q;
    float n = gnomon_certified4_scale * h.determinant;
    float un = u * n;
    float e = u * un + q * s;
    float w = h.variance * n + e;
    float w2 = w + w;
    float a = s * h.variance;
    float a2 = a + a;
    float b = un + s * (vu + slope);
    float r = gnomon_sqrt(gnomon_max(0.0f, b * b - a2 * w2));
    bool between = q < 0.0f;
    bool positive = 0.0f < b;
    // Each quotient in the form that does not cancel.
    float outer = r + gnomon_abs(b);
    float c = gnomon_select(positive, outer, -2.0f * a) / gnomon_select(positive, w2, outer);
    float inverse = 1.0f / gnomon_select(between, r + r, outer);
    float g = a2 * inverse; // k if one node is on either side
    float n0 = gnomon_select(between, 0.0f, 1.0f);
    float n1 = gnomon_select(between, c - g, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    float t0 = gnomon_select(between, 0.5f + b * inverse, 1.0f);
    float t1 = gnomon_select(between, g, c);
    certified4_mean m;
    m.p = gnomon_certificate4_about(z, n0, t0, t1, n1, n2);
    float share = gnomon_select(between, 0.5f * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, 1.0f));
    m.added = alpha * ((m.p.top - m.p.s0) - (bias2 * m.p.s2 + bias4 * m.p.s4));
    m.known = gnomon_select((between || positive) && (gnomon_pivot_floor * h.variance < h.determinant), 1.0f, 0.0f);
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
static inline float gnomon_certified4_constant_bias_intensity(certified4_mean m, float doubt)
{
    return gnomon_select(0.0f < m.known, saturate_or_zero(m.mean - (m.added + doubt)), 0.0f);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
static inline float certified4_constant_bias_lower(hankel4 h, moments4 noise, float bias2, float bias4, float alpha,
                                                   float z_f)
{
    certified4_mean m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0f, 1.0f));
    float doubt = (noise.b1 * gnomon_abs(m.p.s1) + noise.b2 * gnomon_abs(m.p.s2)) +
                  (noise.b3 * gnomon_abs(m.p.s3) + noise.b4 * gnomon_abs(m.p.s4));
    return gnomon_certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4 with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
static inline float certified4_theta_constant_bias_lower(hankel4 h, float noise, float bias2, float bias4, float alpha,
                                                         float z_f)
{
    certified4_mean m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0f, 1.0f));
    return gnomon_certified4_constant_bias_intensity(m,
                                                     gnomon_certificate4_theta_doubt(gnomon_certificate4_theta(m.p),
                                                                                     noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
static inline moments4 moments4_rounding(moments4 b, float delta)
{
    moments4 e;
    e.b1 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1));
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
static inline moments4 moments4_rounding_filtered(moments4 b, float delta)
{
    moments4 e;
    e.b1 = delta;
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

#endif

// storage/moments4.h --------------------------------------------------------------------------------------------------
// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16
//   4 x half          8     theta4 - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
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
#ifndef GNOMON_STORAGE_MOMENTS4_H
#define GNOMON_STORAGE_MOMENTS4_H

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
static inline channels4 moments4_unorm16_encode(float z)
{
    return theta4(moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f)));
}

/// The channels c, each with shift added.
static inline channels4 gnomon_channels4_shifted(channels4 c, float shift)
{
    c.c1 = c.c1 + shift;
    c.c2 = c.c2 + shift;
    c.c3 = c.c3 + shift;
    c.c4 = c.c4 + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
static inline float gnomon_half_nearest(float x) { return 0.000244140625f * nearest_integer(4096.0f * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices
/// may truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
static inline channels4 moments4_half_encode(float z)
{
    channels4 c = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5f);
    c.c1 = gnomon_half_nearest(c.c1);
    c.c2 = gnomon_half_nearest(c.c2);
    c.c3 = gnomon_half_nearest(c.c3);
    c.c4 = gnomon_half_nearest(c.c4);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
static inline channels4 moments4_float_encode(float z)
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, -1.0f, 1.0f)));
}

__constant float gnomon_stored4_unorm16_weight = 3.6e-5f;
__constant float gnomon_stored4_unorm16_filtered_weight = 1.1e-4f;
__constant float gnomon_stored4_half_weight = 5.7e-4f;
__constant float gnomon_stored4_half_filtered_weight = 2.85e-3f;
__constant float gnomon_stored4_float_weight = 3e-7f;
__constant float gnomon_stored4_float_filtered_weight = 2e-6f;
__constant float gnomon_stored4_arithmetic_weight = 1e-6f;

/// The factored matrix of the channels of theta4, with a constant bias of weight alpha.
static inline hankel4 gnomon_hankel4_from_theta(channels4 c, float alpha)
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, bias4_theta_b2, alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
static inline hankel4 gnomon_hankel4_stored_as_float(channels4 c, float alpha)
{
    return hankel4_constant_bias(moments4_from_channels(c), bias4_raw_b2, bias4_raw_b4, alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
static inline hankel4 hankel4_from_unorm16(channels4 c)
{
    return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_weight);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
static inline hankel4 hankel4_from_unorm16_filtered(channels4 c)
{
    return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
static inline hankel4 hankel4_from_half(channels4 c)
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5f), gnomon_stored4_half_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
static inline hankel4 hankel4_from_half_filtered(channels4 c)
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5f), gnomon_stored4_half_filtered_weight);
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
static inline hankel4 hankel4_from_float(channels4 c)
{
    return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_weight);
}

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
static inline hankel4 hankel4_from_float_filtered(channels4 c)
{
    return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_filtered_weight);
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
__constant float certified4_unorm16_noise = 8e-6f; // half a code, and the error of theta4 in float
__constant float certified4_unorm16_filtered_noise = 2.4e-5f;
__constant float certified4_unorm16_weight = 3.6e-5f;
__constant float certified4_unorm16_filtered_weight = 9e-5f;
__constant float certified4_half_noise = 1.225e-4f;         // 2^-13, and the error of theta4 in float
__constant float certified4_half_filtered_noise = 6.12e-4f; // passes may truncate: 2^-12 each
__constant float certified4_half_weight = 6e-4f;
__constant float certified4_half_filtered_weight = 2.3e-3f;
__constant float certified4_float_noise = 3.3e-8f;                        // 1.1 times 2^-25
__constant float certified4_float_filtered_noise = 2.384185791015625e-7f; // 8 times: sums of nine taps round, too
__constant float certified4_float_weight = 3e-7f;
__constant float certified4_float_filtered_weight = 1.5e-6f;

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise, by nodes with a bias of weight alpha.
static inline float gnomon_moments4_theta_intensity(channels4 c, float noise, float alpha, float z_f)
{
    return certified4_theta_lower(gnomon_hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_unorm16_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_noise, certified4_unorm16_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_unorm16_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                           z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_half_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5f), certified4_half_noise,
                                           certified4_half_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_half_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5f), certified4_half_filtered_noise,
                                           certified4_half_filtered_weight, z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes
/// with a bias of weight alpha.
static inline float gnomon_moments4_float_intensity_with_noise(channels4 c, moments4 noise, float alpha, float z_f)
{
    return certified4_constant_bias_lower(gnomon_hankel4_stored_as_float(c, alpha), noise, bias4_raw_b2, bias4_raw_b4,
                                          alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_float_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), certified4_float_noise),
        certified4_float_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments4_float_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), certified4_float_filtered_noise),
        certified4_float_filtered_weight, z_f);
}

#endif

// storage/absorbance4.h -----------------------------------------------------------------------------------------------
// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in
// any order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4 - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add
// up to additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A
// fragment's own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by
// 2^-24 of its value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.
#ifndef GNOMON_STORAGE_ABSORBANCE4_H
#define GNOMON_STORAGE_ABSORBANCE4_H

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
static inline channels5 absorbance4_float_encode(float z, float alpha)
{
    absorbance4 b = absorbance4_of_fragment(z, alpha);
    channels5 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b0;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
static inline channels5 absorbance4_half_encode(float z, float alpha)
{
    float a = absorbance_of_opacity(alpha);
    channels4 s = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5f);
    channels5 c;
    c.c1 = a * s.c1;
    c.c2 = a * s.c2;
    c.c3 = a * s.c3;
    c.c4 = a * s.c4;
    c.c5 = a;
    return c;
}

__constant float absorbance4_half_additions = 8.0f;
__constant float absorbance4_half_least = 1.220703125e-4f; // 2^-13: below, half floats are denormal
__constant float absorbance4_float_additions = 4.0f;
__constant float absorbance4_float_more = 3.0f; // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
static inline float absorbance4_float_transmittance(channels5 c, float additions, float overestimation, float z_f)
{
    absorbance4 b;
    b.b0 = c.c5;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    float n = gnomon_blended_roundings(additions + absorbance4_float_more, absorbance4_float_additions);
    return absorbance4_transmittance(b, bias_weight_of_roundings(gnomon_stored4_float_weight, n), overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
static inline float absorbance4_half_transmittance(channels5 c, float additions, float overestimation, float z_f)
{
    float scale = 1.0f / gnomon_max(absorbance4_half_least, c.c5);
    channels4 s;
    s.c1 = c.c1 * scale;
    s.c2 = c.c2 * scale;
    s.c3 = c.c3 * scale;
    s.c4 = c.c4 * scale;
    float weight = bias_weight_of_roundings(gnomon_stored4_half_weight,
                                            gnomon_blended_roundings(additions, absorbance4_half_additions));
    hankel4 h = gnomon_hankel4_from_theta(gnomon_channels4_shifted(s, 0.5f), weight);
    return absorbance_transmittance(c.c5, gnomon_absorbance4_intensity(h, weight, overestimation, z_f));
}

#endif

#endif
