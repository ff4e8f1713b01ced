// Time-dependent shadow maps (Akenine-Moller, Munkberg & Hasselgren 2007): the shutter interval is cut into slices, and
// each slice has a shadow map whose texels have one sample each, at a time of their own within the slice. A receiver
// that is seen at time t_r reads the slice of that time, but the sample's time t is another one. In between, the surface
// that the sample shows has moved, and would shadow itself (Andersson et al. 2015, Figure 10).
//
//     sample.travel = time_dependent_travel(d_x, d_y);                         when the map is made
//     state = percentage_closer_begin(z_f - constant_bias);                    filters/percentage_closer.h
//     for the texel of the receiver, or for 2 x 2 texels by bilinear weights, in slice slice_of(t_r, slices):
//         state = percentage_closer_add(state, z, weight), where z is one of
//             sample.z                                                         constant bias alone
//             time_dependent_depth(sample, t_r)                                moved along with its surface in depth
//             time_dependent_biased_depth(sample, t_r, slope, texels)          and biased by the surface's slope
//     intensity = percentage_closer_end(state);
//
// Motion in depth is not enough for a tilted surface: in the time between, the sample moves across the map, too, and at its
// new place the surface has another depth. The third depth adds the most by which these differ.
#ifndef GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H
#define GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H
#include "../../filters/percentage_closer.h"
GNOMON_NAMESPACE_BEGIN

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
GNOMON_STRUCT(time_dependent_sample) { Real z, t, d_z, travel; };

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
GNOMON_KERNEL Real time_dependent_travel(Real d_x, Real d_y) { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
GNOMON_KERNEL Real time_dependent_depth(GNOMON_T(time_dependent_sample) s, Real t_r)
{
    return s.z + s.d_z * (t_r - s.t);
}

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself; the
/// factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
GNOMON_KERNEL Real time_dependent_biased_depth(GNOMON_T(time_dependent_sample) s, Real t_r, Real slope,
                                               GNOMON_SETTING texels)
{
    Real passed = gnomon_abs(t_r - s.t);
    Real reach = texels + Real(1.5) * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(Real(0), slope) * reach;
}

GNOMON_NAMESPACE_END
#endif
