// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_TRIGONOMETRY_H
#define GNOMON_NUMERICS_TRIGONOMETRY_H
#include "round.h"
#include "select.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(trigonometry_two_over_pi, 0.63661977236758134);
GNOMON_CONSTANT(trigonometry_half_pi_low, 7.5497899548918821e-8);
GNOMON_CONSTANT(trigonometry_half_pi, 1.5707963267948966);
GNOMON_CONSTANT(trigonometry_quarter_pi_low, 1.5695823932524066e-7);
GNOMON_CONSTANT(trigonometry_tan_pi_8, 0.41421356237309505);

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
GNOMON_CONSTANT(sin_float_0, -0.16666654609567105);
GNOMON_CONSTANT(sin_float_1, 0.0083321607625195058);
GNOMON_CONSTANT(sin_float_2, -0.00019515283258365583);
GNOMON_CONSTANT(sin_double_0, -0.1666666666666663);
GNOMON_CONSTANT(sin_double_1, 0.0083333333333221182);
GNOMON_CONSTANT(sin_double_2, -0.00019841269829589566);
GNOMON_CONSTANT(sin_double_3, 2.7557313621395315e-06);
GNOMON_CONSTANT(sin_double_4, -2.5050747764366045e-08);
GNOMON_CONSTANT(sin_double_5, 1.5896230244963151e-10);

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
GNOMON_CONSTANT(cos_float_0, 0.041666645683017541);
GNOMON_CONSTANT(cos_float_1, -0.0013887316256332952);
GNOMON_CONSTANT(cos_float_2, 2.4433157272163749e-05);
GNOMON_CONSTANT(cos_double_0, 0.041666666666666595);
GNOMON_CONSTANT(cos_double_1, -0.0013888888888873056);
GNOMON_CONSTANT(cos_double_2, 2.4801587288851717e-05);
GNOMON_CONSTANT(cos_double_3, -2.7557314179299329e-07);
GNOMON_CONSTANT(cos_double_4, 2.0875700842250843e-09);
GNOMON_CONSTANT(cos_double_5, -1.135853653338706e-11);

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
GNOMON_CONSTANT(atan_float_0, -0.33333315189495832);
GNOMON_CONSTANT(atan_float_1, 0.19998471559801789);
GNOMON_CONSTANT(atan_float_2, -0.14243534037509495);
GNOMON_CONSTANT(atan_float_3, 0.10593818186484773);
GNOMON_CONSTANT(atan_float_4, -0.060782316918251741);
GNOMON_CONSTANT(atan_double_0, -0.33333333333333198);
GNOMON_CONSTANT(atan_double_1, 0.19999999999953252);
GNOMON_CONSTANT(atan_double_2, -0.14285714280167142);
GNOMON_CONSTANT(atan_double_3, 0.11111110782181728);
GNOMON_CONSTANT(atan_double_4, -0.090908977259565496);
GNOMON_CONSTANT(atan_double_5, 0.076920597289759696);
GNOMON_CONSTANT(atan_double_6, -0.066630993254100657);
GNOMON_CONSTANT(atan_double_7, 0.05847860099229632);
GNOMON_CONSTANT(atan_double_8, -0.050391939209447408);
GNOMON_CONSTANT(atan_double_9, 0.038062223780711196);
GNOMON_CONSTANT(atan_double_10, -0.017905126733869233);

