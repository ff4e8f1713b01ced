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
// of intervals approximate it by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance asks for (chapter 5). How
// far the depth departs from a line is bounded, not sampled. With depth N / D and the line h through it at both ends of
// an interval, u from 0 to 1 there, N - h D vanishes at both and is u (1 - u) P(u); D / (u (1 - u)) is no less than
// some c. So |N / D - h| is at most |P| / c, and equal to it for a parabola.
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#include "coverage_intervals.h"
GNOMON_NAMESPACE_BEGIN

/// In clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
GNOMON_STRUCT(moving_vertex) { Real x0, y0, z0, w0, x1, y1, z1, w1; };

GNOMON_STRUCT(moving_triangle) { GNOMON_T(moving_vertex) a, b, c; };

/// Relative to a sample, at shutter open and at shutter close.
GNOMON_STRUCT(sheared_vertex) { Real x0, y0, x1, y1; };

/// Depth at the ends of an interval, and how far at most the depth between departs from the line.
GNOMON_STRUCT(depth_line) { Real z0, z1, deviation; };

/// A line of depth from time t0 to t1, and how much of the interval that it is a piece of has passed by then.
GNOMON_STRUCT(depth_piece) { Real t0, t1, z0, z1, passed; };

/// A piece that begins where start of an interval has passed, while a length for it is searched: the share of the
/// interval that it has now, and whether it is settled, 1 or 0.
GNOMON_STRUCT(depth_trial)
{
    GNOMON_T(depth_piece) piece;
    Real start, share, settled;
};

/// Bernstein coefficients of a cubic, those in the middle times 3.
GNOMON_STRUCT(bernstein_cubic) { Real c0, c1, c2, c3; };

/// The sample is in the same units as x / w.
GNOMON_KERNEL GNOMON_T(sheared_vertex) moving_vertex_shear(GNOMON_T(moving_vertex) v, Real s_x, Real s_y)
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
GNOMON_KERNEL GNOMON_T(moving_edge) moving_edge_make(GNOMON_T(sheared_vertex) a, GNOMON_T(sheared_vertex) b)
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
    sheared_vertex a = moving_vertex_shear(m.a, s_x, s_y);
    sheared_vertex b = moving_vertex_shear(m.b, s_x, s_y);
    sheared_vertex c = moving_vertex_shear(m.c, s_x, s_y);
    GNOMON_T(moving_edges) e;
    e.a = moving_edge_make(b, c);
    e.b = moving_edge_make(c, a);
    e.c = moving_edge_make(a, b);
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

