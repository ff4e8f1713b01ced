// Time-dependent shadow maps: slices of a map of samples, look-ups against their definition, and a ramp that rises
// towards the light and must not shadow itself.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/time_dependent.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Samples of a map, made by f(x, y, t) from places and stratified times.
struct samples {
    std::size_t width, height, each;
    std::vector<stochastic_sample<float>> of;

    template <class F>
    samples(bit_source& bits, std::size_t w, std::size_t h, std::size_t n, const F& f) : width(w), height(h), each(n)
    {
        for (std::size_t i = 0; i < w * h * n; ++i) {
            const float x = float(i / n % w) + float(bits.uniform(0, 1)),
                        y = float(i / n / w) + float(bits.uniform(0, 1));
            of.push_back(f(x, y, stratified_time(float(i % n), float(n), float(bits.uniform(0, 1)))));
        }
    }
    sample_map<float> map() const { return {width, height, each, of}; }
};

template <class Texel> std::vector<Texel> texels_of(const samples& from)
{
    std::vector<Texel> result(from.of.size());
    fill_time_dependent(from.map(), std::span(result));
    return result;
}

template <class Texel>
float shadow(const samples& from, const std::vector<Texel>& texels, const time_dependent_receiver<float>& r,
             int look_ups)
{
    return time_dependent_intensity(time_dependent_map<Texel>{from.width, from.height, from.each, texels}, r, look_ups);
}

/// Percentage-closer filtering of one slice by its definition, K of 0 for the nearest texel.
float filtered(const samples& from, const time_dependent_receiver<float>& r, int look_ups, float bias)
{
    const std::size_t slice = std::min(std::size_t(r.t * float(from.each)), from.each - 1);
    double sum = 0;
    for (std::size_t y = 0; y < from.height; ++y)
        for (std::size_t x = 0; x < from.width; ++x) {
            double weight = 0;
            const double u = double(r.x) - double(x), v = double(r.y) - double(y);
            if (look_ups == 0) weight = 0 <= u && u < 1 && 0 <= v && v < 1;
            for (int j = 0; j < look_ups; ++j)
                for (int i = 0; i < look_ups; ++i) {
                    const double a = std::abs(u - 0.5 + i - 0.5 * (look_ups - 1));
                    const double b = std::abs(v - 0.5 + j - 0.5 * (look_ups - 1));
                    weight += std::max(1 - a, 0.0) * std::max(1 - b, 0.0) / (look_ups * look_ups);
                }
            if (from.map()(x, y)[slice].z + bias < std::min(r.z, 1.f)) sum += weight;
        }
    return float(sum);
}

/// A tilted plane that rises towards the light and moves over the map, as Figure 10 of Andersson et al. 2015.
constexpr float ramp_slope = 0.01f, ramp_d_x = -100, ramp_d_z = -0.4f;
float ramp_depth(float x, float t) { return ramp_slope * (x - ramp_d_x * t) + ramp_d_z * t - 0.5f; }

/// The share of receivers on the ramp that are in shadow, by 4 samples of the map.
template <class Texel> double ramp_acne(int look_ups)
{
    bit_source bits(5);
    const samples from(bits, 48, 48, 4, [](float x, float y, float t) {
        return stochastic_sample<float>{x, y, t, ramp_depth(x, t), ramp_d_x, 0, ramp_d_z, 7};
    });
    const auto texels = texels_of<Texel>(from);
    double sum = 0;
    constexpr int receivers = 20'000;
    for (int i = 0; i < receivers; ++i) {
        const float x = float(bits.uniform(4, 44)), y = float(bits.uniform(4, 44)), t = float(bits.uniform(0, 1));
        sum += double(shadow(from, texels, {x, y, ramp_depth(x, t) - 1e-6f, t, ramp_slope}, look_ups));
    }
    return sum / receivers;
}

} // namespace

