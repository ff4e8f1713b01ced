// Summed-area tables of the channels of a shadow map, and look-ups of any rectangle in them (Crow 1984; Peters et al.
// 2017, Sec. 4.2 to 4.4).
//
// Let P(x, y) be the sum of the channels over all texels (i, j) with i < x and j < y. The table holds P(x + 1, y + 1) at
// texel (x, y), in 32-bit unsigned integers that wrap around; P is 0 where x or y is 0. The sum over the texels from (x0, y0)
// to before (x1, y1) is a difference of four such integers, of which none that wraps does harm:
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
// A code is the nearest whole number to scale times a channel in [0, 1]. most_texels is the most texels that a look-up on
// the grid may cover: (ceil(w_x) + 1) (ceil(w_y) + 1) for the largest rectangle. Positions are in texels, with centres at
// +0.5.
#ifndef GNOMON_SOFT_SUMMED_AREA_H
#define GNOMON_SOFT_SUMMED_AREA_H
#include "../numerics/round.h"
#include "../numerics/select.h"
#include "../numerics/texel_filter.h"
#include "../numerics/two_product.h"
GNOMON_NAMESPACE_BEGIN

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
GNOMON_STRUCT(summed_area_rectangle) { Real x0, y0, x1, y1; };

GNOMON_CONSTANT(summed_area_range, 4294967296.0);         // 2^32
GNOMON_CONSTANT(summed_area_most_texels, 1048576.0);      // 2^20
GNOMON_CONSTANT(summed_area_step, 5.9604644775390625e-8); // 2^-24
GNOMON_CONSTANT(summed_area_slack, 0.0009765625);         // 2^-10

GNOMON_CONSTANT(summed_area_code_noise, 1.1641532182693481e-10); // 2^-33
GNOMON_CONSTANT(summed_area_float_noise, 5.9604644775390625e-8); // 2 times 2^-25
GNOMON_CONSTANT(summed_area_least_noise, 1.3411045074462891e-7); // 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code, most_texels
/// 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the resolve of four
/// samples, nine sums with their widths, and the mean. These do not all come together: a search by climbing found what
/// keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
GNOMON_KERNEL Real summed_area_noise(Real most_texels)
{
    Real noise = GNOMON_LITERAL(summed_area_code_noise) * most_texels + GNOMON_LITERAL(summed_area_float_noise);
    return gnomon_max(noise, GNOMON_LITERAL(summed_area_least_noise));
}

