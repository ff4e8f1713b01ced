// Filtered shadow maps as an engine has them, headless on Vulkan: a shadow map of four samples by the rasterizer, its
// resolve and its blur by compute shaders, mip levels by blits, and a camera picture whose fragment shader looks the
// map up through a trilinear sampler. The shaders include the packages gnomon.glsl or gnomon.hlsl.
#pragma once

#include "evaluation/core/method.hpp"
#include "renderer/output/image.hpp"
#include "renderer/scene/stage.hpp"
#include "renderer/vulkan/device.hpp"
#include "renderer/vulkan/raster.hpp"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

enum class shading_language { glsl, hlsl };

// A method that has shaders, and the Vulkan formats of its images.
struct device_method {
    std::string id;
    std::vector<vk::Format> images;
};

// Throws std::invalid_argument where Vulkan has no format of a name.
device_method device_method_of(const filterable_method& m);

// The methods of the registry that have a device form, in order.
std::vector<const filterable_method*> device_methods();

struct device_pass {
    std::string name;
    double milliseconds;
};

struct device_frame {
    renderer::picture colour;
    renderer::image<float> visibility; // of the sun; 1 where there is no surface
    std::vector<device_pass> passes;
};

class shadow_renderer {
  public:
    // The stage has a directional light, and its meshes are shaded by the normals of their triangles.
    shadow_renderer(const renderer::vulkan::device& gpu, const renderer::stage& scenery, vk::Extent2D extent,
                    int map_resolution, std::span<const float> taps, shading_language language);

    // True if the device can write the method's images from a shader, halve them and filter them.
    bool supports(const device_method& method) const;
    device_frame render(const device_method& method) const;

  private:
    const renderer::vulkan::device& gpu_;
    shading_language language_;
    std::array<glm::vec4, 4> eye_rows_, light_rows_;
    renderer::vulkan::buffer vertices_, frame_, taps_;
    renderer::vulkan::image depths_, camera_depth_, camera_picture_;
    vk::raii::Sampler trilinear_;
};

} // namespace gnomon::evaluation
