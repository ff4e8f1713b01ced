#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "pillars",
                .label = "pillars, the light rises",
                .order = 105,
                .text = "After Figure 11 of Andersson et al. Only the light moves. It takes each point along a "
                        "long path over the shadow map, and the cost of an analytic receiver grows with the "
                        "number of texels on its path."},
    renderer::pillars, motion_scene_facts{.tags = {"layered", "analytic", "rivals"}}};

} // namespace

} // namespace gnomon::evaluation
