// Gnomon 0.1.0, rectified_frustum.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RECTIFIED_FRUSTUM_CUH
#define GNOMON_RECTIFIED_FRUSTUM_CUH

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
#error "gnomon: rectified_frustum.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: rectified_frustum.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: rectified_frustum.cuh is not of the same version as a package before it"
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

// numerics/trigonometry.h ---------------------------------------------------------------------------------------------
// Cosine, sine and the angle of a vector with the same bits in every language.
//
// Angles are reduced to |y| <= pi / 4 by multiples of pi / 2 in three parts, the first two of so few bits that their
// multiples are exact (Cody & Waite 1980). A minimax polynomial approximates the function on the reduced range: a short
// one for float, a long one for double. tests/derivations/minimax.cpp prints the coefficients of both.
#ifndef GNOMON_NUMERICS_TRIGONOMETRY_H
#define GNOMON_NUMERICS_TRIGONOMETRY_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double trigonometry_two_over_pi = 0.63661977236758134;
inline constexpr double trigonometry_half_pi_low = 7.5497899548918821e-8;
inline constexpr double trigonometry_half_pi = 1.5707963267948966;
inline constexpr double trigonometry_quarter_pi_low = 1.5695823932524066e-7;
inline constexpr double trigonometry_tan_pi_8 = 0.41421356237309505;

// sin y = y + y^3 p(y^2), |y| <= pi / 4: relative error 2^-26.8 and 2^-56.4, coefficients rounded.
inline constexpr double sin_float_0 = -0.16666654609567105;
inline constexpr double sin_float_1 = 0.0083321607625195058;
inline constexpr double sin_float_2 = -0.00019515283258365583;
inline constexpr double sin_double_0 = -0.1666666666666663;
inline constexpr double sin_double_1 = 0.0083333333333221182;
inline constexpr double sin_double_2 = -0.00019841269829589566;
inline constexpr double sin_double_3 = 2.7557313621395315e-06;
inline constexpr double sin_double_4 = -2.5050747764366045e-08;
inline constexpr double sin_double_5 = 1.5896230244963151e-10;

// cos y = 1 - y^2 / 2 + y^4 p(y^2), |y| <= pi / 4: relative error 2^-32.4 and 2^-59.6.
inline constexpr double cos_float_0 = 0.041666645683017541;
inline constexpr double cos_float_1 = -0.0013887316256332952;
inline constexpr double cos_float_2 = 2.4433157272163749e-05;
inline constexpr double cos_double_0 = 0.041666666666666595;
inline constexpr double cos_double_1 = -0.0013888888888873056;
inline constexpr double cos_double_2 = 2.4801587288851717e-05;
inline constexpr double cos_double_3 = -2.7557314179299329e-07;
inline constexpr double cos_double_4 = 2.0875700842250843e-09;
inline constexpr double cos_double_5 = -1.135853653338706e-11;

// arctan y = y + y^3 p(y^2), |y| <= tan(pi / 8): relative error 2^-28.3 and 2^-57.4.
inline constexpr double atan_float_0 = -0.33333315189495832;
inline constexpr double atan_float_1 = 0.19998471559801789;
inline constexpr double atan_float_2 = -0.14243534037509495;
inline constexpr double atan_float_3 = 0.10593818186484773;
inline constexpr double atan_float_4 = -0.060782316918251741;
inline constexpr double atan_double_0 = -0.33333333333333198;
inline constexpr double atan_double_1 = 0.19999999999953252;
inline constexpr double atan_double_2 = -0.14285714280167142;
inline constexpr double atan_double_3 = 0.11111110782181728;
inline constexpr double atan_double_4 = -0.090908977259565496;
inline constexpr double atan_double_5 = 0.076920597289759696;
inline constexpr double atan_double_6 = -0.066630993254100657;
inline constexpr double atan_double_7 = 0.05847860099229632;
inline constexpr double atan_double_8 = -0.050391939209447408;
inline constexpr double atan_double_9 = 0.038062223780711196;
inline constexpr double atan_double_10 = -0.017905126733869233;

