// Gnomon 0.1.0, layer_sums.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_SUMS_CUH
#define GNOMON_LAYER_SUMS_CUH

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
#error "gnomon: layer_sums.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_sums.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_sums.cuh is not of the same version as a package before it"
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

// filters/exponential.h -----------------------------------------------------------------------------------------------
// Exponential shadow maps (Salvi 2008; Annen et al. 2008; Peters et al. 2017, 2.2): the map holds exp(c z), and
// Markov's inequality bounds the shadow intensity from below: Z(z < z_f) >= 1 - E[exp(c z)] / exp(c z_f).
#ifndef GNOMON_FILTERS_EXPONENTIAL_H
#define GNOMON_FILTERS_EXPONENTIAL_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// E[exp(c z)].
template <class Real, class = require_real<Real>> struct exponential_moment { Real warped; };

/// The exponent c > 0: the larger, the less light leaks just behind an occluder. In float c <= 44 keeps every product
/// finite.
template <class Real, class = require_real<Real>> struct exponential_settings { Real exponent; };

/// The warped moment of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: relative, (c + 2) 2^-p, mostly from rounding c z.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr exponential_moment<Real> exponential_encode(Real z, exponential_settings<Real> settings)
{
    exponential_moment<Real> r;
    r.warped = polynomial_exp(settings.exponent * clamp_or_high(z, Real(-1), Real(1)));
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; an exponent of at least 0. For 0 everything is lit. From 44 on in
/// float shadows leak where both depths are on one side of 0. A negative exponent turns the order of depths around.
/// NaN: 0, lit.
/// Error: (c + 5) 2^-p (1 - intensity) + 2^-p, p the bits of the significand.
/// Source: Salvi 2008; Annen 2008; Peters 2017, Sec. 2.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_intensity(exponential_moment<Real> filtered, Real z_f,
                                                   exponential_settings<Real> settings)
{
    return saturate_or_zero(Real(1) - filtered.warped * polynomial_exp(-settings.exponent * gnomon_min(Real(1), z_f)));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// filters/variance.h --------------------------------------------------------------------------------------------------
// Variance shadow maps (Donnelly & Lauritzen 2006; Peters et al. 2017, 2.2): the map holds z and z^2, filtered to mean
// and second moment, and Cantelli's inequality bounds the shadow intensity from below: Z(z < z_f) >= d^2 / (variance +
// d^2), d = z_f - mean >= 0.
#ifndef GNOMON_FILTERS_VARIANCE_H
#define GNOMON_FILTERS_VARIANCE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// E[z] and E[z^2]. Linear combinations of such moments, by weights that sum to 1, are such moments again.
template <class Real, class = require_real<Real>> struct variance_moments { Real mean, square; };

/// minimum_variance, at least 0, hides the rounding of the stored moments from the inequality (storage/variance.h).
template <class Real, class = require_real<Real>> struct variance_settings { Real minimum_variance; };

/// The moments of one depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr variance_moments<Real> variance_encode(Real z)
{
    variance_moments<Real> r;
    r.mean = clamp_or_high(z, Real(-1), Real(1));
    r.square = r.mean * r.mean;
    return r;
}

/// Cantelli's lower bound in [0, 1] on the probability of values below the receiver; 0 for a receiver at or before the
/// mean.
/// Domain: minimum_variance at least 0. A negative one counts for nothing; an infinite one leaves no shadow.
/// NaN: 0; a minimum_variance of NaN counts for nothing.
/// Error: with the rounding of the moments, r (1 + 4 q + sqrt q), q = (square + receiver^2) / (variance + d^2),
/// r = 4 2^-p, p the bits of the significand.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real cantelli_lower(variance_moments<Real> moments, Real receiver,
                                            std::type_identity_t<Real> minimum_variance)
{
    Real variance = gnomon_max(minimum_variance, moments.square - moments.mean * moments.mean);
    Real d = gnomon_max(Real(0), receiver - moments.mean);
    return saturate_or_zero(d * d / (variance + d * d));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f; beyond the far plane as on it; minimum_variance as of cantelli_lower.
/// NaN: 0, lit; a minimum_variance of NaN counts for nothing.
/// Error: as cantelli_lower.
/// Source: Donnelly & Lauritzen 2006; Peters 2017, Sec. 2.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real variance_intensity(variance_moments<Real> filtered, Real z_f,
                                                variance_settings<Real> settings)
{
    return cantelli_lower(filtered, gnomon_min(Real(1), z_f), settings.minimum_variance);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/depth.h -----------------------------------------------------------------------------------------------------
// Signed depth from what depth buffers hold. Signed depth is -1 at the near plane, +1 at the far plane, and linear in
// the view distance: filters need the linearity, since they average depths. A perspective projection is not linear, so
// its buffer needs a conversion of its own.
//
//   buffer                                    near plane   far plane    conversion
//   view distance                             near         far          depth_from_distance
//   orthographic, or linear                   0            1            depth_from_unit
//   orthographic, or linear, reversed         1            0            depth_from_reversed
//   perspective                               0            1            depth_from_perspective
//   perspective, reversed                     1            0            depth_from_reversed_perspective
//   perspective, infinite far plane           0            (1)          depth_from_infinite
//   perspective, infinite, reversed           1            (0)          depth_from_reversed_infinite
//
// A buffer in [-1, 1], as in OpenGL, first becomes 0.5 z + 0.5.
#ifndef GNOMON_MOMENTS_DEPTH_H
#define GNOMON_MOMENTS_DEPTH_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection
/// or a stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_unit(Real z) { return z * Real(2) - Real(1); }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_reversed(Real z) { return Real(1) - z * Real(2); }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which
/// encoders store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_distance(Real distance_, std::type_identity_t<Real> near_distance,
                                                 std::type_identity_t<Real> far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_between(Real n, Real f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_perspective(Real z, std::type_identity_t<Real> near_distance,
                                                    std::type_identity_t<Real> far_distance)
{
    Real x = clamp_or_nan(z, Real(0), Real(1));
    return depth_between(near_distance * x, far_distance * (Real(1) - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity
/// or NaN, which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_reversed_perspective(Real z, std::type_identity_t<Real> near_distance,
                                                             std::type_identity_t<Real> far_distance)
{
    Real x = clamp_or_nan(z, Real(0), Real(1));
    return depth_between(near_distance * (Real(1) - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance.
/// Of signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_reversed_infinite(Real z, std::type_identity_t<Real> near_distance,
                                                          std::type_identity_t<Real> far_distance)
{
    Real x = gnomon_abs(clamp_or_nan(z, Real(0), Real(1))); // -0 is the far plane, too
    Real depth = (near_distance * (Real(1) - x) - (far_distance * x - near_distance)) /
                 (x * (far_distance - near_distance));
    return clamp_or_nan(depth, Real(-1), Real(1));
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_from_infinite(Real z, std::type_identity_t<Real> near_distance,
                                                 std::type_identity_t<Real> far_distance)
{
    return depth_from_reversed_infinite(Real(1) - z, near_distance, far_distance);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/moments.h, four moments -------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_4
#define GNOMON_MOMENTS_MOMENTS_4

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct moments4 { Real b1, b2, b3, b4; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr moments4<Real> moments4_from_depth(Real z)
{
    moments4<Real> b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// b times weight: the first term of a linear combination.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_scale(moments4<Real> b, std::type_identity_t<Real> weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_add(moments4<Real> sum, moments4<Real> b,
                                                    std::type_identity_t<Real> weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y =
/// -1.
/// Source: Peters 2017, Eq. 2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_from_unit(moments4<Real> c)
{
    moments4<Real> b;
    b.b1 = Real(2) * c.b1 - Real(1);
    b.b2 = Real(4) * (c.b2 - c.b1) + Real(1);
    b.b3 = (Real(8) * c.b3 - Real(12) * c.b2) + (Real(6) * c.b1 - Real(1));
    b.b4 = Real(16) * (c.b4 - Real(2) * c.b3) + (Real(24) * c.b2 - Real(8) * c.b1 + Real(1));
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/moments.h, six moments --------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_MOMENTS_6
#define GNOMON_MOMENTS_MOMENTS_6

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct moments6 { Real b1, b2, b3, b4, b5, b6; };

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr moments6<Real> moments6_from_depth(Real z)
{
    moments6<Real> b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    b.b5 = b.b4 * z;
    b.b6 = b.b3 * b.b3;
    return b;
}

/// b times weight: the first term of a linear combination.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_scale(moments6<Real> b, std::type_identity_t<Real> weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    b.b5 = b.b5 * weight;
    b.b6 = b.b6 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_add(moments6<Real> sum, moments6<Real> b,
                                                    std::type_identity_t<Real> weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    sum.b5 = sum.b5 + b.b5 * weight;
    sum.b6 = sum.b6 + b.b6 * weight;
    return sum;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/bias.h ------------------------------------------------------------------------------------------------------
// Biasing: rounding in storage can turn moments into numbers that belong to no distribution, so they are moved inwards
// (Peters et al. 2017, Sec. 2.5).
//
// Let storage move the stored vector b by e, at most delta in each channel, and let r be the distance in the maximum
// norm from b* to the boundary of the valid vectors. Interpolation by alpha gives
//     (1 - alpha) (b + e) + alpha b* = (1 - alpha) b + alpha (b* + e (1 - alpha) / alpha),
// whose last term is valid from alpha = delta / (delta + r) on. The result has the moments of the mixture (1 - alpha) Z
// + alpha Z', so intensities exceed Z(z < z_f) by at most alpha. n roundings need n delta. The weight alpha is
// therefore a property of the format and of the number of roundings, not a setting.
//
// The vectors b* below have the largest r and are computed by tests/derivations. Beside them stand the paper's vectors,
// which have the largest Euclidean distance. Odd entries are 0 by symmetry.
//
// A bias is applied in one of two ways:
//   interpolated    moments4_add_bias, then hankel4_from_moments, as in the paper: for UNORM and half floats
//   kept apart      hankel4_constant_bias, the same mixture with 100 times less rounding error: for floats
// Certificates (certified4.h) leak less than a constant bias and never darken a lit surface. A bias that depends on the
// moments leaks less still, but darkens lit surfaces by up to 0.79 (docs/decisions/2-bias.md).
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta /
/// (delta + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real bias_weight_of_roundings(Real w, Real n)
{
    Real nw = gnomon_max(Real(1), n) * w;
    return nw / ((Real(1) - w) + nw);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/bias.h, four moments ----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_4
#define GNOMON_MOMENTS_BIAS_4

GNOMON_WARNINGS_OFF namespace gnomon {

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
inline constexpr double bias4_raw_b2 = 0.41397147664677789;
inline constexpr double bias4_raw_b4 = 0.41397147664677789;
inline constexpr double bias4_raw_paper_b2 = 0.375;
inline constexpr double bias4_raw_paper_b4 = 0.375;

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
inline constexpr double bias4_theta_b2 = 0.66391434671237689;
inline constexpr double bias4_theta_b4 = 0.66391434671237689;
inline constexpr double bias4_theta_paper_b2 = 0.628;
inline constexpr double bias4_theta_paper_b4 = 0.628;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_add_bias(moments4<Real> b, std::type_identity_t<Real> bias2,
                                                         std::type_identity_t<Real> bias4,
                                                         std::type_identity_t<Real> alpha)
{
    Real keep = Real(1) - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/bias.h, six moments -----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_6
#define GNOMON_MOMENTS_BIAS_6

GNOMON_WARNINGS_OFF namespace gnomon {

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
inline constexpr double bias6_raw_b2 = 0.42015374983242804;
inline constexpr double bias6_raw_b4 = 0.2876068288776971;
inline constexpr double bias6_raw_b6 = 0.25730795870391842;

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
inline constexpr double bias6_theta_b2 = 0.61284694380550628;
inline constexpr double bias6_theta_b4 = 0.52469968779048582;
inline constexpr double bias6_theta_b6 = 0.50463026403505464;
inline constexpr double bias6_paper_b2 = 0.5566;
inline constexpr double bias6_paper_b4 = 0.489;
inline constexpr double bias6_paper_b6 = 0.47869382;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_add_bias(moments6<Real> b, std::type_identity_t<Real> bias2,
                                                         std::type_identity_t<Real> bias4,
                                                         std::type_identity_t<Real> bias6,
                                                         std::type_identity_t<Real> alpha)
{
    Real keep = Real(1) - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// numerics/two_product.h ----------------------------------------------------------------------------------------------
// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The unevaluated sum high + low.
template <class Real, class = require_real<Real>> struct double_word { Real high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real dekker_product_error(Real a, Real b, Real p)
{
    Real ah = gnomon_high_part(a);
    Real bh = gnomon_high_part(b);
    Real al = gnomon_difference(a, ah);
    Real bl = gnomon_difference(b, bh);
    Real e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr double_word<Real> two_product(Real a, Real b)
{
    double_word<Real> r;
    if (is_fused<Real>) {
        r.high = gnomon_fma(a, b, Real(-0.0)); // kept, as gnomon_product is: two fused products read it
        r.low = gnomon_fma(a, b, -r.high);
    } else {
        r.high = gnomon_product(a, b);
        r.low = dekker_product_error(a, b, r.high);
    }
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> two_difference(Real a, Real b)
{
    double_word<Real> r;
    r.high = gnomon_difference(a, b);
    Real bv = gnomon_difference(r.high, a);
    Real av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> two_difference_ordered(Real a, Real b)
{
    double_word<Real> r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> subtract_product(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> subtract_product_ordered(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real subtract_product_rounded(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> double_word_minor(double_word<Real> a, double_word<Real> b,
                                                            double_word<Real> c, double_word<Real> d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference(p.high, q.high);
    Real cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for double_word_minor.
/// Error: 2 roundings of the result beside that of double_word_minor.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real double_word_determinant(double_word<Real> a, double_word<Real> b, double_word<Real> c)
{
    double_word p = two_product(a.high, c.high);
    double_word q = two_product(b.high, b.high);
    Real cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/covariance.h ------------------------------------------------------------------------------------------------
// Covariances of powers of depth, b_(i+j) - b_i b_j, as double words. Over a single surface nearly all digits cancel,
// and the remaining ones decide the shadow. The factored Hankel matrices of four and of six moments start from them.
#ifndef GNOMON_MOMENTS_COVARIANCE_H
#define GNOMON_MOMENTS_COVARIANCE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The covariance (b_ij + e_ij) - (b_i + e_i) (b_j + e_j) after a small change e of the moments, such as a bias, from
/// c = b_ij - b_i b_j. The change goes into the low word: added to the moments it would be rounded away.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> covariance_add_bias(double_word<Real> c, Real b_i, Real b_j, Real e_ij,
                                                              Real e_i, Real e_j)
{
    c.low = c.low + (e_ij - (b_i * e_j + e_i * (b_j + e_j)));
    return c;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/hankel4.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of four moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side).
//
//     B = | 1  b1 b2 |      The factorization L D L^T has the pivots 1, D_1 = E[P_1^2] and D_2 = E[P_2^2], where
//         | b1 b2 b3 |      P_1 = z - b1 and P_2 = P_1^2 - g P_1 - D_1 are the monic orthogonal polynomials of the
//         | b2 b3 b4 |      distribution.
//
// After the first step of elimination the covariances of (z, z^2) remain: V = var z = D_1, L = cov(z, z^2) and
// M = var z^2, and D_1 D_2 = V M - L^2. All three cancel, so they are computed from exact products. A bias (bias.h) is
// added to the covariances, as double words, because added to the moments it would be rounded away. hamburger4.h
// divides later, and uses G = g V = E[P_1^3] = L - 2 b1 V in place of L.
#ifndef GNOMON_MOMENTS_HANKEL4_4
#define GNOMON_MOMENTS_HANKEL4_4

GNOMON_WARNINGS_OFF namespace gnomon {

/// The factored matrix: mean b1, variance D_1, third central moment G, determinant D_1 D_2. Variance and determinant
/// are positive for any moments in [-2^30, 2^30]; larger moments can overflow.
/// NaN: a NaN among the moments stays NaN.
template <class Real, class = require_real<Real>> struct hankel4 { Real mean, variance, third, determinant; };

/// The factored matrix from the mean, V, L and V M - L^2. Pivots below the floor are raised to the floor, so that
/// indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_make(Real mean, Real variance, Real covariance, Real determinant)
{
    hankel4<Real> h;
    h.mean = mean;
    h.variance = gnomon_max(literal<Real>(pivot_floor<lane_t<Real>>), variance);
    h.third = covariance - (mean + mean) * h.variance;
    h.determinant = gnomon_max(literal<Real>(pivot_floor<lane_t<Real>>) * h.variance, determinant);
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 16-bit storage, whose
/// own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_moments(moments4<Real> b)
{
    Real v = b.b2 - b.b1 * b.b1;
    Real l = b.b3 - b.b1 * b.b2;
    Real m = b.b4 - b.b2 * b.b2;
    return hankel4_make(b.b1, v, l, v * m - l * l);
}

/// The covariances V, L and M of (z, z^2).
template <class Real, class = require_real<Real>> struct covariances4 { double_word<Real> v, l, m; };

/// The covariances without loss by cancellation. Jensen's inequality orders the terms of V and M, but not those of L.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr covariances4<Real> covariances4_from_moments(moments4<Real> b)
{
    covariances4<Real> c;
    c.v = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.l = subtract_product(b.b3, b.b1, b.b2);
    c.m = subtract_product_ordered(b.b4, b.b2, b.b2);
    return c;
}

/// The factored matrix of the moments b + e, where e is small: a bias, or what rounding took from b.
/// NaN: stays NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_with_change(moments4<Real> b, moments4<Real> e)
{
    covariances4 c = covariances4_from_moments(b);
    double_word v = covariance_add_bias(c.v, b.b1, b.b1, e.b2, e.b1, e.b1);
    double_word l = covariance_add_bias(c.l, b.b1, b.b2, e.b3, e.b1, e.b2);
    double_word m = covariance_add_bias(c.m, b.b2, b.b2, e.b4, e.b2, e.b2);
    return hankel4_make(b.b1 + e.b1, v.high + v.low, l.high + l.low, double_word_determinant(v, l, m));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with
/// second and fourth moments bias2 and bias4.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_constant_bias(moments4<Real> b, std::type_identity_t<Real> bias2,
                                                            std::type_identity_t<Real> bias4,
                                                            std::type_identity_t<Real> alpha)
{
    moments4<Real> e;
    e.b1 = Real(-1) * alpha * b.b1;
    e.b2 = alpha * (bias2 - b.b2);
    e.b3 = Real(-1) * alpha * b.b3;
    e.b4 = alpha * (bias4 - b.b4);
    return hankel4_with_change(b, e);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/channels.h --------------------------------------------------------------------------------------------------
// The channels of a shadow map's texel, as a texture unit returns them: filtered or not, still behind the transform of
// the storage format. Types of their own, so that channels never pass for moments, nor moments for channels.
#ifndef GNOMON_MOMENTS_CHANNELS_H
#define GNOMON_MOMENTS_CHANNELS_H

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct channels1 { Real c1; };

template <class Real, class = require_real<Real>> struct channels2 { Real c1, c2; };

template <class Real, class = require_real<Real>> struct channels5 { Real c1, c2, c3, c4, c5; };

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/channels.h, four moments ------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_4
#define GNOMON_MOMENTS_CHANNELS_4

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct channels4 { Real c1, c2, c3, c4; };

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct channels6 { Real c1, c2, c3, c4, c5, c6; };

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/quantization.h, four moments --------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_4
#define GNOMON_MOMENTS_QUANTIZATION_4

GNOMON_WARNINGS_OFF namespace gnomon {

/// The moments that a format without transform holds as they are.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_from_channels(channels4<Real> c)
{
    moments4<Real> b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    return b;
}

/// The moments b as the channels of a format without transform.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> channels4_from_moments(moments4<Real> b)
{
    channels4<Real> c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    return c;
}

inline constexpr double theta4_31 = 0.8660254037844386;   // sqrt(3) / 2
inline constexpr double theta4_33 = -0.38490017945975052; // -2 sqrt(3) / 9
inline constexpr double theta4_inverse11 = -0.33333333333333331;
inline constexpr double theta4_inverse13 = 1.7320508075688772;
inline constexpr double theta4_inverse33 = 1.299038105676658;

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels4<Real> theta4(moments4<Real> b)
{
    channels4<Real> c;
    c.c1 = Real(1.5) * b.b1 - Real(2) * b.b3 + Real(0.5);
    c.c2 = Real(4) * (b.b2 - b.b4);
    c.c3 = literal<Real>(theta4_31) * b.b1 + literal<Real>(theta4_33) * b.b3 + Real(0.5);
    c.c4 = Real(0.5) * (b.b2 + b.b4);
    return c;
}

/// The four moments of channels c: the inverse of theta4.
/// Source: Peters 2017, Eq. 3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> theta4_inverse(channels4<Real> c)
{
    Real c1 = c.c1 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    moments4<Real> b;
    b.b1 = literal<Real>(theta4_inverse11) * c1 + literal<Real>(theta4_inverse13) * c3;
    b.b2 = Real(0.125) * c.c2 + c.c4;
    b.b3 = literal<Real>(theta4_inverse33) * c3 - Real(0.75) * c1;
    b.b4 = c.c4 - Real(0.125) * c.c2;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> theta4_inverse_add_bias(channels4<Real> c, std::type_identity_t<Real> bias,
                                                               std::type_identity_t<Real> alpha)
{
    Real keep = Real(1) - alpha;
    Real c1 = c.c1 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    Real c2 = (Real(0.125) * keep) * c.c2;
    Real c4 = keep * c.c4 + alpha * bias;
    moments4<Real> b;
    b.b1 = (keep * literal<Real>(theta4_inverse11)) * c1 + (keep * literal<Real>(theta4_inverse13)) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * literal<Real>(theta4_inverse33)) * c3 - (Real(0.75) * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_QUANTIZATION_6
#define GNOMON_MOMENTS_QUANTIZATION_6

GNOMON_WARNINGS_OFF namespace gnomon {

/// The moments that a format without transform holds as they are.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_from_channels(channels6<Real> c)
{
    moments6<Real> b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    b.b5 = c.c5;
    b.b6 = c.c6;
    return b;
}

/// The moments b as the channels of a format without transform.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> channels6_from_moments(moments6<Real> b)
{
    channels6<Real> c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b5;
    c.c6 = b.b6;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
inline constexpr double theta6_21 = -1.8745771666290014;
inline constexpr double theta6_23 = 4.204664766466248;
inline constexpr double theta6_25 = -1.8300875998372463;
inline constexpr double theta6_31 = 1.2643431422063351;
inline constexpr double theta6_33 = -1.4716161665593888;
inline constexpr double theta6_35 = 0.70727302435305361;
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
inline constexpr double theta6_62 = -0.57735026918962573;
inline constexpr double theta6_64 = 4.6188021535170058;
inline constexpr double theta6_66 = -3.0792014356780042;
inline constexpr double theta6_60 = 0.018874775675311862;
inline constexpr double theta6_inverse11 = -0.02841260648183782;
inline constexpr double theta6_inverse12 = 0.47582541301272185;
inline constexpr double theta6_inverse13 = 1.552587193469116;
inline constexpr double theta6_inverse31 = 0.10002244957859331;
inline constexpr double theta6_inverse32 = 0.84496560893955308;
inline constexpr double theta6_inverse33 = 1.0550119414818537;
inline constexpr double theta6_inverse51 = 0.25890700149881596;
inline constexpr double theta6_inverse52 = 0.90751156960796575;
inline constexpr double theta6_inverse53 = 0.83358142889321829;
inline constexpr double theta6_inverse_sixth = 0.16666666666666666;
inline constexpr double theta6_inverse23 = 0.8660254037844386;
inline constexpr double theta6_inverse63 = 0.81189881604791125;

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels6<Real> theta6(moments6<Real> b)
{
    channels6<Real> c;
    c.c1 = Real(2.5) * b.b1 - Real(10) * b.b3 + Real(8) * b.b5 + Real(0.5);
    c.c2 = literal<Real>(theta6_21) * b.b1 + literal<Real>(theta6_23) * b.b3 + literal<Real>(theta6_25) * b.b5 +
           Real(0.5);
    c.c3 = literal<Real>(theta6_31) * b.b1 + literal<Real>(theta6_33) * b.b3 + literal<Real>(theta6_35) * b.b5 +
           Real(0.5);
    c.c4 = Real(4) * (b.b2 - b.b4);
    c.c5 = Real(9) * b.b2 - Real(24) * b.b4 + Real(16) * b.b6;
    c.c6 = literal<Real>(theta6_62) * b.b2 + literal<Real>(theta6_64) * b.b4 + literal<Real>(theta6_66) * b.b6 +
           literal<Real>(theta6_60);
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> theta6_inverse(channels6<Real> c)
{
    Real c1 = c.c1 - Real(0.5);
    Real c2 = c.c2 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    Real c5 = literal<Real>(theta6_inverse_sixth) * c.c5;
    Real c6 = c.c6 - literal<Real>(theta6_60);
    moments6<Real> b;
    b.b1 = literal<Real>(theta6_inverse11) * c1 + literal<Real>(theta6_inverse12) * c2 +
           literal<Real>(theta6_inverse13) * c3;
    b.b3 = literal<Real>(theta6_inverse31) * c1 + literal<Real>(theta6_inverse32) * c2 +
           literal<Real>(theta6_inverse33) * c3;
    b.b5 = literal<Real>(theta6_inverse51) * c1 + literal<Real>(theta6_inverse52) * c2 +
           literal<Real>(theta6_inverse53) * c3;
    b.b2 = c5 + literal<Real>(theta6_inverse23) * c6;
    b.b4 = (c5 + literal<Real>(theta6_inverse23) * c6) - Real(0.25) * c.c4;
    b.b6 = (Real(0.21875) * c.c5 + literal<Real>(theta6_inverse63) * c6) - Real(0.375) * c.c4;
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/certified4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four stored moments, certified: never above Z(z < z_f), for any errors of storage within
// the stated noise.
//
// A quartic p with p <= 1 before z_f and p <= 0 from z_f on has E[p] <= Z(z < z_f) for every distribution Z. Storage
// moves channel k by at most noise_k, so E[p] is at least its value from the stored channels minus
// sum_k noise_k |p_k|, where p_k is the coefficient at channel k. That bound holds for every such p. A p with its nodes
// at those of the biased moments (hamburger4.h) is nearly the best (docs/decisions/2-bias.md).
//
// In y = z - z_f, and in the notation of hamburger4.h, the two nodes beside z_f are the roots of a y^2 + b y + w with
//     a = Q V,    b = u N + Q (2 V u - G),    w = V N + u^2 N + Q^2,    r^2 = b^2 - 4 a w.
// Of the nodes before z_f the nearer one is at y = -1 / c with c = (b + r) / (2 w). The certificate is
//     Q < 0, one node on either side:    p = -(1 + d + k y)^2 (2 (c - k) y + c (c - 2 k) y^2)
//     Q >= 0 and b > 0, both before:     p = 1 - (1 + c y)^2 (1 + g y)^2
//     otherwise, none before:            no p, and the bound is 0
// with d = b / (2 r) - 1/2, k = c d and g = (b - r) / (2 w). Both p are 1 at the nodes before z_f, and 0 at z_f and at
// the nodes behind. Any other c >= 0, d in [-1, 0] and g >= 0 give a valid p as well, so rounding in the nodes costs
// only some leaking.
#ifndef GNOMON_MOMENTS_CERTIFIED4_H
#define GNOMON_MOMENTS_CERTIFIED4_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The polynomial p(z) = top - (s0 + s1 z + s2 z^2 + s3 z^3 + s4 z^4). top is 0 or 1, or -2^100 if
/// nothing is certified.
template <class Real, class = require_real<Real>> struct certificate4 { Real top, s0, s1, s2, s3, s4; };

inline constexpr double certificate4_nothing = -1267650600228229401496703205376.0; // -2^100

/// The certificate p = n0 - (t0 + t1 y)^2 (n0 + 2 n1 y + n2 y^2), y = z - z_f, as a polynomial in z.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr certificate4<Real> certificate4_about(Real z_f, Real n0, Real t0, Real t1, Real n1, Real n2)
{
    Real nz = n2 * z_f;
    Real ns = (n1 + n1) - nz;
    Real k0 = n0 - ns * z_f;
    Real k1 = ns - nz;
    Real m = t0 - t1 * z_f;
    Real m0 = m * m;
    Real m1 = m * (t1 + t1);
    Real m2 = t1 * t1;
    certificate4<Real> p;
    p.top = n0;
    p.s0 = m0 * k0;
    p.s1 = m0 * k1 + m1 * k0;
    p.s2 = m0 * n2 + (m1 * k1 + m2 * k0);
    p.s3 = m1 * n2 + m2 * k1;
    p.s4 = m2 * n2;
    return p;
}

/// The certificate for a receiver at z_f, from the matrix of biased moments of 16-bit storage. Neither quotient waits
/// for the square root. b + r and b - r may cancel, which is harmless since the bias keeps the nodes far apart.
/// Domain: z_f in [-1, 1]; h positive definite.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr certificate4<Real> certificate4_make(hankel4<Real> h, Real z_f)
{
    Real u = z_f - h.mean;
    Real vu = h.variance * u;
    Real slope = vu - h.third;
    Real q = slope * u - h.variance * h.variance;
    Real un = u * h.determinant;
    Real w = h.variance * h.determinant + (u * un + q * q);
    Real w2 = w + w;
    Real a = q * h.variance;
    Real b = un + q * (vu + slope);
    Real square = b * b - (a + a) * w2;
    Real inverse = Real(1) / w2;
    Real ratio = b / (square + square);
    Real r = gnomon_sqrt(gnomon_max(Real(0), square));
    Real c = (b + r) * inverse;
    Real g = (b - r) * inverse;
    Real d = ratio * r - Real(0.5);
    Real k = c * d;
    mask_t<Real> between = q < Real(0);
    Real n0 = gnomon_select(between, Real(0), Real(1));
    Real n1 = gnomon_select(between, c - k, g);
    Real n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - k) - k, g);
    Real t0 = gnomon_select(between, Real(1) + d, Real(1));
    Real t1 = gnomon_select(between, k, c);
    certificate4 p = certificate4_about(z_f, n0, t0, t1, n1, n2);
    p.top = gnomon_select(between || (Real(0) < b), n0, literal<Real>(certificate4_nothing));
    return p;
}

/// The coefficients of p at the channels of theta4, with the sign of s: the transpose of theta4_inverse times those at
/// the moments.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> certificate4_theta(certificate4<Real> p)
{
    Real third = Real(0.75) * p.s3;
    channels4<Real> r;
    r.c1 = literal<Real>(theta4_inverse11) * p.s1 - third;
    r.c2 = Real(0.125) * (p.s2 - p.s4);
    r.c3 = literal<Real>(theta4_inverse13) * (p.s1 + third);
    r.c4 = p.s2 + p.s4;
    return r;
}

/// The most by which E[p] changes with channels that are each off by at most noise, from the coefficients at them.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certificate4_theta_doubt(channels4<Real> t, std::type_identity_t<Real> noise)
{
    return noise * ((gnomon_abs(t.c1) + gnomon_abs(t.c2)) + (gnomon_abs(t.c3) + gnomon_abs(t.c4)));
}

/// The least possible value of E[p], given channels c of theta4 that are each off by at most noise.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certificate4_theta_mean(certificate4<Real> p, channels4<Real> c,
                                                     std::type_identity_t<Real> noise)
{
    channels4 t = certificate4_theta(p);
    Real mean = (p.s0 + (t.c2 * c.c2 + t.c4 * c.c4)) + (t.c1 * (c.c1 - Real(0.5)) + t.c3 * (c.c3 - Real(0.5)));
    return p.top - (mean + certificate4_theta_doubt(t, noise));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels c of theta4 that are each off by at
/// most noise. h is the matrix of their moments with a bias.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certified4_theta_lower(hankel4<Real> h, channels4<Real> c,
                                                    std::type_identity_t<Real> noise, Real z_f)
{
    certificate4 p = certificate4_make(h, clamp_or_nan(z_f, Real(-1), Real(1)));
    return saturate_or_zero(certificate4_theta_mean(p, c, noise));
}

inline constexpr double certified4_scale = 137438953472.0; // 2^37

/// A certificate and its mean for the biased moments, and what the bias added to that. known is 0 if rounding left
/// the matrix at its floor or if nothing is certified, else 1.
template <class Real, class = require_real<Real>> struct certified4_mean
{
    certificate4<Real> p;
    Real mean, added, known;
};

/// The certificate at z in [-1, 1] from the matrix h of moments with a constant bias that is kept apart. Float
/// arithmetic cannot give E[p] of the stored moments. E[p] of the biased moments is known from the nodes: the weight of
/// the node before z, or 1 minus the weight of z.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr certified4_mean<Real> certified4_constant_bias_mean(hankel4<Real> h,
                                                                            std::type_identity_t<Real> bias2,
                                                                            std::type_identity_t<Real> bias4,
                                                                            std::type_identity_t<Real> alpha, Real z)
{
    Real u = z - h.mean;
    Real vu = h.variance * u;
    Real slope = vu - h.third;
    Real q = slope * u - h.variance * h.variance;
    // The power of two is a factor of a, b and w, which otherwise underflow for a single depth.
    Real s = literal<Real>(certified4_scale) * q;
    Real n = literal<Real>(certified4_scale) * h.determinant;
    Real un = u * n;
    Real e = u * un + q * s;
    Real w = h.variance * n + e;
    Real w2 = w + w;
    Real a = s * h.variance;
    Real a2 = a + a;
    Real b = un + s * (vu + slope);
    Real r = gnomon_sqrt(gnomon_max(Real(0), b * b - a2 * w2));
    mask_t<Real> between = q < Real(0);
    mask_t<Real> positive = Real(0) < b;
    // Each quotient in the form that does not cancel.
    Real outer = r + gnomon_abs(b);
    Real c = gnomon_select(positive, outer, Real(-2) * a) / gnomon_select(positive, w2, outer);
    Real inverse = Real(1) / gnomon_select(between, r + r, outer);
    Real g = a2 * inverse; // k if one node is on either side
    Real n0 = gnomon_select(between, Real(0), Real(1));
    Real n1 = gnomon_select(between, c - g, g);
    Real n2 = gnomon_select(between, c, g) * gnomon_select(between, (c - g) - g, g);
    Real t0 = gnomon_select(between, Real(0.5) + b * inverse, Real(1));
    Real t1 = gnomon_select(between, g, c);
    certified4_mean<Real> m;
    m.p = certificate4_about(z, n0, t0, t1, n1, n2);
    Real share = gnomon_select(between, Real(0.5) * (e * (r + b)) - w * (a * u), e);
    m.mean = share / (w * gnomon_select(between, r, Real(1)));
    m.added = alpha * ((m.p.top - m.p.s0) - (bias2 * m.p.s2 + bias4 * m.p.s4));
    m.known = gnomon_select((between || positive) &&
                            (literal<Real>(pivot_floor<lane_t<Real>>) * h.variance < h.determinant), Real(1), Real(0));
    return m;
}

/// The certified mean without what the bias added and less the doubt about it, as an intensity.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certified4_constant_bias_intensity(certified4_mean<Real> m, Real doubt)
{
    return gnomon_select(Real(0) < m.known, saturate_or_zero(m.mean - (m.added + doubt)), Real(0));
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from moments stored as floats that are each off by
/// at most the entry in noise. h is their matrix by hankel4_constant_bias with the same bias2, bias4 and alpha. 0 if
/// rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certified4_constant_bias_lower(hankel4<Real> h, moments4<Real> noise,
                                                            std::type_identity_t<Real> bias2,
                                                            std::type_identity_t<Real> bias4,
                                                            std::type_identity_t<Real> alpha, Real z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, Real(-1), Real(1)));
    Real doubt = (noise.b1 * gnomon_abs(m.p.s1) + noise.b2 * gnomon_abs(m.p.s2)) +
                 (noise.b3 * gnomon_abs(m.p.s3) + noise.b4 * gnomon_abs(m.p.s4));
    return certified4_constant_bias_intensity(m, doubt);
}

/// Certified lower bound on the shadow intensity at z_f, in [0, 1], from channels of theta4 with more than 16 bits,
/// each off by at most noise. h is the matrix of their moments by hankel4_constant_bias with the same bias2, bias4 and
/// alpha. 0 if rounding left h at its floor.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real certified4_theta_constant_bias_lower(hankel4<Real> h, std::type_identity_t<Real> noise,
                                                                  std::type_identity_t<Real> bias2,
                                                                  std::type_identity_t<Real> bias4,
                                                                  std::type_identity_t<Real> alpha, Real z_f)
{
    certified4_mean m = certified4_constant_bias_mean(h, bias2, bias4, alpha, clamp_or_nan(z_f, Real(-1), Real(1)));
    return certified4_constant_bias_intensity(m, certificate4_theta_doubt(certificate4_theta(m.p), noise));
}

/// The largest error of each moment of b after one rounding to float: 2 delta |b_j|, but at most delta.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_rounding(moments4<Real> b, std::type_identity_t<Real> delta)
{
    moments4<Real> e;
    e.b1 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b1));
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b3));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

/// The largest error of each filtered moment of b after roundings before the filter, which the moments of |z| bound.
/// For the third, E |z|^3 <= (b2 + b4) / 2.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_rounding_filtered(moments4<Real> b, std::type_identity_t<Real> delta)
{
    moments4<Real> e;
    e.b1 = delta;
    e.b2 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b2));
    e.b3 = gnomon_min(delta, delta * gnomon_abs(b.b2 + b.b4));
    e.b4 = gnomon_min(delta, (delta + delta) * gnomon_abs(b.b4));
    return e;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// numerics/texel_filter.h ---------------------------------------------------------------------------------------------
// Texels of a shadow map along one axis: the texel that holds a position, and the weights of the K + 1 texels that K
// adjacent bilinear look-ups read, which are those of a filter K texels wide with linear ends.
#ifndef GNOMON_NUMERICS_TEXEL_FILTER_H
#define GNOMON_NUMERICS_TEXEL_FILTER_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double texel_limit = 65536.0; // no map is larger: all positions beyond share one texel

/// The texel that holds position x: the largest whole number not above x, clamped to [-65536, 65536].
/// NaN: 65536.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real texel_below(Real x)
{
    Real limit = literal<Real>(texel_limit);
    Real inside = gnomon_max(gnomon_min(x, limit), Real(-1) * limit);
    Real whole = nearest_integer(inside);
    return whole - gnomon_select(inside < whole, Real(1), Real(0));
}

/// The weight of texel i, 0 to K, in the mean of K = look_ups adjacent bilinear look-ups along one axis. u is the
/// distance of the first look-up from the centre of texel 0. In [0, 1].
/// Domain: u in [0, 1], clamped; look_ups at least 1. Elsewhere a number in [0, 1].
/// NaN: u counts as 0; 0 for look_ups.
/// Error: the K + 1 weights sum to 1 within K + 2 roundings.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real texel_weight(Real u, std::type_identity_t<Real> i, std::type_identity_t<Real> look_ups)
{
    Real share = saturate_or_zero(u);
    share = gnomon_select(i < Real(1), Real(1) - share, gnomon_select(i < look_ups, Real(1), share));
    return saturate_or_zero(share / look_ups);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/stochastic_sample.h -----------------------------------------------------------------------------------
// A sample of a stochastic shadow map (Akenine-Moller et al. 2007): what a texel sees at one place and at one time of
// the shutter interval, and how the point that it sees moves (Andersson et al. 2015). Times are stratified: sample k of
// n has a time of its own between k / n and (k + 1) / n. That is slice k of a time-dependent shadow map.
#ifndef GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H
#define GNOMON_MOTION_LAYERS_STOCHASTIC_SAMPLE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Place (x, y) in texels of the map, time t in [0, 1], depth z, motion of the seen point from shutter open to shutter
/// close in texels and in depth, and the id of the surface as in depth_time_range. The background has id
/// stochastic_nothing, depth 1 and no motion.
template <class Real, class = require_real<Real>> struct stochastic_sample { Real x, y, t, z, d_x, d_y, d_z, id; };

inline constexpr double stochastic_nothing = -1.0;               // the id of the background
// 1 + 2^-21: a time is so far from the ends of its stratum
inline constexpr double stratum_begin = 1.000000476837158203125;
inline constexpr double stratum_end = 0.999999523162841796875;   // 1 - 2^-21

/// A sample of the background.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr stochastic_sample<Real> stochastic_background(Real x, Real y, Real t)
{
    stochastic_sample<Real> s;
    s.x = x;
    s.y = y;
    s.t = t;
    s.z = Real(1);
    s.d_x = Real(0);
    s.d_y = Real(0);
    s.d_z = Real(0);
    s.id = literal<Real>(stochastic_nothing);
    return s;
}

/// The time of stratum number `stratum`, 0 to count - 1, of the shutter interval: its begin for jitter 0, its end for
/// jitter 1. The ends themselves are avoided, so that slice_of returns the stratum, bit for bit.
/// Domain: whole numbers stratum < count <= 65536; elsewhere a time in [0, 1]. jitter is clamped to [0, 1].
/// NaN: jitter 0; 0 for the other two.
/// Error: 2^-20, and 4 2^-p of the result.
/// Source: Andersson 2015, Sec. 3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real stratified_time(Real stratum, Real count, Real jitter)
{
    Real place = stratum + saturate_or_zero(jitter);
    place = gnomon_min(place, (stratum + Real(1)) * literal<Real>(stratum_end));
    place = gnomon_max(place, stratum * literal<Real>(stratum_begin));
    return saturate_or_zero(place / count);
}

/// The stratum of `count` that holds time t: the whole number below t count, in [0, count - 1].
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536]; elsewhere a number in [0, 65535].
/// NaN: 0.
/// Source: Andersson 2015, Sec. 3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real slice_of(Real t, Real count)
{
    Real slice = texel_below(saturate_or_zero(t) * count);
    return gnomon_max(gnomon_min(slice, count - Real(1)), Real(0));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double layer_depth_limit = 2.0;      // middle depths of surfaces lie in [-2, 2]
inline constexpr double layer_no_cut = 3.0;           // a cut behind all surfaces
inline constexpr double layer_background_depth = 4.0; // the middle depth of the background
inline constexpr double layer_unknown_depth = -4.0;   // the middle depth of a sample of NaN
inline constexpr double layer_last_bin = 63.0;
inline constexpr double layer_least_extent = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_middle_depth(stochastic_sample<Real> s)
{
    Real z = s.z + (Real(0.5) - s.t) * s.d_z;
    Real limit = literal<Real>(layer_depth_limit);
    Real inside = gnomon_max(gnomon_min(z, limit), Real(-1) * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    Real size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    mask_t<Real> known = size <= literal<Real>(texel_limit);
    Real middle = gnomon_select(known, inside, literal<Real>(layer_unknown_depth));
    return gnomon_select(s.id < Real(0), literal<Real>(layer_background_depth), middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr mask_t<Real> layer_is_surface(Real middle)
{
    return gnomon_abs(middle) <= literal<Real>(layer_depth_limit);
}

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
template <class Real, class = require_real<Real>> struct layer_window { Real least, greatest; };

/// The window of one sample, by its middle depth.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_window<Real> layer_window_begin(Real middle)
{
    mask_t<Real> surface = layer_is_surface(middle);
    layer_window<Real> w;
    w.least = gnomon_select(surface, middle, literal<Real>(layer_background_depth));
    w.greatest = gnomon_select(surface, middle, literal<Real>(layer_unknown_depth));
    return w;
}

/// The window with one more sample, by its middle depth.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_window<Real> layer_window_add(layer_window<Real> window, Real middle)
{
    layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_bin_of(Real middle, layer_window<Real> window)
{
    Real share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    Real bin = gnomon_min(texel_below(Real(64) * share), literal<Real>(layer_last_bin));
    return gnomon_select(layer_is_surface(middle), bin, Real(-1));
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
template <class Real, class = require_real<Real>> struct layer_runs
{
    Real least, greatest, bins, begun, empty;
    Real length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_runs<Real> layer_cuts_begin(layer_window<Real> window)
{
    layer_runs<Real> r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = Real(0);
    r.begun = Real(0);
    r.empty = Real(0);
    r.length0 = Real(0);
    r.length1 = Real(0);
    r.length2 = Real(0);
    r.centre0 = Real(0);
    r.centre1 = Real(0);
    r.centre2 = Real(0);
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_runs<Real> layer_cuts_add(layer_runs<Real> state, Real occupied)
{
    mask_t<Real> some = Real(0) < occupied;
    Real centre = state.bins - Real(0.5) * state.empty;
    mask_t<Real> third = some && state.length2 < state.empty;
    mask_t<Real> second = some && state.length1 < state.empty;
    mask_t<Real> first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, Real(1), state.begun);
    state.empty = gnomon_select(some, Real(0), state.empty + state.begun);
    state.bins = state.bins + Real(1);
    return state;
}

/// Depths that cut a window into layers, from near to far; layer_no_cut for those that are not needed.
template <class Real, class = require_real<Real>> struct layer_cuts { Real c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_cuts<Real> layer_cuts_end(layer_runs<Real> state, std::type_identity_t<Real> layers)
{
    Real none = literal<Real>(layer_no_cut);
    Real extent = state.greatest - state.least;
    mask_t<Real> surfaces = layer_is_surface(state.least) && layer_is_surface(state.greatest);
    mask_t<Real> some = surfaces && literal<Real>(layer_least_extent) <= extent;
    Real per_bin = Real(0.015625) * extent;
    mask_t<Real> first = some && Real(0) < state.length0 && Real(1) < layers;
    mask_t<Real> second = some && Real(0) < state.length1 && Real(2) < layers;
    mask_t<Real> third = some && Real(0) < state.length2 && Real(3) < layers;
    Real a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    Real b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    Real c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    Real near_ab = gnomon_min(a, b);
    Real far_ab = gnomon_max(a, b);
    Real middle = gnomon_min(far_ab, c);
    layer_cuts<Real> r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_of(Real middle, layer_cuts<Real> cuts)
{
    Real known = gnomon_select(Real(-1) * literal<Real>(layer_depth_limit) <= middle, Real(0), Real(-1));
    Real first = gnomon_select(cuts.c0 <= middle, Real(1), Real(0));
    Real second = gnomon_select(cuts.c1 <= middle, Real(1), Real(0));
    Real third = gnomon_select(cuts.c2 <= middle, Real(1), Real(0));
    Real behind = gnomon_select(literal<Real>(layer_background_depth) <= middle, Real(1), Real(0));
    return (known + first) + ((second + third) + behind);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
template <class Real, class = require_real<Real>> struct layer_motion_sums
{
    Real first_x, first_y, first_z, x, y, z, square, square_z, count;
    Real least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
template <class Real, class = require_real<Real>>
struct layer_motion { Real d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion_sums<Real> layer_motion_begin(stochastic_sample<Real> first)
{
    Real limit = literal<Real>(texel_limit);
    layer_motion_sums<Real> r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, Real(0));
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, Real(0));
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, Real(0));
    r.x = Real(0);
    r.y = Real(0);
    r.z = Real(0);
    r.square = Real(0);
    r.square_z = Real(0);
    r.count = Real(0);
    r.least = limit;
    r.greatest = Real(-1) * limit;
    r.least_d = limit;
    r.greatest_d = Real(-1) * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr mask_t<Real> layer_motion_is_known(stochastic_sample<Real> s, Real middle)
{
    Real length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= literal<Real>(texel_limit) && layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion_sums<Real> layer_motion_add(layer_motion_sums<Real> state,
                                                                 stochastic_sample<Real> s, Real middle)
{
    mask_t<Real> known = layer_motion_is_known(s, middle);
    Real x = gnomon_select(known, s.d_x - state.first_x, Real(0));
    Real y = gnomon_select(known, s.d_y - state.first_y, Real(0));
    Real z = gnomon_select(known, s.d_z - state.first_z, Real(0));
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, Real(1), Real(0));
    Real moved = s.z + (Real(0.5) - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion<Real> layer_motion_end(layer_motion_sums<Real> state)
{
    Real share = Real(1) / gnomon_max(state.count, Real(1));
    Real x = state.x * share;
    Real y = state.y * share;
    Real z = state.z * share;
    mask_t<Real> some = Real(0) < state.count;
    layer_motion<Real> r;
    r.d_x = gnomon_select(some, state.first_x + x, Real(0));
    r.d_y = gnomon_select(some, state.first_y + y, Real(0));
    r.d_z = gnomon_select(some, state.first_z + z, Real(0));
    r.spread = gnomon_sqrt(gnomon_max(Real(0), state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(Real(0), state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    Real off = Real(0.5) * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, Real(0));
    r.greatest = gnomon_select(some, state.greatest + off, Real(0));
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
template <class Real, class = require_real<Real>> struct layer_grid
{
    Real axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

inline constexpr double layer_least_motion = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
// 2^-10: no layer is stretched as if it were thinner
inline constexpr double layer_least_depths = 0.0009765625;

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_grid<Real> layer_grid_make(layer_motion<Real> mean, std::type_identity_t<Real> guard,
                                                         std::type_identity_t<Real> texels)
{
    Real chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    mask_t<Real> moves = literal<Real>(layer_least_motion) <= chord;
    layer_grid<Real> g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, Real(1));
    g.axis_y = gnomon_select(moves, mean.d_y / chord, Real(0));
    g.motion = gnomon_select(moves, chord, Real(0));
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = Real(0.5) * texels;
    g.centre = Real(0.5) * (mean.least + mean.greatest);
    g.scale = Real(2) / gnomon_max(literal<Real>(layer_least_depths), mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
template <class Real, class = require_real<Real>> struct layer_place { Real u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_place<Real> layer_grid_turned(layer_grid<Real> grid, Real x, Real y)
{
    layer_place<Real> r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_place<Real> layer_grid_place(layer_grid<Real> grid, Real x, Real y, Real t)
{
    layer_place turned = layer_grid_turned(grid, x, y);
    layer_place<Real> r;
    r.u = grid.scale_u * (turned.u + grid.motion * (Real(0.5) - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_place_is_inside(layer_grid<Real> grid, layer_place<Real> place)
{
    Real texels = Real(2) * grid.middle;
    mask_t<Real> begun = Real(0) <= place.u && Real(0) <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, Real(1), Real(0));
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_grid_depth(layer_grid<Real> grid, Real z, Real t)
{
    return z + (Real(0.5) - t) * grid.d_z;
}

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_grid_own_depth(layer_grid<Real> grid, Real z, Real t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/layer_sums.h ------------------------------------------------------------------------------------------
// Sums that a texel of a layer's grid holds, and the visibility of a receiver through the layer (Andersson et al. 2015,
// Sec. 4.1 and 4.2). A sample in the layer or behind it has weight w = 1, one in front of the layer has none. A sample
// in the layer has opacity a = 1: where one sees past the layer, it is transparent. Per texel
//
//     variance       sums of w a z, w a z^2, w a, w                                layer_sums, Eq. 7
//     four moments   sums of w a z, ..., w a z^4, w a, w                           layer_moments4_sums
//     exponential    sums of w a exp(c z), w a, w                                  layer_exponential_sums
//
// where z is the layer's own depth, in [-1, 1] (layer_grid_own_depth). Filters and mip levels are linear in the sums.
// With the mean depths of what is opaque, Eq. 8, and the opacity a = sum w a / sum w, a layer lets through
//
//     V = 1 - a intensity                                                          Eq. 10
//
// and a receiver sees the product over all layers. A layer whose samples are all before the receiver has intensity 1,
// one whose samples are all behind has 0, with every bound. A sum of weights of 0 is no information: filters grow until
// there is some, and without any the layer counts as transparent.
//
//     share = layer_share_of(layer_of(layer_middle_depth(s), cuts), layer);
//     sums = layer_sums_add(sums, layer_grid_own_depth(grid, s.z, s.t), share);    into the texel at
// layer_grid_place(...)
//
//     visibility = 1, then visibility * layer_visibility(sums, layer_grid_own_depth(grid, z_r - bias, t_r), minimum)
//                                                                                  for all layers with their filtered
// sums
#ifndef GNOMON_MOTION_LAYERS_LAYER_SUMS_H
#define GNOMON_MOTION_LAYERS_LAYER_SUMS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Opacity and weight of a sample for a layer, each 0 or 1.
template <class Real, class = require_real<Real>> struct layer_share { Real opacity, weight; };

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_share<Real> layer_share_of(Real at, Real layer)
{
    layer_share<Real> r;
    r.opacity = gnomon_select(at == layer, Real(1), Real(0));
    r.weight = gnomon_select(layer <= at, Real(1), Real(0));
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
template <class Real, class = require_real<Real>> struct layer_sums { Real z, zz, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_sums<Real> layer_sums_add(layer_sums<Real> sums, Real z, layer_share<Real> share)
{
    Real a = share.weight * share.opacity;
    Real x = clamp_or_high(z, Real(-1), Real(1));
    sums.z = sums.z + a * x;
    sums.zz = sums.zz + a * (x * x);
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility 1 - a intensity through a layer, where a = opacity / weight is its opacity and intensity is a bound
/// on the share of its samples before a receiver at the layer's own depth z: 1 behind all of them, 0 in front of all of
/// them.
/// NaN: 1.
/// Source: Andersson 2015, Eq. 10
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_transmission(Real opacity, Real weight, Real intensity, Real z)
{
    Real bound = gnomon_select(Real(1) < z, Real(1), gnomon_select(Real(-1) < z, intensity, Real(0)));
    Real known = gnomon_select(Real(0) < weight, saturate_or_zero(opacity / weight), Real(0));
    return Real(1) - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight
/// of 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_visibility(layer_sums<Real> sums, Real z,
                                              std::type_identity_t<Real> minimum_variance)
{
    variance_moments<Real> b;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
template <class Real, class = require_real<Real>> struct layer_moments4_sums { Real b1, b2, b3, b4, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_moments4_sums<Real> layer_moments4_add(layer_moments4_sums<Real> sums, Real z,
                                                                     layer_share<Real> share)
{
    Real a = share.weight * share.opacity;
    moments4 b = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    sums.b1 = sums.b1 + a * b.b1;
    sums.b2 = sums.b2 + a * b.b2;
    sums.b3 = sums.b3 + a * b.b3;
    sums.b4 = sums.b4 + a * b.b4;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

inline constexpr double layer_moments4_noise = 3.3e-8; // 1.1 times 2^-25, one rounding to float
inline constexpr double layer_moments4_weight = 3e-7;  // the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one
/// more, and those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and
/// so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_moments4_visibility(layer_moments4_sums<Real> sums, Real z,
                                                       std::type_identity_t<Real> roundings)
{
    Real share = Real(1) / sums.opacity;
    moments4<Real> b;
    b.b1 = sums.b1 * share;
    b.b2 = sums.b2 * share;
    b.b3 = sums.b3 * share;
    b.b4 = sums.b4 * share;
    Real n = gnomon_max(Real(1), roundings) * (sums.weight * share);
    Real alpha = bias_weight_of_roundings(literal<Real>(layer_moments4_weight), n);
    moments4<Real> noise;
    noise.b1 = n * literal<Real>(layer_moments4_noise);
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    hankel4 h = hankel4_constant_bias(b, literal<Real>(bias4_raw_b2), literal<Real>(bias4_raw_b4), alpha);
    Real intensity = certified4_constant_bias_lower(h, noise, literal<Real>(bias4_raw_b2), literal<Real>(bias4_raw_b4),
                                                    alpha, z);
    return layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
template <class Real, class = require_real<Real>> struct layer_exponential_sums { Real warped, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_exponential_sums<Real> layer_exponential_add(layer_exponential_sums<Real> sums, Real z,
                                                                           layer_share<Real> share,
                                                                           exponential_settings<Real> settings)
{
    Real a = share.weight * share.opacity;
    sums.warped = sums.warped + a * exponential_encode(z, settings).warped;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Markov's bound. A weight of
/// 0 gives 1, a weight without opacity gives 1.
/// Domain: any z; settings as for exponential_intensity.
/// NaN: 1.
/// Error: (c + n + 7) 2^-p, c the exponent, for sums over n samples.
/// Source: Andersson 2015, Eq. 10; Annen 2008
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_exponential_visibility(layer_exponential_sums<Real> sums, Real z,
                                                          exponential_settings<Real> settings)
{
    exponential_moment<Real> b;
    b.warped = sums.warped / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
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
