// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
GNOMON_STRUCT(hamburger_bounds) { Real lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
GNOMON_KERNEL Real bounds_intensity(GNOMON_T(hamburger_bounds) bounds, GNOMON_SETTING overestimation)
{
    return saturate_or_zero(bounds.lower + (Real(1) - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows are
/// lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
GNOMON_KERNEL Real over_darken(Real intensity, GNOMON_SETTING strength)
{
    return saturate_or_zero(intensity / strength);
}

GNOMON_NAMESPACE_END
#endif
