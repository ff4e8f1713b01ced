// The prism of Hong & Oh ("Motion blurred shadows utilizing a depth-time ranges shadow map", Sec. 4.1 and 4.3): the
// volume that a moving triangle sweeps, enclosed by triangles that any rasterizer draws. Each triangle carries the
// time at its vertices, so the fragments of a texel tell when the moving triangle enters and leaves the texel, and
// at which depth.
//
// The caps of the prism are the moving triangle at shutter open and close. Each edge sweeps a side: four triangles
// around the midpoint of the edge halfway in time. If the edge at open crosses the edge at close on the screen, the
// side is a bow tie. Its centre is then at the crossing, and two of the four triangles, which have no area, are
// omitted. With A B the edge at open, C D the edge at close, and x the cross product, A + s (B - A) = C + u (D - C).
// Multiplication by D - C and by B - A gives (Eq. 1, with the signs that the printed order of factors loses)
//     s = (C - A) x (D - C) / (B - A) x (D - C),   u = (C - A) x (B - A) / (B - A) x (D - C).
// The paper does not say which attributes the crossing vertex gets. The edge passes there twice, at time 0 with depth
// z_AB(s) and at time 1 with depth z_CD(u). This text uses the mean of both: time 1/2 and the mean depth and 1 / w. The
// errors, half a shutter and half the distance of the depths, are then the least possible in the worst case. Without a
// crossing the centre has the attributes of the midpoint.
//
// Between vertices, time and depth are interpolated as rasterizers do by default, linearly in space, since the
// paper names no other way. The weight of corner k on the screen is its edge function e_k. Divided by w_k it is the
// weight in space:
//     time = sum_k e_k t_k / w_k / sum_k e_k / w_k
// Depth that is linear in view distance has the same weights. Depth z / w is linear on the screen and has the weights
// e_k. All of this is exact if the sides are plane and time is linear on them, hence for translations, also in
// perspective. A translation makes bow ties only of sides that are seen edge-on and have no area. For other motions
// prisms approximate: 10% to 13% of the triangles that rotate or deform are present at wrong times for more than 5% of
// the shutter (tests/comparators/prism_ranges.cpp). Prisms are therefore the comparator for moving_triangle.h, which is
// exact and the default. The ranges of one triangle in one texel:
//
//     prism p = prism_make(m, divided);
//     prism_pair pair = prism_pair_begin(id);
//     for (k = 0; k < 14; ++k)
//         pair = prism_pair_add(pair, prism_fragment_at(prism_triangle_make(p, k), s_x, s_y, divided));
//     prism_ranges ranges = prism_pair_end(pair);
#ifndef GNOMON_COMPARATORS_PRISM_H
#define GNOMON_COMPARATORS_PRISM_H
#include "../motion/range/range.h"
#include "../motion/triangle/moving_triangle.h"
GNOMON_NAMESPACE_BEGIN

/// A vertex on the screen, with depth z, time t and inverse_w = 1 / w, which is 1 in orthographic views.
GNOMON_STRUCT(prism_vertex) { Real x, y, z, t, inverse_w; };

/// A triangle of a prism.
GNOMON_STRUCT(prism_triangle) { GNOMON_T(prism_vertex) a, b, c; };

/// The side that an edge sweeps: the vertex at its centre. crosses is 1 if the edge at open crosses the edge at close
/// there, else 0.
GNOMON_STRUCT(prism_side)
{
    GNOMON_T(prism_vertex) centre;
    Real crosses;
};

/// The corners at shutter open (0) and at shutter close (1), and the sides of the three edges.
GNOMON_STRUCT(prism)
{
    GNOMON_T(prism_vertex) a0, b0, c0, a1, b1, c1;
    GNOMON_T(prism_side) ab, bc, ca;
};

/// A fragment: covered is 1 or 0, time is in [0, 1] and depth in [-1, 1].
GNOMON_STRUCT(prism_fragment) { Real covered, time, depth; };

