#include "soft_stages.hpp"

#include "paint.hpp"
#include "tube.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace gnomon::renderer {

namespace {

// A knot that winds twice around the axis of a torus and three times through its hole.
mesh knot(const glm::vec3& centre, float size)
{
    mesh result = painted("knot", {0.55f, 0.20f, 0.05f});
    std::vector<glm::vec3> path;
    for (int i = 0; i < 240; ++i) {
        const float t = glm::two_pi<float>() * static_cast<float>(i) / 240;
        const float r = 0.62f + 0.27f * std::cos(3 * t);
        path.push_back(centre + size * glm::vec3(r * std::cos(2 * t), r * std::sin(2 * t), 0.3f * std::sin(3 * t)));
    }
    add_tube(result, path, 0.11f * size, 16, true);
    return result;
}

// A chair with a back of rods, which stands on the ground.
mesh chair(const glm::vec3& place, float angle)
{
    mesh result = painted("chair", {0.12f, 0.30f, 0.42f});
    const placement turned = upright(place, glm::vec3(2), angle);
    const auto add = [&](const glm::vec3& at, const glm::vec3& size) {
        add_box(result, upright(turned.centre + turned.half_axes * at, size, angle));
    };
    for (const float x : {-0.20f, 0.20f}) {
        add({x, 0.475f, -0.20f}, {0.035f, 0.95f, 0.035f});
        add({x, 0.22f, 0.20f}, {0.035f, 0.44f, 0.035f});
        add({x, 0.15f, 0}, {0.02f, 0.02f, 0.40f});
    }
    add({0, 0.45f, 0}, {0.46f, 0.03f, 0.46f});
    add({0, 0.93f, -0.20f}, {0.44f, 0.06f, 0.025f});
    add({0, 0.56f, -0.20f}, {0.40f, 0.03f, 0.02f});
    for (int i = 0; i < 6; ++i) add({-0.15f + 0.06f * static_cast<float>(i), 0.74f, -0.20f}, {0.012f, 0.36f, 0.012f});
    return result;
}

// A wall of bricks across x, whose bricks stand out of the mortar.
void add_brick_wall(mesh& bricks, mesh& mortar, const glm::vec3& base, const glm::vec3& size)
{
    add_box(mortar, upright(base + glm::vec3(0, 0.5f * size.y, 0), size - glm::vec3(0.02f, 0, 0.02f)));
    const int rows = 16, columns = 8;
    const glm::vec2 pitch(size.x / columns, size.y / rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const float shift = row % 2 ? 0.f : -0.5f;
            const float left = glm::max((static_cast<float>(column) + shift) * pitch.x, 0.f);
            const float right = glm::min((static_cast<float>(column) + shift + 1) * pitch.x, size.x);
            if (right - left < 0.25f * pitch.x) continue;
            const float gap = 0.012f;
            add_box(bricks, upright(base + glm::vec3(0.5f * (left + right - size.x),
                                                     (static_cast<float>(row) + 0.5f) * pitch.y, 0),
                                    {right - left - gap, pitch.y - gap, size.z}));
        }
}

} // namespace

stage models_stage(double aspect)
{
    stage result{{"models", {knot({-0.55f, 0.86f, 0.1f}, 0.85f), chair({0.75f, 0, 0.1f}, 0.6f)}}, {}, {}, {}};
    const glm::vec3 direction(0.55f, -0.9f, -0.45f);
    const bounds casters = bounds_of(result.world);
    const std::vector<glm::vec3> of_interest = casters_and_shadows(casters, direction);
    result.light = orthographic_view(of_interest, direction);
    result.light_size = glm::dvec2(0.05);
    result.world.meshes.push_back(ground({0, 0, 0}, 30, 30, glm::vec3(0.42f)));
    result.eye = perspective_view_from({0.7, 2.1, 4.0}, {0.12, 0.68, 0}, bounds_of(result.world).corners(),
                                       glm::radians(34.0), aspect);
    result.interests = {{"contact", "contact of the chair", {0.75f, 0, 0.1f}, paint::green},
                        {"far", "far shadow of the knot", {0.3f, 0, -0.6f}, paint::orange}};
    return result;
}

stage lamp_stage(double aspect)
{
    stage result = models_stage(aspect);
    result.world.name = "lamp";
    const glm::dvec3 lamp(-1.6, 3.2, 2.0);
    // The casters and their shadows, as far as the lamp's cone reaches.
    const bounds lit{{-2, 0, -2.2f}, {2.4f, 1.9f, 1.1f}};
    result.light = perspective_view_from(lamp, {0.15, 0.42, -0.1}, lit.corners(), glm::radians(46.0), 1);
    result.light_size = glm::dvec2(0.12);
    return result;
}

