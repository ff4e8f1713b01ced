#include "raster.hpp"

namespace gnomon::renderer::vulkan {

namespace {

vk::PipelineColorBlendAttachmentState blend_of(drawing kind)
{
    using mask = vk::ColorComponentFlagBits;
    using factor = vk::BlendFactor;
    constexpr auto all = mask::eR | mask::eG | mask::eB | mask::eA;
    const bool second = kind == drawing::translucent_by_second_source;
    const factor above = second ? factor::eSrc1Color : factor::eSrcAlpha;
    const factor below = second ? factor::eOneMinusSrc1Color : factor::eOneMinusSrcAlpha;
    const factor above_alpha = second ? factor::eSrc1Alpha : factor::eSrcAlpha;
    const factor below_alpha = second ? factor::eOneMinusSrc1Alpha : factor::eOneMinusSrcAlpha;
    constexpr auto add = vk::BlendOp::eAdd;
    return {kind != drawing::opaque, above, below, add, above_alpha, below_alpha, add, all};
}

vk::raii::Pipeline make_pipeline(const device& owner, const raster_shaders& shaders, const raster_target& target,
                                 std::uint32_t attributes, vk::PipelineLayout layout)
{
    const stage_info vertex(owner, shaders.vertex, vk::ShaderStageFlagBits::eVertex);
    std::optional<stage_info> fragment;
    std::vector stages{vertex.get()};
    if (shaders.fragment)
        stages.push_back(fragment.emplace(owner, *shaders.fragment, vk::ShaderStageFlagBits::eFragment).get());

    const auto attribute_bytes = std::uint32_t(3 * sizeof(float));
    const vk::VertexInputBindingDescription binding(0, attributes * attribute_bytes);
    std::vector<vk::VertexInputAttributeDescription> described;
    for (std::uint32_t i = 0; i < attributes; ++i)
        described.emplace_back(i, 0, vk::Format::eR32G32B32Sfloat, i * attribute_bytes);
    const vk::PipelineVertexInputStateCreateInfo input({}, binding, described);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);

    const auto [width, height] = target.depth.extent();
    const vk::Viewport viewport(0, 0, float(width), float(height), 0, 1);
    const vk::Rect2D scissor({}, {width, height});
    const vk::PipelineViewportStateCreateInfo view({}, viewport, scissor);
    vk::PipelineRasterizationStateCreateInfo rasterization;
    rasterization.lineWidth = 1;
    const vk::PipelineMultisampleStateCreateInfo samples({}, target.samples);
    const vk::PipelineDepthStencilStateCreateInfo depth({}, true, target.kind == drawing::opaque, vk::CompareOp::eLess);

    std::vector<vk::Format> formats;
    for (const image* colour : target.colours) formats.push_back(colour->format());
    const std::vector blending(formats.size(), blend_of(target.kind));
    const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, blending);
    const vk::PipelineRenderingCreateInfo rendering(0, formats, target.depth.format());
    const vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &view, &rasterization, &samples,
                                              &depth, &blend, nullptr, layout, {}, 0, {}, 0, &rendering);
    return {owner.handle(), nullptr, info};
}

} // namespace

raster_pass::raster_pass(const device& owner, const raster_shaders& shaders, const raster_target& target,
                         std::uint32_t attributes, const std::vector<resource>& resources, std::size_t push_bytes)
    : target_(target),
      vertex_bytes_(attributes * 3 * sizeof(float)),
      inputs_(owner, resources, push_bytes),
      pipeline_(make_pipeline(owner, shaders, target, attributes, inputs_.layout()))
{}

void raster_pass::record(const vk::raii::CommandBuffer& commands, const buffer& vertices, push_constants push) const
{
    const bool opaque = target_.kind == drawing::opaque;
    const auto attachment = [&](const image& whole, const vk::ClearValue& clear) {
        vk::RenderingAttachmentInfo info(whole.level0(), vk::ImageLayout::eGeneral);
        return info.setLoadOp(opaque ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad)
            .setStoreOp(vk::AttachmentStoreOp::eStore)
            .setClearValue(clear);
    };
    const auto depth = attachment(target_.depth, vk::ClearDepthStencilValue(1, 0));
    std::vector<vk::RenderingAttachmentInfo> colours;
    for (const image* colour : target_.colours)
        colours.push_back(attachment(*colour, vk::ClearColorValue(target_.background)));
    commands.beginRendering({{}, {{}, target_.depth.extent()}, 1, 0, colours, &depth});
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline_);
    inputs_.bind(commands, vk::PipelineBindPoint::eGraphics, push);
    commands.bindVertexBuffers(0, vertices.handle(), vk::DeviceSize(0));
    commands.draw(std::uint32_t(vertices.mapped<std::byte>().size() / vertex_bytes_), 1, 0, 0);
    commands.endRendering();
    barrier(commands);
}

} // namespace gnomon::renderer::vulkan
