#include "gltf_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace gnomon::renderer {

namespace {

using nlohmann::json;

template <class T> T little_endian_at(std::string_view bytes, std::size_t offset)
{
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

bool is_index(const json& value)
{
    return value.is_number_unsigned() && value.get<std::uint64_t>() <= std::numeric_limits<std::int32_t>::max();
}

bool is_number(const json& value) { return value.is_number(); }

bool all(const json& values, bool (*holds)(const json&))
{
    return values.is_structured() && std::ranges::all_of(values, holds);
}

bool all_indices(const json& values) { return all(values, is_index); }

// True where this is no index but the indices of a sparse accessor.
bool is_sparse_part(const std::string& key, const json& value)
{
    return key == "indices" && value.is_object() && value.contains("bufferView");
}

// True for a key that is one of several words; each has a space before and behind it.
bool is_among(const std::string& key, std::string_view words)
{
    return words.find(" " + key + " ") != std::string_view::npos;
}

constexpr std::string_view lists = " accessors animations buffers bufferViews meshes nodes scenes skins ";
constexpr std::string_view inner_lists = " channels primitives samplers ";
constexpr std::string_view index_keys =
    " buffer bufferView byteLength byteOffset byteStride camera componentType count indices input inverseBindMatrices "
    "material mesh mode node output sampler scene skeleton skin ";
constexpr std::string_view index_list_keys = " attributes children joints nodes ";
constexpr std::string_view number_list_keys = " matrix rotation scale translation weights ";
constexpr std::string_view text_keys = " interpolation path type ";

// The version that the text says, nothing where that is no text.
std::string version_of(const json& root)
{
    if (!root.is_object() || !root.contains("asset") || !root["asset"].is_object()) return {};
    const json& asset = root["asset"];
    return asset.contains("version") && asset["version"].is_string() ? asset["version"].get<std::string>() : "";
}

// Checks the types of all values that say where a corner is.
void check_types(const json& value, int depth)
{
    if (depth > 6) return; // nothing of the format lies deeper
    if (value.is_array())
        for (const json& item : value) check_types(item, depth + 1);
    if (!value.is_object()) return;
    for (const auto& entry : value.items()) {
        const std::string& key = entry.key();
        const json& item = entry.value();
        const auto hold = [&](bool right, const char* what) {
            if (!right) throw std::runtime_error(fmt::format("\"{}\" is not {}", key, what));
        };
        if (key == "extensions" || key == "extras" || (depth == 0 && key != "scene" && !is_among(key, lists))) continue;
        if (is_among(key, depth == 0 ? lists : inner_lists)) hold(item.is_array(), "a list");
        else if (is_among(key, index_keys) && !is_sparse_part(key, item)) hold(is_index(item), "an index or a size");
        else if (is_among(key, index_list_keys)) hold(all_indices(item), "a list of indices");
        else if (is_among(key, number_list_keys)) hold(all(item, is_number), "a list of numbers");
        else if (is_among(key, text_keys)) hold(item.is_string(), "a text");
        else if (key == "targets") hold(all(item, all_indices), "a list of morph targets");
        else if (key == "normalized") hold(item.is_boolean(), "true or false");
        if (item.is_structured()) check_types(item, depth + 1);
    }
}

} // namespace

bool is_gltf_binary(std::string_view bytes) { return bytes.starts_with("glTF"); }

bool is_gltf_1(std::string_view bytes)
{
    if (is_gltf_binary(bytes)) return bytes.size() >= 8 && little_endian_at<std::uint32_t>(bytes, 4) == 1;
    return version_of(json::parse(bytes, nullptr, false)).starts_with("1");
}

std::string_view gltf_json_text(std::string_view bytes)
{
    if (!is_gltf_binary(bytes)) return bytes;
    constexpr std::size_t header = 12, chunk = 8;
    if (bytes.size() < header + chunk) throw std::runtime_error("the file is cut off");
    const std::size_t length = little_endian_at<std::uint32_t>(bytes, header), after = header + chunk + length;
    if (after > bytes.size() ||
        (after + chunk <= bytes.size() && little_endian_at<std::uint32_t>(bytes, after) > bytes.size() - after - chunk))
        throw std::runtime_error("the file is cut off");
    return bytes.substr(header + chunk, length);
}

void check_gltf_text(std::string_view text)
{
    const json root = json::parse(text, nullptr, false);
    if (!root.is_object()) throw std::runtime_error("no JSON object in it");
    const std::string version = version_of(root);
    if (!version.starts_with("2."))
        throw std::runtime_error(version.empty() ? "no version of glTF in it"
                                                 : fmt::format("glTF version {} is not supported, only 2", version));
    constexpr std::array harmless{"KHR_materials_", "KHR_technique", "KHR_texture_", "EXT_texture_",
                                  "MSFT_texture_",  "KHR_lights_",   "EXT_lights_",  "KHR_mesh_quantization"};
    for (const json& required : root.value("extensionsRequired", json::array())) {
        const std::string name = required.is_string() ? required.get<std::string>() : "";
        if (std::ranges::none_of(harmless, [&](const char* prefix) { return name.starts_with(prefix); }))
            throw std::runtime_error(fmt::format("extension {} is not supported", name));
    }
    check_types(root, 0);
}

} // namespace gnomon::renderer
