#include "assimp_model.hpp"

#include "assimp_pose.hpp"
#include "transform.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::renderer {

namespace {

glm::dvec3 vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

glm::vec3 albedo_of(const aiScene& source, unsigned material)
{
    aiColor3D colour(0.7f);
    if (material < source.mNumMaterials) source.mMaterials[material]->Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    if (!std::isfinite(colour.r) || !std::isfinite(colour.g) || !std::isfinite(colour.b)) return glm::vec3(0.7f);
    return glm::clamp(glm::vec3(colour.r, colour.g, colour.b), 0.f, 1.f);
}

struct poses {
    assimp_pose open, closing;
};

model_part convert(const aiScene& source, const aiMesh& from, const aiNode& node, const poses& at)
{
    model_part part;
    part.name = from.mName.C_Str();
    part.albedo = albedo_of(source, from.mMaterialIndex);
    const std::vector<glm::dmat4> opening = vertex_transforms(from, node, at.open);
    const std::vector<glm::dmat4> closing = vertex_transforms(from, node, at.closing);
    const auto matrix = [](const std::vector<glm::dmat4>& all, std::size_t i) { return all[all.size() > 1 ? i : 0]; };
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        const glm::dvec4 corner(vector(from.mVertices[i]), 1);
        part.open.emplace_back(matrix(opening, i) * corner);
        part.closing.emplace_back(matrix(closing, i) * corner);
        if (from.HasNormals()) part.normals.emplace_back(for_normals(matrix(opening, i)) * vector(from.mNormals[i]));
    }
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (face.mNumIndices != 3) continue;
        glm::uvec3 corners(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
        if (std::max({corners.x, corners.y, corners.z}) >= from.mNumVertices) continue;
        if (glm::determinant(glm::dmat3(matrix(opening, corners.x))) < 0) std::swap(corners.y, corners.z);
        part.triangles.push_back(corners);
    }
    return part;
}

void append_node(std::vector<model_part>& target, const aiScene& source, const aiNode& node, const poses& at)
{
    // Some of Assimp's readers leave references to nothing.
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        if (node.mMeshes[i] < source.mNumMeshes)
            target.push_back(convert(source, *source.mMeshes[node.mMeshes[i]], node, at));
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) append_node(target, source, *node.mChildren[i], at);
}

poses poses_of(const aiScene& source, const std::optional<exposure>& when)
{
    if (!when) {
        const assimp_pose rest = assimp_pose_at_rest(source);
        return {rest, rest};
    }
    std::vector<std::string> names;
    for (unsigned i = 0; i < source.mNumAnimations; ++i) names.emplace_back(source.mAnimations[i]->mName.C_Str());
    const std::size_t index = find_animation(names, when->animation);
    const aiAnimation& animation = *source.mAnimations[index];
    check_exposure(*when, names[index], assimp_duration(animation));
    return {assimp_pose_at(source, animation, when->open), assimp_pose_at(source, animation, when->closing)};
}

} // namespace

std::vector<model_part> read_assimp_parts(const std::filesystem::path& file, const std::optional<exposure>& when)
{
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true); // bones alone are no model
    const aiScene* source = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (!source || !source->mRootNode) throw std::runtime_error(importer.GetErrorString());
    std::vector<model_part> parts;
    append_node(parts, *source, *source->mRootNode, poses_of(*source, when));
    return parts;
}

} // namespace gnomon::renderer
