#include "device.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::renderer::vulkan {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr auto every_stage = vk::ShaderStageFlagBits::eAllGraphics | vk::ShaderStageFlagBits::eCompute;

VKAPI_ATTR VkBool32 VKAPI_CALL keep_complaint(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                              const VkDebugUtilsMessengerCallbackDataEXT* data, void* complaints)
{
    static_cast<std::vector<std::string>*>(complaints)->emplace_back(data->pMessage);
    return VK_FALSE;
}

vk::raii::Context load_library()
try {
    return {};
} catch (const std::exception& error) {
    throw unavailable(error.what());
}

vk::raii::Instance make_instance(const vk::raii::Context& context, bool validated)
{
    const vk::ApplicationInfo application("gnomon", 1, nullptr, 0, VK_API_VERSION_1_3);
    std::vector<const char*> layers, extensions;
    if (validated) {
        const auto known = context.enumerateInstanceLayerProperties();
        if (std::ranges::none_of(known, [](const vk::LayerProperties& layer) {
                return std::string_view(layer.layerName) == validation_layer;
            }))
            throw unavailable(std::string(validation_layer) + " is not installed");
        layers.push_back(validation_layer);
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    return {context, vk::InstanceCreateInfo({}, &application, layers, extensions)};
}

std::optional<std::uint32_t> suitable_queue_family(const vk::raii::PhysicalDevice& candidate)
{
    if (candidate.getProperties().apiVersion < VK_API_VERSION_1_3) return {};
    const auto families = candidate.getQueueFamilyProperties();
    const auto needed = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & needed) == needed && families[i].timestampValidBits > 0) return i;
    return {};
}

int rank(const vk::raii::PhysicalDevice& candidate)
{
    constexpr std::array order{vk::PhysicalDeviceType::eDiscreteGpu, vk::PhysicalDeviceType::eIntegratedGpu,
                               vk::PhysicalDeviceType::eVirtualGpu, vk::PhysicalDeviceType::eCpu};
    return int(std::ranges::find(order, candidate.getProperties().deviceType) - order.begin());
}

vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance)
{
    vk::raii::PhysicalDevices all(instance);
    std::erase_if(all, [](const vk::raii::PhysicalDevice& d) { return !suitable_queue_family(d); });
    if (all.empty()) throw unavailable("no device of Vulkan 1.3 with a queue for graphics and compute");
    return std::move(*std::ranges::min_element(all, {}, rank));
}

bool has_full_subgroups(const vk::raii::PhysicalDevice& physical)
{
    return physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features>()
        .get<vk::PhysicalDeviceVulkan13Features>()
        .computeFullSubgroups;
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family)
{
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan13Features> chain;
    chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue);
    const auto has = physical.getFeatures();
    chain.get<vk::PhysicalDeviceFeatures2>()
        .features.setShaderStorageImageWriteWithoutFormat(has.shaderStorageImageWriteWithoutFormat)
        .setDualSrcBlend(has.dualSrcBlend);
    chain.get<vk::PhysicalDeviceVulkan13Features>()
        .setDynamicRendering(true)
        .setSynchronization2(true)
        .setComputeFullSubgroups(has_full_subgroups(physical));
    return {physical, chain.get<vk::DeviceCreateInfo>()};
}

vk::ImageAspectFlagBits aspect_of(vk::Format format)
{
    return format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::raii::ImageView make_view(const device& owner, vk::Image of, vk::Format format, std::uint32_t levels)
{
    return {owner.handle(), {{}, of, vk::ImageViewType::e2D, format, {}, {aspect_of(format), 0, levels, 0, 1}}};
}

vk::DescriptorType type_of(const resource& r)
{
    constexpr std::array types{vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eUniformBuffer,
                               vk::DescriptorType::eSampledImage, vk::DescriptorType::eStorageImage,
                               vk::DescriptorType::eSampler};
    return types[r.index()];
}

} // namespace

device::device(validation checks)
try : complaints_(std::make_unique<std::vector<std::string>>()), context_(load_library()),
    instance_(make_instance(context_, checks == validation::on)) {
    using severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    if (checks == validation::on)
        messenger_ = {instance_,
                      {{},
                       severity::eWarning | severity::eError,
                       vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation,
                       keep_complaint,
                       complaints_.get()}};
    physical_ = choose(instance_);
    const std::uint32_t family = *suitable_queue_family(physical_);
    device_ = make_device(physical_, family);
    queue_ = device_.getQueue(family, 0);
    pool_ = {device_, {vk::CommandPoolCreateFlagBits::eTransient, family}};
} catch (const vk::SystemError& error) {
    throw unavailable(error.what());
}

std::uint32_t device::shuffling_lanes() const
{
    const auto found = physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>()
                           .get<vk::PhysicalDeviceSubgroupProperties>();
    const bool shuffles = (found.supportedStages & vk::ShaderStageFlagBits::eCompute) &&
                          (found.supportedOperations & vk::SubgroupFeatureFlagBits::eShuffle);
    return shuffles && has_full_subgroups(physical_) ? found.subgroupSize : 0;
}

