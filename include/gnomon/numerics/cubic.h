// The largest root of a cubic whose three roots are real: a closed form without trigonometry as a start, then Halley's
// iteration.
#ifndef GNOMON_NUMERICS_CUBIC_H
#define GNOMON_NUMERICS_CUBIC_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

// cos(2/3 acos q) on [0, 1], by interpolation in Chebyshev nodes; absolute error 1e-5.
GNOMON_CONSTANT(cubic_cosine0, 0.50000938);
GNOMON_CONSTANT(cubic_cosine1, 0.57684887);
GNOMON_CONSTANT(cubic_cosine2, -0.10666892);
GNOMON_CONSTANT(cubic_cosine3, 0.03862587);
GNOMON_CONSTANT(cubic_cosine4, -0.00882245);

/// One Halley step for a t^3 + b t^2 + c t + d from t.
GNOMON_KERNEL Real cubic_halley(Real a, Real b, Real c, Real d, Real t)
{
    Real f = ((a * t + b) * t + c) * t + d;
    Real s = (Real(3) * (a * t) + Real(2) * b) * t + c;
    Real r = Real(3) * (a * t) + b;
    Real whole = s * s - f * r; // positive but at a multiple root, which is where to stay
    return t - gnomon_select(whole > Real(0), f * s / whole, Real(0));
}

/// The largest root of a t^3 + b t^2 + c t + d, a > 0, three real roots.
GNOMON_KERNEL Real cubic_largest_root(Real a, Real b, Real c, Real d)
{
    Real third = Real(1) / (Real(3) * a);
    Real mean = -b * third;
    Real spread2 = gnomon_max(mean * mean - c * third, Real(0));
    Real spread = gnomon_sqrt(spread2);
    Real f = ((a * mean + b) * mean + c) * mean + d;
    Real cosine = -Real(1.5) * f * third / (spread2 * spread);
    Real q = gnomon_sqrt(gnomon_min(gnomon_max(Real(0.5) + Real(0.5) * cosine, Real(0)), Real(1)));
    Real start = GNOMON_LITERAL(cubic_cosine0) +
                 q * (GNOMON_LITERAL(cubic_cosine1) +
                      q * (GNOMON_LITERAL(cubic_cosine2) +
                           q * (GNOMON_LITERAL(cubic_cosine3) + q * GNOMON_LITERAL(cubic_cosine4))));
    Real t = mean + Real(2) * spread * start;
    t = cubic_halley(a, b, c, d, t);
    if (GNOMON_DIGITS > 24) {
        // Pivots of exact moments in double may vanish; then another root is up to 10^9 times this one, and the start
        // is off by as much. From there a step takes at least two thirds of the distance, until it takes all.
        for (int i = 0; i < 11; ++i) t = cubic_halley(a, b, c, d, t);
    }
    return t;
}

GNOMON_NAMESPACE_END
#endif
