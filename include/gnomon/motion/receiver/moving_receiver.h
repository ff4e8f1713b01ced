// The shadow that falls on a receiver that moves, in closed form: what Palmer 2011 leaves for the future (chapter 5,
// Analytical Dynamic Receivers). A texel sweep says which texel it is in from when to when; in each, a range of the
// texel's resolved list is in front of the receiver's line of depth for a time as in static_receiver.h, which is the
// case of one texel and a level line. Exact but for rounding, where his 2 samples per texel are not.
//
//     state = moving_receiver_begin(path, begin, end);
//     for each texel of a texel sweep of the path:
//         state = moving_receiver_texel(state, sweep);
//         state = moving_receiver_add_box(state, range);    or _add_tent, _add_given; for every range of the texel
//     intensity = moving_receiver_end(state);
//
// Filtered: between the centres of texels the bilinear weights of the receiver's position are products of two lines in
// time, and the response of a shutter is a line at a time, so what a range hides is worth the integral of a product of
// three lines. With percentage-closer filtering of K x K bilinear look-ups (K = 1: bilinear filtering alone):
//     for each texel of a texel sweep of receiver_path_shift(path, -K / 2, -K / 2), i and j from 0 to K:
//         state = moving_receiver_tap(state, sweep, i, j, K);
//         state = moving_receiver_filter_box(state, range);  or _tent, _given; for every range of texel (column + i,
//                                                            row + j)
// It is the mean of K x K receivers by bilinear filtering, each on the path shifted by whole texels.
#ifndef GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#include "static_receiver.h"
#include "texel_sweep.h"
GNOMON_NAMESPACE_BEGIN

/// The receiver's line of depth, when the shutter opens and closes, from when to when it is in a texel, the texel's
/// weights along the two axes at both of these times, and the share of its light that is gone so far.
GNOMON_STRUCT(moving_receiver)
{
    GNOMON_T(depth_time_range) course;
    Real begin, end, t0, t1, u0, v0, u1, v1, shadowed;
};

/// No texel yet. From begin to end as of shutter_exposure_make. A path that lasts for a part of the exposure loses light
/// in that part alone; divide by what the shutter lets in meanwhile. Whatever needs a depth bias takes it off both
/// depths first.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_begin(GNOMON_T(receiver_path) path, Real begin, Real end)
{
    shutter_exposure open = shutter_exposure_make(begin, end);
    GNOMON_T(moving_receiver) r;
    r.course = path.depth;
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

/// The ranges to come are of the sweep's texel.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_texel(GNOMON_T(moving_receiver) state,
                                                              GNOMON_T(texel_sweep) sweep)
{
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    return state;
}

/// The ranges to come are of texel (column + i, row + j) of the (K + 1) x (K + 1) around a cell between centres, on a
/// path shifted by -K / 2. Weights go from one end of the cell to the other in a line, which in perspective is a chord:
/// with w changing r-fold in the cell, its error is (sqrt(r) - 1) / (sqrt(r) + 1) of how far u and v go in it.
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

/// One range, for a shutter that opens and closes at once.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_add_box(GNOMON_T(moving_receiver) state,
                                                                GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    Real share0 = shutter_box(hidden.t0, state.begin, state.end);
    Real share1 = shutter_box(hidden.t1, state.begin, state.end);
    state.shadowed = state.shadowed + receiver_lost_light(hidden, state.course.id, share0, share1);
    return state;
}

/// One range, for a shutter that opens and closes evenly.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_add_tent(GNOMON_T(moving_receiver) state,
                                                                 GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    Real share0 = shutter_tent(hidden.t0, state.begin, state.end);
    Real share1 = shutter_tent(hidden.t1, state.begin, state.end);
    state.shadowed = state.shadowed + receiver_lost_light(hidden, state.course.id, share0, share1);
    return state;
}

/// One range, for a shutter with given weights.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_add_piecewise(GNOMON_T(moving_receiver) state,
                                                                      GNOMON_T(depth_time_range) r,
                                                                      GNOMON_T(shutter_weights) w)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    Real share0 = shutter_piecewise(hidden.t0, state.begin, state.end, w);
    Real share1 = shutter_piecewise(hidden.t1, state.begin, state.end, w);
    state.shadowed = state.shadowed + receiver_lost_light(hidden, state.course.id, share0, share1);
    return state;
}

