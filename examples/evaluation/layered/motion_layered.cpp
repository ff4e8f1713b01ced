// Shadows in motion for a stochastic camera, after Andersson et al. 2015: time-dependent, deep and layered shadow maps, and
// ranges over footprints, in all scenes with the tag "layered".
#include "evaluation/core/driver.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/words.hpp"
#include "layered_frames.hpp"
#include "layered_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <thread>
#include <utility>

namespace gnomon::evaluation {

namespace {

constexpr int frames = 16;
constexpr const char* scene_of_frames = "crossed_quads";
constexpr const char* still_scene_id = "tentacles";

const motion_scene& scene_of(const char* id)
{
    return dynamic_cast<const motion_scene&>(registry_of<scene_entry>().at(id));
}

struct all_results {
    std::vector<compared_layers> scenes;
    compared_frames changes;
    static_costs still;
    std::vector<moving_costs> cubes;
};

page page_of(const all_results& found, const layered_sizes& size)
{
    page result{.driver = "motion_layered",
                .title = "Shadows in motion, stochastic",
                .family = "motion",
                .summary =
                    "Shadows of what moves for a camera of a few samples per pixel, each at a time of its own: "
                    "time-dependent, deep and layered filtered shadow maps, and ranges over footprints.",
                .blocks = {text_block{.text = introduction_of(size)}}};
    const compared_scenes scenes = found.scenes;
    const auto add = [&](block b) { result.blocks.push_back(std::move(b)); };
    add(goals_of(scenes, found.still));
    for (const compared_layers& scene : scenes) add_scene_blocks(scene, result.blocks);
    add(noise_of(scenes));
    add(models_of(scenes));
    add(equal_time_of(scenes));
    add(equal_memory_of(scenes));
    add(bias_chart(scenes));
    add(steps_chart(scenes));
    add(rivals_chart(scenes));
    add(chart_of(found.cubes));
    add_settings_blocks(scenes, result.blocks);
    for (block& b : blocks_of(found.changes)) add(std::move(b));
    const compared_layers& first = scenes.front();
    const layered_result* layers = first.usual(usual_layers);
    result.front = {layers ? layers->picture : first.reference, first.scene.label + " with blurred shadows",
                    "Few samples of map and camera, filtered along their motion."};
    return result;
}

void motion_layered(const settings& how)
{
    const layered_sizes size = layered_sizes_of(how);
    const std::filesystem::path folder = how.folder("motion_layered");
    auto scenes = registry_of<scene_entry>().all_of<motion_scene>();
    std::erase_if(scenes, [](const motion_scene* one) { return !one->motion.has("layered"); });
    all_results found{std::vector<compared_layers>(scenes.size()), {}, {}, {}};
    std::vector<std::function<void()>> tasks;
    std::optional<steps> all;
    for (std::size_t i = 0; i < scenes.size(); ++i)
        tasks.emplace_back([&, i] {
            all->begin(scenes[i]->label);
            found.scenes[i] = compare_layers(*scenes[i], size, folder);
        });
    layered_sizes smaller = size;
    for (int* length : {&smaller.width, &smaller.height, &smaller.map_resolution}) *length /= 2;
    smaller.reference_times = std::min(size.reference_times, 256);
    tasks.emplace_back([&] {
        all->begin("from frame to frame");
        found.changes = compare_frames(scene_of(scene_of_frames), smaller, frames, folder);
    });
    tasks.emplace_back([&] {
        all->begin("what does not move, and cubes that do");
        found.still = static_costs_of(scene_of(still_scene_id), size);
        for (const moving_cubes& cubes : cubes_to_cost) found.cubes.push_back(moving_costs_of(cubes, smaller));
    });
    all.emplace("motion_layered", tasks.size());
    run_tasks(tasks, !size.full && std::thread::hardware_concurrency() > 1 ? 2 : 1);
    write_page(folder, page_of(found, size));
    std::vector<report_row> rows = found.changes.rows;
    for (const compared_layers& scene : found.scenes)
        for (const layered_result& r : scene.results) rows.push_back(r.row);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{
    driver{.id = "motion_layered", .label = "Shadows in motion, stochastic", .order = 62, .run = motion_layered}};

} // namespace

} // namespace gnomon::evaluation
