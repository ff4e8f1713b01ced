// Depth-time ranges: from time t0 to t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map, at a
// depth that goes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing a
// depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017) and the interval of Gribel
// et al. 2010 and Palmer 2011 are these five numbers; the id tells whose surface it is, since none shadows itself.
//
// A range whose times are not in order, or one of them NaN, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_H
#define GNOMON_MOTION_RANGE_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Times in [0, 1], signed depths, and a whole number that floats hold, such as a triangle's index below 2^24.
GNOMON_STRUCT depth_time_range { Real t0, t1, z0, z1, id; };

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

/// The second where chosen is 0, else the first.
GNOMON_KERNEL GNOMON_T(depth_time_range)
    range_choice(Real chosen, GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    GNOMON_MASK second = chosen == Real(0);
    GNOMON_T(depth_time_range) r;
    r.t0 = gnomon_select(second, b.t0, a.t0);
    r.t1 = gnomon_select(second, b.t1, a.t1);
    r.z0 = gnomon_select(second, b.z0, a.z0);
    r.z1 = gnomon_select(second, b.z1, a.z1);
    r.id = gnomon_select(second, b.id, a.id);
    return r;
}

/// How far through it time t is: 0 until t0, 1 from t1 on; 0 at the one time of a range of no duration, or for NaN.
GNOMON_KERNEL Real range_passed(GNOMON_T(depth_time_range) r, Real t)
{
    return saturate_or_zero((t - r.t0) / (r.t1 - r.t0));
}

/// Depth at time t, outside that of the nearer end, z0 at the one time of a range of no duration; exact at both ends,
/// and throughout where the range is level. NaN where one end's is. Error: 5 (|z0| + |z1|) 2^-p, p the bits of the
/// significand.
GNOMON_KERNEL Real range_depth(GNOMON_T(depth_time_range) r, Real t)
{
    Real passed = range_passed(r, t);
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

/// When both are at the same depth; an end of the time that they have in common where they never are, so that cutting
/// both there (range_clip) leaves them in one order on either side. Error: (80 z / d + 4) 2^-p, z the largest depth and
/// d the change of their distance.
GNOMON_KERNEL Real range_crossing(GNOMON_T(depth_time_range) a, GNOMON_T(depth_time_range) b)
{
    Real begin = gnomon_max(a.t0, b.t0);
    Real end = gnomon_min(a.t1, b.t1);
    Real distance0 = range_depth(a, begin) - range_depth(b, begin);
    Real distance1 = range_depth(a, end) - range_depth(b, end);
    Real passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return begin * (Real(1) - passed) + end * passed;
}

/// What of it is in front of a receiver between two times; empty where nothing is. The course of the receiver's
/// depth is a range, too, level where it is at rest. A NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
GNOMON_KERNEL GNOMON_T(depth_time_range)
    range_in_front(GNOMON_T(depth_time_range) r, GNOMON_T(depth_time_range) course, Real begin, Real end)
{
    Real early = gnomon_max(begin, r.t0);
    Real late = gnomon_min(end, r.t1);
    Real before0 = range_depth(course, early) - range_depth(r, early);
    Real before1 = range_depth(course, late) - range_depth(r, late);
    Real passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
    Real meeting = clamp_or_nan(early * (Real(1) - passed) + late * passed, early, late);
    Real front = gnomon_select(Real(0) < before0, early, gnomon_select(Real(0) < before1, meeting, Real(1)));
    Real back = gnomon_select(Real(0) < before1, late, gnomon_select(Real(0) < before0, meeting, Real(0)));
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
