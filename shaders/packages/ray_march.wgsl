// Gnomon 0.1.0, ray_march.wgsl: shadow filtering in WGSL, this file alone.
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

// comparators/ray_march.h ---------------------------------------------------------------------------------------------
// Single scattering by ray marching through a shadow map (Toth & Umenhoffer 2009), with which prefiltered single
// scattering (Peters et al. 2017, Sec. 5) is compared: the view ray is cut into steps of equal length, and each step
// looks up the map once.
//
//     march = ray_march_begin(transmittance);                   of one step, exp(-sigma_t Delta)
//     march = ray_march_add(march, z, z_f);                     for every step, from the camera on
//     intensity = ray_march_end(march);
//
// Step k is looked up at (k + jitter) Delta, where z is the depth of the map there and z_f that of the ray. A jitter
// that differs between neighbouring pixels makes noise of what would be bands: ray_march_jitter.
//
// Light scattered in step k is proportional to what the air transmits on the way from its begin, and a factor that all
// steps share cancels in the mean. So the weights are exact, for any extinction; the sample within a step is not.

/// The weight in shadow so far, that of all steps so far, the transmittance up to the next step, and that of one step.
struct ray_march { shadowed: f32, weight: f32, transmittance: f32, step: f32 }

/// The state before the first step.
/// Domain: any transmittance of one step, limited to [0, 1].
/// NaN: 1, clear air.
fn ray_march_begin(step_transmittance: f32) -> ray_march
{
    var r: ray_march;
    r.shadowed = 0.0;
    r.weight = 0.0;
    r.transmittance = 1.0;
    r.step = clamp_or_high(step_transmittance, 0.0, 1.0);
    return r;
}

/// The state after one more step, at depth z_f, where the shadow map has depth z.
/// Domain: any depths.
/// NaN: lit, for either.
fn ray_march_add(given_state: ray_march, z: f32, z_f: f32) -> ray_march
{
    var state = given_state;
    state.shadowed = state.shadowed + gnomon_select(z < z_f, state.transmittance, 0.0);
    state.weight = state.weight + state.transmittance;
    state.transmittance = state.transmittance * state.step;
    return state;
}

/// Shadow intensity of the ray in [0, 1]: the part of the light scattered towards the camera that the shadow takes
/// away.
/// NaN: 0, lit; so before the first step.
/// Error: of n steps, 3 n 2^-p, for sums in the precision of p bits.
/// Source: Peters 2017, Sec. 5.5.1; Toth & Umenhoffer 2009
fn ray_march_end(state: ray_march) -> f32 { return saturate_or_zero(state.shadowed / state.weight); }

const ray_march_jitter_x: f32 = 0x1.12e286p-4; // 0.06711056
const ray_march_jitter_y: f32 = 0x1.7e8b2p-8; // 0.00583715
const ray_march_jitter_scale: f32 = 0x1.a7dd04p+5; // 52.9829189

/// x - floor(x), in [0, 1).
/// Domain: |x| <= 2^21.
fn gnomon_ray_march_fraction(x: f32) -> f32
{
    let fraction = x - nearest_integer(x - 0.5);
    return gnomon_select(0.0 <= fraction && fraction < 1.0, fraction, 0.0); // also where nothing is rounded
}

/// A number in [0, 1) for the pixel at column x and row y: interleaved gradient noise, of which the values of 3 x 3
/// pixels lie evenly in [0, 1), so that a small blur removes what it leaves.
/// Domain: whole numbers, limited to [0, 65536].
/// NaN: that of column or row 65536.
/// Source: Jimenez 2014
fn ray_march_jitter(x: f32, y: f32) -> f32
{
    let column = clamp_or_high(x, 0.0, 65536.0);
    let row = clamp_or_high(y, 0.0, 65536.0);
    let inner = gnomon_ray_march_fraction(ray_march_jitter_x * column + ray_march_jitter_y * row);
    return gnomon_ray_march_fraction(ray_march_jitter_scale * inner);
}
