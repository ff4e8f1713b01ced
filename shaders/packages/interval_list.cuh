// Gnomon 0.1.0, interval_list.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_INTERVAL_LIST_CUH
#define GNOMON_INTERVAL_LIST_CUH

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
#error "gnomon: interval_list.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: interval_list.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: interval_list.cuh is not of the same version as a package before it"
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

// motion/range/range_front.h ------------------------------------------------------------------------------------------
// The lower envelope of a list of ranges of any length, span by span: what the light sees of a texel from one time to
// another (Gribel et al. 2010; the resolve of Palmer 2011, 2.4). The caller owns both loops over the list, so that
// lists of any length can be resolved where no sorted structure is at hand, such as in a compute shader.
//
//     for (t = 0; t < 1; t = span.t1) {
//         state = range_front_begin(t);
//         for every range: state = range_front_compare(state, range);
//         for every range: state = range_front_limit(state, range);
//         span = range_front_span(state);
//     }
//
// Spans are contiguous. One with the id range_nothing has no range and may be left out of a resolved list. The ranges
// of the list overlap in time as they please; their order matters only where three of them meet within rounding.
#ifndef GNOMON_MOTION_RANGE_RANGE_FRONT_H
#define GNOMON_MOTION_RANGE_RANGE_FRONT_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The range in front just after the time `begin`. Up to the time `unchanged` the comparisons that found it have the
/// same results, and up to the time `end` no range passes in front of it.
template <class Real, class = require_real<Real>> struct range_front
{
    depth_time_range<Real> nearest;
    Real begin, unchanged, end;
};

/// r in the canonical form of a list. An empty range if r is empty, leaves [0, 1], has a NaN, or has a depth beyond
/// 2^60.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_canonical(depth_time_range<Real> r)
{
    r.id = gnomon_max(r.id, literal<Real>(range_mixed));
    mask_t<Real> known = gnomon_abs(r.z0) + gnomon_abs(r.z1) < literal<Real>(range_far);
    return range_keep_if(Real(0) <= r.t0 && r.t0 < r.t1 && r.t1 <= Real(1) && known, r);
}

/// Begin the span from time t on, without a range. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr range_front<Real> range_front_begin(Real t)
{
    range_front<Real> state;
    state.begin = saturate_or_zero(t);
    state.nearest = range_empty(literal<Real>(range_nothing));
    state.unchanged = Real(1);
    state.end = Real(1);
    return state;
}

/// Keep the nearer just after the begin: r or the nearest range so far.
/// NaN: a range with a NaN changes nothing.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_front<Real> range_front_compare(range_front<Real> state, depth_time_range<Real> r)
{
    r = range_canonical(r);
    depth_time_range front = state.nearest;
    depth_time_range ahead = range_visible_part(r, front);
    mask_t<Real> during = r.t0 <= state.begin && state.begin < r.t1;
    mask_t<Real> alone = front.t1 <= front.t0;
    mask_t<Real> nearer = ahead.t0 <= state.begin && state.begin < ahead.t1;
    Real change = gnomon_select(state.begin < ahead.t0, ahead.t0, gnomon_select(nearer, ahead.t1, Real(1)));
    change = gnomon_min(change, gnomon_min(front.t1, r.t1));
    state.unchanged = gnomon_select(during && !alone, gnomon_min(state.unchanged, change), state.unchanged);
    state.nearest = range_select(nearer || (during && alone), r, front);
    return state;
}

/// End the span where r passes in front of the nearest range; without a nearest range, where r begins. Call for all
/// ranges after all of them are compared.
/// NaN: a range with a NaN changes nothing.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_front<Real> range_front_limit(range_front<Real> state, depth_time_range<Real> r)
{
    r = range_canonical(r);
    depth_time_range ahead = range_visible_part(r, state.nearest);
    mask_t<Real> some = state.nearest.t0 < state.nearest.t1;
    Real next = gnomon_select(some, ahead.t0, r.t0);
    state.end = gnomon_select(state.begin < next, gnomon_min(state.end, next), state.end);
    // Rounding may put each of three ranges that meet in front of the next. The tie lasts as long as all comparisons
    // do.
    mask_t<Real> circle = ahead.t0 <= state.begin && state.begin < ahead.t1;
    state.end = gnomon_select(circle, gnomon_min(state.end, state.unchanged), state.end);
    return state;
}

