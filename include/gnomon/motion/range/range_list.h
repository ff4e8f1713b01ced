// Lists of a few depth-time ranges, one list for a texel: the surfaces that pass the texel while the shutter is open
// (Gribel et al. 2010; Hong & Oh 2017), and the lower envelope of the list, which is visible from the light at each
// time (the resolve of Palmer 2011, 2.4).
//
//     list = range_list_make(range);                  list = range_list_insert(list, range) for every other range
//     intensity = range_list_intensity(list, t, z, id, bias);    shadow test at one time
//     resolved = range_list_resolve(list);                       lower envelope, for receivers in closed form
//     for (t = 0; t < 1; t = span.t1) span = range_list_front(list, t);    the same, span by span
//
// A list stores inserted ranges unchanged and drops those that another range provably occludes (range_occludes). Until
// the list overflows, neither its contents nor its resolved form depend on the order of insertion or on rounding. On
// overflow it first drops ranges that several others jointly occlude. If there is still no room, it merges the two most
// similar ranges into one in front of both (range_merge.h): shadows stay, and the shadow that merging adds is counted.
//
// Occluded ranges are dropped regardless of their ids. So a receiver gets the answer of all ranges, unless a range of
// its own id lies in front of it by more than its bias: that range does not shadow the receiver, and ranges that it
// occluded are no longer in the list. Hence one id should be a surface none of whose points is ever behind another: a
// triangle, a plane, the lit side of a convex part. With one id for a whole object, its far sides lose the shadows that
// other objects cast on them.
//
// The capacity is GNOMON_RANGE_CAPACITY, if defined before inclusion, else 8. In C++ the capacity is a template
// parameter with this default.
#ifndef GNOMON_MOTION_RANGE_RANGE_LIST_H
#define GNOMON_MOTION_RANGE_RANGE_LIST_H
#include "range_front.h"
#include "range_merge.h"
GNOMON_NAMESPACE_BEGIN

#ifndef GNOMON_RANGE_CAPACITY
#define GNOMON_RANGE_CAPACITY 8
#endif

