// A filterable shadow map on a Vulkan device, of one image or two, with the passes that make and read it. The passes
// refer to the map.
#pragma once

#include "device_stage.hpp"

#include <optional>
#include <vector>

namespace gnomon::evaluation {

class device_map {
  public:
    // The taps are the weights of the blur.
    device_map(const device_stage& stage, const std::vector<vk::Format>& formats,
               const renderer::vulkan::shader& resolve, const renderer::vulkan::buffer& taps,
               vk::ImageUsageFlags further_use = {});
    device_map(const device_map&) = delete;
    device_map& operator=(const device_map&) = delete;

    const std::vector<renderer::vulkan::image>& images() const { return maps_; }

    named_pass resolve() const; // from the samples of the stage's shadow map
    named_pass blur() const;
    named_pass mips() const;
    named_pass lighting(const renderer::vulkan::shader& fragment) const;

  private:
    struct blur_push {
        int dx, dy, radius, last;
    };
    struct blur_pass {
        renderer::vulkan::compute_pass pass;
        blur_push push;
    };
    // A shader has two places for images. A map of one image is in both.
    const renderer::vulkan::image& first() const { return maps_.front(); }
    const renderer::vulkan::image& second() const { return maps_.back(); }

    const device_stage& stage_;
    vk::Extent3D groups_;
    std::vector<renderer::vulkan::image> maps_, scratch_;
    std::optional<renderer::vulkan::compute_pass> resolve_;
    std::vector<blur_pass> blur_;
    vk::raii::Sampler trilinear_;
};

} // namespace gnomon::evaluation
