// The traced reference of moving scenes: against static scenes at the same time, closed forms and the rasterizer.
#include "renderer/scene/moving_stages.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon::renderer;

TEST_CASE("at any time, a moving scene is traced as the static scene of that time")
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (const moving_stage& stage :
         {pillars(1.5), crossed_quads(1.5), random_cubes(1.5, 100, 2), cube_over_plane(1.5, 20, 2, 0), fan(1.5)}) {
        CAPTURE(stage.world.open.name);
        const tracer moving(stage.world);
        int compared = 0, shadowed = 0;
        for (int k = 0; k < 5; ++k) {
            const float t = k == 0 ? 0 : k == 1 ? 1 : uniform(random);
            const camera light = stage.light.at(double(t));
            const tracer fixed(scene_at(stage.world, t));
            // Rounding moves outlines by the offset at most; receivers near one, where five rays that start ten
            // offsets apart do not agree, are left out.
            const float margin = 10 * moving.offset();
            std::vector<receiver> receivers, probes;
            for (int i = 0; i < 2000; ++i) {
                const view_ray ray = ray_through(stage.eye.open, {uniform(random), uniform(random)});
                const hit seen = moving.first_hit(ray, t), expected = fixed.first_hit(ray, 0);
                if (!seen.valid() || seen.mesh != expected.mesh || seen.triangle != expected.triangle) continue;
                CHECK(glm::length(seen.position - expected.position) <= margin);
                CHECK(glm::dot(seen.normal, expected.normal) > 0.9999f);
                receivers.push_back({seen.position, seen.normal});
                const glm::vec3 side = std::abs(seen.normal.y) > 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
                const glm::vec3 u = margin * glm::normalize(glm::cross(seen.normal, side));
                const glm::vec3 v = glm::cross(seen.normal, u);
                for (const glm::vec3& step : {glm::vec3(0), u, -u, v, -v})
                    probes.push_back({expected.position + step, expected.normal});
            }
            std::vector<float> visible(receivers.size()), expected(probes.size());
            moving.visibility(stage.light, receivers, std::vector<float>(receivers.size(), t), visible);
            fixed.visibility(light, probes, expected);
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                const float* around = &expected[5 * i];
                if (std::count(around, around + 5, around[0]) != 5) continue;
                CHECK(visible[i] == around[0]);
                ++compared, shadowed += around[0] == 0;
            }
        }
        CHECK(compared > 2000);
        CHECK(shadowed > 20);
    }
}

TEST_CASE("hits lie on their rays and triangles, and their points move with the triangles")
{
    const moving_stage stage = cube_over_plane(1.5, 20, 2, 0);
    const tracer rays(stage.world);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0, 1);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const float t = uniform(random);
        const view_ray ray = ray_through(stage.eye.open, {uniform(random), uniform(random)});
        const hit seen = rays.first_hit(ray, t);
        if (!seen.valid()) continue;
        ++met;
        const glm::dvec3 way = glm::dvec3(seen.position) - ray.origin, along = glm::normalize(ray.direction);
        CHECK(glm::length(glm::cross(way, along)) < 2e-5);
        CHECK(glm::dot(glm::dvec3(seen.normal), along) < 0);
        CHECK(glm::length(seen.normal) == doctest::Approx(1));
        CHECK(seen.weights.x + seen.weights.y + seen.weights.z == doctest::Approx(1));
        const receiver_motion point = rays.receiver_of(seen, t);
        CHECK(glm::length(glm::mix(point.open.position, point.closing.position, t) - seen.position) < 1e-5f);
        CHECK(glm::dot(point.open.normal, seen.normal) > 0.5f); // the plane turns by 40 degrees
        CHECK(glm::dot(point.closing.normal, seen.normal) > 0.5f);
    }
    CHECK(met > 500);
    const hit nothing = rays.first_hit({{0, 5, 7}, {0, 1, 0}}, 0.5f);
    CHECK_FALSE(nothing.valid());
}

