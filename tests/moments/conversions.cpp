// Depth conventions, moments of one depth, linear combinations of moments, and the quantization transforms
// with their inverses.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/moments/moments.h>
#include <gnomon/moments/quantization.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

template <class T> std::array<T, 4> numbers(const moments4<T>& b) { return {b.b1, b.b2, b.b3, b.b4}; }
template <class T> std::array<T, 6> numbers(const moments6<T>& b) { return {b.b1, b.b2, b.b3, b.b4, b.b5, b.b6}; }
template <class T> moments4<T> moments(const std::array<T, 4>& b) { return {b[0], b[1], b[2], b[3]}; }
template <class T> moments6<T> moments(const std::array<T, 6>& b) { return {b[0], b[1], b[2], b[3], b[4], b[5]}; }
template <class T> std::array<T, 4> numbers(const channels4<T>& c) { return {c.c1, c.c2, c.c3, c.c4}; }
template <class T> std::array<T, 6> numbers(const channels6<T>& c) { return {c.c1, c.c2, c.c3, c.c4, c.c5, c.c6}; }
template <class T> channels4<T> channels(const std::array<T, 4>& c) { return {c[0], c[1], c[2], c[3]}; }
template <class T> channels6<T> channels(const std::array<T, 6>& c) { return {c[0], c[1], c[2], c[3], c[4], c[5]}; }

/// The powers z^1 to z^n in long double.
template <std::size_t n> std::array<exact, n> powers(exact z)
{
    std::array<exact, n> b{};
    exact p = 1;
    for (exact& x : b) x = p *= z;
    return b;
}

/// The matrix of an affine map of n numbers.
template <std::size_t n, class Map> std::array<std::array<double, n>, n> matrix(Map map)
{
    std::array<std::array<double, n>, n> a{};
    const auto origin = map(std::array<double, n>{});
    for (std::size_t j = 0; j < n; ++j) {
        std::array<double, n> axis{};
        axis[j] = 1;
        const auto column = map(axis);
        for (std::size_t i = 0; i < n; ++i) a[i][j] = column[i] - origin[i];
    }
    return a;
}

/// Checks a transform and its inverse in T. Each output is a sum of at most n + 1 rounded terms, for each of the two.
template <class T, std::size_t n, class Forward, class Back> void check_transform(Forward forward, Back back)
{
    const auto there = [=](const auto& b) { return numbers(forward(moments(b))); };
    const auto home = [=](const auto& c) { return numbers(back(channels(c))); };
    const auto a = matrix<n>(there), inverse = matrix<n>(home);
    std::array<double, n> least, most, forward_norm{}, there_and_back{};
    least.fill(2), most.fill(-2);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) forward_norm[i] += std::abs(a[i][j]);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) there_and_back[i] += std::abs(inverse[i][j]) * (forward_norm[j] + 1);
    const double roundings = 2 * double(n + 2) * u<T>;
    for (int k = -20000; k <= 20000; ++k) {
        std::array<T, n> b;
        const auto want = powers<n>(k / 20000.0L);
        std::transform(want.begin(), want.end(), b.begin(), [](exact x) { return T(x); });
        const auto c = there(b);
        const auto returned = home(c);
        for (std::size_t i = 0; i < n; ++i) {
            least[i] = std::min(least[i], double(c[i]));
            most[i] = std::max(most[i], double(c[i]));
            REQUIRE(double(c[i]) >= -roundings * forward_norm[i]);
            REQUIRE(double(c[i]) <= 1 + roundings * forward_norm[i]);
            REQUIRE(std::abs(double(returned[i] - b[i])) <= roundings * there_and_back[i]);
        }
    }
    // Each channel attains 0 and 1: between two of these depths an extreme changes by less than 1e-6.
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(least[i] < 1e-6);
        CHECK(most[i] > 1 - 1e-6);
    }
}

} // namespace

