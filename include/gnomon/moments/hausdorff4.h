// Shadow intensity from four moments of depths that are known to lie in [-1, 1], as all depths of a map do: the sharp
// lower bound of the Hausdorff moment problem (Krein & Nudelman 1977), where hamburger4.h has that for any depths.
//
// The bound is that of hamburger4.h where both nodes of the canonical distribution beside z_f lie in [-1, 1]. Elsewhere
// the canonical distribution on [-1, 1] has the nodes -1, z_f, 1 and one more. About the mean, with s = -1 - mean,
// t = 1 - mean, u = z_f - mean and e_k = E[(y - s) (y - t) y^k], the fourth node is
//     x = (e2 - u e1) / (e1 - u e0)
// and its weights follow by interpolation, such as
//     w(s) = E[(y - u) (y - x) (y - t)] / ((s - u) (s - x) (s - t)),   w(x) = (e1 - u e0) / ((x - s) (x - u) (x - t))
// Each weight has an error of its own where nodes nearly meet. The weights before z_f, and 1 minus those from z_f on, are
// the same bound, and the smaller of both never darkens.
//
// The quadratic whose roots are the nodes beside z_f tells by its values at s and t which distribution it is. At most one
// node lies outside, since a root of P_2 is between the nodes.
//
// The bias must keep the moments those of depths in [-1, 1]. The vector of hamburger4.h is no guarantee: it has
// E[z^2] = E[z^4], all depths at -1, 0 and 1. The vector below is the farthest, in the maximum norm and after the sparse
// transform, from the boundary of the moments of depths in [-1, 1]: r = 0.1616, where that for any depths has 0.2165.
#ifndef GNOMON_MOMENTS_HAUSDORFF4_H
#define GNOMON_MOMENTS_HAUSDORFF4_H
#include "hamburger4.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(bias4_theta_within_b2, 0.59255);
GNOMON_CONSTANT(bias4_theta_within_b4, 0.48128);

/// Lower bound on the shadow intensity at z_f, in [0, 1], for depths in [-1, 1]. At least that of hamburger4_lower, but
/// for rounding.
/// Domain: z_f in [-1, 1], clamped; h of moments with a bias for depths in [-1, 1].
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the kernel in double (tests/soft/within.cpp),
///     error, float, hankel4_from_summed_within: p99 1e-4, p99.9 1e-1, max 8e-1
GNOMON_KERNEL Real hausdorff4_lower(GNOMON_T(hankel4) h, Real z_f)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real s = Real(-1) - h.mean;
    Real t = Real(1) - h.mean;
    Real q = hamburger4_q(h, u);
    Real w = h.variance * h.determinant;
    Real at_s = w + (u * s * h.determinant + q * hamburger4_q(h, s));
    Real at_t = w + (u * t * h.determinant + q * hamburger4_q(h, t));
    GNOMON_MASK between = q < Real(0);
    GNOMON_MASK outside =
        (between && (Real(0) < at_s || Real(0) < at_t)) || (!between && (at_s < Real(0) || at_t < Real(0)));
    // Times the variance, so that the fourth moment takes no division.
    Real sum = s + t;
    Real product = s * t;
    Real e0 = h.variance * (h.variance + product);
    Real e1 = h.variance * (h.third - sum * h.variance);
    Real e2 = (h.determinant + h.third * h.third) + h.variance * ((h.variance + product) * h.variance - sum * h.third);
    Real d = e1 - u * e0;
    Real x = clamp_or_nan((e2 - u * e1) / d, s, t);
    Real tx = t * x;
    Real ux = u * x;
    Real of_s = (h.third - ((u + x) + t) * h.variance) - u * tx;
    Real of_u = (h.third - ((s + x) + t) * h.variance) - s * tx;
    Real of_t = (h.third - ((s + u) + x) * h.variance) - s * ux;
    Real at_low = saturate_or_zero(of_s / ((s - u) * ((s - x) * (s - t))));
    Real at_node = saturate_or_zero(d / (h.variance * ((x - s) * ((x - u) * (x - t)))));
    Real at_receiver = saturate_or_zero(of_u / ((u - s) * ((u - x) * (u - t))));
    Real at_high = saturate_or_zero(of_t / ((t - s) * ((t - u) * (t - x))));
    Real node = gnomon_select(x < u, at_node, Real(0));
    Real rest = Real(1) - ((at_receiver + at_high) + gnomon_select(x < u, Real(0), at_node));
    Real within = gnomon_min(at_low + node, rest);
    Real lower = hamburger4_lower(h, z_f);
    return gnomon_select(outside && (Real(-1) < z), saturate_or_zero(gnomon_max(lower, within)), lower);
}

GNOMON_NAMESPACE_END
#endif
