#include "renderer.hpp"

#include "renderer/shade/receivers.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/vulkan/scene.hpp"
#include "spirv.hpp"

#include <gnomon/passes/mips.hpp>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using glm::vec4;
#include "evaluation/vulkan/shaders/view.h"

using usage = vk::ImageUsageFlagBits;

constexpr int repetitions = 3;
constexpr std::uint32_t group = 8; // texels along a side of a compute shader's workgroup

view view_of(const stage& scenery, int map_resolution)
{
    const camera& light = scenery.light;
    const auto [u, v, depth] = vulkan::shadow_rows(light);
    return {.light_rows = {u, v, depth},
            .eye = glm::dvec4(scenery.eye.position, 1),
            .to_light = glm::dvec4(-light.forward, 0),
            .sun = {daylight.sun, 0},
            .sky = {daylight.sky, 0},
            .earth = {daylight.earth, 0},
            .bias = {bias_radius * unit_slope(light, map_resolution), steepest_slope, map_resolution, 0}};
}

vk::Extent2D square(int size) { return {std::uint32_t(size), std::uint32_t(size)}; }

// A method's map, of one image or two, and the passes that make it from a shadow map.
class device_map {
  public:
    device_map(const vulkan::device& gpu, const device_method& method, const vulkan::image& depths,
               const vulkan::buffer& taps, const vulkan::shader& resolve, const vulkan::shader& blur)
        : size_(depths.extent().width), radius_(int(taps.mapped<float>().size() / 2))
    {
        const auto levels = std::uint32_t(mip_levels(size_, size_));
        for (const vk::Format format : method.images) {
            const auto use = usage::eStorage | usage::eSampled;
            maps_.emplace_back(gpu, format, depths.extent(), use | usage::eTransferSrc | usage::eTransferDst, levels);
            scratch_.emplace_back(gpu, format, depths.extent(), use);
        }
        resolve_.emplace(gpu, resolve,
                         resources{vulkan::sampled{depths}, vulkan::stored{first()}, vulkan::stored{second()}});
        for (std::size_t i = 0; i < maps_.size(); ++i) {
            const vulkan::image &map = maps_[i], &scratch = scratch_[i];
            blur_.push_back(
                {{gpu, blur, resources{vulkan::sampled{map}, vulkan::stored{scratch}, taps}, sizeof(blur_push)}, 1, 0});
            blur_.push_back(
                {{gpu, blur, resources{vulkan::sampled{scratch}, vulkan::stored{map}, taps}, sizeof(blur_push)}, 0, 1});
        }
    }

    // Vulkan takes no empty place: of a method of one image both are the same.
    const vulkan::image& first() const { return maps_.front(); }
    const vulkan::image& second() const { return maps_.back(); }

    void resolve(const vk::raii::CommandBuffer& commands) const { resolve_->record(commands, groups()); }
    void blur(const vk::raii::CommandBuffer& commands) const
    {
        for (const auto& [pass, dx, dy] : blur_)
            pass.record(commands, groups(), vulkan::bytes_of(blur_push{dx, dy, radius_, int(size_) - 1}));
    }
    void build_mips(const vk::raii::CommandBuffer& commands) const
    {
        for (const vulkan::image& map : maps_) vulkan::build_mips(commands, map);
    }

  private:
    using resources = std::vector<vulkan::resource>;
    struct blur_push {
        int dx, dy, radius, last;
    };
    struct blur_pass {
        vulkan::compute_pass pass;
        int dx, dy;
    };
    vk::Extent3D groups() const { return {(size_ + group - 1) / group, (size_ + group - 1) / group, 1}; }

    std::uint32_t size_;
    int radius_;
    std::vector<vulkan::image> maps_, scratch_;
    std::optional<vulkan::compute_pass> resolve_;
    std::vector<blur_pass> blur_;
};

struct named_pass {
    std::string name;
    std::function<void(const vk::raii::CommandBuffer&)> record;
};

