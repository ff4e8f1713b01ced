// Places of the nodes of a file that Assimp has read, static or at a time of one of its animations. For the importer
// alone: no other file sees Assimp's types.
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

// The static pose: nodes as in the file. Meshes are where their nodes are; bones are ignored.
assimp_pose assimp_pose_at_rest(const aiScene& source);

double assimp_duration(const aiAnimation& animation); // in seconds

// The pose at a time in seconds after the start of the animation. Keys are interpolated linearly, rotations along the
// shorter great arc, since Assimp names no other interpolation; they are constant before the first key and after the
// last one. Throws std::runtime_error if the animation moves no nodes or moves meshes by other means, if a channel has
// the name of several nodes, or if a channel leaves out a rotation or scale that cannot be recovered from the matrix of
// its node.
assimp_pose assimp_pose_at(const aiScene& source, const aiAnimation& animation, double seconds);

// Matrices from the coordinates of the mesh to those of the world: one for all vertices, that of the node, or one for
// each vertex if bones move the mesh. Weights of bones are divided by their sum. Throws std::runtime_error if the name
// of a bone is not that of exactly one node.
std::vector<glm::dmat4> vertex_transforms(const aiMesh& part, const aiNode& node, const assimp_pose& at);

} // namespace gnomon::renderer
