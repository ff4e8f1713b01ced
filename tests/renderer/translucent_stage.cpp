// The stage of translucent occluders shows at its points of interest what they are named after.
#include "renderer/scene/translucent_stage.hpp"

#include "renderer/raster/fragments.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

using namespace gnomon::renderer;

namespace {

const point_of_interest& interest(const stage& of, const std::string& id)
{
    const auto found = std::ranges::find(of.interests, id, &point_of_interest::id);
    REQUIRE(found != of.interests.end());
    return *found;
}

const mesh& named(const scene& world, const std::string& name)
{
    const auto found = std::ranges::find(world.meshes, name, &mesh::name);
    REQUIRE(found != world.meshes.end());
    return *found;
}

} // namespace

TEST_CASE("smoke is thirty planes across the light, from far to near, of no more than 15%")
{
    const stage yard = translucent_stage(1.5);
    const mesh& smoke = named(yard.world, "smoke");
    REQUIRE(smoke.positions.size() == 4 * smoke_planes);
    double last = 2;
    for (int k = 0; k < smoke_planes; ++k) {
        double depth = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double z = project(yard.light, smoke.positions[4 * static_cast<std::size_t>(k) + i]).z;
            if (i > 0) CHECK(z == doctest::Approx(depth).epsilon(1e-5));
            depth = z;
        }
        CHECK(depth < last - 0.005);
        last = depth;
    }
    const fragment_map map = rasterize_fragments(yard.world, yard.light, 256, 256);
    float densest = 0;
    std::size_t most = 0;
    for (std::size_t i = 0; i + 1 < map.first.size(); ++i) {
        most = std::max(most, map(i).size());
        for (const fragment& f : map(i)) {
            if (yard.world.meshes[static_cast<std::size_t>(f.mesh)].name != "smoke") continue;
            CHECK(f.opacity.g <= smoke_opacity);
            densest = std::max(densest, f.opacity.g);
        }
    }
    CHECK(densest > 0.9f * smoke_opacity);
    CHECK(most > smoke_planes / 2);
}

TEST_CASE(
    "at the points of interest, light leaks behind a pipe, a pipe's edge lies behind smoke, and glass is coloured")
{
    constexpr int width = 480, height = 270, resolution = 1024, radius = 13;
    const stage yard = translucent_stage(double(width) / height);
    const auto seen = rasterize_surface_layers(yard.world, yard.eye, width, height);
    const auto opaque = rasterize_surfaces(opaque_part(yard.world), yard.light, resolution, resolution);
    const fragment_map map = rasterize_fragments(yard.world, yard.light, resolution, resolution);
    const layer_visibility light = traced_transmittance(tracer(yard.world), yard.light, seen);
    const auto in_region = [&](const point_of_interest& place) {
        const glm::ivec2 at(glm::dvec2(project(yard.light, place.position)) * double(resolution));
        std::set<std::string> names;
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const surface& s = opaque(at.x + x, at.y + y);
                if (s.valid()) names.insert(yard.world.meshes[static_cast<std::size_t>(s.mesh)].name);
                for (const fragment& f : map(at.x + x, at.y + y))
                    names.insert(yard.world.meshes[static_cast<std::size_t>(f.mesh)].name);
            }
        return names;
    };
    const auto pixel = [&](const point_of_interest& place) {
        const rectangle inset = inset_around(place, yard.eye, 1, width, height);
        return static_cast<std::size_t>(inset.y * width + inset.x);
    };
    const auto name_at = [&](std::size_t at) {
        REQUIRE(seen.opaque.pixels[at].valid());
        return yard.world.meshes[static_cast<std::size_t>(seen.opaque.pixels[at].mesh)].name;
    };

    const point_of_interest& pipe = interest(yard, "pipe");
    CHECK(name_at(pixel(pipe)) == "walls");
    CHECK(light.opaque.pixels[pixel(pipe)] == glm::vec3(0)); // any light here is a leak
    CHECK(in_region(pipe).contains("green pipe"));
    CHECK(in_region(pipe).contains("smoke"));

    const auto at_silhouette = in_region(interest(yard, "silhouette"));
    CHECK(at_silhouette.contains("smoke"));
    CHECK(at_silhouette.contains("blue pipe"));
    CHECK((at_silhouette.contains("ground") || at_silhouette.contains("walls")));

    for (const char* id : {"silhouette", "smoke"}) {
        const point_of_interest& place = interest(yard, id);
        CHECK(seen(pixel(place)).size() >= 5);
        // Smoke before the place, and smoke behind.
        const glm::dvec3 from_light = project(yard.light, place.position);
        const auto list = map(static_cast<int>(from_light.x * resolution), static_cast<int>(from_light.y * resolution));
        const auto before =
            std::ranges::count_if(list, [&](const fragment& f) { return double(f.depth) < from_light.z; });
        CHECK(before >= 3);
        CHECK(std::ssize(list) - before >= 3);
    }

    const glm::vec3 through_glass = light.opaque.pixels[pixel(interest(yard, "glass"))];
    CHECK(name_at(pixel(interest(yard, "glass"))) == "ground");
    CHECK(glm::length(through_glass - glm::vec3(through_glass.g)) > 0.1f);
}

TEST_CASE("from close by, smoke covers the picture many times over")
{
    constexpr int width = 96, height = 54;
    const stage close = smoke_close_up_stage(double(width) / height);
    const auto seen = rasterize_surface_layers(close.world, close.eye, width, height);
    CHECK(seen.layers.size() > 6 * width * height);
    for (const point_of_interest& place : close.interests) CHECK(within_view(project(close.eye, place.position)));
}
