// Gnomon 0.1.0, height_fog.wgsl: shadow filtering in WGSL, this file alone.
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

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
fn nearest_integer(x: f32) -> f32
{
    let rounder = -12582912.0;
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
fn nearest_natural(x: f32) -> f32
{
    let rounder = 8388608.0;
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

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

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.

const gnomon_exp_log2_e: f32 = 0x1.715476p+0; // 1.4426950408889634
const gnomon_exp_ln2_low: f32 = -0x1.bd0106p-13; // -2.1219444005469058e-4
const gnomon_exp_sqrt_2_: f32 = 0x1.6a09e6p+0; // 1.4142135623730951
const gnomon_exp_sqrt_half: f32 = 0x1.6a09e6p-1; // 0.70710678118654752

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
const gnomon_exp_float_0_: f32 = 0x1.fffffcp-2; // 0.49999993561656014
const gnomon_exp_float_1_: f32 = 0x1.55549p-3; // 0.16666518908321371
const gnomon_exp_float_2_: f32 = 0x1.5558ccp-5; // 0.041668318723256166
const gnomon_exp_float_3_: f32 = 0x1.123ba4p-7; // 0.0083689258101569408
const gnomon_exp_float_4_: f32 = 0x1.6a4f86p-10; // 0.00138210541669496

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
const gnomon_log_float_0_: f32 = 0x1.55557ap-1; // 0.66666776085218282
const gnomon_log_float_1_: f32 = 0x1.995edp-2; // 0.39977574040563962
const gnomon_log_float_2_: f32 = 0x1.31e0dep-2; // 0.29870936689734456

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
fn gnomon_exp_remainder(r: f32) -> f32
{
    let p = gnomon_exp_float_0_ + r *
            (gnomon_exp_float_1_ + r * (gnomon_exp_float_2_ + r * (gnomon_exp_float_3_ + r * gnomon_exp_float_4_)));
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
fn polynomial_exp(given_x: f32) -> f32
{
    var x = given_x;
    let low = -87.0;
    let high = 88.0;
    x = clamp_or_nan(x, low, high);
    let n = nearest_integer(x * gnomon_exp_log2_e);
    let r = gnomon_difference(x, n * 0.693359375) - n * gnomon_exp_ln2_low;
    return (1.0 + (r + r * r * gnomon_exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
struct gnomon_scaled_number { significand: f32, exponent: f32 }

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
fn gnomon_scaled_number_step(s: gnomon_scaled_number, k: f32) -> gnomon_scaled_number
{
    let up = gnomon_power_of_two(k);
    let down = gnomon_power_of_two(-k);
    let large = up <= s.significand;
    let tiny = s.significand <= down;
    var r: gnomon_scaled_number;
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
fn polynomial_log(x: f32) -> f32
{
    var s: gnomon_scaled_number;
    s.exponent = 0.0;
    s.significand = clamp_or_nan(x, gnomon_power_of_two(-126.0), gnomon_power_of_two(127.0));
    s = gnomon_scaled_number_step(s, 64.0);
    s = gnomon_scaled_number_step(s, 32.0);
    s = gnomon_scaled_number_step(s, 16.0);
    s = gnomon_scaled_number_step(s, 8.0);
    s = gnomon_scaled_number_step(s, 4.0);
    s = gnomon_scaled_number_step(s, 2.0);
    s = gnomon_scaled_number_step(s, 1.0);
    let large = gnomon_exp_sqrt_2_ < s.significand;
    let tiny = s.significand < gnomon_exp_sqrt_half;
    let m = gnomon_select(large, s.significand * 0.5, gnomon_select(tiny, s.significand * 2.0, s.significand));
    let n = gnomon_select(large, s.exponent + 1.0, gnomon_select(tiny, s.exponent - 1.0, s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    let f = m - 1.0;
    let y = f / (2.0 + f);
    let z = y * y;
    let p = gnomon_log_float_0_ + z * (gnomon_log_float_1_ + z * gnomon_log_float_2_);
    let square = 0.5 * f * f;
    let rest = y * (square + z * p) + n * gnomon_exp_ln2_low;
    return n * 0.693359375 - ((square - rest) - f);
}

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

const gnomon_phase_isotropic: f32 = 0x1.45f306p-4; // 0.079577471545947668, 1 / (4 pi), for every angle
const gnomon_phase_greatest_asymmetry: f32 = 0.9990234375;

/// The integral of the transmittance along a ray, (1 - e^(-extinction distance)) / extinction, without cancellation:
/// the length of a ray without extinction that scatters as much. In [0, distance].
/// Domain: both at least 0, also infinite; negative numbers count as 0.
/// NaN: as 0.
/// Error: 4.5 ulp.
fn attenuated_length(distance_: f32, extinction: f32) -> f32
{
    let whole = gnomon_max(distance_, 0.0);
    let rate = gnomon_max(extinction, 0.0);
    let depth = gnomon_max(rate * whole, 0.0);
    let thin = depth < 0.34375;
    let r = -1.0 * gnomon_select(thin, depth, 0.0);
    let thick = (1.0 - polynomial_exp(-1.0 * depth)) / gnomon_select(thin, 1.0, rate);
    return gnomon_select(thin, whole * (1.0 + r * gnomon_exp_remainder(r)), thick);
}

/// (1 - e^-x) / x, the mean transmittance along a ray of the optical depth x, in [0, 1]; 1 for 0, without cancellation.
/// Domain: x at least 0, also infinite; negative x counts as 0.
/// NaN: 1.
/// Error: 3.5 ulp.
fn attenuated_mean(x: f32) -> f32 { return saturate_or_zero(attenuated_length(1.0, x)); }

/// e^-x, the transmittance of the optical depth x, in [0, 1].
/// Domain: x at least 0, also infinite; negative x counts as 0. Not below e^-87 in float, e^-708 in double.
/// NaN: 1.
/// Error: 1 ulp in float, 1.2 ulp in double.
fn transmittance_over(x: f32) -> f32 { return saturate_or_zero(polynomial_exp(-1.0 * gnomon_max(x, 0.0))); }

/// The Henyey-Greenstein phase function, per steradian, of the cosine of the scattering angle. asymmetry is its mean
/// cosine: positive for media that scatter forward, 0 for isotropic ones.
/// Domain: cosine in [-1, 1], asymmetry in [-1 + 2^-10, 1 - 2^-10], clamped.
/// NaN: NaN for a cosine of NaN; an asymmetry of NaN counts as 0.
/// Error: relative, 10 2^-p for |asymmetry| <= 1/2.
/// Source: Henyey & Greenstein 1941
fn phase_henyey_greenstein(cosine: f32, asymmetry: f32) -> f32
{
    let c = clamp_or_nan(cosine, -1.0, 1.0);
    let g = gnomon_min(gnomon_max(gnomon_abs(asymmetry), 0.0), gnomon_phase_greatest_asymmetry);
    let off = 1.0 - gnomon_select(asymmetry < 0.0, -1.0 * c, c);
    let rest = 1.0 - g;
    let d = rest * rest + (g + g) * off;
    return gnomon_phase_isotropic * (rest * (1.0 + g)) / (d * gnomon_sqrt(d));
}

/// The overestimation of visibility for the ray of a polar angle with this cosine, (1 + cosine) / 2, for
/// bounds_intensity. 0 for a ray that looks into the light, in front of which no occluder can be in depth: no light
/// leaks. 1 for a ray along the light, behind which none can be: no light is lost.
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
/// Source: Peters 2017, Sec. 5.3.1
fn adaptive_overestimation(cosine: f32) -> f32 { return 1.0 - saturate_or_zero(0.5 - 0.5 * cosine); }

/// The overestimation of visibility that is adaptive_overestimation for rays along the light, and (1 + cosine^5) / 2
/// for rays towards it. That is close to 1/2, which halves the worst error, but for rays that nearly look into the
/// light. Shown visibility exceeds its lower bound by this share of the weight at the ray: within 5 degrees of looking
/// into the light at most 1% leaks for any occluders. Along the light 1/2 errs more: most of the surfaces that are
/// close to the ray in depth are behind it, where the ray ends (tests/scattering/overestimation.cpp).
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
fn plateau_overestimation(cosine: f32) -> f32
{
    let c = clamp_or_high(cosine, -1.0, 1.0);
    let square = c * c;
    return adaptive_overestimation(gnomon_select(c < 0.0, square * square * c, c));
}

/// Radiance that reaches the camera: that of the surface, attenuated, and light scattered into the view ray. intensity
/// is the shadow of the ray, 0 where all of the ray is lit.
/// Domain: distance, extinction, scattering, phase, irradiance and surface at least 0 and finite.
/// NaN: an intensity of NaN counts as 0.
/// Error: relative, 9 2^-p for optical depths up to 1.
/// Source: Peters 2017, Sec. 5.1.1
fn scattering_radiance(surface: f32, intensity: f32, distance_: f32, extinction: f32, scattering: f32, phase: f32,
                       irradiance: f32) -> f32
{
    let depth = extinction * distance_;
    let lit = (scattering * phase * irradiance) * attenuated_length(distance_, extinction);
    return transmittance_over(depth) * surface + lit * (1.0 - saturate_or_zero(intensity));
}

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

/// The amount of medium along a ray between two distances from the eye: the length of a homogeneous medium of the
/// density at the eye that holds as much.
/// At least 0, never NaN.
/// Domain: 0 <= first <= last, any decay; decay times either distance is clamped to [-88, 87] in float, [-709, 708] in
/// double.
/// NaN: 0 for a distance of NaN; a decay of NaN counts as 0.
/// Error: relative, (8 + 2 decay last) 2^-p, by the magnitude of decay.
fn height_fog_amount(first: f32, last: f32, decay: f32) -> f32
{
    // From the denser of the two ends on, the medium is attenuated as light is.
    let densest = gnomon_select(decay < 0.0, last, first);
    let thinner = decay * densest;
    return polynomial_exp(-1.0 * gnomon_select(thinner == thinner, thinner, 0.0)) *
           attenuated_length(last - first, gnomon_abs(decay));
}

/// The weight of a texel that a ray crosses between two distances from the eye: the light scattered there and
/// transmitted to the eye, as the length over which a medium of the density at the eye would scatter as much without
/// extinction. In [0, amount] up to the error. extinction is that at the eye.
/// Domain: as for height_fog_amount; extinction at least 0.
/// NaN: 0 for a distance of NaN; a decay or an extinction of NaN counts as 0.
/// Error: relative, (1 + optical depth) (16 + 4 decay last) 2^-p, by the magnitude of decay.
fn height_fog_weight(first: f32, last: f32, decay: f32, extinction: f32) -> f32
{
    let before = transmittance_over(extinction * height_fog_amount(0.0, first, decay));
    return before * attenuated_length(height_fog_amount(first, last, decay), extinction);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length, as transmittance_weight_between in a homogeneous medium. In [0, 1].
/// Domain: before and length at least 0; f in [0, 1], clamped; decay and extinction as for height_fog_weight.
/// NaN: 0, also where before and f are 0, or extinction is infinite.
/// Error: (64 + 16 (1 + optical depth) decay (before + length)) 2^-p, by the magnitude of decay.
fn height_fog_weight_between(before: f32, length_: f32, f: f32, decay: f32, extinction: f32) -> f32
{
    let none = 0.0;
    let part = saturate_or_zero(f) * length_;
    let falls = decay * before;
    let density = polynomial_exp(-1.0 * gnomon_select(falls == falls, falls, none));
    let above = attenuated_length(density * height_fog_amount(none, part, decay), extinction) *
                attenuated_length(height_fog_amount(none, before + length_, decay), extinction);
    let below = attenuated_length(height_fog_amount(none, before + part, decay), extinction) *
                attenuated_length(density * height_fog_amount(none, length_, decay), extinction);
    return saturate_or_zero(above / below);
}
