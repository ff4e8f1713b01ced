#include "device_stage.hpp"

#include "renderer/shade/shading.hpp"
#include "renderer/vulkan/raster.hpp"
#include "renderer/vulkan/scene.hpp"

#include <cstddef>
#include <memory>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using glm::vec4;
#include "evaluation/vulkan/shaders/view.h"

using usage = vk::ImageUsageFlagBits;

constexpr std::uint32_t vectors = 3; // of a vertex

view view_of(const stage& scenery, int map_resolution, const soft_settings& soft, double radius)
{
    const camera& light = scenery.light;
    const auto [u, v, depth] = vulkan::shadow_rows(light);
    const glm::dvec2 rise = 4. * light.half_extent / (map_resolution * (light.far_distance - light.near_distance));
    return {.light_rows = {u, v, depth},
            .eye = glm::dvec4(scenery.eye.position, 1),
            .to_light = glm::dvec4(-light.forward, 0),
            .sun = {daylight.sun, 0},
            .sky = {daylight.sky, 0},
            .earth = {daylight.earth, 0},
            .bias = {radius * unit_slope(light, map_resolution), steepest_slope, map_resolution, roundings},
            .slope_u = glm::dvec4(rise.x * light.right, 0),
            .slope_v = glm::dvec4(-rise.y * light.up, 0),
            .penumbra = soft.penumbra,
            .table = soft.table};
}

vk::Extent2D square(int size) { return {std::uint32_t(size), std::uint32_t(size)}; }

} // namespace

device_stage::device_stage(const vulkan::device& gpu, const stage& scenery, vk::Extent2D extent, int map_resolution,
                           shading_language language, const soft_settings& soft, double radius)
    : gpu_(gpu),
      texts_(language == shading_language::glsl ? glsl_shaders() : hlsl_shaders()),
      eye_rows_(vulkan::clip_rows(scenery.eye)),
      light_rows_(vulkan::clip_rows(scenery.light)),
      vertices_(vulkan::filled<glm::vec3>(gpu, vulkan::corners_of(opaque_part(scenery.world)),
                                          vk::BufferUsageFlagBits::eVertexBuffer)),
      frame_(vulkan::filled<view>(gpu, std::array{view_of(scenery, map_resolution, soft, radius)},
                                  vk::BufferUsageFlagBits::eUniformBuffer)),
      depths_(gpu, vk::Format::eD32Sfloat, square(map_resolution), usage::eDepthStencilAttachment | usage::eSampled, 1,
              vk::SampleCountFlagBits::e4),
      camera_depth_(gpu, vk::Format::eD32Sfloat, extent,
                    usage::eDepthStencilAttachment | usage::eSampled | usage::eTransferSrc),
      camera_picture_(gpu, vk::Format::eR32G32B32A32Sfloat, extent,
                      usage::eColorAttachment | usage::eSampled | usage::eTransferSrc)
{}

named_pass device_stage::depth_map(std::string name, const vulkan::image& target, vk::SampleCountFlagBits samples) const
{
    const auto pass = std::make_shared<vulkan::raster_pass>(
        gpu_, vulkan::raster_shaders{{texts_.scene}, {}}, vulkan::raster_target{.depth = target, .samples = samples},
        vectors, std::vector<vulkan::resource>{}, sizeof(light_rows_));
    return {std::move(name), [=, this](const vk::raii::CommandBuffer& commands) {
                pass->record(commands, vertices_, vulkan::bytes_of(light_rows_));
            }};
}

named_pass device_stage::lighting(const vulkan::shader& fragment, const std::vector<vulkan::resource>& resources) const
{
    const glm::vec3& sky = daylight.background;
    const vulkan::raster_target target{
        .depth = camera_depth_, .colours = {&camera_picture_}, .background = {sky.r, sky.g, sky.b, 1}};
    std::vector<vulkan::resource> bound{vulkan::uniform{frame_}};
    for (const vulkan::resource& one : resources) bound.push_back(one);
    const auto pass = std::make_shared<vulkan::raster_pass>(gpu_, vulkan::raster_shaders{{texts_.scene}, fragment},
                                                            target, vectors, bound, sizeof(eye_rows_));
    return {"lighting", [=, this](const vk::raii::CommandBuffer& commands) {
                pass->record(commands, vertices_, vulkan::bytes_of(eye_rows_));
            }};
}

device_frame device_stage::run(const std::vector<named_pass>& passes, const vulkan::image& picture) const
{
    device_frame result{{}, {}, timed(gpu_, passes)};
    const image<glm::vec4> pixels = vulkan::read_back(gpu_, picture);
    result.colour = vulkan::without_alpha(pixels);
    result.visibility = image<float>(pixels.width, pixels.height);
    for (std::size_t i = 0; i < pixels.pixels.size(); ++i) result.visibility.pixels[i] = pixels.pixels[i].a;
    return result;
}

} // namespace gnomon::evaluation
