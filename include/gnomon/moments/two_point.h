// A depth distribution of two depths from three moments (Peters et al. 2017, Alg. 2, Sec. 5.2 and App. B), which is the
// limit of Alg. 1 for a prescribed depth at infinity.
//
// Around the mean m = b1, with V = b2 - b1^2 and G = E[(z - m)^3] / V, the two depths are m + x1 and m + x2, where x1
// and x2 are the roots of x^2 - G x - V. The weights follow from w1 x1 + w2 x2 = 0. The roots have opposite signs, so
// that nothing cancels after V and G.
#ifndef GNOMON_MOMENTS_TWO_POINT_H
#define GNOMON_MOMENTS_TWO_POINT_H
#include "../numerics/select.h"
#include "covariance.h"
GNOMON_NAMESPACE_BEGIN

/// Two depths, depth1 <= depth2, and their weights, which are in [0, 1] and sum to 1.
GNOMON_STRUCT(distribution2) { Real depth1, depth2, weight1, weight2; };

GNOMON_CONSTANT(two_point_least_variance, 1.1920928955078125e-7); // 2^-23

/// The distribution of two depths with the moments b1, b2 and b3; a single depth b1 if the variance is at most
/// least_variance. That should be the largest variance by rounding of a single depth: two_point_least_variance for
/// moments stored as floats.
/// Domain: moments of depths in [-1, 1]. For moments of no such distribution depths may lie outside, but in [-8193,
/// 8193]: depths more than 2^13 apart are replaced by the single depth b1, clamped to [-1, 1].
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 2
GNOMON_KERNEL GNOMON_T(distribution2) two_point_distribution(Real b1, Real b2, Real b3, GNOMON_SETTING least_variance)
{
    double_word v = subtract_product_ordered(b2, b1, b1);
    double_word c = subtract_product(b3, b1, b2);
    Real mean = clamp_or_nan(b1, Real(-1), Real(1));
    Real variance = v.high + v.low;
    GNOMON_MASK single = !(variance > gnomon_max(least_variance, GNOMON_PIVOT_FLOOR));
    Real g = clamp_or_nan((c.high + c.low) / variance - Real(2) * mean, Real(-4096), Real(4096));
    Real root = Real(0.5) * (gnomon_abs(g) + gnomon_sqrt(g * g + Real(4) * variance));
    Real far_side = gnomon_select(g < Real(0), -root, root);
    Real near_side = -variance / far_side;
    Real x1 = gnomon_min(far_side, near_side);
    Real x2 = gnomon_max(far_side, near_side);
    Real any_nan = variance + (c.high + c.low);
    GNOMON_MASK known = any_nan == any_nan;
    GNOMON_MASK two = known && (!single) && (x2 - x1 > Real(0)) && (x2 - x1 < Real(8192));
    Real centre = gnomon_select(known, mean, Real(1));
    GNOMON_T(distribution2) d;
    d.depth1 = gnomon_select(two, mean + x1, centre);
    d.depth2 = gnomon_select(two, mean + x2, centre);
    d.weight2 = gnomon_select(two, saturate_or_zero(-x1 / (x2 - x1)), Real(0));
    d.weight1 = Real(1) - d.weight2;
    return d;
}

GNOMON_CONSTANT(two_point_unorm16_least_variance, 4.0e-5); // 5.26 times half a code
GNOMON_CONSTANT(two_point_noise_0, 0.866);
GNOMON_CONSTANT(two_point_noise_2, 3.4);

/// The moment b3 of two depths from three moments of theta4 (quantization.h), each of whose channels storage has rounded by noise at
/// most: with the part of the third central moment that noise explains taken out, so that close depths keep their mean and
/// variance and get equal weights.
///
/// Rounding moves the third central moment k by e = noise (0.87 + 3.4 b1^2), a standard deviation of channels that are uniformly
/// off. A skew k / V^(3/2) of the order of 1 and noise make the best estimate V^3 / (V^3 + e^2) of k.
/// Domain: moments of depths in [-1, 1].
/// NaN: NaN.
GNOMON_KERNEL Real two_point_third_moment(Real b1, Real b2, Real b3, GNOMON_SETTING noise)
{
    Real variance = gnomon_max(Real(0), b2 - b1 * b1);
    Real third = (b3 - b1 * b2) - Real(2) * b1 * variance;
    Real e = noise * (GNOMON_LITERAL(two_point_noise_0) + GNOMON_LITERAL(two_point_noise_2) * (b1 * b1));
    Real cubed = variance * (variance * variance);
    return b3 - third * (e * e / (cubed + e * e + GNOMON_PIVOT_FLOOR));
}

GNOMON_NAMESPACE_END
#endif
