// Gnomon 0.1.0, transmittance_weights.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_TRANSMITTANCE_WEIGHTS_CUH
#define GNOMON_TRANSMITTANCE_WEIGHTS_CUH

// Begins a function whose operations clang must not fuse with others. Versions that fuse nevertheless, under
// -ffp-contract=fast, spare products that are read twice, but for PowerPC.
#if defined(__clang__)
#define GNOMON_UNFUSED _Pragma("clang fp contract(off)")
#else
#define GNOMON_UNFUSED
#endif

// True where products may be fused with sums.
#if defined(__FMA__) || defined(__CUDA_ARCH__) || defined(__aarch64__) || defined(__powerpc64__) || \
    defined(__s390x__) || (defined(__ARM_FEATURE_FMA) && __ARM_FP & 8) ||                           \
    (defined(__riscv_flen) && __riscv_flen >= 64) || (defined(__FP_FAST_FMA) && defined(__FP_FAST_FMAF))
#define GNOMON_HAS_FMA true
#else
#define GNOMON_HAS_FMA false
#endif

// True where std::fma is an instruction, whose result with -0 is left alone.
#if defined(__clang__) && defined(__powerpc64__)
#define GNOMON_SCALAR_FMA false
#else
#define GNOMON_SCALAR_FMA GNOMON_HAS_FMA
#endif

// With plain inline, compilers leave calls in pack kernels.
#if defined(__CUDACC__)
#define GNOMON_INLINE __host__ __device__ __forceinline__
#elif defined(_MSC_VER)
#define GNOMON_INLINE __forceinline
#else
#define GNOMON_INLINE __attribute__((always_inline)) inline
#endif
// Between a name and its bracket: a macro of that name, of whatever header, is not meant.
#define GNOMON_NO_MACRO

// Warnings of compilers that a user may have turned on, and that the dialect cannot avoid: comparisons of a Real with 0 or
// with itself, types of variables that are deduced, and for GCC the length of an array that is a template's argument.
#if defined(__clang__) && !defined(__CUDACC__)
#define GNOMON_WARNINGS_OFF                                                                \
    _Pragma("clang diagnostic push") _Pragma("clang diagnostic ignored \"-Wfloat-equal\"") \
        _Pragma("clang diagnostic ignored \"-Wctad-maybe-unsupported\"")
#define GNOMON_WARNINGS_ON _Pragma("clang diagnostic pop")
#elif defined(__GNUC__) && !defined(__CUDACC__)
#define GNOMON_WARNINGS_OFF                                                            \
    _Pragma("GCC diagnostic push") _Pragma("GCC diagnostic ignored \"-Wfloat-equal\"") \
        _Pragma("GCC diagnostic ignored \"-Wsign-conversion\"")
#define GNOMON_WARNINGS_ON _Pragma("GCC diagnostic pop")
#else
#define GNOMON_WARNINGS_OFF
#define GNOMON_WARNINGS_ON
#endif

// the language --------------------------------------------------------------------------------------------------------
// C++20, also CUDA: kernels are templates over Real, which is float, double or any pack of them.
#if !defined(__cplusplus) || defined(__METAL_VERSION__)
#error "gnomon: transmittance_weights.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: transmittance_weights.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: transmittance_weights.cuh is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE 100 // major, minor and patch, two digits each

#ifndef GNOMON_PORTABLE_CPP_H
#define GNOMON_PORTABLE_CPP_H

#if !defined(__cpp_concepts)
#error "gnomon: C++20 needed (-std=c++20)"
#elif defined(Real)
#error "gnomon: a macro named Real is in the way; include this before it, or undefine it"
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST) ||        \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || (defined(__CUDA_PREC_DIV) && !__CUDA_PREC_DIV) || \
    (defined(__CUDA_PREC_SQRT) && !__CUDA_PREC_SQRT) || (defined(__clang__) && __FLT_EVAL_METHOD__ == -1)
#error "gnomon: fast mathematics voids exact products, rounding and NaN: compile without -ffast-math or parts of it"
#elif (defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ < 0 || __FLT_EVAL_METHOD__ % 16 != 0)) || \
    (defined(_M_IX86_FP) && _M_IX86_FP < 2)
#error "gnomon: x87 rounds twice: compile with -msse2 -mfpmath=sse, or /arch:SSE2"
#elif defined(__clang__) && __clang_major__ < 15
// These versions have no macro for -funsafe-math-optimizations and its parts. Where they know the first of these pragmas,
// the first is an error there; elsewhere the last keeps the operations of all that follows.
#if defined(__x86_64__) || defined(__i386__) || defined(__powerpc__) || defined(__s390x__)
#pragma float_control(except, on, push) // gnomon: compile without -ffast-math or parts of it
#pragma float_control(pop)
#else
#pragma clang fp reassociate(off)
#endif
#elif defined(_MSC_VER) && !defined(__clang__)
#pragma fp_contract(off)
#elif defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
// #pragma GCC optimize changes no macro, but the value of this.
static_assert(__builtin_isunordered(__builtin_nanf(""), 1.0f),
              "gnomon: fast mathematics voids NaN: compile without -ffast-math or parts of it");
#endif

