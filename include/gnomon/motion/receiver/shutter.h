// What the time while a shutter is open is worth: the share of its light that it has let in by time t. What a receiver
// loses between two times is the difference (Palmer 2011, (2.1): the response w(t), integrated once and for all).
//
// Three responses: a box, which opens and closes at once; a tent, wide open halfway; and eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter.
//
// An exposure that ends before it begins is the one between its two times, and one of no length shows what is there at
// that moment (shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H
#include "../../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// What each eighth of the exposure lets in, one after the other; together 1 (shutter_weights_make).
GNOMON_STRUCT(shutter_weights) { Real w0, w1, w2, w3, w4, w5, w6, w7; };

/// When a shutter opens and closes.
GNOMON_STRUCT(shutter_exposure) { Real begin, end; };

GNOMON_CONSTANT(shutter_weight_limit, 1152921504606846976.0); // 2^60: eight of them have a sum in float

/// The exposure between two times in any order. One of less than 2^-20, or of no length, lasts 2^-20 from its begin on,
/// or until shutter close where it would end later: what hides a receiver meanwhile hides it wholly. A NaN stays one.
GNOMON_KERNEL GNOMON_T(shutter_exposure) shutter_exposure_make(Real a, Real b)
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

/// When a share of the time from begin to end is over, within 3 2^-p max(|begin|, |end|). For shares between 0 and 1:
/// at the ends themselves llvmpipe makes 0 of the product with 0, of NaN as well.
GNOMON_KERNEL Real shutter_time(Real begin, Real end, GNOMON_SETTING share)
{
    return begin * (Real(1) - share) + end * share;
}

/// Share of the light that an open shutter has let in by time t, of what it does from begin to end: a shutter that
/// opens and closes at once. The share between two times is the difference. In [0, 1]; 0 where anything is NaN. Domain:
/// begin <= end; where they are the same, 0 until then and 1 after.
GNOMON_KERNEL Real shutter_box(Real t, Real begin, Real end) { return saturate_or_zero((t - begin) / (end - begin)); }

/// The same for a shutter that opens and closes evenly, wide open halfway.
GNOMON_KERNEL Real shutter_tent(Real t, Real begin, Real end)
{
    Real x = shutter_box(t, begin, end);
    Real left = Real(1) - x;
    return gnomon_select(x < Real(0.5), Real(2) * (x * x), Real(1) - Real(2) * (left * left));
}

/// A weight as it counts: 0 where it is negative or NaN, 2^60 where it is more.
GNOMON_KERNEL Real shutter_weight(Real w)
{
    return gnomon_select(Real(0) < w, gnomon_min(w, GNOMON_LITERAL(shutter_weight_limit)), Real(0));
}

/// What of the sum a weight is, an eighth where there is no sum. In [0, 1] where division is not exact, too.
GNOMON_KERNEL Real shutter_share(Real weight, Real sum)
{
    return gnomon_select(Real(0) < sum, saturate_or_zero(weight / sum), Real(0.125));
}

/// Any eight weights made to sum to 1, negative ones and NaN as 0; where none is left, eight equal ones, a box. Once
/// for a shutter, not for each range.
GNOMON_KERNEL GNOMON_T(shutter_weights) shutter_weights_make(GNOMON_T(shutter_weights) given)
{
    GNOMON_T(shutter_weights) w;
    w.w0 = shutter_weight(given.w0);
    w.w1 = shutter_weight(given.w1);
    w.w2 = shutter_weight(given.w2);
    w.w3 = shutter_weight(given.w3);
    w.w4 = shutter_weight(given.w4);
    w.w5 = shutter_weight(given.w5);
    w.w6 = shutter_weight(given.w6);
    w.w7 = shutter_weight(given.w7);
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

/// The same for a shutter whose eighths let in what w says, each evenly. Exactly 1 from its end on. Error: 16 2^-p; in
/// [0, 1] for any w, whether it comes from shutter_weights_make or not.
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
