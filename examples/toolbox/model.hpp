// Models from files: OBJ, PLY, glTF, STL and whatever else Assimp reads.
#pragma once

#include <filesystem>

#include "scene.hpp"

namespace gnomon::toolbox {

// The triangles of a file, y up, scaled so that the longest side of the bounds is one, standing on y = 0 above the
// origin. Points, lines and triangles that have a corner at infinity or nowhere (NaN) are left out.
// Throws std::runtime_error with one line, "FILE: cause", where nothing is left to be seen.
scene load_model(const std::filesystem::path& file);

} // namespace gnomon::toolbox
