// Line samples (Gribel et al. 2011) against points: shadows' edges exact along lines through the texels at some instants,
// against ranges, which are exact in time at the texels' centres, and against plain samples at instants.
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/accumulation.hpp"
#include "evaluation/motion/line_maps.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/motion_scene.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "evaluation/motion/scene_blocks.hpp"
#include "evaluation/motion/scene_comparison.hpp"
#include "evaluation/motion/slices.hpp"
#include "renderer/trace/tracer.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<map_kind> lines_kind{
    map_kind{.id = "lines_at_times", .label = "lists of ranges along lines at some times", .order = 125}};
const registered<family> lines_family{
    family{.id = "line_samples", .label = "line samples", .order = 165, .colour = "#9467bd"}};
const registered<method> lines_method{method_facts{.id = "line_samples",
                                                   .family = "line_samples",
                                                   .label = "lines",
                                                   .map = lines_kind->id,
                                                   .format = {"ranges_20b", "20 B ranges"}}};

constexpr int traced_times = 256, seeds_of_noise = 2, noisy_count = 8, pictured_count = 16;

// Lines in charts, and their colours.
constexpr std::array chart_groups{std::pair{"ranges", "#1f77b4"}, std::pair{"points", "#222222"},
                                  std::pair{"lines", "#c5b0d5"}, std::pair{"crossed lines", "#9467bd"}};

std::string colour_of_line(std::string_view group)
{
    const auto found =
        std::ranges::find(chart_groups, group, [](const auto& one) { return std::string_view(one.first); });
    return found == chart_groups.end() ? "" : found->second;
}

// A time in each of as many equal parts of the shutter interval: the middles for seed 0.
std::vector<float> stratified_times(int count, std::uint32_t seed)
{
    std::vector<float> times = middle_times(count);
    std::mt19937 random(seed);
    for (float& t : times)
        if (seed > 0) t += (float(random() >> 8) * 0x1p-24f - 0.5f) / float(count);
    return times;
}

struct line_row {
    report_row row;
    const char* group; // a line in charts
};

struct line_results {
    std::string scene;
    std::vector<line_row> rows;
    std::vector<shown_picture> pictures;
};

class line_comparison {
  public:
    line_comparison(const char* scene, const motion_settings& how)
        : entry_(registry_of<scene_entry>().at(scene)),
          stage_(dynamic_cast<const motion_scene&>(entry_).stage(double(how.size.width) / how.size.height)),
          size_{how.size.width * 3 / 4, how.size.height * 3 / 4, how.size.map_resolution,
                std::min(traced_times, how.size.reference_samples)},
          folder_(how.folder),
          reference_(tracer(stage_.world)
                         .photograph(stage_.light, stage_.eye, size_.width, size_.height, size_.reference_samples)),
          seen_(camera_segments(stage_.world, stage_.eye, size_.width, size_.height, depth_tolerance)),
          found_{.scene = entry_.label, .rows = {}, .pictures = {}}
    {
        show("reference", "ray tracing", reference_.colour);
    }

    line_results run()
    {
        add_ranges(1, 1, "ranges");
        add_ranges(2, 1, "ranges of a finer map");
        add_ranges(1, 3, "ranges, 3 x 3 look-ups");
        for (const int count : {4, 8, 16}) add_points(count);
        add_slices(noisy_count);
        add_lines(pictured_count, line_look_up::averaged, 1);
        for (const int count : {4, 8, 16}) add_lines(count, line_look_up::placed, 1);
        for (const int count : {4, 8, 16}) add_lines(count, line_look_up::crossed, 1);
        add_lines(pictured_count, line_look_up::crossed, 2);
        return std::move(found_);
    }

  private:
    struct estimate {
        seen_motion seen;
        std::vector<float> visibility;
        double seconds;
    };

    void show(const std::string& name, const std::string& words, const picture& what)
    {
        const std::string file = fmt::format("lines-{}-{}.png", entry_.id, name);
        write_png(folder_ / file, what);
        found_.pictures.push_back({file, entry_.label + ": " + words, words});
    }

