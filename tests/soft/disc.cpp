// Discs by rectangles: the share of a light that is seen past a straight edge, against that of a disc, for edges at all
// angles and distances; and the same from a summed-area table.
#include "support/hostile.hpp"

#include <gnomon/passes/summed_disc.hpp>
#include <gnomon/storage/moments4_summed.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using rectangle = summed_area_rectangle<double>;

/// The share of a disc of radius 1 before the line at distance s from its centre.
double disc_before(double s)
{
    s = std::clamp(s, -1.0, 1.0);
    return 0.5 + (s * std::sqrt(1 - s * s) + std::asin(s)) / 3.14159265358979;
}

/// The area of a rectangle before the line x cos + y sin = s.
double area_before(const rectangle& r, double c, double n, double s)
{
    const double a = 0.5 * (r.x1 - r.x0) * c, b = 0.5 * (r.y1 - r.y0) * n;
    const double t = s - 0.5 * (r.x0 + r.x1) * c - 0.5 * (r.y0 + r.y1) * n, area = (r.x1 - r.x0) * (r.y1 - r.y0);
    if (std::min(a, b) < 1e-9) return area * std::clamp(0.5 + 0.5 * t / std::max(a, b), 0.0, 1.0);
    const auto ramp = [](double x) { return x > 0 ? 0.5 * x * x : 0.0; };
    return area * (ramp(t + a + b) - ramp(t + a - b) - ramp(t - a + b) + ramp(t - a - b)) / (4 * a * b);
}

/// The largest difference from a disc over edges at all angles.
double worst(const std::vector<rectangle>& parts)
{
    double whole = 0, error = 0;
    for (const rectangle& r : parts) whole += (r.x1 - r.x0) * (r.y1 - r.y0);
    for (int i = 0; i <= 90; ++i) {
        const double angle = i * 3.14159265358979 / 180, c = std::cos(angle), n = std::sin(angle);
        for (int k = -150; k <= 150; ++k) {
            double before = 0;
            for (const rectangle& r : parts) before += area_before(r, c, n, k / 100.0) / whole;
            error = std::max(error, std::abs(before - disc_before(k / 100.0)));
        }
    }
    return error;
}

rectangle around(double half_x, double half_y) { return {-half_x, -half_y, half_x, half_y}; }

} // namespace

TEST_CASE("three rectangles make the penumbra of a disc, within a third of the error of a square; two do not pay")
{
    const rectangle bounds = around(1, 1);
    const double cross = worst({disc_rectangle(bounds, 0.0), disc_rectangle(bounds, 1.0), disc_rectangle(bounds, 2.0)});
    const double square = worst({around(disc_square, disc_square)});
    const double two = worst({around(1.0375, 0.675), around(0.675, 1.0375)});
    std::printf("| square | two rectangles | three |\n| %.4f | %.4f | %.4f |\n", square, two, cross);
    CHECK(cross <= disc_error);
    CHECK(square <= disc_square_error);
    CHECK(square >= 0.95 * disc_square_error);
    CHECK(two > 0.7 * square);
    CHECK(two == doctest::Approx(0.0177).epsilon(0.02));
    CHECK(3 * cross <= square);
    // Other extents are no better.
    for (const double a : {-0.01, 0.01})
        for (const double b : {-0.01, 0.01}) {
            const double l = disc_long + a, s = disc_short + b;
            CHECK(worst({around(l, s), {-s, -l, s, -s}, {-s, s, s, l}}) > cross);
        }
}

TEST_CASE("the parts of a disc touch and do not overlap")
{
    bit_source bits(3);
    for (int i = 0; i < 1000; ++i) {
        const double x = bits.uniform(-10, 300), y = bits.uniform(-10, 300), w = bits.uniform(1, 40),
                     h = bits.uniform(1, 40);
        const rectangle bounds{x, y, x + w, y + h};
        const rectangle middle = disc_rectangle(bounds, 0.0), low = disc_rectangle(bounds, 1.0),
                        high = disc_rectangle(bounds, 2.0);
        CHECK(low.y1 == middle.y0);
        CHECK(high.y0 == middle.y1);
        for (const rectangle& r : {middle, low, high}) {
            CHECK((bounds.x0 <= r.x0 && r.x0 < r.x1 && r.x1 <= bounds.x1));
            CHECK((bounds.y0 <= r.y0 && r.y0 < r.y1 && r.y1 <= bounds.y1));
        }
    }
}

TEST_CASE("an occluder with a slanted edge has the penumbra of a round light from a summed-area table")
{
    using table = moments4_summed;
    constexpr std::size_t extent = 96, most_texels = 42 * 42;
    double disc = 0, square = 0;
    for (const int degrees : {0, 15, 45, 70}) {
        const double angle = degrees * 3.14159265358979 / 180, c = std::cos(angle), n = std::sin(angle);
        // Texels hold 16 samples, so that the edge is finer than a texel.
        std::vector<std::array<float, 16>> depths(extent * extent);
        for (std::size_t i = 0; i < depths.size(); ++i)
            for (std::size_t k = 0; k < 16; ++k) {
                const double x = double(i % extent) + (double(k % 4) + 0.5) / 4,
                             y = double(i / extent) + (double(k / 4) + 0.5) / 4;
                depths[i][k] = (x - 48) * c + (y - 48) * n < 0 ? -0.5f : 0.5f;
            }
        std::vector<table::texel> texels(depths.size());
        const map_view<table::texel> sums{texels, extent, extent};
        build_summed_area<table>(map_view<const std::array<float, 16>>{depths, extent, extent}, sums, most_texels);
        for (double at = -22; at <= 22; at += 0.5) {
            const float x = float(48 + at * c), y = float(48 + at * n);
            const auto shown = [&](const auto& average, float width) {
                const auto channels = average(summed_area_around(x, y, width, width));
                return double(table::intensity(channels, float(most_texels), 0.5f));
            };
            const double expected = disc_before(-at / 20);
            const double round = shown([&](const auto& r) { return disc_average<table>(sums, most_texels, r); }, 40);
            const double box = shown([&](const auto& r) { return rectangle_average<table>(sums, most_texels, r); },
                                     float(40 * disc_square));
            disc = std::max(disc, std::abs(round - expected));
            square = std::max(square, std::abs(box - expected));
        }
    }
    std::printf("from a table: disc %.4f, square %.4f\n", disc, square);
    CHECK(disc <= disc_error + 0.004);
    CHECK(square > 2 * disc);
}

TEST_CASE("a disc beside the map is lit, and one over its edge is that of its part inside")
{
    using table = moments4_summed;
    std::vector<std::array<float, 1>> depths(20 * 20, {-0.5f});
    std::vector<table::texel> texels(depths.size());
    const map_view<table::texel> sums{texels, 20, 20};
    build_summed_area<table>(map_view<const std::array<float, 1>>{depths, 20, 20}, sums, 784);
    const auto shown = [&](float x, float y) {
        return table::intensity(disc_average<table>(sums, 784, summed_area_around(x, y, 12.0f, 12.0f)), 784.0f, 0.5f);
    };
    CHECK(shown(-30, 10) < 1e-5f);
    CHECK(shown(std::nanf(""), 10) < 1e-5f);
    CHECK(shown(0, 0) > 0.999f);
    CHECK(shown(10, 10) > 0.999f);
}
