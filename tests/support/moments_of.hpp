// Moments as a map holds them: those of a distribution, rounded once, and those of a scene after two filter passes.
#pragma once

#include "contacts.hpp"

#include <gnomon/moments/moments.h>

#include <type_traits>

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

/// The channels at the centre of a scene, rounded to the format when rendered and after each of two filter passes,
/// which sum in float.
template <class Format> typename Format::moments filtered_moments(const contact& scene)
{
    constexpr bool four = std::is_same_v<typename Format::moments, moments4<float>>;
    const auto pass = [&](const auto& texels) {
        typename Format::moments sum{};
        for (std::size_t i = 0; i < 9; ++i)
            if constexpr (four) sum = moments4_add(sum, Format::decode(texels[i]), scene.taps[i]);
            else sum = moments6_add(sum, Format::decode(texels[i]), scene.taps[i]);
        return Format::encode_channels(sum);
    };
    const auto rendered = [](float z) {
        if constexpr (four) return Format::encode(moments4_from_depth(z));
        else return Format::encode(moments6_from_depth(z));
    };
    std::array<typename Format::texel, 9> row{}, column{};
    for (std::size_t j = 0; j < 9; ++j) {
        for (std::size_t i = 0; i < 9; ++i) row[i] = rendered(scene.depths[j][i]);
        column[j] = pass(row);
    }
    return Format::decode(pass(column));
}

} // namespace gnomon::test
