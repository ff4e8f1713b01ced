// What is shaded: the surfaces that a camera sees and a light can reach, as a shadow map sees them.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/camera.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::renderer {

// Where to look into a shadow map: texture coordinates in [0, 1] and the level of detail.
struct look_up {
    float u, v, level;
};

struct receivers {
    std::vector<std::size_t> pixels; // indices into the picture
    std::vector<look_up> places;
    std::vector<float> depths, unbiased_depths;

    std::size_t size() const { return pixels.size(); }
};

// Texels from the middle of the filter that the depth bias spares from shadowing themselves.
inline constexpr double bias_radius = 5.5;

// Slopes end here, at 80 degrees: beyond, the bias would swallow whole casters for the sake of hardly lit surfaces.
inline const double steepest_slope = std::tan(80 * std::acos(-1.0) / 180);

// Depth per texel across a plane at 45 degrees to the light; in perspective at distance one.
double unit_slope(const camera& light, int resolution);

// Depth per texel across a plane, in the direction in which it rises most, at a place of it.
double plane_slope(const glm::dvec3& position, const glm::dvec3& normal, const camera& light, int resolution);

// Depths are moved towards the light by the most that a plane through the receiver rises within bias_radius texels of
// the level looked at: the customary slope-scaled bias, the same for every method (Peters et al. 2017, D.2).
receivers receivers_of(const image<surface>& seen, const camera& light, int resolution);

} // namespace gnomon::renderer
