// A stage with air that scatters, as the driver measures it: the shadow map, the camera's picture, its view rays in light
// axes, and the picture from visibilities of these rays.
#pragma once

#include "evaluation/core/settings.hpp"
#include "renderer/shade/scattering.hpp"
#include "scattering_method.hpp"

#include <glm/vec3.hpp>

#include <span>
#include <vector>

namespace gnomon::evaluation {

// Shadow maps have how.map_resolution texels along each side; rectified maps have as many columns and rows.
class scattering_view {
  public:
    scattering_view(const renderer::scattering_stage& its_stage, const settings& how);

    // All that methods build from. The view outlives it.
    scattering_scene scene() const;

    // Visibilities of view rays by ray tracing, integrated in closed form.
    std::vector<float> traced(std::span<const view_segment> segments) const;

    // The picture from a visibility for each view ray.
    renderer::picture shown(std::span<const float> visibility) const;

    // The same with black surfaces.
    renderer::picture scattered(std::span<const float> visibility) const;

    const renderer::scattering_stage& stage;
    const scattering_depths depths;
    const renderer::image<renderer::surface> seen;
    const renderer::image<float> distances;
    const std::vector<view_segment> where; // of all pixels, row by row

  private:
    renderer::picture with(const renderer::picture& surfaces, std::span<const float> visibility) const;

    renderer::picture surfaces_;
};

// A point of the world, and a direction, in the axes of a light.
glm::dvec3 in_light_axes(const renderer::camera& light, const glm::dvec3& vector);

} // namespace gnomon::evaluation
