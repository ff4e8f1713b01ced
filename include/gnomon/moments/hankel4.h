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
#ifndef GNOMON_MOMENTS_HANKEL4_H
#define GNOMON_MOMENTS_HANKEL4_H
#include "../numerics/two_product.h"
#include "covariance.h"
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
GNOMON_STRUCT(hankel4) { Real mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
GNOMON_DETAIL_KERNEL GNOMON_T(hankel4) hankel4_make(Real mean, Real variance, Real covariance, Real determinant)
{
    GNOMON_T(hankel4) h;
    h.mean = mean;
    h.variance = gnomon_max(GNOMON_PIVOT_FLOOR, variance);
    h.third = covariance - (mean + mean) * h.variance;
    h.determinant = gnomon_max(GNOMON_PIVOT_FLOOR * h.variance, determinant);
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 16-bit storage, whose
/// own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_moments(GNOMON_T(moments4) b)
{
    Real v = b.b2 - b.b1 * b.b1;
    Real l = b.b3 - b.b1 * b.b2;
    Real m = b.b4 - b.b2 * b.b2;
    return hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
GNOMON_STRUCT(covariances4) { GNOMON_T(double_word) v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
GNOMON_DETAIL_KERNEL GNOMON_T(covariances4) covariances4_from_moments(GNOMON_T(moments4) b)
{
    GNOMON_T(covariances4) c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel4) hankel4_with_change(GNOMON_T(moments4) b, GNOMON_T(moments4) e)
{
    covariances4 c = covariances4_from_moments(b);
    double_word v = covariance_add_bias(c.v, b.b1, b.b1, e.b2, e.b1, e.b1);
    double_word l = covariance_add_bias(c.l, b.b1, b.b2, e.b3, e.b1, e.b2);
    double_word m = covariance_add_bias(c.m, b.b2, b.b2, e.b4, e.b2, e.b2);
    return hankel4_make(b.b1 + e.b1, v.high + v.low, l.high + l.low, double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_constant_bias(GNOMON_T(moments4) b, GNOMON_SETTING bias2, GNOMON_SETTING bias4,
                                                      GNOMON_SETTING alpha)
{
    GNOMON_T(moments4) e;
    e.b1 = Real(-1) * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = Real(-1) * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    return hankel4_with_change(b, e);
}

GNOMON_NAMESPACE_END
#endif
