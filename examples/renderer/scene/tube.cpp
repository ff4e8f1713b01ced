#include "tube.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::renderer {

namespace {

glm::vec3 perpendicular(const glm::vec3& v, const glm::vec3& near)
{
    const glm::vec3 rest = near - glm::dot(near, v) * v;
    return glm::length(rest) > 1e-3f ? glm::normalize(rest) : perpendicular(v, {near.y, near.z, near.x + 1});
}

// Rings of vertices around the points of a path, and bands of triangles between them. Normals lie across the path.
void add_rings(mesh& target, std::span<const glm::vec3> path, std::span<const float> radii, int sides, bool closed,
               std::vector<glm::vec3>* normals)
{
    const std::size_t count = path.size();
    std::vector<glm::vec3> along(count), across(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = i > 0 ? i - 1 : closed ? count - 1 : 0;
        const std::size_t after = i + 1 < count ? i + 1 : closed ? 0 : i;
        along[i] = glm::normalize(path[after] - path[before]);
        across[i] = perpendicular(along[i], i > 0 ? across[i - 1] : glm::vec3(0, 1, 0));
    }
    // Around a closed path the direction across has turned, which all rings make good in equal parts.
    float turn = 0;
    if (closed) {
        const glm::vec3 end = perpendicular(along[0], across[count - 1]);
        turn = std::atan2(glm::dot(glm::cross(end, across[0]), along[0]), glm::dot(end, across[0]));
    }
    const auto first = static_cast<std::uint32_t>(target.positions.size());
    const auto around = static_cast<std::uint32_t>(sides);
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < sides; ++k) {
            const float angle = glm::two_pi<float>() * static_cast<float>(k) / static_cast<float>(sides) +
                                turn * static_cast<float>(i) / static_cast<float>(count);
            const glm::vec3 normal = std::cos(angle) * across[i] + std::sin(angle) * glm::cross(along[i], across[i]);
            target.positions.push_back(path[i] + radii[i] * normal);
            if (normals) normals->push_back(normal);
        }
    const auto rings = static_cast<std::uint32_t>(count);
    for (std::uint32_t ring = 0; ring + (closed ? 0 : 1) < rings; ++ring)
        for (std::uint32_t k = 0; k < around; ++k) {
            const std::uint32_t here = first + ring * around, there = first + (ring + 1) % rings * around;
            const std::uint32_t next = (k + 1) % around;
            target.triangles.push_back({here + k, here + next, there + next});
            target.triangles.push_back({here + k, there + next, there + k});
        }
}

} // namespace

void add_tube(mesh& target, std::span<const glm::vec3> path, float radius, int sides, bool closed)
{
    add_rings(target, path, std::vector<float>(path.size(), radius), sides, closed, &target.normals);
}

void add_capped_tube(mesh& target, std::span<const glm::vec3> path, std::span<const float> radii, int sides)
{
    const auto first = static_cast<std::uint32_t>(target.positions.size());
    const auto around = static_cast<std::uint32_t>(sides);
    add_rings(target, path, radii, sides, false, nullptr);
    const auto last = static_cast<std::uint32_t>(target.positions.size()) - around;
    const std::uint32_t centre = last + around;
    target.positions.insert(target.positions.end(), {path.front(), path.back()});
    for (std::uint32_t k = 0; k < around; ++k) {
        const std::uint32_t next = (k + 1) % around;
        target.triangles.push_back({centre, first + next, first + k});
        target.triangles.push_back({centre + 1, last + k, last + next});
    }
}

void add_turned(mesh& target, const glm::vec3& foot, std::span<const turned_circle> outline, int sides)
{
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    for (const turned_circle& circle : outline) {
        path.push_back(foot + glm::vec3(0, circle.height, 0));
        radii.push_back(circle.radius);
    }
    add_capped_tube(target, path, radii, sides);
}

void add_ball(mesh& target, const glm::vec3& centre, float radius, int rings, int sides)
{
    std::vector<turned_circle> outline;
    for (int i = 0; i < rings; ++i) {
        const float angle = glm::pi<float>() * (static_cast<float>(i) + 0.5f) / static_cast<float>(rings);
        outline.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
    }
    add_turned(target, centre, outline, sides);
}

} // namespace gnomon::renderer
