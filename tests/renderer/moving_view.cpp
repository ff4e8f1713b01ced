// The view of a camera on motion: segments against samples in time, and the near plane.
#include "renderer/shade/moving_view.hpp"

#include "moving_boxes.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

using namespace gnomon;
using namespace gnomon::renderer;
using namespace gnomon::test;

TEST_CASE("samples in time see what the camera's segments say")
{
    const moving_scene world = moving_boxes(7, 8);
    const moving_camera eye{
        perspective_view_from({2, 5, 6}, {0, 0, 0}, bounds_of(world).corners(), glm::radians(45.0), 1.5)};
    constexpr int width = 60, height = 40, samples = 16;
    const seen_motion analytic = camera_segments(world, eye, width, height, 1e-4f);
    const seen_motion stochastic = stochastic_visibility(world, eye, width, height, samples);
    int asked = 0, other = 0;
    for (std::size_t pixel = 0; pixel < std::size_t(width * height); ++pixel) {
        float whole = 0;
        for (const seen_segment& c : analytic(pixel)) whole += c.weight;
        CHECK(whole <= 1.0001f);
        for (const seen_segment& s : stochastic(pixel)) {
            CHECK(s.weight == 1.0f / samples);
            ++asked;
            bool same = false;
            for (const seen_segment& c : analytic(pixel)) {
                if (!(c.t0 <= s.t0 && s.t0 <= c.t1) || c.triangle != s.triangle) continue;
                const float passed = (s.t0 - c.t0) / std::max(c.t1 - c.t0, 1e-9f);
                same |= glm::distance(glm::mix(c.p0, c.p1, passed), s.p0) < 2e-3f;
            }
            other += !same;
        }
    }
    CHECK(asked > width * height * samples / 2);
    // At the ends of segments and where two surfaces meet, rounding decides.
    CHECK(other < asked / 500);
}

// Five standard errors of the mean product of two independent numbers, uniform in [-1/2, 1/2].
TEST_CASE("a camera's times are independent of those of a map of the same seed, and of those of another seed")
{
    const moving_scene world = moving_boxes(8, 0);
    const moving_camera above = light_of(world, false);
    constexpr int size = 96, samples = 4;
    for (const std::uint32_t seed : {0u, 7u}) {
        const sample_picture map =
            rasterize_samples(world, above, size, size, {samples, seed, sample_pattern::centres});
        const seen_motion one = stochastic_visibility(world, above, size, size, samples, seed),
                          other = stochastic_visibility(world, above, size, size, samples, seed + 1);
        double with_map = 0, with_other = 0;
        int compared = 0;
        for (std::size_t pixel = 0; pixel < std::size_t(size) * size; ++pixel) {
            if (one(pixel).size() != samples || other(pixel).size() != samples) continue;
            for (std::size_t k = 0; k < samples; ++k, ++compared) {
                const auto jitter = [&](float t) { return samples * double(t) - double(k) - 0.5; };
                const double mine = jitter(one(pixel)[k].t0);
                with_map += mine * jitter(map.of[pixel * samples + k].t);
                with_other += mine * jitter(other(pixel)[k].t0);
            }
        }
        CHECK(compared > 1000);
        CHECK(std::abs(with_map) < 5.0 / 12 * std::sqrt(double(compared)));
        CHECK(std::abs(with_other) < 5.0 / 12 * std::sqrt(double(compared)));
    }
}

TEST_CASE("nothing behind the eye or in front of the near plane is seen")
{
    const moving_scene world = moving_boxes(8, 0);
    // Level, a little above the ground, in the midst of it.
    const moving_camera eye{
        perspective_view_from({0, 0.5, 0}, {0, 0.5, -5}, bounds_of(world).corners(), glm::radians(60.0), 1)};
    const seen_motion seen = camera_segments(world, eye, 64, 64, 0);
    for (std::size_t pixel = 0; pixel < 64 * 64; ++pixel) {
        const std::size_t y = pixel / 64;
        if (y < 31) REQUIRE(seen(pixel).empty());
        if (y > 40) REQUIRE(!seen(pixel).empty());
        for (const seen_segment& c : seen(pixel)) REQUIRE(c.p0.y == doctest::Approx(0).epsilon(1e-3));
    }
}
