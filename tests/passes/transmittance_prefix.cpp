// Prefix averages of rows against sums in long double: off by one rounding to the format, also where a climber looks for the worst
// row; convex; the same for every band of rows; and total.
#include "support/climber.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/transmittance_prefix.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class Format> using numbers = std::array<long double, channel_count<Format>>;

/// The averages of the texels of a row up to each, with weights that fall by factor.
template <class Format>
std::vector<numbers<Format>> averages_of(std::span<const format_texel<Format>> row, float factor)
{
    std::vector<numbers<Format>> r;
    numbers<Format> sum{};
    long double weight = 1, whole = 0;
    for (const auto& texel : row) {
        const auto c = load_channels<Format>(texel);
        whole += weight;
        r.emplace_back();
        for (std::size_t k = 0; k < sum.size(); ++k) {
            sum[k] += weight * static_cast<long double>(c[k]);
            r.back()[k] = sum[k] / whole;
        }
        weight *= static_cast<long double>(factor);
    }
    return r;
}

/// The largest error of one rounding to the format of numbers in [-1, 1], and of decoding.
template <class Format> double rounding()
{
    if constexpr (std::is_same_v<format_texel<Format>, channel_array<Format>>) return 0x1p-25 + 0x1p-36;
    else if constexpr (std::is_same_v<Format, moments6_unorm10>) return 0.5 / 1023 + 0x1p-25;
    else if constexpr (std::is_same_v<Format, convolution_unorm8>) return 0.5 / 255 + 0x1p-25;
    else return 0.5 / 65535 + 0x1p-25;
}

/// A map of random depths that stands in longer rows.
template <class Format> struct random_rows {
    std::size_t width, height;
    std::vector<format_texel<Format>> texels;
    std::vector<rectified_row> rows;

    random_rows(std::size_t w, std::size_t h, std::uint64_t seed) : width(w), height(h), texels((w + 2) * h), rows(h)
    {
        bit_source bits(seed);
        float factor = 1;
        for (rectified_row& r : rows) {
            if (bits.chance(0.5))
                factor = float(bits.chance(0.3) ? double(bits.below(2)) : 1 - std::exp2(bits.uniform(-20, 0)));
            r.factor = factor;
        }
        for (auto& t : texels) t = texel_of_depth<Format>(float(bits.chance(0.3) ? 1 : bits.uniform(-1, 1)));
    }
    map_view<format_texel<Format>> map() { return {texels, width, height, width + 2}; }
};

} // namespace

TEST_CASE_TEMPLATE("averages are off by one rounding to the format, for all widths", Format, moments4_float,
                   moments6_float, moments4_unorm16, moments6_unorm10, moments6_unorm16, convolution_unorm8,
                   exponential_float)
{
    if constexpr (!std::is_same_v<Format, exponential_float>) {
        for (const std::size_t width : {1u, 2u, 63u, 64u, 65u, 1024u}) {
            random_rows<Format> m(width, 19, width);
            const auto before = m.texels;
            transmittance_prefix<Format>(m.map(), m.rows, {0, m.height});
            for (std::size_t y = 0; y < m.height; ++y) {
                const std::span row(&before[y * (width + 2)], width + 2);
                const auto mean = averages_of<Format>(row.first(width), m.rows[y].factor);
                for (std::size_t x = 0; x < width; ++x) {
                    const auto c = load_channels<Format>(m.map()(x, y));
                    for (std::size_t k = 0; k < c.size(); ++k)
                        REQUIRE(std::abs(static_cast<long double>(c[k]) - mean[x][k]) <= rounding<Format>());
                }
                for (std::size_t x = width; x < width + 2; ++x)
                    REQUIRE(same_bytes(m.texels[y * (width + 2) + x], row[x]));
            }
        }
    } else { // of one channel
        random_rows<Format> m(100, 3, 1);
        const auto before = m.texels;
        transmittance_prefix<Format>(m.map(), m.rows, {0, 3});
        const auto mean = averages_of<Format>(std::span(before).first(100), m.rows[0].factor);
        for (std::size_t x = 0; x < 100; ++x)
            REQUIRE(double(load_channels<Format>(m.texels[x])[0]) == doctest::Approx(double(mean[x][0])).epsilon(1e-7));
    }
}

TEST_CASE("no row of floats is off by more, also none that a climber finds")
{
    using format = moments4_float;
    constexpr std::size_t width = 1024;
    const summit worst = climb(40, 4'000, 7, [](const std::vector<double>& place) {
        std::vector<format::texel> texels(width);
        for (std::size_t x = 0; x < width; ++x) {
            const float value = float(2 * place[x % 39] - 1);
            texels[x] = {value, -value, float(place[(x * 7 + 3) % 39]), 1};
        }
        const auto before = texels;
        std::vector<rectified_row> rows(1);
        rows[0].factor = float(1 - std::exp2(-30 * place[39]));
        transmittance_prefix<format>({texels, width, 1}, rows, {0, 1});
        const auto mean = averages_of<format>(before, rows[0].factor);
        double error = 0;
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t k = 0; k < 4; ++k)
                error = std::max(error, double(std::abs(static_cast<long double>(texels[x][k]) - mean[x][k])));
        return error;
    });
    CHECK(worst.score <= 0x1p-25 + 0x1p-36);
    CHECK(worst.score < 4.5e-8);
    CHECK(worst.score > 0x1p-26);
}

