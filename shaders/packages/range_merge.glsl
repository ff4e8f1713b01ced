// Gnomon 0.1.0, range_merge.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RANGE_MERGE_GLSL
#define GNOMON_RANGE_MERGE_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: range_merge.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: range_merge.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: range_merge.glsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 300
#error "gnomon: #version 300 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 330
#error "gnomon: #version 330 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return intBitsToFloat(min(floatBitsToInt(x), 0x7FC00000)); }
float gnomon_apart(float x) { return uintBitsToFloat(min(floatBitsToUint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = floatBitsToInt(x);
    return gnomon_select(bits > 0x7F800000, 0.0, intBitsToFloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return uintBitsToFloat(floatBitsToUint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return uintBitsToFloat((floatBitsToUint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// motion/range/range.h ------------------------------------------------------------------------------------------------
// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_RANGE_H
#define GNOMON_MOTION_RANGE_RANGE_H

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
struct depth_time_range { float t0, t1, z0, z1, id; };

const float range_mixed = -1.0;                // the id of a range of several surfaces: it shadows them all
const float range_nothing = -2.0;              // the id of a time without any surface
const float range_far = 1152921504606846976.0; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
depth_time_range range_between(float time_a, float z_a, float time_b, float z_b, float id)
{
    bool swapped = time_b < time_a;
    depth_time_range r;
    r.t0 = gnomon_select(swapped, time_b, time_a);
    r.t1 = gnomon_select(swapped, time_a, time_b);
    r.z0 = gnomon_select(swapped, z_b, z_a);
    r.z1 = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
depth_time_range range_empty(float id)
{
    depth_time_range r;
    r.t0 = 1.0;
    r.t1 = 0.0;
    r.z0 = 1.0;
    r.z1 = 1.0;
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
float range_elapsed(depth_time_range r, float t) { return saturate_or_zero((t - r.t0) / (r.t1 - r.t0)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
float range_depth(depth_time_range r, float t)
{
    float passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (1.0 - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
float range_duration(depth_time_range r) { return gnomon_max(r.t1 - r.t0, 0.0); }

/// The part of r between the times begin and end, possibly empty.
depth_time_range range_clip(depth_time_range r, float begin, float end)
{
    depth_time_range c;
    c.t0 = gnomon_max(begin, r.t0);
    c.t1 = gnomon_min(end, r.t1);
    c.z0 = range_depth(r, c.t0);
    c.z1 = range_depth(r, c.t1);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
depth_time_range gnomon_range_select(bool mask, depth_time_range a, depth_time_range b)
{
    depth_time_range r;
    r.t0 = gnomon_select(mask, a.t0, b.t0);
    r.t1 = gnomon_select(mask, a.t1, b.t1);
    r.z0 = gnomon_select(mask, a.z0, b.z0);
    r.z1 = gnomon_select(mask, a.z1, b.z1);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
depth_time_range gnomon_range_keep_if(bool mask, depth_time_range r)
{
    return gnomon_range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
bool gnomon_range_less(depth_time_range a, depth_time_range b)
{
    bool by_id = a.id < b.id;
    bool by_z1 = a.z1 < b.z1 || (a.z1 == b.z1 && by_id);
    bool by_z0 = a.z0 < b.z0 || (a.z0 == b.z0 && by_z1);
    bool by_t1 = a.t1 < b.t1 || (a.t1 == b.t1 && by_z0);
    return a.t0 < b.t0 || (a.t0 == b.t0 && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
bool gnomon_range_occludes(depth_time_range a, depth_time_range b)
{
    bool during = a.t0 <= b.t0 && b.t1 <= a.t1;
    bool apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    bool nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    bool equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
depth_time_range gnomon_range_clip_to(depth_time_range a, depth_time_range b) { return range_clip(a, b.t0, b.t1); }

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
float gnomon_range_crossing(depth_time_range a, depth_time_range b)
{
    float distance0 = a.z0 - b.z0;
    float distance1 = a.z1 - b.z1;
    float passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (1.0 - passed) + a.t1 * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
depth_time_range gnomon_range_visible_part(depth_time_range a, depth_time_range b)
{
    depth_time_range near_a = gnomon_range_clip_to(a, b);
    depth_time_range near_b = gnomon_range_clip_to(b, a);
    float before0 = near_b.z0 - near_a.z0;
    float before1 = near_b.z1 - near_a.z1;
    bool tie = before0 == 0.0 && before1 == 0.0 && a.id < b.id;
    bool first = 0.0 < before0 || (before0 == 0.0 && 0.0 < before1) || tie;
    bool last = 0.0 < before1 || (before1 == 0.0 && 0.0 < before0) || tie;
    float crossing = clamp_or_nan(gnomon_range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    float begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, 1.0));
    float end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, 0.0));
    bool some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0), gnomon_select(some, end, 0.0));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
depth_time_range gnomon_range_trim(depth_time_range r, depth_time_range other)
{
    depth_time_range occluding = gnomon_range_visible_part(other, r);
    bool some = occluding.t0 < occluding.t1;
    float begin = gnomon_select(some && occluding.t0 <= r.t0, occluding.t1, r.t0);
    float end = gnomon_select(some && r.t1 <= occluding.t1, occluding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
depth_time_range range_occluding_part(depth_time_range r, depth_time_range receiver, float begin, float end)
{
    float early = gnomon_max(begin, r.t0);
    float late = gnomon_min(end, r.t1);
    // In most cases one of the two is in front at all times.
    bool nearer = r.z0 < receiver.z0 && r.z0 < receiver.z1 && r.z1 < receiver.z0 && r.z1 < receiver.z1;
    bool farther = receiver.z0 <= r.z0 && receiver.z0 <= r.z1 && receiver.z1 <= r.z0 && receiver.z1 <= r.z1;
    float front = early;
    float back = gnomon_select(farther, 0.0, late);
    bool open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        float before0 = range_depth(receiver, early) - range_depth(r, early);
        float before1 = range_depth(receiver, late) - range_depth(r, late);
        float passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        float crossing = clamp_or_nan(early * (1.0 - passed) + late * passed, early, late);
        float first = gnomon_select(0.0 < before0, early, gnomon_select(0.0 < before1, crossing, 1.0));
        float last = gnomon_select(0.0 < before1, late, gnomon_select(0.0 < before0, crossing, 0.0));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    bool some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, 1.0), gnomon_select(some, back, 0.0));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
float range_intensity(depth_time_range r, float t, float z, float id, float bias)
{
    bool during = r.t0 <= t && t <= r.t1;
    bool occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0, 0.0);
}

#endif

// motion/range/range_merge.h ------------------------------------------------------------------------------------------
// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.
#ifndef GNOMON_MOTION_RANGE_RANGE_MERGE_H
#define GNOMON_MOTION_RANGE_RANGE_MERGE_H

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
struct range_pair
{
    depth_time_range merged;
    float gap, shift, cost;
};

const float gnomon_range_merge_margin = 0.000003814697265625; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
depth_time_range gnomon_range_hull(depth_time_range a, depth_time_range b)
{
    depth_time_range hull;
    hull.t0 = gnomon_min(a.t0, b.t0);
    hull.t1 = gnomon_max(a.t1, b.t1);
    float nearer0 = gnomon_min(a.z0, b.z0);
    float nearer1 = gnomon_min(a.z1, b.z1);
    hull.z0 = gnomon_select(a.t0 < b.t0, a.z0, gnomon_select(b.t0 < a.t0, b.z0, nearer0));
    hull.z1 = gnomon_select(b.t1 < a.t1, a.z1, gnomon_select(a.t1 < b.t1, b.z1, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, range_mixed);
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
depth_time_range gnomon_range_merge(depth_time_range a, depth_time_range b)
{
    depth_time_range hull = gnomon_range_hull(a, b);
    float back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                            gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, 0.0);
    float size = gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)),
                            gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    float margin = size * gnomon_range_merge_margin;
    float level = gnomon_min(gnomon_min(a.z0, b.z0), gnomon_min(a.z1, b.z1));
    float sloped0 = hull.z0 - back;
    float sloped1 = hull.z1 - back;
    bool slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < range_far;
    hull.z0 = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1 = gnomon_select(slopes, sloped1, level) - margin;

    bool some_a = a.t0 < a.t1;
    bool some_b = b.t0 < b.t1;
    return gnomon_range_select(some_a && some_b, hull, gnomon_range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
float gnomon_range_area(depth_time_range r) { return range_duration(r) * (1.0 - 0.5 * (r.z0 + r.z1)); }

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
float gnomon_range_distance(depth_time_range r, depth_time_range nearer)
{
    float distance0 = r.z0 - range_depth(nearer, r.t0);
    float distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), 0.0), 0.0);
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
range_pair gnomon_range_pair_make(depth_time_range a, depth_time_range b)
{
    range_pair p;
    p.merged = gnomon_range_merge(a, b);
    bool some = a.t0 < a.t1 && b.t0 < b.t1;
    float gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, 0.0), 0.0);
    // Ignore the parts that the other range occludes: they were in shadow already.
    float shift = gnomon_max(gnomon_range_distance(gnomon_range_trim(a, b), p.merged),
                             gnomon_range_distance(gnomon_range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, 0.0);

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    depth_time_range near_a = gnomon_range_clip_to(a, b);
    depth_time_range near_b = gnomon_range_clip_to(b, a);
    float x0 = near_a.z0 - near_b.z0;
    float x1 = near_a.z1 - near_b.z1;
    float sum = gnomon_abs(x0) + gnomon_abs(x1);
    float apart = 0.5 * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(0.0 < sum, apart, 0.0);
    float middle = 0.25 * ((near_a.z0 + near_a.z1) + (near_b.z0 + near_b.z1));
    float both = range_duration(near_a) * (1.0 - (middle + 0.5 * apart));
    float area = gnomon_range_area(p.merged) - ((gnomon_range_area(a) + gnomon_range_area(b)) - both);
    float own_a = gnomon_select(a.id == p.merged.id, 0.0, range_duration(a));
    float own_b = gnomon_select(b.id == p.merged.id, 0.0, range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, 0.0) + (own_a + own_b), -1.0);
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
range_pair gnomon_range_pair_empty(depth_time_range r)
{
    range_pair p;
    p.merged = r;
    p.gap = 0.0;
    p.shift = 0.0;
    p.cost = range_far * range_far;
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
range_pair gnomon_range_pair_cheaper(range_pair a, range_pair b)
{
    bool cheaper = b.cost < a.cost;
    range_pair p;
    p.merged = gnomon_range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

#endif

#endif
