// The scenes in motion: what the table of their builders says, and that lights see what they have to.
#include "evaluation/motion/motion_scene.hpp"
#include "renderer/scene/moving_stage_builder.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace gnomon::evaluation;
using namespace gnomon::renderer;

namespace {

constexpr double aspect = 16.0 / 9;

std::vector<const motion_scene*> scenes() { return registry_of<scene_entry>().all_of<motion_scene>(); }

bool somewhere(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool near(const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-5f; }

bounds bounds_of_mesh(const moving_stage& stage, std::size_t mesh, float t)
{
    return bounds_of(scene{"", {scene_at(stage.world, t).meshes[mesh]}});
}

glm::vec3 triangle_normal(const mesh& part, std::size_t triangle)
{
    const glm::uvec3 t = part.triangles[triangle];
    return glm::normalize(
        glm::cross(part.positions[t.y] - part.positions[t.x], part.positions[t.z] - part.positions[t.x]));
}

} // namespace

TEST_CASE("each scene in motion is whole: finite corners, valid triangles, a place for each corner at both ends")
{
    for (const motion_scene* listed : scenes()) {
        CAPTURE(listed->id);
        const moving_stage stage = listed->stage(aspect);
        REQUIRE(stage.world.closing.size() == stage.world.open.meshes.size());
        for (std::size_t m = 0; m < stage.world.closing.size(); ++m) {
            const mesh& part = stage.world.open.meshes[m];
            REQUIRE(stage.world.closing[m].size() == part.positions.size());
            CHECK(std::ranges::all_of(part.positions, somewhere));
            CHECK(std::ranges::all_of(stage.world.closing[m], somewhere));
            CHECK(std::ranges::all_of(part.triangles, [&](const glm::uvec3& t) {
                return std::max({t.x, t.y, t.z}) < part.positions.size();
            }));
        }
        CHECK(!stage.interests.empty());
        for (const point_of_interest& place : stage.interests)
            CHECK(within_view(project(stage.eye.open, place.position)));
    }
    CHECK(scenes().size() >= 18);
}

TEST_CASE("scenes of layers are there, and the full form of tentacles has all triangles")
{
    const auto scene = [](const char* id) -> const motion_scene& {
        return dynamic_cast<const motion_scene&>(registry_of<scene_entry>().at(id));
    };
    for (const char* id : {"tentacles", "tentacles_from_above", "wrecking_ball", "chess", "tree_in_moving_light",
                           "walker", "moving_eye"})
        CHECK(scene(id).motion.has("layered"));
    const auto triangles = [&](bool full) {
        return scene("tentacles").stage(aspect, full).world.open.meshes[0].triangles.size();
    };
    CHECK(triangles(false) == 24576);
    CHECK(triangles(true) == 180000);
}

TEST_CASE("the light sees all casters at all times, and everything lies between its planes")
{
    for (const motion_scene* listed : scenes()) {
        CAPTURE(listed->id);
        const moving_stage stage = listed->stage(aspect);
        for (const float t : {0.f, 0.25f, 0.5f, 1.f}) {
            const camera light = stage.light.at(double(t));
            const scene now = scene_at(stage.world, t);
            for (std::size_t m = 0; m < now.meshes.size(); ++m) {
                const bool caster = m == 0 || m + 1 < now.meshes.size();
                for (const glm::vec3& corner : now.meshes[m].positions) {
                    const glm::dvec3 seen = project(light, corner);
                    CHECK(std::abs(seen.z) <= 1);
                    CHECK(view_distance(light, corner) > 0);
                    if (caster) CHECK(within_view(seen));
                }
            }
        }
    }
}

TEST_CASE("the light's picture is not wider than the casters need")
{
    for (const motion_scene* listed : scenes()) {
        CAPTURE(listed->id);
        const moving_stage stage = listed->stage(aspect);
        double farthest = 0; // from the middle of the picture, of any caster at an end
        for (const float t : {0.f, 1.f}) {
            const scene now = scene_at(stage.world, t);
            for (std::size_t m = 0; m == 0 || m + 1 < now.meshes.size(); ++m)
                for (const glm::vec3& corner : now.meshes[m].positions) {
                    const glm::dvec2 seen =
                        glm::abs(2.0 * glm::dvec2(project(stage.light.at(double(t)), corner)) - 1.0);
                    farthest = std::max({farthest, seen.x, seen.y});
                }
        }
        CHECK(farthest > 0.998);
    }
}

TEST_CASE("nothing is shadowed where the light's picture ends")
{
    for (const motion_scene* listed : scenes()) {
        CAPTURE(listed->id);
        const moving_stage stage = listed->stage(aspect);
        const tracer rays(stage.world);
        std::mt19937 random(3);
        std::uniform_real_distribution<float> uniform(0, 1);
        std::vector<receiver> receivers;
        std::vector<float> times;
        std::vector<bool> inside;
        for (int i = 0; i < 4000; ++i) {
            const float t = uniform(random);
            const hit seen = rays.first_hit(ray_through(stage.eye.open, {uniform(random), uniform(random)}), t);
            if (!seen.valid()) continue;
            const camera light = stage.light.at(double(t));
            if (glm::dot(direction_towards(light, seen.position), glm::dvec3(seen.normal)) <= 0) continue;
            receivers.push_back({seen.position, seen.normal}), times.push_back(t);
            inside.push_back(within_view(project(light, seen.position)));
        }
        std::vector<float> visible(receivers.size());
        rays.visibility(stage.light, receivers, times, visible);
        int shadowed = 0;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            if (!inside[i]) CHECK(visible[i] == 1);
            shadowed += visible[i] == 0;
        }
        CHECK((shadowed > 0) == (listed->id != "lit_ramp"));
    }
}

