// Stochastic rasterization of motion (Akenine-Moller et al. 2007): several samples for each texel of a shadow map, or for
// each pixel of a camera, each at a place and at a time of its own. The tiles are those of the exact rasterizer
// (moving_tiles.hpp). Parallel over tiles; results do not depend on the number of threads.
//
// The samples of a texel are stratified. Sample k of n has its time in stratum k of the shutter interval. Places are
// multi-jittered (Kensler 2013): of r x c = n equal cells of the texel each holds one sample, and so does each of n equal
// columns and of n equal rows. Which sample is in which cell is drawn for each texel.
#pragma once

#include "renderer/scene/moving_scene.hpp"

#include <gnomon/passes/sample_map.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::renderer {

// Places inside of the texel: stratified, random and independent of one another, or its centre for all samples. Times of
// neighbours are independent of one another, but for `even`: stratified places, and times that fill their strata evenly
// over any few neighbours (instant_of_texel), so that filters over these have less noise.
enum class sample_pattern { stratified, jittered, centres, even };

struct sample_options {
    int samples = 4;        // for each texel
    std::uint32_t seed = 0; // samples of unlike seeds are independent of one another
    sample_pattern pattern = sample_pattern::stratified;
};

struct sample_picture {
    int width = 0, height = 0, samples = 0;
    std::vector<stochastic_sample<float>> of; // see sample_map

    sample_map<float> map() const { return {std::size_t(width), std::size_t(height), std::size_t(samples), of}; }
};

// The samples of a scene. Ids are the numbers of triangles, counted through all meshes; motion is that of the seen point
// in this view. Parts of triangles in front of the near plane are left out. Throws std::invalid_argument for a picture
// that is empty or too large, and without samples.
sample_picture rasterize_samples(const moving_scene& world, const moving_camera& eye, int width, int height,
                                 const sample_options& how = {});

} // namespace gnomon::renderer
