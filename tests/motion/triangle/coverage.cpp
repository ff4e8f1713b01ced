// Covered times: of any three edge functions against extended precision, and of neighbours, which together cover all
// times.
#include "coverage_check.hpp"
#include "support/effort.hpp"

#include <gnomon/motion/triangle/moving_triangle.h>

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
        const coverage_intervals<T> x = moving_coverage(moving_edges<T>{e[0], e[1], e[2]}, T(1));
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

TEST_CASE_TEMPLATE("the two sides of an edge share all times, bit for bit", T, float, double)
{
    bit_source bits(5);
    const auto pieces = [](const moving_edge<T>& e, T facing) {
        const edge_intervals<T> x = moving_edge_inside(e, facing);
        std::vector<interval> r{interval(x.begin, std::min(x.end, x.gap_begin)),
                                interval(std::max(x.begin, x.gap_end), x.end)};
        std::erase_if(r, [](interval i) { return i.begin >= i.end; });
        return r;
    };
    for (std::int64_t i = 0; i < effort(300'000); ++i) {
        const bool lattice = bits.chance(0.3);
        const auto any = [&] { return T(lattice ? double(bits.below(5)) - 2 : bits.uniform(-1, 1)); };
        const sheared_vertex<T> a{any(), any(), any(), any()}, b{any(), any(), any(), any()};
        const moving_edge<T> e = moving_edge_make(a, b), n = moving_edge_make(b, a);
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

TEST_CASE_TEMPLATE("linear_edge_inside: up to or from the root, within 4 2^-p; the other side has the rest", T, float,
                   double)
{
    bit_source bits(7);
    std::int64_t crossed = 0;
    for (std::int64_t i = 0; i < effort(300'000); ++i) {
        const bool lattice = bits.chance(0.2);
        const double scale = std::exp2(bits.uniform(-30, 30));
        const auto any = [&] { return T(lattice ? double(bits.below(5)) - 2 : scale * bits.uniform(-1, 1)); };
        const T e0 = any(), e2 = any();
        const linear_interval<T> one = linear_edge_inside(e0, e2), other = linear_edge_inside(-e0, -e2);
        const auto has = [](const linear_interval<T>& x, T begin, T end) { return x.begin == begin && x.end == end; };
        if (e0 == 0 && e2 == 0) { // on the edge all of the time
            REQUIRE(has(one, 0, 1));
            REQUIRE(has(other, 0, 1));
        } else if ((e0 < 0) == (e2 < 0) || e0 == 0 || e2 == 0) {
            const bool inside = e0 > 0 || e2 > 0;
            REQUIRE((inside ? one.end - one.begin : other.end - other.begin) == 1);
            REQUIRE((inside ? other.end <= other.begin : one.end <= one.begin));
        } else {
            ++crossed;
            const T root = e0 < 0 ? one.begin : one.end;
            REQUIRE(has(one, e0 < 0 ? root : T(0), e0 < 0 ? T(1) : root));
            REQUIRE(has(other, e0 < 0 ? T(0) : root, e0 < 0 ? root : T(1)));
            const exact expected = exact(e0) / (exact(e0) - exact(e2));
            REQUIRE(std::abs(exact(root) - expected) <= 4 * exact(u<T>) * expected);
        }
    }
    CHECK(crossed > effort(300'000) / 3);
}

TEST_CASE_TEMPLATE("linear_coverage is moving_coverage of linear edges, except for the roots' errors", T, float, double)
{
    bit_source bits(8);
    std::int64_t covered = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto any = [&] {
            const T e0 = T(bits.uniform(-1, 1)), e2 = T(bits.uniform(-1, 1));
            return moving_edge<T>{e0, T(0.5) * (e0 + e2), e2};
        };
        const moving_edges<T> e{any(), any(), any()};
        const linear_interval<T> x = linear_coverage(e);
        const coverage_intervals<T> y = moving_coverage(e, T(1));
        // A coefficient that is wrong by 16 2^-p moves a root by as much over the slope.
        double slope = 2;
        for (const moving_edge<T>& k : {e.a, e.b, e.c}) slope = std::min(slope, std::abs(double(k.e2) - double(k.e0)));
        const double tolerance = 32 * u<T> / slope + 8 * u<T>;
        if (std::abs(double(x.end) - double(x.begin)) <= 2 * tolerance) continue;
        REQUIRE((x.begin < x.end) == (y.count == 1));
        if (y.count == 0) continue;
        ++covered;
        REQUIRE(std::abs(double(x.begin) - double(y.begin0)) <= tolerance);
        REQUIRE(std::abs(double(x.end) - double(y.end0)) <= tolerance);
    }
    CHECK(covered > effort(200'000) / 20);
}

// Six triangles around a vertex that passes near the sample, within a ring that keeps away from both.
// Half of them have equal motions, on a grid on which sums are exact. Their spokes are linear in time, and may be taken
// for linear edges.
TEST_CASE_TEMPLATE("a fan of triangles covers a sample at every time, without a crack", T, float, double)
{
    bit_source bits(6);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const bool alike = bits.chance(0.5);
        const auto grid = [](double x) { return T(std::round(x * 4096) / 4096); };
        const T shift_x = grid(bits.uniform(-0.2, 0.2)), shift_y = grid(bits.uniform(-0.2, 0.2));
        const auto vertex = [&](double radius, double angle) {
            const auto x = [&](double noise) { return grid(radius * std::cos(angle) + bits.uniform(-noise, noise)); };
            const auto y = [&](double noise) { return grid(radius * std::sin(angle) + bits.uniform(-noise, noise)); };
            const double noise = radius > 0 ? 0.1 : 0.3;
            moving_vertex<T> v{x(noise), y(noise), 0, 1, x(noise), y(noise), 0, 1};
            if (alike) v.x1 = v.x0 + shift_x, v.y1 = v.y0 + shift_y;
            return v;
        };
        const T s_x = T(bits.uniform(-0.3, 0.3)), s_y = T(bits.uniform(-0.3, 0.3));
        const moving_vertex<T> centre = vertex(0, 0);
        std::array<moving_vertex<T>, 6> ring;
        for (std::size_t k = 0; k < 6; ++k) ring[k] = vertex(1, double(k) * std::acos(-1.0) / 3);
        std::vector<interval> covered;
        double total = 0;
        const std::uint64_t linear = alike ? bits.below(64) : 0; // a bit for each spoke
        const auto inside = [&](const moving_edge<T>& e, std::size_t spoke) {
            if ((linear >> spoke % 6 & 1) == 0) return moving_edge_inside(e, T(1));
            const linear_interval<T> x = linear_edge_inside(e.e0, e.e2);
            return edge_intervals<T>{x.begin, x.end, T(coverage_none), T(coverage_none)};
        };
        for (std::size_t k = 0; k < 6; ++k) {
            const moving_triangle<T> m{centre, ring[k], ring[(k + 1) % 6]};
            const moving_edges<T> e = moving_triangle_edges(m, s_x, s_y);
            const coverage_intervals<T> x =
                intersect_edge_intervals(moving_edge_inside(e.a, T(1)), inside(e.b, k + 1), inside(e.c, k));
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
