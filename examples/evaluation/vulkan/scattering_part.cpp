#include "parts.hpp"
#include "scattering_comparison.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

double of_texels(const texel_difference& d) { return double(d.differing) / double(d.texels); }

table_block differences(const std::vector<scattering_comparison>& all, bool has_subgroups)
{
    table_block result{
        .title = "Scattering on the device and on the CPU",
        .text =
            "Shares of the texels in which a code differs from the CPU's. The CPU makes texels from single depths, and "
            "averages, of what the device has; it filters moments of its own shadow map. It sums averages in double "
            "and "
            "the device in float: their codes differ by one at most. Visibility on the CPU is looked up in the "
            "device's "
            "averages, and in averages of its own map.",
        .columns = {{.key = "format", .label = "format"},
                    {.key = "nearest", .label = "rectified, per million", .digits = 0, .scale = 1e6},
                    {.key = "filtered", .label = "filtered, mean, codes", .digits = 2},
                    {.key = "groups", .label = "averages by groups, per million", .digits = 0, .scale = 1e6},
                    {.key = "subgroups", .label = "by subgroups, per million", .digits = 0, .scale = 1e6}},
        .rows = {}};
    const std::pair<const char*, const char*> statistics[]{{"look_up", "visibility from the device's averages, mean"},
                                                           {"look_up_p999", "99.9%"},
                                                           {"whole", "from the CPU's own map, mean"},
                                                           {"whole_p999", "99.9%"}};
    for (const auto& [key, label] : statistics)
        result.columns.push_back(
            {.key = key, .label = fmt::format("{}, thousandths", label), .digits = 3, .scale = 1e3});
    for (const scattering_comparison& one : all)
        result.rows.push_back({{{"format", one.name},
                                {"nearest", of_texels(one.nearest)},
                                {"filtered", one.filtered.mean},
                                {"groups", of_texels(one.groups)},
                                {"subgroups", has_subgroups ? cell(of_texels(one.subgroups)) : cell()},
                                {"look_up", one.of_look_up.errors.mean_abs},
                                {"look_up_p999", one.of_look_up.p999},
                                {"whole", one.of_whole.errors.mean_abs},
                                {"whole_p999", one.of_whole.p999}}});
    return result;
}

// Times of passes, beside those of a copy that moves as many bytes.
table_block times(const std::vector<scattering_comparison>& all, const vulkan::device& gpu)
{
    const bool on_cpu = gpu.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    const std::uint32_t lanes = gpu.shuffling_lanes();
    table_block result{
        .title = "The time of rectified maps",
        .text = fmt::format("Passes on {}{}. The ideal time of prefix averages is that of a copy of the map, which "
                            "reads and writes the same "
                            "bytes. Peters et al. 2017 report a pass by groups of 8 x 8 invocations, in which each "
                            "invocation sums its row "
                            "anew: on a GTX 970 with 1.28 times the ideal time for four moments in 64 bits, and 2.1 "
                            "times for six. The other "
                            "pass scans each row in subgroups, {} texels at once.",
                            escaped(gpu.name()),
                            on_cpu ? ", a driver on the CPU, whose times are not those of a graphics card" : "", lanes),
        .columns = {{.key = "format", .label = "format"},
                    {.key = "rectify", .label = "rectify, ms", .digits = 2},
                    {.key = "rectify_moments", .label = "rectify moments, ms", .digits = 2},
                    {.key = "copy", .label = "copy, ms", .digits = 2},
                    {.key = "groups", .label = "averages by groups, times the copy", .digits = 1},
                    {.key = "subgroups", .label = "by subgroups, times the copy", .digits = 1},
                    {.key = "mips", .label = "mip levels, ms", .digits = 2},
                    {.key = "scattering", .label = "scattering, ms", .digits = 2}},
        .rows = {}};
    for (const scattering_comparison& one : all) {
        const auto time = [&](const char* pass) { return milliseconds_of(one.device, pass); };
        const double copy = time("copy");
        result.rows.push_back({{{"format", one.name},
                                {"rectify", time("rectify")},
                                {"rectify_moments", time("rectify_moments")},
                                {"copy", copy},
                                {"groups", time("prefix_groups") / copy},
                                {"subgroups", lanes > 0 ? cell(time("prefix_subgroups") / copy) : cell()},
                                {"mips", time("prefix_mips")},
                                {"scattering", time("scattering")}}});
    }
    return result;
}

report_row row_for(const method& m, const std::string& device, const scattering_comparison& one)
{
    const std::size_t rays = one.host.pixels.size();
    report_row row = device_row(m, "room", device, one.device, one.of_whole.errors, rays);
    row.receiver = "view_rays";
    row.map_bytes = 4. / 3 * double(one.texels) * one.bytes_per_texel;
    row.ns_per_receiver = 1e6 * milliseconds_of(one.device, "scattering") / double(rays);
    row.build_ms = 0;
    for (const char* pass : {"rectify_moments", "prefix_groups", "prefix_mips"})
        row.build_ms += milliseconds_of(one.device, pass);
    return row;
}

} // namespace

page_part scattering_part(const vulkan::device& gpu, const settings& how)
{
    const scattering_stage stage = room_stage(double(how.width) / how.height);
    const scattering_view view(stage, how);
    const std::vector<scattering_comparison> all = compare_scattering(gpu, view, how, paper_filtered);
    if (all.empty()) return {};
    progress(vulkan_driver, "single scattering");
    const scattering_comparison& shown = all.back();
    write_pictures("scattering", how, shown.device, {view.shown(shown.host.pixels), shown.host});
    pictures_block pictures = pictures_of(
        {"scattering", "Single scattering", "The hall with shafts of light by " + shown.name, shown.of_whole.errors});
    pictures.is_folded = false;
    pictures.text =
        "The hall of single scattering. Compute shaders resample the moment shadow map into rectified coordinates and "
        "average its rows, in which a view ray is a prefix at one depth. Another one reads the distance of each pixel "
        "from "
        "the camera's depth buffer, looks up one average and adds the scattered light, by the kernels that the CPU "
        "runs. "
        "Surfaces have the shadows of the moment map on the device and of rays on the CPU; the differences are those "
        "of the "
        "scattering alone.";
    page_part result{{std::move(pictures), differences(all, gpu.shuffling_lanes() > 0), times(all, gpu)}, {}};
    for (const scattering_comparison& one : all)
        if (const method* m = registry_of<method>().find(paper_method(one.format)))
            result.rows.push_back(row_for(*m, gpu.name(), one));
    return result;
}

} // namespace gnomon::evaluation
