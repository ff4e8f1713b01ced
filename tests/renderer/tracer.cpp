// The traced reference against the shadow of a box, which is known in closed form; and motion against rest.
#include "renderer/trace/tracer.hpp"

#include "renderer/scene/moving_stages.hpp"
#include "renderer/shade/shading.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon::renderer;

namespace {

const glm::dvec3 box_lower(-0.5, 0.3, -0.25), box_upper(0.5, 1.1, 0.75);

// Whether the segment from p over `way` meets the box, grown by `by` on all sides: the three slabs overlap.
bool meets_box(const glm::dvec3& p, const glm::dvec3& way, double by)
{
    double enter = 0, leave = 1;
    for (int i = 0; i < 3; ++i) {
        const double a = (box_lower[i] - by - p[i]) / way[i], b = (box_upper[i] + by - p[i]) / way[i];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

scene box_on_ground()
{
    mesh box{.name = "box", .positions = {}, .normals = {}, .triangles = {}};
    add_box(box, upright(glm::vec3(0.5 * (box_lower + box_upper)), glm::vec3(box_upper - box_lower)));
    return {"box", {box, ground({0, 0, 0}, 6, 6, glm::vec3(0.5f))}};
}

} // namespace

TEST_CASE("a box casts the shadow that its slabs predict")
{
    const scene world = box_on_ground();
    const tracer rays(world);
    const auto corners = bounds_of(world).corners();
    const glm::dvec3 direction(0.6, -1, 0.35);
    for (const camera& light : {orthographic_view(corners, direction), perspective_view(corners, direction, 0.9)}) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> place(-2.5f, 2.5f);
        std::vector<receiver> receivers;
        for (int i = 0; i < 20000; ++i) receivers.push_back({{place(random), 0, place(random)}, {0, 1, 0}});
        std::vector<float> visible(receivers.size());
        rays.visibility(light, receivers, visible);
        int shadowed = 0;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            const glm::dvec3 p = receivers[i].position;
            const glm::dvec3 way = light.perspective() ? light.position - p : -100.0 * light.forward;
            // Within the ray's offset of the outline, float and closed form may differ; a hundred times that is left
            // out.
            const double margin = 100 * static_cast<double>(rays.offset());
            const bool surely = meets_box(p, way, -margin), perhaps = meets_box(p, way, margin);
            if (surely == perhaps) CHECK(visible[i] == (surely ? 0.f : 1.f));
            shadowed += surely;
        }
        CHECK(shadowed > 500);
        CHECK(shadowed < 10000);
    }
}

TEST_CASE("a plane does not shadow itself, and neither do lit faces of a box")
{
    const scene world = box_on_ground();
    const tracer rays(world);
    const camera light = orthographic_view(bounds_of(world).corners(), {0.6, -1, 0.35});
    for (const glm::dvec3& direction :
         {glm::dvec3(-0.3, -1, -1), glm::dvec3(-1, -0.4, 0.1), glm::dvec3(0.5, -2, 0.3)}) {
        const camera eye = perspective_view(bounds_of(world).corners(), direction, 0.7);
        const auto seen = rasterize_surfaces(world, eye, 160, 160);
        const auto visible = traced_visibility(rays, light, seen);
        int lit_faces = 0;
        for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
            const surface& s = seen.pixels[i];
            // The box is convex and nothing stands above it.
            if (s.mesh != 0 || glm::dot(glm::dvec3(s.normal), direction_towards(light, s.position)) <= 1e-3) continue;
            ++lit_faces;
            CHECK(visible.pixels[i] == 1);
        }
        CHECK(lit_faces > 0);
    }
}

TEST_CASE("an empty scene is lit, and shapes are checked")
{
    const tracer rays(scene{});
    const camera light;
    const std::vector<receiver> receivers(3, {{0, 0, 0}, {0, 1, 0}});
    std::vector<float> visible(3);
    rays.visibility(light, receivers, visible);
    CHECK(visible == std::vector<float>{1, 1, 1});
    visible.pop_back();
    CHECK_THROWS_WITH(rays.visibility(light, receivers, visible), "tracer: 3 receivers, room for 2 results");
}

TEST_CASE("at any time, a moving scene is traced like one at rest in that place")
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
            const tracer resting(scene_at(stage.world, t));
            // Rounding moves outlines by the offset at most; receivers near one, where five rays that start ten
            // offsets apart do not agree, are left out.
            const float margin = 10 * moving.offset();
            std::vector<receiver> receivers, probes;
            for (int i = 0; i < 2000; ++i) {
                const view_ray ray = ray_through(stage.eye, {uniform(random), uniform(random)});
                const hit seen = moving.first_hit(ray, t), expected = resting.first_hit(ray, 0);
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
            resting.visibility(light, probes, expected);
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

TEST_CASE("hits lie on their rays and triangles, and their points go along with the triangles")
{
    const moving_stage stage = cube_over_plane(1.5, 20, 2, 0);
    const tracer rays(stage.world);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> uniform(0, 1);
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const float t = uniform(random);
        const view_ray ray = ray_through(stage.eye, {uniform(random), uniform(random)});
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

TEST_CASE("the mean visibility is that of its moments: it counts rays, and is the same again")
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

TEST_CASE("a receiver that moves along with a bar above stays in its shadow, one that stands still does not")
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

TEST_CASE("where only the light or only the receiver moves, visibility changes all the same")
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

TEST_CASE("a photograph of a scene at rest is the shaded picture, and of a moving one the mean over its moments")
{
    constexpr int width = 96, height = 64;
    moving_stage stage = pillars(double(width) / height);
    stage.light.motion = glm::dvec3(0);
    const tracer rays(stage.world);
    const reference_picture photograph = rays.photograph(stage.light, stage.eye, width, height, 5);
    const auto seen = rasterize_surfaces(stage.world.open, stage.eye, width, height);
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
            const view_ray ray = ray_through(bar.eye, {(x + 0.5) / width, (y + 0.5) / height});
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

TEST_CASE("shapes of moving queries are checked, and nothing but the sky is lit")
{
    const tracer rays(moving_scene{});
    const moving_camera light{camera{}, glm::dvec3(0)};
    std::vector<float> visible(2);
    const std::vector<receiver_motion> receivers(2);
    CHECK_THROWS_WITH(rays.mean_visibility(light, receivers, 0, visible), "tracer: 0 moments, at least one expected");
    CHECK_THROWS_WITH(rays.mean_visibility(light, receivers, 4, std::span(visible).first(1)),
                      "tracer: 2 receivers, room for 1 results");
    CHECK_THROWS_WITH(rays.photograph(light, camera{}, 4, 4, -1), "tracer: -1 moments, at least one expected");
    const std::vector<receiver> resting(2);
    CHECK_THROWS_WITH(rays.visibility(light, resting, std::vector<float>(3), visible),
                      "tracer: 2 receivers, times for 3");
    const reference_picture empty = rays.photograph(light, camera{}, 4, 4, 3);
    CHECK(empty.visibility.pixels == std::vector<float>(16, 1));
    CHECK(empty.coverage.pixels == std::vector<float>(16, 0));
    CHECK(empty.colour(2, 2) == gnomon::renderer::daylight.background);
}
