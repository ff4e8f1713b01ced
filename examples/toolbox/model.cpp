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

#include "animation.hpp"
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

// The places where a mesh is when the shutter opens and closes, and the normals that it has before; a mesh that bones
// move has none.
struct moving_mesh {
    mesh open;
    std::vector<glm::vec3> closing;
};

struct poses {
    pose open, closing;
};

bool drawable(const aiFace& face, const moving_mesh& part)
{
    return face.mNumIndices == 3 && std::all_of(face.mIndices, face.mIndices + 3, [&](unsigned index) {
               return index < part.closing.size() && finite(part.open.positions[index]) && finite(part.closing[index]);
           });
}

moving_mesh convert(const aiScene& source, const aiMesh& from, const aiNode& node, const poses& at)
{
    moving_mesh part;
    part.open.name = from.mName.C_Str();
    part.open.albedo = albedo_of(source, from.mMaterialIndex);
    const std::vector<aiMatrix4x4> opening = vertex_transforms(from, node, at.open);
    const std::vector<aiMatrix4x4> closing = vertex_transforms(from, node, at.closing);
    const bool skinned = opening.size() > 1;
    const bool mirrored = aiMatrix3x3(opening[0]).Determinant() < 0;
    const aiMatrix3x3 normal_to_world = aiMatrix3x3(opening[0]).Inverse().Transpose();
    for (unsigned i = 0; i < from.mNumVertices; ++i) {
        part.open.positions.push_back(vector(opening[skinned ? i : 0] * from.mVertices[i]));
        part.closing.push_back(vector(closing[skinned ? i : 0] * from.mVertices[i]));
        if (from.HasNormals() && !skinned) part.open.normals.push_back(vector(normal_to_world * from.mNormals[i]));
    }
    std::vector<glm::uvec3>& triangles = part.open.triangles;
    for (unsigned i = 0; i < from.mNumFaces; ++i) {
        const aiFace& face = from.mFaces[i];
        if (!drawable(face, part)) continue;
        const glm::uvec3 corners(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
        triangles.push_back(mirrored ? glm::uvec3(corners.x, corners.z, corners.y) : corners);
    }
    // Corners that no triangle uses must not count in the bounds.
    std::vector<bool> used(part.closing.size());
    for (const glm::uvec3& t : triangles) used[t.x] = used[t.y] = used[t.z] = true;
    if (!triangles.empty())
        for (std::size_t i = 0; i < used.size(); ++i)
            if (!used[i]) {
                part.open.positions[i] = part.open.positions[triangles[0].x];
                part.closing[i] = part.closing[triangles[0].x];
            }
    for (glm::vec3& normal : part.open.normals) {
        const float length = glm::length(normal);
        normal = length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0);
    }
    return part;
}

void append_node(moving_scene& target, const aiScene& source, const aiNode& node, const poses& at)
{
    // Some of Assimp's readers leave references to nothing.
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= source.mNumMeshes) continue;
        moving_mesh part = convert(source, *source.mMeshes[node.mMeshes[i]], node, at);
        if (part.open.triangles.empty()) continue;
        target.open.meshes.push_back(std::move(part.open));
        target.closing.push_back(std::move(part.closing));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) append_node(target, source, *node.mChildren[i], at);
}

// In double, because a box that float can hold may be wider than float's range.
void normalise(moving_scene& model)
{
    const bounds box = bounds_of(model);
    const glm::dvec3 lower(box.lower), upper(box.upper), extent = upper - lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0)) throw std::runtime_error("all triangles lie in one point");
    const glm::dvec3 origin(0.5 * (lower.x + upper.x), lower.y, 0.5 * (lower.z + upper.z));
    const auto fit = [&](std::vector<glm::vec3>& positions) {
        for (glm::vec3& position : positions) position = glm::vec3((glm::dvec3(position) - origin) / longest);
    };
    for (mesh& part : model.open.meshes) fit(part.positions);
    for (std::vector<glm::vec3>& positions : model.closing) fit(positions);
}

// Reads a file in the poses that `choose` finds for its scene.
template <class Choose> moving_scene import(const std::filesystem::path& file, const Choose& choose)
{
    const import_guard guard(file);
    Assimp::Importer importer;
    const aiScene* source = importer.ReadFile(file.string(), aiProcess_Triangulate);
    if (!source || !source->mRootNode)
        throw std::runtime_error(importer.GetErrorString() == std::string("std::bad_alloc")
                                     ? "needs too much memory"
                                     : importer.GetErrorString());
    moving_scene model{{file.stem().string(), {}}, {}};
    append_node(model, *source, *source->mRootNode, choose(*source));
    if (model.open.meshes.empty()) throw std::runtime_error("no triangles in it");
    normalise(model);
    return model;
}

template <class Choose> moving_scene load(const std::filesystem::path& file, const Choose& choose)
try {
    if (!std::filesystem::exists(file)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("not a file");
    return import(file, choose);
} catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), one_line(error.what())));
}

} // namespace

scene load_model(const std::filesystem::path& file)
{
    return load(file,
                [](const aiScene& source) {
                    const pose rest = pose_at_rest(source);
                    return poses{rest, rest};
                })
        .open;
}

moving_scene load_animated_model(const std::filesystem::path& file, std::string_view animation, double open,
                                 double closing)
{
    return load(file, [&](const aiScene& source) {
        const aiAnimation& found = find_animation(source, animation);
        if (!(open <= closing))
            throw std::runtime_error(fmt::format("the shutter opens at {} s and closes at {} s", open, closing));
        return poses{pose_at(source, found, open), pose_at(source, found, closing)};
    });
}

} // namespace gnomon::toolbox
