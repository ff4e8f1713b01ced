// Operands of benches: as many independent numbers as a kernel has parameters.
#pragma once

#include "measure.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// Numbers in [low, high].
template <std::size_t n> struct uniform : compilation {
    static constexpr std::size_t inputs = n;
    static std::vector<std::array<double, n>> samples(std::size_t count, std::uint64_t seed, double low, double high)
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> value(low, high);
        std::vector<std::array<double, n>> result(count);
        for (auto& operands : result)
            for (double& x : operands) x = value(random);
        return result;
    }
};

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
