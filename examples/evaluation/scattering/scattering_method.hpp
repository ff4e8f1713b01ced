// Methods of single scattering by a directional light: a map is built from the light's shadow map, and a look-up returns
// the visibility of a view ray from the camera to a surface, which is in-scattering over its value without occluders.
//
// A method is a class on scattering_method in a file of `methods`. Map and look-up know the scene, light axes, and nothing
// of pictures: the driver asks for many view rays at once, and from several threads.
#pragma once

#include "evaluation/core/method.hpp"
#include "scattering_scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A view ray from the camera to a surface.
struct view_segment {
    glm::vec3 end{0};    // in light axes
    float footprint = 0; // distance at the end to the view ray of the next pixel, across the ray
    glm::vec2 pixel{0};  // centre of the pixel, for patterns of jitter
};

// One step of a build.
struct build_pass {
    std::string name;        // an id: "rectify", "prefix", "mips"
    double milliseconds = 0; // on one core
};

class scattering_map {
  public:
    virtual ~scattering_map() = default;

    virtual std::size_t bytes() const = 0; // of all that a look-up reads, with mip levels

    // The steps of the build with their times, none of a method that has nothing to build.
    virtual std::vector<build_pass> passes() const { return {}; }

    // The visibility in [0, 1] of one view ray after the other. Any thread may call it, with any part of the rays.
    virtual void visibilities(std::span<const view_segment> where, std::span<float> result) const = 0;

    // Runs to time: the kernels alone, from values that have been fetched, and with the look-ups; ray by ray, and by packs
    // of rays where the method has kernels for packs. A method whose kernel fetches has the same run twice. The map and the
    // rays outlive what is returned.
    virtual std::vector<timed_look_up> timed(std::span<const view_segment> where) const = 0;

    // The exact answer in double under the weights of the map's filters, from the depths that the map was made of. None of a
    // method without a filter.
    virtual std::optional<std::vector<float>> exact(std::span<const view_segment>) const { return {}; }
};

class scattering_method : public method {
  public:
    explicit scattering_method(method_facts facts, std::string its_filter = {},
                               std::vector<std::string> its_scenes = {})
        : method(std::move(facts)), filter(std::move(its_filter)), scenes(std::move(its_scenes))
    {}

    // The depths of the scene outlive the map.
    virtual std::unique_ptr<scattering_map> build(const scattering_scene& scene) const = 0;

    const std::string filter; // an id of the weights that exact() applies, which methods may share; or empty
    const std::vector<std::string> scenes; // ids of those that compare the method; all scenes where empty
};

} // namespace gnomon::evaluation
