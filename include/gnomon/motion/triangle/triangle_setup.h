// The edge functions of a moving triangle over many samples: coverage and depth for all texels of a rasterizer's tile,
// and for whole blocks of texels at once.
//
// The edge function of moving_triangle.h, (p_i - s w_i) x (p_j - s w_j) for a sample s, is the homogeneous line through
// p_i and p_j applied to (s_x, s_y, 1). So each of its three Bernstein coefficients is affine in the sample:
//     e(s) = c + x s_x + y s_y,   (x, y, c) = (X_i, Y_i, W_i) x (X_j, Y_j, W_j)
// Nine numbers for each edge serve a whole tile. Over a block of samples a coefficient is at most its value at the
// middle plus |x| and |y| times half of the block's extents. Bernstein polynomials are not negative, so the edge
// function is at all times at most the one with these bounds as coefficients. So moving_coverage of such edges contains
// all times at which the triangle covers any sample of the block: one kernel shades and culls, in space and in time.
//
//     setup = triangle_setup_make(triangle, origin_x, origin_y);                 once for a tile
//     blocks = triangle_setup_around(setup, h_x, h_y, facing);
//     times = moving_coverage(triangle_setup_edges(blocks, s_x, s_y), facing);   none: skip the block
//     times = moving_coverage(triangle_setup_edges(setup, s_x, s_y), facing);
//
// Vertices with equal motions have edge functions that are linear in time: the cross product of their motions, e0 - 2
// e1 + e2, vanishes. Then two planes serve for an edge, and a quotient for its time. Decide for each edge alone whether
// it is linear enough, so that both triangles at the edge decide alike and no crack opens:
//
//     linear = moving_edge_nonlinearity(b, c) <= tolerance, and so on for the other edges
//     times = linear_coverage(triangle_setup_edges_linear(setup, s_x, s_y))
//
// Depth that is linear in view distance is measured from that of vertex c:
//     z(t) = z_c(t) + N(t) / D(t),   N = e_a (z_a - z_c) + e_b (z_b - z_c),   D = e_a + e_b + e_c
// N is a cubic whose four Bernstein coefficients are affine in the sample, too, and D follows from the edge functions.
// This takes a third of the operations of the vertices' mean (moving_triangle.h), and nothing large cancels.
//
//     depths = depth_setup_make(setup, triangle);   once for a tile
//     curve = moving_depth_curve(depths, edges, s_x, s_y);
//     z = depth_curve_at(curve, t);   linear_depth_at, if edges and depths are linear
//
// Lines approximate depth where they are near enough, else lines of pieces, as for moving_depth_line:
//
//     line = depth_curve_line(curve, begin, end);   if (line.deviation <= tolerance), else
//     for (passed = 0; passed < 1; passed = piece.passed)
//         piece = depth_curve_piece(curve, begin, end, passed, tolerance);
#ifndef GNOMON_MOTION_TRIANGLE_TRIANGLE_SETUP_H
#define GNOMON_MOTION_TRIANGLE_TRIANGLE_SETUP_H
#include "moving_triangle.h"
GNOMON_NAMESPACE_BEGIN

/// An affine function of the sample: c + x s_x + y s_y.
GNOMON_STRUCT(sample_plane) { Real x, y, c; };

/// Bernstein coefficients of an edge function, as affine functions of the sample.
GNOMON_STRUCT(edge_equation) { GNOMON_T(sample_plane) e0, e1, e2; };

/// The edge equations opposite to the vertices a, b, c of a triangle.
GNOMON_STRUCT(triangle_setup) { GNOMON_T(edge_equation) a, b, c; };

/// Bernstein coefficients of N as affine functions of the sample, the middle ones times 3; z_c at shutter open and
/// close; the least and the largest depth of all vertices, in [-1, 1].
GNOMON_STRUCT(depth_setup)
{
    GNOMON_T(sample_plane) n0, n1, n2, n3;
    Real z0, z1, least, most;
};

