// Cascades: weights that are 1 inside and fall to 0 at a border, blends of intensities, the index of the cascade to read,
// and splits of the frustum.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/filters/cascade.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("splits lie between the planes in order, with the stated error")
{
    bit_source bits(1);
    double error = 0;
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const float near_distance = float(std::exp2(bits.uniform(-6, 4)));
        const float far_distance = float(double(near_distance) * std::exp2(bits.uniform(0.1, 20)));
        const float evenness = float(bits.uniform(0, 1)), fraction = float(bits.uniform(0, 1));
        const exact near_exact = exact(near_distance), far_exact = exact(far_distance);
        const exact logarithmic = near_exact * std::pow(far_exact / near_exact, exact(fraction));
        const exact even = near_exact + exact(fraction) * (far_exact - near_exact);
        const exact want = logarithmic + exact(evenness) * (even - logarithmic);
        const float split = cascade_split(near_distance, far_distance, fraction, evenness);
        error = std::max(error, std::abs(double(exact(split) / want - 1)) / u<float>);
        const float later = cascade_split(near_distance, far_distance, std::min(fraction + 0.01f, 1.0f), evenness);
        REQUIRE(split <= later * (1 + 25 * float(u<float>)));
    }
    CHECK(error <= 25);
    CHECK(error > 1);
    CHECK(cascade_split(0.5, 100.0, 0.0, 0.3) == doctest::Approx(0.5));
    CHECK(cascade_split(0.5, 100.0, 1.0, 0.3) == doctest::Approx(100));
    CHECK(cascade_split(1.0, 100.0, 0.5, 0.0) == doctest::Approx(10));
    CHECK(cascade_split(1.0, 100.0, 0.5, 1.0) == doctest::Approx(50.5));
    CHECK(cascade_split(1.0, 100.0, not_a_number, not_a_number) == doctest::Approx(1));
}

