// The shadow maps of ranges of one moving scene. A map that others start from is built once and kept.
#pragma once

#include "range_maps.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

class map_source {
  public:
    // The scene and the light outlive the source.
    map_source(const renderer::moving_scene& scene, const renderer::moving_camera& moving_light, int map_resolution)
        : world(scene), light(moving_light), resolution(map_resolution)
    {}
    map_source(const map_source&) = delete;
    map_source& operator=(const map_source&) = delete;

    // The map of a method of class range_method. Throws std::invalid_argument where none has the id.
    std::shared_ptr<const range_shadow_map> map(std::string_view method, const parameters& how = {});

    // The surface of each triangle; see renderer/scene/surface_ids.hpp.
    std::span<const std::uint32_t> surface_ids();

    const renderer::moving_scene& world;
    const renderer::moving_camera& light;
    const int resolution;

  private:
    std::map<std::pair<std::string, parameters>, std::shared_ptr<const range_shadow_map>> kept_;
    std::optional<std::vector<std::uint32_t>> ids_;
};

} // namespace gnomon::evaluation
