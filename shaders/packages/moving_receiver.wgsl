// Gnomon 0.1.0, moving_receiver.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
fn nearest_integer(x: f32) -> f32
{
    let rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
fn nearest_natural(x: f32) -> f32
{
    let rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.

const gnomon_texel_limit: f32 = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
fn texel_below(x: f32) -> f32
{
    let limit = gnomon_texel_limit;
    let inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    let whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
fn texel_weight(u: f32, i: f32, look_ups: f32) -> f32
{
    var share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

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

// motion/range/range_summary.h ----------------------------------------------------------------------------------------
// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
struct range_summary { nearest: f32, farthest: f32, shadowed: f32, id: f32 }

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
fn range_summary_begin(near_plane: f32) -> range_summary
{
    var summary: range_summary;
    summary.nearest = range_far;
    summary.farthest = near_plane;
    summary.shadowed = 0.0;
    summary.id = range_nothing;
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
fn range_summary_add(given_summary: range_summary, r: depth_time_range) -> range_summary
{
    var summary = given_summary;
    let some = r.t0_ < r.t1_ && r.z0_ == r.z0_ && r.z1_ == r.z1_;
    let first = summary.id == range_nothing;
    let nearest = gnomon_min(summary.nearest, gnomon_min(r.z0_, r.z1_));
    let farthest = gnomon_max(summary.farthest, gnomon_max(r.z0_, r.z1_));
    let share = saturate_or_zero(r.t1_) - saturate_or_zero(r.t0_);
    let id = gnomon_select(first || summary.id == r.id, r.id, range_mixed);
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
fn gnomon_range_is_second_layer(front: depth_time_range, r: depth_time_range) -> bool
{
    return front.t0_ <= r.t0_ && r.t0_ < front.t1_ && r.t1_ <= front.t1_;
}

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

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { w0_: f32, w1_: f32, w2_: f32, w3_: f32, w4_: f32, w5_: f32, w6_: f32, w7_: f32 }

/// Times at which a shutter opens and closes.
struct shutter_exposure { begin: f32, end: f32 }

const gnomon_shutter_weight_limit: f32 = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
fn gnomon_shutter_exposure_make(a: f32, b: f32) -> shutter_exposure
{
    let least = 0.00000095367431640625;
    let swapped = b < a;
    let open = gnomon_select(swapped, b, a);
    let close = gnomon_select(swapped, a, b);
    let brief = close - open < least;
    let early = gnomon_select(open <= 1.0, gnomon_min(open, 1.0 - least), open);
    var r: shutter_exposure;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
fn shutter_time(begin: f32, end: f32, share: f32) -> f32 { return begin * (1.0 - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_box(t: f32, begin: f32, end: f32) -> f32 { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_tent(t: f32, begin: f32, end: f32) -> f32
{
    let x = shutter_box(t, begin, end);
    let left = 1.0 - x;
    return gnomon_select(x < 0.5, 2.0 * (x * x), 1.0 - 2.0 * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
fn gnomon_shutter_weight(w: f32) -> f32 { return gnomon_select(0.0 < w, gnomon_min(w, gnomon_shutter_weight_limit),
                                                               0.0); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
fn gnomon_shutter_share(weight: f32, sum: f32) -> f32
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
fn shutter_line(t: f32, begin: f32, end: f32, w0: f32, w1: f32) -> f32
{
    let a = gnomon_shutter_weight(w0);
    let b = gnomon_shutter_weight(w1);
    let sum = a + b;
    let x = shutter_box(t, begin, end);
    let early = gnomon_select(0.0 < sum, saturate_or_zero(a / sum), 0.5);
    return saturate_or_zero(x * (early + (early * (1.0 - x) + (1.0 - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
fn shutter_weights_make(weights: shutter_weights) -> shutter_weights
{
    var w: shutter_weights;
    w.w0_ = gnomon_shutter_weight(weights.w0_);
    w.w1_ = gnomon_shutter_weight(weights.w1_);
    w.w2_ = gnomon_shutter_weight(weights.w2_);
    w.w3_ = gnomon_shutter_weight(weights.w3_);
    w.w4_ = gnomon_shutter_weight(weights.w4_);
    w.w5_ = gnomon_shutter_weight(weights.w5_);
    w.w6_ = gnomon_shutter_weight(weights.w6_);
    w.w7_ = gnomon_shutter_weight(weights.w7_);
    let sum = ((w.w0_ + w.w1_) + (w.w2_ + w.w3_)) + ((w.w4_ + w.w5_) + (w.w6_ + w.w7_));
    w.w0_ = gnomon_shutter_share(w.w0_, sum);
    w.w1_ = gnomon_shutter_share(w.w1_, sum);
    w.w2_ = gnomon_shutter_share(w.w2_, sum);
    w.w3_ = gnomon_shutter_share(w.w3_, sum);
    w.w4_ = gnomon_shutter_share(w.w4_, sum);
    w.w5_ = gnomon_shutter_share(w.w5_, sum);
    w.w6_ = gnomon_shutter_share(w.w6_, sum);
    w.w7_ = gnomon_shutter_share(w.w7_, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_piecewise(t: f32, begin: f32, end: f32, w: shutter_weights) -> f32
{
    let x = 8.0 * shutter_box(t, begin, end);
    let early = (w.w0_ * saturate_or_zero(x) + w.w1_ * saturate_or_zero(x - 1.0)) +
                (w.w2_ * saturate_or_zero(x - 2.0) + w.w3_ * saturate_or_zero(x - 3.0));
    let late = (w.w4_ * saturate_or_zero(x - 4.0) + w.w5_ * saturate_or_zero(x - 5.0)) +
               (w.w6_ * saturate_or_zero(x - 6.0) + w.w7_ * saturate_or_zero(x - 7.0));
    return gnomon_select(x < 8.0, saturate_or_zero(early + late), 1.0);
}

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

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
struct static_receiver { depth: f32, id: f32, begin: f32, end: f32, weight: f32, shadowed: f32 }

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of gnomon_shutter_exposure_make.
fn static_receiver_begin(z_f: f32, id: f32, begin: f32, end: f32) -> static_receiver
{
    let open = gnomon_shutter_exposure_make(begin, end);
    var r: static_receiver;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
fn static_receiver_set_weight(given_state: static_receiver, weight: f32) -> static_receiver
{
    var state = given_state;
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
fn static_receiver_occluding_part(state: static_receiver, r: depth_time_range) -> depth_time_range
{
    var level: depth_time_range;
    level.t0_ = state.begin;
    level.t1_ = state.end;
    level.z0_ = state.depth;
    level.z1_ = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
fn receiver_lost_light(hidden: depth_time_range, id: f32, share0: f32, share1: f32) -> f32
{
    return gnomon_select(hidden.id == id, 0.0, saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
fn static_receiver_add(given_state: static_receiver, lost: f32) -> static_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
fn receiver_is_in_front(z_f: f32, summary: range_summary) -> f32 { return gnomon_select(z_f <= summary.nearest, 1.0,
                                                                                        0.0); }

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
fn static_receiver_is_behind(state: static_receiver, summary: range_summary) -> f32
{
    let whole = state.begin <= 0.0 && 1.0 <= state.end;
    let own = summary.id == range_mixed || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, 1.0, 0.0);
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
fn static_receiver_end(state: static_receiver) -> f32 { return saturate_or_zero(state.shadowed); }

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

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
struct gnomon_moving_edge { e0_: f32, e1_: f32, e2_: f32 }

/// The edge functions opposite to the vertices a, b, c of a triangle.
struct gnomon_moving_edges { a: gnomon_moving_edge, b: gnomon_moving_edge, c: gnomon_moving_edge }

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are
/// gnomon_coverage_none. An empty set has begin 1 and end 0.
struct gnomon_edge_intervals { begin: f32, end: f32, gap_begin: f32, gap_end: f32 }

/// The times from begin to end; none unless begin < end.
struct gnomon_linear_interval { begin: f32, end: f32 }

/// Four numbers in ascending order.
struct gnomon_ordered4_ { first: f32, second: f32, third: f32, fourth: f32 }

/// Disjoint intervals in order, `count` of them; the others begin and end at gnomon_coverage_none.
struct coverage_intervals { count: f32, begin0_: f32, end0_: f32, begin1_: f32, end1_: f32, begin2_: f32, end2_: f32,
    begin3_: f32, end3_: f32 }

const gnomon_coverage_none: f32 = 2.0; // after the shutter has closed
const gnomon_moving_edge_limit: f32 = 1152921504606846976.0; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
fn moving_edge_at(e: gnomon_moving_edge, t: f32) -> f32
{
    let s = 1.0 - t;
    return (e.e0_ * s + e.e1_ * t) * s + (e.e1_ * s + e.e2_ * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
fn gnomon_moving_edge_size(e: gnomon_moving_edge) -> f32 { return (gnomon_abs(e.e0_) + gnomon_abs(e.e1_)) +
                                                                  gnomon_abs(e.e2_); }

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
fn moving_edge_inside(e: gnomon_moving_edge, facing: f32) -> gnomon_edge_intervals
{
    let side = gnomon_select(facing < 0.0, -1.0, 1.0);
    let c0 = side * e.e0_;
    let c1 = side * e.e1_;
    let c2 = side * e.e2_;
    var x: gnomon_edge_intervals;
    x.begin = 0.0;
    x.end = 1.0;
    x.gap_begin = gnomon_coverage_none;
    x.gap_end = gnomon_coverage_none;
    let before = c0 < 0.0; // outside at shutter open
    let after = c2 < 0.0;
    if (gnomon_any(before || after || c1 < 0.0)) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        let up = 0.0 < c1 || (c1 == 0.0 && before);
        let late = (before && !up) || (up && !before);
        let once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        var twice = !(once || late);
        let r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, 0.0));
        let q = gnomon_select(up, -1.0 * (c1 + r), r - c1);
        let first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        var second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && 0.0 < r;
            let gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        let some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, 0.0), 1.0);
        x.end = gnomon_select(some, gnomon_select(after, second, 1.0), 0.0);
    }
    let known = gnomon_moving_edge_size(e) < gnomon_moving_edge_limit;
    x.begin = gnomon_select(known, x.begin, 1.0);
    x.end = gnomon_select(known, x.end, 0.0);
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
fn linear_edge_inside(e0: f32, e2: f32) -> gnomon_linear_interval
{
    let before = e0 < 0.0;
    let after = e2 < 0.0;
    let change = e0 - e2;
    let never = (before && after) || !(gnomon_abs(change) < gnomon_moving_edge_limit);
    let root = gnomon_min(e0 / change, 1.0);
    var x: gnomon_linear_interval;
    x.begin = gnomon_select(never, 1.0, gnomon_select(before, root, 0.0));
    x.end = gnomon_select(never, 0.0, gnomon_select(after, root, 1.0));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
fn linear_coverage(e: gnomon_moving_edges) -> gnomon_linear_interval
{
    var a = linear_edge_inside(e.a.e0_, e.a.e2_);
    let b = linear_edge_inside(e.b.e0_, e.b.e2_);
    let c = linear_edge_inside(e.c.e0_, e.c.e2_);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
fn gnomon_ordered4_make(a: f32, b: f32, c: f32, d: f32) -> gnomon_ordered4_
{
    let low0 = gnomon_min(a, b);
    let high0 = gnomon_max(a, b);
    let low1 = gnomon_min(c, d);
    let high1 = gnomon_max(c, d);
    let middle0 = gnomon_max(low0, low1);
    let middle1 = gnomon_min(high0, high1);
    var x: gnomon_ordered4_;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
fn intersect_edge_intervals(given_a: gnomon_edge_intervals, given_b: gnomon_edge_intervals,
                            given_c: gnomon_edge_intervals) -> coverage_intervals
{
    var c = given_c;
    var b = given_b;
    var a = given_a;
    let begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), 0.0);
    let end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), 1.0);
    let none = gnomon_coverage_none;
    let some = begin < end;
    var x: coverage_intervals;
    x.count = gnomon_select(some, 1.0, 0.0);
    x.begin0_ = gnomon_select(some, begin, none);
    x.end0_ = gnomon_select(some, end, none);
    x.begin1_ = none;
    x.end1_ = none;
    x.begin2_ = none;
    x.end2_ = none;
    x.begin3_ = none;
    x.end3_ = none;
    let gap_a = a.gap_begin < none;
    let gap_b = b.gap_begin < none;
    let gap_c = c.gap_begin < none;
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
        var starts = gnomon_ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        var stops = gnomon_ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        let begin1 = gnomon_max(begin, stops.first);
        let begin2 = gnomon_max(begin, stops.second);
        let begin3 = gnomon_max(begin, stops.third);
        let end0 = gnomon_min(end, starts.first);
        let end1 = gnomon_min(end, starts.second);
        let end2 = gnomon_min(end, starts.third);
        let some0 = some && begin < end0;
        let some1 = some && begin1 < end1;
        let some2 = some && begin2 < end2;
        let some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = gnomon_ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                                      gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = gnomon_ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                                     gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, 1.0, 0.0) + gnomon_select(some1, 1.0, 0.0)) +
                  (gnomon_select(some2, 1.0, 0.0) + gnomon_select(some3, 1.0, 0.0));
        x.begin0_ = starts.first;
        x.end0_ = stops.first;
        x.begin1_ = starts.second;
        x.end1_ = stops.second;
        x.begin2_ = starts.third;
        x.end2_ = stops.third;
        x.begin3_ = starts.fourth;
        x.end3_ = stops.fourth;
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
fn moving_coverage(e: gnomon_moving_edges, facing: f32) -> coverage_intervals
{
    var a = moving_edge_inside(e.a, facing);
    let size = (gnomon_moving_edge_size(e.a) + gnomon_moving_edge_size(e.b)) + gnomon_moving_edge_size(e.c);
    a.end = gnomon_select(0.0 < size, a.end, 0.0);
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
fn coverage_duration(x: coverage_intervals) -> f32
{
    return saturate_or_zero(((x.end0_ - x.begin0_) + (x.end1_ - x.begin1_)) +
                            ((x.end2_ - x.begin2_) + (x.end3_ - x.begin3_)));
}

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

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
struct receiver_path
{
    depth: depth_time_range,
    x0_: f32, y0_: f32, w0_: f32, x1_: f32, y1_: f32, w1_: f32,
}

/// A position in texels, texel centres at +0.5.
struct gnomon_texel_position { x: f32, y: f32 }

const gnomon_receiver_sample_limit: f32 = 1048576.0; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
fn receiver_path_at(path: receiver_path, t: f32) -> gnomon_texel_position
{
    let passed = range_elapsed(path.depth, t);
    let left = 1.0 - passed;
    let w = path.w0_ * left + path.w1_ * passed;
    var r: gnomon_texel_position;
    r.x = (path.x0_ * left + path.x1_ * passed) / w;
    r.y = (path.y0_ * left + path.y1_ * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
fn receiver_path_shift(given_path: receiver_path, dx: f32, dy: f32) -> receiver_path
{
    var path = given_path;
    path.x0_ = path.x0_ + dx * path.w0_;
    path.y0_ = path.y0_ + dy * path.w0_;
    path.x1_ = path.x1_ + dx * path.w1_;
    path.y1_ = path.y1_ + dy * path.w1_;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
fn receiver_path_clip(path: receiver_path, begin: f32, end: f32) -> receiver_path
{
    let passed0 = range_elapsed(path.depth, begin);
    let passed1 = range_elapsed(path.depth, end);
    let left0 = 1.0 - passed0;
    let left1 = 1.0 - passed1;
    var c: receiver_path;
    c.depth = range_clip(path.depth, begin, end);
    c.x0_ = path.x0_ * left0 + path.x1_ * passed0;
    c.y0_ = path.y0_ * left0 + path.y1_ * passed0;
    c.w0_ = path.w0_ * left0 + path.w1_ * passed0;
    c.x1_ = path.x0_ * left1 + path.x1_ * passed1;
    c.y1_ = path.y0_ * left1 + path.y1_ * passed1;
    c.w1_ = path.w0_ * left1 + path.w1_ * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
fn receiver_path_length(path: receiver_path) -> f32
{
    let dx = path.x1_ / path.w1_ - path.x0_ / path.w0_;
    let dy = path.y1_ / path.w1_ - path.y0_ / path.w0_;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
fn receiver_sample_count(path: receiver_path, most: f32) -> f32
{
    let wanted = gnomon_max(2.0 * receiver_path_length(path), 5.0); // a NaN becomes 5
    let limit = gnomon_min(gnomon_max(most, 5.0), gnomon_receiver_sample_limit);
    let count = gnomon_min(wanted, limit);
    let whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, 1.0, 0.0);
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
fn receiver_sample_time(path: receiver_path, k: f32, n: f32, jitter: f32) -> f32
{
    let passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0_ * (1.0 - passed) + path.depth.t1_ * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
struct gnomon_sampled_receiver { samples: f32, shadowed: f32 }

/// Begin with the number of samples to come.
fn sampled_receiver_begin(samples: f32) -> gnomon_sampled_receiver
{
    var r: gnomon_sampled_receiver;
    r.samples = samples;
    r.shadowed = 0.0;
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
fn sampled_receiver_add(given_state: gnomon_sampled_receiver, intensity: f32) -> gnomon_sampled_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
fn sampled_receiver_end(state: gnomon_sampled_receiver) -> f32 { return saturate_or_zero(state.shadowed /
                                                                                         state.samples); }

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

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
struct texel_sweep
{
    path: receiver_path,
    column: f32, row: f32, t_begin: f32, t_end: f32, last_column: f32,
    last_row: f32, t_last: f32, across_column: f32, across_row: f32,
}

const gnomon_texel_path_limit: f32 = 1152921504606846976.0; // 2^60: positions that are numbers
const gnomon_texel_border_none: f32 = 2.0; // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
fn gnomon_texel_border_share(x0: f32, w0: f32, x1: f32, w1: f32, texel: f32, last: f32) -> f32
{
    let border = texel + gnomon_select(texel < last, 1.0, 0.0);
    let distance0 = x0 - gnomon_product(border, w0);
    let distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, gnomon_texel_border_none,
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
fn gnomon_texel_sweep_set_times(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let passed = gnomon_min(sweep.across_column, sweep.across_row);
    var t = sweep.path.depth.t0_ * (1.0 - passed) + sweep.path.depth.t1_ * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= 1.0, t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
fn gnomon_texel_sweep_start(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let p = sweep.path;
    sweep.across_column = gnomon_texel_border_share(p.x0_, p.w0_, p.x1_, p.w1_, sweep.column, sweep.last_column);
    sweep.across_row = gnomon_texel_border_share(p.y0_, p.w0_, p.y1_, p.w1_, sweep.row, sweep.last_row);
    return gnomon_texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
fn texel_sweep_begin(path: receiver_path) -> texel_sweep
{
    let x0 = path.x0_ / path.w0_;
    let y0 = path.y0_ / path.w0_;
    let x1 = path.x1_ / path.w1_;
    let y1 = path.y1_ / path.w1_;
    let size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    let known = 0.0 < path.w0_ && 0.0 < path.w1_ && size < gnomon_texel_path_limit;
    var sweep: texel_sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0_;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1_;
    return gnomon_texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
fn gnomon_receiver_path_over(p: receiver_path, left: f32, top: f32, right: f32, bottom: f32) -> gnomon_linear_interval
{
    var a = linear_edge_inside(p.x0_ - gnomon_product(left, p.w0_), p.x1_ - gnomon_product(left, p.w1_));
    let b = linear_edge_inside(p.y0_ - gnomon_product(top, p.w0_), p.y1_ - gnomon_product(top, p.w1_));
    let c = linear_edge_inside(gnomon_product(right, p.w0_) - p.x0_, gnomon_product(right, p.w1_) - p.x1_);
    let d = linear_edge_inside(gnomon_product(bottom, p.w0_) - p.y0_, gnomon_product(bottom, p.w1_) - p.y1_);
    let before_light = linear_edge_inside(p.w0_, p.w1_);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
fn gnomon_texel_clamp(x: f32, low: f32, high: f32) -> f32
{
    return gnomon_min(gnomon_max(texel_below(x), low - 1.0), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
fn texel_sweep_over(path: receiver_path, left: f32, top: f32, right: f32, bottom: f32) -> texel_sweep
{
    let shares = gnomon_receiver_path_over(path, left, top, right, bottom);
    let some = shares.begin < shares.end;
    let passed0 = gnomon_select(some, shares.begin, 0.0);
    let passed1 = gnomon_select(some, shares.end, 0.0);
    let left0 = 1.0 - passed0;
    let left1 = 1.0 - passed1;
    let w0 = path.w0_ * left0 + path.w1_ * passed0;
    let w1 = path.w0_ * left1 + path.w1_ * passed1;
    var sweep: texel_sweep;
    sweep.path = path;
    sweep.column = gnomon_texel_clamp((path.x0_ * left0 + path.x1_ * passed0) / w0, left, right);
    sweep.row = gnomon_texel_clamp((path.y0_ * left0 + path.y1_ * passed0) / w0, top, bottom);
    sweep.last_column = gnomon_texel_clamp((path.x0_ * left1 + path.x1_ * passed1) / w1, left, right);
    sweep.last_row = gnomon_texel_clamp((path.y0_ * left1 + path.y1_ * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0_ * left0 + path.depth.t1_ * passed0;
    sweep.t_last = path.depth.t0_ * left1 + path.depth.t1_ * passed1;
    return gnomon_texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
fn texel_sweep_next(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= 1.0;
    let along = sweep.across_row < sweep.across_column && sweep.across_row <= 1.0;
    let step_column = gnomon_select(sweep.column < sweep.last_column, 1.0, -1.0);
    let step_row = gnomon_select(sweep.row < sweep.last_row, 1.0, -1.0);
    sweep.column = sweep.column + gnomon_select(sideways, step_column, 0.0);
    sweep.row = sweep.row + gnomon_select(along, step_row, 0.0);
    // Only the axis that stepped has a new border.
    let x0 = gnomon_select(sideways, sweep.path.x0_, sweep.path.y0_);
    let x1 = gnomon_select(sideways, sweep.path.x1_, sweep.path.y1_);
    let texel = gnomon_select(sideways, sweep.column, sweep.row);
    let last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    let passed = gnomon_texel_border_share(x0, sweep.path.w0_, x1, sweep.path.w1_, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return gnomon_texel_sweep_set_times(sweep);
}

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

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
struct moving_receiver
{
    depth: depth_time_range,
    begin: f32, end: f32, t0_: f32, t1_: f32, u0_: f32, v0_: f32,
    u1_: f32, v1_: f32, shadowed: f32,
}

/// Begin without a texel. The exposure lasts from begin to end, as of gnomon_shutter_exposure_make. A depth bias, if
/// one is needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses
/// light only in that part: divide the result by the shutter's share of that part.
fn moving_receiver_begin(path: receiver_path, begin: f32, end: f32) -> moving_receiver
{
    let open = gnomon_shutter_exposure_make(begin, end);
    var r: moving_receiver;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0_ = path.depth.t0_;
    r.t1_ = path.depth.t1_;
    r.u0_ = 1.0;
    r.v0_ = 1.0;
    r.u1_ = 1.0;
    r.v1_ = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Begin the ranges of the sweep's texel.
fn moving_receiver_texel(given_state: moving_receiver, sweep: texel_sweep) -> moving_receiver
{
    var state = given_state;
    state.t0_ = sweep.t_begin;
    state.t1_ = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
fn moving_receiver_tap(given_state: moving_receiver, sweep: texel_sweep, i: f32, j: f32,
                       look_ups: f32) -> moving_receiver
{
    var state = given_state;
    let enters = receiver_path_at(sweep.path, sweep.t_begin);
    let leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0_ = sweep.t_begin;
    state.t1_ = sweep.t_end;
    state.u0_ = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0_ = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1_ = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1_ = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
fn moving_receiver_occluding_part(state: moving_receiver, r: depth_time_range) -> depth_time_range
{
    return range_occluding_part(r, state.depth, state.t0_, state.t1_);
}

/// Add the share of the light that is lost to one range.
fn moving_receiver_add(given_state: moving_receiver, lost: f32) -> moving_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + lost;
    return state;
}

const gnomon_receiver_twelfth: f32 = 0x1.555556p-4; // 0.083333333333333333333, Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
fn moving_receiver_filtered_light(state: moving_receiver, hidden: depth_time_range, start: f32, stop: f32,
                                  response: f32, slope: f32) -> f32
{
    let a = gnomon_max(hidden.t0_, start);
    let b = gnomon_min(hidden.t1_, stop);
    let some = a < b;
    var lost = 0.0;
    if (gnomon_any(some)) {
        let share_a = shutter_box(a, state.begin, state.end);
        let share_b = shutter_box(b, state.begin, state.end);
        let passed_a = saturate_or_zero((a - state.t0_) / (state.t1_ - state.t0_));
        let passed_b = saturate_or_zero((b - state.t0_) / (state.t1_ - state.t0_));
        let u_a = state.u0_ * (1.0 - passed_a) + state.u1_ * passed_a;
        let v_a = state.v0_ * (1.0 - passed_a) + state.v1_ * passed_a;
        let u_b = state.u0_ * (1.0 - passed_b) + state.u1_ * passed_b;
        let v_b = state.v0_ * (1.0 - passed_b) + state.v1_ * passed_b;
        let aa = u_a * v_a;
        let ab = u_a * v_b + u_b * v_a;
        let bb = u_b * v_b;
        let twelvefold = (response + slope * share_a) * (3.0 * aa + ab + bb) + (response + slope * share_b) *
                         (aa + ab + 3.0 * bb);
        let share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
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
fn moving_receiver_end(state: moving_receiver) -> f32 { return saturate_or_zero(state.shadowed); }
