#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "wrecking_ball",
                .label = "a wrecking ball",
                .order = 310,
                .text = "After Figure 14 of Andersson et al. Few large triangles: samples are cheap, so "
                        "that time-dependent maps can afford more of them."},
    renderer::wrecking_ball, motion_scene_facts{.tags = {"layered", "rivals"}}};

} // namespace

} // namespace gnomon::evaluation
