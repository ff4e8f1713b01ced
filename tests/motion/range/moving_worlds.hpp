// Worlds for the rasterizer of motion that are laid out in texels, so that vertices may sit on texel centres.
#pragma once

#include "renderer/raster/moving_rasterizer.hpp"

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::test {

inline constexpr int world_size = 64; // texels along a side

/// A light that looks down on x and z from 0 to 64, a unit a texel; depth is -1 at y = 1 and 1 at y = -1.
inline renderer::moving_camera light_above()
{
    return {{.kind = renderer::projection::orthographic,
             .position = {0.5 * world_size, 2, 0.5 * world_size},
             .right = {1, 0, 0},
             .up = {0, 0, -1},
             .forward = {0, -1, 0},
             .half_extent = {0.5 * world_size, 0.5 * world_size},
             .near_distance = 1,
             .far_distance = 3},
            {0, 0, 0}};
}

/// A mesh in motion, as part of a world.
struct moving_part {
    renderer::mesh open;
    std::vector<glm::vec3> closing;

    std::uint32_t add(const glm::vec3& from, const glm::vec3& to)
    {
        open.positions.push_back(from);
        closing.push_back(to);
        return static_cast<std::uint32_t>(closing.size() - 1);
    }
};

inline renderer::moving_scene world_of(const std::vector<moving_part>& parts)
{
    renderer::moving_scene world{{"parts", {}}, {}};
    for (const moving_part& part : parts) {
        world.open.meshes.push_back(part.open);
        world.closing.push_back(part.closing);
    }
    return world;
}

/// A level rectangle from one corner to the other, which moves by a distance.
inline moving_part sheet(const glm::vec3& corner, const glm::vec3& opposite, const glm::vec3& motion = glm::vec3(0))
{
    moving_part part;
    const glm::vec3 corners[]{corner, {opposite.x, corner.y, corner.z}, opposite, {corner.x, opposite.y, opposite.z}};
    for (const glm::vec3& at : corners) part.add(at, at + motion);
    part.open.triangles = {{0, 1, 2}, {0, 2, 3}};
    return part;
}

} // namespace gnomon::test
