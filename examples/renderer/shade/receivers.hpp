// The receivers of a picture: the points that a camera sees and a light can reach, as look-ups into its shadow map.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/camera.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::renderer {

// A place in a shadow map: texture coordinates in [0, 1] and the level of detail.
struct look_up {
    float u, v, level;
};

struct receivers {
    std::vector<std::size_t> pixels; // indices into the picture
    std::vector<look_up> places;
    std::vector<float> depths, unbiased_depths;

    std::size_t size() const { return pixels.size(); }
};

// Distance in texels, from the middle of a look-up, of the farthest texel of the filter: 4 of a blur with 9 taps, 1.5
// of bilinear filtering.
inline constexpr double bias_radius = 5.5;

// The slope of 80 degrees, at which the bias stops growing: a larger one would remove the shadows of whole casters for
// the sake of surfaces that are hardly lit.
inline const double steepest_slope = std::tan(80 * std::acos(-1.0) / 180);

// Depth per texel across a plane at 45 degrees to the light; in perspective at distance one.
double unit_slope(const camera& light, int resolution);

// Depth per texel across a plane, in the direction in which it rises most, at a place of it.
double plane_slope(const glm::dvec3& position, const glm::dvec3& normal, const camera& light, int resolution);

// The receivers of a picture. Depths are moved towards the light by the most that the plane of the receiver rises
// within bias_radius texels of the level of detail: the customary slope-scaled bias (Peters et al. 2017, D.2).
receivers receivers_of(const image<surface>& seen, const camera& light, int resolution);

} // namespace gnomon::renderer
