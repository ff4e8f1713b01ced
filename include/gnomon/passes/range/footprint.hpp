// Shadow intensity over the footprint in time of a camera sample (motion/layers/receiver_footprint.h), in closed form
// from a map of resolved ranges.
#ifndef GNOMON_PASSES_RANGE_FOOTPRINT_HPP
#define GNOMON_PASSES_RANGE_FOOTPRINT_HPP

#include "../../motion/layers/receiver_footprint.h"
#include "look_up.hpp"

GNOMON_NAMESPACE_BEGIN

/// Shadow intensity in [0, 1] of a receiver on a path, the mean over the exposure, of K x K bilinear look-ups, K =
/// look_ups. The path may be longer than the exposure; while an exposure lasts longer than its path, nothing is in shadow.
/// NaN: 0, lit.
/// Error: that of moving_receiver_end.
template <class Map, class T>
T footprint_intensity(const Map& map, const receiver_path<T>& path, const shutter_exposure<T>& exposure,
                      int look_ups = 1)
{
    const shutter_exposure<T> open = shutter_exposure_make(exposure.begin, exposure.end);
    const bool stays = path.x0 == path.x1 && path.y0 == path.y1 && path.w0 == path.w1 && path.depth.z0 == path.depth.z1;
    const bool lasts = path.depth.t0 <= gnomon_min(exposure.begin, exposure.end) &&
                       gnomon_max(exposure.begin, exposure.end) <= path.depth.t1;
    if (stays && lasts && path.w0 > 0)
        return static_intensity(map, path.x0 / path.w0, path.y0 / path.w0,
                                static_receiver_begin(path.depth.z0, path.depth.id, open.begin, open.end), look_ups);
    return moving_intensity(map, receiver_path_clip(path, open.begin, open.end), open.begin, open.end, look_ups);
}

GNOMON_NAMESPACE_END
#endif
