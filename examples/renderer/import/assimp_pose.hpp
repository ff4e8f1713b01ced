// Places of the nodes of a file that Assimp has read, at rest and at a time of one of its animations. Only for the
// reader of models: Assimp's types stay behind it.
#pragma once

#include <assimp/scene.h>
#include <glm/mat4x4.hpp>

#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon::renderer {

struct assimp_pose {
    std::unordered_map<const aiNode*, glm::dmat4> to_world;
    std::unordered_multimap<std::string, const aiNode*> named; // where skinned
    bool skinned = false;                                      // whether bones carry the meshes that have any
};

glm::dmat4 matrix_of(const aiMatrix4x4& m);

// As the file has the nodes; meshes are where their nodes are, whatever bones they have.
assimp_pose assimp_pose_at_rest(const aiScene& source);

double assimp_duration(const aiAnimation& animation); // in seconds

// At a time in seconds after the animation's start. Keys are interpolated linearly, rotations along the shorter great
// arc, since Assimp tells of no other way; before the first key and after the last one they stay. Throws
// std::runtime_error where the animation moves no nodes or moves meshes by other means, where a channel's name is that
// of several nodes, and where it leaves out a rotation or scale that its node's matrix does not tell.
assimp_pose assimp_pose_at(const aiScene& source, const aiAnimation& animation, double seconds);

// From the coordinates of each of the mesh's vertices to the world's: one matrix for all, that of the node, or one for
// each where bones move it; weights are divided by their sum. Throws std::runtime_error where a bone's name is not that
// of one node.
std::vector<glm::dmat4> vertex_transforms(const aiMesh& part, const aiNode& node, const assimp_pose& at);

} // namespace gnomon::renderer
