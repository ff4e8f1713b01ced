// Gnomon 0.1.0, shutter.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_SHUTTER_CL
#define GNOMON_SHUTTER_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: shutter.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: shutter.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: shutter.cl is not of the same version as a package before it"
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

// motion/receiver/shutter.h -------------------------------------------------------------------------------------------
// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that
// turns, a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// gnomon_shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
typedef struct shutter_weights shutter_weights;
struct shutter_weights { float w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
typedef struct shutter_exposure shutter_exposure;
struct shutter_exposure { float begin, end; };

__constant float gnomon_shutter_weight_limit = 1152921504606846976.0f; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
static inline shutter_exposure gnomon_shutter_exposure_make(float a, float b)
{
    float least = 0.00000095367431640625f;
    bool swapped = b < a;
    float open = gnomon_select(swapped, b, a);
    float close = gnomon_select(swapped, a, b);
    bool brief = close - open < least;
    float early = gnomon_select(open <= 1.0f, gnomon_min(open, 1.0f - least), open);
    shutter_exposure r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
static inline float shutter_time(float begin, float end, float share) { return begin * (1.0f - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
static inline float shutter_box(float t, float begin, float end)
{
    return saturate_or_zero((t - begin) / (end - begin));
}

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
static inline float shutter_tent(float t, float begin, float end)
{
    float x = shutter_box(t, begin, end);
    float left = 1.0f - x;
    return gnomon_select(x < 0.5f, 2.0f * (x * x), 1.0f - 2.0f * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
static inline float gnomon_shutter_weight(float w)
{
    return gnomon_select(0.0f < w, gnomon_min(w, gnomon_shutter_weight_limit), 0.0f);
}

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
static inline float gnomon_shutter_share(float weight, float sum)
{
    return gnomon_select(0.0f < sum, saturate_or_zero(weight / sum), 0.125f);
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
static inline float shutter_line(float t, float begin, float end, float w0, float w1)
{
    float a = gnomon_shutter_weight(w0);
    float b = gnomon_shutter_weight(w1);
    float sum = a + b;
    float x = shutter_box(t, begin, end);
    float early = gnomon_select(0.0f < sum, saturate_or_zero(a / sum), 0.5f);
    return saturate_or_zero(x * (early + (early * (1.0f - x) + (1.0f - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
static inline shutter_weights shutter_weights_make(shutter_weights weights)
{
    shutter_weights w;
    w.w0 = gnomon_shutter_weight(weights.w0);
    w.w1 = gnomon_shutter_weight(weights.w1);
    w.w2 = gnomon_shutter_weight(weights.w2);
    w.w3 = gnomon_shutter_weight(weights.w3);
    w.w4 = gnomon_shutter_weight(weights.w4);
    w.w5 = gnomon_shutter_weight(weights.w5);
    w.w6 = gnomon_shutter_weight(weights.w6);
    w.w7 = gnomon_shutter_weight(weights.w7);
    float sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = gnomon_shutter_share(w.w0, sum);
    w.w1 = gnomon_shutter_share(w.w1, sum);
    w.w2 = gnomon_shutter_share(w.w2, sum);
    w.w3 = gnomon_shutter_share(w.w3, sum);
    w.w4 = gnomon_shutter_share(w.w4, sum);
    w.w5 = gnomon_shutter_share(w.w5, sum);
    w.w6 = gnomon_shutter_share(w.w6, sum);
    w.w7 = gnomon_shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
static inline float shutter_piecewise(float t, float begin, float end, shutter_weights w)
{
    float x = 8.0f * shutter_box(t, begin, end);
    float early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - 1.0f)) +
                  (w.w2 * saturate_or_zero(x - 2.0f) + w.w3 * saturate_or_zero(x - 3.0f));
    float late = (w.w4 * saturate_or_zero(x - 4.0f) + w.w5 * saturate_or_zero(x - 5.0f)) +
                 (w.w6 * saturate_or_zero(x - 6.0f) + w.w7 * saturate_or_zero(x - 7.0f));
    return gnomon_select(x < 8.0f, saturate_or_zero(early + late), 1.0f);
}

#endif

#endif
