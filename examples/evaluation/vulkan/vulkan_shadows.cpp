#include "evaluation/core/report.hpp"
#include "renderer/output/file.hpp"
#include "renderer/shade/shading.hpp"
#include "side_by_side.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <optional>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr const char* driver_name = "vulkan_shadows";
constexpr float error_scale = 0.05f; // visibility at which error colours saturate

// What the CPU builds of a map is resolve, blur and mip levels too.
report_row row_of(const filterable_method& m, const std::string& scene, const std::string& device,
                  const side_by_side& both, std::size_t receivers)
{
    report_row row = evaluation::row_of(m);
    row.scene = scene;
    row.method = m.label; // as the gallery reads rows
    row.reference = "cpu";
    row.receivers = static_cast<long long>(receivers);
    row.errors = both.difference.errors;
    row.device = device;
    for (const device_pass& pass : both.device.passes) {
        row.passes.emplace_back(pass.name, pass.milliseconds);
        if (pass.name == "lighting") row.ns_per_receiver = 1e6 * pass.milliseconds / double(receivers);
        else if (pass.name != "shadow_map") row.build_ms += pass.milliseconds;
    }
    return row;
}

void compare_on(const vulkan::device& gpu, const settings& how)
{
    progress(driver_name, gpu.name() + ", shaders from " + (how.hlsl ? "HLSL" : "GLSL"));
    const stage scenery = fence_stage(double(how.width) / how.height);
    const device_comparison comparison(gpu, scenery, how);
    const std::filesystem::path folder = how.out / "gallery" / driver_name;
    nlohmann::ordered_json facts{{"scene", scenery.world.name},
                                 {"device", gpu.name()},
                                 {"language", how.hlsl ? "HLSL" : "GLSL"},
                                 {"width", how.width},
                                 {"height", how.height},
                                 {"map_resolution", how.map_resolution},
                                 {"receivers", comparison.where().size()},
                                 {"tolerance", comparison.tolerance()},
                                 {"error_scale", error_scale},
                                 {"methods", nlohmann::json::array()}};
    std::vector<report_row> rows;
    for (const filterable_method* m : device_methods()) {
        if (!comparison.possible(*m)) {
            progress(driver_name, fmt::format("{}: skipped, the device lacks its format", m->label));
            continue;
        }
        progress(driver_name, m->label);
        const side_by_side both = comparison.render(*m);
        const std::string file = fmt::format("method{:02}", rows.size());
        const auto write = [&](const char* kind, const picture& whole) {
            write_png(folder / (file + kind + ".png"), reduced(whole, how.supersampling));
        };
        tbb::parallel_invoke(
            [&] { write("-device", both.device.colour); },
            [&] { write("-cpu", shade(scenery.world, scenery.light, comparison.seen(), both.host)); },
            [&] { write("-difference", error_picture(both.device.visibility, both.host, error_scale)); });

        std::vector<std::string> images;
        for (const vk::Format format : on_device(*m).images) images.push_back(vk::to_string(format));
        const difference_statistics& d = both.difference;
        facts["methods"].push_back({{"method", m->label},
                                    {"format", m->format.label},
                                    {"images", images},
                                    {"file", file},
                                    {"mean", d.errors.mean_abs},
                                    {"median", d.median},
                                    {"p99", d.p99},
                                    {"p999", d.p999},
                                    {"largest", d.errors.max_abs},
                                    {"beyond", d.beyond},
                                    {"beyond_inside", d.beyond_inside},
                                    {"passes", nlohmann::ordered_json::object()}});
        for (const device_pass& pass : both.device.passes)
            facts["methods"].back()["passes"][pass.name] = pass.milliseconds;
        rows.push_back(row_of(*m, scenery.world.name, gpu.name(), both, comparison.where().size()));
    }
    write_file(folder / "facts.json", facts.dump(1));
    merge_report(how.out / "report.json", rows);
}

// The scene of hard_shadows by shaders on a Vulkan device, compared with the same methods on the CPU.
void vulkan_shadows(const settings& how)
{
    std::optional<vulkan::device> gpu;
    try {
        gpu.emplace();
    } catch (const vulkan::unavailable& error) {
        return progress(driver_name, std::string("skipped, no Vulkan device: ") + error.what());
    }
    compare_on(*gpu, how);
}

const registered<driver> entry{
    driver{.id = "vulkan_shadows", .label = "The same shadows on Vulkan", .order = 20, .run = vulkan_shadows}};

} // namespace

} // namespace gnomon::evaluation
