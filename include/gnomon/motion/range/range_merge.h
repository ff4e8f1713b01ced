// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.
#ifndef GNOMON_MOTION_RANGE_RANGE_MERGE_H
#define GNOMON_MOTION_RANGE_RANGE_MERGE_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
GNOMON_STRUCT(range_pair)
{
    GNOMON_T(depth_time_range) merged;
    Real gap, shift, cost;
};

GNOMON_CONSTANT(range_merge_margin, 0.000003814697265625); // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths there. Of
/// two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_hull(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_T(depth_time_range) hull;
    hull.t0 = gnomon_min(a.t0, b.t0);
    hull.t1 = gnomon_max(a.t1, b.t1);
    Real nearer0 = gnomon_min(a.z0, b.z0);
    Real nearer1 = gnomon_min(a.z1, b.z1);
    hull.z0 = gnomon_select(a.t0 < b.t0, a.z0, gnomon_select(b.t0 < a.t0, b.z0, nearer0));
    hull.z1 = gnomon_select(b.t1 < a.t1, a.z1, gnomon_select(a.t1 < b.t1, b.z1, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, GNOMON_LITERAL(range_mixed));
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_merge(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    depth_time_range hull = range_hull(a, b);
    Real back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                           gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, Real(0));
    Real size =
        gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)), gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    Real margin = size * GNOMON_LITERAL(range_merge_margin);
    Real level = gnomon_min(gnomon_min(a.z0, b.z0), gnomon_min(a.z1, b.z1));
    Real sloped0 = hull.z0 - back;
    Real sloped1 = hull.z1 - back;
    GNOMON_MASK slopes =
        level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < GNOMON_LITERAL(range_far);
    hull.z0 = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1 = gnomon_select(slopes, sloped1, level) - margin;

    GNOMON_MASK some_a = a.t0 < a.t1;
    GNOMON_MASK some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, hull, range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
GNOMON_DETAIL_KERNEL Real range_area(GNOMON_T(depth_time_range) r)
{
    return range_duration(r) * (Real(1) - Real(0.5) * (r.z0 + r.z1));
}

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
GNOMON_DETAIL_KERNEL Real range_distance(GNOMON_T(depth_time_range) r, GNOMON_T(depth_time_range) nearer)
{
    Real distance0 = r.z0 - range_depth(nearer, r.t0);
    Real distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), Real(0)), Real(0));
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
GNOMON_DETAIL_KERNEL GNOMON_T(range_pair) range_pair_make(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_T(range_pair) p;
    p.merged = range_merge(a, b);
    GNOMON_MASK some = a.t0 < a.t1 && b.t0 < b.t1;
    Real gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, Real(0)), Real(0));
    // Ignore the parts that the other range occludes: they were in shadow already.
    Real shift = gnomon_max(range_distance(range_trim(a, b), p.merged), range_distance(range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, Real(0));

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    Real x0 = near_a.z0 - near_b.z0;
    Real x1 = near_a.z1 - near_b.z1;
    Real sum = gnomon_abs(x0) + gnomon_abs(x1);
    Real apart = Real(0.5) * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(Real(0) < sum, apart, Real(0));
    Real middle = Real(0.25) * ((near_a.z0 + near_a.z1) + (near_b.z0 + near_b.z1));
    Real both = range_duration(near_a) * (Real(1) - (middle + Real(0.5) * apart));
    Real area = range_area(p.merged) - ((range_area(a) + range_area(b)) - both);
    Real own_a = gnomon_select(a.id == p.merged.id, Real(0), range_duration(a));
    Real own_b = gnomon_select(b.id == p.merged.id, Real(0), range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, Real(0)) + (own_a + own_b), Real(-1));
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
GNOMON_DETAIL_KERNEL GNOMON_T(range_pair) range_pair_empty(GNOMON_T(depth_time_range) r)
{
    GNOMON_T(range_pair) p;
    p.merged = r;
    p.gap = Real(0);
    p.shift = Real(0);
    p.cost = GNOMON_LITERAL(range_far) * GNOMON_LITERAL(range_far);
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
GNOMON_DETAIL_KERNEL GNOMON_T(range_pair) range_pair_cheaper(GNOMON_T(range_pair) a, GNOMON_T(range_pair) b)
{
    GNOMON_MASK cheaper = b.cost < a.cost;
    GNOMON_T(range_pair) p;
    p.merged = range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

GNOMON_NAMESPACE_END
#endif
