#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "tentacles_from_above",
                .label = "tentacles, from above",
                .order = 305,
                .text = "Figure 9 of Andersson et al. Up to three tentacles are between the light and a "
                        "point of the ground, each with a motion of its own: a layer less, no neighbours "
                        "or no filter across the motion show here."},
    renderer::tentacles_from_above, motion_scene_facts{.tags = {"layered", "settings"}}};

} // namespace

} // namespace gnomon::evaluation
