// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. It is exact for the filter, cannot be
// filtered beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);
#ifndef GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#define GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_STRUCT(percentage_closer) { Real receiver, shadowed; };

/// No texel yet. Any z_f; whatever needs a depth bias takes it off z_f first.
GNOMON_KERNEL GNOMON_T(percentage_closer) percentage_closer_begin(Real z_f)
{
    GNOMON_T(percentage_closer) r;
    r.receiver = z_f;
    r.shadowed = Real(0);
    return r;
}

/// One texel with its filter weight. A NaN depth, of the texel or of the receiver, casts no shadow.
GNOMON_KERNEL GNOMON_T(percentage_closer) percentage_closer_add(GNOMON_T(percentage_closer) state, Real z,
                                                                GNOMON_SETTING weight)
{
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, Real(0));
    return state;
}

/// Shadow intensity in [0, 1], whatever the weights were; a NaN among them gives 0. Error: that of the sum of weights.
GNOMON_KERNEL Real percentage_closer_end(GNOMON_T(percentage_closer) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
