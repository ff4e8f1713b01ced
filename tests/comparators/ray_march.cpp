// Ray marching against the integral that it stands for, and its jitter.
#include "support/effort.hpp"
#include "support/situations.hpp"

#include <gnomon/comparators/ray_march.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A shadow over parts of a ray of length 1: from, to, from, to, ... in order.
struct shadowed_ray {
    std::vector<double> ends;
    double extinction;

    [[nodiscard]] bool is_shadowed(double t) const
    {
        return (std::upper_bound(ends.begin(), ends.end(), t) - ends.begin()) % 2 == 1;
    }
    /// Light scattered up to t, which a series gives where little is absorbed.
    [[nodiscard]] double light(double t) const
    {
        return extinction > 0 ? -std::expm1(-extinction * t) / extinction : t;
    }
    [[nodiscard]] double intensity() const
    {
        double sum = 0;
        for (std::size_t k = 0; k < ends.size(); ++k) sum += (k % 2 == 1 ? 1 : -1) * light(ends[k]);
        return sum / light(1);
    }
};

shadowed_ray any_ray(bit_source& bits)
{
    shadowed_ray r{{}, bits.chance(0.2) ? 0 : std::exp2(bits.uniform(-8, 6))};
    for (int k = 0; k < 6; ++k) r.ends.push_back(bits.uniform(0, 1));
    std::sort(r.ends.begin(), r.ends.end());
    return r;
}

template <class T> T marched(const shadowed_ray& ray, int steps, double jitter)
{
    ray_march<T> state = ray_march_begin(T(std::exp(-ray.extinction / steps)));
    for (int k = 0; k < steps; ++k)
        state = ray_march_add(state, T(ray.is_shadowed((k + jitter) / steps) ? -0.5 : 0.5), T(0));
    return ray_march_end(state);
}

} // namespace

// Only steps in which the shadow begins or ends are wrong, each by its weight at most, and the first weighs most.
TEST_CASE("ray marching converges to the integral")
{
    bit_source bits(20170501);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(400); ++i) {
        const shadowed_ray ray = any_ray(bits);
        for (const int steps : {16, 32, 128, 1024}) {
            const double bound = 6 * ray.light(1.0 / steps) / ray.light(1);
            const double jitter = bits.uniform(0, 1), exact = ray.intensity();
            REQUIRE(std::abs(marched<double>(ray, steps, jitter) - exact) <= bound + 1e-12);
            worst = std::max(
                worst, std::abs(double(marched<float>(ray, steps, jitter)) - marched<double>(ray, steps, jitter)) /
                           (steps * 0x1p-24));
        }
    }
    MESSAGE("largest error of float, in n 2^-24: ", worst);
    CHECK(worst <= 3);
}

TEST_CASE("the mean over jitters converges faster, since its steps are blurred")
{
    bit_source bits(4);
    double one = 0, mean = 0;
    for (std::int64_t i = 0; i < effort(20000); ++i) {
        const shadowed_ray ray = any_ray(bits);
        double sum = 0;
        for (int k = 0; k < 16; ++k) sum += marched<double>(ray, 16, (k + 0.5) / 16) / 16;
        one = std::max(one, std::abs(marched<double>(ray, 16, 0.5) - ray.intensity()));
        mean = std::max(mean, std::abs(sum - ray.intensity()));
    }
    CHECK(mean < one / 2);
}

TEST_CASE("what is lit or shadowed throughout is so exactly, for any air")
{
    for (const float step : {0.f, 0x1p-120f, 0.5f, 0.999f, 1.f, 2.f, -1.f, float(no_number)}) {
        for (const float z : {-1.f, 1.f}) {
            ray_march<float> state = ray_march_begin(step);
            CHECK(ray_march_end(state) == 0);
            for (int k = 0; k < 100; ++k) state = ray_march_add(state, z, 0.f);
            CHECK(ray_march_end(state) == (z < 0 ? 1.f : 0.f));
        }
    }
    ray_march<float> state = ray_march_begin(1.f);
    state = ray_march_add(state, float(no_number), 1.f);
    state = ray_march_add(state, -1.f, float(no_number));
    state = ray_march_add(state, -1.f, 0.f);
    state = ray_march_add(state, -1.f, 0.f);
    CHECK(ray_march_end(state) == 0.5f);
}

TEST_CASE("jitters of neighbours lie evenly in [0, 1)")
{
    double unevenness = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x) {
            std::vector<float> around;
            for (int k = 0; k < 9; ++k) around.push_back(ray_march_jitter(float(x + k % 3), float(y + k / 3)));
            std::sort(around.begin(), around.end());
            REQUIRE((around.front() >= 0 && around.back() < 1));
            double gap = double(around.front() + 1 - around.back());
            for (std::size_t k = 1; k < 9; ++k) gap = std::max(gap, double(around[k] - around[k - 1]));
            unevenness = std::max(unevenness, gap);
        }
    MESSAGE("largest gap between jitters of 3 x 3 pixels: ", unevenness, " where 1/9 is the least");
    CHECK(unevenness < 0.25); // of nine random numbers it is 0.31 on average
    CHECK(ray_march_jitter(float(no_number), 3.f) == ray_march_jitter(65536.f, 3.f));
    bit_source bits(5);
    for (std::int64_t i = 0; i < effort(100000); ++i) {
        const float jitter = ray_march_jitter(float(any_number<float>(bits)), float(any_number<float>(bits)));
        REQUIRE((jitter >= 0 && jitter < 1));
    }
}
