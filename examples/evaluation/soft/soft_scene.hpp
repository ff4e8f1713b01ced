// Scenes of the driver of soft shadows.
#pragma once

#include "evaluation/core/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A scene whose stage has an area light.
class soft_scene final : public still_scene {
  public:
    soft_scene(scene_facts facts, std::function<renderer::stage(double aspect)> make,
               std::vector<std::string> methods_without_bias = {})
        : still_scene(std::move(facts), std::move(make)), without_bias(std::move(methods_without_bias))
    {}

    const std::vector<std::string> without_bias; // ids of methods that are shown without depth bias, too
};

} // namespace gnomon::evaluation
