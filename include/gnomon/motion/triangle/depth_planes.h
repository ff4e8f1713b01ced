// Times at which the point of a moving triangle that a sample sees lies between the near and the far plane. A surface
// that passes one of the planes is visible for a part of its covered times: its times are clipped, not its depths.
//
// With depth z = z_c + N / D (triangle_setup.h) and D > 0 where the triangle turns its positive side to the sample, z
// is at least p exactly where
//     h(t) = N(t) + (z_c(t) - p) D(t) >= 0
// This is a cubic in t. Its turning points, the roots of a quadratic, divide [0, 1] into three intervals in which h is
// monotonic. Each interval has one root or none; bisection finds the root. A cubic is positive in at most two
// intervals, so the result is an edge_intervals, as for an edge.
//
//     near = depth_intervals_beyond(curve, -1, facing);   far = depth_intervals_before(curve, 1, facing);
//     for every covered interval: edge_intervals_part(near, 0, begin, end), and part 1; each of them alike with far
#ifndef GNOMON_MOTION_TRIANGLE_DEPTH_PLANES_H
#define GNOMON_MOTION_TRIANGLE_DEPTH_PLANES_H
#include "triangle_setup.h"
GNOMON_NAMESPACE_BEGIN

/// A cubic: h0 s^3 + h1 s^2 t + h2 s t^2 + h3 t^3, s = 1 - t.
GNOMON_STRUCT(moving_cubic) { Real h0, h1, h2, h3; };

/// A root between two times, and whether there is one, 1 or 0.
GNOMON_STRUCT(cubic_root) { Real t, found; };

GNOMON_CONSTANT(cubic_third, 0.333333333333333333333);

/// Value of h at time t in [0, 1].
/// Error: 8 2^-p times the largest coefficient.
GNOMON_DETAIL_KERNEL Real moving_cubic_at(GNOMON_T(moving_cubic) h, Real t)
{
    Real s = Real(1) - t;
    return (h.h0 * s + h.h1 * t) * (s * s) + (h.h2 * s + h.h3 * t) * (t * t);
}

/// Time at which the sign of h changes between begin and end, where h has the values at_begin and at_end and is
/// monotonic between them. By 24 halvings.
/// Error: 2^-24 of the interval.
GNOMON_DETAIL_KERNEL GNOMON_T(cubic_root) moving_cubic_root(GNOMON_T(moving_cubic) h, Real begin, Real end,
                                                            Real at_begin, Real at_end)
{
    GNOMON_MASK before = at_begin < Real(0);
    GNOMON_MASK after = at_end < Real(0);
    GNOMON_MASK some = begin <= end && ((before && !after) || (after && !before));
    Real low = begin;
    Real high = end;
    for (int i = 0; i < 24; ++i) {
        Real middle = Real(0.5) * (low + high);
        GNOMON_MASK outside = moving_cubic_at(h, middle) < Real(0);
        GNOMON_MASK left = (outside && before) || !(outside || before); // the root is later
        low = gnomon_select(left, middle, low);
        high = gnomon_select(left, high, middle);
    }
    GNOMON_T(cubic_root) r;
    // Return the end that is inside, so that h is not negative at the time.
    r.t = gnomon_select(before, high, low);
    r.found = gnomon_select(some, Real(1), Real(0));
    return r;
}

