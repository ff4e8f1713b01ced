// Lists of a few intervals as Gribel et al. 2010 compress them: a full list merges the two intervals of the least cost,
// a weighted sum of the gap in time between them, their differences in depth and in slope, and their durations. The
// merged interval is the line from the begin of the earlier one to the end of the later one. It may be behind either of
// them, so that what was shadowed becomes lit; range_list.h merges into a line in front of both, and has no weights.
//
// Costs and merges can be chosen apart, to tell what each of them does: the weight `area` is that of the cost of
// range_merge.h, and `conservative` above 0 takes the line in front of both.
//
//     list = range_list_make(range);   list = interval_list_insert(list, range, weights, 0) for every other range
//     resolved = range_list_resolve(list);
#ifndef GNOMON_COMPARATORS_INTERVAL_LIST_H
#define GNOMON_COMPARATORS_INTERVAL_LIST_H
#include "../motion/range/range_list.h"
GNOMON_NAMESPACE_BEGIN

/// Weights of the area that becomes shadowed (range_pair_make), of the gap in time, of the differences in depth and in
/// slope, and of the durations.
GNOMON_STRUCT(interval_weights) { Real area, gap, depth, slope, duration; };

/// The interval from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
/// If one is empty, the result is the other one, unchanged.
/// Source: Gribel 2010
GNOMON_KERNEL GNOMON_T(depth_time_range) interval_merge(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK some_a = a.t0 < a.t1;
    GNOMON_MASK some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, range_hull(a, b), range_select(some_a, a, b));
}

/// Cost of merging a and b, at most 2^60; -1 if one is empty. The difference in depth is that between the end of the
/// earlier one and the begin of the later one.
/// NaN: 2^60.
/// Source: Gribel 2010
GNOMON_KERNEL Real interval_cost(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b,
                                 GNOMON_T(interval_weights) weights)
{
    range_pair p = range_pair_make(a, b);
    depth_time_range first = range_select(b.t0 < a.t0, b, a);
    depth_time_range second = range_select(b.t0 < a.t0, a, b);
    Real gap = gnomon_max(second.t0 - first.t1, Real(0));
    Real slopes = (first.z1 - first.z0) / (first.t1 - first.t0) - (second.z1 - second.z0) / (second.t1 - second.t0);
    Real steeper = gnomon_min(gnomon_abs(slopes), GNOMON_LITERAL(range_far));
    Real lasting = range_duration(a) + range_duration(b);
    Real cost = (weights.area * p.cost + weights.gap * gap) +
                (weights.depth * gnomon_abs(second.z0 - first.z1) + weights.slope * steeper) +
                weights.duration * lasting;
    GNOMON_MASK some = a.t0 < a.t1 && b.t0 < b.t1;
    return gnomon_select(some, gnomon_max(gnomon_min(cost, GNOMON_LITERAL(range_far)), Real(0)), Real(-1));
}

/// The merge of a and b, with its costs.
GNOMON_DETAIL_KERNEL GNOMON_T(range_pair) interval_pair_make(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b,
                                                             GNOMON_T(interval_weights) weights,
                                                             GNOMON_SETTING conservative)
{
    range_pair p = range_pair_make(a, b);
    p.merged = range_select(Real(0) < conservative, p.merged, interval_merge(a, b));
    p.cost = interval_cost(a, b, weights);
    return p;
}

/// Insert r, clipped to times in [0, 1]. On overflow the pair of the least cost is merged, and the list counts its cost
/// as range_list_insert does, as if the merge were conservative.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16, weights of 0 or more.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010
GNOMON_LIST_KERNEL GNOMON_LIST_T(range_list) interval_list_insert(GNOMON_LIST_T(range_list) list,
                                                                  GNOMON_T(depth_time_range) r,
                                                                  GNOMON_T(interval_weights) weights,
                                                                  GNOMON_SETTING conservative)
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
        range_pair best = range_pair_empty(r);
        Real first = Real(-1);
        Real second = Real(-1);
        Real place = Real(0);
        for (int a = 0; a < GNOMON_CAPACITY; ++a) {
            depth_time_range other = r; // which has place -1
            Real other_place = Real(-1);
            for (int b = 0; b <= a; ++b) {
                range_pair pair = interval_pair_make(list.ranges[a], other, weights, conservative);
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

GNOMON_NAMESPACE_END
#endif
