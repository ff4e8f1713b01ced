// Broad-leaved trees, built by code.
#pragma once

#include "scene.hpp"

#include <glm/vec3.hpp>

#include <cstdint>

namespace gnomon::renderer {

// Appends a tree of this height: trunk, branches and twigs to the wood, which must have a normal for each position, and
// quads to the leaves. A seed always makes the same tree.
void add_tree(mesh& wood, mesh& leaves, const glm::vec3& foot, float height, std::uint32_t seed);

} // namespace gnomon::renderer
