// A triangle whose vertices move linearly through clip space while the shutter is open (Akenine-Moller et al. 2007), as
// one sample of a shadow map sees it: edge functions, coverage, depth.
//
// A vertex is p(t) = (1 - t) q + t r. Sheared by the sample (s_x, s_y), its coordinates (x - s_x w, y - s_y w) are
// linear in t as well, and 0 where the vertex projects to the sample; an edge function is the cross product of two of
// them, a quadratic in t in perspective, too (w is 1 in an orthographic view):
//     e(t) = p_i(t) x p_j(t) = (1 - t)^2 q_i x q_j + t (1 - t) (q_i x r_j + r_i x q_j) + t^2 r_i x r_j
// It is the homogeneous edge function of Laine & Karras 2011, and the point of the triangle that the sample sees is the
// mean of the vertices weighted by the edge functions across from them. So its depth is a cubic over a cubic,
//     z / w = sum_k e_k(t) z_k(t) / sum_k e_k(t) w_k(t)
// and depth that is linear in view distance, being affine in the point, with 1 for w_k, a cubic over a quadratic. Lists
// of intervals approximate it by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance asks for (chapter 5).
#ifndef GNOMON_MOTION_MOVING_TRIANGLE_H
#define GNOMON_MOTION_MOVING_TRIANGLE_H
#include "coverage_times.h"
GNOMON_NAMESPACE_BEGIN

/// In clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
GNOMON_STRUCT moving_vertex { Real x0, y0, z0, w0, x1, y1, z1, w1; };

GNOMON_STRUCT moving_triangle { GNOMON_T(moving_vertex) a, b, c; };

/// Relative to a sample, at shutter open and at shutter close.
GNOMON_STRUCT sheared_vertex { Real x0, y0, x1, y1; };

/// Depth at the ends of an interval, and how far the depth between departs from the line.
GNOMON_STRUCT depth_line { Real z0, z1, deviation; };

/// A line of depth from time t0 to t1, and how much of the interval that it is a piece of has passed by then.
GNOMON_STRUCT depth_piece { Real t0, t1, z0, z1, passed; };

