// Lines that approximate depth: no depth deviates from one by more than its bound, and intervals are cut into pieces
// whose lines hold to a tolerance. Depths are of the numbers that the kernels get, in extended precision.
#include "motion/receiver/moving_reference.hpp"
#include "support/climber.hpp"

#include <gnomon/motion/triangle/triangle_setup.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Depth at a time without limits, the D that it is divided by, and the rounding of its numerator, in units of 2^-p.
struct depth_now {
    exact z, divisor, noise;
};

exact mixed(auto a, auto b, exact t) { return exact(a) * (1 - t) + exact(b) * t; }

template <class T> exact largest(const moving_edge<T>& e)
{
    return std::max({std::abs(exact(e.e0)), std::abs(exact(e.e1)), std::abs(exact(e.e2))});
}

/// From the comment of moving_depth_line.
template <class T> struct corner_depth {
    moving_triangle<T> m;
    moving_edges<T> e;
    bool divided;
    T facing = 1;
    exact least = -1, most = 1;

    depth_now at(exact t, exact deviation) const
    {
        depth_now r{0, 0, 0};
        const std::array vertices{m.a, m.b, m.c};
        const std::array edges{e.a, e.b, e.c};
        for (std::size_t k = 0; k < 3; ++k) {
            const moving_vertex<T>& v = vertices[k];
            const moving_edge<T>& f = edges[k];
            // Within a covered interval an edge function is below 0 only by rounding.
            const exact edge = std::max(exact(facing) * mixed(mixed(f.e0, f.e1, t), mixed(f.e1, f.e2, t), t), exact(0));
            const exact w0 = divided ? exact(v.w0) : 1, w1 = divided ? exact(v.w1) : 1;
            r.z += edge * mixed(v.z0, v.z1, t);
            r.divisor += edge * mixed(w0, w1, t);
            r.noise += 64 * largest(f) *
                       (std::max(std::abs(exact(v.z0)), std::abs(exact(v.z1))) +
                        (1 + deviation) * std::max(std::abs(w0), std::abs(w1)));
        }
        r.z /= r.divisor;
        return r;
    }
    T kernel(T t) const { return moving_depth_at(m, e, t, T(divided)); }
    depth_line<T> line(T begin, T end) const { return moving_depth_line(m, e, begin, end, T(divided)); }
    depth_piece<T> piece(T begin, T end, T passed, T tolerance) const
    {
        return moving_depth_piece(m, e, begin, end, passed, T(divided), tolerance);
    }
};

/// From the comment of depth_curve_line.
template <class T> struct curve_depth {
    depth_curve<T> c;
    bool linear = false;
    exact r = 0; // |N / D| at the ends, the larger

    exact least = exact(c.least), most = exact(c.most);

    depth_now at(exact t, exact deviation) const
    {
        const exact s = 1 - t;
        const exact n = linear ? mixed(c.n0, c.n3, t)
                               : exact(c.n0) * s * s * s + exact(c.n1) * s * s * t + exact(c.n2) * s * t * t +
                                     exact(c.n3) * t * t * t;
        const exact d = linear ? mixed(c.d0, c.d2, t) : exact(c.d0) * s * s + exact(c.d1) * s * t + exact(c.d2) * t * t;
        const exact n_size = std::max(
            {std::abs(exact(c.n0)), std::abs(exact(c.n1)) / 3, std::abs(exact(c.n2)) / 3, std::abs(exact(c.n3))});
        const exact d_size = std::max({std::abs(exact(c.d0)), std::abs(exact(c.d1)) / 2, std::abs(exact(c.d2))});
        const exact depths = std::max({exact(1), std::abs(exact(c.z0)), std::abs(exact(c.z1))});
        return {mixed(c.z0, c.z1, t) + n / d, d, 24 * (n_size + d_size * (r + deviation)) + 8 * depths * std::abs(d)};
    }
    T kernel(T t) const { return linear ? linear_depth_at(c, t) : depth_curve_at(c, t); }
    depth_line<T> line(T begin, T end)
    {
        const auto above = [&](T t) { return std::abs(at(exact(t), 0).z - mixed(c.z0, c.z1, exact(t))); };
        r = std::max(above(begin), above(end));
        return linear ? linear_depth_line(c, begin, end) : depth_curve_line(c, begin, end);
    }
    depth_piece<T> piece(T begin, T end, T passed, T tolerance) const
    {
        return depth_curve_piece(c, begin, end, passed, tolerance);
    }
};

