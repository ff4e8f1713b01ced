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
#include "../../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
GNOMON_STRUCT(moving_edge) { Real e0, e1, e2; };

/// The edge functions opposite to the vertices a, b, c of a triangle.
GNOMON_STRUCT(moving_edges) { GNOMON_T(moving_edge) a, b, c; };

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are coverage_none.
/// An empty set has begin 1 and end 0.
GNOMON_STRUCT(edge_intervals) { Real begin, end, gap_begin, gap_end; };

/// The times from begin to end; none unless begin < end.
GNOMON_STRUCT(linear_interval) { Real begin, end; };

/// Four numbers in ascending order.
GNOMON_STRUCT(ordered4) { Real first, second, third, fourth; };

/// Disjoint intervals in order, `count` of them; the others begin and end at coverage_none.
GNOMON_STRUCT(coverage_intervals) { Real count, begin0, end0, begin1, end1, begin2, end2, begin3, end3; };

GNOMON_CONSTANT(coverage_none, 2.0);                       // after the shutter has closed
GNOMON_CONSTANT(moving_edge_limit, 1152921504606846976.0); // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
GNOMON_KERNEL Real moving_edge_at(GNOMON_T(moving_edge) e, Real t)
{
    Real s = Real(1) - t;
    return (e.e0 * s + e.e1 * t) * s + (e.e1 * s + e.e2 * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
GNOMON_DETAIL_KERNEL Real moving_edge_size(GNOMON_T(moving_edge) e)
{
    return (gnomon_abs(e.e0) + gnomon_abs(e.e1)) + gnomon_abs(e.e2);
}

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
GNOMON_KERNEL GNOMON_T(edge_intervals) moving_edge_inside(GNOMON_T(moving_edge) e, GNOMON_SETTING facing)
{
    Real side = gnomon_select(facing < Real(0), Real(-1), Real(1));
    Real c0 = side * e.e0;
    Real c1 = side * e.e1;
    Real c2 = side * e.e2;
    GNOMON_T(edge_intervals) x;
    x.begin = Real(0);
    x.end = Real(1);
    x.gap_begin = GNOMON_LITERAL(coverage_none);
    x.gap_end = GNOMON_LITERAL(coverage_none);
    GNOMON_MASK before = c0 < Real(0); // outside at shutter open
    GNOMON_MASK after = c2 < Real(0);
    if (gnomon_any(before || after || c1 < Real(0))) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        GNOMON_MASK up = Real(0) < c1 || (c1 == Real(0) && before);
        GNOMON_MASK late = (before && !up) || (up && !before);
        GNOMON_MASK once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        GNOMON_MASK twice = !(once || late);
        Real r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, Real(0)));
        Real q = gnomon_select(up, Real(-1) * (c1 + r), r - c1);
        Real first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        Real second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && Real(0) < r;
            GNOMON_MASK gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        GNOMON_MASK some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, Real(0)), Real(1));
        x.end = gnomon_select(some, gnomon_select(after, second, Real(1)), Real(0));
    }
    GNOMON_MASK known = moving_edge_size(e) < GNOMON_LITERAL(moving_edge_limit);
    x.begin = gnomon_select(known, x.begin, Real(1));
    x.end = gnomon_select(known, x.end, Real(0));
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
GNOMON_KERNEL GNOMON_T(linear_interval) linear_edge_inside(Real e0, Real e2)
{
    GNOMON_MASK before = e0 < Real(0);
    GNOMON_MASK after = e2 < Real(0);
    Real change = e0 - e2;
    GNOMON_MASK never = (before && after) || !(gnomon_abs(change) < GNOMON_LITERAL(moving_edge_limit));
    Real root = gnomon_min(e0 / change, Real(1));
    GNOMON_T(linear_interval) x;
    x.begin = gnomon_select(never, Real(1), gnomon_select(before, root, Real(0)));
    x.end = gnomon_select(never, Real(0), gnomon_select(after, root, Real(1)));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
GNOMON_KERNEL GNOMON_T(linear_interval) linear_coverage(GNOMON_T(moving_edges) e)
{
    linear_interval a = linear_edge_inside(e.a.e0, e.a.e2);
    linear_interval b = linear_edge_inside(e.b.e0, e.b.e2);
    linear_interval c = linear_edge_inside(e.c.e0, e.c.e2);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
GNOMON_DETAIL_KERNEL GNOMON_T(ordered4) ordered4_make(Real a, Real b, Real c, Real d)
{
    Real low0 = gnomon_min(a, b);
    Real high0 = gnomon_max(a, b);
    Real low1 = gnomon_min(c, d);
    Real high1 = gnomon_max(c, d);
    Real middle0 = gnomon_max(low0, low1);
    Real middle1 = gnomon_min(high0, high1);
    GNOMON_T(ordered4) x;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
GNOMON_KERNEL GNOMON_T(coverage_intervals) intersect_edge_intervals(GNOMON_T(edge_intervals) a,
                                                                    GNOMON_T(edge_intervals) b,
                                                                    GNOMON_T(edge_intervals) c)
{
    Real begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), Real(0));
    Real end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), Real(1));
    Real none = GNOMON_LITERAL(coverage_none);
    GNOMON_MASK some = begin < end;
    GNOMON_T(coverage_intervals) x;
    x.count = gnomon_select(some, Real(1), Real(0));
    x.begin0 = gnomon_select(some, begin, none);
    x.end0 = gnomon_select(some, end, none);
    x.begin1 = none;
    x.end1 = none;
    x.begin2 = none;
    x.end2 = none;
    x.begin3 = none;
    x.end3 = none;
    GNOMON_MASK gap_a = a.gap_begin < none;
    GNOMON_MASK gap_b = b.gap_begin < none;
    GNOMON_MASK gap_c = c.gap_begin < none;
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
        ordered4 starts = ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        ordered4 stops = ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        Real begin1 = gnomon_max(begin, stops.first);
        Real begin2 = gnomon_max(begin, stops.second);
        Real begin3 = gnomon_max(begin, stops.third);
        Real end0 = gnomon_min(end, starts.first);
        Real end1 = gnomon_min(end, starts.second);
        Real end2 = gnomon_min(end, starts.third);
        GNOMON_MASK some0 = some && begin < end0;
        GNOMON_MASK some1 = some && begin1 < end1;
        GNOMON_MASK some2 = some && begin2 < end2;
        GNOMON_MASK some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                               gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                              gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, Real(1), Real(0)) + gnomon_select(some1, Real(1), Real(0))) +
                  (gnomon_select(some2, Real(1), Real(0)) + gnomon_select(some3, Real(1), Real(0)));
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
GNOMON_KERNEL GNOMON_T(coverage_intervals) moving_coverage(GNOMON_T(moving_edges) e, GNOMON_SETTING facing)
{
    edge_intervals a = moving_edge_inside(e.a, facing);
    Real size = (moving_edge_size(e.a) + moving_edge_size(e.b)) + moving_edge_size(e.c);
    a.end = gnomon_select(Real(0) < size, a.end, Real(0));
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
GNOMON_KERNEL Real coverage_duration(GNOMON_T(coverage_intervals) x)
{
    return saturate_or_zero(((x.end0 - x.begin0) + (x.end1 - x.begin1)) + ((x.end2 - x.begin2) + (x.end3 - x.begin3)));
}

GNOMON_NAMESPACE_END
#endif
