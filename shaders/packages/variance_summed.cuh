// Gnomon 0.1.0, variance_summed.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_VARIANCE_SUMMED_CUH
#define GNOMON_VARIANCE_SUMMED_CUH

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
#error "gnomon: variance_summed.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: variance_summed.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: variance_summed.cuh is not of the same version as a package before it"
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

// soft/blocker.h ------------------------------------------------------------------------------------------------------
// The mean depth of blockers, the surfaces of a search region that are before the receiver, from moments of the region:
// the blocker search of percentage-closer soft shadows in one look-up (Peters et al. 2017, Sec. 4.3; Yang et al. 2010).
//
// The moments name a canonical distribution with a node at the receiver's depth z_f (hamburger4.h). With A, the sum of
// w (z_f - x) over its nodes x before z_f, and their weight w, the lower bound on the shadow intensity, the result is
//     z_f - A / (epsilon + lower),
// Equation 4 of the paper, in which epsilon makes little of blockers of little weight, and returns z_f where none is.
// A needs no node: since the mean of (x - z_f) over all nodes is -u, with u = z_f - mean, and with the notation of
// hamburger4.h,
//     both nodes before z_f:    A = u
//     one:                      A = (u (b + r) - V a) / (2 r)
//     none:                     A = 0
// so the whole takes one division and one square root. Two moments have the one node mean - V / u beside z_f, and A is
// u where that is before z_f. The result is exact for a region of one or two surfaces, and of three with one at z_f.
#ifndef GNOMON_SOFT_BLOCKER_H
#define GNOMON_SOFT_BLOCKER_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double blocker_epsilon = 1e-3;

/// The depth z_f - distance_ in [-1, z_f], for z_f in [-1, 1].
/// NaN: z_f.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real blocker_depth_before(Real z_f, Real distance_)
{
    return gnomon_max(z_f - gnomon_max(distance_, Real(0)), Real(-1));
}

/// Mean blocker depth in [-1, z_f] from the mean and the variance of the depths: the formula of variance soft shadow
/// maps.
/// Domain: z_f in [-1, 1], clamped; variance at least 0.
/// NaN: no blocker, z_f; a z_f of NaN is the far plane.
/// Source: Yang 2010; Peters 2017, Eq. 4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real blocker2_depth(Real mean, Real variance, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    Real u = z - mean;
    Real whole = variance + u * u;
    Real below = u * whole;
    Real total = literal<Real>(blocker_epsilon) * whole + u * u;
    return blocker_depth_before(z, below / total);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// soft/blocker.h ------------------------------------------------------------------------------------------------------
#ifndef GNOMON_SOFT_BLOCKER_4
#define GNOMON_SOFT_BLOCKER_4

GNOMON_WARNINGS_OFF namespace gnomon {

/// Mean blocker depth in [-1, z_f] from four moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 3e-14, p99.9 1e-12
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel4_from_summed: p99 3e-5, p99.9 1e-4, max 1e-2
/// Source: Peters 2017, Eq. 4
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real blocker4_depth(hankel4<Real> h, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    Real u = z - h.mean;
    Real q = hamburger4_q(h, u);
    // The power of two is a factor of every term. The terms of a single depth would underflow otherwise.
    Real s = literal<Real>(hamburger4_lower_scale) * q;
    Real n = literal<Real>(hamburger4_lower_scale) * h.determinant;
    Real un = u * n;
    Real a = s * h.variance;
    Real b = Real(0.5) * (un - s * h.third);
    Real r = gnomon_sqrt(b * b - a * (h.variance * (n - a)));
    Real e = u * un + q * s;
    Real w = h.variance * n;
    Real whole = w + e;
    mask_t<Real> between = q < Real(0);
    Real rest = whole * gnomon_select(between, u * (b + r) - h.variance * a, u);
    Real share = gnomon_select(between, e * (r + b) - w * (u * a), e);
    Real total = literal<Real>(blocker_epsilon) * (whole * gnomon_select(between, r + r, Real(1))) + share;
    return blocker_depth_before(z, rest / total);
}

GNOMON_WARNINGS_ON } // namespace gnomon

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

