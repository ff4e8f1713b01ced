// Gnomon 0.1.0, percentage_closer.wgsl: shadow filtering in WGSL, this file alone.
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
