#include "evaluation/motion/motion_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "cube_near_turning_plane",
                .label = "a cube close to a plane that turns a little",
                .order = 180,
                .text = "Figure 4.3 of Palmér. The shadowed plane turns a little, close to the cube."},
    [](double aspect) { return renderer::cube_over_plane(aspect, 5, 1, -1); }, motion_scene_facts{.figure = "4.3"}};

} // namespace

} // namespace gnomon::evaluation
