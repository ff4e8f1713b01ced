// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that turns,
// a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H
#include "../../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
GNOMON_STRUCT(shutter_weights) { Real w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
GNOMON_STRUCT(shutter_exposure) { Real begin, end; };

GNOMON_CONSTANT(shutter_weight_limit, 1152921504606846976.0); // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
GNOMON_DETAIL_KERNEL GNOMON_T(shutter_exposure) shutter_exposure_make(Real a, Real b)
{
    Real least = Real(0.00000095367431640625);
    GNOMON_MASK swapped = b < a;
    Real open = gnomon_select(swapped, b, a);
    Real close = gnomon_select(swapped, a, b);
    GNOMON_MASK brief = close - open < least;
    Real early = gnomon_select(open <= Real(1), gnomon_min(open, Real(1) - least), open);
    GNOMON_T(shutter_exposure) r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
GNOMON_KERNEL Real shutter_time(Real begin, Real end, GNOMON_SETTING share)
{
    return begin * (Real(1) - share) + end * share;
}

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
GNOMON_KERNEL Real shutter_box(Real t, Real begin, Real end) { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
GNOMON_KERNEL Real shutter_tent(Real t, Real begin, Real end)
{
    Real x = shutter_box(t, begin, end);
    Real left = Real(1) - x;
    return gnomon_select(x < Real(0.5), Real(2) * (x * x), Real(1) - Real(2) * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
GNOMON_DETAIL_KERNEL Real shutter_weight(Real w)
{
    return gnomon_select(Real(0) < w, gnomon_min(w, GNOMON_LITERAL(shutter_weight_limit)), Real(0));
}

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
GNOMON_DETAIL_KERNEL Real shutter_share(Real weight, Real sum)
{
    return gnomon_select(Real(0) < sum, saturate_or_zero(weight / sum), Real(0.125));
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the begin
/// of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
GNOMON_KERNEL Real shutter_line(Real t, Real begin, Real end, Real w0, Real w1)
{
    Real a = shutter_weight(w0);
    Real b = shutter_weight(w1);
    Real sum = a + b;
    Real x = shutter_box(t, begin, end);
    Real early = gnomon_select(Real(0) < sum, saturate_or_zero(a / sum), Real(0.5));
    return saturate_or_zero(x * (early + (early * (Real(1) - x) + (Real(1) - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
GNOMON_KERNEL GNOMON_T(shutter_weights) shutter_weights_make(GNOMON_T(shutter_weights) weights)
{
    GNOMON_T(shutter_weights) w;
    w.w0 = shutter_weight(weights.w0);
    w.w1 = shutter_weight(weights.w1);
    w.w2 = shutter_weight(weights.w2);
    w.w3 = shutter_weight(weights.w3);
    w.w4 = shutter_weight(weights.w4);
    w.w5 = shutter_weight(weights.w5);
    w.w6 = shutter_weight(weights.w6);
    w.w7 = shutter_weight(weights.w7);
    Real sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = shutter_share(w.w0, sum);
    w.w1 = shutter_share(w.w1, sum);
    w.w2 = shutter_share(w.w2, sum);
    w.w3 = shutter_share(w.w3, sum);
    w.w4 = shutter_share(w.w4, sum);
    w.w5 = shutter_share(w.w5, sum);
    w.w6 = shutter_share(w.w6, sum);
    w.w7 = shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
GNOMON_KERNEL Real shutter_piecewise(Real t, Real begin, Real end, GNOMON_T(shutter_weights) w)
{
    Real x = Real(8) * shutter_box(t, begin, end);
    Real early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - Real(1))) +
                 (w.w2 * saturate_or_zero(x - Real(2)) + w.w3 * saturate_or_zero(x - Real(3)));
    Real late = (w.w4 * saturate_or_zero(x - Real(4)) + w.w5 * saturate_or_zero(x - Real(5))) +
                (w.w6 * saturate_or_zero(x - Real(6)) + w.w7 * saturate_or_zero(x - Real(7)));
    return gnomon_select(x < Real(8), saturate_or_zero(early + late), Real(1));
}

GNOMON_NAMESPACE_END
#endif
