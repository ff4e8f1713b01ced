// A minimal rasterizer on the CPU, parallel over tiles; its results do not depend on the number of threads.
//
// Coverage follows the rules of Direct3D: vertices snap to subpixels, edge functions are exact integers, the top-left
// rule gives a sample on a shared edge to exactly one triangle, four samples lie in the standard rotated pattern. Depth
// and position, however, are those of the view ray through the sample and the plane of the unsnapped triangle, in
// double.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace gnomon::renderer {

enum class faces { both, front, back };

// Steps per pixel that corners snap to.
inline constexpr int subpixels = 256;

// Offsets from the pixel centre in 1/16 pixel, y down: D3D11_STANDARD_MULTISAMPLE_PATTERN.
template <int Samples> inline constexpr std::array<glm::ivec2, Samples> sample_offsets{};
template <> inline constexpr std::array<glm::ivec2, 4> sample_offsets<4>{{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}};

// Linear depth of the nearest surface in each sample, 1 where there is none. Samples is 1 or 4.
template <int Samples>
image<std::array<float, Samples>> rasterize_depth(const scene& world, const camera& eye, int width, int height,
                                                  faces visible = faces::both);

// What a camera sees at a pixel centre.
struct surface {
    int mesh = -1; // index into scene::meshes, -1 for the background
    glm::vec3 position{0};
    glm::vec3 normal{0};         // of the triangle, unit length, towards the camera
    glm::vec3 shading_normal{0}; // interpolated where the mesh has normals, on the same side
    glm::vec3 d_dx{0}, d_dy{0};  // change of position per pixel to the right and down, along the triangle's plane

    bool valid() const { return mesh >= 0; }
};

image<surface> rasterize_surfaces(const scene& world, const camera& eye, int width, int height,
                                  faces visible = faces::both);

} // namespace gnomon::renderer
