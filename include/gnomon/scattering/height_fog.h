// Height fog: a medium whose density falls exponentially with height, seen along a view ray. The paper covers homogeneous
// media only (scattering/single_scattering.h). Along a ray that rises by rise for each unit of length, a density
// e^(-falloff height) is e^(-decay t) at the distance t, relative to the density at the eye, with decay = falloff rise. A ray
// that descends has a negative decay. Up to a distance s the ray crosses as much of the medium as in a homogeneous medium of
// the density at the eye over the length
//
//     amount(s) = (1 - e^(-decay s)) / decay
//
// so scattering_radiance serves with amount(s) for the distance, and with extinction and scattering at the eye.
//
// The map of prefix averages has the same layout and other weights: a texel that the ray crosses from s to t scatters
//     e^(-extinction amount(s)) (1 - e^(-extinction (amount(t) - amount(s)))) / extinction
// and transmittance_share_add sums these weights.
//
// A row has one set of weights, those of the ray in the middle of its range, and serves rays of other polar angles, too. In a
// homogeneous medium these rays cross the texels in other steps. In fog they also cross a texel at another height, unless the
// light is horizontal and light rays keep their height: the higher the light, the greater the error. scattering_radiance has
// no such error, since its distance is that of the ray itself. Attenuation on the way from the light to the view ray is not
// covered.
#ifndef GNOMON_SCATTERING_HEIGHT_FOG_H
#define GNOMON_SCATTERING_HEIGHT_FOG_H
#include "single_scattering.h"
GNOMON_NAMESPACE_BEGIN

/// The amount of medium along a ray between two distances from the eye: the length of a homogeneous medium of the density
/// at the eye that holds as much.
/// At least 0, never NaN.
/// Domain: 0 <= first <= last, any decay; decay times either distance is clamped to [-88, 87] in float, [-709, 708] in double.
/// NaN: 0 for a distance of NaN; a decay of NaN counts as 0.
/// Error: relative, (8 + 2 decay last) 2^-p, by the magnitude of decay.
GNOMON_KERNEL Real height_fog_amount(Real first, Real last, GNOMON_SETTING decay)
{
    // From the denser of the two ends on, the medium is attenuated as light is.
    Real densest = gnomon_select(decay < Real(0), last, first);
    Real thinner = decay * densest;
    return polynomial_exp(Real(-1) * gnomon_select(thinner == thinner, thinner, Real(0))) *
           attenuated_length(last - first, gnomon_abs(decay));
}

/// The weight of a texel that a ray crosses between two distances from the eye: the light scattered there and transmitted to
/// the eye, as the length over which a medium of the density at the eye would scatter as much without extinction. In
/// [0, amount] up to the error. extinction is that at the eye.
/// Domain: as for height_fog_amount; extinction at least 0.
/// NaN: 0 for a distance of NaN; a decay or an extinction of NaN counts as 0.
/// Error: relative, (1 + optical depth) (16 + 4 decay last) 2^-p, by the magnitude of decay.
GNOMON_KERNEL Real height_fog_weight(Real first, Real last, GNOMON_SETTING decay, GNOMON_SETTING extinction)
{
    Real before = transmittance_over(extinction * height_fog_amount(Real(0), first, decay));
    return before * attenuated_length(height_fog_amount(first, last, decay), extinction);
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that ends at before +
/// f length, as transmittance_weight_between in a homogeneous medium. In [0, 1].
/// Domain: before and length at least 0; f in [0, 1], clamped; decay and extinction as for height_fog_weight.
/// NaN: 0, also where before and f are 0, or extinction is infinite.
/// Error: (64 + 16 (1 + optical depth) decay (before + length)) 2^-p, by the magnitude of decay.
GNOMON_KERNEL Real height_fog_weight_between(Real before, Real length_, Real f, GNOMON_SETTING decay,
                                             GNOMON_SETTING extinction)
{
    Real none = Real(0);
    Real part = saturate_or_zero(f) * length_;
    Real falls = decay * before;
    Real density = polynomial_exp(Real(-1) * gnomon_select(falls == falls, falls, none));
    Real above = attenuated_length(density * height_fog_amount(none, part, decay), extinction) *
                 attenuated_length(height_fog_amount(none, before + length_, decay), extinction);
    Real below = attenuated_length(height_fog_amount(none, before + part, decay), extinction) *
                 attenuated_length(density * height_fog_amount(none, length_, decay), extinction);
    return saturate_or_zero(above / below);
}

GNOMON_NAMESPACE_END
#endif
