// Samples around a tile, and the layers that the kernels make of them, for tests.
#pragma once

#include "support/layer_inputs.hpp"
#include "support/rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace gnomon::test {

using wide = long double;

template <class T> using sample_list = std::vector<stochastic_sample<T>>;

template <class T> std::vector<T> middle_depths(const sample_list<T>& samples)
{
    std::vector<T> z;
    for (const auto& s : samples) z.push_back(layer_middle_depth(s));
    return z;
}

template <class T> layer_window<T> window_of(const std::vector<T>& middle)
{
    layer_window<T> w = layer_window_begin(std::numeric_limits<T>::quiet_NaN());
    for (const T z : middle) w = layer_window_add(w, z);
    return w;
}

/// The 64 bins of a window, true if occupied.
template <class T> std::array<bool, 64> occupied_bins(const std::vector<T>& middle, const layer_window<T>& window)
{
    std::array<bool, 64> bins{};
    for (const T z : middle)
        if (const T bin = layer_bin_of(z, window); bin >= 0) bins[std::size_t(bin)] = true;
    return bins;
}

template <class T> layer_cuts<T> cuts_at(const std::array<bool, 64>& bins, const layer_window<T>& window, T layers)
{
    layer_runs<T> state = layer_cuts_begin(window);
    for (const bool occupied : bins) state = layer_cuts_add(state, T(occupied));
    return layer_cuts_end(state, layers);
}

template <class T> layer_cuts<T> cuts_of(const std::vector<T>& middle, T layers)
{
    const layer_window<T> window = window_of(middle);
    return cuts_at(occupied_bins(middle, window), window, layers);
}

/// The motion of the samples of a layer. Without any it is that of no samples.
template <class T> layer_motion<T> motion_of(const sample_list<T>& samples, const layer_cuts<T>& cuts, T layer)
{
    layer_motion_sums<T> state = layer_motion_begin(stochastic_sample<T>{});
    bool begun = false;
    for (const auto& s : samples) {
        const T middle = layer_middle_depth(s);
        if (!(layer_of(middle, cuts) == layer)) continue;
        if (!begun) state = layer_motion_begin(s);
        begun = true;
        state = layer_motion_add(state, s, middle);
    }
    return layer_motion_end(state);
}

template <class T> std::array<T, 3> depths_of(const layer_cuts<T>& c) { return {c.c0, c.c1, c.c2}; }

} // namespace gnomon::test
