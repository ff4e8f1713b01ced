// A stage on a Vulkan device, with what all shadow maps of it share: its opaque triangles, a shadow map of four samples
// and the camera's picture.
#pragma once

#include "passes.hpp"
#include "renderer/output/image.hpp"
#include "renderer/scene/stage.hpp"
#include "renderer/shade/receivers.hpp"
#include "renderer/vulkan/device.hpp"
#include "spirv.hpp"

#include <glm/vec4.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// Of soft shadows: the last members of the struct view in shaders/view.h.
struct soft_settings {
    glm::vec4 penumbra{0}, table{0};
};

enum class shading_language { glsl, hlsl };

struct device_frame {
    renderer::picture colour;
    renderer::image<float> visibility; // of the sun; 1 where there is no surface
    std::vector<device_pass> passes;
};

// The roundings of a blended map that its look-up allows for: of two filter passes, and of a blend for each of 24 layers.
inline constexpr float roundings = 26;

class device_stage {
  public:
    // The stage has a directional light, and its meshes are shaded by the normals of their triangles. The radius is that of
    // the map's filter, for the depth bias of surfaces.
    device_stage(const renderer::vulkan::device& gpu, const renderer::stage& scenery, vk::Extent2D extent,
                 int map_resolution, shading_language language, const soft_settings& soft = {},
                 double radius = renderer::bias_radius);

    const renderer::vulkan::device& gpu() const { return gpu_; }
    const shader_texts& texts() const { return texts_; }
    const renderer::vulkan::image& depths() const { return depths_; } // of the shadow map
    const renderer::vulkan::image& camera_depth() const { return camera_depth_; }
    const renderer::vulkan::image& camera_picture() const { return camera_picture_; }
    const renderer::vulkan::buffer& vertices() const { return vertices_; }
    const std::array<glm::vec4, 4>& light_rows() const { return light_rows_; }

    named_pass shadow_map() const { return depth_map("shadow_map", depths_, vk::SampleCountFlagBits::e4); }

    // Draws the depth that the light sees into an image of so many samples.
    named_pass depth_map(std::string name, const renderer::vulkan::image& target,
                         vk::SampleCountFlagBits samples) const;

    // Draws the camera's picture by a fragment shader. Its resources follow the struct view, which is at binding 0.
    named_pass lighting(const renderer::vulkan::shader& fragment,
                        const std::vector<renderer::vulkan::resource>& resources) const;

    // The picture that these passes leave, the camera's or another, and their times.
    device_frame run(const std::vector<named_pass>& passes) const { return run(passes, camera_picture_); }
    device_frame run(const std::vector<named_pass>& passes, const renderer::vulkan::image& picture) const;

  private:
    const renderer::vulkan::device& gpu_;
    const shader_texts& texts_;
    std::array<glm::vec4, 4> eye_rows_, light_rows_;
    renderer::vulkan::buffer vertices_, frame_;
    renderer::vulkan::image depths_, camera_depth_, camera_picture_;
};

} // namespace gnomon::evaluation
