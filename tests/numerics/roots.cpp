// Roots of quadratics, and of cubics with three real roots, against Newton's method in 50 digits on the
// same rounded coefficients.
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/numerics/cubic.h>
#include <gnomon/numerics/quadratic.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// A number of either sign with magnitude between 2^-20 and 2^20, whose squares do not overflow.
double draw(bit_source& bits) { return (bits.chance(0.5) ? 1 : -1) * std::exp2(bits.uniform(-20, 20)); }

} // namespace

TEST_CASE_TEMPLATE("quadratic_roots are off by at most 4 ulp where a c <= b^2 / 2", T, float, double)
{
    bit_source bits(1);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const T a = T(draw(bits)), b = T(draw(bits)), c = T(draw(bits));
        const high square = high(b) * high(b) - high(a) * high(c);
        if (square < high(b) * high(b) / 2) continue; // cancellation, or complex
        const high root = sqrt(square);
        const high t = b > 0 ? high(-(high(b) + root)) : high(root - high(b));
        const std::array<high, 2> exact = {t / high(a), high(c) / t};
        const quadratic_result<T> r = quadratic_roots(a, b, c);
        worst = std::max({worst, ulps(r.first, exact[0]), ulps(r.second, exact[1])});
    }
    CHECK(worst <= 4);
    CHECK(worst > 0.5); // a root is rounded more than once, so the measure sees errors
    CHECK(quadratic_roots(T(1), T(2), T(5)).first == T(-2)); // complex: the common real part
    CHECK(quadratic_roots(T(0), T(1), T(3)).second == T(-1.5));
}

// The largest errors occur where b^2 is far below -a c, so that nothing damps the rounding of that product.
TEST_CASE_TEMPLATE("quadratic_roots at their worst are off by at most 4 ulp", T, float, double)
{
    const auto number = [](double p, int exponent) {
        const double x = std::exp2(exponent * (2 * std::abs(2 * p - 1) - 1));
        return T(p < 0.5 ? -x : x);
    };
    const auto error = [](T a, T b, T c) {
        using wide = std::conditional_t<std::is_same_v<T, float>, double, long double>;
        const wide A = wide(a), B = wide(b), C = wide(c), square = B * B - A * C;
        if (square < B * B / 2) return 0.0;
        const wide root = std::sqrt(square), t = b > 0 ? -(B + root) : root - B;
        const quadratic_result<T> r = quadratic_roots(a, b, c);
        return std::max(ulps(r.first, high(t / A)), ulps(r.second, high(C / t)));
    };
    const auto summits = std::array{climb(3, 60'000, 1,
                                          [&](const std::vector<double>& p) {
                                              return error(number(p[0], 20), number(p[1], 20), number(p[2], 20));
                                          }),
                                    climb(3, 60'000, 2, [&](const std::vector<double>& p) {
                                        return error(T(-1 - 3 * p[0]), number(p[1], 4), T(1 + 3 * p[2]));
                                    })};
    for (const summit& found : summits) {
        CHECK_MESSAGE(found.score <= 4, found.score);
        CHECK(found.score > 1);
    }
}

// The roots of the cubics of hamburger6.h: one positive, two negative. Rounding of a coefficient moves the root by
// about u (|t^3| + |b t^2| + |c t| + |d|) / |f'(t)|. Halley's iteration leaves a few times that, since its value of f
// has 4 to 6 roundings.
template <class T> double roundings_of_largest_root(double r, double m, double n)
{
    const T b = T(m + n - r), c = T(m * n - r * (m + n)), d = T(-r * m * n);
    const high B(b), C(c), D(d);
    high t = r;
    for (int k = 0; k < 12; ++k) t -= (((t + B) * t + C) * t + D) / ((3 * t + 2 * B) * t + C);
    const double conditioned =
        double((t * t * t + abs(B) * t * t + abs(C) * t + abs(D)) / abs((3 * t + 2 * B) * t + C));
    const double u = double(std::numeric_limits<T>::epsilon()) / 2;
    return double(abs(high(cubic_largest_root(b, c, d)) - t)) / (u * conditioned);
}

TEST_CASE_TEMPLATE("cubic_largest_root has its stated error where a climb finds the largest", T, float, double)
{
    const double farthest = std::numeric_limits<T>::digits > 24 ? 40 : 9;
    const summit top = climb(3, 100'000, 2, [&](const std::vector<double>& x) {
        const auto size = [&](double place) { return std::exp2(farthest * (place - 0.5)); };
        return roundings_of_largest_root<T>(size(x[0]), size(x[1]), size(x[2]));
    });
    std::printf("cubic_largest_root, %d digits: %.2f roundings of the value\n", std::numeric_limits<T>::digits,
                top.score);
    CHECK(top.score <= 8);
    CHECK(top.score > 0.5);
}

TEST_CASE_TEMPLATE("cubic_halley stays at a multiple root", T, float, double)
{
    CHECK(cubic_halley(T(-3), T(3), T(-1), T(1)) == T(1));
    CHECK(cubic_halley(T(0), T(0), T(0), T(0)) == T(0));
}
