// Gnomon 0.1.0, prism.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_PRISM_GLSL
#define GNOMON_PRISM_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: prism.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: prism.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: prism.glsl is not of the same version as a package before it"
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

// motion/triangle/coverage_intervals.h --------------------------------------------------------------------------------
// Times at which a triangle covers a sample, for edge functions that are quadratic in time (moving_triangle.h): at most
// four intervals of the shutter for either facing (Gribel et al. 2010; Palmer 2011, 2.1).
//
// An edge function is stored by its Bernstein coefficients, e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2. So e0 and e2
// are its values at shutter open and close, and a root t = u / (1 + u) belongs to a root u >= 0 of
//     e2 u^2 + 2 e1 u + e0 = 0,   u = q / e2 or e0 / q,   q = -(e1 + sign(e1) sqrt(e1^2 - e0 e2))
// This gives t = q / (q + e2) or e0 / (e0 + q). Both are sums of like signs, so nothing cancels, neither near 0 nor
// near 1. The set of times with e >= 0 is a single interval, or, if e is positive at both ends, everything except one
// gap. Three edges leave one interval less three gaps, hence four intervals. No sign is sampled in between. Of two
// triangles that share an edge, one has e and the other -e. Both find the same roots bit for bit, so one triangle
// covers the sample exactly when the other does not.
#ifndef GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H
#define GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
struct gnomon_moving_edge { float e0, e1, e2; };

/// The edge functions opposite to the vertices a, b, c of a triangle.
struct gnomon_moving_edges { gnomon_moving_edge a, b, c; };

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are
/// gnomon_coverage_none. An empty set has begin 1 and end 0.
struct gnomon_edge_intervals { float begin, end, gap_begin, gap_end; };

/// The times from begin to end; none unless begin < end.
struct gnomon_linear_interval { float begin, end; };

/// Four numbers in ascending order.
struct gnomon_ordered4 { float first, second, third, fourth; };

/// Disjoint intervals in order, `count` of them; the others begin and end at gnomon_coverage_none.
struct coverage_intervals { float count, begin0, end0, begin1, end1, begin2, end2, begin3, end3; };

const float gnomon_coverage_none = 2.0;                       // after the shutter has closed
const float gnomon_moving_edge_limit = 1152921504606846976.0; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
float moving_edge_at(gnomon_moving_edge e, float t)
{
    float s = 1.0 - t;
    return (e.e0 * s + e.e1 * t) * s + (e.e1 * s + e.e2 * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
float gnomon_moving_edge_size(gnomon_moving_edge e) { return (gnomon_abs(e.e0) + gnomon_abs(e.e1)) + gnomon_abs(e.e2); }

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
gnomon_edge_intervals moving_edge_inside(gnomon_moving_edge e, float facing)
{
    float side = gnomon_select(facing < 0.0, -1.0, 1.0);
    float c0 = side * e.e0;
    float c1 = side * e.e1;
    float c2 = side * e.e2;
    gnomon_edge_intervals x;
    x.begin = 0.0;
    x.end = 1.0;
    x.gap_begin = gnomon_coverage_none;
    x.gap_end = gnomon_coverage_none;
    bool before = c0 < 0.0; // outside at shutter open
    bool after = c2 < 0.0;
    if (gnomon_any(before || after || c1 < 0.0)) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        bool up = 0.0 < c1 || (c1 == 0.0 && before);
        bool late = (before && !up) || (up && !before);
        bool once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        bool twice = !(once || late);
        float r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, 0.0));
        float q = gnomon_select(up, -1.0 * (c1 + r), r - c1);
        float first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        float second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && 0.0 < r;
            bool gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        bool some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, 0.0), 1.0);
        x.end = gnomon_select(some, gnomon_select(after, second, 1.0), 0.0);
    }
    bool known = gnomon_moving_edge_size(e) < gnomon_moving_edge_limit;
    x.begin = gnomon_select(known, x.begin, 1.0);
    x.end = gnomon_select(known, x.end, 0.0);
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
gnomon_linear_interval linear_edge_inside(float e0, float e2)
{
    bool before = e0 < 0.0;
    bool after = e2 < 0.0;
    float change = e0 - e2;
    bool never = (before && after) || !(gnomon_abs(change) < gnomon_moving_edge_limit);
    float root = gnomon_min(e0 / change, 1.0);
    gnomon_linear_interval x;
    x.begin = gnomon_select(never, 1.0, gnomon_select(before, root, 0.0));
    x.end = gnomon_select(never, 0.0, gnomon_select(after, root, 1.0));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
gnomon_linear_interval linear_coverage(gnomon_moving_edges e)
{
    gnomon_linear_interval a = linear_edge_inside(e.a.e0, e.a.e2);
    gnomon_linear_interval b = linear_edge_inside(e.b.e0, e.b.e2);
    gnomon_linear_interval c = linear_edge_inside(e.c.e0, e.c.e2);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
gnomon_ordered4 gnomon_ordered4_make(float a, float b, float c, float d)
{
    float low0 = gnomon_min(a, b);
    float high0 = gnomon_max(a, b);
    float low1 = gnomon_min(c, d);
    float high1 = gnomon_max(c, d);
    float middle0 = gnomon_max(low0, low1);
    float middle1 = gnomon_min(high0, high1);
    gnomon_ordered4 x;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
coverage_intervals intersect_edge_intervals(gnomon_edge_intervals a, gnomon_edge_intervals b, gnomon_edge_intervals c)
{
    float begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), 0.0);
    float end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), 1.0);
    float none = gnomon_coverage_none;
    bool some = begin < end;
    coverage_intervals x;
    x.count = gnomon_select(some, 1.0, 0.0);
    x.begin0 = gnomon_select(some, begin, none);
    x.end0 = gnomon_select(some, end, none);
    x.begin1 = none;
    x.end1 = none;
    x.begin2 = none;
    x.end2 = none;
    x.begin3 = none;
    x.end3 = none;
    bool gap_a = a.gap_begin < none;
    bool gap_b = b.gap_begin < none;
    bool gap_c = c.gap_begin < none;
    if (gnomon_any(some && (gap_a || gap_b || gap_c))) {
        // Intervals that a caller made may have a gap's end without a begin. Ignore such ends, so that no lane of a
        // pack depends on the others.
        a.gap_begin = gnomon_select(gap_a, a.gap_begin, none);
        b.gap_begin = gnomon_select(gap_b, b.gap_begin, none);
        c.gap_begin = gnomon_select(gap_c, c.gap_begin, none);
        a.gap_end = gnomon_select(gap_a, a.gap_end, none);
        b.gap_end = gnomon_select(gap_b, b.gap_end, none);
        c.gap_end = gnomon_select(gap_c, c.gap_end, none);
        // Sorted separately, the begins and ends of gaps bound the times outside of all gaps: a time is outside when as
        // many gaps have begun as have ended.
        gnomon_ordered4 starts = gnomon_ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        gnomon_ordered4 stops = gnomon_ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        float begin1 = gnomon_max(begin, stops.first);
        float begin2 = gnomon_max(begin, stops.second);
        float begin3 = gnomon_max(begin, stops.third);
        float end0 = gnomon_min(end, starts.first);
        float end1 = gnomon_min(end, starts.second);
        float end2 = gnomon_min(end, starts.third);
        bool some0 = some && begin < end0;
        bool some1 = some && begin1 < end1;
        bool some2 = some && begin2 < end2;
        bool some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = gnomon_ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                                      gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = gnomon_ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                                     gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, 1.0, 0.0) + gnomon_select(some1, 1.0, 0.0)) +
                  (gnomon_select(some2, 1.0, 0.0) + gnomon_select(some3, 1.0, 0.0));
        x.begin0 = starts.first;
        x.end0 = stops.first;
        x.begin1 = starts.second;
        x.end1 = stops.second;
        x.begin2 = starts.third;
        x.end2 = stops.third;
        x.begin3 = starts.fourth;
        x.end3 = stops.fourth;
    }
    return x;
}

