// Rays to area lights and through translucent meshes, compared with closed forms and with rasterized fragments.
#include "renderer/scene/translucent_stage.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon::renderer;

namespace {

mesh plane(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, const glm::vec3& opacity = glm::vec3(1))
{
    mesh result{.name = "plane", .positions = {}, .normals = {}, .triangles = {}, .opacity = opacity};
    add_quad(result, corner, u, v);
    return result;
}

// A light straight above: right is +x, up is -z.
camera from_above(projection kind, double height)
{
    return {.kind = kind,
            .position = {0, height, 0},
            .right = {1, 0, 0},
            .up = {0, 0, -1},
            .forward = {0, -1, 0},
            .half_extent = glm::dvec2(1),
            .near_distance = 0.1,
            .far_distance = height};
}

std::vector<receiver> along_x(int count, float reach)
{
    std::vector<receiver> result;
    for (int i = 0; i < count; ++i)
        result.push_back(
            {{reach * (2 * (static_cast<float>(i) + 0.37f) / static_cast<float>(count) - 1), 0, 0}, {0, 1, 0}});
    return result;
}

// The share of the square [-1/2, 1/2]^2 where a x + b y < c, for a, b > 0.
double share_of_square(double a, double b, double c)
{
    const double d = c + 0.5 * (a + b); // the same for [0, 1]^2
    const auto square = [](double x) { return x > 0 ? x * x : 0; };
    return (square(d) - square(d - a) - square(d - b) + square(d - a - b)) / (2 * a * b);
}

} // namespace

TEST_CASE("the penumbra of a half plane is linear, as wide as the size of the light says")
{
    // The half plane x < 0 at this height.
    const double height = 2, light_height = 5;
    const tracer rays(scene{"", {plane({-50, float(height), -50}, {50, 0, 0}, {0, 0, 100})}});
    for (const projection kind : {projection::orthographic, projection::perspective})
        for (const bool along_right : {true, false}) {
            const double size = 0.3;
            // Turned by a quarter, the light has its up axis across the edge.
            area_light light{from_above(kind, light_height), along_right ? glm::dvec2(size, 0) : glm::dvec2(0, size)};
            if (!along_right) light.map.right = {0, 0, 1}, light.map.up = {1, 0, 0};
            // A ray to a place p right of the light's centre meets the height of the edge at x + (p - x) h / H.
            const double width = kind == projection::orthographic ? 2 * height * std::tan(0.5 * size)
                                                                  : size * height / (light_height - height);
            const auto receivers = along_x(101, 0.35f);
            std::vector<float> visible(receivers.size());
            rays.visibility(light, receivers, 256, visible);
            int partly = 0;
            for (std::size_t i = 0; i < receivers.size(); ++i) {
                const double expected = std::clamp(0.5 + double(receivers[i].position.x) / width, 0.0, 1.0);
                CHECK(std::abs(double(visible[i]) - expected) <= 1.01 / 256);
                partly += visible[i] > 0 && visible[i] < 1;
            }
            CHECK(partly > 25);
        }
}

TEST_CASE("stratified samples of a rectangle cut by a slanted edge come close to its area")
{
    const double height = 2, size_x = 0.3, size_y = 0.2;
    // The edge of the half plane runs along (1, 0, -1).
    const glm::vec3 along(40, 0, -40), across(-40, 0, -40);
    const tracer rays(scene{"", {plane(glm::vec3(0, float(height), 0) - 0.5f * along, along, across)}});
    const area_light light{from_above(projection::orthographic, 5), {size_x, size_y}};
    const auto receivers = along_x(301, 0.5f);
    std::vector<float> visible(receivers.size());
    rays.visibility(light, receivers, 256, visible);
    const double wide = 2 * height * std::tan(0.5 * size_x), high = 2 * height * std::tan(0.5 * size_y);
    double square = 0;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        // At the height of the edge a ray has come by u right and v up, thus -v along z: it is stopped on the side of
        // `across`, where x + z < 0.
        const double expected = 1 - share_of_square(wide, high, -double(receivers[i].position.x));
        const double error = double(visible[i]) - expected;
        CHECK(std::abs(error) < 0.03);
        square += error * error;
    }
    // Unstratified samples have a standard deviation of up to 1/32.
    CHECK(std::sqrt(square / double(receivers.size())) < 0.006);
}

TEST_CASE("a light of no size casts the hard shadow, and the part below a receiver's plane is not seen")
{
    const stage yard = translucent_stage(1.5);
    const tracer rays(opaque_part(yard.world));
    const auto seen = rasterize_surfaces(opaque_part(yard.world), yard.eye, 90, 60);
    const auto hard = traced_visibility(rays, yard.light, seen);
    const auto soft = traced_visibility(rays, yard.area(), seen, 4);
    int shadowed = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        if (!seen.pixels[i].valid() ||
            glm::dot(direction_towards(yard.light, seen.pixels[i].position), glm::dvec3(seen.pixels[i].normal)) <= 0)
            continue;
        CHECK(soft.pixels[i] == hard.pixels[i]);
        shadowed += hard.pixels[i] == 0;
    }
    CHECK(shadowed > 50);

    // A wall in the plane of the light's centre sees half of the light.
    const std::vector<receiver> wall{{{0, 0, 0}, {1, 0, 0}}};
    std::vector<float> half(1);
    tracer(scene{}).visibility({from_above(projection::orthographic, 5), glm::dvec2(0.2)}, wall, 256, half);
    CHECK(half[0] == doctest::Approx(0.5).epsilon(0.01));
}

