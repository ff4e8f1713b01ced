#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "tree_in_moving_light",
                .label = "a tree in a moving light",
                .order = 320,
                .text = "After Figure 14 of Andersson et al. Thousands of leaves are static, and the "
                        "light moves."},
    renderer::tree_in_moving_light, motion_scene_facts{.tags = {"layered", "rivals", "dense"}}};

} // namespace

} // namespace gnomon::evaluation
