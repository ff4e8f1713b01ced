#include "evaluation/core/scene.hpp"
#include "parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

struct compared_method {
    const filterable_method* of;
    difference_statistics difference;
    std::vector<device_pass> passes;
};

table_block numbers(const std::vector<compared_method>& methods, double tolerance)
{
    table_block result{.title = "Times and differences",
                       .text = "Times are the device's own timestamps. Differences are those of visibility to the CPU.",
                       .columns = {{.key = "method", .label = "method"}, {.key = "format", .label = "format"}},
                       .rows = {}};
    for (const device_pass& pass : methods.front().passes) {
        std::string label = pass.name + ", ms";
        std::ranges::replace(label, '_', ' ');
        result.columns.push_back({.key = pass.name, .label = std::move(label), .digits = 2, .best = best::low});
    }
    const std::pair<const char*, const char*> statistics[]{
        {"mean", "mean"}, {"p99", "99%"}, {"p999", "99.9%"}, {"largest", "largest"}};
    for (const auto& [key, label] : statistics)
        result.columns.push_back(
            {.key = key, .label = fmt::format("{}, thousandths", label), .digits = 3, .scale = 1e3, .best = best::low});
    result.columns.push_back({.key = "beyond",
                              .label = fmt::format("beyond {:g}, per million", 1e3 * tolerance),
                              .digits = 0,
                              .scale = 1e6,
                              .best = best::low,
                              .hint = "receivers that differ by more thousandths than the device may add up to"});
    result.columns.push_back({.key = "at_edges", .label = "of these at edges, %", .digits = 1, .scale = 1e2});
    for (const auto& [m, d, passes] : methods) {
        table_row row{{{"method", m->label},
                       {"format", m->format.label},
                       {"mean", d.errors.mean_abs},
                       {"p99", d.p99},
                       {"p999", d.p999},
                       {"largest", d.errors.max_abs},
                       {"beyond", d.beyond},
                       {"at_edges", d.beyond > 0 ? cell(1 - d.beyond_inside / d.beyond) : cell()}},
                      m->its_family().colour};
        for (const device_pass& pass : passes) row.cells.emplace_back(pass.name, pass.milliseconds);
        result.rows.push_back(std::move(row));
    }
    return result;
}

pictures_block pictures(const compared_method& one)
{
    std::string images;
    for (const device_image& image : one.of->device->images) images += (images.empty() ? "" : " + ") + image.format;
    return pictures_of({one.of->id, fmt::format("{}, {}", one.of->label, images),
                        "The fence scene with " + one.of->label, one.difference.errors});
}

page page_of(const std::string& device, const std::vector<compared_method>& methods,
             const device_comparison& comparison, const settings& how)
{
    const double tolerance = double(comparison.tolerance());
    const compared_method& shown = methods.front();
    page result{
        .driver = vulkan_driver,
        .title = "The same shadows on Vulkan",
        .family = "hard",
        .summary = "Shaders that include the library's package show the shadows of the CPU, to within roundings.",
        .front = shown_picture{shown.of->id + "-device.png",
                               "The fence scene with " + shown.of->label + ", rendered on Vulkan", "On Vulkan"},
        .blocks = {text_block{
            {},
            fmt::format(
                "The scene of the hard shadows on {}, as an engine renders it: a shadow map of {} x {} texels by the "
                "rasterizer with four samples, its resolve to the method's format and a Gaussian of two passes by "
                "compute "
                "shaders, mip levels by blits, and {} x {} pixels lit by a fragment shader that looks the map up "
                "through a "
                "trilinear sampler. The shaders are {} and include the package of the library, the kernels that the "
                "CPU "
                "runs.\n\n"
                "Over {} receivers, differences to the CPU come from what Vulkan leaves to a device: whether a product "
                "and "
                "a sum are fused, in which direction a value is rounded to the map's format, with how many bits a "
                "sampler "
                "weighs texels, how positions are interpolated, and how finely corners are snapped to the grid of "
                "samples. On this device the differences may add up to {:g} thousandths. Beyond that lie receivers at "
                "edges "
                "of shadows or surfaces, where intensity is steep. EVSM in half floats differs most where a device "
                "rounds "
                "half floats toward zero, as Vulkan permits.",
                escaped(device), how.map_resolution, how.map_resolution, how.width, how.height,
                how.hlsl ? "HLSL" : "GLSL", comparison.where().size(), 1e3 * tolerance)}}};
    result.blocks.push_back(numbers(methods, tolerance));
    for (const compared_method& one : methods) result.blocks.push_back(pictures(one));
    return result;
}

void compare_on(const vulkan::device& gpu, const settings& how)
{
    progress(vulkan_driver, gpu.name() + ", shaders from " + (how.hlsl ? "HLSL" : "GLSL"));
    const auto& entry = dynamic_cast<const still_scene&>(registry_of<scene_entry>().at("fence"));
    const stage scenery = entry.stage(double(how.width) / how.height);
    const device_comparison comparison(gpu, scenery, how);
    std::vector<compared_method> methods;
    std::vector<report_row> rows;
    const auto known = device_methods();
    steps all(vulkan_driver, known.size());
    for (const filterable_method* m : known) {
        if (!comparison.possible(*m)) {
            all.begin(m->label + ": skipped, the device lacks its format");
            continue;
        }
        all.begin(m->label);
        const side_by_side both = comparison.render(*m);
        methods.push_back({m, both.difference, both.device.passes});
        write_pictures(m->id, how, both.device, scenery, comparison, both.host);
        rows.push_back(
            device_row(*m, entry.id, gpu.name(), both.device, both.difference.errors, comparison.where().size()));
    }
    if (methods.empty()) return progress(vulkan_driver, "skipped: the device lacks all formats");
    page whole = page_of(gpu.name(), methods, comparison, how);
    for (const auto& part : {translucent_part, soft_part, scattering_part, range_part, layer_part}) {
        const page_part one = part(gpu, how);
        whole.blocks.insert(whole.blocks.end(), one.blocks.begin(), one.blocks.end());
        rows.insert(rows.end(), one.rows.begin(), one.rows.end());
    }
    write_page(how.folder(vulkan_driver), whole);
    merge_report(how.out / "report.json", rows);
}

// The scene of hard_shadows by shaders on a Vulkan device, compared with the same methods on the CPU.
void vulkan_shadows(const settings& how)
{
    std::optional<vulkan::device> gpu;
    try {
        gpu.emplace();
    } catch (const vulkan::unavailable& error) {
        return progress(vulkan_driver, std::string("skipped, no Vulkan device: ") + error.what());
    }
    compare_on(*gpu, how);
}

const registered<driver> entry{
    driver{.id = "vulkan_shadows", .label = "The same shadows on Vulkan", .order = 20, .run = vulkan_shadows}};

} // namespace

} // namespace gnomon::evaluation
