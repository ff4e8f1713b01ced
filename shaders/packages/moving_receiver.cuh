// Gnomon 0.1.0, moving_receiver.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_MOVING_RECEIVER_CUH
#define GNOMON_MOVING_RECEIVER_CUH

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
#error "gnomon: moving_receiver.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: moving_receiver.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: moving_receiver.cuh is not of the same version as a package before it"
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

// motion/range/range.h ------------------------------------------------------------------------------------------------
// Depth-time ranges. From time t0 to time t1 of the shutter interval [0, 1] a surface covers a texel of the shadow map,
// at a depth that changes linearly from z0 to z1. The depth-time range of Hong & Oh ("Motion blurred shadows utilizing
// a depth-time ranges shadow map", section 4), the tuple of their temporal shadow map (2017), and the interval of
// Gribel et al. 2010 and Palmer 2011 are these five numbers. The id names the surface, because no surface shadows
// itself.
//
// A range whose times are out of order, or with a NaN time, is empty: it shadows nothing.
#ifndef GNOMON_MOTION_RANGE_RANGE_H
#define GNOMON_MOTION_RANGE_RANGE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Times in [0, 1], signed depths, and an id: a whole number that floats hold, such as a triangle's index below 2^24.
template <class Real, class = require_real<Real>> struct depth_time_range { Real t0, t1, z0, z1, id; };

inline constexpr double range_mixed = -1.0;                // the id of a range of several surfaces: it shadows them all
inline constexpr double range_nothing = -2.0;              // the id of a time without any surface
inline constexpr double range_far = 1152921504606846976.0; // 2^60: products of two depths are finite in float

/// The range between two points of time and depth, given in either order.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_between(Real time_a, Real z_a, Real time_b, Real z_b, Real id)
{
    mask_t<Real> swapped = time_b < time_a;
    depth_time_range<Real> r;
    r.t0 = gnomon_select(swapped, time_b, time_a);
    r.t1 = gnomon_select(swapped, time_a, time_b);
    r.z0 = gnomon_select(swapped, z_b, z_a);
    r.z1 = gnomon_select(swapped, z_a, z_b);
    r.id = id;
    return r;
}

/// An empty range: it shadows nothing.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr depth_time_range<Real> range_empty(Real id)
{
    depth_time_range<Real> r;
    r.t0 = Real(1);
    r.t1 = Real(0);
    r.z0 = Real(1);
    r.z1 = Real(1);
    r.id = id;
    return r;
}

/// Fraction of the range elapsed at time t, in [0, 1]: 0 up to t0, 1 from t1 on, 0 if t0 == t1.
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_elapsed(depth_time_range<Real> r, Real t)
{
    return saturate_or_zero((t - r.t0) / (r.t1 - r.t0));
}

/// Depth at time t, held constant before t0 and after t1; z0 if t0 == t1. Exact at both ends, and at all times if z0 ==
/// z1.
/// NaN: the result is NaN if z0 or z1 is.
/// Error: 5 (|z0| + |z1|) 2^-p, p the bits of the significand.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_depth(depth_time_range<Real> r, Real t)
{
    Real passed = range_elapsed(r, t);
    return gnomon_select(r.z0 == r.z1, r.z0, r.z0 * (Real(1) - passed) + r.z1 * passed);
}

/// Duration of the range, 0 if it is empty.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_duration(depth_time_range<Real> r) { return gnomon_max(r.t1 - r.t0, Real(0)); }

/// The part of r between the times begin and end, possibly empty.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_clip(depth_time_range<Real> r, Real begin, Real end)
{
    depth_time_range<Real> c;
    c.t0 = gnomon_max(begin, r.t0);
    c.t1 = gnomon_min(end, r.t1);
    c.z0 = range_depth(r, c.t0);
    c.z1 = range_depth(r, c.t1);
    c.id = r.id;
    return c;
}

/// a where the mask is set, b elsewhere.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_select(mask_t<Real> mask, depth_time_range<Real> a,
                                                            depth_time_range<Real> b)
{
    depth_time_range<Real> r;
    r.t0 = gnomon_select(mask, a.t0, b.t0);
    r.t1 = gnomon_select(mask, a.t1, b.t1);
    r.z0 = gnomon_select(mask, a.z0, b.z0);
    r.z1 = gnomon_select(mask, a.z1, b.z1);
    r.id = gnomon_select(mask, a.id, b.id);
    return r;
}

/// r where the mask is set; elsewhere an empty range, which begins after all others.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_keep_if(mask_t<Real> mask, depth_time_range<Real> r)
{
    return range_select(mask, r, range_empty(literal<Real>(range_nothing)));
}

/// True if a comes before b in a total order: by begin, end, depth at begin, depth at end, id.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr mask_t<Real> range_less(depth_time_range<Real> a, depth_time_range<Real> b)
{
    mask_t<Real> by_id = a.id < b.id;
    mask_t<Real> by_z1 = a.z1 < b.z1 || (a.z1 == b.z1 && by_id);
    mask_t<Real> by_z0 = a.z0 < b.z0 || (a.z0 == b.z0 && by_z1);
    mask_t<Real> by_t1 = a.t1 < b.t1 || (a.t1 == b.t1 && by_z0);
    return a.t0 < b.t0 || (a.t0 == b.t0 && by_t1);
}

/// True if a provably occludes all of b: all of a is in front of all of b while b lasts, or both have the same times
/// and a has the nearer ends. Of two equal ranges the one with the lower id occludes the other. Nothing is rounded, so
/// the relation is transitive: the ranges that remain when the occluded ones go do not depend on the order of the
/// tests.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr mask_t<Real> range_occludes(depth_time_range<Real> a, depth_time_range<Real> b)
{
    mask_t<Real> during = a.t0 <= b.t0 && b.t1 <= a.t1;
    mask_t<Real> apart = gnomon_max(a.z0, a.z1) <= gnomon_min(b.z0, b.z1);
    mask_t<Real> nearer = a.t0 == b.t0 && a.t1 == b.t1 && a.z0 <= b.z0 && a.z1 <= b.z1;
    mask_t<Real> equal = nearer && a.z0 == b.z0 && a.z1 == b.z1;
    return during && (apart || nearer) && !(equal && b.id < a.id);
}

/// The part of a during the time of b, possibly empty.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_clip_to(depth_time_range<Real> a, depth_time_range<Real> b)
{
    return range_clip(a, b.t0, b.t1);
}

/// Time at which two ranges of the same begin and end are at the same depth; one of these ends if they never are.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_crossing(depth_time_range<Real> a, depth_time_range<Real> b)
{
    Real distance0 = a.z0 - b.z0;
    Real distance1 = a.z1 - b.z1;
    Real passed = saturate_or_zero(distance0 / (distance0 - distance1));
    return a.t0 * (Real(1) - passed) + a.t1 * passed;
}

/// The part of a that is in front of b, possibly empty. Where depths are equal throughout, the range with the lower id
/// is in front. This part and the part of b in front of a fill the time that both share, bit for bit, unless both
/// depths and ids are equal.
/// Error: (80 z / d + 4) 2^-p for the time at which the front changes, z the largest depth and d the change of the
/// distance between the ranges.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_visible_part(depth_time_range<Real> a, depth_time_range<Real> b)
{
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    Real before0 = near_b.z0 - near_a.z0;
    Real before1 = near_b.z1 - near_a.z1;
    mask_t<Real> tie = before0 == Real(0) && before1 == Real(0) && a.id < b.id;
    mask_t<Real> first = Real(0) < before0 || (before0 == Real(0) && Real(0) < before1) || tie;
    mask_t<Real> last = Real(0) < before1 || (before1 == Real(0) && Real(0) < before0) || tie;
    Real crossing = clamp_or_nan(range_crossing(near_a, near_b), near_a.t0, near_a.t1);
    Real begin = gnomon_select(first, near_a.t0, gnomon_select(last, crossing, Real(1)));
    Real end = gnomon_select(last, near_a.t1, gnomon_select(first, crossing, Real(0)));
    mask_t<Real> some = begin < end;
    return range_clip(a, gnomon_select(some, begin, Real(1)), gnomon_select(some, end, Real(0)));
}

