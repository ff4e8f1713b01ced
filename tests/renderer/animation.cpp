// Animated glTF models: small files whose vertices are known at any time, and lines for bad requests.
#include "animated_model.hpp"
#include "folder.hpp"
#include "gltf_writer.hpp"
#include "renderer/output/file.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

std::string number(int i) { return std::to_string(i); }

const float half = std::sqrt(0.5f); // sine and cosine of 45 degrees

// A triangle whose box is that of a normalised model, so that the reader's scale is one.
const std::vector<float> frame{-0.5f, 0, -0.5f, 0.5f, 1, 0.5f, 0.5f, 0, -0.5f};

// A node that rises from y = 0.25 to 0.75 in two seconds carries one that turns about y by 90 degrees, shrinks to half
// its size, and holds a triangle with its first corner at (0.25, 0, 0).
std::string carousel(const std::vector<float>& around = frame)
{
    gltf file;
    const int outer = file.floats("VEC3", 3, around);
    const int inner = file.floats("VEC3", 3, {0.25f, 0, 0, 0, 0.1f, 0, 0, 0, 0.1f});
    const int times = file.floats("SCALAR", 1, {0, 2});
    const int rise = file.floats("VEC3", 3, {0, 0.25f, 0, 0, 0.75f, 0});
    const int turn = file.floats("VEC4", 4, {0, 0, 0, 1, 0, half, 0, half});
    const int shrink = file.floats("VEC3", 3, {1, 1, 1, 0.5f, 0.5f, 0.5f});
    const auto sampler = [&](int values) {
        return R"({"input":)" + number(times) + R"(,"output":)" + number(values) + "}";
    };
    const auto samplers = R"("samplers":[)" + sampler(rise) + "," + sampler(turn) + "," + sampler(shrink) + "]";
    const auto mesh = [](int positions) {
        return R"({"primitives":[{"attributes":{"POSITION":)" + number(positions) + "}}]}";
    };
    return file.text(R"("scenes":[{"nodes":[0,1]}],
        "nodes":[{"name":"frame","mesh":0},{"name":"lift","children":[2]},{"name":"wheel","mesh":1}],
        "meshes":[)" +
                     mesh(outer) + "," + mesh(inner) + R"(],"animations":[{"name":"lift only",)" + samplers +
                     R"(,"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]},{"name":"all",)" +
                     samplers + R"(,"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}},
        {"sampler":1,"target":{"node":2,"path":"rotation"}},{"sampler":2,"target":{"node":2,"path":"scale"}}]}])");
}

// Two bones, the second one 0.5 above the first; it bends about z by 90 degrees within a second. Three corners follow
// the first, the second, and both by half. The node of the mesh stands elsewhere, which the format says not to heed.
std::string arm()
{
    gltf file;
    const int outer = file.floats("VEC3", 3, frame);
    const int positions = file.floats("VEC3", 3, {0, 0.25f, 0, 0, 0.75f, 0, 0, 0.75f, 0.1f});
    const int joints = file.shorts("VEC4", 4, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    const int weights = file.floats("VEC4", 4, {1, 0, 0, 0, 0, 1, 0, 0, 0.5f, 0.5f, 0, 0});
    const int offsets = file.floats("MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,     0, 1,
                                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.5f, 0, 1});
    const int times = file.floats("SCALAR", 1, {0, 1});
    const int bend = file.floats("VEC4", 4, {0, 0, 0, 1, 0, 0, half, half});
    return file.text(R"("scenes":[{"nodes":[0,1,2]}],
        "nodes":[{"mesh":0},{"mesh":1,"skin":0,"translation":[7,8,9]},{"name":"upper","children":[3]},
        {"name":"fore","translation":[0,0.5,0]}],"skins":[{"joints":[2,3],"inverseBindMatrices":)" +
                     number(offsets) + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + number(outer) +
                     R"(}}]},{"primitives":[{"attributes":{"POSITION":)" + number(positions) + R"(,"JOINTS_0":)" +
                     number(joints) + R"(,"WEIGHTS_0":)" + number(weights) +
                     R"(}}]}],"animations":[{"name":"bend","samplers":[{"input":)" + number(times) + R"(,"output":)" +
                     number(bend) + R"(}],"channels":[{"sampler":0,"target":{"node":3,"path":"rotation"}}]}])");
}

} // namespace

