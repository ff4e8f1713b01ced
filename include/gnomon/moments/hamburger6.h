// Shadow intensity from six moments, by counting, then weighing: see hamburger4.h for the idea. With three moments more than a
// surface shadow needs, it serves where many surfaces lie behind one another (Peters et al. 2017, 5.4).
//
// With K(x, y) = sum_k P_k(x) P_k(y) / D_k, w(z) = 1 / K(z, z) and a = sign changes in P_0(z_f), ..., P_3(z_f):
//     a = 0: lower = 1 - w_f      a = 1: lower = 1 - w_f - w(largest root)      a = 2: lower = w(smallest root)      a = 3: lower = 0
// so one root at most is needed, and it is alone on its side of z_f. In t = 1 / (z - z_f) it is the only root of its sign of
//     k0 t^3 + k1 t^2 + k2 t + k3,      k0 = K(z_f, z_f) >= 1,      k_j = (d/dz)^j K(z_f, z) / j! at z_f,
// and after a change of sign the largest of three real ones: start from the closed form, whose cosine of a third of an angle is a
// short polynomial in the cosine of half the angle, then polish by Halley's iteration on the cubic itself.
#ifndef GNOMON_MOMENTS_HAMBURGER6_H
#define GNOMON_MOMENTS_HAMBURGER6_H
#include "../numerics/cubic.h"
#include "../numerics/select.h"
#include "bounds.h"
#include "hankel6.h"
GNOMON_NAMESPACE_BEGIN

/// P_2 and P_3 at one depth; P_1 is its distance u from the mean.
GNOMON_STRUCT polynomials6 {
    Real p1, p2, p3;
};

GNOMON_KERNEL GNOMON_T(polynomials6) hamburger6_polynomials(GNOMON_T(hankel6) h, Real u)
{
    GNOMON_T(polynomials6) p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// K(z, z), at least 1; its inverse is the weight of a node at z.
GNOMON_KERNEL Real hamburger6_kernel(GNOMON_T(hankel6) h, GNOMON_T(polynomials6) p)
{
    return Real(1) + ((p.p1 * p.p1) * h.inverse1 + ((p.p2 * p.p2) * h.inverse2 + (p.p3 * p.p3) * h.inverse3));
}

/// The only node on its side of z_f, less z_f: above where side = 1, below where side = -1. p = polynomials at z_f, kernel_f = K(z_f, z_f).
GNOMON_KERNEL Real hamburger6_lone_root(GNOMON_T(hankel6) h, GNOMON_T(polynomials6) p, Real kernel_f, Real side)
{
    Real slope2 = Real(2) * p.p1 - h.shift2;
    Real v = p.p1 - h.shift3;
    Real slope3 = (p.p2 + v * slope2) - h.ratio;
    Real q2 = p.p2 * h.inverse2;
    Real q3 = p.p3 * h.inverse3;
    Real k1 = p.p1 * h.inverse1 + (slope2 * q2 + slope3 * q3);
    Real k2 = q2 + (slope2 + v) * q3;
    Real t = cubic_largest_root(kernel_f, side * k1, k2, side * q3);
    return side / gnomon_max(Real(0.0009765625), t);
}

/// Both bounds and the weight of the receiver. z_f in [-1, 1], clamped. A NaN anywhere gives 0, lit.
GNOMON_KERNEL GNOMON_T(hamburger_bounds) hamburger6_bounds(GNOMON_T(hankel6) h, Real z_f)
{
    GNOMON_T(polynomials6) p = hamburger6_polynomials(h, clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean);
    Real kernel_f = hamburger6_kernel(h, p);
    Real w_f = Real(1) / kernel_f;
    GNOMON_MASK positive1 = p.p1 > Real(0);
    GNOMON_MASK positive2 = p.p2 > Real(0);
    GNOMON_MASK positive3 = p.p3 > Real(0);
    GNOMON_MASK all_below = positive1 && positive2 && positive3;
    GNOMON_MASK all_above = (!positive1) && positive2 && (!positive3);
    // P_3 > 0: an even number of nodes above z_f, so two, and the lone one is below; else it is above.
    Real side = gnomon_select(positive3, Real(-1), Real(1));
    Real x = p.p1 + hamburger6_lone_root(h, p, kernel_f, side);
    Real w = Real(1) / hamburger6_kernel(h, hamburger6_polynomials(h, x));
    Real between = gnomon_select(positive3, w, (Real(1) - w_f) - w);
    GNOMON_T(hamburger_bounds) r;
    r.lower = saturate_or_zero(gnomon_select(all_below, Real(1) - w_f, gnomon_select(all_above, Real(0), between)));
    r.weight = gnomon_min(saturate_or_zero(w_f), Real(1) - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f: what a surface should show, since it never darkens a lit one.
GNOMON_KERNEL Real hamburger6_lower(GNOMON_T(hankel6) h, Real z_f)
{
    return hamburger6_bounds(h, z_f).lower;
}

GNOMON_NAMESPACE_END
#endif
