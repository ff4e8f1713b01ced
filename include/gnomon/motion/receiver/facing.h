// Times at which a turning surface faces the light (Palmer 2011, 2.3.2, (2.5) and (2.6)). The normal n and the
// direction d from the surface to the light are both linear in time from shutter open to shutter close. The surface
// faces the light while
//     f(t) = (n0 (1 - t) + n1 t) . (d0 (1 - t) + d1 t) >= 0
// The Bernstein coefficients of f are n0 . d0, (n0 . d1 + n1 . d0) / 2 and n1 . d1, so f is an edge function of
// coverage_intervals.h. moving_edge_inside(facing_function(n, d), 1) returns the facing times: from begin to end except
// for one gap, hence up to two intervals. Outside of them the surface is dark, with or without casters; inside,
// receiver_path_clip returns the part of the receiver's path.
//
// d is linear if the point and the light both move along straight lines. The normal of a triangle is quadratic in time;
// as in the thesis, a line replaces it here. Only the sign of f matters, so n and d need not be normalised, as long as
// each is scaled alike at both ends.
#ifndef GNOMON_MOTION_RECEIVER_FACING_H
#define GNOMON_MOTION_RECEIVER_FACING_H
#include "../triangle/coverage_intervals.h"
GNOMON_NAMESPACE_BEGIN

/// A vector at shutter open and at shutter close.
GNOMON_STRUCT(moving_vector) { Real x0, y0, z0, x1, y1, z1; };

/// The facing function f as an edge function, for moving_edge_inside with facing 1.
/// Domain: beyond moving_edge_limit f is 0 at all times, so the surface counts as facing the light.
/// NaN: f is 0 at all times, too.
/// Error: 4 2^-p |n| |d| for a coefficient, with the larger lengths of both ends; the facing times are exact for
/// coefficients that differ by 20 2^-p |n| |d|.
/// Source: Palmer 2011, Eq. 2.5; Palmer 2011, Eq. 2.6
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
