// The view of a camera on motion: segments against samples in time, and the near plane.
#include "renderer/shade/moving_view.hpp"

#include "moving_boxes.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

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
