// Gnomon 0.1.0, line_sample.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LINE_SAMPLE_CL
#define GNOMON_LINE_SAMPLE_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: line_sample.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: line_sample.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: line_sample.cl is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
static inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
static inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

__constant float gnomon_texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
static inline float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
static inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
    return saturate_or_zero(share / look_ups);
}

#endif

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
#ifndef GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H
#define GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
typedef struct gnomon_moving_edge gnomon_moving_edge;
struct gnomon_moving_edge { float e0, e1, e2; };

/// The edge functions opposite to the vertices a, b, c of a triangle.
typedef struct gnomon_moving_edges gnomon_moving_edges;
struct gnomon_moving_edges { gnomon_moving_edge a, b, c; };

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are
/// gnomon_coverage_none. An empty set has begin 1 and end 0.
typedef struct gnomon_edge_intervals gnomon_edge_intervals;
struct gnomon_edge_intervals { float begin, end, gap_begin, gap_end; };

/// The times from begin to end; none unless begin < end.
typedef struct gnomon_linear_interval gnomon_linear_interval;
struct gnomon_linear_interval { float begin, end; };

/// Four numbers in ascending order.
typedef struct gnomon_ordered4 gnomon_ordered4;
struct gnomon_ordered4 { float first, second, third, fourth; };

/// Disjoint intervals in order, `count` of them; the others begin and end at gnomon_coverage_none.
typedef struct coverage_intervals coverage_intervals;
struct coverage_intervals { float count, begin0, end0, begin1, end1, begin2, end2, begin3, end3; };

