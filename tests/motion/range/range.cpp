// Depth-time ranges against extended precision: depths, clips and crossings within the stated errors, and shadows
// against the definition at many times.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/motion/range/range.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using gnomon::test::bit_source;
using gnomon::test::u;

namespace {

using wide = long double;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

template <class T> T any_time(bit_source& bits)
{
    return T(bits.chance(0.2) ? double(bits.below(5)) / 4 : bits.uniform(0, 1));
}

/// Ordinary ranges, short ones, ones of no duration, level ones.
template <class T> depth_time_range<T> any_range(bit_source& bits)
{
    const T t = any_time<T>(bits), z = T(bits.uniform(-1, 1));
    const T other = bits.chance(0.1) ? t : bits.chance(0.1) ? T(double(t) * 0.9999) : any_time<T>(bits);
    return range_between(t, z, other, bits.chance(0.2) ? z : T(bits.uniform(-1, 1)), T(bits.below(3)));
}

template <class T> wide depth(const depth_time_range<T>& r, wide t)
{
    if (r.t0 == r.t1) return t <= wide(r.t0) ? wide(r.z0) : wide(r.z1);
    const wide passed = std::clamp((t - wide(r.t0)) / (wide(r.t1) - wide(r.t0)), 0.0L, 1.0L);
    return wide(r.z0) + passed * (wide(r.z1) - wide(r.z0));
}

template <class T> void for_each_range(std::int64_t count, auto f)
{
    bit_source bits(7);
    for (std::int64_t i = 0; i < test::effort(count); ++i) f(any_range<T>(bits), bits);
}

} // namespace

TEST_CASE_TEMPLATE("range_depth: within the stated error, exact at the ends", T, float, double)
{
    for_each_range<T>(100'000, [](const depth_time_range<T>& r, bit_source& bits) {
        const T t = any_time<T>(bits);
        const double error = std::abs(double(wide(range_depth(r, t)) - depth(r, wide(t))));
        REQUIRE(error <= 5 * u<T> * (std::abs(double(r.z0)) + std::abs(double(r.z1))));
        if (r.z0 == r.z1) REQUIRE(range_depth(r, t) == r.z0);
        REQUIRE(range_depth(r, r.t0) == r.z0);
        if (r.t0 < r.t1) REQUIRE(range_depth(r, r.t1) == r.z1);
    });
}

TEST_CASE_TEMPLATE("range_between accepts its points in either order", T, float, double)
{
    for_each_range<T>(10'000, [](const depth_time_range<T>& r, bit_source&) {
        if (r.t0 == r.t1) return;
        const auto swapped = range_between(r.t1, r.z1, r.t0, r.z0, r.id);
        REQUIRE(swapped.t0 == r.t0);
        REQUIRE(swapped.t1 == r.t1);
        REQUIRE(swapped.z0 == r.z0);
        REQUIRE(swapped.z1 == r.z1);
    });
}

TEST_CASE_TEMPLATE("range_clip: the given times, the same depths; two parts last as long as the whole", T, float,
                   double)
{
    for_each_range<T>(50'000, [](const depth_time_range<T>& r, bit_source& bits) {
        const T a = any_time<T>(bits), b = any_time<T>(bits), begin = std::min(a, b), end = std::max(a, b);
        const auto c = range_clip(r, begin, end);
        const T expected = std::max(T(0), std::min(end, r.t1) - std::max(begin, r.t0));
        REQUIRE(range_duration(c) == expected);
        if (expected > 0) {
            REQUIRE(c.z0 == range_depth(r, c.t0));
            REQUIRE(c.z1 == range_depth(r, c.t1));
        }
        const auto before = range_clip(r, T(0), a), after = range_clip(r, a, T(1));
        const double parts = double(range_duration(before)) + double(range_duration(after));
        REQUIRE(std::abs(parts - double(range_duration(r))) <= 2 * u<T>);
    });
}

TEST_CASE_TEMPLATE("range_crossing: of clipped ranges, within the stated error, and an order on either side", T, float,
                   double)
{
    for_each_range<T>(100'000, [](const depth_time_range<T>& a, bit_source& bits) {
        const auto b = any_range<T>(bits);
        const T begin = std::max(a.t0, b.t0), end = std::min(a.t1, b.t1);
        if (!(begin < end)) return;
        const T t = range_crossing(range_clip_to(a, b), range_clip_to(b, a));
        REQUIRE(t >= begin);
        REQUIRE(t <= end + T(u<T>));
        const wide d0 = depth(a, wide(begin)) - depth(b, wide(begin)), d1 = depth(a, wide(end)) - depth(b, wide(end));
        const double change = std::abs(double(d0 - d1));
        const double largest =
            std::max({std::abs(double(a.z0)), std::abs(double(a.z1)), std::abs(double(b.z0)), std::abs(double(b.z1))});
        if (d0 * d1 < 0) {
            const wide exact = wide(begin) + d0 / (d0 - d1) * (wide(end) - wide(begin));
            REQUIRE(std::abs(double(wide(t) - exact)) <= (80 * largest / change + 4) * u<T>);
        } else if (std::abs(double(d0)) > 1e-3 && std::abs(double(d1)) > 1e-3) {
            REQUIRE((t == begin || t == end));
        }
    });
}

