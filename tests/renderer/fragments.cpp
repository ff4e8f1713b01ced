// The fragments of translucent meshes, compared with rays that meet each triangle in turn.
#include "renderer/raster/fragments.hpp"

#include "renderer/scene/translucent_stage.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <rapidcheck.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon::renderer;

namespace {

constexpr int pixels = 40;

float stripes(const glm::vec2& at) { return at.x < 0.25f ? 0.f : at.y; }

// Meshes of one triangle each, with corners in [-1.2, 1.2]^3: most of them translucent, some of these with an alpha.
scene random_triangles(unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1.2f, 1.2f), opacity(0.05f, 0.9f);
    scene result{"triangles", {}};
    for (unsigned i = 0; i < 14; ++i) {
        mesh part{.name = "triangle", .positions = {}, .normals = {}, .triangles = {{0, 1, 2}}};
        for (int k = 0; k < 3; ++k) part.positions.emplace_back(place(random), place(random), place(random));
        if (i % 5 != 0) part.opacity = {opacity(random), opacity(random), opacity(random)};
        if (i % 5 == 1) part.alpha = stripes, part.texture_coordinates = {{0, 0}, {1, 0}, {0.5f, 1}};
        result.meshes.push_back(part);
    }
    return result;
}

camera looking_at_origin(projection kind)
{
    camera eye{.kind = kind, .position = {0, 0, 3}, .near_distance = 1, .far_distance = 5};
    if (eye.perspective()) eye.half_extent = {0.4, 0.4};
    return eye;
}

struct met {
    double depth;
    glm::dvec3 weights;
};

// Moeller and Trumbore, on the plane of the triangle.
met intersect(const camera& eye, const view_ray& ray, const mesh& part)
{
    const glm::dvec3 a = part.positions[0], b = part.positions[1], c = part.positions[2];
    const glm::dvec3 p = glm::cross(ray.direction, c - a), q = glm::cross(ray.origin - a, b - a);
    const double determinant = glm::dot(p, b - a);
    const double u = glm::dot(p, ray.origin - a) / determinant, v = glm::dot(q, ray.direction) / determinant;
    return {linear_depth(eye, glm::dot(q, c - a) / determinant), {1 - u - v, u, v}};
}

struct expected_fragments {
    std::vector<fragment> list; // back to front
    bool certain = true;        // false if an edge passes near the centre of the pixel, or depths lie close together
};

expected_fragments by_rays(const scene& world, const camera& eye, int x, int y)
{
    const view_ray ray = ray_through(eye, (glm::dvec2(x, y) + 0.5) / double(pixels));
    expected_fragments result;
    double opaque = 1;
    std::vector<double> depths;
    for (std::size_t m = 0; m < world.meshes.size(); ++m) {
        const mesh& part = world.meshes[m];
        const met at = intersect(eye, ray, part);
        const double inside = std::min({at.weights.x, at.weights.y, at.weights.z});
        if (std::abs(inside) < 0.03) result.certain = false;
        if (inside < 0) continue;
        depths.push_back(at.depth);
        if (part.opaque()) opaque = std::min(opaque, at.depth);
        const glm::vec3 opacity = part.opacity_at(0, glm::vec3(at.weights));
        // The opacity jumps at 0.25, where rounding decides.
        if (part.alpha && std::abs(at.weights.y + 0.5 * at.weights.z - 0.25) < 1e-3) result.certain = false;
        if (part.opaque() || opacity == glm::vec3(0)) continue;
        result.list.push_back({static_cast<float>(at.depth), opacity, static_cast<int>(m)});
    }
    std::ranges::sort(depths);
    for (std::size_t i = 1; i < depths.size(); ++i) result.certain &= depths[i] - depths[i - 1] > 1e-5;
    std::erase_if(result.list, [&](const fragment& f) { return double(f.depth) >= opaque; });
    std::ranges::sort(result.list, std::greater(), &fragment::depth);
    return result;
}

} // namespace

TEST_CASE("fragments are those that rays meet, in their order, with their depths and opacities")
{
    for (const projection kind : {projection::orthographic, projection::perspective}) {
        const camera eye = looking_at_origin(kind);
        int certain = 0, several = 0, opaque_behind = 0;
        for (unsigned seed = 0; seed < 12; ++seed) {
            const scene world = random_triangles(seed);
            const fragment_map map = rasterize_fragments(world, eye, pixels, pixels);
            const auto opaque = rasterize_depth<1>(opaque_part(world), eye, pixels, pixels);
            for (int y = 0; y < pixels; ++y)
                for (int x = 0; x < pixels; ++x) {
                    const expected_fragments expected = by_rays(world, eye, x, y);
                    if (!expected.certain) continue;
                    const auto list = map(x, y);
                    REQUIRE(list.size() == expected.list.size());
                    for (std::size_t i = 0; i < list.size(); ++i) {
                        CHECK(list[i].mesh == expected.list[i].mesh);
                        CHECK(std::abs(list[i].depth - expected.list[i].depth) < 1e-6f);
                        CHECK(glm::length(list[i].opacity - expected.list[i].opacity) < 1e-5f);
                    }
                    ++certain, several += list.size() > 1, opaque_behind += !list.empty() && opaque(x, y)[0] < 1;
                }
        }
        CHECK(certain > 4000);
        CHECK(several > 1000);
        CHECK(opaque_behind > 500);
    }
}

