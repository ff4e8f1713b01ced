// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of the
// shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of n has a
// time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#include "../../numerics/texel_filter.h"
GNOMON_NAMESPACE_BEGIN

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// stochastic_nothing, depth 1 and no motion.
GNOMON_STRUCT(stochastic_sample) { Real x, y, t, z, d_x, d_y, d_z, id; };

GNOMON_CONSTANT(stochastic_nothing, -1.0);               // the id of the background
GNOMON_CONSTANT(stratum_begin, 1.000000476837158203125); // 1 + 2^-21: a time is so far from the ends of its stratum
GNOMON_CONSTANT(stratum_end, 0.999999523162841796875);   // 1 - 2^-21

/// A sample of the background.
GNOMON_KERNEL GNOMON_T(stochastic_sample) stochastic_background(Real x, Real y, Real t)
{
    GNOMON_T(stochastic_sample) s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = Real(1);
    s.d_x = Real(0);
    s.d_y = Real(0);
    s.d_z = Real(0);
    s.id = GNOMON_LITERAL(stochastic_nothing);
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
GNOMON_KERNEL Real stratified_time(Real stratum, Real count, Real jitter)
{
    Real place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + Real(1)) * GNOMON_LITERAL(stratum_end));
    place = gnomon_max(place, stratum * GNOMON_LITERAL(stratum_begin));
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
GNOMON_KERNEL Real slice_of(Real t, Real count)
{
    Real slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - Real(1)), Real(0));
}

GNOMON_NAMESPACE_END
#endif
