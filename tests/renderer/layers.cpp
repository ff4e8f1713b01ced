// Pictures with translucent surfaces: composition, and smoke that casts and receives shadows.
#include "renderer/shade/layers.hpp"

#include "renderer/scene/translucent_stage.hpp"
#include "renderer/shade/shading.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

using namespace gnomon::renderer;

namespace {

layer_visibility all_lit(const surface_layers& seen)
{
    return {{seen.opaque.width, seen.opaque.height, glm::vec3(1)},
            std::vector<glm::vec3>(seen.layers.size(), glm::vec3(1))};
}

} // namespace

TEST_CASE("without translucent meshes a picture is that of the surfaces")
{
    const stage yard = translucent_stage(1.5);
    const scene opaque = opaque_part(yard.world);
    const auto layers = rasterize_surface_layers(opaque, yard.eye, 60, 40);
    const auto seen = rasterize_surfaces(opaque, yard.eye, 60, 40);
    const picture expected = shade(opaque, yard.light, seen, image<float>(60, 40, 1));
    CHECK(shade_layers(opaque, yard.light, layers, all_lit(layers)).pixels == expected.pixels);
}

TEST_CASE("layers cover what lies behind them by their opacities, the nearest last")
{
    const stage yard = translucent_stage(1.5);
    const auto seen = rasterize_surface_layers(yard.world, yard.eye, 60, 40);
    layer_visibility light = all_lit(seen);
    const auto opaque = rasterize_surface_layers(opaque_part(yard.world), yard.eye, 60, 40);
    const picture behind = shade_layers(yard.world, yard.light, opaque, all_lit(opaque));
    const picture bright = shade_layers(yard.world, yard.light, seen, light);
    std::ranges::fill(light.layers, glm::vec3(0, 0, 1)); // blue light alone
    const picture blue = shade_layers(yard.world, yard.light, seen, light);
    int covered = 0;
    for (std::size_t i = 0; i < behind.pixels.size(); ++i) {
        glm::dvec3 passing(1), stopped(0);
        for (std::size_t k = seen.first[i + 1]; k-- > seen.first[i];) {
            const glm::dvec3 albedo(yard.world.meshes[static_cast<std::size_t>(seen.layers[k].mesh)].albedo);
            stopped += passing * glm::dvec3(seen.opacities[k]) * albedo;
            passing *= 1.0 - glm::dvec3(seen.opacities[k]);
        }
        const glm::dvec3 ambient(0.5f * (illumination{}.sky + illumination{}.earth)), sun(illumination{}.sun);
        const glm::dvec3 expected = passing * glm::dvec3(behind.pixels[i]) + stopped * (ambient + sun);
        CHECK(glm::length(glm::dvec3(bright.pixels[i]) - expected) < 1e-5);
        const glm::dvec3 darker = expected - stopped * sun * glm::dvec3(1, 1, 0);
        CHECK(glm::length(glm::dvec3(blue.pixels[i]) - darker) < 1e-5);
        covered += seen.first[i] < seen.first[i + 1];
    }
    CHECK(covered > 200);
}

TEST_CASE("smoke casts shadows on smoke and on walls, the nearest plane to the light is lit")
{
    const stage yard = translucent_stage(1.5);
    const auto seen = rasterize_surface_layers(yard.world, yard.eye, 120, 80);
    const layer_visibility light = traced_transmittance(tracer(yard.world), yard.light, seen);
    const auto smoke = static_cast<int>(yard.world.meshes.size()) - 1;
    REQUIRE(yard.world.meshes.back().name == "smoke");
    REQUIRE(light.layers.size() == seen.layers.size());
    // Positions of the nearest plane lie ahead of all others.
    double nearest = 1;
    for (const surface& s : seen.layers)
        if (s.mesh == smoke) nearest = std::min(nearest, project(yard.light, s.position).z);
    int dim = 0, bright = 0;
    float darkest = 1;
    for (std::size_t i = 0; i < seen.layers.size(); ++i) {
        if (seen.layers[i].mesh != smoke) continue;
        const glm::vec3& visible = light.layers[i];
        if (project(yard.light, seen.layers[i].position).z < nearest + 1e-3) {
            CHECK(visible == glm::vec3(1));
            ++bright;
        }
        dim += visible.g > 0.05f && visible.g < 0.95f;
        darkest = std::min(darkest, visible.g > 0 ? visible.g : 1.f);
    }
    CHECK(bright > 10);
    CHECK(dim > 200);
    CHECK(darkest < 0.4f);
    int grey = 0, coloured = 0;
    for (std::size_t i = 0; i < light.opaque.pixels.size(); ++i) {
        const glm::vec3& visible = light.opaque.pixels[i];
        if (visible.r != visible.b) ++coloured;
        else grey += visible.r > 0 && visible.r < 1;
    }
    CHECK(grey > 100);
    CHECK(coloured > 30);
}
