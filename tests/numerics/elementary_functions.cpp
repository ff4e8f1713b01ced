// The stated errors of the elementary functions: float against double from the C library over evenly spaced bit
// patterns of the whole range, double against Boost.Multiprecision at log-uniform arguments, and packs against scalars.

#include "support/effort.hpp"
#include "support/kernel_call.hpp"
#include "support/rounding.hpp"

#include <gnomon/numerics/exp.h>
#include <gnomon/numerics/trigonometry.h>
#include <gnomon/simd/xsimd.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;
using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

namespace {

/// A type with enough digits to be the reference for T.
template <class T> using reference = std::conditional_t<std::is_same_v<T, float>, double, high>;

template <class T> double ulp(double value)
{
    const T a = std::abs(T(value));
    return double(std::nextafter(a, std::numeric_limits<T>::infinity())) - double(a);
}

struct row {
    double error = 0; ///< in the unit of add()
    double where = 0;
    void add(double e, double x)
    {
        if (!(e <= error)) error = e, where = x;
    }
};

/// Calls f with arguments of both signs and all magnitudes in [low, high_end].
template <class T, class F> void sweep(T low, T high_end, F f)
{
    using bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const bits first = std::bit_cast<bits>(low);
    const bits last = std::bit_cast<bits>(high_end);
    const bits step = (last - first) / bits(test::effort(sizeof(T) == 4 ? 2'000'000 : 4'000)) + 1;
    for (bits b = first; b <= last; b += step) {
        f(std::bit_cast<T>(b));
        f(-std::bit_cast<T>(b));
    }
    f(high_end);
    f(-high_end);
}

template <class T, class Kernel, class Reference>
void check_ulp(double limit, T low, T high_end, Kernel kernel, Reference exact)
{
    row worst;
    sweep(low, high_end, [&](T x) {
        const reference<T> r = exact(reference<T>(x));
        if (r == 0) return;
        worst.add(double(abs(reference<T>(kernel(x)) - r)) / ulp<T>(double(r)), double(x));
    });
    CHECK_MESSAGE(worst.error <= limit, worst.error << " ulp at " << worst.where);
}

} // namespace

TEST_CASE_TEMPLATE("exp is off by at most 1 ulp in float, 1.2 ulp in double, and clamped beyond its domain", T, float,
                   double)
{
    using std::exp;
    const auto exact = [](reference<T> x) { return reference<T>(exp(x)); };
    const auto kernel = [](T x) { return polynomial_exp(x); };
    check_ulp(is_float<T> ? 1 : 1.2, T(1e-9), is_float<T> ? T(87) : T(708), kernel, exact);
    CHECK(polynomial_exp(T(0)) == T(1));
    CHECK(polynomial_exp(T(1e9)) == polynomial_exp(is_float<T> ? T(88) : T(709)));
    CHECK(polynomial_exp(T(-1e9)) == polynomial_exp(is_float<T> ? T(-87) : T(-708)));
    CHECK(polynomial_exp(std::numeric_limits<T>::infinity()) < std::numeric_limits<T>::infinity());
    CHECK(polynomial_exp(-std::numeric_limits<T>::infinity()) >= std::numeric_limits<T>::min());
}

TEST_CASE_TEMPLATE("log is off by at most 0.9 ulp, and clamped beyond its domain", T, float, double)
{
    using std::log;
    const auto exact = [](reference<T> x) { return reference<T>(log(abs(x))); };
    const auto kernel = [](T x) { return polynomial_log(std::abs(x)); };
    const T low = std::numeric_limits<T>::min();
    const T high_end = std::numeric_limits<T>::max() / T(2);
    check_ulp(0.9, low, std::nextafter(T(1), T(0)), kernel, exact);
    check_ulp(0.9, T(0.5), T(2), kernel, exact);
    check_ulp(0.9, T(2), high_end, kernel, exact);
    CHECK(polynomial_log(T(1)) == T(0));
    CHECK(polynomial_log(T(-1)) == polynomial_log(low));
    CHECK(polynomial_log(std::numeric_limits<T>::infinity()) < T(720));
}

TEST_CASE_TEMPLATE("cos and sin are off by at most 1.5 ulp near 0, 1.75 2^-p beyond", T, float, double)
{
    using std::cos;
    using std::sin;
    const T quarter = T(0.785398);
    const auto cosine = [](reference<T> x) { return reference<T>(cos(x)); };
    const auto sine = [](reference<T> x) { return reference<T>(sin(x)); };
    check_ulp(
        1.5, T(1e-30), quarter, [](T x) { return polynomial_cos(x); }, cosine);
    check_ulp(
        1.5, T(1e-30), quarter, [](T x) { return polynomial_sin(x); }, sine);
    row worst;
    sweep(quarter, T(8192), [&](T x) {
        const cosine_sine<T> r = polynomial_cosine_sine(x);
        worst.add(double(abs(reference<T>(r.cosine) - cosine(reference<T>(x)))), double(x));
        worst.add(double(abs(reference<T>(r.sine) - sine(reference<T>(x)))), double(x));
    });
    const double u = std::ldexp(1.0, -std::numeric_limits<T>::digits);
    CHECK_MESSAGE(worst.error <= 1.75 * u, (worst.error / u) << " 2^-p at " << worst.where);
    CHECK(polynomial_cos(T(1e9)) == polynomial_cos(T(8192)));
}

TEST_CASE_TEMPLATE("atan2 is off by at most 2.6 ulp in every direction", T, float, double)
{
    using std::atan2;
    row worst;
    sweep(T(1e-30), T(1e30), [&](T q) {
        for (const T x : std::array{T(1), T(-1), T(0.7), T(-1e7)}) {
            const T y = q;
            const reference<T> r = atan2(reference<T>(y), reference<T>(x));
            const double e = double(abs(reference<T>(polynomial_atan2(y, x)) - r)) / ulp<T>(double(r));
            worst.add(e, double(q / x));
        }
    });
    CHECK_MESSAGE(worst.error <= 2.6, worst.error << " ulp at y / x = " << worst.where);
    const T infinity = std::numeric_limits<T>::infinity();
    const T pi = T(3.14159265358979324);
    CHECK(polynomial_atan2(T(0), T(0)) == T(0));
    CHECK(polynomial_atan2(T(0), T(-1)) == pi);
    CHECK(polynomial_atan2(T(1), T(0)) == pi / 2);
    CHECK(polynomial_atan2(T(-1), T(0)) == -pi / 2);
    CHECK(polynomial_atan2(infinity, T(1)) == pi / 2);
    CHECK(polynomial_atan2(T(1), -infinity) == pi);
}

namespace {

/// A pack that the library does not know: two lanes, no pack_operations.
template <class T> struct pair_pack {
    using value_type = T;
    T lanes[2];
    pair_pack() = default;
    explicit pair_pack(T a) : lanes{a, a} {}
    pair_pack(T a, T b) : lanes{a, b} {}
    friend pair_pack operator-(pair_pack a) { return {-a.lanes[0], -a.lanes[1]}; }
    friend pair_pack operator+(pair_pack a, pair_pack b) { return {a.lanes[0] + b.lanes[0], a.lanes[1] + b.lanes[1]}; }
    friend pair_pack operator-(pair_pack a, pair_pack b) { return {a.lanes[0] - b.lanes[0], a.lanes[1] - b.lanes[1]}; }
    friend pair_pack operator*(pair_pack a, pair_pack b) { return {a.lanes[0] * b.lanes[0], a.lanes[1] * b.lanes[1]}; }
    friend pair_pack operator/(pair_pack a, pair_pack b) { return {a.lanes[0] / b.lanes[0], a.lanes[1] / b.lanes[1]}; }
    struct mask {
        bool lanes[2];
    };
    friend mask operator<(pair_pack a, pair_pack b) { return {{a.lanes[0] < b.lanes[0], a.lanes[1] < b.lanes[1]}}; }
    friend mask operator<=(pair_pack a, pair_pack b) { return {{a.lanes[0] <= b.lanes[0], a.lanes[1] <= b.lanes[1]}}; }
    friend mask operator==(pair_pack a, pair_pack b) { return {{a.lanes[0] == b.lanes[0], a.lanes[1] == b.lanes[1]}}; }
    friend pair_pack select(mask m, pair_pack a, pair_pack b)
    {
        return {m.lanes[0] ? a.lanes[0] : b.lanes[0], m.lanes[1] ? a.lanes[1] : b.lanes[1]};
    }
    friend pair_pack abs(pair_pack a) { return {std::abs(a.lanes[0]), std::abs(a.lanes[1])}; }
    friend pair_pack sqrt(pair_pack a) { return {std::sqrt(a.lanes[0]), std::sqrt(a.lanes[1])}; }
    static pair_pack load_unaligned(const T* p) { return {p[0], p[1]}; }
    void store_unaligned(T* p) const { p[0] = lanes[0], p[1] = lanes[1]; }
    static constexpr std::size_t size = 2;
};

template <class Real> std::array<Real, 5> all_functions(Real x, Real y)
{
    const cosine_sine<Real> r = polynomial_cosine_sine(x);
    return {polynomial_exp(x), polynomial_log(x), r.cosine, r.sine, polynomial_atan2(y, x)};
}

/// Fails the test case with the arguments. doctest's own macros are slow in a loop of millions.
void demand(bool holds, double x, double y)
{
    if (!holds) FAIL("at x = " << x << ", y = " << y);
}

} // namespace

TEST_CASE_TEMPLATE("for any bit pattern, results are NaN only as stated, and packs equal scalars", Pack,
                   pair_pack<float>, pair_pack<double>, xsimd::batch<float>, xsimd::batch<double>,
                   xsimd::make_sized_batch_t<float, 4>, xsimd::make_sized_batch_t<double, 2>)
{
    using T = typename Pack::value_type;
    using bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    std::mt19937_64 random(7);
    const T infinity = std::numeric_limits<T>::infinity();
    const std::int64_t rounds = test::effort(1'000'000) / std::int64_t(Pack::size);
    for (std::int64_t i = 0; i < rounds; ++i) {
        std::array<T, Pack::size> x, y, out;
        for (std::size_t k = 0; k < Pack::size; ++k) {
            x[k] = i % 2 ? std::bit_cast<T>(bits(random()))
                         : T(std::ldexp(double(std::int64_t(random())), int(random() % 80) - 120));
            y[k] = std::bit_cast<T>(bits(random()));
        }
        if (i == 0) x[0] = infinity, x[1] = -infinity;
        if (i == 1) x[0] = std::numeric_limits<T>::quiet_NaN(), x[1] = T(0);
        const auto packed = all_functions(Pack::load_unaligned(x.data()), Pack::load_unaligned(y.data()));
        std::array<std::array<T, 5>, Pack::size> scalar;
        for (std::size_t k = 0; k < Pack::size; ++k) {
            scalar[k] = all_functions(x[k], y[k]);
            for (std::size_t f = 0; f < 4; ++f) {
                demand(std::isnan(scalar[k][f]) == std::isnan(x[k]), double(x[k]), double(y[k]));
                demand(!std::isinf(scalar[k][f]), double(x[k]), double(y[k]));
            }
            const bool two_infinities = std::isinf(x[k]) && std::isinf(y[k]);
            if (!two_infinities && std::isfinite(std::abs(x[k]) + std::abs(y[k])))
                demand(std::abs(scalar[k][4]) <= T(3.14159265358979324), double(x[k]), double(y[k]));
            if (std::isnan(x[k]) || std::isnan(y[k]) || two_infinities)
                demand(std::isnan(scalar[k][4]), double(x[k]), double(y[k]));
        }
        for (std::size_t f = 0; f < 5; ++f) {
            packed[f].store_unaligned(out.data());
            for (std::size_t k = 0; k < Pack::size; ++k) demand(same(out[k], scalar[k][f]), double(x[k]), double(y[k]));
        }
    }
}
