// Shutters: shares of light from 0 to 1, their densities as said, given weights against a sum over many times.
#include "../support/effort.hpp"
#include "receiver_cases.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> constexpr T nan_of = std::numeric_limits<T>::quiet_NaN();
template <class T> std::array<T, 8> values(const shutter_weights<T>& w)
{
    return {w.w0, w.w1, w.w2, w.w3, w.w4, w.w5, w.w6, w.w7};
}

} // namespace

TEST_CASE_TEMPLATE("shutters: from 0 to 1, never back, their density as said", T, float, double)
{
    for (const auto shutter : {shutter_box<T>, shutter_tent<T>}) {
        CHECK(shutter(T(0.25), T(0.25), T(0.75)) == 0);
        CHECK(shutter(T(0.5), T(0.25), T(0.75)) == T(0.5));
        CHECK(shutter(T(0.75), T(0.25), T(0.75)) == 1);
        CHECK(shutter(T(0), T(0.25), T(0.75)) == 0);
        CHECK(shutter(T(1), T(0.25), T(0.75)) == 1);
        CHECK(shutter(nan_of<T>, T(0), T(1)) == 0);
        for (int i = 0; i < 1024; ++i) CHECK(shutter(T(i) / 1024, T(0), T(1)) <= shutter(T(i + 1) / 1024, T(0), T(1)));
    }
    // The tent opens as t: by time t < 1/2 it has let in 2 t^2.
    for (int i = 0; i <= 32; ++i) {
        const T t = T(i) / 64;
        CHECK(shutter_tent(t, T(0), T(1)) == 2 * t * t);
        CHECK(shutter_tent(1 - t, T(0), T(1)) == 1 - 2 * t * t);
    }
}

TEST_CASE_TEMPLATE("given weights: whatever they are they sum to 1, and without any it is a box", T, float, double)
{
    hostile_source<T> hostile(21);
    bit_source bits(22);
    const T inf = std::numeric_limits<T>::infinity(), nan = nan_of<T>;
    for (const T nothing : {T(0), T(-1), nan, -inf}) {
        const shutter_weights<T> none{nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing};
        for (const T w : values(shutter_weights_of(none))) CHECK(w == T(0.125));
    }
    const auto one = values(shutter_weights_of(shutter_weights<T>{-1, nan, 0, 3, -inf, 0, 1, nan}));
    CHECK(one == std::array<T, 8>{0, 0, 0, T(0.75), 0, 0, T(0.25), 0});
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto any = [&] { return bits.chance(0.5) ? hostile.special() : hostile.pattern(); };
        wide sum = 0;
        for (const T w :
             values(shutter_weights_of(shutter_weights<T>{any(), any(), any(), any(), any(), any(), any(), any()}))) {
            REQUIRE((w >= 0 && w <= 1));
            sum += wide(w);
        }
        // Seven roundings of the sum and one of each quotient; a sum of denormals is exact, its quotients are normal.
        REQUIRE(std::abs(sum - 1) <= 8 * rounding<T>);
    }
}

TEST_CASE_TEMPLATE("given weights: the integral of their density, and a box where they are equal", T, float, double)
{
    constexpr int times = 1 << 14; // parts of the exposure, none of which two eighths share
    bit_source bits(23);
    for (std::int64_t i = 0; i < effort(100); ++i) {
        const T a = T(bits.uniform(0, 0.5)), b = T(bits.uniform(0.5, 1));
        const auto s = any_shutter(response::given, a, b, bits);
        CHECK(shutter_given(a, a, b, s.weights) == 0);
        CHECK(shutter_given(b, a, b, s.weights) == 1);
        CHECK(shutter_given(nan_of<T>, a, b, s.weights) == 0);
        wide sum = 0;
        for (int k = 0; k < times; ++k) {
            const wide x = wide(k) / times, next = wide(k + 1) / times;
            sum += s.density(x + 0.5L / times) / times;
            const T t = T(wide(a) + next * (wide(b) - wide(a)));
            // Rounding t moves it by 2^-p: by as much over the duration in shares.
            const wide error = (16 + s.largest() / (wide(b) - wide(a))) * rounding<T>;
            REQUIRE(std::abs(wide(shutter_given(t, a, b, s.weights)) - sum) <= error + 8 * rounding<T>);
            const shutter_weights<T> equal{T(.125), T(.125), T(.125), T(.125), T(.125), T(.125), T(.125), T(.125)};
            REQUIRE(std::abs(wide(shutter_given(t, a, b, equal)) - wide(shutter_box(t, a, b))) <= 16 * rounding<T>);
        }
    }
}
