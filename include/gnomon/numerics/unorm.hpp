// Normalised unsigned integers (UNORM) for storage, as in Direct3D and Vulkan: code k of b bits means k / (2^b - 1).
#ifndef GNOMON_NUMERICS_UNORM_HPP
#define GNOMON_NUMERICS_UNORM_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <concepts>
#include <cstdint>
#include <type_traits>

GNOMON_NAMESPACE_BEGIN

/// The largest code of that many bits.
template <int bits> inline constexpr std::uint32_t unorm_maximum = (std::uint32_t{1} << bits) - 1;

/// The smallest unsigned integer that holds a code of that many bits.
template <int bits> using unorm_code = std::conditional_t<bits <= 8, std::uint8_t, std::uint16_t>;

/// The code nearest to x clamped to [0, 1], ties up. Exact for float, since the product is formed in double.
/// NaN: 0.
template <int bits, std::floating_point T> constexpr unorm_code<bits> unorm_encode(T x)
{
    static_assert(0 < bits && bits <= 16, "gnomon: unorm_encode needs 1 to 16 bits");
    const double clamped = x > T(0) ? (x < T(1) ? double(x) : 1.0) : 0.0;
    return static_cast<unorm_code<bits>>(clamped * unorm_maximum<bits> + 0.5);
}

/// code / (2^bits - 1), rounded once; more than 1 for codes above the maximum.
template <int bits, std::floating_point T = float> constexpr T unorm_decode(std::uint32_t code)
{
    static_assert(0 < bits && bits <= 16, "gnomon: unorm_decode needs 1 to 16 bits");
    return T(code) / T(unorm_maximum<bits>);
}

GNOMON_NAMESPACE_END
#endif