GNOMON_CONSTANT(receiver_twelfth, 0.083333333333333333333); // Dawn divides by 12 like this, too

/// What is lost while a range hides the receiver, in a part of the exposure in which the shutter's response is a line:
/// response + slope x at the share x of the exposure, from time start to time stop; by the weights of
/// moving_receiver_tap. With P and Q lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b)
/// / 6, and the mean of three lines alike; nothing cancels.
GNOMON_KERNEL Real moving_receiver_part(GNOMON_T(moving_receiver) state, GNOMON_T(depth_time_range) hidden, Real start,
                                        Real stop, Real response, Real slope)
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
        Real share = receiver_lost_light(hidden, state.course.id, share_a, share_b);
        lost = gnomon_select(some, share * twelvefold * GNOMON_LITERAL(receiver_twelfth), lost);
    }
    return lost;
}

/// One range of a tap, for a shutter that opens and closes at once.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_filter_box(GNOMON_T(moving_receiver) state,
                                                                   GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    state.shadowed = state.shadowed + moving_receiver_part(state, hidden, state.begin, state.end, Real(1), Real(0));
    return state;
}

/// One range of a tap, for a shutter that opens and closes evenly.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_filter_tent(GNOMON_T(moving_receiver) state,
                                                                    GNOMON_T(depth_time_range) r)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    Real halfway = shutter_time(state.begin, state.end, Real(0.5));
    Real opening = moving_receiver_part(state, hidden, state.begin, halfway, Real(0), Real(4));
    Real closing = moving_receiver_part(state, hidden, halfway, state.end, Real(4), Real(-4));
    state.shadowed = state.shadowed + (opening + closing);
    return state;
}

/// One range of a tap, for a shutter with given weights.
GNOMON_KERNEL GNOMON_T(moving_receiver) moving_receiver_filter_piecewise(GNOMON_T(moving_receiver) state,
                                                                         GNOMON_T(depth_time_range) r,
                                                                         GNOMON_T(shutter_weights) w)
{
    depth_time_range hidden = range_occluding_part(r, state.course, state.t0, state.t1);
    Real none = Real(0);
    Real t1 = shutter_time(state.begin, state.end, Real(0.125));
    Real t2 = shutter_time(state.begin, state.end, Real(0.25));
    Real t3 = shutter_time(state.begin, state.end, Real(0.375));
    Real t4 = shutter_time(state.begin, state.end, Real(0.5));
    Real t5 = shutter_time(state.begin, state.end, Real(0.625));
    Real t6 = shutter_time(state.begin, state.end, Real(0.75));
    Real t7 = shutter_time(state.begin, state.end, Real(0.875));
    Real lost = moving_receiver_part(state, hidden, state.begin, t1, Real(8) * w.w0, none);
    lost = lost + moving_receiver_part(state, hidden, t1, t2, Real(8) * w.w1, none);
    lost = lost + moving_receiver_part(state, hidden, t2, t3, Real(8) * w.w2, none);
    lost = lost + moving_receiver_part(state, hidden, t3, t4, Real(8) * w.w3, none);
    lost = lost + moving_receiver_part(state, hidden, t4, t5, Real(8) * w.w4, none);
    lost = lost + moving_receiver_part(state, hidden, t5, t6, Real(8) * w.w5, none);
    lost = lost + moving_receiver_part(state, hidden, t6, t7, Real(8) * w.w6, none);
    lost = lost + moving_receiver_part(state, hidden, t7, state.end, Real(8) * w.w7, none);
    state.shadowed = state.shadowed + lost;
    return state;
}

/// Shadow intensity in [0, 1] over the whole shutter. A NaN hides nothing. Error for each range as for a receiver at
/// rest (static_receiver_end), filtered 97 2^-p instead of 32; further those of when texels are entered and left
/// (texel_border_share), or of weights (receiver_path_at, and moving_receiver_tap in perspective).
GNOMON_KERNEL Real moving_receiver_end(GNOMON_T(moving_receiver) state) { return saturate_or_zero(state.shadowed); }

GNOMON_NAMESPACE_END
#endif
