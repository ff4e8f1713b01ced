#include "evaluation/core/driver.hpp"
#include "hazy_scene.hpp"
#include "map_pictures.hpp"
#include "renderer/import/model.hpp"
#include "scattering_beyond.hpp"
#include "scattering_costs.hpp"
#include "scattering_frames.hpp"
#include "scattering_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace gnomon::evaluation {

namespace {

constexpr std::array<const char*, 2> first_seen{"scatter4_unorm16_paper", "scatter6_unorm16"};

// Pictures and maps of a part of the size in the quick setting; the paper's maps in the full one.
settings sizes_of(settings how)
{
    if (how.supersampling == 1) how.width = how.width * 3 / 8, how.height = how.height * 3 / 8, how.map_resolution /= 2;
    how.supersampling = 1; // as in the paper
    return how;
}

page page_of(const char* id, const std::string& title, const std::string& summary)
{
    return {.driver = id, .title = title, .family = "scattering", .summary = summary, .front = {}, .blocks = {}};
}

text_block introduction(const settings& how)
{
    return {
        .title = {},
        .text = fmt::format(
            "Light that haze scatters once, after Section 5 of Peters et al., <i>Improved Moment Shadow Maps for "
            "Translucent Occluders, Soft Shadows and Single Scattering</i> (JCGT 2017). The shadow map of a "
            "directional "
            "light is resampled so that each view ray is a row of constant depth. Weighted prefix averages over the "
            "rows "
            "hold the shadow of every view ray, which one look-up by moments returns.\n\nPictures have {} x {} pixels, "
            "shadow maps {} x {} texels, rectified maps {} columns and {} rows. Surfaces are shadowed by rays, so that "
            "only the air differs. Two references for the visibility of a view ray, its in-scattering over the value "
            "without occluders: the exact count of the same rectified map under the same weights, in double, against "
            "which only the reconstruction counts; and lit and unlit segments by ray tracing, integrated in closed "
            "form.",
            how.width, how.height, how.map_resolution, how.map_resolution, how.map_resolution / 2, how.map_resolution)};
}

void write(const compared_scattering_scene& shown, page& to, std::vector<report_row>& rows)
{
    for (block& b : blocks_of(shown, {first_seen[0], first_seen[1]})) to.blocks.push_back(std::move(b));
    for (const scattering_row_set& m : shown.methods) rows.insert(rows.end(), m.rows.begin(), m.rows.end());
}

void set_front(page& of, const compared_scattering_scene& shown)
{
    const scattering_row_set& best = shown.method(first_seen[1]);
    of.front = shown_picture{best.picture, alt_of(shown, best), escaped(best.of->label)};
}

struct shown_stage {
    shown_stage(const hazy_scene& scene, const settings& how)
        : stage(scene.stage(double(how.width) / how.height)), view(stage, how)
    {}
    const renderer::scattering_stage stage;
    const scattering_view view;
};

void single_scattering(const settings& given)
{
    const settings how = sizes_of(given);
    const std::filesystem::path folder = how.folder("single_scattering");
    const std::vector<const hazy_scene*> scenes = registry_of<scene_entry>().all_of<hazy_scene>();
    std::size_t count = steps_of_gate_frames() + steps_of_entering_frames() + steps_of_fog() + steps_of_layers();
    for (const hazy_scene* s : scenes) count += steps_of_comparison(s->id);
    steps all("single_scattering", count + 1);
    page result = page_of("single_scattering", "Single scattering",
                          "Shafts of light in haze by one look-up of moments per pixel, and by ray marching.");
    result.blocks.push_back(introduction(how));
    std::vector<report_row> rows;
    const auto add = [&](page_part&& part) {
        std::ranges::move(part.blocks, std::back_inserter(result.blocks));
        rows.insert(rows.end(), part.rows.begin(), part.rows.end());
    };
    std::unique_ptr<shown_stage> first;
    for (const hazy_scene* s : scenes) {
        auto shown = std::make_unique<shown_stage>(*s, how);
        const compared_scattering_scene found = compare_scattering_methods(*s, shown->view, how, folder, all);
        if (!first) {
            set_front(result, found);
            result.blocks.push_back(rectification_block(shown->view, folder));
        }
        if (s->id == "tower") result.blocks.push_back(bounds_block(first->view, shown->view, folder));
        write(found, result, rows);
        for (const paper_figure& figure : s->figures) result.blocks.push_back(block_of(found, figure));
        if (s->id == "gate") add(compare_gate_frames(found, folder, all));
        if (s->id == "entering") add(compare_entering_frames(found, folder, all));
        if (!first) first = std::move(shown);
    }
    all.begin("costs");
    for (block& b : scattering_costs(first->stage, rows, std::min(4 * how.map_resolution, 2048)))
        result.blocks.push_back(std::move(b));
    add(compare_layers(how, folder, all));
    add(compare_fog(how, folder, all));
    write_page(folder, result);
    merge_report(how.out / "report.json", rows);
}

void scattering_model(const settings& given)
{
    const settings how = sizes_of(given);
    const std::filesystem::path folder = how.folder("scattering_model");
    const renderer::scattering_stage stage =
        renderer::hazy_model_stage(renderer::load_model(how.model.file), double(how.width) / how.height);
    const scene_entry& scene = registry_of<scene_entry>().at("model");
    steps all("scattering_model", steps_of_comparison(scene.id));
    page result = page_of("scattering_model", fmt::format("A model in haze: {}", stage.world.name),
                          "A model from a file in scattering air, by every method of single scattering.");
    result.blocks.push_back(introduction(how));
    const scattering_view view(stage, how);
    const compared_scattering_scene found = compare_scattering_methods(scene, view, how, folder, all);
    std::vector<report_row> rows;
    write(found, result, rows);
    set_front(result, found);
    write_page(folder, result);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{
    driver{.id = "single_scattering", .label = "Single scattering", .order = 17, .run = single_scattering}};
const registered<driver> of_model{driver{
    .id = "scattering_model", .label = "A model in haze", .order = 73, .run = scattering_model, .of = subject::model}};

} // namespace

} // namespace gnomon::evaluation
