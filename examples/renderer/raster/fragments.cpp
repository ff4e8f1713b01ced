#include "fragments.hpp"

#include "coverage.hpp"
#include "surface_at.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <compare>
#include <utility>

namespace gnomon::renderer {

using namespace coverage;

namespace {

struct crossing {
    float depth;
    triangle_id id;
    glm::vec3 opacity;

    friend bool operator<(const crossing& a, const crossing& b)
    {
        return std::pair(a.depth, a.id) < std::pair(b.depth, b.id);
    }
};

// The crossings of pixel i, from back to front: first[i] to first[i + 1] - 1.
struct crossings {
    std::vector<std::uint32_t> first;
    std::vector<crossing> all;
};

glm::dvec2 centre(int x, int y) { return {x + 0.5, y + 0.5}; }

crossings translucent_crossings(const scene& world, const viewport& view, faces visible)
{
    const int width = static_cast<int>(view.size.x), height = static_cast<int>(view.size.y);
    const auto nearest = rasterize_depth<1>(opaque_part(world), view.eye, width, height, visible);
    // A tile is drawn by one thread at a time, and has a list of its own.
    struct found {
        std::uint32_t pixel;
        crossing at;
    };
    const int columns = (width + tile_size - 1) / tile_size, rows = (height + tile_size - 1) / tile_size;
    std::vector<std::vector<found>> tiles(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    rasterize<1>(translucent_part(world), view, visible, [&](int x, int y, int, double q, triangle_id id) {
        const float depth = view.depth(q);
        if (!(depth < nearest(x, y)[0])) return;
        const glm::vec3 opacity = opacity_at(world, view, id, centre(x, y));
        if (opacity == glm::vec3(0)) return;
        tiles[static_cast<std::size_t>(y / tile_size * columns + x / tile_size)].push_back(
            {static_cast<std::uint32_t>(y * width + x), {depth, id, opacity}});
    });

    crossings result{std::vector<std::uint32_t>(nearest.pixels.size() + 1, 0), {}};
    for (const auto& tile : tiles)
        for (const found& f : tile) ++result.first[f.pixel + 1];
    for (std::size_t i = 1; i < result.first.size(); ++i) result.first[i] += result.first[i - 1];
    result.all.resize(result.first.back());
    tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t tile) {
        std::ranges::sort(tiles[tile], [](const found& a, const found& b) {
            return a.pixel != b.pixel ? a.pixel < b.pixel : b.at < a.at;
        });
        std::uint32_t pixel = ~0u, next = 0;
        for (const found& f : tiles[tile]) {
            if (f.pixel != std::exchange(pixel, f.pixel)) next = result.first[pixel];
            result.all[next++] = f.at;
        }
    });
    return result;
}

} // namespace

fragment_map rasterize_fragments(const scene& world, const camera& eye, int width, int height, faces visible)
{
    crossings found = translucent_crossings(world, viewport(eye, width, height), visible);
    fragment_map result{width, height, std::move(found.first), std::vector<fragment>(found.all.size())};
    std::ranges::transform(found.all, result.fragments.begin(), [](const crossing& c) {
        return fragment{c.depth, c.opacity, static_cast<int>(c.id.mesh)};
    });
    return result;
}

surface_layers rasterize_surface_layers(const scene& world, const camera& eye, int width, int height, faces visible)
{
    const viewport view(eye, width, height);
    const crossings found = translucent_crossings(world, view, visible);
    surface_layers result{rasterize_surfaces(opaque_part(world), eye, width, height, visible), found.first,
                          std::vector<surface>(found.all.size()), std::vector<glm::vec3>(found.all.size())};
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const auto pixel = static_cast<std::size_t>(y * width + x);
            for (std::size_t i = found.first[pixel]; i < found.first[pixel + 1]; ++i) {
                result.layers[i] = surface_at(world, view, found.all[i].id, centre(x, y));
                result.opacities[i] = found.all[i].opacity;
            }
        }
    });
    return result;
}

} // namespace gnomon::renderer
