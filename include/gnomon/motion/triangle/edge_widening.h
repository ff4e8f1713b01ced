// Edges moved outwards by what rounding may take from them. Two triangles that share an edge see it at the same times,
// bit for bit, so that nothing shows between them. Around a vertex, though, several edges meet, and each is rounded by
// itself: a sample on the vertex or beside it may then be outside of all triangles of a fan. Widened edges overlap by
// as little, which lists do not mind.
//
//     wide = edge_equation_widen(field.a, edge_equation_error(field.a, h_x, h_y), facing);   once for a tile of samples
//     edge = edge_equation_at(wide, s_x, s_y);                                              for moving_edge_inside
#ifndef GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H
#define GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H
#include "triangle_setup.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(edge_field_margin, 0.0000019073486328125); // 2^-19, 32 2^-p in float

/// The largest value within h_x and h_y of the origin, but for its sign.
GNOMON_KERNEL Real sample_plane_size(GNOMON_T(sample_plane) p, Real h_x, Real h_y)
{
    return (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y) + gnomon_abs(p.c);
}

/// The largest value of its coefficients there.
GNOMON_KERNEL Real edge_equation_size(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    Real outer = gnomon_max(sample_plane_size(f.e0, h_x, h_y), sample_plane_size(f.e2, h_x, h_y));
    return gnomon_max(outer, sample_plane_size(f.e1, h_x, h_y));
}

/// The most that rounding may take from an edge function at the samples within h_x and h_y of the origin, in all: from
/// planes that were exact before they were rounded to float, from their coefficients at the sample, and from the times
/// of moving_edge_inside, in float. That is 1 + 4 + 16 of 2^-24 of the largest coefficient; returned are 32.
GNOMON_KERNEL Real edge_equation_error(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    return GNOMON_LITERAL(edge_field_margin) * edge_equation_size(f, h_x, h_y);
}

/// The same for linear_edge_inside, whose times take 2 for 16: 8 are returned, and how far the edge function departs
/// from the one that is linear in time, a quarter of e0 - 2 e1 + e2.
GNOMON_KERNEL Real linear_edge_error(GNOMON_T(edge_equation) f, Real h_x, Real h_y)
{
    GNOMON_T(sample_plane) bend;
    bend.x = f.e0.x - Real(2) * f.e1.x + f.e2.x;
    bend.y = f.e0.y - Real(2) * f.e1.y + f.e2.y;
    bend.c = f.e0.c - Real(2) * f.e1.c + f.e2.c;
    return Real(0.25) * (edge_equation_error(f, h_x, h_y) + sample_plane_size(bend, h_x, h_y));
}

/// The edge moved outwards by a margin, its error: it is inside at all times at which the exact one is. Triangles
/// around a common vertex then leave no crack beside it, where each edge is rounded by itself, but overlap by as
/// little.
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