static_assert(0.1 < double(0.1f), "gnomon: compile without -fsingle-precision-constant");

#if defined(__CUDACC_RTC__)
namespace gnomon::std {

using uint32_t = unsigned int;
using uint64_t = unsigned long long;

template <class A, class B> inline constexpr bool is_same_v = false;
template <class A> inline constexpr bool is_same_v<A, A> = true;
template <class A, class B>
concept same_as = is_same_v<A, B>;

template <class T> inline constexpr bool is_floating_point_v = is_same_v<T, float> || is_same_v<T, double>;
template <class T> inline constexpr bool is_integral_v = false;
template <class T>
requires requires(T x) { x % x; }
inline constexpr bool is_integral_v<T> = true;
template <class T> inline constexpr bool is_arithmetic_v = is_floating_point_v<T> || is_integral_v<T>;

template <class T> struct type_identity {
    using type = T;
};
template <class T> using type_identity_t = typename type_identity<T>::type;
template <class T> struct remove_cvref : type_identity<T> {};
template <class T> struct remove_cvref<const T> : type_identity<T> {};
template <class T> struct remove_cvref<T&> : remove_cvref<T> {};
template <class T> struct remove_cvref<T&&> : remove_cvref<T> {};
template <class T> using remove_cvref_t = typename remove_cvref<T>::type;
template <bool condition, class A, class B> struct conditional : type_identity<A> {};
template <class A, class B> struct conditional<false, A, B> : type_identity<B> {};
template <bool condition, class A, class B> using conditional_t = typename conditional<condition, A, B>::type;

template <class T> __device__ T&& declval() noexcept;
template <class T, class... Arguments>
concept constructible_from = requires
{
    T(declval<Arguments>()...);
};

template <class T> struct numeric_limits;
template <> struct numeric_limits<float> {
    static constexpr int digits = 24, min_exponent = -125, max_exponent = 128;
};
template <> struct numeric_limits<double> {
    static constexpr int digits = 53, min_exponent = -1021, max_exponent = 1024;
};

using ::abs;
using ::fma;
using ::ldexp;
using ::sqrt;

} // namespace gnomon::std
#else
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#endif

