#include "motion_view.hpp"

#include <algorithm>

namespace gnomon::evaluation {

using namespace renderer;

motion_sizes motion_sizes_of(const settings& how)
{
    const bool full = how.supersampling > 1, tiny = how.width < settings().width;
    const int shrink = full ? 1 : 4;
    return {how.width / shrink, how.height / shrink, full ? how.map_resolution : how.map_resolution / 2,
            tiny ? 64 : 1024};
}

motion_view::motion_view(const moving_stage& its_stage, const motion_sizes& its_size, bool without_bias)
    : stage(its_stage), size(its_size), maps(stage.world, stage.light, size.map_resolution)
{
    const tracer rays(stage.world);
    reference = rays.photograph(stage.light, stage.eye, size.width, size.height, size.reference_samples);
    paths = camera_segments(stage.world, stage.eye, size.width, size.height, depth_tolerance);
    samples = stochastic_visibility(stage.world, stage.eye, size.width, size.height, stochastic_samples);
    by_triangles_.biased = light_receivers_of(paths, stage.light, size.map_resolution);
    if (without_bias) by_triangles_.unbiased = light_receivers_of(paths, stage.light, size.map_resolution, 0);
    sample_receivers = light_receivers_of(samples, stage.light, size.map_resolution);
    for (std::size_t pixel = 0; pixel < reference.visibility.pixels.size(); ++pixel)
        if (!paths(pixel).empty() && reference.coverage.pixels[pixel] > 0) pixels.push_back(pixel);
}

const path_receivers& motion_view::receivers(bool by_surfaces)
{
    if (!by_surfaces) return by_triangles_;
    if (!by_surfaces_) {
        by_surfaces_ = by_triangles_;
        set_ids(by_surfaces_->biased, maps.surface_ids());
        set_ids(by_surfaces_->unbiased, maps.surface_ids());
    }
    return *by_surfaces_;
}

double motion_view::per_receiver(double seconds) const
{
    return 1e9 * seconds / double(std::max<std::size_t>(pixels.size(), 1));
}

error_statistics motion_view::errors_of(const image<float>& estimate) const
{
    std::vector<float> found, expected;
    for (const std::size_t pixel : pixels) {
        found.push_back(estimate.pixels[pixel]);
        expected.push_back(reference.visibility.pixels[pixel]);
    }
    return compare(found, expected);
}

} // namespace gnomon::evaluation
