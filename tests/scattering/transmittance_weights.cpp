// Weights of prefix averages against sums of exponentials, and of the part of a texel against its integral.
#include "climbed.hpp"

#include <gnomon/scattering/height_fog.h>
#include <gnomon/scattering/transmittance_weights.h>

#include <algorithm>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The prefix average of texels by the shares of the kernel.
template <class T> wide prefix_average(T q, const std::vector<wide>& texels)
{
    wide mean = texels[0];
    T g = 1;
    for (std::size_t u = 1; u < texels.size(); ++u) {
        g = transmittance_weight_next(g, q);
        mean += wide(g) * (texels[u] - mean);
    }
    return mean;
}

} // namespace

TEST_CASE_TEMPLATE("shares are the weights of a sum of exponentials, from no extinction to an opaque medium", T, float,
                   double)
{
    check_error(256, 1, 2'000, [](const place& p) {
        const T q = transmittance_step(p[0] < 0.1 ? T(0) : T(std::exp2(24 * p[0] - 20)), T(1), T(1));
        T g = 1;
        wide sum = 1, weight = 1;
        double worst = 0;
        for (int texel = 1; texel < 1024 && weight > 1e-30L; ++texel) {
            g = transmittance_weight_next(g, q);
            sum += weight *= wide(q);
            worst = std::max(worst, g < 0 || g > 1 ? HUGE_VAL : relative(g, weight / sum));
        }
        return worst;
    });
    // No extinction: the mean of all texels; infinite extinction: the first alone.
    const std::vector<wide> texels{0.5L, -0.25L, 1, 0.125L, -1};
    CHECK(double(prefix_average(transmittance_step(T(0), T(1), T(1)), texels)) ==
          doctest::Approx(0.075).epsilon(4 * u<T>));
    const T opaque = transmittance_step(std::numeric_limits<T>::infinity(), T(1), T(1));
    CHECK(prefix_average(opaque, texels) == doctest::Approx(0.5).epsilon(1e-30));
}

TEST_CASE("prefix averages of a row are brute-force sums of weighted texels, and no texel's share is negative")
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        std::vector<wide> texels(1 + bits.below(200));
        for (wide& x : texels) x = wide(bits.uniform(-1, 1));
        const double q = bits.chance(0.1) ? 1 : bits.uniform(0, 1);
        wide sum = 0, total = 0, weight = 1;
        for (const wide x : texels) sum += weight * x, total += weight, weight *= wide(q);
        REQUIRE(double(prefix_average(q, texels)) == doctest::Approx(double(sum / total)).epsilon(1e-12));
    }
}

TEST_CASE_TEMPLATE("steps and shares have their stated errors, and their limits at 0, infinity and NaN", T, float,
                   double)
{
    constexpr T infinite = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    check_error(1, 3, 100'000, [](const place& p) {
        const T step = magnitude<T>(p[0], 8), sine = T(0.01 + 0.99 * p[1]), extinction = T(80 * p[2]) * sine / step;
        const wide depth = wide(extinction) * wide(step) / wide(sine);
        if (depth > 87) return 0.0;
        return relative(transmittance_step(extinction, step, sine), std::exp(-depth)) / (2 + 2.5 * double(depth));
    });
    check_error(3, 2, 100'000, [](const place& p) {
        const T g = T(std::exp2(-20 * p[0])), q = T(std::exp2(-20 * p[1]));
        return relative(transmittance_weight_next(g, q), wide(q) * wide(g) / (1 + wide(q) * wide(g)));
    });
    CHECK((transmittance_step(T(0), T(1), T(0)) == 1 && transmittance_step(T(0), infinite, T(1)) == 1));
    CHECK((transmittance_step(infinite, T(1), T(1)) < T(1e-37) && transmittance_step(T(1), T(1), T(0)) < T(1e-37)));
    CHECK((transmittance_step(nan, T(1), T(1)) == 1 && transmittance_step(T(-1), T(1), T(1)) == 1));
    CHECK((transmittance_weight_next(T(1), T(1)) == T(0.5) && transmittance_weight_next(T(1), T(0)) == 0));
    CHECK((transmittance_weight_next(nan, T(1)) == 0 && transmittance_weight_next(T(1), nan) == 0));
}

TEST_CASE_TEMPLATE("the share within a texel is that of the integral up to there, for a ray that ends anywhere", T,
                   float, double)
{
    // The mean of a row up to the share f of texel u, by integration of e^(-x t) over texels of constant value.
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(5'000); ++i) {
        const T q = T(std::exp(-std::exp2(bits.uniform(-20, 3)))), f = T(bits.uniform(0, 1));
        const wide x = -std::log(wide(q));
        const int count = 1 + int(bits.below(20));
        T g = 1;
        wide before = 0, sum_before = 0; // up to the last texel
        std::vector<wide> texels(std::size_t(count) + 1);
        for (wide& t : texels) t = wide(bits.uniform(-1, 1));
        const auto part = [&](wide from, wide to) { // of e^(-x t) between two places
            return x == 0 ? to - from : std::exp(-x * from) * -std::expm1(-x * (to - from)) / x;
        };
        for (int k = 0; k < count; ++k) {
            before += part(k, k + 1), sum_before += part(k, k + 1) * texels[std::size_t(k)];
            g = transmittance_weight_next(g, q);
        }
        const wide last = texels[std::size_t(count)], within = part(count, count + wide(f)),
                   all = part(count, count + 1);
        const wide mean = (sum_before + within * last) / (before + within);
        const wide mean_before = sum_before / before, mean_after = (sum_before + all * last) / (before + all);
        const wide share = wide(transmittance_weight_within(g, q, f));
        REQUIRE(std::abs(double(mean_before + share * (mean_after - mean_before) - mean)) <= 64 * u<T>);
    }
    // Not the fraction f itself, by which it is off by much where the medium is dense or the row has just begun.
    CHECK(transmittance_weight_within(T(0.5), T(1), T(0.5)) == doctest::Approx(2.0 / 3));
    CHECK((transmittance_weight_within(T(1), T(0.5), T(0)) == 1 &&
           transmittance_weight_within(T(0), T(1), T(0.25)) == T(0.25)));
}

