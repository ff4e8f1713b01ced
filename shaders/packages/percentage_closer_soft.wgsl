// Gnomon 0.1.0, percentage_closer_soft.wgsl: shadow filtering in WGSL, this file alone.
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

// comparators/percentage_closer_soft.h --------------------------------------------------------------------------------
// Percentage-closer soft shadows (Fernando 2005; Peters et al. 2017, Sec. 4.1): the mean depth of what is in front of
// the receiver, from every texel of a search region. This is what the blocker search by moments (soft/blocker.h)
// estimates.
//
//     search = percentage_closer_search_begin(z_f);
//     search = percentage_closer_search_add(search, z, weight);     for every texel of the search region, weights
// summing to 1
//     blocker = percentage_closer_search_end(search);
//     width = the width of the penumbra (soft/penumbra.h) for z_f and blocker.depth
//     intensity = percentage_closer_begin, _add, _end (filters/percentage_closer.h) over a filter region of this width
//
// An intensity of 0 or 1 of the whole search region spares the filter region.

const percentage_closer_search_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The receiver's depth, the weight in front of the receiver so far, and the sum of its weighted distances to the
/// receiver.
struct percentage_closer_search { receiver: f32, shadowed: f32, distance: f32 }

/// The mean depth of the blockers, in [-1, 1] and at most z_f, and their weight in the search region, in [0, 1].
struct percentage_closer_blocker { depth: f32, intensity: f32 }

/// The state before the first texel of the search region. z_f has no bias.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: no blocker.
fn percentage_closer_search_begin(z_f: f32) -> percentage_closer_search
{
    var r: percentage_closer_search;
    r.receiver = clamp_or_nan(z_f, -1.0, 1.0);
    r.shadowed = 0.0;
    r.distance = 0.0;
    return r;
}

/// The state after one more texel of depth z with its weight.
/// Domain: any z; below the near plane as on it.
/// NaN: a texel of depth NaN is no blocker; a weight of NaN before the receiver leaves no blocker at all.
fn percentage_closer_search_add(given_state: percentage_closer_search, z: f32, weight: f32) -> percentage_closer_search
{
    var state = given_state;
    let in_front = z < state.receiver;
    let distance = state.receiver - gnomon_max(z, -1.0);
    state.shadowed = state.shadowed + gnomon_select(in_front, weight, 0.0);
    state.distance = state.distance + gnomon_select(in_front, weight * distance, 0.0);
    return state;
}

/// Mean depth and weight of the blockers. The mean is moved towards the receiver by a weight of 1e-3, so that few
/// blockers count for less and none leaves the receiver's own depth.
/// NaN: for z_f the far plane; for a weight before the receiver the receiver's depth, and an intensity of 0.
/// Error: that of the sums of weights and of weighted distances.
/// Source: Peters 2017, Eq. 4; Fernando 2005
fn percentage_closer_search_end(state: percentage_closer_search) -> percentage_closer_blocker
{
    let weight = state.shadowed + percentage_closer_search_epsilon;
    let receiver = clamp_or_high(state.receiver, -1.0, 1.0);
    var r: percentage_closer_blocker;
    let depth = gnomon_max(-1.0, gnomon_min(receiver - state.distance / weight, receiver));
    // Clang 14 makes one clamp, which lets a NaN pass, of this one and of that at the beginning.
    r.depth = gnomon_select(state.receiver == state.receiver, depth, 1.0);
    r.intensity = saturate_or_zero(state.shadowed);
    return r;
}