    // A row of the estimate of seed 0, and of its noise over further seeds where there are some.
    void add(report_row row, const char* receiver, const std::string& words, const char* group,
             const std::vector<estimate>& of_seeds, const char* pictured = nullptr)
    {
        std::vector<float> found, expected;
        double variance = 0;
        std::vector<image<float>> means;
        means.reserve(of_seeds.size());
        for (const estimate& e : of_seeds) means.push_back(mean_visibility(e.seen, e.visibility));
        for (std::size_t i = 0; i < reference_.coverage.pixels.size(); ++i) {
            if (of_seeds[0].seen(i).empty() || reference_.coverage.pixels[i] < 1) continue;
            found.push_back(means[0].pixels[i]), expected.push_back(reference_.visibility.pixels[i]);
            double sum = 0, squares = 0;
            for (std::size_t k = 1; k < means.size(); ++k) {
                const double d = double(means[k].pixels[i]) - double(means[0].pixels[i]);
                sum += d, squares += d * d;
            }
            if (means.size() > 1) variance += (squares - sum * sum / seeds_of_noise) / (seeds_of_noise - 1);
        }
        row.scene = entry_.id;
        row.part = "line_samples";
        row.receiver = receiver;
        row.label = words;
        row.reference = "traced";
        row.receivers = static_cast<long long>(found.size());
        row.errors = compare(found, expected);
        row.ns_per_receiver = 1e9 * of_seeds[0].seconds / double(found.size());
        if (means.size() > 1) row.noise = std::sqrt(variance / double(found.size())), row.seeds = seeds_of_noise;
        if (pictured)
            show(pictured, fmt::format("{}, errors: RMSE {:.1f} thousandths", words, 1e3 * row.errors.rmse),
                 error_picture(means[0], reference_.visibility, error_scale));
        found_.rows.push_back({std::move(row), group});
    }

    void add_ranges(int finer, int look_ups, const char* words)
    {
        map_source maps(stage_.world, stage_.light, size_.map_resolution * finer);
        const auto& of = registry_of<method>().at("resolved_ranges");
        const auto map = maps.map(of.id);
        const auto receivers = light_receivers_of(seen_, stage_.light, maps.resolution, 0.5 + look_ups);
        estimate e{seen_, std::vector<float>(receivers.size()), 0};
        e.seconds = seconds([&] {
            const auto lit = look_ups == 1 ? light_visibility : wide_visibility;
            std::ranges::transform(receivers, e.visibility.begin(),
                                   [&](const light_receiver& r) { return lit(map->map(), r); });
        });
        report_row row = row_of(of, *map);
        row.parameters = {{"look_ups", look_ups}, {"finer", finer}};
        row.bytes_per_texel *= finer * finer;
        add(std::move(row), "analytic", words, look_ups == 1 ? "ranges" : "", {e},
            finer * look_ups == 1 ? "ranges" : nullptr);
    }

    void add_points(int count)
    {
        map_facts facts = accumulation_facts(count, size_.map_resolution);
        std::vector<estimate> all;
        for (std::uint32_t seed = 0; seed <= (count == noisy_count ? seeds_of_noise : 0); ++seed) {
            accumulated_maps maps;
            const double built = seconds_on_one_core([&] {
                maps = accumulate(stage_.world, stage_.light, size_.map_resolution, stratified_times(count, seed));
            });
            if (seed == 0) facts.build_ms = 1e3 * built;
            estimate e{seen_at_times(seen_, maps.times), {}, 0};
            const auto receivers = accumulated_receivers_of(e.seen, stage_.light, maps);
            std::vector<float> lit;
            e.seconds = seconds([&] { accumulated_visibility(maps, receivers, lit); });
            e.visibility = in_order_of_segments(receivers, lit, e.seen.segments.size());
            all.push_back(std::move(e));
        }
        report_row row = row_of(registry_of<method>().at("accumulation"), facts);
        row.lanes = int(accumulation_pack::size);
        add(std::move(row), "at_times_of_maps", fmt::format("points at {} instants", count), "points", all,
            count == pictured_count ? "points" : nullptr);
    }

