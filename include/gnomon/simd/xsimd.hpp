// Packs of xsimd as a Real: single instructions for operations that the generic prelude does not map to one. Optional:
// kernels accept xsimd::batch without this header, too, with the same bits, only slower.
#ifndef GNOMON_SIMD_XSIMD_HPP
#define GNOMON_SIMD_XSIMD_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <xsimd/xsimd.hpp>

namespace gnomon {

template <class T, class A> struct pack_operations<xsimd::batch<T, A>> {
    using pack = xsimd::batch<T, A>;

#if defined(__SSE2__)
    static constexpr bool is_x86 = std::is_base_of_v<xsimd::generic, A>;
#else
    static constexpr bool is_x86 = false;
#endif
#if defined(__FMA__)
    static constexpr bool fused = is_x86 && std::is_floating_point_v<T>;
#else
    static constexpr bool fused = false;
#endif

    // minps and maxps return their second operand if one is NaN, as the dialect requires.
    static GNOMON_INLINE pack min GNOMON_NO_MACRO(pack a, pack b)
    {
        if constexpr (is_x86) return (xsimd::min)(a, b);
        else return (xsimd::select)(a < b, a, b);
    }
    static GNOMON_INLINE pack max GNOMON_NO_MACRO(pack a, pack b)
    {
        if constexpr (is_x86) return (xsimd::max)(a, b);
        else return (xsimd::select)(b < a, a, b);
    }

    // xsimd's own fma is a multiplication and an addition for SSE, for AVX2 without fma3 and, before 11.0, for AVX-512.
    static GNOMON_INLINE pack fma(pack a, pack b, pack c)
    {
#if defined(__FMA__)
        if constexpr (std::is_same_v<T, float> && pack::size == 4) return pack(_mm_fmadd_ps(a, b, c));
        else if constexpr (std::is_same_v<T, float> && pack::size == 8) return pack(_mm256_fmadd_ps(a, b, c));
        else if constexpr (std::is_same_v<T, double> && pack::size == 2) return pack(_mm_fmadd_pd(a, b, c));
        else if constexpr (std::is_same_v<T, double> && pack::size == 4) return pack(_mm256_fmadd_pd(a, b, c));
#if defined(__AVX512F__)
        else if constexpr (std::is_same_v<T, float>) return pack(_mm512_fmadd_ps(a, b, c));
        else if constexpr (std::is_same_v<T, double>) return pack(_mm512_fmadd_pd(a, b, c));
#endif
#else
        return a * b + c;
#endif
    }

    // Without the low half of a significand of 24 bits; a double is split by arithmetic, as a scalar.
    static GNOMON_INLINE pack high_part(pack a) requires std::is_same_v<T, float>
    {
        return a & pack(gnomon_bit_cast<float>(std::uint32_t{0xFFFFF000}));
    }

    // As for a scalar: the sum leaves n in the low bits, and the shift moves n into the exponent.
    static GNOMON_INLINE pack power_of_two(pack n)
    {
        using integer = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
        constexpr int fraction_bits = std::numeric_limits<T>::digits - 1;
        const pack shifted = n + pack(T(integer{3} << (fraction_bits - 1)));
        const integer bias = integer{std::numeric_limits<T>::max_exponent - 1} << fraction_bits;
#if XSIMD_VERSION_MAJOR < 9
        using integers = xsimd::batch<integer, A>;
        return xsimd::bitwise_cast<pack>((xsimd::bitwise_cast<integers>(shifted) << fraction_bits) + integers(bias));
#else
        return xsimd::bitwise_cast<T>((xsimd::bitwise_cast<integer>(shifted) << fraction_bits) +
                                      xsimd::batch<integer, A>(bias));
#endif
    }
};

} // namespace gnomon
#endif