/// Ranges in the order of range_less, with empty ranges between them, and upper bounds of the cost of merging: except
/// for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
GNOMON_LIST_STRUCT(range_list)
{
    GNOMON_T(depth_time_range) ranges[GNOMON_CAPACITY];
    Real time_added, depth_added;
};

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_offset(GNOMON_T(depth_time_range) r, GNOMON_SETTING side)
{
    Real change = gnomon_abs(r.z1 - r.z0);
    Real brief = gnomon_min(change * Real(0.000000476837158203125) / (r.t1 - r.t0), change);
    Real by = side * (Real(0.0000152587890625) + brief);
    r.z0 = r.z0 + by;
    r.z1 = r.z1 + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
GNOMON_DETAIL_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_count_merge(GNOMON_LIST_T(range_list) list,
                                                                           GNOMON_T(range_pair) p)
{
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, Real(0));
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
GNOMON_DETAIL_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_place(GNOMON_LIST_T(range_list) list,
                                                                     GNOMON_T(depth_time_range) r)
{
    for (int i = 0; i + 1 < GNOMON_CAPACITY; ++i) { // the first empty one goes to the end
        depth_time_range s = list.ranges[i];
        depth_time_range next = list.ranges[i + 1];
        GNOMON_MASK empty = s.t1 <= s.t0 && r.t0 < r.t1;
        list.ranges[i] = range_select(empty, next, s);
        list.ranges[i + 1] = range_select(empty, s, next);
    }
    for (int k = 0; k + 1 < GNOMON_CAPACITY; ++k) {
        depth_time_range s = list.ranges[k];
        GNOMON_MASK here = s.t0 < s.t1 && range_less(r, s);
        list.ranges[k] = range_select(here, r, s);
        r = range_select(here, s, r);
    }
    depth_time_range last = list.ranges[GNOMON_CAPACITY - 1];
    list.ranges[GNOMON_CAPACITY - 1] = range_select(r.t0 < r.t1, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A place
/// of -1 is none.
GNOMON_DETAIL_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_replace(GNOMON_LIST_T(range_list) list, GNOMON_MASK full,
                                                                       Real first, Real second,
                                                                       GNOMON_T(range_pair) merge)
{
    Real place = Real(0);
    for (int i = 0; i < GNOMON_CAPACITY; ++i) {
        GNOMON_MASK merged = full && (place == first || place == second);
        list.ranges[i] = range_keep_if(!merged, list.ranges[i]);
        place = place + Real(1);
    }
    merge.merged = range_keep_if(full, merge.merged);
    merge.gap = gnomon_select(full, merge.gap, Real(0));
    merge.shift = gnomon_select(full, merge.shift, Real(0));
    return range_list_place(range_list_count_merge(list, merge), merge.merged);
}

/// Insert r, clipped to times in [0, 1]. Without an overflow the ranges of the list do not depend on the order of
/// insertion, bit for bit, except for the sign of a zero. With an overflow they do, but at no time is the front farther
/// than that of all inserted ranges. That holds strictly, for exact depth lines, however steep and brief the ranges
/// are.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010; Hong & Oh 2017
GNOMON_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_insert(GNOMON_LIST_T(range_list) list,
                                                               GNOMON_T(depth_time_range) r)
{
    r = range_canonical(range_clip(r, Real(0), Real(1)));
    list = range_list_count_merge(list, range_pair_empty(r)); // counts that are NaN become 0
    Real room = Real(0);
    for (int i = 0; i < GNOMON_CAPACITY; ++i) {
        depth_time_range s = range_canonical(list.ranges[i]);
        r = range_keep_if(!range_occludes(s, r), r);
        s = range_keep_if(!range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, Real(1));
    }
    GNOMON_MASK full = r.t0 < r.t1 && room < Real(1);
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        range_list occluders = list;
        for (int h = 0; h < GNOMON_CAPACITY; ++h) occluders.ranges[h] = range_offset(list.ranges[h], Real(1));
        depth_time_range farther = range_offset(r, Real(1));
        for (int j = 0; j < GNOMON_CAPACITY; ++j) {
            depth_time_range s = range_trim(range_offset(list.ranges[j], Real(-1)), farther);
            for (int k = 0; k < GNOMON_CAPACITY; ++k) s = range_trim(s, occluders.ranges[k]);
            GNOMON_MASK seen = !full || s.t0 < s.t1;
            list.ranges[j] = range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = range_keep_if(seen, occluders.ranges[j]);
        }
        depth_time_range left = range_offset(r, Real(-1));
        for (int m = 0; m < GNOMON_CAPACITY; ++m) left = range_trim(left, occluders.ranges[m]);
        r = range_keep_if(!full || left.t0 < left.t1, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        range_pair best = range_pair_empty(r);
        Real first = Real(-1);
        Real second = Real(-1);
        Real place = Real(0);
        for (int a = 0; a < GNOMON_CAPACITY; ++a) {
            depth_time_range other = r;
            Real other_place = Real(-1);
            for (int b = 0; b <= a; ++b) {
                range_pair pair = range_pair_make(list.ranges[a], other);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + Real(1);
            }
            place = place + Real(1);
        }
        list = range_list_replace(list, full, first, second, best);
        r = range_keep_if(!(full && second < Real(0)), r);
    }
    return range_list_place(list, r);
}

/// The list of one range; an empty list if the range is empty.
GNOMON_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_make(GNOMON_T(depth_time_range) r)
{
    GNOMON_LIST_T(range_list) list;
    for (int i = 0; i < GNOMON_CAPACITY; ++i) list.ranges[i] = range_keep_if(r.t0 < r.t0, r);
    list.time_added = Real(0);
    list.depth_added = Real(0);
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
GNOMON_LIST_KERNEL GNOMON_T(depth_time_range) range_list_front(GNOMON_LIST_T(range_list) list, Real t)
{
    range_front state = range_front_begin(t);
    for (int i = 0; i < GNOMON_CAPACITY; ++i) state = range_front_compare(state, list.ranges[i]);
    for (int k = 0; k < GNOMON_CAPACITY; ++k) state = range_front_limit(state, list.ranges[k]);
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
GNOMON_DETAIL_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_append(GNOMON_LIST_T(range_list) list,
                                                                      GNOMON_T(depth_time_range) r)
{
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    range_pair best = range_pair_empty(r);
    Real at = Real(0);
    Real place = Real(0);
    depth_time_range next = r;
    for (int i = 0; i < GNOMON_CAPACITY; ++i) {
        depth_time_range s = list.ranges[GNOMON_CAPACITY - 1 - i];
        range_pair pair = range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = range_pair_cheaper(best, pair);
        next = s;
        place = place + Real(1);
    }
    place = Real(0);
    next = r;
    for (int k = 0; k < GNOMON_CAPACITY; ++k) {
        depth_time_range s = list.ranges[GNOMON_CAPACITY - 1 - k];
        depth_time_range here = range_select(place == at, best.merged, s);
        list.ranges[GNOMON_CAPACITY - 1 - k] = range_select(place < at, next, here);
        next = s;
        place = place + Real(1);
    }
    return range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
GNOMON_LIST_KERNEL GNOMON_LIST_T(range_list) range_list_resolve(GNOMON_LIST_T(range_list) list)
{
    Real t = Real(0);
    range_list resolved = list;
    for (int i = 0; i < GNOMON_CAPACITY; ++i) resolved.ranges[i] = range_keep_if(t < t, list.ranges[i]);
    for (int k = 0; k < (GNOMON_CAPACITY + 1) * (GNOMON_CAPACITY + 2) / 2; ++k) {
        if (gnomon_any(t < Real(1))) {
            depth_time_range span = range_list_front(list, t);
            GNOMON_MASK some = GNOMON_LITERAL(range_nothing) < span.id;
            resolved = range_list_append(resolved, range_keep_if(some, span));
            t = span.t1;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
GNOMON_LIST_KERNEL Real range_list_intensity(GNOMON_LIST_T(range_list) list, Real t, Real z, Real id,
                                             GNOMON_SETTING bias)
{
    Real intensity = Real(0);
    for (int i = 0; i < GNOMON_CAPACITY; ++i)
        intensity = gnomon_max(intensity, range_intensity(list.ranges[i], t, z, id, bias));
    return intensity;
}

GNOMON_NAMESPACE_END
#endif
