// Gnomon 0.1.0, depth_bias.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEPTH_BIAS_CL
#define GNOMON_DEPTH_BIAS_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: depth_bias.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: depth_bias.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: depth_bias.cl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline float gnomon_abs(float a) { return fabs(a); }
static inline float gnomon_sqrt(float a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline float gnomon_kept(float x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline float gnomon_apart(float x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
static inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
static inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
static inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
static inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
static inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
static inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline float gnomon_saturate(float x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline float gnomon_high_part(float a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline float gnomon_power_of_two(float n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
static inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
static inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
static inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
typedef struct gnomon_double_word gnomon_double_word;
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
static inline float gnomon_dekker_product_error(float a, float b, float p)
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
static inline gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_fma(a, b, -0.0f); // kept, as gnomon_product is: two fused products read it
    r.low = gnomon_fma(a, b, -r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
static inline gnomon_double_word two_difference(float a, float b)
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
static inline gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
static inline float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
static inline gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b,
                                                          gnomon_double_word c, gnomon_double_word d)
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
static inline float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
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
static inline float gnomon_depth_bias_limit(float bias) { return gnomon_min(2.0f, gnomon_max(bias, 0.0f)); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
static inline float depth_bias_slope_scaled(float across, float along, float rise, float steepest)
{
    return gnomon_depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
typedef struct depth_gradient depth_gradient;
struct depth_gradient { float x, y; };

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
static inline float gnomon_depth_gradient_minor(float a, float b, float c, float d)
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
static inline depth_gradient depth_gradient_from_derivatives(float x1, float y1, float depth1, float x2, float y2,
                                                             float depth2)
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
static inline float depth_bias_receiver_plane(depth_gradient gradient, float half_width_x, float half_width_y,
                                              float limit)
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
static inline float depth_bias_texel_plane(depth_gradient gradient, float offset_x, float offset_y, float limit,
                                           float epsilon)
{
    float behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, 0.0f);
    return gnomon_depth_bias_limit(gnomon_depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}

#endif

#endif
