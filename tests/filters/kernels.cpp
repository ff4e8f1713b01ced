// The filters beside moment shadow maps: their bounds are bounds, their errors are those that the comments state. That
// nothing leaves [0, 1] is tested with every kernel (every_kernel.hpp).

#include "support/distributions.hpp"
#include "support/effort.hpp"
#include "support/rounding.hpp"

#include <gnomon/filters/convolution.h>
#include <gnomon/filters/exponential.h>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/filters/layered_variance.h>
#include <gnomon/filters/percentage_closer.h>
#include <gnomon/filters/variance.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace gnomon;
using gnomon::test::distribution;
using gnomon::test::u;

namespace {

using wide = long double;
constexpr wide pi = 3.14159265358979323846L;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
/// A distribution has at most 81 weights that sum to 1 but for rounding.
constexpr double rounding_of_weights = 81 * 0x1p-53;

/// E[f(z)] in extended precision, rounded once to T.
template <class T, class F> T expectation(const distribution& d, F f)
{
    wide sum = 0, total = 0;
    for (std::size_t i = 0; i < d.depths.size(); ++i) {
        sum += wide(d.weights[i]) * f(wide(d.depths[i]));
        total += wide(d.weights[i]);
    }
    return T(sum / total);
}

/// Calls f(distribution, z_f) for every family, with receivers anywhere and on the depths themselves.
template <class F> void for_each_query(std::int64_t queries, F f)
{
    gnomon::test::distribution_source source(11);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> depth(-1, 1);
    for (std::int64_t i = 0; i < test::effort(queries); ++i) {
        const distribution d = source.draw(gnomon::test::family(i % gnomon::test::family_count));
        f(d, depth(random));
        f(d, d.depths[random() % d.depths.size()]);
    }
}

double closer(const distribution& d, double z_f)
{
    percentage_closer<double> state = percentage_closer_begin(z_f);
    for (std::size_t i = 0; i < d.depths.size(); ++i) state = percentage_closer_add(state, d.depths[i], d.weights[i]);
    return percentage_closer_end(state);
}

template <class T> variance_moments<T> variance_of(const distribution& d)
{
    return {expectation<T>(d, [](auto z) { return z; }), expectation<T>(d, [](auto z) { return z * z; })};
}

template <class T>
exponential_variance_moments<T> exponential_variance_of(const distribution& d, double positive, double negative)
{
    return {expectation<T>(d, [=](auto z) { return std::exp(wide(positive) * z); }),
            expectation<T>(d, [=](auto z) { return std::exp(2 * wide(positive) * z); }),
            expectation<T>(d, [=](auto z) { return -std::exp(-wide(negative) * z); }),
            expectation<T>(d, [=](auto z) { return std::exp(-2 * wide(negative) * z); })};
}

/// Cantelli's bound from central moments, which do not cancel; and how far rounding every moment by r of its size may
/// move it: the derivative in the variance is at most 1 / (variance + d^2), that in d at most 1 / sqrt(variance + d^2),
/// square >= mean^2.
struct cantelli {
    double bound, slack;
};
template <class F> cantelli exact_cantelli(const distribution& d, F f, wide receiver, double r)
{
    const auto mean = expectation<wide>(d, f);
    const auto variance = expectation<wide>(d, [=](auto z) { return (f(z) - mean) * (f(z) - mean); });
    const auto square = variance + mean * mean;
    const wide x = std::max(0.0L, receiver - mean);
    const wide spread = variance + x * x;
    const wide scale = square + receiver * receiver;
    const wide slack = wide(r) * (1 + 4 * scale / spread + std::sqrt(scale / spread));
    return {spread > 0 ? double(x * x / spread) : 0.0, spread > 0 ? double(slack) : 1.0};
}

} // namespace

