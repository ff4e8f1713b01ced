#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{scene_facts{.id = "cube_over_turning_plane",
                                                 .label = "a cube over a plane that turns",
                                                 .order = 170,
                                                 .text = "Figure 4.2 of Palmér. The shadowed plane turns."},
                                     [](double aspect) { return renderer::cube_over_plane(aspect, 20, 2, 0); },
                                     motion_scene_facts{.figure = "4.2"}};

} // namespace

} // namespace gnomon::evaluation
