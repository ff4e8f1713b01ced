// Gnomon 0.1.0, gnomon.wgsl: shadow filtering in WGSL, this file alone.
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

/// The end of slice 0, the logarithm of the quotient of the ends of neighbouring slices, and the last slice.
struct gnomon_froxel_slices { nearest: f32, growth: f32, last: f32 }

/// Slices of which the first ends at nearest and the last at farthest.
/// Domain: nearest and farthest in [2^-60, 2^60] with nearest <= farthest, and 2 to 65536 slices; others are limited to
/// that.
/// NaN: the upper limit.
/// Source: Wronski 2014
fn froxel_slices_from(nearest: f32, farthest: f32, count: f32) -> gnomon_froxel_slices
{
    var r: gnomon_froxel_slices;
    let least = gnomon_power_of_two(-60.0);
    let most = gnomon_power_of_two(60.0);
    r.nearest = clamp_or_high(nearest, least, most);
    r.last = clamp_or_high(count, 2.0, 65536.0) - 1.0;
    let quotient = clamp_or_high(farthest, r.nearest, most) / r.nearest;
    r.growth = polynomial_log(quotient) / r.last;
    return r;
}

/// The distance at which slice k ends.
/// Domain: k limited to the slices.
/// NaN: the end of the last slice.
/// Error: relative, 2^(7 - p).
fn froxel_distance(k: f32, slices: gnomon_froxel_slices) -> f32
{
    return slices.nearest * polynomial_exp(clamp_or_high(k, 0.0, slices.last) * slices.growth);
}

/// The slice that ends at this distance, with a fraction between two ends.
/// Domain: any distance, limited to the ends of the first and of the last slice.
/// NaN: the last slice.
/// Error: 2^(7 - p) of the last slice.
fn froxel_slice_of(distance_: f32, slices: gnomon_froxel_slices) -> f32
{
    let slice = polynomial_log(distance_ / slices.nearest) / slices.growth;
    return clamp_or_high(slice, 0.0, slices.last);
}

/// Light scattered to the camera between two distances, relative to that of clear air of unit length: the weight of a
/// froxel's intensity in its column.
/// Domain: extinction and distances at least 0, nearer <= farther.
/// NaN: 0 for a distance; an extinction of NaN counts as 0.
/// Error: relative, 8 2^-p for optical depths up to 1.
/// Source: Hillaire 2015
fn froxel_weight(extinction: f32, nearer: f32, farther: f32) -> f32
{
    return transmittance_over(extinction * nearer) * attenuated_length(farther - nearer, extinction);
}

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

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_unit(z: f32) -> f32 { return z * 2.0 - 1.0; }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
fn depth_from_reversed(z: f32) -> f32 { return 1.0 - z * 2.0; }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
fn depth_from_distance(distance_: f32, near_distance: f32, far_distance: f32) -> f32
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
fn gnomon_depth_between(n: f32, f: f32) -> f32 { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * x, far_distance * (1.0 - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
fn depth_from_reversed_perspective(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = clamp_or_nan(z, 0.0, 1.0);
    return gnomon_depth_between(near_distance * (1.0 - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
fn depth_from_reversed_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    let x = gnomon_abs(clamp_or_nan(z, 0.0, 1.0)); // -0 is the far plane, too
    let depth = (near_distance * (1.0 - x) - (far_distance * x - near_distance)) / (x * (far_distance - near_distance));
    return clamp_or_nan(depth, -1.0, 1.0);
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
fn depth_from_infinite(z: f32, near_distance: f32, far_distance: f32) -> f32
{
    return depth_from_reversed_infinite(1.0 - z, near_distance, far_distance);
}

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.

struct moments4_ { b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
fn moments4_from_depth(z: f32) -> moments4_
{
    var b: moments4_;
    b.b1_ = z;
    b.b2_ = z * z;
    b.b3_ = b.b2_ * z;
    b.b4_ = b.b2_ * b.b2_;
    return b;
}

/// b times weight: the first term of a linear combination.
fn moments4_scale(given_b: moments4_, weight: f32) -> moments4_
{
    var b = given_b;
    b.b1_ = b.b1_ * weight;
    b.b2_ = b.b2_ * weight;
    b.b3_ = b.b3_ * weight;
    b.b4_ = b.b4_ * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
fn moments4_add(given_sum: moments4_, b: moments4_, weight: f32) -> moments4_
{
    var sum = given_sum;
    sum.b1_ = sum.b1_ + b.b1_ * weight;
    sum.b2_ = sum.b2_ + b.b2_ * weight;
    sum.b3_ = sum.b3_ + b.b3_ * weight;
    sum.b4_ = sum.b4_ + b.b4_ * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
fn moments4_from_unit(c: moments4_) -> moments4_
{
    var b: moments4_;
    b.b1_ = 2.0 * c.b1_ - 1.0;
    b.b2_ = 4.0 * (c.b2_ - c.b1_) + 1.0;
    b.b3_ = (8.0 * c.b3_ - 12.0 * c.b2_) + (6.0 * c.b1_ - 1.0);
    b.b4_ = 16.0 * (c.b4_ - 2.0 * c.b3_) + (24.0 * c.b2_ - 8.0 * c.b1_ + 1.0);
    return b;
}

// moments/moments.h, six moments --------------------------------------------------------------------------------------

struct moments6_ { b1_: f32, b2_: f32, b3_: f32, b4_: f32, b5_: f32, b6_: f32 }

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
fn moments6_from_depth(z: f32) -> moments6_
{
    var b: moments6_;
    b.b1_ = z;
    b.b2_ = z * z;
    b.b3_ = b.b2_ * z;
    b.b4_ = b.b2_ * b.b2_;
    b.b5_ = b.b4_ * z;
    b.b6_ = b.b3_ * b.b3_;
    return b;
}

/// b times weight: the first term of a linear combination.
fn moments6_scale(given_b: moments6_, weight: f32) -> moments6_
{
    var b = given_b;
    b.b1_ = b.b1_ * weight;
    b.b2_ = b.b2_ * weight;
    b.b3_ = b.b3_ * weight;
    b.b4_ = b.b4_ * weight;
    b.b5_ = b.b5_ * weight;
    b.b6_ = b.b6_ * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
fn moments6_add(given_sum: moments6_, b: moments6_, weight: f32) -> moments6_
{
    var sum = given_sum;
    sum.b1_ = sum.b1_ + b.b1_ * weight;
    sum.b2_ = sum.b2_ + b.b2_ * weight;
    sum.b3_ = sum.b3_ + b.b3_ * weight;
    sum.b4_ = sum.b4_ + b.b4_ * weight;
    sum.b5_ = sum.b5_ + b.b5_ * weight;
    sum.b6_ = sum.b6_ + b.b6_ * weight;
    return sum;
}

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.

const gnomon_trigonometry_two_over_pi: f32 = 0x1.45f306p-1; // 0.63661977236758134
const gnomon_trigonometry_half_pi_low: f32 = 0x1.4442d2p-24; // 7.5497899548918821e-8
const gnomon_trigonometry_half_pi: f32 = 0x1.921fb6p+0; // 1.5707963267948966
const gnomon_trigonometry_quarter_pi_low: f32 = 0x1.5110b4p-23; // 1.5695823932524066e-7
const gnomon_trigonometry_tan_pi_8_: f32 = 0x1.a8279ap-2; // 0.41421356237309505

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
const gnomon_sin_float_0_: f32 = -0x1.555546p-3; // -0.16666654609567105
const gnomon_sin_float_1_: f32 = 0x1.11073ap-7; // 0.0083321607625195058
const gnomon_sin_float_2_: f32 = -0x1.9943e2p-13; // -0.00019515283258365583

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
const gnomon_cos_float_0_: f32 = 0x1.55554ap-5; // 0.041666645683017541
const gnomon_cos_float_1_: f32 = -0x1.6c0c34p-10; // -0.0013887316256332952
const gnomon_cos_float_2_: f32 = 0x1.99eb9cp-16; // 2.4433157272163749e-05

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
const gnomon_atan_float_0_: f32 = -0x1.55554ap-2; // -0.33333315189495832
const gnomon_atan_float_1_: f32 = 0x1.999196p-3; // 0.19998471559801789
const gnomon_atan_float_2_: f32 = -0x1.23b524p-3; // -0.14243534037509495
const gnomon_atan_float_3_: f32 = 0x1.b1ec3cp-4; // 0.10593818186484773
const gnomon_atan_float_4_: f32 = -0x1.f1edc2p-5; // -0.060782316918251741

/// A cosine and the sine of the same angle.
struct gnomon_cosine_sine { cosine: f32, sine: f32 }

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
fn polynomial_cosine_sine(given_x: f32) -> gnomon_cosine_sine
{
    var x = given_x;
    x = clamp_or_nan(x, -8192.0, 8192.0);
    let n = nearest_integer(x * gnomon_trigonometry_two_over_pi);
    var y = gnomon_difference(x, n * 1.5703125);
    y = gnomon_difference(y, n * 0.0004837512969970703125) - n * gnomon_trigonometry_half_pi_low;
    let z = y * y;
    var s = gnomon_sin_float_0_ + z * (gnomon_sin_float_1_ + z * gnomon_sin_float_2_);
    var c = gnomon_cos_float_0_ + z * (gnomon_cos_float_1_ + z * gnomon_cos_float_2_);
    s = y + y * z * s;
    c = (1.0 - 0.5 * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    let m = n - 4.0 * nearest_integer(0.25 * n);
    let odd = gnomon_abs(m) == 1.0;
    let opposite = gnomon_abs(m) == 2.0;
    var r: gnomon_cosine_sine;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
fn polynomial_cos(x: f32) -> f32 { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
fn polynomial_sin(x: f32) -> f32 { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
fn polynomial_atan2_(y: f32, x: f32) -> f32
{
    let ax = gnomon_abs(x);
    let ay = gnomon_abs(y);
    let steep = ax < ay;
    let shorter = gnomon_select(steep, ax, ay);
    let longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    let wide = gnomon_trigonometry_tan_pi_8_ * longer < shorter;
    let denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == 0.0, 1.0, longer));
    let t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    let z = t * t;
    let p = gnomon_atan_float_0_ + z *
            (gnomon_atan_float_1_ + z * (gnomon_atan_float_2_ + z * (gnomon_atan_float_3_ + z * gnomon_atan_float_4_)));
    var angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    var eighths = gnomon_select(wide, 1.0, 0.0);
    angle = gnomon_select(steep, -1.0 * angle, angle);
    eighths = gnomon_select(steep, 2.0 - eighths, eighths);
    angle = gnomon_select(x < 0.0, -1.0 * angle, angle);
    eighths = gnomon_select(x < 0.0, 4.0 - eighths, eighths);
    angle = eighths * 0.785398006439208984375 + (angle + eighths * gnomon_trigonometry_quarter_pi_low);
    return gnomon_select(y < 0.0, -1.0 * angle, angle);
}

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

const gnomon_hamburger_cholesky_third: f32 = 0x1.555556p-2; // 0.33333333333333333
const gnomon_hamburger_cholesky_sqrt3_: f32 = 0x1.bb67aep+0; // 1.7320508075688773
const hamburger_cholesky_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The two depths other than z_f, z1 <= z2.
struct gnomon_quadratic_nodes { z1_: f32, z2_: f32 }

/// The two depths of the distribution of three that has one at z_f and four biased moments.
fn gnomon_hamburger4_cholesky_nodes(b: moments4_, z_f: f32) -> gnomon_quadratic_nodes
{
    // Factor B = L D L^T.
    let inverse1 = 1.0 / (b.b2_ - b.b1_ * b.b1_);
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let l21 = c12 * inverse1;
    let d2 = (b.b4_ - b.b2_ * b.b2_) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    let y1 = z_f - b.b1_;
    let q2 = ((z_f * z_f - b.b2_) - l21 * y1) / d2;
    let q1 = y1 * inverse1 - l21 * q2;
    let q0 = 1.0 - (q1 * b.b1_ + q2 * b.b2_);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    let inverse_q2 = 1.0 / q2;
    let centre = -0.5 * (q1 * inverse_q2);
    let r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    var n: gnomon_quadratic_nodes;
    n.z1_ = centre - r;
    n.z2_ = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node -
/// last)), by Cramer's rule.
fn gnomon_hamburger4_cholesky_weight(b: moments4_, node: f32, other: f32, last: f32) -> f32
{
    return (b.b2_ - b.b1_ * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
fn hamburger4_cholesky_intensity(b: moments4_, z_f: f32) -> f32
{
    let n = gnomon_hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    let both = n.z2_ < z_f;
    let node = gnomon_select(both, z_f, n.z1_);
    let other = gnomon_select(both, n.z1_, z_f);
    let w = gnomon_hamburger4_cholesky_weight(b, node, other, n.z2_);
    return saturate_or_zero(gnomon_select(both, 1.0 - w, gnomon_select(n.z1_ < z_f, w, 0.0)));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3,
/// of z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
fn hamburger4_cholesky_blocker(b: moments4_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let n = gnomon_hamburger4_cholesky_nodes(b, z);
    let w1 = gnomon_select(n.z1_ < z, gnomon_hamburger4_cholesky_weight(b, n.z1_, z, n.z2_), 0.0);
    let w2 = gnomon_select(n.z2_ < z, gnomon_hamburger4_cholesky_weight(b, n.z2_, n.z1_, z), 0.0);
    let epsilon = hamburger_cholesky_epsilon;
    let depth = (epsilon * z + (w1 * n.z1_ + w2 * n.z2_)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(-1.0, depth)), z);
}

/// The three real roots of a cubic, in no particular order.
struct gnomon_cubic_roots { z1_: f32, z2_: f32, z3_: f32 }

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
fn gnomon_cubic_roots_blinn(c2: f32, c1: f32, c0: f32) -> gnomon_cubic_roots
{
    let b = c2 * gnomon_hamburger_cholesky_third;
    let c = c1 * gnomon_hamburger_cholesky_third;
    let hessian1 = c - b * b;
    let hessian2 = c0 - b * c;
    let hessian3 = b * c0 - c * c;
    let discriminant = 4.0 * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    let d = hessian2 - 2.0 * b * hessian1;
    let angle = polynomial_atan2_(gnomon_sqrt(discriminant), -1.0 * d);
    let t = polynomial_cosine_sine(angle * gnomon_hamburger_cholesky_third);
    let radius = gnomon_sqrt(-1.0 * hessian1);
    let half_cosine = radius * t.cosine;
    let half_sine = radius * t.sine * gnomon_hamburger_cholesky_sqrt3_;
    var roots: gnomon_cubic_roots;
    roots.z1_ = 2.0 * half_cosine - b;
    roots.z2_ = (half_sine - half_cosine) - b;
    roots.z3_ = -1.0 * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of float; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_cholesky_intensity(b: moments6_, z_f: f32) -> f32
{
    // Factor B = L D L^T.
    let inverse1 = 1.0 / (b.b2_ - b.b1_ * b.b1_);
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let c13 = b.b4_ - b.b1_ * b.b3_;
    let l21 = c12 * inverse1;
    let l31 = c13 * inverse1;
    let inverse2 = 1.0 / ((b.b4_ - b.b2_ * b.b2_) - l21 * c12);
    let c23 = (b.b5_ - b.b2_ * b.b3_) - l21 * c13;
    let l32 = c23 * inverse2;
    let d3 = ((b.b6_ - b.b3_ * b.b3_) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    let z_f2 = z_f * z_f;
    let y1 = z_f - b.b1_;
    let y2 = (z_f2 - b.b2_) - l21 * y1;
    let y3 = ((z_f2 * z_f - b.b3_) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    let q3 = y3 / d3;
    let q2 = y2 * inverse2 - l32 * q3;
    let q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    let q0 = 1.0 - (q1 * b.b1_ + q2 * b.b2_ + q3 * b.b3_);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    let inverse_q3 = 1.0 / q3;
    let z = gnomon_cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    let v1 = gnomon_select(z.z1_ < z_f, 1.0, 0.0);
    let v2 = gnomon_select(z.z2_ < z_f, 1.0, 0.0);
    let v3 = gnomon_select(z.z3_ < z_f, 1.0, 0.0);
    let v01 = v1 / (z.z1_ - z_f);
    let v12 = (v2 - v1) / (z.z2_ - z.z1_);
    let v23 = (v3 - v2) / (z.z3_ - z.z2_);
    let v012 = (v12 - v01) / (z.z2_ - z_f);
    let v123 = (v23 - v12) / (z.z3_ - z.z1_);
    let v0123 = (v123 - v012) / (z.z3_ - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    let s0 = v012 - v0123 * z.z2_;
    let t1 = s0 - v0123 * z.z1_;
    let t0 = v01 - s0 * z.z1_;
    let u2 = t1 - v0123 * z_f;
    let u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3_ + u2 * b.b2_) + u1 * b.b1_) - t0 * z_f);
}

// motion/range/range.h ------------------------------------------------------------------------------------------------
// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
struct depth_time_range { t0_: f32, t1_: f32, z0_: f32, z1_: f32, id: f32 }

const range_mixed: f32 = -1.0; // the id of a range of several surfaces: it shadows them all
const range_nothing: f32 = -2.0; // the id of a time without any surface
const range_far: f32 = 1152921504606846976.0; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
fn range_between(time_a: f32, z_a: f32, time_b: f32, z_b: f32, id: f32) -> depth_time_range
{
    let swapped = time_b < time_a;
    var r: depth_time_range;
    r.t0_ = gnomon_select(swapped, time_b, time_a);
    r.t1_ = gnomon_select(swapped, time_a, time_b);
    r.z0_ = gnomon_select(swapped, z_b, z_a);
    r.z1_ = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
fn range_empty(id: f32) -> depth_time_range
{
    var r: depth_time_range;
    r.t0_ = 1.0;
    r.t1_ = 0.0;
    r.z0_ = 1.0;
    r.z1_ = 1.0;
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
fn range_elapsed(r: depth_time_range, t: f32) -> f32 { return saturate_or_zero((t - r.t0_) / (r.t1_ - r.t0_)); }

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
fn range_depth(r: depth_time_range, t: f32) -> f32
{
    let passed = range_elapsed(r, t);
    return gnomon_select(r.z0_ == r.z1_, r.z0_, r.z0_ * (1.0 - passed) + r.z1_ * passed);
}

/// Duration of the range, 0 if it is empty.
fn range_duration(r: depth_time_range) -> f32 { return gnomon_max(r.t1_ - r.t0_, 0.0); }

/// The part of r between the times begin and end, possibly empty.
fn range_clip(r: depth_time_range, begin: f32, end: f32) -> depth_time_range
{
    var c: depth_time_range;
    c.t0_ = gnomon_max(begin, r.t0_);
    c.t1_ = gnomon_min(end, r.t1_);
    c.z0_ = range_depth(r, c.t0_);
    c.z1_ = range_depth(r, c.t1_);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
fn gnomon_range_select(mask: bool, a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var r: depth_time_range;
    r.t0_ = gnomon_select(mask, a.t0_, b.t0_);
    r.t1_ = gnomon_select(mask, a.t1_, b.t1_);
    r.z0_ = gnomon_select(mask, a.z0_, b.z0_);
    r.z1_ = gnomon_select(mask, a.z1_, b.z1_);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
fn gnomon_range_keep_if(mask: bool, r: depth_time_range) -> depth_time_range
{
    return gnomon_range_select(mask, r, range_empty(range_nothing));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
fn gnomon_range_less(a: depth_time_range, b: depth_time_range) -> bool
{
    let by_id = a.id < b.id;
    let by_z1 = a.z1_ < b.z1_ || (a.z1_ == b.z1_ && by_id);
    let by_z0 = a.z0_ < b.z0_ || (a.z0_ == b.z0_ && by_z1);
    let by_t1 = a.t1_ < b.t1_ || (a.t1_ == b.t1_ && by_z0);
    return a.t0_ < b.t0_ || (a.t0_ == b.t0_ && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
fn gnomon_range_occludes(a: depth_time_range, b: depth_time_range) -> bool
{
    let during = a.t0_ <= b.t0_ && b.t1_ <= a.t1_;
    let apart = gnomon_max(a.z0_, a.z1_) <= gnomon_min(b.z0_, b.z1_);
    let nearer = a.t0_ == b.t0_ && a.t1_ == b.t1_ && a.z0_ <= b.z0_ && a.z1_ <= b.z1_;
    let equal = nearer && a.z0_ == b.z0_ && a.z1_ == b.z1_;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
fn gnomon_range_clip_to(a: depth_time_range, b: depth_time_range) -> depth_time_range { return range_clip(a, b.t0_,
                                                                                                          b.t1_); }

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
fn gnomon_range_crossing(a: depth_time_range, b: depth_time_range) -> f32
{
    let distance0 = a.z0_ - b.z0_;
    let distance1 = a.z1_ - b.z1_;
    let passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0_ * (1.0 - passed) + a.t1_ * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
fn gnomon_range_visible_part(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    let near_a = gnomon_range_clip_to(a, b);
    let near_b = gnomon_range_clip_to(b, a);
    let before0 = near_b.z0_ - near_a.z0_;
    let before1 = near_b.z1_ - near_a.z1_;
    let tie = before0 == 0.0 && before1 == 0.0 && a.id < b.id;
    let first = 0.0 < before0 || (before0 == 0.0 && 0.0 < before1) || tie;
    let last = 0.0 < before1 || (before1 == 0.0 && 0.0 < before0) || tie;
    let crossing = clamp_or_nan(gnomon_range_crossing(near_a, near_b), near_a.t0_, near_a.t1_);
    let begin = gnomon_select(first, near_a.t0_, gnomon_select(last, crossing, 1.0));
    let end = gnomon_select(last, near_a.t1_, gnomon_select(first, crossing, 0.0));
    let some = begin < end;
    return range_clip(a, gnomon_select(some, begin, 1.0), gnomon_select(some, end, 0.0));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
fn gnomon_range_trim(r: depth_time_range, other: depth_time_range) -> depth_time_range
{
    let occluding = gnomon_range_visible_part(other, r);
    let some = occluding.t0_ < occluding.t1_;
    let begin = gnomon_select(some && occluding.t0_ <= r.t0_, occluding.t1_, r.t0_);
    let end = gnomon_select(some && r.t1_ <= occluding.t1_, occluding.t0_, r.t1_);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
fn range_occluding_part(r: depth_time_range, receiver: depth_time_range, begin: f32, end: f32) -> depth_time_range
{
    let early = gnomon_max(begin, r.t0_);
    let late = gnomon_min(end, r.t1_);
    // In most cases one of the two is in front at all times.
    let nearer = r.z0_ < receiver.z0_ && r.z0_ < receiver.z1_ && r.z1_ < receiver.z0_ && r.z1_ < receiver.z1_;
    let farther = receiver.z0_ <= r.z0_ && receiver.z0_ <= r.z1_ && receiver.z1_ <= r.z0_ && receiver.z1_ <= r.z1_;
    var front = early;
    var back = gnomon_select(farther, 0.0, late);
    let open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        let before0 = range_depth(receiver, early) - range_depth(r, early);
        let before1 = range_depth(receiver, late) - range_depth(r, late);
        let passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        let crossing = clamp_or_nan(early * (1.0 - passed) + late * passed, early, late);
        let first = gnomon_select(0.0 < before0, early, gnomon_select(0.0 < before1, crossing, 1.0));
        let last = gnomon_select(0.0 < before1, late, gnomon_select(0.0 < before0, crossing, 0.0));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    let some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, 1.0), gnomon_select(some, back, 0.0));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
fn range_intensity(r: depth_time_range, t: f32, z: f32, id: f32, bias: f32) -> f32
{
    let during = r.t0_ <= t && t <= r.t1_;
    let occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, 1.0, 0.0);
}

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

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
struct range_front
{
    nearest: depth_time_range,
    begin: f32, unchanged: f32, end: f32,
}

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
fn gnomon_range_canonical(given_r: depth_time_range) -> depth_time_range
{
    var r = given_r;
    r.id = gnomon_max(r.id, range_mixed);
    let known = gnomon_abs(r.z0_) + gnomon_abs(r.z1_) < range_far;
    return gnomon_range_keep_if(0.0 <= r.t0_ && r.t0_ < r.t1_ && r.t1_ <= 1.0 && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
fn range_front_begin(t: f32) -> range_front
{
    var state: range_front;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(range_nothing);
    state.unchanged = 1.0;
    state.end = 1.0;
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
fn range_front_compare(given_state: range_front, given_r: depth_time_range) -> range_front
{
    var r = given_r;
    var state = given_state;
    r = gnomon_range_canonical(r);
    let front = state.nearest;
    let ahead = gnomon_range_visible_part(r, front);
    let during = r.t0_ <= state.begin && state.begin < r.t1_;
    let alone = front.t1_ <= front.t0_;
    let nearer = ahead.t0_ <= state.begin && state.begin < ahead.t1_;
    var change = gnomon_select(state.begin < ahead.t0_, ahead.t0_, gnomon_select(nearer, ahead.t1_, 1.0));
    change = gnomon_min(change, gnomon_min(front.t1_, r.t1_));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = gnomon_range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
fn range_front_limit(given_state: range_front, given_r: depth_time_range) -> range_front
{
    var r = given_r;
    var state = given_state;
    r = gnomon_range_canonical(r);
    let ahead = gnomon_range_visible_part(r, state.nearest);
    let some = state.nearest.t0_ < state.nearest.t1_;
    let next = gnomon_select(some, ahead.t0_, r.t0_);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons
    // do.
    let circle = ahead.t0_ <= state.begin && state.begin < ahead.t1_;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
fn range_front_span(state: range_front) -> depth_time_range
{
    let some = state.nearest.t0_ < state.nearest.t1_;
    let end = gnomon_min(gnomon_select(some, state.nearest.t1_, 1.0), state.end);
    var span = range_clip(state.nearest, state.begin, end);
    span.t0_ = state.begin;
    span.t1_ = end;
    return span;
}

// motion/range/range_merge.h ------------------------------------------------------------------------------------------
// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
struct range_pair
{
    merged: depth_time_range,
    gap: f32, shift: f32, cost: f32,
}

const gnomon_range_merge_margin: f32 = 0.000003814697265625; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
fn gnomon_range_hull(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var hull: depth_time_range;
    hull.t0_ = gnomon_min(a.t0_, b.t0_);
    hull.t1_ = gnomon_max(a.t1_, b.t1_);
    let nearer0 = gnomon_min(a.z0_, b.z0_);
    let nearer1 = gnomon_min(a.z1_, b.z1_);
    hull.z0_ = gnomon_select(a.t0_ < b.t0_, a.z0_, gnomon_select(b.t0_ < a.t0_, b.z0_, nearer0));
    hull.z1_ = gnomon_select(b.t1_ < a.t1_, a.z1_, gnomon_select(a.t1_ < b.t1_, b.z1_, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, range_mixed);
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
fn gnomon_range_merge(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    var hull = gnomon_range_hull(a, b);
    var back = gnomon_max(gnomon_max(range_depth(hull, a.t0_) - a.z0_, range_depth(hull, a.t1_) - a.z1_),
                          gnomon_max(range_depth(hull, b.t0_) - b.z0_, range_depth(hull, b.t1_) - b.z1_));
    back = gnomon_max(back, 0.0);
    let size = gnomon_max(gnomon_max(gnomon_abs(a.z0_), gnomon_abs(a.z1_)),
                          gnomon_max(gnomon_abs(b.z0_), gnomon_abs(b.z1_)));
    let margin = size * gnomon_range_merge_margin;
    let level = gnomon_min(gnomon_min(a.z0_, b.z0_), gnomon_min(a.z1_, b.z1_));
    let sloped0 = hull.z0_ - back;
    let sloped1 = hull.z1_ - back;
    let slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) + gnomon_abs(sloped1) < range_far;
    hull.z0_ = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1_ = gnomon_select(slopes, sloped1, level) - margin;

    let some_a = a.t0_ < a.t1_;
    let some_b = b.t0_ < b.t1_;
    return gnomon_range_select(some_a && some_b, hull, gnomon_range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
fn gnomon_range_area(r: depth_time_range) -> f32 { return range_duration(r) * (1.0 - 0.5 * (r.z0_ + r.z1_)); }

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
fn gnomon_range_distance(r: depth_time_range, nearer: depth_time_range) -> f32
{
    let distance0 = r.z0_ - range_depth(nearer, r.t0_);
    let distance1 = r.z1_ - range_depth(nearer, r.t1_);
    return gnomon_select(r.t0_ < r.t1_, gnomon_max(gnomon_max(distance0, distance1), 0.0), 0.0);
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
fn gnomon_range_pair_make(a: depth_time_range, b: depth_time_range) -> range_pair
{
    var p: range_pair;
    p.merged = gnomon_range_merge(a, b);
    let some = a.t0_ < a.t1_ && b.t0_ < b.t1_;
    let gap = gnomon_max(a.t0_, b.t0_) - gnomon_min(a.t1_, b.t1_);
    p.gap = gnomon_select(some, gnomon_max(gap, 0.0), 0.0);
    // Ignore the parts that the other range occludes: they were in shadow already.
    let shift = gnomon_max(gnomon_range_distance(gnomon_range_trim(a, b), p.merged),
                           gnomon_range_distance(gnomon_range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, 0.0);

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    let near_a = gnomon_range_clip_to(a, b);
    let near_b = gnomon_range_clip_to(b, a);
    let x0 = near_a.z0_ - near_b.z0_;
    let x1 = near_a.z1_ - near_b.z1_;
    let sum = gnomon_abs(x0) + gnomon_abs(x1);
    var apart = 0.5 * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(0.0 < sum, apart, 0.0);
    let middle = 0.25 * ((near_a.z0_ + near_a.z1_) + (near_b.z0_ + near_b.z1_));
    let both = range_duration(near_a) * (1.0 - (middle + 0.5 * apart));
    let area = gnomon_range_area(p.merged) - ((gnomon_range_area(a) + gnomon_range_area(b)) - both);
    let own_a = gnomon_select(a.id == p.merged.id, 0.0, range_duration(a));
    let own_b = gnomon_select(b.id == p.merged.id, 0.0, range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, 0.0) + (own_a + own_b), -1.0);
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
fn gnomon_range_pair_empty(r: depth_time_range) -> range_pair
{
    var p: range_pair;
    p.merged = r;
    p.gap = 0.0;
    p.shift = 0.0;
    p.cost = range_far * range_far;
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
fn gnomon_range_pair_cheaper(a: range_pair, b: range_pair) -> range_pair
{
    let cheaper = b.cost < a.cost;
    var p: range_pair;
    p.merged = gnomon_range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

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
// The capacity is gnomon_range_capacity, if defined before inclusion, else 8. In C++ the capacity is a template
// parameter with this default.

const gnomon_range_capacity: i32 = 8;

/// Ranges in the order of gnomon_range_less, with empty ranges between them, and upper bounds of the cost of merging:
/// except for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
struct range_list
{
    ranges: array<depth_time_range, gnomon_range_capacity>,
    time_added: f32, depth_added: f32,
}

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
fn gnomon_range_offset(given_r: depth_time_range, side: f32) -> depth_time_range
{
    var r = given_r;
    let change = gnomon_abs(r.z1_ - r.z0_);
    let brief = gnomon_min(change * 0.000000476837158203125 / (r.t1_ - r.t0_), change);
    let by = side * (0.0000152587890625 + brief);
    r.z0_ = r.z0_ + by;
    r.z1_ = r.z1_ + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
fn gnomon_range_list_count_merge(given_list: range_list, p: range_pair) -> range_list
{
    var list = given_list;
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, 0.0);
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
fn gnomon_range_list_place(given_list: range_list, given_r: depth_time_range) -> range_list
{
    var r = given_r;
    var list = given_list;
    for (var i = 0; i + 1 < gnomon_range_capacity; i++) { // the first empty one goes to the end
        let s = list.ranges[i];
        let next = list.ranges[i + 1];
        let empty = s.t1_ <= s.t0_ && r.t0_ < r.t1_;
        list.ranges[i] = gnomon_range_select(empty, next, s);
        list.ranges[i + 1] = gnomon_range_select(empty, s, next);
    }
    for (var k = 0; k + 1 < gnomon_range_capacity; k++) {
        let s = list.ranges[k];
        let here = s.t0_ < s.t1_ && gnomon_range_less(r, s);
        list.ranges[k] = gnomon_range_select(here, r, s);
        r = gnomon_range_select(here, s, r);
    }
    let last = list.ranges[gnomon_range_capacity - 1];
    list.ranges[gnomon_range_capacity - 1] = gnomon_range_select(r.t0_ < r.t1_, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A
/// place of -1 is none.
fn gnomon_range_list_replace(given_list: range_list, full: bool, first: f32, second: f32,
                             given_merge: range_pair) -> range_list
{
    var merge = given_merge;
    var list = given_list;
    var place = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        let merged = full && (place == first || place == second);
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
fn range_list_insert(given_list: range_list, given_r: depth_time_range) -> range_list
{
    var r = given_r;
    var list = given_list;
    r = gnomon_range_canonical(range_clip(r, 0.0, 1.0));
    list = gnomon_range_list_count_merge(list, gnomon_range_pair_empty(r)); // counts that are NaN become 0
    var room = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        var s = gnomon_range_canonical(list.ranges[i]);
        r = gnomon_range_keep_if(!gnomon_range_occludes(s, r), r);
        s = gnomon_range_keep_if(!gnomon_range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0_ < s.t1_, room, 1.0);
    }
    let full = r.t0_ < r.t1_ && room < 1.0;
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        var occluders = list;
        for (var h = 0; h < gnomon_range_capacity; h++) { occluders.ranges[h] = gnomon_range_offset(list.ranges[h],
                                                                                                    1.0); }
        let farther = gnomon_range_offset(r, 1.0);
        for (var j = 0; j < gnomon_range_capacity; j++) {
            var s = gnomon_range_trim(gnomon_range_offset(list.ranges[j], -1.0), farther);
            for (var k = 0; k < gnomon_range_capacity; k++) { s = gnomon_range_trim(s, occluders.ranges[k]); }
            let seen = !full || s.t0_ < s.t1_;
            list.ranges[j] = gnomon_range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = gnomon_range_keep_if(seen, occluders.ranges[j]);
        }
        var left = gnomon_range_offset(r, -1.0);
        for (var m = 0; m < gnomon_range_capacity; m++) { left = gnomon_range_trim(left, occluders.ranges[m]); }
        r = gnomon_range_keep_if(!full || left.t0_ < left.t1_, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        var best = gnomon_range_pair_empty(r);
        var first = -1.0;
        var second = -1.0;
        var place = 0.0;
        for (var a = 0; a < gnomon_range_capacity; a++) {
            var other = r;
            var other_place = -1.0;
            for (var b = 0; b <= a; b++) {
                let pair = gnomon_range_pair_make(list.ranges[a], other);
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
fn range_list_make(r: depth_time_range) -> range_list
{
    var list: range_list;
    for (var i = 0; i < gnomon_range_capacity; i++) { list.ranges[i] = gnomon_range_keep_if(r.t0_ < r.t0_, r); }
    list.time_added = 0.0;
    list.depth_added = 0.0;
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
fn range_list_front(given_list: range_list, t: f32) -> depth_time_range
{
    var list = given_list;
    var state = range_front_begin(t);
    for (var i = 0; i < gnomon_range_capacity; i++) { state = range_front_compare(state, list.ranges[i]); }
    for (var k = 0; k < gnomon_range_capacity; k++) { state = range_front_limit(state, list.ranges[k]); }
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
fn gnomon_range_list_append(given_list: range_list, r: depth_time_range) -> range_list
{
    var list = given_list;
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    var best = gnomon_range_pair_empty(r);
    var at = 0.0;
    var place = 0.0;
    var next = r;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        let s = list.ranges[gnomon_range_capacity - 1 - i];
        let pair = gnomon_range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = gnomon_range_pair_cheaper(best, pair);
        next = s;
        place = place + 1.0;
    }
    place = 0.0;
    next = r;
    for (var k = 0; k < gnomon_range_capacity; k++) {
        let s = list.ranges[gnomon_range_capacity - 1 - k];
        let here = gnomon_range_select(place == at, best.merged, s);
        list.ranges[gnomon_range_capacity - 1 - k] = gnomon_range_select(place < at, next, here);
        next = s;
        place = place + 1.0;
    }
    return gnomon_range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
fn range_list_resolve(given_list: range_list) -> range_list
{
    var list = given_list;
    var t = 0.0;
    var resolved = list;
    for (var i = 0; i < gnomon_range_capacity; i++) { resolved.ranges[i] = gnomon_range_keep_if(t < t,
                                                                                                list.ranges[i]); }
    for (var k = 0; k < (gnomon_range_capacity + 1) * (gnomon_range_capacity + 2) / 2; k++) {
        if (gnomon_any(t < 1.0)) {
            let span = range_list_front(list, t);
            let some = range_nothing < span.id;
            resolved = gnomon_range_list_append(resolved, gnomon_range_keep_if(some, span));
            t = span.t1_;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
fn range_list_intensity(given_list: range_list, t: f32, z: f32, id: f32, bias: f32) -> f32
{
    var list = given_list;
    var intensity = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) { intensity = gnomon_max(intensity,
                                                                             range_intensity(list.ranges[i], t, z, id,
                                                                                             bias)); }
    return intensity;
}

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

/// Weights of the area that becomes shadowed (gnomon_range_pair_make), of the gap in time, of the differences in depth
/// and in slope, and of the durations.
struct gnomon_interval_weights { area: f32, gap: f32, depth: f32, slope: f32, duration: f32 }

/// The interval from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
/// If one is empty, the result is the other one, unchanged.
/// Source: Gribel 2010
fn interval_merge(a: depth_time_range, b: depth_time_range) -> depth_time_range
{
    let some_a = a.t0_ < a.t1_;
    let some_b = b.t0_ < b.t1_;
    return gnomon_range_select(some_a && some_b, gnomon_range_hull(a, b), gnomon_range_select(some_a, a, b));
}

/// Cost of merging a and b, at most 2^60; -1 if one is empty. The difference in depth is that between the end of the
/// earlier one and the begin of the later one.
/// NaN: 2^60.
/// Source: Gribel 2010
fn interval_cost(a: depth_time_range, b: depth_time_range, weights: gnomon_interval_weights) -> f32
{
    let p = gnomon_range_pair_make(a, b);
    let first = gnomon_range_select(b.t0_ < a.t0_, b, a);
    let second = gnomon_range_select(b.t0_ < a.t0_, a, b);
    let gap = gnomon_max(second.t0_ - first.t1_, 0.0);
    let slopes = (first.z1_ - first.z0_) / (first.t1_ - first.t0_) - (second.z1_ - second.z0_) /
                 (second.t1_ - second.t0_);
    let steeper = gnomon_min(gnomon_abs(slopes), range_far);
    let lasting = range_duration(a) + range_duration(b);
    let cost = (weights.area * p.cost + weights.gap * gap) +
               (weights.depth * gnomon_abs(second.z0_ - first.z1_) + weights.slope * steeper) + weights.duration *
               lasting;
    let some = a.t0_ < a.t1_ && b.t0_ < b.t1_;
    return gnomon_select(some, gnomon_max(gnomon_min(cost, range_far), 0.0), -1.0);
}

/// The merge of a and b, with its costs.
fn gnomon_interval_pair_make(a: depth_time_range, b: depth_time_range, weights: gnomon_interval_weights,
                             conservative: f32) -> range_pair
{
    var p = gnomon_range_pair_make(a, b);
    p.merged = gnomon_range_select(0.0 < conservative, p.merged, interval_merge(a, b));
    p.cost = interval_cost(a, b, weights);
    return p;
}

/// Insert r, clipped to times in [0, 1]. On overflow the pair of the least cost is merged, and the list counts its cost
/// as range_list_insert does, as if the merge were conservative.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16, weights of 0 or more.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010
fn interval_list_insert(given_list: range_list, given_r: depth_time_range, weights: gnomon_interval_weights,
                        conservative: f32) -> range_list
{
    var r = given_r;
    var list = given_list;
    r = gnomon_range_canonical(range_clip(r, 0.0, 1.0));
    list = gnomon_range_list_count_merge(list, gnomon_range_pair_empty(r)); // counts that are NaN become 0
    var room = 0.0;
    for (var i = 0; i < gnomon_range_capacity; i++) {
        var s = gnomon_range_canonical(list.ranges[i]);
        r = gnomon_range_keep_if(!gnomon_range_occludes(s, r), r);
        s = gnomon_range_keep_if(!gnomon_range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0_ < s.t1_, room, 1.0);
    }
    let full = r.t0_ < r.t1_ && room < 1.0;
    if (gnomon_any(full)) {
        var best = gnomon_range_pair_empty(r);
        var first = -1.0;
        var second = -1.0;
        var place = 0.0;
        for (var a = 0; a < gnomon_range_capacity; a++) {
            var other = r; // which has place -1
            var other_place = -1.0;
            for (var b = 0; b <= a; b++) {
                let pair = gnomon_interval_pair_make(list.ranges[a], other, weights, conservative);
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

const percentage_closer_search_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The receiver's depth, the weight in front of the receiver so far, and the sum of its weighted distances to the
/// receiver.
struct percentage_closer_search { receiver: f32, shadowed: f32, distance: f32 }

/// The mean depth of the blockers, in [-1, 1] and at most z_f, and their weight in the search region, in [0, 1].
struct percentage_closer_blocker { depth: f32, intensity: f32 }

/// The state before the first texel of the search region. z_f has no bias.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: no blocker.
fn percentage_closer_search_begin(z_f: f32) -> percentage_closer_search
{
    var r: percentage_closer_search;
    r.receiver = clamp_or_nan(z_f, -1.0, 1.0);
    r.shadowed = 0.0;
    r.distance = 0.0;
    return r;
}

/// The state after one more texel of depth z with its weight.
/// Domain: any z; below the near plane as on it.
/// NaN: a texel of depth NaN is no blocker; a weight of NaN before the receiver leaves no blocker at all.
fn percentage_closer_search_add(given_state: percentage_closer_search, z: f32, weight: f32) -> percentage_closer_search
{
    var state = given_state;
    let in_front = z < state.receiver;
    let distance = state.receiver - gnomon_max(z, -1.0);
    state.shadowed = state.shadowed + gnomon_select(in_front, weight, 0.0);
    state.distance = state.distance + gnomon_select(in_front, weight * distance, 0.0);
    return state;
}

/// Mean depth and weight of the blockers. The mean is moved towards the receiver by a weight of 1e-3, so that few
/// blockers count for less and none leaves the receiver's own depth.
/// NaN: for z_f the far plane; for a weight before the receiver the receiver's depth, and an intensity of 0.
/// Error: that of the sums of weights and of weighted distances.
/// Source: Peters 2017, Eq. 4; Fernando 2005
fn percentage_closer_search_end(state: percentage_closer_search) -> percentage_closer_blocker
{
    let weight = state.shadowed + percentage_closer_search_epsilon;
    let receiver = clamp_or_high(state.receiver, -1.0, 1.0);
    var r: percentage_closer_blocker;
    let depth = gnomon_max(-1.0, gnomon_min(receiver - state.distance / weight, receiver));
    // Clang 14 makes one clamp, which lets a NaN pass, of this one and of that at the beginning.
    r.depth = gnomon_select(state.receiver == state.receiver, depth, 1.0);
    r.intensity = saturate_or_zero(state.shadowed);
    return r;
}

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

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
struct gnomon_moving_edge { e0_: f32, e1_: f32, e2_: f32 }

/// The edge functions opposite to the vertices a, b, c of a triangle.
struct gnomon_moving_edges { a: gnomon_moving_edge, b: gnomon_moving_edge, c: gnomon_moving_edge }

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are
/// gnomon_coverage_none. An empty set has begin 1 and end 0.
struct gnomon_edge_intervals { begin: f32, end: f32, gap_begin: f32, gap_end: f32 }

/// The times from begin to end; none unless begin < end.
struct gnomon_linear_interval { begin: f32, end: f32 }

/// Four numbers in ascending order.
struct gnomon_ordered4_ { first: f32, second: f32, third: f32, fourth: f32 }

/// Disjoint intervals in order, `count` of them; the others begin and end at gnomon_coverage_none.
struct coverage_intervals { count: f32, begin0_: f32, end0_: f32, begin1_: f32, end1_: f32, begin2_: f32, end2_: f32,
    begin3_: f32, end3_: f32 }

const gnomon_coverage_none: f32 = 2.0; // after the shutter has closed
const gnomon_moving_edge_limit: f32 = 1152921504606846976.0; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
fn moving_edge_at(e: gnomon_moving_edge, t: f32) -> f32
{
    let s = 1.0 - t;
    return (e.e0_ * s + e.e1_ * t) * s + (e.e1_ * s + e.e2_ * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
fn gnomon_moving_edge_size(e: gnomon_moving_edge) -> f32 { return (gnomon_abs(e.e0_) + gnomon_abs(e.e1_)) +
                                                                  gnomon_abs(e.e2_); }

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
fn moving_edge_inside(e: gnomon_moving_edge, facing: f32) -> gnomon_edge_intervals
{
    let side = gnomon_select(facing < 0.0, -1.0, 1.0);
    let c0 = side * e.e0_;
    let c1 = side * e.e1_;
    let c2 = side * e.e2_;
    var x: gnomon_edge_intervals;
    x.begin = 0.0;
    x.end = 1.0;
    x.gap_begin = gnomon_coverage_none;
    x.gap_end = gnomon_coverage_none;
    let before = c0 < 0.0; // outside at shutter open
    let after = c2 < 0.0;
    if (gnomon_any(before || after || c1 < 0.0)) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        let up = 0.0 < c1 || (c1 == 0.0 && before);
        let late = (before && !up) || (up && !before);
        let once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        var twice = !(once || late);
        let r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, 0.0));
        let q = gnomon_select(up, -1.0 * (c1 + r), r - c1);
        let first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        var second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && 0.0 < r;
            let gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        let some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, 0.0), 1.0);
        x.end = gnomon_select(some, gnomon_select(after, second, 1.0), 0.0);
    }
    let known = gnomon_moving_edge_size(e) < gnomon_moving_edge_limit;
    x.begin = gnomon_select(known, x.begin, 1.0);
    x.end = gnomon_select(known, x.end, 0.0);
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
fn linear_edge_inside(e0: f32, e2: f32) -> gnomon_linear_interval
{
    let before = e0 < 0.0;
    let after = e2 < 0.0;
    let change = e0 - e2;
    let never = (before && after) || !(gnomon_abs(change) < gnomon_moving_edge_limit);
    let root = gnomon_min(e0 / change, 1.0);
    var x: gnomon_linear_interval;
    x.begin = gnomon_select(never, 1.0, gnomon_select(before, root, 0.0));
    x.end = gnomon_select(never, 0.0, gnomon_select(after, root, 1.0));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
fn linear_coverage(e: gnomon_moving_edges) -> gnomon_linear_interval
{
    var a = linear_edge_inside(e.a.e0_, e.a.e2_);
    let b = linear_edge_inside(e.b.e0_, e.b.e2_);
    let c = linear_edge_inside(e.c.e0_, e.c.e2_);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
fn gnomon_ordered4_make(a: f32, b: f32, c: f32, d: f32) -> gnomon_ordered4_
{
    let low0 = gnomon_min(a, b);
    let high0 = gnomon_max(a, b);
    let low1 = gnomon_min(c, d);
    let high1 = gnomon_max(c, d);
    let middle0 = gnomon_max(low0, low1);
    let middle1 = gnomon_min(high0, high1);
    var x: gnomon_ordered4_;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
fn intersect_edge_intervals(given_a: gnomon_edge_intervals, given_b: gnomon_edge_intervals,
                            given_c: gnomon_edge_intervals) -> coverage_intervals
{
    var c = given_c;
    var b = given_b;
    var a = given_a;
    let begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), 0.0);
    let end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), 1.0);
    let none = gnomon_coverage_none;
    let some = begin < end;
    var x: coverage_intervals;
    x.count = gnomon_select(some, 1.0, 0.0);
    x.begin0_ = gnomon_select(some, begin, none);
    x.end0_ = gnomon_select(some, end, none);
    x.begin1_ = none;
    x.end1_ = none;
    x.begin2_ = none;
    x.end2_ = none;
    x.begin3_ = none;
    x.end3_ = none;
    let gap_a = a.gap_begin < none;
    let gap_b = b.gap_begin < none;
    let gap_c = c.gap_begin < none;
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
        var starts = gnomon_ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        var stops = gnomon_ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        let begin1 = gnomon_max(begin, stops.first);
        let begin2 = gnomon_max(begin, stops.second);
        let begin3 = gnomon_max(begin, stops.third);
        let end0 = gnomon_min(end, starts.first);
        let end1 = gnomon_min(end, starts.second);
        let end2 = gnomon_min(end, starts.third);
        let some0 = some && begin < end0;
        let some1 = some && begin1 < end1;
        let some2 = some && begin2 < end2;
        let some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = gnomon_ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                                      gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = gnomon_ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                                     gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, 1.0, 0.0) + gnomon_select(some1, 1.0, 0.0)) +
                  (gnomon_select(some2, 1.0, 0.0) + gnomon_select(some3, 1.0, 0.0));
        x.begin0_ = starts.first;
        x.end0_ = stops.first;
        x.begin1_ = starts.second;
        x.end1_ = stops.second;
        x.begin2_ = starts.third;
        x.end2_ = stops.third;
        x.begin3_ = starts.fourth;
        x.end3_ = stops.fourth;
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
fn moving_coverage(e: gnomon_moving_edges, facing: f32) -> coverage_intervals
{
    var a = moving_edge_inside(e.a, facing);
    let size = (gnomon_moving_edge_size(e.a) + gnomon_moving_edge_size(e.b)) + gnomon_moving_edge_size(e.c);
    a.end = gnomon_select(0.0 < size, a.end, 0.0);
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
fn coverage_duration(x: coverage_intervals) -> f32
{
    return saturate_or_zero(((x.end0_ - x.begin0_) + (x.end1_ - x.begin1_)) +
                            ((x.end2_ - x.begin2_) + (x.end3_ - x.begin3_)));
}

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

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
struct gnomon_moving_vertex { x0_: f32, y0_: f32, z0_: f32, w0_: f32, x1_: f32, y1_: f32, z1_: f32, w1_: f32 }

/// A triangle of three moving vertices.
struct moving_triangle { a: gnomon_moving_vertex, b: gnomon_moving_vertex, c: gnomon_moving_vertex }

/// A vertex relative to a sample, at shutter open and at shutter close.
struct gnomon_sheared_vertex { x0_: f32, y0_: f32, x1_: f32, y1_: f32 }

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
struct depth_line { z0_: f32, z1_: f32, deviation: f32 }

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
struct depth_piece { t0_: f32, t1_: f32, z0_: f32, z1_: f32, passed: f32 }

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
struct depth_trial
{
    piece: depth_piece,
    start: f32, share: f32, settled: f32,
}

/// Weights of a triangle's vertices; they need not sum to 1.
struct gnomon_corner_weights { a: f32, b: f32, c: f32 }

/// Bernstein coefficients of a cubic, the middle ones times 3.
struct gnomon_bernstein_cubic { c0_: f32, c1_: f32, c2_: f32, c3_: f32 }

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
fn gnomon_moving_vertex_shear(v: gnomon_moving_vertex, s_x: f32, s_y: f32) -> gnomon_sheared_vertex
{
    var r: gnomon_sheared_vertex;
    r.x0_ = v.x0_ - gnomon_product(s_x, v.w0_);
    r.y0_ = v.y0_ - gnomon_product(s_y, v.w0_);
    r.x1_ = v.x1_ - gnomon_product(s_x, v.w1_);
    r.y1_ = v.y1_ - gnomon_product(s_y, v.w1_);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
fn gnomon_sheared_cross(a_x: f32, a_y: f32, b_x: f32, b_y: f32) -> f32
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
fn gnomon_moving_edge_make(a: gnomon_sheared_vertex, b: gnomon_sheared_vertex) -> gnomon_moving_edge
{
    var e: gnomon_moving_edge;
    e.e0_ = gnomon_sheared_cross(a.x0_, a.y0_, b.x0_, b.y0_);
    e.e1_ = 0.5 * (gnomon_sheared_cross(a.x0_, a.y0_, b.x1_, b.y1_) + gnomon_sheared_cross(a.x1_, a.y1_, b.x0_, b.y0_));
    e.e2_ = gnomon_sheared_cross(a.x1_, a.y1_, b.x1_, b.y1_);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
fn moving_triangle_edges(m: moving_triangle, s_x: f32, s_y: f32) -> gnomon_moving_edges
{
    let a = gnomon_moving_vertex_shear(m.a, s_x, s_y);
    let b = gnomon_moving_vertex_shear(m.b, s_x, s_y);
    let c = gnomon_moving_vertex_shear(m.c, s_x, s_y);
    var e: gnomon_moving_edges;
    e.a = gnomon_moving_edge_make(b, c);
    e.b = gnomon_moving_edge_make(c, a);
    e.c = gnomon_moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
fn gnomon_corner_weights_at(e: gnomon_moving_edges, t: f32) -> gnomon_corner_weights
{
    var v: gnomon_corner_weights;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    let back = (v.a + v.b) + v.c < 0.0;
    v.a = gnomon_max(gnomon_select(back, -1.0 * v.a, v.a), 0.0);
    v.b = gnomon_max(gnomon_select(back, -1.0 * v.b, v.b), 0.0);
    v.c = gnomon_max(gnomon_select(back, -1.0 * v.c, v.c), 0.0);
    let vanished = (v.a + v.b) + v.c <= 0.0;
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
fn moving_depth_at(m: moving_triangle, e: gnomon_moving_edges, t: f32, divided: f32) -> f32
{
    let v = gnomon_corner_weights_at(e, t);
    let s = 1.0 - t;
    let z = (v.a * (m.a.z0_ * s + m.a.z1_ * t) + v.b * (m.b.z0_ * s + m.b.z1_ * t)) + v.c * (m.c.z0_ * s + m.c.z1_ * t);
    let w = (v.a * (m.a.w0_ * s + m.a.w1_ * t) + v.b * (m.b.w0_ * s + m.b.w1_ * t)) + v.c * (m.c.w0_ * s + m.c.w1_ * t);
    let divisor = gnomon_select(0.0 < divided, w, (v.a + v.b) + v.c);
    let depth = gnomon_max(gnomon_min(z / divisor, 1.0), -1.0); // a NaN becomes 1
    return gnomon_select(0.0 < w, depth, 1.0);
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
fn gnomon_depth_nonlinearity(most: f32, d0: f32, d3: f32, turn0: f32, turn1: f32) -> f32
{
    let negative = d0 < 0.0;
    let turn = gnomon_select(negative, -1.0 * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    let product = d0 * d3;
    let least = turn + 2.0 * gnomon_sqrt(product);
    let known = 0.0 < product && 0.0 < least && least < gnomon_moving_edge_limit;
    return gnomon_select(known, most / least, 4.0);
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
fn gnomon_depth_line_within(z0: f32, z1: f32, free0: f32, free1: f32, bend: f32, least: f32, most: f32) -> depth_line
{
    let beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    let all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    var r: depth_line;
    r.z0_ = z0;
    r.z1_ = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
fn gnomon_moving_edge_between(e: gnomon_moving_edge, begin: f32, end: f32) -> gnomon_moving_edge
{
    let left = 1.0 - end;
    var r: gnomon_moving_edge;
    r.e0_ = moving_edge_at(e, begin);
    r.e1_ = 2.0 * ((e.e0_ * left + e.e1_ * end) * (1.0 - begin) + (e.e1_ * left + e.e2_ * end) * begin);
    r.e2_ = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from gnomon_moving_edge_between, each times a linear function: from a0 to a1, from
/// b0 to b1, from c0 to c1.
fn gnomon_moving_edges_combine(e: gnomon_moving_edges, a0: f32, a1: f32, b0: f32, b1: f32, c0: f32,
                               c1: f32) -> gnomon_bernstein_cubic
{
    var r: gnomon_bernstein_cubic;
    r.c0_ = (e.a.e0_ * a0 + e.b.e0_ * b0) + e.c.e0_ * c0;
    r.c1_ = ((e.a.e0_ * a1 + e.a.e1_ * a0) + (e.b.e0_ * b1 + e.b.e1_ * b0)) + (e.c.e0_ * c1 + e.c.e1_ * c0);
    r.c2_ = ((e.a.e1_ * a1 + e.a.e2_ * a0) + (e.b.e1_ * b1 + e.b.e2_ * b0)) + (e.c.e1_ * c1 + e.c.e2_ * c0);
    r.c3_ = (e.a.e2_ * a1 + e.b.e2_ * b1) + e.c.e2_ * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
fn moving_depth_line(m: moving_triangle, e: gnomon_moving_edges, begin: f32, end: f32, divided: f32) -> depth_line
{
    let b = 1.0 - begin;
    let f = 1.0 - end;
    var x: gnomon_moving_edges;
    x.a = gnomon_moving_edge_between(e.a, begin, end);
    x.b = gnomon_moving_edge_between(e.b, begin, end);
    x.c = gnomon_moving_edge_between(e.c, begin, end);
    let n = gnomon_moving_edges_combine(x, m.a.z0_ * b + m.a.z1_ * begin, m.a.z0_ * f + m.a.z1_ * end, m.b.z0_ * b +
                                        m.b.z1_ * begin, m.b.z0_ * f + m.b.z1_ * end, m.c.z0_ * b + m.c.z1_ * begin,
                                        m.c.z0_ * f + m.c.z1_ * end);
    let a_w0 = m.a.w0_ * b + m.a.w1_ * begin;
    let a_w1 = m.a.w0_ * f + m.a.w1_ * end;
    let b_w0 = m.b.w0_ * b + m.b.w1_ * begin;
    let b_w1 = m.b.w0_ * f + m.b.w1_ * end;
    let c_w0 = m.c.w0_ * b + m.c.w1_ * begin;
    let c_w1 = m.c.w0_ * f + m.c.w1_ * end;
    let before = 0.0 < a_w0 && 0.0 < a_w1 && 0.0 < b_w0 && 0.0 < b_w1 && 0.0 < c_w0 && 0.0 < c_w1;
    let by_w = 0.0 < divided;
    let d = gnomon_moving_edges_combine(x, gnomon_select(by_w, a_w0, 1.0), gnomon_select(by_w, a_w1, 1.0),
                                        gnomon_select(by_w, b_w0, 1.0), gnomon_select(by_w, b_w1, 1.0),
                                        gnomon_select(by_w, c_w0, 1.0), gnomon_select(by_w, c_w1, 1.0));
    let free0 = n.c0_ / d.c0_;
    let free1 = n.c3_ / d.c3_;
    let turn0 = d.c1_ - d.c0_;
    let turn1 = d.c2_ - d.c3_;
    let p0 = (n.c1_ - free0 * turn0) - free1 * d.c0_;
    let p1 = (n.c1_ + n.c2_) - (free0 * d.c2_ + free1 * d.c1_);
    let p2 = (n.c2_ - free1 * turn1) - free0 * d.c3_;
    let most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), 0.5 * gnomon_abs(p1));
    let bend = gnomon_select(before, gnomon_depth_nonlinearity(most, d.c0_, d.c3_, turn0, turn1), 4.0);
    return gnomon_depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0,
                                    free1, bend, -1.0, 1.0);
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
fn gnomon_moving_depth_time(begin: f32, end: f32, passed: f32) -> f32
{
    return gnomon_select(passed < 1.0, begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
fn gnomon_depth_trial_begin(begin: f32, end: f32, passed: f32) -> depth_trial
{
    var r: depth_trial;
    r.start = saturate_or_zero(passed);
    r.share = 1.0 - r.start;
    r.settled = 0.0;
    r.piece.t0_ = gnomon_moving_depth_time(begin, end, r.start);
    r.piece.t1_ = end;
    r.piece.z0_ = 1.0;
    r.piece.z1_ = 1.0;
    r.piece.passed = 1.0;
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
fn gnomon_depth_trial_next(given_trial: depth_trial, fit: depth_line, begin: f32, end: f32,
                           tolerance: f32) -> depth_trial
{
    var trial = given_trial;
    let shortest = 0.0322265625;
    let fits = fit.deviation <= tolerance || trial.share <= shortest;
    let parts = gnomon_select(fit.deviation <= 4.0 * tolerance, 2.0, 3.0);
    let shorter = gnomon_max(trial.share / parts, shortest);
    let to = gnomon_min(trial.start + shorter, 1.0);
    trial.piece.z0_ = fit.z0_;
    trial.piece.z1_ = fit.z1_;
    trial.piece.t1_ = gnomon_select(fits, trial.piece.t1_, gnomon_moving_depth_time(begin, end, to));
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
fn moving_depth_piece(m: moving_triangle, e: gnomon_moving_edges, begin: f32, end: f32, passed: f32, divided: f32,
                      tolerance: f32) -> depth_piece
{
    var r = gnomon_depth_trial_begin(begin, end, passed);
    for (var i = 0; i < 6; i++) {
        if (gnomon_any(r.settled < 1.0)) { r = gnomon_depth_trial_next(r,
                                                                       moving_depth_line(m, e, r.piece.t0_, r.piece.t1_,
                                                                                         divided), begin, end,
                                                                       tolerance); }
    }
    return r.piece;
}

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

/// A vertex on the screen, with depth z, time t and inverse_w = 1 / w, which is 1 in orthographic views.
struct prism_vertex { x: f32, y: f32, z: f32, t: f32, inverse_w: f32 }

/// A triangle of a prism.
struct prism_triangle { a: prism_vertex, b: prism_vertex, c: prism_vertex }

/// The side that an edge sweeps: the vertex at its centre. crosses is 1 if the edge at open crosses the edge at close
/// there, else 0.
struct gnomon_prism_side
{
    centre: prism_vertex,
    crosses: f32,
}

/// The corners at shutter open (0) and at shutter close (1), and the sides of the three edges.
struct gnomon_prism
{
    a0_: prism_vertex, b0_: prism_vertex, c0_: prism_vertex, a1_: prism_vertex, b1_: prism_vertex,
    c1_: prism_vertex,
    ab: gnomon_prism_side, bc: gnomon_prism_side, ca: gnomon_prism_side,
}

/// A fragment: covered is 1 or 0, time is in [0, 1] and depth in [-1, 1].
struct prism_fragment { covered: f32, time: f32, depth: f32 }

/// The fragments of one triangle id in one texel: their number, the earliest, the latest, and the nearest four in
/// order.
struct prism_pair
{
    id: f32, count: f32,
    earliest: prism_fragment, latest: prism_fragment,
    first: prism_fragment, second: prism_fragment, third: prism_fragment, fourth: prism_fragment,
}

/// The ranges of a triangle in a texel, count of them, 0 to 2; the remaining ones are empty.
struct prism_ranges
{
    first: depth_time_range, second: depth_time_range,
    count: f32,
}

const prism_no_depth: f32 = 2.0; // behind every fragment

/// The vertex on the screen of a point in clip space at time t. divided is as for moving_depth_at. A vertex with w <= 0
/// or a NaN w produces no fragment.
fn gnomon_prism_vertex_make(x: f32, y: f32, z: f32, w: f32, t: f32, divided: f32) -> prism_vertex
{
    let divisor = gnomon_max(w, 0.0);
    var r: prism_vertex;
    r.x = x / divisor;
    r.y = y / divisor;
    r.z = gnomon_select(0.0 < divided, z / divisor, z);
    r.t = t;
    r.inverse_w = 1.0 / divisor;
    return r;
}

/// The vertex at shutter open.
fn gnomon_prism_vertex_open(v: gnomon_moving_vertex, divided: f32) -> prism_vertex
{
    return gnomon_prism_vertex_make(v.x0_, v.y0_, v.z0_, v.w0_, 0.0, divided);
}

/// The vertex at shutter close.
fn gnomon_prism_vertex_close(v: gnomon_moving_vertex, divided: f32) -> prism_vertex
{
    return gnomon_prism_vertex_make(v.x1_, v.y1_, v.z1_, v.w1_, 1.0, divided);
}

/// The factor of the screen weight in the interpolation of depth: 1 if depth is divided, else 1 / w, as for time.
fn gnomon_prism_depth_weight(v: prism_vertex, divided: f32) -> f32
{
    return gnomon_select(0.0 < divided, 1.0, v.inverse_w);
}

/// The vertex at the fraction `passed` of the way from a to b on the screen, at the time of a.
fn gnomon_prism_vertex_between(a: prism_vertex, b: prism_vertex, passed: f32, divided: f32) -> prism_vertex
{
    let left = 1.0 - passed;
    let weight_a = left * gnomon_prism_depth_weight(a, divided);
    let weight_b = passed * gnomon_prism_depth_weight(b, divided);
    var r: prism_vertex;
    r.x = a.x * left + b.x * passed;
    r.y = a.y * left + b.y * passed;
    r.z = (weight_a * a.z + weight_b * b.z) / (weight_a + weight_b);
    r.t = a.t;
    r.inverse_w = a.inverse_w * left + b.inverse_w * passed;
    return r;
}

/// The side that the edge from a to b sweeps. A centre without a crossing is the same, bit for bit, for b to a.
fn gnomon_prism_side_make(a: gnomon_moving_vertex, b: gnomon_moving_vertex, divided: f32) -> gnomon_prism_side
{
    let a0 = gnomon_prism_vertex_open(a, divided);
    let b0 = gnomon_prism_vertex_open(b, divided);
    let a1 = gnomon_prism_vertex_close(a, divided);
    let b1 = gnomon_prism_vertex_close(b, divided);
    let open_x = b0.x - a0.x;
    let open_y = b0.y - a0.y;
    let close_x = b1.x - a1.x;
    let close_y = b1.y - a1.y;
    let between_x = a1.x - a0.x;
    let between_y = a1.y - a0.y;
    let area = gnomon_sheared_cross(open_x, open_y, close_x, close_y);
    let s = gnomon_sheared_cross(between_x, between_y, close_x, close_y) / area;
    let u = gnomon_sheared_cross(between_x, between_y, open_x, open_y) / area;
    let crosses = 0.0 <= s && s <= 1.0 && 0.0 <= u && u <= 1.0; // false if area is 0

    // The mean in clip space, where the midpoint of the moving edge is.
    let x = 0.25 * ((a.x0_ + b.x0_) + (a.x1_ + b.x1_));
    let y = 0.25 * ((a.y0_ + b.y0_) + (a.y1_ + b.y1_));
    let z = 0.25 * ((a.z0_ + b.z0_) + (a.z1_ + b.z1_));
    let w = 0.25 * ((a.w0_ + b.w0_) + (a.w1_ + b.w1_));
    let middle = gnomon_prism_vertex_make(x, y, z, w, 0.5, divided);
    let open = gnomon_prism_vertex_between(a0, b0, s, divided);
    let close = gnomon_prism_vertex_between(a1, b1, u, divided);
    var r: gnomon_prism_side;
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
fn prism_make(m: moving_triangle, divided: f32) -> gnomon_prism
{
    var p: gnomon_prism;
    p.a0_ = gnomon_prism_vertex_open(m.a, divided);
    p.b0_ = gnomon_prism_vertex_open(m.b, divided);
    p.c0_ = gnomon_prism_vertex_open(m.c, divided);
    p.a1_ = gnomon_prism_vertex_close(m.a, divided);
    p.b1_ = gnomon_prism_vertex_close(m.b, divided);
    p.c1_ = gnomon_prism_vertex_close(m.c, divided);
    p.ab = gnomon_prism_side_make(m.a, m.b, divided);
    p.bc = gnomon_prism_side_make(m.b, m.c, divided);
    p.ca = gnomon_prism_side_make(m.c, m.a, divided);
    return p;
}

/// The vertex `first` for k <= 0, `second` for k = 1, else `third`.
fn gnomon_prism_choice(k: f32, first: prism_vertex, second: prism_vertex, third: prism_vertex) -> prism_vertex
{
    let is_first = k < 0.5;
    let is_second = k < 1.5;
    var r: prism_vertex;
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
fn prism_triangle_make(p: gnomon_prism, k: f32) -> prism_triangle
{
    let side = gnomon_select(k < 3.5, 0.0, gnomon_select(k < 7.5, 1.0, 2.0));
    let i = k - 4.0 * side;
    let from0 = gnomon_prism_choice(side, p.a0_, p.b0_, p.c0_);
    let to0 = gnomon_prism_choice(side, p.b0_, p.c0_, p.a0_);
    let to1 = gnomon_prism_choice(side, p.b1_, p.c1_, p.a1_);
    let from1 = gnomon_prism_choice(side, p.a1_, p.b1_, p.c1_);
    let crosses = gnomon_select(side < 0.5, p.ab.crosses, gnomon_select(side < 1.5, p.bc.crosses, p.ca.crosses));

    var r: prism_triangle;
    r.a = gnomon_prism_choice(i, from0, to0, gnomon_prism_choice(i - 2.0, to1, from1, from1));
    r.b = gnomon_prism_choice(i, to0, to1, gnomon_prism_choice(i - 2.0, from1, from0, from0));
    r.c = gnomon_prism_choice(side, p.ab.centre, p.bc.centre, p.ca.centre);
    let cap = k - 11.0;
    r.a = gnomon_prism_choice(cap, r.a, p.a0_, p.a1_);
    r.b = gnomon_prism_choice(cap, r.b, p.b0_, p.b1_);
    r.c = gnomon_prism_choice(cap, r.c, p.c0_, p.c1_);

    let odd = (0.5 < i && i < 1.5) || 2.5 < i;
    let none = (0.0 < crosses && k < 11.5 && !odd) || !(-0.5 < k && k < 13.5);
    let dropped = gnomon_select(none, 0.0, 1.0);
    r.b = gnomon_prism_choice(dropped, r.a, r.b, r.b);
    r.c = gnomon_prism_choice(dropped, r.a, r.c, r.c);
    return r;
}

/// The edge function of p and q at the sample (s_x, s_y).
fn gnomon_prism_edge(p: prism_vertex, q: prism_vertex, s_x: f32, s_y: f32) -> f32
{
    return gnomon_sheared_cross(p.x - s_x, p.y - s_y, q.x - s_x, q.y - s_y);
}

/// The side of the edge from p to q that the sample is on, 1 or -1, for edge function e. If e is 0, the side of a point
/// slightly further along x and, far less, along y. 0 for an edge without length.
fn gnomon_prism_edge_side(p: prism_vertex, q: prism_vertex, e: f32) -> f32
{
    let level = gnomon_select(q.x < p.x, -1.0, gnomon_select(p.x < q.x, 1.0, 0.0));
    let tie = gnomon_select(q.y < p.y, 1.0, gnomon_select(p.y < q.y, -1.0, level));
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
fn prism_fragment_at(v: prism_triangle, s_x: f32, s_y: f32, divided: f32) -> prism_fragment
{
    let a = gnomon_prism_edge(v.b, v.c, s_x, s_y);
    let b = gnomon_prism_edge(v.c, v.a, s_x, s_y);
    let c = gnomon_prism_edge(v.a, v.b, s_x, s_y);
    let sides = (gnomon_prism_edge_side(v.b, v.c, a) + gnomon_prism_edge_side(v.c, v.a, b)) +
                gnomon_prism_edge_side(v.a, v.b, c);
    let depth_a = a * gnomon_prism_depth_weight(v.a, divided);
    let depth_b = b * gnomon_prism_depth_weight(v.b, divided);
    let depth_c = c * gnomon_prism_depth_weight(v.c, divided);
    let depth = ((depth_a * v.a.z + depth_b * v.b.z) + depth_c * v.c.z) / ((depth_a + depth_b) + depth_c);
    let time_a = gnomon_product(a, v.a.inverse_w); // not contracted: a cap's time is exactly 0 or 1
    let time_b = gnomon_product(b, v.b.inverse_w);
    let time_c = gnomon_product(c, v.c.inverse_w);
    let weight = (time_a + time_b) + time_c;
    let size = gnomon_abs((a + b) + c); // inside all have one sign
    let limit = gnomon_moving_edge_limit;
    let known = 0.0 < size && size < limit && 0.0 < gnomon_abs(weight) && gnomon_abs(weight) < limit;
    var f: prism_fragment;
    f.covered = gnomon_select(known && gnomon_abs(sides) == 3.0 && depth == depth, 1.0, 0.0);
    f.time = saturate_or_zero(((time_a * v.a.t + time_b * v.b.t) + time_c * v.c.t) / weight);
    f.depth = gnomon_max(gnomon_min(depth, 1.0), -1.0); // a NaN becomes 1
    return f;
}

/// The fragment b if chosen is 0, else a.
fn gnomon_prism_fragment_choice(chosen: f32, a: prism_fragment, b: prism_fragment) -> prism_fragment
{
    let second = chosen == 0.0;
    var r: prism_fragment;
    r.covered = gnomon_select(second, b.covered, a.covered);
    r.time = gnomon_select(second, b.time, a.time);
    r.depth = gnomon_select(second, b.depth, a.depth);
    return r;
}

/// 1 if a is in front of b, or at the same depth and earlier; else 0.
fn gnomon_prism_fragment_before(a: prism_fragment, b: prism_fragment) -> f32
{
    return gnomon_select(a.depth < b.depth || (a.depth == b.depth && a.time < b.time), 1.0, 0.0);
}

/// The state before the first fragment of the triangle with this id.
fn prism_pair_begin(id: f32) -> prism_pair
{
    var none: prism_fragment;
    none.covered = 0.0;
    none.time = 1.0;
    none.depth = prism_no_depth;
    var state: prism_pair;
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
fn prism_pair_add(given_state: prism_pair, given_f: prism_fragment) -> prism_pair
{
    var f = given_f;
    var state = given_state;
    let known = 0.0 <= f.time && f.time <= 1.0 && -1.0 <= f.depth && f.depth <= 1.0;
    let some = 0.0 < f.covered && known;
    let alone = state.count == 0.0;
    let sooner = f.time < state.earliest.time || (f.time == state.earliest.time && f.depth < state.earliest.depth);
    let later = state.latest.time < f.time || (f.time == state.latest.time && state.latest.depth < f.depth);
    let is_earliest = gnomon_select(some && (alone || sooner), 1.0, 0.0);
    let is_latest = gnomon_select(some && (alone || later), 1.0, 0.0);
    state.earliest = gnomon_prism_fragment_choice(is_earliest, f, state.earliest);
    state.latest = gnomon_prism_fragment_choice(is_latest, f, state.latest);
    state.count = state.count + gnomon_select(some, 1.0, 0.0);

    // Insertion into the sorted four: the farther of two goes on. An ignored fragment goes past all four.
    f.depth = gnomon_select(some, f.depth, prism_no_depth);
    f.time = gnomon_select(some, f.time, 1.0);
    var before = gnomon_prism_fragment_before(f, state.first);
    var next = gnomon_prism_fragment_choice(before, state.first, f);
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
fn gnomon_prism_range_between(a: prism_fragment, b: prism_fragment, id: f32) -> depth_time_range
{
    return range_between(a.time, a.depth, b.time, b.depth, id);
}

/// The ranges of the fragments: between two fragments; of four, between the front two and between the rear two. The
/// paper does not treat other numbers, which occur if sides fold (six and more) and by rounding (odd numbers). A single
/// fragment does not tell how long the triangle stays and gives no range. Three, or more than four, give one range from
/// the earliest to the latest, so that no shadow is lost, though the range may last too long.
/// Source: Hong & Oh 2018, Sec. 4.3
fn prism_pair_end(state: prism_pair) -> prism_ranges
{
    let some = 1.0 < state.count;
    let two = state.count == 4.0;
    let whole = gnomon_prism_range_between(state.earliest, state.latest, state.id);
    let front = gnomon_prism_range_between(state.first, state.second, state.id);
    let rear = gnomon_prism_range_between(state.third, state.fourth, state.id);
    var r: prism_ranges;
    r.first = gnomon_range_select(some, gnomon_range_select(two, front, whole), range_empty(state.id));
    r.second = gnomon_range_select(two, rear, range_empty(state.id));
    r.count = gnomon_select(some, gnomon_select(two, 2.0, 1.0), 0.0);
    return r;
}

/// The size in bytes of a shadow map of prisms: 16 for a fragment (depth, time, id, link), 24 for a range (two times,
/// two depths, id, link), and 8 for a texel (the heads of its two lists).
/// Error: exact in float up to 2^27 bytes.
/// Source: Hong & Oh 2018, Eq. 2
fn prism_map_bytes(fragments: f32, ranges: f32, texels: f32) -> f32
{
    return (16.0 * fragments + 24.0 * ranges) + 8.0 * texels;
}

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

/// The weight in shadow so far, that of all steps so far, the transmittance up to the next step, and that of one step.
struct ray_march { shadowed: f32, weight: f32, transmittance: f32, step: f32 }

/// The state before the first step.
/// Domain: any transmittance of one step, limited to [0, 1].
/// NaN: 1, clear air.
fn ray_march_begin(step_transmittance: f32) -> ray_march
{
    var r: ray_march;
    r.shadowed = 0.0;
    r.weight = 0.0;
    r.transmittance = 1.0;
    r.step = clamp_or_high(step_transmittance, 0.0, 1.0);
    return r;
}

/// The state after one more step, at depth z_f, where the shadow map has depth z.
/// Domain: any depths.
/// NaN: lit, for either.
fn ray_march_add(given_state: ray_march, z: f32, z_f: f32) -> ray_march
{
    var state = given_state;
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
fn ray_march_end(state: ray_march) -> f32 { return saturate_or_zero(state.shadowed / state.weight); }

const ray_march_jitter_x: f32 = 0x1.12e286p-4; // 0.06711056
const ray_march_jitter_y: f32 = 0x1.7e8b2p-8; // 0.00583715
const ray_march_jitter_scale: f32 = 0x1.a7dd04p+5; // 52.9829189

/// x - floor(x), in [0, 1).
/// Domain: |x| <= 2^21.
fn gnomon_ray_march_fraction(x: f32) -> f32
{
    let fraction = x - nearest_integer(x - 0.5);
    return gnomon_select(0.0 <= fraction && fraction < 1.0, fraction, 0.0); // also where nothing is rounded
}

/// A number in [0, 1) for the pixel at column x and row y: interleaved gradient noise, of which the values of 3 x 3
/// pixels lie evenly in [0, 1), so that a small blur removes what it leaves.
/// Domain: whole numbers, limited to [0, 65536].
/// NaN: that of column or row 65536.
/// Source: Jimenez 2014
fn ray_march_jitter(x: f32, y: f32) -> f32
{
    let column = clamp_or_high(x, 0.0, 65536.0);
    let row = clamp_or_high(y, 0.0, 65536.0);
    let inner = gnomon_ray_march_fraction(ray_march_jitter_x * column + ray_march_jitter_y * row);
    return gnomon_ray_march_fraction(ray_march_jitter_scale * inner);
}

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

/// A fragment: time t in [0, 1], depth z in [-1, 1], and the id of a triangle, a whole number from 0.
struct gnomon_timed_fragment { t: f32, z: f32, id: f32 }

/// The nearest fragment; the number of fragments with its id, the farthest depth of these, and ends, 1 if one of these
/// is at the other end of the shutter, else 0; front, the nearest depth of all other fragments.
struct gnomon_fragment_cover
{
    nearest: gnomon_timed_fragment,
    count: f32, far_depth: f32, ends: f32,
    front: f32,
}

/// The state before the first fragment. Only fragments nearer than `cleared`, the depth of the cleared map, are kept.
fn nearest_fragment_begin(cleared: f32) -> gnomon_timed_fragment
{
    var r: gnomon_timed_fragment;
    r.t = 0.0;
    r.z = cleared;
    r.id = -1.0;
    return r;
}

/// The nearer of two fragments; at the same depth the one with the lesser id, then the earlier one.
/// Domain: f with id >= 0 and time in [0, 1]; others are ignored.
/// NaN: f is ignored.
/// Source: Hong & Oh 2017
fn nearest_fragment_add(given_nearest: gnomon_timed_fragment, f: gnomon_timed_fragment) -> gnomon_timed_fragment
{
    var nearest = given_nearest;
    let before = f.id < nearest.id || (f.id == nearest.id && f.t < nearest.t);
    let known = 0.0 <= f.id && 0.0 <= f.t && f.t <= 1.0;
    let taken = known && (f.z < nearest.z || (f.z == nearest.z && before));
    nearest.t = gnomon_select(taken, f.t, nearest.t);
    nearest.z = gnomon_select(taken, f.z, nearest.z);
    nearest.id = gnomon_select(taken, f.id, nearest.id);
    return nearest;
}

/// The state before the first fragment of the second pass, from the result of the first pass.
fn fragment_cover_begin(nearest: gnomon_timed_fragment) -> gnomon_fragment_cover
{
    var state: gnomon_fragment_cover;
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
fn fragment_cover_add(given_state: gnomon_fragment_cover, f: gnomon_timed_fragment) -> gnomon_fragment_cover
{
    var state = given_state;
    let known = 0.0 <= f.id && 0.0 <= f.t && f.t <= 1.0 && f.z == f.z;
    let same = known && f.id == state.nearest.id;
    let other = known && !(f.id == state.nearest.id);
    let end = same && 1.0 <= gnomon_abs(f.t - state.nearest.t);
    state.count = state.count + gnomon_select(same, 1.0, 0.0);
    state.ends = gnomon_select(end, 1.0, state.ends);
    state.far_depth = gnomon_select(same && state.far_depth < f.z, f.z, state.far_depth);
    state.front = gnomon_select(other && f.z < state.front, f.z, state.front);
    return state;
}

/// The cover as a range over the whole shutter, or an empty range if there is none.
fn fragment_cover_end(state: gnomon_fragment_cover) -> depth_time_range
{
    let alone = state.count == 2.0 && state.far_depth <= state.front;
    let known = 0.0 <= state.nearest.id && -1.0 <= state.nearest.z;
    let covers = known && 0.0 < state.ends && alone;
    let n = state.nearest;
    let cover = range_between(n.t, n.z, 1.0 - n.t, state.far_depth, n.id);
    return gnomon_range_select(covers, cover, range_empty(-1.0));
}

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

/// The view distance that ends a cascade: a mean of logarithmic and even splits of the distances from near_distance to
/// far_distance. fraction is (i + 1) / n for cascade i of n, evenness the weight of even splits.
/// Domain: 0 < near_distance < far_distance; fraction and evenness in [0, 1], else as for the nearer end.
/// NaN: NaN in a distance; a fraction counts as 0, an evenness as 0.
/// Error: relative, 25 2^-p where far_distance / near_distance <= 2^20.
/// Source: Zhang 2006
fn cascade_split(near_distance: f32, far_distance: f32, fraction: f32, evenness: f32) -> f32
{
    let f = saturate_or_zero(fraction);
    let e = saturate_or_zero(evenness);
    let logarithmic = near_distance * polynomial_exp(f * polynomial_log(far_distance / near_distance));
    let even = near_distance + f * (far_distance - near_distance);
    return logarithmic + e * (even - logarithmic);
}

/// The part in [0, 1] of a band that lies between its border and a point inside: distance_inside / band.
/// NaN: 0.
fn gnomon_cascade_inside(distance_inside: f32, band: f32) -> f32
{
    let w = saturate_or_zero(distance_inside / gnomon_select(0.0 < band, band, 1.0));
    return gnomon_select(0.0 < band, w, gnomon_select(0.0 <= distance_inside, 1.0, 0.0));
}

/// The weight in [0, 1] of a cascade for receivers up to the view distance end_distance: 1 up to a band before its end,
/// 0 from the end on. Without a band, 1 up to the end and on it.
/// Domain: any; a band that is not positive is none.
/// NaN: 0.
/// Error: 2 2^-p of end_distance over band.
fn cascade_weight_by_distance(distance_: f32, end_distance: f32, band: f32) -> f32
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
fn cascade_weight_by_projection(u: f32, v: f32, z: f32, margin: f32, band: f32) -> f32
{
    let x = gnomon_abs(u - 0.5);
    let y = gnomon_abs(v - 0.5);
    let inside = (0.5 - margin) - gnomon_max(y, x);
    let known = y <= 0.5 && gnomon_abs(z) <= 1.0; // a NaN in u is one in inside
    return gnomon_select(known, gnomon_cascade_inside(inside, band), 0.0);
}

/// The blended intensity of the cascades so far, and the part in [0, 1] that is left to those to come.
struct cascade_blend { intensity: f32, rest: f32 }

/// The part in [0, 1] that a cascade with this weight will have in the result.
/// NaN: 0.
fn cascade_share(state: cascade_blend, weight: f32) -> f32
{
    return saturate_or_zero(state.rest) * saturate_or_zero(weight);
}

/// The state after a cascade with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
fn cascade_add(given_state: cascade_blend, weight: f32, intensity: f32) -> cascade_blend
{
    var state = given_state;
    let share = cascade_share(state, weight);
    state.intensity = state.intensity + share * saturate_or_zero(intensity);
    state.rest = state.rest - share;
    return state;
}

/// The state after the first cascade, with its weight and its shadow intensity.
/// NaN: a weight counts as 0, an intensity as lit.
fn cascade_begin(weight: f32, intensity: f32) -> cascade_blend
{
    var r: cascade_blend;
    r.intensity = 0.0;
    r.rest = 1.0;
    return cascade_add(r, weight, intensity);
}

/// Shadow intensity in [0, 1]. The part that no cascade took is lit.
/// NaN: 0, lit.
/// Error: 3 n 2^-p for n cascades.
fn cascade_end(state: cascade_blend) -> f32 { return saturate_or_zero(state.intensity); }

/// The number of cascades passed over so far, and 1 while the search goes on, 0 afterwards.
struct cascade_index { index: f32, searching: f32 }

/// The state after a cascade with its weight. index ends as the index of the first cascade whose weight exceeds
/// threshold, or as the number of cascades if there is none. By threshold 0 that is the finest that may be read at all.
/// NaN: a weight counts as 0.
fn cascade_index_add(given_state: cascade_index, weight: f32, threshold: f32) -> cascade_index
{
    var state = given_state;
    state.searching = gnomon_select(threshold < weight, 0.0, state.searching);
    state.index = state.index + state.searching;
    return state;
}

/// The state after the first cascade with its weight.
/// NaN: a weight counts as 0.
fn cascade_index_begin(weight: f32, threshold: f32) -> cascade_index
{
    var r: cascade_index;
    r.index = 0.0;
    r.searching = 1.0;
    return cascade_index_add(r, weight, threshold);
}

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

/// The number of terms. damping >= 0 attenuates term k by exp(-damping (k / terms)^2) against ringing (Annen et al.
/// 2007). offset is subtracted from z_f, so that a surface in its own map lies where the series has come down to 0: the
/// first zero is at 1.926 / (pi terms span), where the sine integral is pi / 2. span in (0, 1] is the part of a half
/// period that depths in [-1, 1] fill. A span below 1 keeps a near receiver before a far texel from reaching the next
/// edge of the wave.
struct convolution_settings { terms: f32, damping: f32, offset: f32, span: f32 }

/// Cosine and sine of a_k z, and of the step from one term to the next.
struct convolution_phase { cosine: f32, sine: f32, step_cosine: f32, step_sine: f32 }

/// The phase of the first term at z.
/// Domain: z in [-2, 2], span in [0, 1]. For a span of 0 the series is 1/2.
/// NaN: NaN.
fn convolution_phase_at(z: f32, span: f32) -> convolution_phase
{
    let angle = gnomon_trigonometry_half_pi * span * z;
    let first = polynomial_cosine_sine(angle);
    let step = polynomial_cosine_sine(2.0 * angle);
    var r: convolution_phase;
    r.cosine = first.cosine;
    r.sine = first.sine;
    r.step_cosine = step.cosine;
    r.step_sine = step.sine;
    return r;
}

/// The phase of the first term of the texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane.
fn convolution_encode(z: f32, settings: convolution_settings) -> convolution_phase
{
    return convolution_phase_at(clamp_or_high(z, -1.0, 1.0), settings.span);
}

/// The phase of the next term, by rotation.
/// Error: of both values of term k, 8 k 2^-p.
fn convolution_next(phase: convolution_phase) -> convolution_phase
{
    var r = phase;
    r.cosine = phase.cosine * phase.step_cosine - phase.sine * phase.step_sine;
    r.sine = phase.sine * phase.step_cosine + phase.cosine * phase.step_sine;
    return r;
}

/// The weight w_k with its damping, k = 1, 2, ...: constant over texels and receivers, so best computed once.
/// Domain: terms at least 1, damping at least 0. An infinite damping leaves no term, and the series is 1/2.
/// NaN: NaN, which makes everything lit.
fn convolution_weight(k: f32, settings: convolution_settings) -> f32
{
    let ratio = k / settings.terms;
    return gnomon_trigonometry_two_over_pi * polynomial_exp(-settings.damping * (ratio * ratio)) / (2.0 * k - 1.0);
}

/// The receiver's phase at the next term, and the sum so far.
struct convolution_sum
{
    receiver: convolution_phase,
    intensity: f32,
}

/// The state before the first term.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: lit, also for an offset or span of NaN.
fn convolution_begin(z_f: f32, settings: convolution_settings) -> convolution_sum
{
    var r: convolution_sum;
    r.receiver = convolution_phase_at(clamp_or_nan(z_f, -1.0, 1.0) - settings.offset, settings.span);
    r.intensity = 0.5;
    return r;
}

/// The state after the next term of the filtered map.
fn convolution_add(given_state: convolution_sum, cosine: f32, sine: f32, weight: f32) -> convolution_sum
{
    var state = given_state;
    state.intensity = state.intensity + weight * (state.receiver.sine * cosine - state.receiver.cosine * sine);
    state.receiver = convolution_next(state.receiver);
    return state;
}

/// Shadow intensity in [0, 1].
/// NaN: 0, lit.
/// Error: against the exact series over 16 terms, 150 2^-p.
/// Source: Annen 2007, Sec. 3
fn convolution_end(state: convolution_sum) -> f32 { return saturate_or_zero(state.intensity); }

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

/// A face, texture coordinates on it, and the distance from the centre along the face's axis.
struct cube_position { face: f32, u: f32, v: f32, distance: f32 }

/// A direction from the centre of the cube, of any length.
struct cube_vector { x: f32, y: f32, z: f32 }

/// The face that a direction from the light points to, with the place on it. Among equal coordinates z has precedence
/// over y, and y over x.
/// Domain: any finite direction; for the zero vector the middle of face 4, at distance 0.
/// NaN: some face and some place on it.
/// Error: u and v 2 2^-p, distance none.
fn cube_position_from_direction(x: f32, y: f32, z: f32) -> cube_position
{
    let ax = gnomon_abs(x);
    let ay = gnomon_abs(y);
    let az = gnomon_abs(z);
    let along_z = ax <= az && ay <= az;
    let along_y = ax <= ay && !along_z;
    let major = gnomon_select(along_z, z, gnomon_select(along_y, y, x));
    let backward = major < 0.0;
    let sign = gnomon_select(backward, -1.0, 1.0);
    let across = gnomon_select(along_z, sign * x, gnomon_select(along_y, x, -1.0 * sign * z));
    let down = gnomon_select(along_y, sign * z, -1.0 * y);
    var r: cube_position;
    r.distance = gnomon_abs(major);
    r.face = gnomon_select(along_z, 4.0, gnomon_select(along_y, 2.0, 0.0)) + gnomon_select(backward, 1.0, 0.0);
    let divisor = gnomon_select(0.0 < r.distance, r.distance, 1.0);
    r.u = clamp_or_high(0.5 * (across / divisor) + 0.5, 0.0, 1.0);
    r.v = clamp_or_high(0.5 * (down / divisor) + 0.5, 0.0, 1.0);
    return r;
}

/// The direction to a place on a face. Beyond an edge, by less than the face's extent, the place lies on the face
/// folded over that edge.
/// Domain: face 0, 1, ..., 5; u and v in [-1, 2].
/// NaN: NaN in a coordinate.
/// Error: 2 2^-p in each coordinate, the largest of which is 1 on the face.
fn cube_direction(face: f32, u: f32, v: f32) -> cube_vector
{
    let s = 2.0 * u - 1.0;
    let t = 2.0 * v - 1.0;
    let across = clamp_or_nan(s, -1.0, 1.0);
    let down = clamp_or_nan(t, -1.0, 1.0);
    // The folded part is as far along the neighbour as the place is beyond the edge.
    let ahead = (1.0 - gnomon_abs(s - across)) - gnomon_abs(t - down);
    let along_z = 3.5 < face;
    let along_y = 1.5 < face && !along_z;
    let backward = face == 1.0 || face == 3.0 || face == 5.0;
    let sign = gnomon_select(backward, -1.0, 1.0);
    let up = -1.0 * down;
    var r: cube_vector;
    r.x = gnomon_select(along_z, sign * across, gnomon_select(along_y, across, sign * ahead));
    r.y = gnomon_select(along_y, sign * ahead, up);
    r.z = gnomon_select(along_z, sign * ahead, gnomon_select(along_y, sign * down, -1.0 * sign * across));
    return r;
}

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.

/// The unevaluated sum high + low.
struct gnomon_double_word { high: f32, low: f32 }

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
fn gnomon_dekker_product_error(a: f32, b: f32, p: f32) -> f32
{
    let ah = gnomon_high_part(a);
    let bh = gnomon_high_part(b);
    let al = gnomon_difference(a, ah);
    let bl = gnomon_difference(b, bh);
    let e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
fn two_product(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_product(a, b);
    r.low = gnomon_dekker_product_error(a, b, r.high);
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
fn two_difference(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    let bv = gnomon_difference(r.high, a);
    let av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
fn two_difference_ordered(a: f32, b: f32) -> gnomon_double_word
{
    var r: gnomon_double_word;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
fn subtract_product_ordered(c: f32, a: f32, b: f32) -> gnomon_double_word
{
    let p = two_product(a, b);
    var r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
fn subtract_product_rounded(c: f32, a: f32, b: f32) -> f32
{
    let p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
fn gnomon_double_word_minor(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word,
                            d: gnomon_double_word) -> gnomon_double_word
{
    let p = two_product(a.high, b.high);
    let q = two_product(c.high, d.high);
    var r = two_difference(p.high, q.high);
    let cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for gnomon_double_word_minor.
/// Error: 2 roundings of the result beside that of gnomon_double_word_minor.
fn gnomon_double_word_determinant(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word) -> f32
{
    let p = two_product(a.high, c.high);
    let q = two_product(b.high, b.high);
    let cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

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

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
fn gnomon_depth_bias_limit(bias: f32) -> f32 { return gnomon_min(2.0, gnomon_max(bias, 0.0)); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
fn depth_bias_slope_scaled(across: f32, along: f32, rise: f32, steepest: f32) -> f32
{
    return gnomon_depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
struct depth_gradient { x: f32, y: f32 }

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
fn gnomon_depth_gradient_minor(a: f32, b: f32, c: f32, d: f32) -> f32
{
    let p = two_product(a, b);
    let q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in
/// texels, and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
fn depth_gradient_from_derivatives(x1: f32, y1: f32, depth1: f32, x2: f32, y2: f32, depth2: f32) -> depth_gradient
{
    let determinant = gnomon_depth_gradient_minor(x1, y2, x2, y1);
    var r: depth_gradient;
    r.x = gnomon_depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = gnomon_depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of
/// the filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
fn depth_bias_receiver_plane(gradient: depth_gradient, half_width_x: f32, half_width_y: f32, limit: f32) -> f32
{
    let rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
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
fn depth_bias_texel_plane(gradient: depth_gradient, offset_x: f32, offset_y: f32, limit: f32, epsilon: f32) -> f32
{
    let behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, 0.0);
    return gnomon_depth_bias_limit(gnomon_depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
}

// filters/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).

/// E[exp(c z)].
struct exponential_moment { warped: f32 }

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
struct exponential_settings { exponent: f32 }

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
fn exponential_encode(z: f32, settings: exponential_settings) -> exponential_moment
{
    var r: exponential_moment;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, -1.0, 1.0));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in
/// float shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
fn exponential_intensity(filtered: exponential_moment, z_f: f32, settings: exponential_settings) -> f32
{
    return saturate_or_zero(1.0 - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(1.0, z_f)));
}

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
struct variance_moments { mean: f32, square: f32 }

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
struct variance_settings { minimum_variance: f32 }

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn variance_encode(z: f32) -> variance_moments
{
    var r: variance_moments;
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
fn cantelli_lower(moments: variance_moments, receiver: f32, minimum_variance: f32) -> f32
{
    let variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    let d = gnomon_max(0.0, receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
fn variance_intensity(filtered: variance_moments, z_f: f32, settings: variance_settings) -> f32
{
    return cantelli_lower(filtered, gnomon_min(1.0, z_f), settings.minimum_variance);
}

// filters/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.

/// First and second moment of either warped depth.
struct exponential_variance_moments { positive: f32, positive_square: f32, negative: f32, negative_square: f32 }

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
struct exponential_variance_settings { positive_exponent: f32, negative_exponent: f32, minimum_variance: f32 }

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
fn gnomon_exponential_variance_warp(z: f32, settings: exponential_variance_settings) -> exponential_variance_moments
{
    var r: exponential_variance_moments;
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
fn exponential_variance_encode(z: f32, settings: exponential_variance_settings) -> exponential_variance_moments
{
    return gnomon_exponential_variance_warp(clamp_or_high(z, -1.0, 1.0), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
fn exponential_variance_side(given_moments: variance_moments, warped: f32, exponent: f32, minimum_variance: f32) -> f32
{
    var moments = given_moments;
    let scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < 1.0, 1125899906842624.0, 1.0);
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    let slope = exponent * (warped * scale);
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
fn exponential_variance_intensity(filtered: exponential_variance_moments, z_f: f32,
                                  settings: exponential_variance_settings) -> f32
{
    var positive: variance_moments;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    var negative: variance_moments;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    let receiver = gnomon_exponential_variance_warp(clamp_or_nan(z_f, -1.0, 1.0), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
}

// filters/layered_variance.h ------------------------------------------------------------------------------------------
// Layered variance shadow maps (Lauritzen & McCool 2008, "Layered variance shadow maps", section 3): depth is cut into
// layers, and each has a variance shadow map of the depth clamped to it and stretched to [-1, 1]. Clamping keeps the
// order of depths, so that every layer bounds the shadow intensity from below, and the largest bound holds. Depths in
// front of a layer are clamped to its front: only occluders and receivers that share a layer leak light.
//
//     state = layered_variance_begin(z_f);
//     state = layered_variance_add(state, filtered, settings);      for every layer, or just for the receiver's own
//     intensity = layered_variance_end(state);

/// A layer holds depths within 1 / scale of its centre; the minimum variance is that of the stretched depth.
struct layered_variance_settings { centre: f32, scale: f32, minimum_variance: f32 }

/// The layer's own depth of a depth z, in [-1, 1].
/// Domain: any z; scale at least 0. For 0 the layer tells no depths apart; an infinite scale is a shadow test at the
/// centre. A negative scale turns the order of depths around.
/// NaN: NaN.
fn layered_variance_depth(z: f32, settings: layered_variance_settings) -> f32
{
    return clamp_or_nan((z - settings.centre) * settings.scale, -1.0, 1.0);
}

/// The layer's moments of one depth z.
/// Domain: any z.
/// NaN: the far end of the layer, which shadows nothing.
fn layered_variance_encode(z: f32, settings: layered_variance_settings) -> variance_moments
{
    // Clamp once, not by layered_variance_depth and then by variance_encode: clang 14 drops the second clamp, and a
    // NaN would stay a NaN.
    var r: variance_moments;
    r.mean = clamp_or_high((z - settings.centre) * settings.scale, -1.0, 1.0);
    r.square = r.mean * r.mean;
    return r;
}

/// The receiver's depth, and the largest bound so far.
struct layered_variance { receiver: f32, intensity: f32 }

/// The state before the first layer.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: lit.
fn layered_variance_begin(z_f: f32) -> layered_variance
{
    var r: layered_variance;
    r.receiver = gnomon_min(1.0, z_f);
    r.intensity = 0.0;
    return r;
}

/// The state after one more layer with its filtered moments.
/// NaN: a layer with a NaN moment, centre or scale bounds nothing.
fn layered_variance_add(given_state: layered_variance, filtered: variance_moments,
                        settings: layered_variance_settings) -> layered_variance
{
    var state = given_state;
    let receiver = layered_variance_depth(state.receiver, settings);
    state.intensity = gnomon_max(state.intensity, cantelli_lower(filtered, receiver, settings.minimum_variance));
    return state;
}

/// Shadow intensity in [0, 1], never above percentage-closer filtering but for rounding.
/// NaN: 0, lit.
/// Error: that of cantelli_lower for the layers' own depths, with r = 8 2^-p, the largest of all.
/// Source: Lauritzen & McCool 2008, Sec. 3
fn layered_variance_end(state: layered_variance) -> f32 { return saturate_or_zero(state.intensity); }

// filters/percentage_closer.h -----------------------------------------------------------------------------------------
// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);

/// The receiver's depth, and the weight in front of the receiver so far.
struct percentage_closer { receiver: f32, shadowed: f32 }

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
fn percentage_closer_begin(z_f: f32) -> percentage_closer
{
    var r: percentage_closer;
    r.receiver = gnomon_min(1.0, z_f);
    r.shadowed = 0.0;
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
fn percentage_closer_add(given_state: percentage_closer, z: f32, weight: f32) -> percentage_closer
{
    var state = given_state;
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, 0.0);
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
fn percentage_closer_end(state: percentage_closer) -> f32 { return saturate_or_zero(state.shadowed); }

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

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
fn bias_weight_of_roundings(w: f32, n: f32) -> f32
{
    let nw = gnomon_max(1.0, n) * w;
    return nw / ((1.0 - w) + nw);
}

// moments/bias.h, four moments ----------------------------------------------------------------------------------------

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
const bias4_raw_b2_: f32 = 0x1.a7e824p-2; // 0.41397147664677789
const bias4_raw_b4_: f32 = 0x1.a7e824p-2; // 0.41397147664677789
const bias4_raw_paper_b2_: f32 = 0.375;
const bias4_raw_paper_b4_: f32 = 0.375;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
const bias4_theta_b2_: f32 = 0x1.53ec94p-1; // 0.66391434671237689
const bias4_theta_b4_: f32 = 0x1.53ec94p-1; // 0.66391434671237689
const bias4_theta_paper_b2_: f32 = 0x1.418938p-1; // 0.628
const bias4_theta_paper_b4_: f32 = 0x1.418938p-1; // 0.628

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
fn moments4_add_bias(given_b: moments4_, bias2: f32, bias4: f32, alpha: f32) -> moments4_
{
    var b = given_b;
    let keep = 1.0 - alpha;
    b.b1_ = keep * b.b1_;
    b.b2_ = keep * b.b2_ + alpha * bias2;
    b.b3_ = keep * b.b3_;
    b.b4_ = keep * b.b4_ + alpha * bias4;
    return b;
}

// moments/bias.h, six moments -----------------------------------------------------------------------------------------

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
const bias6_raw_b2_: f32 = 0x1.ae3cc8p-2; // 0.42015374983242804
const bias6_raw_b4_: f32 = 0x1.268268p-2; // 0.2876068288776971
const bias6_raw_b6_: f32 = 0x1.077bbcp-2; // 0.25730795870391842

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
const gnomon_bias6_theta_b2_: f32 = 0x1.39c714p-1; // 0.61284694380550628
const gnomon_bias6_theta_b4_: f32 = 0x1.0ca57p-1; // 0.52469968779048582
const gnomon_bias6_theta_b6_: f32 = 0x1.025ee6p-1; // 0.50463026403505464
const bias6_paper_b2_: f32 = 0x1.1cfaacp-1; // 0.5566
const bias6_paper_b4_: f32 = 0x1.f4bc6ap-2; // 0.489
const bias6_paper_b6_: f32 = 0x1.ea2eb6p-2; // 0.47869382

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
fn moments6_add_bias(given_b: moments6_, bias2: f32, bias4: f32, bias6: f32, alpha: f32) -> moments6_
{
    var b = given_b;
    let keep = 1.0 - alpha;
    b.b1_ = keep * b.b1_;
    b.b2_ = keep * b.b2_ + alpha * bias2;
    b.b3_ = keep * b.b3_;
    b.b4_ = keep * b.b4_ + alpha * bias4;
    b.b5_ = keep * b.b5_;
    b.b6_ = keep * b.b6_ + alpha * bias6;
    return b;
}

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.

/// The two roots, in no particular order.
struct gnomon_quadratic_result { first: f32, second: f32 }

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
fn quadratic_roots(a: f32, b: f32, c: f32) -> gnomon_quadratic_result
{
    let r = gnomon_sqrt(gnomon_max(b * b - a * c, 0.0));
    let t = gnomon_select(b > 0.0, -(b + r), r - b);
    var x: gnomon_quadratic_result;
    x.first = t / a;
    x.second = c / t;
    return x;
}

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
struct hamburger_bounds { lower: f32, upper: f32, weight: f32 }

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
fn bounds_intensity(bounds: hamburger_bounds, overestimation: f32) -> f32
{
    return saturate_or_zero(bounds.lower + (1.0 - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
fn over_darken(intensity: f32, strength: f32) -> f32 { return saturate_or_zero(intensity / strength); }

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
fn gnomon_covariance_add_bias(given_c: gnomon_double_word, b_i: f32, b_j: f32, e_ij: f32, e_i: f32,
                              e_j: f32) -> gnomon_double_word
{
    var c = given_c;
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

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

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
struct hankel4_ { mean: f32, variance: f32, third: f32, determinant: f32 }

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
fn gnomon_hankel4_make(mean: f32, variance: f32, covariance: f32, determinant: f32) -> hankel4_
{
    var h: hankel4_;
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
fn hankel4_from_moments(b: moments4_) -> hankel4_
{
    let v = b.b2_ - b.b1_ * b.b1_;
    let l = b.b3_ - b.b1_ * b.b2_;
    let m = b.b4_ - b.b2_ * b.b2_;
    return gnomon_hankel4_make(b.b1_, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
struct gnomon_covariances4_ { v: gnomon_double_word, l: gnomon_double_word, m: gnomon_double_word }

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
fn gnomon_covariances4_from_moments(b: moments4_) -> gnomon_covariances4_
{
    var c: gnomon_covariances4_;
    c.v = subtract_product_ordered(b.b2_, b.b1_, b.b1_);
    c.l = subtract_product(b.b3_, b.b1_, b.b2_);
    c.m = subtract_product_ordered(b.b4_, b.b2_, b.b2_);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
fn gnomon_hankel4_with_change(b: moments4_, e: moments4_) -> hankel4_
{
    let c = gnomon_covariances4_from_moments(b);
    let v = gnomon_covariance_add_bias(c.v, b.b1_, b.b1_, e.b2_, e.b1_, e.b1_);
    let l = gnomon_covariance_add_bias(c.l, b.b1_, b.b2_, e.b3_, e.b1_, e.b2_);
    let m = gnomon_covariance_add_bias(c.m, b.b2_, b.b2_, e.b4_, e.b2_, e.b2_);
    return gnomon_hankel4_make(b.b1_ + e.b1_, v.high + v.low, l.high + l.low, gnomon_double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
fn hankel4_constant_bias(b: moments4_, bias2: f32, bias4: f32, alpha: f32) -> hankel4_
{
    var e: moments4_;
    e.b1_ = -1.0 * alpha * b.b1_;
    e.b2_ = alpha * (bias2 - b.b2_);
    e.b3_ = -1.0 * alpha * b.b3_;
    e.b4_ = alpha * (bias4 - b.b4_);
    return gnomon_hankel4_with_change(b, e);
}

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

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
struct gnomon_distribution3_ { depth0_: f32, depth1_: f32, depth2_: f32, weight0_: f32, weight1_: f32, weight2_: f32 }

// moments/hamburger4.h ------------------------------------------------------------------------------------------------

const gnomon_hamburger4_scale: f32 = 72057594037927936.0; // 2^56
const hamburger4_lower_scale: f32 = 281474976710656.0; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
fn gnomon_hamburger4_q(h: hankel4_, x: f32) -> f32 { return (h.variance * x - h.third) * x - h.variance * h.variance; }

/// The weight of the node at mean + x, where q = Q(x).
fn gnomon_hamburger4_weight(h: hankel4_, x: f32, q: f32) -> f32
{
    let w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
struct hamburger4_quadratic { a: f32, b: f32, c: f32 }

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
fn gnomon_hamburger4_other_nodes(h: hankel4_, u: f32, q: f32) -> hamburger4_quadratic
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    let n = h.determinant * gnomon_hamburger4_scale;
    let s = q * gnomon_hamburger4_scale;
    var r: hamburger4_quadratic;
    r.a = s * h.variance;
    r.b = 0.5 * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
struct hamburger4_fractions { share: f32, total: f32, receiver: f32, whole: f32 }

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
fn gnomon_hamburger4_fractions_at(h: hankel4_, z_f: f32) -> hamburger4_fractions
{
    let u = clamp_or_nan(z_f, -1.0, 1.0) - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    let s = hamburger4_lower_scale * q;
    let n = hamburger4_lower_scale * h.determinant;
    let un = u * n;
    let a = s * h.variance;
    let b = 0.5 * (un - s * h.third);
    let r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    let e = u * un + q * s;
    var f: hamburger4_fractions;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    let between = q < 0.0;
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
///     error, float, hankel4_from_unorm16_: p99 4e-4, p99.9 2e-3, max 5e-2
///     error, float, hankel4_from_unorm16_filtered: p99 2e-4, p99.9 6e-4, max 4e-3
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
fn hamburger4_lower(h: hankel4_, z_f: f32) -> f32
{
    let f = gnomon_hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
fn hamburger4_bounds(h: hankel4_, z_f: f32) -> hamburger_bounds
{
    let f = gnomon_hamburger4_fractions_at(h, z_f);
    var r: hamburger_bounds;
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
fn hamburger4_distribution(h: hankel4_, z_f: f32) -> gnomon_distribution3_
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let u = z - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    let p = gnomon_hamburger4_other_nodes(h, u, q);
    let x = quadratic_roots(p.a, p.b, p.c);
    let x1 = clamp_or_nan(x.first, -1024.0, 1024.0);
    let x2 = clamp_or_nan(x.second, -1024.0, 1024.0);
    let w0 = gnomon_hamburger4_weight(h, u, q);
    let w1 = gnomon_hamburger4_weight(h, x1, gnomon_hamburger4_q(h, x1));
    let w2 = gnomon_hamburger4_weight(h, x2, gnomon_hamburger4_q(h, x2));
    let sum = w0 + (w1 + w2);
    let swapped = x2 < x1;
    let known = sum > 0.0; // false for NaN
    var d: gnomon_distribution3_;
    d.depth0_ = gnomon_select(known, z, 1.0);
    d.depth1_ = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), 1.0);
    d.depth2_ = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), 1.0);
    d.weight1_ = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, 0.0);
    d.weight2_ = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, 0.0);
    d.weight0_ = saturate_or_zero(1.0 - (d.weight1_ + d.weight2_));
    return d;
}

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

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below.
/// An alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
fn over(below: f32, above: f32, alpha: f32) -> f32
{
    let a = saturate_or_zero(alpha);
    let mixed = (1.0 - a) * below + a * above;
    return gnomon_select(0.0 < a, gnomon_select(a < 1.0, mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
struct gnomon_front_to_back { weight: f32, transmittance: f32 }

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
fn front_to_back_begin(alpha: f32) -> gnomon_front_to_back
{
    var state: gnomon_front_to_back;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = 1.0 - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
fn front_to_back_add(given_state: gnomon_front_to_back, alpha: f32) -> gnomon_front_to_back
{
    var state = given_state;
    let a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (1.0 - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
const gnomon_alpha_test_one_percent: f32 = 0x1.47ae14p-7; // 0.01

const gnomon_blend_least_alpha: f32 = 5.9604644775390625e-8; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
fn blend_roundings(least_alpha: f32) -> f32
{
    return 1.0 / gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
fn blend_roundings_of_layers(least_alpha: f32, layers: f32) -> f32
{
    let a = gnomon_max(saturate_or_zero(least_alpha), gnomon_blend_least_alpha);
    let further = gnomon_max(1.0, layers) - 1.0;
    let few = (further + 1.0) / (1.0 + 0.5 * (further * a));
    return gnomon_min(few, 1.0 / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
fn gnomon_blended_roundings(further: f32, each: f32) -> f32 { return 1.0 + each * gnomon_max(0.0, further); }

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
const gnomon_blended_half_roundings: f32 = 2.0;
const gnomon_blended_float_roundings: f32 = 3.5;

// moments/translucency.h, four moments --------------------------------------------------------------------------------

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
fn moments4_over(below: moments4_, z: f32, alpha: f32) -> moments4_
{
    var b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1_ = over(below.b1_, b.b1_, alpha);
    b.b2_ = over(below.b2_, b.b2_, alpha);
    b.b3_ = over(below.b3_, b.b3_, alpha);
    b.b4_ = over(below.b4_, b.b4_, alpha);
    return b;
}

// moments/translucency.h, six moments ---------------------------------------------------------------------------------

/// The six moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
fn moments6_over(below: moments6_, z: f32, alpha: f32) -> moments6_
{
    var b = moments6_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1_ = over(below.b1_, b.b1_, alpha);
    b.b2_ = over(below.b2_, b.b2_, alpha);
    b.b3_ = over(below.b3_, b.b3_, alpha);
    b.b4_ = over(below.b4_, b.b4_, alpha);
    b.b5_ = over(below.b5_, b.b5_, alpha);
    b.b6_ = over(below.b6_, b.b6_, alpha);
    return b;
}

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

/// Sums of absorbance times powers of depth, b0 to b4.
struct absorbance4_ { b0_: f32, b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

const absorbance_most: f32 = 16.0;

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
fn absorbance_of_opacity(alpha: f32) -> f32
{
    let absorbed = -1.0 * polynomial_log(1.0 - saturate_or_zero(alpha));
    return gnomon_min(absorbed, absorbance_most);
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
fn absorbance4_of_fragment(z: f32, alpha: f32) -> absorbance4_
{
    let a = absorbance_of_opacity(alpha);
    let m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    var b: absorbance4_;
    b.b0_ = a;
    b.b1_ = a * m.b1_;
    b.b2_ = a * m.b2_;
    b.b3_ = a * m.b3_;
    b.b4_ = a * m.b4_;
    return b;
}

/// The absorbance moments of two sets of fragments together.
fn absorbance4_add(given_sum: absorbance4_, b: absorbance4_) -> absorbance4_
{
    var sum = given_sum;
    sum.b0_ = sum.b0_ + b.b0_;
    sum.b1_ = sum.b1_ + b.b1_;
    sum.b2_ = sum.b2_ + b.b2_;
    sum.b3_ = sum.b3_ + b.b3_;
    sum.b4_ = sum.b4_ + b.b4_;
    return sum;
}

const absorbance_least: f32 = 7.62939453125e-6; // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are
/// meant in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
fn absorbance4_factor(b: absorbance4_, alpha: f32) -> hankel4_
{
    let scale = 1.0 / gnomon_max(absorbance_least, b.b0_);
    var m: moments4_;
    m.b1_ = b.b1_ * scale;
    m.b2_ = b.b2_ * scale;
    m.b3_ = b.b3_ * scale;
    m.b4_ = b.b4_ * scale;
    return hankel4_constant_bias(m, bias4_raw_b2_, bias4_raw_b4_, alpha);
}

const absorbance_scale: f32 = 0x1.p-64; // 5.421010862427522170037e-20, 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
fn absorbance_transmittance(b0: f32, intensity: f32) -> f32
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    let absorbed = saturate_or_zero(b0 * absorbance_scale) * 18446744073709551616.0;
    let t = polynomial_exp(-1.0 * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, 1.0);
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
fn gnomon_absorbance4_intensity(h: hankel4_, alpha: f32, overestimation: f32, z_f: f32) -> f32
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (1.0 - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1],
/// clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_transmittance(b: absorbance4_, alpha: f32, overestimation: f32, z_f: f32) -> f32
{
    return absorbance_transmittance(b.b0_,
                                    gnomon_absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation,
                                                                 z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the
/// given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
fn transmitted_intensity(opaque: f32, transmittance: f32) -> f32
{
    let absorbed = saturate_or_zero(1.0 - transmittance);
    let o = saturate_or_zero(opaque);
    return o + (1.0 - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of
/// the three as absorbance.
struct gnomon_coloured_absorbance4_ { red: f32, green: f32, blue: f32, b1_: f32, b2_: f32, b3_: f32, b4_: f32 }

/// Transmittances, each in [0, 1].
struct gnomon_coloured_transmittance { red: f32, green: f32, blue: f32 }

const absorbance_third: f32 = 0x1.555556p-2; // 0.33333333333333331

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
fn coloured_absorbance4_of_fragment(z: f32, red: f32, green: f32, blue: f32) -> gnomon_coloured_absorbance4_
{
    var b: gnomon_coloured_absorbance4_;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    let a = absorbance_third * (b.red + (b.green + b.blue));
    let m = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    b.b1_ = a * m.b1_;
    b.b2_ = a * m.b2_;
    b.b3_ = a * m.b3_;
    b.b4_ = a * m.b4_;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
fn coloured_absorbance4_add(given_sum: gnomon_coloured_absorbance4_,
                            b: gnomon_coloured_absorbance4_) -> gnomon_coloured_absorbance4_
{
    var sum = given_sum;
    sum.red = sum.red + b.red;
    sum.green = sum.green + b.green;
    sum.blue = sum.blue + b.blue;
    sum.b1_ = sum.b1_ + b.b1_;
    sum.b2_ = sum.b2_ + b.b2_;
    sum.b3_ = sum.b3_ + b.b3_;
    sum.b4_ = sum.b4_ + b.b4_;
    return sum;
}

/// The transmittances at depth z_f, from one distribution of depth for all channels: right in front of all fragments,
/// behind all, and wherever their hues are alike. The arguments are those of absorbance4_transmittance.
/// Domain: as of absorbance4_transmittance.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn coloured_absorbance4_transmittance(b: gnomon_coloured_absorbance4_, alpha: f32, overestimation: f32,
                                      z_f: f32) -> gnomon_coloured_transmittance
{
    var shared_depths: absorbance4_;
    shared_depths.b0_ = absorbance_third * (b.red + (b.green + b.blue));
    shared_depths.b1_ = b.b1_;
    shared_depths.b2_ = b.b2_;
    shared_depths.b3_ = b.b3_;
    shared_depths.b4_ = b.b4_;
    let intensity = gnomon_absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation, z_f);
    var t: gnomon_coloured_transmittance;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
}

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

/// The function z scale + offset, from signed depth in one range to signed depth in another.
struct depth_change { scale: f32, offset: f32 }

/// The change from signed depth between two planes, at near_distance and far_distance from the light, to signed depth
/// between two others, at target_near and target_far. All distances are measured along the same axis, in any unit.
/// Domain: near_distance < far_distance, target_near < target_far.
/// NaN: NaN.
/// Error: 8 2^-p of the largest distance over target_far - target_near.
fn depth_change_from_planes(near_distance: f32, far_distance: f32, target_near: f32, target_far: f32) -> depth_change
{
    let extent = target_far - target_near;
    var r: depth_change;
    r.scale = (far_distance - near_distance) / extent;
    r.offset = ((near_distance - target_near) + (far_distance - target_far)) / extent;
    return r;
}

/// Signed depth z in the other range.
/// NaN: NaN.
/// Error: two roundings.
fn depth_affine(z: f32, change: depth_change) -> f32 { return z * change.scale + change.offset; }

// moments/affine.h, four moments --------------------------------------------------------------------------------------

// (1/3 + sqrt 3) / (2 65535) / r, where r = 0.17678 is the distance of the bias vector (0, 0.375, 0, 0.375) to the
// boundary of the vectors of moments, and the error of theta4_inverse and moments4_affine in float.
const affine4_unorm16_weight: f32 = 0x1.92a738p-14; // 9.6e-5

/// The moments of z scale + offset, where b are the four moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 6 2^-p, absolute.
/// Source: Peters 2017, Eq. 2
fn moments4_affine(b: moments4_, change: depth_change) -> moments4_
{
    let s = change.scale;
    let o = change.offset;
    let s2 = s * s;
    let c1 = s * b.b1_;
    let c2 = s2 * b.b2_;
    let c3 = s2 * s * b.b3_;
    var r: moments4_;
    r.b1_ = c1 + o;
    r.b2_ = c2 + o * (2.0 * c1 + o);
    r.b3_ = c3 + o * (3.0 * c2 + o * (3.0 * c1 + o));
    r.b4_ = s2 * s2 * b.b4_ + o * (4.0 * c3 + o * (6.0 * c2 + o * (4.0 * c1 + o)));
    return r;
}

// moments/affine.h, six moments ---------------------------------------------------------------------------------------

/// The moments of z scale + offset, where b are the six moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 9 2^-p, absolute.
fn moments6_affine(b: moments6_, change: depth_change) -> moments6_
{
    let s = change.scale;
    let o = change.offset;
    let s2 = s * s;
    let c1 = s * b.b1_;
    let c2 = s2 * b.b2_;
    let c3 = s2 * s * b.b3_;
    let c4 = s2 * s2 * b.b4_;
    let c5 = s2 * s2 * s * b.b5_;
    var r: moments6_;
    r.b1_ = c1 + o;
    r.b2_ = c2 + o * (2.0 * c1 + o);
    r.b3_ = c3 + o * (3.0 * c2 + o * (3.0 * c1 + o));
    r.b4_ = c4 + o * (4.0 * c3 + o * (6.0 * c2 + o * (4.0 * c1 + o)));
    r.b5_ = c5 + o * (5.0 * c4 + o * (10.0 * c3 + o * (10.0 * c2 + o * (5.0 * c1 + o))));
    r.b6_ = s2 * s2 * s2 * b.b6_ + o *
            (6.0 * c5 + o * (15.0 * c4 + o * (20.0 * c3 + o * (15.0 * c2 + o * (6.0 * c1 + o)))));
    return r;
}

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.

struct channels1_ { c1_: f32 }

struct channels2_ { c1_: f32, c2_: f32 }

struct channels5_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32 }

// moments/channels.h, four moments ------------------------------------------------------------------------------------

struct channels4_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32 }

// moments/channels.h, six moments -------------------------------------------------------------------------------------

struct channels6_ { c1_: f32, c2_: f32, c3_: f32, c4_: f32, c5_: f32, c6_: f32 }

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.

/// The moments that a format without transform holds as they are.
fn moments4_from_channels(c: channels4_) -> moments4_
{
    var b: moments4_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    return b;
}

/// The moments b as the channels of a format without transform.
fn channels4_from_moments(b: moments4_) -> channels4_
{
    var c: channels4_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    return c;
}

const gnomon_theta4_31_: f32 = 0x1.bb67aep-1; // 0.8660254037844386, sqrt(3) / 2
const gnomon_theta4_33_: f32 = -0x1.8a2346p-2; // -0.38490017945975052, -2 sqrt(3) / 9
const gnomon_theta4_inverse11_: f32 = -0x1.555556p-2; // -0.33333333333333331
const gnomon_theta4_inverse13_: f32 = 0x1.bb67aep+0; // 1.7320508075688772
const gnomon_theta4_inverse33_: f32 = 0x1.4c8dc2p+0; // 1.299038105676658

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
fn theta4_(b: moments4_) -> channels4_
{
    var c: channels4_;
    c.c1_ = 1.5 * b.b1_ - 2.0 * b.b3_ + 0.5;
    c.c2_ = 4.0 * (b.b2_ - b.b4_);
    c.c3_ = gnomon_theta4_31_ * b.b1_ + gnomon_theta4_33_ * b.b3_ + 0.5;
    c.c4_ = 0.5 * (b.b2_ + b.b4_);
    return c;
}

/// The four moments of channels c: the inverse of theta4_.
/// Source: Peters 2017, Eq. 3
fn theta4_inverse(c: channels4_) -> moments4_
{
    let c1 = c.c1_ - 0.5;
    let c3 = c.c3_ - 0.5;
    var b: moments4_;
    b.b1_ = gnomon_theta4_inverse11_ * c1 + gnomon_theta4_inverse13_ * c3;
    b.b2_ = 0.125 * c.c2_ + c.c4_;
    b.b3_ = gnomon_theta4_inverse33_ * c3 - 0.75 * c1;
    b.b4_ = c.c4_ - 0.125 * c.c2_;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
fn theta4_inverse_add_bias(c: channels4_, bias: f32, alpha: f32) -> moments4_
{
    let keep = 1.0 - alpha;
    let c1 = c.c1_ - 0.5;
    let c3 = c.c3_ - 0.5;
    let c2 = (0.125 * keep) * c.c2_;
    let c4 = keep * c.c4_ + alpha * bias;
    var b: moments4_;
    b.b1_ = (keep * gnomon_theta4_inverse11_) * c1 + (keep * gnomon_theta4_inverse13_) * c3;
    b.b2_ = c4 + c2;
    b.b3_ = (keep * gnomon_theta4_inverse33_) * c3 - (0.75 * keep) * c1;
    b.b4_ = c4 - c2;
    return b;
}

// moments/quantization.h, six moments ---------------------------------------------------------------------------------

/// The moments that a format without transform holds as they are.
fn moments6_from_channels(c: channels6_) -> moments6_
{
    var b: moments6_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    b.b5_ = c.c5_;
    b.b6_ = c.c6_;
    return b;
}

/// The moments b as the channels of a format without transform.
fn channels6_from_moments(b: moments6_) -> channels6_
{
    var c: channels6_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    c.c5_ = b.b5_;
    c.c6_ = b.b6_;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
const gnomon_theta6_21_: f32 = -0x1.dfe44ap+0; // -1.8745771666290014
const gnomon_theta6_23_: f32 = 0x1.0d193ap+2; // 4.204664766466248
const gnomon_theta6_25_: f32 = -0x1.d4809ep+0; // -1.8300875998372463
const gnomon_theta6_31_: f32 = 0x1.43abfep+0; // 1.2643431422063351
const gnomon_theta6_33_: f32 = -0x1.78bbd6p+0; // -1.4716161665593888
const gnomon_theta6_35_: f32 = 0x1.6a1fbp-1; // 0.70727302435305361
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
const gnomon_theta6_62_: f32 = -0x1.279a74p-1; // -0.57735026918962573
const gnomon_theta6_64_: f32 = 0x1.279a74p+2; // 4.6188021535170058
const gnomon_theta6_66_: f32 = -0x1.8a2346p+1; // -3.0792014356780042
const gnomon_theta6_60_: f32 = 0x1.353e8cp-6; // 0.018874775675311862
const gnomon_theta6_inverse11_: f32 = -0x1.d1831cp-6; // -0.02841260648183782
const gnomon_theta6_inverse12_: f32 = 0x1.e73ec6p-2; // 0.47582541301272185
const gnomon_theta6_inverse13_: f32 = 0x1.8d765ap+0; // 1.552587193469116
const gnomon_theta6_inverse31_: f32 = 0x1.99b124p-4; // 0.10002244957859331
const gnomon_theta6_inverse32_: f32 = 0x1.b09f56p-1; // 0.84496560893955308
const gnomon_theta6_inverse33_: f32 = 0x1.0e1544p+0; // 1.0550119414818537
const gnomon_theta6_inverse51_: f32 = 0x1.091eeap-2; // 0.25890700149881596
const gnomon_theta6_inverse52_: f32 = 0x1.d0a55cp-1; // 0.90751156960796575
const gnomon_theta6_inverse53_: f32 = 0x1.aacb3p-1; // 0.83358142889321829
const gnomon_theta6_inverse_sixth: f32 = 0x1.555556p-3; // 0.16666666666666666
const gnomon_theta6_inverse23_: f32 = 0x1.bb67aep-1; // 0.8660254037844386
const gnomon_theta6_inverse63_: f32 = 0x1.9fb134p-1; // 0.81189881604791125

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
fn theta6_(b: moments6_) -> channels6_
{
    var c: channels6_;
    c.c1_ = 2.5 * b.b1_ - 10.0 * b.b3_ + 8.0 * b.b5_ + 0.5;
    c.c2_ = gnomon_theta6_21_ * b.b1_ + gnomon_theta6_23_ * b.b3_ + gnomon_theta6_25_ * b.b5_ + 0.5;
    c.c3_ = gnomon_theta6_31_ * b.b1_ + gnomon_theta6_33_ * b.b3_ + gnomon_theta6_35_ * b.b5_ + 0.5;
    c.c4_ = 4.0 * (b.b2_ - b.b4_);
    c.c5_ = 9.0 * b.b2_ - 24.0 * b.b4_ + 16.0 * b.b6_;
    c.c6_ = gnomon_theta6_62_ * b.b2_ + gnomon_theta6_64_ * b.b4_ + gnomon_theta6_66_ * b.b6_ + gnomon_theta6_60_;
    return c;
}

/// The six moments of channels c: the inverse of theta6_.
/// Source: Peters 2017, Sec. 5.4.3
fn theta6_inverse(c: channels6_) -> moments6_
{
    let c1 = c.c1_ - 0.5;
    let c2 = c.c2_ - 0.5;
    let c3 = c.c3_ - 0.5;
    let c5 = gnomon_theta6_inverse_sixth * c.c5_;
    let c6 = c.c6_ - gnomon_theta6_60_;
    var b: moments6_;
    b.b1_ = gnomon_theta6_inverse11_ * c1 + gnomon_theta6_inverse12_ * c2 + gnomon_theta6_inverse13_ * c3;
    b.b3_ = gnomon_theta6_inverse31_ * c1 + gnomon_theta6_inverse32_ * c2 + gnomon_theta6_inverse33_ * c3;
    b.b5_ = gnomon_theta6_inverse51_ * c1 + gnomon_theta6_inverse52_ * c2 + gnomon_theta6_inverse53_ * c3;
    b.b2_ = c5 + gnomon_theta6_inverse23_ * c6;
    b.b4_ = (c5 + gnomon_theta6_inverse23_ * c6) - 0.25 * c.c4_;
    b.b6_ = (0.21875 * c.c5_ + gnomon_theta6_inverse63_ * c6) - 0.375 * c.c4_;
    return b;
}

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

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
struct gnomon_certificate4_ { top: f32, s0_: f32, s1_: f32, s2_: f32, s3_: f32, s4_: f32 }

const gnomon_certificate4_nothing: f32 = -1267650600228229401496703205376.0; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
fn gnomon_certificate4_about(z_f: f32, n0: f32, t0: f32, t1: f32, n1: f32, n2: f32) -> gnomon_certificate4_
{
    let nz = n2 * z_f;
    let ns = (n1 + n1) - nz;
    let k0 = n0 - ns * z_f;
    let k1 = ns - nz;
    let m = t0 - t1 * z_f;
    let m0 = m * m;
    let m1 = m * (t1 + t1);
    let m2 = t1 * t1;
    var p: gnomon_certificate4_;
    p.top = n0;
    p.s0_ = m0 * k0;
    p.s1_ = m0 * k1 + m1 * k0;
    p.s2_ = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3_ = m1 * n2 + m2 * k1;
    p.s4_ = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
fn gnomon_certificate4_make(h: hankel4_, z_f: f32) -> gnomon_certificate4_
{
    let u = z_f - h.mean;
    let vu = h.variance * u;
    let slope = vu - h.third;
    let q = slope * u - h.variance * h.variance;
    let un = u * h.determinant;
    let w = h.variance * h.determinant + (u * un + q * q);
    let w2 = w + w;
    let a = q * h.variance;
    let b = un + q * (vu + slope);
    let square = b * b - (a + a) * w2;
    let inverse = 1.0 / w2;
    let ratio = b / (square + square);
    let r = gnomon_sqrt(gnomon_max(0.0, square));
    let c = (b + r) * inverse;
    let g = (b - r) * inverse;
    let d = ratio * r - 0.5;
    let k = c * d;
    let between = q < 0.0;
    let n0 = gnomon_select(between, 0.0, 1.0);
    let n1 = gnomon_select(between, c - k, g);
    let n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    let t0 = gnomon_select(between, 1.0 + d, 1.0);
    let t1 = gnomon_select(between, k, c);
    var p = gnomon_certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (0.0 < b), n0, gnomon_certificate4_nothing);
    return p;
}

/// The coefficients of p at the channels of theta4_, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
fn gnomon_certificate4_theta(p: gnomon_certificate4_) -> channels4_
{
    let third = 0.75 * p.s3_;
    var r: channels4_;
    r.c1_ = gnomon_theta4_inverse11_ * p.s1_ - third;
    r.c2_ = 0.125 * (p.s2_ - p.s4_);
    r.c3_ = gnomon_theta4_inverse13_ * (p.s1_ + third);
    r.c4_ = p.s2_ + p.s4_;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
fn gnomon_certificate4_theta_doubt(t: channels4_, noise: f32) -> f32
{
    return noise * ((gnomon_abs(t.c1_) + gnomon_abs(t.c2_)) + (gnomon_abs(t.c3_) + gnomon_abs(t.c4_)));
}

/// The least possible value of E[p], given channels c of theta4_ that are each off by at most noise.
fn gnomon_certificate4_theta_mean(p: gnomon_certificate4_, c: channels4_, noise: f32) -> f32
{
    let t = gnomon_certificate4_theta(p);
    let mean = (p.s0_ + (t.c2_ * c.c2_ + t.c4_ * c.c4_)) + (t.c1_ * (c.c1_ - 0.5) + t.c3_ * (c.c3_ - 0.5));
    return p.top - (mean + gnomon_certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4_ that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_theta_lower(h: hankel4_, c: channels4_, noise: f32, z_f: f32) -> f32
{
    let p = gnomon_certificate4_make(h, clamp_or_nan(z_f, -1.0, 1.0));
    return saturate_or_zero(gnomon_certificate4_theta_mean(p, c, noise));
}

const gnomon_certified4_scale: f32 = 137438953472.0; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
struct certified4_mean
{
    p: gnomon_certificate4_,
    mean: f32, added: f32, known: f32,
}

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
fn gnomon_certified4_constant_bias_mean(h: hankel4_, bias2: f32, bias4: f32, alpha: f32, z: f32) -> certified4_mean
{
    let u = z - h.mean;
    let vu = h.variance * u;
    let slope = vu - h.third;
    let q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    let s = gnomon_certified4_scale * q;
    let n = gnomon_certified4_scale * h.determinant;
    let un = u * n;
    let e = u * un + q * s;
    let w = h.variance * n + e;
    let w2 = w + w;
    let a = s * h.variance;
    let a2 = a + a;
    let b = un + s * (vu + slope);
    let r = gnomon_sqrt(gnomon_max(0.0, b * b - a2 * w2));
    let between = q < 0.0;
    let positive = 0.0 < b;
    // Each quotient in the form that does not cancel.
    let outer = r + gnomon_abs(b);
    let c = gnomon_select(positive, outer, -2.0 * a) / gnomon_select(positive, w2, outer);
    let inverse = 1.0 / gnomon_select(between, r + r, outer);
    let g = a2 * inverse; // k if one node is on either side
    let n0 = gnomon_select(between, 0.0, 1.0);
    let n1 = gnomon_select(between, c - g, g);
    let n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    let t0 = gnomon_select(between, 0.5 + b * inverse, 1.0);
    let t1 = gnomon_select(between, g, c);
    var m: certified4_mean;
    m.p = gnomon_certificate4_about(z, n0, t0, t1, n1, n2);
    let share = gnomon_select(between, 0.5 * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, 1.0));
    m.added = alpha * ((m.p.top - m.p.s0_) - (bias2 * m.p.s2_ + bias4 * m.p.s4_));
    m.known = gnomon_select((between || positive) && (gnomon_pivot_floor * h.variance < h.determinant), 1.0, 0.0);
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
fn gnomon_certified4_constant_bias_intensity(m: certified4_mean, doubt: f32) -> f32
{
    return gnomon_select(0.0 < m.known, saturate_or_zero(m.mean - (m.added + doubt)), 0.0);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_constant_bias_lower(h: hankel4_, noise: moments4_, bias2: f32, bias4: f32, alpha: f32, z_f: f32) -> f32
{
    let m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    let doubt = (noise.b1_ * gnomon_abs(m.p.s1_) + noise.b2_ * gnomon_abs(m.p.s2_)) +
                (noise.b3_ * gnomon_abs(m.p.s3_) + noise.b4_ * gnomon_abs(m.p.s4_));
    return gnomon_certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4_ with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
fn certified4_theta_constant_bias_lower(h: hankel4_, noise: f32, bias2: f32, bias4: f32, alpha: f32, z_f: f32) -> f32
{
    let m = gnomon_certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, -1.0, 1.0));
    return gnomon_certified4_constant_bias_intensity(m,
                                                     gnomon_certificate4_theta_doubt(gnomon_certificate4_theta(m.p),
                                                                                     noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
fn moments4_rounding(b: moments4_, delta: f32) -> moments4_
{
    var e: moments4_;
    e.b1_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1_));
    e.b2_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2_));
    e.b3_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3_));
    e.b4_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4_));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
fn moments4_rounding_filtered(b: moments4_, delta: f32) -> moments4_
{
    var e: moments4_;
    e.b1_ = delta;
    e.b2_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2_));
    e.b3_ = gnomon_min(delta, delta * gnomon_abs(b.b2_ + b.b4_));
    e.b4_ = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4_));
    return e;
}

// numerics/cubic.h ----------------------------------------------------------------------------------------------------
// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
const gnomon_cubic_cosine0_: f32 = 0x1.00013ap-1; // 0.50000938
const gnomon_cubic_cosine1_: f32 = 0x1.2758bcp-1; // 0.57684887
const gnomon_cubic_cosine2_: f32 = -0x1.b4ea78p-4; // -0.10666892
const gnomon_cubic_cosine3_: f32 = 0x1.3c6c52p-5; // 0.03862587
const gnomon_cubic_cosine4_: f32 = -0x1.211814p-7; // -0.00882245
const gnomon_cubic_minus_third: f32 = -0x1.555556p-2; // -0.33333333333333331

/// The result of a Halley step as a fraction, whose denominator is positive.
struct gnomon_cubic_step { numerator: f32, denominator: f32 }

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
fn gnomon_cubic_halley_step(b: f32, c: f32, d: f32, t: f32) -> gnomon_cubic_step
{
    let tb = t + b;
    let f = tb * (t * t) + (c * t + d);
    let s = (tb + (tb + t)) * t + c;
    let r = (t + t) + tb;
    let whole = s * s - f * r; // positive except at a multiple root
    let simple = whole > 0.0;
    var x: gnomon_cubic_step;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, 1.0);
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
fn gnomon_cubic_halley(b: f32, c: f32, d: f32, t: f32) -> f32
{
    let x = gnomon_cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
fn gnomon_cubic_start(b: f32, c: f32, d: f32) -> f32
{
    let mean = gnomon_cubic_minus_third * b;
    let mean2 = mean * mean;
    let spread2 = gnomon_max(mean2 + gnomon_cubic_minus_third * c, 0.0);
    let spread = gnomon_sqrt(spread2);
    let g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    let inverse = 1.0 / spread2;
    let cosine = (g * inverse) * (spread * inverse);
    let q2 = gnomon_min(gnomon_max(0.5 + 0.25 * cosine, 0.0), 1.0);
    let q = gnomon_sqrt(q2);
    let start = (gnomon_cubic_cosine0_ + q * gnomon_cubic_cosine1_) + q2 *
                ((gnomon_cubic_cosine2_ + q * gnomon_cubic_cosine3_) + q2 * gnomon_cubic_cosine4_);
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
fn gnomon_cubic_positive_root(b: f32, c: f32, d: f32) -> gnomon_cubic_step
{
    let t = gnomon_cubic_start(b, c, d);
    return gnomon_cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
fn cubic_largest_root(b: f32, c: f32, d: f32) -> f32
{
    let x = gnomon_cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
}

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

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
struct hankel6_ { mean: f32, variance: f32, shift2_: f32, shift3_: f32, ratio: f32, whole: f32, first: f32,
    second: f32 }

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
fn gnomon_hankel6_make(mean: f32, c11: f32, c12: f32, s22: f32, s23: f32, t: f32) -> hankel6_
{
    var h: hankel6_;
    h.mean = mean;
    h.variance = gnomon_max(gnomon_pivot_floor, c11);
    let inverse1 = 1.0 / h.variance;
    let s = gnomon_max(gnomon_pivot_floor * h.variance, s22);
    let inverse_s = 1.0 / s;
    let l21 = c12 * inverse1;
    h.shift2_ = l21 - (mean + mean);
    h.shift3_ = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(gnomon_pivot_floor, (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
struct gnomon_covariances6_ { c11_: gnomon_double_word, c12_: gnomon_double_word, c13_: gnomon_double_word,
    c22_: gnomon_double_word, c23_: gnomon_double_word, c33_: gnomon_double_word }

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
fn gnomon_covariances6_from_moments(b: moments6_) -> gnomon_covariances6_
{
    var c: gnomon_covariances6_;
    c.c11_ = subtract_product_ordered(b.b2_, b.b1_, b.b1_);
    c.c12_ = subtract_product(b.b3_, b.b1_, b.b2_);
    c.c13_ = subtract_product_ordered(b.b4_, b.b1_, b.b3_);
    c.c22_ = subtract_product_ordered(b.b4_, b.b2_, b.b2_);
    c.c23_ = subtract_product(b.b5_, b.b2_, b.b3_);
    c.c33_ = subtract_product_ordered(b.b6_, b.b3_, b.b3_);
    return c;
}

/// a b - c d as a double word, for factors whose low words may be as large as the high ones.
/// Domain: a b >= |c d| for the high words.
/// Error: in float 2^-45 of both products of the high words, and 2^-21 of the contributions of the low words.
fn gnomon_hankel6_minor(a: gnomon_double_word, b: gnomon_double_word, c: gnomon_double_word,
                        d: gnomon_double_word) -> gnomon_double_word
{
    let p = two_product(a.high, b.high);
    let q = two_product(c.high, d.high);
    var r = two_difference_ordered(p.high, q.high);
    let up = a.high * b.low + a.low * (b.high + b.low);
    let down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
fn gnomon_hankel6_factor(mean: f32, c: gnomon_covariances6_) -> hankel6_
{
    let s22 = gnomon_hankel6_minor(c.c11_, c.c22_, c.c12_, c.c12_);
    let s23 = gnomon_double_word_minor(c.c11_, c.c23_, c.c12_, c.c13_);
    let s33 = gnomon_hankel6_minor(c.c11_, c.c33_, c.c13_, c.c13_);
    return gnomon_hankel6_make(mean, c.c11_.high + c.c11_.low, c.c12_.high + c.c12_.low, s22.high + s22.low, s23.high +
                               s23.low, gnomon_double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
fn hankel6_constant_bias(b: moments6_, bias2: f32, bias4: f32, bias6: f32, alpha: f32) -> hankel6_
{
    let keep = 1.0 - alpha;
    let odds = alpha / keep;
    let d2 = b.b2_ - bias2;
    let e1 = alpha * b.b1_;
    let e2 = alpha * d2;
    let e3 = alpha * b.b3_;
    var c = gnomon_covariances6_from_moments(b);
    c.c11_.low = c.c11_.low + (e1 * b.b1_ + odds * bias2);
    c.c12_.low = c.c12_.low + e1 * d2;
    c.c13_.low = c.c13_.low + (e1 * b.b3_ + odds * bias4);
    c.c22_.low = c.c22_.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23_.low = c.c23_.low + e2 * b.b3_;
    c.c33_.low = c.c33_.low + (e3 * b.b3_ + odds * bias6);
    var h = gnomon_hankel6_factor(b.b1_ - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
fn hankel6_from_moments(b: moments6_) -> hankel6_
{
    let c11 = b.b2_ - b.b1_ * b.b1_;
    let c12 = b.b3_ - b.b1_ * b.b2_;
    let c13 = b.b4_ - b.b1_ * b.b3_;
    let s22 = c11 * (b.b4_ - b.b2_ * b.b2_) - c12 * c12;
    let s23 = c11 * (b.b5_ - b.b2_ * b.b3_) - c12 * c13;
    let s33 = c11 * (b.b6_ - b.b3_ * b.b3_) - c13 * c13;
    return gnomon_hankel6_make(b.b1_, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

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

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
struct gnomon_distribution4_ { depth0_: f32, depth1_: f32, depth2_: f32, depth3_: f32, weight0_: f32, weight1_: f32,
    weight2_: f32, weight3_: f32 }

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
struct gnomon_polynomials6_ { p1_: f32, p2_: f32, p3_: f32 }

/// P_1, P_2 and P_3 at the depth mean + u.
fn gnomon_hamburger6_polynomials(h: hankel6_, u: f32) -> gnomon_polynomials6_
{
    var p: gnomon_polynomials6_;
    p.p1_ = u;
    p.p2_ = (u - h.shift2_) * u - h.variance;
    p.p3_ = (u - h.shift3_) * p.p2_ - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
fn gnomon_hamburger6_kernel(h: hankel6_, p: gnomon_polynomials6_) -> f32
{
    return (h.whole + h.first * (p.p1_ * p.p1_)) + (h.second * (p.p2_ * p.p2_) + p.p3_ * p.p3_);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
struct gnomon_derivatives6_ { slope2_: f32, slope3_: f32, bend3_: f32 }

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
fn gnomon_hamburger6_derivatives(h: hankel6_, p: gnomon_polynomials6_) -> gnomon_derivatives6_
{
    let v = p.p1_ - h.shift3_;
    var d: gnomon_derivatives6_;
    d.slope2_ = (p.p1_ + p.p1_) - h.shift2_;
    d.slope3_ = (p.p2_ + v * d.slope2_) - h.ratio;
    d.bend3_ = d.slope2_ + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
fn gnomon_hamburger6_polynomials_shift(given_p: gnomon_polynomials6_, d: gnomon_derivatives6_,
                                       distance_: f32) -> gnomon_polynomials6_
{
    var p = given_p;
    p.p1_ = p.p1_ + distance_;
    p.p2_ = p.p2_ + distance_ * (d.slope2_ + distance_);
    p.p3_ = p.p3_ + distance_ * (d.slope3_ + distance_ * (d.bend3_ + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
struct hamburger6_cubic { b: f32, c: f32, d: f32 }

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
fn gnomon_hamburger6_other_nodes(h: hankel6_, p: gnomon_polynomials6_, d: gnomon_derivatives6_, inverse: f32,
                                 side: f32) -> hamburger6_cubic
{
    let q2 = h.second * p.p2_;
    var r: hamburger6_cubic;
    r.b = inverse * (side * (h.first * p.p1_ + (d.slope2_ * q2 + d.slope3_ * p.p3_)));
    r.c = inverse * (q2 + d.bend3_ * p.p3_);
    r.d = inverse * (side * p.p3_);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
fn gnomon_hamburger6_distance(t: f32) -> f32
{
    let least = 0.0009765625;
    let away = gnomon_select(t < 0.0, gnomon_min(t, -least), gnomon_max(t, least));
    return 1.0 / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
struct hamburger6_sums { lower: f32, distance: f32, weight: f32 }

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
fn gnomon_hamburger6_sums_at(h: hankel6_, u: f32) -> hamburger6_sums
{
    let p = gnomon_hamburger6_polynomials(h, u);
    let inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    let positive1 = p.p1_ > 0.0;
    let positive2 = p.p2_ > 0.0;
    let positive3 = p.p3_ > 0.0;
    let all_below = positive1 && positive2 && positive3;
    let all_above = (!positive1) && positive2 && (!positive3);
    let outside = all_below || all_above;
    var r: hamburger6_sums;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, 1.0 - r.weight, 0.0);
    r.distance = gnomon_select(all_below, p.p1_, 0.0);
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        let side = gnomon_select(positive3, -1.0, 1.0);
        let d = gnomon_hamburger6_derivatives(h, p);
        let n = gnomon_hamburger6_other_nodes(h, p, d, inverse, side);
        let t = gnomon_cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        let away = t.denominator / gnomon_max(t.numerator, 0.0009765625 * t.denominator);
        let w = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (1.0 - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1_ + w * away));
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
///     error, float, hankel6_from_unorm16_: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10_: p99 3e-5, p99.9 9e-5, max 8e-4
///     error, float, hankel6_from_unorm10_filtered: p99 2e-5, p99.9 5e-5, max 3e-4
/// Maxima are found by climbing and stated with a margin. Without a bias there is no maximum: if D_3 is at the floor,
/// moments rounded in double cannot resolve distances below 2^-32.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_bounds(h: hankel6_, z_f: f32) -> hamburger_bounds
{
    let s = gnomon_hamburger6_sums_at(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    var r: hamburger_bounds;
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
fn hamburger6_lower(h: hankel6_, z_f: f32) -> f32 { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
fn hamburger6_distribution(h: hankel6_, z_f: f32) -> gnomon_distribution4_
{
    let p = gnomon_hamburger6_polynomials(h, clamp_or_nan(z_f, -1.0, 1.0) - h.mean);
    let inverse = 1.0 / gnomon_hamburger6_kernel(h, p);
    let side = gnomon_select(p.p3_ > 0.0, -1.0, 1.0);
    let n = gnomon_hamburger6_other_nodes(h, p, gnomon_hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    let t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    let large = (t1 * t1) * t1 > -n.d;
    let backward = -n.d / t1;
    let forward = n.b + t1;
    let b = 0.5 * gnomon_select(large, (backward - n.c) / t1, forward);
    let c = gnomon_select(large, backward, n.c + t1 * forward);
    let q = quadratic_roots(1.0, b, c);
    let t2 = gnomon_cubic_halley(n.b, n.c, n.d, q.first);
    let t3 = gnomon_cubic_halley(n.b, n.c, n.d, q.second);
    let x1 = p.p1_ + side * gnomon_hamburger6_distance(t1);
    let x2 = p.p1_ + side * gnomon_hamburger6_distance(t2);
    let x3 = p.p1_ + side * gnomon_hamburger6_distance(t3);
    let low = gnomon_min(x2, x3);
    let high = gnomon_max(x2, x3);
    let y1 = gnomon_min(x1, low);
    let y2 = gnomon_max(gnomon_min(x1, high), low);
    let y3 = gnomon_max(x1, high);
    let w0 = h.whole * inverse;
    let w1 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y1));
    let w2 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y2));
    let w3 = h.whole / gnomon_hamburger6_kernel(h, gnomon_hamburger6_polynomials(h, y3));
    let sum = (w0 + w1) + (w2 + w3);
    let known = sum > 0.0; // false for NaN
    var d: gnomon_distribution4_;
    d.depth0_ = gnomon_select(known, h.mean + p.p1_, 1.0);
    d.depth1_ = gnomon_select(known, h.mean + y1, 1.0);
    d.depth2_ = gnomon_select(known, h.mean + y2, 1.0);
    d.depth3_ = gnomon_select(known, h.mean + y3, 1.0);
    d.weight1_ = gnomon_select(known, w1 / sum, 0.0);
    d.weight2_ = gnomon_select(known, w2 / sum, 0.0);
    d.weight3_ = gnomon_select(known, w3 / sum, 0.0);
    d.weight0_ = saturate_or_zero(1.0 - (d.weight1_ + (d.weight2_ + d.weight3_)));
    return d;
}

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

const bias4_theta_within_b2_: f32 = 0x1.2f62b6p-1; // 0.59255
const bias4_theta_within_b4_: f32 = 0x1.ecd4aap-2; // 0.48128

/// Lower bound on the shadow intensity at z_f, in [0, 1], for depths in [-1, 1]. At least that of hamburger4_lower, but
/// for rounding.
/// Domain: z_f in [-1, 1], clamped; h of moments with a bias for depths in [-1, 1].
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the kernel in double (tests/soft/within.cpp),
///     error, float, hankel4_from_summed_within: p99 1e-4, p99.9 1e-1, max 8e-1
fn hausdorff4_lower(h: hankel4_, z_f: f32) -> f32
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let u = z - h.mean;
    let s = -1.0 - h.mean;
    let t = 1.0 - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    let w = h.variance * h.determinant;
    let at_s = w + (u * s * h.determinant + q * gnomon_hamburger4_q(h, s));
    let at_t = w + (u * t * h.determinant + q * gnomon_hamburger4_q(h, t));
    let between = q < 0.0;
    let outside = (between && (0.0 < at_s || 0.0 < at_t)) || (!between && (at_s < 0.0 || at_t < 0.0));
    // Times the variance, so that the fourth moment takes no division.
    let sum = s + t;
    let product = s * t;
    let e0 = h.variance * (h.variance + product);
    let e1 = h.variance * (h.third - sum * h.variance);
    let e2 = (h.determinant + h.third * h.third) + h.variance * ((h.variance + product) * h.variance - sum * h.third);
    let d = e1 - u * e0;
    let x = clamp_or_nan((e2 - u * e1) / d, s, t);
    let tx = t * x;
    let ux = u * x;
    let of_s = (h.third - ((u + x) + t) * h.variance) - u * tx;
    let of_u = (h.third - ((s + x) + t) * h.variance) - s * tx;
    let of_t = (h.third - ((s + u) + x) * h.variance) - s * ux;
    let at_low = saturate_or_zero(of_s / ((s - u) * ((s - x) * (s - t))));
    let at_node = saturate_or_zero(d / (h.variance * ((x - s) * ((x - u) * (x - t)))));
    let at_receiver = saturate_or_zero(of_u / ((u - s) * ((u - x) * (u - t))));
    let at_high = saturate_or_zero(of_t / ((t - s) * ((t - u) * (t - x))));
    let node = gnomon_select(x < u, at_node, 0.0);
    let rest = 1.0 - ((at_receiver + at_high) + gnomon_select(x < u, 0.0, at_node));
    let within = gnomon_min(at_low + node, rest);
    let lower = hamburger4_lower(h, z_f);
    return gnomon_select(outside && (-1.0 < z), saturate_or_zero(gnomon_max(lower, within)), lower);
}

// moments/two_point.h -------------------------------------------------------------------------------------------------
// A depth distribution of two depths from three moments (Peters et al. 2017, Alg. 2, Sec. 5.2 and App. B), which is the
// limit of Alg. 1 for a prescribed depth at infinity.
//
// Around the mean m = b1, with V = b2 - b1^2 and G = E[(z - m)^3] / V, the two depths are m + x1 and m + x2, where x1
// and x2 are the roots of x^2 - G x - V. The weights follow from w1 x1 + w2 x2 = 0. The roots have opposite signs, so
// that nothing cancels after V and G.

/// Two depths, depth1 <= depth2, and their weights, which are in [0, 1] and sum to 1.
struct gnomon_distribution2_ { depth1_: f32, depth2_: f32, weight1_: f32, weight2_: f32 }

const two_point_least_variance: f32 = 1.1920928955078125e-7; // 2^-23

/// The distribution of two depths with the moments b1, b2 and b3; a single depth b1 if the variance is at most
/// least_variance. That should be the largest variance by rounding of a single depth: two_point_least_variance for
/// moments stored as floats.
/// Domain: moments of depths in [-1, 1]. For moments of no such distribution depths may lie outside, but in [-8193,
/// 8193]: depths more than 2^13 apart are replaced by the single depth b1, clamped to [-1, 1].
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 2
fn two_point_distribution(b1: f32, b2: f32, b3: f32, least_variance: f32) -> gnomon_distribution2_
{
    let v = subtract_product_ordered(b2, b1, b1);
    let c = subtract_product(b3, b1, b2);
    let mean = clamp_or_nan(b1, -1.0, 1.0);
    let variance = v.high + v.low;
    let single = !(variance > gnomon_max(least_variance, gnomon_pivot_floor));
    let g = clamp_or_nan((c.high + c.low) / variance - 2.0 * mean, -4096.0, 4096.0);
    let root = 0.5 * (gnomon_abs(g) + gnomon_sqrt(g * g + 4.0 * variance));
    let far_side = gnomon_select(g < 0.0, -root, root);
    let near_side = -variance / far_side;
    let x1 = gnomon_min(far_side, near_side);
    let x2 = gnomon_max(far_side, near_side);
    let any_nan = variance + (c.high + c.low);
    let known = any_nan == any_nan;
    let two = known && (!single) && (x2 - x1 > 0.0) && (x2 - x1 < 8192.0);
    let centre = gnomon_select(known, mean, 1.0);
    var d: gnomon_distribution2_;
    d.depth1_ = gnomon_select(two, mean + x1, centre);
    d.depth2_ = gnomon_select(two, mean + x2, centre);
    d.weight2_ = gnomon_select(two, saturate_or_zero(-x1 / (x2 - x1)), 0.0);
    d.weight1_ = 1.0 - d.weight2_;
    return d;
}

const two_point_unorm16_least_variance: f32 = 0x1.4f8b58p-15; // 4.0e-5, 5.26 times half a code
const two_point_noise_0_: f32 = 0x1.bb645ap-1; // 0.866
const two_point_noise_2_: f32 = 0x1.b33334p+1; // 3.4

/// The moment b3 of two depths from three moments of theta4_ (quantization.h), each of whose channels storage has
/// rounded by noise at
/// most: with the part of the third central moment that noise explains taken out, so that close depths keep their mean
/// and variance and get equal weights.
///
/// Rounding moves the third central moment k by e = noise (0.87 + 3.4 b1^2), a standard deviation of channels that are
/// uniformly off. A skew k / V^(3/2) of the order of 1 and noise make the best estimate V^3 / (V^3 + e^2) of k.
/// Domain: moments of depths in [-1, 1].
/// NaN: NaN.
fn two_point_third_moment(b1: f32, b2: f32, b3: f32, noise: f32) -> f32
{
    let variance = gnomon_max(0.0, b2 - b1 * b1);
    let third = (b3 - b1 * b2) - 2.0 * b1 * variance;
    let e = noise * (two_point_noise_0_ + two_point_noise_2_ * (b1 * b1));
    let cubed = variance * (variance * variance);
    return b3 - third * (e * e / (cubed + e * e + gnomon_pivot_floor));
}

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.

const gnomon_texel_limit: f32 = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
fn texel_below(x: f32) -> f32
{
    let limit = gnomon_texel_limit;
    let inside = gnomon_max(gnomon_min(x, limit), -1.0 * limit);
    let whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, 1.0, 0.0);
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
fn texel_weight(u: f32, i: f32, look_ups: f32) -> f32
{
    var share = saturate_or_zero(u);
    share = gnomon_select(i < 1.0, 1.0 - share, gnomon_select(i < look_ups, 1.0, share));
    return saturate_or_zero(share / look_ups);
}

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// gnomon_stochastic_nothing, depth 1 and no motion.
struct stochastic_sample { x: f32, y: f32, t: f32, z: f32, d_x: f32, d_y: f32, d_z: f32, id: f32 }

const gnomon_stochastic_nothing: f32 = -1.0; // the id of the background
const gnomon_stratum_begin: f32 = 1.000000476837158203125; // 1 + 2^-21: a time is so far from the ends of its stratum
const gnomon_stratum_end: f32 = 0.999999523162841796875; // 1 - 2^-21

/// A sample of the background.
fn stochastic_background(x: f32, y: f32, t: f32) -> stochastic_sample
{
    var s: stochastic_sample;
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
fn stratified_time(stratum: f32, count: f32, jitter: f32) -> f32
{
    var place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + 1.0) * gnomon_stratum_end);
    place = gnomon_max(place, stratum * gnomon_stratum_begin);
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
fn slice_of(t: f32, count: f32) -> f32
{
    let slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - 1.0), 0.0);
}

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

const gnomon_layer_depth_limit: f32 = 2.0; // middle depths of surfaces lie in [-2, 2]
const gnomon_layer_no_cut: f32 = 3.0; // a cut behind all surfaces
const gnomon_layer_background_depth: f32 = 4.0; // the middle depth of the background
const gnomon_layer_unknown_depth: f32 = -4.0; // the middle depth of a sample of NaN
const gnomon_layer_last_bin: f32 = 63.0;
const gnomon_layer_least_extent: f32 = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; gnomon_layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: gnomon_layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
fn layer_middle_depth(s: stochastic_sample) -> f32
{
    let z = s.z + (0.5 - s.t) * s.d_z;
    let limit = gnomon_layer_depth_limit;
    let inside = gnomon_max(gnomon_min(z, limit), -1.0 * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    let size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    let known = size <= gnomon_texel_limit;
    let middle = gnomon_select(known, inside, gnomon_layer_unknown_depth);
    return gnomon_select(s.id < 0.0, gnomon_layer_background_depth, middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
fn gnomon_layer_is_surface(middle: f32) -> bool { return gnomon_abs(middle) <= gnomon_layer_depth_limit; }

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
struct gnomon_layer_window { least: f32, greatest: f32 }

/// The window of one sample, by its middle depth.
fn layer_window_begin(middle: f32) -> gnomon_layer_window
{
    let surface = gnomon_layer_is_surface(middle);
    var w: gnomon_layer_window;
    w.least = gnomon_select(surface, middle, gnomon_layer_background_depth);
    w.greatest = gnomon_select(surface, middle, gnomon_layer_unknown_depth);
    return w;
}

/// The window with one more sample, by its middle depth.
fn layer_window_add(given_window: gnomon_layer_window, middle: f32) -> gnomon_layer_window
{
    var window = given_window;
    let other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
fn layer_bin_of(middle: f32, window: gnomon_layer_window) -> f32
{
    let share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    let bin = gnomon_min(texel_below(64.0 * share), gnomon_layer_last_bin);
    return gnomon_select(gnomon_layer_is_surface(middle), bin, -1.0);
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
struct gnomon_layer_runs
{
    least: f32, greatest: f32, bins: f32, begun: f32, empty: f32,
    length0_: f32,
    length1_: f32, length2_: f32, centre0_: f32, centre1_: f32, centre2_: f32,
}

/// The state before bin 0.
fn layer_cuts_begin(window: gnomon_layer_window) -> gnomon_layer_runs
{
    var r: gnomon_layer_runs;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = 0.0;
    r.begun = 0.0;
    r.empty = 0.0;
    r.length0_ = 0.0;
    r.length1_ = 0.0;
    r.length2_ = 0.0;
    r.centre0_ = 0.0;
    r.centre1_ = 0.0;
    r.centre2_ = 0.0;
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
fn layer_cuts_add(given_state: gnomon_layer_runs, occupied: f32) -> gnomon_layer_runs
{
    var state = given_state;
    let some = 0.0 < occupied;
    let centre = state.bins - 0.5 * state.empty;
    let third = some && state.length2_ < state.empty;
    let second = some && state.length1_ < state.empty;
    let first = some && state.length0_ < state.empty;
    state.length2_ = gnomon_select(second, state.length1_, gnomon_select(third, state.empty, state.length2_));
    state.centre2_ = gnomon_select(second, state.centre1_, gnomon_select(third, centre, state.centre2_));
    state.length1_ = gnomon_select(first, state.length0_, gnomon_select(second, state.empty, state.length1_));
    state.centre1_ = gnomon_select(first, state.centre0_, gnomon_select(second, centre, state.centre1_));
    state.length0_ = gnomon_select(first, state.empty, state.length0_);
    state.centre0_ = gnomon_select(first, centre, state.centre0_);
    state.begun = gnomon_select(some, 1.0, state.begun);
    state.empty = gnomon_select(some, 0.0, state.empty + state.begun);
    state.bins = state.bins + 1.0;
    return state;
}

/// Depths that cut a window into layers, from near to far; gnomon_layer_no_cut for those that are not needed.
struct gnomon_layer_cuts { c0_: f32, c1_: f32, c2_: f32 }

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
fn layer_cuts_end(state: gnomon_layer_runs, layers: f32) -> gnomon_layer_cuts
{
    let none = gnomon_layer_no_cut;
    let extent = state.greatest - state.least;
    let surfaces = gnomon_layer_is_surface(state.least) && gnomon_layer_is_surface(state.greatest);
    let some = surfaces && gnomon_layer_least_extent <= extent;
    let per_bin = 0.015625 * extent;
    let first = some && 0.0 < state.length0_ && 1.0 < layers;
    let second = some && 0.0 < state.length1_ && 2.0 < layers;
    let third = some && 0.0 < state.length2_ && 3.0 < layers;
    let a = gnomon_select(first, state.least + per_bin * state.centre0_, none);
    let b = gnomon_select(second, state.least + per_bin * state.centre1_, none);
    let c = gnomon_select(third, state.least + per_bin * state.centre2_, none);
    let near_ab = gnomon_min(a, b);
    let far_ab = gnomon_max(a, b);
    let middle = gnomon_min(far_ab, c);
    var r: gnomon_layer_cuts;
    r.c0_ = gnomon_min(near_ab, middle);
    r.c1_ = gnomon_max(near_ab, middle);
    r.c2_ = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
fn layer_of(middle: f32, cuts: gnomon_layer_cuts) -> f32
{
    let known = gnomon_select(-1.0 * gnomon_layer_depth_limit <= middle, 0.0, -1.0);
    let first = gnomon_select(cuts.c0_ <= middle, 1.0, 0.0);
    let second = gnomon_select(cuts.c1_ <= middle, 1.0, 0.0);
    let third = gnomon_select(cuts.c2_ <= middle, 1.0, 0.0);
    let behind = gnomon_select(gnomon_layer_background_depth <= middle, 1.0, 0.0);
    return (known + first) + ((second + third) + behind);
}

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

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
struct gnomon_layer_motion_sums
{
    first_x: f32, first_y: f32, first_z: f32, x: f32, y: f32, z: f32, square: f32,
    square_z: f32, count: f32,
    least: f32, greatest: f32, least_d: f32, greatest_d: f32,
}

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
struct gnomon_layer_motion { d_x: f32, d_y: f32, d_z: f32, spread: f32, spread_z: f32, least: f32, greatest: f32 }

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
fn layer_motion_begin(first: stochastic_sample) -> gnomon_layer_motion_sums
{
    let limit = gnomon_texel_limit;
    var r: gnomon_layer_motion_sums;
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
fn gnomon_layer_motion_is_known(s: stochastic_sample, middle: f32) -> bool
{
    let length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= gnomon_texel_limit && gnomon_layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
fn layer_motion_add(given_state: gnomon_layer_motion_sums, s: stochastic_sample,
                    middle: f32) -> gnomon_layer_motion_sums
{
    var state = given_state;
    let known = gnomon_layer_motion_is_known(s, middle);
    let x = gnomon_select(known, s.d_x - state.first_x, 0.0);
    let y = gnomon_select(known, s.d_y - state.first_y, 0.0);
    let z = gnomon_select(known, s.d_z - state.first_z, 0.0);
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, 1.0, 0.0);
    let moved = s.z + (0.5 - s.t) * s.d_z;
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
fn layer_motion_end(state: gnomon_layer_motion_sums) -> gnomon_layer_motion
{
    let share = 1.0 / gnomon_max(state.count, 1.0);
    let x = state.x * share;
    let y = state.y * share;
    let z = state.z * share;
    let some = 0.0 < state.count;
    var r: gnomon_layer_motion;
    r.d_x = gnomon_select(some, state.first_x + x, 0.0);
    r.d_y = gnomon_select(some, state.first_y + y, 0.0);
    r.d_z = gnomon_select(some, state.first_z + z, 0.0);
    r.spread = gnomon_sqrt(gnomon_max(0.0, state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(0.0, state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    let off = 0.5 * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, 0.0);
    r.greatest = gnomon_select(some, state.greatest + off, 0.0);
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
struct layer_grid
{
    axis_x: f32, axis_y: f32, scale_u: f32, scale_v: f32, motion: f32, d_z: f32, middle: f32,
    centre: f32, scale: f32, spread: f32, spread_z: f32,
}

const gnomon_layer_least_motion: f32 = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
const gnomon_layer_least_depths: f32 = 0.0009765625; // 2^-10: no layer is stretched as if it were thinner

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
fn layer_grid_make(mean: gnomon_layer_motion, guard: f32, texels: f32) -> layer_grid
{
    let chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    let moves = gnomon_layer_least_motion <= chord;
    var g: layer_grid;
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
struct gnomon_layer_place { u: f32, v: f32 }

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
fn gnomon_layer_grid_turned(grid: layer_grid, x: f32, y: f32) -> gnomon_layer_place
{
    var r: gnomon_layer_place;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
fn layer_grid_place(grid: layer_grid, x: f32, y: f32, t: f32) -> gnomon_layer_place
{
    let turned = gnomon_layer_grid_turned(grid, x, y);
    var r: gnomon_layer_place;
    r.u = grid.scale_u * (turned.u + grid.motion * (0.5 - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
fn layer_place_is_inside(grid: layer_grid, place: gnomon_layer_place) -> f32
{
    let texels = 2.0 * grid.middle;
    let begun = 0.0 <= place.u && 0.0 <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, 1.0, 0.0);
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
fn layer_grid_depth(grid: layer_grid, z: f32, t: f32) -> f32 { return z + (0.5 - t) * grid.d_z; }

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
fn layer_grid_own_depth(grid: layer_grid, z: f32, t: f32) -> f32
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

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

const gnomon_layer_most_probes: f32 = 16.0;
const gnomon_layer_uniform_variance: f32 = 0x1.555556p-4; // 0.083333333333333333, 1/12, of a time between 0 and 1
const gnomon_layer_tent_growth: f32 = 0x1.99999ap-6; // 0.025, half of 0.05 texels per texel of motion
const gnomon_layer_tent_begin: f32 = 2.0; // texels of motion from which on the tent grows

/// Centre of a footprint, the vector from its one end to the other, the number of probes along that, and the mip level.
struct gnomon_layer_footprint { u: f32, v: f32, along_u: f32, along_v: f32, probes: f32, level: f32 }

/// The footprint of a world point that the light sees at (x0, y0) at time t0 and at (x1, y1) at time t1. (cross_x,
/// cross_y) is the second axis, the extent of a pixel on the map. Both ends are limited to the grid. The footprint is
/// at least `widening` texels of the map wide in either direction.
/// NaN: stays NaN in the place, with one probe; a NaN in the widths counts for nothing.
/// Source: Andersson 2015, Sec. 4.2
fn layer_footprint_make(grid: layer_grid, x0: f32, y0: f32, t0: f32, x1: f32, y1: f32, t1: f32, cross_x: f32,
                        cross_y: f32, widening: f32) -> gnomon_layer_footprint
{
    let last = grid.middle + grid.middle - 0.5; // the centre of the last texel
    var p0 = layer_grid_place(grid, x0, y0, t0);
    var p1 = layer_grid_place(grid, x1, y1, t1);
    p0.u = clamp_or_nan(p0.u, 0.5, last);
    p0.v = clamp_or_nan(p0.v, 0.5, last);
    p1.u = clamp_or_nan(p1.u, 0.5, last);
    p1.v = clamp_or_nan(p1.v, 0.5, last);
    let time_u = p1.u - p0.u;
    let time_v = p1.v - p0.v;
    let second = gnomon_layer_grid_turned(grid, cross_x, cross_y);
    let cross_u = grid.scale_u * second.u;
    let cross_v = grid.scale_v * second.v;
    let time_length = gnomon_sqrt(time_u * time_u + time_v * time_v);
    let cross_length = gnomon_sqrt(cross_u * cross_u + cross_v * cross_v);

    // The longer axis around the middle of the ends, limited to the grid.
    let over_time = cross_length <= time_length;
    let half_u = 0.5 * gnomon_select(over_time, time_u, cross_u);
    let half_v = 0.5 * gnomon_select(over_time, time_v, cross_v);
    let u = 0.5 * (p0.u + p1.u);
    let v = 0.5 * (p0.v + p1.v);
    let u0 = clamp_or_nan(u - half_u, 0.5, last);
    let v0 = clamp_or_nan(v - half_v, 0.5, last);
    let u1 = clamp_or_nan(u + half_u, 0.5, last);
    let v1 = clamp_or_nan(v + half_v, 0.5, last);
    var r: gnomon_layer_footprint;
    r.u = 0.5 * (u0 + u1);
    r.v = 0.5 * (v0 + v1);
    r.along_u = u1 - u0;
    r.along_v = v1 - v0;
    let longer = gnomon_sqrt(r.along_u * r.along_u + r.along_v * r.along_v);
    let shorter = gnomon_max(gnomon_min(cross_length, time_length), widening * grid.scale_v);
    var width = gnomon_max(gnomon_max(0.0625 * longer, shorter), 1.0); // a NaN becomes 1
    width = gnomon_min(width, grid.middle + grid.middle);
    let probes = -1.0 * texel_below(-1.0 * (longer / width)); // rounded up
    r.probes = gnomon_max(gnomon_min(probes, gnomon_layer_most_probes), 1.0);
    r.level = 0.0;
    let coarse = 1.0 < width;
    if (gnomon_any(coarse)) {
        r.level = gnomon_select(coarse, polynomial_log(width) * gnomon_exp_log2_e, 0.0);
    }
    return r;
}

/// The place of probe k, 0 to probes - 1.
fn layer_probe(footprint: gnomon_layer_footprint, k: f32) -> gnomon_layer_place
{
    let share = (k + 0.5) / footprint.probes - 0.5;
    var r: gnomon_layer_place;
    r.u = footprint.u + share * footprint.along_u;
    r.v = footprint.v + share * footprint.along_v;
    return r;
}

/// The texels of the map by which a layer's places are off at time t, since its samples move unlike: the spread of
/// motion times |1/2 - t|.
/// NaN: NaN.
fn layer_widening(grid: layer_grid, t: f32) -> f32 { return grid.spread * gnomon_abs(0.5 - t); }

/// The bias in [0, 2] to subtract from a receiver's depth at time t. slope_along and slope_across are the changes of
/// depth per texel of the map along the motion and across (layer_slope), or a bound on both. reach is the distance in
/// texels of the grid from a receiver to the farthest centre of a texel that its filter reads. What of the motion is
/// not the layer's adds to this: spread_z |1/2 - t| in depth, and spread |1/2 - t| texels along the slope. limit is the
/// largest bias of a slope.
/// Domain: any; reach, limit at least 0.
/// NaN: what is NaN counts for nothing.
/// Error: 8 2^-p of the result.
fn layer_bias(grid: layer_grid, slope_along: f32, slope_across: f32, t: f32, reach: f32, limit: f32) -> f32
{
    let off = layer_widening(grid, t);
    var gradient: depth_gradient;
    gradient.x = slope_along;
    gradient.y = slope_across;
    let rise = depth_bias_receiver_plane(gradient, reach / grid.scale_u + off, reach / grid.scale_v + off, limit);
    return gnomon_depth_bias_limit(rise + gnomon_depth_bias_limit(grid.spread_z * gnomon_abs(0.5 - t)));
}

/// Slopes of depth along the motion of a layer and across, from its gradient along x and y of the map.
/// Error: 2 2^-p (|x| + |y|).
fn layer_slope(grid: layer_grid, gradient: depth_gradient) -> depth_gradient
{
    let turned = gnomon_layer_grid_turned(grid, gradient.x, gradient.y);
    var r: depth_gradient;
    r.x = turned.u;
    r.y = turned.v;
    return r;
}

/// The least variance of the layer's own depth, for layer_visibility: `least` of depth itself, and what the spread of
/// motion adds over the shutter interval, (spread_z^2 + (slope spread)^2) / 12. slope is the change of depth per texel
/// of the map.
/// Domain: least at least 0.
/// NaN: stays NaN.
fn layer_minimum_variance(grid: layer_grid, slope: f32, least: f32) -> f32
{
    let tilted = slope * grid.spread;
    let moved = gnomon_layer_uniform_variance * (grid.spread_z * grid.spread_z + tilted * tilted);
    return (least + moved) * (grid.scale * grid.scale);
}

/// Half the width of the filter across a layer's motion, in texels of its grid: of a tent of full width 0.05 (|d| - 2)
/// texels of the map, at least 0, but not wider than the guard band of (guard - tile) / 2 texels on either side.
/// NaN: 0.
/// Source: Andersson 2015, Sec. 5
fn layer_tent_radius(grid: layer_grid, guard: f32, tile: f32) -> f32
{
    let radius = gnomon_layer_tent_growth * (grid.motion - gnomon_layer_tent_begin);
    let band = 0.5 * (guard - tile);
    return gnomon_max(gnomon_min(radius, band) * grid.scale_v, 0.0);
}

/// The weight of a row of texels at a distance in texels under a tent of this radius, not normalised: 1 at distance 0.
/// Domain: any distance; radius at least 0. For a radius up to 1 all other rows have weight 0.
/// NaN: 0.
fn layer_tent_weight(distance: f32, radius: f32) -> f32
{
    return saturate_or_zero(1.0 - gnomon_abs(distance) / gnomon_max(1.0, radius));
}

/// The neighbour of a tile along one axis, -1 or 1, and its weight, from 0 to 1/2.
struct gnomon_layer_neighbour { towards: f32, weight: f32 }

/// The neighbour on the side of x, in texels of the map from the tile's centre. Its weight is 0 up to a third of the
/// way to the border, 1/2 at the border, and linear between. With weights w_x and w_y of both axes the four tiles have
/// (1 - w_x) (1 - w_y), w_x (1 - w_y), (1 - w_x) w_y and w_x w_y: a look-up in all of them by these weights has no
/// border; one chosen at random with these probabilities is the paper's.
/// Domain: tile > 0.
/// NaN: weight 0.
/// Source: Andersson 2015, Sec. 5
fn layer_neighbour_at(x: f32, tile: f32) -> gnomon_layer_neighbour
{
    var r: gnomon_layer_neighbour;
    r.towards = gnomon_select(x < 0.0, -1.0, 1.0);
    r.weight = 0.5 * saturate_or_zero(3.0 * (gnomon_abs(x) / tile) - 0.5);
    return r;
}

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

/// Opacity and weight of a sample for a layer, each 0 or 1.
struct gnomon_layer_share { opacity: f32, weight: f32 }

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
fn layer_share_of(at: f32, layer: f32) -> gnomon_layer_share
{
    var r: gnomon_layer_share;
    r.opacity = gnomon_select(at == layer, 1.0, 0.0);
    r.weight = gnomon_select(layer <= at, 1.0, 0.0);
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
struct layer_sums { z: f32, zz: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
fn layer_sums_add(given_sums: layer_sums, z: f32, share: gnomon_layer_share) -> layer_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
    let x = clamp_or_high(z, -1.0, 1.0);
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
fn gnomon_layer_transmission(opacity: f32, weight: f32, intensity: f32, z: f32) -> f32
{
    let bound = gnomon_select(1.0 < z, 1.0, gnomon_select(-1.0 < z, intensity, 0.0));
    let known = gnomon_select(0.0 < weight, saturate_or_zero(opacity / weight), 0.0);
    return 1.0 - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight
/// of 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
fn layer_visibility(sums: layer_sums, z: f32, minimum_variance: f32) -> f32
{
    var b: variance_moments;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
struct gnomon_layer_moments4_sums { b1_: f32, b2_: f32, b3_: f32, b4_: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
fn layer_moments4_add(given_sums: gnomon_layer_moments4_sums, z: f32,
                      share: gnomon_layer_share) -> gnomon_layer_moments4_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
    let b = moments4_from_depth(clamp_or_high(z, -1.0, 1.0));
    sums.b1_ = sums.b1_ + a * b.b1_;
    sums.b2_ = sums.b2_ + a * b.b2_;
    sums.b3_ = sums.b3_ + a * b.b3_;
    sums.b4_ = sums.b4_ + a * b.b4_;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

const gnomon_layer_moments4_noise: f32 = 0x1.1b77c4p-25; // 3.3e-8, 1.1 times 2^-25, one rounding to float
const gnomon_layer_moments4_weight: f32 = 0x1.421f6p-22; // 3e-7, the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one
/// more, and those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and
/// so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
fn layer_moments4_visibility(sums: gnomon_layer_moments4_sums, z: f32, roundings: f32) -> f32
{
    let share = 1.0 / sums.opacity;
    var b: moments4_;
    b.b1_ = sums.b1_ * share;
    b.b2_ = sums.b2_ * share;
    b.b3_ = sums.b3_ * share;
    b.b4_ = sums.b4_ * share;
    let n = gnomon_max(1.0, roundings) * (sums.weight * share);
    let alpha = bias_weight_of_roundings(gnomon_layer_moments4_weight, n);
    var noise: moments4_;
    noise.b1_ = n * gnomon_layer_moments4_noise;
    noise.b2_ = noise.b1_;
    noise.b3_ = noise.b1_;
    noise.b4_ = noise.b1_;
    let h = hankel4_constant_bias(b, bias4_raw_b2_, bias4_raw_b4_, alpha);
    let intensity = certified4_constant_bias_lower(h, noise, bias4_raw_b2_, bias4_raw_b4_, alpha, z);
    return gnomon_layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
struct gnomon_layer_exponential_sums { warped: f32, opacity: f32, weight: f32 }

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
fn layer_exponential_add(given_sums: gnomon_layer_exponential_sums, z: f32, share: gnomon_layer_share,
                         settings: exponential_settings) -> gnomon_layer_exponential_sums
{
    var sums = given_sums;
    let a = share.weight * share.opacity;
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
fn layer_exponential_visibility(sums: gnomon_layer_exponential_sums, z: f32, settings: exponential_settings) -> f32
{
    var b: exponential_moment;
    b.warped = sums.warped / sums.opacity;
    return gnomon_layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
}

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

/// A fold over the samples of a layer: its mean motion, sums of squares and products of differences from that, and
/// their number.
struct gnomon_layer_direction_sums { d_x: f32, d_y: f32, xx: f32, xy: f32, yy: f32, count: f32 }

/// The mean motion of a layer, the direction in which its samples' motions differ most, and the inverse of four
/// standard deviations in that direction; 0 if they do not differ.
struct gnomon_layer_direction { d_x: f32, d_y: f32, axis_x: f32, axis_y: f32, scale: f32 }

// 2^-20 square texels: motions that differ less do not
const gnomon_layer_least_difference: f32 = 0.00000095367431640625;

/// The state before the first sample.
fn layer_direction_begin(motion: gnomon_layer_motion) -> gnomon_layer_direction_sums
{
    var r: gnomon_layer_direction_sums;
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
fn layer_direction_add(given_state: gnomon_layer_direction_sums, s: stochastic_sample,
                       middle: f32) -> gnomon_layer_direction_sums
{
    var state = given_state;
    let known = gnomon_layer_motion_is_known(s, middle);
    let x = gnomon_select(known, s.d_x - state.d_x, 0.0);
    let y = gnomon_select(known, s.d_y - state.d_y, 0.0);
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
fn layer_direction_end(state: gnomon_layer_direction_sums) -> gnomon_layer_direction
{
    let half_difference = 0.5 * (state.xx - state.yy);
    let radius = gnomon_sqrt(half_difference * half_difference + state.xy * state.xy);
    let larger = 0.5 * (state.xx + state.yy) + radius;
    // (xy, larger - xx) and (larger - yy, xy) are both along the axis: the one without cancellation.
    let steep = half_difference < 0.0;
    let long_part = radius + gnomon_abs(half_difference);
    let x = gnomon_select(steep, state.xy, long_part);
    let y = gnomon_select(steep, long_part, state.xy);
    let norm = gnomon_sqrt(x * x + y * y);
    let apart = 0.0 < norm;
    let square = larger / gnomon_max(state.count, 1.0);
    let differ = gnomon_layer_least_difference <= square;
    var r: gnomon_layer_direction;
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
fn layer_direction_key(direction: gnomon_layer_direction, s: stochastic_sample) -> f32
{
    let x = (s.d_x - direction.d_x) * direction.axis_x;
    let y = (s.d_y - direction.d_y) * direction.axis_y;
    let key = (x + y) * direction.scale;
    let limit = gnomon_layer_depth_limit;
    let inside = gnomon_max(gnomon_min(key, limit), -1.0 * limit);
    return gnomon_select(gnomon_abs(key) <= gnomon_texel_limit, inside, gnomon_layer_unknown_depth);
}

/// The key that divides a layer into two parts: the centre of the longest run of empty bins (layer_cuts_add) if that is
/// at least `bins` bins long, else gnomon_layer_no_cut. A few samples leave short runs anywhere.
/// NaN: a `bins` of NaN divides nothing.
fn layer_part_cut(state: gnomon_layer_runs, bins: f32) -> f32
{
    return gnomon_select(bins <= state.length0_, layer_cuts_end(state, 2.0).c0_, gnomon_layer_no_cut);
}

/// Opacity and weight, for part number `wanted` of layer number `layer`, of a sample that is in part `part` of layer
/// `at` at the middle depth `middle`. A sample of the other part has no opacity. It has weight if it is behind
/// `centre`, the middle of the wanted part's depths: where it is seen, one sees past that part.
/// NaN: no weight for an `at` of NaN, nor in the layer for a `part`, `middle` or `centre` of NaN. A part below 0 is a
/// NaN.
fn layer_share_of_part(at: f32, layer: f32, part: f32, wanted: f32, middle: f32, centre: f32) -> gnomon_layer_share
{
    var r = layer_share_of(at, layer);
    let other = at == layer && !(part == wanted);
    let past = centre < middle && 0.0 <= part;
    r.opacity = gnomon_select(other, 0.0, r.opacity);
    r.weight = gnomon_select(other && !past, 0.0, r.weight);
    return r;
}

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

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
struct receiver_path
{
    depth: depth_time_range,
    x0_: f32, y0_: f32, w0_: f32, x1_: f32, y1_: f32, w1_: f32,
}

/// A position in texels, texel centres at +0.5.
struct gnomon_texel_position { x: f32, y: f32 }

const gnomon_receiver_sample_limit: f32 = 1048576.0; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
fn receiver_path_at(path: receiver_path, t: f32) -> gnomon_texel_position
{
    let passed = range_elapsed(path.depth, t);
    let left = 1.0 - passed;
    let w = path.w0_ * left + path.w1_ * passed;
    var r: gnomon_texel_position;
    r.x = (path.x0_ * left + path.x1_ * passed) / w;
    r.y = (path.y0_ * left + path.y1_ * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
fn receiver_path_shift(given_path: receiver_path, dx: f32, dy: f32) -> receiver_path
{
    var path = given_path;
    path.x0_ = path.x0_ + dx * path.w0_;
    path.y0_ = path.y0_ + dy * path.w0_;
    path.x1_ = path.x1_ + dx * path.w1_;
    path.y1_ = path.y1_ + dy * path.w1_;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
fn receiver_path_clip(path: receiver_path, begin: f32, end: f32) -> receiver_path
{
    let passed0 = range_elapsed(path.depth, begin);
    let passed1 = range_elapsed(path.depth, end);
    let left0 = 1.0 - passed0;
    let left1 = 1.0 - passed1;
    var c: receiver_path;
    c.depth = range_clip(path.depth, begin, end);
    c.x0_ = path.x0_ * left0 + path.x1_ * passed0;
    c.y0_ = path.y0_ * left0 + path.y1_ * passed0;
    c.w0_ = path.w0_ * left0 + path.w1_ * passed0;
    c.x1_ = path.x0_ * left1 + path.x1_ * passed1;
    c.y1_ = path.y0_ * left1 + path.y1_ * passed1;
    c.w1_ = path.w0_ * left1 + path.w1_ * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
fn receiver_path_length(path: receiver_path) -> f32
{
    let dx = path.x1_ / path.w1_ - path.x0_ / path.w0_;
    let dy = path.y1_ / path.w1_ - path.y0_ / path.w0_;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
fn receiver_sample_count(path: receiver_path, most: f32) -> f32
{
    let wanted = gnomon_max(2.0 * receiver_path_length(path), 5.0); // a NaN becomes 5
    let limit = gnomon_min(gnomon_max(most, 5.0), gnomon_receiver_sample_limit);
    let count = gnomon_min(wanted, limit);
    let whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, 1.0, 0.0);
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
fn receiver_sample_time(path: receiver_path, k: f32, n: f32, jitter: f32) -> f32
{
    let passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0_ * (1.0 - passed) + path.depth.t1_ * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
struct gnomon_sampled_receiver { samples: f32, shadowed: f32 }

/// Begin with the number of samples to come.
fn sampled_receiver_begin(samples: f32) -> gnomon_sampled_receiver
{
    var r: gnomon_sampled_receiver;
    r.samples = samples;
    r.shadowed = 0.0;
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
fn sampled_receiver_add(given_state: gnomon_sampled_receiver, intensity: f32) -> gnomon_sampled_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
fn sampled_receiver_end(state: gnomon_sampled_receiver) -> f32 { return saturate_or_zero(state.shadowed /
                                                                                         state.samples); }

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

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
struct shutter_weights { w0_: f32, w1_: f32, w2_: f32, w3_: f32, w4_: f32, w5_: f32, w6_: f32, w7_: f32 }

/// Times at which a shutter opens and closes.
struct shutter_exposure { begin: f32, end: f32 }

const gnomon_shutter_weight_limit: f32 = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
fn gnomon_shutter_exposure_make(a: f32, b: f32) -> shutter_exposure
{
    let least = 0.00000095367431640625;
    let swapped = b < a;
    let open = gnomon_select(swapped, b, a);
    let close = gnomon_select(swapped, a, b);
    let brief = close - open < least;
    let early = gnomon_select(open <= 1.0, gnomon_min(open, 1.0 - least), open);
    var r: shutter_exposure;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
fn shutter_time(begin: f32, end: f32, share: f32) -> f32 { return begin * (1.0 - share) + end * share; }

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_box(t: f32, begin: f32, end: f32) -> f32 { return saturate_or_zero((t - begin) / (end - begin)); }

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_tent(t: f32, begin: f32, end: f32) -> f32
{
    let x = shutter_box(t, begin, end);
    let left = 1.0 - x;
    return gnomon_select(x < 0.5, 2.0 * (x * x), 1.0 - 2.0 * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
fn gnomon_shutter_weight(w: f32) -> f32 { return gnomon_select(0.0 < w, gnomon_min(w, gnomon_shutter_weight_limit),
                                                               0.0); }

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
fn gnomon_shutter_share(weight: f32, sum: f32) -> f32
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
fn shutter_line(t: f32, begin: f32, end: f32, w0: f32, w1: f32) -> f32
{
    let a = gnomon_shutter_weight(w0);
    let b = gnomon_shutter_weight(w1);
    let sum = a + b;
    let x = shutter_box(t, begin, end);
    let early = gnomon_select(0.0 < sum, saturate_or_zero(a / sum), 0.5);
    return saturate_or_zero(x * (early + (early * (1.0 - x) + (1.0 - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
fn shutter_weights_make(weights: shutter_weights) -> shutter_weights
{
    var w: shutter_weights;
    w.w0_ = gnomon_shutter_weight(weights.w0_);
    w.w1_ = gnomon_shutter_weight(weights.w1_);
    w.w2_ = gnomon_shutter_weight(weights.w2_);
    w.w3_ = gnomon_shutter_weight(weights.w3_);
    w.w4_ = gnomon_shutter_weight(weights.w4_);
    w.w5_ = gnomon_shutter_weight(weights.w5_);
    w.w6_ = gnomon_shutter_weight(weights.w6_);
    w.w7_ = gnomon_shutter_weight(weights.w7_);
    let sum = ((w.w0_ + w.w1_) + (w.w2_ + w.w3_)) + ((w.w4_ + w.w5_) + (w.w6_ + w.w7_));
    w.w0_ = gnomon_shutter_share(w.w0_, sum);
    w.w1_ = gnomon_shutter_share(w.w1_, sum);
    w.w2_ = gnomon_shutter_share(w.w2_, sum);
    w.w3_ = gnomon_shutter_share(w.w3_, sum);
    w.w4_ = gnomon_shutter_share(w.w4_, sum);
    w.w5_ = gnomon_shutter_share(w.w5_, sum);
    w.w6_ = gnomon_shutter_share(w.w6_, sum);
    w.w7_ = gnomon_shutter_share(w.w7_, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
fn shutter_piecewise(t: f32, begin: f32, end: f32, w: shutter_weights) -> f32
{
    let x = 8.0 * shutter_box(t, begin, end);
    let early = (w.w0_ * saturate_or_zero(x) + w.w1_ * saturate_or_zero(x - 1.0)) +
                (w.w2_ * saturate_or_zero(x - 2.0) + w.w3_ * saturate_or_zero(x - 3.0));
    let late = (w.w4_ * saturate_or_zero(x - 4.0) + w.w5_ * saturate_or_zero(x - 5.0)) +
               (w.w6_ * saturate_or_zero(x - 6.0) + w.w7_ * saturate_or_zero(x - 7.0));
    return gnomon_select(x < 8.0, saturate_or_zero(early + late), 1.0);
}

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

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
fn footprint_stratum(t: f32, count: f32) -> shutter_exposure
{
    let slice = slice_of(t, count);
    var r: shutter_exposure;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + 1.0) / count);
    return r;
}

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

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
struct gnomon_deep_layer { z0_: f32, z1_: f32, opacity: f32 }

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
fn deep_shadow_add(transmittance: f32, layer: gnomon_deep_layer, z_f: f32) -> f32
{
    let passed = saturate_or_zero((z_f - layer.z0_) / (layer.z1_ - layer.z0_));
    return transmittance * (1.0 - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
fn deep_shadow_end(transmittance: f32) -> f32 { return saturate_or_zero(1.0 - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
fn deep_shadow_share(r: depth_time_range, z_f: f32) -> f32
{
    let c = range_clip(r, 0.0, 1.0);
    let nearest = gnomon_min(c.z0_, c.z1_);
    let passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0_, c.z1_) - nearest));
    let known = c.z0_ == c.z0_ && c.z1_ == c.z1_;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, 0.0));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if
/// the line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
struct gnomon_deep_window
{
    tolerance: f32, z0_: f32, v0_: f32, z1_: f32, v1_: f32, least: f32, most: f32, v: f32,
    touched: f32,
    layer: gnomon_deep_layer,
}

const gnomon_deep_window_steepest: f32 = 1099511627776.0; // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
fn deep_window_end(window: gnomon_deep_window) -> gnomon_deep_layer
{
    var r: gnomon_deep_layer;
    r.z0_ = window.z0_;
    r.z1_ = window.z1_;
    r.opacity = saturate_or_zero((window.v0_ - window.v1_) / window.v0_);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
fn gnomon_deep_window_next(given_window: gnomon_deep_window) -> gnomon_deep_window
{
    var window = given_window;
    window.layer = deep_window_end(window);
    window.z0_ = window.z1_;
    window.v0_ = window.v1_;
    window.least = -1.0 * gnomon_deep_window_steepest;
    window.most = 0.0;
    window.touched = 0.0;
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the
/// polyline. With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
fn deep_window_begin(tolerance: f32) -> gnomon_deep_window
{
    var r: gnomon_deep_window;
    r.tolerance = gnomon_max(tolerance, 0.0);
    r.z0_ = -1.0;
    r.v0_ = 1.0;
    r.z1_ = -1.0;
    r.v1_ = 1.0;
    r.v = 1.0;
    return gnomon_deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
fn gnomon_deep_window_lead(given_window: gnomon_deep_window, z: f32, v: f32) -> gnomon_deep_window
{
    var window = given_window;
    let length = z - window.z0_;
    let lowest = (gnomon_max(v - window.tolerance, 0.0) - window.v0_) / length;
    let highest = (v + window.tolerance - window.v0_) / length;
    let least = gnomon_max(window.least, lowest);
    let most = gnomon_min(window.most, highest);
    let nearest = saturate_or_zero(clamp_or_high(v, window.v0_ + least * length, window.v0_ + most * length));
    let level = window.touched < 1.0 && v == window.v && window.z1_ < z; // no line begins before a drop
    let step = length * gnomon_deep_window_steepest <= 1.0;
    let kept = level || (step && window.v0_ <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, 1.0, least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, 0.0, most));
    window.v1_ = gnomon_select(kept, window.v0_, gnomon_select(step, v, nearest));
    window.z0_ = gnomon_select(level, z, window.z0_);
    window.touched = gnomon_select(level, 0.0, 1.0);
    window.z1_ = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
fn gnomon_deep_window_select(mask: bool, a: gnomon_deep_window, given_b: gnomon_deep_window) -> gnomon_deep_window
{
    var b = given_b;
    b.z0_ = gnomon_select(mask, a.z0_, b.z0_);
    b.v0_ = gnomon_select(mask, a.v0_, b.v0_);
    b.z1_ = gnomon_select(mask, a.z1_, b.z1_);
    b.v1_ = gnomon_select(mask, a.v1_, b.v1_);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0_ = gnomon_select(mask, a.layer.z0_, b.layer.z0_);
    b.layer.z1_ = gnomon_select(mask, a.layer.z1_, b.layer.z1_);
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
fn deep_window_add(given_window: gnomon_deep_window, given_z: f32, given_v: f32) -> gnomon_deep_window
{
    var v = given_v;
    var z = given_z;
    var window = given_window;
    let known = gnomon_abs(z) < range_far && v == v;
    let touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1_), window.z1_);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = 0.0;
    var led = gnomon_deep_window_lead(window, z, v);
    let deeper = window.most < window.least && (z - window.z0_) * gnomon_deep_window_steepest <= 1.0;
    let done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) { led = gnomon_deep_window_select(done,
                                                            gnomon_deep_window_lead(gnomon_deep_window_next(window), z,
                                                                                    v), led); }
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
}

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

/// The best cover so far, and the nearest depth of all other ranges.
struct range_cover
{
    best: depth_time_range,
    front: f32, far_plane: f32,
}

/// The answer of a cover for one receiver: shadow intensity, 0 or 1, and decided, which is 1 if that is the answer of
/// the whole texel and 0 if the list has to be tested.
struct gnomon_cover_answer { intensity: f32, decided: f32 }

const gnomon_cover_margin: f32 = 0.0000019073486328125; // 2^-19, 32 2^-p in float

/// Begin without a range. Covers must not lie behind far_plane, which is 1.
fn range_cover_begin(far_plane: f32) -> range_cover
{
    var state: range_cover;
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
fn range_cover_add(given_state: range_cover, r: depth_time_range) -> range_cover
{
    var state = given_state;
    let near_depth = gnomon_min(r.z0_, r.z1_);
    let far_depth = gnomon_max(r.z0_, r.z1_);
    let best_near = gnomon_min(state.best.z0_, state.best.z1_);
    let best_far = gnomon_max(state.best.z0_, state.best.z1_);
    let some = r.t0_ <= r.t1_ && r.z0_ == r.z0_ && r.z1_ == r.z1_;
    let within = gnomon_abs(r.z0_) <= state.far_plane && gnomon_abs(r.z1_) <= state.far_plane;
    let full = some && r.t0_ <= 0.0 && 1.0 <= r.t1_ && within && 0.0 <= r.id;
    let first = state.best.id < 0.0;
    let tie = far_depth == best_far;
    let tie_wins = near_depth < best_near || (near_depth == best_near && r.id < state.best.id);
    let better = full && (first || far_depth < best_far || (tie && tie_wins));

    let other = gnomon_select(better, gnomon_select(first, state.far_plane, best_near), near_depth);
    state.front = gnomon_select(some && other < state.front, other, state.front);
    state.best = gnomon_range_select(better, r, state.best);
    return state;
}

/// The cover, or an empty range with the id -1: the best range if no other one is ever nearer than its farther end.
/// Source: Hong & Oh 2017
fn range_cover_end(state: range_cover) -> depth_time_range
{
    let covers = gnomon_max(state.best.z0_, state.best.z1_) <= state.front;
    return gnomon_range_select(covers, state.best, range_empty(-1.0));
}

/// 1 where r may be left out of a list that keeps the cover: r is never nearer than the cover's farther end, or shadows
/// nothing. A receiver behind r is then behind the cover at all times, and shadowed by the cover, in spite of the
/// rounding of range_depth: the margin outweighs that rounding, and keeps a level cover from occluding itself. So a
/// receiver gets the answer of all ranges, unless it has the cover's id and the cover is in front of it by more than
/// its bias (see range_list.h for ids).
/// Domain: depths in [-1, 1], times in [0, 1].
fn range_cover_occludes(cover: depth_time_range, r: depth_time_range) -> f32
{
    let some = r.t0_ <= r.t1_ && r.z0_ == r.z0_ && r.z1_ == r.z1_;
    let behind = gnomon_max(cover.z0_, cover.z1_) + gnomon_cover_margin;
    let hidden = 0.0 <= cover.id && behind <= gnomon_min(r.z0_, r.z1_);
    return gnomon_select(hidden || !some, 1.0, 0.0);
}

/// Shadow test at time t and depth z on the surface with the given id. Where decided, the answer is that of all ranges
/// of the texel, bit for bit. The receiver is shadowed where z is more than the bias behind the cover and the cover has
/// another id. The receiver is lit where z is within the bias, less 2^-19, of the cover's farther end, since nothing
/// else is in front of the cover. Between the two, and without a cover, the answer is undecided. The paper compares no
/// depths: its test shadows a neighbouring triangle that lies in front of the cover, but falls into the cover's texel
/// by the map's resolution.
/// Domain: times in [0, 1], depths in [-1, 1], bias in [0, 1].
fn range_cover_answer(cover: depth_time_range, t: f32, z: f32, id: f32, bias: f32) -> gnomon_cover_answer
{
    var r: gnomon_cover_answer;
    r.intensity = range_intensity(cover, t, z, id, bias);
    let behind = gnomon_max(cover.z0_, cover.z1_) + bias;
    let lit = z + gnomon_cover_margin <= behind;
    r.decided = gnomon_select(0.0 <= cover.id && (lit || 0.0 < r.intensity), 1.0, 0.0);
    return r;
}

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

/// The sum of moments weighted by time, the time that is covered, and the depth of the times that are not.
struct range_moments4_
{
    sum: moments4_,
    covered: f32, background: f32,
}

const range_moments_third: f32 = 0x1.555556p-2; // 0.33333333333333333333
const range_moments_fifth: f32 = 0x1.99999ap-3; // 0.2

/// The means of the first four powers of depth over the time of a range.
/// Domain: depths in [-1, 1].
/// NaN: NaN.
/// Error: 4 2^-p.
fn range_mean_moments4_(r: depth_time_range) -> moments4_
{
    let product = r.z0_ * r.z1_;
    let squares = r.z0_ * r.z0_ + r.z1_ * r.z1_;
    var m: moments4_;
    m.b1_ = 0.5 * (r.z0_ + r.z1_);
    m.b2_ = range_moments_third * (squares + product);
    m.b3_ = 0.5 * (squares * m.b1_);
    m.b4_ = range_moments_fifth * ((squares * squares - product * product) + squares * product);
    return m;
}

/// Begin without a range. Times that no range covers have the depth `background`, 1 for a cleared map.
fn range_moments4_begin(background: f32) -> range_moments4_
{
    var state: range_moments4_;
    state.sum.b1_ = 0.0;
    state.sum.b2_ = 0.0;
    state.sum.b3_ = 0.0;
    state.sum.b4_ = 0.0;
    state.covered = 0.0;
    state.background = background;
    return state;
}

/// Add one range that is disjoint in time from those before.
/// NaN: a range with a NaN adds nothing.
fn range_moments4_add(given_state: range_moments4_, r: depth_time_range) -> range_moments4_
{
    var state = given_state;
    let c = range_clip(r, 0.0, 1.0);
    let duration = gnomon_select(c.z0_ == c.z0_ && c.z1_ == c.z1_, range_duration(c), 0.0);
    let some = 0.0 < duration;
    let sum = moments4_add(state.sum, range_mean_moments4_(c), duration);
    state.sum.b1_ = gnomon_select(some, sum.b1_, state.sum.b1_);
    state.sum.b2_ = gnomon_select(some, sum.b2_, state.sum.b2_);
    state.sum.b3_ = gnomon_select(some, sum.b3_, state.sum.b3_);
    state.sum.b4_ = gnomon_select(some, sum.b4_, state.sum.b4_);
    state.covered = state.covered + duration;
    return state;
}

/// The moments of depth over the shutter interval.
/// Domain: ranges of a resolved list, depths in [-1, 1].
/// Error: 8 2^-p for each range.
fn range_moments4_end(state: range_moments4_) -> moments4_
{
    let open = saturate_or_zero(1.0 - state.covered);
    return moments4_add(state.sum, moments4_from_depth(state.background), open);
}

// motion/range/range_summary.h ----------------------------------------------------------------------------------------
// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
struct range_summary { nearest: f32, farthest: f32, shadowed: f32, id: f32 }

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
fn range_summary_begin(near_plane: f32) -> range_summary
{
    var summary: range_summary;
    summary.nearest = range_far;
    summary.farthest = near_plane;
    summary.shadowed = 0.0;
    summary.id = range_nothing;
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
fn range_summary_add(given_summary: range_summary, r: depth_time_range) -> range_summary
{
    var summary = given_summary;
    let some = r.t0_ < r.t1_ && r.z0_ == r.z0_ && r.z1_ == r.z1_;
    let first = summary.id == range_nothing;
    let nearest = gnomon_min(summary.nearest, gnomon_min(r.z0_, r.z1_));
    let farthest = gnomon_max(summary.farthest, gnomon_max(r.z0_, r.z1_));
    let share = saturate_or_zero(r.t1_) - saturate_or_zero(r.t0_);
    let id = gnomon_select(first || summary.id == r.id, r.id, range_mixed);
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
fn gnomon_range_is_second_layer(front: depth_time_range, r: depth_time_range) -> bool
{
    return front.t0_ <= r.t0_ && r.t0_ < front.t1_ && r.t1_ <= front.t1_;
}

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

/// A step of the transmittance of a list: from t0 to t1 the same ranges are in front of the receiver.
struct range_transmittance { t0_: f32, t1_: f32, transmittance: f32 }

/// Begin a step at time t, without a range. It lasts until end at most.
fn range_transmittance_begin(t: f32, end: f32) -> range_transmittance
{
    var step: range_transmittance;
    step.t0_ = t;
    step.t1_ = end;
    step.transmittance = 1.0;
    return step;
}

/// Add a range of the given opacity by `hidden`, its part in front of the receiver. The step ends when that part begins
/// or ends next. A range of the receiver's own id takes no light.
/// Domain: an opacity in [0, 1], and is clamped to that.
/// NaN: a range, or an opacity, with a NaN takes no light.
/// Error: after n ranges, 2 n 2^-p of the transmittance.
fn range_transmittance_add(given_step: range_transmittance, hidden: depth_time_range, id: f32,
                           opacity: f32) -> range_transmittance
{
    var step = given_step;
    let counts = hidden.t0_ < hidden.t1_ && !(hidden.id == id);
    let during = counts && hidden.t0_ <= step.t0_ && step.t0_ < hidden.t1_;
    let later = counts && step.t0_ < hidden.t0_;
    let change = gnomon_select(during, hidden.t1_, gnomon_select(later, hidden.t0_, step.t1_));
    step.t1_ = gnomon_min(step.t1_, change);
    let passing = 1.0 - saturate_or_zero(opacity);
    step.transmittance = gnomon_select(during, step.transmittance * passing, step.transmittance);
    return step;
}

/// Share of the light that a receiver loses during the step, in [0, 1]. The shutter has let in the shares share0 and
/// share1 of the exposure's light at the begin and at the end of the step.
/// NaN: 0.
/// Error: of the share let in, 4 2^-p, and that of the transmittance.
fn range_transmittance_lost(step: range_transmittance, share0: f32, share1: f32) -> f32
{
    return saturate_or_zero(share1 - share0) * saturate_or_zero(1.0 - step.transmittance);
}

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

/// A vector at shutter open and at shutter close.
struct gnomon_moving_vector { x0_: f32, y0_: f32, z0_: f32, x1_: f32, y1_: f32, z1_: f32 }

/// The facing function f as an edge function, for moving_edge_inside with facing 1.
/// Domain: beyond gnomon_moving_edge_limit f is 0 at all times, so the surface counts as facing the light.
/// NaN: f is 0 at all times, too.
/// Error: 4 2^-p |n| |d| for a coefficient, with the larger lengths of both ends; the facing times are exact for
/// coefficients that differ by 20 2^-p |n| |d|.
/// Source: Palmer 2011, Eq. 2.5; Palmer 2011, Eq. 2.6
fn facing_function(n: gnomon_moving_vector, d: gnomon_moving_vector) -> gnomon_moving_edge
{
    let n0_d1 = (n.x0_ * d.x1_ + n.y0_ * d.y1_) + n.z0_ * d.z1_;
    let n1_d0 = (n.x1_ * d.x0_ + n.y1_ * d.y0_) + n.z1_ * d.z0_;
    var f: gnomon_moving_edge;
    f.e0_ = (n.x0_ * d.x0_ + n.y0_ * d.y0_) + n.z0_ * d.z0_;
    f.e1_ = 0.5 * (n0_d1 + n1_d0);
    f.e2_ = (n.x1_ * d.x1_ + n.y1_ * d.y1_) + n.z1_ * d.z1_;
    let known = gnomon_moving_edge_size(f) < gnomon_moving_edge_limit;
    f.e0_ = gnomon_select(known, f.e0_, 0.0);
    f.e1_ = gnomon_select(known, f.e1_, 0.0);
    f.e2_ = gnomon_select(known, f.e2_, 0.0);
    return f;
}

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

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is
/// the centre of the texel.
struct line_sample { t: f32, along_x: f32, along_y: f32 }

/// A texel along a line's direction, and the place on its line, in [0, 1].
struct line_sample_place { texel: f32, place: f32 }

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
fn line_sample_vertex(v: gnomon_moving_vertex, segment: line_sample) -> gnomon_moving_vertex
{
    let s = 1.0 - segment.t;
    let x = v.x0_ * s + v.x1_ * segment.t;
    let y = v.y0_ * s + v.y1_ * segment.t;
    var r: gnomon_moving_vertex;
    r.z0_ = v.z0_ * s + v.z1_ * segment.t;
    r.w0_ = v.w0_ * s + v.w1_ * segment.t;
    r.z1_ = r.z0_;
    r.w1_ = r.w0_;
    let half_x = (0.5 * segment.along_x) * r.w0_;
    let half_y = (0.5 * segment.along_y) * r.w0_;
    r.x0_ = x + half_x;
    r.y0_ = y + half_y;
    r.x1_ = x - half_x;
    r.y1_ = y - half_y;
    return r;
}

/// The texel that holds a position along the direction of lines, and the place on its line.
/// Domain: positions in [-65536, 65536].
/// NaN: place 0.
/// Error: exact for positions not below 0; else 2^-p.
fn line_sample_place_of(x: f32) -> line_sample_place
{
    var r: line_sample_place;
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
fn line_sample_intensity(up: f32, down: f32, left: f32, right: f32, share_x: f32, share_y: f32) -> f32
{
    let a = saturate_or_zero(up);
    let b = saturate_or_zero(down);
    let c = saturate_or_zero(left);
    let d = saturate_or_zero(right);
    let x = saturate_or_zero(share_x);
    let y = saturate_or_zero(share_y);
    let mean = 0.5 * ((a * (1.0 - y) + b * y) + (c * (1.0 - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
}

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

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
struct static_receiver { depth: f32, id: f32, begin: f32, end: f32, weight: f32, shadowed: f32 }

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of gnomon_shutter_exposure_make.
fn static_receiver_begin(z_f: f32, id: f32, begin: f32, end: f32) -> static_receiver
{
    let open = gnomon_shutter_exposure_make(begin, end);
    var r: static_receiver;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
fn static_receiver_set_weight(given_state: static_receiver, weight: f32) -> static_receiver
{
    var state = given_state;
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
fn static_receiver_occluding_part(state: static_receiver, r: depth_time_range) -> depth_time_range
{
    var level: depth_time_range;
    level.t0_ = state.begin;
    level.t1_ = state.end;
    level.z0_ = state.depth;
    level.z1_ = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
fn receiver_lost_light(hidden: depth_time_range, id: f32, share0: f32, share1: f32) -> f32
{
    return gnomon_select(hidden.id == id, 0.0, saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
fn static_receiver_add(given_state: static_receiver, lost: f32) -> static_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
fn receiver_is_in_front(z_f: f32, summary: range_summary) -> f32 { return gnomon_select(z_f <= summary.nearest, 1.0,
                                                                                        0.0); }

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
fn static_receiver_is_behind(state: static_receiver, summary: range_summary) -> f32
{
    let whole = state.begin <= 0.0 && 1.0 <= state.end;
    let own = summary.id == range_mixed || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, 1.0, 0.0);
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
fn static_receiver_end(state: static_receiver) -> f32 { return saturate_or_zero(state.shadowed); }

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

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
struct texel_sweep
{
    path: receiver_path,
    column: f32, row: f32, t_begin: f32, t_end: f32, last_column: f32,
    last_row: f32, t_last: f32, across_column: f32, across_row: f32,
}

const gnomon_texel_path_limit: f32 = 1152921504606846976.0; // 2^60: positions that are numbers
const gnomon_texel_border_none: f32 = 2.0; // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
fn gnomon_texel_border_share(x0: f32, w0: f32, x1: f32, w1: f32, texel: f32, last: f32) -> f32
{
    let border = texel + gnomon_select(texel < last, 1.0, 0.0);
    let distance0 = x0 - gnomon_product(border, w0);
    let distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, gnomon_texel_border_none,
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
fn gnomon_texel_sweep_set_times(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let passed = gnomon_min(sweep.across_column, sweep.across_row);
    var t = sweep.path.depth.t0_ * (1.0 - passed) + sweep.path.depth.t1_ * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= 1.0, t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
fn gnomon_texel_sweep_start(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let p = sweep.path;
    sweep.across_column = gnomon_texel_border_share(p.x0_, p.w0_, p.x1_, p.w1_, sweep.column, sweep.last_column);
    sweep.across_row = gnomon_texel_border_share(p.y0_, p.w0_, p.y1_, p.w1_, sweep.row, sweep.last_row);
    return gnomon_texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
fn texel_sweep_begin(path: receiver_path) -> texel_sweep
{
    let x0 = path.x0_ / path.w0_;
    let y0 = path.y0_ / path.w0_;
    let x1 = path.x1_ / path.w1_;
    let y1 = path.y1_ / path.w1_;
    let size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    let known = 0.0 < path.w0_ && 0.0 < path.w1_ && size < gnomon_texel_path_limit;
    var sweep: texel_sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0_;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1_;
    return gnomon_texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
fn gnomon_receiver_path_over(p: receiver_path, left: f32, top: f32, right: f32, bottom: f32) -> gnomon_linear_interval
{
    var a = linear_edge_inside(p.x0_ - gnomon_product(left, p.w0_), p.x1_ - gnomon_product(left, p.w1_));
    let b = linear_edge_inside(p.y0_ - gnomon_product(top, p.w0_), p.y1_ - gnomon_product(top, p.w1_));
    let c = linear_edge_inside(gnomon_product(right, p.w0_) - p.x0_, gnomon_product(right, p.w1_) - p.x1_);
    let d = linear_edge_inside(gnomon_product(bottom, p.w0_) - p.y0_, gnomon_product(bottom, p.w1_) - p.y1_);
    let before_light = linear_edge_inside(p.w0_, p.w1_);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
fn gnomon_texel_clamp(x: f32, low: f32, high: f32) -> f32
{
    return gnomon_min(gnomon_max(texel_below(x), low - 1.0), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
fn texel_sweep_over(path: receiver_path, left: f32, top: f32, right: f32, bottom: f32) -> texel_sweep
{
    let shares = gnomon_receiver_path_over(path, left, top, right, bottom);
    let some = shares.begin < shares.end;
    let passed0 = gnomon_select(some, shares.begin, 0.0);
    let passed1 = gnomon_select(some, shares.end, 0.0);
    let left0 = 1.0 - passed0;
    let left1 = 1.0 - passed1;
    let w0 = path.w0_ * left0 + path.w1_ * passed0;
    let w1 = path.w0_ * left1 + path.w1_ * passed1;
    var sweep: texel_sweep;
    sweep.path = path;
    sweep.column = gnomon_texel_clamp((path.x0_ * left0 + path.x1_ * passed0) / w0, left, right);
    sweep.row = gnomon_texel_clamp((path.y0_ * left0 + path.y1_ * passed0) / w0, top, bottom);
    sweep.last_column = gnomon_texel_clamp((path.x0_ * left1 + path.x1_ * passed1) / w1, left, right);
    sweep.last_row = gnomon_texel_clamp((path.y0_ * left1 + path.y1_ * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0_ * left0 + path.depth.t1_ * passed0;
    sweep.t_last = path.depth.t0_ * left1 + path.depth.t1_ * passed1;
    return gnomon_texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
fn texel_sweep_next(given_sweep: texel_sweep) -> texel_sweep
{
    var sweep = given_sweep;
    let sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= 1.0;
    let along = sweep.across_row < sweep.across_column && sweep.across_row <= 1.0;
    let step_column = gnomon_select(sweep.column < sweep.last_column, 1.0, -1.0);
    let step_row = gnomon_select(sweep.row < sweep.last_row, 1.0, -1.0);
    sweep.column = sweep.column + gnomon_select(sideways, step_column, 0.0);
    sweep.row = sweep.row + gnomon_select(along, step_row, 0.0);
    // Only the axis that stepped has a new border.
    let x0 = gnomon_select(sideways, sweep.path.x0_, sweep.path.y0_);
    let x1 = gnomon_select(sideways, sweep.path.x1_, sweep.path.y1_);
    let texel = gnomon_select(sideways, sweep.column, sweep.row);
    let last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    let passed = gnomon_texel_border_share(x0, sweep.path.w0_, x1, sweep.path.w1_, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return gnomon_texel_sweep_set_times(sweep);
}

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

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
struct moving_receiver
{
    depth: depth_time_range,
    begin: f32, end: f32, t0_: f32, t1_: f32, u0_: f32, v0_: f32,
    u1_: f32, v1_: f32, shadowed: f32,
}

/// Begin without a texel. The exposure lasts from begin to end, as of gnomon_shutter_exposure_make. A depth bias, if
/// one is needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses
/// light only in that part: divide the result by the shutter's share of that part.
fn moving_receiver_begin(path: receiver_path, begin: f32, end: f32) -> moving_receiver
{
    let open = gnomon_shutter_exposure_make(begin, end);
    var r: moving_receiver;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0_ = path.depth.t0_;
    r.t1_ = path.depth.t1_;
    r.u0_ = 1.0;
    r.v0_ = 1.0;
    r.u1_ = 1.0;
    r.v1_ = 1.0;
    r.shadowed = 0.0;
    return r;
}

/// Begin the ranges of the sweep's texel.
fn moving_receiver_texel(given_state: moving_receiver, sweep: texel_sweep) -> moving_receiver
{
    var state = given_state;
    state.t0_ = sweep.t_begin;
    state.t1_ = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
fn moving_receiver_tap(given_state: moving_receiver, sweep: texel_sweep, i: f32, j: f32,
                       look_ups: f32) -> moving_receiver
{
    var state = given_state;
    let enters = receiver_path_at(sweep.path, sweep.t_begin);
    let leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0_ = sweep.t_begin;
    state.t1_ = sweep.t_end;
    state.u0_ = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0_ = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1_ = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1_ = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
fn moving_receiver_occluding_part(state: moving_receiver, r: depth_time_range) -> depth_time_range
{
    return range_occluding_part(r, state.depth, state.t0_, state.t1_);
}

/// Add the share of the light that is lost to one range.
fn moving_receiver_add(given_state: moving_receiver, lost: f32) -> moving_receiver
{
    var state = given_state;
    state.shadowed = state.shadowed + lost;
    return state;
}

const gnomon_receiver_twelfth: f32 = 0x1.555556p-4; // 0.083333333333333333333, Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
fn moving_receiver_filtered_light(state: moving_receiver, hidden: depth_time_range, start: f32, stop: f32,
                                  response: f32, slope: f32) -> f32
{
    let a = gnomon_max(hidden.t0_, start);
    let b = gnomon_min(hidden.t1_, stop);
    let some = a < b;
    var lost = 0.0;
    if (gnomon_any(some)) {
        let share_a = shutter_box(a, state.begin, state.end);
        let share_b = shutter_box(b, state.begin, state.end);
        let passed_a = saturate_or_zero((a - state.t0_) / (state.t1_ - state.t0_));
        let passed_b = saturate_or_zero((b - state.t0_) / (state.t1_ - state.t0_));
        let u_a = state.u0_ * (1.0 - passed_a) + state.u1_ * passed_a;
        let v_a = state.v0_ * (1.0 - passed_a) + state.v1_ * passed_a;
        let u_b = state.u0_ * (1.0 - passed_b) + state.u1_ * passed_b;
        let v_b = state.v0_ * (1.0 - passed_b) + state.v1_ * passed_b;
        let aa = u_a * v_a;
        let ab = u_a * v_b + u_b * v_a;
        let bb = u_b * v_b;
        let twelvefold = (response + slope * share_a) * (3.0 * aa + ab + bb) + (response + slope * share_b) *
                         (aa + ab + 3.0 * bb);
        let share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
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
fn moving_receiver_end(state: moving_receiver) -> f32 { return saturate_or_zero(state.shadowed); }

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

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
struct time_dependent_sample { z: f32, t: f32, d_z: f32, travel: f32 }

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
fn time_dependent_travel(d_x: f32, d_y: f32) -> f32 { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
fn time_dependent_depth(s: time_dependent_sample, t_r: f32) -> f32 { return s.z + s.d_z * (t_r - s.t); }

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself;
/// the factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
fn time_dependent_biased_depth(s: time_dependent_sample, t_r: f32, slope: f32, texels: f32) -> f32
{
    let passed = gnomon_abs(t_r - s.t);
    let reach = texels + 1.5 * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(0.0, slope) * reach;
}

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

/// An affine function of the sample: c + x s_x + y s_y.
struct gnomon_sample_plane { x: f32, y: f32, c: f32 }

/// Bernstein coefficients of an edge function, as affine functions of the sample.
struct gnomon_edge_equation { e0_: gnomon_sample_plane, e1_: gnomon_sample_plane, e2_: gnomon_sample_plane }

/// The edge equations opposite to the vertices a, b, c of a triangle.
struct triangle_setup { a: gnomon_edge_equation, b: gnomon_edge_equation, c: gnomon_edge_equation }

/// Bernstein coefficients of N as affine functions of the sample, the middle ones times 3; z_c at shutter open and
/// close; the least and the largest depth of all vertices, in [-1, 1].
struct depth_setup
{
    n0_: gnomon_sample_plane, n1_: gnomon_sample_plane, n2_: gnomon_sample_plane,
    n3_: gnomon_sample_plane,
    z0_: f32, z1_: f32, least: f32, most: f32,
}

/// Depth at one sample: the coefficients of N, the coefficients of D with the middle one times 2, and the rest as in
/// depth_setup.
struct depth_curve { n0_: f32, n1_: f32, n2_: f32, n3_: f32, d0_: f32, d1_: f32, d2_: f32, z0_: f32, z1_: f32,
    least: f32, most: f32 }

/// Homogeneous line through two points of the plane.
fn gnomon_homogeneous_line(a_x: f32, a_y: f32, a_w: f32, b_x: f32, b_y: f32, b_w: f32) -> gnomon_sample_plane
{
    var r: gnomon_sample_plane;
    r.x = gnomon_sheared_cross(a_y, a_w, b_y, b_w);
    r.y = gnomon_sheared_cross(a_w, a_x, b_w, b_x);
    r.c = gnomon_sheared_cross(a_x, a_y, b_x, b_y);
    return r;
}

/// Edge equation from a to b. Exchanging a and b negates it bit for bit.
fn edge_equation_make(a: gnomon_moving_vertex, b: gnomon_moving_vertex) -> gnomon_edge_equation
{
    let early = gnomon_homogeneous_line(a.x0_, a.y0_, a.w0_, b.x1_, b.y1_, b.w1_);
    let late = gnomon_homogeneous_line(a.x1_, a.y1_, a.w1_, b.x0_, b.y0_, b.w0_);
    var f: gnomon_edge_equation;
    f.e0_ = gnomon_homogeneous_line(a.x0_, a.y0_, a.w0_, b.x0_, b.y0_, b.w0_);
    f.e1_.x = 0.5 * (early.x + late.x);
    f.e1_.y = 0.5 * (early.y + late.y);
    f.e1_.c = 0.5 * (early.c + late.c);
    f.e2_ = gnomon_homogeneous_line(a.x1_, a.y1_, a.w1_, b.x1_, b.y1_, b.w1_);
    return f;
}

/// The vertex relative to an origin on the map, in the units of x / w.
fn gnomon_moving_vertex_translate(given_v: gnomon_moving_vertex, origin_x: f32, origin_y: f32) -> gnomon_moving_vertex
{
    var v = given_v;
    let s = gnomon_moving_vertex_shear(v, origin_x, origin_y);
    v.x0_ = s.x0_;
    v.y0_ = s.y0_;
    v.x1_ = s.x1_;
    v.y1_ = s.y1_;
    return v;
}

/// Upper bound of the distance, in the units of x / w, of the edge from a to b from an edge that is linear in time and
/// equal at both ends. It holds among the samples between the least and the largest x / w and y / w of both vertices.
/// The same from b to a, bit for bit.
/// Domain: all w > 0.
/// NaN: the result for an edge without length is NaN.
/// Error: 16 2^-p of the result, and 32 2^-p times the products X_i Y_j + Y_i X_j of triangle_setup_make's error, over
/// the least slope of the edge function.
fn moving_edge_nonlinearity(a: gnomon_moving_vertex, b: gnomon_moving_vertex) -> f32
{
    let a_x0 = a.x0_ / a.w0_;
    let a_x1 = a.x1_ / a.w1_;
    let a_y0 = a.y0_ / a.w0_;
    let a_y1 = a.y1_ / a.w1_;
    let b_x0 = b.x0_ / b.w0_;
    let b_x1 = b.x1_ / b.w1_;
    let b_y0 = b.y0_ / b.w0_;
    let b_y1 = b.y1_ / b.w1_;
    let low_x = gnomon_min(gnomon_min(a_x0, a_x1), gnomon_min(b_x0, b_x1));
    let low_y = gnomon_min(gnomon_min(a_y0, a_y1), gnomon_min(b_y0, b_y1));
    let high_x = gnomon_max(gnomon_max(a_x0, a_x1), gnomon_max(b_x0, b_x1));
    let high_y = gnomon_max(gnomon_max(a_y0, a_y1), gnomon_max(b_y0, b_y1));
    let x = 0.5 * (low_x + high_x);
    let y = 0.5 * (low_y + high_y);
    let p = gnomon_moving_vertex_translate(a, x, y);
    let q = gnomon_moving_vertex_translate(b, x, y);
    let f = edge_equation_make(p, q);
    let bend = gnomon_homogeneous_line(p.x1_ - p.x0_, p.y1_ - p.y0_, p.w1_ - p.w0_, q.x1_ - q.x0_, q.y1_ - q.y0_,
                                       q.w1_ - q.w0_);
    let most = gnomon_abs(bend.c) + 0.5 *
               (gnomon_abs(bend.x) * (high_x - low_x) + gnomon_abs(bend.y) * (high_y - low_y));
    // Distance is value over slope. Between the ends, the slope is least where its line is nearest to 0.
    let turn_x = f.e2_.x - f.e0_.x;
    let turn_y = f.e2_.y - f.e0_.y;
    let turn = turn_x * turn_x + turn_y * turn_y;
    let nearest = saturate_or_zero(-1.0 * (f.e0_.x * turn_x + f.e0_.y * turn_y) / turn);
    let slope_x = f.e0_.x + nearest * turn_x;
    let slope_y = f.e0_.y + nearest * turn_y;
    return 0.25 * most / gnomon_sqrt(slope_x * slope_x + slope_y * slope_y);
}

/// Edge equations of a triangle. Samples are relative to the origin, which is best near them.
/// Error: 64 2^-p (X_i Y_j + Y_i X_j) for a coefficient at sample s; the covered times are exact for coefficients that
/// differ by as much. X = max(|x| + (|origin_x| + |s_x|) |w|) over the shutter's ends, Y likewise, p the bits of the
/// significand.
fn triangle_setup_make(m: moving_triangle, origin_x: f32, origin_y: f32) -> triangle_setup
{
    let a = gnomon_moving_vertex_translate(m.a, origin_x, origin_y);
    let b = gnomon_moving_vertex_translate(m.b, origin_x, origin_y);
    let c = gnomon_moving_vertex_translate(m.c, origin_x, origin_y);
    var f: triangle_setup;
    f.a = edge_equation_make(b, c);
    f.b = edge_equation_make(c, a);
    f.c = edge_equation_make(a, b);
    return f;
}

/// Value of the affine function p at the sample. Odd in p, bit for bit.
fn gnomon_sample_plane_at(p: gnomon_sample_plane, s_x: f32, s_y: f32) -> f32
{
    return (gnomon_product(p.x, s_x) + gnomon_product(p.y, s_y)) + p.c;
}

/// Edge function at a sample.
fn edge_equation_at(f: gnomon_edge_equation, s_x: f32, s_y: f32) -> gnomon_moving_edge
{
    var e: gnomon_moving_edge;
    e.e0_ = gnomon_sample_plane_at(f.e0_, s_x, s_y);
    e.e1_ = gnomon_sample_plane_at(f.e1_, s_x, s_y);
    e.e2_ = gnomon_sample_plane_at(f.e2_, s_x, s_y);
    return e;
}

/// Edge functions at a sample, for moving_coverage. Two triangles that share an edge cover each sample near it exactly
/// one at a time, as with moving_triangle_edges.
fn triangle_setup_edges(f: triangle_setup, s_x: f32, s_y: f32) -> gnomon_moving_edges
{
    var e: gnomon_moving_edges;
    e.a = edge_equation_at(f.a, s_x, s_y);
    e.b = edge_equation_at(f.b, s_x, s_y);
    e.c = edge_equation_at(f.c, s_x, s_y);
    return e;
}

/// Edge function at a sample, for an edge function that is linear in time: its middle coefficient is the mean of the
/// others.
fn gnomon_linear_edge_at(f: gnomon_edge_equation, s_x: f32, s_y: f32) -> gnomon_moving_edge
{
    var e: gnomon_moving_edge;
    e.e0_ = gnomon_sample_plane_at(f.e0_, s_x, s_y);
    e.e2_ = gnomon_sample_plane_at(f.e2_, s_x, s_y);
    e.e1_ = 0.5 * (e.e0_ + e.e2_);
    return e;
}

/// Edge functions at a sample, for linear_coverage: all three are linear in time.
fn triangle_setup_edges_linear(f: triangle_setup, s_x: f32, s_y: f32) -> gnomon_moving_edges
{
    var e: gnomon_moving_edges;
    e.a = gnomon_linear_edge_at(f.a, s_x, s_y);
    e.b = gnomon_linear_edge_at(f.b, s_x, s_y);
    e.c = gnomon_linear_edge_at(f.c, s_x, s_y);
    return e;
}

/// Upper bound of the affine function p over the samples within h_x and h_y of each sample; the lower bound if facing
/// is -1.
fn gnomon_sample_plane_around(given_p: gnomon_sample_plane, h_x: f32, h_y: f32, facing: f32) -> gnomon_sample_plane
{
    var p = given_p;
    p.c = p.c + facing * (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y);
    return p;
}

/// Bounds of an edge function, as of triangle_setup_around.
fn gnomon_edge_equation_around(given_f: gnomon_edge_equation, h_x: f32, h_y: f32, facing: f32) -> gnomon_edge_equation
{
    var f = given_f;
    f.e0_ = gnomon_sample_plane_around(f.e0_, h_x, h_y, facing);
    f.e1_ = gnomon_sample_plane_around(f.e1_, h_x, h_y, facing);
    f.e2_ = gnomon_sample_plane_around(f.e2_, h_x, h_y, facing);
    return f;
}

/// Bounds of the edge functions over the samples within h_x and h_y of each sample: upper bounds if facing is 1, lower
/// bounds if facing is -1. moving_coverage at (s_x, s_y), with the same facing, contains all times at which a triangle
/// of this facing covers any sample of the block around (s_x, s_y).
/// Error: rounding may reduce h_x and h_y by 8 2^-p of the tile's extents; pass a little more.
fn triangle_setup_around(given_f: triangle_setup, h_x: f32, h_y: f32, facing: f32) -> triangle_setup
{
    var f = given_f;
    f.a = gnomon_edge_equation_around(f.a, h_x, h_y, facing);
    f.b = gnomon_edge_equation_around(f.b, h_x, h_y, facing);
    f.c = gnomon_edge_equation_around(f.c, h_x, h_y, facing);
    return f;
}

/// The sum of a times k_a and b times k_b.
fn gnomon_sample_planes_combine(a: gnomon_sample_plane, k_a: f32, b: gnomon_sample_plane,
                                k_b: f32) -> gnomon_sample_plane
{
    var r: gnomon_sample_plane;
    r.x = a.x * k_a + b.x * k_b;
    r.y = a.y * k_a + b.y * k_b;
    r.c = a.c * k_a + b.c * k_b;
    return r;
}

/// Twice the middle coefficient of an edge times one end of a depth, plus an outer coefficient times the other end.
fn gnomon_depth_setup_middle(outer: gnomon_sample_plane, across: f32, middle: gnomon_sample_plane,
                             beside: f32) -> gnomon_sample_plane
{
    return gnomon_sample_planes_combine(outer, across, middle, 2.0 * beside);
}

/// Depths of the triangle that the setup is of. The vertices' z is linear in view distance; samples are those of the
/// setup.
fn depth_setup_make(f: triangle_setup, m: moving_triangle) -> depth_setup
{
    let a0 = m.a.z0_ - m.c.z0_;
    let a1 = m.a.z1_ - m.c.z1_;
    let b0 = m.b.z0_ - m.c.z0_;
    let b1 = m.b.z1_ - m.c.z1_;
    var d: depth_setup;
    d.n0_ = gnomon_sample_planes_combine(f.a.e0_, a0, f.b.e0_, b0);
    d.n1_ = gnomon_sample_planes_combine(gnomon_depth_setup_middle(f.a.e0_, a1, f.a.e1_, a0), 1.0,
                                         gnomon_depth_setup_middle(f.b.e0_, b1, f.b.e1_, b0), 1.0);
    d.n2_ = gnomon_sample_planes_combine(gnomon_depth_setup_middle(f.a.e2_, a0, f.a.e1_, a1), 1.0,
                                         gnomon_depth_setup_middle(f.b.e2_, b0, f.b.e1_, b1), 1.0);
    d.n3_ = gnomon_sample_planes_combine(f.a.e2_, a1, f.b.e2_, b1);
    d.z0_ = m.c.z0_;
    d.z1_ = m.c.z1_;
    let least = gnomon_min(gnomon_min(gnomon_min(m.a.z0_, m.a.z1_), gnomon_min(m.b.z0_, m.b.z1_)),
                           gnomon_min(d.z0_, d.z1_));
    let most = gnomon_max(gnomon_max(gnomon_max(m.a.z0_, m.a.z1_), gnomon_max(m.b.z0_, m.b.z1_)),
                          gnomon_max(d.z0_, d.z1_));
    d.least = gnomon_max(gnomon_min(least, 1.0), -1.0);
    d.most = gnomon_max(gnomon_min(most, 1.0), -1.0);
    return d;
}

/// Depth as a function of time at a sample; e are the edge functions at the same sample, from triangle_setup_edges.
fn moving_depth_curve(d: depth_setup, e: gnomon_moving_edges, s_x: f32, s_y: f32) -> depth_curve
{
    var r: depth_curve;
    r.n0_ = gnomon_sample_plane_at(d.n0_, s_x, s_y);
    r.n1_ = gnomon_sample_plane_at(d.n1_, s_x, s_y);
    r.n2_ = gnomon_sample_plane_at(d.n2_, s_x, s_y);
    r.n3_ = gnomon_sample_plane_at(d.n3_, s_x, s_y);
    r.d0_ = (e.a.e0_ + e.b.e0_) + e.c.e0_;
    r.d1_ = 2.0 * ((e.a.e1_ + e.b.e1_) + e.c.e1_);
    r.d2_ = (e.a.e2_ + e.b.e2_) + e.c.e2_;
    r.z0_ = d.z0_;
    r.z1_ = d.z1_;
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
fn depth_curve_at(c: depth_curve, t: f32) -> f32
{
    let s = 1.0 - t;
    let numerator = (c.n0_ * s + c.n1_ * t) * (s * s) + (c.n2_ * s + c.n3_ * t) * (t * t);
    let denominator = (c.d0_ * s + c.d1_ * t) * s + c.d2_ * (t * t);
    let z = (c.z0_ * s + c.z1_ * t) + numerator / denominator;
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Depth at time t as of depth_curve_at, for N and D that are linear in time: edges are linear, and depths of vertices
/// change alike.
/// NaN: the farthest depth of the vertices.
/// Error: that of depth_curve_at.
fn linear_depth_at(c: depth_curve, t: f32) -> f32
{
    let s = 1.0 - t;
    let z = (c.z0_ * s + c.z1_ * t) + (c.n0_ * s + c.n3_ * t) / (c.d0_ * s + c.d2_ * t);
    return gnomon_max(gnomon_min(z, c.most), c.least); // a NaN becomes the farthest
}

/// Line through the depths of depth_curve_at at the times begin and end, and an upper bound of the deviation of depth
/// from it. Where D may vanish, the bound is the largest deviation within the limits.
/// Domain: begin <= end, both in [0, 1].
/// Error: 24 2^-p (n + d (r + deviation)) / |D| and 8 2^-p of the largest depth; n and d the largest coefficients of N
/// and D, the middle ones as means, not times 3 and 2; r the larger |N / D| at an end, |D| where it is least.
fn depth_curve_line(c: depth_curve, begin: f32, end: f32) -> depth_line
{
    let b = 1.0 - begin;
    let f = 1.0 - end;
    // Bernstein coefficients between the two times, by blossoming.
    let three0 = 3.0 * c.n0_;
    let three3 = 3.0 * c.n3_;
    let n0 = (c.n0_ * b + c.n1_ * begin) * (b * b) + (c.n2_ * b + c.n3_ * begin) * (begin * begin);
    let n1 = ((three0 * f + c.n1_ * end) * (b * b) + (c.n2_ * f + three3 * end) * (begin * begin)) +
             (c.n1_ * f + c.n2_ * end) * (2.0 * (b * begin));
    let n2 = ((three0 * b + c.n1_ * begin) * (f * f) + (c.n2_ * b + three3 * begin) * (end * end)) +
             (c.n1_ * b + c.n2_ * begin) * (2.0 * (f * end));
    let n3 = (c.n0_ * f + c.n1_ * end) * (f * f) + (c.n2_ * f + c.n3_ * end) * (end * end);
    let d0 = (c.d0_ * b + c.d1_ * begin) * b + c.d2_ * (begin * begin);
    let d1 = (2.0 * (c.d0_ * f) + c.d1_ * end) * b + (c.d1_ * f + 2.0 * (c.d2_ * end)) * begin;
    let d2 = (c.d0_ * f + c.d1_ * end) * f + c.d2_ * (end * end);
    let q0 = n0 / d0;
    let q1 = n3 / d2;
    let p0 = (n1 - q0 * d1) - q1 * d0;
    let p1 = (n2 - q1 * d1) - q0 * d2;
    let bend = gnomon_depth_nonlinearity(gnomon_max(gnomon_abs(p0), gnomon_abs(p1)), d0, d2, d1, d1);
    let free0 = (c.z0_ * b + c.z1_ * begin) + q0;
    let free1 = (c.z0_ * f + c.z1_ * end) + q1;
    let z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    let z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return gnomon_depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// Line through the depths of linear_depth_at at the times begin and end, and the largest deviation of depth from it,
/// for N and D that are linear in time. The bound is attained.
fn linear_depth_line(c: depth_curve, begin: f32, end: f32) -> depth_line
{
    let b = 1.0 - begin;
    let f = 1.0 - end;
    let d0 = c.d0_ * b + c.d2_ * begin;
    let d1 = c.d0_ * f + c.d2_ * end;
    let q0 = (c.n0_ * b + c.n3_ * begin) / d0;
    let q1 = (c.n0_ * f + c.n3_ * end) / d1;
    let bend = gnomon_depth_nonlinearity(gnomon_abs((q1 - q0) * (d1 - d0)), d0, d1, d0 + d1, d0 + d1);
    let free0 = (c.z0_ * b + c.z1_ * begin) + q0;
    let free1 = (c.z0_ * f + c.z1_ * end) + q1;
    let z0 = gnomon_max(gnomon_min(free0, c.most), c.least);
    let z1 = gnomon_max(gnomon_min(free1, c.most), c.least);
    return gnomon_depth_line_within(z0, z1, free0, free1, bend, c.least, c.most);
}

/// The next piece of an interval, as of moving_depth_piece, with lines of depth_curve_line; for linear N and D, too.
fn depth_curve_piece(c: depth_curve, begin: f32, end: f32, passed: f32, tolerance: f32) -> depth_piece
{
    var r = gnomon_depth_trial_begin(begin, end, passed);
    for (var i = 0; i < 6; i++) {
        if (gnomon_any(r.settled < 1.0)) { r = gnomon_depth_trial_next(r, depth_curve_line(c, r.piece.t0_, r.piece.t1_),
                                                                       begin, end, tolerance); }
    }
    return r.piece;
}

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

/// A cubic: h0 s^3 + h1 s^2 t + h2 s t^2 + h3 t^3, s = 1 - t.
struct gnomon_moving_cubic { h0_: f32, h1_: f32, h2_: f32, h3_: f32 }

/// A root between two times, and whether there is one, 1 or 0.
struct gnomon_cubic_root { t: f32, found: f32 }

const gnomon_cubic_third: f32 = 0x1.555556p-2; // 0.333333333333333333333

/// Value of h at time t in [0, 1].
/// Error: 8 2^-p times the largest coefficient.
fn gnomon_moving_cubic_at(h: gnomon_moving_cubic, t: f32) -> f32
{
    let s = 1.0 - t;
    return (h.h0_ * s + h.h1_ * t) * (s * s) + (h.h2_ * s + h.h3_ * t) * (t * t);
}

/// Time at which the sign of h changes between begin and end, where h has the values at_begin and at_end and is
/// monotonic between them. By 24 halvings.
/// Error: 2^-24 of the interval.
fn gnomon_moving_cubic_root(h: gnomon_moving_cubic, begin: f32, end: f32, at_begin: f32,
                            at_end: f32) -> gnomon_cubic_root
{
    let before = at_begin < 0.0;
    let after = at_end < 0.0;
    let some = begin <= end && ((before && !after) || (after && !before));
    var low = begin;
    var high = end;
    for (var i = 0; i < 24; i++) {
        let middle = 0.5 * (low + high);
        let outside = gnomon_moving_cubic_at(h, middle) < 0.0;
        let left = (outside && before) || !(outside || before); // the root is later
        low = gnomon_select(left, middle, low);
        high = gnomon_select(left, high, middle);
    }
    var r: gnomon_cubic_root;
    // Return the end that is inside, so that h is not negative at the time.
    r.t = gnomon_select(before, high, low);
    r.found = gnomon_select(some, 1.0, 0.0);
    return r;
}

/// Times in [0, 1] at which h >= 0.
/// NaN: none.
/// Error: the error of the cubic's value over its slope at that time, and 2^-24. If h only touches 0 within its error,
/// as if it did not.
fn gnomon_moving_cubic_inside(h: gnomon_moving_cubic) -> gnomon_edge_intervals
{
    let none = gnomon_coverage_none;
    // A third of the slope, by Bernstein coefficients. The ends of the times at which h rises are the turning points.
    let b1 = h.h1_ * gnomon_cubic_third;
    let b2 = h.h2_ * gnomon_cubic_third;
    var slope: gnomon_moving_edge;
    slope.e0_ = b1 - h.h0_;
    slope.e1_ = b2 - b1;
    slope.e2_ = h.h3_ - b2;
    let rises = moving_edge_inside(slope, 1.0);
    let gap = rises.gap_begin < none;
    let some = rises.begin < rises.end;
    let first = gnomon_select(gap, rises.gap_begin, gnomon_select(some, rises.begin, 0.0));
    let second = gnomon_select(gap, rises.gap_end, gnomon_select(some, rises.end, 1.0));
    let at_first = gnomon_moving_cubic_at(h, first);
    let at_second = gnomon_moving_cubic_at(h, second);
    let a = gnomon_moving_cubic_root(h, 0.0, first, h.h0_, at_first);
    let b = gnomon_moving_cubic_root(h, first, second, at_first, at_second);
    let c = gnomon_moving_cubic_root(h, second, 1.0, at_second, h.h3_);

    // The roots in order, missing ones last.
    let has_a = 0.0 < a.found;
    let has_b = 0.0 < b.found;
    let has_c = 0.0 < c.found;
    let root0 = gnomon_select(has_a, a.t, gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none)));
    let later = gnomon_select(has_b, b.t, gnomon_select(has_c, c.t, none));
    let root1 = gnomon_select(has_a, later, gnomon_select(has_b && has_c, c.t, none));
    let root2 = gnomon_select(has_a && has_b && has_c, c.t, none);

    let open = 0.0 <= h.h0_;
    var x: gnomon_edge_intervals;
    x.begin = gnomon_select(open, 0.0, gnomon_min(root0, 1.0));
    // A gap lasts from the first root to the second if h is positive at shutter open, else from the second to the
    // third. Without its second root there is no gap, and the times end at its first.
    let leaves = gnomon_select(open, root0, root1);
    let returns = gnomon_select(open, root1, root2);
    let leaves_again = gnomon_select(open, root2, none);
    let back = returns < none;
    x.end = gnomon_min(gnomon_select(back, leaves_again, leaves), 1.0);
    x.gap_begin = gnomon_select(back, leaves, none);
    x.gap_end = gnomon_select(back, returns, none);
    let known = (gnomon_abs(h.h0_) + gnomon_abs(h.h1_)) +
                (gnomon_abs(h.h2_) + gnomon_abs(h.h3_)) < gnomon_moving_edge_limit;
    let ever = known && (open || root0 < none);
    x.begin = gnomon_select(ever, x.begin, 1.0);
    x.end = gnomon_select(ever, x.end, 0.0);
    return x;
}

/// The cubic N + (z_c - plane) D, times side.
fn gnomon_depth_over_plane(c: depth_curve, plane: f32, side: f32) -> gnomon_moving_cubic
{
    let z0 = c.z0_ - plane;
    let z1 = c.z1_ - plane;
    var h: gnomon_moving_cubic;
    h.h0_ = side * (c.n0_ + z0 * c.d0_);
    h.h1_ = side * (c.n1_ + (z0 * c.d1_ + z1 * c.d0_));
    h.h2_ = side * (c.n2_ + (z0 * c.d2_ + z1 * c.d1_));
    h.h3_ = side * (c.n3_ + z1 * c.d2_);
    return h;
}

/// Times at which the depth of a triangle is at least that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of gnomon_moving_cubic_inside.
fn depth_intervals_beyond(c: depth_curve, plane: f32, facing: f32) -> gnomon_edge_intervals
{
    return gnomon_moving_cubic_inside(gnomon_depth_over_plane(c, plane, facing));
}

/// Times at which the depth of a triangle is at most that of the plane, among the times at which a triangle of this
/// facing, 1 or -1, covers the sample.
/// NaN: none.
/// Error: that of gnomon_moving_cubic_inside.
fn depth_intervals_before(c: depth_curve, plane: f32, facing: f32) -> gnomon_edge_intervals
{
    return gnomon_moving_cubic_inside(gnomon_depth_over_plane(c, plane, -1.0 * facing));
}

/// The part of the interval from begin to end that lies in x: before its gap (part 0) or after the gap (part 1). Empty
/// unless begin < end. Without a gap everything is in part 0.
fn edge_intervals_part(x: gnomon_edge_intervals, part: f32, begin: f32, end: f32) -> gnomon_linear_interval
{
    let second = 0.5 < part;
    var r: gnomon_linear_interval;
    r.begin = gnomon_max(begin, gnomon_select(second, x.gap_end, x.begin));
    r.end = gnomon_min(end, gnomon_select(second, x.end, gnomon_min(x.end, x.gap_begin)));
    return r;
}

// motion/triangle/edge_widening.h -------------------------------------------------------------------------------------
// Edges moved outwards by the amount that rounding may take from them. Two triangles that share an edge cover each
// sample beside it at complementary times, bit for bit, so no gap shows between them. At a vertex, however, several
// edges meet, and each is rounded independently: a sample on the vertex or beside it may be outside of all triangles of
// a fan. Widened edges overlap by the same small amount, which lists tolerate.
//
//     margin = edge_equation_error(setup.a, h_x, h_y);
//     wide = edge_equation_widen(setup.a, margin, facing);   once for a tile of samples
//     edge = edge_equation_at(wide, s_x, s_y);               for moving_edge_inside

const gnomon_edge_field_margin: f32 = 0.0000019073486328125; // 2^-19, 32 2^-p in float

/// Largest absolute value of the plane within h_x and h_y of the origin.
fn gnomon_sample_plane_size(p: gnomon_sample_plane, h_x: f32, h_y: f32) -> f32
{
    return (gnomon_abs(p.x) * h_x + gnomon_abs(p.y) * h_y) + gnomon_abs(p.c);
}

/// Largest absolute value of the edge function's coefficients within h_x and h_y of the origin.
fn gnomon_edge_equation_size(f: gnomon_edge_equation, h_x: f32, h_y: f32) -> f32
{
    let outer = gnomon_max(gnomon_sample_plane_size(f.e0_, h_x, h_y), gnomon_sample_plane_size(f.e2_, h_x, h_y));
    return gnomon_max(outer, gnomon_sample_plane_size(f.e1_, h_x, h_y));
}

/// Upper bound of the rounding of an edge function at the samples within h_x and h_y of the origin. It covers planes
/// that were exact before they were rounded to float, their coefficients at the sample, and the times of
/// moving_edge_inside, all in float. These take 1 + 4 + 16 units of 2^-24 of the largest coefficient; the bound is 32.
fn edge_equation_error(f: gnomon_edge_equation, h_x: f32, h_y: f32) -> f32
{
    return gnomon_edge_field_margin * gnomon_edge_equation_size(f, h_x, h_y);
}

/// Upper bound of the rounding of an edge function for linear_edge_inside. Its times take 2 units instead of 16, and
/// the bound is 8. The distance between the edge function and the linear one, a quarter of e0 - 2 e1 + e2, is added.
fn linear_edge_error(f: gnomon_edge_equation, h_x: f32, h_y: f32) -> f32
{
    var bend: gnomon_sample_plane;
    bend.x = f.e0_.x - 2.0 * f.e1_.x + f.e2_.x;
    bend.y = f.e0_.y - 2.0 * f.e1_.y + f.e2_.y;
    bend.c = f.e0_.c - 2.0 * f.e1_.c + f.e2_.c;
    return 0.25 * (edge_equation_error(f, h_x, h_y) + gnomon_sample_plane_size(bend, h_x, h_y));
}

/// The edge moved outwards by a margin. With its error as margin, the edge is inside at all times at which the exact
/// one is. Triangles around a common vertex then leave no crack, although each edge is rounded independently, but
/// overlap by as little.
fn edge_equation_widen(given_f: gnomon_edge_equation, margin: f32, facing: f32) -> gnomon_edge_equation
{
    var f = given_f;
    let by = facing * margin;
    f.e0_.c = f.e0_.c + by;
    f.e1_.c = f.e1_.c + by;
    f.e2_.c = f.e2_.c + by;
    return f;
}

// motion/triangle/triangle_motion.h -----------------------------------------------------------------------------------
// Motion of the point of a moving triangle that a sample sees: the motion vector of a stochastic shadow map.
//
// The point is fixed on the triangle: the mean of the vertices, each weighted by the edge function opposite to it, with
// the weights of the sample's time (moving_triangle.h). Its places at shutter open and at shutter close are the means
// of the vertices there, by the same weights. Edge functions are homogeneous, so this holds in perspective as well, and
// for a light that moves. The motion is the chord from the one place to the other. In perspective the point need not
// move along that chord at constant speed.

/// Motion from shutter open to shutter close, in the units of x / w and in depth.
struct triangle_motion { d_x: f32, d_y: f32, d_z: f32 }

/// A point in clip space, times the sum of the weights of the vertices that it is a mean of.
struct gnomon_weighted_point { x: f32, y: f32, z: f32, w: f32 }

const triangle_motion_limit: f32 = 65536.0; // no map is larger

/// The point with these weights at shutter open.
fn gnomon_moving_triangle_open(m: moving_triangle, v: gnomon_corner_weights) -> gnomon_weighted_point
{
    var p: gnomon_weighted_point;
    p.x = (v.a * m.a.x0_ + v.b * m.b.x0_) + v.c * m.c.x0_;
    p.y = (v.a * m.a.y0_ + v.b * m.b.y0_) + v.c * m.c.y0_;
    p.z = (v.a * m.a.z0_ + v.b * m.b.z0_) + v.c * m.c.z0_;
    p.w = (v.a * m.a.w0_ + v.b * m.b.w0_) + v.c * m.c.w0_;
    return p;
}

/// The point with these weights at shutter close.
fn gnomon_moving_triangle_close(m: moving_triangle, v: gnomon_corner_weights) -> gnomon_weighted_point
{
    var p: gnomon_weighted_point;
    p.x = (v.a * m.a.x1_ + v.b * m.b.x1_) + v.c * m.c.x1_;
    p.y = (v.a * m.a.y1_ + v.b * m.b.y1_) + v.c * m.c.y1_;
    p.z = (v.a * m.a.z1_ + v.b * m.b.z1_) + v.c * m.c.z1_;
    p.w = (v.a * m.a.w1_ + v.b * m.b.w1_) + v.c * m.c.w1_;
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
fn moving_triangle_motion(m: moving_triangle, e: gnomon_moving_edges, t: f32, divided: f32) -> triangle_motion
{
    let v = gnomon_corner_weights_at(e, t);
    let p = gnomon_moving_triangle_open(m, v);
    let q = gnomon_moving_triangle_close(m, v);
    let by_w = 0.0 < divided;
    let sum = (v.a + v.b) + v.c;
    let d_x = q.x / q.w - p.x / p.w;
    let d_y = q.y / q.w - p.y / p.w;
    let d_z = q.z / gnomon_select(by_w, q.w, sum) - p.z / gnomon_select(by_w, p.w, sum);
    let limit = triangle_motion_limit;
    let known = 0.0 < p.w && 0.0 < q.w && gnomon_abs(d_x) <= limit && gnomon_abs(d_y) <= limit &&
                gnomon_abs(d_z) <= limit;
    var r: triangle_motion;
    r.d_x = gnomon_select(known, d_x, 0.0);
    r.d_y = gnomon_select(known, d_y, 0.0);
    r.d_z = gnomon_select(known, d_z, 0.0);
    return r;
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

const gnomon_rectified_guard: f32 = 0x1.19999ap-1; // 0.55, half of a range with a guard band of 10%
const rectified_pi: f32 = 0x1.921fb6p+1; // 3.1415926535897932
const rectified_two_pi: f32 = 0x1.921fb6p+2; // 6.2831853071795865

/// A distance from the eye across the light, and two angles.
struct rectified_position { radius: f32, azimuth: f32, polar: f32 }

/// A map of angles, or of cosines, to depths: the value of depth 0, and depth per unit.
struct rectified_range { middle: f32, scale: f32 }

/// The rectified coordinates of a point: radius at least 0, azimuth in [-pi, pi], polar in [0, pi]. On the axis azimuth
/// is 0; polar of the eye is 0.
/// Domain: |x|, |y| and |z| are 0 or in [2^-60, 2^60] in float, [2^-500, 2^500] in double.
/// NaN: a NaN in each coordinate that depends on it.
/// Error: radius 2 2^-p relative; azimuth 2.6 ulp, polar 3.6 ulp.
/// Source: Peters 2017, Sec. 5.1.1; Baran 2010
fn rectified_from_position(x: f32, y: f32, z: f32) -> rectified_position
{
    var r: rectified_position;
    r.radius = gnomon_sqrt(x * x + y * y);
    r.azimuth = polynomial_atan2_(y, x);
    r.polar = polynomial_atan2_(r.radius, z);
    return r;
}

/// The cosine of polar at a point, in [-1, 1]; 1 at the eye.
/// Domain: as for rectified_from_position.
/// NaN: NaN.
/// Error: 3 2^-p.
fn rectified_cosine(x: f32, y: f32, z: f32) -> f32
{
    let distance_ = gnomon_sqrt((x * x + y * y) + z * z);
    let at_eye = distance_ == 0.0;
    let cosine = z / gnomon_select(at_eye, 1.0, distance_);
    return clamp_or_nan(gnomon_select(at_eye, 1.0, cosine), -1.0, 1.0);
}

/// The range whose depths are in [-1 / 1.1, 1 / 1.1] from least to most, or in a part of that if most - least is below
/// narrowest.
fn gnomon_rectified_range_over(least: f32, most: f32, narrowest: f32) -> rectified_range
{
    var r: rectified_range;
    r.middle = 0.5 * (least + most);
    r.scale = 1.0 / (gnomon_rectified_guard * gnomon_max(most - least, narrowest));
    return r;
}

/// The range of depth for polar angles of view rays in [least, most].
/// Domain: least <= most, in [0, pi]. A range narrower than 2^-10, or reversed, is widened to 2^-10 around its middle.
/// NaN: a middle of NaN.
/// Source: Peters 2017, Sec. 5.1.1
fn rectified_polar_range(least: f32, most: f32) -> rectified_range
{
    return gnomon_rectified_range_over(least, most, 0.0009765625);
}

/// The range of depth for cosines of polar angles of view rays in [least, most], which are those of the greatest and of
/// the least angle.
/// Domain: least <= most, in [-1, 1]. A range narrower than 2^-16, or reversed, is widened to 2^-16 around its middle.
/// NaN: a middle of NaN.
fn rectified_cosine_range(least: f32, most: f32) -> rectified_range
{
    return gnomon_rectified_range_over(least, most, 0.0000152587890625);
}

/// Signed depth of a polar angle, in [-1, 1]: falls with the angle, -1 on the side of rays that look into the light.
/// Domain: polar in [0, pi], a range by rectified_polar_range.
/// NaN: NaN, which encoders store as the far plane.
/// Source: Peters 2017, Sec. 5.1.1
fn rectified_polar_depth(polar: f32, range: rectified_range) -> f32
{
    return clamp_or_nan((range.middle - polar) * range.scale, -1.0, 1.0);
}

/// Signed depth of the cosine of a polar angle, in [-1, 1]: grows with the cosine, -1 on the side of rays that look
/// into the light.
/// Domain: cosine in [-1, 1], a range by rectified_cosine_range.
/// NaN: NaN, which encoders store as the far plane.
fn rectified_cosine_depth(cosine: f32, range: rectified_range) -> f32
{
    return clamp_or_nan((cosine - range.middle) * range.scale, -1.0, 1.0);
}

/// An angle within three half turns of 0, moved by a full turn to at most half a turn from 0.
fn gnomon_rectified_wrapped(angle: f32) -> f32
{
    let turn = rectified_two_pi;
    let half_turn = rectified_pi;
    let up = gnomon_select(angle + half_turn < 0.0, angle + turn, angle);
    return gnomon_select(half_turn < up, up - turn, up);
}

/// The position across the rows of a map, in [0, rows], of an azimuth; the centre of the first row is at 0.5. The map
/// begins at the azimuth start and spans the angle span; an azimuth outside is moved to the nearer end.
/// Domain: azimuth and start in [-pi, pi], span in [2^-20, 2 pi]; elsewhere a number in [0, rows].
/// NaN: NaN for an azimuth of NaN.
fn rectified_row_of(azimuth: f32, start: f32, span: f32, rows: f32) -> f32
{
    let whole = gnomon_max(span, 0.00000095367431640625);
    let from_middle = gnomon_rectified_wrapped((azimuth - start) - 0.5 * whole);
    return clamp_or_nan((from_middle / whole + 0.5) * rows, 0.0, rows);
}

/// The position along a row of prefix averages, at least 0, of a ray that ends at radius; the centre of the first texel
/// is at 0.5. The average up to the far side of texel u, radius (u + 1) radius_step, stands at its centre, u + 1/2: so
/// the position is half a texel before that of the light ray itself.
/// Domain: radius at least 0, radius_step above 0.
/// NaN: NaN.
fn rectified_column_of(radius: f32, radius_step: f32) -> f32 { return gnomon_max(0.0, radius / radius_step - 0.5); }

/// The greater extent of a texel of the rectified map at radius, in texels of the shadow map: along the row
/// radius_step, across it radius times azimuth_step, the angle between rows.
/// Domain: at least 0 each.
/// NaN: NaN.
fn rectified_footprint(radius: f32, radius_step: f32, azimuth_step: f32, texels_per_length: f32) -> f32
{
    return gnomon_max(radius_step, radius * azimuth_step) * texels_per_length;
}

/// The mip level, in [0, 16], whose texels are as wide as a footprint in texels of level 0.
/// Domain: any footprint.
/// NaN: 0.
/// Error: 2 2^-p of the largest level.
fn rectified_level(footprint: f32) -> f32
{
    let wide = clamp_or_nan(footprint, 1.0, 65536.0);
    return clamp_or_high(polynomial_log(gnomon_max(wide, 1.0)) * gnomon_exp_log2_e, 0.0, 16.0);
}

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

/// A corner of the far plane.
struct rectified_corner { x: f32, y: f32, z: f32 }

/// Corners of the far plane, in order around it, either way.
struct rectified_corners { a: rectified_corner, b: rectified_corner, c: rectified_corner, d: rectified_corner }

/// The bounds of a camera's view rays: radius in [0, radius], azimuth from azimuth_start on over azimuth_length, polar
/// from polar_least to polar_most.
struct rectified_frustum { radius: f32, azimuth_start: f32, azimuth_length: f32, polar_least: f32, polar_most: f32 }

/// An interval of polar angles.
struct rectified_interval { least: f32, most: f32 }

/// A part of an edge, from a fraction begin to a fraction end.
struct gnomon_rectified_part { begin: f32, end: f32 }

fn gnomon_rectified_dot(a: rectified_corner, b: rectified_corner) -> f32 { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// b - a.
fn gnomon_rectified_from_to(a: rectified_corner, b: rectified_corner) -> rectified_corner
{
    var r: rectified_corner;
    r.x = b.x - a.x;
    r.y = b.y - a.y;
    r.z = b.z - a.z;
    return r;
}

/// The z of the cross product of a and b: positive where the azimuth of b is up to half a turn beyond that of a.
fn gnomon_rectified_turn(a: rectified_corner, b: rectified_corner) -> f32 { return a.x * b.y - a.y * b.x; }

/// 1 if the light direction is strictly within the far plane as seen from the eye, -1 if its opposite is, else 0.
fn gnomon_rectified_axis_side(q: rectified_corners) -> f32
{
    let ab = gnomon_rectified_turn(q.a, q.b);
    let bc = gnomon_rectified_turn(q.b, q.c);
    let cd = gnomon_rectified_turn(q.c, q.d);
    let da = gnomon_rectified_turn(q.d, q.a);
    let left = 0.0 < ab && 0.0 < bc && 0.0 < cd && 0.0 < da;
    let right = ab < 0.0 && bc < 0.0 && cd < 0.0 && da < 0.0;
    // The normal of the far plane, by its diagonals, and the side of it on which the plane lies.
    let s = gnomon_rectified_from_to(q.a, q.c);
    let t = gnomon_rectified_from_to(q.b, q.d);
    let nx = s.y * t.z - s.z * t.y;
    let ny = s.z * t.x - s.x * t.z;
    let side = (nx * q.a.x + ny * q.a.y) + gnomon_rectified_turn(s, t) * q.a.z;
    let sign = gnomon_select(side < 0.0, -1.0, 1.0);
    return gnomon_select(left, sign, gnomon_select(right, -1.0 * sign, 0.0));
}

/// The angles so far and that of the point (x, y, z).
fn gnomon_rectified_interval_add(given_bounds: rectified_interval, x: f32, y: f32, z: f32) -> rectified_interval
{
    var bounds = given_bounds;
    let polar = polynomial_atan2_(gnomon_sqrt(x * x + y * y), z);
    bounds.least = gnomon_min(polar, bounds.least);
    bounds.most = gnomon_max(polar, bounds.most);
    return bounds;
}

/// The angles so far and that of the point a + t c.
fn gnomon_rectified_interval_along(bounds: rectified_interval, a: rectified_corner, c: rectified_corner,
                                   t: f32) -> rectified_interval
{
    return gnomon_rectified_interval_add(bounds, a.x + t * c.x, a.y + t * c.y, a.z + t * c.z);
}

/// The t of the extreme angle on a + t c, limited to a part; some t of it for an edge towards the eye or without
/// length.
fn gnomon_rectified_extreme(a: rectified_corner, c: rectified_corner, begin: f32, end: f32) -> f32
{
    let ac = gnomon_rectified_dot(a, c);
    let t = (a.z * ac - c.z * gnomon_rectified_dot(a, a)) / (c.z * ac - a.z * gnomon_rectified_dot(c, c));
    return clamp_or_nan(gnomon_select(t == t, t, begin), begin, end);
}

/// The angles so far and those of the edge from a to b, without b.
fn gnomon_rectified_interval_edge(bounds: rectified_interval, a: rectified_corner,
                                  b: rectified_corner) -> rectified_interval
{
    let c = gnomon_rectified_from_to(a, b);
    let r = gnomon_rectified_interval_add(bounds, a.x, a.y, a.z);
    return gnomon_rectified_interval_along(r, a, c, gnomon_rectified_extreme(a, c, 0.0, 1.0));
}

/// The angles so far and those of a part of the edge from a to b; an empty part has none.
fn gnomon_rectified_interval_part(bounds: rectified_interval, a: rectified_corner, b: rectified_corner,
                                  part: gnomon_rectified_part) -> rectified_interval
{
    let c = gnomon_rectified_from_to(a, b);
    var r = gnomon_rectified_interval_along(bounds, a, c, part.begin);
    r = gnomon_rectified_interval_along(r, a, c, part.end);
    r = gnomon_rectified_interval_along(r, a, c, gnomon_rectified_extreme(a, c, part.begin, part.end));
    let empty = part.end < part.begin;
    r.least = gnomon_select(empty, bounds.least, r.least);
    r.most = gnomon_select(empty, bounds.most, r.most);
    return r;
}

/// The bounds before any edge, where axis is that of gnomon_rectified_axis_side.
fn gnomon_rectified_interval_begin(axis: f32) -> rectified_interval
{
    var r: rectified_interval;
    r.least = gnomon_select(0.0 < axis, 0.0, rectified_pi);
    r.most = gnomon_select(axis < 0.0, rectified_pi, 0.0);
    return r;
}

/// The interval, or [0, pi] if no angle was added.
fn gnomon_rectified_interval_end(given_bounds: rectified_interval) -> rectified_interval
{
    var bounds = given_bounds;
    let none = bounds.most < bounds.least;
    bounds.least = gnomon_select(none, 0.0, bounds.least);
    bounds.most = gnomon_select(none, rectified_pi, bounds.most);
    return bounds;
}

/// The farther from the axis of two corners, the first where they are equal or the second has a NaN.
fn gnomon_rectified_farther(a: rectified_corner, b: rectified_corner) -> rectified_corner
{
    let second = a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    var r: rectified_corner;
    r.x = gnomon_select(second, b.x, a.x);
    r.y = gnomon_select(second, b.y, a.y);
    r.z = gnomon_select(second, b.z, a.z);
    return r;
}

/// The azimuth of b relative to that of a, in [-pi, pi]; 0 on the axis.
fn gnomon_rectified_azimuth_between(a: rectified_corner, b: rectified_corner) -> f32
{
    return polynomial_atan2_(gnomon_rectified_turn(a, b), a.x * b.x + a.y * b.y);
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
fn rectified_frustum_from_corners(q: rectified_corners) -> rectified_frustum
{
    let axis = gnomon_rectified_axis_side(q);
    let farthest = gnomon_rectified_farther(gnomon_rectified_farther(q.a, q.b), gnomon_rectified_farther(q.c, q.d));
    let a = gnomon_rectified_azimuth_between(farthest, q.a);
    let b = gnomon_rectified_azimuth_between(farthest, q.b);
    let c = gnomon_rectified_azimuth_between(farthest, q.c);
    let d = gnomon_rectified_azimuth_between(farthest, q.d);
    let least = gnomon_min(a, gnomon_min(b, gnomon_min(c, gnomon_min(d, 0.0))));
    let most = gnomon_max(a, gnomon_max(b, gnomon_max(c, gnomon_max(d, 0.0))));
    let around = axis < 0.0 || 0.0 < axis || rectified_pi < most - least;

    var polar = gnomon_rectified_interval_begin(axis);
    polar = gnomon_rectified_interval_edge(polar, q.a, q.b);
    polar = gnomon_rectified_interval_edge(polar, q.b, q.c);
    polar = gnomon_rectified_interval_edge(polar, q.c, q.d);
    polar = gnomon_rectified_interval_end(gnomon_rectified_interval_edge(polar, q.d, q.a));

    var r: rectified_frustum;
    r.radius = gnomon_sqrt(farthest.x * farthest.x + farthest.y * farthest.y);
    let start = polynomial_atan2_(farthest.y, farthest.x) + least;
    let first = -1.0 * rectified_pi;
    r.azimuth_start = gnomon_select(around, first, clamp_or_nan(gnomon_rectified_wrapped(start), first, rectified_pi));
    r.azimuth_length = gnomon_select(around, rectified_two_pi, most - least);
    r.polar_least = polar.least;
    r.polar_most = polar.most;
    return r;
}

/// The part of the edge from a to b, within a part, that is on the left of the direction (cosine, sine) from the axis.
fn gnomon_rectified_part_left(given_part: gnomon_rectified_part, a: rectified_corner, b: rectified_corner, cosine: f32,
                              sine: f32) -> gnomon_rectified_part
{
    var part = given_part;
    let at_a = cosine * a.y - sine * a.x;
    let at_b = cosine * b.y - sine * b.x;
    let crossing = at_a / (at_a - at_b);
    part.begin = gnomon_select(at_a < 0.0, gnomon_max(part.begin, crossing), part.begin);
    part.end = gnomon_select(at_b < 0.0, gnomon_min(part.end, crossing), part.end);
    // Both ends are on the right: the part is empty.
    part.end = gnomon_select(at_a < 0.0 && at_b < 0.0, -1.0, part.end);
    return part;
}

/// The angles so far and those of the edge from a to b between two directions; of the whole edge if whole is 1.
fn gnomon_rectified_row_edge(bounds: rectified_interval, a: rectified_corner, b: rectified_corner,
                             first: gnomon_cosine_sine, last: gnomon_cosine_sine, whole: f32) -> rectified_interval
{
    var all: gnomon_rectified_part;
    all.begin = 0.0;
    all.end = 1.0;
    var part = gnomon_rectified_part_left(all, a, b, first.cosine, first.sine);
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
fn rectified_row_polar(q: rectified_corners, first: f32, last: f32) -> rectified_interval
{
    let left = polynomial_cosine_sine(first);
    let right = polynomial_cosine_sine(last);
    let whole = gnomon_select(3.0 < last - first, 1.0, 0.0);
    var polar = gnomon_rectified_interval_begin(gnomon_rectified_axis_side(q));
    polar = gnomon_rectified_row_edge(polar, q.a, q.b, left, right, whole);
    polar = gnomon_rectified_row_edge(polar, q.b, q.c, left, right, whole);
    polar = gnomon_rectified_row_edge(polar, q.c, q.d, left, right, whole);
    return gnomon_rectified_interval_end(gnomon_rectified_row_edge(polar, q.d, q.a, left, right, whole));
}

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

const blocker_epsilon: f32 = 0x1.0624dep-10; // 1e-3

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
fn gnomon_blocker_depth_before(z_f: f32, distance_: f32) -> f32
{
    return gnomon_max(z_f - gnomon_max(distance_, 0.0), -1.0);
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
fn blocker2_depth(mean: f32, variance: f32, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let u = z - mean;
    let whole = variance + u * u;
    let below = u * whole;
    let total = blocker_epsilon * whole + u * u;
    return gnomon_blocker_depth_before(z, below / total);
}

// soft/blocker.h ------------------------------------------------------------------------------------------------------

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
fn blocker4_depth(h: hankel4_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let u = z - h.mean;
    let q = gnomon_hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    let s = hamburger4_lower_scale * q;
    let n = hamburger4_lower_scale * h.determinant;
    let un = u * n;
    let a = s * h.variance;
    let b = 0.5 * (un - s * h.third);
    let r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    let e = u * un + q * s;
    let w = h.variance * n;
    let whole = w + e;
    let between = q < 0.0;
    let rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    let share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    let total = blocker_epsilon * (whole * gnomon_select(between, r + r, 1.0)) + share;
    return gnomon_blocker_depth_before(z, rest / total);
}

// soft/blocker6.h -----------------------------------------------------------------------------------------------------
// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
fn blocker6_depth(h: hankel6_, z_f: f32) -> f32
{
    let z = clamp_or_high(z_f, -1.0, 1.0);
    let s = gnomon_hamburger6_sums_at(h, z - h.mean);
    return gnomon_blocker_depth_before(z, s.distance / (blocker_epsilon + gnomon_max(s.lower, 0.0)));
}

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

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is
/// 0.
struct gnomon_decided_shadow { intensity: f32, decided: f32 }

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the
/// receiver towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
fn depth_interval_shadow(least: f32, greatest: f32, z_f: f32, least_bias: f32, most_bias: f32) -> gnomon_decided_shadow
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let known = least <= greatest && least_bias <= most_bias;
    let umbra = known && (greatest < z - gnomon_max(0.0, most_bias));
    let lit = known && (z - gnomon_max(0.0, least_bias) <= least);
    var r: gnomon_decided_shadow;
    r.intensity = gnomon_select(umbra, 1.0, 0.0);
    r.decided = gnomon_select(umbra || lit, 1.0, 0.0);
    return r;
}

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

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
struct summed_area_rectangle { x0_: f32, y0_: f32, x1_: f32, y1_: f32 }

const summed_area_range: f32 = 4294967296.0; // 2^32
const summed_area_most_texels: f32 = 1048576.0; // 2^20
const summed_area_step: f32 = 5.9604644775390625e-8; // 2^-24
const summed_area_slack: f32 = 0.0009765625; // 2^-10

const summed_area_code_noise: f32 = 0x1.p-33; // 1.1641532182693481e-10, 2^-33
const summed_area_float_noise: f32 = 5.9604644775390625e-8; // 2 times 2^-25
const summed_area_least_noise: f32 = 0x1.2p-23; // 1.3411045074462891e-7, 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
fn summed_area_noise(most_texels: f32) -> f32
{
    let noise = summed_area_code_noise * most_texels + summed_area_float_noise;
    return gnomon_max(noise, summed_area_least_noise);
}

/// The number that channels are multiplied by: the largest whole number S of the precision of float for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_scale(most_texels: f32) -> f32
{
    let n = clamp_or_high(most_texels, 1.0, summed_area_most_texels);
    let range = summed_area_range;
    let s = range / n;
    var whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, 1.0, 0.0);
    let sum = two_product(whole, n);
    let wraps = 0.0 <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(1.0, summed_area_step * whole), 0.0);
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
fn summed_area_code(channel: f32, scale: f32) -> f32
{
    let p = two_product(saturate_or_zero(channel), scale);
    var code = nearest_natural(p.high);
    let rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(0.5 < rest, 1.0, 0.0);
    return code - gnomon_select(rest < -0.5, 1.0, 0.0);
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
fn summed_area_around(x: f32, y: f32, width_x: f32, width_y: f32) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = x - 0.5 * width_x;
    r.y0_ = y - 0.5 * width_y;
    r.x1_ = x + 0.5 * width_x;
    r.y1_ = y + 0.5 * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
fn gnomon_summed_area_above(x: f32) -> f32 { return -1.0 * texel_below(-1.0 * x); }

/// The begin and the end of a rectangle along one axis.
struct summed_area_interval { begin: f32, end: f32 }

/// The interval from begin to end.
fn gnomon_summed_area_interval_from(begin: f32, end: f32) -> summed_area_interval
{
    var r: summed_area_interval;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
fn gnomon_summed_area_shrink(begin: f32, end: f32, texels: f32, most: f32) -> summed_area_interval
{
    let width = most - 1.0;
    let low = 0.5 * (begin + end) - 0.5 * width;
    let large = most < texels;
    var r: summed_area_interval;
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
fn summed_area_clip(rectangle: summed_area_rectangle, width: f32, height: f32,
                    most_texels: f32) -> summed_area_rectangle
{
    let limit = gnomon_texel_limit;
    let right = clamp_or_high(width, 1.0, limit);
    let bottom = clamp_or_high(height, 1.0, limit);
    let x0 = clamp_or_nan(rectangle.x0_, 0.0, right);
    let y0 = clamp_or_nan(rectangle.y0_, 0.0, bottom);
    let x1 = clamp_or_nan(rectangle.x1_, 0.0, right);
    let y1 = clamp_or_nan(rectangle.y1_, 0.0, bottom);
    let columns = gnomon_summed_area_above(x1) - texel_below(x0);
    let rows = gnomon_summed_area_above(y1) - texel_below(y0);
    let most = clamp_or_high(most_texels, 4.0, summed_area_most_texels);
    let large = most < columns * rows;
    var x = gnomon_summed_area_interval_from(x0, x1);
    var y = gnomon_summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        let share = gnomon_sqrt(gnomon_min(most / (columns * rows), 1.0));
        let least_columns = gnomon_min(columns, 2.0);
        let least_rows = gnomon_min(rows, 2.0);
        let most_columns = gnomon_min(gnomon_max(texel_below(share * columns + summed_area_slack), least_columns),
                                      texel_below(most / least_rows));
        let most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = gnomon_summed_area_shrink(x0, x1, columns, most_columns);
        y = gnomon_summed_area_shrink(y0, y1, rows, most_rows);
    }
    let some = x0 < x1 && y0 < y1; // false for NaN
    var r: summed_area_rectangle;
    r.x0_ = gnomon_select(some, x.begin, 0.0);
    r.y0_ = gnomon_select(some, y.begin, 0.0);
    r.x1_ = gnomon_select(some, x.end, 0.0);
    r.y1_ = gnomon_select(some, y.end, 0.0);
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
fn summed_area_grow(rectangle: summed_area_rectangle) -> summed_area_rectangle
{
    var r: summed_area_rectangle;
    r.x0_ = texel_below(rectangle.x0_);
    r.y0_ = texel_below(rectangle.y0_);
    r.x1_ = gnomon_summed_area_above(rectangle.x1_);
    r.y1_ = gnomon_summed_area_above(rectangle.y1_);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
struct summed_area_parts { line0_: f32, line1_: f32, line2_: f32, line3_: f32, width0_: f32, width1_: f32,
    width2_: f32 }

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
fn summed_area_split(begin: f32, end: f32) -> summed_area_parts
{
    let first = texel_below(begin);
    let last = gnomon_max(gnomon_summed_area_above(end) - 1.0, first);
    let single = last <= first;
    var r: summed_area_parts;
    r.line0_ = first;
    r.line1_ = first + 1.0;
    r.line2_ = gnomon_max(last, r.line1_);
    r.line3_ = last + 1.0;
    r.width0_ = saturate_or_zero(gnomon_select(single, end, r.line1_) - begin);
    r.width1_ = gnomon_select(single, 0.0, 1.0);
    r.width2_ = gnomon_select(single, 0.0, saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
fn summed_area_width(parts: summed_area_parts) -> f32
{
    return (parts.width0_ + parts.width1_ * (parts.line2_ - parts.line1_)) + parts.width2_;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
fn summed_area_mean(sum: f32, area: f32, scale: f32) -> f32
{
    let whole = two_product(area, scale);
    let mean = saturate_or_zero(sum / whole.high);
    let p = two_product(mean, whole.high);
    let rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

// soft/disc.h ---------------------------------------------------------------------------------------------------------
// Round lights and round filters from look-ups of rectangles: a disc, or an ellipse along the axes of the map, as the
// union of three rectangles that touch, in the shape of a cross. Their means, weighted by their areas, make the mean of
// the union; so moments are averaged first, and one intensity is computed.
//
// A straight edge at any angle then has a penumbra that differs from that of the disc by disc_error at most, where a
// single square of the disc's area differs by disc_square_error. Two rectangles crosswise, with twice the loads of
// the square, still differ by 0.0177, so there is no form for them.

const disc_long: f32 = 0x1.e8f5c2p-1; // 0.955, extents of the cross, as shares of the diameter
const disc_short: f32 = 0x1.31eb86p-1; // 0.5975        //
const disc_square: f32 = 0x1.c5bf8ap-1; // 0.8862269255, the square of the same area, sqrt(pi) / 2
const disc_error: f32 = 0x1.eb851ep-8; // 0.0075
const disc_square_error: f32 = 0x1.810624p-6; // 0.0235

/// Rectangle 0, 1 or 2 of the disc that the given rectangle bounds: the middle of the cross, and its ends towards y0
/// and towards y1.
/// Domain: any rectangle; of its parts, those at the index as rounded to the nearest of 0, 1 and 2.
/// NaN: NaN, which summed_area_clip makes empty; index 0 for an index of NaN.
/// Error: against a disc (tests/soft/disc.cpp), of the visibility in the penumbra of a straight edge, disc_error.
fn disc_rectangle(bounds: summed_area_rectangle, index: f32) -> summed_area_rectangle
{
    let x = 0.5 * (bounds.x0_ + bounds.x1_);
    let y = 0.5 * (bounds.y0_ + bounds.y1_);
    let half_x = 0.5 * (bounds.x1_ - bounds.x0_);
    let half_y = 0.5 * (bounds.y1_ - bounds.y0_);
    let first = 0.5 < index && index < 1.5;
    let second = 1.5 <= index;
    let across = half_x * gnomon_select(first || second, disc_short, disc_long);
    let inner = half_y * disc_short;
    let outer = half_y * disc_long;
    var r: summed_area_rectangle;
    r.x0_ = x - across;
    r.x1_ = x + across;
    r.y0_ = gnomon_select(first, y - outer, gnomon_select(second, y + inner, y - inner));
    r.y1_ = gnomon_select(first, y - inner, gnomon_select(second, y + outer, y + inner));
    return r;
}

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

/// The depths of two occluders, first <= second, and the depth between that parts them. A between of -1 says that there
/// is one occluder, the second, or none.
struct gnomon_occluder_pair { first: f32, second: f32, between: f32 }

/// The depth of an occluder at depth z with a weight, in [-1, z_f].
fn gnomon_fusion_depth(z: f32, weight: f32, z_f: f32) -> f32
{
    return gnomon_blocker_depth_before(z_f, (z_f - z) * (weight / (weight + blocker_epsilon)));
}

/// The two occluders before z_f in a search region, from the canonical distribution d with depth0 = z_f. Like the mean
/// blocker depth of blocker.h, each is near z_f where its weight is not far above blocker_epsilon. One occluder is the
/// second, and first equals second.
/// NaN: no occluder, both at the depth of the receiver.
fn fusion_occluders(d: gnomon_distribution3_) -> gnomon_occluder_pair
{
    let z_f = clamp_or_high(d.depth0_, -1.0, 1.0);
    let z1 = clamp_or_high(d.depth1_, -1.0, z_f);
    let z2 = clamp_or_high(d.depth2_, -1.0, z_f);
    let two = d.depth1_ < d.depth2_ && d.depth2_ < z_f;
    let first = gnomon_fusion_depth(z1, saturate_or_zero(d.weight1_), z_f);
    let second = gnomon_fusion_depth(z2, saturate_or_zero(d.weight2_), z_f);
    var r: gnomon_occluder_pair;
    r.second = gnomon_select(two, second, first);
    r.first = gnomon_min(first, r.second);
    r.between = gnomon_select(two, 0.5 * (z1 + z2), -1.0);
    return r;
}

/// Shadow intensity in [0, 1] of two occluders: blocked is I1, covered is c and either is I2 of the first comment of
/// this file. With covered 0 and blocked 0 it is either.
/// Domain: each in [0, 1], clamped.
/// NaN: counts as 0, lit.
fn fusion_intensity(blocked: f32, covered: f32, either: f32) -> f32
{
    let one = saturate_or_zero(blocked);
    let c = saturate_or_zero(covered);
    let left = (1.0 - c) + blocker_epsilon * c;
    let two = saturate_or_zero((saturate_or_zero(either) - c) / left);
    return saturate_or_zero(one + (1.0 - one) * two);
}

// soft/mip_filter.h ---------------------------------------------------------------------------------------------------
// Filters of any width from a mip chain, round ones in place of the boxes of summed-area tables: a cubic B-spline over
// the texels of a level, by four bilinear look-ups (Sigg & Hadwiger 2005), mixed between two levels.
//
// The texels of level l are means over boxes of s = 2^l texels of the map, so that the spline at that level has the
// variance (1/3 + 1/12) s^2 along each axis. A box of a width w has w^2 / 12. Levels below and above mix so that both
// variances are equal:
//     w^2 / 12 = 5/12 4^l (1 + 3 f),    level = l + f,    f in [0, 1)
// Weights are not negative and sum to 1, so filtered moments are moments.

const mip_filter_fifth: f32 = 0x1.99999ap-3; // 0.2
const mip_filter_per_octave: f32 = 0x1.715476p-1; // 0.72134752044448170, 1 / ln 4
const mip_filter_third: f32 = 0x1.555556p-2; // 0.33333333333333333
const mip_filter_sixth: f32 = 0x1.555556p-3; // 0.16666666666666667

/// The level of a mip chain whose cubic B-spline has the variance of a box of this width in texels of the map; its
/// fraction is the share of the level above. At least 0, the level for widths up to sqrt 5.
/// Domain: any width, limited to [sqrt 5, 65536].
/// NaN: 0.
fn mip_filter_level(width: f32) -> f32
{
    let w = gnomon_max(gnomon_min(gnomon_texel_limit, width), 1.0);
    let squares = gnomon_max(mip_filter_fifth * (w * w), 1.0);
    let whole = texel_below(polynomial_log(squares) * mip_filter_per_octave);
    let power = gnomon_power_of_two(whole);
    let share = (squares / (power * power) - 1.0) * mip_filter_third;
    return whole + saturate_or_zero(share);
}

/// Two bilinear look-ups along one axis that make a cubic B-spline: at the distances first and second from the centre
/// of the texel, the second with a weight and the first with the rest. first is in [-1, 0], second in [1, 2].
struct mip_filter_taps { first: f32, second: f32, weight: f32 }

/// The look-ups for a place at a share of the way from the centre of its texel to the next.
/// Domain: share in [0, 1], clamped.
/// NaN: as 0.
/// Source: Sigg & Hadwiger 2005
fn mip_filter_taps_at(share: f32) -> mip_filter_taps
{
    let u = saturate_or_zero(share);
    let v = 1.0 - u;
    // Six times the weights of the four texels.
    let w0 = v * v * v;
    let w1 = (3.0 * u - 6.0) * (u * u) + 4.0;
    let w2 = (3.0 * v - 6.0) * (v * v) + 4.0;
    let w3 = u * u * u;
    var r: mip_filter_taps;
    r.first = w1 / (w0 + w1) - 1.0;
    r.second = w3 / (w2 + w3) + 1.0;
    r.weight = (w2 + w3) * mip_filter_sixth;
    return r;
}

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

/// A width of any size clamped to [1, widest], or 1 if widest is below 1.
/// NaN: 1; a widest of NaN counts as none.
fn gnomon_penumbra_width(width: f32, widest: f32) -> f32
{
    return gnomon_max(gnomon_min(widest, gnomon_max(width, 1.0)), 1.0);
}

/// The width of the penumbra of a directional light per unit of signed depth between blocker and receiver, in texels.
/// tangent is that of half the light's angular size along this axis; depth_range is far - near, and texels_per_length
/// the number of texels per unit of length in the map.
/// Domain: at least 0.
/// NaN: NaN, for which filters are one texel wide.
/// Error: relative, 2 2^-p.
fn penumbra_texels_per_depth(tangent: f32, depth_range: f32, texels_per_length: f32) -> f32
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
fn penumbra_directional(z_f: f32, z_b: f32, texels_per_depth: f32, widest: f32) -> f32
{
    let receiver = clamp_or_nan(z_f, -1.0, 1.0);
    let blocker = clamp_or_nan(z_b, -1.0, 1.0);
    return gnomon_penumbra_width((receiver - blocker) * texels_per_depth, widest);
}

/// Width of the penumbra of a local light, at least one texel and at most widest: light_texels (1 / d_b - 1 / d_f) for
/// a receiver and blockers at view distances d_f and d_b. light_texels is the size of the light times the number of
/// texels per unit of length at distance 1 from the light, in the map of that axis.
/// Domain: any depths, clamped to [-1, 1]; 0 < near_distance < far_distance. Blockers behind the receiver give 1.
/// NaN: 1; a widest of NaN counts as none.
/// Error: relative, 10 2^-p.
/// Source: Fernando 2005; Peters 2017, Sec. 4.1
fn penumbra_local(z_f: f32, z_b: f32, near_distance: f32, far_distance: f32, light_texels: f32, widest: f32) -> f32
{
    let receiver = clamp_or_nan(z_f, -1.0, 1.0);
    let blocker = clamp_or_nan(z_b, -1.0, 1.0);
    let half_range = 0.5 * (far_distance - near_distance);
    let d_f = near_distance + half_range * (receiver + 1.0);
    let d_b = near_distance + half_range * (blocker + 1.0);
    return gnomon_penumbra_width(light_texels * ((receiver - blocker) * half_range) / (d_b * d_f), widest);
}

// storage/moments4.h --------------------------------------------------------------------------------------------------
// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4_      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16_
//   4 x half          8     theta4_ - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
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

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
fn moments4_unorm16_encode(z: f32) -> channels4_ { return theta4_(moments4_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The channels c, each with shift added.
fn gnomon_channels4_shifted(given_c: channels4_, shift: f32) -> channels4_
{
    var c = given_c;
    c.c1_ = c.c1_ + shift;
    c.c2_ = c.c2_ + shift;
    c.c3_ = c.c3_ + shift;
    c.c4_ = c.c4_ + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
fn gnomon_half_nearest(x: f32) -> f32 { return 0.000244140625 * nearest_integer(4096.0 * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices
/// may truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
fn moments4_half_encode(z: f32) -> channels4_
{
    var c = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    c.c1_ = gnomon_half_nearest(c.c1_);
    c.c2_ = gnomon_half_nearest(c.c2_);
    c.c3_ = gnomon_half_nearest(c.c3_);
    c.c4_ = gnomon_half_nearest(c.c4_);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn moments4_float_encode(z: f32) -> channels4_
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

const gnomon_stored4_unorm16_weight: f32 = 0x1.2dfd6ap-15; // 3.6e-5
const gnomon_stored4_unorm16_filtered_weight: f32 = 0x1.cd5f9ap-14; // 1.1e-4
const gnomon_stored4_half_weight: f32 = 0x1.2ad81ap-11; // 5.7e-4
const gnomon_stored4_half_filtered_weight: f32 = 0x1.758e22p-9; // 2.85e-3
const gnomon_stored4_float_weight: f32 = 0x1.421f6p-22; // 3e-7
const gnomon_stored4_float_filtered_weight: f32 = 0x1.0c6f7ap-19; // 2e-6
const gnomon_stored4_arithmetic_weight: f32 = 0x1.0c6f7ap-20; // 1e-6

/// The factored matrix of the channels of theta4_, with a constant bias of weight alpha.
fn gnomon_hankel4_from_theta(c: channels4_, alpha: f32) -> hankel4_
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, bias4_theta_b2_, alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
fn gnomon_hankel4_stored_as_float(c: channels4_, alpha: f32) -> hankel4_
{
    return hankel4_constant_bias(moments4_from_channels(c), bias4_raw_b2_, bias4_raw_b4_, alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
fn hankel4_from_unorm16_(c: channels4_) -> hankel4_ { return gnomon_hankel4_from_theta(c,
                                                                                       gnomon_stored4_unorm16_weight); }

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
fn hankel4_from_unorm16_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(c, gnomon_stored4_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
fn hankel4_from_half(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_weight);
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
fn hankel4_from_half_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5), gnomon_stored4_half_filtered_weight);
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
fn hankel4_from_float(c: channels4_) -> hankel4_ { return gnomon_hankel4_stored_as_float(c,
                                                                                         gnomon_stored4_float_weight); }

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
fn hankel4_from_float_filtered(c: channels4_) -> hankel4_
{
    return gnomon_hankel4_stored_as_float(c, gnomon_stored4_float_filtered_weight);
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
const certified4_unorm16_noise: f32 = 0x1.0c6f7ap-17; // 8e-6, half a code, and the error of theta4_ in float
const certified4_unorm16_filtered_noise: f32 = 0x1.92a738p-16; // 2.4e-5
const certified4_unorm16_weight: f32 = 0x1.2dfd6ap-15; // 3.6e-5
const certified4_unorm16_filtered_weight: f32 = 0x1.797cc4p-14; // 9e-5
const certified4_half_noise: f32 = 0x1.00e6bp-13; // 1.225e-4, 2^-13, and the error of theta4_ in float
const certified4_half_filtered_noise: f32 = 0x1.40dd4p-11; // 6.12e-4, passes may truncate: 2^-12 each
const certified4_half_weight: f32 = 0x1.3a92a4p-11; // 6e-4
const certified4_half_filtered_weight: f32 = 0x1.2d7732p-9; // 2.3e-3
const certified4_float_noise: f32 = 0x1.1b77c4p-25; // 3.3e-8, 1.1 times 2^-25
const certified4_float_filtered_noise: f32 = 2.384185791015625e-7; // 8 times: sums of nine taps round, too
const certified4_float_weight: f32 = 0x1.421f6p-22; // 3e-7
const certified4_float_filtered_weight: f32 = 0x1.92a738p-20; // 1.5e-6

/// Shadow intensity at z_f from channels c of theta4_, each off by at most noise, by nodes with a bias of weight alpha.
fn gnomon_moments4_theta_intensity(c: channels4_, noise: f32, alpha: f32, z_f: f32) -> f32
{
    return certified4_theta_lower(gnomon_hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_unorm16_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_noise, certified4_unorm16_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_unorm16_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                           z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_half_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_noise,
                                           certified4_half_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_half_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), certified4_half_filtered_noise,
                                           certified4_half_filtered_weight, z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes
/// with a bias of weight alpha.
fn gnomon_moments4_float_intensity_with_noise(c: channels4_, noise: moments4_, alpha: f32, z_f: f32) -> f32
{
    return certified4_constant_bias_lower(gnomon_hankel4_stored_as_float(c, alpha), noise, bias4_raw_b2_, bias4_raw_b4_,
                                          alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_float_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), certified4_float_noise),
        certified4_float_weight, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_float_filtered_intensity(c: channels4_, z_f: f32) -> f32
{
    return gnomon_moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), certified4_float_filtered_noise),
        certified4_float_filtered_weight, z_f);
}

// storage/absorbance4.h -----------------------------------------------------------------------------------------------
// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in
// any order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4_ - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add
// up to additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A
// fragment's own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by
// 2^-24 of its value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
fn absorbance4_float_encode(z: f32, alpha: f32) -> channels5_
{
    let b = absorbance4_of_fragment(z, alpha);
    var c: channels5_;
    c.c1_ = b.b1_;
    c.c2_ = b.b2_;
    c.c3_ = b.b3_;
    c.c4_ = b.b4_;
    c.c5_ = b.b0_;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
fn absorbance4_half_encode(z: f32, alpha: f32) -> channels5_
{
    let a = absorbance_of_opacity(alpha);
    let s = gnomon_channels4_shifted(moments4_unorm16_encode(z), -0.5);
    var c: channels5_;
    c.c1_ = a * s.c1_;
    c.c2_ = a * s.c2_;
    c.c3_ = a * s.c3_;
    c.c4_ = a * s.c4_;
    c.c5_ = a;
    return c;
}

const absorbance4_half_additions: f32 = 8.0;
const absorbance4_half_least: f32 = 1.220703125e-4; // 2^-13: below, half floats are denormal
const absorbance4_float_additions: f32 = 4.0;
const absorbance4_float_more: f32 = 3.0; // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_float_transmittance(c: channels5_, additions: f32, overestimation: f32, z_f: f32) -> f32
{
    var b: absorbance4_;
    b.b0_ = c.c5_;
    b.b1_ = c.c1_;
    b.b2_ = c.c2_;
    b.b3_ = c.c3_;
    b.b4_ = c.c4_;
    let n = gnomon_blended_roundings(additions + absorbance4_float_more, absorbance4_float_additions);
    return absorbance4_transmittance(b, bias_weight_of_roundings(gnomon_stored4_float_weight, n), overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
fn absorbance4_half_transmittance(c: channels5_, additions: f32, overestimation: f32, z_f: f32) -> f32
{
    let scale = 1.0 / gnomon_max(absorbance4_half_least, c.c5_);
    var s: channels4_;
    s.c1_ = c.c1_ * scale;
    s.c2_ = c.c2_ * scale;
    s.c3_ = c.c3_ * scale;
    s.c4_ = c.c4_ * scale;
    let weight = bias_weight_of_roundings(gnomon_stored4_half_weight,
                                          gnomon_blended_roundings(additions, absorbance4_half_additions));
    let h = gnomon_hankel4_from_theta(gnomon_channels4_shifted(s, 0.5), weight);
    return absorbance_transmittance(c.c5_, gnomon_absorbance4_intensity(h, weight, overestimation, z_f));
}

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

/// Eight textures of four channels.
struct channels32_ { t1_: channels4_, t2_: channels4_, t3_: channels4_, t4_: channels4_, t5_: channels4_,
    t6_: channels4_, t7_: channels4_, t8_: channels4_ }

const convolution_unorm8_offset: f32 = 0x1.4ee49ap-5; // 0.04088048903297681, 1.92644766 / (pi terms span)
const convolution_unorm8_darkening: f32 = 0x1.c28f5cp-5; // 0.055
const gnomon_convolution_unorm8_weight1_: f32 = 0x1.45f306p-1; // 0.6366197723675814
const gnomon_convolution_unorm8_weight2_: f32 = 0x1.b2995ep-3; // 0.2122065907891938
const gnomon_convolution_unorm8_weight3_: f32 = 0x1.04c26cp-3; // 0.12732395447351627
const gnomon_convolution_unorm8_weight4_: f32 = 0x1.748376p-4; // 0.09094568176679733
const gnomon_convolution_unorm8_weight5_: f32 = 0x1.21bb94p-4; // 0.0707355302630646
const gnomon_convolution_unorm8_weight6_: f32 = 0x1.da1bacp-5; // 0.05787452476068922
const gnomon_convolution_unorm8_weight7_: f32 = 0x1.912b1cp-5; // 0.04897075172058318
const gnomon_convolution_unorm8_weight8_: f32 = 0x1.5bade6p-5; // 0.04244131815783876
const gnomon_convolution_unorm8_weight9_: f32 = 0x1.32c69ep-5; // 0.03744822190397538
const gnomon_convolution_unorm8_weight10_: f32 = 0x1.127bdp-5; // 0.033506303808820075
const gnomon_convolution_unorm8_weight11_: f32 = 0x1.f0af48p-6; // 0.030315227255599115
const gnomon_convolution_unorm8_weight12_: f32 = 0x1.c57ea6p-6; // 0.02767912053772093
const gnomon_convolution_unorm8_weight13_: f32 = 0x1.a13714p-6; // 0.025464790894703257
const gnomon_convolution_unorm8_weight14_: f32 = 0x1.824f7p-6; // 0.0235785100876882
const gnomon_convolution_unorm8_weight15_: f32 = 0x1.67ab1p-6; // 0.021952405943709702
const gnomon_convolution_unorm8_weight16_: f32 = 0x1.5076bcp-6; // 0.020536121689276817

/// The channels of the term at phase and of the next term.
fn gnomon_convolution_unorm8_encode_two(phase: convolution_phase) -> channels4_
{
    let next = convolution_next(phase);
    var c: channels4_;
    c.c1_ = 0.5 * phase.cosine + 0.5;
    c.c2_ = 0.5 * phase.sine + 0.5;
    c.c3_ = 0.5 * next.cosine + 0.5;
    c.c4_ = 0.5 * next.sine + 0.5;
    return c;
}

/// The phase two terms on.
fn gnomon_convolution_unorm8_next_two(phase: convolution_phase) -> convolution_phase
{
    return convolution_next(convolution_next(phase));
}

/// The 32 channels of a 32 x 8 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as convolution_next.
/// Source: Annen 2007, Sec. 3
fn convolution_unorm8_encode(z: f32) -> channels32_
{
    var settings: convolution_settings;
    settings.terms = 16.0;
    settings.damping = 0.0;
    settings.offset = convolution_unorm8_offset;
    settings.span = 0.9375;
    var phase = convolution_encode(z, settings);
    var c: channels32_;
    c.t1_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t2_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t3_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t4_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t5_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t6_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t7_ = gnomon_convolution_unorm8_encode_two(phase);
    phase = gnomon_convolution_unorm8_next_two(phase);
    c.t8_ = gnomon_convolution_unorm8_encode_two(phase);
    return c;
}

/// The sum after two terms with their channels and weights.
fn gnomon_convolution_unorm8_add_two(given_state: convolution_sum, c: channels4_, weight: f32,
                                     next_weight: f32) -> convolution_sum
{
    var state = given_state;
    state = convolution_add(state, 2.0 * c.c1_ - 1.0, 2.0 * c.c2_ - 1.0, weight);
    return convolution_add(state, 2.0 * c.c3_ - 1.0, 2.0 * c.c4_ - 1.0, next_weight);
}

/// The series at depth z_f, with an offset, from the channels of a 32 x 8 UNORM texel.
fn gnomon_convolution_unorm8_series(c: channels32_, z_f: f32, offset: f32) -> f32
{
    var settings: convolution_settings;
    settings.terms = 16.0;
    settings.damping = 0.0;
    settings.offset = offset;
    settings.span = 0.9375;
    var state = convolution_begin(z_f, settings);
    state = gnomon_convolution_unorm8_add_two(state, c.t1_, gnomon_convolution_unorm8_weight1_,
                                              gnomon_convolution_unorm8_weight2_);
    state = gnomon_convolution_unorm8_add_two(state, c.t2_, gnomon_convolution_unorm8_weight3_,
                                              gnomon_convolution_unorm8_weight4_);
    state = gnomon_convolution_unorm8_add_two(state, c.t3_, gnomon_convolution_unorm8_weight5_,
                                              gnomon_convolution_unorm8_weight6_);
    state = gnomon_convolution_unorm8_add_two(state, c.t4_, gnomon_convolution_unorm8_weight7_,
                                              gnomon_convolution_unorm8_weight8_);
    state = gnomon_convolution_unorm8_add_two(state, c.t5_, gnomon_convolution_unorm8_weight9_,
                                              gnomon_convolution_unorm8_weight10_);
    state = gnomon_convolution_unorm8_add_two(state, c.t6_, gnomon_convolution_unorm8_weight11_,
                                              gnomon_convolution_unorm8_weight12_);
    state = gnomon_convolution_unorm8_add_two(state, c.t7_, gnomon_convolution_unorm8_weight13_,
                                              gnomon_convolution_unorm8_weight14_);
    state = gnomon_convolution_unorm8_add_two(state, c.t8_, gnomon_convolution_unorm8_weight15_,
                                              gnomon_convolution_unorm8_weight16_);
    return convolution_end(state);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 32 x 8 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
fn convolution_unorm8_intensity(c: channels32_, z_f: f32) -> f32
{
    return gnomon_convolution_unorm8_series(c, z_f, convolution_unorm8_offset);
}

/// Shadow intensity in [0, 1] as convolution_unorm8_intensity, but with the edge of the wave at z_f itself, where the
/// intensity is 1/2: for receivers in air, as of single scattering, which are in no map.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
/// Error: as convolution_end.
/// Source: Peters 2017, Sec. 5.5.1
fn convolution_unorm8_centred_intensity(c: channels32_, z_f: f32) -> f32
{
    return gnomon_convolution_unorm8_series(c, z_f, 0.0);
}

// storage/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps in a storage format: from a depth to the channel of a texel, and from a filtered channel to a
// shadow, with the exponent of the format.
//
//   format      bytes   channel       write                      read
//   1 x float     4     exp(40 z)     exponential_float_encode   exponential_float_intensity
//
// A lit surface is darkened by rounding alone: 84 roundings of exp(40 z), two of the filter passes and their sums.

const exponential_float_exponent: f32 = 40.0; // exp(2 c) < 2^127
const exponential_float_darkening: f32 = 0x1.92a738p-18; // 6e-6

/// The channel of a 1 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_encode.
fn exponential_float_encode(z: f32) -> channels1_
{
    var settings: exponential_settings;
    settings.exponent = exponential_float_exponent;
    let b = exponential_encode(z, settings);
    var c: channels1_;
    c.c1_ = b.warped;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channel of a 1 x float texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as exponential_intensity.
fn exponential_float_intensity(c: channels1_, z_f: f32) -> f32
{
    var settings: exponential_settings;
    settings.exponent = exponential_float_exponent;
    var b: exponential_moment;
    b.warped = c.c1_;
    return exponential_intensity(b, z_f, settings);
}

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

const exponential_variance_half_exponent: f32 = 0x1.628f5cp+2; // 5.54, both; exp(2 c) fills a half
const exponential_variance_half_minimum_variance: f32 = 0x1.d07deep-18; // 6.921468870293247e-6, 99 (3 2^-11 / 5.54)^2
const exponential_variance_half_darkening: f32 = 0x1.47ae14p-7; // 0.01
const exponential_variance_float_positive_exponent: f32 = 40.0;
const exponential_variance_float_negative_exponent: f32 = 0x1.628f5cp+2; // 5.54
// 4.41137400169126e-12, 99 (3 2^-24 (1 + 1 / 5.54))^2
const exponential_variance_float_minimum_variance: f32 = 0x1.366c4p-38;
const exponential_variance_float_darkening: f32 = 0x1.47ae14p-7; // 0.01

/// The channels of the filter with the given settings for a depth z.
fn gnomon_exponential_variance_to_channels(z: f32, settings: exponential_variance_settings) -> channels4_
{
    let b = exponential_variance_encode(z, settings);
    var c: channels4_;
    c.c1_ = b.positive;
    c.c2_ = b.positive_square;
    c.c3_ = b.negative;
    c.c4_ = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
fn gnomon_exponential_variance_of_channels(c: channels4_, z_f: f32, settings: exponential_variance_settings) -> f32
{
    var b: exponential_variance_moments;
    b.positive = c.c1_;
    b.positive_square = c.c2_;
    b.negative = c.c3_;
    b.negative_square = c.c4_;
    return exponential_variance_intensity(b, z_f, settings);
}

/// The four channels of a 4 x half texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
fn exponential_variance_half_encode(z: f32) -> channels4_
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
fn exponential_variance_half_intensity(c: channels4_, z_f: f32) -> f32
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_half_exponent;
    settings.negative_exponent = exponential_variance_half_exponent;
    settings.minimum_variance = exponential_variance_half_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
fn exponential_variance_float_encode(z: f32) -> channels4_
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
fn exponential_variance_float_intensity(c: channels4_, z_f: f32) -> f32
{
    var settings: exponential_variance_settings;
    settings.positive_exponent = exponential_variance_float_positive_exponent;
    settings.negative_exponent = exponential_variance_float_negative_exponent;
    settings.minimum_variance = exponential_variance_float_minimum_variance;
    return gnomon_exponential_variance_of_channels(c, z_f, settings);
}

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

/// Two textures of four channels.
struct channels8_ { t1_: channels4_, t2_: channels4_ }

const gnomon_layered_variance_unorm16_minimum_variance: f32 = 0x1.e001ep-14; // 0.00011444266422522316
const layered_variance_unorm16_darkening: f32 = 0x1.4f8b58p-16; // 2e-5

/// The settings of the layer around centre: -0.75, -0.25, 0.25 or 0.75.
fn gnomon_layered_variance_unorm16_layer(centre: f32) -> layered_variance_settings
{
    var settings: layered_variance_settings;
    settings.centre = centre;
    settings.scale = 4.0;
    settings.minimum_variance = gnomon_layered_variance_unorm16_minimum_variance;
    return settings;
}

/// The channels of the two layers around near_centre and far_centre for a depth z.
fn gnomon_layered_variance_unorm16_encode_two(z: f32, near_centre: f32, far_centre: f32) -> channels4_
{
    let first = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(near_centre));
    let second = layered_variance_encode(z, gnomon_layered_variance_unorm16_layer(far_centre));
    var c: channels4_;
    c.c1_ = 0.5 * first.mean + 0.5;
    c.c2_ = first.square;
    c.c3_ = 0.5 * second.mean + 0.5;
    c.c4_ = second.square;
    return c;
}

/// The eight channels of an 8 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn layered_variance_unorm16_encode(z: f32) -> channels8_
{
    var c: channels8_;
    c.t1_ = gnomon_layered_variance_unorm16_encode_two(z, -0.75, -0.25);
    c.t2_ = gnomon_layered_variance_unorm16_encode_two(z, 0.25, 0.75);
    return c;
}

/// The state after the layer around centre, whose channels are mean and square.
fn gnomon_layered_variance_unorm16_add(state: layered_variance, mean: f32, square: f32, centre: f32) -> layered_variance
{
    var b: variance_moments;
    b.mean = 2.0 * mean - 1.0;
    b.square = square;
    return layered_variance_add(state, b, gnomon_layered_variance_unorm16_layer(centre));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of an 8 x 16 UNORM texel.
/// Domain: any z_f; beyond a plane as on it.
/// NaN: 0, lit.
/// Error: as layered_variance_end, for the given channels.
fn layered_variance_unorm16_intensity(c: channels8_, z_f: f32) -> f32
{
    var state = layered_variance_begin(z_f);
    state = gnomon_layered_variance_unorm16_add(state, c.t1_.c1_, c.t1_.c2_, -0.75);
    state = gnomon_layered_variance_unorm16_add(state, c.t1_.c3_, c.t1_.c4_, -0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2_.c1_, c.t2_.c2_, 0.25);
    state = gnomon_layered_variance_unorm16_add(state, c.t2_.c3_, c.t2_.c4_, 0.75);
    return layered_variance_end(state);
}

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

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel4_from_unorm16_blended(c: channels4_, roundings: f32) -> hankel4_
{
    return gnomon_hankel4_from_theta(
        c, bias_weight_of_roundings(gnomon_stored4_unorm16_weight, gnomon_blended_roundings(roundings, 1.0)));
}

/// The factored matrix of the channels of a 4 x half texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel4_from_half_blended(c: channels4_, roundings: f32) -> hankel4_
{
    let n = gnomon_blended_roundings(roundings, gnomon_blended_half_roundings);
    return gnomon_hankel4_from_theta(gnomon_channels4_shifted(c, 0.5),
                                     bias_weight_of_roundings(gnomon_stored4_half_weight, n));
}

/// The factored matrix of the channels of a 4 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel4_from_float_blended(c: channels4_, roundings: f32) -> hankel4_
{
    let n = gnomon_blended_roundings(roundings, gnomon_blended_float_roundings);
    return gnomon_hankel4_stored_as_float(c, bias_weight_of_roundings(gnomon_stored4_float_weight, n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_unorm16_blended_intensity(c: channels4_, roundings: f32, z_f: f32) -> f32
{
    let n = gnomon_blended_roundings(roundings, 1.0);
    return gnomon_moments4_theta_intensity(c, n * certified4_unorm16_noise,
                                           bias_weight_of_roundings(certified4_unorm16_weight, n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_half_blended_intensity(c: channels4_, roundings: f32, z_f: f32) -> f32
{
    let n = gnomon_blended_roundings(roundings, gnomon_blended_half_roundings);
    return gnomon_moments4_theta_intensity(gnomon_channels4_shifted(c, 0.5), n * certified4_half_noise,
                                           bias_weight_of_roundings(certified4_half_weight, n), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_float_blended_intensity(c: channels4_, roundings: f32, z_f: f32) -> f32
{
    let n = gnomon_blended_roundings(roundings, gnomon_blended_float_roundings);
    // Roundings of earlier states of the texel, in which a moment was larger, are no fraction of that moment.
    var noise: moments4_;
    noise.b1_ = n * certified4_float_noise;
    noise.b2_ = noise.b1_;
    noise.b3_ = noise.b1_;
    noise.b4_ = noise.b1_;
    return gnomon_moments4_float_intensity_with_noise(
        c, noise, bias_weight_of_roundings(certified4_float_weight, n), z_f);
}

// storage/moments4_summed.h -------------------------------------------------------------------------------------------
// Four moments in a summed-area table (soft/summed_area.h): from a depth to the codes of a texel, and from the mean
// channels of a rectangle to a shadow and to the depth of blockers.
//
//   a texel:        c = moments4_summed_encode(z)               channels of theta4_; a resolve averages them
//                   codes = moments4_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments4_summed_channels(sums, area, scale)
//                   z_b = moments4_summed_blocker(c, most_texels, z_f)
//                   shadow = moments4_summed_intensity(c, most_texels, z_f - bias)
//
// Encoding and the inverse of theta4_ keep the digits that Real has no room for: without them the noise of channels
// (summed_area_noise) would be twice as large. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by
// at most
//   moments4_summed_intensity   gnomon_stored4_arithmetic_weight: certificates (certified4.h)
//   hankel4_from_summed         moments4_summed_bias_ratio times the noise, and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/soft/honest_summed.cpp).

const moments4_summed_bias_ratio: f32 = 5.0;
const moments4_summed_node_ratio: f32 = 4.0; // for the nodes of certificates

/// a + b as a double word, for magnitudes in any order.
fn gnomon_summed_two_sum(a: f32, b: f32) -> gnomon_double_word { return two_difference(a, -1.0 * b); }

const gnomon_summed_four_ninths: f32 = 0x1.c71c72p-2; // 0.44444444444444442
const gnomon_summed_third: f32 = 0x1.555556p-2; // 0.33333333333333331

/// The digits of a root for which float has no room: root - factor, where factor is the rounded root and root^2 =
/// square.
fn gnomon_summed_root_rest(factor: f32, square: f32) -> f32
{
    let p = two_product(factor, factor);
    return ((square - p.high) - p.low) * (0.5 / factor);
}

/// The four channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of a channel, 0.51 2^-p.
/// Source: Peters 2017, Eq. 3
fn moments4_summed_encode(z: f32) -> channels4_
{
    let x = clamp_or_high(z, -1.0, 1.0);
    let z2 = two_product(x, x);
    var z3 = two_product(z2.high, x);
    z3.low = z3.low + z2.low * x;
    var z4 = two_product(z2.high, z2.high);
    z4.low = z4.low + 2.0 * (z2.high * z2.low);
    var c: channels4_;
    // 1/2 + 3/2 z - 2 z^3
    let s = two_difference(0.5, 2.0 * z3.high);
    let t = gnomon_summed_two_sum(s.high, x);
    let u = gnomon_summed_two_sum(t.high, 0.5 * x);
    c.c1_ = u.high + (u.low + (t.low + (s.low - 2.0 * z3.low)));
    // 4 (z^2 - z^4)
    let d = two_difference(z2.high, z4.high);
    c.c2_ = 4.0 * (d.high + (d.low + (z2.low - z4.low)));
    // 1/2 + sqrt(3)/2 (z - 4/9 z^3)
    let ninths = gnomon_summed_four_ninths;
    let n = two_product(ninths, 9.0);
    let q = two_product(z3.high, ninths);
    let w = two_difference(x, q.high);
    let rest = w.low - (q.low + (z3.low * ninths + z3.high * (((4.0 - n.high) - n.low) * (0.25 * ninths))));
    let root = gnomon_theta4_31_;
    let p = two_product(root, w.high);
    let h = gnomon_summed_two_sum(0.5, p.high);
    c.c3_ = h.high + (h.low + (p.low + (root * rest + gnomon_summed_root_rest(root, 0.75) * w.high)));
    // (z^2 + z^4) / 2
    let m = gnomon_summed_two_sum(z2.high, z4.high);
    c.c4_ = 0.5 * (m.high + (m.low + (z2.low + z4.low)));
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
fn moments4_summed_codes(c: channels4_, scale: f32) -> channels4_
{
    let any = (clamp_or_nan(c.c1_, 0.0, 1.0) + clamp_or_nan(c.c2_, 0.0, 1.0)) +
              (clamp_or_nan(c.c3_, 0.0, 1.0) + clamp_or_nan(c.c4_, 0.0, 1.0));
    let known = any == any;
    let border = moments4_summed_encode(1.0);
    var r: channels4_;
    r.c1_ = summed_area_code(gnomon_select(known, c.c1_, border.c1_), scale);
    r.c2_ = summed_area_code(gnomon_select(known, c.c2_, border.c2_), scale);
    r.c3_ = summed_area_code(gnomon_select(known, c.c3_, border.c3_), scale);
    r.c4_ = summed_area_code(gnomon_select(known, c.c4_, border.c4_), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
fn moments4_summed_channels(sums: channels4_, area: f32, scale: f32) -> channels4_
{
    let some = 0.0 < area;
    let border = moments4_summed_encode(1.0);
    var r: channels4_;
    r.c1_ = gnomon_select(some, summed_area_mean(sums.c1_, area, scale), border.c1_);
    r.c2_ = gnomon_select(some, summed_area_mean(sums.c2_, area, scale), border.c2_);
    r.c3_ = gnomon_select(some, summed_area_mean(sums.c3_, area, scale), border.c3_);
    r.c4_ = gnomon_select(some, summed_area_mean(sums.c4_, area, scale), border.c4_);
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha. What rounding would take
/// from the moments is added to their covariances.
fn gnomon_hankel4_from_summed_theta(c: channels4_, bias2: f32, bias4: f32, alpha: f32) -> hankel4_
{
    let c1 = two_difference(c.c1_, 0.5);
    let c3 = two_difference(c.c3_, 0.5);
    let root = gnomon_theta4_inverse13_;
    let third = gnomon_summed_third;
    // t = sqrt(3) (c3 - 1/2),    b1 = t - (c1 - 1/2) / 3,    b3 = 3/4 (t - (c1 - 1/2))
    var t = two_product(root, c3.high);
    t.low = t.low + (root * c3.low + gnomon_summed_root_rest(root, 3.0) * c3.high);
    let n = two_product(third, 3.0);
    var q = two_product(third, c1.high);
    q.low = q.low + (third * c1.low + (third * ((1.0 - n.high) - n.low)) * c1.high);
    let d1 = two_difference(t.high, q.high);
    let d3 = two_difference(t.high, c1.high);
    let p3 = two_product(0.75, d3.high);
    let eighth = 0.125 * c.c2_;
    let d2 = gnomon_summed_two_sum(c.c4_, eighth);
    let d4 = two_difference(c.c4_, eighth);
    var b: moments4_;
    b.b1_ = d1.high;
    b.b2_ = d2.high;
    b.b3_ = p3.high;
    b.b4_ = d4.high;
    var e: moments4_;
    e.b1_ = (d1.low + (t.low - q.low)) - alpha * b.b1_;
    e.b2_ = d2.low + alpha * (bias2 - b.b2_);
    e.b3_ = (p3.low + 0.75 * (d3.low + (t.low - c1.low))) - alpha * b.b3_;
    e.b4_ = d4.low + alpha * (bias4 - b.b4_);
    return gnomon_hankel4_with_change(b, e);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
fn hankel4_from_summed(c: channels4_, most_texels: f32) -> hankel4_
{
    let weight = moments4_summed_bias_ratio * summed_area_noise(most_texels);
    return gnomon_hankel4_from_summed_theta(c, bias4_theta_b2_, bias4_theta_b4_, gnomon_min(weight, 0.5));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
fn moments4_summed_intensity(c: channels4_, most_texels: f32, z_f: f32) -> f32
{
    let noise = summed_area_noise(most_texels);
    let weight = gnomon_min(moments4_summed_node_ratio * noise, 0.5);
    let h = gnomon_hankel4_from_summed_theta(c, bias4_theta_b2_, bias4_theta_b4_, weight);
    return certified4_theta_constant_bias_lower(h, noise, bias4_theta_b2_, bias4_theta_b4_, weight, z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
fn moments4_summed_blocker(c: channels4_, most_texels: f32, z_f: f32) -> f32
{
    return blocker4_depth(hankel4_from_summed(c, most_texels), z_f);
}

// storage/moments4_summed_within.h ------------------------------------------------------------------------------------
// Four moments in a summed-area table (moments4_summed.h), where the sharp bound for depths in [-1, 1] (hausdorff4.h)
// takes the place of that for any depths. Intensities exceed Z(z < z_f) by at most moments4_summed_within_weight.

const moments4_summed_within_bias_ratio: f32 = 0x1.8cccccp+2; // 6.2, 1 / r
const moments4_summed_within_float_weight: f32 = 0x1.0c6f7ap-20; // 1e-6

/// The weight of the bias of hankel4_from_summed_within: what the errors of the channels make necessary, and what float
/// arithmetic rounds in the bound.
/// Domain: most_texels at least 0.
fn moments4_summed_within_weight(most_texels: f32) -> f32
{
    return moments4_summed_within_bias_ratio * summed_area_noise(most_texels) + moments4_summed_within_float_weight;
}

/// The factored matrix of the channels of a rectangle, with a bias for depths in [-1, 1].
fn hankel4_from_summed_within(c: channels4_, most_texels: f32) -> hankel4_
{
    return gnomon_hankel4_from_summed_theta(c, bias4_theta_within_b2_, bias4_theta_within_b4_,
                                            gnomon_min(moments4_summed_within_weight(most_texels), 0.5));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments4_summed_intensity_within(c: channels4_, most_texels: f32, z_f: f32) -> f32
{
    return hausdorff4_lower(hankel4_from_summed_within(c, most_texels), z_f);
}

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

const gnomon_certified4_gap: f32 = 9.5367431640625e-7; // 2^-20, the least that the receiver is before greatest

/// The certificate on [least, greatest] for a receiver z_f inside, from moments b with a bias.
fn gnomon_certificate4_within(b: moments4_, least: f32, given_greatest: f32, z_f: f32) -> gnomon_certificate4_
{
    var greatest = given_greatest;
    greatest = gnomon_max(greatest, z_f + gnomon_certified4_gap);
    let sum = least + greatest;
    let product = least * greatest;
    let e0 = (sum * b.b1_ - b.b2_) - product;
    let e1 = (sum * b.b2_ - b.b3_) - product * b.b1_;
    let e2 = (sum * b.b3_ - b.b4_) - product * b.b2_;
    var x = (e2 - z_f * e1) / (e1 - z_f * e0);
    x = gnomon_select(x < greatest, x, greatest);
    x = gnomon_select(least < x, x, least);
    let behind = z_f < x;
    // The line k0 + k1 z: through z_f and greatest, or the multiple of z - z_f that is 1 at least.
    let to_least = least - x;
    let to_z_f = z_f - x;
    let to_greatest = greatest - x;
    let at_least = 1.0 / (to_least * to_least);
    let at_z_f = 1.0 / ((z_f - least) * (to_z_f * to_z_f));
    let at_greatest = 1.0 / ((greatest - least) * (to_greatest * to_greatest));
    let slope = gnomon_select(behind, at_least / ((z_f - least) * (least - greatest)), (at_greatest - at_z_f) /
                              (greatest - z_f));
    let offset = gnomon_select(behind, 0.0, at_z_f) - slope * z_f;
    // s = (z - other) (z - x)^2 (offset + slope z)
    let minus_other = -1.0 * gnomon_select(behind, greatest, least);
    let m0 = minus_other * offset;
    let m1 = offset + minus_other * slope;
    let n0 = x * x;
    let n1 = -2.0 * x;
    var p: gnomon_certificate4_;
    p.top = gnomon_select(behind, 0.0, 1.0);
    p.s0_ = m0 * n0;
    p.s1_ = m0 * n1 + m1 * n0;
    p.s2_ = m0 + (m1 * n1 + slope * n0);
    p.s3_ = m1 + slope * n1;
    p.s4_ = slope;
    return p;
}

/// The greater of two certified means as an intensity in [0, 1]: 1 where every depth is before z_f, 0 where none is,
/// and where the ends are not in order.
/// NaN: 0, lit.
fn gnomon_certified4_from_means(mean: f32, within: f32, least: f32, greatest: f32, z_f: f32) -> f32
{
    var intensity = saturate_or_zero(gnomon_max(within, mean));
    intensity = gnomon_select(greatest < z_f, 1.0, intensity);
    return gnomon_select(least < z_f && least <= greatest, intensity, 0.0);
}

/// Shadow intensity at z_f from channels c of theta4_, each off by at most noise.
fn gnomon_certified4_theta_within(c: channels4_, noise: f32, alpha: f32, least: f32, greatest: f32, z_f: f32) -> f32
{
    let z = clamp_or_nan(z_f, -1.0, 1.0);
    let b = theta4_inverse_add_bias(c, bias4_theta_b2_, alpha);
    let mean = gnomon_certificate4_theta_mean(gnomon_certificate4_make(hankel4_from_moments(b), z), c, noise);
    let within = gnomon_certificate4_theta_mean(gnomon_certificate4_within(b, least, greatest, z), c, noise);
    return gnomon_certified4_from_means(mean, within, least, greatest, z);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel and the least and greatest depth
/// of the region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
fn moments4_unorm16_intensity_within(c: channels4_, least: f32, greatest: f32, z_f: f32) -> f32
{
    return gnomon_certified4_theta_within(c, certified4_unorm16_noise, certified4_unorm16_weight, least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes;
/// least and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
fn moments4_unorm16_filtered_intensity_within(c: channels4_, least: f32, greatest: f32, z_f: f32) -> f32
{
    return gnomon_certified4_theta_within(c, certified4_unorm16_filtered_noise, certified4_unorm16_filtered_weight,
                                          least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel and the least and greatest depth of
/// the region, rounded down and up where they are stored.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
fn moments4_half_intensity_within(c: channels4_, least: f32, greatest: f32, z_f: f32) -> f32
{
    return gnomon_certified4_theta_within(gnomon_channels4_shifted(c, 0.5), certified4_half_noise,
                                          certified4_half_weight, least, greatest, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes; least
/// and greatest are those of all texels that the filter reads.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else lit.
/// NaN: 0, lit.
fn moments4_half_filtered_intensity_within(c: channels4_, least: f32, greatest: f32, z_f: f32) -> f32
{
    return gnomon_certified4_theta_within(gnomon_channels4_shifted(c, 0.5), certified4_half_filtered_noise,
                                          certified4_half_filtered_weight, least, greatest, z_f);
}

// storage/moments6.h --------------------------------------------------------------------------------------------------
// Six moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow or
// to the factored Hankel matrix. Each format undoes its own transform and applies the constant bias that belongs to it,
// so that nobody pairs the wrong three.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   6 x 10 UNORM      8     theta6_      moments6_unorm10_encode   moments6_unorm10_intensity   hankel6_from_unorm10_
//   6 x 16 UNORM     12     theta6_      moments6_unorm16_encode   moments6_unorm16_intensity   hankel6_from_unorm16_
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

const gnomon_stored6_unorm10_weight: f32 = 0x1.0624dep-8; // 4e-3
const gnomon_stored6_unorm10_filtered_weight: f32 = 0x1.47ae14p-7; // 1e-2
const gnomon_stored6_unorm16_weight: f32 = 0x1.4f8b58p-14; // 8e-5
const gnomon_stored6_unorm16_filtered_weight: f32 = 0x1.4f8b58p-13; // 1.6e-4
const gnomon_stored6_float_weight: f32 = 0x1.4f8b58p-18; // 5e-6
const gnomon_stored6_float_filtered_weight: f32 = 0x1.4f8b58p-16; // 2e-5

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_unorm10_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_unorm16_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn moments6_float_encode(z: f32) -> channels6_
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, -1.0, 1.0)));
}

/// The factored matrix of the channels of theta6_, with a constant bias of weight alpha.
fn gnomon_hankel6_from_theta(c: channels6_, alpha: f32) -> hankel6_
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), gnomon_bias6_theta_b2_, gnomon_bias6_theta_b4_,
                                                  gnomon_bias6_theta_b6_, alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
fn hankel6_from_unorm10_(c: channels6_) -> hankel6_ { return gnomon_hankel6_from_theta(c,
                                                                                       gnomon_stored6_unorm10_weight); }

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
fn hankel6_from_unorm10_filtered(c: channels6_) -> hankel6_
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm10_filtered_weight);
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
fn hankel6_from_unorm16_(c: channels6_) -> hankel6_ { return gnomon_hankel6_from_theta(c,
                                                                                       gnomon_stored6_unorm16_weight); }

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
fn hankel6_from_unorm16_filtered(c: channels6_) -> hankel6_
{
    return gnomon_hankel6_from_theta(c, gnomon_stored6_unorm16_filtered_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
fn hankel6_from_float(c: channels6_) -> hankel6_
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2_, bias6_raw_b4_, bias6_raw_b6_,
                                 gnomon_stored6_float_weight);
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
fn hankel6_from_float_filtered(c: channels6_) -> hankel6_
{
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2_, bias6_raw_b4_, bias6_raw_b6_,
                                 gnomon_stored6_float_filtered_weight);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm10_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_unorm10_(c),
                                                                                        z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm10_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm16_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_unorm16_(c),
                                                                                        z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm16_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_float_intensity(c: channels6_, z_f: f32) -> f32 { return hamburger6_lower(hankel6_from_float(c), z_f); }

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_float_filtered_intensity(c: channels6_, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
}

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

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel6_from_unorm10_blended(c: channels6_, roundings: f32) -> hankel6_
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm10_weight, gnomon_blended_roundings(roundings, 1.0)));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel6_from_unorm16_blended(c: channels6_, roundings: f32) -> hankel6_
{
    return gnomon_hankel6_from_theta(
        c, bias_weight_of_roundings(gnomon_stored6_unorm16_weight, gnomon_blended_roundings(roundings, 1.0)));
}

const gnomon_blended6_float_weights: f32 = 1.5;

/// The factored matrix of the channels of a 6 x float texel, biased for blends.
/// Domain: roundings >= 0, clamped.
/// NaN: stays NaN.
fn hankel6_from_float_blended(c: channels6_, roundings: f32) -> hankel6_
{
    let n = gnomon_blended_roundings(roundings, gnomon_blended6_float_weights);
    return hankel6_constant_bias(moments6_from_channels(c), bias6_raw_b2_, bias6_raw_b4_, bias6_raw_b6_,
                                 bias_weight_of_roundings(gnomon_stored6_float_weight, n));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm10_blended_intensity(c: channels6_, roundings: f32, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm10_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_unorm16_blended_intensity(c: channels6_, roundings: f32, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_unorm16_blended(c, roundings), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel that was blended into.
/// Domain: roundings >= 0, clamped; any z_f, limited to [-1, 1].
/// NaN: 0, lit.
fn moments6_float_blended_intensity(c: channels6_, roundings: f32, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_float_blended(c, roundings), z_f);
}

// storage/moments6_summed.h -------------------------------------------------------------------------------------------
// Six moments in a summed-area table (soft/summed_area.h): moments4_summed.h for search regions that hold more
// surfaces, in 24 bytes a texel.
//
//   a texel:        c = moments6_summed_encode(z)               channels of theta6_; a resolve averages them
//                   codes = moments6_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments6_summed_channels(sums, area, scale)
//                   z_b = moments6_summed_blocker(c, most_texels, z_f)
//                   shadow = moments6_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by half a code, most_texels 2^-33, and by what float arithmetic rounds. Intensities exceed Z(z <
// z_f) by moments6_summed_weight at most.

const moments6_summed_code_weight: f32 = 0x1.b7cdfep-31; // 8e-10, 2^-33 / r
const moments6_summed_float_weight: f32 = 0x1.92a738p-18; // 6e-6

/// The weight of the constant bias of a table for most_texels, by which intensities may exceed the truth.
/// Domain: most_texels as of the table's scale.
/// NaN: the weight of a small table.
fn moments6_summed_weight(most_texels: f32) -> f32
{
    let weight = moments6_summed_code_weight * most_texels + moments6_summed_float_weight;
    return gnomon_min(gnomon_max(weight, moments6_summed_float_weight), 0.5);
}

/// The six channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
fn moments6_summed_encode(z: f32) -> channels6_ { return theta6_(moments6_from_depth(clamp_or_high(z, -1.0, 1.0))); }

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
fn moments6_summed_codes(c: channels6_, scale: f32) -> channels6_
{
    let any = (clamp_or_nan(c.c1_, 0.0, 1.0) + clamp_or_nan(c.c2_, 0.0, 1.0)) +
              (clamp_or_nan(c.c3_, 0.0, 1.0) + clamp_or_nan(c.c4_, 0.0, 1.0)) +
              (clamp_or_nan(c.c5_, 0.0, 1.0) + clamp_or_nan(c.c6_, 0.0, 1.0));
    let known = any == any;
    let border = moments6_summed_encode(1.0);
    var r: channels6_;
    r.c1_ = summed_area_code(gnomon_select(known, c.c1_, border.c1_), scale);
    r.c2_ = summed_area_code(gnomon_select(known, c.c2_, border.c2_), scale);
    r.c3_ = summed_area_code(gnomon_select(known, c.c3_, border.c3_), scale);
    r.c4_ = summed_area_code(gnomon_select(known, c.c4_, border.c4_), scale);
    r.c5_ = summed_area_code(gnomon_select(known, c.c5_, border.c5_), scale);
    r.c6_ = summed_area_code(gnomon_select(known, c.c6_, border.c6_), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
fn moments6_summed_channels(sums: channels6_, area: f32, scale: f32) -> channels6_
{
    let some = 0.0 < area;
    let border = moments6_summed_encode(1.0); // off by roundings, also beyond 1
    var r: channels6_;
    r.c1_ = gnomon_select(some, summed_area_mean(sums.c1_, area, scale), saturate_or_zero(border.c1_));
    r.c2_ = gnomon_select(some, summed_area_mean(sums.c2_, area, scale), saturate_or_zero(border.c2_));
    r.c3_ = gnomon_select(some, summed_area_mean(sums.c3_, area, scale), saturate_or_zero(border.c3_));
    r.c4_ = gnomon_select(some, summed_area_mean(sums.c4_, area, scale), saturate_or_zero(border.c4_));
    r.c5_ = gnomon_select(some, summed_area_mean(sums.c5_, area, scale), saturate_or_zero(border.c5_));
    r.c6_ = gnomon_select(some, summed_area_mean(sums.c6_, area, scale), saturate_or_zero(border.c6_));
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha.
fn gnomon_hankel6_from_summed_theta(c: channels6_, alpha: f32) -> hankel6_
{
    return hankel6_constant_bias(theta6_inverse(c), gnomon_bias6_theta_b2_, gnomon_bias6_theta_b4_,
                                 gnomon_bias6_theta_b6_, alpha);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
fn hankel6_from_summed(c: channels6_, most_texels: f32) -> hankel6_
{
    return gnomon_hankel6_from_summed_theta(c, moments6_summed_weight(most_texels));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
fn moments6_summed_intensity(c: channels6_, most_texels: f32, z_f: f32) -> f32
{
    return hamburger6_lower(hankel6_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
fn moments6_summed_blocker(c: channels6_, most_texels: f32, z_f: f32) -> f32
{
    return blocker6_depth(hankel6_from_summed(c, most_texels), z_f);
}

// storage/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered channels to a
// shadow, each with the minimum variance that hides the roundings of its format.
//
//   format          bytes   channels                      write                     read
//   2 x 16 UNORM      4     (1 + mean) / 2, mean square   variance_unorm16_encode   variance_unorm16_intensity
//
// A minimum variance m lets an error e of the mean darken a lit surface by e^2 / (m + e^2) at most (Cantelli). It is
// chosen as 99 e^2, for 1%, where e is three roundings of a depth: when rendered, and by each of two filter passes.

const variance_unorm16_minimum_variance: f32 = 0x1.bd837cp-23; // 2.0745843457628005e-7, 99 (3 / 65535)^2
const variance_unorm16_darkening: f32 = 0x1.47ae14p-7; // 0.01

/// The two channels of a 2 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn variance_unorm16_encode(z: f32) -> channels2_
{
    let b = variance_encode(z);
    var c: channels2_;
    c.c1_ = 0.5 * b.mean + 0.5;
    c.c2_ = b.square;
    return c;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 2 x 16 UNORM texel.
/// Domain: any z_f; beyond the far plane as on it.
/// NaN: 0, lit.
/// Error: as variance_intensity, for the given channels.
fn variance_unorm16_intensity(c: channels2_, z_f: f32) -> f32
{
    var b: variance_moments;
    b.mean = 2.0 * c.c1_ - 1.0;
    b.square = c.c2_;
    var settings: variance_settings;
    settings.minimum_variance = variance_unorm16_minimum_variance;
    return variance_intensity(b, z_f, settings);
}

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

const variance_summed_darkening: f32 = 0x1.0c6f7ap-20; // 1e-6

/// The two channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
fn variance_summed_encode(z: f32) -> channels2_
{
    let x = clamp_or_high(z, -1.0, 1.0);
    var c: channels2_;
    c.c1_ = 0.5 * x + 0.5;
    c.c2_ = x * x;
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
fn variance_summed_codes(c: channels2_, scale: f32) -> channels2_
{
    let any = clamp_or_nan(c.c1_, 0.0, 1.0) + clamp_or_nan(c.c2_, 0.0, 1.0);
    let known = any == any;
    var r: channels2_;
    r.c1_ = summed_area_code(gnomon_select(known, c.c1_, 1.0), scale);
    r.c2_ = summed_area_code(gnomon_select(known, c.c2_, 1.0), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
fn variance_summed_channels(sums: channels2_, area: f32, scale: f32) -> channels2_
{
    let some = 0.0 < area;
    var r: channels2_;
    r.c1_ = gnomon_select(some, summed_area_mean(sums.c1_, area, scale), 1.0);
    r.c2_ = gnomon_select(some, summed_area_mean(sums.c2_, area, scale), 1.0);
    return r;
}

/// The mean and the largest variance that channels may have which are off by noise.
struct variance_summed_moments { mean: f32, variance: f32 }

fn gnomon_variance_summed_decode(c: channels2_, noise: f32) -> variance_summed_moments
{
    var r: variance_summed_moments;
    r.mean = (c.c1_ - 0.5) * 2.0;
    let doubt = (1.0 + 4.0 * gnomon_abs(r.mean)) * noise;
    r.variance = gnomon_max(subtract_product_rounded(c.c2_, r.mean, r.mean), 0.0) + doubt;
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
/// Source: Donnelly & Lauritzen 2006
fn variance_summed_intensity(c: channels2_, most_texels: f32, z_f: f32) -> f32
{
    let noise = summed_area_noise(most_texels);
    let b = gnomon_variance_summed_decode(c, noise);
    let distance_ = (clamp_or_nan(z_f, -1.0, 1.0) - b.mean) - 2.0 * noise;
    let d = gnomon_max(0.0, distance_);
    // 1, or 0 for NaN, without a comparison, which Metal's fast mathematics would lose.
    let known = saturate_or_zero(c.c2_ + 1.0);
    return known * saturate_or_zero(d * d / (b.variance + d * d));
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
/// Error: against the kernel in double, for a table of 784 texels,
///     error, float, variance_summed_blocker: p99 1e-6, p99.9 2e-4, max 2e-3
/// Source: Yang 2010
fn variance_summed_blocker(c: channels2_, most_texels: f32, z_f: f32) -> f32
{
    let b = gnomon_variance_summed_decode(c, summed_area_noise(most_texels));
    let depth = blocker2_depth(b.mean, b.variance, z_f);
    return gnomon_select(c.c2_ == c.c2_, depth, clamp_or_high(z_f, -1.0, 1.0));
}
