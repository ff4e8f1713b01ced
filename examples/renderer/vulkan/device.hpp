// Headless Vulkan 1.3 on the RAII handles of vulkan.hpp: a device with one queue, buffers and images with memory of
// their own, compute passes, and times taken on the device.
//
//     const vulkan::device gpu; // throws vulkan::unavailable where there is none
//     const vulkan::buffer input(gpu, bytes), output(gpu, bytes);
//     const vulkan::compute_pass pass(gpu, {spirv}, {input, output}, sizeof(push));
//     gpu.run([&](const vk::raii::CommandBuffer& commands) { pass.record(commands, {groups, 1, 1}, push); });
//     output.mapped<float>() // the results
//
// Images stay in the general layout, and every pass ends with a barrier: a later one sees what an earlier one wrote.
#pragma once

#include <vulkan/vulkan_raii.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::renderer::vulkan {

// Thrown if there is no Vulkan library, driver or suitable device, or no validation layer although one is wanted.
struct unavailable : std::runtime_error {
    using runtime_error::runtime_error;
};

enum class validation { off, on };

// A device with one queue: of those that the loader offers (VK_ICD_FILENAMES restricts them) a graphics card first,
// then a driver on the CPU.
class device {
  public:
    explicit device(validation checks = validation::off);

    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    std::string name() const { return physical_.getProperties().deviceName; }
    bool blends_two_sources() const { return physical_.getFeatures().dualSrcBlend; }
    // Invocations of a subgroup that compute shaders fill and shuffle values in, or 0 if they cannot.
    std::uint32_t shuffling_lanes() const;

    // Warnings and errors of the validation layer so far.
    const std::vector<std::string>& complaints() const { return *complaints_; }

    // Records commands, executes them and waits for their end, after which the host sees what they wrote.
    void run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements& needed, vk::MemoryPropertyFlags wanted) const;

  private:
    std::unique_ptr<std::vector<std::string>> complaints_;
    vk::raii::Context context_;
    vk::raii::Instance instance_ = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
    vk::raii::PhysicalDevice physical_ = nullptr;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
};

// Makes later commands wait for earlier ones and see what they wrote.
void barrier(const vk::raii::CommandBuffer& commands);

// Memory that the host and shaders share.
class buffer {
  public:
    buffer(const device& owner, vk::DeviceSize bytes,
           vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eStorageBuffer);

    template <class T> std::span<T> mapped() const { return {static_cast<T*>(mapped_), bytes_ / sizeof(T)}; }
    vk::Buffer handle() const { return *buffer_; }

  private:
    std::size_t bytes_;
    vk::raii::Buffer buffer_;
    vk::raii::DeviceMemory memory_;
    void* mapped_;
};

// width x height texels, with mip levels or with several samples each.
class image {
  public:
    image(const device& owner, vk::Format format, vk::Extent2D extent, vk::ImageUsageFlags usage,
          std::uint32_t levels = 1, vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1);

    vk::Image handle() const { return *image_; }
    vk::ImageView view() const { return *whole_; }    // all levels, to sample
    vk::ImageView level0() const { return *level0_; } // to write
    vk::Format format() const { return format_; }
    vk::Extent2D extent() const { return extent_; }
    std::uint32_t levels() const { return levels_; }

  private:
    vk::Format format_;
    vk::Extent2D extent_;
    std::uint32_t levels_;
    vk::raii::Image image_;
    vk::raii::DeviceMemory memory_;
    vk::raii::ImageView whole_, level0_;
};

// Copies the texels of level 0 into the buffer, row by row without gaps.
void copy(const vk::raii::CommandBuffer& commands, const image& source, const buffer& target);

// Copies the texels of level 0 into those of an image of the same extent and format.
void copy(const vk::raii::CommandBuffer& commands, const image& source, const image& target);

// Fills the mip levels after the first, each from the one before, with means of 2 x 2 texels.
void build_mips(const vk::raii::CommandBuffer& commands, const image& target);

// Uses of a resource by a shader: all levels of a sampled image, the first level of a stored image, a buffer as uniform
// or, by itself, as storage buffer.
struct sampled {
    const image& source;
};
struct stored {
    const image& target;
};
struct uniform {
    const buffer& source;
};
using resource = std::variant<std::reference_wrapper<const buffer>, uniform, sampled, stored, vk::Sampler>;

// Linear between texels and between mip levels; beyond the edge the outermost texel repeats, or the rows do.
vk::raii::Sampler trilinear_sampler(const device& owner,
                                    vk::SamplerAddressMode beyond_rows = vk::SamplerAddressMode::eClampToEdge);

using push_constants = std::span<const std::byte>;

// The inputs of shaders: resources at set 0, bindings 0, 1, ... in this order, and push constants.
class inputs {
  public:
    inputs(const device& owner, const std::vector<resource>& resources, std::size_t push_bytes);

    vk::PipelineLayout layout() const { return *pipeline_layout_; }
    void bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point, push_constants push) const;

  private:
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout pipeline_layout_ = nullptr;
    vk::raii::DescriptorPool pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
};

// A shader's code, with main as its entry point, and its specialization constants: words with the ids 0, 1, ... One that
// fills subgroups has workgroups of whole subgroups.
struct shader {
    std::span<const std::uint32_t> spirv;
    std::vector<std::uint32_t> constants = {};
    bool fills_subgroups = false;
};

class compute_pass {
  public:
    compute_pass(const device& owner, const shader& code, const std::vector<resource>& resources,
                 std::size_t push_bytes = 0);

    void record(const vk::raii::CommandBuffer& commands, vk::Extent3D groups, push_constants push = {}) const;

  private:
    inputs inputs_;
    vk::raii::Pipeline pipeline_;
};

// A stage of a pipeline while the pipeline is made. Owns everything that the create info points to.
class stage_info {
  public:
    stage_info(const device& owner, const shader& code, vk::ShaderStageFlagBits stage);
    stage_info(const stage_info&) = delete;
    stage_info& operator=(const stage_info&) = delete;

    const vk::PipelineShaderStageCreateInfo& get() const { return info_; }

  private:
    vk::raii::ShaderModule module_;
    std::vector<std::uint32_t> constants_;
    std::vector<vk::SpecializationMapEntry> entries_;
    vk::SpecializationInfo specialization_;
    vk::PipelineShaderStageCreateInfo info_;
};

// Marks on the device's clock.
class timeline {
  public:
    timeline(const device& owner, std::uint32_t marks);

    void reset(const vk::raii::CommandBuffer& commands) const;
    // Sets a mark for the time at which all earlier commands are done.
    void mark(const vk::raii::CommandBuffer& commands, std::uint32_t index) const;

    // The time from each mark to the next.
    std::vector<double> milliseconds() const;

  private:
    double period_; // ns
    std::uint32_t marks_;
    vk::raii::QueryPool pool_;
};

} // namespace gnomon::renderer::vulkan
