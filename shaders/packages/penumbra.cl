// Gnomon 0.1.0, penumbra.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_PENUMBRA_CL
#define GNOMON_PENUMBRA_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: penumbra.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: penumbra.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: penumbra.cl is not of the same version as a package before it"
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
#ifndef GNOMON_SOFT_PENUMBRA_H
#define GNOMON_SOFT_PENUMBRA_H

/// A width of any size clamped to [1, widest], or 1 if widest is below 1.
/// NaN: 1; a widest of NaN counts as none.
static inline float gnomon_penumbra_width(float width, float widest)
{
    return gnomon_max(gnomon_min(widest, gnomon_max(width, 1.0f)), 1.0f);
}

/// The width of the penumbra of a directional light per unit of signed depth between blocker and receiver, in texels.
/// tangent is that of half the light's angular size along this axis; depth_range is far - near, and texels_per_length
/// the number of texels per unit of length in the map.
/// Domain: at least 0.
/// NaN: NaN, for which filters are one texel wide.
/// Error: relative, 2 2^-p.
static inline float penumbra_texels_per_depth(float tangent, float depth_range, float texels_per_length)
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
static inline float penumbra_directional(float z_f, float z_b, float texels_per_depth, float widest)
{
    float receiver = clamp_or_nan(z_f, -1.0f, 1.0f);
    float blocker = clamp_or_nan(z_b, -1.0f, 1.0f);
    return gnomon_penumbra_width((receiver - blocker) * texels_per_depth, widest);
}

/// Width of the penumbra of a local light, at least one texel and at most widest: light_texels (1 / d_b - 1 / d_f) for
/// a receiver and blockers at view distances d_f and d_b. light_texels is the size of the light times the number of
/// texels per unit of length at distance 1 from the light, in the map of that axis.
/// Domain: any depths, clamped to [-1, 1]; 0 < near_distance < far_distance. Blockers behind the receiver give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 10 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
static inline float penumbra_local(float z_f, float z_b, float near_distance, float far_distance, float light_texels,
                                   float widest)
{
    float receiver = clamp_or_nan(z_f, -1.0f, 1.0f);
    float blocker = clamp_or_nan(z_b, -1.0f, 1.0f);
    float half_range = 0.5f * (far_distance - near_distance);
    float d_f = near_distance + half_range * (receiver + 1.0f);
    float d_b = near_distance + half_range * (blocker + 1.0f);
    return gnomon_penumbra_width(light_texels * ((receiver - blocker) * half_range) / (d_b * d_f), widest);
}

#endif

#endif
