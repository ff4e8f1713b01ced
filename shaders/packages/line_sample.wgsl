// Gnomon 0.1.0, line_sample.wgsl: shadow filtering in WGSL, this file alone.
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

// motion/receiver/line_sample.h ---------------------------------------------------------------------------------------
// Line samples (Gribel, Barringer & Akenine-Moller 2011): a texel of a shadow map sees the scene at one instant along a
// line through its centre, instead of at all times from its centre. Of a triangle the line sees intervals, which are
// known exactly, so a shadow's edge that crosses the line is where it is, and not at the border of a texel. Time is
// sampled: a map of lines is of one instant.
//
// Everything else is that of ranges in time, with the place on the line for the time. The line is one texel long: place
// 0 is at its begin, 1 at its end. A sample that goes along the line while the scene stands still sees what a sample
// that stands still sees of a scene that goes the other way:
//
//     triangle.a = line_sample_vertex(a, segment), b and c alike;       once for each instant
//     edges = moving_triangle_edges(triangle, s_x, s_y);             and coverage, depth, ranges, lists as of any
// triangle
//
// A receiver reads the line at its own place on it. Lines of one direction leave the other one sampled. So a map of
// lines along x and one along y are crossed: of the four points at the receiver's x on the lines above and below, and
// at its y on the lines to the left and to the right,
//
//     at = line_sample_place_of(x);      texel at.texel of the row below y - 1/2, and of the next, along x, and so for
// y
//     hidden = range_intensity(range, at.place, z, id, bias);        the greatest of the texel's list
//     intensity = line_sample_intensity(up, down, left, right, share_x, share_y);

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is
/// the centre of the texel.
struct line_sample { t: f32, along_x: f32, along_y: f32 }

/// A texel along a line's direction, and the place on its line, in [0, 1].
struct line_sample_place { texel: f32, place: f32 }

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
fn line_sample_vertex(v: gnomon_moving_vertex, segment: line_sample) -> gnomon_moving_vertex
{
    let s = 1.0 - segment.t;
    let x = v.x0_ * s + v.x1_ * segment.t;
    let y = v.y0_ * s + v.y1_ * segment.t;
    var r: gnomon_moving_vertex;
    r.z0_ = v.z0_ * s + v.z1_ * segment.t;
    r.w0_ = v.w0_ * s + v.w1_ * segment.t;
    r.z1_ = r.z0_;
    r.w1_ = r.w0_;
    let half_x = (0.5 * segment.along_x) * r.w0_;
    let half_y = (0.5 * segment.along_y) * r.w0_;
    r.x0_ = x + half_x;
    r.y0_ = y + half_y;
    r.x1_ = x - half_x;
    r.y1_ = y - half_y;
    return r;
}

/// The texel that holds a position along the direction of lines, and the place on its line.
/// Domain: positions in [-65536, 65536].
/// NaN: place 0.
/// Error: exact for positions not below 0; else 2^-p.
fn line_sample_place_of(x: f32) -> line_sample_place
{
    var r: line_sample_place;
    r.texel = texel_below(x);
    r.place = saturate_or_zero(x - r.texel);
    return r;
}

/// Shadow intensity in [0, 1] from those of four points around the receiver: up and down on lines along x, left and
/// right on lines along y. Two opposite points that agree decide, since a straight edge between them would part them;
/// up and down are first. Else the mean of both pairs, interpolated: share_y of the distance from up to down has passed
/// at the receiver, share_x of that from left to right.
/// Domain: intensities 0 or 1. Elsewhere a number in [0, 1].
/// NaN: 0 for the point, and 0 for a share.
/// Error: exact if two opposite points agree; else 8 2^-p.
/// Source: Gribel 2011
fn line_sample_intensity(up: f32, down: f32, left: f32, right: f32, share_x: f32, share_y: f32) -> f32
{
    let a = saturate_or_zero(up);
    let b = saturate_or_zero(down);
    let c = saturate_or_zero(left);
    let d = saturate_or_zero(right);
    let x = saturate_or_zero(share_x);
    let y = saturate_or_zero(share_y);
    let mean = 0.5 * ((a * (1.0 - y) + b * y) + (c * (1.0 - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
}
