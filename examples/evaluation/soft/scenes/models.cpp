#include "evaluation/soft/soft_scene.hpp"
#include "renderer/scene/soft_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<soft_scene> entry{
    scene_facts{
        .id = "models",
        .label = "two models over a plane",
        .order = 120,
        .text =
            "After Figure 8 of the paper: a thick knot and a chair of thin parts. Shadows harden where things touch."},
    renderer::models_stage};

} // namespace

} // namespace gnomon::evaluation
