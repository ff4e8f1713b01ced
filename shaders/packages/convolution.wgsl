// Gnomon 0.1.0, convolution.wgsl: shadow filtering in WGSL, this file alone.
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
