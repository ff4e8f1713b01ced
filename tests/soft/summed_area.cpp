// Kernels of summed-area tables: the scale that no sum wraps with, codes, and rectangles that a look-up may read.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/numerics/round.h>
#include <gnomon/soft/summed_area.h>
#include <gnomon/storage/moments4_summed.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::uint64_t largest = 0xffffffff;

/// A whole number that T holds.
template <class T> std::uint64_t whole(T x)
{
    REQUIRE(x >= 0);
    REQUIRE(x == std::floor(x));
    return std::uint64_t(x);
}

template <class T> T touched(T begin, T end) { return std::ceil(end) - std::floor(begin); }

} // namespace

TEST_CASE("the scale is the largest whole float with which most_texels codes do not wrap around")
{
    for (std::uint64_t n = 1; n <= 1 << 20; n += draws_few() && n > 4096 ? 97 : 1) {
        const float scale = summed_area_scale(float(n));
        REQUIRE(n * whole(scale) <= largest);
        const float next = std::max(scale + 1, std::nextafter(scale, HUGE_VALF));
        REQUIRE(n * whole(next) > largest);
        const double in_double = summed_area_scale(double(n));
        REQUIRE(n * whole(in_double) <= largest);
        REQUIRE(in_double >= double(scale));
        if (n % 61 == 0 || n == 784) REQUIRE(n * whole(summed_area_code(1.0f, scale)) <= largest);
    }
    CHECK(summed_area_scale(784.0f) == 5478274);
    // The paper's scale for the same 784 texels, whose code of 1 is rounded up.
    CHECK(784 * std::uint64_t(std::llround(double(largest) / 784)) > largest);
}

TEST_CASE_TEMPLATE("codes are the nearest whole numbers, and at most the scale", T, float, double)
{
    bit_source bits(1);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T scale = summed_area_scale(T(256 + bits.below(3840)));
        const T channel =
            bits.chance(0.1) ? T(1) - T(bits.below(4)) * std::numeric_limits<T>::epsilon() : T(bits.uniform(0, 1));
        const T code = summed_area_code(channel, scale);
        REQUIRE(whole(code) <= whole(scale));
        worst = std::max(worst, double(std::abs((long double)(code) - (long double)(channel) * (long double)(scale))));
    }
    CHECK(worst <= 0.5);
    CHECK(worst > 0.49);
    hostile_source<T> source(2);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const T x = source.draw()[0];
        const T code = summed_area_code(x, T(5478274));
        REQUIRE(std::abs(code - T(5478274) * (std::isnan(x) ? 0 : std::clamp(x, T(0), T(1)))) <= T(0.5));
    }
    for (const T x : {T(0), T(0.5), T(1.5), T(2.5), T(8388607.5), T(8388609), T(1e30)})
        CHECK(nearest_natural(x) == std::nearbyint(x));
}

TEST_CASE_TEMPLATE("a clipped rectangle is in the map, touches no more than most_texels, and keeps what fits", T, float,
                   double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T width = T(1 + bits.below(bits.chance(0.1) ? 65536 : 300)), height = T(1 + bits.below(300));
        const T most = T(4 + bits.below(bits.chance(0.5) ? 100 : 4093));
        const T w = T(std::exp2(bits.uniform(-10, 9))), h = bits.chance(0.5) ? w : T(std::exp2(bits.uniform(-10, 9)));
        const T x = T(bits.uniform(-20, double(width) + 20)), y = T(bits.uniform(-20, double(height) + 20));
        const summed_area_rectangle<T> asked = summed_area_around(x, y, w, h);
        const summed_area_rectangle<T> r = summed_area_clip(asked, width, height, most);
        const T x0 = std::max(asked.x0, T(0)), x1 = std::min(asked.x1, width);
        const T y0 = std::max(asked.y0, T(0)), y1 = std::min(asked.y1, height);
        if (!(x0 < x1 && y0 < y1)) {
            REQUIRE((r.x0 == 0 && r.y0 == 0 && r.x1 == 0 && r.y1 == 0));
            continue;
        }
        REQUIRE((x0 <= r.x0 && r.x0 < r.x1 && r.x1 <= x1 && y0 <= r.y0 && r.y0 < r.y1 && r.y1 <= y1));
        const T texels = touched(r.x0, r.x1) * touched(r.y0, r.y1);
        REQUIRE(texels <= most);
        if (touched(x0, x1) * touched(y0, y1) <= most) REQUIRE((r.x0 == x0 && r.x1 == x1 && r.y0 == y0 && r.y1 == y1));
        else {
            REQUIRE(std::abs((r.x0 + r.x1) - (x0 + x1)) <= T(0.01)); // about the same centre
            REQUIRE(std::abs((r.y0 + r.y1) - (y0 + y1)) <= T(0.01));
        }
        const summed_area_rectangle<T> g = summed_area_grow(r);
        REQUIRE((g.x0 == std::floor(r.x0) && g.x1 == std::ceil(r.x1)));
        REQUIRE((g.y0 == std::floor(r.y0) && g.y1 == std::ceil(r.y1)));
    }
    // The paper's example: 27 x 27 texels anywhere touch 784 at most; 29 x 29 texels shrink to those.
    const summed_area_rectangle<float> r =
        summed_area_clip(summed_area_around(50.5f, 50.5f, 27.0f, 27.0f), 99, 99, 784);
    CHECK((r.x0 == 37 && r.x1 == 64));
    const summed_area_rectangle<float> s =
        summed_area_clip(summed_area_around(50.25f, 50.5f, 29.0f, 29.0f), 99, 99, 784);
    CHECK((s.x0 == 36.75f && s.x1 == 63.75f && s.y0 == 37 && s.y1 == 64));
}

