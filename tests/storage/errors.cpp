// Largest errors of the intensities of storage formats by bounds of few numbers, for the channels as they are given, where a
// search finds them: two depths of any distance and weights, receivers anywhere.
#include "support/climber.hpp"

#include <gnomon/storage/exponential_variance.h>
#include <gnomon/storage/layered_variance.h>
#include <gnomon/storage/variance.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using wide = long double;
using place = std::vector<double>;
template <class T> constexpr wide u = wide(std::numeric_limits<T>::epsilon()) / 2;
constexpr std::int64_t evaluations = 100'000;

/// Cantelli's bound from exact moments, and the slack that variance.h states for it, for roundings r.
struct cantelli {
    wide bound = 0, slack = 0;
    cantelli() = default;
    cantelli(wide mean, wide square, wide receiver, wide minimum, wide r)
    {
        const wide variance = std::max(minimum, square - mean * mean), d = std::max(0.0L, receiver - mean);
        const wide spread = variance + d * d, q = (square + receiver * receiver) / spread;
        bound = std::clamp(d * d / spread, 0.0L, 1.0L);
        slack = r * (1 + 4 * q + std::sqrt(q));
    }
    /// The larger bound of two, and the larger slack.
    void join(const cantelli& other)
    {
        bound = std::max(bound, other.bound);
        slack = std::max(slack, other.slack);
    }
    [[nodiscard]] double ratio(wide intensity) const
    {
        return slack < 1 ? double(std::abs(intensity - bound) / slack) : 0; // a slack of 1 states nothing
    }
};

/// The mean of f over two depths, rounded to T: a channel.
template <class T, class F> T channel(const place& p, F f)
{
    const wide z1 = 2 * wide(p[0]) - 1, z2 = std::min(1.0L, z1 + 2 * std::exp2(-30 * wide(p[1])));
    return T(wide(p[2]) * f(z1) + (1 - wide(p[2])) * f(z2));
}

/// A receiver anywhere, or about the farther depth.
template <class T> T receiver_of(const place& p)
{
    if (p[3] < 0.3) return T(2 * p[4] - 1);
    const double z2 = std::min(1.0, 2 * p[0] - 1 + 2 * std::exp2(-30 * p[1]));
    return T(std::clamp(z2 + (p[3] < 0.6 ? -1 : 1) * std::exp2(-30 * p[4]), -1.0, 1.0));
}

template <class F> void check_summit(F f)
{
    const summit found = climb(5, evaluations, 1, f);
    CHECK_MESSAGE(found.score <= 1, found.score);
    if (!draws_few()) CHECK(found.score > 0.01); // the measure sees errors
}

} // namespace

TEST_CASE_TEMPLATE("variance_unorm16_intensity", T, float, double)
{
    check_summit([](const place& p) {
        const channels2<T> c{channel<T>(p, [](wide z) { return (1 + z) / 2; }),
                             channel<T>(p, [](wide z) { return z * z; })};
        const T z_f = receiver_of<T>(p);
        return cantelli(2 * wide(c.c1) - 1, wide(c.c2), wide(z_f), wide(T(variance_unorm16_minimum_variance)), 4 * u<T>)
            .ratio(wide(variance_unorm16_intensity(c, z_f)));
    });
}

TEST_CASE_TEMPLATE("layered_variance_unorm16_intensity", T, float, double)
{
    check_summit([](const place& p) {
        channels8<T> c{};
        const T z_f = receiver_of<T>(p);
        cantelli all;
        const auto layer = [&](wide centre, T& mean, T& square) {
            const auto own = [&](wide z) { return std::clamp((z - centre) * 4, -1.0L, 1.0L); };
            mean = channel<T>(p, [&](wide z) { return (1 + own(z)) / 2; });
            square = channel<T>(p, [&](wide z) { return own(z) * own(z); });
            all.join(cantelli(2 * wide(mean) - 1, wide(square), own(wide(z_f)),
                              wide(T(layered_variance_unorm16_minimum_variance)), 8 * u<T>));
        };
        layer(-0.75L, c.t1.c1, c.t1.c2), layer(-0.25L, c.t1.c3, c.t1.c4);
        layer(0.25L, c.t2.c1, c.t2.c2), layer(0.75L, c.t2.c3, c.t2.c4);
        return all.ratio(wide(layered_variance_unorm16_intensity(c, z_f)));
    });
}

namespace {

template <class T, class Kernel> void check_exponential(double positive, double negative, double minimum, Kernel kernel)
{
    check_summit([&](const place& p) {
        const wide a = wide(T(positive)), b = wide(T(negative)), least = wide(T(minimum));
        const auto up = [=](wide z) { return std::exp(a * z); };
        const auto down = [=](wide z) { return -std::exp(-b * z); };
        const channels4<T> c{channel<T>(p, up), channel<T>(p, [&](wide z) { return up(z) * up(z); }),
                             channel<T>(p, down), channel<T>(p, [&](wide z) { return down(z) * down(z); })};
        const T z_f = receiver_of<T>(p);
        const auto side = [&](T mean, T square, wide receiver, wide exponent) {
            const wide slope = exponent * receiver;
            return cantelli(wide(mean), wide(square), receiver, least * slope * slope, (2 * exponent + 8) * u<T>);
        };
        cantelli both = side(c.c1, c.c2, up(wide(z_f)), a);
        both.join(side(c.c3, c.c4, down(wide(z_f)), b));
        return both.ratio(wide(kernel(c, z_f)));
    });
}

} // namespace

TEST_CASE_TEMPLATE("exponential_variance_half_intensity and exponential_variance_float_intensity", T, float, double)
{
    check_exponential<T>(exponential_variance_half_exponent, exponential_variance_half_exponent,
                         exponential_variance_half_minimum_variance,
                         [](const channels4<T>& c, T z_f) { return exponential_variance_half_intensity(c, z_f); });
    check_exponential<T>(exponential_variance_float_positive_exponent, exponential_variance_float_negative_exponent,
                         exponential_variance_float_minimum_variance,
                         [](const channels4<T>& c, T z_f) { return exponential_variance_float_intensity(c, z_f); });
}
