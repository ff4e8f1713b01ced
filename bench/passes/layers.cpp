// Layered maps of 512 x 512 texels of 4 samples on one core: conversion, per sample, against the plain map of the same
// samples and format, and against kernels sample by sample; look-ups of random receivers, and those of a map in which
// nothing moves against the same probes in a plain map.
#define GNOMON_BENCH_ARITHMETIC exact
#include "core/measure.hpp"
#include "passes/layered_quads.hpp"

#include <map>
#include <memory>
#include <tuple>

namespace gnomon::bench {

namespace {

using namespace test;

constexpr std::size_t side = 512, each = 4, receivers = 1024;

/// Motions of a scene.
enum class moving { nothing, squares, all };

/// A floor, four levels of squares, and a layered map of them.
template <class Format> class layer_work {
  public:
    using texel = typename Format::texel;
    static layer_work& get(const layer_settings& settings, moving what)
    {
        static std::map<std::tuple<std::size_t, std::size_t, std::size_t, moving>, std::unique_ptr<layer_work>> all;
        auto& w = all[{settings.tile, settings.layers, settings.division, what}];
        if (w == nullptr) w.reset(new layer_work(settings, what));
        return *w;
    }

    work convert()
    {
        return per_sample([this] { layers_.fill(samples_); });
    }
    work cluster()
    {
        return per_sample([this] { layer_cluster(samples_, layers_.settings, layers_.clusters, layers_.rows()); });
    }
    /// Clusters by the kernels, sample by sample.
    work cluster_by_kernels()
    {
        return per_sample([this] {
            const sample_map<float> samples = samples_;
            const std::size_t across = tiles_along(side, layers_.settings.tile);
            for (std::size_t i = 0; i < layers_.clusters.size(); ++i) {
                const auto w = detail::window_around(samples, layers_.settings, i % across, i / across);
                const auto for_each = [&](auto f) {
                    for (std::size_t y = w.y0; y < w.y1; ++y)
                        for (const auto& s : samples.of.subspan((y * side + w.x0) * each, (w.x1 - w.x0) * each))
                            f(layer_middle_depth(s));
                };
                layer_window<float> window = layer_window_begin(float(layer_background_depth));
                for_each([&](float z) { window = layer_window_add(window, z); });
                std::uint64_t occupied = 0;
                for_each([&](float z) {
                    const float bin = layer_bin_of(z, window);
                    occupied |= bin < 0 ? 0 : std::uint64_t(1) << unsigned(bin);
                });
                layer_runs<float> runs = layer_cuts_begin(window);
                for (int bin = 0; bin < 64; ++bin) runs = layer_cuts_add(runs, float(occupied >> bin & 1));
                cuts_[i] = layer_cuts_end(runs, 4.0f);
            }
        });
    }
    work plain_map()
    {
        return per_sample([this] {
            for (std::size_t i = 0; i < side * side; ++i) {
                format_channels<Format> sums{};
                for (std::size_t k = 0; k < each; ++k) sums = Format::add(sums, samples_.of[i * each + k].z, {1, 1});
                plain_[i] = Format::encode(sums);
            }
            build_mips<Format>({plain_, side, side});
        });
    }
    work look_up_in(layer_tiles tiles)
    {
        return per_receiver([this, tiles](const auto& r) { return layers_.intensity(r, {tiles}); });
    }
    /// The same probes, trilinear ones of a plain map.
    work look_up_plain()
    {
        return per_receiver([this](const layer_receiver<float>& r) {
            const layer_grid<float> grid = detail::plain_grid(float(side));
            const auto footprint =
                layer_footprint_make(grid, r.x0 - grid.middle, r.y0 - grid.middle, r.t0, r.x1 - grid.middle,
                                     r.y1 - grid.middle, r.t1, r.cross_x, r.cross_y, 0.0f);
            channel_array<Format> sums{};
            for (float k = 0; k < footprint.probes; ++k) {
                const layer_place<float> place = layer_probe(footprint, k);
                const auto c = gnomon_bit_cast<channel_array<Format>>(
                    trilinear<Format>({plain_, side, side}, place.u, place.v, footprint.level));
                for (std::size_t n = 0; n < c.size(); ++n) sums[n] += c[n];
            }
            const float bias = layer_bias(grid, r.slope, r.slope, r.t, layer_look_up{}.reach, layer_look_up{}.limit);
            return 1 - Format::visibility(gnomon_bit_cast<format_channels<Format>>(sums), r.z - bias,
                                          float(Format::least_variance));
        });
    }
    double bytes_over_plain()
    {
        return double(layer_bytes<const texel>(layers_.map())) / double(mip_texels(side, side) * sizeof(texel));
    }

  private:
    layer_work(const layer_settings& settings, moving what)
        : samples_(sample(what)),
          layers_(samples_, settings),
          cuts_(layers_.clusters.size()),
          plain_(mip_texels(side, side))
    {
        plain_map().run();
        bit_source bits(2);
        for (auto& r : receivers_) {
            r = still_receiver(float(bits.uniform(0, side)), float(bits.uniform(0, side)),
                               float(bits.uniform(-0.5, 0.95)), float(bits.uniform(0, 1)), bits);
            r.x1 += float(bits.uniform(0, 3)), r.cross_y = float(bits.uniform(0, 1.5));
        }
    }
    static sampled_quads sample(moving what)
    {
        bit_source bits(1);
        quad_scene scene{{0.8f, 0.0002f}, {}};
        for (int k = 0; k < 60; ++k)
            scene.quads.push_back({float(bits.uniform(0, side)), float(bits.uniform(0, side)), 18, 14,
                                   -0.6f + 0.3f * float(k / 15), float(bits.uniform(-20, 20)),
                                   float(bits.uniform(-9, 9)), 0.02f});
        if (what == moving::nothing) scene.quads.clear();
        sampled_quads samples = sample_quads(scene, side, side, each, bits);
        if (what == moving::all)
            for (auto& s : samples.of) s.d_x += 20 + 0.01f * s.x, s.d_y += 3;
        return samples;
    }
    template <class Run> work per_sample(Run run) { return {run, double(side * side * each)}; }
    template <class Look> work per_receiver(Look look)
    {
        return {[this, look] {
                    for (const auto& r : receivers_) {
                        float shadow = look(r);
                        asm volatile("" : : "r"(&shadow) : "memory");
                    }
                },
                double(receivers)};
    }

    sampled_quads samples_;
    layers_of<Format> layers_;
    std::vector<layer_cuts<float>> cuts_;
    std::vector<texel> plain_;
    std::array<layer_receiver<float>, receivers> receivers_;
};

const layer_settings quality{}, speed{8, 16, 16};

template <class Format> bool add_conversions()
{
    const auto add = [](const std::string& what, const layer_settings& s, moving m) {
        return add_comparison(
            ("layers/" + std::string(Format::id) + "/convert, " + what + " against the plain map").c_str(),
            [=] { return layer_work<Format>::get(s, m).convert(); },
            [=] { return layer_work<Format>::get(s, m).plain_map(); });
    };
    return add("tiles of 4, all moves", quality, moving::all) && add("tiles of 8, all moves", speed, moving::all) &&
           add("tiles of 4, squares move", quality, moving::squares) &&
           add("tiles of 8, squares move", speed, moving::squares) &&
           add("tiles of 4, nothing moves", quality, moving::nothing);
}

bool add_look_ups()
{
    using w = layer_work<layer_variance_float>;
    const auto add = [](const char* what, auto measured, auto baseline) {
        return add_comparison(("layers/" + std::string(what)).c_str(), measured, baseline);
    };
    const auto of = [](moving what, layer_tiles tiles) {
        return [=] { return w::get(quality, what).look_up_in(tiles); };
    };
    const auto converted = [](std::size_t division) {
        return [=] { return w::get({.layers = 2, .division = division}, moving::squares).convert(); };
    };
    return add("convert, divided by motion against whole layers", converted(8), converted(0)) &&
           add("look up where nothing moves against a plain map", of(moving::nothing, layer_tiles::random),
               [] { return w::get(quality, moving::nothing).look_up_plain(); }) &&
           add("look up where all moves against a plain map", of(moving::all, layer_tiles::random),
               [] { return w::get(quality, moving::nothing).look_up_plain(); }) &&
           add("look up blended tiles against one at random", of(moving::all, layer_tiles::blended),
               of(moving::all, layer_tiles::random)) &&
           add(
               "cluster against kernels sample by sample", [] { return w::get(quality, moving::all).cluster(); },
               [] { return w::get(quality, moving::all).cluster_by_kernels(); });
}

[[maybe_unused]] const bool registered =
    add_conversions<layer_variance_float>() && add_conversions<layer_variance_half>() &&
    add_conversions<layer_moments4_float>() && add_conversions<layer_exponential_float>() && add_look_ups();

} // namespace

} // namespace gnomon::bench
