// Single scattering by ray marching through a shadow map (Toth & Umenhoffer 2009), with which prefiltered single scattering
// (Peters et al. 2017, Sec. 5) is compared: the view ray is cut into steps of equal length, and each step looks up the map once.
//
//     march = ray_march_begin(transmittance);                   of one step, exp(-sigma_t Delta)
//     march = ray_march_add(march, z, z_f);                     for every step, from the camera on
//     intensity = ray_march_end(march);
//
// Step k is looked up at (k + jitter) Delta, where z is the depth of the map there and z_f that of the ray. A jitter that
// differs between neighbouring pixels makes noise of what would be bands: ray_march_jitter.
//
// Light scattered in step k is proportional to what the air transmits on the way from its begin, and a factor that all steps
// share cancels in the mean. So the weights are exact, for any extinction; the sample within a step is not.
#ifndef GNOMON_COMPARATORS_RAY_MARCH_H
#define GNOMON_COMPARATORS_RAY_MARCH_H
#include "../numerics/round.h"
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// The weight in shadow so far, that of all steps so far, the transmittance up to the next step, and that of one step.
GNOMON_STRUCT(ray_march) { Real shadowed, weight, transmittance, step; };

/// The state before the first step.
/// Domain: any transmittance of one step, limited to [0, 1].
/// NaN: 1, clear air.
GNOMON_KERNEL GNOMON_T(ray_march) ray_march_begin(Real step_transmittance)
{
    GNOMON_T(ray_march) r;
    r.shadowed = Real(0);
    r.weight = Real(0);
    r.transmittance = Real(1);
    r.step = clamp_or_high(step_transmittance, Real(0), Real(1));
    return r;
}

/// The state after one more step, at depth z_f, where the shadow map has depth z.
/// Domain: any depths.
/// NaN: lit, for either.
GNOMON_KERNEL GNOMON_T(ray_march) ray_march_add(GNOMON_T(ray_march) state, Real z, Real z_f)
{
    state.shadowed = state.shadowed + gnomon_select(z < z_f, state.transmittance, Real(0));
    state.weight = state.weight + state.transmittance;
    state.transmittance = state.transmittance * state.step;
    return state;
}

/// Shadow intensity of the ray in [0, 1]: the part of the light scattered towards the camera that the shadow takes away.
/// NaN: 0, lit; so before the first step.
/// Error: of n steps, 3 n 2^-p, for sums in the precision of p bits.
/// Source: Peters 2017, Sec. 5.5.1; Toth & Umenhoffer 2009
GNOMON_KERNEL Real ray_march_end(GNOMON_T(ray_march) state) { return saturate_or_zero(state.shadowed / state.weight); }

GNOMON_CONSTANT(ray_march_jitter_x, 0.06711056);
GNOMON_CONSTANT(ray_march_jitter_y, 0.00583715);
GNOMON_CONSTANT(ray_march_jitter_scale, 52.9829189);

/// x - floor(x), in [0, 1).
/// Domain: |x| <= 2^21.
GNOMON_DETAIL_KERNEL Real ray_march_fraction(Real x)
{
    Real fraction = x - nearest_integer(x - Real(0.5));
    return gnomon_select(Real(0) <= fraction && fraction < Real(1), fraction, Real(0)); // also where nothing is rounded
}

/// A number in [0, 1) for the pixel at column x and row y: interleaved gradient noise, of which the values of 3 x 3 pixels
/// lie evenly in [0, 1), so that a small blur removes what it leaves.
/// Domain: whole numbers, limited to [0, 65536].
/// NaN: that of column or row 65536.
/// Source: Jimenez 2014
GNOMON_KERNEL Real ray_march_jitter(Real x, Real y)
{
    Real column = clamp_or_high(x, Real(0), Real(65536));
    Real row = clamp_or_high(y, Real(0), Real(65536));
    Real inner =
        ray_march_fraction(GNOMON_LITERAL(ray_march_jitter_x) * column + GNOMON_LITERAL(ray_march_jitter_y) * row);
    return ray_march_fraction(GNOMON_LITERAL(ray_march_jitter_scale) * inner);
}

GNOMON_NAMESPACE_END
#endif
