// Clusters of depths around every tile, and how much memory a layered map needs. Tiles of one row depend on no other row, so
// that threads may share the rows; layer_allocate then counts all tiles.
#ifndef GNOMON_PASSES_LAYER_CLUSTER_HPP
#define GNOMON_PASSES_LAYER_CLUSTER_HPP

#include "layer_division.hpp"

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The least and the greatest middle depth in a window, with the bits of layer_window_add, and whether anything moves.
struct window_extremes {
    layer_window<float> depths;
    bool moves;
};

inline window_extremes extremes_of(window_samples& samples)
{
    constexpr std::size_t lanes = sample_batch::lanes;
    const layer_window<float> none = layer_window_begin(float(layer_background_depth));
    std::array<float, lanes> least, greatest;
    least.fill(none.least);
    greatest.fill(none.greatest);
    unsigned moves = 0;
    samples.for_each_batch([&](const sample_batch& s) {
        for (std::size_t first = 0; first < s.rounded(); first += lanes)
            for (std::size_t k = 0; k < lanes; ++k) {
                const float z = s.middle[first + k];
                const bool surface = gnomon_abs(z) <= float(layer_depth_limit);
                least[k] = surface && z < least[k] ? z : least[k];
                greatest[k] = surface && greatest[k] < z ? z : greatest[k];
            }
        for (std::size_t k = 0; k < s.rounded(); ++k)
            moves |= unsigned(!(s.d_x[k] == 0)) | unsigned(!(s.d_y[k] == 0)) | unsigned(!(s.d_z[k] == 0));
    });
    layer_window<float> depths = none;
    for (std::size_t k = 0; k < lanes; ++k)
        depths = {(std::min)(depths.least, least[k]), (std::max)(depths.greatest, greatest[k])};
    return {depths, moves != 0};
}

/// The bins of a window, as bits, that hold a sample.
inline std::uint64_t occupied_bins(window_samples& samples, const layer_window<float>& window)
{
    std::array<std::uint64_t, sample_batch::lanes> bits{};
    const float extent = window.greatest - window.least;
    samples.for_each_batch([&](const sample_batch& s) {
        std::array<std::int32_t, sample_batch::most> bins; // as of layer_bin_of
        for (std::size_t k = 0; k < s.rounded(); ++k) {
            const float z = s.middle[k];
            const bool surface = gnomon_abs(z) <= float(layer_depth_limit);
            const auto bin = std::int32_t(64 * ((surface ? z - window.least : 0) / extent));
            bins[k] = surface ? (std::min)(bin, 63) : 64;
        }
        for (std::size_t first = 0; first < s.rounded(); first += bits.size())
            for (std::size_t k = 0; k < bits.size(); ++k) {
                const std::int32_t bin = bins[first + k];
                bits[k] |= std::uint64_t(bin < 64) << (bin & 63);
            }
    });
    std::uint64_t all = 0;
    for (const std::uint64_t b : bits) all |= b;
    return all;
}

/// The cuts of a window of one layer.
inline layer_cuts<float> no_cuts() { return layer_cuts_end(layer_cuts_begin(layer_window_begin(0.0f)), 1.0f); }

/// The fewest empty bins that divide layers. Samples at texel centres see a tilted plane at no more depths than there are
/// columns or rows, which leaves fewer bins empty between them.
constexpr std::size_t least_gap(const tile_window& w, bool centres)
{
    const std::size_t along = (std::max)((std::min)(w.x1 - w.x0, w.y1 - w.y0), std::size_t(2)) - 1;
    return centres ? (63 + along) / along : 1;
}

inline tile_clusters clusters_of(const sample_map<float>& map, const tile_window& w, const layer_settings& settings)
{
    window_samples samples(map, w);
    const auto [window, moves] = extremes_of(samples);
    tile_clusters tile{no_cuts(), window.least <= window.greatest, !moves, {}};
    if (settings.layers > 1 && window.greatest - window.least >= float(layer_least_extent)) {
        const layer_runs<float> runs = runs_of(window, occupied_bins(samples, window), least_gap(w, settings.centres));
        tile.cuts = layer_cuts_end(runs, float(settings.layers));
        const auto cut = [](float c) { return c < float(layer_no_cut) ? 1u : 0u; };
        tile.layers = 1 + cut(tile.cuts.c0) + cut(tile.cuts.c1) + cut(tile.cuts.c2);
    }
    if (settings.division > 0 && moves)
        for (std::uint32_t k = 0, whole = tile.layers; k < whole; ++k) {
            tile.divisions[k] = division_of(samples, {tile.cuts, float(k)}, settings.division);
            tile.layers += tile.divisions[k].divides();
        }
    return tile;
}

