#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "trapezoid",
                .label = "a bar, known in closed form",
                .order = 210,
                .text = "A bar passes below a light that is far away, so that the exact answer is known."},
    renderer::trapezoid};

} // namespace

} // namespace gnomon::evaluation
