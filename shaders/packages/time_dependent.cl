// Gnomon 0.1.0, time_dependent.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_TIME_DEPENDENT_CL
#define GNOMON_TIME_DEPENDENT_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: time_dependent.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: time_dependent.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: time_dependent.cl is not of the same version as a package before it"
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

// filters/percentage_closer.h -----------------------------------------------------------------------------------------
// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);
#ifndef GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#define GNOMON_FILTERS_PERCENTAGE_CLOSER_H

/// The receiver's depth, and the weight in front of the receiver so far.
typedef struct percentage_closer percentage_closer;
struct percentage_closer { float receiver, shadowed; };

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
static inline percentage_closer percentage_closer_begin(float z_f)
{
    percentage_closer r;
    r.receiver = gnomon_min(1.0f, z_f);
    r.shadowed = 0.0f;
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
static inline percentage_closer percentage_closer_add(percentage_closer state, float z, float weight)
{
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, 0.0f);
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
static inline float percentage_closer_end(percentage_closer state) { return saturate_or_zero(state.shadowed); }

#endif

// motion/receiver/time_dependent.h ------------------------------------------------------------------------------------
// Time-dependent shadow maps (Akenine-Moller, Munkberg & Hasselgren 2007): the shutter interval is cut into slices, and
// each slice has a shadow map whose texels have one sample each, at a time of their own within the slice. A receiver
// that is seen at time t_r reads the slice of that time, but the sample's time t is another one. In between, the
// surface that the sample shows has moved, and would shadow itself (Andersson et al. 2015, Figure 10).
//
//     sample.travel = time_dependent_travel(d_x, d_y);                         when the map is made
//     state = percentage_closer_begin(z_f - constant_bias);                    filters/percentage_closer.h
//     for the texel of the receiver, or for 2 x 2 texels by bilinear weights, in slice slice_of(t_r, slices):
//         state = percentage_closer_add(state, z, weight), where z is one of
//             sample.z                                                         constant bias alone
//             time_dependent_depth(sample, t_r)                                moved along with its surface in depth
//             time_dependent_biased_depth(sample, t_r, slope, texels)          and biased by the surface's slope
//     intensity = percentage_closer_end(state);
//
// Motion in depth is not enough for a tilted surface: in the time between, the sample moves across the map, too, and at
// its new place the surface has another depth. The third depth adds the most by which these differ.
#ifndef GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H
#define GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
typedef struct time_dependent_sample time_dependent_sample;
struct time_dependent_sample { float z, t, d_z, travel; };

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
static inline float time_dependent_travel(float d_x, float d_y) { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
static inline float time_dependent_depth(time_dependent_sample s, float t_r) { return s.z + s.d_z * (t_r - s.t); }

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself;
/// the factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
static inline float time_dependent_biased_depth(time_dependent_sample s, float t_r, float slope, float texels)
{
    float passed = gnomon_abs(t_r - s.t);
    float reach = texels + 1.5f * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(0.0f, slope) * reach;
}

#endif

#endif
