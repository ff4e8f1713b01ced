// Prisms part by part: crossings and closed surfaces on a lattice, where arithmetic is exact; fragments against
// extended precision; pairs by the rules of the paper; hostile input.
#include "motion/triangle/coverage_check.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"
#include "support/prisms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

moving_vertex<double> lattice_vertex(bit_source& bits, std::size_t size)
{
    const auto any = [&] { return double(bits.below(size)); };
    return {any(), any(), 0.25, 1, any(), any(), -0.5, 1};
}

/// The point at a fraction of the way between two, in extended precision.
exact between(double a, double b, exact s) { return exact(a) + s * (exact(b) - exact(a)); }

} // namespace

TEST_CASE("a side has a crossing if and only if the edge at open crosses the edge at close")
{
    bit_source bits(1);
    std::int64_t crossings = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto a = lattice_vertex(bits, 8), b = lattice_vertex(bits, 8);
        const prism_side<double> side = prism_side_make(a, b, 1.0), swapped = prism_side_make(b, a, 1.0);
        // The ends of each edge are on different sides of the other, in whole numbers.
        const auto turn = [](double px, double py, double qx, double qy, double rx, double ry) {
            return (qx - px) * (ry - py) - (qy - py) * (rx - px);
        };
        const double area = (b.x0 - a.x0) * (b.y1 - a.y1) - (b.y0 - a.y0) * (b.x1 - a.x1);
        const double a0 = turn(a.x1, a.y1, b.x1, b.y1, a.x0, a.y0), b0 = turn(a.x1, a.y1, b.x1, b.y1, b.x0, b.y0);
        const double a1 = turn(a.x0, a.y0, b.x0, b.y0, a.x1, a.y1), b1 = turn(a.x0, a.y0, b.x0, b.y0, b.x1, b.y1);
        const bool crosses = area != 0 && a0 * b0 <= 0 && a1 * b1 <= 0;
        REQUIRE(side.crosses == double(crosses));
        REQUIRE(swapped.crosses == double(crosses));
        REQUIRE(side.centre.t == 0.5);
        crossings += crosses;
        if (crosses) {
            const exact s = exact(a0) / exact(a0 - b0), v = exact(a1) / exact(a1 - b1);
            const exact tolerance = 32 * exact(u<double>);
            REQUIRE(std::abs(exact(side.centre.x) - between(a.x0, b.x0, s)) <= tolerance);
            REQUIRE(std::abs(exact(side.centre.y) - between(a.y0, b.y0, s)) <= tolerance);
            REQUIRE(std::abs(exact(side.centre.x) - between(a.x1, b.x1, v)) <= tolerance);
            REQUIRE(std::abs(exact(side.centre.y) - between(a.y1, b.y1, v)) <= tolerance);
            REQUIRE(side.centre.z == (a.z0 + a.z1) / 2);
            REQUIRE(std::abs(side.centre.inverse_w - 1) <= double(tolerance));
        } else {
            REQUIRE(side.centre.x == (a.x0 + b.x0 + a.x1 + b.x1) / 4);
            REQUIRE(side.centre.y == (a.y0 + b.y0 + a.y1 + b.y1) / 4);
            REQUIRE(side.centre.x == swapped.centre.x);
            REQUIRE(side.centre.y == swapped.centre.y);
        }
    }
    CHECK(20 * crossings > effort(100'000));
}

TEST_CASE("a crossing has the mean depth of the edges that cross")
{
    // From (-1, 0) to (1, 0) at open, depth -1 to 0 along it; from (0.5, -3) to (0.5, 1) at close, depth 0 to 1.
    const moving_vertex<double> a{-1, 0, -1, 1, 0.5, -3, 0, 1}, b{1, 0, 0, 1, 0.5, 1, 1, 1};
    const prism_side<double> side = prism_side_make(a, b, 1.0);
    CHECK(side.crosses == 1);
    CHECK(side.centre.x == 0.5);
    CHECK(side.centre.y == 0);
    CHECK(side.centre.z == (-0.25 + 0.75) / 2);
    CHECK(side.centre.inverse_w == 1);
}

TEST_CASE("a crossing in perspective has the mean depth of the edges in space and the mean 1 / w")
{
    // Distances 1 to 4 and 2 to 4; on the screen as above. In space the crossing is at 3/7 and 3/5 of the edges.
    const moving_vertex<double> a{-1, 0, -1, 1, 1, -6, 0, 2}, b{4, 0, 0, 4, 2, 4, 1, 4};
    const prism_side<double> linear = prism_side_make(a, b, 0.0), divided = prism_side_make(a, b, 1.0);
    for (const auto& side : {linear, divided}) {
        CHECK(side.crosses == 1);
        CHECK(side.centre.x == 0.5);
        CHECK(side.centre.y == 0);
        CHECK(side.centre.inverse_w == ((0.25 * 1 + 0.75 * 0.25) + (0.25 * 0.5 + 0.75 * 0.25)) / 2);
    }
    // Weights 1/4 : 3/16 at open, 1/8 : 3/16 at close.
    CHECK(linear.centre.z == doctest::Approx((-4 / 7.0 + 3 / 5.0) / 2).epsilon(1e-15));
    CHECK(divided.centre.z == (-0.25 + 0.75 * 0.25) / 2);
}

// Coordinates are multiples of 1/4, so every edge function is exact.
TEST_CASE("a closed surface has an even number of fragments, also on its edges and vertices")
{
    bit_source bits(2);
    std::array<std::int64_t, 15> counts{};
    std::int64_t on_edge = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const moving_triangle<double> m{lattice_vertex(bits, 6), lattice_vertex(bits, 6), lattice_vertex(bits, 6)};
        const prism<double> p = prism_make(m, 1.0);
        if (p.ab.crosses + p.bc.crosses + p.ca.crosses > 0) continue;
        const double s_x = double(bits.below(21)) / 4, s_y = double(bits.below(21)) / 4;
        const prism_pair<double> pair = pair_at(p, s_x, s_y);
        REQUIRE(std::fmod(pair.count, 2) == 0);
        ++counts[std::size_t(pair.count)];
        const moving_edges<double> e = moving_triangle_edges(m, s_x, s_y);
        on_edge += pair.count > 0 && (e.a.e0 == 0 || e.b.e0 == 0 || e.c.e0 == 0);
    }
    for (const std::size_t k : {0u, 2u, 4u}) CHECK(counts[k] > 0);
    CHECK(on_edge > 0);
}

