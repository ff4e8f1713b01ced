// Gnomon 0.1.0, receiver_footprint.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_RECEIVER_FOOTPRINT_CUH
#define GNOMON_RECEIVER_FOOTPRINT_CUH

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
#error "gnomon: receiver_footprint.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: receiver_footprint.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: receiver_footprint.cuh is not of the same version as a package before it"
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

// motion/layers/receiver_footprint.h ----------------------------------------------------------------------------------
// The time that one sample of a stochastic camera stands for. The camera takes N samples for each pixel, one in each
// stratum of the shutter interval. A look-up at the sample's own time is as noisy as the camera; the mean over the time
// that the sample stands for is not.
//
// During that time the point has to follow its surface (receiver_path.h). Held in place it would leave the surface,
// which then shadows it. With the path of the point and ranges, the mean is known in closed form:
//     exposure = footprint_stratum(t, N);
//     path = receiver_path_clip(path, exposure.begin, exposure.end);
//     moving_receiver_begin(path, exposure.begin, exposure.end), and so on (moving_receiver.h)
// The strata of a pixel's samples fill the shutter interval, so a point that its pixel sees all the time gets the mean
// over the whole interval, without noise and without bias.
#ifndef GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H
#define GNOMON_MOTION_LAYERS_RECEIVER_FOOTPRINT_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The stratum of `count` that holds time t, from begin to end.
/// Domain: t is clamped to [0, 1]; count is a whole number in [1, 65536].
/// NaN: the first stratum for t.
/// Error: 2^-p for each time.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr shutter_exposure<Real> footprint_stratum(Real t, Real count)
{
    Real slice = slice_of(t, count);
    shutter_exposure<Real> r;
    r.begin = saturate_or_zero(slice / count);
    r.end = saturate_or_zero((slice + Real(1)) / count);
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