TEST_CASE("time_dependent: without motion every kind of texel is percentage-closer filtering of one slice")
{
    CHECK(rc::check("random depths, receivers at any time, K of 0 to 3", [](std::uint64_t seed) {
        bit_source bits(seed);
        const samples from(bits, 1 + bits.below(6), 1 + bits.below(6), 1 + bits.below(5),
                           [&](float x, float y, float t) {
                               return stochastic_sample<float>{x, y, t, float(bits.uniform(-1, 1)), 0, 0, 0, 1};
                           });
        const auto depths = texels_of<slice_depth<float>>(from);
        const auto motions = texels_of<slice_motion<float>>(from);
        const auto all = texels_of<time_dependent_sample<float>>(from);
        for (int i = 0; i < 20; ++i) {
            const int look_ups = int(bits.below(4));
            const time_dependent_receiver<float> r{float(bits.uniform(-2, 8)), float(bits.uniform(-2, 8)),
                                                   float(bits.uniform(-1, 1)), float(bits.uniform(0, 1)),
                                                   bits.chance(0.5) ? 0 : float(bits.uniform(0, 0.1))};
            const float bias = r.slope * std::sqrt(2.f) * (0.5f * float(look_ups) + 1);
            const float found = shadow(from, depths, r, look_ups);
            RC_ASSERT(shadow(from, motions, r, look_ups) == found);
            RC_ASSERT(shadow(from, all, r, look_ups) == found);
            RC_ASSERT(std::abs(found - filtered(from, r, look_ups, bias)) <= 1e-5f);
        }
    }));
}

TEST_CASE("time_dependent: a lit ramp is lit with the bias for slope and motion, and with no other")
{
    for (const int look_ups : {0, 1}) {
        CHECK(ramp_acne<time_dependent_sample<float>>(look_ups) == 0);
        CHECK(ramp_acne<slice_motion<float>>(look_ups) > 0.2);
        CHECK(ramp_acne<slice_depth<float>>(look_ups) > 0.2);
    }
}

TEST_CASE("time_dependent: the mean over receiver times is the covered time of an occluder")
{
    // A caster covers the map from time 0.3 to 0.8; map and camera have unlike numbers of samples.
    bit_source bits(6);
    for (const std::size_t slices : {4u, 8u, 20u}) {
        double sum = 0, squares = 0;
        constexpr int runs = 400, camera = 16;
        for (int run = 0; run < runs; ++run) {
            const samples from(bits, 4, 4, slices, [](float x, float y, float t) {
                return 0.3f <= t && t < 0.8f ? stochastic_sample<float>{x, y, t, -0.5f, 0, 0, 0, 1}
                                             : stochastic_background(x, y, t);
            });
            const auto texels = texels_of<slice_depth<float>>(from);
            double mean = 0;
            for (int k = 0; k < camera; ++k)
                mean += double(shadow(
                            from, texels,
                            {2, 2, 0.5f, stratified_time(float(k), float(camera), float(bits.uniform(0, 1))), 0}, 1)) /
                        camera;
            sum += mean / runs, squares += mean * mean / runs;
        }
        const double error = std::sqrt((squares - sum * sum) / runs);
        CHECK(std::abs(sum - 0.5) <= 4 * error + 1e-3);
    }
}

TEST_CASE("time_dependent: unknown samples and receivers are lit, and shapes are checked")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    bit_source bits(7);
    const samples from(bits, 2, 2, 2, [](float x, float y, float t) {
        return stochastic_sample<float>{x, y, t, x < 1 ? nan : -0.5f, 0, 0, y < 1 ? nan : 0, 0};
    });
    const auto texels = texels_of<time_dependent_sample<float>>(from);
    CHECK(shadow(from, texels, {0.5f, 1.5f, 0.5f, 0.5f, 0}, 0) == 0);
    CHECK(shadow(from, texels, {1.5f, 0.5f, 0.5f, 0.5f, 0}, 0) == 0);
    CHECK(shadow(from, texels, {1.5f, 1.5f, 0.5f, 0.5f, 0}, 0) == 1);
    for (int i = 0; i < 5; ++i) {
        time_dependent_receiver<float> r{1.5f, 1.5f, 0.5f, 0.5f, 0};
        (i == 0 ? r.x : i == 1 ? r.y : i == 2 ? r.z : i == 3 ? r.t : r.slope) = nan;
        CHECK(shadow(from, texels, r, 0) == 0);
    }
    std::vector<slice_depth<float>> few(7);
    CHECK_THROWS_AS(fill_time_dependent(from.map(), std::span(few)), std::invalid_argument);
    CHECK_THROWS_AS(check_shape(time_dependent_map<slice_depth<float>>{2, 2, 2, few}, "test"), std::invalid_argument);
    CHECK_THROWS_AS(check_shape(time_dependent_map<slice_depth<float>>{2, 2, 0, few}, "test"), std::invalid_argument);
    CHECK_THROWS_AS(shadow(from, texels, {1, 1, 0, 0, 0}, -1), std::invalid_argument);
    CHECK_NOTHROW(check_shape(time_dependent_map<time_dependent_sample<float>>{2, 2, 2, texels}, "test"));
}
