// The operands of moment kernels in a bench: moments of the 13 families of tests/support in turn, with a receiver each.
#pragma once

#include "support/moments_of.hpp"

#include <gnomon/moments/quantization.h>

namespace gnomon::bench {

/// The operands b_1 to b_m and z_f.
template <std::size_t m> struct moments_and_receiver {
    static constexpr std::size_t inputs = m + 1;

    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::distribution_source source(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const test::distribution d = source.draw(static_cast<test::family>(i % test::family_count));
            const auto b = test::moments_of<m>(d);
            std::copy(b.begin(), b.end(), result[i].begin());
            result[i][m] = source.receiver(d);
        }
        return result;
    }
};

/// The channels in [0, 1] of the moments after their quantization transform, and z_f.
template <std::size_t m> struct channels_and_receiver {
    static constexpr std::size_t inputs = m + 1;

    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        auto result = moments_and_receiver<m>::samples(count, seed);
        for (auto& s : result) {
            if constexpr (m == 4) {
                const auto c = theta4(moments4<double>{s[0], s[1], s[2], s[3]});
                s = {c.c1, c.c2, c.c3, c.c4, s[4]};
            } else {
                const auto c = theta6(moments6<double>{s[0], s[1], s[2], s[3], s[4], s[5]});
                s = {c.c1, c.c2, c.c3, c.c4, c.c5, c.c6, s[6]};
            }
        }
        return result;
    }
};

} // namespace gnomon::bench
