// A moving scene as the registry knows it. A scene is one file in scenes/.
#pragma once

#include "evaluation/core/scene.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A scene in motion and its tags. Tags name what only some methods are measured for: "surfaces", of many triangles
// each, whose ids may be those of surfaces, and "covers", triangles that hide a texel while the shutter is open.
// "layered" scenes are those of the driver motion_layered; without the tag "analytic" they are no others'. Its methods name
// the tags "rivals", "settings" and "dense" (layered/layered_method.hpp).
struct motion_scene_facts {
    std::vector<std::string> tags{};
    std::string figure{}; // the number of a figure of Palmer 2011 that is made again, from close by

    bool has(std::string_view tag) const { return std::ranges::count(tags, tag) > 0; }
    bool is_analytic() const { return !has("layered") || has("analytic"); }
};

// A stage by its aspect ratio alone, or also by true for all of the detail that papers have, which takes long.
class motion_scene : public scene_entry {
  public:
    template <class Make>
    motion_scene(scene_facts facts, Make make, motion_scene_facts its_motion = {})
        : scene_entry(std::move(facts)), motion(std::move(its_motion))
    {
        if constexpr (std::is_invocable_v<Make, double, bool>) make_ = make;
        else make_ = [make](double aspect, bool) { return make(aspect); };
    }

    renderer::moving_stage stage(double aspect, bool full = false) const { return make_(aspect, full); }

    const motion_scene_facts motion;

  private:
    std::function<renderer::moving_stage(double aspect, bool full)> make_;
};

} // namespace gnomon::evaluation