// soft/summed_area.h --------------------------------------------------------------------------------------------------
// Summed-area tables of the channels of a shadow map, and look-ups of any rectangle in them (Crow 1984; Peters et al.
// 2017, Sec. 4.2 to 4.4).
//
// Let P(x, y) be the sum of the channels over all texels (i, j) with i < x and j < y. The table holds P(x + 1, y + 1)
// at texel (x, y), in 32-bit unsigned integers that wrap around; P is 0 where x or y is 0. The sum over the texels from
// (x0, y0) to before (x1, y1) is a difference of four such integers, of which none that wraps does harm:
//
//     rectangle = summed_area_clip(summed_area_around(x, y, width_x, width_y), map_width, map_height, most_texels);
//
//     on the grid, 4 texels:       r = summed_area_grow(rectangle);
//                                  s = P(r.x1, r.y1) - P(r.x0, r.y1) - P(r.x1, r.y0) + P(r.x0, r.y0);    in integers
//                                  area = (r.x1 - r.x0) * (r.y1 - r.y0);
//
//     interpolated, 16 texels:     a = summed_area_split(rectangle.x0, rectangle.x1), b = the same of y0 and y1
//                                  s = the sum over both axes of width_i width_j times the sum of rectangle (i, j)
//                                  area = summed_area_width(a) * summed_area_width(b);
//
//     channel = s / (area * scale)                                        storage/moments4_summed.h and its siblings
//
// A code is the nearest whole number to scale times a channel in [0, 1]. most_texels is the most texels that a look-up
// on the grid may cover: (ceil(w_x) + 1) (ceil(w_y) + 1) for the largest rectangle. Positions are in texels, with
// centres at +0.5.
#ifndef GNOMON_SOFT_SUMMED_AREA_H
#define GNOMON_SOFT_SUMMED_AREA_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A rectangle of a map, from (x0, y0) to (x1, y1) in texels.
template <class Real, class = require_real<Real>> struct summed_area_rectangle { Real x0, y0, x1, y1; };

inline constexpr double summed_area_range = 4294967296.0;         // 2^32
inline constexpr double summed_area_most_texels = 1048576.0;      // 2^20
inline constexpr double summed_area_step = 5.9604644775390625e-8; // 2^-24
inline constexpr double summed_area_slack = 0.0009765625;         // 2^-10

inline constexpr double summed_area_code_noise = 1.1641532182693481e-10; // 2^-33
inline constexpr double summed_area_float_noise = 5.9604644775390625e-8; // 2 times 2^-25
inline constexpr double summed_area_least_noise = 1.3411045074462891e-7; // 4.5 times 2^-25, in small tables

/// The largest error of a channel of a rectangle, for a table by summed_area_scale(most_texels): half a code,
/// most_texels 2^-33, and what float arithmetic rounds on the way from the depth to the mean: in the channel, the
/// resolve of four samples, nine sums with their widths, and the mean. These do not all come together: a search by
/// climbing found what keeps surfaces lit (tests/soft/honest_summed.cpp).
/// Domain: most_texels at least 0.
/// NaN: the noise of a small table.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real summed_area_noise(Real most_texels)
{
    Real noise = literal<Real>(summed_area_code_noise) * most_texels + literal<Real>(summed_area_float_noise);
    return gnomon_max(noise, literal<Real>(summed_area_least_noise));
}

/// The number that channels are multiplied by: the largest whole number S of the precision of Real for which sums over
/// most_texels texels do not wrap around, most_texels S <= 2^32 - 1. S is whole because the codes are: the nearest
/// whole number to a fraction may be above it, as in the paper's own example of 784 texels.
/// Domain: most_texels a whole number in [1, 2^20], clamped.
/// NaN: as 2^20.
/// Source: Peters 2017, Sec. 4.2
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real summed_area_scale(Real most_texels)
{
    Real n = clamp_or_high(most_texels, Real(1), literal<Real>(summed_area_most_texels));
    Real range = literal<Real>(summed_area_range);
    Real s = range / n;
    Real whole = nearest_natural(s);
    whole = whole - gnomon_select(s < whole, Real(1), Real(0));
    double_word sum = two_product(whole, n);
    mask_t<Real> wraps = Real(0) <= (sum.high - range) + sum.low;
    return whole - gnomon_select(wraps, gnomon_max(Real(1), literal<Real>(summed_area_step) * whole), Real(0));
}

