// Gnomon 0.1.0, rectified_frustum.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RECTIFIED_FRUSTUM_METAL
#define GNOMON_RECTIFIED_FRUSTUM_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: rectified_frustum.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: rectified_frustum.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: rectified_frustum.metal is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

namespace gnomon {

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

namespace gnomon {

constant constexpr float exp_log2_e = 1.4426950408889634f;
constant constexpr float exp_ln2_low = -2.1219444005469058e-4f;
constant constexpr float exp_sqrt_2 = 1.4142135623730951f;
constant constexpr float exp_sqrt_half = 0.70710678118654752f;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
constant constexpr float exp_float_0 = 0.49999993561656014f;
constant constexpr float exp_float_1 = 0.16666518908321371f;
constant constexpr float exp_float_2 = 0.041668318723256166f;
constant constexpr float exp_float_3 = 0.0083689258101569408f;
constant constexpr float exp_float_4 = 0.00138210541669496f;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
constant constexpr float log_float_0 = 0.66666776085218282f;
constant constexpr float log_float_1 = 0.39977574040563962f;
constant constexpr float log_float_2 = 0.29870936689734456f;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
inline float exp_remainder(float r)
{
    float p = exp_float_0 + r * (exp_float_1 + r * (exp_float_2 + r * (exp_float_3 + r * exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
inline float polynomial_exp(float x)
{
    float low = -87.0f;
    float high = 88.0f;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375f) - n * exp_ln2_low;
    return (1.0f + (r + r * r * exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
inline scaled_number scaled_number_step(scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    scaled_number r;
    r.significand = gnomon_select(large, s.significand * down, gnomon_select(tiny, s.significand * up, s.significand));
    r.exponent = gnomon_select(large, s.exponent + k, gnomon_select(tiny, s.exponent - k, s.exponent));
    return r;
}

/// The natural logarithm of x.
/// Domain: [2^-126, 2^127] in float, [2^-1022, 2^1023] in double; x is clamped, so that 0 and negative numbers give the
/// value at the lower end.
/// NaN: stays NaN.
/// Error: 0.9 ulp in float and in double.
/// Source: Cody & Waite 1980
inline float polynomial_log(float x)
{
    scaled_number s;
    s.exponent = 0.0f;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0f), gnomon_power_of_two(127.0f));
    s = scaled_number_step(s, 64.0f);
    s = scaled_number_step(s, 32.0f);
    s = scaled_number_step(s, 16.0f);
    s = scaled_number_step(s, 8.0f);
    s = scaled_number_step(s, 4.0f);
    s = scaled_number_step(s, 2.0f);
    s = scaled_number_step(s, 1.0f);
    bool large = exp_sqrt_2 < s.significand;
    bool tiny = s.significand < exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5f, gnomon_select(tiny, s.significand * 2.0f, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0f, gnomon_select(tiny, s.exponent - 1.0f, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0f;
    float y = f / (2.0f + f);
    float z = y * y;
    float p = log_float_0 + z * (log_float_1 + z * log_float_2);
    float square = 0.5f * f * f;
    float rest = y * (square + z * p) + n * exp_ln2_low;
    return n * 0.693359375f - ((square - rest) - f);
}

} // namespace gnomon

#endif

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_TRIGONOMETRY_H
#define GNOMON_NUMERICS_TRIGONOMETRY_H

namespace gnomon {

constant constexpr float trigonometry_two_over_pi = 0.63661977236758134f;
constant constexpr float trigonometry_half_pi_low = 7.5497899548918821e-8f;
constant constexpr float trigonometry_half_pi = 1.5707963267948966f;
constant constexpr float trigonometry_quarter_pi_low = 1.5695823932524066e-7f;
constant constexpr float trigonometry_tan_pi_8 = 0.41421356237309505f;

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
constant constexpr float sin_float_0 = -0.16666654609567105f;
constant constexpr float sin_float_1 = 0.0083321607625195058f;
constant constexpr float sin_float_2 = -0.00019515283258365583f;

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
constant constexpr float cos_float_0 = 0.041666645683017541f;
constant constexpr float cos_float_1 = -0.0013887316256332952f;
constant constexpr float cos_float_2 = 2.4433157272163749e-05f;

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
constant constexpr float atan_float_0 = -0.33333315189495832f;
constant constexpr float atan_float_1 = 0.19998471559801789f;
constant constexpr float atan_float_2 = -0.14243534037509495f;
constant constexpr float atan_float_3 = 0.10593818186484773f;
constant constexpr float atan_float_4 = -0.060782316918251741f;

/// A cosine and the sine of the same angle.
struct cosine_sine { float cosine, sine; };

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
inline cosine_sine polynomial_cosine_sine(float x)
{
    x = clamp_or_nan(x, -8192.0f, 8192.0f);
    float n = nearest_integer(x * trigonometry_two_over_pi);
    float y = gnomon_difference(x, n * 1.5703125f);
    y = gnomon_difference(y, n * 0.0004837512969970703125f) - n * trigonometry_half_pi_low;
    float z = y * y;
    float s = sin_float_0 + z * (sin_float_1 + z * sin_float_2);
    float c = cos_float_0 + z * (cos_float_1 + z * cos_float_2);
    s = y + y * z * s;
    c = (1.0f - 0.5f * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    float m = n - 4.0f * nearest_integer(0.25f * n);
    bool odd = gnomon_abs(m) == 1.0f;
    bool opposite = gnomon_abs(m) == 2.0f;
    cosine_sine r;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
inline float polynomial_cos(float x) { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
inline float polynomial_sin(float x) { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
inline float polynomial_atan2(float y, float x)
{
    float ax = gnomon_abs(x);
    float ay = gnomon_abs(y);
    bool steep = ax < ay;
    float shorter = gnomon_select(steep, ax, ay);
    float longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    bool wide = trigonometry_tan_pi_8 * longer < shorter;
    float denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == 0.0f, 1.0f, longer));
    float t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    float z = t * t;
    float p = atan_float_0 + z * (atan_float_1 + z * (atan_float_2 + z * (atan_float_3 + z * atan_float_4)));
    float angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    float eighths = gnomon_select(wide, 1.0f, 0.0f);
    angle = gnomon_select(steep, -1.0f * angle, angle);
    eighths = gnomon_select(steep, 2.0f - eighths, eighths);
    angle = gnomon_select(x < 0.0f, -1.0f * angle, angle);
    eighths = gnomon_select(x < 0.0f, 4.0f - eighths, eighths);
    angle = eighths * 0.785398006439208984375f + (angle + eighths * trigonometry_quarter_pi_low);
    return gnomon_select(y < 0.0f, -1.0f * angle, angle);
}

} // namespace gnomon

#endif

// scattering/rectified.h ----------------------------------------------------------------------------------------------
// Rectified coordinates of a shadow map of a directional light, in which all points of a view ray lie in one row and at
// one depth (Peters et al. 2017, Sec. 5.1.1 and App. A; Baran et al. 2010).
//
// Axes: x and y along the map, z along the propagation of light. Origin: the eye. Any unit of length.
//
//     radius  = |(x, y)|            distance between the eye and a light ray: column of the rectified map
//     azimuth = angle of (x, y)     slice that holds the light direction and the eye: row of the rectified map
//     polar   = atan2(radius, z)    angle between the view ray and the propagation of light, in [0, pi]
//
// Looking into the light is polar = pi. On a light ray z grows with depth, and polar falls with it. Hence a depth of
// the rectified map is a falling function of polar, signed as all depths of this library: -1 looking into the light, +1
// along it. There are two measures of depth: the angle itself, as in the paper, and its cosine, which needs no inverse
// trigonometry. Both are stretched to [-1, 1] over the range of the view rays and a guard band of 10%, so that an
// occluder outside of that range keeps a distance from all view rays.
//
//     omega_l    the direction to the light:  (0, 0, -1)
//     omega_p    the direction from a point of the view ray to the camera
//     dot product of the two = cosine of polar;  cosine of the scattering angle = -cosine of polar
//
// One texel of the rectified map is one light ray: position eye + radius (cos azimuth, sin azimuth) in the map, and its
// depth there as z leads to polar.
#ifndef GNOMON_SCATTERING_RECTIFIED_H
#define GNOMON_SCATTERING_RECTIFIED_H

namespace gnomon {

constant constexpr float rectified_guard = 0.55f; // half of a range with a guard band of 10%
constant constexpr float rectified_pi = 3.1415926535897932f;
constant constexpr float rectified_two_pi = 6.2831853071795865f;

/// A distance from the eye across the light, and two angles.
struct rectified_position { float radius, azimuth, polar; };

/// A map of angles, or of cosines, to depths: the value of depth 0, and depth per unit.
struct rectified_range { float middle, scale; };

/// The rectified coordinates of a point: radius at least 0, azimuth in [-pi, pi], polar in [0, pi]. On the axis azimuth
/// is 0; polar of the eye is 0.
/// Domain: |x|, |y| and |z| are 0 or in [2^-60, 2^60] in float, [2^-500, 2^500] in double.
/// NaN: a NaN in each coordinate that depends on it.
/// Error: radius 2 2^-p relative; azimuth 2.6 ulp, polar 3.6 ulp.
/// Source: Peters 2017, Sec. 5.1.1; Baran 2010
inline rectified_position rectified_from_position(float x, float y, float z)
{
    rectified_position r;
    r.radius = gnomon_sqrt(x * x + y * y);
    r.azimuth = polynomial_atan2(y, x);
    r.polar = polynomial_atan2(r.radius, z);
    return r;
}

/// The cosine of polar at a point, in [-1, 1]; 1 at the eye.
/// Domain: as for rectified_from_position.
/// NaN: NaN.
/// Error: 3 2^-p.
inline float rectified_cosine(float x, float y, float z)
{
    float distance_ = gnomon_sqrt((x * x + y * y) + z * z);
    bool at_eye = distance_ == 0.0f;
    float cosine = z / gnomon_select(at_eye, 1.0f, distance_);
    return clamp_or_nan(gnomon_select(at_eye, 1.0f, cosine), -1.0f, 1.0f);
}

/// The range whose depths are in [-1 / 1.1, 1 / 1.1] from least to most, or in a part of that if most - least is below
/// narrowest.
inline rectified_range rectified_range_over(float least, float most, float narrowest)
{
    rectified_range r;
    r.middle = 0.5f * (least + most);
    r.scale = 1.0f / (rectified_guard * gnomon_max(most - least, narrowest));
    return r;
}

/// The range of depth for polar angles of view rays in [least, most].
/// Domain: least <= most, in [0, pi]. A range narrower than 2^-10, or reversed, is widened to 2^-10 around its middle.
/// NaN: a middle of NaN.
/// Source: Peters 2017, Sec. 5.1.1
inline rectified_range rectified_polar_range(float least, float most)
{
    return rectified_range_over(least, most, 0.0009765625f);
}

/// The range of depth for cosines of polar angles of view rays in [least, most], which are those of the greatest and of
/// the least angle.
/// Domain: least <= most, in [-1, 1]. A range narrower than 2^-16, or reversed, is widened to 2^-16 around its middle.
/// NaN: a middle of NaN.
inline rectified_range rectified_cosine_range(float least, float most)
{
    return rectified_range_over(least, most, 0.0000152587890625f);
}

/// Signed depth of a polar angle, in [-1, 1]: falls with the angle, -1 on the side of rays that look into the light.
/// Domain: polar in [0, pi], a range by rectified_polar_range.
/// NaN: NaN, which encoders store as the far plane.
/// Source: Peters 2017, Sec. 5.1.1
inline float rectified_polar_depth(float polar, rectified_range range)
{
    return clamp_or_nan((range.middle - polar) * range.scale, -1.0f, 1.0f);
}

/// Signed depth of the cosine of a polar angle, in [-1, 1]: grows with the cosine, -1 on the side of rays that look
/// into the light.
/// Domain: cosine in [-1, 1], a range by rectified_cosine_range.
/// NaN: NaN, which encoders store as the far plane.
inline float rectified_cosine_depth(float cosine, rectified_range range)
{
    return clamp_or_nan((cosine - range.middle) * range.scale, -1.0f, 1.0f);
}

/// An angle within three half turns of 0, moved by a full turn to at most half a turn from 0.
inline float rectified_wrapped(float angle)
{
    float turn = rectified_two_pi;
    float half_turn = rectified_pi;
    float up = gnomon_select(angle + half_turn < 0.0f, angle + turn, angle);
    return gnomon_select(half_turn < up, up - turn, up);
}

/// The position across the rows of a map, in [0, rows], of an azimuth; the centre of the first row is at 0.5. The map
/// begins at the azimuth start and spans the angle span; an azimuth outside is moved to the nearer end.
/// Domain: azimuth and start in [-pi, pi], span in [2^-20, 2 pi]; elsewhere a number in [0, rows].
/// NaN: NaN for an azimuth of NaN.
inline float rectified_row_of(float azimuth, float start, float span, float rows)
{
    float whole = gnomon_max(span, 0.00000095367431640625f);
    float from_middle = rectified_wrapped((azimuth - start) - 0.5f * whole);
    return clamp_or_nan((from_middle / whole + 0.5f) * rows, 0.0f, rows);
}

/// The position along a row of prefix averages, at least 0, of a ray that ends at radius; the centre of the first texel
/// is at 0.5. The average up to the far side of texel u, radius (u + 1) radius_step, stands at its centre, u + 1/2: so
/// the position is half a texel before that of the light ray itself.
/// Domain: radius at least 0, radius_step above 0.
/// NaN: NaN.
inline float rectified_column_of(float radius, float radius_step)
{
    return gnomon_max(0.0f, radius / radius_step - 0.5f);
}

/// The greater extent of a texel of the rectified map at radius, in texels of the shadow map: along the row
/// radius_step, across it radius times azimuth_step, the angle between rows.
/// Domain: at least 0 each.
/// NaN: NaN.
inline float rectified_footprint(float radius, float radius_step, float azimuth_step, float texels_per_length)
{
    return gnomon_max(radius_step, radius * azimuth_step) * texels_per_length;
}

/// The mip level, in [0, 16], whose texels are as wide as a footprint in texels of level 0.
/// Domain: any footprint.
/// NaN: 0.
/// Error: 2 2^-p of the largest level.
inline float rectified_level(float footprint)
{
    float wide = clamp_or_nan(footprint, 1.0f, 65536.0f);
    return clamp_or_high(polynomial_log(gnomon_max(wide, 1.0f)) * exp_log2_e, 0.0f, 16.0f);
}

} // namespace gnomon

#endif

// scattering/rectified_frustum.h --------------------------------------------------------------------------------------
// Bounds of rectified coordinates (rectified.h) over the view rays of a camera (Peters et al. 2017, App. A), from the
// four corners of its far plane, in order around it, in light axes with the eye for origin.
//
//     radius     largest radius of a corner
//     azimuth    angles of the corners relative to that of the farthest one: no two differ by more than half a turn
//     axis       where the light direction, or its opposite, is strictly within the four side planes: a full turn, and
// polar
//                begins at 0, or ends at pi
//     polar      extreme on the border of the far plane, else on the axis. On the edge a + t c the cosine z / |a + t c|
// is
//                extreme at   t = (a_z a.c - c_z a.a) / (c_z a.c - a_z c.c)
//                or at an end. Any point of the edge is within the bounds, so t needs no test: it is clamped.
//
// The angles of one row are the same over edges that are cut off at the row's two azimuths, each by the side on which
// a point of the edge lies: a fold over the far plane's border, whether the row holds corners or not.
#ifndef GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H
#define GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H

namespace gnomon {

/// A corner of the far plane.
struct rectified_corner { float x, y, z; };

/// Corners of the far plane, in order around it, either way.
struct rectified_corners { rectified_corner a, b, c, d; };

/// The bounds of a camera's view rays: radius in [0, radius], azimuth from azimuth_start on over azimuth_length, polar
/// from polar_least to polar_most.
struct rectified_frustum { float radius, azimuth_start, azimuth_length, polar_least, polar_most; };

/// An interval of polar angles.
struct rectified_interval { float least, most; };

/// A part of an edge, from a fraction begin to a fraction end.
struct rectified_part { float begin, end; };

inline float rectified_dot(rectified_corner a, rectified_corner b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// b - a.
inline rectified_corner rectified_from_to(rectified_corner a, rectified_corner b)
{
    rectified_corner r;
    r.x = b.x - a.x;
    r.y = b.y - a.y;
    r.z = b.z - a.z;
    return r;
}

/// The z of the cross product of a and b: positive where the azimuth of b is up to half a turn beyond that of a.
inline float rectified_turn(rectified_corner a, rectified_corner b) { return a.x * b.y - a.y * b.x; }

/// 1 if the light direction is strictly within the far plane as seen from the eye, -1 if its opposite is, else 0.
inline float rectified_axis_side(rectified_corners q)
{
    float ab = rectified_turn(q.a, q.b);
    float bc = rectified_turn(q.b, q.c);
    float cd = rectified_turn(q.c, q.d);
    float da = rectified_turn(q.d, q.a);
    bool left = 0.0f < ab && 0.0f < bc && 0.0f < cd && 0.0f < da;
    bool right = ab < 0.0f && bc < 0.0f && cd < 0.0f && da < 0.0f;
    // The normal of the far plane, by its diagonals, and the side of it on which the plane lies.
    rectified_corner s = rectified_from_to(q.a, q.c);
    rectified_corner t = rectified_from_to(q.b, q.d);
    float nx = s.y * t.z - s.z * t.y;
    float ny = s.z * t.x - s.x * t.z;
    float side = (nx * q.a.x + ny * q.a.y) + rectified_turn(s, t) * q.a.z;
    float sign = gnomon_select(side < 0.0f, -1.0f, 1.0f);
    return gnomon_select(left, sign, gnomon_select(right, -1.0f * sign, 0.0f));
}

/// The angles so far and that of the point (x, y, z).
inline rectified_interval rectified_interval_add(rectified_interval bounds, float x, float y, float z)
{
    float polar = polynomial_atan2(gnomon_sqrt(x * x + y * y), z);
    bounds.least = gnomon_min(polar, bounds.least);
    bounds.most = gnomon_max(polar, bounds.most);
    return bounds;
}

/// The angles so far and that of the point a + t c.
inline rectified_interval rectified_interval_along(rectified_interval bounds, rectified_corner a, rectified_corner c,
                                                   float t)
{
    return rectified_interval_add(bounds, a.x + t * c.x, a.y + t * c.y, a.z + t * c.z);
}

/// The t of the extreme angle on a + t c, limited to a part; some t of it for an edge towards the eye or without
/// length.
inline float rectified_extreme(rectified_corner a, rectified_corner c, float begin, float end)
{
    float ac = rectified_dot(a, c);
    float t = (a.z * ac - c.z * rectified_dot(a, a)) / (c.z * ac - a.z * rectified_dot(c, c));
    return clamp_or_nan(gnomon_select(t == t, t, begin), begin, end);
}

/// The angles so far and those of the edge from a to b, without b.
inline rectified_interval rectified_interval_edge(rectified_interval bounds, rectified_corner a, rectified_corner b)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_add(bounds, a.x, a.y, a.z);
    return rectified_interval_along(r, a, c, rectified_extreme(a, c, 0.0f, 1.0f));
}

/// The angles so far and those of a part of the edge from a to b; an empty part has none.
inline rectified_interval rectified_interval_part(rectified_interval bounds, rectified_corner a, rectified_corner b,
                                                  rectified_part part)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_along(bounds, a, c, part.begin);
    r = rectified_interval_along(r, a, c, part.end);
    r = rectified_interval_along(r, a, c, rectified_extreme(a, c, part.begin, part.end));
    bool empty = part.end < part.begin;
    r.least = gnomon_select(empty, bounds.least, r.least);
    r.most = gnomon_select(empty, bounds.most, r.most);
    return r;
}

/// The bounds before any edge, where axis is that of rectified_axis_side.
inline rectified_interval rectified_interval_begin(float axis)
{
    rectified_interval r;
    r.least = gnomon_select(0.0f < axis, 0.0f, rectified_pi);
    r.most = gnomon_select(axis < 0.0f, rectified_pi, 0.0f);
    return r;
}

/// The interval, or [0, pi] if no angle was added.
inline rectified_interval rectified_interval_end(rectified_interval bounds)
{
    bool none = bounds.most < bounds.least;
    bounds.least = gnomon_select(none, 0.0f, bounds.least);
    bounds.most = gnomon_select(none, rectified_pi, bounds.most);
    return bounds;
}

/// The farther from the axis of two corners, the first where they are equal or the second has a NaN.
inline rectified_corner rectified_farther(rectified_corner a, rectified_corner b)
{
    bool second = a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    rectified_corner r;
    r.x = gnomon_select(second, b.x, a.x);
    r.y = gnomon_select(second, b.y, a.y);
    r.z = gnomon_select(second, b.z, a.z);
    return r;
}

/// The azimuth of b relative to that of a, in [-pi, pi]; 0 on the axis.
inline float rectified_azimuth_between(rectified_corner a, rectified_corner b)
{
    return polynomial_atan2(rectified_turn(a, b), a.x * b.x + a.y * b.y);
}

/// The bounds of rectified coordinates over all view rays to a far plane with these corners: sharp, so that rays touch
/// each. azimuth_start is in [-pi, pi], azimuth_length in [0, 2 pi]: at most pi, or 2 pi if the axis is within the far
/// plane. A corner on the axis has no azimuth and bounds none.
/// Domain: coordinates are 0 or have magnitudes in [2^-30, 2^30] in float, [2^-300, 2^300] in double; corners of a
/// convex quadrilateral whose plane does not hold the eye. Corners that are all at the eye give zeros; corners of no
/// such quadrilateral give unspecified bounds.
/// NaN: an edge with a NaN bounds no angle.
/// Error: for fields of view up to 160 degrees a point of the far plane exceeds the bounds by at most 4 2^-p radius in
/// radius, by 16 2^-p radius sideways, and by 8 2^-p in polar.
/// Source: Peters 2017, App. A
inline rectified_frustum rectified_frustum_from_corners(rectified_corners q)
{
    float axis = rectified_axis_side(q);
    rectified_corner farthest = rectified_farther(rectified_farther(q.a, q.b), rectified_farther(q.c, q.d));
    float a = rectified_azimuth_between(farthest, q.a);
    float b = rectified_azimuth_between(farthest, q.b);
    float c = rectified_azimuth_between(farthest, q.c);
    float d = rectified_azimuth_between(farthest, q.d);
    float least = gnomon_min(a, gnomon_min(b, gnomon_min(c, gnomon_min(d, 0.0f))));
    float most = gnomon_max(a, gnomon_max(b, gnomon_max(c, gnomon_max(d, 0.0f))));
    bool around = axis < 0.0f || 0.0f < axis || rectified_pi < most - least;

    rectified_interval polar = rectified_interval_begin(axis);
    polar = rectified_interval_edge(polar, q.a, q.b);
    polar = rectified_interval_edge(polar, q.b, q.c);
    polar = rectified_interval_edge(polar, q.c, q.d);
    polar = rectified_interval_end(rectified_interval_edge(polar, q.d, q.a));

    rectified_frustum r;
    r.radius = gnomon_sqrt(farthest.x * farthest.x + farthest.y * farthest.y);
    float start = polynomial_atan2(farthest.y, farthest.x) + least;
    float first = -1.0f * rectified_pi;
    r.azimuth_start = gnomon_select(around, first, clamp_or_nan(rectified_wrapped(start), first, rectified_pi));
    r.azimuth_length = gnomon_select(around, rectified_two_pi, most - least);
    r.polar_least = polar.least;
    r.polar_most = polar.most;
    return r;
}

/// The part of the edge from a to b, within a part, that is on the left of the direction (cosine, sine) from the axis.
inline rectified_part rectified_part_left(rectified_part part, rectified_corner a, rectified_corner b, float cosine,
                                          float sine)
{
    float at_a = cosine * a.y - sine * a.x;
    float at_b = cosine * b.y - sine * b.x;
    float crossing = at_a / (at_a - at_b);
    part.begin = gnomon_select(at_a < 0.0f, gnomon_max(part.begin, crossing), part.begin);
    part.end = gnomon_select(at_b < 0.0f, gnomon_min(part.end, crossing), part.end);
    // Both ends are on the right: the part is empty.
    part.end = gnomon_select(at_a < 0.0f && at_b < 0.0f, -1.0f, part.end);
    return part;
}

/// The angles so far and those of the edge from a to b between two directions; of the whole edge if whole is 1.
inline rectified_interval rectified_row_edge(rectified_interval bounds, rectified_corner a, rectified_corner b,
                                             cosine_sine first, cosine_sine last, float whole)
{
    rectified_part all;
    all.begin = 0.0f;
    all.end = 1.0f;
    rectified_part part = rectified_part_left(all, a, b, first.cosine, first.sine);
    part = rectified_part_left(part, a, b, -1.0f * last.cosine, -1.0f * last.sine);
    part.begin = gnomon_select(whole == 1.0f, 0.0f, part.begin);
    part.end = gnomon_select(whole == 1.0f, 1.0f, part.end);
    return rectified_interval_part(bounds, a, b, part);
}

/// The polar angles of the view rays whose azimuths are between first and last, as those of one row; [0, pi] if no ray
/// is there.
/// Domain: as for rectified_frustum_from_corners; first <= last, both within 3 pi of 0. An interval above 3 radians
/// gives the angles of all rays.
/// NaN: as for rectified_frustum_from_corners.
/// Error: for fields of view up to 160 degrees a ray exceeds the bounds by at most 16 2^-p.
inline rectified_interval rectified_row_polar(rectified_corners q, float first, float last)
{
    cosine_sine left = polynomial_cosine_sine(first);
    cosine_sine right = polynomial_cosine_sine(last);
    float whole = gnomon_select(3.0f < last - first, 1.0f, 0.0f);
    rectified_interval polar = rectified_interval_begin(rectified_axis_side(q));
    polar = rectified_row_edge(polar, q.a, q.b, left, right, whole);
    polar = rectified_row_edge(polar, q.b, q.c, left, right, whole);
    polar = rectified_row_edge(polar, q.c, q.d, left, right, whole);
    return rectified_interval_end(rectified_row_edge(polar, q.d, q.a, left, right, whole));
}

} // namespace gnomon

#endif

#endif
