// The registries in JSON: what identifies rows of the report, for programs that read them.
#pragma once

#include <string>

namespace gnomon::evaluation {

// An object of arrays "families", "methods", "maps", "receivers", "scenes", "references" and "drivers", each in order of
// presentation, of objects with id and label. Methods have their family, map and format too.
std::string registry_facts();

} // namespace gnomon::evaluation
