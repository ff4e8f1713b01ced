#include "evaluation/soft/soft_scene.hpp"
#include "renderer/scene/soft_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<soft_scene> entry{
    scene_facts{.id = "pillar",
                .label = "a pillar before a distant brick wall",
                .order = 130,
                .text = "After Figure 10 of the paper: the contact shadows of both sides of the pillar should be "
                        "equally hard. Beside the shadow of the distant wall a search finds the mean of two blockers, "
                        "and every method that knows one blocker depth makes the contact too soft there."},
    renderer::pillar_stage};

} // namespace

} // namespace gnomon::evaluation
