// Gnomon 0.1.0, range_front.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RANGE_FRONT_HLSL
#define GNOMON_RANGE_FRONT_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: range_front.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: range_front.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: range_front.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
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
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

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

static const float range_mixed = -1.0;                // the id of a range of several surfaces: it shadows them all
static const float range_nothing = -2.0;              // the id of a time without any surface
static const float range_far = 1152921504606846976.0; // 2^60: products of two depths are finite in float

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

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
struct range_front
{
    depth_time_range nearest;
    float begin, unchanged, end;
};

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
depth_time_range gnomon_range_canonical(depth_time_range r)
{
    r.id = gnomon_max(r.id, range_mixed);
    bool known = gnomon_abs(r.z0) + gnomon_abs(r.z1) < range_far;
    return gnomon_range_keep_if(0.0 <= r.t0 && r.t0 < r.t1 && r.t1 <= 1.0 && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
range_front range_front_begin(float t)
{
    range_front state;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(range_nothing);
    state.unchanged = 1.0;
    state.end = 1.0;
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
range_front range_front_compare(range_front state, depth_time_range r)
{
    r = gnomon_range_canonical(r);
    depth_time_range front = state.nearest;
    depth_time_range ahead = gnomon_range_visible_part(r, front);
    bool during = r.t0 <= state.begin && state.begin < r.t1;
    bool alone = front.t1 <= front.t0;
    bool nearer = ahead.t0 <= state.begin && state.begin < ahead.t1;
    float change = gnomon_select(state.begin < ahead.t0, ahead.t0, gnomon_select(nearer, ahead.t1, 1.0));
    change = gnomon_min(change, gnomon_min(front.t1, r.t1));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = gnomon_range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
range_front range_front_limit(range_front state, depth_time_range r)
{
    r = gnomon_range_canonical(r);
    depth_time_range ahead = gnomon_range_visible_part(r, state.nearest);
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
depth_time_range range_front_span(range_front state)
{
    bool some = state.nearest.t0 < state.nearest.t1;
    float end = gnomon_min(gnomon_select(some, state.nearest.t1, 1.0), state.end);
    depth_time_range span = range_clip(state.nearest, state.begin, end);
    span.t0 = state.begin;
    span.t1 = end;
    return span;
}

#endif

#endif