// Runs all passes in turn, several times over, and keeps the least time of each. The first run does not count: drivers
// compile in it.
std::vector<device_pass> timed(const vulkan::device& gpu, const std::vector<named_pass>& passes)
{
    std::vector<device_pass> result;
    for (const named_pass& pass : passes) result.push_back({pass.name, std::numeric_limits<double>::infinity()});
    const vulkan::timeline times(gpu, std::uint32_t(passes.size()) + 1);
    for (int i = 0; i <= repetitions; ++i) {
        gpu.run([&](const vk::raii::CommandBuffer& commands) {
            std::uint32_t marks = 0;
            times.reset(commands);
            times.mark(commands, marks++);
            for (const named_pass& pass : passes) {
                pass.record(commands);
                times.mark(commands, marks++);
            }
        });
        const std::vector<double> milliseconds = times.milliseconds();
        for (std::size_t k = 0; i > 0 && k < result.size(); ++k)
            result[k].milliseconds = std::min(result[k].milliseconds, milliseconds[k]);
    }
    return result;
}

} // namespace

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
    : gpu_(gpu),
      language_(language),
      eye_rows_(vulkan::clip_rows(scenery.eye)),
      light_rows_(vulkan::clip_rows(scenery.light)),
      vertices_(
          vulkan::filled<glm::vec3>(gpu, vulkan::corners_of(scenery.world), vk::BufferUsageFlagBits::eVertexBuffer)),
      frame_(vulkan::filled<view>(gpu, std::array{view_of(scenery, map_resolution)},
                                  vk::BufferUsageFlagBits::eUniformBuffer)),
      taps_(vulkan::filled<float>(gpu, taps, vk::BufferUsageFlagBits::eStorageBuffer)),
      depths_(gpu, vk::Format::eD32Sfloat, square(map_resolution), usage::eDepthStencilAttachment | usage::eSampled, 1,
              vk::SampleCountFlagBits::e4),
      camera_depth_(gpu, vk::Format::eD32Sfloat, extent, usage::eDepthStencilAttachment),
      camera_picture_(gpu, vk::Format::eR32G32B32A32Sfloat, extent, usage::eColorAttachment | usage::eTransferSrc),
      trilinear_(vulkan::trilinear_sampler(gpu))
{}

bool shadow_renderer::supports(const device_method& method) const
{
    using feature = vk::FormatFeatureFlagBits;
    const auto needed =
        feature::eStorageImage | feature::eSampledImageFilterLinear | feature::eBlitSrc | feature::eBlitDst;
    return gpu_.physical().getFeatures().shaderStorageImageWriteWithoutFormat &&
           std::ranges::all_of(method.images, [&](vk::Format format) {
               return (gpu_.physical().getFormatProperties(format).optimalTilingFeatures & needed) == needed;
           });
}

device_frame shadow_renderer::render(const device_method& method) const
{
    const shader_texts& texts = language_ == shading_language::glsl ? glsl_shaders() : hlsl_shaders();
    const method_shaders& own = texts.methods.at(method.id);
    const vulkan::shader scene{texts.scene};

    const vulkan::raster_target to_map{.depth = depths_, .samples = vk::SampleCountFlagBits::e4};
    const vulkan::raster_pass shadow_map(gpu_, {scene, {}}, to_map, 3, {}, sizeof(light_rows_));
    const device_map map(gpu_, method, depths_, taps_, {own.resolve}, {texts.blur});
    const glm::vec3& sky = daylight.background;
    const vulkan::raster_target to_camera{
        camera_depth_, vk::SampleCountFlagBits::e1, &camera_picture_, {sky.r, sky.g, sky.b, 1}};
    const vulkan::raster_pass lighting(
        gpu_, {scene, vulkan::shader{own.lighting}}, to_camera, 3,
        {vulkan::uniform{frame_}, vulkan::sampled{map.first()}, vulkan::sampled{map.second()}, *trilinear_},
        sizeof(eye_rows_));
    device_frame result;
    result.passes = timed(
        gpu_,
        {
            {"shadow_map",
             [&](auto& commands) { shadow_map.record(commands, vertices_, vulkan::bytes_of(light_rows_)); }},
            {"resolve", [&](auto& commands) { map.resolve(commands); }},
            {"blur", [&](auto& commands) { map.blur(commands); }},
            {"mips", [&](auto& commands) { map.build_mips(commands); }},
            {"lighting", [&](auto& commands) { lighting.record(commands, vertices_, vulkan::bytes_of(eye_rows_)); }},
        });

    const image<glm::vec4> pixels = vulkan::read_back(gpu_, camera_picture_);
    result.colour = picture(pixels.width, pixels.height);
    result.visibility = image<float>(pixels.width, pixels.height);
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i) {
        result.colour.pixels[i] = pixels.pixels[i];
        result.visibility.pixels[i] = pixels.pixels[i].a;
    }
    return result;
}

} // namespace gnomon::evaluation
