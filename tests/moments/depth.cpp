// Signed depth from depth buffers, against the projections in long double: stated errors, planes, and what lies beyond.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/moments/depth.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

/// Planes of a light: near 0.01 to 1, far 2 to 10^7 times as far.
template <class T> std::array<T, 2> planes(bit_source& bits)
{
    const double near_distance = std::pow(10.0, bits.uniform(-2, 0));
    return {T(near_distance), T(near_distance * std::pow(10.0, bits.uniform(std::log10(2.01), 7)))};
}

/// A value of a buffer: anywhere, or near one of its ends.
template <class T> T buffered(bit_source& bits)
{
    const double x = bits.chance(0.5) ? bits.uniform(0, 1) : std::exp2(bits.uniform(-30, 0));
    return T(bits.chance(0.5) ? x : 1 - x);
}

/// Signed depth of a distance, not farther than the far plane.
exact signed_depth(exact distance, exact near_distance, exact far_distance)
{
    return 2 * (std::min(distance, far_distance) - near_distance) / (far_distance - near_distance) - 1;
}

/// The largest error of convert(z, near, far) in units of 2^-p, where distance(z, near, far) inverts the projection.
template <class T, class Convert, class Distance> double largest_error(Convert convert, Distance distance)
{
    bit_source bits(3);
    double largest = 0;
    for (std::int64_t i = 0; i < effort(300'000); ++i) {
        const auto [n, f] = planes<T>(bits);
        const T z = buffered<T>(bits);
        const exact want = signed_depth(distance(exact(z), exact(n), exact(f)), exact(n), exact(f));
        largest = std::max(largest, std::abs(double(exact(convert(z, n, f)) - want)) / u<T>);
    }
    return largest;
}

} // namespace

TEST_CASE_TEMPLATE("depths from perspective buffers have at most their stated errors", T, float, double)
{
    const auto check = [](double error, double stated) {
        CHECK(error <= stated);
        CHECK(error > 1); // the measure sees errors
    };
    check(largest_error<T>([](T z, T n, T f) { return depth_from_perspective(z, n, f); },
                           [](exact z, exact n, exact f) { return n * f / (f * (1 - z) + n * z); }),
          4);
    check(largest_error<T>([](T z, T n, T f) { return depth_from_reversed_perspective(z, n, f); },
                           [](exact z, exact n, exact f) { return n * f / (f * z + n * (1 - z)); }),
          4);
    check(largest_error<T>([](T z, T n, T f) { return depth_from_reversed_infinite(z, n, f); },
                           [](exact z, exact n, exact) { return n / z; }),
          8);
    check(largest_error<T>([](T z, T n, T f) { return depth_from_infinite(T(1) - z, n, f); },
                           [](exact z, exact n, exact) { return n / (1 - exact(T(1) - T(z))); }),
          8);
}

TEST_CASE_TEMPLATE("planes of perspective buffers are exact, points beyond are on them, NaN stays NaN", T, float,
                   double)
{
    const T n = T(0.1), f = T(1000), infinity = std::numeric_limits<T>::infinity();
    const auto check = [&](auto convert, T near_value, T far_value) {
        CHECK(convert(near_value, n, f) == T(-1));
        CHECK(convert(far_value, n, f) == T(1));
        const T beyond = far_value > near_value ? T(1) : T(-1);
        for (const T step : {T(1e-3), T(5), infinity}) {
            CHECK(convert(near_value - beyond * step, n, f) == T(-1));
            CHECK(convert(far_value + beyond * step, n, f) == T(1));
        }
        CHECK(std::isnan(convert(std::numeric_limits<T>::quiet_NaN(), n, f)));
    };
    check([](T z, T a, T b) { return depth_from_perspective(z, a, b); }, T(0), T(1));
    check([](T z, T a, T b) { return depth_from_reversed_perspective(z, a, b); }, T(1), T(0));
    check([](T z, T a, T b) { return depth_from_infinite(z, a, b); }, T(0), T(1));
    check([](T z, T a, T b) { return depth_from_reversed_infinite(z, a, b); }, T(1), T(0));
    // A point behind the chosen far plane of an infinite projection, at twice its distance.
    CHECK(depth_from_reversed_infinite(n / (2 * f), n, f) == T(1));
    CHECK(depth_from_reversed_infinite(-T(0), n, f) == T(1));
}

TEST_CASE_TEMPLATE("depths from buffers agree with depths from distances", T, float, double)
{
    bit_source bits(4);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const T n = T(0.5), f = T(40), distance = T(bits.uniform(0.5, 40));
        const T want = depth_from_distance(distance, n, f);
        // Rounding the buffer moves the distance d by d^2 / n roundings of a value of at most 1, so the depth by at
        // most 2 f^2 / (n (f - n)) = 162 roundings.
        const double tolerance = 400 * u<T>;
        CHECK(std::abs(double(depth_from_perspective(f * (distance - n) / (distance * (f - n)), n, f) - want)) <=
              tolerance);
        CHECK(std::abs(double(depth_from_reversed_infinite(n / distance, n, f) - want)) <= tolerance);
    }
}
