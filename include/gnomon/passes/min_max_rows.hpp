// One-dimensional min-max mipmaps over the rows of a rectified shadow map (Chen et al. 2011): the weight of those texels of
// a row's begin that are before a depth, exact for the map. A view ray is one depth in one row, so this is single
// scattering without any error of reconstruction, to compare with.
//
//     build_min_max_rows(depths, nodes, {0, height});                                once for a map
//     weights = min_max_weights_of(q, blocks);                                       once for each factor q
//     intensity = min_max_intensity(depths, nodes, weights, row, x, z_f);            for each ray
//
// A row's texels stand in blocks of 64, of which a processor compares many at a time. Above the blocks stands a binary tree, with the least and the greatest depth of all
// that a node covers. Nodes that are wholly before the ray's depth, or not at all, count by the weight of their texels; of
// other nodes the children are visited, and of other blocks the texels.
//
// The weight of a texel is q times that of the texel before, as transmittance falls along a ray.
#ifndef GNOMON_PASSES_MIN_MAX_ROWS_HPP
#define GNOMON_PASSES_MIN_MAX_ROWS_HPP

#include "../scattering/transmittance_weights.h"
#include "../soft/depth_interval.h"
#include "depth_pyramid.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

GNOMON_NAMESPACE_BEGIN

/// Rows are whole blocks of so many texels.
inline constexpr std::size_t min_max_block = 64;

/// The number of nodes of a row of so many texels, some of them unused. Node 1 is the root, below node n are 2 n and 2 n + 1,
/// and the last half of all nodes are the blocks in their order.
constexpr std::size_t min_max_nodes(std::size_t width) { return 2 * std::bit_ceil(width / min_max_block); }

/// The weight of all texels before a block, and that of its first texel.
struct min_max_block_weight {
    float before, first;
};

/// Weights of the texels of rows. The first texel of the row has weight 1.
struct min_max_weights {
    std::array<float, min_max_block> texels{};      // of a block whose first texel has weight 1
    std::array<float, min_max_block> before{};      // the sum of the weights of the texels before, in such a block
    std::span<const min_max_block_weight> blocks{}; // and one for the end of the row
};

/// Weights where each texel has q times the weight of the texel before. blocks, which is written, has an element for each
/// block of a row and one for its end.
/// Domain: q in [0, 1]; others are limited to it.
/// NaN: 1, clear air.
inline min_max_weights min_max_weights_of(double q, std::span<min_max_block_weight> blocks)
{
    const double factor = clamp_or_high(q, 0.0, 1.0);
    min_max_weights r{{}, {}, blocks};
    double weight = 1, of_block = 0, before = 0, first = 1;
    for (std::size_t k = 0; k < min_max_block; ++k) {
        r.texels[k] = float(weight);
        r.before[k] = float(of_block);
        of_block += weight;
        weight *= factor;
    }
    for (min_max_block_weight& b : blocks) {
        b = {float(before), float(first)};
        before += first * of_block;
        first *= weight;
    }
    return r;
}

/// Fill the given rows of nodes from the rows of depths. Depths are limited to [-1, 1]; a NaN is the far plane.
inline void build_min_max_rows(map_view<const float> depths, map_view<depth_interval> nodes, row_range rows)
{
    constexpr std::string_view pass = "build_min_max_rows";
    expect_map(pass, "depths", depths);
    expect_map(pass, "nodes", nodes);
    GNOMON_EXPECTS(depths.width % min_max_block == 0,
                   mismatch(pass, "depths.width", depths.width, "min_max_block", min_max_block));
    GNOMON_EXPECTS(nodes.width == min_max_nodes(depths.width),
                   mismatch(pass, "nodes.width", nodes.width, "min_max_nodes", min_max_nodes(depths.width)));
    GNOMON_EXPECTS(nodes.height == depths.height,
                   mismatch(pass, "nodes.height", nodes.height, "depths.height", depths.height));
    expect_rows(pass, nodes, rows);
    const std::size_t leaves = nodes.width / 2, blocks = depths.width / min_max_block;
    for (std::size_t y = rows.first; y < rows.last; ++y) {
        depth_interval* node = &nodes(0, y);
        const float* texel = &depths(0, y);
        for (std::size_t b = 0; b < leaves; ++b) {
            depth_interval r;
            if (b < blocks) {
                r = detail::interval_of_texel(*texel);
                for (std::size_t k = 0; k < min_max_block; ++k)
                    r = detail::united(r, detail::interval_of_texel(*texel++));
            }
            node[leaves + b] = r;
        }
        for (std::size_t n = leaves; n-- > 1;) node[n] = detail::united(node[2 * n], node[2 * n + 1]);
        node[0] = {};
    }
}

