// Gnomon 0.1.0, summed_area.wgsl: shadow filtering in WGSL, this file alone.
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

// soft/summed_area.h --------------------------------------------------------------------------------------------------
// Summed-area tables of the channels of a shadow map, and look-ups of any rectangle in them (Crow 1984; Peters et al.
// 2017, Sec. 4.2 to 4.4).
//
// Let P(x, y) be the sum of the channels over all texels (i, j) with i < x and j < y. The table holds P(x + 1, y + 1)
// at texel (x, y), in 32-bit unsigned integers that wrap around; P is 0 where x or y is 0. The sum over the texels from
// (x0, y0) to before (x1, y1) is a difference of four such integers, of which none that wraps does harm:
//
//     rectangle = summed_area_clip(summed_area_around(x, y, width_x, width_y), map_width, map_height, most_texels);
//
//     on the grid, 4 texels:       r = summed_area_grow(rectangle);
//                                  s = P(r.x1, r.y1) - P(r.x0, r.y1) - P(r.x1, r.y0) + P(r.x0, r.y0);    in integers
//                                  area = (r.x1 - r.x0) * (r.y1 - r.y0);
//
//     interpolated, 16 texels:     a = summed_area_split(rectangle.x0, rectangle.x1), b = the same of y0 and y1
//                                  s = the sum over both axes of width_i width_j times the sum of rectangle (i, j)
//                                  area = summed_area_width(a) * summed_area_width(b);
//
//     channel = s / (area * scale)                                        storage/moments4_summed.h and its siblings
//
// A code is the nearest whole number to scale times a channel in [0, 1]. most_texels is the most texels that a look-up
// on the grid may cover: (ceil(w_x) + 1) (ceil(w_y) + 1) for the largest rectangle. Positions are in texels, with
// centres at +0.5.

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
struct summed_area_rectangle { x0_: f32, y0_: f32, x1_: f32, y1_: f32 }

const summed_area_range: f32 = 4294967296.0; // 2^32
const summed_area_most_texels: f32 = 1048576.0; // 2^20
const summed_area_step: f32 = 5.9604644775390625e-8; // 2^-24
const summed_area_slack: f32 = 0.0009765625; // 2^-10

const summed_area_code_noise: f32 = 0x1.p-33; // 1.1641532182693481e-10, 2^-33
const summed_area_float_noise: f32 = 5.9604644775390625e-8; // 2 times 2^-25
const summed_area_least_noise: f32 = 0x1.2p-23; // 1.3411045074462891e-7, 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
fn summed_area_noise(most_texels: f32) -> f32
{
    let noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_scale(most_texels: f32) -> f32
{
    let n = clamp_or_high(most_texels, 1.0, summed_area_most_texels);
    let range = summed_area_range;
    let s = range / n;
    var whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0, 0.0);
    let sum = two_product(whole, n);
    let wraps = 0.0 <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0, summed_area_step * whole), 0.0);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_code(channel: f32, scale: f32) -> f32
{
    let p = two_product(saturate_or_zero(channel), scale);
    var code = nearest_natural(p.high);
    let rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5 < rest, 1.0, 0.0);
    return code - gnomon_select(rest < -0.5, 1.0, 0.0);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
fn summed_area_around(x: f32, y: f32, width_x: f32, width_y: f32) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = x - 0.5 * width_x;
    r.y0_ = y - 0.5 * width_y;
    r.x1_ = x + 0.5 * width_x;
    r.y1_ = y + 0.5 * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
fn gnomon_summed_area_above(x: f32) -> f32 { return -1.0 * texel_below(-1.0 * x); }

/// The begin and the end of a rectangle along one axis.
struct summed_area_interval { begin: f32, end: f32 }

