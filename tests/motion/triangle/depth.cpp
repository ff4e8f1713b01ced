// Depth linear in view distance, against the point at which the ray through the sample meets the plane of the triangle;
// triangles whose depth is a single line; and hostile input.
#include "motion/receiver/moving_reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

// Positions as of projected().
constexpr double near_plane = 0.02, far_plane = 4;
double linear(double w) { return 2 * (w - near_plane) / (far_plane - near_plane) - 1; }

/// A triangle with linear depth for z.
moving_triangle<double> with_linear_depth(moving_triangle<double> m, movement how)
{
    if (how == movement::perspective)
        for (auto* v : {&m.a, &m.b, &m.c}) v->z0 = linear(v->w0), v->z1 = linear(v->w1);
    return m;
}

/// Point at which the ray meets the plane of the triangle: along (s_x, s_y, 1) in perspective, where (x, y, w) is view
/// space up to scale; from (s_x, s_y) along z in an orthographic view.
template <class T> exact depth_at_plane(const moving_triangle<T>& m, exact s_x, exact s_y, exact t, bool perspective)
{
    std::array<std::array<exact, 4>, 3> p;
    const std::array<const moving_vertex<T>*, 3> v{&m.a, &m.b, &m.c};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&](T q, T r) { return (1 - t) * exact(q) + t * exact(r); };
        p[k] = {at(v[k]->x0, v[k]->x1), at(v[k]->y0, v[k]->y1), at(v[k]->z0, v[k]->z1), at(v[k]->w0, v[k]->w1)};
    }
    const std::size_t third = perspective ? 3 : 2;
    const std::array<std::size_t, 3> axes{0, 1, third};
    std::array<exact, 3> d1, d2;
    for (std::size_t i = 0; i < 3; ++i) d1[i] = p[1][axes[i]] - p[0][axes[i]], d2[i] = p[2][axes[i]] - p[0][axes[i]];
    const std::array<exact, 3> n{d1[1] * d2[2] - d1[2] * d2[1], d1[2] * d2[0] - d1[0] * d2[2],
                                 d1[0] * d2[1] - d1[1] * d2[0]};
    const exact plane = n[0] * p[0][0] + n[1] * p[0][1] + n[2] * p[0][third];
    if (!perspective) return (plane - n[0] * s_x - n[1] * s_y) / n[2];
    const exact w = plane / (n[0] * s_x + n[1] * s_y + n[2]);
    // Affine in w, by the two vertices that differ most in it.
    std::sort(p.begin(), p.end(), [](const auto& a, const auto& b) { return a[3] < b[3]; });
    return p[0][2] + (w - p[0][3]) / (p[2][3] - p[0][3]) * (p[2][2] - p[0][2]);
}

template <class T>
std::vector<depth_piece<T>> pieces_of(const moving_triangle<T>& m, const moving_edges<T>& e, T begin, T end, T divided,
                                      T tolerance)
{
    std::vector<depth_piece<T>> pieces;
    for (T passed = 0; passed < 1; passed = pieces.back().passed)
        pieces.push_back(moving_depth_piece(m, e, begin, end, passed, divided, tolerance));
    return pieces;
}

} // namespace

// The stated bound. Where the w of the vertices hardly differ in perspective, z is rounded by more than the reference's
// w: the z of T differs by 2^-p.
TEST_CASE_TEMPLATE("linear depth is that of the point that the sample sees", T, float, double)
{
    bit_source bits(12);
    std::int64_t asked = 0, sharp = 0;
    for (std::int64_t i = 0; i < effort(300'000); ++i) {
        const auto how = movement(std::size_t(i) % 5);
        const moving_scene scene = draw_moving_scene(how, bits);
        const moving_triangle<T> m = rounded_triangle<T>(with_linear_depth(scene.triangle, how));
        const T s_x = T(scene.s_x), s_y = T(scene.s_y);
        const reference<T> r(m, s_x, s_y);
        const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
        const coverage_intervals<T> x = moving_coverage(e, 1);
        if (x.count == 0) continue;
        const T t = x.begin0 + (x.end0 - x.begin0) * T(bits.uniform(0, 1));
        const auto at = r.at(exact(t));
        const exact z = depth_at_plane(m, exact(s_x), exact(s_y), exact(t), how == movement::perspective);
        exact sum = 0, wrong = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += at.edges[k];
        for (std::size_t k = 0; k < 3; ++k) wrong += r.tolerance[k] * std::abs(at.z[k] - z);
        exact spread = 1;
        if (how == movement::perspective) {
            const auto [low, high] = std::minmax_element(at.w.begin(), at.w.end());
            spread = 1 / std::min(exact(1), (*high - *low) / 4);
        }
        const exact bound = wrong / std::abs(sum) + 16 * exact(u<T>) * spread;
        ++asked;
        if (!(bound < 1e4L * exact(u<T>))) continue;
        ++sharp;
        REQUIRE(std::abs(exact(moving_depth_at(m, e, t, 0)) - std::clamp(z, -1.0L, 1.0L)) <= bound);
    }
    CHECK(double(sharp) > 0.8 * double(asked));
}

// The mean of z and the centroid's depth agree with the truth within 16 2^-p. The line deviates by its stated error,
// with depths and deviations up to 1.
TEST_CASE_TEMPLATE("the depth of a plane across the axis is linear in time, also in perspective", T, float, double)
{
    bit_source bits(13);
    double bent = 0;
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const double w0 = bits.uniform(near_plane, far_plane), w1 = bits.uniform(near_plane, far_plane);
        const double s_x = bits.uniform(-1, 1), s_y = bits.uniform(-1, 1);
        moving_triangle<T> m, clip;
        for (auto [p, q] : {std::pair{&m.a, &clip.a}, {&m.b, &clip.b}, {&m.c, &clip.c}}) {
            const double x = bits.uniform(-4, 4), y = bits.uniform(-4, 4), d = far_plane - near_plane;
            const auto clip_z = [&](double w) {
                return ((far_plane + near_plane) * w - 2 * far_plane * near_plane) / d;
            };
            *p = {T(x), T(y), T(linear(w0)), T(w0), T(x), T(y), T(linear(w1)), T(w1)};
            *q = *p;
            q->z0 = T(clip_z(w0)), q->z1 = T(clip_z(w1));
        }
        const moving_edges<T> e = moving_triangle_edges(m, T(s_x), T(s_y));
        const T t = T(bits.uniform(0, 1));
        const exact z = exact(m.a.z0) * (1 - exact(t)) + exact(m.a.z1) * exact(t);
        REQUIRE(std::abs(exact(moving_depth_at(m, e, t, 0)) - z) <= 16 * exact(u<T>));
        exact least = HUGE_VALL, sizes = 0;
        for (const auto& edge : {e.a, e.b, e.c}) sizes += exact(moving_edge_size(edge));
        for (int k = 0; k <= 16; ++k) {
            const T at = T(k) / 16;
            least = std::min(least, std::abs(exact(moving_edge_at(e.a, at)) + exact(moving_edge_at(e.b, at)) +
                                             exact(moving_edge_at(e.c, at))));
        }
        REQUIRE(moving_depth_line(m, e, T(0), T(1), T(0)).deviation <= 128 * exact(u<T>) * sizes / least);
        bent = std::max(bent, double(moving_depth_line(clip, e, T(0), T(1), T(1)).deviation));
    }
    CHECK(bent > 0.5);
}

