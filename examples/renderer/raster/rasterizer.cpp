#include "rasterizer.hpp"

#include "coverage.hpp"
#include "surface_at.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <compare>

namespace gnomon::renderer {

using namespace coverage;

namespace {

// A tile, cleared to the far plane and to an id behind all others.
struct visible_triangle {
    float depth = 1;
    triangle_id id{~0u, ~0u};

    bool found() const { return id.mesh != ~0u; }
    auto operator<=>(const visible_triangle&) const = default;
};

} // namespace

template <int Samples>
image<std::array<float, Samples>> rasterize_depth(const scene& world, const camera& eye, int width, int height,
                                                  faces visible)
{
    const viewport view(eye, width, height);
    std::array<float, Samples> clear;
    clear.fill(1);
    image<std::array<float, Samples>> result(width, height, clear);
    rasterize<Samples>(world, view, visible, [&](int x, int y, int sample, double q, triangle_id) {
        float& nearest = result(x, y)[static_cast<std::size_t>(sample)];
        nearest = std::min(nearest, view.depth(q));
    });
    return result;
}

template image<std::array<float, 1>> rasterize_depth<1>(const scene&, const camera&, int, int, faces);
template image<std::array<float, 4>> rasterize_depth<4>(const scene&, const camera&, int, int, faces);

image<surface> rasterize_surfaces(const scene& world, const camera& eye, int width, int height, faces visible)
{
    const viewport view(eye, width, height);
    image<visible_triangle> seen(width, height);
    rasterize<1>(world, view, visible, [&](int x, int y, int, double q, triangle_id id) {
        // At equal depths the lowest id wins, so that the order of threads does not count.
        const visible_triangle candidate{view.depth(q), id};
        if (candidate < seen(x, y)) seen(x, y) = candidate;
    });
    image<surface> result(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        for (int x = 0; x < width; ++x)
            if (seen(x, y).found()) result(x, y) = surface_at(world, view, seen(x, y).id, {x + 0.5, y + 0.5});
    });
    return result;
}

} // namespace gnomon::renderer