/// Times at which a triangle that turns this side to the sample covers it: all three edge functions are >= 0, or <= 0
/// if facing is negative. A sample on the border is covered. A triangle without area, with three edge functions that
/// are 0 throughout, covers nothing.
/// Domain: none for coefficients that moving_edge_inside refuses.
/// NaN: none.
/// Error: that of moving_edge_inside.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
coverage_intervals moving_coverage(gnomon_moving_edges e, float facing)
{
    gnomon_edge_intervals a = moving_edge_inside(e.a, facing);
    float size = (gnomon_moving_edge_size(e.a) + gnomon_moving_edge_size(e.b)) + gnomon_moving_edge_size(e.c);
    a.end = gnomon_select(0.0 < size, a.end, 0.0);
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
float coverage_duration(coverage_intervals x)
{
    return saturate_or_zero(((x.end0 - x.begin0) + (x.end1 - x.begin1)) + ((x.end2 - x.begin2) + (x.end3 - x.begin3)));
}

#endif

// motion/triangle/moving_triangle.h -----------------------------------------------------------------------------------
// A triangle whose vertices move linearly through clip space while the shutter is open (Akenine-Moller et al. 2007), as
// one sample of a shadow map sees it: edge functions, coverage, depth.
//
// A vertex is p(t) = (1 - t) q + t r. Sheared by the sample (s_x, s_y), its coordinates (x - s_x w, y - s_y w) are
// linear in t as well, and 0 where the vertex projects to the sample. An edge function is the cross product of two
// sheared vertices, a quadratic in t, also in perspective (w is 1 in an orthographic view):
//     e(t) = p_i(t) x p_j(t) = (1 - t)^2 q_i x q_j + t (1 - t) (q_i x r_j + r_i x q_j) + t^2 r_i x r_j
// This is the homogeneous edge function of Laine & Karras 2011. The point of the triangle that the sample sees is the
// mean of the vertices, each weighted by the edge function opposite to it. So depth is a cubic over a cubic,
//     z / w = sum_k e_k(t) z_k(t) / sum_k e_k(t) w_k(t)
// Depth that is linear in view distance is affine in the point, so its w_k is 1 and it is a cubic over a quadratic.
// Lists of ranges approximate depth by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance requires (chapter 5).
//
// The deviation of depth from a line is bounded, not sampled. Let depth be N / D, let h be the line through it at both
// ends of an interval, and let u go from 0 to 1 there. N - h D vanishes at both ends, so it is u (1 - u) P(u). D / (u
// (1 - u)) is at least some constant c. So |N / D - h| is at most |P| / c, with equality for a parabola.
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
struct gnomon_moving_vertex { float x0, y0, z0, w0, x1, y1, z1, w1; };

/// A triangle of three moving vertices.
struct moving_triangle { gnomon_moving_vertex a, b, c; };

/// A vertex relative to a sample, at shutter open and at shutter close.
struct gnomon_sheared_vertex { float x0, y0, x1, y1; };

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
struct depth_line { float z0, z1, deviation; };

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
struct depth_piece { float t0, t1, z0, z1, passed; };

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
struct depth_trial
{
    depth_piece piece;
    float start, share, settled;
};

/// Weights of a triangle's vertices; they need not sum to 1.
struct gnomon_corner_weights { float a, b, c; };

/// Bernstein coefficients of a cubic, the middle ones times 3.
struct gnomon_bernstein_cubic { float c0, c1, c2, c3; };

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
gnomon_sheared_vertex gnomon_moving_vertex_shear(gnomon_moving_vertex v, float s_x, float s_y)
{
    gnomon_sheared_vertex r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
float gnomon_sheared_cross(float a_x, float a_y, float b_x, float b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
gnomon_moving_edge gnomon_moving_edge_make(gnomon_sheared_vertex a, gnomon_sheared_vertex b)
{
    gnomon_moving_edge e;
    e.e0 = gnomon_sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = 0.5 * (gnomon_sheared_cross(a.x0, a.y0, b.x1, b.y1) + gnomon_sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = gnomon_sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
gnomon_moving_edges moving_triangle_edges(moving_triangle m, float s_x, float s_y)
{
    gnomon_sheared_vertex a = gnomon_moving_vertex_shear(m.a, s_x, s_y);
    gnomon_sheared_vertex b = gnomon_moving_vertex_shear(m.b, s_x, s_y);
    gnomon_sheared_vertex c = gnomon_moving_vertex_shear(m.c, s_x, s_y);
    gnomon_moving_edges e;
    e.a = gnomon_moving_edge_make(b, c);
    e.b = gnomon_moving_edge_make(c, a);
    e.c = gnomon_moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
gnomon_corner_weights gnomon_corner_weights_at(gnomon_moving_edges e, float t)
{
    gnomon_corner_weights v;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    bool back = (v.a + v.b) + v.c < 0.0;
    v.a = gnomon_max(gnomon_select(back, -1.0 * v.a, v.a), 0.0);
    v.b = gnomon_max(gnomon_select(back, -1.0 * v.b, v.b), 0.0);
    v.c = gnomon_max(gnomon_select(back, -1.0 * v.c, v.c), 0.0);
    bool vanished = (v.a + v.b) + v.c <= 0.0;
    v.a = gnomon_select(vanished, 1.0, v.a);
    v.b = gnomon_select(vanished, 1.0, v.b);
    v.c = gnomon_select(vanished, 1.0, v.c);
    return v;
}

/// Depth of the triangle's point at the sample at time t, in [-1, 1]; e from moving_triangle_edges. divided is 1 for
/// depth z / w, with z in clip space, and 0 for a z that is linear in view distance: the result is then the mean of the
/// vertices' z. Edge functions against the triangle's facing, which arise from rounding and outside of the covered
/// times, count as 0, so that the result lies between the depths of the vertices if all w > 0. If all three vanish, the
/// result is the depth of the centroid.
/// Domain: 1, the far plane, where the point is behind the light, w <= 0.
/// NaN: 1.
/// Error: that of the edge functions times sum_k |z_k - z v_k| / |sum_k e_k v_k|, and 16 2^-p of the largest |z_k /
/// v_k|; v = w where divided, else 1.
float moving_depth_at(moving_triangle m, gnomon_moving_edges e, float t, float divided)
{
    gnomon_corner_weights v = gnomon_corner_weights_at(e, t);
    float s = 1.0 - t;
    float z = (v.a * (m.a.z0 * s + m.a.z1 * t) + v.b * (m.b.z0 * s + m.b.z1 * t)) + v.c * (m.c.z0 * s + m.c.z1 * t);
    float w = (v.a * (m.a.w0 * s + m.a.w1 * t) + v.b * (m.b.w0 * s + m.b.w1 * t)) + v.c * (m.c.w0 * s + m.c.w1 * t);
    float divisor = gnomon_select(0.0 < divided, w, (v.a + v.b) + v.c);
    float depth = gnomon_max(gnomon_min(z / divisor, 1.0), -1.0); // a NaN becomes 1
    return gnomon_select(0.0 < w, depth, 1.0);
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
float gnomon_depth_nonlinearity(float most, float d0, float d3, float turn0, float turn1)
{
    bool negative = d0 < 0.0;
    float turn = gnomon_select(negative, -1.0 * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    float product = d0 * d3;
    float least = turn + 2.0 * gnomon_sqrt(product);
    bool known = 0.0 < product && 0.0 < least && least < gnomon_moving_edge_limit;
    return gnomon_select(known, most / least, 4.0);
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
depth_line gnomon_depth_line_within(float z0, float z1, float free0, float free1, float bend, float least, float most)
{
    float beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    float all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    depth_line r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
gnomon_moving_edge gnomon_moving_edge_between(gnomon_moving_edge e, float begin, float end)
{
    float left = 1.0 - end;
    gnomon_moving_edge r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = 2.0 * ((e.e0 * left + e.e1 * end) * (1.0 - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from gnomon_moving_edge_between, each times a linear function: from a0 to a1, from
/// b0 to b1, from c0 to c1.
gnomon_bernstein_cubic gnomon_moving_edges_combine(gnomon_moving_edges e, float a0, float a1, float b0, float b1,
                                                   float c0, float c1)
{
    gnomon_bernstein_cubic r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
depth_line moving_depth_line(moving_triangle m, gnomon_moving_edges e, float begin, float end, float divided)
{
    float b = 1.0 - begin;
    float f = 1.0 - end;
    gnomon_moving_edges x;
    x.a = gnomon_moving_edge_between(e.a, begin, end);
    x.b = gnomon_moving_edge_between(e.b, begin, end);
    x.c = gnomon_moving_edge_between(e.c, begin, end);
    gnomon_bernstein_cubic n = gnomon_moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end,
                                                           m.b.z0 * b + m.b.z1 * begin, m.b.z0 * f + m.b.z1 * end,
                                                           m.c.z0 * b + m.c.z1 * begin, m.c.z0 * f + m.c.z1 * end);
    float a_w0 = m.a.w0 * b + m.a.w1 * begin;
    float a_w1 = m.a.w0 * f + m.a.w1 * end;
    float b_w0 = m.b.w0 * b + m.b.w1 * begin;
    float b_w1 = m.b.w0 * f + m.b.w1 * end;
    float c_w0 = m.c.w0 * b + m.c.w1 * begin;
    float c_w1 = m.c.w0 * f + m.c.w1 * end;
    bool before = 0.0 < a_w0 && 0.0 < a_w1 && 0.0 < b_w0 && 0.0 < b_w1 && 0.0 < c_w0 && 0.0 < c_w1;
    bool by_w = 0.0 < divided;
    gnomon_bernstein_cubic d = gnomon_moving_edges_combine(x, gnomon_select(by_w, a_w0, 1.0),
                                                           gnomon_select(by_w, a_w1, 1.0),
                                                           gnomon_select(by_w, b_w0, 1.0),
                                                           gnomon_select(by_w, b_w1, 1.0),
                                                           gnomon_select(by_w, c_w0, 1.0),
                                                           gnomon_select(by_w, c_w1, 1.0));
    float free0 = n.c0 / d.c0;
    float free1 = n.c3 / d.c3;
    float turn0 = d.c1 - d.c0;
    float turn1 = d.c2 - d.c3;
    float p0 = (n.c1 - free0 * turn0) - free1 * d.c0;
    float p1 = (n.c1 + n.c2) - (free0 * d.c2 + free1 * d.c1);
    float p2 = (n.c2 - free1 * turn1) - free0 * d.c3;
    float most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), 0.5 * gnomon_abs(p1));
    float bend = gnomon_select(before, gnomon_depth_nonlinearity(most, d.c0, d.c3, turn0, turn1), 4.0);
    return gnomon_depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0,
                                    free1, bend, -1.0, 1.0);
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
float gnomon_moving_depth_time(float begin, float end, float passed)
{
    return gnomon_select(passed < 1.0, begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
depth_trial gnomon_depth_trial_begin(float begin, float end, float passed)
{
    depth_trial r;
    r.start = saturate_or_zero(passed);
    r.share = 1.0 - r.start;
    r.settled = 0.0;
    r.piece.t0 = gnomon_moving_depth_time(begin, end, r.start);
    r.piece.t1 = end;
    r.piece.z0 = 1.0;
    r.piece.z1 = 1.0;
    r.piece.passed = 1.0;
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
depth_trial gnomon_depth_trial_next(depth_trial trial, depth_line fit, float begin, float end, float tolerance)
{
    float shortest = 0.0322265625;
    bool fits = fit.deviation <= tolerance || trial.share <= shortest;
    float parts = gnomon_select(fit.deviation <= 4.0 * tolerance, 2.0, 3.0);
    float shorter = gnomon_max(trial.share / parts, shortest);
    float to = gnomon_min(trial.start + shorter, 1.0);
    trial.piece.z0 = fit.z0;
    trial.piece.z1 = fit.z1;
    trial.piece.t1 = gnomon_select(fits, trial.piece.t1, gnomon_moving_depth_time(begin, end, to));
    trial.piece.passed = gnomon_select(fits, trial.piece.passed, to);
    trial.share = gnomon_select(fits, trial.share, shorter);
    trial.settled = gnomon_select(fits, 1.0, 0.0);
    return trial;
}

/// The next piece of an interval, from the fraction `passed` on, whose line deviates by at most the tolerance: the rest
/// of the interval, or a half or a third of that, and so on. Pieces are as long as their lines fit (Palmer 2011,
/// chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// The loop gives 1 to 32 pieces. Each begins where the one before ends, bit for bit; the first begins at begin, the
/// last ends at end. Pieces before the last are never shorter than 33/1024 of the interval, even if the tolerance is
/// missed: where the triangle turns edge-on, no line fits. A tolerance below 0 gives 32 pieces.
/// NaN: a NaN tolerance gives 32 pieces; passed is then 0.
/// Error: that of moving_depth_line, for the deviation.
/// Source: Palmer 2011, Sec. 5
depth_piece moving_depth_piece(moving_triangle m, gnomon_moving_edges e, float begin, float end, float passed,
                               float divided, float tolerance)
{
    depth_trial r = gnomon_depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < 1.0)) r = gnomon_depth_trial_next(r,
                                                                     moving_depth_line(m, e, r.piece.t0, r.piece.t1,
                                                                                       divided), begin, end, tolerance);
    }
    return r.piece;
}

#endif

// comparators/prism.h -------------------------------------------------------------------------------------------------
// The prism of Hong & Oh ("Motion blurred shadows utilizing a depth-time ranges shadow map", Sec. 4.1 and 4.3): the
// volume that a moving triangle sweeps, enclosed by triangles that any rasterizer draws. Each triangle carries the
// time at its vertices, so the fragments of a texel tell when the moving triangle enters and leaves the texel, and
// at which depth.
//
// The caps of the prism are the moving triangle at shutter open and close. Each edge sweeps a side: four triangles
// around the midpoint of the edge halfway in time. If the edge at open crosses the edge at close on the screen, the
// side is a bow tie. Its centre is then at the crossing, and two of the four triangles, which have no area, are
// omitted. With A B the edge at open, C D the edge at close, and x the cross product, A + s (B - A) = C + u (D - C).
// Multiplication by D - C and by B - A gives (Eq. 1, with the signs that the printed order of factors loses)
//     s = (C - A) x (D - C) / (B - A) x (D - C),   u = (C - A) x (B - A) / (B - A) x (D - C).
// The paper does not say which attributes the crossing vertex gets. The edge passes there twice, at time 0 with depth
// z_AB(s) and at time 1 with depth z_CD(u). This text uses the mean of both: time 1/2 and the mean depth and 1 / w. The
// errors, half a shutter and half the distance of the depths, are then the least possible in the worst case. Without a
// crossing the centre has the attributes of the midpoint.
//
// Between vertices, time and depth are interpolated as rasterizers do by default, linearly in space, since the
// paper names no other way. The weight of corner k on the screen is its edge function e_k. Divided by w_k it is the
// weight in space:
//     time = sum_k e_k t_k / w_k / sum_k e_k / w_k
// Depth that is linear in view distance has the same weights. Depth z / w is linear on the screen and has the weights
// e_k. All of this is exact if the sides are plane and time is linear on them, hence for translations, also in
// perspective. A translation makes bow ties only of sides that are seen edge-on and have no area. For other motions
// prisms approximate: 10% to 13% of the triangles that rotate or deform are present at wrong times for more than 5% of
// the shutter (tests/comparators/prism_ranges.cpp). Prisms are therefore the comparator for moving_triangle.h, which is
// exact and the default. The ranges of one triangle in one texel:
//
//     prism p = prism_make(m, divided);
//     prism_pair pair = prism_pair_begin(id);
//     for (k = 0; k < 14; ++k)
//         pair = prism_pair_add(pair, prism_fragment_at(prism_triangle_make(p, k), s_x, s_y, divided));
//     prism_ranges ranges = prism_pair_end(pair);
#ifndef GNOMON_COMPARATORS_PRISM_H
#define GNOMON_COMPARATORS_PRISM_H

/// A vertex on the screen, with depth z, time t and inverse_w = 1 / w, which is 1 in orthographic views.
struct prism_vertex { float x, y, z, t, inverse_w; };

/// A triangle of a prism.
struct prism_triangle { prism_vertex a, b, c; };

/// The side that an edge sweeps: the vertex at its centre. crosses is 1 if the edge at open crosses the edge at close
/// there, else 0.
struct gnomon_prism_side
{
    prism_vertex centre;
    float crosses;
};

/// The corners at shutter open (0) and at shutter close (1), and the sides of the three edges.
struct gnomon_prism
{
    prism_vertex a0, b0, c0, a1, b1, c1;
    gnomon_prism_side ab, bc, ca;
};

/// A fragment: covered is 1 or 0, time is in [0, 1] and depth in [-1, 1].
struct prism_fragment { float covered, time, depth; };

/// The fragments of one triangle id in one texel: their number, the earliest, the latest, and the nearest four in
/// order.
struct prism_pair
{
    float id, count;
    prism_fragment earliest, latest, first, second, third, fourth;
};

/// The ranges of a triangle in a texel, count of them, 0 to 2; the remaining ones are empty.
struct prism_ranges
{
    depth_time_range first, second;
    float count;
};

const float prism_no_depth = 2.0; // behind every fragment

/// The vertex on the screen of a point in clip space at time t. divided is as for moving_depth_at. A vertex with w <= 0
/// or a NaN w produces no fragment.
prism_vertex gnomon_prism_vertex_make(float x, float y, float z, float w, float t, float divided)
{
    float divisor = gnomon_max(w, 0.0);
    prism_vertex r;
    r.x = x / divisor;
    r.y = y / divisor;
    r.z = gnomon_select(0.0 < divided, z / divisor, z);
    r.t = t;
    r.inverse_w = 1.0 / divisor;
    return r;
}

/// The vertex at shutter open.
prism_vertex gnomon_prism_vertex_open(gnomon_moving_vertex v, float divided)
{
    return gnomon_prism_vertex_make(v.x0, v.y0, v.z0, v.w0, 0.0, divided);
}

/// The vertex at shutter close.
prism_vertex gnomon_prism_vertex_close(gnomon_moving_vertex v, float divided)
{
    return gnomon_prism_vertex_make(v.x1, v.y1, v.z1, v.w1, 1.0, divided);
}

/// The factor of the screen weight in the interpolation of depth: 1 if depth is divided, else 1 / w, as for time.
float gnomon_prism_depth_weight(prism_vertex v, float divided)
{
    return gnomon_select(0.0 < divided, 1.0, v.inverse_w);
}

/// The vertex at the fraction `passed` of the way from a to b on the screen, at the time of a.
prism_vertex gnomon_prism_vertex_between(prism_vertex a, prism_vertex b, float passed, float divided)
{
    float left = 1.0 - passed;
    float weight_a = left * gnomon_prism_depth_weight(a, divided);
    float weight_b = passed * gnomon_prism_depth_weight(b, divided);
    prism_vertex r;
    r.x = a.x * left + b.x * passed;
    r.y = a.y * left + b.y * passed;
    r.z = (weight_a * a.z + weight_b * b.z) / (weight_a + weight_b);
    r.t = a.t;
    r.inverse_w = a.inverse_w * left + b.inverse_w * passed;
    return r;
}

/// The side that the edge from a to b sweeps. A centre without a crossing is the same, bit for bit, for b to a.
gnomon_prism_side gnomon_prism_side_make(gnomon_moving_vertex a, gnomon_moving_vertex b, float divided)
{
    prism_vertex a0 = gnomon_prism_vertex_open(a, divided);
    prism_vertex b0 = gnomon_prism_vertex_open(b, divided);
    prism_vertex a1 = gnomon_prism_vertex_close(a, divided);
    prism_vertex b1 = gnomon_prism_vertex_close(b, divided);
    float open_x = b0.x - a0.x;
    float open_y = b0.y - a0.y;
    float close_x = b1.x - a1.x;
    float close_y = b1.y - a1.y;
    float between_x = a1.x - a0.x;
    float between_y = a1.y - a0.y;
    float area = gnomon_sheared_cross(open_x, open_y, close_x, close_y);
    float s = gnomon_sheared_cross(between_x, between_y, close_x, close_y) / area;
    float u = gnomon_sheared_cross(between_x, between_y, open_x, open_y) / area;
    bool crosses = 0.0 <= s && s <= 1.0 && 0.0 <= u && u <= 1.0; // false if area is 0

    // The mean in clip space, where the midpoint of the moving edge is.
    float x = 0.25 * ((a.x0 + b.x0) + (a.x1 + b.x1));
    float y = 0.25 * ((a.y0 + b.y0) + (a.y1 + b.y1));
    float z = 0.25 * ((a.z0 + b.z0) + (a.z1 + b.z1));
    float w = 0.25 * ((a.w0 + b.w0) + (a.w1 + b.w1));
    prism_vertex middle = gnomon_prism_vertex_make(x, y, z, w, 0.5, divided);
    prism_vertex open = gnomon_prism_vertex_between(a0, b0, s, divided);
    prism_vertex close = gnomon_prism_vertex_between(a1, b1, u, divided);
    gnomon_prism_side r;
    r.centre.x = gnomon_select(crosses, open.x, middle.x);
    r.centre.y = gnomon_select(crosses, open.y, middle.y);
    r.centre.z = gnomon_select(crosses, 0.5 * (open.z + close.z), middle.z);
    r.centre.t = 0.5;
    r.centre.inverse_w = gnomon_select(crosses, 0.5 * (open.inverse_w + close.inverse_w), middle.inverse_w);
    r.crosses = gnomon_select(crosses, 1.0, 0.0);
    return r;
}

/// The prism of a moving triangle.
/// Domain: all w > 0 at shutter open and close, else parts of the prism are missing.
/// Source: Hong & Oh 2018, Sec. 4.1; Hong & Oh 2018, Eq. 1
gnomon_prism prism_make(moving_triangle m, float divided)
{
    gnomon_prism p;
    p.a0 = gnomon_prism_vertex_open(m.a, divided);
    p.b0 = gnomon_prism_vertex_open(m.b, divided);
    p.c0 = gnomon_prism_vertex_open(m.c, divided);
    p.a1 = gnomon_prism_vertex_close(m.a, divided);
    p.b1 = gnomon_prism_vertex_close(m.b, divided);
    p.c1 = gnomon_prism_vertex_close(m.c, divided);
    p.ab = gnomon_prism_side_make(m.a, m.b, divided);
    p.bc = gnomon_prism_side_make(m.b, m.c, divided);
    p.ca = gnomon_prism_side_make(m.c, m.a, divided);
    return p;
}

/// The vertex `first` for k <= 0, `second` for k = 1, else `third`.
prism_vertex gnomon_prism_choice(float k, prism_vertex first, prism_vertex second, prism_vertex third)
{
    bool is_first = k < 0.5;
    bool is_second = k < 1.5;
    prism_vertex r;
    r.x = gnomon_select(is_first, first.x, gnomon_select(is_second, second.x, third.x));
    r.y = gnomon_select(is_first, first.y, gnomon_select(is_second, second.y, third.y));
    r.z = gnomon_select(is_first, first.z, gnomon_select(is_second, second.z, third.z));
    r.t = gnomon_select(is_first, first.t, gnomon_select(is_second, second.t, third.t));
    r.inverse_w = gnomon_select(is_first, first.inverse_w, gnomon_select(is_second, second.inverse_w, third.inverse_w));
    return r;
}

/// Triangle k of the 14 of a prism: 0 to 3, 4 to 7 and 8 to 11 around the centres of the sides, 12 and 13 the caps.
/// Winding is not kept. The first and the third triangle of a side with a crossing are points.
/// Domain: k in 0, ..., 13; any other k gives a point.
/// Source: Hong & Oh 2018, Sec. 4.1
prism_triangle prism_triangle_make(gnomon_prism p, float k)
{
    float side = gnomon_select(k < 3.5, 0.0, gnomon_select(k < 7.5, 1.0, 2.0));
    float i = k - 4.0 * side;
    prism_vertex from0 = gnomon_prism_choice(side, p.a0, p.b0, p.c0);
    prism_vertex to0 = gnomon_prism_choice(side, p.b0, p.c0, p.a0);
    prism_vertex to1 = gnomon_prism_choice(side, p.b1, p.c1, p.a1);
    prism_vertex from1 = gnomon_prism_choice(side, p.a1, p.b1, p.c1);
    float crosses = gnomon_select(side < 0.5, p.ab.crosses, gnomon_select(side < 1.5, p.bc.crosses, p.ca.crosses));

    prism_triangle r;
    r.a = gnomon_prism_choice(i, from0, to0, gnomon_prism_choice(i - 2.0, to1, from1, from1));
    r.b = gnomon_prism_choice(i, to0, to1, gnomon_prism_choice(i - 2.0, from1, from0, from0));
    r.c = gnomon_prism_choice(side, p.ab.centre, p.bc.centre, p.ca.centre);
    float cap = k - 11.0;
    r.a = gnomon_prism_choice(cap, r.a, p.a0, p.a1);
    r.b = gnomon_prism_choice(cap, r.b, p.b0, p.b1);
    r.c = gnomon_prism_choice(cap, r.c, p.c0, p.c1);

    bool odd = (0.5 < i && i < 1.5) || 2.5 < i;
    bool none = (0.0 < crosses && k < 11.5 && !odd) || !(-0.5 < k && k < 13.5);
    float dropped = gnomon_select(none, 0.0, 1.0);
    r.b = gnomon_prism_choice(dropped, r.a, r.b, r.b);
    r.c = gnomon_prism_choice(dropped, r.a, r.c, r.c);
    return r;
}

/// The edge function of p and q at the sample (s_x, s_y).
float gnomon_prism_edge(prism_vertex p, prism_vertex q, float s_x, float s_y)
{
    return gnomon_sheared_cross(p.x - s_x, p.y - s_y, q.x - s_x, q.y - s_y);
}

/// The side of the edge from p to q that the sample is on, 1 or -1, for edge function e. If e is 0, the side of a point
/// slightly further along x and, far less, along y. 0 for an edge without length.
float gnomon_prism_edge_side(prism_vertex p, prism_vertex q, float e)
{
    float level = gnomon_select(q.x < p.x, -1.0, gnomon_select(p.x < q.x, 1.0, 0.0));
    float tie = gnomon_select(q.y < p.y, 1.0, gnomon_select(p.y < q.y, -1.0, level));
    return gnomon_select(0.0 < e, 1.0, gnomon_select(e < 0.0, -1.0, tie));
}

/// The fragment of a triangle at the sample (s_x, s_y), in the units of x / w. A sample is covered if it is on the same
/// side of all three edges. Exchanging the ends of an edge negates the side bit for bit, so triangles that share an
/// edge agree on the side of a sample. Triangles that meet at a sample all displace it to the same point nearby, which
/// is the fill rule of rasterizers, for either winding. A surface that encloses a volume therefore has an even number
/// of fragments. An odd number remains if rounding gives an edge function the wrong sign, and beside crossings, which
/// sides and caps share only up to rounding. A cap's time is exactly 0 or 1. divided is as for moving_depth_at.
/// Domain: |e_k| and |e_k / w_k| up to 2^60, triangles with an area; elsewhere the sample is not covered.
/// NaN: a triangle with a NaN coordinate covers no sample.
/// Error: of time, and of depth in units of the largest |z|, (48 X Y max_k v_k / |sum_k e_k v_k| + 10) 2^-p. X
/// and Y are the distances along each axis from the sample to the farthest vertex, and v_k = 1 / w_k, but 1
/// for divided depth.
/// Source: Hong & Oh 2018, Sec. 4.1
prism_fragment prism_fragment_at(prism_triangle v, float s_x, float s_y, float divided)
{
    float a = gnomon_prism_edge(v.b, v.c, s_x, s_y);
    float b = gnomon_prism_edge(v.c, v.a, s_x, s_y);
    float c = gnomon_prism_edge(v.a, v.b, s_x, s_y);
    float sides = (gnomon_prism_edge_side(v.b, v.c, a) + gnomon_prism_edge_side(v.c, v.a, b)) +
                  gnomon_prism_edge_side(v.a, v.b, c);
    float depth_a = a * gnomon_prism_depth_weight(v.a, divided);
    float depth_b = b * gnomon_prism_depth_weight(v.b, divided);
    float depth_c = c * gnomon_prism_depth_weight(v.c, divided);
    float depth = ((depth_a * v.a.z + depth_b * v.b.z) + depth_c * v.c.z) / ((depth_a + depth_b) + depth_c);
    float time_a = gnomon_product(a, v.a.inverse_w); // not contracted: a cap's time is exactly 0 or 1
    float time_b = gnomon_product(b, v.b.inverse_w);
    float time_c = gnomon_product(c, v.c.inverse_w);
    float weight = (time_a + time_b) + time_c;
    float size = gnomon_abs((a + b) + c); // inside all have one sign
    float limit = gnomon_moving_edge_limit;
    bool known = 0.0 < size && size < limit && 0.0 < gnomon_abs(weight) && gnomon_abs(weight) < limit;
    prism_fragment f;
    f.covered = gnomon_select(known && gnomon_abs(sides) == 3.0 && depth == depth, 1.0, 0.0);
    f.time = saturate_or_zero(((time_a * v.a.t + time_b * v.b.t) + time_c * v.c.t) / weight);
    f.depth = gnomon_max(gnomon_min(depth, 1.0), -1.0); // a NaN becomes 1
    return f;
}

/// The fragment b if chosen is 0, else a.
prism_fragment gnomon_prism_fragment_choice(float chosen, prism_fragment a, prism_fragment b)
{
    bool second = chosen == 0.0;
    prism_fragment r;
    r.covered = gnomon_select(second, b.covered, a.covered);
    r.time = gnomon_select(second, b.time, a.time);
    r.depth = gnomon_select(second, b.depth, a.depth);
    return r;
}

/// 1 if a is in front of b, or at the same depth and earlier; else 0.
float gnomon_prism_fragment_before(prism_fragment a, prism_fragment b)
{
    return gnomon_select(a.depth < b.depth || (a.depth == b.depth && a.time < b.time), 1.0, 0.0);
}

/// The state before the first fragment of the triangle with this id.
prism_pair prism_pair_begin(float id)
{
    prism_fragment none;
    none.covered = 0.0;
    none.time = 1.0;
    none.depth = prism_no_depth;
    prism_pair state;
    state.id = id;
    state.count = 0.0;
    state.earliest = none;
    state.latest = none;
    state.first = none;
    state.second = none;
    state.third = none;
    state.fourth = none;
    return state;
}

/// The state after one more fragment, in any order.
/// Domain: fragments that are covered, with time in [0, 1] and depth in [-1, 1]; others are ignored.
/// NaN: the fragment is ignored.
prism_pair prism_pair_add(prism_pair state, prism_fragment f)
{
    bool known = 0.0 <= f.time && f.time <= 1.0 && -1.0 <= f.depth && f.depth <= 1.0;
    bool some = 0.0 < f.covered && known;
    bool alone = state.count == 0.0;
    bool sooner = f.time < state.earliest.time || (f.time == state.earliest.time && f.depth < state.earliest.depth);
    bool later = state.latest.time < f.time || (f.time == state.latest.time && state.latest.depth < f.depth);
    float is_earliest = gnomon_select(some && (alone || sooner), 1.0, 0.0);
    float is_latest = gnomon_select(some && (alone || later), 1.0, 0.0);
    state.earliest = gnomon_prism_fragment_choice(is_earliest, f, state.earliest);
    state.latest = gnomon_prism_fragment_choice(is_latest, f, state.latest);
    state.count = state.count + gnomon_select(some, 1.0, 0.0);

    // Insertion into the sorted four: the farther of two goes on. An ignored fragment goes past all four.
    f.depth = gnomon_select(some, f.depth, prism_no_depth);
    f.time = gnomon_select(some, f.time, 1.0);
    float before = gnomon_prism_fragment_before(f, state.first);
    prism_fragment next = gnomon_prism_fragment_choice(before, state.first, f);
    state.first = gnomon_prism_fragment_choice(before, f, state.first);
    before = gnomon_prism_fragment_before(next, state.second);
    f = gnomon_prism_fragment_choice(before, state.second, next);
    state.second = gnomon_prism_fragment_choice(before, next, state.second);
    before = gnomon_prism_fragment_before(f, state.third);
    next = gnomon_prism_fragment_choice(before, state.third, f);
    state.third = gnomon_prism_fragment_choice(before, f, state.third);
    before = gnomon_prism_fragment_before(next, state.fourth);
    state.fourth = gnomon_prism_fragment_choice(before, next, state.fourth);
    return state;
}

/// The range between two fragments, in any order.
depth_time_range gnomon_prism_range_between(prism_fragment a, prism_fragment b, float id)
{
    return range_between(a.time, a.depth, b.time, b.depth, id);
}

/// The ranges of the fragments: between two fragments; of four, between the front two and between the rear two. The
/// paper does not treat other numbers, which occur if sides fold (six and more) and by rounding (odd numbers). A single
/// fragment does not tell how long the triangle stays and gives no range. Three, or more than four, give one range from
/// the earliest to the latest, so that no shadow is lost, though the range may last too long.
/// Source: Hong & Oh 2018, Sec. 4.3
prism_ranges prism_pair_end(prism_pair state)
{
    bool some = 1.0 < state.count;
    bool two = state.count == 4.0;
    depth_time_range whole = gnomon_prism_range_between(state.earliest, state.latest, state.id);
    depth_time_range front = gnomon_prism_range_between(state.first, state.second, state.id);
    depth_time_range rear = gnomon_prism_range_between(state.third, state.fourth, state.id);
    prism_ranges r;
    r.first = gnomon_range_select(some, gnomon_range_select(two, front, whole), range_empty(state.id));
    r.second = gnomon_range_select(two, rear, range_empty(state.id));
    r.count = gnomon_select(some, gnomon_select(two, 2.0, 1.0), 0.0);
    return r;
}

/// The size in bytes of a shadow map of prisms: 16 for a fragment (depth, time, id, link), 24 for a range (two times,
/// two depths, id, link), and 8 for a texel (the heads of its two lists).
/// Error: exact in float up to 2^27 bytes.
/// Source: Hong & Oh 2018, Eq. 2
float prism_map_bytes(float fragments, float ranges, float texels)
{
    return (16.0 * fragments + 24.0 * ranges) + 8.0 * texels;
}

#endif

#endif
