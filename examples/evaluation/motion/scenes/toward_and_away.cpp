#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "toward_and_away",
                .label = "toward the light and away",
                .order = 130,
                .text = "After Figure 13 of Andersson et al. Depth changes during the exposure."},
    renderer::toward_and_away, motion_scene_facts{.tags = {"layered", "analytic"}}};

} // namespace

} // namespace gnomon::evaluation