TEST_CASE_TEMPLATE("signed depth from other conventions is exact at the planes and right in between", T, float, double)
{
    CHECK(depth_from_unit(T(0)) == T(-1));
    CHECK(depth_from_unit(T(1)) == T(1));
    CHECK(depth_from_reversed(T(1)) == T(-1));
    CHECK(depth_from_reversed(T(0)) == T(1));
    CHECK(depth_from_distance(T(0.1), T(0.1), T(1000)) == T(-1));
    CHECK(depth_from_distance(T(1000), T(0.1), T(1000)) == T(1));
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const T z = T(bits.uniform(0, 1));
        REQUIRE(depth_from_unit(z) == T(2 * exact(z) - 1));
        REQUIRE(depth_from_reversed(z) == T(1 - 2 * exact(z)));
        // Two differences that add up to the range, their difference, the range and the quotient: 4 roundings of
        // at most 1.
        const T near_distance = T(bits.uniform(0.01, 1)), far_distance = T(bits.uniform(2, 5000));
        const T view = near_distance + T(bits.uniform(0, 1)) * (far_distance - near_distance);
        const exact want = 2 * (exact(view) - exact(near_distance)) / (exact(far_distance) - exact(near_distance)) - 1;
        REQUIRE(std::abs(double(exact(depth_from_distance(view, near_distance, far_distance)) - want)) <= 5 * u<T>);
    }
}

TEST_CASE_TEMPLATE("moments of a depth and of mixtures are off by their roundings only, four and six alike", T, float,
                   double)
{
    // The roundings in z, z^2, ..., z^6.
    constexpr std::array<int, 6> roundings = {0, 1, 2, 3, 4, 5};
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const T z = T(bits.uniform(-1, 1));
        const auto want = powers<6>(exact(z));
        const auto four = numbers(moments4_from_depth(z));
        const auto six = numbers(moments6_from_depth(z));
        for (std::size_t j = 0; j < 6; ++j)
            REQUIRE(std::abs(double(exact(six[j]) - want[j])) <=
                    roundings[j] * 1.001 * u<T> * std::abs(double(want[j])));
        REQUIRE(std::equal(four.begin(), four.end(), six.begin()));

        const T w = T(bits.uniform(0, 1)), other = T(bits.uniform(-1, 1));
        const auto mixed4 =
            numbers(moments4_add(moments4_scale(moments4_from_depth(z), w), moments4_from_depth(other), 1 - w));
        const auto mixed6 =
            numbers(moments6_add(moments6_scale(moments6_from_depth(z), w), moments6_from_depth(other), 1 - w));
        const auto want_other = powers<6>(exact(other));
        for (std::size_t j = 0; j < 6; ++j)
            REQUIRE(std::abs(double(exact(mixed6[j]) - (exact(w) * want[j] + (1 - exact(w)) * want_other[j]))) <=
                    9 * u<T>);
        REQUIRE(std::equal(mixed4.begin(), mixed4.end(), mixed6.begin()));
    }
}

TEST_CASE_TEMPLATE("moments of unit depth convert to moments of signed depth", T, float, double)
{
    // The coefficients of (2 c - 1)^4 sum to 81, each term is rounded up to four times and its input once.
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const double z = bits.uniform(0, 1), y = bits.uniform(0, 1), w = bits.uniform(0, 1);
        const auto first = powers<4>(exact(z)), second = powers<4>(exact(y)),
                   signed_first = powers<4>(2 * exact(z) - 1), signed_second = powers<4>(2 * exact(y) - 1);
        std::array<T, 4> c;
        for (std::size_t j = 0; j < 4; ++j) c[j] = T(exact(w) * first[j] + (1 - exact(w)) * second[j]);
        const auto b = numbers(moments4_from_unit(moments(c)));
        for (std::size_t j = 0; j < 4; ++j)
            REQUIRE(std::abs(double(exact(b[j]) - (exact(w) * signed_first[j] + (1 - exact(w)) * signed_second[j]))) <=
                    5 * 81 * u<T>);
    }
}

TEST_CASE_TEMPLATE("theta4 and theta6 map onto [0, 1], and their inverses map back", T, float, double)
{
    check_transform<T, 4>([](auto b) { return theta4(b); }, [](auto c) { return theta4_inverse(c); });
    check_transform<T, 6>([](auto b) { return theta6(b); }, [](auto c) { return theta6_inverse(c); });
}