/// The code of a channel: the whole number nearest to scale times the channel, which conversion to an unsigned integer
/// leaves as it is.
/// Domain: any channel, clamped to [0, 1]; scale by summed_area_scale.
/// NaN: 0.
/// Error: half a code for scales up to 2^24, beyond which codes are floats.
/// Source: Peters 2017, Sec. 4.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real summed_area_code(Real channel, std::type_identity_t<Real> scale)
{
    double_word p = two_product(saturate_or_zero(channel), scale);
    Real code = nearest_natural(p.high);
    Real rest = (p.high - code) + p.low; // more than half a code where p.high was rounded
    code = code + gnomon_select(Real(0.5) < rest, Real(1), Real(0));
    return code - gnomon_select(rest < Real(-0.5), Real(1), Real(0));
}

/// The rectangle of the given widths about (x, y).
/// NaN: NaN, which summed_area_clip makes empty.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_rectangle<Real> summed_area_around(Real x, Real y, Real width_x, Real width_y)
{
    summed_area_rectangle<Real> r;
    r.x0 = x - Real(0.5) * width_x;
    r.y0 = y - Real(0.5) * width_y;
    r.x1 = x + Real(0.5) * width_x;
    r.y1 = y + Real(0.5) * width_y;
    return r;
}

/// The smallest whole number not below x.
/// Domain: |x| <= 65536, clamped.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real summed_area_above(Real x) { return Real(-1) * texel_below(Real(-1) * x); }

/// The begin and the end of a rectangle along one axis.
template <class Real, class = require_real<Real>> struct summed_area_interval { Real begin, end; };

/// The interval from begin to end.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_interval<Real> summed_area_interval_from(Real begin, Real end)
{
    summed_area_interval<Real> r;
    r.begin = begin;
    r.end = end;
    return r;
}

/// The interval from begin to end if texels <= most, else the one about the same centre that covers no more than most
/// texels wherever it is.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_interval<Real> summed_area_shrink(Real begin, Real end, Real texels, Real most)
{
    Real width = most - Real(1);
    Real low = Real(0.5) * (begin + end) - Real(0.5) * width;
    mask_t<Real> large = most < texels;
    summed_area_interval<Real> r;
    r.begin = gnomon_select(large, low, begin);
    r.end = gnomon_select(large, low + width, end);
    return r;
}

