// A moment shadow map of 4 x 16 UNORM into which translucent surfaces blend on a Vulkan device, back to front over the
// resolved map of opaque ones. The opacity of a fragment needs a channel of its own: a second source of the blend, or the
// alpha of two images with two channels each.
#pragma once

#include "device_stage.hpp"

#include <gnomon/passes/blend.hpp>
#include <gnomon/storage/moments4.hpp>

#include <span>
#include <vector>

namespace gnomon::evaluation {

enum class blend_images { one, two };

struct blended_frame {
    device_frame frame;                                       // with a pass named copy, of the map
    renderer::image<moments4_unorm16::texel> opaque, blended; // before and after the blend
};

class blending_renderer {
  public:
    blending_renderer(const renderer::vulkan::device& gpu, const renderer::stage& scenery, vk::Extent2D extent,
                      int map_resolution, std::span<const float> taps, shading_language language);

    // True if the device blends into such images, and the language has a word for it: HLSL lacks the second source.
    bool supports(blend_images way) const;
    blended_frame render(blend_images way) const;

  private:
    shading_language language_;
    device_stage stage_;
    renderer::vulkan::buffer layers_, taps_;
    renderer::vulkan::image centre_depths_;
};

// The stage of the fence with two dark panes and a column of smoke, whose layers face the light.
renderer::stage smoke_stage(double aspect);

// All fragments of the translucent surfaces that a light sees, those of a texel back to front.
std::vector<translucent_fragment> fragments_of(const renderer::stage& scenery, int map_resolution);

} // namespace gnomon::evaluation
