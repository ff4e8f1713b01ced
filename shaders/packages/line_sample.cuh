// Gnomon 0.1.0, line_sample.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LINE_SAMPLE_CUH
#define GNOMON_LINE_SAMPLE_CUH

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
#error "gnomon: line_sample.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: line_sample.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: line_sample.cuh is not of the same version as a package before it"
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

// motion/triangle/moving_triangle.h -----------------------------------------------------------------------------------
// A triangle whose vertices move linearly through clip space while the shutter is open (Akenine-Moller et al. 2007), as
// one sample of a shadow map sees it: edge functions, coverage, depth.
//
// A vertex is p(t) = (1 - t) q + t r. Sheared by the sample (s_x, s_y), its coordinates (x - s_x w, y - s_y w) are
// linear in t as well, and 0 where the vertex projects to the sample. An edge function is the cross product of two
// sheared vertices, a quadratic in t, also in perspective (w is 1 in an orthographic view):
//     e(t) = p_i(t) x p_j(t) = (1 - t)^2 q_i x q_j + t (1 - t) (q_i x r_j + r_i x q_j) + t^2 r_i x r_j
// This is the homogeneous edge function of Laine & Karras 2011. The point of the triangle that the sample sees is the
// mean of the vertices, each weighted by the edge function opposite to it. So depth is a cubic over a cubic,
//     z / w = sum_k e_k(t) z_k(t) / sum_k e_k(t) w_k(t)
// Depth that is linear in view distance is affine in the point, so its w_k is 1 and it is a cubic over a quadratic.
// Lists of ranges approximate depth by lines (Palmer 2011, 2.1 and 2.3.2), as many as a tolerance requires (chapter 5).
//
// The deviation of depth from a line is bounded, not sampled. Let depth be N / D, let h be the line through it at both
// ends of an interval, and let u go from 0 to 1 there. N - h D vanishes at both ends, so it is u (1 - u) P(u). D / (u
// (1 - u)) is at least some constant c. So |N / D - h| is at most |P| / c, with equality for a parabola.
#ifndef GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H
#define GNOMON_MOTION_TRIANGLE_MOVING_TRIANGLE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A vertex in clip space, at shutter open (x0, ...) and at shutter close (x1, ...).
template <class Real, class = require_real<Real>> struct moving_vertex { Real x0, y0, z0, w0, x1, y1, z1, w1; };

/// A triangle of three moving vertices.
template <class Real, class = require_real<Real>> struct moving_triangle { moving_vertex<Real> a, b, c; };

/// A vertex relative to a sample, at shutter open and at shutter close.
template <class Real, class = require_real<Real>> struct sheared_vertex { Real x0, y0, x1, y1; };

/// Depths at the ends of an interval, and an upper bound of the distance between depth and the line through them.
template <class Real, class = require_real<Real>> struct depth_line { Real z0, z1, deviation; };

/// A line of depth from time t0 to time t1, and the fraction of the whole interval that has passed at t1.
template <class Real, class = require_real<Real>> struct depth_piece { Real t0, t1, z0, z1, passed; };

/// A search for the length of a piece: the piece so far, the fraction of the interval at which it starts, the share of
/// the interval that it has, and whether it is settled, 1 or 0.
template <class Real, class = require_real<Real>> struct depth_trial
{
    depth_piece<Real> piece;
    Real start, share, settled;
};

/// Weights of a triangle's vertices; they need not sum to 1.
template <class Real, class = require_real<Real>> struct corner_weights { Real a, b, c; };

/// Bernstein coefficients of a cubic, the middle ones times 3.
template <class Real, class = require_real<Real>> struct bernstein_cubic { Real c0, c1, c2, c3; };

/// The vertex relative to the sample (s_x, s_y), which is in the units of x / w.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr sheared_vertex<Real> moving_vertex_shear(moving_vertex<Real> v, Real s_x, Real s_y)
{
    sheared_vertex<Real> r;
    r.x0 = v.x0 - gnomon_product(s_x, v.w0);
    r.y0 = v.y0 - gnomon_product(s_y, v.w0);
    r.x1 = v.x1 - gnomon_product(s_x, v.w1);
    r.y1 = v.y1 - gnomon_product(s_y, v.w1);
    return r;
}

