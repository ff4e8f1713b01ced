// Broad-leaved trees, built by code.
#pragma once

#include "scene.hpp"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::renderer {

// A generation of branches. Lengths and radii are fractions of those of the branch that carries them.
struct generation {
    int count, sides, segments;
    float length, radius, spread,
        first; // spread: tangent of the angle to the parent; first: where on the parent they begin
};

// The generations on the trunk, of which the last has leaves, and the number of leaves on each of its branches.
struct tree_form {
    std::vector<generation> branches;
    int leaves;
};

// Branches and twigs.
tree_form broad_leaved();

// Appends a tree of this height: trunk, branches and twigs to the wood, which must have a normal for each position, and
// quads to the leaves. A seed always makes the same tree.
void add_tree(mesh& wood, mesh& leaves, const glm::vec3& foot, float height, std::uint32_t seed,
              const tree_form& form = broad_leaved());

} // namespace gnomon::renderer
