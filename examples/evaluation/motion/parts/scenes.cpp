// Every moving scene by every method.
#include "evaluation/motion/scene_blocks.hpp"

#include <memory>

namespace gnomon::evaluation {

namespace {

part_run scenes(const motion_settings& how)
{
    auto all = registry_of<scene_entry>().all_of<motion_scene>();
    std::erase_if(all, [](const motion_scene* one) { return !one->motion.is_analytic(); });
    const auto found = std::make_shared<std::vector<scene_results>>(all.size());
    part_run result;
    for (std::size_t i = 0; i < all.size(); ++i)
        result.tasks.push_back([=, scene = all[i]] {
            const renderer::moving_stage stage = scene->stage(double(how.size.width) / how.size.height);
            (*found)[i] = compare_scene(*scene, scene->motion, stage, how.size, how.folder);
        });
    result.results = [=] {
        part_results r;
        for (const scene_results& scene : *found) {
            for (const scene_row& one : scene.rows) r.rows.push_back(one.row);
            add_scene_blocks(scene, r.blocks);
        }
        add_close_up_blocks(*found, r.blocks);
        add_equal_error_blocks(*found, r.blocks);
        add_surface_blocks(*found, r.blocks);
        add_merge_blocks(*found, r.blocks);
        add_cover_blocks(*found, r.blocks);
        const scene_results& first = found->front();
        r.front = {analytic_row(first).picture, first.scene.label + " in motion, with blurred shadows",
                   "Shadows of what moves while the shutter is open, in closed form."};
        return r;
    };
    return result;
}

const registered<motion_part> entry{
    motion_part{.id = "scenes", .label = "scenes in motion", .order = 10, .begin = scenes}};

} // namespace

} // namespace gnomon::evaluation