/// The part of r that remains after `other` occludes its begin, its end or all of it. If only the middle is occluded, r
/// stays whole, since a range cannot have a hole. Cuts fall at times that `other` covers, so no gap opens.
/// Error: that of range_depth, for the depth line.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_trim(depth_time_range<Real> r, depth_time_range<Real> other)
{
    depth_time_range occluding = range_visible_part(other, r);
    mask_t<Real> some = occluding.t0 < occluding.t1;
    Real begin = gnomon_select(some && occluding.t0 <= r.t0, occluding.t1, r.t0);
    Real end = gnomon_select(some && r.t1 <= occluding.t1, occluding.t0, r.t1);
    return range_clip(r, begin, end);
}

/// The part of r between begin and end that is in front of a receiver, possibly empty. The receiver's depth is a range,
/// too, and level for a static receiver.
/// NaN: a NaN depth is in front of nothing.
/// Error: the times at which the two are within 26 z 2^-p of one another, z the largest depth; and 8 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_occluding_part(depth_time_range<Real> r,
                                                                    depth_time_range<Real> receiver, Real begin,
                                                                    Real end)
{
    Real early = gnomon_max(begin, r.t0);
    Real late = gnomon_min(end, r.t1);
    // In most cases one of the two is in front at all times.
    mask_t<Real> nearer = r.z0 < receiver.z0 && r.z0 < receiver.z1 && r.z1 < receiver.z0 && r.z1 < receiver.z1;
    mask_t<Real> farther = receiver.z0 <= r.z0 && receiver.z0 <= r.z1 && receiver.z1 <= r.z0 && receiver.z1 <= r.z1;
    Real front = early;
    Real back = gnomon_select(farther, Real(0), late);
    mask_t<Real> open = early < late && !(nearer || farther);
    if (gnomon_any(open)) {
        Real before0 = range_depth(receiver, early) - range_depth(r, early);
        Real before1 = range_depth(receiver, late) - range_depth(r, late);
        Real passed = before0 / (before0 - before1); // in [0, 1] where their signs differ
        Real crossing = clamp_or_nan(early * (Real(1) - passed) + late * passed, early, late);
        Real first = gnomon_select(Real(0) < before0, early, gnomon_select(Real(0) < before1, crossing, Real(1)));
        Real last = gnomon_select(Real(0) < before1, late, gnomon_select(Real(0) < before0, crossing, Real(0)));
        front = gnomon_select(open, first, front);
        back = gnomon_select(open, last, back);
    }
    mask_t<Real> some = front < back; // false for NaN
    return range_clip(r, gnomon_select(some, front, Real(1)), gnomon_select(some, back, Real(0)));
}

