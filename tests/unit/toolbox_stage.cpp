// The scene of Figure 4 shows at its points of interest what the figure is about.
#include <doctest/doctest.h>
#include <toolbox/rasterizer.hpp>
#include <toolbox/shading.hpp>
#include <toolbox/stage.hpp>
#include <toolbox/tracer.hpp>

#include <algorithm>
#include <glm/vec2.hpp>
#include <set>

using namespace gnomon::toolbox;

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

TEST_CASE("shading is dark where the sun is hidden and unchanged where it does not shine anyway")
{
    const stage fence = fence_stage(1.5);
    const auto seen = rasterize_surfaces(fence.world, fence.eye, 60, 40);
    const picture lit = shade(fence.world, fence.light, seen, image<float>(60, 40, 1));
    const picture dark = shade(fence.world, fence.light, seen, image<float>(60, 40, 0));
    for (std::size_t i = 0; i < seen.pixels.size(); ++i)
        CHECK((dark.pixels[i].r < lit.pixels[i].r) == faces_light(fence.light, seen.pixels[i]));
}
