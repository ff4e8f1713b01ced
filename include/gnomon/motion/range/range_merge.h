// One range for two, as lists of few ranges need it when they are full (the compression of Gribel et al. 2010): it
// lasts from the begin of the earlier to the end of the later, and its depth line is in front of both, so that what was
// in shadow stays there. Which two are the most similar Gribel et al. judge by the gap between them, and by how depth,
// slope and duration differ, each with its weight. Here one measure takes all of them in, and has no weights: the area
// of the plane of time and depth that falls into shadow though no range was in front of it. It is, up to a factor, what
// goes wrong for a receiver of which nothing is known. To it add the times for which a surface comes to be shadowed by
// its own range, because what belongs to two surfaces belongs to neither.
#ifndef GNOMON_MOTION_RANGE_RANGE_MERGE_H
#define GNOMON_MOTION_RANGE_RANGE_MERGE_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// Two ranges as one, the time between them that it fills, how far at most it is in front of what was, and what it
/// costs altogether.
GNOMON_STRUCT(range_pair)
{
    GNOMON_T(depth_time_range) merged;
    Real gap, shift, cost;
};

GNOMON_CONSTANT(range_merge_margin, 0.000003814697265625); // 2^-18, exact

/// One range for both: of the line between the outer ends, moved to the front until it is before both, and the level
/// line through the nearest end, the one that darkens less. The margin on top, 2^-18 of the largest depth, outweighs
/// what rounding does to any of the lines in float, 59 2^-24: at no time, by range_depth, is it behind either. The id
/// is theirs if they share it, else range_mixed. Where one is empty, the other as it is.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_merge(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_T(depth_time_range) hull;
    hull.t0 = gnomon_min(a.t0, b.t0);
    hull.t1 = gnomon_max(a.t1, b.t1);
    Real nearer0 = gnomon_min(a.z0, b.z0);
    Real nearer1 = gnomon_min(a.z1, b.z1);
    hull.z0 = gnomon_select(a.t0 < b.t0, a.z0, gnomon_select(b.t0 < a.t0, b.z0, nearer0));
    hull.z1 = gnomon_select(b.t1 < a.t1, a.z1, gnomon_select(a.t1 < b.t1, b.z1, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, GNOMON_LITERAL(range_mixed));

    Real back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                           gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, Real(0));
    Real size =
        gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)), gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    Real margin = size * GNOMON_LITERAL(range_merge_margin);
    Real level = gnomon_min(nearer0, nearer1);
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

/// The area behind it as far as the far plane.
GNOMON_KERNEL Real range_area(GNOMON_T(depth_time_range) r)
{
    return range_duration(r) * (Real(1) - Real(0.5) * (r.z0 + r.z1));
}

/// How far it is behind the other at its ends, where that lies farther; 0 where it is empty.
GNOMON_KERNEL Real range_distance(GNOMON_T(depth_time_range) r, GNOMON_T(depth_time_range) nearer)
{
    Real distance0 = r.z0 - range_depth(nearer, r.t0);
    Real distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), Real(0)), Real(0));
}

/// What the two become, and for how much. Gap and shift are exact but for rounding. The cost is the area behind the
/// merged range that was behind neither, and the times for which a surface loses its id; where one is empty, so that
/// there is nothing to merge, it is -1, and gap and shift 0.
GNOMON_KERNEL GNOMON_T(range_pair) range_pair_make(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_T(range_pair) p;
    p.merged = range_merge(a, b);
    GNOMON_MASK some = a.t0 < a.t1 && b.t0 < b.t1;
    Real gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, Real(0)), Real(0));
    // What the other one hides was in shadow already.
    Real shift = gnomon_max(range_distance(range_trim(a, b), p.merged), range_distance(range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, Real(0));

    // Behind both is what is behind the farther one, which is at (a + b + |a - b|) / 2; |x| from x0 to x1, on average:
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

/// r by itself, at a cost above that of any pair: where a search for the cheapest begins.
GNOMON_KERNEL GNOMON_T(range_pair) range_pair_empty(GNOMON_T(depth_time_range) r)
{
    GNOMON_T(range_pair) p;
    p.merged = r;
    p.gap = Real(0);
    p.shift = Real(0);
    p.cost = GNOMON_LITERAL(range_far) * GNOMON_LITERAL(range_far);
    return p;
}

/// The one with the lower cost; a where both cost the same.
GNOMON_KERNEL GNOMON_T(range_pair) range_pair_cheaper(GNOMON_T(range_pair) a, GNOMON_T(range_pair) b)
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
