// Slices of froxels and averages over them, against sums in double.
#include "support/effort.hpp"
#include "support/situations.hpp"

#include <gnomon/passes/froxels.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

/// Light scattered between two distances, in double.
double light(double extinction, double from, double to)
{
    if (!(extinction > 0)) return to - from;
    return -std::exp(-extinction * from) * std::expm1(-extinction * (to - from)) / extinction;
}

struct grid_of_froxels {
    std::size_t width, height, slices;
    std::vector<float> froxels;

    grid_of_froxels(std::size_t w, std::size_t h, std::size_t n, auto intensity)
        : width(w), height(h), slices(n), froxels(w * h * n)
    {
        for (float& f : froxels) f = float(intensity());
    }
    [[nodiscard]] froxel_view<float> view() { return {froxels, width, height, slices}; }
    [[nodiscard]] froxel_view<const float> view() const { return {froxels, width, height, slices}; }
};

} // namespace

TEST_CASE("slices cover all from the camera to the farthest distance, and slice and distance are inverse")
{
    bit_source bits(20140812);
    double worst = 0, of_slice = 0;
    for (std::int64_t i = 0; i < effort(2000); ++i) {
        const double nearest = std::exp2(bits.uniform(-10, 4)), farthest = nearest * std::exp2(bits.uniform(0.1, 14));
        const int count = 2 + int(bits.below(200));
        const auto slices = froxel_slices_from(float(nearest), float(farthest), float(count));
        const auto exact = froxel_slices_from(double(float(nearest)), double(float(farthest)), double(count));
        CHECK(froxel_distance(0.f, slices) == float(nearest));
        double before = 0;
        for (int k = 0; k < count; ++k) {
            const double end = double(froxel_distance(float(k), slices));
            const double derived =
                double(float(nearest)) * std::pow(double(float(farthest)) / double(float(nearest)), k / (count - 1.0));
            REQUIRE(end > before);
            before = end;
            worst = std::max(worst, std::abs(end / derived - 1));
            REQUIRE(std::abs(froxel_distance(double(k), exact) / derived - 1) <= 0x1p-46);
            of_slice = std::max(of_slice, std::abs(double(froxel_slice_of(float(derived), slices)) - k) / (count - 1));
        }
        CHECK(before == doctest::Approx(farthest));
    }
    MESSAGE("largest errors in 2^-24: of a distance ", worst * 0x1p24, ", of a slice ", of_slice * 0x1p24);
    CHECK(worst <= 0x1p-17);
    CHECK(of_slice <= 0x1p-17);
}

TEST_CASE("weights are those of the light that is scattered between two distances")
{
    bit_source bits(8);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(100000); ++i) {
        const float from = float(bits.uniform(0, 1)), to = float(double(from) + bits.uniform(0, 1 - double(from)));
        const float extinction = float(bits.chance(0.2) ? 0 : bits.uniform(0, 1));
        if (!(to > from)) continue;
        const double exact = light(double(extinction), double(from), double(to));
        worst = std::max(worst, std::abs(double(froxel_weight(extinction, from, to)) / exact - 1));
    }
    MESSAGE("largest error of a weight in 2^-24: ", worst * 0x1p24);
    CHECK(worst <= 8 * 0x1p-24);
}

TEST_CASE("averages are weighted sums over the froxels of a column")
{
    bit_source bits(9);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(300); ++i) {
        const std::size_t width = 1 + bits.below(5), height = 1 + bits.below(4), count = 2 + bits.below(64);
        const auto slices = froxel_slices_from(float(std::exp2(bits.uniform(-8, 0))), 16.f, float(count));
        const float extinction = float(bits.chance(0.2) ? 0 : std::exp2(bits.uniform(-6, 3)));
        grid_of_froxels grid(width, height, count, [&] { return bits.uniform(0, 1); });
        const std::vector<float> given = grid.froxels;
        integrate_froxels(grid.view(), slices, extinction, {0, height});
        for (std::size_t column = 0; column < width * height; ++column) {
            double shadowed = 0, all = 0, from = 0;
            for (std::size_t k = 0; k < count; ++k) {
                const double to = double(froxel_distance(float(k), slices)),
                             weight = light(double(extinction), from, to);
                shadowed += weight * double(given[k * width * height + column]), all += weight, from = to;
                worst = std::max(worst, std::abs(double(grid.froxels[k * width * height + column]) - shadowed / all));
            }
        }
    }
    MESSAGE("largest error ", worst);
    CHECK(worst <= 0x1p-20);
}

