// Percentage-closer filtering under the very weights that the filterable maps are filtered with: the resolve of four
// samples, the two-pass Gaussian, the boxes of the mip levels, and the trilinear look-up, multiplied out into one
// weight per sample. What a filterable map differs from it by is reconstruction error alone.
#pragma once

#include "depth_map.hpp"
#include "receivers.hpp"

#include <gnomon/filters/percentage_closer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// Weights of the base level's texels first, first + 1, ... along one axis.
template <class Real> struct footprint {
    int first = 0;
    std::vector<Real> weights;
};

template <class Real>
void set_footprint(footprint<Real>& result, float coordinate, int level, int resolution, std::span<const float> taps)
{
    const int radius = static_cast<int>(taps.size() / 2), box = 1 << level, size = resolution >> level;
    const double x = static_cast<double>(coordinate) * size - 0.5, left = std::floor(x);
    const auto texel = [&](int k) { return std::clamp(static_cast<int>(left) + k, 0, size - 1) * box; };
    result.first = std::max(texel(0) - radius, 0);
    const int last = std::min(texel(1) + box - 1 + radius, resolution - 1);
    result.weights.assign(static_cast<std::size_t>(last - result.first + 1), Real(0));
    for (int k = 0; k < 2; ++k) {
        const double share = (k == 0 ? 1 - (x - left) : x - left) / box;
        for (int i = texel(k); i < texel(k) + box; ++i)
            for (int t = -radius; t <= radius; ++t) {
                const int base = std::clamp(i + t, 0, resolution - 1);
                result.weights[static_cast<std::size_t>(base - result.first)] +=
                    Real(share * static_cast<double>(taps[static_cast<std::size_t>(t + radius)]));
            }
    }
}

// The weighted share of samples that are closer to the light than the receiver.
template <class Real>
Real percentage_closer_intensity(const depth_map& depths, const map_receiver& where, std::span<const float> taps)
{
    thread_local footprint<Real> columns, rows;
    const int coarsest = static_cast<int>(std::log2(depths.width));
    const double level = std::min(static_cast<double>(where.level), double(coarsest)), fine = std::floor(level);
    auto state = percentage_closer_begin(Real(where.depth));
    for (const int k : {0, 1}) {
        const Real share = Real(0.25 * (k == 0 ? 1 - (level - fine) : level - fine));
        if (!(share > 0)) continue;
        const int l = static_cast<int>(fine) + k;
        set_footprint(columns, where.u, l, depths.width, taps);
        set_footprint(rows, where.v, l, depths.height, taps);
        for (std::size_t j = 0; j < rows.weights.size(); ++j) {
            const auto* samples = &depths(columns.first, rows.first + static_cast<int>(j));
            for (std::size_t i = 0; i < columns.weights.size(); ++i)
                for (const float z : samples[i])
                    state = percentage_closer_add(state, Real(z), share * rows.weights[j] * columns.weights[i]);
        }
    }
    return percentage_closer_end(state);
}

} // namespace gnomon::evaluation
