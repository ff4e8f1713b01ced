// Single scattering by a grid of froxels (Wronski 2014), which most engines use: cells of the view frustum, few columns of
// pixels wide, in slices whose thickness grows with the distance. Each froxel looks up the shadow map once; slice by slice
// the intensities are averaged from the camera on, and each pixel interpolates between averages.
//
//     slices = froxel_slices_from(nearest, farthest, count);
//     (slice k = 0)   sum = transmittance_share_begin(froxel_weight(extinction, 0, froxel_distance(0, slices)));
//     (slice k > 0)   sum = transmittance_share_add(sum, froxel_weight(extinction, froxel_distance(k - 1, slices),
//                                                                      froxel_distance(k, slices)));
//                     mean = mean + sum.share (intensity of the froxel - mean)
//     (for a pixel)   mean at slice froxel_slice_of(distance, slices), interpolated between slices and columns
//
// Distances are from the camera, so that slices are spheres, and the weights of a slice are those of all its froxels. Slice 0
// reaches from the camera to the nearest distance. passes/froxels.hpp does the same over a whole grid.
#ifndef GNOMON_COMPARATORS_FROXELS_H
#define GNOMON_COMPARATORS_FROXELS_H
#include "../scattering/single_scattering.h"
#include "../scattering/transmittance_weights.h"
GNOMON_NAMESPACE_BEGIN

/// The end of slice 0, the logarithm of the quotient of the ends of neighbouring slices, and the last slice.
GNOMON_STRUCT(froxel_slices) { Real nearest, growth, last; };

/// Slices of which the first ends at nearest and the last at farthest.
/// Domain: nearest and farthest in [2^-60, 2^60] with nearest <= farthest, and 2 to 65536 slices; others are limited to that.
/// NaN: the upper limit.
/// Source: Wronski 2014
GNOMON_KERNEL GNOMON_T(froxel_slices) froxel_slices_from(Real nearest, Real farthest, Real count)
{
    GNOMON_T(froxel_slices) r;
    Real least = gnomon_power_of_two(Real(-60));
    Real most = gnomon_power_of_two(Real(60));
    r.nearest = clamp_or_high(nearest, least, most);
    r.last = clamp_or_high(count, Real(2), Real(65536)) - Real(1);
    Real quotient = clamp_or_high(farthest, r.nearest, most) / r.nearest;
    r.growth = polynomial_log(quotient) / r.last;
    return r;
}

/// The distance at which slice k ends.
/// Domain: k limited to the slices.
/// NaN: the end of the last slice.
/// Error: relative, 2^(7 - p).
GNOMON_KERNEL Real froxel_distance(Real k, GNOMON_T(froxel_slices) slices)
{
    return slices.nearest * polynomial_exp(clamp_or_high(k, Real(0), slices.last) * slices.growth);
}

/// The slice that ends at this distance, with a fraction between two ends.
/// Domain: any distance, limited to the ends of the first and of the last slice.
/// NaN: the last slice.
/// Error: 2^(7 - p) of the last slice.
GNOMON_KERNEL Real froxel_slice_of(Real distance_, GNOMON_T(froxel_slices) slices)
{
    Real slice = polynomial_log(distance_ / slices.nearest) / slices.growth;
    return clamp_or_high(slice, Real(0), slices.last);
}

/// Light scattered to the camera between two distances, relative to that of clear air of unit length: the weight of a
/// froxel's intensity in its column.
/// Domain: extinction and distances at least 0, nearer <= farther.
/// NaN: 0 for a distance; an extinction of NaN counts as 0.
/// Error: relative, 8 2^-p for optical depths up to 1.
/// Source: Hillaire 2015
GNOMON_KERNEL Real froxel_weight(GNOMON_SETTING extinction, Real nearer, Real farther)
{
    return transmittance_over(extinction * nearer) * attenuated_length(farther - nearer, extinction);
}

GNOMON_NAMESPACE_END
#endif
