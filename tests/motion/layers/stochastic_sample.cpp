// Times in strata, the strata of times, and their ends.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/oracle.hpp"
#include "support/rounding.hpp"

#include <gnomon/motion/layers/receiver_footprint.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("the slice of a stratified time is its stratum, bit for bit", T, float, double)
{
    for (int count = 1; count <= 300; ++count)
        for (int stratum = 0; stratum < count; ++stratum)
            for (const T jitter : {T(0), std::numeric_limits<T>::epsilon(), T(0.5), T(1) - T(0x1p-24), T(1)})
                REQUIRE(slice_of(stratified_time(T(stratum), T(count), jitter), T(count)) == T(stratum));
    CHECK(rc::check("up to 65536 strata", [] {
        const int count = *rc::gen::inRange(1, 65537), stratum = *rc::gen::inRange(0, count);
        const T jitter = T(*rc::gen::inRange(0, (1 << 24) + 1)) * T(0x1p-24);
        const T t = stratified_time(T(stratum), T(count), jitter);
        RC_ASSERT(slice_of(t, T(count)) == T(stratum));
        const high expected = (high(stratum) + high(jitter)) / count;
        RC_ASSERT(abs(high(t) - expected) <= high(0x1p-20) + 4 * high(u<T>) * high(t));
    }));
}

TEST_CASE_TEMPLATE("the stratum of a time has its ends within the stated error, and follows the one before", T, float,
                   double)
{
    CHECK(rc::check("up to 65536 strata", [] {
        const int count = *rc::gen::inRange(1, 65537), stratum = *rc::gen::inRange(0, count);
        const T t = stratified_time(T(stratum), T(count), T(*rc::gen::inRange(0, 1001)) / 1000);
        const shutter_exposure<T> time = footprint_stratum(t, T(count));
        RC_ASSERT(time.begin <= t);
        RC_ASSERT(t <= time.end);
        RC_ASSERT(abs(high(time.begin) - high(stratum) / count) <= high(u<T>));
        RC_ASSERT(abs(high(time.end) - high(stratum + 1) / count) <= high(u<T>));
        if (stratum > 0) RC_ASSERT(footprint_stratum(T(stratum - 0.5) / T(count), T(count)).end == time.begin);
    }));
    const T nan = std::numeric_limits<T>::quiet_NaN();
    CHECK((footprint_stratum(nan, T(4)).begin == 0 && footprint_stratum(nan, T(4)).end == T(0.25)));
    CHECK((footprint_stratum(T(9), T(4)).begin == T(0.75) && footprint_stratum(T(9), T(4)).end == 1));
}

TEST_CASE_TEMPLATE("slices and times are in their ranges for any bits", T, float, double)
{
    CHECK(slice_of(T(1), T(4)) == 3);
    CHECK(slice_of(T(-1), T(4)) == 0);
    CHECK(slice_of(T(7), T(4)) == 3);
    CHECK(slice_of(T(0.5), T(4)) == 2);
    CHECK(slice_of(std::numeric_limits<T>::quiet_NaN(), T(4)) == 0);
    hostile_source<T> hostile(1);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto any = [&] { return i % 2 == 0 ? hostile.special() : hostile.pattern(); };
        const T t = stratified_time(any(), any(), any());
        REQUIRE((t >= 0 && t <= 1));
        const T slice = slice_of(any(), any());
        REQUIRE((slice >= 0 && slice <= T(texel_limit)));
        const T count = T(1 + i % 100), whole = slice_of(any(), count);
        REQUIRE((whole >= 0 && whole < count && whole == std::floor(whole)));
        const stochastic_sample<T> s = stochastic_background(any(), any(), any());
        REQUIRE((s.z == 1 && s.d_x == 0 && s.d_y == 0 && s.d_z == 0 && s.id < 0));
    }
}
