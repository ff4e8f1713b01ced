// Rectangles of texels in the caller's memory, with what all passes over them share: shape checks, and texels as arrays
// of floats. A pass is generic in a storage format (storage/format.hpp). It decodes texels, combines them linearly in
// float and encodes the result, so that every pass rounds to the format, as on a GPU.
#ifndef GNOMON_PASSES_MAP_VIEW_HPP
#define GNOMON_PASSES_MAP_VIEW_HPP

#include "../storage/format.hpp"
#include "expects.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

/// A map of width x height texels. Rows are stride texels apart; the first row begins at the begin of the span.
template <class T> struct map_view {
    std::span<T> texels;
    std::size_t width = 0, height = 0, stride = 0;

    constexpr map_view() = default;
    constexpr map_view(std::span<T> t, std::size_t w, std::size_t h) : map_view(t, w, h, w) {}
    constexpr map_view(std::span<T> t, std::size_t w, std::size_t h, std::size_t s)
        : texels(t), width(w), height(h), stride(s)
    {}
    constexpr operator map_view<const T>() const { return {texels, width, height, stride}; }

    constexpr T& operator()(std::size_t x, std::size_t y) const { return texels[y * stride + x]; }
};

/// The texels beyond the edge of a map: the outermost texel again, as GPUs clamp to the edge, or the border of the format,
/// which shadows nothing, as GPUs clamp to a border. Interpolation and blur mix the border with the map's own texels. A
/// caster at the edge shadows everything beyond that edge by clamp, and nothing beyond the filter by lit.
enum class border_mode { clamp, lit };

/// A band of rows, first to last - 1, such as one thread's share.
struct row_range {
    std::size_t first = 0, last = 0;
};

/// The channels of a texel as numbers.
template <texel_format Format> channel_array<Format> load_channels(const format_texel<Format>& t)
{
    return gnomon_bit_cast<channel_array<Format>>(Format::decode(t));
}

/// The texel of channels that are numbers.
template <texel_format Format> format_texel<Format> store_channels(const channel_array<Format>& c)
{
    return Format::encode(gnomon_bit_cast<format_channels<Format>>(c));
}

/// True of formats whose texels are their channels.
template <class Format>
inline constexpr bool holds_numbers = std::is_same_v<format_texel<Format>, channel_array<Format>>;

/// True of formats whose texels hold codes of their channels, rows of which are faster to decode and encode than texels one by one.
template <class Format>
inline constexpr bool has_rows = !holds_numbers<Format> && requires(const float* numbers, format_texel<Format>* texels)
{
    Format::encode_row(numbers, texels, 1);
};

/// Load texels that stand stride apart as numbers, one texel's channels after the other's, with the bits of load_channels.
template <texel_format Format>
void load_row(const format_texel<Format>* from, float* numbers, std::size_t count, std::size_t stride = 1)
{
    if constexpr (requires { Format::decode_row(from, numbers, count); }) {
        if (stride == 1) return Format::decode_row(from, numbers, count);
        if constexpr (!holds_numbers<Format>) {
            std::array<format_texel<Format>, 16> texels;
            for (std::size_t done = 0; done < count; done += texels.size()) {
                const std::size_t some = (std::min)(count - done, texels.size());
                for (std::size_t i = 0; i < some; ++i) texels[i] = from[(done + i) * stride];
                Format::decode_row(texels.data(), numbers + done * channel_count<Format>, some);
            }
            return;
        }
    }
    for (std::size_t i = 0; i < count; ++i, numbers += channel_count<Format>) {
        const auto c = load_channels<Format>(from[i * stride]);
        std::copy(c.begin(), c.end(), numbers);
    }
}

/// Store numbers, one texel's channels after the other's, as texels that stand stride apart, with the bits of store_channels.
template <texel_format Format>
void store_row(const float* numbers, format_texel<Format>* to, std::size_t count, std::size_t stride = 1)
{
    if constexpr (requires { Format::encode_row(numbers, to, count); }) {
        if (stride == 1) return Format::encode_row(numbers, to, count);
        if constexpr (!holds_numbers<Format>) {
            std::array<format_texel<Format>, 16> texels;
            for (std::size_t done = 0; done < count; done += texels.size()) {
                const std::size_t some = (std::min)(count - done, texels.size());
                Format::encode_row(numbers + done * channel_count<Format>, texels.data(), some);
                for (std::size_t i = 0; i < some; ++i) to[(done + i) * stride] = texels[i];
            }
            return;
        }
    }
    for (std::size_t i = 0; i < count; ++i, numbers += channel_count<Format>) {
        channel_array<Format> c;
        std::copy_n(numbers, c.size(), c.begin());
        to[i * stride] = store_channels<Format>(c);
    }
}

/// The channels of the border, as a map stores them.
template <texel_format Format> constexpr format_channels<Format> stored_border()
{
    return Format::decode(Format::clear());
}

/// Check that the map has texels, that its rows do not overlap, and that all of them lie in the span.
template <class T> void expect_map(std::string_view pass, std::string_view name, map_view<T> map)
{
    const std::string n(name);
    GNOMON_EXPECTS(map.width > 0 && map.height > 0, mismatch(pass, n + ".width", map.width, n + ".height", map.height));
    GNOMON_EXPECTS(map.stride >= map.width, mismatch(pass, n + ".stride", map.stride, n + ".width", map.width));
    const std::size_t size = map.texels.size();
    GNOMON_EXPECTS(map.width <= size && (map.height - 1) <= (size - map.width) / map.stride,
                   mismatch(pass, n + ".texels.size()", size, n + ".height", map.height));
}

template <class T, class U> void expect_same_extent(std::string_view pass, map_view<T> source, map_view<U> target)
{
    GNOMON_EXPECTS(target.width == source.width,
                   mismatch(pass, "target.width", target.width, "source.width", source.width));
    GNOMON_EXPECTS(target.height == source.height,
                   mismatch(pass, "target.height", target.height, "source.height", source.height));
}

template <class T, class U> void expect_apart(std::string_view pass, map_view<T> source, map_view<U> target)
{
    const T* s = source.texels.data();
    const U* t = target.texels.data();
    const std::less_equal<const void*> before;
    GNOMON_EXPECTS(before(s + source.texels.size(), t) || before(t + target.texels.size(), s),
                   mismatch(pass, "target begins inside source or before its end: target.texels.size()",
                            target.texels.size(), "source.texels.size()", source.texels.size()));
}

template <class T> void expect_rows(std::string_view pass, map_view<T> map, row_range rows)
{
    GNOMON_EXPECTS(rows.first <= rows.last, mismatch(pass, "rows.first", rows.first, "rows.last", rows.last));
    GNOMON_EXPECTS(rows.last <= map.height, mismatch(pass, "rows.last", rows.last, "target.height", map.height));
}

GNOMON_NAMESPACE_END
#endif
