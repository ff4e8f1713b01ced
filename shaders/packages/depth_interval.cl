// Gnomon 0.1.0, depth_interval.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEPTH_INTERVAL_CL
#define GNOMON_DEPTH_INTERVAL_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: depth_interval.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: depth_interval.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: depth_interval.cl is not of the same version as a package before it"
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

// soft/depth_interval.h -----------------------------------------------------------------------------------------------
// Shadow of a receiver that the least and the greatest depth of its search region decide (passes/depth_pyramid.hpp).
//
// All filter regions of a soft shadow lie in its search region. Where no depth of the search region is before the
// receiver after its least bias, none of a filter region is: the receiver is lit. Where all depths are before the
// receiver after its greatest bias, all of a filter region are: the receiver is in the umbra. Both equal exact
// percentage-closer soft shadows. Moments alone cannot say so: a mean blocker depth does not tell whether there is a
// blocker (Peters et al. 2017, Sec. 4.5).
//
// A bias that grows with the filter is least for a filter of one texel. A tilted plane then has depths before its own
// receivers in every wider search region, so that only receivers that face the light are found lit. A bias that is the
// same for all filters has no such limit.
#ifndef GNOMON_SOFT_DEPTH_INTERVAL_H
#define GNOMON_SOFT_DEPTH_INTERVAL_H

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is
/// 0.
typedef struct gnomon_decided_shadow gnomon_decided_shadow;
struct gnomon_decided_shadow { float intensity, decided; };

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the
/// receiver towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
static inline gnomon_decided_shadow depth_interval_shadow(float least, float greatest, float z_f, float least_bias,
                                                          float most_bias)
{
    float z = clamp_or_nan(z_f, -1.0f, 1.0f);
    bool known = least <= greatest && least_bias <= most_bias;
    bool umbra = known && (greatest < z - gnomon_max(0.0f, most_bias));
    bool lit = known && (z - gnomon_max(0.0f, least_bias) <= least);
    gnomon_decided_shadow r;
    r.intensity = gnomon_select(umbra, 1.0f, 0.0f);
    r.decided = gnomon_select(umbra || lit, 1.0f, 0.0f);
    return r;
}

#endif

#endif
