// Time moments of ranges: those of dense sampling and, within the stated error, of the integral; the bounds that they
// give enclose the shadow of a static receiver.
#include "../receiver/receiver_cases.hpp"
#include "support/effort.hpp"
#include "support/oracle.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/motion/range/range_moments.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> std::array<T, 4> numbers(const moments4<T>& b) { return {b.b1, b.b2, b.b3, b.b4}; }

template <class T> moments4<T> moments_of(const std::vector<depth_time_range<T>>& list)
{
    range_moments4<T> state = range_moments4_begin(T(1));
    for (const auto& r : list) state = range_moments4_add(state, r);
    return range_moments4_end(state);
}

/// Integral of z^j over the shutter interval, 1 where there is no range, by the antiderivative in 120 digits.
template <class T> high exact_moment(const std::vector<depth_time_range<T>>& list, int j)
{
    high sum = 0, covered = 0;
    for (const auto& r : list) {
        const high duration = high(r.t1) - high(r.t0), a = r.z0, b = r.z1;
        covered += duration;
        sum += duration * (a == b ? pow(a, j) : (pow(b, j + 1) - pow(a, j + 1)) / ((j + 1) * (b - a)));
    }
    return sum + 1 - covered;
}

} // namespace

TEST_CASE_TEMPLATE("range_moments: within the stated error of the integral", T, float, double)
{
    bit_source bits(31);
    double worst_mean = 0, worst_list = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const auto b = numbers(moments_of(list));
        depth_time_range<T> one = list[0];
        if (bits.chance(0.3)) one.z1 = one.z0 + T(std::exp2(bits.uniform(-30, -5))); // nearly level
        one.t0 = 0, one.t1 = 1;
        const auto mean = numbers(range_mean_moments4(one));
        for (int j = 1; j <= 4; ++j) {
            const std::size_t k = std::size_t(j) - 1;
            const high of_list = abs(high(b[k]) - exact_moment(list, j));
            const high of_one = abs(high(mean[k]) - exact_moment<T>({one}, j));
            worst_list = std::max(worst_list, double(of_list) / double(rounding<T>) / double(list.size()));
            worst_mean = std::max(worst_mean, double(of_one) / double(rounding<T>));
        }
    }
    CHECK_MESSAGE(worst_mean <= 4, worst_mean);
    CHECK_MESSAGE(worst_list <= 8, worst_list);
}

TEST_CASE("range_moments: the mean over times, for any list")
{
    CHECK(rc::check("powers of depth at a hundred thousand times", [](std::uint64_t seed) {
        bit_source bits(seed);
        const auto list = resolved_list<double>(bits);
        constexpr int times = 100'000;
        std::array<double, 4> sums{};
        for (int k = 0; k < times; ++k) {
            const double t = (k + 0.5) / times;
            double z = 1;
            for (const auto& r : list)
                if (r.t0 <= t && t < r.t1) z = range_depth(r, t);
            double power = 1;
            for (double& sum : sums) sum += (power *= z) / times;
        }
        const auto b = numbers(moments_of(list));
        for (std::size_t j = 0; j < 4; ++j) RC_ASSERT(std::abs(b[j] - sums[j]) <= 2.0 * 14 / times);
    }));
}

TEST_CASE("range_moments: bounds enclose the shadow of a static receiver")
{
    CHECK(rc::check("lower and upper of Hamburger's problem around the closed form", [](std::uint64_t seed) {
        bit_source bits(seed);
        const auto list = resolved_list<double>(bits);
        const auto factored = hankel4_from_moments(moments_of(list));
        for (int k = 0; k < 16; ++k) {
            const double z = bits.uniform(-1, 1);
            static_receiver<double> state = static_receiver_begin(z, double(range_nothing), 0.0, 1.0);
            for (const auto& r : list) state = add_range(state, r, box_shutter{});
            const double shadow = static_receiver_end(state);
            const auto bounds = hamburger4_bounds(factored, z);
            RC_ASSERT(bounds.lower <= shadow + 1e-6);
            RC_ASSERT(shadow <= bounds.upper + 1e-6);
        }
    }));
}

TEST_CASE_TEMPLATE("range_moments: nothing is the background, and what is unknown adds nothing", T, float, double)
{
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    for (const T x : numbers(moments_of<T>({}))) CHECK(x == 1);
    for (const depth_time_range<T>& r : {depth_time_range<T>{T(0), T(1), nan, T(0), T(1)},
                                         {T(0), nan, T(0), T(0), T(1)},
                                         {T(0.5), T(0.25), T(0), T(0), T(1)}})
        for (const T x : numbers(moments_of<T>({r}))) CHECK(x == 1);
    for (const T x : numbers(moments_of<T>({{T(-1), T(2), T(0), T(0), T(1)}}))) CHECK(x == 0);
    CHECK(numbers(moments_of<T>({{T(-1), T(2), T(0.5), T(0.5), T(1)}}))[1] == T(0.25)); // one shutter interval of three
    CHECK(numbers(moments_of<T>({{T(0.25), T(0.75), T(-1), T(1), T(1)}}))[0] == T(0.5));
}
