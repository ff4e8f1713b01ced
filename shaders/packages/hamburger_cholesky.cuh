// Gnomon 0.1.0, hamburger_cholesky.cuh: shadow filtering in CUDA and C++20, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
#ifndef GNOMON_HAMBURGER_CHOLESKY_CUH
#define GNOMON_HAMBURGER_CHOLESKY_CUH

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
#error "gnomon: hamburger_cholesky.cuh is CUDA and C++20; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: hamburger_cholesky.cuh and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != 100
#error "gnomon: hamburger_cholesky.cuh is not of the same version as a package before it"
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

// comparators/hamburger_cholesky.h ------------------------------------------------------------------------------------
// Algorithm 1 of Peters et al. 2017 as the paper states it, for four and for six moments. This is the comparator that
// hamburger4.h and hamburger6.h are measured against, not a route to use. Both kernels need biased moments (bias.h:
// moments4_add_bias, moments6_add_bias) and keep the steps of the paper:
//
//   1, 2  Solve B q = (1, z_f, ..., z_f^(m/2)) by the square-root-free Cholesky decomposition B = L D L^T (Sec. 5.4.1).
//   3     Solve q_0 + q_1 z + ... = 0 for the other depths: a quadratic, or a cubic in closed form (Blinn 2007;
//         Sec. 5.4.1).
//   4, 5  The weights solve a Vandermonde system. The sum of those before z_f is E[u(z)], where the polynomial u is 1
//         at the depths before z_f and 0 at z_f and behind (Sec. 5.4.2).
//
// Only totality is added: singular moments, such as those of a single depth, give 0, lit, even in shadow.
#ifndef GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H
#define GNOMON_COMPARATORS_HAMBURGER_CHOLESKY_H

