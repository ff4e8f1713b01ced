// Paths of receivers by orthographic lights and by lights in perspective, where they are in extended precision, and the
// loop over their texels that a caller writes.
#pragma once

#include "receiver_cases.hpp"

namespace gnomon::test {

/// A path over up to size x size texels, w from 1/2 to 2; sometimes of no length, along an axis, or over texels'
/// corners.
template <class T> receiver_path<T> any_path(bit_source& bits, double size)
{
    const bool perspective = bits.chance(0.5), lattice = bits.chance(0.2);
    const double w0 = perspective ? bits.uniform(0.5, 2) : 1, w1 = perspective ? bits.uniform(0.5, 2) : 1;
    const auto position = [&] {
        const double x = bits.uniform(0, size);
        return lattice ? std::floor(x) : x;
    };
    const double x0 = position(), y0 = position();
    const bool rests = bits.chance(0.05);
    const double x1 = rests || bits.chance(0.1) ? x0 : position(), y1 = rests || bits.chance(0.1) ? y0 : position();
    const double t0 = bits.chance(0.5) ? 0 : bits.uniform(0, 0.45), t1 = bits.chance(0.5) ? 1 : bits.uniform(0.55, 1);
    receiver_path<T> p;
    p.depth = {T(t0), T(t1), T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1)), T(bits.below(3))};
    p.x0 = T(x0 * w0), p.y0 = T(y0 * w0), p.w0 = T(w0);
    p.x1 = T(x1 * w1), p.y1 = T(y1 * w1), p.w1 = T(w1);
    return p;
}

struct exact_position {
    wide x, y, w;
};
template <class T> exact_position exact_path_at(const receiver_path<T>& p, wide t)
{
    const wide s = (t - wide(p.depth.t0)) / (wide(p.depth.t1) - wide(p.depth.t0));
    const auto between = [&](T a, T b) { return wide(a) * (1 - s) + wide(b) * s; };
    const wide w = between(p.w0, p.w1);
    return {between(p.x0, p.x1) / w, between(p.y0, p.y1) / w, w};
}

template <class T, class F> void for_each_texel(const receiver_path<T>& p, F f)
{
    texel_sweep<T> sweep = texel_sweep_begin(p);
    f(sweep);
    while (sweep.t_end < p.depth.t1) {
        sweep = texel_sweep_next(sweep);
        f(sweep);
    }
}

} // namespace gnomon::test
