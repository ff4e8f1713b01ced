#include "stage.hpp"

#include "paint.hpp"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <utility>

namespace gnomon::renderer {

namespace {

// The light comes over the sign at x = -0.6, the fence at x = 0 and the wall at x = 0.55, in this order.
const glm::vec3 fence_light(0.75f, -0.55f, 0.25f);

mesh fence()
{
    mesh result = painted("fence", {0.72f, 0.66f, 0.55f});
    const std::array<glm::vec2, 5> picket{{{-1, -1}, {1, -1}, {1, 0.94f}, {0, 1}, {-1, 0.94f}}};
    const float quarter = glm::half_pi<float>(), half_length = 2.4f, pitch = 0.06f;
    for (int i = 0; i < 80; ++i) {
        const float z = (static_cast<float>(i) + 0.5f) * pitch - half_length;
        add_prism(result, picket, upright({0, 0.53f, z}, {0.03f, 0.94f, 0.012f}, quarter));
    }
    for (const float y : {0.26f, 0.8f}) add_box(result, upright({-0.018f, y, 0}, {0.024f, 0.06f, 2 * half_length}));
    for (const float z : {-1.f, -0.25f, 0.5f, 1.f})
        add_box(result, upright({-0.06f, 0.53f, z * half_length}, {0.06f, 1.06f, 0.06f}));
    return result;
}

mesh wall()
{
    mesh result = painted("wall", {0.55f, 0.27f, 0.19f});
    add_box(result, upright({0.55f, 0.18f, 0.75f}, {0.04f, 0.36f, 2.9f}));
    return result;
}

mesh sign_board()
{
    mesh result = painted("sign", {0.85f, 0.60f, 0.06f});
    const std::array<glm::vec2, 5> arrow{{{-1, -1}, {0.68f, -1}, {1, 0}, {0.68f, 1}, {-1, 1}}};
    const float quarter = glm::half_pi<float>();
    add_prism(result, arrow, upright({-0.55f, 1.36f, -0.10f}, {0.95f, 0.24f, 0.02f}, quarter - 0.1f));
    add_prism(result, arrow, upright({-0.55f, 1.06f, 0.10f}, {0.85f, 0.22f, 0.02f}, -quarter + 0.15f));
    return result;
}

mesh sign_post()
{
    mesh result = painted("post", {0.33f, 0.34f, 0.36f});
    add_box(result, upright({-0.6f, 0.77f, 0}, {0.06f, 1.54f, 0.06f}));
    return result;
}

// The sun at noon, over a yard of this size.
const glm::vec3 noon_light(0.01f, -1, 0.015f);
const bounds yard{{-4, 0, -4}, {4, 4, 4}};

// Four slats on two joists, turned a little; their upper sides lie at this height.
mesh duckboard(float x, float height)
{
    mesh result = painted(fmt::format("duckboard at {:.2g} m", height), {0.50f, 0.38f, 0.24f});
    const float angle = 0.12f, pitch = 0.24f, length = 1.2f, thickness = 0.012f, joist = height - thickness;
    const placement board = upright({x, 0, 0}, {4 * pitch, height, length}, angle);
    const auto add = [&](const glm::vec3& place, const glm::vec3& size) {
        add_box(result, upright(board.centre + board.half_axes * place, size, angle));
    };
    for (const float side : {-0.75f, -0.25f, 0.25f, 0.75f})
        add({side, 2 - thickness / height, 0}, {0.5f * pitch, thickness, length});
    for (const float end : {-0.7f, 0.7f}) add({0, joist / height, end}, {3.5f * pitch, joist, 0.05f});
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
    return {"fence", {sign_post(), sign_board(), fence(), wall(), ground({-2, 0, 0}, 14, 14, {0.40f, 0.43f, 0.34f})}};
}

stage fence_stage(double aspect)
{
    scene world = fence_scene();
    scene casters = world;
    casters.meshes.pop_back();
    stage result{std::move(world), {}, {}, {}};
    result.eye = perspective_view_from({3.6, 4.6, 1.2}, {0.34, 0.28, 0.16}, bounds_of(result.world).corners(),
                                       glm::radians(36.0), aspect);
    result.light = orthographic_view(casters_and_shadows(bounds_of(casters), fence_light), fence_light);
    result.interests = {{"fence", "fence", {0.75f, 0, -1.4f}, paint::green},
                        {"fence_wall", "fence and wall", {0.95f, 0, 1.9f}, paint::cyan},
                        {"sign_fence_wall", "sign, fence and wall", {0.84f, 0, 0.89f}, paint::orange}};
    return result;
}

stage contact_stage(double aspect)
{
    const std::array<glm::vec3, 3> colours{{paint::green, paint::cyan, paint::orange}};
    stage result{{"contact", {}}, {}, {}, {}};
    result.light = orthographic_view(yard.corners(), noon_light);
    const double metres_per_depth = 0.5 * (result.light.far_distance - result.light.near_distance);
    for (std::size_t i = 0; i < contact_gaps.size(); ++i) {
        const float x = 1.3f * (static_cast<float>(i) - 1);
        const double height = contact_gaps[i] * metres_per_depth * -result.light.forward.y;
        result.world.meshes.push_back(duckboard(x, static_cast<float>(height)));
        result.interests.push_back(
            {fmt::format("gap_{}", i + 1), fmt::format("gap of {}", contact_gaps[i]), {x, 0, 0}, colours[i]});
    }
    result.world.meshes.push_back(ground({0, 0, 0}, 14, 14, {0.40f, 0.43f, 0.34f}));
    result.eye = perspective_view_from({0.4, 3.2, 1.9}, {0, 0, 0}, bounds_of(result.world).corners(),
                                       glm::radians(36.0), aspect);
    return result;
}

stage model_stage(scene model, double aspect)
{
    const glm::vec3 light_direction(0.7f, -0.9f, -0.25f);
    const double field_of_view = glm::radians(35.0);
    const bounds casters = bounds_of(model);
    const glm::vec3 centre = casters.centre();
    model.meshes.push_back(ground({centre.x, casters.lower.y, centre.z}, 4, 4, glm::vec3(0.5f)));
    stage result{std::move(model), {}, {}, {}};
    const std::vector<glm::vec3> of_interest = casters_and_shadows(casters, light_direction);
    result.light = orthographic_view(of_interest, light_direction);
    result.light_size = glm::dvec2(0.06);
    const camera framed = perspective_view(of_interest, {-0.5, -0.55, -1}, field_of_view, aspect);
    result.eye = perspective_view_from(framed.position, framed.position + framed.forward,
                                       bounds_of(result.world).corners(), field_of_view, aspect);
    return result;
}

} // namespace gnomon::renderer
