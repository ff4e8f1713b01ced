// Lights with an area: a rectangle whose sides are parallel to those of the light's shadow map.
#pragma once

#include "camera.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gnomon::renderer {

// The size is measured along map.right and map.up. An orthographic map has a directional light: sizes are the angles
// under which the light is seen, in radians. A perspective map has a local light around map.position: sizes are lengths.
struct area_light {
    camera map;
    glm::dvec2 size{0};
};

// The vector from a point to a place of the light, in [-1/2, 1/2]^2 along right and up: of any length for a directional
// light, up to the place for a local one.
glm::dvec3 towards(const area_light& light, const glm::dvec3& point, const glm::dvec2& place);

} // namespace gnomon::renderer
