// Gnomon 0.1.0, deep_shadow.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEEP_SHADOW_CL
#define GNOMON_DEEP_SHADOW_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: deep_shadow.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: deep_shadow.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: deep_shadow.cl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline float gnomon_abs(float a) { return fabs(a); }
static inline float gnomon_sqrt(float a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline float gnomon_kept(float x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline float gnomon_apart(float x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
static inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
static inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
static inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
static inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
static inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
static inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline float gnomon_saturate(float x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline float gnomon_high_part(float a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline float gnomon_power_of_two(float n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
static inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
static inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
static inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

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
typedef struct depth_time_range depth_time_range;
struct depth_time_range { float t0, t1, z0, z1, id; };

__constant float range_mixed = -1.0f;                // the id of a range of several surfaces: it shadows them all
__constant float range_nothing = -2.0f;              // the id of a time without any surface
__constant float range_far = 1152921504606846976.0f; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
static inline depth_time_range range_between(float time_a, float z_a, float time_b, float z_b, float id)
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
static inline depth_time_range range_empty(float id)
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
static inline float range_elapsed(depth_time_range r, float t) { return saturate_or_zero((t - r.t0) / (r.t1 - r.t0)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
static inline float range_depth(depth_time_range r, float t)
{
    float passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (1.0f - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
static inline float range_duration(depth_time_range r) { return gnomon_max(r.t1 - r.t0, 0.0f); }

/// The part of r between the times begin and end, possibly empty.
static inline depth_time_range range_clip(depth_time_range r, float begin, float end)
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
static inline depth_time_range gnomon_range_select(bool mask, depth_time_range a, depth_time_range b)
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
static inline depth_time_range gnomon_range_keep_if(bool mask, depth_time_range r)
{
    return gnomon_range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
static inline bool gnomon_range_less(depth_time_range a, depth_time_range b)
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
static inline bool gnomon_range_occludes(depth_time_range a, depth_time_range b)
{
    bool during = a.t0 <= b.t0 && b.t1 <= a.t1;
    bool apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    bool nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    bool equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
static inline depth_time_range gnomon_range_clip_to(depth_time_range a, depth_time_range b)
{
    return range_clip(a, b.t0, b.t1);
}

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
static inline float gnomon_range_crossing(depth_time_range a, depth_time_range b)
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
static inline depth_time_range gnomon_range_visible_part(depth_time_range a, depth_time_range b)
{
    depth_time_range near_a = gnomon_range_clip_to(a, b);
    depth_time_range near_b = gnomon_range_clip_to(b, a);
    float before0 = near_b.z0 - near_a.z0;
    float before1 = near_b.z1 - near_a.z1;
    bool tie = before0 == 0.0f && before1 == 0.0f && a.id < b.id;
    bool first = 0.0f < before0 || (before0 == 0.0f && 0.0f < before1) || tie;
    bool last = 0.0f < before1 || (before1 == 0.0f && 0.0f < before0) || tie;
    float crossing = clamp_or_nan(gnomon_range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    float begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, 1.0f));
    float end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, 0.0f));
    bool some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0f), gnomon_select(some, end, 0.0f));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
static inline depth_time_range gnomon_range_trim(depth_time_range r, depth_time_range other)
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
static inline depth_time_range range_occluding_part(depth_time_range r, depth_time_range receiver, float begin,
                                                    float end)
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
static inline float range_intensity(depth_time_range r, float t, float z, float id, float bias)
{
    bool during = r.t0 <= t && t <= r.t1;
    bool occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0f, 0.0f);
}

#endif

// motion/range/deep_shadow.h ------------------------------------------------------------------------------------------
// Deep shadow maps (Lokovic & Veach 2000): transmittance over depth for each texel, from 1 in front of all occluders to
// that behind them. What moves covers a texel for a part of the time, so motion counts as translucency: time is
// collapsed, which is right for static receivers under a static light and for no others.
//
// A deep layer takes away a share of the light, its opacity, evenly from depth z0 to depth z1, or at once if both are
// equal. Layers multiply, in any order:
//     transmittance = 1;   for every layer of the texel: transmittance = deep_shadow_add(transmittance, layer, z_f)
//     intensity = deep_shadow_end(transmittance);
//
// The layers of a texel come from its transmittance as a polyline over depth, which is compressed to a tolerance by a
// greedy window of slopes: one line goes on for as long as it passes all vertices within the tolerance.
//     window = deep_window_begin(tolerance);
//     for each vertex from near to far: window = deep_window_add(window, z, v), and keep window.layer
//     layer = deep_window_end(window), kept, too
// Layers of opacity 0 are not kept.
// The n sorted depths of samples have two vertices each: (z_k, 1 - k / n) and (z_k, 1 - (k + 1) / n), k from 0.
//
// With ever more samples the polyline becomes the one of a resolved list, in closed form: each range that covers the
// texel for a time takes that time's share of the light, evenly over its depths (deep_shadow_share). So lists of ranges
// give the deep map that samples converge to.
#ifndef GNOMON_MOTION_RANGE_DEEP_SHADOW_H
#define GNOMON_MOTION_RANGE_DEEP_SHADOW_H

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
typedef struct gnomon_deep_layer gnomon_deep_layer;
struct gnomon_deep_layer { float z0, z1, opacity; };

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
static inline float deep_shadow_add(float transmittance, gnomon_deep_layer layer, float z_f)
{
    float passed = saturate_or_zero((z_f - layer.z0) / (layer.z1 - layer.z0));
    return transmittance * (1.0f - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
static inline float deep_shadow_end(float transmittance) { return saturate_or_zero(1.0f - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
static inline float deep_shadow_share(depth_time_range r, float z_f)
{
    depth_time_range c = range_clip(r, 0.0f, 1.0f);
    float nearest = gnomon_min(c.z0, c.z1);
    float passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0, c.z1) - nearest));
    bool known = c.z0 == c.z0 && c.z1 == c.z1;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, 0.0f));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if
/// the line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
typedef struct gnomon_deep_window gnomon_deep_window;
struct gnomon_deep_window
{
    float tolerance, z0, v0, z1, v1, least, most, v, touched;
    gnomon_deep_layer layer;
};

__constant float gnomon_deep_window_steepest = 1099511627776.0f; // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
static inline gnomon_deep_layer deep_window_end(gnomon_deep_window window)
{
    gnomon_deep_layer r;
    r.z0 = window.z0;
    r.z1 = window.z1;
    r.opacity = saturate_or_zero((window.v0 - window.v1) / window.v0);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
static inline gnomon_deep_window gnomon_deep_window_next(gnomon_deep_window window)
{
    window.layer = deep_window_end(window);
    window.z0 = window.z1;
    window.v0 = window.v1;
    window.least = -1.0f * gnomon_deep_window_steepest;
    window.most = 0.0f;
    window.touched = 0.0f;
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the
/// polyline. With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
static inline gnomon_deep_window deep_window_begin(float tolerance)
{
    gnomon_deep_window r;
    r.tolerance = gnomon_max(tolerance, 0.0f);
    r.z0 = -1.0f;
    r.v0 = 1.0f;
    r.z1 = -1.0f;
    r.v1 = 1.0f;
    r.v = 1.0f;
    return gnomon_deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
static inline gnomon_deep_window gnomon_deep_window_lead(gnomon_deep_window window, float z, float v)
{
    float length = z - window.z0;
    float lowest = (gnomon_max(v - window.tolerance, 0.0f) - window.v0) / length;
    float highest = (v + window.tolerance - window.v0) / length;
    float least = gnomon_max(window.least, lowest);
    float most = gnomon_min(window.most, highest);
    float nearest = saturate_or_zero(clamp_or_high(v, window.v0 + least * length, window.v0 + most * length));
    bool level = window.touched < 1.0f && v == window.v && window.z1 < z; // no line begins before a drop
    bool step = length * gnomon_deep_window_steepest <= 1.0f;
    bool kept = level || (step && window.v0 <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, 1.0f, least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, 0.0f, most));
    window.v1 = gnomon_select(kept, window.v0, gnomon_select(step, v, nearest));
    window.z0 = gnomon_select(level, z, window.z0);
    window.touched = gnomon_select(level, 0.0f, 1.0f);
    window.z1 = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
static inline gnomon_deep_window gnomon_deep_window_select(bool mask, gnomon_deep_window a, gnomon_deep_window b)
{
    b.z0 = gnomon_select(mask, a.z0, b.z0);
    b.v0 = gnomon_select(mask, a.v0, b.v0);
    b.z1 = gnomon_select(mask, a.z1, b.z1);
    b.v1 = gnomon_select(mask, a.v1, b.v1);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0 = gnomon_select(mask, a.layer.z0, b.layer.z0);
    b.layer.z1 = gnomon_select(mask, a.layer.z1, b.layer.z1);
    b.layer.opacity = gnomon_select(mask, a.layer.opacity, b.layer.opacity);
    return b;
}

/// Add a vertex of the polyline, transmittance v at depth z; two at one depth are a step. If the layer of the result
/// has an opacity above 0 it is complete, and the caller keeps it.
/// Domain: vertices from near to far, transmittance in [0, 1] and never growing; others are moved to the nearest such.
/// Depths closer than 2^-40 count as equal.
/// NaN: the vertex is left out, as is one beyond 2^60.
/// Error: with all layers kept, the tolerance and 4 2^-p for each of them.
/// Source: Lokovic & Veach 2000
static inline gnomon_deep_window deep_window_add(gnomon_deep_window window, float z, float v)
{
    bool known = gnomon_abs(z) < range_far && v == v;
    float touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1), window.z1);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = 0.0f;
    gnomon_deep_window led = gnomon_deep_window_lead(window, z, v);
    bool deeper = window.most < window.least && (z - window.z0) * gnomon_deep_window_steepest <= 1.0f;
    bool done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) led = gnomon_deep_window_select(done,
                                                          gnomon_deep_window_lead(gnomon_deep_window_next(window), z,
                                                                                  v), led);
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
}

#endif

#endif
