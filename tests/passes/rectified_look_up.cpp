// Look-ups of view rays in prefix averages: exact for rays that end anywhere in a row, continuous across columns, rows and the
// seam of a full turn, in all mip levels near the averages there; and total.
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using format = moments4_float;
constexpr float turn = 6.2831853f, half_turn = 3.1415927f;

/// Rows of texels that alternate at random between two depths, and their prefix averages.
struct averaged {
    std::size_t width, height;
    rectified_frame frame;
    std::vector<rectified_row> rows;
    std::vector<format::texel> source, texels;

    averaged(std::size_t w, std::size_t h, rectified_frame f, float extinction, std::uint64_t seed, bool same_rows)
        : width(w), height(h), frame(f), rows(h), source(w * h), texels(mip_texels(w, h))
    {
        bit_source bits(seed);
        rectified_rows(frame, rectified_frustum<float>{f.radius, f.azimuth_start, f.azimuth_length, 1, 2}, extinction,
                       w, rows);
        for (std::size_t k = 0; k < w * h; ++k)
            source[k] = same_rows && k >= w ? source[k - w] : texel_of_depth<format>(bits.chance(0.5) ? -0.5f : 0.25f);
        std::copy(source.begin(), source.end(), texels.begin());
        transmittance_prefix<format>(mips().level(0), rows, {0, h});
        build_mips<format>(mips());
    }
    mip_view<format::texel> mips() { return {texels, width, height}; }
    channels4<float> at(float radius, float azimuth, float level = 0)
    {
        return rectified_channels<format>(mips(), frame, rows, {radius, azimuth, 1.5f}, level);
    }
    /// The average of channel 1 over row v up to radius.
    [[nodiscard]] double average(std::size_t v, double radius) const
    {
        const double step = double(frame.radius) / double(width), rate = double(rows[v].optical_depth);
        double sum = 0, whole = 0;
        for (std::size_t u = 0; double(u) * step < radius; ++u) {
            const double from = double(u), to = std::min(double(u + 1), radius / step);
            const double weight =
                rate > 0 ? std::exp(-rate * from) * -std::expm1(-rate * (to - from)) / rate : to - from;
            sum += weight * double(source[v * width + u][0]);
            whole += weight;
        }
        return sum / whole;
    }
};

} // namespace

TEST_CASE("a ray that ends anywhere has the average up to there, for every extinction")
{
    bit_source bits(1);
    for (const float extinction : {0.0f, 1e-4f, 0.3f, 5.0f, 200.0f, 1e4f}) {
        averaged m(50, 4, {2, 0.5f, 1, rectified_depth::polar}, extinction, 3, true);
        for (std::int64_t i = 0; i < effort(3'000); ++i) {
            const float radius = float(bits.uniform(0.001, 2)), azimuth = float(bits.uniform(0.4, 1.6));
            const double expected = m.average(0, double(radius));
            REQUIRE(std::abs(double(m.at(radius, azimuth).c1) - expected) < 2e-6);
            const auto of_map = rectified_channels<format>(m.mips().level(0), m.frame, m.rows, {radius, azimuth, 1.5f});
            REQUIRE(std::abs(double(of_map.c1) - expected) < 2e-6);
        }
        CHECK(m.at(0, 1).c1 == m.texels[0][0]);
        CHECK(m.at(2, 1).c1 == doctest::Approx(double(m.texels[49][0])).epsilon(1e-6));
        CHECK(m.at(HUGE_VALF, 1).c1 == m.texels[49][0]);
    }
}

// Error: 24 2^-p.
TEST_CASE_TEMPLATE("the weight between two averages is exact, and that of a share of a texel", T, float, double)
{
    const double unit = std::is_same_v<T, float> ? 0x1p-24 : 0x1p-53;
    const summit worst = climb(4, 200'000, 5, [&](const std::vector<double>& place) {
        const T before = T(std::exp2(20 * place[0]) - 1), length = T(std::exp2(8 * place[1])), f = T(place[2]);
        const T depth = T(place[3] < 0.1 ? 0 : std::exp2(40 * place[3] - 34));
        const auto weight = [&](long double d) {
            return depth > 0 ? -std::expm1(-static_cast<long double>(depth) * d) / static_cast<long double>(depth) : d;
        };
        const long double whole = static_cast<long double>(before), part = static_cast<long double>(f * length);
        if (!(whole + part > 0)) return 0.0;
        const long double exact = weight(part) * weight(whole + static_cast<long double>(length)) /
                                  (weight(whole + part) * weight(static_cast<long double>(length)));
        const T found = transmittance_weight_between(before, length, f, depth);
        return double(std::abs(static_cast<long double>(found) - exact)) / unit;
    });
    CHECK(worst.score <= 24);
    CHECK(worst.score > 2);
    // The share of a texel after u others, all of transmittance q.
    for (const double depth : {1e-3, 0.1, 2.0}) {
        double g = 1;
        const double q = std::exp(-depth);
        for (int u = 1; u < 30; ++u) {
            g = transmittance_weight_next(g, q);
            for (const double f : {0.0, 0.3, 1.0})
                CHECK(std::abs(double(transmittance_weight_between(T(u), T(1), T(f), T(depth))) -
                               transmittance_weight_within(g, q, f)) < 2e-6);
        }
    }
}

