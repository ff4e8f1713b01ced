#include "scattering.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::renderer {

namespace {

double distance_along(const view_ray& ray, const glm::vec3& place)
{
    return glm::dot(glm::dvec3(place) - ray.origin, ray.direction);
}

glm::vec3 in_haze(const glm::vec3& radiance, const view_ray& ray, double length, float visible,
                  const scattering_stage& where)
{
    return transmittance(where.air, ray, length) * radiance +
           visible * scattered_radiance(where.air, where.light, ray, length);
}

// Calls f(layer, ray) for each layer, with the ray of its pixel. Parallel over rows.
template <class F> void for_each_layer(const camera& eye, const surface_layers& seen, const F& f)
{
    const int width = seen.opaque.width, height = seen.opaque.height;
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
            const view_ray ray = unit_ray(eye, x, y, width, height);
            for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i) f(i, ray);
        }
    });
}

} // namespace

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
            const double distance =
                s.valid() ? distance_along(ray, s.position) : eye.far_distance / glm::dot(ray.direction, eye.forward);
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
        for (int x = 0; x < result.width; ++x)
            result(x, y) = in_haze(surfaces(x, y), unit_ray(where.eye, x, y, result.width, result.height),
                                   static_cast<double>(distance(x, y)), visibility(x, y), where);
    });
    return result;
}

per_surface<float> ray_lengths(const camera& eye, const surface_layers& seen)
{
    per_surface<float> result{ray_lengths(eye, seen.opaque), std::vector<float>(seen.layers.size())};
    for_each_layer(eye, seen, [&](std::size_t i, const view_ray& ray) {
        result.layers[i] = static_cast<float>(distance_along(ray, seen.layers[i].position));
    });
    return result;
}

per_surface<glm::vec3> with_scattering(const surface_layers& seen, const per_surface<glm::vec3>& radiances,
                                       const per_surface<float>& distance, const per_surface<float>& visibility,
                                       const scattering_stage& where)
{
    per_surface<glm::vec3> result{with_scattering(radiances.opaque, distance.opaque, visibility.opaque, where),
                                  radiances.layers};
    for_each_layer(where.eye, seen, [&](std::size_t i, const view_ray& ray) {
        result.layers[i] =
            in_haze(radiances.layers[i], ray, static_cast<double>(distance.layers[i]), visibility.layers[i], where);
    });
    return result;
}

} // namespace gnomon::renderer
