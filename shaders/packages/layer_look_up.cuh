// Gnomon 0.1.0, layer_look_up.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_LAYER_LOOK_UP_CUH
#define GNOMON_LAYER_LOOK_UP_CUH

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
#error "gnomon: layer_look_up.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: layer_look_up.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: layer_look_up.cuh is not of the same version as a package before it"
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

// filters/depth_bias.h ------------------------------------------------------------------------------------------------
// The depth bias that keeps a surface from shadowing itself: subtract it from the receiver's depth before the
// intensity. A filter region holds depths of the receiver's own plane that are nearer to the light than the receiver,
// by the most that the plane rises within the half widths of the filter. Half widths are those of blur and look-up
// together, from the receiver to the centre of the farthest texel; for mip level l they are 2^l times as large. 9 taps
// and bilinear filtering have 5.5 texels.
//
//     bias = depth_bias_slope_scaled(sine, cosine, 5.5 * footprint * depth_per_texel, 5.67);       from the normal
//
//     gradient = depth_gradient_from_derivatives(...);                                             from screen space
//     bias = depth_bias_receiver_plane(gradient, half_width_x, half_width_y, limit);
//
//     intensity = variance_unorm16_intensity(channels, z_f - bias);
#ifndef GNOMON_FILTERS_DEPTH_BIAS_H
#define GNOMON_FILTERS_DEPTH_BIAS_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A bias of any size limited to [0, 2], the whole range of signed depth.
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_bias_limit(Real bias) { return gnomon_min(Real(2), gnomon_max(bias, Real(0))); }

/// The slope-scaled depth bias in [0, 2] of a plane, from its tilt against the light. across and along are the parts of
/// the normal across the light's direction and along it, of any length and sign. rise is the depth by which a plane at
/// 45 degrees rises within the half width of the filter: half width in texels times depth per texel. steepest is the
/// largest
/// slope: beyond it a bias would remove the shadows of whole casters for the sake of surfaces that are hardly lit. The
/// slope of 80 degrees is 5.67.
/// Domain: any; rise and steepest at least 0, else 0. A plane along the light has the slope steepest.
/// NaN: 0; a steepest of NaN counts as none.
/// Error: relative, 2 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_bias_slope_scaled(Real across, Real along, Real rise,
                                                     std::type_identity_t<Real> steepest)
{
    return depth_bias_limit(rise * gnomon_min(steepest, gnomon_abs(across) / gnomon_abs(along)));
}

/// The change of depth per texel along x and y of the map.
template <class Real, class = require_real<Real>> struct depth_gradient { Real x, y; };

/// The difference a b - c d, rounded. Where both products cancel, their difference keeps its precision.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_gradient_minor(Real a, Real b, Real c, Real d)
{
    double_word p = two_product(a, b);
    double_word q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// The gradient of depth across the receiver's plane, from the derivatives of the position in the map, x and y in
/// texels, and of depth along two directions, 1 and 2, such as those of the screen.
/// Domain: as for two_product; the directions are not parallel in the map, else infinite or NaN, for which
/// depth_bias_receiver_plane gives the limit or 0.
/// NaN: NaN.
/// Error: relative, 10 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_gradient<Real> depth_gradient_from_derivatives(Real x1, Real y1, Real depth1, Real x2,
                                                                             Real y2, Real depth2)
{
    Real determinant = depth_gradient_minor(x1, y2, x2, y1);
    depth_gradient<Real> r;
    r.x = depth_gradient_minor(depth1, y2, depth2, y1) / determinant;
    r.y = depth_gradient_minor(x1, depth2, x2, depth1) / determinant;
    return r;
}

/// The receiver-plane depth bias in [0, 2]: the most that a plane with this gradient rises within the half widths of
/// the filter, in texels, but at most limit.
/// Domain: any; limit at least 0, else 0.
/// NaN: 0; a limit of NaN counts as none.
/// Error: relative, 2 2^-p.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_bias_receiver_plane(depth_gradient<Real> gradient, Real half_width_x,
                                                       Real half_width_y, std::type_identity_t<Real> limit)
{
    Real rise = gnomon_abs(gradient.x * half_width_x) + gnomon_abs(gradient.y * half_width_y);
    return depth_bias_limit(gnomon_min(limit, rise));
}