TEST_CASE("percentage closer: the weight in front of the receiver")
{
    for_each_query(20'000,
                   [](const distribution& d, double z_f) { CHECK(closer(d, z_f) == std::min(1.0, d.below(z_f))); });
    const distribution three{{-0.5, nan_value, 0.25}, {0.25, 0.5, 0.25}};
    CHECK(closer(three, 0.25) == 0.25);
    CHECK(closer(three, nan_value) == 0);
    CHECK(closer(three, std::numeric_limits<double>::infinity()) == 0.5);
    CHECK(closer({{-0.5, 0}, {nan_value, 0.5}}, 1) == 0);
}

// The kernels are lower bounds: at most the formula's value, which is at most Z(z < z_f), plus the stated slack. One
// rounding of each moment and four of the kernel make 4 u.
TEST_CASE_TEMPLATE("variance: Cantelli's bound, within the stated error, below percentage closer", T, float, double)
{
    for_each_query(40'000, [](const distribution& d, double z) {
        const T z_f = T(z);
        const T intensity = variance_intensity(variance_of<T>(d), z_f, variance_settings<T>{0});
        const cantelli exact = exact_cantelli(
            d, [](auto x) { return x; }, wide(z_f), 4 * u<T>);
        REQUIRE(std::abs(double(intensity) - exact.bound) <= exact.slack);
        REQUIRE(exact.bound <= d.below(double(z_f)) + rounding_of_weights);
    });
}

// Two roundings stretch the receiver, two the depths; the rest as above.
TEST_CASE_TEMPLATE("layered variance: the largest of the layers' bounds, below percentage closer", T, float, double)
{
    constexpr std::size_t layers = 4;
    for_each_query(20'000, [](const distribution& d, double z) {
        const T z_f = T(z);
        layered_variance<T> state = layered_variance_begin(z_f);
        cantelli largest{0, 0};
        for (std::size_t k = 0; k < layers; ++k) {
            const layered_variance_settings<T> settings{T(2 * double(k) + 1) / T(layers) - T(1), T(layers), T(0)};
            const auto stretched = [&](wide x) {
                return std::clamp((x - wide(settings.centre)) * wide(settings.scale), -1.0L, 1.0L);
            };
            const variance_moments<T> filtered{expectation<T>(d, stretched),
                                               expectation<T>(d, [&](wide x) { return stretched(x) * stretched(x); })};
            state = layered_variance_add(state, filtered, settings);
            const cantelli exact = exact_cantelli(d, stretched, stretched(wide(z_f)), 8 * u<T>);
            largest = {std::max(largest.bound, exact.bound), std::max(largest.slack, exact.slack)};
        }
        REQUIRE(std::abs(double(layered_variance_end(state)) - largest.bound) <= largest.slack);
        REQUIRE(largest.bound <= d.below(double(z_f)) + rounding_of_weights);
    });
}

TEST_CASE("one layer over all depths is a variance shadow map; a cut between two occluders stops the leak")
{
    const layered_variance_settings<double> all{0, 1, 1e-6};
    for_each_query(1'000, [&](const distribution& d, double z_f) {
        const auto b = variance_of<double>(d);
        const auto state = layered_variance_add(layered_variance_begin(z_f), b, all);
        REQUIRE(layered_variance_end(state) == variance_intensity(b, z_f, {all.minimum_variance}));
    });
    // Two thirds of the region lie in front of the last layer, the receiver in it.
    layered_variance<double> state = layered_variance_begin(0.9);
    for (const double centre : {-0.5, 0.25, 0.75}) {
        const layered_variance_settings<double> settings{centre, centre < 0 ? 2.0 : 4.0, 0};
        variance_moments<double> mean{0, 0};
        for (const double z : {-0.8, 0.4, 0.9}) {
            const auto b = layered_variance_encode(z, settings);
            mean = {mean.mean + b.mean / 3, mean.square + b.square / 3};
        }
        state = layered_variance_add(state, mean, settings);
    }
    CHECK(layered_variance_end(state) == doctest::Approx(2.0 / 3));
    CHECK(variance_intensity(variance_of<double>({{-0.8, 0.4, 0.9}, {1.0 / 3, 1.0 / 3, 1.0 / 3}}), 0.9, {0}) < 0.55);
}

