// Gnomon 0.1.0, rectified_frustum.wgsl: shadow filtering in WGSL, this file alone.
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
