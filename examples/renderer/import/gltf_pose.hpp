// Places of the nodes of a glTF file and weights of its morph targets, static or at a time of an animation.
#pragma once

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <string_view>
#include <vector>

namespace gnomon::renderer {

// Placement and weights of every node of the file.
struct gltf_pose {
    std::vector<glm::dmat4> to_world;
    std::vector<std::vector<double>> weights; // one for each morph target of the node's mesh
};

// The number of morph targets of the primitives of a mesh. Throws if their numbers differ.
std::size_t gltf_target_count(const tinygltf::Mesh& mesh);

// The static pose: nodes as in the file, with the default weights of the node, or else of its mesh. Throws
// std::runtime_error if a node is malformed.
gltf_pose gltf_pose_at_rest(const tinygltf::Model& model);

// The time of the last key, in seconds. Throws std::runtime_error if the animation moves nothing, or if a channel or a
// key is malformed or of an unsupported kind.
double gltf_duration(const tinygltf::Model& model, const tinygltf::Animation& animation);

// The pose at a time in seconds. Values are constant before the first key and after the last one. Throws as
// gltf_duration.
gltf_pose gltf_pose_at(const tinygltf::Model& model, const tinygltf::Animation& animation, double seconds);

} // namespace gnomon::renderer
