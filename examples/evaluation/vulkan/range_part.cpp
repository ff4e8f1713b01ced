#include "evaluation/core/scene.hpp"
#include "evaluation/motion/range_maps.hpp"
#include "parts.hpp"
#include "range_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

struct compared_scene {
    const motion_scene* of;
    range_comparison both;
};

table_block differences(const std::vector<compared_scene>& all)
{
    table_block result{
        .title = "Ranges on the device and on the CPU",
        .text = fmt::format(
            "Numbers of the device that have other bits on the CPU, which starts each step from what the device has: "
            "ranges of lists, resolved ranges, and intensities of static and of moving receivers. A device that "
            "neither fuses nor approximates has none of them. Visibility differs from that of a map which the CPU "
            "rasterizes and resolves by its own passes, where the order of sums and the times of crossings are "
            "rounded otherwise; 99% of the pixels differ by {:g} thousandths at most.",
            1e3 * double(range_tolerance)),
        .columns = {{.key = "scene", .label = "scene"}},
        .rows = {}};
    const std::pair<const char*, const char*> counts[]{{"lists", "ranges"},
                                                       {"resolved", "resolved ranges"},
                                                       {"static", "static receivers"},
                                                       {"moving", "moving receivers"}};
    for (const auto& [key, label] : counts) {
        result.columns.push_back({.key = key, .label = label, .digits = 0});
        result.columns.push_back({.key = std::string(key) + "_differ", .label = "in other bits", .digits = 0});
    }
    result.columns.push_back({.key = "mean", .label = "visibility, mean, thousandths", .digits = 4, .scale = 1e3});
    result.columns.push_back({.key = "p99", .label = "99%", .digits = 4, .scale = 1e3});
    result.columns.push_back({.key = "largest", .label = "largest", .digits = 3, .scale = 1e3});
    for (const auto& [scene, both] : all) {
        table_row row{{{"scene", scene->label}}};
        const std::pair<const char*, const bit_difference*> steps[]{{"lists", &both.lists},
                                                                    {"resolved", &both.resolved},
                                                                    {"static", &both.static_look_ups},
                                                                    {"moving", &both.moving_look_ups}};
        for (const auto& [key, d] : steps) {
            row.cells.emplace_back(key, double(d->all));
            row.cells.emplace_back(std::string(key) + "_differ", double(d->differing));
        }
        row.cells.emplace_back("mean", both.of_whole.errors.mean_abs);
        row.cells.emplace_back("p99", both.of_whole.p99);
        row.cells.emplace_back("largest", both.of_whole.errors.max_abs);
        result.rows.push_back(std::move(row));
    }
    return result;
}

table_block times(const std::vector<compared_scene>& all)
{
    table_block result{.title = "The time of maps of ranges",
                       .text =
                           "Milliseconds of the device. Lists are counted and written by the same shader, and so "
                           "are resolved lists.",
                       .columns = {{.key = "scene", .label = "scene"}},
                       .rows = {}};
    for (const device_pass& pass : all.front().both.device.passes) {
        std::string label = pass.name;
        std::ranges::replace(label, '_', ' ');
        result.columns.push_back({.key = pass.name, .label = std::move(label), .digits = 2});
    }
    for (const auto& [scene, both] : all) {
        table_row row{{{"scene", scene->label}}};
        for (const device_pass& pass : both.device.passes) row.cells.emplace_back(pass.name, pass.milliseconds);
        result.rows.push_back(std::move(row));
    }
    return result;
}

// Half the resolution of the page on motion, since the device may be the CPU, in whole tiles.
motion_sizes range_sizes_of(const settings& how)
{
    constexpr int tile = int(range_map<float>::tile);
    motion_sizes size = motion_sizes_of(how);
    size.map_resolution = std::max(size.map_resolution / 2 / tile, 1) * tile;
    return size;
}

report_row row_for(const method& m, const std::string& device, const compared_scene& one)
{
    const range_comparison& both = one.both;
    report_row row = device_row(m, one.of->id, device, both.device, both.of_whole.errors, both.receivers);
    row.receiver = "analytic";
    row.map = resolved_lists_kind->id;
    row.format = unresolved_lists({}, 0).format.id;
    row.map_bytes = double(both.bytes);
    row.bytes_per_texel = row.map_bytes / double(both.texels);
    row.build_ms = 0;
    for (const device_pass& pass : both.device.passes)
        if (pass.name == "look_up") row.ns_per_receiver = 1e6 * pass.milliseconds / double(both.receivers);
        else row.build_ms += pass.milliseconds;
    return row;
}

} // namespace

page_part range_part(const vulkan::device& gpu, const settings& how)
{
    const shader_texts& texts = how.hlsl ? hlsl_shaders() : glsl_shaders();
    const motion_sizes size = range_sizes_of(how);
    std::vector<compared_scene> all;
    page_part result;
    for (const char* id : {"random_cubes", "fan"}) {
        const auto* scene = dynamic_cast<const motion_scene*>(registry_of<scene_entry>().find(id));
        if (scene == nullptr) continue;
        progress(vulkan_driver, "ranges of " + scene->label);
        const moving_stage stage = scene->stage(double(size.width) / size.height);
        all.push_back({scene, compare_ranges(gpu, texts.ranges, stage, size)});
        const range_comparison& both = all.back().both;
        settings of_pictures = how;
        of_pictures.supersampling = 1;
        const std::string name = std::string("ranges-") + id;
        write_pictures(name, of_pictures, both.device,
                       {shade(stage.world, stage.light, both.seen, both.host_visibility), both.host});
        pictures_block pictures =
            pictures_of({name, "Ranges: " + scene->label, "Shadows of motion in closed form", both.of_whole.errors});
        pictures.is_folded = all.size() > 1;
        if (all.size() == 1)
            pictures.text =
                "A map of depth-time ranges by compute shaders. The host sorts the triangles into tiles. For each "
                "texel "
                "the device counts the times at which triangles cover it, finds each list its place by a scan, writes "
                "the ranges, and resolves them to those in front. Receivers add up the time for which ranges are in "
                "front of them, static ones at their place, and moving ones along their path.";
        result.blocks.emplace_back(std::move(pictures));
    }
    if (all.empty()) return {};
    result.blocks.insert(result.blocks.begin() + 1, {differences(all), times(all)});
    if (const method* m = registry_of<method>().find("resolved_ranges"))
        for (const compared_scene& one : all) result.rows.push_back(row_for(*m, gpu.name(), one));
    return result;
}

} // namespace gnomon::evaluation
