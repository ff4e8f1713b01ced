#include "scene.hpp"

#include <glm/geometric.hpp>

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

renderer::image<glm::vec4> read_back(const device& owner, const image& source)
{
    const int width = int(source.extent().width), height = int(source.extent().height);
    renderer::image<glm::vec4> result(width, height);
    const buffer pixels(owner, result.pixels.size() * sizeof(glm::vec4), vk::BufferUsageFlagBits::eTransferDst);
    owner.run([&](const vk::raii::CommandBuffer& commands) { copy(commands, source, pixels); });
    std::ranges::copy(pixels.mapped<glm::vec4>(), result.pixels.begin());
    return result;
}

picture without_alpha(const renderer::image<glm::vec4>& source)
{
    picture result(source.width, source.height);
    std::ranges::copy(source.pixels, result.pixels.begin());
    return result;
}

} // namespace gnomon::renderer::vulkan
