// The scenes for layers of moving samples: their sizes, what moves and how, and that surfaces are closed.
#include "renderer/scene/layered_stages.hpp"

#include "renderer/scene/tube.hpp"
#include "renderer/trace/tracer.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <vector>

using namespace gnomon::renderer;

namespace {

constexpr double aspect = 16.0 / 9;

// A model of unit size that moves: a box that leans.
moving_stage leaning_runner(double ratio)
{
    mesh box = painted("box", glm::vec3(0.5f)), leaning = box;
    add_box(box, upright({0, 0.25f, 0}, {0.3f, 0.5f, 1}));
    leaning = box;
    for (glm::vec3& p : leaning.positions) p.x += 0.2f * p.y;
    return runner({{"leaning box", {box}}, {leaning.positions}}, ratio);
}

std::vector<moving_stage> all_stages()
{
    return {tentacles(aspect, false),
            tentacles_from_above(aspect, false),
            wrecking_ball(aspect),
            chess(aspect),
            tree_in_moving_light(aspect),
            leaning_runner(aspect),
            moving_eye(aspect)};
}

std::size_t triangles_of(const moving_stage& stage, std::string_view name)
{
    for (const mesh& part : stage.world.open.meshes)
        if (part.name == name) return part.triangles.size();
    return 0;
}

std::size_t mesh_of(const moving_stage& stage, std::string_view name)
{
    const auto found = std::ranges::find(stage.world.open.meshes, name, &mesh::name);
    return static_cast<std::size_t>(found - stage.world.open.meshes.begin());
}

// True if each edge of a triangle is the edge of one other triangle, in the other direction.
bool closed(const mesh& part)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const glm::uvec3& t : part.triangles)
        for (int k = 0; k < 3; ++k) {
            ++edges[{t[k], t[(k + 1) % 3]}];
            --edges[{t[(k + 1) % 3], t[k]}];
        }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