/// A cosine and the sine of the same angle.
template <class Real, class = require_real<Real>> struct cosine_sine { Real cosine, sine; };

/// cos x and sin x, in [-1, 1] up to the error.
/// Domain: [-8192, 8192]; x is clamped.
/// NaN: two NaNs.
/// Error: 1.5 ulp for |x| <= pi / 4, else 1.75 2^-p, where p is the number of bits of the significand.
/// Source: Cody & Waite 1980
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr cosine_sine<Real> polynomial_cosine_sine(Real x)
{
    x = clamp_or_nan(x, Real(-8192), Real(8192));
    Real n = nearest_integer(x * literal<Real>(trigonometry_two_over_pi));
    Real y = gnomon_difference(x, n * Real(1.5703125));
    y = gnomon_difference(y, n * Real(0.0004837512969970703125)) - n * literal<Real>(trigonometry_half_pi_low);
    Real z = y * y;
    Real s = literal<Real>(sin_float_0) + z * (literal<Real>(sin_float_1) + z * literal<Real>(sin_float_2));
    Real c = literal<Real>(cos_float_0) + z * (literal<Real>(cos_float_1) + z * literal<Real>(cos_float_2));
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        s = literal<Real>(sin_double_0) + z *
            (literal<Real>(sin_double_1) + z *
             (literal<Real>(sin_double_2) + z *
              (literal<Real>(sin_double_3) + z * (literal<Real>(sin_double_4) + z * literal<Real>(sin_double_5)))));
        c = literal<Real>(cos_double_0) + z *
            (literal<Real>(cos_double_1) + z *
             (literal<Real>(cos_double_2) + z *
              (literal<Real>(cos_double_3) + z * (literal<Real>(cos_double_4) + z * literal<Real>(cos_double_5)))));
    }
    s = y + y * z * s;
    c = (Real(1) - Real(0.5) * z) + z * z * c;

    // x = y + m pi / 2 plus full turns, with m in {-2, ..., 2}.
    Real m = n - Real(4) * nearest_integer(Real(0.25) * n);
    mask_t<Real> odd = gnomon_abs(m) == Real(1);
    mask_t<Real> opposite = gnomon_abs(m) == Real(2);
    cosine_sine<Real> r;
    r.cosine = gnomon_select(odd, -m * s, gnomon_select(opposite, -c, c));
    r.sine = gnomon_select(odd, m * c, gnomon_select(opposite, -s, s));
    return r;
}

/// cos x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real polynomial_cos(Real x) { return polynomial_cosine_sine(x).cosine; }

/// sin x.
/// Domain: as for polynomial_cosine_sine.
/// NaN: stays NaN.
/// Error: as for polynomial_cosine_sine.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real polynomial_sin(Real x) { return polynomial_cosine_sine(x).sine; }

