// Layered variance shadow maps (Lauritzen & McCool 2008, "Layered variance shadow maps", section 3): depth is cut into
// layers, and each has a variance shadow map of the depth clamped to it and stretched to [-1, 1]. Clamping keeps the
// order of depths, so that every layer bounds the shadow intensity from below, and the largest bound holds. Depths in
// front of a layer are clamped to its front: only occluders and receivers that share a layer leak light.
//
//     state = layered_variance_begin(z_f);
//     state = layered_variance_add(state, filtered, settings);      for every layer, or just for the receiver's own
//     intensity = layered_variance_end(state);
#ifndef GNOMON_FILTERS_LAYERED_VARIANCE_H
#define GNOMON_FILTERS_LAYERED_VARIANCE_H
#include "variance.h"
GNOMON_NAMESPACE_BEGIN

/// A layer holds depths within 1 / scale of its centre; the minimum variance is that of the stretched depth.
GNOMON_STRUCT(layered_variance_settings) { Real centre, scale, minimum_variance; };

/// The layer's own depth of a depth z, in [-1, 1].
/// Domain: any z; scale at least 0. For 0 the layer tells no depths apart; an infinite scale is a shadow test at the centre. A
/// negative scale turns the order of depths around.
/// NaN: NaN.
GNOMON_KERNEL Real layered_variance_depth(Real z, GNOMON_T(layered_variance_settings) settings)
{
    return clamp_or_nan((z - settings.centre) * settings.scale, Real(-1), Real(1));
}

/// The layer's moments of one depth z.
/// Domain: any z.
/// NaN: the far end of the layer, which shadows nothing.
GNOMON_KERNEL GNOMON_T(variance_moments) layered_variance_encode(Real z, GNOMON_T(layered_variance_settings) settings)
{
    // Clamp once, not by layered_variance_depth and then by variance_encode: clang 14 drops the second clamp, and a
    // NaN would stay a NaN.
    GNOMON_T(variance_moments) r;
    r.mean = clamp_or_high((z - settings.centre) * settings.scale, Real(-1), Real(1));
    r.square = r.mean * r.mean;
    return r;
}

/// The receiver's depth, and the largest bound so far.
GNOMON_STRUCT(layered_variance) { Real receiver, intensity; };

/// The state before the first layer.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: lit.
GNOMON_KERNEL GNOMON_T(layered_variance) layered_variance_begin(Real z_f)
{
    GNOMON_T(layered_variance) r;
    r.receiver = gnomon_min(Real(1), z_f);
    r.intensity = Real(0);
    return r;
}

/// The state after one more layer with its filtered moments.
/// NaN: a layer with a NaN moment, centre or scale bounds nothing.
GNOMON_KERNEL GNOMON_T(layered_variance) layered_variance_add(GNOMON_T(layered_variance) state,
                                                              GNOMON_T(variance_moments) filtered,
                                                              GNOMON_T(layered_variance_settings) settings)
{
    Real receiver = layered_variance_depth(state.receiver, settings);
    state.intensity = gnomon_max(state.intensity, cantelli_lower(filtered, receiver, settings.minimum_variance));
    return state;
}

/// Shadow intensity in [0, 1], never above percentage-closer filtering but for rounding.
/// NaN: 0, lit.
/// Error: that of cantelli_lower for the layers' own depths, with r = 8 2^-p, the largest of all.
/// Source: Lauritzen & McCool 2008, Sec. 3
GNOMON_KERNEL Real layered_variance_end(GNOMON_T(layered_variance) state) { return saturate_or_zero(state.intensity); }

GNOMON_NAMESPACE_END
#endif
