#include "rasterizer.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <stdexcept>

namespace gnomon::renderer {

namespace {

constexpr int tile_size = 64;
constexpr int largest_extent = 1 << 14; // pixels; with the guard band below, edge functions stay under 2^52
constexpr double guard_band = 1 << 15;  // pixels beyond which triangles are clipped

struct triangle_id {
    std::uint32_t mesh = 0, triangle = 0;
    auto operator<=>(const triangle_id&) const = default;
};

// The plane of a triangle as the view rays meet it: q = a + b x + c y in pixels is the view distance in an orthographic
// view, and its reciprocal in perspective.
struct distance_plane {
    double a, b, c;
    double at(double x, double y) const { return a + b * x + c * y; }
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

struct triangle {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 normal() const { return glm::cross(corners[1] - corners[0], corners[2] - corners[0]); }
};

triangle triangle_of(const scene& world, triangle_id id)
{
    const mesh& part = world.meshes[id.mesh];
    const glm::uvec3 index = part.triangles[id.triangle];
    return {{part.positions[index.x], part.positions[index.y], part.positions[index.z]}};
}

struct viewport {
    const camera& eye;
    glm::dvec2 size;

    double distance(double q) const { return eye.perspective() ? 1 / q : q; }

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
    glm::dvec4 clip_space(const glm::dvec3& point) const
    {
        const double distance = view_distance(eye, point), weight = eye.perspective() ? distance : 1;
        const glm::dvec3 offset = point - eye.position;
        const glm::dvec2 ndc = glm::dvec2(glm::dot(offset, eye.right), -glm::dot(offset, eye.up)) / eye.half_extent;
        return {0.5 * ndc * size, distance, weight};
    }
};

// A triangle cut by n planes has at most 3 + n corners.
struct polygon {
    std::array<glm::dvec4, 9> corners;
    std::size_t count = 0;
};

// Clips a polygon to the side with inside(corner) >= 0 (Sutherland & Hodgman 1974). A cut is computed from the inner
// corner, so that two triangles get the same new corner on the edge that they share.
template <class Distance> void clip(polygon& shape, const Distance& inside)
{
    polygon result;
    for (std::size_t i = 0; i < shape.count; ++i) {
        const glm::dvec4 &p = shape.corners[i], &q = shape.corners[(i + 1) % shape.count];
        const double at_p = inside(p), at_q = inside(q);
        if (at_p >= 0) result.corners[result.count++] = p;
        if (at_p >= 0 && at_q < 0) result.corners[result.count++] = p + at_p / (at_p - at_q) * (q - p);
        if (at_p < 0 && at_q >= 0) result.corners[result.count++] = q + at_q / (at_q - at_p) * (p - q);
    }
    shape = result;
}

polygon visible_part(const triangle& shape, const viewport& view)
{
    polygon result;
    for (const glm::dvec3& corner : shape.corners) result.corners[result.count++] = view.clip_space(corner);
    clip(result, [&](const glm::dvec4& p) { return p.z - view.eye.near_distance; });
    clip(result, [&](const glm::dvec4& p) { return view.eye.far_distance - p.z; });
    clip(result, [](const glm::dvec4& p) { return guard_band * p.w - p.x; });
    clip(result, [](const glm::dvec4& p) { return guard_band * p.w + p.x; });
    clip(result, [](const glm::dvec4& p) { return guard_band * p.w - p.y; });
    clip(result, [](const glm::dvec4& p) { return guard_band * p.w + p.y; });
    return result;
}

using subpixel = glm::i64vec2;

setup::edge edge_between(const subpixel& p, const subpixel& q)
{
    const std::int64_t a = p.y - q.y, b = q.x - p.x, c = -(a * p.x + b * p.y);
    const bool left = a > 0, top = a == 0 && b > 0;
    return {a, b, left || top ? c : c - 1};
}

bool culled(const triangle& shape, const camera& eye, faces visible)
{
    const double facing = glm::dot(shape.normal(), eye.perspective() ? eye.position - shape.corners[0] : -eye.forward);
    return !std::isfinite(facing) || facing == 0 || (visible == faces::front && facing < 0) ||
           (visible == faces::back && facing > 0);
}

void append_setups(const scene& world, triangle_id id, const viewport& view, faces visible, std::vector<setup>& out)
{
    const triangle shape = triangle_of(world, id);
    if (culled(shape, view.eye, visible)) return;
    const polygon part = visible_part(shape, view);
    if (part.count < 3) return;

    setup result{};
    result.id = id;
    result.plane = view.plane_of(shape);
    std::array<subpixel, std::tuple_size_v<decltype(part.corners)>> snapped;
    double nearest = view.eye.far_distance, farthest = view.eye.near_distance;
    for (std::size_t i = 0; i < part.count; ++i) {
        // Rounding may leave the cut corners of a huge triangle outside of the guard band.
        const glm::dvec4& corner = part.corners[i];
        const double distance = std::clamp(corner.z, view.eye.near_distance, view.eye.far_distance);
        const glm::dvec2 from_centre = glm::dvec2(corner) / (view.eye.perspective() ? distance : 1);
        const glm::dvec2 pixel = 0.5 * view.size + glm::clamp(from_centre, -guard_band, guard_band);
        snapped[i] = {std::llround(subpixels * pixel.x), std::llround(subpixels * pixel.y)};
        nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
    }
    result.q_min = view.eye.perspective() ? 1 / farthest : nearest;
    result.q_max = view.eye.perspective() ? 1 / nearest : farthest;

    for (std::size_t i = 2; i < part.count; ++i) {
        subpixel p = snapped[0], q = snapped[i - 1], r = snapped[i];
        const std::int64_t area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if (area == 0) continue;
        if (area < 0) std::swap(q, r);
        result.edges = {edge_between(p, q), edge_between(q, r), edge_between(r, p)};
        const subpixel low = glm::min(p, glm::min(q, r)), high = glm::max(p, glm::max(q, r));
        const glm::ivec2 last_pixel = glm::ivec2(view.size) - 1;
        result.first = glm::max(glm::ivec2(low >> subpixel(8)), glm::ivec2(0));
        result.last = glm::min(glm::ivec2(high >> subpixel(8)), last_pixel);
        if (result.first.x <= result.last.x && result.first.y <= result.last.y) out.push_back(result);
    }
}

std::vector<setup> set_up(const scene& world, const viewport& view, faces visible)
{
    tbb::enumerable_thread_specific<std::vector<setup>> local;
    for (std::uint32_t m = 0; m < world.meshes.size(); ++m)
        tbb::parallel_for(
            tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(world.meshes[m].triangles.size()), 256),
            [&](const auto& range) {
                for (std::uint32_t t = range.begin(); t < range.end(); ++t)
                    append_setups(world, {m, t}, view, visible, local.local());
            });
    std::vector<setup> all;
    for (const std::vector<setup>& some : local) all.insert(all.end(), some.begin(), some.end());
    return all;
}

// Setups by tile: those of tile i are members[first[i]] to members[first[i + 1] - 1].
struct tile_grid {
    int columns, rows;
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> members;
};

tile_grid sort_into_tiles(const std::vector<setup>& setups, int width, int height)
{
    tile_grid grid{(width + tile_size - 1) / tile_size, (height + tile_size - 1) / tile_size, {}, {}};
    const auto for_each_tile = [&](const setup& s, const auto& visit) {
        for (int row = s.first.y / tile_size; row <= s.last.y / tile_size; ++row)
            for (int column = s.first.x / tile_size; column <= s.last.x / tile_size; ++column)
                visit(static_cast<std::size_t>(row * grid.columns + column));
    };
    grid.first.assign(static_cast<std::size_t>(grid.columns * grid.rows) + 1, 0);
    for (const setup& s : setups) for_each_tile(s, [&](std::size_t tile) { ++grid.first[tile + 1]; });
    for (std::size_t i = 1; i < grid.first.size(); ++i) grid.first[i] += grid.first[i - 1];
    grid.members.resize(grid.first.back());
    std::vector<std::size_t> next = grid.first;
    for (std::uint32_t i = 0; i < setups.size(); ++i)
        for_each_tile(setups[i], [&](std::size_t tile) { grid.members[next[tile]++] = i; });
    return grid;
}

// Calls fragment(x, y, sample, q, id) for each sample that the setup covers between the pixels low and high.
template <int Samples, class Fragment>
void sample_setup(const setup& s, glm::ivec2 low, glm::ivec2 high, const Fragment& fragment)
{
    low = glm::max(low, s.first), high = glm::min(high, s.last);
    for (int y = low.y; y <= high.y; ++y)
        for (int sample = 0; sample < Samples; ++sample) {
            const glm::ivec2 offset =
                subpixels / 2 + subpixels / 16 * sample_offsets<Samples>[static_cast<std::size_t>(sample)];
            const subpixel start(low.x * subpixels + offset.x, y * subpixels + offset.y);
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

template <int Samples, class Fragment>
void rasterize(const scene& world, const viewport& view, faces visible, const Fragment& fragment)
{
    const int width = static_cast<int>(view.size.x), height = static_cast<int>(view.size.y);
    if (width < 1 || height < 1 || width > largest_extent || height > largest_extent)
        throw std::invalid_argument(
            fmt::format("rasterizer: {}x{} pixels, 1 to {} per side are possible", width, height, largest_extent));
    const std::vector<setup> setups = set_up(world, view, visible);
    const tile_grid grid = sort_into_tiles(setups, width, height);
    tbb::parallel_for(0, grid.columns * grid.rows, [&](int tile) {
        const glm::ivec2 low = tile_size * glm::ivec2(tile % grid.columns, tile / grid.columns);
        const auto index = static_cast<std::size_t>(tile);
        for (std::size_t i = grid.first[index]; i < grid.first[index + 1]; ++i)
            sample_setup<Samples>(setups[grid.members[i]], low, low + tile_size - 1, fragment);
    });
}

// A tile, cleared to the far plane and to an id behind all others.
struct visible_triangle {
    float depth = 1;
    triangle_id id{~0u, ~0u};

    bool found() const { return id.mesh != ~0u; }
    auto operator<=>(const visible_triangle&) const = default;
};

// Corner weights of a point in the triangle's plane.
glm::dvec3 barycentric(const triangle& shape, const glm::dvec3& point)
{
    const glm::dvec3 n = shape.normal();
    const auto weight = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return glm::dot(n, glm::cross(p - point, q - point)) / glm::dot(n, n);
    };
    const auto& [a, b, c] = shape.corners;
    return {weight(b, c), weight(c, a), weight(a, b)};
}

surface surface_at(const scene& world, const viewport& view, const visible_triangle& seen, const glm::dvec2& pixel)
{
    const mesh& part = world.meshes[seen.id.mesh];
    const triangle shape = triangle_of(world, seen.id);
    const distance_plane plane = view.plane_of(shape);
    const view_ray ray = ray_through(view.eye, pixel / view.size);
    // A grazing triangle's plane may miss the ray of the pixel that its snapped outline covers: stay on the triangle.
    glm::dvec2 range(1e300, -1e300);
    for (const glm::dvec3& corner : shape.corners) {
        const double distance = view_distance(view.eye, corner);
        range = {std::min(range.x, distance), std::max(range.y, distance)};
    }
    range = glm::clamp(range, view.eye.near_distance, view.eye.far_distance);
    const double q = plane.at(pixel.x, pixel.y);
    const double distance = std::clamp(view.eye.perspective() && q <= 0 ? range.y : view.distance(q), range.x, range.y);
    const glm::dvec3 position = ray.origin + distance * ray.direction;

    // position = origin + t direction, both affine in the pixel, and t = q or 1/q.
    const auto derivative = [&](const glm::dvec2& step, double dq) {
        const view_ray next = ray_through(view.eye, (pixel + step) / view.size);
        const double dt = view.eye.perspective() ? -dq * distance * distance : dq;
        return glm::vec3(next.origin - ray.origin + distance * (next.direction - ray.direction) + dt * ray.direction);
    };
    glm::dvec3 normal = glm::normalize(shape.normal());
    const double side = glm::dot(normal, ray.direction) > 0 ? -1 : 1;
    glm::dvec3 shading = normal;
    if (!part.normals.empty()) {
        const glm::dvec3 weights = glm::clamp(barycentric(shape, position), 0.0, 1.0);
        const glm::uvec3 index = part.triangles[seen.id.triangle];
        const glm::dvec3 sum = weights.x * glm::dvec3(part.normals[index.x]) +
                               weights.y * glm::dvec3(part.normals[index.y]) +
                               weights.z * glm::dvec3(part.normals[index.z]);
        if (glm::dot(sum, sum) > 0) shading = glm::normalize(sum);
    }
    return {static_cast<int>(seen.id.mesh), position, side * normal, side * shading, derivative({1, 0}, plane.b),
            derivative({0, 1}, plane.c)};
}

} // namespace

template <int Samples>
image<std::array<float, Samples>> rasterize_depth(const scene& world, const camera& eye, int width, int height,
                                                  faces visible)
{
    std::array<float, Samples> clear;
    clear.fill(1);
    image<std::array<float, Samples>> result(width, height, clear);
    const viewport view{eye, {width, height}};
    rasterize<Samples>(world, view, visible, [&](int x, int y, int sample, double q, triangle_id) {
        float& nearest = result(x, y)[static_cast<std::size_t>(sample)];
        nearest = std::min(nearest, static_cast<float>(linear_depth(eye, view.distance(q))));
    });
    return result;
}

template image<std::array<float, 1>> rasterize_depth<1>(const scene&, const camera&, int, int, faces);
template image<std::array<float, 4>> rasterize_depth<4>(const scene&, const camera&, int, int, faces);

image<surface> rasterize_surfaces(const scene& world, const camera& eye, int width, int height, faces visible)
{
    const viewport view{eye, {width, height}};
    image<visible_triangle> seen(width, height);
    rasterize<1>(world, view, visible, [&](int x, int y, int, double q, triangle_id id) {
        // At equal depths the lowest id wins, so that the order of threads does not count.
        const visible_triangle candidate{static_cast<float>(linear_depth(eye, view.distance(q))), id};
        if (candidate < seen(x, y)) seen(x, y) = candidate;
    });
    image<surface> result(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x)
            if (seen(x, y).found()) result(x, y) = surface_at(world, view, seen(x, y), {x + 0.5, y + 0.5});
    });
    return result;
}

} // namespace gnomon::renderer
