#include "model.hpp"

#include "assimp_model.hpp"
#include "gltf_model.hpp"
#include "gltf_text.hpp"
#include "import_guard.hpp"
#include "model_part.hpp"
#include "renderer/output/file.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::renderer {

namespace {

std::string one_line(std::string text)
{
    std::ranges::replace_if(
        text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text.substr(0, text.find_last_not_of(' ') + 1);
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Leaves out triangles with a vertex that is not finite at either time.
void drop_undrawable(model_part& part)
{
    std::erase_if(part.triangles, [&](const glm::uvec3& t) {
        return !(finite(part.open[t.x]) && finite(part.open[t.y]) && finite(part.open[t.z]) &&
                 finite(part.closing[t.x]) && finite(part.closing[t.y]) && finite(part.closing[t.z]));
    });
}

// Moves unused vertices to a used one, so that they do not extend the bounds.
void gather_unused(model_part& part)
{
    std::vector<bool> used(part.open.size());
    for (const glm::uvec3& t : part.triangles) used[t.x] = used[t.y] = used[t.z] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) {
            part.open[i] = part.open[part.triangles[0].x];
            part.closing[i] = part.closing[part.triangles[0].x];
        }
}

// The parts on y = 0 above the origin, the longest side of the bounds of both times one. In double, because a box that
// float can hold may be wider than float's range.
moving_scene normalised(std::string name, const std::vector<model_part>& parts)
{
    glm::dvec3 lower = parts[0].open[0], upper = lower;
    for (const model_part& part : parts)
        for (const std::vector<glm::dvec3>* places : {&part.open, &part.closing})
            for (const glm::dvec3& place : *places) lower = glm::min(lower, place), upper = glm::max(upper, place);
    const glm::dvec3 extent = upper - lower;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0)) throw std::runtime_error("all triangles lie in one point");
    if (!std::isfinite(longest)) throw std::runtime_error("the model is too large");
    const glm::dvec3 origin(0.5 * (lower.x + upper.x), lower.y, 0.5 * (lower.z + upper.z));
    const auto fit = [&](const std::vector<glm::dvec3>& places) {
        std::vector<glm::vec3> result;
        for (const glm::dvec3& place : places) result.emplace_back((place - origin) / longest);
        return result;
    };
    moving_scene model{{std::move(name), {}}, {}};
    for (const model_part& part : parts) {
        model.open.meshes.push_back({.name = part.name,
                                     .albedo = part.albedo,
                                     .positions = fit(part.open),
                                     .normals = part.normals,
                                     .triangles = part.triangles});
        for (glm::vec3& normal : model.open.meshes.back().normals) {
            const float length = glm::length(normal);
            normal = length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0);
        }
        model.closing.push_back(fit(part.closing));
    }
    return model;
}

// True for a glTF file of version 2. Version 1 is another format, which Assimp reads.
bool is_gltf(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return (extension == ".gltf" || extension == ".glb") && !is_gltf_1(read_file(file));
}

moving_scene read(const std::filesystem::path& file, const std::optional<exposure>& when)
{
    if (!std::filesystem::exists(file)) throw std::runtime_error("no such file");
    if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("not a file");
    const import_guard guard(file);
    std::vector<model_part> parts = is_gltf(file) ? read_gltf_parts(file, when) : read_assimp_parts(file, when);
    for (model_part& part : parts) drop_undrawable(part);
    std::erase_if(parts, [](const model_part& part) { return part.triangles.empty(); });
    if (parts.empty()) throw std::runtime_error("no triangles in it");
    for (model_part& part : parts) gather_unused(part);
    return normalised(file.stem().string(), parts);
}

moving_scene load(const std::filesystem::path& file, const std::optional<exposure>& when)
try {
    return read(file, when);
} catch (const std::exception& error) {
    std::string cause = one_line(error.what());
    // Assimp catches the exception and keeps its name.
    if (dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error) ||
        cause == "std::bad_alloc")
        cause = "needs too much memory";
    const std::string prefix = file.string() + ": ";
    throw std::runtime_error(cause.starts_with(prefix) ? cause : prefix + cause);
}

} // namespace

scene load_model(const std::filesystem::path& file) { return load(file, std::nullopt).open; }

moving_scene load_animated_model(const std::filesystem::path& file, std::string_view animation, double open,
                                 double closing)
{
    return load(file, exposure{animation, open, closing});
}

} // namespace gnomon::renderer
