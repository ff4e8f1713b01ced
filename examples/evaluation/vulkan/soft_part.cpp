#include "parts.hpp"
#include "soft_comparison.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

table_block differences(const soft_comparison& both)
{
    table_block result{
        .title = "Soft shadows on the device and on the CPU",
        .text =
            fmt::format("Differences of visibility, from the device's table and from the table that the CPU makes of "
                        "its own depths. Texels of the device's table that differ from the CPU's table of the same "
                        "channels: {} of {}.",
                        both.wrong_sums, both.device.table.pixels.size()),
        .columns = {{.key = "table", .label = "the CPU's look-ups in"},
                    {.key = "mean", .label = "mean, thousandths", .digits = 3, .scale = 1e3},
                    {.key = "p99", .label = "99%, thousandths", .digits = 3, .scale = 1e3},
                    {.key = "p999", .label = "99.9%, thousandths", .digits = 3, .scale = 1e3},
                    {.key = "largest", .label = "largest, thousandths", .digits = 3, .scale = 1e3}},
        .rows = {}};
    const auto add = [&](const char* table, const difference_statistics& d) {
        result.rows.push_back({{{"table", table},
                                {"mean", d.errors.mean_abs},
                                {"p99", d.p99},
                                {"p999", d.p999},
                                {"largest", d.errors.max_abs}}});
    };
    add("the device's table", both.of_look_up);
    add("a table of its own", both.of_whole);
    return result;
}

table_block rates(const soft_comparison& both)
{
    const auto texels = double(both.device.table.pixels.size());
    constexpr double of_depths = 16, of_channels = 16, of_sums = moments4_summed::bytes_per_texel;
    const auto pass = [&](const char* label, const char* name, double bytes) {
        return moving_pass{label, milliseconds_of(both.device.frame, name), bytes * texels};
    };
    const moving_pass passes[]{pass("resolve to channels in floats", "resolve", of_depths + of_channels),
                               pass("codes and their sums along rows", "rows", of_channels + of_sums),
                               pass("sums along columns", "columns", 2 * of_sums)};
    return moved_bytes("The table's time",
                       fmt::format("Passes that make the table, beside a copy of it. The picture is lit in {:.2f} ms.",
                                   milliseconds_of(both.device.frame, "lighting")),
                       passes, pass("copy of the table", "copy", 2 * of_sums));
}

} // namespace

page_part soft_part(const vulkan::device& gpu, const settings& how)
{
    const stage scenery = sunny_fence(double(how.width) / how.height);
    const device_comparison comparison(gpu, scenery, how);
    const std::optional<soft_comparison> both = compare_soft(gpu, scenery, comparison, how);
    if (!both) return {};
    progress(vulkan_driver, "soft shadows");
    write_pictures("soft", how, both->device.frame, scenery, comparison, both->host);
    pictures_block pictures =
        pictures_of({"soft", "Soft shadows", "The fence under a sun of three degrees", both->of_whole.errors});
    pictures.is_folded = false;
    pictures.text =
        "A sun of three degrees. Two compute passes sum up the channels of four moments to a table in 32-bit integers. "
        "The "
        "fragment shader searches it for blockers, estimates the width of the penumbra and filters the table over that "
        "width, by the kernels that the CPU runs.";
    page_part result{{std::move(pictures), differences(*both), rates(*both)}, {}};
    if (const method* m = registry_of<method>().find("msm4_soft")) {
        report_row row =
            device_row(*m, "fence", gpu.name(), both->device.frame, both->of_whole.errors, comparison.where().size());
        row.receiver = "plane_biased";
        row.map_bytes = double(both->device.table.pixels.size()) * moments4_summed::bytes_per_texel;
        result.rows.push_back(std::move(row));
    }
    return result;
}

} // namespace gnomon::evaluation
