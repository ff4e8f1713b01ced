#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "tentacles",
                .label = "tentacles",
                .order = 300,
                .text = "Figure 1 of Andersson et al. Tentacles bend, each to the other side than its "
                        "neighbours, one below the other. Cups along them cast stripes."},
    renderer::tentacles, motion_scene_facts{.tags = {"layered", "rivals"}}};

} // namespace

} // namespace gnomon::evaluation
