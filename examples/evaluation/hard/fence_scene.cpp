#include "evaluation/core/scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<still_scene> entry{scene_facts{.id = "fence",
                                                .label = "a direction sign, a fence and a wall",
                                                .order = 10,
                                                .text = "A bird's eye view of a direction sign, a fence with thin "
                                                        "slats and a thin wall, after Figure 4 of Peters et al., "
                                                        "<i>Improved Moment Shadow Maps for Translucent Occluders, "
                                                        "Soft Shadows and Single Scattering</i> (JCGT 2017). "
                                                        "The scene provokes every artifact there is: where one, two or "
                                                        "three surfaces lie between the light and the "
                                                        "ground within one filter region, a filter that only knows a "
                                                        "few moments of their depths lets light through."},
                                    renderer::fence_stage};

} // namespace

} // namespace gnomon::evaluation
