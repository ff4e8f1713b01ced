// Units in which tests state the errors of a floating-point type.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace gnomon::test {

template <class T> inline constexpr bool is_float = std::is_same_v<T, float>;

/// The largest relative error of one rounding to T.
template <class T> inline constexpr double u = double(std::numeric_limits<T>::epsilon()) / 2;

/// The error of value in units in the last place of exact; the error itself if exact is 0.
template <class T, class Exact> double ulps(T value, const Exact& exact)
{
    using std::abs, std::ldexp;
    if (exact == 0) return double(std::abs(value));
    const int exponent = std::max(std::ilogb(double(exact)), std::numeric_limits<T>::min_exponent - 1);
    return double(ldexp(Exact(abs(Exact(value) - exact)), std::numeric_limits<T>::digits - 1 - exponent));
}

} // namespace gnomon::test