namespace gnomon {

/// The scalar in one lane of a pack, or the scalar itself.
template <class T> struct lane {
    using type = T;
};
template <class T>
requires(!std::is_arithmetic_v<T>) && requires { typename T::value_type; }
struct lane<T> {
    using type = typename T::value_type;
};
template <class T> using lane_t = typename lane<T>::type;

/// The type of a comparison: bool for a scalar, the pack's own mask for a pack.
template <class T> using mask_t = std::remove_cvref_t<decltype(std::declval<T>() < std::declval<T>())>;

template <class T>
using arithmetic_result =
    decltype((-std::declval<T>() + std::declval<T>()) * std::declval<T>() / (std::declval<T>() - std::declval<T>()));

/// True for the types whose digits and exponents the kernels are made for. Others round elsewhere, as long double,
/// _Float16 and numbers of many digits do.
template <class T> inline constexpr bool is_lane = std::is_same_v<T, float> || std::is_same_v<T, double>;

/// Operations of a pack that are faster than the generic code below: a specialization provides them (simd/xsimd.hpp).
template <class T> struct pack_operations {};

/// False for a pack of another library that is no Real by itself, since its operators lack something or round otherwise:
/// gnomon::pack of it is (simd/pack.hpp). The library's adapter knows, so without it no pack of xsimd or of the standard
/// library is one.
template <class T> GNOMON_INLINE constexpr bool is_native_real()
{
    constexpr bool is_of_xsimd = requires { typename T::arch_type; };
    constexpr bool is_of_std = requires { typename T::abi_type; };
    if constexpr (requires { pack_operations<T>::native; }) return pack_operations<T>::native;
    else return !is_of_xsimd && !is_of_std;
}
template <class T> inline constexpr bool is_native = is_native_real<T>();

/// A type that can be Real: closed under its own arithmetic, so that one type holds every intermediate value, with
/// lanes of float or double. Expression templates are excluded: evaluate them into a value first.
template <class T>
concept real_number = std::same_as<arithmetic_result<T>, T> && is_lane<lane_t<T>> && is_native<T> &&
    std::constructible_from<T, lane_t<T>> && requires
{
    typename mask_t<T>;
};

template <class T> struct require_real_of {
    static_assert(
        real_number<T>,
        "gnomon: Real must be float, double or a pack of them, closed under + - * / "
        "(no other precision, no integer; no expression template: evaluate it first; no foreign pack without its "
        "adapter: include gnomon/simd/xsimd.hpp or std_simd.hpp, and let Real be gnomon::pack of it)");
    using type = T;
};
template <class T> using require_real = typename require_real_of<T>::type;

/// The value as a Real, rounded once from double to the type of a lane.
template <class T> GNOMON_INLINE constexpr T literal(double value) { return T(static_cast<lane_t<T>>(value)); }

template <class T>
inline constexpr double splitter = double(std::uint64_t{1} << (std::numeric_limits<T>::digits + 1) / 2) + 1.0;
template <class T>
inline constexpr double pivot_floor = std::numeric_limits<T>::min_exponent < -1000 ? 0x1p-66 : 0x1p-30;

// Without an instruction for it, a scalar fma is a library call, which is correct but slower than splitting.
template <class T> GNOMON_INLINE constexpr bool fma_is_fused()
{
    if constexpr (requires { pack_operations<T>::fused; }) return pack_operations<T>::fused;
    else return GNOMON_SCALAR_FMA && is_lane<T>;
}
template <class T> inline constexpr bool is_fused = fma_is_fused<T>();

/// The value of type To with the bits of `from`: std::bit_cast, which libc++ lacks before version 14.
template <class To, class From> GNOMON_INLINE constexpr To gnomon_bit_cast(const From& from)
{
    return __builtin_bit_cast(To, from);
}

template <class T, class Bits> GNOMON_INLINE constexpr T select_by_bits(bool mask, T a, T b)
{
    const Bits ones = Bits(0) - Bits(mask);
    return gnomon_bit_cast<T>(Bits((gnomon_bit_cast<Bits>(a) & ones) | (gnomon_bit_cast<Bits>(b) & ~ones)));
}

// GCC compiles a conditional operator to a branch, to skip work that only one side needs. For receivers that differ
// from their neighbours, half the time of a kernel is then lost to mispredictions. Bit operations stay free of
// branches, and GCC vectorises them.
template <class M, class T> GNOMON_INLINE constexpr T gnomon_select(M mask, T a, T b)
{
    if constexpr (!std::is_same_v<M, bool>) return select GNOMON_NO_MACRO(mask, a, b);
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
    else if constexpr (std::is_same_v<T, float>) return select_by_bits<T, std::uint32_t>(mask, a, b);
    else if constexpr (std::is_same_v<T, double>) return select_by_bits<T, std::uint64_t>(mask, a, b);
#endif
    else return mask ? a : b;
}

template <class M> GNOMON_INLINE constexpr bool gnomon_any(M mask)
{
    if constexpr (std::is_same_v<M, bool>) return mask;
    else if constexpr (requires { any_of(mask); }) return any_of(mask);
    else return any GNOMON_NO_MACRO(mask);
}

/// x, of which the optimizer knows nothing.
template <class T> GNOMON_INLINE constexpr T opaque(T x)
{
#if defined(__GNUC__) && !defined(__CUDA_ARCH__)
    if (!__builtin_is_constant_evaluated()) {
        auto bits = __builtin_bit_cast(std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>, x);
        __asm__("" : "+r"(bits));
        return __builtin_bit_cast(T, bits);
    }
#endif
    return x;
}

// The second operand of a minimum or a maximum, through a sum that clang does not see through. Otherwise, when clang knows
// this operand to be no NaN, it takes an instruction of Arm or PowerPC that returns a NaN for a signalling one.
template <class T> GNOMON_INLINE constexpr T second_operand(T x)
{
#if defined(__clang__) && (defined(__aarch64__) || defined(__powerpc__))
    return x + opaque(T(-0.0));
#else
    return x;
#endif
}

template <class T> GNOMON_INLINE constexpr T gnomon_min(T a, T b)
{
    if constexpr (requires { pack_operations<T>::min GNOMON_NO_MACRO(a, b); })
        return pack_operations<T>::min GNOMON_NO_MACRO(a, b);
    else if constexpr (std::is_floating_point_v<T>) {
        const T second = second_operand(b); // above, or clang would make a branch of the choice
        return a < b ? a : second;
    } else return gnomon_select(a < b, a, b);
}

template <class T> GNOMON_INLINE constexpr T gnomon_max(T a, T b)
{
    if constexpr (requires { pack_operations<T>::max GNOMON_NO_MACRO(a, b); })
        return pack_operations<T>::max GNOMON_NO_MACRO(a, b);
    else if constexpr (std::is_floating_point_v<T>) {
        const T second = second_operand(b);
        return b < a ? a : second;
    } else return gnomon_select(b < a, a, b);
}

template <class T> GNOMON_INLINE constexpr T gnomon_saturate(T x)
{
    return gnomon_min(T(lane_t<T>(1)), gnomon_max(x, T(lane_t<T>(0))));
}

template <class T> GNOMON_INLINE constexpr T gnomon_abs(T a)
{
    using std::abs;
    return abs GNOMON_NO_MACRO(a);
}

template <class T> GNOMON_INLINE constexpr T gnomon_sqrt(T a)
{
#if defined(__CUDA_ARCH__)
    // Correctly rounded under nvcc --use_fast_math, too.
    if constexpr (std::is_same_v<T, float>) return __fsqrt_rn(a);
    else if constexpr (std::is_same_v<T, double>) return __dsqrt_rn(a);
    else
#elif defined(__GNUC__)
    // std::sqrt compiles to a call as well, which sets errno.
    if constexpr (std::is_same_v<T, float>) return __builtin_sqrtf(a);
    else if constexpr (std::is_same_v<T, double>) return __builtin_sqrt(a);
    else
#endif
    {
        using std::sqrt;
        return sqrt(a);
    }
}

template <class T> GNOMON_INLINE constexpr T gnomon_fma(T a, T b, T c)
{
    GNOMON_UNFUSED
    if constexpr (std::is_floating_point_v<T>) return std::fma(a, b, c);
    else if constexpr (requires { pack_operations<T>::fma(a, b, c); }) return pack_operations<T>::fma(a, b, c);
    else return a * b + c;
}

template <class T> GNOMON_INLINE constexpr T gnomon_sum(T a, T b) { return a + b; }
template <class T> GNOMON_INLINE constexpr T gnomon_difference(T a, T b) { return a - b; }

template <class T> GNOMON_INLINE constexpr T gnomon_power_of_two(T n)
{
    if constexpr (std::is_same_v<T, float>) {
        // The sum has n in its low bits, and the shift moves n into the exponent.
        return gnomon_bit_cast<float>((gnomon_bit_cast<std::uint32_t>(n + 0x1.8p23f) << 23) +
                                      (std::uint32_t{127} << 23));
    } else if constexpr (std::is_same_v<T, double>) {
        return gnomon_bit_cast<double>((gnomon_bit_cast<std::uint64_t>(n + 0x1.8p52) << 52) +
                                       (std::uint64_t{1023} << 52));
    } else if constexpr (requires { pack_operations<T>::power_of_two(n); }) {
        return pack_operations<T>::power_of_two(n);
    } else {
        T power = T(lane_t<T>(1));
        for (int k = std::numeric_limits<lane_t<T>>::max_exponent / 2; k > 0; k /= 2) {
            const T step = T(static_cast<lane_t<T>>(k));
            const T up = T(static_cast<lane_t<T>>(std::ldexp(1.0, k)));
            const T down = T(static_cast<lane_t<T>>(std::ldexp(1.0, -k)));
            power = gnomon_select(step <= n, power * up, gnomon_select(n <= -step, power * down, power));
            n = gnomon_select(step <= n, n - step, gnomon_select(n <= -step, n + step, n));
        }
        return power;
    }
}

// Contraction would fold a plain product into a later sum, and the error of the product, which two_product returns, would
// be subtracted twice. A fused product cannot be folded, and adding -0 to the product changes no value; clang must not
// know that. Where no fma is known for T, what a compiler folds is the product by 1, which rounds nothing.
template <class T> GNOMON_INLINE constexpr T gnomon_product(T a, T b)
{
    GNOMON_UNFUSED
#if defined(__CUDA_ARCH__)
    if constexpr (std::is_same_v<T, float>) return __fmul_rn(a, b);
    else if constexpr (std::is_same_v<T, double>) return __dmul_rn(a, b);
#elif defined(__clang__)
    if constexpr (is_fused<T>) return gnomon_fma(a, b, T(opaque(lane_t<T>(-0.0))));
#else
    if constexpr (is_fused<T>) return gnomon_fma(a, b, T(lane_t<T>(-0.0)));
#endif
    else if constexpr (GNOMON_HAS_FMA) return (a * b) * T(opaque(lane_t<T>(1)));
    else return a * b;
}

// A float loses its low bits. Half of 53 bits is no whole number: a double, and whatever has no bits at hand, is rounded to 26
// bits (Dekker 1971).
template <class T> GNOMON_INLINE constexpr T gnomon_high_part(T a)
{
    if constexpr (requires { pack_operations<T>::high_part(a); }) return pack_operations<T>::high_part(a);
    else if constexpr (std::is_same_v<T, float>) {
        return gnomon_bit_cast<float>(gnomon_bit_cast<std::uint32_t>(a) & std::uint32_t{0xFFFFF000});
    } else {
        const T scaled = gnomon_product(literal<T>(splitter<lane_t<T>>), a); // contraction would leave no halves
        return scaled - gnomon_difference(scaled, a);
    }
}

} // namespace gnomon

