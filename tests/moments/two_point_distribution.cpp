// Algorithm 2: two depths from three moments, against the two depths that the moments came from, and
// against the moments.
#include "support/climber.hpp"
#include "support/distributions.hpp"
#include "support/effort.hpp"

#include <gnomon/moments/quantization.h>
#include <gnomon/moments/two_point.h>

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

std::array<exact, 4> moments_of(const distribution& d)
{
    std::array<exact, 4> b{};
    exact total = 0;
    for (const double w : d.weights) total += exact(w);
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        exact p = exact(d.weights[i]) / total;
        for (exact& x : b) x += p, p *= exact(d.depths[i]);
    }
    return b;
}

} // namespace

// Let the depths be z1 < z2, a distance s apart, with weights w1 and w2. Rounding of the moments by u moves them by
// about u / (w1 w2 s^2) times a small factor: V = w1 w2 s^2 divides the error of b1 b2 - b3, at most 3 u. The weights
// follow by division by s.
TEST_CASE_TEMPLATE("two depths are recovered from their moments", T, float, double)
{
    const T least_variance = std::is_same_v<T, float> ? T(two_point_least_variance) : T(0x1p-48);
    distribution_source source(3);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const distribution d = source.draw(i % 2 == 0 ? family::two_points : family::two_points_at_ends);
        const auto b = moments_of(d);
        const auto [z1, z2] = std::minmax(d.depths[0], d.depths[1]);
        const double s = z2 - z1, w1 = d.depths[0] < d.depths[1] ? d.weights[0] : d.weights[1], w2 = 1 - w1;
        const double tolerance = 16 * double(std::numeric_limits<T>::epsilon()) / (w1 * w2 * s * s);
        if (tolerance > 0.01) continue;
        const distribution2<T> r = two_point_distribution(T(b[1]), T(b[2]), T(b[3]), least_variance);
        REQUIRE(std::abs(double(r.depth1) - z1) <= tolerance);
        REQUIRE(std::abs(double(r.depth2) - z2) <= tolerance);
        REQUIRE(std::abs(double(r.weight1) - w1) <= 2 * tolerance / s);
        REQUIRE(std::abs(double(r.weight2) - w2) <= 2 * tolerance / s);
    }
}

// Depths may lie far apart, so errors are relative to the largest of the terms that make a moment.
TEST_CASE_TEMPLATE("the distribution has the given moments, for every family", T, float, double)
{
    const T least_variance = std::is_same_v<T, float> ? T(two_point_least_variance) : T(0x1p-48);
    distribution_source source(4);
    for (int f = 0; f < family_count; ++f)
        for (std::int64_t i = 0; i < effort(10'000); ++i) {
            const auto b = moments_of(source.draw(family(f)));
            const distribution2<T> r = two_point_distribution(T(b[1]), T(b[2]), T(b[3]), least_variance);
            REQUIRE(r.depth1 <= r.depth2);
            const double variance = double(b[2] - b[1] * b[1]);
            if (r.depth1 == r.depth2) {
                // A single depth is also right for a variance that rounding of b2 and b1^2 may have moved
                // over the limit.
                REQUIRE(variance <= double(least_variance) + 2 * double(std::numeric_limits<T>::epsilon()));
                REQUIRE(r.depth1 == T(b[1]));
                REQUIRE(r.weight1 + r.weight2 == T(1));
                continue;
            }
            const double z1 = double(r.depth1), z2 = double(r.depth2), w1 = double(r.weight1), w2 = double(r.weight2);
            const double scale = std::max({1.0, std::abs(z1), std::abs(z2)});
            const double unit = 8 * double(std::numeric_limits<T>::epsilon());
            REQUIRE(std::abs(w1 * z1 + w2 * z2 - double(b[1])) <= unit * scale);
            REQUIRE(std::abs(w1 * z1 * z1 + w2 * z2 * z2 - double(b[2])) <= unit * scale * scale);
            REQUIRE(std::abs(w1 * z1 * z1 * z1 + w2 * z2 * z2 * z2 - double(b[3])) <= unit * scale * scale * scale);
        }
}

TEST_CASE_TEMPLATE("without variance the result is one depth, for NaN the far plane", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (const T z : {T(-1), T(0), T(0.25), T(1)}) {
        const distribution2<T> r = two_point_distribution(z, z * z, z * z * z, T(0));
        CHECK(r.depth1 == z);
        CHECK(r.depth2 == z);
        CHECK(r.weight1 + r.weight2 == T(1));
    }
    CHECK(two_point_distribution(nan, T(0), T(0), T(0)).depth1 == T(1));
    CHECK(two_point_distribution(T(0), nan, T(0), T(0)).depth2 <= T(1));
    CHECK(two_point_distribution(T(0), T(0.5), nan, T(0)).weight1 <= T(1));
}

// Three roundings, of b2 and twice of b1, amount to at most 3 2^-25.
TEST_CASE("the variance of a single depth in moments stored as floats is below two_point_least_variance")
{
    const summit found = climb(1, 100'000, 1, [](const std::vector<double>& p) {
        const double z = 2 * p[0] - 1;
        const float b1 = float(z), b2 = float(z * z), b3 = float(z * z * z);
        const auto d = two_point_distribution(b1, b2, b3, float(two_point_least_variance));
        return d.depth1 == d.depth2 ? double(b2) - double(b1) * double(b1) : HUGE_VAL;
    });
    CHECK(found.score <= 0x3p-25);
    CHECK(found.score > 0x2p-25);
}

