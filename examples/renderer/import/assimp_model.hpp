// The triangles of OBJ, PLY, STL and whatever else Assimp reads, in the world.
#pragma once

#include "model_part.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace gnomon::renderer {

// Every mesh of every node. At rest, where no exposure is given, meshes are where their nodes are; bones carry them
// while an animation lasts. Throws std::runtime_error with the cause.
std::vector<model_part> read_assimp_parts(const std::filesystem::path& file, const std::optional<exposure>& when);

} // namespace gnomon::renderer