/// Span of the lower envelope from the begin on: the range in front, until it ends or another range passes in front. If
/// no range lasts just after the begin, the span has the id range_nothing, the depth of the far plane, and lasts until
/// the next begin. The span ends after its begin unless that is 1. From 0 to 1 there are at most (N + 1) (N + 2) / 2
/// spans of N ranges, since each ends at a begin, an end or a crossing.
/// Source: Palmer 2011, Sec. 2.4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_front_span(range_front<Real> state)
{
    mask_t<Real> some = state.nearest.t0 < state.nearest.t1;
    Real end = gnomon_min(gnomon_select(some, state.nearest.t1, Real(1)), state.end);
    depth_time_range<Real> span = range_clip(state.nearest, state.begin, end);
    span.t0 = state.begin;
    span.t1 = end;
    return span;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/range/range_merge.h ------------------------------------------------------------------------------------------
// A range that replaces two, for full lists of few ranges (the compression of Gribel et al. 2010). It lasts from the
// begin of the earlier range to the end of the later one, and its depth line is in front of both, so that all that was
// shadowed stays shadowed. To find the two most similar ranges, Gribel et al. weight the gap between them and their
// differences in depth, slope and duration. Here a single measure without weights covers all of these: the area of the
// plane of time and depth that becomes shadowed although no range was in front of it. Up to a factor, this is the
// expected error for a receiver of unknown depth. The time for which a surface becomes shadowed by its own range is
// added, since a range of two surfaces has the id of neither.
#ifndef GNOMON_MOTION_RANGE_RANGE_MERGE_H
#define GNOMON_MOTION_RANGE_RANGE_MERGE_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The range that replaces two; gap, the time between the two that it fills; shift, the largest distance by which it is
/// in front of both; and the total cost.
template <class Real, class = require_real<Real>> struct range_pair
{
    depth_time_range<Real> merged;
    Real gap, shift, cost;
};

inline constexpr double range_merge_margin = 0.000003814697265625; // 2^-18, exact

/// The range from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_hull(depth_time_range<Real> a, depth_time_range<Real> b)
{
    depth_time_range<Real> hull;
    hull.t0 = gnomon_min(a.t0, b.t0);
    hull.t1 = gnomon_max(a.t1, b.t1);
    Real nearer0 = gnomon_min(a.z0, b.z0);
    Real nearer1 = gnomon_min(a.z1, b.z1);
    hull.z0 = gnomon_select(a.t0 < b.t0, a.z0, gnomon_select(b.t0 < a.t0, b.z0, nearer0));
    hull.z1 = gnomon_select(b.t1 < a.t1, a.z1, gnomon_select(a.t1 < b.t1, b.z1, nearer1));
    hull.id = gnomon_select(a.id == b.id, a.id, literal<Real>(range_mixed));
    return hull;
}

/// A range in front of both a and b. Of two candidates the one that darkens less: the line between the outer ends,
/// moved towards the light until it is in front of both ranges, or the level line through the nearest end. A margin of
/// 2^-18 of the largest depth is added. It exceeds the rounding of all lines in float, 59 2^-24, so by range_depth the
/// result is at no time behind a or b. The id is that of both, or range_mixed if they differ. If one range is empty,
/// the result is the other one, unchanged.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_merge(depth_time_range<Real> a, depth_time_range<Real> b)
{
    depth_time_range hull = range_hull(a, b);
    Real back = gnomon_max(gnomon_max(range_depth(hull, a.t0) - a.z0, range_depth(hull, a.t1) - a.z1),
                           gnomon_max(range_depth(hull, b.t0) - b.z0, range_depth(hull, b.t1) - b.z1));
    back = gnomon_max(back, Real(0));
    Real size = gnomon_max(gnomon_max(gnomon_abs(a.z0), gnomon_abs(a.z1)),
                           gnomon_max(gnomon_abs(b.z0), gnomon_abs(b.z1)));
    Real margin = size * literal<Real>(range_merge_margin);
    Real level = gnomon_min(gnomon_min(a.z0, b.z0), gnomon_min(a.z1, b.z1));
    Real sloped0 = hull.z0 - back;
    Real sloped1 = hull.z1 - back;
    mask_t<Real> slopes = level + level < sloped0 + sloped1 && gnomon_abs(sloped0) +
                          gnomon_abs(sloped1) < literal<Real>(range_far);
    hull.z0 = gnomon_select(slopes, sloped0, level) - margin;
    hull.z1 = gnomon_select(slopes, sloped1, level) - margin;

    mask_t<Real> some_a = a.t0 < a.t1;
    mask_t<Real> some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, hull, range_select(some_a, a, b));
}

