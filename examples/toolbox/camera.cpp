#include "camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace gnomon::toolbox {

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

void require_some(const bounds& seen)
{
    if (seen.empty()) throw std::invalid_argument("camera: nothing to look at, the bounds are empty");
}

double diagonal(const bounds& seen) { return std::max(glm::length(glm::dvec3(seen.extent())), 1e-30); }

// Puts the near and far plane around the bounds; in perspective a near plane stays in front of the camera.
void set_planes(camera& eye, const bounds& seen)
{
    double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
    for (int i = 0; i < 8; ++i) {
        const double distance = view_distance(eye, seen.corner(i));
        nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
    }
    const double clearance = margin * std::max(farthest - nearest, margin * diagonal(seen));
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

glm::dvec3 direction_towards(const camera& eye, const glm::dvec3& point)
{
    return eye.perspective() ? glm::normalize(eye.position - point) : -eye.forward;
}

camera orthographic_view(const bounds& seen, const glm::dvec3& direction, double aspect)
{
    require_some(seen);
    camera eye = looking(projection::orthographic, seen.centre(), direction);
    double half_height = margin * diagonal(seen);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = glm::abs(to_axes(eye, seen.corner(i)));
        half_height = std::max({half_height, corner.y, corner.x / aspect});
    }
    eye.half_extent = (1 + margin) * half_height * glm::dvec2(aspect, 1);
    eye.position -= diagonal(seen) * eye.forward;
    set_planes(eye, seen);
    return eye;
}

camera perspective_view(const bounds& seen, const glm::dvec3& direction, double field_of_view, double aspect)
{
    require_some(seen);
    camera eye = looking(projection::perspective, seen.centre(), direction);
    eye.half_extent = std::tan(0.5 * field_of_view) * glm::dvec2(aspect, 1);
    // From distance d to the centre, a corner (x, y, z) is seen where |x| <= half_extent.x (d + z), and so for y.
    double distance = margin * diagonal(seen);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = to_axes(eye, seen.corner(i));
        const glm::dvec2 needed = glm::abs(glm::dvec2(corner)) / eye.half_extent - corner.z;
        distance = std::max({distance, needed.x, needed.y});
    }
    eye.position -= (distance + margin * diagonal(seen)) * eye.forward;
    set_planes(eye, seen);
    return eye;
}

camera perspective_view_from(const glm::dvec3& position, const glm::dvec3& target, const bounds& seen,
                             double field_of_view, double aspect)
{
    require_some(seen);
    camera eye = looking(projection::perspective, position, target - position);
    eye.half_extent = std::tan(0.5 * field_of_view) * glm::dvec2(aspect, 1);
    set_planes(eye, seen);
    return eye;
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

} // namespace gnomon::toolbox
