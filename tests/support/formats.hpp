// Every storage format, and texels with a hostile channel.
#pragma once

#include "hostile.hpp"

#include <gnomon/passes/map_view.hpp>
#include <gnomon/storage/formats.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <tuple>
#include <type_traits>

namespace gnomon::test {

/// Calls each.template operator()<Format>() for every storage format.
template <class Each> void for_each_format(Each each)
{
    [&]<class... Format>(std::tuple<Format...>*) {
        (each.template operator()<Format>(), ...);
    }(static_cast<storage_formats*>(nullptr));
}

/// The larger of both intensities, after one rounding to the format and after a filter of two passes.
template <class Format> double larger_intensity(const format_channels<Format>& c, float z_f)
{
    return std::max(double(Format::intensity(c, z_f)), double(Format::filtered_intensity(c, z_f)));
}

/// The most by which either intensity darkens a lit surface.
template <class Format> double larger_darkening()
{
    return std::max(double(Format::darkening), double(Format::filtered_darkening));
}

template <class Format> format_texel<Format> texel_of_depth(float z) { return Format::encode(Format::from_depth(z)); }

template <class T> bool same_bytes(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// True if texels of the format may hold a NaN.
template <class Format> bool holds_nan()
{
    format_texel<Format> t;
    std::memset(&t, 0xff, sizeof t);
    return !are_known(Format::decode(t));
}

/// A texel of depth z with x in the given channel, or in all channels: the bits of x where the format holds them, as if
/// written by somebody else, and the result of encode elsewhere.
template <class Format> format_texel<Format> texel_with(float z, float x, std::size_t channel, bool all)
{
    auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(z));
    if (all) c.fill(x);
    else c[channel] = x;
    format_texel<Format> t = store_channels<Format>(c);
    if constexpr (requires { t[channel]; }) {
        using code = std::remove_cvref_t<decltype(t[channel])>;
        if (!holds_nan<Format>() || t.size() != c.size()) return t;
        const format_texel<Format> plain = texel_of_depth<Format>(z);
        for (std::size_t k = 0; k < t.size(); ++k) {
            t[k] = plain[k];
            if (!all && k != channel) continue;
            if constexpr (std::is_same_v<code, float>) t[k] = x;
            else if constexpr (std::is_same_v<code, std::uint16_t>) t[k] = half_encode(x);
        }
    }
    return t;
}

} // namespace gnomon::test
