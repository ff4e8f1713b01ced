// Single scattering on a Vulkan device against the CPU, step by step, by the kernels of the library on both. Depths, averages and
// look-ups of the CPU start from what the device has at that step, so that differences of earlier steps do not count. Filtered
// texels and the whole start from what the CPU rasterized itself.
//
// Rectified from texels of the shadow map: both sides do the same operations, so codes differ by one at most, where the device
// rounds the product of a channel and the largest code before it rounds to a code. A device that fuses products moves
// positions by 2^-23 of the map, too, and a texel in a thousand may read the next texel.
//
// Rectified from moments, of each side's own shadow map: the device's sampler weighs texels with 8 bits at least, and small
// differences of moments are large ones of two depths that are close to each other. These have their mean and their variance
// nevertheless: 99% of the texels keep the tolerance of side_by_side.hpp.
//
// Prefix averages: the CPU sums in double and rounds once. On the device each step rounds by 2^-24, and later shares leave half
// of that on the mean: 1024 steps at random come to 2^-20, an eighth of half a code of 16 bits, all in one direction to 2^-15,
// two codes. So codes differ by one in few texels.
//
// Visibility: look-ups in the device's own averages differ by a sampler's weight of two texels, 2^-9 of their difference, and
// by a code of mip levels, which moves an intensity by the weight of the format's bias at most. From depths that the CPU
// rasterized itself all of the above adds up, and the tolerance of side_by_side.hpp applies.
#pragma once

#include "evaluation/core/settings.hpp"
#include "evaluation/scattering/rectified_scene.hpp"
#include "evaluation/scattering/scattering_view.hpp"
#include "rectified_map.hpp"
#include "side_by_side.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// Of texels of the device against those of the CPU, the largest difference of their channels, in codes.
struct texel_difference {
    std::size_t texels = 0, differing = 0, by_more_than_one = 0;
    double mean = 0, p99 = 0, largest = 0;
};

struct scattering_comparison {
    scattering_format format{};
    std::string name{};                    // of the format, for people
    std::size_t texels = 0;                // of a rectified map
    double bytes_per_texel = 0, codes = 0; // the largest code of a channel
    device_frame device{};                 // the picture with scattering, and the visible share of the scattering
    renderer::image<float> host{};         // visible share, from the CPU's own depths
    texel_difference nearest{}, filtered{}, groups{}, subgroups{};
    float look_up_tolerance = 0, whole_tolerance = 0; // of visibility
    difference_statistics of_look_up{}, of_whole{};
};

// The paper's way with filtering, and the id of the registry's method that goes it on the CPU.
inline constexpr rectified_options paper_filtered = paper_options(rectified_source::moments);
std::string paper_method(const scattering_format& format);

// One comparison for each format that the device has: 4 x 16, 6 x 10 and 6 x 16 bits.
std::vector<scattering_comparison> compare_scattering(const renderer::vulkan::device& gpu, const scattering_view& view,
                                                      const settings& how, const rectified_options& options);

} // namespace gnomon::evaluation
