#include "shading.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::renderer {

bool faces_light(const camera& light, const surface& seen)
{
    return glm::dot(direction_towards(light, seen.position), glm::dvec3(seen.normal)) > 0;
}

glm::vec3 radiance(const glm::vec3& albedo, const glm::vec3& normal, const glm::vec3& sunlight)
{
    return albedo * (glm::mix(daylight.earth, daylight.sky, 0.5f + 0.5f * normal.y) + sunlight * daylight.sun);
}

glm::vec3 radiance(const glm::vec3& albedo, const glm::vec3& normal, float sunlight)
{
    return radiance(albedo, normal, glm::vec3(sunlight));
}

picture shade(const scene& world, const camera& light, const image<surface>& seen, const image<float>& visibility)
{
    picture result(seen.width, seen.height, daylight.background);
    tbb::parallel_for(0, seen.height, [&](int y) {
        for (int x = 0; x < seen.width; ++x) {
            const surface& s = seen(x, y);
            if (!s.valid()) continue;
            const glm::vec3 to_light(direction_towards(light, s.position));
            const float cosine = faces_light(light, s) ? std::max(glm::dot(to_light, s.shading_normal), 0.f) : 0.f;
            const glm::vec3& albedo = world.meshes[static_cast<std::size_t>(s.mesh)].albedo;
            result(x, y) = radiance(albedo, s.shading_normal, visibility(x, y) * cosine);
        }
    });
    return result;
}

} // namespace gnomon::renderer
