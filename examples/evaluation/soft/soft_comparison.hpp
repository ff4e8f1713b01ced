// One stage with an area light, shadowed by every method of soft shadows: pictures, numbers, rows.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/progress.hpp"
#include "evaluation/core/report.hpp"
#include "evaluation/core/scene.hpp"
#include "soft_stage.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::evaluation {

inline constexpr float soft_error_scale = 0.25f; // visibility at which error colours saturate
inline constexpr float usual_search = 27;        // texels, of the paper's figures and of the reference
inline constexpr int usual_rays = 256;           // of the traced reference

// A reference, by the id that rows have, and in words.
struct soft_reference {
    const char *id, *label;
};
inline constexpr std::array soft_references{
    soft_reference{"filtered", "percentage-closer soft shadows in double with the same rectangles"},
    soft_reference{"traced", "ray tracing of the light's area"}};

struct soft_part {
    std::string id, name, colour; // of a magnified place
};

struct soft_row_set {
    const soft_method* of;
    std::string picture, unbiased{}; // file names; the second where a picture without depth bias was asked for
    std::vector<std::string> errors; // of each reference
    std::vector<report_row> rows;    // of each reference, part and number of lanes
    std::optional<skipped_shares> skipped;

    // The row of one receiver at a time, or of the most at a time.
    const report_row& row(std::string_view reference, std::string_view part = {}, bool by_packs = false) const;
};

struct compared_soft_scene {
    scene_facts scene;
    settings how; // width and height are those of the pictures
    std::size_t receivers;
    double widest_penumbra; // of a blocker at the near plane, in texels
    std::vector<soft_part> parts;
    std::vector<std::string> pictures; // of each reference
    std::vector<soft_row_set> methods;

    const soft_row_set& method(std::string_view id) const;
};

std::vector<const soft_method*> soft_methods();

// Steps that a comparison begins.
std::size_t steps_of_comparison();

// Pictures go to the folder; their names begin with the id of the scene. Of the methods with these ids there are pictures
// without depth bias, too.
compared_soft_scene compare_soft_methods(const scene_facts& scene, const renderer::stage& scenery, const settings& how,
                                         const std::filesystem::path& folder, steps& all,
                                         const std::vector<std::string>& without_bias = {});

} // namespace gnomon::evaluation
