// Times at which depth is on one side of a plane: cubics against their values at many times and under a climber; and
// widened edges against exact ones.
#include "coverage_check.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"

#include <gnomon/motion/triangle/depth_planes.h>
#include <gnomon/motion/triangle/edge_widening.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> exact value_at(const moving_cubic<T>& h, exact t)
{
    const exact s = 1 - t;
    return exact(h.h0) * s * s * s + exact(h.h1) * s * s * t + exact(h.h2) * s * t * t + exact(h.h3) * t * t * t;
}

template <class T> bool is_inside(const edge_intervals<T>& x, exact t)
{
    return exact(x.begin) <= t && t <= exact(x.end) && !(exact(x.gap_begin) < t && t < exact(x.gap_end));
}

template <class T> T size_of(const moving_cubic<T>& h)
{
    return std::max({std::abs(h.h0), std::abs(h.h1), std::abs(h.h2), std::abs(h.h3)});
}

/// Part of the stated error by which the cubic's value is on the wrong side of 0 at a time t. The error is 16 roundings
/// of the largest coefficient, and the change of the value within 2^-24, with a slope of at most 6 times the largest.
template <class T> exact wrong_by(const moving_cubic<T>& h, exact t)
{
    const exact error =
        exact(size_of(h)) * (16 * exact(u<T>) + 6 * std::exp2(exact(-24))) + std::numeric_limits<exact>::min();
    const exact value = value_at(h, t);
    return (is_inside(moving_cubic_inside(h), t) ? -value : value) / error;
}

} // namespace

TEST_CASE_TEMPLATE("moving_cubic_inside: the times at which the cubic is not negative, within its error", T, float,
                   double)
{
    bit_source bits(61);
    int kinds[2] = {0, 0};
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const auto coefficient = [&] {
            return T(bits.chance(0.1) ? 0 : std::exp2(bits.uniform(-20, 20)) * bits.uniform(-1, 1));
        };
        moving_cubic<T> h{coefficient(), coefficient(), coefficient(), coefficient()};
        // Roots within the shutter, up to three of them.
        if (bits.chance(0.7)) {
            std::array<exact, 4> power{exact(bits.uniform(-1, 1)), 0, 0, 0};
            for (std::size_t k = 0; k < 3; ++k) {
                const exact root = exact(bits.uniform(-0.1, 1.1));
                for (std::size_t j = 4; j-- > 0;) power[j] = (j > 0 ? power[j - 1] : 0) - root * power[j];
            }
            h = {T(power[0]), T(3 * power[0] + power[1]), T(3 * power[0] + 2 * power[1] + power[2]),
                 T(power[0] + power[1] + power[2] + power[3])};
        }
        const T t = T(bits.uniform(0, 1));
        REQUIRE(std::abs(exact(moving_cubic_at(h, t)) - value_at(h, exact(t))) <= 8 * exact(u<T>) * exact(size_of(h)));
        const edge_intervals<T> x = moving_cubic_inside(h);
        ++kinds[x.gap_begin < T(coverage_none)];
        for (int k = 0; k < 16; ++k) REQUIRE(wrong_by(h, exact(bits.uniform(0, 1))) <= 1);
    }
    CHECK(kinds[0] > effort(50'000) / 10);
    CHECK(kinds[1] > effort(50'000) / 10);
}

TEST_CASE("moving_cubic_inside: a climber finds no larger error")
{
    const auto score = [](const std::vector<double>& place) {
        moving_cubic<float> h{};
        float* const c[]{&h.h0, &h.h1, &h.h2, &h.h3};
        for (std::size_t k = 0; k < 4; ++k) *c[k] = static_cast<float>(2 * place[k] - 1);
        return static_cast<double>(wrong_by(h, exact(place[4])));
    };
    const summit top = climb(5, 200'000, 62, score);
    MESSAGE("of the stated error: ", top.score);
    CHECK(top.score <= 1);
    CHECK(top.score > (draws_few() ? 0 : 0.01));
}

TEST_CASE("depth intervals: none for NaN and beyond the range of coefficients")
{
    const float nan = std::nanf("");
    for (const moving_cubic<float>& h :
         {moving_cubic<float>{nan, 1, 1, 1}, moving_cubic<float>{1, nan, 1, 1}, moving_cubic<float>{1, 1, 1, 1e30f}})
        CHECK(moving_cubic_inside(h).end == 0);
}

// Planes in double, rounded to float, as in the rasterizer.
TEST_CASE("widened edges are inside whenever exact ones are, and hardly longer")
{
    bit_source bits(63);
    std::int64_t inside = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const moving_scene scene = draw_moving_scene(movement(std::size_t(i) % movement_count), bits);
        const double h = std::exp2(bits.uniform(-6, 0));
        const auto s_x = static_cast<float>(bits.uniform(-h, h)), s_y = static_cast<float>(bits.uniform(-h, h));
        const triangle_setup<double> field =
            triangle_setup_make(scene.triangle, scene.s_x - double(s_x), scene.s_y - double(s_y));
        const auto rounded_plane = [](const sample_plane<double>& p) {
            return sample_plane<float>{float(p.x), float(p.y), float(p.c)};
        };
        const edge_equation<float> f{rounded_plane(field.a.e0), rounded_plane(field.a.e1), rounded_plane(field.a.e2)};
        const float facing = bits.chance(0.5) ? 1.f : -1.f, reach = static_cast<float>(h);
        const auto exact_at = [&](const sample_plane<double>& p) {
            return exact(p.c) + exact(p.x) * exact(s_x) + exact(p.y) * exact(s_y);
        };
        const exact e0 = exact_at(field.a.e0), e1 = exact_at(field.a.e1), e2 = exact_at(field.a.e2);
        const float error = edge_equation_error(f, reach, reach), straight = linear_edge_error(f, reach, reach);
        const auto widened = [&](float by) { return edge_equation_at(edge_equation_widen(f, by, facing), s_x, s_y); };
        const edge_intervals<float> wide = moving_edge_inside(widened(error), facing);
        const moving_edge<float> side = widened(straight);
        const linear_interval<float> line = linear_edge_inside(facing * side.e0, facing * side.e2);
        const auto check = [&](exact t) {
            const exact s = 1 - t, value = exact(facing) * (e0 * s * s + 2 * e1 * s * t + e2 * t * t);
            if (value > 0) REQUIRE(is_inside(wide, t));
            if (value > 0) REQUIRE(exact(line.begin) <= t);
            if (value > 0) REQUIRE(t <= exact(line.end));
            if (is_inside(wide, t)) REQUIRE(value >= -3 * exact(error));
            inside += value > 0;
        };
        for (int k = 0; k < 8; ++k) check(exact(bits.uniform(0, 1)));
        // Times beside those at which the depth passes the plane.
        for (const float t : {wide.begin, wide.end, wide.gap_begin, wide.gap_end})
            for (const int ulps : {-4, -1, 0, 1, 4})
                if (t <= 1) check(std::clamp(exact(t) * (1 + ulps * exact(u<float>)), exact(0), exact(1)));
    }
    CHECK(inside > 0);
}
