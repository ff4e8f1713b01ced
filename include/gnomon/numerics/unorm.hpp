// Normalised unsigned integers (UNORM) for storage: the code k of b bits stands for k / (2^b - 1), as in Direct3D and
// Vulkan.
#ifndef GNOMON_NUMERICS_UNORM_HPP
#define GNOMON_NUMERICS_UNORM_HPP

#include "../portable/cpp_only.h"

#include <concepts>
#include <cstdint>
#include <type_traits>

namespace gnomon {

template <int bits> inline constexpr std::uint32_t unorm_maximum = (std::uint32_t{1} << bits) - 1;

template <int bits> using unorm_code = std::conditional_t<bits <= 8, std::uint8_t, std::uint16_t>;

/// The code nearest to x (ties up), clamped to [0, 1]; NaN becomes 0. Exact for float: the product is formed in double.
template <int bits, std::floating_point T> constexpr unorm_code<bits> unorm_encode(T x)
{
    static_assert(0 < bits && bits <= 16, "gnomon: unorm_encode takes 1 to 16 bits");
    const double clamped = x > T(0) ? (x < T(1) ? double(x) : 1.0) : 0.0;
    return static_cast<unorm_code<bits>>(clamped * unorm_maximum<bits> + 0.5);
}

/// k / (2^b - 1), rounded once. Codes above the maximum give more than 1.
template <int bits, std::floating_point T = float> constexpr T unorm_decode(std::uint32_t code)
{
    static_assert(0 < bits && bits <= 16, "gnomon: unorm_decode takes 1 to 16 bits");
    return T(code) / T(unorm_maximum<bits>);
}

} // namespace gnomon
#endif
