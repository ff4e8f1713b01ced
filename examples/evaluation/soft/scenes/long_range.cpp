#include "evaluation/soft/soft_scene.hpp"
#include "renderer/scene/soft_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<soft_scene> entry{
    scene_facts{
        .id = "long_range",
        .label = "shadows over a long range",
        .order = 110,
        .text = "After Figure 9 of the paper: signs and cables high above the ground, and a bench on it. Long-range "
                "shadows are soft, the bench's are hard where it stands. A search of 15 texels makes long-range "
                "shadows too hard. Two moments leak. Without interpolation there are stripes at hard boundaries."},
    renderer::long_range_stage};

} // namespace

} // namespace gnomon::evaluation
