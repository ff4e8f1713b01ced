#include "evaluation/scattering/hazy_scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<hazy_scene> entry{
    scene_facts{.id = "entering",
                .label = "a dragon in shafts of light",
                .order = 230,
                .text = "After Figure 18 of the paper: as an object enters the light, view rays above it change, too, "
                        "though no light is missing there."},
    [](double aspect) { return renderer::entering_stage(aspect, true); }};

} // namespace

} // namespace gnomon::evaluation
