// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);
#ifndef GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#define GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// The receiver's depth, and the weight in front of the receiver so far.
GNOMON_STRUCT(percentage_closer) { Real receiver, shadowed; };

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
GNOMON_KERNEL GNOMON_T(percentage_closer) percentage_closer_begin(Real z_f)
{
    GNOMON_T(percentage_closer) r;
    r.receiver = gnomon_min(Real(1), z_f);
    r.shadowed = Real(0);
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
GNOMON_KERNEL GNOMON_T(percentage_closer) percentage_closer_add(GNOMON_T(percentage_closer) state, Real z,
                                                                GNOMON_SETTING weight)
{
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, Real(0));
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
GNOMON_KERNEL Real percentage_closer_end(GNOMON_T(percentage_closer) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
