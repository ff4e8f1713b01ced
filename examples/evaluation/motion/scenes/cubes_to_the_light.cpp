#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "cubes_to_the_light",
                .label = "cubes that rise to the light",
                .order = 140,
                .text = "After Hong &amp; Oh. Surfaces in motion shadow themselves, and fine triangles make long "
                        "lists."},
    renderer::cubes_to_the_light, motion_scene_facts{.tags = {"surfaces", "layered", "analytic"}}};

} // namespace

} // namespace gnomon::evaluation
