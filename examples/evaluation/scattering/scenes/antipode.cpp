#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "antipode",
                .label = "a tower with the light behind the camera",
                .order = 250,
                .text = "The other end of Figure 14 of the paper: view rays in the middle run along the light, and no "
                        "depth of the rectified map is greater than theirs. Methods that underestimate scattering lose "
                        "the light there."},
    renderer::antipode_stage};

} // namespace

} // namespace gnomon::evaluation