TEST_CASE("light that passes layers is the product of what they let pass; an opaque one ends it")
{
    constexpr int layers = 200;
    scene world{"", {}};
    glm::dvec3 expected(1);
    for (int i = 0; i < layers; ++i) {
        const glm::vec3 opacity = 0.02f * glm::vec3(1, 0.5f, 0) + 0.0001f * static_cast<float>(i);
        world.meshes.push_back(plane({-1, 1 + 1e-3f * static_cast<float>(i), -1}, {0, 0, 2}, {2, 0, 0}, opacity));
        expected *= 1.0 - glm::dvec3(opacity);
    }
    // On the diagonals that two triangles share, at corners of lattices, and elsewhere; one beside all layers.
    const std::vector<receiver> receivers{
        {{0, 0, 0}, {0, 1, 0}}, {{0.5f, 0, 0.5f}, {0, 1, 0}}, {{0.3f, 0, -0.7f}, {0, 1, 0}}, {{1.5f, 0, 0}, {0, 1, 0}}};
    std::vector<glm::vec3> light(receivers.size());
    const camera sun = from_above(projection::orthographic, 5);
    tracer(world).transmittance(sun, receivers, light);
    for (int i = 0; i < 3; ++i) CHECK(glm::length(glm::dvec3(light[static_cast<std::size_t>(i)]) - expected) < 1e-6);
    CHECK(light[3] == glm::vec3(1));

    std::vector<float> visible(receivers.size());
    tracer(world).visibility(sun, receivers, visible);
    CHECK(visible == std::vector<float>{0, 0, 0, 1}); // to which all meshes are opaque

    world.meshes.push_back(plane({-1, 2, -1}, {0, 0, 2}, {2, 0, 0}));
    tracer(world).transmittance(sun, receivers, light);
    CHECK(std::ranges::count(light, glm::vec3(0)) == 3);
    CHECK(light[3] == glm::vec3(1));
}

TEST_CASE("rays from the opaque surfaces that a light sees pass the fragments of its map")
{
    constexpr int size = 128;
    const stage yard = translucent_stage(1.5);
    const fragment_map map = rasterize_fragments(yard.world, yard.light, size, size);
    const auto seen = rasterize_surfaces(opaque_part(yard.world), yard.light, size, size);
    std::vector<receiver> receivers;
    for (const surface& s : seen.pixels) receivers.push_back({s.position, s.normal});
    std::vector<glm::vec3> light(receivers.size());
    tracer(yard.world).transmittance(yard.light, receivers, light);
    int different = 0, attenuated = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (!seen.pixels[i].valid()) continue;
        glm::dvec3 expected(1);
        for (const fragment& f : map(i)) expected *= 1.0 - glm::dvec3(f.opacity);
        // Rays start 0.1 mm off the surface, elsewhere in the smoke. At the edge of a pane, of a pipe or of the window's
        // bars, rounding decides.
        different += glm::length(glm::dvec3(light[i]) - expected) > 1e-3;
        attenuated += !map(i).empty();
    }
    CHECK(attenuated > size * size / 10);
    CHECK(different < size * size / 500);
}

TEST_CASE("the mean transmittance of an area light is that of its rays")
{
    // Half of the light behind a pane of 40%, the other half not.
    const tracer rays(scene{"", {plane({-50, 2, -50}, {0, 0, 100}, {50, 0, 0}, {0.4f, 0.1f, 1})}});
    const std::vector<receiver> receivers{{{0, 0, 0}, {0, 1, 0}}, {{-9, 0, 0}, {0, 1, 0}}, {{9, 0, 0}, {0, 1, 0}}};
    std::vector<glm::vec3> light(receivers.size());
    rays.transmittance({from_above(projection::orthographic, 5), glm::dvec2(0.2)}, receivers, 256, light);
    CHECK(glm::length(light[0] - glm::vec3(0.8f, 0.95f, 0.5f)) < 0.01f);
    CHECK(glm::length(light[1] - glm::vec3(0.6f, 0.9f, 0)) < 1e-6f);
    CHECK(light[2] == glm::vec3(1));
}

TEST_CASE("rays to lights do not depend on the number of threads, and sizes are checked")
{
    const stage yard = translucent_stage(1.5);
    const tracer rays(yard.world);
    const surface_layers seen = rasterize_surface_layers(yard.world, yard.eye, 60, 40);
    std::vector<receiver> receivers;
    for (const surface& s : seen.opaque.pixels)
        if (s.valid()) receivers.push_back({s.position, s.normal});
    const area_light sun{yard.light, glm::dvec2(0.05)};
    const auto trace = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            std::vector<float> visible(receivers.size());
            std::vector<glm::vec3> light(receivers.size());
            rays.visibility(sun, receivers, 256, visible);
            rays.transmittance(sun, receivers, 33, light);
            return std::pair(visible, light);
        });
    };
    const auto serial = trace(1);
    CHECK(std::ranges::count_if(serial.first, [](float v) { return v > 0 && v < 1; }) > 20);
    CHECK(trace(2) == serial);
    CHECK(trace(7) == serial);

    std::vector<float> visible(1);
    CHECK_THROWS_WITH(rays.visibility(sun, std::span(receivers).first(2), 256, visible),
                      "tracer: 2 receivers, room for 1 results");
    CHECK_THROWS_WITH(rays.visibility(sun, std::span(receivers).first(1), 0, visible),
                      "tracer: 0 samples, at least one expected");
}
