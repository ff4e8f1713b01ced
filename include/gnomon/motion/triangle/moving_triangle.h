// A triangle whose vertices move linearly through clip space while the shutter is open (Akenine-Moller et al. 2007), as
// one sample of a shadow map sees it: edge functions, coverage, depth.
//
// A vertex is p(t) = (1 - t) q + t r. Sheared by the sample (s_x, s_y), its coordinates (x - s_x w, y - s_y w) are
// linear in t as well, and 0 where the vertex projects to the sample. An edge function is the cross product of two
// sheared vertices, a quadratic in t, also in perspective (w is 1 in an orthographic view):
//     e(t) = p_i(t) x p_j(t) = (1 - t)^2 q_i x q_j + t (1 - t) (q_i x r_j + r_i x q_j) + t^2 r_i x r_j
// This is the homogeneous edge function of Laine & Karras 2011. The point of the triangle that the sample sees is the
// mean of the vertices, each weighted by the edge function opposite to it. So depth is a cubic over a cubic,
//     z / w = sum_k e_k(t) z_k(t) / sum_k e_k(t) w_k(t)
// Depth that is linear in view distance is affine in the point, so its w_k is 1 and it is a cubic over a quadratic.
// Lists of ranges approximate depth by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance requires (chapter 5).
//
// The deviation of depth from a line is bounded, not sampled. Let depth be N / D, let h be the line through it at both
// ends of an interval, and let u go from 0 to 1 there. N - h D vanishes at both ends, so it is u (1 - u) P(u). D / (u
// (1 - u)) is at least some constant c. So |N / D - h| is at most |P| / c, with equality for a parabola.
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#include "coverage_intervals.h"
GNOMON_NAMESPACE_BEGIN

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
GNOMON_STRUCT(moving_vertex) { Real x0, y0, z0, w0, x1, y1, z1, w1; };

/// A triangle of three moving vertices.
GNOMON_STRUCT(moving_triangle) { GNOMON_T(moving_vertex) a, b, c; };

/// A vertex relative to a sample, at shutter open and at shutter close.
GNOMON_STRUCT(sheared_vertex) { Real x0, y0, x1, y1; };

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
GNOMON_STRUCT(depth_line) { Real z0, z1, deviation; };

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
GNOMON_STRUCT(depth_piece) { Real t0, t1, z0, z1, passed; };

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
GNOMON_STRUCT(depth_trial)
{
    GNOMON_T(depth_piece) piece;
    Real start, share, settled;
};

/// Weights of a triangle's vertices; they need not sum to 1.
GNOMON_STRUCT(corner_weights) { Real a, b, c; };

