// The shaders as glslangValidator compiled them, from either language; resolve and lighting for each method that has a
// device form. CMake writes the definitions (CMakeLists.txt).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace gnomon::evaluation {

struct method_shaders {
    std::span<const std::uint32_t> resolve, lighting;
};

struct shader_texts {
    std::span<const std::uint32_t> scene, blur;
    std::map<std::string, method_shaders> methods; // by their ids
};

const shader_texts& glsl_shaders();
const shader_texts& hlsl_shaders();

} // namespace gnomon::evaluation
