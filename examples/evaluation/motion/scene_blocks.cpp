#include "scene_blocks.hpp"

#include "words.hpp"

#include <fmt/format.h>

#include <utility>

namespace gnomon::evaluation {

namespace {

std::string in_short(const report_row& row)
{
    return fmt::format("RMSE {:.2f} thousandths, {} ns per receiver, built in {} ms", 1e3 * row.errors.rmse,
                       grouped(row.ns_per_receiver), grouped(row.build_ms));
}

std::string capitalized(std::string text)
{
    if (!text.empty() && 'a' <= text[0] && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
    return text;
}

shown_picture picture_of(const scene_results& scene, const scene_row& one, std::string caption)
{
    return {one.picture, scene.scene.label + " by " + one.row.label, std::move(caption)};
}

shown_picture errors_of(const scene_results& scene, const scene_row& one, std::string caption)
{
    return {one.error, fmt::format("errors of {} by {}", scene.scene.label, one.row.label), std::move(caption)};
}

table_block numbers_of(const scene_results& scene)
{
    table_block table{.title = capitalized(scene.scene.label) + ": numbers of all methods",
                      .text = "Errors are in thousandths of visibility.",
                      .columns = {{.key = "method", .label = "method"},
                                  {.key = "format", .label = "format"},
                                  number_column("bytes", "bytes per texel", 0, best::low),
                                  error_column("rmse", "RMSE"),
                                  error_column("leak", "leak"),
                                  error_column("acne", "acne"),
                                  error_column("largest", "largest error", 1),
                                  number_column("ns", "ns per receiver", 0, best::low),
                                  number_column("build", "map, ms", 1, best::low)},
                      .rows = {},
                      .is_folded = true};
    for (const scene_row& one : scene.rows) {
        if (one.picture.empty()) continue;
        const report_row& row = one.row;
        table.rows.push_back({.cells = {{"method", row.label},
                                        {"format", one.format},
                                        {"bytes", row.bytes_per_texel},
                                        {"rmse", row.errors.rmse},
                                        {"leak", row.errors.leak},
                                        {"acne", row.errors.acne},
                                        {"largest", row.errors.max_abs},
                                        {"ns", row.ns_per_receiver},
                                        {"build", row.build_ms}},
                              .colour = registry_of<family>().at(row.family).colour});
    }
    return table;
}

} // namespace

column error_column(std::string key, std::string label, int digits)
{
    return {.key = std::move(key), .label = std::move(label), .digits = digits, .scale = 1e3, .best = best::low};
}

column number_column(std::string key, std::string label, int digits, best which)
{
    return {.key = std::move(key), .label = std::move(label), .digits = digits, .best = which};
}

std::vector<std::pair<std::string, std::string>> key_of_errors(double saturated)
{
    return {{"#2a62cc", fmt::format("light leaks: too bright, by {:g} and more where the colour is full", saturated)},
            {"#c8232c", fmt::format("acne: too dark, by {:g} and more where the colour is full", saturated)}};
}

std::string words_of(const motion_settings& how)
{
    const auto& [width, height, texels, samples] = how.size;
    return fmt::format(
        "Pictures have {} x {} pixels and shadow maps {} x {} texels, looked up with bilinear weights. The reference "
        "traces {} rays per pixel from the eye, each at a time of its own, and one from each hit to the light. Times "
        "are "
        "those of one core{}, the least of several runs, or of one run that takes long. Numbers of errors are in "
        "thousandths of visibility.",
        width, height, texels, texels, grouped(samples),
        how.tasks_at_once > 1 ? ", while another part of the run is measured on another core" : "");
}

void add_scene_blocks(const scene_results& scene, std::vector<block>& to)
{
    const scene_row &analytic = analytic_row(scene), &accumulated = accumulated_row(scene);
    const std::string note = scene.scene.text.empty() ? "" : scene.scene.text + " ";
    to.push_back(pictures_block{
        .title = capitalized(scene.scene.label),
        .text = fmt::format("{}The scene has {} triangles and {} receivers.", note, grouped(double(scene.triangles)),
                            grouped(double(scene.receivers))),
        .columns = 3,
        .pictures = {picture_of(scene, analytic, "ranges, analytic receivers: " + in_short(analytic.row)),
                     picture_of(scene, accumulated, accumulated.row.label + ": " + in_short(accumulated.row)),
                     {scene.reference, scene.scene.label + " in motion, by ray tracing",
                      "the reference, by ray tracing"},
                     errors_of(scene, analytic, "its errors, analytic receivers"),
                     errors_of(scene, accumulated, "its errors, " + accumulated.row.label)},
        .key = key_of_errors(double(error_scale))});
    to.push_back(numbers_of(scene));
    pictures_block all{.title = capitalized(scene.scene.label) + ": pictures of all methods",
                       .columns = 4,
                       .pictures = {},
                       .is_folded = true,
                       .key = key_of_errors(double(error_scale))};
    for (const scene_row& one : scene.rows) {
        if (one.picture.empty()) continue;
        all.pictures.push_back(picture_of(scene, one, one.row.label));
        all.pictures.push_back(errors_of(scene, one, "its errors"));
    }
    to.push_back(std::move(all));
}

void add_close_up_blocks(std::span<const scene_results> scenes, std::vector<block>& to)
{
    pictures_block pictures{
        .title = "Figures 4.1 to 4.3 of Palmér",
        .text = fmt::format(
            "In the thesis, a receiver that stays within one texel of the shadow map is integrated in closed form, and "
            "any "
            "other one is sampled at some times. Where a plane turns, both kinds meet along its axis. Analytic "
            "receivers "
            "follow a point from texel to texel in closed form. Errors at the edges of shadows come from the size of "
            "texels, and both have them. Errors are {} times as strong as in the other pictures.",
            close_up_gain),
        .columns = 5,
        .pictures = {},
        .is_pixelated = true,
        .key = key_of_errors(double(error_scale) / close_up_gain)};
    table_block table{.columns = {{.key = "scene", .label = "scene"},
                                  error_column("rmse_semi", "RMSE, semi-analytic"),
                                  error_column("rmse", "RMSE, analytic"),
                                  error_column("largest_semi", "largest error, semi-analytic"),
                                  error_column("largest", "largest error, analytic")},
                      .rows = {}};
    for (column& c : table.columns) c.best = best::none;
    for (const scene_results& scene : scenes) {
        const scene_row* semi = find_row(scene, "resolved_ranges", "semi_analytic");
        if (scene.close_ups.empty() || !semi) continue;
        pictures.pictures.insert(pictures.pictures.end(), scene.close_ups.begin(), scene.close_ups.end());
        const error_statistics &a = analytic_row(scene).row.errors, &s = semi->row.errors;
        table.rows.push_back({.cells = {{"scene", scene.scene.label},
                                        {"rmse_semi", s.rmse},
                                        {"rmse", a.rmse},
                                        {"largest_semi", s.max_abs},
                                        {"largest", a.max_abs}}});
    }
    if (pictures.pictures.empty()) return;
    to.push_back(std::move(pictures));
    to.push_back(std::move(table));
}

void add_surface_blocks(std::span<const scene_results> scenes, std::vector<block>& to)
{
    table_block table{
        .title = "Ids of surfaces",
        .text =
            "A receiver is not shadowed by ranges of its own id. That may be the id of its triangle, or of all "
            "triangles "
            "that cannot shadow one another, since they stay in one plane or form one convex part (Palmér, 2.3.2). "
            "Where "
            "a list is full, ranges of one id merge into one of that id, instead of into one that shadows everybody. "
            "Joined are ranges of one mesh that follow one another on nearly one line, whatever their ids. Acne is "
            "shown "
            "with the depth bias of all methods and without it. Errors are in thousandths of visibility.",
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "method", .label = "method"},
                    {.key = "ids", .label = "ids of"},
                    error_column("rmse", "RMSE"),
                    error_column("leak", "leak"),
                    error_column("acne", "acne"),
                    error_column("unbiased", "acne, no bias"),
                    number_column("bytes", "bytes per texel")},
        .rows = {}};
    for (column& c : table.columns) c.best = best::none;
    const auto add = [&](const scene_results& scene, const report_row& row, const char* ids) {
        table.rows.push_back(
            {.cells = {{"scene", fmt::format("{}, {} surfaces of {} triangles", scene.scene.label,
                                             grouped(double(scene.surfaces)), grouped(double(scene.triangles)))},
                       {"method", row.label},
                       {"ids", ids},
                       {"rmse", row.errors.rmse},
                       {"leak", row.errors.leak},
                       {"acne", row.errors.acne},
                       {"unbiased", row.acne_unbiased ? cell(*row.acne_unbiased) : cell()},
                       {"bytes", row.bytes_per_texel}}});
    };
    for (const scene_results& scene : scenes) {
        if (!scene.motion.has("surfaces")) continue;
        for (const scene_row& one : scene.rows) {
            if (!one.row.parameters.contains("surfaces")) continue;
            parameters by_triangles = one.row.parameters;
            by_triangles.erase("surfaces");
            if (const scene_row* plain = find_row(scene, one.row.method, one.row.receiver, by_triangles))
                add(scene, plain->row, "triangles");
            add(scene, one.row, "surfaces");
        }
        if (const scene_row* joined = find_row(scene, "joined_ranges", "analytic"))
            add(scene, joined->row, "triangles");
    }
    if (!table.rows.empty()) to.push_back(std::move(table));
}

