// Algorithm 1 of Peters et al. 2017 as the paper states it, for four and for six moments. This is the comparator that
// hamburger4.h and hamburger6.h are measured against, not a route to use. Both kernels need biased moments (bias.h:
// moments4_add_bias, moments6_add_bias) and keep the steps of the paper:
//
//   1, 2  Solve B q = (1, z_f, ..., z_f^(m/2)) by the square-root-free Cholesky decomposition B = L D L^T (Sec. 5.4.1).
//   3     Solve q_0 + q_1 z + ... = 0 for the other depths: a quadratic, or a cubic in closed form (Blinn 2007;
//         Sec. 5.4.1).
//   4, 5  The weights solve a Vandermonde system. The sum of those before z_f is E[u(z)], where the polynomial u is 1
//         at the depths before z_f and 0 at z_f and behind (Sec. 5.4.2).
//
// Only totality is added: singular moments, such as those of a single depth, give 0, lit, even in shadow.
#ifndef GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H
#define GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H
#include "../moments/moments.h"
#include "../numerics/select.h"
#include "../numerics/trigonometry.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(hamburger_cholesky_third, 0.33333333333333333);
GNOMON_CONSTANT(hamburger_cholesky_sqrt3, 1.7320508075688773);
GNOMON_CONSTANT(hamburger_cholesky_epsilon, 1e-3);

/// The two depths other than z_f, z1 <= z2.
GNOMON_STRUCT(quadratic_nodes) { Real z1, z2; };

/// The two depths of the distribution of three that has one at z_f and four biased moments.
GNOMON_DETAIL_KERNEL GNOMON_T(quadratic_nodes) hamburger4_cholesky_nodes(GNOMON_T(moments4) b, Real z_f)
{
    // Factor B = L D L^T.
    Real inverse1 = Real(1) / (b.b2 - b.b1 * b.b1);
    Real c12 = b.b3 - b.b1 * b.b2;
    Real l21 = c12 * inverse1;
    Real d2 = (b.b4 - b.b2 * b.b2) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    Real y1 = z_f - b.b1;
    Real q2 = ((z_f * z_f - b.b2) - l21 * y1) / d2;
    Real q1 = y1 * inverse1 - l21 * q2;
    Real q0 = Real(1) - (q1 * b.b1 + q2 * b.b2);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    Real inverse_q2 = Real(1) / q2;
    Real centre = Real(-0.5) * (q1 * inverse_q2);
    Real r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    GNOMON_T(quadratic_nodes) n;
    n.z1 = centre - r;
    n.z2 = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node - last)), by
