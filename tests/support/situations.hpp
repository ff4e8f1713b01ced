// Random inputs of kernels: a depth distribution with a receiver and a texel, and moments, matrices, triangles,
// receivers and lists of ranges.
#pragma once

#include "distributions.hpp"
#include "hostile.hpp"
#include "moments_of.hpp"
#include "moving_triangles.hpp"

#include <gnomon/motion/range/range_list.h>
#include <gnomon/motion/receiver/moving_receiver.h>
#include <gnomon/motion/triangle/triangle_setup.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace gnomon::test {

/// The situation of one row: six moments of a distribution, a receiver, and one of the depths of the distribution.
struct situation {
    std::array<double, 6> b;
    double receiver, texel;
};

inline std::vector<situation> draw_situations(std::size_t count, std::uint64_t seed)
{
    distribution_source source(seed);
    std::vector<situation> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const distribution d = source.draw(family(i % family_count));
        const double receiver = source.receiver(d);
        result[i] = {moments_of<6>(d), receiver, d.depths[i / family_count % d.depths.size()]};
    }
    return result;
}

template <class T> moments4<T> moments4_in(const situation& s) { return moments4_in<T>(s.b); }
template <class T> moments6<T> moments6_in(const situation& s) { return moments6_in<T>(s.b); }

/// The channels of a format as encode gives them, averaged over two depths.
template <class T, class Encode> auto mixture(const situation& s, bit_source& bits, Encode encode)
{
    auto channels = encode(T(s.texel));
    const auto other = encode(T(s.b[0]));
    std::array<T, sizeof channels / sizeof(T)> a, b;
    std::memcpy(a.data(), &channels, sizeof channels);
    std::memcpy(b.data(), &other, sizeof other);
    const T weight = T(bits.uniform(0, 1));
    for (std::size_t k = 0; k < a.size(); ++k) a[k] = a[k] + weight * (b[k] - a[k]);
    std::memcpy(&channels, a.data(), sizeof channels);
    return channels;
}

template <class T> double any_number(bit_source& bits)
{
    if (bits.chance(0.1)) return double(bits.below(9)) - 4;
    return std::ldexp(bits.uniform(-1, 1), int(bits.below(61)) - 30);
}

/// Coefficients b, c, d of a cubic t^3 + b t^2 + c t + d with three real roots, sometimes close together.
inline std::array<double, 3> monic_cubic(bit_source& bits)
{
    const double r = bits.uniform(-2, 2), s = bits.chance(0.3) ? r * (1 + bits.uniform(0, 1e-3)) : bits.uniform(-2, 2);
    const double t = bits.uniform(-2, 2);
    return {-(r + s + t), r * s + s * t + t * r, -r * s * t};
}

template <class T> hankel4<T> any_hankel4(const situation& s, bit_source& bits)
{
    const moments4<T> b = moments4_in<T>(s);
    switch (bits.below(4)) {
        case 0:
            return hankel4_from_moments(b);
        case 1:
            return hankel4_from_half(channels4_shifted(theta4(b), T(-0.5)));
        case 2:
            return hankel4_constant_bias(b, T(bias4_raw_b2), T(bias4_raw_b4), T(stored4_float_weight));
        default:
            return hankel4_from_float(channels4_from_moments(b));
    }
}

template <class T> hankel6<T> any_hankel6(const situation& s, bit_source& bits)
{
    const moments6<T> b = moments6_in<T>(s);
    switch (bits.below(3)) {
        case 0:
            return hankel6_from_moments(b);
        case 1:
            return hankel6_constant_bias(b, T(bias6_raw_b2), T(bias6_raw_b4), T(bias6_raw_b6), T(stored6_float_weight));
        default:
            return hankel6_from_float(channels6_from_moments(b));
    }
}

/// A moving triangle and a sample, as T, and the edge functions between them.
template <class T> struct seen_triangle {
    moving_triangle<T> triangle;
    moving_edges<T> edges;
};

