// Gnomon 0.1.0, range_list.wgsl: shadow filtering in WGSL, this file alone.
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

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
struct range_front
{
    nearest: depth_time_range,
    begin: f32, unchanged: f32, end: f32,
}

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
fn gnomon_range_canonical(given_r: depth_time_range) -> depth_time_range
{
    var r = given_r;
    r.id = gnomon_max(r.id, range_mixed);
    let known = gnomon_abs(r.z0_) + gnomon_abs(r.z1_) < range_far;
    return gnomon_range_keep_if(0.0 <= r.t0_ && r.t0_ < r.t1_ && r.t1_ <= 1.0 && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
fn range_front_begin(t: f32) -> range_front
{
    var state: range_front;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(range_nothing);
    state.unchanged = 1.0;
    state.end = 1.0;
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
fn range_front_compare(given_state: range_front, given_r: depth_time_range) -> range_front
{
    var r = given_r;
    var state = given_state;
    r = gnomon_range_canonical(r);
    let front = state.nearest;
    let ahead = gnomon_range_visible_part(r, front);
    let during = r.t0_ <= state.begin && state.begin < r.t1_;
    let alone = front.t1_ <= front.t0_;
    let nearer = ahead.t0_ <= state.begin && state.begin < ahead.t1_;
    var change = gnomon_select(state.begin < ahead.t0_, ahead.t0_, gnomon_select(nearer, ahead.t1_, 1.0));
    change = gnomon_min(change, gnomon_min(front.t1_, r.t1_));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = gnomon_range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
fn range_front_limit(given_state: range_front, given_r: depth_time_range) -> range_front
{
    var r = given_r;
    var state = given_state;
    r = gnomon_range_canonical(r);
    let ahead = gnomon_range_visible_part(r, state.nearest);
    let some = state.nearest.t0_ < state.nearest.t1_;
    let next = gnomon_select(some, ahead.t0_, r.t0_);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons
    // do.
    let circle = ahead.t0_ <= state.begin && state.begin < ahead.t1_;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
fn range_front_span(state: range_front) -> depth_time_range
{
    let some = state.nearest.t0_ < state.nearest.t1_;
    let end = gnomon_min(gnomon_select(some, state.nearest.t1_, 1.0), state.end);
    var span = range_clip(state.nearest, state.begin, end);
    span.t0_ = state.begin;
    span.t1_ = end;
    return span;
}

// motion/range/range_merge.h ------------------------------------------------------------------------------------------
// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
struct range_pair
{
    merged: depth_time_range,
    gap: f32, shift: f32, cost: f32,
}

const gnomon_range_merge_margin: f32 = 0.000003814697265625; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
fn gnomon_range_hull(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var hull: depth_time_range;
    hull.t0_ = gnomon_min(a.t0_, b.t0_);
    hull.t1_ = gnomon_max(a.t1_, b.t1_);
    let nearer0 = gnomon_min(a.z0_, b.z0_);
    let nearer1 = gnomon_min(a.z1_, b.z1_);
    hull.z0_ = gnomon_select(a.t0_ < b.t0_, a.z0_, gnomon_select(b.t0_ < a.t0_, b.z0_, nearer0));
    hull.z1_ = gnomon_select(b.t1_ < a.t1_, a.z1_, gnomon_select(a.t1_ < b.t1_, b.z1_, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, range_mixed);
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
fn gnomon_range_merge(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var hull = gnomon_range_hull(a, b);
    var back = gnomon_max(gnomon_max(range_depth(hull, a.t0_) - a.z0_, range_depth(hull, a.t1_) - a.z1_),
                          gnomon_max(range_depth(hull, b.t0_) - b.z0_, range_depth(hull, b.t1_) - b.z1_));
    back = gnomon_max(back, 0.0);
    let size = gnomon_max(gnomon_max(gnomon_abs(a.z0_), gnomon_abs(a.z1_)),
                          gnomon_max(gnomon_abs(b.z0_), gnomon_abs(b.z1_)));
    let margin = size * gnomon_range_merge_margin;
    let level = gnomon_min(gnomon_min(a.z0_, b.z0_), gnomon_min(a.z1_, b.z1_));
    let sloped0 = hull.z0_ - back;
    let sloped1 = hull.z1_ - back;
    let slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < range_far;
    hull.z0_ = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1_ = gnomon_select(slopes, sloped1, level) - margin;

    let some_a = a.t0_ < a.t1_;
    let some_b = b.t0_ < b.t1_;
    return gnomon_range_select(some_a && some_b, hull, gnomon_range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
fn gnomon_range_area(r: depth_time_range) -> f32 { return range_duration(r) * (1.0 - 0.5 * (r.z0_ + r.z1_)); }

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
fn gnomon_range_distance(r: depth_time_range, nearer: depth_time_range) -> f32
{
    let distance0 = r.z0_ - range_depth(nearer, r.t0_);
    let distance1 = r.z1_ - range_depth(nearer, r.t1_);
    return gnomon_select(r.t0_ < r.t1_, gnomon_max(gnomon_max(distance0, distance1), 0.0), 0.0);
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
fn gnomon_range_pair_make(a: depth_time_range, b: depth_time_range) -> range_pair
{
    var p: range_pair;
    p.merged = gnomon_range_merge(a, b);
    let some = a.t0_ < a.t1_ && b.t0_ < b.t1_;
    let gap = gnomon_max(a.t0_, b.t0_) - gnomon_min(a.t1_, b.t1_);
    p.gap = gnomon_select(some, gnomon_max(gap, 0.0), 0.0);
    // Ignore the parts that the other range occludes: they were in shadow already.
    let shift = gnomon_max(gnomon_range_distance(gnomon_range_trim(a, b), p.merged),
                           gnomon_range_distance(gnomon_range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, 0.0);

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    let near_a = gnomon_range_clip_to(a, b);
    let near_b = gnomon_range_clip_to(b, a);
    let x0 = near_a.z0_ - near_b.z0_;
    let x1 = near_a.z1_ - near_b.z1_;
    let sum = gnomon_abs(x0) + gnomon_abs(x1);
    var apart = 0.5 * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(0.0 < sum, apart, 0.0);
    let middle = 0.25 * ((near_a.z0_ + near_a.z1_) + (near_b.z0_ + near_b.z1_));
    let both = range_duration(near_a) * (1.0 - (middle + 0.5 * apart));
    let area = gnomon_range_area(p.merged) - ((gnomon_range_area(a) + gnomon_range_area(b)) - both);
    let own_a = gnomon_select(a.id == p.merged.id, 0.0, range_duration(a));
    let own_b = gnomon_select(b.id == p.merged.id, 0.0, range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, 0.0) + (own_a + own_b), -1.0);
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
fn gnomon_range_pair_empty(r: depth_time_range) -> range_pair
{
    var p: range_pair;
    p.merged = r;
    p.gap = 0.0;
    p.shift = 0.0;
    p.cost = range_far * range_far;
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
fn gnomon_range_pair_cheaper(a: range_pair, b: range_pair) -> range_pair
{
    let cheaper = b.cost < a.cost;
    var p: range_pair;
    p.merged = gnomon_range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

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
// A list stores inserted ranges unchanged and drops those that another range provably occludes (gnomon_range_occludes).
// Until the list overflows, neither its contents nor its resolved form depend on the order of insertion or on rounding.
// On overflow it first drops ranges that several others jointly occlude. If there is still no room, it merges the two
// most similar ranges into one in front of both (gnomon_range_merge.h): shadows stay, and the shadow that merging adds
// is counted.
//
// Occluded ranges are dropped regardless of their ids. So a receiver gets the answer of all ranges, unless a range of
// its own id lies in front of it by more than its bias: that range does not shadow the receiver, and ranges that it
// occluded are no longer in the list. Hence one id should be a surface none of whose points is ever behind another: a
// triangle, a plane, the lit side of a convex part. With one id for a whole object, its far sides lose the shadows that
// other objects cast on them.
//
// The capacity is gnomon_range_capacity, if defined before inclusion, else 8. In C++ the capacity is a template
// parameter with this default.

const gnomon_range_capacity: i32 = 8;

/// Ranges in the order of gnomon_range_less, with empty ranges between them, and upper bounds of the cost of merging:
/// except for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
struct range_list
{
    ranges: array<depth_time_range, gnomon_range_capacity>,
    time_added: f32, depth_added: f32,
}

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
fn gnomon_range_offset(given_r: depth_time_range, side: f32) -> depth_time_range
{
    var r = given_r;
    let change = gnomon_abs(r.z1_ - r.z0_);
    let brief = gnomon_min(change * 0.000000476837158203125 / (r.t1_ - r.t0_), change);
    let by = side * (0.0000152587890625 + brief);
    r.z0_ = r.z0_ + by;
    r.z1_ = r.z1_ + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
fn gnomon_range_list_count_merge(given_list: range_list, p: range_pair) -> range_list
{
    var list = given_list;
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, 0.0);
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
fn gnomon_range_list_place(given_list: range_list, given_r: depth_time_range) -> range_list
{
    var r = given_r;
    var list = given_list;
    for (var i = 0; i + 1 < gnomon_range_capacity; i++) { // the first empty one goes to the end
        let s = list.ranges[i];
        let next = list.ranges[i + 1];
        let empty = s.t1_ <= s.t0_ && r.t0_ < r.t1_;
        list.ranges[i] = gnomon_range_select(empty, next, s);
        list.ranges[i + 1] = gnomon_range_select(empty, s, next);
    }
    for (var k = 0; k + 1 < gnomon_range_capacity; k++) {
        let s = list.ranges[k];
        let here = s.t0_ < s.t1_ && gnomon_range_less(r, s);
        list.ranges[k] = gnomon_range_select(here, r, s);
        r = gnomon_range_select(here, s, r);
    }
    let last = list.ranges[gnomon_range_capacity - 1];
    list.ranges[gnomon_range_capacity - 1] = gnomon_range_select(r.t0_ < r.t1_, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A
/// place of -1 is none.
fn gnomon_range_list_replace(given_list: range_list, full: bool, first: f32, second: f32,
                             given_merge: range_pair) -> range_list
{
    var merge = given_merge;
    var list = given_list;
    var place = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        let merged = full && (place == first || place == second);
        list.ranges[i] = gnomon_range_keep_if(!merged, list.ranges[i]);
        place = place + 1.0;
    }
    merge.merged = gnomon_range_keep_if(full, merge.merged);
    merge.gap = gnomon_select(full, merge.gap, 0.0);
    merge.shift = gnomon_select(full, merge.shift, 0.0);
    return gnomon_range_list_place(gnomon_range_list_count_merge(list, merge), merge.merged);
}

/// Insert r, clipped to times in [0, 1]. Without an overflow the ranges of the list do not depend on the order of
/// insertion, bit for bit, except for the sign of a zero. With an overflow they do, but at no time is the front farther
/// than that of all inserted ranges. That holds strictly, for exact depth lines, however steep and brief the ranges
/// are.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010; Hong & Oh 2017
fn range_list_insert(given_list: range_list, given_r: depth_time_range) -> range_list
{
    var r = given_r;
    var list = given_list;
    r = gnomon_range_canonical(range_clip(r, 0.0, 1.0));
    list = gnomon_range_list_count_merge(list, gnomon_range_pair_empty(r)); // counts that are NaN become 0
    var room = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        var s = gnomon_range_canonical(list.ranges[i]);
        r = gnomon_range_keep_if(!gnomon_range_occludes(s, r), r);
        s = gnomon_range_keep_if(!gnomon_range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0_ < s.t1_, room, 1.0);
    }
    let full = r.t0_ < r.t1_ && room < 1.0;
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        var occluders = list;
        for (var h = 0; h < gnomon_range_capacity; h++) { occluders.ranges[h] = gnomon_range_offset(list.ranges[h],
                                                                                                    1.0); }
        let farther = gnomon_range_offset(r, 1.0);
        for (var j = 0; j < gnomon_range_capacity; j++) {
            var s = gnomon_range_trim(gnomon_range_offset(list.ranges[j], -1.0), farther);
            for (var k = 0; k < gnomon_range_capacity; k++) { s = gnomon_range_trim(s, occluders.ranges[k]); }
            let seen = !full || s.t0_ < s.t1_;
            list.ranges[j] = gnomon_range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = gnomon_range_keep_if(seen, occluders.ranges[j]);
        }
        var left = gnomon_range_offset(r, -1.0);
        for (var m = 0; m < gnomon_range_capacity; m++) { left = gnomon_range_trim(left, occluders.ranges[m]); }
        r = gnomon_range_keep_if(!full || left.t0_ < left.t1_, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        var best = gnomon_range_pair_empty(r);
        var first = -1.0;
        var second = -1.0;
        var place = 0.0;
        for (var a = 0; a < gnomon_range_capacity; a++) {
            var other = r;
            var other_place = -1.0;
            for (var b = 0; b <= a; b++) {
                let pair = gnomon_range_pair_make(list.ranges[a], other);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = gnomon_range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + 1.0;
            }
            place = place + 1.0;
        }
        list = gnomon_range_list_replace(list, full, first, second, best);
        r = gnomon_range_keep_if(!(full && second < 0.0), r);
    }
    return gnomon_range_list_place(list, r);
}

/// The list of one range; an empty list if the range is empty.
fn range_list_make(r: depth_time_range) -> range_list
{
    var list: range_list;
    for (var i = 0; i < gnomon_range_capacity; i++) { list.ranges[i] = gnomon_range_keep_if(r.t0_ < r.t0_, r); }
    list.time_added = 0.0;
    list.depth_added = 0.0;
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
fn range_list_front(given_list: range_list, t: f32) -> depth_time_range
{
    var list = given_list;
    var state = range_front_begin(t);
    for (var i = 0; i < gnomon_range_capacity; i++) { state = range_front_compare(state, list.ranges[i]); }
    for (var k = 0; k < gnomon_range_capacity; k++) { state = range_front_limit(state, list.ranges[k]); }
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
fn gnomon_range_list_append(given_list: range_list, r: depth_time_range) -> range_list
{
    var list = given_list;
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    var best = gnomon_range_pair_empty(r);
    var at = 0.0;
    var place = 0.0;
    var next = r;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        let s = list.ranges[gnomon_range_capacity - 1 - i];
        let pair = gnomon_range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = gnomon_range_pair_cheaper(best, pair);
        next = s;
        place = place + 1.0;
    }
    place = 0.0;
    next = r;
    for (var k = 0; k < gnomon_range_capacity; k++) {
        let s = list.ranges[gnomon_range_capacity - 1 - k];
        let here = gnomon_range_select(place == at, best.merged, s);
        list.ranges[gnomon_range_capacity - 1 - k] = gnomon_range_select(place < at, next, here);
        next = s;
        place = place + 1.0;
    }
    return gnomon_range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
fn range_list_resolve(given_list: range_list) -> range_list
{
    var list = given_list;
    var t = 0.0;
    var resolved = list;
    for (var i = 0; i < gnomon_range_capacity; i++) { resolved.ranges[i] = gnomon_range_keep_if(t < t,
                                                                                                list.ranges[i]); }
    for (var k = 0; k < (gnomon_range_capacity + 1) * (gnomon_range_capacity + 2) / 2; k++) {
        if (gnomon_any(t < 1.0)) {
            let span = range_list_front(list, t);
            let some = range_nothing < span.id;
            resolved = gnomon_range_list_append(resolved, gnomon_range_keep_if(some, span));
            t = span.t1_;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
fn range_list_intensity(given_list: range_list, t: f32, z: f32, id: f32, bias: f32) -> f32
{
    var list = given_list;
    var intensity = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) { intensity = gnomon_max(intensity,
                                                                             range_intensity(list.ranges[i], t, z, id,
                                                                                             bias)); }
    return intensity;
}
