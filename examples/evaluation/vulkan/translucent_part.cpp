#include "blend_comparison.hpp"
#include "evaluation/core/scene.hpp"
#include "parts.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<still_scene> smoky{scene_facts{.id = "fence_smoke",
                                                .label = "the fence behind smoke and panes",
                                                .order = 12,
                                                .text = "The scene of the fence, with two dark panes and smoke of 24 "
                                                        "layers between the light and the ground. It shows how a "
                                                        "device blends into a moment shadow map."},
                                    smoke_stage};

struct compared_blend {
    blend_images way;
    blended_frame frame;
    blend_difference texels;
    difference_statistics visibility;
};

const char* words(blend_images way)
{
    return way == blend_images::one ? "one image, second source" : "two images, alpha";
}

table_block differences(const std::vector<compared_blend>& all)
{
    table_block result{
        .title = "Texels after the blend",
        .text =
            "Differences of channels to the CPU's blend over the same opaque texels, in codes of 16 bits, over the "
            "texels that a translucent surface touches. Vulkan lets a device round every factor and product to a "
            "code: the allowance is what that adds up to in a texel.",
        .columns =
            {{.key = "way", .label = "blend into"},
             {.key = "layers", .label = "layers, at most", .digits = 0},
             {.key = "change", .label = "change by the blend, codes", .digits = 0},
             {.key = "mean", .label = "difference, mean", .digits = 2, .best = best::low},
             {.key = "largest", .label = "largest", .digits = 0, .best = best::low},
             {.key = "allowed", .label = "allowed, mean", .digits = 1},
             {.key = "beyond", .label = "texels beyond, per million", .digits = 0, .scale = 1e6, .best = best::low},
             {.key = "visibility", .label = "visibility, mean, thousandths", .digits = 3, .scale = 1e3},
             {.key = "p999", .label = "99.9%, thousandths", .digits = 3, .scale = 1e3}},
        .rows = {}};
    for (const compared_blend& one : all)
        result.rows.push_back({{{"way", words(one.way)},
                                {"layers", double(one.texels.layers)},
                                {"change", one.texels.change},
                                {"mean", one.texels.mean},
                                {"largest", one.texels.largest},
                                {"allowed", one.texels.mean_allowed},
                                {"beyond", one.texels.beyond},
                                {"visibility", one.visibility.errors.mean_abs},
                                {"p999", one.visibility.p999}}});
    return result;
}

table_block rates(const std::vector<compared_blend>& all, std::size_t fragments, std::size_t texels)
{
    constexpr double read_and_written = 2 * moments4_unorm16::bytes_per_texel;
    std::vector<moving_pass> passes;
    for (const compared_blend& one : all)
        passes.push_back({fmt::format("blend into {}", words(one.way)), milliseconds_of(one.frame.frame, "blend"),
                          read_and_written * double(fragments)});
    return moved_bytes(
        "The blend's time", fmt::format("{} fragments read and write a texel each.", fragments), passes,
        {"copy of the map", milliseconds_of(all.front().frame.frame, "copy"), read_and_written * double(texels)});
}

} // namespace

page_part translucent_part(const vulkan::device& gpu, const settings& how)
{
    const stage scenery = smoke_stage(double(how.width) / how.height);
    stage opaque = scenery;
    opaque.world = opaque_part(scenery.world);
    const device_comparison comparison(gpu, opaque, how);
    const auto taps = gaussian_weights();
    const vk::Extent2D extent{std::uint32_t(comparison.seen().width), std::uint32_t(comparison.seen().height)};
    const blending_renderer drawn(gpu, scenery, extent, how.map_resolution, taps,
                                  how.hlsl ? shading_language::hlsl : shading_language::glsl);
    const std::vector<translucent_fragment> fragments = fragments_of(scenery, how.map_resolution);
    const image<float> host = blended_visibility(comparison, fragments, taps);

    std::vector<compared_blend> all;
    for (const blend_images way : {blend_images::one, blend_images::two}) {
        if (!drawn.supports(way)) continue;
        blended_frame frame = drawn.render(way);
        const blend_difference texels = compare_blend(gpu, frame, fragments);
        const difference_statistics visibility =
            comparison.difference(frame.frame.visibility, host, comparison.tolerance());
        all.push_back({way, std::move(frame), texels, visibility});
    }
    if (all.empty()) return {};
    progress(vulkan_driver, "translucent surfaces");
    const compared_blend& shown = all.front();
    write_pictures("blend", how, shown.frame.frame, opaque, comparison, host);
    const std::string subject = "Shadows of smoke and of two panes beside those of the fence";
    pictures_block pictures = pictures_of({"blend", "Translucent occluders", subject, shown.visibility.errors});
    pictures.is_folded = false;
    pictures.text =
        "Translucent surfaces blend into the resolved moment map, back to front over the opaque ones. The opacity of a "
        "fragment needs a channel of its own: a second source of the blend, where the device has one, else the alpha "
        "of "
        "two images with two channels each. The smoke and the panes are not drawn, their shadows are.";
    page_part result{
        {std::move(pictures), differences(all), rates(all, fragments.size(), shown.frame.opaque.pixels.size())}, {}};
    if (const method* m = registry_of<method>().find("msm4_unorm16_blended"))
        for (const compared_blend& one : all) {
            report_row row = device_row(*m, smoky->id, gpu.name(), one.frame.frame, one.visibility.errors,
                                        comparison.where().size());
            row.parameters["images"] = one.way == blend_images::one ? 1 : 2;
            result.rows.push_back(std::move(row));
        }
    return result;
}

} // namespace gnomon::evaluation