// Depth is linear in time in such a view. In float the rounding of slivers may exceed the tolerance.
TEST_CASE_TEMPLATE("a translation in an orthographic view is one piece", T, float, double)
{
    bit_source bits(15);
    std::int64_t intervals = 0, several = 0;
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        moving_scene scene = draw_moving_scene(movement::still, bits);
        const double x = bits.uniform(-1, 1), y = bits.uniform(-1, 1), z = bits.uniform(-0.1, 0.1);
        for (auto* v : {&scene.triangle.a, &scene.triangle.b, &scene.triangle.c}) {
            v->z0 *= 0.9;
            v->x1 = v->x0 + x, v->y1 = v->y0 + y, v->z1 = v->z0 + z;
        }
        const moving_triangle<T> m = rounded_triangle<T>(scene.triangle);
        const moving_edges<T> e = moving_triangle_edges(m, T(scene.s_x), T(scene.s_y));
        const coverage_intervals<T> c = moving_coverage(e, 1);
        if (c.count == 0) continue;
        ++intervals;
        several += pieces_of(m, e, c.begin0, c.end0, T(i % 2), T(1e-3)).size() > 1;
    }
    CHECK(intervals > 0);
    if constexpr (sizeof(T) == 8) CHECK(several == 0);
    CHECK(1000 * several <= intervals);
}

TEST_CASE_TEMPLATE("any input gives depths in [-1, 1] and at most 32 pieces", T, float, double)
{
    hostile_source<T> hostile(16);
    bit_source bits(17);
    for (std::int64_t i = 0; i < effort(30'000); ++i) {
        const moving_scene scene = draw_moving_scene(movement::deformed, bits);
        std::array<T, 24 + 9 + 4> numbers;
        const moving_triangle<T> tame = rounded_triangle<T>(scene.triangle);
        const moving_edges<T> tame_edges = moving_triangle_edges(tame, T(scene.s_x), T(scene.s_y));
        std::memcpy(numbers.data(), &tame, sizeof tame);
        std::memcpy(numbers.data() + 24, &tame_edges, sizeof tame_edges);
        const std::array<T, 4> times{T(0.25), T(0.75), T(1), T(1e-3)};
        std::copy(times.begin(), times.end(), numbers.begin() + 33);
        const std::size_t kind = bits.below(3);
        for (T& x : numbers)
            if (kind > 0 || bits.chance(0.1)) x = kind == 1 ? hostile.special() : hostile.pattern();
        moving_triangle<T> m;
        moving_edges<T> e;
        std::memcpy(&m, numbers.data(), sizeof m);
        std::memcpy(&e, numbers.data() + 24, sizeof e);
        const auto pieces = pieces_of(m, e, numbers[33], numbers[34], numbers[35], numbers[36]);
        REQUIRE(pieces.size() <= 32);
        for (const depth_piece<T>& p : pieces) {
            REQUIRE(std::abs(p.z0) <= 1);
            REQUIRE(std::abs(p.z1) <= 1);
        }
        const depth_piece<T> odd = moving_depth_piece(m, e, T(0), T(1), hostile.pattern(), T(1), T(0.01));
        REQUIRE(odd.passed > 0);
        REQUIRE(odd.passed <= 1);
        REQUIRE(odd.t0 <= odd.t1);
    }
}
