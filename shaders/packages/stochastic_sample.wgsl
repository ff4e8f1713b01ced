// Gnomon 0.1.0, stochastic_sample.wgsl: shadow filtering in WGSL, this file alone.
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
