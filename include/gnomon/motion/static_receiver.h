// The shadow that falls on a receiver at rest while the shutter is open: every range in front of it hides it for a time
// that is known in closed form, and the shutter says what that time is worth. Exact, where stochastic shadow maps
// sample. Ranges must not overlap in time, as those of a resolved list do not: else a time counts more than once.
// (Hong & Oh's shadow test, integrated; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     state = static_receiver_add_box(state, range);        or _add_tent; for every range of the texel
//     intensity = static_receiver_end(state);
#ifndef GNOMON_MOTION_STATIC_RECEIVER_H
#define GNOMON_MOTION_STATIC_RECEIVER_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// Depth and id of the receiver, when the shutter opens and closes, and the share of its light that is gone so far.
GNOMON_STRUCT static_receiver { Real depth, id, begin, end, shadowed; };

/// No range yet. Any z_f; whatever needs a depth bias takes it off z_f first.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_begin(Real z_f, Real id, Real begin, Real end)
{
    GNOMON_T(static_receiver) r;
    r.depth = z_f;
    r.id = id;
    r.begin = begin;
    r.end = end;
    r.shadowed = Real(0);
    return r;
}

/// Adds a share of light, if it is not negative, NaN or the surface's own doing.
GNOMON_KERNEL GNOMON_T(static_receiver)
    static_receiver_lose(GNOMON_T(static_receiver) state, GNOMON_T(depth_time_range) hidden, Real share)
{
    state.shadowed = state.shadowed + gnomon_select(hidden.id == state.id, Real(0), saturate_or_zero(share));
    return state;
}

/// One range, for a shutter that opens and closes at once.
GNOMON_KERNEL GNOMON_T(static_receiver)
    static_receiver_add_box(GNOMON_T(static_receiver) state, GNOMON_T(depth_time_range) r)
{
    GNOMON_T(depth_time_range) hidden = range_in_front(r, state.depth);
    Real share = shutter_box(hidden.t1, state.begin, state.end) - shutter_box(hidden.t0, state.begin, state.end);
    return static_receiver_lose(state, hidden, share);
}

/// One range, for a shutter that opens and closes evenly.
GNOMON_KERNEL GNOMON_T(static_receiver)
    static_receiver_add_tent(GNOMON_T(static_receiver) state, GNOMON_T(depth_time_range) r)
{
    GNOMON_T(depth_time_range) hidden = range_in_front(r, state.depth);
    Real share = shutter_tent(hidden.t1, state.begin, state.end) - shutter_tent(hidden.t0, state.begin, state.end);
    return static_receiver_lose(state, hidden, share);
}

/// Shadow intensity in [0, 1] over the whole shutter. A NaN hides nothing. Error for each range 8 2^-p; for one that
/// meets the receiver's depth (6 z / d + 14) 2^-p over the duration of the shutter, z the largest depth, the receiver's
/// included, and d how far its own changes. Twice that for a tent.
GNOMON_KERNEL Real static_receiver_end(GNOMON_T(static_receiver) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
