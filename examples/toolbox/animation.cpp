#include "animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace gnomon::toolbox {

namespace {

aiVector3D between(const aiVector3D& a, const aiVector3D& b, float t) { return a * (1 - t) + b * t; }

aiQuaternion between(const aiQuaternion& a, const aiQuaternion& b, float t)
{
    aiQuaternion result;
    aiQuaternion::Interpolate(result, a, b, t);
    return result.Normalize();
}

// The keys' value at a time in ticks; `otherwise` where there are none.
template <class Key, class Value> Value value_at(std::span<const Key> keys, double ticks, const Value& otherwise)
{
    if (keys.empty()) return otherwise;
    const auto after = std::ranges::upper_bound(keys, ticks, {}, &Key::mTime);
    if (after == keys.begin()) return keys.front().mValue;
    if (after == keys.end()) return keys.back().mValue;
    const Key &a = *(after - 1), &b = *after;
    return between(a.mValue, b.mValue, static_cast<float>((ticks - a.mTime) / (b.mTime - a.mTime)));
}

aiMatrix4x4 transformation_at(const aiNode& node, const aiNodeAnim& channel, double ticks)
{
    aiVector3D scaling, position;
    aiQuaternion rotation;
    node.mTransformation.Decompose(scaling, rotation, position);
    scaling = value_at(std::span<const aiVectorKey>(channel.mScalingKeys, channel.mNumScalingKeys), ticks, scaling);
    rotation = value_at(std::span<const aiQuatKey>(channel.mRotationKeys, channel.mNumRotationKeys), ticks, rotation);
    position = value_at(std::span<const aiVectorKey>(channel.mPositionKeys, channel.mNumPositionKeys), ticks, position);
    return {scaling, rotation, position};
}

using channels = std::unordered_map<std::string, const aiNodeAnim*>;

void place(pose& target, const aiNode& node, const aiMatrix4x4& parent, const channels& moving, double ticks)
{
    const auto channel = moving.find(node.mName.C_Str());
    const aiMatrix4x4 to_world =
        parent * (channel == moving.end() ? node.mTransformation : transformation_at(node, *channel->second, ticks));
    target.of_node.emplace(&node, to_world);
    target.of_name.emplace(node.mName.C_Str(), to_world);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        if (node.mChildren[i]) place(target, *node.mChildren[i], to_world, moving, ticks);
}

} // namespace

pose pose_at_rest(const aiScene& source)
{
    pose result;
    place(result, *source.mRootNode, aiMatrix4x4(), {}, 0);
    return result;
}

const aiAnimation& find_animation(const aiScene& source, std::string_view name)
{
    if (source.mNumAnimations == 0) throw std::runtime_error("no animation in it");
    std::string names;
    for (unsigned i = 0; i < source.mNumAnimations; ++i) {
        const aiAnimation& animation = *source.mAnimations[i];
        if (name.empty() || animation.mName.C_Str() == name) {
            if (animation.mNumChannels > 0) return animation;
            throw std::runtime_error(fmt::format("animation \"{}\" moves no nodes", animation.mName.C_Str()));
        }
        names += fmt::format("{}\"{}\"", i > 0 ? ", " : "", animation.mName.C_Str());
    }
    throw std::runtime_error(fmt::format("no animation \"{}\"; there are {}", name, names));
}

pose pose_at(const aiScene& source, const aiAnimation& animation, double seconds)
{
    // Where a file does not say how long a tick is, it is Assimp's custom to take 1/25 s.
    const double ticks_per_second = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25;
    const double duration = animation.mDuration / ticks_per_second;
    if (!(seconds >= 0 && seconds <= duration))
        throw std::runtime_error(fmt::format("{} s is outside of animation \"{}\", which lasts {} s", seconds,
                                             animation.mName.C_Str(), duration));
    channels moving;
    for (unsigned i = 0; i < animation.mNumChannels; ++i)
        moving.emplace(animation.mChannels[i]->mNodeName.C_Str(), animation.mChannels[i]);
    pose result{.of_node = {}, .of_name = {}, .skinned = true};
    place(result, *source.mRootNode, aiMatrix4x4(), moving, seconds * ticks_per_second);
    return result;
}

std::vector<aiMatrix4x4> vertex_transforms(const aiMesh& part, const aiNode& node, const pose& at)
{
    const aiMatrix4x4& of_node = at.of_node.at(&node);
    if (!at.skinned || part.mNumBones == 0 || part.mNumVertices == 0) return {of_node};
    std::vector<aiMatrix4x4> sums(part.mNumVertices, aiMatrix4x4() * 0.f);
    std::vector<float> weights(part.mNumVertices);
    for (unsigned b = 0; b < part.mNumBones; ++b) {
        const aiBone& bone = *part.mBones[b];
        const auto found = at.of_name.find(bone.mName.C_Str());
        if (found == at.of_name.end()) continue;
        const aiMatrix4x4 moved = found->second * bone.mOffsetMatrix;
        for (unsigned i = 0; i < bone.mNumWeights; ++i) {
            const aiVertexWeight& weight = bone.mWeights[i];
            if (weight.mVertexId >= part.mNumVertices) continue;
            sums[weight.mVertexId] = sums[weight.mVertexId] + moved * weight.mWeight;
            weights[weight.mVertexId] += weight.mWeight;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = weights[i] > 0 ? sums[i] * (1 / weights[i]) : of_node;
    return sums;
}

} // namespace gnomon::toolbox