/// Times in [0, 1] at which h >= 0.
/// NaN: none.
/// Error: the error of the cubic's value over its slope at that time, and 2^-24. If h only touches 0 within its error,
/// as if it did not.
GNOMON_DETAIL_KERNEL GNOMON_T(edge_intervals) moving_cubic_inside(GNOMON_T(moving_cubic) h)
{
    Real none = GNOMON_LITERAL(coverage_none);
    // A third of the slope, by Bernstein coefficients. The ends of the times at which h rises are the turning points.
    Real b1 = h.h1 * GNOMON_LITERAL(cubic_third);
    Real b2 = h.h2 * GNOMON_LITERAL(cubic_third);
    GNOMON_T(moving_edge) slope;
    slope.e0 = b1 - h.h0;
    slope.e1 = b2 - b1;
    slope.e2 = h.h3 - b2;
    edge_intervals rises = moving_edge_inside(slope, Real(1));
    GNOMON_MASK gap = rises.gap_begin < none;
    GNOMON_MASK some = rises.begin < rises.end;
    Real first = gnomon_select(gap, rises.gap_begin, gnomon_select(some, rises.begin, Real(0)));
    Real second = gnomon_select(gap, rises.gap_end, gnomon_select(some, rises.end, Real(1)));
    Real at_first = moving_cubic_at(h, first);
    Real at_second = moving_cubic_at(h, second);
    cubic_root a = moving_cubic_root(h, Real(0), first, h.h0, at_first);
    cubic_root b = moving_cubic_root(h, first, second, at_first, at_second);
    cubic_root c = moving_cubic_root(h, second, Real(1), at_second, h.h3);

    // The roots in order, missing ones last.
    GNOMON_MASK has_a = Real(0) < a.found;
    GNOMON_MASK has_b = Real(0) < b.found;
    GNOMON_MASK has_c = Real(0) < c.found;
    Real root0 = gnomon_select(has_a, a.t, gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none)));
    Real later = gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none));
    Real root1 = gnomon_select(has_a, later, gnomon_select(has_b && has_c, c.t, none));
    Real root2 = gnomon_select(has_a && has_b && has_c, c.t, none);

    GNOMON_MASK open = Real(0) <= h.h0;
    GNOMON_T(edge_intervals) x;
    x.begin = gnomon_select(open, Real(0), gnomon_min(root0, Real(1)));
    // A gap lasts from the first root to the second if h is positive at shutter open, else from the second to the
    // third. Without its second root there is no gap, and the times end at its first.
    Real leaves = gnomon_select(open, root0, root1);
    Real returns = gnomon_select(open, root1, root2);
    Real leaves_again = gnomon_select(open, root2, none);
    GNOMON_MASK back = returns < none;
    x.end = gnomon_min(gnomon_select(back, leaves_again, leaves), Real(1));
    x.gap_begin = gnomon_select(back, leaves, none);
    x.gap_end = gnomon_select(back, returns, none);
    GNOMON_MASK known = (gnomon_abs(h.h0) + gnomon_abs(h.h1)) + (gnomon_abs(h.h2) + gnomon_abs(h.h3)) <
                        GNOMON_LITERAL(moving_edge_limit);
    GNOMON_MASK ever = known && (open || root0 < none);
    x.begin = gnomon_select(ever, x.begin, Real(1));
    x.end = gnomon_select(ever, x.end, Real(0));
    return x;
}

/// The cubic N + (z_c - plane) D, times side.
GNOMON_DETAIL_KERNEL GNOMON_T(moving_cubic) depth_over_plane(GNOMON_T(depth_curve) c, Real plane, Real side)
{
    Real z0 = c.z0 - plane;
    Real z1 = c.z1 - plane;
    GNOMON_T(moving_cubic) h;
    h.h0 = side * (c.n0 + z0 * c.d0);
    h.h1 = side * (c.n1 + (z0 * c.d1 + z1 * c.d0));
    h.h2 = side * (c.n2 + (z0 * c.d2 + z1 * c.d1));
    h.h3 = side * (c.n3 + z1 * c.d2);
    return h;
}

/// Times at which the depth of a triangle is at least that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of moving_cubic_inside.
GNOMON_KERNEL GNOMON_T(edge_intervals) depth_intervals_beyond(GNOMON_T(depth_curve) c, GNOMON_SETTING plane,
                                                              GNOMON_SETTING facing)
{
    return moving_cubic_inside(depth_over_plane(c, plane, facing));
}

/// Times at which the depth of a triangle is at most that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of moving_cubic_inside.
GNOMON_KERNEL GNOMON_T(edge_intervals) depth_intervals_before(GNOMON_T(depth_curve) c, GNOMON_SETTING plane,
                                                              GNOMON_SETTING facing)
{
    return moving_cubic_inside(depth_over_plane(c, plane, Real(-1) * facing));
}

/// The part of the interval from begin to end that lies in x: before its gap (part 0) or after the gap (part 1). Empty
/// unless begin < end. Without a gap everything is in part 0.
GNOMON_KERNEL GNOMON_T(linear_interval) edge_intervals_part(GNOMON_T(edge_intervals) x, GNOMON_SETTING part, Real begin,
                                                            Real end)
{
    GNOMON_MASK second = Real(0.5) < part;
    GNOMON_T(linear_interval) r;
    r.begin = gnomon_max(begin, gnomon_select(second, x.gap_end, x.begin));
    r.end = gnomon_min(end, gnomon_select(second, x.end, gnomon_min(x.end, x.gap_begin)));
    return r;
}

GNOMON_NAMESPACE_END
#endif
