// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.
#ifndef GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H
#define GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H
#include "../numerics/exp.h"
#include "variance.h"
GNOMON_NAMESPACE_BEGIN

/// First and second moment of either warped depth.
GNOMON_STRUCT(exponential_variance_moments) { Real positive, positive_square, negative, negative_square; };

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
GNOMON_STRUCT(exponential_variance_settings) { Real positive_exponent, negative_exponent, minimum_variance; };

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
GNOMON_DETAIL_KERNEL GNOMON_T(exponential_variance_moments) exponential_variance_warp(
    Real z, GNOMON_T(exponential_variance_settings) settings)
{
    GNOMON_T(exponential_variance_moments) r;
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
GNOMON_KERNEL GNOMON_T(exponential_variance_moments) exponential_variance_encode(
    Real z, GNOMON_T(exponential_variance_settings) settings)
{
    return exponential_variance_warp(clamp_or_high(z, Real(-1), Real(1)), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
GNOMON_KERNEL Real exponential_variance_side(GNOMON_T(variance_moments) moments, Real warped, Real exponent,
                                             Real minimum_variance)
{
    Real scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < Real(1),
                               Real(1125899906842624.0), Real(1));
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    Real slope = exponent * (warped * scale);
    return cantelli_lower(moments, warped * scale, minimum_variance * (slope * slope));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f, limited to [-1, 1]; exponents of at least 0, minimum_variance as of cantelli_lower. An exponent of 0, or
/// one so large that squares overflow, takes the bound of its own warp away. A negative one turns the order of depths around.
/// NaN: a NaN receiver gives 0, lit; a NaN moment or exponent takes the bound of its own warp away, which leaves the other's.
/// Error: that of cantelli_lower for the warped depths, with r = (2 c + 8) 2^-p, the larger of both.
/// Source: Lauritzen & McCool 2008; Peters 2017, Sec. 2.2
GNOMON_KERNEL Real exponential_variance_intensity(GNOMON_T(exponential_variance_moments) filtered, Real z_f,
                                                  GNOMON_T(exponential_variance_settings) settings)
{
    GNOMON_T(variance_moments) positive;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    GNOMON_T(variance_moments) negative;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    exponential_variance_moments receiver = exponential_variance_warp(clamp_or_nan(z_f, Real(-1), Real(1)), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
}

GNOMON_NAMESPACE_END
#endif
