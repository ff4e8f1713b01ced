#include "blended_map.hpp"

#include "device_map.hpp"
#include "renderer/vulkan/raster.hpp"
#include "renderer/vulkan/scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using usage = vk::ImageUsageFlagBits;
using texel = moments4_unorm16::texel;

std::vector<vk::Format> formats_of(blend_images way)
{
    if (way == blend_images::one) return {vk::Format::eR16G16B16A16Unorm};
    return {vk::Format::eR16G16Unorm, vk::Format::eR16G16Unorm};
}

image<texel> texels_of(const device_map& map, const vulkan::device& gpu)
{
    if (map.images().size() == 1) return vulkan::read_back<texel>(gpu, map.images().front());
    using half_texel = std::array<std::uint16_t, 2>;
    const auto first = vulkan::read_back<half_texel>(gpu, map.images()[0]);
    const auto second = vulkan::read_back<half_texel>(gpu, map.images()[1]);
    image<texel> result(first.width, first.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const auto [c1, c2] = first.pixels[i];
        const auto [c3, c4] = second.pixels[i];
        result.pixels[i] = {c1, c2, c3, c4};
    }
    return result;
}

} // namespace

blending_renderer::blending_renderer(const vulkan::device& gpu, const stage& scenery, vk::Extent2D extent,
                                     int map_resolution, std::span<const float> taps, shading_language language)
    : language_(language),
      stage_(gpu, scenery, extent, map_resolution, language),
      layers_(vulkan::filled<glm::vec3>(gpu, vulkan::layers_of(scenery.world, scenery.light),
                                        vk::BufferUsageFlagBits::eVertexBuffer)),
      taps_(vulkan::filled<float>(gpu, taps)),
      centre_depths_(gpu, vk::Format::eD32Sfloat, stage_.depths().extent(), usage::eDepthStencilAttachment)
{}

bool blending_renderer::supports(blend_images way) const
{
    if (way == blend_images::one && (language_ == shading_language::hlsl || !stage_.gpu().blends_two_sources()))
        return false;
    using feature = vk::FormatFeatureFlagBits;
    const auto needed = feature::eStorageImage | feature::eColorAttachmentBlend | feature::eSampledImageFilterLinear |
                        feature::eBlitSrc | feature::eBlitDst;
    const auto found = stage_.gpu().physical().getFormatProperties(formats_of(way).front()).optimalTilingFeatures;
    return (found & needed) == needed;
}

blended_frame blending_renderer::render(blend_images way) const
{
    const vulkan::device& gpu = stage_.gpu();
    const blend_shaders& own = stage_.texts().blend[way == blend_images::one ? 0 : 1];
    const device_map map(stage_, formats_of(way), {own.resolve}, taps_, usage::eColorAttachment);
    const auto& rows = stage_.light_rows();

    // Fragments are at the texels' centres, and so are the opaque depths that hide them.
    const vulkan::raster_pass centre_depths(gpu, {{stage_.texts().scene}, {}}, {.depth = centre_depths_}, 3, {},
                                            sizeof(rows));
    vulkan::raster_target target{.depth = centre_depths_};
    for (const vulkan::image& one : map.images()) target.colours.push_back(&one);
    target.kind =
        way == blend_images::one ? vulkan::drawing::translucent_by_second_source : vulkan::drawing::translucent;
    const vulkan::raster_pass blend(gpu, {{stage_.texts().layer}, vulkan::shader{own.layer}}, target, 2, {},
                                    sizeof(rows));
    const std::vector<named_pass> opaque{stage_.shadow_map(),
                                         map.resolve(),
                                         {"centre_depths", [&](auto& commands) {
                                              centre_depths.record(commands, stage_.vertices(), vulkan::bytes_of(rows));
                                          }}};
    const named_pass blended{"blend", [&](auto& commands) { blend.record(commands, layers_, vulkan::bytes_of(rows)); }};

    std::vector<vulkan::image> copies;
    for (const vulkan::image& one : map.images())
        copies.emplace_back(gpu, one.format(), one.extent(), usage::eSampled | usage::eTransferDst);
    const named_pass copy{"copy", [&](auto& commands) {
                              for (std::size_t i = 0; i < copies.size(); ++i)
                                  vulkan::copy(commands, map.images()[i], copies[i]);
                          }};

    std::vector<named_pass> all = opaque;
    for (const named_pass& pass : {blended, copy, map.blur(), map.mips(), map.lighting({own.lighting})})
        all.push_back(pass);
    blended_frame result{stage_.run(all), {}, {}};
    gpu.run([&](auto& commands) {
        for (const named_pass& pass : opaque) pass.record(commands);
    });
    result.opaque = texels_of(map, gpu);
    gpu.run(blended.record);
    result.blended = texels_of(map, gpu);
    return result;
}

} // namespace gnomon::evaluation
