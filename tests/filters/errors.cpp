// Largest errors of the filters beside moment shadow maps, where a search finds them: two depths of any distance and
// weights, receivers at any distance from the mean and the depths, all settings in use.
#include "support/climber.hpp"

#include <gnomon/filters/convolution.h>
#include <gnomon/filters/exponential.h>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/filters/layered_variance.h>
#include <gnomon/filters/variance.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using wide = long double;
using place = std::vector<double>;
constexpr wide pi = 3.14159265358979323846L;
template <class T> constexpr wide u = wide(std::numeric_limits<T>::epsilon()) / 2;
constexpr std::int64_t evaluations = 100'000;

/// 0 < exponent <= largest.
template <class T> T exponent(double p, double largest) { return T(std::exp2(10 * (p - 1)) * largest); }

struct two_depths {
    wide z1, z2, w1;
    explicit two_depths(const place& p)
        : z1(2 * wide(p[0]) - 1),
          z2(std::min(1.0L, z1 + 2 * std::exp2(-60 * wide(p[1])))),
          w1(std::exp2(-80 * std::abs(wide(p[2]) - 0.5L)) / 2)
    {
        if (p[2] > 0.5) w1 = 1 - w1;
    }
    template <class F> [[nodiscard]] wide mean(F f) const { return w1 * f(z1) + (1 - w1) * f(z2); }
    template <class T, class F> [[nodiscard]] variance_moments<T> stored(F f) const
    {
        return {T(mean(f)), T(mean([&](wide z) { return f(z) * f(z); }))};
    }
    /// Anywhere, about the mean, or about the farther depth.
    template <class T> [[nodiscard]] T receiver(double p) const
    {
        const double part = 3 * p - std::floor(3 * p), distance = std::exp2(-50 * (1 - std::abs(2 * part - 1)));
        const wide step = wide(part < 0.5 ? -distance : distance);
        if (p < 1.0 / 3) return T(2 * part - 1);
        return T(std::clamp((p < 2.0 / 3 ? mean([](wide z) { return z; }) : z2) + step, -1.0L, 1.0L));
    }
};

/// Cantelli's bound and the slack that variance.h states for it, for roundings r.
struct cantelli {
    wide bound = 0, slack = HUGE_VALL;
    template <class F> cantelli(const two_depths& d, F f, wide receiver, wide r)
    {
        const wide mean = d.mean(f), difference = f(d.z2) - f(d.z1);
        const wide variance = d.w1 * (1 - d.w1) * difference * difference;
        const wide x = std::max(0.0L, receiver - mean), spread = variance + x * x;
        if (!(spread > 0)) return;
        const wide q = (variance + mean * mean + receiver * receiver) / spread;
        bound = x * x / spread;
        slack = r * (1 + 4 * q + std::sqrt(q));
    }
    [[nodiscard]] double ratio(wide intensity) const
    {
        return slack < 1 ? double(std::abs(intensity - bound) / slack) : 0; // a slack of 1 states nothing
    }
};

template <class F> void check_summit(std::size_t dimensions, std::int64_t count, F f)
{
    const summit found = climb(dimensions, count, 1, f);
    CHECK_MESSAGE(found.score <= 1, found.score);
    CHECK(found.score > 0.01); // the measure sees errors
}

} // namespace

TEST_CASE_TEMPLATE("texels of exponential maps: (c + 2) 2^-p, with squares (2 c + 4) 2^-p", T, float, double)
{
    const double largest = std::is_same_v<T, float> ? 44 : 350;
    check_summit(2, evaluations, [&](const place& p) {
        const T c = exponent<T>(p[0], largest), z = T(2 * p[1] - 1);
        const wide positive = std::exp(wide(c) * wide(z)), negative = -std::exp(-wide(c) * wide(z));
        const auto error = [&](T value, wide exact, wide stated) {
            return double(std::abs(wide(value) / exact - 1) / (stated * u<T>));
        };
        const wide once = wide(c) + 2, twice = 2 * wide(c) + 4;
        const auto b = exponential_variance_encode(z, exponential_variance_settings<T>{c, c, T(0)});
        return std::max({error(exponential_encode(z, exponential_settings<T>{c}).warped, positive, once),
                         error(b.positive, positive, twice), error(b.positive_square, positive * positive, twice),
                         error(b.negative, negative, twice), error(b.negative_square, negative * negative, twice)});
    });
}

TEST_CASE("largest exponents in float: 44 once, 40 for squares of the warp's slope")
{
    const float once = exponential_encode(1.0F, exponential_settings<float>{44}).warped;
    CHECK(std::isfinite(once * once));
    const float slope = 40 * exponential_encode(1.0F, exponential_settings<float>{40}).warped;
    CHECK(std::isfinite(slope * slope));
    CHECK(!std::isfinite(slope * slope * 4)); // so 41, e times as steep, would be too much
}

TEST_CASE_TEMPLATE("exponential_intensity: (c + 5) 2^-p of the visibility, and a rounding", T, float, double)
{
    const double largest = std::is_same_v<T, float> ? 44 : 350;
    check_summit(5, evaluations, [&](const place& p) {
        const two_depths d(p);
        const T z_f = d.receiver<T>(p[3]), c = exponent<T>(p[4], largest);
        const wide mean = d.mean([=](wide z) { return std::exp(wide(c) * z); });
        const wide visibility = std::min(1.0L, mean * std::exp(-wide(c) * wide(z_f)));
        const T intensity = exponential_intensity(exponential_moment<T>{T(mean)}, z_f, exponential_settings<T>{c});
        return double(std::abs(wide(intensity) - (1 - visibility)) / (u<T> * ((wide(c) + 5) * visibility + 1)));
    });
}