/// The part of a rectangle that a look-up may read: clipped to the map, and if the texels that it touches are more than
/// most_texels, shrunk along both axes about its centre. A rectangle without a part in the map, or with its ends in the
/// wrong order, becomes the empty one, all 0, and look-ups in it are lit.
/// Domain: width and height whole numbers in [1, 65536]; most_texels in [4, 2^20], clamped.
/// NaN: empty.
/// Error: the ends are exact unless the rectangle shrinks.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_rectangle<Real> summed_area_clip(summed_area_rectangle<Real> rectangle,
                                                                     std::type_identity_t<Real> width,
                                                                     std::type_identity_t<Real> height,
                                                                     std::type_identity_t<Real> most_texels)
{
    Real limit = literal<Real>(texel_limit);
    Real right = clamp_or_high(width, Real(1), limit);
    Real bottom = clamp_or_high(height, Real(1), limit);
    Real x0 = clamp_or_nan(rectangle.x0, Real(0), right);
    Real y0 = clamp_or_nan(rectangle.y0, Real(0), bottom);
    Real x1 = clamp_or_nan(rectangle.x1, Real(0), right);
    Real y1 = clamp_or_nan(rectangle.y1, Real(0), bottom);
    Real columns = summed_area_above(x1) - texel_below(x0);
    Real rows = summed_area_above(y1) - texel_below(y0);
    Real most = clamp_or_high(most_texels, Real(4), literal<Real>(summed_area_most_texels));
    mask_t<Real> large = most < columns * rows;
    summed_area_interval x = summed_area_interval_from(x0, x1);
    summed_area_interval y = summed_area_interval_from(y0, y1);
    if (gnomon_any(large)) {
        Real share = gnomon_sqrt(gnomon_min(most / (columns * rows), Real(1)));
        Real least_columns = gnomon_min(columns, Real(2));
        Real least_rows = gnomon_min(rows, Real(2));
        Real most_columns = gnomon_min(gnomon_max(texel_below(share * columns + literal<Real>(summed_area_slack)),
                                                  least_columns), texel_below(most / least_rows));
        Real most_rows = gnomon_min(texel_below(most / most_columns), rows);
        x = summed_area_shrink(x0, x1, columns, most_columns);
        y = summed_area_shrink(y0, y1, rows, most_rows);
    }
    mask_t<Real> some = x0 < x1 && y0 < y1; // false for NaN
    summed_area_rectangle<Real> r;
    r.x0 = gnomon_select(some, x.begin, Real(0));
    r.y0 = gnomon_select(some, y.begin, Real(0));
    r.x1 = gnomon_select(some, x.end, Real(0));
    r.y1 = gnomon_select(some, y.end, Real(0));
    return r;
}

/// The smallest rectangle of whole texels that holds the given one: between these lines of the grid a look-up reads
/// four texels. Empty for the empty rectangle.
/// Domain: a rectangle by summed_area_clip.
/// NaN: positions of NaN become 65536 or -65536.
/// Source: Peters 2017, Sec. 4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_rectangle<Real> summed_area_grow(summed_area_rectangle<Real> rectangle)
{
    summed_area_rectangle<Real> r;
    r.x0 = texel_below(rectangle.x0);
    r.y0 = texel_below(rectangle.y0);
    r.x1 = summed_area_above(rectangle.x1);
    r.y1 = summed_area_above(rectangle.y1);
    return r;
}

/// An interval in three parts: in its first texel, in its last one, and the whole texels between. Part i is between
/// lines i and i + 1 of the grid, and the interval covers each of its texels by width i, in [0, 1].
template <class Real, class = require_real<Real>>
struct summed_area_parts { Real line0, line1, line2, line3, width0, width1, width2; };

/// The parts of the interval from begin to end. In a single texel, the first part is the whole interval and the others
/// have no texels and no width.
/// Domain: 0 <= begin < end <= 65536, and the empty interval from 0 to 0, for which line3 is 1 and all widths are 0.
/// NaN: lines are whole numbers in [-65537, 65537].
/// Error: of a width, one rounding.
/// Source: Peters 2017, Sec. 4.4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr summed_area_parts<Real> summed_area_split(Real begin, Real end)
{
    Real first = texel_below(begin);
    Real last = gnomon_max(summed_area_above(end) - Real(1), first);
    mask_t<Real> single = last <= first;
    summed_area_parts<Real> r;
    r.line0 = first;
    r.line1 = first + Real(1);
    r.line2 = gnomon_max(last, r.line1);
    r.line3 = last + Real(1);
    r.width0 = saturate_or_zero(gnomon_select(single, end, r.line1) - begin);
    r.width1 = gnomon_select(single, Real(0), Real(1));
    r.width2 = gnomon_select(single, Real(0), saturate_or_zero(end - last));
    return r;
}

/// The width of an interval, in texels: the sum of the widths of its parts.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real summed_area_width(summed_area_parts<Real> parts)
{
    return (parts.width0 + parts.width1 * (parts.line2 - parts.line1)) + parts.width2;
}

