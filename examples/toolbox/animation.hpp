// Where the parts of a file's scene are at a time of one of its animations. Only for the reader of models: Assimp's
// types stay behind it.
#pragma once

#include <assimp/scene.h>

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace gnomon::toolbox {

// From each node's coordinates to the world's.
struct pose {
    std::unordered_map<const aiNode*, aiMatrix4x4> of_node;
    std::unordered_map<std::string, aiMatrix4x4> of_name; // of the first node of that name, for bones
    bool skinned = false;                                 // whether bones move the meshes that have any
};

// As the file's nodes stand; meshes are where their nodes are, whatever bones they have.
pose pose_at_rest(const aiScene& source);

// The animation of this name, or the first where the name is empty. Throws std::runtime_error, which lists the names
// that there are.
const aiAnimation& find_animation(const aiScene& source, std::string_view name);

// At a time in seconds after the animation's start. Keys are interpolated linearly, rotations along the great arc;
// before the first key and after the last one they stay. Throws std::runtime_error where the time lies outside of the
// animation.
pose pose_at(const aiScene& source, const aiAnimation& animation, double seconds);

// From the coordinates of each of the mesh's vertices to the world's: one matrix for all, that of the node, or one for
// each where bones move it.
std::vector<aiMatrix4x4> vertex_transforms(const aiMesh& part, const aiNode& node, const pose& at);

} // namespace gnomon::toolbox