#endif

// numerics/round.h ----------------------------------------------------------------------------------------------------
// Rounding to whole numbers by addition: floating-point numbers near 1.5 2^(p - 1) are one apart, where p is the number
// of bits of the significand. The sum of x and that number rounds x to a whole number, and the difference is exact.
#ifndef GNOMON_NUMERICS_ROUND_H
#define GNOMON_NUMERICS_ROUND_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The whole number nearest to x, ties to even.
/// Domain: |x| <= 2^22 in float, 2^51 in double.
/// NaN: stays NaN.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real nearest_integer(Real x)
{
    Real rounder = Real(-12582912);
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        rounder = Real(-6755399441055744.0);
    }
    return gnomon_sum(gnomon_difference(x, rounder), rounder);
}

/// The whole number nearest to x, ties to even.
/// Domain: x >= 0, of any size.
/// NaN: stays NaN.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real nearest_natural(Real x)
{
    Real rounder = Real(8388608);
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        rounder = Real(4503599627370496.0);
    }
    return gnomon_select(x < rounder, gnomon_difference(gnomon_sum(x, rounder), rounder), x);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// numerics/select.h ---------------------------------------------------------------------------------------------------
// Clamps with a defined result for NaN, which the built-in clamps of shader languages leave open.
#ifndef GNOMON_NUMERICS_SELECT_H
#define GNOMON_NUMERICS_SELECT_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// x clamped to [low, high].
/// NaN: stays NaN, so that the last step of a kernel can answer it.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real clamp_or_nan(Real x, std::type_identity_t<Real> low, std::type_identity_t<Real> high)
{
    return gnomon_min(high, gnomon_max(low, x));
}

