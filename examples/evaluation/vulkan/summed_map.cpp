#include "summed_map.hpp"

#include "renderer/vulkan/scene.hpp"

#include <gnomon/soft/penumbra.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using usage = vk::ImageUsageFlagBits;
using resources = std::vector<vulkan::resource>;

constexpr auto channels_format = vk::Format::eR32G32B32A32Sfloat;
constexpr auto sums_format = vk::Format::eR32G32B32A32Uint;

struct sums_push {
    glm::ivec2 direction;
    int size;
    float scale;
};

soft_settings settings_of(const stage& scenery, int map_resolution, float scale)
{
    return {.penumbra = {penumbra_scales(scenery, map_resolution), widest_search, 0},
            .table = {float(most_searched), scale, 1 - umbra_share, 0}};
}

} // namespace

glm::vec2 penumbra_scales(const stage& scenery, int map_resolution)
{
    const camera& light = scenery.light;
    const double range = light.far_distance - light.near_distance;
    const auto scale = [&](double angle, double half_extent) {
        return float(penumbra_texels_per_depth(std::tan(0.5 * angle), range, map_resolution / (2 * half_extent)));
    };
    return {scale(scenery.light_size.x, light.half_extent.x), scale(scenery.light_size.y, light.half_extent.y)};
}

soft_renderer::soft_renderer(const vulkan::device& gpu, const stage& scenery, vk::Extent2D extent, int map_resolution,
                             shading_language language)
    : scale_(summed_area_scale(float(most_searched))),
      stage_(gpu, scenery, extent, map_resolution, language, settings_of(scenery, map_resolution, scale_))
{}

bool soft_renderer::supported() const
{
    const auto& physical = stage_.gpu().physical();
    const auto needed = vk::FormatFeatureFlagBits::eStorageImage | vk::FormatFeatureFlagBits::eSampledImage;
    const auto has = [&](vk::Format format) {
        return (physical.getFormatProperties(format).optimalTilingFeatures & needed) == needed;
    };
    return physical.getFeatures().shaderStorageImageWriteWithoutFormat && has(channels_format) && has(sums_format);
}

soft_frame soft_renderer::render() const
{
    const vulkan::device& gpu = stage_.gpu();
    const soft_shaders& own = stage_.texts().soft;
    const vk::Extent2D extent = stage_.depths().extent();
    const auto use = usage::eStorage | usage::eSampled | usage::eTransferSrc;
    const vulkan::image channels(gpu, channels_format, extent, use), along_rows(gpu, sums_format, extent, use),
        table(gpu, sums_format, extent, use), copied(gpu, sums_format, extent, usage::eSampled | usage::eTransferDst);

    const auto in_and_out = [](const vulkan::image& from, const vulkan::image& to) {
        return resources{vulkan::sampled{from}, vulkan::stored{to}};
    };
    const vulkan::compute_pass resolve(
        gpu, {own.resolve}, {vulkan::sampled{stage_.depths()}, vulkan::stored{channels}, vulkan::stored{channels}});
    const vulkan::compute_pass rows(gpu, {own.rows}, in_and_out(channels, along_rows), sizeof(sums_push));
    const vulkan::compute_pass columns(gpu, {own.columns}, in_and_out(along_rows, table), sizeof(sums_push));
    const int size = int(extent.width);
    const std::uint32_t tiles = (extent.width + 7) / 8;
    const sums_push x{{1, 0}, size, scale_}, y{{0, 1}, size, scale_};

    soft_frame result{stage_.run({
                          stage_.shadow_map(),
                          {"resolve",
                           [&](auto& commands) {
                               resolve.record(commands, {tiles, tiles, 1});
                           }},
                          {"rows",
                           [&](auto& commands) {
                               rows.record(commands, {extent.height, 1, 1}, vulkan::bytes_of(x));
                           }},
                          {"columns",
                           [&](auto& commands) {
                               columns.record(commands, {extent.width, 1, 1}, vulkan::bytes_of(y));
                           }},
                          {"copy", [&](auto& commands) { vulkan::copy(commands, table, copied); }},
                          stage_.lighting({own.lighting}, {vulkan::sampled{table}}),
                      }),
                      {},
                      {}};
    result.channels = vulkan::read_back<format_channels<moments4_summed>>(gpu, channels);
    result.table = vulkan::read_back<moments4_summed::texel>(gpu, table);
    return result;
}

} // namespace gnomon::evaluation
