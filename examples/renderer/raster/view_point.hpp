// The point at which the view ray of a pixel meets a triangle that covers the pixel.
#pragma once

#include "coverage.hpp"

#include <glm/vec3.hpp>

namespace gnomon::renderer::coverage {

struct view_point {
    triangle_id id;
    triangle shape;
    distance_plane plane;
    glm::dvec2 pixel; // continuous coordinates
    view_ray ray;
    double distance;
    glm::dvec3 position;

    // The weights of the triangle's corners, in [0, 1].
    glm::dvec3 weights() const;
};

view_point view_point_of(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel);

surface surface_at(const scene& world, const viewport& view, const view_point& at);
glm::vec3 opacity_at(const scene& world, const view_point& at);

} // namespace gnomon::renderer::coverage
