// Covered times: of any three edge functions against extended precision, and of neighbours, which leave no time between
// them.
#include "../support/effort.hpp"
#include "coverage_check.hpp"

#include <gnomon/motion/moving_triangle.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> exact value(const moving_edge<T>& e, exact t)
{
    return exact(e.e0) * (1 - t) * (1 - t) + 2 * exact(e.e1) * t * (1 - t) + exact(e.e2) * t * t;
}

} // namespace

// Any three quadratics: more roots in [0, 1] than triangles have. Tolerance: 16 2^-p for the roots and 8 for the times.
TEST_CASE_TEMPLATE("covered times of arbitrary edge functions, four intervals among them", T, float, double)
{
    bit_source bits(4);
    tally count;
    std::array<std::int64_t, 5> intervals{};
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        std::array<moving_edge<T>, 3> e;
        std::array<exact, 3> tolerance;
        for (std::size_t k = 0; k < 3; ++k) {
            const double scale = std::exp2(bits.uniform(-20, 20));
            const auto any = [&] { return T(bits.chance(0.1) ? 0 : scale * bits.uniform(-1, 1)); };
            e[k] = {any(), any(), any()};
            if (bits.chance(0.5)) { // (t - root) (t - other), a gap
                const double root = bits.uniform(0, 1), other = root + bits.uniform(0, 0.3);
                e[k] = {T(root * other), T(0.5 * (2 * root * other - root - other)), T((1 - root) * (1 - other))};
            }
            tolerance[k] =
                24 * exact(u<T>) * exact(std::max({std::abs(e[k].e0), std::abs(e[k].e1), std::abs(e[k].e2)}));
        }
        const coverage_times<T> x = moving_coverage(moving_edges<T>{e[0], e[1], e[2]}, T(1));
        require_in_order(x);
        check_coverage(
            x, T(1), tolerance,
            [&](exact t) {
                return std::array<exact, 3>{value(e[0], t), value(e[1], t), value(e[2], t)};
            },
            bits, count);
        ++intervals[std::size_t(x.count)];
    }
    CHECK(double(count.decided) > 0.95 * double(count.asked));
    for (const std::int64_t found : intervals) CHECK(found > 0);
}

TEST_CASE_TEMPLATE("what one side of an edge leaves, the other has, bit for bit", T, float, double)
{
    bit_source bits(5);
    const auto pieces = [](const moving_edge<T>& e, T facing) {
        const edge_times<T> x = moving_edge_inside(e, facing);
        std::vector<interval> r{interval(x.begin, std::min(x.end, x.gap_begin)),
                                interval(std::max(x.begin, x.gap_end), x.end)};
        std::erase_if(r, [](interval i) { return i.begin >= i.end; });
        return r;
    };
    for (std::int64_t i = 0; i < effort(300'000); ++i) {
        const bool lattice = bits.chance(0.3);
        const auto any = [&] { return T(lattice ? double(bits.below(5)) - 2 : bits.uniform(-1, 1)); };
        const sheared_vertex<T> a{any(), any(), any(), any()}, b{any(), any(), any(), any()};
        const moving_edge<T> e = moving_edge_of(a, b), n = moving_edge_of(b, a);
        REQUIRE(e.e0 == -n.e0);
        REQUIRE(e.e1 == -n.e1);
        REQUIRE(e.e2 == -n.e2);
        const T t = T(bits.uniform(0, 1));
        REQUIRE(moving_edge_at(e, t) == -moving_edge_at(n, t));
        if (moving_edge_size(e) == 0) continue; // both have it all
        std::vector<interval> both = pieces(e, T(1));
        for (const interval& x : pieces(n, T(1))) both.push_back(x);
        std::sort(both.begin(), both.end(), [](interval x, interval y) { return x.begin < y.begin; });
        REQUIRE(both.front().begin == 0);
        REQUIRE(both.back().end == 1);
        for (std::size_t k = 1; k < both.size(); ++k) REQUIRE(both[k].begin == both[k - 1].end);
    }
}

// Six triangles around a vertex that passes near the sample, within a ring that keeps away from both.
TEST_CASE_TEMPLATE("a fan of triangles covers a sample at every time, without a crack", T, float, double)
{
    bit_source bits(6);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto vertex = [&](double radius, double angle) {
            const auto x = [&](double noise) { return T(radius * std::cos(angle) + bits.uniform(-noise, noise)); };
            const auto y = [&](double noise) { return T(radius * std::sin(angle) + bits.uniform(-noise, noise)); };
            const double noise = radius > 0 ? 0.1 : 0.3;
            return moving_vertex<T>{x(noise), y(noise), 0, 1, x(noise), y(noise), 0, 1};
        };
        const T s_x = T(bits.uniform(-0.3, 0.3)), s_y = T(bits.uniform(-0.3, 0.3));
        const moving_vertex<T> centre = vertex(0, 0);
        std::array<moving_vertex<T>, 6> ring;
        for (std::size_t k = 0; k < 6; ++k) ring[k] = vertex(1, double(k) * std::acos(-1.0) / 3);
        std::vector<interval> covered;
        double total = 0;
        for (std::size_t k = 0; k < 6; ++k) {
            const moving_triangle<T> m{centre, ring[k], ring[(k + 1) % 6]};
            const coverage_times<T> x = moving_coverage(moving_triangle_edges(m, s_x, s_y), T(1));
            for (std::size_t j = 0; j < std::size_t(x.count); ++j) covered.push_back(intervals_of(x)[j]);
            total += double(coverage_duration(x));
        }
        std::sort(covered.begin(), covered.end(), [](interval a, interval b) { return a.begin < b.begin; });
        REQUIRE(covered.front().begin == 0);
        REQUIRE(covered.back().end == 1);
        for (std::size_t k = 1; k < covered.size(); ++k) REQUIRE(covered[k].begin == covered[k - 1].end);
        REQUIRE(std::abs(total - 1) <= 8 * double(covered.size()) * u<T>);
    }
}