/// The most that N / D departs from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a cubic with
/// Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, those in the middle times 3. With turn the lesser of the two
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// for positive D, and the same with -D. 4, more than all depths, where D may vanish or anything is NaN.
GNOMON_KERNEL Real depth_nonlinearity(Real most, Real d0, Real d3, Real turn0, Real turn1)
{
    GNOMON_MASK negative = d0 < Real(0);
    Real turn = gnomon_select(negative, Real(-1) * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    Real product = d0 * d3;
    Real least = turn + Real(2) * gnomon_sqrt(product);
    GNOMON_MASK known = Real(0) < product && Real(0) < least && least < GNOMON_LITERAL(moving_edge_limit);
    return gnomon_select(known, most / least, Real(4));
}

/// The line from depth z0 to z1, between limits. Without limits depth would be free0 and free1 at the ends, and depart
/// by bend from the line between these. A limit that is passed on the way adds no more than its distance from either
/// end; and nothing departs by more than the limits allow.
GNOMON_KERNEL GNOMON_T(depth_line) depth_line_within(Real z0, Real z1, Real free0, Real free1, Real bend, Real least,
                                                     Real most)
{
    Real beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    Real all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    GNOMON_T(depth_line) r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// The edge function from begin to end, by its Bernstein coefficients there, the middle one times 2.
GNOMON_KERNEL GNOMON_T(moving_edge) moving_edge_between(GNOMON_T(moving_edge) e, Real begin, Real end)
{
    Real left = Real(1) - end;
    GNOMON_T(moving_edge) r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = Real(2) * ((e.e0 * left + e.e1 * end) * (Real(1) - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// The sum of edge functions of moving_edge_between, each times what goes linearly from the one number to the other.
GNOMON_KERNEL GNOMON_T(bernstein_cubic) moving_edges_combine(GNOMON_T(moving_edges) e, Real a0, Real a1, Real b0,
                                                             Real b1, Real c0, Real c1)
{
    GNOMON_T(bernstein_cubic) r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// The line that stands for the depth between two times, exact at both, and a bound of how far the depth departs from
/// it. Divided as for moving_depth_at. Where the point may get behind the light, or D near 0, all that depths in
/// [-1, 1] can depart by. Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|, D = sum_k e_k(t) v_k(t) where it is least and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|, v = w where divided, else 1.
GNOMON_KERNEL GNOMON_T(depth_line) moving_depth_line(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real begin,
                                                     Real end, GNOMON_SETTING divided)
{
    Real b = Real(1) - begin;
    Real f = Real(1) - end;
    GNOMON_T(moving_edges) x;
    x.a = moving_edge_between(e.a, begin, end);
    x.b = moving_edge_between(e.b, begin, end);
    x.c = moving_edge_between(e.c, begin, end);
    GNOMON_T(bernstein_cubic)
    n = moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end, m.b.z0 * b + m.b.z1 * begin,
                             m.b.z0 * f + m.b.z1 * end, m.c.z0 * b + m.c.z1 * begin, m.c.z0 * f + m.c.z1 * end);
    Real a_w0 = m.a.w0 * b + m.a.w1 * begin;
    Real a_w1 = m.a.w0 * f + m.a.w1 * end;
    Real b_w0 = m.b.w0 * b + m.b.w1 * begin;
    Real b_w1 = m.b.w0 * f + m.b.w1 * end;
    Real c_w0 = m.c.w0 * b + m.c.w1 * begin;
    Real c_w1 = m.c.w0 * f + m.c.w1 * end;
    GNOMON_MASK before =
        Real(0) < a_w0 && Real(0) < a_w1 && Real(0) < b_w0 && Real(0) < b_w1 && Real(0) < c_w0 && Real(0) < c_w1;
    GNOMON_MASK by_w = Real(0) < divided;
    GNOMON_T(bernstein_cubic)
    d = moving_edges_combine(x, gnomon_select(by_w, a_w0, Real(1)), gnomon_select(by_w, a_w1, Real(1)),
                             gnomon_select(by_w, b_w0, Real(1)), gnomon_select(by_w, b_w1, Real(1)),
                             gnomon_select(by_w, c_w0, Real(1)), gnomon_select(by_w, c_w1, Real(1)));
    Real free0 = n.c0 / d.c0;
    Real free1 = n.c3 / d.c3;
    Real turn0 = d.c1 - d.c0;
    Real turn1 = d.c2 - d.c3;
    Real p0 = (n.c1 - free0 * turn0) - free1 * d.c0;
    Real p1 = (n.c1 + n.c2) - (free0 * d.c2 + free1 * d.c1);
    Real p2 = (n.c2 - free1 * turn1) - free0 * d.c3;
    Real most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), Real(0.5) * gnomon_abs(p1));
    Real bend = gnomon_select(before, depth_nonlinearity(most, d.c0, d.c3, turn0, turn1), Real(4));
    return depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0, free1,
                             bend, Real(-1), Real(1));
}

/// The same for depth z / w.
GNOMON_KERNEL GNOMON_T(depth_line) moving_triangle_depth_line(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e,
                                                              Real begin, Real end)
{
    return moving_depth_line(m, e, begin, end, Real(1));
}

/// When so much of an interval has passed: begin and end themselves where passed is 0 and 1, in order between.
GNOMON_KERNEL Real moving_depth_time(Real begin, Real end, Real passed)
{
    return gnomon_select(passed < Real(1), begin + gnomon_product(end - begin, passed), end);
}

/// All that is left of an interval of which so much has passed; NaN counts as 0.
GNOMON_KERNEL GNOMON_T(depth_trial) depth_trial_begin(Real begin, Real end, Real passed)
{
    GNOMON_T(depth_trial) r;
    r.start = saturate_or_zero(passed);
    r.share = Real(1) - r.start;
    r.settled = Real(0);
    r.piece.t0 = moving_depth_time(begin, end, r.start);
    r.piece.t1 = end;
    r.piece.z0 = Real(1);
    r.piece.z1 = Real(1);
    r.piece.passed = Real(1);
    return r;
}

/// Settled where its line deviates by no more than the tolerance, or it is no longer than 33/1024: 31 such pieces and
/// what is then left are the most, for all that passed is rounded. Else shortened to a half, or to a third where a half
/// would not do: lines of a parabola deviate by the squares of their lengths. What is settled stays so, by the same
/// line.
GNOMON_KERNEL GNOMON_T(depth_trial) depth_trial_next(GNOMON_T(depth_trial) trial, GNOMON_T(depth_line) fit, Real begin,
                                                     Real end, GNOMON_SETTING tolerance)
{
    Real shortest = Real(0.0322265625);
    GNOMON_MASK fits = fit.deviation <= tolerance || trial.share <= shortest;
    Real parts = gnomon_select(fit.deviation <= Real(4) * tolerance, Real(2), Real(3));
    Real shorter = gnomon_max(trial.share / parts, shortest);
    Real to = gnomon_min(trial.start + shorter, Real(1));
    trial.piece.z0 = fit.z0;
    trial.piece.z1 = fit.z1;
    trial.piece.t1 = gnomon_select(fits, trial.piece.t1, moving_depth_time(begin, end, to));
    trial.piece.passed = gnomon_select(fits, trial.piece.passed, to);
    trial.share = gnomon_select(fits, trial.share, shorter);
    trial.settled = gnomon_select(fits, Real(1), Real(0));
    return trial;
}

/// A piece of an interval whose line deviates by no more than the tolerance, from where it is passed on: all that is
/// left, or a half or a third of that, and so on. Lines of unlike length fit where they can and get shorter where they
/// must (Palmer 2011, chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// gives 1 to 32 pieces. Each begins where the one before has ended, bit for bit, the first at begin, the last ends at
/// end. Deviation is that of moving_depth_line, with its error. A piece of 33/1024 of the interval is taken whatever it
/// deviates: beside a turn of the facing no line is near. A tolerance that is NaN or below 0 gives 32 pieces, passed
/// that is NaN counts as 0.
GNOMON_KERNEL GNOMON_T(depth_piece) moving_depth_piece(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e,
                                                       Real begin, Real end, Real passed, GNOMON_SETTING divided,
                                                       GNOMON_SETTING tolerance)
{
    depth_trial r = depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < Real(1)))
            r = depth_trial_next(r, moving_depth_line(m, e, r.piece.t0, r.piece.t1, divided), begin, end, tolerance);
    }
    return r.piece;
}

GNOMON_NAMESPACE_END
#endif
