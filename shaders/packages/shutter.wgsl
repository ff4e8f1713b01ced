// Gnomon 0.1.0, shutter.wgsl: shadow filtering in WGSL, this file alone.
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

// motion/receiver/shutter.h -------------------------------------------------------------------------------------------
// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that
// turns, a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// gnomon_shutter_exposure_make, which receivers begin with).

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { w0_: f32, w1_: f32, w2_: f32, w3_: f32, w4_: f32, w5_: f32, w6_: f32, w7_: f32 }

/// Times at which a shutter opens and closes.
struct shutter_exposure { begin: f32, end: f32 }

const gnomon_shutter_weight_limit: f32 = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
fn gnomon_shutter_exposure_make(a: f32, b: f32) -> shutter_exposure
{
    let least = 0.00000095367431640625;
    let swapped = b < a;
    let open = gnomon_select(swapped, b, a);
    let close = gnomon_select(swapped, a, b);
    let brief = close - open < least;
    let early = gnomon_select(open <= 1.0, gnomon_min(open, 1.0 - least), open);
    var r: shutter_exposure;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
fn shutter_time(begin: f32, end: f32, share: f32) -> f32 { return begin * (1.0 - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_box(t: f32, begin: f32, end: f32) -> f32 { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_tent(t: f32, begin: f32, end: f32) -> f32
{
    let x = shutter_box(t, begin, end);
    let left = 1.0 - x;
    return gnomon_select(x < 0.5, 2.0 * (x * x), 1.0 - 2.0 * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
fn gnomon_shutter_weight(w: f32) -> f32 { return gnomon_select(0.0 < w, gnomon_min(w, gnomon_shutter_weight_limit),
                                                               0.0); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
fn gnomon_shutter_share(weight: f32, sum: f32) -> f32
{
    return gnomon_select(0.0 < sum, saturate_or_zero(weight / sum), 0.125);
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
fn shutter_line(t: f32, begin: f32, end: f32, w0: f32, w1: f32) -> f32
{
    let a = gnomon_shutter_weight(w0);
    let b = gnomon_shutter_weight(w1);
    let sum = a + b;
    let x = shutter_box(t, begin, end);
    let early = gnomon_select(0.0 < sum, saturate_or_zero(a / sum), 0.5);
    return saturate_or_zero(x * (early + (early * (1.0 - x) + (1.0 - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
fn shutter_weights_make(weights: shutter_weights) -> shutter_weights
{
    var w: shutter_weights;
    w.w0_ = gnomon_shutter_weight(weights.w0_);
    w.w1_ = gnomon_shutter_weight(weights.w1_);
    w.w2_ = gnomon_shutter_weight(weights.w2_);
    w.w3_ = gnomon_shutter_weight(weights.w3_);
    w.w4_ = gnomon_shutter_weight(weights.w4_);
    w.w5_ = gnomon_shutter_weight(weights.w5_);
    w.w6_ = gnomon_shutter_weight(weights.w6_);
    w.w7_ = gnomon_shutter_weight(weights.w7_);
    let sum = ((w.w0_ + w.w1_) + (w.w2_ + w.w3_)) + ((w.w4_ + w.w5_) + (w.w6_ + w.w7_));
    w.w0_ = gnomon_shutter_share(w.w0_, sum);
    w.w1_ = gnomon_shutter_share(w.w1_, sum);
    w.w2_ = gnomon_shutter_share(w.w2_, sum);
    w.w3_ = gnomon_shutter_share(w.w3_, sum);
    w.w4_ = gnomon_shutter_share(w.w4_, sum);
    w.w5_ = gnomon_shutter_share(w.w5_, sum);
    w.w6_ = gnomon_shutter_share(w.w6_, sum);
    w.w7_ = gnomon_shutter_share(w.w7_, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_piecewise(t: f32, begin: f32, end: f32, w: shutter_weights) -> f32
{
    let x = 8.0 * shutter_box(t, begin, end);
    let early = (w.w0_ * saturate_or_zero(x) + w.w1_ * saturate_or_zero(x - 1.0)) +
                (w.w2_ * saturate_or_zero(x - 2.0) + w.w3_ * saturate_or_zero(x - 3.0));
    let late = (w.w4_ * saturate_or_zero(x - 4.0) + w.w5_ * saturate_or_zero(x - 5.0)) +
               (w.w6_ * saturate_or_zero(x - 6.0) + w.w7_ * saturate_or_zero(x - 7.0));
    return gnomon_select(x < 8.0, saturate_or_zero(early + late), 1.0);
}
