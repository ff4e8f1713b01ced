// Time-dependent shadow maps against ranges, as in Hong & Oh: Figures 9 to 12, and Figures 5 to 7 of 2017. Errors at three
// depth biases, time of each step and memory against the number of samples, of the cubes to the light and of a skinned
// character. Map and camera have as many samples.
#include "evaluation/core/progress.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "evaluation/motion/slices_study.hpp"
#include "evaluation/motion/words.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/layered_stages.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#ifndef GNOMON_TEST_MODELS
#define GNOMON_TEST_MODELS ""
#endif

namespace gnomon::evaluation {

using namespace renderer;

namespace {

struct study_case {
    sliced_case what;
    moving_stage stage;
};

std::vector<study_case> study_cases(double aspect)
{
    std::vector<study_case> result;
    result.push_back({{"cubes_to_the_light", "cubes to the light", 8}, cubes_to_the_light(aspect)});
    const std::filesystem::path models(GNOMON_TEST_MODELS), file = models / "X" / "Testwuson.X";
    constexpr double opens = 0.2, closes = opens + 1. / 24; // a frame of film
    if (!models.empty() && exists(file))
        result.push_back({{"runner", "a skinned character between columns", 20},
                          runner(load_animated_model(file, "", opens, closes), aspect)});
    else progress("motion_analytic", "left out: a skinned character, since assimp-testmodels is not installed");
    return result;
}

using all_studies = std::vector<sliced_results>;

// A line for each quantity of each number of samples.
struct slice_quantity {
    const char *label, *colour;
    bool dashed;
    double (*of)(const sliced_results& all, const count_result& r);
};

constexpr double mebibyte = 0x1p20;
const std::array time_quantities{
    slice_quantity{"time-dependent: shadow pass", "#d62728", false,
                   [](const sliced_results&, const count_result& r) { return r.shadow_ms; }},
    slice_quantity{"time-dependent: shadow test", "#d62728", true,
                   [](const sliced_results&, const count_result& r) { return r.by_bias[2].look_up_ms; }},
    slice_quantity{"ranges: shadow pass", "#2ca02c", false,
                   [](const sliced_results& all, const count_result&) { return all.ranges_build_ms; }},
    slice_quantity{"ranges: shadow test", "#2ca02c", true,
                   [](const sliced_results&, const count_result& r) { return r.ranges_ms; }},
    slice_quantity{"camera", "#555555", false,
                   [](const sliced_results&, const count_result& r) { return r.camera_ms; }}};
const std::array memory_quantities{
    slice_quantity{"time-dependent, depth alone", "#d62728", false,
                   [](const sliced_results&, const count_result& r) { return double(r.by_bias[0].bytes) / mebibyte; }},
    slice_quantity{"time-dependent, bias for slope and motion", "#8c1c13", false,
                   [](const sliced_results&, const count_result& r) { return double(r.by_bias[2].bytes) / mebibyte; }},
    slice_quantity{"ranges", "#2ca02c", false,
                   [](const sliced_results& all, const count_result&) { return double(all.ranges_bytes) / mebibyte; }},
    slice_quantity{
        "ranges, with the fragments that building needs", "#2ca02c", true,
        [](const sliced_results& all, const count_result&) { return double(all.building_bytes) / mebibyte; }}};

template <std::size_t n>
chart_block chart_of(const all_studies& found, const std::array<slice_quantity, n>& lines, const std::string& id,
                     const std::string& unit, const std::string& caption)
{
    chart_block chart{.name = "slices_" + id, .alt = caption, .caption = caption, .panels = {}};
    for (const sliced_results& all : found) {
        panel p{.title = all.what.label,
                .x = {.label = "samples", .scale = scale::log},
                .y = {.label = unit, .scale = scale::log}};
        chart.alt += fmt::format(" {}, {} samples:", all.what.label, all.by_count.back().samples);
        for (const count_result& r : all.by_count) p.x.ticks.emplace_back(r.samples, std::to_string(r.samples));
        for (const slice_quantity& q : lines) {
            series line{.label = q.label,
                        .colour = q.colour,
                        .style = style::line,
                        .labelled = false,
                        .dashed = q.dashed,
                        .marker = "circle"};
            for (const count_result& r : all.by_count) line.points.push_back({double(r.samples), q.of(all, r)});
            chart.alt += fmt::format(" {} {:.3g},", q.label, line.points.back()[1]);
            p.series.push_back(std::move(line));
        }
        chart.alt.back() = '.';
        chart.panels.push_back(std::move(p));
    }
    return chart;
}

const count_result& pictured_of(const sliced_results& all)
{
    return *std::ranges::find(all.by_count, all.what.pictured, &count_result::samples);
}

chart_block bias_chart_of(const all_studies& found)
{
    chart_block chart{.name = "slices_bias",
                      .alt = "Acne against leak by the constant of the bias, for three slice_biases.",
                      .caption =
                          "Acne against leak, in thousandths of visibility, by a constant bias on top of each "
                          "kind of bias; lower left is better. A line goes from no constant, at the upper left, "
                          "to the largest.",
                      .panels = {}};
    for (const sliced_results& all : found) {
        const count_result& r = pictured_of(all);
        panel p{.title = fmt::format("{}, {} samples", all.what.label, r.samples),
                .x = {.label = "leak"},
                .y = {.label = "acne"}};
        for (std::size_t k = 0; k < slice_biases.size(); ++k) {
            series line{.label = slice_biases[k].label,
                        .colour = slice_biases[k].colour,
                        .style = style::line,
                        .labelled = false,
                        .marker = "circle"};
            for (const sweep_point& one : r.by_bias[k].sweep) line.points.push_back({1e3 * one.leak, 1e3 * one.acne});
            chart.alt += fmt::format(" {}, {}: least RMSE {:.1f} thousandths.", all.what.label, slice_biases[k].label,
                                     1e3 * r.by_bias[k].best().rmse);
            p.series.push_back(std::move(line));
        }
        chart.panels.push_back(std::move(p));
    }
    return chart;
}

table_block table_of(const all_studies& found)
{
    table_block table{
        .title = "Time-dependent shadow maps",
        .text =
            "The comparator of Hong &amp; Oh, with as many samples of the map as of the camera. A sample of the map "
            "was taken at another time than the receiver that it is compared with, so surfaces that move shadow "
            "themselves. Three depth slice_biases: for the receiver's slope alone; with the sample moved in depth to "
            "the "
            "receiver's time (Andersson et al. 2015, (12)); and with the slope's part of the way that the sample "
            "moves over the map, too, which needs no constant. RMSE in thousandths of visibility, without a "
            "constant bias and with the best of a sweep, which looks up a quarter of the pixels.",
        .columns = {{.key = "scene", .label = "scene"}, {.key = "samples", .label = "samples", .digits = 0}},
        .rows = {}};
    for (std::size_t k = 0; k < slice_biases.size(); ++k) {
        table.columns.push_back(error_column(fmt::format("bias{}", k), slice_biases[k].label, 1));
        table.columns.push_back(error_column(fmt::format("best{}", k), "at its best constant", 1));
    }
    table.columns.push_back(error_column("ranges", "ranges", 1));
    for (const sliced_results& all : found)
        for (const count_result& r : all.by_count) {
            table_row row{.cells = {{"scene", all.what.label}, {"samples", double(r.samples)}}};
            for (std::size_t k = 0; k < slice_biases.size(); ++k) {
                row.cells.emplace_back(fmt::format("bias{}", k), r.by_bias[k].errors.rmse);
                row.cells.emplace_back(fmt::format("best{}", k), r.by_bias[k].best().rmse);
            }
            row.cells.emplace_back("ranges", r.ranges.rmse);
            table.rows.push_back(std::move(row));
        }
    return table;
}

std::vector<report_row> rows_of(const sliced_results& all)
{
    std::vector<report_row> rows;
    for (const count_result& r : all.by_count)
        for (std::size_t k = 0; k < slice_biases.size(); ++k) {
            const bias_result& b = r.by_bias[k];
            report_row row = row_of(registry_of<method>().at("time_dependent"));
            row.scene = all.what.id, row.part = "time_slices", row.receiver = "stochastic", row.reference = "traced";
            row.parameters = {{"samples", r.samples}, {"bias", double(k)}};
            row.label = fmt::format("time-dependent of {}, bias for {}", r.samples, slice_biases[k].label);
            row.receivers = all.receivers, row.errors = b.errors, row.map_bytes = double(b.bytes);
            row.bytes_per_texel = row.map_bytes / (double(all.resolution) * all.resolution);
            row.ns_per_receiver = 1e6 * b.look_up_ms / double(std::max(all.receivers, 1LL));
            row.build_ms = r.shadow_ms;
            rows.push_back(std::move(row));
        }
    return rows;
}

part_results results(const all_studies& found)
{
    part_results r;
    r.blocks.push_back(table_of(found));
    r.blocks.push_back(chart_of(found, time_quantities, "time", "ms, one core",
                                "Time of each step against the samples of map and camera (Hong &amp; Oh, Figure 11; "
                                "2017, Figure 7)."));
    r.blocks.push_back(chart_of(found, memory_quantities, "memory", "MiB",
                                "Memory of the map against its samples (Hong &amp; Oh, Figure 12)."));
    r.blocks.push_back(bias_chart_of(found));
    for (const sliced_results& all : found) {
        std::ranges::move(rows_of(all), std::back_inserter(r.rows));
        r.blocks.push_back(pictures_block{
            .title = "Samples in slices: " + all.what.label,
            .text = fmt::format("{} triangles, map and camera of {} samples each (Hong &amp; Oh, Figures 9 and 10; "
                                "2017, Figures 5 and 6).",
                                grouped(double(all.triangles)), all.what.pictured),
            .columns = 2,
            .pictures = all.pictures});
    }
    return r;
}

part_run time_slices(const motion_settings& how)
{
    const auto cases = std::make_shared<std::vector<study_case>>(study_cases(double(how.size.width) / how.size.height));
    const auto found = std::make_shared<all_studies>(cases->size());
    part_run result;
    for (std::size_t i = 0; i < cases->size(); ++i)
        result.tasks.push_back([=] { (*found)[i] = study_slices((*cases)[i].what, (*cases)[i].stage, how); });
    result.results = [=] { return results(*found); };
    return result;
}

const registered<motion_part> entry{
    motion_part{.id = "time_slices", .label = "time-dependent shadow maps", .order = 35, .begin = time_slices}};

} // namespace

} // namespace gnomon::evaluation
