// Motion of the point of a moving triangle that a sample sees: the motion vector of a stochastic shadow map.
//
// The point is fixed on the triangle: the mean of the vertices, each weighted by the edge function opposite to it, with the
// weights of the sample's time (moving_triangle.h). Its places at shutter open and at shutter close are the means of the
// vertices there, by the same weights. Edge functions are homogeneous, so this holds in perspective as well, and for a
// light that moves. The motion is the chord from the one place to the other. In perspective the point need not move along
// that chord at constant speed.
#ifndef GNOMON_MOTION_TRIANGLE_TRIANGLE_MOTION_H
#define GNOMON_MOTION_TRIANGLE_TRIANGLE_MOTION_H
#include "moving_triangle.h"
GNOMON_NAMESPACE_BEGIN

/// Motion from shutter open to shutter close, in the units of x / w and in depth.
GNOMON_STRUCT(triangle_motion) { Real d_x, d_y, d_z; };

/// A point in clip space, times the sum of the weights of the vertices that it is a mean of.
GNOMON_STRUCT(weighted_point) { Real x, y, z, w; };

GNOMON_CONSTANT(triangle_motion_limit, 65536.0); // no map is larger

/// The point with these weights at shutter open.
GNOMON_DETAIL_KERNEL GNOMON_T(weighted_point) moving_triangle_open(GNOMON_T(moving_triangle) m,
                                                                   GNOMON_T(corner_weights) v)
{
    GNOMON_T(weighted_point) p;
    p.x = (v.a * m.a.x0 + v.b * m.b.x0) + v.c * m.c.x0;
    p.y = (v.a * m.a.y0 + v.b * m.b.y0) + v.c * m.c.y0;
    p.z = (v.a * m.a.z0 + v.b * m.b.z0) + v.c * m.c.z0;
    p.w = (v.a * m.a.w0 + v.b * m.b.w0) + v.c * m.c.w0;
    return p;
}

/// The point with these weights at shutter close.
GNOMON_DETAIL_KERNEL GNOMON_T(weighted_point) moving_triangle_close(GNOMON_T(moving_triangle) m,
                                                                    GNOMON_T(corner_weights) v)
{
    GNOMON_T(weighted_point) p;
    p.x = (v.a * m.a.x1 + v.b * m.b.x1) + v.c * m.c.x1;
    p.y = (v.a * m.a.y1 + v.b * m.b.y1) + v.c * m.c.y1;
    p.z = (v.a * m.a.z1 + v.b * m.b.z1) + v.c * m.c.z1;
    p.w = (v.a * m.a.w1 + v.b * m.b.w1) + v.c * m.c.w1;
    return p;
}

/// Motion of the point that the sample sees at time t, from shutter open to shutter close; e from moving_triangle_edges.
/// divided as in moving_depth_at: 1 for depth z / w, 0 for a z that is linear in view distance.
/// Domain: the triangle covers the sample at time t. No motion where the point is behind the light at shutter open or at
/// shutter close, w <= 0, or where it moves by more than 65536.
/// NaN: no motion.
/// Error: at either end of the shutter that of the edge functions times sum_k |x_k - x w_k| / |sum_k e_k w_k|, and 16 2^-p
/// sum_k e_k (|x_k| + |x w_k|) / |sum_k e_k w_k|, with x the place there; y likewise; z with 1 for w unless divided.
/// Source: Andersson 2015, Sec. 4
GNOMON_KERNEL GNOMON_T(triangle_motion) moving_triangle_motion(GNOMON_T(moving_triangle) m, GNOMON_T(moving_edges) e,
                                                               Real t, GNOMON_SETTING divided)
{
    corner_weights v = corner_weights_at(e, t);
    weighted_point p = moving_triangle_open(m, v);
    weighted_point q = moving_triangle_close(m, v);
    GNOMON_MASK by_w = Real(0) < divided;
    Real sum = (v.a + v.b) + v.c;
    Real d_x = q.x / q.w - p.x / p.w;
    Real d_y = q.y / q.w - p.y / p.w;
    Real d_z = q.z / gnomon_select(by_w, q.w, sum) - p.z / gnomon_select(by_w, p.w, sum);
    Real limit = GNOMON_LITERAL(triangle_motion_limit);
    GNOMON_MASK known = Real(0) < p.w && Real(0) < q.w && gnomon_abs(d_x) <= limit && gnomon_abs(d_y) <= limit &&
                        gnomon_abs(d_z) <= limit;
    GNOMON_T(triangle_motion) r;
    r.d_x = gnomon_select(known, d_x, Real(0));
    r.d_y = gnomon_select(known, d_y, Real(0));
    r.d_z = gnomon_select(known, d_z, Real(0));
    return r;
}

GNOMON_NAMESPACE_END
#endif
