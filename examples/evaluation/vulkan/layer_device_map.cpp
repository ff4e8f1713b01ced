#include "layer_device_map.hpp"

#include "renderer/vulkan/exact_arithmetic.hpp"
#include "renderer/vulkan/scene.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

static_assert(shading::layer_block == layer_block && sizeof(layer_receiver<float>) == 15 * sizeof(float));

const std::size_t levels = block_levels(device_layers), each = layer_texels(device_layers);

std::size_t tiles_of(const shading::layer_push& sizes)
{
    const std::size_t side = sizes.width / device_layers.tile;
    return side * side;
}

shading::layer_push sizes_of(const sample_map<float>& samples)
{
    check_shape(samples, "layer_device_map");
    if (samples.width != samples.height || samples.width % layer_block != 0)
        throw std::invalid_argument("layer_device_map: samples of " + std::to_string(samples.width) + " x " +
                                    std::to_string(samples.height) + " texels, not of a square of whole blocks of " +
                                    std::to_string(layer_block));
    const layer_look_up usual;
    return {std::uint32_t(samples.width),
            std::uint32_t(samples.samples),
            0,
            0,
            0,
            usual.reach,
            usual.limit,
            usual.rounding,
            float(layer_variance_float::least_variance)};
}

std::size_t blocks_of(const shading::layer_push& sizes)
{
    return sizes.width / layer_block * (sizes.width / layer_block);
}

std::size_t plain_texels(const shading::layer_push& sizes) { return blocks_of(sizes) * block_texels(device_layers); }

template <class T> vulkan::buffer room_for(const vulkan::device& gpu, std::size_t count)
{
    return {gpu, std::max<std::size_t>(count, 1) * sizeof(T)};
}

} // namespace

layer_device_map::layer_device_map(const vulkan::device& gpu, const layer_shaders& texts,
                                   const sample_map<float>& samples)
    : gpu_(gpu),
      sizes_(sizes_of(samples)),
      samples_(vulkan::filled<stochastic_sample<float>>(gpu, samples.of)),
      tiles_(room_for<shading::tile_layers>(gpu, tiles_of(sizes_))),
      first_(room_for<std::uint32_t>(gpu, tiles_of(sizes_) + 1)),
      blocks_(vulkan::filled<std::uint32_t>(gpu, std::vector<std::uint32_t>(blocks_of(sizes_)))),
      plain_(room_for<layer_sums<float>>(gpu, plain_texels(sizes_)))
{
    const auto pass = [&](std::span<const std::uint32_t> text, const std::vector<vulkan::resource>& resources,
                          std::size_t push) {
        return vulkan::compute_pass(gpu, {vulkan::exact_arithmetic(text)}, resources, push);
    };
    cluster_ = pass(texts.cluster, {samples_, tiles_, first_, blocks_}, sizeof sizes_);
    scan_ = pass(texts.scan, {first_}, sizeof(std::uint32_t));
    fill_plain_ = pass(texts.plain, {samples_, blocks_, plain_}, sizeof sizes_);
    const auto run = [&](std::size_t begin, std::size_t end) {
        const std::vector<named_pass> all = passes();
        gpu.run([&](const vk::raii::CommandBuffer& commands) {
            for (std::size_t i = begin; i < end; ++i) all[i].record(commands);
        });
    };
    run(0, 2);
    const std::size_t layers = first().back();
    grids_.emplace(room_for<layer_grid<float>>(gpu, layers));
    texels_.emplace(room_for<layer_sums<float>>(gpu, layers * each));
    accumulate_ = pass(texts.accumulate, {samples_, tiles_, first_, *grids_, *texels_}, sizeof sizes_);
    run(2, 4);
}

std::span<const layer_grid<float>> layer_device_map::grids() const
{
    return grids_->mapped<const layer_grid<float>>().first(first().back());
}

std::span<const layer_sums<float>> layer_device_map::texels() const
{
    return texels_->mapped<const layer_sums<float>>().first(first().back() * each);
}

std::size_t layer_device_map::bytes() const
{
    return first().size_bytes() + grids().size_bytes() + texels().size_bytes() + blocks().size_bytes() +
           plain().size_bytes();
}

std::vector<named_pass> layer_device_map::passes() const
{
    const auto over_tiles = [this](const std::optional<vulkan::compute_pass>& pass) {
        return [this, &pass](const vk::raii::CommandBuffer& commands) {
            pass->record(commands, {std::uint32_t(tiles_of(sizes_)), 1, 1}, vulkan::bytes_of(sizes_));
        };
    };
    return {{"cluster", over_tiles(cluster_)},
            {"scan",
             [this](const vk::raii::CommandBuffer& commands) {
                 scan_->record(commands, {1, 1, 1}, vulkan::bytes_of(std::uint32_t(tiles_of(sizes_))));
             }},
            {"accumulate", over_tiles(accumulate_)},
            {"plain", [this](const vk::raii::CommandBuffer& commands) {
                 for (std::uint32_t level = 0; level < levels; ++level) {
                     shading::layer_push sizes = sizes_;
                     sizes.level = level;
                     const std::uint32_t groups = ((sizes_.width >> level) + 7) / 8;
                     fill_plain_->record(commands, {groups, groups, 1}, vulkan::bytes_of(sizes));
                 }
             }}};
}

layer_device_look_up::layer_device_look_up(const layer_device_map& map, const layer_shaders& texts,
                                           std::span<const layer_receiver<float>> receivers, layer_tiles tiles)
    : sizes_(map.sizes()),
      receivers_(vulkan::filled(map.gpu(), receivers)),
      intensities_(room_for<float>(map.gpu(), receivers.size())),
      look_up_(
          map.gpu(), {vulkan::exact_arithmetic(texts.look_up)},
          [&] {
              std::vector<vulkan::resource> all = map.looked_up();
              all.emplace_back(receivers_);
              all.emplace_back(intensities_);
              return all;
          }(),
          sizeof sizes_)
{
    sizes_.tiles = static_cast<std::uint32_t>(tiles);
    sizes_.receivers = static_cast<std::uint32_t>(receivers.size());
}

named_pass layer_device_look_up::pass() const
{
    return {"look_up", [this](const vk::raii::CommandBuffer& commands) {
                look_up_.record(commands, {(sizes_.receivers + 63) / 64, 1, 1}, vulkan::bytes_of(sizes_));
            }};
}

} // namespace gnomon::evaluation
