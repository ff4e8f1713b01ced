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
    renderer::tower_stage,
    std::vector<paper_figure>{{"14",
                               {"scatter_csm", "scatter4_unorm16_half", "scatter4_unorm16_least",
                                "scatter4_unorm16_most", "scatter4_unorm16_paper", "scatter4_unorm16"},
                               "With an overestimation of 1/2 and of 1 the light is seen through the tower. With 0, "
                               "and with one that adapts to "
                               "the "
                               "angle between view ray and light, no light is."}}};

} // namespace

} // namespace gnomon::evaluation