/// The adaptive depth bias in [0, 2] for a look-up of a single texel: by how much the receiver is behind its own plane
/// where the plane meets the ray through the texel's centre, at most limit, plus epsilon. offset_x and offset_y lead
/// from that centre to the receiver, in texels. For a rectangle of texels depth_bias_receiver_plane is the largest of
/// these, less epsilon, if its half widths reach to the farthest centre.
/// Domain: any; limit and epsilon at least 0.
/// NaN: epsilon; a limit of NaN counts as none, an epsilon of NaN gives 0.
/// Error: relative, 4 2^-p of |gradient.x offset_x| + |gradient.y offset_y| + epsilon.
/// Source: Dou 2014
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real depth_bias_texel_plane(depth_gradient<Real> gradient, Real offset_x, Real offset_y,
                                                    std::type_identity_t<Real> limit,
                                                    std::type_identity_t<Real> epsilon)
{
    Real behind = gnomon_max(gradient.x * offset_x + gradient.y * offset_y, Real(0));
    return depth_bias_limit(depth_bias_limit(gnomon_min(limit, behind)) + epsilon);
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

// motion/layers/layer_clusters.h --------------------------------------------------------------------------------------
// Clusters of the samples around a tile of a stochastic shadow map: up to four layers, one behind the other (Andersson
// et al. 2015, Sec. 4.1, Depth clustering). Depths are those in the middle of the shutter interval, by each sample's
// own motion. 64 equal bins lie between the least and the greatest of them. Layers are cut in the middle of the longest
// runs of empty bins that have occupied bins on either side. A level surface has no such run, hence no cut. Nothing is
// sorted.
//
//     window = layer_window_begin(layer_middle_depth(s));
//     window = layer_window_add(window, layer_middle_depth(s));                    for all samples s
//     mark bin layer_bin_of(layer_middle_depth(s), window) of 64                   for all s whose bin is not -1
//     state = layer_cuts_begin(window);
//     state = layer_cuts_add(state, 1 or 0: occupied or not);                      for bins 0 to 63
//     cuts = layer_cuts_end(state, 4);
//     at = layer_of(layer_middle_depth(s), cuts);                                  for all samples: 0 is the nearest
// layer
//
// Marks are the caller's, such as bits of its language's integers. The background is behind every layer and forms none.
// A sample of NaN is no information: it is in front of every layer, so that none counts it.
#ifndef GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H
#define GNOMON_MOTION_LAYERS_LAYER_CLUSTERS_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double layer_depth_limit = 2.0;      // middle depths of surfaces lie in [-2, 2]
inline constexpr double layer_no_cut = 3.0;           // a cut behind all surfaces
inline constexpr double layer_background_depth = 4.0; // the middle depth of the background
inline constexpr double layer_unknown_depth = -4.0;   // the middle depth of a sample of NaN
inline constexpr double layer_last_bin = 63.0;
inline constexpr double layer_least_extent = 0.00006103515625; // 2^-14: depths that lie closer together are one layer

/// The depth of a sample in the middle of the shutter interval by its own motion, z + (1/2 - t) d_z, limited to [-2,
/// 2]; layer_background_depth for the background.
/// Domain: the depth, |d_x|, |d_y| and |d_z| have a sum of at most 65536. A sample beyond that is no information, since
/// neither its place in a layer nor its depth there is known.
/// NaN: layer_unknown_depth, as for infinite depths and motions.
/// Error: 4 2^-p where |d_z| <= 2.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_middle_depth(stochastic_sample<Real> s)
{
    Real z = s.z + (Real(0.5) - s.t) * s.d_z;
    Real limit = literal<Real>(layer_depth_limit);
    Real inside = gnomon_max(gnomon_min(z, limit), Real(-1) * limit);
    // Mesa joins several comparisons by a maximum that loses a NaN, so a sum is compared.
    Real size = ((gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z)) + gnomon_abs(z);
    mask_t<Real> known = size <= literal<Real>(texel_limit);
    Real middle = gnomon_select(known, inside, literal<Real>(layer_unknown_depth));
    return gnomon_select(s.id < Real(0), literal<Real>(layer_background_depth), middle);
}

/// True for the middle depth of a surface, false for those of the background and of a sample of NaN.
template <class Real, class = require_real<Real>> GNOMON_INLINE constexpr mask_t<Real> layer_is_surface(Real middle)
{
    return gnomon_abs(middle) <= literal<Real>(layer_depth_limit);
}

/// The least and the greatest middle depth of the surfaces in a window. least is above greatest if there is none.
template <class Real, class = require_real<Real>> struct layer_window { Real least, greatest; };

/// The window of one sample, by its middle depth.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_window<Real> layer_window_begin(Real middle)
{
    mask_t<Real> surface = layer_is_surface(middle);
    layer_window<Real> w;
    w.least = gnomon_select(surface, middle, literal<Real>(layer_background_depth));
    w.greatest = gnomon_select(surface, middle, literal<Real>(layer_unknown_depth));
    return w;
}

/// The window with one more sample, by its middle depth.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_window<Real> layer_window_add(layer_window<Real> window, Real middle)
{
    layer_window other = layer_window_begin(middle);
    window.least = gnomon_min(window.least, other.least);
    window.greatest = gnomon_max(window.greatest, other.greatest);
    return window;
}

/// The bin of a middle depth, a whole number from 0 to 63; -1 for the background.
/// Domain: depths beyond the window are in its first or last bin.
/// NaN: -1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_bin_of(Real middle, layer_window<Real> window)
{
    Real share = saturate_or_zero((middle - window.least) / (window.greatest - window.least));
    Real bin = gnomon_min(texel_below(Real(64) * share), literal<Real>(layer_last_bin));
    return gnomon_select(layer_is_surface(middle), bin, Real(-1));
}

/// A fold over bins: the window, the number of bins so far, 1 if one of them is occupied, the number of empty ones
/// since the last of these, and the lengths and centres of the three longest runs, in bins.
template <class Real, class = require_real<Real>> struct layer_runs
{
    Real least, greatest, bins, begun, empty;
    Real length0, length1, length2, centre0, centre1, centre2;
};

/// The state before bin 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_runs<Real> layer_cuts_begin(layer_window<Real> window)
{
    layer_runs<Real> r;
    r.least = window.least;
    r.greatest = window.greatest;
    r.bins = Real(0);
    r.begun = Real(0);
    r.empty = Real(0);
    r.length0 = Real(0);
    r.length1 = Real(0);
    r.length2 = Real(0);
    r.centre0 = Real(0);
    r.centre1 = Real(0);
    r.centre2 = Real(0);
    return r;
}

/// The state after the next bin, from near to far. A bin is occupied if occupied is above 0. Of runs of the same length
/// the nearer one counts as longer.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_runs<Real> layer_cuts_add(layer_runs<Real> state, Real occupied)
{
    mask_t<Real> some = Real(0) < occupied;
    Real centre = state.bins - Real(0.5) * state.empty;
    mask_t<Real> third = some && state.length2 < state.empty;
    mask_t<Real> second = some && state.length1 < state.empty;
    mask_t<Real> first = some && state.length0 < state.empty;
    state.length2 = gnomon_select(second, state.length1, gnomon_select(third, state.empty, state.length2));
    state.centre2 = gnomon_select(second, state.centre1, gnomon_select(third, centre, state.centre2));
    state.length1 = gnomon_select(first, state.length0, gnomon_select(second, state.empty, state.length1));
    state.centre1 = gnomon_select(first, state.centre0, gnomon_select(second, centre, state.centre1));
    state.length0 = gnomon_select(first, state.empty, state.length0);
    state.centre0 = gnomon_select(first, centre, state.centre0);
    state.begun = gnomon_select(some, Real(1), state.begun);
    state.empty = gnomon_select(some, Real(0), state.empty + state.begun);
    state.bins = state.bins + Real(1);
    return state;
}

/// Depths that cut a window into layers, from near to far; layer_no_cut for those that are not needed.
template <class Real, class = require_real<Real>> struct layer_cuts { Real c0, c1, c2; };

/// The cuts at the longest runs of empty bins, one fewer than `layers`, in depths between the samples of the bins
/// before and those of the bins behind. None if the window is shorter than 2^-14.
/// Domain: layers from 1 to 4; a smaller number makes one layer, a larger one up to four.
/// NaN: one layer.
/// Error: 10 2^-p. A cut is at least half a bin away from the bins before and behind, so no sample changes its layer by
/// that.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_cuts<Real> layer_cuts_end(layer_runs<Real> state, std::type_identity_t<Real> layers)
{
    Real none = literal<Real>(layer_no_cut);
    Real extent = state.greatest - state.least;
    mask_t<Real> surfaces = layer_is_surface(state.least) && layer_is_surface(state.greatest);
    mask_t<Real> some = surfaces && literal<Real>(layer_least_extent) <= extent;
    Real per_bin = Real(0.015625) * extent;
    mask_t<Real> first = some && Real(0) < state.length0 && Real(1) < layers;
    mask_t<Real> second = some && Real(0) < state.length1 && Real(2) < layers;
    mask_t<Real> third = some && Real(0) < state.length2 && Real(3) < layers;
    Real a = gnomon_select(first, state.least + per_bin * state.centre0, none);
    Real b = gnomon_select(second, state.least + per_bin * state.centre1, none);
    Real c = gnomon_select(third, state.least + per_bin * state.centre2, none);
    Real near_ab = gnomon_min(a, b);
    Real far_ab = gnomon_max(a, b);
    Real middle = gnomon_min(far_ab, c);
    layer_cuts<Real> r;
    r.c0 = gnomon_min(near_ab, middle);
    r.c1 = gnomon_max(near_ab, middle);
    r.c2 = gnomon_max(far_ab, c);
    return r;
}

/// The layer of a middle depth, 0 to 3 from near to far; 4 for the background, which is behind every layer.
/// NaN: -1, in front of every layer.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_of(Real middle, layer_cuts<Real> cuts)
{
    Real known = gnomon_select(Real(-1) * literal<Real>(layer_depth_limit) <= middle, Real(0), Real(-1));
    Real first = gnomon_select(cuts.c0 <= middle, Real(1), Real(0));
    Real second = gnomon_select(cuts.c1 <= middle, Real(1), Real(0));
    Real third = gnomon_select(cuts.c2 <= middle, Real(1), Real(0));
    Real behind = gnomon_select(literal<Real>(layer_background_depth) <= middle, Real(1), Real(0));
    return (known + first) + ((second + third) + behind);
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/layer_grid.h ------------------------------------------------------------------------------------------
// The grid of one layer of a tile: its samples, moved to the middle of the shutter interval by the mean motion of the
// layer (Andersson et al. 2015, Sec. 4.1 and 5). The u axis points along the motion d, and the grid is stretched by
// (f + |d|) / f along it, so that it holds all that is in the tile's guard band at some time:
//
//     s_v = o / f,    s_u = o / (f + |d|)                                          f texels of the map on o texels of
// the grid
//     u = s_u (x cos + y sin + |d| (1/2 - t)) + o / 2
//     v = s_v (y cos - x sin) + o / 2
//
// with (x, y) from the tile's centre, and (cos, sin) = d / |d|. Corners of a turned window fall off the grid. A depth
// moves
// along: z + (1/2 - t) d_z.
//
//     state = layer_motion_begin(first);                                           any sample of the layer
//     state = layer_motion_add(state, s, layer_middle_depth(s));                   for all samples of the layer
//     motion = layer_motion_end(state);
//     grid = layer_grid_make(motion, f, o);
#ifndef GNOMON_MOTION_LAYERS_LAYER_GRID_H
#define GNOMON_MOTION_LAYERS_LAYER_GRID_H

GNOMON_WARNINGS_OFF namespace gnomon {

/// A fold over the samples of a layer: a motion, sums of differences from it and of their squares, the number of
/// samples, and the least and greatest of their motions in depth and of their depths in the middle of the shutter
/// interval, which are not limited as those of layer_middle_depth are.
template <class Real, class = require_real<Real>> struct layer_motion_sums
{
    Real first_x, first_y, first_z, x, y, z, square, square_z, count;
    Real least, greatest, least_d, greatest_d;
};

/// The mean motion of a layer over the whole shutter interval, in texels and in depth; the root mean square distance of
/// its samples' motions from that; and depths between which all samples are that are moved to the middle of the shutter
/// interval by the mean motion.
template <class Real, class = require_real<Real>>
struct layer_motion { Real d_x, d_y, d_z, spread, spread_z, least, greatest; };

/// The state before the first sample. Sums are relative to the motion of `first`, so that samples of one motion have no
/// spread.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion_sums<Real> layer_motion_begin(stochastic_sample<Real> first)
{
    Real limit = literal<Real>(texel_limit);
    layer_motion_sums<Real> r;
    r.first_x = gnomon_select(gnomon_abs(first.d_x) <= limit, first.d_x, Real(0));
    r.first_y = gnomon_select(gnomon_abs(first.d_y) <= limit, first.d_y, Real(0));
    r.first_z = gnomon_select(gnomon_abs(first.d_z) <= limit, first.d_z, Real(0));
    r.x = Real(0);
    r.y = Real(0);
    r.z = Real(0);
    r.square = Real(0);
    r.square_z = Real(0);
    r.count = Real(0);
    r.least = limit;
    r.greatest = Real(-1) * limit;
    r.least_d = limit;
    r.greatest_d = Real(-1) * limit;
    return r;
}

/// True if a layer's motion includes the sample: a surface by its middle depth, with |d_x| + |d_y| + |d_z| at most
/// 65536. The sum is compared once, since Mesa makes one comparison of three, by a maximum that loses a NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr mask_t<Real> layer_motion_is_known(stochastic_sample<Real> s, Real middle)
{
    Real length = (gnomon_abs(s.d_x) + gnomon_abs(s.d_y)) + gnomon_abs(s.d_z);
    return length <= literal<Real>(texel_limit) && layer_is_surface(middle);
}

/// The state after one more sample and its middle depth.
/// Domain: |d_x| + |d_y| + |d_z| up to 65536; longer motions are no information.
/// NaN: no information, the state as before.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion_sums<Real> layer_motion_add(layer_motion_sums<Real> state,
                                                                 stochastic_sample<Real> s, Real middle)
{
    mask_t<Real> known = layer_motion_is_known(s, middle);
    Real x = gnomon_select(known, s.d_x - state.first_x, Real(0));
    Real y = gnomon_select(known, s.d_y - state.first_y, Real(0));
    Real z = gnomon_select(known, s.d_z - state.first_z, Real(0));
    state.x = state.x + x;
    state.y = state.y + y;
    state.z = state.z + z;
    state.square = state.square + (x * x + y * y);
    state.square_z = state.square_z + z * z;
    state.count = state.count + gnomon_select(known, Real(1), Real(0));
    Real moved = s.z + (Real(0.5) - s.t) * s.d_z;
    state.least = gnomon_select(known && moved < state.least, moved, state.least);
    state.greatest = gnomon_select(known && state.greatest < moved, moved, state.greatest);
    state.least_d = gnomon_select(known && s.d_z < state.least_d, s.d_z, state.least_d);
    state.greatest_d = gnomon_select(known && state.greatest_d < s.d_z, s.d_z, state.greatest_d);
    return state;
}

/// The motion of the layer. Opposite motions cancel: the mean may be 0 and the spread large. All is 0 without a sample.
/// Error: of the mean, (n + 3) 2^-p of the largest distance from the motion of `first`, and 2^-p of itself, n the
/// number of samples; of spread^2, (n + 8) 2^-p of the square of that distance.
/// Source: Andersson 2015, Sec. 4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_motion<Real> layer_motion_end(layer_motion_sums<Real> state)
{
    Real share = Real(1) / gnomon_max(state.count, Real(1));
    Real x = state.x * share;
    Real y = state.y * share;
    Real z = state.z * share;
    mask_t<Real> some = Real(0) < state.count;
    layer_motion<Real> r;
    r.d_x = gnomon_select(some, state.first_x + x, Real(0));
    r.d_y = gnomon_select(some, state.first_y + y, Real(0));
    r.d_z = gnomon_select(some, state.first_z + z, Real(0));
    r.spread = gnomon_sqrt(gnomon_max(Real(0), state.square * share - (x * x + y * y)));
    r.spread_z = gnomon_sqrt(gnomon_max(Real(0), state.square_z * share - z * z));
    // A sample is off by |1/2 - t| of what its motion differs from the mean.
    Real off = Real(0.5) * gnomon_max(state.greatest_d - r.d_z, r.d_z - state.least_d);
    r.least = gnomon_select(some, state.least - off, Real(0));
    r.greatest = gnomon_select(some, state.greatest + off, Real(0));
    return r;
}

/// Direction of the motion, texels of the grid per texel of the map along it and across, length of the motion in
/// texels, its part in depth, half the extent of the grid in texels, centre and scale that stretch the layer's depths
/// to [-1, 1], and the spread of motion in texels and in depth.
template <class Real, class = require_real<Real>> struct layer_grid
{
    Real axis_x, axis_y, scale_u, scale_v, motion, d_z, middle, centre, scale, spread, spread_z;
};

inline constexpr double layer_least_motion = 0.00000095367431640625; // 2^-20 texels: shorter motions have no direction
// 2^-10: no layer is stretched as if it were thinner
inline constexpr double layer_least_depths = 0.0009765625;

/// The grid of a layer of this motion, with `texels` by `texels` texels for a window of `guard` by `guard` texels of
/// the map. For a motion of less than 2^-20 texels the axes are those of the map, and its length is 0.
/// Domain: motions up to 65536 texels; guard > 0; texels > 0.
/// NaN: a NaN in the motion, guard or texels stays NaN where it matters; layer_place_is_inside is then 0.
/// Source: Andersson 2015, Eq. 11
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_grid<Real> layer_grid_make(layer_motion<Real> mean, std::type_identity_t<Real> guard,
                                                         std::type_identity_t<Real> texels)
{
    Real chord = gnomon_sqrt(mean.d_x * mean.d_x + mean.d_y * mean.d_y);
    mask_t<Real> moves = literal<Real>(layer_least_motion) <= chord;
    layer_grid<Real> g;
    g.axis_x = gnomon_select(moves, mean.d_x / chord, Real(1));
    g.axis_y = gnomon_select(moves, mean.d_y / chord, Real(0));
    g.motion = gnomon_select(moves, chord, Real(0));
    g.scale_u = texels / (guard + g.motion);
    g.scale_v = texels / guard;
    g.d_z = mean.d_z;
    g.middle = Real(0.5) * texels;
    g.centre = Real(0.5) * (mean.least + mean.greatest);
    g.scale = Real(2) / gnomon_max(literal<Real>(layer_least_depths), mean.greatest - mean.least);
    g.spread = mean.spread;
    g.spread_z = mean.spread_z;
    return g;
}

/// A place on a layer's grid, in its texels, texel centres at +0.5.
template <class Real, class = require_real<Real>> struct layer_place { Real u, v; };

/// The vector (x, y) of the map in the grid's directions, in texels of the map. GCC 12 fuses a sum and a difference of
/// products side by side even with contraction off, hence gnomon_product.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_place<Real> layer_grid_turned(layer_grid<Real> grid, Real x, Real y)
{
    layer_place<Real> r;
    r.u = gnomon_product(x, grid.axis_x) + gnomon_product(y, grid.axis_y);
    r.v = gnomon_product(y, grid.axis_x) - gnomon_product(x, grid.axis_y);
    return r;
}

/// The place on the grid of (x, y) at time t, in texels of the map from the tile's centre.
/// Error: 4 2^-p (s_u (|x| + |y| + |d|) + o) for u, the same with s_v and without |d| for v.
/// Source: Andersson 2015, Eq. 6
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_place<Real> layer_grid_place(layer_grid<Real> grid, Real x, Real y, Real t)
{
    layer_place turned = layer_grid_turned(grid, x, y);
    layer_place<Real> r;
    r.u = grid.scale_u * (turned.u + grid.motion * (Real(0.5) - t)) + grid.middle;
    r.v = grid.scale_v * turned.v + grid.middle;
    return r;
}

/// 1 if the place is in a texel of the grid, else 0. The texel is (texel_below(u), texel_below(v)).
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_place_is_inside(layer_grid<Real> grid, layer_place<Real> place)
{
    Real texels = Real(2) * grid.middle;
    mask_t<Real> begun = Real(0) <= place.u && Real(0) <= place.v;
    return gnomon_select(begun && place.u < texels && place.v < texels, Real(1), Real(0));
}

/// The depth in the middle of the shutter interval of a depth z at time t, by the motion of the layer: z + (1/2 - t)
/// d_z.
/// NaN: NaN.
/// Error: 2 2^-p (|z| + |d_z|), for times in [0, 1].
/// Source: Andersson 2015, Sec. 4.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_grid_depth(layer_grid<Real> grid, Real z, Real t)
{
    return z + (Real(0.5) - t) * grid.d_z;
}

/// The layer's own depth of a depth z at time t: layer_grid_depth in the scale in which samples of the layer are in
/// [-1, 1]. A receiver behind all of them is above 1.
/// NaN: NaN.
/// Error: scale times 4 2^-p (|z| + |d_z| + |centre|).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_grid_own_depth(layer_grid<Real> grid, Real z, Real t)
{
    return (layer_grid_depth(grid, z, t) - grid.centre) * grid.scale;
}

GNOMON_WARNINGS_ON } // namespace gnomon

#endif

// motion/layers/layer_look_up.h ---------------------------------------------------------------------------------------
// Look-up in a layer's grid: the footprint of a receiver with its probes and mip level, the bias and the least variance
// that a layer needs, the filter across the motion, and blends with the neighbouring tile (Andersson et al. 2015, Sec.
// 4.2 and 5).
//
// A camera sample stands for the time t_r -+ 1/(2N), while which its world point is held in camera space. The light
// sees that point move: the ends of the footprint are its places at both times, each by the grid at its own time, so
// that what moves with the layer has a footprint of no length. The second axis is the pixel's own footprint. Probes are
// spread evenly along the longer axis, at most 16, and the mip level is that of the shorter.
//
//     ends = layer_footprint_make(grid, x0, y0, t0, x1, y1, t1, cross_x, cross_y, widening);
//     for k from 0 to ends.probes - 1: the mean of sums at layer_probe(ends, k) in level ends.level
//     bias = layer_bias(grid, slope_along, slope_across, t, reach, limit);
//     visibility by layer_visibility(sums, layer_grid_own_depth(grid, z - bias, t), layer_minimum_variance(grid, slope,
// least))
//
// Places (x, y) are in texels of the map from the tile's centre.
#ifndef GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H
#define GNOMON_MOTION_LAYERS_LAYER_LOOK_UP_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double layer_most_probes = 16.0;
inline constexpr double layer_uniform_variance = 0.083333333333333333; // 1/12, of a time between 0 and 1
inline constexpr double layer_tent_growth = 0.025;                     // half of 0.05 texels per texel of motion
inline constexpr double layer_tent_begin = 2.0;                        // texels of motion from which on the tent grows

/// Centre of a footprint, the vector from its one end to the other, the number of probes along that, and the mip level.
template <class Real, class = require_real<Real>>
struct layer_footprint { Real u, v, along_u, along_v, probes, level; };

/// The footprint of a world point that the light sees at (x0, y0) at time t0 and at (x1, y1) at time t1. (cross_x,
/// cross_y) is the second axis, the extent of a pixel on the map. Both ends are limited to the grid. The footprint is
/// at least `widening` texels of the map wide in either direction.
/// NaN: stays NaN in the place, with one probe; a NaN in the widths counts for nothing.
/// Source: Andersson 2015, Sec. 4.2
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_footprint<Real> layer_footprint_make(layer_grid<Real> grid, Real x0, Real y0, Real t0,
                                                                   Real x1, Real y1, Real t1, Real cross_x,
                                                                   Real cross_y, Real widening)
{
    Real last = grid.middle + grid.middle - Real(0.5); // the centre of the last texel
    layer_place p0 = layer_grid_place(grid, x0, y0, t0);
    layer_place p1 = layer_grid_place(grid, x1, y1, t1);
    p0.u = clamp_or_nan(p0.u, Real(0.5), last);
    p0.v = clamp_or_nan(p0.v, Real(0.5), last);
    p1.u = clamp_or_nan(p1.u, Real(0.5), last);
    p1.v = clamp_or_nan(p1.v, Real(0.5), last);
    Real time_u = p1.u - p0.u;
    Real time_v = p1.v - p0.v;
    layer_place second = layer_grid_turned(grid, cross_x, cross_y);
    Real cross_u = grid.scale_u * second.u;
    Real cross_v = grid.scale_v * second.v;
    Real time_length = gnomon_sqrt(time_u * time_u + time_v * time_v);
    Real cross_length = gnomon_sqrt(cross_u * cross_u + cross_v * cross_v);

    // The longer axis around the middle of the ends, limited to the grid.
    mask_t<Real> over_time = cross_length <= time_length;
    Real half_u = Real(0.5) * gnomon_select(over_time, time_u, cross_u);
    Real half_v = Real(0.5) * gnomon_select(over_time, time_v, cross_v);
    Real u = Real(0.5) * (p0.u + p1.u);
    Real v = Real(0.5) * (p0.v + p1.v);
    Real u0 = clamp_or_nan(u - half_u, Real(0.5), last);
    Real v0 = clamp_or_nan(v - half_v, Real(0.5), last);
    Real u1 = clamp_or_nan(u + half_u, Real(0.5), last);
    Real v1 = clamp_or_nan(v + half_v, Real(0.5), last);
    layer_footprint<Real> r;
    r.u = Real(0.5) * (u0 + u1);
    r.v = Real(0.5) * (v0 + v1);
    r.along_u = u1 - u0;
    r.along_v = v1 - v0;
    Real longer = gnomon_sqrt(r.along_u * r.along_u + r.along_v * r.along_v);
    Real shorter = gnomon_max(gnomon_min(cross_length, time_length), widening * grid.scale_v);
    Real width = gnomon_max(gnomon_max(Real(0.0625) * longer, shorter), Real(1)); // a NaN becomes 1
    width = gnomon_min(width, grid.middle + grid.middle);
    Real probes = Real(-1) * texel_below(Real(-1) * (longer / width)); // rounded up
    r.probes = gnomon_max(gnomon_min(probes, literal<Real>(layer_most_probes)), Real(1));
    r.level = Real(0);
    mask_t<Real> coarse = Real(1) < width;
    if (gnomon_any(coarse)) {
        r.level = gnomon_select(coarse, polynomial_log(width) * literal<Real>(exp_log2_e), Real(0));
    }
    return r;
}

/// The place of probe k, 0 to probes - 1.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_place<Real> layer_probe(layer_footprint<Real> footprint, Real k)
{
    Real share = (k + Real(0.5)) / footprint.probes - Real(0.5);
    layer_place<Real> r;
    r.u = footprint.u + share * footprint.along_u;
    r.v = footprint.v + share * footprint.along_v;
    return r;
}

/// The texels of the map by which a layer's places are off at time t, since its samples move unlike: the spread of
/// motion times |1/2 - t|.
/// NaN: NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_widening(layer_grid<Real> grid, Real t)
{
    return grid.spread * gnomon_abs(Real(0.5) - t);
}

/// The bias in [0, 2] to subtract from a receiver's depth at time t. slope_along and slope_across are the changes of
/// depth per texel of the map along the motion and across (layer_slope), or a bound on both. reach is the distance in
/// texels of the grid from a receiver to the farthest centre of a texel that its filter reads. What of the motion is
/// not the layer's adds to this: spread_z |1/2 - t| in depth, and spread |1/2 - t| texels along the slope. limit is the
/// largest bias of a slope.
/// Domain: any; reach, limit at least 0.
/// NaN: what is NaN counts for nothing.
/// Error: 8 2^-p of the result.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_bias(layer_grid<Real> grid, Real slope_along, Real slope_across, Real t,
                                        std::type_identity_t<Real> reach, std::type_identity_t<Real> limit)
{
    Real off = layer_widening(grid, t);
    depth_gradient<Real> gradient;
    gradient.x = slope_along;
    gradient.y = slope_across;
    Real rise = depth_bias_receiver_plane(gradient, reach / grid.scale_u + off, reach / grid.scale_v + off, limit);
    return depth_bias_limit(rise + depth_bias_limit(grid.spread_z * gnomon_abs(Real(0.5) - t)));
}