TEST_CASE("nodes move through their hierarchy by keys of position, rotation and size")
{
    const temporary_folder folder;
    write_file(folder / "carousel.gltf", carousel());
    const moving_scene all = load_animated_model(folder / "carousel.gltf", "all", 0.5, 1);
    REQUIRE(all.open.meshes.size() == 2);
    CHECK_FALSE(all.moves(0));
    REQUIRE(all.moves(1));
    // A quarter of the way the rotation is by 22.5 degrees, half of the way by 45.
    const float c = std::cos(0.3926990817f), s = std::sin(0.3926990817f);
    const std::vector<glm::vec3>&open = all.open.meshes[1].positions, &closing = all.closing[1];
    CHECK(near(open[0], {0.875f * 0.25f * c, 0.375f, -0.875f * 0.25f * s}));
    CHECK(near(open[1], {0, 0.375f + 0.875f * 0.1f, 0}));
    CHECK(near(closing[0], {0.75f * 0.25f * half, 0.5f, -0.75f * 0.25f * half}));
    CHECK(near(closing[2], {0.75f * 0.1f * half, 0.5f, 0.75f * 0.1f * half}));
    // No name means the first animation, which only lifts.
    const moving_scene lift = load_animated_model(folder / "carousel.gltf", "", 0, 2);
    CHECK(near(lift.open.meshes[1].positions[0], {0.25f, 0.25f, 0}));
    CHECK(near(lift.closing[1][0], {0.25f, 0.75f, 0}));
    const moving_scene still = load_animated_model(folder / "carousel.gltf", "all", 1, 1);
    CHECK_FALSE(still.moves(1));
    CHECK(still.closing[1] == closing);
    // Without an animation, nodes are where the file has them.
    CHECK(near(load_model(folder / "carousel.gltf").meshes[1].positions[0], {0.25f, 0, 0}));
}

TEST_CASE("bones move vertices by their weights")
{
    const temporary_folder folder;
    write_file(folder / "arm.gltf", arm());
    const moving_scene model = load_animated_model(folder / "arm.gltf", "bend", 0, 1);
    REQUIRE(model.open.meshes.size() == 2);
    CHECK(near(model.open.meshes[1].positions[0], {0, 0.25f, 0}));
    CHECK(near(model.open.meshes[1].positions[1], {0, 0.75f, 0}));
    CHECK(near(model.closing[1][0], {0, 0.25f, 0}));
    CHECK(near(model.closing[1][1], {-0.25f, 0.5f, 0}));
    CHECK(near(model.closing[1][2], {-0.125f, 0.625f, 0.1f}));
}

