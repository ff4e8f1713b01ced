// Moving triangles with samples near them: static, translated, rotated, deformed, in perspective with w down to 1/50,
// and on a coarse lattice, where vertices coincide with samples, edges pass through samples and areas vanish.
#pragma once

#include "hostile.hpp"

#include <gnomon/motion/triangle/moving_triangle.h>

#include <array>
#include <cmath>

namespace gnomon::test {

enum class movement { still, carried, turned, deformed, perspective, lattice };
inline constexpr std::size_t movement_count = 6;

struct moving_scene {
    moving_triangle<double> triangle;
    double s_x, s_y;
};

namespace detail {

using point = std::array<double, 3>;

inline point any_point(bit_source& bits) { return {bits.uniform(-1, 1), bits.uniform(-1, 1), bits.uniform(-1, 1)}; }

/// p rotated about an axis through a point, by Rodrigues' formula.
inline point turned(const point& p, const point& about, const point& axis, double angle)
{
    const point d{p[0] - about[0], p[1] - about[1], p[2] - about[2]};
    const point cross{axis[1] * d[2] - axis[2] * d[1], axis[2] * d[0] - axis[0] * d[2],
                      axis[0] * d[1] - axis[1] * d[0]};
    const double dot = axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2], c = std::cos(angle), s = std::sin(angle);
    point r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = about[k] + c * d[k] + s * cross[k] + (1 - c) * dot * axis[k];
    return r;
}

inline point moved(const point& p, movement how, const point& shift, const point& axis, double amount, bit_source& bits)
{
    switch (how) {
        case movement::still:
            return p;
        case movement::carried:
            return {amount * p[0] + shift[0], amount * p[1] + shift[1], amount * p[2] + shift[2]};
        case movement::turned:
            return turned(p, shift, axis, 3 * (amount - 1));
        default:
            return any_point(bits);
    }
}

/// The vertex in clip space: orthographic, or at a distance of 1/50 to 4 from the light with depth -1 to 1.
inline std::array<double, 4> projected(const point& p, bool perspective)
{
    if (!perspective) return {p[0], p[1], p[2], 1};
    constexpr double near = 0.02, far = 4;
    const double w = near * std::pow(far / near, 0.5 + 0.5 * p[2]);
    return {p[0] * w, p[1] * w, ((far + near) * w - 2 * far * near) / (far - near), w};
}

inline moving_vertex<double> vertex_between(const std::array<double, 4>& q, const std::array<double, 4>& r)
{
    return {q[0], q[1], q[2], q[3], r[0], r[1], r[2], r[3]};
}

} // namespace detail

/// A random moving triangle and a sample. The triangle covers three of four samples at some time, one of them
/// at a vertex.
inline moving_scene draw_moving_scene(movement how, bit_source& bits)
{
    const detail::point shift = detail::any_point(bits), raw = detail::any_point(bits);
    const double norm = std::hypot(raw[0], raw[1], raw[2]), amount = bits.uniform(0.5, 2);
    const detail::point axis = bits.chance(0.3) || norm == 0
                                   ? detail::point{0, 0, 1}
                                   : detail::point{raw[0] / norm, raw[1] / norm, raw[2] / norm};
    std::array<moving_vertex<double>, 3> v;
    for (auto& vertex : v) {
        const detail::point q = detail::any_point(bits), r = detail::moved(q, how, shift, axis, amount, bits);
        const bool perspective = how == movement::perspective;
        vertex = detail::vertex_between(detail::projected(q, perspective), detail::projected(r, perspective));
    }
    double t = bits.uniform(0, 1), weight = bits.uniform(0, 1), share = bits.uniform(0, 1);
    if (bits.chance(0.3)) t = double(bits.below(2)), weight = 1, share = 1;
    const auto at = [&](double q, double r) { return q + t * (r - q); };
    const auto mean = [&](auto coordinate) {
        return weight * coordinate(v[0]) + (1 - weight) * (share * coordinate(v[1]) + (1 - share) * coordinate(v[2]));
    };
    const double w = mean([&](const auto& p) { return at(p.w0, p.w1); });
    moving_scene scene{{v[0], v[1], v[2]},
                       mean([&](const auto& p) { return at(p.x0, p.x1); }) / w,
                       mean([&](const auto& p) { return at(p.y0, p.y1); }) / w};
    if (bits.chance(0.25)) scene.s_x = bits.uniform(-1, 1), scene.s_y = bits.uniform(-1, 1);
    if (how == movement::lattice) {
        const auto whole = [](double& x) { x = std::round(3 * x); };
        for (auto* p : {&scene.triangle.a, &scene.triangle.b, &scene.triangle.c})
            whole(p->x0), whole(p->y0), whole(p->x1), whole(p->y1);
        whole(scene.s_x), whole(scene.s_y);
    }
    return scene;
}

template <class T> moving_vertex<T> rounded_vertex(const moving_vertex<double>& v)
{
    return {T(v.x0), T(v.y0), T(v.z0), T(v.w0), T(v.x1), T(v.y1), T(v.z1), T(v.w1)};
}

template <class T> moving_triangle<T> rounded_triangle(const moving_triangle<double>& m)
{
    return {rounded_vertex<T>(m.a), rounded_vertex<T>(m.b), rounded_vertex<T>(m.c)};
}

} // namespace gnomon::test
