#include "device_map.hpp"

#include "renderer/vulkan/scene.hpp"

#include <gnomon/passes/mips.hpp>

#include <cstdint>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using usage = vk::ImageUsageFlagBits;
using resources = std::vector<vulkan::resource>;

constexpr std::uint32_t group = 8; // texels along a side of a compute shader's workgroup

} // namespace

device_map::device_map(const device_stage& stage, const std::vector<vk::Format>& formats, const vulkan::shader& resolve,
                       const vulkan::buffer& taps, vk::ImageUsageFlags further_use)
    : stage_(stage), trilinear_(vulkan::trilinear_sampler(stage.gpu()))
{
    const vulkan::device& gpu = stage.gpu();
    const vk::Extent2D extent = stage.depths().extent();
    const std::uint32_t size = extent.width, count = (size + group - 1) / group;
    groups_ = vk::Extent3D(count, count, 1);
    for (const vk::Format format : formats) {
        const auto use = usage::eStorage | usage::eSampled;
        maps_.emplace_back(gpu, format, extent, use | usage::eTransferSrc | usage::eTransferDst | further_use,
                           std::uint32_t(mip_levels(size, size)));
        scratch_.emplace_back(gpu, format, extent, use);
    }
    resolve_.emplace(gpu, resolve,
                     resources{vulkan::sampled{stage.depths()}, vulkan::stored{first()}, vulkan::stored{second()}});
    const vulkan::shader blur{stage.texts().blur};
    const int radius = int(taps.mapped<float>().size() / 2), last = int(size) - 1;
    for (std::size_t i = 0; i < maps_.size(); ++i) {
        const auto pass = [&](const vulkan::image& from, const vulkan::image& to, int dx, int dy) {
            const resources bound{vulkan::sampled{from}, vulkan::stored{to}, taps};
            blur_.push_back({{gpu, blur, bound, sizeof(blur_push)}, {dx, dy, radius, last}});
        };
        pass(maps_[i], scratch_[i], 1, 0);
        pass(scratch_[i], maps_[i], 0, 1);
    }
}

named_pass device_map::resolve() const
{
    return {"resolve", [this](auto& commands) { resolve_->record(commands, groups_); }};
}

named_pass device_map::blur() const
{
    return {"blur", [this](auto& commands) {
                for (const auto& [pass, push] : blur_) pass.record(commands, groups_, vulkan::bytes_of(push));
            }};
}

named_pass device_map::mips() const
{
    return {"mips", [this](auto& commands) {
                for (const vulkan::image& map : maps_) vulkan::build_mips(commands, map);
            }};
}

named_pass device_map::lighting(const vulkan::shader& fragment) const
{
    return stage_.lighting(fragment, {vulkan::sampled{first()}, vulkan::sampled{second()}, *trilinear_});
}

} // namespace gnomon::evaluation
