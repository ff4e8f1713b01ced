// Gnomon 0.1.0, depth_interval.wgsl: shadow filtering in WGSL, this file alone.
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

// soft/depth_interval.h -----------------------------------------------------------------------------------------------
// Shadow of a receiver that the least and the greatest depth of its search region decide (passes/depth_pyramid.hpp).
//
// All filter regions of a soft shadow lie in its search region. Where no depth of the search region is before the
// receiver after its least bias, none of a filter region is: the receiver is lit. Where all depths are before the
// receiver after its greatest bias, all of a filter region are: the receiver is in the umbra. Both equal exact
// percentage-closer soft shadows. Moments alone cannot say so: a mean blocker depth does not tell whether there is a
// blocker (Peters et al. 2017, Sec. 4.5).
//
// A bias that grows with the filter is least for a filter of one texel. A tilted plane then has depths before its own
// receivers in every wider search region, so that only receivers that face the light are found lit. A bias that is the
// same for all filters has no such limit.

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is
/// 0.
struct gnomon_decided_shadow { intensity: f32, decided: f32 }

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the
/// receiver towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
fn depth_interval_shadow(least: f32, greatest: f32, z_f: f32, least_bias: f32, most_bias: f32) -> gnomon_decided_shadow
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let known = least <= greatest && least_bias <= most_bias;
    let umbra = known && (greatest < z - gnomon_max(0.0, most_bias));
    let lit = known && (z - gnomon_max(0.0, least_bias) <= least);
    var r: gnomon_decided_shadow;
    r.intensity = gnomon_select(umbra, 1.0, 0.0);
    r.decided = gnomon_select(umbra || lit, 1.0, 0.0);
    return r;
}