TEST_CASE_TEMPLATE("exponential: Markov's bound, within the stated error, below percentage closer", T, float, double)
{
    const double c = 40;
    for_each_query(20'000, [&](const distribution& d, double z) {
        const T z_f = T(z);
        const auto warped = expectation<T>(d, [=](auto x) { return std::exp(wide(c) * x); });
        const T intensity = exponential_intensity(exponential_moment<T>{warped}, z_f, exponential_settings<T>{T(c)});
        const wide ratio = wide(warped) * std::exp(-wide(c) * wide(z_f));
        const double exact = std::max(0.0, double(1 - ratio));
        REQUIRE(std::abs(double(intensity) - exact) <= u<T> * ((c + 5) * std::min(1.0, double(ratio)) + 1) + 1e-18);
        REQUIRE(exact <= d.below(double(z_f)) + rounding_of_weights + u<T>);
    });
}

// The warp's own rounding, (2 c + 4) u of the receiver's value, comes on top of that of the moments.
TEST_CASE_TEMPLATE("exponential variance: the larger of two bounds, below percentage closer", T, float, double)
{
    for (const double positive : std::array{5.54, 40.0}) {
        const double negative = 5.54;
        for_each_query(10'000, [&](const distribution& d, double z) {
            const T z_f = T(z);
            const exponential_variance_settings<T> settings{T(positive), T(negative), T(0)};
            const T intensity = exponential_variance_intensity(
                exponential_variance_of<T>(d, double(settings.positive_exponent), double(settings.negative_exponent)),
                z_f, settings);
            const double p = double(settings.positive_exponent);
            const double n = double(settings.negative_exponent);
            const auto warp_p = [=](auto x) { return std::exp(wide(p) * wide(x)); };
            const auto warp_n = [=](auto x) { return -std::exp(-wide(n) * wide(x)); };
            const cantelli exact_p = exact_cantelli(d, warp_p, warp_p(wide(z_f)), (2 * p + 8) * u<T>);
            const cantelli exact_n = exact_cantelli(d, warp_n, warp_n(wide(z_f)), (2 * n + 8) * u<T>);
            const double slack = std::max(exact_p.slack, exact_n.slack);
            REQUIRE(std::abs(double(intensity) - std::max(exact_p.bound, exact_n.bound)) <= slack);
            REQUIRE(std::max(exact_p.bound, exact_n.bound) <= d.below(double(z_f)) + rounding_of_weights);
        });
    }
}

TEST_CASE("the bounds are attained: variance by two depths, the exponential ones by distant depths")
{
    for (const double p : std::array{0.01, 0.3, 0.9}) {
        const distribution d{{-0.4, 0.6}, {p, 1 - p}};
        CHECK(variance_intensity(variance_of<double>(d), 0.6, variance_settings<double>{0}) ==
              doctest::Approx(p).epsilon(1e-13));
        const auto both = exponential_variance_of<double>(d, 40, 5.54);
        CHECK(exponential_variance_intensity(both, 0.6, {40.0, 5.54, 0.0}) == doctest::Approx(p).epsilon(1e-10));
        // Markov's inequality loses the share of the far depth's weight that exp(c (z - z_f)) leaves.
        const double warped = expectation<double>(d, [](auto z) { return std::exp(40 * z); });
        CHECK(exponential_intensity({warped}, 0.6, exponential_settings<double>{40}) ==
              doctest::Approx(p).epsilon(1e-13));
    }
}

// In exact arithmetic. Each value has a relative error of at most 3 u, so a step down by more than 6 u is none of
// rounding.
TEST_CASE_TEMPLATE("intensity grows with the receiver's depth", T, float, double)
{
    for_each_query(4'000, [](const distribution& d, double) {
        const auto variance = variance_of<T>(d);
        const auto warped = expectation<T>(d, [](auto z) { return std::exp(40 * z); });
        const auto both = exponential_variance_of<T>(d, 40, 5.54);
        std::array<T, 3> last{};
        for (int i = 0; i <= 64; ++i) {
            const T z_f = T(i) / T(32) - T(1);
            const std::array<T, 3> now{variance_intensity(variance, z_f, variance_settings<T>{T(1e-6)}),
                                       exponential_intensity({warped}, z_f, exponential_settings<T>{40}),
                                       exponential_variance_intensity(both, z_f, {T(40), T(5.54), T(1e-12)})};
            for (std::size_t k = 0; k < 2; ++k) REQUIRE(double(now[k]) >= double(last[k]) - 6 * u<T>);
            // Its minimum variance grows with the receiver: not monotonic for a hostile one, but for any in use.
            REQUIRE(double(now[2]) >= double(last[2]) - 6 * u<T>);
            last = now;
        }
    });
}

