// Stacks of translucent fragments over an opaque surface, and their shadow by the product of transmittances.
#pragma once

#include "distributions.hpp"
#include "hostile.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace gnomon::test {

/// Depths and opacities, back to front, in front of an opaque surface.
struct stack {
    double behind = 1;
    std::vector<double> depths, alphas;

    [[nodiscard]] std::size_t size() const { return depths.size(); }

    /// The light that reaches z_f, from in front: that of fragments and of the surface behind.
    [[nodiscard]] double transmittance(double z_f) const
    {
        double left = behind < z_f ? 0 : 1;
        for (std::size_t k = 0; k < size(); ++k) left *= depths[k] < z_f ? 1 - alphas[k] : 1;
        return left;
    }

    /// The depth distribution, each fragment weighted by the light that it takes away.
    [[nodiscard]] distribution weighted() const
    {
        distribution d{{behind}, {1}};
        for (std::size_t k = 0; k < size(); ++k) {
            for (double& w : d.weights) w *= 1 - alphas[k];
            d.depths.push_back(depths[k]);
            d.weights.push_back(alphas[k]);
        }
        return d;
    }
};

/// A stack of at most so many fragments, some at one depth, with opacities of all magnitudes.
inline stack any_stack(bit_source& bits, std::size_t most = 12)
{
    stack s;
    s.behind = bits.chance(0.5) ? 1 : bits.uniform(-1, 1);
    for (std::size_t n = bits.below(most + 1); n > 0; --n) {
        const bool again = !s.depths.empty() && bits.chance(0.2);
        s.depths.push_back(again ? s.depths.back() : bits.uniform(-1, s.behind));
    }
    std::sort(s.depths.begin(), s.depths.end(), std::greater<>());
    for (std::size_t k = 0; k < s.size(); ++k)
        s.alphas.push_back(bits.chance(0.1)   ? double(bits.below(2))
                           : bits.chance(0.5) ? bits.uniform(0, 1)
                                              : std::exp2(bits.uniform(-12, 0)));
    return s;
}

} // namespace gnomon::test