/// The angle of the vector (x, y), in [-pi, pi]; 0 for the zero vector. Zeros of either sign count as positive.
/// Domain: |x| + |y| does not overflow, except that one of the two may be infinite.
/// NaN: for a NaN, and if both are infinite.
/// Error: 2.6 ulp, also where the result is denormal.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real polynomial_atan2(Real y, Real x)
{
    Real ax = gnomon_abs(x);
    Real ay = gnomon_abs(y);
    mask_t<Real> steep = ax < ay;
    Real shorter = gnomon_select(steep, ax, ay);
    Real longer = gnomon_select(steep, ay, ax);

    // Above tan(pi / 8), arctan q = pi / 4 + arctan((q - 1) / (q + 1)).
    mask_t<Real> wide = literal<Real>(trigonometry_tan_pi_8) * longer < shorter;
    Real denominator = gnomon_select(wide, longer + shorter, gnomon_select(longer == Real(0), Real(1), longer));
    Real t = gnomon_select(wide, shorter - longer, shorter) / denominator;
    Real z = t * t;
    Real p = literal<Real>(atan_float_0) + z *
             (literal<Real>(atan_float_1) + z *
              (literal<Real>(atan_float_2) + z * (literal<Real>(atan_float_3) + z * literal<Real>(atan_float_4))));
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        p = literal<Real>(atan_double_0) + z *
            (literal<Real>(atan_double_1) + z *
             (literal<Real>(atan_double_2) + z *
              (literal<Real>(atan_double_3) + z *
               (literal<Real>(atan_double_4) + z *
                (literal<Real>(atan_double_5) + z *
                 (literal<Real>(atan_double_6) + z *
                  (literal<Real>(atan_double_7) + z *
                   (literal<Real>(atan_double_8) + z *
                    (literal<Real>(atan_double_9) + z * literal<Real>(atan_double_10))))))))));
    }
    Real angle = t + t * z * p;

    // The result is angle + eighths pi / 4. pi / 4 has two parts, the first of 21 bits, whose multiples are exact.
    Real eighths = gnomon_select(wide, Real(1), Real(0));
    angle = gnomon_select(steep, Real(-1) * angle, angle);
    eighths = gnomon_select(steep, Real(2) - eighths, eighths);
    angle = gnomon_select(x < Real(0), Real(-1) * angle, angle);
    eighths = gnomon_select(x < Real(0), Real(4) - eighths, eighths);
    angle = eighths * Real(0.785398006439208984375) + (angle + eighths * literal<Real>(trigonometry_quarter_pi_low));
    return gnomon_select(y < Real(0), Real(-1) * angle, angle);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// scattering/rectified.h ----------------------------------------------------------------------------------------------
// Rectified coordinates of a shadow map of a directional light, in which all points of a view ray lie in one row and at
// one depth (Peters et al. 2017, Sec. 5.1.1 and App. A; Baran et al. 2010).
//
// Axes: x and y along the map, z along the propagation of light. Origin: the eye. Any unit of length.
//
//     radius  = |(x, y)|            distance between the eye and a light ray: column of the rectified map
//     azimuth = angle of (x, y)     slice that holds the light direction and the eye: row of the rectified map
//     polar   = atan2(radius, z)    angle between the view ray and the propagation of light, in [0, pi]
//
// Looking into the light is polar = pi. On a light ray z grows with depth, and polar falls with it. Hence a depth of
// the rectified map is a falling function of polar, signed as all depths of this library: -1 looking into the light, +1
// along it. There are two measures of depth: the angle itself, as in the paper, and its cosine, which needs no inverse
// trigonometry. Both are stretched to [-1, 1] over the range of the view rays and a guard band of 10%, so that an
// occluder outside of that range keeps a distance from all view rays.
//
//     omega_l    the direction to the light:  (0, 0, -1)
//     omega_p    the direction from a point of the view ray to the camera
//     dot product of the two = cosine of polar;  cosine of the scattering angle = -cosine of polar
//
// One texel of the rectified map is one light ray: position eye + radius (cos azimuth, sin azimuth) in the map, and its
// depth there as z leads to polar.
#ifndef GNOMON_SCATTERING_RECTIFIED_H
#define GNOMON_SCATTERING_RECTIFIED_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double rectified_guard = 0.55; // half of a range with a guard band of 10%
inline constexpr double rectified_pi = 3.1415926535897932;
inline constexpr double rectified_two_pi = 6.2831853071795865;

/// A distance from the eye across the light, and two angles.
template <class Real, class = require_real<Real>> struct rectified_position { Real radius, azimuth, polar; };

/// A map of angles, or of cosines, to depths: the value of depth 0, and depth per unit.
template <class Real, class = require_real<Real>> struct rectified_range { Real middle, scale; };

