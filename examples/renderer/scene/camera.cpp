#include "camera.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::renderer {

namespace {

// Planes and edges stay this fraction of the view clear of the bounds, so that rounding leaves no corner outside.
constexpr double margin = 1e-3;

camera looking(projection kind, const glm::dvec3& position, const glm::dvec3& direction)
{
    const double length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument("camera: direction has no length");
    camera eye{.kind = kind, .position = position, .forward = direction / length};
    const glm::dvec3 world_up = std::abs(eye.forward.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    eye.right = glm::normalize(glm::cross(eye.forward, world_up));
    eye.up = glm::cross(eye.right, eye.forward);
    return eye;
}

glm::dvec3 to_axes(const camera& eye, const glm::dvec3& point)
{
    const glm::dvec3 offset = point - eye.position;
    return {glm::dot(offset, eye.right), glm::dot(offset, eye.up), glm::dot(offset, eye.forward)};
}

bounds around(points seen)
{
    bounds result;
    for (const glm::vec3& point : seen) result.include(point);
    if (result.empty()) throw std::invalid_argument("camera: there is nothing to look at");
    return result;
}

// The size of a view: that of the bounds, but not so small that rounding of the coordinates would count.
double diagonal(const bounds& seen)
{
    const glm::vec3 farthest = glm::max(glm::abs(seen.lower), glm::abs(seen.upper));
    return std::max({glm::length(glm::dvec3(seen.extent())), margin * glm::length(glm::dvec3(farthest)), 1e-30});
}

// Puts the near and far plane around the points; in perspective a near plane stays in front of the camera.
void set_planes(camera& eye, points seen)
{
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (const glm::vec3& point : seen) {
        const double distance = view_distance(eye, point);
        nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
    }
    const double clearance = margin * std::max(farthest - nearest, margin * diagonal(around(seen)));
    eye.near_distance = nearest - clearance;
    eye.far_distance = farthest + clearance;
    if (eye.perspective()) eye.near_distance = std::max(eye.near_distance, margin * eye.far_distance);
}

} // namespace

view_ray ray_through(const camera& eye, const glm::dvec2& uv)
{
    const glm::dvec3 offset =
        (2 * uv.x - 1) * eye.half_extent.x * eye.right + (1 - 2 * uv.y) * eye.half_extent.y * eye.up;
    if (eye.perspective()) return {eye.position, eye.forward + offset};
    return {eye.position + offset, eye.forward};
}

double view_distance(const camera& eye, const glm::dvec3& point) { return glm::dot(point - eye.position, eye.forward); }

double linear_depth(const camera& eye, double distance)
{
    return ((distance - eye.near_distance) - (eye.far_distance - distance)) / (eye.far_distance - eye.near_distance);
}

glm::dvec3 project(const camera& eye, const glm::dvec3& point)
{
    const glm::dvec3 local = to_axes(eye, point);
    const glm::dvec2 ndc = glm::dvec2(local) / (eye.half_extent * (eye.perspective() ? local.z : 1));
    return {0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y, linear_depth(eye, local.z)};
}

glm::dvec4 texel_space(const camera& eye, const glm::dvec2& size, const glm::dvec3& point)
{
    const glm::dvec3 local = to_axes(eye, point);
    const double w = eye.perspective() ? local.z : 1;
    return {0.5 * size * (glm::dvec2(local.x, -local.y) / eye.half_extent + w), linear_depth(eye, local.z), w};
}

glm::dvec3 direction_towards(const camera& eye, const glm::dvec3& point)
{
    return eye.perspective() ? glm::normalize(eye.position - point) : -eye.forward;
}

bool within_view(const glm::dvec3& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1 && p.z >= -1 && p.z <= 1; }

camera orthographic_view(points seen, const glm::dvec3& direction, double aspect)
{
    const bounds box = around(seen);
    camera eye = looking(projection::orthographic, box.centre(), direction);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec3& point : seen) {
        const glm::dvec2 local(to_axes(eye, point));
        low = glm::min(low, local), high = glm::max(high, local);
    }
    const glm::dvec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const double half_height = std::max({half.y, half.x / aspect, margin * diagonal(box)});
    eye.half_extent = (1 + margin) * half_height * glm::dvec2(aspect, 1);
    eye.position += middle.x * eye.right + middle.y * eye.up - diagonal(box) * eye.forward;
    set_planes(eye, seen);
    return eye;
}

camera perspective_view(points seen, const glm::dvec3& direction, double field_of_view, double aspect)
{
    const bounds box = around(seen);
    camera eye = looking(projection::perspective, box.centre(), direction);
    eye.half_extent = std::tan(0.5 * field_of_view) * glm::dvec2(aspect, 1);
    // From distance d to the centre, a point (x, y, z) is seen where |x| <= half_extent.x (d + z), and so for y.
    double distance = 0;
    for (const glm::vec3& point : seen) {
        const glm::dvec3 local = to_axes(eye, point);
        const glm::dvec2 needed = glm::abs(glm::dvec2(local)) / eye.half_extent - local.z;
        distance = std::max({distance, needed.x, needed.y});
    }
    eye.position -= (distance + margin * diagonal(box)) * eye.forward;
    set_planes(eye, seen);
    return eye;
}

camera perspective_view_from(const glm::dvec3& position, const glm::dvec3& target, points seen, double field_of_view,
                             double aspect)
{
    camera eye = looking(projection::perspective, position, target - position);
    eye.half_extent = std::tan(0.5 * field_of_view) * glm::dvec2(aspect, 1);
    set_planes(eye, seen);
    return eye;
}

std::vector<glm::vec3> casters_and_shadows(const bounds& casters, const glm::vec3& light_direction)
{
    if (!(light_direction.y < 0)) throw std::invalid_argument("camera: the light does not shine down");
    std::vector<glm::vec3> result;
    for (const glm::vec3& corner : casters.corners()) {
        result.push_back(corner);
        result.push_back(corner + (corner.y - casters.lower.y) / -light_direction.y * light_direction);
    }
    return result;
}

double mip_level(const camera& light, const glm::dvec3& point, const glm::dvec3& d_dx, const glm::dvec3& d_dy,
                 int resolution)
{
    const glm::dvec2 here = project(light, point);
    const auto texels = [&](const glm::dvec3& step) {
        return resolution * glm::length(glm::dvec2(project(light, point + step)) - here);
    };
    return std::log2(std::max({texels(d_dx), texels(d_dy), 1.0}));
}

} // namespace gnomon::renderer
