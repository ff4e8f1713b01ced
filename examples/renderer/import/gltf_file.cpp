#include "gltf_file.hpp"

#include "gltf_text.hpp"
#include "renderer/output/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace gnomon::renderer {

namespace {

// The first relevant complaint of tinygltf: the format allows a skin without matrices, and a channel without a node is
// ignored.
std::string first_complaint(std::string_view complaints)
{
    while (!complaints.empty()) {
        const std::string_view line = complaints.substr(0, complaints.find('\n'));
        complaints.remove_prefix(std::min(line.size() + 1, complaints.size()));
        if (!line.empty() && line != "'inverseBindMatrices' property is missing in Skin." &&
            line != "'node' property is missing." && line != "`node` field is missing in animation.channels.target")
            return std::string(line);
    }
    return {};
}

// The elements of a view: the offset of the first one and the distance to the next.
struct strided {
    const unsigned char* first;
    std::size_t stride;
};

strided elements(const tinygltf::Model& model, int index, std::size_t offset, std::size_t count, std::size_t size)
{
    const tinygltf::BufferView& view = gltf_item(model.bufferViews, index, "buffer view");
    const std::vector<unsigned char>& bytes = gltf_item(model.buffers, view.buffer, "buffer").data;
    if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset)
        throw std::runtime_error(fmt::format("buffer view {} reaches beyond its buffer", index));
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : size;
    const std::size_t room = offset > view.byteLength ? 0 : view.byteLength - offset;
    if (stride < size) throw std::runtime_error(fmt::format("elements overlap in buffer view {}", index));
    if (count > 0 && (room < size || (room - size) / stride < count - 1))
        throw std::runtime_error(fmt::format("an accessor reaches beyond buffer view {}", index));
    return {bytes.data() + view.byteOffset + std::min(offset, view.byteLength), stride};
}

std::size_t component_size(int type)
{
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            throw std::runtime_error(fmt::format("component type {} is not supported", type));
    }
}

template <class T> double component(const unsigned char* bytes, bool normalized)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    if (!normalized) return static_cast<double>(value);
    return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double component(const unsigned char* bytes, int type, bool normalized)
{
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return component<std::int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return component<std::uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return component<std::int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return component<std::uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return component<std::uint32_t>(bytes, normalized);
        default:
            return component<float>(bytes, false);
    }
}

bool is_unsigned(int type)
{
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// Replaces the elements of an accessor that its sparse part names.
void replace_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, std::size_t components,
                    std::vector<double>& numbers)
{
    const auto& sparse = accessor.sparse;
    if (!is_unsigned(sparse.indices.componentType)) throw std::runtime_error("sparse indices are no unsigned integers");
    const std::size_t index_size = component_size(sparse.indices.componentType);
    const std::size_t size = component_size(accessor.componentType), count = static_cast<std::size_t>(sparse.count);
    const strided indices = elements(model, sparse.indices.bufferView,
                                     static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size);
    const strided values = elements(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                    count, components * size);
    for (std::size_t i = 0; i < count; ++i) {
        const auto target = static_cast<std::size_t>(
            component(indices.first + i * indices.stride, sparse.indices.componentType, false));
        if (target >= accessor.count) throw std::runtime_error("a sparse index lies beyond its accessor");
        for (std::size_t k = 0; k < components; ++k)
            numbers[target * components + k] =
                component(values.first + i * values.stride + k * size, accessor.componentType, accessor.normalized);
    }
}

} // namespace

void throw_no_such_item(const char* what, int index, std::size_t count)
{
    throw std::runtime_error(fmt::format("there is no {} {} among {}", what, index, count));
}

tinygltf::Model read_gltf_file(const std::filesystem::path& file)
{
    const std::string bytes = read_file(file);
    if (bytes.size() > std::numeric_limits<unsigned>::max()) throw std::runtime_error("the file has over 4 GiB");
    check_gltf_text(gltf_json_text(bytes));
    tinygltf::TinyGLTF reader;
    reader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int,
                             void*) { return true; },
                          nullptr);
    tinygltf::Model model;
    std::string complaints, warnings;
    const auto length = static_cast<unsigned>(bytes.size());
    const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
    const bool good =
        is_gltf_binary(bytes)
            ? reader.LoadBinaryFromMemory(&model, &complaints, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), length, folder)
            : reader.LoadASCIIFromString(&model, &complaints, &warnings, bytes.data(), length, folder);
    const std::string complaint = first_complaint(complaints);
    if (!good || !complaint.empty())
        throw std::runtime_error(complaint.empty() ? "tinygltf cannot read it" : complaint);
    return model;
}

