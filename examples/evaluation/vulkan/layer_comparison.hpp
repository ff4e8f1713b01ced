// A layered shadow map on a Vulkan device against that of the CPU's passes, from the same samples and for the same receivers, by
// the kernels of the library on both.
//
// The device does the operations of the CPU in the same order: extremes and bits of bins have none, motions are summed in the same
// 16 parts, and each texel adds up its samples one after the other. So a device that fuses no product, divides and takes roots with
// correct rounding has the bits of the CPU in clusters, grids, texels and intensities. Elsewhere a sample within roundings of the
// border of a bin or of a texel may be on the other side of it. Hence the tolerance, which 99% of the pixels keep: one of 36
// samples of a texel.
#pragma once

#include "evaluation/layered/stochastic_receivers.hpp"
#include "layer_device_map.hpp"
#include "range_comparison.hpp"
#include "renderer/raster/moving_samples.hpp"

#include <vector>

namespace gnomon::evaluation {

inline constexpr float layer_tolerance = 1.f / 36; // of visibility

struct layer_comparison {
    camera_samples seen{};
    std::size_t receivers = 0, bytes = 0, layers = 0, tiles = 0, plain_tiles = 0;
    device_frame device{};                // the picture, lit by the device's look-ups
    renderer::image<float> host{};        // visibility from the CPU's map
    std::vector<float> host_visibility{}; // of each segment of `seen`
    bit_difference clusters{}, grids{}, texels{}, plain{}, own{}, random{}, blended{};
    difference_statistics of_whole{};
};

// Samples of the light and of the camera in each texel and pixel.
struct layer_sizes {
    int width, height, map_resolution, samples;
};

layer_comparison compare_layers(const renderer::vulkan::device& gpu, const layer_shaders& texts,
                                const renderer::moving_stage& stage, const layer_sizes& size);

} // namespace gnomon::evaluation