TEST_CASE_TEMPLATE("variance_intensity: cantelli_lower's error with r = 4 2^-p", T, float, double)
{
    const auto depth = [](wide z) { return z; };
    check_summit(4, evaluations, [&](const place& p) {
        const two_depths d(p);
        const T z_f = d.receiver<T>(p[3]);
        return cantelli(d, depth, wide(z_f), 4 * u<T>)
            .ratio(wide(variance_intensity(d.stored<T>(depth), z_f, variance_settings<T>{T(0)})));
    });
}

TEST_CASE_TEMPLATE("layered variance: cantelli_lower's error with r = 8 2^-p", T, float, double)
{
    check_summit(6, evaluations, [](const place& p) {
        const two_depths d(p);
        const T z_f = d.receiver<T>(p[3]);
        const layered_variance_settings<T> layer{T(2 * p[4] - 1), T(std::exp2(10 * p[5])), T(0)};
        const auto own = [&](wide z) { return std::clamp((z - wide(layer.centre)) * wide(layer.scale), -1.0L, 1.0L); };
        const auto state = layered_variance_add(layered_variance_begin(z_f), d.stored<T>(own), layer);
        return cantelli(d, own, own(wide(z_f)), 8 * u<T>).ratio(wide(layered_variance_end(state)));
    });
}

// Negative exponents above 9.7 overflowed once, where all moments were scaled for the sake of a receiver near 0.
TEST_CASE_TEMPLATE("exponential variance: cantelli_lower's error with r = (2 c + 8) 2^-p", T, float, double)
{
    check_summit(6, evaluations, [](const place& p) {
        const two_depths d(p);
        const T z_f = d.receiver<T>(p[3]);
        const exponential_variance_settings<T> settings{exponent<T>(p[4], 40), exponent<T>(p[5], 40), T(0)};
        const wide c = wide(settings.positive_exponent), n = wide(settings.negative_exponent);
        const auto positive = [=](wide z) { return std::exp(c * z); };
        const auto negative = [=](wide z) { return -std::exp(-n * z); };
        const auto b1 = d.stored<T>(positive), b2 = d.stored<T>(negative);
        cantelli both(d, positive, positive(wide(z_f)), (2 * c + 8) * u<T>);
        const cantelli other(d, negative, negative(wide(z_f)), (2 * n + 8) * u<T>);
        both.bound = std::max(both.bound, other.bound);
        both.slack = std::max(both.slack, other.slack);
        return both.ratio(
            wide(exponential_variance_intensity({b1.mean, b1.square, b2.mean, b2.square}, z_f, settings)));
    });
}

namespace {

template <class T> convolution_settings<T> series(int terms, double damping, double span)
{
    return {T(terms), T(damping), T(0.03125), T(span)};
}

} // namespace

TEST_CASE_TEMPLATE("convolution: term k within 8 k 2^-p, the sum of 16 within 150 2^-p", T, float, double)
{
    for (const int terms : {1, 4, 64})
        check_summit(2, evaluations / 10, [=](const place& p) {
            const T z = T(2 * p[0] - 1);
            const auto settings = series<T>(terms, 0, 1 - 0.9 * p[1]);
            auto phase = convolution_encode(z, settings);
            for (int k = 1; k < terms; ++k) phase = convolution_next(phase);
            const wide angle = (2 * terms - 1) * wide(settings.span) * pi / 2 * wide(z);
            return double(
                std::max(std::abs(wide(phase.cosine) - std::cos(angle)), std::abs(wide(phase.sine) - std::sin(angle))) /
                (8 * terms * u<T>));
        });
    check_summit(5, evaluations / 10, [](const place& p) {
        const int terms = 1 + int(15.99 * p[0]);
        const T z = T(2 * p[1] - 1), z_f = T(2 * p[2] - 1);
        const auto settings = series<T>(terms, 4 * p[4], 1 - 0.9 * p[3]);
        auto texel = convolution_encode(z, settings);
        auto state = convolution_begin(z_f, settings);
        wide exact = 0.5L;
        for (int k = 1; k <= terms; ++k) {
            state = convolution_add(state, texel.cosine, texel.sine, convolution_weight(T(k), settings));
            texel = convolution_next(texel);
            const wide ratio = wide(k) / terms, angle = (2 * k - 1) * pi / 2 * wide(settings.span);
            exact += 2 / ((2 * k - 1) * pi) * std::exp(-wide(settings.damping) * ratio * ratio) *
                     std::sin(angle * (wide(z_f) - wide(settings.offset) - wide(z)));
        }
        return double(std::abs(wide(convolution_end(state)) - std::clamp(exact, 0.0L, 1.0L)) / (150 * u<T>));
    });
}

TEST_CASE("convolution: the sine integral is pi / 2 at 1.926")
{
    const auto sine_integral = [](double x) {
        double sum = 0;
        for (int i = 0; i < 10'000; ++i) {
            const double t = (i + 0.5) * x / 10'000;
            sum += std::sin(t) / t * x / 10'000;
        }
        return sum;
    };
    CHECK(sine_integral(1.9255) < double(pi / 2));
    CHECK(sine_integral(1.9265) > double(pi / 2));
}