TEST_CASE("pillars stand still in three rows of five, below a light that rises")
{
    const moving_stage stage = pillars(aspect);
    const mesh& boxes = stage.world.open.meshes[0];
    CHECK(boxes.triangles.size() == 15 * 12);
    CHECK_FALSE(stage.world.moves(0));
    const bounds box = bounds_of_mesh(stage, 0, 0);
    CHECK(near(box.lower, {-2.12f, 0, -1.12f}));
    CHECK(near(box.upper, {2.12f, 1, 1.12f}));
    CHECK(stage.light.at(0).position == glm::dvec3(-3, 2.5, -0.5));
    CHECK(stage.light.at(1).position == glm::dvec3(-3, 5, -0.5));
}

TEST_CASE("quads and cubes are where the papers have them")
{
    const moving_stage crossed = crossed_quads(aspect);
    CHECK(near(bounds_of_mesh(crossed, 0, 0).centre(), {-2, 2, 0}));
    CHECK(near(bounds_of_mesh(crossed, 0, 1).centre(), {2, 2, 0}));
    CHECK(near(bounds_of_mesh(crossed, 1, 1).centre(), {0, 1, 2}));
    CHECK(near(bounds_of_mesh(crossed, 1, 0).extent(), {4, 0, 0.5f}));
    const moving_stage both = toward_and_away(aspect);
    CHECK(near(bounds_of_mesh(both, 0, 1).centre(), {-1.2f, 2.5f, 0}));
    CHECK(near(bounds_of_mesh(both, 1, 1).centre(), {1.2f, 0.3f, 0}));
    const moving_stage cubes = cubes_to_the_light(aspect);
    CHECK(cubes.world.open.meshes[0].triangles.size() == 11616);
    CHECK(near(bounds_of_mesh(cubes, 0, 0).lower, {-1.5f, 0.1f, -0.5f}));
    CHECK(near(bounds_of_mesh(cubes, 0, 1).upper, {1.5f, 2.6f, 0.5f}));
    // Seen from outside, all triangles go round counter-clockwise: the volume is that of two cubes of side one.
    double volume = 0;
    const mesh& part = cubes.world.open.meshes[0];
    for (const glm::uvec3& t : part.triangles)
        volume += glm::dot(glm::dvec3(part.positions[t.x]),
                           glm::cross(glm::dvec3(part.positions[t.y]), glm::dvec3(part.positions[t.z]))) /
                  6;
    CHECK(volume == doctest::Approx(2));
}

TEST_CASE("random cubes are the same everywhere, and faster ones move in the same directions")
{
    const moving_stage slow = random_cubes(aspect, 100, 0.5f), fast = random_cubes(aspect, 100, 2);
    const mesh &cubes = slow.world.open.meshes[0], &faster = fast.world.open.meshes[0];
    CHECK(cubes.triangles.size() == 1200);
    const auto centre = [](const std::vector<glm::vec3>& corners, std::size_t i) {
        glm::vec3 sum(0);
        for (std::size_t k = 0; k < 8; ++k) sum += corners[8 * i + k];
        return sum / 8.f;
    };
    for (std::size_t i = 0; i < 100; ++i) {
        const glm::vec3 open = centre(cubes.positions, i), closing = centre(slow.world.closing[0], i);
        const glm::vec3 way = centre(fast.world.closing[0], i) - centre(faster.positions, i);
        const glm::vec3 half_way = 0.5f * (open + closing);
        CHECK(near(4.f * (closing - open), way));
        CHECK(glm::length(way) <= 2);
        CHECK(glm::length(way) > 0);
        CHECK(std::max(std::abs(half_way.x), std::abs(half_way.z)) <= 4);
        CHECK(half_way.y >= 0.5f);
        CHECK(half_way.y <= 4.5f);
    }
    // The first number of mt19937 with seed 1 is 1791095845.
    const float x = -4 + 8 * static_cast<float>(1791095845u >> 8) * 0x1p-24f;
    CHECK(0.5f * (centre(cubes.positions, 0) + centre(slow.world.closing[0], 0)).x == doctest::Approx(double(x)));
}

