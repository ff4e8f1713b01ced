// Soft shadows of a directional light with an angular size on a Vulkan device: channels of four moments in floats, resolved
// from the shadow map, their summed-area table by two compute passes, and a fragment shader that searches it for blockers
// and filters it over the penumbra's width. A copy of the table tells how fast the device moves its bytes.
#pragma once

#include "device_stage.hpp"

#include <gnomon/storage/moments4_summed.hpp>

#include <glm/vec2.hpp>

#include <cstddef>

namespace gnomon::evaluation {

struct soft_frame {
    device_frame frame; // with a pass named copy, of the whole table
    renderer::image<format_channels<moments4_summed>> channels;
    renderer::image<moments4_summed::texel> table;
};

// The searches of both sides: at most 27 texels along each axis, which touch 28 x 28.
inline constexpr float widest_search = 27;
inline constexpr std::size_t most_searched = 784;
inline constexpr float umbra_share = 0.01f;

// Width of the penumbra along x and y of the map, in texels per unit of signed depth.
glm::vec2 penumbra_scales(const renderer::stage& scenery, int map_resolution);

class soft_renderer {
  public:
    // The stage has a light with a size.
    soft_renderer(const renderer::vulkan::device& gpu, const renderer::stage& scenery, vk::Extent2D extent,
                  int map_resolution, shading_language language);

    // True if the device can write and read the images of channels and sums in shaders.
    bool supported() const;
    soft_frame render() const;

  private:
    float scale_;
    device_stage stage_;
};

} // namespace gnomon::evaluation
