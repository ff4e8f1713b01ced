// Bounds of rectified coordinates (rectified.h) over the view rays of a camera (Peters et al. 2017, App. A), from the four
// corners of its far plane, in order around it, in light axes with the eye for origin.
//
//     radius     largest radius of a corner
//     azimuth    angles of the corners relative to that of the farthest one: no two differ by more than half a turn
//     axis       where the light direction, or its opposite, is strictly within the four side planes: a full turn, and polar
//                begins at 0, or ends at pi
//     polar      extreme on the border of the far plane, else on the axis. On the edge a + t c the cosine z / |a + t c| is
//                extreme at   t = (a_z a.c - c_z a.a) / (c_z a.c - a_z c.c)
//                or at an end. Any point of the edge is within the bounds, so t needs no test: it is clamped.
//
// The angles of one row are the same over edges that are cut off at the row's two azimuths, each by the side on which
// a point of the edge lies: a fold over the far plane's border, whether the row holds corners or not.
#ifndef GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H
#define GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H
#include "rectified.h"
GNOMON_NAMESPACE_BEGIN

/// A corner of the far plane.
GNOMON_STRUCT(rectified_corner) { Real x, y, z; };

/// Corners of the far plane, in order around it, either way.
GNOMON_STRUCT(rectified_corners) { GNOMON_T(rectified_corner) a, b, c, d; };

/// The bounds of a camera's view rays: radius in [0, radius], azimuth from azimuth_start on over azimuth_length, polar from
/// polar_least to polar_most.
GNOMON_STRUCT(rectified_frustum) { Real radius, azimuth_start, azimuth_length, polar_least, polar_most; };

/// An interval of polar angles.
GNOMON_STRUCT(rectified_interval) { Real least, most; };

/// A part of an edge, from a fraction begin to a fraction end.
GNOMON_STRUCT(rectified_part) { Real begin, end; };

GNOMON_DETAIL_KERNEL Real rectified_dot(GNOMON_T(rectified_corner) a, GNOMON_T(rectified_corner) b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// b - a.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_corner) rectified_from_to(GNOMON_T(rectified_corner) a,
                                                                  GNOMON_T(rectified_corner) b)
{
    GNOMON_T(rectified_corner) r;
    r.x = b.x - a.x;
    r.y = b.y - a.y;
    r.z = b.z - a.z;
    return r;
}

/// The z of the cross product of a and b: positive where the azimuth of b is up to half a turn beyond that of a.
GNOMON_DETAIL_KERNEL Real rectified_turn(GNOMON_T(rectified_corner) a, GNOMON_T(rectified_corner) b)
{
    return a.x * b.y - a.y * b.x;
}

/// 1 if the light direction is strictly within the far plane as seen from the eye, -1 if its opposite is, else 0.
GNOMON_DETAIL_KERNEL Real rectified_axis_side(GNOMON_T(rectified_corners) q)
{
    Real ab = rectified_turn(q.a, q.b);
    Real bc = rectified_turn(q.b, q.c);
    Real cd = rectified_turn(q.c, q.d);
    Real da = rectified_turn(q.d, q.a);
    GNOMON_MASK left = Real(0) < ab && Real(0) < bc && Real(0) < cd && Real(0) < da;
    GNOMON_MASK right = ab < Real(0) && bc < Real(0) && cd < Real(0) && da < Real(0);
    // The normal of the far plane, by its diagonals, and the side of it on which the plane lies.
    rectified_corner s = rectified_from_to(q.a, q.c);
    rectified_corner t = rectified_from_to(q.b, q.d);
    Real nx = s.y * t.z - s.z * t.y;
    Real ny = s.z * t.x - s.x * t.z;
    Real side = (nx * q.a.x + ny * q.a.y) + rectified_turn(s, t) * q.a.z;
    Real sign = gnomon_select(side < Real(0), Real(-1), Real(1));
    return gnomon_select(left, sign, gnomon_select(right, Real(-1) * sign, Real(0)));
}

/// The angles so far and that of the point (x, y, z).
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_add(GNOMON_T(rectified_interval) bounds, Real x,
                                                                         Real y, Real z)
{
    Real polar = polynomial_atan2(gnomon_sqrt(x * x + y * y), z);
    bounds.least = gnomon_min(polar, bounds.least);
    bounds.most = gnomon_max(polar, bounds.most);
    return bounds;
}

/// The angles so far and that of the point a + t c.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_along(GNOMON_T(rectified_interval) bounds,
                                                                           GNOMON_T(rectified_corner) a,
                                                                           GNOMON_T(rectified_corner) c, Real t)
{
    return rectified_interval_add(bounds, a.x + t * c.x, a.y + t * c.y, a.z + t * c.z);
}

