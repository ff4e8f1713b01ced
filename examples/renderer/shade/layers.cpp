#include "layers.hpp"

#include "shading.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::renderer {

per_surface<glm::vec3> shade_each(const scene& world, const camera& light, const surface_layers& seen,
                                  const layer_visibility& visibility)
{
    const auto albedo = [&](const surface& s) { return world.meshes[static_cast<std::size_t>(s.mesh)].albedo; };
    per_surface<glm::vec3> result{{seen.opaque.width, seen.opaque.height, daylight.background},
                                  std::vector<glm::vec3>(seen.layers.size())};
    tbb::parallel_for(std::size_t(0), result.opaque.pixels.size(), [&](std::size_t pixel) {
        if (const surface& s = seen.opaque.pixels[pixel]; s.valid()) {
            const glm::vec3 to_light(direction_towards(light, s.position));
            const float cosine = faces_light(light, s) ? std::max(glm::dot(to_light, s.shading_normal), 0.f) : 0.f;
            result.opaque.pixels[pixel] =
                radiance(albedo(s), s.shading_normal, cosine * visibility.opaque.pixels[pixel]);
        }
        const glm::vec3 level(1, 0, 0); // sky and earth in equal parts
        for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i)
            result.layers[i] = radiance(albedo(seen.layers[i]), level, visibility.layers[i]);
    });
    return result;
}

picture blended(const surface_layers& seen, const per_surface<glm::vec3>& radiances)
{
    picture result = radiances.opaque;
    tbb::parallel_for(std::size_t(0), result.pixels.size(), [&](std::size_t pixel) {
        glm::vec3& colour = result.pixels[pixel];
        for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i)
            colour = glm::mix(colour, radiances.layers[i], seen.opacities[i]);
    });
    return result;
}

picture shade_layers(const scene& world, const camera& light, const surface_layers& seen,
                     const layer_visibility& visibility)
{
    return blended(seen, shade_each(world, light, seen, visibility));
}

} // namespace gnomon::renderer
