// Normalised unsigned integers (UNORM) for storage, as in Direct3D and Vulkan: code k of b bits means k / (2^b - 1).
#ifndef GNOMON_NUMERICS_UNORM_HPP
#define GNOMON_NUMERICS_UNORM_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

namespace detail {

inline constexpr std::size_t unorm_block = 8;

#if defined(__GNUC__)
typedef float unorm_numbers __attribute__((vector_size(16)));
typedef double unorm_products __attribute__((vector_size(32)));
typedef std::int32_t unorm_words __attribute__((vector_size(16)));
#endif

/// Encode a block of numbers, each as by unorm_encode.
template <int bits> void unorm_encode_block(const float* numbers, unorm_code<bits>* codes)
{
#if defined(__GNUC__)
    std::int32_t whole[unorm_block];
    for (std::size_t k = 0; k < unorm_block; k += 4) {
        unorm_numbers x;
        std::memcpy(&x, numbers + k, sizeof x);
        x = x > 0.0f ? x : unorm_numbers{};
        x = x < 1.0f ? x : unorm_numbers{} + 1.0f;
        const unorm_products scaled = __builtin_convertvector(x, unorm_products) * double(unorm_maximum<bits>) + 0.5;
        const auto w = __builtin_convertvector(scaled, unorm_words);
        std::memcpy(whole + k, &w, sizeof w);
    }
    for (std::size_t k = 0; k < unorm_block; ++k) codes[k] = static_cast<unorm_code<bits>>(whole[k]);
#else
    for (std::size_t k = 0; k < unorm_block; ++k) codes[k] = unorm_encode<bits>(numbers[k]);
#endif
}

} // namespace detail

/// Encode a row of numbers, each as by unorm_encode.
template <int bits> void unorm_encode_row(const float* numbers, unorm_code<bits>* codes, std::size_t count)
{
    constexpr std::size_t block = detail::unorm_block;
    const std::size_t rest = count % block;
    for (std::size_t i = 0; i + rest < count; i += block) detail::unorm_encode_block<bits>(numbers + i, codes + i);
    if (rest == 0) return;
    float last[block] = {};
    unorm_code<bits> last_codes[block];
    std::memcpy(last, numbers + (count - rest), rest * sizeof(float));
    detail::unorm_encode_block<bits>(last, last_codes);
    std::memcpy(codes + (count - rest), last_codes, rest * sizeof *codes);
}

/// Decode a row of codes, each as by unorm_decode.
template <int bits> void unorm_decode_row(const unorm_code<bits>* codes, float* numbers, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) numbers[i] = unorm_decode<bits>(codes[i]);
}

GNOMON_NAMESPACE_END
#endif