/// x clamped to [low, high].
/// NaN: high.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real clamp_or_high(Real x, std::type_identity_t<Real> low, std::type_identity_t<Real> high)
{
    return gnomon_max(low, gnomon_min(x, high));
}

/// x clamped to [0, 1]: the last step of every kernel that returns an intensity.
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real saturate_or_zero(Real x) { return gnomon_saturate(x); }

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// numerics/exp.h ------------------------------------------------------------------------------------------------------
// Exponential function and natural logarithm with the same bits in every language.
//
// The argument is reduced by a power of two (Cody & Waite 1980). ln 2 has two parts, the first of 10 bits, so that its
// multiples are exact. A minimax polynomial approximates the function on the reduced range: a short one for float, a
// long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_EXP_H
#define GNOMON_NUMERICS_EXP_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double exp_log2_e = 1.4426950408889634;
inline constexpr double exp_ln2_low = -2.1219444005469058e-4;
inline constexpr double exp_sqrt_2 = 1.4142135623730951;
inline constexpr double exp_sqrt_half = 0.70710678118654752;

// exp x = 1 + x + x^2 p(x), |x| <= ln 2 / 2: relative error 2^-28.0 and 2^-57.4, coefficients rounded.
inline constexpr double exp_float_0 = 0.49999993561656014;
inline constexpr double exp_float_1 = 0.16666518908321371;
inline constexpr double exp_float_2 = 0.041668318723256166;
inline constexpr double exp_float_3 = 0.0083689258101569408;
inline constexpr double exp_float_4 = 0.00138210541669496;
inline constexpr double exp_double_0 = 0.50000000000000111;
inline constexpr double exp_double_1 = 0.16666666666666424;
inline constexpr double exp_double_2 = 0.041666666666526318;
inline constexpr double exp_double_3 = 0.0083333333334836331;
inline constexpr double exp_double_4 = 0.0013888888944739634;
inline constexpr double exp_double_5 = 0.00019841269536328214;
inline constexpr double exp_double_6 = 2.4801491857967717e-05;
inline constexpr double exp_double_7 = 2.7557554255829581e-06;
inline constexpr double exp_double_8 = 2.7630720120614683e-07;
inline constexpr double exp_double_9 = 2.5011956595275024e-08;

// 2 artanh y = 2 y + y^3 p(y^2), |y| <= (sqrt 2 - 1) / (sqrt 2 + 1): relative error 2^-30.2 and 2^-59.3.
inline constexpr double log_float_0 = 0.66666776085218282;
inline constexpr double log_float_1 = 0.39977574040563962;
inline constexpr double log_float_2 = 0.29870936689734456;
inline constexpr double log_double_0 = 0.6666666666666734;
inline constexpr double log_double_1 = 0.39999999999416375;
inline constexpr double log_double_2 = 0.28571428742015142;
inline constexpr double log_double_3 = 0.22222198610815577;
inline constexpr double log_double_4 = 0.1818356240364567;
inline constexpr double log_double_5 = 0.15314098871014789;
inline constexpr double log_double_6 = 0.14795474816803084;

/// (e^r - 1 - r) / r^2.
/// Domain: |r| <= ln 2 / 2.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real exp_remainder(Real r)
{
    Real p = literal<Real>(exp_float_0) + r *
             (literal<Real>(exp_float_1) + r *
              (literal<Real>(exp_float_2) + r * (literal<Real>(exp_float_3) + r * literal<Real>(exp_float_4))));
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        p = literal<Real>(exp_double_0) + r *
            (literal<Real>(exp_double_1) + r *
             (literal<Real>(exp_double_2) + r *
              (literal<Real>(exp_double_3) + r *
               (literal<Real>(exp_double_4) + r *
                (literal<Real>(exp_double_5) + r *
                 (literal<Real>(exp_double_6) + r *
                  (literal<Real>(exp_double_7) + r *
                   (literal<Real>(exp_double_8) + r * literal<Real>(exp_double_9)))))))));
    }
    return p;
}

/// e^x, always a finite, normal number.
/// Domain: [-87, 88] in float, [-708, 709] in double; x is clamped.
/// NaN: stays NaN.
/// Error: 1 ulp in float, 1.2 ulp in double, where subtracting up to 1023 ln 2 from x costs 3 2^-56 of the result,
/// nearly 0.4 ulp.
/// Source: Cody & Waite 1980
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real polynomial_exp(Real x)
{
    Real low = Real(-87);
    Real high = Real(88);
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        low = Real(-708);
        high = Real(709);
    }
    x = clamp_or_nan(x, low, high);
    Real n = nearest_integer(x * literal<Real>(exp_log2_e));
    Real r = gnomon_difference(x, n * Real(0.693359375)) - n * literal<Real>(exp_ln2_low);
    return (Real(1) + (r + r * r * exp_remainder(r))) * gnomon_power_of_two(n);
}

/// The number significand 2^exponent.
template <class Real, class = require_real<Real>> struct scaled_number { Real significand, exponent; };

