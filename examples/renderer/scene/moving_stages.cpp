#include "moving_stages.hpp"

#include "moving_stage_builder.hpp"
#include "paint.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::renderer {

using namespace paint;

namespace {

// A level quad around its centre that can be seen from above.
mesh level_quad(std::string name, const glm::vec3& albedo, const glm::vec3& centre, float half_x, float half_z)
{
    mesh result = painted(std::move(name), albedo);
    add_quad(result, centre + glm::vec3(-half_x, 0, half_z), {2 * half_x, 0, 0}, {0, 0, -2 * half_z});
    return result;
}

// A cube of cells x cells quads per face. Faces meet in equal corners: their coordinates are computed alike.
void add_fine_cube(mesh& target, const glm::vec3& centre, float half, int cells)
{
    const auto count = static_cast<std::uint32_t>(cells);
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.f, 1.f}) {
            const auto first = static_cast<std::uint32_t>(target.positions.size());
            for (int j = 0; j <= cells; ++j)
                for (int i = 0; i <= cells; ++i) {
                    glm::vec3 corner;
                    corner[axis] = side;
                    corner[(axis + 1) % 3] = static_cast<float>(2 * i - cells) / static_cast<float>(cells);
                    corner[(axis + 2) % 3] = static_cast<float>(2 * j - cells) / static_cast<float>(cells);
                    target.positions.push_back(centre + half * corner);
                }
            for (std::uint32_t j = 0; j < count; ++j)
                for (std::uint32_t i = 0; i < count; ++i) {
                    const std::uint32_t a = first + j * (count + 1) + i, b = a + 1, c = b + count + 1, d = c - 1;
                    if (side > 0) target.triangles.insert(target.triangles.end(), {{a, b, c}, {a, c, d}});
                    else target.triangles.insert(target.triangles.end(), {{a, c, b}, {a, d, c}});
                }
        }
}

} // namespace

moving_stage pillars(double aspect)
{
    mesh boxes = painted("pillars", sand);
    for (int x = -2; x <= 2; ++x)
        for (int z = -1; z <= 1; ++z) add_box(boxes, upright({x, 0.5f, z}, {0.24f, 1, 0.24f}));
    moving_scene casters{{"pillars", {}}, {}};
    add(casters, boxes, glm::vec3(0));
    return on_ground(casters, {{-3, 2.5, -0.5}, {-3, 5, -0.5}}, {{1, 5.5, 6}, {0.6, 0, 0}, 40}, aspect,
                     {{"tips_of_shadows", "tips of shadows", {2.8f, 0, 1.7f}, green}});
}

moving_stage crossed_quads(double aspect)
{
    moving_scene casters{{"crossed quads", {}}, {}};
    add(casters, level_quad("upper", clay, {-2, 2, 0}, 0.25f, 2), {4, 0, 0});
    add(casters, level_quad("lower", moss, {0, 1, -2}, 2, 0.25f), {0, 0, 4});
    return on_ground(casters, {{0, 8, 0}, {0, 8, 0}}, {{0, 7, 7}, {0, 0.5, 0}, 45}, aspect,
                     {{"lower_quad", "lower quad", {0, 1, 0}, green}, {"ground", "ground", {0.3f, 0, 2.1f}, cyan}});
}

moving_stage toward_and_away(double aspect)
{
    moving_scene casters{{"toward and away", {}}, {}};
    add(casters, level_quad("toward", clay, {-1.2f, 0.3f, 0}, 0.5f, 0.5f), {0, 2.2f, 0});
    add(casters, level_quad("away", moss, {1.2f, 2.5f, 0}, 0.5f, 0.5f), {0, -2.2f, 0});
    return on_ground(casters, {{0, 6, 0}, {0, 6, 0}}, {{0, 5, 7}, {0, 0.6, 0}, 45}, aspect,
                     {{"toward", "toward", {-2, 0, 0.3f}, green}, {"away", "away", {2, 0, 0.3f}, cyan}});
}

moving_stage cubes_to_the_light(double aspect)
{
    mesh cubes = painted("cubes", clay);
    for (const float x : {-1.f, 1.f}) add_fine_cube(cubes, {x, 0.6f, 0}, 0.5f, 22);
    moving_scene casters{{"cubes to the light", {}}, {}};
    add(casters, cubes, {0, 1.5f, 0});
    return on_ground(casters, {{0, 7, 0}, {0, 7, 0}}, {{0, 4, 6}, {0, 0.9, 0}, 45}, aspect,
                     {{"ground", "ground", {-1.8f, 0, 0.6f}, green}, {"face", "face", {1, 1.3f, 0.5f}, cyan}});
}