/// Shadow intensity at time t and depth z on the surface with the given id: 1 where the range lasts at time t, lies
/// more than the bias in front of z, and has another id; else 0.
/// NaN: 0, lit.
/// Source: Hong & Oh 2018, Sec. 3.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_intensity(depth_time_range<Real> r, Real t, Real z, Real id,
                                             std::type_identity_t<Real> bias)
{
    mask_t<Real> during = r.t0 <= t && t <= r.t1;
    mask_t<Real> occludes = range_depth(r, t) + bias < z && !(id == r.id);
    return gnomon_select(during && occludes, Real(1), Real(0));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/range/range_summary.h ----------------------------------------------------------------------------------------
// A summary of a resolved list in four numbers: nearest and farthest depth, occluded time, id. Most receivers need
// nothing more. They are in front of all ranges of a texel, or behind all of them, above all where backdrops are left
// out (passes/range/backdrop.hpp).
//
//     summary = range_summary_begin(-1);   summary = range_summary_add(summary, range);   for every range of the texel
#ifndef GNOMON_MOTION_RANGE_RANGE_SUMMARY_H
#define GNOMON_MOTION_RANGE_RANGE_SUMMARY_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Nearest and farthest depth of a list; shadowed, the share of a shutter that is open from 0 to 1 for which its ranges
/// shadow a receiver behind all of them; and their id: range_mixed if there are several, range_nothing if no receiver
/// can be behind ranges of its own id.
template <class Real, class = require_real<Real>> struct range_summary { Real nearest, farthest, shadowed, id; };

/// Begin without a range. The near plane is -1: a receiver must lie behind that depth to be behind all ranges.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_summary<Real> range_summary_begin(Real near_plane)
{
    range_summary<Real> summary;
    summary.nearest = literal<Real>(range_far);
    summary.farthest = near_plane;
    summary.shadowed = Real(0);
    summary.id = literal<Real>(range_nothing);
    return summary;
}

/// Add one range that is disjoint in time from those before. An empty range, which no receiver can see, adds nothing.
/// NaN: a range with a NaN adds nothing.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_summary<Real> range_summary_add(range_summary<Real> summary, depth_time_range<Real> r)
{
    mask_t<Real> some = r.t0 < r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
    mask_t<Real> first = summary.id == literal<Real>(range_nothing);
    Real nearest = gnomon_min(summary.nearest, gnomon_min(r.z0, r.z1));
    Real farthest = gnomon_max(summary.farthest, gnomon_max(r.z0, r.z1));
    Real share = saturate_or_zero(r.t1) - saturate_or_zero(r.t0);
    Real id = gnomon_select(first || summary.id == r.id, r.id, literal<Real>(range_mixed));
    summary.nearest = gnomon_select(some, nearest, summary.nearest);
    summary.farthest = gnomon_select(some, farthest, summary.farthest);
    summary.shadowed = gnomon_select(some, summary.shadowed + share, summary.shadowed);
    summary.id = gnomon_select(some, id, summary.id);
    return summary;
}

/// True if r, the next range of a resolved list, belongs to the second layer behind `front`, the last range that did
/// not. A range of the second layer lasts only while front lasts. Ranges in front that overlap by rounding do not
/// match.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr mask_t<Real> range_is_second_layer(depth_time_range<Real> front, depth_time_range<Real> r)
{
    return front.t0 <= r.t0 && r.t0 < front.t1 && r.t1 <= front.t1;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/shutter.h -------------------------------------------------------------------------------------------
// Shutter responses: the share of the exposure's light that a shutter has let in by time t. The light that a receiver
// loses between two times is the difference of the shares (Palmer 2011, (2.1), with the response w(t) integrated in
// advance).
//
// Four responses: a box, which opens and closes at once; a tent, which is wide open halfway; eight equal parts of the
// exposure with any weights, such as those of a camera's measured shutter; and a line. The line is for shading that
// changes while the shadow does: where the light that a receiver reflects is linear in time, as of a surface that
// turns, a box shutter counts each time by that light (Palmer 2011, (2.2) and (2.3)).
//
// The ends of an exposure may be given in either order. An exposure of no length shows a single time (see
// shutter_exposure_make, which receivers begin with).
#ifndef GNOMON_MOTION_RECEIVER_SHUTTER_H
#define GNOMON_MOTION_RECEIVER_SHUTTER_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Fraction of the exposure's light in each eighth, in order; the sum is 1 (see shutter_weights_make).
template <class Real, class = require_real<Real>> struct shutter_weights { Real w0, w1, w2, w3, w4, w5, w6, w7; };

/// Times at which a shutter opens and closes.
template <class Real, class = require_real<Real>> struct shutter_exposure { Real begin, end; };

inline constexpr double shutter_weight_limit = 1152921504606846976.0; // 2^60: eight of them have a sum in float

/// The exposure between two times, given in either order. An exposure shorter than 2^-20 lasts 2^-20 from its begin on,
/// or until shutter close if it would end later: a range that covers that time shadows the receiver entirely.
/// NaN: a NaN stays NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr shutter_exposure<Real> shutter_exposure_make(Real a, Real b)
{
    Real least = Real(0.00000095367431640625);
    mask_t<Real> swapped = b < a;
    Real open = gnomon_select(swapped, b, a);
    Real close = gnomon_select(swapped, a, b);
    mask_t<Real> brief = close - open < least;
    Real early = gnomon_select(open <= Real(1), gnomon_min(open, Real(1) - least), open);
    shutter_exposure<Real> r;
    r.begin = gnomon_select(brief, early, open);
    r.end = gnomon_select(brief, early + least, close);
    return r;
}

/// Time at which the given share of the time from begin to end has passed. The share must lie between 0 and 1,
/// exclusively: llvmpipe makes 0 of a product with 0, of NaN * 0, too.
/// Domain: 0 < share < 1.
/// Error: 3 2^-p max(|begin|, |end|).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real shutter_time(Real begin, Real end, std::type_identity_t<Real> share)
{
    return begin * (Real(1) - share) + end * share;
}

/// Share of the exposure's light that a shutter which opens and closes at once has let in by time t, in [0, 1]. If
/// begin == end the share is 0 up to that time and 1 after it.
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real shutter_box(Real t, Real begin, Real end)
{
    return saturate_or_zero((t - begin) / (end - begin));
}

/// Share of the exposure's light that a shutter which opens and closes evenly, wide open halfway, has let in by time t,
/// in [0, 1].
/// Domain: begin <= end.
/// NaN: 0.
/// Source: Palmer 2011, Eq. 2.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real shutter_tent(Real t, Real begin, Real end)
{
    Real x = shutter_box(t, begin, end);
    Real left = Real(1) - x;
    return gnomon_select(x < Real(0.5), Real(2) * (x * x), Real(1) - Real(2) * (left * left));
}

/// A weight limited to [0, 2^60].
/// NaN: 0.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real shutter_weight(Real w)
{
    return gnomon_select(Real(0) < w, gnomon_min(w, literal<Real>(shutter_weight_limit)), Real(0));
}

/// Fraction of the sum that is this weight, 1/8 if the sum is 0. In [0, 1], also where division is not correctly
/// rounded.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real shutter_share(Real weight, Real sum)
{
    return gnomon_select(Real(0) < sum, saturate_or_zero(weight / sum), Real(0.125));
}

/// Share of the exposure's light that has come in by time t, where the light changes linearly from weight w0 at the
/// begin of the exposure to w1 at its end. In [0, 1]. Negative weights count as 0; if both do, the light does not
/// change.
/// Domain: begin <= end.
/// NaN: 0; a NaN weight counts as 0.
/// Error: 12 2^-p.
/// Source: Palmer 2011, Eq. 2.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real shutter_line(Real t, Real begin, Real end, Real w0, Real w1)
{
    Real a = shutter_weight(w0);
    Real b = shutter_weight(w1);
    Real sum = a + b;
    Real x = shutter_box(t, begin, end);
    Real early = gnomon_select(Real(0) < sum, saturate_or_zero(a / sum), Real(0.5));
    return saturate_or_zero(x * (early + (early * (Real(1) - x) + (Real(1) - early) * x)));
}

/// Eight weights scaled to sum to 1. Negative weights count as 0; if no weight is left, all are equal, as for a box.
/// Call once for a shutter, not for each range.
/// NaN: a NaN weight counts as 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr shutter_weights<Real> shutter_weights_make(shutter_weights<Real> weights)
{
    shutter_weights<Real> w;
    w.w0 = shutter_weight(weights.w0);
    w.w1 = shutter_weight(weights.w1);
    w.w2 = shutter_weight(weights.w2);
    w.w3 = shutter_weight(weights.w3);
    w.w4 = shutter_weight(weights.w4);
    w.w5 = shutter_weight(weights.w5);
    w.w6 = shutter_weight(weights.w6);
    w.w7 = shutter_weight(weights.w7);
    Real sum = ((w.w0 + w.w1) + (w.w2 + w.w3)) + ((w.w4 + w.w5) + (w.w6 + w.w7));
    w.w0 = shutter_share(w.w0, sum);
    w.w1 = shutter_share(w.w1, sum);
    w.w2 = shutter_share(w.w2, sum);
    w.w3 = shutter_share(w.w3, sum);
    w.w4 = shutter_share(w.w4, sum);
    w.w5 = shutter_share(w.w5, sum);
    w.w6 = shutter_share(w.w6, sum);
    w.w7 = shutter_share(w.w7, sum);
    return w;
}

/// Share of the exposure's light that a shutter with the weights w has let in by time t. Each eighth lets in its weight
/// evenly. In [0, 1] for any weights, from shutter_weights_make or not, and exactly 1 from the end of the exposure on.
/// Domain: begin <= end.
/// Error: 16 2^-p.
/// Source: Palmer 2011, Eq. 2.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real shutter_piecewise(Real t, Real begin, Real end, shutter_weights<Real> w)
{
    Real x = Real(8) * shutter_box(t, begin, end);
    Real early = (w.w0 * saturate_or_zero(x) + w.w1 * saturate_or_zero(x - Real(1))) +
                 (w.w2 * saturate_or_zero(x - Real(2)) + w.w3 * saturate_or_zero(x - Real(3)));
    Real late = (w.w4 * saturate_or_zero(x - Real(4)) + w.w5 * saturate_or_zero(x - Real(5))) +
                (w.w6 * saturate_or_zero(x - Real(6)) + w.w7 * saturate_or_zero(x - Real(7)));
    return gnomon_select(x < Real(8), saturate_or_zero(early + late), Real(1));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/static_receiver.h -----------------------------------------------------------------------------------
// The shadow on a static receiver while the shutter is open, in closed form. Every range in front of the receiver
// occludes it for a time that is known in closed form, and the shutter (shutter.h) turns that time into a share of the
// light: exact, where stochastic shadow maps take samples. Ranges must not overlap in time, as in a resolved list; else
// the overlap counts twice. (Hong & Oh's shadow test, integrated over time; Palmer 2011, chapter 4.)
//
//     state = static_receiver_begin(z_f, id, begin, end);
//     for every range of the texel:
//         hidden = static_receiver_occluding_part(state, range);
//         share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                    shutter_piecewise
//         state = static_receiver_add(state, receiver_lost_light(hidden, id, share0, share1));
//     intensity = static_receiver_end(state);
//
// Percentage-closer filtering of K x K bilinear look-ups around texel position (x, y) reads K + 1 texels along either
// axis. With x - K / 2 = column + u, column a whole number and u in [0, 1), and y alike, set the weight of texel
// (column + i, row + j), i and j from 0 to K, before its ranges:
//     state = static_receiver_set_weight(state, texel_weight(u, i, K) * texel_weight(v, j, K));
//
// A list may have a second layer (passes/range/resolve.hpp), for receivers whose own range is in front:
//     front = range_empty(range_nothing);
//     for every range of the texel, in order:
//         if range_is_second_layer(front, range), leave range out unless front.id == id; else front = range
//
// A receiver behind all ranges of a texel, or in front of all, needs no list, only its summary (range_summary.h):
//     if (receiver_is_in_front(z_f, summary) > 0) nothing is added
//     if (static_receiver_is_behind(state, summary) > 0) state = static_receiver_add(state, summary.shadowed);
#ifndef GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_STATIC_RECEIVER_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Depth and id of the receiver, the times at which the shutter opens and closes, the weight of the ranges to come, and
/// the share of the light that is lost so far.
template <class Real, class = require_real<Real>>
struct static_receiver { Real depth, id, begin, end, weight, shadowed; };

/// Begin without a range, for any depth z_f, less the depth bias if one is needed. The exposure lasts from begin to
/// end, as of shutter_exposure_make.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr static_receiver<Real> static_receiver_begin(Real z_f, Real id, Real begin, Real end)
{
    shutter_exposure open = shutter_exposure_make(begin, end);
    static_receiver<Real> r;
    r.depth = z_f;
    r.id = id;
    r.begin = open.begin;
    r.end = open.end;
    r.weight = Real(1);
    r.shadowed = Real(0);
    return r;
}

/// Set the weight of the ranges to come, in [0, 1]. The weights of all texels sum to 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr static_receiver<Real> static_receiver_set_weight(static_receiver<Real> state, Real weight)
{
    state.weight = saturate_or_zero(weight);
    return state;
}

/// The part of r that occludes the receiver while the shutter is open, possibly empty.
/// Error: that of range_occluding_part.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> static_receiver_occluding_part(static_receiver<Real> state,
                                                                              depth_time_range<Real> r)
{
    depth_time_range<Real> level;
    level.t0 = state.begin;
    level.t1 = state.end;
    level.z0 = state.depth;
    level.z1 = state.depth;
    level.id = state.id;
    return range_occluding_part(r, level, state.begin, state.end);
}

/// Share of the light that a receiver with the given id loses while `hidden` occludes it, in [0, 1]. The shutter has
/// let in the shares share0 and share1 of the exposure's light at the begin and at the end of hidden. A range of the
/// receiver's own id occludes nothing.
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real receiver_lost_light(depth_time_range<Real> hidden, Real id, Real share0, Real share1)
{
    return gnomon_select(hidden.id == id, Real(0), saturate_or_zero(share1 - share0));
}

/// Add the share of the light that is lost to one range, or to all ranges of a texel (summary.shadowed).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr static_receiver<Real> static_receiver_add(static_receiver<Real> state, Real lost)
{
    state.shadowed = state.shadowed + state.weight * lost;
    return state;
}

/// 1 if no range is in front of depth z_f, else 0. z_f is the depth of a receiver, or the farther end of its path.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real receiver_is_in_front(Real z_f, range_summary<Real> summary)
{
    return gnomon_select(z_f <= summary.nearest, Real(1), Real(0));
}

/// 1 if the summary decides: the receiver is behind all ranges, its exposure is the whole shutter interval, and none of
/// the ranges can be its own; else 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real static_receiver_is_behind(static_receiver<Real> state, range_summary<Real> summary)
{
    mask_t<Real> whole = state.begin <= Real(0) && Real(1) <= state.end;
    mask_t<Real> own = summary.id == literal<Real>(range_mixed) || summary.id == state.id;
    return gnomon_select(whole && summary.farthest < state.depth && !own, Real(1), Real(0));
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range its weight times the largest response (1 for a box, 2 for a tent, 8 times the largest weight
/// of a piecewise one), times 32 2^-p and the time for which the range is within 26 z 2^-p of the receiver
/// (range_occluding_part) over the duration of the exposure; 4 2^-p for each range of a summary.
/// Source: Hong & Oh 2018, Sec. 5; Palmer 2011, Sec. 4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real static_receiver_end(static_receiver<Real> state)
{
    return saturate_or_zero(state.shadowed);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/triangle/coverage_intervals.h --------------------------------------------------------------------------------
// Times at which a triangle covers a sample, for edge functions that are quadratic in time (moving_triangle.h): at most
// four intervals of the shutter for either facing (Gribel et al. 2010; Palmer 2011, 2.1).
//
// An edge function is stored by its Bernstein coefficients, e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2. So e0 and e2
// are its values at shutter open and close, and a root t = u / (1 + u) belongs to a root u >= 0 of
//     e2 u^2 + 2 e1 u + e0 = 0,   u = q / e2 or e0 / q,   q = -(e1 + sign(e1) sqrt(e1^2 - e0 e2))
// This gives t = q / (q + e2) or e0 / (e0 + q). Both are sums of like signs, so nothing cancels, neither near 0 nor
// near 1. The set of times with e >= 0 is a single interval, or, if e is positive at both ends, everything except one
// gap. Three edges leave one interval less three gaps, hence four intervals. No sign is sampled in between. Of two
// triangles that share an edge, one has e and the other -e. Both find the same roots bit for bit, so one triangle
// covers the sample exactly when the other does not.
#ifndef GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H
#define GNOMON_MOTION_TRIANGLE_COVERAGE_INTERVALS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A quadratic by its Bernstein coefficients: e(t) = e0 (1 - t)^2 + 2 e1 t (1 - t) + e2 t^2.
template <class Real, class = require_real<Real>> struct moving_edge { Real e0, e1, e2; };

/// The edge functions opposite to the vertices a, b, c of a triangle.
template <class Real, class = require_real<Real>> struct moving_edges { moving_edge<Real> a, b, c; };

/// The times from begin to end, except those from gap_begin to gap_end. Without a gap, both of these are coverage_none.
/// An empty set has begin 1 and end 0.
template <class Real, class = require_real<Real>> struct edge_intervals { Real begin, end, gap_begin, gap_end; };

/// The times from begin to end; none unless begin < end.
template <class Real, class = require_real<Real>> struct linear_interval { Real begin, end; };

/// Four numbers in ascending order.
template <class Real, class = require_real<Real>> struct ordered4 { Real first, second, third, fourth; };

/// Disjoint intervals in order, `count` of them; the others begin and end at coverage_none.
template <class Real, class = require_real<Real>>
struct coverage_intervals { Real count, begin0, end0, begin1, end1, begin2, end2, begin3, end3; };

inline constexpr double coverage_none = 2.0;                       // after the shutter has closed
inline constexpr double moving_edge_limit = 1152921504606846976.0; // 2^60: squares of coefficients are finite in float

/// Value e(t) at time t in [0, 1], by de Casteljau's algorithm. Odd in e, bit for bit.
/// Error: 6 2^-p times the largest coefficient.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moving_edge_at(moving_edge<Real> e, Real t)
{
    Real s = Real(1) - t;
    return (e.e0 * s + e.e1 * t) * s + (e.e1 * s + e.e2 * t) * t;
}

/// Sum of the absolute coefficients; infinite or NaN if one is.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real moving_edge_size(moving_edge<Real> e)
{
    return (gnomon_abs(e.e0) + gnomon_abs(e.e1)) + gnomon_abs(e.e2);
}

/// Times in [0, 1] at which e >= 0, or at which e <= 0 if facing is negative; all times if e is 0 throughout.
/// Domain: the largest coefficient is between 2^-50 and 2^58 in float; none for larger ones.
/// NaN: none.
/// Error: the times are exact for coefficients that differ by 16 2^-p of the largest.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr edge_intervals<Real> moving_edge_inside(moving_edge<Real> e, std::type_identity_t<Real> facing)
{
    Real side = gnomon_select(facing < Real(0), Real(-1), Real(1));
    Real c0 = side * e.e0;
    Real c1 = side * e.e1;
    Real c2 = side * e.e2;
    edge_intervals<Real> x;
    x.begin = Real(0);
    x.end = Real(1);
    x.gap_begin = literal<Real>(coverage_none);
    x.gap_end = literal<Real>(coverage_none);
    mask_t<Real> before = c0 < Real(0); // outside at shutter open
    mask_t<Real> after = c2 < Real(0);
    if (gnomon_any(before || after || c1 < Real(0))) {
        // q has the sign of -e1. Where e1 is 0, q has that of e0, which keeps q odd in e and finds the root in [0, 1].
        mask_t<Real> up = Real(0) < c1 || (c1 == Real(0) && before);
        mask_t<Real> late = (before && !up) || (up && !before);
        mask_t<Real> once = (before && !after) || (after && !before);
        // Otherwise there are two roots, in the order of the formulas, or none if all coefficients have one sign.
        mask_t<Real> twice = !(once || late);
        Real r = gnomon_sqrt(gnomon_max(c1 * c1 - c0 * c2, Real(0)));
        Real q = gnomon_select(up, Real(-1) * (c1 + r), r - c1);
        Real first = saturate_or_zero(gnomon_select(late, q, c0) / (gnomon_select(late, c2, c0) + q));
        Real second = first;
        if (gnomon_any(twice)) {
            second = gnomon_select(twice, saturate_or_zero(q / (q + c2)), first);
            twice = twice && Real(0) < r;
            mask_t<Real> gap = twice && !before && first < second;
            x.gap_begin = gnomon_select(gap, first, x.gap_begin);
            x.gap_end = gnomon_select(gap, second, x.gap_end);
        }
        mask_t<Real> some = once || twice || !before;
        x.begin = gnomon_select(some, gnomon_select(before, first, Real(0)), Real(1));
        x.end = gnomon_select(some, gnomon_select(after, second, Real(1)), Real(0));
    }
    mask_t<Real> known = moving_edge_size(e) < literal<Real>(moving_edge_limit);
    x.begin = gnomon_select(known, x.begin, Real(1));
    x.end = gnomon_select(known, x.end, Real(0));
    return x;
}

/// Times in [0, 1] at which an edge function that is linear in time, from e0 to e2, is >= 0. For the other side of the
/// edge, call with -e0 and -e2.
/// Domain: none for coefficients that differ by 2^60 or more.
/// NaN: none.
/// Error: 4 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr linear_interval<Real> linear_edge_inside(Real e0, Real e2)
{
    mask_t<Real> before = e0 < Real(0);
    mask_t<Real> after = e2 < Real(0);
    Real change = e0 - e2;
    mask_t<Real> never = (before && after) || !(gnomon_abs(change) < literal<Real>(moving_edge_limit));
    Real root = gnomon_min(e0 / change, Real(1));
    linear_interval<Real> x;
    x.begin = gnomon_select(never, Real(1), gnomon_select(before, root, Real(0)));
    x.end = gnomon_select(never, Real(0), gnomon_select(after, root, Real(1)));
    return x;
}

/// Times at which three linear edge functions are all >= 0, for a triangle that is translated or static.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr linear_interval<Real> linear_coverage(moving_edges<Real> e)
{
    linear_interval a = linear_edge_inside(e.a.e0, e.a.e2);
    linear_interval b = linear_edge_inside(e.b.e0, e.b.e2);
    linear_interval c = linear_edge_inside(e.c.e0, e.c.e2);
    a.begin = gnomon_max(gnomon_max(a.begin, b.begin), c.begin);
    a.end = gnomon_min(gnomon_min(a.end, b.end), c.end);
    return a;
}

/// Sort four numbers by a network of five exchanges.
/// Domain: no NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr ordered4<Real> ordered4_make(Real a, Real b, Real c, Real d)
{
    Real low0 = gnomon_min(a, b);
    Real high0 = gnomon_max(a, b);
    Real low1 = gnomon_min(c, d);
    Real high1 = gnomon_max(c, d);
    Real middle0 = gnomon_max(low0, low1);
    Real middle1 = gnomon_min(high0, high1);
    ordered4<Real> x;
    x.first = gnomon_min(low0, low1);
    x.second = gnomon_min(middle0, middle1);
    x.third = gnomon_max(middle0, middle1);
    x.fourth = gnomon_max(high0, high1);
    return x;
}

/// Times at which the sample is on the inner side of all three edges.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr coverage_intervals<Real> intersect_edge_intervals(edge_intervals<Real> a,
                                                                          edge_intervals<Real> b,
                                                                          edge_intervals<Real> c)
{
    Real begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), c.begin), Real(0));
    Real end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), c.end), Real(1));
    Real none = literal<Real>(coverage_none);
    mask_t<Real> some = begin < end;
    coverage_intervals<Real> x;
    x.count = gnomon_select(some, Real(1), Real(0));
    x.begin0 = gnomon_select(some, begin, none);
    x.end0 = gnomon_select(some, end, none);
    x.begin1 = none;
    x.end1 = none;
    x.begin2 = none;
    x.end2 = none;
    x.begin3 = none;
    x.end3 = none;
    mask_t<Real> gap_a = a.gap_begin < none;
    mask_t<Real> gap_b = b.gap_begin < none;
    mask_t<Real> gap_c = c.gap_begin < none;
    if (gnomon_any(some && (gap_a || gap_b || gap_c))) {
        // Intervals that a caller made may have a gap's end without a begin. Ignore such ends, so that no lane of a
        // pack depends on the others.
        a.gap_begin = gnomon_select(gap_a, a.gap_begin, none);
        b.gap_begin = gnomon_select(gap_b, b.gap_begin, none);
        c.gap_begin = gnomon_select(gap_c, c.gap_begin, none);
        a.gap_end = gnomon_select(gap_a, a.gap_end, none);
        b.gap_end = gnomon_select(gap_b, b.gap_end, none);
        c.gap_end = gnomon_select(gap_c, c.gap_end, none);
        // Sorted separately, the begins and ends of gaps bound the times outside of all gaps: a time is outside when as
        // many gaps have begun as have ended.
        ordered4 starts = ordered4_make(a.gap_begin, b.gap_begin, c.gap_begin, none);
        ordered4 stops = ordered4_make(a.gap_end, b.gap_end, c.gap_end, none);
        Real begin1 = gnomon_max(begin, stops.first);
        Real begin2 = gnomon_max(begin, stops.second);
        Real begin3 = gnomon_max(begin, stops.third);
        Real end0 = gnomon_min(end, starts.first);
        Real end1 = gnomon_min(end, starts.second);
        Real end2 = gnomon_min(end, starts.third);
        mask_t<Real> some0 = some && begin < end0;
        mask_t<Real> some1 = some && begin1 < end1;
        mask_t<Real> some2 = some && begin2 < end2;
        mask_t<Real> some3 = some && begin3 < end;
        // Move empty intervals to the end, and keep the order of the others.
        starts = ordered4_make(gnomon_select(some0, begin, none), gnomon_select(some1, begin1, none),
                               gnomon_select(some2, begin2, none), gnomon_select(some3, begin3, none));
        stops = ordered4_make(gnomon_select(some0, end0, none), gnomon_select(some1, end1, none),
                              gnomon_select(some2, end2, none), gnomon_select(some3, end, none));
        x.count = (gnomon_select(some0, Real(1), Real(0)) + gnomon_select(some1, Real(1), Real(0))) +
                  (gnomon_select(some2, Real(1), Real(0)) + gnomon_select(some3, Real(1), Real(0)));
        x.begin0 = starts.first;
        x.end0 = stops.first;
        x.begin1 = starts.second;
        x.end1 = stops.second;
        x.begin2 = starts.third;
        x.end2 = stops.third;
        x.begin3 = starts.fourth;
        x.end3 = stops.fourth;
    }
    return x;
}

