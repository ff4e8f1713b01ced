// Gnomon 0.1.0, two_point.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_TWO_POINT_HLSL
#define GNOMON_TWO_POINT_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: two_point.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: two_point.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: two_point.hlsl is not of the same version as a package before it"
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

// moments/two_point.h -------------------------------------------------------------------------------------------------
// A depth distribution of two depths from three moments (Peters et al. 2017, Alg. 2, Sec. 5.2 and App. B), which is the
// limit of Alg. 1 for a prescribed depth at infinity.
//
// Around the mean m = b1, with V = b2 - b1^2 and G = E[(z - m)^3] / V, the two depths are m + x1 and m + x2, where x1
// and x2 are the roots of x^2 - G x - V. The weights follow from w1 x1 + w2 x2 = 0. The roots have opposite signs, so
// that nothing cancels after V and G.
#ifndef GNOMON_MOMENTS_TWO_POINT_H
#define GNOMON_MOMENTS_TWO_POINT_H

/// Two depths, depth1 <= depth2, and their weights, which are in [0, 1] and sum to 1.
struct gnomon_distribution2 { float depth1, depth2, weight1, weight2; };

static const float two_point_least_variance = 1.1920928955078125e-7; // 2^-23

/// The distribution of two depths with the moments b1, b2 and b3; a single depth b1 if the variance is at most
/// least_variance. That should be the largest variance by rounding of a single depth: two_point_least_variance for
/// moments stored as floats.
/// Domain: moments of depths in [-1, 1]. For moments of no such distribution depths may lie outside, but in [-8193,
/// 8193]: depths more than 2^13 apart are replaced by the single depth b1, clamped to [-1, 1].
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 2
gnomon_distribution2 two_point_distribution(float b1, float b2, float b3, float least_variance)
{
    gnomon_double_word v = subtract_product_ordered(b2, b1, b1);
    gnomon_double_word c = subtract_product(b3, b1, b2);
    float mean = clamp_or_nan(b1, -1.0, 1.0);
    float variance = v.high + v.low;
    bool single = !(variance > gnomon_max(least_variance, gnomon_pivot_floor));
    float g = clamp_or_nan((c.high + c.low) / variance - 2.0 * mean, -4096.0, 4096.0);
    float root = 0.5 * (gnomon_abs(g) + gnomon_sqrt(g * g + 4.0 * variance));
    float far_side = gnomon_select(g < 0.0, -root, root);
    float near_side = -variance / far_side;
    float x1 = gnomon_min(far_side, near_side);
    float x2 = gnomon_max(far_side, near_side);
    float any_nan = variance + (c.high + c.low);
    bool known = any_nan == any_nan;
    bool two = known && (!single) && (x2 - x1 > 0.0) && (x2 - x1 < 8192.0);
    float centre = gnomon_select(known, mean, 1.0);
    gnomon_distribution2 d;
    d.depth1 = gnomon_select(two, mean + x1, centre);
    d.depth2 = gnomon_select(two, mean + x2, centre);
    d.weight2 = gnomon_select(two, saturate_or_zero(-x1 / (x2 - x1)), 0.0);
    d.weight1 = 1.0 - d.weight2;
    return d;
}

static const float two_point_unorm16_least_variance = 4.0e-5; // 5.26 times half a code
static const float two_point_noise_0 = 0.866;
static const float two_point_noise_2 = 3.4;

/// The moment b3 of two depths from three moments of theta4 (quantization.h), each of whose channels storage has
/// rounded by noise at
/// most: with the part of the third central moment that noise explains taken out, so that close depths keep their mean
/// and variance and get equal weights.
///
/// Rounding moves the third central moment k by e = noise (0.87 + 3.4 b1^2), a standard deviation of channels that are
/// uniformly off. A skew k / V^(3/2) of the order of 1 and noise make the best estimate V^3 / (V^3 + e^2) of k.
/// Domain: moments of depths in [-1, 1].
/// NaN: NaN.
float two_point_third_moment(float b1, float b2, float b3, float noise)
{
    float variance = gnomon_max(0.0, b2 - b1 * b1);
    float third = (b3 - b1 * b2) - 2.0 * b1 * variance;
    float e = noise * (two_point_noise_0 + two_point_noise_2 * (b1 * b1));
    float cubed = variance * (variance * variance);
    return b3 - third * (e * e / (cubed + e * e + gnomon_pivot_floor));
}

#endif

#endif
