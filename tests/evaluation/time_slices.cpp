// Time-dependent shadow maps of scenes: the ramp that has to stay lit, by each bias, and a static scene, whose slices are
// its shadow map.
#include "evaluation/motion/slices.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace gnomon;
using namespace gnomon::evaluation;
using namespace gnomon::renderer;

namespace {

constexpr int resolution = 256, width = 160, height = 90, samples = 4;

// The root mean square of the light that samples of the camera lose, by the nearest texel for look_ups of 0.
template <class Texel> double error_of(const moving_stage& stage, int look_ups)
{
    const time_slices_map<Texel> slices(
        rasterize_samples(stage.world, stage.light, resolution, resolution, {.samples = samples, .seed = 1}));
    const slice_receivers receivers = slice_receivers_of(
        stochastic_visibility(stage.world, stage.eye, width, height, samples), stage.light, resolution);
    REQUIRE(receivers.where.size() > 1000);
    const double lost = std::accumulate(receivers.where.begin(), receivers.where.end(), 0.0, [&](double sum, auto r) {
        const double one = double(time_dependent_intensity(slices.map(), r, look_ups));
        return sum + one * one;
    });
    return std::sqrt(lost / double(receivers.where.size()));
}

} // namespace

TEST_CASE("the lit ramp is lit with the bias for slope and motion, and with neither slope nor the dynamic bias alone")
{
    const moving_stage ramp = lit_ramp(16.0 / 9);
    for (const int look_ups : {0, 1}) {
        CHECK(error_of<time_dependent_sample<float>>(ramp, look_ups) == 0);
        CHECK(error_of<slice_motion<float>>(ramp, look_ups) > 0.2);
        CHECK(error_of<slice_depth<float>>(ramp, look_ups) > 0.4);
    }
}

TEST_CASE("without motion every slice is the shadow map, and all biases give the same")
{
    moving_stage stage = cube_over_plane(16.0 / 9, 0, 2, 0);
    for (std::size_t m = 0; m < stage.world.closing.size(); ++m)
        stage.world.closing[m] = stage.world.open.meshes[m].positions;
    const sample_picture picture =
        rasterize_samples(stage.world, stage.light, resolution, resolution,
                          {.samples = samples, .seed = 1, .pattern = sample_pattern::centres});
    const time_slices_map<slice_depth<float>> depths(picture);
    const time_slices_map<time_dependent_sample<float>> all(picture);
    const auto map = rasterize_depth<1>(stage.world.open, stage.light.at(0), resolution, resolution);
    const auto texels = std::size_t(resolution) * std::size_t(resolution);
    std::size_t others = 0; // at edges that the rasterizer of motion widens
    for (std::size_t i = 0; i < depths.texels.size(); ++i)
        others += !(std::abs(depths.texels[i].z - map.pixels[i % texels][0]) <= 1e-5f);
    CHECK(others < depths.texels.size() / 200);
    const slice_receivers receivers = slice_receivers_of(
        stochastic_visibility(stage.world, stage.eye, width, height, samples), stage.light, resolution);
    CHECK(std::ranges::all_of(receivers.where, [&](const time_dependent_receiver<float>& r) {
        return time_dependent_intensity(depths.map(), r) == time_dependent_intensity(all.map(), r);
    }));
}