/// Slopes of depth along the motion of a layer and across, from its gradient along x and y of the map.
/// Error: 2 2^-p (|x| + |y|).
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr depth_gradient<Real> layer_slope(layer_grid<Real> grid, depth_gradient<Real> gradient)
{
    layer_place turned = layer_grid_turned(grid, gradient.x, gradient.y);
    depth_gradient<Real> r;
    r.x = turned.u;
    r.y = turned.v;
    return r;
}

/// The least variance of the layer's own depth, for layer_visibility: `least` of depth itself, and what the spread of
/// motion adds over the shutter interval, (spread_z^2 + (slope spread)^2) / 12. slope is the change of depth per texel
/// of the map.
/// Domain: least at least 0.
/// NaN: stays NaN.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_minimum_variance(layer_grid<Real> grid, Real slope, std::type_identity_t<Real> least)
{
    Real tilted = slope * grid.spread;
    Real moved = literal<Real>(layer_uniform_variance) * (grid.spread_z * grid.spread_z + tilted * tilted);
    return (least + moved) * (grid.scale * grid.scale);
}

/// Half the width of the filter across a layer's motion, in texels of its grid: of a tent of full width 0.05 (|d| - 2)
/// texels of the map, at least 0, but not wider than the guard band of (guard - tile) / 2 texels on either side.
/// NaN: 0.
/// Source: Andersson 2015, Sec. 5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_tent_radius(layer_grid<Real> grid, std::type_identity_t<Real> guard,
                                               std::type_identity_t<Real> tile)
{
    Real radius = literal<Real>(layer_tent_growth) * (grid.motion - literal<Real>(layer_tent_begin));
    Real band = Real(0.5) * (guard - tile);
    return gnomon_max(gnomon_min(radius, band) * grid.scale_v, Real(0));
}

