// Animated models of formats that Assimp reads: small files whose vertices are known at any time.
#include "animated_model.hpp"
#include "folder.hpp"
#include "renderer/output/file.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

// DirectX text, which Assimp reads: the triangle of the frame and, on a node of these names and matrix, the one of the
// carousel, with an animation of these keys.
std::string turntable(const std::string& matrix, const std::string& keys, const std::string& second_name = "other")
{
    return R"(xof 0303txt 0032
AnimTicksPerSecond { 10; }
Frame frame {
  Mesh { 3; -0.5;0;-0.5;, 0.5;1;0.5;, 0.5;0;-0.5;; 1; 3;0,1,2;; }
}
Frame )" + second_name +
           R"( {}
Frame wheel {
  FrameTransformMatrix { )" +
           matrix + R"( }
  Mesh { 3; 0.2;0;0;, 0;0.1;0;, 0;0;0.3;; 1; 3;0,1,2;; }
}
AnimationSet spin { Animation { { wheel } )" +
           keys + "} }\n";
}

const std::string at_rest = "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;;";
const std::string mirrored = "-1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;;";
// By 90 degrees about z within a second.
const std::string turning = "AnimationKey { 0; 2; 0;4;1.0,0.0,0.0,0.0;;, 10;4;0.70710678,0.0,0.0,0.70710678;;; }";
const std::string turned = "AnimationKey { 0; 1; 0;4;0.70710678,0.0,0.0,0.70710678;;; }";
const std::string scaling = "AnimationKey { 1; 1; 0;3;-1.0,2.0,0.5;;; }";
const std::string enlarging = "AnimationKey { 1; 1; 0;3;2.0,2.0,2.0;;; }";
const std::string lifting = "AnimationKey { 2; 1; 0;3;0.1,0.4,0.2;;; }";

// A matrix that scales x and moves to (0.1, 0.5, 0).
std::string raised(int x)
{
    return std::to_string(x) + ".0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.1,0.5,0.0,1.0;;";
}

} // namespace

TEST_CASE("nodes are scaled, then rotated, then translated")
{
    const temporary_folder folder;
    write_file(folder / "turntable.x", turntable(at_rest, turning + scaling + lifting));
    const moving_scene model = load_animated_model(folder / "turntable.x", "spin", 0, 1);
    REQUIRE(model.open.meshes.size() == 2);
    // The format is left-handed: z is mirrored, and the turn is the other way round.
    CHECK(near(model.open.meshes[1].positions[0], {0.1f - 0.2f, 0.4f, -0.2f}));
    CHECK(near(model.open.meshes[1].positions[1], {0.1f, 0.4f + 0.2f, -0.2f}));
    CHECK(near(model.open.meshes[1].positions[2], {0.1f, 0.4f, -0.2f - 0.15f}));
    CHECK(near(model.closing[1][0], {0.1f, 0.4f + 0.2f, -0.2f}));
    CHECK(near(model.closing[1][1], {0.1f + 0.2f, 0.4f, -0.2f}));
    CHECK(near(model.closing[1][2], {0.1f, 0.4f, -0.2f - 0.15f}));
}

TEST_CASE("a channel that leaves out a rotation or scale gets that of its node's matrix")
{
    const temporary_folder folder;
    const auto corner = [&](const std::string& matrix, const std::string& keys, double time) {
        write_file(folder / "turn.x", turntable(matrix, keys));
        return load_animated_model(folder / "turn.x", "spin", time, time).open.meshes[1].positions[0];
    };
    CHECK(near(corner(raised(2), turning, 1), {0.1f, 0.5f - 0.4f, 0}));
    CHECK(near(corner(raised(-2), turning, 0), {0.1f - 0.4f, 0.5f, 0}));
    CHECK(near(corner(raised(-2), turning, 1), {0.1f, 0.5f + 0.4f, 0}));
    CHECK(near(corner(raised(-2), scaling, 0), {0.1f - 0.2f, 0.5f, 0}));
    CHECK(near(corner(raised(-2), lifting, 0), {0.1f - 0.4f, 0.4f, -0.2f}));
}

TEST_CASE("an ambiguous name, rotation or scale is refused")
{
    const temporary_folder folder;
    const auto complaint = [&](const char* name, std::string_view text) {
        write_file(folder / name, text);
        return complaint_about(folder / name, "", 0, 0);
    };
    CHECK(complaint("a.x", turntable(at_rest, turning)) == "none");
    CHECK(complaint("b.x", turntable(at_rest, turning, "wheel")) ==
          R"(several nodes have the name "wheel" of a bone or a channel)");
    CHECK(complaint("c.x", turntable(mirrored, turned + scaling)) == "none");
    CHECK(complaint("d.x", turntable(mirrored, turned)) ==
          R"(an animation leaves out the scale of node "wheel", which its matrix does not tell)");
    CHECK(complaint("e.x", turntable(mirrored, enlarging)) ==
          R"(an animation leaves out the rotation of node "wheel", which its matrix does not tell)");
    // Bones without a mesh bring no mesh of their own.
    CHECK(complaint("walk.bvh",
                    "HIERARCHY\nROOT hip\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n"
                    "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n") ==
          "no triangles in it");
}
