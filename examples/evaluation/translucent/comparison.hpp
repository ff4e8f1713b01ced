// All methods on the stage of translucent occluders: what the page tells of them.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/settings.hpp"
#include "study.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

inline constexpr float translucent_error_scale = 0.5f; // visibility at which error colours saturate

// Ways to show a shadow of which there are pictures of every method: ID-SHOWING.png, and ID-SHOWING-REFERENCE-error.png.
inline constexpr std::array pictured{showings[0], showings[1], showings[3]};

inline bool is_drawn(const translucent_method& m, const showing& how)
{
    return m.is.between_bounds || how.in_smoke == bound::lower;
}

struct compared_translucent_method {
    const translucent_method* of;
    double opaque_ms = 0; // of a build without fragments
    std::vector<report_row> rows{}, close_up_rows{};

    // The row of these parameters, of one receiver at a time or of the most at a time.
    const report_row& row(const std::string& reference, const std::string& part = {}, const showing& how = showings[0],
                          bool by_packs = false) const;
    const report_row& row(const std::string& reference, const std::string& part, const parameters& of_row,
                          bool by_packs = false) const;
};

// A picture of one place by one method, and its errors there.
struct artifact_picture {
    std::string name, label; // NAME.png and NAME-error.png
    double leak = 0, acne = 0;
};

struct translucent_comparison {
    settings how;
    int width = 0, height = 0, map_resolution = 0;
    std::size_t receivers = 0, fragments = 0, taps = 0;
    int layers = 0;               // the most fragments in a texel
    double close_up_overdraw = 0; // receivers in smoke of a pixel
    std::vector<view_inset> insets{};
    std::vector<compared_translucent_method> methods{};
    std::vector<artifact_picture> on_surfaces{}, in_smoke{}; // Figure 6, a and b

    const compared_translucent_method& method(const std::string& id) const;
};

// Errors of the paper's method and of what mends it; times and memory; all errors.
table_block mending_table(const translucent_comparison& all);
table_block cost_table(const translucent_comparison& all);
table_block number_table(const translucent_comparison& all);

page translucent_page(const translucent_comparison& all);

} // namespace gnomon::evaluation
