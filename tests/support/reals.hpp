// The types that Real can be: scalars, packs of 2 to 16 lanes, and a scalar unknown to the library, for which it uses
// no fused multiply-add. Tests run one text for all of them.
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
// GCC bug 105593, in GCC's own AVX-512 intrinsics.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

#include <gnomon/portable.h>
#if __has_include(<xsimd/xsimd.hpp>)
#include <gnomon/simd/xsimd.hpp>
#endif

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>

namespace gnomon::test {

/// A number with the arithmetic of T and nothing else: kernels use their generic route and split exact products.
template <class T> struct plain {
    using value_type = T;
    T value;

    plain() = default;
    constexpr explicit plain(T v) : value(v) {}
    friend constexpr plain operator-(plain a) { return plain(-a.value); }
    friend constexpr plain operator+(plain a, plain b) { return plain(a.value + b.value); }
    friend constexpr plain operator-(plain a, plain b) { return plain(a.value - b.value); }
    friend constexpr plain operator*(plain a, plain b) { return plain(a.value * b.value); }
    friend constexpr plain operator/(plain a, plain b) { return plain(a.value / b.value); }
    friend constexpr bool operator<(plain a, plain b) { return a.value < b.value; }
    friend constexpr bool operator<=(plain a, plain b) { return a.value <= b.value; }
    friend constexpr bool operator>(plain a, plain b) { return a.value > b.value; }
    friend constexpr bool operator>=(plain a, plain b) { return a.value >= b.value; }
    friend constexpr bool operator==(plain a, plain b) { return a.value == b.value; }
    friend plain abs(plain a) { return plain(std::abs(a.value)); }
    friend plain sqrt(plain a) { return plain(std::sqrt(a.value)); }
};

#if defined(GNOMON_SIMD_XSIMD_HPP)
/// True if the target's default batch holds numbers of type T, which that of 32-bit NEON does not for double.
template <class T> inline constexpr bool has_batch = sizeof(typename xsimd::batch<T>::register_type) > sizeof(T);
#endif

template <class Real> inline constexpr bool is_plain = std::is_same_v<Real, plain<lane_t<Real>>>;

template <class Real> constexpr std::size_t lanes()
{
    if constexpr (requires { Real::size; }) return Real::size;
    else return 1;
}

template <class Real> Real load(const lane_t<Real>* p)
{
    if constexpr (requires { Real::load_unaligned(p); }) return Real::load_unaligned(p);
    else return Real(*p);
}

template <class Real> void store(const Real& x, lane_t<Real>* p)
{
    if constexpr (requires { x.store_unaligned(p); }) x.store_unaligned(p);
    else if constexpr (is_plain<Real>) *p = x.value;
    else *p = x;
}

template <class Real> std::string real_name()
{
    const std::string scalar = std::is_same_v<lane_t<Real>, float> ? "float" : "double";
    if constexpr (lanes<Real>() > 1) return std::to_string(lanes<Real>()) + " x " + scalar;
    else return is_plain<Real> ? "plain " + scalar : scalar;
}

#if defined(GNOMON_SIMD_XSIMD_HPP)
/// Calls f.template operator()<Real>() for T, the packs of T that this machine has, and plain<T>.
template <class T, class F> void for_each_real(F f)
{
    [[maybe_unused]] const auto pack = [&]<std::size_t size> {
        using batch = xsimd::make_sized_batch_t<T, size>;
        if constexpr (!std::is_void_v<batch>) f.template operator()<gnomon::pack<batch>>();
    };
    f.template operator()<T>();
#if !defined(__SANITIZE_ADDRESS__) // a sanitizer needs minutes to compile packs and finds the same in every Real
    f.template operator()<plain<T>>();
    pack.template operator()<2>();
    pack.template operator()<4>();
    pack.template operator()<8>();
    pack.template operator()<16>();
#endif
}
#endif

} // namespace gnomon::test
