// The comparator, Algorithm 1 as printed: accurate in double for distributions with enough depths, total everywhere,
// and in float less accurate than the default routes on the same moments.
#include "support/distributions.hpp"
#include "support/effort.hpp"
#include "support/moments_of.hpp"
#include "support/statistics.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/moments/bias.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <doctest/doctest.h>

#include <bit>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Calls f(moments, receiver) for distributions of every family.
template <class F> void for_each_sample(F f)
{
    distribution_source source(20170202);
    for (int k = 0; k < family_count; ++k)
        for (std::int64_t i = 0; i < effort(4000); ++i) {
            const distribution d = source.draw(family(k));
            f(moments_of<6>(d), source.receiver(d));
        }
}

} // namespace

// In double the two routes share only the biased moments. A bias of weight alpha keeps the last pivot above alpha r,
// with r from bias.h, so a rounding u of a moment is at most u / (alpha r) of the pivot: 1e-12 for four and 7e-12 for
// six moments at alpha = 1e-3. The tolerance is three times that.
TEST_CASE("Algorithm 1 agrees with the default routes in double")
{
    double worst4 = 0, worst6 = 0;
    for_each_sample([&](const auto& b, double z) {
        const auto b4 = moments4_add_bias(moments4_in<double>(b), bias4_raw_b2, bias4_raw_b4, 1e-3);
        const auto b6 = moments6_add_bias(moments6_in<double>(b), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6, 1e-3);
        worst4 = std::max(
            worst4, std::abs(hamburger4_cholesky_intensity(b4, z) - hamburger4_lower(hankel4_from_moments(b4), z)));
        worst6 = std::max(
            worst6, std::abs(hamburger6_cholesky_intensity(b6, z) - hamburger6_lower(hankel6_from_moments(b6), z)));
    });
    MESSAGE("largest difference: four moments ", worst4, ", six moments ", worst6);
    CHECK(worst4 < 3e-12);
    CHECK(worst6 < 2.1e-11);
}

TEST_CASE("in float, Algorithm 1 has more than ten times the rounding error of the default routes")
{
    error_sample paper4, default4, paper6, default6;
    const auto paper_route4 = []<class Real>(const moments4<Real>& b, Real z) {
        return double(hamburger4_cholesky_intensity(
            moments4_add_bias(b, Real(bias4_raw_paper_b2), Real(bias4_raw_paper_b4), Real(stored4_float_weight)), z));
    };
    const auto paper_route6 = []<class Real>(const moments6<Real>& b, Real z) {
        return double(hamburger6_cholesky_intensity(moments6_add_bias(b, Real(bias6_paper_b2), Real(bias6_paper_b4),
                                                                      Real(bias6_paper_b6), Real(stored6_float_weight)),
                                                    z));
    };
    const auto default_route4 = []<class Real>(const moments4<Real>& b, Real z) {
        return double(hamburger4_lower(hankel4_from_float(channels4_from_moments(b)), z));
    };
    const auto default_route6 = []<class Real>(const moments6<Real>& b, Real z) {
        return double(hamburger6_lower(hankel6_from_float(channels6_from_moments(b)), z));
    };
    for_each_sample([&](std::array<double, 6> b, double z) {
        for (double& moment : b) moment = double(float(moment));
        z = double(float(z));
        const auto error = [&](auto route, const auto& in_float, const auto& in_double) {
            return std::abs(route(in_float, float(z)) - route(in_double, z));
        };
        paper4.add(error(paper_route4, moments4_in<float>(b), moments4_in<double>(b)));
        paper6.add(error(paper_route6, moments6_in<float>(b), moments6_in<double>(b)));
        default4.add(error(default_route4, moments4_in<float>(b), moments4_in<double>(b)));
        default6.add(error(default_route6, moments6_in<float>(b), moments6_in<double>(b)));
    });
    MESSAGE("p99 of the error, Algorithm 1 and default: four moments ", paper4.quantile(0.99), " and ",
            default4.quantile(0.99), ", six moments ", paper6.quantile(0.99), " and ", default6.quantile(0.99));
    CHECK(default4.quantile(0.99) < 0.1 * paper4.quantile(0.99));
    CHECK(default6.quantile(0.99) < 0.1 * paper6.quantile(0.99));
}

TEST_CASE_TEMPLATE("Algorithm 1 returns an intensity in [0, 1] for any input", Real, float, double)
{
    using limits = std::numeric_limits<Real>;
    using bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    std::mt19937_64 random(20170203);
    const std::array<Real, 8> special{Real(0),
                                      -Real(0),
                                      Real(1),
                                      Real(-1),
                                      limits::infinity(),
                                      -limits::infinity(),
                                      limits::quiet_NaN(),
                                      limits::denorm_min()};
    const auto draw = [&] {
        const std::uint64_t r = random();
        if (r % 4 == 0) return special[(r >> 8) % special.size()];
        return std::bit_cast<Real>(static_cast<bits>(r));
    };
    for (std::int64_t i = 0; i < effort(1000000); ++i) {
        const Real b1 = draw(), b2 = draw(), b3 = draw(), b4 = draw(), b5 = draw(), b6 = draw(), z = draw();
        const Real four_moments = hamburger4_cholesky_intensity(moments4<Real>{b1, b2, b3, b4}, z);
        const Real six_moments = hamburger6_cholesky_intensity(moments6<Real>{b1, b2, b3, b4, b5, b6}, z);
        REQUIRE((four_moments >= 0 && four_moments <= 1));
        REQUIRE((six_moments >= 0 && six_moments <= 1));
    }
    // A cleared map and a single depth: the algorithm has no answer, the kernel returns lit.
    CHECK(hamburger4_cholesky_intensity(moments4<Real>{0, 0, 0, 0}, Real(0.5)) == 0);
    CHECK(hamburger6_cholesky_intensity(moments6<Real>{0, 0, 0, 0, 0, 0}, Real(0.5)) == 0);
}
