// Mip chain of a shadow map in its storage format. A texel is the mean of the texels that it covers in the level below:
// 2x2 where the extent is even; 3 with the weights of their overlap along an odd extent, so that the mean of a level is
// that of the map but for rounding.
#ifndef GNOMON_PASSES_MIPS_HPP
#define GNOMON_PASSES_MIPS_HPP

#include "map_view.hpp"

#include <algorithm>

namespace gnomon {

constexpr std::size_t mip_extent(std::size_t extent, std::size_t level)
{
    return level < 64 ? std::max<std::size_t>(extent >> level, 1) : 1;
}

/// Levels down to 1x1, the map itself included.
constexpr std::size_t mip_levels(std::size_t width, std::size_t height)
{
    return std::size_t(std::bit_width(std::max(width, height)));
}

/// Texels of all levels, one after the other.
constexpr std::size_t mip_texels(std::size_t width, std::size_t height)
{
    std::size_t sum = 0;
    for (std::size_t level = 0; level < mip_levels(width, height); ++level)
        sum += mip_extent(width, level) * mip_extent(height, level);
    return sum;
}

/// All levels in one span, the largest first, each without gaps.
template <class T> struct mip_view {
    std::span<T> texels;
    std::size_t width = 0, height = 0;

    constexpr std::size_t levels() const { return mip_levels(width, height); }
    constexpr map_view<T> level(std::size_t index) const
    {
        std::size_t offset = 0;
        for (std::size_t k = 0; k < index; ++k) offset += mip_extent(width, k) * mip_extent(height, k);
        const std::size_t w = mip_extent(width, index);
        const std::size_t h = mip_extent(height, index);
        return {texels.subspan(offset, w * h), w, h};
    }
    constexpr operator mip_view<const T>() const { return {texels, width, height}; }
};

namespace detail {

/// The texels under one of the next level: begin to begin + 2, of which the last may weigh nothing.
struct footprint {
    std::size_t begin;
    std::array<float, 3> weights;
};

constexpr footprint mip_footprint(std::size_t extent, std::size_t i)
{
    if (extent == 1) return {0, {1, 0, 0}};
    if (extent % 2 == 0) return {2 * i, {0.5f, 0.5f, 0}};
    const float n = float(extent / 2);
    const float scale = 1 / float(extent);
    return {2 * i, {(n - float(i)) * scale, n * scale, (float(i) + 1) * scale}};
}

} // namespace detail

/// The given rows of the next smaller level. Target has half the source's extents, rounded down, at least 1, and no
/// memory of it.
template <class Format>
void downsample(map_view<const format_texel<Format>> source, map_view<format_texel<Format>> target, row_range rows)
{
    constexpr std::string_view pass = "downsample";
    expect_map(pass, "source", source);
    expect_map(pass, "target", target);
    expect_apart(pass, source, target);
    GNOMON_EXPECTS(target.width == mip_extent(source.width, 1),
                   mismatch(pass, "target.width", target.width, "source.width", source.width));
    GNOMON_EXPECTS(target.height == mip_extent(source.height, 1),
                   mismatch(pass, "target.height", target.height, "source.height", source.height));
    expect_rows(pass, target, rows);
    for (std::size_t y = rows.first; y < rows.last; ++y) {
        const detail::footprint fy = detail::mip_footprint(source.height, y);
        for (std::size_t x = 0; x < target.width; ++x) {
            const detail::footprint fx = detail::mip_footprint(source.width, x);
            channel_array<Format> sum{};
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t i = 0; i < 3; ++i) {
                    const float weight = fx.weights[i] * fy.weights[j];
                    if (weight == 0) continue;
                    const auto c = load_channels<Format>(source(fx.begin + i, fy.begin + j));
                    for (std::size_t k = 0; k < c.size(); ++k) sum[k] += weight * c[k];
                }
            }
            target(x, y) = store_channels<Format>(sum);
        }
    }
}

/// Fills every level below the first.
template <class Format> void build_mips(mip_view<format_texel<Format>> mips)
{
    constexpr std::string_view pass = "build_mips";
    GNOMON_EXPECTS(mips.width > 0 && mips.height > 0,
                   mismatch(pass, "mips.width", mips.width, "mips.height", mips.height));
    GNOMON_EXPECTS(mips.texels.size() / mips.width >= mips.height,
                   mismatch(pass, "mips.texels.size()", mips.texels.size(), "mips.height", mips.height));
    GNOMON_EXPECTS(
        mips.texels.size() >= mip_texels(mips.width, mips.height),
        mismatch(pass, "mips.texels.size()", mips.texels.size(), "mip_texels", mip_texels(mips.width, mips.height)));
    for (std::size_t level = 1; level < mips.levels(); ++level) {
        const map_view<format_texel<Format>> target = mips.level(level);
        downsample<Format>(mips.level(level - 1), target, {0, target.height});
    }
}

} // namespace gnomon
#endif