void add_merge_blocks(std::span<const scene_results> scenes, std::vector<block>& to)
{
    table_block table{
        .title = "Merges of full lists",
        .text =
            "A full list merges the two ranges of the least cost: the area of time and depth that becomes "
            "shadowed, or by weights of the gap between the ranges, of their differences in depth and slope, and "
            "of their durations (Gribel et al. 2010). A conservative merge is in front of both ranges, so that "
            "what was in shadow stays there; another one is the line between their outer ends. Errors are in "
            "thousandths of visibility.",
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "method", .label = "method"},
                    error_column("rmse", "RMSE"),
                    error_column("leak", "leak"),
                    error_column("acne", "acne"),
                    error_column("largest", "largest error", 1),
                    number_column("bytes", "bytes per texel", 0),
                    number_column("build", "map, ms", 0)},
        .rows = {}};
    for (const scene_results& scene : scenes) {
        if (!scene.motion.has("surfaces")) continue;
        for (const scene_row& one : scene.rows)
            if (const report_row& row = one.row; row.method == "interval_lists" || &one == &analytic_row(scene))
                table.rows.push_back({.cells = {{"scene", scene.scene.label},
                                                {"method", row.label},
                                                {"rmse", row.errors.rmse},
                                                {"leak", row.errors.leak},
                                                {"acne", row.errors.acne},
                                                {"largest", row.errors.max_abs},
                                                {"bytes", row.bytes_per_texel},
                                                {"build", row.build_ms}}});
    }
    if (!table.rows.empty()) to.push_back(std::move(table));
}

