// The edge functions of a moving triangle over many samples: how a rasterizer asks for all texels of a tile, and for
// whole blocks of them at once.
//
// The edge function of moving_triangle.h, (p_i - s w_i) x (p_j - s w_j) for a sample s, is the homogeneous line through
// p_i and p_j applied to (s_x, s_y, 1), so each of its three Bernstein coefficients is affine in the sample:
//     e(s) = c + x s_x + y s_y,   (x, y, c) = (X_i, Y_i, W_i) x (X_j, Y_j, W_j)
// Nine numbers for each edge then serve a whole tile. Over a block of samples a coefficient is at most its value at the
// middle plus |x| and |y| times half of the block's extents, and, since Bernstein polynomials are not negative, the
// edge function is at most the one with these coefficients, at all times. So moving_coverage of such edges contains
// all times at which the triangle covers any sample of the block: one kernel shades and culls, in space and in time.
//
//     field = moving_field_of(triangle, origin_x, origin_y);                    once for a tile
//     times = moving_coverage(moving_field_block(field, s_x, s_y, h_x, h_y, facing), facing);   none: skip the block
//     times = moving_coverage(moving_field_edges(field, s_x, s_y), facing);
#ifndef GNOMON_MOTION_EDGE_FIELD_H
#define GNOMON_MOTION_EDGE_FIELD_H
#include "moving_triangle.h"
GNOMON_NAMESPACE_BEGIN

/// c + x s_x + y s_y.
GNOMON_STRUCT sample_plane { Real x, y, c; };

/// Bernstein coefficients of an edge function, over the samples.
GNOMON_STRUCT edge_field { GNOMON_T(sample_plane) e0, e1, e2; };

/// Those across from the vertices a, b, c of a triangle.
GNOMON_STRUCT moving_field { GNOMON_T(edge_field) a, b, c; };

/// The line through two points of the plane, homogeneous.
GNOMON_KERNEL GNOMON_T(sample_plane) homogeneous_line(Real a_x, Real a_y, Real a_w, Real b_x, Real b_y, Real b_w)
{
    GNOMON_T(sample_plane) r;
    r.x = sheared_cross(a_y, a_w, b_y, b_w);
    r.y = sheared_cross(a_w, a_x, b_w, b_x);
    r.c = sheared_cross(a_x, a_y, b_x, b_y);
    return r;
}

/// The edge from a to b. Exchanging a and b negates it bit for bit.
GNOMON_KERNEL GNOMON_T(edge_field) edge_field_of(GNOMON_T(moving_vertex) a, GNOMON_T(moving_vertex) b)
{
    GNOMON_T(sample_plane) early = homogeneous_line(a.x0, a.y0, a.w0, b.x1, b.y1, b.w1);
    GNOMON_T(sample_plane) late = homogeneous_line(a.x1, a.y1, a.w1, b.x0, b.y0, b.w0);
    GNOMON_T(edge_field) f;
    f.e0 = homogeneous_line(a.x0, a.y0, a.w0, b.x0, b.y0, b.w0);
    f.e1.x = Real(0.5) * (early.x + late.x);
    f.e1.y = Real(0.5) * (early.y + late.y);
    f.e1.c = Real(0.5) * (early.c + late.c);
    f.e2 = homogeneous_line(a.x1, a.y1, a.w1, b.x1, b.y1, b.w1);
    return f;
}

/// The same vertex as seen from an origin on the map, in the units of x / w.
GNOMON_KERNEL GNOMON_T(moving_vertex) moving_vertex_from(GNOMON_T(moving_vertex) v, Real origin_x, Real origin_y)
{
    GNOMON_T(sheared_vertex) s = moving_vertex_sheared(v, origin_x, origin_y);
    v.x0 = s.x0;
    v.y0 = s.y0;
    v.x1 = s.x1;
    v.y1 = s.y1;
    return v;
}