/// Depth at one sample: the coefficients of N, the coefficients of D with the middle one times 2, and the rest as in
/// depth_setup.
GNOMON_STRUCT(depth_curve) { Real n0, n1, n2, n3, d0, d1, d2, z0, z1, least, most; };

/// Homogeneous line through two points of the plane.
GNOMON_DETAIL_KERNEL GNOMON_T(sample_plane) homogeneous_line(Real a_x, Real a_y, Real a_w, Real b_x, Real b_y, Real b_w)
{
    GNOMON_T(sample_plane) r;
    r.x = sheared_cross(a_y, a_w, b_y, b_w);
    r.y = sheared_cross(a_w, a_x, b_w, b_x);
    r.c = sheared_cross(a_x, a_y, b_x, b_y);
    return r;
}

/// Edge equation from a to b. Exchanging a and b negates it bit for bit.
GNOMON_KERNEL GNOMON_T(edge_equation) edge_equation_make(GNOMON_T(moving_vertex) a, GNOMON_T(moving_vertex) b)
{
    sample_plane early = homogeneous_line(a.x0, a.y0, a.w0, b.x1, b.y1, b.w1);
    sample_plane late = homogeneous_line(a.x1, a.y1, a.w1, b.x0, b.y0, b.w0);
    GNOMON_T(edge_equation) f;
    f.e0 = homogeneous_line(a.x0, a.y0, a.w0, b.x0, b.y0, b.w0);
    f.e1.x = Real(0.5) * (early.x + late.x);
    f.e1.y = Real(0.5) * (early.y + late.y);
    f.e1.c = Real(0.5) * (early.c + late.c);
    f.e2 = homogeneous_line(a.x1, a.y1, a.w1, b.x1, b.y1, b.w1);
    return f;
}

/// The vertex relative to an origin on the map, in the units of x / w.
GNOMON_DETAIL_KERNEL GNOMON_T(moving_vertex) moving_vertex_translate(GNOMON_T(moving_vertex) v, Real origin_x,
                                                                     Real origin_y)
{
    sheared_vertex s = moving_vertex_shear(v, origin_x, origin_y);
    v.x0 = s.x0;
    v.y0 = s.y0;
    v.x1 = s.x1;
    v.y1 = s.y1;
    return v;
}

/// Upper bound of the distance, in the units of x / w, of the edge from a to b from an edge that is linear in time and
/// equal at both ends. It holds among the samples between the least and the largest x / w and y / w of both vertices.
/// The same from b to a, bit for bit.
/// Domain: all w > 0.
/// NaN: the result for an edge without length is NaN.
/// Error: 16 2^-p of the result, and 32 2^-p times the products X_i Y_j + Y_i X_j of triangle_setup_make's error, over
/// the least slope of the edge function.
GNOMON_KERNEL Real moving_edge_nonlinearity(GNOMON_T(moving_vertex) a, GNOMON_T(moving_vertex) b)
{
    Real a_x0 = a.x0 / a.w0;
    Real a_x1 = a.x1 / a.w1;
    Real a_y0 = a.y0 / a.w0;
    Real a_y1 = a.y1 / a.w1;
    Real b_x0 = b.x0 / b.w0;
    Real b_x1 = b.x1 / b.w1;
    Real b_y0 = b.y0 / b.w0;
    Real b_y1 = b.y1 / b.w1;
    Real low_x = gnomon_min(gnomon_min(a_x0, a_x1), gnomon_min(b_x0, b_x1));
    Real low_y = gnomon_min(gnomon_min(a_y0, a_y1), gnomon_min(b_y0, b_y1));
    Real high_x = gnomon_max(gnomon_max(a_x0, a_x1), gnomon_max(b_x0, b_x1));
    Real high_y = gnomon_max(gnomon_max(a_y0, a_y1), gnomon_max(b_y0, b_y1));
    Real x = Real(0.5) * (low_x + high_x);
    Real y = Real(0.5) * (low_y + high_y);
    moving_vertex p = moving_vertex_translate(a, x, y);
    moving_vertex q = moving_vertex_translate(b, x, y);
    edge_equation f = edge_equation_make(p, q);
    sample_plane bend = homogeneous_line(p.x1 - p.x0, p.y1 - p.y0, p.w1 - p.w0, q.x1 - q.x0, q.y1 - q.y0, q.w1 - q.w0);
    Real most = gnomon_abs(bend.c) +
                Real(0.5) * (gnomon_abs(bend.x) * (high_x - low_x) + gnomon_abs(bend.y) * (high_y - low_y));
    // Distance is value over slope. Between the ends, the slope is least where its line is nearest to 0.
    Real turn_x = f.e2.x - f.e0.x;
    Real turn_y = f.e2.y - f.e0.y;
    Real turn = turn_x * turn_x + turn_y * turn_y;
    Real nearest = saturate_or_zero(Real(-1) * (f.e0.x * turn_x + f.e0.y * turn_y) / turn);
    Real slope_x = f.e0.x + nearest * turn_x;
    Real slope_y = f.e0.y + nearest * turn_y;
    return Real(0.25) * most / gnomon_sqrt(slope_x * slope_x + slope_y * slope_y);
}

