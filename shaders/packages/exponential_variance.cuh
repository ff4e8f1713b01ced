// Gnomon 0.1.0, exponential_variance.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_EXPONENTIAL_VARIANCE_CUH
#define GNOMON_EXPONENTIAL_VARIANCE_CUH

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
#error "gnomon: exponential_variance.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: exponential_variance.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: exponential_variance.cuh is not of the same version as a package before it"
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

// filters/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps (Lauritzen & McCool 2008; Peters et al. 2017, 2.2): variance shadow maps of two
// warped depths, exp(c+ z) and -exp(-c- z), both increasing, so both give a lower bound on the shadow intensity, and
// the larger one holds too.
#ifndef GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H
#define GNOMON_FILTERS_EXPONENTIAL_VARIANCE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// First and second moment of either warped depth.
template <class Real, class = require_real<Real>>
struct exponential_variance_moments { Real positive, positive_square, negative, negative_square; };

/// The exponents c+ and c-, and the minimum variance of the depth, before the warp. The paper has c+ = c- = 5.54 for
/// half floats, whose range exp(2 c) fills, and c+ = 40, c- = 5.54 for floats. In float exponents of at most 40
/// keep every product finite.
template <class Real, class = require_real<Real>>
struct exponential_variance_settings { Real positive_exponent, negative_exponent, minimum_variance; };

/// The warped moments of one depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Error: of each value, relative, (2 c + 4) 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr exponential_variance_moments<Real>
    exponential_variance_warp(Real z, exponential_variance_settings<Real> settings)
{
    exponential_variance_moments<Real> r;
    r.positive = polynomial_exp(settings.positive_exponent * z);
    r.positive_square = r.positive * r.positive;
    r.negative = -polynomial_exp(-settings.negative_exponent * z);
    r.negative_square = r.negative * r.negative;
    return r;
}

/// The warped moments of one depth z of the map.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of each value, relative, (2 c + 4) 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr exponential_variance_moments<Real>
    exponential_variance_encode(Real z, exponential_variance_settings<Real> settings)
{
    return exponential_variance_warp(clamp_or_high(z, Real(-1), Real(1)), settings);
}

/// Cantelli's bound with the minimum variance carried through the warp's derivative at the receiver: |c warped|.
/// Squares of a warped depth near 0 would be denormal, slow and inexact. Where receiver and mean are below 1 everything
/// is scaled by 2^50, exactly. A larger mean needs no scale, and its square could overflow.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_variance_side(variance_moments<Real> moments, Real warped, Real exponent,
                                                       Real minimum_variance)
{
    Real scale = gnomon_select(gnomon_max(gnomon_abs(warped), gnomon_abs(moments.mean)) < Real(1),
                               Real(1125899906842624.0), Real(1));
    moments.mean = moments.mean * scale;
    moments.square = moments.square * (scale * scale);
    Real slope = exponent * (warped * scale);
    return cantelli_lower(moments, warped * scale, minimum_variance * (slope * slope));
}

