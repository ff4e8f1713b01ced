// Rectangles that move in straight lines over a floor, sampled at random as a light sees them, and layered maps of the
// samples with all their memory.
#pragma once

#include "support/hostile.hpp"

#include <gnomon/passes/layers/layer_accumulate.hpp>
#include <gnomon/passes/layers/layer_look_up.hpp>

#include <vector>

namespace gnomon::test {

/// A rectangle around (x, y) at time 1/2, of half extents a and b and depth z, which moves by (d_x, d_y, d_z) in all.
struct moving_quad {
    float x, y, a, b, z, d_x, d_y, d_z;

    bool covers(float at_x, float at_y, float t) const
    {
        return std::abs(at_x - x - d_x * (t - 0.5f)) < a && std::abs(at_y - y - d_y * (t - 0.5f)) < b;
    }
    float depth(float t) const { return z + d_z * (t - 0.5f); }
};

/// A static floor of this depth at (0, 0) and this slope along x.
struct flat_floor {
    float z, slope;
};

struct quad_scene {
    flat_floor floor;
    std::vector<moving_quad> quads; // from near to far

    bool is_covered(float x, float y, float t, float z) const
    {
        for (const moving_quad& q : quads)
            if (q.depth(t) < z && q.covers(x, y, t)) return true;
        return false;
    }
    stochastic_sample<float> sample(float x, float y, float t) const
    {
        for (std::size_t k = 0; k < quads.size(); ++k) {
            const moving_quad& q = quads[k];
            if (q.covers(x, y, t)) return {x, y, t, q.depth(t), q.d_x, q.d_y, q.d_z, float(k)};
        }
        return {x, y, t, floor.z + floor.slope * x, 0, 0, 0, float(quads.size())};
    }
};

struct sampled_quads {
    std::size_t width, height, each;
    std::vector<stochastic_sample<float>> of;
    operator sample_map<float>() const { return {width, height, each, of}; }
};

inline sampled_quads sample_quads(const quad_scene& scene, std::size_t width, std::size_t height, std::size_t each,
                                  bit_source& bits)
{
    sampled_quads s{width, height, each, {}};
    const auto random = [&] { return float(bits.uniform(0, 1)); };
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t k = 0; k < each; ++k)
                s.of.push_back(scene.sample(float(x) + random(), float(y) + random(),
                                            stratified_time(float(k), float(each), random())));
    return s;
}

/// A layered map with its memory.
template <class Format> struct layers_of {
    using texel = typename Format::texel;
    std::size_t width, height;
    layer_settings settings;
    std::vector<tile_clusters> clusters;
    std::vector<std::uint32_t> first, blocks;
    layer_counts counts;
    std::vector<layer_grid<float>> grids;
    std::vector<texel> texels, plain;

    layers_of(const sample_map<float>& samples, const layer_settings& s)
        : width(samples.width),
          height(samples.height),
          settings(s),
          clusters(tiles_along(width, s.tile) * tiles_along(height, s.tile)),
          first(clusters.size() + 1),
          blocks(tiles_along(width, layer_block) * tiles_along(height, layer_block))
    {
        fill(samples);
    }
    row_range rows() const { return {0, tiles_along(height, settings.tile)}; }
    void fill(const sample_map<float>& samples)
    {
        layer_cluster(samples, settings, clusters, rows());
        counts = layer_allocate(settings, clusters, width, height, first, blocks);
        grids.resize(counts.layers);
        texels.resize(counts.layers * layer_texels(settings));
        plain.resize(counts.blocks * block_texels(settings));
        layer_accumulate<Format>(samples, clusters, map(), rows());
        layer_mips<Format>(map(), rows());
    }
    layer_map<texel> map() { return {width, height, settings, first, blocks, grids, texels, plain}; }
    float intensity(const layer_receiver<float>& r, const layer_look_up& look_up = {}) const
    {
        const layer_map<const texel> m{width, height, settings, first, blocks, grids, texels, plain};
        return layer_intensity<Format>(m, r, look_up);
    }
};

/// A receiver that does not move on the map, at time t, with a footprint over 1/4 of the shutter interval.
inline layer_receiver<float> still_receiver(float x, float y, float z, float t, bit_source& bits)
{
    const float random_x = float(bits.uniform(0, 1)), random_y = float(bits.uniform(0, 1));
    return {x, y, z, t,        x,       y, (std::max)(t - 0.125f, 0.0f), x, y, (std::min)(t + 0.125f, 1.0f),
            0, 0, 0, random_x, random_y};
}

} // namespace gnomon::test