/// Edge equations of a triangle. Samples are relative to the origin, which is best near them.
/// Error: 64 2^-p (X_i Y_j + Y_i X_j) for a coefficient at sample s; the covered times are exact for coefficients that
/// differ by as much. X = max(|x| + (|origin_x| + |s_x|) |w|) over the shutter's ends, Y likewise, p the bits of the
/// significand.
GNOMON_KERNEL GNOMON_T(triangle_setup) triangle_setup_make(GNOMON_T(moving_triangle) m, Real origin_x, Real origin_y)
{
    moving_vertex a = moving_vertex_translate(m.a, origin_x, origin_y);
    moving_vertex b = moving_vertex_translate(m.b, origin_x, origin_y);
    moving_vertex c = moving_vertex_translate(m.c, origin_x, origin_y);
    GNOMON_T(triangle_setup) f;
    f.a = edge_equation_make(b, c);
    f.b = edge_equation_make(c, a);
    f.c = edge_equation_make(a, b);
    return f;
}

/// Value of the affine function p at the sample. Odd in p, bit for bit.
GNOMON_DETAIL_KERNEL Real sample_plane_at(GNOMON_T(sample_plane) p, Real s_x, Real s_y)
{
    return (gnomon_product(p.x, s_x) + gnomon_product(p.y, s_y)) + p.c;
}

/// Edge function at a sample.
GNOMON_KERNEL GNOMON_T(moving_edge) edge_equation_at(GNOMON_T(edge_equation) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edge) e;
    e.e0 = sample_plane_at(f.e0, s_x, s_y);
    e.e1 = sample_plane_at(f.e1, s_x, s_y);
    e.e2 = sample_plane_at(f.e2, s_x, s_y);
    return e;
}

/// Edge functions at a sample, for moving_coverage. Two triangles that share an edge cover each sample near it exactly
/// one at a time, as with moving_triangle_edges.
GNOMON_KERNEL GNOMON_T(moving_edges) triangle_setup_edges(GNOMON_T(triangle_setup) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edges) e;
    e.a = edge_equation_at(f.a, s_x, s_y);
    e.b = edge_equation_at(f.b, s_x, s_y);
    e.c = edge_equation_at(f.c, s_x, s_y);
    return e;
}

/// Edge function at a sample, for an edge function that is linear in time: its middle coefficient is the mean of the
/// others.
GNOMON_DETAIL_KERNEL GNOMON_T(moving_edge) linear_edge_at(GNOMON_T(edge_equation) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edge) e;
    e.e0 = sample_plane_at(f.e0, s_x, s_y);
    e.e2 = sample_plane_at(f.e2, s_x, s_y);
    e.e1 = Real(0.5) * (e.e0 + e.e2);
    return e;
}

