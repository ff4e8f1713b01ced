// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).
#ifndef GNOMON_FILTERS_EXPONENTIAL_H
#define GNOMON_FILTERS_EXPONENTIAL_H
#include "../numerics/exp.h"
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// E[exp(c z)].
GNOMON_STRUCT(exponential_moment) { Real warped; };

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
GNOMON_STRUCT(exponential_settings) { Real exponent; };

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
GNOMON_KERNEL GNOMON_T(exponential_moment) exponential_encode(Real z, GNOMON_T(exponential_settings) settings)
{
    GNOMON_T(exponential_moment) r;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, Real(-1), Real(1)));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in float
/// shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
GNOMON_KERNEL Real exponential_intensity(GNOMON_T(exponential_moment) filtered, Real z_f,
                                         GNOMON_T(exponential_settings) settings)
{
    return saturate_or_zero(Real(1) - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(Real(1), z_f)));
}

GNOMON_NAMESPACE_END
#endif
