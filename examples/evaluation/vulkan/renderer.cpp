#include "renderer.hpp"

#include "device_map.hpp"
#include "renderer/vulkan/scene.hpp"

#include <algorithm>
#include <stdexcept>

namespace gnomon::evaluation {

using namespace renderer;

device_method device_method_of(const filterable_method& m)
{
    const auto named = [](const device_image& image) {
        for (auto k = VkFormat(1); k <= VK_FORMAT_ASTC_12x12_SRGB_BLOCK; k = VkFormat(k + 1))
            if (vk::to_string(vk::Format(k)) == image.format) return vk::Format(k);
        throw std::invalid_argument("no Vulkan format has the name " + image.format);
    };
    device_method result{m.id, {}};
    for (const device_image& image : m.device->images) result.images.push_back(named(image));
    return result;
}

std::vector<const filterable_method*> device_methods()
{
    std::vector<const filterable_method*> result;
    for (const method* m : methods_in_order())
        if (const auto* one = dynamic_cast<const filterable_method*>(m); one != nullptr && one->device)
            result.push_back(one);
    return result;
}

shadow_renderer::shadow_renderer(const vulkan::device& gpu, const stage& scenery, vk::Extent2D extent,
                                 int map_resolution, std::span<const float> taps, shading_language language)
    : stage_(gpu, scenery, extent, map_resolution, language), taps_(vulkan::filled<float>(gpu, taps))
{}

bool shadow_renderer::supports(const device_method& method) const
{
    using feature = vk::FormatFeatureFlagBits;
    const auto needed =
        feature::eStorageImage | feature::eSampledImageFilterLinear | feature::eBlitSrc | feature::eBlitDst;
    const auto& physical = stage_.gpu().physical();
    return physical.getFeatures().shaderStorageImageWriteWithoutFormat &&
           std::ranges::all_of(method.images, [&](vk::Format format) {
               return (physical.getFormatProperties(format).optimalTilingFeatures & needed) == needed;
           });
}

device_frame shadow_renderer::render(const device_method& method) const
{
    const method_shaders& own = stage_.texts().methods.at(method.id);
    const device_map map(stage_, method.images, {own.resolve}, taps_);
    return stage_.run({stage_.shadow_map(), map.resolve(), map.blur(), map.mips(), map.lighting({own.lighting})});
}

} // namespace gnomon::evaluation
