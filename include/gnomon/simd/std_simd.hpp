// Packs of the standard library as a Real: std::experimental::simd, of float or double, by any ABI.
//
//     using real = gnomon::pack<std::experimental::native_simd<float>>;
//
// Results have the bits of the scalar.
#ifndef GNOMON_SIMD_STD_SIMD_HPP
#define GNOMON_SIMD_STD_SIMD_HPP

#include "pack.hpp"

#include <experimental/simd>

#if !defined(__cpp_lib_experimental_parallel_simd)
#error "gnomon: this standard library has no operators for std::experimental::simd; GCC's has, from version 11 on"
#elif defined(__clang__) && defined(__AVX512F__)
#error "gnomon: std::experimental::simd gives wrong lanes by clang for AVX-512; compile this by GCC, or for AVX2"
#else

namespace gnomon {

template <class T, class Abi> struct pack_operations<std::experimental::simd<T, Abi>> {
    using pack = std::experimental::simd<T, Abi>;

    static constexpr bool native = false,
                          fused = is_fused<T>; // a broadcast from double is not allowed, nor is select there
    static constexpr std::size_t size = pack::size();

    static GNOMON_INLINE pack load(const T* from) { return pack(from, std::experimental::element_aligned); }
    static GNOMON_INLINE void store(const pack& a, T* to) { a.copy_to(to, std::experimental::element_aligned); }
    static GNOMON_INLINE pack divide(pack a, pack b) { return a / b; }
    static GNOMON_INLINE pack sqrt(pack a) { return std::experimental::sqrt(a); }
    static GNOMON_INLINE pack fma(pack a, pack b, pack c) { return std::experimental::fma(a, b, c); }
    static GNOMON_INLINE pack select GNOMON_NO_MACRO(typename pack::mask_type mask, pack a, pack b)
    {
        where(mask, b) = a;
        return b;
    }

    // As for a scalar.
    static GNOMON_INLINE pack high_part(pack a) requires(std::is_same_v<T, float>&& std::is_trivially_copyable_v<pack>)
    {
        using integers = std::experimental::rebind_simd_t<std::uint32_t, pack>;
        return gnomon_bit_cast<pack>(gnomon_bit_cast<integers>(a) & integers(0xFFFFF000u));
    }

    // As for a scalar: the sum leaves n in the low bits, and the shift moves n into the exponent.
    static GNOMON_INLINE pack power_of_two(pack n) requires std::is_trivially_copyable_v<pack>
    {
        using integer = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        using integers = std::experimental::rebind_simd_t<integer, pack>;
        constexpr int fraction_bits = std::numeric_limits<T>::digits - 1;
        const pack shifted = n + pack(T(integer{3} << (fraction_bits - 1)));
        const integers bias(integer{std::numeric_limits<T>::max_exponent - 1} << fraction_bits);
        return gnomon_bit_cast<pack>((gnomon_bit_cast<integers>(shifted) << fraction_bits) + bias);
    }
};

} // namespace gnomon

#endif
#endif
