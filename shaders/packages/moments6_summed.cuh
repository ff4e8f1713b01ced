// Gnomon 0.1.0, moments6_summed.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_MOMENTS6_SUMMED_CUH
#define GNOMON_MOMENTS6_SUMMED_CUH

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
#error "gnomon: moments6_summed.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: moments6_summed.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: moments6_summed.cuh is not of the same version as a package before it"
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

// numerics/cubic.h ----------------------------------------------------------------------------------------------------
// The largest root of a cubic t^3 + b t^2 + c t + d whose three roots are real.
//
// Viete's trigonometric solution gives the start: the largest root is the mean of the roots plus a multiple of
// cos(1/3 arccos x). With q = cos(1/2 arccos x) = sqrt((1 + x) / 2) that cosine is cos(2/3 arccos q), here a polynomial
// in q, so a square root replaces the trigonometry. Halley's iteration on the cubic then removes the error of the
// start: one step in float; in double two steps, after a quadratic has corrected roots near 0.
#ifndef GNOMON_NUMERICS_CUBIC_H
#define GNOMON_NUMERICS_CUBIC_H

GNOMON_WARNINGS_OFF namespace gnomon {

// cos(2/3 arccos q) for q in [0, 1], interpolated at Chebyshev nodes: absolute error 1e-5.
inline constexpr double cubic_cosine0 = 0.50000938;
inline constexpr double cubic_cosine1 = 0.57684887;
inline constexpr double cubic_cosine2 = -0.10666892;
inline constexpr double cubic_cosine3 = 0.03862587;
inline constexpr double cubic_cosine4 = -0.00882245;
inline constexpr double cubic_minus_third = -0.33333333333333331;

/// The result of a Halley step as a fraction, whose denominator is positive.
template <class Real, class = require_real<Real>> struct cubic_step { Real numerator, denominator; };

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d, before division; t at a multiple root.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr cubic_step<Real> cubic_halley_step(Real b, Real c, Real d, Real t)
{
    Real tb = t + b;
    Real f = tb * (t * t) + (c * t + d);
    Real s = (tb + (tb + t)) * t + c;
    Real r = (t + t) + tb;
    Real whole = s * s - f * r; // positive except at a multiple root
    mask_t<Real> simple = whole > Real(0);
    cubic_step<Real> x;
    x.numerator = gnomon_select(simple, t * whole - f * s, t);
    x.denominator = gnomon_select(simple, whole, Real(1));
    return x;
}

/// The result of a step of Halley's iteration from t on t^3 + b t^2 + c t + d.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real cubic_halley(Real b, Real c, Real d, Real t)
{
    cubic_step x = cubic_halley_step(b, c, d, t);
    return x.numerator / x.denominator;
}

/// The largest root of t^3 + b t^2 + c t + d, in closed form.
/// Error: 1e-5 of the distance to the other two roots.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real cubic_start(Real b, Real c, Real d)
{
    Real mean = literal<Real>(cubic_minus_third) * b;
    Real mean2 = mean * mean;
    Real spread2 = gnomon_max(mean2 + literal<Real>(cubic_minus_third) * c, Real(0));
    Real spread = gnomon_sqrt(spread2);
    Real g = mean * ((mean2 + mean2) - c) - d; // the cubic's value at the mean, negated
    Real inverse = Real(1) / spread2;
    Real cosine = (g * inverse) * (spread * inverse);
    Real q2 = gnomon_min(gnomon_max(Real(0.5) + Real(0.25) * cosine, Real(0)), Real(1));
    Real q = gnomon_sqrt(q2);
    Real start = (literal<Real>(cubic_cosine0) + q * literal<Real>(cubic_cosine1)) + q2 *
                 ((literal<Real>(cubic_cosine2) + q * literal<Real>(cubic_cosine3)) + q2 *
                  literal<Real>(cubic_cosine4));
    return mean + (spread + spread) * start;
}

/// The positive root of t^3 + b t^2 + c t + d as a fraction.
/// Domain: as for cubic_largest_root.
/// Error: as for cubic_largest_root.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr cubic_step<Real> cubic_positive_root(Real b, Real c, Real d)
{
    Real t = cubic_start(b, c, d);
    if (std::numeric_limits<lane_t<Real>>::digits > 24) {
        // The start is off by 1e-5 of the distance to the farthest root, which may be 10^9 times the wanted root. The
        // quadratic a t^2 + c t + d, with a = b + t taken as constant, has the same root. a is minus the sum of the
        // other two roots, so its relative error is 1e-5.
        Real a = b + t;
        Real r = gnomon_sqrt(gnomon_max(c * c - Real(4) * (a * d), Real(0)));
        mask_t<Real> rises = c > Real(0);
        Real near_zero = gnomon_select(rises, Real(-2) * d, r - c) / gnomon_select(rises, c + r, a + a);
        t = gnomon_select(a > t, near_zero, t);
        t = cubic_halley(b, c, d, t);
    }
    return cubic_halley_step(b, c, d, t);
}

/// The positive root t of f(t) = t^3 + b t^2 + c t + d.
/// Domain: three real roots, the other two negative and at most 2^9 times as far from 0 as t in float, 2^40 in double.
/// Beyond that ratio one step does not suffice in float.
/// Error: 8 u (t^3 + |b| t^2 + |c| t + |d|) / |f'(t)|, as if the value of f had 8 roundings of u = 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real cubic_largest_root(Real b, Real c, Real d)
{
    cubic_step x = cubic_positive_root(b, c, d);
    return x.numerator / x.denominator;
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

// moments/moments.h, six moments --------------------------------------------------------------------------------------
// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
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

// moments/hankel6.h ---------------------------------------------------------------------------------------------------
// The Hankel matrix of six moments, factored: the part of the work that all receivers of one filter region share
// (Peters et al. 2017, Alg. 1, steps 1 and 2 without the right-hand side, for m = 6; Sec. 5.4).
//
// A step of elimination leaves the covariances c_ij = b_(i+j) - b_i b_j of (z, z^2, z^3). The next, without divisions
// (Bareiss 1968), leaves s_22 = c_11 c_22 - c_12^2, s_23 and s_33, and the last t = s_22 s_33 - s_23^2. The
// factorization L D L^T has the pivots D_1 = c_11, D_2 = s_22 / c_11 and D_3 = t / (c_11 s_22), and l21 = c_12 / c_11
// and l32 = s_23 / s_22 below the diagonal. With u = z - b1, the monic orthogonal polynomials of the distribution, for
// which D_k = E[P_k^2], follow a three-term recurrence (Gautschi 2004, Sec. 1.3):
//     P_1 = u,    P_2 = (u - (l21 - 2 b1)) P_1 - D_1,    P_3 = (u - (l32 - l21 - b1)) P_2 - (D_2 / D_1) P_1
// Every difference of moments cancels, so all are computed from exact products. A bias (bias.h) is added to the
// covariances, as double words that are kept until a pivot is complete, because added to the moments it would
// be rounded away.
//
// hamburger6.h needs D_3 K(z, z) = D_3 + (D_3 / D_1) P_1^2 + (D_3 / D_2) P_2^2 + P_3^2, whose weights are stored. The
// only quotients are 1 / D_1 and 1 / s_22, and neither waits for t.
#ifndef GNOMON_MOMENTS_HANKEL6_H
#define GNOMON_MOMENTS_HANKEL6_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The factored matrix. The recurrence has mean b1, variance D_1, the shifts of u in P_2 and P_3, and ratio D_2 / D_1.
/// The weights of 1, P_1^2 and P_2^2 in D_3 K(z, z) are whole = D_3, first = D_3 / D_1 and second = D_3 / D_2. Pivots
/// are positive for any moments.
/// NaN: a NaN among the moments stays NaN.
template <class Real, class = require_real<Real>>
struct hankel6 { Real mean, variance, shift2, shift3, ratio, whole, first, second; };

/// The factored matrix from the mean, c_11, c_12, s_22, s_23 and t. Pivots below the floor are raised to the floor, so
/// that indefinite moments still name a distribution.
/// NaN: stays NaN, as the second argument of gnomon_max (portable.h).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_make(Real mean, Real c11, Real c12, Real s22, Real s23, Real t)
{
    hankel6<Real> h;
    h.mean = mean;
    h.variance = gnomon_max(literal<Real>(pivot_floor<lane_t<Real>>), c11);
    Real inverse1 = Real(1) / h.variance;
    Real s = gnomon_max(literal<Real>(pivot_floor<lane_t<Real>>) * h.variance, s22);
    Real inverse_s = Real(1) / s;
    Real l21 = c12 * inverse1;
    h.shift2 = l21 - (mean + mean);
    h.shift3 = (s23 * inverse_s - l21) - mean;
    h.ratio = (s * inverse1) * inverse1;
    h.whole = gnomon_max(literal<Real>(pivot_floor<lane_t<Real>>), (t * inverse_s) * inverse1);
    h.first = h.whole * inverse1;
    h.second = h.whole * (h.variance * inverse_s);
    return h;
}

/// The covariances of (z, z^2, z^3).
template <class Real, class = require_real<Real>>
struct covariances6 { double_word<Real> c11, c12, c13, c22, c23, c33; };

/// The covariances without loss by cancellation. Hoelder's inequality orders the terms of those with an even i + j.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr covariances6<Real> covariances6_from_moments(moments6<Real> b)
{
    covariances6<Real> c;
    c.c11 = subtract_product_ordered(b.b2, b.b1, b.b1);
    c.c12 = subtract_product(b.b3, b.b1, b.b2);
    c.c13 = subtract_product_ordered(b.b4, b.b1, b.b3);
    c.c22 = subtract_product_ordered(b.b4, b.b2, b.b2);
    c.c23 = subtract_product(b.b5, b.b2, b.b3);
    c.c33 = subtract_product_ordered(b.b6, b.b3, b.b3);
    return c;
}

/// a b - c d as a double word, for factors whose low words may be as large as the high ones.
/// Domain: a b >= |c d| for the high words.
/// Error: in float 2^-45 of both products of the high words, and 2^-21 of the contributions of the low words.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr double_word<Real> hankel6_minor(double_word<Real> a, double_word<Real> b, double_word<Real> c,
                                                        double_word<Real> d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference_ordered(p.high, q.high);
    Real up = a.high * b.low + a.low * (b.high + b.low);
    Real down = c.high * d.low + c.low * (d.high + d.low);
    r.low = r.low + ((p.low - q.low) + (up - down));
    return r;
}

/// The factored matrix from the mean and the covariances, by elimination.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_factor(Real mean, covariances6<Real> c)
{
    double_word s22 = hankel6_minor(c.c11, c.c22, c.c12, c.c12);
    double_word s23 = double_word_minor(c.c11, c.c23, c.c12, c.c13);
    double_word s33 = hankel6_minor(c.c11, c.c33, c.c13, c.c13);
    return hankel6_make(mean, c.c11.high + c.c11.low, c.c12.high + c.c12.low, s22.high + s22.low, s23.high + s23.low,
                        double_word_determinant(s22, s23, s33));
}

/// The factored matrix of the mixture (1 - alpha) Z + alpha Z*, where Z has the moments b and Z* is symmetric with even
/// moments bias2, bias4 and bias6. The covariances of the mixture, divided by 1 - alpha, are the sum of those of Z,
/// alpha / (1 - alpha) times those of Z*, and alpha times the products of the differences of the means.
/// Domain: alpha in [0, 1), and at least n delta / (n delta + r) for moments that are off by n roundings (bias.h). With
/// a smaller alpha pivots may be at the floor, and bounds are not reliable.
/// NaN: stays NaN.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_constant_bias(moments6<Real> b, std::type_identity_t<Real> bias2,
                                                            std::type_identity_t<Real> bias4,
                                                            std::type_identity_t<Real> bias6,
                                                            std::type_identity_t<Real> alpha)
{
    Real keep = Real(1) - alpha;
    Real odds = alpha / keep;
    Real d2 = b.b2 - bias2;
    Real e1 = alpha * b.b1;
    Real e2 = alpha * d2;
    Real e3 = alpha * b.b3;
    covariances6 c = covariances6_from_moments(b);
    c.c11.low = c.c11.low + (e1 * b.b1 + odds * bias2);
    c.c12.low = c.c12.low + e1 * d2;
    c.c13.low = c.c13.low + (e1 * b.b3 + odds * bias4);
    c.c22.low = c.c22.low + (e2 * d2 + odds * (bias4 - bias2 * bias2));
    c.c23.low = c.c23.low + e2 * b.b3;
    c.c33.low = c.c33.low + (e3 * b.b3 + odds * bias6);
    hankel6 h = hankel6_factor(b.b1 - e1, c);
    h.variance = keep * h.variance;
    h.whole = keep * h.whole;
    return h;
}

