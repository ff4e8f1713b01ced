// What a camera sees of motion, as the light's shadow map sees it: for each course the way of its point over the map,
// and when it faces the light.
#pragma once

#include <gnomon/motion/facing.h>
#include <gnomon/motion/receiver_path.h>

#include <vector>

#include "toolbox/moving_view.hpp"

namespace gnomon::demo {

// Times of the course itself, from 0 to 1, at which it faces the light; the depths of the path are biased.
struct light_receiver {
    receiver_path<float> path;
    edge_times<float> facing;
};

// Texels around a point that the depth bias spares from shadowing themselves: bilinear filtering reads up to one to
// either side.
inline constexpr double motion_bias_radius = 1.5;

// One for each course.
std::vector<light_receiver> light_receivers_of(const toolbox::seen_motion& seen, const toolbox::moving_camera& light,
                                               int resolution);

} // namespace gnomon::demo
