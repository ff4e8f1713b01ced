// The shadow on a static receiver while the shutter is open, in closed form. Every range in front of the receiver
// occludes it for a time that is known in closed form, and the shutter (shutter.h) turns that time into a share of the
// light: exact, where stochastic shadow maps take samples. Ranges must not overlap in time, as in a resolved list; else
// the overlap counts twice. (Hong & Oh's shadow test, integrated over time; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     for every range of the texel:
//         hidden = static_receiver_occluding_part(state, range);
//         share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                    shutter_piecewise
//         state = static_receiver_add(state, receiver_lost_light(hidden, id, share0, share1));
//     intensity = static_receiver_end(state);
//
// Percentage-closer filtering of K x K bilinear look-ups around texel position (x, y) reads K + 1 texels along either
// axis. With x - K / 2 = column + u, column a whole number and u in [0, 1), and y alike, set the weight of texel
// (column + i, row + j), i and j from 0 to K, before its ranges:
//     state = static_receiver_set_weight(state, texel_weight(u, i, K) * texel_weight(v, j, K));
//
// A list may have a second layer (passes/range/resolve.hpp), for receivers whose own range is in front:
//     front = range_empty(range_nothing);
//     for every range of the texel, in order:
//         if range_is_second_layer(front, range), leave range out unless front.id == id; else front = range
//
// A receiver behind all ranges of a texel, or in front of all, needs no list, only its summary (range_summary.h):
//     if (receiver_is_in_front(z_f, summary) > 0) nothing is added
//     if (static_receiver_is_behind(state, summary) > 0) state = static_receiver_add(state, summary.shadowed);
#ifndef GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#include "../../numerics/texel_filter.h"
#include "../range/range_summary.h"
#include "shutter.h"
GNOMON_NAMESPACE_BEGIN

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
GNOMON_STRUCT(static_receiver) { Real depth, id, begin, end, weight, shadowed; };

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of shutter_exposure_make.
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

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_set_weight(GNOMON_T(static_receiver) state, Real weight)
{
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
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

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
GNOMON_KERNEL Real receiver_lost_light(GNOMON_T(depth_time_range) hidden, Real id, Real share0, Real share1)
{
    return gnomon_select(hidden.id == id, Real(0), saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
GNOMON_KERNEL GNOMON_T(static_receiver) static_receiver_add(GNOMON_T(static_receiver) state, Real lost)
{
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
GNOMON_KERNEL Real receiver_is_in_front(Real z_f, GNOMON_T(range_summary) summary)
{
    return gnomon_select(z_f <= summary.nearest, Real(1), Real(0));
}

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
GNOMON_KERNEL Real static_receiver_is_behind(GNOMON_T(static_receiver) state, GNOMON_T(range_summary) summary)
{
    GNOMON_MASK whole = state.begin <= Real(0) && Real(1) <= state.end;
    GNOMON_MASK own = summary.id == GNOMON_LITERAL(range_mixed) || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, Real(1), Real(0));
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
GNOMON_KERNEL Real static_receiver_end(GNOMON_T(static_receiver) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
