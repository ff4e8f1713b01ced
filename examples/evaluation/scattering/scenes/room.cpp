#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "room",
                .label = "a hall with windows",
                .order = 200,
                .text =
                    "After Figures 15 and 19 of the paper: shafts of light fall through windows, walls are thin, and "
                    "an opening in the far wall shows a chamber that no light reaches. The view rays through the "
                    "opening should be no brighter than those beside it, but errors of reconstruction make it "
                    "brighter. A coarse texel leaks through the walls."},
    renderer::room_stage};

} // namespace

} // namespace gnomon::evaluation
