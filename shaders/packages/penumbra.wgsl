// Gnomon 0.1.0, penumbra.wgsl: shadow filtering in WGSL, this file alone.
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

// soft/penumbra.h -----------------------------------------------------------------------------------------------------
// Percentage-closer soft shadows (Fernando 2005): from the depth of blockers to the width of the filter that makes
// their penumbra, for lights that are rectangles aligned with the map, along one axis of the map at a time.
//
//     widest search:    width = penumbra_directional(z_f, -1, texels_per_depth, cap)           blockers at the near
// plane
//     blockers:         z_b = moments4_summed_blocker(...)                                     of the search rectangle
//     filter:           width = penumbra_directional(z_f, z_b, texels_per_depth, cap)          at least one texel
//     bias:             bias = depth_bias_receiver_plane(gradient, (width_x + 1) / 2, (width_y + 1) / 2, limit)
//     shadow:           over_darken(moments4_summed_intensity(..., z_f - bias), 1 - epsilon)
//
// and the same by penumbra_local. In the umbra, where the intensity of the search rectangle is above 1 - epsilon, the
// filter may be skipped: over_darken makes that 1 as well, so no step is seen. The paper's epsilon is 0.01. The bias is
// that of filters/depth_bias.h: the most that the receiver's plane rises within the half widths of the filter and half
// a texel, as far as the centres of texels lie that a rectangle touches; or, for look-ups of single texels,
// depth_bias_texel_plane.

/// A width of any size clamped to [1, widest], or 1 if widest is below 1.
/// NaN: 1; a widest of NaN counts as none.
fn gnomon_penumbra_width(width: f32, widest: f32) -> f32
{
    return gnomon_max(gnomon_min(widest, gnomon_max(width, 1.0)), 1.0);
}

/// The width of the penumbra of a directional light per unit of signed depth between blocker and receiver, in texels.
/// tangent is that of half the light's angular size along this axis; depth_range is far - near, and texels_per_length
/// the number of texels per unit of length in the map.
/// Domain: at least 0.
/// NaN: NaN, for which filters are one texel wide.
/// Error: relative, 2 2^-p.
fn penumbra_texels_per_depth(tangent: f32, depth_range: f32, texels_per_length: f32) -> f32
{
    return tangent * depth_range * texels_per_length;
}

/// Width of the penumbra of a directional light, at least one texel and at most widest: (z_f - z_b) texels_per_depth
/// for a receiver at depth z_f and blockers at z_b.
/// Domain: any depths, clamped to [-1, 1]; texels_per_depth by penumbra_texels_per_depth. Blockers behind the receiver
/// give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 2 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
fn penumbra_directional(z_f: f32, z_b: f32, texels_per_depth: f32, widest: f32) -> f32
{
    let receiver = clamp_or_nan(z_f, -1.0, 1.0);
    let blocker = clamp_or_nan(z_b, -1.0, 1.0);
    return gnomon_penumbra_width((receiver - blocker) * texels_per_depth, widest);
}

/// Width of the penumbra of a local light, at least one texel and at most widest: light_texels (1 / d_b - 1 / d_f) for
/// a receiver and blockers at view distances d_f and d_b. light_texels is the size of the light times the number of
/// texels per unit of length at distance 1 from the light, in the map of that axis.
/// Domain: any depths, clamped to [-1, 1]; 0 < near_distance < far_distance. Blockers behind the receiver give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 10 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
fn penumbra_local(z_f: f32, z_b: f32, near_distance: f32, far_distance: f32, light_texels: f32, widest: f32) -> f32
{
    let receiver = clamp_or_nan(z_f, -1.0, 1.0);
    let blocker = clamp_or_nan(z_b, -1.0, 1.0);
    let half_range = 0.5 * (far_distance - near_distance);
    let d_f = near_distance + half_range * (receiver + 1.0);
    let d_b = near_distance + half_range * (blocker + 1.0);
    return gnomon_penumbra_width(light_texels * ((receiver - blocker) * half_range) / (d_b * d_f), widest);
}