std::vector<double> gltf_numbers(const tinygltf::Model& model, int index, int type)
{
    const tinygltf::Accessor& accessor = gltf_item(model.accessors, index, "accessor");
    if (accessor.type != type) throw std::runtime_error(fmt::format("accessor {} has the wrong type", index));
    const auto components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    const std::size_t size = component_size(accessor.componentType);
    if (accessor.count > std::numeric_limits<std::uint32_t>::max()) throw std::bad_alloc();
    std::vector<double> numbers;
    const auto zeros = [&] { numbers.resize(accessor.count * components); }; // not before the count is checked
    if (accessor.bufferView >= 0) {
        const strided from =
            elements(model, accessor.bufferView, accessor.byteOffset, accessor.count, components * size);
        zeros();
        for (std::size_t i = 0; i < accessor.count; ++i)
            for (std::size_t k = 0; k < components; ++k)
                numbers[i * components + k] =
                    component(from.first + i * from.stride + k * size, accessor.componentType, accessor.normalized);
    } else {
        zeros();
    }
    if (accessor.sparse.isSparse) replace_sparse(model, accessor, components, numbers);
    return numbers;
}

std::vector<std::uint32_t> gltf_whole_numbers(const tinygltf::Model& model, int index, int type)
{
    const tinygltf::Accessor& accessor = gltf_item(model.accessors, index, "accessor");
    if (!is_unsigned(accessor.componentType) || accessor.normalized)
        throw std::runtime_error(fmt::format("accessor {} holds no unsigned integers", index));
    std::vector<std::uint32_t> whole;
    for (const double number : gltf_numbers(model, index, type)) whole.push_back(static_cast<std::uint32_t>(number));
    return whole;
}

std::vector<gltf_link> gltf_hierarchy(const tinygltf::Model& model)
{
    std::vector<int> parents(model.nodes.size(), -1);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children) {
            gltf_item(model.nodes, child, "node");
            int& parent = parents[static_cast<std::size_t>(child)];
            if (parent >= 0) throw std::runtime_error(fmt::format("node {} is a child twice", child));
            parent = static_cast<int>(i);
        }
    std::vector<gltf_link> order;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (parents[i] < 0) order.push_back({static_cast<int>(i), -1});
    for (std::size_t done = 0; done < order.size(); ++done) {
        const int parent = order[done].node;
        for (const int child : model.nodes[static_cast<std::size_t>(parent)].children) order.push_back({child, parent});
    }
    if (order.size() < parents.size()) throw std::runtime_error("nodes are their own descendants");
    return order;
}

std::vector<int> gltf_scene_nodes(const tinygltf::Model& model)
{
    std::vector<bool> is_root(model.nodes.size());
    std::vector<int> roots;
    for (const gltf_link& link : gltf_hierarchy(model))
        if (link.parent < 0) {
            is_root[static_cast<std::size_t>(link.node)] = true;
            roots.push_back(link.node);
        }
    if (!model.scenes.empty() || model.defaultScene >= 0)
        roots = gltf_item(model.scenes, std::max(model.defaultScene, 0), "scene").nodes;
    for (const int root : roots) {
        gltf_item(model.nodes, root, "node");
        if (!is_root[static_cast<std::size_t>(root)])
            throw std::runtime_error(fmt::format("node {} is no root or is in the scene twice", root));
        is_root[static_cast<std::size_t>(root)] = false;
    }
    std::vector<int> order, waiting(roots.rbegin(), roots.rend());
    while (!waiting.empty()) {
        const int node = waiting.back();
        waiting.pop_back();
        order.push_back(node);
        const std::vector<int>& children = model.nodes[static_cast<std::size_t>(node)].children;
        waiting.insert(waiting.end(), children.rbegin(), children.rend());
    }
    return order;
}

} // namespace gnomon::renderer
