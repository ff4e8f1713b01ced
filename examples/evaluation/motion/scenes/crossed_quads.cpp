#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "crossed_quads",
                .label = "crossed quads",
                .order = 110,
                .text = "After Figure 12 of Andersson et al. One quad shadows another while both move, and both "
                        "shadow the ground. Accumulation shows each of its maps as a band."},
    renderer::crossed_quads, motion_scene_facts{.tags = {"layered", "analytic"}}};

} // namespace

} // namespace gnomon::evaluation
