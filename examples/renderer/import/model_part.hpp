// The result of readers of model files: meshes placed in the world, and the times at which they are wanted.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::renderer {

// Vertices are in double until they are normalised, so that a small model far from the origin keeps its shape.
struct model_part {
    std::string name;
    glm::vec3 albedo{0.7f};
    std::vector<glm::dvec3> open, closing; // places when the shutter opens and closes, equally many
    std::vector<glm::vec3> normals;        // when the shutter opens: one for each corner, or none; of any length
    std::vector<glm::uvec3> triangles;     // corners that exist, counter-clockwise when seen from outside
};

// A part of an animation, both times in seconds after its start. An empty name means the file's first animation.
struct exposure {
    std::string_view animation;
    double open, closing;
};

// The index in the list of the animation of this name, 0 if the name is empty. Throws std::runtime_error, which lists
// the names of the file, if there is none.
std::size_t find_animation(std::span<const std::string> names, std::string_view name);

// Throws std::runtime_error unless the shutter closes no earlier than it opens, and both within the animation.
void check_exposure(const exposure& when, std::string_view name, double duration);

} // namespace gnomon::renderer
