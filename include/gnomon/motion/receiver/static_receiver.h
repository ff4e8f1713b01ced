// The shadow that falls on a receiver at rest while the shutter is open: every range in front of it hides it for a time
// that is known in closed form, and the shutter says what that time is worth. Exact, where stochastic shadow maps
// sample. Ranges must not overlap in time, as those of a resolved list do not: else a time counts more than once.
// (Hong & Oh's shadow test, integrated; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     state = static_receiver_add_box(state, range);        or _add_tent, _add_given; for every range of the texel
//     intensity = static_receiver_end(state);
//
// Percentage-closer filtering of K x K bilinear look-ups around texel position (x, y) reads K + 1 texels along either
// axis. With x - K / 2 = column + u, column a whole number and u in [0, 1), before the ranges of texel (column + i,
// row + j), i and j from 0 to K:
//     state = static_receiver_set_weight(state, texel_weight(u, i, K) * texel_weight(v, j, K));
//
// A list may have a second layer (passes/range/resolve.hpp), for receivers whose own range is in front:
//     front = range_empty(range_nothing);
//     for every range of the texel, in order: if range_is_second_layer(front, range), leave it out unless front.id ==
//     id; else front = range
//
// Most receivers are behind all ranges of a texel, above all where its backdrop is left out (passes/range/resolve.hpp),
// or in front of all. They need no list, only its total, four numbers a texel:
//     total = range_summary_begin(-1);   total = range_summary_add(total, range);        for every range of the texel
//     if (receiver_is_in_front(z_f, total) > 0) nothing is added
//     if (static_receiver_is_behind(state, total) > 0) state = static_receiver_add_summary(state, total);
#ifndef GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#include "../../numerics/texel_filter.h"
#include "../range/range_summary.h"
#include "shutter.h"
GNOMON_NAMESPACE_BEGIN

/// Depth and id of the receiver, when the shutter opens and closes, what the next ranges weigh, and the share of its
/// light that is gone so far.
GNOMON_STRUCT(static_receiver) { Real depth, id, begin, end, weight, shadowed; };

/// No range yet. Any z_f; whatever needs a depth bias takes it off z_f first. From begin to end as of
/// shutter_exposure_make: in any order, and what is there at a moment where they are the same.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_begin(Real z_f, Real id, Real begin, Real end)
{
    shutter_exposure open = shutter_exposure_make(begin, end);
    GNOMON_T(static_receiver) r;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = Real(1);
    r.shadowed = Real(0);
    return r;
}

/// The weight of the ranges to come, in [0, 1]; those of all texels sum to 1.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_set_weight(GNOMON_T(static_receiver) state, Real weight)
{
    state.weight = saturate_or_zero(weight);
    return state;
}

/// When the range hides it while the shutter is open.
GNOMON_KERNEL GNOMON_T(depth_time_range) static_receiver_occluding_part(GNOMON_T(static_receiver) state,
                                                                        GNOMON_T(depth_time_range) r)
{
    GNOMON_T(depth_time_range) level;
    level.t0 = state.begin;
    level.t1 = state.end;
    level.z0 = state.depth;
    level.z1 = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// The light lost between two shares of what the shutter lets in, where the range that hides it has another id; 0 for
/// NaN.
GNOMON_KERNEL Real receiver_lost_light(GNOMON_T(depth_time_range) hidden, Real id, Real share0, Real share1)
{
    return gnomon_select(hidden.id == id, Real(0), saturate_or_zero(share1 - share0));
}

/// One range, for a shutter that opens and closes at once.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_add_box(GNOMON_T(static_receiver) state,
                                                                GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = static_receiver_occluding_part(state, r);
    Real share0 = shutter_box(hidden.t0, state.begin, state.end);
    Real share1 = shutter_box(hidden.t1, state.begin, state.end);
    state.shadowed = state.shadowed + state.weight * receiver_lost_light(hidden, state.id, share0, share1);
    return state;
}

/// One range, for a shutter that opens and closes evenly.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_add_tent(GNOMON_T(static_receiver) state,
                                                                 GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = static_receiver_occluding_part(state, r);
    Real share0 = shutter_tent(hidden.t0, state.begin, state.end);
    Real share1 = shutter_tent(hidden.t1, state.begin, state.end);
    state.shadowed = state.shadowed + state.weight * receiver_lost_light(hidden, state.id, share0, share1);
    return state;
}

/// One range, for a shutter with given weights.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_add_piecewise(GNOMON_T(static_receiver) state,
                                                                      GNOMON_T(depth_time_range) r,
                                                                      GNOMON_T(shutter_weights) w)
{
    depth_time_range hidden = static_receiver_occluding_part(state, r);
    Real share0 = shutter_piecewise(hidden.t0, state.begin, state.end, w);
    Real share1 = shutter_piecewise(hidden.t1, state.begin, state.end, w);
    state.shadowed = state.shadowed + state.weight * receiver_lost_light(hidden, state.id, share0, share1);
    return state;
}

/// 1 where no range is in front of depth z_f, as of a receiver, or of both ends of its course: nothing is lost.
GNOMON_KERNEL Real receiver_is_in_front(Real z_f, GNOMON_T(range_summary) total)
{
    return gnomon_select(z_f <= total.nearest, Real(1), Real(0));
}

/// 1 where the total is all that the receiver needs: it is behind all ranges, exposed from 0 to 1, and none of them can
/// be its own.
GNOMON_KERNEL Real static_receiver_is_behind(GNOMON_T(static_receiver) state, GNOMON_T(range_summary) total)
{
    GNOMON_MASK whole = state.begin <= Real(0) && Real(1) <= state.end;
    GNOMON_MASK own = total.id == GNOMON_LITERAL(range_mixed) || total.id == state.id;
    return gnomon_select(whole && total.farthest < state.depth && !own, Real(1), Real(0));
}

/// All ranges at once. Error: 4 2^-p for each of them.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_add_summary(GNOMON_T(static_receiver) state,
                                                                    GNOMON_T(range_summary) total)
{
    state.shadowed = state.shadowed + state.weight * total.shadowed;
    return state;
}

/// Shadow intensity in [0, 1] over the whole shutter. A NaN hides nothing. Error for each range: its weight times the
/// largest response (1 for a box, 2 for a tent, 8 times the largest given weight) times 32 2^-p and the time for which
/// the range is within 26 z 2^-p of the receiver (range_occluding_part), over the duration of the shutter.
GNOMON_KERNEL Real static_receiver_end(GNOMON_T(static_receiver) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
