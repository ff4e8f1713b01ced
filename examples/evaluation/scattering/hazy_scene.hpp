// Scenes of the driver of single scattering.
#pragma once

#include "evaluation/core/scene.hpp"
#include "renderer/scene/scattering_stages.hpp"

#include <functional>
#include <utility>

namespace gnomon::evaluation {

// A scene with air that scatters the light of a directional light.
class hazy_scene final : public scene_entry {
  public:
    hazy_scene(scene_facts facts, std::function<renderer::scattering_stage(double aspect)> make)
        : scene_entry(std::move(facts)), stage(std::move(make))
    {}

    const std::function<renderer::scattering_stage(double aspect)> stage;
};

} // namespace gnomon::evaluation
