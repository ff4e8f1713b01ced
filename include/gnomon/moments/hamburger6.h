// Shadow intensity from six moments, by the method of hamburger4.h (Peters et al. 2017, Sec. 5.4 and Alg. 1). Surface
// shadows need four moments only. Six serve where many surfaces lie behind one another, as in single scattering.
//
// With K(x, y) = sum_k P_k(x) P_k(y) / D_k and w(z) = 1 / K(z, z), the number a of nodes above z_f is the number of
// sign changes in P_0(z_f), ..., P_3(z_f):
//     a = 0:  lower = 1 - w_f                        a = 2:  lower = w(smallest root)
//     a = 1:  lower = 1 - w_f - w(largest root)      a = 3:  lower = 0
// At most one root is needed, and that root is alone on its side of z_f. In t = 1 / (z - z_f) it is the only one of its
// sign among the roots of
//     k0 t^3 + k1 t^2 + k2 t + k3,      k0 = K(z_f, z_f) >= 1,      k_j = (d/dz)^j K(z_f, z) / j! at z_f.
// After a change of sign it is the largest of three real roots, which cubic.h finds.
#ifndef GNOMON_MOMENTS_HAMBURGER6_H
#define GNOMON_MOMENTS_HAMBURGER6_H
#include "../numerics/cubic.h"
#include "../numerics/quadratic.h"
#include "../numerics/select.h"
#include "bounds.h"
#include "hankel6.h"
GNOMON_NAMESPACE_BEGIN

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
GNOMON_STRUCT(distribution4) { Real depth0, depth1, depth2, depth3, weight0, weight1, weight2, weight3; };

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
GNOMON_STRUCT(polynomials6) { Real p1, p2, p3; };

