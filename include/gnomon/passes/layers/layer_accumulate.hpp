// Sums of samples in the texels of layers, and in those of the plain map, and their mips. Rows of tiles write texels of
// their own, so that threads may share the rows.
#ifndef GNOMON_PASSES_LAYER_ACCUMULATE_HPP
#define GNOMON_PASSES_LAYER_ACCUMULATE_HPP

#include "../../motion/layers/layer_look_up.h"
#include "layer_cluster.hpp"

GNOMON_NAMESPACE_BEGIN

namespace detail {

template <layer_format Format>
using square_sums = std::array<format_channels<Format>, layer_most_texels * layer_most_texels + 1>;

/// Divide sums by the share of the shutter interval in which the samples of a texel are in the window, at least 1/8.
template <layer_format Format>
void even_out(square_sums<Format>& sums, std::size_t side, const layer_grid<float>& g, const tile_window& w)
{
    const float reach = 0.5f * (g.motion + 1 / g.scale_u);
    for (std::size_t j = 0; j < side; ++j) {
        const float across = (float(j) + 0.5f - g.middle) / g.scale_v;
        float from = -HUGE_VALF, to = HUGE_VALF;
        const auto clip = [&](float axis, float place, float low, float high) {
            if (std::fabs(axis) < 1e-6f) {
                if (!(low <= place && place <= high)) to = from;
                return;
            }
            const float a = (low - place) / axis, b = (high - place) / axis;
            from = std::fmax(from, std::fmin(a, b));
            to = std::fmin(to, std::fmax(a, b));
        };
        clip(g.axis_x, -g.axis_y * across, float(w.x0) - w.x, float(w.x1) - w.x);
        clip(g.axis_y, g.axis_x * across, float(w.y0) - w.y, float(w.y1) - w.y);
        for (std::size_t i = 0; i < side; ++i) {
            const float along = (float(i) + 0.5f - g.middle) / g.scale_u;
            const float seen = std::fmin(to, along + reach) - std::fmax(from, along - reach);
            const float factor = 1 / std::fmax(seen / (2 * reach), 0.125f);
            auto c = gnomon_bit_cast<channel_array<Format>>(sums[j * side + i]);
            for (float& n : c) n *= factor;
            sums[j * side + i] = gnomon_bit_cast<format_channels<Format>>(c);
        }
    }
}

/// Blur sums across the motion of a layer, by a tent.
template <layer_format Format> void blur_across(square_sums<Format>& sums, std::size_t side, float radius)
{
    using numbers = channel_array<Format>;
    const std::size_t reach = (std::min)(std::size_t(radius), side - 1);
    std::array<float, layer_most_texels> weights;
    float total = 0;
    for (std::size_t k = 0; k <= reach; ++k) {
        weights[k] = layer_tent_weight(float(k), radius);
        total += k == 0 ? weights[k] : 2 * weights[k];
    }
    for (std::size_t u = 0; u < side; ++u) {
        std::array<numbers, layer_most_texels> column{};
        for (std::size_t v = 0; v < side; ++v)
            for (std::size_t to = v - (std::min)(v, reach); to <= (std::min)(v + reach, side - 1); ++to) {
                const auto from = gnomon_bit_cast<numbers>(sums[v * side + u]);
                const float weight = weights[to < v ? v - to : to - v] / total;
                for (std::size_t c = 0; c < from.size(); ++c) column[to][c] += weight * from[c];
            }
        for (std::size_t v = 0; v < side; ++v) sums[v * side + u] = gnomon_bit_cast<format_channels<Format>>(column[v]);
    }
}

/// Fill the largest level of one layer.
template <layer_format Format>
void accumulate_layer(window_samples& samples, const layer_settings& settings, const tile_window& w, const auto& layer,
                      const layer_grid<float>& grid, format_texel<Format>* texels)
{
    const std::size_t side = settings.texels;
    square_sums<Format> sums;
    std::fill_n(sums.begin(), side * side + 1, format_channels<Format>{}); // the last for samples that do not count
    samples.for_each_batch([&](const sample_batch& s) {
        std::array<std::int32_t, sample_batch::most> texel;
        std::array<float, sample_batch::most> depth, opacity;
        for (std::size_t k = 0; k < s.rounded(); ++k) {
            const layer_place<float> place = layer_grid_place(grid, s.x[k], s.y[k], s.t[k]);
            const layer_share<float> share = layer.share(s, k);
            const float extent = float(side);
            const unsigned u_inside = unsigned(0 <= place.u) & unsigned(place.u < extent);
            const unsigned v_inside = unsigned(0 <= place.v) & unsigned(place.v < extent);
            const bool counts = (u_inside & v_inside & unsigned(0 < share.weight)) != 0;
            const auto u = std::int32_t(counts ? place.u : 0), v = std::int32_t(counts ? place.v : extent);
            texel[k] = v * std::int32_t(side) + u;
            depth[k] = layer_grid_own_depth(grid, s.z[k], s.t[k]);
            opacity[k] = share.opacity;
        }
        for (std::size_t k = 0; k < s.count; ++k) {
            format_channels<Format>& to = sums[std::size_t(texel[k])];
            to = Format::add(to, depth[k], {opacity[k], 1});
        }
    });
    if (settings.even) even_out<Format>(sums, side, grid, w);
    if (settings.smooth_streaks) {
        const float radius = layer_tent_radius(grid, float(settings.guard), float(settings.tile));
        if (radius > 1) blur_across<Format>(sums, side, radius);
    }
    for (std::size_t i = 0; i < side * side; ++i) texels[i] = Format::encode(sums[i]);
}

/// Fill the largest level of a block of the plain map.
template <layer_format Format>
void accumulate_block(const sample_map<float>& samples, std::size_t x0, std::size_t y0, format_texel<Format>* texels)
{
    for (std::size_t n = 0; n < layer_block * layer_block; ++n) {
        const std::size_t x = x0 + n % layer_block, y = y0 + n / layer_block;
        format_channels<Format> sums{};
        if (x < samples.width && y < samples.height)
            for (const stochastic_sample<float>& s : samples(x, y))
                sums = Format::add(sums, s.z, layer_share_of(layer_of(layer_middle_depth(s), no_cuts()), 0.0f));
        texels[n] = Format::encode(sums);
    }
}

/// Call f(x, y, texels) with the first place and the texels of all stored blocks whose first row is in the given rows of tiles.
template <class Texel> void for_each_block(const layer_map<Texel>& map, row_range rows, const auto& f)
{
    const std::size_t columns = tiles_along(map.width, layer_block), down = tiles_along(map.height, layer_block);
    const auto block_row = [&](std::size_t row) {
        return (std::min)(tiles_along(row * map.settings.tile, layer_block), down);
    };
    for (std::size_t i = block_row(rows.first) * columns; i < block_row(rows.last) * columns; ++i)
        if (map.blocks[i] != layer_no_block)
            f(i % columns * layer_block, i / columns * layer_block,
              map.plain.data() + map.blocks[i] * block_texels(map.settings));
}

/// Check that a map is for these samples.
template <class Texel>
void expect_samples(std::string_view pass, const sample_map<float>& samples, const layer_map<Texel>& map)
{
    check_shape(samples, pass);
    check_shape(map, pass);
    GNOMON_EXPECTS(samples.width == map.width, mismatch(pass, "samples.width", samples.width, "map.width", map.width));
    GNOMON_EXPECTS(samples.height == map.height,
                   mismatch(pass, "samples.height", samples.height, "map.height", map.height));
}

} // namespace detail

