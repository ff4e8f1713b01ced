// The lower envelope of a list of ranges of any length, span by span: what the light sees of a texel from one time to
// another (Gribel et al. 2010; the resolve of Palmer 2011, 2.4). The caller owns both loops over the list, so that lists
// of any length can be resolved where no sorted structure is at hand, such as in a compute shader.
//
//     for (t = 0; t < 1; t = span.t1) {
//         state = range_front_begin(t);
//         for every range: state = range_front_compare(state, range);
//         for every range: state = range_front_limit(state, range);
//         span = range_front_span(state);
//     }
//
// Spans are contiguous. One with the id range_nothing has no range and may be left out of a resolved list. The ranges of
// the list overlap in time as they please; their order matters only where three of them meet within rounding.
#ifndef GNOMON_MOTION_RANGE_RANGE_FRONT_H
#define GNOMON_MOTION_RANGE_RANGE_FRONT_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the same
/// results, and up to the time `end` no range passes in front of it.
GNOMON_STRUCT(range_front)
{
    GNOMON_T(depth_time_range) nearest;
    Real begin, unchanged, end;
};

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_canonical(GNOMON_T(depth_time_range) r)
{
    r.id = gnomon_max(r.id, GNOMON_LITERAL(range_mixed));
    GNOMON_MASK known = gnomon_abs(r.z0) + gnomon_abs(r.z1) < GNOMON_LITERAL(range_far);
    return range_keep_if(Real(0) <= r.t0 && r.t0 < r.t1 && r.t1 <= Real(1) && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
GNOMON_KERNEL GNOMON_T(range_front) range_front_begin(Real t)
{
    GNOMON_T(range_front) state;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(GNOMON_LITERAL(range_nothing));
    state.unchanged = Real(1);
    state.end = Real(1);
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
GNOMON_KERNEL GNOMON_T(range_front) range_front_compare(GNOMON_T(range_front) state, GNOMON_T(depth_time_range) r)
{
    r = range_canonical(r);
    depth_time_range front = state.nearest;
    depth_time_range ahead = range_visible_part(r, front);
    GNOMON_MASK during = r.t0 <= state.begin && state.begin < r.t1;
    GNOMON_MASK alone = front.t1 <= front.t0;
    GNOMON_MASK nearer = ahead.t0 <= state.begin && state.begin < ahead.t1;
    Real change = gnomon_select(state.begin < ahead.t0, ahead.t0, gnomon_select(nearer, ahead.t1, Real(1)));
    change = gnomon_min(change, gnomon_min(front.t1, r.t1));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
GNOMON_KERNEL GNOMON_T(range_front) range_front_limit(GNOMON_T(range_front) state, GNOMON_T(depth_time_range) r)
{
    r = range_canonical(r);
    depth_time_range ahead = range_visible_part(r, state.nearest);
    GNOMON_MASK some = state.nearest.t0 < state.nearest.t1;
    Real next = gnomon_select(some, ahead.t0, r.t0);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons do.
    GNOMON_MASK circle = ahead.t0 <= state.begin && state.begin < ahead.t1;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
GNOMON_KERNEL GNOMON_T(depth_time_range) range_front_span(GNOMON_T(range_front) state)
{
    GNOMON_MASK some = state.nearest.t0 < state.nearest.t1;
    Real end = gnomon_min(gnomon_select(some, state.nearest.t1, Real(1)), state.end);
    GNOMON_T(depth_time_range) span = range_clip(state.nearest, state.begin, end);
    span.t0 = state.begin;
    span.t1 = end;
    return span;
}

GNOMON_NAMESPACE_END
#endif