TEST_CASE_TEMPLATE("averages are convex, and equal texels stay what they are", Format, moments4_float, moments6_unorm10,
                   moments4_unorm16)
{
    random_rows<Format> m(300, 24, 5);
    for (std::size_t x = 0; x < m.width; ++x)
        for (std::size_t y = 0; y < m.height; y += 3) m.map()(x, y) = m.map()(0, y);
    const auto before = m.texels;
    transmittance_prefix<Format>(m.map(), m.rows, {0, m.height});
    const map_view<const format_texel<Format>> source(before, m.width, m.height, m.width + 2);
    for (std::size_t y = 0; y < m.height; ++y) {
        auto least = load_channels<Format>(source(0, y)), most = least;
        for (std::size_t x = 0; x < m.width; ++x) {
            const auto c = load_channels<Format>(m.map()(x, y)), s = load_channels<Format>(source(x, y));
            for (std::size_t k = 0; k < c.size(); ++k) {
                least[k] = std::min(least[k], s[k]);
                most[k] = std::max(most[k], s[k]);
                REQUIRE((least[k] <= c[k] && c[k] <= most[k]));
            }
            if (y % 3 == 0) REQUIRE(same_bytes(m.map()(x, y), source(0, y)));
        }
    }
}

TEST_CASE("any medium gives averages of the texels")
{
    hostile_source<float> source(6);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto x = source.draw();
        std::vector<moments4_float::texel> texels(70, {0.25f, 0.5f, 0, -1});
        for (std::size_t k = 0; k < 70; k += 3) texels[k] = {0.75f, 0.125f, 1, 1};
        const std::vector<rectified_row> rows{{1, 0, {0, 1}, x[0], x[1], x[2]}};
        transmittance_prefix<moments4_float>({texels, 70, 1}, rows, {0, 1});
        CHECK(texels[0] == moments4_float::texel{0.75f, 0.125f, 1, 1});
        for (const auto& t : texels) {
            REQUIRE((0.25f <= t[0] && t[0] <= 0.75f && 0.125f <= t[1] && t[1] <= 0.5f));
            REQUIRE((0 <= t[2] && t[2] <= 1 && -1 <= t[3] && t[3] <= 1));
        }
    }
}

TEST_CASE_TEMPLATE("bands of rows give the map of one pass", Format, moments6_float, moments4_unorm16)
{
    random_rows<Format> whole(130, 41, 3), banded(130, 41, 3);
    transmittance_prefix<Format>(whole.map(), whole.rows, {0, 41});
    for (const row_range band : {row_range{30, 41}, {0, 1}, {1, 1}, {1, 30}})
        transmittance_prefix<Format>(banded.map(), banded.rows, band);
    CHECK(whole.texels == banded.texels);
}

TEST_CASE("an infinite extinction gives the first texel, none the mean, and a NaN is none")
{
    using format = moments4_float;
    for (const float factor :
         {0.0f, -1.0f, -HUGE_VALF, 1.0f, 2.0f, HUGE_VALF, std::numeric_limits<float>::quiet_NaN()}) {
        std::vector<format::texel> texels{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
        std::vector<rectified_row> rows(1);
        rows[0].factor = factor;
        transmittance_prefix<format>({texels, 4, 1}, rows, {0, 1});
        if (factor <= 0) CHECK(texels[3] == format::texel{1, 0, 0, 0});
        else CHECK(texels[3] == format::texel{0.25f, 0.25f, 0.25f, 0.25f});
    }
}

TEST_CASE_TEMPLATE("a texel with a NaN or an infinity is the border", Format, moments4_float, moments6_float,
                   moments4_half)
{
    for (const float odd : {std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -HUGE_VALF})
        for (const std::size_t at : {0u, 5u, 99u}) {
            random_rows<Format> m(100, 2, 9), lit = m;
            for (const std::size_t y : {0u, 1u}) {
                m.map()(at, y) = texel_with<Format>(0.25f, odd, y + 1, false);
                lit.map()(at, y) = Format::clear();
            }
            transmittance_prefix<Format>(m.map(), m.rows, {0, 2});
            transmittance_prefix<Format>(lit.map(), m.rows, {0, 2});
            CHECK(m.texels == lit.texels);
        }
}

#if defined(__cpp_exceptions)
TEST_CASE("shapes that do not fit are refused before anything is written")
{
    using format = moments4_unorm16;
    std::vector<format::texel> texels(12, format::texel{1, 2, 3, 4});
    const auto before = texels;
    const std::vector<rectified_row> rows(3);
    const auto refused = [&](map_view<format::texel> map, std::span<const rectified_row> r, row_range band) {
        CHECK_THROWS_AS(transmittance_prefix<format>(map, r, band), std::invalid_argument);
        CHECK(texels == before);
    };
    refused({texels, 4, 3}, std::span(rows).first(2), {0, 2});
    refused({texels, 4, 3}, rows, {2, 4});
    refused({texels, 4, 3}, rows, {2, 1});
    refused({texels, 4, 3, 3}, rows, {0, 3});
    refused({texels, 5, 3}, rows, {0, 3});
    refused({texels, 0, 3}, rows, {0, 3});
    transmittance_prefix<format>({texels, 4, 3}, rows, {2, 2});
    CHECK(texels == before);
}
#endif
