#include "evaluation/soft/soft_scene.hpp"
#include "renderer/scene/soft_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<soft_scene> entry{
    scene_facts{.id = "grazing",
                .label = "a column on ground at a grazing angle",
                .order = 140,
                .text = "After Figure 11 of the paper: the ground is lit at an angle of incidence of 80 degrees. A "
                        "filter region holds depths of the ground far in front of the receiver, so a bias that does "
                        "not follow the plane leaves wrong self-shadowing just outside of the penumbra."},
    renderer::grazing_stage, std::vector<std::string>{"pcss_27", "msm4_soft"}};

} // namespace

} // namespace gnomon::evaluation
