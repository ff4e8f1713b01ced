// Edge functions over a tile: those of moving_triangle.h within the stated error, and blocks that contain the covered
// times of their samples.
#include "coverage_check.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"

#include <gnomon/motion/triangle/triangle_setup.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> std::array<moving_edge<T>, 3> listed(const moving_edges<T>& e) { return {e.a, e.b, e.c}; }

/// A scene of every kind, with an origin near its sample.
template <class T, class F> void for_each_scene(std::int64_t scenes, F f)
{
    bit_source bits(51);
    for (std::int64_t i = 0; i < effort(scenes); ++i) {
        const moving_scene scene = draw_moving_scene(movement(std::size_t(i) % movement_count), bits);
        const T o_x = T(scene.s_x + bits.uniform(-0.1, 0.1)), o_y = T(scene.s_y + bits.uniform(-0.1, 0.1));
        f(rounded_triangle<T>(scene.triangle), o_x, o_y, bits);
    }
}

// A vertex relative to a sample; its extents are what errors are proportional to.
struct seen_vertex {
    exact x0, y0, x1, y1, size_x, size_y;
};

exact products(const seen_vertex& i, const seen_vertex& j) { return i.size_x * j.size_y + i.size_y * j.size_x; }

template <class T> std::array<seen_vertex, 3> seen_vertices(const moving_triangle<T>& m, T o_x, T o_y, T s_x, T s_y)
{
    const exact at_x = exact(o_x) + exact(s_x), at_y = exact(o_y) + exact(s_y);
    const auto seen = [&](const moving_vertex<T>& v) -> seen_vertex {
        const exact w0 = exact(v.w0), w1 = exact(v.w1);
        const auto size = [&](T at0, T at1, T origin, T sample) {
            const exact reach = exact(std::abs(origin)) + exact(std::abs(sample));
            return std::max(exact(std::abs(at0)) + reach * std::abs(w0), exact(std::abs(at1)) + reach * std::abs(w1));
        };
        return {exact(v.x0) - at_x * w0, exact(v.y0) - at_y * w0,    exact(v.x1) - at_x * w1,
                exact(v.y1) - at_y * w1, size(v.x0, v.x1, o_x, s_x), size(v.y0, v.y1, o_y, s_y)};
    };
    return {seen(m.a), seen(m.b), seen(m.c)};
}

// Edge functions opposite to the vertices at one time, the scales of their errors, and depths.
struct seen_at {
    std::array<exact, 3> edges, sizes, z, from_c; // the last: from that of vertex c, at most

    exact sum() const { return edges[0] + edges[1] + edges[2]; }
    bool covered() const
    {
        return std::ranges::all_of(edges, [](exact e) { return e > 0; }) ||
               std::ranges::all_of(edges, [](exact e) { return e < 0; });
    }
    exact depth() const { return (edges[0] * z[0] + edges[1] * z[1] + edges[2] * z[2]) / sum(); }
    /// From the comment of depth_curve_at.
    exact depth_error(double unit) const
    {
        const exact products =
            sizes[0] * from_c[0] + sizes[1] * from_c[1] + std::abs(depth() - z[2]) * (sizes[0] + sizes[1] + sizes[2]);
        return exact(unit) * (32 * products / std::abs(sum()) + 8);
    }
};

template <class T> seen_at see(const moving_triangle<T>& m, T o_x, T o_y, T s_x, T s_y, T t)
{
    const std::array<seen_vertex, 3> p = seen_vertices(m, o_x, o_y, s_x, s_y);
    const std::array vertices{m.a, m.b, m.c};
    const exact passed = exact(t), left = 1 - passed;
    seen_at r;
    for (std::size_t k = 0; k < 3; ++k) {
        const seen_vertex &i = p[(k + 1) % 3], &j = p[(k + 2) % 3];
        r.edges[k] = (i.x0 * left + i.x1 * passed) * (j.y0 * left + j.y1 * passed) -
                     (i.y0 * left + i.y1 * passed) * (j.x0 * left + j.x1 * passed);
        r.sizes[k] = products(i, j);
        const moving_vertex<T>& v = vertices[k];
        r.z[k] = exact(v.z0) * left + exact(v.z1) * passed;
        r.from_c[k] = std::max(std::abs(exact(v.z0) - exact(m.c.z0)), std::abs(exact(v.z1) - exact(m.c.z1)));
    }
    return r;
}

