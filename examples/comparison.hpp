// One stage, shaded with every method and compared with two references.
#pragma once

#include <string>

#include "drivers.hpp"
#include "toolbox/stage.hpp"

namespace gnomon::demo {

// Pictures go to OUT/gallery/NAME, rows to OUT/report.json.
void compare_methods(const std::string& name, const toolbox::stage& scenery, const settings& how);

} // namespace gnomon::demo