double volume(const mesh& part)
{
    double sum = 0;
    for (const glm::uvec3& t : part.triangles) {
        const glm::dvec3 a(part.positions[t.x]), b(part.positions[t.y]), c(part.positions[t.z]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

// Positions of each connected part of a mesh, by their indices.
std::vector<std::vector<std::uint32_t>> connected_parts(const mesh& of)
{
    std::vector<std::uint32_t> parent(of.positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const glm::uvec3& t : of.triangles)
        for (int k = 0; k < 2; ++k) parent[root(t[k])] = root(t[k + 1]);
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    for (std::uint32_t i = 0; i < parent.size(); ++i) parts[root(i)].push_back(i);
    std::vector<std::vector<std::uint32_t>> result;
    for (auto& [unused, part] : parts) result.push_back(std::move(part));
    return result;
}

} // namespace

TEST_CASE("capped tubes and balls are closed, of 2 sides triangles a point")
{
    mesh tube = painted("tube", {});
    const std::array path{glm::vec3(0, 1, 0), glm::vec3(1, 2, 0), glm::vec3(1, 3, 1)};
    add_capped_tube(tube, path, std::array{0.3f, 0.2f, 0.1f}, 7);
    CHECK(tube.triangles.size() == 2 * 7 * 3);
    CHECK(closed(tube));
    CHECK(volume(tube) > 0);
    mesh ball = painted("ball", {});
    add_ball(ball, {1, 2, 3}, 0.5f, 40, 60);
    CHECK(closed(ball));
    CHECK(volume(ball) == doctest::Approx(4 / 3. * glm::pi<double>() * 0.125).epsilon(0.01));
}

TEST_CASE("triangles are as many as the figures have")
{
    CHECK(triangles_of(tentacles(aspect, false), "tentacles") == 24576);
    CHECK(triangles_of(tentacles(aspect, true), "tentacles") == 180000);
    const moving_stage stage = wrecking_ball(aspect);
    CHECK(triangles_of(stage, "ball") == 2000);
    CHECK(triangles_of(stage, "chain") == 12 * 12);
    CHECK(triangles_of(stage, "boxes") == 30 * 12);
    std::size_t pieces = triangles_of(chess(aspect), "black") + triangles_of(chess(aspect), "white");
    CHECK(pieces / 32 >= 900);
    CHECK(pieces / 32 < 950);
    CHECK(triangles_of(tree_in_moving_light(aspect), "leaves") == 2 * 4000);
    CHECK(triangles_of(leaning_runner(aspect), "columns") == 12 * 2 * 24 * 8);
}

TEST_CASE("nothing is below the ground or behind the light, and the light's map holds all casters")
{
    for (const moving_stage& stage : all_stages()) {
        CAPTURE(stage.world.open.name);
        CHECK(bounds_of(stage.world).lower.y >= 0);
        CHECK(stage.light.open.near_distance > 0);
        for (const float t : {0.f, 0.5f, 1.f}) {
            const scene now = scene_at(stage.world, t);
            for (const mesh& part : now.meshes)
                for (const glm::vec3& p : part.positions) {
                    CHECK(std::abs(project(stage.eye.at(double(t)), p).z) <= 1);
                    const glm::dvec3 seen = project(stage.light.at(double(t)), p);
                    const bool between = std::abs(seen.z) <= 1;
                    const bool inside = part.name == "ground" || within_view(seen);
                    if (!between || !inside) FAIL_CHECK(part.name << ": beyond the light's map");
                }
        }
    }
}

TEST_CASE("solids are closed and turned outwards, at all times")
{
    for (const moving_stage& stage : all_stages())
        for (std::size_t m = 0; m < stage.world.closing.size(); ++m) {
            const mesh& part = stage.world.open.meshes[m];
            if (part.name == "ground" || part.name == "wood" || part.name == "leaves") continue;
            CAPTURE(stage.world.open.name);
            CAPTURE(part.name);
            CHECK(closed(part));
            for (const float t : {0.f, 0.5f, 1.f}) CHECK(volume(scene_at(stage.world, t).meshes[m]) > 0);
        }
}

TEST_CASE("tentacles bend to either side by turns, and do not stretch")
{
    const moving_stage stage = tentacles(aspect, false);
    const std::size_t arms = mesh_of(stage, "tentacles");
    const mesh &open = stage.world.open.meshes[arms], closing = scene_at(stage.world, 1).meshes[arms];
    const auto parts = connected_parts(open);
    REQUIRE(parts.size() == 8);
    int turns = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        // The last vertex of a tentacle is the centre of its tip, the one before it that of its root.
        const std::uint32_t tip = parts[i].back(), root = tip - 1;
        CHECK(glm::length(open.positions[root] - closing.positions[root]) < 1e-6f);
        const glm::vec3 from = open.positions[tip] - open.positions[root],
                        to = closing.positions[tip] - closing.positions[root];
        CHECK(glm::length(to - from) > 0.4f);
        const float side = from.z * to.x - from.x * to.z; // positive to the left, seen from above
        CHECK((side > 0) == (i % 2 == 0));
        turns += side > 0;
    }
    CHECK(turns == 4);
    double longest = 0;
    for (const glm::uvec3& t : open.triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            const float before = glm::length(open.positions[a] - open.positions[b]);
            const float after = glm::length(closing.positions[a] - closing.positions[b]);
            longest = std::max(longest, std::abs(double(after - before)));
        }
    CHECK(longest < 0.03);
}

TEST_CASE("the ball flies on its chain, and boxes fly apart")
{
    const moving_stage stage = wrecking_ball(aspect);
    const scene closing = scene_at(stage.world, 1);
    const std::size_t ball = mesh_of(stage, "ball"), boxes = mesh_of(stage, "boxes");
    for (std::size_t i = 0; i < closing.meshes[ball].positions.size(); ++i)
        CHECK(glm::length(closing.meshes[ball].positions[i] - stage.world.open.meshes[ball].positions[i] -
                          glm::vec3(2.1f, -0.6f, 0)) < 1e-5f);
    std::set<float> ways;
    const auto parts = connected_parts(stage.world.open.meshes[boxes]);
    REQUIRE(parts.size() == 30);
    for (const auto& part : parts) {
        glm::vec3 way(0);
        for (const std::uint32_t i : part)
            way += closing.meshes[boxes].positions[i] - stage.world.open.meshes[boxes].positions[i];
        way /= static_cast<float>(part.size());
        CHECK(way.x > 0.3f);
        ways.insert(way.x);
    }
    CHECK(ways.size() > 10);
}

TEST_CASE("five pieces move, each straight and by 0.8 at most, and one king falls")
{
    const moving_stage stage = chess(aspect);
    std::size_t falling = 0, standing = 0;
    std::set<std::array<float, 3>> moves;
    for (const std::string_view side : {"white", "black"}) {
        const std::size_t m = mesh_of(stage, side);
        for (const auto& part : connected_parts(stage.world.open.meshes[m])) {
            const auto way = [&](std::uint32_t i) {
                return stage.world.closing[m][i] - stage.world.open.meshes[m].positions[i];
            };
            const glm::vec3 first = way(part.front());
            const bool rigid =
                std::ranges::all_of(part, [&](std::uint32_t i) { return glm::length(way(i) - first) < 1e-5f; });
            if (!rigid) ++falling;
            else if (glm::length(first) < 1e-6f) ++standing;
            else {
                CHECK(glm::length(first) <= 0.8f + 1e-5f);
                moves.insert({std::round(first.x * 1000), std::round(first.y * 1000), std::round(first.z * 1000)});
            }
        }
    }
    CHECK(moves.size() == 5);
    CHECK(falling == 3);               // the king and the two bars of its cross
    CHECK(standing == 26 + 2 * 2 + 2); // other pieces, heads of two knights, a cross
}

TEST_CASE("plates move one way, and the camera the other way")
{
    const moving_stage stage = moving_eye(aspect);
    const std::size_t plates = mesh_of(stage, "plates"), boxes = mesh_of(stage, "boxes");
    CHECK(stage.world.closing[plates][0].x - stage.world.open.meshes[plates].positions[0].x > 0.5f);
    CHECK(!stage.world.moves(boxes));
    CHECK(stage.eye.motion.x < -0.2);
}

TEST_CASE("each place of interest holds shade and penumbra")
{
    constexpr int width = 320, height = 180, size = 24;
    for (const moving_stage& stage : all_stages()) {
        const reference_picture seen = tracer(stage.world).photograph(stage.light, stage.eye, width, height, 64);
        CAPTURE(stage.world.open.name);
        REQUIRE(!stage.interests.empty());
        for (const point_of_interest& place : stage.interests) {
            CAPTURE(place.id);
            CHECK(within_view(project(stage.eye.open, place.position)));
            const rectangle inset = inset_around(place, stage.eye.open, size, width, height);
            int between = 0;
            for (int y = inset.y; y < inset.y + size; ++y)
                for (int x = inset.x; x < inset.x + size; ++x) {
                    const float v = seen.visibility(x, y);
                    between += v > 0.05f && v < 0.95f;
                }
            CHECK(between > size);
        }
    }
}
