#include "receivers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "toolbox/shading.hpp"

namespace gnomon::demo {

namespace {

// Depth per texel across the receiver's plane, in the direction in which it rises most.
double slope(const toolbox::surface& s, const toolbox::camera& light, int resolution)
{
    const glm::dvec3 position(s.position);
    const double cosine = glm::dot(glm::dvec3(s.normal), toolbox::direction_towards(light, position));
    const double distance = light.perspective() ? toolbox::view_distance(light, position) : 1;
    return std::min(std::sqrt(1 - cosine * cosine) / cosine, steepest_slope) * distance * unit_slope(light, resolution);
}

} // namespace

double unit_slope(const toolbox::camera& light, int resolution)
{
    const double texel = 2 * std::max(light.half_extent.x, light.half_extent.y) / resolution;
    return texel * 2 / (light.far_distance - light.near_distance);
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
        const double bias = bias_radius * std::exp2(level) * slope(s, light, resolution);
        result.pixels.push_back(i);
        result.places.push_back({static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(level)});
        result.depths.push_back(static_cast<float>(place.z - bias));
    }
    return result;
}

} // namespace gnomon::demo
