#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "moving_eye",
                .label = "a camera that moves",
                .order = 330,
                .text = "Figure 8 B of Andersson et al. The camera moves against the motion of the plates, so that the "
                        "footprint of each of its samples is slanted over place and time, on what is static, too."},
    renderer::moving_eye, motion_scene_facts{.tags = {"layered"}}};

} // namespace

} // namespace gnomon::evaluation
