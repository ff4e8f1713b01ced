// Scenes of the driver of single scattering.
#pragma once

#include "evaluation/core/scene.hpp"
#include "renderer/scene/scattering_stages.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A figure of Peters et al. 2017: its number, and ids of the methods that its pictures are by.
struct paper_figure {
    std::string number;
    std::vector<std::string> methods;
    std::string text{}; // what to look at
};

// A scene with air that scatters the light of a directional light.
class hazy_scene final : public scene_entry {
  public:
    hazy_scene(scene_facts facts, std::function<renderer::scattering_stage(double aspect)> make,
               std::vector<paper_figure> its_figures = {})
        : scene_entry(std::move(facts)), stage(std::move(make)), figures(std::move(its_figures))
    {}

    const std::function<renderer::scattering_stage(double aspect)> stage;
    const std::vector<paper_figure> figures;
};

} // namespace gnomon::evaluation
