// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
GNOMON_STRUCT(variance_moments) { Real mean, square; };

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
GNOMON_STRUCT(variance_settings) { Real minimum_variance; };

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
GNOMON_KERNEL GNOMON_T(variance_moments) variance_encode(Real z)
{
    GNOMON_T(variance_moments) r;
    r.mean = clamp_or_high(z, Real(-1), Real(1));
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
GNOMON_KERNEL Real cantelli_lower(GNOMON_T(variance_moments) moments, Real receiver, GNOMON_SETTING minimum_variance)
{
    Real variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    Real d = gnomon_max(Real(0), receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
GNOMON_KERNEL Real variance_intensity(GNOMON_T(variance_moments) filtered, Real z_f,
                                      GNOMON_T(variance_settings) settings)
{
    return cantelli_lower(filtered, gnomon_min(Real(1), z_f), settings.minimum_variance);
}

GNOMON_NAMESPACE_END
#endif
