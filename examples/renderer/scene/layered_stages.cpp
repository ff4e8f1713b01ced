#include "layered_stages.hpp"

#include "moving_stage_builder.hpp"
#include "paint.hpp"
#include "tree.hpp"
#include "tube.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::renderer {

using namespace paint;

namespace {

constexpr int tentacle_count = 8, cups_in_row = 16;
constexpr float tentacle_length = 2.4f;
const glm::vec3 body(0, 1.2f, 0); // centre of the ball

// The path of a tentacle, which bends to the left by these angles at its end, in radians.
struct tentacle_pose {
    float heading, bend, rise, fall;

    glm::vec3 direction(float share) const // of its length
    {
        const float around = heading + bend * share, up = rise - fall * share;
        return {std::cos(up) * std::cos(around), std::sin(up), -std::cos(up) * std::sin(around)};
    }

    std::vector<glm::vec3> path(int rings) const
    {
        const float step = tentacle_length / static_cast<float>(rings - 1);
        std::vector<glm::vec3> result{body + 0.3f * direction(0)};
        for (int i = 0; i + 1 < rings; ++i)
            result.push_back(result.back() +
                             step * direction((static_cast<float>(i) + 0.5f) / static_cast<float>(rings - 1)));
        return result;
    }
};

tentacle_pose pose_of(int tentacle, bool closing)
{
    const float side = tentacle % 2 == 0 ? 1.f : -1.f;
    const float bend = glm::radians(side * (closing ? 90.f : 50.f));
    const float heading = glm::two_pi<float>() * static_cast<float>(tentacle) / tentacle_count;
    // Every third one is as high, and none touches the ground.
    const std::array slopes{glm::vec2(45, 80), glm::vec2(15, 40), glm::vec2(-5, 20)};
    const glm::vec2 slope = glm::radians(slopes[static_cast<std::size_t>(tentacle % 3)]);
    return {heading, bend, slope.x, slope.y};
}

float tentacle_radius(float share) { return glm::mix(0.22f, 0.04f, share); }

// Two rows of cups, a little below both sides of the tentacle.
void add_cups(mesh& target, const tentacle_pose& pose, int sides)
{
    std::vector<glm::vec2> circle;
    for (int i = 0; i < sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(sides);
        circle.push_back({std::cos(angle), std::sin(angle)});
    }
    constexpr int rings = 4 * cups_in_row + 1;
    const std::vector<glm::vec3> path = pose.path(rings);
    for (int cup = 0; cup < cups_in_row; ++cup) {
        const int at = 4 * cup + 3;
        const float share = static_cast<float>(at) / (rings - 1), size = glm::mix(0.05f, 0.025f, share);
        const glm::vec3 along = pose.direction(share);
        const glm::vec3 left = glm::normalize(glm::cross(glm::vec3(0, 1, 0), along)), down = glm::cross(left, along);
        for (const float side : {-1.f, 1.f}) {
            const glm::vec3 outwards = 0.5f * down + side * 0.5f * glm::root_three<float>() * left;
            add_prism(target, circle,
                      {path[static_cast<std::size_t>(at)] + tentacle_radius(share) * outwards,
                       size * glm::mat3(along, glm::cross(outwards, along), 0.6f * outwards)});
        }
    }
}

} // namespace

moving_stage tentacles(double aspect, bool full)
{
    const int rings = full ? 150 : 64, sides = full ? 75 : 24;
    std::vector<float> radii;
    for (int i = 0; i < rings; ++i)
        radii.push_back(tentacle_radius(static_cast<float>(i) / static_cast<float>(rings - 1)));
    std::array<mesh, 2> arms, cups;
    for (const bool closing : {false, true}) {
        mesh &arm = arms[closing] = painted("tentacles", clay), &cup = cups[closing] = painted("cups", sand);
        for (int i = 0; i < tentacle_count; ++i) {
            const tentacle_pose pose = pose_of(i, closing);
            add_capped_tube(arm, pose.path(rings), radii, sides);
            add_cups(cup, pose, full ? 24 : 12);
        }
    }
    mesh ball = painted("body", clay);
    add_ball(ball, body, 0.5f, full ? 48 : 24, full ? 72 : 36);
    moving_scene casters{{"tentacles", {}}, {}};
    add(casters, arms[0], arms[1]);
    add(casters, cups[0], cups[1]);
    add(casters, ball, glm::vec3(0));
    return on_ground(
        casters, {{1.5, 6, 1}, {1.5, 6, 1}}, {{0, 4, 6}, {0, 0.6, 0}, 40}, aspect,
        {{"crossing", "crossing tentacles", {0.2f, 0, 1.95f}, green}, {"cups", "cups", {-0.25f, 0, 1.2f}, cyan}});
}

