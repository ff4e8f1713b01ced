// Gnomon 0.1.0, layer_look_up.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_LOOK_UP_HLSL
#define GNOMON_LAYER_LOOK_UP_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: layer_look_up.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_look_up.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_look_up.hlsl is not of the same version as a package before it"
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
#ifndef GNOMON_FILTERS_DEPTH_BIAS_H
#define GNOMON_FILTERS_DEPTH_BIAS_H

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
float gnomon_depth_bias_limit(float bias) { return gnomon_min(2.0, gnomon_max(bias, 0.0)); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
float depth_bias_slope_scaled(float across, float along, float rise, float steepest)
{
    return gnomon_depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
struct depth_gradient { float x, y; };

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
float gnomon_depth_gradient_minor(float a, float b, float c, float d)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in
/// texels, and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
depth_gradient depth_gradient_from_derivatives(float x1, float y1, float depth1, float x2, float y2, float depth2)
{
    float determinant = gnomon_depth_gradient_minor(x1, y2, x2, y1);
    depth_gradient r;
    r.x = gnomon_depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = gnomon_depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of
/// the filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
float depth_bias_receiver_plane(depth_gradient gradient, float half_width_x, float half_width_y, float limit)
{
    float rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
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
float depth_bias_texel_plane(depth_gradient gradient, float offset_x, float offset_y, float limit, float epsilon)
{
    float behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, 0.0);
    return gnomon_depth_bias_limit(gnomon_depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

static const float gnomon_exp_log2_e = 1.4426950408889634;
static const float gnomon_exp_ln2_low = -2.1219444005469058e-4;
static const float gnomon_exp_sqrt_2 = 1.4142135623730951;
static const float gnomon_exp_sqrt_half = 0.70710678118654752;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
static const float gnomon_exp_float_0 = 0.49999993561656014;
static const float gnomon_exp_float_1 = 0.16666518908321371;
static const float gnomon_exp_float_2 = 0.041668318723256166;
static const float gnomon_exp_float_3 = 0.0083689258101569408;
static const float gnomon_exp_float_4 = 0.00138210541669496;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
static const float gnomon_log_float_0 = 0.66666776085218282;
static const float gnomon_log_float_1 = 0.39977574040563962;
static const float gnomon_log_float_2 = 0.29870936689734456;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
float gnomon_exp_remainder(float r)
{
    float p = gnomon_exp_float_0 + r *
              (gnomon_exp_float_1 + r * (gnomon_exp_float_2 + r * (gnomon_exp_float_3 + r * gnomon_exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
float polynomial_exp(float x)
{
    float low = -87.0;
    float high = 88.0;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375) - n * gnomon_exp_ln2_low;
    return (1.0 + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    gnomon_scaled_number r;
    r.significand = gnomon_select(large, s.significand * down, gnomon_select(tiny, s.significand * up, s.significand));
    r.exponent = gnomon_select(large, s.exponent + k, gnomon_select(tiny, s.exponent - k, s.exponent));
    return r;
}

/// The natural logarithm of x.
/// Domain: [2^-126, 2^127] in float, [2^-1022, 2^1023] in double; x is clamped, so that 0 and negative numbers give the
/// value at the lower end.
/// NaN: stays NaN.
/// Error: 0.9 ulp in float and in double.
/// Source: Cody & Waite 1980
float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0), gnomon_power_of_two(127.0));
    s = gnomon_scaled_number_step(s, 64.0);
    s = gnomon_scaled_number_step(s, 32.0);
    s = gnomon_scaled_number_step(s, 16.0);
    s = gnomon_scaled_number_step(s, 8.0);
    s = gnomon_scaled_number_step(s, 4.0);
    s = gnomon_scaled_number_step(s, 2.0);
    s = gnomon_scaled_number_step(s, 1.0);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5, gnomon_select(tiny, s.significand * 2.0, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0, gnomon_select(tiny, s.exponent - 1.0, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0;
    float y = f / (2.0 + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5 * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375 - ((square - rest) - f);
}

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

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

static const float gnomon_stochastic_nothing = -1.0;               // the id of the background
// 1 + 2^-21: a time is so far from the ends of its stratum
static const float gnomon_stratum_begin = 1.000000476837158203125;
static const float gnomon_stratum_end = 0.999999523162841796875;   // 1 - 2^-21

/// A sample of the background.
stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0;
    s.d_x = 0.0;
    s.d_y = 0.0;
    s.d_z = 0.0;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

#endif

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

static const float gnomon_layer_depth_limit = 2.0;      // middle depths of surfaces lie in [-2, 2]
static const float gnomon_layer_no_cut = 3.0;           // a cut behind all surfaces
static const float gnomon_layer_background_depth = 4.0; // the middle depth of the background
static const float gnomon_layer_unknown_depth = -4.0;   // the middle depth of a sample of NaN
static const float gnomon_layer_last_bin = 63.0;
static const float gnomon_layer_least_extent = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
float layer_middle_depth(stochastic_sample s)
{
    float z = s.z + (0.5 - s.t) * s.d_z;
    float limit = gnomon_layer_depth_limit;
    float inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    float size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    bool known = size <= gnomon_texel_limit;
    float middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
bool gnomon_layer_is_surface(float middle) { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { float least, greatest; };

/// The window of one sample, by its middle depth.
gnomon_layer_window layer_window_begin(float middle)
{
    bool surface = gnomon_layer_is_surface(middle);
    gnomon_layer_window w;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
gnomon_layer_window layer_window_add(gnomon_layer_window window, float middle)
{
    gnomon_layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
float layer_bin_of(float middle, gnomon_layer_window window)
{
    float share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    float bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    float least, greatest, bins, begun, empty;
    float length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
gnomon_layer_runs layer_cuts_begin(gnomon_layer_window window)
{
    gnomon_layer_runs r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0 = 0.0;
    r.length1 = 0.0;
    r.length2 = 0.0;
    r.centre0 = 0.0;
    r.centre1 = 0.0;
    r.centre2 = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
gnomon_layer_runs layer_cuts_add(gnomon_layer_runs state, float occupied)
{
    bool some = 0.0 < occupied;
    float centre = state.bins - 0.5 * state.empty;
    bool third = some && state.length2 < state.empty;
    bool second = some && state.length1 < state.empty;
    bool first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { float c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_cuts layer_cuts_end(gnomon_layer_runs state, float layers)
{
    float none = gnomon_layer_no_cut;
    float extent = state.greatest - state.least;
    bool surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    bool some = surfaces && gnomon_layer_least_extent <= extent;
    float per_bin = 0.015625 * extent;
    bool first = some && 0.0 < state.length0 && 1.0 < layers;
    bool second = some && 0.0 < state.length1 && 2.0 < layers;
    bool third = some && 0.0 < state.length2 && 3.0 < layers;
    float a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    float b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    float c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    float near_ab = gnomon_min(a, b);
    float far_ab = gnomon_max(a, b);
    float middle = gnomon_min(far_ab, c);
    gnomon_layer_cuts r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
float layer_of(float middle, gnomon_layer_cuts cuts)
{
    float known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    float first = gnomon_select(cuts.c0 <= middle, 1.0, 0.0);
    float second = gnomon_select(cuts.c1 <= middle, 1.0, 0.0);
    float third = gnomon_select(cuts.c2 <= middle, 1.0, 0.0);
    float behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct gnomon_layer_motion_sums
{
    float first_x, first_y, first_z, x, y, z, square, square_z, count;
    float least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct gnomon_layer_motion { float d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
gnomon_layer_motion_sums layer_motion_begin(stochastic_sample first)
{
    float limit = gnomon_texel_limit;
    gnomon_layer_motion_sums r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0);
    r.x = 0.0;
    r.y = 0.0;
    r.z = 0.0;
    r.square = 0.0;
    r.square_z = 0.0;
    r.count = 0.0;
    r.least = limit;
    r.greatest = -1.0 * limit;
    r.least_d = limit;
    r.greatest_d = -1.0 * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
bool gnomon_layer_motion_is_known(stochastic_sample s, float middle)
{
    float length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
gnomon_layer_motion_sums layer_motion_add(gnomon_layer_motion_sums state, stochastic_sample s, float middle)
{
    bool known = gnomon_layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.first_x, 0.0);
    float y = gnomon_select(known, s.d_y - state.first_y, 0.0);
    float z = gnomon_select(known, s.d_z - state.first_z, 0.0);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    float moved = s.z + (0.5 - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_motion layer_motion_end(gnomon_layer_motion_sums state)
{
    float share = 1.0 / gnomon_max(state.count, 1.0);
    float x = state.x * share;
    float y = state.y * share;
    float z = state.z * share;
    bool some = 0.0 < state.count;
    gnomon_layer_motion r;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0);
    r.spread = gnomon_sqrt(gnomon_max(0.0, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    float off = 0.5 * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    float axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

// 2^-20 texels: shorter motions have no direction
static const float gnomon_layer_least_motion = 0.00000095367431640625;
// 2^-10: no layer is stretched as if it were thinner
static const float gnomon_layer_least_depths = 0.0009765625;

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
layer_grid layer_grid_make(gnomon_layer_motion mean, float guard, float texels)
{
    float chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    bool moves = gnomon_layer_least_motion <= chord;
    layer_grid g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0);
    g.motion = gnomon_select(moves, chord, 0.0);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5 * texels;
    g.centre = 0.5 * (mean.least + mean.greatest);
    g.scale = 2.0 / gnomon_max(gnomon_layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
struct gnomon_layer_place { float u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
gnomon_layer_place gnomon_layer_grid_turned(layer_grid grid, float x, float y)
{
    gnomon_layer_place r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
gnomon_layer_place layer_grid_place(layer_grid grid, float x, float y, float t)
{
    gnomon_layer_place turned = gnomon_layer_grid_turned(grid, x, y);
    gnomon_layer_place r;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5 - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
float layer_place_is_inside(layer_grid grid, gnomon_layer_place place)
{
    float texels = 2.0 * grid.middle;
    bool begun = 0.0 <= place.u && 0.0 <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0, 0.0);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
float layer_grid_depth(layer_grid grid, float z, float t) { return z + (0.5 - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
float layer_grid_own_depth(layer_grid grid, float z, float t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

#endif

// motion/layers/layer_look_up.h ---------------------------------------------------------------------------------------
// Look-up in a layer's grid: the footprint of a receiver with its probes and mip level, the bias and the least variance
// that a layer needs, the filter across the motion, and blends with the neighbouring tile (Andersson et al. 2015, Sec.
// 4.2 and 5).
//
// A camera sample stands for the time t_r -+ 1/(2N), while which its world point is held in camera space. The light
// sees that point move: the ends of the footprint are its places at both times, each by the grid at its own time, so
// that what moves with the layer has a footprint of no length. The second axis is the pixel's own footprint. Probes are
// spread evenly along the longer axis, at most 16, and the mip level is that of the shorter.
//
//     ends = layer_footprint_make(grid, x0, y0, t0, x1, y1, t1, cross_x, cross_y, widening);
//     for k from 0 to ends.probes - 1: the mean of sums at layer_probe(ends, k) in level ends.level
//     bias = layer_bias(grid, slope_along, slope_across, t, reach, limit);
//     visibility by layer_visibility(sums, layer_grid_own_depth(grid, z - bias, t), layer_minimum_variance(grid, slope,
// least))
//
// Places (x, y) are in texels of the map from the tile's centre.
#ifndef GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H
#define GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H

static const float gnomon_layer_most_probes = 16.0;
static const float gnomon_layer_uniform_variance = 0.083333333333333333; // 1/12, of a time between 0 and 1
static const float gnomon_layer_tent_growth = 0.025;                     // half of 0.05 texels per texel of motion
// texels of motion from which on the tent grows
static const float gnomon_layer_tent_begin = 2.0;

/// Centre of a footprint, the vector from its one end to the other, the number of probes along that, and the mip level.
struct gnomon_layer_footprint { float u, v, along_u, along_v, probes, level; };

/// The footprint of a world point that the light sees at (x0, y0) at time t0 and at (x1, y1) at time t1. (cross_x,
/// cross_y) is the second axis, the extent of a pixel on the map. Both ends are limited to the grid. The footprint is
/// at least `widening` texels of the map wide in either direction.
/// NaN: stays NaN in the place, with one probe; a NaN in the widths counts for nothing.
/// Source: Andersson 2015, Sec. 4.2
gnomon_layer_footprint layer_footprint_make(layer_grid grid, float x0, float y0, float t0, float x1, float y1, float t1,
                                            float cross_x, float cross_y, float widening)
{
    float last = grid.middle + grid.middle - 0.5; // the centre of the last texel
    gnomon_layer_place p0 = layer_grid_place(grid, x0, y0, t0);
    gnomon_layer_place p1 = layer_grid_place(grid, x1, y1, t1);
    p0.u = clamp_or_nan(p0.u, 0.5, last);
    p0.v = clamp_or_nan(p0.v, 0.5, last);
    p1.u = clamp_or_nan(p1.u, 0.5, last);
    p1.v = clamp_or_nan(p1.v, 0.5, last);
    float time_u = p1.u - p0.u;
    float time_v = p1.v - p0.v;
    gnomon_layer_place second = gnomon_layer_grid_turned(grid, cross_x, cross_y);
    float cross_u = grid.scale_u * second.u;
    float cross_v = grid.scale_v * second.v;
    float time_length = gnomon_sqrt(time_u * time_u + time_v * time_v);
    float cross_length = gnomon_sqrt(cross_u * cross_u + cross_v * cross_v);

    // The longer axis around the middle of the ends, limited to the grid.
    bool over_time = cross_length <= time_length;
    float half_u = 0.5 * gnomon_select(over_time, time_u, cross_u);
    float half_v = 0.5 * gnomon_select(over_time, time_v, cross_v);
    float u = 0.5 * (p0.u + p1.u);
    float v = 0.5 * (p0.v + p1.v);
    float u0 = clamp_or_nan(u - half_u, 0.5, last);
    float v0 = clamp_or_nan(v - half_v, 0.5, last);
    float u1 = clamp_or_nan(u + half_u, 0.5, last);
    float v1 = clamp_or_nan(v + half_v, 0.5, last);
    gnomon_layer_footprint r;
    r.u = 0.5 * (u0 + u1);
    r.v = 0.5 * (v0 + v1);
    r.along_u = u1 - u0;
    r.along_v = v1 - v0;
    float longer = gnomon_sqrt(r.along_u * r.along_u + r.along_v * r.along_v);
    float shorter = gnomon_max(gnomon_min(cross_length, time_length), widening * grid.scale_v);
    float width = gnomon_max(gnomon_max(0.0625 * longer, shorter), 1.0); // a NaN becomes 1
    width = gnomon_min(width, grid.middle + grid.middle);
    float probes = -1.0 * texel_below(-1.0 * (longer / width)); // rounded up
    r.probes = gnomon_max(gnomon_min(probes, gnomon_layer_most_probes), 1.0);
    r.level = 0.0;
    bool coarse = 1.0 < width;
    if (gnomon_any(coarse)) {
        r.level = gnomon_select(coarse, polynomial_log(width) * gnomon_exp_log2_e, 0.0);
    }
    return r;
}

/// The place of probe k, 0 to probes - 1.
gnomon_layer_place layer_probe(gnomon_layer_footprint footprint, float k)
{
    float share = (k + 0.5) / footprint.probes - 0.5;
    gnomon_layer_place r;
    r.u = footprint.u + share * footprint.along_u;
    r.v = footprint.v + share * footprint.along_v;
    return r;
}

/// The texels of the map by which a layer's places are off at time t, since its samples move unlike: the spread of
/// motion times |1/2 - t|.
/// NaN: NaN.
float layer_widening(layer_grid grid, float t) { return grid.spread * gnomon_abs(0.5 - t); }

/// The bias in [0, 2] to subtract from a receiver's depth at time t. slope_along and slope_across are the changes of
/// depth per texel of the map along the motion and across (layer_slope), or a bound on both. reach is the distance in
/// texels of the grid from a receiver to the farthest centre of a texel that its filter reads. What of the motion is
/// not the layer's adds to this: spread_z |1/2 - t| in depth, and spread |1/2 - t| texels along the slope. limit is the
/// largest bias of a slope.
/// Domain: any; reach, limit at least 0.
/// NaN: what is NaN counts for nothing.
/// Error: 8 2^-p of the result.
float layer_bias(layer_grid grid, float slope_along, float slope_across, float t, float reach, float limit)
{
    float off = layer_widening(grid, t);
    depth_gradient gradient;
    gradient.x = slope_along;
    gradient.y = slope_across;
    float rise = depth_bias_receiver_plane(gradient, reach / grid.scale_u + off, reach / grid.scale_v + off, limit);
    return gnomon_depth_bias_limit(rise + gnomon_depth_bias_limit(grid.spread_z * gnomon_abs(0.5 - t)));
}

/// Slopes of depth along the motion of a layer and across, from its gradient along x and y of the map.
/// Error: 2 2^-p (|x| + |y|).
depth_gradient layer_slope(layer_grid grid, depth_gradient gradient)
{
    gnomon_layer_place turned = gnomon_layer_grid_turned(grid, gradient.x, gradient.y);
    depth_gradient r;
    r.x = turned.u;
    r.y = turned.v;
    return r;
}

/// The least variance of the layer's own depth, for layer_visibility: `least` of depth itself, and what the spread of
/// motion adds over the shutter interval, (spread_z^2 + (slope spread)^2) / 12. slope is the change of depth per texel
/// of the map.
/// Domain: least at least 0.
/// NaN: stays NaN.
float layer_minimum_variance(layer_grid grid, float slope, float least)
{
    float tilted = slope * grid.spread;
    float moved = gnomon_layer_uniform_variance * (grid.spread_z * grid.spread_z + tilted * tilted);
    return (least + moved) * (grid.scale * grid.scale);
}

/// Half the width of the filter across a layer's motion, in texels of its grid: of a tent of full width 0.05 (|d| - 2)
/// texels of the map, at least 0, but not wider than the guard band of (guard - tile) / 2 texels on either side.
/// NaN: 0.
/// Source: Andersson 2015, Sec. 5
float layer_tent_radius(layer_grid grid, float guard, float tile)
{
    float radius = gnomon_layer_tent_growth * (grid.motion - gnomon_layer_tent_begin);
    float band = 0.5 * (guard - tile);
    return gnomon_max(gnomon_min(radius, band) * grid.scale_v, 0.0);
}

/// The weight of a row of texels at a distance in texels under a tent of this radius, not normalised: 1 at distance 0.
/// Domain: any distance; radius at least 0. For a radius up to 1 all other rows have weight 0.
/// NaN: 0.
float layer_tent_weight(float distance, float radius)
{
    return saturate_or_zero(1.0 - gnomon_abs(distance) / gnomon_max(1.0, radius));
}

/// The neighbour of a tile along one axis, -1 or 1, and its weight, from 0 to 1/2.
struct gnomon_layer_neighbour { float towards, weight; };

/// The neighbour on the side of x, in texels of the map from the tile's centre. Its weight is 0 up to a third of the
/// way to the border, 1/2 at the border, and linear between. With weights w_x and w_y of both axes the four tiles have
/// (1 - w_x) (1 - w_y), w_x (1 - w_y), (1 - w_x) w_y and w_x w_y: a look-up in all of them by these weights has no
/// border; one chosen at random with these probabilities is the paper's.
/// Domain: tile > 0.
/// NaN: weight 0.
/// Source: Andersson 2015, Sec. 5
gnomon_layer_neighbour layer_neighbour_at(float x, float tile)
{
    gnomon_layer_neighbour r;
    r.towards = gnomon_select(x < 0.0, -1.0, 1.0);
    r.weight = 0.5 * saturate_or_zero(3.0 * (gnomon_abs(x) / tile) - 0.5);
    return r;
}

#endif

#endif
