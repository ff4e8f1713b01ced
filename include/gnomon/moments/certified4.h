// Shadow intensity from four stored moments, certified: never above Z(z < z_f), for any errors of storage within
// the stated noise.
//
// A quartic p with p <= 1 before z_f and p <= 0 from z_f on has E[p] <= Z(z < z_f) for every distribution Z. Storage
// moves channel k by at most noise_k, so E[p] is at least its value from the stored channels minus
// sum_k noise_k |p_k|, where p_k is the coefficient at channel k. That bound holds for every such p. A p with its nodes
// at those of the biased moments (hamburger4.h) is nearly the best (docs/decisions/2-bias.md).
//
// In y = z - z_f, and in the notation of hamburger4.h, the two nodes beside z_f are the roots of a y^2 + b y + w with
//     a = Q V,    b = u N + Q (2 V u - G),    w = V N + u^2 N + Q^2,    r^2 = b^2 - 4 a w.
// Of the nodes before z_f the nearer one is at y = -1 / c with c = (b + r) / (2 w). The certificate is
//     Q < 0, one node on either side:    p = -(1 + d + k y)^2 (2 (c - k) y + c (c - 2 k) y^2)
//     Q >= 0 and b > 0, both before:     p = 1 - (1 + c y)^2 (1 + g y)^2
//     otherwise, none before:            no p, and the bound is 0
// with d = b / (2 r) - 1/2, k = c d and g = (b - r) / (2 w). Both p are 1 at the nodes before z_f, and 0 at z_f and at
// the nodes behind. Any other c >= 0, d in [-1, 0] and g >= 0 give a valid p as well, so rounding in the nodes costs
// only some leaking.
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H
#include "../numerics/select.h"
#include "hankel4.h"
#include "quantization.h"
GNOMON_NAMESPACE_BEGIN

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
GNOMON_STRUCT(certificate4) { Real top, s0, s1, s2, s3, s4; };

GNOMON_CONSTANT(certificate4_nothing, -1267650600228229401496703205376.0); // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
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

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
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

/// The coefficients of p at the channels of theta4, with the sign of s: the transpose of theta4_inverse times those at the
/// moments.
GNOMON_DETAIL_KERNEL GNOMON_T(channels4) certificate4_theta(GNOMON_T(certificate4) p)
{
    Real third = Real(0.75) * p.s3;
    GNOMON_T(channels4) r;
    r.c1 = GNOMON_LITERAL(theta4_inverse11) * p.s1 - third;
    r.c2 = Real(0.125) * (p.s2 - p.s4);
    r.c3 = GNOMON_LITERAL(theta4_inverse13) * (p.s1 + third);
    r.c4 = p.s2 + p.s4;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
GNOMON_DETAIL_KERNEL Real certificate4_theta_doubt(GNOMON_T(channels4) t, GNOMON_SETTING noise)
{
    return noise * ((gnomon_abs(t.c1) + gnomon_abs(t.c2)) + (gnomon_abs(t.c3) + gnomon_abs(t.c4)));
}

/// The least possible value of E[p], given channels c of theta4 that are each off by at most noise.
GNOMON_DETAIL_KERNEL Real certificate4_theta_mean(GNOMON_T(certificate4) p, GNOMON_T(channels4) c, GNOMON_SETTING noise)
{
    channels4 t = certificate4_theta(p);
    Real mean = (p.s0 + (t.c2 * c.c2 + t.c4 * c.c4)) + (t.c1 * (c.c1 - Real(0.5)) + t.c3 * (c.c3 - Real(0.5)));
    return p.top - (mean + certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4 that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
GNOMON_KERNEL Real certified4_theta_lower(GNOMON_T(hankel4) h, GNOMON_T(channels4) c, GNOMON_SETTING noise, Real z_f)
{
    certificate4 p = certificate4_make(h, clamp_or_nan(z_f, Real(-1), Real(1)));
    return saturate_or_zero(certificate4_theta_mean(p, c, noise));
}

GNOMON_CONSTANT(certified4_scale, 137438953472.0); // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
GNOMON_STRUCT(certified4_mean)
{
    GNOMON_T(certificate4) p;
    Real mean, added, known;
};

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float arithmetic
/// cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of the node
/// before z, or 1 minus the weight of z.
GNOMON_DETAIL_KERNEL GNOMON_T(certified4_mean) certified4_constant_bias_mean(GNOMON_T(hankel4) h, GNOMON_SETTING bias2,
                                                                             GNOMON_SETTING bias4, GNOMON_SETTING alpha,
                                                                             Real z)
{
    Real u = z - h.mean;
    Real vu = h.variance * u;
    Real slope = vu - h.third;
    Real q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
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
    // Each quotient in the form that does not cancel.
    Real outer = r + gnomon_abs(b);
    Real c = gnomon_select(positive, outer, Real(-2) * a) / gnomon_select(positive, w2, outer);
    Real inverse = Real(1) / gnomon_select(between, r + r, outer);
    Real g = a2 * inverse; // k if one node is on either side
    Real n0 = gnomon_select(between, Real(0), Real(1));
    Real n1 = gnomon_select(between, c - g, g);
    Real n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    Real t0 = gnomon_select(between, Real(0.5) + b * inverse, Real(1));
    Real t1 = gnomon_select(between, g, c);
    GNOMON_T(certified4_mean) m;
    m.p = certificate4_about(z, n0, t0, t1, n1, n2);
    Real share = gnomon_select(between, Real(0.5) * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, Real(1)));
    m.added = alpha * ((m.p.top - m.p.s0) - (bias2 * m.p.s2 + bias4 * m.p.s4));
    m.known =
        gnomon_select((between || positive) && (GNOMON_PIVOT_FLOOR * h.variance < h.determinant), Real(1), Real(0));
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
GNOMON_DETAIL_KERNEL Real certified4_constant_bias_intensity(GNOMON_T(certified4_mean) m, Real doubt)
{
    return gnomon_select(Real(0) < m.known, saturate_or_zero(m.mean - (m.added + doubt)), Real(0));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
GNOMON_KERNEL Real certified4_constant_bias_lower(GNOMON_T(hankel4) h, GNOMON_T(moments4) noise, GNOMON_SETTING bias2,
                                                  GNOMON_SETTING bias4, GNOMON_SETTING alpha, Real z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, Real(-1), Real(1)));
    Real doubt = (noise.b1 * gnomon_abs(m.p.s1) + noise.b2 * gnomon_abs(m.p.s2)) +
                 (noise.b3 * gnomon_abs(m.p.s3) + noise.b4 * gnomon_abs(m.p.s4));
    return certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4 with more than 16 bits, each off
/// by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
GNOMON_KERNEL Real certified4_theta_constant_bias_lower(GNOMON_T(hankel4) h, GNOMON_SETTING noise, GNOMON_SETTING bias2,
                                                        GNOMON_SETTING bias4, GNOMON_SETTING alpha, Real z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, Real(-1), Real(1)));
    return certified4_constant_bias_intensity(m, certificate4_theta_doubt(certificate4_theta(m.p), noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
GNOMON_KERNEL GNOMON_T(moments4) moments4_rounding(GNOMON_T(moments4) b, GNOMON_SETTING delta)
{
    GNOMON_T(moments4) e;
    e.b1 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1));
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
GNOMON_KERNEL GNOMON_T(moments4) moments4_rounding_filtered(GNOMON_T(moments4) b, GNOMON_SETTING delta)
{
    GNOMON_T(moments4) e;
    e.b1 = delta;
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

GNOMON_NAMESPACE_END
#endif
