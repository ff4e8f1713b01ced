// The pyramid of least and greatest depths against every texel: intervals hold all depths of a rectangle, and what they
// decide equals percentage-closer filtering over any region inside. A hill climber searches for a receiver that is decided
// wrongly.
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/depth_pyramid.hpp>
#include <gnomon/soft/depth_interval.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

/// A depth map with its pyramid.
struct pyramid_of_map {
    std::size_t width, height;
    std::vector<float> depths;
    std::vector<depth_interval> blocks;

    pyramid_of_map(std::size_t w, std::size_t h, auto depth)
        : width(w), height(h), depths(w * h), blocks(depth_pyramid_blocks(w, h))
    {
        for (std::size_t y = 0; y < h; ++y)
            for (std::size_t x = 0; x < w; ++x) depths[y * w + x] = float(depth(x, y));
        build_depth_pyramid(map(), view());
    }
    [[nodiscard]] map_view<const float> map() const { return {depths, width, height}; }
    [[nodiscard]] depth_pyramid_view<depth_interval> view() { return {blocks, width, height}; }
    [[nodiscard]] depth_pyramid_view<const depth_interval> view() const { return {blocks, width, height}; }
};

struct rectangle {
    float x0, y0, x1, y1;
};

depth_interval interval_in(const pyramid_of_map& m, const rectangle& r)
{
    return depth_interval_in(m.view(), r.x0, r.y0, r.x1, r.y1);
}

/// The share of a rectangle, clipped to the map, whose depths are before z_f, in double; 0 where nothing is left.
double share_before(const pyramid_of_map& m, const rectangle& r, float z_f)
{
    double before = 0, all = 0;
    for (std::size_t y = 0; y < m.height; ++y)
        for (std::size_t x = 0; x < m.width; ++x) {
            const auto overlap = [](double a, double b, double i) {
                return std::max(0.0, std::min(b, i + 1) - std::max(a, i));
            };
            const double area =
                overlap(double(r.x0), double(r.x1), double(x)) * overlap(double(r.y0), double(r.y1), double(y));
            all += area;
            before += std::clamp(m.depths[y * m.width + x], -1.0f, 1.0f) < z_f ? area : 0;
        }
    return all > 0 ? before / all : 0;
}

} // namespace

TEST_CASE("an interval holds all depths of its rectangle, and those of few texels beside it")
{
    bit_source bits(1);
    for (std::int64_t round = 0; round < std::max<std::int64_t>(effort(60), 10); ++round) {
        const std::size_t w = 1 + bits.below(90), h = 1 + bits.below(70);
        const pyramid_of_map m(w, h, [&](std::size_t, std::size_t) { return bits.uniform(-1.2, 1.2); });
        for (int i = 0; i < 50; ++i) {
            rectangle r{float(bits.uniform(-20, double(w))), float(bits.uniform(-20, double(h))), 0, 0};
            r.x1 = r.x0 + float(bits.uniform(0, 40)), r.y1 = r.y0 + float(bits.uniform(0, 40));
            if (bits.chance(0.3)) r = {std::floor(r.x0), std::floor(r.y0), std::ceil(r.x1), std::ceil(r.y1)};
            float least = 1, greatest = -1, least_around = 1, greatest_around = -1;
            // Three blocks cover a rectangle, so each is at most as long as it or has 8 texels.
            const float margin = 2 * std::max({8.0f, r.x1 - r.x0, r.y1 - r.y0});
            bool any = false;
            for (std::size_t y = 0; y < h; ++y)
                for (std::size_t x = 0; x < w; ++x) {
                    const float z = std::clamp(m.depths[y * w + x], -1.0f, 1.0f), fx = float(x), fy = float(y);
                    const auto near = [&](float by) {
                        return fx + 1 > r.x0 - by && fx < r.x1 + by && fy + 1 > r.y0 - by && fy < r.y1 + by;
                    };
                    if (near(0)) any = true, least = std::min(least, z), greatest = std::max(greatest, z);
                    if (near(margin))
                        least_around = std::min(least_around, z), greatest_around = std::max(greatest_around, z);
                }
            const depth_interval found = interval_in(m, r);
            if (!any) continue;
            CHECK(found.least <= least);
            CHECK(found.greatest >= greatest);
            CHECK(found.least >= least_around);
            CHECK(found.greatest <= greatest_around);
        }
    }
}

