// One stage with scattering air, rendered by every method of single scattering: pictures, numbers, rows.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/insets.hpp"
#include "evaluation/core/progress.hpp"
#include "evaluation/core/report.hpp"
#include "evaluation/core/scene.hpp"
#include "scattering_view.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::evaluation {

inline constexpr float scattering_error_scale = 0.25f; // visibility at which error colours saturate
inline constexpr float inset_contrast = 4;             // of magnified places, as in the paper

// A reference, by the id that rows have, and in words.
struct scattering_reference {
    const char *id, *label;
};
inline constexpr std::array scattering_references{
    scattering_reference{"filtered", "the exact count of the same rectified map, in double"},
    scattering_reference{"traced", "ray tracing of lit and unlit segments"}};

struct scattering_part {
    std::string id, name, colour; // of a magnified place
};

struct scattering_row_set {
    const scattering_method* of;
    std::string picture, error;   // file names; errors are those against ray tracing
    std::vector<report_row> rows; // of each reference that applies, part and number of lanes
    std::vector<build_pass> passes{};

    // The row of one view ray at a time, or of the most at a time. A null pointer where the reference does not apply.
    const report_row* find(std::string_view reference, std::string_view part = {}, bool by_packs = false) const;
    // The same against ray tracing, which every method has.
    const report_row& traced(std::string_view part = {}, bool by_packs = false) const;
};

struct compared_scattering_scene {
    scene_facts scene;
    settings how; // width and height are those of the pictures
    std::size_t receivers;
    std::vector<scattering_part> parts;
    std::string picture; // by ray tracing
    std::vector<scattering_row_set> methods;

    const scattering_row_set& method(std::string_view id) const;
};

// Methods that are compared in a scene.
std::vector<const scattering_method*> scattering_methods(std::string_view scene);

// Steps that a comparison of this scene begins.
std::size_t steps_of_comparison(std::string_view scene);

// Pictures go to the folder; their names begin with the id of the scene.
compared_scattering_scene compare_scattering_methods(const scene_facts& scene, const scattering_view& view,
                                                     const settings& how, const std::filesystem::path& folder,
                                                     steps& all);

// Visibilities of all view rays, by all threads.
std::vector<float> visibilities_of(const scattering_map& map, std::span<const view_segment> where);

} // namespace gnomon::evaluation
