// Shadow intensity from four moments: sharp bounds on Z(z < z_f) over all depth distributions Z with these moments
// (the Hamburger moment problem; Peters et al. 2017, Equation 1 and Algorithm 1), by counting, then weighing.
//
// The Christoffel-Darboux kernel K(x, y) = sum_k P_k(x) P_k(y) / D_k of the factored Hankel matrix (hankel4.h) holds the canonical
// distribution with a node at z_f: its other two nodes are the roots of K(z_f, .), and a node z weighs 1 / K(z, z). The number
// of nodes above z_f is the number of sign changes in P_0(z_f), P_1(z_f), P_2(z_f):
//     none: lower = 1 - w_f       both: lower = 0       one: lower = the weight of the smaller root       upper = lower + w_f
// With x = z - mean, V = D_1, N = D_1 D_2, W = V N, G = L - 2 mean V and Q(x) = V P_2 = (V x - G) x - V^2:
//     1 / K(z, z) = W / (W + x^2 N + Q(x)^2),       K(z_f, .) = 0:  Q V x^2 + (u N - Q G) x + (W - Q V^2) = 0,  u = z_f - mean.
// Where one root lies on each side, Q = Q(u) < 0, so the discriminant is a sum of positive terms. Two divisions, one root.
#ifndef GNOMON_MOMENTS_HAMBURGER4_H
#define GNOMON_MOMENTS_HAMBURGER4_H
#include "../numerics/select.h"
#include "hankel4.h"
GNOMON_NAMESPACE_BEGIN

/// Bounds on the shadow intensity: lower <= Z(z < z_f), Z(z <= z_f) <= upper = lower + weight, where weight is that of z_f itself.
GNOMON_STRUCT hamburger_bounds {
    Real lower, upper, weight;
};

/// The canonical distribution: depths ascending apart from depth0 = z_f, and their weights, which sum to 1.
GNOMON_STRUCT hamburger4_distribution_result {
    Real depth0, depth1, depth2, weight0, weight1, weight2;
};

GNOMON_CONSTANT(hamburger4_scale, 72057594037927936.0); // 2^56

/// Q(x) = V P_2(mean + x).
GNOMON_KERNEL Real hamburger4_q(GNOMON_T(hankel4) h, Real x)
{
    Real g = h.covariance - Real(2) * (h.mean * h.variance);
    return (h.variance * x - g) * x - h.variance * h.variance;
}

/// The weight of the node at mean + x, where q = Q(x).
GNOMON_KERNEL Real hamburger4_weight(GNOMON_T(hankel4) h, Real x, Real q)
{
    Real w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The smaller node below z_f = mean + u, less the mean. Domain: q = Q(u) < 0; elsewhere any number or NaN.
GNOMON_KERNEL Real hamburger4_smaller_root(GNOMON_T(hankel4) h, Real u, Real q)
{
    // The power of two keeps the discriminant of a single depth, down to 2^-139, from underflowing.
    Real n = h.determinant * GNOMON_LITERAL(hamburger4_scale);
    Real s = q * GNOMON_LITERAL(hamburger4_scale);
    Real g = h.covariance - Real(2) * (h.mean * h.variance);
    Real a = s * h.variance;
    Real b = Real(0.5) * (u * n - s * g);
    Real c = h.variance * (n - s * h.variance);
    Real r = gnomon_sqrt(gnomon_max(b * b - a * c, Real(0)));
    GNOMON_MASK falls = b > Real(0);
    return gnomon_select(falls, -c, r - b) / gnomon_select(falls, b + r, a);
}

/// Lower bound on the shadow intensity at z_f: what a surface should show, since it never darkens a lit one (paper, 2.2.1).
GNOMON_KERNEL Real hamburger4_lower(GNOMON_T(hankel4) h, Real z_f)
{
    Real u = clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean;
    Real q = hamburger4_q(h, u);
    GNOMON_MASK between = q < Real(0);
    Real x = gnomon_select(between, hamburger4_smaller_root(h, u, q), u);
    Real w = hamburger4_weight(h, x, hamburger4_q(h, x));
    Real outside = gnomon_select(u > Real(0), Real(1) - w, Real(0));
    return saturate_or_zero(gnomon_select(between, w, outside));
}

GNOMON_NAMESPACE_END
#endif
