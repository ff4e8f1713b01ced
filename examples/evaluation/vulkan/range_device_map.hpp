// A map of depth-time ranges on a Vulkan device (Hong & Oh 2018; Gribel et al. 2010), and its look-up. The host sorts the
// moving triangles into tiles and blocks of texels and sets up their edges for each tile, as the rasterizer on the CPU does.
// All else is computed on the device, a texel for each invocation: the ranges of a texel are counted, a scan turns counts into
// places, a second run writes them, and the same three steps resolve the lists.
#pragma once

#include "passes.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/vulkan/device.hpp"
#include "spirv.hpp"

#include <gnomon/motion/receiver/receiver_path.h>
#include <gnomon/motion/triangle/triangle_setup.h>
#include <gnomon/passes/range/map.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::evaluation {

namespace shading {
using triangle_setup = gnomon::triangle_setup<float>;
using depth_setup = gnomon::depth_setup<float>;
#include "evaluation/vulkan/shaders/tile_record.h"
} // namespace shading

class range_device_map {
  public:
    // Throws std::invalid_argument if the resolution is no multiple of a tile, or if a triangle ever leaves the space between
    // the light's planes.
    range_device_map(const renderer::vulkan::device& gpu, const range_shaders& texts,
                     const renderer::moving_scene& world, const renderer::moving_camera& light, int resolution,
                     float depth_tolerance);
    range_device_map(const range_device_map&) = delete;
    range_device_map& operator=(const range_device_map&) = delete;

    const renderer::vulkan::device& gpu() const { return gpu_; }
    int resolution() const { return resolution_; }

    // The lists of all ranges, and the resolved ones: views of the device's buffers.
    range_map<float> lists() const { return view(first_, *ranges_); }
    range_map<float> resolved() const { return view(resolved_first_, *resolved_); }
    const renderer::vulkan::buffer& resolved_first() const { return resolved_first_; }
    const renderer::vulkan::buffer& resolved_ranges() const { return *resolved_; }

    // All of them build the map anew.
    std::vector<named_pass> passes() const;

  private:
    range_map<float> view(const renderer::vulkan::buffer& first, const renderer::vulkan::buffer& ranges) const;
    std::uint32_t texels() const { return std::uint32_t(resolution_) * std::uint32_t(resolution_); }

    const renderer::vulkan::device& gpu_;
    int resolution_;
    float depth_tolerance_;
    std::optional<renderer::vulkan::buffer> records_, blocks_, members_; // triangles of tiles, and of blocks of texels
    renderer::vulkan::buffer first_, resolved_first_;
    std::optional<renderer::vulkan::buffer> ranges_, resolved_;
    std::optional<renderer::vulkan::compute_pass> fill_, scan_, resolve_, scan_resolved_;
};

// Intensities of receivers, of which the first are static: at the first end of their path, for the time of the path.
class range_look_up {
  public:
    range_look_up(const range_device_map& map, const range_shaders& texts,
                  std::span<const receiver_path<float>> receivers, std::size_t static_ones);

    named_pass pass() const;
    std::span<const float> intensities() const { return intensities_.mapped<const float>(); }

  private:
    std::uint32_t count_, static_, size_;
    renderer::vulkan::buffer receivers_, intensities_;
    renderer::vulkan::compute_pass look_up_;
};

} // namespace gnomon::evaluation
