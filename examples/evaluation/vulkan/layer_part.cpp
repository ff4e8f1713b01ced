#include "evaluation/core/scene.hpp"
#include "evaluation/layered/layered_method.hpp"
#include "layer_comparison.hpp"
#include "parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

table_block differences(const layer_comparison& both)
{
    table_block result{.title = "Layers on the device and on the CPU",
                       .text = fmt::format(
                           "Numbers of the device that have other bits on the CPU, from the same samples: {} tiles, of "
                           "which {} need the plain map alone, with {} layers in {:.1f} MB. A device that neither "
                           "fuses nor approximates has none of them.",
                           both.tiles, both.plain_tiles, both.layers, 1e-6 * double(both.bytes)),
                       .columns = {{.key = "step", .label = "step"},
                                   {.key = "all", .label = "numbers", .digits = 0},
                                   {.key = "differ", .label = "in other bits", .digits = 0, .best = best::low}},
                       .rows = {}};
    const std::pair<const char*, const bit_difference*> steps[]{
        {"clusters of tiles", &both.clusters},  {"grids of layers", &both.grids},
        {"texels of layers", &both.texels},     {"texels of the plain map", &both.plain},
        {"look-ups in one tile", &both.own},    {"in a tile at random", &both.random},
        {"in up to four tiles", &both.blended},
    };
    for (const auto& [step, d] : steps)
        result.rows.push_back({{{"step", step}, {"all", double(d->all)}, {"differ", double(d->differing)}}});
    return result;
}

table_block times(const layer_comparison& both)
{
    table_block result{.title = "The time of layers",
                       .text = "Passes of the device. A tile is clustered, and its layers are filled, by a workgroup.",
                       .columns = {{.key = "pass", .label = "pass"}, {.key = "time", .label = "time, ms", .digits = 2}},
                       .rows = {}};
    for (const device_pass& pass : both.device.passes) {
        std::string label = pass.name;
        std::ranges::replace(label, '_', ' ');
        result.rows.push_back({{{"pass", label}, {"time", pass.milliseconds}}});
    }
    return result;
}

// A quarter of the resolution of the page on motion, since the device may be the CPU, in whole blocks.
layer_sizes sizes_of(const settings& how)
{
    constexpr int block = shading::layer_block;
    const motion_sizes size = motion_sizes_of(how);
    return {size.width, size.height, std::max(size.map_resolution / 4 / block, 1) * block, 4};
}

} // namespace

page_part layer_part(const vulkan::device& gpu, const settings& how)
{
    const auto* scene = dynamic_cast<const motion_scene*>(registry_of<scene_entry>().find("tentacles"));
    if (scene == nullptr) return {};
    progress(vulkan_driver, "layers of " + scene->label);
    const layer_sizes size = sizes_of(how);
    const moving_stage stage = scene->stage(double(size.width) / size.height);
    const layer_comparison both = compare_layers(gpu, (how.hlsl ? hlsl_shaders() : glsl_shaders()).layers, stage, size);
    settings of_pictures = how;
    of_pictures.supersampling = 1;
    write_pictures("layers", of_pictures, both.device,
                   {shade(stage.world, stage.light, both.seen.seen, both.host_visibility), both.host});
    pictures_block pictures = pictures_of({"layers", "Layers", "Tentacles with layered shadows", both.of_whole.errors});
    pictures.is_folded = false;
    pictures.text =
        "Layers of a stochastic shadow map by compute shaders: clusters of depth by bits of 64 bins, sums "
        "of samples that move with the layer, and mip levels. Look-ups follow the footprint of a sample of "
        "the camera, in the receiver's tile or in a neighbour, at random.";
    page_part result{{std::move(pictures), differences(both), times(both)}, {}};
    if (const method* m = registry_of<method>().find(usual_layers)) {
        report_row row = device_row(*m, scene->id, gpu.name(), both.device, both.of_whole.errors, both.receivers);
        row.receiver = camera_samples_kind->id;
        row.map = layers_kind->id;
        row.format = layer_variance_float::id;
        row.map_bytes = double(both.bytes);
        row.bytes_per_texel = row.map_bytes / double(size.map_resolution * size.map_resolution);
        row.build_ms = 0;
        for (const device_pass& pass : both.device.passes)
            if (pass.name == "look_up") row.ns_per_receiver = 1e6 * pass.milliseconds / double(both.receivers);
            else row.build_ms += pass.milliseconds;
        result.rows.push_back(std::move(row));
    }
    return result;
}

} // namespace gnomon::evaluation
