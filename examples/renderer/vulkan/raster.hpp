// Rasterization by Vulkan's graphics pipeline: triangles from one buffer of floats, without indices, into a depth
// buffer and any number of pictures.
#pragma once

#include "device.hpp"

#include <array>
#include <optional>
#include <vector>

namespace gnomon::renderer::vulkan {

struct raster_shaders {
    shader vertex;
    std::optional<shader> fragment; // without one, depth alone is drawn
};

// Opaque drawing clears all images first, the depth buffer to 1, and keeps the nearest triangle. Translucent drawing adds
// to images that hold opaque surfaces: triangles in front of the depth buffer, which stays as it is, blend over what is
// there in the order of the vertices. Their opacity is the fourth channel that the shader writes, or, with a second
// source, what it writes for each channel at location 0, index 1 (of a device that offers dualSrcBlend).
enum class drawing { opaque, translucent, translucent_by_second_source };

// The images that are drawn into.
struct raster_target {
    const image& depth;
    std::vector<const image*> colours{};
    std::array<float, 4> background{};
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    drawing kind = drawing::opaque;
};

class raster_pass {
  public:
    // A vertex has attributes of three floats each at locations 0, 1, ... The images of the target outlive the pass.
    raster_pass(const device& owner, const raster_shaders& shaders, const raster_target& target,
                std::uint32_t attributes, const std::vector<resource>& resources, std::size_t push_bytes);

    void record(const vk::raii::CommandBuffer& commands, const buffer& vertices, push_constants push) const;

  private:
    raster_target target_;
    vk::DeviceSize vertex_bytes_;
    inputs inputs_;
    vk::raii::Pipeline pipeline_;
};

} // namespace gnomon::renderer::vulkan
