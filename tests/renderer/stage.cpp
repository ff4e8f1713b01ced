// The scene of Figure 4 shows at its points of interest what the figure is about; the scene of contacts shows contacts.
#include "renderer/scene/stage.hpp"

#include "renderer/raster/rasterizer.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace gnomon::renderer;

TEST_CASE("one, two and three occluding surfaces lie in the filter regions of the insets")
{
    const stage fence = fence_stage(16.0 / 9);
    constexpr int resolution = 1024, radius = 4; // the region of a 9-tap filter
    const auto from_light = rasterize_surfaces(fence.world, fence.light, resolution, resolution);
    const std::vector<std::set<std::string>> expected{
        {"fence", "ground"}, {"fence", "wall"}, {"sign", "fence", "wall"}};
    REQUIRE(fence.interests.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const glm::dvec3 at = project(fence.light, fence.interests[i].position);
        REQUIRE(within_view(at));
        std::set<std::string> names;
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                const surface& s =
                    from_light(static_cast<int>(at.x * resolution) + x, static_cast<int>(at.y * resolution) + y);
                REQUIRE(s.valid());
                names.insert(fence.world.meshes[static_cast<std::size_t>(s.mesh)].name);
            }
        CHECK(names == expected[i]);
    }
}

TEST_CASE("the camera sees the points of interest, on the ground and unobstructed")
{
    constexpr int width = 640, height = 360;
    const stage fence = fence_stage(double(width) / height);
    const auto seen = rasterize_surfaces(fence.world, fence.eye, width, height);
    for (const point_of_interest& place : fence.interests) {
        const rectangle inset = inset_around(place, fence.eye, 40, width, height);
        const surface& s = seen(inset.x + inset.width / 2, inset.y + inset.height / 2);
        REQUIRE(s.valid());
        CHECK(fence.world.meshes[static_cast<std::size_t>(s.mesh)].name == "ground");
    }
    CHECK(std::ranges::all_of(seen.pixels, [](const surface& s) { return s.valid(); })); // a bird sees no sky
}

TEST_CASE("next to a slat, lit ground and the slat before it lie in one filter region, as far apart as the inset says")
{
    constexpr int width = 640, height = 360, size = 53, resolution = 1024, radius = 4;
    const stage contact = contact_stage(double(width) / height);
    const auto seen = rasterize_surfaces(contact.world, contact.eye, width, height);
    const auto map = rasterize_depth<1>(contact.world, contact.light, resolution, resolution);
    const auto traced = traced_visibility(tracer(contact.world), contact.light, seen);
    const int ground = static_cast<int>(contact.world.meshes.size()) - 1;
    REQUIRE(contact.interests.size() == contact_gaps.size());
    for (std::size_t i = 0; i < contact_gaps.size(); ++i) {
        const rectangle inset = inset_around(contact.interests[i], contact.eye, size, width, height);
        int contacts = 0, sides = 0, alone = 0;
        for (int y = inset.y; y < inset.y + inset.height; ++y)
            for (int x = inset.x; x < inset.x + inset.width; ++x) {
                if (seen(x, y).mesh != ground || traced(x, y) < 1) continue;
                const glm::dvec3 at = project(contact.light, seen(x, y).position);
                float nearest = 1, farthest = -1;
                for (int v = -radius; v <= radius; ++v)
                    for (int u = -radius; u <= radius; ++u) {
                        const float z =
                            map(static_cast<int>(at.x * resolution) + u, static_cast<int>(at.y * resolution) + v)[0];
                        nearest = std::min(nearest, z), farthest = std::max(farthest, z);
                    }
                // A texel is 8 mm, the view 4.2 m deep and the ground's slope 0.02: 7e-5 per texel, 6 from the middle.
                CHECK(std::abs(double(farthest) - at.z) < 5e-4);
                const double gap = at.z - double(nearest);
                if (gap < 5e-4) ++alone;
                else if (std::abs(gap - contact_gaps[i]) < 5e-4) ++contacts;
                else ++sides; // of a slat, seen at the corner of the region
            }
        CHECK(contacts > size * size / 20);
        CHECK(sides < contacts / 50);
        CHECK(alone > size * size / 20);
    }
}

TEST_CASE("a shadow map look-up agrees with the tracer but for the outlines of shadows")
{
    constexpr int width = 320, height = 180, resolution = 1024;
    const stage fence = fence_stage(double(width) / height);
    const auto seen = rasterize_surfaces(fence.world, fence.eye, width, height);
    const auto map = rasterize_depth<1>(fence.world, fence.light, resolution, resolution);
    const auto traced = traced_visibility(tracer(fence.world), fence.light, seen);
    int receivers = 0, different = 0, shadowed = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (!faces_light(fence.light, seen(x, y))) continue;
            const glm::dvec3 at = project(fence.light, seen(x, y).position);
            // A texel is 5 mm, the view 6 m deep: a slope of one changes depth by 2e-3 per texel.
            const glm::ivec2 texel(glm::dvec2(at) * double(resolution));
            const bool lit = !within_view(at) || double(map(texel.x, texel.y)[0]) > at.z - 4e-3;
            ++receivers, different += lit != (traced(x, y) == 1), shadowed += traced(x, y) == 0;
        }
    CHECK(receivers > width * height / 2);
    CHECK(shadowed > receivers / 10);
    // Shadows of 80 slats, about 500 mm long, have outlines of a texel's width: less than a twentieth of the picture.
    CHECK(different < receivers / 20);
}

TEST_CASE("shading is dark in shadow, and unchanged on sides that face away from the sun")
{
    const stage fence = fence_stage(1.5);
    const auto seen = rasterize_surfaces(fence.world, fence.eye, 60, 40);
    const picture lit = shade(fence.world, fence.light, seen, image<float>(60, 40, 1));
    const picture dark = shade(fence.world, fence.light, seen, image<float>(60, 40, 0));
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        CHECK((dark.pixels[i].r < lit.pixels[i].r) == faces_light(fence.light, seen.pixels[i]));
}