/// The rectified coordinates of a point: radius at least 0, azimuth in [-pi, pi], polar in [0, pi]. On the axis azimuth
/// is 0; polar of the eye is 0.
/// Domain: |x|, |y| and |z| are 0 or in [2^-60, 2^60] in float, [2^-500, 2^500] in double.
/// NaN: a NaN in each coordinate that depends on it.
/// Error: radius 2 2^-p relative; azimuth 2.6 ulp, polar 3.6 ulp.
/// Source: Peters 2017, Sec. 5.1.1; Baran 2010
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_position<Real> rectified_from_position(Real x, Real y, Real z)
{
    rectified_position<Real> r;
    r.radius = gnomon_sqrt(x * x + y * y);
    r.azimuth = polynomial_atan2(y, x);
    r.polar = polynomial_atan2(r.radius, z);
    return r;
}

/// The cosine of polar at a point, in [-1, 1]; 1 at the eye.
/// Domain: as for rectified_from_position.
/// NaN: NaN.
/// Error: 3 2^-p.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real rectified_cosine(Real x, Real y, Real z)
{
    Real distance_ = gnomon_sqrt((x * x + y * y) + z * z);
    mask_t<Real> at_eye = distance_ == Real(0);
    Real cosine = z / gnomon_select(at_eye, Real(1), distance_);
    return clamp_or_nan(gnomon_select(at_eye, Real(1), cosine), Real(-1), Real(1));
}

/// The range whose depths are in [-1 / 1.1, 1 / 1.1] from least to most, or in a part of that if most - least is below
/// narrowest.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_range<Real> rectified_range_over(Real least, Real most,
                                                                   std::type_identity_t<Real> narrowest)
{
    rectified_range<Real> r;
    r.middle = Real(0.5) * (least + most);
    r.scale = Real(1) / (literal<Real>(rectified_guard) * gnomon_max(most - least, narrowest));
    return r;
}

/// The range of depth for polar angles of view rays in [least, most].
/// Domain: least <= most, in [0, pi]. A range narrower than 2^-10, or reversed, is widened to 2^-10 around its middle.
/// NaN: a middle of NaN.
/// Source: Peters 2017, Sec. 5.1.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_range<Real> rectified_polar_range(Real least, Real most)
{
    return rectified_range_over(least, most, Real(0.0009765625));
}

/// The range of depth for cosines of polar angles of view rays in [least, most], which are those of the greatest and of
/// the least angle.
/// Domain: least <= most, in [-1, 1]. A range narrower than 2^-16, or reversed, is widened to 2^-16 around its middle.
/// NaN: a middle of NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_range<Real> rectified_cosine_range(Real least, Real most)
{
    return rectified_range_over(least, most, Real(0.0000152587890625));
}

/// Signed depth of a polar angle, in [-1, 1]: falls with the angle, -1 on the side of rays that look into the light.
/// Domain: polar in [0, pi], a range by rectified_polar_range.
/// NaN: NaN, which encoders store as the far plane.
/// Source: Peters 2017, Sec. 5.1.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_polar_depth(Real polar, rectified_range<Real> range)
{
    return clamp_or_nan((range.middle - polar) * range.scale, Real(-1), Real(1));
}

/// Signed depth of the cosine of a polar angle, in [-1, 1]: grows with the cosine, -1 on the side of rays that look
/// into the light.
/// Domain: cosine in [-1, 1], a range by rectified_cosine_range.
/// NaN: NaN, which encoders store as the far plane.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_cosine_depth(Real cosine, rectified_range<Real> range)
{
    return clamp_or_nan((cosine - range.middle) * range.scale, Real(-1), Real(1));
}

/// An angle within three half turns of 0, moved by a full turn to at most half a turn from 0.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real rectified_wrapped(Real angle)
{
    Real turn = literal<Real>(rectified_two_pi);
    Real half_turn = literal<Real>(rectified_pi);
    Real up = gnomon_select(angle + half_turn < Real(0), angle + turn, angle);
    return gnomon_select(half_turn < up, up - turn, up);
}