/// The t of the extreme angle on a + t c, limited to a part; some t of it for an edge towards the eye or without length.
GNOMON_DETAIL_KERNEL Real rectified_extreme(GNOMON_T(rectified_corner) a, GNOMON_T(rectified_corner) c, Real begin,
                                            Real end)
{
    Real ac = rectified_dot(a, c);
    Real t = (a.z * ac - c.z * rectified_dot(a, a)) / (c.z * ac - a.z * rectified_dot(c, c));
    return clamp_or_nan(gnomon_select(t == t, t, begin), begin, end);
}

/// The angles so far and those of the edge from a to b, without b.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_edge(GNOMON_T(rectified_interval) bounds,
                                                                          GNOMON_T(rectified_corner) a,
                                                                          GNOMON_T(rectified_corner) b)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_add(bounds, a.x, a.y, a.z);
    return rectified_interval_along(r, a, c, rectified_extreme(a, c, Real(0), Real(1)));
}

/// The angles so far and those of a part of the edge from a to b; an empty part has none.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_part(GNOMON_T(rectified_interval) bounds,
                                                                          GNOMON_T(rectified_corner) a,
                                                                          GNOMON_T(rectified_corner) b,
                                                                          GNOMON_T(rectified_part) part)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_along(bounds, a, c, part.begin);
    r = rectified_interval_along(r, a, c, part.end);
    r = rectified_interval_along(r, a, c, rectified_extreme(a, c, part.begin, part.end));
    GNOMON_MASK empty = part.end < part.begin;
    r.least = gnomon_select(empty, bounds.least, r.least);
    r.most = gnomon_select(empty, bounds.most, r.most);
    return r;
}

/// The bounds before any edge, where axis is that of rectified_axis_side.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_begin(Real axis)
{
    GNOMON_T(rectified_interval) r;
    r.least = gnomon_select(Real(0) < axis, Real(0), GNOMON_LITERAL(rectified_pi));
    r.most = gnomon_select(axis < Real(0), GNOMON_LITERAL(rectified_pi), Real(0));
    return r;
}

/// The interval, or [0, pi] if no angle was added.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_interval_end(GNOMON_T(rectified_interval) bounds)
{
    GNOMON_MASK none = bounds.most < bounds.least;
    bounds.least = gnomon_select(none, Real(0), bounds.least);
    bounds.most = gnomon_select(none, GNOMON_LITERAL(rectified_pi), bounds.most);
    return bounds;
}

/// The farther from the axis of two corners, the first where they are equal or the second has a NaN.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_corner) rectified_farther(GNOMON_T(rectified_corner) a,
                                                                  GNOMON_T(rectified_corner) b)
{
    GNOMON_MASK second = a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    GNOMON_T(rectified_corner) r;
    r.x = gnomon_select(second, b.x, a.x);
    r.y = gnomon_select(second, b.y, a.y);
    r.z = gnomon_select(second, b.z, a.z);
    return r;
}

/// The azimuth of b relative to that of a, in [-pi, pi]; 0 on the axis.
GNOMON_DETAIL_KERNEL Real rectified_azimuth_between(GNOMON_T(rectified_corner) a, GNOMON_T(rectified_corner) b)
{
    return polynomial_atan2(rectified_turn(a, b), a.x * b.x + a.y * b.y);
}