/// A triangle on a grid on which sums and differences are exact in float, so that vertices have exactly equal motions.
template <class T> moving_triangle<T> translated_triangle(bit_source& bits)
{
    const bool perspective = bits.chance(0.5);
    const auto grid = [&](double low, double high) { return T(std::round(bits.uniform(low, high) * 1024) / 1024); };
    const T moved_x = grid(-1, 1), moved_y = grid(-1, 1), moved_z = grid(-0.25, 0.25),
            moved_w = perspective ? grid(-0.5, 0.5) : T(0);
    const auto vertex = [&] {
        const T x = grid(-1, 1), y = grid(-1, 1), z = grid(-0.75, 0.75), w = perspective ? grid(0.75, 4) : T(1);
        return moving_vertex<T>{x, y, z, w, x + moved_x, y + moved_y, z + moved_z, w + moved_w};
    };
    return {vertex(), vertex(), vertex()};
}

} // namespace

TEST_CASE_TEMPLATE("triangle_setup_edges: the triangle's edge functions, within the stated error", T, float, double)
{
    for_each_scene<T>(100'000, [](const moving_triangle<T>& m, T o_x, T o_y, bit_source& bits) {
        const T s_x = T(bits.uniform(-0.2, 0.2)), s_y = T(bits.uniform(-0.2, 0.2));
        const auto found = listed(triangle_setup_edges(triangle_setup_make(m, o_x, o_y), s_x, s_y));
        const std::array<seen_vertex, 3> p = seen_vertices(m, o_x, o_y, s_x, s_y);
        for (std::size_t k = 0; k < 3; ++k) {
            const seen_vertex &i = p[(k + 1) % 3], &j = p[(k + 2) % 3];
            const exact error = 64 * exact(u<T>) * products(i, j);
            REQUIRE(std::abs(exact(found[k].e0) - (i.x0 * j.y0 - i.y0 * j.x0)) <= error);
            REQUIRE(std::abs(exact(found[k].e1) - (i.x0 * j.y1 - i.y0 * j.x1 + i.x1 * j.y0 - i.y1 * j.x0) / 2) <=
                    error);
            REQUIRE(std::abs(exact(found[k].e2) - (i.x1 * j.y1 - i.y1 * j.x1)) <= error);
        }
    });
}

TEST_CASE_TEMPLATE("edge equations of neighbours are opposite, bit for bit, at every sample", T, float, double)
{
    for_each_scene<T>(50'000, [](const moving_triangle<T>& m, T o_x, T o_y, bit_source& bits) {
        const triangle_setup<T> one = triangle_setup_make(m, o_x, o_y);
        const triangle_setup<T> other =
            triangle_setup_make(moving_triangle<T>{m.b, m.a, m.c}, o_x, o_y); // edges b-a, a-c, c-b
        const T s_x = T(bits.uniform(-1, 1)), s_y = T(bits.uniform(-1, 1));
        const moving_edge<T> there = edge_equation_at(one.c, s_x, s_y), back = edge_equation_at(other.c, s_x, s_y);
        REQUIRE(there.e0 == -back.e0);
        REQUIRE(there.e1 == -back.e1);
        REQUIRE(there.e2 == -back.e2);
    });
}

