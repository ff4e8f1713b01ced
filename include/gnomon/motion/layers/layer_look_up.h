// Look-up in a layer's grid: the footprint of a receiver with its probes and mip level, the bias and the least variance that
// a layer needs, the filter across the motion, and blends with the neighbouring tile (Andersson et al. 2015, Sec. 4.2
// and 5).
//
// A camera sample stands for the time t_r -+ 1/(2N), while which its world point is held in camera space. The light sees
// that point move: the ends of the footprint are its places at both times, each by the grid at its own time, so that what
// moves with the layer has a footprint of no length. The second axis is the pixel's own footprint. Probes are spread evenly
// along the longer axis, at most 16, and the mip level is that of the shorter.
//
//     ends = layer_footprint_make(grid, x0, y0, t0, x1, y1, t1, cross_x, cross_y, widening);
//     for k from 0 to ends.probes - 1: the mean of sums at layer_probe(ends, k) in level ends.level
//     bias = layer_bias(grid, slope_along, slope_across, t, reach, limit);
//     visibility by layer_visibility(sums, layer_grid_own_depth(grid, z - bias, t), layer_minimum_variance(grid, slope, least))
//
// Places (x, y) are in texels of the map from the tile's centre.
#ifndef GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H
#define GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H
#include "../../filters/depth_bias.h"
#include "../../numerics/exp.h"
#include "layer_grid.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(layer_most_probes, 16.0);
GNOMON_CONSTANT(layer_uniform_variance, 0.083333333333333333); // 1/12, of a time between 0 and 1
GNOMON_CONSTANT(layer_tent_growth, 0.025);                     // half of 0.05 texels per texel of motion
GNOMON_CONSTANT(layer_tent_begin, 2.0);                        // texels of motion from which on the tent grows

/// Centre of a footprint, the vector from its one end to the other, the number of probes along that, and the mip level.
GNOMON_STRUCT(layer_footprint) { Real u, v, along_u, along_v, probes, level; };

/// The footprint of a world point that the light sees at (x0, y0) at time t0 and at (x1, y1) at time t1. (cross_x, cross_y)
/// is the second axis, the extent of a pixel on the map. Both ends are limited to the grid. The footprint is at least
/// `widening` texels of the map wide in either direction.
/// NaN: stays NaN in the place, with one probe; a NaN in the widths counts for nothing.
/// Source: Andersson 2015, Sec. 4.2
GNOMON_KERNEL GNOMON_T(layer_footprint) layer_footprint_make(GNOMON_T(layer_grid) grid, Real x0, Real y0, Real t0,
                                                             Real x1, Real y1, Real t1, Real cross_x, Real cross_y,
                                                             Real widening)
{
    Real last = grid.middle + grid.middle - Real(0.5); // the centre of the last texel
    layer_place p0 = layer_grid_place(grid, x0, y0, t0);
    layer_place p1 = layer_grid_place(grid, x1, y1, t1);
    p0.u = clamp_or_nan(p0.u, Real(0.5), last);
    p0.v = clamp_or_nan(p0.v, Real(0.5), last);
    p1.u = clamp_or_nan(p1.u, Real(0.5), last);
    p1.v = clamp_or_nan(p1.v, Real(0.5), last);
    Real time_u = p1.u - p0.u;
    Real time_v = p1.v - p0.v;
    layer_place second = layer_grid_turned(grid, cross_x, cross_y);
    Real cross_u = grid.scale_u * second.u;
    Real cross_v = grid.scale_v * second.v;
    Real time_length = gnomon_sqrt(time_u * time_u + time_v * time_v);
    Real cross_length = gnomon_sqrt(cross_u * cross_u + cross_v * cross_v);

    // The longer axis around the middle of the ends, limited to the grid.
    GNOMON_MASK over_time = cross_length <= time_length;
    Real half_u = Real(0.5) * gnomon_select(over_time, time_u, cross_u);
    Real half_v = Real(0.5) * gnomon_select(over_time, time_v, cross_v);
    Real u = Real(0.5) * (p0.u + p1.u);
    Real v = Real(0.5) * (p0.v + p1.v);
    Real u0 = clamp_or_nan(u - half_u, Real(0.5), last);
    Real v0 = clamp_or_nan(v - half_v, Real(0.5), last);
    Real u1 = clamp_or_nan(u + half_u, Real(0.5), last);
    Real v1 = clamp_or_nan(v + half_v, Real(0.5), last);
    GNOMON_T(layer_footprint) r;
    r.u = Real(0.5) * (u0 + u1);
    r.v = Real(0.5) * (v0 + v1);
    r.along_u = u1 - u0;
    r.along_v = v1 - v0;
    Real longer = gnomon_sqrt(r.along_u * r.along_u + r.along_v * r.along_v);
    Real shorter = gnomon_max(gnomon_min(cross_length, time_length), widening * grid.scale_v);
    Real width = gnomon_max(gnomon_max(Real(0.0625) * longer, shorter), Real(1)); // a NaN becomes 1
    width = gnomon_min(width, grid.middle + grid.middle);
    Real probes = Real(-1) * texel_below(Real(-1) * (longer / width)); // rounded up
    r.probes = gnomon_max(gnomon_min(probes, GNOMON_LITERAL(layer_most_probes)), Real(1));
    r.level = Real(0);
    GNOMON_MASK coarse = Real(1) < width;
    if (gnomon_any(coarse)) {
        r.level = gnomon_select(coarse, polynomial_log(width) * GNOMON_LITERAL(exp_log2_e), Real(0));
    }
    return r;
}

