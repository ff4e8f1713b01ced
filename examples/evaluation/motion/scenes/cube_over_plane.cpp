#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{scene_facts{.id = "cube_over_plane",
                                                 .label = "a cube over a plane",
                                                 .order = 160,
                                                 .text = "Figure 4.1 of Palmér. The shadowed plane is static."},
                                     [](double aspect) { return renderer::cube_over_plane(aspect, 0, 2, 0); },
                                     motion_scene_facts{.figure = "4.1"}};

} // namespace

} // namespace gnomon::evaluation