/// Area between the range and the far plane, in time and depth.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real range_area(depth_time_range<Real> r)
{
    return range_duration(r) * (Real(1) - Real(0.5) * (r.z0 + r.z1));
}

/// Largest distance of an end of r behind the range `nearer`, 0 if none is behind or r is empty.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_distance(depth_time_range<Real> r, depth_time_range<Real> nearer)
{
    Real distance0 = r.z0 - range_depth(nearer, r.t0);
    Real distance1 = r.z1 - range_depth(nearer, r.t1);
    return gnomon_select(r.t0 < r.t1, gnomon_max(gnomon_max(distance0, distance1), Real(0)), Real(0));
}

/// The merge of a and b, with its costs. The cost is the area behind the merged range that was behind neither a nor b,
/// plus the time for which a surface loses its id. If one range is empty, there is nothing to merge: the cost is -1,
/// gap and shift are 0.
/// Error: gap and shift are exact except for rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_pair<Real> range_pair_make(depth_time_range<Real> a, depth_time_range<Real> b)
{
    range_pair<Real> p;
    p.merged = range_merge(a, b);
    mask_t<Real> some = a.t0 < a.t1 && b.t0 < b.t1;
    Real gap = gnomon_max(a.t0, b.t0) - gnomon_min(a.t1, b.t1);
    p.gap = gnomon_select(some, gnomon_max(gap, Real(0)), Real(0));
    // Ignore the parts that the other range occludes: they were in shadow already.
    Real shift = gnomon_max(range_distance(range_trim(a, b), p.merged), range_distance(range_trim(b, a), p.merged));
    p.shift = gnomon_select(some, shift, Real(0));

    // The area behind both is that behind the farther range, at (a + b + |a - b|) / 2. The mean of |x| from x0 to x1
    // is:
    depth_time_range near_a = range_clip_to(a, b);
    depth_time_range near_b = range_clip_to(b, a);
    Real x0 = near_a.z0 - near_b.z0;
    Real x1 = near_a.z1 - near_b.z1;
    Real sum = gnomon_abs(x0) + gnomon_abs(x1);
    Real apart = Real(0.5) * ((x0 * x0 + x1 * x1) + (gnomon_abs(x0 * x1) + x0 * x1)) / sum;
    apart = gnomon_select(Real(0) < sum, apart, Real(0));
    Real middle = Real(0.25) * ((near_a.z0 + near_a.z1) + (near_b.z0 + near_b.z1));
    Real both = range_duration(near_a) * (Real(1) - (middle + Real(0.5) * apart));
    Real area = range_area(p.merged) - ((range_area(a) + range_area(b)) - both);
    Real own_a = gnomon_select(a.id == p.merged.id, Real(0), range_duration(a));
    Real own_b = gnomon_select(b.id == p.merged.id, Real(0), range_duration(b));
    p.cost = gnomon_select(some, gnomon_max(area, Real(0)) + (own_a + own_b), Real(-1));
    return p;
}

/// r alone, at a cost above that of any pair: the start of a search for the cheapest pair.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_pair<Real> range_pair_empty(depth_time_range<Real> r)
{
    range_pair<Real> p;
    p.merged = r;
    p.gap = Real(0);
    p.shift = Real(0);
    p.cost = literal<Real>(range_far) * literal<Real>(range_far);
    return p;
}

