// Single scattering of a directional light in a homogeneous medium along a view ray (Peters et al. 2017, Sec. 5.1.1 and
// 5.3.1):
//
//     radiance = e^(-extinction s) surface + scattering phase irradiance (1 - e^(-extinction s)) / extinction (1 - intensity)
//
// over a distance s, where intensity is the shadow of the ray, weighted by transmittance. extinction and scattering are per
// unit of length, and scattering is the albedo times extinction: the paper's formula has no such factor, its phase function
// holds the scattering coefficient. Light is not attenuated on its way from the light source to the view ray.
//
// omega_l is the direction to the light, omega_p that to the camera. Along a view ray with the polar angle theta
// (rectified.h) omega_l.omega_p = cos theta: 1 looking along the light, -1 looking into it. Phase functions take the cosine
// of the scattering angle, -omega_l.omega_p = -cos theta: light that goes straight on to the camera has 1.
#ifndef GNOMON_SCATTERING_SINGLE_SCATTERING_H
#define GNOMON_SCATTERING_SINGLE_SCATTERING_H
#include "../numerics/exp.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(phase_isotropic, 0.079577471545947668); // 1 / (4 pi), for every angle
GNOMON_CONSTANT(phase_greatest_asymmetry, 0.9990234375);

/// The integral of the transmittance along a ray, (1 - e^(-extinction distance)) / extinction, without cancellation: the
/// length of a ray without extinction that scatters as much. In [0, distance].
/// Domain: both at least 0, also infinite; negative numbers count as 0.
/// NaN: as 0.
/// Error: 4.5 ulp.
GNOMON_KERNEL Real attenuated_length(Real distance_, Real extinction)
{
    Real whole = gnomon_max(distance_, Real(0));
    Real rate = gnomon_max(extinction, Real(0));
    Real depth = gnomon_max(rate * whole, Real(0));
    GNOMON_MASK thin = depth < Real(0.34375);
    Real r = Real(-1) * gnomon_select(thin, depth, Real(0));
    Real thick = (Real(1) - polynomial_exp(Real(-1) * depth)) / gnomon_select(thin, Real(1), rate);
    return gnomon_select(thin, whole * (Real(1) + r * exp_remainder(r)), thick);
}

/// (1 - e^-x) / x, the mean transmittance along a ray of the optical depth x, in [0, 1]; 1 for 0, without cancellation.
/// Domain: x at least 0, also infinite; negative x counts as 0.
/// NaN: 1.
/// Error: 3.5 ulp.
GNOMON_KERNEL Real attenuated_mean(Real x) { return saturate_or_zero(attenuated_length(Real(1), x)); }

/// e^-x, the transmittance of the optical depth x, in [0, 1].
/// Domain: x at least 0, also infinite; negative x counts as 0. Not below e^-87 in float, e^-708 in double.
/// NaN: 1.
/// Error: 1 ulp in float, 1.2 ulp in double.
GNOMON_KERNEL Real transmittance_over(Real x)
{
    return saturate_or_zero(polynomial_exp(Real(-1) * gnomon_max(x, Real(0))));
}

/// The Henyey-Greenstein phase function, per steradian, of the cosine of the scattering angle. asymmetry is its mean
/// cosine: positive for media that scatter forward, 0 for isotropic ones.
/// Domain: cosine in [-1, 1], asymmetry in [-1 + 2^-10, 1 - 2^-10], clamped.
/// NaN: NaN for a cosine of NaN; an asymmetry of NaN counts as 0.
/// Error: relative, 10 2^-p for |asymmetry| <= 1/2.
/// Source: Henyey & Greenstein 1941
GNOMON_KERNEL Real phase_henyey_greenstein(Real cosine, GNOMON_SETTING asymmetry)
{
    Real c = clamp_or_nan(cosine, Real(-1), Real(1));
    Real g = gnomon_min(gnomon_max(gnomon_abs(asymmetry), Real(0)), GNOMON_LITERAL(phase_greatest_asymmetry));
    Real off = Real(1) - gnomon_select(asymmetry < Real(0), Real(-1) * c, c);
    Real rest = Real(1) - g;
    Real d = rest * rest + (g + g) * off;
    return GNOMON_LITERAL(phase_isotropic) * (rest * (Real(1) + g)) / (d * gnomon_sqrt(d));
}

/// The overestimation of visibility for the ray of a polar angle with this cosine, (1 + cosine) / 2, for bounds_intensity.
/// 0 for a ray that looks into the light, in front of which no occluder can be in depth: no light leaks. 1 for a ray along
/// the light, behind which none can be: no light is lost.
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
/// Source: Peters 2017, Sec. 5.3.1
GNOMON_KERNEL Real adaptive_overestimation(Real cosine)
{
    return Real(1) - saturate_or_zero(Real(0.5) - Real(0.5) * cosine);
}

/// The overestimation of visibility that is adaptive_overestimation for rays along the light, and (1 + cosine^5) / 2 for rays
/// towards it. That is close to 1/2, which halves the worst error, but for rays that nearly look into the light. Shown
/// visibility exceeds its lower bound by this share of the weight at the ray: within 5 degrees of looking into the light at
/// most 1% leaks for any occluders. Along the light 1/2 errs more: most of the surfaces that are close to the ray in depth
/// are behind it, where the ray ends (tests/scattering/overestimation.cpp).
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
GNOMON_KERNEL Real plateau_overestimation(Real cosine)
{
    Real c = clamp_or_high(cosine, Real(-1), Real(1));
    Real square = c * c;
    return adaptive_overestimation(gnomon_select(c < Real(0), square * square * c, c));
}

/// Radiance that reaches the camera: that of the surface, attenuated, and light scattered into the view ray. intensity is the
/// shadow of the ray, 0 where all of the ray is lit.
/// Domain: distance, extinction, scattering, phase, irradiance and surface at least 0 and finite.
/// NaN: an intensity of NaN counts as 0.
/// Error: relative, 9 2^-p for optical depths up to 1.
/// Source: Peters 2017, Sec. 5.1.1
GNOMON_KERNEL Real scattering_radiance(Real surface, Real intensity, Real distance_, GNOMON_SETTING extinction,
                                       GNOMON_SETTING scattering, Real phase, GNOMON_SETTING irradiance)
{
    Real depth = extinction * distance_;
    Real lit = (scattering * phase * irradiance) * attenuated_length(distance_, extinction);
    return transmittance_over(depth) * surface + lit * (Real(1) - saturate_or_zero(intensity));
}

GNOMON_NAMESPACE_END
#endif
