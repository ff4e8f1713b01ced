// A model from a file in motion, by every method of a stochastic camera.
#include "evaluation/core/driver.hpp"
#include "layered_page.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace gnomon::evaluation {

namespace {

void layered_model(const settings& how)
{
    const auto& [file, animation, shutter] = how.model;
    const layered_sizes size = layered_sizes_of(how);
    const std::filesystem::path folder = how.folder("layered_model");
    const renderer::moving_scene model = renderer::load_animated_model(file, animation, shutter[0], shutter[1]);
    const std::string name = escaped(model.open.name);
    const std::string moved_by =
        animation.empty() ? "its first animation" : "its animation <i>" + escaped(animation) + "</i>";
    const motion_scene scene(
        {.id = "model",
         .label = name,
         .text = fmt::format("A model from a file on a ground plane, moved by {}. The shutter opens {:g} s after the "
                             "start of the animation and closes at {:.4g} s; in between, corners move along straight "
                             "lines.",
                             moved_by, shutter[0], shutter[1])},
        [&](double aspect) { return renderer::animated_model_stage(model, aspect); },
        motion_scene_facts{.tags = {"layered"}});
    const std::array found{compare_layers(scene, size, folder)};
    page shown{.driver = "layered_model",
               .title = "A model in motion, stochastic: " + model.open.name,
               .family = "motion",
               .summary =
                   "A model from a file on a ground plane for a camera of a few samples per pixel, by every "
                   "method of stochastic shadows.",
               .front = shown_picture{found[0].reference, name + " in motion", name + " in motion, by ray tracing."},
               .blocks = {text_block{.text = introduction_of(size)}}};
    add_scene_blocks(found[0], shown.blocks);
    for (table_block table : {noise_of(found), models_of(found)}) shown.blocks.push_back(std::move(table));
    for (chart_block chart : {bias_chart(found), steps_chart(found)}) shown.blocks.push_back(std::move(chart));
    write_page(folder, shown);
    std::vector<report_row> rows;
    for (const layered_result& r : found[0].results) rows.push_back(r.row);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{driver{.id = "layered_model",
                                      .label = "A model in motion, stochastic",
                                      .order = 82,
                                      .run = layered_model,
                                      .of = subject::animation,
                                      .scenes_of = "motion_layered"}};

} // namespace

} // namespace gnomon::evaluation