TEST_CASE_TEMPLATE("range_occluding_part: the times at which a range shadows a static or moving receiver", T, float,
                   double)
{
    for_each_range<T>(20'000, [](const depth_time_range<T>& r, bit_source& bits) {
        depth_time_range<T> receiver = any_range<T>(bits);
        if (bits.chance(0.3)) receiver = {T(0), T(1), receiver.z0, receiver.z0, T(9)};
        if (bits.chance(0.1)) receiver.z0 = r.z0;
        const T a = any_time<T>(bits), b = any_time<T>(bits), begin = std::min(a, b), end = std::max(a, b);
        const auto front = range_occluding_part(r, receiver, begin, end);
        const double largest = std::max({std::abs(double(r.z0)), std::abs(double(r.z1)), std::abs(double(receiver.z0)),
                                         std::abs(double(receiver.z1))});
        if (front.t0 < front.t1)
            REQUIRE((begin <= front.t0 && r.t0 <= front.t0 && front.t1 <= end && front.t1 <= r.t1));
        // Between these two times both are single lines.
        const wide from = wide(std::max({begin, r.t0, receiver.t0})), to = wide(std::min({end, r.t1, receiver.t1}));
        if (!(from < to) || wide(begin) < wide(receiver.t0) || wide(end) > wide(receiver.t1)) return;
        const auto ahead = [&](wide t) { return depth(receiver, t) - depth(r, t); };
        // Rounding decides where both are this close, and this close to their crossing.
        const wide slack = wide(26 * largest * u<T>), speed = std::abs(ahead(to) - ahead(from)) / (to - from);
        for (int i = 0; i <= 32; ++i) {
            const T t = T(i) / T(32);
            if (wide(t) < from || wide(t) > to || std::abs(ahead(wide(t))) <= slack + speed * wide(8 * u<T>)) continue;
            CAPTURE(double(t));
            REQUIRE((front.t0 <= t && t <= front.t1) == (ahead(wide(t)) > 0));
            REQUIRE(double(range_intensity(r, t, range_depth(receiver, t), T(9), T(0))) == double(ahead(wide(t)) > 0));
        }
    });
}

TEST_CASE_TEMPLATE("range_intensity: own surface, ends, bias and NaN", T, float, double)
{
    const T nan = T(nan_value);
    const depth_time_range<T> r{T(0.25), T(0.75), T(-0.5), T(0.5), T(3)};
    CHECK(range_intensity(r, T(0.5), T(0.25), T(1), T(0)) == 1);
    CHECK(range_intensity(r, T(0.5), T(0.25), T(3), T(0)) == 0);
    CHECK(range_intensity(r, T(0.5), T(0.25), T(1), T(0.25)) == 0);
    CHECK(range_intensity(r, T(0.5), T(0), T(1), T(0)) == 0);
    CHECK(range_intensity(r, T(0.25), T(1), T(1), T(0)) == 1);
    CHECK(range_intensity(r, T(0.75), T(1), T(1), T(0)) == 1);
    CHECK(range_intensity(r, T(0.2), T(1), T(1), T(0)) == 0);
    CHECK(range_intensity(r, T(0.8), T(1), T(1), T(0)) == 0);
    CHECK(range_intensity(r, nan, T(1), T(1), T(0)) == 0);
    CHECK(range_intensity(r, T(0.5), nan, T(1), T(0)) == 0);
    CHECK(range_intensity(r, T(0.5), T(1), T(1), nan) == 0);
    for (const auto member : {&depth_time_range<T>::t0, &depth_time_range<T>::t1, &depth_time_range<T>::z0}) {
        depth_time_range<T> broken = r;
        broken.*member = nan;
        CHECK(range_intensity(broken, T(0.5), T(1), T(1), T(0)) == 0);
        const depth_time_range<T> level{T(0), T(1), T(1), T(1), T(1)};
        CHECK(range_duration(range_occluding_part(broken, level, T(0), T(1))) == 0);
    }
    const depth_time_range<T> near{T(0), T(1), T(-1), T(-1), T(1)};
    CHECK(range_duration(range_occluding_part(near, r, T(0), T(1))) == 1);
    for (const auto member : {&depth_time_range<T>::z0, &depth_time_range<T>::z1}) {
        depth_time_range<T> broken = r;
        broken.*member = nan;
        CHECK(range_duration(range_occluding_part(near, broken, T(0), T(1))) == 0);
    }
    CHECK(range_duration(range_between(T(0.5), T(0), T(0.5), T(0), T(0))) == 0);
    CHECK(range_duration(depth_time_range<T>{T(1), T(0), T(0), T(0), T(0)}) == 0);
}

// A plane that moves towards the light never shadows itself, at any speed: its own range is ignored by id, and the
// range of a neighbour, which reaches the same depth at the same time, is not in front.
TEST_CASE_TEMPLATE("a surface that moves along z does not shadow itself or its neighbour in the plane", T, float,
                   double)
{
    bit_source bits(3);
    for (int i = 0; i < 1000; ++i) {
        const T z0 = T(bits.uniform(-1, 1)), z1 = T(bits.uniform(-1, 1));
        const depth_time_range<T> own{T(0), T(1), z0, z1, T(1)}, neighbour{T(0), T(1), z0, z1, T(2)};
        const T t = any_time<T>(bits), z = range_depth(own, t);
        CHECK(range_intensity(own, t, z, T(1), T(0)) == 0);
        CHECK(range_intensity(neighbour, t, z, T(1), T(0)) == 0);
    }
}
