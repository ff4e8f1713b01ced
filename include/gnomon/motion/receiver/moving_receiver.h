// The shadow on a moving receiver while the shutter is open, in closed form: the Analytical Dynamic Receivers that
// Palmer 2011 leaves as future work (chapter 5). A texel sweep (texel_sweep.h) finds the texels that the receiver
// passes and the times that it spends in each. In each texel, a range of the resolved list is in front of the
// receiver's depth line for a time in closed form, as in static_receiver.h, which is the case of one texel and a level
// line. Exact except for rounding, where Palmer takes 2 samples for each texel.
//
//     state = moving_receiver_begin(path, begin, end);
//     for each texel of a texel sweep of the path: state = moving_receiver_texel(state, sweep);
//         for every range of the texel:
//             hidden = moving_receiver_occluding_part(state, range);
//             share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                        shutter_piecewise
//             state = moving_receiver_add(state, receiver_lost_light(hidden, path.depth.id, share0, share1));
//     intensity = moving_receiver_end(state);
//
// With filtering, the weight of a texel changes along the path. Between the centres of texels the bilinear weights of
// the receiver's position are products of two functions that are linear in time, and the response of a shutter is
// piecewise linear. So the light lost to a range is the integral of a product of three lines. Percentage-closer
// filtering of K x K bilinear look-ups (K = 1 is bilinear filtering alone):
//     for each texel of a texel sweep of receiver_path_shift(path, -K / 2, -K / 2), i and j from 0 to K:
//         state = moving_receiver_tap(state, sweep, i, j, K);
//         for every range of texel (column + i, row + j):
//             hidden = moving_receiver_occluding_part(state, range);
//             lost = moving_receiver_filtered_light(state, hidden, state.begin, state.end, 1, 0);   for a box; for a
//                 tent the sum for two halves of the exposure, for a piecewise shutter that for eight parts
//             state = moving_receiver_add(state, lost);
// The result is the mean of K x K receivers with bilinear filtering, each on the path shifted by whole texels.
#ifndef GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#include "static_receiver.h"
#include "texel_sweep.h"
GNOMON_NAMESPACE_BEGIN

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
GNOMON_STRUCT(moving_receiver)
{
    GNOMON_T(depth_time_range) depth;
    Real begin, end, t0, t1, u0, v0, u1, v1, shadowed;
};

/// Begin without a texel. The exposure lasts from begin to end, as of shutter_exposure_make. A depth bias, if one is
/// needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses light
/// only in that part: divide the result by the shutter's share of that part.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_begin(GNOMON_T(receiver_path) path, Real begin, Real end)
{
    shutter_exposure open = shutter_exposure_make(begin, end);
    GNOMON_T(moving_receiver) r;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0 = path.depth.t0;
    r.t1 = path.depth.t1;
    r.u0 = Real(1);
    r.v0 = Real(1);
    r.u1 = Real(1);
    r.v1 = Real(1);
    r.shadowed = Real(0);
    return r;
}

/// Begin the ranges of the sweep's texel.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_texel(GNOMON_T(moving_receiver) state,
                                                              GNOMON_T(texel_sweep) sweep)
{
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_tap(GNOMON_T(moving_receiver) state,
                                                            GNOMON_T(texel_sweep) sweep, GNOMON_SETTING i,
                                                            GNOMON_SETTING j, GNOMON_SETTING look_ups)
{
    texel_position enters = receiver_path_at(sweep.path, sweep.t_begin);
    texel_position leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    state.u0 = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0 = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1 = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1 = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
GNOMON_KERNEL GNOMON_T(depth_time_range) moving_receiver_occluding_part(GNOMON_T(moving_receiver) state,
                                                                        GNOMON_T(depth_time_range) r)
{
    return range_occluding_part(r, state.depth, state.t0, state.t1);
}

/// Add the share of the light that is lost to one range.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_add(GNOMON_T(moving_receiver) state, Real lost)
{
    state.shadowed = state.shadowed + lost;
    return state;
}

GNOMON_CONSTANT(receiver_twelfth, 0.083333333333333333333); // Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
GNOMON_KERNEL Real moving_receiver_filtered_light(GNOMON_T(moving_receiver) state, GNOMON_T(depth_time_range) hidden,
                                                  Real start, Real stop, Real response, Real slope)
{
    Real a = gnomon_max(hidden.t0, start);
    Real b = gnomon_min(hidden.t1, stop);
    GNOMON_MASK some = a < b;
    Real lost = Real(0);
    if (gnomon_any(some)) {
        Real share_a = shutter_box(a, state.begin, state.end);
        Real share_b = shutter_box(b, state.begin, state.end);
        Real passed_a = saturate_or_zero((a - state.t0) / (state.t1 - state.t0));
        Real passed_b = saturate_or_zero((b - state.t0) / (state.t1 - state.t0));
        Real u_a = state.u0 * (Real(1) - passed_a) + state.u1 * passed_a;
        Real v_a = state.v0 * (Real(1) - passed_a) + state.v1 * passed_a;
        Real u_b = state.u0 * (Real(1) - passed_b) + state.u1 * passed_b;
        Real v_b = state.v0 * (Real(1) - passed_b) + state.v1 * passed_b;
        Real aa = u_a * v_a;
        Real ab = u_a * v_b + u_b * v_a;
        Real bb = u_b * v_b;
        Real twelvefold = (response + slope * share_a) * (Real(3) * aa + ab + bb) +
                          (response + slope * share_b) * (aa + ab + Real(3) * bb);
        Real share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
        lost = gnomon_select(some, share * twelvefold * GNOMON_LITERAL(receiver_twelfth), lost);
    }
    return lost;
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range that of static_receiver_end, filtered with 97 2^-p instead of 32; and that of the times at
/// which the path enters and leaves texels (texel_border_share), or of weights (receiver_path_at, and
/// moving_receiver_tap in perspective).
/// Source: Palmer 2011, Sec. 5
GNOMON_KERNEL Real moving_receiver_end(GNOMON_T(moving_receiver) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
