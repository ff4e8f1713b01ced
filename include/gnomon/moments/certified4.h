// Shadow intensity from four stored moments, certified: never above the truth, whatever storage has rounded.
//
// A quartic p with p <= 1 before z_f and p <= 0 from z_f on has E[p] <= Z(z < z_f) for every distribution Z. Storage
// moves channel k by at most noise_k, so E[p] is at least the mean that the stored channels give less
// sum_k noise_k |p_k|, where p_k is the coefficient at channel k. That is an honest bound whatever p is, and p with the
// nodes of the biased moments (hamburger4.h) is nearly the best (docs/decisions/2-bias.md).
//
// In y = z - z_f the two nodes beside z_f are the roots of a y^2 + b y + w, in the notation of hamburger4.h
//     a = Q V,    b = u N + Q (2 V u - G),    w = V N + u^2 N + Q^2,    r^2 = b^2 - 4 a w,
// and the nearer of those before z_f is at y = -1 / c, c = (b + r) / (2 w).
//     Q < 0, a node on either side:    p = -(1 + d + k y)^2 (2 (c - k) y + c (c - 2 k) y^2)
//     Q >= 0, b > 0, both before:      p = 1 - (1 + c y)^2 (1 + g y)^2
//     else none before:                the bound is 0
// with d = b / (2 r) - 1/2, k = c d and g = (b - r) / (2 w). Both p are 1 at the nodes before z_f, and 0 at z_f and at
// those behind. Other c >= 0, d in [-1, 0] and g >= 0 give other such p: the nodes need not be right, only p.
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H
#include "../numerics/select.h"
#include "hankel4.h"
#include "quantization.h"
GNOMON_NAMESPACE_BEGIN

/// p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4), top = 0 or 1, or far below where nothing is certified.
GNOMON_STRUCT(certificate4) { Real top, s0, s1, s2, s3, s4; };

GNOMON_CONSTANT(certificate4_nothing, -1267650600228229401496703205376.0); // -2^100

/// p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
GNOMON_DETAIL_KERNEL GNOMON_T(certificate4) certificate4_about(Real z_f, Real n0, Real t0, Real t1, Real n1, Real n2)
{
    Real nz = n2 * z_f;
    Real ns = (n1 + n1) - nz;
    Real k0 = n0 - ns * z_f;
    Real k1 = ns - nz;
    Real m = t0 - t1 * z_f;
    Real m0 = m * m;
    Real m1 = m * (t1 + t1);
    Real m2 = t1 * t1;
    GNOMON_T(certificate4) p;
    p.top = n0;
    p.s0 = m0 * k0;
    p.s1 = m0 * k1 + m1 * k0;
    p.s2 = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3 = m1 * n2 + m2 * k1;
    p.s4 = m2 * n2;
    return p;
}

/// The certificate for a receiver z_f in [-1, 1], from a positive definite matrix. The two quotients wait for no root:
/// right for biased moments of 16-bit storage, whose bias keeps nodes so far apart that b + r and b - r may cancel.
GNOMON_DETAIL_KERNEL GNOMON_T(certificate4) certificate4_make(GNOMON_T(hankel4) h, Real z_f)
{
    Real u = z_f - h.mean;
    Real vu = h.variance * u;
    Real slope = vu - h.third;
    Real q = slope * u - h.variance * h.variance;
    Real un = u * h.determinant;
    Real w = h.variance * h.determinant + (u * un + q * q);
    Real w2 = w + w;
    Real a = q * h.variance;
    Real b = un + q * (vu + slope);
    Real square = b * b - (a + a) * w2;
    Real inverse = Real(1) / w2;
    Real ratio = b / (square + square);
    Real r = gnomon_sqrt(gnomon_max(Real(0), square));
    Real c = (b + r) * inverse;
    Real g = (b - r) * inverse;
    Real d = ratio * r - Real(0.5);
    Real k = c * d;
    GNOMON_MASK between = q < Real(0);
    Real n0 = gnomon_select(between, Real(0), Real(1));
    Real n1 = gnomon_select(between, c - k, g);
    Real n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    Real t0 = gnomon_select(between, Real(1) + d, Real(1));
    Real t1 = gnomon_select(between, k, c);
    certificate4 p = certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (Real(0) < b), n0, GNOMON_LITERAL(certificate4_nothing));
    return p;
}

/// The least that E[p] can be of the distribution whose moments b are off by at most noise each.
GNOMON_DETAIL_KERNEL Real certificate4_mean(GNOMON_T(certificate4) p, GNOMON_T(moments4) b, GNOMON_T(moments4) noise)
{
    Real mean = (p.s0 + p.s1 * b.b1) + ((p.s2 * b.b2 + p.s3 * b.b3) + p.s4 * b.b4);
    Real doubt = (noise.b1 * gnomon_abs(p.s1) + noise.b2 * gnomon_abs(p.s2)) +
                 (noise.b3 * gnomon_abs(p.s3) + noise.b4 * gnomon_abs(p.s4));
    return p.top - (mean + doubt);
}

