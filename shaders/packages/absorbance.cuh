// Gnomon 0.1.0, absorbance.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_ABSORBANCE_CUH
#define GNOMON_ABSORBANCE_CUH

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
#error "gnomon: absorbance.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: absorbance.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: absorbance.cuh is not of the same version as a package before it"
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

// numerics/quadratic.h ------------------------------------------------------------------------------------------------
// Roots of a x^2 + 2 b x + c without cancellation. The sum b + sign(b) sqrt(b^2 - a c) has terms of one sign and gives
// one root; the product of the roots, c / a, gives the other.
#ifndef GNOMON_NUMERICS_QUADRATIC_H
#define GNOMON_NUMERICS_QUADRATIC_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The two roots, in no particular order.
template <class Real, class = require_real<Real>> struct quadratic_result { Real first, second; };

/// Both roots of a x^2 + 2 b x + c; for complex roots, their common real part twice. One root is infinite if a is 0.
/// Domain: b^2 and a c neither overflow nor underflow.
/// NaN: a NaN gives at least one NaN root; a = b = c = 0 gives two.
/// Error: 4 ulp where a c <= b^2 / 2, by as many roundings.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr quadratic_result<Real> quadratic_roots(Real a, Real b, Real c)
{
    Real r = gnomon_sqrt(gnomon_max(b * b - a * c, Real(0)));
    Real t = gnomon_select(b > Real(0), -(b + r), r - b);
    quadratic_result<Real> x;
    x.first = t / a;
    x.second = c / t;
    return x;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/bounds.h ----------------------------------------------------------------------------------------------------
// The shadow intensity that is shown, from bounds on a depth distribution (Peters et al. 2017, Sec. 2.6 and 5.3).
#ifndef GNOMON_MOMENTS_BOUNDS_H
#define GNOMON_MOMENTS_BOUNDS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Bounds on the shadow intensity: lower <= Z(z < z_f) and Z(z <= z_f) <= upper = lower + weight, where weight is the
/// largest probability of depth z_f itself. All are in [0, 1], and 0 if a moment or the receiver's depth was NaN.
template <class Real, class = require_real<Real>> struct hamburger_bounds { Real lower, upper, weight; };

/// Shadow intensity lower + (1 - overestimation) weight, in [0, 1]. overestimation is the paper's beta, which
/// multiplies visibility: 1 never darkens a lit surface; 1/2 halves the worst error and suits single scattering.
/// Domain: overestimation in [0, 1], clamped.
/// NaN: an overestimation of NaN counts as 0; NaN bounds give 0, lit.
/// Source: Peters 2017, Sec. 5.3.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real bounds_intensity(hamburger_bounds<Real> bounds, std::type_identity_t<Real> overestimation)
{
    return saturate_or_zero(bounds.lower + (Real(1) - saturate_or_zero(overestimation)) * bounds.weight);
}

/// Over-darkened intensity min(1, intensity / strength), which removes light leaking of up to 1 - strength. The paper
/// uses a strength of 0.98.
/// Domain: strength in (0, 1]. For 0 the result is 1 where intensity is above 0; for a negative one 0; beyond 1 shadows
/// are lighter.
/// NaN: 0, lit.
/// Source: Annen 2007; Peters 2017, Sec. 2.6
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real over_darken(Real intensity, std::type_identity_t<Real> strength)
{
    return saturate_or_zero(intensity / strength);
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

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
// Shadow intensity from four moments: sharp bounds on Z(z < z_f) over all depth distributions Z with these moments
// (the Hamburger moment problem; Peters et al. 2017, Eq. 1 and Alg. 1), without solving for all nodes and weights.
//
// The Christoffel-Darboux kernel K(x, y) = sum_k P_k(x) P_k(y) / D_k of the factored Hankel matrix (hankel4.h)
// gives the canonical distribution with a node at z_f: the other two nodes are the roots of K(z_f, .), and a node
// at z has the weight w(z) = 1 / K(z, z). The number of nodes above z_f is the number of sign changes in
// P_0(z_f), P_1(z_f), P_2(z_f):
//     no node above:      lower = 1 - w_f
//     both nodes above:   lower = 0
//     one node above:     lower = w(smaller root)
// and upper = lower + w_f. Let x = z - mean, u = z_f - mean, V = D_1, N = D_1 D_2, W = V N and
// Q(x) = V P_2 = (V x - G) x - V^2. Then
//     w(z) = W / (W + x^2 N + Q(x)^2)
//     K(z_f, .) = 0:    a x^2 + 2 b x + c = 0,    a = Q V,    2 b = u N - Q G,    c = W - Q V^2,    Q = Q(u)
// If one root lies on each side, Q < 0, so r^2 = b^2 - a c is a sum of positive terms. The two nodes beside z_f have
// the weight E / (W + E) together, E = u^2 N + Q^2, and their mean balances z_f about the mean of all, which gives the
// weight of the smaller one without its root:
//     w(smaller root) = (E (r + b) - W u a) / (2 r (W + E))
// The whole takes one division and one square root.
#ifndef GNOMON_MOMENTS_HAMBURGER4_H
#define GNOMON_MOMENTS_HAMBURGER4_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2. The weights are in [0, 1] and sum to 1.
template <class Real, class = require_real<Real>>
struct distribution3 { Real depth0, depth1, depth2, weight0, weight1, weight2; };

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/hamburger4.h ------------------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_HAMBURGER4_4
#define GNOMON_MOMENTS_HAMBURGER4_4

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double hamburger4_scale = 72057594037927936.0;     // 2^56
inline constexpr double hamburger4_lower_scale = 281474976710656.0; // 2^48

/// The polynomial Q(x) = V P_2(mean + x).
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real hamburger4_q(hankel4<Real> h, Real x)
{
    return (h.variance * x - h.third) * x - h.variance * h.variance;
}

/// The weight of the node at mean + x, where q = Q(x).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger4_weight(hankel4<Real> h, Real x, Real q)
{
    Real w = h.variance * h.determinant;
    return w / (w + (x * x * h.determinant + q * q));
}

/// The quadratic a x^2 + 2 b x + c.
template <class Real, class = require_real<Real>> struct hamburger4_quadratic { Real a, b, c; };

/// The quadratic whose roots x are the other two nodes minus the mean, for u = z_f - mean and q = Q(u).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger4_quadratic<Real> hamburger4_other_nodes(hankel4<Real> h, Real u, Real q)
{
    // The power of two keeps the discriminant of a single depth, as small as 2^-139, from underflowing.
    Real n = h.determinant * literal<Real>(hamburger4_scale);
    Real s = q * literal<Real>(hamburger4_scale);
    hamburger4_quadratic<Real> r;
    r.a = s * h.variance;
    r.b = Real(0.5) * (u * n - s * h.third);
    r.c = h.variance * (n - r.a);
    return r;
}

/// Lower bound and weight of the receiver as fractions: lower = share / total, w_f = receiver / whole.
template <class Real, class = require_real<Real>> struct hamburger4_fractions { Real share, total, receiver, whole; };

/// Lower bound and weight of the receiver at z_f, clamped to [-1, 1], before division and clamping.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger4_fractions<Real> hamburger4_fractions_at(hankel4<Real> h, Real z_f)
{
    Real u = clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean;
    Real q = hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    Real s = literal<Real>(hamburger4_lower_scale) * q;
    Real n = literal<Real>(hamburger4_lower_scale) * h.determinant;
    Real un = u * n;
    Real a = s * h.variance;
    Real b = Real(0.5) * (un - s * h.third);
    Real r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    Real e = u * un + q * s;
    hamburger4_fractions<Real> f;
    f.receiver = h.variance * n;
    f.whole = f.receiver + e;
    mask_t<Real> between = q < Real(0);
    // Elsewhere u is never 0 and the quotient is e / whole with the sign of u: a negative lower bound is clamped to 0.
    f.share = gnomon_select(between, e * (r + b) - f.receiver * (u * a), e * u);
    f.total = gnomon_select(between, r + r, gnomon_abs(u)) * f.whole;
    return f;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, three depths and more: p99 1e-13, p99.9 2e-12
///     error, float, hankel4_constant_bias at 3e-7: p99 3e-5, p99.9 1e-4, max 5e-4
/// and against the kernel in double, with maxima found by climbing (tests/moments/honest_four.cpp),
///     error, float, hankel4_from_float: p99 3e-5, p99.9 1e-4, max 5e-4
///     error, float, hankel4_from_float_filtered: p99 2e-5, p99.9 5e-5, max 1e-4
///     error, float, hankel4_from_half: p99 3e-5, p99.9 1e-4, max 2e-3
///     error, float, hankel4_from_half_filtered: p99 1e-5, p99.9 3e-5, max 3e-4
///     error, float, hankel4_from_unorm16: p99 4e-4, p99.9 2e-3, max 5e-2
///     error, float, hankel4_from_unorm16_filtered: p99 2e-4, p99.9 6e-4, max 4e-3
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger4_lower(hankel4<Real> h, Real z_f)
{
    hamburger4_fractions f = hamburger4_fractions_at(h, z_f);
    return saturate_or_zero(f.share / f.total);
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver, for one division more than
/// the lower bound.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger4_lower.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger_bounds<Real> hamburger4_bounds(hankel4<Real> h, Real z_f)
{
    hamburger4_fractions f = hamburger4_fractions_at(h, z_f);
    hamburger_bounds<Real> r;
    r.lower = saturate_or_zero(f.share / f.total);
    r.weight = gnomon_min(saturate_or_zero(f.receiver / f.whole), Real(1) - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// The canonical distribution with a node at z_f. The other two depths are finite, at most 1024 from the mean, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr distribution3<Real> hamburger4_distribution(hankel4<Real> h, Real z_f)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real q = hamburger4_q(h, u);
    hamburger4_quadratic p = hamburger4_other_nodes(h, u, q);
    quadratic_result x = quadratic_roots(p.a, p.b, p.c);
    Real x1 = clamp_or_nan(x.first, Real(-1024), Real(1024));
    Real x2 = clamp_or_nan(x.second, Real(-1024), Real(1024));
    Real w0 = hamburger4_weight(h, u, q);
    Real w1 = hamburger4_weight(h, x1, hamburger4_q(h, x1));
    Real w2 = hamburger4_weight(h, x2, hamburger4_q(h, x2));
    Real sum = w0 + (w1 + w2);
    mask_t<Real> swapped = x2 < x1;
    mask_t<Real> known = sum > Real(0); // false for NaN
    distribution3<Real> d;
    d.depth0 = gnomon_select(known, z, Real(1));
    d.depth1 = gnomon_select(known, h.mean + gnomon_select(swapped, x2, x1), Real(1));
    d.depth2 = gnomon_select(known, h.mean + gnomon_select(swapped, x1, x2), Real(1));
    d.weight1 = gnomon_select(known, gnomon_select(swapped, w2, w1) / sum, Real(0));
    d.weight2 = gnomon_select(known, gnomon_select(swapped, w1, w2) / sum, Real(0));
    d.weight0 = saturate_or_zero(Real(1) - (d.weight1 + d.weight2));
    return d;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/translucency.h ----------------------------------------------------------------------------------------------
// Translucent occluders (Peters et al. 2017, Sec. 3): moments of the depth distribution in which each fragment of a
// stack has as weight the light that it takes away,
//     Z = sum_k weight_k delta(z_k),    weight_k = alpha_k prod of (1 - alpha_j) over the fragments j in front of k,
// so that Z(z < z_f) = 1 - prod of (1 - alpha_k) over z_k < z_f, the intensity of the stack's shadow. What is behind
// all fragments, an opaque surface or the far plane, has the rest of the weight.
//
//     back to front    b = the moments of the surface behind;  b = moments4_over(b, z, alpha) for each fragment
//     front to back    state = front_to_back_begin(alpha), then front_to_back_add(state, alpha): moments4_add the
//                      fragment's moments with state.weight, in the end those of the surface behind with
// state.transmittance
//
// A GPU blends back to front: over() of each channel, with the alpha of the fragment. Weights sum to 1, so that affine
// transforms commute with blending: channels of any format are blended as stored (passes/blend.hpp). For coloured
// occluders use one map for each channel of light, with the opacity for that light. In any order, a fragment that
// survives in a sample with probability alpha has this distribution as the mean over samples (stochastic transparency;
// Enderton et al. 2010).
//
// Every blend rounds to the format. Later blends shrink an error by 1 - alpha, so of n roundings by delta
//     delta (1 - (1 - alpha)^n) / alpha <= delta / alpha
// is left: blend_roundings, for storage/moments4_blended.h and moments6_blended.h. A least alpha hence limits the
// error, and fragments below it are discarded (alpha test). Where alpha |above - below| is less than half a code, a
// blend changes
// nothing: many faint fragments vanish, for which no bias makes up. Absorbance (absorbance.h) loses less of them.
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_H
#define GNOMON_MOMENTS_TRANSLUCENCY_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below.
/// An alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real over(Real below, Real above, Real alpha)
{
    Real a = saturate_or_zero(alpha);
    Real mixed = (Real(1) - a) * below + a * above;
    return gnomon_select(Real(0) < a, gnomon_select(a < Real(1), mixed, above), below);
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which
/// is the weight of what is behind them.
template <class Real, class = require_real<Real>> struct front_to_back { Real weight, transmittance; };

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr front_to_back<Real> front_to_back_begin(Real alpha)
{
    front_to_back<Real> state;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = Real(1) - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr front_to_back<Real> front_to_back_add(front_to_back<Real> state, Real alpha)
{
    Real a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (Real(1) - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
inline constexpr double alpha_test_one_percent = 0.01;

inline constexpr double blend_least_alpha = 5.9604644775390625e-8; // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real blend_roundings(Real least_alpha)
{
    return Real(1) / gnomon_max(saturate_or_zero(least_alpha), literal<Real>(blend_least_alpha));
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real blend_roundings_of_layers(Real least_alpha, Real layers)
{
    Real a = gnomon_max(saturate_or_zero(least_alpha), literal<Real>(blend_least_alpha));
    Real further = gnomon_max(Real(1), layers) - Real(1);
    Real few = (further + Real(1)) / (Real(1) + Real(0.5) * (further * a));
    return gnomon_min(few, Real(1) / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real blended_roundings(Real further, std::type_identity_t<Real> each)
{
    return Real(1) + each * gnomon_max(Real(0), further);
}

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
inline constexpr double blended_half_roundings = 2.0;
inline constexpr double blended_float_roundings = 3.5;

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/translucency.h, four moments --------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_4
#define GNOMON_MOMENTS_TRANSLUCENCY_4

GNOMON_WARNINGS_OFF namespace gnomon {

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments4<Real> moments4_over(moments4<Real> below, Real z, Real alpha)
{
    moments4 b = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/absorbance.h ------------------------------------------------------------------------------------------------
// Absorbance moments: translucent occluders without an order (Munstermann 2018; Sharpe 2018), which Peters et al.
// (2017, Sec. 3.1) leave out. The logarithm turns the product of transmittances into a sum,
//     transmittance before z = prod of (1 - alpha_k) over z_k < z = exp(-sum of a_k over z_k < z),    a_k = -ln(1 -
// alpha_k) so fragments are added, in any order, as their absorbance times the powers of their depth: b_j = sum_k a_k
// z_k^j, with b_0 kept. b_j / b_0 are moments of a depth distribution Z, and exp(-b_0 Z(z < z_f)) is the transmittance.
//
//     map            b = absorbance4_add(b, absorbance4_of_fragment(z, alpha)) from zeros, by additive blending
//     receiver       absorbance4_transmittance(b, ...) and transmitted_intensity with the shadow of the opaque
// occluders
//
// Opaque occluders are in a map of their own: their absorbance is infinite, and filtered with that of others it would
// shadow all of the filter region. For the same reason a filter over absorbances is darker than the mean transmittance,
// exp(-mean a) <= mean exp(-a), and near it only where absorbance varies little in the filter region. Fragments behind
// an opaque occluder are added, too: then both maps are independent, and their transmittances multiply.
#ifndef GNOMON_MOMENTS_ABSORBANCE_H
#define GNOMON_MOMENTS_ABSORBANCE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Sums of absorbance times powers of depth, b0 to b4.
template <class Real, class = require_real<Real>> struct absorbance4 { Real b0, b1, b2, b3, b4; };

inline constexpr double absorbance_most = 16.0;

/// The absorbance -ln(1 - alpha) of a fragment, at most 16, for which 1e-7 of the light is left.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: 0, no fragment.
/// Error: 2 2^-p / (1 - alpha), absolute.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real absorbance_of_opacity(Real alpha)
{
    Real absorbed = Real(-1) * polynomial_log(Real(1) - saturate_or_zero(alpha));
    return gnomon_min(absorbed, literal<Real>(absorbance_most));
}

/// The absorbance moments of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Munstermann 2018
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr absorbance4<Real> absorbance4_of_fragment(Real z, Real alpha)
{
    Real a = absorbance_of_opacity(alpha);
    moments4 m = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    absorbance4<Real> b;
    b.b0 = a;
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of fragments together.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr absorbance4<Real> absorbance4_add(absorbance4<Real> sum, absorbance4<Real> b)
{
    sum.b0 = sum.b0 + b.b0;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

inline constexpr double absorbance_least = 7.62939453125e-6; // 2^-17

/// The factored matrix of the depths that absorb, with a constant bias of weight alpha (bias.h). Errors of sums are
/// meant in relation to b0. Of a b0 below 2^-17, which absorbs nothing to speak of, the depths are not told.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r).
/// NaN: stays NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> absorbance4_factor(absorbance4<Real> b, std::type_identity_t<Real> alpha)
{
    Real scale = Real(1) / gnomon_max(literal<Real>(absorbance_least), b.b0);
    moments4<Real> m;
    m.b1 = b.b1 * scale;
    m.b2 = b.b2 * scale;
    m.b3 = b.b3 * scale;
    m.b4 = b.b4 * scale;
    return hankel4_constant_bias(m, literal<Real>(bias4_raw_b2), literal<Real>(bias4_raw_b4), alpha);
}

inline constexpr double absorbance_scale = 5.421010862427522170037e-20; // 2^-64

/// The transmittance in [0, 1] of absorbance b0 of which the share before the receiver is an intensity, as of
/// bounds_intensity.
/// Domain: b0 >= 0, clamped; intensity in [0, 1], clamped.
/// NaN: 1, lit.
/// Error: 2^-p (2 + 2 b0), relative.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real absorbance_transmittance(Real b0, Real intensity)
{
    // No comparison with NaN, which Metal's fast mathematics would lose. Scaling by a power of two changes no bits.
    Real absorbed = saturate_or_zero(b0 * literal<Real>(absorbance_scale)) * Real(18446744073709551616.0);
    Real t = polynomial_exp(Real(-1) * (absorbed * saturate_or_zero(intensity)));
    return gnomon_min(t, Real(1));
}

/// The share of the absorbance in front of z_f by the bounds on it, less what the bias of weight alpha has put there.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real absorbance4_intensity(hankel4<Real> h, std::type_identity_t<Real> alpha,
                                                   std::type_identity_t<Real> overestimation, Real z_f)
{
    return (bounds_intensity(hamburger4_bounds(h, z_f), overestimation) - alpha) / (Real(1) - alpha);
}

/// The transmittance in [0, 1] at depth z_f of all fragments in front of it. alpha is the weight of the constant
/// bias, of which the part in front is taken off again, since b0 would multiply it. overestimation is that of
/// bounds_intensity: 1 for surfaces, which are never darkened, and 1/2 for receivers among the fragments.
/// Domain: alpha in (0, 1), at least n delta / (n delta + r); any z_f, limited to [-1, 1]; overestimation in [0, 1],
/// clamped.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real absorbance4_transmittance(absorbance4<Real> b, std::type_identity_t<Real> alpha,
                                                       std::type_identity_t<Real> overestimation, Real z_f)
{
    return absorbance_transmittance(b.b0,
                                    absorbance4_intensity(absorbance4_factor(b, alpha), alpha, overestimation, z_f));
}

/// Shadow intensity in [0, 1] behind opaque occluders, which give the intensity `opaque`, and translucent ones of the
/// given
/// transmittance: 1 - (1 - opaque) transmittance.
/// Domain: both in [0, 1], clamped.
/// NaN: an intensity of NaN counts as 0 and a transmittance of NaN as 1, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real transmitted_intensity(Real opaque, Real transmittance)
{
    Real absorbed = saturate_or_zero(Real(1) - transmittance);
    Real o = saturate_or_zero(opaque);
    return o + (Real(1) - o) * absorbed;
}

/// Absorbances for three channels of light, whose depths share one distribution: the moments b1 to b4 have the mean of
/// the three as absorbance.
template <class Real, class = require_real<Real>>
struct coloured_absorbance4 { Real red, green, blue, b1, b2, b3, b4; };

/// Transmittances, each in [0, 1].
template <class Real, class = require_real<Real>> struct coloured_transmittance { Real red, green, blue; };

inline constexpr double absorbance_third = 0.33333333333333331;

/// The absorbance moments of a coloured fragment at depth z: red, green and blue are its opacities.
/// Domain: any z, limited to [-1, 1]; any opacities, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an opacity of NaN counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr coloured_absorbance4<Real> coloured_absorbance4_of_fragment(Real z, Real red, Real green,
                                                                                    Real blue)
{
    coloured_absorbance4<Real> b;
    b.red = absorbance_of_opacity(red);
    b.green = absorbance_of_opacity(green);
    b.blue = absorbance_of_opacity(blue);
    Real a = literal<Real>(absorbance_third) * (b.red + (b.green + b.blue));
    moments4 m = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    b.b1 = a * m.b1;
    b.b2 = a * m.b2;
    b.b3 = a * m.b3;
    b.b4 = a * m.b4;
    return b;
}

/// The absorbance moments of two sets of coloured fragments together.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr coloured_absorbance4<Real> coloured_absorbance4_add(coloured_absorbance4<Real> sum,
                                                                            coloured_absorbance4<Real> b)
{
    sum.red = sum.red + b.red;
    sum.green = sum.green + b.green;
    sum.blue = sum.blue + b.blue;
    sum.b1 = sum.b1 + b.b1;
    sum.b2 = sum.b2 + b.b2;
    sum.b3 = sum.b3 + b.b3;
    sum.b4 = sum.b4 + b.b4;
    return sum;
}

/// The transmittances at depth z_f, from one distribution of depth for all channels: right in front of all fragments,
/// behind all, and wherever their hues are alike. The arguments are those of absorbance4_transmittance.
/// Domain: as of absorbance4_transmittance.
/// NaN: 1, lit; an overestimation of NaN counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr coloured_transmittance<Real>
    coloured_absorbance4_transmittance(coloured_absorbance4<Real> b, std::type_identity_t<Real> alpha,
                                       std::type_identity_t<Real> overestimation, Real z_f)
{
    absorbance4<Real> shared_depths;
    shared_depths.b0 = literal<Real>(absorbance_third) * (b.red + (b.green + b.blue));
    shared_depths.b1 = b.b1;
    shared_depths.b2 = b.b2;
    shared_depths.b3 = b.b3;
    shared_depths.b4 = b.b4;
    Real intensity = absorbance4_intensity(absorbance4_factor(shared_depths, alpha), alpha, overestimation, z_f);
    coloured_transmittance<Real> t;
    t.red = absorbance_transmittance(b.red, intensity);
    t.green = absorbance_transmittance(b.green, intensity);
    t.blue = absorbance_transmittance(b.blue, intensity);
    return t;
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

// storage/moments4.h --------------------------------------------------------------------------------------------------
// Four moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow.
// Each format undoes its own transform and allows for what its storage rounds, so that nobody pairs the wrong ones.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   4 x 16 UNORM      8     theta4      moments4_unorm16_encode   moments4_unorm16_intensity   hankel4_from_unorm16
//   4 x half          8     theta4 - .5 moments4_half_encode      moments4_half_intensity      hankel4_from_half
//   4 x float        16     none        moments4_float_encode     moments4_float_intensity     hankel4_from_float
//
// Filters are linear: average channels as they are. X_intensity and hankel4_from_X allow for one rounding: of channels
// that are stored once and filtered without further rounding, as 16-bit texels by a texture unit that returns floats.
// Texels of floats round again there and need X_filtered. X_filtered_intensity and hankel4_from_X_filtered allow for a
// pass along rows and one along columns, of nine taps at most, that store their results in the format again, half
// floats truncated or rounded. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by at most
//   X_intensity         stored4_arithmetic_weight, the error of float arithmetic
//   hankel4_from_X      the weight of the constant bias, roundings * delta / r (bias.h), and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/moments/honest_four.cpp). Certificates (certified4.h)
// leak less than a constant bias in every format. Float arithmetic moves the nodes of a certificate, which costs or
// gains a little leaking. Difference of an intensity in float from the intensity in double:
//     error, float, moments4_float_intensity: p99 3e-5, p99.9 1e-4, max 5e-4
//     error, float, moments4_float_filtered_intensity: p99 1e-5, p99.9 5e-5, max 2e-4
//     error, float, moments4_half_intensity: p99 5e-5, p99.9 4e-4, max 2e-2
//     error, float, moments4_half_filtered_intensity: p99 3e-5, p99.9 2e-4, max 2e-3
//     error, float, moments4_unorm16_intensity: p99 6e-4, p99.9 7e-3, max 3e-1
//     error, float, moments4_unorm16_filtered_intensity: p99 3e-4, p99.9 3e-3, max 3e-2
#ifndef GNOMON_STORAGE_MOMENTS4_H
#define GNOMON_STORAGE_MOMENTS4_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The four channels of a 4 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> moments4_unorm16_encode(Real z)
{
    return theta4(moments4_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The channels c, each with shift added.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> channels4_shifted(channels4<Real> c, std::type_identity_t<Real> shift)
{
    c.c1 = c.c1 + shift;
    c.c2 = c.c2 + shift;
    c.c3 = c.c3 + shift;
    c.c4 = c.c4 + shift;
    return c;
}

/// The multiple of 2^-12 that is nearest to x. In [-1/2, 1/2] half floats hold every multiple.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real half_nearest(Real x) { return Real(0.000244140625) * nearest_integer(Real(4096) * x); }

/// The four channels of a 4 x half texel of a depth z, each in [-1/2, 1/2]. They are half floats already, since devices
/// may truncate what they store.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Eq. 3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels4<Real> moments4_half_encode(Real z)
{
    channels4 c = channels4_shifted(moments4_unorm16_encode(z), Real(-0.5));
    c.c1 = half_nearest(c.c1);
    c.c2 = half_nearest(c.c2);
    c.c3 = half_nearest(c.c3);
    c.c4 = half_nearest(c.c4);
    return c;
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels4<Real> moments4_float_encode(Real z)
{
    return channels4_from_moments(moments4_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

inline constexpr double stored4_unorm16_weight = 3.6e-5;
inline constexpr double stored4_unorm16_filtered_weight = 1.1e-4;
inline constexpr double stored4_half_weight = 5.7e-4;
inline constexpr double stored4_half_filtered_weight = 2.85e-3;
inline constexpr double stored4_float_weight = 3e-7;
inline constexpr double stored4_float_filtered_weight = 2e-6;
inline constexpr double stored4_arithmetic_weight = 1e-6;

/// The factored matrix of the channels of theta4, with a constant bias of weight alpha.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_theta(channels4<Real> c, std::type_identity_t<Real> alpha)
{
    return hankel4_from_moments(theta4_inverse_add_bias(c, literal<Real>(bias4_theta_b2), alpha));
}

/// The factored matrix of the channels of a 4 x float texel, with a constant bias of weight alpha.
/// Domain: alpha from 3e-7 on.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_stored_as_float(channels4<Real> c, std::type_identity_t<Real> alpha)
{
    return hankel4_constant_bias(moments4_from_channels(c), literal<Real>(bias4_raw_b2), literal<Real>(bias4_raw_b4),
                                 alpha);
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_unorm16(channels4<Real> c)
{
    return hankel4_from_theta(c, literal<Real>(stored4_unorm16_weight));
}

/// The factored matrix of the channels of a 4 x 16 UNORM texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_unorm16_filtered(channels4<Real> c)
{
    return hankel4_from_theta(c, literal<Real>(stored4_unorm16_filtered_weight));
}

/// The factored matrix of the channels of a 4 x half texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_half(channels4<Real> c)
{
    return hankel4_from_theta(channels4_shifted(c, Real(0.5)), literal<Real>(stored4_half_weight));
}

/// The factored matrix of the channels of a 4 x half texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_half_filtered(channels4<Real> c)
{
    return hankel4_from_theta(channels4_shifted(c, Real(0.5)), literal<Real>(stored4_half_filtered_weight));
}

/// The factored matrix of the channels of a 4 x float texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_float(channels4<Real> c)
{
    return hankel4_stored_as_float(c, literal<Real>(stored4_float_weight));
}

/// The factored matrix of the channels of a 4 x float texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel4<Real> hankel4_from_float_filtered(channels4<Real> c)
{
    return hankel4_stored_as_float(c, literal<Real>(stored4_float_filtered_weight));
}

// The error of each channel that certificates allow for, and the weight of the bias of their nodes. Every weight is
// honest. These leak least without specks: noise puts specks into contact shadows where a weight is too small.
inline constexpr double certified4_unorm16_noise = 8e-6; // half a code, and the error of theta4 in float
inline constexpr double certified4_unorm16_filtered_noise = 2.4e-5;
inline constexpr double certified4_unorm16_weight = 3.6e-5;
inline constexpr double certified4_unorm16_filtered_weight = 9e-5;
inline constexpr double certified4_half_noise = 1.225e-4;         // 2^-13, and the error of theta4 in float
inline constexpr double certified4_half_filtered_noise = 6.12e-4; // passes may truncate: 2^-12 each
inline constexpr double certified4_half_weight = 6e-4;
inline constexpr double certified4_half_filtered_weight = 2.3e-3;
inline constexpr double certified4_float_noise = 3.3e-8;                        // 1.1 times 2^-25
inline constexpr double certified4_float_filtered_noise = 2.384185791015625e-7; // 8 times: sums of nine taps round, too
inline constexpr double certified4_float_weight = 3e-7;
inline constexpr double certified4_float_filtered_weight = 1.5e-6;

/// Shadow intensity at z_f from channels c of theta4, each off by at most noise, by nodes with a bias of weight alpha.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_theta_intensity(channels4<Real> c, std::type_identity_t<Real> noise,
                                                      std::type_identity_t<Real> alpha, Real z_f)
{
    return certified4_theta_lower(hankel4_from_theta(c, alpha), c, noise, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_unorm16_intensity(channels4<Real> c, Real z_f)
{
    return moments4_theta_intensity(c, literal<Real>(certified4_unorm16_noise),
                                    literal<Real>(certified4_unorm16_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_unorm16_filtered_intensity(channels4<Real> c, Real z_f)
{
    return moments4_theta_intensity(c, literal<Real>(certified4_unorm16_filtered_noise),
                                    literal<Real>(certified4_unorm16_filtered_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_half_intensity(channels4<Real> c, Real z_f)
{
    return moments4_theta_intensity(channels4_shifted(c, Real(0.5)), literal<Real>(certified4_half_noise),
                                    literal<Real>(certified4_half_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_half_filtered_intensity(channels4<Real> c, Real z_f)
{
    return moments4_theta_intensity(channels4_shifted(c, Real(0.5)), literal<Real>(certified4_half_filtered_noise),
                                    literal<Real>(certified4_half_filtered_weight), z_f);
}

/// Shadow intensity at z_f from the channels of a 4 x float texel, each off by at most its entry in noise, by nodes
/// with a bias of weight alpha.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_float_intensity_with_noise(channels4<Real> c, moments4<Real> noise,
                                                                 std::type_identity_t<Real> alpha, Real z_f)
{
    return certified4_constant_bias_lower(hankel4_stored_as_float(c, alpha), noise, literal<Real>(bias4_raw_b2),
                                          literal<Real>(bias4_raw_b4), alpha, z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_float_intensity(channels4<Real> c, Real z_f)
{
    return moments4_float_intensity_with_noise(
        c, moments4_rounding(moments4_from_channels(c), literal<Real>(certified4_float_noise)),
        literal<Real>(certified4_float_weight), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments4_float_filtered_intensity(channels4<Real> c, Real z_f)
{
    return moments4_float_intensity_with_noise(
        c, moments4_rounding_filtered(moments4_from_channels(c), literal<Real>(certified4_float_filtered_noise)),
        literal<Real>(certified4_float_filtered_weight), z_f);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// storage/absorbance4.h -----------------------------------------------------------------------------------------------
// Absorbance moments in a storage format: from a fragment to the channels of a texel, which additive blending sums in
// any order, and from filtered channels to a transmittance.
//
//   format      bytes   channels               write                      read
//   5 x half     10     theta4 - .5, times b0  absorbance4_half_encode    absorbance4_half_transmittance
//   5 x float    20     b1 to b4               absorbance4_float_encode   absorbance4_float_transmittance
//
// The fifth channel is b0; a texture of four channels and one of a single channel hold a texel. Maps are cleared to 0.
//
// additions is the number of fragments that were added to a texel, and of filter passes that store their results in the
// format. Each rounds b0 and the channels in relation to a sum that never falls, so that errors in relation to b0 add
// up to additions times those of one: 4 roundings of floats (bias.h), or 8 of half floats, which may be truncated. A
// fragment's own channels, and the division by b0, take 12 roundings of floats. Beside the bounds b0 itself is off by
// 2^-24 of its value for each addition, or 2^-10 for half floats, to the lit side where they are truncated.
#ifndef GNOMON_STORAGE_ABSORBANCE4_H
#define GNOMON_STORAGE_ABSORBANCE4_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The five channels of a 5 x float texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels5<Real> absorbance4_float_encode(Real z, Real alpha)
{
    absorbance4 b = absorbance4_of_fragment(z, alpha);
    channels5<Real> c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b0;
    return c;
}

/// The five channels of a 5 x half texel of a fragment at depth z of opacity alpha.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels5<Real> absorbance4_half_encode(Real z, Real alpha)
{
    Real a = absorbance_of_opacity(alpha);
    channels4 s = channels4_shifted(moments4_unorm16_encode(z), Real(-0.5));
    channels5<Real> c;
    c.c1 = a * s.c1;
    c.c2 = a * s.c2;
    c.c3 = a * s.c3;
    c.c4 = a * s.c4;
    c.c5 = a;
    return c;
}

inline constexpr double absorbance4_half_additions = 8.0;
inline constexpr double absorbance4_half_least = 1.220703125e-4; // 2^-13: below, half floats are denormal
inline constexpr double absorbance4_float_additions = 4.0;
inline constexpr double absorbance4_float_more = 3.0; // 12 / 4

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x float texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real absorbance4_float_transmittance(channels5<Real> c, std::type_identity_t<Real> additions,
                                                             std::type_identity_t<Real> overestimation, Real z_f)
{
    absorbance4<Real> b;
    b.b0 = c.c5;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    Real n = blended_roundings(additions + literal<Real>(absorbance4_float_more),
                               literal<Real>(absorbance4_float_additions));
    return absorbance4_transmittance(b, bias_weight_of_roundings(literal<Real>(stored4_float_weight), n),
                                     overestimation, z_f);
}

/// The transmittance in [0, 1] at depth z_f from the channels of a 5 x half texel. overestimation is that of
/// bounds_intensity: 1 for surfaces, 1/2 for receivers among the fragments.
/// Domain: additions >= 0, clamped; overestimation in [0, 1], clamped; any z_f, limited to [-1, 1].
/// NaN: 1, lit; an overestimation of NaN counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real absorbance4_half_transmittance(channels5<Real> c, std::type_identity_t<Real> additions,
                                                            std::type_identity_t<Real> overestimation, Real z_f)
{
    Real scale = Real(1) / gnomon_max(literal<Real>(absorbance4_half_least), c.c5);
    channels4<Real> s;
    s.c1 = c.c1 * scale;
    s.c2 = c.c2 * scale;
    s.c3 = c.c3 * scale;
    s.c4 = c.c4 * scale;
    Real weight = bias_weight_of_roundings(literal<Real>(stored4_half_weight),
                                           blended_roundings(additions, literal<Real>(absorbance4_half_additions)));
    hankel4 h = hankel4_from_theta(channels4_shifted(s, Real(0.5)), weight);
    return absorbance_transmittance(c.c5, absorbance4_intensity(h, weight, overestimation, z_f));
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
