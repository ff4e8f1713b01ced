// Gnomon 0.1.0, cube.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_CUBE_HLSL
#define GNOMON_CUBE_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: cube.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: cube.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: cube.hlsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

static const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return asfloat(min(asint(x), 0x7FC00000)); }
float gnomon_apart(float x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
// A compiler that knew both operands would write min() and max(), which lose a NaN. gnomon_kept would not hide an operand
// that is kept already, since two minima of integers become one; gnomon_apart is another one.
float gnomon_min(float a, float b) { return gnomon_select(a < b, a, gnomon_apart(b)); }
float gnomon_max(float a, float b) { return gnomon_select(b < a, a, gnomon_apart(b)); }
float gnomon_product(float a, float b) { return gnomon_kept(a * b); }
float gnomon_sum(float a, float b) { return gnomon_kept(a + b); }
float gnomon_difference(float a, float b) { return gnomon_kept(a - b); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
float gnomon_saturate(float x)
{
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, 0.0, asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return asfloat((asuint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
float clamp_or_nan(float x, float low, float high) { return gnomon_min(high, gnomon_max(low, x)); }

/// x clamped to [low, high].
/// NaN: high.
float clamp_or_high(float x, float low, float high) { return gnomon_max(low, gnomon_min(x, high)); }

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
float saturate_or_zero(float x) { return gnomon_saturate(x); }

#endif

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
#ifndef GNOMON_FILTERS_CUBE_H
#define GNOMON_FILTERS_CUBE_H

/// A face, texture coordinates on it, and the distance from the centre along the face's axis.
struct cube_position { float face, u, v, distance; };

/// A direction from the centre of the cube, of any length.
struct cube_vector { float x, y, z; };

/// The face that a direction from the light points to, with the place on it. Among equal coordinates z has precedence
/// over y, and y over x.
/// Domain: any finite direction; for the zero vector the middle of face 4, at distance 0.
/// NaN: some face and some place on it.
/// Error: u and v 2 2^-p, distance none.
cube_position cube_position_from_direction(float x, float y, float z)
{
    float ax = gnomon_abs(x);
    float ay = gnomon_abs(y);
    float az = gnomon_abs(z);
    bool along_z = ax <= az && ay <= az;
    bool along_y = ax <= ay && !along_z;
    float major = gnomon_select(along_z, z, gnomon_select(along_y, y, x));
    bool backward = major < 0.0;
    float sign = gnomon_select(backward, -1.0, 1.0);
    float across = gnomon_select(along_z, sign * x, gnomon_select(along_y, x, -1.0 * sign * z));
    float down = gnomon_select(along_y, sign * z, -1.0 * y);
    cube_position r;
    r.distance = gnomon_abs(major);
    r.face = gnomon_select(along_z, 4.0, gnomon_select(along_y, 2.0, 0.0)) + gnomon_select(backward, 1.0, 0.0);
    float divisor = gnomon_select(0.0 < r.distance, r.distance, 1.0);
    r.u = clamp_or_high(0.5 * (across / divisor) + 0.5, 0.0, 1.0);
    r.v = clamp_or_high(0.5 * (down / divisor) + 0.5, 0.0, 1.0);
    return r;
}

/// The direction to a place on a face. Beyond an edge, by less than the face's extent, the place lies on the face
/// folded over that edge.
/// Domain: face 0, 1, ..., 5; u and v in [-1, 2].
/// NaN: NaN in a coordinate.
/// Error: 2 2^-p in each coordinate, the largest of which is 1 on the face.
cube_vector cube_direction(float face, float u, float v)
{
    float s = 2.0 * u - 1.0;
    float t = 2.0 * v - 1.0;
    float across = clamp_or_nan(s, -1.0, 1.0);
    float down = clamp_or_nan(t, -1.0, 1.0);
    // The folded part is as far along the neighbour as the place is beyond the edge.
    float ahead = (1.0 - gnomon_abs(s - across)) - gnomon_abs(t - down);
    bool along_z = 3.5 < face;
    bool along_y = 1.5 < face && !along_z;
    bool backward = face == 1.0 || face == 3.0 || face == 5.0;
    float sign = gnomon_select(backward, -1.0, 1.0);
    float up = -1.0 * down;
    cube_vector r;
    r.x = gnomon_select(along_z, sign * across, gnomon_select(along_y, across, sign * ahead));
    r.y = gnomon_select(along_y, sign * ahead, up);
    r.z = gnomon_select(along_z, sign * ahead, gnomon_select(along_y, sign * down, -1.0 * sign * across));
    return r;
}

#endif

#endif