template <class T> seen_triangle<T> any_seen_triangle(bit_source& bits)
{
    const moving_scene scene = draw_moving_scene(movement(bits.below(movement_count)), bits);
    const moving_triangle<T> triangle = rounded_triangle<T>(scene.triangle);
    return {triangle, moving_triangle_edges(triangle, T(scene.s_x), T(scene.s_y))};
}

/// A moving triangle and its setup around some origin.
template <class T> struct setup_and_triangle {
    triangle_setup<T> setup;
    moving_triangle<T> triangle;
};

template <class T> setup_and_triangle<T> any_setup_and_triangle(bit_source& bits)
{
    const moving_triangle<T> m = any_seen_triangle<T>(bits).triangle;
    return {triangle_setup_make(m, T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1))), m};
}

template <class T> depth_setup<T> any_depth_setup(bit_source& bits)
{
    const setup_and_triangle<T> x = any_setup_and_triangle<T>(bits);
    return depth_setup_make(x.setup, x.triangle);
}

/// The depth curve at a sample near the origin.
template <class T> depth_curve<T> any_depth_curve(bit_source& bits)
{
    const setup_and_triangle<T> x = any_setup_and_triangle<T>(bits);
    const T s_x = T(bits.uniform(-1, 1)), s_y = T(bits.uniform(-1, 1));
    return moving_depth_curve(depth_setup_make(x.setup, x.triangle), triangle_setup_edges(x.setup, s_x, s_y), s_x, s_y);
}

/// A receiver on a path over some texels, in an orthographic or a perspective light, with a step of its sweep and its
/// state there, half of the time with bilinear weights.
template <class T> struct seen_receiver {
    receiver_path<T> path;
    texel_sweep<T> sweep;
    moving_receiver<T> state;
};

template <class T> seen_receiver<T> any_seen_receiver(const situation& s, bit_source& bits)
{
    seen_receiver<T> r{};
    const double begin = bits.uniform(0, 1), end = bits.uniform(0, 1);
    r.path.depth = range_between(T(begin), T(s.receiver), T(end), T(bits.uniform(-1, 1)), T(bits.below(4)));
    const bool perspective = bits.chance(0.5);
    r.path.w0 = perspective ? T(bits.uniform(0.5, 4)) : T(1);
    r.path.w1 = perspective ? T(bits.uniform(0.5, 4)) : T(1);
    r.path.x0 = T(bits.uniform(-4, 4)) * r.path.w0, r.path.y0 = T(bits.uniform(-4, 4)) * r.path.w0;
    r.path.x1 = T(bits.uniform(-4, 4)) * r.path.w1, r.path.y1 = T(bits.uniform(-4, 4)) * r.path.w1;
    r.sweep = texel_sweep_begin(r.path);
    for (std::size_t k = bits.below(6); k > 0; --k) r.sweep = texel_sweep_next(r.sweep);
    r.state = moving_receiver_texel(moving_receiver_begin(r.path, T(0), T(1)), r.sweep);
    if (bits.chance(0.5))
        r.state = moving_receiver_tap(r.state, r.sweep, T(bits.below(2)), T(bits.below(2)), T(1 + bits.below(2)));
    return r;
}

/// A list of up to 15 insertions of few depths, so that ranges occlude and cross one another and some lists are full.
template <class T> range_list<T> any_range_list(const situation& s, bit_source& bits)
{
    range_list<T> list = range_list_make(depth_time_range<T>{});
    for (std::size_t i = bits.below(16); i > 0; --i) {
        const T z = T(bits.chance(0.2) ? s.texel : s.receiver + bits.uniform(-0.5, 0.5));
        const T other = bits.chance(0.3) ? z : T(bits.uniform(-1, 1));
        list = range_list_insert(
            list, range_between(T(bits.uniform(0, 1)), z, T(double(bits.below(9)) / 8), other, T(bits.below(4))));
    }
    return list;
}

} // namespace gnomon::test
