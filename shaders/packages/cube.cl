// Gnomon 0.1.0, cube.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_CUBE_CL
#define GNOMON_CUBE_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: cube.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: cube.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: cube.cl is not of the same version as a package before it"
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
typedef struct cube_position cube_position;
struct cube_position { float face, u, v, distance; };

/// A direction from the centre of the cube, of any length.
typedef struct cube_vector cube_vector;
struct cube_vector { float x, y, z; };

/// The face that a direction from the light points to, with the place on it. Among equal coordinates z has precedence
/// over y, and y over x.
/// Domain: any finite direction; for the zero vector the middle of face 4, at distance 0.
/// NaN: some face and some place on it.
/// Error: u and v 2 2^-p, distance none.
static inline cube_position cube_position_from_direction(float x, float y, float z)
{
    float ax = gnomon_abs(x);
    float ay = gnomon_abs(y);
    float az = gnomon_abs(z);
    bool along_z = ax <= az && ay <= az;
    bool along_y = ax <= ay && !along_z;
    float major = gnomon_select(along_z, z, gnomon_select(along_y, y, x));
    bool backward = major < 0.0f;
    float sign = gnomon_select(backward, -1.0f, 1.0f);
    float across = gnomon_select(along_z, sign * x, gnomon_select(along_y, x, -1.0f * sign * z));
    float down = gnomon_select(along_y, sign * z, -1.0f * y);
    cube_position r;
    r.distance = gnomon_abs(major);
    r.face = gnomon_select(along_z, 4.0f, gnomon_select(along_y, 2.0f, 0.0f)) + gnomon_select(backward, 1.0f, 0.0f);
    float divisor = gnomon_select(0.0f < r.distance, r.distance, 1.0f);
    r.u = clamp_or_high(0.5f * (across / divisor) + 0.5f, 0.0f, 1.0f);
    r.v = clamp_or_high(0.5f * (down / divisor) + 0.5f, 0.0f, 1.0f);
    return r;
}

/// The direction to a place on a face. Beyond an edge, by less than the face's extent, the place lies on the face
/// folded over that edge.
/// Domain: face 0, 1, ..., 5; u and v in [-1, 2].
/// NaN: NaN in a coordinate.
/// Error: 2 2^-p in each coordinate, the largest of which is 1 on the face.
static inline cube_vector cube_direction(float face, float u, float v)
{
    float s = 2.0f * u - 1.0f;
    float t = 2.0f * v - 1.0f;
    float across = clamp_or_nan(s, -1.0f, 1.0f);
    float down = clamp_or_nan(t, -1.0f, 1.0f);
    // The folded part is as far along the neighbour as the place is beyond the edge.
    float ahead = (1.0f - gnomon_abs(s - across)) - gnomon_abs(t - down);
    bool along_z = 3.5f < face;
    bool along_y = 1.5f < face && !along_z;
    bool backward = face == 1.0f || face == 3.0f || face == 5.0f;
    float sign = gnomon_select(backward, -1.0f, 1.0f);
    float up = -1.0f * down;
    cube_vector r;
    r.x = gnomon_select(along_z, sign * across, gnomon_select(along_y, across, sign * ahead));
    r.y = gnomon_select(along_y, sign * ahead, up);
    r.z = gnomon_select(along_z, sign * ahead, gnomon_select(along_y, sign * down, -1.0f * sign * across));
    return r;
}

#endif

#endif
