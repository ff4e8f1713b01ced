// The surface at the point at which the view ray of a pixel meets a triangle that covers the pixel.
#pragma once

#include "coverage.hpp"

#include <glm/vec3.hpp>

namespace gnomon::renderer::coverage {

surface surface_at(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel);

// The opacity of the surface.
glm::vec3 opacity_at(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel);

} // namespace gnomon::renderer::coverage
