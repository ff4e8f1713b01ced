// Light through translucent surfaces that move: each range of a texel has an opacity, and light passes all ranges in
// front of a receiver. At one time the transmittance is the product of 1 - opacity over these ranges. It changes only
// when a range begins or ceases to be in front, so over the shutter interval it is a function of steps, whose mean is
// exact. The lists need no order and are not resolved: translucent ranges may overlap in time. An opaque surface is a
// range of opacity 1. (Palmer 2011, chapter 5, leaves transparency as future work.)
//
//     for (t = begin; t < end; t = step.t1)
//         step = range_transmittance_begin(t, end);
//         for every range of the texel, with its opacity:
//             hidden = static_receiver_occluding_part(state, range);      or that of a moving receiver
//             step = range_transmittance_add(step, hidden, id, opacity);
//         lost = range_transmittance_lost(step, share0, share1);    the shutter's shares at step.t0 and step.t1
//         state = static_receiver_add(state, lost);
//
// For a moving receiver with filtering, moving_receiver_filtered_light of a range with the times of the step, times the
// opacity of the step, is what it loses. Steps are contiguous from begin to end, and n ranges make at most 2 n + 1.
#ifndef GNOMON_MOTION_RANGE_RANGE_TRANSMITTANCE_H
#define GNOMON_MOTION_RANGE_RANGE_TRANSMITTANCE_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// A step of the transmittance of a list: from t0 to t1 the same ranges are in front of the receiver.
GNOMON_STRUCT(range_transmittance) { Real t0, t1, transmittance; };

/// Begin a step at time t, without a range. It lasts until end at most.
GNOMON_KERNEL GNOMON_T(range_transmittance) range_transmittance_begin(Real t, Real end)
{
    GNOMON_T(range_transmittance) step;
    step.t0 = t;
    step.t1 = end;
    step.transmittance = Real(1);
    return step;
}

/// Add a range of the given opacity by `hidden`, its part in front of the receiver. The step ends when that part begins
/// or ends next. A range of the receiver's own id takes no light.
/// Domain: an opacity in [0, 1], and is clamped to that.
/// NaN: a range, or an opacity, with a NaN takes no light.
/// Error: after n ranges, 2 n 2^-p of the transmittance.
GNOMON_KERNEL GNOMON_T(range_transmittance) range_transmittance_add(GNOMON_T(range_transmittance) step,
                                                                    GNOMON_T(depth_time_range) hidden, Real id,
                                                                    Real opacity)
{
    GNOMON_MASK counts = hidden.t0 < hidden.t1 && !(hidden.id == id);
    GNOMON_MASK during = counts && hidden.t0 <= step.t0 && step.t0 < hidden.t1;
    GNOMON_MASK later = counts && step.t0 < hidden.t0;
    Real change = gnomon_select(during, hidden.t1, gnomon_select(later, hidden.t0, step.t1));
    step.t1 = gnomon_min(step.t1, change);
    Real passing = Real(1) - saturate_or_zero(opacity);
    step.transmittance = gnomon_select(during, step.transmittance * passing, step.transmittance);
    return step;
}

/// Share of the light that a receiver loses during the step, in [0, 1]. The shutter has let in the shares share0 and
/// share1 of the exposure's light at the begin and at the end of the step.
/// NaN: 0.
/// Error: of the share let in, 4 2^-p, and that of the transmittance.
GNOMON_KERNEL Real range_transmittance_lost(GNOMON_T(range_transmittance) step, Real share0, Real share1)
{
    return saturate_or_zero(share1 - share0) * saturate_or_zero(Real(1) - step.transmittance);
}

GNOMON_NAMESPACE_END
#endif