/// The weight of a row of texels at a distance in texels under a tent of this radius, not normalised: 1 at distance 0.
/// Domain: any distance; radius at least 0. For a radius up to 1 all other rows have weight 0.
/// NaN: 0.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real layer_tent_weight(Real distance, std::type_identity_t<Real> radius)
{
    return saturate_or_zero(Real(1) - gnomon_abs(distance) / gnomon_max(Real(1), radius));
}

/// The neighbour of a tile along one axis, -1 or 1, and its weight, from 0 to 1/2.
template <class Real, class = require_real<Real>> struct layer_neighbour { Real towards, weight; };

/// The neighbour on the side of x, in texels of the map from the tile's centre. Its weight is 0 up to a third of the
/// way to the border, 1/2 at the border, and linear between. With weights w_x and w_y of both axes the four tiles have
/// (1 - w_x) (1 - w_y), w_x (1 - w_y), (1 - w_x) w_y and w_x w_y: a look-up in all of them by these weights has no
/// border; one chosen at random with these probabilities is the paper's.
/// Domain: tile > 0.
/// NaN: weight 0.
/// Source: Andersson 2015, Sec. 5
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr layer_neighbour<Real> layer_neighbour_at(Real x, std::type_identity_t<Real> tile)
{
    layer_neighbour<Real> r;
    r.towards = gnomon_select(x < Real(0), Real(-1), Real(1));
    r.weight = Real(0.5) * saturate_or_zero(Real(3) * (gnomon_abs(x) / tile) - Real(0.5));
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
