// Line samples: what a line sees is what samples along it see, in 120 digits; straight edges that cross a receiver's cell.
#include "receiver_cases.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"
#include "support/oracle.hpp"

#include <gnomon/motion/receiver/line_sample.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

line_sample<double> any_line(bit_source& bits)
{
    const bool rows = bits.chance(0.5);
    const double length = std::exp2(bits.uniform(-6, 0));
    return {bits.uniform(0, 1), rows ? length : 0, rows ? 0 : length};
}

moving_triangle<double> on_line(const moving_triangle<double>& m, const line_sample<double>& line)
{
    return {line_sample_vertex(m.a, line), line_sample_vertex(m.b, line), line_sample_vertex(m.c, line)};
}

/// The edge function from a to b at a time and a sample, by its definition, and the sum of its terms' sizes.
struct edge_in_digits {
    high value, size;

    edge_in_digits(const moving_vertex<double>& a, const moving_vertex<double>& b, const high& t, const high& x,
                   const high& y)
    {
        const auto mean = [&](double q, double r) { return high((1 - t) * high(q) + t * high(r)); };
        const high aw = mean(a.w0, a.w1), bw = mean(b.w0, b.w1);
        const high ax = mean(a.x0, a.x1), ay = mean(a.y0, a.y1), bx = mean(b.x0, b.x1), by = mean(b.y0, b.y1);
        value = (ax - x * aw) * (by - y * bw) - (ay - y * aw) * (bx - x * bw);
        size = (abs(ax) + (abs(x) + 1) * abs(aw)) * (abs(by) + (abs(y) + 1) * abs(bw)) +
               (abs(ay) + (abs(y) + 1) * abs(aw)) * (abs(bx) + (abs(x) + 1) * abs(bw));
    }
};

} // namespace

TEST_CASE_TEMPLATE("line_sample_vertex: within the stated error, and its places are those of the definition", T, float,
                   double)
{
    bit_source bits(71);
    double most = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        std::array<T, 8> v;
        for (T& c : v) c = T(std::exp2(bits.uniform(-8, 8)) * (bits.chance(0.5) ? 1 : -1));
        const line_sample<T> line{T(bits.uniform(0, 1)), T(bits.uniform(-2, 2)), T(bits.uniform(-2, 2))};
        const auto found = line_sample_vertex(moving_vertex<T>{v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]}, line);
        const auto mean = [&](std::size_t k) {
            return wide(v[k]) * (1 - wide(line.t)) + wide(v[k + 4]) * wide(line.t);
        };
        const auto check = [&](T got, std::size_t k, wide along, int side) {
            const wide size = std::abs(wide(v[k])) + std::abs(wide(v[k + 4])) +
                              std::abs(along) * (std::abs(wide(v[3])) + std::abs(wide(v[7])));
            const wide expected = mean(k) + side * along / 2 * mean(3);
            most = std::max(most, double(std::abs(wide(got) - expected) / (8 * rounding<T> * size)));
        };
        check(found.x0, 0, wide(line.along_x), 1), check(found.x1, 0, wide(line.along_x), -1);
        check(found.y0, 1, wide(line.along_y), 1), check(found.y1, 1, wide(line.along_y), -1);
        check(found.z0, 2, 0, 1), check(found.w0, 3, 0, 1);
        CHECK((found.z0 == found.z1 && found.w0 == found.w1));
    }
    CHECK_MESSAGE(most <= 1, most);
    CHECK(most > 0.125);
}

TEST_CASE("line_sample: a line sees what samples along it see, in perspective, too")
{
    CHECK(rc::check("edges, covered places and depth", [](std::uint64_t seed) {
        bit_source bits(seed);
        const auto scene = draw_moving_scene(movement(bits.below(movement_count)), bits);
        const line_sample<double> line = any_line(bits);
        const moving_triangle<double>&m = scene.triangle, of_line = on_line(m, line);
        const moving_edges<double> edges = moving_triangle_edges(of_line, scene.s_x, scene.s_y);
        const double p = bits.uniform(0, 1);
        const high x = high(scene.s_x) + (high(p) - 0.5) * line.along_x,
                   y = high(scene.s_y) + (high(p) - 0.5) * line.along_y;
        const std::array<edge_in_digits, 3> exact{edge_in_digits(m.b, m.c, line.t, x, y),
                                                  edge_in_digits(m.c, m.a, line.t, x, y),
                                                  edge_in_digits(m.a, m.b, line.t, x, y)};
        const std::array found{moving_edge_at(edges.a, p), moving_edge_at(edges.b, p), moving_edge_at(edges.c, p)};
        constexpr double slack = 64 * 0x1p-53;
        bool inside = true, outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            RC_ASSERT(abs(high(found[k]) - exact[k].value) <= slack * exact[k].size);
            inside = inside && exact[k].value > slack * exact[k].size;
            outside = outside || exact[k].value < -slack * exact[k].size;
        }
        const auto covered = moving_coverage(edges, 1.0);
        const bool sees = (covered.begin0 <= p && p <= covered.end0) || (covered.begin1 <= p && p <= covered.end1);
        if (inside || outside) RC_ASSERT(sees == inside);
        if (!inside) return;
        const auto at_point = moving_triangle_edges(m, double(x), double(y));
        high size = 0, sum = 0;
        for (const edge_in_digits& e : exact) size += e.size, sum += e.value;
        const double depth = moving_depth_at(of_line, edges, p, 0.0), same = moving_depth_at(m, at_point, line.t, 0.0);
        RC_ASSERT(abs(high(depth) - high(same)) <= 16 * slack * size / sum);
    }));
}

TEST_CASE("line_sample_intensity: where two opposite points agree, a straight edge leaves no error")
{
    CHECK(rc::check("of a half-plane", [](std::uint64_t seed) {
        bit_source bits(seed);
        const double angle = bits.uniform(0, 6.28), a = std::cos(angle), b = std::sin(angle),
                     c = bits.uniform(-1.5, 1.5);
        const auto shadow = [&](double x, double y) { return a * x + b * y < c ? 1.0 : 0.0; };
        const double x = bits.uniform(0, 1), y = bits.uniform(0, 1);
        const double up = shadow(x, 0), down = shadow(x, 1), left = shadow(0, y), right = shadow(1, y);
        const double found = line_sample_intensity(up, down, left, right, x, y);
        const double between = (up * (1 - y) + down * y + left * (1 - x) + right * x) / 2;
        if (up == down || left == right) RC_ASSERT(found == shadow(x, y));
        else RC_ASSERT(std::abs(found - between) <= 8 * 0x1p-53);
    }));
}

TEST_CASE_TEMPLATE("line_sample: places are on their texels; what is unknown is lit", T, float, double)
{
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    bit_source bits(73);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const T x = T(bits.uniform(-100, 1000));
        const line_sample_place<T> at = line_sample_place_of(x);
        CHECK((at.place >= 0 && at.place <= 1 && at.texel == std::floor(x)));
        const wide error = std::abs(wide(at.texel) + wide(at.place) - wide(x));
        CHECK(error <= (x < 0 ? rounding<T> : wide(0)));
    }
    CHECK(line_sample_place_of(nan).place == 0);
    hostile_source<T> source(74);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto v = source.draw();
        const T r = line_sample_intensity(v[0], v[1], v[2], v[3], v[4], v[5]);
        REQUIRE((r >= 0 && r <= 1));
    }
    CHECK(line_sample_intensity(nan, nan, T(1), T(1), T(0.5), T(0.5)) == 0);
    CHECK(line_sample_intensity(T(1), nan, T(0), T(1), T(0), nan) == T(0.5));
}
