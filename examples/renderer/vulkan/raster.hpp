// Rasterization by Vulkan's graphics pipeline: triangles from one buffer of floats, without indices, into a depth
// buffer and at most one picture.
#pragma once

#include "device.hpp"

#include <array>
#include <optional>

namespace gnomon::renderer::vulkan {

struct raster_shaders {
    shader vertex;
    std::optional<shader> fragment; // without one, depth alone is drawn
};

// The images that are drawn into. They are cleared first, the depth buffer to 1.
struct raster_target {
    const image& depth;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    const image* colour = nullptr;
    std::array<float, 4> background{};
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
