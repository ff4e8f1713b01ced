#include "soft_stages.hpp"

#include "tube.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::renderer {

namespace {

mesh painted(std::string name, const glm::vec3& albedo)
{
    return {.name = std::move(name), .albedo = albedo, .positions = {}, .normals = {}, .triangles = {}};
}

// A knot that winds twice around the axis of a torus and three times through its hole.
mesh knot(const glm::vec3& centre, float size)
{
    mesh result = painted("knot", {0.62f, 0.30f, 0.10f});
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

std::vector<glm::vec2> circle(int sides)
{
    std::vector<glm::vec2> result;
    for (int i = 0; i < sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(sides);
        result.emplace_back(std::cos(angle), std::sin(angle));
    }
    return result;
}

// A round solid of this radius that stands on the ground.
void add_column(mesh& target, const glm::vec3& base, float radius, float height)
{
    const glm::mat3 standing(radius * glm::vec3(1, 0, 0), radius * glm::vec3(0, 0, -1),
                             0.5f * height * glm::vec3(0, 1, 0));
    add_prism(target, circle(32), {base + glm::vec3(0, 0.5f * height, 0), standing});
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
    result.light_size = glm::dvec2(0.06);
    result.world.meshes.push_back(ground({0, 0, 0}, 12, 12, glm::vec3(0.55f)));
    result.eye = perspective_view_from({0.9, 2.3, 4.0}, {0.25, 0.5, 0}, bounds_of(result.world).corners(),
                                       glm::radians(34.0), aspect);
    result.interests = {{"contact", "contact of the chair", {0.75f, 0, 0.1f}, {0.05f, 0.6f, 0.1f}},
                        {"far", "far shadow of the knot", {0.3f, 0, -0.6f}, {0.95f, 0.35f, 0.02f}}};
    return result;
}

stage long_range_stage(double aspect)
{
    mesh gantry = painted("gantry", {0.45f, 0.46f, 0.48f}), signs = painted("signs", {0.05f, 0.22f, 0.50f});
    mesh cables = painted("cables", {0.12f, 0.12f, 0.12f}), bench = painted("bench", {0.45f, 0.28f, 0.14f});
    for (const float x : {-4.f, 4.f}) add_box(gantry, upright({x, 4, 0}, {0.16f, 8, 0.16f}));
    for (const float y : {7.2f, 7.9f}) add_box(gantry, upright({0, y, 0}, {8, 0.08f, 0.08f}));
    for (int i = 0; i < 16; ++i) {
        const float x = -3.75f + 0.5f * static_cast<float>(i);
        add_box(gantry, upright({x, 7.55f, 0}, {0.04f, 0.7f, 0.04f}));
    }
    add_box(signs, upright({-1.8f, 6.6f, 0.1f}, {1.8f, 1.1f, 0.04f}));
    add_box(signs, upright({1.5f, 6.8f, 0.1f}, {1.2f, 0.8f, 0.04f}));
    for (int i = 0; i < 3; ++i) {
        std::vector<glm::vec3> path;
        for (int k = 0; k <= 24; ++k) {
            const float t = static_cast<float>(k) / 12 - 1;
            path.push_back({5 * t, 5.2f + 0.5f * static_cast<float>(i) + 0.6f * t * t, 1.2f});
        }
        add_tube(cables, path, 0.03f, 8);
    }
    for (const float x : {-0.7f, 0.7f})
        for (const float z : {-0.16f, 0.16f}) add_box(bench, upright({x, 0.22f, 1.5f + z}, {0.06f, 0.44f, 0.06f}));
    for (const float z : {-0.18f, -0.06f, 0.06f, 0.18f})
        add_box(bench, upright({0, 0.46f, 1.5f + z}, {1.7f, 0.04f, 0.09f}));

    stage result{{"long_range", {gantry, signs, cables, bench}}, {}, {}, {}};
    const glm::vec3 direction = glm::normalize(glm::vec3(0.18f, -0.85f, 0.45f));
    result.light = orthographic_view(casters_and_shadows(bounds_of(result.world), direction), direction);
    result.light_size = glm::dvec2(0.03);
    result.world.meshes.push_back(ground({0, 0, 2}, 24, 24, {0.50f, 0.49f, 0.46f}));
    result.eye = perspective_view_from({-3.5, 5.0, 10.5}, {0.6, 0.4, 2.6}, bounds_of(result.world).corners(),
                                       glm::radians(38.0), aspect);
    result.interests = {{"sign", "shadow of a sign", {0, 0, 3.6f}, {0.05f, 0.6f, 0.1f}},
                        {"cables", "shadows of cables", {2, 0, 4.2f}, {0.02f, 0.6f, 0.7f}},
                        {"bench", "shadow of the bench", {0.8f, 0, 1.8f}, {0.95f, 0.35f, 0.02f}}};
    return result;
}

stage pillar_stage(double aspect)
{
    mesh pillar = painted("pillar", {0.60f, 0.58f, 0.54f}), bricks = painted("bricks", {0.50f, 0.20f, 0.13f});
    mesh mortar = painted("mortar", {0.55f, 0.52f, 0.48f});
    add_box(pillar, upright({0, 0.9f, 0}, {0.5f, 1.8f, 0.5f}));
    add_box(pillar, upright({0, 1.86f, 0}, {0.62f, 0.12f, 0.62f}));
    add_brick_wall(bricks, mortar, {2.3f, 0, -6}, {3, 5, 0.3f});
    stage result{{"pillar", {pillar, bricks, mortar}}, {}, {}, {}};
    const glm::vec3 direction = glm::normalize(glm::vec3(0, -0.5f, 0.85f));
    result.light = orthographic_view(casters_and_shadows(bounds_of(result.world), direction), direction);
    result.light_size = glm::dvec2(0.06);
    result.world.meshes.push_back(ground({0, 0, 0}, 20, 20, {0.50f, 0.49f, 0.46f}));
    result.eye = perspective_view_from({0.3, 3.4, 5.5}, {0.3, 0.5, 0.2}, bounds_of(result.world).corners(),
                                       glm::radians(34.0), aspect);
    result.interests = {{"alone", "contact of the pillar alone", {-0.25f, 0, 0.4f}, {0.05f, 0.6f, 0.1f}},
                        {"both", "contact near the wall's shadow", {0.25f, 0, 0.4f}, {0.95f, 0.35f, 0.02f}}};
    return result;
}

stage grazing_stage(double aspect)
{
    mesh column = painted("column", {0.62f, 0.60f, 0.55f});
    add_box(column, upright({0, 0.06f, 0}, {0.8f, 0.12f, 0.8f}));
    add_column(column, {0, 0.12f, 0}, 0.28f, 1.8f);
    add_box(column, upright({0, 1.98f, 0}, {0.8f, 0.12f, 0.8f}));
    stage result{{"grazing", {column}}, {}, {}, {}};
    const float incidence = glm::radians(80.f);
    const glm::vec3 direction(std::sin(incidence), -std::cos(incidence), 0);
    result.light = orthographic_view(casters_and_shadows(bounds_of(result.world), direction), direction);
    result.light_size = glm::dvec2(0.05);
    result.world.meshes.push_back(ground({4, 0, 0}, 24, 12, {0.50f, 0.49f, 0.46f}));
    result.eye = perspective_view_from({-2.0, 4.2, 7.0}, {3.2, 0.4, 0}, bounds_of(result.world).corners(),
                                       glm::radians(40.0), aspect);
    result.interests = {{"penumbra", "beside the penumbra", {5, 0, 0.7f}, {0.95f, 0.35f, 0.02f}},
                        {"contact", "contact of the column", {0.45f, 0, 0.3f}, {0.05f, 0.6f, 0.1f}}};
    return result;
}

} // namespace gnomon::renderer
