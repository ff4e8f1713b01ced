// From bounds on a depth distribution to the shadow intensity that is shown.
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest that z_f itself can have. All in [0, 1]; all 0 where a moment or the receiver was NaN.
GNOMON_STRUCT(hamburger_bounds) { Real lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight (Peters et al. 2017, 5.3.1: overestimation beta multiplies
/// visibility). 1 never darkens a lit surface, 1/2 halves the worst error, as for single scattering. Domain [0, 1],
/// clamped; NaN counts as 0.
GNOMON_KERNEL Real bounds_intensity(GNOMON_T(hamburger_bounds) bounds, GNOMON_SETTING overestimation)
{
    return saturate_or_zero(bounds.lower + (Real(1) - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkening: intensity / strength, at most 1, which removes leaks below 1 - strength (Annen et al. 2007;
/// paper, 2.6: 0.98). Domain (0, 1]; elsewhere the intensity is still in [0, 1].
GNOMON_KERNEL Real over_darken(Real intensity, GNOMON_SETTING strength)
{
    return saturate_or_zero(intensity / strength);
}

GNOMON_NAMESPACE_END
#endif
