// Which triangles share an id since they cannot shadow one another.
#include "renderer/scene/surface_ids.hpp"

#include "renderer/scene/moving_stages.hpp"

#include <doctest/doctest.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace gnomon::renderer;

namespace {

moving_scene scene_of(const mesh& open, const mesh& closing) { return {{"scene", {open}}, {closing.positions}}; }

std::size_t surfaces(const moving_scene& world)
{
    const auto ids = surface_ids(world);
    return std::set(ids.begin(), ids.end()).size();
}

mesh box(float width)
{
    mesh result;
    add_box(result, upright(glm::vec3(1, 2, 3), {width, 1, 2}, 0.3f));
    return result;
}

// Two quads side by side, the second one turned up.
mesh hinge(float degrees)
{
    mesh result;
    const float angle = glm::radians(degrees);
    add_quad(result, {-1, 0, 0}, {1, 0, 0}, {0, 0, -1});
    add_quad(result, {0, 0, 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, -1});
    return result;
}

} // namespace

TEST_CASE("a convex box is one surface, and its sides are surfaces if a corner is pushed in")
{
    CHECK(surfaces(scene_of(box(1), box(1))) == 1);
    CHECK(surfaces(scene_of(box(1), box(3))) == 1); // all sides stay flat
    mesh dented = box(1);
    const glm::vec3 corner = dented.positions[0];
    for (glm::vec3& p : dented.positions)
        if (p == corner) p += 0.6f * (glm::vec3(1, 2, 3) - corner);
    const auto ids = surface_ids(scene_of(box(1), dented));
    REQUIRE(ids.size() == 12);
    CHECK(surfaces(scene_of(box(1), dented)) == 9); // three sides stay in their planes
}

TEST_CASE("planes are surfaces as long as they stay flat, and their ids are their first triangles")
{
    CHECK(surfaces(scene_of(hinge(0), hinge(0))) == 1);
    CHECK(surfaces(scene_of(hinge(20), hinge(20))) == 2);
    CHECK(surfaces(scene_of(hinge(0), hinge(20))) == 2);
    CHECK(surfaces(scene_of(hinge(20), hinge(0))) == 2);
    const auto ids = surface_ids(scene_of(hinge(0), hinge(20)));
    CHECK(ids == std::vector<std::uint32_t>{0, 0, 2, 2});
    // Flat at both ends, and folded between them.
    mesh folded = hinge(0);
    for (glm::vec3& p : folded.positions) p = p.x > 0.5f ? glm::vec3(-p.x, p.y, p.z) : p;
    mesh raised = folded;
    for (glm::vec3& p : raised.positions) p = {p.y, p.x, p.z};
    CHECK(surfaces(scene_of(hinge(0), raised)) == 2);
}

TEST_CASE("parts that do not touch, and parts with a hole, are surfaces of their own")
{
    mesh two = box(1), open = box(1);
    add_box(two, upright(glm::vec3(9), glm::vec3(1)));
    CHECK(surfaces(scene_of(two, two)) == 2);
    open.triangles.resize(10); // one side is missing: what is inside may be shadowed
    CHECK(surfaces(scene_of(open, open)) == 5);
    moving_scene many = scene_of(box(1), box(1));
    many.open.meshes.push_back(hinge(0)), many.closing.push_back(hinge(0).positions);
    const auto ids = surface_ids(many);
    CHECK(ids.back() == 12); // of the second mesh
}

TEST_CASE("the scenes of the papers have few surfaces")
{
    // Two cubes of 5808 triangles, and the ground.
    CHECK(surfaces(cubes_to_the_light(1).world) == 3);
    CHECK(surfaces(random_cubes(1, 20, 0.5f).world) == 21);
    // Blades that shear stay level.
    CHECK(surfaces(fan(1).world) == 9);
}
