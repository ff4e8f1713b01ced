#include "scattering_stages.hpp"

#include "paint.hpp"
#include "tree.hpp"
#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::renderer {

namespace {

// A box between two opposite corners.
void add_block(mesh& target, const glm::vec3& lower, const glm::vec3& upper)
{
    add_box(target, upright(0.5f * (lower + upper), upper - lower));
}

// Light of the colour of the sun that shades white surfaces with this radiance at normal incidence.
glm::vec3 sunlight(float strength) { return strength * glm::pi<float>() * glm::vec3(1.0f, 0.94f, 0.84f); }

struct view {
    glm::dvec3 position, target;
    double degrees;
};

// The camera and the light's map see all of the scene.
scattering_stage staged(scene world, const glm::dvec3& light, const view& from, const medium& air, double aspect)
{
    scattering_stage result{{std::move(world), {}, {}, {}, {}}, air};
    const auto corners = bounds_of(result.world).corners();
    result.light = orthographic_view(corners, light);
    result.eye = perspective_view_from(from.position, from.target, corners, glm::radians(from.degrees), aspect);
    return result;
}

// A wall across z with windows in it: its own extent, and that of the windows along z.
void add_windowed_wall(mesh& wall, mesh& bars, const glm::vec3& lower, const glm::vec3& upper, const glm::vec2& heights,
                       std::span<const glm::vec2> windows)
{
    add_block(wall, lower, {upper.x, heights.x, upper.z});
    add_block(wall, {lower.x, heights.y, lower.z}, upper);
    float from = lower.z;
    for (const glm::vec2& window : windows) {
        add_block(wall, {lower.x, heights.x, from}, {upper.x, heights.y, window.x});
        from = window.y;
        const float middle = 0.5f * (window.x + window.y);
        add_block(bars, {lower.x, heights.x, middle - 0.03f}, {upper.x, heights.y, middle + 0.03f});
        for (const float share : {1.f / 3, 2.f / 3}) {
            const float y = glm::mix(heights.x, heights.y, share);
            add_block(bars, {lower.x, y - 0.025f, window.x}, {upper.x, y + 0.025f, window.y});
        }
    }
    add_block(wall, {lower.x, heights.x, from}, {upper.x, heights.y, upper.z});
}

// Bars across z between two corners of a rectangle, `pitch` apart.
void add_grille(mesh& bars, const glm::vec3& lower, const glm::vec2& size, float pitch, float thickness)
{
    const float half = 0.5f * thickness;
    for (int i = 0; static_cast<float>(i) * pitch <= size.x; ++i) {
        const float x = lower.x + static_cast<float>(i) * pitch;
        add_block(bars, {x - half, lower.y, lower.z - half}, {x + half, lower.y + size.y, lower.z + half});
    }
    for (int i = 0; static_cast<float>(i) * pitch <= size.y; ++i) {
        const float y = lower.y + static_cast<float>(i) * pitch;
        add_block(bars, {lower.x, y - half, lower.z - half}, {lower.x + size.x, y + half, lower.z + half});
    }
}

// A dragon around a place, turned about y.
void add_dragon(scene& world, const placement& where)
{
    mesh body = painted("dragon", {0.16f, 0.24f, 0.10f}), wings = painted("wings", {0.30f, 0.12f, 0.06f});
    constexpr int parts = 40, joint = 5;
    const auto spine = [&](int i) {
        const float t = static_cast<float>(i) / parts; // from the tail to the head
        const glm::vec3 along(4.4f * t - 2.4f, 0.32f * std::sin(7 * t) + 0.5f * t * t, 0.25f * std::cos(6 * t));
        return where.centre + where.half_axes * along;
    };
    for (int first = 0; first < parts; first += joint) {
        std::vector<glm::vec3> path;
        for (int i = first; i <= first + joint; ++i) path.push_back(spine(i));
        const float t = (static_cast<float>(first) + 0.5f * joint) / parts;
        add_tube(body, path, 0.04f + 0.30f * std::sin(glm::pi<float>() * std::pow(t, 1.4f)), 10);
    }
    mesh head = painted("head", body.albedo);
    add_box(head, {spine(parts),
                   where.half_axes * glm::mat3(glm::vec3(0.3f, 0, 0), glm::vec3(0, 0.12f, 0), glm::vec3(0, 0, 0.14f))});
    for (const float side : {-1.f, 1.f}) {
        glm::vec3 root = spine(26);
        for (const glm::vec3& arm : {glm::vec3(0.1f, 0.75f, side * 0.8f), glm::vec3(-0.35f, 0.15f, side * 1.1f)}) {
            add_quad(wings, root, where.half_axes * arm, where.half_axes * glm::vec3(-0.9f, -0.15f, side * 0.1f));
            root += where.half_axes * arm;
        }
    }
    for (mesh& part : std::array{body, head, wings}) world.meshes.push_back(std::move(part));
}

// A tower with a gallery and a pinnacle at each corner, and a spire, on the ground around the origin.
scene tower_scene()
{
    mesh stone = painted("tower", {0.45f, 0.42f, 0.37f}), roof = painted("spire", {0.20f, 0.17f, 0.16f});
    const std::array<glm::vec2, 4> square{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    const auto pyramid = [&](mesh& target, const glm::vec3& base, float half, float height) {
        const auto first = static_cast<std::uint32_t>(target.positions.size());
        for (const glm::vec2& corner : square)
            target.positions.push_back(base + half * glm::vec3(corner.x, 0, -corner.y));
        target.positions.push_back(base + glm::vec3(0, height, 0));
        for (std::uint32_t i = 0; i < 4; ++i) target.triangles.push_back({first + i, first + (i + 1) % 4, first + 4});
    };
    add_block(stone, {-2, 0, -2}, {2, 12, 2});
    add_block(stone, {-2.3f, 12, -2.3f}, {2.3f, 12.4f, 2.3f});
    for (const glm::vec2& corner : square) {
        const glm::vec3 at(2.0f * corner.x, 12.4f, 2.0f * corner.y);
        add_block(stone, at - glm::vec3(0.25f, 0, 0.25f), at + glm::vec3(0.25f, 1.8f, 0.25f));
        pyramid(roof, at + glm::vec3(0, 1.8f, 0), 0.35f, 1.5f);
    }
    for (int i = -3; i <= 3; ++i)
        for (const float side : {-2.15f, 2.15f}) {
            const float along = 0.5f * static_cast<float>(i);
            add_block(stone, {along - 0.12f, 12.4f, side - 0.12f}, {along + 0.12f, 13.0f, side + 0.12f});
            add_block(stone, {side - 0.12f, 12.4f, along - 0.12f}, {side + 0.12f, 13.0f, along + 0.12f});
        }
    pyramid(roof, {0, 12.4f, 0}, 1.5f, 4.6f);
    return {"tower", {stone, roof, ground({0, 0, 0}, 44, 44, {0.30f, 0.32f, 0.22f})}};
}

} // namespace

scattering_stage room_stage(double aspect)
{
    const float half = 4, far = -9, near = 5, top = 6, thickness = 0.1f, chamber = -13;
    mesh walls = painted("walls", {0.62f, 0.57f, 0.48f}), roof = painted("roof", {0.42f, 0.33f, 0.24f});
    mesh floor = painted("floor", {0.40f, 0.36f, 0.30f}), bars = painted("bars", {0.10f, 0.09f, 0.08f});
    mesh benches = painted("benches", {0.33f, 0.18f, 0.09f}), dark = painted("chamber", {0.05f, 0.05f, 0.06f});
    const float edge = half + thickness;
    std::vector<glm::vec2> windows;
    for (int i = 0; i < 5; ++i)
        windows.emplace_back(-8.0f + 2.4f * static_cast<float>(i), -6.8f + 2.4f * static_cast<float>(i));
    add_windowed_wall(walls, bars, {half, 0, chamber}, {edge, top, near}, {1.8f, 5.2f}, windows);
    add_block(walls, {-edge, 0, chamber}, {-half, top, near});
    add_block(walls, {-edge, 0, near}, {edge, top, near + thickness});
    add_block(dark, {-edge, 0, chamber - thickness}, {edge, top, chamber});
    // The wall before the chamber has an opening.
    const glm::vec2 opening(0.6f, 2.4f), sill(1.2f, 3.2f);
    add_block(walls, {-half, 0, far - thickness}, {opening.x, top, far});
    add_block(walls, {opening.y, 0, far - thickness}, {half, top, far});
    add_block(walls, {opening.x, 0, far - thickness}, {opening.y, sill.x, far});
    add_block(walls, {opening.x, sill.y, far - thickness}, {opening.y, top, far});
    add_block(roof, {-edge, top, chamber - thickness}, {edge, top + thickness, near + thickness});
    for (int i = 0; i < 6; ++i) {
        const float z = -7.4f + 2.4f * static_cast<float>(i);
        add_block(roof, {-half, top - 0.6f, z - 0.1f}, {half, top - 0.35f, z + 0.1f});
    }
    add_block(floor, {-edge, -thickness, chamber - thickness}, {edge, 0, near + thickness});
    for (int i = 0; i < 5; ++i) {
        const float z = -7.6f + 1.9f * static_cast<float>(i);
        add_block(benches, {-2.9f, 0.42f, z}, {-0.6f, 0.48f, z + 0.4f});
        add_block(benches, {-2.9f, 0.48f, z + 0.36f}, {-0.6f, 0.95f, z + 0.4f});
        for (const float x : {-2.8f, -0.8f}) add_block(benches, {x, 0, z + 0.05f}, {x + 0.1f, 0.42f, z + 0.35f});
    }
    const medium air{
        .scattering = glm::vec3(0.05f), .absorption = glm::vec3(0.005f), .asymmetry = 0.2f, .irradiance = sunlight(9)};
    scattering_stage result = staged({"room", {walls, dark, roof, floor, bars, benches}}, {-0.8, -0.62, -0.18},
                                     {{-2.6, 1.9, 4.4}, {0.5, 2.5, -9}, 58}, air, aspect);
    result.interests = {{"opening", "opening to the dark chamber", {1.5f, 2.2f, far}, paint::orange},
                        {"leak", "corner under the roof", {-half, 5.2f, -6.5f}, paint::green},
                        {"shaft", "shafts of light", {1.0f, 2.6f, -5}, paint::cyan}};
    return result;
}

scattering_stage veils_stage(double aspect)
{
    scattering_stage result = room_stage(aspect);
    result.world.name = "veils";
    mesh veils = painted("veils", {0.50f, 0.20f, 0.16f});
    veils.opacity = {0.35f, 0.50f, 0.55f};
    for (const float z : {-7.5f, -5.0f, -2.5f, 0.f})
        add_quad(veils, {-1.3f - 0.2f * z, 0.9f, z}, {3.4f, 0, 0.3f}, {0, 3.3f, 0});
    result.world.meshes.push_back(std::move(veils));
    return result;
}

scattering_stage trees_stage(double aspect)
{
    mesh wood = painted("wood", {0.16f, 0.11f, 0.07f}), leaves = painted("leaves", {0.16f, 0.30f, 0.06f});
    struct planted {
        float x, z, height;
    };
    constexpr std::array trees{planted{-2.6f, 3.5f, 9.5f},  planted{3.8f, 2.0f, 8.5f},   planted{-6.5f, -0.5f, 8.0f},
                               planted{0.9f, -2.5f, 10.5f}, planted{7.0f, -3.5f, 9.0f},  planted{-3.6f, -5.5f, 9.0f},
                               planted{3.4f, -8.0f, 10.0f}, planted{-8.0f, -8.5f, 9.0f}, planted{-0.8f, -11.0f, 9.5f},
                               planted{8.5f, -11.0f, 10.0f}};
    std::uint32_t seed = 1;
    for (const planted& tree : trees) add_tree(wood, leaves, {tree.x, 0, tree.z}, tree.height, seed++);
    const medium air{.scattering = glm::vec3(0.035f, 0.037f, 0.040f),
                     .absorption = glm::vec3(0.002f),
                     .asymmetry = 0.5f,
                     .irradiance = sunlight(1.3f)};
    const scene world{"trees", {wood, leaves, ground({0, 0, -3}, 28, 30, {0.20f, 0.18f, 0.09f})}};
    scattering_stage result = staged(world, {0.30, -0.62, 0.72}, {{0.3, 1.7, 10.5}, {0.0, 4.4, -4}, 52}, air, aspect);
    result.interests = {{"crown", "behind a crown", {-2.0f, 5.4f, 3.0f}, paint::orange},
                        {"ground", "between the trunks", {0.0f, 1.5f, -6}, paint::green}};
    return result;
}

scattering_stage gate_stage(double aspect, float time)
{
    mesh wall = painted("wall", {0.40f, 0.37f, 0.33f}), bars = painted("bars", {0.07f, 0.07f, 0.08f});
    const float half = 2.2f, height = 4.2f, thickness = 0.5f;
    add_block(wall, {-7, 0, -thickness}, {-half, 6.5f, 0});
    add_block(wall, {half, 0, -thickness}, {7, 6.5f, 0});
    add_block(wall, {-half, height, -thickness}, {half, 6.5f, 0});
    for (const float x : {-7.f, -half - 0.8f, half, 6.2f}) add_block(wall, {x, 6.5f, -thickness}, {x + 0.8f, 7.2f, 0});
    add_grille(bars, {-half, 0, -0.25f}, {2 * half, height}, 0.15f, 0.045f);
    const medium air{
        .scattering = glm::vec3(0.06f), .absorption = glm::vec3(0.004f), .asymmetry = 0.4f, .irradiance = sunlight(5)};
    const scene world{"gate", {wall, bars, ground({0, 0, 1}, 14, 20, {0.28f, 0.26f, 0.22f})}};
    const double aside = 0.3 * static_cast<double>(time);
    scattering_stage result =
        staged(world, {0.22, -0.42, 0.88}, {{0.9 + aside, 1.6, 7.0}, {0.1 + aside, 2.4, 0}, 46}, air, aspect);
    result.interests = {{"bars", "shadows of the bars", {0.6f, 1.2f, 2}, paint::orange},
                        {"rays", "rays beside the gate", {-3.5f, 2.2f, 0}, paint::green}};
    return result;
}

scattering_stage entering_stage(double aspect, bool present)
{
    mesh walls = painted("walls", {0.46f, 0.42f, 0.36f}), roof = painted("roof", {0.36f, 0.24f, 0.14f});
    const float half = 7, top = 7.5f, edge = half + 0.2f;
    const glm::vec2 depth(-6.5f, 9.5f);
    for (const float side : {-1.f, 1.f}) {
        add_block(walls, {side * half - 0.1f, 0, depth.x}, {side * half + 0.1f, top, depth.y});
        add_block(walls, {-edge, 0, (side < 0 ? depth.x : depth.y) - 0.1f},
                  {edge, top, (side < 0 ? depth.x : depth.y) + 0.1f});
    }
    // The gaps between the planks of the roof.
    for (int i = 0; i < 7; ++i) {
        const float x = -7.2f + 2.4f * static_cast<float>(i);
        add_block(roof, {glm::max(x - 0.7f, -edge), top, depth.x}, {glm::min(x + 0.7f, edge), top + 0.1f, depth.y});
    }
    for (const float z : {-5.5f, -1.6f, 2.6f, 7.2f})
        add_block(roof, {-edge, top + 0.1f, z - 1}, {edge, top + 0.2f, z + 1});
    scene world{present ? "entering" : "before_entering",
                {walls, roof, ground({0, 0, 1.5f}, 14.4f, 16.4f, {0.34f, 0.32f, 0.28f})}};
    if (present) add_dragon(world, upright({0.5f, 3.4f, 1.4f}, glm::vec3(2.6f), 0.6f));
    const medium air{
        .scattering = glm::vec3(0.05f), .absorption = glm::vec3(0.003f), .asymmetry = 0.3f, .irradiance = sunlight(8)};
    scattering_stage result =
        staged(std::move(world), {0.30, -0.88, 0.22}, {{-1.2, 2.0, 9.0}, {0.3, 3.5, 0}, 54}, air, aspect);
    result.interests = {{"above", "beams above the dragon", {-0.3f, 5.6f, 0.9f}, paint::orange},
                        {"below", "shadow below the dragon", {0.9f, 2.0f, 1.8f}, paint::green}};
    return result;
}

scattering_stage tower_stage(double aspect)
{
    const glm::dvec3 eye(-1.0, 1.7, 15), sun_behind(0, 13.2, 0);
    const medium air{.scattering = glm::vec3(0.020f, 0.021f, 0.023f),
                     .absorption = glm::vec3(0.001f),
                     .asymmetry = 0.6f,
                     .irradiance = sunlight(0.6f)};
    scattering_stage result = staged(tower_scene(), eye - sun_behind, {eye, {0.1, 11.2, 0}, 48}, air, aspect);
    result.interests = {{"epipole", "the light behind the tower", glm::vec3(sun_behind), paint::orange}};
    return result;
}

scattering_stage antipode_stage(double aspect)
{
    const glm::dvec3 eye(-5, 9, 19), along(-4.2, 3, 0);
    const medium air{.scattering = glm::vec3(0.030f, 0.032f, 0.035f),
                     .absorption = glm::vec3(0.002f),
                     .asymmetry = 0.1f,
                     .irradiance = sunlight(4)};
    scattering_stage result = staged(tower_scene(), along - eye, {eye, {-1.5, 7.5, 0}, 48}, air, aspect);
    result.world.name = "antipode";
    result.interests = {{"antipode", "rays along the light", glm::vec3(along), paint::orange}};
    return result;
}

scattering_stage hazy_model_stage(scene model, double aspect)
{
    const stage plain = model_stage(std::move(model), aspect);
    const bounds box = bounds_of(scene{"", {plain.world.meshes.begin(), plain.world.meshes.end() - 1}});
    // The light comes from the far side, over the model.
    const glm::dvec3 across = plain.eye.forward;
    scattering_stage result{plain,
                            {.scattering = glm::vec3(0.25f),
                             .absorption = glm::vec3(0.02f),
                             .asymmetry = 0.2f,
                             .irradiance = sunlight(1.5f)}};
    const glm::vec3 direction =
        glm::normalize(glm::vec3(static_cast<float>(-across.x), -0.7f, static_cast<float>(-across.z)));
    result.light = orthographic_view(casters_and_shadows(box, direction), direction);
    result.light_size = glm::dvec2(0);
    return result;
}

} // namespace gnomon::renderer
