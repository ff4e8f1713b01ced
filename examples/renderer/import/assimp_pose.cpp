#include "assimp_pose.hpp"

#include "transform.hpp"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>

namespace gnomon::renderer {

namespace {

glm::dvec3 number(const aiVector3D& v) { return {v.x, v.y, v.z}; }
glm::dquat number(const aiQuaternion& q) { return unit(glm::dquat(glm::quat(q.w, q.x, q.y, q.z))); }

glm::dvec3 between(const glm::dvec3& a, const glm::dvec3& b, double t) { return (1 - t) * a + t * b; }
glm::dquat between(const glm::dquat& a, const glm::dquat& b, double t) { return glm::slerp(a, b, t); }

// The value of at least one key at a time in ticks.
template <class Key> auto value_at(std::span<const Key> keys, double ticks)
{
    const auto after = std::ranges::upper_bound(keys, ticks, {}, &Key::mTime);
    if (after == keys.begin()) return number(keys.front().mValue);
    if (after == keys.end()) return number(keys.back().mValue);
    const Key &a = *(after - 1), &b = *after;
    return between(number(a.mValue), number(b.mValue), (ticks - a.mTime) / (b.mTime - a.mTime));
}

[[noreturn]] void refuse_leaving_out(const char* what, const aiNode& node)
{
    throw std::runtime_error(fmt::format(
        "an animation leaves out the {} of node \"{}\", which its matrix does not tell", what, node.mName.C_Str()));
}

// True if axes of length one are not perpendicular, by more than the rounding of files with four digits.
bool is_sheared(const glm::dmat3& axes)
{
    return !(std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                       std::abs(glm::dot(axes[2], axes[0]))}) < 1e-3);
}

glm::dmat3 axes_of(const glm::dmat3& m)
{
    return {m[0] / glm::length(m[0]), m[1] / glm::length(m[1]), m[2] / glm::length(m[2])};
}

// The rotation whose product with a scale of these signs is the matrix.
glm::dquat rotation_in(const glm::dmat3& m, const glm::dvec3& signs, const aiNode& node)
{
    glm::dmat3 axes = axes_of(m);
    for (int i = 0; i < 3; ++i) axes[i] *= std::copysign(1.0, signs[i]);
    if (!(glm::determinant(axes) > 0) || is_sheared(axes)) refuse_leaving_out("rotation", node);
    return glm::quat_cast(axes);
}

// The scale whose product with a rotation is the matrix. No axis is negative where the matrix mirrors nothing; which
// one is negative elsewhere shows after the rotation of the first key, if that is the node's.
glm::dvec3 scale_in(const glm::dmat3& m, const glm::dquat& first_rotation, const aiNode& node)
{
    const glm::dvec3 lengths(glm::length(m[0]), glm::length(m[1]), glm::length(m[2]));
    if (glm::determinant(m) > 0 && !is_sheared(axes_of(m))) return lengths;
    const glm::dmat3 left = glm::transpose(glm::mat3_cast(first_rotation)) * m;
    const glm::dvec3 scale(left[0][0], left[1][1], left[2][2]);
    if (!glm::all(glm::lessThan(lengths - glm::abs(scale), 1e-4 * lengths))) refuse_leaving_out("scale", node);
    return scale;
}

// The keys, but for a single one that Assimp has filled in from its own decomposition of the node's matrix.
template <class Key, class Value> std::span<const Key> given(std::span<const Key> keys, const Value& filled_in)
{
    const bool is_filled_in = keys.size() == 1 && keys[0].mTime == 0 && keys[0].mValue == filled_in;
    return is_filled_in ? std::span<const Key>() : keys;
}

// Values that a channel leaves out are those of the node.
glm::dmat4 transformation_at(const aiNode& node, const aiNodeAnim& channel, double ticks)
{
    aiVector3D scale, position;
    aiQuaternion rotation;
    node.mTransformation.Decompose(scale, rotation, position);
    const std::span<const aiVectorKey> positions(channel.mPositionKeys, channel.mNumPositionKeys);
    const auto rotations = given(std::span<const aiQuatKey>(channel.mRotationKeys, channel.mNumRotationKeys), rotation);
    const auto scales = given(std::span<const aiVectorKey>(channel.mScalingKeys, channel.mNumScalingKeys), scale);
    glm::dmat4 rest = matrix_of(node.mTransformation);
    if (!positions.empty()) rest[3] = glm::dvec4(value_at(positions, ticks), 1);
    if (rotations.empty() && scales.empty()) return rest;
    const glm::dmat3 m(rest);
    return composed(glm::dvec3(rest[3]),
                    rotations.empty() ? rotation_in(m, number(scales[0].mValue), node) : value_at(rotations, ticks),
                    scales.empty() ? scale_in(m, number(rotations[0].mValue), node) : value_at(scales, ticks));
}

