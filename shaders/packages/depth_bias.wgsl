// Gnomon 0.1.0, depth_bias.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.

/// The unevaluated sum high + low.
struct gnomon_double_word { high: f32, low: f32 }

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
fn gnomon_dekker_product_error(a: f32, b: f32, p: f32) -> f32
{
    let ah = gnomon_high_part(a);
    let bh = gnomon_high_part(b);
    let al = gnomon_difference(a, ah);
    let bl = gnomon_difference(b, bh);
    let e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
fn two_product(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
fn two_difference(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    let bv = gnomon_difference(r.high, a);
    let av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
fn two_difference_ordered(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product_ordered(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
fn subtract_product_rounded(c: f32, a: f32, b: f32) -> f32
{
    let p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
fn gnomon_double_word_minor(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word,
                            d: gnomon_double_word) -> gnomon_double_word
{
    let p = two_product(a.high, b.high);
    let q = two_product(c.high, d.high);
    var r = two_difference(p.high, q.high);
    let cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
fn gnomon_double_word_determinant(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word) -> f32
{
    let p = two_product(a.high, c.high);
    let q = two_product(b.high, b.high);
    let cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

// filters/depth_bias.h ------------------------------------------------------------------------------------------------
// The depth bias that keeps a surface from shadowing itself: subtract it from the receiver's depth before the
// intensity. A filter region holds depths of the receiver's own plane that are nearer to the light than the receiver,
// by the most that the plane rises within the half widths of the filter. Half widths are those of blur and look-up
// together, from the receiver to the centre of the farthest texel; for mip level l they are 2^l times as large. 9 taps
// and bilinear filtering have 5.5 texels.
//
//     bias = depth_bias_slope_scaled(sine, cosine, 5.5 * footprint * depth_per_texel, 5.67);       from the normal
//
//     gradient = depth_gradient_from_derivatives(...);                                             from screen space
//     bias = depth_bias_receiver_plane(gradient, half_width_x, half_width_y, limit);
//
//     intensity = variance_unorm16_intensity(channels, z_f - bias);

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
fn gnomon_depth_bias_limit(bias: f32) -> f32 { return gnomon_min(2.0, gnomon_max(bias, 0.0)); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
fn depth_bias_slope_scaled(across: f32, along: f32, rise: f32, steepest: f32) -> f32
{
    return gnomon_depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
struct depth_gradient { x: f32, y: f32 }

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
fn gnomon_depth_gradient_minor(a: f32, b: f32, c: f32, d: f32) -> f32
{
    let p = two_product(a, b);
    let q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in
/// texels, and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
fn depth_gradient_from_derivatives(x1: f32, y1: f32, depth1: f32, x2: f32, y2: f32, depth2: f32) -> depth_gradient
{
    let determinant = gnomon_depth_gradient_minor(x1, y2, x2, y1);
    var r: depth_gradient;
    r.x = gnomon_depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = gnomon_depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of
/// the filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
fn depth_bias_receiver_plane(gradient: depth_gradient, half_width_x: f32, half_width_y: f32, limit: f32) -> f32
{
    let rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
    return gnomon_depth_bias_limit(gnomon_min(limit, rise));
}

/// The adaptive depth bias in [0, 2] for a look-up of a single texel: by how much the receiver is behind its own plane
/// where the plane meets the ray through the texel's centre, at most limit, plus epsilon. offset_x and offset_y lead
/// from that centre to the receiver, in texels. For a rectangle of texels depth_bias_receiver_plane is the largest of
/// these, less epsilon, if its half widths reach to the farthest centre.
/// Domain: any; limit and epsilon at least 0.
/// NaN: epsilon; a limit of NaN counts as none, an epsilon of NaN gives 0.
/// Error: relative, 4 2^-p of |gradient.x offset_x| + |gradient.y offset_y| + epsilon.
/// Source: Dou 2014
fn depth_bias_texel_plane(gradient: depth_gradient, offset_x: f32, offset_y: f32, limit: f32, epsilon: f32) -> f32
{
    let behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, 0.0);
    return gnomon_depth_bias_limit(gnomon_depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}
