#include "receivers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "toolbox/shading.hpp"

namespace gnomon::demo {

double unit_slope(const toolbox::camera& light, int resolution)
{
    const double texel = 2 * std::max(light.half_extent.x, light.half_extent.y) / resolution;
    return texel * 2 / (light.far_distance - light.near_distance);
}

double plane_slope(const glm::dvec3& position, const glm::dvec3& normal, const toolbox::camera& light, int resolution)
{
    const double cosine = glm::dot(normal, toolbox::direction_towards(light, position));
    const double distance = light.perspective() ? toolbox::view_distance(light, position) : 1;
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)); // of a cosine that rounding may bring above 1
    const double slope = sine < steepest_slope * cosine ? sine / cosine : steepest_slope;
    return slope * distance * unit_slope(light, resolution);
}

receivers receivers_of(const toolbox::image<toolbox::surface>& seen, const toolbox::camera& light, int resolution)
{
    receivers result;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const toolbox::surface& s = seen.pixels[i];
        if (!s.valid() || !toolbox::faces_light(light, s)) continue;
        const glm::dvec3 place = toolbox::project(light, s.position);
        if (!toolbox::within_view(place)) continue;
        const double level = toolbox::mip_level(light, s.position, s.d_dx, s.d_dy, resolution);
        const double bias = bias_radius * std::exp2(level) * plane_slope(s.position, s.normal, light, resolution);
        result.pixels.push_back(i);
        result.places.push_back({static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(level)});
        result.depths.push_back(static_cast<float>(place.z - bias));
    }
    return result;
}

} // namespace gnomon::demo
