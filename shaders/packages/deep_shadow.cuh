// Gnomon 0.1.0, deep_shadow.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_DEEP_SHADOW_CUH
#define GNOMON_DEEP_SHADOW_CUH

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
#error "gnomon: deep_shadow.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: deep_shadow.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: deep_shadow.cuh is not of the same version as a package before it"
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

// motion/range/deep_shadow.h ------------------------------------------------------------------------------------------
// Deep shadow maps (Lokovic & Veach 2000): transmittance over depth for each texel, from 1 in front of all occluders to
// that behind them. What moves covers a texel for a part of the time, so motion counts as translucency: time is
// collapsed, which is right for static receivers under a static light and for no others.
//
// A deep layer takes away a share of the light, its opacity, evenly from depth z0 to depth z1, or at once if both are
// equal. Layers multiply, in any order:
//     transmittance = 1;   for every layer of the texel: transmittance = deep_shadow_add(transmittance, layer, z_f)
//     intensity = deep_shadow_end(transmittance);
//
// The layers of a texel come from its transmittance as a polyline over depth, which is compressed to a tolerance by a
// greedy window of slopes: one line goes on for as long as it passes all vertices within the tolerance.
//     window = deep_window_begin(tolerance);
//     for each vertex from near to far: window = deep_window_add(window, z, v), and keep window.layer
//     layer = deep_window_end(window), kept, too
// Layers of opacity 0 are not kept.
// The n sorted depths of samples have two vertices each: (z_k, 1 - k / n) and (z_k, 1 - (k + 1) / n), k from 0.
//
// With ever more samples the polyline becomes the one of a resolved list, in closed form: each range that covers the
// texel for a time takes that time's share of the light, evenly over its depths (deep_shadow_share). So lists of ranges
// give the deep map that samples converge to.
#ifndef GNOMON_MOTION_RANGE_DEEP_SHADOW_H
#define GNOMON_MOTION_RANGE_DEEP_SHADOW_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A layer that takes the share `opacity` of the light that reaches it, evenly from depth z0 to z1 >= z0.
template <class Real, class = require_real<Real>> struct deep_layer { Real z0, z1, opacity; };

/// Transmittance behind one more layer, for a receiver at depth z_f, from the transmittance so far; 1 before the first.
/// A layer of one depth takes its light from receivers behind that depth.
/// NaN: a layer with a NaN takes nothing.
/// Error: 4 2^-p for each layer.
/// Source: Lokovic & Veach 2000
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real deep_shadow_add(Real transmittance, deep_layer<Real> layer, Real z_f)
{
    Real passed = saturate_or_zero((z_f - layer.z0) / (layer.z1 - layer.z0));
    return transmittance * (Real(1) - saturate_or_zero(layer.opacity * passed));
}

/// Shadow intensity in [0, 1] of the transmittance in front of a receiver.
/// NaN: 0, lit.
/// Error: that of deep_shadow_add.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real deep_shadow_end(Real transmittance) { return saturate_or_zero(Real(1) - transmittance); }

/// Share of the shutter interval for which a range is in front of depth z_f, in [0, 1]. 1 minus the sum over a resolved
/// list is the transmittance at z_f.
/// NaN: 0.
/// Error: 4 2^-p of the duration.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real deep_shadow_share(depth_time_range<Real> r, Real z_f)
{
    depth_time_range c = range_clip(r, Real(0), Real(1));
    Real nearest = gnomon_min(c.z0, c.z1);
    Real passed = saturate_or_zero((z_f - nearest) / (gnomon_max(c.z0, c.z1) - nearest));
    mask_t<Real> known = c.z0 == c.z0 && c.z1 == c.z1;
    return saturate_or_zero(gnomon_select(known, range_duration(c) * passed, Real(0)));
}

/// The tolerance; the line from depth z0 and transmittance v0 to depth z1 and transmittance v1, and the slopes between
/// which it passes its vertices, least above most if it ends here; the last vertex's transmittance, v; touched, 1 if
/// the line has a vertex after its begin; and the layer that the last vertex has completed, of opacity 0 if none.
template <class Real, class = require_real<Real>> struct deep_window
{
    Real tolerance, z0, v0, z1, v1, least, most, v, touched;
    deep_layer<Real> layer;
};

inline constexpr double deep_window_steepest = 1099511627776.0; // 2^40: depths closer than its inverse count as equal

/// The layer of the line so far, of opacity 0 if transmittance does not change.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_layer<Real> deep_window_end(deep_window<Real> window)
{
    deep_layer<Real> r;
    r.z0 = window.z0;
    r.z1 = window.z1;
    r.opacity = saturate_or_zero((window.v0 - window.v1) / window.v0);
    return r;
}

