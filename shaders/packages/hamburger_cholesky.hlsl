// Gnomon 0.1.0, hamburger_cholesky.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_HAMBURGER_CHOLESKY_HLSL
#define GNOMON_HAMBURGER_CHOLESKY_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: hamburger_cholesky.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: hamburger_cholesky.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: hamburger_cholesky.hlsl is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_TRIGONOMETRY_H
#define GNOMON_NUMERICS_TRIGONOMETRY_H

static const float gnomon_trigonometry_two_over_pi = 0.63661977236758134;
static const float gnomon_trigonometry_half_pi_low = 7.5497899548918821e-8;
static const float gnomon_trigonometry_half_pi = 1.5707963267948966;
static const float gnomon_trigonometry_quarter_pi_low = 1.5695823932524066e-7;
static const float gnomon_trigonometry_tan_pi_8 = 0.41421356237309505;

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
static const float gnomon_sin_float_0 = -0.16666654609567105;
static const float gnomon_sin_float_1 = 0.0083321607625195058;
static const float gnomon_sin_float_2 = -0.00019515283258365583;

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
static const float gnomon_cos_float_0 = 0.041666645683017541;
static const float gnomon_cos_float_1 = -0.0013887316256332952;
static const float gnomon_cos_float_2 = 2.4433157272163749e-05;

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
static const float gnomon_atan_float_0 = -0.33333315189495832;
static const float gnomon_atan_float_1 = 0.19998471559801789;
static const float gnomon_atan_float_2 = -0.14243534037509495;
static const float gnomon_atan_float_3 = 0.10593818186484773;
static const float gnomon_atan_float_4 = -0.060782316918251741;

