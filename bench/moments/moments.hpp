// What the moment kernels read in a bench: moments of the 13 adversarial families of tests/support in turn, with a
// receiver each.
#ifndef GNOMON_BENCH_MOMENTS_HPP
#define GNOMON_BENCH_MOMENTS_HPP

#include "support/distributions.hpp"

#include <gnomon/moments/quantization.h>

namespace gnomon::bench {

/// Operands b1, ..., bm and z_f.
template <std::size_t m> struct moments_and_receiver {
    static constexpr std::size_t inputs = m + 1;

    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::distribution_source source(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const test::distribution d = source.draw(static_cast<test::family>(i % test::family_count));
            for (std::size_t k = 0; k < d.depths.size(); ++k) {
                double p = d.weights[k];
                for (std::size_t j = 0; j < m; ++j) result[i][j] += p *= d.depths[k];
            }
            result[i][m] = source.receiver(d);
        }
        return result;
    }
};

/// The moments behind their quantization transform, as channels in [0, 1], and z_f.
template <std::size_t m> struct channels_and_receiver {
    static constexpr std::size_t inputs = m + 1;

    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        auto result = moments_and_receiver<m>::samples(count, seed);
        for (auto& s : result) {
            if constexpr (m == 4) {
                const auto c = theta4(moments4<double>{s[0], s[1], s[2], s[3]});
                s = {c.b1, c.b2, c.b3, c.b4, s[4]};
            } else {
                const auto c = theta6(moments6<double>{s[0], s[1], s[2], s[3], s[4], s[5]});
                s = {c.b1, c.b2, c.b3, c.b4, c.b5, c.b6, s[6]};
            }
        }
        return result;
    }
};

} // namespace gnomon::bench
#endif
