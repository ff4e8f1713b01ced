// Gnomon 0.1.0, percentage_closer_soft.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_PERCENTAGE_CLOSER_SOFT_CL
#define GNOMON_PERCENTAGE_CLOSER_SOFT_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: percentage_closer_soft.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: percentage_closer_soft.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: percentage_closer_soft.cl is not of the same version as a package before it"
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

// comparators/percentage_closer_soft.h --------------------------------------------------------------------------------
// Percentage-closer soft shadows (Fernando 2005; Peters et al. 2017, Sec. 4.1): the mean depth of what is in front of
// the receiver, from every texel of a search region. This is what the blocker search by moments (soft/blocker.h)
// estimates.
//
//     search = percentage_closer_search_begin(z_f);
//     search = percentage_closer_search_add(search, z, weight);     for every texel of the search region, weights
// summing to 1
//     blocker = percentage_closer_search_end(search);
//     width = the width of the penumbra (soft/penumbra.h) for z_f and blocker.depth
//     intensity = percentage_closer_begin, _add, _end (filters/percentage_closer.h) over a filter region of this width
//
// An intensity of 0 or 1 of the whole search region spares the filter region.
#ifndef GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H
#define GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H

__constant float percentage_closer_search_epsilon = 1e-3f;

/// The receiver's depth, the weight in front of the receiver so far, and the sum of its weighted distances to the
/// receiver.
typedef struct percentage_closer_search percentage_closer_search;
struct percentage_closer_search { float receiver, shadowed, distance; };

/// The mean depth of the blockers, in [-1, 1] and at most z_f, and their weight in the search region, in [0, 1].
typedef struct percentage_closer_blocker percentage_closer_blocker;
struct percentage_closer_blocker { float depth, intensity; };

/// The state before the first texel of the search region. z_f has no bias.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: no blocker.
static inline percentage_closer_search percentage_closer_search_begin(float z_f)
{
    percentage_closer_search r;
    r.receiver = clamp_or_nan(z_f, -1.0f, 1.0f);
    r.shadowed = 0.0f;
    r.distance = 0.0f;
    return r;
}

/// The state after one more texel of depth z with its weight.
/// Domain: any z; below the near plane as on it.
/// NaN: a texel of depth NaN is no blocker; a weight of NaN before the receiver leaves no blocker at all.
static inline percentage_closer_search percentage_closer_search_add(percentage_closer_search state, float z,
                                                                    float weight)
{
    bool in_front = z < state.receiver;
    float distance = state.receiver - gnomon_max(z, -1.0f);
    state.shadowed = state.shadowed + gnomon_select(in_front, weight, 0.0f);
    state.distance = state.distance + gnomon_select(in_front, weight * distance, 0.0f);
    return state;
}

/// Mean depth and weight of the blockers. The mean is moved towards the receiver by a weight of 1e-3, so that few
/// blockers count for less and none leaves the receiver's own depth.
/// NaN: for z_f the far plane; for a weight before the receiver the receiver's depth, and an intensity of 0.
/// Error: that of the sums of weights and of weighted distances.
/// Source: Peters 2017, Eq. 4; Fernando 2005
static inline percentage_closer_blocker percentage_closer_search_end(percentage_closer_search state)
{
    float weight = state.shadowed + percentage_closer_search_epsilon;
    float receiver = clamp_or_high(state.receiver, -1.0f, 1.0f);
    percentage_closer_blocker r;
    float depth = gnomon_max(-1.0f, gnomon_min(receiver - state.distance / weight, receiver));
    // Clang 14 makes one clamp, which lets a NaN pass, of this one and of that at the beginning.
    r.depth = gnomon_select(state.receiver == state.receiver, depth, 1.0f);
    r.intensity = saturate_or_zero(state.shadowed);
    return r;
}

#endif

#endif
