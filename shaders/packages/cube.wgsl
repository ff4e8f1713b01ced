// Gnomon 0.1.0, cube.wgsl: shadow filtering in WGSL, this file alone.
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

// filters/cube.h ------------------------------------------------------------------------------------------------------
// Shadow maps of a point light on the six faces of a cube, with the faces, axes and orientations of OpenGL, Vulkan and
// Direct3D: faces 0 to 5 look along +x, -x, +y, -y, +z, -z, and texture coordinates (u, v) lie in [0, 1].
//
// Store signed depth of the distance along the face's axis, cube_position.distance, which is the largest of |x|, |y|,
// |z|, or of the distance to the light. Both are continuous over the edges of the cube, so maps may be blurred and
// looked up across them. A face unfolds over its edge: texels beyond the edge are those of the neighbour, in order, so
// that cube_direction of the centre of a texel beyond the edge leads to the centre of a texel there. A cube sampler
// reads it as it is:
//
//     direction = cube_direction(face, u + k / size, v);       tap k of a blur along u, 0 <= u <= 1
//
// A quarter around each corner of the cube is missing, and the taps that would lie there go to the edge between the two
// neighbours. Every result is a mean of texels, so bounds stay honest there, too. passes/cube.hpp has blur and look-up
// in main memory.

/// A face, texture coordinates on it, and the distance from the centre along the face's axis.
struct cube_position { face: f32, u: f32, v: f32, distance: f32 }

/// A direction from the centre of the cube, of any length.
struct cube_vector { x: f32, y: f32, z: f32 }

/// The face that a direction from the light points to, with the place on it. Among equal coordinates z has precedence
/// over y, and y over x.
/// Domain: any finite direction; for the zero vector the middle of face 4, at distance 0.
/// NaN: some face and some place on it.
/// Error: u and v 2 2^-p, distance none.
fn cube_position_from_direction(x: f32, y: f32, z: f32) -> cube_position
{
    let ax = gnomon_abs(x);
    let ay = gnomon_abs(y);
    let az = gnomon_abs(z);
    let along_z = ax <= az && ay <= az;
    let along_y = ax <= ay && !along_z;
    let major = gnomon_select(along_z, z, gnomon_select(along_y, y, x));
    let backward = major < 0.0;
    let sign = gnomon_select(backward, -1.0, 1.0);
    let across = gnomon_select(along_z, sign * x, gnomon_select(along_y, x, -1.0 * sign * z));
    let down = gnomon_select(along_y, sign * z, -1.0 * y);
    var r: cube_position;
    r.distance = gnomon_abs(major);
    r.face = gnomon_select(along_z, 4.0, gnomon_select(along_y, 2.0, 0.0)) + gnomon_select(backward, 1.0, 0.0);
    let divisor = gnomon_select(0.0 < r.distance, r.distance, 1.0);
    r.u = clamp_or_high(0.5 * (across / divisor) + 0.5, 0.0, 1.0);
    r.v = clamp_or_high(0.5 * (down / divisor) + 0.5, 0.0, 1.0);
    return r;
}

/// The direction to a place on a face. Beyond an edge, by less than the face's extent, the place lies on the face
/// folded over that edge.
/// Domain: face 0, 1, ..., 5; u and v in [-1, 2].
/// NaN: NaN in a coordinate.
/// Error: 2 2^-p in each coordinate, the largest of which is 1 on the face.
fn cube_direction(face: f32, u: f32, v: f32) -> cube_vector
{
    let s = 2.0 * u - 1.0;
    let t = 2.0 * v - 1.0;
    let across = clamp_or_nan(s, -1.0, 1.0);
    let down = clamp_or_nan(t, -1.0, 1.0);
    // The folded part is as far along the neighbour as the place is beyond the edge.
    let ahead = (1.0 - gnomon_abs(s - across)) - gnomon_abs(t - down);
    let along_z = 3.5 < face;
    let along_y = 1.5 < face && !along_z;
    let backward = face == 1.0 || face == 3.0 || face == 5.0;
    let sign = gnomon_select(backward, -1.0, 1.0);
    let up = -1.0 * down;
    var r: cube_vector;
    r.x = gnomon_select(along_z, sign * across, gnomon_select(along_y, across, sign * ahead));
    r.y = gnomon_select(along_y, sign * ahead, up);
    r.z = gnomon_select(along_z, sign * ahead, gnomon_select(along_y, sign * down, -1.0 * sign * across));
    return r;
}
