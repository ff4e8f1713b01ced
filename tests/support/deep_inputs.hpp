// Random layers, windows, time moments and samples of the maps that collapse or slice time.
#pragma once

#include "situations.hpp"

#include <gnomon/motion/range/deep_shadow.h>
#include <gnomon/motion/range/range_moments.h>
#include <gnomon/motion/receiver/time_dependent.h>

#include <cmath>
#include <cstddef>

namespace gnomon::test {

template <class T> deep_layer<T> any_deep_layer(const situation& s, bit_source& bits)
{
    return {T(s.texel), T(bits.chance(0.3) ? s.texel : s.texel + bits.uniform(0, 0.5)), T(bits.uniform(0, 1))};
}

/// A window after some vertices, of steps and slopes.
template <class T> deep_window<T> any_deep_window(bit_source& bits)
{
    deep_window<T> state = deep_window_begin(T(bits.uniform(0, 0.25)));
    T z = -1, v = 1;
    for (std::size_t n = bits.below(8); n > 0; --n) {
        if (bits.chance(0.5)) z += T(bits.uniform(0, 0.25));
        if (bits.chance(0.7)) v -= T(bits.uniform(0, 0.25));
        state = deep_window_add(state, z, v);
    }
    return state;
}

template <class T> range_moments4<T> any_range_moments4(const situation& s, bit_source& bits)
{
    const depth_time_range<T> r{T(0), T(bits.uniform(0, 1)), T(s.texel), T(s.receiver), T(0)};
    return range_moments4_add(range_moments4_begin(T(1)), r);
}

template <class T> time_dependent_sample<T> any_time_dependent_sample(const situation& s, bit_source& bits)
{
    return {T(s.texel), T(bits.uniform(0, 1)), T(bits.uniform(-1, 1)), T(std::exp2(bits.uniform(-8, 8)))};
}

} // namespace gnomon::test
