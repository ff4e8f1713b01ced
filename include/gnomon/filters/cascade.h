// Cascades of one light: shadow maps of growing regions around the camera, the finest first (Engel 2006; Zhang et al.
// 2006). Every cascade has a weight in [0, 1] at a receiver: 1 within its region, falling to 0 over a band at its border.
// By view distance the regions are slices of the camera's frustum, by projection they are the maps' own squares, which
// reach farther. Over the maps front to back, intensities blend as layers do:
//
//     state = cascade_begin(weight, intensity);            for the finest cascade
//     state = cascade_add(state, weight, intensity);       for every other, the finer ones first
//     intensity = cascade_end(state);                      lit beyond the last one
//
// cascade_share is the part that the next cascade has in the result; a cascade with a share of 0 need not be read. One
// look-up for each receiver is enough where noise is filtered later: cascade_index_add finds the first cascade whose weight
// exceeds a threshold. The mean over thresholds drawn evenly from [0, 1) is the blend, as long as at most one weight lies
// between 0 and 1.
#ifndef GNOMON_FILTERS_CASCADE_H
#define GNOMON_FILTERS_CASCADE_H
#include "../numerics/exp.h"
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
GNOMON_KERNEL Real cascade_split(Real near_distance, Real far_distance, Real fraction, Real evenness)
{
    Real f = saturate_or_zero(fraction);
    Real e = saturate_or_zero(evenness);
    Real logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    Real even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
GNOMON_DETAIL_KERNEL Real cascade_inside(Real distance_inside, Real band)
{
    Real w = saturate_or_zero(distance_inside / gnomon_select(Real(0) < band, band, Real(1)));
    return gnomon_select(Real(0) < band, w, gnomon_select(Real(0) <= distance_inside, Real(1), Real(0)));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end, 0
/// from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
GNOMON_KERNEL Real cascade_weight_by_distance(Real distance_, GNOMON_SETTING end_distance, GNOMON_SETTING band)
{
    return cascade_inside(end_distance - distance_, band);
}

/// The weight in [0, 1] of a cascade at texture coordinates u, v in its map and signed depth z: 1 in the middle, falling over
/// a band to 0 at margin from the border of [0, 1] x [0, 1]. margin is the reach of filter and blur in texture coordinates, so
/// that no filter reads over the map's edge. z before the near plane or beyond the far plane has weight 0: casters are moved to
/// the near plane when the map is rendered, receivers are not.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p over band.
GNOMON_KERNEL Real cascade_weight_by_projection(Real u, Real v, Real z, GNOMON_SETTING margin, GNOMON_SETTING band)
{
    Real x = gnomon_abs(u - Real(0.5));
    Real y = gnomon_abs(v - Real(0.5));
    Real inside = (Real(0.5) - margin) - gnomon_max(y, x);
    GNOMON_MASK known = y <= Real(0.5) && gnomon_abs(z) <= Real(1); // a NaN in u is one in inside
    return gnomon_select(known, cascade_inside(inside, band), Real(0));
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
GNOMON_STRUCT(cascade_blend) { Real intensity, rest; };

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
GNOMON_KERNEL Real cascade_share(GNOMON_T(cascade_blend) state, Real weight)
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
GNOMON_KERNEL GNOMON_T(cascade_blend) cascade_add(GNOMON_T(cascade_blend) state, Real weight, Real intensity)
{
    Real share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
GNOMON_KERNEL GNOMON_T(cascade_blend) cascade_begin(Real weight, Real intensity)
{
    GNOMON_T(cascade_blend) r;
    r.intensity = Real(0);
    r.rest = Real(1);
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
GNOMON_KERNEL Real cascade_end(GNOMON_T(cascade_blend) state) { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
GNOMON_STRUCT(cascade_index) { Real index, searching; };

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds threshold, or
/// as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
GNOMON_KERNEL GNOMON_T(cascade_index) cascade_index_add(GNOMON_T(cascade_index) state, Real weight, Real threshold)
{
    state.searching = gnomon_select(threshold < weight, Real(0), state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
GNOMON_KERNEL GNOMON_T(cascade_index) cascade_index_begin(Real weight, Real threshold)
{
    GNOMON_T(cascade_index) r;
    r.index = Real(0);
    r.searching = Real(1);
    return cascade_index_add(r, weight, threshold);
}

GNOMON_NAMESPACE_END
#endif
