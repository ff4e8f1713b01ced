// Models from files: glTF 2.0 by tinygltf; OBJ, PLY, STL, glTF 1.0 and other formats by Assimp.
#pragma once

#include "renderer/scene/moving_scene.hpp"
#include "renderer/scene/scene.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::renderer {

// The triangles of a file, y up, scaled so that the longest side of the bounds is one, standing on y = 0 above the
// origin. Points, lines and triangles with an infinite or NaN coordinate are left out. The model is static: of glTF,
// with the default weights of morph targets, and with meshes that have a skin placed by their joints; of other formats,
// with meshes where their nodes are, bones ignored. Throws std::runtime_error with one line, "FILE: cause", if
// something is not supported or nothing is left to be seen.
scene load_model(const std::filesystem::path& file);

// The triangles of a file while the shutter is open for a part of an animation, between two times in seconds after its
// start. Nodes, bones and, of glTF, morph targets move; vertices move straight from their places at the first time to
// those at the second. The bounds are those of both. An empty name means the first animation of the file. Throws as
// load_model, and if there is no animation of that name, if the animation moves nothing, or if the times are not in
// order within it.
moving_scene load_animated_model(const std::filesystem::path& file, std::string_view animation, double open,
                                 double closing);

} // namespace gnomon::renderer
