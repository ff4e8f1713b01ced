#include "receivers.hpp"

#include "shading.hpp"

#include <gnomon/filters/depth_bias.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::renderer {

double unit_slope(const camera& light, int resolution)
{
    const double texel = 2 * std::max(light.half_extent.x, light.half_extent.y) / resolution;
    return texel * 2 / (light.far_distance - light.near_distance);
}

double plane_slope(const glm::dvec3& position, const glm::dvec3& normal, const camera& light, int resolution)
{
    // The ray of a texel meets the plane at view distance n . (p - e) / n . d, and d changes across the axis.
    const bool perspective = light.perspective();
    const double distance = perspective ? view_distance(light, position) : 1;
    const glm::dvec3 ray = perspective ? (position - light.position) / distance : light.forward;
    const double across = glm::length(glm::dvec2(glm::dot(normal, light.right), glm::dot(normal, light.up)));
    const double rise = distance * unit_slope(light, resolution);
    return depth_bias_slope_scaled(across, glm::dot(normal, ray), rise, steepest_slope);
}

receivers receivers_of(const image<surface>& seen, const camera& light, int resolution)
{
    receivers result;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const surface& s = seen.pixels[i];
        if (!s.valid() || !faces_light(light, s)) continue;
        const glm::dvec3 place = project(light, s.position);
        if (!within_view(place)) continue;
        const double level = mip_level(light, s.position, s.d_dx, s.d_dy, resolution);
        const double bias = bias_radius * std::exp2(level) * plane_slope(s.position, s.normal, light, resolution);
        result.pixels.push_back(i);
        result.places.push_back({static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(level)});
        result.depths.push_back(static_cast<float>(place.z - bias));
        result.unbiased_depths.push_back(static_cast<float>(place.z));
    }
    return result;
}

} // namespace gnomon::renderer
