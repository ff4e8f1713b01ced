#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "gate",
                .label = "the shadow of a gate",
                .order = 220,
                .text =
                    "After Figure 17 of the paper: a gate of fine bars against the light. A rectified map of single "
                    "texels draws stripes that move with the camera."},
    [](double aspect) { return renderer::gate_stage(aspect, 0); },
    std::vector<paper_figure>{
        {"17",
         {"scatter6_unorm10_paper", "scatter6_unorm10_paper_filtered"},
         "Fine stripes without filtering, and a smooth picture from filtered samples of a map of moments."}}};

} // namespace

} // namespace gnomon::evaluation
