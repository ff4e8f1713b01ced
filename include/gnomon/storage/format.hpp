// The one interface of storage formats for maps in main memory, and the kinds of texels that formats are made of. A
// format is a type: the texel, its channels, and the kernels of storage/*.h that belong to them, so that a map, its filter
// and its reconstruction cannot be mismatched. storage/formats.hpp lists all.
//
//     using format = gnomon::moments4_unorm16;
//     format::texel t = format::encode(format::from_depth(z));                  // while rendering the map
//     float shadow = format::intensity(format::decode(t), z_f);                 // floats or packs
//
// Filters are linear in the channels: decode, average, encode.
//
// NaN is no information, and lit. encode stores the border for channels that have a NaN. Maps of floats and halves that
// were written elsewhere may hold a NaN: a filter is lit wherever that texel has a weight, and elsewhere unchanged.
#ifndef GNOMON_STORAGE_FORMAT_HPP
#define GNOMON_STORAGE_FORMAT_HPP

#include "../moments/channels.h"
#include "../numerics/half.hpp"
#include "../numerics/unorm.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

template <class Format> using format_texel = typename Format::texel;

/// The struct of the channels, as decode returns it: numbers of type Real and nothing else.
template <class Format, class Real = float> using format_channels = typename Format::template channels<Real>;

/// Types and functions of any texel that linear filters may mix:
///     texel, channels<Real>        what the map holds, and what a texture unit returns
///     name, id                     in words, and for programs: [a-z0-9_]
///     bytes_per_texel
///     encode(channels)             the texel; the border for channels that have a NaN
///     decode(texel)                the channels
///     border(), clear()            channels and texel that shadow nothing
// clang-format off
template <class Format> concept texel_format = requires(const format_texel<Format>& t, const format_channels<Format>& c) {
    requires std::is_trivially_copyable_v<format_texel<Format>>;
    requires std::is_trivially_copyable_v<format_channels<Format>>;
    requires Format::bytes_per_texel == sizeof(format_texel<Format>);
    { Format::name } -> std::convertible_to<std::string_view>;
    { Format::id } -> std::convertible_to<std::string_view>;
    { Format::encode(c) } -> std::same_as<format_texel<Format>>;
    { Format::decode(t) } -> std::same_as<format_channels<Format>>;
    { Format::border() } -> std::same_as<format_channels<Format>>;
    { Format::clear() } -> std::same_as<format_texel<Format>>;
};

/// Functions that every storage format of a shadow map has beside those of its texel:
///     from_depth(z)                the channels of one depth
///     intensity(channels, z_f)     the shadow after one rounding to the format, from any linear filter
///     filtered_intensity           the shadow after a filter of two passes that store their results in the format
///     darkening                    the most by which a lit surface is darkened by intensity
///     filtered_darkening           the most by which a lit surface is darkened by filtered_intensity
template <class Format> concept storage_format = texel_format<Format> && requires(float z, double w,
                                                          const format_channels<Format>& c,
                                                          const format_channels<Format, double>& d) {
    { Format::from_depth(z) } -> std::same_as<format_channels<Format>>;
    { Format::from_depth(w) } -> std::same_as<format_channels<Format, double>>;
    { Format::intensity(c, z) } -> std::same_as<float>;
    { Format::intensity(d, w) } -> std::same_as<double>;
    { Format::filtered_intensity(c, z) } -> std::same_as<float>;
    { Format::filtered_intensity(d, w) } -> std::same_as<double>;
    { Format::darkening } -> std::convertible_to<double>;
    { Format::filtered_darkening } -> std::convertible_to<double>;
};
// clang-format on

/// The number of channels, and an array of them in order.
template <class Format> inline constexpr std::size_t channel_count = sizeof(format_channels<Format>) / sizeof(float);
template <class Format> using channel_array = std::array<float, channel_count<Format>>;

/// A texel with a code of its own for each channel, in order.
template <template <class...> class Channels, class Code> struct coded_texel {
    template <class Real> using channels = Channels<Real>;
    static constexpr std::size_t count = sizeof(channels<float>) / sizeof(float);
    using texel = std::array<Code, count>;
    static constexpr std::size_t bytes_per_texel = sizeof(texel);
};

