#include "translucent_stage.hpp"

#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gnomon::renderer {

namespace {

mesh painted(std::string name, const glm::vec3& albedo)
{
    return {.name = std::move(name), .albedo = albedo, .positions = {}, .normals = {}, .triangles = {}};
}

// The light comes from the front, over the smoke onto the pipes and the walls.
const glm::vec3 yard_light = glm::normalize(glm::vec3(-0.30f, -0.80f, -0.55f));

// A random value in [0, 1] for each point of the lattice of integers.
float lattice_value(const glm::ivec3& at)
{
    std::uint32_t bits = static_cast<std::uint32_t>(at.x) * 0x8da6b343u +
                         static_cast<std::uint32_t>(at.y) * 0xd8163841u +
                         static_cast<std::uint32_t>(at.z) * 0xcb1ab31fu;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6du;
    bits = (bits ^ bits >> 12) * 0x297a2d39u;
    return static_cast<float>((bits ^ bits >> 15) >> 8) * 0x1p-24f;
}

// Value noise in [0, 1], with continuous derivatives.
float noise(const glm::vec3& at)
{
    const glm::vec3 cell = glm::floor(at), f = at - cell, t = f * f * (3.f - 2.f * f);
    const glm::ivec3 low(cell);
    const auto row = [&](int y, int z) {
        return glm::mix(lattice_value(low + glm::ivec3(0, y, z)), lattice_value(low + glm::ivec3(1, y, z)), t.x);
    };
    return glm::mix(glm::mix(row(0, 0), row(1, 0), t.y), glm::mix(row(0, 1), row(1, 1), t.y), t.z);
}

// Plane k of the smoke has texture coordinates from (2 k, 0) to (2 k + 1, 1). Its density is a slice of a cloud in the
// unit cube.
float smoke_alpha(const glm::vec2& coordinates)
{
    const float plane = std::floor(0.5f * coordinates.x);
    const glm::vec3 at(coordinates.x - 2 * plane, coordinates.y, (plane + 0.5f) / float(smoke_planes));
    const glm::vec3 from_centre = 2.f * at - 1.f;
    const float inside = 1 - glm::dot(from_centre, from_centre);
    if (!(inside > 0)) return 0;
    float sum = 0, weight = 0.5f;
    glm::vec3 place = 3.5f * at;
    for (int octave = 0; octave < 4; ++octave, weight *= 0.5f, place = 2.03f * place + 11.7f)
        sum += weight * noise(place);
    return glm::smoothstep(0.25f, 0.75f, 1.1f * sum - 0.35f * (1 - inside) + 0.12f);
}

mesh smoke(const glm::vec3& centre, const glm::vec3& size)
{
    mesh result = painted("smoke", {0.75f, 0.75f, 0.78f});
    result.opacity = glm::vec3(smoke_opacity);
    result.alpha = smoke_alpha;
    const glm::vec3 right = glm::normalize(glm::cross(yard_light, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, yard_light);
    for (int k = 0; k < smoke_planes; ++k) {
        const float along = 0.5f - (static_cast<float>(k) + 0.5f) / float(smoke_planes);
        const glm::vec3 corner = centre + along * size.z * yard_light - 0.5f * size.x * right - 0.5f * size.y * up;
        const glm::vec2 first(2 * k, 0);
        add_textured_quad(result, corner, size.x * right, size.y * up, first, first + 1.f);
    }
    return result;
}

mesh pipe(const char* name, const glm::vec3& albedo, std::initializer_list<glm::vec3> path, float radius)
{
    mesh result = painted(name, albedo);
    add_tube(result, {path.begin(), path.size()}, radius, 20);
    return result;
}

} // namespace

scene translucent_scene()
{
    scene result{"translucent", {}};
    mesh walls = painted("walls", {0.62f, 0.55f, 0.45f});
    add_box(walls, upright({0, 1.6f, -2.15f}, {7, 3.2f, 0.3f}));
    add_box(walls, upright({-3.35f, 1.6f, 0}, {0.3f, 3.2f, 4.6f}));
    result.meshes.push_back(std::move(walls));
    result.meshes.push_back(
        pipe("red pipe", {0.75f, 0.08f, 0.06f}, {{-3.3f, 2.6f, -1.75f}, {3.5f, 2.6f, -1.75f}}, 0.10f));
    result.meshes.push_back(
        pipe("yellow pipe", {0.80f, 0.58f, 0.05f}, {{-3.3f, 1.9f, -1.60f}, {3.5f, 1.9f, -1.60f}}, 0.13f));
    result.meshes.push_back(
        pipe("green pipe", {0.08f, 0.45f, 0.12f}, {{-3.3f, 1.25f, -1.45f}, {3.5f, 1.25f, -1.45f}}, 0.09f));
    result.meshes.push_back(
        pipe("blue pipe", {0.06f, 0.14f, 0.70f}, {{-3.3f, 0.55f, -0.90f}, {3.5f, 0.55f, -0.90f}}, 0.12f));
    result.meshes.push_back(ground({0, 0, 0}, 9, 9, {0.45f, 0.43f, 0.40f}));

    const glm::vec3 glass_centre(2.0f, 0, 0.3f);
    mesh lead = painted("lead", {0.10f, 0.10f, 0.11f});
    const float width = 1.2f, height = 1.6f, base = 0.15f, bar = 0.04f;
    for (const float x : {-0.5f, 0.f, 0.5f})
        add_box(lead,
                upright(glass_centre + glm::vec3(x * width, 0.5f * (base + height), 0), {bar, base + height, bar}));
    for (const float y : {0.f, 0.5f, 1.f})
        add_box(lead, upright(glass_centre + glm::vec3(0, base + y * height, 0), {width + bar, bar, bar}));
    result.meshes.push_back(std::move(lead));
    const std::array<std::pair<const char*, glm::vec3>, 4> panes{{{"red glass", {0.10f, 0.92f, 0.94f}},
                                                                  {"green glass", {0.90f, 0.15f, 0.85f}},
                                                                  {"blue glass", {0.93f, 0.80f, 0.10f}},
                                                                  {"amber glass", {0.08f, 0.40f, 0.95f}}}};
    for (std::size_t i = 0; i < panes.size(); ++i) {
        mesh pane = painted(panes[i].first, 0.25f * (1.f - panes[i].second));
        pane.opacity = panes[i].second;
        const float x = i % 2 ? 0.f : -0.5f, y = i / 2 ? 0.f : 0.5f;
        add_quad(pane, glass_centre + glm::vec3(x * width, base + y * height, 0), {0.5f * width, 0, 0},
                 {0, 0.5f * height, 0});
        result.meshes.push_back(std::move(pane));
    }
    result.meshes.push_back(smoke({0.1f, 1.75f, -0.35f}, {2.4f, 2.0f, 1.7f}));
    return result;
}

stage translucent_stage(double aspect)
{
    stage result{translucent_scene(), {}, {}, {}};
    result.eye = perspective_view_from({-1.9, 2.5, 5.2}, {0.2, 1.15, -0.7}, bounds_of(result.world).corners(),
                                       glm::radians(40.0), aspect);
    result.light = orthographic_view(bounds_of(result.world).corners(), yard_light);
    result.interests = {{"pipe", "behind a pipe", {0.5f, 1.0f, -2.0f}, {0.05f, 0.6f, 0.1f}},
                        {"silhouette", "before the blue pipe", {0.1f, 1.4f, -0.1f}, {0.1f, 0.2f, 0.9f}},
                        {"smoke", "inside the smoke", {0.3f, 1.9f, -0.3f}, {0.95f, 0.35f, 0.02f}},
                        {"glass", "stained glass", {1.6f, 0, -0.3f}, {0.75f, 0.05f, 0.6f}}};
    return result;
}

stage smoke_close_up_stage(double aspect)
{
    stage result = translucent_stage(aspect);
    result.world.name = "smoke_close_up";
    result.eye = perspective_view_from({-0.9, 2.3, 1.6}, {0.1, 1.7, -0.35}, bounds_of(result.world).corners(),
                                       glm::radians(40.0), aspect);
    return result;
}

} // namespace gnomon::renderer
