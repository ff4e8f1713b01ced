// Least and greatest depth of blocks of a depth map, from blocks of 8 x 8 texels on, which decide most receivers of soft
// shadows (soft/depth_interval.h). Each level above has blocks of twice the extent, up to one block for the map. With 8
// bytes for a block, all levels take a sixth of a byte for each texel of the map.
//
// Build from the very depths that the filterable map is made of, all samples of a texel included.
#ifndef GNOMON_PASSES_DEPTH_PYRAMID_HPP
#define GNOMON_PASSES_DEPTH_PYRAMID_HPP

#include "../numerics/select.h"
#include "map_view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

GNOMON_NAMESPACE_BEGIN

/// Every depth of a region is in [least, greatest].
struct depth_interval {
    float least = 1, greatest = 1;
};

inline constexpr std::size_t depth_pyramid_block = 8;

/// The number of blocks of a level along an extent of the map, at least 1.
constexpr std::size_t depth_pyramid_extent(std::size_t extent, std::size_t level)
{
    const std::size_t last = extent > 0 ? (extent - 1) / depth_pyramid_block : 0;
    return (level < std::numeric_limits<std::size_t>::digits ? last >> level : 0) + 1;
}

/// The number of levels up to a single block.
constexpr std::size_t depth_pyramid_levels(std::size_t width, std::size_t height)
{
    const std::size_t blocks = depth_pyramid_extent((std::max)(width, height), 0);
    const int doublings = std::numeric_limits<std::size_t>::digits - std::countl_zero(blocks - 1);
    return std::size_t(doublings) + 1;
}

/// The number of blocks of all levels.
constexpr std::size_t depth_pyramid_blocks(std::size_t width, std::size_t height)
{
    std::size_t sum = 0;
    for (std::size_t level = 0; level < depth_pyramid_levels(width, height); ++level)
        sum += depth_pyramid_extent(width, level) * depth_pyramid_extent(height, level);
    return sum;
}

/// All levels in one span, that of the smallest blocks first. width and height are those of the map, in texels.
template <class T> struct depth_pyramid_view {
    std::span<T> blocks;
    std::size_t width = 0, height = 0;

    constexpr std::size_t levels() const { return depth_pyramid_levels(width, height); }
    constexpr map_view<T> level(std::size_t index) const
    {
        std::size_t offset = 0;
        for (std::size_t k = 0; k < index; ++k)
            offset += depth_pyramid_extent(width, k) * depth_pyramid_extent(height, k);
        const std::size_t w = depth_pyramid_extent(width, index), h = depth_pyramid_extent(height, index);
        return {blocks.subspan(offset, w * h), w, h};
    }
    constexpr operator depth_pyramid_view<const T>() const { return {blocks, width, height}; }
};

namespace detail {

inline depth_interval united(depth_interval a, depth_interval b)
{
    return {(std::min)(a.least, b.least), (std::max)(a.greatest, b.greatest)};
}

inline depth_interval interval_of_texel(float depth)
{
    const float z = clamp_or_high(depth, -1.0f, 1.0f);
    return {z, z};
}

template <std::size_t samples> depth_interval interval_of_texel(const std::array<float, samples>& depths)
{
    depth_interval r = interval_of_texel(depths[0]);
    for (const float depth : depths) r = united(r, interval_of_texel(depth));
    return r;
}

/// The interval of size x size elements of a map from (x, y) on, as far as the map has them.
template <class T, class Interval>
depth_interval interval_of_block(map_view<const T> map, std::size_t x, std::size_t y, std::size_t size, Interval of)
{
    depth_interval r = of(map(x, y));
    for (std::size_t j = y; j < (std::min)(y + size, map.height); ++j)
        for (std::size_t i = x; i < (std::min)(x + size, map.width); ++i) r = united(r, of(map(i, j)));
    return r;
}

} // namespace detail

