// Look-ups in maps of line samples against the shadow of a half-plane at one instant, and places outside of the map.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/lines.hpp>
#include <gnomon/passes/range/map.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t side = 12;
constexpr double far = 0.5, near = -0.5; // of receivers and of the shadow's caster

/// The caster covers what is on one side of a line over the map.
struct half_plane {
    double a, b, c;

    explicit half_plane(bit_source& bits)
    {
        const double angle = bits.uniform(0, 6.28), middle = double(side) / 2;
        a = std::cos(angle), b = std::sin(angle);
        c = a * middle + b * middle + bits.uniform(-3, 3);
    }
    bool covers(double x, double y) const { return a * x + b * y < c; }
};

/// Lines through the centres of texels, each with the part of it that the caster covers.
struct lines_of {
    std::vector<std::uint32_t> first;
    std::vector<depth_time_range<double>> ranges;

    lines_of(const half_plane& caster, line_axis axis) : first(range_map<double>::texels(side, side) + 1)
    {
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<double>> loose;
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x) {
                const double along = axis == line_axis::x ? caster.a : caster.b;
                const double begin = axis == line_axis::x ? caster.a * double(x) + caster.b * (double(y) + 0.5)
                                                          : caster.a * (double(x) + 0.5) + caster.b * double(y);
                const double edge = (caster.c - begin) / along;
                const double from = along > 0 ? 0 : std::fmax(edge, 0), to = along > 0 ? std::fmin(edge, 1) : 1;
                if (!(from < to)) continue;
                texels.push_back(std::uint32_t(range_map<double>::texel(side, x, y)));
                loose.push_back({from, to, near, near, 7});
            }
        ranges.resize(loose.size());
        sort_into_lists<double>(texels, loose, first, ranges);
    }
    range_map<double> map() const { return {side, side, first, ranges}; }
};

} // namespace

TEST_CASE("crossed lines: a straight edge is where it is, except near a diagonal of a cell")
{
    CHECK(rc::check("half-planes", [](std::uint64_t seed) {
        bit_source bits(seed);
        const half_plane caster(bits);
        const lines_of x(caster, line_axis::x), y(caster, line_axis::y);
        for (int i = 0; i < 50; ++i) {
            const line_receiver<double> r{bits.uniform(2, 10), bits.uniform(2, 10), far, 0};
            const double distance = std::abs(caster.a * r.x + caster.b * r.y - caster.c);
            const double exact = caster.covers(r.x, r.y) ? 1 : 0;
            if (distance > 0.75) RC_ASSERT(crossed_intensity(x.map(), y.map(), r) == exact);
            for (const line_axis axis : {line_axis::x, line_axis::y}) {
                const double one = line_intensity((axis == line_axis::x ? x : y).map(), axis, r);
                RC_ASSERT((one >= 0 && one <= 1));
                if (distance > 1) RC_ASSERT(one == exact);
            }
        }
    }));
}

TEST_CASE("crossed lines have less than half of the squared error of bilinear filtering")
{
    bit_source bits(77);
    double error = 0, bilinear = 0;
    for (std::int64_t n = 0; n < effort(1'000); ++n) {
        const half_plane caster(bits);
        const lines_of x(caster, line_axis::x), y(caster, line_axis::y);
        for (int i = 0; i < 100; ++i) {
            const line_receiver<double> r{bits.uniform(2, 10), bits.uniform(2, 10), far, 0};
            const auto centre = [&](double u, double v) { return caster.covers(u + 0.5, v + 0.5) ? 1.0 : 0.0; };
            const double u = std::floor(r.x - 0.5), v = std::floor(r.y - 0.5), s = r.x - 0.5 - u, t = r.y - 0.5 - v;
            const double mean = (1 - t) * ((1 - s) * centre(u, v) + s * centre(u + 1, v)) +
                                t * ((1 - s) * centre(u, v + 1) + s * centre(u + 1, v + 1));
            const double exact = caster.covers(r.x, r.y) ? 1 : 0, found = crossed_intensity(x.map(), y.map(), r);
            error += (found - exact) * (found - exact), bilinear += (mean - exact) * (mean - exact);
        }
    }
    CHECK(error > 0);
    CHECK(2 * error < bilinear);
}

TEST_CASE("lines: the own id, receivers in front, places outside of the map and NaN are lit")
{
    bit_source bits(75);
    const half_plane caster(bits);
    const lines_of x(caster, line_axis::x), y(caster, line_axis::y);
    hostile_source<double> source(76);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    int dark = 0;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const double u = bits.uniform(0, side), v = bits.uniform(0, side);
        const auto lit = [&](const line_receiver<double>& r) {
            return crossed_intensity(x.map(), y.map(), r) == 0 && line_intensity(x.map(), line_axis::x, r) == 0;
        };
        CHECK((lit({u, v, far, 7}) && lit({u, v, near, 0}) && lit({u + side + 1, v, far, 0})));
        CHECK((lit({nan, v, far, 0}) && lit({u, nan, far, 0}) && lit({u, v, nan, 0})));
        dark += !lit({u, v, far, 0});
        const auto h = source.draw();
        const double any = crossed_intensity(x.map(), y.map(), line_receiver<double>{h[0], h[1], h[2], h[3]});
        CHECK((any >= 0 && any <= 1));
    }
    CHECK(dark > 0);
}