/// s with a factor of 2^k moved from the significand to the exponent if the significand is at least 2^k, with a factor
/// of 2^-k if it is at most 2^-k.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr scaled_number<Real> scaled_number_step(scaled_number<Real> s, Real k)
{
    Real up = gnomon_power_of_two(k);
    Real down = gnomon_power_of_two(-k);
    mask_t<Real> large = up <= s.significand;
    mask_t<Real> tiny = s.significand <= down;
    scaled_number<Real> r;
    r.significand = gnomon_select(large, s.significand * down, gnomon_select(tiny, s.significand * up, s.significand));
    r.exponent = gnomon_select(large, s.exponent + k, gnomon_select(tiny, s.exponent - k, s.exponent));
    return r;
}

/// The natural logarithm of x.
/// Domain: [2^-126, 2^127] in float, [2^-1022, 2^1023] in double; x is clamped, so that 0 and negative numbers give the
/// value at the lower end.
/// NaN: stays NaN.
/// Error: 0.9 ulp in float and in double.
/// Source: Cody & Waite 1980
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real polynomial_log(Real x)
{
    scaled_number<Real> s;
    s.exponent = Real(0);
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        s.significand = clamp_or_nan(x, gnomon_power_of_two(Real(-1022)), gnomon_power_of_two(Real(1023)));
        s = scaled_number_step(s, Real(512));
        s = scaled_number_step(s, Real(256));
        s = scaled_number_step(s, Real(128));
    } else {
        s.significand = clamp_or_nan(x, gnomon_power_of_two(Real(-126)), gnomon_power_of_two(Real(127)));
    }
    s = scaled_number_step(s, Real(64));
    s = scaled_number_step(s, Real(32));
    s = scaled_number_step(s, Real(16));
    s = scaled_number_step(s, Real(8));
    s = scaled_number_step(s, Real(4));
    s = scaled_number_step(s, Real(2));
    s = scaled_number_step(s, Real(1));
    mask_t<Real> large = literal<Real>(exp_sqrt_2) < s.significand;
    mask_t<Real> tiny = s.significand < literal<Real>(exp_sqrt_half);
    Real m = gnomon_select(large, s.significand * Real(0.5),
                           gnomon_select(tiny, s.significand * Real(2), s.significand));
    Real n = gnomon_select(large, s.exponent + Real(1), gnomon_select(tiny, s.exponent - Real(1), s.exponent));

    // As in fdlibm, with exact f and y = f / (2 + f):
    // log(1 + f) = 2 artanh y = f - (f^2 / 2 - y (f^2 / 2 + y^2 p(y^2))).
    Real f = m - Real(1);
    Real y = f / (Real(2) + f);
    Real z = y * y;
    Real p = literal<Real>(log_float_0) + z * (literal<Real>(log_float_1) + z * literal<Real>(log_float_2));
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        p = literal<Real>(log_double_0) + z *
            (literal<Real>(log_double_1) + z *
             (literal<Real>(log_double_2) + z *
              (literal<Real>(log_double_3) + z *
               (literal<Real>(log_double_4) + z * (literal<Real>(log_double_5) + z * literal<Real>(log_double_6))))));
    }
    Real square = Real(0.5) * f * f;
    Real rest = y * (square + z * p) + n * literal<Real>(exp_ln2_low);
    return n * Real(0.693359375) - ((square - rest) - f);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// scattering/single_scattering.h --------------------------------------------------------------------------------------
// Single scattering of a directional light in a homogeneous medium along a view ray (Peters et al. 2017, Sec. 5.1.1 and
// 5.3.1):
//
//     radiance = e^(-extinction s) surface + scattering phase irradiance (1 - e^(-extinction s)) / extinction (1 -
// intensity)
//
// over a distance s, where intensity is the shadow of the ray, weighted by transmittance. extinction and scattering are
// per unit of length, and scattering is the albedo times extinction: the paper's formula has no such factor, its phase
// function holds the scattering coefficient. Light is not attenuated on its way from the light source to the view ray.
//
// omega_l is the direction to the light, omega_p that to the camera. Along a view ray with the polar angle theta
// (rectified.h) omega_l.omega_p = cos theta: 1 looking along the light, -1 looking into it. Phase functions take the
// cosine of the scattering angle, -omega_l.omega_p = -cos theta: light that goes straight on to the camera has 1.
#ifndef GNOMON_SCATTERING_SINGLE_SCATTERING_H
#define GNOMON_SCATTERING_SINGLE_SCATTERING_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double phase_isotropic = 0.079577471545947668; // 1 / (4 pi), for every angle
inline constexpr double phase_greatest_asymmetry = 0.9990234375;

/// The integral of the transmittance along a ray, (1 - e^(-extinction distance)) / extinction, without cancellation:
/// the length of a ray without extinction that scatters as much. In [0, distance].
/// Domain: both at least 0, also infinite; negative numbers count as 0.
/// NaN: as 0.
/// Error: 4.5 ulp.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real attenuated_length(Real distance_, Real extinction)
{
    Real whole = gnomon_max(distance_, Real(0));
    Real rate = gnomon_max(extinction, Real(0));
    Real depth = gnomon_max(rate * whole, Real(0));
    mask_t<Real> thin = depth < Real(0.34375);
    Real r = Real(-1) * gnomon_select(thin, depth, Real(0));
    Real thick = (Real(1) - polynomial_exp(Real(-1) * depth)) / gnomon_select(thin, Real(1), rate);
    return gnomon_select(thin, whole * (Real(1) + r * exp_remainder(r)), thick);
}

