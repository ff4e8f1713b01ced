// Gnomon 0.1.0, layer_clusters.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_CLUSTERS_GLSL
#define GNOMON_LAYER_CLUSTERS_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: layer_clusters.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_clusters.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_clusters.glsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 300
#error "gnomon: #version 300 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 330
#error "gnomon: #version 330 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return intBitsToFloat(min(floatBitsToInt(x), 0x7FC00000)); }
float gnomon_apart(float x) { return uintBitsToFloat(min(floatBitsToUint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = floatBitsToInt(x);
    return gnomon_select(bits > 0x7F800000, 0.0, intBitsToFloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return uintBitsToFloat(floatBitsToUint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return uintBitsToFloat((floatBitsToUint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

const float gnomon_texel_limit = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

#endif

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

const float gnomon_stochastic_nothing = -1.0;               // the id of the background
const float gnomon_stratum_begin = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const float gnomon_stratum_end = 0.999999523162841796875;   // 1 - 2^-21

/// A sample of the background.
stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0;
    s.d_x = 0.0;
    s.d_y = 0.0;
    s.d_z = 0.0;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

#endif

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

const float gnomon_layer_depth_limit = 2.0;      // middle depths of surfaces lie in [-2, 2]
const float gnomon_layer_no_cut = 3.0;           // a cut behind all surfaces
const float gnomon_layer_background_depth = 4.0; // the middle depth of the background
const float gnomon_layer_unknown_depth = -4.0;   // the middle depth of a sample of NaN
const float gnomon_layer_last_bin = 63.0;
const float gnomon_layer_least_extent = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
float layer_middle_depth(stochastic_sample s)
{
    float z = s.z + (0.5 - s.t) * s.d_z;
    float limit = gnomon_layer_depth_limit;
    float inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    float size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    bool known = size <= gnomon_texel_limit;
    float middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
bool gnomon_layer_is_surface(float middle) { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { float least, greatest; };

/// The window of one sample, by its middle depth.
gnomon_layer_window layer_window_begin(float middle)
{
    bool surface = gnomon_layer_is_surface(middle);
    gnomon_layer_window w;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
gnomon_layer_window layer_window_add(gnomon_layer_window window, float middle)
{
    gnomon_layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
float layer_bin_of(float middle, gnomon_layer_window window)
{
    float share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    float bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    float least, greatest, bins, begun, empty;
    float length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
gnomon_layer_runs layer_cuts_begin(gnomon_layer_window window)
{
    gnomon_layer_runs r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0 = 0.0;
    r.length1 = 0.0;
    r.length2 = 0.0;
    r.centre0 = 0.0;
    r.centre1 = 0.0;
    r.centre2 = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
gnomon_layer_runs layer_cuts_add(gnomon_layer_runs state, float occupied)
{
    bool some = 0.0 < occupied;
    float centre = state.bins - 0.5 * state.empty;
    bool third = some && state.length2 < state.empty;
    bool second = some && state.length1 < state.empty;
    bool first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { float c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_cuts layer_cuts_end(gnomon_layer_runs state, float layers)
{
    float none = gnomon_layer_no_cut;
    float extent = state.greatest - state.least;
    bool surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    bool some = surfaces && gnomon_layer_least_extent <= extent;
    float per_bin = 0.015625 * extent;
    bool first = some && 0.0 < state.length0 && 1.0 < layers;
    bool second = some && 0.0 < state.length1 && 2.0 < layers;
    bool third = some && 0.0 < state.length2 && 3.0 < layers;
    float a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    float b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    float c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    float near_ab = gnomon_min(a, b);
    float far_ab = gnomon_max(a, b);
    float middle = gnomon_min(far_ab, c);
    gnomon_layer_cuts r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
float layer_of(float middle, gnomon_layer_cuts cuts)
{
    float known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    float first = gnomon_select(cuts.c0 <= middle, 1.0, 0.0);
    float second = gnomon_select(cuts.c1 <= middle, 1.0, 0.0);
    float third = gnomon_select(cuts.c2 <= middle, 1.0, 0.0);
    float behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

#endif

#endif
