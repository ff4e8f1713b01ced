#include "evaluation/core/driver.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "scene_blocks.hpp"

#include <fmt/format.h>

#include <span>

namespace gnomon::evaluation {

namespace {

// A model from a file on a ground plane, from one time of an animation to another, by every method.
void animated_model(const settings& how)
{
    const auto& [file, animation, shutter] = how.model;
    const motion_settings with{motion_sizes_of(how), how.folder("animated_model")};
    const renderer::moving_stage stage =
        renderer::animated_model_stage(renderer::load_animated_model(file, animation, shutter[0], shutter[1]),
                                       double(with.size.width) / with.size.height);
    const std::string& name = stage.world.open.name;
    const scene_results found = compare_scene({.id = "model", .label = name}, {}, stage, with.size, with.folder);
    const std::string moved_by =
        animation.empty() ? "its first animation" : "its animation <i>" + escaped(animation) + "</i>";
    page shown{
        .driver = "animated_model",
        .title = "A model in motion: " + name,
        .family = "motion",
        .summary = "A model from a file on a ground plane while the shutter is open, by every method.",
        .front = shown_picture{analytic_row(found).picture, name + " in motion", escaped(name) + " in motion."},
        .blocks = {text_block{
            .text = fmt::format("A model from a file on a ground plane, moved by {}. The shutter opens {:g} s after "
                                "the start of the animation and closes at {:.4g} s; in between, corners move along "
                                "straight lines.\n\n{}",
                                moved_by, shutter[0], shutter[1], words_of(with))}}};
    add_scene_blocks(found, shown.blocks);
    add_equal_error_blocks(std::span(&found, 1), shown.blocks);
    write_page(with.folder, shown);
    std::vector<report_row> rows;
    for (const scene_row& one : found.rows) rows.push_back(one.row);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{driver{.id = "animated_model",
                                      .label = "A model in motion",
                                      .order = 80,
                                      .run = animated_model,
                                      .of = subject::animation,
                                      .scenes_of = "motion_analytic"}};

} // namespace

} // namespace gnomon::evaluation