/// Largest distance of depth from the line between two times: over the deviation with its stated error, and over the
/// deviation alone; and the error.
struct departure {
    double ratio, plain, error;
};

template <class T, class Depth> departure departs(const Depth& depth, T begin, T end, const depth_line<T>& line)
{
    exact worst = 0, divisor = HUGE_VALL, noise = 0;
    for (int i = 0; i <= 64; ++i) {
        const exact t = mixed(begin, end, exact(i) / 64);
        const depth_now now = depth.at(t, exact(line.deviation));
        const exact z = std::clamp(now.z, depth.least, depth.most);
        if (i > 0 && i < 64) worst = std::max(worst, std::abs(z - mixed(line.z0, line.z1, exact(i) / 64)));
        divisor = std::min(divisor, std::abs(now.divisor));
        noise = std::max(noise, now.noise);
    }
    const exact error = exact(u<T>) * noise / divisor, deviation = exact(line.deviation);
    return {double(worst / (deviation + error)), deviation > 0 ? double(worst / deviation) : 0, double(error)};
}

/// A curve and two times, with numbers of either sign, some of very different sizes.
template <class T> struct climbed_curve {
    curve_depth<T> depth;
    T begin, end;

    explicit climbed_curve(const std::vector<double>& p, bool linear)
    {
        const auto number = [&](std::size_t k) { return T(2 * p[k] - 1); };
        const auto [low, high] = std::minmax({number(9), number(10)});
        std::tie(begin, end) = std::minmax({T(p[11]), T(p[12])});
        depth.c = {number(0), 3 * number(1), 3 * number(2), number(3), T(p[4]), 2 * number(5),
                   T(p[6]),   number(7),     number(8),     low,       high};
        depth.linear = linear;
        depth.least = exact(low), depth.most = exact(high);
    }
};

/// A triangle in perspective, or not, seen by a sample that one of its points passes.
template <class T> struct climbed_triangle {
    corner_depth<T> depth;
    coverage_intervals<T> covered;

    explicit climbed_triangle(const std::vector<double>& p, bool divided)
    {
        std::array<moving_vertex<T>, 3> v;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto number = [&](std::size_t i) { return T(2 * p[8 * k + i] - 1); };
            const auto w = [&](std::size_t i) { return T(std::exp2(4 * p[8 * k + i])); };
            v[k] = {number(0), number(1), number(2), w(3), number(4), number(5), number(6), w(7)};
        }
        const double t = p[24], a = p[25], b = p[26] * (1 - a);
        const auto mean = [&](auto of) { return a * of(v[0]) + b * of(v[1]) + (1 - a - b) * of(v[2]); };
        const auto at = [&](T q, T r) { return double(q) + t * (double(r) - double(q)); };
        const double w = mean([&](const auto& q) { return at(q.w0, q.w1); });
        const T s_x = T(mean([&](const auto& q) { return at(q.x0, q.x1); }) / w);
        const T s_y = T(mean([&](const auto& q) { return at(q.y0, q.y1); }) / w);
        const moving_triangle<T> m{v[0], v[1], v[2]};
        depth = {m, moving_triangle_edges(m, s_x, s_y), divided, p[27] < 0.5 ? T(1) : T(-1)};
        covered = moving_coverage(depth.e, depth.facing);
    }
};

template <class T, class Depth> std::vector<depth_piece<T>> pieces_of(const Depth& depth, T begin, T end, T tolerance)
{
    std::vector<depth_piece<T>> pieces;
    for (T passed = 0; passed < 1; passed = pieces.back().passed)
        pieces.push_back(depth.piece(begin, end, passed, tolerance));
    return pieces;
}

constexpr double shortest = 33.0 / 1024;

struct piece_counts {
    std::int64_t intervals = 0, pieces = 0, short_ones = 0, sharp = 0;
    std::size_t most = 0;
};

/// Check the claims of the comment of moving_depth_piece.
template <class T, class Depth> void check_pieces(Depth depth, T begin, T end, T tolerance, piece_counts& counts)
{
    const auto pieces = pieces_of(depth, begin, end, tolerance);
    ++counts.intervals;
    counts.pieces += std::int64_t(pieces.size());
    counts.most = std::max(counts.most, pieces.size());
    REQUIRE(pieces.size() <= 32);
    REQUIRE(pieces.front().t0 == begin);
    REQUIRE(pieces.back().t1 == end);
    T passed = 0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const depth_piece<T>& p = pieces[k];
        if (k > 0) REQUIRE(p.t0 == pieces[k - 1].t1);
        if (k > 0) REQUIRE(p.z0 == pieces[k - 1].z1);
        REQUIRE(p.t0 <= p.t1);
        REQUIRE(p.z0 == depth.kernel(p.t0));
        REQUIRE(p.z1 == depth.kernel(p.t1));
        const depth_line<T> line = depth.line(p.t0, p.t1);
        const T share = p.passed - passed;
        passed = p.passed;
        if (share < T(shortest) + T(0x1p-20)) ++counts.short_ones;
        else REQUIRE(line.deviation <= tolerance);
        const departure found = departs<T>(depth, p.t0, p.t1, line);
        REQUIRE(found.ratio <= 1);
        counts.sharp += found.plain > 0.5;
    }
}

} // namespace

