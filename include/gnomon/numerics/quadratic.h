// Roots of a x^2 + 2 b x + c without cancellation: one from the sum of like signs, the other from the product of both.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_STRUCT(quadratic_result) { Real first, second; };

/// Both roots, in no order; complex ones are taken for their common real part. Max error: 4 ulp where a c <= b^2 / 2,
/// by as many roundings. A vanishing a sends one to infinity; all zero gives NaN. Overflow and underflow of b^2 and a c
/// are the caller's to prevent.
GNOMON_KERNEL GNOMON_T(quadratic_result) quadratic_roots(Real a, Real b, Real c)
{
    Real r = gnomon_sqrt(gnomon_max(b * b - a * c, Real(0)));
    Real t = gnomon_select(b > Real(0), -(b + r), r - b);
    GNOMON_T(quadratic_result) x;
    x.first = t / a;
    x.second = c / t;
    return x;
}

/// The negative root where a < 0 < c, so that one is on either side of 0: one division, and nothing cancels. Max
/// error: 4 ulp, by as many roundings.
GNOMON_KERNEL Real quadratic_negative_root(Real a, Real b, Real c)
{
    Real r = gnomon_sqrt(b * b - a * c);
    GNOMON_MASK falls = b > Real(0);
    return gnomon_select(falls, Real(-1) * c, r - b) / gnomon_select(falls, b + r, a);
}

GNOMON_NAMESPACE_END
#endif
