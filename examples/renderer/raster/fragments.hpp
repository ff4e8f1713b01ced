// All fragments of the translucent meshes at each pixel centre, in order of depth, with the coverage, the depths and the
// positions of the rasterizer. Parallel; results do not depend on the number of threads.
//
// A fragment exists where its depth is less than that of the nearest opaque surface, and where its opacity is not zero.
// Lists run from back to front; fragments of equal depth run from the last mesh and triangle to the first, so that the
// order of a list is the reverse of the order in which rasterize_surfaces prefers surfaces.
#pragma once

#include "rasterizer.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer {

struct fragment {
    float depth; // linear, as in a shadow map
    glm::vec3 opacity;
    int mesh; // index into scene::meshes
};

// Pixel i, row by row, has the fragments first[i] to first[i + 1] - 1.
struct fragment_map {
    int width = 0, height = 0;
    std::vector<std::uint32_t> first;
    std::vector<fragment> fragments;

    std::span<const fragment> operator()(std::size_t pixel) const
    {
        return std::span(fragments).subspan(first[pixel], first[pixel + 1] - first[pixel]);
    }
    std::span<const fragment> operator()(int x, int y) const
    {
        return (*this)(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    }
};

fragment_map rasterize_fragments(const scene& world, const camera& eye, int width, int height,
                                 faces visible = faces::both);

// The opaque surface of each pixel, and the translucent surfaces before it: pixel i, row by row, has the layers
// first[i] to first[i + 1] - 1 and their opacities, from back to front.
struct surface_layers {
    image<surface> opaque;
    std::vector<std::uint32_t> first;
    std::vector<surface> layers;
    std::vector<glm::vec3> opacities;

    std::span<const surface> operator()(std::size_t pixel) const
    {
        return std::span(layers).subspan(first[pixel], first[pixel + 1] - first[pixel]);
    }
};

surface_layers rasterize_surface_layers(const scene& world, const camera& eye, int width, int height,
                                        faces visible = faces::both);

} // namespace gnomon::renderer
