// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// The two roots, in no particular order.
GNOMON_STRUCT(quadratic_result) { Real first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
GNOMON_KERNEL GNOMON_T(quadratic_result) quadratic_roots(Real a, Real b, Real c)
{
    Real r = gnomon_sqrt(gnomon_max(b * b - a * c, Real(0)));
    Real t = gnomon_select(b > Real(0), -(b + r), r - b);
    GNOMON_T(quadratic_result) x;
    x.first = t / a;
    x.second = c / t;
    return x;
}

GNOMON_NAMESPACE_END
#endif