// A linear edge deviates from the edge by at most the nonlinearity, a distance: a value over the slope at the time.
TEST_CASE_TEMPLATE("moving_edge_nonlinearity: no edge is farther from its linear edge", T, float, double)
{
    std::int64_t asked = 0, tight = 0;
    for_each_scene<T>(100'000, [&](const moving_triangle<T>& m, T, T, bit_source& bits) {
        const moving_vertex<T>&a = m.a, &b = m.b;
        if (!(a.w0 > 0 && a.w1 > 0 && b.w0 > 0 && b.w1 > 0)) return;
        const T bend = moving_edge_nonlinearity(a, b);
        if (std::isnan(bend)) return; // an edge without length
        REQUIRE(bend == moving_edge_nonlinearity(b, a));
        const auto within = [&](T p, T q, T r, T s) {
            return exact(bits.uniform(double(std::min({p, q, r, s})), double(std::max({p, q, r, s}))));
        };
        const exact t = exact(bits.uniform(0, 1)), left = 1 - t,
                    x = within(a.x0 / a.w0, a.x1 / a.w1, b.x0 / b.w0, b.x1 / b.w1),
                    y = within(a.y0 / a.w0, a.y1 / a.w1, b.y0 / b.w0, b.y1 / b.w1);
        // (x, y, c) of the edge between two times, one for each vertex.
        const auto line = [&](bool late_a, bool late_b) {
            const exact a_x = exact(late_a ? a.x1 : a.x0), a_y = exact(late_a ? a.y1 : a.y0),
                        a_w = exact(late_a ? a.w1 : a.w0), b_x = exact(late_b ? b.x1 : b.x0),
                        b_y = exact(late_b ? b.y1 : b.y0), b_w = exact(late_b ? b.w1 : b.w0);
            return std::array<exact, 3>{a_y * b_w - a_w * b_y, a_w * b_x - a_x * b_w, a_x * b_y - a_y * b_x};
        };
        const auto value = [&](const std::array<exact, 3>& e) { return e[0] * x + e[1] * y + e[2]; };
        const std::array<exact, 3> open = line(false, false), close = line(true, true);
        const exact middle = (value(line(false, true)) + value(line(true, false))) / 2;
        const exact away = std::abs(2 * middle - value(open) - value(close)) * t * left;
        const exact slope = std::hypot(left * open[0] + t * close[0], left * open[1] + t * close[1]);
        const auto size = [&](const moving_vertex<T>& v, T at0, T at1, exact reach) {
            return std::max(std::abs(exact(at0)) + reach * exact(v.w0), std::abs(exact(at1)) + reach * exact(v.w1));
        };
        const exact products = size(a, a.x0, a.x1, std::abs(x)) * size(b, b.y0, b.y1, std::abs(y)) +
                               size(a, a.y0, a.y1, std::abs(y)) * size(b, b.x0, b.x1, std::abs(x));
        REQUIRE(away <= exact(bend) * (1 + 16 * exact(u<T>)) * slope + 32 * exact(u<T>) * products);
        ++asked;
        tight += away > exact(bend) * slope / 4;
    });
    CHECK(asked > effort(100'000) / 2);
    CHECK(tight > asked / 100);
}

TEST_CASE_TEMPLATE("moving_edge_nonlinearity: only its stated error for vertices with equal motions", T, float, double)
{
    bit_source bits(53);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const moving_triangle<T> m = translated_triangle<T>(bits);
        const moving_vertex<T>&a = m.a, &b = m.b;
        const T bend = moving_edge_nonlinearity(a, b);
        if (std::isnan(bend)) continue; // an edge without length
        const auto reach = [](T p, T q, T r, T s) {
            return std::max({std::abs(exact(p)), std::abs(exact(q)), std::abs(exact(r)), std::abs(exact(s))});
        };
        const exact x = reach(a.x0 / a.w0, a.x1 / a.w1, b.x0 / b.w0, b.x1 / b.w1),
                    y = reach(a.y0 / a.w0, a.y1 / a.w1, b.y0 / b.w0, b.y1 / b.w1);
        const auto size = [&](T at0, T at1, const moving_vertex<T>& v, exact far) {
            return std::max(std::abs(exact(at0)) + far * exact(v.w0), std::abs(exact(at1)) + far * exact(v.w1));
        };
        const exact products =
            size(a.x0, a.x1, a, x) * size(b.y0, b.y1, b, y) + size(a.y0, a.y1, a, y) * size(b.x0, b.x1, b, x);
        // The slope lies on a line; it is least where the line is nearest to 0.
        const exact open_x = exact(a.y0) * exact(b.w0) - exact(a.w0) * exact(b.y0),
                    open_y = exact(a.w0) * exact(b.x0) - exact(a.x0) * exact(b.w0),
                    turn_x = exact(a.y1) * exact(b.w1) - exact(a.w1) * exact(b.y1) - open_x,
                    turn_y = exact(a.w1) * exact(b.x1) - exact(a.x1) * exact(b.w1) - open_y,
                    turn = turn_x * turn_x + turn_y * turn_y;
        const exact t = turn > 0 ? std::clamp(-(open_x * turn_x + open_y * turn_y) / turn, exact(0), exact(1)) : 0;
        const exact slope = std::hypot(open_x + t * turn_x, open_y + t * turn_y);
        REQUIRE(exact(bend) * slope <= 32 * exact(u<T>) * products + 16 * exact(u<T>) * exact(bend) * slope);
    }
}

