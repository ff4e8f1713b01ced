// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// E[z] and E[z^2]: a linear combination of texels is one of these again.
GNOMON_STRUCT(variance_moments) { Real mean, square; };

/// minimum_variance hides the rounding of the stored moments from the inequality: see storage/filters_formats.hpp. At least 0.
GNOMON_STRUCT(variance_settings) { Real minimum_variance; };

/// The texel of a depth z in [-1, 1].
GNOMON_KERNEL GNOMON_T(variance_moments) variance_encode(Real z)
{
    GNOMON_T(variance_moments) r;
    r.mean = z;
    r.square = z * z;
    return r;
}

/// Cantelli's lower bound on the probability of values below the receiver, in [0, 1]; 0 for a receiver at or before the
/// mean, and where anything but minimum_variance is NaN. Error, with the rounding of the moments: r (1 + 4 q + sqrt q),
/// q = (square + receiver^2) / (variance + d^2), r = 4 2^-p.
GNOMON_KERNEL Real cantelli_lower(GNOMON_T(variance_moments) moments, Real receiver, GNOMON_SETTING minimum_variance)
{
    Real variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    Real d = gnomon_max(Real(0), receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding. NaN gives 0, lit.
/// Error: as cantelli_lower.
GNOMON_KERNEL Real variance_intensity(GNOMON_T(variance_moments) filtered, Real z_f,
                                      GNOMON_T(variance_settings) settings)
{
    return cantelli_lower(filtered, z_f, settings.minimum_variance);
}

GNOMON_NAMESPACE_END
#endif