moving_stage tentacles_from_above(double aspect, bool full)
{
    moving_stage result = tentacles(aspect, full);
    result.world.open.name = "tentacles from above";
    result.eye.open =
        perspective_view_from({0, 7, 0.1}, {0, 0, 0}, bounds_of(result.world).corners(), glm::radians(40.0), aspect);
    return result;
}

moving_stage wrecking_ball(double aspect)
{
    const glm::vec3 from(-1.8f, 1.5f, 0), to(0.3f, 0.9f, 0), crane(0.05f, 4, 0);
    mesh ball = painted("ball", glm::vec3(0.2f, 0.22f, 0.25f));
    add_ball(ball, from, 0.45f, 25, 40);
    // Links of a chain from the crane to the ball, by turns across each other.
    const auto chain = [&](const glm::vec3& centre) {
        mesh result = painted("chain", glm::vec3(0.3f, 0.26f, 0.22f));
        constexpr int links = 12;
        const glm::vec3 down = glm::normalize(centre - crane), end = centre - 0.4f * down, across(0, 0, 1);
        const float length = glm::length(end - crane) / links;
        for (int i = 0; i < links; ++i) {
            const glm::vec3 wide = i % 2 == 0 ? across : glm::cross(down, across), thin = glm::cross(wide, down);
            add_box(result, {crane + (static_cast<float>(i) + 0.5f) * length * down,
                             {0.07f * wide, 0.62f * length * down, 0.03f * thin}});
        }
        return result;
    };
    // A wall of 5 x 6 boxes, which fly away from where the ball meets it, the faster the nearer, and turn.
    mesh wall = painted("boxes", sand), scattered = wall;
    uniform random(2);
    const glm::vec3 origin(-0.6f, 0.7f, 0);
    for (int row = 0; row < 6; ++row)
        for (int column = -2; column <= 2; ++column) {
            const glm::vec3 centre(0.9f, 0.15f + 0.3f * static_cast<float>(row), 0.3f * static_cast<float>(column));
            const glm::vec3 away = centre - origin;
            const float speed = 1.2f / glm::dot(away, away), angle = random(-0.8f, 0.8f);
            const glm::vec3 axis = glm::normalize(glm::vec3(random(-1, 1), random(-1, 1), random(-1, 1)));
            glm::vec3 place = centre + speed * away;
            place.y = glm::max(place.y, 0.26f + 0.02f * static_cast<float>(row)); // more than half of the diagonal
            glm::mat3 turned;
            for (int i = 0; i < 3; ++i) { // by Rodrigues' formula
                const glm::vec3 e(i == 0, i == 1, i == 2);
                turned[i] = std::cos(angle) * e + std::sin(angle) * glm::cross(axis, e) +
                            (1 - std::cos(angle)) * glm::dot(axis, e) * axis;
            }
            add_box(wall, upright(centre, glm::vec3(0.3f)));
            add_box(scattered, {place, 0.15f * turned});
        }
    moving_scene casters{{"wrecking ball", {}}, {}};
    add(casters, ball, to - from);
    add(casters, chain(from), chain(to));
    add(casters, wall, scattered);
    return on_ground(
        casters, {{2, 7, 2}, {2, 7, 2}}, {{0, 3, 6}, {0, 0.8, 0}, 45}, aspect,
        {{"ball", "shadow of the ball", {-1.2f, 0, -0.5f}, green}, {"boxes", "boxes", {1.4f, 0, 0.6f}, cyan}});
}

moving_stage tree_in_moving_light(double aspect)
{
    const tree_form form{{{5, 7, 4, 0.62f, 0.55f, 0.9f, 0.35f},
                          {5, 5, 3, 0.62f, 0.55f, 0.9f, 0.25f},
                          {2, 4, 2, 0.62f, 0.55f, 1.0f, 0.25f},
                          {2, 3, 2, 0.60f, 0.6f, 1.0f, 0.25f},
                          {2, 3, 1, 0.60f, 0.6f, 1.0f, 0.4f}},
                         20};
    mesh wood = painted("wood", {0.30f, 0.21f, 0.14f}), leaves = painted("leaves", {0.24f, 0.42f, 0.12f});
    add_tree(wood, leaves, {0, 0.02f, 0}, 3.2f, 7, form);
    wood.normals.clear();
    moving_scene casters{{"tree in a moving light", {}}, {}};
    add(casters, wood, glm::vec3(0));
    add(casters, leaves, glm::vec3(0));
    return on_ground(casters, {{-2, 6, 2}, {2, 6, 2}}, {{0, 3, 7}, {0, 1.2, 0}, 45}, aspect,
                     {{"crown", "shadow of the crown", {0.5f, 0, -1.2f}, green},
                      {"trunk", "foot of the trunk", {0.2f, 0, 0.2f}, cyan}});
}