/// The factored matrix of moments b, in plain arithmetic: for double, and for biased moments from 10-bit and 16-bit
/// storage, whose own errors are larger than those of the arithmetic.
/// NaN: stays NaN.
/// Source: Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_moments(moments6<Real> b)
{
    Real c11 = b.b2 - b.b1 * b.b1;
    Real c12 = b.b3 - b.b1 * b.b2;
    Real c13 = b.b4 - b.b1 * b.b3;
    Real s22 = c11 * (b.b4 - b.b2 * b.b2) - c12 * c12;
    Real s23 = c11 * (b.b5 - b.b2 * b.b3) - c12 * c13;
    Real s33 = c11 * (b.b6 - b.b3 * b.b3) - c13 * c13;
    return hankel6_make(b.b1, c11, c12, s22, s23, s22 * s33 - s23 * s23);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/hamburger6.h ------------------------------------------------------------------------------------------------
// Shadow intensity from six moments, by the method of hamburger4.h (Peters et al. 2017, Sec. 5.4 and Alg. 1). Surface
// shadows need four moments only. Six serve where many surfaces lie behind one another, as in single scattering.
//
// With K(x, y) = sum_k P_k(x) P_k(y) / D_k and w(z) = 1 / K(z, z), the number a of nodes above z_f is the number of
// sign changes in P_0(z_f), ..., P_3(z_f):
//     a = 0:  lower = 1 - w_f                        a = 2:  lower = w(smallest root)
//     a = 1:  lower = 1 - w_f - w(largest root)      a = 3:  lower = 0
// At most one root is needed, and that root is alone on its side of z_f. In t = 1 / (z - z_f) it is the only one of its
// sign among the roots of
//     k0 t^3 + k1 t^2 + k2 t + k3,      k0 = K(z_f, z_f) >= 1,      k_j = (d/dz)^j K(z_f, z) / j! at z_f.
// After a change of sign it is the largest of three real roots, which cubic.h finds.
#ifndef GNOMON_MOMENTS_HAMBURGER6_H
#define GNOMON_MOMENTS_HAMBURGER6_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// The canonical distribution: depth0 at the receiver and depth1 <= depth2 <= depth3. The weights are in [0, 1] and
/// sum to 1.
template <class Real, class = require_real<Real>>
struct distribution4 { Real depth0, depth1, depth2, depth3, weight0, weight1, weight2, weight3; };

/// The orthogonal polynomials P_1, P_2 and P_3 at one depth.
template <class Real, class = require_real<Real>> struct polynomials6 { Real p1, p2, p3; };

/// P_1, P_2 and P_3 at the depth mean + u.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr polynomials6<Real> hamburger6_polynomials(hankel6<Real> h, Real u)
{
    polynomials6<Real> p;
    p.p1 = u;
    p.p2 = (u - h.shift2) * u - h.variance;
    p.p3 = (u - h.shift3) * p.p2 - h.ratio * u;
    return p;
}

/// D_3 K(z, z), at least D_3, from the polynomials at z. A node at z has the weight h.whole divided by the result.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger6_kernel(hankel6<Real> h, polynomials6<Real> p)
{
    return (h.whole + h.first * (p.p1 * p.p1)) + (h.second * (p.p2 * p.p2) + p.p3 * p.p3);
}

/// The derivatives P_2', P_3' and P_3'' / 2 at one depth.
template <class Real, class = require_real<Real>> struct derivatives6 { Real slope2, slope3, bend3; };

/// The derivatives at the depth of p, from the recurrence: P_2' = 2 u - shift2, P_3' = P_2 + v P_2' - ratio and
/// P_3'' / 2 = P_2' + v with v = u - shift3.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr derivatives6<Real> hamburger6_derivatives(hankel6<Real> h, polynomials6<Real> p)
{
    Real v = p.p1 - h.shift3;
    derivatives6<Real> d;
    d.slope2 = (p.p1 + p.p1) - h.shift2;
    d.slope3 = (p.p2 + v * d.slope2) - h.ratio;
    d.bend3 = d.slope2 + v;
    return d;
}

/// P_1, P_2 and P_3 at a depth that is farther by distance_, from p and its derivatives d by Taylor's formula, which is
/// exact for polynomials. The distance of a node close to z_f would be rounded away in its depth. In float that decides
/// whether a lit surface is darkened.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr polynomials6<Real> hamburger6_polynomials_shift(polynomials6<Real> p, derivatives6<Real> d,
                                                                        Real distance_)
{
    p.p1 = p.p1 + distance_;
    p.p2 = p.p2 + distance_ * (d.slope2 + distance_);
    p.p3 = p.p3 + distance_ * (d.slope3 + distance_ * (d.bend3 + distance_));
    return p;
}