/// The number that channels are multiplied by: the largest whole number S of the precision of Real for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest whole
/// number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
GNOMON_KERNEL Real summed_area_scale(Real most_texels)
{
    Real n = clamp_or_high(most_texels, Real(1), GNOMON_LITERAL(summed_area_most_texels));
    Real range = GNOMON_LITERAL(summed_area_range);
    Real s = range / n;
    Real whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, Real(1), Real(0));
    double_word sum = two_product(whole, n);
    GNOMON_MASK wraps = Real(0) <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(Real(1), GNOMON_LITERAL(summed_area_step) * whole), Real(0));
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
GNOMON_KERNEL Real summed_area_code(Real channel, GNOMON_SETTING scale)
{
    double_word p = two_product(saturate_or_zero(channel), scale);
    Real code = nearest_natural(p.high);
    Real rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(Real(0.5) < rest, Real(1), Real(0));
    return code - gnomon_select(rest < Real(-0.5), Real(1), Real(0));
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
GNOMON_KERNEL GNOMON_T(summed_area_rectangle) summed_area_around(Real x, Real y, Real width_x, Real width_y)
{
    GNOMON_T(summed_area_rectangle) r;
    r.x0 = x - Real(0.5) * width_x;
    r.y0 = y - Real(0.5) * width_y;
    r.x1 = x + Real(0.5) * width_x;
    r.y1 = y + Real(0.5) * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
GNOMON_DETAIL_KERNEL Real summed_area_above(Real x) { return Real(-1) * texel_below(Real(-1) * x); }

/// The begin and the end of a rectangle along one axis.
GNOMON_STRUCT(summed_area_interval) { Real begin, end; };

/// The interval from begin to end.
GNOMON_DETAIL_KERNEL GNOMON_T(summed_area_interval) summed_area_interval_from(Real begin, Real end)
{
    GNOMON_T(summed_area_interval) r;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
GNOMON_DETAIL_KERNEL GNOMON_T(summed_area_interval) summed_area_shrink(Real begin, Real end, Real texels, Real most)
{
    Real width = most - Real(1);
    Real low = Real(0.5) * (begin + end) - Real(0.5) * width;
    GNOMON_MASK large = most < texels;
    GNOMON_T(summed_area_interval) r;
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
GNOMON_KERNEL GNOMON_T(summed_area_rectangle) summed_area_clip(GNOMON_T(summed_area_rectangle) rectangle,
                                                               GNOMON_SETTING width, GNOMON_SETTING height,
                                                               GNOMON_SETTING most_texels)
{
    Real limit = GNOMON_LITERAL(texel_limit);
    Real right = clamp_or_high(width, Real(1), limit);
    Real bottom = clamp_or_high(height, Real(1), limit);
    Real x0 = clamp_or_nan(rectangle.x0, Real(0), right);
    Real y0 = clamp_or_nan(rectangle.y0, Real(0), bottom);
    Real x1 = clamp_or_nan(rectangle.x1, Real(0), right);
    Real y1 = clamp_or_nan(rectangle.y1, Real(0), bottom);
    Real columns = summed_area_above(x1) - texel_below(x0);
    Real rows = summed_area_above(y1) - texel_below(y0);
    Real most = clamp_or_high(most_texels, Real(4), GNOMON_LITERAL(summed_area_most_texels));
    GNOMON_MASK large = most < columns * rows;
    summed_area_interval x = summed_area_interval_from(x0, x1);
    summed_area_interval y = summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        Real share = gnomon_sqrt(gnomon_min(most / (columns * rows), Real(1)));
        Real least_columns = gnomon_min(columns, Real(2));
        Real least_rows = gnomon_min(rows, Real(2));
        Real most_columns =
            gnomon_min(gnomon_max(texel_below(share * columns + GNOMON_LITERAL(summed_area_slack)), least_columns),
                       texel_below(most / least_rows));
        Real most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = summed_area_shrink(x0, x1, columns, most_columns);
        y = summed_area_shrink(y0, y1, rows, most_rows);
    }
    GNOMON_MASK some = x0 < x1 && y0 < y1; // false for NaN
    GNOMON_T(summed_area_rectangle) r;
    r.x0 = gnomon_select(some, x.begin, Real(0));
    r.y0 = gnomon_select(some, y.begin, Real(0));
    r.x1 = gnomon_select(some, x.end, Real(0));
    r.y1 = gnomon_select(some, y.end, Real(0));
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads four
/// texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
GNOMON_KERNEL GNOMON_T(summed_area_rectangle) summed_area_grow(GNOMON_T(summed_area_rectangle) rectangle)
{
    GNOMON_T(summed_area_rectangle) r;
    r.x0 = texel_below(rectangle.x0);
    r.y0 = texel_below(rectangle.y0);
    r.x1 = summed_area_above(rectangle.x1);
    r.y1 = summed_area_above(rectangle.y1);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between lines
/// i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
GNOMON_STRUCT(summed_area_parts) { Real line0, line1, line2, line3, width0, width1, width2; };

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
GNOMON_KERNEL GNOMON_T(summed_area_parts) summed_area_split(Real begin, Real end)
{
    Real first = texel_below(begin);
    Real last = gnomon_max(summed_area_above(end) - Real(1), first);
    GNOMON_MASK single = last <= first;
    GNOMON_T(summed_area_parts) r;
    r.line0 = first;
    r.line1 = first + Real(1);
    r.line2 = gnomon_max(last, r.line1);
    r.line3 = last + Real(1);
    r.width0 = saturate_or_zero(gnomon_select(single, end, r.line1) - begin);
    r.width1 = gnomon_select(single, Real(0), Real(1));
    r.width2 = gnomon_select(single, Real(0), saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
GNOMON_KERNEL Real summed_area_width(GNOMON_T(summed_area_parts) parts)
{
    return (parts.width0 + parts.width1 * (parts.line2 - parts.line1)) + parts.width2;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
GNOMON_KERNEL Real summed_area_mean(Real sum, Real area, GNOMON_SETTING scale)
{
    double_word whole = two_product(area, scale);
    Real mean = saturate_or_zero(sum / whole.high);
    double_word p = two_product(mean, whole.high);
    Real rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

GNOMON_NAMESPACE_END
#endif