/// Fill the given rows of blocks, the first level of the pyramid of a depth map. A texel is a depth or an array of the
/// depths of its samples. Depths are limited to [-1, 1]; a NaN is the far plane, as in every format.
template <class Depths>
void depth_intervals(map_view<const Depths> depths, map_view<depth_interval> blocks, row_range rows)
{
    constexpr std::string_view pass = "depth_intervals";
    expect_map(pass, "depths", depths);
    expect_map(pass, "blocks", blocks);
    GNOMON_EXPECTS(blocks.width == depth_pyramid_extent(depths.width, 0),
                   mismatch(pass, "blocks.width", blocks.width, "depths.width", depths.width));
    GNOMON_EXPECTS(blocks.height == depth_pyramid_extent(depths.height, 0),
                   mismatch(pass, "blocks.height", blocks.height, "depths.height", depths.height));
    expect_rows(pass, blocks, rows);
    const auto of = [](const Depths& texel) { return detail::interval_of_texel(texel); };
    for (std::size_t y = rows.first; y < rows.last; ++y)
        for (std::size_t x = 0; x < blocks.width; ++x)
            blocks(x, y) = detail::interval_of_block(depths, depth_pyramid_block * x, depth_pyramid_block * y,
                                                     depth_pyramid_block, of);
}

/// Fill every level of the pyramid of a depth map.
template <class Depths>
void build_depth_pyramid(map_view<const Depths> depths, depth_pyramid_view<depth_interval> pyramid)
{
    constexpr std::string_view pass = "build_depth_pyramid";
    expect_map(pass, "depths", depths);
    GNOMON_EXPECTS(pyramid.width == depths.width,
                   mismatch(pass, "pyramid.width", pyramid.width, "depths.width", depths.width));
    GNOMON_EXPECTS(pyramid.height == depths.height,
                   mismatch(pass, "pyramid.height", pyramid.height, "depths.height", depths.height));
    const std::size_t needed = depth_pyramid_blocks(depths.width, depths.height);
    GNOMON_EXPECTS(pyramid.blocks.size() >= needed,
                   mismatch(pass, "pyramid.blocks.size()", pyramid.blocks.size(), "depth_pyramid_blocks", needed));
    const map_view<depth_interval> first = pyramid.level(0);
    depth_intervals(depths, first, {0, first.height});
    const auto of = [](const depth_interval& i) { return i; };
    for (std::size_t level = 1; level < pyramid.levels(); ++level) {
        const map_view<const depth_interval> below = pyramid.level(level - 1);
        const map_view<depth_interval> blocks = pyramid.level(level);
        for (std::size_t y = 0; y < blocks.height; ++y)
            for (std::size_t x = 0; x < blocks.width; ++x)
                blocks(x, y) = detail::interval_of_block(below, 2 * x, 2 * y, 2, of);
    }
}

/// An interval that holds all depths of the texels that the rectangle from (x0, y0) to (x1, y1), in texels of the map,
/// has a part of. At most 9 blocks are read.
/// Domain: a rectangle beside the map, or with its ends swapped, has no texels. Its interval is the far plane, lit.
/// NaN: [-1, 1], which decides nothing.
inline depth_interval depth_interval_in(depth_pyramid_view<const depth_interval> pyramid, float x0, float y0, float x1,
                                        float y1)
{
    if ((std::isunordered)(x0, x1) || (std::isunordered)(y0, y1)) return {-1, 1};
    const auto beside = [](float begin, float end, std::size_t extent) {
        return !(begin <= end && begin < float(extent) && 0 <= end) || extent == 0;
    };
    if (beside(x0, x1, pyramid.width) || beside(y0, y1, pyramid.height)) return {1, 1};
    struct span_of_blocks {
        std::size_t first, last;
    };
    const auto along = [](float begin, float end, std::size_t extent) {
        const auto block_of = [extent](float texel) {
            const float inside = (std::max)(0.0f, (std::min)(texel, float(extent)));
            return (std::min)(std::size_t(inside), extent - 1) / depth_pyramid_block;
        };
        return span_of_blocks{block_of(begin), block_of((std::max)(begin, std::ceil(end) - 1))};
    };
    span_of_blocks x = along(x0, x1, pyramid.width), y = along(y0, y1, pyramid.height);
    std::size_t level = 0;
    for (; x.last - x.first > 2 || y.last - y.first > 2; ++level) {
        x = {x.first / 2, x.last / 2};
        y = {y.first / 2, y.last / 2};
    }
    const map_view<const depth_interval> map = pyramid.level(level);
    depth_interval r = map(x.first, y.first);
    for (std::size_t j = y.first; j <= y.last; ++j)
        for (std::size_t i = x.first; i <= x.last; ++i) r = detail::united(r, map(i, j));
    return r;
}

GNOMON_NAMESPACE_END
#endif
