// Absorbance moments: translucent occluders without an order (Munstermann 2018; Sharpe 2018), which Peters et al.
// (2017, Sec. 3.1) leave out. The logarithm turns the product of transmittances into a sum,
//     transmittance before z = prod of (1 - alpha_k) over z_k < z = exp(-sum of a_k over z_k < z),    a_k = -ln(1 - alpha_k)
// so fragments are added, in any order, as their absorbance times the powers of their depth: b_j = sum_k a_k z_k^j, with b_0
// kept. b_j / b_0 are moments of a depth distribution Z, and exp(-b_0 Z(z < z_f)) is the transmittance.
//
//     map            b = absorbance4_add(b, absorbance4_of_fragment(z, alpha)) from zeros, by additive blending
//     receiver       absorbance4_transmittance(b, ...) and transmitted_intensity with the shadow of the opaque occluders
//
// Opaque occluders are in a map of their own: their absorbance is infinite, and filtered with that of others it would
// shadow all of the filter region. For the same reason a filter over absorbances is darker than the mean transmittance,
// exp(-mean a) <= mean exp(-a), and near it only where absorbance varies little in the filter region. Fragments behind an
// opaque occluder are added, too: then both maps are independent, and their transmittances multiply.
#ifndef GNOMON_MOMENTS_ABSORBANCE_H
#define GNOMON_MOMENTS_ABSORBANCE_H
#include "../numerics/exp.h"
#include "bias.h"
#include "hamburger4.h"
#include "translucency.h"
GNOMON_NAMESPACE_BEGIN

/// Sums of absorbance times powers of depth, b0 to b4.
GNOMON_STRUCT(absorbance4) { Real b0, b1, b2, b3, b4; };

GNOMON_CONSTANT(absorbance_most, 16.0);

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
GNOMON_KERNEL Real absorbance_of_opacity(Real alpha)
{
    Real absorbed = Real(-1) * polynomial_log(Real(1) - saturate_or_zero(alpha));
    return gnomon_min(absorbed, GNOMON_LITERAL(absorbance_most));
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
GNOMON_KERNEL GNOMON_T(absorbance4) absorbance4_of_fragment(Real z, Real alpha)
{
    Real a = absorbance_of_opacity(alpha);
    moments4 m = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    GNOMON_T(absorbance4) b;
    b.b0 = a;
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of fragments together.
GNOMON_KERNEL GNOMON_T(absorbance4) absorbance4_add(GNOMON_T(absorbance4) sum, GNOMON_T(absorbance4) b)
{
    sum.b0 = sum.b0 + b.b0;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

GNOMON_CONSTANT(absorbance_least, 7.62939453125e-6); // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are meant
/// in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
GNOMON_KERNEL GNOMON_T(hankel4) absorbance4_factor(GNOMON_T(absorbance4) b, GNOMON_SETTING alpha)
{
    Real scale = Real(1) / gnomon_max(GNOMON_LITERAL(absorbance_least), b.b0);
    GNOMON_T(moments4) m;
    m.b1 = b.b1 * scale;
    m.b2 = b.b2 * scale;
    m.b3 = b.b3 * scale;
    m.b4 = b.b4 * scale;
    return hankel4_constant_bias(m, GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4), alpha);
}

GNOMON_CONSTANT(absorbance_scale, 5.421010862427522170037e-20); // 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
GNOMON_KERNEL Real absorbance_transmittance(Real b0, Real intensity)
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    Real absorbed = saturate_or_zero(b0 * GNOMON_LITERAL(absorbance_scale)) * Real(18446744073709551616.0);
    Real t = polynomial_exp(Real(-1) * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, Real(1));
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
GNOMON_DETAIL_KERNEL Real absorbance4_intensity(GNOMON_T(hankel4) h, GNOMON_SETTING alpha,
                                                GNOMON_SETTING overestimation, Real z_f)
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (Real(1) - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1], clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
GNOMON_KERNEL Real absorbance4_transmittance(GNOMON_T(absorbance4) b, GNOMON_SETTING alpha,
                                             GNOMON_SETTING overestimation, Real z_f)
{
    return absorbance_transmittance(b.b0,
                                    absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation, z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
GNOMON_KERNEL Real transmitted_intensity(Real opaque, Real transmittance)
{
    Real absorbed = saturate_or_zero(Real(1) - transmittance);
    Real o = saturate_or_zero(opaque);
    return o + (Real(1) - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of the
/// three as absorbance.
GNOMON_STRUCT(coloured_absorbance4) { Real red, green, blue, b1, b2, b3, b4; };

/// Transmittances, each in [0, 1].
GNOMON_STRUCT(coloured_transmittance) { Real red, green, blue; };

GNOMON_CONSTANT(absorbance_third, 0.33333333333333331);

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
GNOMON_KERNEL GNOMON_T(coloured_absorbance4) coloured_absorbance4_of_fragment(Real z, Real red, Real green, Real blue)
{
    GNOMON_T(coloured_absorbance4) b;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    Real a = GNOMON_LITERAL(absorbance_third) * (b.red + (b.green + b.blue));
    moments4 m = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
GNOMON_KERNEL GNOMON_T(coloured_absorbance4) coloured_absorbance4_add(GNOMON_T(coloured_absorbance4) sum,
                                                                      GNOMON_T(coloured_absorbance4) b)
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
GNOMON_KERNEL GNOMON_T(coloured_transmittance) coloured_absorbance4_transmittance(GNOMON_T(coloured_absorbance4) b,
                                                                                  GNOMON_SETTING alpha,
                                                                                  GNOMON_SETTING overestimation,
                                                                                  Real z_f)
{
    GNOMON_T(absorbance4) shared_depths;
    shared_depths.b0 = GNOMON_LITERAL(absorbance_third) * (b.red + (b.green + b.blue));
    shared_depths.b1 = b.b1;
    shared_depths.b2 = b.b2;
    shared_depths.b3 = b.b3;
    shared_depths.b4 = b.b4;
    Real intensity = absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation, z_f);
    GNOMON_T(coloured_transmittance) t;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
}

GNOMON_NAMESPACE_END
#endif
