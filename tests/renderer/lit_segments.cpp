// The lit parts of view rays against all triangles one by one and against traced points, and the scattering in them.
#include "renderer/trace/lit_segments.hpp"

#include "renderer/scene/scattering_stages.hpp"
#include "renderer/shade/scattering.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

using namespace gnomon::renderer;

namespace {

using real = long double;
using vec = glm::vec<3, real>;

constexpr double infinity = std::numeric_limits<double>::infinity();

bool contains(const std::vector<lit_segment>& lit, double at)
{
    return std::ranges::any_of(lit, [&](const lit_segment& part) { return part.from <= at && at <= part.to; });
}

// True if a triangle lies between the point and the light.
bool shadowed(const std::vector<std::array<vec, 3>>& triangles, const vec& forward, const vec& point)
{
    return std::ranges::any_of(triangles, [&](const auto& corner) {
        const vec a = corner[1] - corner[0], b = corner[2] - corner[0], p = glm::cross(-forward, b);
        const real determinant = glm::dot(a, p);
        if (determinant == 0) return false;
        const vec from = point - corner[0], q = glm::cross(from, a);
        const real u = glm::dot(from, p) / determinant, v = glm::dot(-forward, q) / determinant;
        return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(b, q) / determinant > 0;
    });
}

// The distances at which a ray may enter or leave a shadow: where it meets the planes of triangles, and those through their
// edges along the light.
std::vector<double> changes(const std::vector<std::array<vec, 3>>& triangles, const vec& forward, const view_ray& ray,
                            double length)
{
    std::vector<double> result{0, length};
    const auto meet = [&](const vec& normal, const vec& place) {
        const auto at =
            static_cast<double>(glm::dot(normal, place - vec(ray.origin)) / glm::dot(normal, vec(ray.direction)));
        if (at > 0 && at < length) result.push_back(at);
    };
    for (const auto& corner : triangles) {
        meet(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), corner[0]);
        for (std::size_t i = 0; i < 3; ++i) meet(glm::cross(corner[(i + 1) % 3] - corner[i], forward), corner[i]);
    }
    std::ranges::sort(result);
    return result;
}

scene box_scene()
{
    mesh box{.name = "box", .positions = {}, .normals = {}, .triangles = {}};
    add_box(box, upright({0, 0.625f, 0}, {1, 0.75f, 1}));
    return {"box", {box}};
}

camera from_above(const scene& world) { return orthographic_view(bounds_of(world).corners(), {0, -1, 0}); }

} // namespace

TEST_CASE("lit parts are those that no triangle shadows, of random triangles, lights and rays")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-1, 1);
    const auto anywhere = [&] { return glm::vec3(place(random), place(random), place(random)); };
    int dark = 0, light = 0;
    for (int trial = 0; trial < 40; ++trial) {
        scene world{"random", {{.name = "", .positions = {}, .normals = {}, .triangles = {}}}};
        mesh& part = world.meshes[0];
        std::vector<std::array<vec, 3>> triangles;
        for (unsigned i = 0; i < 40; ++i) {
            const glm::vec3 centre = anywhere();
            // Every fourth is a neighbour of the one before.
            for (unsigned k = 0; k < 3; ++k)
                part.positions.push_back(i % 4 == 3 && k < 2 ? part.positions[3 * i - 2 + k]
                                                             : centre + 0.4f * anywhere());
            part.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            triangles.push_back(
                {vec(part.positions[3 * i]), vec(part.positions[3 * i + 1]), vec(part.positions[3 * i + 2])});
        }
        const camera sun = orthographic_view(part.positions, glm::dvec3(anywhere()));
        const shadow_volumes shadows(world, sun);
        for (int i = 0; i < 60; ++i) {
            // Rays from inside and from far away, some of them almost along the light, with and without an end.
            const glm::dvec3 target(anywhere()), away = double(i % 4 - 1.5) * 1e5 * sun.forward;
            const glm::dvec3 origin = glm::dvec3(anywhere() * (i % 3 ? 1.f : 100.f)) + (i % 7 ? 0.0 : 1.0) * away;
            const view_ray ray{origin, glm::normalize(target - origin)};
            const double length = i % 5 ? (i % 2 ? 1 : 2) * glm::length(target - origin) : infinity;
            const std::vector<lit_segment> lit = shadows.lit(ray, length);
            for (std::size_t k = 0; k < lit.size(); ++k) {
                CHECK(lit[k].from < lit[k].to);
                CHECK(lit[k].to <= (k + 1 < lit.size() ? lit[k + 1].from : length));
            }
            const std::vector<double> at = changes(triangles, vec(sun.forward), ray, std::min(length, 1e6));
            for (std::size_t k = 0; k + 1 < at.size(); ++k) {
                if (at[k + 1] - at[k] < 1e-7) continue;
                const double middle = 0.5 * (at[k] + at[k + 1]);
                const bool in_shadow = shadowed(triangles, vec(sun.forward), vec(ray.origin + middle * ray.direction));
                CHECK(contains(lit, middle) == !in_shadow);
                in_shadow ? ++dark : ++light;
            }
        }
    }
    CHECK(dark > 20000);
    CHECK(light > 20000);
}

