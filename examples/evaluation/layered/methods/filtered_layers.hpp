// Layered filtered shadow maps (Andersson et al. 2015): a method is a storage format of layers, and settings. Parameters
// and what they are where none is given, as in the paper for maps of 512 x 512 texels:
//
//     scale 1       side of the map over the usual one
//     samples 4     for each texel
//     even_times 0  1: samples whose times fill their strata evenly over neighbouring texels
//     tile 4, guard 12, texels 8, layers 4, even 1, v_filter 1, division 0, centres 0   layer_settings
//     neighbour 1   0: the tile of the receiver alone, 1: it or a neighbour at random, 2: all of these, blended
//     widen 0       1: by the spread of motion in a layer
//     limit         the largest bias of a slope
#pragma once

#include "evaluation/core/timing.hpp"
#include "evaluation/layered/layered_method.hpp"

#include <gnomon/passes/layers/layer_accumulate.hpp>
#include <gnomon/passes/layers/layer_look_up.hpp>

#include <algorithm>

namespace gnomon::evaluation {

inline layer_settings layer_settings_of(const parameters& how)
{
    const auto size = [&](const char* name, std::size_t usual) {
        return std::size_t(value_of(how, name, double(usual)));
    };
    layer_settings result;
    result.tile = size("tile", result.tile), result.guard = size("guard", result.guard);
    result.texels = size("texels", result.texels), result.layers = size("layers", result.layers);
    result.even = value_of(how, "even", 1) != 0;
    result.smooth_streaks = value_of(how, "v_filter", 1) != 0;
    result.division = size("division", result.division);
    result.centres = value_of(how, "centres", 0) != 0;
    return result;
}

inline layer_look_up layer_look_up_of(const parameters& how)
{
    layer_look_up result;
    result.tiles = layer_tiles(int(value_of(how, "neighbour", 1)));
    result.widen = value_of(how, "widen", 0) != 0;
    result.limit = float(value_of(how, "limit", double(result.limit)));
    return result;
}

// The second axis of the footprint is that of the pixel's two which is longer across the first.
inline layer_receiver<float> layer_receiver_of(const stochastic_receiver& r)
{
    const float x = r.x1 - r.x0, y = r.y1 - r.y0, square = x * x + y * y;
    const auto across = [&](float a, float b) {
        const float along = a * x + b * y;
        return a * a + b * b - (square > 0 ? along * along / square : 0);
    };
    const bool right = across(r.right_x, r.right_y) > across(r.down_x, r.down_y);
    return {.x = r.x,
            .y = r.y,
            .z = r.depth,
            .t = r.t,
            .x0 = r.x0,
            .y0 = r.y0,
            .t0 = r.t0,
            .x1 = r.x1,
            .y1 = r.y1,
            .t1 = r.t1,
            .cross_x = right ? r.right_x : r.down_x,
            .cross_y = right ? r.right_y : r.down_y,
            .slope = r.slope,
            .random_x = r.choice_x,
            .random_y = r.choice_y};
}

template <layer_format Format> class filtered_layers_map final : public layered_map {
  public:
    filtered_layers_map(const timed_samples& samples, const parameters& how)
        : settings_(layer_settings_of(how)), look_up_(layer_look_up_of(how))
    {
        resolution = samples.of.width;
        sampling_ms = samples.sampling_ms;
        const sample_map<float> map = samples.of.map();
        const std::size_t rows = tiles_along(map.height, settings_.tile),
                          tiles = tiles_along(map.width, settings_.tile) * rows;
        std::vector<tile_clusters> clusters(tiles);
        first_.resize(tiles + 1);
        blocks_.resize(tiles_along(map.width, layer_block) * tiles_along(map.height, layer_block));
        layer_counts counts;
        conversion_ms = 1e3 * seconds_on_one_core([&] {
                            layer_cluster(map, settings_, clusters, {0, rows});
                            counts = layer_allocate(settings_, clusters, map.width, map.height, first_, blocks_);
                        });
        grids_.resize(counts.layers);
        texels_.resize(counts.layers * layer_texels(settings_));
        plain_.resize(counts.blocks * block_texels(settings_));
        const layer_map<texel> to{map.width, map.height, settings_, first_, blocks_, grids_, texels_, plain_};
        conversion_ms += 1e3 * seconds_on_one_core([&] {
                             layer_accumulate<Format>(map, clusters, to, {0, rows});
                             layer_mips<Format>(to, {0, rows});
                         });
        const auto plain = std::ranges::count_if(clusters, [](const tile_clusters& c) { return is_plain(c); });
        facts = {{"layers_per_tile", double(counts.layers) / double(tiles)},
                 {"plain_tiles", double(plain) / double(tiles)}};
    }

    std::size_t bytes() const override { return layer_bytes(map()); }

    void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const override
    {
        const layer_map<const texel> all = map();
        for (std::size_t i = 0; i < where.size(); ++i)
            result[i] = 1 - layer_intensity<Format>(all, layer_receiver_of(where[i]), look_up_);
    }

    shutter_exposure<float> averaged(const stochastic_receiver& r) const override { return {r.t0, r.t1}; }

  private:
    using texel = format_texel<Format>;

    layer_map<const texel> map() const
    {
        const auto size = std::size_t(resolution);
        return {size, size, settings_, first_, blocks_, grids_, texels_, plain_};
    }

    layer_settings settings_;
    layer_look_up look_up_;
    std::vector<std::uint32_t> first_, blocks_;
    std::vector<layer_grid<float>> grids_;
    std::vector<texel> texels_, plain_;
};

// Facts of a method whose layers have this format.
template <layer_format Format> method_facts facts_of_layers(method_facts facts)
{
    facts.map = layers_kind->id;
    facts.format = {std::string(Format::id), std::string(Format::name)}; // tiles differ in their layers
    return facts;
}

template <layer_format Format> class filtered_layers final : public layered_method {
  public:
    filtered_layers(method_facts facts, std::vector<layered_variant> its_variants)
        : layered_method(facts_of_layers<Format>(std::move(facts)), std::move(its_variants))
    {}

    std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const override
    {
        using enum renderer::sample_pattern;
        const timed_samples& samples =
            from.samples(int(value_of(how, "samples", 4)), int(value_of(how, "scale", 1) * from.resolution),
                         value_of(how, "even_times", 0) != 0 ? even : stratified);
        return std::make_unique<filtered_layers_map<Format>>(samples, how);
    }
};

} // namespace gnomon::evaluation
