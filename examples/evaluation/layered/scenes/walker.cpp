#include "evaluation/motion/motion_scene.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/layered_stages.hpp"

namespace gnomon::evaluation {

namespace {

const registered<motion_scene> entry{
    scene_facts{.id = "walker",
                .label = "a skinned figure that walks",
                .order = 327,
                .text = "An animated glTF, models/walker.gltf beside the driver. Any other file stands in its place by "
                        "<code>./run demo motion_layered --model FILE</code>."},
    [](double aspect) {
        return renderer::walker(renderer::load_animated_model(GNOMON_LAYERED_MODELS "/walker.gltf", "walk", 0, 1. / 12),
                                aspect);
    },
    motion_scene_facts{.tags = {"layered"}}};

} // namespace

} // namespace gnomon::evaluation