TEST_CASE("traced points of the stages are lit in the lit parts and nowhere else")
{
    constexpr int width = 48, height = 27, points = 64;
    for (const scattering_stage& of : {room_stage(16.0 / 9), trees_stage(16.0 / 9), gate_stage(16.0 / 9, 0.5f)}) {
        CAPTURE(of.world.name);
        const shadow_volumes shadows(of.world, of.light);
        const auto lengths = ray_lengths(of.eye, rasterize_surfaces(of.world, of.eye, width, height));
        std::vector<receiver> along;
        std::vector<float> expected;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const view_ray ray = unit_ray(of.eye, x, y, width, height);
                const auto length = static_cast<double>(lengths(x, y));
                const std::vector<lit_segment> lit = shadows.lit(ray, length);
                for (int i = 0; i < points; ++i) {
                    const double at = length * (i + 0.5) / points;
                    along.push_back({glm::vec3(ray.origin + at * ray.direction), glm::vec3(-of.light.forward)});
                    expected.push_back(contains(lit, at) ? 1.f : 0.f);
                }
            }
        std::vector<float> traced(along.size());
        tracer(of.world).visibility(of.light, along, traced);
        std::size_t different = 0;
        for (std::size_t i = 0; i < traced.size(); ++i) different += traced[i] != expected[i];
        // Positions of receivers are rounded to float, and their rays start a little nearer to the light.
        CHECK(different < traced.size() / 500);
        CHECK(std::ranges::count(traced, 0.f) > 20000);
        CHECK(std::ranges::count(traced, 1.f) > 5000);
    }
}

TEST_CASE("rays along the light, in planes of triangles, from inside of a box and of no length")
{
    const scene world = box_scene(); // from y = 0.25 to 1
    const camera sun = from_above(world);
    const shadow_volumes shadows(world, sun);
    using parts = std::vector<lit_segment>;
    const glm::dvec3 right(1, 0, 0), up(0, 1, 0);
    // The light is straight above: down to the top of the box, whose two triangles meet in the ray, and up from below.
    CHECK(shadows.lit({{0, 3, 0}, -up}, 3) == parts{{0, 2}});
    CHECK(shadows.lit({{0, 0.125, 0}, up}, infinity) == parts{{0.875, infinity}});
    CHECK(shadows.lit({{0.25, 3, 0.125}, -up}, infinity) == parts{{0, 2}});
    CHECK(shadows.lit({{0.75, 3, 0}, -up}, infinity) == parts{{0, infinity}});
    // Across the shadow, below the box, inside of it, on its top, and above.
    CHECK(shadows.lit({{-2, 0, 0}, right}, 4) == parts{{0, 1.5}, {2.5, 4}});
    CHECK(shadows.lit({{-2, -1e6, 0.25}, right}, infinity) == parts{{0, 1.5}, {2.5, infinity}});
    CHECK(shadows.lit({{0, 0.5, 0}, right}, 4) == parts{{0.5, 4}});
    CHECK(shadows.lit({{0, 0.5, 0}, right}, 0.25).empty());
    CHECK(shadows.lit({{-2, 1, 0.25}, right}, 4) == parts{{0, 4}});
    CHECK(shadows.lit({{-2, 2, 0}, right}, 4) == parts{{0, 4}});
    CHECK(shadows.lit({{-2, 2, 0}, right}, 0).empty());
    // Beyond the sides, which are seen edge-on, and without casters.
    CHECK(shadows.lit({{0.625, 0, -2}, {0, 0, 1}}, 4) == parts{{0, 4}});
    CHECK(shadow_volumes({"empty", {}}, sun).lit({{0, 0, 0}, up}, infinity) == parts{{0, infinity}});
    const camera lamp = perspective_view(bounds_of(world).corners(), {0, -1, 0}, 0.5);
    CHECK_THROWS_AS(shadow_volumes(world, lamp), std::invalid_argument);
}

