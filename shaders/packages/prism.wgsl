// Gnomon 0.1.0, prism.wgsl: shadow filtering in WGSL, this file alone.
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

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
struct gnomon_moving_vertex { x0_: f32, y0_: f32, z0_: f32, w0_: f32, x1_: f32, y1_: f32, z1_: f32, w1_: f32 }

/// A triangle of three moving vertices.
struct moving_triangle { a: gnomon_moving_vertex, b: gnomon_moving_vertex, c: gnomon_moving_vertex }

/// A vertex relative to a sample, at shutter open and at shutter close.
struct gnomon_sheared_vertex { x0_: f32, y0_: f32, x1_: f32, y1_: f32 }

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
struct depth_line { z0_: f32, z1_: f32, deviation: f32 }

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
struct depth_piece { t0_: f32, t1_: f32, z0_: f32, z1_: f32, passed: f32 }

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
struct depth_trial
{
    piece: depth_piece,
    start: f32, share: f32, settled: f32,
}

/// Weights of a triangle's vertices; they need not sum to 1.
struct gnomon_corner_weights { a: f32, b: f32, c: f32 }

/// Bernstein coefficients of a cubic, the middle ones times 3.
struct gnomon_bernstein_cubic { c0_: f32, c1_: f32, c2_: f32, c3_: f32 }

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
fn gnomon_moving_vertex_shear(v: gnomon_moving_vertex, s_x: f32, s_y: f32) -> gnomon_sheared_vertex
{
    var r: gnomon_sheared_vertex;
    r.x0_ = v.x0_ - gnomon_product(s_x, v.w0_);
    r.y0_ = v.y0_ - gnomon_product(s_y, v.w0_);
    r.x1_ = v.x1_ - gnomon_product(s_x, v.w1_);
    r.y1_ = v.y1_ - gnomon_product(s_y, v.w1_);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
fn gnomon_sheared_cross(a_x: f32, a_y: f32, b_x: f32, b_y: f32) -> f32
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
fn gnomon_moving_edge_make(a: gnomon_sheared_vertex, b: gnomon_sheared_vertex) -> gnomon_moving_edge
{
    var e: gnomon_moving_edge;
    e.e0_ = gnomon_sheared_cross(a.x0_, a.y0_, b.x0_, b.y0_);
    e.e1_ = 0.5 * (gnomon_sheared_cross(a.x0_, a.y0_, b.x1_, b.y1_) + gnomon_sheared_cross(a.x1_, a.y1_, b.x0_, b.y0_));
    e.e2_ = gnomon_sheared_cross(a.x1_, a.y1_, b.x1_, b.y1_);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
fn moving_triangle_edges(m: moving_triangle, s_x: f32, s_y: f32) -> gnomon_moving_edges
{
    let a = gnomon_moving_vertex_shear(m.a, s_x, s_y);
    let b = gnomon_moving_vertex_shear(m.b, s_x, s_y);
    let c = gnomon_moving_vertex_shear(m.c, s_x, s_y);
    var e: gnomon_moving_edges;
    e.a = gnomon_moving_edge_make(b, c);
    e.b = gnomon_moving_edge_make(c, a);
    e.c = gnomon_moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
fn gnomon_corner_weights_at(e: gnomon_moving_edges, t: f32) -> gnomon_corner_weights
{
    var v: gnomon_corner_weights;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    let back = (v.a + v.b) + v.c < 0.0;
    v.a = gnomon_max(gnomon_select(back, -1.0 * v.a, v.a), 0.0);
    v.b = gnomon_max(gnomon_select(back, -1.0 * v.b, v.b), 0.0);
    v.c = gnomon_max(gnomon_select(back, -1.0 * v.c, v.c), 0.0);
    let vanished = (v.a + v.b) + v.c <= 0.0;
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
fn moving_depth_at(m: moving_triangle, e: gnomon_moving_edges, t: f32, divided: f32) -> f32
{
    let v = gnomon_corner_weights_at(e, t);
    let s = 1.0 - t;
    let z = (v.a * (m.a.z0_ * s + m.a.z1_ * t) + v.b * (m.b.z0_ * s + m.b.z1_ * t)) + v.c * (m.c.z0_ * s + m.c.z1_ * t);
    let w = (v.a * (m.a.w0_ * s + m.a.w1_ * t) + v.b * (m.b.w0_ * s + m.b.w1_ * t)) + v.c * (m.c.w0_ * s + m.c.w1_ * t);
    let divisor = gnomon_select(0.0 < divided, w, (v.a + v.b) + v.c);
    let depth = gnomon_max(gnomon_min(z / divisor, 1.0), -1.0); // a NaN becomes 1
    return gnomon_select(0.0 < w, depth, 1.0);
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
fn gnomon_depth_nonlinearity(most: f32, d0: f32, d3: f32, turn0: f32, turn1: f32) -> f32
{
    let negative = d0 < 0.0;
    let turn = gnomon_select(negative, -1.0 * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    let product = d0 * d3;
    let least = turn + 2.0 * gnomon_sqrt(product);
    let known = 0.0 < product && 0.0 < least && least < gnomon_moving_edge_limit;
    return gnomon_select(known, most / least, 4.0);
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
fn gnomon_depth_line_within(z0: f32, z1: f32, free0: f32, free1: f32, bend: f32, least: f32, most: f32) -> depth_line
{
    let beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    let all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    var r: depth_line;
    r.z0_ = z0;
    r.z1_ = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
fn gnomon_moving_edge_between(e: gnomon_moving_edge, begin: f32, end: f32) -> gnomon_moving_edge
{
    let left = 1.0 - end;
    var r: gnomon_moving_edge;
    r.e0_ = moving_edge_at(e, begin);
    r.e1_ = 2.0 * ((e.e0_ * left + e.e1_ * end) * (1.0 - begin) + (e.e1_ * left + e.e2_ * end) * begin);
    r.e2_ = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from gnomon_moving_edge_between, each times a linear function: from a0 to a1, from
/// b0 to b1, from c0 to c1.
fn gnomon_moving_edges_combine(e: gnomon_moving_edges, a0: f32, a1: f32, b0: f32, b1: f32, c0: f32,
                               c1: f32) -> gnomon_bernstein_cubic
{
    var r: gnomon_bernstein_cubic;
    r.c0_ = (e.a.e0_ * a0 + e.b.e0_ * b0) + e.c.e0_ * c0;
    r.c1_ = ((e.a.e0_ * a1 + e.a.e1_ * a0) + (e.b.e0_ * b1 + e.b.e1_ * b0)) + (e.c.e0_ * c1 + e.c.e1_ * c0);
    r.c2_ = ((e.a.e1_ * a1 + e.a.e2_ * a0) + (e.b.e1_ * b1 + e.b.e2_ * b0)) + (e.c.e1_ * c1 + e.c.e2_ * c0);
    r.c3_ = (e.a.e2_ * a1 + e.b.e2_ * b1) + e.c.e2_ * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
fn moving_depth_line(m: moving_triangle, e: gnomon_moving_edges, begin: f32, end: f32, divided: f32) -> depth_line
{
    let b = 1.0 - begin;
    let f = 1.0 - end;
    var x: gnomon_moving_edges;
    x.a = gnomon_moving_edge_between(e.a, begin, end);
    x.b = gnomon_moving_edge_between(e.b, begin, end);
    x.c = gnomon_moving_edge_between(e.c, begin, end);
    let n = gnomon_moving_edges_combine(x, m.a.z0_ * b + m.a.z1_ * begin, m.a.z0_ * f + m.a.z1_ * end, m.b.z0_ * b +
                                        m.b.z1_ * begin, m.b.z0_ * f + m.b.z1_ * end, m.c.z0_ * b + m.c.z1_ * begin,
                                        m.c.z0_ * f + m.c.z1_ * end);
    let a_w0 = m.a.w0_ * b + m.a.w1_ * begin;
    let a_w1 = m.a.w0_ * f + m.a.w1_ * end;
    let b_w0 = m.b.w0_ * b + m.b.w1_ * begin;
    let b_w1 = m.b.w0_ * f + m.b.w1_ * end;
    let c_w0 = m.c.w0_ * b + m.c.w1_ * begin;
    let c_w1 = m.c.w0_ * f + m.c.w1_ * end;
    let before = 0.0 < a_w0 && 0.0 < a_w1 && 0.0 < b_w0 && 0.0 < b_w1 && 0.0 < c_w0 && 0.0 < c_w1;
    let by_w = 0.0 < divided;
    let d = gnomon_moving_edges_combine(x, gnomon_select(by_w, a_w0, 1.0), gnomon_select(by_w, a_w1, 1.0),
                                        gnomon_select(by_w, b_w0, 1.0), gnomon_select(by_w, b_w1, 1.0),
                                        gnomon_select(by_w, c_w0, 1.0), gnomon_select(by_w, c_w1, 1.0));
    let free0 = n.c0_ / d.c0_;
    let free1 = n.c3_ / d.c3_;
    let turn0 = d.c1_ - d.c0_;
    let turn1 = d.c2_ - d.c3_;
    let p0 = (n.c1_ - free0 * turn0) - free1 * d.c0_;
    let p1 = (n.c1_ + n.c2_) - (free0 * d.c2_ + free1 * d.c1_);
    let p2 = (n.c2_ - free1 * turn1) - free0 * d.c3_;
    let most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), 0.5 * gnomon_abs(p1));
    let bend = gnomon_select(before, gnomon_depth_nonlinearity(most, d.c0_, d.c3_, turn0, turn1), 4.0);
    return gnomon_depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0,
                                    free1, bend, -1.0, 1.0);
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
fn gnomon_moving_depth_time(begin: f32, end: f32, passed: f32) -> f32
{
    return gnomon_select(passed < 1.0, begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
fn gnomon_depth_trial_begin(begin: f32, end: f32, passed: f32) -> depth_trial
{
    var r: depth_trial;
    r.start = saturate_or_zero(passed);
    r.share = 1.0 - r.start;
    r.settled = 0.0;
    r.piece.t0_ = gnomon_moving_depth_time(begin, end, r.start);
    r.piece.t1_ = end;
    r.piece.z0_ = 1.0;
    r.piece.z1_ = 1.0;
    r.piece.passed = 1.0;
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
fn gnomon_depth_trial_next(given_trial: depth_trial, fit: depth_line, begin: f32, end: f32,
                           tolerance: f32) -> depth_trial
{
    var trial = given_trial;
    let shortest = 0.0322265625;
    let fits = fit.deviation <= tolerance || trial.share <= shortest;
    let parts = gnomon_select(fit.deviation <= 4.0 * tolerance, 2.0, 3.0);
    let shorter = gnomon_max(trial.share / parts, shortest);
    let to = gnomon_min(trial.start + shorter, 1.0);
    trial.piece.z0_ = fit.z0_;
    trial.piece.z1_ = fit.z1_;
    trial.piece.t1_ = gnomon_select(fits, trial.piece.t1_, gnomon_moving_depth_time(begin, end, to));
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
fn moving_depth_piece(m: moving_triangle, e: gnomon_moving_edges, begin: f32, end: f32, passed: f32, divided: f32,
                      tolerance: f32) -> depth_piece
{
    var r = gnomon_depth_trial_begin(begin, end, passed);
    for (var i = 0; i < 6; i++) {
        if (gnomon_any(r.settled < 1.0)) { r = gnomon_depth_trial_next(r,
                                                                       moving_depth_line(m, e, r.piece.t0_, r.piece.t1_,
                                                                                         divided), begin, end,
                                                                       tolerance); }
    }
    return r.piece;
}

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

/// A vertex on the screen, with depth z, time t and inverse_w = 1 / w, which is 1 in orthographic views.
struct prism_vertex { x: f32, y: f32, z: f32, t: f32, inverse_w: f32 }

/// A triangle of a prism.
struct prism_triangle { a: prism_vertex, b: prism_vertex, c: prism_vertex }

/// The side that an edge sweeps: the vertex at its centre. crosses is 1 if the edge at open crosses the edge at close
/// there, else 0.
struct gnomon_prism_side
{
    centre: prism_vertex,
    crosses: f32,
}

/// The corners at shutter open (0) and at shutter close (1), and the sides of the three edges.
struct gnomon_prism
{
    a0_: prism_vertex, b0_: prism_vertex, c0_: prism_vertex, a1_: prism_vertex, b1_: prism_vertex,
    c1_: prism_vertex,
    ab: gnomon_prism_side, bc: gnomon_prism_side, ca: gnomon_prism_side,
}

/// A fragment: covered is 1 or 0, time is in [0, 1] and depth in [-1, 1].
struct prism_fragment { covered: f32, time: f32, depth: f32 }

/// The fragments of one triangle id in one texel: their number, the earliest, the latest, and the nearest four in
/// order.
struct prism_pair
{
    id: f32, count: f32,
    earliest: prism_fragment, latest: prism_fragment,
    first: prism_fragment, second: prism_fragment, third: prism_fragment, fourth: prism_fragment,
}

/// The ranges of a triangle in a texel, count of them, 0 to 2; the remaining ones are empty.
struct prism_ranges
{
    first: depth_time_range, second: depth_time_range,
    count: f32,
}

const prism_no_depth: f32 = 2.0; // behind every fragment

/// The vertex on the screen of a point in clip space at time t. divided is as for moving_depth_at. A vertex with w <= 0
/// or a NaN w produces no fragment.
fn gnomon_prism_vertex_make(x: f32, y: f32, z: f32, w: f32, t: f32, divided: f32) -> prism_vertex
{
    let divisor = gnomon_max(w, 0.0);
    var r: prism_vertex;
    r.x = x / divisor;
    r.y = y / divisor;
    r.z = gnomon_select(0.0 < divided, z / divisor, z);
    r.t = t;
    r.inverse_w = 1.0 / divisor;
    return r;
}

/// The vertex at shutter open.
fn gnomon_prism_vertex_open(v: gnomon_moving_vertex, divided: f32) -> prism_vertex
{
    return gnomon_prism_vertex_make(v.x0_, v.y0_, v.z0_, v.w0_, 0.0, divided);
}

/// The vertex at shutter close.
fn gnomon_prism_vertex_close(v: gnomon_moving_vertex, divided: f32) -> prism_vertex
{
    return gnomon_prism_vertex_make(v.x1_, v.y1_, v.z1_, v.w1_, 1.0, divided);
}

/// The factor of the screen weight in the interpolation of depth: 1 if depth is divided, else 1 / w, as for time.
fn gnomon_prism_depth_weight(v: prism_vertex, divided: f32) -> f32
{
    return gnomon_select(0.0 < divided, 1.0, v.inverse_w);
}

/// The vertex at the fraction `passed` of the way from a to b on the screen, at the time of a.
fn gnomon_prism_vertex_between(a: prism_vertex, b: prism_vertex, passed: f32, divided: f32) -> prism_vertex
{
    let left = 1.0 - passed;
    let weight_a = left * gnomon_prism_depth_weight(a, divided);
    let weight_b = passed * gnomon_prism_depth_weight(b, divided);
    var r: prism_vertex;
    r.x = a.x * left + b.x * passed;
    r.y = a.y * left + b.y * passed;
    r.z = (weight_a * a.z + weight_b * b.z) / (weight_a + weight_b);
    r.t = a.t;
    r.inverse_w = a.inverse_w * left + b.inverse_w * passed;
    return r;
}

/// The side that the edge from a to b sweeps. A centre without a crossing is the same, bit for bit, for b to a.
fn gnomon_prism_side_make(a: gnomon_moving_vertex, b: gnomon_moving_vertex, divided: f32) -> gnomon_prism_side
{
    let a0 = gnomon_prism_vertex_open(a, divided);
    let b0 = gnomon_prism_vertex_open(b, divided);
    let a1 = gnomon_prism_vertex_close(a, divided);
    let b1 = gnomon_prism_vertex_close(b, divided);
    let open_x = b0.x - a0.x;
    let open_y = b0.y - a0.y;
    let close_x = b1.x - a1.x;
    let close_y = b1.y - a1.y;
    let between_x = a1.x - a0.x;
    let between_y = a1.y - a0.y;
    let area = gnomon_sheared_cross(open_x, open_y, close_x, close_y);
    let s = gnomon_sheared_cross(between_x, between_y, close_x, close_y) / area;
    let u = gnomon_sheared_cross(between_x, between_y, open_x, open_y) / area;
    let crosses = 0.0 <= s && s <= 1.0 && 0.0 <= u && u <= 1.0; // false if area is 0

    // The mean in clip space, where the midpoint of the moving edge is.
    let x = 0.25 * ((a.x0_ + b.x0_) + (a.x1_ + b.x1_));
    let y = 0.25 * ((a.y0_ + b.y0_) + (a.y1_ + b.y1_));
    let z = 0.25 * ((a.z0_ + b.z0_) + (a.z1_ + b.z1_));
    let w = 0.25 * ((a.w0_ + b.w0_) + (a.w1_ + b.w1_));
    let middle = gnomon_prism_vertex_make(x, y, z, w, 0.5, divided);
    let open = gnomon_prism_vertex_between(a0, b0, s, divided);
    let close = gnomon_prism_vertex_between(a1, b1, u, divided);
    var r: gnomon_prism_side;
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
fn prism_make(m: moving_triangle, divided: f32) -> gnomon_prism
{
    var p: gnomon_prism;
    p.a0_ = gnomon_prism_vertex_open(m.a, divided);
    p.b0_ = gnomon_prism_vertex_open(m.b, divided);
    p.c0_ = gnomon_prism_vertex_open(m.c, divided);
    p.a1_ = gnomon_prism_vertex_close(m.a, divided);
    p.b1_ = gnomon_prism_vertex_close(m.b, divided);
    p.c1_ = gnomon_prism_vertex_close(m.c, divided);
    p.ab = gnomon_prism_side_make(m.a, m.b, divided);
    p.bc = gnomon_prism_side_make(m.b, m.c, divided);
    p.ca = gnomon_prism_side_make(m.c, m.a, divided);
    return p;
}

/// The vertex `first` for k <= 0, `second` for k = 1, else `third`.
fn gnomon_prism_choice(k: f32, first: prism_vertex, second: prism_vertex, third: prism_vertex) -> prism_vertex
{
    let is_first = k < 0.5;
    let is_second = k < 1.5;
    var r: prism_vertex;
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
fn prism_triangle_make(p: gnomon_prism, k: f32) -> prism_triangle
{
    let side = gnomon_select(k < 3.5, 0.0, gnomon_select(k < 7.5, 1.0, 2.0));
    let i = k - 4.0 * side;
    let from0 = gnomon_prism_choice(side, p.a0_, p.b0_, p.c0_);
    let to0 = gnomon_prism_choice(side, p.b0_, p.c0_, p.a0_);
    let to1 = gnomon_prism_choice(side, p.b1_, p.c1_, p.a1_);
    let from1 = gnomon_prism_choice(side, p.a1_, p.b1_, p.c1_);
    let crosses = gnomon_select(side < 0.5, p.ab.crosses, gnomon_select(side < 1.5, p.bc.crosses, p.ca.crosses));

    var r: prism_triangle;
    r.a = gnomon_prism_choice(i, from0, to0, gnomon_prism_choice(i - 2.0, to1, from1, from1));
    r.b = gnomon_prism_choice(i, to0, to1, gnomon_prism_choice(i - 2.0, from1, from0, from0));
    r.c = gnomon_prism_choice(side, p.ab.centre, p.bc.centre, p.ca.centre);
    let cap = k - 11.0;
    r.a = gnomon_prism_choice(cap, r.a, p.a0_, p.a1_);
    r.b = gnomon_prism_choice(cap, r.b, p.b0_, p.b1_);
    r.c = gnomon_prism_choice(cap, r.c, p.c0_, p.c1_);

    let odd = (0.5 < i && i < 1.5) || 2.5 < i;
    let none = (0.0 < crosses && k < 11.5 && !odd) || !(-0.5 < k && k < 13.5);
    let dropped = gnomon_select(none, 0.0, 1.0);
    r.b = gnomon_prism_choice(dropped, r.a, r.b, r.b);
    r.c = gnomon_prism_choice(dropped, r.a, r.c, r.c);
    return r;
}

/// The edge function of p and q at the sample (s_x, s_y).
fn gnomon_prism_edge(p: prism_vertex, q: prism_vertex, s_x: f32, s_y: f32) -> f32
{
    return gnomon_sheared_cross(p.x - s_x, p.y - s_y, q.x - s_x, q.y - s_y);
}

/// The side of the edge from p to q that the sample is on, 1 or -1, for edge function e. If e is 0, the side of a point
/// slightly further along x and, far less, along y. 0 for an edge without length.
fn gnomon_prism_edge_side(p: prism_vertex, q: prism_vertex, e: f32) -> f32
{
    let level = gnomon_select(q.x < p.x, -1.0, gnomon_select(p.x < q.x, 1.0, 0.0));
    let tie = gnomon_select(q.y < p.y, 1.0, gnomon_select(p.y < q.y, -1.0, level));
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
fn prism_fragment_at(v: prism_triangle, s_x: f32, s_y: f32, divided: f32) -> prism_fragment
{
    let a = gnomon_prism_edge(v.b, v.c, s_x, s_y);
    let b = gnomon_prism_edge(v.c, v.a, s_x, s_y);
    let c = gnomon_prism_edge(v.a, v.b, s_x, s_y);
    let sides = (gnomon_prism_edge_side(v.b, v.c, a) + gnomon_prism_edge_side(v.c, v.a, b)) +
                gnomon_prism_edge_side(v.a, v.b, c);
    let depth_a = a * gnomon_prism_depth_weight(v.a, divided);
    let depth_b = b * gnomon_prism_depth_weight(v.b, divided);
    let depth_c = c * gnomon_prism_depth_weight(v.c, divided);
    let depth = ((depth_a * v.a.z + depth_b * v.b.z) + depth_c * v.c.z) / ((depth_a + depth_b) + depth_c);
    let time_a = gnomon_product(a, v.a.inverse_w); // not contracted: a cap's time is exactly 0 or 1
    let time_b = gnomon_product(b, v.b.inverse_w);
    let time_c = gnomon_product(c, v.c.inverse_w);
    let weight = (time_a + time_b) + time_c;
    let size = gnomon_abs((a + b) + c); // inside all have one sign
    let limit = gnomon_moving_edge_limit;
    let known = 0.0 < size && size < limit && 0.0 < gnomon_abs(weight) && gnomon_abs(weight) < limit;
    var f: prism_fragment;
    f.covered = gnomon_select(known && gnomon_abs(sides) == 3.0 && depth == depth, 1.0, 0.0);
    f.time = saturate_or_zero(((time_a * v.a.t + time_b * v.b.t) + time_c * v.c.t) / weight);
    f.depth = gnomon_max(gnomon_min(depth, 1.0), -1.0); // a NaN becomes 1
    return f;
}

/// The fragment b if chosen is 0, else a.
fn gnomon_prism_fragment_choice(chosen: f32, a: prism_fragment, b: prism_fragment) -> prism_fragment
{
    let second = chosen == 0.0;
    var r: prism_fragment;
    r.covered = gnomon_select(second, b.covered, a.covered);
    r.time = gnomon_select(second, b.time, a.time);
    r.depth = gnomon_select(second, b.depth, a.depth);
    return r;
}

/// 1 if a is in front of b, or at the same depth and earlier; else 0.
fn gnomon_prism_fragment_before(a: prism_fragment, b: prism_fragment) -> f32
{
    return gnomon_select(a.depth < b.depth || (a.depth == b.depth && a.time < b.time), 1.0, 0.0);
}

/// The state before the first fragment of the triangle with this id.
fn prism_pair_begin(id: f32) -> prism_pair
{
    var none: prism_fragment;
    none.covered = 0.0;
    none.time = 1.0;
    none.depth = prism_no_depth;
    var state: prism_pair;
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
fn prism_pair_add(given_state: prism_pair, given_f: prism_fragment) -> prism_pair
{
    var f = given_f;
    var state = given_state;
    let known = 0.0 <= f.time && f.time <= 1.0 && -1.0 <= f.depth && f.depth <= 1.0;
    let some = 0.0 < f.covered && known;
    let alone = state.count == 0.0;
    let sooner = f.time < state.earliest.time || (f.time == state.earliest.time && f.depth < state.earliest.depth);
    let later = state.latest.time < f.time || (f.time == state.latest.time && state.latest.depth < f.depth);
    let is_earliest = gnomon_select(some && (alone || sooner), 1.0, 0.0);
    let is_latest = gnomon_select(some && (alone || later), 1.0, 0.0);
    state.earliest = gnomon_prism_fragment_choice(is_earliest, f, state.earliest);
    state.latest = gnomon_prism_fragment_choice(is_latest, f, state.latest);
    state.count = state.count + gnomon_select(some, 1.0, 0.0);

    // Insertion into the sorted four: the farther of two goes on. An ignored fragment goes past all four.
    f.depth = gnomon_select(some, f.depth, prism_no_depth);
    f.time = gnomon_select(some, f.time, 1.0);
    var before = gnomon_prism_fragment_before(f, state.first);
    var next = gnomon_prism_fragment_choice(before, state.first, f);
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
fn gnomon_prism_range_between(a: prism_fragment, b: prism_fragment, id: f32) -> depth_time_range
{
    return range_between(a.time, a.depth, b.time, b.depth, id);
}

/// The ranges of the fragments: between two fragments; of four, between the front two and between the rear two. The
/// paper does not treat other numbers, which occur if sides fold (six and more) and by rounding (odd numbers). A single
/// fragment does not tell how long the triangle stays and gives no range. Three, or more than four, give one range from
/// the earliest to the latest, so that no shadow is lost, though the range may last too long.
/// Source: Hong & Oh 2018, Sec. 4.3
fn prism_pair_end(state: prism_pair) -> prism_ranges
{
    let some = 1.0 < state.count;
    let two = state.count == 4.0;
    let whole = gnomon_prism_range_between(state.earliest, state.latest, state.id);
    let front = gnomon_prism_range_between(state.first, state.second, state.id);
    let rear = gnomon_prism_range_between(state.third, state.fourth, state.id);
    var r: prism_ranges;
    r.first = gnomon_range_select(some, gnomon_range_select(two, front, whole), range_empty(state.id));
    r.second = gnomon_range_select(two, rear, range_empty(state.id));
    r.count = gnomon_select(some, gnomon_select(two, 2.0, 1.0), 0.0);
    return r;
}

/// The size in bytes of a shadow map of prisms: 16 for a fragment (depth, time, id, link), 24 for a range (two times,
/// two depths, id, link), and 8 for a texel (the heads of its two lists).
/// Error: exact in float up to 2^27 bytes.
/// Source: Hong & Oh 2018, Eq. 2
fn prism_map_bytes(fragments: f32, ranges: f32, texels: f32) -> f32
{
    return (16.0 * fragments + 24.0 * ranges) + 8.0 * texels;
}
