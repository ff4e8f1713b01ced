// Gnomon 0.1.0, time_dependent.wgsl: shadow filtering in WGSL, this file alone.
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

// filters/percentage_closer.h -----------------------------------------------------------------------------------------
// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);

/// The receiver's depth, and the weight in front of the receiver so far.
struct percentage_closer { receiver: f32, shadowed: f32 }

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
fn percentage_closer_begin(z_f: f32) -> percentage_closer
{
    var r: percentage_closer;
    r.receiver = gnomon_min(1.0, z_f);
    r.shadowed = 0.0;
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
fn percentage_closer_add(given_state: percentage_closer, z: f32, weight: f32) -> percentage_closer
{
    var state = given_state;
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, 0.0);
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
fn percentage_closer_end(state: percentage_closer) -> f32 { return saturate_or_zero(state.shadowed); }

// motion/receiver/time_dependent.h ------------------------------------------------------------------------------------
// Time-dependent shadow maps (Akenine-Moller, Munkberg & Hasselgren 2007): the shutter interval is cut into slices, and
// each slice has a shadow map whose texels have one sample each, at a time of their own within the slice. A receiver
// that is seen at time t_r reads the slice of that time, but the sample's time t is another one. In between, the
// surface that the sample shows has moved, and would shadow itself (Andersson et al. 2015, Figure 10).
//
//     sample.travel = time_dependent_travel(d_x, d_y);                         when the map is made
//     state = percentage_closer_begin(z_f - constant_bias);                    filters/percentage_closer.h
//     for the texel of the receiver, or for 2 x 2 texels by bilinear weights, in slice slice_of(t_r, slices):
//         state = percentage_closer_add(state, z, weight), where z is one of
//             sample.z                                                         constant bias alone
//             time_dependent_depth(sample, t_r)                                moved along with its surface in depth
//             time_dependent_biased_depth(sample, t_r, slope, texels)          and biased by the surface's slope
//     intensity = percentage_closer_end(state);
//
// Motion in depth is not enough for a tilted surface: in the time between, the sample moves across the map, too, and at
// its new place the surface has another depth. The third depth adds the most by which these differ.

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
struct time_dependent_sample { z: f32, t: f32, d_z: f32, travel: f32 }

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
fn time_dependent_travel(d_x: f32, d_y: f32) -> f32 { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
fn time_dependent_depth(s: time_dependent_sample, t_r: f32) -> f32 { return s.z + s.d_z * (t_r - s.t); }

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself;
/// the factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
fn time_dependent_biased_depth(s: time_dependent_sample, t_r: f32, slope: f32, texels: f32) -> f32
{
    let passed = gnomon_abs(t_r - s.t);
    let reach = texels + 1.5 * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(0.0, slope) * reach;
}