/// Cross product of two vectors. Odd in the two vectors bit for bit, with and without contraction by the compiler.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real sheared_cross(Real a_x, Real a_y, Real b_x, Real b_y)
{
    return gnomon_product(a_x, b_y) - gnomon_product(a_y, b_x);
}

/// Edge function from a to b: positive where the sample is on the left of the edge. Exchanging a and b negates it bit
/// for bit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_edge<Real> moving_edge_make(sheared_vertex<Real> a, sheared_vertex<Real> b)
{
    moving_edge<Real> e;
    e.e0 = sheared_cross(a.x0, a.y0, b.x0, b.y0);
    e.e1 = Real(0.5) * (sheared_cross(a.x0, a.y0, b.x1, b.y1) + sheared_cross(a.x1, a.y1, b.x0, b.y0));
    e.e2 = sheared_cross(a.x1, a.y1, b.x1, b.y1);
    return e;
}

/// The three edge functions of a triangle, for moving_coverage. Positive where the triangle runs counterclockwise
/// around the sample.
/// Error: 32 2^-p (X_i Y_j + Y_i X_j) for a coefficient; the covered times are exact for coefficients that differ by as
/// much; X = max(|x| + |s_x w|) and Y = max(|y| + |s_y w|) over the shutter's ends, p the bits of the significand.
/// Source: Akenine-Moller 2007; Laine & Karras 2011
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_edges<Real> moving_triangle_edges(moving_triangle<Real> m, Real s_x, Real s_y)
{
    sheared_vertex a = moving_vertex_shear(m.a, s_x, s_y);
    sheared_vertex b = moving_vertex_shear(m.b, s_x, s_y);
    sheared_vertex c = moving_vertex_shear(m.c, s_x, s_y);
    moving_edges<Real> e;
    e.a = moving_edge_make(b, c);
    e.b = moving_edge_make(c, a);
    e.c = moving_edge_make(a, b);
    return e;
}

/// Weights of the vertices for the point that the sample sees at time t, not negative: the edge functions, those
/// against the triangle's facing as 0. If all three vanish, the weights are 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr corner_weights<Real> corner_weights_at(moving_edges<Real> e, Real t)
{
    corner_weights<Real> v;
    v.a = moving_edge_at(e.a, t);
    v.b = moving_edge_at(e.b, t);
    v.c = moving_edge_at(e.c, t);
    mask_t<Real> back = (v.a + v.b) + v.c < Real(0);
    v.a = gnomon_max(gnomon_select(back, Real(-1) * v.a, v.a), Real(0));
    v.b = gnomon_max(gnomon_select(back, Real(-1) * v.b, v.b), Real(0));
    v.c = gnomon_max(gnomon_select(back, Real(-1) * v.c, v.c), Real(0));
    mask_t<Real> vanished = (v.a + v.b) + v.c <= Real(0);
    v.a = gnomon_select(vanished, Real(1), v.a);
    v.b = gnomon_select(vanished, Real(1), v.b);
    v.c = gnomon_select(vanished, Real(1), v.c);
    return v;
}

/// Depth of the triangle's point at the sample at time t, in [-1, 1]; e from moving_triangle_edges. divided is 1 for
/// depth z / w, with z in clip space, and 0 for a z that is linear in view distance: the result is then the mean of the
/// vertices' z. Edge functions against the triangle's facing, which arise from rounding and outside of the covered
/// times, count as 0, so that the result lies between the depths of the vertices if all w > 0. If all three vanish, the
/// result is the depth of the centroid.
/// Domain: 1, the far plane, where the point is behind the light, w <= 0.
/// NaN: 1.
/// Error: that of the edge functions times sum_k |z_k - z v_k| / |sum_k e_k v_k|, and 16 2^-p of the largest |z_k /
/// v_k|; v = w where divided, else 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moving_depth_at(moving_triangle<Real> m, moving_edges<Real> e, Real t,
                                             std::type_identity_t<Real> divided)
{
    corner_weights v = corner_weights_at(e, t);
    Real s = Real(1) - t;
    Real z = (v.a * (m.a.z0 * s + m.a.z1 * t) + v.b * (m.b.z0 * s + m.b.z1 * t)) + v.c * (m.c.z0 * s + m.c.z1 * t);
    Real w = (v.a * (m.a.w0 * s + m.a.w1 * t) + v.b * (m.b.w0 * s + m.b.w1 * t)) + v.c * (m.c.w0 * s + m.c.w1 * t);
    Real divisor = gnomon_select(Real(0) < divided, w, (v.a + v.b) + v.c);
    Real depth = gnomon_max(gnomon_min(z / divisor, Real(1)), Real(-1)); // a NaN becomes 1
    return gnomon_select(Real(0) < w, depth, Real(1));
}

