// A moving scene as the registry knows it. A scene is one file in scenes/.
#pragma once

#include "evaluation/core/scene.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A scene in motion and its tags. Tags name what only some methods are measured for: "surfaces", of many triangles
// each, whose ids may be those of surfaces, and "covers", triangles that hide a texel while the shutter is open.
struct motion_scene_facts {
    std::vector<std::string> tags{};
    std::string figure{}; // the number of a figure of Palmer 2011 that is made again, from close by

    bool has(std::string_view tag) const { return std::ranges::count(tags, tag) > 0; }
};

class motion_scene : public scene_entry {
  public:
    motion_scene(scene_facts facts, std::function<renderer::moving_stage(double aspect)> make,
                 motion_scene_facts its_motion = {})
        : scene_entry(std::move(facts)), motion(std::move(its_motion)), stage(std::move(make))
    {}

    const motion_scene_facts motion;
    const std::function<renderer::moving_stage(double aspect)> stage;
};

} // namespace gnomon::evaluation
