// Linear depth, fitted views, and the footprint of a pixel in a shadow map.
#include "renderer/scene/camera.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

using namespace gnomon::renderer;

namespace {

// Coordinates from thousandths, sizes from 1/1000 to 1000.
rc::Gen<glm::vec3> any_vector()
{
    return rc::gen::map(rc::gen::container<std::vector<int>>(3, rc::gen::inRange(-1000, 1001)),
                        [](const std::vector<int>& v) { return 1e-3f * glm::vec3(v[0], v[1], v[2]); });
}

std::vector<glm::vec3> any_points()
{
    return *rc::gen::suchThat(rc::gen::container<std::vector<glm::vec3>>(any_vector()),
                              [](const auto& p) { return !p.empty(); });
}

glm::dvec3 any_direction()
{
    return glm::dvec3(*rc::gen::suchThat(any_vector(), [](const glm::vec3& v) { return glm::dot(v, v) > 0; }));
}

camera any_view(const std::vector<glm::vec3>& points)
{
    const double aspect = *rc::gen::element(0.5, 1.0, 1.75);
    if (*rc::gen::arbitrary<bool>()) return orthographic_view(points, any_direction(), aspect);
    return perspective_view(points, any_direction(), *rc::gen::element(0.1, 0.8, 2.0), aspect);
}

} // namespace

TEST_CASE("a fitted view sees every point")
{
    CHECK(rc::check("inside the picture and between the planes", [] {
        const auto points = any_points();
        const camera eye = any_view(points);
        for (const glm::vec3& point : points) RC_ASSERT(within_view(project(eye, point)));
    }));
}

TEST_CASE("a fitted view is tight")
{
    CHECK(rc::check("some point comes near an edge, some near a plane", [] {
        const auto points = any_points();
        // Views of a single point or a line towards it have no size to be tight about.
        RC_PRE(std::ranges::any_of(points, [&](const glm::vec3& p) { return glm::distance(p, points[0]) > 0.1f; }));
        const camera eye = orthographic_view(points, any_direction());
        double edge = 0, plane = 0;
        for (const glm::vec3& point : points) {
            const glm::dvec3 p = project(eye, point);
            edge = std::max({edge, std::abs(2 * p.x - 1), std::abs(2 * p.y - 1)});
            plane = std::max(plane, std::abs(p.z));
        }
        // The margins are a thousandth of the view; one of picture and depth may be flat, and is then padded.
        RC_ASSERT(std::max(edge, plane) > 0.99);
    }));
}

TEST_CASE("projection undoes the ray through a picture point, and depth is linear along it")
{
    CHECK(rc::check("orthographic and perspective", [] {
        const camera eye = any_view(any_points());
        const glm::dvec2 uv(*rc::gen::inRange(0, 1001) / 1000.0, *rc::gen::inRange(0, 1001) / 1000.0);
        const double share = *rc::gen::inRange(0, 1001) / 1000.0;
        const double t = eye.near_distance + share * (eye.far_distance - eye.near_distance);
        const view_ray ray = ray_through(eye, uv);
        const glm::dvec3 p = project(eye, ray.origin + t * ray.direction);
        // Doubles of size one and differences of such: the planes may be 1e-6 apart, so that 1e-16 becomes 1e-10.
        const double range = eye.far_distance - eye.near_distance, size = glm::length(eye.position) + eye.far_distance;
        const double tolerance = 1e-14 * size / std::min(range, std::min(eye.half_extent.x, eye.half_extent.y));
        RC_ASSERT(std::abs(p.x - uv.x) <= tolerance);
        RC_ASSERT(std::abs(p.y - uv.y) <= tolerance);
        RC_ASSERT(std::abs(p.z - (2 * share - 1)) <= 4 * tolerance);
    }));
}

TEST_CASE("near is -1 and far is +1 exactly")
{
    const camera eye{.near_distance = 0.1, .far_distance = 7.3};
    CHECK(linear_depth(eye, eye.near_distance) == -1);
    CHECK(linear_depth(eye, eye.far_distance) == 1);
}

TEST_CASE("a light can look straight down, and a view of no points is refused")
{
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 1, 1}};
    const camera light = orthographic_view(points, {0, -1, 0});
    CHECK(glm::dot(light.right, light.up) == 0);
    CHECK(direction_towards(light, {5, 5, 5}) == glm::dvec3(0, 1, 0));
    CHECK_THROWS_WITH(orthographic_view({}, {0, -1, 0}), "camera: there is nothing to look at");
    CHECK_THROWS_WITH(perspective_view(points, {0, 0, 0}, 1), "camera: direction has no length");
    CHECK_THROWS_WITH(perspective_view(points, {0, NAN, 0}, 1), "camera: direction has no length");
}

TEST_CASE("the points that a light has to see include the ends of shadows")
{
    bounds box;
    box.include({-1, 0, -1});
    box.include({1, 2, 1});
    const glm::vec3 direction(1, -2, 0);
    const auto points = casters_and_shadows(box, direction);
    // The upper edge x = 1 casts its shadow two units down, one to the right.
    CHECK(std::ranges::count(points, glm::vec3(2, 0, 1)) == 1);
    CHECK(std::ranges::all_of(points, [](const glm::vec3& p) { return p.y >= 0; }));
    CHECK_THROWS(casters_and_shadows(box, {1, 0, 0}));
}

TEST_CASE("the mip level is the binary logarithm of texels per pixel")
{
    const camera light{.position = {0, 0, 2}, .half_extent = {1, 1}, .near_distance = 1, .far_distance = 3};
    const int resolution = 1024; // 512 texels per unit
    CHECK(mip_level(light, {0, 0, 0}, {8 / 512.0, 0, 0}, {0, 2 / 512.0, 0}, resolution) == doctest::Approx(3));
    CHECK(mip_level(light, {0, 0, 0}, {0, 0, 1}, {0, 0.5 / 512, 0}, resolution) == 0);
}
