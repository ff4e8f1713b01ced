// The Hankel matrix of six moments, factored: everything that all receivers under one filter region share.
//
// After one step of elimination the covariances c_ij = b_(i+j) - b_i b_j of (z, z^2, z^3) remain, after the next
// (without divisions, Bareiss) s_22 = c_11 c_22 - c_12^2, s_23, s_33, and then t = s_22 s_33 - s_23^2. With L D L^T of
// pivots D_1 = c_11, D_2 = s_22 / c_11, D_3 = t / (c_11 s_22) and l21 = c_12 / c_11, l32 = s_23 / s_22 below the
// diagonal, and with u = z - b1, the monic orthogonal polynomials of the distribution, for which D_k = E[P_k^2], are
//     P_1 = u,    P_2 = (u - (l21 - 2 b1)) P_1 - D_1,    P_3 = (u - (l32 - l21 - b1)) P_2 - (D_2 / D_1) P_1
// (Peters et al. 2017, 5.4, Algorithm 1, step 2; the three-term recurrence: Gautschi 2004, 1.3). Every difference of
// moments cancels, so all are taken from exact products; a bias (bias.h) is added to the covariances, as double words
// that are kept until a pivot is had: in the moments it would be rounded away.
#ifndef GNOMON_MOMENTS_HANKEL6_H
#define GNOMON_MOMENTS_HANKEL6_H
#include "../numerics/two_product.h"
#include "covariance.h"
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

/// The recurrence: mean b1, D_1, D_2 / D_1, the shifts of u in P_2 and P_3, and one over each pivot. Pivots are
/// positive, whatever the moments were, or NaN where one of these was.
GNOMON_STRUCT hankel6 { Real mean, variance, ratio, shift2, shift3, inverse1, inverse2, inverse3; };

/// The covariances of (z, z^2, z^3).
GNOMON_STRUCT covariances6 { GNOMON_T(double_word) c11, c12, c13, c22, c23, c33; };

/// By Hoelder's inequality the terms are ordered where i + j is even.
GNOMON_KERNEL GNOMON_T(covariances6) covariances6_of(GNOMON_T(moments6) b)
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

/// Elimination, no pivot below the floor.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_factor(Real mean, GNOMON_T(covariances6) c)
{
    GNOMON_T(hankel6) h;
    h.mean = mean;
    h.variance = gnomon_max(GNOMON_PIVOT_FLOOR, c.c11.high + c.c11.low);
    h.inverse1 = Real(1) / h.variance;
    Real l21 = (c.c12.high + c.c12.low) * h.inverse1;
    GNOMON_T(double_word) s22 = double_word_minor(c.c11, c.c22, c.c12, c.c12);
    GNOMON_T(double_word) s23 = double_word_minor(c.c11, c.c23, c.c12, c.c13);
    GNOMON_T(double_word) s33 = double_word_minor(c.c11, c.c33, c.c13, c.c13);
    Real s = gnomon_max(GNOMON_PIVOT_FLOOR * h.variance, s22.high + s22.low);
    Real inverse_s = Real(1) / s;
    h.shift2 = l21 - Real(2) * mean;
    h.shift3 = ((s23.high + s23.low) * inverse_s - l21) - mean;
    h.ratio = s * (h.inverse1 * h.inverse1);
    h.inverse2 = h.variance * inverse_s;
    Real scale = h.variance * s;
    h.inverse3 = scale / gnomon_max(GNOMON_PIVOT_FLOOR * scale, double_word_determinant(s22, s23, s33));
    return h;
}

/// |P_k(i)|^2 from its two parts; at least 1, since the roots of P_k are real. A NaN, the second argument of
/// gnomon_max, stays one.
GNOMON_KERNEL Real hankel6_norm(Real x, Real y) { return gnomon_max(Real(1), x * x + y * y); }