// For any input, depths are ordered and in [-8193, 8193], and weights are in [0, 1] with a sum that rounds to 1. The
// climb searches for the farthest depth; its places are bit patterns in the order of the numbers.
TEST_CASE_TEMPLATE("for any bit pattern, the two depths are within 8193 of 0", T, float, double)
{
    using word = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const T least_variance = std::is_same_v<T, float> ? T(two_point_least_variance) : T(0x1p-48);
    const auto pattern = [](double place) {
        const double half = std::abs(2 * place - 1);
        const auto magnitude = word(half * std::ldexp(1.0, 8 * int(sizeof(T)) - 1) * (1 - 0x1p-53));
        const T x = std::bit_cast<T>(magnitude);
        return place < 0.5 ? -x : x;
    };
    const auto farthest = [](const distribution2<T>& d) {
        const bool holds = d.depth1 <= d.depth2 && d.weight1 >= 0 && d.weight2 >= 0 && d.weight1 + d.weight2 == T(1);
        return holds ? std::max(-double(d.depth1), double(d.depth2)) : HUGE_VAL;
    };
    const summit any = climb(4, 300'000, 1, [&](const std::vector<double>& p) {
        return farthest(two_point_distribution(pattern(p[0]), pattern(p[1]), pattern(p[2]), pattern(p[3])));
    });
    CHECK(any.score <= 8193);
    CHECK(any.score > 2000); // the search reaches far depths
    const summit near = climb(3, 300'000, 2, [&](const std::vector<double>& p) {
        return farthest(two_point_distribution(T(8 * p[0] - 4), T(std::exp2(60 * p[1] - 25)),
                                               T(std::exp2(70 * p[2] - 35)), least_variance));
    });
    CHECK(near.score <= 8193);
    CHECK(near.score > 4096);
    // A case whose depths would be 10000.
    CHECK(farthest(two_point_distribution(T(0), T(6e7), T(2.4e11), least_variance)) <= 8193);
}

// The distance between a distribution of two depths and what Algorithm 2 finds from 4 x 16 UNORM: the integral of the difference of
// their shares before each depth.
TEST_CASE("taking noise out of the skew brings close depths nearer, and others not much farther")
{
    const auto mean_distance = [&](double apart, float noise, bool equal) {
        bit_source bits(5); // the same cases for any noise
        double sum = 0;
        const std::int64_t count = effort(20'000);
        for (std::int64_t i = 0; i < count; ++i) {
            const double w = equal ? 0.5 : bits.uniform(0, 1), z1 = bits.uniform(-1, 1 - apart), z2 = z1 + apart;
            moments4<double> b = moments4_scale(moments4_from_depth(z1), 1 - w);
            b = moments4_add(b, moments4_from_depth(z2), w);
            const auto exact = gnomon_bit_cast<std::array<double, 4>>(theta4(b));
            std::array<float, 4> stored{};
            for (std::size_t k = 0; k < 4; ++k) stored[k] = float(std::floor(exact[k] * 65535 + 0.5) / 65535);
            const moments4<float> r = theta4_inverse(gnomon_bit_cast<channels4<float>>(stored));
            const distribution2<float> d = two_point_distribution(
                r.b1, r.b2, two_point_third_moment(r.b1, r.b2, r.b3, noise), float(two_point_unorm16_least_variance));
            std::array<double, 4> z{z1, z2, double(d.depth1), double(d.depth2)};
            std::sort(z.begin(), z.end());
            for (std::size_t k = 0; k < 3; ++k) {
                const double at = (z[k] + z[k + 1]) / 2;
                const double share = (z1 < at ? 1 - w : 0) + (z2 < at ? w : 0);
                const double found = (double(d.depth1) < at ? double(d.weight1) : 0.0) +
                                     (double(d.depth2) < at ? double(d.weight2) : 0.0);
                sum += std::abs(share - found) * (z[k + 1] - z[k]);
            }
        }
        return sum / double(count);
    };
    CHECK(mean_distance(0.05, 0x1p-17f, true) < 0.92 * mean_distance(0.05, 0, true));
    CHECK(mean_distance(0.05, 0x1p-17f, false) < 0.96 * mean_distance(0.05, 0, false));
    CHECK(mean_distance(0.1, 0x1p-17f, true) < mean_distance(0.1, 0, true));
    for (const double apart : {0.1, 0.2, 0.5}) {
        CHECK(mean_distance(apart, 0x1p-17f, false) < 1.15 * mean_distance(apart, 0, false));
        CHECK(mean_distance(apart, 0x1p-17f, false) < 6e-3);
    }
}

// A single depth in 4 x 16 UNORM has a variance of 5.26 times half a code at most.
TEST_CASE("the variance of a single depth in 4 x 16 UNORM is below two_point_unorm16_least_variance")
{
    const summit found = climb(1, 200'000, 7, [](const std::vector<double>& p) {
        auto c = gnomon_bit_cast<std::array<double, 4>>(theta4(moments4_from_depth(2 * p[0] - 1)));
        for (double& x : c) x = std::floor(x * 65535 + 0.5) / 65535;
        const moments4<double> b = theta4_inverse(gnomon_bit_cast<channels4<double>>(c));
        return b.b2 - b.b1 * b.b1;
    });
    CHECK(found.score <= double(two_point_unorm16_least_variance));
    CHECK(found.score > 3.5e-5);
}
