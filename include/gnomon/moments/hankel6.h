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
#include "../numerics/two_product.h"
#include "covariance.h"
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
GNOMON_STRUCT(hankel6) { Real mean, variance, shift2, shift3, ratio, whole, first, second; };

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
GNOMON_DETAIL_KERNEL GNOMON_T(hankel6) hankel6_make(Real mean, Real c11, Real c12, Real s22, Real s23, Real t)
{
    GNOMON_T(hankel6) h;
    h.mean = mean;
    h.variance = gnomon_max(GNOMON_PIVOT_FLOOR, c11);
    Real inverse1 = Real(1) / h.variance;
    Real s = gnomon_max(GNOMON_PIVOT_FLOOR * h.variance, s22);
    Real inverse_s = Real(1) / s;
    Real l21 = c12 * inverse1;
    h.shift2 = l21 - (mean + mean);
    h.shift3 = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(GNOMON_PIVOT_FLOOR, (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
GNOMON_STRUCT(covariances6) { GNOMON_T(double_word) c11, c12, c13, c22, c23, c33; };

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
GNOMON_DETAIL_KERNEL GNOMON_T(covariances6) covariances6_from_moments(GNOMON_T(moments6) b)
{
    GNOMON_T(covariances6) c;
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
GNOMON_DETAIL_KERNEL GNOMON_T(double_word) hankel6_minor(GNOMON_T(double_word) a, GNOMON_T(double_word) b,
                                                         GNOMON_T(double_word) c, GNOMON_T(double_word) d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference_ordered(p.high, q.high);
    Real up = a.high * b.low + a.low * (b.high + b.low);
    Real down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel6) hankel6_factor(Real mean, GNOMON_T(covariances6) c)
{
    double_word s22 = hankel6_minor(c.c11, c.c22, c.c12, c.c12);
    double_word s23 = double_word_minor(c.c11, c.c23, c.c12, c.c13);
    double_word s33 = hankel6_minor(c.c11, c.c33, c.c13, c.c13);
    return hankel6_make(mean, c.c11.high + c.c11.low, c.c12.high + c.c12.low, s22.high + s22.low, s23.high + s23.low,
                        double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_constant_bias(GNOMON_T(moments6) b, GNOMON_SETTING bias2, GNOMON_SETTING bias4,
                                                      GNOMON_SETTING bias6, GNOMON_SETTING alpha)
{
    Real keep = Real(1) - alpha;
    Real odds = alpha / keep;
    Real d2 = b.b2 - bias2;
    Real e1 = alpha * b.b1;
    Real e2 = alpha * d2;
    Real e3 = alpha * b.b3;
    covariances6 c = covariances6_from_moments(b);
    c.c11.low = c.c11.low + (e1 * b.b1 + odds * bias2);
    c.c12.low = c.c12.low + e1 * d2;
    c.c13.low = c.c13.low + (e1 * b.b3 + odds * bias4);
    c.c22.low = c.c22.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23.low = c.c23.low + e2 * b.b3;
    c.c33.low = c.c33.low + (e3 * b.b3 + odds * bias6);
    hankel6 h = hankel6_factor(b.b1 - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_from_moments(GNOMON_T(moments6) b)
{
    Real c11 = b.b2 - b.b1 * b.b1;
    Real c12 = b.b3 - b.b1 * b.b2;
    Real c13 = b.b4 - b.b1 * b.b3;
    Real s22 = c11 * (b.b4 - b.b2 * b.b2) - c12 * c12;
    Real s23 = c11 * (b.b5 - b.b2 * b.b3) - c12 * c13;
    Real s33 = c11 * (b.b6 - b.b3 * b.b3) - c13 * c13;
    return hankel6_make(b.b1, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

GNOMON_NAMESPACE_END
#endif
