// Time-dependent shadow maps: the dynamic bias within its error, and surfaces that must not shadow themselves.
#include "receiver_cases.hpp"
#include "support/climber.hpp"

#include <gnomon/motion/receiver/time_dependent.h>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A tilted plane that moves along: its depth at a place and a time.
struct moving_plane {
    double slope_x, slope_y, d_x, d_y, d_z;

    double operator()(double x, double y, double t) const
    {
        return slope_x * (x - d_x * t) + slope_y * (y - d_y * t) + d_z * t;
    }
    double slope() const { return std::hypot(slope_x, slope_y); }
    /// The texel of the point that is seen at a place and a time.
    template <class T> time_dependent_sample<T> at(double x, double y, double t) const
    {
        return {T((*this)(x, y, t)), T(t), T(d_z), time_dependent_travel(T(d_x), T(d_y))};
    }
};

const double diagonal = std::sqrt(2.0);

/// Distance by which the third depth is in front of a receiver on the plane, over the largest rounding. The receiver and the
/// sample lie in one texel, or in 2 x 2.
template <class T> double in_front(const std::vector<double>& p, double across)
{
    const auto signed_unit = [&](std::size_t i) { return 2 * p[i] - 1; };
    const double steep = std::exp2(8 * p[0] - 8), fast = std::exp2(10 * p[1]);
    const moving_plane plane{steep * signed_unit(2), steep * signed_unit(3), fast * signed_unit(4),
                             fast * signed_unit(5), signed_unit(6)};
    const double x = across * signed_unit(7), y = across * signed_unit(8), t = p[9], t_r = p[10];
    const T z_f = T(plane(x, y, t_r));
    const auto s = plane.at<T>(0, 0, t);
    const T z = time_dependent_biased_depth(s, T(t_r), T(plane.slope()), T(across * diagonal));
    const double size = std::abs(double(z_f)) + std::abs(double(s.z)) + std::abs(plane.d_z) +
                        plane.slope() * (across * diagonal + double(s.travel)) * 2;
    return (double(z_f) - double(z)) / (size * double(rounding<T>));
}

} // namespace

TEST_CASE_TEMPLATE("time_dependent: within the stated errors", T, float, double)
{
    bit_source bits(41);
    double travel = 0, depth = 0, biased = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T d_x = T(std::exp2(bits.uniform(-10, 10))), d_y = T(bits.uniform(-1024, 1024));
        const wide length = std::hypot(wide(d_x), wide(d_y));
        travel =
            std::max(travel, double(std::abs(wide(time_dependent_travel(d_x, d_y)) - length) / length / rounding<T>));
        const time_dependent_sample<T> s{T(bits.uniform(-1, 1)), T(bits.uniform(0, 1)), T(bits.uniform(-2, 2)),
                                         T(std::exp2(bits.uniform(-8, 8)))};
        const T t = T(bits.uniform(0, 1)), slope = T(std::exp2(bits.uniform(-12, 0))), texels = T(bits.uniform(0, 3));
        const wide lag = wide(t) - wide(s.t), moved = wide(s.z) + wide(s.d_z) * lag;
        const wide limit = rounding<T> * (std::abs(wide(s.z)) + 4 * std::abs(wide(s.d_z)));
        const wide bias = wide(slope) * (wide(texels) + 1.5L * wide(s.travel) * std::abs(lag));
        depth = std::max(depth, double(std::abs(wide(time_dependent_depth(s, t)) - moved) / limit));
        biased =
            std::max(biased, double(std::abs(wide(time_dependent_biased_depth(s, t, slope, texels)) - moved - bias) /
                                    (2 * limit + 8 * rounding<T> * bias)));
    }
    CHECK_MESSAGE(travel <= 3, travel);
    CHECK_MESSAGE(depth <= 1, depth);
    CHECK_MESSAGE(biased <= 1, biased);
    CHECK(travel > 0.75);
    CHECK(depth > 0.25);
    CHECK(biased > 0.25);
}

TEST_CASE_TEMPLATE("time_dependent: a moving plane never shadows itself, climbed", T, float, double)
{
    for (const double across : {1.0, 1.5}) {
        const summit found =
            climb(11, 200'000, 5, [&](const std::vector<double>& p) { return in_front<T>(p, across); });
        CHECK_MESSAGE(found.score <= 8, found.score);
    }
}

TEST_CASE("time_dependent: a bias for slope or for motion in depth alone lets planes shadow themselves")
{
    CHECK(rc::check("the depth of each kind, of a plane that moves along its slope", [](std::uint64_t seed) {
        bit_source bits(seed);
        const moving_plane plane{0.01, 0, bits.uniform(-200, -100), 0, bits.uniform(-1, 0)};
        const double t = bits.uniform(0, 0.75), t_r = t + bits.uniform(0.1, 0.25);
        const auto s = plane.at<double>(0.5, 0.5, t);
        const double z_f = plane(0.5, 0.5, t_r), bias = plane.slope() * diagonal;
        RC_ASSERT(time_dependent_depth(s, t_r) + bias < z_f);
        RC_ASSERT(time_dependent_biased_depth(s, t_r, plane.slope(), diagonal) >= z_f);
    }));
}

TEST_CASE_TEMPLATE("time_dependent: without motion all depths are the sample's own, and what is unknown is lit", T,
                   float, double)
{
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    const time_dependent_sample<T> s{T(-0.25), T(0.5), T(0), T(0)}, background{T(1), T(0.5), T(0), T(0)};
    const auto shadow = [](T z, T z_f) {
        return percentage_closer_end(percentage_closer_add(percentage_closer_begin(z_f), z, T(1)));
    };
    for (const T t : {T(0), T(0.5), T(1)}) {
        CHECK(time_dependent_depth(s, t) == s.z);
        CHECK(time_dependent_biased_depth(s, t, T(0), T(1)) == s.z);
        CHECK(time_dependent_biased_depth(s, t, T(-1), T(1)) == s.z);
        CHECK(time_dependent_biased_depth(s, t, T(0.125), T(2)) == T(0));
        for (const T z_f : {T(1), T(2), std::numeric_limits<T>::infinity()})
            CHECK(shadow(time_dependent_biased_depth(background, t, T(0.5), T(1)), z_f) == 0);
        CHECK(shadow(time_dependent_biased_depth(s, t, nan, T(1)), T(1)) == 0);
    }
    CHECK(shadow(time_dependent_depth(s, nan), T(1)) == 0);
    CHECK(shadow(time_dependent_depth({nan, T(0), T(0), T(0)}, T(0)), T(1)) == 0);
    CHECK(shadow(time_dependent_depth(s, T(0)), T(0)) == 1);
}
