// A camera that moves: its segments and samples against rays through the same pixel at the same time, its photograph
// against photographs of cameras that stand still, and all of them where the world moves along. Pixels that are traced at one
// time only.
#include "moving_boxes.hpp"
#include "renderer/scene/layered_stages.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/shade/moving_view.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace gnomon;
using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

constexpr int width = 60, height = 40;
const glm::dvec3 by(0.6, -0.3, 0.5);

moving_camera eye_of(const moving_scene& world, const glm::dvec3& motion)
{
    moving_camera eye{perspective_view_from({2, 5, 6}, {0, 0, 0}, bounds_of(world).corners(), glm::radians(45.0), 1.5),
                      motion};
    eye.open.near_distance *= 0.7, eye.open.far_distance *= 1.3;
    return eye;
}

view_ray ray_of(const moving_camera& eye, std::size_t pixel, float t)
{
    const auto column = double(pixel % width), row = double(pixel / width);
    return ray_through(eye.at(double(t)), {(column + 0.5) / width, (row + 0.5) / height});
}

// The scene without motion of its own, carried along by `motion`.
moving_scene carried(moving_scene world, const glm::vec3& motion)
{
    for (std::size_t m = 0; m < world.closing.size(); ++m) {
        world.closing[m] = world.open.meshes[m].positions;
        for (glm::vec3& p : world.closing[m]) p += motion;
    }
    return world;
}

} // namespace

TEST_CASE("a moving camera sees the first hits of its rays, as segments and as samples")
{
    const moving_scene world = moving_boxes(7, 8);
    const moving_camera eye = eye_of(world, by);
    const tracer rays(world);
    const triangle_numbers numbers(world.open);
    const auto agrees = [&](std::size_t pixel, std::uint32_t triangle, float t, const glm::vec3& place) {
        const hit seen = rays.first_hit(ray_of(eye, pixel, t), t);
        const triangle_place expected = numbers[triangle];
        return int(expected.mesh) == seen.mesh && expected.triangle == seen.triangle &&
               glm::distance(seen.position, place) < 3e-3f;
    };
    bit_source bits(8);
    const seen_motion paths = camera_segments(world, eye, width, height, 1e-4f);
    const seen_motion samples = stochastic_visibility(world, eye, width, height, 4, 11);
    int segments = 0, instants = 0, moving = 0, other = 0;
    for (std::size_t pixel = 0; pixel < std::size_t(width * height); ++pixel) {
        for (const seen_segment& s : paths(pixel)) {
            if (s.weight < 1e-3f) continue; // beside an edge that two triangles share
            const auto passed = float(bits.uniform(0, 1)), t = glm::mix(s.t0, s.t1, passed);
            ++segments, moving += glm::distance(s.p0, s.p1) > 0.05f;
            other += !agrees(pixel, s.triangle, t, glm::mix(s.p0, s.p1, passed));
        }
        for (const seen_segment& s : samples(pixel)) {
            CHECK(s.weight == 0.25f);
            ++instants, other += !agrees(pixel, s.triangle, s.t0, s.p0);
        }
    }
    CHECK(segments > width * height);
    CHECK(moving > segments / 10);
    CHECK(instants > 2 * width * height);
    CHECK(other < (segments + instants) / 500); // rounding decides on outlines
}

