// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_RANGE_H
#define GNOMON_MOTION_RANGE_RANGE_H
#include "../../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
GNOMON_STRUCT(depth_time_range) { Real t0, t1, z0, z1, id; };

GNOMON_CONSTANT(range_mixed, -1.0);                // the id of a range of several surfaces: it shadows them all
GNOMON_CONSTANT(range_nothing, -2.0);              // the id of a time without any surface
GNOMON_CONSTANT(range_far, 1152921504606846976.0); // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_between(Real time_a, Real z_a, Real time_b, Real z_b, Real id)
{
    GNOMON_MASK swapped = time_b < time_a;
    GNOMON_T(depth_time_range) r;
    r.t0 = gnomon_select(swapped, time_b, time_a);
    r.t1 = gnomon_select(swapped, time_a, time_b);
    r.z0 = gnomon_select(swapped, z_b, z_a);
    r.z1 = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_empty(Real id)
{
    GNOMON_T(depth_time_range) r;
    r.t0 = Real(1);
    r.t1 = Real(0);
    r.z0 = Real(1);
    r.z1 = Real(1);
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
GNOMON_KERNEL Real range_elapsed(GNOMON_T(depth_time_range) r, Real t)
{
    return saturate_or_zero((t - r.t0) / (r.t1 - r.t0));
}

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
GNOMON_KERNEL Real range_depth(GNOMON_T(depth_time_range) r, Real t)
{
    Real passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (Real(1) - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
GNOMON_KERNEL Real range_duration(GNOMON_T(depth_time_range) r) { return gnomon_max(r.t1 - r.t0, Real(0)); }

/// The part of r between the times begin and end, possibly empty.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_clip(GNOMON_T(depth_time_range) r, Real begin, Real end)
{
    GNOMON_T(depth_time_range) c;
    c.t0 = gnomon_max(begin, r.t0);
    c.t1 = gnomon_min(end, r.t1);
    c.z0 = range_depth(r, c.t0);
    c.z1 = range_depth(r, c.t1);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_select(GNOMON_MASK mask, GNOMON_T(depth_time_range) a,
                                                             GNOMON_T(depth_time_range) b)
{
    GNOMON_T(depth_time_range) r;
    r.t0 = gnomon_select(mask, a.t0, b.t0);
    r.t1 = gnomon_select(mask, a.t1, b.t1);
    r.z0 = gnomon_select(mask, a.z0, b.z0);
    r.z1 = gnomon_select(mask, a.z1, b.z1);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_keep_if(GNOMON_MASK mask, GNOMON_T(depth_time_range) r)
{
    return range_select(mask, r, range_empty(GNOMON_LITERAL(range_nothing)));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_less(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK by_id = a.id < b.id;
    GNOMON_MASK by_z1 = a.z1 < b.z1 || (a.z1 == b.z1 && by_id);
    GNOMON_MASK by_z0 = a.z0 < b.z0 || (a.z0 == b.z0 && by_z1);
    GNOMON_MASK by_t1 = a.t1 < b.t1 || (a.t1 == b.t1 && by_z0);
    return a.t0 < b.t0 || (a.t0 == b.t0 && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_occludes(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK during = a.t0 <= b.t0 && b.t1 <= a.t1;
    GNOMON_MASK apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    GNOMON_MASK nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    GNOMON_MASK equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_clip_to(GNOMON_T(depth_time_range) a,
                                                              GNOMON_T(depth_time_range) b)
{
    return range_clip(a, b.t0, b.t1);
}

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
GNOMON_DETAIL_KERNEL Real range_crossing(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    Real distance0 = a.z0 - b.z0;
    Real distance1 = a.z1 - b.z1;
    Real passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (Real(1) - passed) + a.t1 * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_visible_part(GNOMON_T(depth_time_range) a,
                                                                   GNOMON_T(depth_time_range) b)
{
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    Real before0 = near_b.z0 - near_a.z0;
    Real before1 = near_b.z1 - near_a.z1;
    GNOMON_MASK tie = before0 == Real(0) && before1 == Real(0) && a.id < b.id;
    GNOMON_MASK first = Real(0) < before0 || (before0 == Real(0) && Real(0) < before1) || tie;
    GNOMON_MASK last = Real(0) < before1 || (before1 == Real(0) && Real(0) < before0) || tie;
    Real crossing = clamp_or_nan(range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    Real begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, Real(1)));
    Real end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, Real(0)));
    GNOMON_MASK some = begin < end;
    return range_clip(a, gnomon_select(some, begin, Real(1)), gnomon_select(some, end, Real(0)));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_trim(GNOMON_T(depth_time_range) r,
                                                           GNOMON_T(depth_time_range) other)
{
    depth_time_range occluding = range_visible_part(other, r);
    GNOMON_MASK some = occluding.t0 < occluding.t1;
    Real begin = gnomon_select(some && occluding.t0 <= r.t0, occluding.t1, r.t0);
    Real end = gnomon_select(some && r.t1 <= occluding.t1, occluding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_occluding_part(GNOMON_T(depth_time_range) r,
                                                              GNOMON_T(depth_time_range) receiver, Real begin, Real end)
{
    Real early = gnomon_max(begin, r.t0);
    Real late = gnomon_min(end, r.t1);
    // In most cases one of the two is in front at all times.
    GNOMON_MASK nearer = r.z0 < receiver.z0 && r.z0 < receiver.z1 && r.z1 < receiver.z0 && r.z1 < receiver.z1;
    GNOMON_MASK farther = receiver.z0 <= r.z0 && receiver.z0 <= r.z1 && receiver.z1 <= r.z0 && receiver.z1 <= r.z1;
    Real front = early;
    Real back = gnomon_select(farther, Real(0), late);
    GNOMON_MASK open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        Real before0 = range_depth(receiver, early) - range_depth(r, early);
        Real before1 = range_depth(receiver, late) - range_depth(r, late);
        Real passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        Real crossing = clamp_or_nan(early * (Real(1) - passed) + late * passed, early, late);
        Real first = gnomon_select(Real(0) < before0, early, gnomon_select(Real(0) < before1, crossing, Real(1)));
        Real last = gnomon_select(Real(0) < before1, late, gnomon_select(Real(0) < before0, crossing, Real(0)));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    GNOMON_MASK some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, Real(1)), gnomon_select(some, back, Real(0)));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
GNOMON_KERNEL Real range_intensity(GNOMON_T(depth_time_range) r, Real t, Real z, Real id, GNOMON_SETTING bias)
{
    GNOMON_MASK during = r.t0 <= t && t <= r.t1;
    GNOMON_MASK occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, Real(1), Real(0));
}

GNOMON_NAMESPACE_END
#endif