TEST_CASE("the triangles of a prism have its corners in turn, and two of a side with a crossing are points")
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const moving_triangle<double> m{lattice_vertex(bits, 9), lattice_vertex(bits, 9), lattice_vertex(bits, 9)};
        const prism<double> p = prism_make(m, 1.0);
        const auto same_place = [](const prism_vertex<double>& a, const prism_vertex<double>& b) {
            return a.x == b.x && a.y == b.y && a.z == b.z && a.t == b.t && a.inverse_w == b.inverse_w;
        };
        const std::array<prism_vertex<double>, 3> open{p.a0, p.b0, p.c0}, close{p.a1, p.b1, p.c1};
        const std::array<prism_side<double>, 3> sides{p.ab, p.bc, p.ca};
        for (std::size_t side = 0; side < 3; ++side) {
            const std::size_t next = (side + 1) % 3;
            const std::array<prism_vertex<double>, 5> loop{open[side], open[next], close[next], close[side],
                                                           open[side]};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto t = prism_triangle_make(p, double(4 * side + k));
                const bool none = sides[side].crosses > 0 && k % 2 == 0;
                REQUIRE(same_place(t.a, loop[k]));
                REQUIRE(same_place(t.b, none ? t.a : loop[k + 1]));
                REQUIRE(same_place(t.c, none ? t.a : sides[side].centre));
                if (none) REQUIRE(prism_fragment_at(t, t.a.x, t.a.y, 1.0).covered == 0);
            }
        }
        for (const auto& [k, corners] : {std::pair{12.0, open}, std::pair{13.0, close}}) {
            const auto t = prism_triangle_make(p, k);
            REQUIRE((same_place(t.a, corners[0]) && same_place(t.b, corners[1]) && same_place(t.c, corners[2])));
        }
        const auto t = prism_triangle_make(p, 14.0);
        REQUIRE((same_place(t.a, t.b) && same_place(t.a, t.c)));
    }
}