void device::run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const
{
    const vk::raii::CommandBuffers buffers(device_, {*pool_, vk::CommandBufferLevel::ePrimary, 1});
    const vk::raii::CommandBuffer& commands = buffers.front();
    commands.begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    record(commands);
    barrier(commands);
    commands.end();
    const vk::raii::Fence done(device_, vk::FenceCreateInfo());
    queue_.submit(vk::SubmitInfo({}, {}, *commands), *done);
    if (device_.waitForFences(*done, true, UINT64_MAX) != vk::Result::eSuccess)
        throw std::runtime_error(name() + ": commands do not end");
}

vk::raii::DeviceMemory device::allocate(const vk::MemoryRequirements& needed, vk::MemoryPropertyFlags wanted) const
{
    const auto memory = physical_.getMemoryProperties();
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i)
        if ((needed.memoryTypeBits >> i & 1u) && (memory.memoryTypes[i].propertyFlags & wanted) == wanted)
            return {device_, {needed.size, i}};
    throw std::runtime_error(name() + ": no memory that is " + vk::to_string(wanted));
}

void barrier(const vk::raii::CommandBuffer& commands)
{
    constexpr auto all = vk::PipelineStageFlagBits2::eAllCommands | vk::PipelineStageFlagBits2::eHost;
    constexpr auto written = vk::AccessFlagBits2::eMemoryWrite;
    const vk::MemoryBarrier2 memory(all, written, all, written | vk::AccessFlagBits2::eMemoryRead);
    commands.pipelineBarrier2(vk::DependencyInfo({}, memory));
}

buffer::buffer(const device& owner, vk::DeviceSize bytes, vk::BufferUsageFlags usage)
    : bytes_(bytes),
      buffer_(owner.handle(), {{}, bytes, usage}),
      memory_(owner.allocate(buffer_.getMemoryRequirements(),
                             vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent)),
      mapped_(nullptr)
{
    buffer_.bindMemory(*memory_, 0);
    mapped_ = memory_.mapMemory(0, bytes);
}

image::image(const device& owner, vk::Format format, vk::Extent2D extent, vk::ImageUsageFlags usage,
             std::uint32_t levels, vk::SampleCountFlagBits samples)
    : format_(format),
      extent_(extent),
      levels_(levels),
      image_(owner.handle(), {{},
                              vk::ImageType::e2D,
                              format,
                              {extent.width, extent.height, 1},
                              levels,
                              1,
                              samples,
                              vk::ImageTiling::eOptimal,
                              usage}),
      memory_(owner.allocate(image_.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal)),
      whole_(nullptr),
      level0_(nullptr)
{
    image_.bindMemory(*memory_, 0);
    whole_ = make_view(owner, *image_, format, levels);
    level0_ = make_view(owner, *image_, format, 1);
    owner.run([&](const vk::raii::CommandBuffer& commands) {
        const vk::ImageMemoryBarrier2 into_use(
            vk::PipelineStageFlagBits2::eNone, {}, vk::PipelineStageFlagBits2::eAllCommands,
            vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite, vk::ImageLayout::eUndefined,
            vk::ImageLayout::eGeneral, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *image_,
            {aspect_of(format), 0, levels, 0, 1});
        commands.pipelineBarrier2(vk::DependencyInfo({}, {}, {}, into_use));
    });
}

void copy(const vk::raii::CommandBuffer& commands, const image& source, const buffer& target)
{
    const auto [width, height] = source.extent();
    commands.copyImageToBuffer(
        source.handle(), vk::ImageLayout::eGeneral, target.handle(),
        vk::BufferImageCopy(0, 0, 0, {aspect_of(source.format()), 0, 0, 1}, {}, {width, height, 1}));
}

void copy(const vk::raii::CommandBuffer& commands, const image& source, const image& target)
{
    const vk::ImageSubresourceLayers top(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
    const auto [width, height] = source.extent();
    commands.copyImage(source.handle(), vk::ImageLayout::eGeneral, target.handle(), vk::ImageLayout::eGeneral,
                       vk::ImageCopy(top, {}, top, {}, {width, height, 1}));
    barrier(commands);
}

void build_mips(const vk::raii::CommandBuffer& commands, const image& target)
{
    const auto layers = [](std::uint32_t level) {
        return vk::ImageSubresourceLayers(vk::ImageAspectFlagBits::eColor, level, 0, 1);
    };
    const auto corners = [&](std::uint32_t level) {
        const auto extent = [&](std::uint32_t whole) { return std::int32_t(std::max(whole >> level, 1u)); };
        return std::array{vk::Offset3D(0, 0, 0),
                          vk::Offset3D(extent(target.extent().width), extent(target.extent().height), 1)};
    };
    for (std::uint32_t level = 1; level < target.levels(); ++level) {
        const vk::ImageBlit half(layers(level - 1), corners(level - 1), layers(level), corners(level));
        commands.blitImage(target.handle(), vk::ImageLayout::eGeneral, target.handle(), vk::ImageLayout::eGeneral, half,
                           vk::Filter::eLinear);
        barrier(commands);
    }
}

vk::raii::Sampler trilinear_sampler(const device& owner, vk::SamplerAddressMode beyond_rows)
{
    constexpr auto edge = vk::SamplerAddressMode::eClampToEdge;
    return {owner.handle(), vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear,
                                                  vk::SamplerMipmapMode::eLinear, edge, beyond_rows, edge)
                                .setMaxLod(VK_LOD_CLAMP_NONE)};
}