TEST_CASE("the photograph of a moving camera is the mean of those of cameras along its path")
{
    moving_scene world = carried(moving_boxes(9, 8), glm::vec3(0));
    const moving_camera eye = eye_of(world, by), light = light_of(world, true);
    const tracer rays(world);
    constexpr int times = 64;
    const reference_picture blurred = rays.photograph(light, eye, width, height, times);
    image<float> coverage(width, height, 0), lit(width, height, 0);
    for (int i = 0; i < times; ++i) {
        const reference_picture still = rays.photograph(light, {eye.at((i + 0.5) / times)}, width, height, 1);
        for (std::size_t p = 0; p < coverage.pixels.size(); ++p) {
            coverage.pixels[p] += still.coverage.pixels[p];
            lit.pixels[p] += still.coverage.pixels[p] * still.visibility.pixels[p];
        }
    }
    double worst = 0, wrong = 0;
    int partly = 0;
    for (std::size_t p = 0; p < coverage.pixels.size(); ++p) {
        CHECK(std::abs(blurred.coverage.pixels[p] - coverage.pixels[p] / times) <= 4.0f / times);
        if (coverage.pixels[p] == 0) continue;
        const float expected = lit.pixels[p] / coverage.pixels[p];
        const double error = std::abs(double(blurred.visibility.pixels[p] - expected));
        worst = std::max(worst, error), wrong += error, partly += expected > 0.1f && expected < 0.9f;
    }
    CHECK(partly > 100);
    CHECK(worst < 0.15);
    CHECK(wrong < 0.01 * width * height);
}

TEST_CASE("where the world and the light move along with the camera, nothing moves in its picture")
{
    const moving_scene still = carried(moving_boxes(7, 8), glm::vec3(0)), along = carried(still, by);
    const moving_camera eye = eye_of(along, glm::dvec3(0)), moving_eye = eye_of(along, by);
    moving_camera light = light_of(along, true), moving_light = light;
    moving_light.motion = by;
    const reference_picture a = tracer(still).photograph(light, eye, width, height, 8),
                            b = tracer(along).photograph(moving_light, moving_eye, width, height, 8);
    const seen_motion paths = camera_segments(along, moving_eye, width, height, 1e-4f);
    int different = 0, seen = 0;
    for (std::size_t p = 0; p < a.visibility.pixels.size(); ++p) {
        different += std::abs(a.visibility.pixels[p] - b.visibility.pixels[p]) > 0 ||
                     std::abs(a.coverage.pixels[p] - b.coverage.pixels[p]) > 0;
        if (paths(p).size() != 1) continue;
        const seen_segment& s = paths(p)[0];
        ++seen;
        REQUIRE(s.weight == doctest::Approx(1));
        REQUIRE(glm::distance(s.p1 - s.p0, glm::vec3(by)) < 2e-4f);
    }
    CHECK(seen > width * height / 2);
    CHECK(different < width * height / 50); // outlines of surfaces and shadows
}

TEST_CASE("a pixel that is traced once is one that looks the same at all times")
{
    constexpr int times = 64;
    for (const moving_stage& stage :
         {random_cubes(double(width) / height, 100, 0.5f), moving_eye(double(width) / height)}) {
        const tracer rays(stage.world);
        const reference_picture photograph = rays.photograph(stage.light, stage.eye, width, height, times);
        int changing = 0, different = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                int covered = 0, lit = 0;
                for (int k = 0; k < times; ++k) {
                    const float t = (static_cast<float>(k) + 0.5f) / times;
                    const hit seen = rays.first_hit(
                        ray_through(stage.eye.at(double(t)), {(x + 0.5) / width, (y + 0.5) / height}), t);
                    if (!seen.valid()) continue;
                    const std::array<receiver, 1> from{receiver{seen.position, seen.normal}};
                    std::array<float, 1> visible{};
                    rays.visibility(stage.light, from, std::vector<float>{t}, visible);
                    const glm::dvec3 light = direction_towards(stage.light.at(double(t)), glm::dvec3(seen.position));
                    ++covered, lit += visible[0] > 0 && glm::dot(light, glm::dvec3(seen.normal)) > 0;
                }
                const float share = covered > 0 ? static_cast<float>(lit) / static_cast<float>(covered) : 1;
                changing += 0 < share && share < 1;
                // A part of the times may change within itself at both ends of each interval.
                different += std::abs(photograph.coverage(x, y) - static_cast<float>(covered) / times) > 6.f / times;
                different += covered > times / 2 && std::abs(photograph.visibility(x, y) - share) > 8.f / times;
            }
        CHECK(changing > 20);
        CHECK(different == 0);
    }
}
