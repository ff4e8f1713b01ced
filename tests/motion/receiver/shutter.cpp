// Shutters: shares of light from 0 to 1, their stated densities, piecewise weights against a sum over many times.
#include "receiver_cases.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> constexpr T nan_of = std::numeric_limits<T>::quiet_NaN();
template <class T> std::array<T, 8> values(const shutter_weights<T>& w)
{
    return {w.w0, w.w1, w.w2, w.w3, w.w4, w.w5, w.w6, w.w7};
}

} // namespace

TEST_CASE_TEMPLATE("shutters: shares go from 0 to 1, monotonically, with the stated density", T, float, double)
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

TEST_CASE_TEMPLATE("exposures: between both times; one of no length shows a single time", T, float, double)
{
    constexpr T least = T(0x1p-20);
    const auto times = [](T a, T b) {
        const shutter_exposure<T> x = shutter_exposure_make(a, b);
        return std::array<T, 2>{x.begin, x.end};
    };
    CHECK(times(T(0.25), T(0.75)) == std::array<T, 2>{T(0.25), T(0.75)});
    CHECK(times(T(0.75), T(0.25)) == std::array<T, 2>{T(0.25), T(0.75)});
    CHECK(times(T(0), T(0)) == std::array<T, 2>{T(0), least});
    CHECK(times(T(1), T(1)) == std::array<T, 2>{1 - least, T(1)});
    CHECK(times(T(2), T(2))[0] == 2);
    CHECK(std::isnan(times(nan_of<T>, T(1))[0]));
    CHECK(std::isnan(times(T(0), nan_of<T>)[1]));

    // A list of ranges that touch or leave gaps, tested in the middle of one of its parts.
    bit_source bits(24);
    std::int64_t shadowed = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const T t = T(bits.uniform(0, 1)), z = T(bits.uniform(-1, 1)), id = T(bits.below(3));
        bool clear = true;
        T there = 0;
        for (const auto& r : list) {
            const auto beside = [&](wide time) { return std::abs(time - wide(t)) > 4 * wide(least); };
            const wide crossing =
                wide(r.t0) + (wide(z) - wide(r.z0)) / (wide(r.z1) - wide(r.z0)) * (wide(r.t1) - wide(r.t0));
            clear = clear && beside(wide(r.t0)) && beside(wide(r.t1)) && beside(crossing);
            there = std::max(there, range_intensity(r, t, z, id, T(0)));
        }
        if (!clear) continue;
        shadowed += there > 0;
        for (const response kind : responses) {
            const auto shutter = any_shutter(kind, t, t, bits);
            static_receiver<T> receiver = static_receiver_begin(z, id, t, t);
            const receiver_path<T> path{{T(0), T(1), z, z, id}, T(0.5), T(0.5), T(1), T(0.5), T(0.5), T(1)};
            moving_receiver<T> moving = moving_receiver_begin(path, t, t);
            for (const auto& r : list) receiver = shutter.add(receiver, r), moving = shutter.add(moving, r);
            REQUIRE(static_receiver_end(receiver) == there);
            REQUIRE(moving_receiver_end(moving) == there);
        }
    }
    CHECK(shadowed > effort(20'000) / 20);
}

TEST_CASE_TEMPLATE("exposures: swapped ends are the same exposure, and any input gives an intensity", T, float, double)
{
    hostile_source<T> hostile(25);
    bit_source bits(26);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1)), z = T(bits.uniform(-1, 1));
        const auto shutter =
            any_shutter(responses[std::size_t(i) % responses.size()], std::min(a, b), std::max(a, b), bits);
        const auto intensity = [&](T begin, T end) {
            static_receiver<T> state = static_receiver_begin(z, T(9), begin, end);
            for (const auto& r : list) state = shutter.add(state, r);
            return static_receiver_end(state);
        };
        REQUIRE(intensity(a, b) == intensity(b, a));
        const T odd = intensity(hostile.pattern(), bits.chance(0.5) ? hostile.special() : a);
        REQUIRE((odd >= 0 && odd <= 1));
    }
}

