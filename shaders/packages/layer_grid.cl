// Gnomon 0.1.0, layer_grid.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_GRID_CL
#define GNOMON_LAYER_GRID_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: layer_grid.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_grid.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_grid.cl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline float gnomon_abs(float a) { return fabs(a); }
static inline float gnomon_sqrt(float a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline float gnomon_kept(float x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline float gnomon_apart(float x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
static inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
static inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
static inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
static inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
static inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
static inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline float gnomon_saturate(float x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline float gnomon_high_part(float a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline float gnomon_power_of_two(float n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
static inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
static inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
static inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
static inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
static inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

__constant float gnomon_texel_limit = 65536.0f; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
static inline float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0f * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0f, 0.0f);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
static inline float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0f, 1.0f - share, gnomon_select(i < look_ups, 1.0f, share));
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
typedef struct stochastic_sample stochastic_sample;
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

__constant float gnomon_stochastic_nothing = -1.0f;               // the id of the background
// 1 + 2^-21: a time is so far from the ends of its stratum
__constant float gnomon_stratum_begin = 1.000000476837158203125f;
__constant float gnomon_stratum_end = 0.999999523162841796875f;   // 1 - 2^-21

/// A sample of the background.
static inline stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0f;
    s.d_x = 0.0f;
    s.d_y = 0.0f;
    s.d_z = 0.0f;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
static inline float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0f) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
static inline float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0f), 0.0f);
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

__constant float gnomon_layer_depth_limit = 2.0f;      // middle depths of surfaces lie in [-2, 2]
__constant float gnomon_layer_no_cut = 3.0f;           // a cut behind all surfaces
__constant float gnomon_layer_background_depth = 4.0f; // the middle depth of the background
__constant float gnomon_layer_unknown_depth = -4.0f;   // the middle depth of a sample of NaN
__constant float gnomon_layer_last_bin = 63.0f;
__constant float gnomon_layer_least_extent = 0.00006103515625f; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
static inline float layer_middle_depth(stochastic_sample s)
{
    float z = s.z + (0.5f - s.t) * s.d_z;
    float limit = gnomon_layer_depth_limit;
    float inside = gnomon_max(gnomon_min(z, limit), -1.0f * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    float size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    bool known = size <= gnomon_texel_limit;
    float middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0f, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
static inline bool gnomon_layer_is_surface(float middle) { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
typedef struct gnomon_layer_window gnomon_layer_window;
struct gnomon_layer_window { float least, greatest; };

/// The window of one sample, by its middle depth.
static inline gnomon_layer_window layer_window_begin(float middle)
{
    bool surface = gnomon_layer_is_surface(middle);
    gnomon_layer_window w;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
static inline gnomon_layer_window layer_window_add(gnomon_layer_window window, float middle)
{
    gnomon_layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
static inline float layer_bin_of(float middle, gnomon_layer_window window)
{
    float share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    float bin = gnomon_min(texel_below(64.0f * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0f);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
typedef struct gnomon_layer_runs gnomon_layer_runs;
struct gnomon_layer_runs
{
    float least, greatest, bins, begun, empty;
    float length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
static inline gnomon_layer_runs layer_cuts_begin(gnomon_layer_window window)
{
    gnomon_layer_runs r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0f;
    r.begun = 0.0f;
    r.empty = 0.0f;
    r.length0 = 0.0f;
    r.length1 = 0.0f;
    r.length2 = 0.0f;
    r.centre0 = 0.0f;
    r.centre1 = 0.0f;
    r.centre2 = 0.0f;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
static inline gnomon_layer_runs layer_cuts_add(gnomon_layer_runs state, float occupied)
{
    bool some = 0.0f < occupied;
    float centre = state.bins - 0.5f * state.empty;
    bool third = some && state.length2 < state.empty;
    bool second = some && state.length1 < state.empty;
    bool first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, 1.0f, state.begun);
    state.empty = gnomon_select(some, 0.0f, state.empty + state.begun);
    state.bins = state.bins + 1.0f;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
typedef struct gnomon_layer_cuts gnomon_layer_cuts;
struct gnomon_layer_cuts { float c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
static inline gnomon_layer_cuts layer_cuts_end(gnomon_layer_runs state, float layers)
{
    float none = gnomon_layer_no_cut;
    float extent = state.greatest - state.least;
    bool surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    bool some = surfaces && gnomon_layer_least_extent <= extent;
    float per_bin = 0.015625f * extent;
    bool first = some && 0.0f < state.length0 && 1.0f < layers;
    bool second = some && 0.0f < state.length1 && 2.0f < layers;
    bool third = some && 0.0f < state.length2 && 3.0f < layers;
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
static inline float layer_of(float middle, gnomon_layer_cuts cuts)
{
    float known = gnomon_select(-1.0f * gnomon_layer_depth_limit <= middle, 0.0f, -1.0f);
    float first = gnomon_select(cuts.c0 <= middle, 1.0f, 0.0f);
    float second = gnomon_select(cuts.c1 <= middle, 1.0f, 0.0f);
    float third = gnomon_select(cuts.c2 <= middle, 1.0f, 0.0f);
    float behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0f, 0.0f);
    return (known + first) + ((second + third) + behind);
}

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
typedef struct gnomon_layer_motion_sums gnomon_layer_motion_sums;
struct gnomon_layer_motion_sums
{
    float first_x, first_y, first_z, x, y, z, square, square_z, count;
    float least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
typedef struct gnomon_layer_motion gnomon_layer_motion;
struct gnomon_layer_motion { float d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
static inline gnomon_layer_motion_sums layer_motion_begin(stochastic_sample first)
{
    float limit = gnomon_texel_limit;
    gnomon_layer_motion_sums r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0f);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0f);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0f);
    r.x = 0.0f;
    r.y = 0.0f;
    r.z = 0.0f;
    r.square = 0.0f;
    r.square_z = 0.0f;
    r.count = 0.0f;
    r.least = limit;
    r.greatest = -1.0f * limit;
    r.least_d = limit;
    r.greatest_d = -1.0f * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
static inline bool gnomon_layer_motion_is_known(stochastic_sample s, float middle)
{
    float length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
static inline gnomon_layer_motion_sums layer_motion_add(gnomon_layer_motion_sums state, stochastic_sample s,
                                                        float middle)
{
    bool known = gnomon_layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.first_x, 0.0f);
    float y = gnomon_select(known, s.d_y - state.first_y, 0.0f);
    float z = gnomon_select(known, s.d_z - state.first_z, 0.0f);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0f, 0.0f);
    float moved = s.z + (0.5f - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
static inline gnomon_layer_motion layer_motion_end(gnomon_layer_motion_sums state)
{
    float share = 1.0f / gnomon_max(state.count, 1.0f);
    float x = state.x * share;
    float y = state.y * share;
    float z = state.z * share;
    bool some = 0.0f < state.count;
    gnomon_layer_motion r;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0f);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0f);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0f);
    r.spread = gnomon_sqrt(gnomon_max(0.0f, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0f, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    float off = 0.5f * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0f);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0f);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
typedef struct layer_grid layer_grid;
struct layer_grid
{
    float axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

__constant float gnomon_layer_least_motion = 0.00000095367431640625f; // 2^-20 texels: shorter motions have no direction
// 2^-10: no layer is stretched as if it were thinner
__constant float gnomon_layer_least_depths = 0.0009765625f;

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
static inline layer_grid layer_grid_make(gnomon_layer_motion mean, float guard, float texels)
{
    float chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    bool moves = gnomon_layer_least_motion <= chord;
    layer_grid g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0f);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0f);
    g.motion = gnomon_select(moves, chord, 0.0f);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5f * texels;
    g.centre = 0.5f * (mean.least + mean.greatest);
    g.scale = 2.0f / gnomon_max(gnomon_layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
typedef struct gnomon_layer_place gnomon_layer_place;
struct gnomon_layer_place { float u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
static inline gnomon_layer_place gnomon_layer_grid_turned(layer_grid grid, float x, float y)
{
    gnomon_layer_place r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
static inline gnomon_layer_place layer_grid_place(layer_grid grid, float x, float y, float t)
{
    gnomon_layer_place turned = gnomon_layer_grid_turned(grid, x, y);
    gnomon_layer_place r;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5f - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
static inline float layer_place_is_inside(layer_grid grid, gnomon_layer_place place)
{
    float texels = 2.0f * grid.middle;
    bool begun = 0.0f <= place.u && 0.0f <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0f, 0.0f);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
static inline float layer_grid_depth(layer_grid grid, float z, float t) { return z + (0.5f - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
static inline float layer_grid_own_depth(layer_grid grid, float z, float t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

#endif

#endif