stage long_range_stage(double aspect)
{
    mesh gantry = painted("gantry", {0.36f, 0.37f, 0.39f}), signs = painted("signs", {0.02f, 0.13f, 0.42f});
    mesh cables = painted("cables", {0.05f, 0.05f, 0.05f}), bench = painted("bench", {0.38f, 0.20f, 0.08f});
    const float half = 4, low = 5.5f, high = 6.2f;
    for (const float x : {-half, half}) add_box(gantry, upright({x, 0.5f * high, 0}, {0.2f, high, 0.2f}));
    for (const float y : {low, high}) add_box(gantry, upright({0, y, 0}, {2 * half, 0.1f, 0.1f}));
    for (int i = 0; i < 15; ++i)
        add_box(gantry,
                upright({-3.5f + 0.5f * static_cast<float>(i), 0.5f * (low + high), 0}, {0.05f, high - low, 0.05f}));
    add_box(signs, upright({-1.9f, 4.9f, 0.1f}, {2.2f, 1.2f, 0.05f}));
    add_box(signs, upright({1.7f, 5.0f, 0.1f}, {1.5f, 1.0f, 0.05f}));
    for (int i = 0; i < 3; ++i) {
        std::vector<glm::vec3> path;
        for (int k = 0; k <= 24; ++k) {
            const float t = static_cast<float>(k) / 12 - 1;
            path.push_back({7 * t, 6.6f + 0.5f * t * t, -1.6f - 0.7f * static_cast<float>(i)});
        }
        add_tube(cables, path, 0.05f, 8);
    }
    for (const float x : {-0.7f, 0.7f})
        for (const float z : {-0.16f, 0.16f}) add_box(bench, upright({x, 0.22f, 1.6f + z}, {0.06f, 0.44f, 0.06f}));
    for (const float z : {-0.18f, -0.06f, 0.06f, 0.18f})
        add_box(bench, upright({0, 0.46f, 1.6f + z}, {1.7f, 0.04f, 0.09f}));

    stage result{{"long_range", {gantry, signs, cables, bench}}, {}, {}, {}};
    const glm::vec3 direction = glm::normalize(glm::vec3(0.22f, -0.85f, 0.55f));
    result.light = orthographic_view(casters_and_shadows(bounds_of(result.world), direction), direction);
    result.light_size = glm::dvec2(0.035);
    result.world.meshes.push_back(ground({0, 0, 0}, 60, 60, {0.40f, 0.39f, 0.36f}));
    result.eye = perspective_view_from({-6.5, 6.0, 14.0}, {0.7, 2.35, 1.0}, bounds_of(result.world).corners(),
                                       glm::radians(34.0), aspect);
    result.interests = {{"sign", "shadow of a sign", {-0.6f, 0, 3.2f}, paint::green},
                        {"cables", "shadows of cables", {2.5f, 0, 2.0f}, paint::cyan},
                        {"bench", "shadow of the bench", {0.8f, 0, 1.9f}, paint::orange}};
    return result;
}

stage pillar_stage(double aspect)
{
    mesh pillar = painted("pillar", {0.50f, 0.47f, 0.42f}), bricks = painted("bricks", {0.42f, 0.13f, 0.07f});
    mesh mortar = painted("mortar", {0.45f, 0.42f, 0.38f});
    const float half = 0.25f, beside = 0.065f, width = 3.2f;
    add_box(pillar, upright({0, 0.06f, 0}, {2 * half, 0.12f, 2 * half}));
    add_box(pillar, upright({0, 0.65f, 0}, {2 * half, 1.1f, 2 * half}));
    add_box(pillar, upright({0, 1.25f, 0}, {2.4f * half, 0.1f, 2.4f * half}));
    add_brick_wall(bricks, mortar, {half + beside + 0.5f * width, 0, -5}, {width, 3.6f, 0.3f});
    stage result{{"pillar", {pillar, bricks, mortar}}, {}, {}, {}};
    const glm::vec3 direction = glm::normalize(glm::vec3(0, -0.42f, 0.9f));
    result.light = orthographic_view(casters_and_shadows(bounds_of(result.world), direction), direction);
    result.light_size = glm::dvec2(0.02);
    result.world.meshes.push_back(ground({0, 0, 0}, 40, 40, {0.40f, 0.39f, 0.36f}));
    result.eye = perspective_view_from({-0.5, 2.3, 3.3}, {0.5, 0.65, -0.6}, bounds_of(result.world).corners(),
                                       glm::radians(46.0), aspect);
    result.interests = {{"alone", "contact of the pillar alone", {-half, 0, half + 0.1f}, paint::green},
                        {"both", "contact beside the wall's shadow", {half, 0, half + 0.1f}, paint::orange}};
    return result;
}

stage grazing_stage(double aspect)
{
    mesh column = painted("column", {0.50f, 0.47f, 0.42f});
    const float radius = 0.24f, height = 1.4f, plate = 0.1f;
    add_box(column, upright({0, 0.5f * plate, 0}, {0.7f, plate, 0.7f}));
    add_box(column, upright({0, height - 0.5f * plate, 0}, {0.7f, plate, 0.7f}));
    mesh shaft = painted("shaft", column.albedo);
    add_tube(shaft, std::array<glm::vec3, 2>{{{0, plate, 0}, {0, height - plate, 0}}}, radius, 48);
    stage result{{"grazing", {column, shaft}}, {}, {}, {}};
    const float incidence = glm::radians(80.f);
    const glm::vec3 direction(std::sin(incidence), -std::cos(incidence), 0);
    // The light sees lit ground on both sides of the shadow.
    result.light = orthographic_view(bounds{{-1, 0, -2}, {9, height, 2}}.corners(), direction);
    result.light_size = glm::dvec2(0.012);
    result.world.meshes.push_back(ground({0, 0, 0}, 40, 40, {0.62f, 0.60f, 0.56f}));
    result.eye = perspective_view_from({-1.6, 2.6, 5.2}, {2.6, 0.35, 0}, bounds_of(result.world).corners(),
                                       glm::radians(38.0), aspect);
    result.interests = {{"penumbra", "beside the penumbra", {4.5f, 0, 0.35f}, paint::orange},
                        {"contact", "contact of the column", {0.5f, 0, 0.3f}, paint::green}};
    return result;
}

} // namespace gnomon::renderer