// The errors are those that prism_fragment_at states.
TEST_CASE_TEMPLATE("fragments have the time and depth of the plane in space, for either winding", T, float, double)
{
    bit_source bits(4);
    std::int64_t covered = 0, asked = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const moving_scene scene = draw_moving_scene(movement(bits.below(5)), bits);
        const auto seen = any_seen_prism_triangle(rounded_triangle<T>(scene.triangle), bits);
        const prism_triangle<T>& v = seen.triangle;
        const std::array<prism_vertex<T>, 3> p{v.a, v.b, v.c};
        const T divided = T(bits.below(2));
        const auto f = prism_fragment_at(v, seen.s_x, seen.s_y, divided);
        std::array<exact, 3> e;
        exact x = 0, y = 0, largest = 0;
        const exact s_x = exact(seen.s_x), s_y = exact(seen.s_y);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto &q = p[(k + 1) % 3], &r = p[(k + 2) % 3];
            e[k] = (exact(q.x) - s_x) * (exact(r.y) - s_y) - (exact(q.y) - s_y) * (exact(r.x) - s_x);
            x = std::max(x, std::abs(exact(p[k].x) - s_x));
            y = std::max(y, std::abs(exact(p[k].y) - s_y));
            largest = std::max(largest, std::abs(exact(p[k].z)));
        }
        const exact tolerance = 8 * exact(u<T>) * x * y;
        const bool front = e[0] > tolerance && e[1] > tolerance && e[2] > tolerance;
        const bool back = e[0] < -tolerance && e[1] < -tolerance && e[2] < -tolerance;
        const exact least = std::min({e[0], e[1], e[2]}), most = std::max({e[0], e[1], e[2]});
        ++asked;
        covered += front || back;
        if (front || back) REQUIRE(f.covered == 1);
        if (least < -tolerance && most > tolerance) REQUIRE(f.covered == 0);
        if (f.covered == 0) continue;
        // If only rounding puts the sample inside, the sample is within the tolerance of the triangle.
        const auto require_mean = [&](T found, T prism_vertex<T>::*of, bool weighted, exact least_value, exact unit) {
            exact mean = 0, weight = 0, most_weight = 0;
            for (const std::size_t k : {0u, 1u, 2u}) {
                const exact v_k = weighted ? exact(p[k].inverse_w) : 1;
                mean += e[k] * v_k * exact(p[k].*of), weight += e[k] * v_k;
                most_weight = std::max(most_weight, v_k);
            }
            const exact bound = (48 * x * y * most_weight / std::abs(weight) + 10) * exact(u<T>);
            if (bound < 0.1L)
                REQUIRE(std::abs(exact(found) - std::clamp(mean / weight, least_value, 1.0L)) <= bound * unit);
        };
        require_mean(f.time, &prism_vertex<T>::t, true, 0, 1);
        require_mean(f.depth, &prism_vertex<T>::z, divided == 0, -1, largest);
        if (p[0].t == p[1].t && p[1].t == p[2].t) REQUIRE(f.time == p[0].t);
        // The other winding covers the sample as well, and a neighbour across an edge has the sample on the other side.
        REQUIRE(prism_fragment_at(prism_triangle<T>{v.b, v.a, v.c}, seen.s_x, seen.s_y, divided).covered == 1);
        const T side = prism_edge_side(v.a, v.b, prism_edge(v.a, v.b, seen.s_x, seen.s_y));
        REQUIRE(prism_edge_side(v.b, v.a, prism_edge(v.b, v.a, seen.s_x, seen.s_y)) == -side);
    }
    CHECK(2 * covered > asked);
}