/// The cubic t^3 + b t^2 + c t + d.
template <class Real, class = require_real<Real>> struct hamburger6_cubic { Real b, c, d; };

/// The cubic whose roots are side / (z - z_f) for the other nodes z, from polynomials p and derivatives d at z_f, with
/// inverse = 1 / (D_3 K(z_f, z_f)) and side = 1 or -1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger6_cubic<Real> hamburger6_other_nodes(hankel6<Real> h, polynomials6<Real> p,
                                                                      derivatives6<Real> d, Real inverse, Real side)
{
    Real q2 = h.second * p.p2;
    hamburger6_cubic<Real> r;
    r.b = inverse * (side * (h.first * p.p1 + (d.slope2 * q2 + d.slope3 * p.p3)));
    r.c = inverse * (q2 + d.bend3 * p.p3);
    r.d = inverse * (side * p.p3);
    return r;
}

/// The distance 1 / t of a node from z_f, clamped to 1024, where a node that would be at infinity has no weight.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real hamburger6_distance(Real t)
{
    Real least = Real(0.0009765625);
    Real away = gnomon_select(t < Real(0), gnomon_min(t, -least), gnomon_max(t, least));
    return Real(1) / away;
}

/// Sums over the nodes x before the receiver: of their weights, and of their weights times z_f - x; and the receiver's
/// weight.
template <class Real, class = require_real<Real>> struct hamburger6_sums { Real lower, distance, weight; };

