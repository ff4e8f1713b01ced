// The stages of single scattering show what their figures are about, and media follow their closed forms.
#include "renderer/scene/scattering_stages.hpp"

#include "renderer/scene/tree.hpp"
#include "renderer/shade/scattering.hpp"
#include "renderer/trace/lit_segments.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon::renderer;

namespace {

constexpr int width = 160, height = 90;
constexpr double aspect = 16.0 / 9;

std::vector<scattering_stage> all_stages()
{
    mesh box{.name = "box", .positions = {}, .normals = {}, .triangles = {}};
    add_box(box, upright({0, 0.5f, 0}, {0.6f, 1, 0.4f}, 0.5f));
    return {room_stage(aspect),    veils_stage(aspect),           trees_stage(aspect),
            gate_stage(aspect, 0), entering_stage(aspect, false), entering_stage(aspect, true),
            tower_stage(aspect),   antipode_stage(aspect),        hazy_model_stage({"", {box}}, aspect)};
}

image<float> visible_shares(const scattering_stage& of, const image<float>& lengths)
{
    return traced_scattering(shadow_volumes(of.world, of.light), of.air, of.eye, lengths);
}

image<float> lengths_of(const scattering_stage& of)
{
    return ray_lengths(of.eye, rasterize_surfaces(of.world, of.eye, width, height));
}

view_ray ray_to(const scattering_stage& of, const glm::vec3& place)
{
    return {of.eye.position, glm::normalize(glm::dvec3(place) - of.eye.position)};
}

} // namespace

TEST_CASE("each stage has a directional light whose map holds its casters, shafts of light, and places in view")
{
    for (const scattering_stage& of : all_stages()) {
        CAPTURE(of.world.name);
        CHECK(!of.light.perspective());
        for (const mesh& part : of.world.meshes)
            if (part.name != "ground")
                for (const glm::vec3& corner : part.positions) CHECK(within_view(project(of.light, corner)));
        for (const point_of_interest& place : of.interests) {
            CHECK(within_view(project(of.eye, place.position)));
            CHECK(within_view(project(of.light, place.position)));
        }
        const image<float> lengths = lengths_of(of), visible = visible_shares(of, lengths);
        const auto [darkest, brightest] = std::ranges::minmax(visible.pixels);
        CHECK(brightest - darkest > 0.25f);
        // Air dims what lies behind it, and hides it nowhere.
        for (int y = 0; y < height; y += 10)
            for (int x = 0; x < width; x += 10) {
                const view_ray ray = unit_ray(of.eye, x, y, width, height);
                const glm::vec3 passing = transmittance(of.air, ray, static_cast<double>(lengths(x, y)));
                CHECK(passing.x < 1);
                CHECK(passing.x > 0.1f);
            }
    }
}

TEST_CASE("no light reaches the chamber behind the opening of the room")
{
    const scattering_stage of = room_stage(aspect);
    const shadow_volumes shadows(of.world, of.light);
    const view_ray ray = ray_to(of, of.interests.front().position);
    const double wall = glm::length(glm::dvec3(of.interests.front().position) - of.eye.position);
    const image<float> lengths = lengths_of(of);
    const glm::ivec2 pixel(glm::dvec2(project(of.eye, of.interests.front().position)) * glm::dvec2(width, height));
    CHECK(static_cast<double>(lengths(pixel.x, pixel.y)) > wall + 2); // the opening is open
    const std::vector<lit_segment> lit = shadows.lit(ray, wall + 3);
    REQUIRE(!lit.empty()); // shafts of light are before it
    CHECK(lit.back().to < wall);
}

TEST_CASE("view rays into the light end at the tower, and those along the light are lit")
{
    const scattering_stage into = tower_stage(aspect), along = antipode_stage(aspect);
    const view_ray epipole = ray_to(into, into.interests.front().position);
    CHECK(glm::dot(epipole.direction, into.light.forward) == doctest::Approx(-1).epsilon(1e-6));
    const glm::dvec3 place(into.interests.front().position);
    CHECK(shadow_volumes(into.world, into.light).lit(epipole, glm::length(place - into.eye.position)).empty());
    const view_ray antipode = ray_to(along, along.interests.front().position);
    CHECK(glm::dot(antipode.direction, along.light.forward) == doctest::Approx(1).epsilon(1e-6));
    const auto lit = shadow_volumes(along.world, along.light).lit(antipode, 15);
    CHECK(lit == std::vector<lit_segment>{{0, 15}});
}

TEST_CASE("the camera at the gate moves sideways, and nothing else does")
{
    const scattering_stage first = gate_stage(aspect, 0), second = gate_stage(aspect, 0.5f);
    CHECK(glm::length(second.eye.position - first.eye.position - glm::dvec3(0.15, 0, 0)) < 1e-6);
    CHECK(glm::length(second.eye.forward - first.eye.forward) < 1e-9);
    CHECK(second.light.position == first.light.position);
    CHECK(second.light.half_extent == first.light.half_extent);
    for (std::size_t i = 0; i < first.world.meshes.size(); ++i)
        CHECK(first.world.meshes[i].positions == second.world.meshes[i].positions);
}

TEST_CASE("a dragon that enters darkens what lies below, and nothing above")
{
    const scattering_stage before = entering_stage(aspect, false), after = entering_stage(aspect, true);
    CHECK(before.light.half_extent == after.light.half_extent);
    const image<float> empty_lengths = lengths_of(before), lengths = lengths_of(after);
    const image<float> empty = visible_shares(before, empty_lengths), visible = visible_shares(after, lengths);
    float most = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (lengths(x, y) != empty_lengths(x, y)) continue;
            CHECK(visible(x, y) <= empty(x, y) + 1e-6f);
            most = std::max(most, empty(x, y) - visible(x, y));
        }
    CHECK(most > 0.1f);
    const glm::ivec2 above(glm::dvec2(project(after.eye, after.interests[0].position)) * glm::dvec2(width, height));
    const glm::ivec2 below(glm::dvec2(project(after.eye, after.interests[1].position)) * glm::dvec2(width, height));
    CHECK(double(visible(above.x, above.y)) == doctest::Approx(double(empty(above.x, above.y))).epsilon(1e-6));
    CHECK(visible(below.x, below.y) < empty(below.x, below.y) - 0.02f);
}

