// Filtered shadow maps as an engine has them, headless on Vulkan: a shadow map of four samples by the rasterizer, its
// resolve and its blur by compute shaders, mip levels by blits, and a camera picture whose fragment shader looks the
// map up through a trilinear sampler. The shaders include the packages gnomon.glsl or gnomon.hlsl.
#pragma once

#include "device_stage.hpp"
#include "evaluation/core/method.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// A method that has shaders, and the Vulkan formats of its images.
struct device_method {
    std::string id;
    std::vector<vk::Format> images;
};

// Throws std::invalid_argument where Vulkan has no format of a name.
device_method device_method_of(const filterable_method& m);

// The methods of the registry that have a device form, in order.
std::vector<const filterable_method*> device_methods();

class shadow_renderer {
  public:
    shadow_renderer(const renderer::vulkan::device& gpu, const renderer::stage& scenery, vk::Extent2D extent,
                    int map_resolution, std::span<const float> taps, shading_language language);

    // True if the device can write the method's images from a shader, halve them and filter them.
    bool supports(const device_method& method) const;
    device_frame render(const device_method& method) const;

  private:
    device_stage stage_;
    renderer::vulkan::buffer taps_;
};

} // namespace gnomon::evaluation
