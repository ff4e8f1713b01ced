// Storage numbers: half floats at every code and at every rounding boundary, UNORM at every code.
#include <gnomon/numerics/half.hpp>
#include <gnomon/numerics/unorm.hpp>

#include <doctest/doctest.h>

#include <cmath>

using namespace gnomon;

TEST_CASE("half: every code survives the round trip, NaN stays NaN")
{
    for (unsigned code = 0; code < 65536; ++code) {
        const float value = half_decode(std::uint16_t(code));
        if ((code & 0x7fff) > 0x7c00) {
            CHECK(std::isnan(value));
            CHECK(std::isnan(half_decode(half_encode(value))));
            CHECK(std::isnan(half_decode(half_encode(double(value)))));
            continue;
        }
        REQUIRE(half_encode(value) == code);
        REQUIRE(half_encode(double(value)) == code);
        const int exponent = int(code >> 10 & 31);
        const int fraction = int(code & 1023);
        if (exponent == 31) continue;
        const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
        REQUIRE(double(value) == (code & 0x8000 ? -magnitude : magnitude));
    }
    CHECK(half_decode(0x7c00) == std::numeric_limits<float>::infinity());
}

// Between two neighbouring halves everything below the midpoint rounds down, everything above rounds up, and the
// midpoint goes to the even code. Encoding is monotonic between these three, so they prove it everywhere.
TEST_CASE_TEMPLATE("half: rounds to nearest even", T, float, double)
{
    const T infinity = std::numeric_limits<T>::infinity();
    for (unsigned code = 0; code < 0x7c00; ++code) {
        const T low = T(half_decode(std::uint16_t(code)));
        const T high = code == 0x7bff ? T(65536) : T(half_decode(std::uint16_t(code + 1)));
        const T middle = (low + high) / 2;
        for (unsigned sign = 0; sign <= 0x8000; sign += 0x8000) {
            const T s = sign ? T(-1) : T(1);
            REQUIRE(half_encode(s * middle) == (sign | (code + (code & 1))));
            REQUIRE(half_encode(s * std::nextafter(middle, T(0))) == (sign | code));
            REQUIRE(half_encode(s * std::nextafter(middle, infinity)) == (sign | (code + 1)));
        }
    }
    CHECK(half_encode(infinity) == 0x7c00);
    CHECK(half_encode(-std::numeric_limits<T>::max()) == 0xfc00);
    CHECK(half_encode(std::numeric_limits<T>::denorm_min()) == 0);
}

template <int bits, class T> void check_unorm()
{
    const T maximum = T(unorm_maximum<bits>);
    for (std::uint32_t code = 0; code <= unorm_maximum<bits>; ++code) {
        const T value = unorm_decode<bits, T>(code);
        REQUIRE(unorm_encode<bits>(value) == code);
        // A quarter of a step away, far more than the rounding of the value, the code is still the nearest.
        REQUIRE(unorm_encode<bits>(value + T(0.25) / maximum) == code);
        REQUIRE(unorm_encode<bits>(value - T(0.25) / maximum) == code);
        if (code < unorm_maximum<bits>) REQUIRE(unorm_encode<bits>(value + T(0.75) / maximum) == code + 1);
    }
    const T infinity = std::numeric_limits<T>::infinity();
    CHECK(unorm_encode<bits>(std::numeric_limits<T>::quiet_NaN()) == 0);
    CHECK(unorm_encode<bits>(-infinity) == 0);
    CHECK(unorm_encode<bits>(infinity) == unorm_maximum<bits>);
}

TEST_CASE_TEMPLATE("unorm: every code, both neighbours, and values outside, which are clamped", T, float, double)
{
    check_unorm<1, T>();
    check_unorm<8, T>();
    check_unorm<10, T>();
    check_unorm<16, T>();
}