/// UNORM codes of the given number of bits.
template <template <class...> class Channels, int bits> struct unorm_texel : coded_texel<Channels, unorm_code<bits>> {
    using typename coded_texel<Channels, unorm_code<bits>>::texel;
    static constexpr texel encode(const Channels<float>& c)
    {
        const auto numbers = gnomon_bit_cast<std::array<float, texel{}.size()>>(c);
        texel t{};
        for (std::size_t k = 0; k < t.size(); ++k) t[k] = unorm_encode<bits>(numbers[k]);
        return t;
    }
    static constexpr Channels<float> decode(const texel& t)
    {
        std::array<float, texel{}.size()> numbers{};
        for (std::size_t k = 0; k < t.size(); ++k) numbers[k] = unorm_decode<bits>(t[k]);
        return gnomon_bit_cast<Channels<float>>(numbers);
    }
    static void encode_row(const float* numbers, texel* to, std::size_t count)
    {
        unorm_encode_row<bits>(numbers, to->data(), count * texel{}.size());
    }
    static void decode_row(const texel* from, float* numbers, std::size_t count)
    {
        unorm_decode_row<bits>(from->data(), numbers, count * texel{}.size());
    }
};

/// Half floats.
template <template <class...> class Channels> struct half_texel : coded_texel<Channels, std::uint16_t> {
    using typename coded_texel<Channels, std::uint16_t>::texel;
    static constexpr texel encode(const Channels<float>& c)
    {
        const auto numbers = gnomon_bit_cast<std::array<float, texel{}.size()>>(c);
        texel t{};
        for (std::size_t k = 0; k < t.size(); ++k) t[k] = half_encode(numbers[k]);
        return t;
    }
    static constexpr Channels<float> decode(const texel& t)
    {
        std::array<float, texel{}.size()> numbers{};
        for (std::size_t k = 0; k < t.size(); ++k) numbers[k] = half_decode(t[k]);
        return gnomon_bit_cast<Channels<float>>(numbers);
    }
    static void encode_row(const float* numbers, texel* to, std::size_t count)
    {
        std::uint16_t* const codes = to->data();
        for (std::size_t i = 0; i < count * texel{}.size(); ++i) codes[i] = half_encode(numbers[i]);
    }
    static void decode_row(const texel* from, float* numbers, std::size_t count)
    {
        const std::uint16_t* const codes = from->data();
        for (std::size_t i = 0; i < count * texel{}.size(); ++i) numbers[i] = half_decode(codes[i]);
    }
};

/// Floats.
template <template <class...> class Channels> struct float_texel : coded_texel<Channels, float> {
    using typename coded_texel<Channels, float>::texel;
    static constexpr texel encode(const Channels<float>& c) { return gnomon_bit_cast<texel>(c); }
    static constexpr Channels<float> decode(const texel& t) { return gnomon_bit_cast<Channels<float>>(t); }
    static void encode_row(const float* numbers, texel* to, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i, numbers + i * texel{}.size(), sizeof(texel));
    }
    static void decode_row(const texel* from, float* numbers, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) std::memcpy(numbers + i * texel{}.size(), from + i, sizeof(texel));
    }
};

/// True unless a channel is NaN.
template <class Channels> constexpr bool are_known(const Channels& c)
{
    const auto numbers = gnomon_bit_cast<std::array<float, sizeof(Channels) / sizeof(float)>>(c);
    bool known = true;
    for (std::size_t k = 0; k < numbers.size(); k += 2)
        known &= !(std::isunordered)(numbers[k], numbers[(std::min)(k + 1, numbers.size() - 1)]);
    return known;
}

/// A kind of texel with the border of a format that has from_depth: the texel of a depth on the far plane, which shadows
/// nothing and is stored for channels that have a NaN.
template <class Format, class Texel> struct stored_texel : Texel {
    using typename Texel::texel;
    static constexpr auto border() { return Format::from_depth(1.0f); }
    static constexpr texel clear() { return Texel::encode(border()); }
    static constexpr texel encode(const typename Texel::template channels<float>& c)
    {
        if (!are_known(c)) [[unlikely]]
            return clear();
        return Texel::encode(c);
    }
    static void encode_row(const float* numbers, texel* to, std::size_t count) requires requires
    {
        Texel::encode_row(numbers, to, count);
    }
    {
        constexpr std::size_t channels = sizeof(border()) / sizeof(float);
        Texel::encode_row(numbers, to, count);
        int unknown = 0;
        for (std::size_t i = 0; i < count * channels; ++i) unknown |= !(numbers[i] == numbers[i]);
        if (unknown == 0) [[likely]]
            return;
        for (std::size_t i = 0; i < count; ++i, numbers += channels)
            for (std::size_t k = 0; k < channels; ++k)
                if (!(numbers[k] == numbers[k])) to[i] = clear();
    }
};

/// A kind of texel that is cleared to 0, no information, and stores that for channels that have a NaN.
template <class Texel> struct zeroed_texel : Texel {
    using typename Texel::texel;
    template <class Real> using channels = typename Texel::template channels<Real>;
    static constexpr channels<float> border() { return {}; }
    static constexpr texel clear() { return {}; }
    static constexpr texel encode(const channels<float>& c)
    {
        if (!are_known(c)) [[unlikely]]
            return clear();
        return Texel::encode(c);
    }
};

GNOMON_NAMESPACE_END
#endif
