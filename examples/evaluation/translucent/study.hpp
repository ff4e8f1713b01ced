// A view of the stage with what is known of its receivers, and rows of the report from a method's answers.
#pragma once

#include "evaluation/core/report.hpp"
#include "measurement.hpp"
#include "references.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// Receivers of one material, or in one place of the picture; all receivers are the part without an id.
struct view_part {
    std::string id, label, colour;
    std::vector<std::size_t> receivers;
};

// All receivers, opaque surfaces, pipes among them, panes and smoke; and of each rectangle, with the id, the name and the
// colour of its place, the surfaces or the smoke.
struct view_inset {
    std::string id, label, colour;
    renderer::rectangle crop; // in pixels of the view
    bool of_smoke;
};
std::vector<view_part> parts_of(const translucent_view& view, std::span<const view_inset> insets = {});

// Opaque surfaces that the light reaches through smoke or glass: those of which rays arrive with a part of their light.
view_part behind_translucent_ones(const translucent_view& view, const known_visibility& traced);

// A row for each part and each reference, by the shadows of a build for each seed. The build and the times are left out.
std::vector<report_row> rows_of(const translucent_method& m, const translucent_view& view,
                                std::span<const view_part> parts, std::span<const known_visibility> references,
                                std::span<const shadows> by_seed, const showing& how);

} // namespace gnomon::evaluation
