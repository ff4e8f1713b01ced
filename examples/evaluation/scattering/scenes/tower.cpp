#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "tower",
                .label = "a tower against the light",
                .order = 240,
                .text =
                    "After Figure 14 of the paper: the light is right behind the pinnacles of a tower, so that view "
                    "rays in the middle run against it and no depth of the rectified map is less than theirs. "
                    "Methods that overestimate scattering there show the light through the tower."},
    renderer::tower_stage};

} // namespace

} // namespace gnomon::evaluation
