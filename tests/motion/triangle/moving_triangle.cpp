// Moving triangles: covered times against the coverage of dense times in extended precision, depth and its line against
// extended precision, degenerate and hostile input.
#include "motion/receiver/moving_reference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

// The stated tolerance: 6 2^-p for shearing and products, 6 for the roots (moving_edge_inside), 8 for rounding times,
// with a slope of at most twice the range of the coefficients; each with X_i Y_j + Y_i X_j as the scale, 32 in total.
TEST_CASE_TEMPLATE("covered times are those of the static triangle at every time", T, float, double)
{
    bit_source bits(3);
    std::array<tally, movement_count> counts;
    for_each_scene<T>(500'000, 1, [&](const moving_triangle<T>& m, T s_x, T s_y, movement how) {
        const reference<T> r(m, s_x, s_y);
        const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
        for (const T facing : {T(1), T(-1)}) {
            const coverage_intervals<T> x = moving_coverage(e, facing);
            require_in_order(x);
            check_coverage(
                x, facing, r.tolerance, [&](exact t) { return r.at(t).edges; }, bits, counts[std::size_t(how)]);
        }
    });
    for (const tally& count : counts) {
        CHECK(double(count.covered) > 0.05 * double(count.asked));
        CHECK(double(count.decided) > 0.85 * double(count.asked)); // a still sample on a border never is
    }
}

// The stated error; where depth is outside of [-1, 1], both are limited to it.
TEST_CASE_TEMPLATE("depth is that of the covering triangle, and between the depths of its vertices", T, float, double)
{
    bit_source bits(7);
    std::int64_t asked = 0, sharp = 0;
    for_each_scene<T>(300'000, 8, [&](const moving_triangle<T>& m, T s_x, T s_y, movement) {
        const reference<T> r(m, s_x, s_y);
        const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
        for (const T facing : {T(1), T(-1)}) {
            const coverage_intervals<T> x = moving_coverage(e, facing);
            if (x.count == 0) continue;
            const T passed = T(bits.uniform(0, 1)), t = x.begin0 + (x.end0 - x.begin0) * passed;
            const auto at = r.at(exact(t));
            exact z = 0, w = 0, wrong = 0, low = 1, high = -1, largest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                z += at.edges[k] * at.z[k];
                w += at.edges[k] * at.w[k];
                const exact vertex = at.z[k] / at.w[k];
                low = std::min(low, vertex);
                high = std::max(high, vertex);
                largest = std::max(largest, std::abs(vertex));
            }
            const exact rounding = 16 * exact(u<T>) * std::max(largest, exact(1));
            const exact depth = exact(moving_depth_at(m, e, t, 1));
            REQUIRE(depth >= std::clamp(low, -1.0L, 1.0L) - rounding);
            REQUIRE(depth <= std::clamp(high, -1.0L, 1.0L) + rounding);
            for (std::size_t k = 0; k < 3; ++k) wrong += r.tolerance[k] * std::abs(at.z[k] - z / w * at.w[k]);
            const exact bound = wrong / std::abs(w) + rounding;
            if (w != 0) REQUIRE(std::abs(depth - std::clamp(z / w, -1.0L, 1.0L)) <= bound);
            ++asked;
            sharp += w != 0 && bound < 1e4L * exact(u<T>);
        }
    });
    CHECK(double(sharp) > 0.8 * double(asked));
}

// The tolerance is for static triangles with depths in [-1, 1] and edge functions with a sum of at least a hundredth.
TEST_CASE_TEMPLATE("lines of depth end on it, and are exact for static triangles", T, float, double)
{
    std::int64_t still = 0;
    for_each_scene<T>(30'000, 9, [&](const moving_triangle<T>& m, T s_x, T s_y, movement how) {
        const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
        const coverage_intervals<T> x = moving_coverage(e, 1);
        if (x.count == 0) return;
        const depth_line<T> line = moving_depth_line(m, e, x.begin0, x.end0, T(1));
        REQUIRE(line.z0 == moving_depth_at(m, e, x.begin0, 1));
        REQUIRE(line.z1 == moving_depth_at(m, e, x.end0, 1));
        if (how != movement::still || e.a.e0 + e.b.e0 + e.c.e0 < T(0.01)) return;
        ++still;
        REQUIRE(line.deviation <= 6400 * T(u<T>));
    });
    CHECK(still > 0);
}

namespace {

moving_vertex<double> vertex(double x0, double y0, double x1, double y1, double z0 = 0, double z1 = 0)
{
    return {x0, y0, z0, 1, x1, y1, z1, 1};
}

coverage_intervals<double> coverage(const moving_triangle<double>& m, double s_x, double s_y, double facing = 1)
{
    return moving_coverage(moving_triangle_edges(m, s_x, s_y), facing);
}

constexpr std::array<double, 9> nothing{0, 2, 2, 2, 2, 2, 2, 2, 2};
constexpr std::array<double, 9> everything{1, 0, 1, 2, 2, 2, 2, 2, 2};
std::array<double, 9> numbers(const coverage_intervals<double>& x)
{
    return {x.count, x.begin0, x.end0, x.begin1, x.end1, x.begin2, x.end2, x.begin3, x.end3};
}

} // namespace