/// The mean of a channel over a rectangle: sum / (area scale), in [0, 1].
/// Domain: a sum of codes, weighted by widths, over a rectangle of that area; scale by summed_area_scale. 0 for an area
/// of 0 without a sum.
/// NaN: 0.
/// Error: relative, 2^-p, for the sum as it is given.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real summed_area_mean(Real sum, Real area, std::type_identity_t<Real> scale)
{
    double_word whole = two_product(area, scale);
    Real mean = saturate_or_zero(sum / whole.high);
    double_word p = two_product(mean, whole.high);
    Real rest = (sum - p.high) - (p.low + mean * whole.low);
    return saturate_or_zero(mean + rest / whole.high);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// storage/variance_summed.h -------------------------------------------------------------------------------------------
// The mean and the mean square of depths in a summed-area table (soft/summed_area.h; Lauritzen 2007), in 8 bytes a
// texel: what variance soft shadow mapping reads (Yang et al. 2010).
//
//   a texel:        c = variance_summed_encode(z)               (1 + z) / 2 and z^2; a resolve averages them
//                   codes = variance_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = variance_summed_channels(sums, area, scale)
//                   z_b = variance_summed_blocker(c, most_texels, z_f)
//                   shadow = variance_summed_intensity(c, most_texels, z_f - bias)
//
// With channels that are off by noise, the mean is off by 2 noise and the variance by (1 + 4 |mean|) noise at most.
// Cantelli's bound from the largest variance and the least distance never darkens.
#ifndef GNOMON_STORAGE_VARIANCE_SUMMED_H
#define GNOMON_STORAGE_VARIANCE_SUMMED_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double variance_summed_darkening = 1e-6;

/// The two channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels2<Real> variance_summed_encode(Real z)
{
    Real x = clamp_or_high(z, Real(-1), Real(1));
    channels2<Real> c;
    c.c1 = Real(0.5) * x + Real(0.5);
    c.c2 = x * x;
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels2<Real> variance_summed_codes(channels2<Real> c, std::type_identity_t<Real> scale)
{
    Real any = clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1));
    mask_t<Real> known = any == any;
    channels2<Real> r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, Real(1)), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, Real(1)), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels2<Real> variance_summed_channels(channels2<Real> sums, Real area,
                                                                 std::type_identity_t<Real> scale)
{
    mask_t<Real> some = Real(0) < area;
    channels2<Real> r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), Real(1));
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), Real(1));
    return r;
}

/// The mean and the largest variance that channels may have which are off by noise.
template <class Real, class = require_real<Real>> struct variance_summed_moments { Real mean, variance; };

template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr variance_summed_moments<Real> variance_summed_decode(channels2<Real> c, Real noise)
{
    variance_summed_moments<Real> r;
    r.mean = (c.c1 - Real(0.5)) * Real(2);
    Real doubt = (Real(1) + Real(4) * gnomon_abs(r.mean)) * noise;
    r.variance = gnomon_max(subtract_product_rounded(c.c2, r.mean, r.mean), Real(0)) + doubt;
    return r;
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
/// Source: Donnelly & Lauritzen 2006
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real variance_summed_intensity(channels2<Real> c, std::type_identity_t<Real> most_texels,
                                                       Real z_f)
{
    Real noise = summed_area_noise(most_texels);
    variance_summed_moments b = variance_summed_decode(c, noise);
    Real distance_ = (clamp_or_nan(z_f, Real(-1), Real(1)) - b.mean) - Real(2) * noise;
    Real d = gnomon_max(Real(0), distance_);
    // 1, or 0 for NaN, without a comparison, which Metal's fast mathematics would lose.
    Real known = saturate_or_zero(c.c2 + Real(1));
    return known * saturate_or_zero(d * d / (b.variance + d * d));
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
/// Error: against the kernel in double, for a table of 784 texels,
///     error, float, variance_summed_blocker: p99 1e-6, p99.9 2e-4, max 2e-3
/// Source: Yang 2010
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real variance_summed_blocker(channels2<Real> c, std::type_identity_t<Real> most_texels,
                                                     Real z_f)
{
    variance_summed_moments b = variance_summed_decode(c, summed_area_noise(most_texels));
    Real depth = blocker2_depth(b.mean, b.variance, z_f);
    return gnomon_select(c.c2 == c.c2, depth, clamp_or_high(z_f, Real(-1), Real(1)));
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
