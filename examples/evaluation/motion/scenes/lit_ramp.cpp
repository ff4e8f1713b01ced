#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "lit_ramp",
                .label = "a ramp that shadows nothing",
                .order = 200,
                .text = "After Figure 10 of Andersson et al. The ramp moves towards the light and is lit "
                        "everywhere at all times. A method that forgets at which time a surface was where makes "
                        "it darker."},
    renderer::lit_ramp, motion_scene_facts{.tags = {"layered", "analytic"}}};

} // namespace

} // namespace gnomon::evaluation
