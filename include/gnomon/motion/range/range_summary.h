// A resolved list in few numbers, for receivers that need no more: the nearest and the farthest depth, the occluded
// time and the id. Most receivers are behind all ranges of a texel, above all where its backdrop is left out
// (passes/range/resolve.hpp), or in front of all.
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);        for every range of the texel
#ifndef GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#define GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The nearest and the farthest depth of some ranges, and what they hide together from a receiver behind them, of a
/// shutter that is open from 0 to 1. Whose they are: range_mixed of several, range_nothing where no receiver is behind
/// ranges of its own id.
GNOMON_STRUCT(range_summary) { Real nearest, farthest, shadowed, id; };

/// No range yet. The near plane, -1, is a depth that receivers are behind.
GNOMON_KERNEL GNOMON_T(range_summary) range_summary_begin(Real near_plane)
{
    GNOMON_T(range_summary) total;
    total.nearest = GNOMON_LITERAL(range_far);
    total.farthest = near_plane;
    total.shadowed = Real(0);
    total.id = GNOMON_LITERAL(range_nothing);
    return total;
}

/// One range, none of whose time the others have. Empty ones and those with a NaN are left out, as nobody sees them.
GNOMON_KERNEL GNOMON_T(range_summary) range_summary_add(GNOMON_T(range_summary) total, GNOMON_T(depth_time_range) r)
{
    GNOMON_MASK some = r.t0 < r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    GNOMON_MASK first = total.id == GNOMON_LITERAL(range_nothing);
    Real nearest = gnomon_min(total.nearest, gnomon_min(r.z0, r.z1));
    Real farthest = gnomon_max(total.farthest, gnomon_max(r.z0, r.z1));
    Real share = saturate_or_zero(r.t1) - saturate_or_zero(r.t0);
    Real id = gnomon_select(first || total.id == r.id, r.id, GNOMON_LITERAL(range_mixed));
    total.nearest = gnomon_select(some, nearest, total.nearest);
    total.farthest = gnomon_select(some, farthest, total.farthest);
    total.shadowed = gnomon_select(some, total.shadowed + share, total.shadowed);
    total.id = gnomon_select(some, id, total.id);
    return total;
}

/// True where r, the next one of a resolved list, is of the second layer behind front, the last one that was not. Those
/// are seen while front lasts and no longer; spans in front that rounding has overlap are not.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_is_second_layer(GNOMON_T(depth_time_range) front, GNOMON_T(depth_time_range) r)
{
    return front.t0 <= r.t0 && r.t0 < front.t1 && r.t1 <= front.t1;
}

GNOMON_NAMESPACE_END
#endif
