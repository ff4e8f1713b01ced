#include "scattering.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <cmath>

namespace gnomon::renderer {

view_ray unit_ray(const camera& eye, int x, int y, int width, int height)
{
    const view_ray ray = ray_through(eye, {(x + 0.5) / width, (y + 0.5) / height});
    return {ray.origin, glm::normalize(ray.direction)};
}

image<float> ray_lengths(const camera& eye, const image<surface>& seen)
{
    image<float> result(seen.width, seen.height);
    tbb::parallel_for(0, seen.height, [&](int y) {
        for (int x = 0; x < seen.width; ++x) {
            const view_ray ray = unit_ray(eye, x, y, seen.width, seen.height);
            const surface& s = seen(x, y);
            const double distance = s.valid() ? glm::dot(glm::dvec3(s.position) - ray.origin, ray.direction)
                                              : eye.far_distance / glm::dot(ray.direction, eye.forward);
            result(x, y) = static_cast<float>(distance);
        }
    });
    return result;
}

glm::vec3 transmittance(const medium& air, const view_ray& ray, double length)
{
    return glm::vec3(glm::exp(-air.thickness(ray, length) * glm::dvec3(air.extinction())));
}

glm::vec3 scattered_radiance(const medium& air, const camera& light, const view_ray& ray, double length)
{
    // The direction from which light reaches the eye is that of the ray, turned round.
    const double phase = air.phase(-glm::dot(light.forward, ray.direction)), thickness = air.thickness(ray, length);
    const glm::dvec3 sigmas(air.extinction());
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) {
        const double sigma = sigmas[i];
        const double lit = sigma > 0 ? -std::expm1(-sigma * thickness) / sigma : thickness;
        result[i] = static_cast<float>(phase * lit);
    }
    return air.irradiance * air.scattering * result;
}

picture with_scattering(const picture& surfaces, const image<float>& distance, const image<float>& visibility,
                        const scattering_stage& where)
{
    picture result(surfaces.width, surfaces.height);
    tbb::parallel_for(0, result.height, [&](int y) {
        for (int x = 0; x < result.width; ++x) {
            const view_ray ray = unit_ray(where.eye, x, y, result.width, result.height);
            const auto length = static_cast<double>(distance(x, y));
            result(x, y) = transmittance(where.air, ray, length) * surfaces(x, y) +
                           visibility(x, y) * scattered_radiance(where.air, where.light, ray, length);
        }
    });
    return result;
}

} // namespace gnomon::renderer