TEST_CASE_TEMPLATE("the share within a texel has its stated error, grows with f, and is in [0, 1] for any input", T,
                   float, double)
{
    check_error(8, 3, 100'000, [](const place& p) {
        const T g = T(p[0]), q = T(std::exp(-std::exp2(40 * p[1] - 36))), f = T(p[2]);
        const wide x = -std::log(wide(q));
        const wide v = x == 0 ? wide(f) : std::expm1(-x * wide(f)) / std::expm1(-x);
        const wide want = v / (1 - wide(g) * (1 - v));
        return g < 1 ? double(std::abs(wide(transmittance_weight_within(g, q, f)) - want)) / u<T> : 0;
    });
    hostile_source<T> source(3);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        const T within = transmittance_weight_within(x[0], x[1], x[2]);
        REQUIRE((0 <= within && within <= 1));
        const T next = transmittance_weight_next(x[0], x[1]), step = transmittance_step(x[0], x[1], x[2]);
        REQUIRE((0 <= next && next <= 1 && 0 <= step && step <= 1));
        const auto sum = transmittance_share_add(transmittance_share_begin(x[0]), x[1]);
        REQUIRE((0 <= sum.share && sum.share <= 1 && sum.total >= 0));
    }
}

TEST_CASE_TEMPLATE("shares of any weights are those of their sums: fog along rays that rise and that descend", T, float,
                   double)
{
    bit_source bits(4);
    for (int row = 0; row < 50; ++row) {
        const T decay = T(bits.uniform(-1, 1)), extinction = T(bits.uniform(0, 0.5));
        auto state = transmittance_share_begin(height_fog_weight(T(0), T(0.02), decay, extinction));
        CHECK(state.share == 1);
        wide sum = wide(state.total);
        for (int texel = 1; texel < 256; ++texel) {
            const T weight = height_fog_weight(T(texel) * T(0.02), T(texel + 1) * T(0.02), decay, extinction);
            state = transmittance_share_add(state, weight), sum += wide(weight);
            REQUIRE(relative(state.share, wide(weight) / sum) <= texel + 2);
        }
        // All texels together scatter what the closed form says of the whole ray.
        const T whole = attenuated_length(height_fog_amount(T(0), T(256) * T(0.02), decay), extinction);
        REQUIRE(relative(state.total, wide(whole)) <= 512);
    }
    // Without decay they are the weights of a homogeneous medium.
    T g = 1;
    auto state = transmittance_share_begin(height_fog_weight(T(0), T(1), T(0), T(0.125)));
    for (int texel = 1; texel < 64; ++texel) {
        g = transmittance_weight_next(g, transmittance_step(T(0.125), T(1), T(1)));
        state = transmittance_share_add(state, height_fog_weight(T(texel), T(texel + 1), T(0), T(0.125)));
        REQUIRE(state.share == doctest::Approx(double(g)).epsilon(200 * u<T>));
    }
    CHECK(transmittance_share_add(transmittance_share_begin(T(0)), T(0)).share == 1);
    CHECK(transmittance_share_add(transmittance_share_begin(T(0)), T(2)).share == 1);
    CHECK(transmittance_share_add(transmittance_share_begin(T(2)), std::numeric_limits<T>::infinity()).share == 0);
}

// Error: (64 + 16 (1 + optical depth) decay (before + length)) 2^-p.
TEST_CASE_TEMPLATE("the weight between two averages in fog is exact, and without decay that of a homogeneous medium", T,
                   float, double)
{
    bit_source bits(11);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const T before = T(bits.uniform(0, 100)), length = T(std::exp2(bits.uniform(0, 4))), f = T(bits.uniform(0, 1));
        const T decay = T(bits.chance(0.2) ? 0 : bits.uniform(-0.05, 0.05)), extinction = T(bits.uniform(0, 0.05));
        // The light from one distance to another, relative to the transmittance up to the first.
        const auto amount = [&](wide from, wide to) {
            const wide rate = wide(decay);
            return decay == 0 ? to - from : std::exp(-rate * from) * -std::expm1(-rate * (to - from)) / rate;
        };
        const auto light = [&](wide from, wide to) {
            const wide rate = wide(extinction);
            return rate > 0 ? -std::expm1(-rate * amount(from, to)) / rate : amount(from, to);
        };
        const wide start = wide(before), end = start + wide(f) * wide(length), whole = start + wide(length);
        const wide exact = light(start, end) * light(0, whole) / (light(0, end) * light(start, whole));
        const T found = height_fog_weight_between(before, length, f, decay, extinction);
        const double reach = std::abs(double(decay)) * double(whole);
        const double allowed = 64 + 16 * (1 + double(wide(extinction) * amount(0, whole))) * reach;
        REQUIRE(std::abs(double(wide(found) - exact)) <= allowed * u<T>);
        if (decay == 0)
            REQUIRE(std::abs(double(found) - double(transmittance_weight_between(before, length, f, extinction))) <=
                    64 * u<T>);
    }
}
