// Min-max mipmaps of rows against every texel of the row, in double.
#include "support/effort.hpp"
#include "support/situations.hpp"

#include <gnomon/passes/min_max_rows.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

/// Rows of depths with their nodes and weights.
struct rows_of_map {
    std::size_t width, height;
    double q;
    std::vector<float> depths;
    std::vector<depth_interval> nodes;

    rows_of_map(std::size_t w, std::size_t h, double factor, auto depth)
        : width(w), height(h), q(factor), depths(w * h), nodes(min_max_nodes(w) * h)
    {
        for (float& z : depths) z = float(depth());
        build_min_max_rows({depths, width, height}, {nodes, min_max_nodes(width), height}, {0, height});
    }
    [[nodiscard]] float intensity(std::size_t row, float x, float z_f) const
    {
        const std::span<const depth_interval> all(nodes);
        return min_max_intensity({depths, width, height}, {all, min_max_nodes(width), height}, float(q), row, x, z_f);
    }
    /// The weighted count, texel by texel.
    [[nodiscard]] double counted(std::size_t row, double x, float z_f) const
    {
        double shadowed = 0, all = 0, weight = 1;
        for (std::size_t u = 0; double(u) < x; ++u, weight *= q) {
            const double f = std::min(1.0, x - double(u));
            const double part = f == 1 || q == 1 ? f : -std::expm1(f * std::log(q)) / (1 - q);
            all += weight * part;
            if (depths[row * width + u] < z_f) shadowed += weight * part;
        }
        return shadowed / all;
    }
};

/// Depths of which neighbours are alike, as of a scene.
auto any_depths(bit_source& bits)
{
    return [&bits, z = 0.0]() mutable {
        if (bits.chance(0.1)) z = bits.chance(0.2) ? 1 : bits.uniform(-1, 1);
        return z + bits.uniform(0, 0.02);
    };
}

} // namespace

TEST_CASE("the intensity is the weighted count of the row at any depth")
{
    bit_source bits(20110805);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(400); ++i) {
        const std::size_t width = min_max_block * (1 + bits.below(i % 8 == 0 ? 4096 / min_max_block : 10));
        const double q = bits.chance(0.2) ? 1 : double(float(1 - std::exp2(bits.uniform(-14, -0.1))));
        const rows_of_map map(width, 3, q, any_depths(bits));
        for (int k = 0; k < 50; ++k) {
            const std::size_t row = bits.below(3);
            const float x = float(bits.chance(0.3) ? double(1 + bits.below(width)) : bits.uniform(0.01, double(width)));
            const float z_f = bits.chance(0.5) ? map.depths[bits.below(map.depths.size())] : float(bits.uniform(-1, 1));
            const double error = std::abs(double(map.intensity(row, x, std::min(z_f, 1.f))) -
                                          map.counted(row, double(x), std::min(z_f, 1.f)));
            worst = std::max(worst, error);
        }
    }
    MESSAGE("largest error ", worst);
    CHECK(worst <= 3e-6);
}

TEST_CASE("rows of one depth are lit or shadowed, of any width and in any air")
{
    for (const double q : {0.0, 0x1p-100, 0.5, 1 - 0x1p-20, 1.0, 3.0, -1.0, double(no_number)})
        for (const std::size_t width : {min_max_block, 2 * min_max_block, 3 * min_max_block, std::size_t(1024)}) {
            const rows_of_map map(width, 1, q, [] { return 0.25; });
            for (const float x : {-1.f, 0.f, 0.25f, 1.f, 15.5f, 16.f, 100.f, 1e9f}) {
                CHECK(map.intensity(0, x, 0.5f) >= 1 - 3e-6f);
                CHECK(map.intensity(0, x, 0.25f) == 0);
                CHECK(map.intensity(0, x, no_number) == 0);
            }
            CHECK(map.intensity(0, no_number, 0.5f) == 0);
        }
}

TEST_CASE("depths that are NaN are lit, and any numbers give an intensity")
{
    const rows_of_map dark(min_max_block, 1, 0.9,
                           [k = 0]() mutable { return k++ % 2 == 0 ? double(no_number) : -1.0; });
    CHECK(dark.intensity(0, 2, 1.f) == doctest::Approx(0.9 / 1.9));
    bit_source bits(7);
    for (std::int64_t i = 0; i < effort(2000); ++i) {
        const rows_of_map map(2 * min_max_block, 1, any_number<double>(bits), [&] { return any_number<float>(bits); });
        for (int k = 0; k < 20; ++k) {
            const float found = map.intensity(0, float(any_number<float>(bits)), float(any_number<float>(bits)));
            REQUIRE((found >= 0 && found <= 1));
        }
    }
}

#if defined(__cpp_exceptions)
TEST_CASE("rows that are not whole blocks, and nodes of another extent, are refused")
{
    constexpr std::size_t width = min_max_block, nodes_in_row = min_max_nodes(width);
    std::vector<float> depths(4 * width);
    std::vector<depth_interval> nodes(4 * nodes_in_row);
    const map_view<const float> rows{depths, width, 2};
    CHECK_THROWS_AS(build_min_max_rows({depths, width + 1, 2}, {nodes, nodes_in_row, 2}, {0, 2}),
                    std::invalid_argument);
    CHECK_THROWS_AS(build_min_max_rows(rows, {nodes, min_max_nodes(2 * width), 2}, {0, 2}), std::invalid_argument);
    CHECK_THROWS_AS(build_min_max_rows(rows, {nodes, nodes_in_row, 1}, {0, 1}), std::invalid_argument);
    CHECK_THROWS_AS(build_min_max_rows(rows, {nodes, nodes_in_row, 2}, {0, 3}), std::invalid_argument);
    CHECK_NOTHROW(build_min_max_rows(rows, {nodes, nodes_in_row, 2}, {0, 2}));
}
#endif
