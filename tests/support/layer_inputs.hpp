// Random inputs of the kernels of layers: samples of a stochastic shadow map around a tile, in one or more clusters of depth
// and motion, and what the folds over them return.
#pragma once

#include "situations.hpp"

#include <gnomon/motion/layers/layer_look_up.h>
#include <gnomon/motion/layers/layer_parts.h>

namespace gnomon::test {

/// A sample of one of four surfaces, of the background, or at the depth of the situation.
template <class T> stochastic_sample<T> any_stochastic_sample(const situation& s, bit_source& bits)
{
    const double x = bits.uniform(-8, 8), y = bits.uniform(-8, 8), t = bits.uniform(0, 1);
    if (bits.chance(0.1)) return stochastic_background(T(x), T(y), T(t));
    const double surface = double(bits.below(4)), scale = std::exp2(bits.uniform(-8, 8));
    const double z = bits.chance(0.3) ? s.texel : (surface - 1.5) / 2 + bits.uniform(-0.05, 0.05);
    return {T(x),      T(y), T(t), T(z), T(scale * bits.uniform(-1, 1)), T(scale * surface), T(bits.uniform(-0.3, 0.3)),
            T(surface)};
}

template <class T> layer_window<T> any_layer_window(const situation& s, bit_source& bits)
{
    layer_window<T> w = layer_window_begin(T(s.texel));
    for (std::size_t n = bits.below(4); n > 0; --n)
        w = layer_window_add(w, layer_middle_depth(any_stochastic_sample<T>(s, bits)));
    return w;
}

/// The state after up to 64 bins, few of which are occupied.
template <class T> layer_runs<T> any_layer_runs(const situation& s, bit_source& bits)
{
    layer_runs<T> r = layer_cuts_begin(any_layer_window<T>(s, bits));
    for (std::size_t n = bits.below(65); n > 0; --n) r = layer_cuts_add(r, T(bits.chance(0.2)));
    return r;
}

template <class T> layer_motion_sums<T> any_layer_motion_sums(const situation& s, bit_source& bits)
{
    layer_motion_sums<T> r = layer_motion_begin(any_stochastic_sample<T>(s, bits));
    for (std::size_t n = bits.below(5); n > 0; --n) {
        const stochastic_sample<T> next = any_stochastic_sample<T>(s, bits);
        r = layer_motion_add(r, next, layer_middle_depth(next));
    }
    return r;
}

template <class T> layer_motion<T> any_layer_motion(const situation& s, bit_source& bits)
{
    return layer_motion_end(any_layer_motion_sums<T>(s, bits));
}

template <class T> layer_grid<T> any_layer_grid(const situation& s, bit_source& bits)
{
    return layer_grid_make(any_layer_motion<T>(s, bits), T(bits.chance(0.5) ? 12 : 16), T(bits.chance(0.5) ? 8 : 16));
}

template <class T> layer_footprint<T> any_layer_footprint(const situation& s, bit_source& bits)
{
    const layer_grid<T> grid = any_layer_grid<T>(s, bits);
    const auto place = [&] { return T(bits.uniform(-8, 8)); };
    const T t0 = T(bits.uniform(0, 0.75)), t1 = t0 + T(0.25);
    return layer_footprint_make(grid, place(), place(), t0, place(), place(), t1, place(), place(), T(bits.below(2)));
}

template <class T> layer_direction_sums<T> any_layer_direction_sums(const situation& s, bit_source& bits)
{
    layer_direction_sums<T> r = layer_direction_begin(any_layer_motion<T>(s, bits));
    for (std::size_t n = bits.below(5); n > 0; --n) {
        const stochastic_sample<T> next = any_stochastic_sample<T>(s, bits);
        r = layer_direction_add(r, next, layer_middle_depth(next));
    }
    return r;
}

/// The sums over some samples at two depths, with their shares, by add(sums, z, share).
template <class T, class Sums> Sums any_layer_sums(const situation& s, bit_source& bits, auto add)
{
    Sums r{};
    for (std::size_t n = bits.below(8); n > 0; --n)
        r = add(r, T(bits.chance(0.5) ? s.texel : s.receiver), layer_share_of(T(bits.below(5)), T(1)));
    return r;
}

} // namespace gnomon::test
