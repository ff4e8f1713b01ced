// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson et
// al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's own
// motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest runs of
// empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none. A
// sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#include "stochastic_sample.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(layer_depth_limit, 2.0);      // middle depths of surfaces lie in [-2, 2]
GNOMON_CONSTANT(layer_no_cut, 3.0);           // a cut behind all surfaces
GNOMON_CONSTANT(layer_background_depth, 4.0); // the middle depth of the background
GNOMON_CONSTANT(layer_unknown_depth, -4.0);   // the middle depth of a sample of NaN
GNOMON_CONSTANT(layer_last_bin, 63.0);
GNOMON_CONSTANT(layer_least_extent, 0.00006103515625); // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2, 2];
/// layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
GNOMON_KERNEL Real layer_middle_depth(GNOMON_T(stochastic_sample) s)
{
    Real z = s.z + (Real(0.5) - s.t) * s.d_z;
    Real limit = GNOMON_LITERAL(layer_depth_limit);
    Real inside = gnomon_max(gnomon_min(z, limit), Real(-1) * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    Real size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    GNOMON_MASK known = size <= GNOMON_LITERAL(texel_limit);
    Real middle = gnomon_select(known, inside, GNOMON_LITERAL(layer_unknown_depth));
    return gnomon_select(s.id < Real(0), GNOMON_LITERAL(layer_background_depth), middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
GNOMON_DETAIL_KERNEL GNOMON_MASK layer_is_surface(Real middle)
{
    return gnomon_abs(middle) <= GNOMON_LITERAL(layer_depth_limit);
}

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
GNOMON_STRUCT(layer_window) { Real least, greatest; };

/// The window of one sample, by its middle depth.
GNOMON_KERNEL GNOMON_T(layer_window) layer_window_begin(Real middle)
{
    GNOMON_MASK surface = layer_is_surface(middle);
    GNOMON_T(layer_window) w;
    w.least = gnomon_select(surface, middle, GNOMON_LITERAL(layer_background_depth));
    w.greatest = gnomon_select(surface, middle, GNOMON_LITERAL(layer_unknown_depth));
    return w;
}

/// The window with one more sample, by its middle depth.
GNOMON_KERNEL GNOMON_T(layer_window) layer_window_add(GNOMON_T(layer_window) window, Real middle)
{
    layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
GNOMON_KERNEL Real layer_bin_of(Real middle, GNOMON_T(layer_window) window)
{
    Real share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    Real bin = gnomon_min(texel_below(Real(64) * share), GNOMON_LITERAL(layer_last_bin));
    return gnomon_select(layer_is_surface(middle), bin, Real(-1));
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones since
/// the last of these, and the lengths and centres of the three longest runs, in bins.
GNOMON_STRUCT(layer_runs)
{
    Real least, greatest, bins, begun, empty;
    Real length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
GNOMON_KERNEL GNOMON_T(layer_runs) layer_cuts_begin(GNOMON_T(layer_window) window)
{
    GNOMON_T(layer_runs) r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = Real(0);
    r.begun = Real(0);
    r.empty = Real(0);
    r.length0 = Real(0);
    r.length1 = Real(0);
    r.length2 = Real(0);
    r.centre0 = Real(0);
    r.centre1 = Real(0);
    r.centre2 = Real(0);
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length the
/// nearer one counts as longer.
GNOMON_KERNEL GNOMON_T(layer_runs) layer_cuts_add(GNOMON_T(layer_runs) state, Real occupied)
{
    GNOMON_MASK some = Real(0) < occupied;
    Real centre = state.bins - Real(0.5) * state.empty;
    GNOMON_MASK third = some && state.length2 < state.empty;
    GNOMON_MASK second = some && state.length1 < state.empty;
    GNOMON_MASK first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, Real(1), state.begun);
    state.empty = gnomon_select(some, Real(0), state.empty + state.begun);
    state.bins = state.bins + Real(1);
    return state;
}

/// Depths that cut a window into layers, from near to far; layer_no_cut for those that are not needed.
GNOMON_STRUCT(layer_cuts) { Real c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins before
/// and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by that.
/// Source: Andersson 2015, Sec. 4.1
GNOMON_KERNEL GNOMON_T(layer_cuts) layer_cuts_end(GNOMON_T(layer_runs) state, GNOMON_SETTING layers)
{
    Real none = GNOMON_LITERAL(layer_no_cut);
    Real extent = state.greatest - state.least;
    GNOMON_MASK surfaces = layer_is_surface(state.least) && layer_is_surface(state.greatest);
    GNOMON_MASK some = surfaces && GNOMON_LITERAL(layer_least_extent) <= extent;
    Real per_bin = Real(0.015625) * extent;
    GNOMON_MASK first = some && Real(0) < state.length0 && Real(1) < layers;
    GNOMON_MASK second = some && Real(0) < state.length1 && Real(2) < layers;
    GNOMON_MASK third = some && Real(0) < state.length2 && Real(3) < layers;
    Real a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    Real b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    Real c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    Real near_ab = gnomon_min(a, b);
    Real far_ab = gnomon_max(a, b);
    Real middle = gnomon_min(far_ab, c);
    GNOMON_T(layer_cuts) r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
GNOMON_KERNEL Real layer_of(Real middle, GNOMON_T(layer_cuts) cuts)
{
    Real known = gnomon_select(Real(-1) * GNOMON_LITERAL(layer_depth_limit) <= middle, Real(0), Real(-1));
    Real first = gnomon_select(cuts.c0 <= middle, Real(1), Real(0));
    Real second = gnomon_select(cuts.c1 <= middle, Real(1), Real(0));
    Real third = gnomon_select(cuts.c2 <= middle, Real(1), Real(0));
    Real behind = gnomon_select(GNOMON_LITERAL(layer_background_depth) <= middle, Real(1), Real(0));
    return (known + first) + ((second + third) + behind);
}

GNOMON_NAMESPACE_END
#endif