    void add_slices(int count)
    {
        report_row row = row_of(registry_of<method>().at("time_dependent"));
        std::vector<estimate> all;
        for (std::uint32_t seed = 0; seed <= seeds_of_noise; ++seed) {
            sample_picture drawn;
            const double built = seconds_on_one_core([&] {
                drawn = rasterize_samples(stage_.world, stage_.light, size_.map_resolution, size_.map_resolution,
                                          {.samples = count, .seed = seed + 1});
            });
            const time_slices_map<time_dependent_sample<float>> map(drawn);
            estimate e{stochastic_visibility(stage_.world, stage_.eye, size_.width, size_.height, count, seed), {}, 0};
            e.visibility.resize(e.seen.segments.size());
            const slice_receivers receivers = slice_receivers_of(e.seen, stage_.light, size_.map_resolution);
            e.seconds = seconds([&] { slice_visibility(map, receivers, 0, e.visibility); });
            if (seed == 0) {
                row.build_ms = 1e3 * built + map.filling_ms;
                row.map_bytes = double(map.bytes());
            }
            all.push_back(std::move(e));
        }
        row.bytes_per_texel = row.map_bytes / (double(size_.map_resolution) * size_.map_resolution);
        row.parameters = {{"samples", count}};
        add(std::move(row), "stochastic", fmt::format("{} samples of a texel", count), "", all);
    }

    void add_lines(int count, line_look_up how, int coarser)
    {
        const int resolution = size_.map_resolution / coarser;
        const bool pictured = count == pictured_count && coarser == 1 && how == line_look_up::crossed;
        report_row row = row_of(*lines_method);
        std::vector<estimate> all;
        for (std::uint32_t seed = 0; seed <= (count == noisy_count ? seeds_of_noise : 0); ++seed) {
            line_maps maps;
            const double built = seconds_on_one_core([&] {
                maps = rasterize_lines(stage_.world, stage_.light, resolution, stratified_times(count, seed), how);
            });
            estimate e{seen_at_times(seen_, maps.times), {}, 0};
            e.visibility.resize(e.seen.segments.size());
            const line_receivers receivers = line_receivers_of(e.seen, stage_.light, maps);
            e.seconds = seconds([&] { line_visibility(maps, receivers, how, e.visibility); });
            if (seed == 0) row.build_ms = 1e3 * built, row.map_bytes = double(maps.bytes());
            all.push_back(std::move(e));
        }
        row.bytes_per_texel = row.map_bytes / (double(size_.map_resolution) * size_.map_resolution);
        row.parameters = {{"times", count}, {"look_up", double(how)}, {"coarser", coarser}};
        static constexpr std::array words{"means of lines", "lines", "crossed lines"};
        const auto k = std::size_t(how);
        add(std::move(row), "at_times_of_maps",
            fmt::format("{} at {} instants{}", words[k], count, coarser > 1 ? ", a coarser map" : ""),
            coarser > 1 || how == line_look_up::averaged ? "" : words[k], all, pictured ? "crossed_lines" : nullptr);
    }

    const scene_entry& entry_;
    moving_stage stage_;
    motion_sizes size_;
    std::filesystem::path folder_;
    reference_picture reference_;
    seen_motion seen_;
    line_results found_;
};

using all_lines = std::vector<line_results>;