/// Times at which a triangle that turns this side to the sample covers it: all three edge functions are >= 0, or <= 0
/// if facing is negative. A sample on the border is covered. A triangle without area, with three edge functions that
/// are 0 throughout, covers nothing.
/// Domain: none for coefficients that moving_edge_inside refuses.
/// NaN: none.
/// Error: that of moving_edge_inside.
/// Source: Gribel 2010; Palmer 2011, Sec. 2.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr coverage_intervals<Real> moving_coverage(moving_edges<Real> e,
                                                                 std::type_identity_t<Real> facing)
{
    edge_intervals a = moving_edge_inside(e.a, facing);
    Real size = (moving_edge_size(e.a) + moving_edge_size(e.b)) + moving_edge_size(e.c);
    a.end = gnomon_select(Real(0) < size, a.end, Real(0));
    return intersect_edge_intervals(a, moving_edge_inside(e.b, facing), moving_edge_inside(e.c, facing));
}

/// Total duration of the intervals, in [0, 1].
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real coverage_duration(coverage_intervals<Real> x)
{
    return saturate_or_zero(((x.end0 - x.begin0) + (x.end1 - x.begin1)) + ((x.end2 - x.begin2) + (x.end3 - x.begin3)));
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/receiver_path.h -------------------------------------------------------------------------------------
// The path of a receiver through the light's clip space while a pixel sees it, and its shadow by samples in time
// (Palmer 2011, 2.3.2 and 4.1).
//
// The receiver's point and the light move along straight lines, and the light does not turn, so x, y and w are linear
// in time. The point on the map, (x / w, y / w), moves along a straight line, too; w is 1 for an orthographic light.
// Depth is linear in view distance, hence linear in time: depth and time are those of a range.
//
//     n = receiver_sample_count(path, most);
//     state = sampled_receiver_begin(n);
//     for k from 0 to n - 1: t = receiver_sample_time(path, k, n, jitter); in the texel at receiver_path_at(path, t),
//     the largest range_intensity(range, t, range_depth(path.depth, t), path.depth.id, bias) of all ranges, then
//         state = sampled_receiver_add(state, largest);     or the mean of several texels by their weights
//     intensity = sampled_receiver_end(state);
#ifndef GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H
#define GNOMON_MOTION_RECEIVER_RECEIVER_PATH_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Times, depths and id as a range; homogeneous positions at the times t0 and t1, where x / w and y / w are in texels,
/// texel centres at +0.5.
template <class Real, class = require_real<Real>> struct receiver_path
{
    depth_time_range<Real> depth;
    Real x0, y0, w0, x1, y1, w1;
};

/// A position in texels, texel centres at +0.5.
template <class Real, class = require_real<Real>> struct texel_position { Real x, y; };

inline constexpr double receiver_sample_limit = 1048576.0; // 2^20

/// Position on the map at time t, held constant before the path begins and after it ends.
/// Domain: w > 0 at both ends.
/// Error: 8 2^-p times the largest |x| where w is 1; in perspective that times (1 + the larger w over the smaller w).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_position<Real> receiver_path_at(receiver_path<Real> path, Real t)
{
    Real passed = range_elapsed(path.depth, t);
    Real left = Real(1) - passed;
    Real w = path.w0 * left + path.w1 * passed;
    texel_position<Real> r;
    r.x = (path.x0 * left + path.x1 * passed) / w;
    r.y = (path.y0 * left + path.y1 * passed) / w;
    return r;
}

/// The path shifted by dx and dy texels on the map.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr receiver_path<Real> receiver_path_shift(receiver_path<Real> path, Real dx, Real dy)
{
    path.x0 = path.x0 + dx * path.w0;
    path.y0 = path.y0 + dy * path.w0;
    path.x1 = path.x1 + dx * path.w1;
    path.y1 = path.y1 + dy * path.w1;
    return path;
}

/// The part of the path between the times begin and end, such as those at which the receiver faces the light
/// (facing.h).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr receiver_path<Real> receiver_path_clip(receiver_path<Real> path, Real begin, Real end)
{
    Real passed0 = range_elapsed(path.depth, begin);
    Real passed1 = range_elapsed(path.depth, end);
    Real left0 = Real(1) - passed0;
    Real left1 = Real(1) - passed1;
    receiver_path<Real> c;
    c.depth = range_clip(path.depth, begin, end);
    c.x0 = path.x0 * left0 + path.x1 * passed0;
    c.y0 = path.y0 * left0 + path.y1 * passed0;
    c.w0 = path.w0 * left0 + path.w1 * passed0;
    c.x1 = path.x0 * left1 + path.x1 * passed1;
    c.y1 = path.y0 * left1 + path.y1 * passed1;
    c.w1 = path.w0 * left1 + path.w1 * passed1;
    return c;
}

/// Length of the path on the map, in texels.
/// Domain: w > 0 at both ends.
/// Error: 4 2^-p times the largest |x| + |y|.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real receiver_path_length(receiver_path<Real> path)
{
    Real dx = path.x1 / path.w1 - path.x0 / path.w0;
    Real dy = path.y1 / path.w1 - path.y0 / path.w0;
    return gnomon_sqrt(dx * dx + dy * dy);
}

/// Number of samples for a path: max(2 length, 5), rounded up, at most `most`. A whole number.
/// Domain: most is a whole number from 5 to 2^20, and is clamped to that.
/// NaN: a NaN counts as 5.
/// Source: Palmer 2011, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real receiver_sample_count(receiver_path<Real> path, std::type_identity_t<Real> most)
{
    Real wanted = gnomon_max(Real(2) * receiver_path_length(path), Real(5)); // a NaN becomes 5
    Real limit = gnomon_min(gnomon_max(most, Real(5)), literal<Real>(receiver_sample_limit));
    Real count = gnomon_min(wanted, limit);
    Real whole = nearest_integer(count);
    return whole + gnomon_select(whole < count, Real(1), Real(0));
}

/// Time of sample k of n, k from 0, stratified: at `jitter`, in [0, 1), of the k-th of n equal parts of the time. A
/// jitter of 0.5 is the middle of the part.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real receiver_sample_time(receiver_path<Real> path, Real k, Real n, Real jitter)
{
    Real passed = saturate_or_zero((k + jitter) / n);
    return path.depth.t0 * (Real(1) - passed) + path.depth.t1 * passed;
}

/// Number of samples, and the sum of their shadow intensities so far.
template <class Real, class = require_real<Real>> struct sampled_receiver { Real samples, shadowed; };

/// Begin with the number of samples to come.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr sampled_receiver<Real> sampled_receiver_begin(Real samples)
{
    sampled_receiver<Real> r;
    r.samples = samples;
    r.shadowed = Real(0);
    return r;
}

/// Add one sample by its shadow intensity in [0, 1].
/// NaN: the sample is lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr sampled_receiver<Real> sampled_receiver_add(sampled_receiver<Real> state, Real intensity)
{
    state.shadowed = state.shadowed + saturate_or_zero(intensity);
    return state;
}

/// Shadow intensity in [0, 1]: the mean of all samples.
/// Error: that of sampling: up to 1 / n for each time at which the shadow comes or goes, half of that with samples in
/// the middle.
/// Source: Palmer 2011, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real sampled_receiver_end(sampled_receiver<Real> state)
{
    return saturate_or_zero(state.shadowed / state.samples);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/texel_sweep.h ---------------------------------------------------------------------------------------
// The texels that a moving receiver passes, in order, and the time that it spends in each (for the analytical dynamic
// receivers that Palmer 2011, chapter 5, leaves as future work; the traversal is that of Amanatides & Woo 1987, in time
// and in perspective).
//
// The path crosses the texel border x = c where x(t) - c w(t) = 0, which is linear in time, also in perspective. The
// share of the path's time at the crossing is
//     s = (x0 - c w0) / ((x0 - c w0) - (x1 - c w1))
// While w > 0, x / w is monotonic, so the path crosses the borders between its first and its last column one after the
// other, and those of rows alike. The earlier of the next two crossings is the next step. Texels come from counting
// steps, times from the borders. Where rounding makes two times equal, their steps come in either order, and the texel
// between them lasts no time.
//
//     sweep = texel_sweep_begin(path);
//     for each range of texel (sweep.column, sweep.row): use the part from sweep.t_begin to sweep.t_end
//     while (sweep.t_end < sweep.t_last) { sweep = texel_sweep_next(sweep); and the same again }
//
// For any path the times are contiguous from t0 to t1, bit for bit, and the loop ends after at most |last column -
// first column| + |last row - first row| + 1 texels.
//
// texel_sweep_over leaves out the parts of the path that are beside the map or behind the light. In homogeneous
// coordinates the map's borders are edges that the path crosses at one time each, also where w changes its sign.
#ifndef GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H
#define GNOMON_MOTION_RECEIVER_TEXEL_SWEEP_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The current texel and the times at which the path enters and leaves it; the last texel and the time at which the
/// sweep ends; the shares of the path's time at which it crosses the next borders.
template <class Real, class = require_real<Real>> struct texel_sweep
{
    receiver_path<Real> path;
    Real column, row, t_begin, t_end, last_column, last_row, t_last, across_column, across_row;
};

inline constexpr double texel_path_limit = 1152921504606846976.0; // 2^60: positions that are numbers
inline constexpr double texel_border_none = 2.0;                  // after the end of the path

/// Share of the path's time, in [0, 1], at which one coordinate leaves a texel towards the last texel; 2 in the last
/// texel.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, and 2 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real texel_border_share(Real x0, Real w0, Real x1, Real w1, Real texel, Real last)
{
    Real border = texel + gnomon_select(texel < last, Real(1), Real(0));
    Real distance0 = x0 - gnomon_product(border, w0);
    Real distance1 = x1 - gnomon_product(border, w1);
    return gnomon_select(texel == last, literal<Real>(texel_border_none),
                         saturate_or_zero(distance0 / (distance0 - distance1)));
}

/// End the texel's time at the next border, or at the end of the sweep.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_sweep<Real> texel_sweep_set_times(texel_sweep<Real> sweep)
{
    Real passed = gnomon_min(sweep.across_column, sweep.across_row);
    Real t = sweep.path.depth.t0 * (Real(1) - passed) + sweep.path.depth.t1 * passed;
    t = gnomon_min(gnomon_max(t, sweep.t_begin), sweep.t_last); // never back; a NaN lasts no time
    sweep.t_end = gnomon_select(passed <= Real(1), t, sweep.t_last);
    return sweep;
}

/// Find the first crossings of borders.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_sweep<Real> texel_sweep_start(texel_sweep<Real> sweep)
{
    receiver_path p = sweep.path;
    sweep.across_column = texel_border_share(p.x0, p.w0, p.x1, p.w1, sweep.column, sweep.last_column);
    sweep.across_row = texel_border_share(p.y0, p.w0, p.y1, p.w1, sweep.row, sweep.last_row);
    return texel_sweep_set_times(sweep);
}

/// The first texel of a path, for the whole of its time.
/// Domain: for positions beyond 2^60, w <= 0 at an end, or times out of order, the sweep has one texel for the whole
/// time: that of the path's first end, or (65536, 65536), off every map, if that position is unknown, too.
/// NaN: as outside of the domain.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_sweep<Real> texel_sweep_begin(receiver_path<Real> path)
{
    Real x0 = path.x0 / path.w0;
    Real y0 = path.y0 / path.w0;
    Real x1 = path.x1 / path.w1;
    Real y1 = path.y1 / path.w1;
    Real size = (gnomon_abs(x0) + gnomon_abs(y0)) + (gnomon_abs(x1) + gnomon_abs(y1));
    mask_t<Real> known = Real(0) < path.w0 && Real(0) < path.w1 && size < literal<Real>(texel_path_limit);
    texel_sweep<Real> sweep;
    sweep.path = path;
    sweep.column = texel_below(x0);
    sweep.row = texel_below(y0);
    sweep.t_begin = path.depth.t0;
    sweep.last_column = gnomon_select(known, texel_below(x1), sweep.column);
    sweep.last_row = gnomon_select(known, texel_below(y1), sweep.row);
    sweep.t_last = path.depth.t1;
    return texel_sweep_start(sweep);
}

/// Shares of the path's time, in [0, 1], at which the path is over the texels from (left, top) to before (right,
/// bottom), and w >= 0.
/// Domain: empty for positions that differ by 2^60 or more.
/// NaN: empty.
/// Error: 4 2^-p (|x0| + |c| w0 + |x1| + |c| w1) over the distance from x0 - c w0 to x1 - c w1, for the border x = c
/// that is crossed; rows alike.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr linear_interval<Real> receiver_path_over(receiver_path<Real> p, Real left, Real top, Real right,
                                                                 Real bottom)
{
    linear_interval a = linear_edge_inside(p.x0 - gnomon_product(left, p.w0), p.x1 - gnomon_product(left, p.w1));
    linear_interval b = linear_edge_inside(p.y0 - gnomon_product(top, p.w0), p.y1 - gnomon_product(top, p.w1));
    linear_interval c = linear_edge_inside(gnomon_product(right, p.w0) - p.x0, gnomon_product(right, p.w1) - p.x1);
    linear_interval d = linear_edge_inside(gnomon_product(bottom, p.w0) - p.y0, gnomon_product(bottom, p.w1) - p.y1);
    linear_interval before_light = linear_edge_inside(p.w0, p.w1);
    a.begin = gnomon_max(gnomon_max(gnomon_max(a.begin, b.begin), gnomon_max(c.begin, d.begin)), before_light.begin);
    a.end = gnomon_min(gnomon_min(gnomon_min(a.end, b.end), gnomon_min(c.end, d.end)), before_light.end);
    return a;
}

/// Column or row of a position, limited to low - 1, before the first, and high, after the last.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real texel_clamp(Real x, Real low, Real high)
{
    return gnomon_min(gnomon_max(texel_below(x), low - Real(1)), high);
}

/// The first of the texels from (left, top) to before (right, bottom) that the path is over; (right, bottom) for no
/// time if there is none. The times are those of texel_sweep_begin for these texels. If w <= 0 at one end, the sweep
/// covers the time at which w > 0.
/// Domain: borders are whole numbers within +-65536.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_sweep<Real> texel_sweep_over(receiver_path<Real> path, Real left, Real top, Real right,
                                                           Real bottom)
{
    linear_interval shares = receiver_path_over(path, left, top, right, bottom);
    mask_t<Real> some = shares.begin < shares.end;
    Real passed0 = gnomon_select(some, shares.begin, Real(0));
    Real passed1 = gnomon_select(some, shares.end, Real(0));
    Real left0 = Real(1) - passed0;
    Real left1 = Real(1) - passed1;
    Real w0 = path.w0 * left0 + path.w1 * passed0;
    Real w1 = path.w0 * left1 + path.w1 * passed1;
    texel_sweep<Real> sweep;
    sweep.path = path;
    sweep.column = texel_clamp((path.x0 * left0 + path.x1 * passed0) / w0, left, right);
    sweep.row = texel_clamp((path.y0 * left0 + path.y1 * passed0) / w0, top, bottom);
    sweep.last_column = texel_clamp((path.x0 * left1 + path.x1 * passed1) / w1, left, right);
    sweep.last_row = texel_clamp((path.y0 * left1 + path.y1 * passed1) / w1, top, bottom);
    sweep.column = gnomon_select(some, sweep.column, right);
    sweep.row = gnomon_select(some, sweep.row, bottom);
    sweep.last_column = gnomon_select(some, sweep.last_column, right);
    sweep.last_row = gnomon_select(some, sweep.last_row, bottom);
    sweep.t_begin = path.depth.t0 * left0 + path.depth.t1 * passed0;
    sweep.t_last = path.depth.t0 * left1 + path.depth.t1 * passed1;
    return texel_sweep_start(sweep);
}

