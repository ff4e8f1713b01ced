// Gnomon 0.1.0, summed_area.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_SUMMED_AREA_HLSL
#define GNOMON_SUMMED_AREA_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: summed_area.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: summed_area.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: summed_area.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

static const float gnomon_texel_limit = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
float gnomon_dekker_product_error(float a, float b, float p)
{
    float ah = gnomon_high_part(a);
    float bh = gnomon_high_part(b);
    float al = gnomon_difference(a, ah);
    float bl = gnomon_difference(b, bh);
    float e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
gnomon_double_word two_difference(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    float bv = gnomon_difference(r.high, a);
    float av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
                                            gnomon_double_word d)
{
    gnomon_double_word p = two_product(a.high, b.high);
    gnomon_double_word q = two_product(c.high, d.high);
    gnomon_double_word r = two_difference(p.high, q.high);
    float cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
{
    gnomon_double_word p = two_product(a.high, c.high);
    gnomon_double_word q = two_product(b.high, b.high);
    float cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

#endif

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
#ifndef GNOMON_SOFT_SUMMED_AREA_H
#define GNOMON_SOFT_SUMMED_AREA_H

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
struct summed_area_rectangle { float x0, y0, x1, y1; };

static const float summed_area_range = 4294967296.0;         // 2^32
static const float summed_area_most_texels = 1048576.0;      // 2^20
static const float summed_area_step = 5.9604644775390625e-8; // 2^-24
static const float summed_area_slack = 0.0009765625;         // 2^-10

static const float summed_area_code_noise = 1.1641532182693481e-10; // 2^-33
static const float summed_area_float_noise = 5.9604644775390625e-8; // 2 times 2^-25
static const float summed_area_least_noise = 1.3411045074462891e-7; // 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
float summed_area_noise(float most_texels)
{
    float noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
float summed_area_scale(float most_texels)
{
    float n = clamp_or_high(most_texels, 1.0, summed_area_most_texels);
    float range = summed_area_range;
    float s = range / n;
    float whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0, 0.0);
    gnomon_double_word sum = two_product(whole, n);
    bool wraps = 0.0 <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0, summed_area_step * whole), 0.0);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
float summed_area_code(float channel, float scale)
{
    gnomon_double_word p = two_product(saturate_or_zero(channel), scale);
    float code = nearest_natural(p.high);
    float rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5 < rest, 1.0, 0.0);
    return code - gnomon_select(rest < -0.5, 1.0, 0.0);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
summed_area_rectangle summed_area_around(float x, float y, float width_x, float width_y)
{
    summed_area_rectangle r;
    r.x0 = x - 0.5 * width_x;
    r.y0 = y - 0.5 * width_y;
    r.x1 = x + 0.5 * width_x;
    r.y1 = y + 0.5 * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
float gnomon_summed_area_above(float x) { return -1.0 * texel_below(-1.0 * x); }

/// The begin and the end of a rectangle along one axis.
struct summed_area_interval { float begin, end; };

/// The interval from begin to end.
summed_area_interval gnomon_summed_area_interval_from(float begin, float end)
{
    summed_area_interval r;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
summed_area_interval gnomon_summed_area_shrink(float begin, float end, float texels, float most)
{
    float width = most - 1.0;
    float low = 0.5 * (begin + end) - 0.5 * width;
    bool large = most < texels;
    summed_area_interval r;
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
summed_area_rectangle summed_area_clip(summed_area_rectangle rectangle, float width, float height, float most_texels)
{
    float limit = gnomon_texel_limit;
    float right = clamp_or_high(width, 1.0, limit);
    float bottom = clamp_or_high(height, 1.0, limit);
    float x0 = clamp_or_nan(rectangle.x0, 0.0, right);
    float y0 = clamp_or_nan(rectangle.y0, 0.0, bottom);
    float x1 = clamp_or_nan(rectangle.x1, 0.0, right);
    float y1 = clamp_or_nan(rectangle.y1, 0.0, bottom);
    float columns = gnomon_summed_area_above(x1) - texel_below(x0);
    float rows = gnomon_summed_area_above(y1) - texel_below(y0);
    float most = clamp_or_high(most_texels, 4.0, summed_area_most_texels);
    bool large = most < columns * rows;
    summed_area_interval x = gnomon_summed_area_interval_from(x0, x1);
    summed_area_interval y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        float share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0));
        float least_columns = gnomon_min(columns, 2.0);
        float least_rows = gnomon_min(rows, 2.0);
        float most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                        texel_below(most / least_rows));
        float most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    bool some = x0 < x1 && y0 < y1; // false for NaN
    summed_area_rectangle r;
    r.x0 = gnomon_select(some, x.begin, 0.0);
    r.y0 = gnomon_select(some, y.begin, 0.0);
    r.x1 = gnomon_select(some, x.end, 0.0);
    r.y1 = gnomon_select(some, y.end, 0.0);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
summed_area_rectangle summed_area_grow(summed_area_rectangle rectangle)
{
    summed_area_rectangle r;
    r.x0 = texel_below(rectangle.x0);
    r.y0 = texel_below(rectangle.y0);
    r.x1 = gnomon_summed_area_above(rectangle.x1);
    r.y1 = gnomon_summed_area_above(rectangle.y1);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
struct summed_area_parts { float line0, line1, line2, line3, width0, width1, width2; };

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
summed_area_parts summed_area_split(float begin, float end)
{
    float first = texel_below(begin);
    float last = gnomon_max(gnomon_summed_area_above(end) - 1.0, first);
    bool single = last <= first;
    summed_area_parts r;
    r.line0 = first;
    r.line1 = first + 1.0;
    r.line2 = gnomon_max(last, r.line1);
    r.line3 = last + 1.0;
    r.width0 = saturate_or_zero(gnomon_select(single, end, r.line1) - begin);
    r.width1 = gnomon_select(single, 0.0, 1.0);
    r.width2 = gnomon_select(single, 0.0, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
float summed_area_width(summed_area_parts parts)
{
    return (parts.width0 + parts.width1 * (parts.line2 - parts.line1)) + parts.width2;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
float summed_area_mean(float sum, float area, float scale)
{
    gnomon_double_word whole = two_product(area, scale);
    float mean = saturate_or_zero(sum / whole.high);
    gnomon_double_word p = two_product(mean, whole.high);
    float rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

#endif

#endif