/// The position across the rows of a map, in [0, rows], of an azimuth; the centre of the first row is at 0.5. The map
/// begins at the azimuth start and spans the angle span; an azimuth outside is moved to the nearer end.
/// Domain: azimuth and start in [-pi, pi], span in [2^-20, 2 pi]; elsewhere a number in [0, rows].
/// NaN: NaN for an azimuth of NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_row_of(Real azimuth, std::type_identity_t<Real> start,
                                              std::type_identity_t<Real> span, std::type_identity_t<Real> rows)
{
    Real whole = gnomon_max(span, Real(0.00000095367431640625));
    Real from_middle = rectified_wrapped((azimuth - start) - Real(0.5) * whole);
    return clamp_or_nan((from_middle / whole + Real(0.5)) * rows, Real(0), rows);
}

/// The position along a row of prefix averages, at least 0, of a ray that ends at radius; the centre of the first texel
/// is at 0.5. The average up to the far side of texel u, radius (u + 1) radius_step, stands at its centre, u + 1/2: so
/// the position is half a texel before that of the light ray itself.
/// Domain: radius at least 0, radius_step above 0.
/// NaN: NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_column_of(Real radius, std::type_identity_t<Real> radius_step)
{
    return gnomon_max(Real(0), radius / radius_step - Real(0.5));
}

/// The greater extent of a texel of the rectified map at radius, in texels of the shadow map: along the row
/// radius_step, across it radius times azimuth_step, the angle between rows.
/// Domain: at least 0 each.
/// NaN: NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_footprint(Real radius, std::type_identity_t<Real> radius_step,
                                                 std::type_identity_t<Real> azimuth_step,
                                                 std::type_identity_t<Real> texels_per_length)
{
    return gnomon_max(radius_step, radius * azimuth_step) * texels_per_length;
}

