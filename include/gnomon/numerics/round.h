// Rounding to whole numbers by addition: 1.5 2^(p - 1) has a step of 1, so the sum rounds and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// The whole number nearest to x, ties to even. Domain: |x| <= 2^22 in float, 2^51 in double; a NaN stays a NaN.
GNOMON_KERNEL Real nearest_integer(Real x)
{
    Real rounder = Real(-12582912);
    if (GNOMON_DIGITS > 24) {
        rounder = Real(-6755399441055744.0);
    }
    return gnomon_difference(x, rounder) + rounder;
}

GNOMON_NAMESPACE_END
#endif
