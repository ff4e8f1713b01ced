#include "layered_page.hpp"

#include "evaluation/motion/scene_blocks.hpp"
#include "evaluation/motion/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::evaluation {

namespace {

std::string capitalized(std::string text)
{
    if (!text.empty() && 'a' <= text[0] && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
    return text;
}

std::string in_short(const layered_result& r)
{
    std::string result = fmt::format("RMSE {:.1f} thousandths", 1e3 * r.row.errors.rmse);
    if (r.row.noise) result += fmt::format(", noise {:.1f}", 1e3 * *r.row.noise);
    return result + fmt::format(", {} ms", grouped(r.total_ms()));
}

cell maybe(const std::optional<double>& number) { return number ? cell(*number) : cell(); }

std::string colour_of(const layered_result& r) { return r.method->its_family().colour; }

// Cells that all tables of results have in common.
std::vector<std::pair<std::string, cell>> cells_of(const layered_result& r)
{
    const report_row& row = r.row;
    return {{"method", r.label()},
            {"rmse", row.errors.rmse},
            {"noise", maybe(row.noise)},
            {"beyond_exact", maybe(row.noise_beyond_exact)},
            {"beyond", maybe(row.noise_beyond_camera)},
            {"of_map", maybe(row.noise_of_map)},
            {"bias", maybe(row.bias)},
            {"leak", row.errors.leak},
            {"acne", row.errors.acne},
            {"bytes", row.map_bytes / 1048576},
            {"build", r.build_ms()},
            {"look_up", row.ns_per_receiver},
            {"total", r.total_ms()}};
}

column hinted(column c, std::string hint)
{
    c.hint = std::move(hint);
    return c;
}

std::vector<column> columns_of()
{
    return {{.key = "method", .label = "method"},
            error_column("rmse", "RMSE", 1),
            hinted(error_column("noise", "noise", 1), "standard deviation over seeds, in penumbrae"),
            hinted(error_column("beyond_exact", "noise beyond exact", 1),
                   "of the difference from exact visibility over the same parts of time"),
            hinted(error_column("beyond", "noise beyond the camera's", 1),
                   "what exact visibility at the camera's own times, as a control variate, leaves of it"),
            hinted(error_column("of_map", "noise of the map", 1), "with the samples of the camera held"),
            hinted(error_column("bias", "bias", 1), "root mean square of the mean error over seeds"),
            error_column("leak", "leak", 1),
            error_column("acne", "acne", 1),
            number_column("bytes", "map, MiB", 1, best::low),
            number_column("build", "map, ms", 0, best::low),
            number_column("look_up", "ns per sample", 0, best::low),
            number_column("total", "all, ms", 0, best::low)};
}

// Rows by scene of rivals of the usual layers.
table_block rivals_of(compared_scenes scenes, std::string title, std::string text, std::string_view comparison,
                      double (*measure)(const layered_result&))
{
    table_block table{.title = std::move(title), .text = std::move(text), .columns = columns_of(), .rows = {}};
    table.columns.insert(table.columns.begin(), {.key = "scene", .label = "scene"});
    for (column& c : table.columns) c.best = best::none;
    const auto add = [&](const compared_layers& scene, const layered_result& r) {
        auto cells = cells_of(r);
        cells.insert(cells.begin(), {"scene", scene.scene.label});
        table.rows.push_back({.cells = std::move(cells), .colour = colour_of(r)});
    };
    for (const compared_layers& scene : scenes) {
        const layered_result* layers = scene.usual(usual_layers);
        if (!layers) continue;
        add(scene, *layers);
        for (const family* f : registry_of<family>().all()) {
            if (f->id == layers->method->family || f->id == "exact_visibility") continue;
            const auto fits = [&](const layered_result& r) { return measure(r) <= 1.1 * measure(*layers); };
            const layered_result *one = best_of(scene, *f, comparison, fits),
                                 *usual = best_of(scene, *f, equal_input, fits);
            if (!one || (usual && usual->row.errors.rmse < one->row.errors.rmse)) one = usual;
            if (one) add(scene, *one);
        }
    }
    return table;
}

} // namespace

std::string introduction_of(const layered_sizes& size)
{
    return fmt::format(
        "A stochastic camera sees each of its samples at a time of its own, and so does a stochastic shadow map. "
        "<i>Time-dependent shadow maps</i> (Akenine-Möller et al. 2007) compare a sample of the one with one of the "
        "other that is near in time, which is noisy. <i>Deep shadow maps</i> (Lokovic &amp; Veach 2000) take motion "
        "for "
        "transparency. <i>Layered filtered shadow maps</i> (Andersson et al., <i>Filtered Stochastic Shadow Mapping "
        "Using a Layered Approach</i>, 2015) part the samples of a tile by depth, move those of a layer along their "
        "mean "
        "motion to one time, and filter them. <i>Ranges</i> know all times exactly, and over the footprint of a camera "
        "sample they have no noise at all.\n\n"
        "Pictures have {} x {} pixels with {} samples each, shadow maps {} x {} texels with 4 samples each where "
        "nothing else is said. Layers have the settings of the paper: tiles of 4 texels, 12 texels of samples around "
        "each and 8 texels of a layer. The reference traces {} rays per pixel from the eye, each at a time of its own. "
        "Methods of equal input are measured with {} seeds of map and camera. Times are those of one core.",
        size.width, size.height, size.camera_samples, size.map_resolution, size.map_resolution,
        grouped(size.reference_times), size.seeds);
}

const layered_result* best_of(const compared_layers& scene, const family& of, std::string_view comparison)
{
    return best_of(scene, of, comparison, [](const layered_result&) { return true; });
}

void add_scene_blocks(const compared_layers& scene, std::vector<block>& to)
{
    pictures_block shown{.title = capitalized(scene.scene.label),
                         .text = fmt::format("{} The scene has {} triangles; {} pixels see a surface, {} of them in "
                                             "penumbrae.",
                                             scene.scene.text, grouped(double(scene.triangles)),
                                             grouped(double(scene.receivers)), grouped(double(scene.penumbra_pixels))),
                         .columns = 2,
                         .compare = true,
                         .pictures = {{scene.reference, scene.scene.label + " in motion, by ray tracing",
                                       "the reference, by ray tracing"}}};
    pictures_block errors{.title = {},
                          .text = {},
                          .columns = 3,
                          .pictures = {},
                          .is_folded = false,
                          .key = key_of_errors(double(layered_error_scale))};
    for (const layered_result& r : scene.results) {
        if (r.picture.empty() || !r.is_of(equal_input)) continue;
        shown.pictures.push_back({r.picture, scene.scene.label + " by " + r.label(), r.label() + ": " + in_short(r)});
        if (r.method->id == usual_layers) shown.shown = {0, int(shown.pictures.size()) - 1};
        errors.pictures.push_back(
            {r.error, fmt::format("errors of {} by {}", scene.scene.label, r.label()), r.label()});
    }
    errors.title = "Errors of one seed: " + scene.scene.label;
    errors.is_folded = true;
    to.push_back(std::move(shown));
    to.push_back(std::move(errors));
    table_block table{
        .title = capitalized(scene.scene.label) + ": numbers",
        .text =
            "Errors are in thousandths of visibility. A constant bias, where one is named, is the best of "
            "a sweep.",
        .columns = columns_of(),
        .rows = {},
        .is_folded = true};
    for (const layered_result& r : scene.results)
        table.rows.push_back({.cells = cells_of(r), .colour = colour_of(r), .is_aside = r.method->id == exact_method});
    to.push_back(std::move(table));
}

table_block noise_of(compared_scenes scenes)
{
    table_block table{
        .title = "Noise",
        .text =
            "Standard deviation over seeds in penumbrae, in thousandths, of the same number of samples of map and "
            "camera, all drawn anew with each seed. "
            "Noise of the map is that of maps of other seeds under the same samples of the camera: what the camera "
            "adds "
            "of its own is not in it. "
            "Noise beyond exact visibility is that of the difference from exact visibility at the same samples of the "
            "camera, over the part of the shutter interval that a look-up averages: an instant, a slice, or the part "
            "around a sample's time. It has also what the filter of a map takes away from the camera's noise. "
            "Noise beyond the camera's is what exact visibility at the instants of the samples leaves as a control "
            "variate; layers and slices have little of the noise of instants. "
            "Ratios are to the time-dependent shadow map with the least RMSE.",
        .columns = {{.key = "scene", .label = "scene"},
                    {.key = "method", .label = "method"},
                    error_column("noise", "noise", 1),
                    number_column("ratio", "ratio", 2),
                    error_column("of_map", "of the map", 1),
                    number_column("map_ratio", "ratio", 2),
                    error_column("beyond_exact", "beyond exact", 1),
                    number_column("exact_ratio", "ratio", 2),
                    error_column("beyond", "beyond the camera's", 1),
                    number_column("beyond_ratio", "ratio", 2),
                    error_column("bias", "bias", 1),
                    error_column("rmse", "RMSE", 1)},
        .rows = {}};
    for (column& c : table.columns) c.best = best::none;
    for (const compared_layers& scene : scenes) {
        const layered_result* slices = best_of(scene, *slices_family, equal_input);
        for (const layered_result& r : scene.results) {
            if (!r.is_of(equal_input) || !r.row.noise || (r.constant_bias != 0 && &r != slices)) continue;
            const auto ratio = [&](const std::optional<double>& a, const std::optional<double>& b) {
                return a && b && *b > 0 ? cell(*a / *b) : cell();
            };
            table.rows.push_back(
                {.cells = {{"scene", scene.scene.label},
                           {"method", r.label()},
                           {"noise", *r.row.noise},
                           {"ratio", slices ? ratio(r.row.noise, slices->row.noise) : cell()},
                           {"beyond_exact", maybe(r.row.noise_beyond_exact)},
                           {"exact_ratio",
                            slices ? ratio(r.row.noise_beyond_exact, slices->row.noise_beyond_exact) : cell()},
                           {"beyond", maybe(r.row.noise_beyond_camera)},
                           {"beyond_ratio",
                            slices ? ratio(r.row.noise_beyond_camera, slices->row.noise_beyond_camera) : cell()},
                           {"of_map", maybe(r.row.noise_of_map)},
                           {"map_ratio", slices ? ratio(r.row.noise_of_map, slices->row.noise_of_map) : cell()},
                           {"bias", maybe(r.row.bias)},
                           {"rmse", r.row.errors.rmse}},
                 .colour = colour_of(r)});
        }
    }
    return table;
}

table_block equal_time_of(compared_scenes scenes)
{
    return rivals_of(
        scenes, "Equal time",
        "The usual layers, and of each other family the method with the least RMSE that needs at most 1.1 x "
        "their time for the map and the look-ups together, at its best constant bias.",
        equal_time, [](const layered_result& r) { return r.total_ms(); });
}

table_block equal_memory_of(compared_scenes scenes)
{
    return rivals_of(scenes, "Equal memory", "The same with at most 1.1 x the memory of the layers' map.", equal_memory,
                     [](const layered_result& r) { return r.row.map_bytes; });
}

table_block models_of(compared_scenes scenes)
{
    table_block table{.title = "Models of depth within a layer",
                      .text = "The same layers by two moments (variance), by four and by an exponential, side by side.",
                      .columns = {{.key = "scene", .label = "scene"},
                                  {.key = "method", .label = "method"},
                                  error_column("rmse", "RMSE", 1),
                                  error_column("leak", "leak", 1),
                                  error_column("acne", "acne", 1),
                                  error_column("bias", "bias", 1),
                                  number_column("bytes", "map, MiB", 1),
                                  number_column("look_up", "ns per sample", 0)},
                      .rows = {}};
    for (column& c : table.columns) c.best = best::none;
    for (const compared_layers& scene : scenes)
        for (const layered_result& r : scene.results)
            if (r.method->family == layers_family->id && r.is_usual() && r.constant_bias == 0)
                table.rows.push_back({.cells = {{"scene", scene.scene.label},
                                                {"method", r.label()},
                                                {"rmse", r.row.errors.rmse},
                                                {"leak", r.row.errors.leak},
                                                {"acne", r.row.errors.acne},
                                                {"bias", maybe(r.row.bias)},
                                                {"bytes", r.row.map_bytes / 1048576},
                                                {"look_up", r.row.ns_per_receiver}}});
    return table;
}

void add_settings_blocks(compared_scenes scenes, std::vector<block>& to)
{
    for (const compared_layers& scene : scenes) {
        pictures_block shown{.title = "Settings of layers: " + scene.scene.label,
                             .text =
                                 "After Figure 9 of Andersson et al.: tiles of fewer layers join what moves apart; a "
                                 "tile that never looks up its neighbour shows its border; without the filter across "
                                 "the motion there are streaks.",
                             .columns = 3,
                             .compare = true,
                             .pictures = {{scene.reference, scene.scene.label + " by ray tracing", "the reference"}}};
        table_block table{.title = "Numbers of settings: " + scene.scene.label,
                          .text = fmt::format("Errors are in thousandths of visibility. The usual map has {0} x {0} "
                                              "texels. Time-dependent and deep maps are of more samples, too.",
                                              scene.map_resolution),
                          .columns = columns_of(),
                          .rows = {}};
        for (const layered_result& r : scene.results) {
            const bool is_layers = r.method->id == usual_layers;
            if (r.constant_bias != 0 || !(r.is_of(of_settings) || is_layers)) continue;
            table.rows.push_back({.cells = cells_of(r), .colour = colour_of(r)});
            if (is_layers)
                shown.pictures.push_back(
                    {r.picture, scene.scene.label + " by " + r.label(), r.label() + ": " + in_short(r)});
        }
        if (table.rows.size() < 2) continue;
        to.push_back(std::move(shown));
        to.push_back(std::move(table));
    }
}

} // namespace gnomon::evaluation
