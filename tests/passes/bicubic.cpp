// Bicubic look-ups against the cubic B-spline in double, texel by texel, and the variance of filters from a mip chain
// against that of boxes.
#include "support/hostile.hpp"

#include <gnomon/passes/bicubic.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The cubic B-spline.
double spline(double x)
{
    const double t = std::abs(x);
    if (t >= 2) return 0;
    return t >= 1 ? std::pow(2 - t, 3) / 6 : 2.0 / 3 - t * t + t * t * t / 2;
}

/// A random map with one texel more than it shows in each row.
template <class Format> struct random_map {
    std::vector<format_texel<Format>> texels;
    map_view<const format_texel<Format>> view;

    random_map(bit_source& bits, std::size_t w, std::size_t h) : texels((w + 1) * h)
    {
        for (auto& t : texels) {
            channel_array<Format> c;
            for (float& value : c) value = float(bits.uniform(0, 1));
            t = store_channels<Format>(c);
        }
        view = {texels, w, h, w + 1};
    }
};

} // namespace

TEST_CASE_TEMPLATE("a bicubic look-up is the cubic B-spline over 4 x 4 texels", Format, moments4_unorm16,
                   variance_unorm16, moments6_float)
{
    bit_source bits(1);
    for (int round = 0; round < 300; ++round) {
        const std::size_t w = 1 + bits.below(9), h = 1 + bits.below(9);
        const random_map<Format> m(bits, w, h);
        const float x = float(bits.uniform(-4, double(w) + 4)), y = float(bits.uniform(-4, double(h) + 4));
        for (const border_mode mode : {border_mode::clamp, border_mode::lit}) {
            const auto found = gnomon_bit_cast<channel_array<Format>>(bicubic<Format>(m.view, x, y, mode));
            std::vector<double> expected(found.size());
            for (int j = -8; j < int(h) + 8; ++j)
                for (int i = -8; i < int(w) + 8; ++i) {
                    const double weight = spline(double(x) - i - 0.5) * spline(double(y) - j - 0.5);
                    const bool beyond = i < 0 || j < 0 || i >= int(w) || j >= int(h);
                    const auto c = mode == border_mode::lit && beyond
                                       ? gnomon_bit_cast<channel_array<Format>>(stored_border<Format>())
                                       : load_channels<Format>(m.view(std::size_t(std::clamp(i, 0, int(w) - 1)),
                                                                      std::size_t(std::clamp(j, 0, int(h) - 1))));
                    for (std::size_t k = 0; k < c.size(); ++k) expected[k] += weight * double(c[k]);
                }
            for (std::size_t k = 0; k < found.size(); ++k) REQUIRE(std::abs(double(found[k]) - expected[k]) < 1e-6);
        }
    }
}

TEST_CASE("the filter of a width has the variance of a box of that width")
{
    using format = moments4_float;
    constexpr std::size_t extent = 256;
    // Channels are the means of x and x^2 over each texel.
    std::vector<format::texel> texels(mip_texels(extent, extent));
    const mip_view<format::texel> mips{texels, extent, extent};
    for (std::size_t y = 0; y < extent; ++y)
        for (std::size_t x = 0; x < extent; ++x) {
            const float at = (float(x) + 0.5f) / 128 - 1;
            mips.level(0)(x, y) = format::encode({at, at * at + 1 / (12.0f * 128 * 128), 0, 0});
        }
    build_mips<format>(mips);
    bit_source bits(3);
    for (int i = 0; i < 300; ++i) {
        const float width = float(std::exp2(bits.uniform(0, 5)));
        const float x = float(bits.uniform(112, 144)), level = mip_filter_level(width);
        const channels4<float> c = bicubic<format>(mips, x, 128.3f, level);
        const double mean = double(c.c1), variance = 128.0 * 128 * (double(c.c2) - mean * mean);
        CHECK(mean == doctest::Approx(double(x) / 128 - 1).epsilon(1e-5));
        CHECK(std::abs(variance - std::max(double(width * width) / 12, 5.0 / 12)) < 0.01 + 1e-4 * variance);
    }
}

TEST_CASE("levels are those of powers of two, continuous and limited")
{
    for (int l = 0; l < 12; ++l)
        CHECK(mip_filter_level(float(std::sqrt(5.0) * std::exp2(l))) == doctest::Approx(l).epsilon(1e-5));
    float before = 0;
    for (float w = 0.01f; w < 1e5f; w *= 1.001f) {
        const float level = mip_filter_level(w);
        CHECK(level >= before - 1e-5f);
        CHECK(level - before < 0.01f);
        before = level;
    }
    CHECK(mip_filter_level(-std::numeric_limits<float>::infinity()) == 0);
    CHECK(mip_filter_level(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(mip_filter_level(std::numeric_limits<float>::infinity()) == mip_filter_level(65536.0f));
}

TEST_CASE("look-ups without a place are lit, and a constant map is constant")
{
    using format = moments4_unorm16;
    const float no_number = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    std::vector<format::texel> texels(mip_texels(5, 3), format::encode({0.25f, 0.5f, 0.75f, 1}));
    const mip_view<const format::texel> mips{texels, 5, 3};
    const format::texel first = texels[0];
    for (const float at : {-infinity, -1e30f, -3.0f, 0.0f, 2.5f, 7.0f, 1e30f, infinity})
        for (const float level : {-infinity, 0.0f, 1.5f, infinity}) {
            const channels4<float> c = bicubic<format>(mips, at, at, level);
            CHECK(format::encode(c) == first);
            CHECK(format::encode(bicubic<format>(mips.level(0), at, at)) == first);
        }
    const auto lit = [](const channels4<float>& c) { return format::intensity(c, 1.0f) == 0; };
    CHECK(lit(bicubic<format>(mips, no_number, 0, 0)));
    CHECK(lit(bicubic<format>(mips, 0, no_number, 0)));
    CHECK(lit(bicubic<format>(mips, 0, 0, no_number)));
    CHECK(lit(bicubic<format>(map_view<const format::texel>{}, 0, 0)));
    CHECK(lit(bicubic<format>(mips, -9, 1, 0, border_mode::lit)));
}
