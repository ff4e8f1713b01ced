// Texels and the weights of a tent filter on them: which texel a position is in, and how much each of K + 1 texels in a
// row counts in the mean of K adjacent bilinear look-ups.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H
#include "round.h"
#include "select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(texel_limit, 65536.0); // no map is larger: what is beyond is one texel

/// The texel that a position is in, the largest whole number up to it, limited to +-65536; 65536 for NaN.
GNOMON_KERNEL Real texel_below(Real x)
{
    Real limit = GNOMON_LITERAL(texel_limit);
    Real inside = gnomon_max(gnomon_min(x, limit), Real(-1) * limit);
    Real whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, Real(1), Real(0));
}

/// What texel i of K + 1 weighs, along one axis, in the mean of K bilinear look-ups side by side: u is the first one's
/// distance from the centre of texel 0. In [0, 1]; over the K + 1 texels they sum to 1, within K + 2 roundings.
GNOMON_KERNEL Real texel_weight(Real u, GNOMON_SETTING i, GNOMON_SETTING look_ups)
{
    Real share = saturate_or_zero(u);
    share = gnomon_select(i < Real(1), Real(1) - share, gnomon_select(i < look_ups, Real(1), share));
    return saturate_or_zero(share / look_ups);
}

GNOMON_NAMESPACE_END
#endif
