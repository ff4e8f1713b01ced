// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
GNOMON_KERNEL Real clamp_or_nan(Real x, GNOMON_SETTING low, GNOMON_SETTING high)
{
    return gnomon_min(high, gnomon_max(low, x));
}

/// x clamped to [low, high].
/// NaN: high.
GNOMON_KERNEL Real clamp_or_high(Real x, GNOMON_SETTING low, GNOMON_SETTING high)
{
    return gnomon_max(low, gnomon_min(x, high));
}

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
GNOMON_KERNEL Real saturate_or_zero(Real x) { return gnomon_saturate(x); }

GNOMON_NAMESPACE_END
#endif
