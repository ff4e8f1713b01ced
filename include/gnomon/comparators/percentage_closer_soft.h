// Percentage-closer soft shadows (Fernando 2005; Peters et al. 2017, Sec. 4.1): the mean depth of what is in front of the
// receiver, from every texel of a search region. This is what the blocker search by moments (soft/blocker.h) estimates.
//
//     search = percentage_closer_search_begin(z_f);
//     search = percentage_closer_search_add(search, z, weight);     for every texel of the search region, weights summing to 1
//     blocker = percentage_closer_search_end(search);
//     width = the width of the penumbra (soft/penumbra.h) for z_f and blocker.depth
//     intensity = percentage_closer_begin, _add, _end (filters/percentage_closer.h) over a filter region of this width
//
// An intensity of 0 or 1 of the whole search region spares the filter region.
#ifndef GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H
#define GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(percentage_closer_search_epsilon, 1e-3);

/// The receiver's depth, the weight in front of the receiver so far, and the sum of its weighted distances to the receiver.
GNOMON_STRUCT(percentage_closer_search) { Real receiver, shadowed, distance; };

/// The mean depth of the blockers, in [-1, 1] and at most z_f, and their weight in the search region, in [0, 1].
GNOMON_STRUCT(percentage_closer_blocker) { Real depth, intensity; };

/// The state before the first texel of the search region. z_f has no bias.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: no blocker.
GNOMON_KERNEL GNOMON_T(percentage_closer_search) percentage_closer_search_begin(Real z_f)
{
    GNOMON_T(percentage_closer_search) r;
    r.receiver = clamp_or_nan(z_f, Real(-1), Real(1));
    r.shadowed = Real(0);
    r.distance = Real(0);
    return r;
}

/// The state after one more texel of depth z with its weight.
/// Domain: any z; below the near plane as on it.
/// NaN: a texel of depth NaN is no blocker; a weight of NaN before the receiver leaves no blocker at all.
GNOMON_KERNEL GNOMON_T(percentage_closer_search) percentage_closer_search_add(GNOMON_T(percentage_closer_search) state,
                                                                              Real z, GNOMON_SETTING weight)
{
    GNOMON_MASK in_front = z < state.receiver;
    Real distance = state.receiver - gnomon_max(z, Real(-1));
    state.shadowed = state.shadowed + gnomon_select(in_front, weight, Real(0));
    state.distance = state.distance + gnomon_select(in_front, weight * distance, Real(0));
    return state;
}

/// Mean depth and weight of the blockers. The mean is moved towards the receiver by a weight of 1e-3, so that few blockers
/// count for less and none leaves the receiver's own depth.
/// NaN: for z_f the far plane; for a weight before the receiver the receiver's depth, and an intensity of 0.
/// Error: that of the sums of weights and of weighted distances.
/// Source: Peters 2017, Eq. 4; Fernando 2005
GNOMON_KERNEL GNOMON_T(percentage_closer_blocker) percentage_closer_search_end(GNOMON_T(percentage_closer_search) state)
{
    Real weight = state.shadowed + GNOMON_LITERAL(percentage_closer_search_epsilon);
    Real receiver = clamp_or_high(state.receiver, Real(-1), Real(1));
    GNOMON_T(percentage_closer_blocker) r;
    Real depth = gnomon_max(Real(-1), gnomon_min(receiver - state.distance / weight, receiver));
    // Clang 14 makes one clamp, which lets a NaN pass, of this one and of that at the beginning.
    r.depth = gnomon_select(state.receiver == state.receiver, depth, Real(1));
    r.intensity = saturate_or_zero(state.shadowed);
    return r;
}

GNOMON_NAMESPACE_END
#endif
