// Choices that stay total: what a clamp makes of a NaN is decided here, not by a language's built-in.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// x limited to [low, high]; a NaN stays a NaN, so that it can reach the end of a kernel and be answered there.
GNOMON_KERNEL Real clamp_or_nan(Real x, GNOMON_SETTING low, GNOMON_SETTING high)
{
    return gnomon_min(high, gnomon_max(low, x));
}

/// x limited to [0, 1]; a NaN becomes 0: the last step of every kernel that returns an intensity, 0 = lit.
GNOMON_KERNEL Real saturate_or_zero(Real x) { return gnomon_min(Real(1), gnomon_max(x, Real(0))); }

GNOMON_NAMESPACE_END
#endif