TEST_CASE("the mean visibility is a count of rays over their number, and the same when traced again")
{
    const moving_stage stage = cubes_to_the_light(1.5);
    const tracer rays(stage.world);
    std::vector<receiver_motion> receivers;
    for (int i = 0; i < 200; ++i) {
        const receiver there{{-3 + 0.03f * static_cast<float>(i), 0, 0.3f}, {0, 1, 0}};
        receivers.push_back({there, there});
    }
    std::vector<float> few(200), many(200), again(200);
    rays.mean_visibility(stage.light, receivers, 21, few); // not a multiple of a packet
    rays.mean_visibility(stage.light, receivers, 1024, many);
    rays.mean_visibility(stage.light, receivers, 1024, again);
    CHECK(many == again);
    for (std::size_t i = 0; i < 200; ++i) {
        const float count = few[i] * 21;
        CHECK(count == doctest::Approx(double(std::round(count))));
        // A rising cube hides the light from some time on or up to some time, so at most two cubes' four ends count
        // half.
        CHECK(std::abs(few[i] - many[i]) <= 4.f / 21 + 4.f / 1024);
    }
    CHECK(std::ranges::any_of(many, [](float v) { return v > 0.2f && v < 0.8f; }));
    // A receiver that turns its back to the light does not see it, even where nothing lies in between.
    receivers = {{{{-3, 0, 0}, {0, -1, 0}}, {{-3, 0, 0}, {0, -1, 0}}}};
    rays.mean_visibility(stage.light, receivers, 16, std::span(few).first(1));
    CHECK(few[0] == 0);
}

TEST_CASE("a receiver that moves along with the bar above it stays in shadow, and a static one does not")
{
    const moving_stage stage = trapezoid(1.5);
    const tracer rays(stage.world);
    const auto at = [](float x) { return receiver{{x, 0, 0}, {0, 1, 0}}; };
    const std::vector<receiver_motion> receivers{{at(-1), at(1)}, {at(0), at(0)}, {at(1), at(-1)}};
    std::vector<float> visible(3);
    rays.mean_visibility(stage.light, receivers, 4096, visible);
    CHECK(visible[0] == 0);
    CHECK(std::abs(visible[1] - 0.75f) <= 2.f / 4096 + 1e-5f);
    CHECK(std::abs(visible[2] - 0.875f) <= 2.f / 4096 + 1e-3f); // they meet twice as fast; the scale is 0.999
}

TEST_CASE("visibility changes when only the light or only the receiver moves")
{
    const moving_stage stage = pillars(1.5);
    const tracer rays(stage.world);
    std::vector<receiver_motion> receivers;
    for (int i = 0; i < 100; ++i) {
        const receiver open{{0.5f + 0.03f * static_cast<float>(i), 0, 1.7f}, {0, 1, 0}};
        receiver closing = open;
        if (i % 2 == 1) closing.position.z = 0.5f;
        receivers.push_back({open, closing});
    }
    constexpr int n = 1024;
    for (const moving_camera& light : {stage.light, moving_camera{stage.light.at(0.5), glm::dvec3(0)}}) {
        std::vector<float> mean(100), now(100), sum(100);
        rays.mean_visibility(light, receivers, n, mean);
        for (int k = 0; k < n; ++k) {
            const float t = (static_cast<float>(k) + 0.5f) / n;
            std::vector<receiver> there;
            for (const receiver_motion& r : receivers)
                there.push_back({glm::mix(r.open.position, r.closing.position, t), r.open.normal});
            rays.visibility(light, there, std::vector<float>(100, t), now);
            for (std::size_t i = 0; i < 100; ++i) sum[i] += now[i];
        }
        // Each row of pillars hides the light for an interval or two, whose ends count by one part at most.
        int partly = 0;
        for (std::size_t i = 0; i < 100; ++i) {
            CHECK(std::abs(mean[i] - sum[i] / n) <= 12.f / n);
            partly += mean[i] > 0.05f && mean[i] < 0.95f;
        }
        CHECK(partly > 10);
    }
}

