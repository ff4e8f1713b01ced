// Gnomon 0.1.0, gnomon.glsl: shadow filtering in GLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_GNOMON_GLSL
#define GNOMON_GNOMON_GLSL

// the language --------------------------------------------------------------------------------------------------------
// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#if defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)
#error "gnomon: gnomon.glsl is GLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: gnomon.glsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: gnomon.glsl is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 300
#error "gnomon: #version 300 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 330
#error "gnomon: #version 330 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

const float gnomon_pivot_floor = 9.31322574615478515625e-10; // 2^-30

float gnomon_select(bool mask, float a, float b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
float gnomon_abs(float a) { return abs(a); }
float gnomon_sqrt(float a) { return sqrt(a); }

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
float gnomon_kept(float x) { return intBitsToFloat(min(floatBitsToInt(x), 0x7FC00000)); }
float gnomon_apart(float x) { return uintBitsToFloat(min(floatBitsToUint(x), 0xFFC00000u)); }
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
    int bits = floatBitsToInt(x);
    return gnomon_select(bits > 0x7F800000, 0.0, intBitsToFloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
float gnomon_high_part(float a) { return uintBitsToFloat(floatBitsToUint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
float gnomon_power_of_two(float n) { return uintBitsToFloat((floatBitsToUint(n + 12582912.0) << 23u) + 0x3F800000u); }

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
float nearest_integer(float x)
{
    float rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
float nearest_natural(float x)
{
    float rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

const float gnomon_exp_log2_e = 1.4426950408889634;
const float gnomon_exp_ln2_low = -2.1219444005469058e-4;
const float gnomon_exp_sqrt_2 = 1.4142135623730951;
const float gnomon_exp_sqrt_half = 0.70710678118654752;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
const float gnomon_exp_float_0 = 0.49999993561656014;
const float gnomon_exp_float_1 = 0.16666518908321371;
const float gnomon_exp_float_2 = 0.041668318723256166;
const float gnomon_exp_float_3 = 0.0083689258101569408;
const float gnomon_exp_float_4 = 0.00138210541669496;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
const float gnomon_log_float_0 = 0.66666776085218282;
const float gnomon_log_float_1 = 0.39977574040563962;
const float gnomon_log_float_2 = 0.29870936689734456;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
float gnomon_exp_remainder(float r)
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
float polynomial_exp(float x)
{
    float low = -87.0;
    float high = 88.0;
    x = clamp_or_nan(x, low, high);
    float n = nearest_integer(x * gnomon_exp_log2_e);
    float r = gnomon_difference(x, n * 0.693359375) - n * gnomon_exp_ln2_low;
    return (1.0 + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct gnomon_scaled_number { float significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
gnomon_scaled_number gnomon_scaled_number_step(gnomon_scaled_number s, float k)
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
float polynomial_log(float x)
{
    gnomon_scaled_number s;
    s.exponent = 0.0;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0), gnomon_power_of_two(127.0));
    s = gnomon_scaled_number_step(s, 64.0);
    s = gnomon_scaled_number_step(s, 32.0);
    s = gnomon_scaled_number_step(s, 16.0);
    s = gnomon_scaled_number_step(s, 8.0);
    s = gnomon_scaled_number_step(s, 4.0);
    s = gnomon_scaled_number_step(s, 2.0);
    s = gnomon_scaled_number_step(s, 1.0);
    bool large = gnomon_exp_sqrt_2 < s.significand;
    bool tiny = s.significand < gnomon_exp_sqrt_half;
    float m = gnomon_select(large, s.significand * 0.5, gnomon_select(tiny, s.significand * 2.0, s.significand));
    float n = gnomon_select(large, s.exponent + 1.0, gnomon_select(tiny, s.exponent - 1.0, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    float f = m - 1.0;
    float y = f / (2.0 + f);
    float z = y * y;
    float p = gnomon_log_float_0 + z * (gnomon_log_float_1 + z * gnomon_log_float_2);
    float square = 0.5 * f * f;
    float rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375 - ((square - rest) - f);
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

const float gnomon_phase_isotropic = 0.079577471545947668; // 1 / (4 pi), for every angle
const float gnomon_phase_greatest_asymmetry = 0.9990234375;

/// The integral of the transmittance along a ray, (1 - e^(-extinction distance)) / extinction, without cancellation:
/// the length of a ray without extinction that scatters as much. In [0, distance].
/// Domain: both at least 0, also infinite; negative numbers count as 0.
/// NaN: as 0.
/// Error: 4.5 ulp.
float attenuated_length(float distance_, float extinction)
{
    float whole = gnomon_max(distance_, 0.0);
    float rate = gnomon_max(extinction, 0.0);
    float depth = gnomon_max(rate * whole, 0.0);
    bool thin = depth < 0.34375;
    float r = -1.0 * gnomon_select(thin, depth, 0.0);
    float thick = (1.0 - polynomial_exp(-1.0 * depth)) / gnomon_select(thin, 1.0, rate);
    return gnomon_select(thin, whole * (1.0 + r * gnomon_exp_remainder(r)), thick);
}

/// (1 - e^-x) / x, the mean transmittance along a ray of the optical depth x, in [0, 1]; 1 for 0, without cancellation.
/// Domain: x at least 0, also infinite; negative x counts as 0.
/// NaN: 1.
/// Error: 3.5 ulp.
float attenuated_mean(float x) { return saturate_or_zero(attenuated_length(1.0, x)); }

/// e^-x, the transmittance of the optical depth x, in [0, 1].
/// Domain: x at least 0, also infinite; negative x counts as 0. Not below e^-87 in float, e^-708 in double.
/// NaN: 1.
/// Error: 1 ulp in float, 1.2 ulp in double.
float transmittance_over(float x) { return saturate_or_zero(polynomial_exp(-1.0 * gnomon_max(x, 0.0))); }

/// The Henyey-Greenstein phase function, per steradian, of the cosine of the scattering angle. asymmetry is its mean
/// cosine: positive for media that scatter forward, 0 for isotropic ones.
/// Domain: cosine in [-1, 1], asymmetry in [-1 + 2^-10, 1 - 2^-10], clamped.
/// NaN: NaN for a cosine of NaN; an asymmetry of NaN counts as 0.
/// Error: relative, 10 2^-p for |asymmetry| <= 1/2.
/// Source: Henyey & Greenstein 1941
float phase_henyey_greenstein(float cosine, float asymmetry)
{
    float c = clamp_or_nan(cosine, -1.0, 1.0);
    float g = gnomon_min(gnomon_max(gnomon_abs(asymmetry), 0.0), gnomon_phase_greatest_asymmetry);
    float off = 1.0 - gnomon_select(asymmetry < 0.0, -1.0 * c, c);
    float rest = 1.0 - g;
    float d = rest * rest + (g + g) * off;
    return gnomon_phase_isotropic * (rest * (1.0 + g)) / (d * gnomon_sqrt(d));
}

/// The overestimation of visibility for the ray of a polar angle with this cosine, (1 + cosine) / 2, for
/// bounds_intensity. 0 for a ray that looks into the light, in front of which no occluder can be in depth: no light
/// leaks. 1 for a ray along the light, behind which none can be: no light is lost.
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
/// Source: Peters 2017, Sec. 5.3.1
float adaptive_overestimation(float cosine) { return 1.0 - saturate_or_zero(0.5 - 0.5 * cosine); }

/// The overestimation of visibility that is adaptive_overestimation for rays along the light, and (1 + cosine^5) / 2
/// for rays towards it. That is close to 1/2, which halves the worst error, but for rays that nearly look into the
/// light. Shown visibility exceeds its lower bound by this share of the weight at the ray: within 5 degrees of looking
/// into the light at most 1% leaks for any occluders. Along the light 1/2 errs more: most of the surfaces that are
/// close to the ray in depth are behind it, where the ray ends (tests/scattering/overestimation.cpp).
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
float plateau_overestimation(float cosine)
{
    float c = clamp_or_high(cosine, -1.0, 1.0);
    float square = c * c;
    return adaptive_overestimation(gnomon_select(c < 0.0, square * square * c, c));
}

/// Radiance that reaches the camera: that of the surface, attenuated, and light scattered into the view ray. intensity
/// is the shadow of the ray, 0 where all of the ray is lit.
/// Domain: distance, extinction, scattering, phase, irradiance and surface at least 0 and finite.
/// NaN: an intensity of NaN counts as 0.
/// Error: relative, 9 2^-p for optical depths up to 1.
/// Source: Peters 2017, Sec. 5.1.1
float scattering_radiance(float surface, float intensity, float distance_, float extinction, float scattering,
                          float phase, float irradiance)
{
    float depth = extinction * distance_;
    float lit = (scattering * phase * irradiance) * attenuated_length(distance_, extinction);
    return transmittance_over(depth) * surface + lit * (1.0 - saturate_or_zero(intensity));
}

#endif

// scattering/transmittance_weights.h ----------------------------------------------------------------------------------
// Weights of prefix averages along the rows of a rectified map (Peters et al. 2017, Sec. 5.1.1). Texel u has the weight
// w_u, and the average up to texel u is the one before, moved towards texel u by its share of the sum of weights:
//
//     mean_u = mean_(u - 1) + g_u (texel_u - mean_(u - 1)),        g_u = w_u / (w_0 + ... + w_u),        g_0 = 1
//
// All g_u are in [0, 1], so that prefix averages of moments are moments. In a homogeneous medium texel u is seen
// through u texels of the medium: w_u = q^u up to a factor that cancels, so that
//
//     g_u = q g_(u - 1) / (1 + q g_(u - 1)),        q = transmittance of one texel
//
// holds for every extinction: q = 1 without any, q = 0 in an opaque medium. Weights that vary from texel to texel, as
// those of scattering/height_fog.h, are summed by transmittance_share_add.
//
//     (for a row)   q = transmittance_step(extinction, radius_step, mean sine of the row's polar angles)
//     (for u > 0)   g = transmittance_weight_next(g, q);   mean = mean + g (texel - mean)
//
// A ray that ends within texel u, a share f of it, has an average between that of texel u - 1 and that of texel u, but
// not at f: transmittance_weight_within is exact. transmittance_weight_between is exact between averages over any two
// distances, as in mips.
#ifndef GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H
#define GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H

/// The transmittance of the medium from one texel of a row to the next, in [0, 1]. extinction is per unit of length;
/// the view ray crosses the texels of radius_step at an angle to the light that has this sine.
/// Domain: at least 0, also infinite; negative numbers count as 0.
/// NaN: 1, also where an extinction of 0 meets a sine of 0.
/// Error: relative, 2.5 2^-p for each unit of the optical depth extinction radius_step / sine, and 2 2^-p.
/// Source: Peters 2017, Sec. 5.1.1
float transmittance_step(float extinction, float radius_step, float sine)
{
    return transmittance_over((extinction * radius_step) / sine);
}

/// The share g_u of texel u in its prefix average, from the share g of the texel before and the ratio of their weights,
/// q. In [0, 1].
/// Domain: g and q in [0, 1], clamped.
/// NaN: 0.
/// Error: relative, 3 2^-p beside those of g and q; 256 2^-p after 1024 texels.
float transmittance_weight_next(float g, float q)
{
    float next = saturate_or_zero(q) * saturate_or_zero(g);
    return next / (1.0 + next);
}

/// The share of the way from the average before a texel to the one up to it, for a ray that ends a share f within the
/// texel: v / (1 - g + g v), v = (1 - q^f) / (1 - q), where g is the share of the texel. In [0, 1].
/// Domain: g, q and f in [0, 1], clamped.
/// NaN: as 0 for g and f, as 1 for q.
/// Error: 8 2^-p.
float transmittance_weight_within(float g, float q, float f)
{
    float share = saturate_or_zero(f);
    float depth = -1.0 * polynomial_log(gnomon_min(q, 1.0));
    float v = gnomon_min(1.0, share * attenuated_mean(share * depth) / attenuated_mean(depth));
    float last = saturate_or_zero(g);
    float rest = (1.0 - last) + last * v;
    return gnomon_select(0.0 < rest, saturate_or_zero(v / rest), 1.0);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length: exact where light and shadow do not change along the length. Distances are in texels of
/// that optical depth. For one texel this is transmittance_weight_within without the shares of the texels before. In
/// [0, 1].
/// Domain: before, length and optical_depth at least 0, the last also infinite; f in [0, 1], clamped.
/// NaN: 0, also where before and f are 0, or optical_depth is infinite.
/// Error: 24 2^-p.
float transmittance_weight_between(float before, float length_, float f, float optical_depth)
{
    float part = saturate_or_zero(f) * length_;
    float above = attenuated_length(part, optical_depth) * attenuated_length(before + length_, optical_depth);
    float below = attenuated_length(before + part, optical_depth) * attenuated_length(length_, optical_depth);
    return saturate_or_zero(above / below);
}

/// A sum of weights, and the share in it of the weight that was added last.
struct gnomon_transmittance_share { float total, share; };

/// The state after the first texel of a row, whose share is 1.
/// Domain: a weight of at least 0; negative weights count as 0.
/// NaN: a weight of 0.
gnomon_transmittance_share transmittance_share_begin(float weight)
{
    gnomon_transmittance_share r;
    r.total = gnomon_max(weight, 0.0);
    r.share = 1.0;
    return r;
}

/// The state after one more texel with a weight. Its share, in [0, 1], is 1 while all weights are 0.
/// Domain: as for transmittance_share_begin. While the sum is not finite the share is 0.
/// NaN: a weight of 0.
/// Error: relative, one rounding for each texel.
gnomon_transmittance_share transmittance_share_add(gnomon_transmittance_share state, float weight)
{
    float added = gnomon_max(weight, 0.0);
    gnomon_transmittance_share r;
    r.total = state.total + added;
    r.share = saturate_or_zero(added / r.total);
    r.share = gnomon_select(r.total == 0.0, 1.0, r.share);
    return r;
}

#endif

// comparators/froxels.h -----------------------------------------------------------------------------------------------
// Single scattering by a grid of froxels (Wronski 2014), which most engines use: cells of the view frustum, few columns
// of pixels wide, in slices whose thickness grows with the distance. Each froxel looks up the shadow map once; slice by
// slice the intensities are averaged from the camera on, and each pixel interpolates between averages.
//
//     slices = froxel_slices_from(nearest, farthest, count);
//     (slice k = 0)   sum = transmittance_share_begin(froxel_weight(extinction, 0, froxel_distance(0, slices)));
//     (slice k > 0)   sum = transmittance_share_add(sum, froxel_weight(extinction, froxel_distance(k - 1, slices),
//                                                                      froxel_distance(k, slices)));
//                     mean = mean + sum.share (intensity of the froxel - mean)
//     (for a pixel)   mean at slice froxel_slice_of(distance, slices), interpolated between slices and columns
//
// Distances are from the camera, so that slices are spheres, and the weights of a slice are those of all its froxels.
// Slice 0 reaches from the camera to the nearest distance. passes/froxels.hpp does the same over a whole grid.
#ifndef GNOMON_COMPARATORS_FROXELS_H
#define GNOMON_COMPARATORS_FROXELS_H

/// The end of slice 0, the logarithm of the quotient of the ends of neighbouring slices, and the last slice.
struct gnomon_froxel_slices { float nearest, growth, last; };

/// Slices of which the first ends at nearest and the last at farthest.
/// Domain: nearest and farthest in [2^-60, 2^60] with nearest <= farthest, and 2 to 65536 slices; others are limited to
/// that.
/// NaN: the upper limit.
/// Source: Wronski 2014
gnomon_froxel_slices froxel_slices_from(float nearest, float farthest, float count)
{
    gnomon_froxel_slices r;
    float least = gnomon_power_of_two(-60.0);
    float most = gnomon_power_of_two(60.0);
    r.nearest = clamp_or_high(nearest, least, most);
    r.last = clamp_or_high(count, 2.0, 65536.0) - 1.0;
    float quotient = clamp_or_high(farthest, r.nearest, most) / r.nearest;
    r.growth = polynomial_log(quotient) / r.last;
    return r;
}

/// The distance at which slice k ends.
/// Domain: k limited to the slices.
/// NaN: the end of the last slice.
/// Error: relative, 2^(7 - p).
float froxel_distance(float k, gnomon_froxel_slices slices)
{
    return slices.nearest * polynomial_exp(clamp_or_high(k, 0.0, slices.last) * slices.growth);
}

/// The slice that ends at this distance, with a fraction between two ends.
/// Domain: any distance, limited to the ends of the first and of the last slice.
/// NaN: the last slice.
/// Error: 2^(7 - p) of the last slice.
float froxel_slice_of(float distance_, gnomon_froxel_slices slices)
{
    float slice = polynomial_log(distance_ / slices.nearest) / slices.growth;
    return clamp_or_high(slice, 0.0, slices.last);
}

/// Light scattered to the camera between two distances, relative to that of clear air of unit length: the weight of a
/// froxel's intensity in its column.
/// Domain: extinction and distances at least 0, nearer <= farther.
/// NaN: 0 for a distance; an extinction of NaN counts as 0.
/// Error: relative, 8 2^-p for optical depths up to 1.
/// Source: Hillaire 2015
float froxel_weight(float extinction, float nearer, float farther)
{
    return transmittance_over(extinction * nearer) * attenuated_length(farther - nearer, extinction);
}

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
float depth_from_unit(float z) { return z * 2.0 - 1.0; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
float depth_from_reversed(float z) { return 1.0 - z * 2.0; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
float depth_from_distance(float distance_, float near_distance, float far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
float gnomon_depth_between(float n, float f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
float depth_from_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0 - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
float depth_from_reversed_perspective(float z, float near_distance, float far_distance)
{
    float x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * (1.0 - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
float depth_from_reversed_infinite(float z, float near_distance, float far_distance)
{
    float x = gnomon_abs(clamp_or_nan(z, 0.0, 1.0)); // -0 is the far plane, too
    float depth = (near_distance * (1.0 - x) - (far_distance * x - near_distance)) /
                  (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0, 1.0);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
float depth_from_infinite(float z, float near_distance, float far_distance)
{
    return depth_from_reversed_infinite(1.0 - z, near_distance, far_distance);
}

#endif

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_4
#define GNOMON_MOMENTS_MOMENTS_4

struct moments4 { float b1, b2, b3, b4; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
moments4 moments4_from_depth(float z)
{
    moments4 b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// b times weight: the first term of a linear combination.
moments4 moments4_scale(moments4 b, float weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
moments4 moments4_add(moments4 sum, moments4 b, float weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
moments4 moments4_from_unit(moments4 c)
{
    moments4 b;
    b.b1 = 2.0 * c.b1 - 1.0;
    b.b2 = 4.0 * (c.b2 - c.b1) + 1.0;
    b.b3 = (8.0 * c.b3 - 12.0 * c.b2) + (6.0 * c.b1 - 1.0);
    b.b4 = 16.0 * (c.b4 - 2.0 * c.b3) + (24.0 * c.b2 - 8.0 * c.b1 + 1.0);
    return b;
}

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

struct moments6 { float b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
moments6 moments6_from_depth(float z)
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
moments6 moments6_scale(moments6 b, float weight)
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
moments6 moments6_add(moments6 sum, moments6 b, float weight)
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

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_TRIGONOMETRY_H
#define GNOMON_NUMERICS_TRIGONOMETRY_H

const float gnomon_trigonometry_two_over_pi = 0.63661977236758134;
const float gnomon_trigonometry_half_pi_low = 7.5497899548918821e-8;
const float gnomon_trigonometry_half_pi = 1.5707963267948966;
const float gnomon_trigonometry_quarter_pi_low = 1.5695823932524066e-7;
const float gnomon_trigonometry_tan_pi_8 = 0.41421356237309505;

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
const float gnomon_sin_float_0 = -0.16666654609567105;
const float gnomon_sin_float_1 = 0.0083321607625195058;
const float gnomon_sin_float_2 = -0.00019515283258365583;

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
const float gnomon_cos_float_0 = 0.041666645683017541;
const float gnomon_cos_float_1 = -0.0013887316256332952;
const float gnomon_cos_float_2 = 2.4433157272163749e-05;

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
const float gnomon_atan_float_0 = -0.33333315189495832;
const float gnomon_atan_float_1 = 0.19998471559801789;
const float gnomon_atan_float_2 = -0.14243534037509495;
const float gnomon_atan_float_3 = 0.10593818186484773;
const float gnomon_atan_float_4 = -0.060782316918251741;

/// A cosine and the sine of the same angle.
struct gnomon_cosine_sine { float cosine, sine; };

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
gnomon_cosine_sine polynomial_cosine_sine(float x)
{
    x = clamp_or_nan(x, -8192.0, 8192.0);
    float n = nearest_integer(x * gnomon_trigonometry_two_over_pi);
    float y = gnomon_difference(x, n * 1.5703125);
    y = gnomon_difference(y, n * 0.0004837512969970703125) - n * gnomon_trigonometry_half_pi_low;
    float z = y * y;
    float s = gnomon_sin_float_0 + z * (gnomon_sin_float_1 + z * gnomon_sin_float_2);
    float c = gnomon_cos_float_0 + z * (gnomon_cos_float_1 + z * gnomon_cos_float_2);
    s = y + y * z * s;
    c = (1.0 - 0.5 * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    float m = n - 4.0 * nearest_integer(0.25 * n);
    bool odd = gnomon_abs(m) == 1.0;
    bool opposite = gnomon_abs(m) == 2.0;
    gnomon_cosine_sine r;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
float polynomial_cos(float x) { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
float polynomial_sin(float x) { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
float polynomial_atan2(float y, float x)
{
    float ax = gnomon_abs(x);
    float ay = gnomon_abs(y);
    bool steep = ax < ay;
    float shorter = gnomon_select(steep, ax, ay);
    float longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    bool wide = gnomon_trigonometry_tan_pi_8 * longer < shorter;
    float denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == 0.0, 1.0, longer));
    float t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    float z = t * t;
    float p = gnomon_atan_float_0 + z *
              (gnomon_atan_float_1 + z * (gnomon_atan_float_2 + z * (gnomon_atan_float_3 + z * gnomon_atan_float_4)));
    float angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    float eighths = gnomon_select(wide, 1.0, 0.0);
    angle = gnomon_select(steep, -1.0 * angle, angle);
    eighths = gnomon_select(steep, 2.0 - eighths, eighths);
    angle = gnomon_select(x < 0.0, -1.0 * angle, angle);
    eighths = gnomon_select(x < 0.0, 4.0 - eighths, eighths);
    angle = eighths * 0.785398006439208984375 + (angle + eighths * gnomon_trigonometry_quarter_pi_low);
    return gnomon_select(y < 0.0, -1.0 * angle, angle);
}

#endif

// comparators/hamburger_cholesky.h ------------------------------------------------------------------------------------
// Algorithm 1 of Peters et al. 2017 as the paper states it, for four and for six moments. This is the comparator that
// hamburger4.h and hamburger6.h are measured against, not a route to use. Both kernels need biased moments (bias.h:
// moments4_add_bias, moments6_add_bias) and keep the steps of the paper:
//
//   1, 2  Solve B q = (1, z_f, ..., z_f^(m/2)) by the square-root-free Cholesky decomposition B = L D L^T (Sec. 5.4.1).
//   3     Solve q_0 + q_1 z + ... = 0 for the other depths: a quadratic, or a cubic in closed form (Blinn 2007;
//         Sec. 5.4.1).
//   4, 5  The weights solve a Vandermonde system. The sum of those before z_f is E[u(z)], where the polynomial u is 1
//         at the depths before z_f and 0 at z_f and behind (Sec. 5.4.2).
//
// Only totality is added: singular moments, such as those of a single depth, give 0, lit, even in shadow.
#ifndef GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H
#define GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H

const float gnomon_hamburger_cholesky_third = 0.33333333333333333;
const float gnomon_hamburger_cholesky_sqrt3 = 1.7320508075688773;
const float hamburger_cholesky_epsilon = 1e-3;

/// The two depths other than z_f, z1 <= z2.
struct gnomon_quadratic_nodes { float z1, z2; };

/// The two depths of the distribution of three that has one at z_f and four biased moments.
gnomon_quadratic_nodes gnomon_hamburger4_cholesky_nodes(moments4 b, float z_f)
{
    // Factor B = L D L^T.
    float inverse1 = 1.0 / (b.b2 - b.b1 * b.b1);
    float c12 = b.b3 - b.b1 * b.b2;
    float l21 = c12 * inverse1;
    float d2 = (b.b4 - b.b2 * b.b2) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    float y1 = z_f - b.b1;
    float q2 = ((z_f * z_f - b.b2) - l21 * y1) / d2;
    float q1 = y1 * inverse1 - l21 * q2;
    float q0 = 1.0 - (q1 * b.b1 + q2 * b.b2);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    float inverse_q2 = 1.0 / q2;
    float centre = -0.5 * (q1 * inverse_q2);
    float r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    gnomon_quadratic_nodes n;
    n.z1 = centre - r;
    n.z2 = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node -
/// last)), by Cramer's rule.
float gnomon_hamburger4_cholesky_weight(moments4 b, float node, float other, float last)
{
    return (b.b2 - b.b1 * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
float hamburger4_cholesky_intensity(moments4 b, float z_f)
{
    gnomon_quadratic_nodes n = gnomon_hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    bool both = n.z2 < z_f;
    float node = gnomon_select(both, z_f, n.z1);
    float other = gnomon_select(both, n.z1, z_f);
    float w = gnomon_hamburger4_cholesky_weight(b, node, other, n.z2);
    return saturate_or_zero(gnomon_select(both, 1.0 - w, gnomon_select(n.z1 < z_f, w, 0.0)));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3,
/// of z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
float hamburger4_cholesky_blocker(moments4 b, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    gnomon_quadratic_nodes n = gnomon_hamburger4_cholesky_nodes(b, z);
    float w1 = gnomon_select(n.z1 < z, gnomon_hamburger4_cholesky_weight(b, n.z1, z, n.z2), 0.0);
    float w2 = gnomon_select(n.z2 < z, gnomon_hamburger4_cholesky_weight(b, n.z2, n.z1, z), 0.0);
    float epsilon = hamburger_cholesky_epsilon;
    float depth = (epsilon * z + (w1 * n.z1 + w2 * n.z2)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(-1.0, depth)), z);
}

/// The three real roots of a cubic, in no particular order.
struct gnomon_cubic_roots { float z1, z2, z3; };

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
gnomon_cubic_roots gnomon_cubic_roots_blinn(float c2, float c1, float c0)
{
    float b = c2 * gnomon_hamburger_cholesky_third;
    float c = c1 * gnomon_hamburger_cholesky_third;
    float hessian1 = c - b * b;
    float hessian2 = c0 - b * c;
    float hessian3 = b * c0 - c * c;
    float discriminant = 4.0 * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    float d = hessian2 - 2.0 * b * hessian1;
    float angle = polynomial_atan2(gnomon_sqrt(discriminant), -1.0 * d);
    gnomon_cosine_sine t = polynomial_cosine_sine(angle * gnomon_hamburger_cholesky_third);
    float radius = gnomon_sqrt(-1.0 * hessian1);
    float half_cosine = radius * t.cosine;
    float half_sine = radius * t.sine * gnomon_hamburger_cholesky_sqrt3;
    gnomon_cubic_roots roots;
    roots.z1 = 2.0 * half_cosine - b;
    roots.z2 = (half_sine - half_cosine) - b;
    roots.z3 = -1.0 * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
float hamburger6_cholesky_intensity(moments6 b, float z_f)
{
    // Factor B = L D L^T.
    float inverse1 = 1.0 / (b.b2 - b.b1 * b.b1);
    float c12 = b.b3 - b.b1 * b.b2;
    float c13 = b.b4 - b.b1 * b.b3;
    float l21 = c12 * inverse1;
    float l31 = c13 * inverse1;
    float inverse2 = 1.0 / ((b.b4 - b.b2 * b.b2) - l21 * c12);
    float c23 = (b.b5 - b.b2 * b.b3) - l21 * c13;
    float l32 = c23 * inverse2;
    float d3 = ((b.b6 - b.b3 * b.b3) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    float z_f2 = z_f * z_f;
    float y1 = z_f - b.b1;
    float y2 = (z_f2 - b.b2) - l21 * y1;
    float y3 = ((z_f2 * z_f - b.b3) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    float q3 = y3 / d3;
    float q2 = y2 * inverse2 - l32 * q3;
    float q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    float q0 = 1.0 - (q1 * b.b1 + q2 * b.b2 + q3 * b.b3);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    float inverse_q3 = 1.0 / q3;
    gnomon_cubic_roots z = gnomon_cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    float v1 = gnomon_select(z.z1 < z_f, 1.0, 0.0);
    float v2 = gnomon_select(z.z2 < z_f, 1.0, 0.0);
    float v3 = gnomon_select(z.z3 < z_f, 1.0, 0.0);
    float v01 = v1 / (z.z1 - z_f);
    float v12 = (v2 - v1) / (z.z2 - z.z1);
    float v23 = (v3 - v2) / (z.z3 - z.z2);
    float v012 = (v12 - v01) / (z.z2 - z_f);
    float v123 = (v23 - v12) / (z.z3 - z.z1);
    float v0123 = (v123 - v012) / (z.z3 - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    float s0 = v012 - v0123 * z.z2;
    float t1 = s0 - v0123 * z.z1;
    float t0 = v01 - s0 * z.z1;
    float u2 = t1 - v0123 * z_f;
    float u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3 + u2 * b.b2) + u1 * b.b1) - t0 * z_f);
}

#endif

// motion/range/range.h ------------------------------------------------------------------------------------------------
// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_RANGE_H
#define GNOMON_MOTION_RANGE_RANGE_H

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
struct depth_time_range { float t0, t1, z0, z1, id; };

const float range_mixed = -1.0;                // the id of a range of several surfaces: it shadows them all
const float range_nothing = -2.0;              // the id of a time without any surface
const float range_far = 1152921504606846976.0; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
depth_time_range range_between(float time_a, float z_a, float time_b, float z_b, float id)
{
    bool swapped = time_b < time_a;
    depth_time_range r;
    r.t0 = gnomon_select(swapped, time_b, time_a);
    r.t1 = gnomon_select(swapped, time_a, time_b);
    r.z0 = gnomon_select(swapped, z_b, z_a);
    r.z1 = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
depth_time_range range_empty(float id)
{
    depth_time_range r;
    r.t0 = 1.0;
    r.t1 = 0.0;
    r.z0 = 1.0;
    r.z1 = 1.0;
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
float range_elapsed(depth_time_range r, float t) { return saturate_or_zero((t - r.t0) / (r.t1 - r.t0)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
float range_depth(depth_time_range r, float t)
{
    float passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (1.0 - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
float range_duration(depth_time_range r) { return gnomon_max(r.t1 - r.t0, 0.0); }

/// The part of r between the times begin and end, possibly empty.
depth_time_range range_clip(depth_time_range r, float begin, float end)
{
    depth_time_range c;
    c.t0 = gnomon_max(begin, r.t0);
    c.t1 = gnomon_min(end, r.t1);
    c.z0 = range_depth(r, c.t0);
    c.z1 = range_depth(r, c.t1);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
depth_time_range gnomon_range_select(bool mask, depth_time_range a, depth_time_range b)
{
    depth_time_range r;
    r.t0 = gnomon_select(mask, a.t0, b.t0);
    r.t1 = gnomon_select(mask, a.t1, b.t1);
    r.z0 = gnomon_select(mask, a.z0, b.z0);
    r.z1 = gnomon_select(mask, a.z1, b.z1);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
depth_time_range gnomon_range_keep_if(bool mask, depth_time_range r)
{
    return gnomon_range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
bool gnomon_range_less(depth_time_range a, depth_time_range b)
{
    bool by_id = a.id < b.id;
    bool by_z1 = a.z1 < b.z1 || (a.z1 == b.z1 && by_id);
    bool by_z0 = a.z0 < b.z0 || (a.z0 == b.z0 && by_z1);
    bool by_t1 = a.t1 < b.t1 || (a.t1 == b.t1 && by_z0);
    return a.t0 < b.t0 || (a.t0 == b.t0 && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
bool gnomon_range_occludes(depth_time_range a, depth_time_range b)
{
    bool during = a.t0 <= b.t0 && b.t1 <= a.t1;
    bool apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    bool nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    bool equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
depth_time_range gnomon_range_clip_to(depth_time_range a, depth_time_range b) { return range_clip(a, b.t0, b.t1); }

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
float gnomon_range_crossing(depth_time_range a, depth_time_range b)
{
    float distance0 = a.z0 - b.z0;
    float distance1 = a.z1 - b.z1;
    float passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (1.0 - passed) + a.t1 * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
depth_time_range gnomon_range_visible_part(depth_time_range a, depth_time_range b)
{
    depth_time_range near_a = gnomon_range_clip_to(a, b);
    depth_time_range near_b = gnomon_range_clip_to(b, a);
    float before0 = near_b.z0 - near_a.z0;
    float before1 = near_b.z1 - near_a.z1;
    bool tie = before0 == 0.0 && before1 == 0.0 && a.id < b.id;
    bool first = 0.0 < before0 || (before0 == 0.0 && 0.0 < before1) || tie;
    bool last = 0.0 < before1 || (before1 == 0.0 && 0.0 < before0) || tie;
    float crossing = clamp_or_nan(gnomon_range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    float begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, 1.0));
    float end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, 0.0));
    bool some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0), gnomon_select(some, end, 0.0));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
depth_time_range gnomon_range_trim(depth_time_range r, depth_time_range other)
{
    depth_time_range occluding = gnomon_range_visible_part(other, r);
    bool some = occluding.t0 < occluding.t1;
    float begin = gnomon_select(some && occluding.t0 <= r.t0, occluding.t1, r.t0);
    float end = gnomon_select(some && r.t1 <= occluding.t1, occluding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
depth_time_range range_occluding_part(depth_time_range r, depth_time_range receiver, float begin, float end)
{
    float early = gnomon_max(begin, r.t0);
    float late = gnomon_min(end, r.t1);
    // In most cases one of the two is in front at all times.
    bool nearer = r.z0 < receiver.z0 && r.z0 < receiver.z1 && r.z1 < receiver.z0 && r.z1 < receiver.z1;
    bool farther = receiver.z0 <= r.z0 && receiver.z0 <= r.z1 && receiver.z1 <= r.z0 && receiver.z1 <= r.z1;
    float front = early;
    float back = gnomon_select(farther, 0.0, late);
    bool open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        float before0 = range_depth(receiver, early) - range_depth(r, early);
        float before1 = range_depth(receiver, late) - range_depth(r, late);
        float passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        float crossing = clamp_or_nan(early * (1.0 - passed) + late * passed, early, late);
        float first = gnomon_select(0.0 < before0, early, gnomon_select(0.0 < before1, crossing, 1.0));
        float last = gnomon_select(0.0 < before1, late, gnomon_select(0.0 < before0, crossing, 0.0));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    bool some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, 1.0), gnomon_select(some, back, 0.0));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
float range_intensity(depth_time_range r, float t, float z, float id, float bias)
{
    bool during = r.t0 <= t && t <= r.t1;
    bool occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0, 0.0);
}

#endif

// motion/range/range_front.h ------------------------------------------------------------------------------------------
// The lower envelope of a list of ranges of any length, span by span: what the light sees of a texel from one time to
// another (Gribel et al. 2010; the resolve of Palmer 2011, 2.4). The caller owns both loops over the list, so that
// lists of any length can be resolved where no sorted structure is at hand, such as in a compute shader.
//
//     for (t = 0; t < 1; t = span.t1) {
//         state = range_front_begin(t);
//         for every range: state = range_front_compare(state, range);
//         for every range: state = range_front_limit(state, range);
//         span = range_front_span(state);
//     }
//
// Spans are contiguous. One with the id range_nothing has no range and may be left out of a resolved list. The ranges
// of the list overlap in time as they please; their order matters only where three of them meet within rounding.
#ifndef GNOMON_MOTION_RANGE_RANGE_FRONT_H
#define GNOMON_MOTION_RANGE_RANGE_FRONT_H

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
struct range_front
{
    depth_time_range nearest;
    float begin, unchanged, end;
};

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
depth_time_range gnomon_range_canonical(depth_time_range r)
{
    r.id = gnomon_max(r.id, range_mixed);
    bool known = gnomon_abs(r.z0) + gnomon_abs(r.z1) < range_far;
    return gnomon_range_keep_if(0.0 <= r.t0 && r.t0 < r.t1 && r.t1 <= 1.0 && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
range_front range_front_begin(float t)
{
    range_front state;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(range_nothing);
    state.unchanged = 1.0;
    state.end = 1.0;
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
range_front range_front_compare(range_front state, depth_time_range r)
{
    r = gnomon_range_canonical(r);
    depth_time_range front = state.nearest;
    depth_time_range ahead = gnomon_range_visible_part(r, front);
    bool during = r.t0 <= state.begin && state.begin < r.t1;
    bool alone = front.t1 <= front.t0;
    bool nearer = ahead.t0 <= state.begin && state.begin < ahead.t1;
    float change = gnomon_select(state.begin < ahead.t0, ahead.t0, gnomon_select(nearer, ahead.t1, 1.0));
    change = gnomon_min(change, gnomon_min(front.t1, r.t1));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = gnomon_range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
range_front range_front_limit(range_front state, depth_time_range r)
{
    r = gnomon_range_canonical(r);
    depth_time_range ahead = gnomon_range_visible_part(r, state.nearest);
    bool some = state.nearest.t0 < state.nearest.t1;
    float next = gnomon_select(some, ahead.t0, r.t0);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons
    // do.
    bool circle = ahead.t0 <= state.begin && state.begin < ahead.t1;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
depth_time_range range_front_span(range_front state)
{
    bool some = state.nearest.t0 < state.nearest.t1;
    float end = gnomon_min(gnomon_select(some, state.nearest.t1, 1.0), state.end);
    depth_time_range span = range_clip(state.nearest, state.begin, end);
    span.t0 = state.begin;
    span.t1 = end;
    return span;
}

#endif

// motion/range/range_merge.h ------------------------------------------------------------------------------------------
// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.
#ifndef GNOMON_MOTION_RANGE_RANGE_MERGE_H
#define GNOMON_MOTION_RANGE_RANGE_MERGE_H

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
struct range_pair
{
    depth_time_range merged;
    float gap, shift, cost;
};

const float gnomon_range_merge_margin = 0.000003814697265625; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
depth_time_range gnomon_range_hull(depth_time_range a, depth_time_range b)
{
    depth_time_range hull;
    hull.t0 = gnomon_min(a.t0, b.t0);
    hull.t1 = gnomon_max(a.t1, b.t1);
    float nearer0 = gnomon_min(a.z0, b.z0);
    float nearer1 = gnomon_min(a.z1, b.z1);
    hull.z0 = gnomon_select(a.t0 < b.t0, a.z0, gnomon_select(b.t0 < a.t0, b.z0, nearer0));
    hull.z1 = gnomon_select(b.t1 < a.t1, a.z1, gnomon_select(a.t1 < b.t1, b.z1, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, range_mixed);
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
depth_time_range gnomon_range_merge(depth_time_range a, depth_time_range b)
{
    depth_time_range hull = gnomon_range_hull(a, b);
    float back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                            gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, 0.0);
    float size = gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)),
                            gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    float margin = size * gnomon_range_merge_margin;
    float level = gnomon_min(gnomon_min(a.z0, b.z0), gnomon_min(a.z1, b.z1));
    float sloped0 = hull.z0 - back;
    float sloped1 = hull.z1 - back;
    bool slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < range_far;
    hull.z0 = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1 = gnomon_select(slopes, sloped1, level) - margin;

    bool some_a = a.t0 < a.t1;
    bool some_b = b.t0 < b.t1;
    return gnomon_range_select(some_a && some_b, hull, gnomon_range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
float gnomon_range_area(depth_time_range r) { return range_duration(r) * (1.0 - 0.5 * (r.z0 + r.z1)); }

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
float gnomon_range_distance(depth_time_range r, depth_time_range nearer)
{
    float distance0 = r.z0 - range_depth(nearer, r.t0);
    float distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), 0.0), 0.0);
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
range_pair gnomon_range_pair_make(depth_time_range a, depth_time_range b)
{
    range_pair p;
    p.merged = gnomon_range_merge(a, b);
    bool some = a.t0 < a.t1 && b.t0 < b.t1;
    float gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, 0.0), 0.0);
    // Ignore the parts that the other range occludes: they were in shadow already.
    float shift = gnomon_max(gnomon_range_distance(gnomon_range_trim(a, b), p.merged),
                             gnomon_range_distance(gnomon_range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, 0.0);

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    depth_time_range near_a = gnomon_range_clip_to(a, b);
    depth_time_range near_b = gnomon_range_clip_to(b, a);
    float x0 = near_a.z0 - near_b.z0;
    float x1 = near_a.z1 - near_b.z1;
    float sum = gnomon_abs(x0) + gnomon_abs(x1);
    float apart = 0.5 * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(0.0 < sum, apart, 0.0);
    float middle = 0.25 * ((near_a.z0 + near_a.z1) + (near_b.z0 + near_b.z1));
    float both = range_duration(near_a) * (1.0 - (middle + 0.5 * apart));
    float area = gnomon_range_area(p.merged) - ((gnomon_range_area(a) + gnomon_range_area(b)) - both);
    float own_a = gnomon_select(a.id == p.merged.id, 0.0, range_duration(a));
    float own_b = gnomon_select(b.id == p.merged.id, 0.0, range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, 0.0) + (own_a + own_b), -1.0);
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
range_pair gnomon_range_pair_empty(depth_time_range r)
{
    range_pair p;
    p.merged = r;
    p.gap = 0.0;
    p.shift = 0.0;
    p.cost = range_far * range_far;
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
range_pair gnomon_range_pair_cheaper(range_pair a, range_pair b)
{
    bool cheaper = b.cost < a.cost;
    range_pair p;
    p.merged = gnomon_range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

#endif

// motion/range/range_list.h -------------------------------------------------------------------------------------------
// Lists of a few depth-time ranges, one list for a texel: the surfaces that pass the texel while the shutter is open
// (Gribel et al. 2010; Hong & Oh 2017), and the lower envelope of the list, which is visible from the light at each
// time (the resolve of Palmer 2011, 2.4).
//
//     list = range_list_make(range);                  list = range_list_insert(list, range) for every other range
//     intensity = range_list_intensity(list, t, z, id, bias);    shadow test at one time
//     resolved = range_list_resolve(list);                       lower envelope, for receivers in closed form
//     for (t = 0; t < 1; t = span.t1) span = range_list_front(list, t);    the same, span by span
//
// A list stores inserted ranges unchanged and drops those that another range provably occludes (gnomon_range_occludes).
// Until the list overflows, neither its contents nor its resolved form depend on the order of insertion or on rounding.
// On overflow it first drops ranges that several others jointly occlude. If there is still no room, it merges the two
// most similar ranges into one in front of both (gnomon_range_merge.h): shadows stay, and the shadow that merging adds
// is counted.
//
// Occluded ranges are dropped regardless of their ids. So a receiver gets the answer of all ranges, unless a range of
// its own id lies in front of it by more than its bias: that range does not shadow the receiver, and ranges that it
// occluded are no longer in the list. Hence one id should be a surface none of whose points is ever behind another: a
// triangle, a plane, the lit side of a convex part. With one id for a whole object, its far sides lose the shadows that
// other objects cast on them.
//
// The capacity is GNOMON_RANGE_CAPACITY, if defined before inclusion, else 8. In C++ the capacity is a template
// parameter with this default.
#ifndef GNOMON_MOTION_RANGE_RANGE_LIST_H
#define GNOMON_MOTION_RANGE_RANGE_LIST_H

#ifndef GNOMON_RANGE_CAPACITY
#define GNOMON_RANGE_CAPACITY 8
#endif

/// Ranges in the order of gnomon_range_less, with empty ranges between them, and upper bounds of the cost of merging:
/// except for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
struct range_list
{
    depth_time_range ranges[GNOMON_RANGE_CAPACITY];
    float time_added, depth_added;
};

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
depth_time_range gnomon_range_offset(depth_time_range r, float side)
{
    float change = gnomon_abs(r.z1 - r.z0);
    float brief = gnomon_min(change * 0.000000476837158203125 / (r.t1 - r.t0), change);
    float by = side * (0.0000152587890625 + brief);
    r.z0 = r.z0 + by;
    r.z1 = r.z1 + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
range_list gnomon_range_list_count_merge(range_list list, range_pair p)
{
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, 0.0);
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
range_list gnomon_range_list_place(range_list list, depth_time_range r)
{
    for (int i = 0; i + 1 < GNOMON_RANGE_CAPACITY; ++i) { // the first empty one goes to the end
        depth_time_range s = list.ranges[i];
        depth_time_range next = list.ranges[i + 1];
        bool empty = s.t1 <= s.t0 && r.t0 < r.t1;
        list.ranges[i] = gnomon_range_select(empty, next, s);
        list.ranges[i + 1] = gnomon_range_select(empty, s, next);
    }
    for (int k = 0; k + 1 < GNOMON_RANGE_CAPACITY; ++k) {
        depth_time_range s = list.ranges[k];
        bool here = s.t0 < s.t1 && gnomon_range_less(r, s);
        list.ranges[k] = gnomon_range_select(here, r, s);
        r = gnomon_range_select(here, s, r);
    }
    depth_time_range last = list.ranges[GNOMON_RANGE_CAPACITY - 1];
    list.ranges[GNOMON_RANGE_CAPACITY - 1] = gnomon_range_select(r.t0 < r.t1, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A
/// place of -1 is none.
range_list gnomon_range_list_replace(range_list list, bool full, float first, float second, range_pair merge)
{
    float place = 0.0;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        bool merged = full && (place == first || place == second);
        list.ranges[i] = gnomon_range_keep_if(!merged, list.ranges[i]);
        place = place + 1.0;
    }
    merge.merged = gnomon_range_keep_if(full, merge.merged);
    merge.gap = gnomon_select(full, merge.gap, 0.0);
    merge.shift = gnomon_select(full, merge.shift, 0.0);
    return gnomon_range_list_place(gnomon_range_list_count_merge(list, merge), merge.merged);
}

/// Insert r, clipped to times in [0, 1]. Without an overflow the ranges of the list do not depend on the order of
/// insertion, bit for bit, except for the sign of a zero. With an overflow they do, but at no time is the front farther
/// than that of all inserted ranges. That holds strictly, for exact depth lines, however steep and brief the ranges
/// are.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010; Hong & Oh 2017
range_list range_list_insert(range_list list, depth_time_range r)
{
    r = gnomon_range_canonical(range_clip(r, 0.0, 1.0));
    list = gnomon_range_list_count_merge(list, gnomon_range_pair_empty(r)); // counts that are NaN become 0
    float room = 0.0;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = gnomon_range_canonical(list.ranges[i]);
        r = gnomon_range_keep_if(!gnomon_range_occludes(s, r), r);
        s = gnomon_range_keep_if(!gnomon_range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, 1.0);
    }
    bool full = r.t0 < r.t1 && room < 1.0;
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        range_list occluders = list;
        for (int h = 0; h < GNOMON_RANGE_CAPACITY; ++h) occluders.ranges[h] = gnomon_range_offset(list.ranges[h], 1.0);
        depth_time_range farther = gnomon_range_offset(r, 1.0);
        for (int j = 0; j < GNOMON_RANGE_CAPACITY; ++j) {
            depth_time_range s = gnomon_range_trim(gnomon_range_offset(list.ranges[j], -1.0), farther);
            for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) s = gnomon_range_trim(s, occluders.ranges[k]);
            bool seen = !full || s.t0 < s.t1;
            list.ranges[j] = gnomon_range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = gnomon_range_keep_if(seen, occluders.ranges[j]);
        }
        depth_time_range left = gnomon_range_offset(r, -1.0);
        for (int m = 0; m < GNOMON_RANGE_CAPACITY; ++m) left = gnomon_range_trim(left, occluders.ranges[m]);
        r = gnomon_range_keep_if(!full || left.t0 < left.t1, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        range_pair best = gnomon_range_pair_empty(r);
        float first = -1.0;
        float second = -1.0;
        float place = 0.0;
        for (int a = 0; a < GNOMON_RANGE_CAPACITY; ++a) {
            depth_time_range other = r;
            float other_place = -1.0;
            for (int b = 0; b <= a; ++b) {
                range_pair pair = gnomon_range_pair_make(list.ranges[a], other);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = gnomon_range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + 1.0;
            }
            place = place + 1.0;
        }
        list = gnomon_range_list_replace(list, full, first, second, best);
        r = gnomon_range_keep_if(!(full && second < 0.0), r);
    }
    return gnomon_range_list_place(list, r);
}

/// The list of one range; an empty list if the range is empty.
range_list range_list_make(depth_time_range r)
{
    range_list list;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) list.ranges[i] = gnomon_range_keep_if(r.t0 < r.t0, r);
    list.time_added = 0.0;
    list.depth_added = 0.0;
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
depth_time_range range_list_front(range_list list, float t)
{
    range_front state = range_front_begin(t);
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) state = range_front_compare(state, list.ranges[i]);
    for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) state = range_front_limit(state, list.ranges[k]);
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
range_list gnomon_range_list_append(range_list list, depth_time_range r)
{
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    range_pair best = gnomon_range_pair_empty(r);
    float at = 0.0;
    float place = 0.0;
    depth_time_range next = r;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = list.ranges[GNOMON_RANGE_CAPACITY - 1 - i];
        range_pair pair = gnomon_range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = gnomon_range_pair_cheaper(best, pair);
        next = s;
        place = place + 1.0;
    }
    place = 0.0;
    next = r;
    for (int k = 0; k < GNOMON_RANGE_CAPACITY; ++k) {
        depth_time_range s = list.ranges[GNOMON_RANGE_CAPACITY - 1 - k];
        depth_time_range here = gnomon_range_select(place == at, best.merged, s);
        list.ranges[GNOMON_RANGE_CAPACITY - 1 - k] = gnomon_range_select(place < at, next, here);
        next = s;
        place = place + 1.0;
    }
    return gnomon_range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
range_list range_list_resolve(range_list list)
{
    float t = 0.0;
    range_list resolved = list;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) resolved.ranges[i] = gnomon_range_keep_if(t < t, list.ranges[i]);
    for (int k = 0; k < (GNOMON_RANGE_CAPACITY + 1) * (GNOMON_RANGE_CAPACITY + 2) / 2; ++k) {
        if (gnomon_any(t < 1.0)) {
            depth_time_range span = range_list_front(list, t);
            bool some = range_nothing < span.id;
            resolved = gnomon_range_list_append(resolved, gnomon_range_keep_if(some, span));
            t = span.t1;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
float range_list_intensity(range_list list, float t, float z, float id, float bias)
{
    float intensity = 0.0;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) intensity = gnomon_max(intensity,
                                                                           range_intensity(list.ranges[i], t, z, id,
                                                                                           bias));
    return intensity;
}

#endif

// comparators/interval_list.h -----------------------------------------------------------------------------------------
// Lists of a few intervals as Gribel et al. 2010 compress them: a full list merges the two intervals of the least cost,
// a weighted sum of the gap in time between them, their differences in depth and in slope, and their durations. The
// merged interval is the line from the begin of the earlier one to the end of the later one. It may be behind either of
// them, so that what was shadowed becomes lit; range_list.h merges into a line in front of both, and has no weights.
//
// Costs and merges can be chosen apart, to tell what each of them does: the weight `area` is that of the cost of
// gnomon_range_merge.h, and `conservative` above 0 takes the line in front of both.
//
//     list = range_list_make(range);   list = interval_list_insert(list, range, weights, 0) for every other range
//     resolved = range_list_resolve(list);
#ifndef GNOMON_COMPARATORS_INTERVAL_LIST_H
#define GNOMON_COMPARATORS_INTERVAL_LIST_H

/// Weights of the area that becomes shadowed (gnomon_range_pair_make), of the gap in time, of the differences in depth
/// and in slope, and of the durations.
struct gnomon_interval_weights { float area, gap, depth, slope, duration; };

/// The interval from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
/// If one is empty, the result is the other one, unchanged.
/// Source: Gribel 2010
depth_time_range interval_merge(depth_time_range a, depth_time_range b)
{
    bool some_a = a.t0 < a.t1;
    bool some_b = b.t0 < b.t1;
    return gnomon_range_select(some_a && some_b, gnomon_range_hull(a, b), gnomon_range_select(some_a, a, b));
}

/// Cost of merging a and b, at most 2^60; -1 if one is empty. The difference in depth is that between the end of the
/// earlier one and the begin of the later one.
/// NaN: 2^60.
/// Source: Gribel 2010
float interval_cost(depth_time_range a, depth_time_range b, gnomon_interval_weights weights)
{
    range_pair p = gnomon_range_pair_make(a, b);
    depth_time_range first = gnomon_range_select(b.t0 < a.t0, b, a);
    depth_time_range second = gnomon_range_select(b.t0 < a.t0, a, b);
    float gap = gnomon_max(second.t0 - first.t1, 0.0);
    float slopes = (first.z1 - first.z0) / (first.t1 - first.t0) - (second.z1 - second.z0) / (second.t1 - second.t0);
    float steeper = gnomon_min(gnomon_abs(slopes), range_far);
    float lasting = range_duration(a) + range_duration(b);
    float cost = (weights.area * p.cost + weights.gap * gap) +
                 (weights.depth * gnomon_abs(second.z0 - first.z1) + weights.slope * steeper) + weights.duration *
                 lasting;
    bool some = a.t0 < a.t1 && b.t0 < b.t1;
    return gnomon_select(some, gnomon_max(gnomon_min(cost, range_far), 0.0), -1.0);
}

/// The merge of a and b, with its costs.
range_pair gnomon_interval_pair_make(depth_time_range a, depth_time_range b, gnomon_interval_weights weights,
                                     float conservative)
{
    range_pair p = gnomon_range_pair_make(a, b);
    p.merged = gnomon_range_select(0.0 < conservative, p.merged, interval_merge(a, b));
    p.cost = interval_cost(a, b, weights);
    return p;
}

/// Insert r, clipped to times in [0, 1]. On overflow the pair of the least cost is merged, and the list counts its cost
/// as range_list_insert does, as if the merge were conservative.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16, weights of 0 or more.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010
range_list interval_list_insert(range_list list, depth_time_range r, gnomon_interval_weights weights,
                                float conservative)
{
    r = gnomon_range_canonical(range_clip(r, 0.0, 1.0));
    list = gnomon_range_list_count_merge(list, gnomon_range_pair_empty(r)); // counts that are NaN become 0
    float room = 0.0;
    for (int i = 0; i < GNOMON_RANGE_CAPACITY; ++i) {
        depth_time_range s = gnomon_range_canonical(list.ranges[i]);
        r = gnomon_range_keep_if(!gnomon_range_occludes(s, r), r);
        s = gnomon_range_keep_if(!gnomon_range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, 1.0);
    }
    bool full = r.t0 < r.t1 && room < 1.0;
    if (gnomon_any(full)) {
        range_pair best = gnomon_range_pair_empty(r);
        float first = -1.0;
        float second = -1.0;
        float place = 0.0;
        for (int a = 0; a < GNOMON_RANGE_CAPACITY; ++a) {
            depth_time_range other = r; // which has place -1
            float other_place = -1.0;
            for (int b = 0; b <= a; ++b) {
                range_pair pair = gnomon_interval_pair_make(list.ranges[a], other, weights, conservative);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = gnomon_range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + 1.0;
            }
            place = place + 1.0;
        }
        list = gnomon_range_list_replace(list, full, first, second, best);
        r = gnomon_range_keep_if(!(full && second < 0.0), r);
    }
    return gnomon_range_list_place(list, r);
}

#endif

// comparators/percentage_closer_soft.h --------------------------------------------------------------------------------
// Percentage-closer soft shadows (Fernando 2005; Peters et al. 2017, Sec. 4.1): the mean depth of what is in front of
// the receiver, from every texel of a search region. This is what the blocker search by moments (soft/blocker.h)
// estimates.
//
//     search = percentage_closer_search_begin(z_f);
//     search = percentage_closer_search_add(search, z, weight);     for every texel of the search region, weights
// summing to 1
//     blocker = percentage_closer_search_end(search);
//     width = the width of the penumbra (soft/penumbra.h) for z_f and blocker.depth
//     intensity = percentage_closer_begin, _add, _end (filters/percentage_closer.h) over a filter region of this width
//
// An intensity of 0 or 1 of the whole search region spares the filter region.
#ifndef GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H
#define GNOMON_COMPARATORS_PERCENTAGE_CLOSER_SOFT_H

const float percentage_closer_search_epsilon = 1e-3;

/// The receiver's depth, the weight in front of the receiver so far, and the sum of its weighted distances to the
/// receiver.
struct percentage_closer_search { float receiver, shadowed, distance; };

/// The mean depth of the blockers, in [-1, 1] and at most z_f, and their weight in the search region, in [0, 1].
struct percentage_closer_blocker { float depth, intensity; };

/// The state before the first texel of the search region. z_f has no bias.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: no blocker.
percentage_closer_search percentage_closer_search_begin(float z_f)
{
    percentage_closer_search r;
    r.receiver = clamp_or_nan(z_f, -1.0, 1.0);
    r.shadowed = 0.0;
    r.distance = 0.0;
    return r;
}

/// The state after one more texel of depth z with its weight.
/// Domain: any z; below the near plane as on it.
/// NaN: a texel of depth NaN is no blocker; a weight of NaN before the receiver leaves no blocker at all.
percentage_closer_search percentage_closer_search_add(percentage_closer_search state, float z, float weight)
{
    bool in_front = z < state.receiver;
    float distance = state.receiver - gnomon_max(z, -1.0);
    state.shadowed = state.shadowed + gnomon_select(in_front, weight, 0.0);
    state.distance = state.distance + gnomon_select(in_front, weight * distance, 0.0);
    return state;
}

/// Mean depth and weight of the blockers. The mean is moved towards the receiver by a weight of 1e-3, so that few
/// blockers count for less and none leaves the receiver's own depth.
/// NaN: for z_f the far plane; for a weight before the receiver the receiver's depth, and an intensity of 0.
/// Error: that of the sums of weights and of weighted distances.
/// Source: Peters 2017, Eq. 4; Fernando 2005
percentage_closer_blocker percentage_closer_search_end(percentage_closer_search state)
{
    float weight = state.shadowed + percentage_closer_search_epsilon;
    float receiver = clamp_or_high(state.receiver, -1.0, 1.0);
    percentage_closer_blocker r;
    float depth = gnomon_max(-1.0, gnomon_min(receiver - state.distance / weight, receiver));
    // Clang 14 makes one clamp, which lets a NaN pass, of this one and of that at the beginning.
    r.depth = gnomon_select(state.receiver == state.receiver, depth, 1.0);
    r.intensity = saturate_or_zero(state.shadowed);
    return r;
}

#endif

// motion/triangle/coverage_intervals.h --------------------------------------------------------------------------------
// Times at which a triangle covers a sample, for edge functions that are quadratic in time (moving_triangle.h): at most
// four intervals of the shutter for either facing (Gribel et al. 2010; Palmer 2011, 2.1).
//
// An edge function is stored by its Bernstein coefficients, e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2. So e0 and e2
// are its values at shutter open and close, and a root t = u / (1 + u) belongs to a root u >= 0 of
//     e2 u^2 + 2 e1 u + e0 = 0,   u = q / e2 or e0 / q,   q = -(e1 + sign(e1) sqrt(e1^2 - e0 e2))
// This gives t = q / (q + e2) or e0 / (e0 + q). Both are sums of like signs, so nothing cancels, neither near 0 nor
// near 1. The set of times with e >= 0 is a single interval, or, if e is positive at both ends, everything except one
// gap. Three edges leave one interval less three gaps, hence four intervals. No sign is sampled in between. Of two
// triangles that share an edge, one has e and the other -e. Both find the same roots bit for bit, so one triangle
// covers the sample exactly when the other does not.
#ifndef GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H
#define GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
struct gnomon_moving_edge { float e0, e1, e2; };

/// The edge functions opposite to the vertices a, b, c of a triangle.
struct gnomon_moving_edges { gnomon_moving_edge a, b, c; };

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are
/// gnomon_coverage_none. An empty set has begin 1 and end 0.
struct gnomon_edge_intervals { float begin, end, gap_begin, gap_end; };

/// The times from begin to end; none unless begin < end.
struct gnomon_linear_interval { float begin, end; };

/// Four numbers in ascending order.
struct gnomon_ordered4 { float first, second, third, fourth; };

/// Disjoint intervals in order, `count` of them; the others begin and end at gnomon_coverage_none.
struct coverage_intervals { float count, begin0, end0, begin1, end1, begin2, end2, begin3, end3; };

const float gnomon_coverage_none = 2.0;                       // after the shutter has closed
const float gnomon_moving_edge_limit = 1152921504606846976.0; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
float moving_edge_at(gnomon_moving_edge e, float t)
{
    float s = 1.0 - t;
    return (e.e0 * s + e.e1 * t) * s + (e.e1 * s + e.e2 * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
float gnomon_moving_edge_size(gnomon_moving_edge e) { return (gnomon_abs(e.e0) + gnomon_abs(e.e1)) + gnomon_abs(e.e2); }

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
gnomon_edge_intervals moving_edge_inside(gnomon_moving_edge e, float facing)
{
    float side = gnomon_select(facing < 0.0, -1.0, 1.0);
    float c0 = side * e.e0;
    float c1 = side * e.e1;
    float c2 = side * e.e2;
    gnomon_edge_intervals x;
    x.begin = 0.0;
    x.end = 1.0;
    x.gap_begin = gnomon_coverage_none;
    x.gap_end = gnomon_coverage_none;
    bool before = c0 < 0.0; // outside at shutter open
    bool after = c2 < 0.0;
    if (gnomon_any(before || after || c1 < 0.0)) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        bool up = 0.0 < c1 || (c1 == 0.0 && before);
        bool late = (before && !up) || (up && !before);
        bool once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        bool twice = !(once || late);
        float r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, 0.0));
        float q = gnomon_select(up, -1.0 * (c1 + r), r - c1);
        float first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        float second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && 0.0 < r;
            bool gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        bool some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, 0.0), 1.0);
        x.end = gnomon_select(some, gnomon_select(after, second, 1.0), 0.0);
    }
    bool known = gnomon_moving_edge_size(e) < gnomon_moving_edge_limit;
    x.begin = gnomon_select(known, x.begin, 1.0);
    x.end = gnomon_select(known, x.end, 0.0);
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
gnomon_linear_interval linear_edge_inside(float e0, float e2)
{
    bool before = e0 < 0.0;
    bool after = e2 < 0.0;
    float change = e0 - e2;
    bool never = (before && after) || !(gnomon_abs(change) < gnomon_moving_edge_limit);
    float root = gnomon_min(e0 / change, 1.0);
    gnomon_linear_interval x;
    x.begin = gnomon_select(never, 1.0, gnomon_select(before, root, 0.0));
    x.end = gnomon_select(never, 0.0, gnomon_select(after, root, 1.0));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
gnomon_linear_interval linear_coverage(gnomon_moving_edges e)
{
    gnomon_linear_interval a = linear_edge_inside(e.a.e0, e.a.e2);
    gnomon_linear_interval b = linear_edge_inside(e.b.e0, e.b.e2);
    gnomon_linear_interval c = linear_edge_inside(e.c.e0, e.c.e2);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
gnomon_ordered4 gnomon_ordered4_make(float a, float b, float c, float d)
{
    float low0 = gnomon_min(a, b);
    float high0 = gnomon_max(a, b);
    float low1 = gnomon_min(c, d);
    float high1 = gnomon_max(c, d);
    float middle0 = gnomon_max(low0, low1);
    float middle1 = gnomon_min(high0, high1);
    gnomon_ordered4 x;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
coverage_intervals intersect_edge_intervals(gnomon_edge_intervals a, gnomon_edge_intervals b, gnomon_edge_intervals c)
{
    float begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), 0.0);
    float end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), 1.0);
    float none = gnomon_coverage_none;
    bool some = begin < end;
    coverage_intervals x;
    x.count = gnomon_select(some, 1.0, 0.0);
    x.begin0 = gnomon_select(some, begin, none);
    x.end0 = gnomon_select(some, end, none);
    x.begin1 = none;
    x.end1 = none;
    x.begin2 = none;
    x.end2 = none;
    x.begin3 = none;
    x.end3 = none;
    bool gap_a = a.gap_begin < none;
    bool gap_b = b.gap_begin < none;
    bool gap_c = c.gap_begin < none;
    if (gnomon_any(some && (gap_a || gap_b || gap_c))) {
        // Intervals that a caller made may have a gap's end without a begin. Ignore such ends, so that no lane of a
        // pack depends on the others.
        a.gap_begin = gnomon_select(gap_a, a.gap_begin, none);
        b.gap_begin = gnomon_select(gap_b, b.gap_begin, none);
        c.gap_begin = gnomon_select(gap_c, c.gap_begin, none);
        a.gap_end = gnomon_select(gap_a, a.gap_end, none);
        b.gap_end = gnomon_select(gap_b, b.gap_end, none);
        c.gap_end = gnomon_select(gap_c, c.gap_end, none);
        // Sorted separately, the begins and ends of gaps bound the times outside of all gaps: a time is outside when as
        // many gaps have begun as have ended.
        gnomon_ordered4 starts = gnomon_ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        gnomon_ordered4 stops = gnomon_ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        float begin1 = gnomon_max(begin, stops.first);
        float begin2 = gnomon_max(begin, stops.second);
        float begin3 = gnomon_max(begin, stops.third);
        float end0 = gnomon_min(end, starts.first);
        float end1 = gnomon_min(end, starts.second);
        float end2 = gnomon_min(end, starts.third);
        bool some0 = some && begin < end0;
        bool some1 = some && begin1 < end1;
        bool some2 = some && begin2 < end2;
        bool some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = gnomon_ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                                      gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = gnomon_ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                                     gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, 1.0, 0.0) + gnomon_select(some1, 1.0, 0.0)) +
                  (gnomon_select(some2, 1.0, 0.0) + gnomon_select(some3, 1.0, 0.0));
        x.begin0 = starts.first;
        x.end0 = stops.first;
        x.begin1 = starts.second;
        x.end1 = stops.second;
        x.begin2 = starts.third;
        x.end2 = stops.third;
        x.begin3 = starts.fourth;
        x.end3 = stops.fourth;
    }
    return x;
}

/// Times at which a triangle that turns this side to the sample covers it: all three edge functions are >= 0, or <= 0
/// if facing is negative. A sample on the border is covered. A triangle without area, with three edge functions that
/// are 0 throughout, covers nothing.
/// Domain: none for coefficients that moving_edge_inside refuses.
/// NaN: none.
/// Error: that of moving_edge_inside.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
coverage_intervals moving_coverage(gnomon_moving_edges e, float facing)
{
    gnomon_edge_intervals a = moving_edge_inside(e.a, facing);
    float size = (gnomon_moving_edge_size(e.a) + gnomon_moving_edge_size(e.b)) + gnomon_moving_edge_size(e.c);
    a.end = gnomon_select(0.0 < size, a.end, 0.0);
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
float coverage_duration(coverage_intervals x)
{
    return saturate_or_zero(((x.end0 - x.begin0) + (x.end1 - x.begin1)) + ((x.end2 - x.begin2) + (x.end3 - x.begin3)));
}

#endif

// motion/triangle/moving_triangle.h -----------------------------------------------------------------------------------
// A triangle whose vertices move linearly through clip space while the shutter is open (Akenine-Moller et al. 2007), as
// one sample of a shadow map sees it: edge functions, coverage, depth.
//
// A vertex is p(t) = (1 - t) q + t r. Sheared by the sample (s_x, s_y), its coordinates (x - s_x w, y - s_y w) are
// linear in t as well, and 0 where the vertex projects to the sample. An edge function is the cross product of two
// sheared vertices, a quadratic in t, also in perspective (w is 1 in an orthographic view):
//     e(t) = p_i(t) x p_j(t) = (1 - t)^2 q_i x q_j + t (1 - t) (q_i x r_j + r_i x q_j) + t^2 r_i x r_j
// This is the homogeneous edge function of Laine & Karras 2011. The point of the triangle that the sample sees is the
// mean of the vertices, each weighted by the edge function opposite to it. So depth is a cubic over a cubic,
//     z / w = sum_k e_k(t) z_k(t) / sum_k e_k(t) w_k(t)
// Depth that is linear in view distance is affine in the point, so its w_k is 1 and it is a cubic over a quadratic.
// Lists of ranges approximate depth by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance requires (chapter 5).
//
// The deviation of depth from a line is bounded, not sampled. Let depth be N / D, let h be the line through it at both
// ends of an interval, and let u go from 0 to 1 there. N - h D vanishes at both ends, so it is u (1 - u) P(u). D / (u
// (1 - u)) is at least some constant c. So |N / D - h| is at most |P| / c, with equality for a parabola.
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
struct gnomon_moving_vertex { float x0, y0, z0, w0, x1, y1, z1, w1; };

/// A triangle of three moving vertices.
struct moving_triangle { gnomon_moving_vertex a, b, c; };

/// A vertex relative to a sample, at shutter open and at shutter close.
struct gnomon_sheared_vertex { float x0, y0, x1, y1; };

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
struct depth_line { float z0, z1, deviation; };

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
struct depth_piece { float t0, t1, z0, z1, passed; };

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
struct depth_trial
{
    depth_piece piece;
    float start, share, settled;
};

/// Weights of a triangle's vertices; they need not sum to 1.
struct gnomon_corner_weights { float a, b, c; };

/// Bernstein coefficients of a cubic, the middle ones times 3.
struct gnomon_bernstein_cubic { float c0, c1, c2, c3; };

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
gnomon_sheared_vertex gnomon_moving_vertex_shear(gnomon_moving_vertex v, float s_x, float s_y)
{
    gnomon_sheared_vertex r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
float gnomon_sheared_cross(float a_x, float a_y, float b_x, float b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
gnomon_moving_edge gnomon_moving_edge_make(gnomon_sheared_vertex a, gnomon_sheared_vertex b)
{
    gnomon_moving_edge e;
    e.e0 = gnomon_sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = 0.5 * (gnomon_sheared_cross(a.x0, a.y0, b.x1, b.y1) + gnomon_sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = gnomon_sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
gnomon_moving_edges moving_triangle_edges(moving_triangle m, float s_x, float s_y)
{
    gnomon_sheared_vertex a = gnomon_moving_vertex_shear(m.a, s_x, s_y);
    gnomon_sheared_vertex b = gnomon_moving_vertex_shear(m.b, s_x, s_y);
    gnomon_sheared_vertex c = gnomon_moving_vertex_shear(m.c, s_x, s_y);
    gnomon_moving_edges e;
    e.a = gnomon_moving_edge_make(b, c);
    e.b = gnomon_moving_edge_make(c, a);
    e.c = gnomon_moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
gnomon_corner_weights gnomon_corner_weights_at(gnomon_moving_edges e, float t)
{
    gnomon_corner_weights v;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    bool back = (v.a + v.b) + v.c < 0.0;
    v.a = gnomon_max(gnomon_select(back, -1.0 * v.a, v.a), 0.0);
    v.b = gnomon_max(gnomon_select(back, -1.0 * v.b, v.b), 0.0);
    v.c = gnomon_max(gnomon_select(back, -1.0 * v.c, v.c), 0.0);
    bool vanished = (v.a + v.b) + v.c <= 0.0;
    v.a = gnomon_select(vanished, 1.0, v.a);
    v.b = gnomon_select(vanished, 1.0, v.b);
    v.c = gnomon_select(vanished, 1.0, v.c);
    return v;
}

/// Depth of the triangle's point at the sample at time t, in [-1, 1]; e from moving_triangle_edges. divided is 1 for
/// depth z / w, with z in clip space, and 0 for a z that is linear in view distance: the result is then the mean of the
/// vertices' z. Edge functions against the triangle's facing, which arise from rounding and outside of the covered
/// times, count as 0, so that the result lies between the depths of the vertices if all w > 0. If all three vanish, the
/// result is the depth of the centroid.
/// Domain: 1, the far plane, where the point is behind the light, w <= 0.
/// NaN: 1.
/// Error: that of the edge functions times sum_k |z_k - z v_k| / |sum_k e_k v_k|, and 16 2^-p of the largest |z_k /
/// v_k|; v = w where divided, else 1.
float moving_depth_at(moving_triangle m, gnomon_moving_edges e, float t, float divided)
{
    gnomon_corner_weights v = gnomon_corner_weights_at(e, t);
    float s = 1.0 - t;
    float z = (v.a * (m.a.z0 * s + m.a.z1 * t) + v.b * (m.b.z0 * s + m.b.z1 * t)) + v.c * (m.c.z0 * s + m.c.z1 * t);
    float w = (v.a * (m.a.w0 * s + m.a.w1 * t) + v.b * (m.b.w0 * s + m.b.w1 * t)) + v.c * (m.c.w0 * s + m.c.w1 * t);
    float divisor = gnomon_select(0.0 < divided, w, (v.a + v.b) + v.c);
    float depth = gnomon_max(gnomon_min(z / divisor, 1.0), -1.0); // a NaN becomes 1
    return gnomon_select(0.0 < w, depth, 1.0);
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
float gnomon_depth_nonlinearity(float most, float d0, float d3, float turn0, float turn1)
{
    bool negative = d0 < 0.0;
    float turn = gnomon_select(negative, -1.0 * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    float product = d0 * d3;
    float least = turn + 2.0 * gnomon_sqrt(product);
    bool known = 0.0 < product && 0.0 < least && least < gnomon_moving_edge_limit;
    return gnomon_select(known, most / least, 4.0);
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
depth_line gnomon_depth_line_within(float z0, float z1, float free0, float free1, float bend, float least, float most)
{
    float beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    float all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    depth_line r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
gnomon_moving_edge gnomon_moving_edge_between(gnomon_moving_edge e, float begin, float end)
{
    float left = 1.0 - end;
    gnomon_moving_edge r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = 2.0 * ((e.e0 * left + e.e1 * end) * (1.0 - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from gnomon_moving_edge_between, each times a linear function: from a0 to a1, from
/// b0 to b1, from c0 to c1.
gnomon_bernstein_cubic gnomon_moving_edges_combine(gnomon_moving_edges e, float a0, float a1, float b0, float b1,
                                                   float c0, float c1)
{
    gnomon_bernstein_cubic r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
depth_line moving_depth_line(moving_triangle m, gnomon_moving_edges e, float begin, float end, float divided)
{
    float b = 1.0 - begin;
    float f = 1.0 - end;
    gnomon_moving_edges x;
    x.a = gnomon_moving_edge_between(e.a, begin, end);
    x.b = gnomon_moving_edge_between(e.b, begin, end);
    x.c = gnomon_moving_edge_between(e.c, begin, end);
    gnomon_bernstein_cubic n = gnomon_moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end,
                                                           m.b.z0 * b + m.b.z1 * begin, m.b.z0 * f + m.b.z1 * end,
                                                           m.c.z0 * b + m.c.z1 * begin, m.c.z0 * f + m.c.z1 * end);
    float a_w0 = m.a.w0 * b + m.a.w1 * begin;
    float a_w1 = m.a.w0 * f + m.a.w1 * end;
    float b_w0 = m.b.w0 * b + m.b.w1 * begin;
    float b_w1 = m.b.w0 * f + m.b.w1 * end;
    float c_w0 = m.c.w0 * b + m.c.w1 * begin;
    float c_w1 = m.c.w0 * f + m.c.w1 * end;
    bool before = 0.0 < a_w0 && 0.0 < a_w1 && 0.0 < b_w0 && 0.0 < b_w1 && 0.0 < c_w0 && 0.0 < c_w1;
    bool by_w = 0.0 < divided;
    gnomon_bernstein_cubic d = gnomon_moving_edges_combine(x, gnomon_select(by_w, a_w0, 1.0),
                                                           gnomon_select(by_w, a_w1, 1.0),
                                                           gnomon_select(by_w, b_w0, 1.0),
                                                           gnomon_select(by_w, b_w1, 1.0),
                                                           gnomon_select(by_w, c_w0, 1.0),
                                                           gnomon_select(by_w, c_w1, 1.0));
    float free0 = n.c0 / d.c0;
    float free1 = n.c3 / d.c3;
    float turn0 = d.c1 - d.c0;
    float turn1 = d.c2 - d.c3;
    float p0 = (n.c1 - free0 * turn0) - free1 * d.c0;
    float p1 = (n.c1 + n.c2) - (free0 * d.c2 + free1 * d.c1);
    float p2 = (n.c2 - free1 * turn1) - free0 * d.c3;
    float most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), 0.5 * gnomon_abs(p1));
    float bend = gnomon_select(before, gnomon_depth_nonlinearity(most, d.c0, d.c3, turn0, turn1), 4.0);
    return gnomon_depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0,
                                    free1, bend, -1.0, 1.0);
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
float gnomon_moving_depth_time(float begin, float end, float passed)
{
    return gnomon_select(passed < 1.0, begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
depth_trial gnomon_depth_trial_begin(float begin, float end, float passed)
{
    depth_trial r;
    r.start = saturate_or_zero(passed);
    r.share = 1.0 - r.start;
    r.settled = 0.0;
    r.piece.t0 = gnomon_moving_depth_time(begin, end, r.start);
    r.piece.t1 = end;
    r.piece.z0 = 1.0;
    r.piece.z1 = 1.0;
    r.piece.passed = 1.0;
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
depth_trial gnomon_depth_trial_next(depth_trial trial, depth_line fit, float begin, float end, float tolerance)
{
    float shortest = 0.0322265625;
    bool fits = fit.deviation <= tolerance || trial.share <= shortest;
    float parts = gnomon_select(fit.deviation <= 4.0 * tolerance, 2.0, 3.0);
    float shorter = gnomon_max(trial.share / parts, shortest);
    float to = gnomon_min(trial.start + shorter, 1.0);
    trial.piece.z0 = fit.z0;
    trial.piece.z1 = fit.z1;
    trial.piece.t1 = gnomon_select(fits, trial.piece.t1, gnomon_moving_depth_time(begin, end, to));
    trial.piece.passed = gnomon_select(fits, trial.piece.passed, to);
    trial.share = gnomon_select(fits, trial.share, shorter);
    trial.settled = gnomon_select(fits, 1.0, 0.0);
    return trial;
}

/// The next piece of an interval, from the fraction `passed` on, whose line deviates by at most the tolerance: the rest
/// of the interval, or a half or a third of that, and so on. Pieces are as long as their lines fit (Palmer 2011,
/// chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// The loop gives 1 to 32 pieces. Each begins where the one before ends, bit for bit; the first begins at begin, the
/// last ends at end. Pieces before the last are never shorter than 33/1024 of the interval, even if the tolerance is
/// missed: where the triangle turns edge-on, no line fits. A tolerance below 0 gives 32 pieces.
/// NaN: a NaN tolerance gives 32 pieces; passed is then 0.
/// Error: that of moving_depth_line, for the deviation.
/// Source: Palmer 2011, Sec. 5
depth_piece moving_depth_piece(moving_triangle m, gnomon_moving_edges e, float begin, float end, float passed,
                               float divided, float tolerance)
{
    depth_trial r = gnomon_depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < 1.0)) r = gnomon_depth_trial_next(r,
                                                                     moving_depth_line(m, e, r.piece.t0, r.piece.t1,
                                                                                       divided), begin, end, tolerance);
    }
    return r.piece;
}

#endif

// comparators/prism.h -------------------------------------------------------------------------------------------------
// The prism of Hong & Oh ("Motion blurred shadows utilizing a depth-time ranges shadow map", Sec. 4.1 and 4.3): the
// volume that a moving triangle sweeps, enclosed by triangles that any rasterizer draws. Each triangle carries the
// time at its vertices, so the fragments of a texel tell when the moving triangle enters and leaves the texel, and
// at which depth.
//
// The caps of the prism are the moving triangle at shutter open and close. Each edge sweeps a side: four triangles
// around the midpoint of the edge halfway in time. If the edge at open crosses the edge at close on the screen, the
// side is a bow tie. Its centre is then at the crossing, and two of the four triangles, which have no area, are
// omitted. With A B the edge at open, C D the edge at close, and x the cross product, A + s (B - A) = C + u (D - C).
// Multiplication by D - C and by B - A gives (Eq. 1, with the signs that the printed order of factors loses)
//     s = (C - A) x (D - C) / (B - A) x (D - C),   u = (C - A) x (B - A) / (B - A) x (D - C).
// The paper does not say which attributes the crossing vertex gets. The edge passes there twice, at time 0 with depth
// z_AB(s) and at time 1 with depth z_CD(u). This text uses the mean of both: time 1/2 and the mean depth and 1 / w. The
// errors, half a shutter and half the distance of the depths, are then the least possible in the worst case. Without a
// crossing the centre has the attributes of the midpoint.
//
// Between vertices, time and depth are interpolated as rasterizers do by default, linearly in space, since the
// paper names no other way. The weight of corner k on the screen is its edge function e_k. Divided by w_k it is the
// weight in space:
//     time = sum_k e_k t_k / w_k / sum_k e_k / w_k
// Depth that is linear in view distance has the same weights. Depth z / w is linear on the screen and has the weights
// e_k. All of this is exact if the sides are plane and time is linear on them, hence for translations, also in
// perspective. A translation makes bow ties only of sides that are seen edge-on and have no area. For other motions
// prisms approximate: 10% to 13% of the triangles that rotate or deform are present at wrong times for more than 5% of
// the shutter (tests/comparators/prism_ranges.cpp). Prisms are therefore the comparator for moving_triangle.h, which is
// exact and the default. The ranges of one triangle in one texel:
//
//     prism p = prism_make(m, divided);
//     prism_pair pair = prism_pair_begin(id);
//     for (k = 0; k < 14; ++k)
//         pair = prism_pair_add(pair, prism_fragment_at(prism_triangle_make(p, k), s_x, s_y, divided));
//     prism_ranges ranges = prism_pair_end(pair);
#ifndef GNOMON_COMPARATORS_PRISM_H
#define GNOMON_COMPARATORS_PRISM_H

/// A vertex on the screen, with depth z, time t and inverse_w = 1 / w, which is 1 in orthographic views.
struct prism_vertex { float x, y, z, t, inverse_w; };

/// A triangle of a prism.
struct prism_triangle { prism_vertex a, b, c; };

/// The side that an edge sweeps: the vertex at its centre. crosses is 1 if the edge at open crosses the edge at close
/// there, else 0.
struct gnomon_prism_side
{
    prism_vertex centre;
    float crosses;
};

/// The corners at shutter open (0) and at shutter close (1), and the sides of the three edges.
struct gnomon_prism
{
    prism_vertex a0, b0, c0, a1, b1, c1;
    gnomon_prism_side ab, bc, ca;
};

/// A fragment: covered is 1 or 0, time is in [0, 1] and depth in [-1, 1].
struct prism_fragment { float covered, time, depth; };

/// The fragments of one triangle id in one texel: their number, the earliest, the latest, and the nearest four in
/// order.
struct prism_pair
{
    float id, count;
    prism_fragment earliest, latest, first, second, third, fourth;
};

/// The ranges of a triangle in a texel, count of them, 0 to 2; the remaining ones are empty.
struct prism_ranges
{
    depth_time_range first, second;
    float count;
};

const float prism_no_depth = 2.0; // behind every fragment

/// The vertex on the screen of a point in clip space at time t. divided is as for moving_depth_at. A vertex with w <= 0
/// or a NaN w produces no fragment.
prism_vertex gnomon_prism_vertex_make(float x, float y, float z, float w, float t, float divided)
{
    float divisor = gnomon_max(w, 0.0);
    prism_vertex r;
    r.x = x / divisor;
    r.y = y / divisor;
    r.z = gnomon_select(0.0 < divided, z / divisor, z);
    r.t = t;
    r.inverse_w = 1.0 / divisor;
    return r;
}

/// The vertex at shutter open.
prism_vertex gnomon_prism_vertex_open(gnomon_moving_vertex v, float divided)
{
    return gnomon_prism_vertex_make(v.x0, v.y0, v.z0, v.w0, 0.0, divided);
}

/// The vertex at shutter close.
prism_vertex gnomon_prism_vertex_close(gnomon_moving_vertex v, float divided)
{
    return gnomon_prism_vertex_make(v.x1, v.y1, v.z1, v.w1, 1.0, divided);
}

/// The factor of the screen weight in the interpolation of depth: 1 if depth is divided, else 1 / w, as for time.
float gnomon_prism_depth_weight(prism_vertex v, float divided)
{
    return gnomon_select(0.0 < divided, 1.0, v.inverse_w);
}

/// The vertex at the fraction `passed` of the way from a to b on the screen, at the time of a.
prism_vertex gnomon_prism_vertex_between(prism_vertex a, prism_vertex b, float passed, float divided)
{
    float left = 1.0 - passed;
    float weight_a = left * gnomon_prism_depth_weight(a, divided);
    float weight_b = passed * gnomon_prism_depth_weight(b, divided);
    prism_vertex r;
    r.x = a.x * left + b.x * passed;
    r.y = a.y * left + b.y * passed;
    r.z = (weight_a * a.z + weight_b * b.z) / (weight_a + weight_b);
    r.t = a.t;
    r.inverse_w = a.inverse_w * left + b.inverse_w * passed;
    return r;
}

/// The side that the edge from a to b sweeps. A centre without a crossing is the same, bit for bit, for b to a.
gnomon_prism_side gnomon_prism_side_make(gnomon_moving_vertex a, gnomon_moving_vertex b, float divided)
{
    prism_vertex a0 = gnomon_prism_vertex_open(a, divided);
    prism_vertex b0 = gnomon_prism_vertex_open(b, divided);
    prism_vertex a1 = gnomon_prism_vertex_close(a, divided);
    prism_vertex b1 = gnomon_prism_vertex_close(b, divided);
    float open_x = b0.x - a0.x;
    float open_y = b0.y - a0.y;
    float close_x = b1.x - a1.x;
    float close_y = b1.y - a1.y;
    float between_x = a1.x - a0.x;
    float between_y = a1.y - a0.y;
    float area = gnomon_sheared_cross(open_x, open_y, close_x, close_y);
    float s = gnomon_sheared_cross(between_x, between_y, close_x, close_y) / area;
    float u = gnomon_sheared_cross(between_x, between_y, open_x, open_y) / area;
    bool crosses = 0.0 <= s && s <= 1.0 && 0.0 <= u && u <= 1.0; // false if area is 0

    // The mean in clip space, where the midpoint of the moving edge is.
    float x = 0.25 * ((a.x0 + b.x0) + (a.x1 + b.x1));
    float y = 0.25 * ((a.y0 + b.y0) + (a.y1 + b.y1));
    float z = 0.25 * ((a.z0 + b.z0) + (a.z1 + b.z1));
    float w = 0.25 * ((a.w0 + b.w0) + (a.w1 + b.w1));
    prism_vertex middle = gnomon_prism_vertex_make(x, y, z, w, 0.5, divided);
    prism_vertex open = gnomon_prism_vertex_between(a0, b0, s, divided);
    prism_vertex close = gnomon_prism_vertex_between(a1, b1, u, divided);
    gnomon_prism_side r;
    r.centre.x = gnomon_select(crosses, open.x, middle.x);
    r.centre.y = gnomon_select(crosses, open.y, middle.y);
    r.centre.z = gnomon_select(crosses, 0.5 * (open.z + close.z), middle.z);
    r.centre.t = 0.5;
    r.centre.inverse_w = gnomon_select(crosses, 0.5 * (open.inverse_w + close.inverse_w), middle.inverse_w);
    r.crosses = gnomon_select(crosses, 1.0, 0.0);
    return r;
}

/// The prism of a moving triangle.
/// Domain: all w > 0 at shutter open and close, else parts of the prism are missing.
/// Source: Hong & Oh 2018, Sec. 4.1; Hong & Oh 2018, Eq. 1
gnomon_prism prism_make(moving_triangle m, float divided)
{
    gnomon_prism p;
    p.a0 = gnomon_prism_vertex_open(m.a, divided);
    p.b0 = gnomon_prism_vertex_open(m.b, divided);
    p.c0 = gnomon_prism_vertex_open(m.c, divided);
    p.a1 = gnomon_prism_vertex_close(m.a, divided);
    p.b1 = gnomon_prism_vertex_close(m.b, divided);
    p.c1 = gnomon_prism_vertex_close(m.c, divided);
    p.ab = gnomon_prism_side_make(m.a, m.b, divided);
    p.bc = gnomon_prism_side_make(m.b, m.c, divided);
    p.ca = gnomon_prism_side_make(m.c, m.a, divided);
    return p;
}

/// The vertex `first` for k <= 0, `second` for k = 1, else `third`.
prism_vertex gnomon_prism_choice(float k, prism_vertex first, prism_vertex second, prism_vertex third)
{
    bool is_first = k < 0.5;
    bool is_second = k < 1.5;
    prism_vertex r;
    r.x = gnomon_select(is_first, first.x, gnomon_select(is_second, second.x, third.x));
    r.y = gnomon_select(is_first, first.y, gnomon_select(is_second, second.y, third.y));
    r.z = gnomon_select(is_first, first.z, gnomon_select(is_second, second.z, third.z));
    r.t = gnomon_select(is_first, first.t, gnomon_select(is_second, second.t, third.t));
    r.inverse_w = gnomon_select(is_first, first.inverse_w, gnomon_select(is_second, second.inverse_w, third.inverse_w));
    return r;
}

/// Triangle k of the 14 of a prism: 0 to 3, 4 to 7 and 8 to 11 around the centres of the sides, 12 and 13 the caps.
/// Winding is not kept. The first and the third triangle of a side with a crossing are points.
/// Domain: k in 0, ..., 13; any other k gives a point.
/// Source: Hong & Oh 2018, Sec. 4.1
prism_triangle prism_triangle_make(gnomon_prism p, float k)
{
    float side = gnomon_select(k < 3.5, 0.0, gnomon_select(k < 7.5, 1.0, 2.0));
    float i = k - 4.0 * side;
    prism_vertex from0 = gnomon_prism_choice(side, p.a0, p.b0, p.c0);
    prism_vertex to0 = gnomon_prism_choice(side, p.b0, p.c0, p.a0);
    prism_vertex to1 = gnomon_prism_choice(side, p.b1, p.c1, p.a1);
    prism_vertex from1 = gnomon_prism_choice(side, p.a1, p.b1, p.c1);
    float crosses = gnomon_select(side < 0.5, p.ab.crosses, gnomon_select(side < 1.5, p.bc.crosses, p.ca.crosses));

    prism_triangle r;
    r.a = gnomon_prism_choice(i, from0, to0, gnomon_prism_choice(i - 2.0, to1, from1, from1));
    r.b = gnomon_prism_choice(i, to0, to1, gnomon_prism_choice(i - 2.0, from1, from0, from0));
    r.c = gnomon_prism_choice(side, p.ab.centre, p.bc.centre, p.ca.centre);
    float cap = k - 11.0;
    r.a = gnomon_prism_choice(cap, r.a, p.a0, p.a1);
    r.b = gnomon_prism_choice(cap, r.b, p.b0, p.b1);
    r.c = gnomon_prism_choice(cap, r.c, p.c0, p.c1);

    bool odd = (0.5 < i && i < 1.5) || 2.5 < i;
    bool none = (0.0 < crosses && k < 11.5 && !odd) || !(-0.5 < k && k < 13.5);
    float dropped = gnomon_select(none, 0.0, 1.0);
    r.b = gnomon_prism_choice(dropped, r.a, r.b, r.b);
    r.c = gnomon_prism_choice(dropped, r.a, r.c, r.c);
    return r;
}

/// The edge function of p and q at the sample (s_x, s_y).
float gnomon_prism_edge(prism_vertex p, prism_vertex q, float s_x, float s_y)
{
    return gnomon_sheared_cross(p.x - s_x, p.y - s_y, q.x - s_x, q.y - s_y);
}

/// The side of the edge from p to q that the sample is on, 1 or -1, for edge function e. If e is 0, the side of a point
/// slightly further along x and, far less, along y. 0 for an edge without length.
float gnomon_prism_edge_side(prism_vertex p, prism_vertex q, float e)
{
    float level = gnomon_select(q.x < p.x, -1.0, gnomon_select(p.x < q.x, 1.0, 0.0));
    float tie = gnomon_select(q.y < p.y, 1.0, gnomon_select(p.y < q.y, -1.0, level));
    return gnomon_select(0.0 < e, 1.0, gnomon_select(e < 0.0, -1.0, tie));
}

/// The fragment of a triangle at the sample (s_x, s_y), in the units of x / w. A sample is covered if it is on the same
/// side of all three edges. Exchanging the ends of an edge negates the side bit for bit, so triangles that share an
/// edge agree on the side of a sample. Triangles that meet at a sample all displace it to the same point nearby, which
/// is the fill rule of rasterizers, for either winding. A surface that encloses a volume therefore has an even number
/// of fragments. An odd number remains if rounding gives an edge function the wrong sign, and beside crossings, which
/// sides and caps share only up to rounding. A cap's time is exactly 0 or 1. divided is as for moving_depth_at.
/// Domain: |e_k| and |e_k / w_k| up to 2^60, triangles with an area; elsewhere the sample is not covered.
/// NaN: a triangle with a NaN coordinate covers no sample.
/// Error: of time, and of depth in units of the largest |z|, (48 X Y max_k v_k / |sum_k e_k v_k| + 10) 2^-p. X
/// and Y are the distances along each axis from the sample to the farthest vertex, and v_k = 1 / w_k, but 1
/// for divided depth.
/// Source: Hong & Oh 2018, Sec. 4.1
prism_fragment prism_fragment_at(prism_triangle v, float s_x, float s_y, float divided)
{
    float a = gnomon_prism_edge(v.b, v.c, s_x, s_y);
    float b = gnomon_prism_edge(v.c, v.a, s_x, s_y);
    float c = gnomon_prism_edge(v.a, v.b, s_x, s_y);
    float sides = (gnomon_prism_edge_side(v.b, v.c, a) + gnomon_prism_edge_side(v.c, v.a, b)) +
                  gnomon_prism_edge_side(v.a, v.b, c);
    float depth_a = a * gnomon_prism_depth_weight(v.a, divided);
    float depth_b = b * gnomon_prism_depth_weight(v.b, divided);
    float depth_c = c * gnomon_prism_depth_weight(v.c, divided);
    float depth = ((depth_a * v.a.z + depth_b * v.b.z) + depth_c * v.c.z) / ((depth_a + depth_b) + depth_c);
    float time_a = gnomon_product(a, v.a.inverse_w); // not contracted: a cap's time is exactly 0 or 1
    float time_b = gnomon_product(b, v.b.inverse_w);
    float time_c = gnomon_product(c, v.c.inverse_w);
    float weight = (time_a + time_b) + time_c;
    float size = gnomon_abs((a + b) + c); // inside all have one sign
    float limit = gnomon_moving_edge_limit;
    bool known = 0.0 < size && size < limit && 0.0 < gnomon_abs(weight) && gnomon_abs(weight) < limit;
    prism_fragment f;
    f.covered = gnomon_select(known && gnomon_abs(sides) == 3.0 && depth == depth, 1.0, 0.0);
    f.time = saturate_or_zero(((time_a * v.a.t + time_b * v.b.t) + time_c * v.c.t) / weight);
    f.depth = gnomon_max(gnomon_min(depth, 1.0), -1.0); // a NaN becomes 1
    return f;
}

/// The fragment b if chosen is 0, else a.
prism_fragment gnomon_prism_fragment_choice(float chosen, prism_fragment a, prism_fragment b)
{
    bool second = chosen == 0.0;
    prism_fragment r;
    r.covered = gnomon_select(second, b.covered, a.covered);
    r.time = gnomon_select(second, b.time, a.time);
    r.depth = gnomon_select(second, b.depth, a.depth);
    return r;
}

/// 1 if a is in front of b, or at the same depth and earlier; else 0.
float gnomon_prism_fragment_before(prism_fragment a, prism_fragment b)
{
    return gnomon_select(a.depth < b.depth || (a.depth == b.depth && a.time < b.time), 1.0, 0.0);
}

/// The state before the first fragment of the triangle with this id.
prism_pair prism_pair_begin(float id)
{
    prism_fragment none;
    none.covered = 0.0;
    none.time = 1.0;
    none.depth = prism_no_depth;
    prism_pair state;
    state.id = id;
    state.count = 0.0;
    state.earliest = none;
    state.latest = none;
    state.first = none;
    state.second = none;
    state.third = none;
    state.fourth = none;
    return state;
}

/// The state after one more fragment, in any order.
/// Domain: fragments that are covered, with time in [0, 1] and depth in [-1, 1]; others are ignored.
/// NaN: the fragment is ignored.
prism_pair prism_pair_add(prism_pair state, prism_fragment f)
{
    bool known = 0.0 <= f.time && f.time <= 1.0 && -1.0 <= f.depth && f.depth <= 1.0;
    bool some = 0.0 < f.covered && known;
    bool alone = state.count == 0.0;
    bool sooner = f.time < state.earliest.time || (f.time == state.earliest.time && f.depth < state.earliest.depth);
    bool later = state.latest.time < f.time || (f.time == state.latest.time && state.latest.depth < f.depth);
    float is_earliest = gnomon_select(some && (alone || sooner), 1.0, 0.0);
    float is_latest = gnomon_select(some && (alone || later), 1.0, 0.0);
    state.earliest = gnomon_prism_fragment_choice(is_earliest, f, state.earliest);
    state.latest = gnomon_prism_fragment_choice(is_latest, f, state.latest);
    state.count = state.count + gnomon_select(some, 1.0, 0.0);

    // Insertion into the sorted four: the farther of two goes on. An ignored fragment goes past all four.
    f.depth = gnomon_select(some, f.depth, prism_no_depth);
    f.time = gnomon_select(some, f.time, 1.0);
    float before = gnomon_prism_fragment_before(f, state.first);
    prism_fragment next = gnomon_prism_fragment_choice(before, state.first, f);
    state.first = gnomon_prism_fragment_choice(before, f, state.first);
    before = gnomon_prism_fragment_before(next, state.second);
    f = gnomon_prism_fragment_choice(before, state.second, next);
    state.second = gnomon_prism_fragment_choice(before, next, state.second);
    before = gnomon_prism_fragment_before(f, state.third);
    next = gnomon_prism_fragment_choice(before, state.third, f);
    state.third = gnomon_prism_fragment_choice(before, f, state.third);
    before = gnomon_prism_fragment_before(next, state.fourth);
    state.fourth = gnomon_prism_fragment_choice(before, next, state.fourth);
    return state;
}

/// The range between two fragments, in any order.
depth_time_range gnomon_prism_range_between(prism_fragment a, prism_fragment b, float id)
{
    return range_between(a.time, a.depth, b.time, b.depth, id);
}

/// The ranges of the fragments: between two fragments; of four, between the front two and between the rear two. The
/// paper does not treat other numbers, which occur if sides fold (six and more) and by rounding (odd numbers). A single
/// fragment does not tell how long the triangle stays and gives no range. Three, or more than four, give one range from
/// the earliest to the latest, so that no shadow is lost, though the range may last too long.
/// Source: Hong & Oh 2018, Sec. 4.3
prism_ranges prism_pair_end(prism_pair state)
{
    bool some = 1.0 < state.count;
    bool two = state.count == 4.0;
    depth_time_range whole = gnomon_prism_range_between(state.earliest, state.latest, state.id);
    depth_time_range front = gnomon_prism_range_between(state.first, state.second, state.id);
    depth_time_range rear = gnomon_prism_range_between(state.third, state.fourth, state.id);
    prism_ranges r;
    r.first = gnomon_range_select(some, gnomon_range_select(two, front, whole), range_empty(state.id));
    r.second = gnomon_range_select(two, rear, range_empty(state.id));
    r.count = gnomon_select(some, gnomon_select(two, 2.0, 1.0), 0.0);
    return r;
}

/// The size in bytes of a shadow map of prisms: 16 for a fragment (depth, time, id, link), 24 for a range (two times,
/// two depths, id, link), and 8 for a texel (the heads of its two lists).
/// Error: exact in float up to 2^27 bytes.
/// Source: Hong & Oh 2018, Eq. 2
float prism_map_bytes(float fragments, float ranges, float texels)
{
    return (16.0 * fragments + 24.0 * ranges) + 8.0 * texels;
}

#endif

// comparators/ray_march.h ---------------------------------------------------------------------------------------------
// Single scattering by ray marching through a shadow map (Toth & Umenhoffer 2009), with which prefiltered single
// scattering (Peters et al. 2017, Sec. 5) is compared: the view ray is cut into steps of equal length, and each step
// looks up the map once.
//
//     march = ray_march_begin(transmittance);                   of one step, exp(-sigma_t Delta)
//     march = ray_march_add(march, z, z_f);                     for every step, from the camera on
//     intensity = ray_march_end(march);
//
// Step k is looked up at (k + jitter) Delta, where z is the depth of the map there and z_f that of the ray. A jitter
// that differs between neighbouring pixels makes noise of what would be bands: ray_march_jitter.
//
// Light scattered in step k is proportional to what the air transmits on the way from its begin, and a factor that all
// steps share cancels in the mean. So the weights are exact, for any extinction; the sample within a step is not.
#ifndef GNOMON_COMPARATORS_RAY_MARCH_H
#define GNOMON_COMPARATORS_RAY_MARCH_H

/// The weight in shadow so far, that of all steps so far, the transmittance up to the next step, and that of one step.
struct ray_march { float shadowed, weight, transmittance, step; };

/// The state before the first step.
/// Domain: any transmittance of one step, limited to [0, 1].
/// NaN: 1, clear air.
ray_march ray_march_begin(float step_transmittance)
{
    ray_march r;
    r.shadowed = 0.0;
    r.weight = 0.0;
    r.transmittance = 1.0;
    r.step = clamp_or_high(step_transmittance, 0.0, 1.0);
    return r;
}

/// The state after one more step, at depth z_f, where the shadow map has depth z.
/// Domain: any depths.
/// NaN: lit, for either.
ray_march ray_march_add(ray_march state, float z, float z_f)
{
    state.shadowed = state.shadowed + gnomon_select(z < z_f, state.transmittance, 0.0);
    state.weight = state.weight + state.transmittance;
    state.transmittance = state.transmittance * state.step;
    return state;
}

/// Shadow intensity of the ray in [0, 1]: the part of the light scattered towards the camera that the shadow takes
/// away.
/// NaN: 0, lit; so before the first step.
/// Error: of n steps, 3 n 2^-p, for sums in the precision of p bits.
/// Source: Peters 2017, Sec. 5.5.1; Toth & Umenhoffer 2009
float ray_march_end(ray_march state) { return saturate_or_zero(state.shadowed / state.weight); }

const float ray_march_jitter_x = 0.06711056;
const float ray_march_jitter_y = 0.00583715;
const float ray_march_jitter_scale = 52.9829189;

/// x - floor(x), in [0, 1).
/// Domain: |x| <= 2^21.
float gnomon_ray_march_fraction(float x)
{
    float fraction = x - nearest_integer(x - 0.5);
    return gnomon_select(0.0 <= fraction && fraction < 1.0, fraction, 0.0); // also where nothing is rounded
}

/// A number in [0, 1) for the pixel at column x and row y: interleaved gradient noise, of which the values of 3 x 3
/// pixels lie evenly in [0, 1), so that a small blur removes what it leaves.
/// Domain: whole numbers, limited to [0, 65536].
/// NaN: that of column or row 65536.
/// Source: Jimenez 2014
float ray_march_jitter(float x, float y)
{
    float column = clamp_or_high(x, 0.0, 65536.0);
    float row = clamp_or_high(y, 0.0, 65536.0);
    float inner = gnomon_ray_march_fraction(ray_march_jitter_x * column + ray_march_jitter_y * row);
    return gnomon_ray_march_fraction(ray_march_jitter_scale * inner);
}

#endif

// comparators/three_pass_cover.h --------------------------------------------------------------------------------------
// The coverage map of Hong & Oh ("Efficient motion blurred shadows using a temporal shadow map", 2017): texels that one
// surface covers throughout the shutter, found from fragments of prisms (prism.h) in passes over the geometry.
// motion/range/range_cover.h finds the same covers in one pass from ranges.
//
// The nearest map holds time and id of the nearest fragment. A fragment with the same id and a time that differs by 1
// shows that the triangle is there at shutter open and at close: a cover. A fragment with another id in front of the
// cover revokes the cover. The paper compares with whichever end of the cover its second pass wrote last, since the
// depth test is off; this text compares with the farther end, which is independent of order and conservative. A third
// fragment with the cover's own id revokes the cover as well, since the triangle left and returned; the paper lets such
// a fragment pass. A cover that remains is in front at all times if depth is linear between the fragments. The paper's
// second and third pass are one pass here, since no order matters:
//
//     nearest = nearest_fragment_begin(1);       nearest = nearest_fragment_add(nearest, f);   for all f
//     state = fragment_cover_begin(nearest);     state = fragment_cover_add(state, f);         for all f
//     cover = fragment_cover_end(state);
#ifndef GNOMON_COMPARATORS_THREE_PASS_COVER_H
#define GNOMON_COMPARATORS_THREE_PASS_COVER_H

/// A fragment: time t in [0, 1], depth z in [-1, 1], and the id of a triangle, a whole number from 0.
struct gnomon_timed_fragment { float t, z, id; };

/// The nearest fragment; the number of fragments with its id, the farthest depth of these, and ends, 1 if one of these
/// is at the other end of the shutter, else 0; front, the nearest depth of all other fragments.
struct gnomon_fragment_cover
{
    gnomon_timed_fragment nearest;
    float count, far_depth, ends, front;
};

/// The state before the first fragment. Only fragments nearer than `cleared`, the depth of the cleared map, are kept.
gnomon_timed_fragment nearest_fragment_begin(float cleared)
{
    gnomon_timed_fragment r;
    r.t = 0.0;
    r.z = cleared;
    r.id = -1.0;
    return r;
}

/// The nearer of two fragments; at the same depth the one with the lesser id, then the earlier one.
/// Domain: f with id >= 0 and time in [0, 1]; others are ignored.
/// NaN: f is ignored.
/// Source: Hong & Oh 2017
gnomon_timed_fragment nearest_fragment_add(gnomon_timed_fragment nearest, gnomon_timed_fragment f)
{
    bool before = f.id < nearest.id || (f.id == nearest.id && f.t < nearest.t);
    bool known = 0.0 <= f.id && 0.0 <= f.t && f.t <= 1.0;
    bool taken = known && (f.z < nearest.z || (f.z == nearest.z && before));
    nearest.t = gnomon_select(taken, f.t, nearest.t);
    nearest.z = gnomon_select(taken, f.z, nearest.z);
    nearest.id = gnomon_select(taken, f.id, nearest.id);
    return nearest;
}

/// The state before the first fragment of the second pass, from the result of the first pass.
gnomon_fragment_cover fragment_cover_begin(gnomon_timed_fragment nearest)
{
    gnomon_fragment_cover state;
    state.nearest = nearest;
    state.count = 0.0;
    state.far_depth = nearest.z;
    state.ends = 0.0;
    state.front = 1.0;
    return state;
}

/// The state after one more fragment, in any order. The nearest fragment must be among them.
/// Domain: f with id >= 0 and time in [0, 1]; others are ignored.
/// NaN: f is ignored.
/// Source: Hong & Oh 2017
gnomon_fragment_cover fragment_cover_add(gnomon_fragment_cover state, gnomon_timed_fragment f)
{
    bool known = 0.0 <= f.id && 0.0 <= f.t && f.t <= 1.0 && f.z == f.z;
    bool same = known && f.id == state.nearest.id;
    bool other = known && !(f.id == state.nearest.id);
    bool end = same && 1.0 <= gnomon_abs(f.t - state.nearest.t);
    state.count = state.count + gnomon_select(same, 1.0, 0.0);
    state.ends = gnomon_select(end, 1.0, state.ends);
    state.far_depth = gnomon_select(same && state.far_depth < f.z, f.z, state.far_depth);
    state.front = gnomon_select(other && f.z < state.front, f.z, state.front);
    return state;
}

/// The cover as a range over the whole shutter, or an empty range if there is none.
depth_time_range fragment_cover_end(gnomon_fragment_cover state)
{
    bool alone = state.count == 2.0 && state.far_depth <= state.front;
    bool known = 0.0 <= state.nearest.id && -1.0 <= state.nearest.z;
    bool covers = known && 0.0 < state.ends && alone;
    gnomon_timed_fragment n = state.nearest;
    depth_time_range cover = range_between(n.t, n.z, 1.0 - n.t, state.far_depth, n.id);
    return gnomon_range_select(covers, cover, range_empty(-1.0));
}

#endif

// filters/cascade.h ---------------------------------------------------------------------------------------------------
// Cascades of one light: shadow maps of growing regions around the camera, the finest first (Engel 2006; Zhang et al.
// 2006). Every cascade has a weight in [0, 1] at a receiver: 1 within its region, falling to 0 over a band at its
// border. By view distance the regions are slices of the camera's frustum, by projection they are the maps' own
// squares, which reach farther. Over the maps front to back, intensities blend as layers do:
//
//     state = cascade_begin(weight, intensity);            for the finest cascade
//     state = cascade_add(state, weight, intensity);       for every other, the finer ones first
//     intensity = cascade_end(state);                      lit beyond the last one
//
// cascade_share is the part that the next cascade has in the result; a cascade with a share of 0 need not be read. One
// look-up for each receiver is enough where noise is filtered later: cascade_index_add finds the first cascade whose
// weight exceeds a threshold. The mean over thresholds drawn evenly from [0, 1) is the blend, as long as at most one
// weight lies between 0 and 1.
#ifndef GNOMON_FILTERS_CASCADE_H
#define GNOMON_FILTERS_CASCADE_H

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
float cascade_split(float near_distance, float far_distance, float fraction, float evenness)
{
    float f = saturate_or_zero(fraction);
    float e = saturate_or_zero(evenness);
    float logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    float even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
float gnomon_cascade_inside(float distance_inside, float band)
{
    float w = saturate_or_zero(distance_inside / gnomon_select(0.0 < band, band, 1.0));
    return gnomon_select(0.0 < band, w, gnomon_select(0.0 <= distance_inside, 1.0, 0.0));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end,
/// 0 from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
float cascade_weight_by_distance(float distance_, float end_distance, float band)
{
    return gnomon_cascade_inside(end_distance - distance_, band);
}

/// The weight in [0, 1] of a cascade at texture coordinates u, v in its map and signed depth z: 1 in the middle,
/// falling over a band to 0 at margin from the border of [0, 1] x [0, 1]. margin is the reach of filter and blur in
/// texture coordinates, so that no filter reads over the map's edge. z before the near plane or beyond the far plane
/// has weight 0: casters are moved to the near plane when the map is rendered, receivers are not.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p over band.
float cascade_weight_by_projection(float u, float v, float z, float margin, float band)
{
    float x = gnomon_abs(u - 0.5);
    float y = gnomon_abs(v - 0.5);
    float inside = (0.5 - margin) - gnomon_max(y, x);
    bool known = y <= 0.5 && gnomon_abs(z) <= 1.0; // a NaN in u is one in inside
    return gnomon_select(known, gnomon_cascade_inside(inside, band), 0.0);
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
struct cascade_blend { float intensity, rest; };

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
float cascade_share(cascade_blend state, float weight)
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
cascade_blend cascade_add(cascade_blend state, float weight, float intensity)
{
    float share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
cascade_blend cascade_begin(float weight, float intensity)
{
    cascade_blend r;
    r.intensity = 0.0;
    r.rest = 1.0;
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
float cascade_end(cascade_blend state) { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
struct cascade_index { float index, searching; };

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds
/// threshold, or as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
cascade_index cascade_index_add(cascade_index state, float weight, float threshold)
{
    state.searching = gnomon_select(threshold < weight, 0.0, state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
cascade_index cascade_index_begin(float weight, float threshold)
{
    cascade_index r;
    r.index = 0.0;
    r.searching = 1.0;
    return cascade_index_add(r, weight, threshold);
}

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
convolution_phase convolution_phase_at(float z, float span)
{
    float angle = gnomon_trigonometry_half_pi * span * z;
    gnomon_cosine_sine first = polynomial_cosine_sine(angle);
    gnomon_cosine_sine step = polynomial_cosine_sine(2.0 * angle);
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
convolution_phase convolution_encode(float z, convolution_settings settings)
{
    return convolution_phase_at(clamp_or_high(z, -1.0, 1.0), settings.span);
}

/// The phase of the next term, by rotation.
/// Error: of both values of term k, 8 k 2^-p.
convolution_phase convolution_next(convolution_phase phase)
{
    convolution_phase r = phase;
    r.cosine = phase.cosine * phase.step_cosine - phase.sine * phase.step_sine;
    r.sine = phase.sine * phase.step_cosine + phase.cosine * phase.step_sine;
    return r;
}

/// The weight w_k with its damping, k = 1, 2, ...: constant over texels and receivers, so best computed once.
/// Domain: terms at least 1, damping at least 0. An infinite damping leaves no term, and the series is 1/2.
/// NaN: NaN, which makes everything lit.
float convolution_weight(float k, convolution_settings settings)
{
    float ratio = k / settings.terms;
    return gnomon_trigonometry_two_over_pi * polynomial_exp(-settings.damping * (ratio * ratio)) / (2.0 * k - 1.0);
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
convolution_sum convolution_begin(float z_f, convolution_settings settings)
{
    convolution_sum r;
    r.receiver = convolution_phase_at(clamp_or_nan(z_f, -1.0, 1.0) - settings.offset, settings.span);
    r.intensity = 0.5;
    return r;
}

/// The state after the next term of the filtered map.
convolution_sum convolution_add(convolution_sum state, float cosine, float sine, float weight)
{
    state.intensity = state.intensity + weight * (state.receiver.sine * cosine - state.receiver.cosine * sine);
    state.receiver = convolution_next(state.receiver);
    return state;
}

/// Shadow intensity in [0, 1].
/// NaN: 0, lit.
/// Error: against the exact series over 16 terms, 150 2^-p.
/// Source: Annen 2007, Sec. 3
float convolution_end(convolution_sum state) { return saturate_or_zero(state.intensity); }

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

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

/// The unevaluated sum high + low.
struct gnomon_double_word { float high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
float gnomon_dekker_product_error(float a, float b, float p)
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
gnomon_double_word two_product(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
gnomon_double_word two_difference(float a, float b)
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
gnomon_double_word two_difference_ordered(float a, float b)
{
    gnomon_double_word r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
gnomon_double_word subtract_product_ordered(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
float subtract_product_rounded(float c, float a, float b)
{
    gnomon_double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
gnomon_double_word gnomon_double_word_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
                                            gnomon_double_word d)
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
float gnomon_double_word_determinant(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c)
{
    gnomon_double_word p = two_product(a.high, c.high);
    gnomon_double_word q = two_product(b.high, b.high);
    float cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

#endif

// filters/depth_bias.h ------------------------------------------------------------------------------------------------
// The depth bias that keeps a surface from shadowing itself: subtract it from the receiver's depth before the
// intensity. A filter region holds depths of the receiver's own plane that are nearer to the light than the receiver,
// by the most that the plane rises within the half widths of the filter. Half widths are those of blur and look-up
// together, from the receiver to the centre of the farthest texel; for mip level l they are 2^l times as large. 9 taps
// and bilinear filtering have 5.5 texels.
//
//     bias = depth_bias_slope_scaled(sine, cosine, 5.5 * footprint * depth_per_texel, 5.67);       from the normal
//
//     gradient = depth_gradient_from_derivatives(...);                                             from screen space
//     bias = depth_bias_receiver_plane(gradient, half_width_x, half_width_y, limit);
//
//     intensity = variance_unorm16_intensity(channels, z_f - bias);
#ifndef GNOMON_FILTERS_DEPTH_BIAS_H
#define GNOMON_FILTERS_DEPTH_BIAS_H

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
float gnomon_depth_bias_limit(float bias) { return gnomon_min(2.0, gnomon_max(bias, 0.0)); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
float depth_bias_slope_scaled(float across, float along, float rise, float steepest)
{
    return gnomon_depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
struct depth_gradient { float x, y; };

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
float gnomon_depth_gradient_minor(float a, float b, float c, float d)
{
    gnomon_double_word p = two_product(a, b);
    gnomon_double_word q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in
/// texels, and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
depth_gradient depth_gradient_from_derivatives(float x1, float y1, float depth1, float x2, float y2, float depth2)
{
    float determinant = gnomon_depth_gradient_minor(x1, y2, x2, y1);
    depth_gradient r;
    r.x = gnomon_depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = gnomon_depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of
/// the filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
float depth_bias_receiver_plane(depth_gradient gradient, float half_width_x, float half_width_y, float limit)
{
    float rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
    return gnomon_depth_bias_limit(gnomon_min(limit, rise));
}

/// The adaptive depth bias in [0, 2] for a look-up of a single texel: by how much the receiver is behind its own plane
/// where the plane meets the ray through the texel's centre, at most limit, plus epsilon. offset_x and offset_y lead
/// from that centre to the receiver, in texels. For a rectangle of texels depth_bias_receiver_plane is the largest of
/// these, less epsilon, if its half widths reach to the farthest centre.
/// Domain: any; limit and epsilon at least 0.
/// NaN: epsilon; a limit of NaN counts as none, an epsilon of NaN gives 0.
/// Error: relative, 4 2^-p of |gradient.x offset_x| + |gradient.y offset_y| + epsilon.
/// Source: Dou 2014
float depth_bias_texel_plane(depth_gradient gradient, float offset_x, float offset_y, float limit, float epsilon)
{
    float behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, 0.0);
    return gnomon_depth_bias_limit(gnomon_depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}

#endif

// filters/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).
#ifndef GNOMON_FILTERS_EXPONENTIAL_H
#define GNOMON_FILTERS_EXPONENTIAL_H

/// E[exp(c z)].
struct exponential_moment { float warped; };

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
struct exponential_settings { float exponent; };

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
exponential_moment exponential_encode(float z, exponential_settings settings)
{
    exponential_moment r;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, -1.0, 1.0));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in
/// float shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
float exponential_intensity(exponential_moment filtered, float z_f, exponential_settings settings)
{
    return saturate_or_zero(1.0 - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(1.0, z_f)));
}

#endif

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { float mean, square; };

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { float minimum_variance; };

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
variance_moments variance_encode(float z)
{
    variance_moments r;
    r.mean = clamp_or_high(z, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
float cantelli_lower(variance_moments moments, float receiver, float minimum_variance)
{
    float variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    float d = gnomon_max(0.0, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
float variance_intensity(variance_moments filtered, float z_f, variance_settings settings)
{
    return cantelli_lower(filtered, gnomon_min(1.0, z_f), settings.minimum_variance);
}

#endif

// filters/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.
#ifndef GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H
#define GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H

/// First and second moment of either warped depth.
struct exponential_variance_moments { float positive, positive_square, negative, negative_square; };

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
struct exponential_variance_settings { float positive_exponent, negative_exponent, minimum_variance; };

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
exponential_variance_moments gnomon_exponential_variance_warp(float z, exponential_variance_settings settings)
{
    exponential_variance_moments r;
    r.positive = polynomial_exp(settings.positive_exponent * z);
    r.positive_square = r.positive * r.positive;
    r.negative = -polynomial_exp(-settings.negative_exponent * z);
    r.negative_square = r.negative * r.negative;
    return r;
}

/// The warped moments of one depth z of the map.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of each value, relative, (2 c + 4) 2^-p.
exponential_variance_moments exponential_variance_encode(float z, exponential_variance_settings settings)
{
    return gnomon_exponential_variance_warp(clamp_or_high(z, -1.0, 1.0), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
float exponential_variance_side(variance_moments moments, float warped, float exponent, float minimum_variance)
{
    float scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < 1.0, 1125899906842624.0,
                                1.0);
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    float slope = exponent * (warped * scale);
    return cantelli_lower(moments, warped * scale, minimum_variance * (slope * slope));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f, limited to [-1, 1]; exponents of at least 0, minimum_variance as of cantelli_lower. An exponent of
/// 0, or one so large that squares overflow, takes the bound of its own warp away. A negative one turns the order of
/// depths around.
/// NaN: a NaN receiver gives 0, lit; a NaN moment or exponent takes the bound of its own warp away, which leaves the
/// other's.
/// Error: that of cantelli_lower for the warped depths, with r = (2 c + 8) 2^-p, the larger of both.
/// Source: Lauritzen & McCool 2008; Peters 2017, Sec. 2.2
float exponential_variance_intensity(exponential_variance_moments filtered, float z_f,
                                     exponential_variance_settings settings)
{
    variance_moments positive;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    variance_moments negative;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    exponential_variance_moments receiver = gnomon_exponential_variance_warp(clamp_or_nan(z_f, -1.0, 1.0), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
}

#endif

// filters/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps (Lauritzen & McCool 2008, "Layered variance shadow maps", section 3): depth is cut into
// layers, and each has a variance shadow map of the depth clamped to it and stretched to [-1, 1]. Clamping keeps the
// order of depths, so that every layer bounds the shadow intensity from below, and the largest bound holds. Depths in
// front of a layer are clamped to its front: only occluders and receivers that share a layer leak light.
//
//     state = layered_variance_begin(z_f);
//     state = layered_variance_add(state, filtered, settings);      for every layer, or just for the receiver's own
//     intensity = layered_variance_end(state);
#ifndef GNOMON_FILTERS_LAYERED_VARIANCE_H
#define GNOMON_FILTERS_LAYERED_VARIANCE_H

/// A layer holds depths within 1 / scale of its centre; the minimum variance is that of the stretched depth.
struct layered_variance_settings { float centre, scale, minimum_variance; };

/// The layer's own depth of a depth z, in [-1, 1].
/// Domain: any z; scale at least 0. For 0 the layer tells no depths apart; an infinite scale is a shadow test at the
/// centre. A negative scale turns the order of depths around.
/// NaN: NaN.
float layered_variance_depth(float z, layered_variance_settings settings)
{
    return clamp_or_nan((z - settings.centre) * settings.scale, -1.0, 1.0);
}

/// The layer's moments of one depth z.
/// Domain: any z.
/// NaN: the far end of the layer, which shadows nothing.
variance_moments layered_variance_encode(float z, layered_variance_settings settings)
{
    // Clamp once, not by layered_variance_depth and then by variance_encode: clang 14 drops the second clamp, and a
    // NaN would stay a NaN.
    variance_moments r;
    r.mean = clamp_or_high((z - settings.centre) * settings.scale, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// The receiver's depth, and the largest bound so far.
struct layered_variance { float receiver, intensity; };

/// The state before the first layer.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: lit.
layered_variance layered_variance_begin(float z_f)
{
    layered_variance r;
    r.receiver = gnomon_min(1.0, z_f);
    r.intensity = 0.0;
    return r;
}

/// The state after one more layer with its filtered moments.
/// NaN: a layer with a NaN moment, centre or scale bounds nothing.
layered_variance layered_variance_add(layered_variance state, variance_moments filtered,
                                      layered_variance_settings settings)
{
    float receiver = layered_variance_depth(state.receiver, settings);
    state.intensity = gnomon_max(state.intensity, cantelli_lower(filtered, receiver, settings.minimum_variance));
    return state;
}

/// Shadow intensity in [0, 1], never above percentage-closer filtering but for rounding.
/// NaN: 0, lit.
/// Error: that of cantelli_lower for the layers' own depths, with r = 8 2^-p, the largest of all.
/// Source: Lauritzen & McCool 2008, Sec. 3
float layered_variance_end(layered_variance state) { return saturate_or_zero(state.intensity); }

#endif

// filters/percentage_closer.h -----------------------------------------------------------------------------------------
// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);
#ifndef GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#define GNOMON_FILTERS_PERCENTAGE_CLOSER_H

/// The receiver's depth, and the weight in front of the receiver so far.
struct percentage_closer { float receiver, shadowed; };

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
percentage_closer percentage_closer_begin(float z_f)
{
    percentage_closer r;
    r.receiver = gnomon_min(1.0, z_f);
    r.shadowed = 0.0;
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
percentage_closer percentage_closer_add(percentage_closer state, float z, float weight)
{
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, 0.0);
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
float percentage_closer_end(percentage_closer state) { return saturate_or_zero(state.shadowed); }

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
float bias_weight_of_roundings(float w, float n)
{
    float nw = gnomon_max(1.0, n) * w;
    return nw / ((1.0 - w) + nw);
}

#endif

// moments/bias.h, four moments ----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_4
#define GNOMON_MOMENTS_BIAS_4

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
const float bias4_raw_b2 = 0.41397147664677789;
const float bias4_raw_b4 = 0.41397147664677789;
const float bias4_raw_paper_b2 = 0.375;
const float bias4_raw_paper_b4 = 0.375;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
const float bias4_theta_b2 = 0.66391434671237689;
const float bias4_theta_b4 = 0.66391434671237689;
const float bias4_theta_paper_b2 = 0.628;
const float bias4_theta_paper_b4 = 0.628;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
moments4 moments4_add_bias(moments4 b, float bias2, float bias4, float alpha)
{
    float keep = 1.0 - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    return b;
}

#endif

// moments/bias.h, six moments -----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_6
#define GNOMON_MOMENTS_BIAS_6

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
const float bias6_raw_b2 = 0.42015374983242804;
const float bias6_raw_b4 = 0.2876068288776971;
const float bias6_raw_b6 = 0.25730795870391842;

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
const float gnomon_bias6_theta_b2 = 0.61284694380550628;
const float gnomon_bias6_theta_b4 = 0.52469968779048582;
const float gnomon_bias6_theta_b6 = 0.50463026403505464;
const float bias6_paper_b2 = 0.5566;
const float bias6_paper_b4 = 0.489;
const float bias6_paper_b6 = 0.47869382;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
moments6 moments6_add_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0 - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
}

#endif

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H

/// The two roots, in no particular order.
struct gnomon_quadratic_result { float first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
gnomon_quadratic_result quadratic_roots(float a, float b, float c)
{
    float r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0));
    float t = gnomon_select(b > 0.0, -(b + r), r - b);
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
struct hamburger_bounds { float lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
float bounds_intensity(hamburger_bounds bounds, float overestimation)
{
    return saturate_or_zero(bounds.lower + (1.0 - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
float over_darken(float intensity, float strength) { return saturate_or_zero(intensity / strength); }

#endif

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
gnomon_double_word gnomon_covariance_add_bias(gnomon_double_word c, float b_i, float b_j, float e_ij, float e_i,
                                              float e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

#endif

// moments/hankel4.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of four moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side).
//
//     B = | 1  b1 b2 |      The factorization L D L^T has the pivots 1, D_1 = E[P_1^2] and D_2 = E[P_2^2], where
//         | b1 b2 b3 |      P_1 = z - b1 and P_2 = P_1^2 - g P_1 - D_1 are the monic orthogonal polynomials of the
//         | b2 b3 b4 |      distribution.
//
// After the first step of elimination the covariances of (z, z^2) remain: V = var z = D_1, L = cov(z, z^2) and
// M = var z^2, and D_1 D_2 = V M - L^2. All three cancel, so they are computed from exact products. A bias (bias.h) is
// added to the covariances, as double words, because added to the moments it would be rounded away. hamburger4.h
// divides later, and uses G = g V = E[P_1^3] = L - 2 b1 V in place of L.
#ifndef GNOMON_MOMENTS_HANKEL4_4
#define GNOMON_MOMENTS_HANKEL4_4

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
struct hankel4 { float mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
hankel4 gnomon_hankel4_make(float mean, float variance, float covariance, float determinant)
{
    hankel4 h;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, variance);
    h.third = covariance - (mean + mean) * h.variance;
    h.determinant = gnomon_max(gnomon_pivot_floor * h.variance, determinant);
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 16-bit storage, whose
/// own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
hankel4 hankel4_from_moments(moments4 b)
{
    float v = b.b2 - b.b1 * b.b1;
    float l = b.b3 - b.b1 * b.b2;
    float m = b.b4 - b.b2 * b.b2;
    return gnomon_hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
struct gnomon_covariances4 { gnomon_double_word v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
gnomon_covariances4 gnomon_covariances4_from_moments(moments4 b)
{
    gnomon_covariances4 c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
hankel4 gnomon_hankel4_with_change(moments4 b, moments4 e)
{
    gnomon_covariances4 c = gnomon_covariances4_from_moments(b);
    gnomon_double_word v = gnomon_covariance_add_bias(c.v, b.b1, b.b1, e.b2, e.b1, e.b1);
    gnomon_double_word l = gnomon_covariance_add_bias(c.l, b.b1, b.b2, e.b3, e.b1, e.b2);
    gnomon_double_word m = gnomon_covariance_add_bias(c.m, b.b2, b.b2, e.b4, e.b2, e.b2);
    return gnomon_hankel4_make(b.b1 + e.b1, v.high + v.low, l.high + l.low, gnomon_double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
hankel4 hankel4_constant_bias(moments4 b, float bias2, float bias4, float alpha)
{
    moments4 e;
    e.b1 = -1.0 * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = -1.0 * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    return gnomon_hankel4_with_change(b, e);
}

#endif

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four moments: sharp bounds on Z(z < z_f) over all depth distributions Z with these moments
// (the Hamburger moment problem; Peters et al. 2017, Eq. 1 and Alg. 1), without solving for all nodes and weights.
//
// The Christoffel-Darboux kernel K(x, y) = sum_k P_k(x) P_k(y) / D_k of the factored Hankel matrix (hankel4.h)
// gives the canonical distribution with a node at z_f: the other two nodes are the roots of K(z_f, .), and a node
// at z has the weight w(z) = 1 / K(z, z). The number of nodes above z_f is the number of sign changes in
// P_0(z_f), P_1(z_f), P_2(z_f):
//     no node above:      lower = 1 - w_f
//     both nodes above:   lower = 0
//     one node above:     lower = w(smaller root)
// and upper = lower + w_f. Let x = z - mean, u = z_f - mean, V = D_1, N = D_1 D_2, W = V N and
// Q(x) = V P_2 = (V x - G) x - V^2. Then
//     w(z) = W / (W + x^2 N + Q(x)^2)
//     K(z_f, .) = 0:    a x^2 + 2 b x + c = 0,    a = Q V,    2 b = u N - Q G,    c = W - Q V^2,    Q = Q(u)
// If one root lies on each side, Q < 0, so r^2 = b^2 - a c is a sum of positive terms. The two nodes beside z_f have
// the weight E / (W + E) together, E = u^2 N + Q^2, and their mean balances z_f about the mean of all, which gives the
// weight of the smaller one without its root:
//     w(smaller root) = (E (r + b) - W u a) / (2 r (W + E))
// The whole takes one division and one square root.
#ifndef GNOMON_MOMENTS_HAMBURGER4_H
#define GNOMON_MOMENTS_HAMBURGER4_H

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
struct gnomon_distribution3 { float depth0, depth1, depth2, weight0, weight1, weight2; };

#endif

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_HAMBURGER4_4
#define GNOMON_MOMENTS_HAMBURGER4_4

const float gnomon_hamburger4_scale = 72057594037927936.0;     // 2^56
const float hamburger4_lower_scale = 281474976710656.0; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
float gnomon_hamburger4_q(hankel4 h, float x) { return (h.variance * x - h.third) * x - h.variance * h.variance; }

/// The weight of the node at mean + x, where q = Q(x).
float gnomon_hamburger4_weight(hankel4 h, float x, float q)
{
    float w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
struct hamburger4_quadratic { float a, b, c; };

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
hamburger4_quadratic gnomon_hamburger4_other_nodes(hankel4 h, float u, float q)
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    float n = h.determinant * gnomon_hamburger4_scale;
    float s = q * gnomon_hamburger4_scale;
    hamburger4_quadratic r;
    r.a = s * h.variance;
    r.b = 0.5 * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
struct hamburger4_fractions { float share, total, receiver, whole; };

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
hamburger4_fractions gnomon_hamburger4_fractions_at(hankel4 h, float z_f)
{
    float u = clamp_or_nan(z_f, -1.0, 1.0) - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5 * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    hamburger4_fractions f;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    bool between = q < 0.0;
    // Elsewhere u is never 0 and the quotient is e / whole with the sign of u: a negative lower bound is clamped to 0.
    f.share = gnomon_select(between, e * (r + b) - f.receiver * (u * a), e * u);
    f.total = gnomon_select(between, r + r, gnomon_abs(u)) * f.whole;
    return f;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, three depths and more: p99 1e-13, p99.9 2e-12
///     error, float, hankel4_constant_bias at 3e-7: p99 3e-5, p99.9 1e-4, max 5e-4
/// and against the kernel in double, with maxima found by climbing (tests/moments/honest_four.cpp),
///     error, float, hankel4_from_float: p99 3e-5, p99.9 1e-4, max 5e-4
///     error, float, hankel4_from_float_filtered: p99 2e-5, p99.9 5e-5, max 1e-4
///     error, float, hankel4_from_half: p99 3e-5, p99.9 1e-4, max 2e-3
///     error, float, hankel4_from_half_filtered: p99 1e-5, p99.9 3e-5, max 3e-4
///     error, float, hankel4_from_unorm16: p99 4e-4, p99.9 2e-3, max 5e-2
///     error, float, hankel4_from_unorm16_filtered: p99 2e-4, p99.9 6e-4, max 4e-3
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
float hamburger4_lower(hankel4 h, float z_f)
{
    hamburger4_fractions f = gnomon_hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
hamburger_bounds hamburger4_bounds(hankel4 h, float z_f)
{
    hamburger4_fractions f = gnomon_hamburger4_fractions_at(h, z_f);
    hamburger_bounds r;
    r.lower = saturate_or_zero(f.share / f.total);
    r.weight = gnomon_min(saturate_or_zero(f.receiver / f.whole), 1.0 - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// The canonical distribution with a node at z_f. The other two depths are finite, at most 1024 from the mean, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1
gnomon_distribution3 hamburger4_distribution(hankel4 h, float z_f)
{
    float z = clamp_or_nan(z_f, -1.0, 1.0);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    hamburger4_quadratic p = gnomon_hamburger4_other_nodes(h, u, q);
    gnomon_quadratic_result x = quadratic_roots(p.a, p.b, p.c);
    float x1 = clamp_or_nan(x.first, -1024.0, 1024.0);
    float x2 = clamp_or_nan(x.second, -1024.0, 1024.0);
    float w0 = gnomon_hamburger4_weight(h, u, q);
    float w1 = gnomon_hamburger4_weight(h, x1, gnomon_hamburger4_q(h, x1));
    float w2 = gnomon_hamburger4_weight(h, x2, gnomon_hamburger4_q(h, x2));
    float sum = w0 + (w1 + w2);
    bool swapped = x2 < x1;
    bool known = sum > 0.0; // false for NaN
    gnomon_distribution3 d;
    d.depth0 = gnomon_select(known, z, 1.0);
    d.depth1 = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), 1.0);
    d.depth2 = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), 1.0);
    d.weight1 = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, 0.0);
    d.weight2 = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, 0.0);
    d.weight0 = saturate_or_zero(1.0 - (d.weight1 + d.weight2));
    return d;
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
float over(float below, float above, float alpha)
{
    float a = saturate_or_zero(alpha);
    float mixed = (1.0 - a) * below + a * above;
    return gnomon_select(0.0 < a, gnomon_select(a < 1.0, mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
struct gnomon_front_to_back { float weight, transmittance; };

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
gnomon_front_to_back front_to_back_begin(float alpha)
{
    gnomon_front_to_back state;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = 1.0 - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
gnomon_front_to_back front_to_back_add(gnomon_front_to_back state, float alpha)
{
    float a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (1.0 - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
const float gnomon_alpha_test_one_percent = 0.01;

const float gnomon_blend_least_alpha = 5.9604644775390625e-8; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
float blend_roundings(float least_alpha)
{
    return 1.0 / gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
float blend_roundings_of_layers(float least_alpha, float layers)
{
    float a = gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
    float further = gnomon_max(1.0, layers) - 1.0;
    float few = (further + 1.0) / (1.0 + 0.5 * (further * a));
    return gnomon_min(few, 1.0 / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
float gnomon_blended_roundings(float further, float each) { return 1.0 + each * gnomon_max(0.0, further); }

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
const float gnomon_blended_half_roundings = 2.0;
const float gnomon_blended_float_roundings = 3.5;

#endif

// moments/translucency.h, four moments --------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_4
#define GNOMON_MOMENTS_TRANSLUCENCY_4

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
moments4 moments4_over(moments4 below, float z, float alpha)
{
    moments4 b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    return b;
}

#endif

// moments/translucency.h, six moments ---------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_6
#define GNOMON_MOMENTS_TRANSLUCENCY_6

/// The six moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
moments6 moments6_over(moments6 below, float z, float alpha)
{
    moments6 b = moments6_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    b.b5 = over(below.b5, b.b5, alpha);
    b.b6 = over(below.b6, b.b6, alpha);
    return b;
}

#endif

// moments/absorbance.h ------------------------------------------------------------------------------------------------
// Absorbance moments: translucent occluders without an order (Munstermann 2018; Sharpe 2018), which Peters et al.
// (2017, Sec. 3.1) leave out. The logarithm turns the product of transmittances into a sum,
//     transmittance before z = prod of (1 - alpha_k) over z_k < z = exp(-sum of a_k over z_k < z),    a_k = -ln(1 -
// alpha_k) so fragments are added, in any order, as their absorbance times the powers of their depth: b_j = sum_k a_k
// z_k^j, with b_0 kept. b_j / b_0 are moments of a depth distribution Z, and exp(-b_0 Z(z < z_f)) is the transmittance.
//
//     map            b = absorbance4_add(b, absorbance4_of_fragment(z, alpha)) from zeros, by additive blending
//     receiver       absorbance4_transmittance(b, ...) and transmitted_intensity with the shadow of the opaque
// occluders
//
// Opaque occluders are in a map of their own: their absorbance is infinite, and filtered with that of others it would
// shadow all of the filter region. For the same reason a filter over absorbances is darker than the mean transmittance,
// exp(-mean a) <= mean exp(-a), and near it only where absorbance varies little in the filter region. Fragments behind
// an opaque occluder are added, too: then both maps are independent, and their transmittances multiply.
#ifndef GNOMON_MOMENTS_ABSORBANCE_H
#define GNOMON_MOMENTS_ABSORBANCE_H

/// Sums of absorbance times powers of depth, b0 to b4.
struct absorbance4 { float b0, b1, b2, b3, b4; };

const float absorbance_most = 16.0;

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
float absorbance_of_opacity(float alpha)
{
    float absorbed = -1.0 * polynomial_log(1.0 - saturate_or_zero(alpha));
    return gnomon_min(absorbed, absorbance_most);
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
absorbance4 absorbance4_of_fragment(float z, float alpha)
{
    float a = absorbance_of_opacity(alpha);
    moments4 m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    absorbance4 b;
    b.b0 = a;
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of fragments together.
absorbance4 absorbance4_add(absorbance4 sum, absorbance4 b)
{
    sum.b0 = sum.b0 + b.b0;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

const float absorbance_least = 7.62939453125e-6; // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are
/// meant in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
hankel4 absorbance4_factor(absorbance4 b, float alpha)
{
    float scale = 1.0 / gnomon_max(absorbance_least, b.b0);
    moments4 m;
    m.b1 = b.b1 * scale;
    m.b2 = b.b2 * scale;
    m.b3 = b.b3 * scale;
    m.b4 = b.b4 * scale;
    return hankel4_constant_bias(m, bias4_raw_b2, bias4_raw_b4, alpha);
}

const float absorbance_scale = 5.421010862427522170037e-20; // 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
float absorbance_transmittance(float b0, float intensity)
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    float absorbed = saturate_or_zero(b0 * absorbance_scale) * 18446744073709551616.0;
    float t = polynomial_exp(-1.0 * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, 1.0);
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
float gnomon_absorbance4_intensity(hankel4 h, float alpha, float overestimation, float z_f)
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (1.0 - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1],
/// clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
float absorbance4_transmittance(absorbance4 b, float alpha, float overestimation, float z_f)
{
    return absorbance_transmittance(b.b0,
                                    gnomon_absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation,
                                                                 z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the
/// given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
float transmitted_intensity(float opaque, float transmittance)
{
    float absorbed = saturate_or_zero(1.0 - transmittance);
    float o = saturate_or_zero(opaque);
    return o + (1.0 - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of
/// the three as absorbance.
struct gnomon_coloured_absorbance4 { float red, green, blue, b1, b2, b3, b4; };

/// Transmittances, each in [0, 1].
struct gnomon_coloured_transmittance { float red, green, blue; };

const float absorbance_third = 0.33333333333333331;

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
gnomon_coloured_absorbance4 coloured_absorbance4_of_fragment(float z, float red, float green, float blue)
{
    gnomon_coloured_absorbance4 b;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    float a = absorbance_third * (b.red + (b.green + b.blue));
    moments4 m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
gnomon_coloured_absorbance4 coloured_absorbance4_add(gnomon_coloured_absorbance4 sum, gnomon_coloured_absorbance4 b)
{
    sum.red = sum.red + b.red;
    sum.green = sum.green + b.green;
    sum.blue = sum.blue + b.blue;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

/// The transmittances at depth z_f, from one distribution of depth for all channels: right in front of all fragments,
/// behind all, and wherever their hues are alike. The arguments are those of absorbance4_transmittance.
/// Domain: as of absorbance4_transmittance.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
gnomon_coloured_transmittance coloured_absorbance4_transmittance(gnomon_coloured_absorbance4 b, float alpha,
                                                                 float overestimation, float z_f)
{
    absorbance4 shared_depths;
    shared_depths.b0 = absorbance_third * (b.red + (b.green + b.blue));
    shared_depths.b1 = b.b1;
    shared_depths.b2 = b.b2;
    shared_depths.b3 = b.b3;
    shared_depths.b4 = b.b4;
    float intensity = gnomon_absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation,
                                                   z_f);
    gnomon_coloured_transmittance t;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
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
struct depth_change { float scale, offset; };

/// The change from signed depth between two planes, at near_distance and far_distance from the light, to signed depth
/// between two others, at target_near and target_far. All distances are measured along the same axis, in any unit.
/// Domain: near_distance < far_distance, target_near < target_far.
/// NaN: NaN.
/// Error: 8 2^-p of the largest distance over target_far - target_near.
depth_change depth_change_from_planes(float near_distance, float far_distance, float target_near, float target_far)
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
float depth_affine(float z, depth_change change) { return z * change.scale + change.offset; }

#endif

// moments/affine.h, four moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_AFFINE_4
#define GNOMON_MOMENTS_AFFINE_4

// (1/3 + sqrt 3) / (2 65535) / r, where r = 0.17678 is the distance of the bias vector (0, 0.375, 0, 0.375) to the
// boundary of the vectors of moments, and the error of theta4_inverse and moments4_affine in float.
const float affine4_unorm16_weight = 9.6e-5;

/// The moments of z scale + offset, where b are the four moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 6 2^-p, absolute.
/// Source: Peters 2017, Eq. 2
moments4 moments4_affine(moments4 b, depth_change change)
{
    float s = change.scale;
    float o = change.offset;
    float s2 = s * s;
    float c1 = s * b.b1;
    float c2 = s2 * b.b2;
    float c3 = s2 * s * b.b3;
    moments4 r;
    r.b1 = c1 + o;
    r.b2 = c2 + o * (2.0 * c1 + o);
    r.b3 = c3 + o * (3.0 * c2 + o * (3.0 * c1 + o));
    r.b4 = s2 * s2 * b.b4 + o * (4.0 * c3 + o * (6.0 * c2 + o * (4.0 * c1 + o)));
    return r;
}

#endif

// moments/affine.h, six moments ---------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_AFFINE_6
#define GNOMON_MOMENTS_AFFINE_6

/// The moments of z scale + offset, where b are the six moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 9 2^-p, absolute.
moments6 moments6_affine(moments6 b, depth_change change)
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
    r.b2 = c2 + o * (2.0 * c1 + o);
    r.b3 = c3 + o * (3.0 * c2 + o * (3.0 * c1 + o));
    r.b4 = c4 + o * (4.0 * c3 + o * (6.0 * c2 + o * (4.0 * c1 + o)));
    r.b5 = c5 + o * (5.0 * c4 + o * (10.0 * c3 + o * (10.0 * c2 + o * (5.0 * c1 + o))));
    r.b6 = s2 * s2 * s2 * b.b6 + o *
           (6.0 * c5 + o * (15.0 * c4 + o * (20.0 * c3 + o * (15.0 * c2 + o * (6.0 * c1 + o)))));
    return r;
}

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

struct channels1 { float c1; };

struct channels2 { float c1, c2; };

struct channels5 { float c1, c2, c3, c4, c5; };

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

struct channels4 { float c1, c2, c3, c4; };

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

struct channels6 { float c1, c2, c3, c4, c5, c6; };

#endif

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_4
#define GNOMON_MOMENTS_QUANTIZATION_4

/// The moments that a format without transform holds as they are.
moments4 moments4_from_channels(channels4 c)
{
    moments4 b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    return b;
}

/// The moments b as the channels of a format without transform.
channels4 channels4_from_moments(moments4 b)
{
    channels4 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    return c;
}

const float gnomon_theta4_31 = 0.8660254037844386;   // sqrt(3) / 2
const float gnomon_theta4_33 = -0.38490017945975052; // -2 sqrt(3) / 9
const float gnomon_theta4_inverse11 = -0.33333333333333331;
const float gnomon_theta4_inverse13 = 1.7320508075688772;
const float gnomon_theta4_inverse33 = 1.299038105676658;

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
channels4 theta4(moments4 b)
{
    channels4 c;
    c.c1 = 1.5 * b.b1 - 2.0 * b.b3 + 0.5;
    c.c2 = 4.0 * (b.b2 - b.b4);
    c.c3 = gnomon_theta4_31 * b.b1 + gnomon_theta4_33 * b.b3 + 0.5;
    c.c4 = 0.5 * (b.b2 + b.b4);
    return c;
}

/// The four moments of channels c: the inverse of theta4.
/// Source: Peters 2017, Eq. 3
moments4 theta4_inverse(channels4 c)
{
    float c1 = c.c1 - 0.5;
    float c3 = c.c3 - 0.5;
    moments4 b;
    b.b1 = gnomon_theta4_inverse11 * c1 + gnomon_theta4_inverse13 * c3;
    b.b2 = 0.125 * c.c2 + c.c4;
    b.b3 = gnomon_theta4_inverse33 * c3 - 0.75 * c1;
    b.b4 = c.c4 - 0.125 * c.c2;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
moments4 theta4_inverse_add_bias(channels4 c, float bias, float alpha)
{
    float keep = 1.0 - alpha;
    float c1 = c.c1 - 0.5;
    float c3 = c.c3 - 0.5;
    float c2 = (0.125 * keep) * c.c2;
    float c4 = keep * c.c4 + alpha * bias;
    moments4 b;
    b.b1 = (keep * gnomon_theta4_inverse11) * c1 + (keep * gnomon_theta4_inverse13) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * gnomon_theta4_inverse33) * c3 - (0.75 * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

#endif

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_QUANTIZATION_6
#define GNOMON_MOMENTS_QUANTIZATION_6

/// The moments that a format without transform holds as they are.
moments6 moments6_from_channels(channels6 c)
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
channels6 channels6_from_moments(moments6 b)
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
const float gnomon_theta6_21 = -1.8745771666290014;
const float gnomon_theta6_23 = 4.204664766466248;
const float gnomon_theta6_25 = -1.8300875998372463;
const float gnomon_theta6_31 = 1.2643431422063351;
const float gnomon_theta6_33 = -1.4716161665593888;
const float gnomon_theta6_35 = 0.70727302435305361;
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
const float gnomon_theta6_62 = -0.57735026918962573;
const float gnomon_theta6_64 = 4.6188021535170058;
const float gnomon_theta6_66 = -3.0792014356780042;
const float gnomon_theta6_60 = 0.018874775675311862;
const float gnomon_theta6_inverse11 = -0.02841260648183782;
const float gnomon_theta6_inverse12 = 0.47582541301272185;
const float gnomon_theta6_inverse13 = 1.552587193469116;
const float gnomon_theta6_inverse31 = 0.10002244957859331;
const float gnomon_theta6_inverse32 = 0.84496560893955308;
const float gnomon_theta6_inverse33 = 1.0550119414818537;
const float gnomon_theta6_inverse51 = 0.25890700149881596;
const float gnomon_theta6_inverse52 = 0.90751156960796575;
const float gnomon_theta6_inverse53 = 0.83358142889321829;
const float gnomon_theta6_inverse_sixth = 0.16666666666666666;
const float gnomon_theta6_inverse23 = 0.8660254037844386;
const float gnomon_theta6_inverse63 = 0.81189881604791125;

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
channels6 theta6(moments6 b)
{
    channels6 c;
    c.c1 = 2.5 * b.b1 - 10.0 * b.b3 + 8.0 * b.b5 + 0.5;
    c.c2 = gnomon_theta6_21 * b.b1 + gnomon_theta6_23 * b.b3 + gnomon_theta6_25 * b.b5 + 0.5;
    c.c3 = gnomon_theta6_31 * b.b1 + gnomon_theta6_33 * b.b3 + gnomon_theta6_35 * b.b5 + 0.5;
    c.c4 = 4.0 * (b.b2 - b.b4);
    c.c5 = 9.0 * b.b2 - 24.0 * b.b4 + 16.0 * b.b6;
    c.c6 = gnomon_theta6_62 * b.b2 + gnomon_theta6_64 * b.b4 + gnomon_theta6_66 * b.b6 + gnomon_theta6_60;
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
moments6 theta6_inverse(channels6 c)
{
    float c1 = c.c1 - 0.5;
    float c2 = c.c2 - 0.5;
    float c3 = c.c3 - 0.5;
    float c5 = gnomon_theta6_inverse_sixth * c.c5;
    float c6 = c.c6 - gnomon_theta6_60;
    moments6 b;
    b.b1 = gnomon_theta6_inverse11 * c1 + gnomon_theta6_inverse12 * c2 + gnomon_theta6_inverse13 * c3;
    b.b3 = gnomon_theta6_inverse31 * c1 + gnomon_theta6_inverse32 * c2 + gnomon_theta6_inverse33 * c3;
    b.b5 = gnomon_theta6_inverse51 * c1 + gnomon_theta6_inverse52 * c2 + gnomon_theta6_inverse53 * c3;
    b.b2 = c5 + gnomon_theta6_inverse23 * c6;
    b.b4 = (c5 + gnomon_theta6_inverse23 * c6) - 0.25 * c.c4;
    b.b6 = (0.21875 * c.c5 + gnomon_theta6_inverse63 * c6) - 0.375 * c.c4;
    return b;
}

#endif

// moments/certified4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four stored moments, certified: never above Z(z < z_f), for any errors of storage within
// the stated noise.
//
// A quartic p with p <= 1 before z_f and p <= 0 from z_f on has E[p] <= Z(z < z_f) for every distribution Z. Storage
// moves channel k by at most noise_k, so E[p] is at least its value from the stored channels minus
// sum_k noise_k |p_k|, where p_k is the coefficient at channel k. That bound holds for every such p. A p with its nodes
// at those of the biased moments (hamburger4.h) is nearly the best (docs/decisions/2-bias.md).
//
// In y = z - z_f, and in the notation of hamburger4.h, the two nodes beside z_f are the roots of a y^2 + b y + w with
//     a = Q V,    b = u N + Q (2 V u - G),    w = V N + u^2 N + Q^2,    r^2 = b^2 - 4 a w.
// Of the nodes before z_f the nearer one is at y = -1 / c with c = (b + r) / (2 w). The certificate is
//     Q < 0, one node on either side:    p = -(1 + d + k y)^2 (2 (c - k) y + c (c - 2 k) y^2)
//     Q >= 0 and b > 0, both before:     p = 1 - (1 + c y)^2 (1 + g y)^2
//     otherwise, none before:            no p, and the bound is 0
// with d = b / (2 r) - 1/2, k = c d and g = (b - r) / (2 w). Both p are 1 at the nodes before z_f, and 0 at z_f and at
// the nodes behind. Any other c >= 0, d in [-1, 0] and g >= 0 give a valid p as well, so rounding in the nodes costs
// only some leaking.
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
struct gnomon_certificate4 { float top, s0, s1, s2, s3, s4; };

const float gnomon_certificate4_nothing = -1267650600228229401496703205376.0; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
gnomon_certificate4 gnomon_certificate4_about(float z_f, float n0, float t0, float t1, float n1, float n2)
{
    float nz = n2 * z_f;
    float ns = (n1 + n1) - nz;
    float k0 = n0 - ns * z_f;
    float k1 = ns - nz;
    float m = t0 - t1 * z_f;
    float m0 = m * m;
    float m1 = m * (t1 + t1);
    float m2 = t1 * t1;
    gnomon_certificate4 p;
    p.top = n0;
    p.s0 = m0 * k0;
    p.s1 = m0 * k1 + m1 * k0;
    p.s2 = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3 = m1 * n2 + m2 * k1;
    p.s4 = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
gnomon_certificate4 gnomon_certificate4_make(hankel4 h, float z_f)
{
    float u = z_f - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    float un = u * h.determinant;
    float w = h.variance * h.determinant + (u * un + q * q);
    float w2 = w + w;
    float a = q * h.variance;
    float b = un + q * (vu + slope);
    float square = b * b - (a + a) * w2;
    float inverse = 1.0 / w2;
    float ratio = b / (square + square);
    float r = gnomon_sqrt(gnomon_max(0.0, square));
    float c = (b + r) * inverse;
    float g = (b - r) * inverse;
    float d = ratio * r - 0.5;
    float k = c * d;
    bool between = q < 0.0;
    float n0 = gnomon_select(between, 0.0, 1.0);
    float n1 = gnomon_select(between, c - k, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    float t0 = gnomon_select(between, 1.0 + d, 1.0);
    float t1 = gnomon_select(between, k, c);
    gnomon_certificate4 p = gnomon_certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (0.0 < b), n0, gnomon_certificate4_nothing);
    return p;
}

/// The coefficients of p at the channels of theta4, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
channels4 gnomon_certificate4_theta(gnomon_certificate4 p)
{
    float third = 0.75 * p.s3;
    channels4 r;
    r.c1 = gnomon_theta4_inverse11 * p.s1 - third;
    r.c2 = 0.125 * (p.s2 - p.s4);
    r.c3 = gnomon_theta4_inverse13 * (p.s1 + third);
    r.c4 = p.s2 + p.s4;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
float gnomon_certificate4_theta_doubt(channels4 t, float noise)
{
    return noise * ((gnomon_abs(t.c1) + gnomon_abs(t.c2)) + (gnomon_abs(t.c3) + gnomon_abs(t.c4)));
}

/// The least possible value of E[p], given channels c of theta4 that are each off by at most noise.
float gnomon_certificate4_theta_mean(gnomon_certificate4 p, channels4 c, float noise)
{
    channels4 t = gnomon_certificate4_theta(p);
    float mean = (p.s0 + (t.c2 * c.c2 + t.c4 * c.c4)) + (t.c1 * (c.c1 - 0.5) + t.c3 * (c.c3 - 0.5));
    return p.top - (mean + gnomon_certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4 that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
float certified4_theta_lower(hankel4 h, channels4 c, float noise, float z_f)
{
    gnomon_certificate4 p = gnomon_certificate4_make(h, clamp_or_nan(z_f, -1.0, 1.0));
    return saturate_or_zero(gnomon_certificate4_theta_mean(p, c, noise));
}

const float gnomon_certified4_scale = 137438953472.0; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
struct certified4_mean
{
    gnomon_certificate4 p;
    float mean, added, known;
};

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
certified4_mean gnomon_certified4_constant_bias_mean(hankel4 h, float bias2, float bias4, float alpha, float z)
{
    float u = z - h.mean;
    float vu = h.variance * u;
    float slope = vu - h.third;
    float q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    float s = gnomon_certified4_scale * q;
    float n = gnomon_certified4_scale * h.determinant;
    float un = u * n;
    float e = u * un + q * s;
    float w = h.variance * n + e;
    float w2 = w + w;
    float a = s * h.variance;
    float a2 = a + a;
    float b = un + s * (vu + slope);
    float r = gnomon_sqrt(gnomon_max(0.0, b * b - a2 * w2));
    bool between = q < 0.0;
    bool positive = 0.0 < b;
    // Each quotient in the form that does not cancel.
    float outer = r + gnomon_abs(b);
    float c = gnomon_select(positive, outer, -2.0 * a) / gnomon_select(positive, w2, outer);
    float inverse = 1.0 / gnomon_select(between, r + r, outer);
    float g = a2 * inverse; // k if one node is on either side
    float n0 = gnomon_select(between, 0.0, 1.0);
    float n1 = gnomon_select(between, c - g, g);
    float n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    float t0 = gnomon_select(between, 0.5 + b * inverse, 1.0);
    float t1 = gnomon_select(between, g, c);
    certified4_mean m;
    m.p = gnomon_certificate4_about(z, n0, t0, t1, n1, n2);
    float share = gnomon_select(between, 0.5 * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, 1.0));
    m.added = alpha * ((m.p.top - m.p.s0) - (bias2 * m.p.s2 + bias4 * m.p.s4));
    m.known = gnomon_select((between || positive) && (gnomon_pivot_floor * h.variance < h.determinant), 1.0, 0.0);
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
float gnomon_certified4_constant_bias_intensity(certified4_mean m, float doubt)
{
    return gnomon_select(0.0 < m.known, saturate_or_zero(m.mean - (m.added + doubt)), 0.0);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
float certified4_constant_bias_lower(hankel4 h, moments4 noise, float bias2, float bias4, float alpha, float z_f)
{
    certified4_mean m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    float doubt = (noise.b1 * gnomon_abs(m.p.s1) + noise.b2 * gnomon_abs(m.p.s2)) +
                  (noise.b3 * gnomon_abs(m.p.s3) + noise.b4 * gnomon_abs(m.p.s4));
    return gnomon_certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4 with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
float certified4_theta_constant_bias_lower(hankel4 h, float noise, float bias2, float bias4, float alpha, float z_f)
{
    certified4_mean m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    return gnomon_certified4_constant_bias_intensity(m,
                                                     gnomon_certificate4_theta_doubt(gnomon_certificate4_theta(m.p),
                                                                                     noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
moments4 moments4_rounding(moments4 b, float delta)
{
    moments4 e;
    e.b1 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1));
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
moments4 moments4_rounding_filtered(moments4 b, float delta)
{
    moments4 e;
    e.b1 = delta;
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
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
const float gnomon_cubic_cosine0 = 0.50000938;
const float gnomon_cubic_cosine1 = 0.57684887;
const float gnomon_cubic_cosine2 = -0.10666892;
const float gnomon_cubic_cosine3 = 0.03862587;
const float gnomon_cubic_cosine4 = -0.00882245;
const float gnomon_cubic_minus_third = -0.33333333333333331;

/// The result of a Halley step as a fraction, whose denominator is positive.
struct gnomon_cubic_step { float numerator, denominator; };

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
gnomon_cubic_step gnomon_cubic_halley_step(float b, float c, float d, float t)
{
    float tb = t + b;
    float f = tb * (t * t) + (c * t + d);
    float s = (tb + (tb + t)) * t + c;
    float r = (t + t) + tb;
    float whole = s * s - f * r; // positive except at a multiple root
    bool simple = whole > 0.0;
    gnomon_cubic_step x;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, 1.0);
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
float gnomon_cubic_halley(float b, float c, float d, float t)
{
    gnomon_cubic_step x = gnomon_cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
float gnomon_cubic_start(float b, float c, float d)
{
    float mean = gnomon_cubic_minus_third * b;
    float mean2 = mean * mean;
    float spread2 = gnomon_max(mean2 + gnomon_cubic_minus_third * c, 0.0);
    float spread = gnomon_sqrt(spread2);
    float g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    float inverse = 1.0 / spread2;
    float cosine = (g * inverse) * (spread * inverse);
    float q2 = gnomon_min(gnomon_max(0.5 + 0.25 * cosine, 0.0), 1.0);
    float q = gnomon_sqrt(q2);
    float start = (gnomon_cubic_cosine0 + q * gnomon_cubic_cosine1) + q2 *
                  ((gnomon_cubic_cosine2 + q * gnomon_cubic_cosine3) + q2 * gnomon_cubic_cosine4);
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
gnomon_cubic_step gnomon_cubic_positive_root(float b, float c, float d)
{
    float t = gnomon_cubic_start(b, c, d);
    return gnomon_cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
float cubic_largest_root(float b, float c, float d)
{
    gnomon_cubic_step x = gnomon_cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
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
struct hankel6 { float mean, variance, shift2, shift3, ratio, whole, first, second; };

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
hankel6 gnomon_hankel6_make(float mean, float c11, float c12, float s22, float s23, float t)
{
    hankel6 h;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, c11);
    float inverse1 = 1.0 / h.variance;
    float s = gnomon_max(gnomon_pivot_floor * h.variance, s22);
    float inverse_s = 1.0 / s;
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
struct gnomon_covariances6 { gnomon_double_word c11, c12, c13, c22, c23, c33; };

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
gnomon_covariances6 gnomon_covariances6_from_moments(moments6 b)
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
gnomon_double_word gnomon_hankel6_minor(gnomon_double_word a, gnomon_double_word b, gnomon_double_word c,
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
hankel6 gnomon_hankel6_factor(float mean, gnomon_covariances6 c)
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
hankel6 hankel6_constant_bias(moments6 b, float bias2, float bias4, float bias6, float alpha)
{
    float keep = 1.0 - alpha;
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
hankel6 hankel6_from_moments(moments6 b)
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
struct gnomon_distribution4 { float depth0, depth1, depth2, depth3, weight0, weight1, weight2, weight3; };

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
struct gnomon_polynomials6 { float p1, p2, p3; };

/// P_1, P_2 and P_3 at the depth mean + u.
gnomon_polynomials6 gnomon_hamburger6_polynomials(hankel6 h, float u)
{
    gnomon_polynomials6 p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
float gnomon_hamburger6_kernel(hankel6 h, gnomon_polynomials6 p)
{
    return (h.whole + h.first * (p.p1 * p.p1)) + (h.second * (p.p2 * p.p2) + p.p3 * p.p3);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
struct gnomon_derivatives6 { float slope2, slope3, bend3; };

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
gnomon_derivatives6 gnomon_hamburger6_derivatives(hankel6 h, gnomon_polynomials6 p)
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
gnomon_polynomials6 gnomon_hamburger6_polynomials_shift(gnomon_polynomials6 p, gnomon_derivatives6 d, float distance_)
{
    p.p1 = p.p1 + distance_;
    p.p2 = p.p2 + distance_ * (d.slope2 + distance_);
    p.p3 = p.p3 + distance_ * (d.slope3 + distance_ * (d.bend3 + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
struct hamburger6_cubic { float b, c, d; };

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
hamburger6_cubic gnomon_hamburger6_other_nodes(hankel6 h, gnomon_polynomials6 p, gnomon_derivatives6 d, float inverse,
                                               float side)
{
    float q2 = h.second * p.p2;
    hamburger6_cubic r;
    r.b = inverse * (side * (h.first * p.p1 + (d.slope2 * q2 + d.slope3 * p.p3)));
    r.c = inverse * (q2 + d.bend3 * p.p3);
    r.d = inverse * (side * p.p3);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
float gnomon_hamburger6_distance(float t)
{
    float least = 0.0009765625;
    float away = gnomon_select(t < 0.0, gnomon_min(t, -least), gnomon_max(t, least));
    return 1.0 / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
struct hamburger6_sums { float lower, distance, weight; };

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
hamburger6_sums gnomon_hamburger6_sums_at(hankel6 h, float u)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, u);
    float inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    bool positive1 = p.p1 > 0.0;
    bool positive2 = p.p2 > 0.0;
    bool positive3 = p.p3 > 0.0;
    bool all_below = positive1 && positive2 && positive3;
    bool all_above = (!positive1) && positive2 && (!positive3);
    bool outside = all_below || all_above;
    hamburger6_sums r;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, 1.0 - r.weight, 0.0);
    r.distance = gnomon_select(all_below, p.p1, 0.0);
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        float side = gnomon_select(positive3, -1.0, 1.0);
        gnomon_derivatives6 d = gnomon_hamburger6_derivatives(h, p);
        hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, d, inverse, side);
        gnomon_cubic_step t = gnomon_cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        float away = t.denominator / gnomon_max(t.numerator, 0.0009765625 * t.denominator);
        float w = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (1.0 - r.weight) - w));
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
hamburger_bounds hamburger6_bounds(hankel6 h, float z_f)
{
    hamburger6_sums s = gnomon_hamburger6_sums_at(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    hamburger_bounds r;
    r.lower = saturate_or_zero(s.lower);
    r.weight = gnomon_min(saturate_or_zero(s.weight), 1.0 - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger6_bounds.
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
float hamburger6_lower(hankel6 h, float z_f) { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
gnomon_distribution4 hamburger6_distribution(hankel6 h, float z_f)
{
    gnomon_polynomials6 p = gnomon_hamburger6_polynomials(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    float inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    float side = gnomon_select(p.p3 > 0.0, -1.0, 1.0);
    hamburger6_cubic n = gnomon_hamburger6_other_nodes(h, p, gnomon_hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    float t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    bool large = (t1 * t1) * t1 > -n.d;
    float backward = -n.d / t1;
    float forward = n.b + t1;
    float b = 0.5 * gnomon_select(large, (backward - n.c) / t1, forward);
    float c = gnomon_select(large, backward, n.c + t1 * forward);
    gnomon_quadratic_result q = quadratic_roots(1.0, b, c);
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
    bool known = sum > 0.0; // false for NaN
    gnomon_distribution4 d;
    d.depth0 = gnomon_select(known, h.mean + p.p1, 1.0);
    d.depth1 = gnomon_select(known, h.mean + y1, 1.0);
    d.depth2 = gnomon_select(known, h.mean + y2, 1.0);
    d.depth3 = gnomon_select(known, h.mean + y3, 1.0);
    d.weight1 = gnomon_select(known, w1 / sum, 0.0);
    d.weight2 = gnomon_select(known, w2 / sum, 0.0);
    d.weight3 = gnomon_select(known, w3 / sum, 0.0);
    d.weight0 = saturate_or_zero(1.0 - (d.weight1 + (d.weight2 + d.weight3)));
    return d;
}

#endif

// moments/hausdorff4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four moments of depths that are known to lie in [-1, 1], as all depths of a map do: the sharp
// lower bound of the Hausdorff moment problem (Krein & Nudelman 1977), where hamburger4.h has that for any depths.
//
// The bound is that of hamburger4.h where both nodes of the canonical distribution beside z_f lie in [-1, 1]. Elsewhere
// the canonical distribution on [-1, 1] has the nodes -1, z_f, 1 and one more. About the mean, with s = -1 - mean,
// t = 1 - mean, u = z_f - mean and e_k = E[(y - s) (y - t) y^k], the fourth node is
//     x = (e2 - u e1) / (e1 - u e0)
// and its weights follow by interpolation, such as
//     w(s) = E[(y - u) (y - x) (y - t)] / ((s - u) (s - x) (s - t)),   w(x) = (e1 - u e0) / ((x - s) (x - u) (x - t))
// Each weight has an error of its own where nodes nearly meet. The weights before z_f, and 1 minus those from z_f on,
// are the same bound, and the smaller of both never darkens.
//
// The quadratic whose roots are the nodes beside z_f tells by its values at s and t which distribution it is. At most
// one node lies outside, since a root of P_2 is between the nodes.
//
// The bias must keep the moments those of depths in [-1, 1]. The vector of hamburger4.h is no guarantee: it has
// E[z^2] = E[z^4], all depths at -1, 0 and 1. The vector below is the farthest, in the maximum norm and after the
// sparse transform, from the boundary of the moments of depths in [-1, 1]: r = 0.1616, where that for any depths has
// 0.2165.
#ifndef GNOMON_MOMENTS_HAUSDORFF4_H
#define GNOMON_MOMENTS_HAUSDORFF4_H

const float bias4_theta_within_b2 = 0.59255;
const float bias4_theta_within_b4 = 0.48128;

/// Lower bound on the shadow intensity at z_f, in [0, 1], for depths in [-1, 1]. At least that of hamburger4_lower, but
/// for rounding.
/// Domain: z_f in [-1, 1], clamped; h of moments with a bias for depths in [-1, 1].
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the kernel in double (tests/soft/within.cpp),
///     error, float, hankel4_from_summed_within: p99 1e-4, p99.9 1e-1, max 8e-1
float hausdorff4_lower(hankel4 h, float z_f)
{
    float z = clamp_or_nan(z_f, -1.0, 1.0);
    float u = z - h.mean;
    float s = -1.0 - h.mean;
    float t = 1.0 - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    float w = h.variance * h.determinant;
    float at_s = w + (u * s * h.determinant + q * gnomon_hamburger4_q(h, s));
    float at_t = w + (u * t * h.determinant + q * gnomon_hamburger4_q(h, t));
    bool between = q < 0.0;
    bool outside = (between && (0.0 < at_s || 0.0 < at_t)) || (!between && (at_s < 0.0 || at_t < 0.0));
    // Times the variance, so that the fourth moment takes no division.
    float sum = s + t;
    float product = s * t;
    float e0 = h.variance * (h.variance + product);
    float e1 = h.variance * (h.third - sum * h.variance);
    float e2 = (h.determinant + h.third * h.third) + h.variance * ((h.variance + product) * h.variance - sum * h.third);
    float d = e1 - u * e0;
    float x = clamp_or_nan((e2 - u * e1) / d, s, t);
    float tx = t * x;
    float ux = u * x;
    float of_s = (h.third - ((u + x) + t) * h.variance) - u * tx;
    float of_u = (h.third - ((s + x) + t) * h.variance) - s * tx;
    float of_t = (h.third - ((s + u) + x) * h.variance) - s * ux;
    float at_low = saturate_or_zero(of_s / ((s - u) * ((s - x) * (s - t))));
    float at_node = saturate_or_zero(d / (h.variance * ((x - s) * ((x - u) * (x - t)))));
    float at_receiver = saturate_or_zero(of_u / ((u - s) * ((u - x) * (u - t))));
    float at_high = saturate_or_zero(of_t / ((t - s) * ((t - u) * (t - x))));
    float node = gnomon_select(x < u, at_node, 0.0);
    float rest = 1.0 - ((at_receiver + at_high) + gnomon_select(x < u, 0.0, at_node));
    float within = gnomon_min(at_low + node, rest);
    float lower = hamburger4_lower(h, z_f);
    return gnomon_select(outside && (-1.0 < z), saturate_or_zero(gnomon_max(lower, within)), lower);
}

#endif

// moments/two_point.h -------------------------------------------------------------------------------------------------
// A depth distribution of two depths from three moments (Peters et al. 2017, Alg. 2, Sec. 5.2 and App. B), which is the
// limit of Alg. 1 for a prescribed depth at infinity.
//
// Around the mean m = b1, with V = b2 - b1^2 and G = E[(z - m)^3] / V, the two depths are m + x1 and m + x2, where x1
// and x2 are the roots of x^2 - G x - V. The weights follow from w1 x1 + w2 x2 = 0. The roots have opposite signs, so
// that nothing cancels after V and G.
#ifndef GNOMON_MOMENTS_TWO_POINT_H
#define GNOMON_MOMENTS_TWO_POINT_H

/// Two depths, depth1 <= depth2, and their weights, which are in [0, 1] and sum to 1.
struct gnomon_distribution2 { float depth1, depth2, weight1, weight2; };

const float two_point_least_variance = 1.1920928955078125e-7; // 2^-23

/// The distribution of two depths with the moments b1, b2 and b3; a single depth b1 if the variance is at most
/// least_variance. That should be the largest variance by rounding of a single depth: two_point_least_variance for
/// moments stored as floats.
/// Domain: moments of depths in [-1, 1]. For moments of no such distribution depths may lie outside, but in [-8193,
/// 8193]: depths more than 2^13 apart are replaced by the single depth b1, clamped to [-1, 1].
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 2
gnomon_distribution2 two_point_distribution(float b1, float b2, float b3, float least_variance)
{
    gnomon_double_word v = subtract_product_ordered(b2, b1, b1);
    gnomon_double_word c = subtract_product(b3, b1, b2);
    float mean = clamp_or_nan(b1, -1.0, 1.0);
    float variance = v.high + v.low;
    bool single = !(variance > gnomon_max(least_variance, gnomon_pivot_floor));
    float g = clamp_or_nan((c.high + c.low) / variance - 2.0 * mean, -4096.0, 4096.0);
    float root = 0.5 * (gnomon_abs(g) + gnomon_sqrt(g * g + 4.0 * variance));
    float far_side = gnomon_select(g < 0.0, -root, root);
    float near_side = -variance / far_side;
    float x1 = gnomon_min(far_side, near_side);
    float x2 = gnomon_max(far_side, near_side);
    float any_nan = variance + (c.high + c.low);
    bool known = any_nan == any_nan;
    bool two = known && (!single) && (x2 - x1 > 0.0) && (x2 - x1 < 8192.0);
    float centre = gnomon_select(known, mean, 1.0);
    gnomon_distribution2 d;
    d.depth1 = gnomon_select(two, mean + x1, centre);
    d.depth2 = gnomon_select(two, mean + x2, centre);
    d.weight2 = gnomon_select(two, saturate_or_zero(-x1 / (x2 - x1)), 0.0);
    d.weight1 = 1.0 - d.weight2;
    return d;
}

const float two_point_unorm16_least_variance = 4.0e-5; // 5.26 times half a code
const float two_point_noise_0 = 0.866;
const float two_point_noise_2 = 3.4;

/// The moment b3 of two depths from three moments of theta4 (quantization.h), each of whose channels storage has
/// rounded by noise at
/// most: with the part of the third central moment that noise explains taken out, so that close depths keep their mean
/// and variance and get equal weights.
///
/// Rounding moves the third central moment k by e = noise (0.87 + 3.4 b1^2), a standard deviation of channels that are
/// uniformly off. A skew k / V^(3/2) of the order of 1 and noise make the best estimate V^3 / (V^3 + e^2) of k.
/// Domain: moments of depths in [-1, 1].
/// NaN: NaN.
float two_point_third_moment(float b1, float b2, float b3, float noise)
{
    float variance = gnomon_max(0.0, b2 - b1 * b1);
    float third = (b3 - b1 * b2) - 2.0 * b1 * variance;
    float e = noise * (two_point_noise_0 + two_point_noise_2 * (b1 * b1));
    float cubed = variance * (variance * variance);
    return b3 - third * (e * e / (cubed + e * e + gnomon_pivot_floor));
}

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

const float gnomon_texel_limit = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
float texel_below(float x)
{
    float limit = gnomon_texel_limit;
    float inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    float whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
float texel_weight(float u, float i, float look_ups)
{
    float share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

#endif

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { float x, y, t, z, d_x, d_y, d_z, id; };

const float gnomon_stochastic_nothing = -1.0;               // the id of the background
const float gnomon_stratum_begin = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const float gnomon_stratum_end = 0.999999523162841796875;   // 1 - 2^-21

/// A sample of the background.
stochastic_sample stochastic_background(float x, float y, float t)
{
    stochastic_sample s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = 1.0;
    s.d_x = 0.0;
    s.d_y = 0.0;
    s.d_z = 0.0;
    s.id = gnomon_stochastic_nothing;
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
float stratified_time(float stratum, float count, float jitter)
{
    float place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
float slice_of(float t, float count)
{
    float slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

#endif

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

const float gnomon_layer_depth_limit = 2.0;      // middle depths of surfaces lie in [-2, 2]
const float gnomon_layer_no_cut = 3.0;           // a cut behind all surfaces
const float gnomon_layer_background_depth = 4.0; // the middle depth of the background
const float gnomon_layer_unknown_depth = -4.0;   // the middle depth of a sample of NaN
const float gnomon_layer_last_bin = 63.0;
const float gnomon_layer_least_extent = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
float layer_middle_depth(stochastic_sample s)
{
    float z = s.z + (0.5 - s.t) * s.d_z;
    float limit = gnomon_layer_depth_limit;
    float inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    float size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    bool known = size <= gnomon_texel_limit;
    float middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
bool gnomon_layer_is_surface(float middle) { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { float least, greatest; };

/// The window of one sample, by its middle depth.
gnomon_layer_window layer_window_begin(float middle)
{
    bool surface = gnomon_layer_is_surface(middle);
    gnomon_layer_window w;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
gnomon_layer_window layer_window_add(gnomon_layer_window window, float middle)
{
    gnomon_layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
float layer_bin_of(float middle, gnomon_layer_window window)
{
    float share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    float bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    float least, greatest, bins, begun, empty;
    float length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
gnomon_layer_runs layer_cuts_begin(gnomon_layer_window window)
{
    gnomon_layer_runs r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0 = 0.0;
    r.length1 = 0.0;
    r.length2 = 0.0;
    r.centre0 = 0.0;
    r.centre1 = 0.0;
    r.centre2 = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
gnomon_layer_runs layer_cuts_add(gnomon_layer_runs state, float occupied)
{
    bool some = 0.0 < occupied;
    float centre = state.bins - 0.5 * state.empty;
    bool third = some && state.length2 < state.empty;
    bool second = some && state.length1 < state.empty;
    bool first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { float c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_cuts layer_cuts_end(gnomon_layer_runs state, float layers)
{
    float none = gnomon_layer_no_cut;
    float extent = state.greatest - state.least;
    bool surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    bool some = surfaces && gnomon_layer_least_extent <= extent;
    float per_bin = 0.015625 * extent;
    bool first = some && 0.0 < state.length0 && 1.0 < layers;
    bool second = some && 0.0 < state.length1 && 2.0 < layers;
    bool third = some && 0.0 < state.length2 && 3.0 < layers;
    float a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    float b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    float c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    float near_ab = gnomon_min(a, b);
    float far_ab = gnomon_max(a, b);
    float middle = gnomon_min(far_ab, c);
    gnomon_layer_cuts r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
float layer_of(float middle, gnomon_layer_cuts cuts)
{
    float known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    float first = gnomon_select(cuts.c0 <= middle, 1.0, 0.0);
    float second = gnomon_select(cuts.c1 <= middle, 1.0, 0.0);
    float third = gnomon_select(cuts.c2 <= middle, 1.0, 0.0);
    float behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct gnomon_layer_motion_sums
{
    float first_x, first_y, first_z, x, y, z, square, square_z, count;
    float least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct gnomon_layer_motion { float d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
gnomon_layer_motion_sums layer_motion_begin(stochastic_sample first)
{
    float limit = gnomon_texel_limit;
    gnomon_layer_motion_sums r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, 0.0);
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, 0.0);
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, 0.0);
    r.x = 0.0;
    r.y = 0.0;
    r.z = 0.0;
    r.square = 0.0;
    r.square_z = 0.0;
    r.count = 0.0;
    r.least = limit;
    r.greatest = -1.0 * limit;
    r.least_d = limit;
    r.greatest_d = -1.0 * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
bool gnomon_layer_motion_is_known(stochastic_sample s, float middle)
{
    float length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
gnomon_layer_motion_sums layer_motion_add(gnomon_layer_motion_sums state, stochastic_sample s, float middle)
{
    bool known = gnomon_layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.first_x, 0.0);
    float y = gnomon_select(known, s.d_y - state.first_y, 0.0);
    float z = gnomon_select(known, s.d_z - state.first_z, 0.0);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    float moved = s.z + (0.5 - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_motion layer_motion_end(gnomon_layer_motion_sums state)
{
    float share = 1.0 / gnomon_max(state.count, 1.0);
    float x = state.x * share;
    float y = state.y * share;
    float z = state.z * share;
    bool some = 0.0 < state.count;
    gnomon_layer_motion r;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0);
    r.spread = gnomon_sqrt(gnomon_max(0.0, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    float off = 0.5 * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    float axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

const float gnomon_layer_least_motion = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
const float gnomon_layer_least_depths = 0.0009765625;           // 2^-10: no layer is stretched as if it were thinner

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
layer_grid layer_grid_make(gnomon_layer_motion mean, float guard, float texels)
{
    float chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    bool moves = gnomon_layer_least_motion <= chord;
    layer_grid g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, 1.0);
    g.axis_y = gnomon_select(moves, mean.d_y / chord, 0.0);
    g.motion = gnomon_select(moves, chord, 0.0);
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = 0.5 * texels;
    g.centre = 0.5 * (mean.least + mean.greatest);
    g.scale = 2.0 / gnomon_max(gnomon_layer_least_depths, mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
struct gnomon_layer_place { float u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
gnomon_layer_place gnomon_layer_grid_turned(layer_grid grid, float x, float y)
{
    gnomon_layer_place r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
gnomon_layer_place layer_grid_place(layer_grid grid, float x, float y, float t)
{
    gnomon_layer_place turned = gnomon_layer_grid_turned(grid, x, y);
    gnomon_layer_place r;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5 - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
float layer_place_is_inside(layer_grid grid, gnomon_layer_place place)
{
    float texels = 2.0 * grid.middle;
    bool begun = 0.0 <= place.u && 0.0 <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0, 0.0);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
float layer_grid_depth(layer_grid grid, float z, float t) { return z + (0.5 - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
float layer_grid_own_depth(layer_grid grid, float z, float t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

#endif

// motion/layers/layer_look_up.h ---------------------------------------------------------------------------------------
// Look-up in a layer's grid: the footprint of a receiver with its probes and mip level, the bias and the least variance
// that a layer needs, the filter across the motion, and blends with the neighbouring tile (Andersson et al. 2015, Sec.
// 4.2 and 5).
//
// A camera sample stands for the time t_r -+ 1/(2N), while which its world point is held in camera space. The light
// sees that point move: the ends of the footprint are its places at both times, each by the grid at its own time, so
// that what moves with the layer has a footprint of no length. The second axis is the pixel's own footprint. Probes are
// spread evenly along the longer axis, at most 16, and the mip level is that of the shorter.
//
//     ends = layer_footprint_make(grid, x0, y0, t0, x1, y1, t1, cross_x, cross_y, widening);
//     for k from 0 to ends.probes - 1: the mean of sums at layer_probe(ends, k) in level ends.level
//     bias = layer_bias(grid, slope_along, slope_across, t, reach, limit);
//     visibility by layer_visibility(sums, layer_grid_own_depth(grid, z - bias, t), layer_minimum_variance(grid, slope,
// least))
//
// Places (x, y) are in texels of the map from the tile's centre.
#ifndef GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H
#define GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H

const float gnomon_layer_most_probes = 16.0;
const float gnomon_layer_uniform_variance = 0.083333333333333333; // 1/12, of a time between 0 and 1
const float gnomon_layer_tent_growth = 0.025;                     // half of 0.05 texels per texel of motion
const float gnomon_layer_tent_begin = 2.0;                        // texels of motion from which on the tent grows

/// Centre of a footprint, the vector from its one end to the other, the number of probes along that, and the mip level.
struct gnomon_layer_footprint { float u, v, along_u, along_v, probes, level; };

/// The footprint of a world point that the light sees at (x0, y0) at time t0 and at (x1, y1) at time t1. (cross_x,
/// cross_y) is the second axis, the extent of a pixel on the map. Both ends are limited to the grid. The footprint is
/// at least `widening` texels of the map wide in either direction.
/// NaN: stays NaN in the place, with one probe; a NaN in the widths counts for nothing.
/// Source: Andersson 2015, Sec. 4.2
gnomon_layer_footprint layer_footprint_make(layer_grid grid, float x0, float y0, float t0, float x1, float y1, float t1,
                                            float cross_x, float cross_y, float widening)
{
    float last = grid.middle + grid.middle - 0.5; // the centre of the last texel
    gnomon_layer_place p0 = layer_grid_place(grid, x0, y0, t0);
    gnomon_layer_place p1 = layer_grid_place(grid, x1, y1, t1);
    p0.u = clamp_or_nan(p0.u, 0.5, last);
    p0.v = clamp_or_nan(p0.v, 0.5, last);
    p1.u = clamp_or_nan(p1.u, 0.5, last);
    p1.v = clamp_or_nan(p1.v, 0.5, last);
    float time_u = p1.u - p0.u;
    float time_v = p1.v - p0.v;
    gnomon_layer_place second = gnomon_layer_grid_turned(grid, cross_x, cross_y);
    float cross_u = grid.scale_u * second.u;
    float cross_v = grid.scale_v * second.v;
    float time_length = gnomon_sqrt(time_u * time_u + time_v * time_v);
    float cross_length = gnomon_sqrt(cross_u * cross_u + cross_v * cross_v);

    // The longer axis around the middle of the ends, limited to the grid.
    bool over_time = cross_length <= time_length;
    float half_u = 0.5 * gnomon_select(over_time, time_u, cross_u);
    float half_v = 0.5 * gnomon_select(over_time, time_v, cross_v);
    float u = 0.5 * (p0.u + p1.u);
    float v = 0.5 * (p0.v + p1.v);
    float u0 = clamp_or_nan(u - half_u, 0.5, last);
    float v0 = clamp_or_nan(v - half_v, 0.5, last);
    float u1 = clamp_or_nan(u + half_u, 0.5, last);
    float v1 = clamp_or_nan(v + half_v, 0.5, last);
    gnomon_layer_footprint r;
    r.u = 0.5 * (u0 + u1);
    r.v = 0.5 * (v0 + v1);
    r.along_u = u1 - u0;
    r.along_v = v1 - v0;
    float longer = gnomon_sqrt(r.along_u * r.along_u + r.along_v * r.along_v);
    float shorter = gnomon_max(gnomon_min(cross_length, time_length), widening * grid.scale_v);
    float width = gnomon_max(gnomon_max(0.0625 * longer, shorter), 1.0); // a NaN becomes 1
    width = gnomon_min(width, grid.middle + grid.middle);
    float probes = -1.0 * texel_below(-1.0 * (longer / width)); // rounded up
    r.probes = gnomon_max(gnomon_min(probes, gnomon_layer_most_probes), 1.0);
    r.level = 0.0;
    bool coarse = 1.0 < width;
    if (gnomon_any(coarse)) {
        r.level = gnomon_select(coarse, polynomial_log(width) * gnomon_exp_log2_e, 0.0);
    }
    return r;
}

/// The place of probe k, 0 to probes - 1.
gnomon_layer_place layer_probe(gnomon_layer_footprint footprint, float k)
{
    float share = (k + 0.5) / footprint.probes - 0.5;
    gnomon_layer_place r;
    r.u = footprint.u + share * footprint.along_u;
    r.v = footprint.v + share * footprint.along_v;
    return r;
}

/// The texels of the map by which a layer's places are off at time t, since its samples move unlike: the spread of
/// motion times |1/2 - t|.
/// NaN: NaN.
float layer_widening(layer_grid grid, float t) { return grid.spread * gnomon_abs(0.5 - t); }

/// The bias in [0, 2] to subtract from a receiver's depth at time t. slope_along and slope_across are the changes of
/// depth per texel of the map along the motion and across (layer_slope), or a bound on both. reach is the distance in
/// texels of the grid from a receiver to the farthest centre of a texel that its filter reads. What of the motion is
/// not the layer's adds to this: spread_z |1/2 - t| in depth, and spread |1/2 - t| texels along the slope. limit is the
/// largest bias of a slope.
/// Domain: any; reach, limit at least 0.
/// NaN: what is NaN counts for nothing.
/// Error: 8 2^-p of the result.
float layer_bias(layer_grid grid, float slope_along, float slope_across, float t, float reach, float limit)
{
    float off = layer_widening(grid, t);
    depth_gradient gradient;
    gradient.x = slope_along;
    gradient.y = slope_across;
    float rise = depth_bias_receiver_plane(gradient, reach / grid.scale_u + off, reach / grid.scale_v + off, limit);
    return gnomon_depth_bias_limit(rise + gnomon_depth_bias_limit(grid.spread_z * gnomon_abs(0.5 - t)));
}

/// Slopes of depth along the motion of a layer and across, from its gradient along x and y of the map.
/// Error: 2 2^-p (|x| + |y|).
depth_gradient layer_slope(layer_grid grid, depth_gradient gradient)
{
    gnomon_layer_place turned = gnomon_layer_grid_turned(grid, gradient.x, gradient.y);
    depth_gradient r;
    r.x = turned.u;
    r.y = turned.v;
    return r;
}

/// The least variance of the layer's own depth, for layer_visibility: `least` of depth itself, and what the spread of
/// motion adds over the shutter interval, (spread_z^2 + (slope spread)^2) / 12. slope is the change of depth per texel
/// of the map.
/// Domain: least at least 0.
/// NaN: stays NaN.
float layer_minimum_variance(layer_grid grid, float slope, float least)
{
    float tilted = slope * grid.spread;
    float moved = gnomon_layer_uniform_variance * (grid.spread_z * grid.spread_z + tilted * tilted);
    return (least + moved) * (grid.scale * grid.scale);
}

/// Half the width of the filter across a layer's motion, in texels of its grid: of a tent of full width 0.05 (|d| - 2)
/// texels of the map, at least 0, but not wider than the guard band of (guard - tile) / 2 texels on either side.
/// NaN: 0.
/// Source: Andersson 2015, Sec. 5
float layer_tent_radius(layer_grid grid, float guard, float tile)
{
    float radius = gnomon_layer_tent_growth * (grid.motion - gnomon_layer_tent_begin);
    float band = 0.5 * (guard - tile);
    return gnomon_max(gnomon_min(radius, band) * grid.scale_v, 0.0);
}

/// The weight of a row of texels at a distance in texels under a tent of this radius, not normalised: 1 at distance 0.
/// Domain: any distance; radius at least 0. For a radius up to 1 all other rows have weight 0.
/// NaN: 0.
float layer_tent_weight(float distance, float radius)
{
    return saturate_or_zero(1.0 - gnomon_abs(distance) / gnomon_max(1.0, radius));
}

/// The neighbour of a tile along one axis, -1 or 1, and its weight, from 0 to 1/2.
struct gnomon_layer_neighbour { float towards, weight; };

/// The neighbour on the side of x, in texels of the map from the tile's centre. Its weight is 0 up to a third of the
/// way to the border, 1/2 at the border, and linear between. With weights w_x and w_y of both axes the four tiles have
/// (1 - w_x) (1 - w_y), w_x (1 - w_y), (1 - w_x) w_y and w_x w_y: a look-up in all of them by these weights has no
/// border; one chosen at random with these probabilities is the paper's.
/// Domain: tile > 0.
/// NaN: weight 0.
/// Source: Andersson 2015, Sec. 5
gnomon_layer_neighbour layer_neighbour_at(float x, float tile)
{
    gnomon_layer_neighbour r;
    r.towards = gnomon_select(x < 0.0, -1.0, 1.0);
    r.weight = 0.5 * saturate_or_zero(3.0 * (gnomon_abs(x) / tile) - 0.5);
    return r;
}

#endif

// motion/layers/layer_sums.h ------------------------------------------------------------------------------------------
// Sums that a texel of a layer's grid holds, and the visibility of a receiver through the layer (Andersson et al. 2015,
// Sec. 4.1 and 4.2). A sample in the layer or behind it has weight w = 1, one in front of the layer has none. A sample
// in the layer has opacity a = 1: where one sees past the layer, it is transparent. Per texel
//
//     variance       sums of w a z, w a z^2, w a, w                                layer_sums, Eq. 7
//     four moments   sums of w a z, ..., w a z^4, w a, w                           gnomon_layer_moments4_sums
//     exponential    sums of w a exp(c z), w a, w                                  gnomon_layer_exponential_sums
//
// where z is the layer's own depth, in [-1, 1] (layer_grid_own_depth). Filters and mip levels are linear in the sums.
// With the mean depths of what is opaque, Eq. 8, and the opacity a = sum w a / sum w, a layer lets through
//
//     V = 1 - a intensity                                                          Eq. 10
//
// and a receiver sees the product over all layers. A layer whose samples are all before the receiver has intensity 1,
// one whose samples are all behind has 0, with every bound. A sum of weights of 0 is no information: filters grow until
// there is some, and without any the layer counts as transparent.
//
//     share = layer_share_of(layer_of(layer_middle_depth(s), cuts), layer);
//     sums = layer_sums_add(sums, layer_grid_own_depth(grid, s.z, s.t), share);    into the texel at
// layer_grid_place(...)
//
//     visibility = 1, then visibility * layer_visibility(sums, layer_grid_own_depth(grid, z_r - bias, t_r), minimum)
//                                                                                  for all layers with their filtered
// sums
#ifndef GNOMON_MOTION_LAYERS_LAYER_SUMS_H
#define GNOMON_MOTION_LAYERS_LAYER_SUMS_H

/// Opacity and weight of a sample for a layer, each 0 or 1.
struct gnomon_layer_share { float opacity, weight; };

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
gnomon_layer_share layer_share_of(float at, float layer)
{
    gnomon_layer_share r;
    r.opacity = gnomon_select(at == layer, 1.0, 0.0);
    r.weight = gnomon_select(layer <= at, 1.0, 0.0);
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
struct layer_sums { float z, zz, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
layer_sums layer_sums_add(layer_sums sums, float z, gnomon_layer_share share)
{
    float a = share.weight * share.opacity;
    float x = clamp_or_high(z, -1.0, 1.0);
    sums.z = sums.z + a * x;
    sums.zz = sums.zz + a * (x * x);
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility 1 - a intensity through a layer, where a = opacity / weight is its opacity and intensity is a bound
/// on the share of its samples before a receiver at the layer's own depth z: 1 behind all of them, 0 in front of all of
/// them.
/// NaN: 1.
/// Source: Andersson 2015, Eq. 10
float gnomon_layer_transmission(float opacity, float weight, float intensity, float z)
{
    float bound = gnomon_select(1.0 < z, 1.0, gnomon_select(-1.0 < z, intensity, 0.0));
    float known = gnomon_select(0.0 < weight, saturate_or_zero(opacity / weight), 0.0);
    return 1.0 - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight
/// of 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
float layer_visibility(layer_sums sums, float z, float minimum_variance)
{
    variance_moments b;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
struct gnomon_layer_moments4_sums { float b1, b2, b3, b4, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
gnomon_layer_moments4_sums layer_moments4_add(gnomon_layer_moments4_sums sums, float z, gnomon_layer_share share)
{
    float a = share.weight * share.opacity;
    moments4 b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    sums.b1 = sums.b1 + a * b.b1;
    sums.b2 = sums.b2 + a * b.b2;
    sums.b3 = sums.b3 + a * b.b3;
    sums.b4 = sums.b4 + a * b.b4;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

const float gnomon_layer_moments4_noise = 3.3e-8; // 1.1 times 2^-25, one rounding to float
const float gnomon_layer_moments4_weight = 3e-7;  // the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one
/// more, and those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and
/// so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
float layer_moments4_visibility(gnomon_layer_moments4_sums sums, float z, float roundings)
{
    float share = 1.0 / sums.opacity;
    moments4 b;
    b.b1 = sums.b1 * share;
    b.b2 = sums.b2 * share;
    b.b3 = sums.b3 * share;
    b.b4 = sums.b4 * share;
    float n = gnomon_max(1.0, roundings) * (sums.weight * share);
    float alpha = bias_weight_of_roundings(gnomon_layer_moments4_weight, n);
    moments4 noise;
    noise.b1 = n * gnomon_layer_moments4_noise;
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    hankel4 h = hankel4_constant_bias(b, bias4_raw_b2, bias4_raw_b4, alpha);
    float intensity = certified4_constant_bias_lower(h, noise, bias4_raw_b2, bias4_raw_b4, alpha, z);
    return gnomon_layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
struct gnomon_layer_exponential_sums { float warped, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
gnomon_layer_exponential_sums layer_exponential_add(gnomon_layer_exponential_sums sums, float z,
                                                    gnomon_layer_share share, exponential_settings settings)
{
    float a = share.weight * share.opacity;
    sums.warped = sums.warped + a * exponential_encode(z, settings).warped;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Markov's bound. A weight of
/// 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; settings as for exponential_intensity.
/// NaN: 1.
/// Error: (c + n + 7) 2^-p, c the exponent, for sums over n samples.
/// Source: Andersson 2015, Eq. 10; Annen 2008
float layer_exponential_visibility(gnomon_layer_exponential_sums sums, float z, exponential_settings settings)
{
    exponential_moment b;
    b.warped = sums.warped / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
}

#endif

// motion/layers/layer_parts.h -----------------------------------------------------------------------------------------
// Parts of one layer that move unlike: samples of one range of depths, divided by their motion (the future work of
// Andersson et al. 2015, Sec. 7). Leaves and the branch between them have like depths, but unlike motions.
//
// The motions of a layer's samples vary most along one direction. Their places on it, in standard deviations, are
// clustered as depths are (layer_clusters.h): equal bins, and a cut at the longest interior run of empty ones. Either
// part has sums on a grid of its own motion. Both overlap in depth, so that either may hide the other: a sample of one
// part tells of the other only if it is behind the middle of that one's depths. A receiver sees the product of the
// visibilities through both, as through two layers.
//
//     state = layer_direction_begin(motion);                                       the layer's motion
// (layer_motion_end)
//     state = layer_direction_add(state, s, layer_middle_depth(s));                for all samples of the layer
//     direction = layer_direction_end(state);
//     window, bins and cuts of keys = layer_direction_key(direction, s) in place of depths, for two layers
//     part = layer_of(key, cuts)                                                   0 or 1
//     share = layer_share_of_part(at, layer, part, wanted, layer_middle_depth(s), centre)
//     sums = layer_sums_add(sums, z, share)                                        for the part `wanted`
#ifndef GNOMON_MOTION_LAYERS_LAYER_PARTS_H
#define GNOMON_MOTION_LAYERS_LAYER_PARTS_H

/// A fold over the samples of a layer: its mean motion, sums of squares and products of differences from that, and
/// their number.
struct gnomon_layer_direction_sums { float d_x, d_y, xx, xy, yy, count; };

/// The mean motion of a layer, the direction in which its samples' motions differ most, and the inverse of four
/// standard deviations in that direction; 0 if they do not differ.
struct gnomon_layer_direction { float d_x, d_y, axis_x, axis_y, scale; };

// 2^-20 square texels: motions that differ less do not
const float gnomon_layer_least_difference = 0.00000095367431640625;

/// The state before the first sample.
gnomon_layer_direction_sums layer_direction_begin(gnomon_layer_motion motion)
{
    gnomon_layer_direction_sums r;
    r.d_x = motion.d_x;
    r.d_y = motion.d_y;
    r.xx = 0.0;
    r.xy = 0.0;
    r.yy = 0.0;
    r.count = 0.0;
    return r;
}

/// The state after one more sample and its middle depth.
/// Domain: as for layer_motion_add.
/// NaN: no information, the state as before.
gnomon_layer_direction_sums layer_direction_add(gnomon_layer_direction_sums state, stochastic_sample s, float middle)
{
    bool known = gnomon_layer_motion_is_known(s, middle);
    float x = gnomon_select(known, s.d_x - state.d_x, 0.0);
    float y = gnomon_select(known, s.d_y - state.d_y, 0.0);
    state.xx = state.xx + x * x;
    state.xy = state.xy + x * y;
    state.yy = state.yy + y * y;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    return state;
}

/// The direction in which motions differ most: that of the larger eigenvalue of their covariance, along x if both are
/// equal.
/// Domain: differences from 2^-10 texels on; of smaller ones the direction is along x, and scale is 0.
/// Error: with n samples, of the axis (n + 16) 2^-p times the larger eigenvalue over the difference of both; of scale,
/// relative, (n + 16) 2^-p.
gnomon_layer_direction layer_direction_end(gnomon_layer_direction_sums state)
{
    float half_difference = 0.5 * (state.xx - state.yy);
    float radius = gnomon_sqrt(half_difference * half_difference + state.xy * state.xy);
    float larger = 0.5 * (state.xx + state.yy) + radius;
    // (xy, larger - xx) and (larger - yy, xy) are both along the axis: the one without cancellation.
    bool steep = half_difference < 0.0;
    float long_part = radius + gnomon_abs(half_difference);
    float x = gnomon_select(steep, state.xy, long_part);
    float y = gnomon_select(steep, long_part, state.xy);
    float norm = gnomon_sqrt(x * x + y * y);
    bool apart = 0.0 < norm;
    float square = larger / gnomon_max(state.count, 1.0);
    bool differ = gnomon_layer_least_difference <= square;
    gnomon_layer_direction r;
    r.d_x = state.d_x;
    r.d_y = state.d_y;
    r.axis_x = gnomon_select(apart && differ, x / norm, 1.0);
    r.axis_y = gnomon_select(apart && differ, y / norm, 0.0);
    r.scale = gnomon_select(differ, 0.25 / gnomon_sqrt(square), 0.0);
    return r;
}

/// The place of a sample's motion on the direction, from the layer's mean: 1 at four standard deviations, limited to
/// [-2, 2].
/// NaN: gnomon_layer_unknown_depth.
float layer_direction_key(gnomon_layer_direction direction, stochastic_sample s)
{
    float x = (s.d_x - direction.d_x) * direction.axis_x;
    float y = (s.d_y - direction.d_y) * direction.axis_y;
    float key = (x + y) * direction.scale;
    float limit = gnomon_layer_depth_limit;
    float inside = gnomon_max(gnomon_min(key, limit), -1.0 * limit);
    return gnomon_select(gnomon_abs(key) <= gnomon_texel_limit, inside, gnomon_layer_unknown_depth);
}

/// The key that divides a layer into two parts: the centre of the longest run of empty bins (layer_cuts_add) if that is
/// at least `bins` bins long, else gnomon_layer_no_cut. A few samples leave short runs anywhere.
/// NaN: a `bins` of NaN divides nothing.
float layer_part_cut(gnomon_layer_runs state, float bins)
{
    return gnomon_select(bins <= state.length0, layer_cuts_end(state, 2.0).c0, gnomon_layer_no_cut);
}

/// Opacity and weight, for part number `wanted` of layer number `layer`, of a sample that is in part `part` of layer
/// `at` at the middle depth `middle`. A sample of the other part has no opacity. It has weight if it is behind
/// `centre`, the middle of the wanted part's depths: where it is seen, one sees past that part.
/// NaN: no weight for an `at` of NaN, nor in the layer for a `part`, `middle` or `centre` of NaN. A part below 0 is a
/// NaN.
gnomon_layer_share layer_share_of_part(float at, float layer, float part, float wanted, float middle, float centre)
{
    gnomon_layer_share r = layer_share_of(at, layer);
    bool other = at == layer && !(part == wanted);
    bool past = centre < middle && 0.0 <= part;
    r.opacity = gnomon_select(other, 0.0, r.opacity);
    r.weight = gnomon_select(other && !past, 0.0, r.weight);
    return r;
}

#endif

// motion/receiver/receiver_path.h -------------------------------------------------------------------------------------
// The path of a receiver through the light's clip space while a pixel sees it, and its shadow by samples in time
// (Palmer 2011, 2.3.2 and 4.1).
//
// The receiver's point and the light move along straight lines, and the light does not turn, so x, y and w are linear
// in time. The point on the map, (x / w, y / w), moves along a straight line, too; w is 1 for an orthographic light.
// Depth is linear in view distance, hence linear in time: depth and time are those of a range.
//
//     n = receiver_sample_count(path, most);
//     state = sampled_receiver_begin(n);
//     for k from 0 to n - 1: t = receiver_sample_time(path, k, n, jitter); in the texel at receiver_path_at(path, t),
//     the largest range_intensity(range, t, range_depth(path.depth, t), path.depth.id, bias) of all ranges, then
//         state = sampled_receiver_add(state, largest);     or the mean of several texels by their weights
//     intensity = sampled_receiver_end(state);
#ifndef GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#define GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
struct receiver_path
{
    depth_time_range depth;
    float x0, y0, w0, x1, y1, w1;
};

/// A position in texels, texel centres at +0.5.
struct gnomon_texel_position { float x, y; };

const float gnomon_receiver_sample_limit = 1048576.0; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
gnomon_texel_position receiver_path_at(receiver_path path, float t)
{
    float passed = range_elapsed(path.depth, t);
    float left = 1.0 - passed;
    float w = path.w0 * left + path.w1 * passed;
    gnomon_texel_position r;
    r.x = (path.x0 * left + path.x1 * passed) / w;
    r.y = (path.y0 * left + path.y1 * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
receiver_path receiver_path_shift(receiver_path path, float dx, float dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
receiver_path receiver_path_clip(receiver_path path, float begin, float end)
{
    float passed0 = range_elapsed(path.depth, begin);
    float passed1 = range_elapsed(path.depth, end);
    float left0 = 1.0 - passed0;
    float left1 = 1.0 - passed1;
    receiver_path c;
    c.depth = range_clip(path.depth, begin, end);
    c.x0 = path.x0 * left0 + path.x1 * passed0;
    c.y0 = path.y0 * left0 + path.y1 * passed0;
    c.w0 = path.w0 * left0 + path.w1 * passed0;
    c.x1 = path.x0 * left1 + path.x1 * passed1;
    c.y1 = path.y0 * left1 + path.y1 * passed1;
    c.w1 = path.w0 * left1 + path.w1 * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
float receiver_path_length(receiver_path path)
{
    float dx = path.x1 / path.w1 - path.x0 / path.w0;
    float dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
float receiver_sample_count(receiver_path path, float most)
{
    float wanted = gnomon_max(2.0 * receiver_path_length(path), 5.0); // a NaN becomes 5
    float limit = gnomon_min(gnomon_max(most, 5.0), gnomon_receiver_sample_limit);
    float count = gnomon_min(wanted, limit);
    float whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, 1.0, 0.0);
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
float receiver_sample_time(receiver_path path, float k, float n, float jitter)
{
    float passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (1.0 - passed) + path.depth.t1 * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
struct gnomon_sampled_receiver { float samples, shadowed; };

/// Begin with the number of samples to come.
gnomon_sampled_receiver sampled_receiver_begin(float samples)
{
    gnomon_sampled_receiver r;
    r.samples = samples;
    r.shadowed = 0.0;
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
gnomon_sampled_receiver sampled_receiver_add(gnomon_sampled_receiver state, float intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
float sampled_receiver_end(gnomon_sampled_receiver state) { return saturate_or_zero(state.shadowed / state.samples); }

#endif

// motion/receiver/shutter.h -------------------------------------------------------------------------------------------
// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that
// turns, a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// gnomon_shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { float w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
struct shutter_exposure { float begin, end; };

const float gnomon_shutter_weight_limit = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
shutter_exposure gnomon_shutter_exposure_make(float a, float b)
{
    float least = 0.00000095367431640625;
    bool swapped = b < a;
    float open = gnomon_select(swapped, b, a);
    float close = gnomon_select(swapped, a, b);
    bool brief = close - open < least;
    float early = gnomon_select(open <= 1.0, gnomon_min(open, 1.0 - least), open);
    shutter_exposure r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
float shutter_time(float begin, float end, float share) { return begin * (1.0 - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
float shutter_box(float t, float begin, float end) { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
float shutter_tent(float t, float begin, float end)
{
    float x = shutter_box(t, begin, end);
    float left = 1.0 - x;
    return gnomon_select(x < 0.5, 2.0 * (x * x), 1.0 - 2.0 * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
float gnomon_shutter_weight(float w) { return gnomon_select(0.0 < w, gnomon_min(w, gnomon_shutter_weight_limit), 0.0); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
float gnomon_shutter_share(float weight, float sum)
{
    return gnomon_select(0.0 < sum, saturate_or_zero(weight / sum), 0.125);
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
float shutter_line(float t, float begin, float end, float w0, float w1)
{
    float a = gnomon_shutter_weight(w0);
    float b = gnomon_shutter_weight(w1);
    float sum = a + b;
    float x = shutter_box(t, begin, end);
    float early = gnomon_select(0.0 < sum, saturate_or_zero(a / sum), 0.5);
    return saturate_or_zero(x * (early + (early * (1.0 - x) + (1.0 - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
shutter_weights shutter_weights_make(shutter_weights weights)
{
    shutter_weights w;
    w.w0 = gnomon_shutter_weight(weights.w0);
    w.w1 = gnomon_shutter_weight(weights.w1);
    w.w2 = gnomon_shutter_weight(weights.w2);
    w.w3 = gnomon_shutter_weight(weights.w3);
    w.w4 = gnomon_shutter_weight(weights.w4);
    w.w5 = gnomon_shutter_weight(weights.w5);
    w.w6 = gnomon_shutter_weight(weights.w6);
    w.w7 = gnomon_shutter_weight(weights.w7);
    float sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = gnomon_shutter_share(w.w0, sum);
    w.w1 = gnomon_shutter_share(w.w1, sum);
    w.w2 = gnomon_shutter_share(w.w2, sum);
    w.w3 = gnomon_shutter_share(w.w3, sum);
    w.w4 = gnomon_shutter_share(w.w4, sum);
    w.w5 = gnomon_shutter_share(w.w5, sum);
    w.w6 = gnomon_shutter_share(w.w6, sum);
    w.w7 = gnomon_shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
float shutter_piecewise(float t, float begin, float end, shutter_weights w)
{
    float x = 8.0 * shutter_box(t, begin, end);
    float early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - 1.0)) +
                  (w.w2 * saturate_or_zero(x - 2.0) + w.w3 * saturate_or_zero(x - 3.0));
    float late = (w.w4 * saturate_or_zero(x - 4.0) + w.w5 * saturate_or_zero(x - 5.0)) +
                 (w.w6 * saturate_or_zero(x - 6.0) + w.w7 * saturate_or_zero(x - 7.0));
    return gnomon_select(x < 8.0, saturate_or_zero(early + late), 1.0);
}

#endif

// motion/layers/receiver_footprint.h ----------------------------------------------------------------------------------
// The time that one sample of a stochastic camera stands for. The camera takes N samples for each pixel, one in each
// stratum of the shutter interval. A look-up at the sample's own time is as noisy as the camera; the mean over the time
// that the sample stands for is not.
//
// During that time the point has to follow its surface (receiver_path.h). Held in place it would leave the surface,
// which then shadows it. With the path of the point and ranges, the mean is known in closed form:
//     exposure = footprint_stratum(t, N);
//     path = receiver_path_clip(path, exposure.begin, exposure.end);
//     moving_receiver_begin(path, exposure.begin, exposure.end), and so on (moving_receiver.h)
// The strata of a pixel's samples fill the shutter interval, so a point that its pixel sees all the time gets the mean
// over the whole interval, without noise and without bias.
#ifndef GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H
#define GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
shutter_exposure footprint_stratum(float t, float count)
{
    float slice = slice_of(t, count);
    shutter_exposure r;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + 1.0) / count);
    return r;
}

#endif

// motion/range/deep_shadow.h ------------------------------------------------------------------------------------------
// Deep shadow maps (Lokovic & Veach 2000): transmittance over depth for each texel, from 1 in front of all occluders to
// that behind them. What moves covers a texel for a part of the time, so motion counts as translucency: time is
// collapsed, which is right for static receivers under a static light and for no others.
//
// A deep layer takes away a share of the light, its opacity, evenly from depth z0 to depth z1, or at once if both are
// equal. Layers multiply, in any order:
//     transmittance = 1;   for every layer of the texel: transmittance = deep_shadow_add(transmittance, layer, z_f)
//     intensity = deep_shadow_end(transmittance);
//
// The layers of a texel come from its transmittance as a polyline over depth, which is compressed to a tolerance by a
// greedy window of slopes: one line goes on for as long as it passes all vertices within the tolerance.
//     window = deep_window_begin(tolerance);
//     for each vertex from near to far: window = deep_window_add(window, z, v), and keep window.layer
//     layer = deep_window_end(window), kept, too
// Layers of opacity 0 are not kept.
// The n sorted depths of samples have two vertices each: (z_k, 1 - k / n) and (z_k, 1 - (k + 1) / n), k from 0.
//
// With ever more samples the polyline becomes the one of a resolved list, in closed form: each range that covers the
// texel for a time takes that time's share of the light, evenly over its depths (deep_shadow_share). So lists of ranges
// give the deep map that samples converge to.
#ifndef GNOMON_MOTION_RANGE_DEEP_SHADOW_H
#define GNOMON_MOTION_RANGE_DEEP_SHADOW_H

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
struct gnomon_deep_layer { float z0, z1, opacity; };

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
float deep_shadow_add(float transmittance, gnomon_deep_layer layer, float z_f)
{
    float passed = saturate_or_zero((z_f - layer.z0) / (layer.z1 - layer.z0));
    return transmittance * (1.0 - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
float deep_shadow_end(float transmittance) { return saturate_or_zero(1.0 - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
float deep_shadow_share(depth_time_range r, float z_f)
{
    depth_time_range c = range_clip(r, 0.0, 1.0);
    float nearest = gnomon_min(c.z0, c.z1);
    float passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0, c.z1) - nearest));
    bool known = c.z0 == c.z0 && c.z1 == c.z1;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, 0.0));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if
/// the line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
struct gnomon_deep_window
{
    float tolerance, z0, v0, z1, v1, least, most, v, touched;
    gnomon_deep_layer layer;
};

const float gnomon_deep_window_steepest = 1099511627776.0; // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
gnomon_deep_layer deep_window_end(gnomon_deep_window window)
{
    gnomon_deep_layer r;
    r.z0 = window.z0;
    r.z1 = window.z1;
    r.opacity = saturate_or_zero((window.v0 - window.v1) / window.v0);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
gnomon_deep_window gnomon_deep_window_next(gnomon_deep_window window)
{
    window.layer = deep_window_end(window);
    window.z0 = window.z1;
    window.v0 = window.v1;
    window.least = -1.0 * gnomon_deep_window_steepest;
    window.most = 0.0;
    window.touched = 0.0;
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the
/// polyline. With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
gnomon_deep_window deep_window_begin(float tolerance)
{
    gnomon_deep_window r;
    r.tolerance = gnomon_max(tolerance, 0.0);
    r.z0 = -1.0;
    r.v0 = 1.0;
    r.z1 = -1.0;
    r.v1 = 1.0;
    r.v = 1.0;
    return gnomon_deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
gnomon_deep_window gnomon_deep_window_lead(gnomon_deep_window window, float z, float v)
{
    float length = z - window.z0;
    float lowest = (gnomon_max(v - window.tolerance, 0.0) - window.v0) / length;
    float highest = (v + window.tolerance - window.v0) / length;
    float least = gnomon_max(window.least, lowest);
    float most = gnomon_min(window.most, highest);
    float nearest = saturate_or_zero(clamp_or_high(v, window.v0 + least * length, window.v0 + most * length));
    bool level = window.touched < 1.0 && v == window.v && window.z1 < z; // no line begins before a drop
    bool step = length * gnomon_deep_window_steepest <= 1.0;
    bool kept = level || (step && window.v0 <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, 1.0, least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, 0.0, most));
    window.v1 = gnomon_select(kept, window.v0, gnomon_select(step, v, nearest));
    window.z0 = gnomon_select(level, z, window.z0);
    window.touched = gnomon_select(level, 0.0, 1.0);
    window.z1 = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
gnomon_deep_window gnomon_deep_window_select(bool mask, gnomon_deep_window a, gnomon_deep_window b)
{
    b.z0 = gnomon_select(mask, a.z0, b.z0);
    b.v0 = gnomon_select(mask, a.v0, b.v0);
    b.z1 = gnomon_select(mask, a.z1, b.z1);
    b.v1 = gnomon_select(mask, a.v1, b.v1);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0 = gnomon_select(mask, a.layer.z0, b.layer.z0);
    b.layer.z1 = gnomon_select(mask, a.layer.z1, b.layer.z1);
    b.layer.opacity = gnomon_select(mask, a.layer.opacity, b.layer.opacity);
    return b;
}

/// Add a vertex of the polyline, transmittance v at depth z; two at one depth are a step. If the layer of the result
/// has an opacity above 0 it is complete, and the caller keeps it.
/// Domain: vertices from near to far, transmittance in [0, 1] and never growing; others are moved to the nearest such.
/// Depths closer than 2^-40 count as equal.
/// NaN: the vertex is left out, as is one beyond 2^60.
/// Error: with all layers kept, the tolerance and 4 2^-p for each of them.
/// Source: Lokovic & Veach 2000
gnomon_deep_window deep_window_add(gnomon_deep_window window, float z, float v)
{
    bool known = gnomon_abs(z) < range_far && v == v;
    float touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1), window.z1);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = 0.0;
    gnomon_deep_window led = gnomon_deep_window_lead(window, z, v);
    bool deeper = window.most < window.least && (z - window.z0) * gnomon_deep_window_steepest <= 1.0;
    bool done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) led = gnomon_deep_window_select(done,
                                                          gnomon_deep_window_lead(gnomon_deep_window_next(window), z,
                                                                                  v), led);
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
}

#endif

// motion/range/range_cover.h ------------------------------------------------------------------------------------------
// Texels that one surface covers for the whole shutter, in front of everything else: the coverage map of Hong & Oh
// ("Efficient motion blurred shadows using a temporal shadow map", 2017). All other ranges of such a texel are occluded
// at all times and need not be stored. A cover is a range from 0 to 1 with the id of its surface. A texel without a
// cover has an empty range with the id -1.
//
// The paper needs three passes (comparators/three_pass_cover.h) and leaves a single pass for future work. These kernels
// take one pass over ranges, in any order:
//
//     state = range_cover_begin(1);              state = range_cover_add(state, r);            for all r
//     cover = range_cover_end(state);
//
// Ranges for which range_cover_occludes returns 1 may be left out of the list. The cover stays in the list, or a
// look-up tests it first:
//
//     answer = range_cover_answer(cover, t, z, id, bias);   if answer.decided is 0, test the list
#ifndef GNOMON_MOTION_RANGE_RANGE_COVER_H
#define GNOMON_MOTION_RANGE_RANGE_COVER_H

/// The best cover so far, and the nearest depth of all other ranges.
struct range_cover
{
    depth_time_range best;
    float front, far_plane;
};

/// The answer of a cover for one receiver: shadow intensity, 0 or 1, and decided, which is 1 if that is the answer of
/// the whole texel and 0 if the list has to be tested.
struct gnomon_cover_answer { float intensity, decided; };

const float gnomon_cover_margin = 0.0000019073486328125; // 2^-19, 32 2^-p in float

/// Begin without a range. Covers must not lie behind far_plane, which is 1.
range_cover range_cover_begin(float far_plane)
{
    range_cover state;
    state.best = range_empty(-1.0);
    state.front = far_plane;
    state.far_plane = far_plane;
    return state;
}

/// Add one range, as a whole: cut it into pieces (moving_depth_piece) only after it is known not to be the cover. The
/// best of the ranges from 0 to 1 is the one with the least farthest depth; if any range is in front of all others,
/// this one is. Ties go to the nearer end, then to the lesser id. All other ranges count as others, whatever their ids.
/// A range whose times are out of order adds nothing.
/// Domain: a cover needs depths within [-far_plane, far_plane] and an id of at least 0.
/// NaN: a range with a NaN adds nothing.
range_cover range_cover_add(range_cover state, depth_time_range r)
{
    float near_depth = gnomon_min(r.z0, r.z1);
    float far_depth = gnomon_max(r.z0, r.z1);
    float best_near = gnomon_min(state.best.z0, state.best.z1);
    float best_far = gnomon_max(state.best.z0, state.best.z1);
    bool some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    bool within = gnomon_abs(r.z0) <= state.far_plane && gnomon_abs(r.z1) <= state.far_plane;
    bool full = some && r.t0 <= 0.0 && 1.0 <= r.t1 && within && 0.0 <= r.id;
    bool first = state.best.id < 0.0;
    bool tie = far_depth == best_far;
    bool tie_wins = near_depth < best_near || (near_depth == best_near && r.id < state.best.id);
    bool better = full && (first || far_depth < best_far || (tie && tie_wins));

    float other = gnomon_select(better, gnomon_select(first, state.far_plane, best_near), near_depth);
    state.front = gnomon_select(some && other < state.front, other, state.front);
    state.best = gnomon_range_select(better, r, state.best);
    return state;
}

/// The cover, or an empty range with the id -1: the best range if no other one is ever nearer than its farther end.
/// Source: Hong & Oh 2017
depth_time_range range_cover_end(range_cover state)
{
    bool covers = gnomon_max(state.best.z0, state.best.z1) <= state.front;
    return gnomon_range_select(covers, state.best, range_empty(-1.0));
}

/// 1 where r may be left out of a list that keeps the cover: r is never nearer than the cover's farther end, or shadows
/// nothing. A receiver behind r is then behind the cover at all times, and shadowed by the cover, in spite of the
/// rounding of range_depth: the margin outweighs that rounding, and keeps a level cover from occluding itself. So a
/// receiver gets the answer of all ranges, unless it has the cover's id and the cover is in front of it by more than
/// its bias (see range_list.h for ids).
/// Domain: depths in [-1, 1], times in [0, 1].
float range_cover_occludes(depth_time_range cover, depth_time_range r)
{
    bool some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    float behind = gnomon_max(cover.z0, cover.z1) + gnomon_cover_margin;
    bool hidden = 0.0 <= cover.id && behind <= gnomon_min(r.z0, r.z1);
    return gnomon_select(hidden || !some, 1.0, 0.0);
}

/// Shadow test at time t and depth z on the surface with the given id. Where decided, the answer is that of all ranges
/// of the texel, bit for bit. The receiver is shadowed where z is more than the bias behind the cover and the cover has
/// another id. The receiver is lit where z is within the bias, less 2^-19, of the cover's farther end, since nothing
/// else is in front of the cover. Between the two, and without a cover, the answer is undecided. The paper compares no
/// depths: its test shadows a neighbouring triangle that lies in front of the cover, but falls into the cover's texel
/// by the map's resolution.
/// Domain: times in [0, 1], depths in [-1, 1], bias in [0, 1].
gnomon_cover_answer range_cover_answer(depth_time_range cover, float t, float z, float id, float bias)
{
    gnomon_cover_answer r;
    r.intensity = range_intensity(cover, t, z, id, bias);
    float behind = gnomon_max(cover.z0, cover.z1) + bias;
    bool lit = z + gnomon_cover_margin <= behind;
    r.decided = gnomon_select(0.0 <= cover.id && (lit || 0.0 < r.intensity), 1.0, 0.0);
    return r;
}

#endif

// motion/range/range_moments.h ----------------------------------------------------------------------------------------
// Moments over time of what a texel of the light sees while the shutter is open, in closed form from its resolved
// ranges: the filterable shadow map of motion that Palmer 2011 leaves as future work. The depth of a range is a line
// over time, so the mean of its power z^j is (z0^j + z0^(j-1) z1 + ... + z1^j) / (j + 1), and nothing cancels for
// depths of one sign. There is no noise: the moments are those that stochastic samples converge to.
//
// The result is a texel of a moment shadow map. It goes through any storage format and any linear filter, and gives the
// bounds on the shadow of a static receiver (moments/hamburger4.h). Time is collapsed: a receiver that moves with its
// caster gets the shadow of all times.
//
//     state = range_moments4_begin(1);
//     state = range_moments4_add(state, range);    for every range of the resolved list
//     b = range_moments4_end(state);
#ifndef GNOMON_MOTION_RANGE_RANGE_MOMENTS_H
#define GNOMON_MOTION_RANGE_RANGE_MOMENTS_H

/// The sum of moments weighted by time, the time that is covered, and the depth of the times that are not.
struct range_moments4
{
    moments4 sum;
    float covered, background;
};

const float range_moments_third = 0.33333333333333333333;
const float range_moments_fifth = 0.2;

/// The means of the first four powers of depth over the time of a range.
/// Domain: depths in [-1, 1].
/// NaN: NaN.
/// Error: 4 2^-p.
moments4 range_mean_moments4(depth_time_range r)
{
    float product = r.z0 * r.z1;
    float squares = r.z0 * r.z0 + r.z1 * r.z1;
    moments4 m;
    m.b1 = 0.5 * (r.z0 + r.z1);
    m.b2 = range_moments_third * (squares + product);
    m.b3 = 0.5 * (squares * m.b1);
    m.b4 = range_moments_fifth * ((squares * squares - product * product) + squares * product);
    return m;
}

/// Begin without a range. Times that no range covers have the depth `background`, 1 for a cleared map.
range_moments4 range_moments4_begin(float background)
{
    range_moments4 state;
    state.sum.b1 = 0.0;
    state.sum.b2 = 0.0;
    state.sum.b3 = 0.0;
    state.sum.b4 = 0.0;
    state.covered = 0.0;
    state.background = background;
    return state;
}

/// Add one range that is disjoint in time from those before.
/// NaN: a range with a NaN adds nothing.
range_moments4 range_moments4_add(range_moments4 state, depth_time_range r)
{
    depth_time_range c = range_clip(r, 0.0, 1.0);
    float duration = gnomon_select(c.z0 == c.z0 && c.z1 == c.z1, range_duration(c), 0.0);
    bool some = 0.0 < duration;
    moments4 sum = moments4_add(state.sum, range_mean_moments4(c), duration);
    state.sum.b1 = gnomon_select(some, sum.b1, state.sum.b1);
    state.sum.b2 = gnomon_select(some, sum.b2, state.sum.b2);
    state.sum.b3 = gnomon_select(some, sum.b3, state.sum.b3);
    state.sum.b4 = gnomon_select(some, sum.b4, state.sum.b4);
    state.covered = state.covered + duration;
    return state;
}

/// The moments of depth over the shutter interval.
/// Domain: ranges of a resolved list, depths in [-1, 1].
/// Error: 8 2^-p for each range.
moments4 range_moments4_end(range_moments4 state)
{
    float open = saturate_or_zero(1.0 - state.covered);
    return moments4_add(state.sum, moments4_from_depth(state.background), open);
}

#endif

// motion/range/range_summary.h ----------------------------------------------------------------------------------------
// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel
#ifndef GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#define GNOMON_MOTION_RANGE_RANGE_SUMMARY_H

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
struct range_summary { float nearest, farthest, shadowed, id; };

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
range_summary range_summary_begin(float near_plane)
{
    range_summary summary;
    summary.nearest = range_far;
    summary.farthest = near_plane;
    summary.shadowed = 0.0;
    summary.id = range_nothing;
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
range_summary range_summary_add(range_summary summary, depth_time_range r)
{
    bool some = r.t0 < r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    bool first = summary.id == range_nothing;
    float nearest = gnomon_min(summary.nearest, gnomon_min(r.z0, r.z1));
    float farthest = gnomon_max(summary.farthest, gnomon_max(r.z0, r.z1));
    float share = saturate_or_zero(r.t1) - saturate_or_zero(r.t0);
    float id = gnomon_select(first || summary.id == r.id, r.id, range_mixed);
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
bool gnomon_range_is_second_layer(depth_time_range front, depth_time_range r)
{
    return front.t0 <= r.t0 && r.t0 < front.t1 && r.t1 <= front.t1;
}

#endif

// motion/range/range_transmittance.h ----------------------------------------------------------------------------------
// Light through translucent surfaces that move: each range of a texel has an opacity, and light passes all ranges in
// front of a receiver. At one time the transmittance is the product of 1 - opacity over these ranges. It changes only
// when a range begins or ceases to be in front, so over the shutter interval it is a function of steps, whose mean is
// exact. The lists need no order and are not resolved: translucent ranges may overlap in time. An opaque surface is a
// range of opacity 1. (Palmer 2011, chapter 5, leaves transparency as future work.)
//
//     for (t = begin; t < end; t = step.t1)
//         step = range_transmittance_begin(t, end);
//         for every range of the texel, with its opacity:
//             hidden = static_receiver_occluding_part(state, range);      or that of a moving receiver
//             step = range_transmittance_add(step, hidden, id, opacity);
//         lost = range_transmittance_lost(step, share0, share1);    the shutter's shares at step.t0 and step.t1
//         state = static_receiver_add(state, lost);
//
// For a moving receiver with filtering, moving_receiver_filtered_light of a range with the times of the step, times the
// opacity of the step, is what it loses. Steps are contiguous from begin to end, and n ranges make at most 2 n + 1.
#ifndef GNOMON_MOTION_RANGE_RANGE_TRANSMITTANCE_H
#define GNOMON_MOTION_RANGE_RANGE_TRANSMITTANCE_H

/// A step of the transmittance of a list: from t0 to t1 the same ranges are in front of the receiver.
struct range_transmittance { float t0, t1, transmittance; };

/// Begin a step at time t, without a range. It lasts until end at most.
range_transmittance range_transmittance_begin(float t, float end)
{
    range_transmittance step;
    step.t0 = t;
    step.t1 = end;
    step.transmittance = 1.0;
    return step;
}

/// Add a range of the given opacity by `hidden`, its part in front of the receiver. The step ends when that part begins
/// or ends next. A range of the receiver's own id takes no light.
/// Domain: an opacity in [0, 1], and is clamped to that.
/// NaN: a range, or an opacity, with a NaN takes no light.
/// Error: after n ranges, 2 n 2^-p of the transmittance.
range_transmittance range_transmittance_add(range_transmittance step, depth_time_range hidden, float id, float opacity)
{
    bool counts = hidden.t0 < hidden.t1 && !(hidden.id == id);
    bool during = counts && hidden.t0 <= step.t0 && step.t0 < hidden.t1;
    bool later = counts && step.t0 < hidden.t0;
    float change = gnomon_select(during, hidden.t1, gnomon_select(later, hidden.t0, step.t1));
    step.t1 = gnomon_min(step.t1, change);
    float passing = 1.0 - saturate_or_zero(opacity);
    step.transmittance = gnomon_select(during, step.transmittance * passing, step.transmittance);
    return step;
}

/// Share of the light that a receiver loses during the step, in [0, 1]. The shutter has let in the shares share0 and
/// share1 of the exposure's light at the begin and at the end of the step.
/// NaN: 0.
/// Error: of the share let in, 4 2^-p, and that of the transmittance.
float range_transmittance_lost(range_transmittance step, float share0, float share1)
{
    return saturate_or_zero(share1 - share0) * saturate_or_zero(1.0 - step.transmittance);
}

#endif

// motion/receiver/facing.h --------------------------------------------------------------------------------------------
// Times at which a turning surface faces the light (Palmer 2011, 2.3.2, (2.5) and (2.6)). The normal n and the
// direction d from the surface to the light are both linear in time from shutter open to shutter close. The surface
// faces the light while
//     f(t) = (n0 (1 - t) + n1 t) . (d0 (1 - t) + d1 t) >= 0
// The Bernstein coefficients of f are n0 . d0, (n0 . d1 + n1 . d0) / 2 and n1 . d1, so f is an edge function of
// coverage_intervals.h. moving_edge_inside(facing_function(n, d), 1) returns the facing times: from begin to end except
// for one gap, hence up to two intervals. Outside of them the surface is dark, with or without casters; inside,
// receiver_path_clip returns the part of the receiver's path.
//
// d is linear if the point and the light both move along straight lines. The normal of a triangle is quadratic in time;
// as in the thesis, a line replaces it here. Only the sign of f matters, so n and d need not be normalised, as long as
// each is scaled alike at both ends.
#ifndef GNOMON_MOTION_RECEIVER_FACING_H
#define GNOMON_MOTION_RECEIVER_FACING_H

/// A vector at shutter open and at shutter close.
struct gnomon_moving_vector { float x0, y0, z0, x1, y1, z1; };

/// The facing function f as an edge function, for moving_edge_inside with facing 1.
/// Domain: beyond gnomon_moving_edge_limit f is 0 at all times, so the surface counts as facing the light.
/// NaN: f is 0 at all times, too.
/// Error: 4 2^-p |n| |d| for a coefficient, with the larger lengths of both ends; the facing times are exact for
/// coefficients that differ by 20 2^-p |n| |d|.
/// Source: Palmer 2011, Eq. 2.5; Palmer 2011, Eq. 2.6
gnomon_moving_edge facing_function(gnomon_moving_vector n, gnomon_moving_vector d)
{
    float n0_d1 = (n.x0 * d.x1 + n.y0 * d.y1) + n.z0 * d.z1;
    float n1_d0 = (n.x1 * d.x0 + n.y1 * d.y0) + n.z1 * d.z0;
    gnomon_moving_edge f;
    f.e0 = (n.x0 * d.x0 + n.y0 * d.y0) + n.z0 * d.z0;
    f.e1 = 0.5 * (n0_d1 + n1_d0);
    f.e2 = (n.x1 * d.x1 + n.y1 * d.y1) + n.z1 * d.z1;
    bool known = gnomon_moving_edge_size(f) < gnomon_moving_edge_limit;
    f.e0 = gnomon_select(known, f.e0, 0.0);
    f.e1 = gnomon_select(known, f.e1, 0.0);
    f.e2 = gnomon_select(known, f.e2, 0.0);
    return f;
}

#endif

// motion/receiver/line_sample.h ---------------------------------------------------------------------------------------
// Line samples (Gribel, Barringer & Akenine-Moller 2011): a texel of a shadow map sees the scene at one instant along a
// line through its centre, instead of at all times from its centre. Of a triangle the line sees intervals, which are
// known exactly, so a shadow's edge that crosses the line is where it is, and not at the border of a texel. Time is
// sampled: a map of lines is of one instant.
//
// Everything else is that of ranges in time, with the place on the line for the time. The line is one texel long: place
// 0 is at its begin, 1 at its end. A sample that goes along the line while the scene stands still sees what a sample
// that stands still sees of a scene that goes the other way:
//
//     triangle.a = line_sample_vertex(a, segment), b and c alike;       once for each instant
//     edges = moving_triangle_edges(triangle, s_x, s_y);             and coverage, depth, ranges, lists as of any
// triangle
//
// A receiver reads the line at its own place on it. Lines of one direction leave the other one sampled. So a map of
// lines along x and one along y are crossed: of the four points at the receiver's x on the lines above and below, and
// at its y on the lines to the left and to the right,
//
//     at = line_sample_place_of(x);      texel at.texel of the row below y - 1/2, and of the next, along x, and so for
// y
//     hidden = range_intensity(range, at.place, z, id, bias);        the greatest of the texel's list
//     intensity = line_sample_intensity(up, down, left, right, share_x, share_y);
#ifndef GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H
#define GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is
/// the centre of the texel.
struct line_sample { float t, along_x, along_y; };

/// A texel along a line's direction, and the place on its line, in [0, 1].
struct line_sample_place { float texel, place; };

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
gnomon_moving_vertex line_sample_vertex(gnomon_moving_vertex v, line_sample segment)
{
    float s = 1.0 - segment.t;
    float x = v.x0 * s + v.x1 * segment.t;
    float y = v.y0 * s + v.y1 * segment.t;
    gnomon_moving_vertex r;
    r.z0 = v.z0 * s + v.z1 * segment.t;
    r.w0 = v.w0 * s + v.w1 * segment.t;
    r.z1 = r.z0;
    r.w1 = r.w0;
    float half_x = (0.5 * segment.along_x) * r.w0;
    float half_y = (0.5 * segment.along_y) * r.w0;
    r.x0 = x + half_x;
    r.y0 = y + half_y;
    r.x1 = x - half_x;
    r.y1 = y - half_y;
    return r;
}

/// The texel that holds a position along the direction of lines, and the place on its line.
/// Domain: positions in [-65536, 65536].
/// NaN: place 0.
/// Error: exact for positions not below 0; else 2^-p.
line_sample_place line_sample_place_of(float x)
{
    line_sample_place r;
    r.texel = texel_below(x);
    r.place = saturate_or_zero(x - r.texel);
    return r;
}

/// Shadow intensity in [0, 1] from those of four points around the receiver: up and down on lines along x, left and
/// right on lines along y. Two opposite points that agree decide, since a straight edge between them would part them;
/// up and down are first. Else the mean of both pairs, interpolated: share_y of the distance from up to down has passed
/// at the receiver, share_x of that from left to right.
/// Domain: intensities 0 or 1. Elsewhere a number in [0, 1].
/// NaN: 0 for the point, and 0 for a share.
/// Error: exact if two opposite points agree; else 8 2^-p.
/// Source: Gribel 2011
float line_sample_intensity(float up, float down, float left, float right, float share_x, float share_y)
{
    float a = saturate_or_zero(up);
    float b = saturate_or_zero(down);
    float c = saturate_or_zero(left);
    float d = saturate_or_zero(right);
    float x = saturate_or_zero(share_x);
    float y = saturate_or_zero(share_y);
    float mean = 0.5 * ((a * (1.0 - y) + b * y) + (c * (1.0 - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
}

#endif

// motion/receiver/static_receiver.h -----------------------------------------------------------------------------------
// The shadow on a static receiver while the shutter is open, in closed form. Every range in front of the receiver
// occludes it for a time that is known in closed form, and the shutter (shutter.h) turns that time into a share of the
// light: exact, where stochastic shadow maps take samples. Ranges must not overlap in time, as in a resolved list; else
// the overlap counts twice. (Hong & Oh's shadow test, integrated over time; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     for every range of the texel:
//         hidden = static_receiver_occluding_part(state, range);
//         share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                    shutter_piecewise
//         state = static_receiver_add(state, receiver_lost_light(hidden, id, share0, share1));
//     intensity = static_receiver_end(state);
//
// Percentage-closer filtering of K x K bilinear look-ups around texel position (x, y) reads K + 1 texels along either
// axis. With x - K / 2 = column + u, column a whole number and u in [0, 1), and y alike, set the weight of texel
// (column + i, row + j), i and j from 0 to K, before its ranges:
//     state = static_receiver_set_weight(state, texel_weight(u, i, K) * texel_weight(v, j, K));
//
// A list may have a second layer (passes/range/resolve.hpp), for receivers whose own range is in front:
//     front = range_empty(range_nothing);
//     for every range of the texel, in order:
//         if gnomon_range_is_second_layer(front, range), leave range out unless front.id == id; else front = range
//
// A receiver behind all ranges of a texel, or in front of all, needs no list, only its summary (range_summary.h):
//     if (receiver_is_in_front(z_f, summary) > 0) nothing is added
//     if (static_receiver_is_behind(state, summary) > 0) state = static_receiver_add(state, summary.shadowed);
#ifndef GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
struct static_receiver { float depth, id, begin, end, weight, shadowed; };

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of gnomon_shutter_exposure_make.
static_receiver static_receiver_begin(float z_f, float id, float begin, float end)
{
    shutter_exposure open = gnomon_shutter_exposure_make(begin, end);
    static_receiver r;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
static_receiver static_receiver_set_weight(static_receiver state, float weight)
{
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
depth_time_range static_receiver_occluding_part(static_receiver state, depth_time_range r)
{
    depth_time_range level;
    level.t0 = state.begin;
    level.t1 = state.end;
    level.z0 = state.depth;
    level.z1 = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
float receiver_lost_light(depth_time_range hidden, float id, float share0, float share1)
{
    return gnomon_select(hidden.id == id, 0.0, saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
static_receiver static_receiver_add(static_receiver state, float lost)
{
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
float receiver_is_in_front(float z_f, range_summary summary) { return gnomon_select(z_f <= summary.nearest, 1.0, 0.0); }

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
float static_receiver_is_behind(static_receiver state, range_summary summary)
{
    bool whole = state.begin <= 0.0 && 1.0 <= state.end;
    bool own = summary.id == range_mixed || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, 1.0, 0.0);
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
float static_receiver_end(static_receiver state) { return saturate_or_zero(state.shadowed); }

#endif

// motion/receiver/texel_sweep.h ---------------------------------------------------------------------------------------
// The texels that a moving receiver passes, in order, and the time that it spends in each (for the analytical dynamic
// receivers that Palmer 2011, chapter 5, leaves as future work; the traversal is that of Amanatides & Woo 1987, in time
// and in perspective).
//
// The path crosses the texel border x = c where x(t) - c w(t) = 0, which is linear in time, also in perspective. The
// share of the path's time at the crossing is
//     s = (x0 - c w0) / ((x0 - c w0) - (x1 - c w1))
// While w > 0, x / w is monotonic, so the path crosses the borders between its first and its last column one after the
// other, and those of rows alike. The earlier of the next two crossings is the next step. Texels come from counting
// steps, times from the borders. Where rounding makes two times equal, their steps come in either order, and the texel
// between them lasts no time.
//
//     sweep = texel_sweep_begin(path);
//     for each range of texel (sweep.column, sweep.row): use the part from sweep.t_begin to sweep.t_end
//     while (sweep.t_end < sweep.t_last) { sweep = texel_sweep_next(sweep); and the same again }
//
// For any path the times are contiguous from t0 to t1, bit for bit, and the loop ends after at most |last column -
// first column| + |last row - first row| + 1 texels.
//
// texel_sweep_over leaves out the parts of the path that are beside the map or behind the light. In homogeneous
// coordinates the map's borders are edges that the path crosses at one time each, also where w changes its sign.
#ifndef GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H
#define GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
struct texel_sweep
{
    receiver_path path;
    float column, row, t_begin, t_end, last_column, last_row, t_last, across_column, across_row;
};

const float gnomon_texel_path_limit = 1152921504606846976.0; // 2^60: positions that are numbers
const float gnomon_texel_border_none = 2.0;                  // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
float gnomon_texel_border_share(float x0, float w0, float x1, float w1, float texel, float last)
{
    float border = texel + gnomon_select(texel < last, 1.0, 0.0);
    float distance0 = x0 - gnomon_product(border, w0);
    float distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, gnomon_texel_border_none,
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
texel_sweep gnomon_texel_sweep_set_times(texel_sweep sweep)
{
    float passed = gnomon_min(sweep.across_column, sweep.across_row);
    float t = sweep.path.depth.t0 * (1.0 - passed) + sweep.path.depth.t1 * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= 1.0, t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
texel_sweep gnomon_texel_sweep_start(texel_sweep sweep)
{
    receiver_path p = sweep.path;
    sweep.across_column = gnomon_texel_border_share(p.x0, p.w0, p.x1, p.w1, sweep.column, sweep.last_column);
    sweep.across_row = gnomon_texel_border_share(p.y0, p.w0, p.y1, p.w1, sweep.row, sweep.last_row);
    return gnomon_texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
texel_sweep texel_sweep_begin(receiver_path path)
{
    float x0 = path.x0 / path.w0;
    float y0 = path.y0 / path.w0;
    float x1 = path.x1 / path.w1;
    float y1 = path.y1 / path.w1;
    float size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    bool known = 0.0 < path.w0 && 0.0 < path.w1 && size < gnomon_texel_path_limit;
    texel_sweep sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1;
    return gnomon_texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
gnomon_linear_interval gnomon_receiver_path_over(receiver_path p, float left, float top, float right, float bottom)
{
    gnomon_linear_interval a = linear_edge_inside(p.x0 - gnomon_product(left, p.w0), p.x1 - gnomon_product(left, p.w1));
    gnomon_linear_interval b = linear_edge_inside(p.y0 - gnomon_product(top, p.w0), p.y1 - gnomon_product(top, p.w1));
    gnomon_linear_interval c = linear_edge_inside(gnomon_product(right, p.w0) - p.x0, gnomon_product(right, p.w1) -
                                                  p.x1);
    gnomon_linear_interval d = linear_edge_inside(gnomon_product(bottom, p.w0) - p.y0, gnomon_product(bottom, p.w1) -
                                                  p.y1);
    gnomon_linear_interval before_light = linear_edge_inside(p.w0, p.w1);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
float gnomon_texel_clamp(float x, float low, float high)
{
    return gnomon_min(gnomon_max(texel_below(x), low - 1.0), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
texel_sweep texel_sweep_over(receiver_path path, float left, float top, float right, float bottom)
{
    gnomon_linear_interval shares = gnomon_receiver_path_over(path, left, top, right, bottom);
    bool some = shares.begin < shares.end;
    float passed0 = gnomon_select(some, shares.begin, 0.0);
    float passed1 = gnomon_select(some, shares.end, 0.0);
    float left0 = 1.0 - passed0;
    float left1 = 1.0 - passed1;
    float w0 = path.w0 * left0 + path.w1 * passed0;
    float w1 = path.w0 * left1 + path.w1 * passed1;
    texel_sweep sweep;
    sweep.path = path;
    sweep.column = gnomon_texel_clamp((path.x0 * left0 + path.x1 * passed0) / w0, left, right);
    sweep.row = gnomon_texel_clamp((path.y0 * left0 + path.y1 * passed0) / w0, top, bottom);
    sweep.last_column = gnomon_texel_clamp((path.x0 * left1 + path.x1 * passed1) / w1, left, right);
    sweep.last_row = gnomon_texel_clamp((path.y0 * left1 + path.y1 * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0 * left0 + path.depth.t1 * passed0;
    sweep.t_last = path.depth.t0 * left1 + path.depth.t1 * passed1;
    return gnomon_texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
texel_sweep texel_sweep_next(texel_sweep sweep)
{
    bool sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= 1.0;
    bool along = sweep.across_row < sweep.across_column && sweep.across_row <= 1.0;
    float step_column = gnomon_select(sweep.column < sweep.last_column, 1.0, -1.0);
    float step_row = gnomon_select(sweep.row < sweep.last_row, 1.0, -1.0);
    sweep.column = sweep.column + gnomon_select(sideways, step_column, 0.0);
    sweep.row = sweep.row + gnomon_select(along, step_row, 0.0);
    // Only the axis that stepped has a new border.
    float x0 = gnomon_select(sideways, sweep.path.x0, sweep.path.y0);
    float x1 = gnomon_select(sideways, sweep.path.x1, sweep.path.y1);
    float texel = gnomon_select(sideways, sweep.column, sweep.row);
    float last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    float passed = gnomon_texel_border_share(x0, sweep.path.w0, x1, sweep.path.w1, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return gnomon_texel_sweep_set_times(sweep);
}

#endif

// motion/receiver/moving_receiver.h -----------------------------------------------------------------------------------
// The shadow on a moving receiver while the shutter is open, in closed form: the Analytical Dynamic Receivers that
// Palmer 2011 leaves as future work (chapter 5). A texel sweep (texel_sweep.h) finds the texels that the receiver
// passes and the times that it spends in each. In each texel, a range of the resolved list is in front of the
// receiver's depth line for a time in closed form, as in static_receiver.h, which is the case of one texel and a level
// line. Exact except for rounding, where Palmer takes 2 samples for each texel.
//
//     state = moving_receiver_begin(path, begin, end);
//     for each texel of a texel sweep of the path: state = moving_receiver_texel(state, sweep);
//         for every range of the texel:
//             hidden = moving_receiver_occluding_part(state, range);
//             share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                        shutter_piecewise
//             state = moving_receiver_add(state, receiver_lost_light(hidden, path.depth.id, share0, share1));
//     intensity = moving_receiver_end(state);
//
// With filtering, the weight of a texel changes along the path. Between the centres of texels the bilinear weights of
// the receiver's position are products of two functions that are linear in time, and the response of a shutter is
// piecewise linear. So the light lost to a range is the integral of a product of three lines. Percentage-closer
// filtering of K x K bilinear look-ups (K = 1 is bilinear filtering alone):
//     for each texel of a texel sweep of receiver_path_shift(path, -K / 2, -K / 2), i and j from 0 to K:
//         state = moving_receiver_tap(state, sweep, i, j, K);
//         for every range of texel (column + i, row + j):
//             hidden = moving_receiver_occluding_part(state, range);
//             lost = moving_receiver_filtered_light(state, hidden, state.begin, state.end, 1, 0);   for a box; for a
//                 tent the sum for two halves of the exposure, for a piecewise shutter that for eight parts
//             state = moving_receiver_add(state, lost);
// The result is the mean of K x K receivers with bilinear filtering, each on the path shifted by whole texels.
#ifndef GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
struct moving_receiver
{
    depth_time_range depth;
    float begin, end, t0, t1, u0, v0, u1, v1, shadowed;
};

/// Begin without a texel. The exposure lasts from begin to end, as of gnomon_shutter_exposure_make. A depth bias, if
/// one is needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses
/// light only in that part: divide the result by the shutter's share of that part.
moving_receiver moving_receiver_begin(receiver_path path, float begin, float end)
{
    shutter_exposure open = gnomon_shutter_exposure_make(begin, end);
    moving_receiver r;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0 = path.depth.t0;
    r.t1 = path.depth.t1;
    r.u0 = 1.0;
    r.v0 = 1.0;
    r.u1 = 1.0;
    r.v1 = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Begin the ranges of the sweep's texel.
moving_receiver moving_receiver_texel(moving_receiver state, texel_sweep sweep)
{
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
moving_receiver moving_receiver_tap(moving_receiver state, texel_sweep sweep, float i, float j, float look_ups)
{
    gnomon_texel_position enters = receiver_path_at(sweep.path, sweep.t_begin);
    gnomon_texel_position leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    state.u0 = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0 = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1 = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1 = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
depth_time_range moving_receiver_occluding_part(moving_receiver state, depth_time_range r)
{
    return range_occluding_part(r, state.depth, state.t0, state.t1);
}

/// Add the share of the light that is lost to one range.
moving_receiver moving_receiver_add(moving_receiver state, float lost)
{
    state.shadowed = state.shadowed + lost;
    return state;
}

const float gnomon_receiver_twelfth = 0.083333333333333333333; // Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
float moving_receiver_filtered_light(moving_receiver state, depth_time_range hidden, float start, float stop,
                                     float response, float slope)
{
    float a = gnomon_max(hidden.t0, start);
    float b = gnomon_min(hidden.t1, stop);
    bool some = a < b;
    float lost = 0.0;
    if (gnomon_any(some)) {
        float share_a = shutter_box(a, state.begin, state.end);
        float share_b = shutter_box(b, state.begin, state.end);
        float passed_a = saturate_or_zero((a - state.t0) / (state.t1 - state.t0));
        float passed_b = saturate_or_zero((b - state.t0) / (state.t1 - state.t0));
        float u_a = state.u0 * (1.0 - passed_a) + state.u1 * passed_a;
        float v_a = state.v0 * (1.0 - passed_a) + state.v1 * passed_a;
        float u_b = state.u0 * (1.0 - passed_b) + state.u1 * passed_b;
        float v_b = state.v0 * (1.0 - passed_b) + state.v1 * passed_b;
        float aa = u_a * v_a;
        float ab = u_a * v_b + u_b * v_a;
        float bb = u_b * v_b;
        float twelvefold = (response + slope * share_a) * (3.0 * aa + ab + bb) + (response + slope * share_b) *
                           (aa + ab + 3.0 * bb);
        float share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
        lost = gnomon_select(some, share * twelvefold * gnomon_receiver_twelfth, lost);
    }
    return lost;
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range that of static_receiver_end, filtered with 97 2^-p instead of 32; and that of the times at
/// which the path enters and leaves texels (gnomon_texel_border_share), or of weights (receiver_path_at, and
/// moving_receiver_tap in perspective).
/// Source: Palmer 2011, Sec. 5
float moving_receiver_end(moving_receiver state) { return saturate_or_zero(state.shadowed); }

#endif

// motion/receiver/time_dependent.h ------------------------------------------------------------------------------------
// Time-dependent shadow maps (Akenine-Moller, Munkberg & Hasselgren 2007): the shutter interval is cut into slices, and
// each slice has a shadow map whose texels have one sample each, at a time of their own within the slice. A receiver
// that is seen at time t_r reads the slice of that time, but the sample's time t is another one. In between, the
// surface that the sample shows has moved, and would shadow itself (Andersson et al. 2015, Figure 10).
//
//     sample.travel = time_dependent_travel(d_x, d_y);                         when the map is made
//     state = percentage_closer_begin(z_f - constant_bias);                    filters/percentage_closer.h
//     for the texel of the receiver, or for 2 x 2 texels by bilinear weights, in slice slice_of(t_r, slices):
//         state = percentage_closer_add(state, z, weight), where z is one of
//             sample.z                                                         constant bias alone
//             time_dependent_depth(sample, t_r)                                moved along with its surface in depth
//             time_dependent_biased_depth(sample, t_r, slope, texels)          and biased by the surface's slope
//     intensity = percentage_closer_end(state);
//
// Motion in depth is not enough for a tilted surface: in the time between, the sample moves across the map, too, and at
// its new place the surface has another depth. The third depth adds the most by which these differ.
#ifndef GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H
#define GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
struct time_dependent_sample { float z, t, d_z, travel; };

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
float time_dependent_travel(float d_x, float d_y) { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
float time_dependent_depth(time_dependent_sample s, float t_r) { return s.z + s.d_z * (t_r - s.t); }

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself;
/// the factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
float time_dependent_biased_depth(time_dependent_sample s, float t_r, float slope, float texels)
{
    float passed = gnomon_abs(t_r - s.t);
    float reach = texels + 1.5 * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(0.0, slope) * reach;
}

#endif

// motion/triangle/triangle_setup.h ------------------------------------------------------------------------------------
// The edge functions of a moving triangle over many samples: coverage and depth for all texels of a rasterizer's tile,
// and for whole blocks of texels at once.
//
// The edge function of moving_triangle.h, (p_i - s w_i) x (p_j - s w_j) for a sample s, is the homogeneous line through
// p_i and p_j applied to (s_x, s_y, 1). So each of its three Bernstein coefficients is affine in the sample:
//     e(s) = c + x s_x + y s_y,   (x, y, c) = (X_i, Y_i, W_i) x (X_j, Y_j, W_j)
// Nine numbers for each edge serve a whole tile. Over a block of samples a coefficient is at most its value at the
// middle plus |x| and |y| times half of the block's extents. Bernstein polynomials are not negative, so the edge
// function is at all times at most the one with these bounds as coefficients. So moving_coverage of such edges contains
// all times at which the triangle covers any sample of the block: one kernel shades and culls, in space and in time.
//
//     setup = triangle_setup_make(triangle, origin_x, origin_y);                 once for a tile
//     blocks = triangle_setup_around(setup, h_x, h_y, facing);
//     times = moving_coverage(triangle_setup_edges(blocks, s_x, s_y), facing);   none: skip the block
//     times = moving_coverage(triangle_setup_edges(setup, s_x, s_y), facing);
//
// Vertices with equal motions have edge functions that are linear in time: the cross product of their motions, e0 - 2
// e1 + e2, vanishes. Then two planes serve for an edge, and a quotient for its time. Decide for each edge alone whether
// it is linear enough, so that both triangles at the edge decide alike and no crack opens:
//
//     linear = moving_edge_nonlinearity(b, c) <= tolerance, and so on for the other edges
//     times = linear_coverage(triangle_setup_edges_linear(setup, s_x, s_y))
//
// Depth that is linear in view distance is measured from that of vertex c:
//     z(t) = z_c(t) + N(t) / D(t),   N = e_a (z_a - z_c) + e_b (z_b - z_c),   D = e_a + e_b + e_c
// N is a cubic whose four Bernstein coefficients are affine in the sample, too, and D follows from the edge functions.
// This takes a third of the operations of the vertices' mean (moving_triangle.h), and nothing large cancels.
//
//     depths = depth_setup_make(setup, triangle);   once for a tile
//     curve = moving_depth_curve(depths, edges, s_x, s_y);
//     z = depth_curve_at(curve, t);   linear_depth_at, if edges and depths are linear
//
// Lines approximate depth where they are near enough, else lines of pieces, as for moving_depth_line:
//
//     line = depth_curve_line(curve, begin, end);   if (line.deviation <= tolerance), else
//     for (passed = 0; passed < 1; passed = piece.passed)
//         piece = depth_curve_piece(curve, begin, end, passed, tolerance);
#ifndef GNOMON_MOTION_TRIANGLE_TRIANGLE_SETUP_H
#define GNOMON_MOTION_TRIANGLE_TRIANGLE_SETUP_H

/// An affine function of the sample: c + x s_x + y s_y.
struct gnomon_sample_plane { float x, y, c; };

/// Bernstein coefficients of an edge function, as affine functions of the sample.
struct gnomon_edge_equation { gnomon_sample_plane e0, e1, e2; };

/// The edge equations opposite to the vertices a, b, c of a triangle.
struct triangle_setup { gnomon_edge_equation a, b, c; };

/// Bernstein coefficients of N as affine functions of the sample, the middle ones times 3; z_c at shutter open and
/// close; the least and the largest depth of all vertices, in [-1, 1].
struct depth_setup
{
    gnomon_sample_plane n0, n1, n2, n3;
    float z0, z1, least, most;
};

/// Depth at one sample: the coefficients of N, the coefficients of D with the middle one times 2, and the rest as in
/// depth_setup.
struct depth_curve { float n0, n1, n2, n3, d0, d1, d2, z0, z1, least, most; };

/// Homogeneous line through two points of the plane.
gnomon_sample_plane gnomon_homogeneous_line(float a_x, float a_y, float a_w, float b_x, float b_y, float b_w)
{
    gnomon_sample_plane r;
    r.x = gnomon_sheared_cross(a_y, a_w, b_y, b_w);
    r.y = gnomon_sheared_cross(a_w, a_x, b_w, b_x);
    r.c = gnomon_sheared_cross(a_x, a_y, b_x, b_y);
    return r;
}

/// Edge equation from a to b. Exchanging a and b negates it bit for bit.
gnomon_edge_equation edge_equation_make(gnomon_moving_vertex a, gnomon_moving_vertex b)
{
    gnomon_sample_plane early = gnomon_homogeneous_line(a.x0, a.y0, a.w0, b.x1, b.y1, b.w1);
    gnomon_sample_plane late = gnomon_homogeneous_line(a.x1, a.y1, a.w1, b.x0, b.y0, b.w0);
    gnomon_edge_equation f;
    f.e0 = gnomon_homogeneous_line(a.x0, a.y0, a.w0, b.x0, b.y0, b.w0);
    f.e1.x = 0.5 * (early.x + late.x);
    f.e1.y = 0.5 * (early.y + late.y);
    f.e1.c = 0.5 * (early.c + late.c);
    f.e2 = gnomon_homogeneous_line(a.x1, a.y1, a.w1, b.x1, b.y1, b.w1);
    return f;
}

/// The vertex relative to an origin on the map, in the units of x / w.
gnomon_moving_vertex gnomon_moving_vertex_translate(gnomon_moving_vertex v, float origin_x, float origin_y)
{
    gnomon_sheared_vertex s = gnomon_moving_vertex_shear(v, origin_x, origin_y);
    v.x0 = s.x0;
    v.y0 = s.y0;
    v.x1 = s.x1;
    v.y1 = s.y1;
    return v;
}

/// Upper bound of the distance, in the units of x / w, of the edge from a to b from an edge that is linear in time and
/// equal at both ends. It holds among the samples between the least and the largest x / w and y / w of both vertices.
/// The same from b to a, bit for bit.
/// Domain: all w > 0.
/// NaN: the result for an edge without length is NaN.
/// Error: 16 2^-p of the result, and 32 2^-p times the products X_i Y_j + Y_i X_j of triangle_setup_make's error, over
/// the least slope of the edge function.
float moving_edge_nonlinearity(gnomon_moving_vertex a, gnomon_moving_vertex b)
{
    float a_x0 = a.x0 / a.w0;
    float a_x1 = a.x1 / a.w1;
    float a_y0 = a.y0 / a.w0;
    float a_y1 = a.y1 / a.w1;
    float b_x0 = b.x0 / b.w0;
    float b_x1 = b.x1 / b.w1;
    float b_y0 = b.y0 / b.w0;
    float b_y1 = b.y1 / b.w1;
    float low_x = gnomon_min(gnomon_min(a_x0, a_x1), gnomon_min(b_x0, b_x1));
    float low_y = gnomon_min(gnomon_min(a_y0, a_y1), gnomon_min(b_y0, b_y1));
    float high_x = gnomon_max(gnomon_max(a_x0, a_x1), gnomon_max(b_x0, b_x1));
    float high_y = gnomon_max(gnomon_max(a_y0, a_y1), gnomon_max(b_y0, b_y1));
    float x = 0.5 * (low_x + high_x);
    float y = 0.5 * (low_y + high_y);
    gnomon_moving_vertex p = gnomon_moving_vertex_translate(a, x, y);
    gnomon_moving_vertex q = gnomon_moving_vertex_translate(b, x, y);
    gnomon_edge_equation f = edge_equation_make(p, q);
    gnomon_sample_plane bend = gnomon_homogeneous_line(p.x1 - p.x0, p.y1 - p.y0, p.w1 - p.w0, q.x1 - q.x0, q.y1 - q.y0,
                                                       q.w1 - q.w0);
    float most = gnomon_abs(bend.c) + 0.5 *
                 (gnomon_abs(bend.x) * (high_x - low_x) + gnomon_abs(bend.y) * (high_y - low_y));
    // Distance is value over slope. Between the ends, the slope is least where its line is nearest to 0.
    float turn_x = f.e2.x - f.e0.x;
    float turn_y = f.e2.y - f.e0.y;
    float turn = turn_x * turn_x + turn_y * turn_y;
    float nearest = saturate_or_zero(-1.0 * (f.e0.x * turn_x + f.e0.y * turn_y) / turn);
    float slope_x = f.e0.x + nearest * turn_x;
    float slope_y = f.e0.y + nearest * turn_y;
    return 0.25 * most / gnomon_sqrt(slope_x * slope_x + slope_y * slope_y);
}

/// Edge equations of a triangle. Samples are relative to the origin, which is best near them.
/// Error: 64 2^-p (X_i Y_j + Y_i X_j) for a coefficient at sample s; the covered times are exact for coefficients that
/// differ by as much. X = max(|x| + (|origin_x| + |s_x|) |w|) over the shutter's ends, Y likewise, p the bits of the
/// significand.
triangle_setup triangle_setup_make(moving_triangle m, float origin_x, float origin_y)
{
    gnomon_moving_vertex a = gnomon_moving_vertex_translate(m.a, origin_x, origin_y);
    gnomon_moving_vertex b = gnomon_moving_vertex_translate(m.b, origin_x, origin_y);
    gnomon_moving_vertex c = gnomon_moving_vertex_translate(m.c, origin_x, origin_y);
    triangle_setup f;
    f.a = edge_equation_make(b, c);
    f.b = edge_equation_make(c, a);
    f.c = edge_equation_make(a, b);
    return f;
}

/// Value of the affine function p at the sample. Odd in p, bit for bit.
float gnomon_sample_plane_at(gnomon_sample_plane p, float s_x, float s_y)
{
    return (gnomon_product(p.x, s_x) + gnomon_product(p.y, s_y)) + p.c;
}

/// Edge function at a sample.
gnomon_moving_edge edge_equation_at(gnomon_edge_equation f, float s_x, float s_y)
{
    gnomon_moving_edge e;
    e.e0 = gnomon_sample_plane_at(f.e0, s_x, s_y);
    e.e1 = gnomon_sample_plane_at(f.e1, s_x, s_y);
    e.e2 = gnomon_sample_plane_at(f.e2, s_x, s_y);
    return e;
}

/// Edge functions at a sample, for moving_coverage. Two triangles that share an edge cover each sample near it exactly
/// one at a time, as with moving_triangle_edges.
gnomon_moving_edges triangle_setup_edges(triangle_setup f, float s_x, float s_y)
{
    gnomon_moving_edges e;
    e.a = edge_equation_at(f.a, s_x, s_y);
    e.b = edge_equation_at(f.b, s_x, s_y);
    e.c = edge_equation_at(f.c, s_x, s_y);
    return e;
}

/// Edge function at a sample, for an edge function that is linear in time: its middle coefficient is the mean of the
/// others.
gnomon_moving_edge gnomon_linear_edge_at(gnomon_edge_equation f, float s_x, float s_y)
{
    gnomon_moving_edge e;
    e.e0 = gnomon_sample_plane_at(f.e0, s_x, s_y);
    e.e2 = gnomon_sample_plane_at(f.e2, s_x, s_y);
    e.e1 = 0.5 * (e.e0 + e.e2);
    return e;
}

/// Edge functions at a sample, for linear_coverage: all three are linear in time.
gnomon_moving_edges triangle_setup_edges_linear(triangle_setup f, float s_x, float s_y)
{
    gnomon_moving_edges e;
    e.a = gnomon_linear_edge_at(f.a, s_x, s_y);
    e.b = gnomon_linear_edge_at(f.b, s_x, s_y);
    e.c = gnomon_linear_edge_at(f.c, s_x, s_y);
    return e;
}

/// Upper bound of the affine function p over the samples within h_x and h_y of each sample; the lower bound if facing
/// is -1.
gnomon_sample_plane gnomon_sample_plane_around(gnomon_sample_plane p, float h_x, float h_y, float facing)
{
    p.c = p.c + facing * (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y);
    return p;
}

/// Bounds of an edge function, as of triangle_setup_around.
gnomon_edge_equation gnomon_edge_equation_around(gnomon_edge_equation f, float h_x, float h_y, float facing)
{
    f.e0 = gnomon_sample_plane_around(f.e0, h_x, h_y, facing);
    f.e1 = gnomon_sample_plane_around(f.e1, h_x, h_y, facing);
    f.e2 = gnomon_sample_plane_around(f.e2, h_x, h_y, facing);
    return f;
}

/// Bounds of the edge functions over the samples within h_x and h_y of each sample: upper bounds if facing is 1, lower
/// bounds if facing is -1. moving_coverage at (s_x, s_y), with the same facing, contains all times at which a triangle
/// of this facing covers any sample of the block around (s_x, s_y).
/// Error: rounding may reduce h_x and h_y by 8 2^-p of the tile's extents; pass a little more.
triangle_setup triangle_setup_around(triangle_setup f, float h_x, float h_y, float facing)
{
    f.a = gnomon_edge_equation_around(f.a, h_x, h_y, facing);
    f.b = gnomon_edge_equation_around(f.b, h_x, h_y, facing);
    f.c = gnomon_edge_equation_around(f.c, h_x, h_y, facing);
    return f;
}

/// The sum of a times k_a and b times k_b.
gnomon_sample_plane gnomon_sample_planes_combine(gnomon_sample_plane a, float k_a, gnomon_sample_plane b, float k_b)
{
    gnomon_sample_plane r;
    r.x = a.x * k_a + b.x * k_b;
    r.y = a.y * k_a + b.y * k_b;
    r.c = a.c * k_a + b.c * k_b;
    return r;
}

/// Twice the middle coefficient of an edge times one end of a depth, plus an outer coefficient times the other end.
gnomon_sample_plane gnomon_depth_setup_middle(gnomon_sample_plane outer, float across, gnomon_sample_plane middle,
                                              float beside)
{
    return gnomon_sample_planes_combine(outer, across, middle, 2.0 * beside);
}

/// Depths of the triangle that the setup is of. The vertices' z is linear in view distance; samples are those of the
/// setup.
depth_setup depth_setup_make(triangle_setup f, moving_triangle m)
{
    float a0 = m.a.z0 - m.c.z0;
    float a1 = m.a.z1 - m.c.z1;
    float b0 = m.b.z0 - m.c.z0;
    float b1 = m.b.z1 - m.c.z1;
    depth_setup d;
    d.n0 = gnomon_sample_planes_combine(f.a.e0, a0, f.b.e0, b0);
    d.n1 = gnomon_sample_planes_combine(gnomon_depth_setup_middle(f.a.e0, a1, f.a.e1, a0), 1.0,
                                        gnomon_depth_setup_middle(f.b.e0, b1, f.b.e1, b0), 1.0);
    d.n2 = gnomon_sample_planes_combine(gnomon_depth_setup_middle(f.a.e2, a0, f.a.e1, a1), 1.0,
                                        gnomon_depth_setup_middle(f.b.e2, b0, f.b.e1, b1), 1.0);
    d.n3 = gnomon_sample_planes_combine(f.a.e2, a1, f.b.e2, b1);
    d.z0 = m.c.z0;
    d.z1 = m.c.z1;
    float least = gnomon_min(gnomon_min(gnomon_min(m.a.z0, m.a.z1), gnomon_min(m.b.z0, m.b.z1)),
                             gnomon_min(d.z0, d.z1));
    float most = gnomon_max(gnomon_max(gnomon_max(m.a.z0, m.a.z1), gnomon_max(m.b.z0, m.b.z1)), gnomon_max(d.z0, d.z1));
    d.least = gnomon_max(gnomon_min(least, 1.0), -1.0);
    d.most = gnomon_max(gnomon_min(most, 1.0), -1.0);
    return d;
}

/// Depth as a function of time at a sample; e are the edge functions at the same sample, from triangle_setup_edges.
depth_curve moving_depth_curve(depth_setup d, gnomon_moving_edges e, float s_x, float s_y)
{
    depth_curve r;
    r.n0 = gnomon_sample_plane_at(d.n0, s_x, s_y);
    r.n1 = gnomon_sample_plane_at(d.n1, s_x, s_y);
    r.n2 = gnomon_sample_plane_at(d.n2, s_x, s_y);
    r.n3 = gnomon_sample_plane_at(d.n3, s_x, s_y);
    r.d0 = (e.a.e0 + e.b.e0) + e.c.e0;
    r.d1 = 2.0 * ((e.a.e1 + e.b.e1) + e.c.e1);
    r.d2 = (e.a.e2 + e.b.e2) + e.c.e2;
    r.z0 = d.z0;
    r.z1 = d.z1;
    r.least = d.least;
    r.most = d.most;
    return r;
}

/// Depth of the triangle's point at the sample at time t in [0, 1], always within the limits of all vertices' depths.
/// Where D is 0, such as where the triangle turns edge-on, one of these limits.
/// Domain: the triangle covers the sample at time t, and all w > 0.
/// NaN: the farthest depth of the vertices.
/// Error: 32 2^-p (S_a |z_a - z_c| + S_b |z_b - z_c| + |z - z_c| (S_a + S_b + S_c)) / |D| and 8 2^-p; S_k the products
/// X_i Y_j + Y_i X_j of edge k in triangle_setup_make's error, |z_k - z_c| the larger one of both ends of the shutter.
float depth_curve_at(depth_curve c, float t)
{
    float s = 1.0 - t;
    float numerator = (c.n0 * s + c.n1 * t) * (s * s) + (c.n2 * s + c.n3 * t) * (t * t);
    float denominator = (c.d0 * s + c.d1 * t) * s + c.d2 * (t * t);
    float z = (c.z0 * s + c.z1 * t) + numerator / denominator;
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Depth at time t as of depth_curve_at, for N and D that are linear in time: edges are linear, and depths of vertices
/// change alike.
/// NaN: the farthest depth of the vertices.
/// Error: that of depth_curve_at.
float linear_depth_at(depth_curve c, float t)
{
    float s = 1.0 - t;
    float z = (c.z0 * s + c.z1 * t) + (c.n0 * s + c.n3 * t) / (c.d0 * s + c.d2 * t);
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Line through the depths of depth_curve_at at the times begin and end, and an upper bound of the deviation of depth
/// from it. Where D may vanish, the bound is the largest deviation within the limits.
/// Domain: begin <= end, both in [0, 1].
/// Error: 24 2^-p (n + d (r + deviation)) / |D| and 8 2^-p of the largest depth; n and d the largest coefficients of N
/// and D, the middle ones as means, not times 3 and 2; r the larger |N / D| at an end, |D| where it is least.
depth_line depth_curve_line(depth_curve c, float begin, float end)
{
    float b = 1.0 - begin;
    float f = 1.0 - end;
    // Bernstein coefficients between the two times, by blossoming.
    float three0 = 3.0 * c.n0;
    float three3 = 3.0 * c.n3;
    float n0 = (c.n0 * b + c.n1 * begin) * (b * b) + (c.n2 * b + c.n3 * begin) * (begin * begin);
    float n1 = ((three0 * f + c.n1 * end) * (b * b) + (c.n2 * f + three3 * end) * (begin * begin)) +
               (c.n1 * f + c.n2 * end) * (2.0 * (b * begin));
    float n2 = ((three0 * b + c.n1 * begin) * (f * f) + (c.n2 * b + three3 * begin) * (end * end)) +
               (c.n1 * b + c.n2 * begin) * (2.0 * (f * end));
    float n3 = (c.n0 * f + c.n1 * end) * (f * f) + (c.n2 * f + c.n3 * end) * (end * end);
    float d0 = (c.d0 * b + c.d1 * begin) * b + c.d2 * (begin * begin);
    float d1 = (2.0 * (c.d0 * f) + c.d1 * end) * b + (c.d1 * f + 2.0 * (c.d2 * end)) * begin;
    float d2 = (c.d0 * f + c.d1 * end) * f + c.d2 * (end * end);
    float q0 = n0 / d0;
    float q1 = n3 / d2;
    float p0 = (n1 - q0 * d1) - q1 * d0;
    float p1 = (n2 - q1 * d1) - q0 * d2;
    float bend = gnomon_depth_nonlinearity(gnomon_max(gnomon_abs(p0), gnomon_abs(p1)), d0, d2, d1, d1);
    float free0 = (c.z0 * b + c.z1 * begin) + q0;
    float free1 = (c.z0 * f + c.z1 * end) + q1;
    float z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    float z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return gnomon_depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// Line through the depths of linear_depth_at at the times begin and end, and the largest deviation of depth from it,
/// for N and D that are linear in time. The bound is attained.
depth_line linear_depth_line(depth_curve c, float begin, float end)
{
    float b = 1.0 - begin;
    float f = 1.0 - end;
    float d0 = c.d0 * b + c.d2 * begin;
    float d1 = c.d0 * f + c.d2 * end;
    float q0 = (c.n0 * b + c.n3 * begin) / d0;
    float q1 = (c.n0 * f + c.n3 * end) / d1;
    float bend = gnomon_depth_nonlinearity(gnomon_abs((q1 - q0) * (d1 - d0)), d0, d1, d0 + d1, d0 + d1);
    float free0 = (c.z0 * b + c.z1 * begin) + q0;
    float free1 = (c.z0 * f + c.z1 * end) + q1;
    float z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    float z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return gnomon_depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// The next piece of an interval, as of moving_depth_piece, with lines of depth_curve_line; for linear N and D, too.
depth_piece depth_curve_piece(depth_curve c, float begin, float end, float passed, float tolerance)
{
    depth_trial r = gnomon_depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < 1.0)) r = gnomon_depth_trial_next(r, depth_curve_line(c, r.piece.t0, r.piece.t1),
                                                                     begin, end, tolerance);
    }
    return r.piece;
}

#endif

// motion/triangle/depth_planes.h --------------------------------------------------------------------------------------
// Times at which the point of a moving triangle that a sample sees lies between the near and the far plane. A surface
// that passes one of the planes is visible for a part of its covered times: its times are clipped, not its depths.
//
// With depth z = z_c + N / D (triangle_setup.h) and D > 0 where the triangle turns its positive side to the sample, z
// is at least p exactly where
//     h(t) = N(t) + (z_c(t) - p) D(t) >= 0
// This is a cubic in t. Its turning points, the roots of a quadratic, divide [0, 1] into three intervals in which h is
// monotonic. Each interval has one root or none; bisection finds the root. A cubic is positive in at most two
// intervals, so the result is an gnomon_edge_intervals, as for an edge.
//
//     near = depth_intervals_beyond(curve, -1, facing);   far = depth_intervals_before(curve, 1, facing);
//     for every covered interval: edge_intervals_part(near, 0, begin, end), and part 1; each of them alike with far
#ifndef GNOMON_MOTION_TRIANGLE_DEPTH_PLANES_H
#define GNOMON_MOTION_TRIANGLE_DEPTH_PLANES_H

/// A cubic: h0 s^3 + h1 s^2 t + h2 s t^2 + h3 t^3, s = 1 - t.
struct gnomon_moving_cubic { float h0, h1, h2, h3; };

/// A root between two times, and whether there is one, 1 or 0.
struct gnomon_cubic_root { float t, found; };

const float gnomon_cubic_third = 0.333333333333333333333;

/// Value of h at time t in [0, 1].
/// Error: 8 2^-p times the largest coefficient.
float gnomon_moving_cubic_at(gnomon_moving_cubic h, float t)
{
    float s = 1.0 - t;
    return (h.h0 * s + h.h1 * t) * (s * s) + (h.h2 * s + h.h3 * t) * (t * t);
}

/// Time at which the sign of h changes between begin and end, where h has the values at_begin and at_end and is
/// monotonic between them. By 24 halvings.
/// Error: 2^-24 of the interval.
gnomon_cubic_root gnomon_moving_cubic_root(gnomon_moving_cubic h, float begin, float end, float at_begin, float at_end)
{
    bool before = at_begin < 0.0;
    bool after = at_end < 0.0;
    bool some = begin <= end && ((before && !after) || (after && !before));
    float low = begin;
    float high = end;
    for (int i = 0; i < 24; ++i) {
        float middle = 0.5 * (low + high);
        bool outside = gnomon_moving_cubic_at(h, middle) < 0.0;
        bool left = (outside && before) || !(outside || before); // the root is later
        low = gnomon_select(left, middle, low);
        high = gnomon_select(left, high, middle);
    }
    gnomon_cubic_root r;
    // Return the end that is inside, so that h is not negative at the time.
    r.t = gnomon_select(before, high, low);
    r.found = gnomon_select(some, 1.0, 0.0);
    return r;
}

/// Times in [0, 1] at which h >= 0.
/// NaN: none.
/// Error: the error of the cubic's value over its slope at that time, and 2^-24. If h only touches 0 within its error,
/// as if it did not.
gnomon_edge_intervals gnomon_moving_cubic_inside(gnomon_moving_cubic h)
{
    float none = gnomon_coverage_none;
    // A third of the slope, by Bernstein coefficients. The ends of the times at which h rises are the turning points.
    float b1 = h.h1 * gnomon_cubic_third;
    float b2 = h.h2 * gnomon_cubic_third;
    gnomon_moving_edge slope;
    slope.e0 = b1 - h.h0;
    slope.e1 = b2 - b1;
    slope.e2 = h.h3 - b2;
    gnomon_edge_intervals rises = moving_edge_inside(slope, 1.0);
    bool gap = rises.gap_begin < none;
    bool some = rises.begin < rises.end;
    float first = gnomon_select(gap, rises.gap_begin, gnomon_select(some, rises.begin, 0.0));
    float second = gnomon_select(gap, rises.gap_end, gnomon_select(some, rises.end, 1.0));
    float at_first = gnomon_moving_cubic_at(h, first);
    float at_second = gnomon_moving_cubic_at(h, second);
    gnomon_cubic_root a = gnomon_moving_cubic_root(h, 0.0, first, h.h0, at_first);
    gnomon_cubic_root b = gnomon_moving_cubic_root(h, first, second, at_first, at_second);
    gnomon_cubic_root c = gnomon_moving_cubic_root(h, second, 1.0, at_second, h.h3);

    // The roots in order, missing ones last.
    bool has_a = 0.0 < a.found;
    bool has_b = 0.0 < b.found;
    bool has_c = 0.0 < c.found;
    float root0 = gnomon_select(has_a, a.t, gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none)));
    float later = gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none));
    float root1 = gnomon_select(has_a, later, gnomon_select(has_b && has_c, c.t, none));
    float root2 = gnomon_select(has_a && has_b && has_c, c.t, none);

    bool open = 0.0 <= h.h0;
    gnomon_edge_intervals x;
    x.begin = gnomon_select(open, 0.0, gnomon_min(root0, 1.0));
    // A gap lasts from the first root to the second if h is positive at shutter open, else from the second to the
    // third. Without its second root there is no gap, and the times end at its first.
    float leaves = gnomon_select(open, root0, root1);
    float returns = gnomon_select(open, root1, root2);
    float leaves_again = gnomon_select(open, root2, none);
    bool back = returns < none;
    x.end = gnomon_min(gnomon_select(back, leaves_again, leaves), 1.0);
    x.gap_begin = gnomon_select(back, leaves, none);
    x.gap_end = gnomon_select(back, returns, none);
    bool known = (gnomon_abs(h.h0) + gnomon_abs(h.h1)) +
                 (gnomon_abs(h.h2) + gnomon_abs(h.h3)) < gnomon_moving_edge_limit;
    bool ever = known && (open || root0 < none);
    x.begin = gnomon_select(ever, x.begin, 1.0);
    x.end = gnomon_select(ever, x.end, 0.0);
    return x;
}

/// The cubic N + (z_c - plane) D, times side.
gnomon_moving_cubic gnomon_depth_over_plane(depth_curve c, float plane, float side)
{
    float z0 = c.z0 - plane;
    float z1 = c.z1 - plane;
    gnomon_moving_cubic h;
    h.h0 = side * (c.n0 + z0 * c.d0);
    h.h1 = side * (c.n1 + (z0 * c.d1 + z1 * c.d0));
    h.h2 = side * (c.n2 + (z0 * c.d2 + z1 * c.d1));
    h.h3 = side * (c.n3 + z1 * c.d2);
    return h;
}

/// Times at which the depth of a triangle is at least that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of gnomon_moving_cubic_inside.
gnomon_edge_intervals depth_intervals_beyond(depth_curve c, float plane, float facing)
{
    return gnomon_moving_cubic_inside(gnomon_depth_over_plane(c, plane, facing));
}

/// Times at which the depth of a triangle is at most that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of gnomon_moving_cubic_inside.
gnomon_edge_intervals depth_intervals_before(depth_curve c, float plane, float facing)
{
    return gnomon_moving_cubic_inside(gnomon_depth_over_plane(c, plane, -1.0 * facing));
}

/// The part of the interval from begin to end that lies in x: before its gap (part 0) or after the gap (part 1). Empty
/// unless begin < end. Without a gap everything is in part 0.
gnomon_linear_interval edge_intervals_part(gnomon_edge_intervals x, float part, float begin, float end)
{
    bool second = 0.5 < part;
    gnomon_linear_interval r;
    r.begin = gnomon_max(begin, gnomon_select(second, x.gap_end, x.begin));
    r.end = gnomon_min(end, gnomon_select(second, x.end, gnomon_min(x.end, x.gap_begin)));
    return r;
}

#endif

// motion/triangle/edge_widening.h -------------------------------------------------------------------------------------
// Edges moved outwards by the amount that rounding may take from them. Two triangles that share an edge cover each
// sample beside it at complementary times, bit for bit, so no gap shows between them. At a vertex, however, several
// edges meet, and each is rounded independently: a sample on the vertex or beside it may be outside of all triangles of
// a fan. Widened edges overlap by the same small amount, which lists tolerate.
//
//     margin = edge_equation_error(setup.a, h_x, h_y);
//     wide = edge_equation_widen(setup.a, margin, facing);   once for a tile of samples
//     edge = edge_equation_at(wide, s_x, s_y);               for moving_edge_inside
#ifndef GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H
#define GNOMON_MOTION_TRIANGLE_EDGE_WIDENING_H

const float gnomon_edge_field_margin = 0.0000019073486328125; // 2^-19, 32 2^-p in float

/// Largest absolute value of the plane within h_x and h_y of the origin.
float gnomon_sample_plane_size(gnomon_sample_plane p, float h_x, float h_y)
{
    return (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y) + gnomon_abs(p.c);
}

/// Largest absolute value of the edge function's coefficients within h_x and h_y of the origin.
float gnomon_edge_equation_size(gnomon_edge_equation f, float h_x, float h_y)
{
    float outer = gnomon_max(gnomon_sample_plane_size(f.e0, h_x, h_y), gnomon_sample_plane_size(f.e2, h_x, h_y));
    return gnomon_max(outer, gnomon_sample_plane_size(f.e1, h_x, h_y));
}

/// Upper bound of the rounding of an edge function at the samples within h_x and h_y of the origin. It covers planes
/// that were exact before they were rounded to float, their coefficients at the sample, and the times of
/// moving_edge_inside, all in float. These take 1 + 4 + 16 units of 2^-24 of the largest coefficient; the bound is 32.
float edge_equation_error(gnomon_edge_equation f, float h_x, float h_y)
{
    return gnomon_edge_field_margin * gnomon_edge_equation_size(f, h_x, h_y);
}

/// Upper bound of the rounding of an edge function for linear_edge_inside. Its times take 2 units instead of 16, and
/// the bound is 8. The distance between the edge function and the linear one, a quarter of e0 - 2 e1 + e2, is added.
float linear_edge_error(gnomon_edge_equation f, float h_x, float h_y)
{
    gnomon_sample_plane bend;
    bend.x = f.e0.x - 2.0 * f.e1.x + f.e2.x;
    bend.y = f.e0.y - 2.0 * f.e1.y + f.e2.y;
    bend.c = f.e0.c - 2.0 * f.e1.c + f.e2.c;
    return 0.25 * (edge_equation_error(f, h_x, h_y) + gnomon_sample_plane_size(bend, h_x, h_y));
}

/// The edge moved outwards by a margin. With its error as margin, the edge is inside at all times at which the exact
/// one is. Triangles around a common vertex then leave no crack, although each edge is rounded independently, but
/// overlap by as little.
gnomon_edge_equation edge_equation_widen(gnomon_edge_equation f, float margin, float facing)
{
    float by = facing * margin;
    f.e0.c = f.e0.c + by;
    f.e1.c = f.e1.c + by;
    f.e2.c = f.e2.c + by;
    return f;
}

#endif

// motion/triangle/triangle_motion.h -----------------------------------------------------------------------------------
// Motion of the point of a moving triangle that a sample sees: the motion vector of a stochastic shadow map.
//
// The point is fixed on the triangle: the mean of the vertices, each weighted by the edge function opposite to it, with
// the weights of the sample's time (moving_triangle.h). Its places at shutter open and at shutter close are the means
// of the vertices there, by the same weights. Edge functions are homogeneous, so this holds in perspective as well, and
// for a light that moves. The motion is the chord from the one place to the other. In perspective the point need not
// move along that chord at constant speed.
#ifndef GNOMON_MOTION_TRIANGLE_TRIANGLE_MOTION_H
#define GNOMON_MOTION_TRIANGLE_TRIANGLE_MOTION_H

/// Motion from shutter open to shutter close, in the units of x / w and in depth.
struct triangle_motion { float d_x, d_y, d_z; };

/// A point in clip space, times the sum of the weights of the vertices that it is a mean of.
struct gnomon_weighted_point { float x, y, z, w; };

const float triangle_motion_limit = 65536.0; // no map is larger

/// The point with these weights at shutter open.
gnomon_weighted_point gnomon_moving_triangle_open(moving_triangle m, gnomon_corner_weights v)
{
    gnomon_weighted_point p;
    p.x = (v.a * m.a.x0 + v.b * m.b.x0) + v.c * m.c.x0;
    p.y = (v.a * m.a.y0 + v.b * m.b.y0) + v.c * m.c.y0;
    p.z = (v.a * m.a.z0 + v.b * m.b.z0) + v.c * m.c.z0;
    p.w = (v.a * m.a.w0 + v.b * m.b.w0) + v.c * m.c.w0;
    return p;
}

/// The point with these weights at shutter close.
gnomon_weighted_point gnomon_moving_triangle_close(moving_triangle m, gnomon_corner_weights v)
{
    gnomon_weighted_point p;
    p.x = (v.a * m.a.x1 + v.b * m.b.x1) + v.c * m.c.x1;
    p.y = (v.a * m.a.y1 + v.b * m.b.y1) + v.c * m.c.y1;
    p.z = (v.a * m.a.z1 + v.b * m.b.z1) + v.c * m.c.z1;
    p.w = (v.a * m.a.w1 + v.b * m.b.w1) + v.c * m.c.w1;
    return p;
}

/// Motion of the point that the sample sees at time t, from shutter open to shutter close; e from
/// moving_triangle_edges. divided as in moving_depth_at: 1 for depth z / w, 0 for a z that is linear in view distance.
/// Domain: the triangle covers the sample at time t. No motion where the point is behind the light at shutter open or
/// at shutter close, w <= 0, or where it moves by more than 65536.
/// NaN: no motion.
/// Error: at either end of the shutter that of the edge functions times sum_k |x_k - x w_k| / |sum_k e_k w_k|, and 16
/// 2^-p sum_k e_k (|x_k| + |x w_k|) / |sum_k e_k w_k|, with x the place there; y likewise; z with 1 for w unless
/// divided.
/// Source: Andersson 2015, Sec. 4
triangle_motion moving_triangle_motion(moving_triangle m, gnomon_moving_edges e, float t, float divided)
{
    gnomon_corner_weights v = gnomon_corner_weights_at(e, t);
    gnomon_weighted_point p = gnomon_moving_triangle_open(m, v);
    gnomon_weighted_point q = gnomon_moving_triangle_close(m, v);
    bool by_w = 0.0 < divided;
    float sum = (v.a + v.b) + v.c;
    float d_x = q.x / q.w - p.x / p.w;
    float d_y = q.y / q.w - p.y / p.w;
    float d_z = q.z / gnomon_select(by_w, q.w, sum) - p.z / gnomon_select(by_w, p.w, sum);
    float limit = triangle_motion_limit;
    bool known = 0.0 < p.w && 0.0 < q.w && gnomon_abs(d_x) <= limit && gnomon_abs(d_y) <= limit &&
                 gnomon_abs(d_z) <= limit;
    triangle_motion r;
    r.d_x = gnomon_select(known, d_x, 0.0);
    r.d_y = gnomon_select(known, d_y, 0.0);
    r.d_z = gnomon_select(known, d_z, 0.0);
    return r;
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
float height_fog_amount(float first, float last, float decay)
{
    // From the denser of the two ends on, the medium is attenuated as light is.
    float densest = gnomon_select(decay < 0.0, last, first);
    float thinner = decay * densest;
    return polynomial_exp(-1.0 * gnomon_select(thinner == thinner, thinner, 0.0)) *
           attenuated_length(last - first, gnomon_abs(decay));
}

/// The weight of a texel that a ray crosses between two distances from the eye: the light scattered there and
/// transmitted to the eye, as the length over which a medium of the density at the eye would scatter as much without
/// extinction. In [0, amount] up to the error. extinction is that at the eye.
/// Domain: as for height_fog_amount; extinction at least 0.
/// NaN: 0 for a distance of NaN; a decay or an extinction of NaN counts as 0.
/// Error: relative, (1 + optical depth) (16 + 4 decay last) 2^-p, by the magnitude of decay.
float height_fog_weight(float first, float last, float decay, float extinction)
{
    float before = transmittance_over(extinction * height_fog_amount(0.0, first, decay));
    return before * attenuated_length(height_fog_amount(first, last, decay), extinction);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length, as transmittance_weight_between in a homogeneous medium. In [0, 1].
/// Domain: before and length at least 0; f in [0, 1], clamped; decay and extinction as for height_fog_weight.
/// NaN: 0, also where before and f are 0, or extinction is infinite.
/// Error: (64 + 16 (1 + optical depth) decay (before + length)) 2^-p, by the magnitude of decay.
float height_fog_weight_between(float before, float length_, float f, float decay, float extinction)
{
    float none = 0.0;
    float part = saturate_or_zero(f) * length_;
    float falls = decay * before;
    float density = polynomial_exp(-1.0 * gnomon_select(falls == falls, falls, none));
    float above = attenuated_length(density * height_fog_amount(none, part, decay), extinction) *
                  attenuated_length(height_fog_amount(none, before + length_, decay), extinction);
    float below = attenuated_length(height_fog_amount(none, before + part, decay), extinction) *
                  attenuated_length(density * height_fog_amount(none, length_, decay), extinction);
    return saturate_or_zero(above / below);
}

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

const float gnomon_rectified_guard = 0.55; // half of a range with a guard band of 10%
const float rectified_pi = 3.1415926535897932;
const float rectified_two_pi = 6.2831853071795865;

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
rectified_position rectified_from_position(float x, float y, float z)
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
float rectified_cosine(float x, float y, float z)
{
    float distance_ = gnomon_sqrt((x * x + y * y) + z * z);
    bool at_eye = distance_ == 0.0;
    float cosine = z / gnomon_select(at_eye, 1.0, distance_);
    return clamp_or_nan(gnomon_select(at_eye, 1.0, cosine), -1.0, 1.0);
}

/// The range whose depths are in [-1 / 1.1, 1 / 1.1] from least to most, or in a part of that if most - least is below
/// narrowest.
rectified_range gnomon_rectified_range_over(float least, float most, float narrowest)
{
    rectified_range r;
    r.middle = 0.5 * (least + most);
    r.scale = 1.0 / (gnomon_rectified_guard * gnomon_max(most - least, narrowest));
    return r;
}

/// The range of depth for polar angles of view rays in [least, most].
/// Domain: least <= most, in [0, pi]. A range narrower than 2^-10, or reversed, is widened to 2^-10 around its middle.
/// NaN: a middle of NaN.
/// Source: Peters 2017, Sec. 5.1.1
rectified_range rectified_polar_range(float least, float most)
{
    return gnomon_rectified_range_over(least, most, 0.0009765625);
}

/// The range of depth for cosines of polar angles of view rays in [least, most], which are those of the greatest and of
/// the least angle.
/// Domain: least <= most, in [-1, 1]. A range narrower than 2^-16, or reversed, is widened to 2^-16 around its middle.
/// NaN: a middle of NaN.
rectified_range rectified_cosine_range(float least, float most)
{
    return gnomon_rectified_range_over(least, most, 0.0000152587890625);
}

/// Signed depth of a polar angle, in [-1, 1]: falls with the angle, -1 on the side of rays that look into the light.
/// Domain: polar in [0, pi], a range by rectified_polar_range.
/// NaN: NaN, which encoders store as the far plane.
/// Source: Peters 2017, Sec. 5.1.1
float rectified_polar_depth(float polar, rectified_range range)
{
    return clamp_or_nan((range.middle - polar) * range.scale, -1.0, 1.0);
}

/// Signed depth of the cosine of a polar angle, in [-1, 1]: grows with the cosine, -1 on the side of rays that look
/// into the light.
/// Domain: cosine in [-1, 1], a range by rectified_cosine_range.
/// NaN: NaN, which encoders store as the far plane.
float rectified_cosine_depth(float cosine, rectified_range range)
{
    return clamp_or_nan((cosine - range.middle) * range.scale, -1.0, 1.0);
}

/// An angle within three half turns of 0, moved by a full turn to at most half a turn from 0.
float gnomon_rectified_wrapped(float angle)
{
    float turn = rectified_two_pi;
    float half_turn = rectified_pi;
    float up = gnomon_select(angle + half_turn < 0.0, angle + turn, angle);
    return gnomon_select(half_turn < up, up - turn, up);
}

/// The position across the rows of a map, in [0, rows], of an azimuth; the centre of the first row is at 0.5. The map
/// begins at the azimuth start and spans the angle span; an azimuth outside is moved to the nearer end.
/// Domain: azimuth and start in [-pi, pi], span in [2^-20, 2 pi]; elsewhere a number in [0, rows].
/// NaN: NaN for an azimuth of NaN.
float rectified_row_of(float azimuth, float start, float span, float rows)
{
    float whole = gnomon_max(span, 0.00000095367431640625);
    float from_middle = gnomon_rectified_wrapped((azimuth - start) - 0.5 * whole);
    return clamp_or_nan((from_middle / whole + 0.5) * rows, 0.0, rows);
}

/// The position along a row of prefix averages, at least 0, of a ray that ends at radius; the centre of the first texel
/// is at 0.5. The average up to the far side of texel u, radius (u + 1) radius_step, stands at its centre, u + 1/2: so
/// the position is half a texel before that of the light ray itself.
/// Domain: radius at least 0, radius_step above 0.
/// NaN: NaN.
float rectified_column_of(float radius, float radius_step) { return gnomon_max(0.0, radius / radius_step - 0.5); }

/// The greater extent of a texel of the rectified map at radius, in texels of the shadow map: along the row
/// radius_step, across it radius times azimuth_step, the angle between rows.
/// Domain: at least 0 each.
/// NaN: NaN.
float rectified_footprint(float radius, float radius_step, float azimuth_step, float texels_per_length)
{
    return gnomon_max(radius_step, radius * azimuth_step) * texels_per_length;
}

/// The mip level, in [0, 16], whose texels are as wide as a footprint in texels of level 0.
/// Domain: any footprint.
/// NaN: 0.
/// Error: 2 2^-p of the largest level.
float rectified_level(float footprint)
{
    float wide = clamp_or_nan(footprint, 1.0, 65536.0);
    return clamp_or_high(polynomial_log(gnomon_max(wide, 1.0)) * gnomon_exp_log2_e, 0.0, 16.0);
}

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
struct gnomon_rectified_part { float begin, end; };

float gnomon_rectified_dot(rectified_corner a, rectified_corner b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// b - a.
rectified_corner gnomon_rectified_from_to(rectified_corner a, rectified_corner b)
{
    rectified_corner r;
    r.x = b.x - a.x;
    r.y = b.y - a.y;
    r.z = b.z - a.z;
    return r;
}

/// The z of the cross product of a and b: positive where the azimuth of b is up to half a turn beyond that of a.
float gnomon_rectified_turn(rectified_corner a, rectified_corner b) { return a.x * b.y - a.y * b.x; }

/// 1 if the light direction is strictly within the far plane as seen from the eye, -1 if its opposite is, else 0.
float gnomon_rectified_axis_side(rectified_corners q)
{
    float ab = gnomon_rectified_turn(q.a, q.b);
    float bc = gnomon_rectified_turn(q.b, q.c);
    float cd = gnomon_rectified_turn(q.c, q.d);
    float da = gnomon_rectified_turn(q.d, q.a);
    bool left = 0.0 < ab && 0.0 < bc && 0.0 < cd && 0.0 < da;
    bool right = ab < 0.0 && bc < 0.0 && cd < 0.0 && da < 0.0;
    // The normal of the far plane, by its diagonals, and the side of it on which the plane lies.
    rectified_corner s = gnomon_rectified_from_to(q.a, q.c);
    rectified_corner t = gnomon_rectified_from_to(q.b, q.d);
    float nx = s.y * t.z - s.z * t.y;
    float ny = s.z * t.x - s.x * t.z;
    float side = (nx * q.a.x + ny * q.a.y) + gnomon_rectified_turn(s, t) * q.a.z;
    float sign = gnomon_select(side < 0.0, -1.0, 1.0);
    return gnomon_select(left, sign, gnomon_select(right, -1.0 * sign, 0.0));
}

/// The angles so far and that of the point (x, y, z).
rectified_interval gnomon_rectified_interval_add(rectified_interval bounds, float x, float y, float z)
{
    float polar = polynomial_atan2(gnomon_sqrt(x * x + y * y), z);
    bounds.least = gnomon_min(polar, bounds.least);
    bounds.most = gnomon_max(polar, bounds.most);
    return bounds;
}

/// The angles so far and that of the point a + t c.
rectified_interval gnomon_rectified_interval_along(rectified_interval bounds, rectified_corner a, rectified_corner c,
                                                   float t)
{
    return gnomon_rectified_interval_add(bounds, a.x + t * c.x, a.y + t * c.y, a.z + t * c.z);
}

/// The t of the extreme angle on a + t c, limited to a part; some t of it for an edge towards the eye or without
/// length.
float gnomon_rectified_extreme(rectified_corner a, rectified_corner c, float begin, float end)
{
    float ac = gnomon_rectified_dot(a, c);
    float t = (a.z * ac - c.z * gnomon_rectified_dot(a, a)) / (c.z * ac - a.z * gnomon_rectified_dot(c, c));
    return clamp_or_nan(gnomon_select(t == t, t, begin), begin, end);
}

/// The angles so far and those of the edge from a to b, without b.
rectified_interval gnomon_rectified_interval_edge(rectified_interval bounds, rectified_corner a, rectified_corner b)
{
    rectified_corner c = gnomon_rectified_from_to(a, b);
    rectified_interval r = gnomon_rectified_interval_add(bounds, a.x, a.y, a.z);
    return gnomon_rectified_interval_along(r, a, c, gnomon_rectified_extreme(a, c, 0.0, 1.0));
}

/// The angles so far and those of a part of the edge from a to b; an empty part has none.
rectified_interval gnomon_rectified_interval_part(rectified_interval bounds, rectified_corner a, rectified_corner b,
                                                  gnomon_rectified_part part)
{
    rectified_corner c = gnomon_rectified_from_to(a, b);
    rectified_interval r = gnomon_rectified_interval_along(bounds, a, c, part.begin);
    r = gnomon_rectified_interval_along(r, a, c, part.end);
    r = gnomon_rectified_interval_along(r, a, c, gnomon_rectified_extreme(a, c, part.begin, part.end));
    bool empty = part.end < part.begin;
    r.least = gnomon_select(empty, bounds.least, r.least);
    r.most = gnomon_select(empty, bounds.most, r.most);
    return r;
}

/// The bounds before any edge, where axis is that of gnomon_rectified_axis_side.
rectified_interval gnomon_rectified_interval_begin(float axis)
{
    rectified_interval r;
    r.least = gnomon_select(0.0 < axis, 0.0, rectified_pi);
    r.most = gnomon_select(axis < 0.0, rectified_pi, 0.0);
    return r;
}

/// The interval, or [0, pi] if no angle was added.
rectified_interval gnomon_rectified_interval_end(rectified_interval bounds)
{
    bool none = bounds.most < bounds.least;
    bounds.least = gnomon_select(none, 0.0, bounds.least);
    bounds.most = gnomon_select(none, rectified_pi, bounds.most);
    return bounds;
}

/// The farther from the axis of two corners, the first where they are equal or the second has a NaN.
rectified_corner gnomon_rectified_farther(rectified_corner a, rectified_corner b)
{
    bool second = a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    rectified_corner r;
    r.x = gnomon_select(second, b.x, a.x);
    r.y = gnomon_select(second, b.y, a.y);
    r.z = gnomon_select(second, b.z, a.z);
    return r;
}

/// The azimuth of b relative to that of a, in [-pi, pi]; 0 on the axis.
float gnomon_rectified_azimuth_between(rectified_corner a, rectified_corner b)
{
    return polynomial_atan2(gnomon_rectified_turn(a, b), a.x * b.x + a.y * b.y);
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
rectified_frustum rectified_frustum_from_corners(rectified_corners q)
{
    float axis = gnomon_rectified_axis_side(q);
    rectified_corner farthest = gnomon_rectified_farther(gnomon_rectified_farther(q.a, q.b),
                                                         gnomon_rectified_farther(q.c, q.d));
    float a = gnomon_rectified_azimuth_between(farthest, q.a);
    float b = gnomon_rectified_azimuth_between(farthest, q.b);
    float c = gnomon_rectified_azimuth_between(farthest, q.c);
    float d = gnomon_rectified_azimuth_between(farthest, q.d);
    float least = gnomon_min(a, gnomon_min(b, gnomon_min(c, gnomon_min(d, 0.0))));
    float most = gnomon_max(a, gnomon_max(b, gnomon_max(c, gnomon_max(d, 0.0))));
    bool around = axis < 0.0 || 0.0 < axis || rectified_pi < most - least;

    rectified_interval polar = gnomon_rectified_interval_begin(axis);
    polar = gnomon_rectified_interval_edge(polar, q.a, q.b);
    polar = gnomon_rectified_interval_edge(polar, q.b, q.c);
    polar = gnomon_rectified_interval_edge(polar, q.c, q.d);
    polar = gnomon_rectified_interval_end(gnomon_rectified_interval_edge(polar, q.d, q.a));

    rectified_frustum r;
    r.radius = gnomon_sqrt(farthest.x * farthest.x + farthest.y * farthest.y);
    float start = polynomial_atan2(farthest.y, farthest.x) + least;
    float first = -1.0 * rectified_pi;
    r.azimuth_start = gnomon_select(around, first, clamp_or_nan(gnomon_rectified_wrapped(start), first, rectified_pi));
    r.azimuth_length = gnomon_select(around, rectified_two_pi, most - least);
    r.polar_least = polar.least;
    r.polar_most = polar.most;
    return r;
}

/// The part of the edge from a to b, within a part, that is on the left of the direction (cosine, sine) from the axis.
gnomon_rectified_part gnomon_rectified_part_left(gnomon_rectified_part part, rectified_corner a, rectified_corner b,
                                                 float cosine, float sine)
{
    float at_a = cosine * a.y - sine * a.x;
    float at_b = cosine * b.y - sine * b.x;
    float crossing = at_a / (at_a - at_b);
    part.begin = gnomon_select(at_a < 0.0, gnomon_max(part.begin, crossing), part.begin);
    part.end = gnomon_select(at_b < 0.0, gnomon_min(part.end, crossing), part.end);
    // Both ends are on the right: the part is empty.
    part.end = gnomon_select(at_a < 0.0 && at_b < 0.0, -1.0, part.end);
    return part;
}

/// The angles so far and those of the edge from a to b between two directions; of the whole edge if whole is 1.
rectified_interval gnomon_rectified_row_edge(rectified_interval bounds, rectified_corner a, rectified_corner b,
                                             gnomon_cosine_sine first, gnomon_cosine_sine last, float whole)
{
    gnomon_rectified_part all;
    all.begin = 0.0;
    all.end = 1.0;
    gnomon_rectified_part part = gnomon_rectified_part_left(all, a, b, first.cosine, first.sine);
    part = gnomon_rectified_part_left(part, a, b, -1.0 * last.cosine, -1.0 * last.sine);
    part.begin = gnomon_select(whole == 1.0, 0.0, part.begin);
    part.end = gnomon_select(whole == 1.0, 1.0, part.end);
    return gnomon_rectified_interval_part(bounds, a, b, part);
}

/// The polar angles of the view rays whose azimuths are between first and last, as those of one row; [0, pi] if no ray
/// is there.
/// Domain: as for rectified_frustum_from_corners; first <= last, both within 3 pi of 0. An interval above 3 radians
/// gives the angles of all rays.
/// NaN: as for rectified_frustum_from_corners.
/// Error: for fields of view up to 160 degrees a ray exceeds the bounds by at most 16 2^-p.
rectified_interval rectified_row_polar(rectified_corners q, float first, float last)
{
    gnomon_cosine_sine left = polynomial_cosine_sine(first);
    gnomon_cosine_sine right = polynomial_cosine_sine(last);
    float whole = gnomon_select(3.0 < last - first, 1.0, 0.0);
    rectified_interval polar = gnomon_rectified_interval_begin(gnomon_rectified_axis_side(q));
    polar = gnomon_rectified_row_edge(polar, q.a, q.b, left, right, whole);
    polar = gnomon_rectified_row_edge(polar, q.b, q.c, left, right, whole);
    polar = gnomon_rectified_row_edge(polar, q.c, q.d, left, right, whole);
    return gnomon_rectified_interval_end(gnomon_rectified_row_edge(polar, q.d, q.a, left, right, whole));
}

#endif

// soft/blocker.h ------------------------------------------------------------------------------------------------------
// The mean depth of blockers, the surfaces of a search region that are before the receiver, from moments of the region:
// the blocker search of percentage-closer soft shadows in one look-up (Peters et al. 2017, Sec. 4.3; Yang et al. 2010).
//
// The moments name a canonical distribution with a node at the receiver's depth z_f (hamburger4.h). With A, the sum of
// w (z_f - x) over its nodes x before z_f, and their weight w, the lower bound on the shadow intensity, the result is
//     z_f - A / (epsilon + lower),
// Equation 4 of the paper, in which epsilon makes little of blockers of little weight, and returns z_f where none is.
// A needs no node: since the mean of (x - z_f) over all nodes is -u, with u = z_f - mean, and with the notation of
// hamburger4.h,
//     both nodes before z_f:    A = u
//     one:                      A = (u (b + r) - V a) / (2 r)
//     none:                     A = 0
// so the whole takes one division and one square root. Two moments have the one node mean - V / u beside z_f, and A is
// u where that is before z_f. The result is exact for a region of one or two surfaces, and of three with one at z_f.
#ifndef GNOMON_SOFT_BLOCKER_H
#define GNOMON_SOFT_BLOCKER_H

const float blocker_epsilon = 1e-3;

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
float gnomon_blocker_depth_before(float z_f, float distance_)
{
    return gnomon_max(z_f - gnomon_max(distance_, 0.0), -1.0);
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
float blocker2_depth(float mean, float variance, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    float u = z - mean;
    float whole = variance + u * u;
    float below = u * whole;
    float total = blocker_epsilon * whole + u * u;
    return gnomon_blocker_depth_before(z, below / total);
}

#endif

// soft/blocker.h ------------------------------------------------------------------------------------------------------
#ifndef GNOMON_SOFT_BLOCKER_4
#define GNOMON_SOFT_BLOCKER_4

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
float blocker4_depth(hankel4 h, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    float u = z - h.mean;
    float q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    float s = hamburger4_lower_scale * q;
    float n = hamburger4_lower_scale * h.determinant;
    float un = u * n;
    float a = s * h.variance;
    float b = 0.5 * (un - s * h.third);
    float r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    float e = u * un + q * s;
    float w = h.variance * n;
    float whole = w + e;
    bool between = q < 0.0;
    float rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    float share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    float total = blocker_epsilon * (whole * gnomon_select(between, r + r, 1.0)) + share;
    return gnomon_blocker_depth_before(z, rest / total);
}

#endif

// soft/blocker6.h -----------------------------------------------------------------------------------------------------
// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0
#ifndef GNOMON_SOFT_BLOCKER6_H
#define GNOMON_SOFT_BLOCKER6_H

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
float blocker6_depth(hankel6 h, float z_f)
{
    float z = clamp_or_high(z_f, -1.0, 1.0);
    hamburger6_sums s = gnomon_hamburger6_sums_at(h, z - h.mean);
    return gnomon_blocker_depth_before(z, s.distance / (blocker_epsilon + gnomon_max(s.lower, 0.0)));
}

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

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is
/// 0.
struct gnomon_decided_shadow { float intensity, decided; };

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the
/// receiver towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
gnomon_decided_shadow depth_interval_shadow(float least, float greatest, float z_f, float least_bias, float most_bias)
{
    float z = clamp_or_nan(z_f, -1.0, 1.0);
    bool known = least <= greatest && least_bias <= most_bias;
    bool umbra = known && (greatest < z - gnomon_max(0.0, most_bias));
    bool lit = known && (z - gnomon_max(0.0, least_bias) <= least);
    gnomon_decided_shadow r;
    r.intensity = gnomon_select(umbra, 1.0, 0.0);
    r.decided = gnomon_select(umbra || lit, 1.0, 0.0);
    return r;
}

#endif

// soft/summed_area.h --------------------------------------------------------------------------------------------------
// Summed-area tables of the channels of a shadow map, and look-ups of any rectangle in them (Crow 1984; Peters et al.
// 2017, Sec. 4.2 to 4.4).
//
// Let P(x, y) be the sum of the channels over all texels (i, j) with i < x and j < y. The table holds P(x + 1, y + 1)
// at texel (x, y), in 32-bit unsigned integers that wrap around; P is 0 where x or y is 0. The sum over the texels from
// (x0, y0) to before (x1, y1) is a difference of four such integers, of which none that wraps does harm:
//
//     rectangle = summed_area_clip(summed_area_around(x, y, width_x, width_y), map_width, map_height, most_texels);
//
//     on the grid, 4 texels:       r = summed_area_grow(rectangle);
//                                  s = P(r.x1, r.y1) - P(r.x0, r.y1) - P(r.x1, r.y0) + P(r.x0, r.y0);    in integers
//                                  area = (r.x1 - r.x0) * (r.y1 - r.y0);
//
//     interpolated, 16 texels:     a = summed_area_split(rectangle.x0, rectangle.x1), b = the same of y0 and y1
//                                  s = the sum over both axes of width_i width_j times the sum of rectangle (i, j)
//                                  area = summed_area_width(a) * summed_area_width(b);
//
//     channel = s / (area * scale)                                        storage/moments4_summed.h and its siblings
//
// A code is the nearest whole number to scale times a channel in [0, 1]. most_texels is the most texels that a look-up
// on the grid may cover: (ceil(w_x) + 1) (ceil(w_y) + 1) for the largest rectangle. Positions are in texels, with
// centres at +0.5.
#ifndef GNOMON_SOFT_SUMMED_AREA_H
#define GNOMON_SOFT_SUMMED_AREA_H

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
struct summed_area_rectangle { float x0, y0, x1, y1; };

const float summed_area_range = 4294967296.0;         // 2^32
const float summed_area_most_texels = 1048576.0;      // 2^20
const float summed_area_step = 5.9604644775390625e-8; // 2^-24
const float summed_area_slack = 0.0009765625;         // 2^-10

const float summed_area_code_noise = 1.1641532182693481e-10; // 2^-33
const float summed_area_float_noise = 5.9604644775390625e-8; // 2 times 2^-25
const float summed_area_least_noise = 1.3411045074462891e-7; // 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
float summed_area_noise(float most_texels)
{
    float noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
float summed_area_scale(float most_texels)
{
    float n = clamp_or_high(most_texels, 1.0, summed_area_most_texels);
    float range = summed_area_range;
    float s = range / n;
    float whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0, 0.0);
    gnomon_double_word sum = two_product(whole, n);
    bool wraps = 0.0 <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0, summed_area_step * whole), 0.0);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
float summed_area_code(float channel, float scale)
{
    gnomon_double_word p = two_product(saturate_or_zero(channel), scale);
    float code = nearest_natural(p.high);
    float rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5 < rest, 1.0, 0.0);
    return code - gnomon_select(rest < -0.5, 1.0, 0.0);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
summed_area_rectangle summed_area_around(float x, float y, float width_x, float width_y)
{
    summed_area_rectangle r;
    r.x0 = x - 0.5 * width_x;
    r.y0 = y - 0.5 * width_y;
    r.x1 = x + 0.5 * width_x;
    r.y1 = y + 0.5 * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
float gnomon_summed_area_above(float x) { return -1.0 * texel_below(-1.0 * x); }

/// The begin and the end of a rectangle along one axis.
struct summed_area_interval { float begin, end; };

/// The interval from begin to end.
summed_area_interval gnomon_summed_area_interval_from(float begin, float end)
{
    summed_area_interval r;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
summed_area_interval gnomon_summed_area_shrink(float begin, float end, float texels, float most)
{
    float width = most - 1.0;
    float low = 0.5 * (begin + end) - 0.5 * width;
    bool large = most < texels;
    summed_area_interval r;
    r.begin = gnomon_select(large, low, begin);
    r.end = gnomon_select(large, low + width, end);
    return r;
}

/// The part of a rectangle that a look-up may read: clipped to the map, and if the texels that it touches are more than
/// most_texels, shrunk along both axes about its centre. A rectangle without a part in the map, or with its ends in the
/// wrong order, becomes the empty one, all 0, and look-ups in it are lit.
/// Domain: width and height whole numbers in [1, 65536]; most_texels in [4, 2^20], clamped.
/// NaN: empty.
/// Error: the ends are exact unless the rectangle shrinks.
summed_area_rectangle summed_area_clip(summed_area_rectangle rectangle, float width, float height, float most_texels)
{
    float limit = gnomon_texel_limit;
    float right = clamp_or_high(width, 1.0, limit);
    float bottom = clamp_or_high(height, 1.0, limit);
    float x0 = clamp_or_nan(rectangle.x0, 0.0, right);
    float y0 = clamp_or_nan(rectangle.y0, 0.0, bottom);
    float x1 = clamp_or_nan(rectangle.x1, 0.0, right);
    float y1 = clamp_or_nan(rectangle.y1, 0.0, bottom);
    float columns = gnomon_summed_area_above(x1) - texel_below(x0);
    float rows = gnomon_summed_area_above(y1) - texel_below(y0);
    float most = clamp_or_high(most_texels, 4.0, summed_area_most_texels);
    bool large = most < columns * rows;
    summed_area_interval x = gnomon_summed_area_interval_from(x0, x1);
    summed_area_interval y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        float share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0));
        float least_columns = gnomon_min(columns, 2.0);
        float least_rows = gnomon_min(rows, 2.0);
        float most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                        texel_below(most / least_rows));
        float most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    bool some = x0 < x1 && y0 < y1; // false for NaN
    summed_area_rectangle r;
    r.x0 = gnomon_select(some, x.begin, 0.0);
    r.y0 = gnomon_select(some, y.begin, 0.0);
    r.x1 = gnomon_select(some, x.end, 0.0);
    r.y1 = gnomon_select(some, y.end, 0.0);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
summed_area_rectangle summed_area_grow(summed_area_rectangle rectangle)
{
    summed_area_rectangle r;
    r.x0 = texel_below(rectangle.x0);
    r.y0 = texel_below(rectangle.y0);
    r.x1 = gnomon_summed_area_above(rectangle.x1);
    r.y1 = gnomon_summed_area_above(rectangle.y1);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
struct summed_area_parts { float line0, line1, line2, line3, width0, width1, width2; };

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
summed_area_parts summed_area_split(float begin, float end)
{
    float first = texel_below(begin);
    float last = gnomon_max(gnomon_summed_area_above(end) - 1.0, first);
    bool single = last <= first;
    summed_area_parts r;
    r.line0 = first;
    r.line1 = first + 1.0;
    r.line2 = gnomon_max(last, r.line1);
    r.line3 = last + 1.0;
    r.width0 = saturate_or_zero(gnomon_select(single, end, r.line1) - begin);
    r.width1 = gnomon_select(single, 0.0, 1.0);
    r.width2 = gnomon_select(single, 0.0, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
float summed_area_width(summed_area_parts parts)
{
    return (parts.width0 + parts.width1 * (parts.line2 - parts.line1)) + parts.width2;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
float summed_area_mean(float sum, float area, float scale)
{
    gnomon_double_word whole = two_product(area, scale);
    float mean = saturate_or_zero(sum / whole.high);
    gnomon_double_word p = two_product(mean, whole.high);
    float rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

#endif

// soft/disc.h ---------------------------------------------------------------------------------------------------------
// Round lights and round filters from look-ups of rectangles: a disc, or an ellipse along the axes of the map, as the
// union of three rectangles that touch, in the shape of a cross. Their means, weighted by their areas, make the mean of
// the union; so moments are averaged first, and one intensity is computed.
//
// A straight edge at any angle then has a penumbra that differs from that of the disc by disc_error at most, where a
// single square of the disc's area differs by disc_square_error. Two rectangles crosswise, with twice the loads of
// the square, still differ by 0.0177, so there is no form for them.
#ifndef GNOMON_SOFT_DISC_H
#define GNOMON_SOFT_DISC_H

const float disc_long = 0.955;          // extents of the cross, as shares of the diameter
const float disc_short = 0.5975;        //
const float disc_square = 0.8862269255; // the square of the same area, sqrt(pi) / 2
const float disc_error = 0.0075;
const float disc_square_error = 0.0235;

/// Rectangle 0, 1 or 2 of the disc that the given rectangle bounds: the middle of the cross, and its ends towards y0
/// and towards y1.
/// Domain: any rectangle; of its parts, those at the index as rounded to the nearest of 0, 1 and 2.
/// NaN: NaN, which summed_area_clip makes empty; index 0 for an index of NaN.
/// Error: against a disc (tests/soft/disc.cpp), of the visibility in the penumbra of a straight edge, disc_error.
summed_area_rectangle disc_rectangle(summed_area_rectangle bounds, float index)
{
    float x = 0.5 * (bounds.x0 + bounds.x1);
    float y = 0.5 * (bounds.y0 + bounds.y1);
    float half_x = 0.5 * (bounds.x1 - bounds.x0);
    float half_y = 0.5 * (bounds.y1 - bounds.y0);
    bool first = 0.5 < index && index < 1.5;
    bool second = 1.5 <= index;
    float across = half_x * gnomon_select(first || second, disc_short, disc_long);
    float inner = half_y * disc_short;
    float outer = half_y * disc_long;
    summed_area_rectangle r;
    r.x0 = x - across;
    r.x1 = x + across;
    r.y0 = gnomon_select(first, y - outer, gnomon_select(second, y + inner, y - inner));
    r.y1 = gnomon_select(first, y - inner, gnomon_select(second, y + outer, y + inner));
    return r;
}

#endif

// soft/fusion.h -------------------------------------------------------------------------------------------------------
// Soft shadows of two occluders, one behind the other, of which each has a penumbra of its own. A single mean blocker
// depth gives both the same width, so that the contact of the one is as soft as that of the other (Peters et al. 2017,
// Fig. 10).
//
// The canonical distribution of the search region with a node at z_f (hamburger4.h) has two other nodes. Where both are
// before z_f they are the two occluders, first and second:
//     between  the middle of their depths
//     k1, k2   filter regions of the penumbrae of the first and of the second occluder (penumbra.h)
//     I1       intensity of k1 at between: the share of the light that the first occluder blocks
//     c        intensity of k2 at between: the share of k2 that the first occluder covers
//     I2       intensity of k2 at z_f: the share that either covers
// Of the part of k2 that the first occluder leaves, the second covers (I2 - c) / (1 - c). Both block light
// independently of one another, so the visibility is (1 - I1) (1 - (I2 - c) / (1 - c)). It is 1 - I2 where the
// occluders coincide, and where the first one is missing. Where the first covers all of k2, nothing is known of the
// second, and blocker_epsilon makes little of what bounds leave between I2 and c. The receiver is moved by its bias for
// I2, and between is not deeper than the moved receiver, or the receiver's own plane would be taken for an occluder.
//
// Costs beside those of one occluder: one root for the nodes, a second filter region and two more intensities, only
// where fusion_occluders found two.
#ifndef GNOMON_SOFT_FUSION_H
#define GNOMON_SOFT_FUSION_H

/// The depths of two occluders, first <= second, and the depth between that parts them. A between of -1 says that there
/// is one occluder, the second, or none.
struct gnomon_occluder_pair { float first, second, between; };

/// The depth of an occluder at depth z with a weight, in [-1, z_f].
float gnomon_fusion_depth(float z, float weight, float z_f)
{
    return gnomon_blocker_depth_before(z_f, (z_f - z) * (weight / (weight + blocker_epsilon)));
}

/// The two occluders before z_f in a search region, from the canonical distribution d with depth0 = z_f. Like the mean
/// blocker depth of blocker.h, each is near z_f where its weight is not far above blocker_epsilon. One occluder is the
/// second, and first equals second.
/// NaN: no occluder, both at the depth of the receiver.
gnomon_occluder_pair fusion_occluders(gnomon_distribution3 d)
{
    float z_f = clamp_or_high(d.depth0, -1.0, 1.0);
    float z1 = clamp_or_high(d.depth1, -1.0, z_f);
    float z2 = clamp_or_high(d.depth2, -1.0, z_f);
    bool two = d.depth1 < d.depth2 && d.depth2 < z_f;
    float first = gnomon_fusion_depth(z1, saturate_or_zero(d.weight1), z_f);
    float second = gnomon_fusion_depth(z2, saturate_or_zero(d.weight2), z_f);
    gnomon_occluder_pair r;
    r.second = gnomon_select(two, second, first);
    r.first = gnomon_min(first, r.second);
    r.between = gnomon_select(two, 0.5 * (z1 + z2), -1.0);
    return r;
}

/// Shadow intensity in [0, 1] of two occluders: blocked is I1, covered is c and either is I2 of the first comment of
/// this file. With covered 0 and blocked 0 it is either.
/// Domain: each in [0, 1], clamped.
/// NaN: counts as 0, lit.
float fusion_intensity(float blocked, float covered, float either)
{
    float one = saturate_or_zero(blocked);
    float c = saturate_or_zero(covered);
    float left = (1.0 - c) + blocker_epsilon * c;
    float two = saturate_or_zero((saturate_or_zero(either) - c) / left);
    return saturate_or_zero(one + (1.0 - one) * two);
}

#endif

// soft/mip_filter.h ---------------------------------------------------------------------------------------------------
// Filters of any width from a mip chain, round ones in place of the boxes of summed-area tables: a cubic B-spline over
// the texels of a level, by four bilinear look-ups (Sigg & Hadwiger 2005), mixed between two levels.
//
// The texels of level l are means over boxes of s = 2^l texels of the map, so that the spline at that level has the
// variance (1/3 + 1/12) s^2 along each axis. A box of a width w has w^2 / 12. Levels below and above mix so that both
// variances are equal:
//     w^2 / 12 = 5/12 4^l (1 + 3 f),    level = l + f,    f in [0, 1)
// Weights are not negative and sum to 1, so filtered moments are moments.
#ifndef GNOMON_SOFT_MIP_FILTER_H
#define GNOMON_SOFT_MIP_FILTER_H

const float mip_filter_fifth = 0.2;
const float mip_filter_per_octave = 0.72134752044448170; // 1 / ln 4
const float mip_filter_third = 0.33333333333333333;
const float mip_filter_sixth = 0.16666666666666667;

/// The level of a mip chain whose cubic B-spline has the variance of a box of this width in texels of the map; its
/// fraction is the share of the level above. At least 0, the level for widths up to sqrt 5.
/// Domain: any width, limited to [sqrt 5, 65536].
/// NaN: 0.
float mip_filter_level(float width)
{
    float w = gnomon_max(gnomon_min(gnomon_texel_limit, width), 1.0);
    float squares = gnomon_max(mip_filter_fifth * (w * w), 1.0);
    float whole = texel_below(polynomial_log(squares) * mip_filter_per_octave);
    float power = gnomon_power_of_two(whole);
    float share = (squares / (power * power) - 1.0) * mip_filter_third;
    return whole + saturate_or_zero(share);
}

/// Two bilinear look-ups along one axis that make a cubic B-spline: at the distances first and second from the centre
/// of the texel, the second with a weight and the first with the rest. first is in [-1, 0], second in [1, 2].
struct mip_filter_taps { float first, second, weight; };

/// The look-ups for a place at a share of the way from the centre of its texel to the next.
/// Domain: share in [0, 1], clamped.
/// NaN: as 0.
/// Source: Sigg & Hadwiger 2005
mip_filter_taps mip_filter_taps_at(float share)
{
    float u = saturate_or_zero(share);
    float v = 1.0 - u;
    // Six times the weights of the four texels.
    float w0 = v * v * v;
    float w1 = (3.0 * u - 6.0) * (u * u) + 4.0;
    float w2 = (3.0 * v - 6.0) * (v * v) + 4.0;
    float w3 = u * u * u;
    mip_filter_taps r;
    r.first = w1 / (w0 + w1) - 1.0;
    r.second = w3 / (w2 + w3) + 1.0;
    r.weight = (w2 + w3) * mip_filter_sixth;
    return r;
}

#endif

// soft/penumbra.h -----------------------------------------------------------------------------------------------------
// Percentage-closer soft shadows (Fernando 2005): from the depth of blockers to the width of the filter that makes
// their penumbra, for lights that are rectangles aligned with the map, along one axis of the map at a time.
//
//     widest search:    width = penumbra_directional(z_f, -1, texels_per_depth, cap)           blockers at the near
// plane
//     blockers:         z_b = moments4_summed_blocker(...)                                     of the search rectangle
//     filter:           width = penumbra_directional(z_f, z_b, texels_per_depth, cap)          at least one texel
//     bias:             bias = depth_bias_receiver_plane(gradient, (width_x + 1) / 2, (width_y + 1) / 2, limit)
//     shadow:           over_darken(moments4_summed_intensity(..., z_f - bias), 1 - epsilon)
//
// and the same by penumbra_local. In the umbra, where the intensity of the search rectangle is above 1 - epsilon, the
// filter may be skipped: over_darken makes that 1 as well, so no step is seen. The paper's epsilon is 0.01. The bias is
// that of filters/depth_bias.h: the most that the receiver's plane rises within the half widths of the filter and half
// a texel, as far as the centres of texels lie that a rectangle touches; or, for look-ups of single texels,
// depth_bias_texel_plane.
#ifndef GNOMON_SOFT_PENUMBRA_H
#define GNOMON_SOFT_PENUMBRA_H

/// A width of any size clamped to [1, widest], or 1 if widest is below 1.
/// NaN: 1; a widest of NaN counts as none.
float gnomon_penumbra_width(float width, float widest)
{
    return gnomon_max(gnomon_min(widest, gnomon_max(width, 1.0)), 1.0);
}

/// The width of the penumbra of a directional light per unit of signed depth between blocker and receiver, in texels.
/// tangent is that of half the light's angular size along this axis; depth_range is far - near, and texels_per_length
/// the number of texels per unit of length in the map.
/// Domain: at least 0.
/// NaN: NaN, for which filters are one texel wide.
/// Error: relative, 2 2^-p.
float penumbra_texels_per_depth(float tangent, float depth_range, float texels_per_length)
{
    return tangent * depth_range * texels_per_length;
}

/// Width of the penumbra of a directional light, at least one texel and at most widest: (z_f - z_b) texels_per_depth
/// for a receiver at depth z_f and blockers at z_b.
/// Domain: any depths, clamped to [-1, 1]; texels_per_depth by penumbra_texels_per_depth. Blockers behind the receiver
/// give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 2 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
float penumbra_directional(float z_f, float z_b, float texels_per_depth, float widest)
{
    float receiver = clamp_or_nan(z_f, -1.0, 1.0);
    float blocker = clamp_or_nan(z_b, -1.0, 1.0);
    return gnomon_penumbra_width((receiver - blocker) * texels_per_depth, widest);
}

/// Width of the penumbra of a local light, at least one texel and at most widest: light_texels (1 / d_b - 1 / d_f) for
/// a receiver and blockers at view distances d_f and d_b. light_texels is the size of the light times the number of
/// texels per unit of length at distance 1 from the light, in the map of that axis.
/// Domain: any depths, clamped to [-1, 1]; 0 < near_distance < far_distance. Blockers behind the receiver give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 10 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
float penumbra_local(float z_f, float z_b, float near_distance, float far_distance, float light_texels, float widest)
{
    float receiver = clamp_or_nan(z_f, -1.0, 1.0);
    float blocker = clamp_or_nan(z_b, -1.0, 1.0);
    float half_range = 0.5 * (far_distance - near_distance);
    float d_f = near_distance + half_range * (receiver + 1.0);
    float d_b = near_distance + half_range * (blocker + 1.0);
    return gnomon_penumbra_width(light_texels * ((receiver - blocker) * half_range) / (d_b * d_f), widest);
}

#endif

// storage/moments4.h --------------------------------------------------------------------------------------------------
// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16
//   4 x half          8     theta4 - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
//   4 x float        16     none        moments4_float_encode     moments4_float_intensity     hankel4_from_float
//
// Filters are linear: average channels as they are. X_intensity and hankel4_from_X allow for one rounding: of channels
// that are stored once and filtered without further rounding, as 16-bit texels by a texture unit that returns floats.
// Texels of floats round again there and need X_filtered. X_filtered_intensity and hankel4_from_X_filtered allow for a
// pass along rows and one along columns, of nine taps at most, that store their results in the format again, half
// floats truncated or rounded. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by at most
//   X_intensity         gnomon_stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X      the weight of the constant bias, roundings * delta / r (bias.h), and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/moments/honest_four.cpp). Certificates (certified4.h)
// leak less than a constant bias in every format. Float arithmetic moves the nodes of a certificate, which costs or
// gains a little leaking. Difference of an intensity in float from the intensity in double:
//     error, float, moments4_float_intensity: p99 3e-5, p99.9 1e-4, max 5e-4
//     error, float, moments4_float_filtered_intensity: p99 1e-5, p99.9 5e-5, max 2e-4
//     error, float, moments4_half_intensity: p99 5e-5, p99.9 4e-4, max 2e-2
//     error, float, moments4_half_filtered_intensity: p99 3e-5, p99.9 2e-4, max 2e-3
//     error, float, moments4_unorm16_intensity: p99 6e-4, p99.9 7e-3, max 3e-1
//     error, float, moments4_unorm16_filtered_intensity: p99 3e-4, p99.9 3e-3, max 3e-2
#ifndef GNOMON_STORAGE_MOMENTS4_H
#define GNOMON_STORAGE_MOMENTS4_H

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
channels4 moments4_unorm16_encode(float z) { return theta4(moments4_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The channels c, each with shift added.
channels4 gnomon_channels4_shifted(channels4 c, float shift)
{
    c.c1 = c.c1 + shift;
    c.c2 = c.c2 + shift;
    c.c3 = c.c3 + shift;
    c.c4 = c.c4 + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
float gnomon_half_nearest(float x) { return 0.000244140625 * nearest_integer(4096.0 * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices
/// may truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
channels4 moments4_half_encode(float z)
{
    channels4 c = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    c.c1 = gnomon_half_nearest(c.c1);
    c.c2 = gnomon_half_nearest(c.c2);
    c.c3 = gnomon_half_nearest(c.c3);
    c.c4 = gnomon_half_nearest(c.c4);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels4 moments4_float_encode(float z)
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

const float gnomon_stored4_unorm16_weight = 3.6e-5;
const float gnomon_stored4_unorm16_filtered_weight = 1.1e-4;
const float gnomon_stored4_half_weight = 5.7e-4;
const float gnomon_stored4_half_filtered_weight = 2.85e-3;
const float gnomon_stored4_float_weight = 3e-7;
const float gnomon_stored4_float_filtered_weight = 2e-6;
const float gnomon_stored4_arithmetic_weight = 1e-6;

/// The factored matrix of the channels of theta4, with a constant bias of weight alpha.
hankel4 gnomon_hankel4_from_theta(channels4 c, float alpha)
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, bias4_theta_b2, alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
hankel4 gnomon_hankel4_stored_as_float(channels4 c, float alpha)
{
    return hankel4_constant_bias(moments4_from_channels(c), bias4_raw_b2, bias4_raw_b4, alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
hankel4 hankel4_from_unorm16(channels4 c) { return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_weight); }

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
hankel4 hankel4_from_unorm16_filtered(channels4 c)
{
    return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
hankel4 hankel4_from_half(channels4 c)
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
hankel4 hankel4_from_half_filtered(channels4 c)
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_filtered_weight);
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
hankel4 hankel4_from_float(channels4 c) { return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_weight); }

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
hankel4 hankel4_from_float_filtered(channels4 c)
{
    return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_filtered_weight);
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
const float certified4_unorm16_noise = 8e-6; // half a code, and the error of theta4 in float
const float certified4_unorm16_filtered_noise = 2.4e-5;
const float certified4_unorm16_weight = 3.6e-5;
const float certified4_unorm16_filtered_weight = 9e-5;
const float certified4_half_noise = 1.225e-4;         // 2^-13, and the error of theta4 in float
const float certified4_half_filtered_noise = 6.12e-4; // passes may truncate: 2^-12 each
const float certified4_half_weight = 6e-4;
const float certified4_half_filtered_weight = 2.3e-3;
const float certified4_float_noise = 3.3e-8;                        // 1.1 times 2^-25
const float certified4_float_filtered_noise = 2.384185791015625e-7; // 8 times: sums of nine taps round, too
const float certified4_float_weight = 3e-7;
const float certified4_float_filtered_weight = 1.5e-6;

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise, by nodes with a bias of weight alpha.
float gnomon_moments4_theta_intensity(channels4 c, float noise, float alpha, float z_f)
{
    return certified4_theta_lower(gnomon_hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_unorm16_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_noise, certified4_unorm16_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_unorm16_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                           z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_half_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_noise,
                                           certified4_half_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_half_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_filtered_noise,
                                           certified4_half_filtered_weight, z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes
/// with a bias of weight alpha.
float gnomon_moments4_float_intensity_with_noise(channels4 c, moments4 noise, float alpha, float z_f)
{
    return certified4_constant_bias_lower(gnomon_hankel4_stored_as_float(c, alpha), noise, bias4_raw_b2, bias4_raw_b4,
                                          alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_float_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), certified4_float_noise),
        certified4_float_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_float_filtered_intensity(channels4 c, float z_f)
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), certified4_float_filtered_noise),
        certified4_float_filtered_weight, z_f);
}

#endif

// storage/absorbance4.h -----------------------------------------------------------------------------------------------
// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in
// any order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4 - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add
// up to additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A
// fragment's own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by
// 2^-24 of its value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.
#ifndef GNOMON_STORAGE_ABSORBANCE4_H
#define GNOMON_STORAGE_ABSORBANCE4_H

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
channels5 absorbance4_float_encode(float z, float alpha)
{
    absorbance4 b = absorbance4_of_fragment(z, alpha);
    channels5 c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b0;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
channels5 absorbance4_half_encode(float z, float alpha)
{
    float a = absorbance_of_opacity(alpha);
    channels4 s = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    channels5 c;
    c.c1 = a * s.c1;
    c.c2 = a * s.c2;
    c.c3 = a * s.c3;
    c.c4 = a * s.c4;
    c.c5 = a;
    return c;
}

const float absorbance4_half_additions = 8.0;
const float absorbance4_half_least = 1.220703125e-4; // 2^-13: below, half floats are denormal
const float absorbance4_float_additions = 4.0;
const float absorbance4_float_more = 3.0; // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
float absorbance4_float_transmittance(channels5 c, float additions, float overestimation, float z_f)
{
    absorbance4 b;
    b.b0 = c.c5;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    float n = gnomon_blended_roundings(additions + absorbance4_float_more, absorbance4_float_additions);
    return absorbance4_transmittance(b, bias_weight_of_roundings(gnomon_stored4_float_weight, n), overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
float absorbance4_half_transmittance(channels5 c, float additions, float overestimation, float z_f)
{
    float scale = 1.0 / gnomon_max(absorbance4_half_least, c.c5);
    channels4 s;
    s.c1 = c.c1 * scale;
    s.c2 = c.c2 * scale;
    s.c3 = c.c3 * scale;
    s.c4 = c.c4 * scale;
    float weight = bias_weight_of_roundings(gnomon_stored4_half_weight,
                                            gnomon_blended_roundings(additions, absorbance4_half_additions));
    hankel4 h = gnomon_hankel4_from_theta(gnomon_channels4_shifted(s, 0.5), weight);
    return absorbance_transmittance(c.c5, gnomon_absorbance4_intensity(h, weight, overestimation, z_f));
}

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

/// Eight textures of four channels.
struct channels32 { channels4 t1, t2, t3, t4, t5, t6, t7, t8; };

const float convolution_unorm8_offset = 0.04088048903297681; // 1.92644766 / (pi terms span)
const float convolution_unorm8_darkening = 0.055;
const float gnomon_convolution_unorm8_weight1 = 0.6366197723675814;
const float gnomon_convolution_unorm8_weight2 = 0.2122065907891938;
const float gnomon_convolution_unorm8_weight3 = 0.12732395447351627;
const float gnomon_convolution_unorm8_weight4 = 0.09094568176679733;
const float gnomon_convolution_unorm8_weight5 = 0.0707355302630646;
const float gnomon_convolution_unorm8_weight6 = 0.05787452476068922;
const float gnomon_convolution_unorm8_weight7 = 0.04897075172058318;
const float gnomon_convolution_unorm8_weight8 = 0.04244131815783876;
const float gnomon_convolution_unorm8_weight9 = 0.03744822190397538;
const float gnomon_convolution_unorm8_weight10 = 0.033506303808820075;
const float gnomon_convolution_unorm8_weight11 = 0.030315227255599115;
const float gnomon_convolution_unorm8_weight12 = 0.02767912053772093;
const float gnomon_convolution_unorm8_weight13 = 0.025464790894703257;
const float gnomon_convolution_unorm8_weight14 = 0.0235785100876882;
const float gnomon_convolution_unorm8_weight15 = 0.021952405943709702;
const float gnomon_convolution_unorm8_weight16 = 0.020536121689276817;

/// The channels of the term at phase and of the next term.
channels4 gnomon_convolution_unorm8_encode_two(convolution_phase phase)
{
    convolution_phase next = convolution_next(phase);
    channels4 c;
    c.c1 = 0.5 * phase.cosine + 0.5;
    c.c2 = 0.5 * phase.sine + 0.5;
    c.c3 = 0.5 * next.cosine + 0.5;
    c.c4 = 0.5 * next.sine + 0.5;
    return c;
}

/// The phase two terms on.
convolution_phase gnomon_convolution_unorm8_next_two(convolution_phase phase)
{
    return convolution_next(convolution_next(phase));
}

/// The 32 channels of a 32 x 8 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as convolution_next.
/// Source: Annen 2007, Sec. 3
channels32 convolution_unorm8_encode(float z)
{
    convolution_settings settings;
    settings.terms = 16.0;
    settings.damping = 0.0;
    settings.offset = convolution_unorm8_offset;
    settings.span = 0.9375;
    convolution_phase phase = convolution_encode(z, settings);
    channels32 c;
    c.t1 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t2 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t3 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t4 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t5 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t6 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t7 = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t8 = gnomon_convolution_unorm8_encode_two(phase);
    return c;
}

/// The sum after two terms with their channels and weights.
convolution_sum gnomon_convolution_unorm8_add_two(convolution_sum state, channels4 c, float weight, float next_weight)
{
    state = convolution_add(state, 2.0 * c.c1 - 1.0, 2.0 * c.c2 - 1.0, weight);
    return convolution_add(state, 2.0 * c.c3 - 1.0, 2.0 * c.c4 - 1.0, next_weight);
}

/// The series at depth z_f, with an offset, from the channels of a 32 x 8 UNORM texel.
float gnomon_convolution_unorm8_series(channels32 c, float z_f, float offset)
{
    convolution_settings settings;
    settings.terms = 16.0;
    settings.damping = 0.0;
    settings.offset = offset;
    settings.span = 0.9375;
    convolution_sum state = convolution_begin(z_f, settings);
    state = gnomon_convolution_unorm8_add_two(state, c.t1, gnomon_convolution_unorm8_weight1,
                                              gnomon_convolution_unorm8_weight2);
    state = gnomon_convolution_unorm8_add_two(state, c.t2, gnomon_convolution_unorm8_weight3,
                                              gnomon_convolution_unorm8_weight4);
    state = gnomon_convolution_unorm8_add_two(state, c.t3, gnomon_convolution_unorm8_weight5,
                                              gnomon_convolution_unorm8_weight6);
    state = gnomon_convolution_unorm8_add_two(state, c.t4, gnomon_convolution_unorm8_weight7,
                                              gnomon_convolution_unorm8_weight8);
    state = gnomon_convolution_unorm8_add_two(state, c.t5, gnomon_convolution_unorm8_weight9,
                                              gnomon_convolution_unorm8_weight10);
    state = gnomon_convolution_unorm8_add_two(state, c.t6, gnomon_convolution_unorm8_weight11,
                                              gnomon_convolution_unorm8_weight12);
    state = gnomon_convolution_unorm8_add_two(state, c.t7, gnomon_convolution_unorm8_weight13,
                                              gnomon_convolution_unorm8_weight14);
    state = gnomon_convolution_unorm8_add_two(state, c.t8, gnomon_convolution_unorm8_weight15,
                                              gnomon_convolution_unorm8_weight16);
    return convolution_end(state);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 32 x 8 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
float convolution_unorm8_intensity(channels32 c, float z_f)
{
    return gnomon_convolution_unorm8_series(c, z_f, convolution_unorm8_offset);
}

/// Shadow intensity in [0, 1] as convolution_unorm8_intensity, but with the edge of the wave at z_f itself, where the
/// intensity is 1/2: for receivers in air, as of single scattering, which are in no map.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
/// Source: Peters 2017, Sec. 5.5.1
float convolution_unorm8_centred_intensity(channels32 c, float z_f)
{
    return gnomon_convolution_unorm8_series(c, z_f, 0.0);
}

#endif

// storage/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps in a storage format: from a depth to the channel of a texel, and from a filtered channel to a
// shadow, with the exponent of the format.
//
//   format      bytes   channel       write                      read
//   1 x float     4     exp(40 z)     exponential_float_encode   exponential_float_intensity
//
// A lit surface is darkened by rounding alone: 84 roundings of exp(40 z), two of the filter passes and their sums.
#ifndef GNOMON_STORAGE_EXPONENTIAL_H
#define GNOMON_STORAGE_EXPONENTIAL_H

const float exponential_float_exponent = 40.0; // exp(2 c) < 2^127
const float exponential_float_darkening = 6e-6;

/// The channel of a 1 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_encode.
channels1 exponential_float_encode(float z)
{
    exponential_settings settings;
    settings.exponent = exponential_float_exponent;
    exponential_moment b = exponential_encode(z, settings);
    channels1 c;
    c.c1 = b.warped;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channel of a 1 x float texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as exponential_intensity.
float exponential_float_intensity(channels1 c, float z_f)
{
    exponential_settings settings;
    settings.exponent = exponential_float_exponent;
    exponential_moment b;
    b.warped = c.c1;
    return exponential_intensity(b, z_f, settings);
}

#endif

// storage/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered
// channels to a shadow, with the exponents and the minimum variance of the format.
//
//   format      bytes   exponents   write                              read
//   4 x half      8     5.54 5.54   exponential_variance_half_encode    exponential_variance_half_intensity
//   4 x float    16     40   5.54   exponential_variance_float_encode   exponential_variance_float_intensity
//
// The exponents are those of Peters et al. 2017, Figure 4. The channels are the four members of
// exponential_variance_moments, in their order. The minimum variance is 99 e^2, as in storage/variance.h, with e three
// roundings of a depth: a relative rounding of r in a warped value moves the depth by r / c. To 4 x float the rounding
// of the depth, a float too, is added.
#ifndef GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H
#define GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H

const float exponential_variance_half_exponent = 5.54;                         // both; exp(2 c) fills a half
const float exponential_variance_half_minimum_variance = 6.921468870293247e-6; // 99 (3 2^-11 / 5.54)^2
const float exponential_variance_half_darkening = 0.01;
const float exponential_variance_float_positive_exponent = 40.0;
const float exponential_variance_float_negative_exponent = 5.54;
const float exponential_variance_float_minimum_variance = 4.41137400169126e-12; // 99 (3 2^-24 (1 + 1 / 5.54))^2
const float exponential_variance_float_darkening = 0.01;

/// The channels of the filter with the given settings for a depth z.
channels4 gnomon_exponential_variance_to_channels(float z, exponential_variance_settings settings)
{
    exponential_variance_moments b = exponential_variance_encode(z, settings);
    channels4 c;
    c.c1 = b.positive;
    c.c2 = b.positive_square;
    c.c3 = b.negative;
    c.c4 = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
float gnomon_exponential_variance_of_channels(channels4 c, float z_f, exponential_variance_settings settings)
{
    exponential_variance_moments b;
    b.positive = c.c1;
    b.positive_square = c.c2;
    b.negative = c.c3;
    b.negative_square = c.c4;
    return exponential_variance_intensity(b, z_f, settings);
}

/// The four channels of a 4 x half texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
channels4 exponential_variance_half_encode(float z)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
float exponential_variance_half_intensity(channels4 c, float z_f)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
channels4 exponential_variance_float_encode(float z)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
float exponential_variance_float_intensity(channels4 c, float z_f)
{
    exponential_variance_settings settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}

#endif

// storage/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels
// to a shadow. Four layers divide [-1, 1] evenly.
//
//   format          bytes   channels of a layer           write                             read
//   8 x 16 UNORM     16     (1 + mean) / 2, mean square   layered_variance_unorm16_encode  
// layered_variance_unorm16_intensity
//
// Where a surface passes from one layer to the next, mean and mean square are both near 1. Their roundings, three of
// half a code each, then hide a variance of up to 3 (1/2 + 2) / 65535: half a code of the square, twice one code of the
// mean.
#ifndef GNOMON_STORAGE_LAYERED_VARIANCE_H
#define GNOMON_STORAGE_LAYERED_VARIANCE_H

/// Two textures of four channels.
struct channels8 { channels4 t1, t2; };

const float gnomon_layered_variance_unorm16_minimum_variance = 0.00011444266422522316;
const float layered_variance_unorm16_darkening = 2e-5;

/// The settings of the layer around centre: -0.75, -0.25, 0.25 or 0.75.
layered_variance_settings gnomon_layered_variance_unorm16_layer(float centre)
{
    layered_variance_settings settings;
    settings.centre = centre;
    settings.scale = 4.0;
    settings.minimum_variance = gnomon_layered_variance_unorm16_minimum_variance;
    return settings;
}

/// The channels of the two layers around near_centre and far_centre for a depth z.
channels4 gnomon_layered_variance_unorm16_encode_two(float z, float near_centre, float far_centre)
{
    variance_moments first = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(near_centre));
    variance_moments second = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(far_centre));
    channels4 c;
    c.c1 = 0.5 * first.mean + 0.5;
    c.c2 = first.square;
    c.c3 = 0.5 * second.mean + 0.5;
    c.c4 = second.square;
    return c;
}

/// The eight channels of an 8 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels8 layered_variance_unorm16_encode(float z)
{
    channels8 c;
    c.t1 = gnomon_layered_variance_unorm16_encode_two(z, -0.75, -0.25);
    c.t2 = gnomon_layered_variance_unorm16_encode_two(z, 0.25, 0.75);
    return c;
}

/// The state after the layer around centre, whose channels are mean and square.
layered_variance gnomon_layered_variance_unorm16_add(layered_variance state, float mean, float square, float centre)
{
    variance_moments b;
    b.mean = 2.0 * mean - 1.0;
    b.square = square;
    return layered_variance_add(state, b, gnomon_layered_variance_unorm16_layer(centre));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of an 8 x 16 UNORM texel.
/// Domain: any z_f; beyond a plane as on it.
/// NaN: 0, lit.
/// Error: as layered_variance_end, for the given channels.
float layered_variance_unorm16_intensity(channels8 c, float z_f)
{
    layered_variance state = layered_variance_begin(z_f);
    state = gnomon_layered_variance_unorm16_add(state, c.t1.c1, c.t1.c2, -0.75);
    state = gnomon_layered_variance_unorm16_add(state, c.t1.c3, c.t1.c4, -0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2.c1, c.t2.c2, 0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2.c3, c.t2.c4, 0.75);
    return layered_variance_end(state);
}

#endif

// storage/moments4_blended.h ------------------------------------------------------------------------------------------
// Four moments from texels into which translucent fragments were blended (moments/translucency.h): what is allowed for
// grows with the number of roundings that are left.
//
//   format          matrix for both bounds         shadow
//   4 x 16 UNORM    hankel4_from_unorm16_blended   moments4_unorm16_blended_intensity
//   4 x half        hankel4_from_half_blended      moments4_half_blended_intensity
//   4 x float       hankel4_from_float_blended     moments4_float_blended_intensity
//
// roundings is the number of roundings after the first store of a texel: blend_roundings of the least alpha, and one
// for each filter pass that stores its results in the format. 0 is a texel that was stored once. Half floats may be
// truncated by each of them, which counts as two. A blend of floats rounds a product, a sum and 1 - alpha, which is 3.5
// roundings.
//
// Intensities exceed Z(z < z_f) by at most
//   X_blended_intensity         gnomon_stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X_blended      the weight of the constant bias, bias_weight_of_roundings, and that of arithmetic
// Layers that vanish, since they are fainter than half a code, are missing in the shadow, which makes it lighter.
#ifndef GNOMON_STORAGE_MOMENTS4_BLENDED_H
#define GNOMON_STORAGE_MOMENTS4_BLENDED_H

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
hankel4 hankel4_from_unorm16_blended(channels4 c, float roundings)
{
    return gnomon_hankel4_from_theta(
        c, bias_weight_of_roundings(gnomon_stored4_unorm16_weight, gnomon_blended_roundings(roundings, 1.0)));
}

/// The factored matrix of the channels of a 4 x half texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
hankel4 hankel4_from_half_blended(channels4 c, float roundings)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended_half_roundings);
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5),
                                     bias_weight_of_roundings(gnomon_stored4_half_weight, n));
}

/// The factored matrix of the channels of a 4 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
hankel4 hankel4_from_float_blended(channels4 c, float roundings)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended_float_roundings);
    return gnomon_hankel4_stored_as_float(c, bias_weight_of_roundings(gnomon_stored4_float_weight, n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_unorm16_blended_intensity(channels4 c, float roundings, float z_f)
{
    float n = gnomon_blended_roundings(roundings, 1.0);
    return gnomon_moments4_theta_intensity(c, n * certified4_unorm16_noise,
                                           bias_weight_of_roundings(certified4_unorm16_weight, n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_half_blended_intensity(channels4 c, float roundings, float z_f)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended_half_roundings);
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), n * certified4_half_noise,
                                           bias_weight_of_roundings(certified4_half_weight, n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_float_blended_intensity(channels4 c, float roundings, float z_f)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended_float_roundings);
    // Roundings of earlier states of the texel, in which a moment was larger, are no fraction of that moment.
    moments4 noise;
    noise.b1 = n * certified4_float_noise;
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    return gnomon_moments4_float_intensity_with_noise(
        c, noise, bias_weight_of_roundings(certified4_float_weight, n), z_f);
}

#endif

// storage/moments4_summed.h -------------------------------------------------------------------------------------------
// Four moments in a summed-area table (soft/summed_area.h): from a depth to the codes of a texel, and from the mean
// channels of a rectangle to a shadow and to the depth of blockers.
//
//   a texel:        c = moments4_summed_encode(z)               channels of theta4; a resolve averages them
//                   codes = moments4_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments4_summed_channels(sums, area, scale)
//                   z_b = moments4_summed_blocker(c, most_texels, z_f)
//                   shadow = moments4_summed_intensity(c, most_texels, z_f - bias)
//
// Encoding and the inverse of theta4 keep the digits that Real has no room for: without them the noise of channels
// (summed_area_noise) would be twice as large. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by
// at most
//   moments4_summed_intensity   gnomon_stored4_arithmetic_weight: certificates (certified4.h)
//   hankel4_from_summed         moments4_summed_bias_ratio times the noise, and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/soft/honest_summed.cpp).
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_H
#define GNOMON_STORAGE_MOMENTS4_SUMMED_H

const float moments4_summed_bias_ratio = 5.0;
const float moments4_summed_node_ratio = 4.0; // for the nodes of certificates

/// a + b as a double word, for magnitudes in any order.
gnomon_double_word gnomon_summed_two_sum(float a, float b) { return two_difference(a, -1.0 * b); }

const float gnomon_summed_four_ninths = 0.44444444444444442;
const float gnomon_summed_third = 0.33333333333333331;

/// The digits of a root for which float has no room: root - factor, where factor is the rounded root and root^2 =
/// square.
float gnomon_summed_root_rest(float factor, float square)
{
    gnomon_double_word p = two_product(factor, factor);
    return ((square - p.high) - p.low) * (0.5 / factor);
}

/// The four channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of a channel, 0.51 2^-p.
/// Source: Peters 2017, Eq. 3
channels4 moments4_summed_encode(float z)
{
    float x = clamp_or_high(z, -1.0, 1.0);
    gnomon_double_word z2 = two_product(x, x);
    gnomon_double_word z3 = two_product(z2.high, x);
    z3.low = z3.low + z2.low * x;
    gnomon_double_word z4 = two_product(z2.high, z2.high);
    z4.low = z4.low + 2.0 * (z2.high * z2.low);
    channels4 c;
    // 1/2 + 3/2 z - 2 z^3
    gnomon_double_word s = two_difference(0.5, 2.0 * z3.high);
    gnomon_double_word t = gnomon_summed_two_sum(s.high, x);
    gnomon_double_word u = gnomon_summed_two_sum(t.high, 0.5 * x);
    c.c1 = u.high + (u.low + (t.low + (s.low - 2.0 * z3.low)));
    // 4 (z^2 - z^4)
    gnomon_double_word d = two_difference(z2.high, z4.high);
    c.c2 = 4.0 * (d.high + (d.low + (z2.low - z4.low)));
    // 1/2 + sqrt(3)/2 (z - 4/9 z^3)
    float ninths = gnomon_summed_four_ninths;
    gnomon_double_word n = two_product(ninths, 9.0);
    gnomon_double_word q = two_product(z3.high, ninths);
    gnomon_double_word w = two_difference(x, q.high);
    float rest = w.low - (q.low + (z3.low * ninths + z3.high * (((4.0 - n.high) - n.low) * (0.25 * ninths))));
    float root = gnomon_theta4_31;
    gnomon_double_word p = two_product(root, w.high);
    gnomon_double_word h = gnomon_summed_two_sum(0.5, p.high);
    c.c3 = h.high + (h.low + (p.low + (root * rest + gnomon_summed_root_rest(root, 0.75) * w.high)));
    // (z^2 + z^4) / 2
    gnomon_double_word m = gnomon_summed_two_sum(z2.high, z4.high);
    c.c4 = 0.5 * (m.high + (m.low + (z2.low + z4.low)));
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
channels4 moments4_summed_codes(channels4 c, float scale)
{
    float any = (clamp_or_nan(c.c1, 0.0, 1.0) + clamp_or_nan(c.c2, 0.0, 1.0)) +
                (clamp_or_nan(c.c3, 0.0, 1.0) + clamp_or_nan(c.c4, 0.0, 1.0));
    bool known = any == any;
    channels4 border = moments4_summed_encode(1.0);
    channels4 r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
channels4 moments4_summed_channels(channels4 sums, float area, float scale)
{
    bool some = 0.0 < area;
    channels4 border = moments4_summed_encode(1.0);
    channels4 r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), border.c1);
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), border.c2);
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), border.c3);
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), border.c4);
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha. What rounding would take
/// from the moments is added to their covariances.
hankel4 gnomon_hankel4_from_summed_theta(channels4 c, float bias2, float bias4, float alpha)
{
    gnomon_double_word c1 = two_difference(c.c1, 0.5);
    gnomon_double_word c3 = two_difference(c.c3, 0.5);
    float root = gnomon_theta4_inverse13;
    float third = gnomon_summed_third;
    // t = sqrt(3) (c3 - 1/2),    b1 = t - (c1 - 1/2) / 3,    b3 = 3/4 (t - (c1 - 1/2))
    gnomon_double_word t = two_product(root, c3.high);
    t.low = t.low + (root * c3.low + gnomon_summed_root_rest(root, 3.0) * c3.high);
    gnomon_double_word n = two_product(third, 3.0);
    gnomon_double_word q = two_product(third, c1.high);
    q.low = q.low + (third * c1.low + (third * ((1.0 - n.high) - n.low)) * c1.high);
    gnomon_double_word d1 = two_difference(t.high, q.high);
    gnomon_double_word d3 = two_difference(t.high, c1.high);
    gnomon_double_word p3 = two_product(0.75, d3.high);
    float eighth = 0.125 * c.c2;
    gnomon_double_word d2 = gnomon_summed_two_sum(c.c4, eighth);
    gnomon_double_word d4 = two_difference(c.c4, eighth);
    moments4 b;
    b.b1 = d1.high;
    b.b2 = d2.high;
    b.b3 = p3.high;
    b.b4 = d4.high;
    moments4 e;
    e.b1 = (d1.low + (t.low - q.low)) - alpha * b.b1;
    e.b2 = d2.low + alpha * (bias2 - b.b2);
    e.b3 = (p3.low + 0.75 * (d3.low + (t.low - c1.low))) - alpha * b.b3;
    e.b4 = d4.low + alpha * (bias4 - b.b4);
    return gnomon_hankel4_with_change(b, e);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
hankel4 hankel4_from_summed(channels4 c, float most_texels)
{
    float weight = moments4_summed_bias_ratio * summed_area_noise(most_texels);
    return gnomon_hankel4_from_summed_theta(c, bias4_theta_b2, bias4_theta_b4, gnomon_min(weight, 0.5));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
float moments4_summed_intensity(channels4 c, float most_texels, float z_f)
{
    float noise = summed_area_noise(most_texels);
    float weight = gnomon_min(moments4_summed_node_ratio * noise, 0.5);
    hankel4 h = gnomon_hankel4_from_summed_theta(c, bias4_theta_b2, bias4_theta_b4, weight);
    return certified4_theta_constant_bias_lower(h, noise, bias4_theta_b2, bias4_theta_b4, weight, z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
float moments4_summed_blocker(channels4 c, float most_texels, float z_f)
{
    return blocker4_depth(hankel4_from_summed(c, most_texels), z_f);
}

#endif

// storage/moments4_summed_within.h ------------------------------------------------------------------------------------
// Four moments in a summed-area table (moments4_summed.h), where the sharp bound for depths in [-1, 1] (hausdorff4.h)
// takes the place of that for any depths. Intensities exceed Z(z < z_f) by at most moments4_summed_within_weight.
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_WITHIN_H
#define GNOMON_STORAGE_MOMENTS4_SUMMED_WITHIN_H

const float moments4_summed_within_bias_ratio = 6.2; // 1 / r
const float moments4_summed_within_float_weight = 1e-6;

/// The weight of the bias of hankel4_from_summed_within: what the errors of the channels make necessary, and what float
/// arithmetic rounds in the bound.
/// Domain: most_texels at least 0.
float moments4_summed_within_weight(float most_texels)
{
    return moments4_summed_within_bias_ratio * summed_area_noise(most_texels) + moments4_summed_within_float_weight;
}

/// The factored matrix of the channels of a rectangle, with a bias for depths in [-1, 1].
hankel4 hankel4_from_summed_within(channels4 c, float most_texels)
{
    return gnomon_hankel4_from_summed_theta(c, bias4_theta_within_b2, bias4_theta_within_b4,
                                            gnomon_min(moments4_summed_within_weight(most_texels), 0.5));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments4_summed_intensity_within(channels4 c, float most_texels, float z_f)
{
    return hausdorff4_lower(hankel4_from_summed_within(c, most_texels), z_f);
}

#endif

// storage/moments4_within.h -------------------------------------------------------------------------------------------
// Certified shadow intensity (certified4.h) where the depths of a filter region are known to lie in [least, greatest]:
// from a min-max map beside the moments, with its mip levels. [-1, 1] always holds.
//
// p then has to be at most 1 in [least, z_f) and at most 0 in [z_f, greatest] only. Where a node of the biased moments
// lies outside, the canonical distribution on the interval (the Markov moment problem; Krein & Nudelman 1977) has nodes
// least, greatest, z_f and
//     x = E[(z - least) (greatest - z) (z - z_f) z] / E[(z - least) (greatest - z) (z - z_f)],
// and p is 1 at least and at x < z_f, 0 at z_f, at x > z_f and at greatest; double at x:
//     x > z_f:  p = (z - z_f) (z - x)^2 (z - greatest) / ((least - z_f) (least - x)^2 (least - greatest))
//     x < z_f:  p = 1 - (z - least) (z - x)^2 (k0 + k1 z),  k0 and k1 by p(z_f) = p(greatest) = 0
// Every x gives an honest p, so float arithmetic suffices. The greater of the two certified means is the result: both
// are honest.
#ifndef GNOMON_STORAGE_MOMENTS4_WITHIN_H
#define GNOMON_STORAGE_MOMENTS4_WITHIN_H

const float gnomon_certified4_gap = 9.5367431640625e-7; // 2^-20, the least that the receiver is before greatest

/// The certificate on [least, greatest] for a receiver z_f inside, from moments b with a bias.
gnomon_certificate4 gnomon_certificate4_within(moments4 b, float least, float greatest, float z_f)
{
    greatest = gnomon_max(greatest, z_f + gnomon_certified4_gap);
    float sum = least + greatest;
    float product = least * greatest;
    float e0 = (sum * b.b1 - b.b2) - product;
    float e1 = (sum * b.b2 - b.b3) - product * b.b1;
    float e2 = (sum * b.b3 - b.b4) - product * b.b2;
    float x = (e2 - z_f * e1) / (e1 - z_f * e0);
    x = gnomon_select(x < greatest, x, greatest);
    x = gnomon_select(least < x, x, least);
    bool behind = z_f < x;
    // The line k0 + k1 z: through z_f and greatest, or the multiple of z - z_f that is 1 at least.
    float to_least = least - x;
    float to_z_f = z_f - x;
    float to_greatest = greatest - x;
    float at_least = 1.0 / (to_least * to_least);
    float at_z_f = 1.0 / ((z_f - least) * (to_z_f * to_z_f));
    float at_greatest = 1.0 / ((greatest - least) * (to_greatest * to_greatest));
    float slope = gnomon_select(behind, at_least / ((z_f - least) * (least - greatest)), (at_greatest - at_z_f) /
                                (greatest - z_f));
    float offset = gnomon_select(behind, 0.0, at_z_f) - slope * z_f;
    // s = (z - other) (z - x)^2 (offset + slope z)
    float minus_other = -1.0 * gnomon_select(behind, greatest, least);
    float m0 = minus_other * offset;
    float m1 = offset + minus_other * slope;
    float n0 = x * x;
    float n1 = -2.0 * x;
    gnomon_certificate4 p;
    p.top = gnomon_select(behind, 0.0, 1.0);
    p.s0 = m0 * n0;
    p.s1 = m0 * n1 + m1 * n0;
    p.s2 = m0 + (m1 * n1 + slope * n0);
    p.s3 = m1 + slope * n1;
    p.s4 = slope;
    return p;
}

/// The greater of two certified means as an intensity in [0, 1]: 1 where every depth is before z_f, 0 where none is,
/// and where the ends are not in order.
/// NaN: 0, lit.
float gnomon_certified4_from_means(float mean, float within, float least, float greatest, float z_f)
{
    float intensity = saturate_or_zero(gnomon_max(within, mean));
    intensity = gnomon_select(greatest < z_f, 1.0, intensity);
    return gnomon_select(least < z_f && least <= greatest, intensity, 0.0);
}

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise.
float gnomon_certified4_theta_within(channels4 c, float noise, float alpha, float least, float greatest, float z_f)
{
    float z = clamp_or_nan(z_f, -1.0, 1.0);
    moments4 b = theta4_inverse_add_bias(c, bias4_theta_b2, alpha);
    float mean = gnomon_certificate4_theta_mean(gnomon_certificate4_make(hankel4_from_moments(b), z), c, noise);
    float within = gnomon_certificate4_theta_mean(gnomon_certificate4_within(b, least, greatest, z), c, noise);
    return gnomon_certified4_from_means(mean, within, least, greatest, z);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel and the least and greatest depth
/// of the region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
float moments4_unorm16_intensity_within(channels4 c, float least, float greatest, float z_f)
{
    return gnomon_certified4_theta_within(c, certified4_unorm16_noise, certified4_unorm16_weight, least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes;
/// least and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
float moments4_unorm16_filtered_intensity_within(channels4 c, float least, float greatest, float z_f)
{
    return gnomon_certified4_theta_within(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                          least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel and the least and greatest depth of
/// the region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
float moments4_half_intensity_within(channels4 c, float least, float greatest, float z_f)
{
    return gnomon_certified4_theta_within(gnomon_channels4_shifted(c, 0.5), certified4_half_noise,
                                          certified4_half_weight, least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes; least
/// and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
float moments4_half_filtered_intensity_within(channels4 c, float least, float greatest, float z_f)
{
    return gnomon_certified4_theta_within(gnomon_channels4_shifted(c, 0.5), certified4_half_filtered_noise,
                                          certified4_half_filtered_weight, least, greatest, z_f);
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

const float gnomon_stored6_unorm10_weight = 4e-3;
const float gnomon_stored6_unorm10_filtered_weight = 1e-2;
const float gnomon_stored6_unorm16_weight = 8e-5;
const float gnomon_stored6_unorm16_filtered_weight = 1.6e-4;
const float gnomon_stored6_float_weight = 5e-6;
const float gnomon_stored6_float_filtered_weight = 2e-5;

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
channels6 moments6_unorm10_encode(float z) { return theta6(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
channels6 moments6_unorm16_encode(float z) { return theta6(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels6 moments6_float_encode(float z)
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

/// The factored matrix of the channels of theta6, with a constant bias of weight alpha.
hankel6 gnomon_hankel6_from_theta(channels6 c, float alpha)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), gnomon_bias6_theta_b2, gnomon_bias6_theta_b4,
                                                  gnomon_bias6_theta_b6, alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
hankel6 hankel6_from_unorm10(channels6 c) { return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_weight); }

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
hankel6 hankel6_from_unorm10_filtered(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_filtered_weight);
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
hankel6 hankel6_from_unorm16(channels6 c) { return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_weight); }

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
hankel6 hankel6_from_unorm16_filtered(channels6 c)
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
hankel6 hankel6_from_float(channels6 c)
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 gnomon_stored6_float_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
hankel6 hankel6_from_float_filtered(channels6 c)
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 gnomon_stored6_float_filtered_weight);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm10_intensity(channels6 c, float z_f) { return hamburger6_lower(hankel6_from_unorm10(c), z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm10_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm16_intensity(channels6 c, float z_f) { return hamburger6_lower(hankel6_from_unorm16(c), z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm16_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_float_intensity(channels6 c, float z_f) { return hamburger6_lower(hankel6_from_float(c), z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_float_filtered_intensity(channels6 c, float z_f)
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
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
hankel6 hankel6_from_unorm10_blended(channels6 c, float roundings)
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm10_weight, gnomon_blended_roundings(roundings, 1.0)));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
hankel6 hankel6_from_unorm16_blended(channels6 c, float roundings)
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm16_weight, gnomon_blended_roundings(roundings, 1.0)));
}

const float gnomon_blended6_float_weights = 1.5;

/// The factored matrix of the channels of a 6 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
hankel6 hankel6_from_float_blended(channels6 c, float roundings)
{
    float n = gnomon_blended_roundings(roundings, gnomon_blended6_float_weights);
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6,
                                 bias_weight_of_roundings(gnomon_stored6_float_weight, n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm10_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_unorm16_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
float moments6_float_blended_intensity(channels6 c, float roundings, float z_f)
{
    return hamburger6_lower(hankel6_from_float_blended(c, roundings), z_f);
}

#endif

// storage/moments6_summed.h -------------------------------------------------------------------------------------------
// Six moments in a summed-area table (soft/summed_area.h): moments4_summed.h for search regions that hold more
// surfaces, in 24 bytes a texel.
//
//   a texel:        c = moments6_summed_encode(z)               channels of theta6; a resolve averages them
//                   codes = moments6_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments6_summed_channels(sums, area, scale)
//                   z_b = moments6_summed_blocker(c, most_texels, z_f)
//                   shadow = moments6_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by half a code, most_texels 2^-33, and by what float arithmetic rounds. Intensities exceed Z(z <
// z_f) by moments6_summed_weight at most.
#ifndef GNOMON_STORAGE_MOMENTS6_SUMMED_H
#define GNOMON_STORAGE_MOMENTS6_SUMMED_H

const float moments6_summed_code_weight = 8e-10; // 2^-33 / r
const float moments6_summed_float_weight = 6e-6;

/// The weight of the constant bias of a table for most_texels, by which intensities may exceed the truth.
/// Domain: most_texels as of the table's scale.
/// NaN: the weight of a small table.
float moments6_summed_weight(float most_texels)
{
    float weight = moments6_summed_code_weight * most_texels + moments6_summed_float_weight;
    return gnomon_min(gnomon_max(weight, moments6_summed_float_weight), 0.5);
}

/// The six channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
channels6 moments6_summed_encode(float z) { return theta6(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
channels6 moments6_summed_codes(channels6 c, float scale)
{
    float any = (clamp_or_nan(c.c1, 0.0, 1.0) + clamp_or_nan(c.c2, 0.0, 1.0)) +
                (clamp_or_nan(c.c3, 0.0, 1.0) + clamp_or_nan(c.c4, 0.0, 1.0)) +
                (clamp_or_nan(c.c5, 0.0, 1.0) + clamp_or_nan(c.c6, 0.0, 1.0));
    bool known = any == any;
    channels6 border = moments6_summed_encode(1.0);
    channels6 r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    r.c5 = summed_area_code(gnomon_select(known, c.c5, border.c5), scale);
    r.c6 = summed_area_code(gnomon_select(known, c.c6, border.c6), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
channels6 moments6_summed_channels(channels6 sums, float area, float scale)
{
    bool some = 0.0 < area;
    channels6 border = moments6_summed_encode(1.0); // off by roundings, also beyond 1
    channels6 r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), saturate_or_zero(border.c1));
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), saturate_or_zero(border.c2));
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), saturate_or_zero(border.c3));
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), saturate_or_zero(border.c4));
    r.c5 = gnomon_select(some, summed_area_mean(sums.c5, area, scale), saturate_or_zero(border.c5));
    r.c6 = gnomon_select(some, summed_area_mean(sums.c6, area, scale), saturate_or_zero(border.c6));
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha.
hankel6 gnomon_hankel6_from_summed_theta(channels6 c, float alpha)
{
    return hankel6_constant_bias(theta6_inverse(c), gnomon_bias6_theta_b2, gnomon_bias6_theta_b4, gnomon_bias6_theta_b6,
                                 alpha);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
hankel6 hankel6_from_summed(channels6 c, float most_texels)
{
    return gnomon_hankel6_from_summed_theta(c, moments6_summed_weight(most_texels));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
float moments6_summed_intensity(channels6 c, float most_texels, float z_f)
{
    return hamburger6_lower(hankel6_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
float moments6_summed_blocker(channels6 c, float most_texels, float z_f)
{
    return blocker6_depth(hankel6_from_summed(c, most_texels), z_f);
}

#endif

// storage/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels to a
// shadow, each with the minimum variance that hides the roundings of its format.
//
//   format          bytes   channels                      write                     read
//   2 x 16 UNORM      4     (1 + mean) / 2, mean square   variance_unorm16_encode   variance_unorm16_intensity
//
// A minimum variance m lets an error e of the mean darken a lit surface by e^2 / (m + e^2) at most (Cantelli). It is
// chosen as 99 e^2, for 1%, where e is three roundings of a depth: when rendered, and by each of two filter passes.
#ifndef GNOMON_STORAGE_VARIANCE_H
#define GNOMON_STORAGE_VARIANCE_H

const float variance_unorm16_minimum_variance = 2.0745843457628005e-7; // 99 (3 / 65535)^2
const float variance_unorm16_darkening = 0.01;

/// The two channels of a 2 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels2 variance_unorm16_encode(float z)
{
    variance_moments b = variance_encode(z);
    channels2 c;
    c.c1 = 0.5 * b.mean + 0.5;
    c.c2 = b.square;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 2 x 16 UNORM texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as variance_intensity, for the given channels.
float variance_unorm16_intensity(channels2 c, float z_f)
{
    variance_moments b;
    b.mean = 2.0 * c.c1 - 1.0;
    b.square = c.c2;
    variance_settings settings;
    settings.minimum_variance = variance_unorm16_minimum_variance;
    return variance_intensity(b, z_f, settings);
}

#endif

// storage/variance_summed.h -------------------------------------------------------------------------------------------
// The mean and the mean square of depths in a summed-area table (soft/summed_area.h; Lauritzen 2007), in 8 bytes a
// texel: what variance soft shadow mapping reads (Yang et al. 2010).
//
//   a texel:        c = variance_summed_encode(z)               (1 + z) / 2 and z^2; a resolve averages them
//                   codes = variance_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = variance_summed_channels(sums, area, scale)
//                   z_b = variance_summed_blocker(c, most_texels, z_f)
//                   shadow = variance_summed_intensity(c, most_texels, z_f - bias)
//
// With channels that are off by noise, the mean is off by 2 noise and the variance by (1 + 4 |mean|) noise at most.
// Cantelli's bound from the largest variance and the least distance never darkens.
#ifndef GNOMON_STORAGE_VARIANCE_SUMMED_H
#define GNOMON_STORAGE_VARIANCE_SUMMED_H

const float variance_summed_darkening = 1e-6;

/// The two channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
channels2 variance_summed_encode(float z)
{
    float x = clamp_or_high(z, -1.0, 1.0);
    channels2 c;
    c.c1 = 0.5 * x + 0.5;
    c.c2 = x * x;
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
channels2 variance_summed_codes(channels2 c, float scale)
{
    float any = clamp_or_nan(c.c1, 0.0, 1.0) + clamp_or_nan(c.c2, 0.0, 1.0);
    bool known = any == any;
    channels2 r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, 1.0), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, 1.0), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
channels2 variance_summed_channels(channels2 sums, float area, float scale)
{
    bool some = 0.0 < area;
    channels2 r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), 1.0);
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), 1.0);
    return r;
}

/// The mean and the largest variance that channels may have which are off by noise.
struct variance_summed_moments { float mean, variance; };

variance_summed_moments gnomon_variance_summed_decode(channels2 c, float noise)
{
    variance_summed_moments r;
    r.mean = (c.c1 - 0.5) * 2.0;
    float doubt = (1.0 + 4.0 * gnomon_abs(r.mean)) * noise;
    r.variance = gnomon_max(subtract_product_rounded(c.c2, r.mean, r.mean), 0.0) + doubt;
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
/// Source: Donnelly & Lauritzen 2006
float variance_summed_intensity(channels2 c, float most_texels, float z_f)
{
    float noise = summed_area_noise(most_texels);
    variance_summed_moments b = gnomon_variance_summed_decode(c, noise);
    float distance_ = (clamp_or_nan(z_f, -1.0, 1.0) - b.mean) - 2.0 * noise;
    float d = gnomon_max(0.0, distance_);
    // 1, or 0 for NaN, without a comparison, which Metal's fast mathematics would lose.
    float known = saturate_or_zero(c.c2 + 1.0);
    return known * saturate_or_zero(d * d / (b.variance + d * d));
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
/// Error: against the kernel in double, for a table of 784 texels,
///     error, float, variance_summed_blocker: p99 1e-6, p99.9 2e-4, max 2e-3
/// Source: Yang 2010
float variance_summed_blocker(channels2 c, float most_texels, float z_f)
{
    variance_summed_moments b = gnomon_variance_summed_decode(c, summed_area_noise(most_texels));
    float depth = blocker2_depth(b.mean, b.variance, z_f);
    return gnomon_select(c.c2 == c.c2, depth, clamp_or_high(z_f, -1.0, 1.0));
}

#endif

#endif