/// Shadow intensity in [0, 1] at depth z_f, never above percentage-closer filtering but for rounding.
/// Domain: any z_f, limited to [-1, 1]; exponents of at least 0, minimum_variance as of cantelli_lower. An exponent of
/// 0, or one so large that squares overflow, takes the bound of its own warp away. A negative one turns the order of
/// depths around.
/// NaN: a NaN receiver gives 0, lit; a NaN moment or exponent takes the bound of its own warp away, which leaves the
/// other's.
/// Error: that of cantelli_lower for the warped depths, with r = (2 c + 8) 2^-p, the larger of both.
/// Source: Lauritzen & McCool 2008; Peters 2017, Sec. 2.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_variance_intensity(exponential_variance_moments<Real> filtered, Real z_f,
                                                            exponential_variance_settings<Real> settings)
{
    variance_moments<Real> positive;
    positive.mean = filtered.positive;
    positive.square = filtered.positive_square;
    variance_moments<Real> negative;
    negative.mean = filtered.negative;
    negative.square = filtered.negative_square;
    exponential_variance_moments receiver = exponential_variance_warp(clamp_or_nan(z_f, Real(-1), Real(1)), settings);
    return gnomon_max(
        exponential_variance_side(positive, receiver.positive, settings.positive_exponent, settings.minimum_variance),
        exponential_variance_side(negative, receiver.negative, settings.negative_exponent, settings.minimum_variance));
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

// storage/exponential_variance.h --------------------------------------------------------------------------------------
// Exponential variance shadow maps in a storage format: from a depth to the channels of a texel, and from filtered
// channels to a shadow, with the exponents and the minimum variance of the format.
//
//   format      bytes   exponents   write                              read
//   4 x half      8     5.54 5.54   exponential_variance_half_encode    exponential_variance_half_intensity
//   4 x float    16     40   5.54   exponential_variance_float_encode   exponential_variance_float_intensity
//
// The exponents are those of Peters et al. 2017, Figure 4. The channels are the four members of
// exponential_variance_moments, in their order. The minimum variance is 99 e^2, as in storage/variance.h, with e three
// roundings of a depth: a relative rounding of r in a warped value moves the depth by r / c. To 4 x float the rounding
// of the depth, a float too, is added.
#ifndef GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H
#define GNOMON_STORAGE_EXPONENTIAL_VARIANCE_H

GNOMON_WARNINGS_OFF namespace gnomon {

// both; exp(2 c) fills a half
inline constexpr double exponential_variance_half_exponent = 5.54;
inline constexpr double exponential_variance_half_minimum_variance = 6.921468870293247e-6; // 99 (3 2^-11 / 5.54)^2
inline constexpr double exponential_variance_half_darkening = 0.01;
inline constexpr double exponential_variance_float_positive_exponent = 40.0;
inline constexpr double exponential_variance_float_negative_exponent = 5.54;
// 99 (3 2^-24 (1 + 1 / 5.54))^2
inline constexpr double exponential_variance_float_minimum_variance = 4.41137400169126e-12;
inline constexpr double exponential_variance_float_darkening = 0.01;

/// The channels of the filter with the given settings for a depth z.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> exponential_variance_to_channels(Real z,
                                                                         exponential_variance_settings<Real> settings)
{
    exponential_variance_moments b = exponential_variance_encode(z, settings);
    channels4<Real> c;
    c.c1 = b.positive;
    c.c2 = b.positive_square;
    c.c3 = b.negative;
    c.c4 = b.negative_square;
    return c;
}

/// The intensity of the filter with the given settings from its channels.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_variance_of_channels(channels4<Real> c, Real z_f,
                                                              exponential_variance_settings<Real> settings)
{
    exponential_variance_moments<Real> b;
    b.positive = c.c1;
    b.positive_square = c.c2;
    b.negative = c.c3;
    b.negative_square = c.c4;
    return exponential_variance_intensity(b, z_f, settings);
}

/// The four channels of a 4 x half texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> exponential_variance_half_encode(Real z)
{
    exponential_variance_settings<Real> settings;
    settings.positive_exponent = literal<Real>(exponential_variance_half_exponent);
    settings.negative_exponent = literal<Real>(exponential_variance_half_exponent);
    settings.minimum_variance = literal<Real>(exponential_variance_half_minimum_variance);
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x half texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_variance_half_intensity(channels4<Real> c, Real z_f)
{
    exponential_variance_settings<Real> settings;
    settings.positive_exponent = literal<Real>(exponential_variance_half_exponent);
    settings.negative_exponent = literal<Real>(exponential_variance_half_exponent);
    settings.minimum_variance = literal<Real>(exponential_variance_half_minimum_variance);
    return exponential_variance_of_channels(c, z_f, settings);
}

/// The four channels of a 4 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: as exponential_variance_encode.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels4<Real> exponential_variance_float_encode(Real z)
{
    exponential_variance_settings<Real> settings;
    settings.positive_exponent = literal<Real>(exponential_variance_float_positive_exponent);
    settings.negative_exponent = literal<Real>(exponential_variance_float_negative_exponent);
    settings.minimum_variance = literal<Real>(exponential_variance_float_minimum_variance);
    return exponential_variance_to_channels(z, settings);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 4 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit; a NaN channel takes the bound of its own warp away, which leaves the other's.
/// Error: as exponential_variance_intensity, for the given channels.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real exponential_variance_float_intensity(channels4<Real> c, Real z_f)
{
    exponential_variance_settings<Real> settings;
    settings.positive_exponent = literal<Real>(exponential_variance_float_positive_exponent);
    settings.negative_exponent = literal<Real>(exponential_variance_float_negative_exponent);
    settings.minimum_variance = literal<Real>(exponential_variance_float_minimum_variance);
    return exponential_variance_of_channels(c, z_f, settings);
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
