#include "view_point.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::renderer::coverage {

namespace {

// Corner weights of a point in the triangle's plane.
glm::dvec3 barycentric(const triangle& shape, const glm::dvec3& point)
{
    const glm::dvec3 n = shape.normal();
    const auto weight = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(n, glm::cross(p - point, q - point)) / glm::dot(n, n);
    };
    const auto& [a, b, c] = shape.corners;
    return {weight(b, c), weight(c, a), weight(a, b)};
}

} // namespace

glm::dvec3 view_point::weights() const { return glm::clamp(barycentric(shape, position), 0.0, 1.0); }

view_point view_point_of(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel)
{
    const triangle shape = triangle_of(world, id);
    const distance_plane plane = view.plane_of(shape);
    const view_ray ray = ray_through(view.eye, pixel / view.size);
    // A grazing triangle's plane may miss the ray of the pixel that its snapped outline covers: stay on the triangle.
    glm::dvec2 range(1e300, -1e300);
    for (const glm::dvec3& corner : shape.corners) {
        const double distance = view_distance(view.eye, corner);
        range = {std::min(range.x, distance), std::max(range.y, distance)};
    }
    range = glm::clamp(range, view.eye.near_distance, view.eye.far_distance);
    const double q = plane.at(pixel.x, pixel.y);
    const double distance = std::clamp(view.eye.perspective() && q <= 0 ? range.y : view.distance(q), range.x, range.y);
    return {id, shape, plane, pixel, ray, distance, ray.origin + distance * ray.direction};
}

surface surface_at(const scene& world, const viewport& view, const view_point& at)
{
    const mesh& part = world.meshes[at.id.mesh];
    const view_ray& ray = at.ray;
    const double distance = at.distance;
    // position = origin + t direction, both affine in the pixel, and t = q or 1/q.
    const auto derivative = [&](const glm::dvec2& step, double dq) {
        const view_ray next = ray_through(view.eye, (at.pixel + step) / view.size);
        const double dt = view.eye.perspective() ? -dq * distance * distance : dq;
        return glm::vec3(next.origin - ray.origin + distance * (next.direction - ray.direction) + dt * ray.direction);
    };
    glm::dvec3 normal = glm::normalize(at.shape.normal());
    const double side = glm::dot(normal, ray.direction) > 0 ? -1 : 1;
    glm::dvec3 shading = normal;
    if (!part.normals.empty()) {
        const glm::dvec3 weights = at.weights();
        const glm::uvec3 index = part.triangles[at.id.triangle];
        const glm::dvec3 sum = weights.x * glm::dvec3(part.normals[index.x]) +
                               weights.y * glm::dvec3(part.normals[index.y]) +
                               weights.z * glm::dvec3(part.normals[index.z]);
        if (glm::dot(sum, sum) > 0) shading = glm::normalize(sum);
    }
    return {static_cast<int>(at.id.mesh),  at.position, side * normal, side * shading, derivative({1, 0}, at.plane.b),
            derivative({0, 1}, at.plane.c)};
}

glm::vec3 opacity_at(const scene& world, const view_point& at)
{
    return world.meshes[at.id.mesh].opacity_at(at.id.triangle, glm::vec3(at.weights()));
}

} // namespace gnomon::renderer::coverage
