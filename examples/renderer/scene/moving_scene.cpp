#include "moving_scene.hpp"

#include <glm/common.hpp>

namespace gnomon::renderer {

scene scene_at(const moving_scene& world, float t)
{
    scene result = world.open;
    for (std::size_t m = 0; m < result.meshes.size(); ++m) {
        if (!world.moves(m)) continue;
        mesh& part = result.meshes[m];
        part.normals.clear();
        for (std::size_t i = 0; i < part.positions.size(); ++i)
            part.positions[i] = glm::mix(part.positions[i], world.closing[m][i], t);
    }
    return result;
}

bounds bounds_of(const moving_scene& world)
{
    bounds result = bounds_of(world.open);
    for (const std::vector<glm::vec3>& positions : world.closing)
        for (const glm::vec3& position : positions) result.include(position);
    return result;
}

camera moving_camera::at(double t) const
{
    camera result = open;
    result.position += t * motion;
    return result;
}

} // namespace gnomon::renderer