/// The next texel: a neighbour along either axis. After the last texel that texel again, for no time.
/// Source: Amanatides & Woo 1987
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr texel_sweep<Real> texel_sweep_next(texel_sweep<Real> sweep)
{
    mask_t<Real> sideways = sweep.across_column <= sweep.across_row && sweep.across_column <= Real(1);
    mask_t<Real> along = sweep.across_row < sweep.across_column && sweep.across_row <= Real(1);
    Real step_column = gnomon_select(sweep.column < sweep.last_column, Real(1), Real(-1));
    Real step_row = gnomon_select(sweep.row < sweep.last_row, Real(1), Real(-1));
    sweep.column = sweep.column + gnomon_select(sideways, step_column, Real(0));
    sweep.row = sweep.row + gnomon_select(along, step_row, Real(0));
    // Only the axis that stepped has a new border.
    Real x0 = gnomon_select(sideways, sweep.path.x0, sweep.path.y0);
    Real x1 = gnomon_select(sideways, sweep.path.x1, sweep.path.y1);
    Real texel = gnomon_select(sideways, sweep.column, sweep.row);
    Real last = gnomon_select(sideways, sweep.last_column, sweep.last_row);
    Real passed = texel_border_share(x0, sweep.path.w0, x1, sweep.path.w1, texel, last);
    sweep.across_column = gnomon_select(sideways, passed, sweep.across_column);
    sweep.across_row = gnomon_select(sideways, sweep.across_row, passed);
    sweep.t_begin = sweep.t_end;
    return texel_sweep_set_times(sweep);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/moving_receiver.h -----------------------------------------------------------------------------------
// The shadow on a moving receiver while the shutter is open, in closed form: the Analytical Dynamic Receivers that
// Palmer 2011 leaves as future work (chapter 5). A texel sweep (texel_sweep.h) finds the texels that the receiver
// passes and the times that it spends in each. In each texel, a range of the resolved list is in front of the
// receiver's depth line for a time in closed form, as in static_receiver.h, which is the case of one texel and a level
// line. Exact except for rounding, where Palmer takes 2 samples for each texel.
//
//     state = moving_receiver_begin(path, begin, end);
//     for each texel of a texel sweep of the path: state = moving_receiver_texel(state, sweep);
//         for every range of the texel:
//             hidden = moving_receiver_occluding_part(state, range);
//             share0 = shutter_box(hidden.t0, state.begin, state.end);   and share1 at hidden.t1; or shutter_tent,
//                                                                        shutter_piecewise
//             state = moving_receiver_add(state, receiver_lost_light(hidden, path.depth.id, share0, share1));
//     intensity = moving_receiver_end(state);
//
// With filtering, the weight of a texel changes along the path. Between the centres of texels the bilinear weights of
// the receiver's position are products of two functions that are linear in time, and the response of a shutter is
// piecewise linear. So the light lost to a range is the integral of a product of three lines. Percentage-closer
// filtering of K x K bilinear look-ups (K = 1 is bilinear filtering alone):
//     for each texel of a texel sweep of receiver_path_shift(path, -K / 2, -K / 2), i and j from 0 to K:
//         state = moving_receiver_tap(state, sweep, i, j, K);
//         for every range of texel (column + i, row + j):
//             hidden = moving_receiver_occluding_part(state, range);
//             lost = moving_receiver_filtered_light(state, hidden, state.begin, state.end, 1, 0);   for a box; for a
//                 tent the sum for two halves of the exposure, for a piecewise shutter that for eight parts
//             state = moving_receiver_add(state, lost);
// The result is the mean of K x K receivers with bilinear filtering, each on the path shifted by whole texels.
#ifndef GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H
#define GNOMON_MOTION_RECEIVER_MOVING_RECEIVER_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The receiver's depth line; the times at which the shutter opens and closes; the times at which the receiver enters
/// and leaves the current texel; the texel's weights along both axes at these two times; and the share of the light
/// that is lost so far.
template <class Real, class = require_real<Real>> struct moving_receiver
{
    depth_time_range<Real> depth;
    Real begin, end, t0, t1, u0, v0, u1, v1, shadowed;
};

/// Begin without a texel. The exposure lasts from begin to end, as of shutter_exposure_make. A depth bias, if one is
/// needed, is subtracted from both depths of the path first. A path that lasts for a part of the exposure loses light
/// only in that part: divide the result by the shutter's share of that part.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_receiver<Real> moving_receiver_begin(receiver_path<Real> path, Real begin, Real end)
{
    shutter_exposure open = shutter_exposure_make(begin, end);
    moving_receiver<Real> r;
    r.depth = path.depth;
    r.begin = open.begin;
    r.end = open.end;
    r.t0 = path.depth.t0;
    r.t1 = path.depth.t1;
    r.u0 = Real(1);
    r.v0 = Real(1);
    r.u1 = Real(1);
    r.v1 = Real(1);
    r.shadowed = Real(0);
    return r;
}

/// Begin the ranges of the sweep's texel.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_receiver<Real> moving_receiver_texel(moving_receiver<Real> state,
                                                                    texel_sweep<Real> sweep)
{
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    return state;
}

