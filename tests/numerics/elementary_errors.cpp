// The largest errors of the elementary functions that a search finds. Uniform samples miss them by a tenth of an ulp.
// The reference is long double, with 11 bits more than double, or double for float.
#include "support/climber.hpp"
#include "support/rounding.hpp"

#include <gnomon/numerics/exp.h>
#include <gnomon/numerics/trigonometry.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

using namespace gnomon;
using namespace gnomon::test;
using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

namespace {

template <class T> using reference = std::conditional_t<std::is_same_v<T, float>, double, long double>;
constexpr double pi = 3.14159265358979324;

/// Checks the largest error(x) that a climb over x = arguments(p), p in [0, 1], finds.
template <class T, class Arguments, class Error>
void check_summit(double limit, std::int64_t evaluations, Arguments arguments, Error error)
{
    const summit found =
        climb(1, evaluations, 1, [&](const std::vector<double>& p) { return error(T(arguments(p[0]))); });
    CHECK_MESSAGE(found.score <= limit, found.score << " at " << arguments(found.place[0]));
    CHECK(found.score > limit / 4); // the measure sees errors
}

constexpr std::int64_t evaluations = 300'000;

} // namespace

TEST_CASE_TEMPLATE("exp is off by at most 1 ulp in float, 1.2 ulp in double", T, float, double)
{
    const auto error = [](T x) { return ulps(polynomial_exp(x), std::exp(reference<T>(x))); };
    const double limit = is_float<T> ? 1 : 1.2;
    const double low = is_float<T> ? -87 : -708, high_end = is_float<T> ? 88 : 709;
    check_summit<T>(
        limit, evaluations, [=](double p) { return low + p * (high_end - low); }, error);
    // Far from 0, where subtracting n ln 2 rounds most: r = p ln 2 / 2 for the last n.
    const double last = is_float<T> ? 126 : 1022;
    check_summit<T>(
        limit, evaluations, [=](double p) { return (last - 15 + std::floor(16 * p) - p) * std::log(2); }, error);
    CHECK(error(is_float<T> ? T(5.85190201) : T(698.73698896)) <= limit);
}

TEST_CASE_TEMPLATE("log is off by at most 0.9 ulp", T, float, double)
{
    const auto error = [](T x) { return ulps(polynomial_log(x), std::log(reference<T>(x))); };
    const int low = std::numeric_limits<T>::min_exponent - 1;
    const auto any = [=](double p) { return std::exp2(low + p * (1 - 2.0 * low)); };
    check_summit<T>(0.9, evaluations, any, error);
    check_summit<T>(
        0.9, evaluations, [](double p) { return 0.5 + p; }, error);
    CHECK(error(T(1.41331851)) <= 0.9);
}

TEST_CASE_TEMPLATE("cos and sin are off by at most 1.5 ulp near 0, 1.75 2^-p beyond", T, float, double)
{
    using std::cos, std::sin;
    using R = reference<T>;
    const auto near = [](double p) { return p * pi / 4; };
    check_summit<T>(1.5, evaluations, near, [](T x) { return ulps(polynomial_cos(x), cos(R(x))); });
    check_summit<T>(1.5, evaluations, near, [](T x) { return ulps(polynomial_sin(x), sin(R(x))); });
    const auto error = [](T x) {
        const cosine_sine<T> r = polynomial_cosine_sine(x);
        return double(std::max(std::abs(R(r.cosine) - cos(R(x))), std::abs(R(r.sine) - sin(R(x))))) / u<T>;
    };
    check_summit<T>(
        1.75, evaluations, [](double p) { return pi / 4 + p * (8192 - pi / 4); }, error);
    CHECK(error(T(2100.9021)) <= 1.75);
}

TEST_CASE_TEMPLATE("atan2 is off by at most 2.6 ulp in every direction, for any length", T, float, double)
{
    const auto error = [](T y, T x) {
        return ulps(polynomial_atan2(y, x), std::atan2(reference<T>(y), reference<T>(x)));
    };
    const int exponent = std::numeric_limits<T>::max_exponent - 2;
    const std::array summits = {
        climb(3, evaluations, 1,
              [&](const auto& p) {
                  const double length = std::exp2(exponent * (2 * p[2] - 1)) * (1 + p[1]);
                  return error(T(length * std::sin(2 * pi * p[0])), T(length * std::cos(2 * pi * p[0])));
              }),
        // Quotients of all magnitudes, and denormal results.
        climb(3, evaluations, 2,
              [&](const auto& p) { return error(T(std::exp2(exponent * (p[0] - 1))), T(p[1] - 0.5) * T(1 + p[2])); }),
        // Arguments near the switch to another reduction.
        climb(2, evaluations, 3,
              [&](const auto& p) { return error(T((0.4 + 0.03 * p[0]) * (1 + p[1])), T(1 + p[1])); }),
    };
    for (const summit& found : summits) {
        CHECK_MESSAGE(found.score <= 2.6, found.score << " at " << found.place[0] << ", " << found.place[1]);
        CHECK(found.score > 0.6);
    }
    CHECK(error(T(0.358493656), T(0.863332748)) <= 2.6); // 2.79 ulp in float with pi / 4 as a single number
}