/// The place of probe k, 0 to probes - 1.
GNOMON_KERNEL GNOMON_T(layer_place) layer_probe(GNOMON_T(layer_footprint) footprint, Real k)
{
    Real share = (k + Real(0.5)) / footprint.probes - Real(0.5);
    GNOMON_T(layer_place) r;
    r.u = footprint.u + share * footprint.along_u;
    r.v = footprint.v + share * footprint.along_v;
    return r;
}

/// The texels of the map by which a layer's places are off at time t, since its samples move unlike: the spread of motion
/// times |1/2 - t|.
/// NaN: NaN.
GNOMON_KERNEL Real layer_widening(GNOMON_T(layer_grid) grid, Real t) { return grid.spread * gnomon_abs(Real(0.5) - t); }

/// The bias in [0, 2] to subtract from a receiver's depth at time t. slope_along and slope_across are the changes of depth
/// per texel of the map along the motion and across (layer_slope), or a bound on both. reach is the distance in texels of
/// the grid from a receiver to the farthest centre of a texel that its filter reads. What of the motion is not the layer's
/// adds to this: spread_z |1/2 - t| in depth, and spread |1/2 - t| texels along the slope. limit is the largest bias of a
/// slope.
/// Domain: any; reach, limit at least 0.
/// NaN: what is NaN counts for nothing.
/// Error: 8 2^-p of the result.
GNOMON_KERNEL Real layer_bias(GNOMON_T(layer_grid) grid, Real slope_along, Real slope_across, Real t,
                              GNOMON_SETTING reach, GNOMON_SETTING limit)
{
    Real off = layer_widening(grid, t);
    GNOMON_T(depth_gradient) gradient;
    gradient.x = slope_along;
    gradient.y = slope_across;
    Real rise = depth_bias_receiver_plane(gradient, reach / grid.scale_u + off, reach / grid.scale_v + off, limit);
    return depth_bias_limit(rise + depth_bias_limit(grid.spread_z * gnomon_abs(Real(0.5) - t)));
}

/// Slopes of depth along the motion of a layer and across, from its gradient along x and y of the map.
/// Error: 2 2^-p (|x| + |y|).
GNOMON_KERNEL GNOMON_T(depth_gradient) layer_slope(GNOMON_T(layer_grid) grid, GNOMON_T(depth_gradient) gradient)
{
    layer_place turned = layer_grid_turned(grid, gradient.x, gradient.y);
    GNOMON_T(depth_gradient) r;
    r.x = turned.u;
    r.y = turned.v;
    return r;
}

/// The least variance of the layer's own depth, for layer_visibility: `least` of depth itself, and what the spread of motion
/// adds over the shutter interval, (spread_z^2 + (slope spread)^2) / 12. slope is the change of depth per texel of the map.
/// Domain: least at least 0.
/// NaN: stays NaN.
GNOMON_KERNEL Real layer_minimum_variance(GNOMON_T(layer_grid) grid, Real slope, GNOMON_SETTING least)
{
    Real tilted = slope * grid.spread;
    Real moved = GNOMON_LITERAL(layer_uniform_variance) * (grid.spread_z * grid.spread_z + tilted * tilted);
    return (least + moved) * (grid.scale * grid.scale);
}

/// Half the width of the filter across a layer's motion, in texels of its grid: of a tent of full width 0.05 (|d| - 2)
/// texels of the map, at least 0, but not wider than the guard band of (guard - tile) / 2 texels on either side.
/// NaN: 0.
/// Source: Andersson 2015, Sec. 5
GNOMON_KERNEL Real layer_tent_radius(GNOMON_T(layer_grid) grid, GNOMON_SETTING guard, GNOMON_SETTING tile)
{
    Real radius = GNOMON_LITERAL(layer_tent_growth) * (grid.motion - GNOMON_LITERAL(layer_tent_begin));
    Real band = Real(0.5) * (guard - tile);
    return gnomon_max(gnomon_min(radius, band) * grid.scale_v, Real(0));
}

/// The weight of a row of texels at a distance in texels under a tent of this radius, not normalised: 1 at distance 0.
/// Domain: any distance; radius at least 0. For a radius up to 1 all other rows have weight 0.
/// NaN: 0.
GNOMON_KERNEL Real layer_tent_weight(Real distance, GNOMON_SETTING radius)
{
    return saturate_or_zero(Real(1) - gnomon_abs(distance) / gnomon_max(Real(1), radius));
}

/// The neighbour of a tile along one axis, -1 or 1, and its weight, from 0 to 1/2.
GNOMON_STRUCT(layer_neighbour) { Real towards, weight; };

/// The neighbour on the side of x, in texels of the map from the tile's centre. Its weight is 0 up to a third of the way to
/// the border, 1/2 at the border, and linear between. With weights w_x and w_y of both axes the four tiles have (1 - w_x)
/// (1 - w_y), w_x (1 - w_y), (1 - w_x) w_y and w_x w_y: a look-up in all of them by these weights has no border; one chosen
/// at random with these probabilities is the paper's.
/// Domain: tile > 0.
/// NaN: weight 0.
/// Source: Andersson 2015, Sec. 5
GNOMON_KERNEL GNOMON_T(layer_neighbour) layer_neighbour_at(Real x, GNOMON_SETTING tile)
{
    GNOMON_T(layer_neighbour) r;
    r.towards = gnomon_select(x < Real(0), Real(-1), Real(1));
    r.weight = Real(0.5) * saturate_or_zero(Real(3) * (gnomon_abs(x) / tile) - Real(0.5));
    return r;
}

GNOMON_NAMESPACE_END
#endif