TEST_CASE("static, edge-on, touching and translated triangles")
{
    const moving_triangle<double> still{vertex(0, 0, 0, 0, -0.5, 0.5), vertex(1, 0, 1, 0, -0.5, 0.5),
                                        vertex(0, 1, 0, 1, -0.5, 0.5)};
    CHECK(numbers(coverage(still, 0.25, 0.25)) == everything);
    CHECK(numbers(coverage(still, 0.25, 0.25, -1)) == nothing);
    CHECK(numbers(coverage(still, 0.75, 0.75)) == nothing);
    CHECK(numbers(coverage(still, 0.5, 0)) == everything); // on an edge
    CHECK(numbers(coverage(still, 0, 0)) == everything);   // at a vertex
    CHECK(numbers(coverage(still, 2, 0)) == nothing);      // on an edge's extension
    const auto edges = moving_triangle_edges(still, 0.25, 0.25);
    CHECK(moving_depth_at(still, edges, 0.75, 1) == 0.25);
    const depth_line<double> line = moving_depth_line(still, edges, 0.0, 1.0, 1.0);
    CHECK(line.z0 == -0.5);
    CHECK(line.z1 == 0.5);
    CHECK(line.deviation == 0);

    const moving_triangle<double> edge_on{vertex(0, 0, 0, 0), vertex(1, 0, 1, 0), vertex(0.5, 0, 0.5, 0)};
    for (const double x : {-1.0, 0.0, 0.25, 2.0}) CHECK(numbers(coverage(edge_on, x, 0)) == nothing);
    const moving_triangle<double> point{vertex(0, 0, 0, 0), vertex(0, 0, 0, 0), vertex(0, 0, 0, 0)};
    CHECK(numbers(coverage(point, 0, 0)) == nothing);

    // Translated by 2 along x past the origin: its leading vertex is there at 1/4, its trailing edge at 3/4.
    const moving_triangle<double> carried{vertex(-1.5, -0.5, 0.5, -0.5), vertex(-0.5, 0, 1.5, 0),
                                          vertex(-1.5, 0.5, 0.5, 0.5)};
    CHECK(numbers(coverage(carried, 0, 0)) == std::array<double, 9>{1, 0.25, 0.75, 2, 2, 2, 2, 2, 2});
    CHECK(coverage_duration(coverage(carried, 0, 0)) == 0.5);
    CHECK(numbers(coverage(carried, 0, 0.5)) == nothing); // grazed at one point for no time
    CHECK(numbers(coverage(carried, 0, 0.75)) == nothing);

    // Turned inside out: a vertex crosses the opposite edge halfway, where the area vanishes.
    const moving_triangle<double> flipped{vertex(-1, -1, -1, -1), vertex(1, -1, 1, -1), vertex(0, 1, 0, -3)};
    CHECK(numbers(coverage(flipped, 0, -0.5)) == std::array<double, 9>{1, 0, 0.375, 2, 2, 2, 2, 2, 2});
    CHECK(numbers(coverage(flipped, 0, -1.5, -1)) == std::array<double, 9>{1, 0.625, 1, 2, 2, 2, 2, 2, 2});

    // Behind the light there is no depth in front of anything.
    moving_triangle<double> behind = still;
    for (auto* v : {&behind.a, &behind.b, &behind.c}) v->w0 = v->w1 = -1;
    CHECK(moving_depth_at(behind, moving_triangle_edges(behind, -0.25, -0.25), 0.5, 1) == 1);
}

TEST_CASE_TEMPLATE("any input gives intervals in order and depths in [-1, 1]", T, float, double)
{
    hostile_source<T> hostile(10);
    bit_source bits(11);
    for (std::int64_t i = 0; i < effort(500'000); ++i) {
        moving_triangle<T> m = rounded_triangle<T>(draw_moving_scene(movement::deformed, bits).triangle);
        std::array<T, 26> numbers;
        std::memcpy(numbers.data(), &m, sizeof m);
        const std::size_t kind = bits.below(3);
        for (T& x : numbers)
            if (kind > 0 || bits.chance(0.1)) x = kind == 1 ? hostile.special() : hostile.pattern();
        std::memcpy(&m, numbers.data(), sizeof m);
        const moving_edges<T> e = moving_triangle_edges(m, numbers[24], numbers[25]);
        const T facing = bits.chance(0.1) ? hostile.special() : T(bits.chance(0.5) ? 1 : -1);
        const coverage_intervals<T> x = moving_coverage(e, facing);
        require_in_order(x);
        const T t = bits.chance(0.5) ? hostile.pattern() : T(bits.uniform(0, 1));
        REQUIRE(std::abs(moving_depth_at(m, e, t, 1)) <= 1);
        const depth_line<T> line = moving_depth_line(m, e, x.begin0, t, T(1));
        REQUIRE(std::abs(line.z0) <= 1);
        REQUIRE(std::abs(line.z1) <= 1);
        REQUIRE((line.deviation >= 0 && line.deviation <= 2));
    }
}
