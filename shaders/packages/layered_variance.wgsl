// Gnomon 0.1.0, layered_variance.wgsl: shadow filtering in WGSL, this file alone.
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

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { mean: f32, square: f32 }

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { minimum_variance: f32 }

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn variance_encode(z: f32) -> variance_moments
{
    var r: variance_moments;
    r.mean = clamp_or_high(z, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
fn cantelli_lower(moments: variance_moments, receiver: f32, minimum_variance: f32) -> f32
{
    let variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    let d = gnomon_max(0.0, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
fn variance_intensity(filtered: variance_moments, z_f: f32, settings: variance_settings) -> f32
{
    return cantelli_lower(filtered, gnomon_min(1.0, z_f), settings.minimum_variance);
}

// filters/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps (Lauritzen & McCool 2008, "Layered variance shadow maps", section 3): depth is cut into
// layers, and each has a variance shadow map of the depth clamped to it and stretched to [-1, 1]. Clamping keeps the
// order of depths, so that every layer bounds the shadow intensity from below, and the largest bound holds. Depths in
// front of a layer are clamped to its front: only occluders and receivers that share a layer leak light.
//
//     state = layered_variance_begin(z_f);
//     state = layered_variance_add(state, filtered, settings);      for every layer, or just for the receiver's own
//     intensity = layered_variance_end(state);

/// A layer holds depths within 1 / scale of its centre; the minimum variance is that of the stretched depth.
struct layered_variance_settings { centre: f32, scale: f32, minimum_variance: f32 }

/// The layer's own depth of a depth z, in [-1, 1].
/// Domain: any z; scale at least 0. For 0 the layer tells no depths apart; an infinite scale is a shadow test at the
/// centre. A negative scale turns the order of depths around.
/// NaN: NaN.
fn layered_variance_depth(z: f32, settings: layered_variance_settings) -> f32
{
    return clamp_or_nan((z - settings.centre) * settings.scale, -1.0, 1.0);
}

/// The layer's moments of one depth z.
/// Domain: any z.
/// NaN: the far end of the layer, which shadows nothing.
fn layered_variance_encode(z: f32, settings: layered_variance_settings) -> variance_moments
{
    // Clamp once, not by layered_variance_depth and then by variance_encode: clang 14 drops the second clamp, and a
    // NaN would stay a NaN.
    var r: variance_moments;
    r.mean = clamp_or_high((z - settings.centre) * settings.scale, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// The receiver's depth, and the largest bound so far.
struct layered_variance { receiver: f32, intensity: f32 }

/// The state before the first layer.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: lit.
fn layered_variance_begin(z_f: f32) -> layered_variance
{
    var r: layered_variance;
    r.receiver = gnomon_min(1.0, z_f);
    r.intensity = 0.0;
    return r;
}

/// The state after one more layer with its filtered moments.
/// NaN: a layer with a NaN moment, centre or scale bounds nothing.
fn layered_variance_add(given_state: layered_variance, filtered: variance_moments,
                        settings: layered_variance_settings) -> layered_variance
{
    var state = given_state;
    let receiver = layered_variance_depth(state.receiver, settings);
    state.intensity = gnomon_max(state.intensity, cantelli_lower(filtered, receiver, settings.minimum_variance));
    return state;
}

/// Shadow intensity in [0, 1], never above percentage-closer filtering but for rounding.
/// NaN: 0, lit.
/// Error: that of cantelli_lower for the layers' own depths, with r = 8 2^-p, the largest of all.
/// Source: Lauritzen & McCool 2008, Sec. 3
fn layered_variance_end(state: layered_variance) -> f32 { return saturate_or_zero(state.intensity); }

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.

struct channels1_ { c1_: f32 }

struct channels2_ { c1_: f32, c2_: f32 }

struct channels5_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32 }

// moments/channels.h, four moments ------------------------------------------------------------------------------------

struct channels4_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32 }

// moments/channels.h, six moments -------------------------------------------------------------------------------------

struct channels6_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32, c6_: f32 }

// storage/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels
// to a shadow. Four layers divide [-1, 1] evenly.
//
//   format          bytes   channels of a layer           write                             read
//   8 x 16 UNORM     16     (1 + mean) / 2, mean square   layered_variance_unorm16_encode  
// layered_variance_unorm16_intensity
//
// Where a surface passes from one layer to the next, mean and mean square are both near 1. Their roundings, three of
// half a code each, then hide a variance of up to 3 (1/2 + 2) / 65535: half a code of the square, twice one code of the
// mean.

/// Two textures of four channels.
struct channels8_ { t1_: channels4_, t2_: channels4_ }

const gnomon_layered_variance_unorm16_minimum_variance: f32 = 0x1.e001ep-14; // 0.00011444266422522316
const layered_variance_unorm16_darkening: f32 = 0x1.4f8b58p-16; // 2e-5

/// The settings of the layer around centre: -0.75, -0.25, 0.25 or 0.75.
fn gnomon_layered_variance_unorm16_layer(centre: f32) -> layered_variance_settings
{
    var settings: layered_variance_settings;
    settings.centre = centre;
    settings.scale = 4.0;
    settings.minimum_variance = gnomon_layered_variance_unorm16_minimum_variance;
    return settings;
}

/// The channels of the two layers around near_centre and far_centre for a depth z.
fn gnomon_layered_variance_unorm16_encode_two(z: f32, near_centre: f32, far_centre: f32) -> channels4_
{
    let first = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(near_centre));
    let second = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(far_centre));
    var c: channels4_;
    c.c1_ = 0.5 * first.mean + 0.5;
    c.c2_ = first.square;
    c.c3_ = 0.5 * second.mean + 0.5;
    c.c4_ = second.square;
    return c;
}

/// The eight channels of an 8 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn layered_variance_unorm16_encode(z: f32) -> channels8_
{
    var c: channels8_;
    c.t1_ = gnomon_layered_variance_unorm16_encode_two(z, -0.75, -0.25);
    c.t2_ = gnomon_layered_variance_unorm16_encode_two(z, 0.25, 0.75);
    return c;
}

/// The state after the layer around centre, whose channels are mean and square.
fn gnomon_layered_variance_unorm16_add(state: layered_variance, mean: f32, square: f32, centre: f32) -> layered_variance
{
    var b: variance_moments;
    b.mean = 2.0 * mean - 1.0;
    b.square = square;
    return layered_variance_add(state, b, gnomon_layered_variance_unorm16_layer(centre));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of an 8 x 16 UNORM texel.
/// Domain: any z_f; beyond a plane as on it.
/// NaN: 0, lit.
/// Error: as layered_variance_end, for the given channels.
fn layered_variance_unorm16_intensity(c: channels8_, z_f: f32) -> f32
{
    var state = layered_variance_begin(z_f);
    state = gnomon_layered_variance_unorm16_add(state, c.t1_.c1_, c.t1_.c2_, -0.75);
    state = gnomon_layered_variance_unorm16_add(state, c.t1_.c3_, c.t1_.c4_, -0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2_.c1_, c.t2_.c2_, 0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2_.c3_, c.t2_.c4_, 0.75);
    return layered_variance_end(state);
}
