#include "gltf_model.hpp"

#include "gltf_file.hpp"
#include "gltf_pose.hpp"
#include "transform.hpp"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace gnomon::renderer {

namespace {

using tinygltf::Model;
using tinygltf::Primitive;

const int* find(const std::map<std::string, int>& attributes, const std::string& name)
{
    const auto found = attributes.find(name);
    return found == attributes.end() ? nullptr : &found->second;
}

// The numbers themselves. Throws unless each corner has as many as there are components.
template <class T> std::vector<T> for_corners(std::vector<T> numbers, std::size_t components, std::size_t corners)
{
    if (numbers.size() != components * corners)
        throw std::runtime_error("attributes of a primitive have unlike counts");
    return numbers;
}

// Positions or normals, displaced by each morph target times its weight; none where the primitive has none.
std::vector<glm::dvec3> morphed(const Model& model, const Primitive& from, const std::string& attribute,
                                const std::vector<double>& weights)
{
    const int* base = find(from.attributes, attribute);
    if (!base) return {};
    std::vector<double> sum = gltf_numbers(model, *base, TINYGLTF_TYPE_VEC3);
    for (std::size_t t = 0; t < from.targets.size(); ++t) {
        const int* target = find(from.targets[t], attribute);
        if (!target) continue;
        const std::vector<double> by = for_corners(gltf_numbers(model, *target, TINYGLTF_TYPE_VEC3), 3, sum.size() / 3);
        for (std::size_t i = 0; i < sum.size() && weights[t] != 0; ++i) sum[i] += weights[t] * by[i];
    }
    std::vector<glm::dvec3> result(sum.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = glm::make_vec3(&sum[3 * i]);
    return result;
}

// The joints that move each vertex of a primitive, and their weights: as many of both for each vertex.
struct binding {
    std::vector<std::uint32_t> joints;
    std::vector<double> weights;
};

// A set of four joints for each vertex. Refuses triangles with a vertex that no joint moves.
std::vector<binding> bindings_of(const Model& model, const Primitive& from, std::size_t corners,
                                 const std::vector<glm::uvec3>& triangles)
{
    std::vector<binding> sets;
    std::vector<double> sums(corners);
    while (true) {
        const std::string set = std::to_string(sets.size());
        const int *joints = find(from.attributes, "JOINTS_" + set), *weights = find(from.attributes, "WEIGHTS_" + set);
        if (!joints && !weights) break;
        if (!joints || !weights) throw std::runtime_error("a primitive has joints or weights alone");
        sets.push_back({for_corners(gltf_whole_numbers(model, *joints, TINYGLTF_TYPE_VEC4), 4, corners),
                        for_corners(gltf_numbers(model, *weights, TINYGLTF_TYPE_VEC4), 4, corners)});
        for (std::size_t i = 0; i < 4 * corners; ++i) sums[i / 4] += sets.back().weights[i];
    }
    const auto is_carried = [&](std::uint32_t corner) { return sums[corner] > 0 && std::isfinite(sums[corner]); };
    for (const glm::uvec3& t : triangles)
        if (!is_carried(t.x) || !is_carried(t.y) || !is_carried(t.z))
            throw std::runtime_error("no joint of its skin carries a corner");
    return sets;
}

std::vector<glm::dmat4> joint_matrices(const Model& model, const tinygltf::Skin& skin, const gltf_pose& at)
{
    std::vector<glm::dmat4> matrices;
    for (const int joint : skin.joints) {
        gltf_item(model.nodes, joint, "node");
        matrices.push_back(at.to_world[static_cast<std::size_t>(joint)]);
    }
    if (skin.inverseBindMatrices < 0) return matrices;
    const std::vector<double> inverse = gltf_numbers(model, skin.inverseBindMatrices, TINYGLTF_TYPE_MAT4);
    if (inverse.size() < 16 * matrices.size()) throw std::runtime_error("a skin has fewer matrices than joints");
    for (std::size_t i = 0; i < matrices.size(); ++i) matrices[i] *= affine(&inverse[16 * i]);
    return matrices;
}

// Matrices from the coordinates of a primitive to those of the world: one for all vertices, or one for each if joints
// move them. Weights are divided by their sum.
std::vector<glm::dmat4> corner_matrices(const Model& model, const Primitive& from, std::size_t node,
                                        std::size_t corners, const std::vector<glm::uvec3>& triangles,
                                        const gltf_pose& at)
{
    if (model.nodes[node].skin < 0) return {at.to_world[node]};
    const std::vector<glm::dmat4> joints =
        joint_matrices(model, gltf_item(model.skins, model.nodes[node].skin, "skin"), at);
    std::vector<glm::dmat4> sums(corners, glm::dmat4(0));
    for (const binding& set : bindings_of(model, from, corners, triangles))
        for (std::size_t i = 0; i < set.joints.size(); ++i) {
            if (set.weights[i] == 0) continue;
            if (set.joints[i] >= joints.size()) throw std::runtime_error("a corner's joint is not in its skin");
            sums[i / 4] += set.weights[i] * joints[set.joints[i]];
        }
    for (glm::dmat4& sum : sums) sum /= sum[3][3]; // the sum of the weights, since all matrices are affine
    return sums;
}

// The triangles of a list, a strip or a fan; none of points and lines. Every second triangle of a strip is reversed.
std::vector<glm::uvec3> triangles_of(const Model& model, const Primitive& from, std::size_t corners)
{
    std::vector<std::uint32_t> order;
    if (from.indices >= 0) {
        order = gltf_whole_numbers(model, from.indices, TINYGLTF_TYPE_SCALAR);
        for (const std::uint32_t index : order)
            if (index >= corners)
                throw std::runtime_error(fmt::format("index {} where there are {} corners", index, corners));
    } else {
        for (std::uint32_t i = 0; i < corners; ++i) order.push_back(i);
    }
    std::vector<glm::uvec3> result;
    const std::size_t step = from.mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
    for (std::size_t i = 0; i + 2 < order.size(); i += step) {
        const bool odd = from.mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1;
        const std::size_t first = from.mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : i;
        result.emplace_back(order[first], order[odd ? i + 2 : i + 1], order[odd ? i + 1 : i + 2]);
    }
    return result;
}

bool has_triangles(const Primitive& from)
{
    if (from.mode < TINYGLTF_MODE_POINTS || from.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        throw std::runtime_error(fmt::format("primitives of mode {} are not supported", from.mode));
    return from.mode >= TINYGLTF_MODE_TRIANGLES && find(from.attributes, "POSITION");
}

glm::vec3 albedo_of(const Model& model, int material)
{
    if (material < 0) return glm::vec3(1); // the format's default
    const std::vector<double>& colour =
        gltf_item(model.materials, material, "material").pbrMetallicRoughness.baseColorFactor;
    return glm::clamp(glm::vec3(colour[0], colour[1], colour[2]), 0.f, 1.f);
}

model_part convert(const Model& model, std::size_t node, const Primitive& from, const gltf_pose& open,
                   const gltf_pose& closing)
{
    model_part part{.name = model.meshes[static_cast<std::size_t>(model.nodes[node].mesh)].name,
                    .albedo = albedo_of(model, from.material),
                    .open = morphed(model, from, "POSITION", open.weights[node]),
                    .closing = morphed(model, from, "POSITION", closing.weights[node]),
                    .normals = {},
                    .triangles = {}};
    const std::size_t corners = part.open.size();
    part.triangles = triangles_of(model, from, corners);
    const std::vector<glm::dmat4> opening = corner_matrices(model, from, node, corners, part.triangles, open);
    const std::vector<glm::dmat4> closed = corner_matrices(model, from, node, corners, part.triangles, closing);
    const auto matrix = [](const std::vector<glm::dmat4>& all, std::size_t i) { return all[all.size() > 1 ? i : 0]; };
    for (std::size_t i = 0; i < corners; ++i) {
        part.open[i] = glm::dvec3(matrix(opening, i) * glm::dvec4(part.open[i], 1));
        part.closing[i] = glm::dvec3(matrix(closed, i) * glm::dvec4(part.closing[i], 1));
    }
    const std::vector<glm::dvec3> normals = morphed(model, from, "NORMAL", open.weights[node]);
    if (!normals.empty()) for_corners(normals, 1, corners);
    for (std::size_t i = 0; i < normals.size(); ++i)
        part.normals.emplace_back(for_normals(matrix(opening, i)) * normals[i]);
    for (glm::uvec3& triangle : part.triangles)
        if (glm::determinant(glm::dmat3(matrix(opening, triangle.x))) < 0) std::swap(triangle.y, triangle.z);
    return part;
}

} // namespace

std::vector<model_part> read_gltf_parts(const std::filesystem::path& file, const std::optional<exposure>& when)
{
    const Model model = read_gltf_file(file);
    gltf_pose open, closing;
    if (when) {
        std::vector<std::string> names;
        for (const tinygltf::Animation& animation : model.animations) names.push_back(animation.name);
        const tinygltf::Animation& animation = model.animations[find_animation(names, when->animation)];
        check_exposure(*when, animation.name, gltf_duration(model, animation));
        open = gltf_pose_at(model, animation, when->open);
        closing = gltf_pose_at(model, animation, when->closing);
    } else {
        open = closing = gltf_pose_at_rest(model);
    }
    std::vector<model_part> parts;
    for (const int index : gltf_scene_nodes(model)) {
        const auto node = static_cast<std::size_t>(index);
        if (model.nodes[node].mesh < 0) continue;
        for (const Primitive& from : gltf_item(model.meshes, model.nodes[node].mesh, "mesh").primitives)
            if (has_triangles(from)) parts.push_back(convert(model, node, from, open, closing));
    }
    return parts;
}

} // namespace gnomon::renderer