__constant float gnomon_coverage_none = 2.0f;                       // after the shutter has closed
__constant float gnomon_moving_edge_limit = 1152921504606846976.0f; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
static inline float moving_edge_at(gnomon_moving_edge e, float t)
{
    float s = 1.0f - t;
    return (e.e0 * s + e.e1 * t) * s + (e.e1 * s + e.e2 * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
static inline float gnomon_moving_edge_size(gnomon_moving_edge e)
{
    return (gnomon_abs(e.e0) + gnomon_abs(e.e1)) + gnomon_abs(e.e2);
}

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
static inline gnomon_edge_intervals moving_edge_inside(gnomon_moving_edge e, float facing)
{
    float side = gnomon_select(facing < 0.0f, -1.0f, 1.0f);
    float c0 = side * e.e0;
    float c1 = side * e.e1;
    float c2 = side * e.e2;
    gnomon_edge_intervals x;
    x.begin = 0.0f;
    x.end = 1.0f;
    x.gap_begin = gnomon_coverage_none;
    x.gap_end = gnomon_coverage_none;
    bool before = c0 < 0.0f; // outside at shutter open
    bool after = c2 < 0.0f;
    if (gnomon_any(before || after || c1 < 0.0f)) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        bool up = 0.0f < c1 || (c1 == 0.0f && before);
        bool late = (before && !up) || (up && !before);
        bool once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        bool twice = !(once || late);
        float r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, 0.0f));
        float q = gnomon_select(up, -1.0f * (c1 + r), r - c1);
        float first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        float second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && 0.0f < r;
            bool gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        bool some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, 0.0f), 1.0f);
        x.end = gnomon_select(some, gnomon_select(after, second, 1.0f), 0.0f);
    }
    bool known = gnomon_moving_edge_size(e) < gnomon_moving_edge_limit;
    x.begin = gnomon_select(known, x.begin, 1.0f);
    x.end = gnomon_select(known, x.end, 0.0f);
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
static inline gnomon_linear_interval linear_edge_inside(float e0, float e2)
{
    bool before = e0 < 0.0f;
    bool after = e2 < 0.0f;
    float change = e0 - e2;
    bool never = (before && after) || !(gnomon_abs(change) < gnomon_moving_edge_limit);
    float root = gnomon_min(e0 / change, 1.0f);
    gnomon_linear_interval x;
    x.begin = gnomon_select(never, 1.0f, gnomon_select(before, root, 0.0f));
    x.end = gnomon_select(never, 0.0f, gnomon_select(after, root, 1.0f));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
static inline gnomon_linear_interval linear_coverage(gnomon_moving_edges e)
{
    gnomon_linear_interval a = linear_edge_inside(e.a.e0, e.a.e2);
    gnomon_linear_interval b = linear_edge_inside(e.b.e0, e.b.e2);
    gnomon_linear_interval c = linear_edge_inside(e.c.e0, e.c.e2);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
static inline gnomon_ordered4 gnomon_ordered4_make(float a, float b, float c, float d)
{
    float low0 = gnomon_min(a, b);
    float high0 = gnomon_max(a, b);
    float low1 = gnomon_min(c, d);
    float high1 = gnomon_max(c, d);
    float middle0 = gnomon_max(low0, low1);
    float middle1 = gnomon_min(high0, high1);
    gnomon_ordered4 x;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
static inline coverage_intervals intersect_edge_intervals(gnomon_edge_intervals a, gnomon_edge_intervals b,
                                                          gnomon_edge_intervals c)
{
    float begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), 0.0f);
    float end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), 1.0f);
    float none = gnomon_coverage_none;
    bool some = begin < end;
    coverage_intervals x;
    x.count = gnomon_select(some, 1.0f, 0.0f);
    x.begin0 = gnomon_select(some, begin, none);
    x.end0 = gnomon_select(some, end, none);
    x.begin1 = none;
    x.end1 = none;
    x.begin2 = none;
    x.end2 = none;
    x.begin3 = none;
    x.end3 = none;
    bool gap_a = a.gap_begin < none;
    bool gap_b = b.gap_begin < none;
    bool gap_c = c.gap_begin < none;
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
        gnomon_ordered4 starts = gnomon_ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        gnomon_ordered4 stops = gnomon_ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        float begin1 = gnomon_max(begin, stops.first);
        float begin2 = gnomon_max(begin, stops.second);
        float begin3 = gnomon_max(begin, stops.third);
        float end0 = gnomon_min(end, starts.first);
        float end1 = gnomon_min(end, starts.second);
        float end2 = gnomon_min(end, starts.third);
        bool some0 = some && begin < end0;
        bool some1 = some && begin1 < end1;
        bool some2 = some && begin2 < end2;
        bool some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = gnomon_ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                                      gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = gnomon_ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                                     gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, 1.0f, 0.0f) + gnomon_select(some1, 1.0f, 0.0f)) +
                  (gnomon_select(some2, 1.0f, 0.0f) + gnomon_select(some3, 1.0f, 0.0f));
        x.begin0 = starts.first;
        x.end0 = stops.first;
        x.begin1 = starts.second;
        x.end1 = stops.second;
        x.begin2 = starts.third;
        x.end2 = stops.third;
        x.begin3 = starts.fourth;
        x.end3 = stops.fourth;
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
static inline coverage_intervals moving_coverage(gnomon_moving_edges e, float facing)
{
    gnomon_edge_intervals a = moving_edge_inside(e.a, facing);
    float size = (gnomon_moving_edge_size(e.a) + gnomon_moving_edge_size(e.b)) + gnomon_moving_edge_size(e.c);
    a.end = gnomon_select(0.0f < size, a.end, 0.0f);
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
static inline float coverage_duration(coverage_intervals x)
{
    return saturate_or_zero(((x.end0 - x.begin0) + (x.end1 - x.begin1)) + ((x.end2 - x.begin2) + (x.end3 - x.begin3)));
}

#endif

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
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
typedef struct gnomon_moving_vertex gnomon_moving_vertex;
struct gnomon_moving_vertex { float x0, y0, z0, w0, x1, y1, z1, w1; };

/// A triangle of three moving vertices.
typedef struct moving_triangle moving_triangle;
struct moving_triangle { gnomon_moving_vertex a, b, c; };

/// A vertex relative to a sample, at shutter open and at shutter close.
typedef struct gnomon_sheared_vertex gnomon_sheared_vertex;
struct gnomon_sheared_vertex { float x0, y0, x1, y1; };

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
typedef struct depth_line depth_line;
struct depth_line { float z0, z1, deviation; };

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
typedef struct depth_piece depth_piece;
struct depth_piece { float t0, t1, z0, z1, passed; };

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
typedef struct depth_trial depth_trial;
struct depth_trial
{
    depth_piece piece;
    float start, share, settled;
};

/// Weights of a triangle's vertices; they need not sum to 1.
typedef struct gnomon_corner_weights gnomon_corner_weights;
struct gnomon_corner_weights { float a, b, c; };

/// Bernstein coefficients of a cubic, the middle ones times 3.
typedef struct gnomon_bernstein_cubic gnomon_bernstein_cubic;
struct gnomon_bernstein_cubic { float c0, c1, c2, c3; };

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
static inline gnomon_sheared_vertex gnomon_moving_vertex_shear(gnomon_moving_vertex v, float s_x, float s_y)
{
    gnomon_sheared_vertex r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
static inline float gnomon_sheared_cross(float a_x, float a_y, float b_x, float b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
static inline gnomon_moving_edge gnomon_moving_edge_make(gnomon_sheared_vertex a, gnomon_sheared_vertex b)
{
    gnomon_moving_edge e;
    e.e0 = gnomon_sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = 0.5f * (gnomon_sheared_cross(a.x0, a.y0, b.x1, b.y1) + gnomon_sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = gnomon_sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
static inline gnomon_moving_edges moving_triangle_edges(moving_triangle m, float s_x, float s_y)
{
    gnomon_sheared_vertex a = gnomon_moving_vertex_shear(m.a, s_x, s_y);
    gnomon_sheared_vertex b = gnomon_moving_vertex_shear(m.b, s_x, s_y);
    gnomon_sheared_vertex c = gnomon_moving_vertex_shear(m.c, s_x, s_y);
    gnomon_moving_edges e;
    e.a = gnomon_moving_edge_make(b, c);
    e.b = gnomon_moving_edge_make(c, a);
    e.c = gnomon_moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
static inline gnomon_corner_weights gnomon_corner_weights_at(gnomon_moving_edges e, float t)
{
    gnomon_corner_weights v;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    bool back = (v.a + v.b) + v.c < 0.0f;
    v.a = gnomon_max(gnomon_select(back, -1.0f * v.a, v.a), 0.0f);
    v.b = gnomon_max(gnomon_select(back, -1.0f * v.b, v.b), 0.0f);
    v.c = gnomon_max(gnomon_select(back, -1.0f * v.c, v.c), 0.0f);
    bool vanished = (v.a + v.b) + v.c <= 0.0f;
    v.a = gnomon_select(vanished, 1.0f, v.a);
    v.b = gnomon_select(vanished, 1.0f, v.b);
    v.c = gnomon_select(vanished, 1.0f, v.c);
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
static inline float moving_depth_at(moving_triangle m, gnomon_moving_edges e, float t, float divided)
{
    gnomon_corner_weights v = gnomon_corner_weights_at(e, t);
    float s = 1.0f - t;
    float z = (v.a * (m.a.z0 * s + m.a.z1 * t) + v.b * (m.b.z0 * s + m.b.z1 * t)) + v.c * (m.c.z0 * s + m.c.z1 * t);
    float w = (v.a * (m.a.w0 * s + m.a.w1 * t) + v.b * (m.b.w0 * s + m.b.w1 * t)) + v.c * (m.c.w0 * s + m.c.w1 * t);
    float divisor = gnomon_select(0.0f < divided, w, (v.a + v.b) + v.c);
    float depth = gnomon_max(gnomon_min(z / divisor, 1.0f), -1.0f); // a NaN becomes 1
    return gnomon_select(0.0f < w, depth, 1.0f);
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
static inline float gnomon_depth_nonlinearity(float most, float d0, float d3, float turn0, float turn1)
{
    bool negative = d0 < 0.0f;
    float turn = gnomon_select(negative, -1.0f * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    float product = d0 * d3;
    float least = turn + 2.0f * gnomon_sqrt(product);
    bool known = 0.0f < product && 0.0f < least && least < gnomon_moving_edge_limit;
    return gnomon_select(known, most / least, 4.0f);
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
static inline depth_line gnomon_depth_line_within(float z0, float z1, float free0, float free1, float bend, float least,
                                                  float most)
{
    float beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    float all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    depth_line r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
static inline gnomon_moving_edge gnomon_moving_edge_between(gnomon_moving_edge e, float begin, float end)
{
    float left = 1.0f - end;
    gnomon_moving_edge r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = 2.0f * ((e.e0 * left + e.e1 * end) * (1.0f - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from gnomon_moving_edge_between, each times a linear function: from a0 to a1, from
/// b0 to b1, from c0 to c1.
static inline gnomon_bernstein_cubic gnomon_moving_edges_combine(gnomon_moving_edges e, float a0, float a1, float b0,
                                                                 float b1, float c0, float c1)
{
    gnomon_bernstein_cubic r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
static inline depth_line moving_depth_line(moving_triangle m, gnomon_moving_edges e, float begin, float end,
                                           float divided)
{
    float b = 1.0f - begin;
    float f = 1.0f - end;
    gnomon_moving_edges x;
    x.a = gnomon_moving_edge_between(e.a, begin, end);
    x.b = gnomon_moving_edge_between(e.b, begin, end);
    x.c = gnomon_moving_edge_between(e.c, begin, end);
    gnomon_bernstein_cubic n = gnomon_moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end,
                                                           m.b.z0 * b + m.b.z1 * begin, m.b.z0 * f + m.b.z1 * end,
                                                           m.c.z0 * b + m.c.z1 * begin, m.c.z0 * f + m.c.z1 * end);
    float a_w0 = m.a.w0 * b + m.a.w1 * begin;
    float a_w1 = m.a.w0 * f + m.a.w1 * end;
    float b_w0 = m.b.w0 * b + m.b.w1 * begin;
    float b_w1 = m.b.w0 * f + m.b.w1 * end;
    float c_w0 = m.c.w0 * b + m.c.w1 * begin;
    float c_w1 = m.c.w0 * f + m.c.w1 * end;
    bool before = 0.0f < a_w0 && 0.0f < a_w1 && 0.0f < b_w0 && 0.0f < b_w1 && 0.0f < c_w0 && 0.0f < c_w1;
    bool by_w = 0.0f < divided;
    gnomon_bernstein_cubic d = gnomon_moving_edges_combine(x, gnomon_select(by_w, a_w0, 1.0f),
                                                           gnomon_select(by_w, a_w1, 1.0f),
                                                           gnomon_select(by_w, b_w0, 1.0f),
                                                           gnomon_select(by_w, b_w1, 1.0f),
                                                           gnomon_select(by_w, c_w0, 1.0f),
                                                           gnomon_select(by_w, c_w1, 1.0f));
    float free0 = n.c0 / d.c0;
    float free1 = n.c3 / d.c3;
    float turn0 = d.c1 - d.c0;
    float turn1 = d.c2 - d.c3;
    float p0 = (n.c1 - free0 * turn0) - free1 * d.c0;
    float p1 = (n.c1 + n.c2) - (free0 * d.c2 + free1 * d.c1);
    float p2 = (n.c2 - free1 * turn1) - free0 * d.c3;
    float most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), 0.5f * gnomon_abs(p1));
    float bend = gnomon_select(before, gnomon_depth_nonlinearity(most, d.c0, d.c3, turn0, turn1), 4.0f);
    return gnomon_depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0,
                                    free1, bend, -1.0f, 1.0f);
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
static inline float gnomon_moving_depth_time(float begin, float end, float passed)
{
    return gnomon_select(passed < 1.0f, begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
static inline depth_trial gnomon_depth_trial_begin(float begin, float end, float passed)
{
    depth_trial r;
    r.start = saturate_or_zero(passed);
    r.share = 1.0f - r.start;
    r.settled = 0.0f;
    r.piece.t0 = gnomon_moving_depth_time(begin, end, r.start);
    r.piece.t1 = end;
    r.piece.z0 = 1.0f;
    r.piece.z1 = 1.0f;
    r.piece.passed = 1.0f;
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
static inline depth_trial gnomon_depth_trial_next(depth_trial trial, depth_line fit, float begin, float end,
                                                  float tolerance)
{
    float shortest = 0.0322265625f;
    bool fits = fit.deviation <= tolerance || trial.share <= shortest;
    float parts = gnomon_select(fit.deviation <= 4.0f * tolerance, 2.0f, 3.0f);
    float shorter = gnomon_max(trial.share / parts, shortest);
    float to = gnomon_min(trial.start + shorter, 1.0f);
    trial.piece.z0 = fit.z0;
    trial.piece.z1 = fit.z1;
    trial.piece.t1 = gnomon_select(fits, trial.piece.t1, gnomon_moving_depth_time(begin, end, to));
    trial.piece.passed = gnomon_select(fits, trial.piece.passed, to);
    trial.share = gnomon_select(fits, trial.share, shorter);
    trial.settled = gnomon_select(fits, 1.0f, 0.0f);
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
static inline depth_piece moving_depth_piece(moving_triangle m, gnomon_moving_edges e, float begin, float end,
                                             float passed, float divided, float tolerance)
{
    depth_trial r = gnomon_depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < 1.0f)) r = gnomon_depth_trial_next(r,
                                                                      moving_depth_line(m, e, r.piece.t0, r.piece.t1,
                                                                                        divided), begin, end,
                                                                      tolerance);
    }
    return r.piece;
}

#endif

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
#ifndef GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H
#define GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is
/// the centre of the texel.
typedef struct line_sample line_sample;
struct line_sample { float t, along_x, along_y; };

/// A texel along a line's direction, and the place on its line, in [0, 1].
typedef struct line_sample_place line_sample_place;
struct line_sample_place { float texel, place; };

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
static inline gnomon_moving_vertex line_sample_vertex(gnomon_moving_vertex v, line_sample segment)
{
    float s = 1.0f - segment.t;
    float x = v.x0 * s + v.x1 * segment.t;
    float y = v.y0 * s + v.y1 * segment.t;
    gnomon_moving_vertex r;
    r.z0 = v.z0 * s + v.z1 * segment.t;
    r.w0 = v.w0 * s + v.w1 * segment.t;
    r.z1 = r.z0;
    r.w1 = r.w0;
    float half_x = (0.5f * segment.along_x) * r.w0;
    float half_y = (0.5f * segment.along_y) * r.w0;
    r.x0 = x + half_x;
    r.y0 = y + half_y;
    r.x1 = x - half_x;
    r.y1 = y - half_y;
    return r;
}

/// The texel that holds a position along the direction of lines, and the place on its line.
/// Domain: positions in [-65536, 65536].
/// NaN: place 0.
/// Error: exact for positions not below 0; else 2^-p.
static inline line_sample_place line_sample_place_of(float x)
{
    line_sample_place r;
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
static inline float line_sample_intensity(float up, float down, float left, float right, float share_x, float share_y)
{
    float a = saturate_or_zero(up);
    float b = saturate_or_zero(down);
    float c = saturate_or_zero(left);
    float d = saturate_or_zero(right);
    float x = saturate_or_zero(share_x);
    float y = saturate_or_zero(share_y);
    float mean = 0.5f * ((a * (1.0f - y) + b * y) + (c * (1.0f - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
}

#endif

#endif