/// Upper bound of the deviation of N / D from its chord, where N - chord D = u (1 - u) P(u), |P| <= most, and D is a
/// cubic with the Bernstein coefficients d0, d0 + turn0, d3 + turn1, d3, the middle ones times 3. With turn the lesser
/// of the two, for positive D,
///     D(u) / (u (1 - u)) >= d0 / u + d3 / (1 - u) + turn - d0 - d3 >= turn + 2 sqrt(d0 d3)
/// The same holds for negative D, with -D. If D may vanish, the bound is 4, more than all depths.
/// NaN: 4.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_nonlinearity(Real most, Real d0, Real d3, Real turn0, Real turn1)
{
    mask_t<Real> negative = d0 < Real(0);
    Real turn = gnomon_select(negative, Real(-1) * gnomon_max(turn0, turn1), gnomon_min(turn0, turn1));
    Real product = d0 * d3;
    Real least = turn + Real(2) * gnomon_sqrt(product);
    mask_t<Real> known = Real(0) < product && Real(0) < least && least < literal<Real>(moving_edge_limit);
    return gnomon_select(known, most / least, Real(4));
}

/// The line from depth z0 to depth z1, with a bound of its deviation. Depths are limited to [least, most]. Without
/// these limits depth would be free0 and free1 at the ends, and deviate by bend from the line between them. A limit
/// that is passed in between adds no more than the distance of either end from its free depth; and no deviation exceeds
/// the limits.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_line<Real> depth_line_within(Real z0, Real z1, Real free0, Real free1, Real bend,
                                                           Real least, Real most)
{
    Real beyond = gnomon_max(gnomon_abs(free0 - z0), gnomon_abs(free1 - z1));
    Real all = gnomon_max(most - gnomon_min(z0, z1), gnomon_max(z0, z1) - least);
    depth_line<Real> r;
    r.z0 = z0;
    r.z1 = z1;
    r.deviation = gnomon_min(bend + gnomon_min(beyond, gnomon_abs(z1 - z0)), all); // a NaN becomes all
    return r;
}

/// Edge function between the times begin and end, by its Bernstein coefficients there, the middle one times 2.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_edge<Real> moving_edge_between(moving_edge<Real> e, Real begin, Real end)
{
    Real left = Real(1) - end;
    moving_edge<Real> r;
    r.e0 = moving_edge_at(e, begin);
    r.e1 = Real(2) * ((e.e0 * left + e.e1 * end) * (Real(1) - begin) + (e.e1 * left + e.e2 * end) * begin);
    r.e2 = moving_edge_at(e, end);
    return r;
}

/// Sum of the three edge functions from moving_edge_between, each times a linear function: from a0 to a1, from b0 to
/// b1, from c0 to c1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr bernstein_cubic<Real> moving_edges_combine(moving_edges<Real> e, Real a0, Real a1, Real b0,
                                                                   Real b1, Real c0, Real c1)
{
    bernstein_cubic<Real> r;
    r.c0 = (e.a.e0 * a0 + e.b.e0 * b0) + e.c.e0 * c0;
    r.c1 = ((e.a.e0 * a1 + e.a.e1 * a0) + (e.b.e0 * b1 + e.b.e1 * b0)) + (e.c.e0 * c1 + e.c.e1 * c0);
    r.c2 = ((e.a.e1 * a1 + e.a.e2 * a0) + (e.b.e1 * b1 + e.b.e2 * b0)) + (e.c.e1 * c1 + e.c.e2 * c0);
    r.c3 = (e.a.e2 * a1 + e.b.e2 * b1) + e.c.e2 * c1;
    return r;
}