moving_stage runner(moving_scene model, double aspect)
{
    moving_scene casters{{"runner", {}}, {}};
    const glm::vec3 forth(0, 0, 0.16f);
    const auto placed = [](glm::vec3 p) { return 2.2f * p; };
    for (std::size_t m = 0; m < model.closing.size(); ++m) {
        mesh open = model.open.meshes[m], closing = open;
        open.normals.clear();
        for (std::size_t i = 0; i < open.positions.size(); ++i) {
            closing.positions[i] = placed(model.closing[m][i]) + 0.5f * forth;
            open.positions[i] = placed(open.positions[i]) - 0.5f * forth;
        }
        add(casters, open, closing);
    }
    mesh columns = painted("columns", sand);
    const std::array<turned_circle, 8> outline{{{0.17f, 0},
                                                {0.17f, 0.08f},
                                                {0.12f, 0.14f},
                                                {0.125f, 0.6f},
                                                {0.1f, 1.75f},
                                                {0.15f, 1.82f},
                                                {0.17f, 1.84f},
                                                {0.17f, 1.95f}}};
    for (const float x : {-1.1f, 1.1f})
        for (int i = 0; i < 6; ++i) add_turned(columns, {x, 0, 2 - static_cast<float>(i)}, outline, 24);
    add(casters, columns, glm::vec3(0));
    return on_ground(casters, {{2, 8, 3}, {2, 8, 3}}, {{0, 2, 7}, {0, 1, 0}, 45}, aspect,
                     {{"runner", "shadow of the runner", {-0.2f, 0, -0.4f}, green},
                      {"column", "shadow of a column", {-0.8f, 0, 0.7f}, cyan}});
}

moving_stage walker(const moving_scene& model, double aspect)
{
    const glm::dvec3 light(-2.8, 3.9, 1);
    return on_ground(model, {light, light}, {{1.5, 1.7, 2.4}, {0.3, 0.4, -0.1}, 38}, aspect,
                     {{"walker", "shadow of the walker", {0.4f, 0, -0.13f}, green},
                      {"feet", "shadow of the feet", {0.1f, 0, 0}, cyan}});
}

moving_stage moving_eye(double aspect)
{
    mesh plates = painted("plates", clay), boxes = painted("boxes", sand);
    for (const glm::vec3& centre : {glm::vec3(-1.1f, 1.5f, -1.1f), {-0.3f, 0.9f, 0.5f}, {-0.8f, 1.2f, 1.6f}})
        add_box(plates, upright(centre, {0.4f, 0.05f, 1.1f}));
    for (const float x : {-1.5f, 0.f, 1.5f}) add_box(boxes, upright({x, 0.25f, -0.2f}, {0.3f, 0.5f, 0.3f}));
    moving_scene casters{{"moving eye", {}}, {}};
    add(casters, plates, {0.9f, 0, 0});
    add(casters, boxes, glm::vec3(0));
    moving_stage result = on_ground(
        casters, {{0.5, 7, 1}, {0.5, 7, 1}}, {{0.2, 5, 6}, {0, 0.3, 0}, 38}, aspect,
        {{"box", "static box", {0.1f, 0.2f, 0.1f}, green}, {"plate", "shadow of a plate", {-0.75f, 0, 1.5f}, cyan}});
    result.eye.motion = {-0.4, 0, 0};
    // Planes that enclose the world from the second place as well.
    camera& open = result.eye.open;
    const camera closing =
        perspective_view_from(open.position + result.eye.motion, open.position + result.eye.motion + open.forward,
                              bounds_of(result.world).corners(), glm::radians(45.0), aspect);
    open.near_distance = glm::min(open.near_distance, closing.near_distance);
    open.far_distance = glm::max(open.far_distance, closing.far_distance);
    return result;
}

} // namespace gnomon::renderer
