// Models: good ones are normalised, bad ones answer with one line that names the file and the cause.
#include "renderer/import/model.hpp"

#include "folder.hpp"
#include "renderer/import/import_guard.hpp"
#include "renderer/output/file.hpp"
#include "renderer/scene/stage.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <stdexcept>

using namespace gnomon::renderer;

namespace {

scene load_text(const temporary_folder& folder, const char* name, std::string_view text)
{
    write_file(folder / name, text);
    return load_model(folder / name);
}

std::string complaint_about(const std::filesystem::path& file)
{
    try {
        load_model(file);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "none";
}

constexpr std::string_view tent =
    "v 10 5 0\nv 14 5 0\nv 14 5 2\nv 10 5 2\nv 12 7 1\nf 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

} // namespace

TEST_CASE("a model stands on the ground, centred, its longest side one")
{
    const temporary_folder folder;
    const scene model = load_text(folder, "tent.obj", tent);
    const bounds box = bounds_of(model);
    CHECK(box.lower == glm::vec3(-0.5f, 0, -0.25f));
    CHECK(box.upper == glm::vec3(0.5f, 0.5f, 0.25f));
    REQUIRE(model.meshes.size() == 1);
    CHECK(model.meshes[0].triangles.size() == 6); // the quad became two
    CHECK(model.name == "tent");
}

TEST_CASE("huge and tiny coordinates, points, lines and NaN do no harm")
{
    const temporary_folder folder;
    for (const char* size : {"1e-37", "3e38"}) {
        const std::string s(size), text = "v -" + s + " 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nf 1 2 3\n";
        const bounds box = bounds_of(load_text(folder, "range.obj", text));
        CHECK(box.extent().x == doctest::Approx(1.0));
        CHECK(box.extent().y == doctest::Approx(0.5));
    }
    // A corner at NaN takes its triangle away, and unused corners do not count: what is left is the tent.
    const std::string text(tent);
    const scene model = load_text(folder, "mixed.obj", text + "v nan 0 0\nv 1e30 0 0\nf 1 2 6\np 7\nl 1 7\n");
    CHECK(bounds_of(model).upper == glm::vec3(0.5f, 0.5f, 0.25f));
    for (const mesh& part : model.meshes)
        for (const glm::vec3& p : part.positions)
            CHECK((std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)));
}

TEST_CASE("bad files answer with one line: file and cause")
{
    const temporary_folder folder;
    const auto check = [&](const char* name, std::string_view text, std::string_view cause) {
        write_file(folder / name, text);
        const std::string line = complaint_about(folder / name);
        CAPTURE(line);
        CHECK(line.starts_with((folder / name).string() + ": "));
        CHECK(line.find(cause) != std::string::npos);
        CHECK(line.find('\n') == std::string::npos);
    };
    check("empty.obj", "", "too small");
    check("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n# padding\n", "no triangles");
    check("lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n# padding\n", "no triangles");
    check("nowhere.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# padding\n", "no triangles");
    check("one_point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n# padding\n", "all triangles lie in one point");
    check("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n# padding\n", "");
    check("model.unknown", "whatever", "No suitable reader");
    check("cut.gltf", "{ \"asset\": { \"ver", "");
#ifndef __SANITIZE_ADDRESS__ // which the memory limit is not for, see import_guard.cpp
    check("bomb.off", "OFF\n353535235358 6 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "needs too much memory");
#endif
    CHECK(complaint_about(folder.path) == folder.path.string() + ": not a file");
    CHECK(complaint_about(folder / "none.obj") == (folder / "none.obj").string() + ": no such file");
}

TEST_CASE("a crash in an importer ends the program with one line and exit code 2")
{
    std::array<int, 2> ends{};
    REQUIRE(pipe(ends.data()) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        const import_guard guard("bad.raw");
        std::raise(SIGSEGV);
        _exit(0);
    }
    close(ends[1]);
    std::array<char, 200> text{};
    const ssize_t count = read(ends[0], text.data(), text.size());
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(count > 0);
    CHECK(std::string(text.data(), static_cast<std::size_t>(count)) == "bad.raw: its reader crashed\n");
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 2);
}

TEST_CASE("a model's stage has ground below and an area light, and camera and light see the model")
{
    const temporary_folder folder;
    const scene model = load_text(folder, "tent.obj", tent);
    const stage all = model_stage(model, 1.5);
    REQUIRE(all.world.meshes.size() == 2);
    CHECK(all.world.meshes.back().positions[0].y == 0);
    CHECK(all.area().size.x > 0);
    for (const glm::vec3& p : model.meshes[0].positions) {
        CHECK(within_view(project(all.eye, p)));
        CHECK(within_view(project(all.light, p)));
    }
}