/// Check a band of rows of tiles, or of blocks.
inline void expect_tile_rows(std::string_view pass, row_range rows, std::size_t all)
{
    GNOMON_EXPECTS(rows.first <= rows.last, mismatch(pass, "rows.first", rows.first, "rows.last", rows.last));
    GNOMON_EXPECTS(rows.last <= all, mismatch(pass, "rows.last", rows.last, "the number of rows", all));
}

} // namespace detail

/// Cluster the samples around the tiles of the given rows of tiles. clusters has an element for each tile, row by row.
/// Source: Andersson 2015, Sec. 4.1
inline void layer_cluster(const sample_map<float>& samples, const layer_settings& settings,
                          std::span<tile_clusters> clusters, row_range rows)
{
    constexpr std::string_view pass = "layer_cluster";
    check_shape(samples, pass);
    check_settings(settings, pass);
    const std::size_t across = tiles_along(samples.width, settings.tile);
    const std::size_t down = tiles_along(samples.height, settings.tile);
    GNOMON_EXPECTS(clusters.size() == across * down,
                   mismatch(pass, "clusters.size()", clusters.size(), "the number of tiles", across * down));
    detail::expect_tile_rows(pass, rows, down);
    for (std::size_t row = rows.first; row < rows.last; ++row)
        for (std::size_t column = 0; column < across; ++column)
            clusters[row * across + column] =
                detail::clusters_of(samples, detail::window_around(samples, settings, column, row), settings);
}

/// True if the texels of a tile are those of the plain map: one layer in which nothing moves.
constexpr bool is_plain(const tile_clusters& tile) { return tile.layers == 1 && tile.is_static; }

/// Fill `first` with where each tile's layers begin, and `blocks` with the blocks of the plain map that plain tiles and
/// their windows need, for a map of width x height texels. Returns how many of both there are.
inline layer_counts layer_allocate(const layer_settings& settings, std::span<const tile_clusters> clusters,
                                   std::size_t width, std::size_t height, std::span<std::uint32_t> first,
                                   std::span<std::uint32_t> blocks)
{
    constexpr std::string_view pass = "layer_allocate";
    check_settings(settings, pass);
    const std::size_t across = tiles_along(width, settings.tile), down = tiles_along(height, settings.tile);
    const std::size_t block_columns = tiles_along(width, layer_block), block_rows = tiles_along(height, layer_block);
    const auto expect = [&](std::string_view name, std::size_t size, std::string_view other, std::size_t n) {
        GNOMON_EXPECTS(size == n, mismatch(pass, name, size, other, n));
    };
    expect("clusters.size()", clusters.size(), "the number of tiles", across * down);
    expect("first.size()", first.size(), "the number of tiles + 1", across * down + 1);
    expect("blocks.size()", blocks.size(), "the number of blocks", block_columns * block_rows);
    layer_counts counts;
    for (std::uint32_t& b : blocks) b = layer_no_block;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        first[i] = std::uint32_t(counts.layers);
        if (!is_plain(clusters[i])) {
            counts.layers += clusters[i].layers;
            continue;
        }
        const std::size_t margin = (settings.guard - settings.tile) / 2;
        const std::size_t x = i % across * settings.tile, y = i / across * settings.tile;
        const auto range = [&](std::size_t begin, std::size_t end) {
            const std::size_t last = (std::min)(begin + settings.tile + margin, end) - 1;
            return row_range{(begin - (std::min)(begin, margin)) / layer_block, last / layer_block};
        };
        const row_range bx = range(x, width), by = range(y, height);
        for (std::size_t v = by.first; v <= by.last; ++v)
            for (std::size_t u = bx.first; u <= bx.last; ++u) blocks[v * block_columns + u] = 0;
    }
    first[clusters.size()] = std::uint32_t(counts.layers);
    for (std::uint32_t& b : blocks)
        if (b == 0) b = std::uint32_t(counts.blocks++);
    return counts;
}

GNOMON_NAMESPACE_END
#endif
