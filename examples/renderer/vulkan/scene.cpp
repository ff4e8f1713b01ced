#include "scene.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::renderer::vulkan {

namespace {

// scale dot(p - eye.position, axis) + offset as a product with (p, 1).
glm::vec4 row(const camera& eye, const glm::dvec3& axis, double scale, double offset)
{
    return glm::dvec4(scale * axis, offset - scale * glm::dot(eye.position, axis));
}

} // namespace

std::vector<glm::vec3> corners_of(const scene& world)
{
    std::vector<glm::vec3> result;
    for (const mesh& part : world.meshes)
        for (const glm::uvec3& triangle : part.triangles) {
            const std::array corners{part.positions[triangle.x], part.positions[triangle.y],
                                     part.positions[triangle.z]};
            const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            for (const glm::vec3& corner : corners) result.insert(result.end(), {corner, normal, part.albedo});
        }
    return result;
}

std::vector<glm::vec3> layers_of(const scene& world, const camera& eye)
{
    struct layer {
        double distance;
        std::array<glm::vec3, 6> corners;
    };
    std::vector<layer> layers;
    for (const mesh& part : translucent_part(world).meshes)
        for (const glm::uvec3& triangle : part.triangles) {
            layer& one = layers.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t corner = triangle[glm::length_t(i)];
                const glm::vec2 place =
                    part.texture_coordinates.empty() ? glm::vec2(0) : part.texture_coordinates[corner];
                one.corners[2 * i] = part.positions[corner];
                one.corners[2 * i + 1] = {place, part.opacity.r};
                one.distance += view_distance(eye, one.corners[2 * i]) / 3;
            }
        }
    std::ranges::stable_sort(layers, std::ranges::greater(), &layer::distance);
    std::vector<glm::vec3> result;
    for (const layer& one : layers) result.insert(result.end(), one.corners.begin(), one.corners.end());
    return result;
}

std::array<glm::vec4, 4> clip_rows(const camera& eye)
{
    const double near = eye.near_distance, scale = 1 / (eye.far_distance - near);
    const double depth = eye.perspective() ? eye.far_distance * scale : scale;
    return {row(eye, eye.right, 1 / eye.half_extent.x, 0), row(eye, eye.up, -1 / eye.half_extent.y, 0),
            row(eye, eye.forward, depth, -near * depth),
            eye.perspective() ? row(eye, eye.forward, 1, 0) : glm::vec4(0, 0, 0, 1)};
}

std::array<glm::vec4, 3> shadow_rows(const camera& light)
{
    const double depth = 2 / (light.far_distance - light.near_distance);
    return {row(light, light.right, 0.5 / light.half_extent.x, 0.5),
            row(light, light.up, -0.5 / light.half_extent.y, 0.5),
            row(light, light.forward, depth, -depth * light.near_distance - 1)};
}

picture without_alpha(const renderer::image<glm::vec4>& source)
{
    picture result(source.width, source.height);
    std::ranges::copy(source.pixels, result.pixels.begin());
    return result;
}

} // namespace gnomon::renderer::vulkan
