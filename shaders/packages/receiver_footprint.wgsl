// Gnomon 0.1.0, receiver_footprint.wgsl: shadow filtering in WGSL, this file alone.
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

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { x: f32, y: f32, t: f32, z: f32, d_x: f32, d_y: f32, d_z: f32, id: f32 }

const gnomon_stochastic_nothing: f32 = -1.0; // the id of the background
const gnomon_stratum_begin: f32 = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const gnomon_stratum_end: f32 = 0.999999523162841796875; // 1 - 2^-21

/// A sample of the background.
fn stochastic_background(x: f32, y: f32, t: f32) -> stochastic_sample
{
    var s: stochastic_sample;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0;
    s.d_x = 0.0;
    s.d_y = 0.0;
    s.d_z = 0.0;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
fn stratified_time(stratum: f32, count: f32, jitter: f32) -> f32
{
    var place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
fn slice_of(t: f32, count: f32) -> f32
{
    let slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

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

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
fn footprint_stratum(t: f32, count: f32) -> shutter_exposure
{
    let slice = slice_of(t, count);
    var r: shutter_exposure;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + 1.0) / count);
    return r;
}
