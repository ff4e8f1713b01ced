// The triangles of a glTF file in the world.
#pragma once

#include "model_part.hpp"

#include <filesystem>
#include <optional>
#include <vector>

namespace gnomon::renderer {

// Every primitive that has triangles, in the order of the scene's nodes, each followed by its children. Joints place
// the meshes that have a skin, whether an animation moves them or not, and the nodes of such meshes do not; morph
// targets count by their weights. Where no exposure is given, the file is at rest. Throws std::runtime_error with the
// cause.
std::vector<model_part> read_gltf_parts(const std::filesystem::path& file, const std::optional<exposure>& when);

} // namespace gnomon::renderer
