// Gnomon 0.1.0, interval_list.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_INTERVAL_LIST_METAL
#define GNOMON_INTERVAL_LIST_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: interval_list.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: interval_list.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: interval_list.metal is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#if defined(__FAST_MATH__)
#error "gnomon: fast mathematics voids the treatment of NaN: compile with -fno-fast-math, or mathMode = .safe"
#endif

#include <metal_stdlib>

#if __METAL_VERSION__ >= 320 // to the end of the file
#pragma METAL fp math_mode(safe)
#endif

namespace gnomon {

constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
inline float gnomon_abs(float a) { return metal::fabs(a); }
inline float gnomon_sqrt(float a) { return metal::precise::sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
inline float gnomon_kept(float x) { return as_type<float>(metal::min(as_type<int>(x), 0x7FC00000)); }
inline float gnomon_apart(float x) { return as_type<float>(metal::min(as_type<uint>(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(metal::fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
inline float gnomon_saturate(float x)
{
    int bits = as_type<int>(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_type<float>(metal::min(metal::max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
inline float gnomon_high_part(float a) { return as_type<float>(as_type<uint>(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
inline float gnomon_power_of_two(float n) { return as_type<float>((as_type<uint>(n + 12582912.0f) << 23) + 0x3F800000u); }

} // namespace gnomon

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

namespace gnomon {

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

} // namespace gnomon

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

namespace gnomon {

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
struct depth_time_range { float t0, t1, z0, z1, id; };

// the id of a range of several surfaces: it shadows them all
constant constexpr float range_mixed = -1.0f;
constant constexpr float range_nothing = -2.0f;              // the id of a time without any surface
constant constexpr float range_far = 1152921504606846976.0f; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
inline depth_time_range range_between(float time_a, float z_a, float time_b, float z_b, float id)
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
inline depth_time_range range_empty(float id)
{
    depth_time_range r;
    r.t0 = 1.0f;
    r.t1 = 0.0f;
    r.z0 = 1.0f;
    r.z1 = 1.0f;
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
inline float range_elapsed(depth_time_range r, float t) { return saturate_or_zero((t - r.t0) / (r.t1 - r.t0)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
inline float range_depth(depth_time_range r, float t)
{
    float passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (1.0f - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
inline float range_duration(depth_time_range r) { return gnomon_max(r.t1 - r.t0, 0.0f); }

/// The part of r between the times begin and end, possibly empty.
inline depth_time_range range_clip(depth_time_range r, float begin, float end)
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
inline depth_time_range range_select(bool mask, depth_time_range a, depth_time_range b)
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
inline depth_time_range range_keep_if(bool mask, depth_time_range r)
{
    return range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
inline bool range_less(depth_time_range a, depth_time_range b)
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
inline bool range_occludes(depth_time_range a, depth_time_range b)
{
    bool during = a.t0 <= b.t0 && b.t1 <= a.t1;
    bool apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    bool nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    bool equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
inline depth_time_range range_clip_to(depth_time_range a, depth_time_range b) { return range_clip(a, b.t0, b.t1); }

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
inline float range_crossing(depth_time_range a, depth_time_range b)
{
    float distance0 = a.z0 - b.z0;
    float distance1 = a.z1 - b.z1;
    float passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (1.0f - passed) + a.t1 * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
inline depth_time_range range_visible_part(depth_time_range a, depth_time_range b)
{
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    float before0 = near_b.z0 - near_a.z0;
    float before1 = near_b.z1 - near_a.z1;
    bool tie = before0 == 0.0f && before1 == 0.0f && a.id < b.id;
    bool first = 0.0f < before0 || (before0 == 0.0f && 0.0f < before1) || tie;
    bool last = 0.0f < before1 || (before1 == 0.0f && 0.0f < before0) || tie;
    float crossing = clamp_or_nan(range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    float begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, 1.0f));
    float end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, 0.0f));
    bool some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0f), gnomon_select(some, end, 0.0f));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
inline depth_time_range range_trim(depth_time_range r, depth_time_range other)
{
    depth_time_range occluding = range_visible_part(other, r);
    bool some = occluding.t0 < occluding.t1;
    float begin = gnomon_select(some && occluding.t0 <= r.t0, occluding.t1, r.t0);
    float end = gnomon_select(some && r.t1 <= occluding.t1, occluding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
inline depth_time_range range_occluding_part(depth_time_range r, depth_time_range receiver, float begin, float end)
{
    float early = gnomon_max(begin, r.t0);
    float late = gnomon_min(end, r.t1);
    // In most cases one of the two is in front at all times.
    bool nearer = r.z0 < receiver.z0 && r.z0 < receiver.z1 && r.z1 < receiver.z0 && r.z1 < receiver.z1;
    bool farther = receiver.z0 <= r.z0 && receiver.z0 <= r.z1 && receiver.z1 <= r.z0 && receiver.z1 <= r.z1;
    float front = early;
    float back = gnomon_select(farther, 0.0f, late);
    bool open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        float before0 = range_depth(receiver, early) - range_depth(r, early);
        float before1 = range_depth(receiver, late) - range_depth(r, late);
        float passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        float crossing = clamp_or_nan(early * (1.0f - passed) + late * passed, early, late);
        float first = gnomon_select(0.0f < before0, early, gnomon_select(0.0f < before1, crossing, 1.0f));
        float last = gnomon_select(0.0f < before1, late, gnomon_select(0.0f < before0, crossing, 0.0f));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    bool some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, 1.0f), gnomon_select(some, back, 0.0f));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
inline float range_intensity(depth_time_range r, float t, float z, float id, float bias)
{
    bool during = r.t0 <= t && t <= r.t1;
    bool occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0f, 0.0f);
}

} // namespace gnomon

#endif

// motion/range/range_front.h ------------------------------------------------------------------------------------------
// The lower envelope of a list of ranges of any length, span by span: what the light sees of a texel from one time to
// another (Gribel et al. 2010; the resolve of Palmer 2011, 2.4). The caller owns both loops over the list, so that
// lists of any length can be resolved where no sorted structure is at hand, such as in a compute shader.
//
//     for (t = 0; t < 1; t = span.t1) {
//         state = range_front_begin(t);
//         for every range: state = range_front_compare(state, range);
//         for every range: state = range_front_limit(state, range);
//         span = range_front_span(state);
//     }
//
// Spans are contiguous. One with the id range_nothing has no range and may be left out of a resolved list. The ranges
// of the list overlap in time as they please; their order matters only where three of them meet within rounding.
#ifndef GNOMON_MOTION_RANGE_RANGE_FRONT_H
#define GNOMON_MOTION_RANGE_RANGE_FRONT_H

namespace gnomon {

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
struct range_front
{
    depth_time_range nearest;
    float begin, unchanged, end;
};

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
inline depth_time_range range_canonical(depth_time_range r)
{
    r.id = gnomon_max(r.id, range_mixed);
    bool known = gnomon_abs(r.z0) + gnomon_abs(r.z1) < range_far;
    return range_keep_if(0.0f <= r.t0 && r.t0 < r.t1 && r.t1 <= 1.0f && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
inline range_front range_front_begin(float t)
{
    range_front state;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(range_nothing);
    state.unchanged = 1.0f;
    state.end = 1.0f;
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
inline range_front range_front_compare(range_front state, depth_time_range r)
{
    r = range_canonical(r);
    depth_time_range front = state.nearest;
    depth_time_range ahead = range_visible_part(r, front);
    bool during = r.t0 <= state.begin && state.begin < r.t1;
    bool alone = front.t1 <= front.t0;
    bool nearer = ahead.t0 <= state.begin && state.begin < ahead.t1;
    float change = gnomon_select(state.begin < ahead.t0, ahead.t0, gnomon_select(nearer, ahead.t1, 1.0f));
    change = gnomon_min(change, gnomon_min(front.t1, r.t1));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
inline range_front range_front_limit(range_front state, depth_time_range r)
{
    r = range_canonical(r);
    depth_time_range ahead = range_visible_part(r, state.nearest);
    bool some = state.nearest.t0 < state.nearest.t1;
    float next = gnomon_select(some, ahead.t0, r.t0);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons
    // do.
    bool circle = ahead.t0 <= state.begin && state.begin < ahead.t1;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
inline depth_time_range range_front_span(range_front state)
{
    bool some = state.nearest.t0 < state.nearest.t1;
    float end = gnomon_min(gnomon_select(some, state.nearest.t1, 1.0f), state.end);
    depth_time_range span = range_clip(state.nearest, state.begin, end);
    span.t0 = state.begin;
    span.t1 = end;
    return span;
}

} // namespace gnomon

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

namespace gnomon {

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
struct range_pair
{
    depth_time_range merged;
    float gap, shift, cost;
};

constant constexpr float range_merge_margin = 0.000003814697265625f; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
inline depth_time_range range_hull(depth_time_range a, depth_time_range b)
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
inline depth_time_range range_merge(depth_time_range a, depth_time_range b)
{
    depth_time_range hull = range_hull(a, b);
    float back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                            gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, 0.0f);
    float size = gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)),
                            gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    float margin = size * range_merge_margin;
    float level = gnomon_min(gnomon_min(a.z0, b.z0), gnomon_min(a.z1, b.z1));
    float sloped0 = hull.z0 - back;
    float sloped1 = hull.z1 - back;
    bool slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < range_far;
    hull.z0 = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1 = gnomon_select(slopes, sloped1, level) - margin;

    bool some_a = a.t0 < a.t1;
    bool some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, hull, range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
inline float range_area(depth_time_range r) { return range_duration(r) * (1.0f - 0.5f * (r.z0 + r.z1)); }

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
inline float range_distance(depth_time_range r, depth_time_range nearer)
{
    float distance0 = r.z0 - range_depth(nearer, r.t0);
    float distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), 0.0f), 0.0f);
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
inline range_pair range_pair_make(depth_time_range a, depth_time_range b)
{
    range_pair p;
    p.merged = range_merge(a, b);
    bool some = a.t0 < a.t1 && b.t0 < b.t1;
    float gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, 0.0f), 0.0f);
    // Ignore the parts that the other range occludes: they were in shadow already.
    float shift = gnomon_max(range_distance(range_trim(a, b), p.merged), range_distance(range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, 0.0f);

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    float x0 = near_a.z0 - near_b.z0;
    float x1 = near_a.z1 - near_b.z1;
    float sum = gnomon_abs(x0) + gnomon_abs(x1);
    float apart = 0.5f * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(0.0f < sum, apart, 0.0f);
    float middle = 0.25f * ((near_a.z0 + near_a.z1) + (near_b.z0 + near_b.z1));
    float both = range_duration(near_a) * (1.0f - (middle + 0.5f * apart));
    float area = range_area(p.merged) - ((range_area(a) + range_area(b)) - both);
    float own_a = gnomon_select(a.id == p.merged.id, 0.0f, range_duration(a));
    float own_b = gnomon_select(b.id == p.merged.id, 0.0f, range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, 0.0f) + (own_a + own_b), -1.0f);
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
inline range_pair range_pair_empty(depth_time_range r)
{
    range_pair p;
    p.merged = r;
    p.gap = 0.0f;
    p.shift = 0.0f;
    p.cost = range_far * range_far;
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
inline range_pair range_pair_cheaper(range_pair a, range_pair b)
{
    bool cheaper = b.cost < a.cost;
    range_pair p;
    p.merged = range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

} // namespace gnomon

#endif

// motion/range/range_list.h -------------------------------------------------------------------------------------------
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

namespace gnomon {

#ifndef GNOMON_RANGE_CAPACITY
#define GNOMON_RANGE_CAPACITY 8
#endif

/// Ranges in the order of range_less, with empty ranges between them, and upper bounds of the cost of merging: except
/// for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
struct range_list
{
    depth_time_range ranges[GNOMON_RANGE_CAPACITY];
    float time_added, depth_added;
};

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
inline depth_time_range range_offset(depth_time_range r, float side)
{
    float change = gnomon_abs(r.z1 - r.z0);
    float brief = gnomon_min(change * 0.000000476837158203125f / (r.t1 - r.t0), change);
    float by = side * (0.0000152587890625f + brief);
    r.z0 = r.z0 + by;
    r.z1 = r.z1 + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
inline range_list range_list_count_merge(range_list list, range_pair p)
{
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, 0.0f);
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
inline range_list range_list_place(range_list list, depth_time_range r)
{
    for (int i = 0; i + 1 < GNOMON_RANGE_CAPACITY; ++i) { // the first empty one goes to the end
        depth_time_range s = list.ranges[i];
        depth_time_range next = list.ranges[i + 1];
        bool empty = s.t1 <= s.t0 && r.t0 < r.t1;
        list.ranges[i] = range_select(empty, next, s);
        list.ranges[i + 1] = range_select(empty, s, next);
    }
    for (int k = 0; k + 1 < GNOMON_RANGE_CAPACITY; ++k) {
        depth_time_range s = list.ranges[k];
        bool here = s.t0 < s.t1 && range_less(r, s);
        list.ranges[k] = range_select(here, r, s);
        r = range_select(here, s, r);
    }
    depth_time_range last = list.ranges[GNOMON_RANGE_CAPACITY - 1];
    list.ranges[GNOMON_RANGE_CAPACITY - 1] = range_select(r.t0 < r.t1, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A
/// place of -1 is none.
inline range_list range_list_replace(range_list list, bool full, float first, float second, range_pair merge)
{
    float place = 0.0f;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        bool merged = full && (place == first || place == second);
        list.ranges[i] = range_keep_if(!merged, list.ranges[i]);
        place = place + 1.0f;
    }
    merge.merged = range_keep_if(full, merge.merged);
    merge.gap = gnomon_select(full, merge.gap, 0.0f);
    merge.shift = gnomon_select(full, merge.shift, 0.0f);
    return range_list_place(range_list_count_merge(list, merge), merge.merged);
}

/// Insert r, clipped to times in [0, 1]. Without an overflow the ranges of the list do not depend on the order of
/// insertion, bit for bit, except for the sign of a zero. With an overflow they do, but at no time is the front farther
/// than that of all inserted ranges. That holds strictly, for exact depth lines, however steep and brief the ranges
/// are.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010; Hong & Oh 2017
inline range_list range_list_insert(range_list list, depth_time_range r)
{
    r = range_canonical(range_clip(r, 0.0f, 1.0f));
    list = range_list_count_merge(list, range_pair_empty(r)); // counts that are NaN become 0
    float room = 0.0f;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = range_canonical(list.ranges[i]);
        r = range_keep_if(!range_occludes(s, r), r);
        s = range_keep_if(!range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, 1.0f);
    }
    bool full = r.t0 < r.t1 && room < 1.0f;
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        range_list occluders = list;
        for (int h = 0; h < GNOMON_RANGE_CAPACITY; ++h) occluders.ranges[h] = range_offset(list.ranges[h], 1.0f);
        depth_time_range farther = range_offset(r, 1.0f);
        for (int j = 0; j < GNOMON_RANGE_CAPACITY; ++j) {
            depth_time_range s = range_trim(range_offset(list.ranges[j], -1.0f), farther);
            for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) s = range_trim(s, occluders.ranges[k]);
            bool seen = !full || s.t0 < s.t1;
            list.ranges[j] = range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = range_keep_if(seen, occluders.ranges[j]);
        }
        depth_time_range left = range_offset(r, -1.0f);
        for (int m = 0; m < GNOMON_RANGE_CAPACITY; ++m) left = range_trim(left, occluders.ranges[m]);
        r = range_keep_if(!full || left.t0 < left.t1, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        range_pair best = range_pair_empty(r);
        float first = -1.0f;
        float second = -1.0f;
        float place = 0.0f;
        for (int a = 0; a < GNOMON_RANGE_CAPACITY; ++a) {
            depth_time_range other = r;
            float other_place = -1.0f;
            for (int b = 0; b <= a; ++b) {
                range_pair pair = range_pair_make(list.ranges[a], other);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + 1.0f;
            }
            place = place + 1.0f;
        }
        list = range_list_replace(list, full, first, second, best);
        r = range_keep_if(!(full && second < 0.0f), r);
    }
    return range_list_place(list, r);
}

/// The list of one range; an empty list if the range is empty.
inline range_list range_list_make(depth_time_range r)
{
    range_list list;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) list.ranges[i] = range_keep_if(r.t0 < r.t0, r);
    list.time_added = 0.0f;
    list.depth_added = 0.0f;
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
inline depth_time_range range_list_front(range_list list, float t)
{
    range_front state = range_front_begin(t);
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) state = range_front_compare(state, list.ranges[i]);
    for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) state = range_front_limit(state, list.ranges[k]);
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
inline range_list range_list_append(range_list list, depth_time_range r)
{
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    range_pair best = range_pair_empty(r);
    float at = 0.0f;
    float place = 0.0f;
    depth_time_range next = r;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = list.ranges[GNOMON_RANGE_CAPACITY - 1 - i];
        range_pair pair = range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = range_pair_cheaper(best, pair);
        next = s;
        place = place + 1.0f;
    }
    place = 0.0f;
    next = r;
    for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) {
        depth_time_range s = list.ranges[GNOMON_RANGE_CAPACITY - 1 - k];
        depth_time_range here = range_select(place == at, best.merged, s);
        list.ranges[GNOMON_RANGE_CAPACITY - 1 - k] = range_select(place < at, next, here);
        next = s;
        place = place + 1.0f;
    }
    return range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
inline range_list range_list_resolve(range_list list)
{
    float t = 0.0f;
    range_list resolved = list;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) resolved.ranges[i] = range_keep_if(t < t, list.ranges[i]);
    for (int k = 0; k < (GNOMON_RANGE_CAPACITY + 1) * (GNOMON_RANGE_CAPACITY + 2) / 2; ++k) {
        if (gnomon_any(t < 1.0f)) {
            depth_time_range span = range_list_front(list, t);
            bool some = range_nothing < span.id;
            resolved = range_list_append(resolved, range_keep_if(some, span));
            t = span.t1;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
inline float range_list_intensity(range_list list, float t, float z, float id, float bias)
{
    float intensity = 0.0f;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) intensity = gnomon_max(intensity,
                                                                           range_intensity(list.ranges[i], t, z, id,
                                                                                           bias));
    return intensity;
}

} // namespace gnomon

#endif

// comparators/interval_list.h -----------------------------------------------------------------------------------------
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

namespace gnomon {

/// Weights of the area that becomes shadowed (range_pair_make), of the gap in time, of the differences in depth and in
/// slope, and of the durations.
struct interval_weights { float area, gap, depth, slope, duration; };

/// The interval from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
/// If one is empty, the result is the other one, unchanged.
/// Source: Gribel 2010
inline depth_time_range interval_merge(depth_time_range a, depth_time_range b)
{
    bool some_a = a.t0 < a.t1;
    bool some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, range_hull(a, b), range_select(some_a, a, b));
}

/// Cost of merging a and b, at most 2^60; -1 if one is empty. The difference in depth is that between the end of the
/// earlier one and the begin of the later one.
/// NaN: 2^60.
/// Source: Gribel 2010
inline float interval_cost(depth_time_range a, depth_time_range b, interval_weights weights)
{
    range_pair p = range_pair_make(a, b);
    depth_time_range first = range_select(b.t0 < a.t0, b, a);
    depth_time_range second = range_select(b.t0 < a.t0, a, b);
    float gap = gnomon_max(second.t0 - first.t1, 0.0f);
    float slopes = (first.z1 - first.z0) / (first.t1 - first.t0) - (second.z1 - second.z0) / (second.t1 - second.t0);
    float steeper = gnomon_min(gnomon_abs(slopes), range_far);
    float lasting = range_duration(a) + range_duration(b);
    float cost = (weights.area * p.cost + weights.gap * gap) +
                 (weights.depth * gnomon_abs(second.z0 - first.z1) + weights.slope * steeper) + weights.duration *
                 lasting;
    bool some = a.t0 < a.t1 && b.t0 < b.t1;
    return gnomon_select(some, gnomon_max(gnomon_min(cost, range_far), 0.0f), -1.0f);
}

/// The merge of a and b, with its costs.
inline range_pair interval_pair_make(depth_time_range a, depth_time_range b, interval_weights weights,
                                     float conservative)
{
    range_pair p = range_pair_make(a, b);
    p.merged = range_select(0.0f < conservative, p.merged, interval_merge(a, b));
    p.cost = interval_cost(a, b, weights);
    return p;
}

/// Insert r, clipped to times in [0, 1]. On overflow the pair of the least cost is merged, and the list counts its cost
/// as range_list_insert does, as if the merge were conservative.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16, weights of 0 or more.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010
inline range_list interval_list_insert(range_list list, depth_time_range r, interval_weights weights,
                                       float conservative)
{
    r = range_canonical(range_clip(r, 0.0f, 1.0f));
    list = range_list_count_merge(list, range_pair_empty(r)); // counts that are NaN become 0
    float room = 0.0f;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = range_canonical(list.ranges[i]);
        r = range_keep_if(!range_occludes(s, r), r);
        s = range_keep_if(!range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, 1.0f);
    }
    bool full = r.t0 < r.t1 && room < 1.0f;
    if (gnomon_any(full)) {
        range_pair best = range_pair_empty(r);
        float first = -1.0f;
        float second = -1.0f;
        float place = 0.0f;
        for (int a = 0; a < GNOMON_RANGE_CAPACITY; ++a) {
            depth_time_range other = r; // which has place -1
            float other_place = -1.0f;
            for (int b = 0; b <= a; ++b) {
                range_pair pair = interval_pair_make(list.ranges[a], other, weights, conservative);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + 1.0f;
            }
            place = place + 1.0f;
        }
        list = range_list_replace(list, full, first, second, best);
        r = range_keep_if(!(full && second < 0.0f), r);
    }
    return range_list_place(list, r);
}

} // namespace gnomon

#endif

#endif
