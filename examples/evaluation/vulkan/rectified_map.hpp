// A rectified map of a storage format on a Vulkan device (Peters et al. 2017, Sec. 5): resampled from a shadow map by two
// shaders, its prefix averages by two schemes, their mip levels, and the picture with scattering that a compute shader makes
// of the camera's. The passes refer to the map.
#pragma once

#include "device_map.hpp"

#include <gnomon/passes/rectified_map.hpp>

#include <glm/vec4.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

namespace shading {
using glm::vec4;
#include "evaluation/vulkan/shaders/rectified_row.h"
#include "evaluation/vulkan/shaders/rectified_view.h"
} // namespace shading

// A storage format by its id, and the Vulkan formats of the images that hold its channels, one or two.
struct scattering_format {
    std::string id;
    std::vector<vk::Format> images;
};

// What all rectified maps of a stage share: the shadow map with one sample in each texel, that of four moments with four, the
// camera, and the rows.
class rectified_stage {
  public:
    rectified_stage(const device_stage& drawn, const shading::rectified_view& seen, std::span<const rectified_row> rows,
                    std::size_t columns, bool wraps);
    rectified_stage(const rectified_stage&) = delete;
    rectified_stage& operator=(const rectified_stage&) = delete;

    const device_stage& drawn() const { return drawn_; }
    const device_map& moments() const { return moments_; }
    const renderer::vulkan::image& depths() const { return depths_; }
    const renderer::vulkan::image& picture() const { return picture_; } // with scattering; alpha is its visibility
    const renderer::vulkan::buffer& view() const { return view_; }
    const renderer::vulkan::buffer& rows() const { return rows_; }
    vk::Extent2D extent() const { return extent_; }       // of rectified maps
    vk::Sampler trilinear() const { return *trilinear_; } // of shadow maps
    vk::Sampler of_rows() const { return *of_rows_; }     // of rectified maps: rows go round if the frame does

    // The shadow maps, and the camera's picture with shadows from the moments and without scattering.
    std::vector<named_pass> drawing() const;

  private:
    const device_stage& drawn_;
    vk::Extent2D extent_;
    renderer::vulkan::buffer taps_, view_, rows_;
    device_map moments_;
    renderer::vulkan::image depths_, picture_;
    vk::raii::Sampler trilinear_, of_rows_;
};

// The maps of a format. The picture is made from the prefix averages that groups compute.
class rectified_device_map {
  public:
    rectified_device_map(const rectified_stage& where, const scattering_format& format);
    rectified_device_map(const rectified_device_map&) = delete;
    rectified_device_map& operator=(const rectified_device_map&) = delete;

    using images = std::vector<renderer::vulkan::image>;
    const images& nearest() const { return nearest_; }   // from the texels of the shadow map
    const images& filtered() const { return filtered_; } // from its moments
    const images& by_groups() const { return by_groups_; }
    const images& by_subgroups() const { return by_subgroups_; } // of no use if the device cannot shuffle

    // Of the rectified maps: all that follows the drawing. The pass named copy moves what a pass of prefix averages moves.
    std::vector<named_pass> passes() const;

  private:
    const rectified_stage& where_;
    images nearest_, filtered_, by_groups_, by_subgroups_;
    std::optional<renderer::vulkan::compute_pass> rectify_, rectify_moments_, groups_, subgroups_, scattering_;
};

} // namespace gnomon::evaluation
