// The triangles of an OBJ, PLY or STL file, or of any other format that Assimp reads, in the world.
#pragma once

#include "model_part.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace gnomon::renderer {

// Every mesh of every node. Without an exposure, meshes are where their nodes are; in an animation, bones move them.
// Throws std::runtime_error with the cause.
std::vector<model_part> read_assimp_parts(const std::filesystem::path& file, const std::optional<exposure>& when);

} // namespace gnomon::renderer
