// The mean depth of blockers, the surfaces of a search region that are before the receiver, from moments of the region:
// the blocker search of percentage-closer soft shadows in one look-up (Peters et al. 2017, Sec. 4.3; Yang et al. 2010).
//
// The moments name a canonical distribution with a node at the receiver's depth z_f (hamburger4.h). With A, the sum of
// w (z_f - x) over its nodes x before z_f, and their weight w, the lower bound on the shadow intensity, the result is
//     z_f - A / (epsilon + lower),
// Equation 4 of the paper, in which epsilon makes little of blockers of little weight, and returns z_f where none is.
// A needs no node: since the mean of (x - z_f) over all nodes is -u, with u = z_f - mean, and with the notation of
// hamburger4.h,
//     both nodes before z_f:    A = u
//     one:                      A = (u (b + r) - V a) / (2 r)
//     none:                     A = 0
// so the whole takes one division and one square root. Two moments have the one node mean - V / u beside z_f, and A is u
// where that is before z_f. The result is exact for a region of one or two surfaces, and of three with one at z_f.
#ifndef GNOMON_SOFT_BLOCKER_H
#define GNOMON_SOFT_BLOCKER_H
#include "../moments/hamburger4.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(blocker_epsilon, 1e-3);

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
GNOMON_DETAIL_KERNEL Real blocker_depth_before(Real z_f, Real distance_)
{
    return gnomon_max(z_f - gnomon_max(distance_, Real(0)), Real(-1));
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
GNOMON_KERNEL Real blocker2_depth(Real mean, Real variance, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    Real u = z - mean;
    Real whole = variance + u * u;
    Real below = u * whole;
    Real total = GNOMON_LITERAL(blocker_epsilon) * whole + u * u;
    return blocker_depth_before(z, below / total);
}

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
GNOMON_KERNEL Real blocker4_depth(GNOMON_T(hankel4) h, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real q = hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    Real s = GNOMON_LITERAL(hamburger4_lower_scale) * q;
    Real n = GNOMON_LITERAL(hamburger4_lower_scale) * h.determinant;
    Real un = u * n;
    Real a = s * h.variance;
    Real b = Real(0.5) * (un - s * h.third);
    Real r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    Real e = u * un + q * s;
    Real w = h.variance * n;
    Real whole = w + e;
    GNOMON_MASK between = q < Real(0);
    Real rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    Real share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    Real total = GNOMON_LITERAL(blocker_epsilon) * (whole * gnomon_select(between, r + r, Real(1))) + share;
    return blocker_depth_before(z, rest / total);
}

GNOMON_NAMESPACE_END
#endif
