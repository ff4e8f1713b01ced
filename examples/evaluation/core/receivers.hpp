// Receivers as a method's look-up knows them.
#pragma once

#include "renderer/shade/receivers.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

// All that a look-up may use: texture coordinates in [0, 1], the level of detail, signed depth, and how depth changes
// with u and v on the receiver's plane.
struct map_receiver {
    float u = 0, v = 0, level = 0;
    float depth = 0;
    float depth_per_u = 0, depth_per_v = 0;
};

struct map_receivers {
    std::vector<std::size_t> pixels; // indices into the picture
    std::vector<map_receiver> biased, unbiased;

    std::size_t size() const { return pixels.size(); }
};

// Change of signed depth with u and with v on the plane through a position. Infinite where the light sees the plane
// edge-on.
glm::dvec2 depth_gradient(const glm::dvec3& position, const glm::dvec3& normal, const renderer::camera& light);

// The receivers of a picture, with the renderer's depth bias and without.
map_receivers map_receivers_of(const renderer::image<renderer::surface>& seen, const renderer::camera& light,
                               int resolution);

} // namespace gnomon::evaluation
