// Tubes along paths, with smooth normals.
#pragma once

#include "scene.hpp"

#include <glm/vec3.hpp>

#include <span>

namespace gnomon::renderer {

// Appends a round tube without caps along a path of at least two points, each of them different from the next. A closed
// tube joins the last point to the first. The mesh must have a normal for each position.
void add_tube(mesh& target, std::span<const glm::vec3> path, float radius, int sides, bool closed = false);

} // namespace gnomon::renderer
