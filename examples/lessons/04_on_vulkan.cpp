// How do the same shadows look on a GPU?
//
// Six passes: depths from the light, a texel of moments for each depth, a blur along x and one along y, mip levels, and
// the camera's picture. The shaders in the folder beside this file include a package of the library and call its
// functions.
#include "04_on_vulkan/shaders.hpp"
#include "renderer/scene/stage.hpp"
#include "renderer/shade/receivers.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/vulkan/raster.hpp"
#include "renderer/vulkan/scene.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/mips.hpp>

#include <glm/vec2.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon::renderer;
using use = vk::ImageUsageFlagBits;

constexpr std::uint32_t side = 1024, width = 960, height = 540;

void draw(const vulkan::device& gpu)
{
    const stage scenery = fence_stage(double(width) / height);
    const camera& light = scenery.light;
    const illumination day;
    const auto light_rows = vulkan::clip_rows(light), eye_rows = vulkan::clip_rows(scenery.eye);
    const auto shadow = vulkan::shadow_rows(light);
    std::vector<glm::vec4> frame(shadow.begin(), shadow.end());
    frame.emplace_back(-light.forward, bias_radius * unit_slope(light, side));
    for (const glm::vec3& colour : {day.sun, day.sky, day.earth}) frame.emplace_back(colour, 0);
    const auto corners =
        vulkan::filled<glm::vec3>(gpu, vulkan::corners_of(scenery.world), vk::BufferUsageFlagBits::eVertexBuffer);
    const auto uniforms = vulkan::filled<glm::vec4>(gpu, frame, vk::BufferUsageFlagBits::eUniformBuffer);
    const auto taps = vulkan::filled<float>(gpu, gnomon::gaussian_weights());

    // What they draw into and read: depths from the light, the map, a scratch map for the blur, and the screen.
    const vk::Format depth = vk::Format::eD32Sfloat, unorm16 = vk::Format::eR16G16B16A16Unorm;
    const auto texels = use::eStorage | use::eSampled | use::eTransferSrc | use::eTransferDst;
    const vulkan::image depths(gpu, depth, {side, side}, use::eDepthStencilAttachment | use::eSampled);
    const vulkan::image map(gpu, unorm16, {side, side}, texels, std::uint32_t(gnomon::mip_levels(side, side)));
    const vulkan::image scratch(gpu, unorm16, {side, side}, texels);
    const vulkan::image screen_depth(gpu, depth, {width, height}, use::eDepthStencilAttachment);
    const vulkan::image screen(gpu, vk::Format::eR32G32B32A32Sfloat, {width, height},
                               use::eColorAttachment | use::eTransferSrc);
    const vk::raii::Sampler trilinear = vulkan::trilinear_sampler(gpu);

    // The passes, with the resources of their shaders in the order of the bindings.
    const vulkan::raster_pass from_light(gpu, {{triangles_vert}, {}}, {depths}, 3, {}, sizeof light_rows);
    const vulkan::compute_pass encode(gpu, {encode_comp}, {vulkan::sampled{depths}, vulkan::stored{map}});
    const vulkan::compute_pass blur_x(gpu, {blur_comp}, {vulkan::sampled{map}, vulkan::stored{scratch}, taps}, 8);
    const vulkan::compute_pass blur_y(gpu, {blur_comp}, {vulkan::sampled{scratch}, vulkan::stored{map}, taps}, 8);
    const vulkan::raster_pass from_eye(
        gpu, {{triangles_vert}, vulkan::shader{lighting_frag}},
        {screen_depth, {&screen}, {day.background.r, day.background.g, day.background.b, 1}}, 3,
        {vulkan::uniform{uniforms}, vulkan::sampled{map}, *trilinear}, sizeof eye_rows);
    gpu.run([&](const vk::raii::CommandBuffer& commands) {
        const vk::Extent3D groups{side / 8, side / 8, 1};
        from_light.record(commands, corners, vulkan::bytes_of(light_rows));
        encode.record(commands, groups);
        blur_x.record(commands, groups, vulkan::bytes_of(glm::ivec2(1, 0)));
        blur_y.record(commands, groups, vulkan::bytes_of(glm::ivec2(0, 1)));
        vulkan::build_mips(commands, map);
        from_eye.record(commands, corners, vulkan::bytes_of(eye_rows));
    });
    write_png("out/lessons/04_on_vulkan.png", vulkan::without_alpha(vulkan::read_back(gpu, screen)));
}

int main()
{
    try {
        draw(vulkan::device());
    } catch (const vulkan::unavailable& missing) {
        std::printf("skipped: no Vulkan device: %s\n", missing.what());
    }
}
