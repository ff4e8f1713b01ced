#include "rectified_map.hpp"

#include "renderer/vulkan/scene.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/mips.hpp>

#include <array>
#include <cstdint>
#include <initializer_list>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using usage = vk::ImageUsageFlagBits;
using resources = std::vector<vulkan::resource>;

constexpr std::uint32_t side = 8, invocations = 128; // of workgroups

std::uint32_t groups(std::uint32_t texels, std::uint32_t of_group) { return (texels + of_group - 1) / of_group; }

// A shader has two places for the images of a map. A map of one image is in both.
resources stored_in(const std::vector<vulkan::image>& map)
{
    return {vulkan::stored{map.front()}, vulkan::stored{map.back()}};
}

resources sampled_from(const std::vector<vulkan::image>& map)
{
    return {vulkan::sampled{map.front()}, vulkan::sampled{map.back()}};
}

vulkan::buffer rows_in(const vulkan::device& gpu, std::span<const rectified_row> rows)
{
    std::vector<shading::rectified_row> result;
    for (const rectified_row& one : rows)
        result.push_back({one.cosine, one.sine, one.range.middle, one.range.scale, one.factor, one.optical_depth});
    return vulkan::filled<shading::rectified_row>(gpu, result);
}

resources all_of(std::initializer_list<resources> parts)
{
    resources result;
    for (const resources& part : parts)
        for (const vulkan::resource& one : part) result.push_back(one);
    return result;
}

} // namespace

rectified_stage::rectified_stage(const device_stage& drawn, const shading::rectified_view& seen,
                                 std::span<const rectified_row> rows, std::size_t columns, bool wraps)
    : drawn_(drawn),
      extent_(std::uint32_t(columns), std::uint32_t(rows.size())),
      taps_(vulkan::filled<float>(drawn.gpu(), gaussian_weights())),
      view_(vulkan::filled<shading::rectified_view>(drawn.gpu(), std::array{seen},
                                                    vk::BufferUsageFlagBits::eUniformBuffer)),
      rows_(rows_in(drawn.gpu(), rows)),
      moments_(drawn, {vk::Format::eR16G16B16A16Unorm}, {drawn.texts().methods.at("msm4_unorm16").resolve}, taps_),
      depths_(drawn.gpu(), vk::Format::eD32Sfloat, drawn.depths().extent(),
              usage::eDepthStencilAttachment | usage::eSampled | usage::eTransferSrc),
      picture_(drawn.gpu(), drawn.camera_picture().format(), drawn.camera_picture().extent(),
               usage::eStorage | usage::eTransferSrc),
      trilinear_(vulkan::trilinear_sampler(drawn.gpu())),
      of_rows_(vulkan::trilinear_sampler(
          drawn.gpu(), wraps ? vk::SamplerAddressMode::eRepeat : vk::SamplerAddressMode::eClampToEdge))
{}

std::vector<named_pass> rectified_stage::drawing() const
{
    return {drawn_.shadow_map(), moments_.resolve(), moments_.mips(),
            drawn_.depth_map("depths", depths_, vk::SampleCountFlagBits::e1),
            moments_.lighting({drawn_.texts().methods.at("msm4_unorm16").lighting})};
}

rectified_device_map::rectified_device_map(const rectified_stage& where, const scattering_format& format)
    : where_(where)
{
    const device_stage& drawn = where.drawn();
    const vulkan::device& gpu = drawn.gpu();
    const vk::Extent2D extent = where.extent();
    for (const vk::Format texel : format.images) {
        const auto use = usage::eStorage | usage::eSampled | usage::eTransferSrc | usage::eTransferDst;
        nearest_.emplace_back(gpu, texel, extent, use);
        filtered_.emplace_back(gpu, texel, extent, use);
        by_groups_.emplace_back(gpu, texel, extent, use, std::uint32_t(mip_levels(extent.width, extent.height)));
        by_subgroups_.emplace_back(gpu, texel, extent, use);
    }
    const rectified_shaders& shared = drawn.texts().rectified;
    const scattering_shaders& own = shared.formats.at(format.id);
    const resources frame{vulkan::uniform{where.view()}, where.rows()};
    rectify_.emplace(gpu, vulkan::shader{own.rectify},
                     all_of({frame, {vulkan::sampled{where.depths()}}, stored_in(nearest_)}));
    rectify_moments_.emplace(
        gpu, vulkan::shader{own.rectify_moments},
        all_of({frame, {vulkan::sampled{where.moments().images().front()}, where.trilinear()}, stored_in(filtered_)}));
    const auto prefix = [&](const images& target) {
        return all_of({sampled_from(filtered_), stored_in(target), {where.rows()}});
    };
    groups_.emplace(gpu, vulkan::shader{shared.prefix_groups}, prefix(by_groups_));
    if (gpu.shuffling_lanes() > 0)
        subgroups_.emplace(gpu, vulkan::shader{shared.prefix_subgroups, {}, true}, prefix(by_subgroups_));
    scattering_.emplace(gpu, vulkan::shader{own.scattering},
                        all_of({frame,
                                sampled_from(by_groups_),
                                {where.of_rows(), vulkan::sampled{drawn.camera_depth()},
                                 vulkan::sampled{drawn.camera_picture()}, vulkan::stored{where.picture()}}}));
}

std::vector<named_pass> rectified_device_map::passes() const
{
    const vk::Extent2D extent = where_.extent();
    const auto count = std::uint32_t(nearest_.size());
    const auto over = [](const vulkan::compute_pass& pass, vk::Extent3D size) {
        return [=, &pass](const vk::raii::CommandBuffer& commands) { pass.record(commands, size); };
    };
    const auto blocks = [](vk::Extent2D size) {
        return vk::Extent3D(groups(size.width, side), groups(size.height, side), 1);
    };
    std::vector<named_pass> result{{"rectify", over(*rectify_, blocks(extent))},
                                   {"rectify_moments", over(*rectify_moments_, blocks(extent))},
                                   {"copy",
                                    [this](auto& commands) {
                                        for (std::size_t i = 0; i < filtered_.size(); ++i)
                                            vulkan::copy(commands, filtered_[i], by_subgroups_[i]);
                                    }},
                                   {"prefix_groups", over(*groups_, {1, groups(extent.height, side), count})}};
    if (subgroups_) {
        const std::uint32_t rows = invocations / where_.drawn().gpu().shuffling_lanes();
        result.push_back({"prefix_subgroups", over(*subgroups_, {1, groups(extent.height, rows), count})});
    }
    result.push_back({"prefix_mips", [this](auto& commands) {
                          for (const vulkan::image& map : by_groups_) vulkan::build_mips(commands, map);
                      }});
    result.push_back({"scattering", over(*scattering_, blocks(where_.picture().extent()))});
    return result;
}

} // namespace gnomon::evaluation
