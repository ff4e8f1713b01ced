// Pictures: what is written can be read back, and error colours say what they should.
#include "renderer/output/image.hpp"

#include "renderer/output/file.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "folder.hpp"

#include <cmath>
#include <memory>

using namespace gnomon::renderer;

TEST_CASE("a PNG holds the sRGB codes of the picture")
{
    const temporary_folder folder;
    picture written(7, 5);
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 7; ++x)
            written(x, y) = {static_cast<float>(x) / 6, static_cast<float>(y) / 4, 1.5f - static_cast<float>(x + y)};
    write_png(folder / "picture.png", written);
    int width = 0, height = 0, channels = 0;
    const std::string file = (folder / "picture.png").string();
    const std::unique_ptr<unsigned char, void (*)(void*)> codes(stbi_load(file.c_str(), &width, &height, &channels, 3),
                                                                stbi_image_free);
    REQUIRE(codes);
    CHECK(width == 7);
    CHECK(height == 5);
    for (std::size_t i = 0; i < written.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            CHECK(codes.get()[3 * i + static_cast<std::size_t>(c)] == srgb8(written.pixels[i][c]));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1); // no .part is left behind
}

TEST_CASE("sRGB codes are those of IEC 61966-2-1")
{
    CHECK(srgb8(-1) == 0);
    CHECK(srgb8(NAN) == 0);
    CHECK(srgb8(INFINITY) == 255);
    for (int code = 0; code < 256; ++code) {
        const double s = code / 255.0, linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
        CHECK(srgb8(static_cast<float>(linear)) == code);
    }
}

TEST_CASE("a failed write leaves the earlier file, a folder is not a file")
{
    const temporary_folder folder;
    write_file(folder / "deep/down/file", "first");
    CHECK(read_file(folder / "deep/down/file") == "first");
    CHECK_THROWS_WITH(write_file(folder / "deep/down", "second"),
                      ((folder / "deep/down").string() + ": Is a directory").c_str());
    CHECK_THROWS(write_file(folder / "deep/down/file/below", "second"));
    CHECK(read_file(folder / "deep/down/file") == "first");
    CHECK_THROWS_WITH(read_file(folder / "deep"), ((folder / "deep").string() + ": is a folder").c_str());
    CHECK_THROWS_WITH(read_file(folder / "none"), ((folder / "none").string() + ": No such file or directory").c_str());
}

TEST_CASE("leaks are blue, acne is red, no error is white")
{
    CHECK(error_colour(0, 0.1f) == glm::vec3(1));
    CHECK(error_colour(NAN, 0.1f) == glm::vec3(1, 0, 1));
    CHECK(rc::check("hue by sign, strength by size, saturated at the scale", [](unsigned short code) {
        const float error = static_cast<float>(code + 1) / 65536;
        const glm::vec3 leak = error_colour(error, 0.5f), acne = error_colour(-error, 0.5f);
        RC_ASSERT(leak.b > leak.r && leak.b > leak.g);
        RC_ASSERT(acne.r > acne.b && acne.r > acne.g);
        RC_ASSERT(leak.r >= error_colour(std::min(1.1f * error, 1.f), 0.5f).r);
        if (error >= 0.5f) RC_ASSERT(leak == error_colour(1, 0.5f));
    }));
    image<float> estimate(2, 1, 0.5f), reference(2, 1, 0.5f);
    estimate(1, 0) = 1;
    const picture errors = error_picture(estimate, reference, 0.5f);
    CHECK(errors(0, 0) == glm::vec3(1));
    CHECK(errors(1, 0) == error_colour(0.5f, 0.5f));
    CHECK_THROWS_WITH(error_picture(estimate, image<float>(1, 1), 1),
                      "error_picture: estimate is 2x1, reference is 1x1");
}

TEST_CASE("magnified, pasted and outlined pixels stay where they belong")
{
    image<float> values(4, 3);
    for (std::size_t i = 0; i < 12; ++i) values.pixels[i] = static_cast<float>(i);
    const picture source = grey(values), large = magnify(source, {1, 1, 2, 2}, 3);
    REQUIRE(large.width == 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) CHECK(large(x, y) == source(1 + x / 3, 1 + y / 3));

    const std::vector<picture> parts{picture(2, 3, glm::vec3(0)), picture(1, 1, glm::vec3(0.5f))};
    const picture row = side_by_side(parts, 2), column = stacked(parts, 2);
    CHECK(row.width == 5);
    CHECK(row.height == 3);
    CHECK(row(4, 0) == glm::vec3(0.5f));
    CHECK(row(4, 1) == glm::vec3(1));
    CHECK(row(3, 0) == glm::vec3(1));
    CHECK(column.width == 2);
    CHECK(column.height == 6);
    CHECK(column(0, 5) == glm::vec3(0.5f));

    picture framed(6, 6, glm::vec3(0));
    outline(framed, {2, 2, 2, 2}, glm::vec3(1), 1);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) {
            const bool around = x >= 1 && x <= 4 && y >= 1 && y <= 4, within = x >= 2 && x <= 3 && y >= 2 && y <= 3;
            CHECK(framed(x, y) == glm::vec3(around && !within ? 1.f : 0.f));
        }
    outline(framed, {-3, 4, 20, 20}, glm::vec3(1), 4); // what sticks out is cut off
}

TEST_CASE("a rectangle around a point stays inside the picture")
{
    CHECK(rc::check("wherever the point is", [](int x, int y) {
        const int size = *rc::gen::inRange(1, 40), width = *rc::gen::inRange(1, 60), height = *rc::gen::inRange(1, 60);
        const rectangle r = rectangle_around(x % 200, y % 200, size, width, height);
        RC_ASSERT(r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0);
        RC_ASSERT(r.x + r.width <= width && r.y + r.height <= height);
    }));
    CHECK(rectangle_around(30, 20, 10, 100, 100).x == 25);
}
