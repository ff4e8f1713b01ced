// Gnomon 0.1.0, layer_grid.wgsl: shadow filtering in WGSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.

// the language --------------------------------------------------------------------------------------------------------
// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no product is fused with a sum,
// neither of which WGSL can ask for (docs/shaders.md). Exact products stay whole in any case.

const gnomon_pivot_floor: f32 = 0x1p-30;

fn gnomon_select(mask: bool, a: f32, b: f32) -> f32 { return select(b, a, mask); }
fn gnomon_any(mask: bool) -> bool { return mask; }
fn gnomon_abs(a: f32) -> f32 { return abs(a); }
fn gnomon_sqrt(a: f32) -> f32 { return sqrt(a); }
// x, but nothing is fused, cancelled or reordered across a minimum of integers. Only bits of NaN are above this bound,
// which is one.
fn gnomon_kept(x: f32) -> f32 { return bitcast<f32>(min(bitcast<i32>(x), 0x7fc00000)); }
// x by another minimum, which hides one that is kept already.
fn gnomon_apart(x: f32) -> f32 { return bitcast<f32>(min(bitcast<u32>(x), 0xffc00000u)); }
fn gnomon_min(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a < b); }
fn gnomon_max(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a > b); }
fn gnomon_product(a: f32, b: f32) -> f32 { return gnomon_kept(a * b); }
fn gnomon_sum(a: f32, b: f32) -> f32 { return gnomon_kept(a + b); }
fn gnomon_difference(a: f32, b: f32) -> f32 { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
fn gnomon_saturate(x: f32) -> f32 {
    let bits = bitcast<i32>(x);
    return gnomon_select(bits > 0x7f800000, 0.0, bitcast<f32>(min(max(bits, 0), 0x3f800000)));
}
// a without the low half of its significand.
fn gnomon_high_part(a: f32) -> f32 { return bitcast<f32>(bitcast<u32>(a) & 0xfffff000u); }
// The sum has n in its low bits, and the shift moves n into the exponent.
fn gnomon_power_of_two(n: f32) -> f32 { return bitcast<f32>((bitcast<u32>(n + 12582912.0) << 23u) + 0x3f800000u); }

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
fn nearest_integer(x: f32) -> f32
{
    let rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
fn nearest_natural(x: f32) -> f32
{
    let rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
fn clamp_or_nan(x: f32, low: f32, high: f32) -> f32 { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
fn clamp_or_high(x: f32, low: f32, high: f32) -> f32 { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
fn saturate_or_zero(x: f32) -> f32 { return gnomon_saturate(x); }

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.

const gnomon_texel_limit: f32 = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
fn texel_below(x: f32) -> f32
{
    let limit = gnomon_texel_limit;
    let inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    let whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
fn texel_weight(u: f32, i: f32, look_ups: f32) -> f32
{
    var share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { x: f32, y: f32, t: f32, z: f32, d_x: f32, d_y: f32, d_z: f32, id: f32 }

const gnomon_stochastic_nothing: f32 = -1.0; // the id of the background
const gnomon_stratum_begin: f32 = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const gnomon_stratum_end: f32 = 0.999999523162841796875; // 1 - 2^-21

/// A sample of the background.
fn stochastic_background(x: f32, y: f32, t: f32) -> stochastic_sample
{
    var s: stochastic_sample;
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
fn stratified_time(stratum: f32, count: f32, jitter: f32) -> f32
{
    var place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
fn slice_of(t: f32, count: f32) -> f32
{
    let slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

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

const gnomon_layer_depth_limit: f32 = 2.0; // middle depths of surfaces lie in [-2, 2]
const gnomon_layer_no_cut: f32 = 3.0; // a cut behind all surfaces
const gnomon_layer_background_depth: f32 = 4.0; // the middle depth of the background
const gnomon_layer_unknown_depth: f32 = -4.0; // the middle depth of a sample of NaN
const gnomon_layer_last_bin: f32 = 63.0;
const gnomon_layer_least_extent: f32 = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
fn layer_middle_depth(s: stochastic_sample) -> f32
{
    let z = s.z + (0.5 - s.t) * s.d_z;
    let limit = gnomon_layer_depth_limit;
    let inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    let size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    let known = size <= gnomon_texel_limit;
    let middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
fn gnomon_layer_is_surface(middle: f32) -> bool { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { least: f32, greatest: f32 }

/// The window of one sample, by its middle depth.
fn layer_window_begin(middle: f32) -> gnomon_layer_window
{
    let surface = gnomon_layer_is_surface(middle);
    var w: gnomon_layer_window;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
fn layer_window_add(given_window: gnomon_layer_window, middle: f32) -> gnomon_layer_window
{
    var window = given_window;
    let other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
fn layer_bin_of(middle: f32, window: gnomon_layer_window) -> f32
{
    let share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    let bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    least: f32, greatest: f32, bins: f32, begun: f32, empty: f32,
    length0_: f32,
    length1_: f32, length2_: f32, centre0_: f32, centre1_: f32, centre2_: f32,
}

/// The state before bin 0.
fn layer_cuts_begin(window: gnomon_layer_window) -> gnomon_layer_runs
{
    var r: gnomon_layer_runs;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0_ = 0.0;
    r.length1_ = 0.0;
    r.length2_ = 0.0;
    r.centre0_ = 0.0;
    r.centre1_ = 0.0;
    r.centre2_ = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
fn layer_cuts_add(given_state: gnomon_layer_runs, occupied: f32) -> gnomon_layer_runs
{
    var state = given_state;
    let some = 0.0 < occupied;
    let centre = state.bins - 0.5 * state.empty;
    let third = some && state.length2_ < state.empty;
    let second = some && state.length1_ < state.empty;
    let first = some && state.length0_ < state.empty;
    state.length2_ = gnomon_select(second, state.length1_, gnomon_select(third, state.empty, state.length2_));
    state.centre2_ = gnomon_select(second, state.centre1_, gnomon_select(third, centre, state.centre2_));
    state.length1_ = gnomon_select(first, state.length0_, gnomon_select(second, state.empty, state.length1_));
    state.centre1_ = gnomon_select(first, state.centre0_, gnomon_select(second, centre, state.centre1_));
    state.length0_ = gnomon_select(first, state.empty, state.length0_);
    state.centre0_ = gnomon_select(first, centre, state.centre0_);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { c0_: f32, c1_: f32, c2_: f32 }

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
fn layer_cuts_end(state: gnomon_layer_runs, layers: f32) -> gnomon_layer_cuts
{
    let none = gnomon_layer_no_cut;
    let extent = state.greatest - state.least;
    let surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    let some = surfaces && gnomon_layer_least_extent <= extent;
    let per_bin = 0.015625 * extent;
    let first = some && 0.0 < state.length0_ && 1.0 < layers;
    let second = some && 0.0 < state.length1_ && 2.0 < layers;
    let third = some && 0.0 < state.length2_ && 3.0 < layers;
    let a = gnomon_select(first, state.least + per_bin * state.centre0_, none);
    let b = gnomon_select(second, state.least + per_bin * state.centre1_, none);
    let c = gnomon_select(third, state.least + per_bin * state.centre2_, none);
    let near_ab = gnomon_min(a, b);
    let far_ab = gnomon_max(a, b);
    let middle = gnomon_min(far_ab, c);
    var r: gnomon_layer_cuts;
    r.c0_ = gnomon_min(near_ab, middle);
    r.c1_ = gnomon_max(near_ab, middle);
    r.c2_ = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
fn layer_of(middle: f32, cuts: gnomon_layer_cuts) -> f32
{
    let known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    let first = gnomon_select(cuts.c0_ <= middle, 1.0, 0.0);
    let second = gnomon_select(cuts.c1_ <= middle, 1.0, 0.0);
    let third = gnomon_select(cuts.c2_ <= middle, 1.0, 0.0);
    let behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

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

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct gnomon_layer_motion_sums
{
    first_x: f32, first_y: f32, first_z: f32, x: f32, y: f32, z: f32, square: f32,
    square_z: f32, count: f32,
    least: f32, greatest: f32, least_d: f32, greatest_d: f32,
}

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct gnomon_layer_motion { d_x: f32, d_y: f32, d_z: f32, spread: f32, spread_z: f32, least: f32, greatest: f32 }

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
fn layer_motion_begin(first: stochastic_sample) -> gnomon_layer_motion_sums
{
    let limit = gnomon_texel_limit;
    var r: gnomon_layer_motion_sums;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0);
    r.x = 0.0;
    r.y = 0.0;
    r.z = 0.0;
    r.square = 0.0;
    r.square_z = 0.0;
    r.count = 0.0;
    r.least = limit;
    r.greatest = -1.0 * limit;
    r.least_d = limit;
    r.greatest_d = -1.0 * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
fn gnomon_layer_motion_is_known(s: stochastic_sample, middle: f32) -> bool
{
    let length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
fn layer_motion_add(given_state: gnomon_layer_motion_sums, s: stochastic_sample,
                    middle: f32) -> gnomon_layer_motion_sums
{
    var state = given_state;
    let known = gnomon_layer_motion_is_known(s, middle);
    let x = gnomon_select(known, s.d_x - state.first_x, 0.0);
    let y = gnomon_select(known, s.d_y - state.first_y, 0.0);
    let z = gnomon_select(known, s.d_z - state.first_z, 0.0);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    let moved = s.z + (0.5 - s.t) * s.d_z;
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
fn layer_motion_end(state: gnomon_layer_motion_sums) -> gnomon_layer_motion
{
    let share = 1.0 / gnomon_max(state.count, 1.0);
    let x = state.x * share;
    let y = state.y * share;
    let z = state.z * share;
    let some = 0.0 < state.count;
    var r: gnomon_layer_motion;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0);
    r.spread = gnomon_sqrt(gnomon_max(0.0, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    let off = 0.5 * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    axis_x: f32, axis_y: f32, scale_u: f32, scale_v: f32, motion: f32, d_z: f32, middle: f32,
    centre: f32, scale: f32, spread: f32, spread_z: f32,
}

const gnomon_layer_least_motion: f32 = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
const gnomon_layer_least_depths: f32 = 0.0009765625; // 2^-10: no layer is stretched as if it were thinner

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
fn layer_grid_make(mean: gnomon_layer_motion, guard: f32, texels: f32) -> layer_grid
{
    let chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    let moves = gnomon_layer_least_motion <= chord;
    var g: layer_grid;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0);
    g.motion = gnomon_select(moves, chord, 0.0);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5 * texels;
    g.centre = 0.5 * (mean.least + mean.greatest);
    g.scale = 2.0 / gnomon_max(gnomon_layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
struct gnomon_layer_place { u: f32, v: f32 }

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
fn gnomon_layer_grid_turned(grid: layer_grid, x: f32, y: f32) -> gnomon_layer_place
{
    var r: gnomon_layer_place;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
fn layer_grid_place(grid: layer_grid, x: f32, y: f32, t: f32) -> gnomon_layer_place
{
    let turned = gnomon_layer_grid_turned(grid, x, y);
    var r: gnomon_layer_place;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5 - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
fn layer_place_is_inside(grid: layer_grid, place: gnomon_layer_place) -> f32
{
    let texels = 2.0 * grid.middle;
    let begun = 0.0 <= place.u && 0.0 <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0, 0.0);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
fn layer_grid_depth(grid: layer_grid, z: f32, t: f32) -> f32 { return z + (0.5 - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
fn layer_grid_own_depth(grid: layer_grid, z: f32, t: f32) -> f32
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}
