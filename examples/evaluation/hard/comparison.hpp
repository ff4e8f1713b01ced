// One stage, shaded with every method and compared with two references.
#pragma once

#include "evaluation/core/driver.hpp"
#include "renderer/scene/stage.hpp"

#include <string>

namespace gnomon::evaluation {

// Pictures go to OUT/gallery/NAME, rows to OUT/report.json.
void compare_methods(const std::string& name, const renderer::stage& scenery, const settings& how);

} // namespace gnomon::evaluation