/// Edge functions at a sample, for linear_coverage: all three are linear in time.
GNOMON_KERNEL GNOMON_T(moving_edges) triangle_setup_edges_linear(GNOMON_T(triangle_setup) f, Real s_x, Real s_y)
{
    GNOMON_T(moving_edges) e;
    e.a = linear_edge_at(f.a, s_x, s_y);
    e.b = linear_edge_at(f.b, s_x, s_y);
    e.c = linear_edge_at(f.c, s_x, s_y);
    return e;
}

/// Upper bound of the affine function p over the samples within h_x and h_y of each sample; the lower bound if facing
/// is -1.
GNOMON_DETAIL_KERNEL GNOMON_T(sample_plane) sample_plane_around(GNOMON_T(sample_plane) p, Real h_x, Real h_y,
                                                                GNOMON_SETTING facing)
{
    p.c = p.c + facing * (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y);
    return p;
}

/// Bounds of an edge function, as of triangle_setup_around.
GNOMON_DETAIL_KERNEL GNOMON_T(edge_equation) edge_equation_around(GNOMON_T(edge_equation) f, Real h_x, Real h_y,
                                                                  GNOMON_SETTING facing)
{
    f.e0 = sample_plane_around(f.e0, h_x, h_y, facing);
    f.e1 = sample_plane_around(f.e1, h_x, h_y, facing);
    f.e2 = sample_plane_around(f.e2, h_x, h_y, facing);
    return f;
}

/// Bounds of the edge functions over the samples within h_x and h_y of each sample: upper bounds if facing is 1, lower
/// bounds if facing is -1. moving_coverage at (s_x, s_y), with the same facing, contains all times at which a triangle
/// of this facing covers any sample of the block around (s_x, s_y).
/// Error: rounding may reduce h_x and h_y by 8 2^-p of the tile's extents; pass a little more.
GNOMON_KERNEL GNOMON_T(triangle_setup) triangle_setup_around(GNOMON_T(triangle_setup) f, Real h_x, Real h_y,
                                                             GNOMON_SETTING facing)
{
    f.a = edge_equation_around(f.a, h_x, h_y, facing);
    f.b = edge_equation_around(f.b, h_x, h_y, facing);
    f.c = edge_equation_around(f.c, h_x, h_y, facing);
    return f;
}

/// The sum of a times k_a and b times k_b.
GNOMON_DETAIL_KERNEL GNOMON_T(sample_plane) sample_planes_combine(GNOMON_T(sample_plane) a, Real k_a,
                                                                  GNOMON_T(sample_plane) b, Real k_b)
{
    GNOMON_T(sample_plane) r;
    r.x = a.x * k_a + b.x * k_b;
    r.y = a.y * k_a + b.y * k_b;
    r.c = a.c * k_a + b.c * k_b;
    return r;
}

/// Twice the middle coefficient of an edge times one end of a depth, plus an outer coefficient times the other end.
GNOMON_DETAIL_KERNEL GNOMON_T(sample_plane) depth_setup_middle(GNOMON_T(sample_plane) outer, Real across,
                                                               GNOMON_T(sample_plane) middle, Real beside)
{
    return sample_planes_combine(outer, across, middle, Real(2) * beside);
}

