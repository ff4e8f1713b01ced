// Gnomon 0.1.0, range_front.wgsl: shadow filtering in WGSL, this file alone.
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
