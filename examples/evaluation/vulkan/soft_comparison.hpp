// Soft shadows from a summed-area table on a Vulkan device against the CPU's, by the kernels of the library on both.
//
// The table is exact: from the channels that the device resolved, the CPU's pass makes the same integers, bit by bit.
// Look-ups in that table differ by the roundings of positions and of fused products alone, which move a place by about a
// thousandth of a texel, except where that moves the search region over a line of the grid: 99% of the receivers keep the
// tolerance of side_by_side.hpp for what is stored. From depths that the CPU rasterized itself they keep the one of a
// filter that may be as narrow as a texel.
#pragma once

#include "side_by_side.hpp"
#include "summed_map.hpp"

#include <cstddef>
#include <optional>

namespace gnomon::evaluation {

struct soft_comparison {
    soft_frame device;
    std::size_t wrong_sums = 0;  // texels of the table that differ from the CPU's
    renderer::image<float> host; // visibility from the CPU's own depths
    float look_up_tolerance, whole_tolerance;
    difference_statistics of_look_up, of_whole; // from the device's table, and from the CPU's
};

// The stage has a light with a size. The comparison is of the same stage. Nothing if the device lacks the formats.
std::optional<soft_comparison> compare_soft(const renderer::vulkan::device& gpu, const renderer::stage& scenery,
                                            const device_comparison& comparison, const settings& how);

// The stage of the fence under a sun of three degrees.
renderer::stage sunny_fence(double aspect);

} // namespace gnomon::evaluation