/// The pair with the lower cost; a if the costs are equal.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_pair<Real> range_pair_cheaper(range_pair<Real> a, range_pair<Real> b)
{
    mask_t<Real> cheaper = b.cost < a.cost;
    range_pair<Real> p;
    p.merged = range_select(cheaper, b.merged, a.merged);
    p.gap = gnomon_select(cheaper, b.gap, a.gap);
    p.shift = gnomon_select(cheaper, b.shift, a.shift);
    p.cost = gnomon_select(cheaper, b.cost, a.cost);
    return p;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/range/range_list.h -------------------------------------------------------------------------------------------
// Lists of a few depth-time ranges, one list for a texel: the surfaces that pass the texel while the shutter is open
// (Gribel et al. 2010; Hong & Oh 2017), and the lower envelope of the list, which is visible from the light at each
// time (the resolve of Palmer 2011, 2.4).
//
//     list = range_list_make(range);                  list = range_list_insert(list, range) for every other range
//     intensity = range_list_intensity(list, t, z, id, bias);    shadow test at one time
//     resolved = range_list_resolve(list);                       lower envelope, for receivers in closed form
//     for (t = 0; t < 1; t = span.t1) span = range_list_front(list, t);    the same, span by span
//
// A list stores inserted ranges unchanged and drops those that another range provably occludes (range_occludes). Until
// the list overflows, neither its contents nor its resolved form depend on the order of insertion or on rounding. On
// overflow it first drops ranges that several others jointly occlude. If there is still no room, it merges the two most
// similar ranges into one in front of both (range_merge.h): shadows stay, and the shadow that merging adds is counted.
//
// Occluded ranges are dropped regardless of their ids. So a receiver gets the answer of all ranges, unless a range of
// its own id lies in front of it by more than its bias: that range does not shadow the receiver, and ranges that it
// occluded are no longer in the list. Hence one id should be a surface none of whose points is ever behind another: a
// triangle, a plane, the lit side of a convex part. With one id for a whole object, its far sides lose the shadows that
// other objects cast on them.
//
// The capacity is GNOMON_RANGE_CAPACITY, if defined before inclusion, else 8. In C++ the capacity is a template
// parameter with this default.
#ifndef GNOMON_MOTION_RANGE_RANGE_LIST_H
#define GNOMON_MOTION_RANGE_RANGE_LIST_H

GNOMON_WARNINGS_OFF namespace gnomon {

#ifndef GNOMON_RANGE_CAPACITY
#define GNOMON_RANGE_CAPACITY 8
#endif

/// Ranges in the order of range_less, with empty ranges between them, and upper bounds of the cost of merging: except
/// for a total time of time_added, wherever the list has a range, some inserted range was there, too, at most
/// depth_added behind it.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>> struct range_list
{
    depth_time_range<Real> ranges[capacity];
    Real time_added, depth_added;
};

/// r moved towards the light, or away from it where side is 1 instead of -1. The distance exceeds the accumulated
/// rounding of up to 18 cuts: 2^-16, since depths at the cuts are rounded, plus the change of depth within a time of
/// 2^-21, since times are rounded. For two ranges together that rounding is 268 2^-p of depth and 4 2^-p of time.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_offset(depth_time_range<Real> r, std::type_identity_t<Real> side)
{
    Real change = gnomon_abs(r.z1 - r.z0);
    Real brief = gnomon_min(change * Real(0.000000476837158203125) / (r.t1 - r.t0), change);
    Real by = side * (Real(0.0000152587890625) + brief);
    r.z0 = r.z0 + by;
    r.z1 = r.z1 + by;
    return r;
}

/// Add the cost of a merge to the list's counts.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_count_merge(range_list<Real, capacity> list,
                                                                          range_pair<Real> p)
{
    list.time_added = saturate_or_zero(list.time_added + p.gap);
    list.depth_added = gnomon_max(list.depth_added + p.shift, Real(0));
    return list;
}

/// Insert r at its place in the order, into a list that has an empty range (see range_list_insert).
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_place(range_list<Real, capacity> list,
                                                                    depth_time_range<Real> r)
{
    for (int i = 0; i + 1 < capacity; ++i) { // the first empty one goes to the end
        depth_time_range s = list.ranges[i];
        depth_time_range next = list.ranges[i + 1];
        mask_t<Real> empty = s.t1 <= s.t0 && r.t0 < r.t1;
        list.ranges[i] = range_select(empty, next, s);
        list.ranges[i + 1] = range_select(empty, s, next);
    }
    for (int k = 0; k + 1 < capacity; ++k) {
        depth_time_range s = list.ranges[k];
        mask_t<Real> here = s.t0 < s.t1 && range_less(r, s);
        list.ranges[k] = range_select(here, r, s);
        r = range_select(here, s, r);
    }
    depth_time_range last = list.ranges[capacity - 1];
    list.ranges[capacity - 1] = range_select(r.t0 < r.t1, r, last);
    return list;
}

/// Replace the ranges at the places first and second by the merge of both, and count its cost, if the list is full. A
/// place of -1 is none.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_replace(range_list<Real, capacity> list,
                                                                      mask_t<Real> full, Real first, Real second,
                                                                      range_pair<Real> merge)
{
    Real place = Real(0);
    for (int i = 0; i < capacity; ++i) {
        mask_t<Real> merged = full && (place == first || place == second);
        list.ranges[i] = range_keep_if(!merged, list.ranges[i]);
        place = place + Real(1);
    }
    merge.merged = range_keep_if(full, merge.merged);
    merge.gap = gnomon_select(full, merge.gap, Real(0));
    merge.shift = gnomon_select(full, merge.shift, Real(0));
    return range_list_place(range_list_count_merge(list, merge), merge.merged);
}