GNOMON_WARNINGS_OFF namespace gnomon {

inline constexpr double hamburger_cholesky_third = 0.33333333333333333;
inline constexpr double hamburger_cholesky_sqrt3 = 1.7320508075688773;
inline constexpr double hamburger_cholesky_epsilon = 1e-3;

/// The two depths other than z_f, z1 <= z2.
template <class Real, class = require_real<Real>> struct quadratic_nodes { Real z1, z2; };

/// The two depths of the distribution of three that has one at z_f and four biased moments.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr quadratic_nodes<Real> hamburger4_cholesky_nodes(moments4<Real> b, Real z_f)
{
    // Factor B = L D L^T.
    Real inverse1 = Real(1) / (b.b2 - b.b1 * b.b1);
    Real c12 = b.b3 - b.b1 * b.b2;
    Real l21 = c12 * inverse1;
    Real d2 = (b.b4 - b.b2 * b.b2) - l21 * c12;

    // Forward substitution, L y = (1, z_f, z_f^2), scaling by D, and back substitution, L^T q = D^-1 y.
    Real y1 = z_f - b.b1;
    Real q2 = ((z_f * z_f - b.b2) - l21 * y1) / d2;
    Real q1 = y1 * inverse1 - l21 * q2;
    Real q0 = Real(1) - (q1 * b.b1 + q2 * b.b2);

    // Solve the quadratic q_0 + q_1 z + q_2 z^2 = 0 for the other two depths.
    Real inverse_q2 = Real(1) / q2;
    Real centre = Real(-0.5) * (q1 * inverse_q2);
    Real r = gnomon_sqrt(centre * centre - q0 * inverse_q2);
    quadratic_nodes<Real> n;
    n.z1 = centre - r;
    n.z2 = centre + r;
    return n;
}

/// The weight of depth node beside the depths other and last: E[(z - other) (z - last)] / ((node - other) (node -
/// last)), by Cramer's rule.
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger4_cholesky_weight(moments4<Real> b, Real node, Real other, Real last)
{
    return (b.b2 - b.b1 * (other + last) + other * last) / ((node - other) * (node - last));
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from four biased moments. Takes four divisions and one root.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger4_cholesky_intensity(moments4<Real> b, Real z_f)
{
    quadratic_nodes n = hamburger4_cholesky_nodes(b, z_f);
    // Two depths before z_f: 1 minus the weight of z_f. One: its weight.
    mask_t<Real> both = n.z2 < z_f;
    Real node = gnomon_select(both, z_f, n.z1);
    Real other = gnomon_select(both, n.z1, z_f);
    Real w = hamburger4_cholesky_weight(b, node, other, n.z2);
    return saturate_or_zero(gnomon_select(both, Real(1) - w, gnomon_select(n.z1 < z_f, w, Real(0))));
}

/// Mean blocker depth in [-1, z_f] from four biased moments: that of the depths before z_f and, with a weight of 1e-3,
/// of z_f itself.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: z_f; a z_f of NaN is the far plane.
/// Source: Peters 2017, Eq. 4; Peters 2017, Alg. 1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger4_cholesky_blocker(moments4<Real> b, Real z_f)
{
    Real z = clamp_or_high(z_f, Real(-1), Real(1));
    quadratic_nodes n = hamburger4_cholesky_nodes(b, z);
    Real w1 = gnomon_select(n.z1 < z, hamburger4_cholesky_weight(b, n.z1, z, n.z2), Real(0));
    Real w2 = gnomon_select(n.z2 < z, hamburger4_cholesky_weight(b, n.z2, n.z1, z), Real(0));
    Real epsilon = literal<Real>(hamburger_cholesky_epsilon);
    Real depth = (epsilon * z + (w1 * n.z1 + w2 * n.z2)) / (epsilon + (w1 + w2));
    return gnomon_select(depth == depth, gnomon_min(z, gnomon_max(Real(-1), depth)), z);
}

/// The three real roots of a cubic, in no particular order.
template <class Real, class = require_real<Real>> struct cubic_roots { Real z1, z2, z3; };

/// The three real roots of z^3 + c2 z^2 + c1 z + c0, by one branch of Blinn's algorithm, as the paper advises.
/// NaN: also if two roots are complex.
/// Source: Blinn 2007; Peters 2017, Sec. 5.4.1
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr cubic_roots<Real> cubic_roots_blinn(Real c2, Real c1, Real c0)
{
    Real b = c2 * literal<Real>(hamburger_cholesky_third);
    Real c = c1 * literal<Real>(hamburger_cholesky_third);
    Real hessian1 = c - b * b;
    Real hessian2 = c0 - b * c;
    Real hessian3 = b * c0 - c * c;
    Real discriminant = Real(4) * hessian1 * hessian3 - hessian2 * hessian2;
    // The depressed cubic is x^3 + 3 hessian1 x + d with x = z + b.
    Real d = hessian2 - Real(2) * b * hessian1;
    Real angle = polynomial_atan2(gnomon_sqrt(discriminant), Real(-1) * d);
    cosine_sine t = polynomial_cosine_sine(angle * literal<Real>(hamburger_cholesky_third));
    Real radius = gnomon_sqrt(Real(-1) * hessian1);
    Real half_cosine = radius * t.cosine;
    Real half_sine = radius * t.sine * literal<Real>(hamburger_cholesky_sqrt3);
    cubic_roots<Real> roots;
    roots.z1 = Real(2) * half_cosine - b;
    roots.z2 = (half_sine - half_cosine) - b;
    roots.z3 = Real(-1) * (half_sine + half_cosine) - b;
    return roots;
}

/// Lower bound on the shadow intensity at z_f, in [0, 1], from six biased moments. Takes eleven divisions, two roots,
/// an arc tangent, a cosine and a sine.
/// Domain: the Hankel matrix is positive definite in the precision of Real; else the result is not accurate.
/// NaN: 0, lit.
/// Source: Peters 2017, Alg. 1; Peters 2017, Sec. 5.4
template <class Real, class = require_real<Real>>
GNOMON_INLINE constexpr Real hamburger6_cholesky_intensity(moments6<Real> b, Real z_f)
{
    // Factor B = L D L^T.
    Real inverse1 = Real(1) / (b.b2 - b.b1 * b.b1);
    Real c12 = b.b3 - b.b1 * b.b2;
    Real c13 = b.b4 - b.b1 * b.b3;
    Real l21 = c12 * inverse1;
    Real l31 = c13 * inverse1;
    Real inverse2 = Real(1) / ((b.b4 - b.b2 * b.b2) - l21 * c12);
    Real c23 = (b.b5 - b.b2 * b.b3) - l21 * c13;
    Real l32 = c23 * inverse2;
    Real d3 = ((b.b6 - b.b3 * b.b3) - l31 * c13) - l32 * c23;

    // Forward substitution, L y = (1, z_f, z_f^2, z_f^3).
    Real z_f2 = z_f * z_f;
    Real y1 = z_f - b.b1;
    Real y2 = (z_f2 - b.b2) - l21 * y1;
    Real y3 = ((z_f2 * z_f - b.b3) - l31 * y1) - l32 * y2;
    // Scaling by D and back substitution, L^T q = D^-1 y.
    Real q3 = y3 / d3;
    Real q2 = y2 * inverse2 - l32 * q3;
    Real q1 = y1 * inverse1 - (l21 * q2 + l31 * q3);
    Real q0 = Real(1) - (q1 * b.b1 + q2 * b.b2 + q3 * b.b3);

    // Solve the cubic q_0 + q_1 z + q_2 z^2 + q_3 z^3 = 0 for the other three depths.
    Real inverse_q3 = Real(1) / q3;
    cubic_roots z = cubic_roots_blinn(q2 * inverse_q3, q1 * inverse_q3, q0 * inverse_q3);

    // The Newton form of u by divided differences.
    Real v1 = gnomon_select(z.z1 < z_f, Real(1), Real(0));
    Real v2 = gnomon_select(z.z2 < z_f, Real(1), Real(0));
    Real v3 = gnomon_select(z.z3 < z_f, Real(1), Real(0));
    Real v01 = v1 / (z.z1 - z_f);
    Real v12 = (v2 - v1) / (z.z2 - z.z1);
    Real v23 = (v3 - v2) / (z.z3 - z.z2);
    Real v012 = (v12 - v01) / (z.z2 - z_f);
    Real v123 = (v23 - v12) / (z.z3 - z.z1);
    Real v0123 = (v123 - v012) / (z.z3 - z_f);
    // The coefficients of u = (z - z_f) (v01 + (z - z1) (v012 + (z - z2) v0123)), multiplied out from the
    // inside, and E[u(z)].
    Real s0 = v012 - v0123 * z.z2;
    Real t1 = s0 - v0123 * z.z1;
    Real t0 = v01 - s0 * z.z1;
    Real u2 = t1 - v0123 * z_f;
    Real u1 = t0 - t1 * z_f;
    return saturate_or_zero(((v0123 * b.b3 + u2 * b.b2) + u1 * b.b1) - t0 * z_f);
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