/// Samples are then given relative to the origin, best one near them. Error of a coefficient at sample s, like that of
/// the covered times: 64 2^-p (X_i Y_j + Y_i X_j), X = max(|x| + (|origin_x| + |s_x|) |w|) over the shutter's ends and
/// Y alike, p the bits of the significand.
GNOMON_KERNEL GNOMON_T(moving_field) moving_field_of(GNOMON_T(moving_triangle) m, Real origin_x, Real origin_y)
{
    GNOMON_T(moving_vertex) a = moving_vertex_from(m.a, origin_x, origin_y);
    GNOMON_T(moving_vertex) b = moving_vertex_from(m.b, origin_x, origin_y);
    GNOMON_T(moving_vertex) c = moving_vertex_from(m.c, origin_x, origin_y);
    GNOMON_T(moving_field) f;
    f.a = edge_field_of(b, c);
    f.b = edge_field_of(c, a);
    f.c = edge_field_of(a, b);
    return f;
}

/// Odd in the plane, bit for bit.
GNOMON_KERNEL Real sample_plane_at(GNOMON_T(sample_plane) p, Real s_x, Real s_y)
{
    return (gnomon_product(p.x, s_x) + gnomon_product(p.y, s_y)) + p.c;
}

/// How far it rises within h_x and h_y.
GNOMON_KERNEL Real sample_plane_reach(GNOMON_T(sample_plane) p, Real h_x, Real h_y)
{
    return gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y;
}

GNOMON_KERNEL GNOMON_T(moving_edge) edge_field_at(GNOMON_T(edge_field) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edge) e;
    e.e0 = sample_plane_at(f.e0, s_x, s_y);
    e.e1 = sample_plane_at(f.e1, s_x, s_y);
    e.e2 = sample_plane_at(f.e2, s_x, s_y);
    return e;
}

/// The edge functions at a sample, for moving_coverage: two triangles that share an edge cover each sample near it
/// exactly one at a time, as with moving_triangle_edges.
GNOMON_KERNEL GNOMON_T(moving_edges) moving_field_edges(GNOMON_T(moving_field) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edges) e;
    e.a = edge_field_at(f.a, s_x, s_y);
    e.b = edge_field_at(f.b, s_x, s_y);
    e.c = edge_field_at(f.c, s_x, s_y);
    return e;
}

/// The edge function's bound: above where facing is 1, below where it is -1.
GNOMON_KERNEL GNOMON_T(moving_edge)
    edge_field_block(GNOMON_T(edge_field) f, Real s_x, Real s_y, Real h_x, Real h_y, GNOMON_SETTING facing)
{
    GNOMON_T(moving_edge) e = edge_field_at(f, s_x, s_y);
    e.e0 = e.e0 + facing * sample_plane_reach(f.e0, h_x, h_y);
    e.e1 = e.e1 + facing * sample_plane_reach(f.e1, h_x, h_y);
    e.e2 = e.e2 + facing * sample_plane_reach(f.e2, h_x, h_y);
    return e;
}

/// Bounds of the edge functions over the samples within h_x and h_y of (s_x, s_y), for moving_coverage with the same
/// facing, 1 or -1: outside of those times no sample of the block is covered by a triangle of this facing. Rounding
/// may take 8 2^-p of the extents of the tile from h_x and h_y: ask for a little more.
GNOMON_KERNEL GNOMON_T(moving_edges)
    moving_field_block(GNOMON_T(moving_field) f, Real s_x, Real s_y, Real h_x, Real h_y, GNOMON_SETTING facing)
{
    GNOMON_T(moving_edges) e;
    e.a = edge_field_block(f.a, s_x, s_y, h_x, h_y, facing);
    e.b = edge_field_block(f.b, s_x, s_y, h_x, h_y, facing);
    e.c = edge_field_block(f.c, s_x, s_y, h_x, h_y, facing);
    return e;
}

GNOMON_NAMESPACE_END
#endif
