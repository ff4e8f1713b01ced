#include "receivers.hpp"

#include <glm/geometric.hpp>

namespace gnomon::evaluation {

glm::dvec2 depth_gradient(const glm::dvec3& position, const glm::dvec3& normal, const renderer::camera& light)
{
    // Along the axes of the light a plane is n_r a + n_u b + n_f c = k, with a = c h_u (2 u - 1) and b = c h_v (1 - 2 v) in
    // perspective, and without the c else; c is the view distance.
    const glm::dvec2 across(glm::dot(normal, light.right), -glm::dot(normal, light.up));
    const double depth = 2 / (light.far_distance - light.near_distance);
    const double distance = light.perspective() ? renderer::view_distance(light, position) : 1;
    const glm::dvec3 ray = light.perspective() ? (position - light.position) / distance : light.forward;
    return -2.0 * across * light.half_extent * (depth * distance / glm::dot(normal, ray));
}

map_receivers map_receivers_of(const renderer::image<renderer::surface>& seen, const renderer::camera& light,
                               int resolution)
{
    const renderer::receivers found = renderer::receivers_of(seen, light, resolution);
    map_receivers result{found.pixels, {}, {}};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const renderer::surface& s = seen.pixels[found.pixels[i]];
        const glm::vec2 gradient(depth_gradient(s.position, s.normal, light));
        const auto [u, v, level] = found.places[i];
        result.biased.push_back({u, v, level, found.depths[i], gradient.x, gradient.y});
        result.unbiased.push_back({u, v, level, found.unbiased_depths[i], gradient.x, gradient.y});
    }
    return result;
}

} // namespace gnomon::evaluation
