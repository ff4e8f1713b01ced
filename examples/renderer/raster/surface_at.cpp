#include "surface_at.hpp"

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

// Where the view ray of a pixel meets a triangle.
struct view_point {
    const triangle shape;
    const distance_plane plane;
    const view_ray ray;
    double distance;
    glm::dvec3 position;

    view_point(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel)
        : shape(triangle_of(world, id)), plane(view.plane_of(shape)), ray(ray_through(view.eye, pixel / view.size))
    {
        // A grazing triangle's plane may miss the ray of the pixel that its snapped outline covers: stay on the
        // triangle.
        glm::dvec2 range(1e300, -1e300);
        for (const glm::dvec3& corner : shape.corners) {
            const double to_corner = view_distance(view.eye, corner);
            range = {std::min(range.x, to_corner), std::max(range.y, to_corner)};
        }
        range = glm::clamp(range, view.eye.near_distance, view.eye.far_distance);
        const double q = plane.at(pixel.x, pixel.y);
        distance = std::clamp(view.eye.perspective() && q <= 0 ? range.y : view.distance(q), range.x, range.y);
        position = ray.origin + distance * ray.direction;
    }

    // The weights of the triangle's corners, in [0, 1].
    glm::dvec3 weights() const { return glm::clamp(barycentric(shape, position), 0.0, 1.0); }
};

} // namespace

surface surface_at(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel)
{
    const view_point at(world, view, id, pixel);
    const mesh& part = world.meshes[id.mesh];
    const view_ray& ray = at.ray;
    const double distance = at.distance;
    // position = origin + t direction, both affine in the pixel, and t = q or 1/q.
    const auto derivative = [&](const glm::dvec2& step, double dq) {
        const view_ray next = ray_through(view.eye, (pixel + step) / view.size);
        const double dt = view.eye.perspective() ? -dq * distance * distance : dq;
        return glm::vec3(next.origin - ray.origin + distance * (next.direction - ray.direction) + dt * ray.direction);
    };
    glm::dvec3 normal = glm::normalize(at.shape.normal());
    const double side = glm::dot(normal, ray.direction) > 0 ? -1 : 1;
    glm::dvec3 shading = normal;
    if (!part.normals.empty()) {
        const glm::dvec3 weights = at.weights();
        const glm::uvec3 index = part.triangles[id.triangle];
        const glm::dvec3 sum = weights.x * glm::dvec3(part.normals[index.x]) +
                               weights.y * glm::dvec3(part.normals[index.y]) +
                               weights.z * glm::dvec3(part.normals[index.z]);
        if (glm::dot(sum, sum) > 0) shading = glm::normalize(sum);
    }
    return {static_cast<int>(id.mesh),     at.position, side * normal, side * shading, derivative({1, 0}, at.plane.b),
            derivative({0, 1}, at.plane.c)};
}

glm::vec3 opacity_at(const scene& world, const viewport& view, triangle_id id, const glm::dvec2& pixel)
{
    const mesh& part = world.meshes[id.mesh];
    if (!part.alpha) return part.opacity_at(id.triangle, glm::vec3(0));
    return part.opacity_at(id.triangle, glm::vec3(view_point(world, view, id, pixel).weights()));
}

} // namespace gnomon::renderer::coverage
