#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "chess",
                .label = "chess",
                .order = 315,
                .text = "After Figure 14 of Andersson et al. and Figures 4.4 and 4.5 of Palmér. Five "
                        "pieces move and a king falls among static ones."},
    renderer::chess, motion_scene_facts{.tags = {"layered"}}};

} // namespace

} // namespace gnomon::evaluation
