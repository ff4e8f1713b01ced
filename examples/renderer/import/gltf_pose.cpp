#include "gltf_pose.hpp"

#include "gltf_file.hpp"
#include "transform.hpp"

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::renderer {

namespace {

// Numbers of a node as the file has them or, where it has none, as they are by default.
void take(std::vector<double>& target, const std::vector<double>& given, const char* what)
{
    if (given.empty()) return;
    if (given.size() != target.size())
        throw std::runtime_error(fmt::format("a {} of {} numbers instead of {}", what, given.size(), target.size()));
    target = given;
}

// The properties of a node that animations change, in the file's own order of components.
struct node_state {
    std::vector<double> translation{0, 0, 0}, rotation{0, 0, 0, 1}, scale{1, 1, 1}, weights;
};

std::vector<node_state> states_at_rest(const tinygltf::Model& model)
{
    std::vector<node_state> states(model.nodes.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        const tinygltf::Node& node = model.nodes[i];
        take(states[i].translation, node.translation, "translation");
        take(states[i].rotation, node.rotation, "rotation");
        take(states[i].scale, node.scale, "scale");
        if (node.mesh < 0) continue;
        const tinygltf::Mesh& mesh = gltf_item(model.meshes, node.mesh, "mesh");
        states[i].weights.resize(gltf_target_count(mesh));
        take(states[i].weights, mesh.weights, "list of weights");
        take(states[i].weights, node.weights, "list of weights");
    }
    return states;
}

glm::dvec3 vector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

glm::dquat quaternion(const double* v) { return unit(glm::dquat(v[3], v[0], v[1], v[2])); }

glm::dmat4 to_parent(const tinygltf::Node& node, const node_state& state)
{
    if (node.matrix.empty())
        return composed(vector(state.translation), quaternion(state.rotation.data()), vector(state.scale));
    if (node.matrix.size() != 16)
        throw std::runtime_error(fmt::format("a matrix of {} numbers instead of 16", node.matrix.size()));
    return affine(node.matrix.data());
}

gltf_pose pose_of(const tinygltf::Model& model, std::vector<node_state> states)
{
    gltf_pose pose{std::vector<glm::dmat4>(states.size()), {}};
    for (const gltf_link& link : gltf_hierarchy(model)) {
        const auto node = static_cast<std::size_t>(link.node);
        pose.to_world[node] = to_parent(model.nodes[node], states[node]);
        if (link.parent >= 0)
            pose.to_world[node] = pose.to_world[static_cast<std::size_t>(link.parent)] * pose.to_world[node];
    }
    for (node_state& state : states) pose.weights.push_back(std::move(state.weights));
    return pose;
}

// A sampler's keys: at each time as many numbers as `width`, or thrice as many where tangents go with them.
struct key_frames {
    enum { step, linear, cubic } mode;
    std::vector<double> times, numbers;
    std::size_t width;

    const double* value(std::size_t key) const { return &numbers[(mode == cubic ? 3 * key + 1 : key) * width]; }
    const double* tangent_in(std::size_t key) const { return value(key) - width; }
    const double* tangent_out(std::size_t key) const { return value(key) + width; }
};

key_frames keys_of(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, int type, std::size_t width)
{
    key_frames keys{key_frames::linear, gltf_numbers(model, sampler.input, TINYGLTF_TYPE_SCALAR),
                    gltf_numbers(model, sampler.output, type), width};
    if (sampler.interpolation == "STEP") keys.mode = key_frames::step;
    else if (sampler.interpolation == "CUBICSPLINE") keys.mode = key_frames::cubic;
    else if (sampler.interpolation != "LINEAR")
        throw std::runtime_error(fmt::format("interpolation {} is not supported", sampler.interpolation));
    if (keys.times.empty() ||
        keys.numbers.size() != keys.times.size() * width * (keys.mode == key_frames::cubic ? 3 : 1))
        throw std::runtime_error("an animation has not as many values as times");
    const bool rising = std::ranges::is_sorted(keys.times) && std::isfinite(keys.times.front()) &&
                        std::ranges::none_of(keys.times, [](double time) { return std::isnan(time); });
    if (!rising || !std::isfinite(keys.times.back())) throw std::runtime_error("times of an animation do not rise");
    return keys;
}

std::vector<double> value_at(const key_frames& keys, double seconds, bool is_rotation)
{
    const auto later = std::ranges::upper_bound(keys.times, seconds);
    const auto after = static_cast<std::size_t>(later - keys.times.begin());
    const std::size_t before = after - (after > 0);
    std::vector<double> result(keys.value(before), keys.value(before) + keys.width);
    if (after == 0 || after == keys.times.size() || keys.mode == key_frames::step) return result;
    const double length = keys.times[after] - keys.times[before], t = (seconds - keys.times[before]) / length;
    const double *a = keys.value(before), *b = keys.value(after);
    if (keys.mode == key_frames::cubic) {
        const double s = 1 - t, *leaving = keys.tangent_out(before), *arriving = keys.tangent_in(after);
        for (std::size_t i = 0; i < keys.width; ++i)
            result[i] = (1 + 2 * t) * s * s * a[i] + length * t * s * s * leaving[i] + t * t * (3 - 2 * t) * b[i] -
                        length * t * t * s * arriving[i];
    } else if (is_rotation) {
        const glm::dquat q = glm::slerp(quaternion(a), quaternion(b), t); // the shorter way
        result = {q.x, q.y, q.z, q.w};
    } else {
        for (std::size_t i = 0; i < keys.width; ++i) result[i] = (1 - t) * a[i] + t * b[i];
    }
    return result;
}

// Calls `visit` with the part of a node's state that each channel moves, and the channel's keys.
template <class Visit>
void for_each_channel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                      std::vector<node_state>& states, const Visit& visit)
{
    std::set<std::pair<int, std::string>> moved;
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
        const tinygltf::Node& node = gltf_item(model.nodes, channel.target_node, "node");
        node_state& state = states[static_cast<std::size_t>(channel.target_node)];
        const std::string& path = channel.target_path;
        std::vector<double>* part = path == "translation" ? &state.translation
                                    : path == "rotation"  ? &state.rotation
                                    : path == "scale"     ? &state.scale
                                    : path == "weights"   ? &state.weights
                                                          : nullptr;
        const auto refuse = [&](const char* cause) {
            throw std::runtime_error(fmt::format("animation \"{}\" moves the {} of node {}, {}", animation.name, path,
                                                 channel.target_node, cause));
        };
        if (!part) refuse("which is not supported");
        if (!moved.emplace(channel.target_node, path).second) refuse("and does so twice");
        if (path == "weights" && part->empty()) refuse("whose mesh has no morph targets");
        if (path != "weights" && !node.matrix.empty()) refuse("which has a matrix");
        const int type = path == "weights"    ? TINYGLTF_TYPE_SCALAR
                         : path == "rotation" ? TINYGLTF_TYPE_VEC4
                                              : TINYGLTF_TYPE_VEC3;
        visit(*part, keys_of(model, gltf_item(animation.samplers, channel.sampler, "sampler"), type, part->size()),
              path == "rotation");
    }
    if (moved.empty()) throw std::runtime_error(fmt::format("animation \"{}\" moves nothing", animation.name));
}

} // namespace

std::size_t gltf_target_count(const tinygltf::Mesh& mesh)
{
    for (const tinygltf::Primitive& part : mesh.primitives)
        if (part.targets.size() != mesh.primitives[0].targets.size())
            throw std::runtime_error(fmt::format("primitives of mesh \"{}\" have unlike morph targets", mesh.name));
    return mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
}

gltf_pose gltf_pose_at_rest(const tinygltf::Model& model) { return pose_of(model, states_at_rest(model)); }

double gltf_duration(const tinygltf::Model& model, const tinygltf::Animation& animation)
{
    std::vector<node_state> states = states_at_rest(model);
    double duration = 0;
    for_each_channel(model, animation, states, [&](std::vector<double>&, const key_frames& keys, bool) {
        duration = std::max(duration, keys.times.back());
    });
    return duration;
}

gltf_pose gltf_pose_at(const tinygltf::Model& model, const tinygltf::Animation& animation, double seconds)
{
    std::vector<node_state> states = states_at_rest(model);
    for_each_channel(model, animation, states,
                     [&](std::vector<double>& part, const key_frames& keys, bool is_rotation) {
                         part = value_at(keys, seconds, is_rotation);
                     });
    return pose_of(model, std::move(states));
}

} // namespace gnomon::renderer