/// Depths of the triangle that the setup is of. The vertices' z is linear in view distance; samples are those of the
/// setup.
GNOMON_KERNEL GNOMON_T(depth_setup) depth_setup_make(GNOMON_T(triangle_setup) f, GNOMON_T(moving_triangle) m)
{
    Real a0 = m.a.z0 - m.c.z0;
    Real a1 = m.a.z1 - m.c.z1;
    Real b0 = m.b.z0 - m.c.z0;
    Real b1 = m.b.z1 - m.c.z1;
    GNOMON_T(depth_setup) d;
    d.n0 = sample_planes_combine(f.a.e0, a0, f.b.e0, b0);
    d.n1 = sample_planes_combine(depth_setup_middle(f.a.e0, a1, f.a.e1, a0), Real(1),
                                 depth_setup_middle(f.b.e0, b1, f.b.e1, b0), Real(1));
    d.n2 = sample_planes_combine(depth_setup_middle(f.a.e2, a0, f.a.e1, a1), Real(1),
                                 depth_setup_middle(f.b.e2, b0, f.b.e1, b1), Real(1));
    d.n3 = sample_planes_combine(f.a.e2, a1, f.b.e2, b1);
    d.z0 = m.c.z0;
    d.z1 = m.c.z1;
    Real least = gnomon_min(gnomon_min(gnomon_min(m.a.z0, m.a.z1), gnomon_min(m.b.z0, m.b.z1)), gnomon_min(d.z0, d.z1));
    Real most = gnomon_max(gnomon_max(gnomon_max(m.a.z0, m.a.z1), gnomon_max(m.b.z0, m.b.z1)), gnomon_max(d.z0, d.z1));
    d.least = gnomon_max(gnomon_min(least, Real(1)), Real(-1));
    d.most = gnomon_max(gnomon_min(most, Real(1)), Real(-1));
    return d;
}

/// Depth as a function of time at a sample; e are the edge functions at the same sample, from triangle_setup_edges.
GNOMON_KERNEL GNOMON_T(depth_curve) moving_depth_curve(GNOMON_T(depth_setup) d, GNOMON_T(moving_edges) e, Real s_x,
                                                       Real s_y)
{
    GNOMON_T(depth_curve) r;
    r.n0 = sample_plane_at(d.n0, s_x, s_y);
    r.n1 = sample_plane_at(d.n1, s_x, s_y);
    r.n2 = sample_plane_at(d.n2, s_x, s_y);
    r.n3 = sample_plane_at(d.n3, s_x, s_y);
    r.d0 = (e.a.e0 + e.b.e0) + e.c.e0;
    r.d1 = Real(2) * ((e.a.e1 + e.b.e1) + e.c.e1);
    r.d2 = (e.a.e2 + e.b.e2) + e.c.e2;
    r.z0 = d.z0;
    r.z1 = d.z1;
    r.least = d.least;
    r.most = d.most;
    return r;
}

