// Deep shadow maps (Lokovic & Veach 2000): transmittance over depth for each texel, from 1 in front of all occluders to
// that behind them. What moves covers a texel for a part of the time, so motion counts as translucency: time is
// collapsed, which is right for static receivers under a static light and for no others.
//
// A deep layer takes away a share of the light, its opacity, evenly from depth z0 to depth z1, or at once if both are
// equal. Layers multiply, in any order:
//     transmittance = 1;   for every layer of the texel: transmittance = deep_shadow_add(transmittance, layer, z_f)
//     intensity = deep_shadow_end(transmittance);
//
// The layers of a texel come from its transmittance as a polyline over depth, which is compressed to a tolerance by a
// greedy window of slopes: one line goes on for as long as it passes all vertices within the tolerance.
//     window = deep_window_begin(tolerance);
//     for each vertex from near to far: window = deep_window_add(window, z, v), and keep window.layer
//     layer = deep_window_end(window), kept, too
// Layers of opacity 0 are not kept.
// The n sorted depths of samples have two vertices each: (z_k, 1 - k / n) and (z_k, 1 - (k + 1) / n), k from 0.
//
// With ever more samples the polyline becomes the one of a resolved list, in closed form: each range that covers the
// texel for a time takes that time's share of the light, evenly over its depths (deep_shadow_share). So lists of ranges
// give the deep map that samples converge to.
#ifndef GNOMON_MOTION_RANGE_DEEP_SHADOW_H
#define GNOMON_MOTION_RANGE_DEEP_SHADOW_H
#include "range.h"
GNOMON_NAMESPACE_BEGIN

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
GNOMON_STRUCT(deep_layer) { Real z0, z1, opacity; };

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
GNOMON_KERNEL Real deep_shadow_add(Real transmittance, GNOMON_T(deep_layer) layer, Real z_f)
{
    Real passed = saturate_or_zero((z_f - layer.z0) / (layer.z1 - layer.z0));
    return transmittance * (Real(1) - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
GNOMON_KERNEL Real deep_shadow_end(Real transmittance) { return saturate_or_zero(Real(1) - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
GNOMON_KERNEL Real deep_shadow_share(GNOMON_T(depth_time_range) r, Real z_f)
{
    depth_time_range c = range_clip(r, Real(0), Real(1));
    Real nearest = gnomon_min(c.z0, c.z1);
    Real passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0, c.z1) - nearest));
    GNOMON_MASK known = c.z0 == c.z0 && c.z1 == c.z1;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, Real(0)));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if the
/// line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
GNOMON_STRUCT(deep_window)
{
    Real tolerance, z0, v0, z1, v1, least, most, v, touched;
    GNOMON_T(deep_layer) layer;
};

GNOMON_CONSTANT(deep_window_steepest, 1099511627776.0); // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
GNOMON_KERNEL GNOMON_T(deep_layer) deep_window_end(GNOMON_T(deep_window) window)
{
    GNOMON_T(deep_layer) r;
    r.z0 = window.z0;
    r.z1 = window.z1;
    r.opacity = saturate_or_zero((window.v0 - window.v1) / window.v0);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
GNOMON_DETAIL_KERNEL GNOMON_T(deep_window) deep_window_next(GNOMON_T(deep_window) window)
{
    window.layer = deep_window_end(window);
    window.z0 = window.z1;
    window.v0 = window.v1;
    window.least = Real(-1) * GNOMON_LITERAL(deep_window_steepest);
    window.most = Real(0);
    window.touched = Real(0);
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the polyline.
/// With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
GNOMON_KERNEL GNOMON_T(deep_window) deep_window_begin(Real tolerance)
{
    GNOMON_T(deep_window) r;
    r.tolerance = gnomon_max(tolerance, Real(0));
    r.z0 = Real(-1);
    r.v0 = Real(1);
    r.z1 = Real(-1);
    r.v1 = Real(1);
    r.v = Real(1);
    return deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
GNOMON_DETAIL_KERNEL GNOMON_T(deep_window) deep_window_lead(GNOMON_T(deep_window) window, Real z, Real v)
{
    Real length = z - window.z0;
    Real lowest = (gnomon_max(v - window.tolerance, Real(0)) - window.v0) / length;
    Real highest = (v + window.tolerance - window.v0) / length;
    Real least = gnomon_max(window.least, lowest);
    Real most = gnomon_min(window.most, highest);
    Real nearest = saturate_or_zero(clamp_or_high(v, window.v0 + least * length, window.v0 + most * length));
    GNOMON_MASK level = window.touched < Real(1) && v == window.v && window.z1 < z; // no line begins before a drop
    GNOMON_MASK step = length * GNOMON_LITERAL(deep_window_steepest) <= Real(1);
    GNOMON_MASK kept = level || (step && window.v0 <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, Real(1), least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, Real(0), most));
    window.v1 = gnomon_select(kept, window.v0, gnomon_select(step, v, nearest));
    window.z0 = gnomon_select(level, z, window.z0);
    window.touched = gnomon_select(level, Real(0), Real(1));
    window.z1 = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
GNOMON_DETAIL_KERNEL GNOMON_T(deep_window) deep_window_select(GNOMON_MASK mask, GNOMON_T(deep_window) a,
                                                              GNOMON_T(deep_window) b)
{
    b.z0 = gnomon_select(mask, a.z0, b.z0);
    b.v0 = gnomon_select(mask, a.v0, b.v0);
    b.z1 = gnomon_select(mask, a.z1, b.z1);
    b.v1 = gnomon_select(mask, a.v1, b.v1);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0 = gnomon_select(mask, a.layer.z0, b.layer.z0);
    b.layer.z1 = gnomon_select(mask, a.layer.z1, b.layer.z1);
    b.layer.opacity = gnomon_select(mask, a.layer.opacity, b.layer.opacity);
    return b;
}

/// Add a vertex of the polyline, transmittance v at depth z; two at one depth are a step. If the layer of the result has
/// an opacity above 0 it is complete, and the caller keeps it.
/// Domain: vertices from near to far, transmittance in [0, 1] and never growing; others are moved to the nearest such.
/// Depths closer than 2^-40 count as equal.
/// NaN: the vertex is left out, as is one beyond 2^60.
/// Error: with all layers kept, the tolerance and 4 2^-p for each of them.
/// Source: Lokovic & Veach 2000
GNOMON_KERNEL GNOMON_T(deep_window) deep_window_add(GNOMON_T(deep_window) window, Real z, Real v)
{
    GNOMON_MASK known = gnomon_abs(z) < GNOMON_LITERAL(range_far) && v == v;
    Real touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1), window.z1);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = Real(0);
    deep_window led = deep_window_lead(window, z, v);
    GNOMON_MASK deeper =
        window.most < window.least && (z - window.z0) * GNOMON_LITERAL(deep_window_steepest) <= Real(1);
    GNOMON_MASK done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) led = deep_window_select(done, deep_window_lead(deep_window_next(window), z, v), led);
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
}

GNOMON_NAMESPACE_END
#endif