/// Insert r, clipped to times in [0, 1]. Without an overflow the ranges of the list do not depend on the order of
/// insertion, bit for bit, except for the sign of a zero. With an overflow they do, but at no time is the front farther
/// than that of all inserted ranges. That holds strictly, for exact depth lines, however steep and brief the ranges
/// are.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010; Hong & Oh 2017
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_insert(range_list<Real, capacity> list,
                                                                     depth_time_range<Real> r)
{
    r = range_canonical(range_clip(r, Real(0), Real(1)));
    list = range_list_count_merge(list, range_pair_empty(r)); // counts that are NaN become 0
    Real room = Real(0);
    for (int i = 0; i < capacity; ++i) {
        depth_time_range s = range_canonical(list.ranges[i]);
        r = range_keep_if(!range_occludes(s, r), r);
        s = range_keep_if(!range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, Real(1));
    }
    mask_t<Real> full = r.t0 < r.t1 && room < Real(1);
    if (gnomon_any(full)) {
        // Drop ranges that the others jointly occlude, even if the range were a margin nearer and the others a margin
        // farther.
        range_list occluders = list;
        for (int h = 0; h < capacity; ++h) occluders.ranges[h] = range_offset(list.ranges[h], Real(1));
        depth_time_range farther = range_offset(r, Real(1));
        for (int j = 0; j < capacity; ++j) {
            depth_time_range s = range_trim(range_offset(list.ranges[j], Real(-1)), farther);
            for (int k = 0; k < capacity; ++k) s = range_trim(s, occluders.ranges[k]);
            mask_t<Real> seen = !full || s.t0 < s.t1;
            list.ranges[j] = range_keep_if(seen, list.ranges[j]);
            occluders.ranges[j] = range_keep_if(seen, occluders.ranges[j]);
        }
        depth_time_range left = range_offset(r, Real(-1));
        for (int m = 0; m < capacity; ++m) left = range_trim(left, occluders.ranges[m]);
        r = range_keep_if(!full || left.t0 < left.t1, r);

        // Find the most similar pair; r has place -1. If there is room now, one range of the pair is empty.
        range_pair best = range_pair_empty(r);
        Real first = Real(-1);
        Real second = Real(-1);
        Real place = Real(0);
        for (int a = 0; a < capacity; ++a) {
            depth_time_range other = r;
            Real other_place = Real(-1);
            for (int b = 0; b <= a; ++b) {
                range_pair pair = range_pair_make(list.ranges[a], other);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + Real(1);
            }
            place = place + Real(1);
        }
        list = range_list_replace(list, full, first, second, best);
        r = range_keep_if(!(full && second < Real(0)), r);
    }
    return range_list_place(list, r);
}

/// The list of one range; an empty list if the range is empty.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_make(depth_time_range<Real> r)
{
    range_list<Real, capacity> list;
    for (int i = 0; i < capacity; ++i) list.ranges[i] = range_keep_if(r.t0 < r.t0, r);
    list.time_added = Real(0);
    list.depth_added = Real(0);
    return range_list_insert(list, r);
}

/// Span of the lower envelope from time t on, as of range_front_span. A t outside of [0, 1] is clamped.
/// NaN: t is then 0.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> range_list_front(range_list<Real, capacity> list, Real t)
{
    range_front state = range_front_begin(t);
    for (int i = 0; i < capacity; ++i) state = range_front_compare(state, list.ranges[i]);
    for (int k = 0; k < capacity; ++k) state = range_front_limit(state, list.ranges[k]);
    return range_front_span(state);
}

