// One moving stage by every method, beside the mean of ray tracing at many times.
#pragma once

#include "evaluation/core/driver.hpp"
#include "evaluation/core/report.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::evaluation {

struct motion_scene {
    std::string key, title;   // key: the beginning of its files' names
    bool surfaces = false;    // also by ids of surfaces instead of triangles, and joined
    bool cover_first = false; // also by covers before lists
};

struct motion_sizes {
    int width, height, map_resolution, reference_samples;
};
motion_sizes motion_sizes_of(const settings& how);

struct motion_results {
    nlohmann::ordered_json facts; // of the scene, for the gallery
    std::vector<report_row> rows;
};

// Leaves pictures in the folder.
motion_results compare_motion(const motion_scene& listed, const renderer::moving_stage& scenery,
                              const motion_sizes& size, const std::filesystem::path& folder);

// What all scenes of a page have in common; its array "scenes" is empty.
nlohmann::ordered_json facts_of(const motion_sizes& size);

} // namespace gnomon::evaluation