/// Line through the depths at the times begin and end, and an upper bound of the deviation of depth from it. For
/// divided, see moving_depth_at. If the point may get behind the light, or D near 0, the bound is the largest deviation
/// of depths in [-1, 1].
/// Domain: begin <= end, both within one interval of moving_coverage.
/// Error: 64 2^-p sum_k e_k (z_k + (1 + deviation) v_k) / |D|; D = sum_k e_k(t) v_k(t) where |D| is least, and in the
/// numerator the largest coefficients of e_k, |z_k| and |v_k|; v = w where divided, else 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_line<Real> moving_depth_line(moving_triangle<Real> m, moving_edges<Real> e, Real begin,
                                                           Real end, std::type_identity_t<Real> divided)
{
    Real b = Real(1) - begin;
    Real f = Real(1) - end;
    moving_edges<Real> x;
    x.a = moving_edge_between(e.a, begin, end);
    x.b = moving_edge_between(e.b, begin, end);
    x.c = moving_edge_between(e.c, begin, end);
    bernstein_cubic n = moving_edges_combine(x, m.a.z0 * b + m.a.z1 * begin, m.a.z0 * f + m.a.z1 * end, m.b.z0 * b +
                                             m.b.z1 * begin, m.b.z0 * f + m.b.z1 * end, m.c.z0 * b + m.c.z1 * begin,
                                             m.c.z0 * f + m.c.z1 * end);
    Real a_w0 = m.a.w0 * b + m.a.w1 * begin;
    Real a_w1 = m.a.w0 * f + m.a.w1 * end;
    Real b_w0 = m.b.w0 * b + m.b.w1 * begin;
    Real b_w1 = m.b.w0 * f + m.b.w1 * end;
    Real c_w0 = m.c.w0 * b + m.c.w1 * begin;
    Real c_w1 = m.c.w0 * f + m.c.w1 * end;
    mask_t<Real> before = Real(0) < a_w0 && Real(0) < a_w1 && Real(0) < b_w0 && Real(0) < b_w1 && Real(0) < c_w0 &&
                          Real(0) < c_w1;
    mask_t<Real> by_w = Real(0) < divided;
    bernstein_cubic d = moving_edges_combine(x, gnomon_select(by_w, a_w0, Real(1)), gnomon_select(by_w, a_w1, Real(1)),
                                             gnomon_select(by_w, b_w0, Real(1)), gnomon_select(by_w, b_w1, Real(1)),
                                             gnomon_select(by_w, c_w0, Real(1)), gnomon_select(by_w, c_w1, Real(1)));
    Real free0 = n.c0 / d.c0;
    Real free1 = n.c3 / d.c3;
    Real turn0 = d.c1 - d.c0;
    Real turn1 = d.c2 - d.c3;
    Real p0 = (n.c1 - free0 * turn0) - free1 * d.c0;
    Real p1 = (n.c1 + n.c2) - (free0 * d.c2 + free1 * d.c1);
    Real p2 = (n.c2 - free1 * turn1) - free0 * d.c3;
    Real most = gnomon_max(gnomon_max(gnomon_abs(p0), gnomon_abs(p2)), Real(0.5) * gnomon_abs(p1));
    Real bend = gnomon_select(before, depth_nonlinearity(most, d.c0, d.c3, turn0, turn1), Real(4));
    return depth_line_within(moving_depth_at(m, e, begin, divided), moving_depth_at(m, e, end, divided), free0, free1,
                             bend, Real(-1), Real(1));
}

/// Time at which the fraction `passed` of an interval has passed: begin for 0, end for 1, in order between.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moving_depth_time(Real begin, Real end, Real passed)
{
    return gnomon_select(passed < Real(1), begin + gnomon_product(end - begin, passed), end);
}