moving_stage random_cubes(double aspect, int count, float longest, float half_extent)
{
    mesh open = painted("cubes", sand), closing = open;
    const glm::vec3 size(2 * half_extent);
    uniform random(1);
    for (int i = 0; i < count; ++i) {
        const float x = random(-4, 4), y = random(0.5f, 4.5f), z = random(-4, 4);
        const float upwards = random(-1, 1), angle = random(0, glm::two_pi<float>()), length = random(0, longest);
        const float level = std::sqrt(1 - upwards * upwards);
        const glm::vec3 half_way = 0.5f * length * glm::vec3(level * std::cos(angle), upwards, level * std::sin(angle));
        add_box(open, upright(glm::vec3(x, y, z) - half_way, size));
        add_box(closing, upright(glm::vec3(x, y, z) + half_way, size));
    }
    moving_scene casters{{"random cubes", {}}, {}};
    add(casters, open, closing);
    return on_ground(casters, {{3, 10, 3}, {3, 10, 3}}, {{0, 8, 11}, {0, 1.5, 0}, 45}, aspect,
                     {{"ground", "ground", {-3, 0, 2}, green}, {"cubes", "cubes", {1, 2, 1}, cyan}});
}

namespace {

// A square plane turned about the x axis.
mesh plane(float degrees)
{
    mesh result = painted("plane", stone);
    const float angle = glm::radians(degrees);
    const glm::vec3 away(0, std::sin(angle), -std::cos(angle));
    add_quad(result, glm::vec3(-3, 0, 0) - 3.f * away, {6, 0, 0}, 6.f * away);
    return result;
}

} // namespace

moving_stage cube_over_plane(double aspect, float degrees, float height, float z)
{
    mesh cube = painted("cube", clay);
    add_box(cube, upright({-0.75f, height, z}, glm::vec3(0.8f)));
    moving_scene casters{{fmt::format("cube over plane, {:g} degrees", degrees), {}}, {}};
    add(casters, cube, {1.5f, 0, 0});
    const float reach = 6 / (6 - height); // of the shadow, over that of the cube from the light
    moving_scene world = casters;
    add(world, plane(-degrees), plane(degrees));
    return staged(casters, std::move(world), {{2, 6, 1}, {2, 6, 1}}, {{0, 5, 7}, {0, 0.4, 0}, 45}, aspect,
                  {{"shadow", "shadow", {2 - 2 * reach, 0, 1 + reach * (z - 1)}, green}});
}

moving_stage turning_plane(double aspect, float open, float close)
{
    mesh cube = painted("cube", clay);
    add_box(cube, upright({-0.3f, 1.6f, 1.3f}, glm::vec3(0.6f)));
    moving_scene casters{{fmt::format("plane turning from {:g} to {:g} degrees", open, close), {}}, {}};
    add(casters, cube, {0.6f, 0, 0});
    moving_scene world = casters;
    add(world, plane(open), plane(close));
    return staged(casters, std::move(world), {{2, 6, 3}, {2, 6, 3}}, {{0, 5, 7}, {0, 0.8, 0}, 50}, aspect, {});
}

moving_stage fan(double aspect)
{
    const auto blades = [](float turn) {
        mesh result = painted("blades", clay);
        const float pitch = 0.25f * glm::pi<float>(), half_width = 0.25f * pitch;
        for (std::uint32_t i = 0; i < 8; ++i) {
            const float middle = turn + static_cast<float>(i) * pitch;
            for (const auto& [radius, side] : {std::pair(0.2f, -1.f), {1.8f, -1.f}, {1.8f, 1.f}, {0.2f, 1.f}}) {
                const float angle = middle + side * half_width;
                result.positions.push_back({radius * std::cos(angle), 1.5f, -radius * std::sin(angle)});
            }
            result.triangles.insert(result.triangles.end(), {4 * i + glm::uvec3(0, 1, 2), 4 * i + glm::uvec3(0, 2, 3)});
        }
        return result;
    };
    moving_scene casters{{"fan", {}}, {}};
    add(casters, blades(0), blades(glm::half_pi<float>()));
    return on_ground(casters, {{0, 8, 0}, {0, 8, 0}}, {{0, 6, 6}, {0, 0.6, 0}, 45}, aspect,
                     {{"rim", "rim", {0, 0, 1.8f}, green}, {"hub", "hub", {0, 0, 0.3f}, cyan}});
}

