// Parts of one layer that move unlike: samples of one range of depths, divided by their motion (the future work of Andersson
// et al. 2015, Sec. 7). Leaves and the branch between them have like depths, but unlike motions.
//
// The motions of a layer's samples vary most along one direction. Their places on it, in standard deviations, are clustered
// as depths are (layer_clusters.h): equal bins, and a cut at the longest interior run of empty ones. Either part has sums on
// a grid of its own motion. Both overlap in depth, so that either may hide the other: a sample of one part tells of the other
// only if it is behind the middle of that one's depths. A receiver sees the product of the visibilities through both, as
// through two layers.
//
//     state = layer_direction_begin(motion);                                       the layer's motion (layer_motion_end)
//     state = layer_direction_add(state, s, layer_middle_depth(s));                for all samples of the layer
//     direction = layer_direction_end(state);
//     window, bins and cuts of keys = layer_direction_key(direction, s) in place of depths, for two layers
//     part = layer_of(key, cuts)                                                   0 or 1
//     share = layer_share_of_part(at, layer, part, wanted, layer_middle_depth(s), centre)
//     sums = layer_sums_add(sums, z, share)                                        for the part `wanted`
#ifndef GNOMON_MOTION_LAYERS_LAYER_PARTS_H
#define GNOMON_MOTION_LAYERS_LAYER_PARTS_H
#include "layer_sums.h"
GNOMON_NAMESPACE_BEGIN

/// A fold over the samples of a layer: its mean motion, sums of squares and products of differences from that, and their
/// number.
GNOMON_STRUCT(layer_direction_sums) { Real d_x, d_y, xx, xy, yy, count; };

/// The mean motion of a layer, the direction in which its samples' motions differ most, and the inverse of four standard
/// deviations in that direction; 0 if they do not differ.
GNOMON_STRUCT(layer_direction) { Real d_x, d_y, axis_x, axis_y, scale; };

GNOMON_CONSTANT(layer_least_difference, 0.00000095367431640625); // 2^-20 square texels: motions that differ less do not

/// The state before the first sample.
GNOMON_KERNEL GNOMON_T(layer_direction_sums) layer_direction_begin(GNOMON_T(layer_motion) motion)
{
    GNOMON_T(layer_direction_sums) r;
    r.d_x = motion.d_x;
    r.d_y = motion.d_y;
    r.xx = Real(0);
    r.xy = Real(0);
    r.yy = Real(0);
    r.count = Real(0);
    return r;
}

/// The state after one more sample and its middle depth.
/// Domain: as for layer_motion_add.
/// NaN: no information, the state as before.
GNOMON_KERNEL GNOMON_T(layer_direction_sums) layer_direction_add(GNOMON_T(layer_direction_sums) state,
                                                                 GNOMON_T(stochastic_sample) s, Real middle)
{
    GNOMON_MASK known = layer_motion_is_known(s, middle);
    Real x = gnomon_select(known, s.d_x - state.d_x, Real(0));
    Real y = gnomon_select(known, s.d_y - state.d_y, Real(0));
    state.xx = state.xx + x * x;
    state.xy = state.xy + x * y;
    state.yy = state.yy + y * y;
    state.count = state.count + gnomon_select(known, Real(1), Real(0));
    return state;
}

/// The direction in which motions differ most: that of the larger eigenvalue of their covariance, along x if both are equal.
/// Domain: differences from 2^-10 texels on; of smaller ones the direction is along x, and scale is 0.
/// Error: with n samples, of the axis (n + 16) 2^-p times the larger eigenvalue over the difference of both; of scale, relative,
/// (n + 16) 2^-p.
GNOMON_KERNEL GNOMON_T(layer_direction) layer_direction_end(GNOMON_T(layer_direction_sums) state)
{
    Real half_difference = Real(0.5) * (state.xx - state.yy);
    Real radius = gnomon_sqrt(half_difference * half_difference + state.xy * state.xy);
    Real larger = Real(0.5) * (state.xx + state.yy) + radius;
    // (xy, larger - xx) and (larger - yy, xy) are both along the axis: the one without cancellation.
    GNOMON_MASK steep = half_difference < Real(0);
    Real long_part = radius + gnomon_abs(half_difference);
    Real x = gnomon_select(steep, state.xy, long_part);
    Real y = gnomon_select(steep, long_part, state.xy);
    Real norm = gnomon_sqrt(x * x + y * y);
    GNOMON_MASK apart = Real(0) < norm;
    Real square = larger / gnomon_max(state.count, Real(1));
    GNOMON_MASK differ = GNOMON_LITERAL(layer_least_difference) <= square;
    GNOMON_T(layer_direction) r;
    r.d_x = state.d_x;
    r.d_y = state.d_y;
    r.axis_x = gnomon_select(apart && differ, x / norm, Real(1));
    r.axis_y = gnomon_select(apart && differ, y / norm, Real(0));
    r.scale = gnomon_select(differ, Real(0.25) / gnomon_sqrt(square), Real(0));
    return r;
}

/// The place of a sample's motion on the direction, from the layer's mean: 1 at four standard deviations, limited to [-2, 2].
/// NaN: layer_unknown_depth.
GNOMON_KERNEL Real layer_direction_key(GNOMON_T(layer_direction) direction, GNOMON_T(stochastic_sample) s)
{
    Real x = (s.d_x - direction.d_x) * direction.axis_x;
    Real y = (s.d_y - direction.d_y) * direction.axis_y;
    Real key = (x + y) * direction.scale;
    Real limit = GNOMON_LITERAL(layer_depth_limit);
    Real inside = gnomon_max(gnomon_min(key, limit), Real(-1) * limit);
    return gnomon_select(gnomon_abs(key) <= GNOMON_LITERAL(texel_limit), inside, GNOMON_LITERAL(layer_unknown_depth));
}

/// The key that divides a layer into two parts: the centre of the longest run of empty bins (layer_cuts_add) if that is at
/// least `bins` bins long, else layer_no_cut. A few samples leave short runs anywhere.
/// NaN: a `bins` of NaN divides nothing.
GNOMON_KERNEL Real layer_part_cut(GNOMON_T(layer_runs) state, GNOMON_SETTING bins)
{
    return gnomon_select(bins <= state.length0, layer_cuts_end(state, Real(2)).c0, GNOMON_LITERAL(layer_no_cut));
}

/// Opacity and weight, for part number `wanted` of layer number `layer`, of a sample that is in part `part` of layer `at` at
/// the middle depth `middle`. A sample of the other part has no opacity. It has weight if it is behind `centre`, the middle of
/// the wanted part's depths: where it is seen, one sees past that part.
/// NaN: no weight for an `at` of NaN, nor in the layer for a `part`, `middle` or `centre` of NaN. A part below 0 is a NaN.
GNOMON_KERNEL GNOMON_T(layer_share) layer_share_of_part(Real at, Real layer, Real part, Real wanted, Real middle,
                                                        Real centre)
{
    GNOMON_T(layer_share) r = layer_share_of(at, layer);
    GNOMON_MASK other = at == layer && !(part == wanted);
    GNOMON_MASK past = centre < middle && Real(0) <= part;
    r.opacity = gnomon_select(other, Real(0), r.opacity);
    r.weight = gnomon_select(other && !past, Real(0), r.weight);
    return r;
}

GNOMON_NAMESPACE_END
#endif
