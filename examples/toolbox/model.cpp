#include "model.hpp"

#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "import_guard.hpp"

namespace gnomon::toolbox {

namespace {

glm::vec3 vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string one_line(std::string text)
{
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

glm::vec3 albedo_of(const aiScene& source, unsigned material)
{
    aiColor3D colour(0.7f);
    if (material < source.mNumMaterials) source.mMaterials[material]->Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    const glm::vec3 albedo(colour.r, colour.g, colour.b);
    return finite(albedo) ? glm::clamp(albedo, 0.f, 1.f) : glm::vec3(0.7f);
}

bool drawable(const aiFace& face, const mesh& part)
{
    return face.mNumIndices == 3 && std::all_of(face.mIndices, face.mIndices + 3, [&](unsigned index) {
               return index < part.positions.size() && finite(part.positions[index]);
           });
}

mesh convert(const aiScene& source, const aiMesh& from, const aiMatrix4x4& to_world)
{
    mesh part{.name = from.mName.C_Str(),
              .albedo = albedo_of(source, from.mMaterialIndex),
              .positions = {},
              .normals = {},
              .triangles = {}};
    const bool mirrored = aiMatrix3x3(to_world).Determinant() < 0;
    const aiMatrix3x3 normal_to_world = aiMatrix3x3(to_world).Inverse().Transpose();
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        part.positions.push_back(vector(to_world * from.mVertices[i]));
        if (from.HasNormals()) part.normals.push_back(vector(normal_to_world * from.mNormals[i]));
    }
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (!drawable(face, part)) continue;
        const glm::uvec3 corners(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
        part.triangles.push_back(mirrored ? glm::uvec3(corners.x, corners.z, corners.y) : corners);
    }
    // Corners that no triangle uses must not count in the bounds.
    std::vector<bool> used(part.positions.size());
    for (const glm::uvec3& t : part.triangles) used[t.x] = used[t.y] = used[t.z] = true;
    if (!part.triangles.empty())
        for (std::size_t i = 0; i < used.size(); ++i)
            if (!used[i]) part.positions[i] = part.positions[part.triangles[0].x];
    for (glm::vec3& normal : part.normals) {
        const float length = glm::length(normal);
        normal = length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0);
    }
    return part;
}

void append_node(scene& target, const aiScene& source, const aiNode& node, const aiMatrix4x4& parent)
{
    const aiMatrix4x4 to_world = parent * node.mTransformation;
    // Some of Assimp's readers leave references to nothing.
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= source.mNumMeshes) continue;
        mesh part = convert(source, *source.mMeshes[node.mMeshes[i]], to_world);
        if (!part.triangles.empty()) target.meshes.push_back(std::move(part));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) append_node(target, source, *node.mChildren[i], to_world);
}

// In double, because a box that float can hold may be wider than float's range.
void normalise(scene& model)
{
    const bounds box = bounds_of(model);
    const glm::dvec3 lower(box.lower), upper(box.upper), extent = upper - lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0)) throw std::runtime_error("all triangles lie in one point");
    const glm::dvec3 origin(0.5 * (lower.x + upper.x), lower.y, 0.5 * (lower.z + upper.z));
    for (mesh& part : model.meshes)
        for (glm::vec3& position : part.positions) position = glm::vec3((glm::dvec3(position) - origin) / longest);
}

scene import(const std::filesystem::path& file)
{
    const import_guard guard(file);
    Assimp::Importer importer;
    const aiScene* source = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (!source || !source->mRootNode)
        throw std::runtime_error(importer.GetErrorString() == std::string("std::bad_alloc")
                                     ? "needs too much memory"
                                     : importer.GetErrorString());
    scene model{file.stem().string(), {}};
    append_node(model, *source, *source->mRootNode, aiMatrix4x4());
    if (model.meshes.empty()) throw std::runtime_error("no triangles in it");
    normalise(model);
    return model;
}

} // namespace

scene load_model(const std::filesystem::path& file)
try {
    if (!std::filesystem::exists(file)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("not a file");
    return import(file);
} catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), one_line(error.what())));
}

} // namespace gnomon::toolbox