TEST_CASE_TEMPLATE("piecewise shutters: any weights sum to 1, and without weights it is a box", T, float, double)
{
    hostile_source<T> hostile(21);
    bit_source bits(22);
    const T inf = std::numeric_limits<T>::infinity(), nan = nan_of<T>;
    for (const T nothing : {T(0), T(-1), nan, -inf}) {
        const shutter_weights<T> none{nothing, nothing, nothing, nothing, nothing, nothing, nothing, nothing};
        for (const T w : values(shutter_weights_make(none))) CHECK(w == T(0.125));
    }
    const auto one = values(shutter_weights_make(shutter_weights<T>{-1, nan, 0, 3, -inf, 0, 1, nan}));
    CHECK(one == std::array<T, 8>{0, 0, 0, T(0.75), 0, 0, T(0.25), 0});
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto any = [&] { return bits.chance(0.5) ? hostile.special() : hostile.pattern(); };
        wide sum = 0;
        for (const T w :
             values(shutter_weights_make(shutter_weights<T>{any(), any(), any(), any(), any(), any(), any(), any()}))) {
            REQUIRE((w >= 0 && w <= 1));
            sum += wide(w);
        }
        // Seven roundings of the sum and one of each quotient; a sum of denormals is exact, its quotients are normal.
        REQUIRE(std::abs(sum - 1) <= 8 * rounding<T>);
    }
}

TEST_CASE_TEMPLATE("piecewise shutters: the integral of their density, and a box if weights are equal", T, float,
                   double)
{
    constexpr int times = 1 << 14; // parts of the exposure, none of which two eighths share
    bit_source bits(23);
    for (std::int64_t i = 0; i < effort(100); ++i) {
        const T a = T(bits.uniform(0, 0.5)), b = T(bits.uniform(0.5, 1));
        const auto s = any_shutter(response::piecewise, a, b, bits);
        CHECK(shutter_piecewise(a, a, b, s.weights) == 0);
        CHECK(shutter_piecewise(b, a, b, s.weights) == 1);
        CHECK(shutter_piecewise(nan_of<T>, a, b, s.weights) == 0);
        wide sum = 0;
        for (int k = 0; k < times; ++k) {
            const wide x = wide(k) / times, next = wide(k + 1) / times;
            sum += s.density(x + 0.5L / times) / times;
            const T t = T(wide(a) + next * (wide(b) - wide(a)));
            // Rounding t moves it by 2^-p: by as much over the duration in shares.
            const wide error = (16 + s.largest() / (wide(b) - wide(a))) * rounding<T>;
            REQUIRE(std::abs(wide(shutter_piecewise(t, a, b, s.weights)) - sum) <= error + 8 * rounding<T>);
            const shutter_weights<T> equal{T(.125), T(.125), T(.125), T(.125), T(.125), T(.125), T(.125), T(.125)};
            REQUIRE(std::abs(wide(shutter_piecewise(t, a, b, equal)) - wide(shutter_box(t, a, b))) <= 16 * rounding<T>);
        }
    }
}

TEST_CASE("the share of light that changes linearly is its integral, rises, and ends at 1")
{
    CHECK(rc::check("shutter_line within 12 2^-p", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto weight = [&] { return float(bits.chance(0.2) ? 0 : std::exp2(bits.uniform(-40, 40))); };
        const float w0 = weight(), w1 = weight(), t = float(bits.uniform(0, 1)),
                    later = float(bits.uniform(double(t), 1));
        const bool dark = w0 + w1 == 0;
        const wide a = dark ? 1 : wide(w0), b = dark ? 1 : wide(w1), x = wide(t);
        const wide expected = (2 * a * x + (b - a) * x * x) / (a + b);
        RC_ASSERT(std::abs(wide(shutter_line(t, 0.f, 1.f, w0, w1)) - expected) <= 12 * rounding<float>);
        RC_ASSERT(shutter_line(t, 0.f, 1.f, w0, w1) <=
                  shutter_line(later, 0.f, 1.f, w0, w1) + 4 * float(rounding<float>));
        RC_ASSERT(shutter_line(1.f, 0.f, 1.f, w0, w1) == 1);
        RC_ASSERT(shutter_line(t, 0.f, 1.f, -1.f, 0.f) == t);
    }));
}
