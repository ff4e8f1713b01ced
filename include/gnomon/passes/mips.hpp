// Mip chain of a shadow map in its storage format. A texel is the mean of the texels that it covers in the level below.
// Along an even extent these are 2. Along an odd extent they are 3, weighted by their overlap, so that every level has
// the mean of the map except for rounding. No texel beyond the map's edge has a part in it. A NaN becomes the border in
// the levels above.
#ifndef GNOMON_PASSES_MIPS_HPP
#define GNOMON_PASSES_MIPS_HPP

#include "map_view.hpp"

#include <algorithm>
#include <bit>
#include <limits>

GNOMON_NAMESPACE_BEGIN

constexpr std::size_t mip_extent(std::size_t extent, std::size_t level)
{
    return level < std::numeric_limits<std::size_t>::digits ? std::max<std::size_t>(extent >> level, 1) : 1;
}

/// Number of levels down to 1 x 1, including the map itself.
constexpr std::size_t mip_levels(std::size_t width, std::size_t height)
{
    const int bits = std::numeric_limits<std::size_t>::digits - std::countl_zero((std::max)(width, height));
    return std::size_t(bits);
}

/// Number of texels of all levels.
constexpr std::size_t mip_texels(std::size_t width, std::size_t height)
{
    std::size_t sum = 0;
    for (std::size_t level = 0; level < mip_levels(width, height); ++level)
        sum += mip_extent(width, level) * mip_extent(height, level);
    return sum;
}

/// All levels in one span, the largest first, each without gaps between its rows.
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

/// The texels under a texel of the next level: count texels from begin on, with their weights.
struct footprint {
    std::size_t begin, count;
    std::array<float, 3> weights;
};

constexpr footprint mip_footprint(std::size_t extent, std::size_t i)
{
    if (extent == 1) return {0, 1, {1, 0, 0}};
    if (extent % 2 == 0) return {2 * i, 2, {0.5f, 0.5f, 0}};
    const float n = float(extent / 2);
    const float scale = 1 / float(extent);
    return {2 * i, 3, {(n - float(i)) * scale, n * scale, (float(i) + 1) * scale}};
}

/// The mean of the texels under a texel, of which at(i, j) gives the channels.
template <texel_format Format> channel_array<Format> mip_mean(const footprint& fx, const footprint& fy, const auto& at)
{
    channel_array<Format> sum{};
    for (std::size_t j = 0; j < fy.count; ++j)
        for (std::size_t i = 0; i < fx.count; ++i) {
            const float weight = fx.weights[i] * fy.weights[j];
            const channel_array<Format> c = at(i, j);
            for (std::size_t k = 0; k < c.size(); ++k) sum[k] += weight * c[k];
        }
    return sum;
}

/// Fill a row of the next smaller level, decoding and encoding rows of texels.
template <texel_format Format>
void downsample_row(map_view<const format_texel<Format>> source, const footprint& fy,
                    std::span<format_texel<Format>> target)
{
    constexpr std::size_t channels = channel_count<Format>, block = 32;
    std::array<std::array<float, (2 * block + 1) * channels>, 3> under; // texels of up to three rows
    std::array<float, block * channels> numbers;
    for (std::size_t first = 0; first < target.size(); first += block) {
        const std::size_t count = (std::min)(block, target.size() - first);
        const std::size_t begin = mip_footprint(source.width, first).begin;
        const footprint last = mip_footprint(source.width, first + count - 1);
        for (std::size_t j = 0; j < fy.count; ++j)
            load_row<Format>(&source(begin, fy.begin + j), under[j].data(), last.begin + last.count - begin);
        for (std::size_t x = 0; x < count; ++x) {
            const footprint fx = mip_footprint(source.width, first + x);
            const auto mean = mip_mean<Format>(fx, fy, [&](std::size_t i, std::size_t j) {
                channel_array<Format> c;
                std::copy_n(under[j].data() + (fx.begin - begin + i) * channels, channels, c.begin());
                return c;
            });
            std::copy(mean.begin(), mean.end(), numbers.begin() + std::ptrdiff_t(x * channels));
        }
        store_row<Format>(numbers.data(), &target[first], count);
    }
}

} // namespace detail

/// Fill the given rows of target, the next smaller level of source. Target has half of source's extents, rounded down,
/// at least 1. Target must not overlap source.
template <texel_format Format>
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
        if constexpr (has_rows<Format>) {
            detail::downsample_row<Format>(source, fy, std::span(&target(0, y), target.width));
        } else {
            for (std::size_t x = 0; x < target.width; ++x) {
                const detail::footprint fx = detail::mip_footprint(source.width, x);
                target(x, y) =
                    store_channels<Format>(detail::mip_mean<Format>(fx, fy, [&](std::size_t i, std::size_t j) {
                        return load_channels<Format>(source(fx.begin + i, fy.begin + j));
                    }));
            }
        }
    }
}

/// Check that a mip chain has texels, and that all of its levels lie in the span.
template <class T> void expect_mips(std::string_view pass, mip_view<T> mips)
{
    GNOMON_EXPECTS(mips.width > 0 && mips.height > 0,
                   mismatch(pass, "mips.width", mips.width, "mips.height", mips.height));
    GNOMON_EXPECTS(mips.texels.size() / mips.width >= mips.height,
                   mismatch(pass, "mips.texels.size()", mips.texels.size(), "mips.height", mips.height));
    GNOMON_EXPECTS(
        mips.texels.size() >= mip_texels(mips.width, mips.height),
        mismatch(pass, "mips.texels.size()", mips.texels.size(), "mip_texels", mip_texels(mips.width, mips.height)));
}

/// Fill every level below the first.
template <texel_format Format> void build_mips(mip_view<format_texel<Format>> mips)
{
    expect_mips("build_mips", mips);
    for (std::size_t level = 1; level < mips.levels(); ++level) {
        const map_view<format_texel<Format>> target = mips.level(level);
        downsample<Format>(mips.level(level - 1), target, {0, target.height});
    }
}

GNOMON_NAMESPACE_END
#endif