/// Cramer's rule.
GNOMON_DETAIL_KERNEL Real hamburger4_cholesky_weight(GNOMON_T(moments4) b, Real node, Real other, Real last)
{
    return (b.b2 - b.b1 * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
GNOMON_KERNEL Real hamburger4_cholesky_intensity(GNOMON_T(moments4) b, Real z_f)
{
    quadratic_nodes n = hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    GNOMON_MASK both = n.z2 < z_f;
    Real node = gnomon_select(both, z_f, n.z1);
    Real other = gnomon_select(both, n.z1, z_f);
    Real w = hamburger4_cholesky_weight(b, node, other, n.z2);
    return saturate_or_zero(gnomon_select(both, Real(1) - w, gnomon_select(n.z1 < z_f, w, Real(0))));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3, of
/// z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
GNOMON_KERNEL Real hamburger4_cholesky_blocker(GNOMON_T(moments4) b, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    quadratic_nodes n = hamburger4_cholesky_nodes(b, z);
    Real w1 = gnomon_select(n.z1 < z, hamburger4_cholesky_weight(b, n.z1, z, n.z2), Real(0));
    Real w2 = gnomon_select(n.z2 < z, hamburger4_cholesky_weight(b, n.z2, n.z1, z), Real(0));
    Real epsilon = GNOMON_LITERAL(hamburger_cholesky_epsilon);
    Real depth = (epsilon * z + (w1 * n.z1 + w2 * n.z2)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(Real(-1), depth)), z);
}

/// The three real roots of a cubic, in no particular order.
GNOMON_STRUCT(cubic_roots) { Real z1, z2, z3; };

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
GNOMON_DETAIL_KERNEL GNOMON_T(cubic_roots) cubic_roots_blinn(Real c2, Real c1, Real c0)
{
    Real b = c2 * GNOMON_LITERAL(hamburger_cholesky_third);
    Real c = c1 * GNOMON_LITERAL(hamburger_cholesky_third);
    Real hessian1 = c - b * b;
    Real hessian2 = c0 - b * c;
    Real hessian3 = b * c0 - c * c;
    Real discriminant = Real(4) * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    Real d = hessian2 - Real(2) * b * hessian1;
    Real angle = polynomial_atan2(gnomon_sqrt(discriminant), Real(-1) * d);
    cosine_sine t = polynomial_cosine_sine(angle * GNOMON_LITERAL(hamburger_cholesky_third));
    Real radius = gnomon_sqrt(Real(-1) * hessian1);
    Real half_cosine = radius * t.cosine;
    Real half_sine = radius * t.sine * GNOMON_LITERAL(hamburger_cholesky_sqrt3);
    GNOMON_T(cubic_roots) roots;
    roots.z1 = Real(2) * half_cosine - b;
    roots.z2 = (half_sine - half_cosine) - b;
    roots.z3 = Real(-1) * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
GNOMON_KERNEL Real hamburger6_cholesky_intensity(GNOMON_T(moments6) b, Real z_f)
{
    // Factor B = L D L^T.
    Real inverse1 = Real(1) / (b.b2 - b.b1 * b.b1);
    Real c12 = b.b3 - b.b1 * b.b2;
    Real c13 = b.b4 - b.b1 * b.b3;
    Real l21 = c12 * inverse1;
    Real l31 = c13 * inverse1;
    Real inverse2 = Real(1) / ((b.b4 - b.b2 * b.b2) - l21 * c12);
    Real c23 = (b.b5 - b.b2 * b.b3) - l21 * c13;
    Real l32 = c23 * inverse2;
    Real d3 = ((b.b6 - b.b3 * b.b3) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    Real z_f2 = z_f * z_f;
    Real y1 = z_f - b.b1;
    Real y2 = (z_f2 - b.b2) - l21 * y1;
    Real y3 = ((z_f2 * z_f - b.b3) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    Real q3 = y3 / d3;
    Real q2 = y2 * inverse2 - l32 * q3;
    Real q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    Real q0 = Real(1) - (q1 * b.b1 + q2 * b.b2 + q3 * b.b3);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    Real inverse_q3 = Real(1) / q3;
    cubic_roots z = cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    Real v1 = gnomon_select(z.z1 < z_f, Real(1), Real(0));
    Real v2 = gnomon_select(z.z2 < z_f, Real(1), Real(0));
    Real v3 = gnomon_select(z.z3 < z_f, Real(1), Real(0));
    Real v01 = v1 / (z.z1 - z_f);
    Real v12 = (v2 - v1) / (z.z2 - z.z1);
    Real v23 = (v3 - v2) / (z.z3 - z.z2);
    Real v012 = (v12 - v01) / (z.z2 - z_f);
    Real v123 = (v23 - v12) / (z.z3 - z.z1);
    Real v0123 = (v123 - v012) / (z.z3 - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    Real s0 = v012 - v0123 * z.z2;
    Real t1 = s0 - v0123 * z.z1;
    Real t0 = v01 - s0 * z.z1;
    Real u2 = t1 - v0123 * z_f;
    Real u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3 + u2 * b.b2) + u1 * b.b1) - t0 * z_f);
}

GNOMON_NAMESPACE_END
#endif