TEST_CASE("an infinite extinction gives the first texel of a row, and a frame without extent its rows")
{
    averaged opaque(20, 4, {2, 0, 1, rectified_depth::polar}, HUGE_VALF, 3, true);
    for (float r = 0; r < 2; r += 0.01f) CHECK(opaque.at(r, 0.5f).c1 == opaque.source[0][0]);
    averaged point(20, 4, {0, 0, 1, rectified_depth::polar}, 0.5f, 3, true);
    for (const float r : {0.0f, 1.0f}) CHECK(std::abs(double(point.at(r, 0.5f).c1)) <= 0.5);
}

TEST_CASE("rows are mixed from centre to centre, and over the seam of a full turn only")
{
    for (const float length : {turn, 2.0f})
        for (const float start : {-half_turn, -1.0f, 1.5f}) {
            averaged m(8, 6, {1, start, length, rectified_depth::polar}, 0.7f, 5, false);
            const bool wraps = length > 6;
            CHECK(m.frame.wraps() == wraps);
            const auto wrapped = [](double angle) { return float(std::remainder(angle, 2 * std::acos(-1.0))); };
            for (int k = 0; k <= 60; ++k) {
                const double row = k / 10.0, below = std::floor(row - 0.5), share = row - 0.5 - below;
                const auto of = [&](double v) {
                    const double inside = wraps ? std::fmod(v + 6, 6) : std::clamp(v, 0.0, 5.0);
                    return double(m.texels[std::size_t(inside) * 8 + 7][0]);
                };
                const double expected = (1 - share) * of(below) + share * of(below + 1);
                const float azimuth = wrapped(double(start) + row / 6 * double(length));
                REQUIRE(double(m.at(1, azimuth).c1) == doctest::Approx(expected).epsilon(1e-5));
            }
        }
}

TEST_CASE("channels are continuous, in radius, azimuth and level")
{
    averaged m(33, 21, {3, -half_turn, turn, rectified_depth::polar}, 0.4f, 7, false);
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const float r = float(bits.uniform(0.2, 3)), a = float(bits.uniform(-3.15, 3.15)),
                    l = float(bits.uniform(0, 5));
        const double here = double(m.at(r, a, l).c1);
        for (const auto& [dr, da, dl] : {std::array{1e-4f, 0.0f, 0.0f}, {0.0f, 1e-4f, 0.0f}, {0.0f, 0.0f, 1e-4f}}) {
            const float beside = a + da > half_turn ? a + da - turn : a + da;
            REQUIRE(std::abs(double(m.at(r + dr, beside, l + dl).c1) - here) < 4e-3);
        }
    }
}

