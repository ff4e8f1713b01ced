// The stages of soft shadows show what their figures are about.
#include "renderer/scene/soft_stages.hpp"

#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/tube.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

using namespace gnomon::renderer;

namespace {

const std::array stages{models_stage, lamp_stage, long_range_stage, pillar_stage, grazing_stage};

// The width in texels of the penumbra that a caster at the near plane casts on a receiver at the far plane.
double largest_penumbra(const stage& of, int resolution)
{
    const camera& map = of.light;
    const double texels = resolution / (2 * map.half_extent.x);
    if (map.perspective()) return of.light_size.x * (1 / map.near_distance - 1 / map.far_distance) * texels;
    return (map.far_distance - map.near_distance) * 2 * std::tan(0.5 * of.light_size.x) * texels;
}

// The names of the meshes in the square of 27 texels around a point.
std::set<std::string> in_search_region(const stage& of, const glm::vec3& position)
{
    constexpr int resolution = 1024, radius = 13;
    const auto seen = rasterize_surfaces(of.world, of.light, resolution, resolution);
    const glm::ivec2 at(glm::dvec2(project(of.light, position)) * double(resolution));
    std::set<std::string> names;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            if (const surface& s = seen(at.x + x, at.y + y); s.valid())
                names.insert(of.world.meshes[static_cast<std::size_t>(s.mesh)].name);
    return names;
}

} // namespace

TEST_CASE("a tube is closed, round and turned outwards")
{
    mesh ring{.name = "ring", .positions = {}, .normals = {}, .triangles = {}};
    std::vector<glm::vec3> path;
    for (int i = 0; i < 60; ++i) {
        const float t = glm::two_pi<float>() * static_cast<float>(i) / 60;
        path.emplace_back(2 * std::cos(t), std::sin(2 * t), 2 * std::sin(t));
    }
    add_tube(ring, path, 0.3f, 12, true);
    REQUIRE(ring.positions.size() == ring.normals.size());
    for (std::size_t i = 0; i < ring.positions.size(); ++i) {
        CHECK(glm::length(ring.normals[i]) == doctest::Approx(1).epsilon(1e-5));
        CHECK(glm::length(ring.positions[i] - path[i / 12]) == doctest::Approx(0.3).epsilon(1e-5));
    }
    // Of a closed surface whose triangles are counter-clockwise from outside, one sees front sides only.
    const scene world{"", {ring}};
    const camera eye = perspective_view(bounds_of(world).corners(), {-0.3, -0.5, -1}, 0.8);
    const auto front = rasterize_depth<1>(world, eye, 128, 128, faces::front);
    CHECK(front.pixels == rasterize_depth<1>(world, eye, 128, 128).pixels);
    CHECK(std::ranges::count_if(front.pixels, [](const auto& d) { return d[0] < 1; }) > 1000);
    // Rings that join without a twist: no triangle is long.
    for (const glm::uvec3& t : ring.triangles)
        for (int k = 0; k < 3; ++k) CHECK(glm::length(ring.positions[t[k]] - ring.positions[t[(k + 1) % 3]]) < 0.65f);
}

TEST_CASE("each stage has an area light, penumbrae of tens of texels, and points of interest on lit ground in view")
{
    for (const auto make : stages) {
        const stage of = make(16.0 / 9);
        CAPTURE(of.world.name);
        CHECK(of.light_size.x > 0);
        CHECK(of.light_size.y > 0);
        CHECK(largest_penumbra(of, 1024) > 20);
        CHECK(largest_penumbra(of, 1024) < 100);
        CHECK(std::ranges::all_of(of.world.meshes, [](const mesh& part) { return part.opaque(); }));
        REQUIRE(!of.interests.empty());
        for (const point_of_interest& place : of.interests) {
            CHECK(within_view(project(of.eye, place.position)));
            CHECK(within_view(project(of.light, place.position)));
        }
    }
}

TEST_CASE("every inset holds light, shade and penumbra")
{
    constexpr int width = 320, height = 180, size = 20;
    for (const auto make : stages) {
        const stage of = make(double(width) / height);
        const auto seen = rasterize_surfaces(of.world, of.eye, width, height);
        const auto visible = traced_visibility(tracer(of.world), of.area(), seen, 64);
        for (const point_of_interest& place : of.interests) {
            CAPTURE(of.world.name);
            CAPTURE(place.id);
            const rectangle inset = inset_around(place, of.eye, size, width, height);
            int between = 0;
            float darkest = 1, brightest = 0;
            for (int y = inset.y; y < inset.y + size; ++y)
                for (int x = inset.x; x < inset.x + size; ++x) {
                    const float v = visible(x, y);
                    darkest = std::min(darkest, v), brightest = std::max(brightest, v);
                    between += static_cast<int>(v > 0 && v < 1);
                }
            CHECK(darkest < 0.7f);
            CHECK(brightest > 0.9f);
            CHECK(between > 3);
        }
    }
}

TEST_CASE("long-range shadows are cast from high above the ground, short-range ones beside them")
{
    const stage of = long_range_stage(1.5);
    for (const mesh& part : of.world.meshes) {
        const bounds box = bounds_of(scene{"", {part}});
        if (part.name == "signs" || part.name == "cables") CHECK(box.lower.y > 4);
        if (part.name == "bench") CHECK(box.upper.y < 0.6f);
    }
}

TEST_CASE("beside the wall's shadow a search region holds the pillar and the wall, on the other side the pillar alone")
{
    const stage of = pillar_stage(1.5);
    REQUIRE(of.interests.size() == 2);
    CHECK(in_search_region(of, of.interests[0].position) == std::set<std::string>{"pillar", "ground"});
    const auto both = in_search_region(of, of.interests[1].position);
    CHECK(both.contains("pillar"));
    CHECK(both.contains("ground"));
    CHECK((both.contains("bricks") || both.contains("mortar")));
    // The hardness of both contacts is the same: by symmetry, but for the light that the wall takes away.
    CHECK(of.interests[0].position.x == -of.interests[1].position.x);
    CHECK(of.light.forward.x == doctest::Approx(0));
}

TEST_CASE("the ground below the column is lit at 80 degrees, on both sides of the shadow")
{
    const stage of = grazing_stage(1.5);
    const double cosine = -of.light.forward.y;
    CHECK(glm::degrees(std::acos(cosine)) == doctest::Approx(80).epsilon(1e-5));
    for (const float z : {-1.5f, 1.5f})
        for (const float x : {0.f, 4.f, 8.f}) CHECK(within_view(project(of.light, {x, 0, z})));
}
