// Gnomon 0.1.0, deep_shadow.wgsl: shadow filtering in WGSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.

// the language --------------------------------------------------------------------------------------------------------
// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no product is fused with a sum,
// neither of which WGSL can ask for (docs/shaders.md). Exact products stay whole in any case.

const gnomon_pivot_floor: f32 = 0x1p-30;

fn gnomon_select(mask: bool, a: f32, b: f32) -> f32 { return select(b, a, mask); }
fn gnomon_any(mask: bool) -> bool { return mask; }
fn gnomon_abs(a: f32) -> f32 { return abs(a); }
fn gnomon_sqrt(a: f32) -> f32 { return sqrt(a); }
// x, but nothing is fused, cancelled or reordered across a minimum of integers. Only bits of NaN are above this bound,
// which is one.
fn gnomon_kept(x: f32) -> f32 { return bitcast<f32>(min(bitcast<i32>(x), 0x7fc00000)); }
// x by another minimum, which hides one that is kept already.
fn gnomon_apart(x: f32) -> f32 { return bitcast<f32>(min(bitcast<u32>(x), 0xffc00000u)); }
fn gnomon_min(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a < b); }
fn gnomon_max(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a > b); }
fn gnomon_product(a: f32, b: f32) -> f32 { return gnomon_kept(a * b); }
fn gnomon_sum(a: f32, b: f32) -> f32 { return gnomon_kept(a + b); }
fn gnomon_difference(a: f32, b: f32) -> f32 { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
fn gnomon_saturate(x: f32) -> f32 {
    let bits = bitcast<i32>(x);
    return gnomon_select(bits > 0x7f800000, 0.0, bitcast<f32>(min(max(bits, 0), 0x3f800000)));
}
// a without the low half of its significand.
fn gnomon_high_part(a: f32) -> f32 { return bitcast<f32>(bitcast<u32>(a) & 0xfffff000u); }
// The sum has n in its low bits, and the shift moves n into the exponent.
fn gnomon_power_of_two(n: f32) -> f32 { return bitcast<f32>((bitcast<u32>(n + 12582912.0) << 23u) + 0x3f800000u); }

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
fn clamp_or_nan(x: f32, low: f32, high: f32) -> f32 { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
fn clamp_or_high(x: f32, low: f32, high: f32) -> f32 { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
fn saturate_or_zero(x: f32) -> f32 { return gnomon_saturate(x); }

// motion/range/range.h ------------------------------------------------------------------------------------------------
// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
struct depth_time_range { t0_: f32, t1_: f32, z0_: f32, z1_: f32, id: f32 }

const range_mixed: f32 = -1.0; // the id of a range of several surfaces: it shadows them all
const range_nothing: f32 = -2.0; // the id of a time without any surface
const range_far: f32 = 1152921504606846976.0; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
fn range_between(time_a: f32, z_a: f32, time_b: f32, z_b: f32, id: f32) -> depth_time_range
{
    let swapped = time_b < time_a;
    var r: depth_time_range;
    r.t0_ = gnomon_select(swapped, time_b, time_a);
    r.t1_ = gnomon_select(swapped, time_a, time_b);
    r.z0_ = gnomon_select(swapped, z_b, z_a);
    r.z1_ = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
fn range_empty(id: f32) -> depth_time_range
{
    var r: depth_time_range;
    r.t0_ = 1.0;
    r.t1_ = 0.0;
    r.z0_ = 1.0;
    r.z1_ = 1.0;
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
fn range_elapsed(r: depth_time_range, t: f32) -> f32 { return saturate_or_zero((t - r.t0_) / (r.t1_ - r.t0_)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
fn range_depth(r: depth_time_range, t: f32) -> f32
{
    let passed = range_elapsed(r, t);
    return gnomon_select(r.z0_ == r.z1_, r.z0_, r.z0_ * (1.0 - passed) + r.z1_ * passed);
}

/// Duration of the range, 0 if it is empty.
fn range_duration(r: depth_time_range) -> f32 { return gnomon_max(r.t1_ - r.t0_, 0.0); }

/// The part of r between the times begin and end, possibly empty.
fn range_clip(r: depth_time_range, begin: f32, end: f32) -> depth_time_range
{
    var c: depth_time_range;
    c.t0_ = gnomon_max(begin, r.t0_);
    c.t1_ = gnomon_min(end, r.t1_);
    c.z0_ = range_depth(r, c.t0_);
    c.z1_ = range_depth(r, c.t1_);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
fn gnomon_range_select(mask: bool, a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var r: depth_time_range;
    r.t0_ = gnomon_select(mask, a.t0_, b.t0_);
    r.t1_ = gnomon_select(mask, a.t1_, b.t1_);
    r.z0_ = gnomon_select(mask, a.z0_, b.z0_);
    r.z1_ = gnomon_select(mask, a.z1_, b.z1_);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
fn gnomon_range_keep_if(mask: bool, r: depth_time_range) -> depth_time_range
{
    return gnomon_range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
fn gnomon_range_less(a: depth_time_range, b: depth_time_range) -> bool
{
    let by_id = a.id < b.id;
    let by_z1 = a.z1_ < b.z1_ || (a.z1_ == b.z1_ && by_id);
    let by_z0 = a.z0_ < b.z0_ || (a.z0_ == b.z0_ && by_z1);
    let by_t1 = a.t1_ < b.t1_ || (a.t1_ == b.t1_ && by_z0);
    return a.t0_ < b.t0_ || (a.t0_ == b.t0_ && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
fn gnomon_range_occludes(a: depth_time_range, b: depth_time_range) -> bool
{
    let during = a.t0_ <= b.t0_ && b.t1_ <= a.t1_;
    let apart = gnomon_max(a.z0_, a.z1_) <= gnomon_min(b.z0_, b.z1_);
    let nearer = a.t0_ == b.t0_ && a.t1_ == b.t1_ && a.z0_ <= b.z0_ && a.z1_ <= b.z1_;
    let equal = nearer && a.z0_ == b.z0_ && a.z1_ == b.z1_;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
fn gnomon_range_clip_to(a: depth_time_range, b: depth_time_range) -> depth_time_range { return range_clip(a, b.t0_,
                                                                                                          b.t1_); }

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
fn gnomon_range_crossing(a: depth_time_range, b: depth_time_range) -> f32
{
    let distance0 = a.z0_ - b.z0_;
    let distance1 = a.z1_ - b.z1_;
    let passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0_ * (1.0 - passed) + a.t1_ * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
fn gnomon_range_visible_part(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    let near_a = gnomon_range_clip_to(a, b);
    let near_b = gnomon_range_clip_to(b, a);
    let before0 = near_b.z0_ - near_a.z0_;
    let before1 = near_b.z1_ - near_a.z1_;
    let tie = before0 == 0.0 && before1 == 0.0 && a.id < b.id;
    let first = 0.0 < before0 || (before0 == 0.0 && 0.0 < before1) || tie;
    let last = 0.0 < before1 || (before1 == 0.0 && 0.0 < before0) || tie;
    let crossing = clamp_or_nan(gnomon_range_crossing(near_a, near_b), near_a.t0_, near_a.t1_);
    let begin = gnomon_select(first, near_a.t0_, gnomon_select(last, crossing, 1.0));
    let end = gnomon_select(last, near_a.t1_, gnomon_select(first, crossing, 0.0));
    let some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0), gnomon_select(some, end, 0.0));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
fn gnomon_range_trim(r: depth_time_range, other: depth_time_range) -> depth_time_range
{
    let occluding = gnomon_range_visible_part(other, r);
    let some = occluding.t0_ < occluding.t1_;
    let begin = gnomon_select(some && occluding.t0_ <= r.t0_, occluding.t1_, r.t0_);
    let end = gnomon_select(some && r.t1_ <= occluding.t1_, occluding.t0_, r.t1_);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
fn range_occluding_part(r: depth_time_range, receiver: depth_time_range, begin: f32, end: f32) -> depth_time_range
{
    let early = gnomon_max(begin, r.t0_);
    let late = gnomon_min(end, r.t1_);
    // In most cases one of the two is in front at all times.
    let nearer = r.z0_ < receiver.z0_ && r.z0_ < receiver.z1_ && r.z1_ < receiver.z0_ && r.z1_ < receiver.z1_;
    let farther = receiver.z0_ <= r.z0_ && receiver.z0_ <= r.z1_ && receiver.z1_ <= r.z0_ && receiver.z1_ <= r.z1_;
    var front = early;
    var back = gnomon_select(farther, 0.0, late);
    let open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        let before0 = range_depth(receiver, early) - range_depth(r, early);
        let before1 = range_depth(receiver, late) - range_depth(r, late);
        let passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        let crossing = clamp_or_nan(early * (1.0 - passed) + late * passed, early, late);
        let first = gnomon_select(0.0 < before0, early, gnomon_select(0.0 < before1, crossing, 1.0));
        let last = gnomon_select(0.0 < before1, late, gnomon_select(0.0 < before0, crossing, 0.0));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    let some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, 1.0), gnomon_select(some, back, 0.0));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
fn range_intensity(r: depth_time_range, t: f32, z: f32, id: f32, bias: f32) -> f32
{
    let during = r.t0_ <= t && t <= r.t1_;
    let occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0, 0.0);
}

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

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
struct gnomon_deep_layer { z0_: f32, z1_: f32, opacity: f32 }

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
fn deep_shadow_add(transmittance: f32, layer: gnomon_deep_layer, z_f: f32) -> f32
{
    let passed = saturate_or_zero((z_f - layer.z0_) / (layer.z1_ - layer.z0_));
    return transmittance * (1.0 - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
fn deep_shadow_end(transmittance: f32) -> f32 { return saturate_or_zero(1.0 - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
fn deep_shadow_share(r: depth_time_range, z_f: f32) -> f32
{
    let c = range_clip(r, 0.0, 1.0);
    let nearest = gnomon_min(c.z0_, c.z1_);
    let passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0_, c.z1_) - nearest));
    let known = c.z0_ == c.z0_ && c.z1_ == c.z1_;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, 0.0));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if
/// the line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
struct gnomon_deep_window
{
    tolerance: f32, z0_: f32, v0_: f32, z1_: f32, v1_: f32, least: f32, most: f32, v: f32,
    touched: f32,
    layer: gnomon_deep_layer,
}

const gnomon_deep_window_steepest: f32 = 1099511627776.0; // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
fn deep_window_end(window: gnomon_deep_window) -> gnomon_deep_layer
{
    var r: gnomon_deep_layer;
    r.z0_ = window.z0_;
    r.z1_ = window.z1_;
    r.opacity = saturate_or_zero((window.v0_ - window.v1_) / window.v0_);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
fn gnomon_deep_window_next(given_window: gnomon_deep_window) -> gnomon_deep_window
{
    var window = given_window;
    window.layer = deep_window_end(window);
    window.z0_ = window.z1_;
    window.v0_ = window.v1_;
    window.least = -1.0 * gnomon_deep_window_steepest;
    window.most = 0.0;
    window.touched = 0.0;
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the
/// polyline. With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
fn deep_window_begin(tolerance: f32) -> gnomon_deep_window
{
    var r: gnomon_deep_window;
    r.tolerance = gnomon_max(tolerance, 0.0);
    r.z0_ = -1.0;
    r.v0_ = 1.0;
    r.z1_ = -1.0;
    r.v1_ = 1.0;
    r.v = 1.0;
    return gnomon_deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
fn gnomon_deep_window_lead(given_window: gnomon_deep_window, z: f32, v: f32) -> gnomon_deep_window
{
    var window = given_window;
    let length = z - window.z0_;
    let lowest = (gnomon_max(v - window.tolerance, 0.0) - window.v0_) / length;
    let highest = (v + window.tolerance - window.v0_) / length;
    let least = gnomon_max(window.least, lowest);
    let most = gnomon_min(window.most, highest);
    let nearest = saturate_or_zero(clamp_or_high(v, window.v0_ + least * length, window.v0_ + most * length));
    let level = window.touched < 1.0 && v == window.v && window.z1_ < z; // no line begins before a drop
    let step = length * gnomon_deep_window_steepest <= 1.0;
    let kept = level || (step && window.v0_ <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, 1.0, least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, 0.0, most));
    window.v1_ = gnomon_select(kept, window.v0_, gnomon_select(step, v, nearest));
    window.z0_ = gnomon_select(level, z, window.z0_);
    window.touched = gnomon_select(level, 0.0, 1.0);
    window.z1_ = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
fn gnomon_deep_window_select(mask: bool, a: gnomon_deep_window, given_b: gnomon_deep_window) -> gnomon_deep_window
{
    var b = given_b;
    b.z0_ = gnomon_select(mask, a.z0_, b.z0_);
    b.v0_ = gnomon_select(mask, a.v0_, b.v0_);
    b.z1_ = gnomon_select(mask, a.z1_, b.z1_);
    b.v1_ = gnomon_select(mask, a.v1_, b.v1_);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0_ = gnomon_select(mask, a.layer.z0_, b.layer.z0_);
    b.layer.z1_ = gnomon_select(mask, a.layer.z1_, b.layer.z1_);
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
fn deep_window_add(given_window: gnomon_deep_window, given_z: f32, given_v: f32) -> gnomon_deep_window
{
    var v = given_v;
    var z = given_z;
    var window = given_window;
    let known = gnomon_abs(z) < range_far && v == v;
    let touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1_), window.z1_);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = 0.0;
    var led = gnomon_deep_window_lead(window, z, v);
    let deeper = window.most < window.least && (z - window.z0_) * gnomon_deep_window_steepest <= 1.0;
    let done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) { led = gnomon_deep_window_select(done,
                                                            gnomon_deep_window_lead(gnomon_deep_window_next(window), z,
                                                                                    v), led); }
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
}
