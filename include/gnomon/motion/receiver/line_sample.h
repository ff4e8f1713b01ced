// Line samples (Gribel, Barringer & Akenine-Moller 2011): a texel of a shadow map sees the scene at one instant along a
// line through its centre, instead of at all times from its centre. Of a triangle the line sees intervals, which are known
// exactly, so a shadow's edge that crosses the line is where it is, and not at the border of a texel. Time is sampled: a
// map of lines is of one instant.
//
// Everything else is that of ranges in time, with the place on the line for the time. The line is one texel long: place 0
// is at its begin, 1 at its end. A sample that goes along the line while the scene stands still sees what a sample that
// stands still sees of a scene that goes the other way:
//
//     triangle.a = line_sample_vertex(a, segment), b and c alike;       once for each instant
//     edges = moving_triangle_edges(triangle, s_x, s_y);             and coverage, depth, ranges, lists as of any triangle
//
// A receiver reads the line at its own place on it. Lines of one direction leave the other one sampled. So a map of lines
// along x and one along y are crossed: of the four points at the receiver's x on the lines above and below, and at its y
// on the lines to the left and to the right,
//
//     at = line_sample_place_of(x);      texel at.texel of the row below y - 1/2, and of the next, along x, and so for y
//     hidden = range_intensity(range, at.place, z, id, bias);        the greatest of the texel's list
//     intensity = line_sample_intensity(up, down, left, right, share_x, share_y);
#ifndef GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H
#define GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H
#include "../../numerics/texel_filter.h"
#include "../triangle/moving_triangle.h"
GNOMON_NAMESPACE_BEGIN

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is the centre
/// of the texel.
GNOMON_STRUCT(line_sample) { Real t, along_x, along_y; };

/// A texel along a line's direction, and the place on its line, in [0, 1].
GNOMON_STRUCT(line_sample_place) { Real texel, place; };

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
GNOMON_KERNEL GNOMON_T(moving_vertex) line_sample_vertex(GNOMON_T(moving_vertex) v, GNOMON_T(line_sample) segment)
{
    Real s = Real(1) - segment.t;
    Real x = v.x0 * s + v.x1 * segment.t;
    Real y = v.y0 * s + v.y1 * segment.t;
    GNOMON_T(moving_vertex) r;
    r.z0 = v.z0 * s + v.z1 * segment.t;
    r.w0 = v.w0 * s + v.w1 * segment.t;
    r.z1 = r.z0;
    r.w1 = r.w0;
    Real half_x = (Real(0.5) * segment.along_x) * r.w0;
    Real half_y = (Real(0.5) * segment.along_y) * r.w0;
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
GNOMON_KERNEL GNOMON_T(line_sample_place) line_sample_place_of(Real x)
{
    GNOMON_T(line_sample_place) r;
    r.texel = texel_below(x);
    r.place = saturate_or_zero(x - r.texel);
    return r;
}

/// Shadow intensity in [0, 1] from those of four points around the receiver: up and down on lines along x, left and right
/// on lines along y. Two opposite points that agree decide, since a straight edge between them would part them; up and
/// down are first. Else the mean of both pairs, interpolated: share_y of the distance from up to down has passed at the
/// receiver, share_x of that from left to right.
/// Domain: intensities 0 or 1. Elsewhere a number in [0, 1].
/// NaN: 0 for the point, and 0 for a share.
/// Error: exact if two opposite points agree; else 8 2^-p.
/// Source: Gribel 2011
GNOMON_KERNEL Real line_sample_intensity(Real up, Real down, Real left, Real right, Real share_x, Real share_y)
{
    Real a = saturate_or_zero(up);
    Real b = saturate_or_zero(down);
    Real c = saturate_or_zero(left);
    Real d = saturate_or_zero(right);
    Real x = saturate_or_zero(share_x);
    Real y = saturate_or_zero(share_y);
    Real mean = Real(0.5) * ((a * (Real(1) - y) + b * y) + (c * (Real(1) - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
}

GNOMON_NAMESPACE_END
#endif