/// The bounds of rectified coordinates over all view rays to a far plane with these corners: sharp, so that rays touch each.
/// azimuth_start is in [-pi, pi], azimuth_length in [0, 2 pi]: at most pi, or 2 pi if the axis is within the far plane.
/// A corner on the axis has no azimuth and bounds none.
/// Domain: coordinates are 0 or have magnitudes in [2^-30, 2^30] in float, [2^-300, 2^300] in double; corners of a convex
/// quadrilateral whose plane does not hold the eye. Corners that are all at the eye give zeros; corners of no such
/// quadrilateral give unspecified bounds.
/// NaN: an edge with a NaN bounds no angle.
/// Error: for fields of view up to 160 degrees a point of the far plane exceeds the bounds by at most 4 2^-p radius in radius, by
/// 16 2^-p radius sideways, and by 8 2^-p in polar.
/// Source: Peters 2017, App. A
GNOMON_KERNEL GNOMON_T(rectified_frustum) rectified_frustum_from_corners(GNOMON_T(rectified_corners) q)
{
    Real axis = rectified_axis_side(q);
    rectified_corner farthest = rectified_farther(rectified_farther(q.a, q.b), rectified_farther(q.c, q.d));
    Real a = rectified_azimuth_between(farthest, q.a);
    Real b = rectified_azimuth_between(farthest, q.b);
    Real c = rectified_azimuth_between(farthest, q.c);
    Real d = rectified_azimuth_between(farthest, q.d);
    Real least = gnomon_min(a, gnomon_min(b, gnomon_min(c, gnomon_min(d, Real(0)))));
    Real most = gnomon_max(a, gnomon_max(b, gnomon_max(c, gnomon_max(d, Real(0)))));
    GNOMON_MASK around = axis < Real(0) || Real(0) < axis || GNOMON_LITERAL(rectified_pi) < most - least;

    rectified_interval polar = rectified_interval_begin(axis);
    polar = rectified_interval_edge(polar, q.a, q.b);
    polar = rectified_interval_edge(polar, q.b, q.c);
    polar = rectified_interval_edge(polar, q.c, q.d);
    polar = rectified_interval_end(rectified_interval_edge(polar, q.d, q.a));

    GNOMON_T(rectified_frustum) r;
    r.radius = gnomon_sqrt(farthest.x * farthest.x + farthest.y * farthest.y);
    Real start = polynomial_atan2(farthest.y, farthest.x) + least;
    Real first = Real(-1) * GNOMON_LITERAL(rectified_pi);
    r.azimuth_start =
        gnomon_select(around, first, clamp_or_nan(rectified_wrapped(start), first, GNOMON_LITERAL(rectified_pi)));
    r.azimuth_length = gnomon_select(around, GNOMON_LITERAL(rectified_two_pi), most - least);
    r.polar_least = polar.least;
    r.polar_most = polar.most;
    return r;
}

/// The part of the edge from a to b, within a part, that is on the left of the direction (cosine, sine) from the axis.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_part) rectified_part_left(GNOMON_T(rectified_part) part,
                                                                  GNOMON_T(rectified_corner) a,
                                                                  GNOMON_T(rectified_corner) b, Real cosine, Real sine)
{
    Real at_a = cosine * a.y - sine * a.x;
    Real at_b = cosine * b.y - sine * b.x;
    Real crossing = at_a / (at_a - at_b);
    part.begin = gnomon_select(at_a < Real(0), gnomon_max(part.begin, crossing), part.begin);
    part.end = gnomon_select(at_b < Real(0), gnomon_min(part.end, crossing), part.end);
    // Both ends are on the right: the part is empty.
    part.end = gnomon_select(at_a < Real(0) && at_b < Real(0), Real(-1), part.end);
    return part;
}

/// The angles so far and those of the edge from a to b between two directions; of the whole edge if whole is 1.
GNOMON_DETAIL_KERNEL GNOMON_T(rectified_interval) rectified_row_edge(GNOMON_T(rectified_interval) bounds,
                                                                     GNOMON_T(rectified_corner) a,
                                                                     GNOMON_T(rectified_corner) b,
                                                                     GNOMON_T(cosine_sine) first,
                                                                     GNOMON_T(cosine_sine) last, Real whole)
{
    GNOMON_T(rectified_part) all;
    all.begin = Real(0);
    all.end = Real(1);
    rectified_part part = rectified_part_left(all, a, b, first.cosine, first.sine);
    part = rectified_part_left(part, a, b, Real(-1) * last.cosine, Real(-1) * last.sine);
    part.begin = gnomon_select(whole == Real(1), Real(0), part.begin);
    part.end = gnomon_select(whole == Real(1), Real(1), part.end);
    return rectified_interval_part(bounds, a, b, part);
}

/// The polar angles of the view rays whose azimuths are between first and last, as those of one row; [0, pi] if no ray is
/// there.
/// Domain: as for rectified_frustum_from_corners; first <= last, both within 3 pi of 0. An interval above 3 radians
/// gives the angles of all rays.
/// NaN: as for rectified_frustum_from_corners.
/// Error: for fields of view up to 160 degrees a ray exceeds the bounds by at most 16 2^-p.
GNOMON_KERNEL GNOMON_T(rectified_interval) rectified_row_polar(GNOMON_T(rectified_corners) q, Real first, Real last)
{
    cosine_sine left = polynomial_cosine_sine(first);
    cosine_sine right = polynomial_cosine_sine(last);
    Real whole = gnomon_select(Real(3) < last - first, Real(1), Real(0));
    rectified_interval polar = rectified_interval_begin(rectified_axis_side(q));
    polar = rectified_row_edge(polar, q.a, q.b, left, right, whole);
    polar = rectified_row_edge(polar, q.b, q.c, left, right, whole);
    polar = rectified_row_edge(polar, q.c, q.d, left, right, whole);
    return rectified_interval_end(rectified_row_edge(polar, q.d, q.a, left, right, whole));
}

GNOMON_NAMESPACE_END
#endif
