#include "evaluation/core/progress.hpp"
#include "evaluation/motion/motion_scene.hpp"
#include "renderer/import/model.hpp"
#include "renderer/scene/layered_stages.hpp"

#include <filesystem>
#include <memory>

#ifndef GNOMON_TEST_MODELS
#define GNOMON_TEST_MODELS ""
#endif

namespace gnomon::evaluation {

namespace {

// A skinned bull, of Debian's assimp-testmodels, and a time of its run.
const std::filesystem::path models(GNOMON_TEST_MODELS), runner_file = models / "X" / "Testwuson.X";
constexpr double runner_open = 0.2, runner_closing = runner_open + 1. / 24; // a frame of film

std::unique_ptr<registered<motion_scene>> registered_runner()
{
    if (models.empty() || !exists(runner_file)) return nullptr;
    return std::make_unique<registered<motion_scene>>(
        scene_facts{.id = "runner",
                    .label = "a runner between columns",
                    .order = 325,
                    .text = "After Figure 14 of Andersson et al. A skinned model runs between columns, whose shadows "
                            "are static. This scene is absent without Debian's assimp-testmodels."},
        [](double aspect) {
            return renderer::runner(renderer::load_animated_model(runner_file, "", runner_open, runner_closing),
                                    aspect);
        },
        motion_scene_facts{.tags = {"layered"}});
}

const std::unique_ptr<registered<motion_scene>> entry = registered_runner();

} // namespace

} // namespace gnomon::evaluation
