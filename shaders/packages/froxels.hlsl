// Gnomon 0.1.0, froxels.hlsl: shadow filtering in HLSL, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_FROXELS_HLSL
#define GNOMON_FROXELS_HLSL

// the language --------------------------------------------------------------------------------------------------------
// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#if defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)
#error "gnomon: froxels.hlsl is HLSL; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: froxels.hlsl and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: froxels.hlsl is not of the same version as a package before it"
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

static const float gnomon_exp_log2_e = 1.4426950408889634;
static const float gnomon_exp_ln2_low = -2.1219444005469058e-4;
static const float gnomon_exp_sqrt_2 = 1.4142135623730951;
static const float gnomon_exp_sqrt_half = 0.70710678118654752;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
static const float gnomon_exp_float_0 = 0.49999993561656014;
static const float gnomon_exp_float_1 = 0.16666518908321371;
static const float gnomon_exp_float_2 = 0.041668318723256166;
static const float gnomon_exp_float_3 = 0.0083689258101569408;
static const float gnomon_exp_float_4 = 0.00138210541669496;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
static const float gnomon_log_float_0 = 0.66666776085218282;
static const float gnomon_log_float_1 = 0.39977574040563962;
static const float gnomon_log_float_2 = 0.29870936689734456;

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

static const float gnomon_phase_isotropic = 0.079577471545947668; // 1 / (4 pi), for every angle
static const float gnomon_phase_greatest_asymmetry = 0.9990234375;

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

#endif
