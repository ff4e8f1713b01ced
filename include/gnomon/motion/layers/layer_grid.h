// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the layer
// (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H
#include "layer_clusters.h"
GNOMON_NAMESPACE_BEGIN

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of samples,
/// and the least and greatest of their motions in depth and of their depths in the middle of the shutter interval, which are
/// not limited as those of layer_middle_depth are.
GNOMON_STRUCT(layer_motion_sums)
{
    Real first_x, first_y, first_z, x, y, z, square, square_z, count;
    Real least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of its
/// samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
GNOMON_STRUCT(layer_motion) { Real d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
GNOMON_KERNEL GNOMON_T(layer_motion_sums) layer_motion_begin(GNOMON_T(stochastic_sample) first)
{
    Real limit = GNOMON_LITERAL(texel_limit);
    GNOMON_T(layer_motion_sums) r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, Real(0));
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, Real(0));
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, Real(0));
    r.x = Real(0);
    r.y = Real(0);
    r.z = Real(0);
    r.square = Real(0);
    r.square_z = Real(0);
    r.count = Real(0);
    r.least = limit;
    r.greatest = Real(-1) * limit;
    r.least_d = limit;
    r.greatest_d = Real(-1) * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most 65536. The
/// sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
GNOMON_DETAIL_KERNEL GNOMON_MASK layer_motion_is_known(GNOMON_T(stochastic_sample) s, Real middle)
{
    Real length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= GNOMON_LITERAL(texel_limit) && layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
GNOMON_KERNEL GNOMON_T(layer_motion_sums) layer_motion_add(GNOMON_T(layer_motion_sums) state,
                                                           GNOMON_T(stochastic_sample) s, Real middle)
{
    GNOMON_MASK known = layer_motion_is_known(s, middle);
    Real x = gnomon_select(known, s.d_x - state.first_x, Real(0));
    Real y = gnomon_select(known, s.d_y - state.first_y, Real(0));
    Real z = gnomon_select(known, s.d_z - state.first_z, Real(0));
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, Real(1), Real(0));
    Real moved = s.z + (Real(0.5) - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the number of
/// samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
GNOMON_KERNEL GNOMON_T(layer_motion) layer_motion_end(GNOMON_T(layer_motion_sums) state)
{
    Real share = Real(1) / gnomon_max(state.count, Real(1));
    Real x = state.x * share;
    Real y = state.y * share;
    Real z = state.z * share;
    GNOMON_MASK some = Real(0) < state.count;
    GNOMON_T(layer_motion) r;
    r.d_x = gnomon_select(some, state.first_x + x, Real(0));
    r.d_y = gnomon_select(some, state.first_y + y, Real(0));
    r.d_z = gnomon_select(some, state.first_z + z, Real(0));
    r.spread = gnomon_sqrt(gnomon_max(Real(0), state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(Real(0), state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    Real off = Real(0.5) * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, Real(0));
    r.greatest = gnomon_select(some, state.greatest + off, Real(0));
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in texels, its
/// part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths to [-1, 1], and
/// the spread of motion in texels and in depth.
GNOMON_STRUCT(layer_grid)
{
    Real axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

GNOMON_CONSTANT(layer_least_motion, 0.00000095367431640625); // 2^-20 texels: shorter motions have no direction
GNOMON_CONSTANT(layer_least_depths, 0.0009765625);           // 2^-10: no layer is stretched as if it were thinner

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of the map.
/// For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
GNOMON_KERNEL GNOMON_T(layer_grid) layer_grid_make(GNOMON_T(layer_motion) mean, GNOMON_SETTING guard,
                                                   GNOMON_SETTING texels)
{
    Real chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    GNOMON_MASK moves = GNOMON_LITERAL(layer_least_motion) <= chord;
    GNOMON_T(layer_grid) g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, Real(1));
    g.axis_y = gnomon_select(moves, mean.d_y / chord, Real(0));
    g.motion = gnomon_select(moves, chord, Real(0));
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = Real(0.5) * texels;
    g.centre = Real(0.5) * (mean.least + mean.greatest);
    g.scale = Real(2) / gnomon_max(GNOMON_LITERAL(layer_least_depths), mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
GNOMON_STRUCT(layer_place) { Real u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of products
/// side by side even with contraction off, hence gnomon_product.
GNOMON_DETAIL_KERNEL GNOMON_T(layer_place) layer_grid_turned(GNOMON_T(layer_grid) grid, Real x, Real y)
{
    GNOMON_T(layer_place) r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
GNOMON_KERNEL GNOMON_T(layer_place) layer_grid_place(GNOMON_T(layer_grid) grid, Real x, Real y, Real t)
{
    layer_place turned = layer_grid_turned(grid, x, y);
    GNOMON_T(layer_place) r;
    r.u = grid.scale_u * (turned.u + grid.motion * (Real(0.5) - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
GNOMON_KERNEL Real layer_place_is_inside(GNOMON_T(layer_grid) grid, GNOMON_T(layer_place) place)
{
    Real texels = Real(2) * grid.middle;
    GNOMON_MASK begun = Real(0) <= place.u && Real(0) <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, Real(1), Real(0));
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t) d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
GNOMON_KERNEL Real layer_grid_depth(GNOMON_T(layer_grid) grid, Real z, Real t)
{
    return z + (Real(0.5) - t) * grid.d_z;
}

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in [-1, 1].
/// A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
GNOMON_KERNEL Real layer_grid_own_depth(GNOMON_T(layer_grid) grid, Real z, Real t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

GNOMON_NAMESPACE_END
#endif
