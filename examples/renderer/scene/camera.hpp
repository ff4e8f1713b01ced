// Cameras, which are lights, too: a directional light looks at the scene orthographically, a spot light in perspective.
// Depth is linear in the view distance in both, from -1 at the near plane to +1 at the far plane (Peters et al. 2017,
// 2.3); the view distance is measured along the viewing axis.
#pragma once

#include "scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <vector>

namespace gnomon::renderer {

enum class projection { orthographic, perspective };

struct camera {
    projection kind = projection::orthographic;
    glm::dvec3 position{0}, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1}; // orthonormal axes
    glm::dvec2 half_extent{1}; // of the picture: in world units, or in perspective at distance one
    double near_distance = 0, far_distance = 1;

    bool perspective() const { return kind == projection::perspective; }
};

// The point at view distance t of a ray is origin + t direction.
struct view_ray {
    glm::dvec3 origin, direction;
};

// Picture coordinates (u, v) are 0 to 1 from left to right and from top to bottom.
view_ray ray_through(const camera& eye, const glm::dvec2& uv);

double view_distance(const camera& eye, const glm::dvec3& point);
double linear_depth(const camera& eye, double distance);

// (u, v, linear depth); nothing is clamped. In perspective the point lies in front of the camera.
glm::dvec3 project(const camera& eye, const glm::dvec3& point);

// Homogeneous coordinates (x w, y w, linear depth, w) in pixels of a picture of this size, linear in the point.
glm::dvec4 texel_space(const camera& eye, const glm::dvec2& size, const glm::dvec3& point);

// Unit vector from the point towards the camera or light.
glm::dvec3 direction_towards(const camera& eye, const glm::dvec3& point);

// True if a projected point lies inside the picture and between the planes. A point outside of a light's view is lit.
bool within_view(const glm::dvec3& projected);

// The smallest cameras that look in this direction and see all of the points, between planes that fit them. aspect is
// width over height, field_of_view the vertical angle in radians. The up axis is the world's, or -z for a look straight
// down. Throws std::invalid_argument if there are no points.
using points = std::span<const glm::vec3>;
camera orthographic_view(points seen, const glm::dvec3& direction, double aspect = 1);
camera perspective_view(points seen, const glm::dvec3& direction, double field_of_view, double aspect = 1);

// A perspective camera at a given place that looks at a given point; only its planes are fitted.
camera perspective_view_from(const glm::dvec3& position, const glm::dvec3& target, points seen, double field_of_view,
                             double aspect);

// Points that a light has to see: the corners of a box of casters, and the shadows of these on the ground below.
std::vector<glm::vec3> casters_and_shadows(const bounds& casters, const glm::vec3& light_direction);

// The level of detail for a look-up into a map of this resolution: log2 of the larger footprint in texels when the
// point moves along d_dx and d_dy, a pixel of the camera; at least 0.
double mip_level(const camera& light, const glm::dvec3& point, const glm::dvec3& d_dx, const glm::dvec3& d_dy,
                 int resolution);

} // namespace gnomon::renderer
