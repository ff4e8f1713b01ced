// A map of depth-time ranges on a Vulkan device against the CPU's, step by step, by the kernels of the library on both. Each
// step on the CPU starts from what the device has at that step.
//
// Lists: triangles of a tile are the same floats on both sides, and so are the kernels and the order of ranges. On a device that
// fuses no product and divides and takes roots with correct rounding, ranges have the bits of the rasterizer's on the CPU. Resolved
// lists and look-ups alike: the CPU walks the device's lists by range_front.h and looks its resolved lists up by the passes of
// passes/range/look_up.hpp, for moving receivers by the general one, which calls the kernels in the order of the shader. Vulkan
// promises divisions to 2.5 units in the last place and lets a device fuse: there, bits differ, within the errors that the kernels
// state.
//
// The whole: the CPU's map comes from its rasterizer, which resolves lists by insertion, and its look-up adds up ranges that touch
// as one. Each of at most 16 ranges adds up to 97 2^-24 on either side, 2 10^-4 together. Where two ranges cross, the one in front
// changes up to (80 z / d + 4) 2^-24 late on either side, d the change of their distance: 10^-4 of the shutter for d above 0.1.
// Twice the sum of both is the tolerance, which 99% of the pixels keep; beyond it are those that see a surface which two ranges
// less far apart shadow.
#pragma once

#include "evaluation/motion/motion_scene.hpp"
#include "evaluation/motion/motion_view.hpp"
#include "range_device_map.hpp"
#include "side_by_side.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

inline constexpr float range_tolerance = 6e-4f; // of visibility

// Numbers that the CPU has in other bits, of all numbers of a step.
struct bit_difference {
    std::size_t all = 0, differing = 0;
};

struct range_comparison {
    renderer::seen_motion seen{};
    std::size_t receivers = 0, static_receivers = 0;
    std::size_t bytes = 0, texels = 0;    // of the resolved map
    device_frame device{};                // the picture, lit by the device's look-ups
    renderer::image<float> host{};        // visibility from the CPU's own map
    std::vector<float> host_visibility{}; // of each path of `seen`
    bit_difference lists{}, resolved{}, static_look_ups{}, moving_look_ups{};
    difference_statistics of_whole{};
};

range_comparison compare_ranges(const renderer::vulkan::device& gpu, const range_shaders& texts,
                                const renderer::moving_stage& stage, const motion_sizes& size);

} // namespace gnomon::evaluation