/// Bernstein coefficients of a cubic, the middle ones times 3.
GNOMON_STRUCT(bernstein_cubic) { Real c0, c1, c2, c3; };

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
GNOMON_DETAIL_KERNEL GNOMON_T(sheared_vertex) moving_vertex_shear(GNOMON_T(moving_vertex) v, Real s_x, Real s_y)
{
    GNOMON_T(sheared_vertex) r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
GNOMON_DETAIL_KERNEL Real sheared_cross(Real a_x, Real a_y, Real b_x, Real b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
GNOMON_DETAIL_KERNEL GNOMON_T(moving_edge) moving_edge_make(GNOMON_T(sheared_vertex) a, GNOMON_T(sheared_vertex) b)
{
    GNOMON_T(moving_edge) e;
    e.e0 = sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = Real(0.5) * (sheared_cross(a.x0, a.y0, b.x1, b.y1) + sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
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

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those against
/// the triangle's facing as 0. If all three vanish, the weights are 1.
GNOMON_DETAIL_KERNEL GNOMON_T(corner_weights) corner_weights_at(GNOMON_T(moving_edges) e, Real t)
{
    GNOMON_T(corner_weights) v;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    GNOMON_MASK back = (v.a + v.b) + v.c < Real(0);
    v.a = gnomon_max(gnomon_select(back, Real(-1) * v.a, v.a), Real(0));
    v.b = gnomon_max(gnomon_select(back, Real(-1) * v.b, v.b), Real(0));
    v.c = gnomon_max(gnomon_select(back, Real(-1) * v.c, v.c), Real(0));
    GNOMON_MASK vanished = (v.a + v.b) + v.c <= Real(0);
    v.a = gnomon_select(vanished, Real(1), v.a);
    v.b = gnomon_select(vanished, Real(1), v.b);
    v.c = gnomon_select(vanished, Real(1), v.c);
    return v;
}

/// Depth of the triangle's point at the sample at time t, in [-1, 1]; e from moving_triangle_edges. divided is 1 for
/// depth z / w, with z in clip space, and 0 for a z that is linear in view distance: the result is then the mean of the
/// vertices' z. Edge functions against the triangle's facing, which arise from rounding and outside of the covered
/// times, count as 0, so that the result lies between the depths of the vertices if all w > 0. If all three vanish, the
/// result is the depth of the centroid.
/// Domain: 1, the far plane, where the point is behind the light, w <= 0.
/// NaN: 1.
/// Error: that of the edge functions times sum_k |z_k - z v_k| / |sum_k e_k v_k|, and 16 2^-p of the largest |z_k /
/// v_k|; v = w where divided, else 1.
GNOMON_KERNEL Real moving_depth_at(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real t,
                                   GNOMON_SETTING divided)
{
    corner_weights v = corner_weights_at(e, t);
    Real s = Real(1) - t;
    Real z = (v.a * (m.a.z0 * s + m.a.z1 * t) + v.b * (m.b.z0 * s + m.b.z1 * t)) + v.c * (m.c.z0 * s + m.c.z1 * t);
    Real w = (v.a * (m.a.w0 * s + m.a.w1 * t) + v.b * (m.b.w0 * s + m.b.w1 * t)) + v.c * (m.c.w0 * s + m.c.w1 * t);
    Real divisor = gnomon_select(Real(0) < divided, w, (v.a + v.b) + v.c);
    Real depth = gnomon_max(gnomon_min(z / divisor, Real(1)), Real(-1)); // a NaN becomes 1
    return gnomon_select(Real(0) < w, depth, Real(1));
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
GNOMON_DETAIL_KERNEL Real depth_nonlinearity(Real most, Real d0, Real d3, Real turn0, Real turn1)
{
    GNOMON_MASK negative = d0 < Real(0);
    Real turn = gnomon_select(negative, Real(-1) * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    Real product = d0 * d3;
    Real least = turn + Real(2) * gnomon_sqrt(product);
    GNOMON_MASK known = Real(0) < product && Real(0) < least && least < GNOMON_LITERAL(moving_edge_limit);
    return gnomon_select(known, most / least, Real(4));
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_line) depth_line_within(Real z0, Real z1, Real free0, Real free1, Real bend,
                                                            Real least, Real most)
{
    Real beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    Real all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    GNOMON_T(depth_line) r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
GNOMON_DETAIL_KERNEL GNOMON_T(moving_edge) moving_edge_between(GNOMON_T(moving_edge) e, Real begin, Real end)
{
    Real left = Real(1) - end;
    GNOMON_T(moving_edge) r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = Real(2) * ((e.e0 * left + e.e1 * end) * (Real(1) - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from moving_edge_between, each times a linear function: from a0 to a1, from b0 to
/// b1, from c0 to c1.
GNOMON_DETAIL_KERNEL GNOMON_T(bernstein_cubic) moving_edges_combine(GNOMON_T(moving_edges) e, Real a0, Real a1, Real b0,
                                                                    Real b1, Real c0, Real c1)
{
    GNOMON_T(bernstein_cubic) r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
GNOMON_KERNEL GNOMON_T(depth_line) moving_depth_line(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e, Real begin,
                                                     Real end, GNOMON_SETTING divided)
{
    Real b = Real(1) - begin;
    Real f = Real(1) - end;
    GNOMON_T(moving_edges) x;
    x.a = moving_edge_between(e.a, begin, end);
    x.b = moving_edge_between(e.b, begin, end);
    x.c = moving_edge_between(e.c, begin, end);
    bernstein_cubic n =
        moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end, m.b.z0 * b + m.b.z1 * begin,
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
    bernstein_cubic d = moving_edges_combine(x, gnomon_select(by_w, a_w0, Real(1)), gnomon_select(by_w, a_w1, Real(1)),
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

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
GNOMON_DETAIL_KERNEL Real moving_depth_time(Real begin, Real end, Real passed)
{
    return gnomon_select(passed < Real(1), begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_trial) depth_trial_begin(Real begin, Real end, Real passed)
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

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_trial) depth_trial_next(GNOMON_T(depth_trial) trial, GNOMON_T(depth_line) fit,
                                                            Real begin, Real end, GNOMON_SETTING tolerance)
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

/// The next piece of an interval, from the fraction `passed` on, whose line deviates by at most the tolerance: the rest
/// of the interval, or a half or a third of that, and so on. Pieces are as long as their lines fit (Palmer 2011,
/// chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// The loop gives 1 to 32 pieces. Each begins where the one before ends, bit for bit; the first begins at begin, the
/// last ends at end. Pieces before the last are never shorter than 33/1024 of the interval, even if the tolerance is
/// missed: where the triangle turns edge-on, no line fits. A tolerance below 0 gives 32 pieces.
/// NaN: a NaN tolerance gives 32 pieces; passed is then 0.
/// Error: that of moving_depth_line, for the deviation.
/// Source: Palmer 2011, Sec. 5
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
