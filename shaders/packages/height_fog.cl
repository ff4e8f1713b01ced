// Gnomon 0.1.0, height_fog.cl: shadow filtering in OpenCL C, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_HEIGHT_FOG_CL
#define GNOMON_HEIGHT_FOG_CL

// the language --------------------------------------------------------------------------------------------------------
// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#error "gnomon: height_fog.cl is OpenCL C; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: height_fog.cl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: height_fog.cl is not of the same version as a package before it"
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
static inline float nearest_integer(float x)
{
    float rounder = -12582912.0f;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
static inline float nearest_natural(float x)
{
    float rounder = 8388608.0f;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

__constant float gnomon_exp_log2_e = 1.4426950408889634f;
__constant float gnomon_exp_ln2_low = -2.1219444005469058e-4f;
__constant float gnomon_exp_sqrt_2 = 1.4142135623730951f;
__constant float gnomon_exp_sqrt_half = 0.70710678118654752f;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
__constant float gnomon_exp_float_0 = 0.49999993561656014f;
__constant float gnomon_exp_float_1 = 0.16666518908321371f;
__constant float gnomon_exp_float_2 = 0.041668318723256166f;
__constant float gnomon_exp_float_3 = 0.0083689258101569408f;
__constant float gnomon_exp_float_4 = 0.00138210541669496f;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
__constant float gnomon_log_float_0 = 0.66666776085218282f;
__constant float gnomon_log_float_1 = 0.39977574040563962f;
__constant float gnomon_log_float_2 = 0.29870936689734456f;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
static inline float gnomon_exp_remainder(float r)
{
    float p = gnomon_exp_float_0 + r *
              (gnomon_exp_float_1 + r * (gnomon_exp_float_2 + r * (gnomon_exp_float_3 + r * gnomon_exp_float_4)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
static inline float polynomial_exp(float x)
{
    float low = -87.0f;
    float high = 88.0f;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375f) - n * gnomon_exp_ln2_low;
    return (1.0f + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
typedef struct gnomon_scaled_number gnomon_scaled_number;
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
static inline gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
{
    float up = gnomon_power_of_two(k);
    float down = gnomon_power_of_two(-k);
    bool large = up <= s.significand;
    bool tiny = s.significand <= down;
    gnomon_scaled_number r;
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
static inline float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0f;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0f), gnomon_power_of_two(127.0f));
    s = gnomon_scaled_number_step(s, 64.0f);
    s = gnomon_scaled_number_step(s, 32.0f);
    s = gnomon_scaled_number_step(s, 16.0f);
    s = gnomon_scaled_number_step(s, 8.0f);
    s = gnomon_scaled_number_step(s, 4.0f);
    s = gnomon_scaled_number_step(s, 2.0f);
    s = gnomon_scaled_number_step(s, 1.0f);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5f, gnomon_select(tiny, s.significand * 2.0f, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0f, gnomon_select(tiny, s.exponent - 1.0f, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0f;
    float y = f / (2.0f + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5f * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375f - ((square - rest) - f);
}

#endif

// scattering/single_scattering.h --------------------------------------------------------------------------------------
// Single scattering of a directional light in a homogeneous medium along a view ray (Peters et al. 2017, Sec. 5.1.1 and
// 5.3.1):
//
//     radiance = e^(-extinction s) surface + scattering phase irradiance (1 - e^(-extinction s)) / extinction (1 -
// intensity)
//
// over a distance s, where intensity is the shadow of the ray, weighted by transmittance. extinction and scattering are
// per unit of length, and scattering is the albedo times extinction: the paper's formula has no such factor, its phase
// function holds the scattering coefficient. Light is not attenuated on its way from the light source to the view ray.
//
// omega_l is the direction to the light, omega_p that to the camera. Along a view ray with the polar angle theta
// (rectified.h) omega_l.omega_p = cos theta: 1 looking along the light, -1 looking into it. Phase functions take the
// cosine of the scattering angle, -omega_l.omega_p = -cos theta: light that goes straight on to the camera has 1.
#ifndef GNOMON_SCATTERING_SINGLE_SCATTERING_H
#define GNOMON_SCATTERING_SINGLE_SCATTERING_H

__constant float gnomon_phase_isotropic = 0.079577471545947668f; // 1 / (4 pi), for every angle
__constant float gnomon_phase_greatest_asymmetry = 0.9990234375f;

/// The integral of the transmittance along a ray, (1 - e^(-extinction distance)) / extinction, without cancellation:
/// the length of a ray without extinction that scatters as much. In [0, distance].
/// Domain: both at least 0, also infinite; negative numbers count as 0.
/// NaN: as 0.
/// Error: 4.5 ulp.
static inline float attenuated_length(float distance_, float extinction)
{
    float whole = gnomon_max(distance_, 0.0f);
    float rate = gnomon_max(extinction, 0.0f);
    float depth = gnomon_max(rate * whole, 0.0f);
    bool thin = depth < 0.34375f;
    float r = -1.0f * gnomon_select(thin, depth, 0.0f);
    float thick = (1.0f - polynomial_exp(-1.0f * depth)) / gnomon_select(thin, 1.0f, rate);
    return gnomon_select(thin, whole * (1.0f + r * gnomon_exp_remainder(r)), thick);
}

/// (1 - e^-x) / x, the mean transmittance along a ray of the optical depth x, in [0, 1]; 1 for 0, without cancellation.
/// Domain: x at least 0, also infinite; negative x counts as 0.
/// NaN: 1.
/// Error: 3.5 ulp.
static inline float attenuated_mean(float x) { return saturate_or_zero(attenuated_length(1.0f, x)); }

/// e^-x, the transmittance of the optical depth x, in [0, 1].
/// Domain: x at least 0, also infinite; negative x counts as 0. Not below e^-87 in float, e^-708 in double.
/// NaN: 1.
/// Error: 1 ulp in float, 1.2 ulp in double.
static inline float transmittance_over(float x)
{
    return saturate_or_zero(polynomial_exp(-1.0f * gnomon_max(x, 0.0f)));
}

/// The Henyey-Greenstein phase function, per steradian, of the cosine of the scattering angle. asymmetry is its mean
/// cosine: positive for media that scatter forward, 0 for isotropic ones.
/// Domain: cosine in [-1, 1], asymmetry in [-1 + 2^-10, 1 - 2^-10], clamped.
/// NaN: NaN for a cosine of NaN; an asymmetry of NaN counts as 0.
/// Error: relative, 10 2^-p for |asymmetry| <= 1/2.
/// Source: Henyey & Greenstein 1941
static inline float phase_henyey_greenstein(float cosine, float asymmetry)
{
    float c = clamp_or_nan(cosine, -1.0f, 1.0f);
    float g = gnomon_min(gnomon_max(gnomon_abs(asymmetry), 0.0f), gnomon_phase_greatest_asymmetry);
    float off = 1.0f - gnomon_select(asymmetry < 0.0f, -1.0f * c, c);
    float rest = 1.0f - g;
    float d = rest * rest + (g + g) * off;
    return gnomon_phase_isotropic * (rest * (1.0f + g)) / (d * gnomon_sqrt(d));
}

/// The overestimation of visibility for the ray of a polar angle with this cosine, (1 + cosine) / 2, for
/// bounds_intensity. 0 for a ray that looks into the light, in front of which no occluder can be in depth: no light
/// leaks. 1 for a ray along the light, behind which none can be: no light is lost.
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
/// Source: Peters 2017, Sec. 5.3.1
static inline float adaptive_overestimation(float cosine) { return 1.0f - saturate_or_zero(0.5f - 0.5f * cosine); }

/// The overestimation of visibility that is adaptive_overestimation for rays along the light, and (1 + cosine^5) / 2
/// for rays towards it. That is close to 1/2, which halves the worst error, but for rays that nearly look into the
/// light. Shown visibility exceeds its lower bound by this share of the weight at the ray: within 5 degrees of looking
/// into the light at most 1% leaks for any occluders. Along the light 1/2 errs more: most of the surfaces that are
/// close to the ray in depth are behind it, where the ray ends (tests/scattering/overestimation.cpp).
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
static inline float plateau_overestimation(float cosine)
{
    float c = clamp_or_high(cosine, -1.0f, 1.0f);
    float square = c * c;
    return adaptive_overestimation(gnomon_select(c < 0.0f, square * square * c, c));
}

/// Radiance that reaches the camera: that of the surface, attenuated, and light scattered into the view ray. intensity
/// is the shadow of the ray, 0 where all of the ray is lit.
/// Domain: distance, extinction, scattering, phase, irradiance and surface at least 0 and finite.
/// NaN: an intensity of NaN counts as 0.
/// Error: relative, 9 2^-p for optical depths up to 1.
/// Source: Peters 2017, Sec. 5.1.1
static inline float scattering_radiance(float surface, float intensity, float distance_, float extinction,
                                        float scattering, float phase, float irradiance)
{
    float depth = extinction * distance_;
    float lit = (scattering * phase * irradiance) * attenuated_length(distance_, extinction);
    return transmittance_over(depth) * surface + lit * (1.0f - saturate_or_zero(intensity));
}

#endif

// scattering/height_fog.h ---------------------------------------------------------------------------------------------
// Height fog: a medium whose density falls exponentially with height, seen along a view ray. The paper covers
// homogeneous media only (scattering/single_scattering.h). Along a ray that rises by rise for each unit of length, a
// density e^(-falloff height) is e^(-decay t) at the distance t, relative to the density at the eye, with decay =
// falloff rise. A ray that descends has a negative decay. Up to a distance s the ray crosses as much of the medium as
// in a homogeneous medium of the density at the eye over the length
//
//     amount(s) = (1 - e^(-decay s)) / decay
//
// so scattering_radiance serves with amount(s) for the distance, and with extinction and scattering at the eye.
//
// The map of prefix averages has the same layout and other weights: a texel that the ray crosses from s to t scatters
//     e^(-extinction amount(s)) (1 - e^(-extinction (amount(t) - amount(s)))) / extinction
// and transmittance_share_add sums these weights.
//
// A row has one set of weights, those of the ray in the middle of its range, and serves rays of other polar angles,
// too. In a homogeneous medium these rays cross the texels in other steps. In fog they also cross a texel at another
// height, unless the light is horizontal and light rays keep their height: the higher the light, the greater the error.
// scattering_radiance has no such error, since its distance is that of the ray itself. Attenuation on the way from the
// light to the view ray is not covered.
#ifndef GNOMON_SCATTERING_HEIGHT_FOG_H
#define GNOMON_SCATTERING_HEIGHT_FOG_H

/// The amount of medium along a ray between two distances from the eye: the length of a homogeneous medium of the
/// density at the eye that holds as much.
/// At least 0, never NaN.
/// Domain: 0 <= first <= last, any decay; decay times either distance is clamped to [-88, 87] in float, [-709, 708] in
/// double.
/// NaN: 0 for a distance of NaN; a decay of NaN counts as 0.
/// Error: relative, (8 + 2 decay last) 2^-p, by the magnitude of decay.
static inline float height_fog_amount(float first, float last, float decay)
{
    // From the denser of the two ends on, the medium is attenuated as light is.
    float densest = gnomon_select(decay < 0.0f, last, first);
    float thinner = decay * densest;
    return polynomial_exp(-1.0f * gnomon_select(thinner == thinner, thinner, 0.0f)) *
           attenuated_length(last - first, gnomon_abs(decay));
}

/// The weight of a texel that a ray crosses between two distances from the eye: the light scattered there and
/// transmitted to the eye, as the length over which a medium of the density at the eye would scatter as much without
/// extinction. In [0, amount] up to the error. extinction is that at the eye.
/// Domain: as for height_fog_amount; extinction at least 0.
/// NaN: 0 for a distance of NaN; a decay or an extinction of NaN counts as 0.
/// Error: relative, (1 + optical depth) (16 + 4 decay last) 2^-p, by the magnitude of decay.
static inline float height_fog_weight(float first, float last, float decay, float extinction)
{
    float before = transmittance_over(extinction * height_fog_amount(0.0f, first, decay));
    return before * attenuated_length(height_fog_amount(first, last, decay), extinction);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length, as transmittance_weight_between in a homogeneous medium. In [0, 1].
/// Domain: before and length at least 0; f in [0, 1], clamped; decay and extinction as for height_fog_weight.
/// NaN: 0, also where before and f are 0, or extinction is infinite.
/// Error: (64 + 16 (1 + optical depth) decay (before + length)) 2^-p, by the magnitude of decay.
static inline float height_fog_weight_between(float before, float length_, float f, float decay, float extinction)
{
    float none = 0.0f;
    float part = saturate_or_zero(f) * length_;
    float falls = decay * before;
    float density = polynomial_exp(-1.0f * gnomon_select(falls == falls, falls, none));
    float above = attenuated_length(density * height_fog_amount(none, part, decay), extinction) *
                  attenuated_length(height_fog_amount(none, before + length_, decay), extinction);
    float below = attenuated_length(height_fog_amount(none, before + part, decay), extinction) *
                  attenuated_length(density * height_fog_amount(none, length_, decay), extinction);
    return saturate_or_zero(above / below);
}

#endif

#endif