TEST_CASE("weights are 1 inside, 0 beyond, and linear in the band")
{
    CHECK(cascade_weight_by_distance(3.0, 10.0, 2.0) == 1);
    CHECK(cascade_weight_by_distance(8.0, 10.0, 2.0) == 1);
    CHECK(cascade_weight_by_distance(9.0, 10.0, 2.0) == 0.5);
    CHECK(cascade_weight_by_distance(10.0, 10.0, 2.0) == 0);
    CHECK(cascade_weight_by_distance(infinity, 10.0, 2.0) == 0);
    for (const double none : {0.0, -1.0, not_a_number}) {
        CHECK(cascade_weight_by_distance(10.0, 10.0, none) == 1);
        CHECK(cascade_weight_by_distance(10.001, 10.0, none) == 0);
        CHECK(cascade_weight_by_projection(0.9, 0.5, 0.0, 0.1, none) == doctest::Approx(1));
        CHECK(cascade_weight_by_projection(0.95, 0.5, 0.0, 0.1, none) == 0);
    }
    CHECK(cascade_weight_by_projection(0.5, 0.5, 0.0, 0.05, 0.1) == 1);
    CHECK(cascade_weight_by_projection(0.5, 0.9, 0.0, 0.05, 0.1) == doctest::Approx(0.5));
    CHECK(cascade_weight_by_projection(0.1, 0.5, -1.0, 0.05, 0.1) == doctest::Approx(0.5));
    // Weight 0 within the reach of the filter, beyond the map and beyond its planes, and for a NaN.
    CHECK(cascade_weight_by_projection(0.96, 0.5, 0.0, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(7.0, 0.5, 0.0, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(0.5, 0.5, 1.001, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(0.5, 0.5, -1.001, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(not_a_number, 0.5, 0.0, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(0.5, not_a_number, 0.0, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_projection(0.5, 0.5, not_a_number, 0.05, 0.1) == 0);
    CHECK(cascade_weight_by_distance(not_a_number, 10.0, 2.0) == 0);
}

TEST_CASE_TEMPLATE("weights have at most their stated errors", T, float, double)
{
    bit_source bits(4);
    double by_distance = 0, by_projection = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T end = T(bits.uniform(1, 100)), band = T(exact(end) * exact(std::exp2(bits.uniform(-10, 0))));
        const T distance = T(exact(end) - exact(band) * exact(bits.uniform(0, 1)));
        const exact want = (exact(end) - exact(distance)) / exact(band);
        if (want <= 1)
            by_distance =
                std::max(by_distance, std::abs(double(exact(cascade_weight_by_distance(distance, end, band)) - want)) /
                                          (u<T> * double(exact(end) / exact(band))));
        const T margin = T(bits.uniform(0, 0.1)), edge = T(std::exp2(bits.uniform(-10, -2)));
        const T x = T(bits.uniform(0, 1)), y = T(bits.uniform(0, 1));
        const exact inside =
            (exact(0.5) - exact(margin)) - std::max(std::abs(exact(x) - exact(0.5)), std::abs(exact(y) - exact(0.5)));
        const exact weight = std::min(std::max(inside / exact(edge), exact(0)), exact(1));
        by_projection = std::max(
            by_projection, std::abs(double(exact(cascade_weight_by_projection(x, y, T(0), margin, edge)) - weight)) /
                               (u<T> / double(edge)));
    }
    for (const double error : {by_distance, by_projection}) {
        CHECK(error <= 2);
        CHECK(error > 0.2); // the measure sees errors
    }
}

TEST_CASE("a blend gives each cascade its share, and the mean over thresholds is the blend")
{
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(500); ++i) {
        // A receiver on its way through the bands of three cascades by distance, which do not overlap.
        const double d = bits.uniform(0, 40);
        const std::array<double, 3> weights{cascade_weight_by_distance(d, 6.0, 2.0),
                                            cascade_weight_by_distance(d, 15.0, 4.0),
                                            cascade_weight_by_distance(d, 35.0, 8.0)};
        const std::array<double, 3> intensities{bits.uniform(0, 1), bits.uniform(0, 1), bits.uniform(0, 1)};
        cascade_blend blend = cascade_begin(weights[0], intensities[0]);
        double want = weights[0] * intensities[0], rest = 1 - weights[0];
        for (std::size_t k = 1; k < 3; ++k) {
            const double share = cascade_share(blend, weights[k]);
            REQUIRE(share == doctest::Approx(rest * weights[k]));
            want += share * intensities[k], rest -= share;
            blend = cascade_add(blend, weights[k], intensities[k]);
        }
        REQUIRE(cascade_end(blend) == doctest::Approx(want));
        double mean = 0;
        constexpr int thresholds = 2000;
        for (int t = 0; t < thresholds; ++t) {
            cascade_index found = cascade_index_begin(weights[0], (t + 0.5) / thresholds);
            for (std::size_t k = 1; k < 3; ++k) found = cascade_index_add(found, weights[k], (t + 0.5) / thresholds);
            if (found.index < 3) mean += intensities[std::size_t(found.index)] / thresholds;
        }
        REQUIRE(std::abs(mean - want) <= 1.0 / thresholds);
    }
    CHECK(cascade_end(cascade_begin(0.0, 1.0)) == 0); // beyond every cascade: lit
    CHECK(cascade_end(cascade_begin(not_a_number, 1.0)) == 0);
    CHECK(cascade_end(cascade_begin(1.0, not_a_number)) == 0);
    CHECK(cascade_end(cascade_add(cascade_begin(1.0, 0.25), 1.0, 1.0)) == 0.25);
    CHECK(cascade_index_add(cascade_index_begin(0.0, 0.0), 1.0, 0.0).index == 1);
    CHECK(cascade_index_add(cascade_index_begin(not_a_number, 0.0), 0.0, 0.0).index == 2);
}

TEST_CASE_TEMPLATE("a blend of any cascades has at most its stated error", T, float, double)
{
    bit_source bits(3);
    double error = 0;
    constexpr int count = 6;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        cascade_blend<T> blend{};
        exact want = 0, rest = 1;
        for (int k = 0; k < count; ++k) {
            const T weight = T(bits.uniform(0, 1)), intensity = T(bits.uniform(0, 1));
            blend = k == 0 ? cascade_begin(weight, intensity) : cascade_add(blend, weight, intensity);
            want += rest * exact(weight) * exact(intensity), rest -= rest * exact(weight);
        }
        error = std::max(error, std::abs(double(exact(cascade_end(blend)) - want)) / u<T>);
    }
    CHECK(error <= 3 * count);
    CHECK(error > 0.5);
}