TEST_CASE("nearest_integer equals nearbyint over the domain in float, and at ties and ends in double")
{
    const std::uint32_t end = std::bit_cast<std::uint32_t>(0x1p22F);
    const std::uint32_t step = end / std::uint32_t(effort(2'000'000)) + 1;
    bool equal = true;
    for (std::uint32_t b = 0; b <= end; b += step) {
        const float x = std::bit_cast<float>(b);
        equal = equal && nearest_integer(x) == std::nearbyint(x) && nearest_integer(-x) == -std::nearbyint(x);
    }
    CHECK(equal);
    CHECK(nearest_integer(0x1p22F) == 0x1p22F);
    for (const double x : {0.5, 1.5, 0x1p51 - 0.5, 0x1p51 - 1.5, 0x1p51})
        CHECK((nearest_integer(x) == std::nearbyint(x) && nearest_integer(-x) == -std::nearbyint(x)));
}

namespace {

/// The base-2 logarithm of the largest relative error of an approximation of exact(x) over [low, high_end].
template <class Approximation, class Exact>
double log2_error(double low, double high_end, Approximation approximation, Exact exact)
{
    const std::int64_t steps = 400;
    high worst = 0;
    for (std::int64_t i = 0; i <= steps; ++i) {
        const high x = low + (high_end - low) * (0.5 - 0.5 * std::cos(pi * double(i) / double(steps)));
        if (abs(x) < high(1e-3)) continue;
        const high e = exact(x);
        worst = std::max(worst, high(abs(approximation(x) / e - 1)));
    }
    return double(log2(worst));
}

high polynomial(std::span<const double> coefficients, const high& x)
{
    high p = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) p = p * x + coefficients[i];
    return p;
}

} // namespace

TEST_CASE("polynomials with rounded coefficients have the errors that their comments state")
{
    const auto check = [](double stated, double low, double high_end, std::initializer_list<double> list, auto make,
                          auto exact) {
        std::vector<double> c(list);
        if (stated > -40) std::transform(c.begin(), c.end(), c.begin(), [](double x) { return double(float(x)); });
        const double found = log2_error(
            low, high_end, [&](const high& x) { return make(x, c); }, exact);
        CHECK_MESSAGE(std::abs(found - stated) < 0.1, found << " for " << stated);
    };
    const auto exp_of = [](const high& x, const auto& c) { return high(1 + x + x * x * polynomial(c, x)); };
    const auto odd_of = [](const high& x, const auto& c) { return high(x + x * x * x * polynomial(c, x * x)); };
    const auto twice_of = [](const high& x, const auto& c) { return high(2 * x + x * x * x * polynomial(c, x * x)); };
    const auto cos_of = [](const high& x, const auto& c) {
        return high(1 - x * x / 2 + x * x * x * x * polynomial(c, x * x));
    };
    const auto exp_x = [](const high& x) { return high(exp(x)); };
    const auto log_x = [](const high& x) { return high(log((1 + x) / (1 - x))); };
    const auto sin_x = [](const high& x) { return high(sin(x)); };
    const auto cos_x = [](const high& x) { return high(cos(x)); };
    const auto atan_x = [](const high& x) { return high(atan(x)); };
    const double ln2 = 0.34657359027997264, sqrt2 = 0.17157287525380990, quarter = pi / 4, eighth = std::sqrt(2) - 1;
    check(-28.0, -ln2, ln2, {exp_float_0, exp_float_1, exp_float_2, exp_float_3, exp_float_4}, exp_of, exp_x);
    check(-57.4, -ln2, ln2,
          {exp_double_0, exp_double_1, exp_double_2, exp_double_3, exp_double_4, exp_double_5, exp_double_6,
           exp_double_7, exp_double_8, exp_double_9},
          exp_of, exp_x);
    check(-30.2, 0, sqrt2, {log_float_0, log_float_1, log_float_2}, twice_of, log_x);
    check(-59.3, 0, sqrt2,
          {log_double_0, log_double_1, log_double_2, log_double_3, log_double_4, log_double_5, log_double_6}, twice_of,
          log_x);
    check(-26.8, 0, quarter, {sin_float_0, sin_float_1, sin_float_2}, odd_of, sin_x);
    check(-56.4, 0, quarter, {sin_double_0, sin_double_1, sin_double_2, sin_double_3, sin_double_4, sin_double_5},
          odd_of, sin_x);
    check(-32.4, 0, quarter, {cos_float_0, cos_float_1, cos_float_2}, cos_of, cos_x);
    check(-59.6, 0, quarter, {cos_double_0, cos_double_1, cos_double_2, cos_double_3, cos_double_4, cos_double_5},
          cos_of, cos_x);
    check(-28.3, 0, eighth, {atan_float_0, atan_float_1, atan_float_2, atan_float_3, atan_float_4}, odd_of, atan_x);
    check(-57.4, 0, eighth,
          {atan_double_0, atan_double_1, atan_double_2, atan_double_3, atan_double_4, atan_double_5, atan_double_6,
           atan_double_7, atan_double_8, atan_double_9, atan_double_10},
          odd_of, atan_x);
}