/// Begin the ranges of texel (column + i, row + j) of the (K + 1) x (K + 1) texels around a cell between texel centres,
/// with the sweep of a path shifted by -K / 2. look_ups is K.
/// Error: weights are linear in time in a cell, which in perspective is a chord: if w changes r-fold in the cell, its
/// error is (sqrt(r) - 1) / (sqrt(r) + 1) of the change of u and v in the cell.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_receiver<Real> moving_receiver_tap(moving_receiver<Real> state, texel_sweep<Real> sweep,
                                                                  std::type_identity_t<Real> i,
                                                                  std::type_identity_t<Real> j,
                                                                  std::type_identity_t<Real> look_ups)
{
    texel_position enters = receiver_path_at(sweep.path, sweep.t_begin);
    texel_position leaves = receiver_path_at(sweep.path, sweep.t_end);
    state.t0 = sweep.t_begin;
    state.t1 = sweep.t_end;
    state.u0 = texel_weight(enters.x - sweep.column, i, look_ups);
    state.v0 = texel_weight(enters.y - sweep.row, j, look_ups);
    state.u1 = texel_weight(leaves.x - sweep.column, i, look_ups);
    state.v1 = texel_weight(leaves.y - sweep.row, j, look_ups);
    return state;
}

/// The part of r that occludes the receiver in the current texel, possibly empty.
/// Error: that of range_occluding_part.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> moving_receiver_occluding_part(moving_receiver<Real> state,
                                                                              depth_time_range<Real> r)
{
    return range_occluding_part(r, state.depth, state.t0, state.t1);
}