TEST_CASE("a seed makes one tree, of its height")
{
    const auto grown = [](std::uint32_t seed) {
        mesh wood{.name = "", .positions = {}, .normals = {}, .triangles = {}}, leaves = wood;
        add_tree(wood, leaves, {1, 2, 3}, 8, seed);
        CHECK(wood.positions.size() == wood.normals.size());
        const bounds box = bounds_of({"", {wood, leaves}});
        CHECK(box.upper.y - 2 == doctest::Approx(8).epsilon(0.15));
        return leaves.positions;
    };
    CHECK(grown(1) == grown(1));
    CHECK(grown(1) != grown(2));
}

TEST_CASE("a phase function has the integral 1 and the mean cosine that it says")
{
    for (const float g : {-0.7f, 0.f, 0.4f, 0.9f}) {
        const medium air{.asymmetry = g};
        double sum = 0, mean = 0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double cosine = 2 * (i + 0.5) / steps - 1;
            const double share = air.phase(cosine) * 4 * glm::pi<double>() / steps;
            sum += share, mean += share * cosine;
        }
        CHECK(sum == doctest::Approx(1).epsilon(1e-4));
        CHECK(mean == doctest::Approx(static_cast<double>(g)).epsilon(1e-4));
    }
}

TEST_CASE("a picture in haze is that of each channel in its own haze, and without haze the surfaces")
{
    scattering_stage of = gate_stage(aspect, 0);
    const picture surfaces(width, height, {0.25f, 0.5f, 0.75f});
    const image<float> length(width, height, 5.f), visible(width, height, 0.5f);
    of.air = {};
    CHECK(with_scattering(surfaces, length, visible, of).pixels == surfaces.pixels);
    of.air = {.scattering = {0.1f, 0.2f, 0}, .absorption = {0.3f, 0, 0.1f}, .irradiance = glm::vec3(2)};
    const picture seen = with_scattering(surfaces, length, visible, of);
    const double isotropic = 1 / (4 * glm::pi<double>());
    const auto expected = [&](double surface, double scattering, double sigma) {
        return surface * std::exp(-5 * sigma) + isotropic * 2 * scattering / sigma * (1 - std::exp(-5 * sigma)) * 0.5;
    };
    for (const glm::vec3& pixel : seen.pixels) {
        CHECK(double(pixel.x) == doctest::Approx(expected(0.25, 0.1, 0.4)).epsilon(1e-5));
        CHECK(double(pixel.y) == doctest::Approx(expected(0.5, 0.2, 0.2)).epsilon(1e-5));
        CHECK(double(pixel.z) == doctest::Approx(expected(0.75, 0, 0.1)).epsilon(1e-5));
    }
    // More light is scattered forwards: into a view against the light.
    const view_ray against{of.eye.position, -of.light.forward}, along{of.eye.position, of.light.forward};
    of.air.asymmetry = 0.5f;
    CHECK(scattered_radiance(of.air, of.light, against, 5).x > 5 * scattered_radiance(of.air, of.light, along, 5).x);
}

TEST_CASE("forward shading of translucent layers adds the haze between them, dimmed by the nearer ones")
{
    const scattering_stage of = veils_stage(1.5);
    const auto seen = rasterize_surface_layers(of.world, of.eye, 60, 40);
    const per_surface<float> lengths = ray_lengths(of.eye, seen);
    const shadow_volumes shadows(opaque_part(of.world), of.light);
    const per_surface<float> visible = traced_scattering(shadows, of.air, of.eye, seen, lengths);
    const per_surface<glm::vec3> radiances{{60, 40, {0.2f, 0.4f, 0.6f}},
                                           std::vector<glm::vec3>(seen.layers.size(), {0.3f, 0.2f, 0.1f})};
    const picture result = blended(seen, with_scattering(seen, radiances, lengths, visible, of));
    std::size_t most = 0;
    for (std::size_t pixel = 0; pixel < result.pixels.size(); ++pixel) {
        const int index = static_cast<int>(pixel);
        const view_ray ray = unit_ray(of.eye, index % 60, index / 60, 60, 40);
        // From front to back: what is left of the light, and the scattering up to the surface before.
        glm::vec3 left(1), before(0), expected(0);
        const auto meet = [&](const glm::vec3& radiance, float length, const glm::vec3& opacity) {
            const auto distance = static_cast<double>(length);
            const double share = visible_share(shadows.lit(ray, distance), of.air, ray, distance);
            const glm::vec3 haze = static_cast<float>(share) * scattered_radiance(of.air, of.light, ray, distance);
            expected += left * (haze - before + opacity * transmittance(of.air, ray, distance) * radiance);
            before = haze, left *= 1.f - opacity;
        };
        for (std::size_t i = seen.first[pixel + 1]; i-- > seen.first[pixel];)
            meet(radiances.layers[i], lengths.layers[i], seen.opacities[i]);
        meet(radiances.opaque.pixels[pixel], lengths.opaque.pixels[pixel], glm::vec3(1));
        CHECK(glm::length(result.pixels[pixel] - expected) < 1e-5f);
        most = std::max<std::size_t>(most, seen.first[pixel + 1] - seen.first[pixel]);
    }
    CHECK(most == 4);
}