/// (1 - e^-x) / x, the mean transmittance along a ray of the optical depth x, in [0, 1]; 1 for 0, without cancellation.
/// Domain: x at least 0, also infinite; negative x counts as 0.
/// NaN: 1.
/// Error: 3.5 ulp.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real attenuated_mean(Real x) { return saturate_or_zero(attenuated_length(Real(1), x)); }

/// e^-x, the transmittance of the optical depth x, in [0, 1].
/// Domain: x at least 0, also infinite; negative x counts as 0. Not below e^-87 in float, e^-708 in double.
/// NaN: 1.
/// Error: 1 ulp in float, 1.2 ulp in double.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real transmittance_over(Real x)
{
    return saturate_or_zero(polynomial_exp(Real(-1) * gnomon_max(x, Real(0))));
}

/// The Henyey-Greenstein phase function, per steradian, of the cosine of the scattering angle. asymmetry is its mean
/// cosine: positive for media that scatter forward, 0 for isotropic ones.
/// Domain: cosine in [-1, 1], asymmetry in [-1 + 2^-10, 1 - 2^-10], clamped.
/// NaN: NaN for a cosine of NaN; an asymmetry of NaN counts as 0.
/// Error: relative, 10 2^-p for |asymmetry| <= 1/2.
/// Source: Henyey & Greenstein 1941
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real phase_henyey_greenstein(Real cosine, std::type_identity_t<Real> asymmetry)
{
    Real c = clamp_or_nan(cosine, Real(-1), Real(1));
    Real g = gnomon_min(gnomon_max(gnomon_abs(asymmetry), Real(0)), literal<Real>(phase_greatest_asymmetry));
    Real off = Real(1) - gnomon_select(asymmetry < Real(0), Real(-1) * c, c);
    Real rest = Real(1) - g;
    Real d = rest * rest + (g + g) * off;
    return literal<Real>(phase_isotropic) * (rest * (Real(1) + g)) / (d * gnomon_sqrt(d));
}

/// The overestimation of visibility for the ray of a polar angle with this cosine, (1 + cosine) / 2, for
/// bounds_intensity. 0 for a ray that looks into the light, in front of which no occluder can be in depth: no light
/// leaks. 1 for a ray along the light, behind which none can be: no light is lost.
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
/// Source: Peters 2017, Sec. 5.3.1
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real adaptive_overestimation(Real cosine)
{
    return Real(1) - saturate_or_zero(Real(0.5) - Real(0.5) * cosine);
}

/// The overestimation of visibility that is adaptive_overestimation for rays along the light, and (1 + cosine^5) / 2
/// for rays towards it. That is close to 1/2, which halves the worst error, but for rays that nearly look into the
/// light. Shown visibility exceeds its lower bound by this share of the weight at the ray: within 5 degrees of looking
/// into the light at most 1% leaks for any occluders. Along the light 1/2 errs more: most of the surfaces that are
/// close to the ray in depth are behind it, where the ray ends (tests/scattering/overestimation.cpp).
/// Domain: cosine in [-1, 1], clamped.
/// NaN: 1.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real plateau_overestimation(Real cosine)
{
    Real c = clamp_or_high(cosine, Real(-1), Real(1));
    Real square = c * c;
    return adaptive_overestimation(gnomon_select(c < Real(0), square * square * c, c));
}