/// The rest of an interval from the fraction `passed` on, as the first trial.
/// NaN: passed is then 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_trial<Real> depth_trial_begin(Real begin, Real end, Real passed)
{
    depth_trial<Real> r;
    r.start = saturate_or_zero(passed);
    r.share = Real(1) - r.start;
    r.settled = Real(0);
    r.piece.t0 = moving_depth_time(begin, end, r.start);
    r.piece.t1 = end;
    r.piece.z0 = Real(1);
    r.piece.z1 = Real(1);
    r.piece.passed = Real(1);
    return r;
}

/// The next trial. It is settled if its line deviates by at most the tolerance, or if its share is at most 33/1024:
/// there are at most 31 such pieces and a rest, since `passed` is rounded. Otherwise the piece is shortened to a half,
/// or to a third if a half would not suffice: lines of a parabola deviate by the squares of their lengths. A settled
/// trial stays so, with the same line.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_trial<Real> depth_trial_next(depth_trial<Real> trial, depth_line<Real> fit, Real begin,
                                                           Real end, std::type_identity_t<Real> tolerance)
{
    Real shortest = Real(0.0322265625);
    mask_t<Real> fits = fit.deviation <= tolerance || trial.share <= shortest;
    Real parts = gnomon_select(fit.deviation <= Real(4) * tolerance, Real(2), Real(3));
    Real shorter = gnomon_max(trial.share / parts, shortest);
    Real to = gnomon_min(trial.start + shorter, Real(1));
    trial.piece.z0 = fit.z0;
    trial.piece.z1 = fit.z1;
    trial.piece.t1 = gnomon_select(fits, trial.piece.t1, moving_depth_time(begin, end, to));
    trial.piece.passed = gnomon_select(fits, trial.piece.passed, to);
    trial.share = gnomon_select(fits, trial.share, shorter);
    trial.settled = gnomon_select(fits, Real(1), Real(0));
    return trial;
}

