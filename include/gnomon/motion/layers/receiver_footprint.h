// The time that one sample of a stochastic camera stands for. The camera takes N samples for each pixel, one in each
// stratum of the shutter interval. A look-up at the sample's own time is as noisy as the camera; the mean over the time
// that the sample stands for is not.
//
// During that time the point has to follow its surface (receiver_path.h). Held in place it would leave the surface, which
// then shadows it. With the path of the point and ranges, the mean is known in closed form:
//     exposure = footprint_stratum(t, N);
//     path = receiver_path_clip(path, exposure.begin, exposure.end);
//     moving_receiver_begin(path, exposure.begin, exposure.end), and so on (moving_receiver.h)
// The strata of a pixel's samples fill the shutter interval, so a point that its pixel sees all the time gets the mean
// over the whole interval, without noise and without bias.
#ifndef GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H
#define GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H
#include "../receiver/receiver_path.h"
#include "../receiver/shutter.h"
#include "stochastic_sample.h"
GNOMON_NAMESPACE_BEGIN

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
GNOMON_KERNEL GNOMON_T(shutter_exposure) footprint_stratum(Real t, Real count)
{
    Real slice = slice_of(t, count);
    GNOMON_T(shutter_exposure) r;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + Real(1)) / count);
    return r;
}

GNOMON_NAMESPACE_END
#endif