/// The same from channels c of theta4, off by at most noise each: p's coefficients at the channels are the transpose of
/// theta4_inverse times those at the moments.
GNOMON_DETAIL_KERNEL Real certificate4_theta_mean(GNOMON_T(certificate4) p, GNOMON_T(moments4) c, GNOMON_SETTING noise)
{
    Real third = Real(0.75) * p.s3;
    Real p1 = GNOMON_LITERAL(theta4_inverse11) * p.s1 - third;
    Real p2 = Real(0.125) * (p.s2 - p.s4);
    Real p3 = GNOMON_LITERAL(theta4_inverse13) * (p.s1 + third);
    Real p4 = p.s2 + p.s4;
    Real mean = (p.s0 + (p2 * c.b2 + p4 * c.b4)) + (p1 * (c.b1 - Real(0.5)) + p3 * (c.b3 - Real(0.5)));
    Real doubt = noise * ((gnomon_abs(p1) + gnomon_abs(p2)) + (gnomon_abs(p3) + gnomon_abs(p4)));
    return p.top - (mean + doubt);
}

/// Lower bound on the shadow intensity at z_f, clamped to [-1, 1], from moments b, each off by at most its entry in
/// noise; h is the matrix of b with a bias. Plain arithmetic: for moments from 16-bit storage.
GNOMON_KERNEL Real certified4_lower(GNOMON_T(hankel4) h, GNOMON_T(moments4) b, GNOMON_T(moments4) noise, Real z_f)
{
    certificate4 p = certificate4_make(h, clamp_or_nan(z_f, Real(-1), Real(1)));
    return saturate_or_zero(certificate4_mean(p, b, noise));
}

/// The same from channels c of theta4, each off by at most noise; h is the matrix of their moments with a bias.
GNOMON_KERNEL Real certified4_theta_lower(GNOMON_T(hankel4) h, GNOMON_T(moments4) c, GNOMON_SETTING noise, Real z_f)
{
    certificate4 p = certificate4_make(h, clamp_or_nan(z_f, Real(-1), Real(1)));
    return saturate_or_zero(certificate4_theta_mean(p, c, noise));
}

GNOMON_CONSTANT(certified4_scale, 137438953472.0); // 2^37

/// The same for moments stored as floats, whose mean of p float arithmetic cannot give: from the mean of the biased
/// moments, in h by hankel4_constant_bias with these settings, which is the weight of the node before z_f or 1 less that of
/// z_f, less what the bias has added. 0 where rounding left h at its floor.
GNOMON_KERNEL Real certified4_constant_bias_lower(GNOMON_T(hankel4) h, GNOMON_T(moments4) noise, GNOMON_SETTING bias2,
                                                  GNOMON_SETTING bias4, GNOMON_SETTING alpha, Real z_f)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real vu = h.variance * u;
    Real slope = vu - h.third;
    Real q = slope * u - h.variance * h.variance;
    // The power of two, a factor of a, b and w, keeps those of a single depth from underflowing.
    Real s = GNOMON_LITERAL(certified4_scale) * q;
    Real n = GNOMON_LITERAL(certified4_scale) * h.determinant;
    Real un = u * n;
    Real e = u * un + q * s;
    Real w = h.variance * n + e;
    Real w2 = w + w;
    Real a = s * h.variance;
    Real a2 = a + a;
    Real b = un + s * (vu + slope);
    Real r = gnomon_sqrt(gnomon_max(Real(0), b * b - a2 * w2));
    GNOMON_MASK between = q < Real(0);
    GNOMON_MASK positive = Real(0) < b;
    // Of two forms of each quotient the one that does not cancel.
    Real outer = r + gnomon_abs(b);
    Real c = gnomon_select(positive, outer, Real(-2) * a) / gnomon_select(positive, w2, outer);
    Real inverse = Real(1) / gnomon_select(between, r + r, outer);
    Real g = a2 * inverse; // k, where a node is on either side
    Real n0 = gnomon_select(between, Real(0), Real(1));
    Real n1 = gnomon_select(between, c - g, g);
    Real n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    Real t0 = gnomon_select(between, Real(0.5) + b * inverse, Real(1));
    Real t1 = gnomon_select(between, g, c);
    certificate4 p = certificate4_about(z, n0, t0, t1, n1, n2);
    Real share = gnomon_select(between, Real(0.5) * (e * (r + b)) - w * (a * u), e);
    Real mean = share / (w * gnomon_select(between, r, Real(1)));
    Real added = alpha * ((p.top - p.s0) - (bias2 * p.s2 + bias4 * p.s4));
    Real doubt = (noise.b1 * gnomon_abs(p.s1) + noise.b2 * gnomon_abs(p.s2)) +
                 (noise.b3 * gnomon_abs(p.s3) + noise.b4 * gnomon_abs(p.s4));
    GNOMON_MASK known = (between || positive) && (GNOMON_PIVOT_FLOOR * h.variance < h.determinant);
    return gnomon_select(known, saturate_or_zero(mean - (added + doubt)), Real(0));
}

/// The most that rounding moves each moment of b: 2 delta of itself, at most delta, at least the share of a denormal.
GNOMON_KERNEL GNOMON_T(moments4) moments4_rounding(GNOMON_T(moments4) b, GNOMON_SETTING delta, GNOMON_SETTING least)
{
    GNOMON_T(moments4) e;
    e.b1 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1)));
    e.b2 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2)));
    e.b3 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3)));
    e.b4 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4)));
    return e;
}

/// The same for roundings before the filter, which the moments of |z| bound: E |z|^3 <= (b2 + b4) / 2.
GNOMON_KERNEL GNOMON_T(moments4) moments4_rounding_filtered(GNOMON_T(moments4) b, GNOMON_SETTING delta,
                                                            GNOMON_SETTING least)
{
    GNOMON_T(moments4) e;
    e.b1 = delta;
    e.b2 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2)));
    e.b3 = gnomon_max(least, gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4)));
    e.b4 = gnomon_max(least, gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4)));
    return e;
}

GNOMON_NAMESPACE_END
#endif