// Level l has means over 2^l texels, which stand at the mean of the radii that they end at.
TEST_CASE("a mip level is looked up where its averages stand")
{
    averaged m(256, 4, {256, 0, 1, rectified_depth::polar}, 0.001f, 7, true);
    bit_source bits(4);
    for (int level = 1; level <= 4; ++level) {
        const double half = std::exp2(level - 1);
        double worst = 0, off_by_half = 0;
        for (double r = 64; r < 230; r += 0.37) {
            double mean = 0;
            for (int k = 0; k < 64; ++k) mean += m.average(0, r + half * ((k + 0.5) / 32 - 1)) / 64;
            worst = std::max(worst, std::abs(double(m.at(float(r), 0.5f, float(level)).c1) - mean));
            off_by_half = std::max(off_by_half, std::abs(double(m.at(float(r + half), 0.5f, float(level)).c1) - mean));
        }
        CHECK(worst < 0.01);
        CHECK(worst < 0.7 * off_by_half);
    }
}

TEST_CASE("the depth of a ray is that between the ranges of its rows")
{
    rectified_frame frame{1, 0, 1, rectified_depth::polar};
    for (const rectified_depth measure : {rectified_depth::polar, rectified_depth::cosine}) {
        frame.depth = measure;
        std::vector<rectified_row> rows(2);
        rows[0].range = rectified_range_of(measure, {0.5f, 1.5f});
        rows[1].range = rectified_range_of(measure, {0.7f, 2.0f});
        for (const float share : {0.0f, 0.25f, 1.0f}) {
            const float z = rectified_depth_at(frame, rows, {1, 0.25f + 0.5f * share, 1.1f});
            const float a = rectified_depth_of(measure, 1.1f, rows[0].range),
                        b = rectified_depth_of(measure, 1.1f, rows[1].range);
            CHECK(double(z) == doctest::Approx(double(a + share * (b - a))).epsilon(1e-5));
        }
        // The guard band keeps the ends of the range off the ends of depth.
        CHECK(double(std::abs(rectified_depth_of(measure, 0.5f, rows[0].range))) ==
              doctest::Approx(1 / 1.1).epsilon(1e-5));
        CHECK(rectified_depth_of(measure, 0.5f, rows[0].range) > 0);
        CHECK(rectified_depth_of(measure, 1.5f, rows[0].range) < 0);
    }
}

TEST_CASE("look-ups are total, and lit without a number or a map")
{
    averaged m(7, 5, {1, -half_turn, turn, rectified_depth::polar}, 0.3f, 7, false);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto lit = [](const channels4<float>& c) { return format::encode(c) == format::clear(); };
    CHECK(lit(m.at(nan, 0)));
    CHECK(lit(m.at(0.5f, nan)));
    CHECK(lit(m.at(0.5f, 0, nan)));
    CHECK(lit(rectified_channels<format>(mip_view<const format::texel>{}, m.frame, m.rows, {1, 1, 1}, 0)));
    CHECK(lit(rectified_channels<format>(map_view<const format::texel>{}, m.frame, m.rows, {1, 1, 1})));
    CHECK(lit(rectified_channels<format>(m.mips(), m.frame, {}, {1, 1, 1}, 0)));
    CHECK(rectified_depth_at(m.frame, {}, {1, 1, 1}) == -1);
    hostile_source<float> source(3);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw(), y = source.draw();
        const rectified_frame frame{x[0], x[1], x[2], i % 2 ? rectified_depth::polar : rectified_depth::cosine};
        m.rows[std::size_t(i) % 5].optical_depth = y[0];
        m.rows[std::size_t(i) % 5].decay = i % 3 == 0 ? 0 : y[1];
        const rectified_position<float> p{x[3], x[4], x[5]};
        const auto c = rectified_channels<format>(m.mips(), frame, m.rows, p, x[6]);
        for (const float value : gnomon_bit_cast<channel_array<format>>(c)) REQUIRE((-1 <= value && value <= 1));
        const float z = rectified_depth_at(frame, m.rows, p);
        REQUIRE((std::isnan(z) || (-1 <= z && z <= 1)));
    }
}