/// The next piece of an interval, from the fraction `passed` on, whose line deviates by at most the tolerance: the rest
/// of the interval, or a half or a third of that, and so on. Pieces are as long as their lines fit (Palmer 2011,
/// chapter 5):
///     for (passed = 0; passed < 1; passed = piece.passed)
///         piece = moving_depth_piece(m, e, begin, end, passed, divided, tolerance);
/// The loop gives 1 to 32 pieces. Each begins where the one before ends, bit for bit; the first begins at begin, the
/// last ends at end. Pieces before the last are never shorter than 33/1024 of the interval, even if the tolerance is
/// missed: where the triangle turns edge-on, no line fits. A tolerance below 0 gives 32 pieces.
/// NaN: a NaN tolerance gives 32 pieces; passed is then 0.
/// Error: that of moving_depth_line, for the deviation.
/// Source: Palmer 2011, Sec. 5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_piece<Real> moving_depth_piece(moving_triangle<Real> m, moving_edges<Real> e, Real begin,
                                                             Real end, Real passed, std::type_identity_t<Real> divided,
                                                             std::type_identity_t<Real> tolerance)
{
    depth_trial r = depth_trial_begin(begin, end, passed);
    for (int i = 0; i < 6; ++i) {
        if (gnomon_any(r.settled < Real(1))) r = depth_trial_next(r,
                                                                  moving_depth_line(m, e, r.piece.t0, r.piece.t1,
                                                                                    divided), begin, end, tolerance);
    }
    return r.piece;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/line_sample.h ---------------------------------------------------------------------------------------
// Line samples (Gribel, Barringer & Akenine-Moller 2011): a texel of a shadow map sees the scene at one instant along a
// line through its centre, instead of at all times from its centre. Of a triangle the line sees intervals, which are
// known exactly, so a shadow's edge that crosses the line is where it is, and not at the border of a texel. Time is
// sampled: a map of lines is of one instant.
//
// Everything else is that of ranges in time, with the place on the line for the time. The line is one texel long: place
// 0 is at its begin, 1 at its end. A sample that goes along the line while the scene stands still sees what a sample
// that stands still sees of a scene that goes the other way:
//
//     triangle.a = line_sample_vertex(a, segment), b and c alike;       once for each instant
//     edges = moving_triangle_edges(triangle, s_x, s_y);             and coverage, depth, ranges, lists as of any
// triangle
//
// A receiver reads the line at its own place on it. Lines of one direction leave the other one sampled. So a map of
// lines along x and one along y are crossed: of the four points at the receiver's x on the lines above and below, and
// at its y on the lines to the left and to the right,
//
//     at = line_sample_place_of(x);      texel at.texel of the row below y - 1/2, and of the next, along x, and so for
// y
//     hidden = range_intensity(range, at.place, z, id, bias);        the greatest of the texel's list
//     intensity = line_sample_intensity(up, down, left, right, share_x, share_y);
#ifndef GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H
#define GNOMON_MOTION_RECEIVER_LINE_SAMPLE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The time t of a line segment, and its extent: (1, 0) is along x and one texel long, (0, 1) along y. The middle is
/// the centre of the texel.
template <class Real, class = require_real<Real>> struct line_sample { Real t, along_x, along_y; };

/// A texel along a line's direction, and the place on its line, in [0, 1].
template <class Real, class = require_real<Real>> struct line_sample_place { Real texel, place; };

/// The vertex at the time of the segment, moved against it while the place goes from 0 to 1: shutter open stands for
/// place 0, shutter close for place 1. The units are those of x / w.
/// NaN: NaN.
/// Error: 8 2^-p (|q| + |r| + |along| (|q_w| + |r_w|)) for each coordinate, q and r those at shutter open and close.
/// Source: Gribel 2011
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moving_vertex<Real> line_sample_vertex(moving_vertex<Real> v, line_sample<Real> segment)
{
    Real s = Real(1) - segment.t;
    Real x = v.x0 * s + v.x1 * segment.t;
    Real y = v.y0 * s + v.y1 * segment.t;
    moving_vertex<Real> r;
    r.z0 = v.z0 * s + v.z1 * segment.t;
    r.w0 = v.w0 * s + v.w1 * segment.t;
    r.z1 = r.z0;
    r.w1 = r.w0;
    Real half_x = (Real(0.5) * segment.along_x) * r.w0;
    Real half_y = (Real(0.5) * segment.along_y) * r.w0;
    r.x0 = x + half_x;
    r.y0 = y + half_y;
    r.x1 = x - half_x;
    r.y1 = y - half_y;
    return r;
}

/// The texel that holds a position along the direction of lines, and the place on its line.
/// Domain: positions in [-65536, 65536].
/// NaN: place 0.
/// Error: exact for positions not below 0; else 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr line_sample_place<Real> line_sample_place_of(Real x)
{
    line_sample_place<Real> r;
    r.texel = texel_below(x);
    r.place = saturate_or_zero(x - r.texel);
    return r;
}

/// Shadow intensity in [0, 1] from those of four points around the receiver: up and down on lines along x, left and
/// right on lines along y. Two opposite points that agree decide, since a straight edge between them would part them;
/// up and down are first. Else the mean of both pairs, interpolated: share_y of the distance from up to down has passed
/// at the receiver, share_x of that from left to right.
/// Domain: intensities 0 or 1. Elsewhere a number in [0, 1].
/// NaN: 0 for the point, and 0 for a share.
/// Error: exact if two opposite points agree; else 8 2^-p.
/// Source: Gribel 2011
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real line_sample_intensity(Real up, Real down, Real left, Real right, Real share_x,
                                                   Real share_y)
{
    Real a = saturate_or_zero(up);
    Real b = saturate_or_zero(down);
    Real c = saturate_or_zero(left);
    Real d = saturate_or_zero(right);
    Real x = saturate_or_zero(share_x);
    Real y = saturate_or_zero(share_y);
    Real mean = Real(0.5) * ((a * (Real(1) - y) + b * y) + (c * (Real(1) - x) + d * x));
    return saturate_or_zero(gnomon_select(a == b, a, gnomon_select(c == d, c, mean)));
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
