#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{scene_facts{.id = "random_cubes",
                                                 .label = "400 random cubes",
                                                 .order = 150,
                                                 .text = "After Hong &amp; Oh. Each cube has a path of its own."},
                                     [](double aspect) { return renderer::random_cubes(aspect, 400, 0.5f); },
                                     motion_scene_facts{.tags = {"surfaces", "covers", "layered", "analytic"}}};

} // namespace

} // namespace gnomon::evaluation
