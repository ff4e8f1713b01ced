// A glTF 2.0 file, read by tinygltf and checked where tinygltf is not strict: tinygltf treats a value of a wrong type
// as absent, cuts indices to 32 bits, and checks no range of an accessor. Every function throws std::runtime_error with
// the cause, or std::bad_alloc.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace gnomon::renderer {

// The file and its buffers, without pictures.
tinygltf::Model read_gltf_file(const std::filesystem::path& file);

// The item at an index of the file; `what` is the item's word in the error.
template <class T> const T& gltf_item(const std::vector<T>& items, int index, const char* what);

// The numbers of the accessor at an index, element by element; its type must be this one (TINYGLTF_TYPE_...).
// Normalized integers become fractions.
std::vector<double> gltf_numbers(const tinygltf::Model& model, int index, int type);

// The whole numbers of the accessor at an index, which a file may store as unsigned integers only.
std::vector<std::uint32_t> gltf_whole_numbers(const tinygltf::Model& model, int index, int type);

// A node and its parent, -1 if it has none.
struct gltf_link {
    int node, parent;
};

// Every node of the file, parents first. Throws if a node has two parents or is its own ancestor.
std::vector<gltf_link> gltf_hierarchy(const tinygltf::Model& model);

// The nodes of the file's scene, each followed by its children. The scene is the file's default one, or the first one,
// or made of all nodes where there is none.
std::vector<int> gltf_scene_nodes(const tinygltf::Model& model);

[[noreturn]] void throw_no_such_item(const char* what, int index, std::size_t count);

template <class T> const T& gltf_item(const std::vector<T>& items, int index, const char* what)
{
    if (index < 0 || static_cast<std::size_t>(index) >= items.size()) throw_no_such_item(what, index, items.size());
    return items[static_cast<std::size_t>(index)];
}

} // namespace gnomon::renderer
