#include "coverage.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>

#include <cmath>
#include <stdexcept>

namespace gnomon::renderer::coverage {

namespace {

constexpr int largest_extent = 1 << 14; // pixels; with the guard band below, edge functions stay under 2^52
constexpr double guard_band = 1 << 15;  // pixels beyond which triangles are clipped

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

} // namespace

viewport::viewport(const camera& from, int width, int height) : eye(from), size(width, height)
{
    if (width < 1 || height < 1 || width > largest_extent || height > largest_extent)
        throw std::invalid_argument(
            fmt::format("rasterizer: {}x{} pixels, 1 to {} per side are possible", width, height, largest_extent));
}

glm::dvec4 viewport::clip_space(const glm::dvec3& point) const
{
    const double distance = view_distance(eye, point), weight = eye.perspective() ? distance : 1;
    const glm::dvec3 offset = point - eye.position;
    const glm::dvec2 ndc = glm::dvec2(glm::dot(offset, eye.right), -glm::dot(offset, eye.up)) / eye.half_extent;
    return {0.5 * ndc * size, distance, weight};
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

tile_grid sort_into_tiles(const std::vector<setup>& setups, const viewport& view)
{
    const int width = static_cast<int>(view.size.x), height = static_cast<int>(view.size.y);
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

} // namespace gnomon::renderer::coverage
