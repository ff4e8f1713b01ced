// Triangles and fragments of prisms, and ranges some of which cover a texel throughout the shutter.
#pragma once

#include "hostile.hpp"

#include <gnomon/comparators/prism.h>
#include <gnomon/comparators/three_pass_cover.h>
#include <gnomon/motion/range/range_cover.h>

#include <algorithm>

namespace gnomon::test {

/// A triangle of the prism of m, with a sample that is inside in three of four draws.
template <class T> struct seen_prism_triangle {
    prism_triangle<T> triangle;
    T s_x, s_y;
};

template <class T> seen_prism_triangle<T> any_seen_prism_triangle(const moving_triangle<T>& m, bit_source& bits)
{
    const auto triangle = prism_triangle_make(prism_make(m, T(1)), T(bits.below(14)));
    double a = bits.uniform(0, 1), b = bits.uniform(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    if (bits.chance(0.25)) a = -a;
    const auto mean = [&](T u, T v, T w) { return T(a * double(u) + b * double(v) + (1 - a - b) * double(w)); };
    return {triangle, mean(triangle.a.x, triangle.b.x, triangle.c.x), mean(triangle.a.y, triangle.b.y, triangle.c.y)};
}

/// The pair of all fragments of a prism at a sample.
template <class T> prism_pair<T> pair_at(const prism<T>& p, T s_x, T s_y, T divided = 1)
{
    prism_pair<T> pair = prism_pair_begin(T(7));
    for (int k = 0; k < 14; ++k)
        pair = prism_pair_add(pair, prism_fragment_at(prism_triangle_make(p, T(k)), s_x, s_y, divided));
    return pair;
}

/// A random fragment, sometimes at an end of the shutter.
template <class T> prism_fragment<T> any_prism_fragment(bit_source& bits)
{
    return {T(bits.chance(0.9) ? 1 : 0), T(bits.chance(0.3) ? double(bits.below(2)) : bits.uniform(0, 1)),
            T(bits.uniform(-1, 1))};
}

template <class T> timed_fragment<T> any_timed_fragment(bit_source& bits)
{
    const prism_fragment<T> f = any_prism_fragment<T>(bits);
    return {f.time, f.depth, T(bits.below(4))};
}

/// A random range, half of the time over the whole shutter.
template <class T> depth_time_range<T> any_cover_range(bit_source& bits)
{
    const double a = bits.uniform(0, 1), b = bits.uniform(0, 1), z = bits.uniform(-1, 1);
    const bool full = bits.chance(0.5), level = bits.chance(0.3);
    return {T(full ? 0 : std::min(a, b)), T(full ? 1 : std::max(a, b)), T(z), T(level ? z : bits.uniform(-1, 1)),
            T(bits.below(4))};
}

} // namespace gnomon::test