/// The sums for u = z_f - mean, not clamped. The mean of x - z_f over all nodes is -u, so the lone node tells the sums
/// of the nodes on either side.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger6_sums<Real> hamburger6_sums_at(hankel6<Real> h, Real u)
{
    polynomials6 p = hamburger6_polynomials(h, u);
    Real inverse = Real(1) / hamburger6_kernel(h, p);
    mask_t<Real> positive1 = p.p1 > Real(0);
    mask_t<Real> positive2 = p.p2 > Real(0);
    mask_t<Real> positive3 = p.p3 > Real(0);
    mask_t<Real> all_below = positive1 && positive2 && positive3;
    mask_t<Real> all_above = (!positive1) && positive2 && (!positive3);
    mask_t<Real> outside = all_below || all_above;
    hamburger6_sums<Real> r;
    r.weight = h.whole * inverse;
    r.lower = gnomon_select(all_below, Real(1) - r.weight, Real(0));
    r.distance = gnomon_select(all_below, p.p1, Real(0));
    if (gnomon_any(!outside)) {
        // P_3 > 0: two nodes above z_f and the lone one below. Else the lone one is above.
        Real side = gnomon_select(positive3, Real(-1), Real(1));
        derivatives6 d = hamburger6_derivatives(h, p);
        hamburger6_cubic n = hamburger6_other_nodes(h, p, d, inverse, side);
        cubic_step t = cubic_positive_root(n.b, n.c, n.d);
        // Clamped to 1024, where a node that would be at infinity has no weight.
        Real away = t.denominator / gnomon_max(t.numerator, Real(0.0009765625) * t.denominator);
        Real w = h.whole / hamburger6_kernel(h, hamburger6_polynomials_shift(p, d, side * away));
        r.lower = gnomon_select(outside, r.lower, gnomon_select(positive3, w, (Real(1) - r.weight) - w));
        r.distance = gnomon_select(outside, r.distance, gnomon_select(positive3, w * away, p.p1 + w * away));
    }
    return r;
}

