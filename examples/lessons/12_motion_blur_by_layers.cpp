// How do a few samples in time become the smooth shadow of something that moves?
//
// The light has four samples for each texel of its map, each at a time of its own, and the camera has four for each pixel.
// To compare one of these with one of those makes noise. But surfaces that are near in depth often move alike: so the
// samples of a tile are parted by depth into layers, and those of a layer are moved along their mean motion to the middle of
// the shutter interval, where they can be filtered like any shadow map. A look-up moves a sample of the camera there, too.
#include "renderer/raster/moving_samples.hpp"
#include "renderer/scene/layered_stages.hpp"
#include "renderer/shade/moving_view.hpp"
#include "renderer/shade/receivers.hpp"

#include <gnomon/passes/layers/layer_accumulate.hpp>
#include <gnomon/passes/layers/layer_look_up.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace gnomon::renderer;
using format = gnomon::layer_variance_float; // two moments of depth, opacity and weight

constexpr int width = 960, height = 540, side = 512, samples = 4; // of both

int main()
{
    const moving_stage scenery = tentacles(double(width) / height, false);
    const moving_camera &light = scenery.light, &eye = scenery.eye;
    const sample_picture seen_by_light = rasterize_samples(scenery.world, light, side, side, {samples});
    const gnomon::sample_map<float> map = seen_by_light.map();

    // 1. Find the layers of each tile of the map, and how much memory they take: hardly any tile needs four.
    const gnomon::layer_settings settings; // tiles of 4 texels, in windows of 12, have layers of 8
    const std::size_t tiles = gnomon::tiles_along(side, settings.tile);
    std::vector<gnomon::tile_clusters> clusters(tiles * tiles);
    gnomon::layer_cluster(map, settings, clusters, {0, tiles});
    std::vector<std::uint32_t> first(tiles * tiles + 1),
        blocks(gnomon::tiles_along(side, gnomon::layer_block) * gnomon::tiles_along(side, gnomon::layer_block));
    const auto counts = gnomon::layer_allocate(settings, clusters, side, side, first, blocks);
    std::printf("%zu layers in %zu tiles\n", counts.layers, clusters.size());

    // 2. Move the samples of each layer to the middle of the shutter interval and add them up. Mips filter wider.
    std::vector<gnomon::layer_grid<float>> grids(counts.layers);
    std::vector<format::texel> texels(counts.layers * gnomon::layer_texels(settings));
    std::vector<format::texel> plain(counts.blocks * gnomon::block_texels(settings)); // of tiles that do not move
    const gnomon::layer_map<format::texel> layers{side, side, settings, first, blocks, grids, texels, plain};
    gnomon::layer_accumulate<format>(map, clusters, layers, {0, tiles});
    gnomon::layer_mips<format>(layers, {0, tiles});

    // 3. Look up the samples of the camera. Each stands for a part of the time, while which its point is held in view.
    const seen_motion seen = stochastic_visibility(scenery.world, eye, width, height, samples);
    std::vector<float> visibility;
    for (const seen_segment& s : seen.segments) {
        const auto place = [&](float t, const glm::dvec3& point) {
            const glm::dvec4 p = texel_space(light.at(double(t)), glm::dvec2(side), point); // x w, y w, depth, w
            return glm::vec3(p.x / p.w, p.y / p.w, p.z);
        };
        const auto held = [&](float t) { return place(t, glm::dvec3(s.p0) + double(t - s.t0) * eye.motion); };
        const float t0 = std::max(s.t0 - 0.5f / samples, 0.0f), t1 = std::min(s.t0 + 0.5f / samples, 1.0f);
        const auto slope = float(plane_slope(s.p0, s.n0, light.at(double(s.t0)), side));
        const glm::vec3 at = place(s.t0, s.p0), begin = held(t0), end = held(t1);
        // The place; the ends of the footprint, and its width, a texel; the slope, for the bias of the look-up.
        // clang-format off
        const gnomon::layer_receiver<float> receiver{at.x, at.y, at.z, s.t0, begin.x, begin.y, t0,
                                                     end.x, end.y, t1, 0, 1, slope, 0, 0};
        // clang-format on
        const float intensity =
            gnomon::layer_intensity<format>(layers, receiver, {.tiles = gnomon::layer_tiles::blended});
        const bool lit = glm::dot(direction_towards(light.at(double(s.t0)), s.p0), glm::dvec3(s.n0)) > 0;
        visibility.push_back(lit ? 1 - intensity : 0);
    }
    write_png("out/lessons/12_motion_blur_by_layers.png", shade(scenery.world, light, seen, visibility));
}
