// Gnomon 0.1.0, moments6.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_MOMENTS6_CL
#define GNOMON_MOMENTS6_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: moments6.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: moments6.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: moments6.cl is not of the same version as a package before it"
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

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

typedef struct channels1 channels1;
struct channels1 { float c1; };

typedef struct channels2 channels2;
struct channels2 { float c1, c2; };

typedef struct channels5 channels5;
struct channels5 { float c1, c2, c3, c4, c5; };

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

typedef struct channels6 channels6;
struct channels6 { float c1, c2, c3, c4, c5, c6; };

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

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
static inline float depth_from_unit(float z) { return z * 2.0f - 1.0f; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
static inline float depth_from_reversed(float z) { return 1.0f - z * 2.0f; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
static inline float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
static inline float gnomon_depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
static inline float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0f - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
static inline float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0f, 1.0f);
    return gnomon_depth_between(near_distance * (1.0f - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
static inline float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
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
static inline float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0f - z, near_distance, far_distance);
}

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

typedef struct moments6 moments6;
struct moments6 { float b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
static inline moments6 moments6_from_depth(float z)
{
    moments6 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    b.b5 = b.b4 * z;
    b.b6 = b.b3 * b.b3;
    return b;
}

/// b times weight: the first term of a linear combination.
static inline moments6 moments6_scale(moments6 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    b.b5 = b.b5 * weight;
    b.b6 = b.b6 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
static inline moments6 moments6_add(moments6 sum, moments6 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    sum.b5 = sum.b5 + b.b5 * weight;
    sum.b6 = sum.b6 + b.b6 * weight;
    return sum;
}

#endif

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_6
#define GNOMON_MOMENTS_QUANTIZATION_6

/// The moments that a format without transform holds as they are.
static inline moments6 moments6_from_channels(channels6 c)
{
    moments6 b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    b.b5 = c.c5;
    b.b6 = c.c6;
    return b;
}

/// The moments b as the channels of a format without transform.
static inline channels6 channels6_from_moments(moments6 b)
{
    channels6 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b5;
    c.c6 = b.b6;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
__constant float gnomon_theta6_21 = -1.8745771666290014f;
__constant float gnomon_theta6_23 = 4.204664766466248f;
__constant float gnomon_theta6_25 = -1.8300875998372463f;
__constant float gnomon_theta6_31 = 1.2643431422063351f;
__constant float gnomon_theta6_33 = -1.4716161665593888f;
__constant float gnomon_theta6_35 = 0.70727302435305361f;
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
__constant float gnomon_theta6_62 = -0.57735026918962573f;
__constant float gnomon_theta6_64 = 4.6188021535170058f;
__constant float gnomon_theta6_66 = -3.0792014356780042f;
__constant float gnomon_theta6_60 = 0.018874775675311862f;
__constant float gnomon_theta6_inverse11 = -0.02841260648183782f;
__constant float gnomon_theta6_inverse12 = 0.47582541301272185f;
__constant float gnomon_theta6_inverse13 = 1.552587193469116f;
__constant float gnomon_theta6_inverse31 = 0.10002244957859331f;
__constant float gnomon_theta6_inverse32 = 0.84496560893955308f;
__constant float gnomon_theta6_inverse33 = 1.0550119414818537f;
__constant float gnomon_theta6_inverse51 = 0.25890700149881596f;
__constant float gnomon_theta6_inverse52 = 0.90751156960796575f;
__constant float gnomon_theta6_inverse53 = 0.83358142889321829f;
__constant float gnomon_theta6_inverse_sixth = 0.16666666666666666f;
__constant float gnomon_theta6_inverse23 = 0.8660254037844386f;
__constant float gnomon_theta6_inverse63 = 0.81189881604791125f;

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
static inline channels6 theta6(moments6 b)
{
    channels6 c;
    c.c1 = 2.5f * b.b1 - 10.0f * b.b3 + 8.0f * b.b5 + 0.5f;
    c.c2 = gnomon_theta6_21 * b.b1 + gnomon_theta6_23 * b.b3 + gnomon_theta6_25 * b.b5 + 0.5f;
    c.c3 = gnomon_theta6_31 * b.b1 + gnomon_theta6_33 * b.b3 + gnomon_theta6_35 * b.b5 + 0.5f;
    c.c4 = 4.0f * (b.b2 - b.b4);
    c.c5 = 9.0f * b.b2 - 24.0f * b.b4 + 16.0f * b.b6;
    c.c6 = gnomon_theta6_62 * b.b2 + gnomon_theta6_64 * b.b4 + gnomon_theta6_66 * b.b6 + gnomon_theta6_60;
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
static inline moments6 theta6_inverse(channels6 c)
{
    float c1 = c.c1 - 0.5f;
    float c2 = c.c2 - 0.5f;
    float c3 = c.c3 - 0.5f;
    float c5 = gnomon_theta6_inverse_sixth * c.c5;
    float c6 = c.c6 - gnomon_theta6_60;
    moments6 b;
    b.b1 = gnomon_theta6_inverse11 * c1 + gnomon_theta6_inverse12 * c2 + gnomon_theta6_inverse13 * c3;
    b.b3 = gnomon_theta6_inverse31 * c1 + gnomon_theta6_inverse32 * c2 + gnomon_theta6_inverse33 * c3;
    b.b5 = gnomon_theta6_inverse51 * c1 + gnomon_theta6_inverse52 * c2 + gnomon_theta6_inverse53 * c3;
    b.b2 = c5 + gnomon_theta6_inverse23 * c6;
    b.b4 = (c5 + gnomon_theta6_inverse23 * c6) - 0.25f * c.c4;
    b.b6 = (0.21875f * c.c5 + gnomon_theta6_inverse63 * c6) - 0.375f * c.c4;
    return b;
}

#endif

// moments/affine.h ----------------------------------------------------------------------------------------------------
// Moments of depth in another range: a cascade, a cube face or a cached map with planes of its own. Signed depth in one
// range is an affine function of signed depth in another, and so the moments of one follow from those of the other
// (Peters et al. 2017, Eq. 2). Thus moments of two cascades can be mixed, and one reconstruction serves for both.
//
//     change = depth_change_from_planes(near_distance, far_distance, target_near, target_far);
//     b = moments4_affine(b, change);                 moments of depths z are now moments of z scale + offset
//
// Change to a range that contains the other. Then |scale| + |offset| <= 1, depths stay in [-1, 1], and what rounding
// did to moments does not grow: an error of at most e in every moment stays at most e. Towards a narrower range errors
// grow by (|scale| + |offset|)^j, and depths leave [-1, 1]: convert the receiver's depth instead, which costs no
// precision.
//
// Honest bounds need the error of raw moments, which for 4 x 16 UNORM is larger than that of channels: the constant
// bias of affine4_unorm16_weight covers one rounding of each mixed map.
#ifndef GNOMON_MOMENTS_AFFINE_H
#define GNOMON_MOMENTS_AFFINE_H

/// The function z scale + offset, from signed depth in one range to signed depth in another.
typedef struct depth_change depth_change;
struct depth_change { float scale, offset; };

/// The change from signed depth between two planes, at near_distance and far_distance from the light, to signed depth
/// between two others, at target_near and target_far. All distances are measured along the same axis, in any unit.
/// Domain: near_distance < far_distance, target_near < target_far.
/// NaN: NaN.
/// Error: 8 2^-p of the largest distance over target_far - target_near.
static inline depth_change depth_change_from_planes(float near_distance, float far_distance, float target_near,
                                                    float target_far)
{
    float extent = target_far - target_near;
    depth_change r;
    r.scale = (far_distance - near_distance) / extent;
    r.offset = ((near_distance - target_near) + (far_distance - target_far)) / extent;
    return r;
}

/// Signed depth z in the other range.
/// NaN: NaN.
/// Error: two roundings.
static inline float depth_affine(float z, depth_change change) { return z * change.scale + change.offset; }

#endif

// moments/affine.h, six moments ---------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_AFFINE_6
#define GNOMON_MOMENTS_AFFINE_6

/// The moments of z scale + offset, where b are the six moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 9 2^-p, absolute.
static inline moments6 moments6_affine(moments6 b, depth_change change)
{
    float s = change.scale;
    float o = change.offset;
    float s2 = s * s;
    float c1 = s * b.b1;
    float c2 = s2 * b.b2;
    float c3 = s2 * s * b.b3;
    float c4 = s2 * s2 * b.b4;
    float c5 = s2 * s2 * s * b.b5;
    moments6 r;
    r.b1 = c1 + o;
    r.b2 = c2 + o * (2.0f * c1 + o);
    r.b3 = c3 + o * (3.0f * c2 + o * (3.0f * c1 + o));
    r.b4 = c4 + o * (4.0f * c3 + o * (6.0f * c2 + o * (4.0f * c1 + o)));
    r.b5 = c5 + o * (5.0f * c4 + o * (10.0f * c3 + o * (10.0f * c2 + o * (5.0f * c1 + o))));
    r.b6 = s2 * s2 * s2 * b.b6 + o *
           (6.0f * c5 + o * (15.0f * c4 + o * (20.0f * c3 + o * (15.0f * c2 + o * (6.0f * c1 + o)))));
    return r;
}

#endif

// moments/bias.h ------------------------------------------------------------------------------------------------------
// Biasing: rounding in storage can turn moments into numbers that belong to no distribution, so they are moved inwards
// (Peters et al. 2017, Sec. 2.5).
//
// Let storage move the stored vector b by e, at most delta in each channel, and let r be the distance in the maximum
// norm from b* to the boundary of the valid vectors. Interpolation by alpha gives
//     (1 - alpha) (b + e) + alpha b* = (1 - alpha) b + alpha (b* + e (1 - alpha) / alpha),
// whose last term is valid from alpha = delta / (delta + r) on. The result has the moments of the mixture (1 - alpha) Z
// + alpha Z', so intensities exceed Z(z < z_f) by at most alpha. n roundings need n delta. The weight alpha is
// therefore a property of the format and of the number of roundings, not a setting.
//
// The vectors b* below have the largest r and are computed by tests/derivations. Beside them stand the paper's vectors,
// which have the largest Euclidean distance. Odd entries are 0 by symmetry.
//
// A bias is applied in one of two ways:
//   interpolated    moments4_add_bias, then hankel4_from_moments, as in the paper: for UNORM and half floats
//   kept apart      hankel4_constant_bias, the same mixture with 100 times less rounding error: for floats
// Certificates (certified4.h) leak less than a constant bias and never darken a lit surface. A bias that depends on the
// moments leaks less still, but darkens lit surfaces by up to 0.79 (docs/decisions/2-bias.md).
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
static inline float bias_weight_of_roundings(float w, float n)
{
    float nw = gnomon_max(1.0f, n) * w;
    return nw / ((1.0f - w) + nw);
}

#endif

// moments/bias.h, six moments -----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_6
#define GNOMON_MOMENTS_BIAS_6

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
__constant float bias6_raw_b2 = 0.42015374983242804f;
__constant float bias6_raw_b4 = 0.2876068288776971f;
__constant float bias6_raw_b6 = 0.25730795870391842f;

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
__constant float gnomon_bias6_theta_b2 = 0.61284694380550628f;
__constant float gnomon_bias6_theta_b4 = 0.52469968779048582f;
__constant float gnomon_bias6_theta_b6 = 0.50463026403505464f;
__constant float bias6_paper_b2 = 0.5566f;
__constant float bias6_paper_b4 = 0.489f;
__constant float bias6_paper_b6 = 0.47869382f;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
static inline moments6 moments6_add_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0f - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
}

#endif

// numerics/cubic.h ----------------------------------------------------------------------------------------------------
// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.
#ifndef GNOMON_NUMERICS_CUBIC_H
#define GNOMON_NUMERICS_CUBIC_H

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
__constant float gnomon_cubic_cosine0 = 0.50000938f;
__constant float gnomon_cubic_cosine1 = 0.57684887f;
__constant float gnomon_cubic_cosine2 = -0.10666892f;
__constant float gnomon_cubic_cosine3 = 0.03862587f;
__constant float gnomon_cubic_cosine4 = -0.00882245f;
__constant float gnomon_cubic_minus_third = -0.33333333333333331f;

/// The result of a Halley step as a fraction, whose denominator is positive.
typedef struct gnomon_cubic_step gnomon_cubic_step;
struct gnomon_cubic_step { float numerator, denominator; };

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
static inline gnomon_cubic_step gnomon_cubic_halley_step(float b, float c, float d, float t)
{
    float tb = t + b;
    float f = tb * (t * t) + (c * t + d);
    float s = (tb + (tb + t)) * t + c;
    float r = (t + t) + tb;
    float whole = s * s - f * r; // positive except at a multiple root
    bool simple = whole > 0.0f;
    gnomon_cubic_step x;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, 1.0f);
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
static inline float gnomon_cubic_halley(float b, float c, float d, float t)
{
    gnomon_cubic_step x = gnomon_cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
static inline float gnomon_cubic_start(float b, float c, float d)
{
    float mean = gnomon_cubic_minus_third * b;
    float mean2 = mean * mean;
    float spread2 = gnomon_max(mean2 + gnomon_cubic_minus_third * c, 0.0f);
    float spread = gnomon_sqrt(spread2);
    float g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    float inverse = 1.0f / spread2;
    float cosine = (g * inverse) * (spread * inverse);
    float q2 = gnomon_min(gnomon_max(0.5f + 0.25f * cosine, 0.0f), 1.0f);
    float q = gnomon_sqrt(q2);
    float start = (gnomon_cubic_cosine0 + q * gnomon_cubic_cosine1) + q2 *
                  ((gnomon_cubic_cosine2 + q * gnomon_cubic_cosine3) + q2 * gnomon_cubic_cosine4);
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
static inline gnomon_cubic_step gnomon_cubic_positive_root(float b, float c, float d)
{
    float t = gnomon_cubic_start(b, c, d);
    return gnomon_cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
static inline float cubic_largest_root(float b, float c, float d)
{
    gnomon_cubic_step x = gnomon_cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
}

#endif

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H

/// The two roots, in no particular order.
typedef struct gnomon_quadratic_result gnomon_quadratic_result;
struct gnomon_quadratic_result { float first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
static inline gnomon_quadratic_result quadratic_roots(float a, float b, float c)
{
    float r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0f));
    float t = gnomon_select(b > 0.0f, -(b + r), r - b);
    gnomon_quadratic_result x;
    x.first = t / a;
    x.second = c / t;
    return x;
}

#endif

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
typedef struct hamburger_bounds hamburger_bounds;
struct hamburger_bounds { float lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
static inline float bounds_intensity(hamburger_bounds bounds, float overestimation)
{
    return saturate_or_zero(bounds.lower + (1.0f - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
static inline float over_darken(float intensity, float strength) { return saturate_or_zero(intensity / strength); }

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
typedef struct gnomon_double_word gnomon_double_word;
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
static inline float gnomon_dekker_product_error(float a, float b, float p)
{
    float ah = gnomon_high_part(a);
    float bh = gnomon_high_part(b);
    float al = gnomon_difference(a, ah);
    float bl = gnomon_difference(b, bh);
    float e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
static inline gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_fma(a, b, -0.0f); // kept, as gnomon_product is: two fused products read it
    r.low = gnomon_fma(a, b, -r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
static inline gnomon_double_word two_difference(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    float bv = gnomon_difference(r.high, a);
    float av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
static inline gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
static inline gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
static inline float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
static inline gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b,
                                                          gnomon_double_word c, gnomon_double_word d)
{
    gnomon_double_word p = two_product(a.high, b.high);
    gnomon_double_word q = two_product(c.high, d.high);
    gnomon_double_word r = two_difference(p.high, q.high);
    float cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
static inline float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
{
    gnomon_double_word p = two_product(a.high, c.high);
    gnomon_double_word q = two_product(b.high, b.high);
    float cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

#endif

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
static inline gnomon_double_word gnomon_covariance_add_bias(gnomon_double_word c, float b_i, float b_j, float e_ij,
                                                            float e_i, float e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

#endif

// moments/hankel6.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of six moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side, for m = 6; Sec. 5.4).
//
// A step of elimination leaves the covariances c_ij = b_(i+j) - b_i b_j of (z, z^2, z^3). The next, without divisions
// (Bareiss 1968), leaves s_22 = c_11 c_22 - c_12^2, s_23 and s_33, and the last t = s_22 s_33 - s_23^2. The
// factorization L D L^T has the pivots D_1 = c_11, D_2 = s_22 / c_11 and D_3 = t / (c_11 s_22), and l21 = c_12 / c_11
// and l32 = s_23 / s_22 below the diagonal. With u = z - b1, the monic orthogonal polynomials of the distribution, for
// which D_k = E[P_k^2], follow a three-term recurrence (Gautschi 2004, Sec. 1.3):
//     P_1 = u,    P_2 = (u - (l21 - 2 b1)) P_1 - D_1,    P_3 = (u - (l32 - l21 - b1)) P_2 - (D_2 / D_1) P_1
// Every difference of moments cancels, so all are computed from exact products. A bias (bias.h) is added to the
// covariances, as double words that are kept until a pivot is complete, because added to the moments it would
// be rounded away.
//
// hamburger6.h needs D_3 K(z, z) = D_3 + (D_3 / D_1) P_1^2 + (D_3 / D_2) P_2^2 + P_3^2, whose weights are stored. The
// only quotients are 1 / D_1 and 1 / s_22, and neither waits for t.
#ifndef GNOMON_MOMENTS_HANKEL6_H
#define GNOMON_MOMENTS_HANKEL6_H

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
typedef struct hankel6 hankel6;
struct hankel6 { float mean, variance, shift2, shift3, ratio, whole, first, second; };

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
static inline hankel6 gnomon_hankel6_make(float mean, float c11, float c12, float s22, float s23, float t)
{
    hankel6 h;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, c11);
    float inverse1 = 1.0f / h.variance;
    float s = gnomon_max(gnomon_pivot_floor * h.variance, s22);
    float inverse_s = 1.0f / s;
    float l21 = c12 * inverse1;
    h.shift2 = l21 - (mean + mean);
    h.shift3 = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(gnomon_pivot_floor, (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
typedef struct gnomon_covariances6 gnomon_covariances6;
struct gnomon_covariances6 { gnomon_double_word c11, c12, c13, c22, c23, c33; };

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
static inline gnomon_covariances6 gnomon_covariances6_from_moments(moments6 b)
{
    gnomon_covariances6 c;
    c.c11 = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.c12 = subtract_product(b.b3, b.b1, b.b2);
    c.c13 = subtract_product_ordered(b.b4, b.b1, b.b3);
    c.c22 = subtract_product_ordered(b.b4, b.b2, b.b2);
    c.c23 = subtract_product(b.b5, b.b2, b.b3);
    c.c33 = subtract_product_ordered(b.b6, b.b3, b.b3);
    return c;
}

/// a b - c d as a double word, for factors whose low words may be as large as the high ones.
/// Domain: a b >= |c d| for the high words.
/// Error: in float 2^-45 of both products of the high words, and 2^-21 of the contributions of the low words.
static inline gnomon_double_word gnomon_hankel6_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
                                                      gnomon_double_word d)
{
    gnomon_double_word p = two_product(a.high, b.high);
    gnomon_double_word q = two_product(c.high, d.high);
    gnomon_double_word r = two_difference_ordered(p.high, q.high);
    float up = a.high * b.low + a.low * (b.high + b.low);
    float down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
static inline hankel6 gnomon_hankel6_factor(float mean, gnomon_covariances6 c)
{
    gnomon_double_word s22 = gnomon_hankel6_minor(c.c11, c.c22, c.c12, c.c12);
    gnomon_double_word s23 = gnomon_double_word_minor(c.c11, c.c23, c.c12, c.c13);
    gnomon_double_word s33 = gnomon_hankel6_minor(c.c11, c.c33, c.c13, c.c13);
    return gnomon_hankel6_make(mean, c.c11.high + c.c11.low, c.c12.high + c.c12.low, s22.high + s22.low, s23.high +
                               s23.low, gnomon_double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
static inline hankel6 hankel6_constant_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0f - alpha;
    float odds = alpha / keep;
    float d2 = b.b2 - bias2;
    float e1 = alpha * b.b1;
    float e2 = alpha * d2;
    float e3 = alpha * b.b3;
    gnomon_covariances6 c = gnomon_covariances6_from_moments(b);
    c.c11.low = c.c11.low + (e1 * b.b1 + odds * bias2);
    c.c12.low = c.c12.low + e1 * d2;
    c.c13.low = c.c13.low + (e1 * b.b3 + odds * bias4);
    c.c22.low = c.c22.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23.low = c.c23.low + e2 * b.b3;
    c.c33.low = c.c33.low + (e3 * b.b3 + odds * bias6);
    hankel6 h = gnomon_hankel6_factor(b.b1 - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
static inline hankel6 hankel6_from_moments(moments6 b)
{
    float c11 = b.b2 - b.b1 * b.b1;
    float c12 = b.b3 - b.b1 * b.b2;
    float c13 = b.b4 - b.b1 * b.b3;
    float s22 = c11 * (b.b4 - b.b2 * b.b2) - c12 * c12;
    float s23 = c11 * (b.b5 - b.b2 * b.b3) - c12 * c13;
    float s33 = c11 * (b.b6 - b.b3 * b.b3) - c13 * c13;
    return gnomon_hankel6_make(b.b1, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

#endif

// moments/hamburger6.h ------------------------------------------------------------------------------------------------
// Shadow intensity from six moments, by the method of hamburger4.h (Peters et al. 2017, Sec. 5.4 and Alg. 1). Surface
// shadows need four moments only. Six serve where many surfaces lie behind one another, as in single scattering.
//
// With K(x, y) = sum_k P_k(x) P_k(y) / D_k and w(z) = 1 / K(z, z), the number a of nodes above z_f is the number of
// sign changes in P_0(z_f), ..., P_3(z_f):
//     a = 0:  lower = 1 - w_f                        a = 2:  lower = w(smallest root)
//     a = 1:  lower = 1 - w_f - w(largest root)      a = 3:  lower = 0
// At most one root is needed, and that root is alone on its side of z_f. In t = 1 / (z - z_f) it is the only one of its
// sign among the roots of
//     k0 t^3 + k1 t^2 + k2 t + k3,      k0 = K(z_f, z_f) >= 1,      k_j = (d/dz)^j K(z_f, z) / j! at z_f.
// After a change of sign it is the largest of three real roots, which cubic.h finds.
#ifndef GNOMON_MOMENTS_HAMBURGER6_H
#define GNOMON_MOMENTS_HAMBURGER6_H

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
typedef struct gnomon_distribution4 gnomon_distribution4;
struct gnomon_distribution4 { float depth0, depth1, depth2, depth3, weight0, weight1, weight2, weight3; };

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
typedef struct gnomon_polynomials6 gnomon_polynomials6;
struct gnomon_polynomials6 { float p1, p2, p3; };

/// P_1, P_2 and P_3 at the depth mean + u.
static inline gnomon_polynomials6 gnomon_hamburger6_polynomials(hankel6 h, float u)
{
    gnomon_polynomials6 p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
static inline float gnomon_hamburger6_kernel(hankel6 h, gnomon_polynomials6 p)
{
    return (h.whole + h.first * (p.p1 * p.p1)) + (h.second * (p.p2 * p.p2) + p.p3 * p.p3);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
typedef struct gnomon_derivatives6 gnomon_derivatives6;
struct gnomon_derivatives6 { float slope2, slope3, bend3; };

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
static inline gnomon_derivatives6 gnomon_hamburger6_derivatives(hankel6 h, gnomon_polynomials6 p)
{
    float v = p.p1 - h.shift3;
    gnomon_derivatives6 d;
    d.slope2 = (p.p1 + p.p1) - h.shift2;
    d.slope3 = (p.p2 + v * d.slope2) - h.ratio;
    d.bend3 = d.slope2 + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
static inline gnomon_polynomials6 gnomon_hamburger6_polynomials_shift(gnomon_polynomials6 p, gnomon_derivatives6 d,
                                                                      float distance_)
{
    p.p1 = p.p1 + distance_;
    p.p2 = p.p2 + distance_ * (d.slope2 + distance_);
    p.p3 = p.p3 + distance_ * (d.slope3 + distance_ * (d.bend3 + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
typedef struct hamburger6_cubic hamburger6_cubic;
struct hamburger6_cubic { float b, c, d; };

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
static inline hamburger6_cubic gnomon_hamburger6_other_nodes(hankel6 h, gnomon_polynomials6 p, gnomon_derivatives6 d,
                                                             float inverse, float side)
{
    float q2 = h.second * p.p2;
    hamburger6_cubic r;
    r.b = inverse * (side * (h.first * p.p1 + (d.slope2 * q2 + d.slope3 * p.p3)));
    r.c = inverse * (q2 + d.bend3 * p.p3);
    r.d = inverse * (side * p.p3);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
static inline float gnomon_hamburger6_distance(float t)
{
    float least = 0.0009765625f;
    float away = gnomon_select(t < 0.0f, gnomon_min(t, -least), gnomon_max(t, least));
    return 1.0f / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
typedef struct hamburger6_sums hamburger6_sums;
struct hamburger6_sums { float lower, distance, weight; };

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
static inline hamburger6_sums gnomon_hamburger6_sums_at(hankel6 h, float u)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, u);
    float inverse = 1.0f / gnomon_hamburger6_kernel(h, p);
    bool positive1 = p.p1 > 0.0f;
    bool positive2 = p.p2 > 0.0f;
    bool positive3 = p.p3 > 0.0f;
    bool all_below = positive1 && positive2 && positive3;
    bool all_above = (!positive1) && positive2 && (!positive3);
    bool outside = all_below || all_above;
    hamburger6_sums r;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, 1.0f - r.weight, 0.0f);
    r.distance = gnomon_select(all_below, p.p1, 0.0f);
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        float side = gnomon_select(positive3, -1.0f, 1.0f);
        gnomon_derivatives6 d = gnomon_hamburger6_derivatives(h, p);
        hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, d, inverse, side);
        gnomon_cubic_step t = gnomon_cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        float away = t.denominator / gnomon_max(t.numerator, 0.0009765625f * t.denominator);
        float w = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (1.0f - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1 + w * away));
    }
    return r;
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, four depths and more: p99 1e-14, p99.9 4e-14
///     error, float, hankel6_constant_bias at 5e-6: p99 2e-5, p99.9 5e-5, max 2e-4
/// and against the kernel in double,
///     error, float, hankel6_from_float: p99 2e-5, p99.9 5e-5, max 2e-4
///     error, float, hankel6_from_float_filtered: p99 1e-5, p99.9 3e-5, max 1e-4
///     error, float, hankel6_from_unorm16: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10: p99 3e-5, p99.9 9e-5, max 8e-4
///     error, float, hankel6_from_unorm10_filtered: p99 2e-5, p99.9 5e-5, max 3e-4
/// Maxima are found by climbing and stated with a margin. Without a bias there is no maximum: if D_3 is at the floor,
/// moments rounded in double cannot resolve distances below 2^-32.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
static inline hamburger_bounds hamburger6_bounds(hankel6 h, float z_f)
{
    hamburger6_sums s = gnomon_hamburger6_sums_at(h, clamp_or_nan(z_f, -1.0f, 1.0f) - h.mean);
    hamburger_bounds r;
    r.lower = saturate_or_zero(s.lower);
    r.weight = gnomon_min(saturate_or_zero(s.weight), 1.0f - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger6_bounds.
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
static inline float hamburger6_lower(hankel6 h, float z_f) { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
static inline gnomon_distribution4 hamburger6_distribution(hankel6 h, float z_f)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, clamp_or_nan(z_f, -1.0f, 1.0f) - h.mean);
    float inverse = 1.0f / gnomon_hamburger6_kernel(h, p);
    float side = gnomon_select(p.p3 > 0.0f, -1.0f, 1.0f);
    hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, gnomon_hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    float t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    bool large = (t1 * t1) * t1 > -n.d;
    float backward = -n.d / t1;
    float forward = n.b + t1;
    float b = 0.5f * gnomon_select(large, (backward - n.c) / t1, forward);
    float c = gnomon_select(large, backward, n.c + t1 * forward);
    gnomon_quadratic_result q = quadratic_roots(1.0f, b, c);
    float t2 = gnomon_cubic_halley(n.b, n.c, n.d, q.first);
    float t3 = gnomon_cubic_halley(n.b, n.c, n.d, q.second);
    float x1 = p.p1 + side * gnomon_hamburger6_distance(t1);
    float x2 = p.p1 + side * gnomon_hamburger6_distance(t2);
    float x3 = p.p1 + side * gnomon_hamburger6_distance(t3);
    float low = gnomon_min(x2, x3);
    float high = gnomon_max(x2, x3);
    float y1 = gnomon_min(x1, low);
    float y2 = gnomon_max(gnomon_min(x1, high), low);
    float y3 = gnomon_max(x1, high);
    float w0 = h.whole * inverse;
    float w1 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y1));
    float w2 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y2));
    float w3 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y3));
    float sum = (w0 + w1) + (w2 + w3);
    bool known = sum > 0.0f; // false for NaN
    gnomon_distribution4 d;
    d.depth0 = gnomon_select(known, h.mean + p.p1, 1.0f);
    d.depth1 = gnomon_select(known, h.mean + y1, 1.0f);
    d.depth2 = gnomon_select(known, h.mean + y2, 1.0f);
    d.depth3 = gnomon_select(known, h.mean + y3, 1.0f);
    d.weight1 = gnomon_select(known, w1 / sum, 0.0f);
    d.weight2 = gnomon_select(known, w2 / sum, 0.0f);
    d.weight3 = gnomon_select(known, w3 / sum, 0.0f);
    d.weight0 = saturate_or_zero(1.0f - (d.weight1 + (d.weight2 + d.weight3)));
    return d;
}

#endif

// storage/moments6.h --------------------------------------------------------------------------------------------------
// Six moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow or
// to the factored Hankel matrix. Each format undoes its own transform and applies the constant bias that belongs to it,
// so that nobody pairs the wrong three.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   6 x 10 UNORM      8     theta6      moments6_unorm10_encode   moments6_unorm10_intensity   hankel6_from_unorm10
//   6 x 16 UNORM     12     theta6      moments6_unorm16_encode   moments6_unorm16_intensity   hankel6_from_unorm16
//   6 x float        24     none        moments6_float_encode     moments6_float_intensity     hankel6_from_float
//
// Texels of 6 x 10 UNORM are two 10-10-10-2 words: odd channels (c1, c2, c3) in the first, even ones (c4, c5, c6) in
// the second. Filters are linear: average channels as they are.
//
// Intensities exceed Z(z < z_f) by the weight at most, for every receiver: by the proof in bias.h n roundings need a
// weight of n delta / (n delta + r).
//
//                  delta      n = 1     weight    n = 3     weight, filtered
//   6 x 10 UNORM   1/2046     3.34e-3   4e-3      9.96e-3   1e-2
//   6 x 16 UNORM   1/131070   5.23e-5   8e-5      1.57e-4   1.6e-4
//   6 x float      2^-25      1.83e-6   5e-6                2e-5
//
// Filtered: rounded when rendered and by each of two passes of nine taps, their sums in float. Sums of floats round as
// storage does, and so do the powers of a depth: at their worst they are 22 roundings and 4e-5, which do not come
// together. The kernel's own arithmetic in float is within the weights. Tests search for the largest excess by hill
// climbing (tests/moments/honest_six.cpp), and find that 5e-6 is too little for filtered floats.
#ifndef GNOMON_STORAGE_MOMENTS6_H
#define GNOMON_STORAGE_MOMENTS6_H

__constant float gnomon_stored6_unorm10_weight = 4e-3f;
__constant float gnomon_stored6_unorm10_filtered_weight = 1e-2f;
__constant float gnomon_stored6_unorm16_weight = 8e-5f;
__constant float gnomon_stored6_unorm16_filtered_weight = 1.6e-4f;
__constant float gnomon_stored6_float_weight = 5e-6f;
__constant float gnomon_stored6_float_filtered_weight = 2e-5f;

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
static inline channels6 moments6_unorm10_encode(float z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, -1.0f, 1.0f)));
}

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
static inline channels6 moments6_unorm16_encode(float z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, -1.0f, 1.0f)));
}

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
static inline channels6 moments6_float_encode(float z)
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, -1.0f, 1.0f)));
}

/// The factored matrix of the channels of theta6, with a constant bias of weight alpha.
static inline hankel6 gnomon_hankel6_from_theta(channels6 c, float alpha)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), gnomon_bias6_theta_b2, gnomon_bias6_theta_b4,
                                                  gnomon_bias6_theta_b6, alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
static inline hankel6 hankel6_from_unorm10(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_weight);
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
static inline hankel6 hankel6_from_unorm10_filtered(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_filtered_weight);
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
static inline hankel6 hankel6_from_unorm16(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_weight);
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
static inline hankel6 hankel6_from_unorm16_filtered(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
static inline hankel6 hankel6_from_float(channels6 c)
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 gnomon_stored6_float_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
static inline hankel6 hankel6_from_float_filtered(channels6 c)
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 gnomon_stored6_float_filtered_weight);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm10_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm10(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm10_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm16_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm16(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm16_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_float_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_float(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_float_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
}

#endif

// moments/translucency.h ----------------------------------------------------------------------------------------------
// Translucent occluders (Peters et al. 2017, Sec. 3): moments of the depth distribution in which each fragment of a
// stack has as weight the light that it takes away,
//     Z = sum_k weight_k delta(z_k),    weight_k = alpha_k prod of (1 - alpha_j) over the fragments j in front of k,
// so that Z(z < z_f) = 1 - prod of (1 - alpha_k) over z_k < z_f, the intensity of the stack's shadow. What is behind
// all fragments, an opaque surface or the far plane, has the rest of the weight.
//
//     back to front    b = the moments of the surface behind;  b = moments4_over(b, z, alpha) for each fragment
//     front to back    state = front_to_back_begin(alpha), then front_to_back_add(state, alpha): moments4_add the
//                      fragment's moments with state.weight, in the end those of the surface behind with
// state.transmittance
//
// A GPU blends back to front: over() of each channel, with the alpha of the fragment. Weights sum to 1, so that affine
// transforms commute with blending: channels of any format are blended as stored (passes/blend.hpp). For coloured
// occluders use one map for each channel of light, with the opacity for that light. In any order, a fragment that
// survives in a sample with probability alpha has this distribution as the mean over samples (stochastic transparency;
// Enderton et al. 2010).
//
// Every blend rounds to the format. Later blends shrink an error by 1 - alpha, so of n roundings by delta
//     delta (1 - (1 - alpha)^n) / alpha <= delta / alpha
// is left: blend_roundings, for storage/moments4_blended.h and moments6_blended.h. A least alpha hence limits the
// error, and fragments below it are discarded (alpha test). Where alpha |above - below| is less than half a code, a
// blend changes
// nothing: many faint fragments vanish, for which no bias makes up. Absorbance (absorbance.h) loses less of them.
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_H
#define GNOMON_MOMENTS_TRANSLUCENCY_H

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below.
/// An alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
static inline float over(float below, float above, float alpha)
{
    float a = saturate_or_zero(alpha);
    float mixed = (1.0f - a) * below + a * above;
    return gnomon_select(0.0f < a, gnomon_select(a < 1.0f, mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
typedef struct gnomon_front_to_back gnomon_front_to_back;
struct gnomon_front_to_back { float weight, transmittance; };

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
static inline gnomon_front_to_back front_to_back_begin(float alpha)
{
    gnomon_front_to_back state;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = 1.0f - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
static inline gnomon_front_to_back front_to_back_add(gnomon_front_to_back state, float alpha)
{
    float a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (1.0f - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
__constant float gnomon_alpha_test_one_percent = 0.01f;

__constant float gnomon_blend_least_alpha = 5.9604644775390625e-8f; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
static inline float blend_roundings(float least_alpha)
{
    return 1.0f / gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
static inline float blend_roundings_of_layers(float least_alpha, float layers)
{
    float a = gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
    float further = gnomon_max(1.0f, layers) - 1.0f;
    float few = (further + 1.0f) / (1.0f + 0.5f * (further * a));
    return gnomon_min(few, 1.0f / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
static inline float gnomon_blended_roundings(float further, float each)
{
    return 1.0f + each * gnomon_max(0.0f, further);
}

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
__constant float gnomon_blended_half_roundings = 2.0f;
__constant float gnomon_blended_float_roundings = 3.5f;

#endif

// moments/translucency.h, six moments ---------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_6
#define GNOMON_MOMENTS_TRANSLUCENCY_6

/// The six moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
static inline moments6 moments6_over(moments6 below, float z, float alpha)
{
    moments6 b = moments6_from_depth(clamp_or_high(z, -1.0f, 1.0f));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    b.b5 = over(below.b5, b.b5, alpha);
    b.b6 = over(below.b6, b.b6, alpha);
    return b;
}

#endif

// storage/moments6_blended.h ------------------------------------------------------------------------------------------
// Six moments from texels into which translucent fragments were blended (moments/translucency.h), by a constant bias
// whose weight grows with the number of roundings that are left, as in moments4_blended.h.
//
//   format          matrix for both bounds         shadow
//   6 x 10 UNORM    hankel6_from_unorm10_blended   moments6_unorm10_blended_intensity
//   6 x 16 UNORM    hankel6_from_unorm16_blended   moments6_unorm16_blended_intensity
//   6 x float       hankel6_from_float_blended     moments6_float_blended_intensity
//
// Intensities exceed Z(z < z_f) by bias_weight_of_roundings at most: for blends of an alpha from 1% on by 8e-3 for 6 x
// 16 UNORM, but by 0.29 for 6 x 10 UNORM, which is no format to blend many layers into. A blend of floats takes 1.5 of
// the weights of 6 x float, each of which is good for 2.7 roundings.
#ifndef GNOMON_STORAGE_MOMENTS6_BLENDED_H
#define GNOMON_STORAGE_MOMENTS6_BLENDED_H

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
static inline hankel6 hankel6_from_unorm10_blended(channels6 c, float roundings)
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm10_weight, gnomon_blended_roundings(roundings, 1.0f)));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
static inline hankel6 hankel6_from_unorm16_blended(channels6 c, float roundings)
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm16_weight, gnomon_blended_roundings(roundings, 1.0f)));
}

__constant float gnomon_blended6_float_weights = 1.5f;

/// The factored matrix of the channels of a 6 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
static inline hankel6 hankel6_from_float_blended(channels6 c, float roundings)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended6_float_weights);
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 bias_weight_of_roundings(gnomon_stored6_float_weight, n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm10_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_unorm16_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
static inline float moments6_float_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_float_blended(c, roundings), z_f);
}

#endif

#endif