/// The mip level, in [0, 16], whose texels are as wide as a footprint in texels of level 0.
/// Domain: any footprint.
/// NaN: 0.
/// Error: 2 2^-p of the largest level.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real rectified_level(Real footprint)
{
    Real wide = clamp_or_nan(footprint, Real(1), Real(65536));
    return clamp_or_high(polynomial_log(gnomon_max(wide, Real(1))) * literal<Real>(exp_log2_e), Real(0), Real(16));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// scattering/rectified_frustum.h --------------------------------------------------------------------------------------
// Bounds of rectified coordinates (rectified.h) over the view rays of a camera (Peters et al. 2017, App. A), from the
// four corners of its far plane, in order around it, in light axes with the eye for origin.
//
//     radius     largest radius of a corner
//     azimuth    angles of the corners relative to that of the farthest one: no two differ by more than half a turn
//     axis       where the light direction, or its opposite, is strictly within the four side planes: a full turn, and
// polar
//                begins at 0, or ends at pi
//     polar      extreme on the border of the far plane, else on the axis. On the edge a + t c the cosine z / |a + t c|
// is
//                extreme at   t = (a_z a.c - c_z a.a) / (c_z a.c - a_z c.c)
//                or at an end. Any point of the edge is within the bounds, so t needs no test: it is clamped.
//
// The angles of one row are the same over edges that are cut off at the row's two azimuths, each by the side on which
// a point of the edge lies: a fold over the far plane's border, whether the row holds corners or not.
#ifndef GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H
#define GNOMON_SCATTERING_RECTIFIED_FRUSTUM_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A corner of the far plane.
template <class Real, class = require_real<Real>> struct rectified_corner { Real x, y, z; };

/// Corners of the far plane, in order around it, either way.
template <class Real, class = require_real<Real>> struct rectified_corners { rectified_corner<Real> a, b, c, d; };

/// The bounds of a camera's view rays: radius in [0, radius], azimuth from azimuth_start on over azimuth_length, polar
/// from polar_least to polar_most.
template <class Real, class = require_real<Real>>
struct rectified_frustum { Real radius, azimuth_start, azimuth_length, polar_least, polar_most; };

/// An interval of polar angles.
template <class Real, class = require_real<Real>> struct rectified_interval { Real least, most; };

/// A part of an edge, from a fraction begin to a fraction end.
template <class Real, class = require_real<Real>> struct rectified_part { Real begin, end; };

template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_dot(rectified_corner<Real> a, rectified_corner<Real> b)
{
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// b - a.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_corner<Real> rectified_from_to(rectified_corner<Real> a, rectified_corner<Real> b)
{
    rectified_corner<Real> r;
    r.x = b.x - a.x;
    r.y = b.y - a.y;
    r.z = b.z - a.z;
    return r;
}

/// The z of the cross product of a and b: positive where the azimuth of b is up to half a turn beyond that of a.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_turn(rectified_corner<Real> a, rectified_corner<Real> b)
{
    return a.x * b.y - a.y * b.x;
}

/// 1 if the light direction is strictly within the far plane as seen from the eye, -1 if its opposite is, else 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_axis_side(rectified_corners<Real> q)
{
    Real ab = rectified_turn(q.a, q.b);
    Real bc = rectified_turn(q.b, q.c);
    Real cd = rectified_turn(q.c, q.d);
    Real da = rectified_turn(q.d, q.a);
    mask_t<Real> left = Real(0) < ab && Real(0) < bc && Real(0) < cd && Real(0) < da;
    mask_t<Real> right = ab < Real(0) && bc < Real(0) && cd < Real(0) && da < Real(0);
    // The normal of the far plane, by its diagonals, and the side of it on which the plane lies.
    rectified_corner s = rectified_from_to(q.a, q.c);
    rectified_corner t = rectified_from_to(q.b, q.d);
    Real nx = s.y * t.z - s.z * t.y;
    Real ny = s.z * t.x - s.x * t.z;
    Real side = (nx * q.a.x + ny * q.a.y) + rectified_turn(s, t) * q.a.z;
    Real sign = gnomon_select(side < Real(0), Real(-1), Real(1));
    return gnomon_select(left, sign, gnomon_select(right, Real(-1) * sign, Real(0)));
}

/// The angles so far and that of the point (x, y, z).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_add(rectified_interval<Real> bounds, Real x, Real y,
                                                                        Real z)
{
    Real polar = polynomial_atan2(gnomon_sqrt(x * x + y * y), z);
    bounds.least = gnomon_min(polar, bounds.least);
    bounds.most = gnomon_max(polar, bounds.most);
    return bounds;
}

/// The angles so far and that of the point a + t c.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_along(rectified_interval<Real> bounds,
                                                                          rectified_corner<Real> a,
                                                                          rectified_corner<Real> c, Real t)
{
    return rectified_interval_add(bounds, a.x + t * c.x, a.y + t * c.y, a.z + t * c.z);
}

/// The t of the extreme angle on a + t c, limited to a part; some t of it for an edge towards the eye or without
/// length.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_extreme(rectified_corner<Real> a, rectified_corner<Real> c, Real begin, Real end)
{
    Real ac = rectified_dot(a, c);
    Real t = (a.z * ac - c.z * rectified_dot(a, a)) / (c.z * ac - a.z * rectified_dot(c, c));
    return clamp_or_nan(gnomon_select(t == t, t, begin), begin, end);
}

/// The angles so far and those of the edge from a to b, without b.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_edge(rectified_interval<Real> bounds,
                                                                         rectified_corner<Real> a,
                                                                         rectified_corner<Real> b)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_add(bounds, a.x, a.y, a.z);
    return rectified_interval_along(r, a, c, rectified_extreme(a, c, Real(0), Real(1)));
}