table_block table_of(const all_lines& found)
{
    table_block table{
        .title = "Line samples",
        .text = fmt::format(
            "Ranges are exact in time, but at the centres of texels alone: most of their error on pillars and on "
            "random "
            "cubes is that of texels. Lines are the other way round (Gribel et al., <i>High-Quality Spatio-Temporal "
            "Rendering Using Semi-Analytical Visibility</i>, 2011). At each of some instants a line through each texel "
            "knows which parts of it a surface covers, and a receiver reads the line at its own place. Instants take "
            "turns at lines along either axis, or <i>crossed</i> lines have both: of four points around the receiver "
            "two opposite ones that agree decide. <i>Means</i> of lines are antialiased texels. Points are plain "
            "shadow maps at the same instants, and samples of a texel a time-dependent map. Bytes are per texel of the "
            "usual map. Noise is that of {} seeds with random instants. Errors and noise are in thousandths of "
            "visibility.",
            seeds_of_noise),
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "method", .label = "method"},
                    error_column("rmse", "RMSE", 1),
                    error_column("largest", "largest error", 0),
                    error_column("noise", "noise", 1),
                    number_column("bytes", "bytes per texel"),
                    number_column("build", "map, ms"),
                    number_column("ns", "ns per receiver")},
        .rows = {}};
    for (const line_results& scene : found)
        for (const line_row& one : scene.rows)
            table.rows.push_back({.cells = {{"scene", scene.scene},
                                            {"method", one.row.label},
                                            {"rmse", one.row.errors.rmse},
                                            {"largest", one.row.errors.max_abs},
                                            {"noise", one.row.noise ? cell(*one.row.noise) : cell()},
                                            {"bytes", one.row.bytes_per_texel},
                                            {"build", one.row.build_ms},
                                            {"ns", one.row.ns_per_receiver}},
                                  .colour = colour_of_line(one.group)});
    return table;
}

chart_block chart_of(const all_lines& found, const char* name, const char* unit, double (*of)(const report_row& row))
{
    chart_block chart{
        .name = fmt::format("lines_{}", name),
        .alt = fmt::format("RMSE against {}.", unit),
        .caption = fmt::format("RMSE in thousandths of visibility against {}; lower left is better.", unit),
        .panels = {}};
    for (const line_results& scene : found) {
        panel p{.title = scene.scene,
                .x = {.label = unit, .scale = scale::log},
                .y = {.label = "RMSE", .scale = scale::log}};
        for (const auto& [group, colour] : chart_groups) {
            series line{.label = group, .colour = colour, .style = style::line, .labelled = false, .marker = "circle"};
            for (const line_row& one : scene.rows)
                if (group == std::string_view(one.group))
                    line.points.push_back({of(one.row), 1e3 * one.row.errors.rmse});
            chart.alt += fmt::format(" {}, {}: from {:.1f} to {:.1f}.", scene.scene, group, line.points.front()[1],
                                     line.points.back()[1]);
            p.series.push_back(std::move(line));
        }
        chart.panels.push_back(std::move(p));
    }
    return chart;
}

part_results results_of(const all_lines& found)
{
    part_results r;
    for (const line_results& scene : found)
        for (const line_row& one : scene.rows) r.rows.push_back(one.row);
    r.blocks.push_back(table_of(found));
    r.blocks.push_back(
        chart_of(found, "memory", "bytes per texel", [](const report_row& row) { return row.bytes_per_texel; }));
    r.blocks.push_back(
        chart_of(found, "time", "ns per receiver", [](const report_row& row) { return row.ns_per_receiver; }));
    pictures_block pictures{.text = "The light's visibility less that of ray tracing.",
                            .columns = 4,
                            .pictures = {},
                            .key = key_of_errors(double(error_scale))};
    for (const line_results& scene : found) std::ranges::copy(scene.pictures, std::back_inserter(pictures.pictures));
    r.blocks.push_back(std::move(pictures));
    return r;
}

part_run begin_lines(const motion_settings& how)
{
    static constexpr std::array scenes{"pillars", "random_cubes", "crossed_quads"};
    const auto found = std::make_shared<all_lines>(scenes.size());
    part_run result;
    for (std::size_t i = 0; i < scenes.size(); ++i)
        result.tasks.emplace_back([=] { (*found)[i] = line_comparison(scenes[i], how).run(); });
    result.results = [=] { return results_of(*found); };
    return result;
}

const registered<motion_part> entry{
    motion_part{.id = "line_samples", .label = "line samples", .order = 25, .begin = begin_lines}};

} // namespace

} // namespace gnomon::evaluation