void collect_names(std::unordered_multimap<std::string, const aiNode*>& target, const aiNode& node)
{
    target.emplace(node.mName.C_Str(), &node);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) collect_names(target, *node.mChildren[i]);
}

// The node of this name, if any. Throws where there are several.
const aiNode* node_named(const assimp_pose& at, const aiString& name)
{
    const auto [first, last] = at.named.equal_range(name.C_Str());
    if (first == last) return nullptr;
    if (std::next(first) != last)
        throw std::runtime_error(
            fmt::format("several nodes have the name \"{}\" of a bone or a channel", name.C_Str()));
    return first->second;
}

using channels = std::unordered_map<const aiNode*, const aiNodeAnim*>;

void place(assimp_pose& target, const aiNode& node, const glm::dmat4& parent, const channels& moving, double ticks)
{
    const auto channel = moving.find(&node);
    const glm::dmat4 to_world = parent * (channel == moving.end() ? matrix_of(node.mTransformation)
                                                                  : transformation_at(node, *channel->second, ticks));
    target.to_world.emplace(&node, to_world);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) place(target, *node.mChildren[i], to_world, moving, ticks);
}

// Ticks a second; 25, by Assimp's custom, where a file does not say.
double ticks_per_second(const aiAnimation& animation)
{
    return animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25;
}

} // namespace

glm::dmat4 matrix_of(const aiMatrix4x4& m)
{
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

assimp_pose assimp_pose_at_rest(const aiScene& source)
{
    assimp_pose result;
    place(result, *source.mRootNode, glm::dmat4(1), {}, 0);
    return result;
}

double assimp_duration(const aiAnimation& animation) { return animation.mDuration / ticks_per_second(animation); }

assimp_pose assimp_pose_at(const aiScene& source, const aiAnimation& animation, double seconds)
{
    const char* name = animation.mName.C_Str();
    if (animation.mNumMorphMeshChannels > 0 || animation.mNumMeshChannels > 0)
        throw std::runtime_error(fmt::format("animation \"{}\" morphs meshes, which is read from glTF only", name));
    if (animation.mNumChannels == 0) throw std::runtime_error(fmt::format("animation \"{}\" moves no nodes", name));
    assimp_pose result{.to_world = {}, .named = {}, .skinned = true};
    collect_names(result.named, *source.mRootNode);
    channels moving;
    for (unsigned i = 0; i < animation.mNumChannels; ++i)
        if (const aiNode* node = node_named(result, animation.mChannels[i]->mNodeName))
            moving.emplace(node, animation.mChannels[i]);
    place(result, *source.mRootNode, glm::dmat4(1), moving, seconds * ticks_per_second(animation));
    return result;
}

std::vector<glm::dmat4> vertex_transforms(const aiMesh& part, const aiNode& node, const assimp_pose& at)
{
    const glm::dmat4& of_node = at.to_world.at(&node);
    if (!at.skinned || part.mNumBones == 0 || part.mNumVertices == 0) return {of_node};
    std::vector<glm::dmat4> sums(part.mNumVertices, glm::dmat4(0));
    std::vector<double> weights(part.mNumVertices);
    for (unsigned b = 0; b < part.mNumBones; ++b) {
        const aiBone& bone = *part.mBones[b];
        const aiNode* carrier = node_named(at, bone.mName);
        if (!carrier) throw std::runtime_error(fmt::format("no node is named as bone \"{}\"", bone.mName.C_Str()));
        const glm::dmat4 moved = at.to_world.at(carrier) * matrix_of(bone.mOffsetMatrix);
        for (unsigned i = 0; i < bone.mNumWeights; ++i) {
            const aiVertexWeight& weight = bone.mWeights[i];
            if (weight.mVertexId >= part.mNumVertices) continue;
            sums[weight.mVertexId] += moved * static_cast<double>(weight.mWeight);
            weights[weight.mVertexId] += static_cast<double>(weight.mWeight);
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = weights[i] > 0 ? sums[i] * (1 / weights[i]) : of_node;
    return sums;
}

} // namespace gnomon::renderer