namespace detail {

/// The sum of the weights of those of a block's first count texels that are before z.
class texels_before {
  public:
    texels_before(const std::array<float, min_max_block>& weights, float z) : weights_(weights.data()), z_(z) {}

#if defined(__GNUC__)
    GNOMON_INLINE void add(const float* texels, std::size_t count, float first)
    {
        for (std::size_t k = 0; k < count; k += lanes) {
            numbers depth, weight;
            std::memcpy(&depth, texels + k, sizeof depth);
            std::memcpy(&weight, weights_ + k, sizeof weight);
            const flags counted = (depth < z_) & (places < std::int32_t(count - k));
            sums_ += counted ? first * weight : numbers{};
        }
    }
    [[nodiscard]] float total() const
    {
        numbers r = sums_;
        for (std::size_t n = lanes / 2; n > 0; n /= 2)
            for (std::size_t k = 0; k < n; ++k) r[k] += r[k + n];
        return r[0];
    }

  private:
    static constexpr std::size_t lanes = 16;
    typedef float numbers __attribute__((vector_size(4 * lanes)));
    typedef std::int32_t flags __attribute__((vector_size(4 * lanes)));
    static constexpr flags places{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

    numbers sums_{};
#else
    void add(const float* texels, std::size_t count, float first)
    {
        float sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += texels[k] < z_ ? weights_[k] : 0;
        sum_ += first * sum;
    }
    [[nodiscard]] float total() const { return sum_; }

  private:
    float sum_ = 0;
#endif
    const float* weights_;
    float z_;
};

} // namespace detail

/// Shadow intensity in [0, 1] at depth z_f of the part of a row up to x texels: the weight of texels with a depth before z_f
/// over the weight of all. The last texel counts by the weight of its part. At x = 0 the first texel counts alone.
/// Domain: rows that build_min_max_rows accepts; any x, limited to the row; any z_f, limited to [-1, 1].
/// NaN: 0, lit; texels of depth NaN are lit.
/// Error: 3e-6, for up to 4096 texels.
/// Source: Chen 2011
inline float min_max_intensity(map_view<const float> depths, map_view<const depth_interval> nodes,
                               const min_max_weights& weights, std::size_t row, float x, float z_f)
{
    const float z = clamp_or_nan(z_f, -1.0f, 1.0f);
    if (!(z > -1) || (std::isnan)(x)) return 0;
    const float* texel = &depths(0, row);
    const depth_interval* node = &nodes(0, row);
    const float end = clamp_or_high(x, 0x1p-20f, float(depths.width));
    const auto last = (std::min)(std::size_t(end), depths.width - 1);
    const std::size_t leaves = nodes.width / 2, blocks = last / min_max_block, rest = last % min_max_block;

    // By blocks: the largest node that begins at the block and is not beyond the end, unless it must be opened.
    detail::texels_before opened(weights.texels, z);
    float shadowed = 0;
    std::size_t at = 0, level = blocks > 0 ? std::size_t(std::bit_width(blocks)) - 1 : 0;
    while (at < blocks) {
        const std::size_t size = std::size_t{1} << level;
        const depth_interval& i = node[(leaves + at) >> level];
        const decided_shadow<float> found = depth_interval_shadow(i.least, i.greatest, z, 0.0f, 0.0f);
        if (level > 0 && (size > blocks - at || !(found.decided > 0))) {
            --level;
            continue;
        }
        if (found.decided > 0)
            shadowed += found.intensity * (weights.blocks[at + size].before - weights.blocks[at].before);
        else opened.add(texel + min_max_block * at, min_max_block, weights.blocks[at].first);
        at += size;
        level += (at >> level) % 2 == 0;
    }
    opened.add(texel + min_max_block * blocks, rest, weights.blocks[blocks].first);

    const float part = weights.blocks[blocks].first * weights.texels[rest] *
                       transmittance_weight_within(0.0f, weights.texels[1], end - float(last));
    const float all = weights.blocks[blocks].before + weights.blocks[blocks].first * weights.before[rest] + part;
    return saturate_or_zero((shadowed + opened.total() + (texel[last] < z ? part : 0)) / all);
}

GNOMON_NAMESPACE_END
#endif