/// The moments as they are, with each pivot D_k raised to at least noise |P_k(i)|^2, about what errors up to noise in
/// each stored moment make of it (bias.h, adaptive). Covariances come without cancellation, and that is enough: what
/// plain elimination rounds away stays below what noise of 2^-24 does, so double words would cost much and change
/// little.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_raised(GNOMON_T(moments6) b, GNOMON_SETTING noise)
{
    noise = gnomon_max(GNOMON_PIVOT_FLOOR, noise);
    GNOMON_T(hankel6) h;
    h.mean = b.b1;
    h.variance = gnomon_max(noise * (b.b1 * b.b1 + Real(1)), subtract_product_rounded(b.b2, b.b1, b.b1));
    h.inverse1 = Real(1) / h.variance;
    Real c12 = subtract_product_rounded(b.b3, b.b1, b.b2);
    Real c13 = subtract_product_rounded(b.b4, b.b1, b.b3);
    Real l21 = c12 * h.inverse1;
    Real l31 = c13 * h.inverse1;
    Real p0 = l21 * b.b1 - b.b2; // P_2 = z^2 - l21 z + p0
    Real norm2 = hankel6_norm(l21, p0 - Real(1));
    Real d2 = gnomon_max(noise * norm2, subtract_product_rounded(b.b4, b.b2, b.b2) - l21 * c12);
    h.inverse2 = Real(1) / d2;
    h.ratio = d2 * h.inverse1;
    Real c23 = subtract_product_rounded(b.b5, b.b2, b.b3) - l21 * c13;
    Real l32 = c23 * h.inverse2;
    h.shift2 = l21 - Real(2) * b.b1;
    h.shift3 = (l32 - l21) - b.b1;
    Real q1 = l32 * l21 - l31; // P_3 = z^3 - l32 z^2 + q1 z + q0
    Real q0 = (l31 * b.b1 - b.b3) - l32 * p0;
    Real d3 = (subtract_product_rounded(b.b6, b.b3, b.b3) - l31 * c13) - l32 * c23;
    h.inverse3 = Real(1) / gnomon_max(noise * hankel6_norm(l32 + q0, q1 - Real(1)), d3);
    return h;
}

/// The moments of the mixture (1 - alpha) Z + alpha Z*, where Z* is symmetric with even moments bias2, bias4, bias6
/// (paper, 2.5, 5.4.3).
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_biased(GNOMON_T(moments6) b, GNOMON_SETTING bias2, GNOMON_SETTING bias4,
                                               GNOMON_SETTING bias6, GNOMON_SETTING alpha)
{
    GNOMON_T(moments6) e;
    e.b1 = Real(-1) * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = Real(-1) * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    e.b5 = Real(-1) * alpha * b.b5;
    e.b6 = alpha * (bias6 - b.b6);
    GNOMON_T(covariances6) c = covariances6_of(b);
    c.c11 = biased_covariance(c.c11, b.b1, b.b1, e.b2, e.b1, e.b1);
    c.c12 = biased_covariance(c.c12, b.b1, b.b2, e.b3, e.b1, e.b2);
    c.c13 = biased_covariance(c.c13, b.b1, b.b3, e.b4, e.b1, e.b3);
    c.c22 = biased_covariance(c.c22, b.b2, b.b2, e.b4, e.b2, e.b2);
    c.c23 = biased_covariance(c.c23, b.b2, b.b3, e.b5, e.b2, e.b3);
    c.c33 = biased_covariance(c.c33, b.b3, b.b3, e.b6, e.b3, e.b3);
    return hankel6_factor(b.b1 + e.b1, c);
}

/// Plain arithmetic: right for moments from 10 and 16 bit storage, whose own errors are larger, and for double.
GNOMON_KERNEL GNOMON_T(hankel6) hankel6_fast(GNOMON_T(moments6) b)
{
    GNOMON_T(hankel6) h;
    h.mean = b.b1;
    h.variance = gnomon_max(GNOMON_PIVOT_FLOOR, b.b2 - b.b1 * b.b1);
    h.inverse1 = Real(1) / h.variance;
    Real c12 = b.b3 - b.b1 * b.b2;
    Real c13 = b.b4 - b.b1 * b.b3;
    Real l21 = c12 * h.inverse1;
    Real l31 = c13 * h.inverse1;
    Real d2 = gnomon_max(GNOMON_PIVOT_FLOOR, (b.b4 - b.b2 * b.b2) - l21 * c12);
    Real c23 = (b.b5 - b.b2 * b.b3) - l21 * c13;
    h.inverse2 = Real(1) / d2;
    Real l32 = c23 * h.inverse2;
    h.shift2 = l21 - Real(2) * b.b1;
    h.shift3 = (l32 - l21) - b.b1;
    h.ratio = d2 * h.inverse1;
    Real d3 = gnomon_max(GNOMON_PIVOT_FLOOR, ((b.b6 - b.b3 * b.b3) - l31 * c13) - l32 * c23);
    h.inverse3 = Real(1) / d3;
    return h;
}

GNOMON_NAMESPACE_END
#endif
