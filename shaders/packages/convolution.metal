// Gnomon 0.1.0, convolution.metal: shadow filtering in Metal, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_CONVOLUTION_METAL
#define GNOMON_CONVOLUTION_METAL

// the language --------------------------------------------------------------------------------------------------------
// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#if !defined(__METAL_VERSION__)
#error "gnomon: convolution.metal is Metal; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: convolution.metal and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: convolution.metal is not of the same version as a package before it"
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

// filters/convolution.h -----------------------------------------------------------------------------------------------
// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel & Kautz 2007): the shadow test is a square wave in z_f - z,
// and its Fourier series
//     1/2 + sum_k w_k sin(a_k (z_f - z)),   w_k = 2 / (pi (2 k - 1)),   a_k = (2 k - 1) span pi / 2,   k = 1..terms,
// separates into products of functions of z, which the map holds (a cosine and a sine per term), and functions of z_f.
// Unlike the other filters the series is no bound: truncated, it rings, and is 1/2 at z_f = z.
//
//     phase = convolution_encode(z, settings);          a texel's first cosine and sine
//     phase = convolution_next(phase);                  its next ones
//
//     state = convolution_begin(z_f, settings);
//     state = convolution_add(state, cosine, sine, convolution_weight(k, settings));       filtered, for k = 1, 2, ...
//     intensity = convolution_end(state);
#ifndef GNOMON_FILTERS_CONVOLUTION_H
#define GNOMON_FILTERS_CONVOLUTION_H

namespace gnomon {

/// The number of terms. damping >= 0 attenuates term k by exp(-damping (k / terms)^2) against ringing (Annen et al.
/// 2007). offset is subtracted from z_f, so that a surface in its own map lies where the series has come down to 0: the
/// first zero is at 1.926 / (pi terms span), where the sine integral is pi / 2. span in (0, 1] is the part of a half
/// period that depths in [-1, 1] fill. A span below 1 keeps a near receiver before a far texel from reaching the next
/// edge of the wave.
struct convolution_settings { float terms, damping, offset, span; };

/// Cosine and sine of a_k z, and of the step from one term to the next.
struct convolution_phase { float cosine, sine, step_cosine, step_sine; };

/// The phase of the first term at z.
/// Domain: z in [-2, 2], span in [0, 1]. For a span of 0 the series is 1/2.
/// NaN: NaN.
inline convolution_phase convolution_phase_at(float z, float span)
{
    float angle = trigonometry_half_pi * span * z;
    cosine_sine first = polynomial_cosine_sine(angle);
    cosine_sine step = polynomial_cosine_sine(2.0f * angle);
    convolution_phase r;
    r.cosine = first.cosine;
    r.sine = first.sine;
    r.step_cosine = step.cosine;
    r.step_sine = step.sine;
    return r;
}

/// The phase of the first term of the texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane.
inline convolution_phase convolution_encode(float z, convolution_settings settings)
{
    return convolution_phase_at(clamp_or_high(z, -1.0f, 1.0f), settings.span);
}

/// The phase of the next term, by rotation.
/// Error: of both values of term k, 8 k 2^-p.
inline convolution_phase convolution_next(convolution_phase phase)
{
    convolution_phase r = phase;
    r.cosine = phase.cosine * phase.step_cosine - phase.sine * phase.step_sine;
    r.sine = phase.sine * phase.step_cosine + phase.cosine * phase.step_sine;
    return r;
}

/// The weight w_k with its damping, k = 1, 2, ...: constant over texels and receivers, so best computed once.
/// Domain: terms at least 1, damping at least 0. An infinite damping leaves no term, and the series is 1/2.
/// NaN: NaN, which makes everything lit.
inline float convolution_weight(float k, convolution_settings settings)
{
    float ratio = k / settings.terms;
    return trigonometry_two_over_pi * polynomial_exp(-settings.damping * (ratio * ratio)) / (2.0f * k - 1.0f);
}

/// The receiver's phase at the next term, and the sum so far.
struct convolution_sum
{
    convolution_phase receiver;
    float intensity;
};

/// The state before the first term.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: lit, also for an offset or span of NaN.
inline convolution_sum convolution_begin(float z_f, convolution_settings settings)
{
    convolution_sum r;
    r.receiver = convolution_phase_at(clamp_or_nan(z_f, -1.0f, 1.0f) - settings.offset, settings.span);
    r.intensity = 0.5f;
    return r;
}

/// The state after the next term of the filtered map.
inline convolution_sum convolution_add(convolution_sum state, float cosine, float sine, float weight)
{
    state.intensity = state.intensity + weight * (state.receiver.sine * cosine - state.receiver.cosine * sine);
    state.receiver = convolution_next(state.receiver);
    return state;
}

/// Shadow intensity in [0, 1].
/// NaN: 0, lit.
/// Error: against the exact series over 16 terms, 150 2^-p.
/// Source: Annen 2007, Sec. 3
inline float convolution_end(convolution_sum state) { return saturate_or_zero(state.intensity); }

} // namespace gnomon

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