/// The fragments of one triangle id in one texel: their number, the earliest, the latest, and the nearest four in order.
GNOMON_STRUCT(prism_pair)
{
    Real id, count;
    GNOMON_T(prism_fragment) earliest, latest, first, second, third, fourth;
};

/// The ranges of a triangle in a texel, count of them, 0 to 2; the remaining ones are empty.
GNOMON_STRUCT(prism_ranges)
{
    GNOMON_T(depth_time_range) first, second;
    Real count;
};

GNOMON_CONSTANT(prism_no_depth, 2.0); // behind every fragment

/// The vertex on the screen of a point in clip space at time t. divided is as for moving_depth_at. A vertex with w <= 0
/// or a NaN w produces no fragment.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_vertex) prism_vertex_make(Real x, Real y, Real z, Real w, Real t,
                                                              GNOMON_SETTING divided)
{
    Real divisor = gnomon_max(w, Real(0));
    GNOMON_T(prism_vertex) r;
    r.x = x / divisor;
    r.y = y / divisor;
    r.z = gnomon_select(Real(0) < divided, z / divisor, z);
    r.t = t;
    r.inverse_w = Real(1) / divisor;
    return r;
}

/// The vertex at shutter open.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_vertex) prism_vertex_open(GNOMON_T(moving_vertex) v, GNOMON_SETTING divided)
{
    return prism_vertex_make(v.x0, v.y0, v.z0, v.w0, Real(0), divided);
}

/// The vertex at shutter close.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_vertex) prism_vertex_close(GNOMON_T(moving_vertex) v, GNOMON_SETTING divided)
{
    return prism_vertex_make(v.x1, v.y1, v.z1, v.w1, Real(1), divided);
}

/// The factor of the screen weight in the interpolation of depth: 1 if depth is divided, else 1 / w, as for time.
GNOMON_DETAIL_KERNEL Real prism_depth_weight(GNOMON_T(prism_vertex) v, GNOMON_SETTING divided)
{
    return gnomon_select(Real(0) < divided, Real(1), v.inverse_w);
}

/// The vertex at the fraction `passed` of the way from a to b on the screen, at the time of a.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_vertex) prism_vertex_between(GNOMON_T(prism_vertex) a, GNOMON_T(prism_vertex) b,
                                                                 Real passed, GNOMON_SETTING divided)
{
    Real left = Real(1) - passed;
    Real weight_a = left * prism_depth_weight(a, divided);
    Real weight_b = passed * prism_depth_weight(b, divided);
    GNOMON_T(prism_vertex) r;
    r.x = a.x * left + b.x * passed;
    r.y = a.y * left + b.y * passed;
    r.z = (weight_a * a.z + weight_b * b.z) / (weight_a + weight_b);
    r.t = a.t;
    r.inverse_w = a.inverse_w * left + b.inverse_w * passed;
    return r;
}