/// Both bounds on the shadow intensity at z_f and the weight of the receiver.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: against the moment problem solved in 120 digits (tests/moments/hamburger_oracle.cpp),
///     error, double, no bias, four depths and more: p99 1e-14, p99.9 4e-14
///     error, float, hankel6_constant_bias at 5e-6: p99 2e-5, p99.9 5e-5, max 2e-4
/// and against the kernel in double,
///     error, float, hankel6_from_float: p99 2e-5, p99.9 5e-5, max 2e-4
///     error, float, hankel6_from_float_filtered: p99 1e-5, p99.9 3e-5, max 1e-4
///     error, float, hankel6_from_unorm16: p99 8e-4, p99.9 3e-3, max 4e-2
///     error, float, hankel6_from_unorm16_filtered: p99 5e-4, p99.9 2e-3, max 2e-2
///     error, float, hankel6_from_unorm10: p99 3e-5, p99.9 9e-5, max 8e-4
///     error, float, hankel6_from_unorm10_filtered: p99 2e-5, p99.9 5e-5, max 3e-4
/// Maxima are found by climbing and stated with a margin. Without a bias there is no maximum: if D_3 is at the floor,
/// moments rounded in double cannot resolve distances below 2^-32.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hamburger_bounds<Real> hamburger6_bounds(hankel6<Real> h, Real z_f)
{
    hamburger6_sums s = hamburger6_sums_at(h, clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean);
    hamburger_bounds<Real> r;
    r.lower = saturate_or_zero(s.lower);
    r.weight = gnomon_min(saturate_or_zero(s.weight), Real(1) - r.lower);
    r.upper = r.lower + r.weight;
    return r;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1]. Surfaces should show this bound, since it never darkens
/// a lit surface.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: 0, lit, for a NaN in h or z_f.
/// Error: as for hamburger6_bounds.
/// Source: Peters 2017, Eq. 1; Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger6_lower(hankel6<Real> h, Real z_f) { return hamburger6_bounds(h, z_f).lower; }

/// The canonical distribution with a node at z_f. The other three depths are finite, at most 1026 from z_f, where a
/// node that would be at infinity has no weight.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: a single depth at the far plane.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr distribution4<Real> hamburger6_distribution(hankel6<Real> h, Real z_f)
{
    polynomials6 p = hamburger6_polynomials(h, clamp_or_nan(z_f, Real(-1), Real(1)) - h.mean);
    Real inverse = Real(1) / hamburger6_kernel(h, p);
    Real side = gnomon_select(p.p3 > Real(0), Real(-1), Real(1));
    hamburger6_cubic n = hamburger6_other_nodes(h, p, hamburger6_derivatives(h, p), inverse, side);
    // The largest root. Division by it leaves a quadratic for the other two, which Halley's iteration refines.
    Real t1 = cubic_largest_root(n.b, n.c, n.d);
    // The division starts at the end that does not cancel: at the highest power for a small root, else at the lowest.
    mask_t<Real> large = (t1 * t1) * t1 > -n.d;
    Real backward = -n.d / t1;
    Real forward = n.b + t1;
    Real b = Real(0.5) * gnomon_select(large, (backward - n.c) / t1, forward);
    Real c = gnomon_select(large, backward, n.c + t1 * forward);
    quadratic_result q = quadratic_roots(Real(1), b, c);
    Real t2 = cubic_halley(n.b, n.c, n.d, q.first);
    Real t3 = cubic_halley(n.b, n.c, n.d, q.second);
    Real x1 = p.p1 + side * hamburger6_distance(t1);
    Real x2 = p.p1 + side * hamburger6_distance(t2);
    Real x3 = p.p1 + side * hamburger6_distance(t3);
    Real low = gnomon_min(x2, x3);
    Real high = gnomon_max(x2, x3);
    Real y1 = gnomon_min(x1, low);
    Real y2 = gnomon_max(gnomon_min(x1, high), low);
    Real y3 = gnomon_max(x1, high);
    Real w0 = h.whole * inverse;
    Real w1 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y1));
    Real w2 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y2));
    Real w3 = h.whole / hamburger6_kernel(h, hamburger6_polynomials(h, y3));
    Real sum = (w0 + w1) + (w2 + w3);
    mask_t<Real> known = sum > Real(0); // false for NaN
    distribution4<Real> d;
    d.depth0 = gnomon_select(known, h.mean + p.p1, Real(1));
    d.depth1 = gnomon_select(known, h.mean + y1, Real(1));
    d.depth2 = gnomon_select(known, h.mean + y2, Real(1));
    d.depth3 = gnomon_select(known, h.mean + y3, Real(1));
    d.weight1 = gnomon_select(known, w1 / sum, Real(0));
    d.weight2 = gnomon_select(known, w2 / sum, Real(0));
    d.weight3 = gnomon_select(known, w3 / sum, Real(0));
    d.weight0 = saturate_or_zero(Real(1) - (d.weight1 + (d.weight2 + d.weight3)));
    return d;
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