/// The interval from begin to end.
fn gnomon_summed_area_interval_from(begin: f32, end: f32) -> summed_area_interval
{
    var r: summed_area_interval;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
fn gnomon_summed_area_shrink(begin: f32, end: f32, texels: f32, most: f32) -> summed_area_interval
{
    let width = most - 1.0;
    let low = 0.5 * (begin + end) - 0.5 * width;
    let large = most < texels;
    var r: summed_area_interval;
    r.begin = gnomon_select(large, low, begin);
    r.end = gnomon_select(large, low + width, end);
    return r;
}

/// The part of a rectangle that a look-up may read: clipped to the map, and if the texels that it touches are more than
/// most_texels, shrunk along both axes about its centre. A rectangle without a part in the map, or with its ends in the
/// wrong order, becomes the empty one, all 0, and look-ups in it are lit.
/// Domain: width and height whole numbers in [1, 65536]; most_texels in [4, 2^20], clamped.
/// NaN: empty.
/// Error: the ends are exact unless the rectangle shrinks.
fn summed_area_clip(rectangle: summed_area_rectangle, width: f32, height: f32,
                    most_texels: f32) -> summed_area_rectangle
{
    let limit = gnomon_texel_limit;
    let right = clamp_or_high(width, 1.0, limit);
    let bottom = clamp_or_high(height, 1.0, limit);
    let x0 = clamp_or_nan(rectangle.x0_, 0.0, right);
    let y0 = clamp_or_nan(rectangle.y0_, 0.0, bottom);
    let x1 = clamp_or_nan(rectangle.x1_, 0.0, right);
    let y1 = clamp_or_nan(rectangle.y1_, 0.0, bottom);
    let columns = gnomon_summed_area_above(x1) - texel_below(x0);
    let rows = gnomon_summed_area_above(y1) - texel_below(y0);
    let most = clamp_or_high(most_texels, 4.0, summed_area_most_texels);
    let large = most < columns * rows;
    var x = gnomon_summed_area_interval_from(x0, x1);
    var y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        let share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0));
        let least_columns = gnomon_min(columns, 2.0);
        let least_rows = gnomon_min(rows, 2.0);
        let most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                      texel_below(most / least_rows));
        let most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    let some = x0 < x1 && y0 < y1; // false for NaN
    var r: summed_area_rectangle;
    r.x0_ = gnomon_select(some, x.begin, 0.0);
    r.y0_ = gnomon_select(some, y.begin, 0.0);
    r.x1_ = gnomon_select(some, x.end, 0.0);
    r.y1_ = gnomon_select(some, y.end, 0.0);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
fn summed_area_grow(rectangle: summed_area_rectangle) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = texel_below(rectangle.x0_);
    r.y0_ = texel_below(rectangle.y0_);
    r.x1_ = gnomon_summed_area_above(rectangle.x1_);
    r.y1_ = gnomon_summed_area_above(rectangle.y1_);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
struct summed_area_parts { line0_: f32, line1_: f32, line2_: f32, line3_: f32, width0_: f32, width1_: f32,
    width2_: f32 }

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
fn summed_area_split(begin: f32, end: f32) -> summed_area_parts
{
    let first = texel_below(begin);
    let last = gnomon_max(gnomon_summed_area_above(end) - 1.0, first);
    let single = last <= first;
    var r: summed_area_parts;
    r.line0_ = first;
    r.line1_ = first + 1.0;
    r.line2_ = gnomon_max(last, r.line1_);
    r.line3_ = last + 1.0;
    r.width0_ = saturate_or_zero(gnomon_select(single, end, r.line1_) - begin);
    r.width1_ = gnomon_select(single, 0.0, 1.0);
    r.width2_ = gnomon_select(single, 0.0, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
fn summed_area_width(parts: summed_area_parts) -> f32
{
    return (parts.width0_ + parts.width1_ * (parts.line2_ - parts.line1_)) + parts.width2_;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
fn summed_area_mean(sum: f32, area: f32, scale: f32) -> f32
{
    let whole = two_product(area, scale);
    let mean = saturate_or_zero(sum / whole.high);
    let p = two_product(mean, whole.high);
    let rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}
