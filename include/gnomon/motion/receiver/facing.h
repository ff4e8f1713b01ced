// When a surface that turns faces the light (Palmer 2011, 2.3.2, (2.5) and (2.6)): its normal n and the direction d
// from it to the light both go linearly from shutter open to shutter close, and it faces the light while
//     f(t) = (n0 (1 - t) + n1 t) . (d0 (1 - t) + d1 t) >= 0
// The Bernstein coefficients of f are n0 . d0, (n0 . d1 + n1 . d0) / 2 and n1 . d1, so f is an edge of
// coverage_intervals.h, and moving_edge_inside(facing_function(n, d), 1) has the up to two intervals: from begin to end less a
// gap. Outside of them the surface is dark, whatever the map says; within, receiver_path_clip has the part of its path.
// Between a point and a light that both go straight, d is linear; the normal of a triangle is a quadratic, for which
// its line stands here as in the thesis. The sign of f is the same for vectors of any length, if both ends of one are
// scaled alike, so neither needs to be normalised.
#ifndef GNOMON_MOTION_RECEIVER_FACING_H
#define GNOMON_MOTION_RECEIVER_FACING_H
#include "../triangle/coverage_intervals.h"
GNOMON_NAMESPACE_BEGIN

/// A vector at shutter open and at shutter close.
GNOMON_STRUCT(moving_vector) { Real x0, y0, z0, x1, y1, z1; };

/// f as an edge, for moving_edge_inside with facing 1. Error of a coefficient: 4 2^-p |n| |d|, the larger lengths of
/// both ends; the facing times are exact for coefficients that differ by 20 2^-p |n| |d|. With a NaN, or beyond
/// moving_edge_limit, f is 0 throughout: a surface of which nothing is known faces the light.
GNOMON_KERNEL GNOMON_T(moving_edge) facing_function(GNOMON_T(moving_vector) n, GNOMON_T(moving_vector) d)
{
    Real n0_d1 = (n.x0 * d.x1 + n.y0 * d.y1) + n.z0 * d.z1;
    Real n1_d0 = (n.x1 * d.x0 + n.y1 * d.y0) + n.z1 * d.z0;
    GNOMON_T(moving_edge) f;
    f.e0 = (n.x0 * d.x0 + n.y0 * d.y0) + n.z0 * d.z0;
    f.e1 = Real(0.5) * (n0_d1 + n1_d0);
    f.e2 = (n.x1 * d.x1 + n.y1 * d.y1) + n.z1 * d.z1;
    GNOMON_MASK known = moving_edge_size(f) < GNOMON_LITERAL(moving_edge_limit);
    f.e0 = gnomon_select(known, f.e0, Real(0));
    f.e1 = gnomon_select(known, f.e1, Real(0));
    f.e2 = gnomon_select(known, f.e2, Real(0));
    return f;
}

GNOMON_NAMESPACE_END
#endif
