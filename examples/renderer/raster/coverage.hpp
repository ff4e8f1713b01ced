// The coverage of samples by triangles, for the rasterizers of this folder: clipped and snapped parts of triangles, sorted
// into tiles, with exact edge functions and the planes on which view rays meet them.
#pragma once

#include "rasterizer.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::renderer::coverage {

inline constexpr int tile_size = 64;

struct triangle_id {
    std::uint32_t mesh = 0, triangle = 0;
    auto operator<=>(const triangle_id&) const = default;
};

struct triangle {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 normal() const { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }
};

inline triangle triangle_of(const scene& world, triangle_id id)
{
    const mesh& part = world.meshes[id.mesh];
    const glm::uvec3 index = part.triangles[id.triangle];
    return {{part.positions[index.x], part.positions[index.y], part.positions[index.z]}};
}

// The plane of a triangle as the view rays meet it: q = a + b x + c y in pixels is the view distance in an orthographic
// view, and its reciprocal in perspective.
struct distance_plane {
    double a, b, c;
    double at(double x, double y) const { return a + b * x + c * y; }
};

// A picture of this size in pixels. Throws std::invalid_argument if the size is not possible.
struct viewport {
    const camera& eye;
    glm::dvec2 size;

    viewport(const camera& from, int width, int height);

    double distance(double q) const { return eye.perspective() ? 1 / q : q; }
    float depth(double q) const { return static_cast<float>(linear_depth(eye, distance(q))); }

    // Ray and plane: n.(origin + t direction - corner) = 0, where the ray is affine in the pixel.
    distance_plane plane_of(const triangle& shape) const
    {
        const glm::dvec3 n = shape.normal();
        const auto q = [&](const glm::dvec2& pixel) {
            const view_ray ray = ray_through(eye, pixel / size);
            const double along = glm::dot(n, ray.direction), to_corner = glm::dot(n, shape.corners[0] - ray.origin);
            return eye.perspective() ? along / to_corner : to_corner / along;
        };
        const double a = q({0, 0});
        return {a, (q({size.x, 0}) - a) / size.x, (q({0, size.y}) - a) / size.y};
    }

    // Homogeneous pixel coordinates relative to the picture's centre, view distance, and weight.
    glm::dvec4 clip_space(const glm::dvec3& point) const;
};

// A convex part of a triangle, prepared for sampling. A sample is inside if a x + b y + c >= 0 for all edges, in
// subpixels.
struct setup {
    struct edge {
        std::int64_t a, b, c;
    };
    std::array<edge, 3> edges;
    glm::ivec2 first, last; // pixels that the part may cover, both included
    distance_plane plane;
    double q_min, q_max; // at the corners, which extrapolation to a sample never exceeds
    triangle_id id;
};

std::vector<setup> set_up(const scene& world, const viewport& view, faces visible);

// Setups by tile: those of tile i are members[first[i]] to members[first[i + 1] - 1].
struct tile_grid {
    int columns, rows;
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> members;
};

tile_grid sort_into_tiles(const std::vector<setup>& setups, const viewport& view);

// Calls fragment(x, y, sample, q, id) for each sample that the setup covers between the pixels low and high.
template <int Samples, class Fragment>
void sample_setup(const setup& s, glm::ivec2 low, glm::ivec2 high, const Fragment& fragment)
{
    low = glm::max(low, s.first), high = glm::min(high, s.last);
    for (int y = low.y; y <= high.y; ++y)
        for (int sample = 0; sample < Samples; ++sample) {
            const glm::ivec2 offset =
                subpixels / 2 + subpixels / 16 * sample_offsets<Samples>[static_cast<std::size_t>(sample)];
            const glm::i64vec2 start(low.x * subpixels + offset.x, y * subpixels + offset.y);
            std::array<std::int64_t, 3> edge;
            for (std::size_t i = 0; i < 3; ++i)
                edge[i] = s.edges[i].a * start.x + s.edges[i].b * start.y + s.edges[i].c;
            const glm::dvec2 shift = glm::dvec2(offset) / double(subpixels);
            for (int x = low.x; x <= high.x; ++x) {
                if ((edge[0] | edge[1] | edge[2]) >= 0)
                    fragment(x, y, sample, std::clamp(s.plane.at(x + shift.x, y + shift.y), s.q_min, s.q_max), s.id);
                for (std::size_t i = 0; i < 3; ++i) edge[i] += s.edges[i].a * subpixels;
            }
        }
}

// Calls fragment(x, y, sample, q, id) for each covered sample, in parallel over tiles: never twice at a time for one
// tile. The order of the calls is arbitrary.
template <int Samples, class Fragment>
void rasterize(const scene& world, const viewport& view, faces visible, const Fragment& fragment)
{
    const std::vector<setup> setups = set_up(world, view, visible);
    const tile_grid grid = sort_into_tiles(setups, view);
    tbb::parallel_for(0, grid.columns * grid.rows, [&](int tile) {
        const glm::ivec2 low = tile_size * glm::ivec2(tile % grid.columns, tile / grid.columns);
        const auto index = static_cast<std::size_t>(tile);
        for (std::size_t i = grid.first[index]; i < grid.first[index + 1]; ++i)
            sample_setup<Samples>(setups[grid.members[i]], low, low + tile_size - 1, fragment);
    });
}

} // namespace gnomon::renderer::coverage
