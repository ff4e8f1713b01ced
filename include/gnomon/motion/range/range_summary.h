// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel
#ifndef GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#define GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
GNOMON_STRUCT(range_summary) { Real nearest, farthest, shadowed, id; };

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
GNOMON_KERNEL GNOMON_T(range_summary) range_summary_begin(Real near_plane)
{
    GNOMON_T(range_summary) summary;
    summary.nearest = GNOMON_LITERAL(range_far);
    summary.farthest = near_plane;
    summary.shadowed = Real(0);
    summary.id = GNOMON_LITERAL(range_nothing);
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
GNOMON_KERNEL GNOMON_T(range_summary) range_summary_add(GNOMON_T(range_summary) summary, GNOMON_T(depth_time_range) r)
{
    GNOMON_MASK some = r.t0 < r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    GNOMON_MASK first = summary.id == GNOMON_LITERAL(range_nothing);
    Real nearest = gnomon_min(summary.nearest, gnomon_min(r.z0, r.z1));
    Real farthest = gnomon_max(summary.farthest, gnomon_max(r.z0, r.z1));
    Real share = saturate_or_zero(r.t1) - saturate_or_zero(r.t0);
    Real id = gnomon_select(first || summary.id == r.id, r.id, GNOMON_LITERAL(range_mixed));
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_is_second_layer(GNOMON_T(depth_time_range) front, GNOMON_T(depth_time_range) r)
{
    return front.t0 <= r.t0 && r.t0 < front.t1 && r.t1 <= front.t1;
}

GNOMON_NAMESPACE_END
#endif