/// The side that the edge from a to b sweeps. A centre without a crossing is the same, bit for bit, for b to a.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_side) prism_side_make(GNOMON_T(moving_vertex) a, GNOMON_T(moving_vertex) b,
                                                          GNOMON_SETTING divided)
{
    prism_vertex a0 = prism_vertex_open(a, divided);
    prism_vertex b0 = prism_vertex_open(b, divided);
    prism_vertex a1 = prism_vertex_close(a, divided);
    prism_vertex b1 = prism_vertex_close(b, divided);
    Real open_x = b0.x - a0.x;
    Real open_y = b0.y - a0.y;
    Real close_x = b1.x - a1.x;
    Real close_y = b1.y - a1.y;
    Real between_x = a1.x - a0.x;
    Real between_y = a1.y - a0.y;
    Real area = sheared_cross(open_x, open_y, close_x, close_y);
    Real s = sheared_cross(between_x, between_y, close_x, close_y) / area;
    Real u = sheared_cross(between_x, between_y, open_x, open_y) / area;
    GNOMON_MASK crosses = Real(0) <= s && s <= Real(1) && Real(0) <= u && u <= Real(1); // false if area is 0

    // The mean in clip space, where the midpoint of the moving edge is.
    Real x = Real(0.25) * ((a.x0 + b.x0) + (a.x1 + b.x1));
    Real y = Real(0.25) * ((a.y0 + b.y0) + (a.y1 + b.y1));
    Real z = Real(0.25) * ((a.z0 + b.z0) + (a.z1 + b.z1));
    Real w = Real(0.25) * ((a.w0 + b.w0) + (a.w1 + b.w1));
    prism_vertex middle = prism_vertex_make(x, y, z, w, Real(0.5), divided);
    prism_vertex open = prism_vertex_between(a0, b0, s, divided);
    prism_vertex close = prism_vertex_between(a1, b1, u, divided);
    GNOMON_T(prism_side) r;
    r.centre.x = gnomon_select(crosses, open.x, middle.x);
    r.centre.y = gnomon_select(crosses, open.y, middle.y);
    r.centre.z = gnomon_select(crosses, Real(0.5) * (open.z + close.z), middle.z);
    r.centre.t = Real(0.5);
    r.centre.inverse_w = gnomon_select(crosses, Real(0.5) * (open.inverse_w + close.inverse_w), middle.inverse_w);
    r.crosses = gnomon_select(crosses, Real(1), Real(0));
    return r;
}

/// The prism of a moving triangle.
/// Domain: all w > 0 at shutter open and close, else parts of the prism are missing.
/// Source: Hong & Oh 2018, Sec. 4.1; Hong & Oh 2018, Eq. 1
GNOMON_KERNEL GNOMON_T(prism) prism_make(GNOMON_T(moving_triangle) m, GNOMON_SETTING divided)
{
    GNOMON_T(prism) p;
    p.a0 = prism_vertex_open(m.a, divided);
    p.b0 = prism_vertex_open(m.b, divided);
    p.c0 = prism_vertex_open(m.c, divided);
    p.a1 = prism_vertex_close(m.a, divided);
    p.b1 = prism_vertex_close(m.b, divided);
    p.c1 = prism_vertex_close(m.c, divided);
    p.ab = prism_side_make(m.a, m.b, divided);
    p.bc = prism_side_make(m.b, m.c, divided);
    p.ca = prism_side_make(m.c, m.a, divided);
    return p;
}

/// The vertex `first` for k <= 0, `second` for k = 1, else `third`.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_vertex) prism_choice(Real k, GNOMON_T(prism_vertex) first,
                                                         GNOMON_T(prism_vertex) second, GNOMON_T(prism_vertex) third)
{
    GNOMON_MASK is_first = k < Real(0.5);
    GNOMON_MASK is_second = k < Real(1.5);
    GNOMON_T(prism_vertex) r;
    r.x = gnomon_select(is_first, first.x, gnomon_select(is_second, second.x, third.x));
    r.y = gnomon_select(is_first, first.y, gnomon_select(is_second, second.y, third.y));
    r.z = gnomon_select(is_first, first.z, gnomon_select(is_second, second.z, third.z));
    r.t = gnomon_select(is_first, first.t, gnomon_select(is_second, second.t, third.t));
    r.inverse_w = gnomon_select(is_first, first.inverse_w, gnomon_select(is_second, second.inverse_w, third.inverse_w));
    return r;
}