/// Fill the grids of the layers of the given rows of tiles, and the largest level of these and of the blocks that begin in
/// these rows. clusters are those of the same samples by layer_cluster, for all tiles; map has the tables of layer_allocate.
/// NaN: samples with a NaN in depth, time or motion are left out.
/// Source: Andersson 2015, Sec. 4.1
template <layer_format Format>
void layer_accumulate(const sample_map<float>& samples, std::span<const tile_clusters> clusters,
                      const layer_map<format_texel<Format>>& map, row_range rows)
{
    constexpr std::string_view pass = "layer_accumulate";
    detail::expect_samples(pass, samples, map);
    GNOMON_EXPECTS(clusters.size() + 1 == map.first.size(),
                   mismatch(pass, "clusters.size() + 1", clusters.size() + 1, "map.first.size()", map.first.size()));
    detail::expect_tile_rows(pass, rows, map.rows());
    for (std::size_t i = rows.first * map.columns(); i < rows.last * map.columns(); ++i) {
        const std::size_t count = map.first[i + 1] - map.first[i];
        const std::size_t layers = is_plain(clusters[i]) ? 0 : clusters[i].layers;
        GNOMON_EXPECTS(count == layers, mismatch(pass, "layers of a tile in map", count, "in clusters", layers));
    }
    const std::size_t each = layer_texels(map.settings);
    for (std::size_t i = rows.first * map.columns(); i < rows.last * map.columns(); ++i) {
        const std::size_t first = map.first[i], count = map.first[i + 1] - first;
        if (count == 0) continue;
        const detail::tile_window w =
            detail::window_around(samples, map.settings, i % map.columns(), i / map.columns());
        detail::window_samples in(samples, w);
        std::size_t n = first;
        for_each_layer(clusters[i], [&](const auto& layer) {
            map.grids[n] =
                layer_grid_make(detail::motion_of(in, layer), float(map.settings.guard), float(map.settings.texels));
            detail::accumulate_layer<Format>(in, map.settings, w, layer, map.grids[n], map.texels.data() + n * each);
            ++n;
        });
    }
    detail::for_each_block(map, rows, [&](std::size_t x, std::size_t y, format_texel<Format>* texels) {
        detail::accumulate_block<Format>(samples, x, y, texels);
    });
}