/// Append r, which begins after all ranges of the list, disjoint and in order of time. If there is no room, merge two
/// neighbours.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_append(range_list<Real, capacity> list,
                                                                     depth_time_range<Real> r)
{
    // The last range and r are neighbours, too. Places count from the end; of all pairs one with an empty range is
    // merged first.
    range_pair best = range_pair_empty(r);
    Real at = Real(0);
    Real place = Real(0);
    depth_time_range next = r;
    for (int i = 0; i < capacity; ++i) {
        depth_time_range s = list.ranges[capacity - 1 - i];
        range_pair pair = range_pair_make(s, next);
        at = gnomon_select(pair.cost < best.cost, place, at);
        best = range_pair_cheaper(best, pair);
        next = s;
        place = place + Real(1);
    }
    place = Real(0);
    next = r;
    for (int k = 0; k < capacity; ++k) {
        depth_time_range s = list.ranges[capacity - 1 - k];
        depth_time_range here = range_select(place == at, best.merged, s);
        list.ranges[capacity - 1 - k] = range_select(place < at, next, here);
        next = s;
        place = place + Real(1);
    }
    return range_list_count_merge(list, best);
}

/// The lower envelope of the list: disjoint ranges in order of time, which static_receiver.h adds up. Ranges that do
/// not fit are merged with a neighbour, and counted. Empty ranges come first.
/// Source: Palmer 2011, Sec. 2.4
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> range_list_resolve(range_list<Real, capacity> list)
{
    Real t = Real(0);
    range_list resolved = list;
    for (int i = 0; i < capacity; ++i) resolved.ranges[i] = range_keep_if(t < t, list.ranges[i]);
    for (int k = 0; k < (capacity + 1) * (capacity + 2) / 2; ++k) {
        if (gnomon_any(t < Real(1))) {
            depth_time_range span = range_list_front(list, t);
            mask_t<Real> some = literal<Real>(range_nothing) < span.id;
            resolved = range_list_append(resolved, range_keep_if(some, span));
            t = span.t1;
        }
    }
    return resolved;
}

/// Shadow intensity, 0 or 1, at time t and depth z on the surface with the given id (see range_intensity).
/// NaN: 0, lit.
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr Real range_list_intensity(range_list<Real, capacity> list, Real t, Real z, Real id,
                                                  std::type_identity_t<Real> bias)
{
    Real intensity = Real(0);
    for (int i = 0; i < capacity; ++i) intensity = gnomon_max(intensity,
                                                              range_intensity(list.ranges[i], t, z, id, bias));
    return intensity;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// comparators/interval_list.h -----------------------------------------------------------------------------------------
// Lists of a few intervals as Gribel et al. 2010 compress them: a full list merges the two intervals of the least cost,
// a weighted sum of the gap in time between them, their differences in depth and in slope, and their durations. The
// merged interval is the line from the begin of the earlier one to the end of the later one. It may be behind either of
// them, so that what was shadowed becomes lit; range_list.h merges into a line in front of both, and has no weights.
//
// Costs and merges can be chosen apart, to tell what each of them does: the weight `area` is that of the cost of
// range_merge.h, and `conservative` above 0 takes the line in front of both.
//
//     list = range_list_make(range);   list = interval_list_insert(list, range, weights, 0) for every other range
//     resolved = range_list_resolve(list);
#ifndef GNOMON_COMPARATORS_INTERVAL_LIST_H
#define GNOMON_COMPARATORS_INTERVAL_LIST_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Weights of the area that becomes shadowed (range_pair_make), of the gap in time, of the differences in depth and in
/// slope, and of the durations.
template <class Real, class = require_real<Real>> struct interval_weights { Real area, gap, depth, slope, duration; };

/// The interval from the begin of the earlier of a and b to the end of the later one, on the line between the depths
/// there. Of two begins or ends at one time the nearer counts. The id is that of both, or range_mixed if they differ.
/// If one is empty, the result is the other one, unchanged.
/// Source: Gribel 2010
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_time_range<Real> interval_merge(depth_time_range<Real> a, depth_time_range<Real> b)
{
    mask_t<Real> some_a = a.t0 < a.t1;
    mask_t<Real> some_b = b.t0 < b.t1;
    return range_select(some_a && some_b, range_hull(a, b), range_select(some_a, a, b));
}

/// Cost of merging a and b, at most 2^60; -1 if one is empty. The difference in depth is that between the end of the
/// earlier one and the begin of the later one.
/// NaN: 2^60.
/// Source: Gribel 2010
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real interval_cost(depth_time_range<Real> a, depth_time_range<Real> b,
                                           interval_weights<Real> weights)
{
    range_pair p = range_pair_make(a, b);
    depth_time_range first = range_select(b.t0 < a.t0, b, a);
    depth_time_range second = range_select(b.t0 < a.t0, a, b);
    Real gap = gnomon_max(second.t0 - first.t1, Real(0));
    Real slopes = (first.z1 - first.z0) / (first.t1 - first.t0) - (second.z1 - second.z0) / (second.t1 - second.t0);
    Real steeper = gnomon_min(gnomon_abs(slopes), literal<Real>(range_far));
    Real lasting = range_duration(a) + range_duration(b);
    Real cost = (weights.area * p.cost + weights.gap * gap) +
                (weights.depth * gnomon_abs(second.z0 - first.z1) + weights.slope * steeper) + weights.duration *
                lasting;
    mask_t<Real> some = a.t0 < a.t1 && b.t0 < b.t1;
    return gnomon_select(some, gnomon_max(gnomon_min(cost, literal<Real>(range_far)), Real(0)), Real(-1));
}

/// The merge of a and b, with its costs.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr range_pair<Real> interval_pair_make(depth_time_range<Real> a, depth_time_range<Real> b,
                                                            interval_weights<Real> weights,
                                                            std::type_identity_t<Real> conservative)
{
    range_pair p = range_pair_make(a, b);
    p.merged = range_select(Real(0) < conservative, p.merged, interval_merge(a, b));
    p.cost = interval_cost(a, b, weights);
    return p;
}