TEST_CASE("the visible share is the integral of density and transmittance over the lit parts")
{
    const std::vector<lit_segment> lit{{0.5, 1.25}, {2, 2.125}, {3.5, 6}}, dark{{0, 0.5}, {1.25, 2}, {2.125, 3.5}};
    constexpr double length = 6;
    for (const float falloff : {0.f, 0.3f, 1e-6f})
        for (const glm::dvec3& direction : {glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(0, -0.6, 0.8)})
            for (const float sigma : {0.f, 1e-12f, 0.25f, 4.f}) {
                const medium air{
                    .scattering = glm::vec3(0.75f * sigma), .absorption = glm::vec3(0.25f * sigma), .falloff = falloff};
                const view_ray ray{{0, 1, 0}, direction};
                double sum = 0, all = 0, passing = 1;
                constexpr int steps = 48000;
                for (int i = 0; i < steps; ++i) {
                    const double at = length * (i + 0.5) / steps;
                    const double density = std::exp(-double(falloff) * (ray.origin + at * direction).y);
                    const double absorbed = double(sigma) * density * length / steps;
                    const double scattered = density * passing * std::exp(-0.5 * absorbed);
                    all += scattered, passing *= std::exp(-absorbed);
                    if (contains(lit, at)) sum += scattered;
                }
                CAPTURE(falloff);
                CAPTURE(sigma);
                CHECK(visible_share(lit, air, ray, length) == doctest::Approx(sum / all).epsilon(1e-6));
                CHECK(visible_share(lit, air, ray, length) + visible_share(dark, air, ray, length) ==
                      doctest::Approx(1).epsilon(1e-12));
                CHECK(visible_share(std::vector<lit_segment>{{0, length}}, air, ray, length) == 1);
                CHECK(visible_share({}, air, ray, length) == 0);
                CHECK(visible_share({}, air, ray, 0) == 1);
            }
}

TEST_CASE("the visible share has its limits in thick air and on rays without end")
{
    const view_ray ray{{0, 0, 0}, {1, 0, 0}};
    const std::vector<lit_segment> near{{0, 1}}, far{{1, infinity}}, both{{0, 1}, {2, 3}};
    for (const float sigma : {1e4f, 1e30f, std::numeric_limits<float>::infinity()}) {
        const medium thick{.scattering = glm::vec3(sigma)};
        CHECK(visible_share(near, thick, ray, infinity) == 1);
        CHECK(visible_share(both, thick, ray, 4) == 1);
        CHECK(visible_share(far, thick, ray, infinity) == 0);
    }
    const medium haze{.scattering = glm::vec3(0.5f)};
    CHECK(visible_share(far, haze, ray, infinity) == doctest::Approx(std::exp(-0.5)).epsilon(1e-12));
    CHECK(visible_share(far, medium{}, ray, infinity) == 1);
    CHECK(visible_share(near, medium{}, ray, infinity) == 0);
}

TEST_CASE("pictures and lists of rays have the same visible shares, and lists fit together")
{
    const scattering_stage of = entering_stage(1.5, true);
    const shadow_volumes shadows(of.world, of.light);
    const auto lengths = ray_lengths(of.eye, rasterize_surfaces(of.world, of.eye, 30, 20));
    const auto visible = traced_scattering(shadows, of.air, of.eye, lengths);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) {
            const view_ray ray = unit_ray(of.eye, x, y, 30, 20);
            const auto length = static_cast<double>(lengths(x, y));
            const double share = visible_share(shadows.lit(ray, length), of.air, ray, length);
            CHECK(visible(x, y) == static_cast<float>(share));
        }
    const std::vector<view_ray> rays(2, {{0, 0, 0}, {1, 0, 0}});
    std::vector<float> room(2);
    CHECK_THROWS_AS(traced_scattering(shadows, of.air, rays, std::vector<double>{1}, room), std::invalid_argument);
}
