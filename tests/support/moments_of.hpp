// Moments as a map has them: of a distribution, exact and then rounded, and of a scene that two passes filter.
#pragma once

#include "contacts.hpp"

#include <gnomon/moments/moments.h>

#include <type_traits>

namespace gnomon::test {

/// Summed in double and rounded once.
inline moments4<float> moments4_of(const distribution& d)
{
    std::array<double, 4> b{};
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        double p = d.weights[i];
        for (double& moment : b) moment += p *= d.depths[i];
    }
    return {float(b[0]), float(b[1]), float(b[2]), float(b[3])};
}

/// Channels of a scene's centre, rounded when rendered and in each of two passes, whose sums are of float.
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