// The tolerances are those of triangle_setup_edges and depth_curve_at.
TEST_CASE_TEMPLATE("a translated triangle is linear in time: edges and depth, within the stated errors", T, float,
                   double)
{
    bit_source bits(52);
    std::int64_t covered = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const moving_triangle<T> m = translated_triangle<T>(bits);
        const T o_x = T(bits.uniform(-0.3, 0.3)), o_y = T(bits.uniform(-0.3, 0.3));
        const T s_x = T(bits.uniform(-0.1, 0.1)), s_y = T(bits.uniform(-0.1, 0.1)), t = T(bits.uniform(0, 1));
        const triangle_setup<T> field = triangle_setup_make(m, o_x, o_y);
        const depth_setup<T> depths = depth_setup_make(field, m);
        const moving_edges<T> edges = triangle_setup_edges_linear(field, s_x, s_y);
        const T found = linear_depth_at(moving_depth_curve(depths, edges, s_x, s_y), t);
        REQUIRE(found >= depths.least);
        REQUIRE(found <= depths.most);
        const seen_at at = see(m, o_x, o_y, s_x, s_y, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const moving_edge<T> e = listed(edges)[k];
            const exact line = exact(e.e0) + exact(t) * (exact(e.e2) - exact(e.e0));
            REQUIRE(std::abs(line - at.edges[k]) <= 64 * exact(u<T>) * at.sizes[k]);
        }
        if (!at.covered()) continue;
        ++covered;
        REQUIRE(std::abs(exact(found) - at.depth()) <= at.depth_error(u<T>));
    }
    CHECK(covered > effort(200'000) / 50);
}

TEST_CASE_TEMPLATE("triangle_setup_around: a block is covered at all times at which one of its samples is", T, float,
                   double)
{
    std::int64_t covered = 0, culled = 0;
    for_each_scene<T>(100'000, [&](const moving_triangle<T>& m, T o_x, T o_y, bit_source& bits) {
        const triangle_setup<T> field = triangle_setup_make(m, o_x, o_y);
        const T facing = bits.chance(0.5) ? T(1) : T(-1), h = T(std::exp2(bits.uniform(-8, -2)));
        const T x = T(bits.uniform(-0.5, 0.5)), y = T(bits.uniform(-0.5, 0.5));
        const coverage_intervals<T> block = moving_coverage(
            triangle_setup_edges(triangle_setup_around(field, h * T(1.01), h * T(1.01), facing), x, y), facing);
        culled += block.count == 0;
        for (int k = 0; k < 8; ++k) {
            const T s_x = x + h * T(bits.uniform(-1, 1)), s_y = y + h * T(bits.uniform(-1, 1));
            const coverage_intervals<T> sample = moving_coverage(triangle_setup_edges(field, s_x, s_y), facing);
            for (std::size_t j = 0; j < std::size_t(sample.count); ++j) {
                const interval seen = intervals_of(sample)[j];
                const auto around = intervals_of(block);
                REQUIRE(std::any_of(around.begin(), around.begin() + std::ptrdiff_t(block.count),
                                    [&](const interval& i) { return i.begin <= seen.begin && seen.end <= i.end; }));
                ++covered;
            }
        }
    });
    CHECK(covered > 0);
    CHECK(culled > 0);
}

// The stated tolerance: 12 2^-p for the coefficients of a plane (sheared vertices, products, their difference), 8 for
// combining them with depths and for their values at the sample, 12 for the polynomials and their quotient.
TEST_CASE_TEMPLATE("depth_curve_at: the mean of the vertices' depths, within the stated error", T, float, double)
{
    std::int64_t covered = 0, close = 0;
    for_each_scene<T>(200'000, [&](const moving_triangle<T>& m, T o_x, T o_y, bit_source& bits) {
        for (const moving_vertex<T>& v : {m.a, m.b, m.c})
            if (!(v.w0 > 0 && v.w1 > 0)) return;
        const T s_x = T(bits.uniform(-0.1, 0.1)), s_y = T(bits.uniform(-0.1, 0.1)), t = T(bits.uniform(0, 1));
        const triangle_setup<T> field = triangle_setup_make(m, o_x, o_y);
        const depth_setup<T> depths = depth_setup_make(field, m);
        const T found = depth_curve_at(moving_depth_curve(depths, triangle_setup_edges(field, s_x, s_y), s_x, s_y), t);
        REQUIRE(found >= depths.least);
        REQUIRE(found <= depths.most);

        const seen_at at = see(m, o_x, o_y, s_x, s_y, t);
        if (!at.covered()) return;
        ++covered;
        const exact error = at.depth_error(u<T>);
        REQUIRE(std::abs(exact(found) - std::clamp(at.depth(), exact(-1), exact(1))) <= error);
        close += error < 1000 * exact(u<T>);
    });
    CHECK(covered > effort(200'000) / 50);
    CHECK(close > covered / 4);
}
