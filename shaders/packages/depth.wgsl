// Gnomon 0.1.0, depth.wgsl: shadow filtering in WGSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.

// the language --------------------------------------------------------------------------------------------------------
// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no product is fused with a sum,
// neither of which WGSL can ask for (docs/shaders.md). Exact products stay whole in any case.

const gnomon_pivot_floor: f32 = 0x1p-30;

fn gnomon_select(mask: bool, a: f32, b: f32) -> f32 { return select(b, a, mask); }
fn gnomon_any(mask: bool) -> bool { return mask; }
fn gnomon_abs(a: f32) -> f32 { return abs(a); }
fn gnomon_sqrt(a: f32) -> f32 { return sqrt(a); }
// x, but nothing is fused, cancelled or reordered across a minimum of integers. Only bits of NaN are above this bound,
// which is one.
fn gnomon_kept(x: f32) -> f32 { return bitcast<f32>(min(bitcast<i32>(x), 0x7fc00000)); }
// x by another minimum, which hides one that is kept already.
fn gnomon_apart(x: f32) -> f32 { return bitcast<f32>(min(bitcast<u32>(x), 0xffc00000u)); }
fn gnomon_min(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a < b); }
fn gnomon_max(a: f32, b: f32) -> f32 { return select(gnomon_apart(b), a, a > b); }
fn gnomon_product(a: f32, b: f32) -> f32 { return gnomon_kept(a * b); }
fn gnomon_sum(a: f32, b: f32) -> f32 { return gnomon_kept(a + b); }
fn gnomon_difference(a: f32, b: f32) -> f32 { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
fn gnomon_saturate(x: f32) -> f32 {
    let bits = bitcast<i32>(x);
    return gnomon_select(bits > 0x7f800000, 0.0, bitcast<f32>(min(max(bits, 0), 0x3f800000)));
}
// a without the low half of its significand.
fn gnomon_high_part(a: f32) -> f32 { return bitcast<f32>(bitcast<u32>(a) & 0xfffff000u); }
// The sum has n in its low bits, and the shift moves n into the exponent.
fn gnomon_power_of_two(n: f32) -> f32 { return bitcast<f32>((bitcast<u32>(n + 12582912.0) << 23u) + 0x3f800000u); }

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
fn clamp_or_nan(x: f32, low: f32, high: f32) -> f32 { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
fn clamp_or_high(x: f32, low: f32, high: f32) -> f32 { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
fn saturate_or_zero(x: f32) -> f32 { return gnomon_saturate(x); }

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

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_unit(z: f32) -> f32 { return z * 2.0 - 1.0; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_reversed(z: f32) -> f32 { return 1.0 - z * 2.0; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
fn depth_from_distance(distance_: f32, near_distance: f32, far_distance: f32) -> f32
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
fn gnomon_depth_between(n: f32, f: f32) -> f32 { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0 - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_reversed_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * (1.0 - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
fn depth_from_reversed_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = gnomon_abs(clamp_or_nan(z, 0.0, 1.0)); // -0 is the far plane, too
    let depth = (near_distance * (1.0 - x) - (far_distance * x - near_distance)) / (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0, 1.0);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
fn depth_from_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    return depth_from_reversed_infinite(1.0 - z, near_distance, far_distance);
}
