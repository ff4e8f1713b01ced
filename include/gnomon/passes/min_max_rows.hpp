// One-dimensional min-max mipmaps over the rows of a rectified shadow map (Chen et al. 2011): the weight of those texels of
// a row's begin that are before a depth, exact for the map. A view ray is one depth in one row, so this is single
// scattering without any error of reconstruction, to compare with.
//
//     build_min_max_rows(depths, nodes, {0, height});                                once for a map
//     q = transmittance_step(extinction, radius_step, sine of the polar angle);      for each ray, of one texel
//     intensity = min_max_intensity(depths, nodes, q, row, x, z_f);
//
// A row's texels stand in blocks of 64, of which a processor compares many at a time. Above the blocks stands a binary tree,
// with the least and the greatest depth of all that a node covers. Nodes that are wholly before the ray's depth, or not at
// all, count by the weight of their texels; of other nodes the children are visited, and of other blocks the texels.
//
// The weight of a texel is q times that of the texel before. Sums of weights are products, without cancellation, and the
// weights are those of the ray, not of the mean over its row as in a map of prefix averages.
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

/// Sums of the weights of texels in blocks, and of those before z: q^k for texel k of a block, times the weight of its first.
class texels_before {
  public:
#if defined(__GNUC__)
    texels_before(float q, float z) : z_(z)
    {
        float power = q;
        for (std::int32_t bit = 1; bit < lanes; bit *= 2) {
            weights_ *= (places & bit) > 0 ? numbers{} + power : numbers{} + 1;
            power *= power;
        }
        next_ = power;
    }
    GNOMON_INLINE void add(const float* texels, std::size_t count, float first)
    {
        for (std::size_t k = 0; k < count; k += lanes) {
            numbers depth;
            std::memcpy(&depth, texels + k, sizeof depth);
            const numbers weight = places < std::int32_t(count - k) ? first * weights_ : numbers{};
            all_ += weight;
            before_ += depth < z_ ? weight : numbers{};
            first *= next_;
        }
    }
    [[nodiscard]] float total() const { return sum(all_); }
    [[nodiscard]] float before() const { return sum(before_); }

  private:
    static constexpr std::int32_t lanes = 16;
    typedef float numbers __attribute__((vector_size(4 * lanes)));
    typedef std::int32_t flags __attribute__((vector_size(4 * lanes)));
    static constexpr flags places{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

    static float sum(const numbers& of)
    {
        numbers r = of;
        for (std::size_t n = lanes / 2; n > 0; n /= 2)
            for (std::size_t k = 0; k < n; ++k) r[k] += r[k + n];
        return r[0];
    }

    numbers weights_ = numbers{} + 1, all_{}, before_{};
    float next_, z_;
#else
    texels_before(float q, float z) : q_(q), z_(z) {}
    void add(const float* texels, std::size_t count, float first)
    {
        float all = 0, before = 0;
        for (std::size_t k = 0; k < count; ++k) {
            all += first;
            before += texels[k] < z_ ? first : 0;
            first *= q_;
        }
        all_ += all;
        before_ += before;
    }
    [[nodiscard]] float total() const { return all_; }
    [[nodiscard]] float before() const { return before_; }

  private:
    float q_, z_, all_ = 0, before_ = 0;
#endif
};

} // namespace detail

/// Shadow intensity in [0, 1] at depth z_f of the part of a row up to x texels: the weight of texels with a depth before z_f
/// over the weight of all, where each texel has q times the weight of the texel before. The last texel counts by the weight
/// of its part. At x = 0 the first texel counts alone.
/// Domain: rows that build_min_max_rows accepts; any x, limited to the row; z_f limited to [-1, 1], and q to [0, 1].
/// NaN: 0, lit, for x or z_f; a q of NaN is 1; texels of depth NaN are lit.
/// Error: 3e-6, for up to 4096 texels.
/// Source: Chen 2011
inline float min_max_intensity(map_view<const float> depths, map_view<const depth_interval> nodes, float q,
                               std::size_t row, float x, float z_f)
{
    const float z = clamp_or_nan(z_f, -1.0f, 1.0f), factor = clamp_or_high(q, 0.0f, 1.0f);
    if (!(z > -1) || (std::isnan)(x)) return 0;
    const float* texel = &depths(0, row);
    const depth_interval* node = &nodes(0, row);
    const float end = clamp_or_high(x, 0x1p-20f, float(depths.width));
    const auto last = (std::min)(std::size_t(end), depths.width - 1);
    const std::size_t leaves = nodes.width / 2, blocks = last / min_max_block;

    // The weight of the texels of a node over that of the first, and the factor over all of them, for each level.
    struct level_weight {
        float all, factor;
    };
    std::array<level_weight, std::numeric_limits<std::size_t>::digits> levels;
    level_weight of_level{1, factor};
    const auto doubled = [](level_weight w) { return level_weight{w.all + w.all * w.factor, w.factor * w.factor}; };
    for (std::size_t k = 1; k < min_max_block; k *= 2) of_level = doubled(of_level);
    std::size_t top = 0;
    while (blocks >> top > 1) ++top;
    for (std::size_t k = 0; k <= top; ++k, of_level = doubled(of_level)) levels[k] = of_level;

    // By blocks: the largest node that begins at the block and is not beyond the end, unless it must be opened.
    detail::texels_before opened(factor, z);
    float before = 0, all = 0, first = 1;
    std::size_t at = 0, level = top;
    while (at < blocks) {
        const std::size_t size = std::size_t{1} << level;
        const depth_interval& i = node[(leaves + at) >> level];
        const decided_shadow<float> found = depth_interval_shadow(i.least, i.greatest, z, 0.0f, 0.0f);
        if (level > 0 && (size > blocks - at || !(found.decided > 0))) {
            --level;
            continue;
        }
        if (found.decided > 0) {
            all += first * levels[level].all;
            before += found.intensity * (first * levels[level].all);
        } else opened.add(texel + min_max_block * at, min_max_block, first);
        first *= levels[level].factor;
        at += size;
        level += (at >> level) % 2 == 0;
    }
    const std::size_t rest = last % min_max_block;
    opened.add(texel + min_max_block * blocks, rest, first);
    float power = factor;
    for (std::size_t k = rest; k > 0; k /= 2, power *= power) first *= k % 2 == 1 ? power : 1;
    const float part = first * transmittance_weight_within(0.0f, factor, end - float(last));
    before += texel[last] < z ? part : 0;
    return saturate_or_zero((before + opened.before()) / (all + part + opened.total()));
}

GNOMON_NAMESPACE_END
#endif
