// Gnomon 0.1.0, coverage_intervals.wgsl: shadow filtering in WGSL, this file alone.
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