/// Triangle k of the 14 of a prism: 0 to 3, 4 to 7 and 8 to 11 around the centres of the sides, 12 and 13 the caps.
/// Winding is not kept. The first and the third triangle of a side with a crossing are points.
/// Domain: k in 0, ..., 13; any other k gives a point.
/// Source: Hong & Oh 2018, Sec. 4.1
GNOMON_KERNEL GNOMON_T(prism_triangle) prism_triangle_make(GNOMON_T(prism) p, Real k)
{
    Real side = gnomon_select(k < Real(3.5), Real(0), gnomon_select(k < Real(7.5), Real(1), Real(2)));
    Real i = k - Real(4) * side;
    prism_vertex from0 = prism_choice(side, p.a0, p.b0, p.c0);
    prism_vertex to0 = prism_choice(side, p.b0, p.c0, p.a0);
    prism_vertex to1 = prism_choice(side, p.b1, p.c1, p.a1);
    prism_vertex from1 = prism_choice(side, p.a1, p.b1, p.c1);
    Real crosses =
        gnomon_select(side < Real(0.5), p.ab.crosses, gnomon_select(side < Real(1.5), p.bc.crosses, p.ca.crosses));

    GNOMON_T(prism_triangle) r;
    r.a = prism_choice(i, from0, to0, prism_choice(i - Real(2), to1, from1, from1));
    r.b = prism_choice(i, to0, to1, prism_choice(i - Real(2), from1, from0, from0));
    r.c = prism_choice(side, p.ab.centre, p.bc.centre, p.ca.centre);
    Real cap = k - Real(11);
    r.a = prism_choice(cap, r.a, p.a0, p.a1);
    r.b = prism_choice(cap, r.b, p.b0, p.b1);
    r.c = prism_choice(cap, r.c, p.c0, p.c1);

    GNOMON_MASK odd = (Real(0.5) < i && i < Real(1.5)) || Real(2.5) < i;
    GNOMON_MASK none = (Real(0) < crosses && k < Real(11.5) && !odd) || !(Real(-0.5) < k && k < Real(13.5));
    Real dropped = gnomon_select(none, Real(0), Real(1));
    r.b = prism_choice(dropped, r.a, r.b, r.b);
    r.c = prism_choice(dropped, r.a, r.c, r.c);
    return r;
}

/// The edge function of p and q at the sample (s_x, s_y).
GNOMON_DETAIL_KERNEL Real prism_edge(GNOMON_T(prism_vertex) p, GNOMON_T(prism_vertex) q, Real s_x, Real s_y)
{
    return sheared_cross(p.x - s_x, p.y - s_y, q.x - s_x, q.y - s_y);
}

/// The side of the edge from p to q that the sample is on, 1 or -1, for edge function e. If e is 0, the side of a point
/// slightly further along x and, far less, along y. 0 for an edge without length.
GNOMON_DETAIL_KERNEL Real prism_edge_side(GNOMON_T(prism_vertex) p, GNOMON_T(prism_vertex) q, Real e)
{
    Real level = gnomon_select(q.x < p.x, Real(-1), gnomon_select(p.x < q.x, Real(1), Real(0)));
    Real tie = gnomon_select(q.y < p.y, Real(1), gnomon_select(p.y < q.y, Real(-1), level));
    return gnomon_select(Real(0) < e, Real(1), gnomon_select(e < Real(0), Real(-1), tie));
}