TEST_CASE("the plane below the cube turns by the angle on both sides")
{
    for (const float degrees : {0.f, 5.f, 20.f}) {
        const moving_stage stage = cube_over_plane(aspect, degrees, 1, -1);
        CHECK(stage.world.moves(1) == (degrees > 0));
        for (const float t : {0.f, 1.f}) {
            const float angle = (2 * t - 1) * glm::radians(degrees);
            const mesh plane = scene_at(stage.world, t).meshes[1];
            CHECK(near(triangle_normal(plane, 0), {0, std::cos(angle), std::sin(angle)}));
        }
        CHECK(near(bounds_of_mesh(stage, 0, 0.5f).centre(), {0, 1, -1}));
        CHECK(near(bounds_of_mesh(stage, 0, 0).extent(), glm::vec3(0.8f)));
    }
}

TEST_CASE("the fan's blades turn by a quarter, and shrink meanwhile, since their corners move straight")
{
    const moving_stage stage = fan(aspect);
    for (const auto& [t, shrunk] : {std::pair(0.f, 1.f), {0.5f, std::sqrt(0.5f)}, {1.f, 1.f}}) {
        const mesh blades = scene_at(stage.world, t).meshes[0];
        REQUIRE(blades.positions.size() == 32);
        for (std::size_t i = 0; i < 32; ++i) {
            const glm::vec3& p = blades.positions[i];
            CHECK(p.y == 1.5f);
            CHECK(std::hypot(p.x, p.z) == doctest::Approx(double(shrunk) * (i % 4 == 0 || i % 4 == 3 ? 0.2 : 1.8)));
        }
        CHECK(triangle_normal(blades, 0).y == doctest::Approx(1));
    }
    const glm::vec3 open = stage.world.open.meshes[0].positions[1], closing = stage.world.closing[0][1];
    CHECK(glm::dot(open - glm::vec3(0, 1.5f, 0), closing - glm::vec3(0, 1.5f, 0)) == doctest::Approx(0));
}

TEST_CASE("the trapezoid's closed form is that of the tracer")
{
    // The scale is the bar's distance from the light over the ground's.
    const double scale = 1998.0 / 2000;
    const auto at = [&](double x, double z) { return trapezoid_visibility(glm::dvec3(x / scale, 0, z / scale)); };
    CHECK(at(0, 0) == doctest::Approx(0.75));
    CHECK(at(-0.75, 1.4999) == doctest::Approx(0.75));
    CHECK(at(1, -1) == doctest::Approx(0.875));
    CHECK(at(1.25, 0) == doctest::Approx(1));
    CHECK(at(-1.4, 0) == 1);
    CHECK(at(0, 1.5001) == 1);

    const moving_stage stage = trapezoid(aspect);
    const tracer rays(stage.world);
    std::vector<receiver_motion> receivers;
    for (int i = -40; i <= 40; ++i)
        for (const float z : {-1.4f, 0.f, 1.f, 1.6f}) {
            const receiver there{{0.04f * static_cast<float>(i), 0, z}, {0, 1, 0}};
            receivers.push_back({there, there});
        }
    // The light is hidden for one interval of time; each of its ends falls into one of n parts, which counts wholly or
    // not at all.
    constexpr int n = 4096;
    std::vector<float> visible(receivers.size());
    rays.mean_visibility(stage.light, receivers, n, visible);
    for (std::size_t i = 0; i < receivers.size(); ++i)
        CHECK(std::abs(double(visible[i]) - trapezoid_visibility(receivers[i].open.position)) <= 2.0 / n + 1e-5);
}

TEST_CASE("the lit ramp is lit, exactly and everywhere")
{
    const moving_stage stage = lit_ramp(aspect);
    const tracer rays(stage.world);
    const reference_picture picture = rays.photograph(stage.light, stage.eye, 160, 90, 64);
    CHECK(std::ranges::all_of(picture.visibility.pixels, [](float v) { return v == 1; }));
    CHECK(std::ranges::count_if(picture.coverage.pixels, [](float c) { return c > 0; }) > 1000);
    std::vector<receiver_motion> receivers;
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 160; ++x) {
            const hit seen = rays.first_hit(ray_through(stage.eye.open, {(x + 0.5) / 160, (y + 0.5) / 90}), 0.5f);
            if (seen.valid()) receivers.push_back(rays.receiver_of(seen, 0.5f));
        }
    REQUIRE(receivers.size() > 500);
    std::vector<float> visible(receivers.size());
    rays.mean_visibility(stage.light, receivers, 64, visible);
    CHECK(std::ranges::all_of(visible, [](float v) { return v == 1; }));
}

TEST_CASE("a light with a caster behind it is refused")
{
    const moving_scene cubes = random_cubes(aspect, 100, 0.5f).world;
    CHECK_THROWS_WITH(spot_light(cubes, cubes, {0, 2, 0}, {0, 9, 0}), "spot light: a caster is not in front of it");
    CHECK_THROWS_AS(spot_light({}, cubes, {0, 7, 0}, {0, 7, 0}), std::invalid_argument);
}