// soft/blocker6.h -----------------------------------------------------------------------------------------------------
// The mean depth of blockers from six moments: blocker.h, for search regions that hold more surfaces.
//
// hamburger6.h finds a single node, which is alone on its side of z_f. The mean of (x - z_f) over all nodes is -u, so
// the sum A of w (z_f - x) over the nodes x before z_f is
//     all before z_f:        u
//     the lone one before:   w (z_f - x)            of that node
//     the lone one behind:   u + w (x - z_f)
//     none:                  0
#ifndef GNOMON_SOFT_BLOCKER6_H
#define GNOMON_SOFT_BLOCKER6_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// Mean blocker depth in [-1, z_f] from six moments.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in h; a z_f of NaN is the far plane.
/// Error: against the moment problem solved in 120 digits (tests/soft/blocker.cpp),
///     error, double, no bias: p99 1e-14, p99.9 1e-13
/// and against the kernel in double, for a table of 784 texels,
///     error, float, hankel6_from_summed: p99 1e-3, p99.9 5e-3, max 5e-1
/// Source: Peters 2017, Eq. 4
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real blocker6_depth(hankel6<Real> h, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    hamburger6_sums s = hamburger6_sums_at(h, z - h.mean);
    return blocker_depth_before(z, s.distance / (literal<Real>(blocker_epsilon) + gnomon_max(s.lower, Real(0))));
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

// moments/bias.h, six moments -----------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_BIAS_6
#define GNOMON_MOMENTS_BIAS_6

GNOMON_WARNINGS_OFF namespace gnomon {

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
inline constexpr double bias6_raw_b2 = 0.42015374983242804;
inline constexpr double bias6_raw_b4 = 0.2876068288776971;
inline constexpr double bias6_raw_b6 = 0.25730795870391842;

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
inline constexpr double bias6_theta_b2 = 0.61284694380550628;
inline constexpr double bias6_theta_b4 = 0.52469968779048582;
inline constexpr double bias6_theta_b6 = 0.50463026403505464;
inline constexpr double bias6_paper_b2 = 0.5566;
inline constexpr double bias6_paper_b4 = 0.489;
inline constexpr double bias6_paper_b6 = 0.47869382;

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from
/// them are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_add_bias(moments6<Real> b, std::type_identity_t<Real> bias2,
                                                         std::type_identity_t<Real> bias4,
                                                         std::type_identity_t<Real> bias6,
                                                         std::type_identity_t<Real> alpha)
{
    Real keep = Real(1) - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
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

// moments/channels.h, six moments -------------------------------------------------------------------------------------
#ifndef GNOMON_MOMENTS_CHANNELS_6
#define GNOMON_MOMENTS_CHANNELS_6

GNOMON_WARNINGS_OFF namespace gnomon {

template <class Real, class = require_real<Real>> struct channels6 { Real c1, c2, c3, c4, c5, c6; };

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// moments/quantization.h, six moments ---------------------------------------------------------------------------------
// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_6
#define GNOMON_MOMENTS_QUANTIZATION_6

GNOMON_WARNINGS_OFF namespace gnomon {

/// The moments that a format without transform holds as they are.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> moments6_from_channels(channels6<Real> c)
{
    moments6<Real> b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    b.b5 = c.c5;
    b.b6 = c.c6;
    return b;
}

/// The moments b as the channels of a format without transform.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> channels6_from_moments(moments6<Real> b)
{
    channels6<Real> c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b5;
    c.c6 = b.b6;
    return c;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
inline constexpr double theta6_21 = -1.8745771666290014;
inline constexpr double theta6_23 = 4.204664766466248;
inline constexpr double theta6_25 = -1.8300875998372463;
inline constexpr double theta6_31 = 1.2643431422063351;
inline constexpr double theta6_33 = -1.4716161665593888;
inline constexpr double theta6_35 = 0.70727302435305361;
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
inline constexpr double theta6_62 = -0.57735026918962573;
inline constexpr double theta6_64 = 4.6188021535170058;
inline constexpr double theta6_66 = -3.0792014356780042;
inline constexpr double theta6_60 = 0.018874775675311862;
inline constexpr double theta6_inverse11 = -0.02841260648183782;
inline constexpr double theta6_inverse12 = 0.47582541301272185;
inline constexpr double theta6_inverse13 = 1.552587193469116;
inline constexpr double theta6_inverse31 = 0.10002244957859331;
inline constexpr double theta6_inverse32 = 0.84496560893955308;
inline constexpr double theta6_inverse33 = 1.0550119414818537;
inline constexpr double theta6_inverse51 = 0.25890700149881596;
inline constexpr double theta6_inverse52 = 0.90751156960796575;
inline constexpr double theta6_inverse53 = 0.83358142889321829;
inline constexpr double theta6_inverse_sixth = 0.16666666666666666;
inline constexpr double theta6_inverse23 = 0.8660254037844386;
inline constexpr double theta6_inverse63 = 0.81189881604791125;

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels6<Real> theta6(moments6<Real> b)
{
    channels6<Real> c;
    c.c1 = Real(2.5) * b.b1 - Real(10) * b.b3 + Real(8) * b.b5 + Real(0.5);
    c.c2 = literal<Real>(theta6_21) * b.b1 + literal<Real>(theta6_23) * b.b3 + literal<Real>(theta6_25) * b.b5 +
           Real(0.5);
    c.c3 = literal<Real>(theta6_31) * b.b1 + literal<Real>(theta6_33) * b.b3 + literal<Real>(theta6_35) * b.b5 +
           Real(0.5);
    c.c4 = Real(4) * (b.b2 - b.b4);
    c.c5 = Real(9) * b.b2 - Real(24) * b.b4 + Real(16) * b.b6;
    c.c6 = literal<Real>(theta6_62) * b.b2 + literal<Real>(theta6_64) * b.b4 + literal<Real>(theta6_66) * b.b6 +
           literal<Real>(theta6_60);
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr moments6<Real> theta6_inverse(channels6<Real> c)
{
    Real c1 = c.c1 - Real(0.5);
    Real c2 = c.c2 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    Real c5 = literal<Real>(theta6_inverse_sixth) * c.c5;
    Real c6 = c.c6 - literal<Real>(theta6_60);
    moments6<Real> b;
    b.b1 = literal<Real>(theta6_inverse11) * c1 + literal<Real>(theta6_inverse12) * c2 +
           literal<Real>(theta6_inverse13) * c3;
    b.b3 = literal<Real>(theta6_inverse31) * c1 + literal<Real>(theta6_inverse32) * c2 +
           literal<Real>(theta6_inverse33) * c3;
    b.b5 = literal<Real>(theta6_inverse51) * c1 + literal<Real>(theta6_inverse52) * c2 +
           literal<Real>(theta6_inverse53) * c3;
    b.b2 = c5 + literal<Real>(theta6_inverse23) * c6;
    b.b4 = (c5 + literal<Real>(theta6_inverse23) * c6) - Real(0.25) * c.c4;
    b.b6 = (Real(0.21875) * c.c5 + literal<Real>(theta6_inverse63) * c6) - Real(0.375) * c.c4;
    return b;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// storage/moments6.h --------------------------------------------------------------------------------------------------
// Six moments in a storage format: from a depth to the channels of a texel, and from filtered channels to a shadow or
// to the factored Hankel matrix. Each format undoes its own transform and applies the constant bias that belongs to it,
// so that nobody pairs the wrong three.
//
//   format          bytes   transform   write                     read                         matrix for both bounds
//   6 x 10 UNORM      8     theta6      moments6_unorm10_encode   moments6_unorm10_intensity   hankel6_from_unorm10
//   6 x 16 UNORM     12     theta6      moments6_unorm16_encode   moments6_unorm16_intensity   hankel6_from_unorm16
//   6 x float        24     none        moments6_float_encode     moments6_float_intensity     hankel6_from_float
//
// Texels of 6 x 10 UNORM are two 10-10-10-2 words: odd channels (c1, c2, c3) in the first, even ones (c4, c5, c6) in
// the second. Filters are linear: average channels as they are.
//
// Intensities exceed Z(z < z_f) by the weight at most, for every receiver: by the proof in bias.h n roundings need a
// weight of n delta / (n delta + r).
//
//                  delta      n = 1     weight    n = 3     weight, filtered
//   6 x 10 UNORM   1/2046     3.34e-3   4e-3      9.96e-3   1e-2
//   6 x 16 UNORM   1/131070   5.23e-5   8e-5      1.57e-4   1.6e-4
//   6 x float      2^-25      1.83e-6   5e-6                2e-5
//
// Filtered: rounded when rendered and by each of two passes of nine taps, their sums in float. Sums of floats round as
// storage does, and so do the powers of a depth: at their worst they are 22 roundings and 4e-5, which do not come
// together. The kernel's own arithmetic in float is within the weights. Tests search for the largest excess by hill
// climbing (tests/moments/honest_six.cpp), and find that 5e-6 is too little for filtered floats.
#ifndef GNOMON_STORAGE_MOMENTS6_H
#define GNOMON_STORAGE_MOMENTS6_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double stored6_unorm10_weight = 4e-3;
inline constexpr double stored6_unorm10_filtered_weight = 1e-2;
inline constexpr double stored6_unorm16_weight = 8e-5;
inline constexpr double stored6_unorm16_filtered_weight = 1.6e-4;
inline constexpr double stored6_float_weight = 5e-6;
inline constexpr double stored6_float_filtered_weight = 2e-5;

/// The six channels of a 6 x 10 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> moments6_unorm10_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The six channels of a 6 x 16 UNORM texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> moments6_unorm16_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The six channels of a 6 x float texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels6<Real> moments6_float_encode(Real z)
{
    return channels6_from_moments(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The factored matrix of the channels of theta6, with a constant bias of weight alpha.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_theta(channels6<Real> c, std::type_identity_t<Real> alpha)
{
    return hankel6_from_moments(moments6_add_bias(theta6_inverse(c), literal<Real>(bias6_theta_b2),
                                                  literal<Real>(bias6_theta_b4), literal<Real>(bias6_theta_b6), alpha));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_unorm10(channels6<Real> c)
{
    return hankel6_from_theta(c, literal<Real>(stored6_unorm10_weight));
}

/// The factored matrix of the channels of a 6 x 10 UNORM texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_unorm10_filtered(channels6<Real> c)
{
    return hankel6_from_theta(c, literal<Real>(stored6_unorm10_filtered_weight));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_unorm16(channels6<Real> c)
{
    return hankel6_from_theta(c, literal<Real>(stored6_unorm16_weight));
}

/// The factored matrix of the channels of a 6 x 16 UNORM texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_unorm16_filtered(channels6<Real> c)
{
    return hankel6_from_theta(c, literal<Real>(stored6_unorm16_filtered_weight));
}

/// The factored matrix of the channels of a 6 x float texel, biased for one rounding.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_float(channels6<Real> c)
{
    return hankel6_constant_bias(moments6_from_channels(c), literal<Real>(bias6_raw_b2), literal<Real>(bias6_raw_b4),
                                 literal<Real>(bias6_raw_b6), literal<Real>(stored6_float_weight));
}

/// The factored matrix of the channels of a 6 x float texel, biased for a filter of two passes.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_float_filtered(channels6<Real> c)
{
    return hankel6_constant_bias(moments6_from_channels(c), literal<Real>(bias6_raw_b2), literal<Real>(bias6_raw_b4),
                                 literal<Real>(bias6_raw_b6), literal<Real>(stored6_float_filtered_weight));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_unorm10_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm10(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 10 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_unorm10_filtered_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm10_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_unorm16_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm16(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x 16 UNORM texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_unorm16_filtered_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_unorm16_filtered(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_float_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_float(c), z_f);
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a 6 x float texel, after a filter of two passes.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_float_filtered_intensity(channels6<Real> c, Real z_f)
{
    return hamburger6_lower(hankel6_from_float_filtered(c), z_f);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// storage/moments6_summed.h -------------------------------------------------------------------------------------------
// Six moments in a summed-area table (soft/summed_area.h): moments4_summed.h for search regions that hold more
// surfaces, in 24 bytes a texel.
//
//   a texel:        c = moments6_summed_encode(z)               channels of theta6; a resolve averages them
//                   codes = moments6_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned
// integers
//   a rectangle:    c = moments6_summed_channels(sums, area, scale)
//                   z_b = moments6_summed_blocker(c, most_texels, z_f)
//                   shadow = moments6_summed_intensity(c, most_texels, z_f - bias)
//
// Channels are off by half a code, most_texels 2^-33, and by what float arithmetic rounds. Intensities exceed Z(z <
// z_f) by moments6_summed_weight at most.
#ifndef GNOMON_STORAGE_MOMENTS6_SUMMED_H
#define GNOMON_STORAGE_MOMENTS6_SUMMED_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double moments6_summed_code_weight = 8e-10; // 2^-33 / r
inline constexpr double moments6_summed_float_weight = 6e-6;

/// The weight of the constant bias of a table for most_texels, by which intensities may exceed the truth.
/// Domain: most_texels as of the table's scale.
/// NaN: the weight of a small table.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr Real moments6_summed_weight(Real most_texels)
{
    Real weight = literal<Real>(moments6_summed_code_weight) * most_texels +
                  literal<Real>(moments6_summed_float_weight);
    return gnomon_min(gnomon_max(weight, literal<Real>(moments6_summed_float_weight)), Real(0.5));
}

/// The six channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Source: Peters 2017, Sec. 5.4.3
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr channels6<Real> moments6_summed_encode(Real z)
{
    return theta6(moments6_from_depth(clamp_or_high(z, Real(-1), Real(1))));
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> moments6_summed_codes(channels6<Real> c, std::type_identity_t<Real> scale)
{
    Real any = (clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1))) +
               (clamp_or_nan(c.c3, Real(0), Real(1)) + clamp_or_nan(c.c4, Real(0), Real(1))) +
               (clamp_or_nan(c.c5, Real(0), Real(1)) + clamp_or_nan(c.c6, Real(0), Real(1)));
    mask_t<Real> known = any == any;
    channels6 border = moments6_summed_encode(Real(1));
    channels6<Real> r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    r.c5 = summed_area_code(gnomon_select(known, c.c5, border.c5), scale);
    r.c6 = summed_area_code(gnomon_select(known, c.c6, border.c6), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr channels6<Real> moments6_summed_channels(channels6<Real> sums, Real area,
                                                                 std::type_identity_t<Real> scale)
{
    mask_t<Real> some = Real(0) < area;
    channels6 border = moments6_summed_encode(Real(1)); // off by roundings, also beyond 1
    channels6<Real> r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), saturate_or_zero(border.c1));
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), saturate_or_zero(border.c2));
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), saturate_or_zero(border.c3));
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), saturate_or_zero(border.c4));
    r.c5 = gnomon_select(some, summed_area_mean(sums.c5, area, scale), saturate_or_zero(border.c5));
    r.c6 = gnomon_select(some, summed_area_mean(sums.c6, area, scale), saturate_or_zero(border.c6));
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_summed_theta(channels6<Real> c, std::type_identity_t<Real> alpha)
{
    return hankel6_constant_bias(theta6_inverse(c), literal<Real>(bias6_theta_b2), literal<Real>(bias6_theta_b4),
                                 literal<Real>(bias6_theta_b6), alpha);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr hankel6<Real> hankel6_from_summed(channels6<Real> c, std::type_identity_t<Real> most_texels)
{
    return hankel6_from_summed_theta(c, moments6_summed_weight(most_texels));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_summed_intensity(channels6<Real> c, std::type_identity_t<Real> most_texels,
                                                       Real z_f)
{
    return hamburger6_lower(hankel6_from_summed(c, most_texels), z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real moments6_summed_blocker(channels6<Real> c, std::type_identity_t<Real> most_texels,
                                                     Real z_f)
{
    return blocker6_depth(hankel6_from_summed(c, most_texels), z_f);
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
