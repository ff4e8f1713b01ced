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
    renderer::room_stage,
    std::vector<paper_figure>{
        {"15",
         {"ray_march_32_unorm16", "scatter_csm", "scatter4_unorm16_paper", "scatter6_unorm10_paper_filtered"},
         "Convolution shadow maps ring. The opening, first of the magnified places, should not be brighter than the "
         "wall "
         "around."},
        {"19",
         {"scatter6_unorm10_paper", "scatter6_unorm16_paper"},
         "Light leaks through thin walls, more so with 10 bits for a moment, which leave splotches besides."}}};

} // namespace

} // namespace gnomon::evaluation