/// Insert r, clipped to times in [0, 1]. On overflow the pair of the least cost is merged, and the list counts its cost
/// as range_list_insert does, as if the merge were conservative.
/// Domain: times in [0, 1], depths in [-1, 1], a capacity of at most 16, weights of 0 or more.
/// NaN: a range with a NaN, or with a depth beyond 2^60, is not inserted.
/// Source: Gribel 2010
template <class Real, int capacity = GNOMON_RANGE_CAPACITY, class = require_real<Real>>
GNOMON_INLINE constexpr range_list<Real, capacity> interval_list_insert(range_list<Real, capacity> list,
                                                                        depth_time_range<Real> r,
                                                                        interval_weights<Real> weights,
                                                                        std::type_identity_t<Real> conservative)
{
    r = range_canonical(range_clip(r, Real(0), Real(1)));
    list = range_list_count_merge(list, range_pair_empty(r)); // counts that are NaN become 0
    Real room = Real(0);
    for (int i = 0; i < capacity; ++i) {
        depth_time_range s = range_canonical(list.ranges[i]);
        r = range_keep_if(!range_occludes(s, r), r);
        s = range_keep_if(!range_occludes(r, s), s);
        list.ranges[i] = s;
        room = gnomon_select(s.t0 < s.t1, room, Real(1));
    }
    mask_t<Real> full = r.t0 < r.t1 && room < Real(1);
    if (gnomon_any(full)) {
        range_pair best = range_pair_empty(r);
        Real first = Real(-1);
        Real second = Real(-1);
        Real place = Real(0);
        for (int a = 0; a < capacity; ++a) {
            depth_time_range other = r; // which has place -1
            Real other_place = Real(-1);
            for (int b = 0; b <= a; ++b) {
                range_pair pair = interval_pair_make(list.ranges[a], other, weights, conservative);
                first = gnomon_select(pair.cost < best.cost, place, first);
                second = gnomon_select(pair.cost < best.cost, other_place, second);
                best = range_pair_cheaper(best, pair);
                other = list.ranges[b];
                other_place = other_place + Real(1);
            }
            place = place + Real(1);
        }
        list = range_list_replace(list, full, first, second, best);
        r = range_keep_if(!(full && second < Real(0)), r);
    }
    return range_list_place(list, r);
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
