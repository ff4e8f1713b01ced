// Gnomon 0.1.0, depth_interval.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEPTH_INTERVAL_METAL
#define GNOMON_DEPTH_INTERVAL_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: depth_interval.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: depth_interval.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: depth_interval.metal is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#if defined(__FAST_MATH__)
#error "gnomon: fast mathematics voids the treatment of NaN: compile with -fno-fast-math, or mathMode = .safe"
#endif

#include <metal_stdlib>

#if __METAL_VERSION__ >= 320 // to the end of the file
#pragma METAL fp math_mode(safe)
#endif

namespace gnomon {

constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

inline float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
inline float gnomon_abs(float a) { return metal::fabs(a); }
inline float gnomon_sqrt(float a) { return metal::precise::sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
inline float gnomon_kept(float x) { return as_type<float>(metal::min(as_type<int>(x), 0x7FC00000)); }
inline float gnomon_apart(float x) { return as_type<float>(metal::min(as_type<uint>(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
inline float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
inline float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
inline float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
inline float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
inline float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
inline float gnomon_fma(float a, float b, float c) { return gnomon_kept(metal::fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
inline float gnomon_saturate(float x)
{
    int bits = as_type<int>(x);
    return gnomon_select(bits > 0x7F800000, 0.0f, as_type<float>(metal::min(metal::max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
inline float gnomon_high_part(float a) { return as_type<float>(as_type<uint>(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
inline float gnomon_power_of_two(float n) { return as_type<float>((as_type<uint>(n + 12582912.0f) << 23) + 0x3F800000u); }

} // namespace gnomon

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

namespace gnomon {

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
inline float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
inline float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
inline float saturate_or_zero(float x) { return gnomon_saturate(x); }

} // namespace gnomon

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

namespace gnomon {

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is
/// 0.
struct decided_shadow { float intensity, decided; };

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the
/// receiver towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
inline decided_shadow depth_interval_shadow(float least, float greatest, float z_f, float least_bias, float most_bias)
{
    float z = clamp_or_nan(z_f, -1.0f, 1.0f);
    bool known = least <= greatest && least_bias <= most_bias;
    bool umbra = known && (greatest < z - gnomon_max(0.0f, most_bias));
    bool lit = known && (z - gnomon_max(0.0f, least_bias) <= least);
    decided_shadow r;
    r.intensity = gnomon_select(umbra, 1.0f, 0.0f);
    r.decided = gnomon_select(umbra || lit, 1.0f, 0.0f);
    return r;
}

} // namespace gnomon

#endif

#endif
