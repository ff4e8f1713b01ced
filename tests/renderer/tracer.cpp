// The traced reference against the shadow of a box, which is known in closed form.
#include "renderer/trace/tracer.hpp"

#include "renderer/scene/scene.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <random>
#include <vector>

using namespace gnomon::renderer;

namespace {

const glm::dvec3 box_lower(-0.5, 0.3, -0.25), box_upper(0.5, 1.1, 0.75);

// True if the segment from p to p + along meets the box, grown by `by` on all sides: the three slabs overlap.
bool meets_box(const glm::dvec3& p, const glm::dvec3& along, double by)
{
    double enter = 0, leave = 1;
    for (int i = 0; i < 3; ++i) {
        const double a = (box_lower[i] - by - p[i]) / along[i], b = (box_upper[i] + by - p[i]) / along[i];
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
            const glm::dvec3 segment = light.perspective() ? light.position - p : -100.0 * light.forward;
            // Within the ray's offset of the outline, float and closed form may differ; a hundred times that is left
            // out.
            const double margin = 100 * static_cast<double>(rays.offset());
            const bool surely = meets_box(p, segment, -margin), perhaps = meets_box(p, segment, margin);
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

TEST_CASE("an empty scene is lit, and sizes are checked")
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