namespace detail {

/// Fill the smaller levels of a square.
template <layer_format Format>
void build_square_mips(format_texel<Format>* texels, std::size_t side, std::size_t levels)
{
    for (std::size_t level = 1; level < levels; ++level) {
        const format_texel<Format>* const from = texels + square_mip_begin(side, level - 1);
        format_texel<Format>* const to = texels + square_mip_begin(side, level);
        const std::size_t extent = side >> level;
        for (std::size_t y = 0; y < extent; ++y)
            for (std::size_t x = 0; x < extent; ++x) {
                channel_array<Format> sum{};
                for (const std::size_t k : {std::size_t(0), std::size_t(1), 2 * extent, 2 * extent + 1}) {
                    const auto c = load_channels<Format>(from[4 * y * extent + 2 * x + k]);
                    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += 0.25f * c[n];
                }
                to[y * extent + x] = store_channels<Format>(sum);
            }
    }
}

} // namespace detail

/// Fill the smaller levels of the layers of the given rows of tiles, and of the blocks that begin in these rows, from those
/// of layer_accumulate. A texel is the mean of four.
template <layer_format Format> void layer_mips(const layer_map<format_texel<Format>>& map, row_range rows)
{
    constexpr std::string_view pass = "layer_mips";
    check_shape(map, pass);
    detail::expect_tile_rows(pass, rows, map.rows());
    const std::size_t side = map.settings.texels;
    for (std::size_t n = map.first[rows.first * map.columns()]; n < map.first[rows.last * map.columns()]; ++n)
        detail::build_square_mips<Format>(map.texels.data() + n * layer_texels(map.settings), side,
                                          mip_levels(side, side));
    detail::for_each_block(map, rows, [&](std::size_t, std::size_t, format_texel<Format>* texels) {
        detail::build_square_mips<Format>(texels, layer_block, block_levels(map.settings));
    });
}

GNOMON_NAMESPACE_END
#endif