TEST_CASE("a look-up is that of the slice at its end, and between slices and columns between them")
{
    bit_source bits(10);
    const grid_of_froxels grid(4, 3, 5, [&] { return bits.uniform(0, 1); });
    const auto at = [&](std::size_t x, std::size_t y, std::size_t k) { return double(grid.view().slice(k)(x, y)); };
    CHECK(double(froxel_intensity(grid.view(), 1.5f, 2.5f, 3)) == at(1, 2, 3));
    CHECK(froxel_intensity(grid.view(), 1.5f, 2.5f, 3.5f) == doctest::Approx(0.5 * (at(1, 2, 3) + at(1, 2, 4))));
    CHECK(froxel_intensity(grid.view(), 2, 2.5f, 3) == doctest::Approx(0.5 * (at(1, 2, 3) + at(2, 2, 3))));
    CHECK(froxel_intensity(grid.view(), 1.5f, 1, 3) == doctest::Approx(0.5 * (at(1, 0, 3) + at(1, 1, 3))));
    CHECK(double(froxel_intensity(grid.view(), -7, 99, 99)) == at(0, 2, 4));
    CHECK(froxel_intensity(grid.view(), no_number, 0, 0) == 0);
    CHECK(froxel_intensity(grid.view(), 0, 0, no_number) == 0);
}

TEST_CASE("froxels that are NaN are lit, and any numbers give an intensity")
{
    bit_source bits(11);
    for (std::int64_t i = 0; i < effort(3000); ++i) {
        const auto any = [&] { return float(any_number<float>(bits)); };
        grid_of_froxels grid(2, 2, 3, any);
        integrate_froxels(grid.view(), {any(), any(), any()}, any(), {0, 2});
        for (const float f : grid.froxels) REQUIRE((f >= 0 && f <= 1));
        const float found = froxel_intensity(grid.view(), any(), any(), any());
        REQUIRE((found >= 0 && found <= 1));
    }
    grid_of_froxels dark(1, 1, 2, [k = 0]() mutable { return k++ == 0 ? no_number : 1.f; });
    integrate_froxels(dark.view(), froxel_slices_from(1.f, 2.f, 2.f), 0, {0, 1});
    CHECK(dark.froxels[0] == 0);
    CHECK(dark.froxels[1] == 0.5f);
}

#if defined(__cpp_exceptions)
TEST_CASE("grids that do not fit into their memory are refused")
{
    std::vector<float> froxels(12);
    const auto slices = froxel_slices_from(1.f, 2.f, 2.f);
    CHECK_THROWS_AS(integrate_froxels({froxels, 2, 2, 4}, slices, 0, {0, 2}), std::invalid_argument);
    CHECK_THROWS_AS(integrate_froxels({froxels, 2, 2, 0}, slices, 0, {0, 2}), std::invalid_argument);
    CHECK_THROWS_AS(integrate_froxels({froxels, 0, 2, 3}, slices, 0, {0, 2}), std::invalid_argument);
    CHECK_THROWS_AS(integrate_froxels({froxels, 2, 2, 3}, slices, 0, {0, 3}), std::invalid_argument);
    CHECK_NOTHROW(integrate_froxels({froxels, 2, 2, 3}, slices, 0, {0, 2}));
}
#endif
