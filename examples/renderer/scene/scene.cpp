#include "scene.hpp"

#include <glm/common.hpp>

#include <cmath>
#include <utility>

namespace gnomon::renderer {

namespace {

scene part_of(const scene& world, bool opaque)
{
    scene result = world;
    for (mesh& part : result.meshes)
        if (part.opaque() != opaque) part.triangles.clear();
    return result;
}

} // namespace

bool mesh::opaque() const { return opacity.x >= 1 && opacity.y >= 1 && opacity.z >= 1 && !alpha; }

glm::vec3 mesh::opacity_at(std::uint32_t triangle, const glm::vec3& weights) const
{
    float factor = 1;
    if (alpha) {
        const glm::uvec3 corner = triangles[triangle];
        const auto at = [&](std::uint32_t i) {
            return texture_coordinates.empty() ? glm::vec2(0) : texture_coordinates[i];
        };
        factor = alpha(weights.x * at(corner.x) + weights.y * at(corner.y) + weights.z * at(corner.z));
    }
    return glm::clamp(factor * opacity, 0.f, 1.f);
}

scene opaque_part(const scene& world) { return part_of(world, true); }

scene translucent_part(const scene& world) { return part_of(world, false); }

void bounds::include(const glm::vec3& point)
{
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

bool bounds::empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }

glm::vec3 bounds::centre() const { return 0.5f * lower + 0.5f * upper; }

glm::vec3 bounds::extent() const { return upper - lower; }

std::array<glm::vec3, 8> bounds::corners() const
{
    std::array<glm::vec3, 8> result;
    for (unsigned i = 0; i < 8; ++i)
        result[i] = {(i & 1 ? upper : lower).x, (i & 2 ? upper : lower).y, (i & 4 ? upper : lower).z};
    return result;
}

bounds bounds_of(const scene& world)
{
    bounds result;
    for (const mesh& part : world.meshes)
        for (const glm::vec3& position : part.positions) result.include(position);
    return result;
}

mesh painted(std::string name, const glm::vec3& albedo)
{
    return {.name = std::move(name), .albedo = albedo, .positions = {}, .normals = {}, .triangles = {}};
}

placement upright(const glm::vec3& centre, const glm::vec3& size, float angle)
{
    const float c = std::cos(angle), s = std::sin(angle);
    return {centre,
            0.5f * glm::mat3(size.x * glm::vec3(c, 0, -s), size.y * glm::vec3(0, 1, 0), size.z * glm::vec3(s, 0, c))};
}

void add_quad(mesh& target, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v)
{
    const auto first = static_cast<std::uint32_t>(target.positions.size());
    target.positions.insert(target.positions.end(),
                            {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v});
    target.triangles.insert(target.triangles.end(), {first + glm::uvec3(0, 1, 2), first + glm::uvec3(0, 2, 3)});
}

void add_textured_quad(mesh& target, const glm::vec3& corner, const glm::vec3& edge_u, const glm::vec3& edge_v,
                       const glm::vec2& first, const glm::vec2& last)
{
    add_quad(target, corner, edge_u, edge_v);
    target.texture_coordinates.insert(target.texture_coordinates.end(),
                                      {first, {last.x, first.y}, last, {first.x, last.y}});
}

void add_box(mesh& target, const placement& where)
{
    const std::array<glm::vec2, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    add_prism(target, square, where);
}

void add_prism(mesh& target, std::span<const glm::vec2> outline, const placement& where)
{
    const auto first = static_cast<std::uint32_t>(target.positions.size());
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (const float side : {1.f, -1.f})
        for (const glm::vec2& corner : outline)
            target.positions.push_back(where.centre + where.half_axes * glm::vec3(corner, side));
    for (std::uint32_t i = 2; i < count; ++i) {
        target.triangles.push_back(first + glm::uvec3(0, i - 1, i));
        target.triangles.push_back(first + count + glm::uvec3(0, i, i - 1));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        target.triangles.push_back(first + glm::uvec3(i, count + i, count + next));
        target.triangles.push_back(first + glm::uvec3(i, count + next, next));
    }
}

mesh ground(const glm::vec3& centre, float width, float depth, const glm::vec3& albedo)
{
    mesh result{.name = "ground", .albedo = albedo, .positions = {}, .normals = {}, .triangles = {}};
    add_quad(result, centre + 0.5f * glm::vec3(-width, 0, depth), {width, 0, 0}, {0, 0, -depth});
    return result;
}

} // namespace gnomon::renderer