/// Radiance that reaches the camera: that of the surface, attenuated, and light scattered into the view ray. intensity
/// is the shadow of the ray, 0 where all of the ray is lit.
/// Domain: distance, extinction, scattering, phase, irradiance and surface at least 0 and finite.
/// NaN: an intensity of NaN counts as 0.
/// Error: relative, 9 2^-p for optical depths up to 1.
/// Source: Peters 2017, Sec. 5.1.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real scattering_radiance(Real surface, Real intensity, Real distance_,
                                                 std::type_identity_t<Real> extinction,
                                                 std::type_identity_t<Real> scattering, Real phase,
                                                 std::type_identity_t<Real> irradiance)
{
    Real depth = extinction * distance_;
    Real lit = (scattering * phase * irradiance) * attenuated_length(distance_, extinction);
    return transmittance_over(depth) * surface + lit * (Real(1) - saturate_or_zero(intensity));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// scattering/transmittance_weights.h ----------------------------------------------------------------------------------
// Weights of prefix averages along the rows of a rectified map (Peters et al. 2017, Sec. 5.1.1). Texel u has the weight
// w_u, and the average up to texel u is the one before, moved towards texel u by its share of the sum of weights:
//
//     mean_u = mean_(u - 1) + g_u (texel_u - mean_(u - 1)),        g_u = w_u / (w_0 + ... + w_u),        g_0 = 1
//
// All g_u are in [0, 1], so that prefix averages of moments are moments. In a homogeneous medium texel u is seen
// through u texels of the medium: w_u = q^u up to a factor that cancels, so that
//
//     g_u = q g_(u - 1) / (1 + q g_(u - 1)),        q = transmittance of one texel
//
// holds for every extinction: q = 1 without any, q = 0 in an opaque medium. Weights that vary from texel to texel, as
// those of scattering/height_fog.h, are summed by transmittance_share_add.
//
//     (for a row)   q = transmittance_step(extinction, radius_step, mean sine of the row's polar angles)
//     (for u > 0)   g = transmittance_weight_next(g, q);   mean = mean + g (texel - mean)
//
// A ray that ends within texel u, a share f of it, has an average between that of texel u - 1 and that of texel u, but
// not at f: transmittance_weight_within is exact. transmittance_weight_between is exact between averages over any two
// distances, as in mips.
#ifndef GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H
#define GNOMON_SCATTERING_TRANSMITTANCE_WEIGHTS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The transmittance of the medium from one texel of a row to the next, in [0, 1]. extinction is per unit of length;
/// the view ray crosses the texels of radius_step at an angle to the light that has this sine.
/// Domain: at least 0, also infinite; negative numbers count as 0.
/// NaN: 1, also where an extinction of 0 meets a sine of 0.
/// Error: relative, 2.5 2^-p for each unit of the optical depth extinction radius_step / sine, and 2 2^-p.
/// Source: Peters 2017, Sec. 5.1.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real transmittance_step(std::type_identity_t<Real> extinction, Real radius_step, Real sine)
{
    return transmittance_over((extinction * radius_step) / sine);
}

/// The share g_u of texel u in its prefix average, from the share g of the texel before and the ratio of their weights,
/// q. In [0, 1].
/// Domain: g and q in [0, 1], clamped.
/// NaN: 0.
/// Error: relative, 3 2^-p beside those of g and q; 256 2^-p after 1024 texels.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real transmittance_weight_next(Real g, Real q)
{
    Real next = saturate_or_zero(q) * saturate_or_zero(g);
    return next / (Real(1) + next);
}

/// The share of the way from the average before a texel to the one up to it, for a ray that ends a share f within the
/// texel: v / (1 - g + g v), v = (1 - q^f) / (1 - q), where g is the share of the texel. In [0, 1].
/// Domain: g, q and f in [0, 1], clamped.
/// NaN: as 0 for g and f, as 1 for q.
/// Error: 8 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real transmittance_weight_within(Real g, Real q, Real f)
{
    Real share = saturate_or_zero(f);
    Real depth = Real(-1) * polynomial_log(gnomon_min(q, Real(1)));
    Real v = gnomon_min(Real(1), share * attenuated_mean(share * depth) / attenuated_mean(depth));
    Real last = saturate_or_zero(g);
    Real rest = (Real(1) - last) + last * v;
    return gnomon_select(Real(0) < rest, saturate_or_zero(v / rest), Real(1));
}

/// The share of the way from the average over a distance before to the average over before + length, for a ray that
/// ends at before + f length: exact where light and shadow do not change along the length. Distances are in texels of
/// that optical depth. For one texel this is transmittance_weight_within without the shares of the texels before. In
/// [0, 1].
/// Domain: before, length and optical_depth at least 0, the last also infinite; f in [0, 1], clamped.
/// NaN: 0, also where before and f are 0, or optical_depth is infinite.
/// Error: 24 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real transmittance_weight_between(Real before, Real length_, Real f, Real optical_depth)
{
    Real part = saturate_or_zero(f) * length_;
    Real above = attenuated_length(part, optical_depth) * attenuated_length(before + length_, optical_depth);
    Real below = attenuated_length(before + part, optical_depth) * attenuated_length(length_, optical_depth);
    return saturate_or_zero(above / below);
}

/// A sum of weights, and the share in it of the weight that was added last.
template <class Real, class = require_real<Real>> struct transmittance_share { Real total, share; };

/// The state after the first texel of a row, whose share is 1.
/// Domain: a weight of at least 0; negative weights count as 0.
/// NaN: a weight of 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr transmittance_share<Real> transmittance_share_begin(Real weight)
{
    transmittance_share<Real> r;
    r.total = gnomon_max(weight, Real(0));
    r.share = Real(1);
    return r;
}

/// The state after one more texel with a weight. Its share, in [0, 1], is 1 while all weights are 0.
/// Domain: as for transmittance_share_begin. While the sum is not finite the share is 0.
/// NaN: a weight of 0.
/// Error: relative, one rounding for each texel.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr transmittance_share<Real> transmittance_share_add(transmittance_share<Real> state, Real weight)
{
    Real added = gnomon_max(weight, Real(0));
    transmittance_share<Real> r;
    r.total = state.total + added;
    r.share = saturate_or_zero(added / r.total);
    r.share = gnomon_select(r.total == Real(0), Real(1), r.share);
    return r;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

#undef GNOMON_UNFUSED
#undef GNOMON_HAS_FMA
#undef GNOMON_SCALAR_FMA
#undef GNOMON_INLINE
#undef GNOMON_NO_MACRO
#undef GNOMON_WARNINGS_OFF
#undef GNOMON_WARNINGS_ON
#endif
