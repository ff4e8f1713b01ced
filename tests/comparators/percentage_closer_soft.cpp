// The blocker search by samples is the mean of what is in front of the receiver, and is total.
#include "support/distributions.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/situations.hpp"

#include <gnomon/comparators/percentage_closer_soft.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> percentage_closer_blocker<T> search(const distribution& d, T z_f)
{
    percentage_closer_search<T> state = percentage_closer_search_begin(z_f);
    for (std::size_t i = 0; i < d.depths.size(); ++i)
        state = percentage_closer_search_add(state, T(d.depths[i]), T(d.weights[i]));
    return percentage_closer_search_end(state);
}

} // namespace

// Eq. 4 in extended precision. A sum of 81 weights rounds by 81 u, and so does that of distances, which are at most 2; the
// divisor is at least epsilon where nothing is in front, and the mean distance at most 2.
TEST_CASE("the mean blocker is that of Equation 4")
{
    distribution_source source(20170801);
    double worst = 0;
    for (int k = 0; k < family_count; ++k)
        for (std::int64_t i = 0; i < effort(4000); ++i) {
            const distribution d = source.draw(family(k));
            const double z_f = source.receiver(d);
            using wide = long double;
            wide weight = 0, sum = 0;
            for (std::size_t j = 0; j < d.depths.size(); ++j)
                if (d.depths[j] < z_f) weight += wide(d.weights[j]), sum += wide(d.weights[j]) * wide(d.depths[j]);
            const auto found = search(d, z_f);
            const wide mean = (1e-3L * wide(z_f) + sum) / (1e-3L + weight);
            worst = std::max(worst, double(std::abs(mean - wide(found.depth))));
            REQUIRE(std::abs(found.intensity - double(weight)) < 1e-13);
        }
    MESSAGE("largest difference ", worst);
    CHECK(worst < 4 * 81 * 0x1p-53 / 1e-3);
}

TEST_CASE("nothing in front leaves the receiver, and one blocker almost its own depth")
{
    CHECK(search<float>({{0.5, 1}, {0.5, 0.5}}, 0.25f).depth == 0.25f);
    CHECK(search<float>({{0.5, 1}, {0.5, 0.5}}, 0.25f).intensity == 0);
    const auto blocked = search<float>({{-0.5}, {1}}, 0.5f);
    CHECK(blocked.depth == doctest::Approx(0.5 - 1 / 1.001));
    CHECK(blocked.intensity == 1);
}

TEST_CASE("the search finds a depth in front of the receiver for any bits")
{
    bit_source bits(3);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (std::int64_t i = 0; i < effort(200000); ++i) {
        const float z_f = float(any_number<float>(bits));
        percentage_closer_search<float> state = percentage_closer_search_begin(z_f);
        for (int k = 0; k < 3; ++k)
            state = percentage_closer_search_add(state, float(any_number<float>(bits)), float(any_number<float>(bits)));
        const auto found = percentage_closer_search_end(state);
        const float receiver = std::isnan(z_f) ? 1.f : std::min(std::max(z_f, -1.f), 1.f);
        REQUIRE((found.depth >= -1 && found.depth <= receiver));
        REQUIRE((found.intensity >= 0 && found.intensity <= 1));
    }
    const auto one = [](float z_f, float z, float weight) {
        return percentage_closer_search_end(
            percentage_closer_search_add(percentage_closer_search_begin(z_f), z, weight));
    };
    CHECK(one(nan, -1, 1).depth == 1);
    CHECK(one(nan, -1, 1).intensity == 0);
    CHECK(one(0.5f, nan, 1).intensity == 0);
    CHECK(one(0.5f, inf, 1).depth == 0.5f);
    CHECK(one(0.5f, -inf, 1).depth == one(0.5f, -1, 1).depth);
    CHECK(one(0.5f, -1, nan).depth == 0.5f);
}