/// Add the share of the light that is lost to one range.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_receiver<Real> moving_receiver_add(moving_receiver<Real> state, Real lost)
{
    state.shadowed = state.shadowed + lost;
    return state;
}

inline constexpr double receiver_twelfth = 0.083333333333333333333; // Dawn divides by 12 like this, too

/// Share of the light that the receiver loses while `hidden` occludes it, weighted as of moving_receiver_tap, in a part
/// of the exposure in which the shutter's response is a line: response + slope x at the share x of the exposure, from
/// time start to time stop. Add up the results for all parts: response 1 for a box; slope 4, then response 4 and slope
/// -4 for the two halves of a tent; response 8 w.w0, ..., 8 w.w7 for the eighths of a piecewise shutter. With P and Q
/// lines from a to b, the mean of P Q is (2 P_a Q_a + P_a Q_b + P_b Q_a + 2 P_b Q_b) / 6, and the mean of three lines
/// is similar; nothing cancels.
/// Error: that of moving_receiver_end.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moving_receiver_filtered_light(moving_receiver<Real> state, depth_time_range<Real> hidden,
                                                            Real start, Real stop, Real response, Real slope)
{
    Real a = gnomon_max(hidden.t0, start);
    Real b = gnomon_min(hidden.t1, stop);
    mask_t<Real> some = a < b;
    Real lost = Real(0);
    if (gnomon_any(some)) {
        Real share_a = shutter_box(a, state.begin, state.end);
        Real share_b = shutter_box(b, state.begin, state.end);
        Real passed_a = saturate_or_zero((a - state.t0) / (state.t1 - state.t0));
        Real passed_b = saturate_or_zero((b - state.t0) / (state.t1 - state.t0));
        Real u_a = state.u0 * (Real(1) - passed_a) + state.u1 * passed_a;
        Real v_a = state.v0 * (Real(1) - passed_a) + state.v1 * passed_a;
        Real u_b = state.u0 * (Real(1) - passed_b) + state.u1 * passed_b;
        Real v_b = state.v0 * (Real(1) - passed_b) + state.v1 * passed_b;
        Real aa = u_a * v_a;
        Real ab = u_a * v_b + u_b * v_a;
        Real bb = u_b * v_b;
        Real twelvefold = (response + slope * share_a) * (Real(3) * aa + ab + bb) + (response + slope * share_b) *
                          (aa + ab + Real(3) * bb);
        Real share = receiver_lost_light(hidden, state.depth.id, share_a, share_b);
        lost = gnomon_select(some, share * twelvefold * literal<Real>(receiver_twelfth), lost);
    }
    return lost;
}

/// Shadow intensity in [0, 1] over the whole exposure.
/// NaN: a range with a NaN adds nothing, and a receiver with one is lit.
/// Error: for each range that of static_receiver_end, filtered with 97 2^-p instead of 32; and that of the times at
/// which the path enters and leaves texels (texel_border_share), or of weights (receiver_path_at, and
/// moving_receiver_tap in perspective).
/// Source: Palmer 2011, Sec. 5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moving_receiver_end(moving_receiver<Real> state)
{
    return saturate_or_zero(state.shadowed);
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
