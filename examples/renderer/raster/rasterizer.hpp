// A minimal rasterizer on the CPU. Parallel over tiles; results do not depend on the number of threads. All meshes are
// drawn as opaque ones; fragments.hpp has translucent ones.
//
// Coverage follows the rules of Direct3D: vertices snap to subpixels, edge functions are exact integers, the top-left
// rule gives a sample on a shared edge to exactly one triangle, and four samples lie in the standard rotated pattern.
// Depth and position are where the view ray through the sample meets the plane of the unsnapped triangle, in double.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace gnomon::renderer {

enum class faces { both, front, back };

// Steps per pixel to which corners snap.
inline constexpr int subpixels = 256;

// Offsets from the pixel centre in 1/16 pixel, y down: D3D11_STANDARD_MULTISAMPLE_PATTERN.
template <int Samples> inline constexpr std::array<glm::ivec2, Samples> sample_offsets{};
template <> inline constexpr std::array<glm::ivec2, 4> sample_offsets<4>{{{-2, -6}, {6, -2}, {-6, 2}, {2, 6}}};

// Linear depth of the nearest surface at each sample, 1 if there is none. Samples is 1 or 4.
template <int Samples>
image<std::array<float, Samples>> rasterize_depth(const scene& world, const camera& eye, int width, int height,
                                                  faces visible = faces::both);

// The point of a surface that a camera sees at a pixel centre.
struct surface {
    int mesh = -1; // index into scene::meshes, -1 for the background
    glm::vec3 position{0};
    glm::vec3 normal{0};         // of the triangle, unit length, towards the camera
    glm::vec3 shading_normal{0}; // interpolated if the mesh has normals, on the same side
    glm::vec3 d_dx{0}, d_dy{0};  // change of position per pixel to the right and down, along the triangle's plane

    bool valid() const { return mesh >= 0; }
};

// The nearest surface at each pixel centre.
image<surface> rasterize_surfaces(const scene& world, const camera& eye, int width, int height,
                                  faces visible = faces::both);

} // namespace gnomon::renderer