/// The fragment of a triangle at the sample (s_x, s_y), in the units of x / w. A sample is covered if it is on the same
/// side of all three edges. Exchanging the ends of an edge negates the side bit for bit, so triangles that share an
/// edge agree on the side of a sample. Triangles that meet at a sample all displace it to the same point nearby, which
/// is the fill rule of rasterizers, for either winding. A surface that encloses a volume therefore has an even number
/// of fragments. An odd number remains if rounding gives an edge function the wrong sign, and beside crossings, which
/// sides and caps share only up to rounding. A cap's time is exactly 0 or 1. divided is as for moving_depth_at.
/// Domain: |e_k| and |e_k / w_k| up to 2^60, triangles with an area; elsewhere the sample is not covered.
/// NaN: a triangle with a NaN coordinate covers no sample.
/// Error: of time, and of depth in units of the largest |z|, (48 X Y max_k v_k / |sum_k e_k v_k| + 10) 2^-p. X
/// and Y are the distances along each axis from the sample to the farthest vertex, and v_k = 1 / w_k, but 1
/// for divided depth.
/// Source: Hong & Oh 2018, Sec. 4.1
GNOMON_KERNEL GNOMON_T(prism_fragment) prism_fragment_at(GNOMON_T(prism_triangle) v, Real s_x, Real s_y,
                                                         GNOMON_SETTING divided)
{
    Real a = prism_edge(v.b, v.c, s_x, s_y);
    Real b = prism_edge(v.c, v.a, s_x, s_y);
    Real c = prism_edge(v.a, v.b, s_x, s_y);
    Real sides = (prism_edge_side(v.b, v.c, a) + prism_edge_side(v.c, v.a, b)) + prism_edge_side(v.a, v.b, c);
    Real depth_a = a * prism_depth_weight(v.a, divided);
    Real depth_b = b * prism_depth_weight(v.b, divided);
    Real depth_c = c * prism_depth_weight(v.c, divided);
    Real depth = ((depth_a * v.a.z + depth_b * v.b.z) + depth_c * v.c.z) / ((depth_a + depth_b) + depth_c);
    Real time_a = gnomon_product(a, v.a.inverse_w); // not contracted: a cap's time is exactly 0 or 1
    Real time_b = gnomon_product(b, v.b.inverse_w);
    Real time_c = gnomon_product(c, v.c.inverse_w);
    Real weight = (time_a + time_b) + time_c;
    Real size = gnomon_abs((a + b) + c); // inside all have one sign
    Real limit = GNOMON_LITERAL(moving_edge_limit);
    GNOMON_MASK known = Real(0) < size && size < limit && Real(0) < gnomon_abs(weight) && gnomon_abs(weight) < limit;
    GNOMON_T(prism_fragment) f;
    f.covered = gnomon_select(known && gnomon_abs(sides) == Real(3) && depth == depth, Real(1), Real(0));
    f.time = saturate_or_zero(((time_a * v.a.t + time_b * v.b.t) + time_c * v.c.t) / weight);
    f.depth = gnomon_max(gnomon_min(depth, Real(1)), Real(-1)); // a NaN becomes 1
    return f;
}

/// The fragment b if chosen is 0, else a.
GNOMON_DETAIL_KERNEL GNOMON_T(prism_fragment) prism_fragment_choice(Real chosen, GNOMON_T(prism_fragment) a,
                                                                    GNOMON_T(prism_fragment) b)
{
    GNOMON_MASK second = chosen == Real(0);
    GNOMON_T(prism_fragment) r;
    r.covered = gnomon_select(second, b.covered, a.covered);
    r.time = gnomon_select(second, b.time, a.time);
    r.depth = gnomon_select(second, b.depth, a.depth);
    return r;
}

/// 1 if a is in front of b, or at the same depth and earlier; else 0.
GNOMON_DETAIL_KERNEL Real prism_fragment_before(GNOMON_T(prism_fragment) a, GNOMON_T(prism_fragment) b)
{
    return gnomon_select(a.depth < b.depth || (a.depth == b.depth && a.time < b.time), Real(1), Real(0));
}

/// The state before the first fragment of the triangle with this id.
GNOMON_KERNEL GNOMON_T(prism_pair) prism_pair_begin(Real id)
{
    GNOMON_T(prism_fragment) none;
    none.covered = Real(0);
    none.time = Real(1);
    none.depth = GNOMON_LITERAL(prism_no_depth);
    GNOMON_T(prism_pair) state;
    state.id = id;
    state.count = Real(0);
    state.earliest = none;
    state.latest = none;
    state.first = none;
    state.second = none;
    state.third = none;
    state.fourth = none;
    return state;
}