/// A line that begins where the last one ends, and has no other vertex.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_window<Real> deep_window_next(deep_window<Real> window)
{
    window.layer = deep_window_end(window);
    window.z0 = window.z1;
    window.v0 = window.v1;
    window.least = Real(-1) * literal<Real>(deep_window_steepest);
    window.most = Real(0);
    window.touched = Real(0);
    return window;
}

/// Begin at the near plane, -1, with transmittance 1. tolerance is the most by which lines may depart from the
/// polyline. With 0 every step and every slope of the polyline becomes a layer.
/// NaN: a tolerance of 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_window<Real> deep_window_begin(Real tolerance)
{
    deep_window<Real> r;
    r.tolerance = gnomon_max(tolerance, Real(0));
    r.z0 = Real(-1);
    r.v0 = Real(1);
    r.z1 = Real(-1);
    r.v1 = Real(1);
    r.v = Real(1);
    return deep_window_next(r);
}

/// The line led to one more vertex, z >= window.z1 and v <= window.v. Where it cannot pass all of its vertices it ends.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_window<Real> deep_window_lead(deep_window<Real> window, Real z, Real v)
{
    Real length = z - window.z0;
    Real lowest = (gnomon_max(v - window.tolerance, Real(0)) - window.v0) / length;
    Real highest = (v + window.tolerance - window.v0) / length;
    Real least = gnomon_max(window.least, lowest);
    Real most = gnomon_min(window.most, highest);
    Real nearest = saturate_or_zero(clamp_or_high(v, window.v0 + least * length, window.v0 + most * length));
    mask_t<Real> level = window.touched < Real(1) && v == window.v && window.z1 < z; // no line begins before a drop
    mask_t<Real> step = length * literal<Real>(deep_window_steepest) <= Real(1);
    mask_t<Real> kept = level || (step && window.v0 <= v + window.tolerance);
    window.least = gnomon_select(kept, window.least, gnomon_select(step, Real(1), least));
    window.most = gnomon_select(kept, window.most, gnomon_select(step, Real(0), most));
    window.v1 = gnomon_select(kept, window.v0, gnomon_select(step, v, nearest));
    window.z0 = gnomon_select(level, z, window.z0);
    window.touched = gnomon_select(level, Real(0), Real(1));
    window.z1 = z;
    window.v = v;
    return window;
}

/// a where the mask is set, b elsewhere.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_window<Real> deep_window_select(mask_t<Real> mask, deep_window<Real> a,
                                                             deep_window<Real> b)
{
    b.z0 = gnomon_select(mask, a.z0, b.z0);
    b.v0 = gnomon_select(mask, a.v0, b.v0);
    b.z1 = gnomon_select(mask, a.z1, b.z1);
    b.v1 = gnomon_select(mask, a.v1, b.v1);
    b.least = gnomon_select(mask, a.least, b.least);
    b.most = gnomon_select(mask, a.most, b.most);
    b.touched = gnomon_select(mask, a.touched, b.touched);
    b.layer.z0 = gnomon_select(mask, a.layer.z0, b.layer.z0);
    b.layer.z1 = gnomon_select(mask, a.layer.z1, b.layer.z1);
    b.layer.opacity = gnomon_select(mask, a.layer.opacity, b.layer.opacity);
    return b;
}

/// Add a vertex of the polyline, transmittance v at depth z; two at one depth are a step. If the layer of the result
/// has an opacity above 0 it is complete, and the caller keeps it.
/// Domain: vertices from near to far, transmittance in [0, 1] and never growing; others are moved to the nearest such.
/// Depths closer than 2^-40 count as equal.
/// NaN: the vertex is left out, as is one beyond 2^60.
/// Error: with all layers kept, the tolerance and 4 2^-p for each of them.
/// Source: Lokovic & Veach 2000
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr deep_window<Real> deep_window_add(deep_window<Real> window, Real z, Real v)
{
    mask_t<Real> known = gnomon_abs(z) < literal<Real>(range_far) && v == v;
    Real touched = window.touched;
    z = gnomon_select(known, gnomon_max(z, window.z1), window.z1);
    v = gnomon_select(known, gnomon_min(saturate_or_zero(v), window.v), window.v);
    window.layer.opacity = Real(0);
    deep_window led = deep_window_lead(window, z, v);
    mask_t<Real> deeper = window.most < window.least && (z - window.z0) *
                          literal<Real>(deep_window_steepest) <= Real(1);
    mask_t<Real> done = known && !(deeper || (window.least <= window.most && led.least <= led.most));
    if (gnomon_any(done)) led = deep_window_select(done, deep_window_lead(deep_window_next(window), z, v), led);
    led.touched = gnomon_select(known, led.touched, touched);
    return led;
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
