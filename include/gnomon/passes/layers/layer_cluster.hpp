// Clusters of depths around every tile, and how much memory a layered map needs. Tiles of one row depend on no other row, so
// that threads may share the rows; layer_allocate then counts all tiles.
#ifndef GNOMON_PASSES_LAYER_CLUSTER_HPP
#define GNOMON_PASSES_LAYER_CLUSTER_HPP

#include "layer_map.hpp"

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The texels of the light's map in the window around a tile: columns x0 to x1 - 1, rows y0 to y1 - 1.
struct tile_window {
    std::size_t x0, x1, y0, y1;
};

inline tile_window window_around(const sample_map<float>& samples, const layer_settings& s, std::size_t column,
                                 std::size_t row)
{
    const std::size_t margin = (s.guard - s.tile) / 2;
    const auto from = [&](std::size_t tile) { return tile * s.tile - (std::min)(tile * s.tile, margin); };
    const auto to = [&](std::size_t tile, std::size_t extent) {
        return (std::min)((tile + 1) * s.tile + margin, extent);
    };
    return {from(column), to(column, samples.width), from(row), to(row, samples.height)};
}

/// Up to 64 samples of a window, with their middle depths; those of the background fill the rest.
struct sample_chunk {
    static constexpr std::size_t most = 64, lanes = 16;
    std::span<const stochastic_sample<float>> of;
    std::array<float, most> middle;

    explicit sample_chunk(std::span<const stochastic_sample<float>> samples) : of(samples)
    {
        for (std::size_t k = 0; k < of.size(); ++k) middle[k] = layer_middle_depth(of[k]);
        for (std::size_t k = of.size(); k < rounded(); ++k) middle[k] = float(layer_background_depth);
    }
    std::size_t rounded() const { return (of.size() + lanes - 1) / lanes * lanes; }
};

/// Call f(sample_chunk) for all samples of a window.
void for_each_chunk(const sample_map<float>& samples, const tile_window& w, const auto& f)
{
    for (std::size_t y = w.y0; y < w.y1; ++y) {
        auto row = samples.of.subspan((y * samples.width + w.x0) * samples.samples, (w.x1 - w.x0) * samples.samples);
        for (; row.size() > sample_chunk::most; row = row.subspan(sample_chunk::most))
            f(sample_chunk(row.first(sample_chunk::most)));
        f(sample_chunk(row));
    }
}

/// The least and the greatest middle depth in a window, with the bits of layer_window_add.
inline layer_window<float> window_of(const sample_map<float>& samples, const tile_window& w, bool& moves)
{
    constexpr std::size_t lanes = sample_chunk::lanes;
    const layer_window<float> none = layer_window_begin(float(layer_background_depth));
    std::array<float, lanes> least, greatest;
    least.fill(none.least), greatest.fill(none.greatest);
    unsigned moving = 0;
    for_each_chunk(samples, w, [&](const sample_chunk& chunk) {
        for (std::size_t first = 0; first < chunk.rounded(); first += lanes)
            for (std::size_t k = 0; k < lanes; ++k) {
                const float z = chunk.middle[first + k];
                const bool surface = gnomon_abs(z) <= float(layer_depth_limit);
                least[k] = surface && z < least[k] ? z : least[k];
                greatest[k] = surface && greatest[k] < z ? z : greatest[k];
            }
        for (const stochastic_sample<float>& s : chunk.of)
            moving |= unsigned(!(s.d_x == 0)) | unsigned(!(s.d_y == 0)) | unsigned(!(s.d_z == 0));
    });
    moves = moving != 0;
    layer_window<float> window = none;
    for (std::size_t k = 0; k < lanes; ++k)
        window = {(std::min)(window.least, least[k]), (std::max)(window.greatest, greatest[k])};
    return window;
}

/// The bins of a window, as bits, that hold a sample.
inline std::uint64_t occupied_bins(const sample_map<float>& samples, const tile_window& w,
                                   const layer_window<float>& window)
{
    std::array<std::uint64_t, sample_chunk::lanes> bits{};
    const float extent = window.greatest - window.least;
    for_each_chunk(samples, w, [&](const sample_chunk& chunk) {
        std::array<std::int32_t, sample_chunk::most> bins; // as of layer_bin_of
        for (std::size_t k = 0; k < chunk.rounded(); ++k) {
            const float z = chunk.middle[k];
            const bool surface = gnomon_abs(z) <= float(layer_depth_limit);
            const auto bin = std::int32_t(64 * ((surface ? z - window.least : 0) / extent));
            bins[k] = surface ? (std::min)(bin, 63) : 64;
        }
        for (std::size_t first = 0; first < chunk.rounded(); first += bits.size())
            for (std::size_t k = 0; k < bits.size(); ++k) {
                const std::int32_t bin = bins[first + k];
                bits[k] |= std::uint64_t(bin < 64) << (bin & 63);
            }
    });
    std::uint64_t all = 0;
    for (const std::uint64_t b : bits) all |= b;
    return all;
}

/// The cuts of a window with these bins: those of the fold of layer_cuts_add over all 64.
inline layer_cuts<float> cuts_of(const layer_window<float>& window, std::uint64_t occupied, std::size_t layers)
{
    layer_runs<float> runs = layer_cuts_begin(window);
    while (occupied != 0) {
        const int empty = std::countr_zero(occupied), full = std::countr_one(occupied >> empty);
        runs.empty += float(empty) * runs.begun;
        runs.bins += float(empty);
        runs = layer_cuts_add(runs, 1.0f);
        runs.bins += float(full - 1);
        occupied = empty + full < 64 ? occupied >> empty >> full : 0;
    }
    return layer_cuts_end(runs, float(layers));
}

/// The cuts of a window of one layer.
inline layer_cuts<float> no_cuts() { return cuts_of(layer_window_begin(0.0f), 0, 1); }

inline tile_clusters clusters_of(const sample_map<float>& samples, const layer_settings& settings, const tile_window& w)
{
    bool moves = false;
    const layer_window<float> window = window_of(samples, w, moves);
    tile_clusters tile{no_cuts(), window.least <= window.greatest, !moves};
    if (settings.layers == 1 || !(window.greatest - window.least >= float(layer_least_extent))) return tile;
    tile.cuts = cuts_of(window, occupied_bins(samples, w, window), settings.layers);
    const auto cut = [](float c) { return c < float(layer_no_cut) ? 1u : 0u; };
    tile.layers = 1 + cut(tile.cuts.c0) + cut(tile.cuts.c1) + cut(tile.cuts.c2);
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
                detail::clusters_of(samples, settings, detail::window_around(samples, settings, column, row));
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