void add_cover_blocks(std::span<const scene_results> scenes, std::vector<block>& to)
{
    table_block table{
        .title = "The cover first",
        .text =
            "The shadow test of Hong &amp; Oh 2017 reads the cover of a texel, and its list only where the "
            "cover does not decide. The RMSE is in thousandths of visibility.",
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "method", .label = "method"},
                    error_column("rmse", "RMSE"),
                    number_column("bytes", "bytes per texel", 0, best::low),
                    number_column("ns", "ns per receiver", 0, best::low),
                    number_column("build", "map, ms", 1, best::low)},
        .rows = {}};
    for (const scene_results& scene : scenes) {
        if (!scene.motion.has("covers")) continue;
        for (const char* method : {"exact_ranges", "covered_ranges", "cover_first_ranges"})
            if (const scene_row* found = find_row(scene, method, "stochastic", {{"times", stochastic_samples}}))
                table.rows.push_back({.cells = {{"scene", scene.scene.label},
                                                {"method", found->row.label},
                                                {"rmse", found->row.errors.rmse},
                                                {"bytes", found->row.bytes_per_texel},
                                                {"ns", found->row.ns_per_receiver},
                                                {"build", found->row.build_ms}}});
    }
    if (!table.rows.empty()) to.push_back(std::move(table));
}

} // namespace gnomon::evaluation