TEST_CASE("a photograph of a static scene is the shaded picture, and that of a moving one the mean over its times")
{
    constexpr int width = 96, height = 64;
    moving_stage stage = pillars(double(width) / height);
    stage.light.motion = glm::dvec3(0);
    const tracer rays(stage.world);
    const reference_picture photograph = rays.photograph(stage.light, stage.eye, width, height, 5);
    const auto seen = rasterize_surfaces(stage.world.open, stage.eye.open, width, height);
    const auto visible = traced_visibility(rays, stage.light.open, seen);
    const picture shaded = shade(stage.world.open, stage.light.open, seen, visible);
    int different = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        CHECK(photograph.coverage.pixels[i] == (seen.pixels[i].valid() ? 1.f : 0.f));
        const glm::vec3 error = glm::abs(photograph.colour.pixels[i] - shaded.pixels[i]);
        different += std::max({error.x, error.y, error.z}) > 1e-4f;
        if (seen.pixels[i].valid() && faces_light(stage.light.open, seen.pixels[i]))
            different += photograph.visibility.pixels[i] != visible.pixels[i];
        if (!seen.pixels[i].valid()) CHECK(photograph.visibility.pixels[i] == 1);
    }
    CHECK(different <= 2); // pixel centres on an outline

    // Ground that the bar never hides from the camera.
    const moving_stage bar = trapezoid(double(width) / height);
    constexpr int samples = 256;
    const reference_picture blurred = tracer(bar.world).photograph(bar.light, bar.eye, width, height, samples);
    int compared = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const view_ray ray = ray_through(bar.eye.open, {(x + 0.5) / width, (y + 0.5) / height});
            const glm::dvec3 ground = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
            const glm::dvec3 above = ray.origin - (ray.origin.y - 2) / ray.direction.y * ray.direction;
            if (ray.direction.y >= 0 || std::max(std::abs(ground.x), std::abs(ground.z)) > 2) continue;
            if (std::abs(above.x) < 1.3 && std::abs(above.z) < 1.6) continue;
            const double expected = trapezoid_visibility(ground);
            CHECK(std::abs(double(blurred.visibility(x, y)) - expected) <= 2.0 / samples + 1e-5);
            compared += expected < 1;
        }
    CHECK(compared > 50);
}

TEST_CASE("sizes of moving queries are checked, and an empty scene is lit")
{
    const tracer rays(moving_scene{});
    const moving_camera light{camera{}, glm::dvec3(0)};
    std::vector<float> visible(2);
    const std::vector<receiver_motion> receivers(2);
    CHECK_THROWS_WITH(rays.mean_visibility(light, receivers, 0, visible), "tracer: 0 samples, at least one expected");
    CHECK_THROWS_WITH(rays.mean_visibility(light, receivers, 4, std::span(visible).first(1)),
                      "tracer: 2 receivers, room for 1 results");
    CHECK_THROWS_WITH(rays.photograph(light, {}, 4, 4, -1), "tracer: -1 samples, at least one expected");
    const std::vector<receiver> fixed(2);
    CHECK_THROWS_WITH(rays.visibility(light, fixed, std::vector<float>(3), visible),
                      "tracer: 2 receivers, times for 3");
    const reference_picture empty = rays.photograph(light, {}, 4, 4, 3);
    CHECK(empty.visibility.pixels == std::vector<float>(16, 1));
    CHECK(empty.coverage.pixels == std::vector<float>(16, 0));
    CHECK(empty.colour(2, 2) == gnomon::renderer::daylight.background);
}

TEST_CASE("at any time, light through moving panes is that through the static panes of that time")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    const moving_stage stage = moving_panes(1.5);
    const tracer moving(stage.world);
    std::vector<receiver> receivers;
    for (int i = 0; i < 2000; ++i) {
        const hit seen = moving.first_hit(ray_through(stage.eye.open, {uniform(random), uniform(random)}), 0.5f);
        if (seen.valid()) receivers.push_back({{seen.position.x, 0, seen.position.z}, {0, 1, 0}});
    }
    receivers.push_back({receivers[0].position, {0, -1, 0}}); // faces away
    int passed = 0, stopped = 0, different = 0;
    for (const float t : {0.f, 0.3f, 0.5f, 1.f}) {
        std::vector<glm::vec3> light(receivers.size()), expected(receivers.size());
        moving.transmittance(stage.light, receivers, std::vector<float>(receivers.size(), t), light);
        tracer(scene_at(stage.world, t)).transmittance(stage.light.at(double(t)), receivers, expected);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            different += glm::length(light[i] - expected[i]) > 1e-6f; // at outlines rounding decides
            passed += 0.05f < light[i].x && light[i].x < 0.95f, stopped += light[i].x == 0;
        }
        CHECK(light.back() == glm::vec3(0));
    }
    CHECK(passed > 200);
    CHECK(stopped > 50);
    CHECK(different < 5);
}
