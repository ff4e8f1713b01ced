// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.
#ifndef GNOMON_NUMERICS_CUBIC_H
#define GNOMON_NUMERICS_CUBIC_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
GNOMON_CONSTANT(cubic_cosine0, 0.50000938);
GNOMON_CONSTANT(cubic_cosine1, 0.57684887);
GNOMON_CONSTANT(cubic_cosine2, -0.10666892);
GNOMON_CONSTANT(cubic_cosine3, 0.03862587);
GNOMON_CONSTANT(cubic_cosine4, -0.00882245);
GNOMON_CONSTANT(cubic_minus_third, -0.33333333333333331);

/// The result of a Halley step as a fraction, whose denominator is positive.
GNOMON_STRUCT(cubic_step) { Real numerator, denominator; };

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
GNOMON_DETAIL_KERNEL GNOMON_T(cubic_step) cubic_halley_step(Real b, Real c, Real d, Real t)
{
    Real tb = t + b;
    Real f = tb * (t * t) + (c * t + d);
    Real s = (tb + (tb + t)) * t + c;
    Real r = (t + t) + tb;
    Real whole = s * s - f * r; // positive except at a multiple root
    GNOMON_MASK simple = whole > Real(0);
    GNOMON_T(cubic_step) x;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, Real(1));
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
GNOMON_DETAIL_KERNEL Real cubic_halley(Real b, Real c, Real d, Real t)
{
    cubic_step x = cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
GNOMON_DETAIL_KERNEL Real cubic_start(Real b, Real c, Real d)
{
    Real mean = GNOMON_LITERAL(cubic_minus_third) * b;
    Real mean2 = mean * mean;
    Real spread2 = gnomon_max(mean2 + GNOMON_LITERAL(cubic_minus_third) * c, Real(0));
    Real spread = gnomon_sqrt(spread2);
    Real g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    Real inverse = Real(1) / spread2;
    Real cosine = (g * inverse) * (spread * inverse);
    Real q2 = gnomon_min(gnomon_max(Real(0.5) + Real(0.25) * cosine, Real(0)), Real(1));
    Real q = gnomon_sqrt(q2);
    Real start =
        (GNOMON_LITERAL(cubic_cosine0) + q * GNOMON_LITERAL(cubic_cosine1)) +
        q2 * ((GNOMON_LITERAL(cubic_cosine2) + q * GNOMON_LITERAL(cubic_cosine3)) + q2 * GNOMON_LITERAL(cubic_cosine4));
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
GNOMON_DETAIL_KERNEL GNOMON_T(cubic_step) cubic_positive_root(Real b, Real c, Real d)
{
    Real t = cubic_start(b, c, d);
    if (GNOMON_DIGITS > 24) {
        // The start is off by 1e-5 of the distance to the farthest root, which may be 10^9 times the wanted root. The
        // quadratic a t^2 + c t + d, with a = b + t taken as constant, has the same root. a is minus the sum of the
        // other two roots, so its relative error is 1e-5.
        Real a = b + t;
        Real r = gnomon_sqrt(gnomon_max(c * c - Real(4) * (a * d), Real(0)));
        GNOMON_MASK rises = c > Real(0);
        Real near_zero = gnomon_select(rises, Real(-2) * d, r - c) / gnomon_select(rises, c + r, a + a);
        t = gnomon_select(a > t, near_zero, t);
        t = cubic_halley(b, c, d, t);
    }
    return cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
GNOMON_KERNEL Real cubic_largest_root(Real b, Real c, Real d)
{
    cubic_step x = cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
}

GNOMON_NAMESPACE_END
#endif
