// The triangles of a glTF file in the world.
#pragma once

#include "model_part.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace gnomon::renderer {

// Every primitive that has triangles, in the order of the scene's nodes, each followed by its children. Meshes with a
// skin are placed by their joints, animated or not, and not by their nodes; morph targets are applied by their weights.
// Without an exposure the model is static. Throws std::runtime_error with the cause.
std::vector<model_part> read_gltf_parts(const std::filesystem::path& file, const std::optional<exposure>& when);

} // namespace gnomon::renderer
