#include "evaluation/core/scene.hpp"
#include "renderer/scene/translucent_stage.hpp"

namespace gnomon::evaluation {

namespace {

const registered<still_scene> yard{
    scene_facts{.id = "translucent",
                .label = "smoke, coloured pipes and stained glass",
                .order = 30,
                .text = "A yard with two walls, coloured pipes, a window of stained glass, and smoke of 30 textured "
                        "planes, after Figures 5 and 6 of Peters et al., <i>Improved Moment Shadow Maps for "
                        "Translucent Occluders, Soft Shadows and Single Scattering</i> (JCGT 2017). Smoke casts "
                        "shadows on the surfaces and on itself: each of its layers is a receiver."},
    renderer::translucent_stage};

const registered<still_scene> close_up{scene_facts{.id = "smoke_close_up",
                                                   .label = "the smoke from close by",
                                                   .order = 31,
                                                   .text = "The same smoke fills the picture."},
                                       renderer::smoke_close_up_stage};

} // namespace

} // namespace gnomon::evaluation
