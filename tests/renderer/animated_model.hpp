// Requests for parts of animations, and corners of their answers.
#pragma once

#include "renderer/import/model.hpp"

#include <glm/geometric.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gnomon::test {

inline bool near(const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-5f; }

/// The error of reading an animation, without the name of the file; "none" if there is no error.
inline std::string complaint_about(const std::filesystem::path& file, std::string_view animation, double open,
                                   double closing)
{
    try {
        renderer::load_animated_model(file, animation, open, closing);
    } catch (const std::runtime_error& error) {
        const std::string line = error.what(), prefix = file.string() + ": ";
        return line.starts_with(prefix) ? line.substr(prefix.size()) : line;
    }
    return "none";
}

} // namespace gnomon::test
