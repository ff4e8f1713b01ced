// The shaders as glslangValidator compiled them, from either language; resolve and lighting for each method that has a
// device form. CMake writes the definitions (CMakeLists.txt).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace gnomon::evaluation {

struct method_shaders {
    std::span<const std::uint32_t> resolve, lighting;
};

// Of maps of four moments that translucent surfaces blend into.
struct blend_shaders {
    std::span<const std::uint32_t> resolve, layer, lighting;
};

// Of soft shadows from a summed-area table.
struct soft_shaders {
    std::span<const std::uint32_t> resolve, rows, columns, lighting;
};

// Of single scattering, by the ids of storage formats.
struct scattering_shaders {
    std::span<const std::uint32_t> rectify, rectify_moments, scattering;
};
struct rectified_shaders {
    std::span<const std::uint32_t> prefix_groups, prefix_subgroups;
    std::map<std::string, scattering_shaders> formats;
};

// Of maps of depth-time ranges.
struct range_shaders {
    std::span<const std::uint32_t> fill, scan, resolve, look_up;
};

// Of layered maps of stochastic samples.
struct layer_shaders {
    std::span<const std::uint32_t> cluster, scan, accumulate, plain, look_up;
};

struct shader_texts {
    std::span<const std::uint32_t> scene, blur, layer;
    std::array<blend_shaders, 2> blend; // into one image and into two
    soft_shaders soft;
    rectified_shaders rectified;
    range_shaders ranges;
    layer_shaders layers;
    std::map<std::string, method_shaders> methods; // by their ids
};

const shader_texts& glsl_shaders();
const shader_texts& hlsl_shaders();

} // namespace gnomon::evaluation
