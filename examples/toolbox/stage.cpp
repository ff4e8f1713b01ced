#include "stage.hpp"

#include <array>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace gnomon::toolbox {

namespace {

mesh painted(std::string name, const glm::vec3& albedo)
{
    return {.name = std::move(name), .albedo = albedo, .positions = {}, .normals = {}, .triangles = {}};
}

// The fence stands in the plane x = 0, the light comes from behind the sign at x < 0, the wall is at x > 0.
constexpr float fence_half_length = 2.52f, slat_pitch = 0.12f;

mesh fence()
{
    mesh result = painted("fence", {0.72f, 0.66f, 0.55f});
    const std::array<glm::vec2, 5> picket{{{-1, -1}, {1, -1}, {1, 0.93f}, {0, 1}, {-1, 0.93f}}};
    const int slats = static_cast<int>(2 * fence_half_length / slat_pitch);
    for (int i = 0; i < slats; ++i) {
        const float z = (static_cast<float>(i) + 0.5f) * slat_pitch - fence_half_length;
        add_prism(result, picket, upright({0, 0.54f, z}, {0.06f, 0.96f, 0.02f}, glm::half_pi<float>()));
    }
    for (const float y : {0.26f, 0.8f}) add_box(result, upright({-0.025f, y, 0}, {0.03f, 0.07f, 5.1f}));
    for (const float z : {-2.52f, -0.84f, 0.84f, 2.52f})
        add_box(result, upright({-0.075f, 0.54f, z}, {0.07f, 1.08f, 0.07f}));
    return result;
}

mesh wall()
{
    mesh result = painted("wall", {0.55f, 0.27f, 0.19f});
    add_box(result, upright({0.55f, 0.27f, 1}, {0.05f, 0.54f, 2.9f}));
    return result;
}

mesh sign_board()
{
    mesh result = painted("sign", {0.80f, 0.56f, 0.08f});
    const std::array<glm::vec2, 5> arrow{{{-1, -1}, {0.62f, -1}, {1, 0}, {0.62f, 1}, {-1, 1}}};
    const float quarter = glm::half_pi<float>();
    add_prism(result, arrow, upright({-0.87f, 1.56f, -0.12f}, {1.1f, 0.3f, 0.03f}, quarter - 0.12f));
    add_prism(result, arrow, upright({-0.87f, 1.2f, 0.08f}, {0.9f, 0.26f, 0.03f}, -quarter + 0.3f));
    return result;
}

mesh sign_post()
{
    mesh result = painted("post", {0.33f, 0.34f, 0.36f});
    add_box(result, upright({-0.95f, 0.9f, 0}, {0.08f, 1.8f, 0.08f}));
    return result;
}

} // namespace

rectangle inset_around(const point_of_interest& place, const camera& eye, int size, int width, int height)
{
    const glm::dvec3 seen = project(eye, place.position);
    return rectangle_around(seen.x * width, seen.y * height, size, width, height);
}

scene fence_scene()
{
    return {"fence",
            {ground({0.3f, 0, 0.1f}, 8.4f, 9, {0.40f, 0.43f, 0.34f}), sign_post(), sign_board(), fence(), wall()}};
}

stage fence_stage(double aspect)
{
    stage result{fence_scene(), {}, {}, {}};
    const bounds all = bounds_of(result.world);
    result.eye = perspective_view_from({4.1, 3.4, 1.5}, {0.25, 0.45, 0.1}, all, glm::radians(36.0), aspect);
    result.light = orthographic_view(all, {0.75, -0.62, 0.25});
    result.interests = {{"fence", {0.75f, 0, -1.4f}, {0.05f, 0.6f, 0.1f}},
                        {"fence and wall", {0.85f, 0, 1.9f}, {0.02f, 0.6f, 0.7f}},
                        {"sign, fence and wall", {0.85f, 0, 0.7f}, {0.95f, 0.35f, 0.02f}}};
    return result;
}

stage model_stage(scene model, double aspect)
{
    const bounds solid = bounds_of(model);
    const glm::vec3 centre = solid.centre();
    model.meshes.push_back(ground({centre.x, solid.lower.y, centre.z}, 4, 4, glm::vec3(0.5f)));
    const bounds all = bounds_of(model);
    const camera framed = perspective_view(solid, {-0.5, -0.55, -1}, glm::radians(35.0), aspect);
    stage result{std::move(model), {}, {}, {}};
    result.eye =
        perspective_view_from(framed.position - 0.25 * framed.forward, centre, all, glm::radians(35.0), aspect);
    result.light = orthographic_view(all, {0.7, -0.9, -0.25});
    return result;
}

} // namespace gnomon::toolbox
