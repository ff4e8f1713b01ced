// A layered shadow map of moving geometry on a Vulkan device (Andersson et al. 2015), made from samples, and its look-up. A
// workgroup clusters the samples around a tile, a scan finds the layers of each tile their place, and a workgroup fills the layers
// of a tile with their mips. Texels have two moments with opacity, as floats; sizes are those of shaders/layer_sizes.h. The plain
// map of what does not move is stored whole, and filled where a tile looks it up.
#pragma once

#include "passes.hpp"
#include "renderer/vulkan/device.hpp"
#include "spirv.hpp"

#include <gnomon/passes/layers/layer_look_up.hpp>
#include <gnomon/passes/layers/layer_map.hpp>
#include <gnomon/passes/sample_map.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::evaluation {

namespace shading {
using uint = std::uint32_t;
#include "evaluation/vulkan/shaders/layer_sizes.h"
} // namespace shading

inline constexpr layer_settings device_layers{.tile = std::size_t(shading::layer_tile),
                                              .guard = std::size_t(shading::layer_guard),
                                              .texels = std::size_t(shading::layer_side)};

class layer_device_map {
  public:
    // Throws std::invalid_argument if the map of samples is not square, or not of whole blocks of the plain map.
    layer_device_map(const renderer::vulkan::device& gpu, const layer_shaders& texts, const sample_map<float>& samples);
    layer_device_map(const layer_device_map&) = delete;
    layer_device_map& operator=(const layer_device_map&) = delete;

    const renderer::vulkan::device& gpu() const { return gpu_; }
    const shading::layer_push& sizes() const { return sizes_; }

    // Views of the device's buffers, and the bytes of those that look-ups read. `first` is as of layer_map. `blocks` has 1 for each
    // block of the plain map that is filled, and the plain map has its levels one after the other.
    std::span<const shading::tile_layers> tiles() const { return tiles_.mapped<const shading::tile_layers>(); }
    std::span<const std::uint32_t> first() const { return first_.mapped<const std::uint32_t>(); }
    std::span<const layer_grid<float>> grids() const;
    std::span<const layer_sums<float>> texels() const;
    std::span<const std::uint32_t> blocks() const { return blocks_.mapped<const std::uint32_t>(); }
    std::span<const layer_sums<float>> plain() const { return plain_.mapped<const layer_sums<float>>(); }
    std::size_t bytes() const;

    // The buffers of a look-up, in the order of its bindings.
    std::vector<renderer::vulkan::resource> looked_up() const { return {first_, *grids_, *texels_, blocks_, plain_}; }

    // All of them build the map anew.
    std::vector<named_pass> passes() const;

  private:
    const renderer::vulkan::device& gpu_;
    shading::layer_push sizes_;
    renderer::vulkan::buffer samples_, tiles_, first_, blocks_, plain_;
    std::optional<renderer::vulkan::buffer> grids_, texels_;
    std::optional<renderer::vulkan::compute_pass> cluster_, scan_, accumulate_, fill_plain_;
};

// Intensities of receivers by one way to choose tiles.
class layer_device_look_up {
  public:
    layer_device_look_up(const layer_device_map& map, const layer_shaders& texts,
                         std::span<const layer_receiver<float>> receivers, layer_tiles tiles);

    named_pass pass() const;
    std::span<const float> intensities() const { return intensities_.mapped<const float>(); }

  private:
    shading::layer_push sizes_;
    renderer::vulkan::buffer receivers_, intensities_;
    renderer::vulkan::compute_pass look_up_;
};

} // namespace gnomon::evaluation
