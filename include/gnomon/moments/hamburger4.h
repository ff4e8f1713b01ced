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
#include "../numerics/quadratic.h"
#include "../numerics/select.h"
#include "bounds.h"
#include "hankel4.h"
GNOMON_NAMESPACE_BEGIN

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
GNOMON_STRUCT(distribution3) { Real depth0, depth1, depth2, weight0, weight1, weight2; };

GNOMON_CONSTANT(hamburger4_scale, 72057594037927936.0);     // 2^56
GNOMON_CONSTANT(hamburger4_lower_scale, 281474976710656.0); // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
GNOMON_DETAIL_KERNEL Real hamburger4_q(GNOMON_T(hankel4) h, Real x)
{
    return (h.variance * x - h.third) * x - h.variance * h.variance;
}

/// The weight of the node at mean + x, where q = Q(x).
GNOMON_DETAIL_KERNEL Real hamburger4_weight(GNOMON_T(hankel4) h, Real x, Real q)
{
    Real w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
GNOMON_STRUCT(hamburger4_quadratic) { Real a, b, c; };

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
GNOMON_DETAIL_KERNEL GNOMON_T(hamburger4_quadratic) hamburger4_other_nodes(GNOMON_T(hankel4) h, Real u, Real q)
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    Real n = h.determinant * GNOMON_LITERAL(hamburger4_scale);
    Real s = q * GNOMON_LITERAL(hamburger4_scale);
    GNOMON_T(hamburger4_quadratic) r;
    r.a = s * h.variance;
    r.b = Real(0.5) * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
GNOMON_STRUCT(hamburger4_fractions) { Real share, total, receiver, whole; };

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
GNOMON_DETAIL_KERNEL GNOMON_T(hamburger4_fractions) hamburger4_fractions_at(GNOMON_T(hankel4) h, Real z_f)
{
    Real u = clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean;
    Real q = hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    Real s = GNOMON_LITERAL(hamburger4_lower_scale) * q;
    Real n = GNOMON_LITERAL(hamburger4_lower_scale) * h.determinant;
    Real un = u * n;
    Real a = s * h.variance;
    Real b = Real(0.5) * (un - s * h.third);
    Real r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    Real e = u * un + q * s;
    GNOMON_T(hamburger4_fractions) f;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    GNOMON_MASK between = q < Real(0);
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
GNOMON_KERNEL Real hamburger4_lower(GNOMON_T(hankel4) h, Real z_f)
{
    hamburger4_fractions f = hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
GNOMON_KERNEL GNOMON_T(hamburger_bounds) hamburger4_bounds(GNOMON_T(hankel4) h, Real z_f)
{
    hamburger4_fractions f = hamburger4_fractions_at(h, z_f);
    GNOMON_T(hamburger_bounds) r;
    r.lower = saturate_or_zero(f.share / f.total);
    r.weight = gnomon_min(saturate_or_zero(f.receiver / f.whole), Real(1) - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// The canonical distribution with a node at z_f. The other two depths are finite, at most 1024 from the mean, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1
GNOMON_KERNEL GNOMON_T(distribution3) hamburger4_distribution(GNOMON_T(hankel4) h, Real z_f)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real q = hamburger4_q(h, u);
    hamburger4_quadratic p = hamburger4_other_nodes(h, u, q);
    quadratic_result x = quadratic_roots(p.a, p.b, p.c);
    Real x1 = clamp_or_nan(x.first, Real(-1024), Real(1024));
    Real x2 = clamp_or_nan(x.second, Real(-1024), Real(1024));
    Real w0 = hamburger4_weight(h, u, q);
    Real w1 = hamburger4_weight(h, x1, hamburger4_q(h, x1));
    Real w2 = hamburger4_weight(h, x2, hamburger4_q(h, x2));
    Real sum = w0 + (w1 + w2);
    GNOMON_MASK swapped = x2 < x1;
    GNOMON_MASK known = sum > Real(0); // false for NaN
    GNOMON_T(distribution3) d;
    d.depth0 = gnomon_select(known, z, Real(1));
    d.depth1 = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), Real(1));
    d.depth2 = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), Real(1));
    d.weight1 = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, Real(0));
    d.weight2 = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, Real(0));
    d.weight0 = saturate_or_zero(Real(1) - (d.weight1 + d.weight2));
    return d;
}

GNOMON_NAMESPACE_END
#endif