/// The sample is in the same units as x / w.
GNOMON_KERNEL GNOMON_T(sheared_vertex) moving_vertex_sheared(GNOMON_T(moving_vertex) v, Real s_x, Real s_y)
{
    GNOMON_T(sheared_vertex) r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Odd in the two vectors bit for bit, whatever the compiler contracts.
GNOMON_KERNEL Real sheared_cross(Real a_x, Real a_y, Real b_x, Real b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// The edge from a to b: positive where the sample is on its left. Exchanging a and b negates it bit for bit.
GNOMON_KERNEL GNOMON_T(moving_edge) moving_edge_of(GNOMON_T(sheared_vertex) a, GNOMON_T(sheared_vertex) b)
{
    GNOMON_T(moving_edge) e;
    e.e0 = sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = Real(0.5) * (sheared_cross(a.x0, a.y0, b.x1, b.y1) + sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// All three, for moving_coverage. Positive where the triangle runs counterclockwise around the sample. Error of a
/// coefficient, like that of the covered times: 32 2^-p (X_i Y_j + Y_i X_j), X = max(|x| + |s_x w|) and Y = max(|y| +
/// |s_y w|) over the shutter's ends, p the bits of the significand.
GNOMON_KERNEL GNOMON_T(moving_edges) moving_triangle_edges(GNOMON_T(moving_triangle) m, Real s_x, Real s_y)
{
    GNOMON_T(sheared_vertex) a = moving_vertex_sheared(m.a, s_x, s_y);
    GNOMON_T(sheared_vertex) b = moving_vertex_sheared(m.b, s_x, s_y);
    GNOMON_T(sheared_vertex) c = moving_vertex_sheared(m.c, s_x, s_y);
    GNOMON_T(moving_edges) e;
    e.a = moving_edge_of(b, c);
    e.b = moving_edge_of(c, a);
    e.c = moving_edge_of(a, b);
    return e;
}

/// Depth of the point at the sample at time t, limited to [-1, 1]; e as of moving_triangle_edges. Divided is 1 where z
/// is of clip space, for depth z / w, and 0 where z is linear in view distance already: the point's own z is the mean.
/// Edge functions against the triangle's facing, as rounding and times outside of the coverage make them, count as 0,
/// so that the depth stays between those of the vertices where all w > 0. Where all three vanish, the depth of the
/// centroid. Where the point is behind the light, w <= 0, or anything is NaN, the far plane, 1.
/// Error: that of the edge functions times sum_k |z_k - z v_k| / |sum_k e_k v_k|, and 16 2^-p of the largest |z_k /
/// v_k|, v = w where divided, else 1.
GNOMON_KERNEL Real moving_depth_at(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real t,
                                   GNOMON_SETTING divided)
{
    Real a = moving_edge_at(e.a, t);
    Real b = moving_edge_at(e.b, t);
    Real c = moving_edge_at(e.c, t);
    GNOMON_MASK back = (a + b) + c < Real(0);
    a = gnomon_max(gnomon_select(back, Real(-1) * a, a), Real(0));
    b = gnomon_max(gnomon_select(back, Real(-1) * b, b), Real(0));
    c = gnomon_max(gnomon_select(back, Real(-1) * c, c), Real(0));
    GNOMON_MASK vanished = (a + b) + c <= Real(0);
    a = gnomon_select(vanished, Real(1), a);
    b = gnomon_select(vanished, Real(1), b);
    c = gnomon_select(vanished, Real(1), c);

    Real s = Real(1) - t;
    Real z = (a * (m.a.z0 * s + m.a.z1 * t) + b * (m.b.z0 * s + m.b.z1 * t)) + c * (m.c.z0 * s + m.c.z1 * t);
    Real w = (a * (m.a.w0 * s + m.a.w1 * t) + b * (m.b.w0 * s + m.b.w1 * t)) + c * (m.c.w0 * s + m.c.w1 * t);
    Real divisor = gnomon_select(Real(0) < divided, w, (a + b) + c);
    Real depth = gnomon_max(gnomon_min(z / divisor, Real(1)), Real(-1)); // a NaN becomes 1
    return gnomon_select(Real(0) < w, depth, Real(1));
}

/// Depth z / w of a triangle in clip space, not linear in view distance in perspective.
GNOMON_KERNEL Real moving_triangle_depth(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real t)
{
    return moving_depth_at(m, e, t, Real(1));
}

/// Depth linear in view distance, of vertices that have it for z: a cubic over a quadratic in perspective, too, and
/// linear in time for a plane across the light's axis that moves along it.
GNOMON_KERNEL Real moving_triangle_linear_depth(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real t)
{
    return moving_depth_at(m, e, t, Real(0));
}

/// The line that stands for the depth between two times, exact at both, and the largest distance of the depth from it
/// at five times, 13/64 of the way apart. Depth less line is a quartic over a cubic, both ends among its roots: it
/// cannot vanish at all five. Divided as for moving_depth_at.
/// Error: where a deviation of 0.005 is found, 999 of 1000 intervals are within 0.006; near a turn of the facing depth
/// may run more steeply than any samples tell.
GNOMON_KERNEL GNOMON_T(depth_line) moving_depth_line(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real begin,
                                                     Real end, GNOMON_SETTING divided)
{
    GNOMON_T(depth_line) r;
    r.z0 = moving_depth_at(m, e, begin, divided);
    r.z1 = moving_depth_at(m, e, end, divided);
    r.deviation = Real(0);
    Real passed = Real(0.09375); // exact, as are its sums
    for (int i = 0; i < 5; ++i) {
        Real left = Real(1) - passed;
        Real z = moving_depth_at(m, e, begin * left + end * passed, divided);
        r.deviation = gnomon_max(r.deviation, gnomon_abs(z - (r.z0 * left + r.z1 * passed)));
        passed = passed + Real(0.203125);
    }
    return r;
}

/// The same for depth z / w.
GNOMON_KERNEL GNOMON_T(depth_line)
    moving_triangle_depth_line(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real begin, Real end)
{
    return moving_depth_line(m, e, begin, end, Real(1));
}

/// Where an interval is so much passed, in 32nds: begin and end themselves where passed is 0 and 1, in order between.
GNOMON_KERNEL Real moving_depth_time(Real begin, Real end, Real passed)
{
    return gnomon_select(passed < Real(1), begin + gnomon_product(end - begin, passed), end);
}

/// The longest piece of an interval, from where it is passed on, whose line deviates by no more than the tolerance: all
/// that is left, or a half, a quarter, ... a 32nd of the whole. Lines of unlike length fit where they can and halve
/// where they must (Palmer 2011, chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// gives 1 to 32 pieces. Each begins where the one before has ended, bit for bit, the first at begin, the last ends at
/// end. A 32nd is taken whatever it deviates: beside a turn of the facing no line is near. Deviation is what
/// moving_depth_line finds, with its error. A tolerance that is NaN or below 0 gives 32 pieces, passed that is NaN
/// counts as 0.
GNOMON_KERNEL GNOMON_T(depth_piece)
    moving_depth_piece(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real begin, Real end, Real passed,
                       GNOMON_SETTING divided, GNOMON_SETTING tolerance)
{
    Real start = saturate_or_zero(passed);
    Real share = Real(1);
    GNOMON_T(depth_piece) r;
    r.t0 = moving_depth_time(begin, end, start);
    r.t1 = end;
    r.z0 = Real(1);
    r.z1 = Real(1);
    r.passed = start;
    GNOMON_MASK searching = share <= Real(1);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(searching)) {
            Real to = gnomon_min(start + share, Real(1));
            Real t1 = moving_depth_time(begin, end, to);
            GNOMON_T(depth_line) fit = moving_depth_line(m, e, r.t0, t1, divided);
            r.t1 = gnomon_select(searching, t1, r.t1);
            r.z0 = gnomon_select(searching, fit.z0, r.z0);
            r.z1 = gnomon_select(searching, fit.z1, r.z1);
            r.passed = gnomon_select(searching, to, r.passed);
            searching = searching && !(fit.deviation <= tolerance);
        }
        share = Real(0.5) * share;
    }
    return r;
}

GNOMON_NAMESPACE_END
#endif