/// A cosine and the sine of the same angle.
struct gnomon_cosine_sine { float cosine, sine; };

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
gnomon_cosine_sine polynomial_cosine_sine(float x)
{
    x = clamp_or_nan(x, -8192.0, 8192.0);
    float n = nearest_integer(x * gnomon_trigonometry_two_over_pi);
    float y = gnomon_difference(x, n * 1.5703125);
    y = gnomon_difference(y, n * 0.0004837512969970703125) - n * gnomon_trigonometry_half_pi_low;
    float z = y * y;
    float s = gnomon_sin_float_0 + z * (gnomon_sin_float_1 + z * gnomon_sin_float_2);
    float c = gnomon_cos_float_0 + z * (gnomon_cos_float_1 + z * gnomon_cos_float_2);
    s = y + y * z * s;
    c = (1.0 - 0.5 * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    float m = n - 4.0 * nearest_integer(0.25 * n);
    bool odd = gnomon_abs(m) == 1.0;
    bool opposite = gnomon_abs(m) == 2.0;
    gnomon_cosine_sine r;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
float polynomial_cos(float x) { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
float polynomial_sin(float x) { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
float polynomial_atan2(float y, float x)
{
    float ax = gnomon_abs(x);
    float ay = gnomon_abs(y);
    bool steep = ax < ay;
    float shorter = gnomon_select(steep, ax, ay);
    float longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    bool wide = gnomon_trigonometry_tan_pi_8 * longer < shorter;
    float denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == 0.0, 1.0, longer));
    float t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    float z = t * t;
    float p = gnomon_atan_float_0 + z *
              (gnomon_atan_float_1 + z * (gnomon_atan_float_2 + z * (gnomon_atan_float_3 + z * gnomon_atan_float_4)));
    float angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    float eighths = gnomon_select(wide, 1.0, 0.0);
    angle = gnomon_select(steep, -1.0 * angle, angle);
    eighths = gnomon_select(steep, 2.0 - eighths, eighths);
    angle = gnomon_select(x < 0.0, -1.0 * angle, angle);
    eighths = gnomon_select(x < 0.0, 4.0 - eighths, eighths);
    angle = eighths * 0.785398006439208984375 + (angle + eighths * gnomon_trigonometry_quarter_pi_low);
    return gnomon_select(y < 0.0, -1.0 * angle, angle);
}

#endif

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
#ifndef GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H
#define GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H

static const float gnomon_hamburger_cholesky_third = 0.33333333333333333;
static const float gnomon_hamburger_cholesky_sqrt3 = 1.7320508075688773;
static const float hamburger_cholesky_epsilon = 1e-3;

/// The two depths other than z_f, z1 <= z2.
struct gnomon_quadratic_nodes { float z1, z2; };

/// The two depths of the distribution of three that has one at z_f and four biased moments.
gnomon_quadratic_nodes gnomon_hamburger4_cholesky_nodes(moments4 b, float z_f)
{
    // Factor B = L D L^T.
    float inverse1 = 1.0 / (b.b2 - b.b1 * b.b1);
    float c12 = b.b3 - b.b1 * b.b2;
    float l21 = c12 * inverse1;
    float d2 = (b.b4 - b.b2 * b.b2) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    float y1 = z_f - b.b1;
    float q2 = ((z_f * z_f - b.b2) - l21 * y1) / d2;
    float q1 = y1 * inverse1 - l21 * q2;
    float q0 = 1.0 - (q1 * b.b1 + q2 * b.b2);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    float inverse_q2 = 1.0 / q2;
    float centre = -0.5 * (q1 * inverse_q2);
    float r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    gnomon_quadratic_nodes n;
    n.z1 = centre - r;
    n.z2 = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node -
/// last)), by Cramer's rule.
float gnomon_hamburger4_cholesky_weight(moments4 b, float node, float other, float last)
{
    return (b.b2 - b.b1 * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
float hamburger4_cholesky_intensity(moments4 b, float z_f)
{
    gnomon_quadratic_nodes n = gnomon_hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    bool both = n.z2 < z_f;
    float node = gnomon_select(both, z_f, n.z1);
    float other = gnomon_select(both, n.z1, z_f);
    float w = gnomon_hamburger4_cholesky_weight(b, node, other, n.z2);
    return saturate_or_zero(gnomon_select(both, 1.0 - w, gnomon_select(n.z1 < z_f, w, 0.0)));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3,
/// of z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
float hamburger4_cholesky_blocker(moments4 b, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    gnomon_quadratic_nodes n = gnomon_hamburger4_cholesky_nodes(b, z);
    float w1 = gnomon_select(n.z1 < z, gnomon_hamburger4_cholesky_weight(b, n.z1, z, n.z2), 0.0);
    float w2 = gnomon_select(n.z2 < z, gnomon_hamburger4_cholesky_weight(b, n.z2, n.z1, z), 0.0);
    float epsilon = hamburger_cholesky_epsilon;
    float depth = (epsilon * z + (w1 * n.z1 + w2 * n.z2)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(-1.0, depth)), z);
}

/// The three real roots of a cubic, in no particular order.
struct gnomon_cubic_roots { float z1, z2, z3; };

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
gnomon_cubic_roots gnomon_cubic_roots_blinn(float c2, float c1, float c0)
{
    float b = c2 * gnomon_hamburger_cholesky_third;
    float c = c1 * gnomon_hamburger_cholesky_third;
    float hessian1 = c - b * b;
    float hessian2 = c0 - b * c;
    float hessian3 = b * c0 - c * c;
    float discriminant = 4.0 * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    float d = hessian2 - 2.0 * b * hessian1;
    float angle = polynomial_atan2(gnomon_sqrt(discriminant), -1.0 * d);
    gnomon_cosine_sine t = polynomial_cosine_sine(angle * gnomon_hamburger_cholesky_third);
    float radius = gnomon_sqrt(-1.0 * hessian1);
    float half_cosine = radius * t.cosine;
    float half_sine = radius * t.sine * gnomon_hamburger_cholesky_sqrt3;
    gnomon_cubic_roots roots;
    roots.z1 = 2.0 * half_cosine - b;
    roots.z2 = (half_sine - half_cosine) - b;
    roots.z3 = -1.0 * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
float hamburger6_cholesky_intensity(moments6 b, float z_f)
{
    // Factor B = L D L^T.
    float inverse1 = 1.0 / (b.b2 - b.b1 * b.b1);
    float c12 = b.b3 - b.b1 * b.b2;
    float c13 = b.b4 - b.b1 * b.b3;
    float l21 = c12 * inverse1;
    float l31 = c13 * inverse1;
    float inverse2 = 1.0 / ((b.b4 - b.b2 * b.b2) - l21 * c12);
    float c23 = (b.b5 - b.b2 * b.b3) - l21 * c13;
    float l32 = c23 * inverse2;
    float d3 = ((b.b6 - b.b3 * b.b3) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    float z_f2 = z_f * z_f;
    float y1 = z_f - b.b1;
    float y2 = (z_f2 - b.b2) - l21 * y1;
    float y3 = ((z_f2 * z_f - b.b3) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    float q3 = y3 / d3;
    float q2 = y2 * inverse2 - l32 * q3;
    float q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    float q0 = 1.0 - (q1 * b.b1 + q2 * b.b2 + q3 * b.b3);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    float inverse_q3 = 1.0 / q3;
    gnomon_cubic_roots z = gnomon_cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    float v1 = gnomon_select(z.z1 < z_f, 1.0, 0.0);
    float v2 = gnomon_select(z.z2 < z_f, 1.0, 0.0);
    float v3 = gnomon_select(z.z3 < z_f, 1.0, 0.0);
    float v01 = v1 / (z.z1 - z_f);
    float v12 = (v2 - v1) / (z.z2 - z.z1);
    float v23 = (v3 - v2) / (z.z3 - z.z2);
    float v012 = (v12 - v01) / (z.z2 - z_f);
    float v123 = (v23 - v12) / (z.z3 - z.z1);
    float v0123 = (v123 - v012) / (z.z3 - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    float s0 = v012 - v0123 * z.z2;
    float t1 = s0 - v0123 * z.z1;
    float t0 = v01 - s0 * z.z1;
    float u2 = t1 - v0123 * z_f;
    float u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3 + u2 * b.b2) + u1 * b.b1) - t0 * z_f);
}

#endif

#endif
