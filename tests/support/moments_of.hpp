// Moments as a map holds them: those of a distribution, rounded once, and those of a scene after two filter passes.
#pragma once

#include "contacts.hpp"

#include <gnomon/moments/moments.h>
#include <gnomon/storage/format.hpp>

#include <array>

namespace gnomon::test {

/// The moments b_1 to b_m of a distribution, summed in double.
template <std::size_t m> std::array<double, m> moments_of(const distribution& d)
{
    std::array<double, m> b{};
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        double p = d.weights[i];
        for (double& moment : b) moment += p *= d.depths[i];
    }
    return b;
}

/// The first four of b_1, b_2, ... as T.
template <class T, std::size_t m> moments4<T> moments4_in(const std::array<double, m>& b)
{
    return {T(b[0]), T(b[1]), T(b[2]), T(b[3])};
}

/// The first six of b_1, b_2, ... as T.
template <class T> moments6<T> moments6_in(const std::array<double, 6>& b)
{
    return {T(b[0]), T(b[1]), T(b[2]), T(b[3]), T(b[4]), T(b[5])};
}

/// The moments of a distribution, rounded once to float.
inline moments4<float> moments4_of(const distribution& d) { return moments4_in<float>(moments_of<4>(d)); }
inline moments6<float> moments6_of(const distribution& d) { return moments6_in<float>(moments_of<6>(d)); }

/// The moments b in double.
template <class T> moments4<double> in_double(const moments4<T>& b)
{
    return {double(b.b1), double(b.b2), double(b.b3), double(b.b4)};
}
template <class T> moments6<double> in_double(const moments6<T>& b)
{
    return {double(b.b1), double(b.b2), double(b.b3), double(b.b4), double(b.b5), double(b.b6)};
}
template <class T> channels4<double> in_double(const channels4<T>& c)
{
    return {double(c.c1), double(c.c2), double(c.c3), double(c.c4)};
}
template <class T> channels6<double> in_double(const channels6<T>& c)
{
    return {double(c.c1), double(c.c2), double(c.c3), double(c.c4), double(c.c5), double(c.c6)};
}

/// The channels of a distribution, rounded once to the format.
template <class Format> format_channels<Format> stored_channels(const distribution& d)
{
    const auto moments = moments_of<channel_count<Format>>(d);
    if constexpr (channel_count<Format> == 4)
        return Format::decode(Format::encode(Format::from_moments(moments4_in<float>(moments))));
    else return Format::decode(Format::encode(Format::from_moments(moments6_in<float>(moments))));
}

/// The mean of the texels of a distribution's depths, each rounded once to the format; the mean is rounded to float.
template <class Format> format_channels<Format> mixed_channels(const distribution& d)
{
    std::array<double, channel_count<Format>> sum{};
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        const auto texel = Format::encode(Format::from_depth(float(d.depths[i])));
        const auto c = gnomon_bit_cast<channel_array<Format>>(Format::decode(texel));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += d.weights[i] * double(c[k]);
    }
    channel_array<Format> mean{};
    for (std::size_t k = 0; k < sum.size(); ++k) mean[k] = float(sum[k]);
    return gnomon_bit_cast<format_channels<Format>>(mean);
}

/// The weighted sum of nine texels' channels, in float.
template <class Format>
format_channels<Format> weighted_sum(const std::array<format_texel<Format>, 9>& texels,
                                     const std::array<float, 9>& taps)
{
    channel_array<Format> sum{};
    for (std::size_t i = 0; i < 9; ++i) {
        const auto c = gnomon_bit_cast<channel_array<Format>>(Format::decode(texels[i]));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = sum[k] + c[k] * taps[i];
    }
    return gnomon_bit_cast<format_channels<Format>>(sum);
}

/// The channels at the centre of a scene, rounded to the format when rendered and after each of two filter passes,
/// which sum in float.
template <class Format> format_channels<Format> filtered_channels(const contact& scene)
{
    const auto pass = [&](const auto& texels) { return Format::encode(weighted_sum<Format>(texels, scene.taps)); };
    std::array<format_texel<Format>, 9> row{}, column{};
    for (std::size_t j = 0; j < 9; ++j) {
        for (std::size_t i = 0; i < 9; ++i) row[i] = Format::encode(Format::from_depth(scene.depths[j][i]));
        column[j] = pass(row);
    }
    return Format::decode(pass(column));
}

} // namespace gnomon::test
