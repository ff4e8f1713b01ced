// One moving stage while the shutter is open: what the pixels of its camera see, as paths and at times of their own, as
// the light's shadow map sees it, and the reference, the mean of ray tracing at many times.
#pragma once

#include "evaluation/core/report.hpp"
#include "evaluation/core/settings.hpp"
#include "light_receivers.hpp"
#include "map_source.hpp"
#include "renderer/output/image.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/shade/moving_view.hpp"
#include "renderer/trace/tracer.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon::evaluation {

struct motion_sizes {
    int width, height, map_resolution, reference_samples;
};
motion_sizes motion_sizes_of(const settings& how);

// Paths as receivers, with the depth bias and without.
struct path_receivers {
    std::vector<light_receiver> biased, unbiased; // unbiased or none
};

inline constexpr int stochastic_samples = 16; // per pixel, each at a time of its own

class motion_view {
  public:
    // The stage outlives the view.
    motion_view(const renderer::moving_stage& its_stage, const motion_sizes& its_size, bool without_bias);

    // The receivers of `paths`, with the ids of triangles or of surfaces.
    const path_receivers& receivers(bool by_surfaces = false);

    double per_receiver(double seconds) const; // in nanoseconds

    error_statistics errors_of(const renderer::image<float>& estimate) const;

    const renderer::moving_stage& stage;
    const motion_sizes size;
    renderer::reference_picture reference;
    renderer::seen_motion paths, samples;
    std::vector<light_receiver> sample_receivers;
    std::vector<std::size_t> pixels; // that see a surface at some time
    map_source maps;

  private:
    path_receivers by_triangles_;
    std::optional<path_receivers> by_surfaces_;
};

} // namespace gnomon::evaluation