moving_stage waving_sheet(double aspect, int cells)
{
    const auto at = [&](float drift, float phase) {
        mesh result = painted("sheet", moss);
        const auto count = static_cast<std::uint32_t>(cells);
        for (std::uint32_t j = 0; j <= count; ++j)
            for (std::uint32_t i = 0; i <= count; ++i) {
                const float u = static_cast<float>(i) / static_cast<float>(cells),
                            v = static_cast<float>(j) / static_cast<float>(cells);
                const float wave = std::sin(2 * glm::two_pi<float>() * (u + phase)) + std::sin(9 * v - 5 * u);
                result.positions.push_back({4 * u - 2 + drift, 1.2f + 0.15f * wave, 4 * v - 2});
                if (i == count || j == count) continue;
                const std::uint32_t a = j * (count + 1) + i, b = a + 1, c = b + count + 1, d = c - 1;
                result.triangles.insert(result.triangles.end(), {{a, c, b}, {a, d, c}});
            }
        return result;
    };
    moving_scene casters{{"waving sheet", {}}, {}};
    add(casters, at(-0.1f, 0), at(0.1f, 0.1f));
    return on_ground(casters, {{1, 8, 1}, {1, 8, 1}}, {{0, 5, 6}, {0, 0.6, 0}, 45}, aspect,
                     {{"sheet", "sheet", {0, 1.2f, 0}, green}});
}

moving_stage lit_ramp(double aspect)
{
    mesh ramp = painted("ramp", moss);
    const glm::vec3 uphill = 1.5f * glm::vec3(std::cos(0.5f), std::sin(0.5f), 0), away(0, 0, -1.5f);
    add_quad(ramp, glm::vec3(0, -0.2f, 0) - uphill - away, 2.f * uphill, 2.f * away);
    moving_scene world{{"lit ramp", {}}, {}};
    add(world, ramp, {0, 2, 0});
    return staged(world, world, {{0, 7, 0}, {0, 7, 0}}, {{0, 5, 6}, {0, 0.8, 0}, 45}, aspect,
                  {{"ramp", "ramp", {0, 0.8f, 0}, green}});
}

moving_stage moving_panes(double aspect)
{
    moving_scene casters{{"panes", {}}, {}};
    mesh cube = painted("cube", clay);
    add_box(cube, upright({-1.2f, 0.3f, 0.7f}, glm::vec3(0.6f)));
    add(casters, cube, {0.9f, 0, 0});
    const auto add_pane = [&](const glm::vec3& centre, float half, float opacity, const glm::vec3& motion) {
        mesh pane = level_quad("pane", moss, centre, half, half);
        pane.opacity = glm::vec3(opacity);
        add(casters, pane, motion);
    };
    add_pane({-1.1f, 2, 0}, 0.7f, 0.4f, {1.4f, 0, 0});
    add_pane({0, 1.5f, -1}, 0.8f, 0.6f, {0, 0, 1.2f});
    add_pane({1.2f, 1, 0.4f}, 0.5f, 0.8f, {-0.8f, 0.3f, 0.4f});
    moving_stage result = on_ground(casters, {{1, 7, 2.5}, {1, 7, 2.5}}, {{0, 5, 6}, {0, 0.2, 0.2}, 30}, aspect,
                                    {{"cube", "cube", {-0.7f, 0.6f, 0.7f}, green}});
    std::rotate(result.world.open.meshes.begin() + 1, result.world.open.meshes.end() - 1,
                result.world.open.meshes.end());
    std::rotate(result.world.closing.begin() + 1, result.world.closing.end() - 1, result.world.closing.end());
    return result;
}

moving_stage trapezoid(double aspect)
{
    moving_scene casters{{"trapezoid", {}}, {}};
    add(casters, level_quad("bar", clay, {-1, 2, 0}, 0.25f, 1.5f), {2, 0, 0});
    return on_ground(casters, {{0, 2000, 0}, {0, 2000, 0}}, {{0, 6, 6}, {0, 0.5, 0}, 45}, aspect,
                     {{"slope", "slope", {1, 0, 0.8f}, green}});
}

double trapezoid_visibility(const glm::dvec3& ground_point)
{
    // The ray to the light crosses the bar's height at (x, z), and the bar's centre runs from -1 to 1 in x.
    const double to_height = (2000.0 - 2.0) / 2000.0;
    const double x = std::abs(to_height * ground_point.x), z = std::abs(to_height * ground_point.z);
    if (!(z < 1.5)) return 1;
    return 1 - 0.5 * std::max(std::min(x + 0.25, 1.0) - (x - 0.25), 0.0);
}

moving_stage animated_model_stage(moving_scene model, double aspect)
{
    const auto corners = bounds_of(model).corners();
    mesh everywhere;
    everywhere.positions.assign(corners.begin(), corners.end());
    const stage framed = model_stage({"", {everywhere}}, aspect);
    add(model, framed.world.meshes.back(), glm::vec3(0));
    return {std::move(model), {framed.eye}, {framed.light}, {}};
}

} // namespace gnomon::renderer