/// The angles so far and those of a part of the edge from a to b; an empty part has none.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_part(rectified_interval<Real> bounds,
                                                                         rectified_corner<Real> a,
                                                                         rectified_corner<Real> b,
                                                                         rectified_part<Real> part)
{
    rectified_corner c = rectified_from_to(a, b);
    rectified_interval r = rectified_interval_along(bounds, a, c, part.begin);
    r = rectified_interval_along(r, a, c, part.end);
    r = rectified_interval_along(r, a, c, rectified_extreme(a, c, part.begin, part.end));
    mask_t<Real> empty = part.end < part.begin;
    r.least = gnomon_select(empty, bounds.least, r.least);
    r.most = gnomon_select(empty, bounds.most, r.most);
    return r;
}

/// The bounds before any edge, where axis is that of rectified_axis_side.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_begin(Real axis)
{
    rectified_interval<Real> r;
    r.least = gnomon_select(Real(0) < axis, Real(0), literal<Real>(rectified_pi));
    r.most = gnomon_select(axis < Real(0), literal<Real>(rectified_pi), Real(0));
    return r;
}

/// The interval, or [0, pi] if no angle was added.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_interval_end(rectified_interval<Real> bounds)
{
    mask_t<Real> none = bounds.most < bounds.least;
    bounds.least = gnomon_select(none, Real(0), bounds.least);
    bounds.most = gnomon_select(none, literal<Real>(rectified_pi), bounds.most);
    return bounds;
}

/// The farther from the axis of two corners, the first where they are equal or the second has a NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_corner<Real> rectified_farther(rectified_corner<Real> a, rectified_corner<Real> b)
{
    mask_t<Real> second = a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
    rectified_corner<Real> r;
    r.x = gnomon_select(second, b.x, a.x);
    r.y = gnomon_select(second, b.y, a.y);
    r.z = gnomon_select(second, b.z, a.z);
    return r;
}

/// The azimuth of b relative to that of a, in [-pi, pi]; 0 on the axis.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real rectified_azimuth_between(rectified_corner<Real> a, rectified_corner<Real> b)
{
    return polynomial_atan2(rectified_turn(a, b), a.x * b.x + a.y * b.y);
}

/// The bounds of rectified coordinates over all view rays to a far plane with these corners: sharp, so that rays touch
/// each. azimuth_start is in [-pi, pi], azimuth_length in [0, 2 pi]: at most pi, or 2 pi if the axis is within the far
/// plane. A corner on the axis has no azimuth and bounds none.
/// Domain: coordinates are 0 or have magnitudes in [2^-30, 2^30] in float, [2^-300, 2^300] in double; corners of a
/// convex quadrilateral whose plane does not hold the eye. Corners that are all at the eye give zeros; corners of no
/// such quadrilateral give unspecified bounds.
/// NaN: an edge with a NaN bounds no angle.
/// Error: for fields of view up to 160 degrees a point of the far plane exceeds the bounds by at most 4 2^-p radius in
/// radius, by 16 2^-p radius sideways, and by 8 2^-p in polar.
/// Source: Peters 2017, App. A
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_frustum<Real> rectified_frustum_from_corners(rectified_corners<Real> q)
{
    Real axis = rectified_axis_side(q);
    rectified_corner farthest = rectified_farther(rectified_farther(q.a, q.b), rectified_farther(q.c, q.d));
    Real a = rectified_azimuth_between(farthest, q.a);
    Real b = rectified_azimuth_between(farthest, q.b);
    Real c = rectified_azimuth_between(farthest, q.c);
    Real d = rectified_azimuth_between(farthest, q.d);
    Real least = gnomon_min(a, gnomon_min(b, gnomon_min(c, gnomon_min(d, Real(0)))));
    Real most = gnomon_max(a, gnomon_max(b, gnomon_max(c, gnomon_max(d, Real(0)))));
    mask_t<Real> around = axis < Real(0) || Real(0) < axis || literal<Real>(rectified_pi) < most - least;

    rectified_interval polar = rectified_interval_begin(axis);
    polar = rectified_interval_edge(polar, q.a, q.b);
    polar = rectified_interval_edge(polar, q.b, q.c);
    polar = rectified_interval_edge(polar, q.c, q.d);
    polar = rectified_interval_end(rectified_interval_edge(polar, q.d, q.a));

    rectified_frustum<Real> r;
    r.radius = gnomon_sqrt(farthest.x * farthest.x + farthest.y * farthest.y);
    Real start = polynomial_atan2(farthest.y, farthest.x) + least;
    Real first = Real(-1) * literal<Real>(rectified_pi);
    r.azimuth_start = gnomon_select(around, first,
                                    clamp_or_nan(rectified_wrapped(start), first, literal<Real>(rectified_pi)));
    r.azimuth_length = gnomon_select(around, literal<Real>(rectified_two_pi), most - least);
    r.polar_least = polar.least;
    r.polar_most = polar.most;
    return r;
}