TEST_CASE("normals stay perpendicular to triangles that are scaled, mirrored and skinned, and on the same side")
{
    const temporary_folder folder;
    gltf file;
    const int positions = file.floats("VEC3", 3, {0.9f, 0, 0, 0, 0.7f, 0, 0, 0, 0.5f});
    const float x = 1 / 0.9f, y = 1 / 0.7f, z = 1 / 0.5f, length = std::sqrt(x * x + y * y + z * z);
    const float nx = x / length, ny = y / length, nz = z / length;
    const int normals = file.floats("VEC3", 3, {nx, ny, nz, nx, ny, nz, nx, ny, nz});
    const int joints = file.shorts("VEC4", 4, std::vector<std::uint16_t>(12, 0));
    const int weights = file.floats("VEC4", 4, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const std::string attributes = R"("POSITION":)" + number(positions) + R"(,"NORMAL":)" + number(normals);
    const std::string scaled = R"({"rotation":[0.6,0,0,0.8],"scale":[2,-0.5,1])";
    write_file(folder / "corner.gltf",
               file.text(R"("scenes":[{"nodes":[0,1,2]}],"nodes":[)" + scaled + R"(,"mesh":0},{"mesh":1,"skin":0},)" +
                         scaled + R"(}],"skins":[{"joints":[2]}],"meshes":[{"primitives":[{"attributes":{)" +
                         attributes + R"(}}]},{"primitives":[{"attributes":{)" + attributes + R"(,"JOINTS_0":)" +
                         number(joints) + R"(,"WEIGHTS_0":)" + number(weights) + "}}]}]"));
    const scene model = load_model(folder / "corner.gltf");
    REQUIRE(model.meshes.size() == 2);
    for (const mesh& part : model.meshes) {
        const glm::uvec3 corners = part.triangles[0];
        const glm::vec3 a = part.positions[corners.x], b = part.positions[corners.y], c = part.positions[corners.z];
        for (const glm::vec3& normal : part.normals) CHECK(near(normal, glm::normalize(glm::cross(b - a, c - a))));
    }
}

TEST_CASE("a moving model has unit size over all of its places, and its stage sees it at all times")
{
    const temporary_folder folder;
    write_file(folder / "fall.gltf", arm());
    const moving_scene model = load_animated_model(folder / "fall.gltf", "", 0.25, 0.75);
    const bounds box = bounds_of(model);
    CHECK(box.lower.y == 0);
    CHECK(std::max({box.extent().x, box.extent().y, box.extent().z}) == doctest::Approx(1));
    // All places are scaled alike: the box from (-2, -1, -2) to (2, 3, 2) becomes that of the frame.
    write_file(folder / "large.gltf", carousel({-2, -1, -2, 2, 3, 2, 2, -1, -2}));
    const moving_scene large = load_animated_model(folder / "large.gltf", "all", 0, 2);
    CHECK(near(large.open.meshes[1].positions[0], {0.25f / 4, 1.25f / 4, 0}));
    CHECK(near(large.closing[1][0], {0, 1.75f / 4, -0.125f / 4}));
    CHECK(large.closing[0] == large.open.meshes[0].positions);
    const std::size_t parts = model.closing.size();
    const moving_stage stage = animated_model_stage(model, 1.5);
    REQUIRE(stage.world.closing.size() == parts + 1);
    CHECK_FALSE(stage.world.moves(parts));
    for (const float t : {0.f, 0.5f, 1.f}) {
        const scene now = scene_at(stage.world, t);
        for (std::size_t m = 0; m < parts; ++m)
            for (const glm::vec3& corner : now.meshes[m].positions) {
                CHECK(within_view(project(stage.light.at(double(t)), corner)));
                CHECK(within_view(project(stage.eye.open, corner)));
            }
    }
}

TEST_CASE("a request that an animation cannot meet is answered by one line")
{
    const temporary_folder folder;
    write_file(folder / "a.gltf", carousel());
    write_file(folder / "rest.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# padding\n");
    const auto complaint = [&](const char* name, std::string_view animation, double open, double closing) {
        return complaint_about(folder / name, animation, open, closing);
    };
    CHECK(complaint("a.gltf", "walk", 0, 1) == R"(no animation "walk"; there are "lift only", "all")");
    CHECK(complaint("a.gltf", "all", 1, 0.5) == "the shutter opens at 1 s and closes at 0.5 s");
    CHECK(complaint("a.gltf", "all", std::nan(""), 1) == "the shutter opens at nan s and closes at 1 s");
    CHECK(complaint("a.gltf", "all", 1, 2.5) == R"(2.5 s is outside of animation "all", which lasts 2 s)");
    CHECK(complaint("a.gltf", "all", -0.5, 1) == R"(-0.5 s is outside of animation "all", which lasts 2 s)");
    CHECK(complaint("rest.obj", "", 0, 1) == "no animation in it");
    CHECK(complaint("none.gltf", "", 0, 1) == "no such file");
}
