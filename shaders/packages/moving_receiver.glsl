// Gnomon 0.1.0, moving_receiver.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_MOVING_RECEIVER_GLSL
#define GNOMON_MOVING_RECEIVER_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: moving_receiver.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: moving_receiver.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: moving_receiver.glsl is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

const float gnomon_texel_limit = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

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

// motion/range/range_summary.h ----------------------------------------------------------------------------------------
// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel
#ifndef GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#define GNOMON_MOTION_RANGE_RANGE_SUMMARY_H

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
struct range_summary { float nearest, farthest, shadowed, id; };

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
range_summary range_summary_begin(float near_plane)
{
    range_summary summary;
    summary.nearest = range_far;
    summary.farthest = near_plane;
    summary.shadowed = 0.0;
    summary.id = range_nothing;
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
range_summary range_summary_add(range_summary summary, depth_time_range r)
{
    bool some = r.t0 < r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    bool first = summary.id == range_nothing;
    float nearest = gnomon_min(summary.nearest, gnomon_min(r.z0, r.z1));
    float farthest = gnomon_max(summary.farthest, gnomon_max(r.z0, r.z1));
    float share = saturate_or_zero(r.t1) - saturate_or_zero(r.t0);
    float id = gnomon_select(first || summary.id == r.id, r.id, range_mixed);
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
bool gnomon_range_is_second_layer(depth_time_range front, depth_time_range r)
{
    return front.t0 <= r.t0 && r.t0 < front.t1 && r.t1 <= front.t1;
}

#endif

// motion/receiver/shutter.h -------------------------------------------------------------------------------------------
// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that
// turns, a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// gnomon_shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { float w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
struct shutter_exposure { float begin, end; };

const float gnomon_shutter_weight_limit = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
shutter_exposure gnomon_shutter_exposure_make(float a, float b)
{
    float least = 0.00000095367431640625;
    bool swapped = b < a;
    float open = gnomon_select(swapped, b, a);
    float close = gnomon_select(swapped, a, b);
    bool brief = close - open < least;
    float early = gnomon_select(open <= 1.0, gnomon_min(open, 1.0 - least), open);
    shutter_exposure r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
float shutter_time(float begin, float end, float share) { return begin * (1.0 - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
float shutter_box(float t, float begin, float end) { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
float shutter_tent(float t, float begin, float end)
{
    float x = shutter_box(t, begin, end);
    float left = 1.0 - x;
    return gnomon_select(x < 0.5, 2.0 * (x * x), 1.0 - 2.0 * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
float gnomon_shutter_weight(float w) { return gnomon_select(0.0 < w, gnomon_min(w, gnomon_shutter_weight_limit), 0.0); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
float gnomon_shutter_share(float weight, float sum)
{
    return gnomon_select(0.0 < sum, saturate_or_zero(weight / sum), 0.125);
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
float shutter_line(float t, float begin, float end, float w0, float w1)
{
    float a = gnomon_shutter_weight(w0);
    float b = gnomon_shutter_weight(w1);
    float sum = a + b;
    float x = shutter_box(t, begin, end);
    float early = gnomon_select(0.0 < sum, saturate_or_zero(a / sum), 0.5);
    return saturate_or_zero(x * (early + (early * (1.0 - x) + (1.0 - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
shutter_weights shutter_weights_make(shutter_weights weights)
{
    shutter_weights w;
    w.w0 = gnomon_shutter_weight(weights.w0);
    w.w1 = gnomon_shutter_weight(weights.w1);
    w.w2 = gnomon_shutter_weight(weights.w2);
    w.w3 = gnomon_shutter_weight(weights.w3);
    w.w4 = gnomon_shutter_weight(weights.w4);
    w.w5 = gnomon_shutter_weight(weights.w5);
    w.w6 = gnomon_shutter_weight(weights.w6);
    w.w7 = gnomon_shutter_weight(weights.w7);
    float sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = gnomon_shutter_share(w.w0, sum);
    w.w1 = gnomon_shutter_share(w.w1, sum);
    w.w2 = gnomon_shutter_share(w.w2, sum);
    w.w3 = gnomon_shutter_share(w.w3, sum);
    w.w4 = gnomon_shutter_share(w.w4, sum);
    w.w5 = gnomon_shutter_share(w.w5, sum);
    w.w6 = gnomon_shutter_share(w.w6, sum);
    w.w7 = gnomon_shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
float shutter_piecewise(float t, float begin, float end, shutter_weights w)
{
    float x = 8.0 * shutter_box(t, begin, end);
    float early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - 1.0)) +
                  (w.w2 * saturate_or_zero(x - 2.0) + w.w3 * saturate_or_zero(x - 3.0));
    float late = (w.w4 * saturate_or_zero(x - 4.0) + w.w5 * saturate_or_zero(x - 5.0)) +
                 (w.w6 * saturate_or_zero(x - 6.0) + w.w7 * saturate_or_zero(x - 7.0));
    return gnomon_select(x < 8.0, saturate_or_zero(early + late), 1.0);
}

#endif

// motion/receiver/static_receiver.h -----------------------------------------------------------------------------------
// The shadow on a static receiver while the shutter is open, in closed form. Every range in front of the receiver
// occludes it for a time that is known in closed form, and the shutter (shutter.h) turns that time into a share of the
// light: exact, where stochastic shadow maps take samples. Ranges must not overlap in time, as in a resolved list; else
// the overlap counts twice. (Hong & Oh's shadow test, integrated over time; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     for every range of the texel:
//         hidden = static_receiver_occluding_part(state, range);
//         share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                    shutter_piecewise
//         state = static_receiver_add(state, receiver_lost_light(hidden, id, share0, share1));
//     intensity = static_receiver_end(state);
//
// Percentage-closer filtering of K x K bilinear look-ups around texel position (x, y) reads K + 1 texels along either
// axis. With x - K / 2 = column + u, column a whole number and u in [0, 1), and y alike, set the weight of texel
// (column + i, row + j), i and j from 0 to K, before its ranges:
//     state = static_receiver_set_weight(state, texel_weight(u, i, K) * texel_weight(v, j, K));
//
// A list may have a second layer (passes/range/resolve.hpp), for receivers whose own range is in front:
//     front = range_empty(range_nothing);
//     for every range of the texel, in order:
//         if gnomon_range_is_second_layer(front, range), leave range out unless front.id == id; else front = range
//
// A receiver behind all ranges of a texel, or in front of all, needs no list, only its summary (range_summary.h):
//     if (receiver_is_in_front(z_f, summary) > 0) nothing is added
//     if (static_receiver_is_behind(state, summary) > 0) state = static_receiver_add(state, summary.shadowed);
#ifndef GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
struct static_receiver { float depth, id, begin, end, weight, shadowed; };

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of gnomon_shutter_exposure_make.
static_receiver static_receiver_begin(float z_f, float id, float begin, float end)
{
    shutter_exposure open = gnomon_shutter_exposure_make(begin, end);
    static_receiver r;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
static_receiver static_receiver_set_weight(static_receiver state, float weight)
{
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
depth_time_range static_receiver_occluding_part(static_receiver state, depth_time_range r)
{
    depth_time_range level;
    level.t0 = state.begin;
    level.t1 = state.end;
    level.z0 = state.depth;
    level.z1 = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
float receiver_lost_light(depth_time_range hidden, float id, float share0, float share1)
{
    return gnomon_select(hidden.id == id, 0.0, saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
static_receiver static_receiver_add(static_receiver state, float lost)
{
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
float receiver_is_in_front(float z_f, range_summary summary) { return gnomon_select(z_f <= summary.nearest, 1.0, 0.0); }

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
float static_receiver_is_behind(static_receiver state, range_summary summary)
{
    bool whole = state.begin <= 0.0 && 1.0 <= state.end;
    bool own = summary.id == range_mixed || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, 1.0, 0.0);
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
float static_receiver_end(static_receiver state) { return saturate_or_zero(state.shadowed); }

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

// motion/receiver/receiver_path.h -------------------------------------------------------------------------------------
// The path of a receiver through the light's clip space while a pixel sees it, and its shadow by samples in time
// (Palmer 2011, 2.3.2 and 4.1).
//
// The receiver's point and the light move along straight lines, and the light does not turn, so x, y and w are linear
// in time. The point on the map, (x / w, y / w), moves along a straight line, too; w is 1 for an orthographic light.
// Depth is linear in view distance, hence linear in time: depth and time are those of a range.
//
//     n = receiver_sample_count(path, most);
//     state = sampled_receiver_begin(n);
//     for k from 0 to n - 1: t = receiver_sample_time(path, k, n, jitter); in the texel at receiver_path_at(path, t),
//     the largest range_intensity(range, t, range_depth(path.depth, t), path.depth.id, bias) of all ranges, then
//         state = sampled_receiver_add(state, largest);     or the mean of several texels by their weights
//     intensity = sampled_receiver_end(state);
#ifndef GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#define GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
struct receiver_path
{
    depth_time_range depth;
    float x0, y0, w0, x1, y1, w1;
};

/// A position in texels, texel centres at +0.5.
struct gnomon_texel_position { float x, y; };

const float gnomon_receiver_sample_limit = 1048576.0; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
gnomon_texel_position receiver_path_at(receiver_path path, float t)
{
    float passed = range_elapsed(path.depth, t);
    float left = 1.0 - passed;
    float w = path.w0 * left + path.w1 * passed;
    gnomon_texel_position r;
    r.x = (path.x0 * left + path.x1 * passed) / w;
    r.y = (path.y0 * left + path.y1 * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
receiver_path receiver_path_shift(receiver_path path, float dx, float dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
receiver_path receiver_path_clip(receiver_path path, float begin, float end)
{
    float passed0 = range_elapsed(path.depth, begin);
    float passed1 = range_elapsed(path.depth, end);
    float left0 = 1.0 - passed0;
    float left1 = 1.0 - passed1;
    receiver_path c;
    c.depth = range_clip(path.depth, begin, end);
    c.x0 = path.x0 * left0 + path.x1 * passed0;
    c.y0 = path.y0 * left0 + path.y1 * passed0;
    c.w0 = path.w0 * left0 + path.w1 * passed0;
    c.x1 = path.x0 * left1 + path.x1 * passed1;
    c.y1 = path.y0 * left1 + path.y1 * passed1;
    c.w1 = path.w0 * left1 + path.w1 * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
float receiver_path_length(receiver_path path)
{
    float dx = path.x1 / path.w1 - path.x0 / path.w0;
    float dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
float receiver_sample_count(receiver_path path, float most)
{
    float wanted = gnomon_max(2.0 * receiver_path_length(path), 5.0); // a NaN becomes 5
    float limit = gnomon_min(gnomon_max(most, 5.0), gnomon_receiver_sample_limit);
    float count = gnomon_min(wanted, limit);
    float whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, 1.0, 0.0);
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
float receiver_sample_time(receiver_path path, float k, float n, float jitter)
{
    float passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (1.0 - passed) + path.depth.t1 * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
struct gnomon_sampled_receiver { float samples, shadowed; };

/// Begin with the number of samples to come.
gnomon_sampled_receiver sampled_receiver_begin(float samples)
{
    gnomon_sampled_receiver r;
    r.samples = samples;
    r.shadowed = 0.0;
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
gnomon_sampled_receiver sampled_receiver_add(gnomon_sampled_receiver state, float intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
float sampled_receiver_end(gnomon_sampled_receiver state) { return saturate_or_zero(state.shadowed / state.samples); }

#endif

// motion/receiver/texel_sweep.h ---------------------------------------------------------------------------------------
// The texels that a moving receiver passes, in order, and the time that it spends in each (for the analytical dynamic
// receivers that Palmer 2011, chapter 5, leaves as future work; the traversal is that of Amanatides & Woo 1987, in time
// and in perspective).
//
// The path crosses the texel border x = c where x(t) - c w(t) = 0, which is linear in time, also in perspective. The
// share of the path's time at the crossing is
//     s = (x0 - c w0) / ((x0 - c w0) - (x1 - c w1))
// While w > 0, x / w is monotonic, so the path crosses the borders between its first and its last column one after the
// other, and those of rows alike. The earlier of the next two crossings is the next step. Texels come from counting
// steps, times from the borders. Where rounding makes two times equal, their steps come in either order, and the texel
// between them lasts no time.
//
//     sweep = texel_sweep_begin(path);
//     for each range of texel (sweep.column, sweep.row): use the part from sweep.t_begin to sweep.t_end
//     while (sweep.t_end < sweep.t_last) { sweep = texel_sweep_next(sweep); and the same again }
//
// For any path the times are contiguous from t0 to t1, bit for bit, and the loop ends after at most |last column -
// first column| + |last row - first row| + 1 texels.
//
// texel_sweep_over leaves out the parts of the path that are beside the map or behind the light. In homogeneous
// coordinates the map's borders are edges that the path crosses at one time each, also where w changes its sign.
#ifndef GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H
#define GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
struct texel_sweep
{
    receiver_path path;
    float column, row, t_begin, t_end, last_column, last_row, t_last, across_column, across_row;
};

const float gnomon_texel_path_limit = 1152921504606846976.0; // 2^60: positions that are numbers
const float gnomon_texel_border_none = 2.0;                  // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
float gnomon_texel_border_share(float x0, float w0, float x1, float w1, float texel, float last)
{
    float border = texel + gnomon_select(texel < last, 1.0, 0.0);
    float distance0 = x0 - gnomon_product(border, w0);
    float distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, gnomon_texel_border_none,
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
texel_sweep gnomon_texel_sweep_set_times(texel_sweep sweep)
{
    float passed = gnomon_min(sweep.across_column, sweep.across_row);
    float t = sweep.path.depth.t0 * (1.0 - passed) + sweep.path.depth.t1 * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= 1.0, t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
texel_sweep gnomon_texel_sweep_start(texel_sweep sweep)
{
    receiver_path p = sweep.path;
    sweep.across_column = gnomon_texel_border_share(p.x0, p.w0, p.x1, p.w1, sweep.column, sweep.last_column);
    sweep.across_row = gnomon_texel_border_share(p.y0, p.w0, p.y1, p.w1, sweep.row, sweep.last_row);
    return gnomon_texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
texel_sweep texel_sweep_begin(receiver_path path)
{
    float x0 = path.x0 / path.w0;
    float y0 = path.y0 / path.w0;
    float x1 = path.x1 / path.w1;
    float y1 = path.y1 / path.w1;
    float size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    bool known = 0.0 < path.w0 && 0.0 < path.w1 && size < gnomon_texel_path_limit;
    texel_sweep sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1;
    return gnomon_texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
gnomon_linear_interval gnomon_receiver_path_over(receiver_path p, float left, float top, float right, float bottom)
{
    gnomon_linear_interval a = linear_edge_inside(p.x0 - gnomon_product(left, p.w0), p.x1 - gnomon_product(left, p.w1));
    gnomon_linear_interval b = linear_edge_inside(p.y0 - gnomon_product(top, p.w0), p.y1 - gnomon_product(top, p.w1));
    gnomon_linear_interval c = linear_edge_inside(gnomon_product(right, p.w0) - p.x0, gnomon_product(right, p.w1) -
                                                  p.x1);
    gnomon_linear_interval d = linear_edge_inside(gnomon_product(bottom, p.w0) - p.y0, gnomon_product(bottom, p.w1) -
                                                  p.y1);
    gnomon_linear_interval before_light = linear_edge_inside(p.w0, p.w1);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
float gnomon_texel_clamp(float x, float low, float high)
{
    return gnomon_min(gnomon_max(texel_below(x), low - 1.0), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
texel_sweep texel_sweep_over(receiver_path path, float left, float top, float right, float bottom)
{
    gnomon_linear_interval shares = gnomon_receiver_path_over(path, left, top, right, bottom);
    bool some = shares.begin < shares.end;
    float passed0 = gnomon_select(some, shares.begin, 0.0);
    float passed1 = gnomon_select(some, shares.end, 0.0);
    float left0 = 1.0 - passed0;
    float left1 = 1.0 - passed1;
    float w0 = path.w0 * left0 + path.w1 * passed0;
    float w1 = path.w0 * left1 + path.w1 * passed1;
    texel_sweep sweep;
    sweep.path = path;
    sweep.column = gnomon_texel_clamp((path.x0 * left0 + path.x1 * passed0) / w0, left, right);
    sweep.row = gnomon_texel_clamp((path.y0 * left0 + path.y1 * passed0) / w0, top, bottom);
    sweep.last_column = gnomon_texel_clamp((path.x0 * left1 + path.x1 * passed1) / w1, left, right);
    sweep.last_row = gnomon_texel_clamp((path.y0 * left1 + path.y1 * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0 * left0 + path.depth.t1 * passed0;
    sweep.t_last = path.depth.t0 * left1 + path.depth.t1 * passed1;
    return gnomon_texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
texel_sweep texel_sweep_next(texel_sweep sweep)
{
    bool sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= 1.0;
    bool along = sweep.across_row < sweep.across_column && sweep.across_row <= 1.0;
    float step_column = gnomon_select(sweep.column < sweep.last_column, 1.0, -1.0);
    float step_row = gnomon_select(sweep.row < sweep.last_row, 1.0, -1.0);
    sweep.column = sweep.column + gnomon_select(sideways, step_column, 0.0);
    sweep.row = sweep.row + gnomon_select(along, step_row, 0.0);
    // Only the axis that stepped has a new border.
    float x0 = gnomon_select(sideways, sweep.path.x0, sweep.path.y0);
    float x1 = gnomon_select(sideways, sweep.path.x1, sweep.path.y1);
    float texel = gnomon_select(sideways, sweep.column, sweep.row);
    float last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    float passed = gnomon_texel_border_share(x0, sweep.path.w0, x1, sweep.path.w1, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return gnomon_texel_sweep_set_times(sweep);
}

#endif

// motion/receiver/moving_receiver.h -----------------------------------------------------------------------------------
// The shadow on a moving receiver while the shutter is open, in closed form: the Analytical Dynamic Receivers that
// Palmer 2011 leaves as future work (chapter 5). A texel sweep (texel_sweep.h) finds the texels that the receiver
// passes and the times that it spends in each. In each texel, a range of the resolved list is in front of the
// receiver's depth line for a time in closed form, as in static_receiver.h, which is the case of one texel and a level
// line. Exact except for rounding, where Palmer takes 2 samples for each texel.
//
//     state = moving_receiver_begin(path, begin, end);
//     for each texel of a texel sweep of the path: state = moving_receiver_texel(state, sweep);
//         for every range of the texel:
//             hidden = moving_receiver_occluding_part(state, range);
//             share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                        shutter_piecewise
//             state = moving_receiver_add(state, receiver_lost_light(hidden, path.depth.id, share0, share1));
//     intensity = moving_receiver_end(state);
//
// With filtering, the weight of a texel changes along the path. Between the centres of texels the bilinear weights of
// the receiver's position are products of two functions that are linear in time, and the response of a shutter is
// piecewise linear. So the light lost to a range is the integral of a product of three lines. Percentage-closer
// filtering of K x K bilinear look-ups (K = 1 is bilinear filtering alone):
//     for each texel of a texel sweep of receiver_path_shift(path, -K / 2, -K / 2), i and j from 0 to K:
//         state = moving_receiver_tap(state, sweep, i, j, K);
//         for every range of texel (column + i, row + j):
//             hidden = moving_receiver_occluding_part(state, range);
//             lost = moving_receiver_filtered_light(state, hidden, state.begin, state.end, 1, 0);   for a box; for a
//                 tent the sum for two halves of the exposure, for a piecewise shutter that for eight parts
//             state = moving_receiver_add(state, lost);
// The result is the mean of K x K receivers with bilinear filtering, each on the path shifted by whole texels.
#ifndef GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
struct moving_receiver
{
    depth_time_range depth;
    float begin, end, t0, t1, u0, v0, u1, v1, shadowed;
};

/// Begin without a texel. The exposure lasts from begin to end, as of gnomon_shutter_exposure_make. A depth bias, if
/// one is needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses
/// light only in that part: divide the result by the shutter's share of that part.
moving_receiver moving_receiver_begin(receiver_path path, float begin, float end)
{
    shutter_exposure open = gnomon_shutter_exposure_make(begin, end);
    moving_receiver r;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0 = path.depth.t0;
    r.t1 = path.depth.t1;
    r.u0 = 1.0;
    r.v0 = 1.0;
    r.u1 = 1.0;
    r.v1 = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Begin the ranges of the sweep's texel.
moving_receiver moving_receiver_texel(moving_receiver state, texel_sweep sweep)
{
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
moving_receiver moving_receiver_tap(moving_receiver state, texel_sweep sweep, float i, float j, float look_ups)
{
    gnomon_texel_position enters = receiver_path_at(sweep.path, sweep.t_begin);
    gnomon_texel_position leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    state.u0 = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0 = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1 = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1 = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
depth_time_range moving_receiver_occluding_part(moving_receiver state, depth_time_range r)
{
    return range_occluding_part(r, state.depth, state.t0, state.t1);
}

/// Add the share of the light that is lost to one range.
moving_receiver moving_receiver_add(moving_receiver state, float lost)
{
    state.shadowed = state.shadowed + lost;
    return state;
}

const float gnomon_receiver_twelfth = 0.083333333333333333333; // Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
float moving_receiver_filtered_light(moving_receiver state, depth_time_range hidden, float start, float stop,
                                     float response, float slope)
{
    float a = gnomon_max(hidden.t0, start);
    float b = gnomon_min(hidden.t1, stop);
    bool some = a < b;
    float lost = 0.0;
    if (gnomon_any(some)) {
        float share_a = shutter_box(a, state.begin, state.end);
        float share_b = shutter_box(b, state.begin, state.end);
        float passed_a = saturate_or_zero((a - state.t0) / (state.t1 - state.t0));
        float passed_b = saturate_or_zero((b - state.t0) / (state.t1 - state.t0));
        float u_a = state.u0 * (1.0 - passed_a) + state.u1 * passed_a;
        float v_a = state.v0 * (1.0 - passed_a) + state.v1 * passed_a;
        float u_b = state.u0 * (1.0 - passed_b) + state.u1 * passed_b;
        float v_b = state.v0 * (1.0 - passed_b) + state.v1 * passed_b;
        float aa = u_a * v_a;
        float ab = u_a * v_b + u_b * v_a;
        float bb = u_b * v_b;
        float twelvefold = (response + slope * share_a) * (3.0 * aa + ab + bb) + (response + slope * share_b) *
                           (aa + ab + 3.0 * bb);
        float share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
        lost = gnomon_select(some, share * twelvefold * gnomon_receiver_twelfth, lost);
    }
    return lost;
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range that of static_receiver_end, filtered with 97 2^-p instead of 32; and that of the times at
/// which the path enters and leaves texels (gnomon_texel_border_share), or of weights (receiver_path_at, and
/// moving_receiver_tap in perspective).
/// Source: Palmer 2011, Sec. 5
float moving_receiver_end(moving_receiver state) { return saturate_or_zero(state.shadowed); }

#endif

#endif