/// The part of the edge from a to b, within a part, that is on the left of the direction (cosine, sine) from the axis.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_part<Real> rectified_part_left(rectified_part<Real> part, rectified_corner<Real> a,
                                                                 rectified_corner<Real> b, Real cosine, Real sine)
{
    Real at_a = cosine * a.y - sine * a.x;
    Real at_b = cosine * b.y - sine * b.x;
    Real crossing = at_a / (at_a - at_b);
    part.begin = gnomon_select(at_a < Real(0), gnomon_max(part.begin, crossing), part.begin);
    part.end = gnomon_select(at_b < Real(0), gnomon_min(part.end, crossing), part.end);
    // Both ends are on the right: the part is empty.
    part.end = gnomon_select(at_a < Real(0) && at_b < Real(0), Real(-1), part.end);
    return part;
}

/// The angles so far and those of the edge from a to b between two directions; of the whole edge if whole is 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_row_edge(rectified_interval<Real> bounds,
                                                                    rectified_corner<Real> a, rectified_corner<Real> b,
                                                                    cosine_sine<Real> first, cosine_sine<Real> last,
                                                                    Real whole)
{
    rectified_part<Real> all;
    all.begin = Real(0);
    all.end = Real(1);
    rectified_part part = rectified_part_left(all, a, b, first.cosine, first.sine);
    part = rectified_part_left(part, a, b, Real(-1) * last.cosine, Real(-1) * last.sine);
    part.begin = gnomon_select(whole == Real(1), Real(0), part.begin);
    part.end = gnomon_select(whole == Real(1), Real(1), part.end);
    return rectified_interval_part(bounds, a, b, part);
}

/// The polar angles of the view rays whose azimuths are between first and last, as those of one row; [0, pi] if no ray
/// is there.
/// Domain: as for rectified_frustum_from_corners; first <= last, both within 3 pi of 0. An interval above 3 radians
/// gives the angles of all rays.
/// NaN: as for rectified_frustum_from_corners.
/// Error: for fields of view up to 160 degrees a ray exceeds the bounds by at most 16 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr rectified_interval<Real> rectified_row_polar(rectified_corners<Real> q, Real first, Real last)
{
    cosine_sine left = polynomial_cosine_sine(first);
    cosine_sine right = polynomial_cosine_sine(last);
    Real whole = gnomon_select(Real(3) < last - first, Real(1), Real(0));
    rectified_interval polar = rectified_interval_begin(rectified_axis_side(q));
    polar = rectified_row_edge(polar, q.a, q.b, left, right, whole);
    polar = rectified_row_edge(polar, q.b, q.c, left, right, whole);
    polar = rectified_row_edge(polar, q.c, q.d, left, right, whole);
    return rectified_interval_end(rectified_row_edge(polar, q.d, q.a, left, right, whole));
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
