// The largest errors of differences of products that a search finds. Built like exact.cpp, so also with contraction and
// without fused multiply-add.
#include "support/climber.hpp"
#include "support/reals.hpp"

#include <gnomon/numerics/two_product.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A type that holds sums of products of double words between 2^-20 and 2^20 exactly.
using exact =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;
using place = std::vector<double>;

template <class T> constexpr int digits = std::numeric_limits<T>::digits;
template <class T> const exact u = ldexp(exact(1), -digits<T>);
constexpr std::int64_t evaluations = 30'000;
template <class T> exact sum(const double_word<T>& x) { return exact(x.high) + exact(x.low); }

/// A number of either sign with magnitude between 2^-exponent and 2^exponent.
template <class T> T number(double p, int exponent)
{
    const double x = std::exp2(exponent * (2 * std::abs(2 * p - 1) - 1));
    return T(p < 0.5 ? -x : x);
}

/// x, or x with a relative change between 2^-p of T and 1, depending on p.
template <class T> T close_to(T x, double p)
{
    const double distance = 4 * std::abs(p - 0.5) - 1;
    return distance < 0 ? x : x + x * T((p < 0.5 ? -1 : 1) * std::exp2(-digits<T> * distance));
}

/// The error in units of scale; 0 if scale is 0.
double ratio(const exact& error, const exact& scale) { return scale == 0 ? 0 : double(exact(abs(error) / scale)); }

template <class F> void check_summit(double limit, std::size_t dimensions, std::int64_t count, F f)
{
    const summit found = climb(dimensions, count, 1, f);
    CHECK_MESSAGE(found.score <= limit, found.score);
    CHECK(found.score > limit / 16); // the measure sees errors
}

} // namespace

TEST_CASE_TEMPLATE("c - a b is off by at most 2 u^2 as a double word, 2 roundings as a number", T, float, double)
{
    struct terms {
        T c, a, b;
        exact product, difference, scale;
        explicit terms(const place& p) : a(number<T>(p[0], 10)), b(number<T>(p[1], 10)), product(exact(a) * exact(b))
        {
            c = p[3] < 0.3 ? number<T>(p[2], 20) : close_to(T(a * b), p[2]);
            difference = exact(c) - product;
            scale = abs(exact(c)) + abs(product);
        }
    };
    const exact square = u<T> * u<T>;
    check_summit(2, 4, evaluations, [&](const place& p) {
        const terms t(p);
        return ratio(sum(subtract_product(t.c, t.a, t.b)) - t.difference, square * t.scale);
    });
    check_summit(2, 4, evaluations, [&](const place& p) {
        const terms t(p);
        const exact error = sum(subtract_product_ordered(t.c, t.a, t.b)) - t.difference;
        return ratio(
            error, abs(exact(t.c)) >= abs(t.product) ? square * t.scale : u<T> * abs(t.product) / 2 + square * t.scale);
    });
    // 2 u and terms in u^2.
    check_summit(2 + 8 * double(u<T>), 4, evaluations, [&](const place& p) {
        const terms t(p);
        return ratio(exact(subtract_product_rounded(t.c, t.a, t.b)) - t.difference, u<T> * t.difference);
    });
}

TEST_CASE_TEMPLATE("two_difference_ordered out of order is off by at most a rounding of the larger operand", T, float,
                   double)
{
    check_summit(1 + 4 * double(u<T>), 2, evaluations, [&](const place& p) {
        const T b = number<T>(p[0], 1), a = T(b * T(2 * p[1] - 1));
        return ratio(sum(two_difference_ordered(a, b)) - (exact(a) - exact(b)), u<T> * exact(b));
    });
}

// Low words of up to 16 u of their high ones.
TEST_CASE_TEMPLATE("minors of double words are off by at most 2^8 u^2, determinants by two roundings more", T, float,
                   double)
{
    const exact square = u<T> * u<T>;
    const auto word = [](T high, double p) { return double_word<T>{high, T(high * T(16 * (2 * p - 1)) * T(u<T>))}; };
    check_summit(256, 8, evaluations, [&](const place& p) {
        const double_word<T> a = word(number<T>(p[0], 6), p[4]), b = word(number<T>(p[1], 6), p[5]);
        const double_word<T> d = word(number<T>(p[2], 6), p[7]);
        const double_word<T> c = word(close_to(T(a.high * b.high / d.high), p[3]), p[6]);
        const exact ab = sum(a) * sum(b), cd = sum(c) * sum(d);
        return ratio(sum(double_word_minor(a, b, c, d)) - (ab - cd), square * (abs(ab) + abs(cd)));
    });
    check_summit(1, 6, evaluations, [&](const place& p) {
        const double_word<T> a = word(number<T>(p[0], 6), p[3]), b = word(number<T>(p[1], 6), p[4]);
        const double_word<T> c = word(close_to(T(b.high * b.high / a.high), p[2]), p[5]);
        const exact ac = sum(a) * sum(c), bb = sum(b) * sum(b);
        return ratio(exact(double_word_determinant(a, b, c)) - (ac - bb),
                     2 * u<T> * abs(ac - bb) + 256 * square * (abs(ac) + bb));
    });
}

TEST_CASE_TEMPLATE("two_product below its domain is off by at most two of the smallest denormals", T, float, double)
{
    constexpr int domain = std::is_same_v<T, float> ? 100 : 900, range = std::is_same_v<T, float> ? 50 : 175;
    const exact least = std::numeric_limits<T>::denorm_min();
    const auto factors = [=](const place& p) {
        const double a = std::exp2(domain * p[0]) * (1 + p[1]), product = std::exp2(-domain - range * p[2]);
        return std::array{T(a), T(product / a)};
    };
    check_summit(0.5, 3, evaluations, [&](const place& p) {
        const auto [a, b] = factors(p);
        return is_fused<T> ? ratio(sum(two_product(a, b)) - exact(a) * exact(b), least) : 0.5;
    });
    check_summit(2, 3, evaluations, [&](const place& p) {
        const auto [a, b] = factors(p);
        const double_word<plain<T>> r = two_product(plain<T>(a), plain<T>(b));
        return ratio(exact(r.high.value) + exact(r.low.value) - exact(a) * exact(b), least);
    });
}
