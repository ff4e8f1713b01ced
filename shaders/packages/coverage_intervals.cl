// Gnomon 0.1.0, coverage_intervals.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_COVERAGE_INTERVALS_CL
#define GNOMON_COVERAGE_INTERVALS_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: coverage_intervals.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: coverage_intervals.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: coverage_intervals.cl is not of the same version as a package before it"
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

#endif