TEST_CASE("a decided receiver is lit or in the umbra of every filter region inside its search region")
{
    // A map of two depths that meet along lines; the climber moves depths, regions, receiver and bias.
    constexpr std::size_t dimensions = 15;
    std::int64_t decided = 0;
    const summit top = climb(dimensions, 60'000, 3, [&](const std::vector<double>& x) {
        const std::size_t w = 1 + std::size_t(47 * x[0]), h = 1 + std::size_t(47 * x[1]);
        const double near = 2 * x[2] - 1, far = near + (x[3] < 0.5 ? std::exp2(-40 * x[3]) : 2 * x[3] - 1);
        const pyramid_of_map m(w, h, [&](std::size_t i, std::size_t j) {
            return double(i) * (x[4] - 0.5) + double(j) * (x[5] - 0.5) > 24 * x[6] - 12 ? near : far;
        });
        const auto along = [](double at, double length, double extent) {
            const double middle = extent * (1.4 * at - 0.2), half = 30 * length * length;
            return std::array{float(middle - half), float(middle + half)};
        };
        const auto sx = along(x[7], x[8], double(w)), sy = along(x[9], x[8], double(h));
        const rectangle search{sx[0], sy[0], sx[1], sy[1]};
        const float z_f = float(x[10] < 0.5 ? near : far) + float((x[11] - 0.5) * std::exp2(-30 * x[12]));
        const float bias = x[13] < 0.5 ? 0 : float(x[13] - 0.5);
        const depth_interval interval = interval_in(m, search);
        const float least_bias = x[13] < 0.75 ? 0 : bias * float(x[14]);
        const decided_shadow<float> r = depth_interval_shadow(interval.least, interval.greatest, z_f, least_bias, bias);
        if (r.decided == 0) return -1.0;
        ++decided;
        double worst = 0;
        for (const float moved : {least_bias, bias * float(x[14]), bias})
            for (const double scale : {1.0, 0.6, 0.2}) {
                const auto inner = [&](float a, float b, double shift) {
                    const float spare = float(1 - scale) * (b - a);
                    const float begin = a + spare * float(shift);
                    return std::array{begin, std::min(b, begin + float(scale) * (b - a))};
                };
                const auto fx = inner(sx[0], sx[1], x[14]), fy = inner(sy[0], sy[1], x[12]);
                const rectangle region{fx[0], fy[0], fx[1], fy[1]};
                const double share = share_before(m, region, std::clamp(z_f, -1.0f, 1.0f) - moved);
                // A region beside the map is lit, though the search region is not.
                const bool empty = share_before(m, region, HUGE_VALF) == 0;
                worst = std::max(worst, empty ? 0.0 : std::abs(share - double(r.intensity)));
            }
        return worst;
    });
    CHECK(top.score <= 0);
    CHECK(decided > effort(60'000) / 50);
}

TEST_CASE("what the ends decide")
{
    const auto shadow = [](float least, float greatest, float z_f, float least_bias, float most_bias) {
        const decided_shadow<float> r = depth_interval_shadow(least, greatest, z_f, least_bias, most_bias);
        return r.decided > 0 ? r.intensity : -1.0f;
    };
    CHECK(shadow(-0.5f, 0.5f, -0.5f, 0, 0) == 0);
    CHECK(shadow(-0.5f, 0.5f, -0.375f, 0.125f, 0.25f) == 0);
    CHECK(shadow(-0.5f, 0.5f, -0.375f, 0, 0.25f) == -1);
    CHECK(shadow(-0.5f, 0.5f, 0.5f, 0, 0) == -1);
    CHECK(shadow(-0.5f, 0.5f, 0.6f, 0, 0) == 1);
    CHECK(shadow(-0.5f, 0.5f, 0.6f, 0, 0.2f) == -1);
    CHECK(shadow(-0.5f, 0.5f, 0.6f, -4, -3) == 1);
    CHECK(shadow(-0.5f, 0.5f, 0.6f, 0.1f, 0) == -1);
    CHECK(shadow(0.5f, -0.5f, 0.6f, 0, 0) == -1);
    CHECK(shadow(1, 1, 3, 0, 0) == 0);
    for (std::size_t k = 0; k < 5; ++k) {
        std::array<float, 5> v{-0.5f, 0.5f, 0.9f, 0, 0};
        v[k] = no_number;
        CHECK(shadow(v[0], v[1], v[2], v[3], v[4]) == -1);
    }
}

TEST_CASE("depths that are no number, beyond a plane, or samples of a texel")
{
    const std::array<float, 4> depths{no_number, -3, 0.25f, 7};
    std::array<depth_interval, 1> block{};
    build_depth_pyramid<float>({depths, 4, 1}, {block, 4, 1});
    CHECK(block[0].least == -1);
    CHECK(block[0].greatest == 1);
    const std::array<std::array<float, 4>, 2> samples{{{0, 0.1f, 0.2f, 0.3f}, {0.1f, -0.5f, 0, 0}}};
    build_depth_pyramid<std::array<float, 4>>({samples, 2, 1}, {block, 2, 1});
    CHECK(block[0].least == -0.5f);
    CHECK(block[0].greatest == 0.3f);
}

TEST_CASE("rectangles beside the map are lit, and those of NaN decide nothing")
{
    const pyramid_of_map m(20, 20, [](std::size_t, std::size_t) { return -0.5; });
    for (const rectangle& r : {rectangle{-9, 0, -1, 5}, {25, 0, 30, 5}, {0, 20, 5, 22}, {5, 5, 2, 9}}) {
        CHECK(interval_in(m, r).least == 1);
        CHECK(interval_in(m, r).greatest == 1);
    }
    CHECK(interval_in(m, {0, no_number, 5, 5}).least == -1);
    CHECK(interval_in(m, {0, no_number, 5, 5}).greatest == 1);
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(interval_in(m, {-infinity, -infinity, infinity, infinity}).greatest == -0.5f);
    CHECK(depth_interval_in({}, 0, 0, 1, 1).least == 1);
}

TEST_CASE("a pyramid takes a sixth of a byte for each texel, and wrong shapes are refused before anything is written")
{
    CHECK(depth_pyramid_blocks(1024, 1024) * sizeof(depth_interval) <= 1024 * 1024 / 6);
    CHECK(depth_pyramid_blocks(1, 1) == 1);
    CHECK(depth_pyramid_blocks(17, 9) == 3 * 2 + 2 * 1 + 1);
    const std::vector<float> depths(17 * 9, 0.0f);
    std::vector<depth_interval> blocks(depth_pyramid_blocks(17, 9), {0.5f, 0.75f});
    const auto build = [&](std::size_t w, std::size_t h, std::size_t size) {
        build_depth_pyramid<float>({depths, 17, 9}, {std::span(blocks).first(size), w, h});
    };
#if defined(__cpp_exceptions)
    CHECK_THROWS_AS(build(16, 9, blocks.size()), std::invalid_argument);
    CHECK_THROWS_AS(build(17, 8, blocks.size()), std::invalid_argument);
    CHECK_THROWS_AS(build(17, 9, blocks.size() - 1), std::invalid_argument);
    CHECK_THROWS_AS(depth_intervals<float>({depths, 17, 9}, {blocks, 2, 2}, {0, 2}), std::invalid_argument);
    CHECK_THROWS_AS(depth_intervals<float>({depths, 17, 9}, {blocks, 3, 2}, {1, 3}), std::invalid_argument);
    CHECK(std::all_of(blocks.begin(), blocks.end(), [](depth_interval i) { return i.least == 0.5f; }));
#endif
    build(17, 9, blocks.size());
    CHECK(std::all_of(blocks.begin(), blocks.end(), [](depth_interval i) { return i.greatest == 0; }));
}
