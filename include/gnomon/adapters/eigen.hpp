// Conversion between Eigen vectors and the library's structs of equal numbers: moments4, moments6, variance_moments,
// ... Members keep their order: b1 is the first coefficient. An Eigen array is no Real, by design; from_eigen evaluates
// an expression before any kernel sees it.
//
//     Eigen::Vector4d v = gnomon::to_eigen(gnomon::moments4_from_depth(0.5));
//     auto b = gnomon::from_eigen<gnomon::moments4<double>>(0.5 * (v + w));
#ifndef GNOMON_ADAPTERS_EIGEN_HPP
#define GNOMON_ADAPTERS_EIGEN_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <Eigen/Core>

#include <cstring>

GNOMON_NAMESPACE_BEGIN

template <template <class, class> class Struct, class T, class Check>
requires std::is_floating_point_v<T>
auto to_eigen(const Struct<T, Check>& s)
{
    static_assert(sizeof(s) % sizeof(T) == 0 && std::is_trivially_copyable_v<Struct<T, Check>>);
    Eigen::Matrix<T, int(sizeof(s) / sizeof(T)), 1> v;
    std::memcpy(v.data(), &s, sizeof(s));
    return v;
}

template <class Struct, class Derived> Struct from_eigen(const Eigen::MatrixBase<Derived>& expression)
{
    using T = typename Derived::Scalar;
    static_assert(Derived::IsVectorAtCompileTime &&
                      sizeof(Struct) == std::size_t(Derived::SizeAtCompileTime) * sizeof(T) &&
                      std::is_trivially_copyable_v<Struct>,
                  "gnomon: from_eigen takes a vector of as many numbers of the same type as the struct has");
    const Eigen::Matrix<T, int(Derived::SizeAtCompileTime), 1> v = expression;
    Struct s;
    std::memcpy(&s, v.data(), sizeof(s));
    return s;
}

GNOMON_NAMESPACE_END
#endif
