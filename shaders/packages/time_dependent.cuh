// Gnomon 0.1.0, time_dependent.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_TIME_DEPENDENT_CUH
#define GNOMON_TIME_DEPENDENT_CUH

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
#error "gnomon: time_dependent.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: time_dependent.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: time_dependent.cuh is not of the same version as a package before it"
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

// filters/percentage_closer.h -----------------------------------------------------------------------------------------
// Percentage-closer filtering (Reeves, Salesin & Cook 1987; Peters et al. 2017, 2.2): the shadow intensity is the
// weight of the shadow-map depths in front of the receiver, Z(z < z_f) itself. This filter is exact, cannot be filtered
// beforehand, and is what every other filter here estimates.
//
//     state = percentage_closer_begin(z_f);
//     state = percentage_closer_add(state, z, weight);      for every texel of the filter region, weights summing to 1
//     intensity = percentage_closer_end(state);
#ifndef GNOMON_FILTERS_PERCENTAGE_CLOSER_H
#define GNOMON_FILTERS_PERCENTAGE_CLOSER_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The receiver's depth, and the weight in front of the receiver so far.
template <class Real, class = require_real<Real>> struct percentage_closer { Real receiver, shadowed; };

/// The state before the first texel. Subtract a depth bias from z_f first (filters/depth_bias.h).
/// Domain: any z_f; beyond the far plane as on it, so that a map cleared to the far plane shadows nothing.
/// NaN: lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr percentage_closer<Real> percentage_closer_begin(Real z_f)
{
    percentage_closer<Real> r;
    r.receiver = gnomon_min(Real(1), z_f);
    r.shadowed = Real(0);
    return r;
}

/// The state after one more texel of depth z with its filter weight.
/// Domain: any z.
/// NaN: a texel of depth NaN casts no shadow; a weight of NaN before the receiver makes everything lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr percentage_closer<Real> percentage_closer_add(percentage_closer<Real> state, Real z,
                                                                      std::type_identity_t<Real> weight)
{
    state.shadowed = state.shadowed + gnomon_select(z < state.receiver, weight, Real(0));
    return state;
}

/// Shadow intensity in [0, 1], also where the weights do not sum to 1.
/// NaN: 0, lit.
/// Error: that of the sum of weights.
/// Source: Reeves, Salesin & Cook 1987
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real percentage_closer_end(percentage_closer<Real> state)
{
    return saturate_or_zero(state.shadowed);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/receiver/time_dependent.h ------------------------------------------------------------------------------------
// Time-dependent shadow maps (Akenine-Moller, Munkberg & Hasselgren 2007): the shutter interval is cut into slices, and
// each slice has a shadow map whose texels have one sample each, at a time of their own within the slice. A receiver
// that is seen at time t_r reads the slice of that time, but the sample's time t is another one. In between, the
// surface that the sample shows has moved, and would shadow itself (Andersson et al. 2015, Figure 10).
//
//     sample.travel = time_dependent_travel(d_x, d_y);                         when the map is made
//     state = percentage_closer_begin(z_f - constant_bias);                    filters/percentage_closer.h
//     for the texel of the receiver, or for 2 x 2 texels by bilinear weights, in slice slice_of(t_r, slices):
//         state = percentage_closer_add(state, z, weight), where z is one of
//             sample.z                                                         constant bias alone
//             time_dependent_depth(sample, t_r)                                moved along with its surface in depth
//             time_dependent_biased_depth(sample, t_r, slope, texels)          and biased by the surface's slope
//     intensity = percentage_closer_end(state);
//
// Motion in depth is not enough for a tilted surface: in the time between, the sample moves across the map, too, and at
// its new place the surface has another depth. The third depth adds the most by which these differ.
#ifndef GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H
#define GNOMON_MOTION_RECEIVER_TIME_DEPENDENT_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Depth z and time t of a sample, and the motion of the point that it shows over the whole shutter interval: in depth,
/// d_z, and the length of its path over the map in texels, travel.
template <class Real, class = require_real<Real>> struct time_dependent_sample { Real z, t, d_z, travel; };

/// Length in texels of a motion over the map.
/// NaN: NaN.
/// Error: relative, 3 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real time_dependent_travel(Real d_x, Real d_y) { return gnomon_sqrt(d_x * d_x + d_y * d_y); }

/// Depth of the sample's surface at time t_r, by its own motion in depth: the dynamic bias.
/// NaN: NaN.
/// Error: 2^-p (|z| + 4 |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Eq. 12
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real time_dependent_depth(time_dependent_sample<Real> s, Real t_r)
{
    return s.z + s.d_z * (t_r - s.t);
}

/// Depth of the sample's surface at time t_r, plus the depth bias slope (texels + 1.5 travel |t_r - t|). slope is the
/// change of the receiver's depth per texel, and texels the distance to the farthest place that the look-up may read:
/// sqrt(2) for the nearest texel, 1.5 sqrt(2) for 2 x 2. A plane whose points share one motion never shadows itself;
/// the factor of 1.5 leaves room for paths that perspective bends.
/// Domain: slope at least 0, else 0.
/// NaN: NaN.
/// Error: twice that of time_dependent_depth, and 8 2^-p times the bias.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real time_dependent_biased_depth(time_dependent_sample<Real> s, Real t_r, Real slope,
                                                         std::type_identity_t<Real> texels)
{
    Real passed = gnomon_abs(t_r - s.t);
    Real reach = texels + Real(1.5) * (s.travel * passed);
    return time_dependent_depth(s, t_r) + gnomon_max(Real(0), slope) * reach;
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
