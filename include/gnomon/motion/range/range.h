// Depth-time ranges: from time t0 to t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map, at a
// depth that goes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing a
// depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017) and the interval of Gribel
// et al. 2010 and Palmer 2011 are these five numbers; the id tells whose surface it is, since none shadows itself.
//
// A range whose times are not in order, or one of them NaN, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_RANGE_H
#define GNOMON_MOTION_RANGE_RANGE_H
#include "../../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Times in [0, 1], signed depths, and a whole number that floats hold, such as a triangle's index below 2^24.
GNOMON_STRUCT(depth_time_range) { Real t0, t1, z0, z1, id; };

GNOMON_CONSTANT(range_mixed, -1.0);                // the id of what belongs to several surfaces: it shadows them all
GNOMON_CONSTANT(range_nothing, -2.0);              // the id of a time without any surface
GNOMON_CONSTANT(range_far, 1152921504606846976.0); // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, in any order.
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

/// One that shadows nothing.
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

/// How far through it time t is: 0 until t0, 1 from t1 on; 0 at the one time of a range of no duration, or for NaN.
GNOMON_KERNEL Real range_elapsed(GNOMON_T(depth_time_range) r, Real t)
{
    return saturate_or_zero((t - r.t0) / (r.t1 - r.t0));
}

/// Depth at time t, outside that of the nearer end, z0 at the one time of a range of no duration; exact at both ends,
/// and throughout where the range is level. NaN where one end's is. Error: 5 (|z0| + |z1|) 2^-p, p the bits of the
/// significand.
GNOMON_KERNEL Real range_depth(GNOMON_T(depth_time_range) r, Real t)
{
    Real passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (Real(1) - passed) + r.z1 * passed);
}

/// How long it lasts, 0 where it is empty.
GNOMON_KERNEL Real range_duration(GNOMON_T(depth_time_range) r) { return gnomon_max(r.t1 - r.t0, Real(0)); }

/// What of it falls between two times; empty where nothing does.
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

/// r where the mask is set, elsewhere nothing: an empty range that begins after all others.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) range_keep_if(GNOMON_MASK mask, GNOMON_T(depth_time_range) r)
{
    return range_select(mask, r, range_empty(GNOMON_LITERAL(range_nothing)));
}

/// A total order: by begin, end, depth at begin and at end, id. Which argument comes first cannot change it.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_less(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK by_id = a.id < b.id;
    GNOMON_MASK by_z1 = a.z1 < b.z1 || (a.z1 == b.z1 && by_id);
    GNOMON_MASK by_z0 = a.z0 < b.z0 || (a.z0 == b.z0 && by_z1);
    GNOMON_MASK by_t1 = a.t1 < b.t1 || (a.t1 == b.t1 && by_z0);
    return a.t0 < b.t0 || (a.t0 == b.t0 && by_t1);
}

/// Whether a hides b for as long as b lasts, as far as comparisons tell: all of a is in front of all of b, or both have
/// the same times and a has the nearer ends. Equal ones the lower id hides. Nothing is rounded, so what hides b hides
/// all that b hides: what is left of many ranges when the hidden ones go depends on no order.
GNOMON_DETAIL_KERNEL GNOMON_MASK range_occludes(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK during = a.t0 <= b.t0 && b.t1 <= a.t1;
    GNOMON_MASK apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    GNOMON_MASK nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    GNOMON_MASK equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// What of a falls into the time of b, exactly; empty where nothing does.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_clip_to(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    return range_clip(a, b.t0, b.t1);
}

/// When two ranges of the same times are at the same depth; one of these times where they never are.
GNOMON_KERNEL Real range_crossing_same_times(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    Real distance0 = a.z0 - b.z0;
    Real distance1 = a.z1 - b.z1;
    Real passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (Real(1) - passed) + a.t1 * passed;
}

/// When both are at the same depth; an end of the time that they have in common where they never are, so that cutting
/// both there (range_clip) leaves them in one order on either side. Error: (80 z / d + 4) 2^-p, z the largest depth and
/// d the change of their distance.
GNOMON_KERNEL Real range_crossing(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    return range_crossing_same_times(range_clip_to(a, b), range_clip_to(b, a));
}