namespace gnomon {

struct channels1 { float c1; };

struct channels2 { float c1, c2; };

struct channels5 { float c1, c2, c3, c4, c5; };

} // namespace gnomon

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

namespace gnomon {

struct channels4 { float c1, c2, c3, c4; };

} // namespace gnomon

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

namespace gnomon {

struct channels6 { float c1, c2, c3, c4, c5, c6; };

} // namespace gnomon

#endif

// storage/convolution.h -----------------------------------------------------------------------------------------------
// Convolution shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels to a
// shadow, with the settings of the format.
//
//   format         bytes   channels                            write                       read
//   32 x 8 UNORM    32     (1 + value) / 2: 16 cosines, sines  convolution_unorm8_encode   convolution_unorm8_intensity
//
// A texel is eight textures of four channels (Klehm, Seidel & Eisemann 2014): cosine and sine of term 1, then of term
// 2, and so on. The series is neither damped nor sharpened. Its span leaves a 16th of the half period free, and its
// offset is that of convolution_settings. A lit surface is darkened by the ripple of 16 terms and by rounding to 8
// bits.
#ifndef GNOMON_STORAGE_CONVOLUTION_H
#define GNOMON_STORAGE_CONVOLUTION_H

namespace gnomon {

/// Eight textures of four channels.
struct channels32 { channels4 t1, t2, t3, t4, t5, t6, t7, t8; };

constant constexpr float convolution_unorm8_offset = 0.04088048903297681f; // 1.92644766 / (pi terms span)
constant constexpr float convolution_unorm8_darkening = 0.055f;
constant constexpr float convolution_unorm8_weight1 = 0.6366197723675814f;
constant constexpr float convolution_unorm8_weight2 = 0.2122065907891938f;
constant constexpr float convolution_unorm8_weight3 = 0.12732395447351627f;
constant constexpr float convolution_unorm8_weight4 = 0.09094568176679733f;
constant constexpr float convolution_unorm8_weight5 = 0.0707355302630646f;
constant constexpr float convolution_unorm8_weight6 = 0.05787452476068922f;
constant constexpr float convolution_unorm8_weight7 = 0.04897075172058318f;
constant constexpr float convolution_unorm8_weight8 = 0.04244131815783876f;
constant constexpr float convolution_unorm8_weight9 = 0.03744822190397538f;
constant constexpr float convolution_unorm8_weight10 = 0.033506303808820075f;
constant constexpr float convolution_unorm8_weight11 = 0.030315227255599115f;
constant constexpr float convolution_unorm8_weight12 = 0.02767912053772093f;
constant constexpr float convolution_unorm8_weight13 = 0.025464790894703257f;
constant constexpr float convolution_unorm8_weight14 = 0.0235785100876882f;
constant constexpr float convolution_unorm8_weight15 = 0.021952405943709702f;
constant constexpr float convolution_unorm8_weight16 = 0.020536121689276817f;

/// The channels of the term at phase and of the next term.
inline channels4 convolution_unorm8_encode_two(convolution_phase phase)
{
    convolution_phase next = convolution_next(phase);
    channels4 c;
    c.c1 = 0.5f * phase.cosine + 0.5f;
    c.c2 = 0.5f * phase.sine + 0.5f;
    c.c3 = 0.5f * next.cosine + 0.5f;
    c.c4 = 0.5f * next.sine + 0.5f;
    return c;
}

/// The phase two terms on.
inline convolution_phase convolution_unorm8_next_two(convolution_phase phase)
{
    return convolution_next(convolution_next(phase));
}

/// The 32 channels of a 32 x 8 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as convolution_next.
/// Source: Annen 2007, Sec. 3
inline channels32 convolution_unorm8_encode(float z)
{
    convolution_settings settings;
    settings.terms = 16.0f;
    settings.damping = 0.0f;
    settings.offset = convolution_unorm8_offset;
    settings.span = 0.9375f;
    convolution_phase phase = convolution_encode(z, settings);
    channels32 c;
    c.t1 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t2 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t3 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t4 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t5 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t6 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t7 = convolution_unorm8_encode_two(phase);
    phase = convolution_unorm8_next_two(phase);
    c.t8 = convolution_unorm8_encode_two(phase);
    return c;
}

/// The sum after two terms with their channels and weights.
inline convolution_sum convolution_unorm8_add_two(convolution_sum state, channels4 c, float weight, float next_weight)
{
    state = convolution_add(state, 2.0f * c.c1 - 1.0f, 2.0f * c.c2 - 1.0f, weight);
    return convolution_add(state, 2.0f * c.c3 - 1.0f, 2.0f * c.c4 - 1.0f, next_weight);
}

/// The series at depth z_f, with an offset, from the channels of a 32 x 8 UNORM texel.
inline float convolution_unorm8_series(channels32 c, float z_f, float offset)
{
    convolution_settings settings;
    settings.terms = 16.0f;
    settings.damping = 0.0f;
    settings.offset = offset;
    settings.span = 0.9375f;
    convolution_sum state = convolution_begin(z_f, settings);
    state = convolution_unorm8_add_two(state, c.t1, convolution_unorm8_weight1, convolution_unorm8_weight2);
    state = convolution_unorm8_add_two(state, c.t2, convolution_unorm8_weight3, convolution_unorm8_weight4);
    state = convolution_unorm8_add_two(state, c.t3, convolution_unorm8_weight5, convolution_unorm8_weight6);
    state = convolution_unorm8_add_two(state, c.t4, convolution_unorm8_weight7, convolution_unorm8_weight8);
    state = convolution_unorm8_add_two(state, c.t5, convolution_unorm8_weight9, convolution_unorm8_weight10);
    state = convolution_unorm8_add_two(state, c.t6, convolution_unorm8_weight11, convolution_unorm8_weight12);
    state = convolution_unorm8_add_two(state, c.t7, convolution_unorm8_weight13, convolution_unorm8_weight14);
    state = convolution_unorm8_add_two(state, c.t8, convolution_unorm8_weight15, convolution_unorm8_weight16);
    return convolution_end(state);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 32 x 8 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
inline float convolution_unorm8_intensity(channels32 c, float z_f)
{
    return convolution_unorm8_series(c, z_f, convolution_unorm8_offset);
}

/// Shadow intensity in [0, 1] as convolution_unorm8_intensity, but with the edge of the wave at z_f itself, where the
/// intensity is 1/2: for receivers in air, as of single scattering, which are in no map.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
/// Source: Peters 2017, Sec. 5.5.1
inline float convolution_unorm8_centred_intensity(channels32 c, float z_f)
{
    return convolution_unorm8_series(c, z_f, 0.0f);
}

} // namespace gnomon

#endif

#endif
