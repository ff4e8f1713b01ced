// GLM and Eigen vectors keep the order of a struct's members, both ways.

#include <gnomon/adapters/eigen.hpp>
#include <gnomon/adapters/glm.hpp>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/moments/moments.h>

#include <doctest/doctest.h>

using namespace gnomon;

TEST_CASE_TEMPLATE("glm: vec4 is moments4, vec2 is variance_moments", T, float, double)
{
    const moments4<T> b = moments4_from_depth(T(-0.5));
    const glm::vec<4, T> v = to_glm(b);
    CHECK(v == glm::vec<4, T>(-0.5, 0.25, -0.125, 0.0625));
    const moments4<T> halfway = from_glm<moments4<T>>(T(0.5) * (v + glm::vec<4, T>(1)));
    CHECK(halfway.b1 == T(0.25));
    CHECK(halfway.b2 == T(0.625));
    CHECK(halfway.b3 == T(0.4375));
    CHECK(halfway.b4 == T(0.53125));
    CHECK(to_glm(variance_encode(T(0.5))) == glm::vec<2, T>(0.5, 0.25));
    const auto warped = from_glm<exponential_variance_moments<T>>(glm::vec<4, T>(1, 2, 3, 4));
    CHECK(warped.positive_square == T(2));
    CHECK(warped.negative == T(3));
}

TEST_CASE_TEMPLATE("eigen: vectors of four and six, and expressions of them", T, float, double)
{
    const Eigen::Matrix<T, 4, 1> v = to_eigen(moments4_from_depth(T(-0.5)));
    CHECK(v == Eigen::Matrix<T, 4, 1>(T(-0.5), T(0.25), T(-0.125), T(0.0625)));
    const moments6<T> zero{0, 0, 0, 0, 0, 0};
    const moments6<T> b = from_eigen<moments6<T>>(T(0.5) * (to_eigen(zero) + to_eigen(moments6_from_depth(T(-1)))));
    CHECK(b.b1 == T(-0.5));
    CHECK(b.b2 == T(0.5));
    CHECK(b.b5 == T(-0.5));
    CHECK(b.b6 == T(0.5));
    CHECK(from_eigen<moments4<T>>(v.transpose()).b4 == T(0.0625));
}