/// What of a is in front of b; empty where nothing is. Where depths are equal throughout, the lower id is in front.
/// With what of b is in front of a it fills the time that both have, bit for bit, unless both depths and ids are equal.
/// Error: the change of front is that of range_crossing.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_visible_part(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    Real before0 = near_b.z0 - near_a.z0;
    Real before1 = near_b.z1 - near_a.z1;
    GNOMON_MASK tie = before0 == Real(0) && before1 == Real(0) && a.id < b.id;
    GNOMON_MASK first = Real(0) < before0 || (before0 == Real(0) && Real(0) < before1) || tie;
    GNOMON_MASK last = Real(0) < before1 || (before1 == Real(0) && Real(0) < before0) || tie;
    Real crossing = clamp_or_nan(range_crossing_same_times(near_a, near_b), near_a.t0, near_a.t1);
    Real begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, Real(1)));
    Real end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, Real(0)));
    GNOMON_MASK ever = begin < end;
    return range_clip(a, gnomon_select(ever, begin, Real(1)), gnomon_select(ever, end, Real(0)));
}

/// What remains of it where the other one hides its begin, its end or all of it. A range cannot have a hole: where only
/// its middle is hidden it stays whole. It is cut at times at which the other one is there, so that no time is without
/// either; the depth line moves by the error of range_depth.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_trim(GNOMON_T(depth_time_range) r, GNOMON_T(depth_time_range) other)
{
    depth_time_range hiding = range_visible_part(other, r);
    GNOMON_MASK some = hiding.t0 < hiding.t1;
    Real begin = gnomon_select(some && hiding.t0 <= r.t0, hiding.t1, r.t0);
    Real end = gnomon_select(some && r.t1 <= hiding.t1, hiding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// What of it is in front of a receiver between two times; empty where nothing is. The course of the receiver's
/// depth is a range, too, level where it is at rest. A NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
GNOMON_KERNEL GNOMON_T(depth_time_range) range_occluding_part(GNOMON_T(depth_time_range) r,
                                                              GNOMON_T(depth_time_range) course, Real begin, Real end)
{
    Real early = gnomon_max(begin, r.t0);
    Real late = gnomon_min(end, r.t1);
    // Where one is in front of the other whatever the time, as most are.
    GNOMON_MASK nearer = r.z0 < course.z0 && r.z0 < course.z1 && r.z1 < course.z0 && r.z1 < course.z1;
    GNOMON_MASK farther = course.z0 <= r.z0 && course.z0 <= r.z1 && course.z1 <= r.z0 && course.z1 <= r.z1;
    Real front = early;
    Real back = gnomon_select(farther, Real(0), late);
    GNOMON_MASK open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        Real before0 = range_depth(course, early) - range_depth(r, early);
        Real before1 = range_depth(course, late) - range_depth(r, late);
        Real passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        Real meeting = clamp_or_nan(early * (Real(1) - passed) + late * passed, early, late);
        Real first = gnomon_select(Real(0) < before0, early, gnomon_select(Real(0) < before1, meeting, Real(1)));
        Real last = gnomon_select(Real(0) < before1, late, gnomon_select(Real(0) < before0, meeting, Real(0)));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    GNOMON_MASK ever = front < back; // false for NaN
    return range_clip(r, gnomon_select(ever, front, Real(1)), gnomon_select(ever, back, Real(0)));
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id: 1 where the range is there at that
/// time, more than the bias in front, and not of that surface (Hong & Oh, section 5). NaN gives 0, lit.
GNOMON_KERNEL Real range_intensity(GNOMON_T(depth_time_range) r, Real t, Real z, Real id, GNOMON_SETTING bias)
{
    GNOMON_MASK during = r.t0 <= t && t <= r.t1;
    GNOMON_MASK hides = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && hides, Real(1), Real(0));
}

GNOMON_NAMESPACE_END
#endif
