// Receivers that a camera sees, in the light's shadow map: the path of each point over the map, and the times at
// which it faces the light.
#pragma once

#include "renderer/shade/moving_view.hpp"

#include <gnomon/motion/receiver/facing.h>
#include <gnomon/motion/receiver/moving_receiver.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// `facing` has times of the path itself, from 0 to 1. The depths of the path are biased. The cosines are those between
// the normal and the direction to the light at the ends of the path, negative where it faces away.
struct light_receiver {
    receiver_path<float> path;
    edge_intervals<float> facing;
    float cosine_open = 1, cosine_close = 1;
};

// Texels around a point that the depth bias spares from shadowing themselves: bilinear filtering reads up to one to
// either side.
inline constexpr double motion_bias_radius = 1.5;

// The receiver of each path, with a bias for so many texels around its point.
std::vector<light_receiver> light_receivers_of(const renderer::seen_motion& seen, const renderer::moving_camera& light,
                                               int resolution, double radius = motion_bias_radius);

// Replaces the triangles' ids.
void set_ids(std::span<light_receiver> receivers, std::span<const std::uint32_t> id_of_triangle);

// Calls tap(column, row, weight) for the four texels around a place.
template <class Tap> void for_each_tap(const texel_position<float>& at, const Tap& tap)
{
    const float column = texel_below(at.x - 0.5f), row = texel_below(at.y - 0.5f);
    const float u = at.x - 0.5f - column, v = at.y - 0.5f - row;
    for (const float j : {0.f, 1.f})
        for (const float i : {0.f, 1.f}) tap(column + i, row + j, texel_weight(u, i, 1.f) * texel_weight(v, j, 1.f));
}

} // namespace gnomon::evaluation