/// The state after one more fragment, in any order.
/// Domain: fragments that are covered, with time in [0, 1] and depth in [-1, 1]; others are ignored.
/// NaN: the fragment is ignored.
GNOMON_KERNEL GNOMON_T(prism_pair) prism_pair_add(GNOMON_T(prism_pair) state, GNOMON_T(prism_fragment) f)
{
    GNOMON_MASK known = Real(0) <= f.time && f.time <= Real(1) && Real(-1) <= f.depth && f.depth <= Real(1);
    GNOMON_MASK some = Real(0) < f.covered && known;
    GNOMON_MASK alone = state.count == Real(0);
    GNOMON_MASK sooner =
        f.time < state.earliest.time || (f.time == state.earliest.time && f.depth < state.earliest.depth);
    GNOMON_MASK later = state.latest.time < f.time || (f.time == state.latest.time && state.latest.depth < f.depth);
    Real is_earliest = gnomon_select(some && (alone || sooner), Real(1), Real(0));
    Real is_latest = gnomon_select(some && (alone || later), Real(1), Real(0));
    state.earliest = prism_fragment_choice(is_earliest, f, state.earliest);
    state.latest = prism_fragment_choice(is_latest, f, state.latest);
    state.count = state.count + gnomon_select(some, Real(1), Real(0));

    // Insertion into the sorted four: the farther of two goes on. An ignored fragment goes past all four.
    f.depth = gnomon_select(some, f.depth, GNOMON_LITERAL(prism_no_depth));
    f.time = gnomon_select(some, f.time, Real(1));
    Real before = prism_fragment_before(f, state.first);
    prism_fragment next = prism_fragment_choice(before, state.first, f);
    state.first = prism_fragment_choice(before, f, state.first);
    before = prism_fragment_before(next, state.second);
    f = prism_fragment_choice(before, state.second, next);
    state.second = prism_fragment_choice(before, next, state.second);
    before = prism_fragment_before(f, state.third);
    next = prism_fragment_choice(before, state.third, f);
    state.third = prism_fragment_choice(before, f, state.third);
    before = prism_fragment_before(next, state.fourth);
    state.fourth = prism_fragment_choice(before, next, state.fourth);
    return state;
}

/// The range between two fragments, in any order.
GNOMON_DETAIL_KERNEL GNOMON_T(depth_time_range) prism_range_between(GNOMON_T(prism_fragment) a,
                                                                    GNOMON_T(prism_fragment) b, Real id)
{
    return range_between(a.time, a.depth, b.time, b.depth, id);
}

/// The ranges of the fragments: between two fragments; of four, between the front two and between the rear two. The
/// paper does not treat other numbers, which occur if sides fold (six and more) and by rounding (odd numbers). A single
/// fragment does not tell how long the triangle stays and gives no range. Three, or more than four, give one range from
/// the earliest to the latest, so that no shadow is lost, though the range may last too long.
/// Source: Hong & Oh 2018, Sec. 4.3
GNOMON_KERNEL GNOMON_T(prism_ranges) prism_pair_end(GNOMON_T(prism_pair) state)
{
    GNOMON_MASK some = Real(1) < state.count;
    GNOMON_MASK two = state.count == Real(4);
    depth_time_range whole = prism_range_between(state.earliest, state.latest, state.id);
    depth_time_range front = prism_range_between(state.first, state.second, state.id);
    depth_time_range rear = prism_range_between(state.third, state.fourth, state.id);
    GNOMON_T(prism_ranges) r;
    r.first = range_select(some, range_select(two, front, whole), range_empty(state.id));
    r.second = range_select(two, rear, range_empty(state.id));
    r.count = gnomon_select(some, gnomon_select(two, Real(2), Real(1)), Real(0));
    return r;
}

/// The size in bytes of a shadow map of prisms: 16 for a fragment (depth, time, id, link), 24 for a range (two times,
/// two depths, id, link), and 8 for a texel (the heads of its two lists).
/// Error: exact in float up to 2^27 bytes.
/// Source: Hong & Oh 2018, Eq. 2
GNOMON_KERNEL Real prism_map_bytes(Real fragments, Real ranges, Real texels)
{
    return (Real(16) * fragments + Real(24) * ranges) + Real(8) * texels;
}

GNOMON_NAMESPACE_END
#endif
