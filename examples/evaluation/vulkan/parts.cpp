#include "parts.hpp"

#include "evaluation/core/scene.hpp"
#include "renderer/shade/shading.hpp"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<reference> on_cpu{"cpu", "the same method on the CPU", 40};

constexpr float error_scale = 0.05f; // visibility at which error colours saturate

} // namespace

void write_pictures(const std::string& id, const settings& how, const device_frame& device, const host_picture& host)
{
    const auto write = [&](const char* kind, const picture& whole) {
        write_png(how.folder(vulkan_driver) / (id + kind + ".png"), reduced(whole, how.supersampling));
    };
    tbb::parallel_invoke([&] { write("-device", device.colour); }, [&] { write("-cpu", host.colour); },
                         [&] { write("-difference", error_picture(device.visibility, host.visibility, error_scale)); });
}

void write_pictures(const std::string& id, const settings& how, const device_frame& device, const stage& scenery,
                    const device_comparison& comparison, const image<float>& host)
{
    write_pictures(id, how, device, {shade(scenery.world, scenery.light, comparison.seen(), host), host});
}

pictures_block pictures_of(const compared_pictures& shown)
{
    pictures_block result{
        .title = shown.title,
        .columns = 3,
        .pictures = {
            {shown.id + "-device.png", shown.subject + ", rendered on Vulkan", "Vulkan"},
            {shown.id + "-cpu.png", shown.subject + ", rendered on the CPU", "CPU"},
            {shown.id + "-difference.png",
             fmt::format("Differences of visibility between Vulkan and the CPU: {:.2g} on average, at most {:.2g}",
                         shown.errors.mean_abs, shown.errors.max_abs),
             "difference"}}};
    result.is_folded = true;
    result.key = {{"#2a62cc", fmt::format("the device is brighter; full colour at {:g}", error_scale)},
                  {"#c8232c", "the device is darker"}};
    return result;
}

table_block moved_bytes(const std::string& title, const std::string& text, std::span<const moving_pass> passes,
                        const moving_pass& copy)
{
    table_block result{.title = title,
                       .text = text,
                       .columns = {{.key = "pass", .label = "pass"},
                                   {.key = "time", .label = "time, ms", .digits = 2},
                                   {.key = "bytes", .label = "moved, MB", .digits = 1, .scale = 1e-6},
                                   {.key = "rate", .label = "GB/s", .digits = 2, .scale = 1e-6},
                                   {.key = "share", .label = "of the copy's rate, %", .digits = 0, .scale = 1e2}},
                       .rows = {}};
    const auto add = [&](const moving_pass& pass, bool is_aside) {
        const double rate = pass.bytes / pass.milliseconds;
        result.rows.push_back({{{"pass", pass.label},
                                {"time", pass.milliseconds},
                                {"bytes", pass.bytes},
                                {"rate", rate},
                                {"share", rate * copy.milliseconds / copy.bytes}},
                               {},
                               is_aside});
    };
    for (const moving_pass& pass : passes) add(pass, false);
    add(copy, true);
    return result;
}

double milliseconds_of(const device_frame& frame, std::string_view name)
{
    const auto found = std::ranges::find(frame.passes, name, &device_pass::name);
    if (found == frame.passes.end()) throw std::invalid_argument(fmt::format("no pass has the name {}", name));
    return found->milliseconds;
}

report_row device_row(const method& m, const std::string& scene, const std::string& device, const device_frame& frame,
                      const error_statistics& errors, std::size_t receivers)
{
    report_row row = row_of(m);
    row.scene = scene;
    row.receiver = "slope_biased";
    row.reference = on_cpu->id;
    row.receivers = static_cast<long long>(receivers);
    row.errors = errors;
    row.device = device;
    for (const device_pass& pass : frame.passes) {
        row.passes.emplace_back(pass.name, pass.milliseconds);
        if (pass.name == "lighting") row.ns_per_receiver = 1e6 * pass.milliseconds / double(receivers);
        else if (pass.name != "shadow_map" && pass.name != "copy") row.build_ms += pass.milliseconds;
    }
    return row;
}

} // namespace gnomon::evaluation