/// A cosine and the sine of the same angle.
GNOMON_STRUCT(cosine_sine) { Real cosine, sine; };

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
GNOMON_KERNEL GNOMON_T(cosine_sine) polynomial_cosine_sine(Real x)
{
    x = clamp_or_nan(x, Real(-8192), Real(8192));
    Real n = nearest_integer(x * GNOMON_LITERAL(trigonometry_two_over_pi));
    Real y = gnomon_difference(x, n * Real(1.5703125));
    y = gnomon_difference(y, n * Real(0.0004837512969970703125)) - n * GNOMON_LITERAL(trigonometry_half_pi_low);
    Real z = y * y;
    Real s = GNOMON_LITERAL(sin_float_0) + z * (GNOMON_LITERAL(sin_float_1) + z * GNOMON_LITERAL(sin_float_2));
    Real c = GNOMON_LITERAL(cos_float_0) + z * (GNOMON_LITERAL(cos_float_1) + z * GNOMON_LITERAL(cos_float_2));
    if (GNOMON_DIGITS > 24) {
        s = GNOMON_LITERAL(sin_double_0) +
            z * (GNOMON_LITERAL(sin_double_1) +
                 z * (GNOMON_LITERAL(sin_double_2) +
                      z * (GNOMON_LITERAL(sin_double_3) +
                           z * (GNOMON_LITERAL(sin_double_4) + z * GNOMON_LITERAL(sin_double_5)))));
        c = GNOMON_LITERAL(cos_double_0) +
            z * (GNOMON_LITERAL(cos_double_1) +
                 z * (GNOMON_LITERAL(cos_double_2) +
                      z * (GNOMON_LITERAL(cos_double_3) +
                           z * (GNOMON_LITERAL(cos_double_4) + z * GNOMON_LITERAL(cos_double_5)))));
    }
    s = y + y * z * s;
    c = (Real(1) - Real(0.5) * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    Real m = n - Real(4) * nearest_integer(Real(0.25) * n);
    GNOMON_MASK odd = gnomon_abs(m) == Real(1);
    GNOMON_MASK opposite = gnomon_abs(m) == Real(2);
    GNOMON_T(cosine_sine) r;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
GNOMON_KERNEL Real polynomial_cos(Real x) { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
GNOMON_KERNEL Real polynomial_sin(Real x) { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
GNOMON_KERNEL Real polynomial_atan2(Real y, Real x)
{
    Real ax = gnomon_abs(x);
    Real ay = gnomon_abs(y);
    GNOMON_MASK steep = ax < ay;
    Real shorter = gnomon_select(steep, ax, ay);
    Real longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    GNOMON_MASK wide = GNOMON_LITERAL(trigonometry_tan_pi_8) * longer < shorter;
    Real denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == Real(0), Real(1), longer));
    Real t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    Real z = t * t;
    Real p = GNOMON_LITERAL(atan_float_0) +
             z * (GNOMON_LITERAL(atan_float_1) +
                  z * (GNOMON_LITERAL(atan_float_2) +
                       z * (GNOMON_LITERAL(atan_float_3) + z * GNOMON_LITERAL(atan_float_4))));
    if (GNOMON_DIGITS > 24) {
        p = GNOMON_LITERAL(atan_double_0) +
            z * (GNOMON_LITERAL(atan_double_1) +
                 z * (GNOMON_LITERAL(atan_double_2) +
                      z * (GNOMON_LITERAL(atan_double_3) +
                           z * (GNOMON_LITERAL(atan_double_4) +
                                z * (GNOMON_LITERAL(atan_double_5) +
                                     z * (GNOMON_LITERAL(atan_double_6) +
                                          z * (GNOMON_LITERAL(atan_double_7) +
                                               z * (GNOMON_LITERAL(atan_double_8) +
                                                    z * (GNOMON_LITERAL(atan_double_9) +
                                                         z * GNOMON_LITERAL(atan_double_10))))))))));
    }
    Real angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    Real eighths = gnomon_select(wide, Real(1), Real(0));
    angle = gnomon_select(steep, Real(-1) * angle, angle);
    eighths = gnomon_select(steep, Real(2) - eighths, eighths);
    angle = gnomon_select(x < Real(0), Real(-1) * angle, angle);
    eighths = gnomon_select(x < Real(0), Real(4) - eighths, eighths);
    angle = eighths * Real(0.785398006439208984375) + (angle + eighths * GNOMON_LITERAL(trigonometry_quarter_pi_low));
    return gnomon_select(y < Real(0), Real(-1) * angle, angle);
}

GNOMON_NAMESPACE_END
#endif
