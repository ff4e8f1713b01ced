// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H
#include "round.h"
#include "select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(texel_limit, 65536.0); // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
GNOMON_KERNEL Real texel_below(Real x)
{
    Real limit = GNOMON_LITERAL(texel_limit);
    Real inside = gnomon_max(gnomon_min(x, limit), Real(-1) * limit);
    Real whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, Real(1), Real(0));
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
GNOMON_KERNEL Real texel_weight(Real u, GNOMON_SETTING i, GNOMON_SETTING look_ups)
{
    Real share = saturate_or_zero(u);
    share = gnomon_select(i < Real(1), Real(1) - share, gnomon_select(i < look_ups, Real(1), share));
    return saturate_or_zero(share / look_ups);
}

GNOMON_NAMESPACE_END
#endif
