// One stage, shaded with every method and compared with every reference of hard shadows.
#pragma once

#include "evaluation/core/driver.hpp"
#include "renderer/scene/stage.hpp"

#include <array>
#include <string>

namespace gnomon::evaluation {

struct comparison_facts {
    std::string driver, scene, summary; // ids of the registry, and what the page is about
    std::string of_insets;              // the error that tables show of each inset
    std::array<std::string, 2> first{}; // ids of the methods that are first seen side by side
    bool is_front = false;              // the chart is the one of the gallery's front page
};

// Pictures and the page go to OUT/gallery/DRIVER, rows to OUT/report.json. The registered scene has the stage.
void compare_methods(const comparison_facts& facts, const settings& how);

// Compares all methods on a given stage.
void compare_methods(const comparison_facts& facts, const settings& how, const renderer::stage& scenery);

} // namespace gnomon::evaluation
