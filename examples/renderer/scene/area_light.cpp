#include "area_light.hpp"

#include <glm/trigonometric.hpp>

namespace gnomon::renderer {

glm::dvec3 towards(const area_light& light, const glm::dvec3& point, const glm::dvec2& place)
{
    const camera& map = light.map;
    const glm::dvec2 size = map.perspective() ? light.size : 2.0 * glm::tan(0.5 * light.size);
    const glm::dvec3 offset = place.x * size.x * map.right + place.y * size.y * map.up;
    return map.perspective() ? map.position - point + offset : offset - map.forward;
}

} // namespace gnomon::renderer