/// Depth of the triangle's point at the sample at time t in [0, 1], always within the limits of all vertices' depths.
/// Where D is 0, such as where the triangle turns edge-on, one of these limits.
/// Domain: the triangle covers the sample at time t, and all w > 0.
/// NaN: the farthest depth of the vertices.
/// Error: 32 2^-p (S_a |z_a - z_c| + S_b |z_b - z_c| + |z - z_c| (S_a + S_b + S_c)) / |D| and 8 2^-p; S_k the products
/// X_i Y_j + Y_i X_j of edge k in triangle_setup_make's error, |z_k - z_c| the larger one of both ends of the shutter.
GNOMON_KERNEL Real depth_curve_at(GNOMON_T(depth_curve) c, Real t)
{
    Real s = Real(1) - t;
    Real numerator = (c.n0 * s + c.n1 * t) * (s * s) + (c.n2 * s + c.n3 * t) * (t * t);
    Real denominator = (c.d0 * s + c.d1 * t) * s + c.d2 * (t * t);
    Real z = (c.z0 * s + c.z1 * t) + numerator / denominator;
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Depth at time t as of depth_curve_at, for N and D that are linear in time: edges are linear, and depths of vertices
/// change alike.
/// NaN: the farthest depth of the vertices.
/// Error: that of depth_curve_at.
GNOMON_KERNEL Real linear_depth_at(GNOMON_T(depth_curve) c, Real t)
{
    Real s = Real(1) - t;
    Real z = (c.z0 * s + c.z1 * t) + (c.n0 * s + c.n3 * t) / (c.d0 * s + c.d2 * t);
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Line through the depths of depth_curve_at at the times begin and end, and an upper bound of the deviation of depth
/// from it. Where D may vanish, the bound is the largest deviation within the limits.
/// Domain: begin <= end, both in [0, 1].
/// Error: 24 2^-p (n + d (r + deviation)) / |D| and 8 2^-p of the largest depth; n and d the largest coefficients of N
/// and D, the middle ones as means, not times 3 and 2; r the larger |N / D| at an end, |D| where it is least.
GNOMON_KERNEL GNOMON_T(depth_line) depth_curve_line(GNOMON_T(depth_curve) c, Real begin, Real end)
{
    Real b = Real(1) - begin;
    Real f = Real(1) - end;
    // Bernstein coefficients between the two times, by blossoming.
    Real three0 = Real(3) * c.n0;
    Real three3 = Real(3) * c.n3;
    Real n0 = (c.n0 * b + c.n1 * begin) * (b * b) + (c.n2 * b + c.n3 * begin) * (begin * begin);
    Real n1 = ((three0 * f + c.n1 * end) * (b * b) + (c.n2 * f + three3 * end) * (begin * begin)) +
              (c.n1 * f + c.n2 * end) * (Real(2) * (b * begin));
    Real n2 = ((three0 * b + c.n1 * begin) * (f * f) + (c.n2 * b + three3 * begin) * (end * end)) +
              (c.n1 * b + c.n2 * begin) * (Real(2) * (f * end));
    Real n3 = (c.n0 * f + c.n1 * end) * (f * f) + (c.n2 * f + c.n3 * end) * (end * end);
    Real d0 = (c.d0 * b + c.d1 * begin) * b + c.d2 * (begin * begin);
    Real d1 = (Real(2) * (c.d0 * f) + c.d1 * end) * b + (c.d1 * f + Real(2) * (c.d2 * end)) * begin;
    Real d2 = (c.d0 * f + c.d1 * end) * f + c.d2 * (end * end);
    Real q0 = n0 / d0;
    Real q1 = n3 / d2;
    Real p0 = (n1 - q0 * d1) - q1 * d0;
    Real p1 = (n2 - q1 * d1) - q0 * d2;
    Real bend = depth_nonlinearity(gnomon_max(gnomon_abs(p0), gnomon_abs(p1)), d0, d2, d1, d1);
    Real free0 = (c.z0 * b + c.z1 * begin) + q0;
    Real free1 = (c.z0 * f + c.z1 * end) + q1;
    Real z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    Real z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// Line through the depths of linear_depth_at at the times begin and end, and the largest deviation of depth from it,
/// for N and D that are linear in time. The bound is attained.
GNOMON_KERNEL GNOMON_T(depth_line) linear_depth_line(GNOMON_T(depth_curve) c, Real begin, Real end)
{
    Real b = Real(1) - begin;
    Real f = Real(1) - end;
    Real d0 = c.d0 * b + c.d2 * begin;
    Real d1 = c.d0 * f + c.d2 * end;
    Real q0 = (c.n0 * b + c.n3 * begin) / d0;
    Real q1 = (c.n0 * f + c.n3 * end) / d1;
    Real bend = depth_nonlinearity(gnomon_abs((q1 - q0) * (d1 - d0)), d0, d1, d0 + d1, d0 + d1);
    Real free0 = (c.z0 * b + c.z1 * begin) + q0;
    Real free1 = (c.z0 * f + c.z1 * end) + q1;
    Real z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    Real z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// The next piece of an interval, as of moving_depth_piece, with lines of depth_curve_line; for linear N and D, too.
GNOMON_KERNEL GNOMON_T(depth_piece) depth_curve_piece(GNOMON_T(depth_curve) c, Real begin, Real end, Real passed,
                                                      GNOMON_SETTING tolerance)
{
    depth_trial r = depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < Real(1)))
            r = depth_trial_next(r, depth_curve_line(c, r.piece.t0, r.piece.t1), begin, end, tolerance);
    }
    return r.piece;
}

GNOMON_NAMESPACE_END
#endif