/// P_1, P_2 and P_3 at the depth mean + u.
GNOMON_DETAIL_KERNEL GNOMON_T(polynomials6) hamburger6_polynomials(GNOMON_T(hankel6) h, Real u)
{
    GNOMON_T(polynomials6) p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
GNOMON_DETAIL_KERNEL Real hamburger6_kernel(GNOMON_T(hankel6) h, GNOMON_T(polynomials6) p)
{
    return (h.whole + h.first * (p.p1 * p.p1)) + (h.second * (p.p2 * p.p2) + p.p3 * p.p3);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
GNOMON_STRUCT(derivatives6) { Real slope2, slope3, bend3; };

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
GNOMON_DETAIL_KERNEL GNOMON_T(derivatives6) hamburger6_derivatives(GNOMON_T(hankel6) h, GNOMON_T(polynomials6) p)
{
    Real v = p.p1 - h.shift3;
    GNOMON_T(derivatives6) d;
    d.slope2 = (p.p1 + p.p1) - h.shift2;
    d.slope3 = (p.p2 + v * d.slope2) - h.ratio;
    d.bend3 = d.slope2 + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
GNOMON_DETAIL_KERNEL GNOMON_T(polynomials6) hamburger6_polynomials_shift(GNOMON_T(polynomials6) p,
                                                                         GNOMON_T(derivatives6) d, Real distance_)
{
    p.p1 = p.p1 + distance_;
    p.p2 = p.p2 + distance_ * (d.slope2 + distance_);
    p.p3 = p.p3 + distance_ * (d.slope3 + distance_ * (d.bend3 + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
GNOMON_STRUCT(hamburger6_cubic) { Real b, c, d; };

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
GNOMON_DETAIL_KERNEL GNOMON_T(hamburger6_cubic) hamburger6_other_nodes(GNOMON_T(hankel6) h, GNOMON_T(polynomials6) p,
                                                                       GNOMON_T(derivatives6) d, Real inverse,
                                                                       Real side)
{
    Real q2 = h.second * p.p2;
    GNOMON_T(hamburger6_cubic) r;
    r.b = inverse * (side * (h.first * p.p1 + (d.slope2 * q2 + d.slope3 * p.p3)));
    r.c = inverse * (q2 + d.bend3 * p.p3);
    r.d = inverse * (side * p.p3);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
GNOMON_DETAIL_KERNEL Real hamburger6_distance(Real t)
{
    Real least = Real(0.0009765625);
    Real away = gnomon_select(t < Real(0), gnomon_min(t, -least), gnomon_max(t, least));
    return Real(1) / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's weight.
GNOMON_STRUCT(hamburger6_sums) { Real lower, distance, weight; };

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums of
/// the nodes on either side.
GNOMON_DETAIL_KERNEL GNOMON_T(hamburger6_sums) hamburger6_sums_at(GNOMON_T(hankel6) h, Real u)
{
    polynomials6 p = hamburger6_polynomials(h, u);
    Real inverse = Real(1) / hamburger6_kernel(h, p);
    GNOMON_MASK positive1 = p.p1 > Real(0);
    GNOMON_MASK positive2 = p.p2 > Real(0);
    GNOMON_MASK positive3 = p.p3 > Real(0);
    GNOMON_MASK all_below = positive1 && positive2 && positive3;
    GNOMON_MASK all_above = (!positive1) && positive2 && (!positive3);
    GNOMON_MASK outside = all_below || all_above;
    GNOMON_T(hamburger6_sums) r;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, Real(1) - r.weight, Real(0));
    r.distance = gnomon_select(all_below, p.p1, Real(0));
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        Real side = gnomon_select(positive3, Real(-1), Real(1));
        derivatives6 d = hamburger6_derivatives(h, p);
        hamburger6_cubic n = hamburger6_other_nodes(h, p, d, inverse, side);
        cubic_step t = cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        Real away = t.denominator / gnomon_max(t.numerator, Real(0.0009765625) * t.denominator);
        Real w = h.whole / hamburger6_kernel(h, hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (Real(1) - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1 + w * away));
    }
    return r;
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, four depths and more: p99 1e-14, p99.9 4e-14
///     error, float, hankel6_constant_bias at 5e-6: p99 2e-5, p99.9 5e-5, max 2e-4
/// and against the kernel in double,
///     error, float, hankel6_from_float: p99 2e-5, p99.9 5e-5, max 2e-4
///     error, float, hankel6_from_float_filtered: p99 1e-5, p99.9 3e-5, max 1e-4
///     error, float, hankel6_from_unorm16: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10: p99 3e-5, p99.9 9e-5, max 8e-4
///     error, float, hankel6_from_unorm10_filtered: p99 2e-5, p99.9 5e-5, max 3e-4
/// Maxima are found by climbing and stated with a margin. Without a bias there is no maximum: if D_3 is at the floor,
/// moments rounded in double cannot resolve distances below 2^-32.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
GNOMON_KERNEL GNOMON_T(hamburger_bounds) hamburger6_bounds(GNOMON_T(hankel6) h, Real z_f)
{
    hamburger6_sums s = hamburger6_sums_at(h, clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean);
    GNOMON_T(hamburger_bounds) r;
    r.lower = saturate_or_zero(s.lower);
    r.weight = gnomon_min(saturate_or_zero(s.weight), Real(1) - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger6_bounds.
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
GNOMON_KERNEL Real hamburger6_lower(GNOMON_T(hankel6) h, Real z_f) { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
GNOMON_KERNEL GNOMON_T(distribution4) hamburger6_distribution(GNOMON_T(hankel6) h, Real z_f)
{
    polynomials6 p = hamburger6_polynomials(h, clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean);
    Real inverse = Real(1) / hamburger6_kernel(h, p);
    Real side = gnomon_select(p.p3 > Real(0), Real(-1), Real(1));
    hamburger6_cubic n = hamburger6_other_nodes(h, p, hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    Real t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    GNOMON_MASK large = (t1 * t1) * t1 > -n.d;
    Real backward = -n.d / t1;
    Real forward = n.b + t1;
    Real b = Real(0.5) * gnomon_select(large, (backward - n.c) / t1, forward);
    Real c = gnomon_select(large, backward, n.c + t1 * forward);
    quadratic_result q = quadratic_roots(Real(1), b, c);
    Real t2 = cubic_halley(n.b, n.c, n.d, q.first);
    Real t3 = cubic_halley(n.b, n.c, n.d, q.second);
    Real x1 = p.p1 + side * hamburger6_distance(t1);
    Real x2 = p.p1 + side * hamburger6_distance(t2);
    Real x3 = p.p1 + side * hamburger6_distance(t3);
    Real low = gnomon_min(x2, x3);
    Real high = gnomon_max(x2, x3);
    Real y1 = gnomon_min(x1, low);
    Real y2 = gnomon_max(gnomon_min(x1, high), low);
    Real y3 = gnomon_max(x1, high);
    Real w0 = h.whole * inverse;
    Real w1 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y1));
    Real w2 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y2));
    Real w3 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y3));
    Real sum = (w0 + w1) + (w2 + w3);
    GNOMON_MASK known = sum > Real(0); // false for NaN
    GNOMON_T(distribution4) d;
    d.depth0 = gnomon_select(known, h.mean + p.p1, Real(1));
    d.depth1 = gnomon_select(known, h.mean + y1, Real(1));
    d.depth2 = gnomon_select(known, h.mean + y2, Real(1));
    d.depth3 = gnomon_select(known, h.mean + y3, Real(1));
    d.weight1 = gnomon_select(known, w1 / sum, Real(0));
    d.weight2 = gnomon_select(known, w2 / sum, Real(0));
    d.weight3 = gnomon_select(known, w3 / sum, Real(0));
    d.weight0 = saturate_or_zero(Real(1) - (d.weight1 + (d.weight2 + d.weight3)));
    return d;
}

GNOMON_NAMESPACE_END
#endif
