// Tubes along paths, and solids as from a lathe.
#pragma once

#include "scene.hpp"

#include <glm/vec3.hpp>

#include <span>

namespace gnomon::renderer {

// Appends a round tube without caps along a path of at least two points, each of them different from the next. A closed
// tube joins the last point to the first. The mesh must have a normal for each position.
void add_tube(mesh& target, std::span<const glm::vec3> path, float radius, int sides, bool closed = false);

// Appends a tube with a radius for each point of the path, and flat caps: a closed surface of 2 sides triangles for each
// point. The mesh must have no normals.
void add_capped_tube(mesh& target, std::span<const glm::vec3> path, std::span<const float> radii, int sides);

// A circle of the outline of a turned solid.
struct turned_circle {
    float radius, height;
};

// Appends a capped tube along y, of circles from the lowest to the highest, above a foot.
void add_turned(mesh& target, const glm::vec3& foot, std::span<const turned_circle> outline, int sides);

void add_ball(mesh& target, const glm::vec3& centre, float radius, int rings, int sides);

} // namespace gnomon::renderer