TEST_CASE_TEMPLATE("convolution: the Fourier series within 150 u, for every span, damping and number of terms", T,
                   float, double)
{
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> depth(-1, 1);
    for (std::int64_t i = 0; i < test::effort(20'000); ++i) {
        const T z = T(depth(random));
        const T z_f = T(depth(random));
        const int terms = int(i % 16) + 1;
        const convolution_settings<T> settings{T(terms), T(i % 3), T(0.03125), T(0.9375)};
        convolution_phase<T> texel = convolution_encode(z, settings);
        convolution_sum<T> state = convolution_begin(z_f, settings);
        wide exact = 0.5L;
        for (int k = 1; k <= terms; ++k) {
            state = convolution_add(state, texel.cosine, texel.sine, convolution_weight(T(k), settings));
            texel = convolution_next(texel);
            const wide ratio = wide(k) / wide(terms);
            exact += 2 / (wide(2 * k - 1) * pi) * std::exp(-wide(i % 3) * ratio * ratio) *
                     std::sin(wide(2 * k - 1) * pi / 2 * 0.9375L * (wide(z_f) - 0.03125L - wide(z)));
        }
        const double clamped = std::clamp(double(exact), 0.0, 1.0);
        REQUIRE(std::abs(double(convolution_end(state)) - clamped) <= 150 * u<T>);
    }
}

TEST_CASE_TEMPLATE("ordinary odd inputs: lit where nothing is in front, NaN is lit", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const variance_settings<T> none{0};
    const exponential_settings<T> sharp{40};
    const exponential_variance_settings<T> warps{T(40), T(5.54), T(0)};
    for (int i = -64; i <= 64; ++i) {
        const T z = T(i) / 64;
        // One depth, no variance, and the receiver on it. Only the exponential map rounds: twice (c + 2) u.
        CHECK(variance_intensity(variance_encode(z), z, none) == 0);
        CHECK(exponential_variance_intensity(exponential_variance_encode(z, warps), z, warps) == 0);
        CHECK(double(exponential_intensity(exponential_encode(z, sharp), z, sharp)) <= 84 * u<T>);
        // A map cleared to the far plane.
        CHECK(variance_intensity(variance_encode(T(1)), z, none) == 0);
        CHECK(exponential_variance_intensity(exponential_variance_encode(T(1), warps), z, warps) == 0);
        // A surface well in front.
        CHECK(variance_intensity(variance_encode(T(-1)), z + T(0.5), none) == 1);
    }
    CHECK(variance_intensity(variance_encode(nan), T(1), none) == 0);
    CHECK(variance_intensity(variance_moments<T>{T(0), nan}, T(1), none) == 0);
    CHECK(variance_intensity(variance_encode(T(0)), nan, none) == 0);
    CHECK(double(exponential_intensity(exponential_encode(nan, sharp), T(1), sharp)) <= 84 * u<T>);
    CHECK(exponential_intensity(exponential_encode(T(0), sharp), nan, sharp) == 0);
    CHECK(exponential_variance_intensity(exponential_variance_encode(nan, warps), T(1), warps) == 0);
    CHECK(exponential_variance_intensity(exponential_variance_encode(T(0), warps), nan, warps) == 0);
    const convolution_settings<T> series{T(1), T(0), T(0), T(1)};
    CHECK(convolution_end(convolution_add(convolution_begin(T(1), series), nan, T(0), T(1))) == 0);
    CHECK(convolution_end(convolution_add(convolution_begin(nan, series), T(0), T(0), T(1))) == 0);
}
