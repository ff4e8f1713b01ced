// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H
#include "round.h"
#include "select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(exp_log2_e, 1.4426950408889634);
GNOMON_CONSTANT(exp_ln2_low, -2.1219444005469058e-4);
GNOMON_CONSTANT(exp_sqrt_2, 1.4142135623730951);
GNOMON_CONSTANT(exp_sqrt_half, 0.70710678118654752);

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
GNOMON_CONSTANT(exp_float_0, 0.49999993561656014);
GNOMON_CONSTANT(exp_float_1, 0.16666518908321371);
GNOMON_CONSTANT(exp_float_2, 0.041668318723256166);
GNOMON_CONSTANT(exp_float_3, 0.0083689258101569408);
GNOMON_CONSTANT(exp_float_4, 0.00138210541669496);
GNOMON_CONSTANT(exp_double_0, 0.50000000000000111);
GNOMON_CONSTANT(exp_double_1, 0.16666666666666424);
GNOMON_CONSTANT(exp_double_2, 0.041666666666526318);
GNOMON_CONSTANT(exp_double_3, 0.0083333333334836331);
GNOMON_CONSTANT(exp_double_4, 0.0013888888944739634);
GNOMON_CONSTANT(exp_double_5, 0.00019841269536328214);
GNOMON_CONSTANT(exp_double_6, 2.4801491857967717e-05);
GNOMON_CONSTANT(exp_double_7, 2.7557554255829581e-06);
GNOMON_CONSTANT(exp_double_8, 2.7630720120614683e-07);
GNOMON_CONSTANT(exp_double_9, 2.5011956595275024e-08);

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
GNOMON_CONSTANT(log_float_0, 0.66666776085218282);
GNOMON_CONSTANT(log_float_1, 0.39977574040563962);
GNOMON_CONSTANT(log_float_2, 0.29870936689734456);
GNOMON_CONSTANT(log_double_0, 0.6666666666666734);
GNOMON_CONSTANT(log_double_1, 0.39999999999416375);
GNOMON_CONSTANT(log_double_2, 0.28571428742015142);
GNOMON_CONSTANT(log_double_3, 0.22222198610815577);
GNOMON_CONSTANT(log_double_4, 0.1818356240364567);
GNOMON_CONSTANT(log_double_5, 0.15314098871014789);
GNOMON_CONSTANT(log_double_6, 0.14795474816803084);

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
GNOMON_DETAIL_KERNEL Real exp_remainder(Real r)
{
    Real p =
        GNOMON_LITERAL(exp_float_0) +
        r * (GNOMON_LITERAL(exp_float_1) +
             r * (GNOMON_LITERAL(exp_float_2) + r * (GNOMON_LITERAL(exp_float_3) + r * GNOMON_LITERAL(exp_float_4))));
    if (GNOMON_DIGITS > 24) {
        p = GNOMON_LITERAL(exp_double_0) +
            r * (GNOMON_LITERAL(exp_double_1) +
                 r * (GNOMON_LITERAL(exp_double_2) +
                      r * (GNOMON_LITERAL(exp_double_3) +
                           r * (GNOMON_LITERAL(exp_double_4) +
                                r * (GNOMON_LITERAL(exp_double_5) +
                                     r * (GNOMON_LITERAL(exp_double_6) +
                                          r * (GNOMON_LITERAL(exp_double_7) +
                                               r * (GNOMON_LITERAL(exp_double_8) +
                                                    r * GNOMON_LITERAL(exp_double_9)))))))));
    }
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
GNOMON_KERNEL Real polynomial_exp(Real x)
{
    Real low = Real(-87);
    Real high = Real(88);
    if (GNOMON_DIGITS > 24) {
        low = Real(-708);
        high = Real(709);
    }
    x = clamp_or_nan(x, low, high);
    Real n = nearest_integer(x * GNOMON_LITERAL(exp_log2_e));
    Real r = gnomon_difference(x, n * Real(0.693359375)) - n * GNOMON_LITERAL(exp_ln2_low);
    return (Real(1) + (r + r * r * exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
GNOMON_STRUCT(scaled_number) { Real significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
GNOMON_DETAIL_KERNEL GNOMON_T(scaled_number) scaled_number_step(GNOMON_T(scaled_number) s, Real k)
{
    Real up = gnomon_power_of_two(k);
    Real down = gnomon_power_of_two(-k);
    GNOMON_MASK large = up <= s.significand;
    GNOMON_MASK tiny = s.significand <= down;
    GNOMON_T(scaled_number) r;
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
GNOMON_KERNEL Real polynomial_log(Real x)
{
    GNOMON_T(scaled_number) s;
    s.exponent = Real(0);
    if (GNOMON_DIGITS > 24) {
        s.significand = clamp_or_nan(x, gnomon_power_of_two(Real(-1022)), gnomon_power_of_two(Real(1023)));
        s = scaled_number_step(s, Real(512));
        s = scaled_number_step(s, Real(256));
        s = scaled_number_step(s, Real(128));
    } else {
        s.significand = clamp_or_nan(x, gnomon_power_of_two(Real(-126)), gnomon_power_of_two(Real(127)));
    }
    s = scaled_number_step(s, Real(64));
    s = scaled_number_step(s, Real(32));
    s = scaled_number_step(s, Real(16));
    s = scaled_number_step(s, Real(8));
    s = scaled_number_step(s, Real(4));
    s = scaled_number_step(s, Real(2));
    s = scaled_number_step(s, Real(1));
    GNOMON_MASK large = GNOMON_LITERAL(exp_sqrt_2) < s.significand;
    GNOMON_MASK tiny = s.significand < GNOMON_LITERAL(exp_sqrt_half);
    Real m =
        gnomon_select(large, s.significand * Real(0.5), gnomon_select(tiny, s.significand * Real(2), s.significand));
    Real n = gnomon_select(large, s.exponent + Real(1), gnomon_select(tiny, s.exponent - Real(1), s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    Real f = m - Real(1);
    Real y = f / (Real(2) + f);
    Real z = y * y;
    Real p = GNOMON_LITERAL(log_float_0) + z * (GNOMON_LITERAL(log_float_1) + z * GNOMON_LITERAL(log_float_2));
    if (GNOMON_DIGITS > 24) {
        p = GNOMON_LITERAL(log_double_0) +
            z * (GNOMON_LITERAL(log_double_1) +
                 z * (GNOMON_LITERAL(log_double_2) +
                      z * (GNOMON_LITERAL(log_double_3) +
                           z * (GNOMON_LITERAL(log_double_4) +
                                z * (GNOMON_LITERAL(log_double_5) + z * GNOMON_LITERAL(log_double_6))))));
    }
    Real square = Real(0.5) * f * f;
    Real rest = y * (square + z * p) + n * GNOMON_LITERAL(exp_ln2_low);
    return n * Real(0.693359375) - ((square - rest) - f);
}

GNOMON_NAMESPACE_END
#endif
