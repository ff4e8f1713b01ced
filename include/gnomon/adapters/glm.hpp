// Conversion between GLM vectors and the library's structs of two to four equal numbers: moments4, variance_moments,
// exponential_variance_moments, ... Members keep their order: b1 is x. Kernels accept the structs only; GLM stays at
// the edge.
//
//     glm::vec4 v = gnomon::to_glm(gnomon::moments4_from_depth(0.5f));
//     auto b = gnomon::from_glm<gnomon::moments4<float>>(v);
#ifndef GNOMON_ADAPTERS_GLM_HPP
#define GNOMON_ADAPTERS_GLM_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <glm/glm.hpp>

#include <cstring>

GNOMON_NAMESPACE_BEGIN

template <template <class, class> class Struct, class T, class Check>
requires(std::is_floating_point_v<T> && sizeof(Struct<T, Check>) / sizeof(T) >= 2 &&
         sizeof(Struct<T, Check>) / sizeof(T) <= 4) auto to_glm(const Struct<T, Check>& s)
{
    glm::vec<int(sizeof(s) / sizeof(T)), T> v;
    static_assert(sizeof(v) == sizeof(s) && std::is_trivially_copyable_v<Struct<T, Check>>);
    std::memcpy(&v[0], &s, sizeof(s));
    return v;
}

template <class Struct, glm::length_t n, class T, glm::qualifier q> Struct from_glm(const glm::vec<n, T, q>& v)
{
    static_assert(sizeof(Struct) == n * sizeof(T) && std::is_trivially_copyable_v<Struct>,
                  "gnomon: from_glm takes a vector of as many numbers of the same type as the struct has");
    Struct s;
    std::memcpy(&s, &v[0], sizeof(s));
    return s;
}

GNOMON_NAMESPACE_END
#endif
