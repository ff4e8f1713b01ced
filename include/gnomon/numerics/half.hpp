// Half floats (IEEE 754 binary16: 1 sign, 5 exponent, 10 fraction bits) for storage, as bit patterns in std::uint16_t.
// Encoding from float or double rounds once, to nearest, ties to even, also to denormal halves.
#ifndef GNOMON_NUMERICS_HALF_HPP
#define GNOMON_NUMERICS_HALF_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

/// The half nearest to x; infinity for |x| >= 65520.
/// NaN: the quiet NaN of the same sign.
template <std::floating_point T> constexpr std::uint16_t half_encode(T x)
{
    using limits = std::numeric_limits<T>;
    using bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    static_assert(limits::is_iec559 && sizeof(T) == sizeof(bits), "gnomon: half_encode needs float or double");
    constexpr int shift = limits::digits - 11;
    constexpr bits one = 1;
    // A sum with this number rounds to a multiple of 2^-24, the step of denormal halves.
    constexpr T denormal_rounder = T(one << (limits::digits - 1)) * T(0x1p-24);
    // Subtracts the difference between the two exponent biases, limits::max_exponent - 1 and 15.
    constexpr bits rebias = bits(limits::max_exponent - 16) << (limits::digits - 1);

    const bits word = gnomon_bit_cast<bits>(x);
    const bits sign = word >> (8 * sizeof(T) - 1) << 15;
    const bits magnitude = word & (~bits(0) >> 1);
    const T a = gnomon_bit_cast<T>(magnitude);
    bits code = 0;
    if (a >= T(65520)) code = 0x7c00;
    else if (a != a) code = 0x7e00;
    else if (a < T(0x1p-14))
        code = gnomon_bit_cast<bits>(a + denormal_rounder) - gnomon_bit_cast<bits>(denormal_rounder);
    else code = (magnitude - rebias + (one << (shift - 1)) - 1 + (magnitude >> shift & 1)) >> shift;
    return static_cast<std::uint16_t>(sign | code);
}

/// The value of a half, exactly.
/// NaN: stays NaN.
constexpr float half_decode(std::uint16_t code)
{
    const std::uint32_t sign = std::uint32_t(code & 0x8000) << 16;
    const std::uint32_t magnitude = code & 0x7fff;
    const std::uint32_t rebias = magnitude < 0x7c00 ? 112u << 23 : 224u << 23;
    const float a =
        magnitude < 0x0400 ? float(magnitude) * 0x1p-24f : gnomon_bit_cast<float>((magnitude << 13) + rebias);
    return gnomon_bit_cast<float>(gnomon_bit_cast<std::uint32_t>(a) | sign);
}

GNOMON_NAMESPACE_END
#endif
