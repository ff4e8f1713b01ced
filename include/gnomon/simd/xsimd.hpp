// Packs of xsimd as a Real, from version 8.1 on.
//
//     using real = gnomon::pack<xsimd::batch<float>>;
//
// That is xsimd::batch<float> itself, but on NEON, where its quotients and roots are not correctly rounded. Results have
// the bits of the scalar. What versions of xsimd do otherwise, or not in one instruction, is done here: minima and maxima,
// fused multiply-adds, powers of two; quotients and roots of floats on NEON.
#ifndef GNOMON_SIMD_XSIMD_HPP
#define GNOMON_SIMD_XSIMD_HPP

#include "pack.hpp"

#include <xsimd/xsimd.hpp>

#include <array>
#include <cstddef>

#if defined(XSIMD_NO_SUPPORTED_ARCHITECTURE)
#error "gnomon: this version of xsimd has no packs for this target"
#endif

namespace gnomon {

// minps and maxps return their second operand if one is NaN, as the dialect requires.
#define GNOMON_REGISTER(type, prefix, lanes)                                              \
    GNOMON_INLINE type register_min(type a, type b) { return prefix##min_##lanes(a, b); } \
    GNOMON_INLINE type register_max(type a, type b) { return prefix##max_##lanes(a, b); }
#define GNOMON_REGISTER_FMA(type, prefix, lanes) \
    GNOMON_INLINE type register_fma(type a, type b, type c) { return prefix##fmadd_##lanes(a, b, c); }
#if XSIMD_WITH_SSE2
GNOMON_REGISTER(__m128, _mm_, ps)
GNOMON_REGISTER(__m128d, _mm_, pd)
#endif
#if XSIMD_WITH_AVX
GNOMON_REGISTER(__m256, _mm256_, ps)
GNOMON_REGISTER(__m256d, _mm256_, pd)
#endif
#if XSIMD_WITH_AVX512F
GNOMON_REGISTER(__m512, _mm512_, ps)
GNOMON_REGISTER(__m512d, _mm512_, pd)
GNOMON_REGISTER_FMA(__m512, _mm512_, ps)
GNOMON_REGISTER_FMA(__m512d, _mm512_, pd)
#endif
#if XSIMD_WITH_SSE2 && defined(__FMA__)
GNOMON_REGISTER_FMA(__m128, _mm_, ps)
GNOMON_REGISTER_FMA(__m128d, _mm_, pd)
GNOMON_REGISTER_FMA(__m256, _mm256_, ps)
GNOMON_REGISTER_FMA(__m256d, _mm256_, pd)
#endif
#undef GNOMON_REGISTER
#undef GNOMON_REGISTER_FMA
#if XSIMD_WITH_NEON && defined(__ARM_FEATURE_FMA)
GNOMON_INLINE float32x4_t register_fma(float32x4_t a, float32x4_t b, float32x4_t c) { return vfmaq_f32(c, a, b); }
#if XSIMD_WITH_NEON64
GNOMON_INLINE float64x2_t register_fma(float64x2_t a, float64x2_t b, float64x2_t c) { return vfmaq_f64(c, a, b); }
#endif
#endif

template <class T, class A> struct pack_operations<xsimd::batch<T, A>> {
    using pack = xsimd::batch<T, A>;
    using registers = typename pack::register_type;

    // Of floats on NEON, xsimd finds quotients and roots by Newton's method.
    static constexpr bool native = !(std::is_base_of_v<xsimd::neon, A> && std::is_same_v<T, float>);
#if defined(XSIMD_WITH_SVE) && XSIMD_WITH_SVE
    static constexpr bool fused = is_fused<T>;
#else
    static constexpr bool fused = is_fused<T> && requires(registers r) { register_fma(r, r, r); };
#endif

    // Which operand xsimd returns beside a NaN depends on its version.
    static GNOMON_INLINE pack min GNOMON_NO_MACRO(pack a, pack b)
    {
        if constexpr (requires(registers r) { register_min(r, r); }) return register_min(registers(a), registers(b));
        else return (xsimd::select)(a < b, a, b);
    }
    static GNOMON_INLINE pack max GNOMON_NO_MACRO(pack a, pack b)
    {
        if constexpr (requires(registers r) { register_max(r, r); }) return register_max(registers(a), registers(b));
        else return (xsimd::select)(b < a, a, b);
    }

    // xsimd's own fma is a multiplication and an addition for SSE, for AVX2 without fma3 and, before 11.0, for AVX-512.
    static GNOMON_INLINE pack fma(pack a, pack b, pack c) requires fused
    {
        if constexpr (requires(registers r) { register_fma(r, r, r); })
            return register_fma(registers(a), registers(b), registers(c));
        else return xsimd::fma(a, b, c);
    }

    // Without the low half of a significand of 24 bits; a double is split by arithmetic, as a scalar.
    static GNOMON_INLINE pack high_part(pack a) requires std::is_same_v<T, float>
    {
        return a & pack(gnomon_bit_cast<float>(std::uint32_t{0xFFFFF000}));
    }

    // As for a scalar: the sum leaves n in the low bits, and the shift moves n into the exponent.
    static GNOMON_INLINE pack power_of_two(pack n)
    {
        using integer = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        using integers = xsimd::batch<integer, A>;
        constexpr int fraction_bits = std::numeric_limits<T>::digits - 1;
        const pack shifted = n + pack(T(integer{3} << (fraction_bits - 1)));
        const integers bias(integer{std::numeric_limits<T>::max_exponent - 1} << fraction_bits);
#if XSIMD_VERSION_MAJOR < 9
        return xsimd::bitwise_cast<pack>((xsimd::bitwise_cast<integers>(shifted) << fraction_bits) + bias);
#else
        return xsimd::bitwise_cast<T>((xsimd::bitwise_cast<integer>(shifted) << fraction_bits) + bias);
#endif
    }

    static constexpr std::size_t size = pack::size;
    static GNOMON_INLINE pack load(const T* from) { return pack::load_unaligned(from); }
    static GNOMON_INLINE void store(pack a, T* to) { a.store_unaligned(to); }
    static GNOMON_INLINE pack select GNOMON_NO_MACRO(mask_t<pack> mask, pack a, pack b)
    {
        return (xsimd::select)(mask, a, b);
    }
#if XSIMD_WITH_NEON64
    static GNOMON_INLINE pack divide(pack a, pack b) { return vdivq_f32(a, b); }
    static GNOMON_INLINE pack sqrt(pack a) { return vsqrtq_f32(a); }
#elif XSIMD_WITH_NEON // of 32 bits: no instruction for either
    static GNOMON_INLINE pack divide(pack a, pack b)
    {
        std::array<T, size> x, y;
        store(a, x.data()), store(b, y.data());
        for (std::size_t i = 0; i < size; ++i) x[i] = x[i] / y[i];
        return load(x.data());
    }
    static GNOMON_INLINE pack sqrt(pack a)
    {
        std::array<T, size> x;
        store(a, x.data());
        for (T& number : x) number = gnomon_sqrt(number);
        return load(x.data());
    }
#endif
};

} // namespace gnomon
#endif
