// Gnomon 0.1.0, transmittance_weights.wgsl: shadow filtering in WGSL, this file alone.
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

/// The transmittance of the medium from one texel of a row to the next, in [0, 1]. extinction is per unit of length;
/// the view ray crosses the texels of radius_step at an angle to the light that has this sine.
/// Domain: at least 0, also infinite; negative numbers count as 0.
/// NaN: 1, also where an extinction of 0 meets a sine of 0.
/// Error: relative, 2.5 2^-p for each unit of the optical depth extinction radius_step / sine, and 2 2^-p.
/// Source: Peters 2017, Sec. 5.1.1
fn transmittance_step(extinction: f32, radius_step: f32, sine: f32) -> f32
{
    return transmittance_over((extinction * radius_step) / sine);
}

/// The share g_u of texel u in its prefix average, from the share g of the texel before and the ratio of their weights,
/// q. In [0, 1].
/// Domain: g and q in [0, 1], clamped.
/// NaN: 0.
/// Error: relative, 3 2^-p beside those of g and q; 256 2^-p after 1024 texels.
fn transmittance_weight_next(g: f32, q: f32) -> f32
{
    let next = saturate_or_zero(q) * saturate_or_zero(g);
    return next / (1.0 + next);
}

/// The share of the way from the average before a texel to the one up to it, for a ray that ends a share f within the
/// texel: v / (1 - g + g v), v = (1 - q^f) / (1 - q), where g is the share of the texel. In [0, 1].
/// Domain: g, q and f in [0, 1], clamped.
/// NaN: as 0 for g and f, as 1 for q.
/// Error: 8 2^-p.
fn transmittance_weight_within(g: f32, q: f32, f: f32) -> f32
{
    let share = saturate_or_zero(f);
    let depth = -1.0 * polynomial_log(gnomon_min(q, 1.0));
    let v = gnomon_min(1.0, share * attenuated_mean(share * depth) / attenuated_mean(depth));
    let last = saturate_or_zero(g);
    let rest = (1.0 - last) + last * v;
    return gnomon_select(0.0 < rest, saturate_or_zero(v / rest), 1.0);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length: exact where light and shadow do not change along the length. Distances are in texels of
/// that optical depth. For one texel this is transmittance_weight_within without the shares of the texels before. In
/// [0, 1].
/// Domain: before, length and optical_depth at least 0, the last also infinite; f in [0, 1], clamped.
/// NaN: 0, also where before and f are 0, or optical_depth is infinite.
/// Error: 24 2^-p.
fn transmittance_weight_between(before: f32, length_: f32, f: f32, optical_depth: f32) -> f32
{
    let part = saturate_or_zero(f) * length_;
    let above = attenuated_length(part, optical_depth) * attenuated_length(before + length_, optical_depth);
    let below = attenuated_length(before + part, optical_depth) * attenuated_length(length_, optical_depth);
    return saturate_or_zero(above / below);
}

/// A sum of weights, and the share in it of the weight that was added last.
struct gnomon_transmittance_share { total: f32, share: f32 }

/// The state after the first texel of a row, whose share is 1.
/// Domain: a weight of at least 0; negative weights count as 0.
/// NaN: a weight of 0.
fn transmittance_share_begin(weight: f32) -> gnomon_transmittance_share
{
    var r: gnomon_transmittance_share;
    r.total = gnomon_max(weight, 0.0);
    r.share = 1.0;
    return r;
}

/// The state after one more texel with a weight. Its share, in [0, 1], is 1 while all weights are 0.
/// Domain: as for transmittance_share_begin. While the sum is not finite the share is 0.
/// NaN: a weight of 0.
/// Error: relative, one rounding for each texel.
fn transmittance_share_add(state: gnomon_transmittance_share, weight: f32) -> gnomon_transmittance_share
{
    let added = gnomon_max(weight, 0.0);
    var r: gnomon_transmittance_share;
    r.total = state.total + added;
    r.share = saturate_or_zero(added / r.total);
    r.share = gnomon_select(r.total == 0.0, 1.0, r.share);
    return r;
}
