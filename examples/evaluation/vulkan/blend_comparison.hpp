// A map that translucent surfaces were blended into on a device, against blend (passes/blend.hpp) of the fragments that the
// CPU's rasterizer finds, over the same opaque texels.
//
// A blend may differ by this much, in codes of 16 bits. Vulkan lets a device blend at the precision of the image: the
// channels above and both factors are rounded to half a code, and so are both products. With channels and factors up to
// 1 these are 0.5 alpha + 1 + 1, the result is rounded, at worst down, and that of the CPU to half a code: 4 in all.
// Corners snap to a grid of subpixels; with the CPU's step, that moves the depth and the opacity of a layer that faces the
// light by less than a code each, and by more with a coarser one. The next blends shrink the difference like what lies
// below: a texel may differ by the sum over its layers of these codes times what the layers above let through. A texel at
// the edge of a layer may gain or lose that layer where the device's step is another one.
#pragma once

#include "blended_map.hpp"
#include "side_by_side.hpp"

#include <cstddef>
#include <span>

namespace gnomon::evaluation {

struct blend_difference {
    std::size_t texels = 0, layers = 0;        // touched by translucent surfaces; the most over one texel
    double mean = 0, largest = 0;              // of the difference of channels, in codes
    double mean_allowed = 0, most_allowed = 0; // by the rule above
    double beyond = 0, beyond_inside = 0; // shares of the texels beyond this: of all, and away from edges of layers
    double change = 0;                    // mean change of channels by the blend, in codes
};

// Throws std::invalid_argument if there are no fragments.
blend_difference compare_blend(const renderer::vulkan::device& gpu, const blended_frame& device,
                               std::span<const translucent_fragment> back_to_front);

// Visibility of the sun at the receivers, by the CPU from its own depths and these fragments.
renderer::image<float> blended_visibility(const device_comparison& comparison,
                                          std::span<const translucent_fragment> back_to_front,
                                          std::span<const float> taps);

} // namespace gnomon::evaluation
