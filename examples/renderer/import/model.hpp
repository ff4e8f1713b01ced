// Models from files: glTF 2.0 by tinygltf; OBJ, PLY, STL, glTF 1.0 and whatever else Assimp reads.
#pragma once

#include "renderer/scene/moving_scene.hpp"
#include "renderer/scene/scene.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::renderer {

// The triangles of a file, y up, scaled so that the longest side of the bounds is one, standing on y = 0 above the
// origin. Points, lines and triangles that have a corner at infinity or nowhere (NaN) are left out. Models are at rest:
// of glTF, default weights of morph targets count, and joints place the meshes that have a skin, as the format says; of
// other formats, meshes are where their nodes are, whatever bones they have.
// Throws std::runtime_error with one line, "FILE: cause", where something is not supported or nothing is left to be
// seen.
scene load_model(const std::filesystem::path& file);

// The same while the shutter is open for a part of an animation, both times in seconds after its start: nodes, bones
// and, of glTF, morph targets move, and corners go straight from their places at the first time to those at the second.
// The bounds are those of both. An empty name means the file's first animation. Throws as above, and where there is no
// animation of that name, where it moves nothing, where times are in the wrong order or outside of it.
moving_scene load_animated_model(const std::filesystem::path& file, std::string_view animation, double open,
                                 double closing);

} // namespace gnomon::renderer
