#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "fan",
                .label = "a fan that turns by 90 degrees",
                .order = 190,
                .text = "Each corner moves along the straight line from its first place to its last, so that "
                        "triangles shear as they turn."},
    renderer::fan};

} // namespace

} // namespace gnomon::evaluation