inputs::inputs(const device& owner, const std::vector<resource>& resources, std::size_t push_bytes)
{
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const resource& r : resources) {
        bindings.emplace_back(std::uint32_t(bindings.size()), type_of(r), 1, every_stage);
        sizes.emplace_back(type_of(r), 1);
    }
    const vk::raii::Device& d = owner.handle();
    set_layout_ = {d, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    const vk::PushConstantRange push(every_stage, 0, std::uint32_t(push_bytes));
    pipeline_layout_ = {d, vk::PipelineLayoutCreateInfo({}, 1, &*set_layout_, push_bytes > 0 ? 1u : 0u, &push)};
    if (resources.empty()) return;
    pool_ = {d, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    set_ = std::move(vk::raii::DescriptorSets(d, {*pool_, *set_layout_}).front());
    for (std::uint32_t i = 0; i < resources.size(); ++i) {
        vk::DescriptorBufferInfo buffer_info({}, 0, VK_WHOLE_SIZE);
        vk::DescriptorImageInfo image_info({}, {}, vk::ImageLayout::eGeneral);
        vk::WriteDescriptorSet write(*set_, i, 0, 1, type_of(resources[i]), &image_info, &buffer_info);
        if (const auto* b = std::get_if<0>(&resources[i])) buffer_info.buffer = b->get().handle();
        if (const auto* u = std::get_if<uniform>(&resources[i])) buffer_info.buffer = u->source.handle();
        if (const auto* s = std::get_if<sampled>(&resources[i])) image_info.imageView = s->source.view();
        if (const auto* s = std::get_if<stored>(&resources[i])) image_info.imageView = s->target.level0();
        if (const auto* s = std::get_if<vk::Sampler>(&resources[i])) image_info.sampler = *s;
        d.updateDescriptorSets(write, {});
    }
}

void inputs::bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point, push_constants push) const
{
    if (*set_) commands.bindDescriptorSets(point, *pipeline_layout_, 0, *set_, {});
    if (!push.empty()) commands.pushConstants<std::byte>(*pipeline_layout_, every_stage, 0, push);
}

stage_info::stage_info(const device& owner, const shader& code, vk::ShaderStageFlagBits stage)
    : module_(owner.handle(), vk::ShaderModuleCreateInfo({}, code.spirv.size_bytes(), code.spirv.data())),
      constants_(code.constants)
{
    for (std::uint32_t i = 0; i < constants_.size(); ++i) entries_.emplace_back(i, 4 * i, 4);
    specialization_.setMapEntries(entries_).setData<std::uint32_t>(constants_);
    using flag = vk::PipelineShaderStageCreateFlagBits;
    info_ = {code.fills_subgroups ? flag::eRequireFullSubgroups : vk::PipelineShaderStageCreateFlags(), stage, *module_,
             "main", &specialization_};
}

compute_pass::compute_pass(const device& owner, const shader& code, const std::vector<resource>& resources,
                           std::size_t push_bytes)
    : inputs_(owner, resources, push_bytes),
      pipeline_(owner.handle(), nullptr,
                vk::ComputePipelineCreateInfo({}, stage_info(owner, code, vk::ShaderStageFlagBits::eCompute).get(),
                                              inputs_.layout()))
{}

void compute_pass::record(const vk::raii::CommandBuffer& commands, vk::Extent3D groups, push_constants push) const
{
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    inputs_.bind(commands, vk::PipelineBindPoint::eCompute, push);
    commands.dispatch(groups.width, groups.height, groups.depth);
    barrier(commands);
}

timeline::timeline(const device& owner, std::uint32_t marks)
    : period_(double(owner.physical().getProperties().limits.timestampPeriod)),
      marks_(marks),
      pool_(owner.handle(), {{}, vk::QueryType::eTimestamp, marks})
{}

void timeline::reset(const vk::raii::CommandBuffer& commands) const { commands.resetQueryPool(*pool_, 0, marks_); }

void timeline::mark(const vk::raii::CommandBuffer& commands, std::uint32_t index) const
{
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, index);
}

std::vector<double> timeline::milliseconds() const
{
    const auto [result, times] =
        pool_.getResults<std::uint64_t>(0, marks_, marks_ * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    std::vector<double> lengths;
    for (std::size_t i = 1; i < times.size(); ++i) lengths.push_back(1e-6 * period_ * double(times[i] - times[i - 1]));
    return lengths;
}

} // namespace gnomon::renderer::vulkan
