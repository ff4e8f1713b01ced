// Weights of prefix averages along the rows of a rectified map (Peters et al. 2017, Sec. 5.1.1). Texel u has the weight w_u,
// and the average up to texel u is the one before, moved towards texel u by its share of the sum of weights:
//
//     mean_u = mean_(u - 1) + g_u (texel_u - mean_(u - 1)),        g_u = w_u / (w_0 + ... + w_u),        g_0 = 1
//
// All g_u are in [0, 1], so that prefix averages of moments are moments. In a homogeneous medium texel u is seen through
// u texels of the medium: w_u = q^u up to a factor that cancels, so that
//
//     g_u = q g_(u - 1) / (1 + q g_(u - 1)),        q = transmittance of one texel
//
// holds for every extinction: q = 1 without any, q = 0 in an opaque medium. Weights that vary from texel to texel, as those of
// scattering/height_fog.h, are summed by transmittance_share_add.
//
//     (for a row)   q = transmittance_step(extinction, radius_step, mean sine of the row's polar angles)
//     (for u > 0)   g = transmittance_weight_next(g, q);   mean = mean + g (texel - mean)
//
// A ray that ends within texel u, a share f of it, has an average between that of texel u - 1 and that of texel u, but not at f:
// transmittance_weight_within is exact. transmittance_weight_between is exact between averages over any two distances, as in mips.
#ifndef GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H
#define GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H
#include "single_scattering.h"
GNOMON_NAMESPACE_BEGIN

/// The transmittance of the medium from one texel of a row to the next, in [0, 1]. extinction is per unit of length; the
/// view ray crosses the texels of radius_step at an angle to the light that has this sine.
/// Domain: at least 0, also infinite; negative numbers count as 0.
/// NaN: 1, also where an extinction of 0 meets a sine of 0.
/// Error: relative, 2.5 2^-p for each unit of the optical depth extinction radius_step / sine, and 2 2^-p.
/// Source: Peters 2017, Sec. 5.1.1
GNOMON_KERNEL Real transmittance_step(GNOMON_SETTING extinction, Real radius_step, Real sine)
{
    return transmittance_over((extinction * radius_step) / sine);
}

/// The share g_u of texel u in its prefix average, from the share g of the texel before and the ratio of their weights, q.
/// In [0, 1].
/// Domain: g and q in [0, 1], clamped.
/// NaN: 0.
/// Error: relative, 3 2^-p beside those of g and q; 256 2^-p after 1024 texels.
GNOMON_KERNEL Real transmittance_weight_next(Real g, Real q)
{
    Real next = saturate_or_zero(q) * saturate_or_zero(g);
    return next / (Real(1) + next);
}

/// The share of the way from the average before a texel to the one up to it, for a ray that ends a share f within the texel:
/// v / (1 - g + g v), v = (1 - q^f) / (1 - q), where g is the share of the texel. In [0, 1].
/// Domain: g, q and f in [0, 1], clamped.
/// NaN: as 0 for g and f, as 1 for q.
/// Error: 8 2^-p.
GNOMON_KERNEL Real transmittance_weight_within(Real g, Real q, Real f)
{
    Real share = saturate_or_zero(f);
    Real depth = Real(-1) * polynomial_log(gnomon_min(q, Real(1)));
    Real v = gnomon_min(Real(1), share * attenuated_mean(share * depth) / attenuated_mean(depth));
    Real last = saturate_or_zero(g);
    Real rest = (Real(1) - last) + last * v;
    return gnomon_select(Real(0) < rest, saturate_or_zero(v / rest), Real(1));
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that ends at before +
/// f length: exact where light and shadow do not change along the length. Distances are in texels of that optical depth. For
/// one texel this is transmittance_weight_within without the shares of the texels before. In [0, 1].
/// Domain: before, length and optical_depth at least 0, the last also infinite; f in [0, 1], clamped.
/// NaN: 0, also where before and f are 0, or optical_depth is infinite.
/// Error: 24 2^-p.
GNOMON_KERNEL Real transmittance_weight_between(Real before, Real length_, Real f, Real optical_depth)
{
    Real part = saturate_or_zero(f) * length_;
    Real above = attenuated_length(part, optical_depth) * attenuated_length(before + length_, optical_depth);
    Real below = attenuated_length(before + part, optical_depth) * attenuated_length(length_, optical_depth);
    return saturate_or_zero(above / below);
}

/// A sum of weights, and the share in it of the weight that was added last.
GNOMON_STRUCT(transmittance_share) { Real total, share; };

/// The state after the first texel of a row, whose share is 1.
/// Domain: a weight of at least 0; negative weights count as 0.
/// NaN: a weight of 0.
GNOMON_KERNEL GNOMON_T(transmittance_share) transmittance_share_begin(Real weight)
{
    GNOMON_T(transmittance_share) r;
    r.total = gnomon_max(weight, Real(0));
    r.share = Real(1);
    return r;
}

/// The state after one more texel with a weight. Its share, in [0, 1], is 1 while all weights are 0.
/// Domain: as for transmittance_share_begin. While the sum is not finite the share is 0.
/// NaN: a weight of 0.
/// Error: relative, one rounding for each texel.
GNOMON_KERNEL GNOMON_T(transmittance_share) transmittance_share_add(GNOMON_T(transmittance_share) state, Real weight)
{
    Real added = gnomon_max(weight, Real(0));
    GNOMON_T(transmittance_share) r;
    r.total = state.total + added;
    r.share = saturate_or_zero(added / r.total);
    r.share = gnomon_select(r.total == Real(0), Real(1), r.share);
    return r;
}

GNOMON_NAMESPACE_END
#endif
