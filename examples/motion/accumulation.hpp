// What motion blur is made of without ranges: a shadow map and a picture for each of some times, and their mean
// (Haeberli & Akeley 1990).
#pragma once

#include <cstddef>
#include <vector>

#include "toolbox/image.hpp"
#include "toolbox/moving_view.hpp"

namespace gnomon::demo {

// Shadow maps in the middle of as many equal parts of the shutter interval.
struct accumulated_maps {
    int resolution = 0;
    std::vector<toolbox::image<std::array<float, 1>>> depths;

    float time(std::size_t i) const { return (float(i) + 0.5f) / float(depths.size()); }
};

accumulated_maps accumulate(const toolbox::moving_scene& world, const toolbox::moving_camera& light, int resolution,
                            int count);

// What each pixel sees at these times, as courses of one time, in order.
toolbox::seen_motion seen_at_times(const toolbox::seen_motion& seen, const accumulated_maps& maps);

// The visibility of each of these courses, by 2 x 2 percentage-closer filtering with bilinear weights.
std::vector<float> accumulated_visibility(const toolbox::seen_motion& at_times, const toolbox::moving_camera& light,
                                          const accumulated_maps& maps);

} // namespace gnomon::demo
