// Gnomon 0.1.0, depth.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEPTH_METAL
#define GNOMON_DEPTH_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: depth.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: depth.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: depth.metal is not of the same version as a package before it"
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

// moments/depth.h -----------------------------------------------------------------------------------------------------
// Signed depth from what depth buffers hold. Signed depth is -1 at the near plane, +1 at the far plane, and linear in
// the view distance: filters need the linearity, since they average depths. A perspective projection is not linear, so
// its buffer needs a conversion of its own.
//
//   buffer                                    near plane   far plane    conversion
//   view distance                             near         far          depth_from_distance
//   orthographic, or linear                   0            1            depth_from_unit
//   orthographic, or linear, reversed         1            0            depth_from_reversed
//   perspective                               0            1            depth_from_perspective
//   perspective, reversed                     1            0            depth_from_reversed_perspective
//   perspective, infinite far plane           0            (1)          depth_from_infinite
//   perspective, infinite, reversed           1            (0)          depth_from_reversed_infinite
//
// A buffer in [-1, 1], as in OpenGL, first becomes 0.5 z + 0.5.
#ifndef GNOMON_MOMENTS_DEPTH_H
#define GNOMON_MOMENTS_DEPTH_H

namespace gnomon {

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
inline float depth_from_unit(float z) { return z * 2.0f - 1.0f; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
inline float depth_from_reversed(float z) { return 1.0f - z * 2.0f; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
inline float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
inline float depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
inline float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return depth_between(near_distance * x, far_distance * (1.0f - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
inline float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return depth_between(near_distance * (1.0f - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
inline float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
{
    float x = gnomon_abs(clamp_or_nan(z, 0.0f, 1.0f)); // -0 is the far plane, too
    float depth = (near_distance * (1.0f - x) - (far_distance * x - near_distance)) /
                  (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0f, 1.0f);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
inline float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0f - z, near_distance, far_distance);
}

} // namespace gnomon

#endif

#endif