TEST_CASE_TEMPLATE("means and channels of four moments have their stated errors", T, float, double)
{
    using exact = long double;
    bit_source bits(9);
    double mean = 0, channel = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T scale = summed_area_scale(T(4 + bits.below(4093))), area = T(bits.uniform(1, 1000));
        const T sum = T(bits.uniform(1e-3, 1) * double(area) * double(scale));
        const exact want = std::min(exact(1), exact(sum) / (exact(area) * exact(scale)));
        mean = std::max(mean, double(std::abs(exact(summed_area_mean(sum, area, scale)) / want - 1)) / u<T>);
        const T z = bits.chance(0.1) ? T(int(bits.below(9)) - 4) / 4 : T(bits.uniform(-1, 1));
        const exact x = exact(z), root = std::sqrt(exact(3));
        const auto c = gnomon_bit_cast<std::array<T, 4>>(moments4_summed_encode(z));
        const std::array<exact, 4> channels{(1 + 3 * x - 4 * x * x * x) / 2, 4 * (x * x - x * x * x * x),
                                            exact(0.5) + root / 2 * x - 2 * root / 9 * x * x * x,
                                            (x * x + x * x * x * x) / 2};
        for (std::size_t k = 0; k < 4; ++k)
            channel = std::max(channel, double(std::abs(exact(c[k]) - channels[k])) / u<T>);
    }
    CHECK(mean <= 1);
    CHECK(channel <= 0.51);
    if (!draws_few()) CHECK((mean > 0.5 && channel > 0.45)); // the measure sees errors
}

TEST_CASE_TEMPLATE("clipping and growing are total", T, float, double)
{
    hostile_source<T> source(5);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto x = source.draw();
        const summed_area_rectangle<T> asked{x[0], x[1], x[2], x[3]};
        const summed_area_rectangle<T> g = summed_area_grow(summed_area_clip(asked, x[4], x[5], x[6]));
        for (const T line : {g.x0, g.y0, g.x1, g.y1}) REQUIRE((0 <= line && line <= 65536 && line == std::floor(line)));
        REQUIRE((g.x1 - g.x0) * (g.y1 - g.y0) <= std::max(T(4), std::isnan(x[6]) ? T(1 << 20) : x[6]));
        const auto parts = summed_area_split(x[0], x[1]);
        for (const T line : {parts.line0, parts.line1, parts.line2, parts.line3})
            REQUIRE((-65537 <= line && line <= 65537));
        for (const T width : {parts.width0, parts.width1, parts.width2}) REQUIRE((0 <= width && width <= 1));
    }
}

TEST_CASE_TEMPLATE("the parts of an interval lie side by side and add up to it", T, float, double)
{
    bit_source bits(7);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T begin = bits.chance(0.2) ? T(bits.below(200)) : T(bits.uniform(0, 200));
        const T end = begin + (bits.chance(0.2) ? T(1 + bits.below(9)) : T(std::exp2(bits.uniform(-12, 6))));
        if (!(begin < end)) continue;
        const summed_area_parts<T> p = summed_area_split(begin, end);
        REQUIRE((std::floor(begin) == p.line0 && p.line1 == p.line0 + 1 && p.line1 <= p.line2 && p.line2 <= p.line3));
        REQUIRE(p.line3 <= std::max(std::ceil(end), p.line1));
        REQUIRE(std::abs(summed_area_width(p) - (end - begin)) <= T(4) * T(u<T>) * end);
        if (end <= p.line1) REQUIRE((p.width1 == 0 && p.width2 == 0 && p.line3 == p.line1));
        else REQUIRE((p.width1 == 1 && p.line2 + p.width2 == end && p.line3 == std::ceil(end)));
    }
}