TEST_CASE("the front of layers and opaque surface is the surface that is seen of the whole scene")
{
    const stage smoke = translucent_stage(1.5);
    const surface_layers layers = rasterize_surface_layers(smoke.world, smoke.eye, 120, 80);
    scene visible = smoke.world;
    std::erase_if(visible.meshes, [](const mesh& part) { return part.alpha; }); // which is 0 in places
    const surface_layers without = rasterize_surface_layers(visible, smoke.eye, 120, 80);
    const auto seen = rasterize_surfaces(visible, smoke.eye, 120, 80);
    int before = 0;
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const auto list = without(i);
        const surface& front = list.empty() ? without.opaque.pixels[i] : list.back();
        CHECK(front.mesh == seen.pixels[i].mesh);
        CHECK(front.position == seen.pixels[i].position);
        CHECK(front.normal == seen.pixels[i].normal);
        before += !list.empty();
    }
    CHECK(before > 100);
    CHECK(layers.layers.size() > 2 * without.layers.size());
}

TEST_CASE("layers and fragments of one camera are the same")
{
    const stage smoke = translucent_stage(1.5);
    const fragment_map map = rasterize_fragments(smoke.world, smoke.eye, 120, 80);
    const surface_layers layers = rasterize_surface_layers(smoke.world, smoke.eye, 120, 80);
    CHECK(map.first == layers.first);
    REQUIRE(map.fragments.size() == layers.layers.size());
    for (std::size_t i = 0; i < map.fragments.size(); ++i) {
        CHECK(map.fragments[i].mesh == layers.layers[i].mesh);
        CHECK(map.fragments[i].opacity == layers.opacities[i]);
        const double depth = project(smoke.eye, layers.layers[i].position).z;
        CHECK(double(map.fragments[i].depth) == doctest::Approx(depth).epsilon(1e-5));
    }
}

TEST_CASE("a translucent plane of many triangles has one fragment in each pixel; equal depths have an order")
{
    CHECK(rc::check("corners anywhere on the lattice of subpixels", [](unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> jitter(-subpixels, subpixels);
        constexpr int cells = 6;
        mesh plane{.name = "plane", .positions = {}, .normals = {}, .triangles = {}, .opacity = glm::vec3(0.5f)};
        for (int y = 0; y <= cells; ++y)
            for (int x = 0; x <= cells; ++x) {
                const glm::vec2 corner = 3.f * glm::vec2(x, y) / float(cells) - 1.5f;
                plane.positions.emplace_back(
                    corner + glm::vec2(jitter(random), jitter(random)) * (2.f / pixels / subpixels), 0);
            }
        for (unsigned y = 0; y < cells; ++y)
            for (unsigned x = 0; x < cells; ++x) {
                const unsigned low = y * (cells + 1) + x, high = low + cells + 1;
                plane.triangles.emplace_back(low, low + 1, high), plane.triangles.emplace_back(low + 1, high + 1, high);
            }
        const camera eye = looking_at_origin(projection::orthographic);
        const scene twice{"", {plane, plane}};
        const fragment_map map = rasterize_fragments(twice, eye, pixels, pixels);
        for (std::size_t i = 0; i < pixels * pixels; ++i) {
            RC_ASSERT(map(i).size() == 2u);
            RC_ASSERT(map(i)[0].mesh == 1 && map(i)[1].mesh == 0);
        }
    }));
}

TEST_CASE("no translucent mesh, no fragments")
{
    const scene world = opaque_part(random_triangles(1));
    const fragment_map map = rasterize_fragments(world, looking_at_origin(projection::orthographic), 8, 4);
    CHECK(map.fragments.empty());
    CHECK(map.first == std::vector<std::uint32_t>(33, 0));
    CHECK_THROWS_WITH(rasterize_fragments(world, looking_at_origin(projection::orthographic), 0, 4),
                      "rasterizer: 0x4 pixels, 1 to 16384 per side are possible");
}

TEST_CASE("fragments do not depend on the number of threads")
{
    const stage smoke = translucent_stage(1.5);
    const auto render = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        return arena.execute([&] { return rasterize_fragments(smoke.world, smoke.light, 200, 200); });
    };
    const fragment_map serial = render(1);
    for (const int threads : {2, 7}) {
        const fragment_map parallel = render(threads);
        CHECK(parallel.first == serial.first);
        CHECK(std::ranges::equal(parallel.fragments, serial.fragments, [](const fragment& a, const fragment& b) {
            return a.depth == b.depth && a.opacity == b.opacity && a.mesh == b.mesh;
        }));
    }
}
