// A stage with an area light as the driver of soft shadows measures it: the shadow map's depths, the camera's picture, its
// receivers, and the references that visibilities are compared with.
#pragma once

#include "evaluation/core/settings.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/stage.hpp"
#include "soft_method.hpp"

#include <vector>

namespace gnomon::evaluation {

// The light as its square map of this resolution sees it. Search regions are at most widest_search texels wide.
soft_light soft_light_of(const renderer::area_light& light, int resolution, float widest_search);

// The receivers of a picture, their slopes limited to those of a plane at 80 degrees; pixels has their indices.
std::vector<soft_receiver> soft_receivers_of(const renderer::image<renderer::surface>& seen,
                                             const renderer::camera& light, int resolution,
                                             std::vector<std::size_t>& pixels);

struct soft_stage {
    soft_stage(const renderer::stage& its_scenery, const settings& how);

    soft_light light(float widest_search) const { return soft_light_of(scenery.area(), samples.width, widest_search); }
    soft_depths depths() const { return {samples, centres}; }

    const renderer::stage& scenery;
    depth_map samples;
    renderer::image<std::array<float, 1>> centres;
    renderer::image<renderer::surface> seen;
    std::vector<std::size_t> pixels;
    std::vector<soft_receiver> where, unbiased; // the same receivers without slopes
};

// Visibilities by percentage-closer soft shadows in double, with the same rectangles as the look-ups of tables: what differs
// is reconstruction, of the blockers' depth and of the shadow.
std::vector<float> filtered_visibility(const soft_stage& stage, std::span<const soft_receiver> where,
                                       float widest_search);

// Visibilities by rays to the area of the light: the model of one blocker, bias and resolution are errors too.
std::vector<float> traced_visibility(const soft_stage& stage, int rays);

} // namespace gnomon::evaluation
