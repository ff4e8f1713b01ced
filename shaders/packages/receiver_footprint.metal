// Gnomon 0.1.0, receiver_footprint.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RECEIVER_FOOTPRINT_METAL
#define GNOMON_RECEIVER_FOOTPRINT_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: receiver_footprint.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: receiver_footprint.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: receiver_footprint.metal is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

namespace gnomon {

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

namespace gnomon {

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
struct receiver_path
{
    depth_time_range depth;
    float x0, y0, w0, x1, y1, w1;
};

/// A position in texels, texel centres at +0.5.
struct texel_position { float x, y; };

constant constexpr float receiver_sample_limit = 1048576.0f; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
inline texel_position receiver_path_at(receiver_path path, float t)
{
    float passed = range_elapsed(path.depth, t);
    float left = 1.0f - passed;
    float w = path.w0 * left + path.w1 * passed;
    texel_position r;
    r.x = (path.x0 * left + path.x1 * passed) / w;
    r.y = (path.y0 * left + path.y1 * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
inline receiver_path receiver_path_shift(receiver_path path, float dx, float dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
inline receiver_path receiver_path_clip(receiver_path path, float begin, float end)
{
    float passed0 = range_elapsed(path.depth, begin);
    float passed1 = range_elapsed(path.depth, end);
    float left0 = 1.0f - passed0;
    float left1 = 1.0f - passed1;
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
inline float receiver_path_length(receiver_path path)
{
    float dx = path.x1 / path.w1 - path.x0 / path.w0;
    float dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
inline float receiver_sample_count(receiver_path path, float most)
{
    float wanted = gnomon_max(2.0f * receiver_path_length(path), 5.0f); // a NaN becomes 5
    float limit = gnomon_min(gnomon_max(most, 5.0f), receiver_sample_limit);
    float count = gnomon_min(wanted, limit);
    float whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, 1.0f, 0.0f);
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
inline float receiver_sample_time(receiver_path path, float k, float n, float jitter)
{
    float passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (1.0f - passed) + path.depth.t1 * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
struct sampled_receiver { float samples, shadowed; };

/// Begin with the number of samples to come.
inline sampled_receiver sampled_receiver_begin(float samples)
{
    sampled_receiver r;
    r.samples = samples;
    r.shadowed = 0.0f;
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
inline sampled_receiver sampled_receiver_add(sampled_receiver state, float intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
inline float sampled_receiver_end(sampled_receiver state) { return saturate_or_zero(state.shadowed / state.samples); }

} // namespace gnomon

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
// shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H

namespace gnomon {

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { float w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
struct shutter_exposure { float begin, end; };

constant constexpr float shutter_weight_limit = 1152921504606846976.0f; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
inline shutter_exposure shutter_exposure_make(float a, float b)
{
    float least = 0.00000095367431640625f;
    bool swapped = b < a;
    float open = gnomon_select(swapped, b, a);
    float close = gnomon_select(swapped, a, b);
    bool brief = close - open < least;
    float early = gnomon_select(open <= 1.0f, gnomon_min(open, 1.0f - least), open);
    shutter_exposure r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
inline float shutter_time(float begin, float end, float share) { return begin * (1.0f - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
inline float shutter_box(float t, float begin, float end) { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
inline float shutter_tent(float t, float begin, float end)
{
    float x = shutter_box(t, begin, end);
    float left = 1.0f - x;
    return gnomon_select(x < 0.5f, 2.0f * (x * x), 1.0f - 2.0f * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
inline float shutter_weight(float w) { return gnomon_select(0.0f < w, gnomon_min(w, shutter_weight_limit), 0.0f); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
inline float shutter_share(float weight, float sum)
{
    return gnomon_select(0.0f < sum, saturate_or_zero(weight / sum), 0.125f);
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
inline float shutter_line(float t, float begin, float end, float w0, float w1)
{
    float a = shutter_weight(w0);
    float b = shutter_weight(w1);
    float sum = a + b;
    float x = shutter_box(t, begin, end);
    float early = gnomon_select(0.0f < sum, saturate_or_zero(a / sum), 0.5f);
    return saturate_or_zero(x * (early + (early * (1.0f - x) + (1.0f - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
inline shutter_weights shutter_weights_make(shutter_weights weights)
{
    shutter_weights w;
    w.w0 = shutter_weight(weights.w0);
    w.w1 = shutter_weight(weights.w1);
    w.w2 = shutter_weight(weights.w2);
    w.w3 = shutter_weight(weights.w3);
    w.w4 = shutter_weight(weights.w4);
    w.w5 = shutter_weight(weights.w5);
    w.w6 = shutter_weight(weights.w6);
    w.w7 = shutter_weight(weights.w7);
    float sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = shutter_share(w.w0, sum);
    w.w1 = shutter_share(w.w1, sum);
    w.w2 = shutter_share(w.w2, sum);
    w.w3 = shutter_share(w.w3, sum);
    w.w4 = shutter_share(w.w4, sum);
    w.w5 = shutter_share(w.w5, sum);
    w.w6 = shutter_share(w.w6, sum);
    w.w7 = shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
inline float shutter_piecewise(float t, float begin, float end, shutter_weights w)
{
    float x = 8.0f * shutter_box(t, begin, end);
    float early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - 1.0f)) +
                  (w.w2 * saturate_or_zero(x - 2.0f) + w.w3 * saturate_or_zero(x - 3.0f));
    float late = (w.w4 * saturate_or_zero(x - 4.0f) + w.w5 * saturate_or_zero(x - 5.0f)) +
                 (w.w6 * saturate_or_zero(x - 6.0f) + w.w7 * saturate_or_zero(x - 7.0f));
    return gnomon_select(x < 8.0f, saturate_or_zero(early + late), 1.0f);
}

} // namespace gnomon

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

namespace gnomon {

constant constexpr float texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
inline float texel_below(float x)
{
    float limit = texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
    return saturate_or_zero(share / look_ups);
}

} // namespace gnomon

#endif

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

namespace gnomon {

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

constant constexpr float stochastic_nothing = -1.0f;               // the id of the background
// 1 + 2^-21: a time is so far from the ends of its stratum
constant constexpr float stratum_begin = 1.000000476837158203125f;
constant constexpr float stratum_end = 0.999999523162841796875f;   // 1 - 2^-21

/// A sample of the background.
inline stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0f;
    s.d_x = 0.0f;
    s.d_y = 0.0f;
    s.d_z = 0.0f;
    s.id = stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
inline float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0f) * stratum_end);
    place = gnomon_max(place, stratum * stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
inline float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0f), 0.0f);
}

} // namespace gnomon

#endif

// motion/layers/receiver_footprint.h ----------------------------------------------------------------------------------
// The time that one sample of a stochastic camera stands for. The camera takes N samples for each pixel, one in each
// stratum of the shutter interval. A look-up at the sample's own time is as noisy as the camera; the mean over the time
// that the sample stands for is not.
//
// During that time the point has to follow its surface (receiver_path.h). Held in place it would leave the surface,
// which then shadows it. With the path of the point and ranges, the mean is known in closed form:
//     exposure = footprint_stratum(t, N);
//     path = receiver_path_clip(path, exposure.begin, exposure.end);
//     moving_receiver_begin(path, exposure.begin, exposure.end), and so on (moving_receiver.h)
// The strata of a pixel's samples fill the shutter interval, so a point that its pixel sees all the time gets the mean
// over the whole interval, without noise and without bias.
#ifndef GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H
#define GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H

namespace gnomon {

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
inline shutter_exposure footprint_stratum(float t, float count)
{
    float slice = slice_of(t, count);
    shutter_exposure r;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + 1.0f) / count);
    return r;
}

} // namespace gnomon

#endif

#endif