TEST_CASE_TEMPLATE("pairs form ranges by the rules, for any number of fragments in any order", T, float, double)
{
    using fragments = std::vector<prism_fragment<T>>;
    const auto paired = [](fragments list) {
        const auto by_depth = [](const prism_fragment<T>& a, const prism_fragment<T>& b) {
            return std::pair(a.depth, a.time) < std::pair(b.depth, b.time);
        };
        std::sort(list.begin(), list.end(), by_depth);
        std::vector<std::array<T, 13>> results;
        do {
            prism_pair<T> state = prism_pair_begin(T(5));
            state = prism_pair_add(state, prism_fragment<T>{T(0), T(0.5), T(-1)}); // not covered
            for (const auto& f : list) state = prism_pair_add(state, f);
            const prism_ranges<T> r = prism_pair_end(state);
            std::array<T, 13> numbers{state.count, r.count};
            std::memcpy(numbers.data() + 2, &r.first, sizeof r.first);
            std::memcpy(numbers.data() + 7, &r.second, sizeof r.second);
            results.push_back(numbers);
            REQUIRE(results.front() == results.back());
        } while (std::next_permutation(list.begin(), list.end(), by_depth));
        return results.front();
    };
    const auto f = [](double t, double z) { return prism_fragment<T>{1, T(t), T(z)}; };
    using row = std::array<T, 13>;
    CHECK(paired({}) == row{0, 0, 1, 0, 1, 1, 5, 1, 0, 1, 1, 5});
    CHECK(paired({f(0.5, 0)}) == row{1, 0, 1, 0, 1, 1, 5, 1, 0, 1, 1, 5});
    CHECK(paired({f(0.5, 0.25), f(0.25, 0.75)}) == row{2, 1, T(0.25), T(0.5), T(0.75), T(0.25), 5, 1, 0, 1, 1, 5});
    CHECK(paired({f(0, 0), f(0.75, 0.5), f(0.5, -0.5)}) == row{3, 1, 0, T(0.75), 0, T(0.5), 5, 1, 0, 1, 1, 5});
    CHECK(paired({f(0, 0.5), f(0.25, 0.25), f(0.5, 0), f(1, -0.5)}) ==
          row{4, 2, T(0.5), 1, 0, T(-0.5), 5, 0, T(0.25), T(0.5), T(0.25), 5});
    CHECK(paired({f(0, 0.5), f(0.25, 0.25), f(0.5, 0), f(1, -0.5), f(0.125, 1)}) ==
          row{5, 1, 0, 1, T(0.5), T(-0.5), 5, 1, 0, 1, 1, 5});
    bit_source bits(5);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        fragments list;
        for (std::size_t n = bits.below(6); n > 0; --n)
            list.push_back(f(double(bits.below(3)) / 2, double(bits.below(3)) / 2));
        (void)paired(list);
    }
}

TEST_CASE("a map of prisms has the size of Hong and Oh's Equation 2")
{
    CHECK(prism_map_bytes(2.0, 0.0, 0.0) == 32);
    CHECK(prism_map_bytes(0.0, 2.0, 0.0) == 48);
    CHECK(prism_map_bytes(3.0, 1.0, 1024.0 * 768) == 3 * 16 + 24 + 2 * 1024 * 768 * 4);
}

TEST_CASE_TEMPLATE("for any input, fragments and ranges are within their limits", T, float, double)
{
    hostile_source<T> hostile(8);
    bit_source bits(9);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        moving_triangle<T> m = rounded_triangle<T>(draw_moving_scene(movement::deformed, bits).triangle);
        std::array<T, 26> numbers{};
        std::memcpy(numbers.data(), &m, sizeof m);
        const std::size_t kind = bits.below(3);
        for (T& x : numbers)
            if (kind > 0 || bits.chance(0.1)) x = kind == 1 ? hostile.special() : hostile.pattern();
        std::memcpy(&m, numbers.data(), sizeof m);
        const T divided = T(bits.chance(0.5));
        const prism<T> p = prism_make(m, divided);
        prism_pair<T> pair = prism_pair_begin(T(1));
        for (int k = 0; k < 15; ++k) {
            const T which = k < 14 ? T(k) : hostile.pattern();
            prism_fragment<T> f = prism_fragment_at(prism_triangle_make(p, which), numbers[24], numbers[25], divided);
            REQUIRE((f.covered == 0 || f.covered == 1));
            REQUIRE((f.time >= 0 && f.time <= 1));
            REQUIRE(std::abs(f.depth) <= 1);
            if (bits.chance(0.2)) f = {hostile.special(), hostile.pattern(), hostile.special()};
            pair = prism_pair_add(pair, f);
        }
        const prism_ranges<T> r = prism_pair_end(pair);
        REQUIRE((r.count == 0 || r.count == 1 || r.count == 2));
        for (const auto& range : {r.first, r.second}) {
            REQUIRE((range.t0 >= 0 && range.t1 <= 1));
            REQUIRE((std::abs(range.z0) <= 1 && std::abs(range.z1) <= 1));
        }
        REQUIRE((r.first.t0 <= r.first.t1) == (r.count > 0));
        REQUIRE((r.second.t0 <= r.second.t1) == (r.count > 1));
    }
}