TEST_CASE_TEMPLATE("depth_curve_line: no depth deviates from the line by more than its bound", T, float, double)
{
    for (const bool linear : {false, true}) {
        const auto score = [&](auto figure) {
            return [figure, linear](const std::vector<double>& p) {
                climbed_curve<T> x(p, linear);
                const depth_line<T> line = x.depth.line(x.begin, x.end);
                REQUIRE(line.deviation >= 0);
                REQUIRE(line.z0 == x.depth.kernel(x.begin));
                REQUIRE(line.z1 == x.depth.kernel(x.end));
                return figure(departs<T>(x.depth, x.begin, x.end, line));
            };
        };
        const summit worst = climb(13, 300'000, 1, score([](const departure& d) { return d.ratio; }));
        CHECK(worst.score <= 1);
        CHECK(worst.score > 0.9); // the bound is attained
    }
}

TEST_CASE_TEMPLATE("moving_depth_line: no depth deviates from the line by more than its bound", T, float, double)
{
    for (const bool divided : {false, true}) {
        const summit worst = climb(28, 300'000, 2, [&](const std::vector<double>& p) {
            const climbed_triangle<T> x(p, divided);
            if (x.covered.count == 0) return 0.0;
            const T begin = x.covered.begin0, end = x.covered.end0;
            const depth_line<T> line = x.depth.line(begin, end);
            REQUIRE(line.z0 == x.depth.kernel(begin));
            REQUIRE(line.z1 == x.depth.kernel(end));
            return departs<T>(x.depth, begin, end, line).ratio;
        });
        CHECK(worst.score <= 1);
        CHECK(worst.score > 0.9);
    }
}

// An S-shaped curve crosses its line at all quarters of the time, and is far from it elsewhere.
TEST_CASE("a curve that crosses its line in the middle is not taken for a line")
{
    const depth_curve<double> s{0, 0.75, -0.75, 0, 1, 2, 1, 0, 0, -1, 1};
    CHECK(depth_curve_at(s, 0.5) == 0);
    const depth_line<double> line = depth_curve_line(s, 0.0, 1.0);
    CHECK(line.deviation == 0.1875);
    CHECK(line.deviation > depth_curve_at(s, 0.25));
    CHECK(depth_curve_at(s, 0.25) > 0.07);
}

TEST_CASE_TEMPLATE("pieces fill an interval bit for bit and keep the tolerance", T, float, double)
{
    constexpr T tolerance = T(0.005);
    bit_source bits(14);
    piece_counts corners, curves;
    for (std::int64_t i = 0; i < effort(40'000); ++i) {
        const auto how = movement(std::size_t(i) % 5);
        const moving_scene scene = draw_moving_scene(how, bits);
        const moving_triangle<T> m = rounded_triangle<T>(scene.triangle);
        const moving_edges<T> e = moving_triangle_edges(m, T(scene.s_x), T(scene.s_y));
        const T facing = bits.chance(0.5) ? T(1) : T(-1);
        const coverage_intervals<T> x = moving_coverage(e, facing);
        if (x.count == 0) continue;
        check_pieces<T>(corner_depth<T>{m, e, bits.chance(0.5), facing}, x.begin0, x.end0, tolerance, corners);
        const triangle_setup<T> field = triangle_setup_make(m, T(scene.s_x), T(scene.s_y));
        const depth_curve<T> curve = moving_depth_curve(depth_setup_make(field, m), e, T(0), T(0));
        check_pieces<T>(curve_depth<T>{curve}, x.begin0, x.end0, tolerance, curves);
    }
    for (const piece_counts& x : {corners, curves}) {
        CHECK(x.pieces < 4 * x.intervals);
        if (!draws_few()) CHECK(10 * x.short_ones < x.pieces); // two intervals beside a turn have 64
        CHECK(x.most > 8);
        CHECK(4 * x.sharp > x.pieces);
    }
}
