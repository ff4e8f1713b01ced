// Edges moved outwards by the amount that rounding may take from them. Two triangles that share an edge cover each
// sample beside it at complementary times, bit for bit, so no gap shows between them. At a vertex, however, several
// edges meet, and each is rounded independently: a sample on the vertex or beside it may be outside of all triangles of
// a fan. Widened edges overlap by the same small amount, which lists tolerate.
//
//     margin = edge_equation_error(setup.a, h_x, h_y);
//     wide = edge_equation_widen(setup.a, margin, facing);   once for a tile of samples
//     edge = edge_equation_at(wide, s_x, s_y);               for moving_edge_inside
#ifndef GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H
#define GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H
#include "triangle_setup.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(edge_field_margin, 0.0000019073486328125); // 2^-19, 32 2^-p in float

/// Largest absolute value of the plane within h_x and h_y of the origin.
GNOMON_DETAIL_KERNEL Real sample_plane_size(GNOMON_T(sample_plane) p, Real h_x, Real h_y)
{
    return (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y) + gnomon_abs(p.c);
}

/// Largest absolute value of the edge function's coefficients within h_x and h_y of the origin.
GNOMON_DETAIL_KERNEL Real edge_equation_size(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    Real outer = gnomon_max(sample_plane_size(f.e0, h_x, h_y), sample_plane_size(f.e2, h_x, h_y));
    return gnomon_max(outer, sample_plane_size(f.e1, h_x, h_y));
}

/// Upper bound of the rounding of an edge function at the samples within h_x and h_y of the origin. It covers planes
/// that were exact before they were rounded to float, their coefficients at the sample, and the times of
/// moving_edge_inside, all in float. These take 1 + 4 + 16 units of 2^-24 of the largest coefficient; the bound is 32.
GNOMON_KERNEL Real edge_equation_error(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    return GNOMON_LITERAL(edge_field_margin) * edge_equation_size(f, h_x, h_y);
}

/// Upper bound of the rounding of an edge function for linear_edge_inside. Its times take 2 units instead of 16, and
/// the bound is 8. The distance between the edge function and the linear one, a quarter of e0 - 2 e1 + e2, is added.
GNOMON_KERNEL Real linear_edge_error(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    GNOMON_T(sample_plane) bend;
    bend.x = f.e0.x - Real(2) * f.e1.x + f.e2.x;
    bend.y = f.e0.y - Real(2) * f.e1.y + f.e2.y;
    bend.c = f.e0.c - Real(2) * f.e1.c + f.e2.c;
    return Real(0.25) * (edge_equation_error(f, h_x, h_y) + sample_plane_size(bend, h_x, h_y));
}

/// The edge moved outwards by a margin. With its error as margin, the edge is inside at all times at which the exact
/// one is. Triangles around a common vertex then leave no crack, although each edge is rounded independently, but
/// overlap by as little.
GNOMON_KERNEL GNOMON_T(edge_equation) edge_equation_widen(GNOMON_T(edge_equation) f, Real margin, GNOMON_SETTING facing)
{
    Real by = facing * margin;
    f.e0.c = f.e0.c + by;
    f.e1.c = f.e1.c + by;
    f.e2.c = f.e2.c + by;
    return f;
}

GNOMON_NAMESPACE_END
#endif
